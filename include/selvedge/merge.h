// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MERGE_H
#define SELVEDGE_MERGE_H

#include <selvedge/Triangle_soup.h>

namespace selvedge {

/// Returns a soup in which the vertices at one position, in all poses, have one number, the first of theirs,
/// so that pieces that meet there are connected. Vertices whose vertex attributes differ keep numbers of
/// their own. Vertices that are no longer used are dropped.
///
/// Neither the triangles nor their order nor any coordinate changes, except that −0 may become 0. A soup that
/// was read from glTF is returned as it is, because its vertices are rows of accessors.
Triangle_soup merged_at_positions(const Triangle_soup& soup);

} // namespace selvedge

#endif // SELVEDGE_MERGE_H
