// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_GLTF_SCENE_H
#define SELVEDGE_SRC_FILES_GLTF_SCENE_H

#include <selvedge/Triangle_soup.h>

#include <nlohmann/json.hpp>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace selvedge {

/// What `read_gltf` keeps of a file, so that `write_gltf` can put the reduced triangles back: the document
/// without the vertices and indices of the triangles in the soup, and these apart, as their bytes. Everything
/// else in the document is unchanged, numbers of accessors and buffer views included.
struct Gltf_scene
{
  using Json = nlohmann::ordered_json;
  using Matrix = std::array<std::array<double, 4>, 3>; ///< its fourth row is 0 0 0 1

  /// The rows of an accessor, without gaps and with its sparse values in place.
  struct Column
  {
    std::string name; ///< "POSITION"
    Json accessor;    ///< what the document says about it, apart from where its bytes are
    int component_type = 0;
    std::size_t components = 0;
    std::size_t row_size = 0;
    std::string rows;
  };

  /// Vertices that several primitives of a mesh may share. The first of the attributes is the position.
  struct Block
  {
    Index size = 0;
    std::vector<Column> attributes;
    std::vector<std::vector<Column>> targets;
  };

  /// A block in a node: a range of the vertices of the soup that was read.
  struct Instance
  {
    Index block = 0;
    Index first = 0;
    Matrix to_world = {};
    bool is_mirrored = false; ///< `to_world` turns the triangles over
  };

  /// A primitive in a node: a group of the soup. No two nodes share a mesh.
  struct Part
  {
    Index mesh = 0;
    Index primitive = 0;
    Index instance = 0;
    int index_type = 0;               ///< component type of the indices, 0 when there are none
    Json index_json = Json::object(); ///< what the document says about their accessor, likewise
  };

  Json document;
  std::vector<std::string> views;    ///< the bytes of every buffer view, unless it is free
  std::vector<Index> free_views;     ///< numbers that nothing refers to any more
  std::vector<Index> free_accessors; ///< likewise
  std::vector<Block> blocks;
  std::vector<Instance> instances;
  std::vector<Part> parts;
  std::vector<std::string> only_in_gltf; ///< names of what no other format holds
};

namespace files {

enum Component_type {
  type_int8 = 5120,
  type_uint8,
  type_int16,
  type_uint16,
  type_uint32 = 5125,
  type_float32
};

constexpr Index s_none = std::numeric_limits<Index>::max();

constexpr Gltf_scene::Matrix identity_matrix = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

/// Returns the number of bytes of a component; zero for types that glTF does not know.
std::size_t component_size(int component_type);

/// Returns a component as a number; normalised integers are not divided.
double component(const Gltf_scene::Column& column, std::size_t row, std::size_t place);

/// Returns ((m0 x + m1 y) + m2 z) + m3 in doubles, for each row m of the matrix.
Point_3 world_position(const Gltf_scene::Matrix& to_world, const Gltf_scene::Column& positions,
                       std::size_t row);

/// Returns the same triangles with a new document: one node for each group, and vertices split where corners
/// differ in texture coordinates or normals. Precondition: coordinates are 32-bit floats.
Triangle_soup with_gltf_scene(const Triangle_soup& soup);

} // namespace files
} // namespace selvedge

#endif // SELVEDGE_SRC_FILES_GLTF_SCENE_H
