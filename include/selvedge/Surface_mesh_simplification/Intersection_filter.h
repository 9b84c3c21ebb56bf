// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERSECTION_FILTER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERSECTION_FILTER_H

#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>
#include <selvedge/Surface_mesh_simplification/internal/Intersection_guard.h>
#include <selvedge/Surface_mesh_simplification/internal/No_visitor.h>
#include <selvedge/Surface_mesh_simplification/parameters.h>
#include <selvedge/spatial/Packed_R_tree.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace selvedge {

/// Refuses a collapse in which faces would touch or pass through each other: the exact filter.
///
/// A model of CGAL's concept `PlacementFilter`, usable with any placement and cost. Give the loop both the
/// filter and its visitor, alone or in a `Visitor_chain`. With edge_collapse.h:
///
/// ```
/// const selvedge::Intersection_filter<Mesh> filter(mesh);
/// selvedge::edge_collapse(mesh, stop, CGAL::parameters::filter(filter).visitor(filter.visitor()));
/// ```
///
/// **Guarantees** when the mesh is embedded at the start. *Embedded* means: all faces are proper triangles,
/// no two have the same three positions, and any two meet exactly in the positions that they share (none,
/// one, or two and the edge between them).
/// - G1 *Embedded*: the mesh is embedded after every collapse.
/// - G2 *Motion*: nothing passes through anything during a collapse. When the merged vertex is placed at one
///   end of the edge, the other end moves there on a straight line. When it is placed elsewhere, the two ends
///   move there one after the other, in an order in which both motions are free.
/// - Coincident vertices do not move, unless all at a position move together (`Simplify_constraints` names
///   such vertices to `simplify_mesh`). Others may move to their position.
///
/// **Preconditions** The caller must ensure that the mesh outlives the filter; that between the construction
/// of the filter and the end of the loop, only the loop changes the mesh. Checked in every build, with an
/// `Argument_error`:
/// - at the construction: all faces are triangles, all coordinates are finite, no edge has length zero
///   (CGAL's loop would collapse such an edge without asking a filter), and the faces around every vertex
///   form one fan (`duplicate_non_manifold_vertices()` of `CGAL::Polygon_mesh_processing` separates several);
/// - when the loop begins: its mesh is that of the filter, its vertices are where they were, and no earlier
///   run was left by an exception within a collapse, before the filter's visitor was told that it is done;
/// - when the loop asks the filter for the first time, before any collapse: it has called the visitor's
///   `OnStarted`, as both loops do before they ask. Nothing earlier tells a loop without the visitor from one
///   that has not begun. A program that asks the filter itself calls `filter.visitor().OnStarted(mesh)`
///   first;
/// - before the first collapse that an incomplete index would judge: a visitor that announced the run has
///   announced the collapses as well;
/// - after each collapse: the vertex point map holds the point that was judged. A map that rounds what is put
///   into it, as OpenMesh's map of floats does, takes placements at an end of the edge alone
///   (`Halfedge_placement`). The collapse that fails this check has been done, and may intersect.
///
/// **Meshes that are not embedded** at the start: nothing is promised, unless `exempt` names all offending
/// pairs. Then these pairs and their descendants are exempt from G1 and G2, all others are not, and there are
/// never more offending pairs than at the start (docs/guarantees.md). Nothing is promised of the pairs that
/// `let_intersect` names either.
///
/// **Exactness** The predicates of `GeomTraits` decide. They must be exact, as those of
/// `Exact_predicates_inexact_constructions_kernel` are; kernels for which they are not do not compile, nor
/// does any of this with -ffast-math. A thread that rounds otherwise than to the nearest or takes subnormal
/// numbers for 0, as code that was compiled so may have set it, or that does not round upwards when told to,
/// as under Valgrind, is refused when the filter is made and when a loop begins (`Argument_error`).
/// Tolerances and constructed points take no part.
///
/// **Complexity** For each motion of a vertex: one query of the index for the box of the vertex's star, then
/// a constant number of predicates for each pair of a moving face and a face whose box meets its sweep. The k
/// faces of the star take O(k) predicates among themselves as a rule, and O(k²) where one view does not
/// settle them.
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

  /// Keeps the filter's index up to date while edges collapse.
  ///
  /// A model of CGAL's concept `EdgeCollapseSimplificationVisitor`.
  class Visitor : public internal::No_visitor
  {
  public:
    explicit Visitor(const std::shared_ptr<Guard>& guard) : m_guard(guard) {}

    void OnStarted(TriangleMesh& mesh) { m_guard->on_started(mesh); }
    void OnFinished(TriangleMesh&) { m_guard->on_finished(); }
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

  /// `index` is an empty index, which the filter fills.
  explicit Intersection_filter(const TriangleMesh& mesh, const BaseFilter& base = {},
                               FaceIndex index = FaceIndex())
      : Intersection_filter(mesh, base, std::move(index), get(CGAL::vertex_point, mesh))
  {
  }

  /// The same with a vertex point map that is not the mesh's own.
  Intersection_filter(const TriangleMesh& mesh, const BaseFilter& base, FaceIndex index,
                      const VertexPointMap& points, const GeomTraits& traits = {})
      : internal::Filter_base<Intersection_filter, BaseFilter>(base),
        m_guard(std::make_shared<Guard>(mesh, points, traits, std::move(index)))
  {
  }

  /// Exempts pairs of faces that offend, and all pairs that descend from them; a degenerate face is a pair
  /// with itself. Faces at the moving vertices pass on what they descend from to the faces that a collapse
  /// leaves. A face that is degenerate never changes, but a collapse onto an end of its edge may contract it.
  /// By default, no pair is exempt. `multiplicities` says which faces stand for several triangles in one
  /// place, so that their pairs count as often.
  ///
  /// Where no pair of two faces with one that a collapse changes or removes pierces deeper than `shallow`, a
  /// length, none may do so afterwards; by default, they may. How deep two faces pierce each other is
  /// computed in floating point: it is a limit of quality, which refuses more than the guarantees ask for.
  ///
  /// **Preconditions** The pairs are all that keep the mesh from being embedded, each once. No question has
  /// been asked yet.
  void exempt(const std::vector<std::pair<Face, Face>>& offending_pairs,
              const std::vector<std::pair<Face, unsigned>>& multiplicities = {},
              double shallow = std::numeric_limits<double>::infinity()) const
  {
    m_guard->exempt(offending_pairs, multiplicities, shallow);
  }

  /// Lets faces of two parts intersect each other, at the start and afterwards: no face of the first is
  /// compared with one of the second. All other pairs stay guarded. The parts of a pair are never joined: no
  /// vertex merges with another where faces of both would meet.
  ///
  /// Throws `Argument_error` when there are more than 32 pairs of parts, when a face belongs to both parts of
  /// a pair, and when faces of both have a common vertex.
  ///
  /// **Preconditions** No question has been asked yet.
  void let_intersect(const std::vector<std::pair<std::vector<Face>, std::vector<Face>>>& parts) const
  {
    m_guard->let_intersect(parts);
  }

  /// Keeps pieces apart: no two come nearer to each other than `distance` or, if they are nearer already,
  /// than they are. A piece is a set of faces that are connected by common positions. The faces of an
  /// `obstacle`, whose vertices are locked, connect nothing, and none of them belongs to a piece that moves:
  /// all that moves keeps the distance from each of them.
  ///
  /// - G12 *Clearance*: after every collapse, and at every time on the way, the distance of any two pieces is
  ///   at least the lesser of `distance` and what it was at the start. This is so place by place: a moving
  ///   face stays at least as far from any face of another piece as `distance`, or as the star of its vertex
  ///   was before (`Clearance_test`). Pairs that `exempt` or `let_intersect` names have no clearance.
  ///
  /// It is decided exactly, for the double given. Throws `Argument_error` when this is not positive and
  /// finite.
  ///
  /// **Preconditions** No question has been asked yet. **Complexity** For each motion, one more query of the
  /// index, for a box that is larger by `distance` on all sides, and the time of `Clearance_test` for each
  /// face of another piece in it.
  void keep_clearance(double distance, const std::vector<Face>& obstacle = {}) const
  {
    m_guard->keep_clearance(distance, obstacle);
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
    m_guard->forget_blockers();
    return m_guard->is_clear(collapse);
  }

  /// Returns the faces because of which this filter refused the last collapse: at most one for each order of
  /// motions that it tried, or all with which exempt pairs would offend, where these are what it refuses.
  /// Empty where the star of the moving vertex alone decided. Where the base filter refused, they are what it
  /// names, if it does.
  const std::vector<Face>& blockers() const
  {
    if constexpr (internal::Has_blockers<BaseFilter>::value)
      if (m_guard->blockers().empty())
        return this->base().blockers();
    return m_guard->blockers();
  }

  /// Returns whether the last collapse was refused for nothing but the distance of `keep_clearance`.
  bool is_clearance_lacking() const { return m_guard->is_clearance_lacking(); }

  /// Returns, for the last collapse that this filter accepted with a place at neither end, in which order the
  /// ends go there: whether `collapse.mover()` goes first. The other order is asked for first.
  bool is_mover_first() const { return m_guard->is_mover_first(); }

  const Intersection_statistics& statistics() const { return m_guard->statistics(); }
  const FaceIndex& index() const { return m_guard->index(); }

private:
  std::shared_ptr<Guard> m_guard;
};

