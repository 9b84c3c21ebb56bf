// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "keeps_shading.h"

#include <selvedge/internal/Vector_of_doubles.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace selvedge {
namespace {

using Vector = internal::Vector_of_doubles;

// The corners of a face, at their places.
struct Shaded_face
{
  std::array<Point_3, 3> points;
  std::array<Vector, 3> normals;

  Shaded_face(const Corner_mesh& corners, const Placed_vertices& placed, Corner_mesh::Halfedge h, Index ply)
  {
    const Corner_mesh::Mesh& mesh = corners.mesh();
    for (const Corner_mesh::Halfedge g : {h, mesh.next(h), mesh.prev(h)}) {
      points[corners.place(g)] = mesh.point(mesh.target(g));
      normals[corners.place(g)] = placed.normal_at(corners.corner_at(g, ply));
    }
  }

  // Returns the least and the largest component of a normal towards the front, at some scale.
  std::pair<double, double> sides() const
  {
    const auto edge = [this](std::size_t i) {
      return Vector{points[i].x() - points[0].x(), points[i].y() - points[0].y(),
                    points[i].z() - points[0].z()};
    };
    const Vector front = internal::cross(edge(1), edge(2));
    return std::minmax({internal::dot(front, normals[0]), internal::dot(front, normals[1]),
                        internal::dot(front, normals[2])});
  }

  bool is_shaded_alike(std::size_t place, const Point_3& point, const Vector& normal) const
  {
    Shaded_face after = *this;
    after.points[place] = point;
    after.normals[place] = normal;
    const auto [least, largest] = sides();
    return !(least > 0 && after.sides().first < 0) && !(largest < 0 && after.sides().second > 0);
  }
};

} // namespace

bool keeps_shading(const Corner_mesh& corners, const Placed_vertices& placed, Corner_mesh::Halfedge moving,
                   const Border_rule<Corner_mesh::Mesh>& rule)
{
  const Corner_mesh::Mesh& mesh = corners.mesh();
  const Point_3& goal = mesh.point(mesh.target(moving));
  bool is_kept = true;
  corners.for_each_changed_face(moving, rule, [&](Corner_mesh::Halfedge h, Corner_mesh::Halfedge from) {
    const Index plies = corners.ply_count(mesh.face(h));
    for (Index i = 0; is_kept && i < plies; ++i)
      is_kept = Shaded_face(corners, placed, h, i)
                    .is_shaded_alike(corners.place(h), goal, placed.normal_at(corners.corner_at(from, i)));
  });
  return is_kept;
}

bool keeps_shading_at(const Corner_mesh& corners, const Placed_vertices& placed, Corner_mesh::Halfedge moving,
                      const Point_3& place)
{
  const Vector normal = placed.normal_at(moving, place);
  bool is_kept = true;
  corners.for_each_changed_face(moving, [&](Corner_mesh::Halfedge h) {
    is_kept = is_kept && Shaded_face(corners, placed, h, 0).is_shaded_alike(corners.place(h), place, normal);
  });
  return is_kept;
}

} // namespace selvedge
