// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CGAL_COMPATIBILITY_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CGAL_COMPATIBILITY_H

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/version.h>

#if CGAL_VERSION_NR >= 1060000000
#include <optional>
#else
#include <boost/optional.hpp>
#endif

#include <cstddef>

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
  return num_faces(mesh);
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CGAL_COMPATIBILITY_H
