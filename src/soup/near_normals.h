// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_NEAR_NORMALS_H
#define SELVEDGE_SRC_SOUP_NEAR_NORMALS_H

#include <array>

namespace selvedge {

/// Returns whether two normals differ by at most 0.1°, whatever their lengths. One without a direction is
/// near none.
bool are_near_normals(const std::array<double, 3>& a, const std::array<double, 3>& b);

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_NEAR_NORMALS_H
