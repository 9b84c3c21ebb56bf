// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Gltf_output.h"

#include "files/gltf_decoding.h"
#include "files/gltf_document.h"
#include "files/gltf_encoding.h"
#include "files/gltf_quantization.h"

#include <selvedge/Error.h>
#include <selvedge/internal/base64.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>

namespace selvedge::files {
namespace {

// For names that are no UTF-8, as those of OBJ files may be.
constexpr auto s_replace = nlohmann::json::error_handler_t::replace;

using Json = Gltf_output::Json;
using Target = Gltf_output::Target;

// Returns a number for a new element. Free numbers are used first, so that all others stay.
std::size_t next(std::vector<Index>& free, std::size_t size)
{
  if (free.empty())
    return size;
  const Index number = free.back();
  free.pop_back();
  return number;
}

void put_bounds(Json& accessor, const Gltf_scene::Column& column)
{
  const std::size_t rows = column.rows.size() / column.row_size;
  Json least = Json::array(), largest = Json::array();
  for (std::size_t k = 0; k < column.components; ++k) {
    double low = component(column, 0, k), high = low;
    for (std::size_t i = 1; i < rows; ++i) {
      low = std::min(low, component(column, i, k));
      high = std::max(high, component(column, i, k));
    }
    if (column.component_type == type_float32) {
      least.push_back(low);
      largest.push_back(high);
    } else {
      least.push_back(std::int64_t(low));
      largest.push_back(std::int64_t(high));
    }
  }
  accessor["min"] = std::move(least);
  accessor["max"] = std::move(largest);
}

// Returns what the document says about an accessor, apart from where its bytes are.
Json description(const Gltf_scene::Column& column, std::size_t count)
{
  Json result = column.accessor;
  result["count"] = count;
  if (column.name != "POSITION" && !result.contains("min") && !result.contains("max"))
    return result;
  result.erase("min");
  result.erase("max");
  if (!column.rows.empty()) // those of indices that Draco holds are not known here
    put_bounds(result, column);
  return result;
}

// Rows of vertices begin at multiples of four bytes.
std::size_t stride_of(const Gltf_scene::Column& column, Target target)
{
  return target == Target::vertices ? (column.row_size + 3) / 4 * 4 : column.row_size;
}

std::string bytes_of_view(const Gltf_scene::Column& column, std::size_t count, Target target)
{
  const std::size_t stride = stride_of(column, target);
  if (stride == column.row_size)
    return column.rows;
  std::string bytes;
  bytes.reserve(count * stride);
  for (std::size_t i = 0; i < count; ++i) {
    bytes += column.row(i);
    bytes.append(stride - column.row_size, '\0');
  }
  return bytes;
}

} // namespace

void append_index(Gltf_scene::Column& column, Index index)
{
  for (std::size_t k = 0; k < column.row_size; ++k)
    column.rows += static_cast<char>(index >> (8 * k) & 0xff);
}

Gltf_output::Gltf_output(const Gltf_scene& scene, bool may_rotate, bool may_share_rows)
    : document(scene.document), m_is_compressed(!scene.meshopt_views.empty()), m_may_rotate(may_rotate),
      m_may_share_rows(may_share_rows), m_views(scene.views),
      m_free_accessors(scene.free_accessors.rbegin(), scene.free_accessors.rend()),
      m_free_views(scene.free_views.rbegin(), scene.free_views.rend())
{
  for (const auto& [number, view] : scene.meshopt_views)
    if (!std::binary_search(scene.free_views.begin(), scene.free_views.end(), number))
      m_kept_views.emplace(number, view);
}

std::size_t Gltf_output::put_accessor(const Column& column, std::size_t count, Target target,
                                      std::size_t block)
{
  const Json rest = description(column, count);
  std::string bytes = column.is_sparse ? column.rows : bytes_of_view(column, count, target);
  const std::size_t hash = std::hash<std::string>()(bytes);
  for (auto range = m_written.equal_range(hash); range.first != range.second; ++range.first) {
    const Written& known = range.first->second;
    if (known.target == target && known.is_sparse == column.is_sparse && known.rest == rest &&
        (known.is_sparse ? known.sparse_rows : m_rows[known.rows].bytes).compare(0, bytes.size(), bytes) == 0)
      return known.accessor;
  }
  Written& written = m_written.emplace(hash, Written{rest, target, column.is_sparse, {}, 0, 0})->second;
  Json accessor = Json::object();
  if (column.is_sparse)
    written.sparse_rows = std::exchange(bytes, bytes_of_view(column, count, target));
  if (!column.is_sparse || !put_sparse(accessor, column, count))
    accessor["bufferView"] = written.rows = put_rows(column, std::move(bytes), target, block);
  accessor.update(rest);
  const bool has_rows = accessor.contains("bufferView"); // the number of the view comes later
  written.accessor = add_accessor(std::move(accessor));
  if (has_rows)
    m_rows[written.rows].accessors.emplace_back(written.accessor, 0);
  return written.accessor;
}

std::size_t Gltf_output::put_decoded_accessor(const Column& column, std::size_t count)
{
  return add_accessor(description(column, count));
}

std::size_t Gltf_output::put_bytes(std::string bytes)
{
  return put_view(std::move(bytes));
}

void Gltf_output::write(Byte_writer& out, Mesh_format format)
{
  if (!m_compressed_primitives.empty())
    add_extension(document, draco_extension, true);
  remove_needless_quantization(document);
  if (format == Mesh_format::glb)
    embed_images();
  put_views();
  fill_free();
  std::string bytes = put_buffer();
  if (format == Mesh_format::gltf) {
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + internal::base64(bytes);
    out << document.dump(1, '\t', false, s_replace) << '\n';
  } else {
    std::string json = document.dump(-1, ' ', false, s_replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    const std::size_t size = 12 + 8 + json.size() + 8 + bytes.size();
    if (size > std::numeric_limits<std::uint32_t>::max())
      throw Output_error("a GLB file holds no more than 4 GiB; write .gltf instead");
    out << "glTF";
    out.binary(std::uint32_t(2));
    out.binary(std::uint32_t(size));
    out.binary(std::uint32_t(json.size()));
    out << "JSON" << json;
    out.binary(std::uint32_t(bytes.size()));
    out << std::string_view("BIN\0", 4) << bytes;
  }
  out.commit();
}

std::size_t Gltf_output::add_accessor(Json accessor)
{
  Json& accessors = document["accessors"];
  const std::size_t number = next(m_free_accessors, accessors.size());
  accessors[number] = std::move(accessor);
  return number;
}

// Puts only the rows that are not zero, where that takes less space. Returns whether it does.
bool Gltf_output::put_sparse(Json& accessor, const Column& column, std::size_t count)
{
  const int type = count <= 0x100 ? int(type_uint8) : count <= 0x10000 ? int(type_uint16) : int(type_uint32);
  Column indices = {"indices", {}, type, 1, component_size(type), {}};
  Column values = {"values", {}, column.component_type, column.components, column.row_size, {}};
  std::size_t size = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view row = column.row(i);
    if (row.find_first_not_of('\0') == row.npos)
      continue;
    ++size;
    append_index(indices, Index(i));
    values.rows += row;
  }
  if (indices.rows.size() + values.rows.size() >= column.rows.size())
    return false;
  if (size > 0)
    accessor["sparse"] = {{"count", size},
                          {"indices", {{"bufferView", put_view(indices.rows)}, {"componentType", type}}},
                          {"values", {{"bufferView", put_view(values.rows)}}}};
  return true;
}

// Keeps rows, or returns the number of others that begin with the same.
std::size_t Gltf_output::put_rows(const Column& column, std::string bytes, Target target, std::size_t block)
{
  const std::size_t stride = stride_of(column, target);
  const bool may_share = target == Target::vertices && m_may_share_rows;
  const std::string first_row = bytes.substr(0, stride);
  for (auto range = m_rows_by_first.equal_range(first_row); may_share && range.first != range.second;
       ++range.first)
    if (m_rows[range.first->second].bytes.compare(0, bytes.size(), bytes) == 0)
      return range.first->second;
  if (may_share)
    m_rows_by_first.emplace(first_row, m_rows.size());
  m_rows.push_back({std::move(bytes), stride, stride != column.row_size, target, column.place, block, {}});
  return m_rows.size() - 1;
}

// Makes one of rows that were interleaved in the file.
void Gltf_output::interleave()
{
  std::map<std::tuple<std::size_t, Index, std::size_t>, std::vector<Rows*>> groups;
  for (Rows& rows : m_rows)
    if (rows.target == Target::vertices && rows.place && rows.place->stride > rows.stride)
      groups[{rows.block, rows.place->view, rows.place->offset / rows.place->stride}].push_back(&rows);
  for (auto& [key, group] : groups) {
    std::sort(group.begin(), group.end(),
              [](const Rows* a, const Rows* b) { return a->place->offset < b->place->offset; });
    std::size_t stride = 0;
    for (const Rows* const rows : group)
      stride += rows->stride;
    constexpr std::size_t longest_stride = 252; // in glTF
    if (group.size() == 1 || stride > longest_stride)
      continue;
    Rows& first = *group.front();
    Rows whole = {{}, stride, true, Target::vertices, first.place, first.block, {}};
    for (std::size_t i = 0; i < first.bytes.size() / first.stride; ++i)
      for (const Rows* const rows : group)
        whole.bytes.append(rows->bytes, i * rows->stride, rows->stride);
    std::size_t offset = 0;
    for (Rows* const rows : group) {
      for (const auto& accessor : std::exchange(rows->accessors, {}))
        whole.accessors.emplace_back(accessor.first, offset);
      offset += rows->stride;
    }
    first = std::move(whole);
  }
}

// Puts all rows into buffer views, those that shared one in the file into one.
void Gltf_output::put_views()
{
  if (!m_may_share_rows)
    interleave();
  std::map<std::tuple<Index, Target, std::size_t>, Rows*> views;
  for (Rows& rows : m_rows) {
    if (!rows.place || rows.accessors.empty())
      continue;
    Rows& whole =
        *views.emplace(std::make_tuple(rows.place->view, rows.target, rows.stride), &rows).first->second;
    if (&whole == &rows)
      continue;
    for (const auto& [accessor, offset] : std::exchange(rows.accessors, {}))
      whole.accessors.emplace_back(accessor, whole.bytes.size() + offset);
    whole.bytes += std::exchange(rows.bytes, {});
  }
  for (Rows& rows : m_rows) {
    if (rows.accessors.empty())
      continue;
    Json view = {{"target", int(rows.target)}};
    if (rows.target == Target::vertices && (rows.has_gaps || rows.accessors.size() > 1))
      view["byteStride"] = rows.stride; // must be there for several accessors
    const std::size_t number = put_view(std::move(rows.bytes), std::move(view));
    m_row_sizes[Index(number)] = {rows.stride, rows.target == Target::indices};
    for (const auto& [accessor, offset] : rows.accessors) {
      Json& json = document["accessors"][accessor];
      json["bufferView"] = number;
      if (offset > 0)
        json["byteOffset"] = offset;
    }
  }
}

// Puts a buffer view of which this is known already.
std::size_t Gltf_output::put_view(std::string bytes, Json view)
{
  view.update({{"buffer", 0}, {"byteOffset", 0}, {"byteLength", bytes.size()}});
  Json& views = document["bufferViews"];
  const std::size_t number = next(m_free_views, views.size());
  views[number] = std::move(view);
  m_views.resize(views.size());
  m_views[number] = std::move(bytes);
  return number;
}

// Puts images that are in data addresses into buffer views, as GLB files have them.
void Gltf_output::embed_images()
{
  const auto images = document.find("images");
  if (images == document.end() || !images->is_array())
    return;
  for (std::size_t i = 0; i < images->size(); ++i) {
    const Json& image = document["images"][i];
    if (!image.is_object() || !image.contains("uri") || !image["uri"].is_string())
      continue;
    const std::string& address = image["uri"].get_ref<const std::string&>();
    std::vector<unsigned char> bytes;
    std::string type;
    const bool is_decoded = tinygltf::IsDataURI(address) &&
                            tinygltf::DecodeDataURI(&bytes, type, address, 0, false) &&
                            type.compare(0, 6, "image/") == 0;
    std::string data(bytes.begin(), bytes.end());
    // tinygltf stops at what is no digit.
    if (!is_decoded || "data:" + type + ";base64," + internal::base64(data) != address)
      continue;
    const std::size_t view = put_bytes(std::move(data));
    Json& embedded = document["images"][i]; // the document may have got a new key
    embedded.erase("uri");
    embedded["bufferView"] = view;
    if (!embedded.contains("mimeType"))
      embedded["mimeType"] = std::move(type);
  }
}

// Removes the free accessors and buffer views at the end, and puts the smallest valid ones where others have
// left a number.
void Gltf_output::fill_free()
{
  const auto shorten = [](Json& elements, std::vector<Index>& free) {
    while (!free.empty() && free.front() + 1 == elements.size()) {
      elements.erase(elements.size() - 1);
      free.erase(free.begin());
    }
  };
  if (!m_free_accessors.empty())
    shorten(document["accessors"], m_free_accessors);
  if (!m_free_views.empty())
    shorten(document["bufferViews"], m_free_views);
  m_views.resize(document["bufferViews"].size());
  for (const Index number : m_free_accessors)
    document["accessors"][number] = {{"componentType", int(type_uint8)}, {"count", 1}, {"type", "SCALAR"}};
  for (const Index number : m_free_views) {
    document["bufferViews"][number] = {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 1}};
    m_views[number].assign(1, '\0');
  }
}

