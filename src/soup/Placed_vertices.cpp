// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Placed_vertices.h"

#include "selection.h"

#include <selvedge/internal/Vector_of_doubles.h>
#include <selvedge/internal/nearest_on_triangle.h>

#include <optional>

namespace selvedge {

const Placed_vertices::Placed_vertex* Placed_vertices::find(Index corner) const
{
  return has_any() ? m_placed[m_corners.vertex_of(corner)].get() : nullptr;
}

Placed_vertices::Uv Placed_vertices::uv_at(Index corner) const
{
  const Placed_vertex* const placed = find(corner);
  return placed ? m_values->uv(placed->values) : m_corners.uv_of(corner);
}

Placed_vertices::Uv Placed_vertices::uv_at(Halfedge moving, const Point_3& place) const
{
  const Mixture& mixture = mixture_at(moving, place);
  return m_values->mixed_uv(mixture.shares, mixture.own);
}

std::array<double, 3> Placed_vertices::normal_at(Index corner) const
{
  const Placed_vertex* const placed = find(corner);
  return placed ? m_values->normal(placed->values) : m_corners.normal_of(corner);
}

void Placed_vertices::merge_at(Halfedge moving, const Point_3& place, const Point_3& point)
{
  const Mixture& mixture = mixture_at(moving, place);
  Vertex_values::Numbers values = m_values->mixed(mixture.shares, mixture.own);
  m_last.reset(); // it refers to values of vertices that are placed
  const auto [removed, kept] = m_corners.ends_in_soup(moving);
  m_placed.resize(m_corners.soup().points.size());
  m_placed[removed].reset();
  m_placed[kept] = std::make_unique<Placed_vertex>(Placed_vertex{point, std::move(values)});
}

Vertex_values::Share Placed_vertices::share(Index corner, double weight) const
{
  const Placed_vertex* const placed = find(corner);
  return {corner, weight, placed ? &placed->values : nullptr};
}

const Placed_vertices::Mixture& Placed_vertices::mixture_at(Halfedge moving, const Point_3& place) const
{
  const std::size_t count = m_corners.collapse_count();
  if (!m_last || m_last->moving != moving || m_last->place != place || m_last->collapse_count != count)
    m_last = {moving, place, count, computed_mixture_at(moving, place)};
  return m_last->mixture;
}

// Returns the mixture that the faces around both ends of an edge have at the point nearest to a place. The
// result does not depend on the order of halfedges around a vertex, so that it is the same in a cell and in
// the whole.
Placed_vertices::Mixture Placed_vertices::computed_mixture_at(Halfedge moving, const Point_3& place) const
{
  const Vertex_values::Share own = share(m_corners.corner_at(moving), 1);
  if (m_values->is_empty())
    return {{own, share(own.corner, 0), share(own.corner, 0)}, own};
  const Corner_mesh::Mesh& mesh = m_corners.mesh();
  const auto vector = [](const Point_3& p) { return internal::Vector_of_doubles{p.x(), p.y(), p.z()}; };
  std::optional<internal::Nearest_on_triangle> nearest;
  Corner_mesh::Face face;
  for (const Halfedge end : {moving, mesh.opposite(moving)})
    for (const Halfedge h : mesh.halfedges_around_target(end)) {
      std::array<internal::Vector_of_doubles, 3> corners;
      for (const Halfedge g : {h, mesh.next(h), mesh.prev(h)})
        corners[m_corners.place(g)] = vector(mesh.point(mesh.target(g)));
      const internal::Nearest_on_triangle here = internal::nearest_on_triangle(corners, vector(place));
      if (!nearest || std::make_pair(here.squared_distance, mesh.face(h)) <
                          std::make_pair(nearest->squared_distance, face)) {
        nearest = here;
        face = mesh.face(h);
      }
    }
  const auto share_of = [&](std::size_t k) { return share(m_corners.corners(face)[k], nearest->weights[k]); };
  return {{share_of(0), share_of(1), share_of(2)}, own};
}

std::vector<char> Placed_vertices::put(const std::vector<Index_triple>& corners, Triangle_soup& result) const
{
  if (!has_any())
    return {};
  std::vector<char> is_placed(result.points.size(), false);
  const std::vector<Point_3> points_before = result.points;
  Vertex_values::Of_vertices values(result.points.size(), nullptr);
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (const Placed_vertex* const placed = find(corners[t][k])) {
        const Index vertex = result.triangles[t][k];
        is_placed[vertex] = true;
        result.points[vertex] = placed->point;
        values[vertex] = &placed->values;
      }
  forget_moved_polygons(result, points_before);
  m_values->put(values, result);
  return is_placed;
}

} // namespace selvedge
