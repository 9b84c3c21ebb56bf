// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What the filter, the loop and the visitors owe to programs that plug them in: they work together with
// other people's policies, and say so where they are used wrongly.

#include <selvedge/Surface_mesh_simplification/Border_filter.h>
#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Normal_change_filter.h>
#include <selvedge/Surface_mesh_simplification/Visitor_chain.h>
#include <selvedge/Surface_mesh_simplification/edge_collapse.h>
#include <selvedge/Surface_mesh_simplification/simplify_mesh.h>
#include <selvedge/spatial/Clustered_AABB_tree.h>
#include <selvedge/verify.h>

#include "support/Edge_ratio_stop.h"
#include "support/mesh_of.h"
#include "support/meshes.h"
#include "support/soups.h"

#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_profile.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace selvedge::test {
namespace {

namespace SMS = CGAL::Surface_mesh_simplification;

template <class Parameters>
int collapse(bool is_own, Mesh& mesh, const Parameters& parameters)
{
  const Edge_ratio_stop stop(0.5);
  return is_own ? selvedge::edge_collapse(mesh, stop, parameters)
                : SMS::edge_collapse(mesh, stop, parameters);
}

Mesh waves()
{
  return mesh_of(sheets(2000, 4, 1e-5));
}

// A visitor as other people write it.
struct Counting_visitor : SMS::Edge_collapse_visitor_base<Mesh>
{
  explicit Counting_visitor(int& collapses_) : collapses(&collapses_) {}
  void OnCollapsing(const Profile& profile, const internal::Optional<Point_3>&)
  {
    expected = profile.link().size();
  }
  void OnCollapsed(const Profile& profile, const Mesh::Vertex_index&)
  {
    *collapses += profile.link().size() == expected;
  }
  int* collapses;
  std::size_t expected = 0;
};

// An observer need not say that it has costs.
TEST(Simplify_mesh, KeepsVerticesWhoseMotionsItsObserverMakesCostly)
{
  struct Costly_left : No_observer
  {
    const Mesh* mesh;

    double uv_cost(Mesh::Halfedge_index moving) const
    {
      return mesh->point(mesh->source(moving)).x() < 10 ? 1e6 : 0;
    }
  };
  const auto left_of_the_middle = [](const Mesh& mesh) {
    const auto all = mesh.vertices();
    return std::count_if(all.begin(), all.end(), [&](auto v) { return mesh.point(v).x() < 10; });
  };
  Mesh mesh = mesh_of(mapped(sheet(20, 20), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), std::sin(p.x()) * std::cos(p.y()));
  }));
  Mesh plain = mesh;
  Costly_left observer;
  observer.mesh = &mesh;
  Simplify_options options;
  options.ratio = 0.6;
  const auto before = left_of_the_middle(mesh);
  simplify_mesh(mesh, options, {}, observer);
  simplify_mesh(plain, options);
  EXPECT_GT(left_of_the_middle(mesh), 0.9 * double(before));
  EXPECT_LT(left_of_the_middle(plain), 0.8 * double(before));
}

TEST(Simplify_mesh, MeasuresByTheVerticesThatItsFacesUse)
{
  for (const Placement placement : {Placement::vertices, Placement::optimal}) {
    Mesh mesh = waves(), with_another = mesh;
    with_another.add_vertex({1e4, 0, 0});
    Simplify_options options;
    options.max_error = 0.001;
    options.placement = placement;
    simplify_mesh(mesh, options);
    simplify_mesh(with_another, options);
    EXPECT_LT(mesh.number_of_faces(), waves().number_of_faces());
    EXPECT_EQ(with_another.number_of_faces(), mesh.number_of_faces());
  }
}

/// Places one vertex in three nowhere.
struct Place_nowhere
{
  using Point = Point_3;
  template <class Profile>
  boost::optional<Point> operator()(const Profile& profile) const
  {
    const Point middle = CGAL::midpoint(profile.p0(), profile.p1());
    const double nowhere[] = {std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity()};
    return std::size_t(profile.v0()) % 3 == 0 ? Point(middle.x(), nowhere[std::size_t(profile.v1()) % 2], 0)
                                              : middle;
  }
};

