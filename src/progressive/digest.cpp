// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "progressive/lists.h"

#include "soup/Gltf_scene.h"

#include <selvedge/Sha256.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace selvedge::progressive {
namespace {

// Appends a coordinate as the bits of a double; −0 is 0.
void append(std::string& bytes, double coordinate)
{
  coordinate = coordinate == 0 ? 0 : coordinate;
  std::uint64_t bits;
  std::memcpy(&bits, &coordinate, sizeof bits);
  append_little_endian(bytes, std::uint32_t(bits));
  append_little_endian(bytes, std::uint32_t(bits >> 32));
}

void append(std::string& bytes, const Point_3& point)
{
  for (int axis = 0; axis < 3; ++axis)
    append(bytes, point[axis]);
}

} // namespace

std::string digest_of(const Progressive_mesh& mesh)
{
  const Gltf_scene& scene = *mesh.soup.scene;
  std::vector<std::vector<Index>> triangles(scene.parts.size());
  for (Index t = 0; t < mesh.soup.triangles.size(); ++t)
    triangles[mesh.soup.groups.of_triangle[t]].push_back(t);
  std::vector<std::size_t> order(scene.parts.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const auto key = [&](std::size_t k) {
      return std::make_tuple(scene.parts[k].mesh, scene.parts[k].primitive);
    };
    return key(i) < key(j);
  });
  Sha256 sha256;
  std::string bytes;
  const auto add = [&] {
    sha256.add(bytes);
    bytes.clear();
  };
  for (const Index faces : mesh.faces)
    append_little_endian(bytes, faces);
  append_little_endian(bytes, Index(mesh.fixed_faces));
  for (std::size_t i = 0; i < mesh.soup.poses.size(); ++i) {
    bytes += mesh.soup.poses[i].name;
    bytes += char(mesh.is_pose_guarded[i] != 0);
  }
  add();
  for (const std::size_t part : order) {
    if (triangles[part].empty()) // a primitive without triangles is not written
      continue;
    const Gltf_scene::Instance& instance = scene.instances[scene.parts[part].instance];
    const Index size = scene.blocks[instance.block].size;
    append_little_endian(bytes, size);
    for (Index v = instance.first; v < instance.first + size; ++v) {
      append(bytes, mesh.soup.points[v]);
      for (const Pose& pose : mesh.soup.poses)
        append(bytes, pose.points[v]);
      append_little_endian(bytes, mesh.merges_into[v] - instance.first);
      append_little_endian(bytes, mesh.steps[v]);
      add();
    }
    for (const Index t : triangles[part]) {
      for (const Index v : mesh.soup.triangles[t])
        append_little_endian(bytes, v - instance.first);
      add();
    }
  }
  return sha256.digest();
}

} // namespace selvedge::progressive
