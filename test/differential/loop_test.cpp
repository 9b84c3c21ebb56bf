// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The own loop against CGAL's: where no two edges cost the same, the same collapses in the same order.

#include "soup/Working_mesh.h"
#include "soup/number_positions.h"
#include <selvedge/Surface_mesh_simplification/Aspect_ratio_filter.h>
#include <selvedge/Surface_mesh_simplification/Border_filter.h>
#include <selvedge/Surface_mesh_simplification/Halfedge_placement.h>
#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Quadric_cost.h>
#include <selvedge/Surface_mesh_simplification/Visitor_chain.h>
#include <selvedge/Surface_mesh_simplification/edge_collapse.h>

#include "support/Edge_ratio_stop.h"
#include "support/meshes.h"

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <random>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

namespace SMS = CGAL::Surface_mesh_simplification;
using Surface_mesh = Working_mesh::Mesh;

struct Step
{
  Point_3 p0, p1, placement;

  friend bool operator==(const Step& a, const Step& b)
  {
    return a.p0 == b.p0 && a.p1 == b.p1 && a.placement == b.placement;
  }
};

struct Recorder : internal::No_visitor
{
  Recorder(std::vector<Step>& steps_, std::vector<double>& costs_) : steps(&steps_), costs(&costs_) {}

  template <class Profile, class OptionalCost>
  void OnCollected(const Profile&, const OptionalCost& cost)
  {
    if (cost)
      costs->push_back(*cost);
  }
  template <class Profile, class OptionalPoint>
  void OnCollapsing(const Profile& profile, const OptionalPoint& placement)
  {
    steps->push_back({profile.p0(), profile.p1(), *placement});
  }

  std::vector<Step>* steps;
  std::vector<double>* costs;
};

/// A placement without its second, which does not say what can wait, and a filter without its blockers.
template <class Placement>
struct First_placement_alone
{
  Placement placement;

  template <class Profile>
  auto operator()(const Profile& profile) const
  {
    return placement(profile);
  }
  bool reaches_neighbours(Surface_mesh::Vertex_index kept) const
  {
    return placement.reaches_neighbours(kept);
  }
  bool reaches(Surface_mesh::Vertex_index kept, Surface_mesh::Edge_index edge) const
  {
    return placement.reaches(kept, edge);
  }
};
template <class Filter>
struct Without_blockers
{
  const Filter* filter;

  template <class Profile, class OptionalPoint>
  auto operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    return (*filter)(profile, placement);
  }
};

/// A placement that counts what it is asked, and lets nothing wait unless `is_patient`.
template <class Placement>
struct Counting_placement
{
  using Cost_policy = typename Placement::Cost_policy;

  Placement placement;
  bool is_patient;
  std::size_t* questions;

  template <class Profile>
  auto operator()(const Profile& profile) const
  {
    return placement(profile);
  }
  template <class Profile>
  auto choice(const Profile& profile, unsigned rank) const
  {
    ++*questions;
    return placement.choice(profile, rank);
  }
  template <class Profile>
  auto collapse(const Profile& profile, internal::Merged_at at) const
  {
    return placement.collapse(profile, at);
  }
  bool reaches_neighbours(Surface_mesh::Vertex_index kept) const
  {
    return placement.reaches_neighbours(kept);
  }
  bool reaches(Surface_mesh::Vertex_index kept, Surface_mesh::Edge_index edge) const
  {
    return placement.reaches(kept, edge);
  }
  bool can_wait(Surface_mesh::Vertex_index kept, Surface_mesh::Edge_index edge) const
  {
    return is_patient && placement.can_wait(kept, edge);
  }
};

/// A placement that says neither what its edges cost nor which of them a collapse concerns.
template <class Placement>
struct Silent_placement
{
  Placement placement;

  template <class Profile>
  auto operator()(const Profile& profile) const
  {
    return placement(profile);
  }
  template <class Profile>
  auto second(const Profile& profile) const
  {
    return placement.second(profile);
  }
};

/// The placement that is a loop's last resort.
template <class Placement>
struct Second_placement
{
  Placement placement;

