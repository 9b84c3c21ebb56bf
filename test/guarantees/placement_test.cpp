// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Placement::optimal: vertices at new places keep every guarantee, and the surface is nearer to the original.

#include "support/logged_reduction.h"
#include "support/mesh_of.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include "soup/Vertex_values.h"
#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>
#include <selvedge/rounding.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace selvedge::test {
namespace {

Simplify_options optimal(Simplify_options options)
{
  options.placement = Placement::optimal;
  return options;
}

std::array<double, 3> coordinates(const Point_3& p)
{
  return {p.x(), p.y(), p.z()};
}

std::set<std::array<double, 3>> positions(const Triangle_soup& soup)
{
  std::set<std::array<double, 3>> result;
  for (const Point_3& p : soup.points)
    result.insert(coordinates(p));
  return result;
}

std::size_t new_positions(const Triangle_soup& result, const Triangle_soup& original)
{
  const auto known = positions(original);
  return std::size_t(std::count_if(result.points.begin(), result.points.end(),
                                   [&](const Point_3& p) { return known.count(coordinates(p)) == 0; }));
}

double deviation(const Reduction& reduction)
{
  return reduction.verification.distances->original_to_result.root_mean_square;
}

// Waves in both directions, with texture and normals, a colour and a number that cannot be mixed.
Triangle_soup waves(Index size)
{
  Triangle_soup soup = mapped(sheet(size, size), [&](const Point_3& p) {
    return Point_3(p.x(), p.y(), std::sin(0.4 * p.x()) + std::cos(0.3 * p.y()));
  });
  Attribute colour{"red", Attribute::Type::uint8, 1, true, {}},
      joint{"joint", Attribute::Type::uint16, 1, false, {}};
  for (const Point_3& p : soup.points) {
    soup.uvs.values.push_back({p.x() / size, p.y() / size});
    soup.normals.values.push_back({0, 0, 1});
    colour.rows.push_back(static_cast<unsigned char>(std::lround(200 * p.x() / size)));
    const auto number = std::uint16_t(joint.rows.size() / 2);
    joint.rows.push_back(static_cast<unsigned char>(number & 255));
    joint.rows.push_back(static_cast<unsigned char>(number >> 8));
  }
  soup.uvs.of_triangle = soup.normals.of_triangle = soup.triangles;
  soup.vertex_attributes = {colour, joint};
  return soup;
}

TEST(Placement, OptimalIsNearerToTheOriginalAndReachesTheTarget)
{
  for (const Triangle_soup& soup : {nested_spheres(4000, 2, 0.003), waves(40)}) {
    const Reduction ends = reduce(soup, to_ratio(0.3)), places = reduce(soup, optimal(to_ratio(0.3)));
    EXPECT_TRUE(places.simplified.report.is_reached());
    EXPECT_TRUE(places.verification.accepted());
    EXPECT_TRUE(places.verification.same_topology());
    EXPECT_LT(deviation(places), 0.95 * deviation(ends));
    EXPECT_EQ(new_positions(places.simplified.soup, soup), places.simplified.placed_vertices);
    EXPECT_GT(places.simplified.placed_vertices, 0u);
    EXPECT_EQ(ends.simplified.placed_vertices, 0u);
  }
}

// A surface that bends in one direction alone keeps its shape by triangles along it, as thin as it takes.
TEST(Placement, StraightRibsKeepTheirShape)
{
  const Triangle_soup ribs =
      mapped(sheet(60, 60), [](const Point_3& p) { return Point_3(p.x(), p.y(), std::sin(0.8 * p.x())); });
  for (const Placement placement : {Placement::vertices, Placement::optimal}) {
    Simplify_options options = to_ratio(0.05);
    options.placement = placement;
    const Reduction thin = reduce(ribs, options);
    options.min_aspect_ratio = 0.05;
    EXPECT_TRUE(thin.verification.accepted());
    EXPECT_LT(deviation(thin), 0.2 * deviation(reduce(ribs, options)));
  }
}

TEST(Placement, EveryStepIsEmbeddedAndLegalOnTheWay)
{
  for (const Collapse_loop loop : {Collapse_loop::own, Collapse_loop::cgal}) {
    std::size_t placed = 0; // few of each flat sheet, since other layers are in the way
    for (const Triangle_soup& soup : {skirt(1500, 2), sheets(1000, 3, 1e-4), nested_spheres(1000, 3, 1e-3),
                                      folded_cloth(1000, 4, 1e-4)}) {
      Simplify_options options = optimal(to_ratio(0.1));
      options.loop = loop;
      const Logged_reduction reduction = reduce_and_log(soup, options);
      placed += reduction.simplified.report.placed;
      const Replay_verdict verdict = replay_text(soup, reduction.log);
      EXPECT_TRUE(verdict.is_accepted())
          << verdict.violations.front().step << ": " << verdict.violations.front().message;
      EXPECT_TRUE(verdict.is_result_stated);
      EXPECT_TRUE(std::equal(verdict.soup.points.begin(), verdict.soup.points.end(),
                             reduction.simplified.soup.points.begin(),
                             reduction.simplified.soup.points.end()));
      EXPECT_TRUE(is_embedded(reduction.simplified.soup));
    }
    EXPECT_GT(placed, 100u);
  }
}

// The control: without the exact filter, the same layers touch, and the replay says so.
TEST(Placement, UnguardedPlacesAreRefusedByTheReplay)
{
  const Triangle_soup soup = sheets(2000, 3, 1e-4);
  const Logged_reduction reduction = reduce_and_log(soup, without_check(optimal(to_ratio(0.1))));
  const Replay_verdict verdict = replay_text(soup, reduction.log);
  ASSERT_FALSE(verdict.is_accepted());
  EXPECT_TRUE(verdict.violations.front().kind == Violation_kind::intersection ||
              verdict.violations.front().kind == Violation_kind::tunnelling)
      << verdict.violations.front().message;
}

TEST(Placement, MeshOfTheCallerIsEmbeddedAfterEveryCollapse)
{
  struct Placement_observer : No_observer
  {
    const Mesh* mesh;
    std::size_t placed = 0, violations = 0;

    void before_placement(Mesh::Halfedge_index, const Point_3&, bool)
    {
      ++placed;
      violations += !is_embedded(soup_of(*mesh));
    }
  };
  Mesh mesh = mesh_of(nested_spheres(700, 2, 1e-2));
  Placement_observer observer;
  observer.mesh = &mesh;
  const Simplify_report report = simplify_mesh(mesh, optimal(to_ratio(0.2)), {}, observer);
  EXPECT_EQ(observer.violations, 0u);
  EXPECT_EQ(observer.placed, report.placed);
  EXPECT_GT(report.placed, 10u);
  EXPECT_TRUE(report.is_reached());
}

TEST(Placement, LinesAndLockedVerticesHoldInputVertices)
{
  Triangle_soup soup = waves(30);
  soup.groups.names = {"left", "right"};
  for (const auto& [a, b, c] : soup.triangles)
    soup.groups.of_triangle.push_back(soup.points[a].x() + soup.points[b].x() + soup.points[c].x() > 45 ? 1
                                                                                                        : 0);
  const Reduction reduction = reduce(soup, optimal(to_ratio(0.1)));
  const auto known = positions(soup);
  std::map<std::array<double, 3>, std::set<Index>> groups_at;
  const Triangle_soup& result = reduction.simplified.soup;
  for (Index t = 0; t < result.triangles.size(); ++t)
    for (const Index v : result.triangles[t])
      groups_at[coordinates(result.points[v])].insert(result.groups.of_triangle[t]);
  std::size_t on_line = 0;
  for (const auto& [place, groups] : groups_at)
    if (groups.size() > 1 || place[0] == 0 || place[0] == 30 || place[1] == 0 || place[1] == 30) {
      ++on_line;
      EXPECT_EQ(known.count(place), 1u);
    }
  EXPECT_GT(on_line, 20u);
  EXPECT_GT(reduction.simplified.placed_vertices, 20u);

  Simplify_intent intent;
  intent.locked = {"left"};
  const Simplified_soup locked = simplify_soup(prepare(soup), optimal(to_ratio(0.7)), intent);
  std::set<std::array<double, 3>> left;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (const Index v : soup.triangles[t])
      if (soup.groups.of_triangle[t] == 0)
        left.insert(coordinates(soup.points[v]));
  for (Index t = 0; t < locked.soup.triangles.size(); ++t)
    for (const Index v : locked.soup.triangles[t])
      if (locked.soup.groups.of_triangle[t] == 0) {
        EXPECT_EQ(left.count(coordinates(locked.soup.points[v])), 1u);
      }
  EXPECT_GT(locked.placed_vertices, 0u);
}

// The texture and the colour of the waves are linear in x and y, so interpolated ones are those of the place,
// as far as places lie on the surface.
TEST(Placement, AttributesAreThoseOfTheSurfaceThere)
{
  const Triangle_soup soup = waves(30);
  const Reduction reduction = reduce(soup, optimal(to_ratio(0.2)));
  const Triangle_soup& result = reduction.simplified.soup;
  const auto known = positions(soup);
  std::map<std::array<double, 3>, Index> original;
  for (Index v = 0; v < soup.points.size(); ++v)
    original[coordinates(soup.points[v])] = v;
  ASSERT_EQ(result.uvs.of_triangle, result.triangles) << "one value for each vertex, as in the input";
  ASSERT_EQ(result.vertex_attributes.size(), 2u);
  std::size_t placed = 0, inexact = 0;
  for (Index v = 0; v < result.points.size(); ++v) {
    const Point_3& p = result.points[v];
    const auto& uv = result.uvs.values[v];
    const auto& normal = result.normals.values[v];
    if (const auto found = original.find(coordinates(p)); found != original.end()) {
      EXPECT_EQ(uv, soup.uvs.values[found->second]);
      EXPECT_EQ(result.vertex_attributes[0].rows[v], soup.vertex_attributes[0].rows[found->second]);
      continue;
    }
    ++placed;
    inexact += uv != std::array{p.x() / 30, p.y() / 30};
    EXPECT_NEAR(uv[0], p.x() / 30, 0.02);
    EXPECT_NEAR(uv[1], p.y() / 30, 0.02);
    EXPECT_NEAR(result.vertex_attributes[0].rows[v], 200 * p.x() / 30, 6);
    EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1, 1e-12);
    std::uint16_t number;
    std::memcpy(&number, &result.vertex_attributes[1].rows[2 * v], 2);
    ASSERT_LT(number, soup.points.size());
    const Point_3& q = soup.points[number];
    EXPECT_LT(std::hypot(p.x() - q.x(), p.y() - q.y()), 6) << "the number of a vertex nearby";
  }
  EXPECT_EQ(placed, reduction.simplified.placed_vertices);
  EXPECT_GT(placed, 50u);
  EXPECT_GT(inexact, 0u) << "interpolated, not computed from the place";
}

