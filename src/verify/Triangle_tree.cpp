// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "verify/Triangle_tree.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>

#include <cmath>
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
    std::array<float, 3> low = first->coordinates, high = low;
    for (Iterator it = first; it != beyond; ++it)
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = (std::min)(low[axis], it->coordinates[axis]);
        high[axis] = (std::max)(high[axis], it->coordinates[axis]);
      }
    const std::array<float, 3> widths{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
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
std::array<float, 3> direction_into(const Index_triple& triangle, const std::vector<Point_3>& points,
                                    Index apex)
{
  std::array<double, 3> sum{};
  for (const Index v : triangle) {
    const std::array<double, 3> side =
        internal::difference(coordinates(points[v]), coordinates(points[apex]));
    const double size = (std::max)({std::fabs(side[0]), std::fabs(side[1]), std::fabs(side[2])});
    for (int axis = 0; axis < 3; ++axis)
      if (const double share = side[axis] / size; std::isfinite(share))
        sum[axis] += share;
  }
  return {float(sum[0]), float(sum[1]), float(sum[2])};
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

template <class Function>
void for_each_in_parallel(std::size_t count, const Function& function)
{
  Cancellation_scope::check();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        function(i);
                    });
}

} // namespace

void sort_by_halves(std::vector<Numbered_point>& points, std::size_t parts)
{
  Halving(points, parts).sort(0, parts);
}

Triangle_tree::Triangle_tree(const std::vector<Point_3>& points, const std::vector<Index_triple>& triangles,
                             Search search)
{
  if (triangles.empty())
    return;
  take_frame(points, triangles);
  const std::vector<Index> hubs =
      search == Search::pairs ? find_hubs(points.size(), triangles) : std::vector<Index>();
  std::size_t leaf_count = 1;
  while (4 * leaf_count < triangles.size())
    leaf_count *= 2;
  put_in_order(points, triangles, hubs, leaf_count);
  std::vector<char> is_askew(m_triangles.size(), false);
  m_levels.emplace_back().quads.resize(leaf_count);
  for_each_in_parallel(leaf_count, [&](std::size_t leaf) {
    Quad& quad = m_levels[0].quads[leaf];
    for (std::size_t k = 0; k < 4 && m_triangles[4 * leaf + k] != s_no_triangle; ++k) {
      const auto& [a, b, c] = triangles[m_triangles[4 * leaf + k]];
      Vector lows, highs;
      for (int axis = 0; axis < 3; ++axis) {
        std::tie(lows[axis], highs[axis]) = std::minmax({points[a][axis], points[b][axis], points[c][axis]});
        quad.low[axis][k] = lower(float(in_frame(lows[axis], axis)));
        quad.high[axis][k] = upper(float(in_frame(highs[axis], axis)));
      }
      is_askew[4 * leaf + k] = is_askew_sliver(points[a], points[b], points[c], lows, highs);
    }
  });
  while (m_levels.back().quads.size() > 1) {
    const std::size_t below = m_levels.size() - 1, count = m_levels[below].quads.size();
    m_levels.emplace_back().quads.resize((count + 3) / 4);
    for_each_in_parallel(count, [&](std::size_t box) {
      const Quad& quad = m_levels[below].quads[box];
      Quad& above = m_levels[below + 1].quads[box / 4];
      for (int axis = 0; axis < 3; ++axis) {
        above.low[axis][box % 4] = *std::min_element(quad.low[axis].begin(), quad.low[axis].end());
        above.high[axis][box % 4] = *std::max_element(quad.high[axis].begin(), quad.high[axis].end());
      }
    });
  }
  add_capsules(points, triangles, is_askew);
  add_fans(points, triangles, hubs);
}

// Gives each triangle a box of level 0.
void Triangle_tree::put_in_order(const std::vector<Point_3>& points,
                                 const std::vector<Index_triple>& triangles, const std::vector<Index>& hubs,
                                 std::size_t leaf_count)
{
  std::vector<Numbered_point> centres(triangles.size());
  for_each_in_parallel(triangles.size(), [&](std::size_t i) {
    const auto& [a, b, c] = triangles[i];
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({points[a][axis], points[b][axis], points[c][axis]});
      const double middle = hubs.empty() || hubs[i] == s_no_hub ? low / 2 + high / 2 : points[hubs[i]][axis];
      centres[i].coordinates[axis] = float(in_frame(middle, axis));
    }
    centres[i].number = Index(i);
  });
  sort_by_halves(centres, leaf_count);
  if (!hubs.empty())
    sort_fans(
        centres, leaf_count, hubs,
        [&](const Numbered_point& centre) {
          return direction_into(triangles[centre.number], points, hubs[centre.number]);
        },
        0, leaf_count);
  m_triangles.assign(4 * leaf_count, s_no_triangle);
  for_each_in_parallel(leaf_count, [&](std::size_t leaf) {
    const std::size_t first = centres.size() * leaf / leaf_count,
                      beyond = centres.size() * (leaf + 1) / leaf_count;
    for (std::size_t i = first; i < beyond; ++i)
      m_triangles[4 * leaf + (i - first)] = centres[i].number;
  });
}