  template <class Profile>
  auto operator()(const Profile& profile) const
  {
    return placement.second(profile);
  }
};

/// Shaken, so that no two edges cost the same.
Surface_mesh shaken(Triangle_soup soup, double by = 1e-3)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-by, by);
  for (Point_3& p : soup.points)
    p = Point_3(p.x() + shift(random), p.y() + shift(random), p.z() + shift(random));
  const std::vector<char> is_frozen(soup.triangles.size(), false);
  return Working_mesh(soup, number_positions(soup.points), is_frozen).mesh();
}

std::vector<std::pair<std::string, Surface_mesh>> meshes()
{
  return {{"spheres", shaken(nested_spheres(3000, 2, 0.01))}, // closed
          {"sheets", shaken(sheets(3000, 2, 0.01))},          // with borders
          {"skirt", shaken(skirt(4000))}};
}

template <class Mesh, class Reduce_own, class Reduce_cgal>
void expect_same_steps(const Mesh& mesh, std::size_t least, const Reduce_own& reduce_own,
                       const Reduce_cgal& reduce_cgal)
{
  Mesh own = mesh, cgal = mesh;
  std::vector<Step> own_steps, cgal_steps;
  std::vector<double> costs;
  reduce_own(own, Recorder(own_steps, costs));
  EXPECT_EQ(std::set<double>(costs.begin(), costs.end()).size(), costs.size()) << "costs tie";
  reduce_cgal(cgal, Recorder(cgal_steps, costs));
  EXPECT_GE(own_steps.size(), least);
  ASSERT_EQ(own_steps.size(), cgal_steps.size());
  for (std::size_t i = 0; i < own_steps.size(); ++i)
    ASSERT_TRUE(own_steps[i] == cgal_steps[i]) << "step " << i;
}

const double ratio = 0.1;

TEST(Own_loop, GoesAsCgalsWithDefaultPolicies)
{
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const Edge_ratio_stop stop(ratio);
    expect_same_steps(
        mesh, 10,
        [&](Surface_mesh& reduced, const Recorder& recorder) {
          selvedge::edge_collapse(reduced, stop, CGAL::parameters::visitor(recorder));
        },
        [&](Surface_mesh& reduced, const Recorder& recorder) {
          SMS::edge_collapse(reduced, stop, CGAL::parameters::visitor(recorder));
        });
  }
}

TEST(Own_loop, GoesAnotherWayWithoutTheGeometricTest)
{
  bool is_different = false;
  for (const auto& [name, mesh] : meshes()) {
    Surface_mesh with = mesh, without = mesh;
    std::vector<Step> steps_with, steps_without;
    std::vector<double> costs;
    const Edge_ratio_stop stop(ratio);
    selvedge::edge_collapse(with, stop, CGAL::parameters::visitor(Recorder(steps_with, costs)));
    selvedge::edge_collapse(without, stop,
                            parameters::geometric_test(false).visitor(Recorder(steps_without, costs)));
    is_different = is_different || steps_with != steps_without;
  }
  EXPECT_TRUE(is_different);
}

TEST(Own_loop, GoesAsCgalsWithPoliciesThatLookAtTheEndsAlone)
{
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const Edge_ratio_stop stop(ratio);
    const SMS::Edge_length_cost<Surface_mesh> cost;
    const SMS::Midpoint_placement<Surface_mesh> placement;
    const SMS::Bounded_normal_change_filter<> filter;
    expect_same_steps(
        mesh, 10,
        [&](Surface_mesh& reduced, const Recorder& recorder) {
          selvedge::edge_collapse(
              reduced, stop,
              CGAL::parameters::get_cost(cost).get_placement(placement).filter(filter).visitor(recorder));
        },
        [&](Surface_mesh& reduced, const Recorder& recorder) {
          SMS::edge_collapse(
              reduced, stop,
              CGAL::parameters::get_cost(cost).get_placement(placement).filter(filter).visitor(recorder));
        });
  }
}

