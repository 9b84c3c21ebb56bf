// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_CLEARANCE_H
#define SELVEDGE_GEOMETRY_CLEARANCE_H

#include <selvedge/Error.h>
#include <selvedge/geometry/Vertex_motion.h>
#include <selvedge/geometry/internal/feature_distances.h>
#include <selvedge/internal/exact_predicates.h>

#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_kernel_selector.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace selvedge {

/// Decides whether a moving vertex keeps its faces at a distance from stationary ones.
///
/// The *clearance* D is kept from a stationary face F when every sweep (Sweep_test) of a moving face stays at
/// least as far from F as D or, if that is less, as the nearest face of the star was before the motion. So
/// faces that are farther than D from F do not come nearer than D, and those that are nearer already come no
/// nearer.
///
/// **Preconditions** F is disjoint from all sweeps, as `Sweep_test` decides. The points of the motion are
/// distinct, as condition 0 demands.
///
/// **Exactness** The answer is exact. The distance is the double given, to the last digit. Interval
/// arithmetic decides where it can, and exact numbers where it cannot: mostly where two distances
/// are equal. A kernel whose predicates are not exact does not compile.
///
/// **Complexity** O(k) for a star of k faces, where F is nearer than D; less where a box or the plane of F
/// shows that it is not. Where interval arithmetic does not decide, the answer takes some fifty times as
/// long.
template <class Kernel>
class Clearance_test
{
public:
  using Point_3 = typename Kernel::Point_3;

  /// Throws `Argument_error` when the distance is not a positive, finite number.
  explicit Clearance_test(double distance) : m_distance(distance)
  {
    internal::require_exact_predicates<Kernel>();
    if (!(distance > 0 && std::isfinite(distance)))
      throw Argument_error("a clearance is a positive, finite distance");
  }

  /// Takes up a motion, for the questions that follow. A motion without contracted faces goes to a place
  /// where the star has no vertex.
  void begin(const Vertex_motion<Point_3>& motion)
  {
    m_points.assign({motion.from, motion.to});
    m_of_star.clear();
    m_of_sweeps.clear();
    m_exact.clear();
    std::vector<Index>& joined = m_buffer; // points that an edge of the star joins with the goal
    joined.clear();
    for (const auto& edge : motion.contracted) {
      const Index a = index(edge[0]), b = index(edge[1]);
      joined.push_back(a == s_to ? b : a);
      m_of_star.push_back({{s_from, a, b}, 3});
      m_of_star.push_back({{a, b, b}, 2});
    }
    for (const auto& edge : motion.moving) {
      const Index a = index(edge[0]), b = index(edge[1]);
      m_of_star.push_back({{s_from, a, b}, 3});
      m_of_star.push_back({{a, b, b}, 2});
      m_of_sweeps.push_back({{s_to, a, b}, 3});
    }
    const bool is_at_vertex = !motion.contracted.empty();
    for (Index p = 0; p < m_points.size(); ++p) {
      if (p == s_to && !is_at_vertex) {
        m_of_sweeps.push_back({{p, p, p}, 1});
        m_of_sweeps.push_back({{s_from, p, p}, 2});
        continue;
      }
      m_of_star.push_back({{p, p, p}, 1});
      if (p == s_from)
        continue;
      m_of_star.push_back({{s_from, p, p}, 2});
      if (p != s_to && std::find(joined.begin(), joined.end(), p) == joined.end()) {
        m_of_sweeps.push_back({{s_to, p, p}, 2});
        m_of_sweeps.push_back({{s_from, s_to, p}, 3});
      }
    }
    const CGAL::Protect_FPU_rounding<true> upward;
    m_approximate.clear();
    for (const Point_3& p : m_points)
      m_approximate.push_back(To_intervals()(p));
    for (auto* features : {&m_of_star, &m_of_sweeps})
      for (Feature& feature : *features)
        feature.box = Box(m_approximate, feature);
  }

