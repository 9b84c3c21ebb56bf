// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/part_report.h>

#include <selvedge/mesh/selection.h>
#include <selvedge/mesh/texture.h>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace selvedge {
namespace {

using Uv = std::array<double, 2>;
using Triangle_3 = Kernel::Triangle_3;

constexpr std::size_t s_pieces_reported = 100;

double diagonal(const Triangle_soup& soup)
{
  CGAL::Bbox_3 box;
  for (const Index_triple& triangle : soup.triangles)
    for (const Index v : triangle)
      box += soup.points[v].bbox();
  const double length = std::hypot(box.x_span(), box.y_span(), box.z_span());
  return length > 0 ? length : 1;
}

std::array<Uv, 3> uvs_of(const Triangle_soup& soup, Index t)
{
  const Index_triple& uv = soup.uvs.of_triangle[t];
  return {soup.uvs.values[uv[0]], soup.uvs.values[uv[1]], soup.uvs.values[uv[2]]};
}

Triangle_3 triangle_of(const Triangle_soup& soup, Index t)
{
  const auto& [a, b, c] = soup.triangles[t];
  return {soup.points[a], soup.points[b], soup.points[c]};
}

bool has_texture(const Triangle_soup& soup, Index t)
{
  return !soup.uvs.missing || soup.uvs.of_triangle[t][0] != *soup.uvs.missing;
}

// The chart of each triangle, numbered anyhow.
std::vector<Index> charts_of(const Triangle_soup& soup)
{
  const std::vector<Index> pieces = part_kinds(soup).front().of_triangle;
  std::vector<Index> parents(soup.uvs.values.size());
  std::iota(parents.begin(), parents.end(), Index(0));
  const auto root = [&](Index i) {
    while (parents[i] != i)
      i = parents[i] = parents[parents[i]];
    return i;
  };
  for (const auto& [a, b, c] : soup.uvs.of_triangle) {
    parents[root(a)] = root(b);
    parents[root(b)] = root(c);
  }
  std::map<std::pair<Index, Index>, Index> numbers;
  std::vector<Index> charts;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    charts.push_back(
        numbers.emplace(std::make_pair(pieces[t], root(soup.uvs.of_triangle[t][0])), Index(numbers.size()))
            .first->second);
  return charts;
}

/// The triangles of one chart of a result, to find the texture at points near it.
class Chart
{
public:
  void insert(const Triangle_3& triangle, const std::array<Uv, 3>& uvs)
  {
    if (triangle.is_degenerate())
      return;
    m_triangles.push_back(triangle);
    m_uvs.push_back(uvs);
  }

  void build() { m_tree.rebuild(m_triangles.begin(), m_triangles.end()); }
  bool empty() const { return m_triangles.empty(); }

  Uv uv_near(const Point_3& query) const
  {
    const auto [point, place] = m_tree.closest_point_and_primitive(query);
    const Triangle_3& t = *place;
    const std::array<Uv, 3>& uv = m_uvs[place - m_triangles.begin()];
    const Kernel::Vector_3 normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
    const double area = normal.squared_length();
    const auto share = [&](int i, int j) {
      return normal * CGAL::cross_product(t[i] - point, t[j] - point) / area;
    };
    const double a = share(1, 2), b = share(2, 0), c = 1 - a - b;
    return {a * uv[0][0] + b * uv[1][0] + c * uv[2][0], a * uv[0][1] + b * uv[1][1] + c * uv[2][1]};
  }

private:
  using Iterator = std::vector<Triangle_3>::const_iterator;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Iterator>;

