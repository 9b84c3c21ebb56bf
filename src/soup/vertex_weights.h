// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_VERTEX_WEIGHTS_H
#define SELVEDGE_SOUP_VERTEX_WEIGHTS_H

#include <selvedge/Triangle_soup.h>

#include <string>
#include <vector>

namespace selvedge {

/// Returns the first components of the vertex attribute called `name`, as shares of the largest. A weight is
/// 1 where the attribute is NaN, and everywhere when the largest is 0.
///
/// Throws `Argument_error` when no attribute has the name, and when a component is negative or infinite.
std::vector<double> vertex_weights(const Triangle_soup& soup, const std::string& name);

} // namespace selvedge

#endif // SELVEDGE_SOUP_VERTEX_WEIGHTS_H