TEST(Placement, NoTriangleOfTheTextureTurnsOver)
{
  Triangle_soup soup = sheet(40, 40);
  for (const Point_3& p : soup.points) {
    const double x = p.x() - 20, y = p.y() - 20, angle = 3 * std::exp(-(x * x + y * y) / 60);
    soup.uvs.values.push_back(
        {(x * std::cos(angle) - y * std::sin(angle)) / 60, (x * std::sin(angle) + y * std::cos(angle)) / 60});
  }
  soup.uvs.of_triangle = soup.triangles;
  const auto turned_over = [&](bool is_checked) {
    Simplify_options options = optimal(to_ratio(0.1));
    options.check_uv_orientation = is_checked;
    options.uv_weight = 0;
    const Reduction reduction = reduce(soup, options);
    EXPECT_GT(reduction.simplified.placed_vertices, 10u);
    const Triangle_soup& result = reduction.simplified.soup;
    return std::count_if(result.uvs.of_triangle.begin(), result.uvs.of_triangle.end(),
                         [&](const Index_triple& t) {
                           const auto point = [&](std::size_t k) {
                             return Kernel::Point_2(result.uvs.values[t[k]][0], result.uvs.values[t[k]][1]);
                           };
                           return CGAL::orientation(point(0), point(1), point(2)) != CGAL::LEFT_TURN;
                         });
  };
  EXPECT_EQ(turned_over(true), 0);
  EXPECT_GT(turned_over(false), 0) << "the control";
}

