// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The poses that a glTF file makes of its meshes: morph targets, animations of nodes, skins.

#include "support/Temporary_folder.h"

#include "soup/selection.h"

#include <selvedge/Error.h>
#include <selvedge/gltf_poses.h>
#include <selvedge/internal/base64.h>
#include <selvedge/mesh_files.h>
#include <selvedge/prepare.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

/// A glTF file with one triangle in the xy plane, at a node of its own.
class Posed_file
{
public:
  using Json = nlohmann::ordered_json;

  Posed_file()
  {
    const std::size_t points = rows<float>({0, 0, 0, 1, 0, 0, 0, 2, 0}, "VEC3");
    json["asset"] = {{"version", "2.0"}};
    json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", points}}}}}}}};
    json["nodes"] = {{{"mesh", 0}}};
    json["scenes"] = {{{"nodes", {0}}}};
  }

  template <class Number>
  std::size_t view(const std::vector<Number>& numbers)
  {
    m_bytes.resize((m_bytes.size() + 3) / 4 * 4);
    const std::size_t begin = m_bytes.size(), size = numbers.size() * sizeof(Number);
    m_bytes.append(reinterpret_cast<const char*>(numbers.data()), size);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", size}});
    return json["bufferViews"].size() - 1;
  }

  /// Adds an accessor; bytes are fractions.
  template <class Number>
  std::size_t rows(const std::vector<Number>& numbers, const std::string& type, bool is_normalized = false)
  {
    const std::size_t components = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : std::size_t(type[3] - '0');
    const Json accessor = {{"bufferView", view(numbers)},
                           {"componentType", sizeof(Number) == 4 ? 5126 : 5121},
                           {"normalized", is_normalized},
                           {"count", numbers.size() / components},
                           {"type", type}};
    json["accessors"].push_back(accessor);
    return json["accessors"].size() - 1;
  }

  void animate(const std::string& name, std::size_t node, const std::string& path,
               const std::string& interpolation, const std::vector<float>& times,
               const std::vector<float>& values)
  {
    Json& animations = json["animations"];
    if (animations.empty() || animations.back()["name"] != name)
      animations.push_back({{"name", name}, {"samplers", Json::array()}, {"channels", Json::array()}});
    Json& animation = animations.back();
    const char* const type = path == "rotation" ? "VEC4" : path == "weights" ? "SCALAR" : "VEC3";
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
    animation["samplers"].push_back(
        {{"input", rows(times, "SCALAR")}, {"output", rows(values, type)}, {"interpolation", interpolation}});
  }

  Triangle_soup soup() const
  {
    Json document = json;
    document["buffers"] = {{{"byteLength", m_bytes.size()},
                            {"uri", "data:application/octet-stream;base64," + internal::base64(m_bytes)}}};
    return read_mesh(document.dump(), Mesh_format::gltf, "posed.gltf").soup;
  }

  std::vector<Pose> poses(const std::string& animation = "all", std::size_t every = 1) const
  {
    return animation_poses(soup(), animation, every, "posed.gltf");
  }

  Json json;

private:
  std::string m_bytes;
};

void expect_near(const Point_3& found, const Point_3& expected)
{
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(found[axis], expected[axis], 1e-6) << axis; // the file's numbers are 32-bit floats
}

/// Two joints, at the origin and at (1, 0, 0), that share the second and the third vertex.
Posed_file skinned_file()
{
  Posed_file file;
  auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = file.rows<std::uint8_t>({0, 1, 9, 9, 0, 1, 9, 9, 1, 0, 9, 9}, "VEC4");
  attributes["WEIGHTS_0"] =
      file.rows<std::uint8_t>({255, 0, 0, 0, 102, 153, 0, 0, 153, 102, 0, 0}, "VEC4", true);
  std::vector<float> inverse_bind(32, 0.f);
  for (std::size_t joint = 0; joint < 2; ++joint)
    for (std::size_t i = 0; i < 4; ++i)
      inverse_bind[16 * joint + 5 * i] = 1;
  inverse_bind[16 + 12] = -1; // the second joint's x
  file.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", file.rows(inverse_bind, "MAT4")}}};
  file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {50, 0, 0}}},
                        {{"children", {2}}},
                        {{"translation", {1, 0, 0}}}};
  file.json["scenes"] = {{{"nodes", {0, 1}}}};
  return file;
}

std::string refusal_of_poses(const std::function<void()>& poses)
{
  try {
    poses();
  } catch (const Input_error& error) {
    return error.what();
  }
  return "";
}

