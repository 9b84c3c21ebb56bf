// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Guards CGAL's simplification with the clustered index of Derichs, Misiak and Fuhrmann: a uniform grid whose
// cells each hold a small CGAL::AABB_tree of faces, so that a collapse changes no more than the trees near
// it.
//   clustered_index IN.off OUT.off [FACES_PER_CLUSTER]
#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/edge_collapse.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>
#include <selvedge/spatial/Clustered_AABB_tree.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/OFF.h>

#include <fstream>
#include <iostream>

int main(int argc, char** argv)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

  Mesh mesh;
  const long faces_per_cluster = argc == 4 ? std::atol(argv[3]) : 100; // the paper's best
  if (argc < 3 || argc > 4 || faces_per_cluster < 1 || !CGAL::IO::read_OFF(argv[1], mesh)) {
    std::cerr << "usage: clustered_index IN.off OUT.off [FACES_PER_CLUSTER]\n";
    return 2;
  }
  //! [call]
  // The filter fills the index with the faces of the mesh, and its visitor updates it after each collapse.
  const auto filter = selvedge::intersection_filter(
      mesh, selvedge::parameters::face_index<selvedge::Clustered_AABB_tree>(faces_per_cluster));
  const int collapses = selvedge::edge_collapse(mesh, selvedge::Face_ratio_stop(0.5, mesh),
                                                CGAL::parameters::filter(filter).visitor(filter.visitor()));
  //! [call]

  const selvedge::Index_statistics& done = filter.index().statistics();
  std::cout << collapses << " collapses, " << filter.refusals() << " refused; " << done.clusters
            << " clusters answered " << done.queries << " queries and were rebuilt " << done.cluster_rebuilds
            << " times\n";

  mesh.collect_garbage();
  std::ofstream out(argv[2]);
  out.precision(17); // as many digits as a double needs: the file holds exactly what was judged
  return CGAL::IO::write_OFF(out, mesh) ? 0 : 1;
}