TEST(Placement, PlacesAre32BitFloatsWhereTheInputIs)
{
  Prepare_options rounding;
  rounding.round_to_float32 = true;
  const Triangle_soup soup = nested_spheres(2000, 1, 0.01);
  const auto places = [&](const Prepare_options& options) {
    return simplify_soup(prepare(soup, options), optimal(to_ratio(0.2)));
  };
  const Simplified_soup rounded = places(rounding);
  EXPECT_GT(rounded.placed_vertices, 50u);
  EXPECT_TRUE(has_float32_points(rounded.soup));
  EXPECT_FALSE(has_float32_points(places({}).soup)) << "the control";
}

TEST(Placement, TakesTheSameStepsAtEverySize)
{
  const auto steps = [](const Triangle_soup& soup) {
    std::vector<Soup_collapse> collapses;
    Simplify_options options = optimal(to_ratio(0.1));
    options.on_collapse = [&](const Soup_collapse& collapse) { collapses.push_back(collapse); };
    simplify_soup(prepare(soup), options);
    return collapses;
  };
  const Triangle_soup soup = skirt(2000);
  const std::vector<Soup_collapse> once = steps(soup);
  EXPECT_TRUE(
      std::any_of(once.begin(), once.end(), [](const Soup_collapse& c) { return c.place.has_value(); }));
  for (const int exponent : {-900, -40, 3, 900}) {
    std::vector<Soup_collapse> again = steps(mapped(soup, [&](const Point_3& p) {
      return Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
    }));
    for (Soup_collapse& collapse : again)
      if (collapse.place)
        for (double& coordinate : *collapse.place)
          coordinate = std::ldexp(coordinate, -exponent);
    EXPECT_TRUE(again == once) << exponent;
  }
}

