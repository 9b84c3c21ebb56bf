// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "judge_files.h"

#include "judge_result.h"
#include "same_bits.h"

#include "soup/Gltf_scene.h"
#include "soup/flat_shading.h"
#include "soup/selection.h"
#include "support/Temporary_folder.h"
#include "support/soups.h"
#include <selvedge/collapse_log.h>
#include <selvedge/merge.h>
#include <selvedge/mesh_files.h>
#include <selvedge/replay.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <sstream>
#include <string>

namespace selvedge::test {
namespace {

// Numbers normals like vertices, as PLY does, where each vertex has one.
Triangle_soup with_normals_of_vertices(Triangle_soup soup)
{
  Corner_values<3> normals;
  normals.values.resize(soup.points.size(), {0, 0, 0});
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (Index k = 0; k < 3; ++k)
      normals.values[soup.triangles[t][k]] = soup.normals.values[soup.normals.of_triangle[t][k]];
  normals.of_triangle = soup.triangles;
  soup.normals = std::move(normals);
  return soup;
}

// Normals are compared by their values: of two that differ in the sign of a zero, a corner may have either.
bool have_equal_normals(const Triangle_soup& a, const Triangle_soup& b)
{
  if (a.normals.of_triangle.size() != b.normals.of_triangle.size())
    return false;
  for (std::size_t t = 0; t < a.normals.of_triangle.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (a.normals.values[a.normals.of_triangle[t][k]] != b.normals.values[b.normals.of_triangle[t][k]])
        return false;
  return true;
}

// The places of the corners of a triangle, each with the side of its tangent where there are some.
using Corner_points = std::array<std::array<double, 4>, 3>;

std::vector<Corner_points> corner_points(const Triangle_soup& soup, bool in_any_order,
                                         bool with_sides = false)
{
  std::vector<Corner_points> result;
  for (const Index_triple& triangle : soup.triangles) {
    result.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3& p = soup.points[triangle[k]];
      result.back()[k] = {p.x() + 0., p.y() + 0., p.z() + 0., // one zero
                          with_sides ? side_of_tangent(*tangents_of(soup), triangle[k]) : 0.};
    }
    if (in_any_order)
      std::rotate(result.back().begin(), std::min_element(result.back().begin(), result.back().end()),
                  result.back().end());
  }
  if (in_any_order)
    std::sort(result.begin(), result.end());
  return result;
}

// The triangles of a soup with all that their corners have, in an order of their own: instances become nodes
// in a progressive file, so that places of a mesh may follow each other otherwise.
std::vector<std::string> sorted_triangles(const Triangle_soup& soup, bool with_normals, bool with_tangents)
{
  std::vector<std::string> result;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    std::array<std::string, 3> corners;
    std::size_t k = 0;
    const auto add = [&](const void* data, std::size_t size) {
      corners[k].append(static_cast<const char*>(data), size);
    };
    const auto add_numbers = [&](const auto& numbers) { // zeros of either sign are one
      for (double number : numbers) {
        number += 0.0;
        add(&number, sizeof number);
      }
    };
    for (; k < 3; ++k) {
      const Index v = soup.triangles[t][k];
      for (int axis = 0; axis < 3; ++axis) {
        const double coordinate = soup.points[v][axis];
        add(&coordinate, sizeof coordinate);
      }
      if (!soup.uvs.empty())
        add_numbers(soup.uvs.values[soup.uvs.of_triangle[t][k]]);
      if (with_normals && !soup.normals.empty())
        add_numbers(soup.normals.values[soup.normals.of_triangle[t][k]]);
      for (const Attribute& attribute : soup.vertex_attributes)
        if (with_tangents || attribute.name != "TANGENT")
          add(attribute.rows.data() + v * row_size(attribute), row_size(attribute));
    }
    // Draco begins with another corner.
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.push_back(corners[0] + corners[1] + corners[2]);
  }
  std::sort(result.begin(), result.end());
  return result;
}

// Whether the reader has joined vertices of the scene, if there is one.
bool are_vertices_joined(const Triangle_soup& soup)
{
  if (!soup.scene)
    return false;
  std::size_t vertices = 0;
  for (const Gltf_scene::Instance& instance : soup.scene->instances)
    vertices += soup.scene->blocks[instance.block].size;
  return soup.points.size() < vertices;
}

} // namespace

Verdict judge_replay(const World& world, const World_run& run)
{
  std::istringstream stream(run.log);
  Log_reader reader(stream, "log");
  Replay_options options;
  if (!world.obstacle.triangles.empty() && world.seed % 4 != 0) // the others say that it was not judged
    options.obstacle = world.obstacle;
  const Replay_verdict verdict = replay(world.soup, world.input_format == Mesh_format::stl, reader, options);
  const auto broken = [](const std::string& what) { return Broken_promise{Promise::log_replay, what}; };
  if (!verdict.violations.empty()) {
    const Violation& first = verdict.violations.front();
    return broken(name(first.kind) + (": " + first.message) + " at step " + std::to_string(first.step));
  }
  if (!verdict.is_accepted() || !verdict.is_result_stated)
    return broken("not accepted, or the result is not stated");
  if (verdict.soup.triangles != run.result.soup.triangles ||
      !std::equal(verdict.soup.points.begin(), verdict.soup.points.end(), run.result.soup.points.begin(),
                  run.result.soup.points.end()) ||
      (run.result.placed_vertices == 0 &&
       (verdict.soup.uvs.of_triangle != run.result.soup.uvs.of_triangle ||
        verdict.soup.uvs.values != run.result.soup.uvs.values ||
        (run.are_normals_kept() && !have_equal_normals(verdict.soup, run.result.soup)))))
    return broken("the log leads to another result");
  for (std::size_t pose = 0; pose < world.soup.poses.size(); ++pose) {
    if (!world.is_guarded(pose))
      continue;
    std::istringstream again(run.log);
    Log_reader reader_again(again, "log");
    options.pose = pose;
    const Replay_verdict in_pose =
        replay(world.soup, world.input_format == Mesh_format::stl, reader_again, options);
    if (!in_pose.violations.empty())
      return broken("in " + world.soup.poses[pose].name + ", " + name(in_pose.violations.front().kind) +
                    ": " + in_pose.violations.front().message + " at step " +
                    std::to_string(in_pose.violations.front().step));
  }
  return std::nullopt;
}

