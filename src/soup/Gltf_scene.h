// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_GLTF_SCENE_H
#define SELVEDGE_SOUP_GLTF_SCENE_H

#include <selvedge/Triangle_soup.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace selvedge {

/// What `read_gltf` keeps of a file, so that `write_gltf` can put the reduced triangles back: the document
/// without the vertices and indices of the triangles in the soup, and these apart, as their bytes. Everything
/// else in the document is unchanged, numbers of accessors and buffer views included.
struct Gltf_scene
{
  using Json = nlohmann::ordered_json;
  using Matrix = std::array<std::array<double, 4>, 3>; ///< its fourth row is 0 0 0 1

  static constexpr Matrix identity_matrix = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  /// How KHR_draco_mesh_compression held a column.
  struct Compression
  {
    struct Quantisation
    {
      int bits = 0;
      std::vector<float> origin; ///< empty where the column was quantised as directions
      float range = 0;

      /// The number of steps in the range, and what Draco makes of one of them.
      float steps() const { return float((1u << bits) - 1); }
      double number_at(double step, std::size_t component) const
      {
        return float(step) * (range / steps()) + origin[component];
      }
      /// Returns the step nearest to a number, which may be beyond the range.
      double step_at(double number, std::size_t component) const
      {
        return std::round((number - origin[component]) / (range / steps()));
      }
    };
    std::optional<Quantisation> quantisation; ///< none where no bit was lost
  };

  /// Where the first row of an accessor is in a buffer view of the file, and how far its rows are apart.
  struct Place_in_view
  {
    Index view = 0;
    std::size_t offset = 0, stride = 0;
  };

  /// The rows of an accessor, without gaps and with its sparse values in place.
  struct Column
  {
    std::string name; ///< "POSITION"
    Json accessor;    ///< what the document says about it, apart from where its bytes are
    int component_type = 0;
    std::size_t components = 0;
    std::size_t row_size = 0;
    std::string rows;
    bool is_sparse = false;                                ///< the file holds only rows that are not zero
    std::optional<Compression> compression = std::nullopt; ///< none where the file held it plain
    /// Of floats that the file holds as whole numbers by KHR_mesh_quantization: what it says about those.
    std::optional<Json> quantised_accessor = std::nullopt;
    std::optional<Place_in_view> place = std::nullopt; ///< none where it is in no view, or in one of its own

    bool is_normalized() const { return accessor.value("normalized", false); }

    /// Returns the bytes of a row.
    std::string_view row(std::size_t number) const
    {
      return std::string_view(rows).substr(number * row_size, row_size);
    }

    /// Returns what a component can be, near a number, such that the file can hold the column as it did: in
    /// whole numbers, or quantised by Draco. Returns the number where neither is so.
    double nearest_quantised(double number, std::size_t component) const;

    /// Returns the same column without its rows.
    Column without_rows() const
    {
      return {name, accessor,  component_type, components,         row_size,
              {},   is_sparse, compression,    quantised_accessor, place};
    }
  };

  /// A buffer view as EXT_meshopt_compression held it.
  struct Meshopt_view
  {
    Json extension;
    std::string bytes;
  };

  /// Vertices that several primitives of a mesh may share. The first of the attributes is the position.
  struct Block
  {
    Index size = 0;
    std::vector<Column> attributes;
    std::vector<std::vector<Column>> targets;

    /// Returns the column of the normals; null where there is none of three components.
    const Column* normals() const { return find(*this, "NORMAL", 3); }

    /// Returns the column of the tangents; null where there is none of four components.
    const Column* tangents() const { return find(*this, "TANGENT", 4); }
    Column* tangents() { return find(*this, "TANGENT", 4); }

  private:
    template <class Block_or_const>
    static auto find(Block_or_const& block, const char* name, std::size_t components)
        -> decltype(block.attributes.data())
    {
      for (auto& column : block.attributes)
        if (column.name == name && column.components == components)
          return &column;
      return nullptr;
    }
  };

  /// A block in a node: a range of the vertices of the soup that was read.
  struct Instance
  {
    Index block = 0;
    Index first = 0;
    Matrix to_world = {};
    bool is_mirrored = false; ///< `to_world` turns the triangles over
    Index node = 0;
    Matrix in_node = identity_matrix; ///< that of an instance of EXT_mesh_gpu_instancing
  };

