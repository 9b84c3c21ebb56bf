// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CGAL_COMPATIBILITY_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CGAL_COMPATIBILITY_H

#include <CGAL/Surface_mesh/Surface_mesh_fwd.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/version.h>

#if CGAL_VERSION_NR >= 1060000000
#include <optional>
#else
#include <boost/optional.hpp>
#endif

#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>

namespace selvedge {
namespace internal {

// The optional type of CGAL's simplification concepts: Boost's up to CGAL 5.6, the standard one from 6.0.
#if CGAL_VERSION_NR >= 1060000000
template <class T>
using Optional = std::optional<T>;
#else
template <class T>
using Optional = boost::optional<T>;
#endif

// Whether num_faces() of a mesh counts faces that have been removed and not yet collected, as OpenMesh's
// does.
template <class TriangleMesh, class = void>
struct Counts_removed_faces : std::false_type
{
};
template <class TriangleMesh>
struct Counts_removed_faces<TriangleMesh,
                            std::void_t<decltype(std::declval<TriangleMesh&>().garbage_collection())>>
    : std::true_type
{
};

// Returns the number of faces. For `Surface_mesh`, num_faces() would include removed faces that are not yet
// collected.
template <class Point>
std::size_t face_count(const CGAL::Surface_mesh<Point>& mesh)
{
  return mesh.number_of_faces();
}
template <class TriangleMesh>
std::size_t face_count(const TriangleMesh& mesh)
{
  static_assert(
      !Counts_removed_faces<TriangleMesh>::value,
      "num_faces() of this mesh counts removed faces, too; stop by the number of edges, for example "
      "with a stop predicate of CGAL");
  return num_faces(mesh);
}

// The same for any face graph, also one whose num_faces() includes removed faces: linear unless it is a
// `Surface_mesh`.
template <class Point>
std::size_t current_faces(const CGAL::Surface_mesh<Point>& mesh)
{
  return mesh.number_of_faces();
}
template <class TriangleMesh>
std::size_t current_faces(const TriangleMesh& mesh)
{
  const auto all = faces(mesh);
  return std::size_t(std::distance(all.begin(), all.end()));
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CGAL_COMPATIBILITY_H
