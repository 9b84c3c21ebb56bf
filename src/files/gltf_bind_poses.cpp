// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/gltf_bind_poses.h"

#include "files/gltf_column_reader.h"
#include "soup/gltf_transforms.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::files {
namespace {

using Matrix = Gltf_scene::Matrix;

Matrix absolute(Matrix matrix)
{
  for (auto& row : matrix)
    for (double& entry : row)
      entry = std::fabs(entry);
  return matrix;
}

/// Gives skins their places, one after the other.
class Bind_poses
{
public:
  explicit Bind_poses(const Gltf_document& document) : m_document(document) {}

  Matrix place(int number)
  {
    const std::vector<Joint> joints = joints_of(number);
    if (joints.empty())
      return Gltf_scene::identity_matrix;
    std::optional<Matrix> place = place_beside_another(joints);
    if (!place) {
      const auto& [first, to_joint] = joints.front();
      const Matrix& joint = *m_document.to_world[first];
      place = known(product(joint, to_joint), product(absolute(joint), absolute(to_joint)));
      if (!inverse(*place)) // a joint of size zero hides what it moves
        place = Gltf_scene::identity_matrix;
    }
    if (m_places.size() < s_most_places &&
        std::find(m_places.begin(), m_places.end(), *place) == m_places.end())
      m_places.push_back(*place);
    for (const auto& [node, inverse_bind] : joints)
      m_bound.emplace(node, Bound{*place, inverse_bind});
    return *place;
  }

private:
  static constexpr std::size_t s_most_places = 100; // that others are compared with; most scenes have one

  struct Joint
  {
    std::size_t node;
    Matrix inverse_bind;
  };
  struct Bound
  {
    Matrix to_world, inverse_bind; // of a skin
  };

  // Returns the joints of a skin; none when the skin is not as the format demands.
  std::vector<Joint> joints_of(int number) const
  {
    const tinygltf::Model& model = m_document.model;
    const Gltf_scene::Json& skins = member(m_document.json, "skins");
    if (number < 0 || std::size_t(number) >= skins.size() || !skins[std::size_t(number)].is_object())
      return {};
    const Gltf_scene::Json& skin = skins[std::size_t(number)];
    std::vector<Joint> joints;
    for (const Gltf_scene::Json& joint : member(skin, "joints")) {
      const std::size_t node = joint.is_number_unsigned() ? joint.get<std::size_t>() : model.nodes.size();
      if (node >= model.nodes.size() || !m_document.to_world[node])
        return {};
      joints.push_back({node, Gltf_scene::identity_matrix});
    }
    if (!skin.contains("inverseBindMatrices"))
      return joints;
    const Gltf_scene::Json& matrices = skin["inverseBindMatrices"];
    const std::size_t accessor =
        matrices.is_number_unsigned() ? matrices.get<std::size_t>() : model.accessors.size();
    if (accessor >= model.accessors.size() || model.accessors[accessor].bufferView < 0 ||
        model.accessors[accessor].type != TINYGLTF_TYPE_MAT4 ||
        model.accessors[accessor].componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
        model.accessors[accessor].count < joints.size())
      return {};
    const Gltf_scene::Column rows =
        Gltf_column_reader(m_document, "skin " + std::to_string(number))
            .read(int(accessor), "inverseBindMatrices", model.accessors[accessor].count);
    for (std::size_t j = 0; j < joints.size(); ++j)
      joints[j].inverse_bind = matrix_of([&](std::size_t i) { return component(rows, Index(j), i); });
    return joints;
  }

  // Returns the place that the matrices of a joint give a skin beside an earlier one that has it, too.
  std::optional<Matrix> place_beside_another(const std::vector<Joint>& joints) const
  {
    for (const auto& [node, to_joint] : joints) {
      const auto found = m_bound.find(node);
      if (found == m_bound.end())
        continue;
      const auto& [other, to_joint_of_other] = found->second;
      if (to_joint == to_joint_of_other)
        return other;
      const std::optional<Matrix> from_joint = inverse(to_joint_of_other);
      if (from_joint && inverse(to_joint))
        return known(product(product(other, *from_joint), to_joint),
                     product(product(absolute(other), absolute(*from_joint)), absolute(to_joint)));
    }
    return std::nullopt;
  }

  // Returns the identity or the place of another skin if `place` differs from it by rounding alone. `size`
  // has the sums of the absolute values of what each entry is a sum of.
  Matrix known(const Matrix& place, const Matrix& size) const
  {
    const auto is_meant = [&](const Matrix& other) {
      constexpr double rounding = 1e-5; // of some products of 32-bit floats, which may come from few digits
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column)
          if (!(std::fabs(place[row][column] - other[row][column]) <= rounding * size[row][column]))
            return false;
      return true;
    };
    if (is_meant(Gltf_scene::identity_matrix))
      return Gltf_scene::identity_matrix;
    const auto found = std::find_if(m_places.begin(), m_places.end(), is_meant);
    return found == m_places.end() ? place : *found;
  }

  const Gltf_document& m_document;
  std::map<std::size_t, Bound> m_bound; // by joint, of the first skin that has it
  std::vector<Matrix> m_places;         // of skins until now
};

} // namespace

std::map<int, Matrix> bind_poses(const Gltf_document& document)
{
  std::map<int, Matrix> result;
  Bind_poses poses(document);
  for (std::size_t n = 0; n < document.model.nodes.size(); ++n) {
    const tinygltf::Node& node = document.model.nodes[n];
    if (document.to_world[n] && node.mesh != -1 && node.skin != -1 && result.count(node.skin) == 0)
      result.emplace(node.skin, poses.place(node.skin));
  }
  return result;
}

} // namespace selvedge::files
