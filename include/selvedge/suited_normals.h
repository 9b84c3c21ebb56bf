// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SUITED_NORMALS_H
#define SELVEDGE_SUITED_NORMALS_H

#include <selvedge/Triangle_soup.h>
#include <selvedge/normals.h>

namespace selvedge {

/// Returns `Normals_choice::loose` in place of `automatic` for a soup of which hardly any line that normals
/// make would be missed, and the choice as it is for any other. The program and the bindings take this.
///
/// Such lines are edges of two triangles across which normals differ, by more than 0.1°, and neither texture
/// coordinates nor labels do. Those that hang together are *hard* if they are at least three edges, across
/// which normals differ by 20° or more (the root of the mean square), and by 45° unless they go on in one way
/// at 70 % of their vertices or more. Nobody sees the others as edges, yet their vertices could only move
/// along them. The choice is `loose` if at most a tenth of the length of all lines is hard.
/// Triangles with two corners at one position are not asked.
///
/// **Complexity** O(n) expected for n triangles.
Normals_choice suited_to(const Triangle_soup& soup, Normals_choice choice);

} // namespace selvedge

#endif // SELVEDGE_SUITED_NORMALS_H