  /// Whether the motion keeps the clearance from a stationary face.
  bool is_kept(const Point_3& f0, const Point_3& f1, const Point_3& f2)
  {
    {
      const CGAL::Protect_FPU_rounding<true> upward;
      const To_intervals to_intervals;
      const typename Approximate::Triangle f{to_intervals(f0), to_intervals(f1), to_intervals(f2)};
      const Interval distance(m_distance);
      const Box box(f, distance);
      find_near(m_of_sweeps, box, m_sweeps_near);
      if (m_sweeps_near.empty() || is_beyond_plane(f, CGAL::square(distance)))
        return true;
      find_near(m_of_star, box, m_star_near);
      const CGAL::Uncertain<bool> is_kept = judge<Approximate>(m_approximate, f, CGAL::square(distance));
      if (CGAL::is_certain(is_kept))
        return CGAL::get_certain(is_kept);
    }
    const To_exact to_exact;
    for (std::size_t p = m_exact.size(); p < m_points.size(); ++p)
      m_exact.push_back(to_exact(m_points[p]));
    ++m_exact_decisions;
    return judge<Exact>(m_exact, {to_exact(f0), to_exact(f1), to_exact(f2)},
                        typename Exact::Squared(CGAL::square(typename Exact::FT(m_distance))));
  }

  /// Returns how many answers took exact numbers.
  std::size_t exact_decisions() const { return m_exact_decisions; }

private:
  using Interval = CGAL::Interval_nt_advanced;
  using Approximate_kernel = CGAL::Simple_cartesian<Interval>;
  using Approximate = internal::Feature_distances<Approximate_kernel>;
  using To_intervals = CGAL::Cartesian_converter<Kernel, Approximate_kernel>;
  using Exact_selector = CGAL::Exact_kernel_selector<Kernel>;
  using Exact = internal::Feature_distances<typename Exact_selector::Exact_kernel_rt>;
  using To_exact = typename Exact_selector::C2E_rt;

  using Index = std::size_t; // of a point of the motion
  static constexpr Index s_from = 0, s_to = 1;

  struct Feature;

  struct Box
  {
    std::array<double, 3> lower, upper;

    Box() = default;
    Box(const std::vector<typename Approximate::Point>& points, const Feature& feature)
    {
      begin(points[feature.corners[0]]);
      add(points[feature.corners[1]]);
      add(points[feature.corners[2]]);
    }
    Box(const typename Approximate::Triangle& f, const Interval& distance)
    {
      begin(f[0]);
      add(f[1]);
      add(f[2]);
      for (std::size_t i = 0; i < 3; ++i) {
        lower[i] = (Interval(lower[i]) - distance).inf();
        upper[i] = (Interval(upper[i]) + distance).sup();
      }
    }

    bool meets(const Box& other) const
    {
      for (std::size_t i = 0; i < 3; ++i)
        if (lower[i] > other.upper[i] || other.lower[i] > upper[i])
          return false;
      return true;
    }

  private:
    void begin(const typename Approximate::Point& p)
    {
      for (std::size_t i = 0; i < 3; ++i) {
        lower[i] = p[int(i)].inf();
        upper[i] = p[int(i)].sup();
      }
    }
    void add(const typename Approximate::Point& p)
    {
      for (std::size_t i = 0; i < 3; ++i) {
        lower[i] = (std::min)(lower[i], p[int(i)].inf());
        upper[i] = (std::max)(upper[i], p[int(i)].sup());
      }
    }
  };

  // A corner, an edge or a facet, without its border.
  struct Feature
  {
    std::array<Index, 3> corners; // the last is repeated
    unsigned size;
    Box box{};
  };

  // Returns the number of a point, which is added if it is new.
  Index index(const Point_3& p)
  {
    const auto at = std::find(m_points.begin(), m_points.end(), p);
    if (at != m_points.end())
      return Index(at - m_points.begin());
    m_points.push_back(p);
    return m_points.size() - 1;
  }

