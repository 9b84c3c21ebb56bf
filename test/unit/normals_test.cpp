// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Normals that are made anew for a result.

#include "soup/texture.h"
#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>
#include <selvedge/normals.h>
#include <selvedge/replay.h>
#include <selvedge/rounding.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

Triangle_soup hills()
{
  return mapped(sheet(20, 20), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), std::sin(p.x() / 4) + std::cos(p.y() / 5));
  });
}

Triangle_soup with_flat_normals(Triangle_soup soup)
{
  restore_normals(soup, Normals_treatment::flat);
  return soup;
}

// Two halves at a right angle, folded along x = 10. Every corner has a normal of its own, that of its half
// with a little noise.
Triangle_soup folded_sheet()
{
  Triangle_soup soup = mapped(
      sheet(20, 10), [](const Point_3& p) { return p.x() <= 10 ? p : Point_3(10, p.y(), p.x() - 10); });
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-4e-3, 4e-3);
  for (const Index_triple& triangle : soup.triangles) {
    const bool is_upright =
        soup.points[triangle[0]].z() + soup.points[triangle[1]].z() + soup.points[triangle[2]].z() > 0;
    const Index first = Index(soup.normals.values.size());
    for (int k = 0; k < 3; ++k)
      soup.normals.values.push_back(
          {(is_upright ? -1 : 0) + noise(random), noise(random), (is_upright ? 0 : 1) + noise(random)});
    soup.normals.of_triangle.push_back({first, first + 1, first + 2});
  }
  return soup;
}

Prepared_soup prepared(const Triangle_soup& soup, Normals_choice choice)
{
  Prepare_options options;
  options.normals = choice;
  return prepare(soup, options);
}

// Of two triangles at a sharp fold, each has the larger angle at one end of the edge.
TEST(Normals, SmoothOnesPointToTheFrontOfEveryTriangle)
{
  Triangle_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0.3, -0.05}};
  soup.triangles = {{0, 1, 2}, {1, 0, 3}};
  soup.normals = {{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, soup.triangles};
  restore_normals(soup, Normals_treatment::smooth);
  const auto upwards = [&](Index triangle, std::size_t corner) {
    return soup.normals.values[soup.normals.of_triangle[triangle][corner]][2];
  };
  for (const std::size_t corner : {0, 1, 2}) {
    EXPECT_GT(upwards(0, corner), 0.9) << corner;
    EXPECT_LT(upwards(1, corner), -0.9) << corner;
  }
  EXPECT_LT(upwards(0, 0), 1) << "the control: the mean with the other triangle, where it may be";
}

TEST(Normals, FlatOnesDoNotHoldTheMeshTogether)
{
  const Triangle_soup soup = with_flat_normals(hills());
  ASSERT_TRUE(has_flat_normals(soup));
  const Prepared_soup original = prepared(soup, Normals_choice::automatic);
  EXPECT_EQ(original.normals, Normals_treatment::flat);
  const Triangle_soup result = simplify_soup(original, to_ratio(0.3)).soup;
  EXPECT_LE(result.triangles.size(), soup.triangles.size() * 3 / 10);
  ASSERT_EQ(result.normals.of_triangle.size(), result.triangles.size());
  EXPECT_TRUE(has_flat_normals(result));
  // The control: kept, they make every edge a seam.
  const Prepared_soup kept = prepared(soup, Normals_choice::keep);
  EXPECT_EQ(kept.normals, Normals_treatment::kept);
  EXPECT_GT(simplify_soup(kept, to_ratio(0.3)).soup.triangles.size(), soup.triangles.size() / 2);
}

// Squares that are bent along their diagonals, each with one normal, as programs write them that shade flat.
TEST(Normals, AreFlatWhereEachPolygonHasOne)
{
  Triangle_soup soup = hills();
  for (Index square = 0; square < 400; ++square)
    soup.polygons.push_back({2 * square, 4, 0});
  soup = with_flat_normals(soup);
  for (Index t = 0; t < soup.triangles.size(); t += 2)
    ASSERT_EQ(soup.normals.of_triangle[t], soup.normals.of_triangle[t + 1]);
  EXPECT_TRUE(has_flat_normals(soup));
  EXPECT_LE(simplify_soup(prepared(soup, Normals_choice::automatic), to_ratio(0.3)).soup.triangles.size(),
            soup.triangles.size() * 3 / 10);
  // The control: one normal for all says nothing of faces.
  soup = mapped(soup, [](const Point_3& p) { return Point_3(p.x(), p.y(), 9 * p.z()); });
  soup.normals.values.assign(1, {0, 0, 1});
  soup.normals.of_triangle.assign(soup.triangles.size(), {0, 0, 0});
  EXPECT_FALSE(has_flat_normals(soup));
}