Verdict judge_file(const World& world, const World_run& run)
{
  const Triangle_soup &result = run.result.soup, &file = run.read_back;
  const bool is_scene = world.output_format == Mesh_format::glb || world.output_format == Mesh_format::gltf;
  const bool with_sides = is_scene && tangents_of(result) && tangents_of(file);
  if (corner_points(result, is_scene, with_sides) != corner_points(file, is_scene, with_sides))
    return Broken_promise{Promise::written, "the file has other triangles"};
  if (is_scene || world.is_sewn || world.output_format == Mesh_format::stl)
    return std::nullopt;
  // The vertices that the writer splits by flat normals, and those that the reader then joins.
  Triangle_soup expected = result;
  expected.poses.clear(); // the file has none
  if (world.output_format == Mesh_format::ply && !file.normals.empty()) {
    for (Index i = 0; i < result.triangles.size(); ++i)
      for (Index k = 0; k < 3; ++k)
        if (!has_same_value(file.normals, i, result.normals, 3 * i + k, k))
          return Broken_promise{Promise::written, "the file has other normals"};
    expected = has_vertices_of_several_normals(result) ? split_by_normals(expected)
                                                       : with_normals_of_vertices(std::move(expected));
    share_split_vertices(expected);
  }
  // Readers connect faces that have vertices of their own, as those of STL.
  const bool may_be_connected =
      have_faces_own_vertices(expected.triangles.size(), count_of_used_vertices(expected));
  if ((!may_be_connected && file.triangles != expected.triangles) ||
      file.points.size() != expected.points.size() ||
      !std::equal(file.points.begin(), file.points.end(), expected.points.begin(), has_same_bits))
    return Broken_promise{Promise::written, "the file has other numbers or bits"};
  if (world.output_format != Mesh_format::obj)
    return std::nullopt;
  for (Index i = 0; i < result.triangles.size(); ++i) {
    bool is_same = has_same_label(file.groups, i, result.groups, i) &&
                   has_same_label(file.objects, i, result.objects, i) &&
                   has_same_label(file.materials, i, result.materials, i);
    for (Index k = 0; k < 3; ++k)
      is_same = is_same && has_same_value(file.uvs, i, result.uvs, 3 * i + k, k) &&
                has_same_value(file.normals, i, result.normals, 3 * i + k, k);
    if (!is_same)
      return Broken_promise{Promise::written, "the file has other values or labels"};
  }
  return std::nullopt;
}

Verdict judge_progressive_file(const World_run& run)
{
  if (!run.last_level)
    return std::nullopt;
  const bool with_normals = run.are_normals_kept();
  // Tangents turn with normals. The reader leaves them to the scene where it joins vertices that differ in
  // them, and which it joins, and whose tangents stay, depends on their order where normals are nearly equal.
  const bool with_tangents = with_normals && tangents_of(*run.last_level) && tangents_of(run.read_back) &&
                             run.last_level->points.size() == run.read_back.points.size() &&
                             !are_vertices_joined(*run.last_level) && !are_vertices_joined(run.read_back);
  if (sorted_triangles(*run.last_level, with_normals, with_tangents) ==
      sorted_triangles(run.read_back, with_normals, with_tangents))
    return std::nullopt;
  return Broken_promise{Promise::progression, "the last level in a file has not the triangles of the result"};
}

Verdict judge_file_of_levels(const World& world, const std::vector<Simplified_soup>& levels)
{
  std::vector<Triangle_soup> soups;
  for (const Simplified_soup& level : levels)
    soups.push_back(world.is_sewn ? merged_at_positions(level.soup) : level.soup);
  const bool is_gltf = world.output_format == Mesh_format::glb || world.output_format == Mesh_format::gltf;
  if (!is_gltf || std::any_of(soups.begin(), soups.end(), [&](const Triangle_soup& soup) {
        return soup.triangles.empty() ||
               soup.scene != soups.front().scene; // new places are in scenes of their own
      }))
    return std::nullopt;
  std::stable_sort(soups.begin(), soups.end(), [](const Triangle_soup& a, const Triangle_soup& b) {
    return a.triangles.size() > b.triangles.size();
  });
  const Temporary_folder folder;
  write_levels_of_detail(folder / "levels.glb", soups);
  for (std::size_t i = 0; i < soups.size(); ++i) {
    Read_options options;
    options.level_of_detail = i;
    if (corner_points(read_mesh(folder / "levels.glb", options).soup, true) != corner_points(soups[i], true))
      return Broken_promise{Promise::written,
                            "the file of all levels has other triangles in level " + std::to_string(i + 1)};
  }
  return std::nullopt;
}

} // namespace selvedge::test
