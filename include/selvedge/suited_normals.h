// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SUITED_NORMALS_H
#define SELVEDGE_SUITED_NORMALS_H

#include <selvedge/Triangle_soup.h>
#include <selvedge/normals.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// Returns, in place of `Normals_choice::automatic`, `loose` for a soup of which hardly any line that normals
/// make would be missed, `soft` for one of which some would not, and the choice as it is for any other.
///
/// Lines that normals make are edges of two triangles across which normals differ, by more than 0.1°, and
/// neither texture coordinates nor labels do. Those that hang together are *hard* if they are at least three
/// edges, across which normals differ by 20° or more (the root of the mean square), and by 45° unless they go
/// on in one way at 70 % of their vertices or more. Nobody sees the others, the *soft* ones, as edges, yet
/// their vertices could only move along them. The choice is `loose` if at most a tenth of the length of all
/// lines is hard. Triangles with two corners at one position are not asked, and there are no such lines where
/// normals are flat, or missing for some triangles.
///
/// **Complexity** O(n) expected for n triangles.
Normals_choice suited_to(const Triangle_soup& soup, Normals_choice choice);

/// What `suit_normals` has found and done.
struct Suited_normals
{
  Normals_choice choice = Normals_choice::automatic; ///< that of `suited_to`
  std::size_t joined_corners = 0;                    ///< by `share_vertices_without_normals`
};

/// Makes a soup from a file ready for the choice that suits it (`suited_to`): where this joins vertices
/// (`joins_vertices`), and the file has one normal for each, triangles share those that differ in their
/// normals alone (`share_vertices_without_normals`). The program and the bindings do this before `prepare`.
///
/// **Complexity** O(n) expected for n triangles.
Suited_normals suit_normals(Triangle_soup& soup, Normals_choice choice, bool has_normals_of_vertices);

/// Returns which vertices are at positions on soft lines that normals make; empty if none is.
///
/// **Complexity** O(n) expected for n triangles.
std::vector<char> are_on_soft_lines(const Triangle_soup& soup);

/// Gives all corners of a vertex on a soft line one normal, the mean of those there, weighted by the angles,
/// in the precision of 32-bit floats, and joins those at others that are nearly alike (`join_near_normals`).
/// Hard lines, and no others, are then lines of normals, where vertices that differ in their normals alone
/// are one (`share_vertices_without_normals`).
///
/// **Complexity** O(n) expected for n triangles.
void loosen_soft_lines(Triangle_soup& soup);

} // namespace selvedge

#endif // SELVEDGE_SUITED_NORMALS_H