TEST(Normals, ThatAreNotFlatAreKeptUnlessAsked)
{
  Triangle_soup soup = hills();
  for (const Point_3& p : soup.points)
    soup.normals.values.push_back({-std::cos(p.x() / 4) / 4, std::sin(p.y() / 5) / 5, 1});
  soup.normals.of_triangle = soup.triangles;
  EXPECT_FALSE(has_flat_normals(soup));
  EXPECT_EQ(prepared(soup, Normals_choice::automatic).normals, Normals_treatment::fitted);
  const Prepared_soup original = prepared(soup, Normals_choice::mend);
  EXPECT_EQ(original.normals, Normals_treatment::mended);
  const Simplified_soup result = simplify_soup(original, to_ratio(0.3));
  EXPECT_EQ(result.mended_normals, 0u);
  for (std::size_t t = 0; t < result.soup.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Index corner = result.corners[t][k];
      EXPECT_EQ(result.soup.normals.values[result.soup.normals.of_triangle[t][k]],
                soup.normals.values[soup.normals.of_triangle[corner / 3][corner % 3]]);
    }
}

// As four decimals leave them, at each corner.
TEST(Normals, ThatAreNearlyAlikeAtAVertexAreOne)
{
  Triangle_soup soup = hills();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-2e-4, 2e-4);
  for (const Index_triple& triangle : soup.triangles) {
    const Index first = Index(soup.normals.values.size());
    for (const Index v : triangle) {
      const Point_3& p = soup.points[v];
      soup.normals.values.push_back(
          {-std::cos(p.x() / 4) / 4 + noise(random), std::sin(p.y() / 5) / 5 + noise(random), 1});
    }
    soup.normals.of_triangle.push_back({first, first + 1, first + 2});
  }
  ASSERT_FALSE(has_flat_normals(soup));
  Prepare_options options;
  options.normals = Normals_choice::mend;
  const Logged_reduction reduction = reduce_and_log(soup, to_ratio(0.2), options);
  const Simplified_soup& result = reduction.simplified;
  EXPECT_LE(result.soup.triangles.size(), soup.triangles.size() / 5);
  std::map<Index, std::set<Index>> at_vertex;
  for (std::size_t t = 0; t < result.soup.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Index corner = result.corners[t][k], normal = result.soup.normals.of_triangle[t][k];
      at_vertex[result.soup.triangles[t][k]].insert(normal);
      bool is_of_vertex = false;
      for (std::size_t i = 0; i < 3 * soup.triangles.size(); ++i)
        is_of_vertex |= soup.triangles[i / 3][i % 3] == soup.triangles[corner / 3][corner % 3] &&
                        soup.normals.values[i] == result.soup.normals.values[normal];
      EXPECT_TRUE(is_of_vertex) << "no normal of the input is changed or mixed";
    }
  for (const auto& [vertex, normals] : at_vertex)
    EXPECT_EQ(normals.size(), 1u) << "at vertex " << vertex;
  EXPECT_TRUE(replay_text(soup, reduction.log).is_accepted());
  // The controls: a judge to whom nobody says so sees vertices leave their lines, and normals that are kept
  // make every edge one.
  const std::string line = "normals joined\n";
  ASSERT_NE(reduction.log.find(line), std::string::npos);
  EXPECT_FALSE(replay_text(soup, std::string(reduction.log).erase(reduction.log.find(line), line.size()))
                   .is_accepted());
  EXPECT_GT(simplify_soup(prepared(soup, Normals_choice::keep), to_ratio(0.2)).soup.triangles.size(),
            soup.triangles.size() / 2);
}

/// Deep waves with the normals that their formula has.
Triangle_soup shaded_waves()
{
  Triangle_soup soup = mapped(sheet(60, 20), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), 2 * std::sin(p.x() / 3) + 0.3 * std::sin(p.y() / 2));
  });
  for (const Point_3& p : soup.points)
    soup.normals.values.push_back({-2 * std::cos(p.x() / 3) / 3, -0.15 * std::cos(p.y() / 2), 1});
  for (std::array<double, 3>& normal : soup.normals.values) {
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (double& x : normal)
      x /= length;
  }
  soup.normals.of_triangle = soup.triangles;
  return soup;
}

// The mean angle in degrees, over the area, between the shading of faces at their centres and that of the
// waves.
double shading_error(const Triangle_soup& soup)
{
  double sum = 0, area = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    const Point_3 centre = CGAL::centroid(soup.points[a], soup.points[b], soup.points[c]);
    Kernel::Vector_3 normal(0, 0, 0);
    for (const Index n : soup.normals.of_triangle[t]) {
      const auto& [x, y, z] = soup.normals.values[n];
      normal = normal + Kernel::Vector_3(x, y, z);
    }
    const Kernel::Vector_3 true_normal(-2 * std::cos(centre.x() / 3) / 3, -0.15 * std::cos(centre.y() / 2),
                                       1);
    const double weight = std::sqrt(CGAL::squared_area(soup.points[a], soup.points[b], soup.points[c]));
    sum += weight * CGAL::approximate_angle(normal, true_normal);
    area += weight;
  }
  return sum / area;
}

