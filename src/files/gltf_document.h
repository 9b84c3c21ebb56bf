// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_GLTF_DOCUMENT_H
#define SELVEDGE_SRC_FILES_GLTF_DOCUMENT_H

#include "soup/Gltf_scene.h"

#include <selvedge/mesh_files.h>

#include <tiny_gltf.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::files {

/// A glTF file as JSON and as tinygltf understands it, decoded where it was compressed, before `read_gltf`
/// makes a soup of it. The lists of both correspond, and the nodes of the scene are a forest. What accessors
/// and buffer views say of themselves is not checked yet.
struct Gltf_document
{
  std::string name; ///< stands for the file in messages
  Gltf_scene::Json json;
  tinygltf::Model model;
  std::vector<std::optional<Gltf_scene::Matrix>> to_world; ///< of every node that is in the scene
  std::vector<Gltf_scene::Placed_node> placed_nodes;       ///< the nodes of the scene, parents first

  /// A node that does what one row of EXT_mesh_gpu_instancing does, as a child of the node with the
  /// extension.
  struct Instance
  {
    Gltf_scene::Json node;
    Gltf_scene::Matrix in_node, to_world;
  };
  std::map<std::size_t, std::vector<Instance>> instances; ///< of nodes that are in the scene
  std::map<int, Gltf_scene::Compression> compressions;    ///< of accessors that Draco held
  std::map<Index, Gltf_scene::Meshopt_view> meshopt_views;
  std::map<std::string, std::size_t> remarks; ///< for `Read_notes`
  std::map<std::string, std::size_t> compact; ///< for the scene

  /// Throws an `Input_error` that names the file.
  [[noreturn]] void fail(const std::string& message) const;
};

/// Reads a glTF file. Throws `Input_error`, or an exception of the JSON library, when the file cannot be
/// read. `folder` is where buffers in files of their own are looked for; null when there is none. `level` is
/// that of `choose_level` (gltf_levels.h).
Gltf_document read_gltf_document(std::string_view contents, Mesh_format format, const std::string& name,
                                 const std::filesystem::path* folder, std::size_t level);

/// Returns a list in an object; an empty one when it is not there.
const Gltf_scene::Json& member(const Gltf_scene::Json& object, const char* name);

/// Removes channels of animations from a document that nobody has checked, and animations that lose all.
void drop_channels(Gltf_scene::Json& document,
                   const std::function<bool(const Gltf_scene::Json& channel)>& is_dropped);

/// Returns the transform of a node. The rotation is not normalised, so that every entry is one fixed formula
/// of the numbers in the file.
Gltf_scene::Matrix local_matrix(const tinygltf::Node& node);

/// Returns the transform whose entry in a row and a column is `entry(4 * column + row)`, as glTF orders the
/// numbers of a matrix.
template <class Entry>
Gltf_scene::Matrix matrix_of(const Entry& entry)
{
  Gltf_scene::Matrix result;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      result[row][column] = entry(4 * column + row);
  return result;
}

/// Multiplies two transforms in the order of operations that mesh_files.h states.
Gltf_scene::Matrix product(const Gltf_scene::Matrix& a, const Gltf_scene::Matrix& b);

inline constexpr const char* instancing_extension = "EXT_mesh_gpu_instancing";

/// Returns the numbers of the accessors of a node's instances, by name; an empty list when it has none.
const Gltf_scene::Json& instance_attributes(const Gltf_scene::Json& node);

/// Returns whether an extension of this name is of materials, textures, lights or metadata: it says nothing
/// of meshes, and refers to no accessor or buffer view.
bool is_apart_from_meshes(const std::string& extension);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_GLTF_DOCUMENT_H
