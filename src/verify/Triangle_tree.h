// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_TRIANGLE_TREE_H
#define SELVEDGE_SRC_VERIFY_TRIANGLE_TREE_H

#include "verify/Capsule.h"
#include "verify/Cone.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Triangle_soup.h>

#include <CGAL/Bbox_3.h>

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace selvedge {

/// A point with a number, for `sort_by_halves`.
struct Numbered_point
{
  std::array<double, 3> coordinates;
  Index number;
};

/// Sorts points so that neighbours in the order are neighbours in space: halves them along their widest axis
/// until there are `parts` equal shares; `parts` is a power of two. The order depends on nothing but the
/// points.
void sort_by_halves(std::vector<Numbered_point>& points, std::size_t parts);

/// The boxes of triangles in a balanced binary tree. The judge finds in it pairs of triangles that may meet,
/// and triangles near a point. As many threads as oneTBB grants build the tree and search for pairs; the
/// answers do not depend on their number.
///
/// A box says little about a sliver askew to the axes: in a fringe, those of almost all threads meet. So such
/// a triangle has a capsule as well, and so has a node of the tree where the capsule is long and thin. The
/// searches ask them where boxes decide nothing.
///
/// Nor do boxes say anything about triangles that share a corner. So where very many do, a *fan*, the search
/// for pairs asks for their cones, and has a fan in the order of its directions.
///
/// **Exactness** Boxes are exact. Capsules and cones leave out only what is proved apart.
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
    pairs_within(1, m_triangles.size(), function);
  }

  /// Calls `function(i)` for each triangle whose box satisfies `is_wanted`, a predicate of `CGAL::Bbox_3`.
  /// Every box that contains a wanted box must be wanted too.
  template <class Is_wanted, class Function>
  void visit(const Is_wanted& is_wanted, const Function& function) const
  {
    if (!m_triangles.empty())
      visit(is_wanted, function, 1);
  }

  /// Calls `function(i)` for triangles whose boxes are nearer to `query` than the root of `squared_bound`,
  /// but for slivers that are proved farther away; as a rule nearer boxes first. The function lowers the
  /// bound when it finds something nearer.
  template <class Function>
  void approach(const Point_3& query, const double& squared_bound, const Function& function) const
  {
    if (!m_triangles.empty())
      approach(query, squared_bound, function, 1, squared_distance(query, m_nodes[1]));
  }