TEST(Gltf_poses, OpenFacesThatAreClosedAtRest)
{
  for (const char* moved_by : {"nothing", "a target", "a bone"}) {
    Posed_file file;
    auto& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["indices"] = file.rows<std::uint8_t>({0, 1, 2, 2, 1, 3}, "SCALAR");
    primitive["attributes"]["POSITION"] = file.rows<float>({0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 2, 0}, "VEC3");
    if (moved_by == std::string("a target"))
      primitive["targets"] = {{{"POSITION", file.rows<float>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0}, "VEC3")}}};
    if (moved_by == std::string("a bone")) {
      auto& attributes = primitive["attributes"];
      attributes["JOINTS_0"] = file.rows<std::uint8_t>(std::vector<std::uint8_t>(16, 0), "VEC4");
      attributes["WEIGHTS_0"] =
          file.rows<std::uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 127, 128, 0, 0}, "VEC4", true);
      file.json["skins"] = {{{"joints", {0}}}};
      file.json["nodes"][0]["skin"] = 0;
    }
    const Prepared_soup prepared = prepare(file.soup());
    EXPECT_EQ(prepared.left_out_faces, 1u) << moved_by;
    EXPECT_EQ(prepared.left_out_faces_that_open, moved_by == std::string("nothing") ? 0u : 1u) << moved_by;
  }
}

TEST(Gltf_poses, AreMorphTargetsAtOne)
{
  Posed_file file;
  auto& mesh = file.json["meshes"][0];
  const std::size_t full = file.rows<float>({0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3");
  const std::size_t row = file.view<std::uint16_t>({2}), value = file.view<float>({0.5f, 0, 0});
  file.json["accessors"].push_back({{"componentType", 5126},
                                    {"count", 3},
                                    {"type", "VEC3"},
                                    {"sparse",
                                     {{"count", 1},
                                      {"indices", {{"bufferView", row}, {"componentType", 5123}}},
                                      {"values", {{"bufferView", value}}}}}});
  mesh["primitives"][0]["targets"] = {{{"POSITION", full}}, {{"POSITION", full + 1}}};
  mesh["extras"]["targetNames"] = {"a/b"};
  mesh["weights"] = {0.25, 0.25};
  file.json["nodes"][0]["scale"] = {2, 2, 2};
  const Triangle_soup soup = file.soup();
  const std::vector<Pose> poses = morph_poses(soup, "posed.gltf");
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].name, "a_b");
  EXPECT_EQ(poses[1].name, "target_1");
  EXPECT_EQ(poses[0].points, (std::vector<Point_3>{{0, 0, 2}, {2, 0, 4}, {0, 4, 6}}));
  EXPECT_EQ(poses[1].points, (std::vector<Point_3>{{0, 0, 0}, {2, 0, 0}, {1, 4, 0}}));

  // In an animation the weights are the channel's, else those of the mesh.
  file.animate("smile", 0, "weights", "LINEAR", {0, 1, 2}, {0, 0, 1, 0, 0, 1});
  const std::vector<Pose> smile = file.poses("smile");
  ASSERT_EQ(smile.size(), 3u);
  EXPECT_EQ(smile[0].points, soup.points);
  EXPECT_EQ(smile[1].points, poses[0].points);
  EXPECT_EQ(smile[2].points, poses[1].points);
  file.animate("stay", 0, "scale", "STEP", {0}, {2, 2, 2});
  EXPECT_EQ(file.poses("stay")[0].points[2], Point_3(0.25, 4, 1.5));
}

TEST(Gltf_poses, AreTheKeyframesOfAllChannels)
{
  Posed_file file;
  const float half = std::sqrt(0.5f);
  file.animate("walk", 0, "rotation", "LINEAR", {1, 3}, {0, 0, 0, 1, 0, 0, -half, -half}); // the longer way
  file.animate("walk", 0, "translation", "STEP", {1, 2.5f, 3}, {0, 0, 0, 0, 0, 1, 0, 0, 2});
  file.animate("walk", 0, "scale", "CUBICSPLINE", {1, 2, 3}, {0, 0, 0, 1, 1, 1, 2, 0, 0, //
                                                              0, 0, 0, 3, 1, 1, 4, 0, 0, //
                                                              6, 0, 0, 5, 1, 1, 0, 0, 0});
  const std::vector<Pose> poses = file.poses("walk");
  ASSERT_EQ(poses.size(), 4u);
  EXPECT_EQ(poses[0].points, file.soup().points) << "what moves nothing";
  EXPECT_EQ(poses[2].name, "walk_3");
  EXPECT_EQ(poses[2].time, 2.5f);
  // By hand: a quarter turn from 1 to 3, the shorter way; the spline of 2.5 is half way between its last
  // keys.
  const auto turned = [](double degrees, double x, double z) {
    const double angle = degrees * std::acos(-1.0) / 180;
    return Point_3(x * std::cos(angle), x * std::sin(angle), z);
  };
  expect_near(poses[1].points[1], turned(45, 3, 0));
  expect_near(poses[2].points[1], turned(67.5, (3 + 5) / 2.0 + (4 - 6) / 8.0, 1));
  expect_near(poses[3].points[1], turned(90, 5, 2));
  const std::vector<Pose> some = file.poses("walk", 3);
  ASSERT_EQ(some.size(), 2u);
  EXPECT_EQ(some[1].name, "walk_4");
  EXPECT_EQ(some[1].points, poses[3].points);

  file.animate("", 0, "translation", "LINEAR", {0}, {7, 0, 0});
  file.animate("walk", 0, "translation", "LINEAR", {0}, {8, 0, 0});
  const std::vector<Pose> all = file.poses();
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(all[4].name, "animation_1_1");
  EXPECT_EQ(all[5].name, "walk#2_1");
}

