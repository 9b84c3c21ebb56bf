// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERSECTION_FILTER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERSECTION_FILTER_H

#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>
#include <selvedge/Surface_mesh_simplification/internal/Intersection_guard.h>
#include <selvedge/spatial/Packed_R_tree.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>

#include <memory>
#include <utility>

namespace selvedge {

/// Refuses a collapse in which anything would touch or pass through anything: the exact filter.
///
/// A model of CGAL's concept `PlacementFilter`, usable with any placement and cost. Give the loop both the
/// filter and its visitor:
/// ```
/// selvedge::Intersection_filter<Mesh> filter(mesh);
/// edge_collapse(mesh, stop, CGAL::parameters::filter(filter).visitor(filter.visitor()));
/// ```
///
/// **Guarantees** when the mesh is embedded at the start, that is, all its faces are proper triangles, no two
/// have the same three positions, and any two meet exactly in the positions (none, one, or two and the edge
/// between them) that they share:
/// 1. *Embedded*: it is so after every collapse.
/// 2. *Motion*: between two collapses nothing passes through anything. A merged vertex at one end of the
///    edge means that the other moves there on a straight line; one elsewhere means two such motions, one
///    after the other, in whichever order is free.
/// 3. A vertex that shares its position with another vertex does not move; others may move to where it is.
///
/// **Preconditions** the caller must ensure: the mesh outlives the filter, and between its construction and
/// the end of the loop changes by the loop alone, with the visitor attached; around every vertex there is one
/// fan of faces, for others the vertex does not lead to (`CGAL::Polygon_mesh_processing` duplicates such
/// vertices). Checked, in every build: no edge has length zero, which CGAL's loop would collapse without
/// asking (`Argument_error`).
///
/// **Not promised** for a mesh that is not embedded at the start; see `simplify` for what can be done there.
///
/// **Exactness** Decided by the predicates of `GeomTraits`, which must be exact, as
/// `Exact_predicates_inexact_constructions_kernel` has them. No tolerance, no construction.
///
/// **Complexity** One query of the index for the box of the star that moves, then a constant number of
/// predicates for each pair of a moving face and a face whose box meets its sweep.
///
/// **Reference** Derichs, Misiak, Fuhrmann: Intersection-free mesh decimation for high resolution cloth
/// models, section 4; Gumhold, Borodin, Klein: Intersection free simplification.
template <class TriangleMesh, class BaseFilter = No_filter, class FaceIndex = Packed_R_tree,
          class VertexPointMap = typename boost::property_map<TriangleMesh, CGAL::vertex_point_t>::const_type,
          class GeomTraits = typename CGAL::Kernel_traits<
              typename boost::property_traits<VertexPointMap>::value_type>::Kernel>
class Intersection_filter
    : public internal::Filter_base<
          Intersection_filter<TriangleMesh, BaseFilter, FaceIndex, VertexPointMap, GeomTraits>, BaseFilter>
{
  using Guard = internal::Intersection_guard<TriangleMesh, VertexPointMap, GeomTraits, FaceIndex>;

public:
  using Face = typename boost::graph_traits<TriangleMesh>::face_descriptor;

  /// Keeps the filter's index true while edges collapse.
  ///
  /// A model of CGAL's concept `EdgeCollapseSimplificationVisitor`.
  class Visitor : public CGAL::Surface_mesh_simplification::Edge_collapse_visitor_base<TriangleMesh>
  {
  public:
    explicit Visitor(const std::shared_ptr<Guard>& guard) : m_guard(guard) {}

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

    /// The same for a loop that knows which end moves.
    template <class Collapse>
    void before_collapse(const Collapse& collapse)
    {
      m_guard->before_collapse(collapse);
    }
    template <class Vertex>
    void after_collapse(const Vertex& kept)
    {
      m_guard->after_collapse(kept);
    }

  private:
    std::shared_ptr<Guard> m_guard;
  };

  /// `index` is empty.
  explicit Intersection_filter(const TriangleMesh& mesh, const BaseFilter& base = {},
                               FaceIndex index = FaceIndex())
      : Intersection_filter(mesh, base, std::move(index), get(CGAL::vertex_point, mesh))
  {
  }

  /// With a vertex point map that is not the mesh's own.
  Intersection_filter(const TriangleMesh& mesh, const BaseFilter& base, FaceIndex index,
                      const VertexPointMap& points, const GeomTraits& traits = {})
      : internal::Filter_base<Intersection_filter, BaseFilter>(base),
        m_guard(std::make_shared<Guard>(mesh, points, traits, std::move(index)))
  {
  }

  Visitor visitor() const { return Visitor(m_guard); }

  template <class Collapse>
  bool allows(const Collapse& collapse) const
  {
    m_guard->forget_blockers();
    return internal::Filter_base<Intersection_filter, BaseFilter>::allows(collapse);
  }

  template <class Collapse>
  bool accepts(const Collapse& collapse) const
  {
    return m_guard->is_clear(collapse);
  }

  /// The faces that made this filter refuse the last placement, or one of two ways to it; none where what
  /// lies around the edge alone decided, as always when the base refused.
  auto& blockers() const { return m_guard->blockers(); }

  const Intersection_statistics& statistics() const { return m_guard->statistics(); }
  const FaceIndex& index() const { return m_guard->index(); }

private:
  std::shared_ptr<Guard> m_guard;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERSECTION_FILTER_H
