// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Surface_mesh_simplification/simplify_mesh.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

int main()
{
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  using Mesh = CGAL::Surface_mesh<Point>;
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Point(0, 0, 0), 1.0);
  selvedge::Simplify_options options;
  options.faces = 12;
  options.max_normal_change = 180;
  options.min_aspect_ratio = 0;
  return selvedge::simplify_mesh(mesh, options).is_reached() ? 0 : 1;
}
