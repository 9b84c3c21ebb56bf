// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_TRIANGLE_TREE_H
#define SELVEDGE_SRC_VERIFY_TRIANGLE_TREE_H

#include "verify/Capsule.h"
#include "verify/Cone.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Triangle_soup.h>

#include <CGAL/Bbox_3.h>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace selvedge {

/// A point with a number, for `sort_by_halves`.
struct Numbered_point
{
  std::array<float, 3> coordinates;
  Index number;
};

/// Sorts points so that neighbours in the order are neighbours in space: halves them along their widest axis
/// until there are `parts` equal shares; `parts` is a power of two. The order depends on nothing but the
/// points.
void sort_by_halves(std::vector<Numbered_point>& points, std::size_t parts);

/// The boxes of triangles in a balanced tree whose nodes have four children. The judge finds in it pairs of
/// triangles that may meet, and triangles near a point. As many threads as oneTBB grants build the tree and
/// search for pairs; the answers do not depend on their number.
///
/// A box says little about a sliver askew to the axes: in a fringe, those of almost all threads meet. So such
/// a triangle has a capsule as well, and so has a node of the tree where the capsule is long and thin. The
/// searches ask them where boxes decide nothing.
///
/// Nor do boxes say anything about triangles that share a corner. So where very many do, a *fan*, the search
/// for pairs asks for their cones, and has a fan in the order of its directions.
///
/// **Exactness** Boxes consist of floats, rounded outwards: they contain what they enclose. Capsules and
/// cones leave out only what is proved apart.
class Triangle_tree
{
public:
  /// What is asked of a tree. All of them answer every question; one for pairs is slower to build.
  enum class Search { distances, pairs };

  /// Neither of the lists needs to outlive the tree.
  Triangle_tree(const std::vector<Point_3>& points, const std::vector<Index_triple>& triangles,
                Search search = Search::distances);

  /// Calls `function(i, j)` once for each pair of triangles that may meet, in no particular order and
  /// concurrently: those whose boxes meet, but for slivers that are proved apart, and triangles of a fan that
  /// are proved to meet only in the corner that all of it shares.
  template <class Function>
  void for_each_pair(const Function& function) const
  {
    if (!m_levels.empty())
      pairs_within(m_levels.size() - 1, 0, function);
  }

  /// Calls `function(i)` for each triangle whose box satisfies `is_wanted`, a predicate of `CGAL::Bbox_3`.
  /// Every box that contains a wanted box must be wanted too.
  template <class Is_wanted, class Function>
  void visit(const Is_wanted& is_wanted, const Function& function) const
  {
    if (!m_levels.empty())
      visit(is_wanted, function, m_levels.size() - 1, 0);
  }

  /// Calls `function(i)` for triangles whose boxes are nearer to `query` than the root of `squared_bound`,
  /// but for slivers that are proved farther away; as a rule nearer boxes first. The function lowers the
  /// bound when it finds something nearer.
  template <class Function>
  void approach(const Point_3& query, const double& squared_bound, const Function& function) const
  {
    if (!m_levels.empty())
      approach(query, box_around(query), squared_bound, function, m_levels.size() - 1, 0);
  }

private:
  using Vector = std::array<double, 3>;
  using Four = std::array<float, 4>;

  /// Four boxes by coordinate, so that they are asked at once. One that is not used is empty: it has its low
  /// corner above its high one.
  struct Quad
  {
    std::array<Four, 3> low = filled(s_infinity), high = filled(-s_infinity);

    bool is_empty(std::size_t k) const { return low[0][k] > high[0][k]; }

  private:
    static std::array<Four, 3> filled(float value)
    {
      const Four four{value, value, value, value};
      return {four, four, four};
    }
  };

  struct Box
  {
    std::array<float, 3> low, high;
  };

  /// Box 4 i + k of a level is number k of its quad i. It encloses the four of quad 4 i + k of the level
  /// below; on level 0, one triangle. The last level is one quad.
  struct Level
  {
    std::vector<Quad> quads;
    std::vector<Index> capsules, fans; // by box: a number, or 0 when it has none; empty when all have none