TEST(Gltf_poses, BlendJointsByTheirWeights)
{
  Posed_file file = skinned_file();
  file.animate("bend", 2, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0});
  const Triangle_soup soup = file.soup();
  const std::vector<Pose> poses = file.poses();
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].points, soup.points) << "the bind pose, wherever the node of the mesh is";
  // The second joint turns by half around (1, 0, 0): (x, y) goes to (2 - x, -y).
  expect_near(poses[1].points[0], Point_3(0, 0, 0));
  expect_near(poses[1].points[1], Point_3(1, 0, 0));
  expect_near(poses[1].points[2], Point_3(0.6 * 2, (0.4 - 0.6) * 2, 0));

  // The order in which a file names joints does not matter: seams of several pieces stay closed.
  const auto bent = [](const std::vector<std::uint8_t>& joints, const std::vector<std::uint8_t>& weights) {
    Posed_file other = skinned_file();
    auto& attributes = other.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = other.rows(joints, "VEC4");
    attributes["WEIGHTS_0"] = other.rows(weights, "VEC4", true);
    other.animate("bend", 1, "rotation", "LINEAR", {0}, {0.3f, 0.2f, 0.1f, 0.9f});
    other.animate("bend", 2, "rotation", "LINEAR", {0}, {0.5f, 0.1f, 0.7f, 0.3f});
    return other.poses()[0].points;
  };
  EXPECT_EQ(bent({0, 1, 0, 9, 1, 1, 0, 9, 0, 1, 0, 1}, {90, 98, 67, 0, 80, 98, 77, 0, 60, 59, 69, 67}),
            bent({1, 0, 0, 9, 0, 1, 1, 9, 1, 1, 0, 0}, {98, 67, 90, 0, 77, 98, 80, 0, 67, 59, 69, 60}));
}

