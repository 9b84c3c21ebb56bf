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

constexpr Index s_no_hub = std::numeric_limits<Index>::max();

/// Returns for each triangle the corner at which it belongs to a fan, or `s_no_hub`; nothing when there is no
/// fan. Fewer pairs than a fan has cost less than its cones.
std::vector<Index> find_hubs(std::size_t points, const std::vector<Index_triple>& triangles)
{
  constexpr Index least_fan = 16;
  if (triangles.size() < least_fan)
    return {};
  std::vector<Index> valence(points, 0);
  for (const Index_triple& triangle : triangles)
    for (const Index v : triangle)
      ++valence[v];
  if (*std::max_element(valence.begin(), valence.end()) < least_fan)
    return {};
  std::vector<Index> hubs;
  hubs.reserve(triangles.size());
  for (const Index_triple& triangle : triangles) {
    const Index hub = *std::max_element(triangle.begin(), triangle.end(),
                                        [&](Index a, Index b) { return valence[a] < valence[b]; });
    hubs.push_back(valence[hub] < least_fan ? s_no_hub : hub);
  }
  return hubs;
}

std::array<double, 3> coordinates(const Point_3& p)
{
  return {p.x(), p.y(), p.z()};
}

/// Returns a direction from the apex into a triangle, to sort a fan by.
std::array<double, 3> direction_into(const Index_triple& triangle, const std::vector<Point_3>& points,
                                     const std::array<double, 3>& apex)
{
  std::array<double, 3> sum{};
  for (const Index v : triangle) {
    const std::array<double, 3> side = internal::difference(coordinates(points[v]), apex);
    const double size = (std::max)({std::fabs(side[0]), std::fabs(side[1]), std::fabs(side[2])});
    for (int axis = 0; axis < 3; ++axis)
      if (const double share = side[axis] / size; std::isfinite(share))
        sum[axis] += share;
  }
  return sum;
}

/// Sorts parts that consist of one fan alone by direction, once the centres of its triangles are its apex.
template <class Direction>
void sort_fans(std::vector<Numbered_point>& centres, std::size_t parts, const std::vector<Index>& hubs,
               const Direction& direction, std::size_t first_part, std::size_t beyond_part)
{
  const auto first = centres.begin() + std::ptrdiff_t(centres.size() * first_part / parts);
  const auto beyond = centres.begin() + std::ptrdiff_t(centres.size() * beyond_part / parts);
  if (std::all_of(first, beyond, [&](const Numbered_point& centre) {
        return hubs[centre.number] != s_no_hub && centre.coordinates == first->coordinates;
      })) {
    std::for_each(first, beyond, [&](Numbered_point& centre) { centre.coordinates = direction(centre); });
    Halving(centres, parts).sort(first_part, beyond_part);
  } else if (beyond_part - first_part > 1) {
    const std::size_t middle_part = (first_part + beyond_part) / 2;
    sort_fans(centres, parts, hubs, direction, first_part, middle_part);
    sort_fans(centres, parts, hubs, direction, middle_part, beyond_part);
  }
}

} // namespace

void sort_by_halves(std::vector<Numbered_point>& points, std::size_t parts)
{
  Halving(points, parts).sort(0, parts);
}

Triangle_tree::Triangle_tree(const std::vector<Point_3>& points, const std::vector<Index_triple>& triangles,
                             Search search)
    : m_triangles(triangles.size()), m_boxes(triangles.size())
{
  const std::vector<Index> hubs =
      search == Search::pairs ? find_hubs(points.size(), triangles) : std::vector<Index>();
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
      if (!hubs.empty() && hubs[i] != s_no_hub)
        centres[i].coordinates = coordinates(points[hubs[i]]);
    });
    sort_by_halves(centres, leaf_count);
    if (!hubs.empty())
      sort_fans(
          centres, leaf_count, hubs,
          [&](const Numbered_point& centre) {
            return direction_into(triangles[centre.number], points, centre.coordinates);
          },
          0, leaf_count);
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
      const auto& [a, b, c] = triangles[m_triangles[i]];
      add_capsule(m_boxes[i],
                  Capsule(coordinates(points[a]), coordinates(points[b]), coordinates(points[c]), m_margin));
    }
  for (std::size_t i = 0; i < hubs.size(); ++i)
    if (const Index hub = hubs[m_triangles[i]]; hub != s_no_hub) {
      const Index_triple& triangle = triangles[m_triangles[i]];
      const std::size_t corner = std::find(triangle.begin(), triangle.end(), hub) - triangle.begin();
      const auto position = [&](std::size_t k) { return coordinates(points[triangle[(corner + k) % 3]]); };
      add_fan(m_boxes[i], {position(0), Cone(position(0), position(1), position(2))});
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

bool Triangle_tree::are_in_fan_apart(const Box& a, const Box& b) const
{
  const Fan &f = m_fans[a.fan - 1], &g = m_fans[b.fan - 1];
  return f.apex == g.apex && are_apart(f.cone, g.cone);
}

void Triangle_tree::add_fan(Box& box, const Fan& fan)
{
  m_fans.push_back(fan);
  box.fan = m_fans.size();
}

void Triangle_tree::enclose(Box& node, const Box* first, const Box* beyond)
{
  std::size_t any_capsule = 0;
  bool are_all_in_fans = first != beyond;
  for (const Box* box = first; box != beyond; ++box) {
    node.add(*box);
    any_capsule |= box->capsule;
    are_all_in_fans &= box->fan != 0;
  }
  if (any_capsule != 0)
    enclose_capsules(node, first, beyond);
  if (are_all_in_fans)
    enclose_fan(node, first, beyond);
}

void Triangle_tree::enclose_fan(Box& node, const Box* first, const Box* beyond)
{
  Fan fan = m_fans[first->fan - 1];
  for (const Box* box = first + 1; box != beyond; ++box) {
    const Fan& other = m_fans[box->fan - 1];
    if (other.apex != fan.apex)
      return;
    fan.cone.add(other.cone);
  }
  add_fan(node, fan);
}

void Triangle_tree::enclose_capsules(Box& node, const Box* first, const Box* beyond)
{
  Capsule capsule = capsule_around(*first);
  for (const Box* box = first + 1; box != beyond; ++box)
    capsule = Capsule(capsule, capsule_around(*box), m_margin);
  add_capsule(node, capsule);
}

} // namespace selvedge
