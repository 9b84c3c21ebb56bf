// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface_distances.h"

#include <selvedge/Cancellation_scope.h>

#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace selvedge::internal {
namespace {

constexpr double s_infinity = std::numeric_limits<double>::infinity();

struct Box
{
  std::array<double, 3> low{s_infinity, s_infinity, s_infinity};
  std::array<double, 3> high{-s_infinity, -s_infinity, -s_infinity};

  void add(const Box& other)
  {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = (std::min)(low[axis], other.low[axis]);
      high[axis] = (std::max)(high[axis], other.high[axis]);
    }
  }
};

double squared_distance(const Box& a, const Box& b)
{
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double gap = (std::max)({a.low[axis] - b.high[axis], 0.0, b.low[axis] - a.high[axis]});
    sum += gap * gap;
  }
  return sum;
}

/// The boxes of triangles in a balanced binary tree, in which a node knows whether all of its triangles are
/// of one surface: a search for other surfaces passes it by.
class Surfaces_in_space
{
public:
  Surfaces_in_space(const std::vector<Point_3>& points, const std::vector<Index_triple>& triangles,
                    const std::vector<Index>& surface_of, std::size_t count)
      : m_points(points), m_triangles(triangles), m_surface_of(surface_of), m_boxes(triangles.size()),
        m_order(triangles.size()), m_squared(count, s_infinity), m_nearest(count, s_mixed)
  {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (const Index v : triangles[t]) {
        const Point_3& p = points[v];
        m_boxes[t].add({{p.x(), p.y(), p.z()}, {p.x(), p.y(), p.z()}});
      }
    std::iota(m_order.begin(), m_order.end(), Index(0));
    m_nodes.reserve(2 * triangles.size() / s_leaf_size + 2);
    build(0, Index(m_order.size()));
  }

  void touch(Index a, Index b) { lower(a, b, 0); }

  std::vector<Surface_distance> run()
  {
    Cancellation_poll poll;
    for (const Index triangle : m_order) {
      poll();
      search(triangle, 0);
    }
    std::vector<Surface_distance> result;
    for (std::size_t s = 0; s < m_squared.size(); ++s)
      result.push_back({std::sqrt(m_squared[s]), m_nearest[s]});
    return result;
  }

private:
  static constexpr Index s_mixed = std::numeric_limits<Index>::max();
  static constexpr Index s_leaf_size = 4;

  struct Node
  {
    Box box;
    Index surface; // of all triangles below, or `s_mixed`
    Index first, beyond;
    Index right = 0; // the left child follows its parent; a leaf has no right one
  };

  Index build(Index first, Index beyond)
  {
    const Index number = Index(m_nodes.size());
    Node node{{}, m_surface_of[m_order[first]], first, beyond};
    Box centres;
    for (Index i = first; i < beyond; ++i) {
      const Index t = m_order[i];
      node.box.add(m_boxes[t]);
      if (m_surface_of[t] != node.surface)
        node.surface = s_mixed;
      const Box& box = m_boxes[t];
      Box centre;
      for (int axis = 0; axis < 3; ++axis)
        centre.low[axis] = centre.high[axis] = box.low[axis] + box.high[axis];
      centres.add(centre);
    }
    m_nodes.push_back(node);
    if (beyond - first <= s_leaf_size)
      return number;
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (centres.high[i] - centres.low[i] > centres.high[axis] - centres.low[axis])
        axis = i;
    const Index middle = first + (beyond - first) / 2;
    const auto centre = [&](Index t) { return m_boxes[t].low[axis] + m_boxes[t].high[axis]; };
    std::nth_element(
        m_order.begin() + first, m_order.begin() + middle, m_order.begin() + beyond,
        [&](Index a, Index b) { return std::make_pair(centre(a), a) < std::make_pair(centre(b), b); });
    build(first, middle);
    const Index right = build(middle, beyond);
    m_nodes[number].right = right;
    return number;
  }