// In plain loops, of which compilers make vector instructions.
unsigned Triangle_tree::are_met(const Quad& a, const Quad& b)
{
  std::array<unsigned, 16> met;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 4; ++i)
      met[4 * k + i] = unsigned(a.low[0][k] <= b.high[0][i]) & unsigned(b.low[0][i] <= a.high[0][k]) &
                       unsigned(a.low[1][k] <= b.high[1][i]) & unsigned(b.low[1][i] <= a.high[1][k]) &
                       unsigned(a.low[2][k] <= b.high[2][i]) & unsigned(b.low[2][i] <= a.high[2][k]);
  std::array<unsigned, 4> bits;
  for (std::size_t i = 0; i < 4; ++i)
    bits[i] = met[i] | met[4 + i] << 4 | met[8 + i] << 8 | met[12 + i] << 12;
  return bits[0] | bits[1] << 1 | bits[2] << 2 | bits[3] << 3;
}

void Triangle_tree::take_frame(const std::vector<Point_3>& points, const std::vector<Index_triple>& triangles)
{
  Vector low = coordinates(points[triangles[0][0]]), high = low;
  for (const Index_triple& triangle : triangles)
    for (const Index v : triangle)
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = (std::min)(low[axis], points[v][axis]);
        high[axis] = (std::max)(high[axis], points[v][axis]);
      }
  double widest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    m_origin[axis] = low[axis] / 2 + high[axis] / 2;
    widest = (std::max)({widest, m_origin[axis] - low[axis], high[axis] - m_origin[axis]});
  }
  int exponent = 0;
  std::frexp(widest, &exponent);
  // Within these, the unit is an ordinary number, and coordinates in it are those of a `float`.
  m_unit = std::ldexp(1, std::clamp(exponent, -1000, 1000));
}

Triangle_tree::Box Triangle_tree::box_around(const Point_3& query) const
{
  // A query far away is taken for one that is nearer, so that squares do not overflow.
  constexpr double far = 0x1p60;
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const float coordinate = float(std::clamp(in_frame(query[axis], axis), -far, far));
    box.low[axis] = lower(coordinate);
    box.high[axis] = upper(coordinate);
  }
  return box;
}

CGAL::Bbox_3 Triangle_tree::bbox(const Level& level, std::size_t box) const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Quad& quad = level.quads[box / 4];
  const auto low = [&](int axis) {
    return std::nextafter(m_origin[axis] + quad.low[axis][box % 4] * m_unit, -infinity);
  };
  const auto high = [&](int axis) {
    return std::nextafter(m_origin[axis] + quad.high[axis][box % 4] * m_unit, infinity);
  };
  return {low(0), low(1), low(2), high(0), high(1), high(2)};
}

Capsule Triangle_tree::capsule_around(const Level& level, std::size_t box) const
{
  if (level.capsules[box] != 0)
    return m_capsules[level.capsules[box]];
  const CGAL::Bbox_3 around = bbox(level, box);
  return Capsule({around.xmin(), around.ymin(), around.zmin()}, {around.xmax(), around.ymax(), around.zmax()},
                 m_margin);
}

bool Triangle_tree::are_capsules_apart(const Level& level, std::size_t a, std::size_t b) const
{
  return are_apart(capsule_around(level, a), capsule_around(level, b));
}

bool Triangle_tree::is_capsule_beyond(const Point_3& query, Index capsule, double squared_bound) const
{
  const Capsule::Vector at{query.x(), query.y(), query.z()};
  // The query may lie outside of everything that the tree's own margin was made for.
  const double margin =
      Capsule::margin_for((std::max)({m_largest, std::fabs(at[0]), std::fabs(at[1]), std::fabs(at[2])}));
  return margin > 0 && are_apart(Capsule(at, at, std::sqrt(squared_bound) + margin), m_capsules[capsule]);
}