TEST(Normals, CountInTheCost)
{
  const Triangle_soup soup = shaded_waves();
  const auto error_with = [&](double weight) {
    Simplify_options options = to_ratio(0.1);
    options.normal_weight = weight;
    const Triangle_soup result = simplify_soup(prepared(soup, Normals_choice::keep), options).soup;
    EXPECT_LE(result.triangles.size(), soup.triangles.size() / 10);
    return shading_error(result);
  };
  const double without = error_with(0);
  EXPECT_LT(error_with(Simplify_options().normal_weight), 0.9 * without);
  EXPECT_LT(error_with(1), 0.8 * without);
}

// On a sphere, normals turn by a radian along one radius, whatever the size.
TEST(Normals, HaveTheRadiusOfCurvatureAsTheirUnit)
{
  for (const double radius : {1e-3, 1., 64.}) {
    Triangle_soup sphere = nested_spheres(2000, 1, 1e-3);
    sphere.normals.of_triangle = sphere.triangles;
    for (Point_3& p : sphere.points) {
      const double length = std::hypot(p.x(), p.y(), p.z());
      sphere.normals.values.push_back({p.x() / length, p.y() / length, p.z() / length});
      p = Point_3(radius * p.x() / length, radius * p.y() / length, radius * p.z() / length);
    }
    EXPECT_NEAR(normal_unit(sphere), radius, 0.02 * radius);

    // A sliver, across which the normal turns back, tells nothing of the curvature.
    const double unit = normal_unit(sphere);
    const auto [a, b, c] = sphere.triangles.front();
    const auto middle = CGAL::midpoint(sphere.points[a], sphere.points[b]);
    sphere.points.push_back(middle + 1e-4 * (sphere.points[c] - middle));
    sphere.triangles.push_back({b, a, Index(sphere.points.size() - 1)});
    sphere.normals.values.push_back(sphere.normals.values[a]);
    for (double& x : sphere.normals.values.back())
      x = -x;
    sphere.normals.of_triangle.push_back(sphere.triangles.back());
    EXPECT_EQ(normal_unit(sphere), unit);
  }
  Triangle_soup flat = sheet(3, 3);
  flat.normals.values = {{0, 0, 1}};
  flat.normals.of_triangle.assign(flat.triangles.size(), {0, 0, 0});
  EXPECT_EQ(normal_unit(flat), 0);
}

// A floor and a wall of two triangles each. A corner of the floor has moved up.
TEST(Normals, OfAFlatFaceStayOneWhenItBends)
{
  using Normal = std::array<double, 3>;
  const auto floor_and_wall = [](double height) {
    return with_flat_normals(soup({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, height}, {1, 0, -1}, {1, 1, -1}},
                                  {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}));
  };
  const Triangle_soup original = floor_and_wall(0);
  const auto normals = [&](double height, const Corner_values<3>& old) {
    Triangle_soup result = floor_and_wall(height);
    keep_flat_normals(result, {0, 1, 2, 3}, original, old);
    std::vector<Normal> of_triangle;
    for (const Index_triple& corners : result.normals.of_triangle)
      of_triangle.push_back(result.normals.values[corners[0]]);
    return of_triangle;
  };
  const Normal up{0, 0, 1}, right{1, 0, 0};
  const std::vector<Normal> bent = normals(0.1, original.normals); // by 8°
  EXPECT_EQ(bent[0], bent[1]);
  EXPECT_GT(bent[0][0], 0.03) << "the mean of both";
  EXPECT_LT(bent[0][0], 0.07);
  EXPECT_EQ(bent[2], right);
  EXPECT_EQ(bent[3], right);
  // So little that the face keeps its normal.
  EXPECT_EQ(normals(1e-3, original.normals), (std::vector<Normal>{up, up, right, right}));
  const std::vector<Normal> folded = normals(0.3, original.normals); // by 23°
  EXPECT_EQ(folded[0], up);
  EXPECT_GT(folded[1][0], 0.2);
  // The control: triangles that had normals of their own are faces of their own.
  Corner_values<3> apart = original.normals;
  apart.values[1][1] = 1e-4;
  const std::vector<Normal> facets = normals(0.1, apart);
  EXPECT_EQ(facets[0], up);
  EXPECT_GT(facets[1][0], 0.09);
}

