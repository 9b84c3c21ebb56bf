// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_SELECTION_H
#define SELVEDGE_SOUP_SELECTION_H

#include <selvedge/Parts.h>
#include <selvedge/Triangle_soup.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace selvedge {

/// Returns a soup made of corners of another. Triangle i has the labels and attributes of `triangles[i]`. Its
/// corners are `corners[i]`, each 3 × triangle + place in it, with their vertices, texture coordinates and
/// normals.
///
/// Vertices, texture coordinates and normals that are still used keep their order, and the others are
/// dropped. A polygon stays one when all its triangles are there with the corners that they had, one after
/// another. Every number is copied bit for bit. The names of labels stay as they are, used or not.
///
/// **Complexity** Linear; O(log p) more for every triangle where there are p polygons.
Triangle_soup selected(const Triangle_soup& soup, const std::vector<Index>& triangles,
                       const std::vector<Index_triple>& corners);

/// Returns values for corners, of which each triangle has those of these numbers. Values that are used keep
/// their order, and the others are dropped; so is the one that stands for none, if no triangle has it.
///
/// **Complexity** Linear.
template <std::size_t dimension>
Corner_values<dimension> with_used(const std::vector<std::array<double, dimension>>& values,
                                   std::vector<Index_triple> of_triangle, std::optional<Index> missing);

/// Keeps only some triangles of a soup, in the order given, with all their labels and attributes. Vertices
/// and values keep their numbers, used or not. A polygon stays one when all its triangles do.
void keep_triangles(Triangle_soup& soup, const std::vector<Index>& triangles);

/// Returns whether each vertex is a corner of a triangle.
std::vector<char> are_used(const Triangle_soup& soup);

/// Returns how many vertices are.
std::size_t count_of_used_vertices(const Triangle_soup& soup);

/// Forgets the polygons with a vertex that is not at its place in `points_before`.
void forget_moved_polygons(Triangle_soup& soup, const std::vector<Point_3>& points_before);

/// Calls function(kind, labels) with the labels that a soup may have, in the order of `part_kinds`.
template <class Function>
void for_each_label(const Triangle_soup& soup, const Function& function)
{
  function(Part_kind::Name::group, soup.groups);
  function(Part_kind::Name::object, soup.objects);
  function(Part_kind::Name::material, soup.materials);
}

/// Returns the number of bytes in one row of an attribute.
std::size_t row_size(const Attribute& attribute);

/// Returns the bytes of one row of an attribute.
std::string_view row_of(const Attribute& attribute, Index row);

/// Appends a row of an attribute to rows of the same size.
void append_row(std::vector<unsigned char>& rows, const Attribute& from, Index row);

} // namespace selvedge

#endif // SELVEDGE_SOUP_SELECTION_H
