// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/part_report.h>

#include "soup/Disjoint_sets.h"
#include "soup/texture.h"
#include "verify/Diagonal.h"
#include "verify/for_each_chunk.h"

#include <selvedge/Cancellation_scope.h>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace selvedge {
namespace {

using Uv = std::array<double, 2>;
using Triangle_3 = Kernel::Triangle_3;

constexpr std::size_t s_pieces_reported = 100;

// Returns the diagonal of the soup, divided by the scale as all points in this file; 1 if it is 0.
double diagonal(const Triangle_soup& soup, const Scale& scale)
{
  std::vector<Point_3> points;
  for (const Index vertex : internal::used_vertices(soup))
    points.push_back(scale(soup.points[vertex]));
  const double length = internal::diagonal(points);
  return length > 0 ? length : 1;
}

std::array<Uv, 3> uvs_of(const Triangle_soup& soup, Index t)
{
  const Index_triple& uv = soup.uvs.of_triangle[t];
  return {soup.uvs.values[uv[0]], soup.uvs.values[uv[1]], soup.uvs.values[uv[2]]};
}

Triangle_3 triangle_of(const Triangle_soup& soup, Index t, const Scale& scale)
{
  const auto& [a, b, c] = soup.triangles[t];
  return {scale(soup.points[a]), scale(soup.points[b]), scale(soup.points[c])};
}

// Returns a number for the chart of each triangle.
std::vector<Index> charts_of(const Triangle_soup& soup)
{
  const std::vector<Index> pieces = part_kinds(soup).front().of_triangle;
  internal::Disjoint_sets connected(soup.uvs.values.size());
  for (const auto& [a, b, c] : soup.uvs.of_triangle) {
    connected.unite(a, b);
    connected.unite(b, c);
  }
  std::unordered_map<std::uint64_t, Index> numbers;
  std::vector<Index> charts;
  charts.reserve(soup.triangles.size());
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    const std::uint64_t chart = std::uint64_t(pieces[t]) << 32 | connected.find(soup.uvs.of_triangle[t][0]);
    charts.push_back(numbers.emplace(chart, Index(numbers.size())).first->second);
  }
  return charts;
}

/// The triangles of one chart of a result. Finds the texture coordinates at points near it.
class Chart
{
public:
  void insert(const Triangle_3& triangle, const std::array<Uv, 3>& uvs)
  {
    if (triangle.is_degenerate())
      return;
    const Index first = Index(m_soup.points.size());
    for (int place = 0; place < 3; ++place)
      m_soup.points.push_back(triangle[place]);
    m_soup.triangles.push_back({first, first + 1, first + 2});
    m_uvs.push_back(uvs);
  }

  /// Called after the last `insert`. Afterwards the chart must not be moved.
  void build()
  {
    m_surface.emplace(m_soup, 0);
    m_tree.emplace(*m_surface);
  }
  bool empty() const { return m_uvs.empty(); }

  /// Returns the texture coordinates at the point that is nearest to `query`. The search starts from the
  /// triangle `guess`, which becomes the one that was found.
  Uv uv_near(const Point_3& query, Index& guess) const
  {
    const auto nearest = m_tree->nearest(query, guess);
    guess = nearest.triangle;
    const Triangle_3 t = m_surface->triangle(nearest.triangle);
    const std::array<Uv, 3>& uv = m_uvs[nearest.triangle];
    const Kernel::Vector_3 normal = m_surface->normal(nearest.triangle);
    const double area = normal.squared_length();
    const auto share = [&](int i, int j) {
      return normal * CGAL::cross_product(t[i] - nearest.point, t[j] - nearest.point) / area;
    };
    const double a = share(1, 2), b = share(2, 0), c = 1 - a - b;
    return {a * uv[0][0] + b * uv[1][0] + c * uv[2][0], a * uv[0][1] + b * uv[1][1] + c * uv[2][1]};
  }

private:
  Triangle_soup m_soup;
  std::vector<std::array<Uv, 3>> m_uvs;
  std::optional<internal::Surface> m_surface;
  std::optional<internal::Surface_tree> m_tree;
};