    void number(std::vector<Index> Level::*numbers, std::size_t box, Index number)
    {
      if (number == 0)
        return;
      std::vector<Index>& of_boxes = this->*numbers;
      if (of_boxes.empty())
        of_boxes.assign(4 * quads.size(), 0);
      of_boxes[box] = number;
    }
  };

  /// Triangles of one fan.
  struct Fan
  {
    Vector apex;
    Cone cone;
  };

  static constexpr float s_infinity = std::numeric_limits<float>::infinity();
  static constexpr Index s_no_triangle = std::numeric_limits<Index>::max();
  static constexpr std::size_t s_task_level = 5; // the first on which another task pays

  // Returns a bit 4 k + i for each box k of one quad that meets box i of another.
  static unsigned are_met(const Quad& a, const Quad& b);

  // Returns squared distances in the unit of the boxes. Rounding adds less than 2^-20 of them.
  static Four squared_distances(const Box& query, const Quad& quad)
  {
    const auto gap = [&](int axis, int i) {
      const float below = quad.low[axis][i] - query.high[axis], above = query.low[axis] - quad.high[axis][i];
      return (below > 0 ? below : 0) + (above > 0 ? above : 0);
    };
    Four distances;
    for (int i = 0; i < 4; ++i)
      distances[i] = gap(0, i) * gap(0, i) + gap(1, i) * gap(1, i) + gap(2, i) * gap(2, i);
    return distances;
  }

  static Index number_of(const std::vector<Index>& numbers, std::size_t box)
  {
    return numbers.empty() ? 0 : numbers[box];
  }

  // Returns whether two boxes that meet are not proved to enclose things apart.
  bool may_meet(const Level& level, std::size_t a, std::size_t b) const
  {
    return (level.fans.empty() || level.fans[a] == 0 || level.fans[b] == 0 ||
            !are_in_fan_apart(level.fans[a], level.fans[b])) &&
           (level.capsules.empty() || (level.capsules[a] | level.capsules[b]) == 0 ||
            !are_capsules_apart(level, a, b));
  }

  // Chooses the frame in which boxes are written: its origin and unit.
  void take_frame(const std::vector<Point_3>& points, const std::vector<Index_triple>& triangles);
  double in_frame(double coordinate, int axis) const { return (coordinate - m_origin[axis]) * (1 / m_unit); }
  // The bounds of a coordinate in the frame. Their room is more than rounding takes, in any mode: from the
  // coordinate itself, and from the square of a distance so small that it vanishes.
  static float lower(float coordinate) { return coordinate - room(coordinate); }
  static float upper(float coordinate) { return coordinate + room(coordinate); }
  static float room(float coordinate)
  {
    return (coordinate < 0 ? -coordinate : coordinate) * 0x1p-21f + 0x1p-70f;
  }
  Box box_around(const Point_3& query) const;
  CGAL::Bbox_3 bbox(const Level& level, std::size_t box) const;

  Capsule capsule_around(const Level& level, std::size_t box) const;
  bool is_capsule_beyond(const Point_3& query, Index capsule, double squared_bound) const;
  bool are_capsules_apart(const Level& level, std::size_t a, std::size_t b) const;
  bool are_in_fan_apart(Index a, Index b) const;

  void put_in_order(const std::vector<Point_3>& points, const std::vector<Index_triple>& triangles,
                    const std::vector<Index>& hubs, std::size_t leaf_count);
  void add_capsules(const std::vector<Point_3>& points, const std::vector<Index_triple>& triangles,
                    const std::vector<char>& is_askew);
  void add_fans(const std::vector<Point_3>& points, const std::vector<Index_triple>& triangles,
                const std::vector<Index>& hubs);
  // These return the number of what is added, which is 0 for a capsule that is not slender.
  Index add_capsule(const Capsule& capsule);
  Index add_fan(const Fan& fan);
  // These return the number of what encloses the four boxes of a quad, or 0 where that is none.
  Index enclose_capsules(const Level& level, std::size_t quad);
  Index enclose_fans(const Level& level, std::size_t quad);

