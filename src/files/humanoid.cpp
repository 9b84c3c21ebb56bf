// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/humanoid.h"

#include "files/gltf_document.h"
#include "soup/gltf_transforms.h"

#include <selvedge/internal/Vector_of_doubles.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;
using Matrix = Gltf_scene::Matrix;
using Vector = std::array<double, 3>;
using Words = std::array<const char*, 3>;

// The names of limbs without their side. The first line is that of VRM.
constexpr Words words_of_arms[] = {{"upperarm", "lowerarm", "hand"},     // Unreal, VRoid
                                   {"upperarm", "forearm", "hand"},      // 3ds Max, Rigify, Character Creator
                                   {"arm", "forearm", "hand"},           // Mixamo, Ready Player Me, HumanIK
                                   {"upperarm", "lowerarm", "wrist"},    // MakeHuman
                                   {"arm", "elbow", "wrist"},            // VRChat
                                   {"shoulder", "elbow", "hand"},        // Synty
                                   {"shoulder", "elbow", "wrist"},       // SMPL
                                   {"shldrbend", "forearmbend", "hand"}, // Daz
                                   {"shldr", "forearm", "hand"}};
constexpr Words words_of_legs[] = {{"upperleg", "lowerleg", "foot"},  {"thigh", "calf", "foot"},
                                   {"thigh", "shin", "foot"},         {"upleg", "leg", "foot"},
                                   {"upperleg", "lowerleg", "ankle"}, {"leg", "knee", "ankle"},
                                   {"hip", "knee", "ankle"},          {"thighbend", "shin", "foot"}};

// What names begin with in whole rigs.
constexpr const char* words_of_rigs[] = {"mixamorig", "bip",   "j",     "def",      "cc",
                                         "base",      "valve", "biped", "character"};

// Returns the words of a name in lower case, without numbers: "upper", "arm", "l" for "upperArm01.L".
std::vector<std::string> words_in(const std::string& name)
{
  const auto is_upper = [&](std::size_t i) { return i < name.size() && name[i] >= 'A' && name[i] <= 'Z'; };
  const auto is_lower = [&](std::size_t i) { return i < name.size() && name[i] >= 'a' && name[i] <= 'z'; };
  std::vector<std::string> result(1);
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool is_letter = is_upper(i) || is_lower(i),
               is_capital = i > 0 && is_upper(i) && (!is_upper(i - 1) || is_lower(i + 1));
    const std::string& word = result.back();
    if (!word.empty() && (!is_letter || is_capital || word == "left" || word == "right"))
      result.emplace_back();
    if (is_letter)
      result.back() += is_upper(i) ? char(name[i] - 'A' + 'a') : name[i];
  }
  return result;
}

// Returns "left upperarm" for any name of this bone.
std::string usual_name(const std::string& name)
{
  std::string side, bone;
  for (const std::string& word : words_in(name))
    if (word == "l" || word == "left" || word == "r" || word == "right")
      side += word.front() == 'l' ? "left" : "right";
    else if (std::find(std::begin(words_of_rigs), std::end(words_of_rigs), word) == std::end(words_of_rigs))
      bone += word;
  return side + ' ' + bone;
}

std::set<Index> joints_of(const Gltf_scene& scene)
{
  std::set<Index> result;
  for (const Json& skin : member(scene.document, "skins"))
    for (const Json& joint : member(skin, "joints"))
      if (joint.is_number_unsigned())
        result.insert(joint.get<Index>());
  return result;
}

class Humanoid_search
{
public:
  explicit Humanoid_search(const Gltf_scene& scene) : m_joints(joints_of(scene))
  {
    for (const Gltf_scene::Placed_node& place : scene.placed_nodes)
      m_parents[place.node] = place.parent;
    const auto name = [this](const std::string& bone, std::size_t node) {
      if (m_parents.count(node) > 0)
        m_named[usual_name(bone)].push_back(Index(node));
    };
    const Json& extensions = member(scene.document, "extensions");
    const auto bones = [&](const char* extension) -> const Json& {
      return member(member(member(extensions, extension), "humanoid"), "humanBones");
    };
    const auto node_of = [](const Json& bone) { return bone.at("node").get<std::size_t>(); };
    if (const Json& bones_of_1 = bones("VRMC_vrm"); !bones_of_1.empty())
      for (const auto& [bone, place] : bones_of_1.items())
        name(bone, node_of(place));
    else if (const Json& bones_of_0 = bones("VRM"); !bones_of_0.empty())
      for (const Json& place : bones_of_0)
        name(place.at("bone").get<std::string>(), node_of(place));
    else
      for (const Index joint : m_joints)
        name(member(scene.document, "nodes").at(joint).value("name", ""), joint);
  }