  /// A primitive in a node: a group of the soup. No two nodes share a mesh; those that do in the file have
  /// copies of it.
  struct Part
  {
    Index mesh = 0;
    Index mesh_of_file = 0; ///< of which `mesh` is a copy, or the mesh itself
    Index first_alike = 0;  ///< the first mesh of the file with the same accessors, or `mesh_of_file` itself
    Index primitive = 0;
    Index instance = 0;
    int index_type = 0;               ///< component type of the indices, 0 when there are none
    Json index_json = Json::object(); ///< what the document says about their accessor, likewise
    std::optional<Place_in_view> index_place = std::nullopt;
  };

  /// A node with EXT_mesh_gpu_instancing, and a node for each of its instances, which would be its child. The
  /// document has the mesh of the first of them for the node itself.
  struct Instanced_node
  {
    Index node = 0;
    std::vector<Json> instances;
  };

  /// A node of the scene.
  struct Placed_node
  {
    Index node = 0;
    std::optional<Index> parent; ///< none at a root
  };

  /// Returns the number of the instance that a vertex of the scene belongs to.
  std::size_t instance_of(Index scene_vertex) const;

  Json document;
  std::vector<std::string> views;              ///< the bytes of every buffer view, unless it is free
  std::map<Index, Meshopt_view> meshopt_views; ///< those that EXT_meshopt_compression held
  std::vector<Index> free_views;               ///< numbers that nothing refers to any more
  std::vector<Index> free_accessors;           ///< likewise
  std::vector<Block> blocks;
  std::vector<Instance> instances;
  std::vector<Part> parts; ///< those of one mesh follow each other
  std::vector<Instanced_node> instanced_nodes;
  std::vector<Placed_node> placed_nodes; ///< parents before their children
  std::vector<std::string> only_in_gltf; ///< names of what no other format holds
  /// What the file held in a way that may take less space than what writers make of it, and how often.
  std::map<std::string, std::size_t> compact;
};

/// Under this name, the `extras` of a document and of its primitives hold the lists of a progressive file
/// (progressive.h).
inline constexpr const char* progressive_extras = "selvedge_progressive";

enum Component_type {
  type_int8 = 5120,
  type_uint8,
  type_int16,
  type_uint16,
  type_uint32 = 5125,
  type_float32
};

constexpr Gltf_scene::Matrix identity_matrix = Gltf_scene::identity_matrix;

/// Whether the name of an attribute begins with this, as those of numbered sets do: `TEXCOORD_`.
inline bool begins_with(const std::string& name, const char* start)
{
  return name.rfind(start, 0) == 0;
}

/// Returns the number of bytes of a component; zero for types that glTF does not know.
std::size_t component_size(int component_type);

/// Returns a column of vectors without rows.
Gltf_scene::Column empty_column(const std::string& name, int component_type, std::size_t components,
                                bool is_normalized = false);

/// Returns the type of an attribute with such components, one that glTF knows.
Attribute::Type attribute_type(int component_type);

/// Appends a number to rows, in the byte order of glTF.
template <class Number>
void append_little_endian(std::string& rows, Number number)
{
  std::conditional_t<sizeof number == 4, std::uint32_t,
                     std::conditional_t<sizeof number == 2, std::uint16_t, std::uint8_t>>
      bits;
  std::memcpy(&bits, &number, sizeof bits);
  for (std::size_t i = 0; i < sizeof bits; ++i)
    rows += static_cast<char>(bits >> (8 * i) & 0xff);
}

/// What a vertex has in a row of its block, apart from its normal, as bytes.
struct Row_bytes
{
  std::string others;  ///< all but what the members below hold
  std::string side;    ///< of its tangent: the sign that says whether the texture is mirrored
  std::string tangent; ///< the direction of its tangent
  std::string targets; ///< what morph targets add to its normal and its tangent
};

Row_bytes bytes_of_row(const Gltf_scene::Block& block, std::size_t row);

/// Returns a component as a number; normalised integers are not divided.
double component(const Gltf_scene::Column& column, std::size_t row, std::size_t place);

/// Returns what a component stands for: normalised integers are fractions of the largest one, -1 at least.
double normalised(const Gltf_scene::Column& column, std::size_t row, std::size_t place);

/// Returns what a component stands for as a texture coordinate: integers are fractions of their largest
/// value.
double fraction(Attribute::Type type, double number);

/// Returns the texture coordinates in a row of a column of two components. The second one points down in
/// glTF, up in a soup.
std::array<double, 2> texture_coordinates(const Gltf_scene::Column& column, std::size_t row);

/// Whether two vertices at one position may part when morph targets or bones move. Never without a scene.
bool may_part(const Triangle_soup& soup, Index a, Index b);

} // namespace selvedge

#endif // SELVEDGE_SOUP_GLTF_SCENE_H
