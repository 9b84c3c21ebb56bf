// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shared_meshes.h"

#include "Gltf_scene.h"
#include "gltf_transforms.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
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
  Index mesh_of_file = 0;
  Shared_mesh::Place place{{}, false};
  double size = 0;
  Apart apart = Apart::no;
  std::vector<Index> rows; // of the corners in the node, after the numbers of the primitives
};

using Copies = std::vector<Copy*>;

// Returns nothing where the copies are not alike, or one is set apart by more than `most`.
std::optional<Shared_mesh> shared(const Copies& copies, Apart most)
{
  for (const Copy* const copy : copies)
    if (copy->apart > most || copy->rows != copies.front()->rows)
      return std::nullopt;
  const auto largest = std::max_element(copies.begin(), copies.end(),
                                        [](const Copy* a, const Copy* b) { return a->size < b->size; });
  Shared_mesh result;
  result.places.push_back(std::move((*largest)->place));
  for (auto copy = copies.begin(); copy != copies.end(); ++copy)
    if (copy != largest)
      result.places.push_back(std::move((*copy)->place));
  return result;
}

} // namespace

Shared_meshes shared_meshes(const Triangle_soup& soup, const std::vector<Apart>& apart)
{
  Shared_meshes result;
  if (!soup.scene)
    return result;
  const Gltf_scene& scene = *soup.scene;
  std::map<Index, std::map<Index, Copy>> all; // by first mesh alike in the file, and by mesh
  for (const Gltf_scene::Part& part : scene.parts)
    all[part.first_alike][part.mesh].mesh_of_file = part.mesh_of_file;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    const Gltf_scene::Part& part = scene.parts[soup.groups.of_triangle[t]];
    auto& alike = all[part.first_alike];
    if (alike.size() < 2)
      continue;
    const Gltf_scene::Instance& instance = scene.instances[part.instance];
    Copy& copy = alike[part.mesh];
    copy.place.triangles.push_back(t);
    copy.place.is_mirrored = instance.is_mirrored;
    copy.size = volume(instance.to_world);
    copy.rows.push_back(part.primitive);
    auto [a, b, c] = soup.triangles[t];
    if (instance.is_mirrored)
      std::swap(b, c);
    copy.apart = std::max(copy.apart, apart[t]);
    for (const Index v : {a, b, c}) {
      const Index row = soup.scene_vertices[v] - instance.first;
      copy.rows.push_back(row);
      const Gltf_scene::Column& positions = scene.blocks[instance.block].attributes.front();
      if (world_position(instance.to_world, positions, row) != soup.points[v])
        copy.apart = Apart::from_all;
    }
  }
  const auto add = [&](const Copies& copies, Apart most) {
    std::optional<Shared_mesh> mesh = shared(copies, most);
    if (mesh)
      result.meshes.push_back(std::move(*mesh));
    return mesh.has_value();
  };
  for (auto& [first_alike, alike] : all) {
    Copies copies;
    std::map<Index, Copies> of_one_mesh;
    for (auto& [mesh, copy] : alike) {
      copies.push_back(&copy);
      of_one_mesh[copy.mesh_of_file].push_back(&copy);
    }
    if (of_one_mesh.size() > 1 && add(copies, Apart::no))
      continue;
    for (const auto& [mesh, some] : of_one_mesh)
      if (some.size() > 1 && !add(some, Apart::from_other_meshes))
        ++result.apart;
  }
  return result;
}

} // namespace selvedge