TEST(Edge_collapse, TakesAPlaceThatIsNotFiniteForNone)
{
  for (const bool is_own : {false, true}) {
    Mesh mesh = waves();
    const auto before = num_edges(mesh);
    Intersection_filter<Mesh> filter(mesh);
    EXPECT_GT(
        collapse(is_own, mesh,
                 CGAL::parameters::get_placement(Place_nowhere()).filter(filter).visitor(filter.visitor())),
        0);
    EXPECT_LT(mesh.number_of_edges(), before);
    for (const auto v : mesh.vertices())
      EXPECT_TRUE(std::isfinite(mesh.point(v).y()));
  }
}

TEST(Visitor_chain, CallsAllVisitorsInEitherLoop)
{
  for (const bool is_own : {true, false}) {
    Mesh mesh = waves();
    int collapses = 0;
    const Intersection_filter<Mesh> filter(mesh);
    const std::size_t vertices_before = mesh.number_of_vertices();
    collapse(is_own, mesh,
             CGAL::parameters::filter(filter).visitor(
                 Visitor_chain(Counting_visitor(collapses), filter.visitor())));
    EXPECT_EQ(mesh.number_of_vertices() + std::size_t(collapses), vertices_before);
    EXPECT_GT(collapses, 50);
    EXPECT_TRUE(is_embedded(soup_of(mesh)));
  }
}

// Returns what the loop says about a filter and a visitor with which it does not end.
template <class Visitor>
std::string refusal(bool is_own, Mesh& mesh, const Intersection_filter<Mesh>& filter, const Visitor& visitor)
{
  try {
    collapse(is_own, mesh, CGAL::parameters::filter(filter).visitor(visitor));
  } catch (const Argument_error& error) {
    return error.what();
  }
  return "no refusal";
}

TEST(Intersection_filter, IsRefusedWithoutItsVisitorBeforeTheFirstCollapse)
{
  for (const bool is_own : {true, false})
    for (const bool is_second_run : {true, false}) {
      Mesh mesh = waves();
      const Intersection_filter<Mesh> filter(mesh);
      if (is_second_run)
        collapse(is_own, mesh, CGAL::parameters::filter(filter).visitor(filter.visitor()));
      const Triangle_soup before = soup_of(mesh);
      const std::string message = refusal(is_own, mesh, filter, internal::No_visitor());
      EXPECT_NE(message.find("visitor(filter.visitor())"), std::string::npos) << message;
      EXPECT_EQ(soup_of(mesh).points, before.points);
      EXPECT_EQ(soup_of(mesh).triangles, before.triangles);
    }
}

// A visitor of somebody who has forgotten to pass two calls on.
struct Forgetful_visitor : internal::No_visitor
{
  Forgetful_visitor(const Intersection_filter<Mesh>::Visitor& visitor_, int& collapses_)
      : visitor(visitor_), collapses(&collapses_)
  {
  }
  void OnStarted(Mesh& mesh) { visitor.OnStarted(mesh); }
  template <class Profile, class Vertex>
  void OnCollapsed(const Profile&, const Vertex&)
  {
    ++*collapses;
  }
  Intersection_filter<Mesh>::Visitor visitor;
  int* collapses;
};

TEST(Intersection_filter, IsRefusedAfterOneCollapseThatItsVisitorWasNotTold)
{
  for (const bool is_own : {true, false}) {
    Mesh mesh = waves();
    int collapses = 0;
    const Intersection_filter<Mesh> filter(mesh);
    const std::string message = refusal(is_own, mesh, filter, Forgetful_visitor(filter.visitor(), collapses));
    EXPECT_NE(message.find("Visitor_chain"), std::string::npos) << message;
    EXPECT_EQ(collapses, 1);
    EXPECT_TRUE(is_embedded(soup_of(mesh)));
  }
}

// Throws within the first collapse, before the visitors after it in a chain are told that it is done.
struct Throwing_visitor : internal::No_visitor
{
  template <class Profile, class Vertex>
  void OnCollapsed(const Profile&, const Vertex&)
  {
    throw std::length_error("of somebody's own");
  }
};

// Onto the end that CGAL keeps, so that no vertex is elsewhere than the filter has it.
struct Placement_at_v1
{
  template <class Profile>
  internal::Optional<typename Profile::Point> operator()(const Profile& profile) const
  {
    return profile.p1();
  }
};

