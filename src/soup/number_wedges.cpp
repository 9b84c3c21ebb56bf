// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "number_wedges.h"

#include "Sewing.h"

namespace selvedge {
namespace {

using Halfedge = Corner_mesh::Halfedge;

} // namespace

Wedge_numbers number_wedges(const Corner_mesh& corners,
                            const Simplify_constraints<Corner_mesh::Mesh>& constraints)
{
  const Corner_mesh::Mesh& mesh = corners.mesh();
  std::vector<char> is_line_at_target(mesh.number_of_halfedges(), false);
  for (const Corner_mesh::Mesh::Edge_index e : constraints.line_edges)
    for (const Halfedge h : {mesh.halfedge(e), mesh.opposite(mesh.halfedge(e))})
      is_line_at_target[h] = true;
  for (const Halfedge h : constraints.spokes)
    is_line_at_target[h] = true;
  Wedge_numbers result;
  result.of_face.assign(corners.own_face_count(), {Sewing::none, Sewing::none, Sewing::none});
  const auto number_at = [&](Halfedge h) -> Index& { return result.of_face[mesh.face(h)][corners.place(h)]; };
  for (const Halfedge first : mesh.halfedges()) {
    const auto is_numbered = [&](Halfedge h) {
      return mesh.is_border(h) || !corners.is_own(mesh.face(h)) || number_at(h) != Sewing::none;
    };
    if (is_numbered(first))
      continue;
    const auto number = [&](Halfedge h) { number_at(h) = Index(result.vertices.size()); };
    // Walks around the vertex in both directions, until it meets the first face, a line or a border.
    number(first);
    for (Halfedge h = first; !is_line_at_target[mesh.opposite(mesh.next(h))];) {
      h = mesh.opposite(mesh.next(h));
      if (is_numbered(h))
        break;
      number(h);
    }
    for (Halfedge h = first; !is_line_at_target[h];) {
      h = mesh.prev(mesh.opposite(h));
      if (is_numbered(h))
        break;
      number(h);
    }
    result.vertices.push_back(mesh.target(first));
  }
  return result;
}

} // namespace selvedge
