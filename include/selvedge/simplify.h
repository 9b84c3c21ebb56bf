// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SIMPLIFY_H
#define SELVEDGE_SIMPLIFY_H

#include <selvedge/Surface_mesh_simplification/No_observer.h>
#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/Surface_mesh_simplification/internal/Simplification.h>

#include <type_traits>

namespace selvedge {

/// Reduces a triangle mesh by halfedge collapses until a target is reached or no collapse is allowed any
/// more, without letting anything touch or pass through anything.
///
/// **Guarantees** for an embedded mesh (every face a proper triangle, no two with the same three positions,
/// any two meeting exactly in the positions that they share, and the edge between two of them):
/// 1. *Embedded*: it is embedded after every collapse, so also at the end, however that came.
/// 2. *Motion*: on the way nothing passes through anything; the order of layers is kept.
/// 3. *Topology*: components, boundary loops and Euler characteristic are kept.
/// 4. *Seams*: borders and line edges change only along themselves, within the turn and the drift allowed.
/// 5. *Stop*: the target is reached, or the report says what refused how often.
/// 6. *Determinism*: the same mesh and options give the same result.
///
/// For a mesh that is not embedded, lock the vertices of every face of an offending pair: then the offending
/// pairs of the result are those of the input, and between all other faces the guarantees hold. (The function
/// for soups below does that.)
///
/// **Preconditions** the caller must ensure: the faces are triangles; `TriangleMesh` is a mutable face graph
/// whose points are of a kernel with exact predicates. Checked at run time (`Argument_error`): options in
/// range, no edge of length zero, the diagonal of the bounding box 0 or from 2^-200 to 2^200. Within that
/// range nothing about quality overflows, and nothing vanishes but areas of less than 2^-100 of the squared
/// diagonal; where there are none, the steps of a mesh and of one that is larger by a power of two are the
/// same. Soups (simplify_soup.h) may have any size.
///
/// **Exactness** Everything about intersections, by exact predicates alone; everything about quality, in
/// floating point.
///
/// **Complexity** O(n log n) for n faces as a rule; with layers very close, more.
///
/// For `CGAL::Surface_mesh` the removed elements stay as garbage: `mesh.collect_garbage()` removes them.
///
/// **Reference** Derichs, Misiak, Fuhrmann: Intersection-free mesh decimation for high resolution cloth
/// models.
template <class TriangleMesh, class Observer = No_observer>
Simplify_report simplify(TriangleMesh& mesh, const Simplify_options& options,
                         const Simplify_constraints<TriangleMesh>& constraints = {},
                         Observer&& observer = Observer())
{
  return internal::Simplification<TriangleMesh, std::remove_reference_t<Observer>>(mesh, options, constraints,
                                                                                   observer)
      .run();
}

} // namespace selvedge

#endif // SELVEDGE_SIMPLIFY_H