TEST(Intersection_filter, IsRefusedAfterARunThatAnExceptionHasLeftWithinACollapse)
{
  for (const bool is_own : {true, false})
    for (const bool is_told : {true, false}) {
      Mesh mesh = waves();
      const Intersection_filter<Mesh> filter(mesh);
      const auto collapse_with = [&](const auto& visitor) {
        collapse(is_own, mesh,
                 CGAL::parameters::get_placement(Placement_at_v1()).filter(filter).visitor(visitor));
      };
      if (is_told) {
        EXPECT_THROW(collapse_with(Visitor_chain(filter.visitor(), Throwing_visitor())), std::length_error);
        EXPECT_NO_THROW(collapse_with(filter.visitor()));
      } else {
        EXPECT_THROW(collapse_with(Visitor_chain(Throwing_visitor(), filter.visitor())), std::length_error);
        EXPECT_THROW(collapse_with(filter.visitor()), Argument_error);
      }
      EXPECT_TRUE(is_embedded(soup_of(mesh)));
    }
}

TEST(Intersection_filter, IsRefusedToThreadsThatRoundOtherwiseOrFlushToZero)
{
  std::vector<std::function<void()>> settings = {[] { std::fesetround(FE_UPWARD); },
                                                 [] { std::fesetround(FE_TOWARDZERO); }};
#ifdef __SSE2__ // as code that was compiled with -ffast-math sets it
  settings.push_back([] { _mm_setcsr(_mm_getcsr() | 0x8000); }); // results that are subnormal become 0
  settings.push_back([] { _mm_setcsr(_mm_getcsr() | 0x0040); }); // so do operands
#endif
  Mesh mesh = waves();
  const Triangle_soup soup = soup_of(mesh);
  for (const auto& set : settings) {
    const Intersection_filter<Mesh> filter(mesh);
    set();
    EXPECT_THROW(Intersection_filter<Mesh> other(mesh), Argument_error);
    EXPECT_THROW(filter.visitor().OnStarted(mesh), Argument_error);
    EXPECT_THROW(offending_pairs(soup), Argument_error);
    EXPECT_THROW(is_embedded(soup), Argument_error);
    std::fesetenv(FE_DFL_ENV);
    EXPECT_NO_THROW(filter.visitor().OnStarted(mesh));
    EXPECT_TRUE(is_embedded(soup));
  }
}

TEST(Intersection_filter, IsRefusedForAMeshThatHasChangedSinceItWasMade)
{
  Mesh mesh = waves();
  const Intersection_filter<Mesh> filter(mesh);
  CGAL::Euler::remove_face(halfedge(*faces(mesh).begin(), mesh), mesh);
  EXPECT_THROW(collapse(true, mesh, CGAL::parameters::filter(filter).visitor(filter.visitor())),
               Argument_error);
}

TEST(Intersection_filter, IsRefusedForAMeshWhoseEdgeWasFlippedSinceItWasMade)
{
  Mesh mesh = waves();
  const Intersection_filter<Mesh> filter(mesh);
  const auto edge = std::find_if(edges(mesh).begin(), edges(mesh).end(),
                                 [&](Mesh::Edge_index e) { return !mesh.is_border(e); });
  CGAL::Euler::flip_edge(halfedge(*edge, mesh), mesh);
  EXPECT_NE(refusal(true, mesh, filter, filter.visitor()).find("has changed"), std::string::npos);
}

TEST(Intersection_filter, GuardsAMeshThatHasRemovedElements)
{
  for (const bool is_guarded : {true, false}) {
    Mesh mesh = waves();
    const Intersection_filter<Mesh> first(mesh);
    selvedge::edge_collapse(mesh, Edge_ratio_stop(0.97),
                            CGAL::parameters::filter(first).visitor(first.visitor()));
    ASSERT_TRUE(mesh.has_garbage());
    const Intersection_filter<Mesh> second(mesh);
    EXPECT_GT(is_guarded ? collapse(true, mesh, CGAL::parameters::filter(second).visitor(second.visitor()))
                         : collapse(true, mesh, CGAL::parameters::all_default()),
              0);
    EXPECT_EQ(is_embedded(soup_of(mesh)), is_guarded);
  }
}

