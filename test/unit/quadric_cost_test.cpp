// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What a collapse costs.

#include "support/Edge_ratio_stop.h"
#include "support/mesh_of.h"
#include "support/meshes.h"
#include "support/soups.h"

#include <selvedge/Surface_mesh_simplification/Halfedge_placement.h>
#include <selvedge/Surface_mesh_simplification/Optimal_placement.h>
#include <selvedge/Surface_mesh_simplification/Quadric_cost.h>
#include <selvedge/Surface_mesh_simplification/edge_collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace selvedge::test {
namespace {

using Vertex = Mesh::Vertex_index;
using Edge_profile = internal::Lazy_edge_profile<Mesh, Mesh::Property_map<Vertex, Point_3>, Kernel>;

/// A flat sheet of 8 × 8 squares with a peak of height 1 in it, and the cost of its collapses.
struct Peak
{
  static constexpr Index peak = 4 * 9 + 4;

  explicit Peak(double size = 1) : mesh(made(size)), points(mesh.points()), cost(mesh)
  {
    cost.measure_by(10);
    cost.initialize(mesh, points, traits);
  }

  static Mesh made(double size)
  {
    Triangle_soup soup = sheet(8, 8);
    soup.points[peak] = soup.points[peak] + Kernel::Vector_3(0, 0, 1);
    for (Point_3& point : soup.points)
      point = Point_3(size * point.x(), size * point.y(), size * point.z());
    return mesh_of(soup);
  }

  auto profile(Index from, Index to) const
  {
    const auto moving = mesh.halfedge(Vertex(from), Vertex(to));
    return Edge_profile(moving, mesh, points, traits);
  }

  double cost_of(Index from, Index to) const
  {
    const auto edge = profile(from, to);
    return *cost.cost_along(edge, mesh.halfedge(Vertex(from), Vertex(to)));
  }

  mutable Mesh mesh;
  Mesh::Property_map<Vertex, Point_3> points; // a profile refers to it
  Kernel traits;
  Quadric_cost<Mesh> cost;
};

TEST(QuadricCost, IsWhatTheCollapseAdds)
{
  const Peak scene;
  const Index beside = Peak::peak + 1, flat = Peak::peak + 2, farther = Peak::peak + 3;
  const double of_peak = scene.cost_of(Peak::peak, beside), of_flat = scene.cost_of(farther, flat);
  EXPECT_LT(of_flat, 1e-3 * of_peak);
  // Once the peak is gone, what was lost with it does not burden a neighbour that merges next.
  scene.cost.update_after_collapse(scene.profile(Peak::peak, beside), Vertex(beside));
  const auto edge = scene.profile(flat, beside);
  EXPECT_NEAR(scene.cost_of(flat, beside), scene.cost.cost_at(edge, scene.mesh.point(Vertex(beside))),
              1e-9 * of_peak);
  const Peak before;
  EXPECT_NEAR(scene.cost_of(flat, beside), before.cost_of(flat, beside), 1e-9 * of_peak);
}

Quadric_cost_options with_memory(double share)
{
  Quadric_cost_options options;
  options.memory = share;
  return options;
}

/// A sphere reduced to half its edges, with the cost that was updated after each collapse.
struct Reduced_sphere
{
  explicit Reduced_sphere(double memory)
      : mesh(mesh_of(nested_spheres(1000, 1, 1e-3))), cost(mesh, with_memory(memory))
  {
    cost.measure_by(1);
    const Optimal_placement<Mesh, Quadric_cost<Mesh>> placement(cost);
    const std::size_t edges = mesh.number_of_edges();
    EXPECT_GE(selvedge::edge_collapse(mesh, Edge_ratio_stop(0.5),
                                      CGAL::parameters::get_cost(cost).get_placement(placement)),
              int(edges / 2));
  }

  /// Calls `compare(cost, other cost)` for both directions of every edge.
  template <class Compare>
  void compare_with(const Quadric_cost<Mesh>& other, const Compare& compare) const
  {
    const Kernel traits;
    const auto points = get(CGAL::vertex_point, mesh);
    other.initialize(mesh, points, traits);
    for (const auto h : mesh.halfedges()) {
      const Edge_profile edge(h, mesh, points, traits);
      compare(*cost.cost_along(edge, h), *other.cost_along(edge, h));
    }
  }