TEST(Placement, LevelsAndCellsAreWhatTheyAreWithEnds)
{
  const Triangle_soup soup = skirt(2500, 2);
  const Prepared_soup prepared = prepare(soup);
  const std::vector<double> ratios{0.5, 0.2};
  const auto same_points = [](const Triangle_soup& a, const Triangle_soup& b) {
    return a.triangles == b.triangles && a.points == b.points && a.uvs.values == b.uvs.values;
  };
  const std::vector<Simplified_soup> levels = simplify_lods(prepared, optimal({}), ratios);
  for (std::size_t i = 0; i < ratios.size(); ++i)
    EXPECT_TRUE(same_points(levels[i].soup, simplify_soup(prepared, optimal(to_ratio(ratios[i]))).soup));

  Simplify_options in_cells = optimal(to_ratio(0.2));
  in_cells.faces_per_cell = 300;
  const Logged_reduction reduction = reduce_and_log(soup, in_cells);
  EXPECT_GT(reduction.simplified.report.collapses_in_cells, 100u);
  EXPECT_GT(reduction.simplified.report.placed, 100u);
  const Replay_verdict verdict = replay_text(soup, reduction.log);
  EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
  EXPECT_TRUE(verdict.is_result_stated);
}

// Two rough pyramids without their tips, which nearly touch at the wall between two cells: neither cell sees
// the end of the other pyramid. The best places are where the tips were: the pyramids would go through each
// other.
TEST(Placement, NewPlacesStayInTheirCell)
{
  const Triangle_soup pyramid = mapped(sheet(20, 20), [](const Point_3& p) {
    const double u = p.x() / 10 - 1, v = p.y() / 10 - 1, beside = std::max(std::abs(u), std::abs(v));
    const double roughness = beside < 0.35 ? 0 : 0.05 * std::sin(5 * p.x() + 7 * p.y());
    return Point_3(-std::max(beside * beside - 0.01, 0.0) / 2 - 1e-4 - roughness, u * std::abs(u),
                   v * std::abs(v));
  });
  const auto is_beyond = [](const Point_3& p) { return p.x() > 1e-4; };
  const Triangle_soup alone = reduce(pyramid, optimal(to_ratio(0.3))).simplified.soup;
  EXPECT_TRUE(std::any_of(alone.points.begin(), alone.points.end(), is_beyond));

  const Triangle_soup half = joined(pyramid, soup({{-9, 0, 0}, {-9, 0, 1}, {-9, 1, 0}}, {{0, 1, 2}}));
  const auto turned = [](const Point_3& p) { return Point_3(-p.x(), -p.y(), p.z()); };
  // A triangle in the plane that halves the vertices: this is where the wall is.
  const Triangle_soup both =
      joined(joined(half, mapped(half, turned)), soup({{0, 2, 0}, {0, 2, 1}, {0, 3, 0}}, {{0, 1, 2}}));
  Simplify_options in_cells = optimal(to_ratio(0.1));
  in_cells.faces_per_cell = 900;
  const Logged_reduction reduction = reduce_and_log(both, in_cells);
  EXPECT_EQ(reduction.simplified.report.cells, 2u);
  EXPECT_GT(reduction.simplified.report.collapses_in_cells, 100u);
  const Replay_verdict verdict = replay_text(both, reduction.log);
  EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
}

/// Returns (gradient · x + d)².
internal::Symmetric_quadric square(const internal::Vector_of_doubles& gradient, double d)
{
  internal::Symmetric_matrix matrix;
  matrix.add_square(gradient, 1);
  return {matrix, {d * gradient[0], d * gradient[1], d * gradient[2]}, d * d};
}

