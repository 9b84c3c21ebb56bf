// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Policies around ours, or derived from them, as CGAL's users write them: what they say is heard.

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/Error_filter.h>
#include <selvedge/Surface_mesh_simplification/Halfedge_placement.h>
#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Normal_change_filter.h>
#include <selvedge/Surface_mesh_simplification/Optimal_placement.h>
#include <selvedge/Surface_mesh_simplification/Quadric_cost.h>
#include <selvedge/Surface_mesh_simplification/edge_collapse.h>

#include "support/Edge_ratio_stop.h"
#include "support/mesh_of.h"
#include "support/meshes.h"
#include "support/soups.h"

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <set>

namespace selvedge::test::derived_policies {
namespace {

namespace SMS = CGAL::Surface_mesh_simplification;
namespace parameters = CGAL::parameters;

using Cost = Quadric_cost<Mesh>;
using Ends = Halfedge_placement<Mesh, Cost>;
using Filter = Intersection_filter<Mesh>;

template <class Parameters>
int collapse(bool is_own, Mesh& mesh, double ratio, const Parameters& parameters)
{
  const Edge_ratio_stop stop(ratio);
  return is_own ? selvedge::edge_collapse(mesh, stop, parameters)
                : SMS::edge_collapse(mesh, stop, parameters);
}

Mesh hills()
{
  return mesh_of(mapped(sheet(20, 20), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), std::sin(p.x() / 3) + std::cos(p.y() / 2));
  }));
}

// The edges on a line across the mesh.
struct On_line
{
  using key_type = Mesh::Edge_index;
  using value_type = bool;
  using reference = bool;
  using category = boost::readable_property_map_tag;

  Mesh::Property_map<Mesh::Edge_index, bool> map;

  friend bool get(const On_line& line, Mesh::Edge_index e) { return get(line.map, e); }
};

std::set<Point_3> points_on(const Mesh& mesh, const On_line& line)
{
  std::set<Point_3> points;
  for (const auto e : mesh.edges())
    if (get(line, e))
      points.insert({mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))});
  return points;
}

template <class Placement>
void expect_line_kept(bool is_own)
{
  Mesh mesh = hills();
  const On_line line{mesh.add_property_map<Mesh::Edge_index, bool>("e:on_line", false).first};
  for (const auto e : mesh.edges())
    if (mesh.point(mesh.vertex(e, 0)).y() == 10 && mesh.point(mesh.vertex(e, 1)).y() == 10)
      put(line.map, e, true);
  const std::set<Point_3> before = points_on(mesh, line);
  ASSERT_EQ(before.size(), 21u);
  const Cost cost(mesh);
  const Filter filter(mesh);
  EXPECT_GT(collapse(is_own, mesh, 0.3,
                     parameters::get_cost(cost)
                         .get_placement(SMS::Constrained_placement<Placement, On_line>(line, Placement(cost)))
                         .edge_is_constrained_map(line)
                         .filter(filter)
                         .visitor(filter.visitor())),
            400);
  EXPECT_EQ(points_on(mesh, line), before);
}

TEST(Derived_policies, ConstrainedPlacementAroundOurs)
{
  for (const bool is_own : {false, true}) {
    expect_line_kept<Ends>(is_own);
    expect_line_kept<Optimal_placement<Mesh, Cost>>(is_own);
  }
}

// Refuses all collapses in the right half.
struct Left_half : Normal_change_filter<>
{
  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    if (profile.p0().x() >= 10 || profile.p1().x() >= 10)
      return {};
    return Normal_change_filter<>::operator()(profile, placement);
  }
};

std::size_t vertices_on_the_right(const Mesh& mesh)
{
  std::size_t count = 0;
  for (const auto v : mesh.vertices())
    count += mesh.point(v).x() > 10.5;
  return count;
}

TEST(Derived_policies, FilterDerivedFromOurs)
{
  for (const bool is_own : {false, true}) {
    Mesh mesh = hills();
    const std::size_t before = vertices_on_the_right(mesh);
    EXPECT_GT(collapse(is_own, mesh, 0.3, parameters::filter(Left_half())), 100);
    EXPECT_EQ(vertices_on_the_right(mesh), before);

    Mesh guarded = hills();
    const Intersection_filter<Mesh, Left_half> filter(guarded, Left_half());
    EXPECT_GT(collapse(is_own, guarded, 0.3, parameters::filter(filter).visitor(filter.visitor())), 100);
    EXPECT_EQ(vertices_on_the_right(guarded), before);
  }
}

TEST(Derived_policies, FilterUponIntersectionFilterKeepsItsBlockers)
{
  const auto faces_left = [](const auto& run) {
    Mesh mesh = mesh_of(sheets(1500, 3, 1e-2));
    run(mesh);
    return mesh.number_of_faces();
  };
  const std::size_t alone = faces_left([](Mesh& mesh) {
    const Filter filter(mesh);
    collapse(true, mesh, 0.05, parameters::filter(filter).visitor(filter.visitor()));
  });
  const std::size_t stacked = faces_left([](Mesh& mesh) {
    const Filter filter(mesh);
    const Normal_change_filter<Filter> top(180, filter);
    collapse(true, mesh, 0.05, parameters::filter(top).visitor(filter.visitor()));
  });
  EXPECT_LE(stacked, alone + 10);
}

TEST(Derived_policies, CostThatTheLoopDoesNotHaveIsRefused)
{
  for (const bool is_own : {false, true}) {
    Mesh mesh = hills();
    const Cost cost(mesh), other(mesh);
    EXPECT_THROW(collapse(is_own, mesh, 0.3, parameters::filter(Error_filter<Cost>(1e-9, cost))),
                 Argument_error);
    EXPECT_THROW(collapse(is_own, mesh, 0.3, parameters::get_cost(cost).get_placement(Ends(other))),
                 Argument_error);
    EXPECT_THROW(collapse(is_own, mesh, 0.3,
                          parameters::get_cost(cost).get_placement(Optimal_placement<Mesh, Cost>(other))),
                 Argument_error);
    EXPECT_EQ(mesh.number_of_faces(), 800u);
    EXPECT_GT(collapse(is_own, mesh, 0.3, parameters::get_cost(other).get_placement(Ends(other))), 100);
  }
}

} // namespace
} // namespace selvedge::test::derived_policies
