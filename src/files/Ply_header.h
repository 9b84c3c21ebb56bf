// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_PLY_HEADER_H
#define SELVEDGE_SRC_FILES_PLY_HEADER_H

#include "files/Text_reader.h"

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace selvedge::files {

struct Ply_property
{
  std::string name;
  Attribute::Type type = Attribute::Type::float32;
  std::optional<Attribute::Type> count_type; ///< of a list
};

struct Ply_element
{
  std::string name;
  std::uint64_t count = 0;
  std::vector<Ply_property> properties;
  std::string declarations; ///< the lines of the header that declare the properties

  /// Returns the place of a property, or their number if there is none of this name.
  std::size_t find(std::string_view property) const;
};

/// What a PLY file announces before its values.
struct Ply_header
{
  std::string_view format; ///< ascii, binary_little_endian or binary_big_endian
  std::vector<Ply_element> elements;
  std::vector<std::string> comments; ///< lines of comments and of obj_info, with these words
  std::size_t unknown_lines = 0;     ///< before the first element: some programs sign their files so
};

/// Reads the header, and leaves `text` at the body. Throws `Input_error` when the header is damaged.
Ply_header read_ply_header(Text_reader& text);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_PLY_HEADER_H
