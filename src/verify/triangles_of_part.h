// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_TRIANGLES_OF_PART_H
#define SELVEDGE_SRC_VERIFY_TRIANGLES_OF_PART_H

#include <selvedge/Triangle_soup.h>

#include <algorithm>
#include <string>
#include <vector>

namespace selvedge::internal {

/// Returns one flag per triangle: whether its group, object or material has this name, as a whole or as one
/// of its words, or an attribute of 0 and 1 with this name is 1. It is the judge's own reading of what
/// `triangles_named` promises, except that a name that no triangle has is no error.
inline std::vector<char> triangles_of_part(const Triangle_soup& soup, const std::string& name)
{
  // Blanks around both make a word of a whole name, too.
  const auto with_blanks = [](std::string text) {
    for (char& c : text)
      if (c == '\t' || c == '\n' || c == '\v' || c == '\f' || c == '\r')
        c = ' ';
    return ' ' + text + ' ';
  };
  const bool is_word = name.find_first_of(" \t\n\v\f\r") == std::string::npos;
  std::vector<char> is_of_part(soup.triangles.size(), false);
  for (const Triangle_labels* labels : {&soup.groups, &soup.objects, &soup.materials}) {
    std::vector<char> is_meant; // by label
    for (const std::string& label : labels->names)
      is_meant.push_back(
          !name.empty() &&
          (label == name || (is_word && with_blanks(label).find(with_blanks(name)) != std::string::npos)));
    for (std::size_t t = 0; t < labels->of_triangle.size(); ++t)
      is_of_part[t] |= is_meant[labels->of_triangle[t]];
  }
  for (const Attribute& attribute : soup.triangle_attributes)
    if (attribute.name == name && !name.empty() && attribute.type == Attribute::Type::uint8 &&
        attribute.rows.size() == is_of_part.size() && // of one component
        std::none_of(attribute.rows.begin(), attribute.rows.end(), [](unsigned char r) { return r > 1; }))
      for (std::size_t t = 0; t < is_of_part.size(); ++t)
        is_of_part[t] |= char(attribute.rows[t]);
  return is_of_part;
}

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_TRIANGLES_OF_PART_H
