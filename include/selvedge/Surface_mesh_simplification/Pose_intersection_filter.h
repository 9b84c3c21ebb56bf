// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_POSE_INTERSECTION_FILTER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_POSE_INTERSECTION_FILTER_H

#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>
#include <selvedge/Surface_mesh_simplification/internal/Pose_motions.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace selvedge {

/// Refuses a collapse in which a face would touch or pass through another in one of several further poses of
/// the mesh: frames of a simulation, postures of a skeleton, morph targets. A pose is a vertex point map of
/// its own for the same mesh. Give the loop the filter's `visitor()` as well, which also moves the vertices
/// in the poses; and the filter of the mesh's own points as the base:
///
/// ```
/// selvedge::Intersection_filter<Mesh> filter(mesh);
/// selvedge::Pose_intersection_filter poses(mesh, std::vector{pose_1, pose_2}, filter);
/// CGAL::parameters::filter(poses).visitor(selvedge::Visitor_chain(filter.visitor(), poses.visitor()))
/// ```
///
/// A model of CGAL's concept `PlacementFilter`, for placements at an end of the edge (`Halfedge_placement`,
/// for example): a place between the ends is a place in one pose only, and is refused.
///
/// **Guarantees** those of `Intersection_filter`, in each of the poses that is embedded at the start, or of
/// which `exempt` names all offending pairs. A collapse moves a vertex in every pose on a straight line to
/// the point that the other end has in this pose. Nothing is promised between poses, such as half way from
/// one frame to the next.
///
/// **Preconditions** and **Exactness**: those of `Intersection_filter`, for each pose. `PosePointMap` is
/// readable and writable.
///
/// **Complexity** That of `Intersection_filter` for each pose, less where an earlier pose refuses. The pose
/// that refused last is asked first.
template <class TriangleMesh, class PosePointMap, class BaseFilter = No_filter,
          class FaceIndex = Packed_R_tree>