  // What lies outside of the box is farther away than the distance, which decides nothing.
  static void find_near(const std::vector<Feature>& features, const Box& box, std::vector<Index>& near)
  {
    near.clear();
    for (Index i = 0; i < features.size(); ++i)
      if (box.meets(features[i].box))
        near.push_back(i);
  }

  // Whether the whole star, and where it goes, lies on one side of the plane of f, at a distance.
  bool is_beyond_plane(const typename Approximate::Triangle& f, const Interval& squared_distance) const
  {
    const auto n = CGAL::cross_product(f[1] - f[0], f[2] - f[0]);
    const Interval least = squared_distance * n.squared_length();
    int side = 0;
    for (const auto& p : m_approximate) {
      const Interval height = n * (p - f[0]);
      const int side_of_p = height.inf() > 0 ? 1 : height.sup() < 0 ? -1 : 0;
      if (side_of_p == 0 || side_of_p == -side || !CGAL::certainly(CGAL::square(height) >= least))
        return false;
      side = side_of_p;
    }
    return true;
  }

  // The least distance of two disjoint convex bodies is a candidate of two of their features. All candidates
  // of the sweeps with features that are not those of the star have to be at least as large as D or those of
  // the star. (As soon as one of the star is not larger, the others do not matter.)
  template <class Distances>
  typename Distances::Boolean judge(const std::vector<typename Distances::Point>& points,
                                    const typename Distances::Triangle& f, typename Distances::Squared least)
  {
    using Squared = typename Distances::Squared;
    using Boolean = typename Distances::Boolean;
    std::size_t next = 0; // feature of the star
    const auto take_next = [&] {
      visit<Distances>(m_of_star[m_star_near[next++]], points, f,
                       [&](const Boolean& is_attained, const Squared& squared) {
                         Distances::take_least(least, is_attained, squared);
                       });
    };
    Boolean are_all_kept = true;
    const auto is_surely_kept = [&](Index i) {
      bool is_sure = true;
      visit<Distances>(m_of_sweeps[i], points, f, [&](const Boolean& is_attained, const Squared& squared) {
        while (!CGAL::certainly(squared >= least) && next < m_star_near.size())
          take_next();
        const Boolean is_kept = (squared >= least) | (!is_attained);
        is_sure = is_sure && CGAL::certainly(is_kept);
        are_all_kept = are_all_kept & is_kept;
      });
      return is_sure;
    };
    // Exact numbers are asked about the others alone.
    std::size_t left = 0;
    for (const Index i : m_sweeps_near) {
      if (!is_surely_kept(i))
        m_sweeps_near[left++] = i;
      if (CGAL::certainly_not(are_all_kept))
        break;
    }
    m_sweeps_near.resize(left);
    return are_all_kept;
  }

  template <class Distances, class Visit>
  static void visit(const Feature& feature, const std::vector<typename Distances::Point>& points,
                    const typename Distances::Triangle& f, const Visit& visit)
  {
    const auto &p = points[feature.corners[0]], &q = points[feature.corners[1]],
               &r = points[feature.corners[2]];
    if (feature.size == 1)
      Distances::template visit<1>({&p}, f, visit);
    else if (feature.size == 2)
      Distances::template visit<2>({&p, &q}, f, visit);
    else
      Distances::template visit<3>({&p, &q, &r}, f, visit);
  }

  double m_distance;
  std::vector<Point_3> m_points;               // of the motion: where it starts, where it goes, and the link
  std::vector<Feature> m_of_star, m_of_sweeps; // of the star before it, and what the sweeps have besides
  std::vector<typename Approximate::Point> m_approximate;
  std::vector<typename Exact::Point> m_exact;              // empty before they are needed
  std::vector<Index> m_star_near, m_sweeps_near, m_buffer; // buffers
  std::size_t m_exact_decisions = 0;
};

} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_CLEARANCE_H
