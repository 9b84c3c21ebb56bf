// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "keeps_pieces.h"

#include "Sewing.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace selvedge {
namespace {

using Mesh = Corner_mesh::Mesh;
using Halfedge = Corner_mesh::Halfedge;
using Face = Corner_mesh::Face;

// Returns, for each element, the number of the first that is equal.
template <class Element>
std::vector<std::ptrdiff_t> first_equal(const std::vector<Element>& elements)
{
  std::vector<std::ptrdiff_t> first;
  for (const Element& element : elements)
    first.push_back(std::find(elements.begin(), elements.end(), element) - elements.begin());
  return first;
}

// The triangles beside an edge must have vertices in common at the goal just where they have them at the
// mover and, on a line, at the vertex behind it. Those of a contracted face must be one, with all three
// vertices in common, just where those of its neighbours are and, on a line, those beside the edge behind. So
// as many vertices, edges and faces of pieces go as without doubles, and what replaces them has as many
// faces. And triangles beside an edge that is no line must have it in common only where they have their third
// vertex in common: two sheets that meet in the edge alone would come apart at the goal.
bool keeps_pieces_of_doubles(const Corner_mesh& corners, Halfedge moving, const Border_rule<Mesh>& rule)
{
  const Mesh& mesh = corners.mesh();
  const auto common_vertices = [&](Halfedge h, bool is_at_target) {
    const Halfedge other = mesh.opposite(h);
    std::vector<Index> vertices;
    for (const Halfedge corner : {is_at_target ? h : mesh.prev(h), is_at_target ? mesh.prev(other) : other}) {
      vertices.push_back(Sewing::none);
      if (const Face face = mesh.face(corner); !mesh.is_border(corner) && corners.is_own(face))
        for (Index i = 0; i < corners.ply_count(face); ++i)
          vertices.push_back(corners.vertex_of(corners.corner_at(corner, i)));
    }
    return first_equal(vertices);
  };
  const auto common_faces = [&](Halfedge side) {
    std::vector<Index_triple> triangles; // of vertices, in ascending order
    const Face face = mesh.face(side);
    if (mesh.is_border(side) || !corners.is_own(face))
      return first_equal(triangles);
    for (Index i = 0; i < corners.ply_count(face); ++i) {
      const auto& [a, b, c] = corners.corners(face, i);
      triangles.push_back({corners.vertex_of(a), corners.vertex_of(b), corners.vertex_of(c)});
      std::sort(triangles.back().begin(), triangles.back().end());
    }
    return first_equal(triangles);
  };
  const auto meet_in_edge_alone = [&](Halfedge side) {
    const Face face = mesh.face(side);
    if (mesh.is_border(side) || !corners.is_own(face))
      return false;
    const auto has_common = [&](Halfedge corner, Index i, Index j) {
      return corners.vertex_of(corners.corner_at(corner, i)) ==
             corners.vertex_of(corners.corner_at(corner, j));
    };
    for (Index i = 0; i < corners.ply_count(face); ++i)
      for (Index j = 0; j < i; ++j)
        if (has_common(side, i, j) && has_common(mesh.prev(side), i, j) && !has_common(mesh.next(side), i, j))
          return true;
    return false;
  };
  const auto at_mover = common_vertices(moving, false);
  if (at_mover != common_vertices(moving, true))
    return false;
  for (const Halfedge side : {moving, mesh.opposite(moving)})
    for (const Halfedge h : {mesh.next(side), mesh.prev(side)})
      if (!mesh.is_border(mesh.edge(h)) && !rule.is_line(mesh.edge(h)) && !mesh.is_border(side) &&
          common_faces(h) != common_faces(mesh.opposite(h)))
        return false;
  if (!rule.is_line(mesh.edge(moving)))
    return !meet_in_edge_alone(moving) && !meet_in_edge_alone(mesh.opposite(moving));
  for (const Halfedge h : mesh.halfedges_around_target(mesh.opposite(moving)))
    if (h != mesh.opposite(moving) && rule.is_line(mesh.edge(h)) &&
        (at_mover != common_vertices(h, false) || common_faces(moving) != common_faces(h) ||
         common_faces(mesh.opposite(moving)) != common_faces(mesh.opposite(h))))
      return false;
  return true;
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
  if (corners.has_doubles(mesh.face(moving)) || corners.has_doubles(mesh.face(back)))
    return keeps_pieces_of_doubles(corners, moving, rule);
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
    return is_open || !is_on_boundary(is_open_ahead ? mesh.source(h) : mesh.target(moving));
  }
  return true;
}

// Sheets that have one vertex in common where they move must also have one ahead and one behind on their
// line, and only those: where they come apart, the line of a piece ends.
bool keeps_joints(const Corner_mesh& corners, Halfedge moving, const std::vector<Halfedge>& others)
{
  const Mesh& mesh = corners.mesh();
  using Place = std::array<Index, 3>; // vertices of the soup on a line: at the mover, ahead and behind
  std::vector<Place> places;
  const auto add = [&](Halfedge h) {
    const auto [mover, ahead] = corners.ends_in_soup(h);
    const bool is_border = mesh.is_border(h);
    const Halfedge to_next = mesh.opposite(is_border ? mesh.prev(h) : mesh.next(mesh.opposite(h)));
    places.push_back(
        {mover, ahead, corners.vertex_of(corners.corner_at(is_border ? to_next : mesh.prev(to_next)))});
  };
  add(moving);
  std::for_each(others.begin(), others.end(), add);
  for (const Place& a : places)
    for (const Place& b : places)
      if ((a[0] == b[0]) != (a[1] == b[1]) || (a[0] == b[0]) != (a[2] == b[2]))
        return false;
  return true;
}

} // namespace selvedge
