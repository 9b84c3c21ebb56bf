// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Placed_vertices.h"

#include "selection.h"

#include <selvedge/internal/Vector_of_doubles.h>

#include <optional>

namespace selvedge {
namespace {

/// The point of a triangle that is nearest to another point.
struct Nearest_point
{
  std::array<double, 3> weights; ///< of the corners
  double squared_distance;
};

// Computed in floating point, in the order of the corners given (Ericson: Real-Time Collision Detection,
// section 5.1.5).
Nearest_point nearest_point(const std::array<internal::Vector_of_doubles, 3>& corners,
                            const internal::Vector_of_doubles& p)
{
  using internal::difference;
  using internal::dot;
  const auto& [a, b, c] = corners;
  const auto ab = difference(b, a), ac = difference(c, a), ap = difference(p, a), bp = difference(p, b),
             cp = difference(p, c);
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  const double of_c = d1 * d4 - d3 * d2, of_b = d5 * d2 - d1 * d6, of_a = d3 * d6 - d5 * d4;
  std::array<double, 3> weights{};
  if (d1 <= 0 && d2 <= 0)
    weights = {1, 0, 0};
  else if (d3 >= 0 && d4 <= d3)
    weights = {0, 1, 0};
  else if (d6 >= 0 && d5 <= d6)
    weights = {0, 0, 1};
  else if (of_c <= 0 && d1 >= 0 && d3 <= 0)
    weights = {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  else if (of_b <= 0 && d2 >= 0 && d6 <= 0)
    weights = {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  else if (of_a <= 0 && d4 >= d3 && d5 >= d6)
    weights = {0, 1 - (d4 - d3) / (d4 - d3 + d5 - d6), (d4 - d3) / (d4 - d3 + d5 - d6)};
  else {
    const double sum = of_a + of_b + of_c;
    weights = {1 - of_b / sum - of_c / sum, of_b / sum, of_c / sum};
  }
  internal::Vector_of_doubles off;
  for (std::size_t i = 0; i < 3; ++i)
    off[i] = p[i] - (weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i]);
  return {weights, dot(off, off)};
}

} // namespace

const Placed_vertices::Placed_vertex* Placed_vertices::find(Index corner) const
{
  if (m_placed.empty())
    return nullptr;
  const auto found = m_placed.find(m_corners.vertex_of(corner));
  return found == m_placed.end() ? nullptr : &found->second;
}

Placed_vertices::Uv Placed_vertices::uv_at(Index corner) const
{
  const Placed_vertex* const placed = find(corner);
  return placed ? m_values->uv(placed->values) : m_corners.uv_of(corner);
}

Placed_vertices::Uv Placed_vertices::uv_at(Halfedge moving, const Point_3& place) const
{
  const Mixture mixture = mixture_at(moving, place);
  return m_values->mixed_uv(mixture.shares, mixture.own);
}

std::array<double, 3> Placed_vertices::normal_at(Index corner) const
{
  const Placed_vertex* const placed = find(corner);
  return placed ? m_values->normal(placed->values) : m_corners.normal_of(corner);
}

void Placed_vertices::merge_at(Halfedge moving, const Point_3& place, const Point_3& point)
{
  const Mixture mixture = mixture_at(moving, place);
  Vertex_values::Numbers values = m_values->mixed(mixture.shares, mixture.own);
  const auto [removed, kept] = m_corners.ends_in_soup(moving);
  m_placed.erase(removed);
  m_placed[kept] = {point, std::move(values)};
}

Vertex_values::Share Placed_vertices::share(Index corner, double weight) const
{
  const Placed_vertex* const placed = find(corner);
  return {corner, weight, placed ? &placed->values : nullptr};
}

// Returns the mixture that the faces around both ends of an edge have at the point nearest to a place. The
// result does not depend on the order of halfedges around a vertex, so that it is the same in a cell and in
// the whole.
Placed_vertices::Mixture Placed_vertices::mixture_at(Halfedge moving, const Point_3& place) const
{
  const Vertex_values::Share own = share(m_corners.corner_at(moving), 1);
  if (m_values->is_empty())
    return {{own, share(own.corner, 0), share(own.corner, 0)}, own};
  const Corner_mesh::Mesh& mesh = m_corners.mesh();
  const auto vector = [](const Point_3& p) { return internal::Vector_of_doubles{p.x(), p.y(), p.z()}; };
  std::optional<Nearest_point> nearest;
  Corner_mesh::Face face;
  for (const Halfedge end : {moving, mesh.opposite(moving)})
    for (const Halfedge h : mesh.halfedges_around_target(end)) {
      std::array<internal::Vector_of_doubles, 3> corners;
      for (const Halfedge g : {h, mesh.next(h), mesh.prev(h)})
        corners[m_corners.place(g)] = vector(mesh.point(mesh.target(g)));
      const Nearest_point here = nearest_point(corners, vector(place));
      if (!nearest || std::make_pair(here.squared_distance, mesh.face(h)) <
                          std::make_pair(nearest->squared_distance, face)) {
        nearest = here;
        face = mesh.face(h);
      }
    }
  const auto share_of = [&](std::size_t k) { return share(m_corners.corners(face)[k], nearest->weights[k]); };
  return {{share_of(0), share_of(1), share_of(2)}, own};
}

std::size_t Placed_vertices::put(const std::vector<Index_triple>& corners, Triangle_soup& result) const
{
  if (m_placed.empty())
    return 0;
  std::size_t count = 0;
  const std::vector<Point_3> points_before = result.points;
  Vertex_values::Of_vertices values(result.points.size(), nullptr);
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (const Placed_vertex* const placed = find(corners[t][k])) {
        const Index vertex = result.triangles[t][k];
        count += !values[vertex];
        result.points[vertex] = placed->point;
        values[vertex] = &placed->values;
      }
  forget_moved_polygons(result, points_before);
  m_values->put(values, result);
  return count;
}

} // namespace selvedge