  Humanoid result()
  {
    const char* const sides[] = {"left", "right"};
    for (std::size_t side = 0; side < 2; ++side) {
      m_result.arms[side] = limb(sides[side], words_of_arms, {"UpperArm", "LowerArm", "Hand"});
      m_result.legs[side] = limb(sides[side], words_of_legs, {"UpperLeg", "LowerLeg", "Foot"});
    }
    const auto& [left_arm, right_arm] = m_result.arms;
    const auto& [left_leg, right_leg] = m_result.legs;
    for (std::optional<Index> node = left_arm[0]; m_result.missing.empty() && node;
         node = m_parents.at(*node))
      if (m_joints.count(*node) > 0 && is_below(right_arm[0], *node) && !is_below(left_leg[0], *node) &&
          !is_below(right_leg[0], *node))
        m_result.spine = node;
    return std::move(m_result);
  }

private:
  bool is_below(Index node, Index other) const
  {
    std::optional<Index> above = m_parents.at(node);
    while (above && *above != other)
      above = m_parents.at(*above);
    return above.has_value();
  }

  // Finds the bones of a limb by one of the ways to name them, or as many as any has.
  template <std::size_t ways>
  Humanoid::Limb limb(const std::string& side, const Words (&names)[ways], const Words& bones)
  {
    std::vector<Index> most;
    for (const Words& words : names) {
      std::vector<Index> found;
      for (const char* const word : words) {
        const std::vector<Index>& named = m_named[side + ' ' + word];
        const auto next = std::find_if(named.begin(), named.end(), [&](Index node) {
          return found.empty() || is_below(node, found.back());
        });
        if (next == named.end())
          break;
        found.push_back(*next);
      }
      if (found.size() > most.size())
        most = std::move(found);
    }
    Humanoid::Limb result = {};
    std::copy(most.begin(), most.end(), result.begin());
    for (std::size_t i = most.size(); i < bones.size(); ++i)
      m_result.missing.push_back(side + bones[i]);
    return result;
  }

  std::map<std::size_t, std::optional<Index>> m_parents; // of the nodes of the scene
  std::set<Index> m_joints;
  std::map<std::string, std::vector<Index>> m_named; // by usual name
  Humanoid m_result;
};

// A direction of one side of a figure: outwards, up, forward.
struct Limb_directions
{
  Vector upper, lower;
};
struct Directions
{
  const char* name;
  std::array<Limb_directions, 2> arms; // left, right
  std::optional<std::array<Limb_directions, 2>> legs;
  std::optional<Vector> spine;
};

constexpr Limb_directions hanging = {{0.25, -1, 0}, {0.1, -1, 0.1}}, bent = {{0.2, -1, 0}, {0.1, 0.2, 1}},
                          forward = {{0.1, 0, 1}, {0, 0, 1}}, raised = {{0.3, 1, 0}, {0.1, 1, 0}},
                          swung_back = {{0.2, -1, -0.5}, {0.1, -1, -0.1}},
                          swung_forward = {{0.2, -1, 0.4}, {0, -0.6, 1}},
                          on_lap = {{0.2, -1, 0.3}, {0, -0.4, 1}},
                          hanging_in_bow = {{0.15, -1, 0}, {0.05, -1, 0.1}},
                          striding = {{0.05, -1, 0.6}, {0.05, -1, 0.1}},
                          trailing = {{0.05, -1, -0.3}, {0.05, -0.8, -0.8}},
                          sitting = {{0.2, 0, 1}, {0.05, -1, 0}};

