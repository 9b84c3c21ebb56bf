// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_TRIANGLES_OF_PART_H
#define SELVEDGE_SRC_VERIFY_TRIANGLES_OF_PART_H

#include <selvedge/Triangle_soup.h>

#include <fnmatch.h>

#include <algorithm>
#include <string>
#include <vector>

namespace selvedge::internal {

/// Returns whether `name`, in which `*` stands for any characters and `?` for one, is the label or one of its
/// words.
inline bool is_label_or_word(const std::string& label, const std::string& name)
{
  const auto fits = [&](const std::string& text) {
    return text == name ||
           (name.find_first_of("*?") != std::string::npos && fnmatch(name.c_str(), text.c_str(), 0) == 0);
  };
  const char* const blanks = " \t\n\v\f\r";
  if (!name.empty() && fits(label))
    return true;
  for (std::size_t at = label.find_first_not_of(blanks); at != std::string::npos;) {
    const std::size_t end = std::min(label.find_first_of(blanks, at), label.size());
    if (fits(label.substr(at, end - at)))
      return true;
    at = label.find_first_not_of(blanks, end);
  }
  return false;
}

/// Returns one flag per triangle: whether its group, object or material has this name, as a whole or as one
/// of its words, or an attribute of 0 and 1 with this name is 1. It is the judge's own reading of what
/// `triangles_named` promises, except that a name that no triangle has is no error.
inline std::vector<char> triangles_of_part(const Triangle_soup& soup, const std::string& name)
{
  std::vector<char> is_of_part(soup.triangles.size(), false);
  for (const Triangle_labels* labels : {&soup.groups, &soup.objects, &soup.materials}) {
    std::vector<char> is_meant; // by label
    for (const std::string& label : labels->names) {
      // The primitives of a glTF mesh have its name and a number.
      const std::size_t slash = label.find_last_not_of("0123456789");
      const bool is_primitive = soup.scene && labels == &soup.groups && slash != std::string::npos &&
                                label[slash] == '/' && slash + 1 < label.size();
      is_meant.push_back(is_label_or_word(label, name) ||
                         (is_primitive && !name.empty() && label.substr(0, slash) == name));
    }
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
