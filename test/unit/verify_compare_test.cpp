// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/compare.h>

#include "support/Temporary_folder.h"
#include "support/soups.h"
#include "verify/Covering.h"

#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace selvedge {
namespace {

using namespace test;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Three points as the other mesh: at the corners the distance is 0, and farthest from all is the middle of
// the longest side.
TEST(MaximumDistance, IsNotThatOfVertices)
{
  const Triangle_soup corners = soup(one_triangle().points, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
  EXPECT_EQ(distance(one_triangle(), corners).maximum, 0);
  const Bounds bounds = maximum_distance(one_triangle(), corners);
  EXPECT_LE(bounds.lower, std::sqrt(8));
  EXPECT_GE(bounds.upper, std::sqrt(8));
  EXPECT_LE(bounds.upper, 1.011 * bounds.lower);
}

TEST(MaximumDistance, HoldsForEveryPointAndIsNearlyReached)
{
  for (int seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const auto random_soup = [&](int triangles) {
      Triangle_soup result;
      for (int i = 0; i < triangles; ++i) {
        const Index first = static_cast<Index>(result.points.size());
        for (int k = 0; k < 3; ++k)
          result.points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
        // Every fourth is a segment.
        result.triangles.push_back({first, first + 1, i % 4 == 3 ? first + 1 : first + 2});
      }
      return result;
    };
    const Triangle_soup from = random_soup(6), to = random_soup(5);
    const Bounds bounds = maximum_distance(from, to);
    EXPECT_LE(bounds.upper, 1.011 * bounds.lower);
    EXPECT_GE(bounds.lower, distance(from, to).maximum);

    // Many points of the same faces, through the other function.
    constexpr Index steps = 40;
    Triangle_soup points;
    for (const auto& [a, b, c] : from.triangles)
      for (Index i = 0; i <= steps; ++i)
        for (Index j = 0; i + j <= steps; ++j) {
          points.points.push_back(CGAL::barycenter(from.points[a], double(i) / steps, from.points[b],
                                                   double(j) / steps, from.points[c],
                                                   double(steps - i - j) / steps));
          const Index last = static_cast<Index>(points.points.size() - 1);
          points.triangles.push_back({last, last, last});
        }
    const double sampled = distance(points, to).maximum;
    EXPECT_LE(sampled, bounds.upper);
    EXPECT_GE(sampled, bounds.lower - 2.0 * std::sqrt(3.0) / steps) << "the spacing of the points";
  }
}

// All vertices of the coarse mesh are at vertices of the fine one, so that every face seems worth a division,
// and each lies over eighteen others.
TEST(MaximumDistance, IsTightWhereFacesLieOverManyOthers)
{
  constexpr Index width = 90, finer = 3;
  const auto bumpy = [](const Triangle_soup& flat, double unit) {
    return mapped(flat, [unit](const Point_3& p) {
      const double x = unit * p.x(), y = unit * p.y();
      return Point_3(x, y, 0.05 * std::sin(3 * x + std::sin(5 * y)) * std::cos(4 * y));
    });
  };
  const Triangle_soup coarse = bumpy(sheet(width, width), finer),
                      fine = bumpy(sheet(finer * width, finer * width), 1);
  for (const auto& [from, to] : {std::make_pair(coarse, fine), std::make_pair(fine, coarse)}) {
    const Bounds bounds = maximum_distance(from, to);
    EXPECT_GT(bounds.lower, 0.01);
    EXPECT_LE(bounds.upper, 1.011 * bounds.lower);
  }
}

// Above the bottom of a valley, a slope is nearer than the faces that go down from this point.
TEST(MaximumDistance, IsThatOfAPointThatWasLookedAt)
{
  const Triangle_soup valley =
      mapped(sheet(6, 6), [](const Point_3& p) { return p.x() == 2 && p.y() == 2 ? Point_3(2, 2, -7) : p; });
  const Bounds bounds =
      maximum_distance(soup({{0.5, 0.5, 2}, {5.5, 0.75, 2}, {2, 4.5, 2}}, {{0, 1, 2}}), valley);
  EXPECT_GE(bounds.upper, std::sqrt(4.5)) << "at (2, 2, 2)";
  EXPECT_LE(bounds.lower, std::sqrt(4.6));
}

// Between needles and a triangle are strips, up to a hundred thousand times as long as they are wide. To cut
// off what is nearer to the one from what is nearer to the other, cuts go almost through the corners.
TEST(MaximumDistance, IsTightAlongNarrowStrips)
{
  for (const double width : {0x1p-12, 0x1p-15, 0x1p-16}) {
    const Triangle_soup triangle = soup({{3, 0, 0}, {1, 1, 0}, {1, 0, 0}}, {{0, 1, 2}}),
                        rest = soup({{3, 2 * width, 0},
                                     {1, 1 + 2 * width, 0},
                                     {1, 2 * width, 0},
                                     {3, width, 0},
                                     {1, width, 0},
                                     {3, 0, 0},
                                     {1, 0, 0}},
                                    {{0, 1, 2}, {3, 4, 4}, {5, 6, 6}});
    const Bounds bounds = maximum_distance(triangle, rest);
    EXPECT_GE(bounds.lower, 0.49 * width);
    EXPECT_LE(bounds.upper, 0.505 * width + 2.1e-6);
  }
}

// Needles a hundredth of a rounding wide, whose first side is the short one, along a ridge that rises in the
// middle: both slopes are within rounding of not being below the needle at all.
TEST(MaximumDistance, HoldsAlongNeedlesOverARidge)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    const double angle = 6.28 * share(random), turn = 0.3 + 2.5 * share(random),
                 width = std::ldexp(1.0, -60 - i % 4), top = 0.2 + 0.6 * share(random),
                 lean = share(random) / 10;
    const double x = std::cos(angle), y = std::sin(angle);
    const auto at = [&](double along, double across, double z) {
      return Point_3(along * x - across * y, along * y + across * x, z);
    };
    // The first point, at the end of the needle, is the one from which coordinates are measured.
    const Triangle_soup ridge = soup({{0, 0, 0},
                                      at(-share(random), 0, 0),
                                      at(top, 0, 1),
                                      at(1 + share(random), 0, 0),
                                      at(top - lean, 5, -3),
                                      at(top - lean, -5, -3)},
                                     {{0, 0, 0}, {1, 2, 4}, {2, 3, 4}, {2, 1, 5}, {3, 2, 5}});
    const Triangle_soup needle =
        soup({{0, 0, 0}, {width * std::cos(angle + turn), width * std::sin(angle + turn), 0}, {x, y, 0}},
             {{0, 1, 2}});
    Triangle_soup points;
    for (Index k = 0; k <= 40; ++k) {
      points.points.push_back(at(k / 40.0, 0, 0));
      points.triangles.push_back({k, k, k});
    }
    EXPECT_GE(maximum_distance(needle, ridge).upper, distance(points, ridge).maximum - 1e-12);
  }
}

