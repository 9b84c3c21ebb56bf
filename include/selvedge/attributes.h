// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_ATTRIBUTES_H
#define SELVEDGE_ATTRIBUTES_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <string>
#include <vector>

namespace selvedge {

/// Leaves out attributes of a mesh, so that no line is kept where nothing else differs, and returns how many
/// corners name another vertex then. A name is one of these:
/// - `texture`: texture coordinates, and in glTF all sets of them, the tangents that follow from them, and
///   the textures of all materials, which would have no place any more, with the images and samplers of these
///   alone (which stay where an extension that is not known here may refer to them);
/// - `colors`: the colours of vertices, in glTF all sets of them, and the colours of faces;
/// - otherwise, the name that an attribute of vertices or faces has in the file, such as `quality` or
///   `TEXCOORD_1`.
///
/// Where a file has one value for each vertex (PLY, glTF), vertices that differ in nothing else become one:
/// triangles name the first of them, and the others are unused. Alike, bit for bit, must be positions in all
/// poses, normals that all corners of a vertex share unless they are flat (`has_flat_normals`), attributes,
/// and texture coordinates if they are numbered like vertices; those with numbers of their own, as in OBJ,
/// join none. Likewise in a glTF scene the node and all accessors, those of morph targets included. Vertices
/// that differ in nothing at all stay apart, as pieces that lie beside each other, unless a third one differs
/// from them in what is left out, or every face has vertices of its own (at least 100 triangles, and twice as
/// many vertices).
///
/// Throws `Input_error` where the mesh has nothing of a name, and `Argument_error` for `POSITION`, `NORMAL`
/// (`Normals_choice::drop`), what a skin needs, and in glTF, which numbers sets from 0 without a gap, for a
/// set such as `TEXCOORD_0` before another one that stays.
///
/// **Complexity** O(n) expected for n corners and bytes of attributes.
std::size_t drop_attributes(Triangle_soup& soup, const std::vector<std::string>& names);

/// How `seams_of_attributes` calls several sets of texture coordinates of a glTF file without the first.
constexpr const char* further_texture_coordinates = "further texture coordinates";

/// Returns the name by which `drop_attributes` leaves out an attribute of this name (`seams_of_attributes`):
/// `colors` for colours, `texture` for further texture coordinates, and itself for others; empty where it
/// leaves none out, as for what a skin needs and for morph targets.
std::string name_to_drop(const std::string& attribute);

} // namespace selvedge

#endif // SELVEDGE_ATTRIBUTES_H
