// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Instances (EXT_mesh_gpu_instancing): where they are, and when they stay instances.

#include "support/Gltf_document.h"
#include "support/Temporary_folder.h"

#include "soup/Gltf_scene.h"
#include "soup/selection.h"
#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

TEST(Gltf, InstancesArePlacedLikeChildren)
{
  const Document instanced = waves_in_places();
  Document nodes = instanced;
  Json& list = nodes.json["nodes"];
  list[0].erase("extensions");
  list[0].erase("mesh");
  list[0]["children"] = {2, 3};
  for (const double i : {0., 1.})
    list.push_back({{"mesh", 0},
                    {"translation", {3 * i, 0.25, 0.25}},
                    {"rotation", {0., 0., 19660 * i / 32767, (32767 - 6553 * i) / 32767}},
                    {"scale", {1., 1., i == 0 ? 1. : 0.25}}});
  nodes.json.erase("extensionsRequired");
  const auto sorted = [](Triangle_soup soup) {
    std::sort(soup.points.begin(), soup.points.end());
    return soup.points;
  };
  const Triangle_soup soup = read_glb(instanced).soup;
  EXPECT_EQ(sorted(soup), sorted(read_glb(nodes).soup));
  EXPECT_EQ(soup.groups.names.size(), 3u);
}

