// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "number_wedges.h"

#include "Sewing.h"

namespace selvedge {
namespace {

using Halfedge = Corner_mesh::Halfedge;

} // namespace

Wedge_numbers number_wedges(const Corner_mesh& corners,
                            const std::vector<Corner_mesh::Mesh::Edge_index>& line_edges)
{
  const Corner_mesh::Mesh& mesh = corners.mesh();
  std::vector<char> is_line(mesh.number_of_edges(), false);
  for (const Corner_mesh::Mesh::Edge_index e : line_edges)
    is_line[e] = true;
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
    for (Halfedge h = first; !is_line[mesh.edge(mesh.next(h))];) {
      h = mesh.opposite(mesh.next(h));
      if (is_numbered(h))
        break;
      number(h);
    }
    for (Halfedge h = first; !is_line[mesh.edge(h)];) {
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