TEST(Intersection_filter, IsRefusedForAMeshThatWasNumberedAnewBetweenItsRuns)
{
  Mesh mesh = waves();
  const Intersection_filter<Mesh> filter(mesh);
  for (int run = 0; run < 2; ++run)
    EXPECT_EQ(refusal(true, mesh, filter, filter.visitor()), "no refusal");
  mesh.collect_garbage();
  EXPECT_NE(refusal(true, mesh, filter, filter.visitor()).find("has changed"), std::string::npos);
}

TEST(Intersection_filter, IsRefusedForAMeshWhoseVerticesHaveMovedAndForAnother)
{
  for (const bool is_own : {true, false}) {
    Mesh mesh = waves();
    const Intersection_filter<Mesh> filter(mesh);
    Mesh copy = mesh;
    EXPECT_NE(refusal(is_own, copy, filter, filter.visitor()).find("another mesh"), std::string::npos);
    const Mesh::Vertex_index moved = *vertices(mesh).begin();
    const Point_3 place = mesh.point(moved);
    mesh.point(moved) = Point_3(place.x(), place.y(), place.z() + 1);
    EXPECT_NE(refusal(is_own, mesh, filter, filter.visitor()).find("has changed"), std::string::npos);
    mesh.point(moved) = place;
    EXPECT_EQ(refusal(is_own, mesh, filter, filter.visitor()), "no refusal");
  }
}

TEST(Intersection_filter, RefusesFacesThatAreNoTriangles)
{
  Mesh mesh;
  mesh.add_face(mesh.add_vertex({0, 0, 0}), mesh.add_vertex({1, 0, 0}), mesh.add_vertex({1, 1, 0}),
                mesh.add_vertex({0, 1, 0}));
  EXPECT_THROW(Intersection_filter<Mesh>{mesh}, Argument_error);
  EXPECT_THROW(simplify_mesh(mesh, {}), Argument_error);
  CGAL::Polygon_mesh_processing::triangulate_faces(mesh);
  EXPECT_NO_THROW(Intersection_filter<Mesh>{mesh});
}

TEST(Intersection_filter, RefusesCoordinatesThatAreNotFinite)
{
  using Limits = std::numeric_limits<double>;
  for (const double wrong : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()})
    for (const Point_3& place : {Point_3(wrong, 0, 0), Point_3(0, wrong, 0), Point_3(0, 0, wrong)}) {
      Mesh mesh = waves();
      mesh.point(*vertices(mesh).begin()) = place;
      for (const auto& make :
           {+[](Mesh& of) { Intersection_filter<Mesh>{of}; }, +[](Mesh& of) { simplify_mesh(of, {}); }})
        try {
          make(mesh);
          ADD_FAILURE() << "a mesh with " << place << " is taken";
        } catch (const Argument_error& error) {
          EXPECT_NE(std::string(error.what()).find("not finite"), std::string::npos) << error.what();
        }
    }
}

TEST(Intersection_filter, IsMadeFromNamedParameters)
{
  Mesh mesh = waves();
  const auto plain = intersection_filter(mesh);
  static_assert(std::is_same_v<decltype(plain), const Intersection_filter<Mesh>>);
  const Normal_change_filter<> base(60);
  const auto filter = intersection_filter(mesh, parameters::face_index<Clustered_AABB_tree>(50)
                                                    .filter(base)
                                                    .vertex_point_map(mesh.points())
                                                    .geom_traits(Kernel()));
  EXPECT_GT(filter.index().statistics().clusters, 10u);
  const Edge_ratio_stop stop(0.5);
  EXPECT_GT(selvedge::edge_collapse(
                mesh, stop, parameters::geometric_test(false).filter(filter).visitor(filter.visitor())),
            0);
  EXPECT_GT(base.refusals(), 0u);
  EXPECT_TRUE(is_embedded(soup_of(mesh)));
}