  std::vector<Triangle_3> m_triangles;
  std::vector<std::array<Uv, 3>> m_uvs;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> m_tree;
};

// For each triangle of the original, how far the texture at its centre has swum, as a share of the diagonal;
// empty when there is no texture.
std::vector<double> uv_displacements(const Simplified_soup& result, const Prepared_soup& prepared)
{
  const Triangle_soup& original = prepared.soup;
  std::vector<double> displacements;
  const double unit = uv_unit(original) / diagonal(original);
  if (!(unit > 0))
    return displacements;
  const std::vector<Index> charts_of_original = charts_of(original);
  std::map<Index, Chart> charts;
  for (Index i = 0; i < result.triangles.size(); ++i)
    charts[charts_of_original[result.triangles[i]]].insert(triangle_of(result.soup, i),
                                                           uvs_of(result.soup, i));
  for (auto& [number, chart] : charts)
    chart.build();

  displacements.assign(original.triangles.size(), 0);
  for (Index t = 0; t < original.triangles.size(); ++t) {
    const auto chart = charts.find(charts_of_original[t]);
    if (!has_texture(original, t) || chart == charts.end() || chart->second.empty())
      continue;
    const auto [a, b, c] = uvs_of(original, t);
    const Triangle_3 triangle = triangle_of(original, t);
    const Uv now = chart->second.uv_near(CGAL::centroid(triangle[0], triangle[1], triangle[2]));
    displacements[t] =
        unit * std::hypot(now[0] - (a[0] + b[0] + c[0]) / 3, now[1] - (a[1] + b[1] + c[1]) / 3);
  }
  return displacements;
}

std::optional<Uv_deviation> deviation_of(const std::vector<double>& displacements, const Triangle_soup& soup,
                                         const std::vector<Index>& triangles)
{
  double area = 0, sum = 0, maximum = 0;
  for (const Index t : triangles) {
    if (displacements.empty() || !has_texture(soup, t))
      continue;
    const double weight = std::sqrt(triangle_of(soup, t).squared_area());
    area += weight;
    sum += weight * displacements[t];
    maximum = std::max(maximum, displacements[t]);
  }
  if (!(area > 0))
    return std::nullopt;
  return Uv_deviation{sum / area, maximum};
}

Triangle_soup geometry_of(const Triangle_soup& soup)
{
  Triangle_soup geometry;
  geometry.points = soup.points;
  geometry.triangles = soup.triangles;
  return geometry;
}

Triangle_soup only(const Triangle_soup& geometry, const std::vector<Index>& triangles)
{
  std::vector<Index_triple> corners;
  for (const Index t : triangles)
    corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  return selected(geometry, triangles, corners);
}

} // namespace

std::optional<Uv_deviation> uv_deviation(const Simplified_soup& result, const Prepared_soup& original)
{
  std::vector<Index> all(original.soup.triangles.size());
  std::iota(all.begin(), all.end(), Index(0));
  return deviation_of(uv_displacements(result, original), original.soup, all);
}

std::vector<Part_report> part_reports(const Simplified_soup& result, const Prepared_soup& original)
{
  const std::vector<double> displacements = uv_displacements(result, original);
  const double unit = diagonal(original.soup);
  const std::vector<Part_kind> kinds = part_kinds(original.soup);
  const Triangle_soup geometry_before = geometry_of(original.soup), geometry_after = geometry_of(result.soup);
  std::vector<Part_report> reports;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const Part_kind& kind = kinds[k];
    std::vector<std::vector<Index>> triangles_before(kind.count), triangles_after(kind.count);
    for (Index t = 0; t < kind.of_triangle.size(); ++t)
      triangles_before[kind.of_triangle[t]].push_back(t);
    for (Index i = 0; i < result.triangles.size(); ++i)
      triangles_after[kind.of_triangle[result.triangles[i]]].push_back(i);

    std::vector<Index> parts(kind.count);
    std::iota(parts.begin(), parts.end(), Index(0));
    if (kind.name == Part_kind::Name::piece && parts.size() > s_pieces_reported) {
      std::stable_sort(parts.begin(), parts.end(), [&](Index a, Index b) {
        return triangles_before[a].size() > triangles_before[b].size();
      });
      parts.resize(s_pieces_reported);
    }
    for (const Index part : parts) {
      if (triangles_before[part].empty())
        continue;
      Part_report report{kind.name,
                         kind.names.empty() ? "" : kind.names[part],
                         triangles_before[part].front(),
                         triangles_before[part].size(),
                         triangles_after[part].size(),
                         result.refused_by_part[k][part],
                         distance(only(geometry_before, triangles_before[part]),
                                  only(geometry_after, triangles_after[part])),
                         deviation_of(displacements, original.soup, triangles_before[part])};
      report.distance.root_mean_square /= unit;
      report.distance.maximum /= unit;
      reports.push_back(std::move(report));
    }
  }
  return reports;
}

} // namespace selvedge