TEST(Gltf_poses, MoveInstancesWithTheirNode)
{
  Posed_file file;
  file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  file.json["nodes"] = {{{"children", {1}}, {"rotation", {0.1, 0.2, 0.3, 0.9}}}, {{"mesh", 0}}};
  file.json["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      file.rows<float>({0, 0, 0, 0.1f, 5, 0}, "VEC3");
  file.animate("rise", 0, "translation", "STEP", {0, 1}, {0, 0, 0, 0, 0, 3});
  const Triangle_soup soup = file.soup();
  ASSERT_EQ(soup.points.size(), 6u);
  const std::vector<Pose> poses = file.poses();
  EXPECT_EQ(poses[0].points, soup.points) << "bit for bit";
  for (std::size_t v = 0; v < 6; ++v)
    EXPECT_EQ(poses[1].points[v], Point_3(soup.points[v].x(), soup.points[v].y(), soup.points[v].z() + 3));
}

TEST(Gltf_poses, StayWithInstancesThatBecomeNodes)
{
  Posed_file file;
  const Temporary_folder folder;
  file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      file.rows<float>({0, 0, 0, 0.5f, 5, 0, 1, 9, 0}, "VEC3");
  file.json["meshes"][0]["primitives"][0]["targets"] = {
      {{"POSITION", file.rows<float>({0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3")}}};
  file.animate("wave", 0, "weights", "STEP", {0, 1}, {0, 1});
  const Triangle_soup soup = file.soup();
  ASSERT_EQ(soup.triangles.size(), 3u);
  // One of the three places has lost its faces, so that the two others are nodes.
  write_mesh(folder / "o.glb", selected(soup, {0, 2}, {{0, 1, 2}, {6, 7, 8}}));
  const Triangle_soup result = read_mesh(folder / "o.glb").soup;
  const std::vector<Pose> poses = animation_poses(result, "wave", 1, "o.glb");
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].points, result.points);
  for (std::size_t v = 0; v < 6; ++v)
    EXPECT_EQ(poses[1].points[v].z(), double(v % 3 + 1));
}

TEST(Gltf_poses, GoWithMeshesThatAreGone)
{
  Posed_file file;
  const Temporary_folder folder;
  file.json["meshes"][0]["primitives"][0]["targets"] = {
      {{"POSITION", file.rows<float>({0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3")}}};
  file.json["nodes"].push_back(file.json["nodes"][0]);
  file.json["scenes"] = {{{"nodes", {0, 1}}}};
  file.animate("wave", 0, "weights", "STEP", {0, 1}, {0, 1});
  file.animate("wave", 1, "weights", "STEP", {0, 1}, {0, 1});
  file.animate("other", 1, "weights", "STEP", {0, 1}, {0, 1});
  write_mesh(folder / "o.glb", selected(file.soup(), {0}, {{0, 1, 2}}));
  const Triangle_soup result = read_mesh(folder / "o.glb").soup;
  EXPECT_EQ(animation_poses(result, "all", 1, "o.glb").size(), 2u);
  EXPECT_NE(refusal_of_poses([&] { animation_poses(result, "other", 1, "o.glb"); }), "");
}

TEST(Gltf_poses, OfInvalidFilesAreRefused)
{
  const auto refused = [](const char* what, const std::function<void(Posed_file&)>& spoil,
                          const char* animation = "all") {
    Posed_file file = skinned_file();
    file.animate("bend", 2, "translation", "LINEAR", {0, 1}, {1, 0, 0, 2, 0, 0});
    spoil(file);
    const Triangle_soup soup = file.soup();
    const std::string message = refusal_of_poses([&] { animation_poses(soup, animation, 1, "posed.gltf"); });
    EXPECT_NE(message.find(what), std::string::npos) << what << " / " << message;
    EXPECT_EQ(message.find("posed.gltf: ") == 0, *what != '\0') << message;
  };
  refused("", [](Posed_file&) {});
  refused(
      "no animation 'run'; it has 'bend'", [](Posed_file&) {}, "run");
  refused("has no animations", [](Posed_file& file) { file.json.erase("animations"); });
  const auto sampler = [](Posed_file & file) -> auto&
  {
    return file.json["animations"][0]["samplers"][0];
  };
  refused("times do not increase", [&](Posed_file& file) {
    sampler(file)["input"] = file.rows<float>({1, 1}, "SCALAR");
  });
  refused("another number of values", [&](Posed_file& file) {
    sampler(file)["input"] = file.rows<float>({1, 2, 3}, "SCALAR");
  });
  refused("another type",
          [&](Posed_file& file) { sampler(file)["output"] = file.rows<std::uint8_t>({1}, "SCALAR"); });
  refused("reaches beyond",
          [&](Posed_file& file) { file.json["accessors"][sampler(file)["input"].get<int>()]["count"] = 3; });
  refused("not finite", [&](Posed_file& file) {
    sampler(file)["input"] = file.rows<float>({1, NAN}, "SCALAR");
  });
  refused("names no output", [&](Posed_file& file) { sampler(file)["output"] = 1000; });
  refused("names no sampler",
          [](Posed_file& file) { file.json["animations"][0]["channels"][0]["sampler"] = -1; });
  refused("an interpolation", [&](Posed_file& file) { sampler(file)["interpolation"] = "BEZIER"; });
  refused("not a valid glTF file", [&](Posed_file& file) { sampler(file)["interpolation"] = 7; });
  refused("which has a matrix", [](Posed_file& file) {
    file.json["nodes"][2]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  });
  refused("a joint that is not in the scene",
          [](Posed_file& file) { file.json["skins"][0]["joints"][1] = 7; });
  refused("names joint 1", [](Posed_file& file) { file.json["skins"][0]["joints"] = {1}; });
  refused("fewer inverse bind matrices", [](Posed_file& file) {
    file.json["skins"][0]["inverseBindMatrices"] = file.rows(std::vector<float>(16, 0), "MAT4");
  });
  refused("moves no node", [](Posed_file& file) {
    file.json["animations"][0]["channels"][0]["target"] = {{"path", "pointer"}};
  });

  Triangle_soup plain = skinned_file().soup();
  EXPECT_NE(refusal_of_poses([&] { morph_poses(plain, "x"); }).find("no morph targets"), std::string::npos);
  EXPECT_THROW(animation_poses(plain, "all", 0, "x"), Argument_error);
  plain.scene = nullptr;
  EXPECT_NE(refusal_of_poses([&] { morph_poses(plain, "x"); }).find("no glTF file"), std::string::npos);
}

} // namespace
} // namespace selvedge::test