TEST(Gltf, InstancesStayInstancesWhereTheyAreShared)
{
  const Temporary_folder folder;
  const Document before = waves_in_places();
  const Triangle_soup soup = read_glb(before).soup;
  for (const Instances instances : {Instances::shared, Instances::apart}) {
    const Simplified_soup reduced = reduce(soup, 0.2, Placement::vertices, instances);
    write_mesh(folder / "a.glb", reduced.soup);
    const Document after = from_glb(contents(folder / "a.glb"));
    const Triangle_soup again = read_mesh(folder / "a.glb").soup;
    EXPECT_EQ(again.triangles.size(), reduced.soup.triangles.size());
    EXPECT_EQ(again.groups.names.size(), 3u);
    if (instances == Instances::shared) {
      EXPECT_EQ(reduced.shared_places, 3u);
      EXPECT_EQ(after.json["nodes"], before.json["nodes"]);
      EXPECT_EQ(after.json["extensionsRequired"], before.json["extensionsRequired"]);
      EXPECT_EQ(after.json["meshes"].size(), 1u);
      for (const auto& [name, accessor] :
           before.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"].items())
        EXPECT_EQ(rows_of(after, accessor), rows_of(before, accessor)) << name;
      EXPECT_LT(4 * after.bytes.size(), before.bytes.size());
    } else { // nodes stand for the instances
      EXPECT_EQ(reduced.shared_places, 0u);
      EXPECT_EQ(after.json["nodes"].size(), before.json["nodes"].size() + 2);
      EXPECT_FALSE(after.json.contains("extensionsRequired"));
      EXPECT_EQ(after.json["meshes"].size(), 3u);
    }
  }
}

// An animation hides a mesh by scaling its node to nothing, and shows it so.
TEST(Gltf, AMeshThatIsScaledToNothingStays)
{
  const Temporary_folder folder;
  for (const bool is_shared : {false, true}) {
    SCOPED_TRACE(is_shared);
    Document before = waves_in_places();
    if (!is_shared)
      before.json["meshes"].push_back(before.json["meshes"][0]);
    before.json["nodes"].push_back(
        {{"name", "hidden"}, {"mesh", is_shared ? 0 : 1}, {"scale", {0, 0, 0}}, {"translation", {1, 2, 3}}});
    before.json["scenes"][0]["nodes"].push_back(2);
    Mesh_file file = read_glb(before);
    EXPECT_EQ(file.soup.triangles.size(), read_glb(waves_in_places()).soup.triangles.size());
    EXPECT_EQ(file.notes.remarks.count(
                  "places where a mesh is scaled to nothing, neither reduced nor judged there"),
              1u);
    const Simplified_soup reduced = reduce(file.soup, 0.2, Placement::vertices, Instances::shared);
    EXPECT_EQ(reduced.shared_places, 3u);
    write_mesh(folder / "a.glb", reduced.soup);
    const Json after = from_glb(contents(folder / "a.glb")).json;
    EXPECT_EQ(after["nodes"][0], before.json["nodes"][0]) << "the others are instances as before";
    ASSERT_TRUE(after["nodes"][2].contains("mesh"));
    const Json& hidden = after["meshes"][after["nodes"][2]["mesh"].get<std::size_t>()];
    const std::size_t indices =
        after["accessors"][hidden["primitives"][0]["indices"].get<std::size_t>()]["count"];
    const std::size_t all = read_glb(waves_in_places()).soup.triangles.size();
    EXPECT_EQ(indices, is_shared ? reduced.soup.triangles.size() : all);
  }
}

// Files share accessors among meshes that differ in their material.
TEST(Gltf, MeshesWithTheSameAccessorsAreReducedAlike)
{
  const Temporary_folder folder;
  Document before = waves_in_places();
  Json& meshes = before.json["meshes"];
  before.json["materials"] = {{{"name", "wool"}}, {{"name", "silk"}}};
  meshes[0]["primitives"][0]["material"] = 0;
  Json alike = meshes[0];
  alike["primitives"][0]["material"] = 1;
  meshes.push_back(std::move(alike));
  before.json["nodes"][1]["mesh"] = 1;
  Triangle_soup soup = read_glb(before).soup;
  const Simplified_soup reduced = reduce(soup, 0.2, Placement::vertices, Instances::shared);
  EXPECT_EQ(reduced.shared_meshes, 1u);
  EXPECT_EQ(reduced.shared_places, 3u);
  write_mesh(folder / "a.glb", reduced.soup);
  const Json after = from_glb(contents(folder / "a.glb")).json;
  ASSERT_EQ(after["meshes"].size(), 2u);
  const Json &first = after["meshes"][0]["primitives"][0], &second = after["meshes"][1]["primitives"][0];
  EXPECT_EQ(first["attributes"], second["attributes"]);
  EXPECT_EQ(first["indices"], second["indices"]);
  EXPECT_EQ(second["material"], 1);
  // Where one of the two has changed, the other is still reduced once.
  std::vector<Index> kept;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    if (t + 1 != soup.triangles.size()) // of the node, which comes last
      kept.push_back(t);
  keep_triangles(soup, kept);
  const Simplified_soup changed = reduce(soup, 0.2, Placement::vertices, Instances::shared);
  EXPECT_EQ(changed.shared_meshes, 1u);
  EXPECT_EQ(changed.shared_places, 2u);
  EXPECT_EQ(changed.apart_meshes, 0u);
}

// A mesh in which two primitives have one material has no line between them.
TEST(Gltf, MeshesWithOtherBordersOfMaterialsAreNotAlike)
{
  Document document = waves_in_places();
  Json& meshes = document.json["meshes"];
  document.json["materials"] = {{{"name", "wool"}}, {{"name", "silk"}}};
  meshes[0]["primitives"].push_back(meshes[0]["primitives"][0]);
  for (const int primitive : {0, 1})
    meshes[0]["primitives"][primitive]["material"] = 0;
  Json other = meshes[0];
  other["primitives"][1]["material"] = 1;
  meshes.push_back(std::move(other));
  document.json["nodes"][1]["mesh"] = 1;
  const std::vector<Gltf_scene::Part> parts = read_glb(document).soup.scene->parts;
  EXPECT_EQ(parts.front().first_alike, 0u);
  EXPECT_EQ(parts.back().first_alike, 1u);
}

TEST(Gltf, InstancesThatDifferInOneTriangleAreTwoMeshes)
{
  const Temporary_folder folder;
  Triangle_soup soup = read_glb(waves_in_places()).soup;
  const Index in_each = Index(soup.triangles.size() / 3);
  std::vector<Index> kept;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    if (t != 0 && t != in_each + 1 && t != 2 * in_each) // as many are left in every place
      kept.push_back(t);
  keep_triangles(soup, kept);
  write_mesh(folder / "a.glb", soup);
  EXPECT_EQ(from_glb(contents(folder / "a.glb")).json["meshes"].size(), 2u);
  const Triangle_soup again = read_mesh(folder / "a.glb").soup;
  const auto points_of = [](const Triangle_soup& of) {
    std::multiset<std::array<Point_3, 3>> points;
    for (const Index_triple& t : of.triangles)
      points.insert({of.points[t[0]], of.points[t[1]], of.points[t[2]]});
    return points;
  };
  EXPECT_TRUE(points_of(again) == points_of(soup));
  EXPECT_EQ(std::set<std::string>(again.groups.names.begin(), again.groups.names.end()),
            std::set<std::string>(soup.groups.names.begin(), soup.groups.names.end()));
}

} // namespace
} // namespace selvedge::test
