// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FURTHER_POSES_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FURTHER_POSES_H

#include <selvedge/Simplify_report.h>
#include <selvedge/Surface_mesh_simplification/Aspect_ratio_filter.h>
#include <selvedge/Surface_mesh_simplification/Border_filter.h>
#include <selvedge/Surface_mesh_simplification/Error_filter.h>
#include <selvedge/Surface_mesh_simplification/Normal_change_filter.h>
#include <selvedge/Surface_mesh_simplification/Pose_intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Quadric_cost.h>
#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/Surface_mesh_simplification/internal/Pose_motions.h>
#include <selvedge/Surface_mesh_simplification/internal/Reduction_setup.h>
#include <selvedge/Surface_mesh_simplification/internal/Tracked_points.h>
#include <selvedge/spatial/internal/Selectable_index.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace selvedge {
namespace internal {

/// Keeps the limits, the cost and the exact test of a reduction in the further poses of a mesh. Every limit
/// holds in each pose, and so does the exact test; the cost is the mean over all poses, the first included
/// (Mohr, Gleicher: Deformation sensitive decimation, 2003).
///
/// `IsOfStrip` says which faces the limit of the aspect ratio leaves out.
template <class TriangleMesh, class IsOfStrip>
class Further_poses
{
  using Constraints = Simplify_constraints<TriangleMesh>;
  using Points = typename Constraints::Pose_points;
  using Motions = Pose_motions<TriangleMesh, Points>;
  using Rule = Border_rule<TriangleMesh, Points>;
  using Quadrics = Quadric_cost<TriangleMesh, Rule>;
  using Line = Border_filter<Rule>;
  using Aspect_ratio = Aspect_ratio_filter<Line, IsOfStrip>;
  using Normal_change = Normal_change_filter<Aspect_ratio>;
  using Error = Error_filter<Tracked_points<TriangleMesh>, Normal_change>;
  using Intersection = Pose_intersection_filter<TriangleMesh, Points, No_filter, Selectable_index>;
  using Vertex = typename boost::graph_traits<TriangleMesh>::vertex_descriptor;
  using Edge = typename boost::graph_traits<TriangleMesh>::edge_descriptor;

  // One pose. Its filters are chained, each with those before it as its base.
  struct Pose
  {
    Rule rule;
    Quadrics quadrics;
    Tracked_points<TriangleMesh> tracked;
    Line line;
    Aspect_ratio aspect_ratio;
    Normal_change normal_change;
    Error error;

    Pose(const Reduction_setup<TriangleMesh>& setup, const Points& points, const IsOfStrip& is_of_strip)
        : rule(setup.border_rule(points)), quadrics(setup.mesh, setup.options.cost, rule),
          tracked(setup.mesh), line(rule), aspect_ratio(setup.options.min_aspect_ratio, line, is_of_strip),
          normal_change(setup.options.max_normal_change, aspect_ratio, setup.max_corner_height()),
          error(setup.max_error, tracked, normal_change)
    {
    }
  };

public:
  using Face = typename Constraints::Face;

  Further_poses(const Reduction_setup<TriangleMesh>& setup, const IsOfStrip& is_of_strip)
      : m_mesh(setup.mesh), m_motions(setup.mesh, points_of(setup.constraints))
  {
    m_poses.reserve(m_motions.size());
    for (std::size_t i = 0; i < m_motions.size(); ++i) {
      Pose& pose = m_poses.emplace_back(setup, m_motions.points(i), is_of_strip);
      pose.quadrics.weigh(m_mesh, setup.constraints.vertex_weights);
      pose.quadrics.measure_by(setup.diagonal);
      if (setup.options.max_error)
        pose.tracked.begin(m_motions.points(i), setup.diagonal, setup.max_error);
    }
  }

  Further_poses(const Further_poses&) = delete; // filters refer to rules
  Further_poses& operator=(const Further_poses&) = delete;

  bool empty() const { return m_poses.empty(); }
  std::size_t size() const { return m_poses.size(); }

  /// Begins the exact test; `make_index()` returns an empty index. `shallow` is for `exempt`.
  template <class MakeIndex>
  void build_index(const MakeIndex& make_index, const Constraints& constraints,
                   const std::optional<double>& clearance, double shallow)
  {
    if (empty())
      return;
    m_intersection.emplace(m_mesh, points(), No_filter(), make_index);
    for (std::size_t i = 0; i < m_poses.size(); ++i)
      m_intersection->exempt(i, constraints.poses[i].offending_pairs, constraints.multiplicities, shallow);
    m_intersection->let_intersect(constraints.may_intersect);
    if (clearance)
      m_intersection->keep_clearance(*clearance, constraints.uncounted_faces);
  }

  /// Whether the limits allow a collapse in every pose.
  template <class Collapse>
  bool allows_shape(const Collapse& collapse) const
  {
    if (!empty() && collapse.are_both_moved())
      return false;
    for (std::size_t i = 0; i < m_poses.size(); ++i)
      if (!m_motions.in_pose(i, collapse,
                             [&](const auto& in_pose) { return m_poses[i].error.allows(in_pose); }))
        return false;
    return true;
  }

  /// Whether the exact test allows it in every pose.
  template <class Collapse>
  bool is_clear(const Collapse& collapse) const
  {
    return !m_intersection || m_intersection->allows(collapse);
  }

