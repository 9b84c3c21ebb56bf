// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_REDUCTION_H
#define SELVEDGE_TEST_SUPPORT_REDUCTION_H

#include <selvedge/mesh/Working_mesh.h>
#include <selvedge/simplify.h>
#include <selvedge/simplify_soup.h>
#include <selvedge/verify.h>

#include <utility>

namespace selvedge::test {

using Mesh = Working_mesh::Mesh;

inline Simplify_options to_ratio(double ratio)
{
  Simplify_options options;
  options.ratio = ratio;
  return options;
}

inline Simplify_options without_check(Simplify_options options)
{
  options.check_intersections = false;
  return options;
}

/// What limits of quality would hide from the exact filter is let through.
inline Simplify_options without_limits(Simplify_options options)
{
  options.max_normal_change = 180;
  options.min_aspect_ratio = 0;
  options.max_border_turn = 180;
  options.max_seam_turn = 180;
  options.max_border_drift = 10;
  return options;
}

/// An original, what became of it, and what the judge says.
struct Reduction
{
  Prepared_soup prepared;
  Simplified_soup simplified;
  Verification verification;
};

inline Reduction reduce(Triangle_soup soup, const Simplify_options& options)
{
  Reduction reduction;
  reduction.prepared = prepare(std::move(soup));
  reduction.simplified = simplify_soup(reduction.prepared, options);
  reduction.verification = verify(reduction.simplified, reduction.prepared);
  return reduction;
}

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

#endif // SELVEDGE_TEST_SUPPORT_REDUCTION_H
