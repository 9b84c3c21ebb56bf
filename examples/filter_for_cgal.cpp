// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs CGAL's own simplification, with CGAL's cost and placement, and refuses every collapse in which layers
// would touch or pass through each other.
//   filter_for_cgal IN.off OUT.off
#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/OFF.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <fstream>
#include <iostream>

int main(int argc, char** argv)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel; // any kernel whose predicates are exact
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  namespace SMS = CGAL::Surface_mesh_simplification;

  Mesh mesh;
  if (argc != 3 || !CGAL::IO::read_OFF(argv[1], mesh)) {
    std::cerr << "usage: filter_for_cgal IN.off OUT.off\n";
    return 2;
  }
  //! [call]
  const selvedge::Intersection_filter<Mesh> filter(mesh);
  const int collapses = SMS::edge_collapse(
      mesh, selvedge::Face_ratio_stop(0.5, mesh),
      CGAL::parameters::filter(filter).visitor(filter.visitor())); // give both: the visitor updates the index
  //! [call]
  std::cout << collapses << " collapses, " << filter.refusals()
            << " refused because layers would have touched\n";

  mesh.collect_garbage();
  std::ofstream out(argv[2]);
  out.precision(17); // as many digits as a double needs: the file holds exactly what was judged
  return CGAL::IO::write_OFF(out, mesh) ? 0 : 1;
}
