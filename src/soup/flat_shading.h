// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_FLAT_SHADING_H
#define SELVEDGE_SRC_SOUP_FLAT_SHADING_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <cstring>
#include <vector>

// PLY and glTF hold one normal for each vertex. So a file that shades flat has a vertex for every normal at a
// corner of the mesh, and different vertices on the two sides of every edge. One that shades smoothly may
// have several vertices where normals differ in their last digits.

namespace selvedge {

/// Whether two arrays of numbers are alike bit for bit; 0 and -0 are not.
template <class Row>
bool have_same_bits(const Row& a, const Row& b)
{
  return std::memcmp(&a, &b, sizeof(Row)) == 0;
}

/// Whether values have the numbers of the vertices, each vertex one.
template <std::size_t dimension>
bool are_numbered_like_vertices(const Corner_values<dimension>& values, const Triangle_soup& soup)
{
  return !values.missing && values.of_triangle == soup.triangles &&
         values.values.size() == soup.points.size();
}

/// Makes triangles share the vertices that differ in nothing but their normals, if these are flat
/// (`has_flat_normals`), and otherwise those whose normals are nearly alike (`are_near_normals`): a program
/// that writes vertices that differ would have written one, but for its arithmetic. Triangles then name the
/// first of such vertices, and the others are unused; vertices keep their numbers, and corners their normals.
/// Vertices that differ in nothing at all become one where they have texture coordinates: there is no seam
/// between surfaces on which shading and texture go on. Without, they stay apart, because pieces may lie
/// beside each other, unless a third one differs from them in its normal, or every face has vertices of its
/// own (`have_faces_own_vertices`).
///
/// Alike, bit for bit, must be position, attributes, and texture coordinates if they are those of vertices;
/// in a glTF scene the node and the rows of all accessors but NORMAL, those of morph targets included; and
/// the position in all poses. Of TANGENT, only the side (w) must be alike, and its direction where vertices
/// that do not shade flat have one normal, bit for bit; where they shade flat, neither need be what morph
/// targets add to NORMAL and TANGENT, unless the normals are one. Where vertices of different tangents become
/// one, the scene alone has tangents then, and not `vertex_attributes`.
///
/// Returns how many corners name another vertex now. Does nothing where a vertex has two normals, unless they
/// are nearly alike, as this leaves them.
///
/// **Complexity** O(n) expected for n triangles and bounded numbers of such vertices at one place.
std::size_t share_split_vertices(Triangle_soup& soup);

/// Returns how many corners name another vertex after vertices were joined.
std::size_t corners_changed(const std::vector<Index_triple>& before, const std::vector<Index_triple>& after);

/// Whether every one of so many triangles has vertices of its own: at least 100 of them, and twice as many
/// vertices, counted as far as they are in use.
bool have_faces_own_vertices(std::size_t triangles, std::size_t vertices);

/// Takes the tangents out of `vertex_attributes` where vertices of different ones have become one: the scene
/// alone holds them then, since other formats have one row for each vertex.
void leave_tangents_to_scene(Triangle_soup& soup);

/// Whether vertices that differed in their tangents are one, so that the scene alone has tangents.
bool has_tangents_in_scene_only(const Triangle_soup& soup);

/// The vertices of a soup as a file holds them that has one normal for each.
struct Vertices_by_normal
{
  struct Vertex
  {
    Index vertex;
    Index normal; ///< the least number among those of this normal at this vertex
  };
  std::vector<Vertex> vertices;        ///< those that triangles use
  std::vector<Index_triple> triangles; ///< indices into `vertices`
};

/// Returns a vertex for each vertex of the soup and each of the normals that it has, bit for bit; `normals`
/// are those of the soup or others in their places. The vertices are in the order of the soup's where each
/// has one normal, else in that of the normals, which is the order of the file before `share_split_vertices`.
///
/// **Complexity** Linear for bounded numbers of normals at a vertex; O(n log n) where some have several.
Vertices_by_normal vertices_by_normal(const Triangle_soup& soup, const Corner_values<3>& normals);

/// Returns the same triangles with vertices that have one normal each. Precondition: the soup has normals,
/// and no glTF scene.
Triangle_soup split_by_normals(const Triangle_soup& soup);

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_FLAT_SHADING_H
