// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_MESH_OF_H
#define SELVEDGE_TEST_SUPPORT_MESH_OF_H

#include "soup/Working_mesh.h"
#include <selvedge/Surface_mesh_simplification/simplify_mesh.h>
#include <selvedge/simplify.h>

#include <vector>

namespace selvedge::test {

using Mesh = Working_mesh::Mesh;

/// A soup as a mesh that knows nothing of it. It has the faces in the order of the triangles, and the
/// vertices in the order in which these come by them.
inline Mesh mesh_of(const Triangle_soup& soup)
{
  const Prepared_soup prepared = prepare(soup);
  const Working_mesh working(prepared.soup, prepared.positions, prepared.is_frozen);
  std::vector<Mesh::Vertex_index> numbers(working.mesh().number_of_vertices());
  Mesh mesh;
  for (const Mesh::Face_index face : working.faces_of_triangles()) {
    if (face == Mesh::null_face())
      continue; // of a double
    std::vector<Mesh::Vertex_index> corners;
    Mesh::Halfedge_index h = working.halfedge({face, 0, false});
    for (int i = 0; i < 3; ++i, h = working.mesh().next(h)) {
      Mesh::Vertex_index& number = numbers[working.mesh().source(h)];
      if (number == Mesh::null_vertex())
        number = mesh.add_vertex(working.mesh().point(working.mesh().source(h)));
      corners.push_back(number);
    }
    mesh.add_face(corners);
  }
  return mesh;
}

/// The faces of a mesh as it stands in the middle of a reduction.
inline Triangle_soup soup_of(const Mesh& mesh)
{
  Triangle_soup soup;
  for (Index v = 0; v < mesh.num_vertices(); ++v) // the removed ones, too: numbers stay
    soup.points.push_back(mesh.point(Mesh::Vertex_index(v)));
  for (const Mesh::Face_index face : mesh.faces()) {
    Index_triple triangle;
    std::size_t k = 0;
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(face)))
      triangle[k++] = v;
    soup.triangles.push_back(triangle);
  }
  return soup;
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_MESH_OF_H
