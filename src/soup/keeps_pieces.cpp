// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "keeps_pieces.h"

#include "Vertex_complex.h"

#include <algorithm>
#include <array>
#include <map>

namespace selvedge {
namespace {

using Mesh = Corner_mesh::Mesh;
using Halfedge = Corner_mesh::Halfedge;
using Face = Corner_mesh::Face;

void add_star(const Corner_mesh& corners, Mesh::Vertex_index v, Vertex_complex& complex)
{
  for (const Face face : corners.mesh().faces_around_target(corners.mesh().halfedge(v)))
    if (corners.is_own(face))
      for (Index i = 0; i < corners.ply_count(face); ++i) {
        const auto& [a, b, c] = corners.corners(face, i);
        complex.add(corners.vertex_of(a), corners.vertex_of(b), corners.vertex_of(c));
      }
}

// Marks what is at locked vertices around a vertex, and at those that bound no strip: where the mesh is cut,
// for the sake of non-manifold places, other vertices of it may have the same vertices of the soup.
void mark_parts(const Corner_mesh& corners, Mesh::Vertex_index v, const Border_rule<Mesh>& rule,
                Vertex_complex& complex)
{
  const Mesh& mesh = corners.mesh();
  for (const Face face : mesh.faces_around_target(mesh.halfedge(v)))
    if (corners.is_own(face))
      for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(face)))
        if (rule.is_locked(mesh.target(h)) || rule.bounds_no_strip(mesh.target(h)))
          for (Index i = 0; i < corners.ply_count(face); ++i)
            complex.mark_as_part(corners.vertex_of(corners.corner_at(h, i)));
}

bool has_doubles_at(const Corner_mesh& corners, Mesh::Vertex_index v)
{
  const auto faces = corners.mesh().faces_around_target(corners.mesh().halfedge(v));
  return corners.may_have_doubles() &&
         std::any_of(faces.begin(), faces.end(), [&](Face face) { return corners.has_doubles(face); });
}

// Contracts the edges along which the vertices of the mover go, one by one, in the complex of all triangles
// at mover and goal.
bool keeps_pieces_of_doubles(const Corner_mesh& corners, Halfedge moving, const Border_rule<Mesh>& rule)
{
  const Mesh& mesh = corners.mesh();
  std::map<Index, Index> goals; // of vertices
  bool are_goals_clear = true;
  const auto add = [&](Halfedge at_mover, Halfedge at_goal) {
    for (Index i = 0; i < corners.ply_count(mesh.face(at_mover)); ++i) {
      const Index goal = corners.vertex_of(corners.corner_at(at_goal, i));
      are_goals_clear &=
          goals.emplace(corners.vertex_of(corners.corner_at(at_mover, i)), goal).first->second == goal;
    }
  };
  for (const Halfedge side : {moving, mesh.opposite(moving)})
    if (!mesh.is_border(side)) {
      const auto [to_mover, to_goal] = corners.halfedges_to_ends(moving, side);
      add(to_mover, to_goal);
    }
  corners.for_each_changed_face(moving, rule, add);
  if (!are_goals_clear)
    return false;
  Vertex_complex complex;
  for (const Mesh::Vertex_index v : {mesh.source(moving), mesh.target(moving)}) {
    add_star(corners, v, complex);
    mark_parts(corners, v, rule, complex);
  }
  return std::all_of(goals.begin(), goals.end(),
                     [&](const auto& motion) { return complex.contract(motion.first, motion.second); });
}

} // namespace