// A search that covers a face with very many others ends before it has, and says how much it did.
TEST(MaximumDistance, LooksAtSoManyFacesAndNoMore)
{
  constexpr Index width = 150;
  const Triangle_soup fine = sheet(width, width);
  const internal::Surface surface(fine, 0);
  const internal::Neighbours neighbours(surface);
  internal::Covering_search search(neighbours);
  const auto is_covered = [&](double size) {
    const std::size_t before = search.looks();
    const bool covered =
        search.farthest({Point_3(0.1, 0.2, 1), Point_3(size, 0.3, 1), Point_3(0.3, size, 1)}, {0, 0, 0}, 1e9)
            .has_value();
    EXPECT_LE(search.looks() - before, 17'000u);
    return covered;
  };
  EXPECT_TRUE(is_covered(50));
  EXPECT_FALSE(is_covered(140));
  EXPECT_TRUE(is_covered(1.5));
}

TEST(MaximumDistance, IsZeroFromNothingInfiniteToNothingAndScales)
{
  EXPECT_EQ(maximum_distance({}, one_triangle()).upper, 0);
  EXPECT_EQ(maximum_distance(one_triangle(), {}).lower, infinity);
  const Bounds expected = maximum_distance(sheet(5, 3), tetrahedron());
  for (const int exponent : {-900, 900}) {
    const auto scaled = [&](const Point_3& p) {
      return Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
    };
    const Bounds bounds = maximum_distance(mapped(sheet(5, 3), scaled), mapped(tetrahedron(), scaled));
    EXPECT_EQ(bounds.lower, std::ldexp(expected.lower, exponent));
    EXPECT_EQ(bounds.upper, std::ldexp(expected.upper, exponent));
  }
}

TEST(MaximumDistance, IsOfOthersTooWhenTheseAreKnown)
{
  const Triangle_soup low = sheet(2, 2), high = sheet(2, 2, 1);
  EXPECT_EQ(maximum_distance(low, high, {5, 6}).lower, 5);
  EXPECT_EQ(maximum_distance(low, high, {5, 6}).upper, 6);
  EXPECT_EQ(maximum_distance(low, high, {0.5, 0.6}).lower, 1);
  EXPECT_GE(maximum_distance(low, high, {0.5, 2}).upper, 2);
  EXPECT_EQ(maximum_distance({}, high, {5, 6}).upper, 6);
}

// In its second further pose, the original has a hill that is not in the result, and not at a vertex of it.
TEST(Comparison, BoundsTheDistancesInAllPoses)
{
  Triangle_soup before = sheet(8, 8), after = sheet(1, 1);
  for (Point_3& p : after.points)
    p = Point_3(8 * p.x(), 8 * p.y(), 0);
  const auto hill = [](double height) {
    return mapped(
               sheet(8, 8),
               [&](const Point_3& p) { return Point_3(p.x(), p.y(), p.x() == 3 && p.y() == 4 ? height : 0); })
        .points;
  };
  before.poses = {{"low", hill(1), 0}, {"high", hill(4), 0}, {"lower", hill(2), 0}};
  for (const Pose& pose : before.poses)
    after.poses.push_back({pose.name, after.points, 0});
  const double diagonal = std::sqrt(128);
  for (const Distances_anywhere& found :
       {distances_anywhere(after, before), compare(after, before).distances}) {
    EXPECT_DOUBLE_EQ(found.original_to_result.lower, 4 / diagonal);
    EXPECT_GE(found.original_to_result.upper, 4 / diagonal);
    EXPECT_LE(found.original_to_result.upper, 4.05 / diagonal);
    EXPECT_EQ(found.original_to_result.pose, 1u);
    EXPECT_GT(found.result_to_original.lower, 0.5 / diagonal);
    EXPECT_EQ(found.result_to_original.pose, 1u);
  }
  EXPECT_EQ(compare(after, before).normals.maximum, 0) << "of the first pose alone";
  after.poses.pop_back();
  EXPECT_THROW(distances_anywhere(after, before), Argument_error);
  EXPECT_THROW(compare(after, before), Argument_error);
  after.poses = before.poses = {};
  EXPECT_LT(distances_anywhere(after, before).larger().upper, 1e-12);
  EXPECT_FALSE(distances_anywhere(after, before).original_to_result.pose);
}

// The diagonal itself is too long for a double.
TEST(Comparison, IsTheSameAtTheLargestScale)
{
  const auto largest = [](const Triangle_soup& soup) {
    return mapped(soup, [](const Point_3& p) {
      return Point_3(0x1p1021 * (p.x() - 4), 0x1p1021 * (p.y() - 4), 0x1p1021 * p.z());
    });
  };
  const auto around_zero = [](const Triangle_soup& soup) { return moved(soup, -4, -4, 0); };
  const Triangle_soup before = sheet(7, 7), after = sheet(7, 6, 1);
  const Comparison expected = compare(around_zero(after), around_zero(before)),
                   found = compare(largest(after), largest(before));
  EXPECT_EQ(found.diagonal, infinity);
  EXPECT_GT(expected.distances.larger().upper, 0.1);
  EXPECT_EQ(found.distances.larger().upper, expected.distances.larger().upper);
  EXPECT_EQ(found.borders.original_to_result.maximum.upper,
            expected.borders.original_to_result.maximum.upper);
  EXPECT_EQ(found.normals.mean, expected.normals.mean);
  EXPECT_EQ(found.layers.lines, expected.layers.lines);
  const auto at_vertices = [](const Triangle_soup& result, const Triangle_soup& original) {
    return distances(result, original).original_to_result.maximum;
  };
  EXPECT_EQ(at_vertices(largest(after), largest(before)),
            at_vertices(around_zero(after), around_zero(before)));
}

TEST(Lines, AreToldByPositions)
{
  const Triangle_soup whole = sheet(3, 4);
  const Comparison same = compare(whole, whole);
  EXPECT_EQ(same.borders.edges_of_result, 14u);
  EXPECT_EQ(same.seams.edges_of_result, 0u);
  EXPECT_EQ(same.borders.original_to_result.maximum.upper, 0);

  // The same faces without a common vertex: borders stay what they are, all other edges are seams.
  const Comparison apart = compare(unshared(whole), whole);
  EXPECT_EQ(apart.borders.edges_of_result, 14u);
  EXPECT_EQ(apart.seams.edges_of_original, 0u);
  EXPECT_EQ(apart.seams.edges_of_result, 29u); // 3 · 5 + 4 · 4 + 12 edges, without 14
  EXPECT_EQ(apart.seams.original_to_result.maximum.upper, 0);
  EXPECT_EQ(apart.seams.result_to_original.maximum.upper, infinity);
}

TEST(Lines, AreWhereTextureOrLabelsChange)
{
  // A row of six squares, of which something changes between the third and the fourth.
  const Triangle_soup row = sheet(6, 1);
  const auto seams = [](const Triangle_soup& soup) { return compare(soup, soup).seams.edges_of_result; };
  EXPECT_EQ(seams(row), 0u);

  Triangle_soup textured = row;
  for (const Point_3& p : row.points)
    textured.uvs.values.push_back({p.x(), p.y()});
  textured.uvs.of_triangle = row.triangles;
  EXPECT_EQ(seams(textured), 0u);
  const Index vertices = static_cast<Index>(row.points.size());
  for (Index v = 0; v < vertices; ++v)
    textured.uvs.values.push_back({row.points[v].x() + 9, row.points[v].y()});
  for (std::size_t i = 6; i < 12; ++i)
    for (Index& number : textured.uvs.of_triangle[i])
      number += vertices;
  EXPECT_EQ(seams(textured), 1u);
  // Values count, not numbers.
  std::copy_n(textured.uvs.values.begin(), vertices, textured.uvs.values.begin() + vertices);
  EXPECT_EQ(seams(textured), 0u);

  for (Triangle_labels Triangle_soup::*labels :
       {&Triangle_soup::groups, &Triangle_soup::objects, &Triangle_soup::materials}) {
    Triangle_soup labelled = row;
    (labelled.*labels).names = {"a", "b"};
    (labelled.*labels).of_triangle = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
    EXPECT_EQ(seams(labelled), 1u);
  }
}

TEST(Lines, DriftIsMeasuredAnywhereOnThem)
{
  // A border of four edges, and the same with a notch 3 deep in the middle of one.
  const Triangle_soup square = soup({{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const Triangle_soup notched =
      soup({{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}, {4, 3, 0}}, {{0, 4, 3}, {4, 2, 3}, {4, 1, 2}});
  const Line_comparison borders = compare(notched, square).borders;
  const double diagonal = std::sqrt(128);
  // From the notch to the square at its tip, a vertex; from the square to the notch between two.
  EXPECT_DOUBLE_EQ(borders.result_to_original.of_ends.maximum, 3 / diagonal);
  EXPECT_DOUBLE_EQ(borders.result_to_original.maximum.lower, 3 / diagonal);
  EXPECT_EQ(borders.original_to_result.of_ends.maximum, 0);
  EXPECT_NEAR(borders.original_to_result.maximum.upper, 4 * 3 / 5.0 / diagonal, 0.02 * 3 / diagonal);
}

TEST(Gaps, AreSeamsThatOpened)
{
  const Triangle_soup left = sheet(2, 4), right = moved(sheet(3, 4), 2, 0, 0);
  const Triangle_soup sewn = joined(left, right);
  const Comparison same = compare(sewn, sewn);
  EXPECT_EQ(same.seams.edges_of_original, 4u);
  EXPECT_EQ(same.gaps.open_edges, 0u);

  const Comparison apart = compare(joined(left, moved(right, 0.125, 0, 0)), sewn);
  EXPECT_EQ(apart.gaps.open_edges, 8u);
  EXPECT_DOUBLE_EQ(apart.gaps.length, 8 / same.diagonal);
  EXPECT_DOUBLE_EQ(apart.gaps.width, 0.125 / same.diagonal);
}

TEST(Gaps, AreFoundWhereOneVertexLeft)
{
  const Triangle_soup left = sheet(2, 4);
  const Triangle_soup sewn = joined(left, moved(sheet(3, 4), 2, 0, 0));
  Triangle_soup torn = sewn;
  torn.points[2 * 3 + 2] = Point_3(1.75, 2, 0); // of the left piece, in the middle of the seam
  const Comparison found = compare(torn, sewn);
  EXPECT_EQ(found.gaps.open_edges, 4u);
  EXPECT_DOUBLE_EQ(found.gaps.width, 0.125 / found.diagonal) << "half of where it is widest";
}

TEST(Gaps, AreNoBordersThatMoved)
{
  const Triangle_soup sewn = joined(sheet(2, 4), moved(sheet(3, 4), 2, 0, 0));
  const Triangle_soup shrunk =
      mapped(sewn, [](const Point_3& p) { return p.y() == 4 ? Point_3(p.x(), 3.5, 0) : p; });
  const Comparison found = compare(shrunk, sewn);
  EXPECT_EQ(found.gaps.open_edges, 0u);
  EXPECT_DOUBLE_EQ(found.borders.result_to_original.maximum.lower, 0.5 / found.diagonal);
}

TEST(Kept, VerticesAreTheOriginalsBitForBit)
{
  const Triangle_soup original = sheet(3, 3);
  Triangle_soup result = unshared(sheet(3, 3));
  EXPECT_EQ(compare(result, original).vertices, 16u);
  EXPECT_EQ(compare(result, original).original_vertices, 16u);
  result = mapped(result, [](const Point_3& p) {
    return p.x() == 1 && p.y() == 1 ? Point_3(std::nextafter(1.0, 2.0), 1, 0) : Point_3(p.x(), p.y(), -0.0);
  });
  EXPECT_EQ(compare(result, original).vertices, 16u);
  EXPECT_EQ(compare(result, original).original_vertices, 15u);
  EXPECT_DOUBLE_EQ(compare(result, original).share_of_original_vertices(), 15 / 16.0);
}

Triangle_soup with_attributes(Triangle_soup soup)
{
  soup.uvs.of_triangle = soup.triangles;
  for (const Point_3& p : soup.points)
    soup.uvs.values.push_back({p.x() / 8, p.y() / 8});
  soup.groups.names = {"left", "right"};
  for (std::size_t i = 0; i < soup.triangles.size(); ++i)
    soup.groups.of_triangle.push_back(i % 2);
  Attribute weight;
  weight.name = "weight";
  weight.type = Attribute::Type::uint8;
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    weight.rows.push_back(static_cast<unsigned char>(i));
  soup.vertex_attributes.push_back(weight);
  return soup;
}

std::pair<std::size_t, std::size_t> kept(const Comparison& comparison, const std::string& name)
{
  for (const Kept_attribute& attribute : comparison.attributes)
    if (attribute.name == name)
      return {attribute.original, attribute.combinations};
  return {};
}

using Counts = std::pair<std::size_t, std::size_t>;

TEST(Kept, AttributesAreCountedWithTheirPositions)
{
  const Triangle_soup original = with_attributes(sheet(2, 2));
  Comparison found = compare(original, original);
  EXPECT_EQ(kept(found, "uv"), Counts(9, 9));
  EXPECT_EQ(kept(found, "weight"), Counts(9, 9));
  EXPECT_TRUE(found.lost_attributes.empty());

  // Two values exchanged: each is one of the original's, but not there.
  Triangle_soup result = original;
  std::swap(result.uvs.values[0], result.uvs.values[8]);
  std::swap(result.vertex_attributes[0].rows[3], result.vertex_attributes[0].rows[4]);
  found = compare(result, original);
  EXPECT_EQ(kept(found, "uv"), Counts(7, 9));
  EXPECT_EQ(kept(found, "weight"), Counts(7, 9));
  EXPECT_EQ(kept(found, "group").first, kept(found, "group").second);

  // Other numbers for the same.
  std::swap(result.groups.names[0], result.groups.names[1]);
  for (Index& group : result.groups.of_triangle)
    group = 1 - group;
  EXPECT_EQ(kept(compare(result, original), "group"), kept(found, "group"));

  // The same numbers in another type are not the same.
  result = original;
  result.vertex_attributes[0].type = Attribute::Type::int8;
  EXPECT_EQ(kept(compare(result, original), "weight"), Counts(0, 9));
}

// The original has nothing there to compare with.
TEST(Kept, ValuesAtNewPlacesAreCountedApart)
{
  const Triangle_soup original = with_attributes(sheet(2, 2));
  Triangle_soup result = original;
  result.points[4] = Point_3(1.25, 1, 0);
  result.uvs.values[0] = {0.5, 0.5};
  for (const Kept_attribute& attribute : compare(result, original).attributes) {
    const std::size_t wrong = attribute.combinations - attribute.original - attribute.at_new_places;
    EXPECT_EQ(attribute.at_new_places, attribute.name == "group" ? 2u : 1u) << attribute.name;
    EXPECT_EQ(wrong, attribute.name == "uv" ? 1u : 0u) << attribute.name;
  }
}

TEST(Kept, TextureCoordinatesAreComparedAsGltfStoresThem)
{
  Triangle_soup original = sheet(2, 2);
  original.uvs.of_triangle = original.triangles;
  for (std::size_t v = 0; v < original.points.size(); ++v)
    original.uvs.values.push_back({double(v) / 7, 1 / (double(v) + 3)});
  const Temporary_folder folder;
  write_mesh(folder / "a.glb", original);
  Triangle_soup result = read_mesh(folder / "a.glb").soup;
  EXPECT_EQ(kept(compare(result, original), "uv"), Counts(9, 9));
  result.uvs.values[3][1] += 1e-6;
  EXPECT_EQ(kept(compare(result, original), "uv"), Counts(8, 9));
  // Between files of other formats nothing is rounded.
  result = original;
  result.uvs.values[3][0] = float(result.uvs.values[3][0]);
  EXPECT_EQ(kept(compare(result, original), "uv"), Counts(8, 9));
}

TEST(Kept, LostAttributesAreNamed)
{
  const Triangle_soup original = with_attributes(sheet(2, 2));
  EXPECT_EQ(compare(sheet(2, 2), original).lost_attributes,
            (std::vector<std::string>{"uv", "group", "weight"}));
  EXPECT_TRUE(compare(original, sheet(2, 2)).lost_attributes.empty());
}

TEST(Normals, DeviateByTheAngleOfTheFaces)
{
  const Triangle_soup flat = sheet(8, 8);
  EXPECT_EQ(compare(flat, flat).normals.maximum, 0);
  const Triangle_soup slope = mapped(flat, [](const Point_3& p) { return Point_3(p.x(), p.y(), p.x() / 8); });
  const Normal_deviation found = compare(slope, flat).normals;
  const double angle = std::atan(1 / 8.0) * 180 / std::acos(-1);
  EXPECT_NEAR(found.mean, angle, 1e-9);
  EXPECT_NEAR(found.root_mean_square, angle, 1e-9);
  EXPECT_NEAR(found.maximum, angle, 1e-9);
  EXPECT_EQ(found.turned, 0);
}

TEST(Normals, OfFacesThatTurnedOverAreTurned)
{
  const Triangle_soup flat = sheet(4, 4);
  Triangle_soup turned = flat;
  std::swap(turned.triangles[5][0], turned.triangles[5][1]);
  const Normal_deviation found = compare(turned, flat).normals;
  EXPECT_NEAR(found.turned, 1 / 32.0, 1e-12);
  EXPECT_NEAR(found.maximum, 180, 1e-9);
}

// The result is nearer to the other side of the cloth than to its own: what counts is its own.
TEST(Normals, OfTheOtherSideOfTheClothDoNotCount)
{
  Triangle_soup inner = sheet(4, 4, -0.25);
  for (auto& [a, b, c] : inner.triangles)
    std::swap(a, b);
  const Triangle_soup cloth = joined(sheet(4, 4), inner);
  const Triangle_soup result = joined(sheet(4, 4, -0.2), moved(inner, 0, 0, -0.01));
  const Normal_deviation found = compare(result, cloth).normals;
  EXPECT_EQ(found.turned, 0);
  EXPECT_EQ(found.maximum, 0);
}

TEST(Comparison, OfNothingIsNothing)
{
  EXPECT_EQ(compare({}, {}).vertices, 0u);
  EXPECT_EQ(distances_anywhere(sheet(1, 1), {}).result_to_original.upper, infinity);
  EXPECT_EQ(distances_anywhere({}, sheet(1, 1)).original_to_result.upper, infinity);
  const Triangle_soup degenerate = soup({{1, 1, 1}, {2, 2, 2}}, {{0, 0, 0}, {0, 1, 1}});
  EXPECT_EQ(compare(degenerate, degenerate).distances.original_to_result.upper, 0);
  EXPECT_EQ(compare(degenerate, degenerate).normals.samples, 0u);
}

} // namespace
} // namespace selvedge