private:
  struct Box
  {
    std::array<double, 3> low{s_infinity, s_infinity, s_infinity};
    std::array<double, 3> high{-s_infinity, -s_infinity, -s_infinity};
    std::size_t capsule = 0; // its number, or 0 when it has none
    std::size_t fan = 0;     // likewise

    CGAL::Bbox_3 bbox() const { return {low[0], low[1], low[2], high[0], high[1], high[2]}; }

    void add(const Box& other)
    {
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = (std::min)(low[axis], other.low[axis]);
        high[axis] = (std::max)(high[axis], other.high[axis]);
      }
    }
  };

  static constexpr double s_infinity = std::numeric_limits<double>::infinity();
  /// Triangles of one fan.
  struct Fan
  {
    std::array<double, 3> apex;
    Cone cone;
  };

  static constexpr std::size_t s_leaf_size = 4;
  static constexpr std::size_t s_task_size = 4096; // triangles below which another task does not pay

  static bool overlap(const Box& a, const Box& b)
  {
    // Without branches, which would be mispredicted.
    const auto is_met = [&](int axis) {
      return int(a.low[axis] <= b.high[axis]) & int(b.low[axis] <= a.high[axis]);
    };
    return (is_met(0) & is_met(1) & is_met(2)) != 0;
  }

  bool may_meet(const Box& a, const Box& b) const
  {
    return overlap(a, b) && (a.fan == 0 || b.fan == 0 || !are_in_fan_apart(a, b)) &&
           ((a.capsule | b.capsule) == 0 || !are_capsules_apart(a, b));
  }

  // Whether `box` may hold something nearer to `query` than the root of `squared_bound`, from which it is a
  // `squared` distance away.
  bool may_be_near(const Point_3& query, const Box& box, double squared, double squared_bound) const
  {
    return squared < squared_bound && (box.capsule == 0 || !is_capsule_beyond(query, box, squared_bound));
  }

  Capsule capsule_around(const Box& box) const;
  bool is_capsule_beyond(const Point_3& query, const Box& box, double squared_bound) const;
  bool are_capsules_apart(const Box& a, const Box& b) const;
  bool are_in_fan_apart(const Box& a, const Box& b) const;

  // Gives a box the capsule around what is in it, if this is slender.
  void add_capsule(Box& box, const Capsule& capsule);

  void add_fan(Box& box, const Fan& fan);

  // Adds the boxes from `first` to `beyond` to a node, and gives it a capsule and a cone if they have some.
  void enclose(Box& node, const Box* first, const Box* beyond);
  void enclose_capsules(Box& node, const Box* first, const Box* beyond);
  void enclose_fan(Box& node, const Box* first, const Box* beyond);

  static double squared_distance(const Point_3& query, const Box& box)
  {
    double distance = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double gap = (std::max)({box.low[axis] - query[axis], 0.0, query[axis] - box.high[axis]});
      distance += gap * gap;
    }
    return distance;
  }

  std::size_t leaves() const { return m_nodes.size() / 2; }
  std::size_t first_of(std::size_t leaf) const { return m_triangles.size() * leaf / leaves(); }

  template <class Function>
  void for_each_in(std::size_t node, const Function& function) const
  {
    const std::size_t leaf = node - leaves(), beyond = first_of(leaf + 1);
    for (std::size_t i = first_of(leaf); i < beyond; ++i)
      function(i);
  }

  template <class Function>
  void pairs_within(std::size_t node, std::size_t size, const Function& function) const
  {
    if (size >= s_task_size)
      Cancellation_scope::check();
    if (node >= leaves()) {
      for_each_in(node, [&](std::size_t i) {
        for (std::size_t j = first_of(node - leaves()); j < i; ++j)
          if (may_meet(m_boxes[i], m_boxes[j]))
            function(m_triangles[i], m_triangles[j]);
      });
      return;
    }
    const std::size_t left = 2 * node, right = 2 * node + 1;
    in_turn_or_parallel(
        size, [&] { pairs_within(left, size / 2, function); },
        [&] { pairs_within(right, size / 2, function); },
        [&] { pairs_between(left, right, size / 2, function); });
  }

  // Both nodes are on one level.
  template <class Function>
  void pairs_between(std::size_t a, std::size_t b, std::size_t size, const Function& function) const
  {
    if (!may_meet(m_nodes[a], m_nodes[b]))
      return;
    if (a >= leaves()) {
      for_each_in(a, [&](std::size_t i) {
        if (may_meet(m_boxes[i], m_nodes[b]))
          for_each_in(b, [&](std::size_t j) {
            if (may_meet(m_boxes[i], m_boxes[j]))
              function(m_triangles[i], m_triangles[j]);
          });
      });
      return;
    }
    const auto children = [&](std::size_t i, std::size_t j) {
      return [&, i, j] { pairs_between(2 * a + i, 2 * b + j, size / 2, function); };
    };
    in_turn_or_parallel(size, children(0, 0), children(0, 1), children(1, 0), children(1, 1));
  }

  template <class... Tasks>
  static void in_turn_or_parallel(std::size_t size, const Tasks&... tasks)
  {
    if (size < s_task_size)
      (tasks(), ...);
    else
      tbb::parallel_invoke(Cancellation_scope::inherited(tasks)...);
  }

  template <class Is_wanted, class Function>
  void visit(const Is_wanted& is_wanted, const Function& function, std::size_t node) const
  {
    if (!is_wanted(m_nodes[node].bbox()))
      return;
    if (node < leaves()) {
      visit(is_wanted, function, 2 * node);
      visit(is_wanted, function, 2 * node + 1);
    } else {
      for_each_in(node, [&](std::size_t i) {
        if (is_wanted(m_boxes[i].bbox()))
          function(m_triangles[i]);
      });
    }
  }

  template <class Function>
  void approach(const Point_3& query, const double& squared_bound, const Function& function, std::size_t node,
                double distance) const
  {
    while (node < leaves()) {
      if (!may_be_near(query, m_nodes[node], distance, squared_bound))
        return;
      const double left = squared_distance(query, m_nodes[2 * node]);
      const double right = squared_distance(query, m_nodes[2 * node + 1]);
      const std::size_t nearer = right < left;
      approach(query, squared_bound, function, 2 * node + nearer, (std::min)(left, right));
      node = 2 * node + !nearer;
      distance = (std::max)(left, right);
    }
    if (may_be_near(query, m_nodes[node], distance, squared_bound))
      for_each_in(node, [&](std::size_t i) {
        if (may_be_near(query, m_boxes[i], squared_distance(query, m_boxes[i]), squared_bound))
          function(m_triangles[i]);
      });
  }

  std::vector<Index> m_triangles; // in the order of the leaves, each of which has an equal share
  std::vector<Box> m_boxes;       // in the same order
  std::vector<Box> m_nodes;       // node k has the children 2k and 2k + 1, all leaves are on the last level
  std::vector<Capsule> m_capsules{1}; // the first is nobody's
  std::vector<Fan> m_fans;            // by number less 1
  double m_largest = 0;               // of all coordinates
  double m_margin = 0;                // of capsules; none is made where it is 0
};

} // namespace selvedge

#endif // SELVEDGE_SRC_VERIFY_TRIANGLE_TREE_H