bool keeps_pieces(const Corner_mesh& corners, Halfedge moving, const Border_rule<Mesh>& rule)
{
  const Mesh& mesh = corners.mesh();
  // At each end of an edge, a line is open (a border, or vertices of different numbers on the two sides) or
  // closed, and a spoke is closed. Runs of open vertices are boundary loops of pieces, or stretches of such
  // loops. So none may vanish, and no two may meet.
  const auto is_open_at_end = [&](Halfedge h) {
    const Halfedge other = mesh.opposite(h);
    return mesh.is_border(h) || mesh.is_border(other) ||
           corners.vertex_of(corners.corner_at(h)) != corners.vertex_of(corners.corner_at(mesh.prev(other)));
  };
  const auto is_on_boundary = [&](Mesh::Vertex_index v) {
    const auto around = mesh.halfedges_around_target(mesh.halfedge(v));
    return std::any_of(around.begin(), around.end(),
                       [&](Halfedge h) { return is_open_at_end(h) || is_open_at_end(mesh.opposite(h)); });
  };
  const Halfedge back = mesh.opposite(moving);
  if (has_doubles_at(corners, mesh.source(moving)) || has_doubles_at(corners, mesh.target(moving)))
    return keeps_pieces_of_doubles(corners, moving, rule);
  // The end of a cut is on the boundary of its piece, too, and may be on a line besides.
  const auto around = mesh.halfedges_around_target(back);
  const bool ends_cut = std::any_of(around.begin(), around.end(), [&](Halfedge h) {
    const Halfedge to_pole = mesh.opposite(h);
    return rule.is_line_at_target(to_pole) && !rule.is_line_at_target(h) && is_open_at_end(to_pole);
  });
  if (ends_cut && (rule.is_line_at_target(back) || is_on_boundary(mesh.target(moving))))
    return false;
  if (!rule.is_line_at_target(back))
    return true;
  const bool is_open_ahead = is_open_at_end(moving), is_open = is_open_at_end(back);
  for (const Halfedge h : mesh.halfedges_around_target(back)) {
    if (h == back || !rule.is_line_at_target(h))
      continue;
    const bool is_open_behind = is_open_at_end(mesh.opposite(h));
    if (is_open_behind == is_open_ahead)
      return is_open == is_open_ahead;
    // A run ends here. If the moving vertex is its closed end, the next vertex becomes the end instead, and
    // must not be on another run.
    if (is_open || !is_open_ahead)
      return is_open || !is_on_boundary(mesh.target(moving));
    if (!has_doubles_at(corners, mesh.source(h)))
      return !is_on_boundary(mesh.source(h));
    Vertex_complex star;
    add_star(corners, mesh.source(h), star);
    mark_parts(corners, mesh.source(h), rule, star);
    const Index next = corners.ends_in_soup(mesh.opposite(h)).second;
    return !star.is_part(next) && star.kind(next) == Vertex_complex::Kind::inner;
  }
  return true;
}

// Sheets that have one vertex in common where they move must also have one ahead and one behind on their
// line, and only those: where they come apart, the line of a piece ends. So each sheet with doubles must have
// one vertex in each of these places, and as many faces ahead as behind.
bool keeps_joints(const Corner_mesh& corners, Halfedge moving, const std::vector<Halfedge>& others)
{
  const Mesh& mesh = corners.mesh();
  using Place = std::array<Index, 3>; // vertices of the soup on a line: at the mover, ahead and behind
  std::vector<Place> places;
  const auto add = [&](Halfedge h) {
    const auto [mover, ahead] = corners.ends_in_soup(h);
    const bool is_border = mesh.is_border(h);
    const Halfedge to_next = mesh.opposite(is_border ? mesh.prev(h) : mesh.next(mesh.opposite(h)));
    const Halfedge to_behind = is_border ? to_next : mesh.prev(to_next);
    places.push_back({mover, ahead, corners.vertex_of(corners.corner_at(to_behind))});
    const Halfedge side = corners.with_face(h);
    for (const Halfedge to_end : {side, mesh.prev(side), to_behind})
      if (!corners.have_plies_one_vertex(mesh.face(to_end), corners.place(to_end)))
        return false;
    if (!has_doubles_at(corners, mesh.source(h)))
      return true;
    Vertex_complex star;
    add_star(corners, mesh.source(h), star);
    return star.kind(mover) != Vertex_complex::Kind::singular;
  };
  if (!add(moving) || !std::all_of(others.begin(), others.end(), add))
    return false;
  for (const Place& a : places)
    for (const Place& b : places)
      if ((a[0] == b[0]) != (a[1] == b[1]) || (a[0] == b[0]) != (a[2] == b[2]))
        return false;
  return true;
}

} // namespace selvedge