// Puts all buffer views into one buffer, each at a multiple of four bytes.
std::string Gltf_output::put_buffer()
{
  std::string bytes;
  std::size_t decoded = 0; // bytes of views that are compressed
  const auto begin_view = [](std::size_t& size) { size = (size + 3) / 4 * 4; };
  for (std::size_t i = 0; i < m_views.size(); ++i) {
    std::size_t begin = bytes.size();
    begin_view(begin);
    bytes.resize(begin, '\0');
    Json& view = document["bufferViews"][i];
    std::optional<Gltf_scene::Meshopt_view> encoded = compressed_view(i);
    if (encoded) {
      begin_view(decoded);
      view["buffer"] = 1;
      view["byteOffset"] = decoded;
      encoded->extension["buffer"] = 0;
      encoded->extension["byteOffset"] = begin;
      view["extensions"][meshopt_extension] = std::move(encoded->extension);
      decoded += m_views[i].size();
    } else {
      view["buffer"] = 0;
      view["byteOffset"] = begin;
    }
    bytes += encoded ? encoded->bytes : m_views[i];
  }
  Json buffer = document.contains("buffers") ? document["buffers"][0] : Json::object();
  buffer.erase("uri");
  buffer["byteLength"] = bytes.size();
  document["buffers"] = Json::array({std::move(buffer)});
  if (decoded > 0) {
    document["buffers"].push_back(
        {{"byteLength", decoded}, {"extensions", {{meshopt_extension, {{"fallback", true}}}}}});
    add_extension(document, meshopt_extension, true);
  }
  return bytes;
}

// Returns a view as it was compressed in the file or, if it is new, compressed as others were there.
std::optional<Gltf_scene::Meshopt_view> Gltf_output::compressed_view(std::size_t view) const
{
  if (const auto kept = m_kept_views.find(Index(view)); kept != m_kept_views.end())
    return kept->second;
  const auto found = m_row_sizes.find(Index(view));
  return !m_is_compressed || found == m_row_sizes.end()
             ? std::optional<Gltf_scene::Meshopt_view>()
             : encoded_by_meshopt(m_views[view], found->second.first, found->second.second, m_may_rotate);
}

} // namespace selvedge::files