  template <class Function>
  void pairs_within(std::size_t level, std::size_t quad, const Function& function) const
  {
    const Quad& boxes = m_levels[level].quads[quad];
    if (level > 0)
      in_turn_or_parallel(level, [&](std::size_t k) {
        if (!boxes.is_empty(k))
          pairs_within(level - 1, 4 * quad + k, function);
      });
    constexpr unsigned is_before = 0b0000'1000'1100'1110; // bit 4 k + i where k < i
    pairs_of(level, quad, quad, are_met(boxes, boxes) & is_before, function);
  }

  // What is in the boxes of two quads that the bits name.
  template <class Function>
  void pairs_of(std::size_t level, std::size_t a, std::size_t b, unsigned met, const Function& function) const
  {
    in_turn_or_parallel(level, [&](std::size_t k) {
      for (unsigned i = 0, left = met >> (4 * k) & 15; left != 0; ++i, left >>= 1)
        if ((left & 1) != 0)
          pair(level, 4 * a + k, 4 * b + i, function);
    });
  }

  // What is in two boxes that meet.
  template <class Function>
  void pair(std::size_t level, std::size_t a, std::size_t b, const Function& function) const
  {
    if (!may_meet(m_levels[level], a, b))
      return;
    if (level == 0) {
      function(m_triangles[a], m_triangles[b]);
      return;
    }
    const std::vector<Quad>& quads = m_levels[level - 1].quads;
    pairs_of(level - 1, a, b, are_met(quads[a], quads[b]), function);
  }

  template <class Task>
  static void in_turn_or_parallel(std::size_t level, const Task& task)
  {
    if (level < s_task_level) {
      for (std::size_t k = 0; k < 4; ++k)
        task(k);
    } else {
      Cancellation_scope::check();
      tbb::parallel_for(std::size_t(0), std::size_t(4), Cancellation_scope::inherited(task));
    }
  }

  template <class Is_wanted, class Function>
  void visit(const Is_wanted& is_wanted, const Function& function, std::size_t level, std::size_t quad) const
  {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t box = 4 * quad + k;
      if (m_levels[level].quads[quad].is_empty(k) || !is_wanted(bbox(m_levels[level], box)))
        continue;
      if (level == 0)
        function(m_triangles[box]);
      else
        visit(is_wanted, function, level - 1, box);
    }
  }

  template <class Function>
  void approach(const Point_3& query, const Box& around, const double& squared_bound,
                const Function& function, std::size_t level, std::size_t quad) const
  {
    Four distances = squared_distances(around, m_levels[level].quads[quad]);
    for (int turn = 0; turn < 4; ++turn) {
      const std::size_t k = std::min_element(distances.begin(), distances.end()) - distances.begin();
      if (!(double(distances[k]) * (1 - 0x1p-20) * m_unit * m_unit < squared_bound))
        return;
      distances[k] = s_infinity;
      const std::size_t box = 4 * quad + k;
      if (const Index capsule = number_of(m_levels[level].capsules, box);
          capsule != 0 && is_capsule_beyond(query, capsule, squared_bound))
        continue;
      if (level == 0)
        function(m_triangles[box]);
      else
        approach(query, around, squared_bound, function, level - 1, box);
    }
  }

  std::vector<Index> m_triangles; // by box of level 0
  std::vector<Level> m_levels;    // none when there are no triangles
  Vector m_origin{};
  double m_unit = 1;                  // of boxes; a power of two
  std::vector<Capsule> m_capsules{1}; // the first is nobody's
  std::vector<Fan> m_fans;            // by number less 1
  double m_largest = 0;               // of all coordinates
  double m_margin = 0;                // of capsules; none is made where it is 0
};

} // namespace selvedge

#endif // SELVEDGE_SRC_VERIFY_TRIANGLE_TREE_H
