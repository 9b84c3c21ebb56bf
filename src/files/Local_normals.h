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
  /// normal in world space: those of its row where that is its normal, else those of another row of the
  /// instance with this normal, at this position if there is one, or else new ones. Where the column does not
  /// hold floats, those of its row.
  std::string bytes_of(const Gltf_scene::Column& column, Index scene_vertex,
                       const std::array<double, 3>& normal);

private:
  const Gltf_scene& m_scene;
  /// By instance: the rows by the normals in world space and positions in the node, as bytes.
  std::map<std::size_t, std::map<std::string, Index>> m_rows;
};

/// Returns the bytes of a normal.
std::string bits_of(const std::array<double, 3>& normal);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_LOCAL_NORMALS_H
