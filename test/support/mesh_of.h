// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_MESH_OF_H
#define SELVEDGE_TEST_SUPPORT_MESH_OF_H

#include "soup/Working_mesh.h"
#include <selvedge/Surface_mesh_simplification/simplify_mesh.h>
#include <selvedge/simplify.h>

namespace selvedge::test {

using Mesh = Working_mesh::Mesh;

/// A soup as a mesh that knows nothing of it.
inline Mesh mesh_of(const Triangle_soup& soup)
{
  const Prepared_soup prepared = prepare(soup);
  return Working_mesh(prepared.soup, prepared.positions, prepared.is_frozen).mesh();
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
