// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_TRIANGLE_DISTANCE_H
#define SELVEDGE_SRC_VERIFY_TRIANGLE_DISTANCE_H

#include <selvedge/Triangle_soup.h>
#include <selvedge/verify.h>

#include <CGAL/Exact_kernel_selector.h>
#include <CGAL/Quotient.h>

#include <array>

// The distance of two triangles, for the judge and for the replay, which compare distances of pieces. It has
// no code in common with the test that keeps pieces apart during a reduction.

namespace selvedge::internal {

using Corner = std::array<double, 3>;
using Corners = std::array<Corner, 3>; // of a triangle, which may be degenerate

/// Returns bounds of the squared distance of two triangles, which are nearly equal unless the triangles meet.
/// They are certified: a direction along which one triangle lies beyond the other proves the lower, a point
/// of each the upper.
Bounds squared_distance_bounds(const Corners& a, const Corners& b);

/// Sums and products of numbers of this type are exact, and so are comparisons of their quotients.
using Exact_number = CGAL::Exact_kernel_selector<Kernel>::Exact_rt;
using Exact_square = CGAL::Quotient<Exact_number>;

/// Returns the squared distance of two triangles.
Exact_square exact_squared_distance(const Corners& a, const Corners& b);

Exact_square exact_square(double number);

/// Returns bounds of the square of a number.
Bounds square_bounds(double number);

/// Returns bounds of a number of whose square some are known.
Bounds root_bounds(const Bounds& square);

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_TRIANGLE_DISTANCE_H