bool Triangle_tree::are_in_fan_apart(Index a, Index b) const
{
  const Fan &f = m_fans[a - 1], &g = m_fans[b - 1];
  return f.apex == g.apex && are_apart(f.cone, g.cone);
}

void Triangle_tree::add_capsules(const std::vector<Point_3>& points,
                                 const std::vector<Index_triple>& triangles,
                                 const std::vector<char>& is_askew)
{
  const Level& top = m_levels.back();
  for (std::size_t k = 0; k < 4; ++k)
    if (!top.quads[0].is_empty(k)) {
      const CGAL::Bbox_3 box = bbox(top, k);
      for (int axis = 0; axis < 3; ++axis)
        m_largest = (std::max)({m_largest, std::fabs(box.min(axis)), std::fabs(box.max(axis))});
    }
  m_margin = Capsule::margin_for(m_largest);
  if (m_margin == 0)
    return;
  for (std::size_t box = 0; box < is_askew.size(); ++box) {
    if (is_askew[box] == 0)
      continue;
    const auto& [a, b, c] = triangles[m_triangles[box]];
    m_levels[0].number(&Level::capsules, box,
                       add_capsule(Capsule(coordinates(points[a]), coordinates(points[b]),
                                           coordinates(points[c]), m_margin)));
  }
  for (std::size_t level = 1; level < m_levels.size() && !m_levels[level - 1].capsules.empty(); ++level)
    for (std::size_t quad = 0; quad < m_levels[level - 1].quads.size(); ++quad)
      m_levels[level].number(&Level::capsules, quad, enclose_capsules(m_levels[level - 1], quad));
}

Index Triangle_tree::add_capsule(const Capsule& capsule)
{
  if (!capsule.is_slender())
    return 0;
  m_capsules.push_back(capsule);
  return Index(m_capsules.size() - 1);
}

Index Triangle_tree::enclose_capsules(const Level& level, std::size_t quad)
{
  const std::size_t first = 4 * quad;
  const auto capsules = level.capsules.begin() + std::ptrdiff_t(first);
  if (std::all_of(capsules, capsules + 4, [](Index capsule) { return capsule == 0; }))
    return 0;
  Capsule capsule = capsule_around(level, first);
  for (std::size_t k = 1; k < 4 && !level.quads[quad].is_empty(k); ++k)
    capsule = Capsule(capsule, capsule_around(level, first + k), m_margin);
  return add_capsule(capsule);
}

void Triangle_tree::add_fans(const std::vector<Point_3>& points, const std::vector<Index_triple>& triangles,
                             const std::vector<Index>& hubs)
{
  for (std::size_t box = 0; box < m_triangles.size() && !hubs.empty(); ++box) {
    if (m_triangles[box] == s_no_triangle || hubs[m_triangles[box]] == s_no_hub)
      continue;
    const Index_triple& triangle = triangles[m_triangles[box]];
    const std::size_t corner =
        std::find(triangle.begin(), triangle.end(), hubs[m_triangles[box]]) - triangle.begin();
    const auto position = [&](std::size_t k) { return coordinates(points[triangle[(corner + k) % 3]]); };
    m_levels[0].number(&Level::fans, box,
                       add_fan({position(0), Cone(position(0), position(1), position(2))}));
  }
  for (std::size_t level = 1; level < m_levels.size() && !m_levels[level - 1].fans.empty(); ++level)
    for (std::size_t quad = 0; quad < m_levels[level - 1].quads.size(); ++quad)
      m_levels[level].number(&Level::fans, quad, enclose_fans(m_levels[level - 1], quad));
}

Index Triangle_tree::add_fan(const Fan& fan)
{
  m_fans.push_back(fan);
  return Index(m_fans.size());
}

Index Triangle_tree::enclose_fans(const Level& level, std::size_t quad)
{
  const std::size_t first = 4 * quad;
  if (level.fans[first] == 0)
    return 0;
  Fan fan = m_fans[level.fans[first] - 1];
  for (std::size_t k = 1; k < 4 && !level.quads[quad].is_empty(k); ++k) {
    if (level.fans[first + k] == 0)
      return 0;
    const Fan& other = m_fans[level.fans[first + k] - 1];
    if (other.apex != fan.apex)
      return 0;
    fan.cone.add(other.cone);
  }
  return add_fan(fan);
}

} // namespace selvedge
