// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_FIGURE_H
#define SELVEDGE_TEST_SUPPORT_FIGURE_H

#include <selvedge/internal/base64.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace selvedge::test {

/// A human figure of fifteen joints that stands with its arms out and looks along z, and what it wears, as a
/// glTF file. All coordinates are exact.
struct Figure
{
  using Json = nlohmann::ordered_json;

  enum Bone : std::size_t {
    hips,
    spine,
    chest,
    left_upper_arm,
    left_lower_arm,
    left_hand,
    right_upper_arm,
    right_lower_arm,
    right_hand,
    left_upper_leg,
    left_lower_leg,
    left_foot,
    right_upper_leg,
    right_lower_leg,
    right_foot,
    bones
  };

  struct Joint
  {
    std::string name;
    std::size_t parent; // of hips itself
    std::array<float, 3> place;
  };

  struct Vertex
  {
    std::array<float, 3> place;
    std::array<std::uint8_t, 4> joints;
    std::array<float, 4> weights;
  };

  std::vector<Joint> joints = {
      {"mixamorig:Hips", hips, {0, 16, 0}},
      {"mixamorig:Spine", hips, {0, 18, 0}},
      {"mixamorig:Spine1", spine, {0, 22, 0}},
      {"mixamorig:LeftArm", chest, {3, 24, 0}},
      {"mixamorig:LeftForeArm", left_upper_arm, {8, 24, 0}},
      {"mixamorig:LeftHand", left_lower_arm, {13, 24, 0}},
      {"mixamorig:RightArm", chest, {-3, 24, 0}},
      {"mixamorig:RightForeArm", right_upper_arm, {-8, 24, 0}},
      {"mixamorig:RightHand", right_lower_arm, {-13, 24, 0}},
      {"mixamorig:LeftUpLeg", hips, {2, 15, 0}},
      {"mixamorig:LeftLeg", left_upper_leg, {2, 8, 0}},
      {"mixamorig:LeftFoot", left_lower_leg, {2, 1, 0}},
      {"mixamorig:RightUpLeg", hips, {-2, 15, 0}},
      {"mixamorig:RightLeg", right_upper_leg, {-2, 8, 0}},
      {"mixamorig:RightFoot", right_lower_leg, {-2, 1, 0}},
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> corners;

  /// Lowers the arms half-way. They are as long as before.
  void stand_with_arms_lowered()
  {
    for (const auto& [bone, side] : {std::pair(left_upper_arm, 1.f), std::pair(right_upper_arm, -1.f)}) {
      joints[bone + 1].place = {side * 6, 20, 0};
      joints[bone + 2].place = {side * 9, 16, 0};
    }
  }

  /// Wears a corner of three edges at each joint: vertices 4 × joint and three more. Call it last.
  void wear_corners()
  {
    for (std::size_t joint = 0; joint < joints.size(); ++joint)
      for (std::size_t k = 0; k < 4; ++k) {
        std::array<float, 3> place = joints[joint].place;
        if (k > 0)
          place[k - 1] += 1;
        const auto v = std::uint32_t(4 * joint);
        if (k > 1)
          corners.insert(corners.end(), {v, v + std::uint32_t(k) - 1, v + std::uint32_t(k)});
        vertices.push_back({place, {std::uint8_t(joint), 9, 9, 9}, {1, 0, 0, 0}});
      }
  }

  /// Wears two sleeves on its left arm, one in the other, that bend smoothly at the shoulder.
  void wear_sleeves()
  {
    constexpr std::uint32_t rings = 72, around = 16;
    for (std::uint32_t sleeve = 0; sleeve < 2; ++sleeve)
      for (std::uint32_t ring = 0; ring <= rings; ++ring)
        for (std::uint32_t i = 0; i < around; ++i) {
          const float x = float(ring) / 6, angle = float(i) * 6.2831853f / around,
                      radius = sleeve == 0 ? 0.75f : 0.8125f,
                      bend = x < 0.5f   ? 0
                             : x > 5.5f ? 1
                                        : (x - 0.5f) / 5;
          vertices.push_back({{x, 24 + radius * std::cos(angle), radius * std::sin(angle)},
                              {chest, left_upper_arm, 0, 0},
                              {1 - bend, bend, 0, 0}});
          const std::uint32_t first = (sleeve * (rings + 1) + ring) * around, a = first + i,
                              b = first + (i + 1) % around;
          if (ring < rings)
            corners.insert(corners.end(), {a, a + around, b, b, a + around, b + around});
        }
  }

  /// Node 0 shows the mesh; the joints follow.
  Json document() const
  {
    Json views, accessors;
    std::string bytes;
    const auto add = [&](const auto& numbers, int component, const char* type, std::size_t components) {
      const std::size_t size = numbers.size() * sizeof numbers.front();
      views.push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
      bytes.append(reinterpret_cast<const char*>(numbers.data()), size);
      accessors.push_back({{"bufferView", accessors.size()},
                           {"componentType", component},
                           {"count", numbers.size() / components},
                           {"type", type}});
      return accessors.size() - 1;
    };
    std::vector<float> places, weights, inverse_bind;
    std::vector<std::uint8_t> joints_of_vertices;
    for (const Vertex& vertex : vertices) {
      places.insert(places.end(), vertex.place.begin(), vertex.place.end());
      weights.insert(weights.end(), vertex.weights.begin(), vertex.weights.end());
      joints_of_vertices.insert(joints_of_vertices.end(), vertex.joints.begin(), vertex.joints.end());
    }
    Json nodes = {{{"mesh", 0}, {"skin", 0}}}, skin;
    for (const auto& [name, parent, place] : joints) {
      inverse_bind.insert(inverse_bind.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, //
                                               -place[0], -place[1], -place[2], 1});
      const bool is_root = nodes.size() == 1;
      const std::array<float, 3> from = is_root ? std::array<float, 3>{} : joints[parent].place;
      if (!is_root)
        nodes[parent + 1]["children"].push_back(nodes.size());
      skin["joints"].push_back(nodes.size());
      nodes.push_back(
          {{"name", name}, {"translation", {place[0] - from[0], place[1] - from[1], place[2] - from[2]}}});
    }
    const Json attributes = {{"POSITION", add(places, 5126, "VEC3", 3)},
                             {"JOINTS_0", add(joints_of_vertices, 5121, "VEC4", 4)},
                             {"WEIGHTS_0", add(weights, 5126, "VEC4", 4)}};
    skin["inverseBindMatrices"] = add(inverse_bind, 5126, "MAT4", 16);
    return {
        {"asset", {{"version", "2.0"}}},
        {"scenes", {{{"nodes", {0, 1}}}}},
        {"nodes", nodes},
        {"skins", {skin}},
        {"meshes",
         {{{"primitives", {{{"attributes", attributes}, {"indices", add(corners, 5125, "SCALAR", 1)}}}}}}},
        {"accessors", accessors},
        {"bufferViews", views},
        {"buffers",
         {{{"byteLength", bytes.size()},
           {"uri", "data:application/octet-stream;base64," + internal::base64(bytes)}}}}};
  }
};

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_FIGURE_H