TEST(Normals, AreMadeAnewBetweenHardEdges)
{
  const Triangle_soup soup = folded_sheet();
  const Prepared_soup original = prepared(soup, Normals_choice::recompute);
  EXPECT_EQ(original.normals, Normals_treatment::smooth);
  const Triangle_soup result = simplify_soup(original, to_ratio(0.1)).soup;
  EXPECT_LE(result.triangles.size(), soup.triangles.size() / 10);
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    const auto height = [&](int k) { return result.points[result.triangles[t][k]].z(); };
    const bool is_upright = height(0) + height(1) + height(2) > 0;
    const std::array<double, 3> expected =
        is_upright ? std::array<double, 3>{-1, 0, 0} : std::array<double, 3>{0, 0, 1};
    for (const Index value : result.normals.of_triangle[t])
      EXPECT_EQ(result.normals.values[value], expected) << "smoothed across the fold, or noisy";
  }
  EXPECT_GT(simplify_soup(prepared(soup, Normals_choice::keep), to_ratio(0.1)).soup.triangles.size(),
            soup.triangles.size() / 2);
}

TEST(Normals, AReplayFindsTheHardEdgesBetweenThoseMadeAnew)
{
  const auto log_of = [](const Triangle_soup& soup, Normals_choice choice) {
    Prepare_options options;
    options.normals = choice;
    return reduce_and_log(soup, to_ratio(0.1), options).log;
  };
  const auto with = [](std::string log, const std::string& word, const std::string& other) {
    const std::size_t at = log.find("normals " + word);
    return at == std::string::npos ? "" : log.replace(at + 8, word.size(), other);
  };
  const Triangle_soup soup = folded_sheet();
  const std::string log = log_of(soup, Normals_choice::recompute);
  EXPECT_TRUE(replay_text(soup, log).is_accepted());
  EXPECT_FALSE(replay_text(soup, with(log, "hard", "kept")).is_accepted()) << "noise makes lines, too";
  // In a plane, nothing but the hard edge holds its vertices.
  Triangle_soup plane = folded_sheet();
  plane.points = sheet(20, 10).points;
  EXPECT_TRUE(replay_text(plane, log_of(plane, Normals_choice::recompute)).is_accepted());
  const std::string ignored = with(log_of(plane, Normals_choice::drop), "ignored", "hard");
  ASSERT_NE(ignored, "");
  EXPECT_FALSE(replay_text(plane, ignored).is_accepted());
}

TEST(Normals, MadeAnewAreFloats)
{
  // GCC 12 removes a conversion to float and straight back, of two of three numbers.
  Triangle_soup soup = nested_spheres(500, 1, 1e-3);
  soup.normals.values = {{0, 0, 1}};
  soup.normals.of_triangle.assign(soup.triangles.size(), {0, 0, 0});
  const Triangle_soup result = simplify_soup(prepared(soup, Normals_choice::recompute), to_ratio(0.5)).soup;
  EXPECT_GT(result.normals.values.size(), 100u);
  for (const auto& normal : result.normals.values)
    for (const double coordinate : normal)
      EXPECT_TRUE(is_float32(coordinate)) << coordinate;
}

TEST(Normals, AreDroppedWhenAsked)
{
  const Prepared_soup original = prepared(with_flat_normals(hills()), Normals_choice::drop);
  EXPECT_EQ(original.normals, Normals_treatment::dropped);
  EXPECT_TRUE(simplify_soup(original, to_ratio(0.3)).soup.normals.empty());
  EXPECT_EQ(prepared(hills(), Normals_choice::drop).normals, Normals_treatment::none);
}

TEST(Normals, MadeAnewAreIgnoredByTheReplay)
{
  const Triangle_soup soup = with_flat_normals(hills());
  Prepare_options options;
  options.normals = Normals_choice::automatic;
  const std::string log = reduce_and_log(soup, to_ratio(0.3), options).log;
  const Replay_verdict verdict = replay_text(soup, log);
  EXPECT_TRUE(verdict.is_accepted());
  const auto says_so = [](const Not_judged& part) { return part.key == "normals"; };
  const std::vector<Not_judged> parts = not_judged(verdict);
  EXPECT_TRUE(std::any_of(parts.begin(), parts.end(), says_so));
  // The control: a judge who counts them as seams sees vertices leave their lines.
  const std::string line = "normals ignored\n";
  ASSERT_NE(log.find(line), std::string::npos);
  EXPECT_FALSE(replay_text(soup, std::string(log).erase(log.find(line), line.size())).is_accepted());
  try {
    replay_text(soup, std::string(log).replace(log.find(line), line.size(), "normals made\n"));
    ADD_FAILURE() << "accepted";
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find("after 'normals' comes 'kept', 'joined', 'ignored', "),
              std::string::npos)
        << error.what();
  }
}

} // namespace
} // namespace selvedge::test