TEST(Own_loop, GoesAsCgalsWithQuadricsAndTheExactFilter)
{
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const Edge_ratio_stop stop(ratio);
    const auto reduce = [&](Surface_mesh& reduced, const Recorder& recorder, const auto& run,
                            const auto& base) {
      using Cost = Quadric_cost<Surface_mesh>;
      using Base = std::decay_t<decltype(base)>;
      const Cost cost(reduced);
      const First_placement_alone<Halfedge_placement<Surface_mesh, Cost>> placement{
          Halfedge_placement<Surface_mesh, Cost>(cost)};
      const Intersection_filter<Surface_mesh, Base> filter(reduced, base);
      run(reduced, CGAL::parameters::get_cost(cost)
                       .get_placement(placement)
                       .filter(Without_blockers<decltype(filter)>{&filter})
                       .visitor(Visitor_chain(recorder, filter.visitor())));
    };
    const Aspect_ratio_filter<> base(0.1);
    expect_same_steps(
        mesh, 10,
        [&](Surface_mesh& reduced, const Recorder& recorder) {
          reduce(
              reduced, recorder,
              [&](Surface_mesh& m, const auto& parameters) { selvedge::edge_collapse(m, stop, parameters); },
              base);
        },
        [&](Surface_mesh& reduced, const Recorder& recorder) {
          reduce(
              reduced, recorder,
              [&](Surface_mesh& m, const auto& parameters) { SMS::edge_collapse(m, stop, parameters); },
              base);
        });
  }
}

struct Is_constrained
{
  using key_type = Surface_mesh::Edge_index;
  using value_type = bool;
  using reference = bool;
  using category = boost::readable_property_map_tag;

  // Every seventh edge of the input; edges keep their numbers.
  friend bool get(const Is_constrained&, key_type e) { return std::size_t(e) % 7 == 0; }
};

TEST(Own_loop, GoesAsCgalsAroundConstrainedEdges)
{
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const Edge_ratio_stop stop(ratio);
    expect_same_steps(
        mesh, 10,
        [&](Surface_mesh& reduced, const Recorder& recorder) {
          selvedge::edge_collapse(
              reduced, stop, CGAL::parameters::edge_is_constrained_map(Is_constrained()).visitor(recorder));
        },
        [&](Surface_mesh& reduced, const Recorder& recorder) {
          SMS::edge_collapse(reduced, stop,
                             CGAL::parameters::edge_is_constrained_map(Is_constrained()).visitor(recorder));
        });
  }
}

TEST(Own_loop, TakesVisitorsDerivedFromCgals)
{
  struct Visitor : SMS::Edge_collapse_visitor_base<Surface_mesh>
  {
    explicit Visitor(std::array<std::size_t, 4>& calls_) : calls(&calls_) {}
    void OnCollected(const Profile&, const internal::Optional<double>&) { ++(*calls)[0]; }
    void OnSelected(const Profile&, const internal::Optional<double>&, std::size_t, std::size_t)
    {
      ++(*calls)[1];
    }
    void OnCollapsed(const Profile& profile, const Surface_mesh::Vertex_index& kept)
    {
      EXPECT_TRUE(kept == profile.v0() || kept == profile.v1());
      ++(*calls)[2];
    }
    void OnNonCollapsable(const Profile&) { ++(*calls)[3]; }
    std::array<std::size_t, 4>* calls;
  };
  Surface_mesh mesh = shaken(sheets(1000, 1, 0.01));
  const std::size_t edges = mesh.number_of_edges();
  std::array<std::size_t, 4> calls{};
  const Edge_ratio_stop stop(0.3);
  const int removed = selvedge::edge_collapse(mesh, stop, CGAL::parameters::visitor(Visitor(calls)));
  EXPECT_EQ(mesh.number_of_edges(), edges - removed);
  EXPECT_EQ(calls[0], edges);
  EXPECT_EQ(calls[1], calls[2] + calls[3] + 1); // the last was selected only to be told to stop
  EXPECT_GT(calls[2], 100u);
  EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
}