class Pose_intersection_filter
    : public internal::Filter_base<
          Pose_intersection_filter<TriangleMesh, PosePointMap, BaseFilter, FaceIndex>, BaseFilter>
{
  using Base = internal::Filter_base<Pose_intersection_filter, BaseFilter>;
  using Motions = internal::Pose_motions<TriangleMesh, PosePointMap>;
  using In_pose = Intersection_filter<TriangleMesh, No_filter, FaceIndex, PosePointMap>;

  struct State
  {
    explicit State(Motions motions_) : motions(std::move(motions_)) {}

    Motions motions;
    std::vector<In_pose> filters;
    std::size_t first = 0; // is asked first
    const In_pose* refusing = nullptr;
    std::vector<std::size_t> refused; // in each
  };

public:
  using Face = typename In_pose::Face;

  /// Updates the filter while edges collapse. A model of CGAL's concept
  /// `EdgeCollapseSimplificationVisitor`.
  class Visitor : public internal::No_visitor
  {
  public:
    explicit Visitor(const std::shared_ptr<State>& state) : m_state(state) {}

    void OnStarted(TriangleMesh& mesh)
    {
      for (In_pose& filter : m_state->filters)
        filter.visitor().OnStarted(mesh);
    }
    void OnFinished(TriangleMesh& mesh)
    {
      for (In_pose& filter : m_state->filters)
        filter.visitor().OnFinished(mesh);
    }
    template <class Profile, class OptionalPoint>
    void OnCollapsing(const Profile& profile, const OptionalPoint& placement)
    {
      before_collapse(internal::Collapse<Profile>(profile, *placement));
    }
    template <class Profile, class Vertex>
    void OnCollapsed(const Profile&, const Vertex& kept)
    {
      after_collapse(kept);
    }

    /// The same for a loop that passes each collapse as a value, which says which end moves.
    template <class Collapse>
    void before_collapse(const Collapse& collapse)
    {
      m_state->motions.before_collapse(collapse.goal());
      for (std::size_t pose = 0; pose < m_state->filters.size(); ++pose)
        m_state->motions.in_pose(pose, collapse, [&](const auto& in_pose) {
          m_state->filters[pose].visitor().before_collapse(in_pose);
        });
    }
    template <class Vertex>
    void after_collapse(const Vertex& kept)
    {
      m_state->motions.after_collapse(kept);
      for (In_pose& filter : m_state->filters)
        filter.visitor().after_collapse(kept);
    }

  private:
    std::shared_ptr<State> m_state;
  };

  /// Throws `Argument_error` as `Intersection_filter` does, and so when an edge has length zero in some pose.
  Pose_intersection_filter(TriangleMesh& mesh, const std::vector<PosePointMap>& poses,
                           const BaseFilter& base = {})
      : Pose_intersection_filter(mesh, poses, base, [] { return FaceIndex(); })
  {
  }

  /// The same with an empty index for each pose, which `make_index()` returns.
  template <class MakeIndex>
  Pose_intersection_filter(TriangleMesh& mesh, const std::vector<PosePointMap>& poses, const BaseFilter& base,
                           const MakeIndex& make_index)
      : Base(base), m_state(std::make_shared<State>(Motions(mesh, poses)))
  {
    for (const PosePointMap& points : poses)
      m_state->filters.emplace_back(mesh, No_filter(), make_index(), points);
    m_state->refused.resize(poses.size());
  }

  /// As `Intersection_filter::exempt`, for one of the poses.
  void exempt(std::size_t pose, const std::vector<std::pair<Face, Face>>& offending_pairs,
              const std::vector<std::pair<Face, unsigned>>& multiplicities = {},
              double shallow = std::numeric_limits<double>::infinity()) const
  {
    m_state->filters[pose].exempt(offending_pairs, multiplicities, shallow);
  }

  /// As `Intersection_filter::let_intersect`, in all poses.
  void let_intersect(const std::vector<std::pair<std::vector<Face>, std::vector<Face>>>& parts) const
  {
    for (const In_pose& filter : m_state->filters)
      filter.let_intersect(parts);
  }

  /// As `Intersection_filter::keep_clearance`, in all poses; pieces are those of each pose.
  void keep_clearance(double distance, const std::vector<Face>& obstacle = {}) const
  {
    for (const In_pose& filter : m_state->filters)
      filter.keep_clearance(distance, obstacle);
  }

  Visitor visitor() const { return Visitor(m_state); }

  template <class Collapse>
  bool allows(const Collapse& collapse) const
  {
    m_state->refusing = nullptr;
    const bool is_allowed = Base::allows(collapse);
    if (m_state->refusing)
      ++m_state->refused[m_state->first];
    return is_allowed;
  }

  template <class Collapse>
  bool accepts(const Collapse& collapse) const
  {
    m_state->refusing = nullptr;
    if (collapse.are_both_moved())
      return false;
    const std::size_t first = m_state->first, count = m_state->filters.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t pose = i == 0 ? first : i <= first ? i - 1 : i;
      const In_pose& filter = m_state->filters[pose];
      if (!m_state->motions.in_pose(pose, collapse,
                                    [&](const auto& in_pose) { return filter.allows(in_pose); })) {
        m_state->first = pose;
        m_state->refusing = &filter;
        return false;
      }
    }
    return true;
  }

  /// Returns the faces because of which the last collapse asked about was refused in a pose, as
  /// `Intersection_filter::blockers` does. Where no pose refused it, they are what the base filter names, if
  /// it does.
  const std::vector<Face>& blockers() const
  {
    static const std::vector<Face> none;
    if (m_state->refusing)
      return m_state->refusing->blockers();
    if constexpr (internal::Has_blockers<BaseFilter>::value)
      return this->base().blockers();
    else
      return none;
  }

  /// Returns whether the last collapse was refused for nothing but the distance of `keep_clearance`.
  bool is_clearance_lacking() const { return m_state->refusing && m_state->refusing->is_clearance_lacking(); }

  /// Returns how many collapses were refused in a pose.
  std::size_t refusals_in(std::size_t pose) const { return m_state->refused[pose]; }

  const Intersection_statistics& statistics(std::size_t pose) const
  {
    return m_state->filters[pose].statistics();
  }
  const FaceIndex& index(std::size_t pose) const { return m_state->filters[pose].index(); }

private:
  std::shared_ptr<State> m_state;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_POSE_INTERSECTION_FILTER_H
