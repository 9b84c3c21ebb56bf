// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Working_mesh.h"

#include "selection.h"

#include <selvedge/Cancellation_scope.h>

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace selvedge {

Working_mesh::Working_mesh(const Triangle_soup& soup, const std::vector<Index>& positions,
                           const std::vector<char>& is_frozen, const Triangle_soup& obstacle,
                           const Scale& scale, const std::vector<char>& is_turned,
                           const std::vector<Index>& fronts)
    : Sewn_mesh(soup, positions, is_frozen, obstacle, scale, is_turned, fronts), m_scale(scale),
      m_placed(*this)
{
}

Working_mesh::Working_mesh(const Working_mesh& whole, const Border_rule<Mesh>& rule,
                           const std::vector<Index>& faces)
    : Sewn_mesh(whole, rule, faces), m_scale(whole.m_scale), m_placed(*this, whole.m_placed.values()),
      m_rounding(whole.m_rounding), m_uv_unit(whole.m_uv_unit), m_normal_unit(whole.m_normal_unit),
      m_vertex_normals(whole.m_vertex_normals)
{
  find_wedges();
}

void Working_mesh::share(std::vector<Shared_mesh> meshes, double clearance)
{
  if (meshes.empty())
    return;
  m_shared.emplace(*this, std::move(meshes), clearance);
  set_held_elsewhere(m_shared->lock_in_all_places(constraints()));
}

void Working_mesh::measure_uvs(double unit)
{
  m_uv_unit = soup().uvs.empty() ? 0 : unit;
}

void Working_mesh::measure_normals(double unit, std::shared_ptr<const Vertex_normals> normals)
{
  m_normal_unit = unit;
  m_vertex_normals = std::move(normals);
}

void Working_mesh::find_wedges()
{
  if (own_face_count() == 0)
    return;
  tbb::parallel_invoke(Cancellation_scope::inherited([this] {
                         if (m_uv_unit > 0)
                           m_texture.emplace(*this, m_scale, constraints(), m_uv_unit);
                       }),
                       Cancellation_scope::inherited([this] {
                         if (m_normal_unit > 0)
                           m_shading.emplace(*this, m_scale, constraints(), m_normal_unit,
                                             m_vertex_normals.get());
                       }));
}

void Working_mesh::allow_new_places(bool is_float32)
{
  m_placed.set_values(std::make_shared<Vertex_values>(soup()));
  m_rounding.emplace(soup(), m_scale, is_float32);
}

void Working_mesh::count_refusals()
{
  const std::vector<Part_kind> kinds = part_kinds(soup());
  m_refused.clear();
  for (const Part_kind& kind : kinds)
    m_refused.emplace_back(kind.count);
  // Labels say of each triangle to which parts it belongs; and of pieces, each vertex does.
  std::vector<Index> piece_of_vertex(soup().points.size(), 0);
  for (Index t = 0; t < soup().triangles.size(); ++t)
    for (const Index v : soup().triangles[t])
      piece_of_vertex[v] = kinds.front().of_triangle[t];
  m_piece_of_vertex = internal::Packed_numbers(piece_of_vertex);
}

void Working_mesh::before_collapse(Halfedge moving, const Border_rule<Mesh>& rule)
{
  if (m_recorder)
    m_recorder({side(moving), std::nullopt});
  if (m_listener || m_placed.has_any()) {
    const auto [removed, kept] = ends_in_soup(moving);
    if (m_listener)
      m_listener({removed, kept, std::nullopt});
    m_placed.erase(removed);
  }
  carry_all(moving, rule);
}

// Gives the corners that move the corners of the goal.
void Working_mesh::carry_all(Halfedge moving, const Border_rule<Mesh>& rule)
{
  if (m_progression)
    m_progression->record_moves(moving);
  for_each_measure([&](auto& wedges) { wedges.merge(moving); });
  for_each_changed_face(moving, rule, [this](Halfedge h, Halfedge from) { carry(h, from); });
  carry_places(moving);
}

void Working_mesh::before_placement(Halfedge moving, const Point_3& place, bool is_mover_first)
{
  const auto [removed, kept] = ends_in_soup(moving);
  const Point_3 point = m_scale.undone(place);
  if (m_recorder)
    m_recorder({side(moving), place, is_mover_first});
  if (m_listener)
    m_listener({removed, kept, std::array{point.x(), point.y(), point.z()}, is_mover_first});
  m_placed.merge_at(moving, place, point);
  if (m_texture)
    m_texture->merge_at(moving, place, m_placed.uv_at(corner_at(moving)));
  if (m_shading)
    m_shading->merge_at(moving, place,
                        m_vertex_normals ? std::nullopt
                                         : std::optional(m_placed.normal_at(corner_at(moving))));
  for (const Halfedge h : mesh().halfedges_around_target(mesh().prev(moving)))
    carry(h, moving);
  carry_places(moving);
}

internal::Optional<Point_3> Working_mesh::rounded_place(Halfedge edge, const Point_3& place) const
{
  const Face face = mesh().face(with_face(edge));
  if (!m_rounding || is_shared(face) || has_doubles(face))
    return {};
  return (*m_rounding)(place, m_rounding->is_by_vertex() ? vertex_of(corner_at(edge)) : 0);
}

void Working_mesh::on_refused(Halfedge moving, const Refusals& refusals)
{
  const Face face = mesh().face(with_face(moving));
  if (!is_own(face) || m_refused.empty())
    return;
  const Index t = triangle(face);
  std::size_t kind = 0;
  m_refused[kind][m_piece_of_vertex[soup().triangles[t].front()]] += refusals;
  for_each_label(soup(), [&](Part_kind::Name, const Triangle_labels& labels) {
    if (!labels.empty())
      m_refused[++kind][labels.of_triangle[t]] += refusals;
  });
}

void Working_mesh::on_hindered(Mesh::Edge_index e, Hindrance reason)
{
  m_hindrances.resize(own_face_count());
  for (const Halfedge h : {mesh().halfedge(e), mesh().opposite(mesh().halfedge(e))})
    if (!mesh().is_border(h) && is_own(mesh().face(h)))
      m_hindrances[mesh().face(h)][place(h)] = reason;
}

// A face can go by any of its edges. If all its corners are locked, its edges were not asked for.
Hindrance Working_mesh::hindrance_of(Face face) const
{
  std::optional<Hindrance> weakest;
  for (const std::optional<Hindrance>& reason : m_hindrances[face])
    weakest = (std::max)(weakest, reason);
  return weakest ? *weakest : lock_reason(mesh().target(mesh().halfedge(face)));
}

Working_mesh::Result Working_mesh::result() const
{
  Result result;
  struct Left
  {
    Index triangle;
    Face face;
    Index ply;
  };
  std::vector<Left> left;
  left.reserve(mesh().number_of_faces());
  for (const Face face : mesh().faces()) {
    if (!is_own(face))
      break; // the faces of the obstacle come last
    for (Index i = 0; i < ply_count(face); ++i)
      left.push_back({triangle(face, i), face, i});
  }
  std::sort(left.begin(), left.end(), [](const Left& a, const Left& b) { return a.triangle < b.triangle; });
  result.triangles.reserve(left.size());
  result.corners.reserve(left.size());
  for (const auto& [triangle, face, i] : left) {
    result.triangles.push_back(triangle);
    result.corners.push_back(corners_in_soup(face, i));
    if (!m_hindrances.empty())
      result.held_by.push_back(hindrance_of(face));
  }
  Cancellation_scope::check();
  result.soup = selected(soup(), result.triangles, result.corners);
  result.is_placed = m_placed.put(result.corners, result.soup);
  return result;
}

} // namespace selvedge