// Returns for each triangle of the original how far the texture at its centre is displaced, as a share of the
// diagonal. Empty when there is no texture.
std::vector<double> uv_displacements(const Simplified_soup& result, const Prepared_soup& prepared)
{
  const Triangle_soup& original = prepared.soup;
  std::vector<double> displacements;
  const double unit = uv_unit(original, prepared.scale) / diagonal(original, prepared.scale);
  if (!(unit > 0))
    return displacements;
  const std::vector<Index> charts_of_original = charts_of(original);
  std::map<Index, Chart> charts;
  for (Index i = 0; i < result.triangles.size(); ++i)
    charts[charts_of_original[result.triangles[i]]].insert(triangle_of(result.soup, i, prepared.scale),
                                                           uvs_of(result.soup, i));
  for (auto& [number, chart] : charts)
    chart.build();

  displacements.assign(original.triangles.size(), 0);
  // Files mostly have neighbours one after the other, so that the last answer is a good guess at the next.
  const auto measure = [&](std::size_t, std::size_t first, std::size_t beyond) {
    auto chart = charts.end();
    Index guess = 0;
    for (Index t = Index(first); t < beyond; ++t) {
      if (chart == charts.end() || chart->first != charts_of_original[t]) {
        chart = charts.find(charts_of_original[t]);
        guess = 0;
      }
      if (!original.uvs.has(t) || chart == charts.end() || chart->second.empty())
        continue;
      const auto [a, b, c] = uvs_of(original, t);
      const Triangle_3 triangle = triangle_of(original, t, prepared.scale);
      const Uv now = chart->second.uv_near(CGAL::centroid(triangle[0], triangle[1], triangle[2]), guess);
      displacements[t] =
          unit * std::hypot(now[0] - (a[0] + b[0] + c[0]) / 3, now[1] - (a[1] + b[1] + c[1]) / 3);
    }
  };
  internal::for_each_chunk(original.triangles.size(), 1024, measure);
  return displacements;
}

std::optional<Uv_deviation> deviation_of(const std::vector<double>& displacements,
                                         const Prepared_soup& original, const std::vector<Index>& triangles)
{
  double area = 0, sum = 0, maximum = 0;
  for (const Index t : triangles) {
    if (displacements.empty() || !original.soup.uvs.has(t))
      continue;
    const double weight = std::sqrt(triangle_of(original.soup, t, original.scale).squared_area());
    area += weight;
    sum += weight * displacements[t];
    maximum = std::max(maximum, displacements[t]);
  }
  if (!(area > 0))
    return std::nullopt;
  return Uv_deviation{sum / area, maximum};
}

std::optional<Uv_deviation> deviation_of_all(const std::vector<double>& displacements,
                                             const Prepared_soup& original)
{
  std::vector<Index> all(original.soup.triangles.size());
  std::iota(all.begin(), all.end(), Index(0));
  return deviation_of(displacements, original, all);
}

/// Returns the geometry of each part, as a soup of its own. `of_part` says which triangles it is made of.
std::vector<Triangle_soup> cut_out(const Triangle_soup& soup, const Scale& scale,
                                   const std::vector<Part_triangles>& parts,
                                   std::vector<Index> Part_triangles::*of_part)
{
  constexpr Index none = std::numeric_limits<Index>::max();
  std::vector<Index> last_users(soup.points.size(), none), numbers(soup.points.size());
  std::vector<Triangle_soup> cuts(parts.size());
  for (Index i = 0; i < parts.size(); ++i)
    for (const Index t : parts[i].*of_part) {
      Index_triple corners = soup.triangles[t];
      for (Index& v : corners) {
        if (last_users[v] != i) {
          last_users[v] = i;
          numbers[v] = Index(cuts[i].points.size());
          cuts[i].points.push_back(scale(soup.points[v]));
        }
        v = numbers[v];
      }
      cuts[i].triangles.push_back(corners);
    }
  return cuts;
}

} // namespace

