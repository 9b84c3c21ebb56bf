// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Parts.h>

#include "Disjoint_sets.h"
#include "selection.h"

#include <selvedge/Error.h>

#include <fnmatch.h>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

namespace selvedge {

using internal::Disjoint_sets;

namespace {

Part_kind pieces_of(const Triangle_soup& soup)
{
  Disjoint_sets sets(soup.points.size());
  for (const auto& [a, b, c] : soup.triangles) {
    sets.unite(a, b);
    sets.unite(b, c);
  }
  Part_kind pieces{Part_kind::Name::piece, {}, {}, 0};
  constexpr Index none = std::numeric_limits<Index>::max();
  std::vector<Index> numbers(soup.points.size(), none); // by root
  pieces.of_triangle.reserve(soup.triangles.size());
  for (const Index_triple& triangle : soup.triangles) {
    Index& number = numbers[sets.find(triangle[0])];
    if (number == none)
      number = pieces.count++;
    pieces.of_triangle.push_back(number);
  }
  return pieces;
}

/// Whether the text is the name, or fits it if this has wildcards.
bool fits(const std::string& text, const std::string& name)
{
  return text == name ||
         (name.find_first_of("*?") != std::string::npos && fnmatch(name.c_str(), text.c_str(), 0) == 0);
}

bool has_word(const std::string& text, const std::string& word)
{
  std::istringstream words(text);
  for (std::string next; words >> next;)
    if (fits(next, word))
      return true;
  return false;
}

/// Whether the text is the name, a slash, and a number.
bool is_numbered(const std::string& text, const std::string& name)
{
  return text.size() > name.size() + 1 && text.compare(0, name.size(), name) == 0 &&
         text[name.size()] == '/' &&
         text.find_first_not_of("0123456789", name.size() + 1) == std::string::npos;
}

/// Whether the attribute says yes (1) or no (0) of every triangle.
bool is_flag(const Attribute& attribute)
{
  return attribute.components == 1 && attribute.type == Attribute::Type::uint8 &&
         std::all_of(attribute.rows.begin(), attribute.rows.end(),
                     [](unsigned char flag) { return flag <= 1; });
}

} // namespace

const char* name(Part_kind::Name kind)
{
  switch (kind) {
  case Part_kind::Name::piece:
    return "piece";
  case Part_kind::Name::group:
    return "group";
  case Part_kind::Name::object:
    return "object";
  case Part_kind::Name::material:
    return "material";
  }
  return "";
}

std::vector<Part_kind> part_kinds(const Triangle_soup& soup)
{
  std::vector<Part_kind> kinds;
  kinds.push_back(pieces_of(soup));
  for_each_label(soup, [&](Part_kind::Name kind, const Triangle_labels& labels) {
    if (!labels.empty())
      kinds.push_back({kind, labels.of_triangle, labels.names, Index(labels.names.size())});
  });
  return kinds;
}

std::vector<char> triangles_named(const Triangle_soup& soup, const std::string& name)
{
  std::vector<char> is_named(soup.triangles.size(), false);
  std::set<std::string> known;
  for_each_label(soup, [&](Part_kind::Name kind, const Triangle_labels& labels) {
    const bool are_primitives = soup.scene && kind == Part_kind::Name::group;
    std::vector<char> is_meant;
    for (const std::string& label : labels.names)
      is_meant.push_back(!name.empty() && (fits(label, name) || has_word(label, name) ||
                                           (are_primitives && is_numbered(label, name))));
    std::vector<char> is_used(labels.names.size(), false);
    for (std::size_t t = 0; t < labels.of_triangle.size(); ++t) {
      is_named[t] |= is_meant[labels.of_triangle[t]];
      is_used[labels.of_triangle[t]] = true;
    }
    for (std::size_t i = 0; i < is_used.size(); ++i)
      if (is_used[i])
        known.insert(labels.names[i]);
  });
  bool is_known = false;
  for (const Attribute& attribute : soup.triangle_attributes)
    if (!attribute.name.empty() && is_flag(attribute)) {
      known.insert(attribute.name);
      is_known |= attribute.name == name;
      for (std::size_t t = 0; t < is_named.size() && attribute.name == name; ++t)
        is_named[t] |= char(attribute.rows[t]);
    }
  if (is_known || std::find(is_named.begin(), is_named.end(), true) != is_named.end())
    return is_named;
  known.erase("");
  std::string list;
  for (const std::string& label : known)
    list += (list.empty() ? "" : ", ") + label;
  throw Argument_error("no group, object or material is called '" + name + "'; " +
                       (list.empty() ? "the mesh names none" : "there are " + list));
}

std::vector<std::pair<std::string, std::string>>
parts_in_pairs(const Triangle_soup& soup, const std::vector<std::string>& texts, const std::string& option)
{
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& text : texts) {
    const auto fail = [&](const std::string& why) {
      throw Argument_error(option + ": '" + text + "': " + why);
    };
    std::vector<std::pair<std::string, std::string>> found;
    std::string unknown = "this is not of the form PART:PART";
    for (std::size_t colon = text.find(':'); colon != std::string::npos; colon = text.find(':', colon + 1)) {
      const std::pair<std::string, std::string> names{text.substr(0, colon), text.substr(colon + 1)};
      try {
        triangles_named(soup, names.first);
        triangles_named(soup, names.second);
        found.push_back(names);
      } catch (const Argument_error& error) {
        unknown = error.what();
      }
    }
    if (found.empty())
      fail(unknown);
    if (found.size() > 1)
      fail("this may be '" + found[0].first + "' and '" + found[0].second + "', or '" + found[1].first +
           "' and '" + found[1].second + "'; rename a part");
    pairs.push_back(found.front());
  }
  return pairs;
}

} // namespace selvedge
