// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BENCHMARK_PEERS_H
#define SELVEDGE_BENCHMARK_PEERS_H

#include "Openmesh_decimater.h"
#ifdef SELVEDGE_HAS_LIBIGL
#include "Libigl_decimater.h"
#endif

#include "soup/Working_mesh.h"
#include "soup/selection.h"
#include <selvedge/internal/Stopwatch.h>
#include <selvedge/simplify.h>

#include <meshoptimizer.h>

#include <cstddef>
#include <utility>
#include <vector>

// Reductions of one mesh by ours and by other programs.

namespace selvedge::benchmark {

/// What one program made of a mesh.
struct Outcome
{
  Triangle_soup soup;
  double seconds; // of the reduction alone: from the quadrics to the last collapse
  std::size_t collapses;
};

using internal::Stopwatch;

/// The triangles of a mesh, which has no garbage.
template <class Surface_mesh>
Triangle_soup soup_of(const Surface_mesh& mesh)
{
  Triangle_soup soup;
  for (const auto v : mesh.vertices())
    soup.points.push_back(mesh.point(v));
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    soup.triangles.push_back({mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))});
  }
  return soup;
}

/// The mesh that ours works on, in which coincident borders are sewn: what the others are given too.
inline Triangle_soup sewn(const Prepared_soup& prepared)
{
  Working_mesh working(prepared.soup, prepared.positions, prepared.is_frozen);
  return soup_of(working.mesh());
}

inline Outcome run_ours(const Prepared_soup& prepared, const Simplify_options& options)
{
  Simplified_soup result = simplify_soup(prepared, options);
  return {std::move(result.soup), result.report.seconds_reduce, result.report.collapses};
}

inline Outcome run_openmesh(const Triangle_soup& soup, const Simplify_options& options, std::size_t faces)
{
  Openmesh_decimater openmesh(soup, options);
  const Stopwatch stopwatch;
  const std::size_t collapses = openmesh.reduce_to(faces);
  Outcome outcome{{}, stopwatch.seconds(), collapses};
  outcome.soup.points = soup.points;
  outcome.soup.triangles = openmesh.triangles();
  return outcome;
}

#ifdef SELVEDGE_HAS_LIBIGL
inline Outcome run_libigl(const Triangle_soup& soup, std::size_t faces)
{
  Libigl_decimater libigl(soup);
  std::size_t collapses = 0;
  const Stopwatch stopwatch;
  libigl.reduce_to(faces, [&](std::size_t, std::size_t) { ++collapses; });
  const double seconds = stopwatch.seconds();
  return {libigl.soup(), seconds, collapses};
}
#endif

inline Outcome run_meshoptimizer(const Triangle_soup& soup, std::size_t faces)
{
  std::vector<float> coordinates;
  for (const Point_3& p : soup.points)
    for (int axis = 0; axis < 3; ++axis)
      coordinates.push_back(static_cast<float>(p[axis]));
  std::vector<unsigned int> corners;
  for (const Index_triple& triangle : soup.triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  constexpr float any_error = 1;
  std::vector<unsigned int> left(corners.size());
  const Stopwatch stopwatch;
  left.resize(meshopt_simplify(left.data(), corners.data(), corners.size(), coordinates.data(),
                               soup.points.size(), 3 * sizeof(float), 3 * faces, any_error));
  Outcome outcome{{}, stopwatch.seconds(), 0};
  outcome.soup.points = soup.points; // unrounded
  for (std::size_t i = 0; i < left.size(); i += 3)
    outcome.soup.triangles.push_back({left[i], left[i + 1], left[i + 2]});
  outcome.collapses = count_of_used_vertices(soup) - count_of_used_vertices(outcome.soup);
  return outcome;
}

} // namespace selvedge::benchmark

#endif // SELVEDGE_BENCHMARK_PEERS_H
