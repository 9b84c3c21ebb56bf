// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_LOCAL_NORMALS_H
#define SELVEDGE_SRC_FILES_LOCAL_NORMALS_H

#include "soup/Gltf_scene.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace selvedge::files {

/// Finds the bytes of normals in the nodes of a scene, and those of what goes with them. From world space
/// there is no way back without rounding, so a normal of the file keeps its bytes.
class Local_normals
{
public:
  /// The scene must outlive this object.
  explicit Local_normals(const Gltf_scene& scene) : m_scene(scene) {}

  /// Returns the bytes in a column named NORMAL or TANGENT, of a block that has normals or of a morph target,
  /// for a vertex of the scene that has a normal in world space. They are those of `row_at` where that has
  /// this normal, or where a column or that of the normals does not hold floats. Else:
  /// - a normal has the bytes of another row of the instance with this normal, or else new ones;
  /// - a tangent is turned to be perpendicular to the normal, as precise as the file has them, and keeps its
  ///   side;
  /// - what a morph target adds is turned as the normal and the tangent of that row are (`turned`), likewise,
  ///   unless it is zero.
  std::string bytes_of(const Gltf_scene::Column& column, bool is_of_target, Index scene_vertex,
                       const std::array<double, 3>& normal);

  /// Returns the row of the instance whose tangent, and what morph targets add, suits the normal of such a
  /// vertex best: its own where that has its normal; else, among the rows that differ from it in nothing but
  /// what goes with normals, one with this normal, or the one whose normal is nearest.
  Index row_at(const Gltf_scene::Column& column, Index scene_vertex, const std::array<double, 3>& normal);

private:
  /// The rows of an instance, by position in the node; and the first with a normal in world space.
  struct Rows
  {
    std::unordered_map<std::string_view, std::vector<Index>> by_position;
    std::unordered_map<std::string, Index> by_normal;
  };

  bool has_normal(const Gltf_scene::Column& column, std::size_t instance, Index row,
                  const std::array<double, 3>& normal) const;
  std::string normal_of(const Gltf_scene::Column& normals, Index scene_vertex,
                        const std::array<double, 3>& normal);
  std::string tangent_of(const Gltf_scene::Column& tangents, const Gltf_scene::Column& normals,
                         Index scene_vertex, const std::array<double, 3>& normal);
  std::string displacement_of(const Gltf_scene::Column& column, const Gltf_scene::Block& block,
                              Index scene_vertex, const std::array<double, 3>& normal);
  const Rows& rows_of(const Gltf_scene::Column& column, std::size_t instance);

  const Gltf_scene& m_scene;
  std::map<std::size_t, Rows> m_rows; // by instance
};

/// Returns the bytes of a normal.
std::string bits_of(const std::array<double, 3>& normal);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_LOCAL_NORMALS_H