TEST(Placement, QuadricIsLeastWhereItSays)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 100; ++round) {
    internal::Symmetric_quadric quadric;
    for (int i = 0; i < 4; ++i)
      quadric += square({number(random), number(random), number(random)}, number(random));
    const auto least = quadric.least_point();
    ASSERT_TRUE(least);
    const internal::Vector_of_doubles from{number(random), number(random), number(random)},
        along{number(random), number(random), number(random)};
    const auto share = quadric.least_along(from, along);
    ASSERT_TRUE(share);
    for (const double step : {-1e-2, 1e-2}) {
      for (std::size_t i = 0; i < 3; ++i) {
        internal::Vector_of_doubles beside = *least;
        beside[i] += step;
        EXPECT_LT(quadric(*least), quadric(beside));
      }
      const auto at = [&](double t) {
        return quadric({from[0] + t * along[0], from[1] + t * along[1], from[2] + t * along[2]});
      };
      EXPECT_LT(at(*share), at(*share + step));
    }
  }
  const internal::Symmetric_quadric flat = square({0, 0, 1}, 0);
  EXPECT_FALSE(flat.least_point()) << "least in a whole plane";
  EXPECT_FALSE(flat.least_point_on_plane({0, 0, 1}, 0, {0, 0, 0})) << "least in the whole plane";
  EXPECT_FALSE(flat.least_point_on_plane({0, 0, 0}, 0, {0, 0, 0})) << "no plane";
  EXPECT_FALSE(flat.least_along({0, 0, 0}, {1, 0, 0}));
}

TEST(Placement, QuadricIsLeastOnAPlaneWhereItSays)
{
  std::mt19937 random(8);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto any = [&] {
    return internal::Vector_of_doubles{number(random), number(random), number(random)};
  };
  for (int round = 0; round < 100; ++round) {
    internal::Symmetric_quadric quadric;
    for (int i = 0; i < 4; ++i)
      quadric += square(any(), number(random));
    const internal::Vector_of_doubles normal = any();
    const double product = number(random);
    const auto least = quadric.least_point_on_plane(normal, product, any());
    ASSERT_TRUE(least);
    EXPECT_NEAR(internal::dot(normal, *least), product, 1e-9);
    const internal::Vector_of_doubles in_plane = internal::cross(normal, any());
    for (const double step : {-1e-2, 1e-2}) {
      internal::Vector_of_doubles beside = *least;
      for (std::size_t i = 0; i < 3; ++i)
        beside[i] += step * in_plane[i];
      EXPECT_LT(quadric(*least), quadric(beside));
    }
  }
}

// Every inner edge of the triangle is a line, with one corner of it at each of its vertices. To merge two of
// them at their middle would remove it and leave two lines one upon the other.
TEST(Placement, NoFaceVanishesWhoseEdgesAreAllLines)
{
  Mesh mesh = mesh_of(sheet(6, 6));
  const Border_rule_options options{180, 180};
  const Triangle_soup numbered = sheet(6, 6); // the mesh has other numbers
  const auto vertex = [&](Index number) {
    return *std::find_if(mesh.vertices().begin(), mesh.vertices().end(),
                         [&](Mesh::Vertex_index v) { return mesh.point(v) == numbered.points[number]; });
  };
  const auto edge_between = [&](Index from, Index to) { return mesh.halfedge(vertex(from), vertex(to)); };
  const Index a = 2 * 7 + 2, b = a + 1, c = b + 7; // a triangle in the middle
  const auto is_allowed = [&](const std::vector<std::array<Index, 2>>& lines) {
    Border_rule<Mesh> rule(mesh, options);
    for (const auto& [from, to] : lines)
      rule.mark(mesh.edge(edge_between(from, to)));
    const auto points = get(CGAL::vertex_point, mesh);
    const Kernel traits;
    const internal::Lazy_edge_profile<Mesh, decltype(points), Kernel> profile(edge_between(a, b), mesh,
                                                                              points, traits);
    return rule.allows(internal::Collapse<std::decay_t<decltype(profile)>>(
        profile, CGAL::midpoint(profile.p0(), profile.p1())));
  };
  EXPECT_FALSE(is_allowed({{a, b}, {b, c}, {c, a}}));
  EXPECT_TRUE(is_allowed({{a - 1, a}, {a, b}, {b, b + 1}})) << "along a straight line";
}

} // namespace
} // namespace selvedge::test