std::optional<Uv_deviation> uv_deviation(const Simplified_soup& result, const Prepared_soup& original)
{
  return deviation_of_all(uv_displacements(result, original), original);
}

std::vector<Part_triangles> triangles_of_parts(const Part_kind& kind, const Simplified_soup& result)
{
  std::vector<Part_triangles> parts(kind.count);
  for (Index t = 0; t < kind.of_triangle.size(); ++t)
    parts[kind.of_triangle[t]].before.push_back(t);
  for (Index i = 0; i < result.triangles.size(); ++i)
    parts[kind.of_triangle[result.triangles[i]]].after.push_back(i);
  return parts;
}

std::vector<Part_distance> part_distances(const Simplified_soup& result, const Prepared_soup& original,
                                          const std::vector<Part_triangles>& parts)
{
  const std::vector<Triangle_soup> before =
                                       cut_out(original.soup, original.scale, parts, &Part_triangles::before),
                                   after =
                                       cut_out(result.soup, original.scale, parts, &Part_triangles::after);
  std::vector<Part_distance> distances(parts.size());
  const auto measure = [&](std::size_t i) {
    distances[i] = {distance(before[i], after[i]), internal::diagonal(before[i].points)};
  };
  tbb::parallel_for(std::size_t(0), parts.size(), Cancellation_scope::inherited(measure));
  return distances;
}

Part_reports part_reports(const Simplified_soup& result, const Prepared_soup& original)
{
  const std::vector<double> displacements = uv_displacements(result, original);
  const double unit = diagonal(original.soup, original.scale);
  const std::vector<Part_kind> kinds = part_kinds(original.soup);
  Part_reports all{{}, deviation_of_all(displacements, original)};
  std::vector<Part_report>& reports = all.parts;
  std::map<std::vector<Index>, std::size_t> report_of; // what is a part of two kinds is measured once
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const Part_kind& kind = kinds[k];
    std::vector<Part_triangles> triangles = triangles_of_parts(kind, result);
    std::vector<Index> parts(kind.count);
    std::iota(parts.begin(), parts.end(), Index(0));
    if (kind.name == Part_kind::Name::piece && parts.size() > s_pieces_reported) {
      std::stable_sort(parts.begin(), parts.end(), [&](Index a, Index b) {
        return triangles[a].before.size() > triangles[b].before.size();
      });
      parts.resize(s_pieces_reported);
    }
    parts.erase(std::remove_if(parts.begin(), parts.end(),
                               [&](Index part) { return triangles[part].before.empty(); }),
                parts.end());
    std::vector<Part_triangles> unmeasured;
    std::vector<std::size_t> their_reports;
    for (const Index part : parts) {
      Part_report report{kind.name,
                         kind.names.empty() ? "" : kind.names[part],
                         triangles[part].before.front(),
                         triangles[part].before.size(),
                         triangles[part].after.size(),
                         result.refused_by_part[k][part],
                         {},
                         {}};
      const auto [known, is_new] = report_of.emplace(triangles[part].before, reports.size());
      if (is_new) {
        unmeasured.push_back(std::move(triangles[part]));
        their_reports.push_back(reports.size());
      } else {
        report.distance = reports[known->second].distance;
        report.uv_deviation = reports[known->second].uv_deviation;
      }
      reports.push_back(std::move(report));
    }
    const std::vector<Part_distance> distances = part_distances(result, original, unmeasured);
    for (std::size_t i = 0; i < unmeasured.size(); ++i) {
      Part_report& report = reports[their_reports[i]];
      report.distance = distances[i].distance;
      report.distance.root_mean_square /= unit;
      report.distance.maximum /= unit;
      report.uv_deviation = deviation_of(displacements, original, unmeasured[i].before);
    }
  }
  return all;
}

} // namespace selvedge
