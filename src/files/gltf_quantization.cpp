// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/gltf_quantization.h"

#include "files/gltf_decoding.h"
#include "soup/with_number.h"

#include <selvedge/Cancellation_scope.h>

#include <cmath>
#include <limits>
#include <utility>

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;
using Column = Gltf_scene::Column;

/// Returns a column without rows, and with everything else that `from` has, of another type of numbers.
Column of_type(const Column& from, Json accessor)
{
  const int type = accessor["componentType"];
  Column result = from.without_rows();
  result.accessor = std::move(accessor);
  result.component_type = type;
  result.row_size = from.components * component_size(type);
  result.quantised_accessor.reset();
  return result;
}

bool needs_quantization(const Json& attributes, const Json& accessors)
{
  for (const auto& [name, number] : attributes.items())
    if (number.is_number_unsigned() && number.get<std::size_t>() < accessors.size() &&
        is_quantised(name, accessors[number.get<std::size_t>()]))
      return true;
  return false;
}

} // namespace

bool is_quantised(const std::string& name, const Json& accessor)
{
  const int type = accessor.value("componentType", 0);
  if (type == type_float32 || type == type_uint32)
    return false;
  if (name == "POSITION" || name == "NORMAL" || name == "TANGENT")
    return true;
  const bool is_plain_uv = accessor.value("normalized", false) && (type == type_uint8 || type == type_uint16);
  return name.compare(0, 9, "TEXCOORD_") == 0 && !is_plain_uv;
}

Gltf_scene::Column dequantised(const Gltf_scene::Column& column)
{
  Json accessor = column.accessor;
  accessor["componentType"] = int(type_float32);
  for (const char* key : {"normalized", "min", "max"})
    accessor.erase(key);
  Gltf_scene::Column result = of_type(column, std::move(accessor));
  if (column.row_size == column.components * component_size(column.component_type)) // no matrices with gaps
    result.quantised_accessor = column.accessor;
  const std::size_t rows = column.rows.size() / column.row_size;
  result.rows.reserve(rows * result.row_size);
  Cancellation_poll poll;
  for (std::size_t i = 0; i < rows; ++i) {
    poll();
    for (std::size_t k = 0; k < column.components; ++k)
      append_little_endian(result.rows, float(normalised(column, i, k)));
  }
  return result;
}

std::optional<Gltf_scene::Column> quantised_again(const Gltf_scene::Column& column)
{
  if (!column.quantised_accessor)
    return std::nullopt;
  Gltf_scene::Column result = of_type(column, *column.quantised_accessor);
  const bool is_normalized = result.is_normalized();
  const bool is_exact = with_number(attribute_type(result.component_type), [&](auto zero) {
    using Limits = std::numeric_limits<decltype(zero)>;
    const double one = is_normalized ? double(Limits::max()) : 1;
    Cancellation_poll poll;
    for (std::size_t i = 0; i < column.rows.size() / column.row_size; ++i) {
      poll();
      for (std::size_t k = 0; k < column.components; ++k) {
        const double number = std::round(component(column, i, k) * one);
        if (!(number >= double(Limits::lowest()) && number <= double(Limits::max())))
          return false;
        append_little_endian(result.rows, static_cast<decltype(zero)>(number));
      }
    }
    return true;
  });
  return is_exact && dequantised(result).rows == column.rows
             ? std::optional<Gltf_scene::Column>(std::move(result))
             : std::nullopt;
}

void remove_needless_quantization(Json& document)
{
  const Json& accessors = document["accessors"];
  for (const Json& mesh : document["meshes"])
    for (const Json& primitive : mesh["primitives"]) {
      if (needs_quantization(primitive["attributes"], accessors))
        return;
      if (const auto targets = primitive.find("targets"); targets != primitive.end())
        for (const Json& target : *targets)
          if (needs_quantization(target, accessors))
            return;
    }
  remove_extension(document, quantization_extension);
}

} // namespace selvedge::files
