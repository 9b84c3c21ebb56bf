// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "verify/Triangle_tree.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <tuple>

namespace selvedge {
namespace {

/// Sorts points for `sort_by_halves`, which orders the leaves of the judge's trees of boxes.
class Halving
{
public:
  Halving(std::vector<Numbered_point>& points, std::size_t parts) : m_points(points), m_parts(parts) {}

  void sort(std::size_t first_part, std::size_t beyond_part) const
  {
    if (beyond_part - first_part < 2)
      return;
    const std::size_t middle_part = (first_part + beyond_part) / 2;
    const auto first = place(first_part), middle = place(middle_part), beyond = place(beyond_part);
    const int axis = widest_axis(first, beyond);
    std::nth_element(first, middle, beyond, [axis](const Numbered_point& a, const Numbered_point& b) {
      return a.coordinates[axis] < b.coordinates[axis];
    });
    if (beyond - first < s_task_size) {
      sort(first_part, middle_part);
      sort(middle_part, beyond_part);
    } else {
      Cancellation_scope::check();
      tbb::parallel_invoke(Cancellation_scope::inherited([=] { sort(first_part, middle_part); }),
                           Cancellation_scope::inherited([=] { sort(middle_part, beyond_part); }));
    }
  }

private:
  using Iterator = std::vector<Numbered_point>::iterator;

  static constexpr std::ptrdiff_t s_task_size = 4096; // points below which another task does not pay

  Iterator place(std::size_t part) const
  {
    return m_points.begin() + std::ptrdiff_t(m_points.size() * part / m_parts);
  }

  static int widest_axis(Iterator first, Iterator beyond)
  {
    if (first == beyond)
      return 0;
    std::array<double, 3> low = first->coordinates, high = low;
    for (Iterator it = first; it != beyond; ++it)
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = (std::min)(low[axis], it->coordinates[axis]);
        high[axis] = (std::max)(high[axis], it->coordinates[axis]);
      }
    const std::array<double, 3> widths{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    return int(std::max_element(widths.begin(), widths.end()) - widths.begin());
  }

  std::vector<Numbered_point>& m_points;
  std::size_t m_parts;
};

} // namespace

void sort_by_halves(std::vector<Numbered_point>& points, std::size_t parts)
{
  Halving(points, parts).sort(0, parts);
}

Triangle_tree::Triangle_tree(const std::vector<Point_3>& points, const std::vector<Index_triple>& triangles)
    : m_triangles(triangles.size()), m_boxes(triangles.size())
{
  std::size_t leaf_count = 1;
  while (leaf_count * s_leaf_size < triangles.size())
    leaf_count *= 2;
  const auto for_each_triangle = [&](const auto& function) {
    Cancellation_scope::check();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), s_task_size),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t i = range.begin(); i < range.end(); ++i)
                          function(i);
                      });
  };
  {
    std::vector<Numbered_point> centres(triangles.size());
    for_each_triangle([&](std::size_t i) {
      const auto& [a, b, c] = triangles[i];
      for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({points[a][axis], points[b][axis], points[c][axis]});
        centres[i].coordinates[axis] = low / 2 + high / 2;
      }
      centres[i].number = Index(i);
    });
    sort_by_halves(centres, leaf_count);
    for_each_triangle([&](std::size_t i) { m_triangles[i] = centres[i].number; });
  }
  for_each_triangle([&](std::size_t i) {
    const auto& [a, b, c] = triangles[m_triangles[i]];
    for (int axis = 0; axis < 3; ++axis)
      std::tie(m_boxes[i].low[axis], m_boxes[i].high[axis]) =
          std::minmax({points[a][axis], points[b][axis], points[c][axis]});
  });
  m_nodes.resize(2 * leaf_count);
  for (std::size_t node = 2 * leaf_count; --node > 0;)
    if (node < leaf_count) {
      m_nodes[node] = m_nodes[2 * node];
      m_nodes[node].add(m_nodes[2 * node + 1]);
    } else {
      for_each_in(node, [&](std::size_t i) { m_nodes[node].add(m_boxes[i]); });
    }
}

} // namespace selvedge
