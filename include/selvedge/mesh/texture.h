// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_TEXTURE_H
#define SELVEDGE_MESH_TEXTURE_H

#include <selvedge/mesh/Scale.h>
#include <selvedge/mesh/Triangle_soup.h>

namespace selvedge {

/// The length on the surface that one unit of the texture stands for: that with which the triangles of the
/// texture have, all in all, the area of the surface. 0 when they have none. Divided by the scale.
double uv_unit(const Triangle_soup& soup, const Scale& scale = Scale());

} // namespace selvedge

#endif // SELVEDGE_MESH_TEXTURE_H
