// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shared_meshes.h"

#include "Gltf_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace selvedge {
namespace {

double volume(const Gltf_scene::Matrix& m)
{
  return std::abs(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                  m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                  m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]));
}

/// A mesh in one place, and what must be the same in all.
struct Copy
{
  Shared_mesh::Place place{{}, false};
  double size = 0;
  std::vector<Index> rows; // of the corners in the node, after the numbers of the primitives
};

} // namespace

Shared_meshes shared_meshes(const Triangle_soup& soup, const std::vector<char>& is_apart)
{
  Shared_meshes result;
  if (!soup.scene)
    return result;
  const Gltf_scene& scene = *soup.scene;
  std::map<Index, std::map<Index, Copy>> copies; // by mesh of the file, and by mesh
  for (const Gltf_scene::Part& part : scene.parts)
    copies[part.mesh_of_file][part.mesh];
  std::map<Index, bool> differ;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    const Gltf_scene::Part& part = scene.parts[soup.groups.of_triangle[t]];
    auto& of_file = copies[part.mesh_of_file];
    if (of_file.size() < 2)
      continue;
    const Gltf_scene::Instance& instance = scene.instances[part.instance];
    Copy& copy = of_file[part.mesh];
    copy.place.triangles.push_back(t);
    copy.place.is_mirrored = instance.is_mirrored;
    copy.size = volume(instance.to_world);
    copy.rows.push_back(part.primitive);
    auto [a, b, c] = soup.triangles[t];
    if (instance.is_mirrored)
      std::swap(b, c);
    bool& is_different = differ[part.mesh_of_file];
    is_different |= is_apart[t] != 0;
    for (const Index v : {a, b, c}) {
      const Index row = soup.scene_vertices[v] - instance.first;
      copy.rows.push_back(row);
      const Gltf_scene::Column& positions = scene.blocks[instance.block].attributes.front();
      is_different |= world_position(instance.to_world, positions, row) != soup.points[v];
    }
  }
  for (auto& [mesh, of_file] : copies) {
    if (of_file.size() < 2)
      continue;
    const Copy& first = of_file.begin()->second;
    if (differ[mesh] || std::any_of(of_file.begin(), of_file.end(),
                                    [&](const auto& copy) { return copy.second.rows != first.rows; })) {
      ++result.apart;
      continue;
    }
    const auto largest = std::max_element(of_file.begin(), of_file.end(), [](const auto& a, const auto& b) {
      return a.second.size < b.second.size;
    });
    std::vector<Shared_mesh::Place>& places = result.meshes.emplace_back().places;
    places.push_back(std::move(largest->second.place));
    for (auto copy = of_file.begin(); copy != of_file.end(); ++copy)
      if (copy != largest)
        places.push_back(std::move(copy->second.place));
  }
  return result;
}

} // namespace selvedge
