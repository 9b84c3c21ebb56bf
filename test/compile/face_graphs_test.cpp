// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The filter on every kind of mesh that CGAL's loop takes, and with vertex point maps of other types, in both
// loops.

#include <selvedge/Surface_mesh_simplification/Border_filter.h>
#include <selvedge/Surface_mesh_simplification/Halfedge_placement.h>
#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Quadric_cost.h>
#include <selvedge/Surface_mesh_simplification/Visitor_chain.h>
#include <selvedge/Surface_mesh_simplification/edge_collapse.h>
#include <selvedge/Surface_mesh_simplification/simplify_mesh.h>
#include <selvedge/verify.h>

#include "support/Edge_ratio_stop.h"
#include "support/meshes.h"

#include <CGAL/Linear_cell_complex_for_bgl_combinatorial_map_helper.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_items_with_id_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/graph_traits_Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/boost/graph/helpers.h>
#ifdef SELVEDGE_TEST_OPENMESH
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <CGAL/boost/graph/graph_traits_PolyMesh_ArrayKernelT.h>
#endif

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <vector>

namespace selvedge::test {
namespace {

namespace SMS = CGAL::Surface_mesh_simplification;
using Surface_mesh = CGAL::Surface_mesh<Point_3>;

// Layers so close that a loop without the filter lets them pierce each other. Coordinates are floats.
Surface_mesh close_sheets()
{
  Triangle_soup soup = sheets(600, 3, 1e-4);
  std::vector<std::vector<std::size_t>> polygons;
  for (Point_3& p : soup.points)
    p = Point_3(float(p.x()), float(p.y()), float(p.z()));
  for (const Index_triple& t : soup.triangles)
    polygons.push_back({t[0], t[1], t[2]});
  Surface_mesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(soup.points, polygons, mesh);
  return mesh;
}

template <class Mesh>
Mesh close_sheets_as()
{
  Mesh mesh;
  CGAL::copy_face_graph(close_sheets(), mesh);
  return mesh;
}

template <class Mesh, class Point_map>
std::size_t offending_pairs_of(const Mesh& mesh, const Point_map& points)
{
  Triangle_soup soup;
  for (const auto face : faces(mesh)) {
    for (const auto v : CGAL::vertices_around_face(halfedge(face, mesh), mesh))
      soup.points.push_back(get(points, v));
    const Index n = Index(soup.points.size());
    soup.triangles.push_back({n - 3, n - 2, n - 1});
  }
  return offending_pairs(soup).size();
}

const Edge_ratio_stop stop(0.5);

// Runs one of both loops on a new mesh each time: with the filter no faces come to meet, and without it some
// do. The midpoints of floats are floats mostly, and doubles always.
template <class Mesh>
void expect_guarded()
{
  const auto pairs_after = [](const auto& run) {
    Mesh mesh = close_sheets_as<Mesh>();
    run(mesh);
    return offending_pairs_of(mesh, get(CGAL::vertex_point, mesh));
  };
  const auto policies = CGAL::parameters::get_cost(SMS::Edge_length_cost<Mesh>())
                            .get_placement(SMS::Midpoint_placement<Mesh>());
  EXPECT_GT(pairs_after([&](Mesh& mesh) { EXPECT_GT(SMS::edge_collapse(mesh, stop, policies), 0); }), 0u);
  EXPECT_EQ(pairs_after([&](Mesh& mesh) {
              const Intersection_filter<Mesh> filter(mesh);
              EXPECT_GT(SMS::edge_collapse(mesh, stop, policies.filter(filter).visitor(filter.visitor())), 0);
            }),
            0u);
  EXPECT_EQ(pairs_after([&](Mesh& mesh) {
              const Intersection_filter<Mesh> filter(mesh);
              EXPECT_GT(
                  selvedge::edge_collapse(mesh, stop, policies.filter(filter).visitor(filter.visitor())), 0);
            }),
            0u);
}

// The same with all policies of ours.
template <class Mesh>
void expect_guarded_with_our_policies()
{
  Mesh mesh = close_sheets_as<Mesh>();
  const Border_rule<Mesh> rule(mesh);
  using Cost = Quadric_cost<Mesh>;
  const Cost cost(mesh);
  const Halfedge_placement<Mesh, Cost, Border_rule<Mesh>> placement(cost, rule);
  const Intersection_filter filter(mesh, Border_filter(rule));
  const int edges = selvedge::edge_collapse(
      mesh, stop,
      CGAL::parameters::get_cost(cost).get_placement(placement).filter(filter).visitor(
          Visitor_chain(filter.visitor(), Border_visitor<Mesh>(rule))));
  EXPECT_GT(edges, 0);
  EXPECT_EQ(offending_pairs_of(mesh, get(CGAL::vertex_point, mesh)), 0u);
}

TEST(Face_graph, PolyhedronWithoutIds)
{
  expect_guarded<CGAL::Polyhedron_3<Kernel>>();
  expect_guarded_with_our_policies<CGAL::Polyhedron_3<Kernel>>();
}

TEST(Face_graph, PolyhedronWithIds)
{
  using Mesh = CGAL::Polyhedron_3<Kernel, CGAL::Polyhedron_items_with_id_3>;
  Mesh mesh = close_sheets_as<Mesh>();
  CGAL::set_halfedgeds_items_id(mesh);
  const Intersection_filter<Mesh> filter(mesh);
  EXPECT_GT(selvedge::edge_collapse(mesh, stop,
                                    CGAL::parameters::halfedge_index_map(get(CGAL::halfedge_index, mesh))
                                        .vertex_index_map(get(boost::vertex_index, mesh))
                                        .filter(filter)
                                        .visitor(filter.visitor())),
            0);
  EXPECT_EQ(offending_pairs_of(mesh, get(CGAL::vertex_point, mesh)), 0u);
}

TEST(Face_graph, LinearCellComplex)
{
  using Traits = CGAL::Linear_cell_complex_traits<3, Kernel>;
  using Mesh = CGAL::Linear_cell_complex_for_bgl_combinatorial_map_helper<2, 3, Traits>::type;
  expect_guarded<Mesh>();
  expect_guarded_with_our_policies<Mesh>();
}

#ifdef SELVEDGE_TEST_OPENMESH
using Open_mesh = OpenMesh::PolyMesh_ArrayKernelT<>; // of floats

TEST(Face_graph, OpenMeshWithPlacementsAtVertices)
{
  expect_guarded_with_our_policies<Open_mesh>();
}

TEST(Face_graph, OpenMeshCountsRemovedFaces)
{
  EXPECT_TRUE(internal::Counts_removed_faces<Open_mesh>::value);
  EXPECT_FALSE(internal::Counts_removed_faces<Surface_mesh>::value);
  EXPECT_FALSE(internal::Counts_removed_faces<CGAL::Polyhedron_3<Kernel>>::value);
}

TEST(Face_graph, OpenMeshThatRoundsIsRefused)
{
  Open_mesh mesh = close_sheets_as<Open_mesh>();
  const Intersection_filter<Open_mesh> filter(mesh);
  EXPECT_THROW(
      selvedge::edge_collapse(mesh, stop, CGAL::parameters::filter(filter).visitor(filter.visitor())),
      Argument_error);
}
#endif

// A map of another type than the mesh's own. The mesh itself has all its points at the origin.
template <class Mesh>
struct Map_of_points
{
  using key_type = typename boost::graph_traits<Mesh>::vertex_descriptor;
  using value_type = Point_3;
  using reference = value_type;
  using category = boost::read_write_property_map_tag;

