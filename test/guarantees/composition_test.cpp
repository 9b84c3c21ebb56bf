// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G10: the filter guards placements that are no vertices, after every collapse; filters work alone and
// stacked.

#include "support/mesh_of.h"
#include "support/meshes.h"
#include "support/reduction.h"

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/Aspect_ratio_filter.h>
#include <selvedge/Surface_mesh_simplification/Halfedge_placement.h>
#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Normal_change_filter.h>
#include <selvedge/Surface_mesh_simplification/Quadric_cost.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <gtest/gtest.h>

namespace selvedge::test {
namespace {

namespace SMS = CGAL::Surface_mesh_simplification;

Mesh close_layers()
{
  return mesh_of(sheets(1600, 4, 1e-3));
}

// Judges the mesh at every collapse.
template <class Visitor>
class Judging_visitor : public Visitor
{
public:
  Judging_visitor(const Visitor& visitor, const Mesh& mesh, std::size_t& collapses, std::size_t& violations)
      : Visitor(visitor), m_mesh(&mesh), m_collapses(&collapses), m_violations(&violations)
  {
  }

  template <class Profile, class Vertex>
  void OnCollapsed(const Profile& profile, const Vertex& kept)
  {
    Visitor::OnCollapsed(profile, kept);
    ++*m_collapses;
    *m_violations += !is_embedded(soup_of(*m_mesh));
  }

private:
  const Mesh* m_mesh;
  std::size_t* m_collapses;
  std::size_t* m_violations;
};

// With any placement, points of doubles that are no vertices among them: two motions, judged one after the
// other.
template <class Cost, class Placement>
void expect_guarded(const Cost& cost, const Placement& placement)
{
  Mesh mesh = close_layers();
  const Face_ratio_stop stop(0.2, mesh);
  const Intersection_filter<Mesh> filter(mesh);
  std::size_t collapses = 0, violations = 0;
  SMS::edge_collapse(mesh, stop,
                     CGAL::parameters::get_cost(cost).get_placement(placement).filter(filter).visitor(
                         Judging_visitor(filter.visitor(), mesh, collapses, violations)));
  EXPECT_GT(collapses, 50u);
  EXPECT_GT(filter.refusals(), 0u);
  EXPECT_EQ(violations, 0u);
}

TEST(Composition, GuardsTheLindstromTurkPolicies)
{
  expect_guarded(SMS::LindstromTurk_cost<Mesh>(), SMS::LindstromTurk_placement<Mesh>());
}

TEST(Composition, TheSameLayersPierceEachOtherUnguarded)
{
  Mesh mesh = close_layers();
  SMS::edge_collapse(mesh, Face_ratio_stop(0.2, mesh)); // Lindstrom and Turk's policies are the default
  EXPECT_FALSE(is_embedded(soup_of(mesh)));
}

TEST(Composition, GuardsMidpoints)
{
  expect_guarded(SMS::Edge_length_cost<Mesh>(), SMS::Midpoint_placement<Mesh>());
}

TEST(Composition, AGuardIsNotTooStrictWhereNothingIsNear)
{
  Mesh mesh = mesh_of(nested_spheres(2000, 1, 1e-2));
  const Intersection_filter<Mesh> filter(mesh);
  SMS::edge_collapse(mesh, Face_ratio_stop(0.1, mesh),
                     CGAL::parameters::filter(filter).visitor(filter.visitor()));
  EXPECT_LE(mesh.number_of_faces(), 200u);
  EXPECT_LE(filter.refusals(), 20u);
}

// A run that stops after a selection must not leave the placement deciding when the next one computes its
// first costs.
TEST(Composition, ComputingCostsAsksNoFilter)
{
  struct Counting_filter
  {
    std::size_t* questions;
    internal::Optional<Point_3>
    operator()(const SMS::Edge_profile<Mesh, Mesh::Property_map<Mesh::Vertex_index, Point_3>, Kernel>&,
               const internal::Optional<Point_3>& point) const
    {
      ++*questions;
      return point;
    }
  };
  Mesh mesh = mesh_of(nested_spheres(300, 1, 1e-2));
  std::size_t questions = 0;
  const Quadric_cost<Mesh> cost(mesh);
  const Halfedge_placement<Mesh, Quadric_cost<Mesh>> directions(cost);
  const Filtered_halfedge_placement placement(mesh, directions, Counting_filter{&questions});
  for (int run = 0; run < 3; ++run) // each stops at its first selection
    SMS::edge_collapse(
        mesh, Face_ratio_stop(1, mesh),
        CGAL::parameters::get_cost(cost).get_placement(placement).visitor(placement.visitor()));
  EXPECT_EQ(questions, 0u);
  SMS::edge_collapse(mesh, Face_ratio_stop(0.5, mesh),
                     CGAL::parameters::get_cost(cost).get_placement(placement).visitor(placement.visitor()));
  EXPECT_GT(questions, 50u);
}

TEST(Composition, FiltersWorkAloneAndStacked)
{
  const auto faces_left = [](const auto& filter, auto&& make_mesh) {
    Mesh mesh = make_mesh();
    SMS::edge_collapse(mesh, Face_ratio_stop(0.02, mesh), CGAL::parameters::filter(filter));
    return mesh.number_of_faces();
  };
  const auto skirt_mesh = [] { return mesh_of(skirt(2000, 1)); };
  const Aspect_ratio_filter<> aspect_ratio(0.6);
  const Normal_change_filter<> normal_change(10);
  const Normal_change_filter<Aspect_ratio_filter<>> both(10, aspect_ratio);
  const std::size_t free = faces_left(No_filter(), skirt_mesh);
  EXPECT_GT(faces_left(aspect_ratio, skirt_mesh), free);
  EXPECT_GT(faces_left(normal_change, skirt_mesh), free);
  EXPECT_GE(faces_left(both, skirt_mesh), faces_left(normal_change, skirt_mesh));
  EXPECT_GT(both.refusals(), 0u);
}

TEST(Composition, AMeshWithAnEdgeOfLengthZeroIsRefused)
{
  Mesh mesh;
  const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({0, 0, 0}), c = mesh.add_vertex({1, 0, 0});
  mesh.add_face(a, b, c);
  EXPECT_THROW(Intersection_filter<Mesh>{mesh}, Argument_error);
}

} // namespace
} // namespace selvedge::test
