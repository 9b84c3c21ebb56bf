// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_PARTS_H
#define SELVEDGE_MESH_PARTS_H

#include <selvedge/mesh/Triangle_soup.h>

#include <string>
#include <vector>

namespace selvedge {

/// The parts of a soup that a user may speak of: its pieces, each by a number, and its groups, objects and
/// materials, each by its name in the file. Every triangle belongs to one piece, and to one of each other
/// kind that the file has.
struct Part_kind
{
  enum class Name : unsigned char { piece, group, object, material };

  Name name;
  std::vector<Index> of_triangle; ///< numbers of parts
  std::vector<std::string> names; ///< of the parts; empty for pieces
  Index count = 0;
};

/// "piece", "group", "object", "material".
const char* name(Part_kind::Name kind);

/// The kinds that a soup has, pieces first; those are numbered by their first triangles.
///
/// **Complexity** Linear, as good as.
std::vector<Part_kind> part_kinds(const Triangle_soup& soup);

/// The triangles of the groups, objects and materials of a name, as one flag per triangle. A line `g sleeve
/// left` names a triangle "sleeve left", "sleeve" and "left".
///
/// Throws `Argument_error` that lists the known names when there is no such triangle.
std::vector<char> triangles_named(const Triangle_soup& soup, const std::string& name);

} // namespace selvedge

#endif // SELVEDGE_MESH_PARTS_H
