// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_TRIANGLE_SOUP_H
#define SELVEDGE_MESH_TRIANGLE_SOUP_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace selvedge {

/// The kernel of the compiled part: coordinates are doubles, predicates on them are exact.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_3 = Kernel::Point_3;

/// Number of a vertex, a triangle or an attribute; 0-based, in the order of the file.
using Index = std::uint32_t;
using Index_triple = std::array<Index, 3>;

/// A name for every triangle: its group, its material. Both are empty when the file says none; the empty name
/// is that of triangles for which alone it says none.
struct Triangle_labels
{
  std::vector<Index> of_triangle; ///< indices into `names`
  std::vector<std::string> names;

  bool empty() const { return of_triangle.empty(); }
};

/// Values that corners of triangles refer to by number, as texture coordinates and normals are in OBJ files.
/// All three are empty when the file has none.
template <std::size_t dimension>
struct Corner_values
{
  std::vector<std::array<double, dimension>> values;
  std::vector<Index_triple> of_triangle; ///< for every triangle three indices into `values`

  /// The value that stands for none, in a file that has some but not at every triangle: at all corners of a
  /// triangle or at none. It is finite, and like no other value.
  std::optional<Index> missing = std::nullopt;

  bool empty() const { return of_triangle.empty(); }
};

/// A column of numbers that a file keeps for every vertex or every triangle, as the bytes that it keeps.
struct Attribute
{
  enum class Type : unsigned char { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

  std::string name; ///< as in the file: "red", "quality", "NORMAL", "JOINTS_0"
  Type type = Type::float64;
  std::uint32_t components = 1; ///< numbers in a row
  bool is_normalized = false;   ///< integers stand for fractions of their largest value, as glTF says it
  std::vector<unsigned char>
      rows; ///< one after another, each `components` numbers in the machine's byte order
};

/// What a glTF file says beyond its triangles; opaque.
struct Gltf_scene;

/// A mesh as a file holds it: vertices, triangles that name three of them, and what hangs on both.
///
/// Nothing is assumed of the triangles: a vertex may be unused, several may lie at one position, a triangle
/// may be degenerate, doubled or cross another, more than two may share an edge. Two triangles belong to one
/// *piece* when a chain of triangles joins them in which neighbours share a vertex number.
///
/// **Preconditions** of every function that takes a soup: coordinates are finite; indices are in range; each
/// array of per-triangle data is empty or as long as `triangles`. The readers of mesh_files.h see to it.
struct Triangle_soup
{
  /// One per vertex of the file, used or not.
  std::vector<Point_3> points;

  /// Three indices into `points`, counter-clockwise seen from outside.
  std::vector<Index_triple> triangles;

  /// Texture coordinates, in [0,1]² as a rule, and normals.
  Corner_values<2> uvs;
  Corner_values<3> normals;

  /// Groups and objects, materials, smoothing groups.
  Triangle_labels groups;
  Triangle_labels objects;
  Triangle_labels materials;
  Triangle_labels smoothing_groups;

  /// Whatever else the file keeps for its vertices and its triangles. A colour is the columns `red`, `green`,
  /// `blue` and, where there is one, `alpha`, of one component each; floats are fractions, integers are
  /// marked as normalized. A number that a file has for some vertices only is NaN at the others.
  std::vector<Attribute> vertex_attributes;
  std::vector<Attribute> triangle_attributes;

  /// Where an OBJ file finds its materials, in its own words: a name relative to its folder, or several.
  std::vector<std::string> material_libraries;

  /// What the header of a PLY file says in `comment` and `obj_info`, each with its keyword.
  std::vector<std::string> header_comments;

  /// The glTF file that this was read from, and for every vertex which of its vertices it is; else none, and
  /// empty. A new glTF file is made of both: see mesh_files.h.
  std::shared_ptr<const Gltf_scene> scene;
  std::vector<Index> scene_vertices;
};

} // namespace selvedge

#endif // SELVEDGE_MESH_TRIANGLE_SOUP_H