  /// Returns the faces because of which the exact test refused the last collapse.
  const std::vector<Face>& blockers() const { return m_intersection->blockers(); }

  /// Returns whether it refused that for nothing but clearance.
  bool is_clearance_lacking() const { return m_intersection && m_intersection->is_clearance_lacking(); }

  /// Returns the first limit that holds back a collapse in some pose.
  template <class Collapse>
  std::optional<Hindrance> hindrance(const Collapse& collapse, bool is_border) const
  {
    for (std::size_t i = 0; i < m_poses.size(); ++i) {
      const Pose& pose = m_poses[i];
      const auto reason =
          m_motions.in_pose(i, collapse, [&](const auto& in_pose) -> std::optional<Hindrance> {
            if (!pose.line.accepts(in_pose))
              return pose.rule.refusal(in_pose.moving()) == Line_refusal::drift ? Hindrance::drift
                     : is_border                                                ? Hindrance::border_turn
                                                                                : Hindrance::seam_turn;
            if (!pose.aspect_ratio.accepts(in_pose))
              return Hindrance::aspect_ratio;
            if (!pose.normal_change.accepts(in_pose))
              return Hindrance::normal_change;
            return pose.error.accepts(in_pose) ? std::nullopt : std::optional(Hindrance::error);
          });
      if (reason)
        return reason;
    }
    if (!m_intersection || m_intersection->accepts(collapse))
      return std::nullopt;
    return m_intersection->is_clearance_lacking() ? Hindrance::clearance : Hindrance::intersection;
  }

  void on_started()
  {
    if (m_intersection)
      m_intersection->visitor().OnStarted(m_mesh);
  }

  template <class Collapse>
  void before_collapse(const Collapse& collapse)
  {
    for (std::size_t i = 0; i < m_poses.size(); ++i)
      m_motions.in_pose(i, collapse, [&](const auto& in_pose) {
        m_poses[i].tracked.before_collapse(in_pose);
        m_poses[i].rule.before_collapse(in_pose);
      });
    m_motions.before_collapse(collapse.goal());
    if (m_intersection)
      m_intersection->visitor().before_collapse(collapse);
  }
  void after_collapse(Vertex kept)
  {
    m_motions.after_collapse(kept);
    for (Pose& pose : m_poses)
      pose.rule.after_collapse(kept);
    if (m_intersection)
      m_intersection->visitor().after_collapse(kept);
  }

  void initialise_costs() const
  {
    for (std::size_t i = 0; i < m_poses.size(); ++i)
      m_poses[i].quadrics.initialize(m_mesh, m_motions.points(i), 0);
  }

  /// Returns the mean over all poses of the costs of a collapse, of which `cost_of_first` is that in the
  /// first.
  template <class Collapse>
  double mean_cost(double cost_of_first, const Collapse& collapse) const
  {
    double sum = cost_of_first;
    for (std::size_t i = 0; i < m_poses.size(); ++i)
      sum += m_motions.in_pose(i, collapse, [&](const auto& in_pose) {
        return *m_poses[i].quadrics.cost_along(in_pose.profile(), in_pose.moving());
      });
    return sum / double(m_poses.size() + 1);
  }

  /// Called after the collapse of an edge between two vertices, once the merged vertex is in its place.
  void update_costs(Vertex v0, Vertex v1, Vertex kept) const
  {
    for (std::size_t i = 0; i < m_poses.size(); ++i)
      m_poses[i].quadrics.update_after_collapse(Merged{m_mesh, m_motions.points(i), v0, v1}, kept);
  }

  /// Adds what the limits and the exact test have refused.
  void add_refusals(Refusals& sum) const
  {
    for (std::size_t i = 0; i < m_poses.size(); ++i) {
      const Pose& pose = m_poses[i];
      sum.border += pose.line.refusals();
      sum.aspect_ratio += pose.aspect_ratio.refusals();
      sum.normal_change += pose.normal_change.refusals();
      sum.error += pose.error.refusals();
    }
    if (m_intersection)
      sum.intersection += m_intersection->refusals();
  }

  /// Returns how many collapses the exact test refused in a pose.
  std::size_t refused_in(std::size_t pose) const
  {
    return m_intersection ? m_intersection->refusals_in(pose) : 0;
  }

private:
  // What a cost reads of the profile of an edge that is no more.
  struct Merged
  {
    const TriangleMesh& mesh;
    const Points& points;
    Vertex first, second;

    const TriangleMesh& surface_mesh() const { return mesh; }
    const Points& vertex_point_map() const { return points; }
    Vertex v0() const { return first; }
    Vertex v1() const { return second; }
  };

  static std::vector<Points> points_of(const Constraints& constraints)
  {
    std::vector<Points> points;
    for (const auto& pose : constraints.poses)
      points.push_back(pose.points);
    return points;
  }
  std::vector<Points> points() const
  {
    std::vector<Points> points;
    for (std::size_t i = 0; i < m_motions.size(); ++i)
      points.push_back(m_motions.points(i));
    return points;
  }

  TriangleMesh& m_mesh;
  Motions m_motions;
  std::vector<Pose> m_poses;
  std::optional<Intersection> m_intersection;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FURTHER_POSES_H
