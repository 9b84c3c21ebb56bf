// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_SIMPLIFY_MESH_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_SIMPLIFY_MESH_H

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/No_observer.h>
#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/Surface_mesh_simplification/internal/Simplification.h>
#include <selvedge/Surface_mesh_simplification/parameters.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <type_traits>

namespace selvedge {

/// Reduces a triangle mesh by halfedge collapses until a target is reached or no collapse is allowed any
/// more, without letting any face touch or pass through another.
///
/// `options` say how far to reduce and within which limits, `constraints` what is special about single
/// elements. `observer` derives from `No_observer`. Of CGAL's named parameters it takes `vertex_point_map`
/// (by default, that of the mesh); any other does not compile.
///
/// **Guarantees** for an embedded mesh. *Embedded* means: all faces are proper triangles, no two have the
/// same three positions, and any two meet exactly in the positions that they share (none, one, or two and the
/// edge between them).
/// - G1 *Embedded*: the mesh is embedded after every collapse, and so whenever the reduction ends.
/// - G2 *Motion*: nothing passes through anything during a collapse; the order of layers is kept.
/// - G4 *Topology*: components, boundary loops and Euler characteristic are kept.
/// - G5 *Seams*: borders and line edges change only along themselves, within the turn and the drift allowed.
/// - G7 *Stop*: the target is reached, or the report says that it was not, and what holds back
///   every edge that is left.
/// - G8 *Determinism*: the same mesh and options give the same result.
///
/// For a mesh that is not embedded, lock the vertices of every face of an offending pair; then the offending
/// pairs of the result are those of the input, and the guarantees hold between all other faces. Or name all
/// offending pairs in the constraints; then every offending pair of the result descends from one of the
/// input, there are no more of them, and the guarantees hold for all other pairs (docs/guarantees.md).
///
/// **Preconditions** The caller must ensure: all faces are triangles; `TriangleMesh` is a mutable face graph
/// whose points belong to a kernel with exact predicates, as those of the vertex point map do. Checked at run
/// time (`Argument_error`): the options are in range; no edge has length zero, if intersections are checked;
/// the diagonal of the bounding box is 0 or from 2^-200 to 2^200. Of the options for soups alone,
/// `faces_per_cell`, and `on_collapse`, which the observer replaces, are refused when set. `guarded_poses` has
/// no effect, since all poses of the constraints are guarded, and nothing is recorded or kept of the
/// progression and the history.
///
/// In this range of sizes, no computation of quality overflows, and none vanishes except areas of less than
/// 2^-100 of the squared diagonal. Without such areas, the steps are the same for a mesh and for the mesh
/// multiplied by a power of two. Soups (simplify.h) may have any size.
///
/// **Exactness** Exact predicates alone decide everything about intersections. Everything about quality is in
/// floating point.
///
/// **Complexity** O(n log n) for n faces as a rule; more where layers are very close. Where neighbours in the
/// mesh have far numbers, as in many files, it takes up to twice the time, and results are up to 4 % farther
/// off: `simplify_soup` numbers its mesh along a Hilbert curve.
///
/// In a `CGAL::Surface_mesh`, the removed elements stay as garbage; `mesh.collect_garbage()` removes them.
///
/// **Reference** Derichs, Misiak, Fuhrmann: Intersection-free mesh decimation for high resolution cloth
/// models.
template <class TriangleMesh, class Observer = No_observer,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Simplify_report simplify_mesh(TriangleMesh& mesh, const Simplify_options& options,
                              const Simplify_constraints<TriangleMesh>& constraints = {},
                              Observer&& observer = Observer(),
                              const NamedParameters& parameters = CGAL::parameters::default_values())
{
  namespace np = CGAL::internal_np;
  static_assert(internal::Are_tags_among<NamedParameters, np::all_default_t, np::vertex_point_t>::value,
                "selvedge::simplify_mesh does not know one of these named parameters");
  if (options.faces_per_cell > 0)
    throw Argument_error("a mesh cannot be reduced in cells: set faces_per_cell to 0, or use simplify_soup");
  if (options.on_collapse)
    throw Argument_error("on_collapse is for soups: give simplify_mesh an observer instead");
  const auto points =
      CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(parameters, np::vertex_point),
                                         CGAL::get_property_map(CGAL::vertex_point, mesh));
  return internal::Simplification<TriangleMesh, std::remove_reference_t<Observer>,
                                  std::remove_const_t<decltype(points)>>(mesh, options, constraints, observer,
                                                                         points)
      .run();
}

/// The same without constraints and observer, as CGAL's functions are called:
///
/// ```
/// selvedge::simplify_mesh(mesh, options, CGAL::parameters::vertex_point_map(points));
/// ```
template <class TriangleMesh, class T, class Tag, class Base>
Simplify_report simplify_mesh(TriangleMesh& mesh, const Simplify_options& options,
                              const CGAL::Named_function_parameters<T, Tag, Base>& parameters)
{
  return simplify_mesh(mesh, options, {}, No_observer(), parameters);
}

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_SIMPLIFY_MESH_H
