// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Where skinned meshes of glTF files stand. The document of the tests has one, `arm`, whose two joints stand
// at (10.1, 20.2, 30.3).

#include "support/Gltf_document.h"

#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

constexpr std::size_t s_vertices = side * side; // of each mesh

/// A scale and a translation.
struct Bind
{
  float scale;
  std::array<float, 3> translation;
};

std::size_t add_binds(Document& document, const std::vector<Bind>& binds)
{
  std::string bytes;
  for (const auto& [scale, translation] : binds)
    for (std::size_t i = 0; i < 16; ++i)
      put(bytes, i == 15 ? 1.f : i >= 12 ? translation[i - 12] : i % 5 == 0 ? scale : 0.f);
  return add_accessor(document, bytes, binds.size(), 5126, "MAT4");
}

void set_binds(Document& document, std::size_t skin, const std::vector<Bind>& binds)
{
  document.json["skins"][skin]["inverseBindMatrices"] = add_binds(document, binds);
}

/// Adds a node with the arm's mesh and another skin.
void add_second_arm(Document& document, const std::vector<std::size_t>& joints,
                    const std::vector<Bind>& binds)
{
  const std::size_t accessor = add_binds(document, binds);
  document.json["skins"].push_back({{"joints", joints}, {"inverseBindMatrices", accessor}});
  document.json["nodes"].push_back({{"name", "second"}, {"mesh", 1}, {"skin", 1}});
  document.json["scenes"][0]["nodes"].push_back(document.json["nodes"].size() - 1);
}

/// The points of the arm, or of the second one.
std::vector<Point_3> arm(const Document& document, std::size_t number = 0)
{
  const std::vector<Point_3> points = read_glb(document).soup.points;
  const auto first = points.begin() + std::ptrdiff_t((2 + number) * s_vertices);
  return {first, first + s_vertices};
}

/// The points of the arm as they are in the file.
std::vector<Point_3> local_arm()
{
  Document document = everything();
  document.json["nodes"][0].erase("translation");
  return arm(document);
}

template <class Function>
std::vector<Point_3> mapped(std::vector<Point_3> points, const Function& function)
{
  for (Point_3& p : points)
    p = function(p);
  return points;
}

TEST(Bind_poses, AreThoseOfTheFirstJoint)
{
  Document document = everything();
  set_binds(document, 0, {{0.5f, {-1, -2, -4}}, {1, {0, 0, 0}}});
  EXPECT_EQ(arm(document), mapped(local_arm(), [](const Point_3& p) {
              return Point_3(0.5 * p.x() + (10.1 - 1), 0.5 * p.y() + (20.2 - 2), 0.5 * p.z() + (30.3 - 4));
            }));
}

TEST(Bind_poses, AreTheIdentityButForRounding)
{
  Document document = everything();
  set_binds(document, 0, {{1.0000001f, {-10.1f, -20.2f, -30.3f}}, {3, {5, 5, 5}}});
  EXPECT_EQ(arm(document), local_arm());
  set_binds(document, 0, {{1.001f, {-10.1f, -20.2f, -30.3f}}, {3, {5, 5, 5}}});
  EXPECT_NE(arm(document), local_arm());
}

TEST(Bind_poses, AreOneForSkinsBoundAlikeHoweverTheirJointsArePosed)
{
  Document document = everything();
  set_binds(document, 0, {{1, {-10, -20, -30}}, {1, {-10.1f, -20.2f, -30.3f}}});
  document.json["nodes"][5]["rotation"] = {0.6, 0.0, 0.0, 0.8};
  add_second_arm(document, {5}, {{1, {-10.1f, -20.2f, -30.3f}}});
  EXPECT_EQ(arm(document, 1), arm(document));
  // Half as large, about the origin of the joint that both have.
  set_binds(document, 1, {{0.5f, {-10.1f, -20.2f, -30.3f}}});
  const std::vector<Point_3> first = arm(document), second = arm(document, 1), local = local_arm();
  for (std::size_t i = 0; i < local.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(first[i][axis] - second[i][axis], 0.5 * local[i][axis], 1e-5) << i;
}

TEST(Bind_poses, AreThoseOfEachSkeleton)
{
  Document document = everything();
  add_second_arm(document, {6}, {{1, {1, 2, 3}}});
  EXPECT_EQ(arm(document, 1),
            mapped(local_arm(), [](const Point_3& p) { return Point_3(p.x() + 1, p.y() + 2, p.z() + 3); }));
}

TEST(Bind_poses, AreTheIdentityWhereASkinDoesNotSayIt)
{
  const auto expect_identity = [](const char* what, const auto& change) {
    Document document = everything();
    change(document.json);
    EXPECT_EQ(arm(document), local_arm()) << what;
  };
  expect_identity("a joint of size zero", [](Json& json) { json["nodes"][4]["scale"] = {0, 0, 0}; });
  expect_identity("no skin of this number", [](Json& json) { json["nodes"][3]["skin"] = 7; });
  expect_identity("no joints", [](Json& json) { json["skins"][0].erase("joints"); });
  expect_identity("no node", [](Json& json) { json["skins"][0]["joints"] = {4, 99}; });
  expect_identity("no number", [](Json& json) { json["skins"][0]["joints"] = {"shoulder"}; });
  expect_identity("not in the scene", [](Json& json) { json["nodes"][4].erase("children"); });
  expect_identity("no matrices", [](Json& json) { json["skins"][0]["inverseBindMatrices"] = 0; });
  expect_identity("too few", [](Json& json) { json["skins"][0]["joints"] = {4, 5, 6}; });
}

} // namespace
} // namespace selvedge::test