/// Returns an `Intersection_filter`, whose template arguments follow from named parameters.
///
/// Of CGAL: `filter`, the base filter (none by default); `vertex_point_map` (by default, that of the mesh);
/// `geom_traits` (by default, the kernel of the points). Of `selvedge::parameters`: `face_index`. Any other
/// parameter does not compile.
///
/// ```
/// const auto filter = selvedge::intersection_filter(
///     mesh, selvedge::parameters::face_index<selvedge::Clustered_AABB_tree>(50).filter(base));
/// ```
///
/// It throws what the constructor of the filter throws.
template <class TriangleMesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
auto intersection_filter(const TriangleMesh& mesh,
                         const NamedParameters& parameters = CGAL::parameters::default_values())
{
  namespace np = CGAL::internal_np;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  static_assert(internal::Are_tags_among<NamedParameters, np::all_default_t, np::filter_t, np::vertex_point_t,
                                         np::geom_traits_t, internal::Face_index_t>::value,
                "selvedge::intersection_filter does not know one of these named parameters");
  const auto base = choose_parameter<No_filter>(get_parameter(parameters, np::filter));
  const auto make_index = choose_parameter<internal::Index_maker<Packed_R_tree>>(
      get_parameter(parameters, internal::Face_index_t()));
  const auto points = choose_parameter(get_parameter(parameters, np::vertex_point),
                                       CGAL::get_const_property_map(CGAL::vertex_point, mesh));
  using Points = std::remove_const_t<decltype(points)>;
  using Points_kernel =
      typename CGAL::Kernel_traits<typename boost::property_traits<Points>::value_type>::Kernel;
  const auto traits = choose_parameter<Points_kernel>(get_parameter(parameters, np::geom_traits));
  return Intersection_filter<TriangleMesh, std::remove_const_t<decltype(base)>,
                             std::decay_t<decltype(make_index())>, Points,
                             std::remove_const_t<decltype(traits)>>(mesh, base, make_index(), points, traits);
}

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERSECTION_FILTER_H