TEST(Own_loop, GoesAsCgalsOnAPolyhedron)
{
  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  Polyhedron mesh;
  CGAL::copy_face_graph(shaken(sheets(1000, 1, 0.01)), mesh);
  const Edge_ratio_stop stop(ratio);
  Polyhedron own = mesh, cgal = mesh;
  EXPECT_GT(selvedge::edge_collapse(own, stop), 100);
  SMS::edge_collapse(cgal, stop);
  const auto points = [](const Polyhedron& reduced) {
    std::set<Point_3> all;
    for (const auto v : vertices(reduced))
      all.insert(v->point());
    return all;
  };
  EXPECT_EQ(points(own), points(cgal));
}

// Makes a rule with limits along borders and along some inner edges, and with some pairs of spokes, along
// which a pole may move onto a vertex that is on no line.
Border_rule<Surface_mesh> rule_with_lines(const Surface_mesh& mesh)
{
  Border_rule_options options;
  options.max_border_turn = 30;
  options.max_drift = 0.01;
  Border_rule<Surface_mesh> rule(mesh, options);
  for (const auto e : mesh.edges())
    if (std::size_t(e) % 50 == 0)
      rule.mark(e);
  for (const auto v : mesh.vertices())
    if (std::size_t(v) % 25 == 0 && rule.is_free(v) && mesh.degree(v) == 6) {
      const auto h = mesh.halfedge(v);
      const auto ahead = [&](auto in) { return mesh.opposite(mesh.next(in)); };
      rule.mark_at_target(h);
      rule.mark_at_target(ahead(ahead(ahead(h))));
    }
  return rule;
}

// What a placement tells the loop saves work and changes nothing, along lines neither.
TEST(Own_loop, GoesTheSameWayWhenItIsToldLess)
{
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const Edge_ratio_stop stop(ratio);
    const auto reduce = [&](Surface_mesh& reduced, const Recorder& recorder, const auto& told) {
      using Rule = Border_rule<Surface_mesh>;
      const Rule rule = rule_with_lines(reduced);
      using Cost = Quadric_cost<Surface_mesh, Rule>;
      const Cost cost(reduced, {}, rule);
      const Border_filter<Rule, Aspect_ratio_filter<>> filter(rule, Aspect_ratio_filter<>(0.2));
      selvedge::edge_collapse(
          reduced, stop,
          CGAL::parameters::get_cost(cost)
              .get_placement(told(Halfedge_placement<Surface_mesh, Cost, Rule>(cost, rule)))
              .filter(filter)
              .visitor(Visitor_chain(recorder, Border_visitor<Surface_mesh>(rule))));
    };
    expect_same_steps(
        mesh, 100,
        [&](Surface_mesh& reduced, const Recorder& recorder) {
          std::size_t questions = 0;
          reduce(reduced, recorder, [&](const auto& placement) {
            return Counting_placement<std::decay_t<decltype(placement)>>{placement, false, &questions};
          });
        },
        [&](Surface_mesh& reduced, const Recorder& recorder) {
          reduce(reduced, recorder, [](const auto& placement) {
            return Silent_placement<std::decay_t<decltype(placement)>>{placement};
          });
        });
  }
}

/// Compares the cost that an edge is selected at with the one that the placement has for it now.
template <class Placement>
struct Cost_check : internal::No_visitor
{
  Cost_check(const Placement& placement_, double& sum_) : placement(placement_), sum(&sum_) {}

  template <class Profile, class OptionalCost, class Size>
  void OnSelected(const Profile& profile, const OptionalCost& cost, Size, Size)
  {
    const auto now = placement.choice(profile, 0);
    ASSERT_TRUE(now && now->cost);
    EXPECT_EQ(*cost, *now->cost);
    *sum += *cost;
  }

  Placement placement;
  double* sum;
};