  mutable Mesh mesh;
  Quadric_cost<Mesh> cost;
};

TEST(QuadricCost, WithoutMemoryIsThatOfTheMeshAsItIs)
{
  const auto compare = [](double memory, const auto& function) {
    const Reduced_sphere scene(memory);
    Quadric_cost<Mesh> anew(scene.mesh, with_memory(memory));
    anew.measure_by(1);
    scene.compare_with(anew, function);
  };
  std::size_t edges = 0;
  compare(0, [&](double updated, double anew) {
    EXPECT_NEAR(updated, anew, 1e-9 * anew);
    ++edges;
  });
  EXPECT_GT(edges, 1000u);
  std::size_t more = 0, of = 0;
  compare(0.5, [&](double updated, double anew) {
    more += updated > 1.01 * anew;
    ++of;
  });
  EXPECT_GT(more, of / 2) << "what has accumulated counts";
}

TEST(QuadricCost, RecomputedOnceIsWhatUpdatesAfterEachCollapseMakeIt)
{
  for (const double memory : {0., 0.5, 1.}) {
    const Kernel traits;
    Mesh mesh = mesh_of(sheet(8, 8));
    const auto points = get(CGAL::vertex_point, mesh);
    const Quadric_cost<Mesh> updated(mesh, with_memory(memory)), recomputed(mesh, with_memory(memory));
    for (const auto& cost : {updated, recomputed})
      cost.initialize(mesh, points, traits);
    const auto profile = [&](Mesh::Halfedge_index h) { return Edge_profile(h, mesh, points, traits); };
    int collapses = 0;
    for (const auto e : mesh.edges()) {
      if (mesh.is_removed(e) || !CGAL::Euler::does_satisfy_link_condition(e, mesh))
        continue;
      const auto edge = profile(mesh.halfedge(e));
      const auto kept = CGAL::Euler::collapse_edge(e, mesh);
      updated.update_after_collapse(edge, kept);
      recomputed.accumulate(edge, kept);
      if (++collapses == 20)
        break;
    }
    EXPECT_EQ(collapses, 20);
    const auto differing = [&] {
      std::size_t count = 0;
      for (const auto h : mesh.halfedges())
        count += *updated.cost_along(profile(h), h) != *recomputed.cost_along(profile(h), h);
      return count;
    };
    EXPECT_GT(differing(), 0u) << "not recomputed yet";
    recomputed.recompute(mesh, points);
    EXPECT_EQ(differing(), 0u);
  }
}

// Where one end has moved onto the other, only what was around the first is computed again.
TEST(QuadricCost, UpdatedWhereOneEndWasIsWhatAnUpdateAllAroundMakesIt)
{
  using internal::Merged_at;
  for (const Merged_at at : {Merged_at::v0, Merged_at::v1, Merged_at::between}) {
    const Kernel traits;
    Mesh mesh = Peak::made(1);
    const auto points = get(CGAL::vertex_point, mesh);
    const Quadric_cost<Mesh> in_part(mesh, with_memory(0.5)), all_around(mesh, with_memory(0.5)),
        before(mesh, with_memory(0.5));
    for (const auto& cost : {in_part, all_around, before})
      cost.initialize(mesh, points, traits);
    const auto profile = [&](Mesh::Halfedge_index h) { return Edge_profile(h, mesh, points, traits); };
    const auto differing = [&](const Quadric_cost<Mesh>& a, const Quadric_cost<Mesh>& b) {
      return std::count_if(mesh.halfedges().begin(), mesh.halfedges().end(), [&](const auto h) {
        const double cost = *a.cost_along(profile(h), h);
        return std::abs(cost - *b.cost_along(profile(h), h)) > 1e-6 * cost;
      });
    };
    int collapses = 0;
    for (const auto e : mesh.edges()) {
      if (mesh.is_removed(e) || mesh.is_border(e) || !CGAL::Euler::does_satisfy_link_condition(e, mesh))
        continue;
      const auto edge = profile(mesh.halfedge(e));
      EXPECT_NE(edge.vL(), edge.vR()); // asked for before the collapse
      const auto kept = CGAL::Euler::collapse_edge(e, mesh);
      put(points, kept,
          at == Merged_at::v0   ? edge.p0()
          : at == Merged_at::v1 ? edge.p1()
                                : CGAL::midpoint(edge.p0(), edge.p1()));
      in_part.update_after_collapse(edge, kept, at);
      all_around.update_after_collapse(edge, kept);
      EXPECT_EQ(differing(in_part, all_around), 0) << collapses;
      if (++collapses == 40)
        break;
    }
    EXPECT_EQ(collapses, 40);
    EXPECT_GT(differing(in_part, before), 0);
  }
}

// What is kept in single precision is relative to the vertices, wherever they are.
TEST(QuadricCost, IsTheSameForASmallThingInALargeScene)
{
  const Triangle_soup layer = nested_spheres(400, 1, 1e-3);
  const Triangle_soup sphere = in_steps(soup(layer.points, layer.triangles), 1048576);
  const double away = 300'001.375; // the sum of it and a coordinate is exact
  const Triangle_soup scene = joined(moved(sphere, away, away, away), sheet(1, 1));

  const Kernel traits;
  Mesh alone = mesh_of(sphere), in_scene = mesh_of(scene);
  const auto points_alone = get(CGAL::vertex_point, alone),
             points_in_scene = get(CGAL::vertex_point, in_scene);
  const Quadric_cost<Mesh> of_alone(alone, with_memory(0.5)), of_scene(in_scene, with_memory(0.5));
  for (Quadric_cost<Mesh> cost : {of_alone, of_scene})
    cost.measure_by(1);
  of_alone.initialize(alone, points_alone, traits);
  of_scene.initialize(in_scene, points_in_scene, traits);
  int collapses = 0;
  for (const auto e : alone.edges()) {
    if (alone.is_removed(e) || !CGAL::Euler::does_satisfy_link_condition(e, alone))
      continue;
    const auto h = alone.halfedge(e);
    const Edge_profile edge(h, alone, points_alone, traits), same(h, in_scene, points_in_scene, traits);
    const double cost = *of_alone.cost_along(edge, h), error = of_alone.error_at(edge, edge.p1());
    EXPECT_NEAR(*of_scene.cost_along(same, h), cost, 1e-4 * cost) << collapses;
    EXPECT_NEAR(of_scene.error_at(same, same.p1()), error, 1e-4 * error) << collapses;
    of_alone.update_after_collapse(edge, CGAL::Euler::collapse_edge(e, alone));
    of_scene.update_after_collapse(same, CGAL::Euler::collapse_edge(e, in_scene));
    if (++collapses == 100)
      break;
  }
  EXPECT_EQ(collapses, 100);
}

TEST(QuadricCost, IsTheSameWhereAxesHaveChangedPlaces)
{
  const auto costs = [](const Triangle_soup& soup) {
    Mesh mesh = mesh_of(soup);
    const auto points = mesh.points();
    const Kernel traits;
    Quadric_cost<Mesh> cost(mesh);
    cost.measure_by(10);
    cost.initialize(mesh, points, traits);
    std::vector<double> result;
    for (const auto moving : mesh.halfedges())
      result.push_back(*cost.cost_along(Edge_profile(moving, mesh, points, traits), moving));
    return result;
  };
  const Triangle_soup ball = nested_spheres(700, 1, 0.01);
  const std::vector<double> of_ball = costs(ball), of_turned = costs(mapped(ball, [](const Point_3&p) {
                                                     return Point_3(p.y(), p.z(), p.x());
                                                   }));
  ASSERT_GT(of_ball.size(), 1000u);
  for (std::size_t i = 0; i < of_ball.size(); ++i)
    EXPECT_NEAR(of_turned[i], of_ball[i], 1e-4 * of_ball[i]);
}

TEST(QuadricCost, IsMultipliedByTheWeightOfAllVertices)
{
  const Kernel traits;
  Mesh mesh = mesh_of(nested_spheres(100, 1, 1e-3));
  const auto points = get(CGAL::vertex_point, mesh);
  const Quadric_cost<Mesh> plain(mesh);
  Quadric_cost<Mesh> weighed(mesh);
  weighed.weigh(mesh, std::vector<double>(mesh.number_of_vertices(), 0.01));
  for (const auto& cost : {plain, weighed})
    cost.initialize(mesh, points, traits);
  for (const auto h : mesh.halfedges()) {
    const Edge_profile edge(h, mesh, points, traits);
    const double along = 0.01 * *plain.cost_along(edge, h), least = 0.01 * plain.least_cost(edge);
    EXPECT_NEAR(*weighed.cost_along(edge, h), along, 1e-5 * along) << h;
    EXPECT_NEAR(weighed.least_cost(edge), least, 1e-3 * least) << h;
    EXPECT_GT(least, 0) << h;
  }
}

TEST(QuadricCost, IsFiniteForTheLargestWeights)
{
  Mesh mesh = Peak::made(1);
  Quadric_cost<Mesh> cost(mesh, with_memory(0.5));
  cost.weigh(mesh, std::vector<double>(mesh.number_of_vertices(), 1e300));
  const Kernel traits;
  const auto points = get(CGAL::vertex_point, mesh);
  cost.initialize(mesh, points, traits);
  const auto profile = [&](Mesh::Halfedge_index h) { return Edge_profile(h, mesh, points, traits); };
  const auto edge = profile(mesh.halfedge(Vertex(Peak::peak), Vertex(Peak::peak + 1)));
  cost.update_after_collapse(edge, CGAL::Euler::collapse_edge(mesh.edge(edge.v0_v1()), mesh));
  double highest = 0;
  for (const auto h : mesh.halfedges()) {
    const double along = *cost.cost_along(profile(h), h);
    EXPECT_TRUE(std::isfinite(along)) << h;
    highest = std::max(highest, along);
  }
  EXPECT_GT(highest, 1e290);
}

double volume(const Mesh& mesh)
{
  double sum = 0;
  for (const auto face : mesh.faces()) {
    const auto h = mesh.halfedge(face);
    sum += CGAL::volume(Point_3(0, 0, 0), mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                        mesh.point(mesh.target(mesh.next(h))));
  }
  return sum;
}

// Returns by which share a collapse changes the volume at most, of all that are possible.
double largest_change_of_volume(Mesh& mesh, const Quadric_cost<Mesh>& cost)
{
  const Kernel traits;
  const auto points = get(CGAL::vertex_point, mesh);
  cost.initialize(mesh, points, traits);
  double largest = 0;
  for (const auto e : mesh.edges()) {
    const Edge_profile edge(mesh.halfedge(e), mesh, points, traits);
    const auto place = cost.least_place(edge, 1);
    EXPECT_TRUE(place);
    if (!place || !CGAL::Euler::does_satisfy_link_condition(e, mesh))
      continue;
    Mesh merged = mesh;
    const auto kept = CGAL::Euler::collapse_edge(e, merged);
    merged.point(kept) = Point_3((*place)[0], (*place)[1], (*place)[2]);
    largest = std::max(largest, std::fabs(volume(merged) / volume(mesh) - 1));
  }
  return largest;
}

TEST(QuadricCost, PlacesKeepTheVolume)
{
  const auto largest_change = [](double memory) {
    Mesh mesh = mesh_of(nested_spheres(300, 1, 1e-3));
    return largest_change_of_volume(mesh, Quadric_cost<Mesh>(mesh, with_memory(memory)));
  };
  EXPECT_LT(largest_change(0.03), 1e-12);
  EXPECT_GT(largest_change(1), 1e-6) << "which knows nothing of volumes";
}

TEST(QuadricCost, PlacesKeepTheVolumeOfWhatCollapsesHaveLeft)
{
  const Reduced_sphere scene(0.03);
  EXPECT_LT(largest_change_of_volume(scene.mesh, scene.cost), 1e-12);

  Mesh mesh = mesh_of(nested_spheres(300, 1, 1e-3));
  const Quadric_cost<Mesh> cost(mesh, with_memory(0.03));
  largest_change_of_volume(mesh, cost);
  const Kernel traits;
  const auto points = get(CGAL::vertex_point, mesh);
  for (const auto e : mesh.edges()) {
    if (mesh.is_removed(e) || !CGAL::Euler::does_satisfy_link_condition(e, mesh))
      continue;
    const Edge_profile edge(mesh.halfedge(e), mesh, points, traits);
    cost.accumulate(edge, CGAL::Euler::collapse_edge(e, mesh));
    if (mesh.number_of_vertices() <= 100)
      break;
  }
  EXPECT_EQ(mesh.number_of_vertices(), 100u);
  cost.recompute(mesh, points);
  EXPECT_LT(largest_change_of_volume(mesh, cost), 1e-12);
}

TEST(QuadricCost, NoPlaceCostsLessThanTheLeastCost)
{
  for (const double memory : {0., 0.03, 1.}) {
    const Reduced_sphere scene(memory);
    const Kernel traits;
    const auto points = get(CGAL::vertex_point, scene.mesh);
    std::size_t edges = 0, half_as_much = 0;
    for (const auto e : scene.mesh.edges()) {
      const Edge_profile edge(scene.mesh.halfedge(e), scene.mesh, points, traits);
      const double least = scene.cost.least_cost(edge);
      const auto place = scene.cost.least_place(edge, 1);
      ASSERT_TRUE(place);
      const double at_place = scene.cost.cost_at(edge, Point_3((*place)[0], (*place)[1], (*place)[2]));
      EXPECT_LE(least, (1 + 1e-9) * at_place + 1e-18) << memory << ' ' << e;
      ++edges;
      half_as_much += 2 * least > at_place;
    }
    EXPECT_GT(half_as_much, edges / 10) << memory;
  }
}

TEST(QuadricCost, GivesSmallFacesMoreThanTheirShareOfTheArea)
{
  // In units of the same diagonal. Costs by area would be as the fourth powers of the sizes, and costs by
  // number of vertices as the squares.
  const double coarse = Peak(1).cost_of(Peak::peak, Peak::peak + 1);
  const double fine = Peak(0.01).cost_of(Peak::peak, Peak::peak + 1);
  EXPECT_GT(fine, 1e-6 * coarse);
  EXPECT_LT(fine, 1e-4 * coarse);
}

/// A round sheet of `rings` rings of 48 faces on each side: two layers, joined at the rim without thickness,
/// that rise from there to this height above and below their middle. Its first 48 vertices are the rim.
Triangle_soup round_sheet_folded_at_its_rim(Index rings, double height)
{
  constexpr Index sectors = 48;
  Triangle_soup result;
  const auto add_ring = [&](double radius, double z) {
    for (Index i = 0; i < sectors; ++i) {
      const double angle = 2 * CGAL_PI * double(i) / sectors;
      result.points.push_back(Point_3(radius * std::cos(angle), radius * std::sin(angle), z));
    }
    return Index(result.points.size() - sectors);
  };
  add_ring(1, 0);
  for (const double side : {1, -1}) {
    const auto add = [&](Index a, Index b, Index c) {
      result.triangles.push_back(side > 0 ? Index_triple{a, b, c} : Index_triple{b, a, c});
    };
    Index outer = 0;
    for (Index ring = 1; ring < rings; ++ring) {
      const double share = double(ring) / double(rings);
      const Index inner = add_ring(1 - share, side * height * share);
      for (Index i = 0; i < sectors; ++i) {
        const Index next = (i + 1) % sectors;
        add(outer + i, outer + next, inner + next);
        add(outer + i, inner + next, inner + i);
      }
      outer = inner;
    }
    result.points.push_back(Point_3(0, 0, side * height));
    for (Index i = 0; i < sectors; ++i)
      add(outer + i, outer + (i + 1) % sectors, Index(result.points.size() - 1));
  }
  return result;
}

double cost_at_rim(const Triangle_soup& soup)
{
  Mesh mesh = mesh_of(soup);
  const Kernel traits;
  const auto points = get(CGAL::vertex_point, mesh);
  const Quadric_cost<Mesh> cost(mesh);
  cost.initialize(mesh, points, traits);
  const auto moving = mesh.halfedge(Vertex(0), Vertex(1));
  return *cost.cost_along(Edge_profile(moving, mesh, points, traits), moving);
}

TEST(QuadricCost, HoldsAFoldAsItHoldsABorder)
{
  Triangle_soup folded = round_sheet_folded_at_its_rim(1, 1e-3), cut = folded;
  cut.points.pop_back(); // the middle of the lower layer, whose faces are the second half
  cut.triangles.resize(cut.triangles.size() / 2);
  const double of_fold = cost_at_rim(folded), of_border = cost_at_rim(cut);
  EXPECT_GT(of_fold, 0.9 * of_border);
  EXPECT_LT(of_fold, 1.1 * of_border);
}

TEST(QuadricCost, KeepsTheOutlineOfAFoldedSheet)
{
  Mesh mesh = mesh_of(round_sheet_folded_at_its_rim(12, 0.02));
  const auto area_from_above = [&] {
    double sum = 0;
    for (const auto face : mesh.faces()) {
      const auto h = mesh.halfedge(face);
      const Point_3 &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h)),
                    &c = mesh.point(mesh.target(mesh.next(h)));
      sum += 0.5 * (std::max)(0.0, CGAL::cross_product(b - a, c - a).z());
    }
    return sum;
  };
  const double before = area_from_above();
  const Quadric_cost<Mesh> cost(mesh);
  const Halfedge_placement<Mesh, Quadric_cost<Mesh>> placement(cost);
  selvedge::edge_collapse(mesh, Edge_ratio_stop(0.1),
                          CGAL::parameters::get_cost(cost).get_placement(placement));
  EXPECT_GT(area_from_above(), 0.999 * before);
}

} // namespace
} // namespace selvedge::test
