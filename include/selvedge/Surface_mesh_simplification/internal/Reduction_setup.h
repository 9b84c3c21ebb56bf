// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_REDUCTION_SETUP_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_REDUCTION_SETUP_H

#include <selvedge/Error.h>
#include <selvedge/Simplify_options.h>
#include <selvedge/Surface_mesh_simplification/Border_rule.h>
#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/Surface_mesh_simplification/internal/Face_targets.h>
#include <selvedge/Surface_mesh_simplification/internal/mesh_diagonal.h>

#include <boost/unordered_set.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace selvedge {
namespace internal {

/// What the options and constraints of a reduction come to for its mesh: lengths in place of shares of the
/// diagonal, which vertices stay, and the rule of borders and the targets of faces that follow.
///
/// It exists while a reduction makes its parts, and refuses options that are out of range or exclude each
/// other, as far as no part does so itself.
///
/// **Preconditions** Mesh, options and constraints outlive it.
template <class TriangleMesh>
struct Reduction_setup
{
  using Constraints = Simplify_constraints<TriangleMesh>;
  using Vertex = typename boost::graph_traits<TriangleMesh>::vertex_descriptor;

  TriangleMesh& mesh;
  const Simplify_options& options;
  const Constraints& constraints;
  double diagonal;
  double max_error = std::numeric_limits<double>::infinity();
  std::vector<std::vector<Vertex>> joint_groups; // those of the constraints that may move
  std::vector<Vertex> locked_vertices;           // all that do not

  template <class VertexPointMap>
  Reduction_setup(TriangleMesh& mesh_, const Simplify_options& options_, const Constraints& constraints_,
                  const VertexPointMap& points)
      : mesh(mesh_), options(options_), constraints(constraints_),
        diagonal(mesh_diagonal(mesh, points, constraints.diagonal)),
        locked_vertices(constraints.locked_vertices)
  {
    check_options();
    if (options.max_error)
      max_error = *options.max_error * diagonal;
    divide_joint_vertices();
  }

  /// The height of low corners and faces, in units of the mesh.
  double max_corner_height() const { return options.max_corner_height * diagonal; }

  /// Returns the rule of borders and seams for the places that vertices have in one pose.
  template <class Points>
  Border_rule<TriangleMesh, Points> border_rule(const Points& points) const
  {
    Border_rule_options of_rule;
    of_rule.max_border_turn = options.max_border_turn;
    of_rule.max_seam_turn = options.max_seam_turn;
    of_rule.max_corner_height = max_corner_height();
    of_rule.max_drift = options.max_border_drift * diagonal;
    Border_rule<TriangleMesh, Points> rule(mesh, points, of_rule);
    for (const auto e : constraints.line_edges)
      rule.mark(e);
    for (const auto h : constraints.spokes)
      rule.mark_at_target(h);
    for (const auto v : constraints.facing_vertices)
      rule.limit_drift(v, Simplify_constraints<TriangleMesh>::s_share_of_drift_at_gaps * of_rule.max_drift);
    for (const auto v : constraints.no_strip_vertices)
      rule.bound_no_strip(v);
    for (const auto v : locked_vertices)
      rule.lock(v);
    return rule;
  }

  Face_targets<TriangleMesh> face_targets() const
  {
    Face_targets<TriangleMesh> targets(mesh);
    for (const auto& [face, times] : constraints.multiplicities)
      targets.count_times(face, times);
    for (const auto& share : constraints.shares) {
      const std::size_t number = targets.add_share();
      for (const auto face : share.faces)
        targets.assign(face, number);
    }
    for (const auto face : constraints.uncounted_faces)
      targets.leave_out(face);
    targets.fix(locked_vertices);
    for (std::size_t i = 0; i < constraints.shares.size(); ++i)
      targets.set_target(i + 1, targets.share(i + 1).at_ratio(constraints.shares[i].ratio));
    const std::size_t by_ratio = options.ratio ? targets.share(0).at_ratio(*options.ratio) : 0;
    targets.set_target(0, (std::max)(options.faces.value_or(0), by_ratio));
    for (std::size_t i = 0; i < (std::min)(options.least_faces.size(), targets.shares().size()); ++i)
      targets.set_least(i, options.least_faces[i]);
    return targets;
  }

private:
  void check_options() const
  {
    if (options.max_error && !(*options.max_error >= 0))
      throw Argument_error("the error allowed is a share of the diagonal, at least 0");
    if (!constraints.poses.empty() && options.placement == Placement::optimal)
      throw Argument_error("a new place of a vertex is a place in one pose; with several poses, vertices go "
                           "to others");
    if (options.clearance && !options.check_intersections)
      throw Argument_error(
          "a clearance is kept where intersections are checked; leave one of the two options");
    if (!(options.uv_weight >= 0 && std::isfinite(options.uv_weight)))
      throw Argument_error("the weight of the texture is at least 0, and finite");
    if (!(options.normal_weight >= 0 && std::isfinite(options.normal_weight)))
      throw Argument_error("the weight of normals is at least 0, and finite");
  }

  // CGAL's loop does one collapse at a time. A vertex with a partner could not follow both. In several poses,
  // no group is known to stay one in each.
  void divide_joint_vertices()
  {
    const bool may_move_together =
        options.loop == Collapse_loop::own && options.check_intersections && constraints.poses.empty();
    boost::unordered_set<Vertex> has_partner;
    for (const auto& [a, b] : constraints.partners)
      has_partner.insert({a, b});
    for (const auto& group : constraints.joint_vertices)
      if (may_move_together &&
          std::none_of(group.begin(), group.end(), [&](Vertex v) { return has_partner.count(v) > 0; }))
        joint_groups.push_back(group);
      else
        locked_vertices.insert(locked_vertices.end(), group.begin(), group.end());
  }
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_REDUCTION_SETUP_H
