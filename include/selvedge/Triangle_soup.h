// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TRIANGLE_SOUP_H
#define SELVEDGE_TRIANGLE_SOUP_H

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

/// The number of a vertex, a triangle or an attribute value: 0-based, in the order of the file.
using Index = std::uint32_t;
using Index_triple = std::array<Index, 3>;

/// A name for every triangle, such as its group or its material. Both members are empty when the file names
/// none. When it names some, triangles without a name have the empty name.
struct Triangle_labels
{
  std::vector<Index> of_triangle; ///< for every triangle an index into `names`
  std::vector<std::string> names;

  bool empty() const { return of_triangle.empty(); }
};

/// Values to which the corners of triangles refer by number, as they do to texture coordinates and normals in
/// OBJ files. All members are empty when the file has no such values.
template <std::size_t dimension>
struct Corner_values
{
  std::vector<std::array<double, dimension>> values;
  std::vector<Index_triple> of_triangle; ///< for every triangle three indices into `values`

  /// The number of the value that stands for "none", when some triangles have values and others do not. A
  /// triangle has values at all of its corners or at none. The value is finite, and unlike all others.
  std::optional<Index> missing = std::nullopt;

  bool empty() const { return of_triangle.empty(); }

  /// Whether the corners of a triangle have values.
  bool has(std::size_t triangle) const { return !empty() && of_triangle[triangle][0] != missing; }
};

/// A column of numbers that a file keeps for every vertex or every triangle, in the type in which it keeps
/// them.
struct Attribute
{
  enum class Type : unsigned char { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

  std::string name; ///< as in the file: "red", "quality", "NORMAL", "JOINTS_0"
  Type type = Type::float64;
  std::uint32_t components = 1; ///< numbers per row
  bool is_normalized = false;   ///< integers stand for fractions of their largest value, as in glTF

  /// All rows, one after another, each of `components` numbers in the machine's byte order.
  std::vector<unsigned char> rows;
};

/// A face of more than three corners that a reader has cut into triangles: two fewer than it has corners, one
/// after another.
struct Cut_polygon
{
  Index first_triangle = 0;
  Index corners = 0; ///< how many it has
  Index start = 0; ///< its first corner: 3 × triangle + place in it, counting triangles from `first_triangle`
};

/// Other places of the vertices of a mesh: a frame of a simulation, a skeleton's posture, a morph target.
struct Pose
{
  std::string name;            ///< for messages and for the names of files, such as "frame_0012"
  std::vector<Point_3> points; ///< one per vertex of the mesh
  float time = 0;              ///< in a point cache: when it is, in seconds or frames
};

/// What a glTF file holds beyond its triangles. Opaque.
struct Gltf_scene;

/// A mesh as a file holds it: vertices, triangles that name three of them, and the attributes of both.
///
/// Nothing is assumed about connectivity or shape. A vertex may be unused, and several vertices may lie at
/// one position. A triangle may be degenerate, doubled, or cross another, and more than two triangles may
/// share an edge. Two triangles belong to one *piece* when a chain of triangles connects them in which
/// neighbours share a vertex number.
///
/// **Preconditions** of every function that takes a soup: coordinates are finite; indices are in range; each
/// array of per-triangle data is empty or as long as `triangles`. The readers of mesh_files.h ensure this,
/// and `prepare`, `write_mesh` and the judge check it.
struct Triangle_soup
{
  /// One per vertex of the file, used or not.
  std::vector<Point_3> points;

  /// Three indices into `points`, counter-clockwise seen from outside.
  std::vector<Index_triple> triangles;

  /// Further poses of the mesh; `points` is its first one. See poses.h.
  std::vector<Pose> poses;

  /// Texture coordinates, usually in [0,1]², and normals.
  Corner_values<2> uvs;
  Corner_values<3> normals;

  /// Groups and objects, materials, smoothing groups.
  Triangle_labels groups;
  Triangle_labels objects;
  Triangle_labels materials;
  Triangle_labels smoothing_groups;

  /// Everything else that the file keeps for its vertices and its triangles. A colour is a set of columns
  /// with one component each: `red`, `green`, `blue` and, where there is one, `alpha`. Colours in floating
  /// point are fractions; colours in integers are marked as normalized. Where a file has a number for some
  /// vertices only, the others have NaN.
  std::vector<Attribute> vertex_attributes;
  std::vector<Attribute> triangle_attributes;

  /// The faces of the file that had more than three corners, in ascending order, as far as all their
  /// triangles are here as they were cut. A file gets them as they were, where that changes no triangle; see
  /// mesh_files.h. Without this list it gets the triangles.
  std::vector<Cut_polygon> polygons;

  /// The material libraries of an OBJ file, one entry per `mtllib` statement, in its own words: the name of a
  /// file relative to the folder of the OBJ file, or several names.
  std::vector<std::string> material_libraries;

  /// The `comment` and `obj_info` lines in the header of a PLY file, each with its keyword.
  std::vector<std::string> header_comments;

  /// The glTF file that this soup was read from, and for every vertex its number among the vertices of that
  /// file. Null and empty when the soup was read from another format. A new glTF file is made from both: see
  /// mesh_files.h.
  std::shared_ptr<const Gltf_scene> scene;
  std::vector<Index> scene_vertices;
};

} // namespace selvedge

#endif // SELVEDGE_TRIANGLE_SOUP_H
