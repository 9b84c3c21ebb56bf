// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BENCHMARK_CGAL_POLICIES_H
#define SELVEDGE_BENCHMARK_CGAL_POLICIES_H

#include "Peers.h"

#include <selvedge/Surface_mesh_simplification/stop_predicates.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cstddef>

// Reductions by CGAL alone: its loop with its own policies, as its manual shows them, without a filter.

namespace selvedge::benchmark {

using Cgal_mesh = CGAL::Surface_mesh<Point_3>;

/// Makes policies of the mesh of a soup, and reduces it by them. `make_policies(mesh)` returns an object with
/// `get_cost()` and `get_placement()`.
template <class Make_policies>
Outcome run_cgal(const Triangle_soup& soup, std::size_t faces, const Make_policies& make_policies)
{
  Cgal_mesh mesh;
  for (const Point_3& p : soup.points)
    mesh.add_vertex(p);
  for (const auto& [a, b, c] : soup.triangles)
    mesh.add_face(Cgal_mesh::Vertex_index(a), Cgal_mesh::Vertex_index(b), Cgal_mesh::Vertex_index(c));
  const Stopwatch stopwatch;
  const auto policies = make_policies(mesh);
  CGAL::Surface_mesh_simplification::edge_collapse(
      mesh, Face_count_stop(faces),
      CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  const double seconds = stopwatch.seconds();
  mesh.collect_garbage();
  return {soup_of(mesh), seconds, soup.points.size() - mesh.number_of_vertices()};
}

inline Outcome run_garland_heckbert(const Triangle_soup& soup, std::size_t faces)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Policies = CGAL::Surface_mesh_simplification::GarlandHeckbert_plane_policies<Cgal_mesh, Kernel>;
  return run_cgal(soup, faces, [](Cgal_mesh& mesh) { return Policies(mesh); });
}

inline Outcome run_lindstrom_turk(const Triangle_soup& soup, std::size_t faces)
{
  struct Policies
  {
    CGAL::Surface_mesh_simplification::LindstromTurk_cost<Cgal_mesh> get_cost() const { return {}; }
    CGAL::Surface_mesh_simplification::LindstromTurk_placement<Cgal_mesh> get_placement() const { return {}; }
  };
  return run_cgal(soup, faces, [](const Cgal_mesh&) { return Policies(); });
}

} // namespace selvedge::benchmark

#endif // SELVEDGE_BENCHMARK_CGAL_POLICIES_H