// Costs that can wait save questions. They are computed before their edge collapses, and in time for the
// order.
TEST(Own_loop, AsksLaterAboutWhatCanWait)
{
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const auto reduce = [&, &input = mesh](bool is_patient) {
      Surface_mesh reduced = input;
      using Cost = Quadric_cost<Surface_mesh>;
      const Cost cost(reduced);
      const Halfedge_placement<Surface_mesh, Cost> placement(cost);
      std::size_t questions = 0;
      double sum = 0;
      selvedge::edge_collapse(
          reduced, Edge_ratio_stop(ratio),
          parameters::geometric_test(
              false, CGAL::parameters::get_cost(cost)
                         .get_placement(Counting_placement<std::decay_t<decltype(placement)>>{
                             placement, is_patient, &questions})
                         .visitor(Cost_check<std::decay_t<decltype(placement)>>(placement, sum))));
      return std::pair(questions, sum);
    };
    const auto [all_questions, least_sum] = reduce(false);
    const auto [questions, sum] = reduce(true);
    EXPECT_LT(double(questions), 0.75 * double(all_questions));
    EXPECT_LT(sum, 1.05 * least_sum);
  }
}

// A cost of which nothing can wait, with a bound if wished. It counts how often it is computed.
template <bool is_bounded>
struct Bounded_cost : Quadric_cost<Surface_mesh>
{
  Bounded_cost(const Surface_mesh& mesh, std::size_t& questions_) : Quadric_cost(mesh), questions(&questions_)
  {
  }

  template <class Profile, class Halfedge>
  auto cost_along(const Profile& profile, Halfedge moving) const
  {
    ++*questions;
    return Quadric_cost::cost_along(profile, moving);
  }
  template <class Profile>
  auto costs_along(const Profile& profile) const
  {
    *questions += 2;
    return Quadric_cost::costs_along(profile);
  }
  template <class Profile>
  auto cost_bounds(const Profile& profile) const
  {
    auto bounds = Quadric_cost::costs_along(profile);
    for (const auto& [moving, bound] :
         {std::make_pair(profile.v0(), &bounds[0]), std::make_pair(profile.v1(), &bounds[1])}) {
      const int kind = int(moving.idx() % 4);
      if (!is_bounded || kind == 0)
        bound->reset();
      else
        **bound *= kind == 1 ? 1 : kind / 4.;
    }
    return bounds;
  }
  bool can_wait(Surface_mesh::Vertex_index, Surface_mesh::Edge_index) const { return false; }

  std::size_t* questions;
};

TEST(Own_loop, ComputesACostWithABoundOnlyWhenTheEdgeIsTheCheapest)
{
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const auto reduce = [&, &input = mesh](auto make_cost, std::size_t& questions, double share = ratio) {
      Surface_mesh reduced = input;
      using Rule = Border_rule<Surface_mesh>;
      const Rule rule = rule_with_lines(reduced);
      const auto cost = make_cost(reduced, questions);
      const Halfedge_placement<Surface_mesh, std::decay_t<decltype(cost)>, Rule> placement(cost, rule);
      std::vector<Step> steps;
      std::vector<double> costs;
      selvedge::edge_collapse(
          reduced, Edge_ratio_stop(share),
          CGAL::parameters::get_cost(cost)
              .get_placement(placement)
              .filter(Border_filter<Rule>(rule))
              .visitor(Visitor_chain(Recorder(steps, costs), Border_visitor<Surface_mesh>(rule))));
      return steps;
    };
    std::size_t questions = 0, questions_with_bound = 0;
    const std::size_t edges = num_edges(mesh);
    reduce([](auto&... of) { return Bounded_cost<true>(of...); }, questions_with_bound, 1);
    EXPECT_LT(questions_with_bound, edges); // of the edges that have a bound, only the first
    questions_with_bound = 0;
    const auto steps = reduce([](auto&... of) { return Bounded_cost<false>(of...); }, questions);
    const auto steps_with_bound =
        reduce([](auto&... of) { return Bounded_cost<true>(of...); }, questions_with_bound);
    EXPECT_EQ(steps_with_bound, steps);
    EXPECT_LT(double(questions_with_bound), 0.8 * double(questions));
  }
}

