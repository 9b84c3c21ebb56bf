// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_COLUMNS_H
#define SELVEDGE_SRC_FILES_COLUMNS_H

#include "soup/with_number.h"
#include <selvedge/Triangle_soup.h>

#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>

// Access to the numbers of attributes, which readers store and writers write as bytes of their own types.

namespace selvedge::files {

template <class Number>
void append_number(std::vector<unsigned char>& rows, Number number)
{
  const std::size_t size = rows.size();
  rows.resize(size + sizeof number);
  std::memcpy(rows.data() + size, &number, sizeof number);
}

/// One component of an attribute, row by row.
struct Attribute_component
{
  const Attribute* attribute = nullptr;
  std::size_t component = 0;

  /// Calls `function(number)` with the number in a row, in the type that it has.
  template <class Function>
  decltype(auto) with(std::size_t row, const Function& function) const
  {
    return with_number(attribute->type, [&](auto number) -> decltype(auto) {
      std::memcpy(&number, attribute->rows.data() + (row * attribute->components + component) * sizeof number,
                  sizeof number);
      return function(number);
    });
  }

  /// Returns the number in a row as a double; a fraction where the attribute is normalized.
  double real(std::size_t row) const
  {
    return with(row, [this](auto number) {
      using Number = decltype(number);
      const double value = static_cast<double>(number);
      return attribute->is_normalized && std::is_integral_v<Number>
                 ? value / static_cast<double>(std::numeric_limits<Number>::max())
                 : value;
    });
  }
};

/// Returns the attribute of one component that has this name.
inline std::optional<Attribute_component> find_column(const std::vector<Attribute>& attributes,
                                                      std::string_view name)
{
  for (const Attribute& attribute : attributes)
    if (attribute.name == name && attribute.components == 1)
      return Attribute_component{&attribute, 0};
  return std::nullopt;
}

/// Returns red, green, blue and, where there is one, alpha; nothing when the vertices have no colours.
inline std::vector<Attribute_component> find_colours(const std::vector<Attribute>& attributes)
{
  std::vector<Attribute_component> columns;
  for (const char* name : {"red", "green", "blue", "alpha"})
    if (const std::optional<Attribute_component> column = find_column(attributes, name))
      columns.push_back(*column);
    else if (columns.size() < 3)
      return {};
  return columns;
}

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_COLUMNS_H
