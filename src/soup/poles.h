// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_POLES_H
#define SELVEDGE_SRC_SOUP_POLES_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <map>
#include <optional>

// glTF holds one pair of texture coordinates for each vertex. At a pole, as of a sphere, every face has its
// own, so that the file has a vertex there for each face: as many slits as faces, each one edge long.

namespace selvedge {

/// Makes triangles of a glTF scene share the vertices at *poles*: positions with at least three edges across
/// which texture coordinates differ there and at the other end, a vertex of both faces, do not. Such faces
/// then name the first of their vertices at the pole, if these differ in nothing but texture coordinates,
/// normals and tangents, also of morph targets, and if texture coordinate and normal tell their rows from all
/// others. The others are unused, vertices keep their numbers, and corners their texture coordinates and
/// normals, as in OBJ.
///
/// Where vertices of different tangents become one, the scene alone has tangents then, and not
/// `vertex_attributes`. Returns how many corners name another vertex now. Does nothing to a soup without
/// scene, or with poses.
///
/// **Complexity** O(n log n) for n triangles.
std::size_t share_poles(Triangle_soup& soup);

/// Undoes `share_poles`, as far as the soup has the vertices of the scene that corners then need.
void separate_poles(Triangle_soup& soup);

/// Returns, for each corner (3 t + k) whose texture coordinates are not those that the scene has for its
/// vertex, the vertex of the scene that has them and differs in nothing else but normal and tangent, if there
/// is one. Empty for a soup without scene.
///
/// **Complexity** O(n) expected for n triangles, and bounded numbers of vertices at a position.
std::map<Index, Index> scene_vertices_of_corners(const Triangle_soup& soup);

/// Returns the soup with a vertex of the scene at each corner, as far as `scene_vertices_of_corners` knows
/// them, as writers need it; none where this is the soup itself. New vertices come last.
std::optional<Triangle_soup> with_split_poles(const Triangle_soup& soup);

/// Returns the soup with texture coordinates that are numbered like its vertices, for formats that hold them
/// so: vertices are split as in `with_split_poles`. None where this is the soup itself, or where a vertex
/// still has several.
std::optional<Triangle_soup> with_uvs_of_vertices(const Triangle_soup& soup);

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_POLES_H