TEST(Intersection_filter, RefusesAVertexWithSeveralFans)
{
  // Two squares that touch at (1, 1, 0) only.
  Mesh mesh;
  const auto add_square = [&](double x, double y, const auto& first, const auto& third) {
    const auto second = mesh.add_vertex({x + 1, y, 0}), fourth = mesh.add_vertex({x, y + 1, 0});
    mesh.add_face(first, second, third);
    mesh.add_face(first, third, fourth);
  };
  const auto middle = mesh.add_vertex({1, 1, 0});
  add_square(0, 0, mesh.add_vertex({0, 0, 0}), middle);
  EXPECT_NO_THROW(Intersection_filter<Mesh>{mesh});
  add_square(1, 1, middle, mesh.add_vertex({2, 2, 0}));
  std::string message;
  try {
    Intersection_filter<Mesh>{mesh};
  } catch (const Argument_error& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("(1, 1, 0)"), std::string::npos) << message;
  CGAL::Polygon_mesh_processing::duplicate_non_manifold_vertices(mesh);
  EXPECT_NO_THROW(Intersection_filter<Mesh>{mesh});
}

TEST(Border_visitor, LocksWhatCgalsLoopMergesUnasked)
{
  // A strip whose border has an edge of length zero at (2, 0, 0).
  Mesh mesh;
  std::vector<Mesh::Vertex_index> below, above;
  for (const double x : {0.0, 1.0, 2.0, 2.0, 3.0, 4.0}) {
    below.push_back(mesh.add_vertex({x, 0, 0}));
    above.push_back(mesh.add_vertex({x + 0.25 * double(below.size()), 1, 0}));
  }
  for (std::size_t i = 0; i + 1 < below.size(); ++i) {
    mesh.add_face(below[i], below[i + 1], above[i]);
    mesh.add_face(below[i + 1], above[i + 1], above[i]);
  }
  const Border_rule<Mesh> rule(mesh);
  SMS::edge_collapse(mesh, Edge_ratio_stop(2), // at once
                     CGAL::parameters::filter(Border_filter(rule)).visitor(Border_visitor<Mesh>(rule)));
  std::size_t there = 0;
  for (const auto v : mesh.vertices())
    if (mesh.point(v) == Point_3(2, 0, 0)) {
      ++there;
      EXPECT_TRUE(rule.is_locked(v));
    } else {
      EXPECT_FALSE(rule.is_locked(v));
    }
  EXPECT_EQ(there, 1u);
}

// Policies that deduce the arguments of CGAL's profile, or name types of it.
struct Deducing_cost
{
  template <class TM, class VPM, class GT, class Point>
  internal::Optional<double> operator()(const SMS::Edge_profile<TM, VPM, GT>& profile,
                                        const internal::Optional<Point>& place) const
  {
    return place ? CGAL::squared_distance(profile.p0(), profile.p1()) : internal::Optional<double>();
  }
};
struct Deducing_placement
{
  template <class TM, class VPM, class GT>
  internal::Optional<typename SMS::Edge_profile<TM, VPM, GT>::Point>
  operator()(const SMS::Edge_profile<TM, VPM, GT>& profile) const
  {
    return CGAL::midpoint(profile.p0(), profile.p1());
  }
};
struct Placement_by_reference
{
  template <class Profile>
  internal::Optional<typename Profile::Point> operator()(const Profile& profile) const
  {
    typename Profile::Point_reference p = get(profile.vertex_point_map(), profile.v0());
    return CGAL::midpoint(p, profile.p1());
  }
};
struct Deducing_filter
{
  template <class TM, class VPM, class GT, class OptionalPoint>
  OptionalPoint operator()(const SMS::Edge_profile<TM, VPM, GT>& profile, const OptionalPoint& place) const
  {
    return profile.link().size() < 12 ? place : OptionalPoint();
  }
};
struct Deducing_stop
{
  template <class FT, class TM, class VPM, class GT, class Size>
  bool operator()(const FT&, const SMS::Edge_profile<TM, VPM, GT>&, Size initial, Size current) const
  {
    return 2 * current < initial;
  }
};

TEST(Edge_collapse, TakesPoliciesThatDeduceCgalsProfile)
{
  const auto points_after = [](const auto& placement) {
    Mesh mesh = mesh_of(skirt(2000, 1));
    const auto parameters =
        CGAL::parameters::get_cost(Deducing_cost()).get_placement(placement).filter(Deducing_filter());
    const auto edges = selvedge::edge_collapse(mesh, Deducing_stop(), parameters);
    static_assert(std::is_same_v<decltype(edges), const int>, "as CGAL's function");
    EXPECT_GT(edges, 1000);
    return soup_of(mesh).points;
  };
  EXPECT_EQ(points_after(Deducing_placement()), points_after(Placement_by_reference()));
}

