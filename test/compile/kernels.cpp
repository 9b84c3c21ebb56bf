// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Kernels with which the package compiles or, where REFUSED is defined, the one with which it does not.

#include <selvedge/geometry/star.h>
#include <selvedge/geometry/sweep.h>

#include <CGAL/Simple_cartesian.h>
#ifndef REFUSED
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#endif

template <class Kernel>
bool judge()
{
  using Point = typename Kernel::Point_3;
  const Point m(0, 0, 0), t(1, 0, 0), a(0, 1, 0), b(0, 0, 1);
  return selvedge::Sweep_test<Kernel>(m, t, a, b).is_clear(t, a, b) &&
         selvedge::is_star_motion_clear<Kernel>({m, t, {{a, b}}, {}});
}

int main()
{
#ifdef REFUSED
  return judge<CGAL::Simple_cartesian<double>>();
#else
  return judge<CGAL::Exact_predicates_inexact_constructions_kernel>() &&
         judge<CGAL::Exact_predicates_exact_constructions_kernel>() &&
         judge<CGAL::Simple_cartesian<CGAL::Exact_rational>>();
#endif
}
