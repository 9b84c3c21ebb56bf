// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Composition: our policies together with CGAL's, on other meshes and kernels.

#include <selvedge/Surface_mesh_simplification/Aspect_ratio_filter.h>
#include <selvedge/Surface_mesh_simplification/Border_filter.h>
#include <selvedge/Surface_mesh_simplification/Halfedge_placement.h>
#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Normal_change_filter.h>
#include <selvedge/Surface_mesh_simplification/Quadric_cost.h>
#include <selvedge/Surface_mesh_simplification/simplify_mesh.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>
#include <selvedge/verify.h>

#include "support/Edge_ratio_stop.h"
#include "support/meshes.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace selvedge::test {
namespace {

namespace SMS = CGAL::Surface_mesh_simplification;
using Surface_mesh = CGAL::Surface_mesh<Point_3>;

template <class Mesh>
Mesh to_mesh(const Triangle_soup& soup)
{
  using Point = typename boost::property_traits<
      typename boost::property_map<Mesh, CGAL::vertex_point_t>::type>::value_type;
  std::vector<Point> points;
  for (const Point_3& p : soup.points)
    points.emplace_back(p.x(), p.y(), p.z());
  std::vector<std::vector<std::size_t>> polygons;
  for (const Index_triple& t : soup.triangles)
    polygons.push_back({t[0], t[1], t[2]});
  Mesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  return mesh;
}

template <class Mesh>
Triangle_soup to_soup(const Mesh& mesh)
{
  Triangle_soup soup;
  const auto points = get(CGAL::vertex_point, mesh);
  for (const auto face : faces(mesh)) {
    for (const auto v : CGAL::vertices_around_face(halfedge(face, mesh), mesh)) {
      const auto& p = get(points, v);
      soup.points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
    }
    const Index n = Index(soup.points.size());
    soup.triangles.push_back({n - 3, n - 2, n - 1});
  }
  return soup;
}

// Waves so close together that a filter which did nothing would not go unnoticed.
Triangle_soup waves()
{
  return sheets(2000, 4, 1e-5);
}

template <class Mesh, class Parameters>
std::size_t pairs_after(Mesh& mesh, const Parameters& parameters)
{
  const Edge_ratio_stop stop(0.6);
  EXPECT_GT(SMS::edge_collapse(mesh, stop, parameters), 0);
  return offending_pairs(to_soup(mesh)).size();
}

TEST(Composition, WithDefaultPoliciesOfCgal)
{
  Surface_mesh mesh = to_mesh<Surface_mesh>(waves());
  const Intersection_filter<Surface_mesh> filter(mesh);
  EXPECT_EQ(pairs_after(mesh, CGAL::parameters::filter(filter).visitor(filter.visitor())), 0u);
}

TEST(Composition, WithoutTheFilterTheSameSceneIsPierced)
{
  Surface_mesh mesh = to_mesh<Surface_mesh>(waves());
  EXPECT_GT(pairs_after(mesh, CGAL::parameters::default_values()), 0u);
}

TEST(Composition, WithLindstromTurk)
{
  Surface_mesh mesh = to_mesh<Surface_mesh>(waves());
  const Intersection_filter<Surface_mesh> filter(mesh);
  EXPECT_EQ(pairs_after(mesh, CGAL::parameters::get_cost(SMS::LindstromTurk_cost<Surface_mesh>())
                                  .get_placement(SMS::LindstromTurk_placement<Surface_mesh>())
                                  .filter(filter)
                                  .visitor(filter.visitor())),
            0u);
}

TEST(Composition, WithGarlandHeckbert)
{
  Surface_mesh mesh = to_mesh<Surface_mesh>(waves());
  const Intersection_filter<Surface_mesh> filter(mesh);
  const SMS::GarlandHeckbert_plane_policies<Surface_mesh, Kernel> policies(mesh);
  EXPECT_EQ(pairs_after(mesh, CGAL::parameters::get_cost(policies.get_cost())
                                  .get_placement(policies.get_placement())
                                  .filter(filter)
                                  .visitor(filter.visitor())),
            0u);
}

TEST(Composition, OnPolyhedron)
{
  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  Polyhedron mesh = to_mesh<Polyhedron>(waves());
  const Intersection_filter<Polyhedron> filter(mesh);
  EXPECT_EQ(pairs_after(mesh, CGAL::parameters::filter(filter).visitor(filter.visitor())), 0u);
}

TEST(Composition, WithAnExactKernel)
{
  using Exact_mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>;
  Exact_mesh mesh = to_mesh<Exact_mesh>(sheets(400, 2, 1e-5));
  const Intersection_filter<Exact_mesh> filter(mesh);
  EXPECT_EQ(pairs_after(mesh, CGAL::parameters::get_cost(SMS::Edge_length_cost<Exact_mesh>())
                                  .get_placement(SMS::Midpoint_placement<Exact_mesh>())
                                  .filter(filter)
                                  .visitor(filter.visitor())),
            0u);
}

// Both kernels decide exactly, so that nothing differs but the type of the points.
TEST(Composition, InAWholeReductionWithAnExactKernel)
{
  using Exact_mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>;
  for (const Collapse_loop loop : {Collapse_loop::own, Collapse_loop::cgal})
    for (const Face_index index : {Face_index::packed, Face_index::clusters}) {
      Simplify_options options;
      options.ratio = 0.3;
      options.loop = loop;
      options.index = index;
      Exact_mesh exact = to_mesh<Exact_mesh>(sheets(400, 2, 1e-5));
      Surface_mesh usual = to_mesh<Surface_mesh>(sheets(400, 2, 1e-5));
      EXPECT_GT(simplify_mesh(exact, options).collapses, 50u);
      simplify_mesh(usual, options);
      EXPECT_EQ(to_soup(exact).points, to_soup(usual).points);
      EXPECT_EQ(offending_pairs(to_soup(exact)).size(), 0u);
    }
}

TEST(Composition, OnTopOfAFilterOfCgal)
{
  using Base = SMS::Bounded_normal_change_filter<>;
  Surface_mesh mesh = to_mesh<Surface_mesh>(waves());
  const Intersection_filter<Surface_mesh, Base> filter(mesh, Base());
  EXPECT_EQ(pairs_after(mesh, CGAL::parameters::filter(filter).visitor(filter.visitor())), 0u);
}

TEST(Composition, OurCostAndPlacementWithStopsOfEitherSide)
{
  using Cost = Quadric_cost<Surface_mesh>;
  Surface_mesh mesh = to_mesh<Surface_mesh>(waves());
  const std::size_t faces = num_faces(mesh);
  const Cost cost(mesh);
  const Halfedge_placement<Surface_mesh, Cost> placement(cost);
  const Intersection_filter filter(mesh, Normal_change_filter(90, Aspect_ratio_filter(0.05)));
  const auto parameters =
      CGAL::parameters::get_cost(cost).get_placement(placement).filter(filter).visitor(filter.visitor());
  EXPECT_EQ(pairs_after(mesh, parameters), 0u);
  SMS::edge_collapse(mesh, Any_stop(Face_ratio_stop(0.8, mesh), Cost_stop(1e300)), parameters);
  EXPECT_LT(mesh.number_of_faces(), faces);
  EXPECT_TRUE(is_embedded(to_soup(mesh)));
}

// The largest distance of a point to the border of a mesh.
double distance_to_border(const std::vector<Point_3>& points, const Surface_mesh& mesh)
{
  double largest = 0;
  for (const Point_3& p : points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto h : halfedges(mesh))
      if (is_border(h, mesh)) {
        const Kernel::Segment_3 segment(mesh.point(source(h, mesh)), mesh.point(target(h, mesh)));
        nearest = (std::min)(nearest, CGAL::squared_distance(p, segment));
      }
    largest = (std::max)(largest, nearest);
  }
  return std::sqrt(largest);
}

