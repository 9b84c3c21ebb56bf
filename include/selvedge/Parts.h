// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_PARTS_H
#define SELVEDGE_PARTS_H

#include <selvedge/Triangle_soup.h>

#include <string>
#include <utility>
#include <vector>

namespace selvedge {

/// One way in which a soup is divided into parts that a user can refer to: its pieces, each by a number, or
/// its groups, objects or materials, each by its name in the file. Every triangle belongs to exactly one part
/// of each kind that the file has.
struct Part_kind
{
  enum class Name : unsigned char { piece, group, object, material };

  Name name = Name::piece;
  std::vector<Index> of_triangle; ///< for every triangle, the number of its part
  std::vector<std::string> names; ///< names of the parts, by number; empty for pieces
  Index count = 0;                ///< number of parts
};

/// Returns "piece", "group", "object" or "material".
const char* name(Part_kind::Name kind);

/// Returns the kinds of parts that a soup has, pieces first. Pieces are numbered in the order of their first
/// triangles.
///
/// **Complexity** Almost linear.
std::vector<Part_kind> part_kinds(const Triangle_soup& soup);

/// Returns one flag per triangle: whether its group, object or material has this name. A label of several
/// words can be given as a whole or by one of its words: after the line `g sleeve left`, triangles have the
/// names "sleeve left", "sleeve" and "left". In the name, `*` stands for any characters and `?` for one, as
/// in names of files: "button*" names all of "button_1" to "button_12". In a soup that was read from glTF,
/// the groups are primitives, called "head/0", "head/1" and so on where a mesh has several, and "head" names
/// all of these. A triangle attribute of the type uint8 that is 0 or 1 for every triangle, such as a property
/// of the faces of a PLY file, names those with 1, of which there may be none.
///
/// Throws `Argument_error`, which lists the known names, when neither a triangle nor an attribute has this
/// name.
std::vector<char> triangles_named(const Triangle_soup& soup, const std::string& name);

/// Returns the names of the two parts in each of some texts of the form A:B. A name may have a `:` of its
/// own: the text is split where both sides name parts of the soup (`triangles_named`).
///
/// Throws `Argument_error` when a text has no `:`, or can be split so in no way, or in several. The message
/// begins with the name of the option that the texts are from.
std::vector<std::pair<std::string, std::string>>
parts_in_pairs(const Triangle_soup& soup, const std::vector<std::string>& texts, const std::string& option);

} // namespace selvedge

#endif // SELVEDGE_PARTS_H