  friend Point_3 get(const Map_of_points& map, const key_type& v) { return map.points->at(v); }
  friend void put(const Map_of_points& map, const key_type& v, const Point_3& p)
  {
    (*map.points)[v] = map.is_of_floats ? Point_3(float(p.x()), float(p.y()), float(p.z())) : p;
  }

  std::map<key_type, Point_3>* points;
  bool is_of_floats = false;
};

struct Scene_with_map
{
  Surface_mesh mesh = close_sheets();
  std::map<Surface_mesh::Vertex_index, Point_3> points;
  Map_of_points<Surface_mesh> map{&points};

  Scene_with_map()
  {
    for (const auto v : vertices(mesh)) {
      points[v] = mesh.point(v);
      mesh.point(v) = Point_3(0, 0, 0);
    }
  }
};

TEST(Vertex_point_map, OfAnotherTypeInBothLoops)
{
  for (const bool is_own : {true, false}) {
    Scene_with_map scene;
    const Intersection_filter filter(scene.mesh, No_filter(), Packed_R_tree(), scene.map);
    const auto parameters =
        CGAL::parameters::vertex_point_map(scene.map).filter(filter).visitor(filter.visitor());
    EXPECT_GT(is_own ? selvedge::edge_collapse(scene.mesh, stop, parameters)
                     : SMS::edge_collapse(scene.mesh, stop, parameters),
              0);
    EXPECT_EQ(offending_pairs_of(scene.mesh, scene.map), 0u);
  }
}

TEST(Vertex_point_map, OfAnotherTypeWithOurPolicies)
{
  Scene_with_map scene;
  using Rule = Border_rule<Surface_mesh, Map_of_points<Surface_mesh>>;
  const Rule rule(scene.mesh, scene.map);
  const Quadric_cost<Surface_mesh> cost(scene.mesh);
  const Halfedge_placement<Surface_mesh, Quadric_cost<Surface_mesh>, Rule> placement(cost, rule);
  const Intersection_filter filter(scene.mesh, Border_filter(rule), Packed_R_tree(), scene.map);
  EXPECT_GT(selvedge::edge_collapse(
                scene.mesh, stop,
                CGAL::parameters::vertex_point_map(scene.map)
                    .get_cost(cost)
                    .get_placement(placement)
                    .filter(filter)
                    .visitor(Visitor_chain(filter.visitor(), Border_visitor<Surface_mesh, Rule>(rule)))),
            0);
  EXPECT_EQ(offending_pairs_of(scene.mesh, scene.map), 0u);
}

TEST(Vertex_point_map, OfAnotherTypeInAWholeReduction)
{
  for (const Collapse_loop loop : {Collapse_loop::own, Collapse_loop::cgal})
    for (const Placement placement : {Placement::vertices, Placement::optimal}) {
      Simplify_options options;
      options.ratio = 0.1;
      options.max_error.reset();
      options.max_normal_change = 180;
      options.min_aspect_ratio = 0;
      options.loop = loop;
      options.placement = placement;
      const auto reduce = [&](Scene_with_map& scene) {
        return simplify_mesh(scene.mesh, options, CGAL::parameters::vertex_point_map(scene.map)).collapses;
      };
      Scene_with_map scene;
      EXPECT_GT(reduce(scene), 100u);
      EXPECT_EQ(offending_pairs_of(scene.mesh, scene.map), 0u);

      // Whatever the mesh's own points are, nothing reads or changes them.
      Scene_with_map other;
      const Surface_mesh before = close_sheets();
      for (const auto v : vertices(before))
        other.mesh.point(v) = before.point(v);
      reduce(other);
      EXPECT_EQ(other.points, scene.points);
      for (const auto v : vertices(before)) {
        ASSERT_EQ(scene.mesh.point(v), Point_3(0, 0, 0));
        ASSERT_EQ(other.mesh.point(v), before.point(v));
      }

      options.check_intersections = false; // the control
      Scene_with_map unchecked;
      reduce(unchecked);
      EXPECT_GT(offending_pairs_of(unchecked.mesh, unchecked.map), 0u);
    }
}

TEST(Vertex_point_map, ThatRoundsIsRefusedUnlessNothingIsRounded)
{
  for (const bool is_own : {true, false}) {
    Scene_with_map scene;
    scene.map.is_of_floats = true;
    const Intersection_filter filter(scene.mesh, No_filter(), Packed_R_tree(), scene.map);
    const auto parameters =
        CGAL::parameters::vertex_point_map(scene.map).filter(filter).visitor(filter.visitor());
    const auto run = [&](const auto& with) {
      return is_own ? selvedge::edge_collapse(scene.mesh, stop, with)
                    : SMS::edge_collapse(scene.mesh, stop, with);
    };
    EXPECT_THROW(run(parameters), Argument_error);
  }
  Scene_with_map scene;
  scene.map.is_of_floats = true;
  const Intersection_filter filter(scene.mesh, No_filter(), Packed_R_tree(), scene.map);
  const Quadric_cost<Surface_mesh> cost(scene.mesh);
  const Halfedge_placement<Surface_mesh, Quadric_cost<Surface_mesh>> placement(cost);
  const auto parameters =
      CGAL::parameters::vertex_point_map(scene.map).filter(filter).visitor(filter.visitor());
  EXPECT_GT(selvedge::edge_collapse(scene.mesh, stop, parameters.get_cost(cost).get_placement(placement)), 0);
  EXPECT_EQ(offending_pairs_of(scene.mesh, scene.map), 0u);
}

} // namespace
} // namespace selvedge::test
