// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_TRANSFORMS_OF_VERTICES_H
#define SELVEDGE_SRC_SOUP_TRANSFORMS_OF_VERTICES_H

#include <selvedge/Triangle_soup.h>

#include <vector>

namespace selvedge {

/// Returns, for every vertex of a soup from a glTF file, the number of the transform that it is under;
/// nothing for any other soup. `prepare` gives a vertex the position of another only under the same
/// transform, because the file could not hold it otherwise.
std::vector<Index> transforms_of_vertices(const Triangle_soup& soup);

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_TRANSFORMS_OF_VERTICES_H
