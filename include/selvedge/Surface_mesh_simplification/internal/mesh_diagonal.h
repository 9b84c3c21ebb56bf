// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_MESH_DIAGONAL_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_MESH_DIAGONAL_H

#include <selvedge/Error.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/boost/graph/helpers.h>

#include <cmath>
#include <optional>
#include <sstream>

// `mesh_diagonal` is the length in which a reduction measures, and refuses meshes in whose size quality
// cannot be computed.

namespace selvedge {
namespace internal {

inline constexpr double least_diagonal = 0x1p-200, largest_diagonal = 0x1p200; // see `mesh_diagonal`

/// Returns the diagonal of a box; 0 when it is that of no point.
inline double diagonal_of(const CGAL::Bbox_3& box)
{
  return box.xmin() <= box.xmax() ? std::hypot(box.x_span(), box.y_span(), box.z_span()) : 0;
}

/// Returns the bounding box of the vertices of a mesh that its faces use. Throws `Argument_error` when a
/// coordinate of these is not finite.
template <class TriangleMesh, class VertexPointMap>
CGAL::Bbox_3 bounding_box(const TriangleMesh& mesh, const VertexPointMap& points)
{
  CGAL::Bbox_3 box;
  for (const auto v : vertices(mesh)) {
    if (halfedge(v, mesh) == boost::graph_traits<TriangleMesh>::null_halfedge())
      continue;
    const CGAL::Bbox_3 of_point = get(points, v).bbox();
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(of_point.max(i)))
        throw Argument_error("a vertex of the mesh has a coordinate that is not finite");
    box += of_point;
  }
  return box;
}

/// Returns the diagonal that is given, or else that of the mesh. Throws `Argument_error` when it is out of
/// range.
///
/// Everything computed about quality is a sum of fewer than 2^40 products of at most four lengths, none
/// longer than the diagonal D = 2^d, and of factors that make less than 2^10, weights aside. The sum is less
/// than 2^(4d + 50) and does not overflow for d up to 200. For comparisons, the length of the normal of a
/// triangle, which is twice its area A, is squared; the square keeps all digits where 2A > 2^-500. With d at
/// least -200, that holds for all triangles with an area of more than 2^-100 D².
template <class TriangleMesh, class VertexPointMap>
double mesh_diagonal(const TriangleMesh& mesh, const VertexPointMap& points,
                     const std::optional<double>& given)
{
  const double diagonal = given ? *given : diagonal_of(bounding_box(mesh, points));
  if (diagonal == 0 || (diagonal >= least_diagonal && diagonal <= largest_diagonal))
    return diagonal;
  std::ostringstream text;
  text << "the bounding box of the mesh, " << bounding_box(mesh, points) << ", is too "
       << (diagonal < 1 ? "small" : "large")
       << ": its diagonal is to be from 2^-200 to 2^200, so that squares of areas are numbers; multiply all "
          "coordinates by a power of two, which loses no digit, and those of the result by its inverse";
  throw Argument_error(text.str());
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_MESH_DIAGONAL_H