TEST(Edge_collapse, KnowsEveryNamedParameterThatItIsGiven)
{
  namespace np = CGAL::internal_np;
  using Relaxed = decltype(CGAL::parameters::filter(0).use_relaxed_order(CGAL::Tag_true()));
  EXPECT_FALSE((internal::Are_tags_among<Relaxed, np::all_default_t, np::filter_t>::value));
  EXPECT_TRUE((internal::Are_tags_among<Relaxed, np::filter_t, np::use_relaxed_order_t>::value));
  using Default = CGAL::parameters::Default_named_parameters;
  EXPECT_TRUE((internal::Are_tags_among<Default, np::all_default_t, np::filter_t>::value));
}

TEST(Edge_collapse, TakesEdgesOfATileTogetherInRelaxedOrder)
{
  const auto points_after = [](const auto& is_relaxed) {
    Mesh mesh = mesh_of(skirt(20000, 1)); // four tiles
    const auto parameters = CGAL::parameters::get_cost(Deducing_cost())
                                .get_placement(Deducing_placement())
                                .use_relaxed_order(is_relaxed);
    selvedge::edge_collapse(mesh, Deducing_stop(), parameters);
    return soup_of(mesh).points;
  };
  EXPECT_EQ(points_after(true), points_after(CGAL::Tag_true()));
  EXPECT_NE(points_after(true), points_after(CGAL::Tag_false()));
}

// Remembers the highest cost at which it was asked.
struct Remembering_stop
{
  template <class FT, class TM, class VPM, class GT, class Size>
  bool operator()(const FT& cost, const SMS::Edge_profile<TM, VPM, GT>&, Size initial, Size current) const
  {
    *highest = std::max(*highest, cost);
    return 2 * current < initial;
  }
  double* highest;
};

TEST(Edge_collapse, GoesEquallyFarInAllTilesWhenItsCollapsesAreExpected)
{
  const auto points_and_cost_after = [](std::size_t expected_collapses, bool is_relaxed) {
    Mesh mesh = mesh_of(mapped(sheet(100, 100), [](const Point_3& p) { // four tiles, edges of many lengths
      return Point_3(p.x() + 0.3 * std::sin(7 * p.x() + 11 * p.y()), p.y() + 0.3 * std::sin(p.x() * p.y()),
                     0);
    }));
    double highest = 0;
    const auto parameters =
        parameters::expected_collapses(expected_collapses, CGAL::parameters::get_cost(Deducing_cost())
                                                               .get_placement(Deducing_placement())
                                                               .use_relaxed_order(is_relaxed));
    selvedge::edge_collapse(mesh, Remembering_stop{&highest}, parameters);
    return std::pair(soup_of(mesh).points, highest);
  };
  const std::size_t collapses = 5000; // of which each removes three of 30,000 edges
  const auto relaxed = points_and_cost_after(0, true), expected = points_and_cost_after(collapses, true);
  EXPECT_NE(expected.first, relaxed.first);
  EXPECT_LT(expected.second, 1.1 * relaxed.second);
  EXPECT_GT(points_and_cost_after(10 * collapses, true).second, 1.1 * relaxed.second)
      << "who expects too much makes some tiles coarser";
  EXPECT_EQ(points_and_cost_after(collapses, false), points_and_cost_after(0, false));
}

TEST(Edge_collapse, MakesNoMorePairsThanCgalsLoopDoesByDefault)
{
  const auto pairs_after = [](const auto& reduce) {
    std::size_t pairs = 0;
    for (const char* name : {"skirt", "jacket", "shorts"}) {
      Mesh mesh = mesh_of(garment(name, 3000, 1));
      reduce(mesh, Edge_ratio_stop(0.1));
      pairs += offending_pairs(soup_of(mesh)).size();
    }
    return pairs;
  };
  const std::size_t of_cgal = pairs_after([](Mesh& mesh, auto stop) { SMS::edge_collapse(mesh, stop); });
  EXPECT_EQ(pairs_after([](Mesh& mesh, auto stop) { selvedge::edge_collapse(mesh, stop); }), of_cgal);
  EXPECT_GT(pairs_after([](Mesh& mesh, auto stop) {
              selvedge::edge_collapse(mesh, stop, parameters::geometric_test(false));
            }),
            of_cgal);
}

} // namespace
} // namespace selvedge::test
