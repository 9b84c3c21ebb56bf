// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_PLY_TYPES_H
#define SELVEDGE_SRC_FILES_PLY_TYPES_H

#include "soup/with_number.h"

#include <selvedge/Triangle_soup.h>

#include <array>
#include <cstddef>
#include <string_view>

namespace selvedge::files {

/// The names of types in PLY headers, in the order of `Attribute::Type`: the one that is written, then
/// another that is read as well.
constexpr std::array<std::array<std::string_view, 2>, 8> ply_type_names = {{{"char", "int8"},
                                                                            {"uchar", "uint8"},
                                                                            {"short", "int16"},
                                                                            {"ushort", "uint16"},
                                                                            {"int", "int32"},
                                                                            {"uint", "uint32"},
                                                                            {"float", "float32"},
                                                                            {"double", "float64"}}};

constexpr std::string_view ply_type_name(Attribute::Type type)
{
  return ply_type_names[static_cast<std::size_t>(type)][0];
}

constexpr bool is_integer(Attribute::Type type)
{
  return type != Attribute::Type::float32 && type != Attribute::Type::float64;
}

/// Returns the bytes of a number in a binary file.
inline std::size_t ply_size_of(Attribute::Type type)
{
  return with_number(type, [](auto number) { return sizeof number; });
}

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_PLY_TYPES_H
