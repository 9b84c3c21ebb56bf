// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FILTER_CHAIN_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FILTER_CHAIN_H

#include <selvedge/Simplify_options.h>
#include <selvedge/Simplify_report.h>
#include <selvedge/Surface_mesh_simplification/Aspect_ratio_filter.h>
#include <selvedge/Surface_mesh_simplification/Border_filter.h>
#include <selvedge/Surface_mesh_simplification/Error_filter.h>
#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Normal_change_filter.h>
#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/Surface_mesh_simplification/internal/Border_partners.h>
#include <selvedge/Surface_mesh_simplification/internal/Face_targets.h>
#include <selvedge/Surface_mesh_simplification/internal/Further_poses.h>
#include <selvedge/Surface_mesh_simplification/internal/Halfedge_filter.h>
#include <selvedge/Surface_mesh_simplification/internal/Reduction_setup.h>
#include <selvedge/Surface_mesh_simplification/internal/Tracked_points.h>
#include <selvedge/spatial/internal/Selectable_index.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Says whether a reduction allows a collapse: the chain of all its filters. The cheap limits are asked
/// first, in the mesh's own pose and in all others, and then the exact test in each of them. The error in the
/// mesh's own pose comes after the exact test while that has refused more.
///
/// It has what the filters ask, and keeps that in step with the mesh: the border rule, the face targets, the
/// partners of border vertices, the tracked points. It counts what each filter refuses, and names the first
/// that holds back a collapse.
template <class TriangleMesh, class VertexPointMap, class Observer>
class Filter_chain
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Geom_traits =
      typename CGAL::Kernel_traits<typename boost::property_traits<VertexPointMap>::value_type>::Kernel;

public:
  using Face = typename Graph_traits::face_descriptor;
  using Rule = Border_rule<TriangleMesh, VertexPointMap>;
  using Targets = Face_targets<TriangleMesh>;
  using Partners = Border_partners<TriangleMesh>;

private:
  // Whether a face lies in a strip between two lines, such as the edge of thick cloth: its corners are on
  // lines after the collapse, and at most one of its edges is a line. However long it is, the strip is no
  // wider.
  struct Is_of_strip
  {
    const TriangleMesh* mesh;
    Rule rule;

    template <class Profile>
    bool operator()(const Collapse<Profile>& collapse, const Halfedge& h) const
    {
      const Halfedge sides[] = {h, next(h, *mesh), prev(h, *mesh)};
      const auto is_line = [this](const Halfedge& side) { return rule.is_line(edge(side, *mesh)); };
      return rule.may_bound_strip(source(h, *mesh)) && rule.may_bound_strip(target(sides[1], *mesh)) &&
             (rule.may_bound_strip(collapse.mover()) || rule.may_bound_strip(collapse.goal())) &&
             std::count_if(std::begin(sides), std::end(sides), is_line) <= 1;
    }
  };

  struct Are_pieces_kept
  {
    const Observer* observer;
    Rule rule;

    bool operator()(const Halfedge& moving) const { return observer->keeps_pieces(moving, rule); }
  };

  struct Are_partners_kept
  {
    const Partners* partners;

    bool operator()(const Halfedge& moving) const { return partners->allows(moving); }
  };

  struct Is_uv_orientation_kept
  {
    const Observer* observer; // null: every motion is accepted
    Rule rule;

    template <class Profile>
    bool operator()(const Collapse<Profile>& collapse) const
    {
      if (!observer)
        return true;
      return collapse.are_both_moved()
                 ? observer->keeps_uv_orientation_at(collapse.moving(), collapse.place())
                 : observer->keeps_uv_orientation(collapse.moving(), rule);
    }
  };

  using Line = Border_filter<Rule>;
  using Pieces = Halfedge_filter<Are_pieces_kept, Line>;
  using Border = Halfedge_filter<Are_partners_kept, Pieces>;
  using Target = Halfedge_filter<Targets, Border>;
  using Aspect_ratio = Aspect_ratio_filter<Target, Is_of_strip>;
  using Normal_change = Normal_change_filter<Aspect_ratio>;
  using Uv = Halfedge_filter<Is_uv_orientation_kept, Normal_change>;
  using Error = Error_filter<Tracked_points<TriangleMesh>>;
  using Intersection =
      Intersection_filter<TriangleMesh, No_filter, Selectable_index, VertexPointMap, Geom_traits>;

