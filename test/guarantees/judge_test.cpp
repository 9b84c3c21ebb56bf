// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Error.h>
#include <selvedge/compare.h>
#include <selvedge/mesh_files.h>
#include <selvedge/rounding.h>
#include <selvedge/verify.h>

#include "support/soups.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <ostream>

namespace selvedge {
namespace {

using namespace test;

TEST(Judge, AcceptsAMeshIfAndOnlyIfItIsEmbedded)
{
  const Verification found = verify(joined(sheet(9, 7), tetrahedron()));
  EXPECT_FALSE(found.embedded()); // the tetrahedron stands on the sheet
  EXPECT_EQ(found.new_pairs.size(), found.pairs.size());
  EXPECT_FALSE(found.accepted());

  const Verification apart = verify(joined(sheet(9, 7, -1), tetrahedron()));
  EXPECT_TRUE(apart.embedded());
  EXPECT_TRUE(apart.accepted());
  EXPECT_EQ(apart.pieces.size(), 2u);
  EXPECT_FALSE(apart.distances.has_value());
}

TEST(Judge, AcceptsAResultWhoseDefectsAreThoseOfItsOriginal)
{
  const Triangle_soup original = joined(crossing(), sheet(4, 4, 20));
  const auto four_times = [](const Point_3& p) { return Point_3(4 * p.x(), 4 * p.y(), p.z()); };
  const Triangle_soup result = joined(crossing(), mapped(sheet(1, 1, 20), four_times));
  const Verification found = verify(result, original);
  EXPECT_FALSE(found.embedded());
  EXPECT_TRUE(found.new_pairs.empty());
  EXPECT_TRUE(found.same_topology());
  EXPECT_TRUE(found.accepted());
  ASSERT_TRUE(found.distances.has_value());
  EXPECT_EQ(found.distances->result_to_original.maximum, 0);
  EXPECT_EQ(found.distances->original_to_result.maximum, 0);
}

// Offending pairs are known by positions, which rounding moves.
TEST(Judge, AcceptsTheDefectsOfAnOriginalThatWasRoundedForTheResult)
{
  const auto odd = [](const Point_3& p) { return Point_3(p.x() / 3, p.y() / 7, p.z() + 0.1); };
  const Triangle_soup original = mapped(joined(crossing(), sheet(4, 4, 20)), odd);
  Triangle_soup result = original;
  round_to_float32(result);
  const Verification found = verify(result, original);
  EXPECT_TRUE(found.is_original_rounded);
  EXPECT_EQ(found.pairs.size(), 1u);
  EXPECT_TRUE(found.accepted());
  EXPECT_EQ(verify(result, original, offending_pairs(original)).new_pairs.size(), 1u) << "the control";
  EXPECT_FALSE(verify(original, original).is_original_rounded);
  EXPECT_FALSE(verify(result, result).is_original_rounded);
}

TEST(Judge, CountsWhatTouchesAnObstacleAndNotTheObstacleItself)
{
  const Triangle_soup mesh = joined(sheet(3, 3, 2), sheet(3, 3, -2)),
                      obstacle = joined(crossing(), tetrahedron());
  EXPECT_FALSE(verify(obstacle).embedded());
  EXPECT_TRUE(verify(mesh, {}, obstacle).embedded());
  const Triangle_soup low = joined(sheet(3, 3, 2), sheet(3, 3, 0.25));
  const Verification found = verify(low, {}, obstacle);
  EXPECT_FALSE(found.embedded());
  for (const Offending_pair& pair : found.pairs) {
    EXPECT_LT(pair.first, low.triangles.size());
    EXPECT_GE(pair.second, low.triangles.size());
  }
  EXPECT_EQ(verify(low, mesh, {}, obstacle).new_pairs.size(), found.pairs.size());
  EXPECT_TRUE(verify(low, low, {}, obstacle).accepted());
  EXPECT_EQ(verify(low, low, {}, obstacle).pairs.size(), found.pairs.size());
  Verify_options near;
  near.clearance = 0.5;
  EXPECT_TRUE(verify(mesh, near, obstacle).is_clearance_kept());
  near.clearance = 2.5; // to the sheet below
  EXPECT_FALSE(verify(mesh, near, obstacle).is_clearance_kept());
  EXPECT_TRUE(verify(mesh, mesh, near, obstacle).is_clearance_kept());
  Triangle_soup moving = mesh;
  moving.poses = {{"down", low.points}};
  const Verification in_poses = verify(moving, {}, obstacle);
  EXPECT_TRUE(in_poses.pairs.empty());
  EXPECT_EQ(in_poses.poses[0].pairs.size(), found.pairs.size());
  Triangle_soup twice = obstacle;
  twice.poses = {{"a", obstacle.points}, {"b", obstacle.points}};
  EXPECT_THROW(verify(moving, {}, twice), Argument_error);
}

TEST(Judge, RefusesSoupsThatAreNoMeshes)
{
  using Limits = std::numeric_limits<double>;
  const Triangle_soup mesh = sheet(3, 3);
  std::vector<Triangle_soup> wrong;
  for (const double number : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()})
    for (const Point_3& point : {Point_3(number, 0, 0), Point_3(0, number, 0), Point_3(0, 0, number)}) {
      wrong.push_back(mesh);
      wrong.back().points[5] = point;
      wrong.push_back(mesh);
      wrong.back().poses = {{"a", wrong[wrong.size() - 2].points}};
    }
  wrong.push_back(mesh);
  wrong.back().triangles[4][1] = Index(mesh.points.size());
  for (const Triangle_soup& soup : wrong) {
    EXPECT_THROW(offending_pairs(soup), Argument_error);
    EXPECT_THROW(is_embedded(soup), Argument_error);
    EXPECT_THROW(pieces(soup), Argument_error);
    EXPECT_THROW(verify(soup), Argument_error);
    EXPECT_THROW(verify(soup, mesh), Argument_error);
    EXPECT_THROW(verify(mesh, soup), Argument_error);
    EXPECT_THROW(verify(mesh, {}, soup), Argument_error);
    EXPECT_THROW(compare(soup, mesh), Argument_error);
  }
  Verify_options options;
  options.triangles_of_original = {0, 1};
  EXPECT_THROW(verify(mesh, mesh, options), Argument_error);
  options.triangles_of_original.assign(mesh.triangles.size(), Index(mesh.triangles.size()));
  EXPECT_THROW(verify(mesh, mesh, options), Argument_error);
  options = {};
  options.triangles_in_file = {{0, 1, 5}};
  EXPECT_THROW(verify(mesh, mesh, options), Argument_error);
  options.triangles_in_file = mesh.triangles;
  EXPECT_NO_THROW(verify(mesh, mesh, options));
  for (const Index vertex : {Index(0), Index(mesh.points.size())}) {
    options.triangles_in_file[4][1] = vertex;
    EXPECT_THROW(verify(mesh, mesh, options), Argument_error);
  }
}

TEST(Judge, RefusesANewPair)
{
  const Triangle_soup original = joined(crossing(), sheet(4, 4, 20));
  const Triangle_soup result = joined(crossing(), sheet(4, 4, 0.5));
  const Verification found = verify(result, original, offending_pairs(original));
  EXPECT_EQ(found.pairs.size(), found.new_pairs.size() + 1);
  EXPECT_FALSE(found.new_pairs.empty());
  EXPECT_TRUE(found.same_topology());
  EXPECT_FALSE(found.accepted());
}

// As many pieces of every kind, each with vertices of the original's alone: one of them is a part of what it
// was.
TEST(Judge, RefusesAPieceThatIsAPartOfWhatItWas)
{
  const Triangle_soup original = joined(sheet(4, 4), sheet(4, 4, 20));
  const Verification found = verify(joined(sheet(4, 4), sheet(1, 1, 20)), original);
  EXPECT_TRUE(found.embedded());
  EXPECT_TRUE(found.same_topology());
  EXPECT_FALSE(found.accepted());
  ASSERT_EQ(found.matching.mismatches.size(), 1u);
  EXPECT_EQ(found.matching.mismatches[0].what, Mismatch::far);
}

TEST(Judge, RefusesAnotherTopology)
{
  const Verification found = verify(sheet(4, 4), joined(sheet(4, 4), sheet(4, 4, 1)));
  EXPECT_TRUE(found.embedded());
  ASSERT_EQ(found.topology_differences.size(), 1u);
  EXPECT_EQ(found.topology_differences[0].pieces_of_original, 2u);
  EXPECT_EQ(found.topology_differences[0].pieces_of_result, 1u);
  EXPECT_FALSE(found.accepted());
}

/// A real mesh, and what was measured of it elsewhere.
struct Known_mesh
{
  const char* path;
  std::size_t faces, pieces, border_edges, intersecting_pairs;
};

void PrintTo(const Known_mesh& mesh, std::ostream* stream)
{
  *stream << mesh.path;
}

class Judge_of_real_meshes : public testing::TestWithParam<Known_mesh>
{
};

TEST_P(Judge_of_real_meshes, FindsWhatIsKnownOfThem)
{
  const std::filesystem::path path = std::filesystem::path(SELVEDGE_SHARED_DATA) / GetParam().path;
  if (!std::filesystem::exists(path))
    GTEST_SKIP() << "no folder of real meshes beside the checkout: " << path;
  const Triangle_soup soup = read_mesh(path).soup;
  ASSERT_EQ(soup.triangles.size(), GetParam().faces);

  const std::vector<Offending_pair> pairs = offending_pairs(soup);
  EXPECT_EQ(pairs.size(), GetParam().intersecting_pairs);
  EXPECT_EQ(is_embedded(soup), pairs.empty());
  for (const Offending_pair& pair : pairs)
    EXPECT_EQ(pair.offence, Offence::intersection);

  const std::vector<Piece> all = pieces(soup);
  EXPECT_EQ(all.size(), GetParam().pieces);
  std::size_t border_edges = 0;
  for (const Piece& piece : all)
    border_edges += piece.border_edges;
  EXPECT_EQ(border_edges, GetParam().border_edges);
}

INSTANTIATE_TEST_SUITE_P(, Judge_of_real_meshes,
                         testing::Values(Known_mesh{"garments/dress_14_pieces_uv.obj", 29456, 14, 1828, 0},
                                         Known_mesh{"garments/multilayer_skirt.obj", 58687, 10, 2221, 0},
                                         Known_mesh{"garments/multilayer_skirt_as_found.obj", 84159, 18, 2345,
                                                    1131},
                                         Known_mesh{"garments/avatar_in_suit_uv.obj", 40999, 6, 1167, 0},
                                         Known_mesh{"scans/stanford_bunny.obj", 69451, 1, 223, 0},
                                         Known_mesh{"scans/spot.obj", 23062, 1, 0, 0}));

} // namespace
} // namespace selvedge
