// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_SIMPLIFY_CONSTRAINTS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_SIMPLIFY_CONSTRAINTS_H

#include <CGAL/boost/graph/helpers.h>

#include <optional>
#include <vector>

namespace selvedge {

/// What `simplify` must know of single elements of a mesh.
template <class TriangleMesh>
struct Simplify_constraints
{
  using Face = typename boost::graph_traits<TriangleMesh>::face_descriptor;

  /// Vertices that do not move. Others may move onto them.
  std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor> locked_vertices;

  /// Edges inside the mesh that are to be kept as borders are: seams.
  std::vector<typename boost::graph_traits<TriangleMesh>::edge_descriptor> line_edges;

  /// For every vertex, in the order of `vertices(mesh)`, a factor of at least 0 for what it costs to move it;
  /// or nothing.
  std::vector<double> vertex_weights;

  /// Faces that have a ratio of their own, in [0, 1]; the target of the options is for all others. Once a
  /// share has reached its target, no collapse takes a further face of it, while others go on until all have
  /// reached theirs. A face in several shares counts in the last of them.
  struct Share
  {
    std::vector<Face> faces;
    double ratio;
  };
  std::vector<Share> shares;

  /// Faces of which no target and no count of the report knows: obstacles. Lock their vertices.
  std::vector<Face> uncounted_faces;

  /// The length that lengths in the options are shares of; where there is none, the diagonal of the mesh. A
  /// mesh that is a part of another takes the diagonal of the whole.
  std::optional<double> diagonal;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_SIMPLIFY_CONSTRAINTS_H
