// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_SIMPLIFY_CONSTRAINTS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_SIMPLIFY_CONSTRAINTS_H

#include <CGAL/boost/graph/helpers.h>

#include <optional>
#include <utility>
#include <vector>

namespace selvedge {

/// What `simplify_mesh` must know about single elements of a mesh.
template <class TriangleMesh>
struct Simplify_constraints
{
  using Face = typename boost::graph_traits<TriangleMesh>::face_descriptor;

  /// Vertices that do not move. Other vertices may move onto them.
  std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor> locked_vertices;

  /// Edges inside the mesh that are kept like borders: seams.
  std::vector<typename boost::graph_traits<TriangleMesh>::edge_descriptor> line_edges;

  /// Edges inside the mesh that are seams at the target of the halfedge alone, and do not bind their sources:
  /// see `Border_rule`.
  std::vector<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor> spokes;

  /// Vertices on lines that bound no strips: a face between them and another line must keep its shape
  /// (`Simplify_options::min_aspect_ratio`).
  std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor> no_strip_vertices;

  /// Pairs of border vertices on the two sides of a gap that is not to grow; a vertex in at most one of them.
  /// When one of a pair leaves its border, the other does so next, along its own.
  std::vector<std::pair<typename boost::graph_traits<TriangleMesh>::vertex_descriptor,
                        typename boost::graph_traits<TriangleMesh>::vertex_descriptor>>
      partners;

  /// Border vertices that face another border across a gap, and have no partner: they may drift by
  /// `s_share_of_drift_at_gaps` of what borders may.
  std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor> facing_vertices;
  static constexpr double s_share_of_drift_at_gaps = 0.1;

  /// Groups of coincident vertices, one for each sheet at a line where several sheets meet, such as the
  /// copies of a vertex at non-manifold edges. Each is on the border of its sheet. The vertices of a group
  /// move along these borders together, in one motion that is judged as a whole, or not at all. A vertex is
  /// in at most one group, and a group has all vertices at its position. Coincident vertices in no group do
  /// not move.
  std::vector<std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor>> joint_vertices;

  /// Factors of at least 0 for the cost of moving each vertex: one for every vertex, in the order of
  /// `vertices(mesh)`, or none at all; `simplify_mesh` refuses any other number (`Argument_error`).
  std::vector<double> vertex_weights;

  /// Faces that have a ratio of their own, in [0, 1]; the target in the options is for all other faces. Once
  /// a share has reached its target, no collapse removes another face of it, while the others continue until
  /// all have reached theirs. A face in several shares belongs to the last of them.
  struct Share
  {
    std::vector<Face> faces;
    double ratio = 1;
  };
  std::vector<Share> shares;

  /// Faces that no target and no count of the report includes: obstacles. Lock their vertices, too.
  std::vector<Face> uncounted_faces;

  /// How many triangles of the result a face stands for, where there are several in one place. Targets and
  /// counts of the report are of these triangles, and so are counts of offending pairs.
  std::vector<std::pair<Face, unsigned>> multiplicities;

  /// The pairs of faces that keep the mesh from being embedded, all of them and each once; a degenerate face
  /// is a pair with itself. They and their descendants are exempt, see `Intersection_filter::exempt`. A mesh
  /// of which all such faces have locked vertices needs none.
  ///
  /// Where layers pierce each other by no more than this share of the diagonal, so little that it hardly
  /// shows, what descends from them does not pierce deeper than that (`shallow` in
  /// `Intersection_filter::exempt`).
  std::vector<std::pair<Face, Face>> offending_pairs;
  static constexpr double s_share_of_shallow_pairs = 0.002;

  /// Pairs of parts, by their faces, that may come to intersect each other, see
  /// `Intersection_filter::let_intersect`. `offending_pairs` has none of the pairs between them.
  std::vector<std::pair<std::vector<Face>, std::vector<Face>>> may_intersect;

  /// A further pose of the mesh: a place of its own for every vertex.
  using Pose_points = typename boost::property_map<
      TriangleMesh,
      CGAL::dynamic_vertex_property_t<typename boost::property_traits<
          typename boost::property_map<TriangleMesh, CGAL::vertex_point_t>::type>::value_type>>::type;
  struct Pose
  {
    Pose_points points;                                 ///< made with `get(tag, mesh)`; moves with the mesh
    std::vector<std::pair<Face, Face>> offending_pairs; ///< as below, those in this pose
  };

  /// All guarantees and limits hold in each of these poses as they do in the mesh's own, and the cost of a
  /// collapse is the mean over all. No vertex moves that is coincident with another in some pose, and none
  /// goes to a new place (`Placement::optimal` is refused).
  std::vector<Pose> poses;

  /// The length of which the lengths in the options are fractions; by default, the diagonal of the mesh. A
  /// mesh that is a part of another needs the diagonal of the whole.
  std::optional<double> diagonal;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_SIMPLIFY_CONSTRAINTS_H