// The extras: what was refused because of a face elsewhere comes back when that face has changed.
TEST(Own_loop, EndsOnlyWhenNothingIsPossibleAnyMore)
{
  Surface_mesh mesh = shaken(sheets(6000, 6, 1e-5), 1e-6);
  const Intersection_filter<Surface_mesh, Aspect_ratio_filter<>> filter(mesh, Aspect_ratio_filter<>(0.4));
  using Cost = Quadric_cost<Surface_mesh>;
  const Cost cost(mesh);
  const Halfedge_placement<Surface_mesh, Cost> placement(cost);
  const Edge_ratio_stop stop(0);
  const auto run = [&](const auto& placement_) {
    return selvedge::edge_collapse(
        mesh, stop,
        CGAL::parameters::get_cost(cost).get_placement(placement_).filter(filter).visitor(filter.visitor()));
  };
  EXPECT_GT(run(placement), 1000);
  EXPECT_GT(filter.refusals(), 100u);
  EXPECT_EQ(run(placement), 0);
  EXPECT_EQ(run(Second_placement<decltype(placement)>{placement}), 0);
}

/// A cost that other collapses change, and none where an end has five edges.
struct Cost_of_surroundings
{
  bool is_patient;
  std::size_t *questions, *without_cost;

  template <class Profile>
  internal::Optional<double> operator()(const Profile& profile, const internal::Optional<Point_3>&) const
  {
    ++*questions;
    const Surface_mesh& mesh = profile.surface_mesh();
    double squares = 0;
    for (const auto v : {profile.v0(), profile.v1()}) {
      if (degree(v, mesh) == 5) {
        ++*without_cost;
        return {};
      }
      for (const auto h : CGAL::halfedges_around_target(v, mesh))
        squares += CGAL::squared_distance(profile.p0(), mesh.point(source(h, mesh)));
    }
    const std::size_t of_edge = 7919 * std::size_t(profile.v0()) + 104729 * std::size_t(profile.v1());
    return squares * double(1 + of_edge % 1000) * double(1 + of_edge % 1000); // far apart in the queue
  }
  bool reaches_neighbours(Surface_mesh::Vertex_index) const { return true; }
  bool reaches(Surface_mesh::Vertex_index, Surface_mesh::Edge_index) const { return true; }
  bool can_wait(Surface_mesh::Vertex_index, Surface_mesh::Edge_index) const { return is_patient; }
};

// An edge that has waited may have no cost when its turn comes, and one again when others have collapsed.
TEST(Own_loop, LosesNoEdgeWhoseCostComesAndGoes)
{
  std::size_t asked[2] = {}, without_cost[2] = {};
  for (const bool is_patient : {false, true}) {
    Surface_mesh mesh = shaken(sheets(6000, 1, 0.01));
    const auto run = [&](std::size_t& seen, std::size_t& none) {
      const Cost_of_surroundings cost{is_patient, &seen, &none};
      const SMS::Midpoint_placement<Surface_mesh> placement;
      const Edge_ratio_stop stop(0);
      return selvedge::edge_collapse(mesh, stop, CGAL::parameters::get_cost(cost).get_placement(placement));
    };
    EXPECT_GT(run(asked[is_patient], without_cost[is_patient]), 1000);
    std::size_t again = 0;
    EXPECT_EQ(run(again, again), 0);
  }
  EXPECT_LT(double(asked[1]), 0.9 * double(asked[0]));
  EXPECT_GT(without_cost[1], 1000u);
}

TEST(Own_loop, WithoutBlockersForgetsEdges)
{
  Surface_mesh mesh = shaken(sheets(6000, 6, 1e-5), 1e-6);
  const Intersection_filter<Surface_mesh, Aspect_ratio_filter<>> filter(mesh, Aspect_ratio_filter<>(0.4));
  using Cost = Quadric_cost<Surface_mesh>;
  const Cost cost(mesh);
  const Halfedge_placement<Surface_mesh, Cost> placement(cost);
  const Edge_ratio_stop stop(0);
  const auto run = [&] {
    return selvedge::edge_collapse(mesh, stop,
                                   CGAL::parameters::get_cost(cost)
                                       .get_placement(placement)
                                       .filter(Without_blockers<decltype(filter)>{&filter})
                                       .visitor(filter.visitor()));
  };
  EXPECT_GT(run(), 1000);
  EXPECT_GT(run(), 0);
}

} // namespace
} // namespace selvedge::test
