// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_PART_NAMES_H
#define SELVEDGE_SRC_VERIFY_PART_NAMES_H

#include <selvedge/Triangle_soup.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace selvedge::internal {

/// The name of a triangle in messages of the judge: its group, else its object, else its material.
class Part_names
{
public:
  explicit Part_names(const Triangle_soup& soup) : m_soup(soup) {}

  std::string of(Index triangle) const
  {
    for (const Triangle_labels* labels : {&m_soup.groups, &m_soup.objects, &m_soup.materials})
      if (!labels->empty() && !labels->names[labels->of_triangle[triangle]].empty())
        return labels->names[labels->of_triangle[triangle]];
    return "";
  }

private:
  const Triangle_soup& m_soup;
};

/// Returns a name without the numbers (`/0`, `#2`) by which the reader tells glTF primitives and nodes of one
/// name apart. They change when a primitive before them is left out.
inline std::string without_numbers(std::string name)
{
  for (const char mark : {'#', '/'}) {
    const std::size_t last = name.find_last_not_of("0123456789");
    if (last != std::string::npos && last > 0 && last + 1 < name.size() && name[last] == mark)
      name.resize(last);
  }
  return name;
}

/// Numbers the names of two meshes in common (groups, objects or materials), so that the judge can compare
/// them.
class Common_names
{
public:
  Common_names(const Triangle_soup& result, const Triangle_labels& of_result, const Triangle_soup& original,
               const Triangle_labels& of_original)
      : m_is_gltf(result.scene || original.scene), m_now(of_result.of_triangle),
        m_before(of_original.of_triangle), m_numbers{{"", 0}}, m_texts{""}
  {
    const auto number = [&](const Triangle_labels& labels) {
      std::vector<Index> numbers;
      for (const std::string& name : labels.names)
        numbers.push_back(number_of(name));
      return numbers;
    };
    const std::vector<Index> numbers_now = number(of_result), numbers_before = number(of_original);
    for (Index& name : m_now)
      name = numbers_now[name];
    for (Index& name : m_before)
      name = numbers_before[name];
    m_is_used_now.resize(m_texts.size());
    m_is_used_before.resize(m_texts.size());
    for (const Index name : m_now)
      m_is_used_now[name] = true;
    for (const Index name : m_before)
      m_is_used_before[name] = true;
  }

  Index now(Index triangle) const { return m_now[triangle]; }
  Index before(Index triangle) const { return m_before[triangle]; }
  const std::string& text(Index name) const { return m_texts[name]; }

  /// How many names there are; their numbers are below.
  std::size_t size() const { return m_texts.size(); }

  /// The number of the empty name.
  Index none() const { return 0; }

  /// Whether some triangles of both have the same name.
  bool is_any_common() const
  {
    for (std::size_t name = 1; name < m_texts.size(); ++name)
      if (m_is_used_now[name] && m_is_used_before[name])
        return true;
    return false;
  }

  /// Whether all triangles of both have the same name.
  bool is_one() const { return m_is_used_now == m_is_used_before && count(m_is_used_now) == 1; }

private:
  static std::size_t count(const std::vector<bool>& used)
  {
    return std::size_t(std::count(used.begin(), used.end(), true));
  }

  Index number_of(const std::string& name)
  {
    const auto [it, is_new] =
        m_numbers.emplace(m_is_gltf ? without_numbers(name) : name, Index(m_texts.size()));
    if (is_new)
      m_texts.push_back(it->first);
    return it->second;
  }

  bool m_is_gltf;
  std::vector<Index> m_now, m_before;
  std::map<std::string, Index> m_numbers;
  std::vector<std::string> m_texts;
  std::vector<bool> m_is_used_now, m_is_used_before;
};

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_PART_NAMES_H
