// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What a collapse costs.

#include "support/mesh_of.h"
#include "support/soups.h"

#include <selvedge/Surface_mesh_simplification/Quadric_cost.h>
#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>

#include <gtest/gtest.h>

namespace selvedge::test {
namespace {

using Vertex = Mesh::Vertex_index;

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
    return internal::Lazy_edge_profile<Mesh, Mesh::Property_map<Vertex, Point_3>, Kernel>(moving, mesh,
                                                                                          points, traits);
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

TEST(QuadricCost, GivesSmallFacesMoreThanTheirShareOfTheArea)
{
  // In units of the same diagonal. Costs by area would be as the fourth powers of the sizes, and costs by
  // number of vertices as the squares.
  const double coarse = Peak(1).cost_of(Peak::peak, Peak::peak + 1);
  const double fine = Peak(0.01).cost_of(Peak::peak, Peak::peak + 1);
  EXPECT_GT(fine, 1e-6 * coarse);
  EXPECT_LT(fine, 1e-4 * coarse);
}

} // namespace
} // namespace selvedge::test
