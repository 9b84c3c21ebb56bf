// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_INTERNAL_FEATURE_DISTANCES_H
#define SELVEDGE_GEOMETRY_INTERNAL_FEATURE_DISTANCES_H

#include <CGAL/Interval_nt.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/Quotient.h>
#include <CGAL/Uncertain.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

namespace selvedge {
namespace internal {

/// Finds the distances between a corner, an edge or a facet of one body and a triangle.
///
/// A *candidate* is the distance between two lines, a point and a line, or a point and a plane: between a
/// feature and a corner, an edge or the inside of the triangle. It is *attained* when its feet lie in both.
/// Candidates between two parallel features, and of the inside of a facet with an edge, are left out: where
/// one of these is the least distance, so is another candidate, of an end or of an edge of the facet. For
/// the same reason, feet on the ends of edges count.
///
/// `Kernel` is a kernel of intervals, with which both answers may be uncertain, or of exact numbers, which
/// need not be divisible: squared distances are then quotients.
template <class Kernel>
class Feature_distances
{
  using Vector = typename Kernel::Vector_3;

public:
  using Boolean = typename Kernel::Boolean;
  using FT = typename Kernel::FT;
  using Squared = std::conditional_t<std::is_same_v<Boolean, bool>, CGAL::Quotient<FT>, FT>;
  using Point = typename Kernel::Point_3;
  using Triangle = std::array<Point, 3>;

  /// Calls `visit(is_attained, squared_distance)` for all candidates of a feature of one, two or three
  /// corners and a triangle, in which these corners and insides alone take part: those of a facet do not
  /// include those of its edges.
  template <std::size_t n, class Visit>
  static void visit(const std::array<const Point*, n>& feature, const Triangle& f, const Visit& visit)
  {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point &p = f[i], &q = f[(i + 1) % 3];
      if constexpr (n == 1) {
        visit(Boolean(true), Squared((p - *feature[0]).squared_length()));
        visit_point_and_edge(*feature[0], p, q, visit);
      } else if constexpr (n == 2) {
        visit_point_and_edge(p, *feature[0], *feature[1], visit);
        visit_edges(*feature[0], *feature[1], p, q, visit);
      } else {
        visit_point_and_facet(p, *feature[0], *feature[1], *feature[2], visit);
      }
    }
    if constexpr (n == 1)
      visit_point_and_facet(*feature[0], f[0], f[1], f[2], visit);
  }

  /// Replaces `least` by a candidate, if that is attained and less.
  static void take_least(Squared& least, const Boolean& is_attained, const Squared& squared)
  {
    if constexpr (std::is_same_v<Boolean, bool>) {
      if (is_attained && squared < least)
        least = squared;
    } else if (CGAL::possibly(is_attained)) {
      least = FT((std::min)(least.inf(), squared.inf()),
                 CGAL::certainly(is_attained) ? (std::min)(least.sup(), squared.sup()) : least.sup());
    }
  }

private:
  static bool both(bool a, bool b) { return a && b; }
  static CGAL::Uncertain<bool> both(const CGAL::Uncertain<bool>& a, const CGAL::Uncertain<bool>& b)
  {
    return a & b;
  }

  // Whether a fraction with a positive denominator lies between 0 and 1.
  static Boolean is_fraction(const FT& numerator, const FT& denominator)
  {
    return both(numerator >= 0, numerator <= denominator);
  }

  static Squared quotient(const FT& numerator, const FT& denominator)
  {
    if constexpr (std::is_same_v<Squared, FT>)
      return numerator / denominator;
    else
      return {numerator, denominator};
  }

  template <class Visit>
  static void visit_point_and_edge(const Point& point, const Point& p, const Point& q, const Visit& visit)
  {
    const Vector u = q - p, w = point - p;
    const FT length = u.squared_length();
    const Boolean is_attained = is_fraction(w * u, length);
    if (CGAL::possibly(is_attained))
      visit(is_attained, quotient(CGAL::cross_product(u, w).squared_length(), length));
  }

  template <class Visit>
  static void visit_edges(const Point& p0, const Point& p1, const Point& q0, const Point& q1,
                          const Visit& visit)
  {
    const Vector u = p1 - p0, v = q1 - q0, w = q0 - p0, n = CGAL::cross_product(u, v);
    const FT length = n.squared_length();
    if (CGAL::certainly(length == 0))
      return;
    const Boolean are_fractions = both(is_fraction(CGAL::cross_product(w, v) * n, length),
                                       is_fraction(CGAL::cross_product(w, u) * n, length));
    const Boolean is_attained = both(are_fractions, length > 0);
    if (CGAL::possibly(is_attained))
      visit(is_attained, quotient(CGAL::square(w * n), length));
  }

  template <class Visit>
  static void visit_point_and_facet(const Point& point, const Point& p, const Point& q, const Point& r,
                                    const Visit& visit)
  {
    const Vector u = q - p, v = r - p, w = point - p, n = CGAL::cross_product(u, v);
    const FT length = n.squared_length();
    if (CGAL::certainly(length == 0))
      return;
    const FT at_v = CGAL::cross_product(u, w) * n, at_u = CGAL::cross_product(w, v) * n;
    const Boolean is_attained = both(both(at_u >= 0, at_v >= 0), both(at_u + at_v <= length, length > 0));
    if (CGAL::possibly(is_attained))
      visit(is_attained, quotient(CGAL::square(w * n), length));
  }
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_INTERNAL_FEATURE_DISTANCES_H
