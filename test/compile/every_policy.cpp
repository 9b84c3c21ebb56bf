// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Instantiates every policy, so that compilers see the bodies of all templates and not only their
// declarations. Compiled, never run.

#include "all_headers.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <type_traits>

namespace selvedge {

using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

template <class Index>
void use_policies(Mesh& mesh)
{
  const Quadric_cost<Mesh> cost(mesh);
  const Border_rule<Mesh> rule(mesh);
  const Halfedge_placement<Mesh, Quadric_cost<Mesh>, Border_rule<Mesh>> placement(cost, rule);
  const Error_filter error(1.0, cost, Border_filter(rule));
  const Dihedral_angle_filter base(Normal_change_filter(45, Aspect_ratio_filter(0.1, error)));
  const Intersection_filter<Mesh, std::decay_t<decltype(base)>, Index> filter(mesh, base);
  intersection_filter(mesh, parameters::face_index<Index>().filter(base));
  const Any_stop stop(Face_ratio_stop(0.5, mesh), Face_count_stop(1), Cost_stop(1), Hook_stop({}));
  const auto parameters =
      CGAL::parameters::get_cost(cost).get_placement(placement).filter(filter).visitor(filter.visitor());
  selvedge::edge_collapse(mesh, stop, parameters);
  CGAL::Surface_mesh_simplification::edge_collapse(mesh, stop, parameters);
  const Filtered_halfedge_placement filtered(mesh, placement, filter);
  selvedge::edge_collapse(mesh, stop, CGAL::parameters::get_placement(filtered).visitor(filtered.visitor()));
  selvedge::edge_collapse(mesh, stop, CGAL::parameters::visitor(Border_visitor<Mesh>(rule)));
}

void use_all(Mesh& mesh)
{
  simplify_mesh(mesh, Simplify_options());
  use_policies<Packed_R_tree>(mesh);
  use_policies<Clustered_AABB_tree>(mesh);
  use_policies<Brute_force_index>(mesh);
}

} // namespace selvedge