  void search(Index triangle, Index number)
  {
    const Node& node = m_nodes[number];
    const Index surface = m_surface_of[triangle];
    if (node.surface == surface || squared_distance(m_boxes[triangle], node.box) >= m_squared[surface])
      return;
    if (node.right == 0) {
      for (Index i = node.first; i < node.beyond; ++i) {
        const Index other = m_order[i];
        if (m_surface_of[other] != surface &&
            squared_distance(m_boxes[triangle], m_boxes[other]) < m_squared[surface] &&
            !is_beyond_plane(triangle, other, m_squared[surface]) &&
            !is_beyond_plane(other, triangle, m_squared[surface]))
          lower(surface, m_surface_of[other],
                (std::max)(squared_distance_of(triangle, other), std::numeric_limits<double>::min()));
      }
      return;
    }
    const auto distance = [&](Index child) {
      return squared_distance(m_boxes[triangle], m_nodes[child].box);
    };
    const bool is_right_nearer = distance(node.right) < distance(number + 1);
    search(triangle, is_right_nearer ? node.right : number + 1);
    search(triangle, is_right_nearer ? number + 1 : node.right);
  }

  void lower(Index a, Index b, double squared)
  {
    for (const auto& [surface, other] : {std::pair(a, b), std::pair(b, a)})
      if (squared < m_squared[surface]) {
        m_squared[surface] = squared;
        m_nearest[surface] = other;
      }
  }

  // Whether a triangle lies on one side of the plane of another, and nowhere nearer to it than the root of
  // `squared`, by more than rounding. Where layers are parallel, this spares most of the distances.
  bool is_beyond_plane(Index of_plane, Index triangle, double squared) const
  {
    const auto& [a, b, c] = m_triangles[of_plane];
    const Kernel::Vector_3 normal = CGAL::cross_product(m_points[b] - m_points[a], m_points[c] - m_points[a]);
    const double squared_length = normal.squared_length();
    if (!(squared_length > 0))
      return false;
    int sides = 0;
    for (const Index v : m_triangles[triangle]) {
      const Kernel::Vector_3 off = m_points[v] - m_points[a];
      const double height = normal * off;
      constexpr double rounding = 1e-12;
      const double least = std::abs(height) - rounding * std::sqrt(squared_length * off.squared_length());
      if (!(least > 0 && least * least >= squared * squared_length))
        return false;
      sides += height > 0 ? 1 : -1;
    }
    return std::abs(sides) == 3;
  }

  // Of two triangles that do not meet, the least distance is that of two edges, or of a corner and a face.
  double squared_distance_of(Index a, Index b) const
  {
    double least = s_infinity;
    const auto point = [this](Index triangle, int corner) -> const Point_3& {
      return m_points[m_triangles[triangle][corner % 3]];
    };
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        least = (std::min)(
            least, CGAL::to_double(CGAL::squared_distance(Kernel::Segment_3(point(a, i), point(a, i + 1)),
                                                          Kernel::Segment_3(point(b, j), point(b, j + 1)))));
    for (const auto& [face, other] : {std::pair(a, b), std::pair(b, a)}) {
      const Kernel::Triangle_3 triangle(point(face, 0), point(face, 1), point(face, 2));
      if (!triangle.is_degenerate())
        for (int i = 0; i < 3; ++i)
          least = (std::min)(least, CGAL::to_double(CGAL::squared_distance(point(other, i), triangle)));
    }
    return least;
  }

  const std::vector<Point_3>& m_points;
  const std::vector<Index_triple>& m_triangles;
  const std::vector<Index>& m_surface_of;
  std::vector<Box> m_boxes;
  std::vector<Index> m_order;
  std::vector<Node> m_nodes;
  std::vector<double> m_squared; // by surface
  std::vector<Index> m_nearest;
};

} // namespace

std::vector<Surface_distance> surface_distances(const std::vector<Point_3>& points,
                                                const std::vector<Index_triple>& triangles,
                                                const std::vector<Index>& surface_of, std::size_t count,
                                                const std::vector<Offending_pair>& pairs)
{
  Surfaces_in_space surfaces(points, triangles, surface_of, count);
  for (const Offending_pair& pair : pairs)
    if (surface_of[pair.first] != surface_of[pair.second])
      surfaces.touch(surface_of[pair.first], surface_of[pair.second]);
  return surfaces.run();
}

} // namespace selvedge::internal