public:
  using Poses = Further_poses<TriangleMesh, Is_of_strip>;

  /// **Preconditions** The mesh, the options, the constraints and the observer outlive the chain.
  Filter_chain(const Reduction_setup<TriangleMesh>& setup, const VertexPointMap& points,
               const Observer& observer)
      : m_mesh(setup.mesh), m_points(points), m_options(setup.options), m_rule(setup.border_rule(points)),
        m_targets(setup.face_targets()), m_partners(m_mesh, setup.constraints.partners), m_line(m_rule),
        m_pieces({&observer, m_rule}, m_line), m_border({&m_partners}, m_pieces),
        m_target(m_targets, m_border),
        m_aspect_ratio(m_options.min_aspect_ratio, m_target, {&m_mesh, m_rule}),
        m_normal_change(m_options.max_normal_change, m_aspect_ratio, setup.max_corner_height()),
        m_uv({m_options.check_uv_orientation ? &observer : nullptr, m_rule}, m_normal_change),
        m_tracked(m_mesh), m_error(setup.max_error, m_tracked), m_poses(setup, {&m_mesh, m_rule}),
        m_constraints(setup.constraints), m_diagonal(setup.diagonal), m_max_error(setup.max_error)
  {
  }

  Filter_chain(const Filter_chain&) = delete; // filters refer to partners
  Filter_chain& operator=(const Filter_chain&) = delete;

  const Rule& border_rule() const { return m_rule; }
  const Targets& targets() const { return m_targets; }
  const Partners& partners() const { return m_partners; }
  const Poses& poses() const { return m_poses; }

  /// Takes points of the original, from which the result may not come too far. Others may read the mesh
  /// meanwhile.
  void track_points()
  {
    if (m_options.max_error)
      m_tracked.begin(m_points, m_diagonal, m_max_error);
  }

  /// Sets the target of all faces that have none of their own.
  void set_target(std::size_t faces) { m_targets.set_target(0, faces); }

  /// Makes the indices of faces, without which there is no exact test.
  void build_index()
  {
    if (!m_options.check_intersections)
      return;
    m_intersection.emplace(m_mesh, No_filter(), empty_index(), m_points);
    const double shallow = Simplify_constraints<TriangleMesh>::s_share_of_shallow_pairs * m_diagonal;
    m_intersection->exempt(m_constraints.offending_pairs, m_constraints.multiplicities, shallow);
    m_intersection->let_intersect(m_constraints.may_intersect);
    if (m_options.clearance)
      m_intersection->keep_clearance(*m_options.clearance, m_constraints.uncounted_faces);
    m_visitor = m_intersection->visitor();
    m_poses.build_index([this] { return empty_index(); }, m_constraints, m_options.clearance, shallow);
  }

  /// Whether all filters but the exact test allow a collapse.
  template <class Profile>
  bool allows_shape(const Collapse<Profile>& collapse) const
  {
    return m_uv.allows(collapse) && m_error.allows(collapse) && m_poses.allows_shape(collapse);
  }

  template <class Profile>
  bool allows(const Collapse<Profile>& collapse)
  {
    m_blockers = nullptr;
    const bool is_error_last = m_error.refusals() < m_refused_by_contact;
    return m_uv.allows(collapse) && (is_error_last || m_error.allows(collapse)) &&
           m_poses.allows_shape(collapse) && is_clear(collapse) &&
           (!is_error_last || m_error.allows(collapse));
  }

  /// Returns the faces because of which the exact test refused the last collapse, if that refused it.
  const std::vector<Face>& blockers() const
  {
    static const std::vector<Face> none;
    return m_blockers ? *m_blockers : none;
  }

  /// See `Intersection_filter::is_mover_first`.
  bool is_mover_first() const { return m_intersection && m_intersection->is_mover_first(); }

  /// Returns the first limit that holds back a collapse in the mesh's own pose, apart from the exact test and
  /// from the border rule, which says itself why it refuses; `by_loop` if none does. It counts nothing.
  template <class Profile>
  Hindrance hindrance_of_shape(const Collapse<Profile>& collapse) const
  {
    if (!m_pieces.accepts(collapse))
      return Hindrance::topology;
    if (!m_border.accepts(collapse))
      return Hindrance::gap;
    if (!m_target.accepts(collapse))
      return Hindrance::target;
    if (!m_aspect_ratio.accepts(collapse))
      return Hindrance::aspect_ratio;
    if (!m_normal_change.accepts(collapse))
      return Hindrance::normal_change;
    if (!m_uv.accepts(collapse))
      return Hindrance::uv;
    if (!m_error.accepts(collapse))
      return Hindrance::error;
    return Hindrance::by_loop;
  }

  /// The same with the exact test, and in all poses.
  template <class Profile>
  Hindrance hindrance(const Collapse<Profile>& collapse) const
  {
    const Hindrance reason = hindrance_of_shape(collapse);
    if (reason != Hindrance::by_loop)
      return reason;
    const Halfedge h = collapse.moving();
    const bool is_border = CGAL::is_border(h, m_mesh) || CGAL::is_border(opposite(h, m_mesh), m_mesh);
    if (const auto in_pose = m_poses.hindrance(collapse, is_border))
      return *in_pose;
    if (!m_intersection)
      return reason;
    const auto refused_by_contact = [this] {
      const Intersection_statistics& statistics = m_intersection->statistics();
      return statistics.refused_by_star + statistics.refused_by_sweep + statistics.refused_by_descent;
    };
    const std::size_t before = refused_by_contact();
    if (m_intersection->accepts(collapse))
      return Hindrance::by_loop;
    if (m_intersection->is_clearance_lacking())
      return Hindrance::clearance;
    return refused_by_contact() > before ? Hindrance::intersection : Hindrance::topology;
  }

  /// Called when a loop begins to ask.
  void on_started()
  {
    if (m_visitor)
      m_visitor->OnStarted(m_mesh);
    m_poses.on_started();
  }

  template <class Profile>
  void before_collapse(const Collapse<Profile>& collapse)
  {
    m_targets.before_collapse(collapse.moving());
    m_partners.before_collapse(collapse.moving());
    m_tracked.before_collapse(collapse);
    m_rule.before_collapse(collapse);
    m_poses.before_collapse(collapse);
    if (m_visitor)
      m_visitor->before_collapse(collapse);
  }
  void after_collapse(Vertex kept)
  {
    m_partners.after_collapse(kept);
    m_rule.after_collapse(kept);
    m_poses.after_collapse(kept);
    if (m_visitor)
      m_visitor->after_collapse(kept);
  }

  Refusals refusals() const
  {
    Refusals result;
    result.border = m_line.refusals() + m_pieces.refusals() + m_border.refusals();
    result.target = m_target.refusals();
    result.error = m_error.refusals();
    result.aspect_ratio = m_aspect_ratio.refusals();
    result.normal_change = m_normal_change.refusals();
    result.uv = m_uv.refusals();
    result.intersection = m_refused_by_contact;
    m_poses.add_refusals(result);
    result.intersection -= m_refused_by_clearance;
    result.clearance = m_refused_by_clearance;
    return result;
  }

  /// Adds what a report says of the exact test.
  void add_statistics(Simplify_report& report) const
  {
    for (std::size_t i = 0; i < m_poses.size(); ++i)
      report.refused_in_poses.push_back(m_poses.refused_in(i));
    if (m_intersection) {
      report.intersections = m_intersection->statistics();
      report.index = m_intersection->index().statistics();
    }
  }

