// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_FIRST_ALIKE_H
#define SELVEDGE_SRC_SOUP_FIRST_ALIKE_H

#include <selvedge/Triangle_soup.h>

#include <vector>

namespace selvedge {

/// Returns, for every vertex, the first vertex at the same position in all poses whose vertex attributes are
/// the same, bit for bit. The soup is not from glTF. O(n) for n vertices, of which few are at one position.
std::vector<Index> first_alike(const Triangle_soup& soup);

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_FIRST_ALIKE_H
