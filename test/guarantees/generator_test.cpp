// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/meshes.h"
#include "support/tunnel_scene.h"

#include <selvedge/Error.h>
#include <selvedge/generate.h>
#include <selvedge/verify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <ostream>
#include <set>
#include <string>

namespace selvedge {

/// How GoogleTest names the parameter.
static void PrintTo(const Scene_description& scene, std::ostream* out)
{
  *out << scene.name;
}

namespace {

using Position = std::array<double, 3>;

Position position(const Point_3& p)
{
  return {p.x(), p.y(), p.z()};
}

bool is_garment(std::string_view name)
{
  return name == "skirt" || name == "jacket" || name == "shorts";
}

std::string first_offence(const Triangle_soup& soup)
{
  const std::vector<Offending_pair> pairs = offending_pairs(soup);
  if (pairs.empty())
    return "";
  const auto piece = [&](Index triangle) {
    return std::to_string(triangle) + " of " + soup.groups.names[soup.groups.of_triangle[triangle]];
  };
  return std::to_string(pairs.size()) + " pairs, first: " + piece(pairs[0].first) + " and " +
         piece(pairs[0].second);
}

bool same_bytes(const Triangle_soup& a, const Triangle_soup& b)
{
  return a.points == b.points && a.triangles == b.triangles && a.uvs.values == b.uvs.values &&
         a.uvs.of_triangle == b.uvs.of_triangle && a.groups.of_triangle == b.groups.of_triangle &&
         a.groups.names == b.groups.names;
}

class Every_scene : public testing::TestWithParam<Scene_description>
{
protected:
  std::string_view name() const { return GetParam().name; }
};

INSTANTIATE_TEST_SUITE_P(Generator, Every_scene, testing::ValuesIn(scenes()),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(Every_scene, IsEmbeddedInEverySize)
{
#ifdef NDEBUG
  const std::vector<std::size_t> sizes{3'000, 10'000, 100'000};
#else
  const std::vector<std::size_t> sizes{3'000, 10'000};
#endif
  for (const std::size_t faces : sizes) {
    SCOPED_TRACE(faces);
    Generate_options options;
    options.faces = faces;
    EXPECT_EQ(first_offence(generate(name(), options)), "");
  }
}

TEST_P(Every_scene, IsEmbeddedForManySeedsAndLayers)
{
  for (const unsigned seed : {1u, 2u, 3u, 4u})
    for (const int layers : {1, 2, 5}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", layers " + std::to_string(layers));
      Generate_options options;
      options.faces = 6'000;
      options.layers = layers;
      options.seed = seed;
      EXPECT_EQ(first_offence(generate(name(), options)), "");
    }
}

TEST_P(Every_scene, IsEmbeddedForEveryGap)
{
  const std::vector<double> gaps = is_garment(name())   ? std::vector<double>{1e-9, 1e-6, 1e-4, 1.5e-3}
                                   : name() == "nested" ? std::vector<double>{1e-12, 1e-4, 1e-2}
                                                        : std::vector<double>{1e-15, 1e-12, 1e-4, 1e-2};
  for (const double gap : gaps)
    for (const double thickness : {0.0, 1e-9, 1e-3}) {
      SCOPED_TRACE("gap " + std::to_string(gap) + ", thickness " + std::to_string(thickness));
      Generate_options options;
      options.faces = 7'000;
      options.gap = gap;
      options.thickness = thickness;
      EXPECT_EQ(first_offence(generate(name(), options)), "");
    }
}

TEST_P(Every_scene, IsEmbeddedForEveryFold)
{
  for (const double depth : {0.0, 0.03})
    for (const int folds : {0, 3, 40, 200}) {
      SCOPED_TRACE("depth " + std::to_string(depth) + ", folds " + std::to_string(folds));
      Generate_options options;
      options.faces = 5'000;
      options.fold_depth = depth;
      options.folds = folds;
      EXPECT_EQ(first_offence(generate(name(), options)), "");
    }
}

TEST_P(Every_scene, HasAboutTheFacesAskedFor)
{
  for (const std::size_t faces : {1'000u, 3'000u, 10'000u, 100'000u, 300'000u})
    for (const int layers : {1, 3, 10}) {
      SCOPED_TRACE(std::to_string(faces) + " faces, layers " + std::to_string(layers));
      Generate_options options;
      options.faces = faces;
      options.layers = layers;
      options.gap = 5e-4;
      Triangle_soup soup;
      try {
        soup = generate(name(), options);
      } catch (const Argument_error& error) {
        EXPECT_TRUE(is_garment(name())) << error.what();
        EXPECT_LT(faces, 2'000u + 800u * static_cast<unsigned>(layers)) << error.what();
        continue;
      }
      EXPECT_NEAR(static_cast<double>(soup.triangles.size()), static_cast<double>(faces),
                  0.02 * static_cast<double>(faces));
    }
}

TEST_P(Every_scene, IsTheSameTwiceAndAnotherWithAnotherSeed)
{
  Generate_options options;
  options.faces = 5'000;
  const Triangle_soup first = generate(name(), options);
  EXPECT_TRUE(same_bytes(first, generate(name(), options)));
  if (name() == "grid" || name() == "tunnel")
    return;
  options.seed = 2;
  EXPECT_NE(first.points, generate(name(), options).points);
}

TEST_P(Every_scene, IsAWholeSoup)
{
  Generate_options options;
  options.faces = 20'000;
  const Triangle_soup soup = generate(name(), options);
  ASSERT_EQ(soup.uvs.of_triangle.size(), soup.triangles.size());
  ASSERT_EQ(soup.groups.of_triangle.size(), soup.triangles.size());
  std::vector<char> used(soup.points.size());
  for (const Index_triple& triangle : soup.triangles)
    for (const Index v : triangle) {
      ASSERT_LT(v, soup.points.size());
      used[v] = 1;
    }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
  for (const Point_3& p : soup.points)
    ASSERT_TRUE(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()));
  const std::set<std::string> names(soup.groups.names.begin(), soup.groups.names.end());
  EXPECT_EQ(names.size(), soup.groups.names.size());
  const std::set<Index> groups(soup.groups.of_triangle.begin(), soup.groups.of_triangle.end());
  EXPECT_EQ(groups.size(), names.size());
}

TEST_P(Every_scene, IsPositivelyOrientedInTheTexture)
{
  using Point_2 = Kernel::Point_2;
  Generate_options options;
  options.faces = 20'000;
  const Triangle_soup soup = generate(name(), options);
  for (const auto& [u, v] : soup.uvs.values)
    ASSERT_TRUE(u >= 0 && u <= 1 && v >= 0 && v <= 1) << u << " " << v;
  for (std::size_t k = 0; k < soup.uvs.of_triangle.size(); ++k) {
    const auto point = [&](int corner) {
      const auto& [u, v] = soup.uvs.values[soup.uvs.of_triangle[k][corner]];
      return Point_2(u, v);
    };
    ASSERT_EQ(CGAL::orientation(point(0), point(1), point(2)), CGAL::COUNTERCLOCKWISE)
        << "triangle " << k << " of " << soup.groups.names[soup.groups.of_triangle[k]];
  }
}

// Every directed edge of a piece is there once: consistently oriented, no edge with three sides.
TEST_P(Every_scene, IsMadeOfOrientedManifoldPieces)
{
  Generate_options options;
  options.faces = 10'000;
  const Triangle_soup soup = generate(name(), options);
  std::set<std::pair<Index, Index>> edges;
  for (const Index_triple& t : soup.triangles)
    for (int k = 0; k < 3; ++k)
      EXPECT_TRUE(edges.emplace(t[k], t[(k + 1) % 3]).second);
}

TEST(Generator, PiecesMeetAtTheSamePositions)
{
  for (const Scene_description& scene : scenes()) {
    if (!is_garment(scene.name) && scene.name != "seams")
      continue;
    SCOPED_TRACE(scene.name);
    Generate_options options;
    options.faces = 10'000;
    const Triangle_soup soup = generate(scene.name, options);
    std::map<Position, std::set<Index>> groups_at;
    for (std::size_t k = 0; k < soup.triangles.size(); ++k)
      for (const Index v : soup.triangles[k])
        groups_at[position(soup.points[v])].insert(soup.groups.of_triangle[k]);
    std::size_t seams = 0;
    std::size_t junctions = 0;
    for (const auto& [place, groups] : groups_at) {
      seams += groups.size() >= 2;
      junctions += groups.size() >= 3;
    }
    EXPECT_GT(seams, 50u);
    EXPECT_GT(junctions, 0u);
    EXPECT_LT(groups_at.size(), soup.points.size()) << "pieces have vertices of their own";
  }
}

// Shared positions must be the only contacts, so a judge that sees a thousandth of a gap must find many:
// moving one layer by a gap is the negative control of all tests above.
TEST(Generator, LayersAreAsCloseAsAsked)
{
  Generate_options options;
  options.faces = 10'000;
  options.gap = 1e-6;
  options.thickness = 0;
  for (const char* const name : {"skirt", "sheets", "nested"}) {
    SCOPED_TRACE(name);
    Triangle_soup soup = generate(name, options);
    std::vector<char> moved(soup.points.size());
    const std::string layer = soup.groups.names[soup.groups.of_triangle.front()] == "sheet_0" ? "sheet_0"
                              : name == std::string("nested")                                 ? "sphere_0"
                                                              : "lining_front";
    for (std::size_t k = 0; k < soup.triangles.size(); ++k)
      if (soup.groups.names[soup.groups.of_triangle[k]] == layer)
        for (const Index v : soup.triangles[k])
          moved[v] = 1;
    for (std::size_t v = 0; v < moved.size(); ++v)
      if (moved[v]) {
        const Point_3& p = soup.points[v];
        soup.points[v] = Point_3(p.x() + 3e-6, p.y(), p.z() + 1.5e-6);
      }
    EXPECT_GT(offending_pairs(soup).size(), 50u);
  }
}

TEST(Generator, NamesWhatItKnowsWhenItDoesNotKnow)
{
  try {
    generate("trousers");
    FAIL() << "must be refused";
  } catch (const Argument_error& error) {
    for (const Scene_description& scene : scenes())
      EXPECT_NE(std::string(error.what()).find(scene.name), std::string::npos) << scene.name;
  }
}

TEST(Generator, RefusesWhatIsOutOfRange)
{
  const auto refused = [](auto change, std::string_view name = "skirt") {
    Generate_options options;
    change(options);
    EXPECT_THROW(generate(name, options), Argument_error);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](auto& o) { o.faces = 0; });
  refused([](auto& o) { o.faces = 99; }, "grid");
  refused([](auto& o) { o.faces = 20'000'001; });
  refused([](auto& o) { o.layers = 0; });
  refused([](auto& o) { o.layers = -3; });
  refused([](auto& o) { o.layers = 101; }, "sheets");
  refused([](auto& o) { o.layers = 30; });
  refused([](auto& o) { o.layers = 5, o.faces = 1'000; });
  refused([](auto& o) { o.layers = 100, o.faces = 1'000; }, "sheets");
  refused([](auto& o) { o.thickness = -1e-3; });
  refused([](auto& o) { o.thickness = 1e-10; });
  refused([](auto& o) { o.thickness = 0.011; });
  refused([=](auto& o) { o.thickness = nan; });
  refused([](auto& o) { o.gap = 0; });
  refused([](auto& o) { o.gap = 1e-10; });
  refused([](auto& o) { o.gap = 1e-16; }, "sheets");
  refused([](auto& o) { o.gap = 1e-13; }, "nested");
  refused([](auto& o) { o.gap = 0.02; });
  refused([=](auto& o) { o.gap = nan; });
  refused([](auto& o) { o.fold_depth = -0.01; });
  refused([](auto& o) { o.fold_depth = 0.04; });
  refused([=](auto& o) { o.fold_depth = nan; });
  refused([](auto& o) { o.folds = -1; });
  refused([](auto& o) { o.folds = 201; });
}

TEST(Generator, MakesSheetsExactlyOneGapApart)
{
  Generate_options options;
  options.faces = 2'000;
  options.layers = 2;
  options.gap = 0x1p-48;
  const Triangle_soup soup = generate("sheets", options);
  const std::size_t half = soup.points.size() / 2;
  for (std::size_t v = 0; v < half; ++v)
    ASSERT_EQ(soup.points[half + v].z() - soup.points[v].z(), options.gap);
}

TEST(Generator, NeedlesAreNeedles)
{
  Generate_options options;
  options.faces = 2'000;
  const Triangle_soup soup = generate("needles", options);
  for (const Index_triple& t : soup.triangles) {
    const Kernel::Triangle_3 triangle(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, CGAL::squared_distance(triangle[k], triangle[k + 1]));
    EXPECT_LT(2 * std::sqrt(triangle.squared_area()) / longest, 1e-5);
  }
}

// The tunnelling scene, with exact predicates.

Triangle_soup collapse(const Triangle_soup& soup, Index moving, Index target)
{
  Triangle_soup result;
  result.points = soup.points;
  for (std::size_t k = 0; k < soup.triangles.size(); ++k) {
    Index_triple t = soup.triangles[k];
    std::replace(t.begin(), t.end(), moving, target);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      continue;
    result.triangles.push_back(t);
    result.groups.of_triangle.push_back(soup.groups.of_triangle[k]);
  }
  result.groups.names = soup.groups.names;
  return result;
}

CGAL::Orientation turn(const Triangle_soup& soup, Index a, Index b, Index c)
{
  const auto from_above = [&](Index v) { return Kernel::Point_2(soup.points[v].x(), soup.points[v].y()); };
  return CGAL::orientation(from_above(a), from_above(b), from_above(c));
}

/// Sign of the patch's height over the sheet: 1 above, −1 below, 0 when neither all above nor all below.
int side_of_patch(const Triangle_soup& soup)
{
  int side = 2;
  for (std::size_t k = 0; k < soup.triangles.size(); ++k) {
    if (soup.groups.names[soup.groups.of_triangle[k]] != "patch_0")
      continue;
    for (const Index v : soup.triangles[k]) {
      bool covered = false;
      for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
        if (soup.groups.of_triangle[f] == soup.groups.of_triangle[k])
          continue;
        const Index_triple& t = soup.triangles[f];
        // Whether p is above or below the face: it is not on different sides of its edges, seen from above.
        const auto [least, most] =
            std::minmax({turn(soup, t[0], t[1], v), turn(soup, t[1], t[2], v), turn(soup, t[2], t[0], v)});
        if (least == CGAL::RIGHT_TURN && most == CGAL::LEFT_TURN)
          continue;
        covered = true;
        // Counter-clockwise from above, so positive is above.
        const auto [a, b, c] = t;
        const int here = CGAL::orientation(soup.points[a], soup.points[b], soup.points[c], soup.points[v]);
        side = side == 2 || side == here ? here : 0;
      }
      if (!covered)
        return 0;
    }
  }
  return side;
}

TEST(Tunnel, IsEmbeddedBeforeAndAfterWithThePatchOnTheOtherSide)
{
  const test::Tunnel_scene scene = test::tunnel_scene();
  const Triangle_soup after = collapse(scene.soup, scene.moving, scene.target);
  EXPECT_EQ(after.triangles.size(), scene.soup.triangles.size() - 2);
  EXPECT_EQ(first_offence(scene.soup), "");
  EXPECT_EQ(first_offence(after), "");
  EXPECT_EQ(side_of_patch(scene.soup), -1);
  EXPECT_EQ(side_of_patch(after), 1);
}

TEST(Tunnel, PassesThroughThePatchOnTheWay)
{
  const test::Tunnel_scene scene = test::tunnel_scene();
  const Point_3 from = scene.soup.points[scene.moving];
  const Point_3 to = scene.soup.points[scene.target];
  int offending = 0;
  for (int step = 1; step < 16; ++step) {
    // Sixteenths of small whole coordinates are exact in doubles.
    Triangle_soup soup = scene.soup;
    soup.points[scene.moving] = from + (to - from) * (step / 16.0);
    offending += !is_embedded(soup);
  }
  EXPECT_GT(offending, 0);
  EXPECT_LT(offending, 15) << "near both ends nothing touches";
}

TEST(Tunnel, NothingElseSpeaksAgainstTheCollapse)
{
  const test::Tunnel_scene scene = test::tunnel_scene();
  const Triangle_soup& soup = scene.soup;
  const auto aspect = [&](const Index_triple& t) {
    const Kernel::Triangle_3 triangle(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, CGAL::squared_distance(triangle[k], triangle[k + 1]));
    // Shortest height to longest edge, the strictest of the usual measures.
    return 2 * std::sqrt(triangle.squared_area()) / longest;
  };
  const auto normal = [&](const Index_triple& t) {
    return CGAL::unit_normal(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
  };
  std::map<std::pair<Index, Index>, int> edges;
  std::set<Index> around_moving, around_target;
  std::size_t contracted = 0;
  for (Index_triple t : soup.triangles) {
    for (int k = 0; k < 3; ++k) {
      ++edges[std::minmax(t[k], t[(k + 1) % 3])];
      for (const Index other : t) {
        if (t[k] == scene.moving)
          around_moving.insert(other);
        if (t[k] == scene.target)
          around_target.insert(other);
      }
    }
    const bool has_moving = std::count(t.begin(), t.end(), scene.moving) > 0;
    const bool has_target = std::count(t.begin(), t.end(), scene.target) > 0;
    contracted += has_moving && has_target;
    if (!has_moving || has_target)
      continue;
    const Kernel::Vector_3 before = normal(t);
    std::replace(t.begin(), t.end(), scene.moving, scene.target);
    EXPECT_GE(aspect(t), 0.2);
    EXPECT_GT(before * normal(t), std::cos(17 * CGAL_PI / 180));
  }
  EXPECT_EQ(contracted, 2u);
  // The link condition: the common neighbours are the third vertices of the two contracted faces.
  std::vector<Index> common;
  std::set_intersection(around_moving.begin(), around_moving.end(), around_target.begin(),
                        around_target.end(), std::back_inserter(common));
  EXPECT_EQ(common.size(), 4u) << "the two themselves, and two more";
  for (const auto& [edge, faces] : edges)
    EXPECT_TRUE(faces == 2 || (edge.first != scene.moving && edge.second != scene.moving))
        << "the moving vertex is on no border";
}

TEST(Tunnel, TheSceneHasTheFacesAndGroupsOfAHundredBumps)
{
  Generate_options options;
  options.faces = 700;
  const Triangle_soup soup = generate("tunnel", options);
  EXPECT_EQ(soup.triangles.size(), 700u);
  EXPECT_EQ(soup.groups.names.size(), 200u);
}

// What the other tests build on.

TEST(Meshes, MoebiusBandHasNoOrientation)
{
  const Triangle_soup soup = test::moebius_band();
  EXPECT_TRUE(is_embedded(soup));
  std::set<std::pair<Index, Index>> edges;
  std::size_t same_direction = 0;
  for (const Index_triple& t : soup.triangles)
    for (int k = 0; k < 3; ++k)
      same_direction += !edges.emplace(t[k], t[(k + 1) % 3]).second;
  EXPECT_EQ(same_direction, 1u);
}

TEST(Meshes, FanOfThreeIsEmbedded)
{
  EXPECT_TRUE(is_embedded(test::fan_of_three()));
}

} // namespace
} // namespace selvedge
