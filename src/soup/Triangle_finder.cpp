// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Triangle_finder.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace selvedge {
namespace {

using internal::difference;
using internal::dot;

constexpr std::size_t s_triangles_per_leaf = 1; // the nearest point of one costs more than four boxes

// Of a squared distance, where coordinates are at most 2.
constexpr double s_rounding = 1e-28;

// Returns the weights of the corners for the point of a triangle that is nearest to a point (Ericson 2005,
// section 5.1.5).
std::array<double, 3> weights_of_nearest(const Triangle_finder::Corners& corners,
                                         const Triangle_finder::Vector& query)
{
  const auto& [a, b, c] = corners;
  const auto ab = difference(b, a), ac = difference(c, a);
  const auto from_a = difference(query, a), from_b = difference(query, b), from_c = difference(query, c);
  const double d1 = dot(ab, from_a), d2 = dot(ac, from_a);
  if (d1 <= 0 && d2 <= 0)
    return {1, 0, 0};
  const double d3 = dot(ab, from_b), d4 = dot(ac, from_b);
  if (d3 >= 0 && d4 <= d3)
    return {0, 1, 0};
  const double of_c = d1 * d4 - d3 * d2;
  if (of_c <= 0 && d1 >= 0 && d3 <= 0) {
    const double share = d1 / (d1 - d3);
    return {1 - share, share, 0};
  }
  const double d5 = dot(ab, from_c), d6 = dot(ac, from_c);
  if (d6 >= 0 && d5 <= d6)
    return {0, 0, 1};
  const double of_b = d5 * d2 - d1 * d6;
  if (of_b <= 0 && d2 >= 0 && d6 <= 0) {
    const double share = d2 / (d2 - d6);
    return {1 - share, 0, share};
  }
  const double of_a = d3 * d6 - d5 * d4;
  if (of_a <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double share = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - share, share};
  }
  const double sum = of_a + of_b + of_c;
  return {of_a / sum, of_b / sum, of_c / sum};
}

} // namespace

Triangle_finder::Triangle_finder(std::vector<Corners> triangles, const std::vector<std::size_t>& surfaces)
    : m_triangles(std::move(triangles)), m_order(m_triangles.size())
{
  std::iota(m_order.begin(), m_order.end(), Index(0));
  std::stable_sort(m_order.begin(), m_order.end(),
                   [&](Index a, Index b) { return surfaces[a] < surfaces[b]; });
  for (std::size_t first = 0, beyond; first < m_order.size(); first = beyond) {
    const std::size_t surface = surfaces[m_order[first]];
    beyond = first + 1;
    while (beyond < m_order.size() && surfaces[m_order[beyond]] == surface)
      ++beyond;
    m_roots.emplace(surface, m_nodes.size());
    m_nodes.push_back({box_around(first, beyond), first, beyond, 0});
    Cancellation_poll poll;
    for (std::size_t node = m_nodes.size() - 1; node < m_nodes.size(); ++node) {
      poll();
      divide(node);
    }
  }
}

std::optional<Triangle_finder::Nearest> Triangle_finder::nearest(const Vector& query, std::size_t surface,
                                                                 const Vector& direction) const
{
  const auto root = m_roots.find(surface);
  if (root == m_roots.end())
    return std::nullopt;
  Search search{query, {}, std::numeric_limits<double>::infinity(), {}};
  visit(root->second, search);
  if (!search.found || is_towards(search.found->triangle, direction))
    return search.found;
  // It belongs to the other side of thin cloth, say, or of a sheet that has triangles for both of its sides.
  constexpr double s_much_farther = 16;
  Search towards{query, direction, s_much_farther * search.squared + s_rounding, {}};
  visit(root->second, towards);
  return towards.found;
}

bool Triangle_finder::is_towards(Index triangle, const Vector& direction) const
{
  const auto& [a, b, c] = m_triangles[triangle];
  return dot(internal::cross(difference(b, a), difference(c, a)), direction) > 0;
}

void Triangle_finder::divide(std::size_t number)
{
  const Node node = m_nodes[number];
  if (node.beyond - node.first <= s_triangles_per_leaf)
    return;
  std::size_t axis = 0;
  const auto extent = [&](std::size_t i) { return node.box.high[i] - node.box.low[i]; };
  for (std::size_t i = 1; i < 3; ++i)
    if (extent(i) > extent(axis))
      axis = i;
  const auto centre = [&](Index triangle) {
    const auto& [a, b, c] = m_triangles[triangle];
    return a[axis] + b[axis] + c[axis];
  };
  const std::size_t middle = (node.first + node.beyond) / 2;
  const auto at = [&](std::size_t place) { return m_order.begin() + std::ptrdiff_t(place); };
  std::nth_element(at(node.first), at(middle), at(node.beyond), [&](Index a, Index b) {
    return std::make_pair(centre(a), a) < std::make_pair(centre(b), b);
  });
  m_nodes[number].left = m_nodes.size();
  m_nodes.push_back({box_around(node.first, middle), node.first, middle, 0});
  m_nodes.push_back({box_around(middle, node.beyond), middle, node.beyond, 0});
}

Triangle_finder::Box Triangle_finder::box_around(std::size_t first, std::size_t beyond) const
{
  Box box{m_triangles[m_order[first]][0], m_triangles[m_order[first]][0]};
  for (std::size_t i = first; i < beyond; ++i)
    for (const Vector& corner : m_triangles[m_order[i]])
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], corner[axis]);
        box.high[axis] = std::max(box.high[axis], corner[axis]);
      }
  return box;
}

void Triangle_finder::visit(std::size_t number, Search& search) const
{
  const Node& node = m_nodes[number];
  if (node.left == 0) {
    for (std::size_t i = node.first; i < node.beyond; ++i) {
      if (search.direction && !is_towards(m_order[i], *search.direction))
        continue;
      const Corners& corners = m_triangles[m_order[i]];
      const std::array<double, 3> weights = weights_of_nearest(corners, search.query);
      Vector apart = search.query;
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis)
          apart[axis] -= weights[k] * corners[k][axis];
      if (const double squared = dot(apart, apart); squared < search.squared) {
        search.squared = squared;
        search.found = Nearest{m_order[i], weights};
      }
    }
    return;
  }
  std::array<std::pair<double, std::size_t>, 2> children;
  for (std::size_t i = 0; i < 2; ++i)
    children[i] = {squared_distance(search.query, m_nodes[node.left + i].box), node.left + i};
  if (children[1] < children[0])
    std::swap(children[0], children[1]);
  for (const auto& [squared, child] : children)
    if (squared < search.squared)
      visit(child, search);
}

double Triangle_finder::squared_distance(const Vector& query, const Box& box)
{
  double squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max({box.low[axis] - query[axis], 0.0, query[axis] - box.high[axis]});
    squared += gap * gap;
  }
  return squared;
}

} // namespace selvedge
