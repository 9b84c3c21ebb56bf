// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_SELECTION_H
#define SELVEDGE_MESH_SELECTION_H

#include <selvedge/mesh/Triangle_soup.h>

#include <vector>

namespace selvedge {

/// A soup made of corners of another: triangle i has the labels and attributes of `triangles[i]`, and its
/// corners are `corners[i]`, each 3 × triangle + place in it, with all that hangs on them.
///
/// Of vertices, texture coordinates and normals those still used are left, in their order; every number is
/// copied bit for bit. The names of labels stay as they are, used or not.
///
/// **Complexity** Linear.
Triangle_soup selected(const Triangle_soup& soup, const std::vector<Index>& triangles,
                       const std::vector<Index_triple>& corners);

/// Leaves only some triangles of a soup, in the order given, with all that hangs on them; vertices and values
/// keep their numbers, used or not.
void keep_triangles(Triangle_soup& soup, const std::vector<Index>& triangles);

/// The bytes of one row of an attribute.
std::size_t row_size(const Attribute& attribute);

} // namespace selvedge

#endif // SELVEDGE_MESH_SELECTION_H
