// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_TEXTURE_H
#define SELVEDGE_SOUP_TEXTURE_H

#include "vertex_normals.h"

#include <selvedge/Triangle_soup.h>
#include <selvedge/internal/Scale.h>

namespace selvedge {

/// Returns the length on the surface that one unit of the texture stands for, divided by the scale. With this
/// unit, the triangles of the texture have in total the same area as the triangles that have a texture. 0
/// when they have no area.
double uv_unit(const Triangle_soup& soup, const Scale& scale = Scale());

/// Returns the length on the surface that a turn of the normal by one radian stands for, divided by the
/// scale: the radius of a curvature like that which the normals tell, on the mean over the area. Slivers, of
/// an aspect ratio below 0.01, do not count. 0 when no normal turns. Normals are at corners, or
/// `of_vertices`.
double normal_unit(const Triangle_soup& soup, const Scale& scale = Scale(),
                   const Vertex_normals* of_vertices = nullptr);

} // namespace selvedge

#endif // SELVEDGE_SOUP_TEXTURE_H
