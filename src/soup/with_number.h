// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_WITH_NUMBER_H
#define SELVEDGE_SOUP_WITH_NUMBER_H

#include <selvedge/Triangle_soup.h>

#include <cstdint>

namespace selvedge {

/// Calls `function(number)` with a zero of the C++ type that an attribute's numbers have.
template <class Function>
decltype(auto) with_number(Attribute::Type type, const Function& function)
{
  switch (type) {
  case Attribute::Type::int8:
    return function(std::int8_t{});
  case Attribute::Type::uint8:
    return function(std::uint8_t{});
  case Attribute::Type::int16:
    return function(std::int16_t{});
  case Attribute::Type::uint16:
    return function(std::uint16_t{});
  case Attribute::Type::int32:
    return function(std::int32_t{});
  case Attribute::Type::uint32:
    return function(std::uint32_t{});
  case Attribute::Type::float32:
    return function(float{});
  default:
    return function(double{});
  }
}

} // namespace selvedge

#endif // SELVEDGE_SOUP_WITH_NUMBER_H