TEST(Composition, BorderFilterKeepsBordersUnderCostsOfCgal)
{
  using Rule = Border_rule<Surface_mesh>;
  enum class Limit { none, of_all, of_each };
  for (const Limit limit : {Limit::of_all, Limit::of_each, Limit::none}) {
    Surface_mesh mesh = to_mesh<Surface_mesh>(sheets(1500, 1, 1e-3));
    std::vector<Point_3> border;
    for (const auto h : halfedges(mesh))
      if (is_border(h, mesh))
        border.push_back(mesh.point(target(h, mesh)));
    Border_rule_options options;
    if (limit == Limit::of_all)
      options.max_drift = 1e-4;
    Rule rule(mesh, options);
    if (limit == Limit::of_each)
      for (const auto v : vertices(mesh))
        rule.limit_drift(v, 1e-4);
    const Face_ratio_stop stop(0.6, mesh);
    const SMS::Midpoint_placement<Surface_mesh> placement;
    if (limit != Limit::none)
      SMS::edge_collapse(mesh, stop,
                         CGAL::parameters::get_placement(placement)
                             .filter(Border_filter<Rule>(rule))
                             .visitor(Border_visitor<Surface_mesh>(rule)));
    else
      SMS::edge_collapse(mesh, stop, CGAL::parameters::get_placement(placement));
    mesh.collect_garbage();
    EXPECT_LT(mesh.number_of_faces(), 1200u);
    EXPECT_EQ(distance_to_border(border, mesh) <= 1e-4 * (1 + 1e-9), limit != Limit::none);
  }
}

} // namespace
} // namespace selvedge::test
