// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_RANDOM_CHANGES_H
#define SELVEDGE_TEST_WORLDS_RANDOM_CHANGES_H

#include "Random.h"

#include <selvedge/Triangle_soup.h>

#include <string>

// What is done to the soup of a scene, and put beside it.

namespace selvedge::test {

/// Spoils some of a soup: drops, doubles and turns triangles, splits, joins and moves vertices, adds
/// triangles without an area and vertices without a triangle.
void spoil(Triangle_soup& soup, Random& random);

/// Divides some triangles at a side, and fills the T-junctions with triangles without an area.
void add_needles(Triangle_soup& soup, Random& random);

/// Adds doubles: triangles with the same three positions as others, of some, of half or of all triangles,
/// once or twice, with their vertices or with others in the same places, turned over or not.
void add_doubles(Triangle_soup& soup, Random& random);

/// Puts points elsewhere: scaled, far from the origin, on the other side, sheared, at distances of units in
/// the last place, between 32-bit floats, with zeros of either sign. Returns what was done.
std::string displace(Triangle_soup& soup, Random& random);

/// Groups, objects, materials, texture coordinates, normals, and weights `w` of vertices, as an OBJ file
/// holds them.
void decorate(Triangle_soup& soup, Random& random);

/// Gives vertices colours, which differ much and do not follow the shape.
void paint(Triangle_soup& soup);

/// Makes poles of some vertices: the triangles there have texture coordinates, normals or vertices of their
/// own, all of them or a few.
void add_poles(Triangle_soup& soup, Random& random);

/// Normals, and vertex attributes red, green, blue and alpha that are numbers of tangents. Some triangles
/// have vertices of their own, on the other side of a mirrored texture: their alpha is 0, as no colour in a
/// file is negative.
void add_tangents_as_colours(Triangle_soup& soup, Random& random);

/// Gives tangents that were colours in a glTF scene the side -1 where alpha was 0.
void make_sides_of_alpha(Triangle_soup& soup);

/// Puts the vertices of a glTF scene, and their texture coordinates, on the steps of a quantisation by Draco,
/// as which the scene is written.
void quantise(Triangle_soup& soup, Random& random);

/// An attribute of triangles, of one byte each, as a PLY file holds it: the same in two regions, or anyhow.
void number_triangles(Triangle_soup& soup, Random& random);

/// Something beside, under, in or at a soup that stands in its way.
Triangle_soup random_obstacle(const Triangle_soup& soup, Random& random);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_RANDOM_CHANGES_H