const Directions s_postures[] = {
    {"arms_down", {hanging, hanging}, {}, {}},
    {"elbows_bent", {bent, bent}, {}, {}},
    {"arms_forward", {forward, forward}, {}, {}},
    {"arms_up", {raised, raised}, {}, {}},
    {"step", {swung_back, swung_forward}, {{striding, trailing}}, {}},
    {"sit", {on_lap, on_lap}, {{sitting, sitting}}, {}},
    {"bow", {hanging_in_bow, hanging_in_bow}, {}, {{0, 0.77, 0.64}}},
};

// Returns false, and changes nothing, when the vector has no direction.
bool normalise(Vector& vector)
{
  const double length = std::sqrt(internal::dot(vector, vector));
  if (!(length > 0 && std::isfinite(length)))
    return false;
  for (double& number : vector)
    number /= length;
  return true;
}

Vector place(const Matrix& to_world)
{
  return {to_world[0][3], to_world[1][3], to_world[2][3]};
}

} // namespace

Humanoid find_humanoid(const Gltf_scene& scene)
{
  return Humanoid_search(scene).result();
}

std::vector<Posture> humanoid_postures(const Humanoid& figure, const std::vector<Matrix>& to_world)
{
  const Vector from = place(to_world[figure.legs[1].front()]), to = place(to_world[figure.legs[0].front()]);
  Vector left = {to[0] - from[0], 0, to[2] - from[2]};
  if (!normalise(left))
    return {};
  // Up is the y-axis, and forward is left × up.
  const auto direction = [&](double outwards, const Vector& v) {
    return Vector{outwards * v[0] * left[0] - v[2] * left[2], v[1],
                  outwards * v[0] * left[2] + v[2] * left[0]};
  };
  std::vector<Posture> result;
  for (const Directions& directions : s_postures) {
    if (directions.spine && !figure.spine)
      continue;
    Posture& posture = result.emplace_back();
    posture.name = directions.name;
    if (directions.spine)
      posture.turns.push_back(
          {*figure.spine, {figure.arms[0].front(), figure.arms[1].front()}, direction(1, *directions.spine)});
    const auto move = [&](const Humanoid::Limb& limb, const Limb_directions& to_directions, double outwards) {
      posture.turns.push_back({limb[0], {limb[1]}, direction(outwards, to_directions.upper)});
      posture.turns.push_back({limb[1], {limb[2]}, direction(outwards, to_directions.lower)});
    };
    for (std::size_t side = 0; side < 2; ++side) {
      const double outwards = side == 0 ? 1 : -1;
      move(figure.arms[side], directions.arms[side], outwards);
      if (directions.legs)
        move(figure.legs[side], (*directions.legs)[side], outwards);
    }
  }
  return result;
}

bool turn(const Bone_turn& bone, const std::vector<Gltf_scene::Placed_node>& nodes,
          std::vector<Matrix>& to_world)
{
  const Vector pivot = place(to_world[bone.node]);
  Vector from = {}, to = bone.direction;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const Index end : bone.ends)
      from[axis] += to_world[end][axis][3];
    from[axis] = from[axis] / double(bone.ends.size()) - pivot[axis];
  }
  if (!normalise(from) || !normalise(to))
    return false;
  // Between opposite directions there are many ways: this one leads over a third direction.
  constexpr double nearly_opposite = -1 + 1e-6;
  const bool are_opposite = internal::dot(from, to) < nearly_opposite;
  const Vector third = perpendicular({}, to);
  const auto turn_vector = [&](const Vector& v) {
    return are_opposite ? turned(turned(v, from, third), third, to) : turned(v, from, to);
  };
  std::set<Index> moved = {bone.node};
  for (const Gltf_scene::Placed_node& place : nodes) {
    if (place.parent && moved.count(*place.parent) > 0)
      moved.insert(place.node);
    if (moved.count(place.node) == 0)
      continue;
    Matrix& matrix = to_world[place.node];
    for (std::size_t column = 0; column < 4; ++column) {
      const Vector origin = column == 3 ? pivot : Vector{};
      const Vector result = turn_vector(
          {matrix[0][column] - origin[0], matrix[1][column] - origin[1], matrix[2][column] - origin[2]});
      for (std::size_t row = 0; row < 3; ++row)
        matrix[row][column] = result[row] + origin[row];
    }
  }
  return true;
}

} // namespace selvedge::files
