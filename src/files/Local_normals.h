// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_LOCAL_NORMALS_H
#define SELVEDGE_SRC_FILES_LOCAL_NORMALS_H

#include "soup/Gltf_scene.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>

namespace selvedge::files {

/// Finds the bytes of normals in the nodes of a scene. From world space there is no way back without
/// rounding, so a normal of the file keeps its bytes.
class Local_normals
{
public:
  /// The scene must outlive this object.
  explicit Local_normals(const Gltf_scene& scene) : m_scene(scene) {}

  /// Returns the bytes in a column of normals, of three components, for a vertex of the scene that has a
  /// normal in world space: those of `row_at`, else those of another row of the instance with this normal, or
  /// else new ones. Where the column does not hold floats, those of its row.
  std::string bytes_of(const Gltf_scene::Column& column, Index scene_vertex,
                       const std::array<double, 3>& normal);

  /// Returns the row of the instance in which tangents and what morph targets add belong to the normal of
  /// such a vertex: its own where that has its normal, else another one with this normal at its position, or
  /// else its own.
  Index row_at(const Gltf_scene::Column& column, Index scene_vertex, const std::array<double, 3>& normal);

private:
  /// By the normals in world space and positions in the node, as bytes.
  using Rows = std::map<std::string, Index>;

  bool is_of_row(const Gltf_scene::Column& column, Index scene_vertex,
                 const std::array<double, 3>& normal) const;
  const Rows& rows_of(const Gltf_scene::Column& column, std::size_t instance);
  std::string key(Index scene_vertex, const std::array<double, 3>& normal) const;

  const Gltf_scene& m_scene;
  std::map<std::size_t, Rows> m_rows; // by instance
};

/// Returns the bytes of a normal.
std::string bits_of(const std::array<double, 3>& normal);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_LOCAL_NORMALS_H
