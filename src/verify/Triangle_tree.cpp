// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "verify/Triangle_tree.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <tuple>
#include <utility>

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

/// Returns whether a triangle is so thin, and its box with the corners `low` and `high` so wide in two
/// directions, that the box says little about it. A wrong answer costs time, and nothing else.
bool is_askew_sliver(const Point_3& a, const Point_3& b, const Point_3& c, const Capsule::Vector& low,
                     const Capsule::Vector& high)
{
  using internal::dot;
  const auto coordinates = [](const Point_3& p) { return Capsule::Vector{p.x(), p.y(), p.z()}; };
  const Capsule::Vector o = coordinates(a),
                        normal = internal::cross(internal::difference(coordinates(b), o),
                                                 internal::difference(coordinates(c), o)),
                        width = internal::difference(high, low);
  const double second =
      (std::max)((std::min)(width[0], width[1]), (std::min)((std::max)(width[0], width[1]), width[2]));
  constexpr double thin = 8; // the second width of the box, in widths of the triangle
  return second * second * dot(width, width) > thin * thin * dot(normal, normal);
}

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
    Box& box = m_boxes[i];
    for (int axis = 0; axis < 3; ++axis)
      std::tie(box.low[axis], box.high[axis]) =
          std::minmax({points[a][axis], points[b][axis], points[c][axis]});
    box.capsule = is_askew_sliver(points[a], points[b], points[c], box.low, box.high);
  });
  Box all;
  for (const Box& box : m_boxes)
    all.add(box);
  for (int axis = 0; axis < 3; ++axis)
    m_largest = (std::max)({m_largest, std::fabs(all.low[axis]), std::fabs(all.high[axis])});
  m_margin = Capsule::margin_for(m_largest);
  for (std::size_t i = 0; i < m_boxes.size(); ++i)
    if (std::exchange(m_boxes[i].capsule, 0) != 0) {
      const auto coordinates = [&](int corner) {
        const Point_3& p = points[triangles[m_triangles[i]][corner]];
        return Capsule::Vector{p.x(), p.y(), p.z()};
      };
      add_capsule(m_boxes[i], Capsule(coordinates(0), coordinates(1), coordinates(2), m_margin));
    }
  m_nodes.resize(2 * leaf_count);
  for (std::size_t node = 2 * leaf_count; --node > 0;) {
    if (node < leaf_count) {
      enclose(m_nodes[node], &m_nodes[2 * node], &m_nodes[2 * node] + 2);
    } else {
      const std::size_t leaf = node - leaf_count;
      enclose(m_nodes[node], m_boxes.data() + first_of(leaf), m_boxes.data() + first_of(leaf + 1));
    }
  }
}

Capsule Triangle_tree::capsule_around(const Box& box) const
{
  return box.capsule != 0 ? m_capsules[box.capsule] : Capsule(box.low, box.high, m_margin);
}

bool Triangle_tree::are_capsules_apart(const Box& a, const Box& b) const
{
  return are_apart(capsule_around(a), capsule_around(b));
}

bool Triangle_tree::is_capsule_beyond(const Point_3& query, const Box& box, double squared_bound) const
{
  const Capsule::Vector at{query.x(), query.y(), query.z()};
  // The query may lie outside of everything that the tree's own margin was made for.
  const double margin =
      Capsule::margin_for((std::max)({m_largest, std::fabs(at[0]), std::fabs(at[1]), std::fabs(at[2])}));
  return margin > 0 && are_apart(Capsule(at, at, std::sqrt(squared_bound) + margin), m_capsules[box.capsule]);
}

void Triangle_tree::add_capsule(Box& box, const Capsule& capsule)
{
  if (m_margin == 0 || !capsule.is_slender())
    return;
  box.capsule = m_capsules.size();
  m_capsules.push_back(capsule);
}

void Triangle_tree::enclose(Box& node, const Box* first, const Box* beyond)
{
  std::size_t any = 0;
  for (const Box* box = first; box != beyond; ++box) {
    node.add(*box);
    any |= box->capsule;
  }
  if (any == 0)
    return;
  Capsule capsule = capsule_around(*first);
  for (const Box* box = first + 1; box != beyond; ++box)
    capsule = Capsule(capsule, capsule_around(*box), m_margin);
  add_capsule(node, capsule);
}

} // namespace selvedge