private:
  // Whether the exact test allows a collapse in every pose.
  template <class Profile>
  bool is_clear(const Collapse<Profile>& collapse)
  {
    if (!m_intersection)
      return true;
    if (!is_clear_in_own_pose(collapse)) {
      ++m_refused_by_contact;
      m_refused_by_clearance += m_is_clearance_lacking;
      return false;
    }
    if (m_poses.is_clear(collapse))
      return true;
    m_refused_by_clearance += m_poses.is_clearance_lacking();
    m_blockers = &m_poses.blockers();
    return false;
  }

  template <class Profile>
  bool is_clear_in_own_pose(const Collapse<Profile>& collapse)
  {
    if (m_intersection->accepts(collapse))
      return true;
    m_blockers = &m_intersection->blockers();
    m_is_clearance_lacking = m_intersection->is_clearance_lacking();
    return false;
  }

  Selectable_index empty_index() const
  {
    Clustered_AABB_tree clustered(m_options.faces_per_cluster); // made in any case, so that 0 is refused
    return m_options.index == Face_index::packed ? Selectable_index(Packed_R_tree())
                                                 : Selectable_index(std::move(clustered));
  }

  TriangleMesh& m_mesh;
  VertexPointMap m_points;
  const Simplify_options& m_options;
  Rule m_rule;
  Targets m_targets;
  Partners m_partners;
  Line m_line;
  Pieces m_pieces;
  Border m_border;
  Target m_target;
  Aspect_ratio m_aspect_ratio;
  Normal_change m_normal_change;
  Uv m_uv;
  Tracked_points<TriangleMesh> m_tracked;
  Error m_error;
  Poses m_poses;
  const Simplify_constraints<TriangleMesh>& m_constraints;
  double m_diagonal, m_max_error;
  std::optional<Intersection> m_intersection;
  std::optional<typename Intersection::Visitor> m_visitor; // of that filter
  const std::vector<Face>* m_blockers = nullptr;
  bool m_is_clearance_lacking = false;    // of what the exact test refused last in the mesh's own pose
  std::size_t m_refused_by_contact = 0;   // or by lack of clearance, in the mesh's own pose
  std::size_t m_refused_by_clearance = 0; // in any pose
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FILTER_CHAIN_H
