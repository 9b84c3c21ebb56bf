// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/gltf_decoding.h"

#include "files/Binary_reader.h"
#include "files/gltf_column_reader.h"

#include <selvedge/Cancellation_scope.h>

#ifdef SELVEDGE_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif
#ifdef SELVEDGE_HAS_DRACO
#include <draco/attributes/attribute_octahedron_transform.h>
#include <draco/attributes/attribute_quantization_transform.h>
#include <draco/compression/decode.h>
#endif

#include <algorithm>
#include <climits>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;

constexpr std::size_t s_always = 1 << 16; // bytes that anything may be decoded to

/// Returns what an extension says of a part of the document, if it is an object.
const Json* extension_of(const Json& part, const char* name)
{
  const Json* const found = find_extension(part, name);
  return found && found->is_object() ? found : nullptr;
}

/// Returns a number that must be there, whole and not negative.
std::size_t number_in(const Gltf_document& document, const Json& object, const char* name)
{
  const auto found = object.find(name);
  if (found == object.end() || !found->is_number_unsigned())
    document.fail(std::string("a compressed part lacks the number ") + name + "; export the file again");
  return found->get<std::size_t>();
}

bool is_too_large(std::size_t decoded, std::size_t encoded, std::size_t most_times)
{
  return decoded > s_always && decoded / most_times > encoded;
}

std::string_view bytes_in_buffer(const Gltf_document& document, const Json& range)
{
  const std::size_t buffer = number_in(document, range, "buffer"),
                    size = number_in(document, range, "byteLength"),
                    offset = range.contains("byteOffset") ? number_in(document, range, "byteOffset") : 0;
  const auto& buffers = document.model.buffers;
  if (buffer >= buffers.size() || offset > buffers[buffer].data.size() ||
      size > buffers[buffer].data.size() - offset)
    document.fail("a compressed part ends beyond its buffer; export the file again");
  return {reinterpret_cast<const char*>(buffers[buffer].data.data()) + offset, size};
}

/// Makes a buffer of these bytes, and returns a view of all of it, of which the document has no part yet.
tinygltf::BufferView view_of(Gltf_document& document, std::vector<unsigned char> bytes)
{
  tinygltf::BufferView view;
  view.buffer = int(document.model.buffers.size());
  view.byteLength = bytes.size();
  document.model.buffers.emplace_back().data = std::move(bytes);
  return view;
}

#ifdef SELVEDGE_HAS_MESHOPTIMIZER
std::vector<unsigned char> decoded_view(const Gltf_document& document, const Json& range,
                                        const std::string& place)
{
  const std::string_view bytes = bytes_in_buffer(document, range);
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  const std::size_t stride = number_in(document, range, "byteStride"),
                    count = number_in(document, range, "count");
  const std::string mode = range.value("mode", ""), filter = range.value("filter", "NONE");
  const bool is_of_vertices = mode == "ATTRIBUTES";
  const bool is_valid = is_of_vertices ? stride > 0 && stride <= 256 && stride % 4 == 0
                                       : (mode == "INDICES" || (mode == "TRIANGLES" && count % 3 == 0)) &&
                                             (stride == 2 || stride == 4);
  if (!is_valid || count == 0)
    document.fail(place + " is not compressed as EXT_meshopt_compression says; export the file again");
  constexpr std::size_t most_times = 256;
  if (count > SIZE_MAX / stride || is_too_large(count * stride, bytes.size(), most_times))
    document.fail(place + " is said to hold more than " + std::to_string(most_times) +
                  " times its size; export the file without compression");
  std::vector<unsigned char> result(count * stride);
  const int status =
      is_of_vertices        ? meshopt_decodeVertexBuffer(result.data(), count, stride, data, bytes.size())
      : mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(result.data(), count, stride, data, bytes.size())
                            : meshopt_decodeIndexSequence(result.data(), count, stride, data, bytes.size());
  const bool is_filter_valid =
      filter == "NONE" ||
      (is_of_vertices && ((filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
                          (filter == "QUATERNION" && stride == 8) || filter == "EXPONENTIAL"));
  if (status != 0 || !is_filter_valid)
    document.fail(place + " cannot be decoded by EXT_meshopt_compression; export the file again");
  if (filter == "OCTAHEDRAL")
    meshopt_decodeFilterOct(result.data(), count, stride);
  else if (filter == "QUATERNION")
    meshopt_decodeFilterQuat(result.data(), count, stride);
  else if (filter == "EXPONENTIAL")
    meshopt_decodeFilterExp(result.data(), count, stride);
  return result;
}
#endif

#ifdef SELVEDGE_HAS_DRACO
/// Returns how many faces compressed data say that they hold, before anything is allocated for them.
std::uint64_t faces_of_draco(const Gltf_document& document, std::string_view bytes, const std::string& place)
{
  Binary_reader reader(bytes, false);
  constexpr std::size_t head = 11;
  const auto refuse = [&](const std::string& what) {
    document.fail(place + " " + what + "; export the file again");
  };
  if (bytes.size() < head + 2 || bytes.substr(0, 5) != "DRACO")
    refuse("holds no data compressed by Draco");
  reader.skip(5);
  const int major = reader.take<std::uint8_t>(), minor = reader.take<std::uint8_t>();
  const int type = reader.take<std::uint8_t>(), method = reader.take<std::uint8_t>();
  const int flags = reader.take<std::uint16_t>();
  if (major != 2 || minor != 2)
    refuse("is compressed by Draco in version " + std::to_string(major) + "." + std::to_string(minor) +
           ", not 2.2");
  constexpr int has_metadata = 0x8000;
  if (type != 1 || method > 1 || (flags & has_metadata) != 0)
    refuse("is compressed by Draco as no mesh, or with metadata");
  const auto variable_length = [&] {
    std::uint64_t number = 0;
    for (int shift = 0; shift < 63 && reader.remaining() > 0; shift += 7) {
      const std::uint64_t byte = reader.take<std::uint8_t>();
      number |= (byte & 0x7f) << shift;
      if ((byte & 0x80) == 0)
        return number;
    }
    refuse("ends within a number");
    return number;
  };
  if (method == 1) { // edgebreaker: its kind, vertices, faces; sequential: faces, points
    reader.skip(1);
    variable_length();
  }
  return variable_length();
}

template <class Number>
bool append_attribute(const draco::PointAttribute& attribute, std::size_t points, int components,
                      std::vector<unsigned char>& bytes)
{
  std::vector<Number> row(static_cast<std::size_t>(components));
  Cancellation_poll poll;
  for (std::uint32_t i = 0; i < points; ++i) {
    poll();
    if (!attribute.ConvertValue<Number>(attribute.mapped_index(draco::PointIndex(i)), std::int8_t(components),
                                        row.data()))
      return false;
    const auto* const first = reinterpret_cast<const unsigned char*>(row.data());
    bytes.insert(bytes.end(), first, first + sizeof(Number) * row.size());
  }
  return true;
}

bool append_attribute(const draco::PointAttribute& attribute, std::size_t points,
                      const tinygltf::Accessor& accessor, std::vector<unsigned char>& bytes)
{
  const int components = tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type));
  if (components < 1 || components > 4)
    return false;
  if (attribute.data_type() == draco::DT_BOOL) // glTF has none, and Draco takes any byte for a bool
    return false;
  switch (accessor.componentType) {
  case type_int8:
    return append_attribute<std::int8_t>(attribute, points, components, bytes);
  case type_uint8:
    return append_attribute<std::uint8_t>(attribute, points, components, bytes);
  case type_int16:
    return append_attribute<std::int16_t>(attribute, points, components, bytes);
  case type_uint16:
    return append_attribute<std::uint16_t>(attribute, points, components, bytes);
  case type_uint32:
    return append_attribute<std::uint32_t>(attribute, points, components, bytes);
  default:
    return append_attribute<float>(attribute, points, components, bytes);
  }
}

/// Decodes one primitive after the other.
class Draco_decoding
{
public:
  explicit Draco_decoding(Gltf_document& document) : m_document(document) {}

  std::size_t decoded() const { return m_sources.size(); }

  // The primitive has an accessor of its own afterwards where it shared one with other compressed data.
  void decode(tinygltf::Primitive& primitive, Json& json, const std::string& place)
  {
    const Json extension = *extension_of(json, draco_extension);
    const std::size_t number = number_in(m_document, extension, "bufferView");
    const std::string_view bytes =
        Gltf_column_reader(m_document, place).view(int(std::min<std::size_t>(number, INT_MAX)));
    const std::uint64_t faces = faces_of_draco(m_document, bytes, place);
    std::size_t size = 0;
    const int component_type = accessor(primitive.indices, place, size).componentType;
    require_rows(faces, place);
    size = std::max(size, 3 * faces * s_most_bytes_of_a_row);
    for (const auto& [name, attribute] : primitive.attributes)
      accessor(attribute, place, size);
    constexpr std::size_t most_times = 1024;
    if (is_too_large(size, bytes.size(), most_times))
      m_document.fail(place + " is said to hold more than " + std::to_string(most_times) +
                      " times its size; export the file without compression");
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES)
      m_document.fail(place + " has other faces than its compressed data; export the file again");
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    auto result = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    Cancellation_scope::check();
    if (!result.ok() || result.value()->num_faces() != faces)
      m_document.fail(place + " cannot be decoded by Draco; export the file again");
    const draco::Mesh& mesh = *result.value();
    const std::unique_ptr<draco::Mesh> quantised = quantised_mesh(bytes);
    put(primitive.indices, {number, s_indices}, {3 * faces, indices_of(mesh, component_type)});
    json["indices"] = primitive.indices;
    const Json& attributes = member(extension, "attributes");
    for (auto& [name, target] : primitive.attributes) {
      if (!attributes.is_object() || !attributes.contains(name))
        continue; // it is not compressed
      const auto id = std::uint32_t(number_in(m_document, attributes, name.c_str()));
      const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(id);
      const tinygltf::Accessor& of_target = m_document.model.accessors[std::size_t(target)];
      Rows rows{mesh.num_points(), {}};
      if (!attribute || rows.count > std::max<std::size_t>(3 * faces, of_target.count) ||
          !append_attribute(*attribute, rows.count, of_target, rows.bytes))
        m_document.fail(place + ": " + name + " does not fit its compressed data; export the file again");
      put(target, {number, id}, std::move(rows));
      json["attributes"][name] = target;
      m_document.compressions[target] = compression(*quantised->GetAttributeByUniqueId(id));
    }
  }

private:
  static constexpr std::size_t s_most_bytes_of_a_row = 16;
  static constexpr std::uint64_t s_indices = UINT64_MAX; // stands for no attribute

  using Source = std::pair<std::size_t, std::uint64_t>; // a compressed view, and what of it

  struct Rows
  {
    std::size_t count;
    std::vector<unsigned char> bytes;
  };

  // Decodes again, and leaves attributes quantised as they are in the bytes.
  static std::unique_ptr<draco::Mesh> quantised_mesh(std::string_view bytes)
  {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    for (int type = 0; type < draco::GeometryAttribute::NAMED_ATTRIBUTES_COUNT; ++type)
      decoder.SetSkipAttributeTransform(draco::GeometryAttribute::Type(type));
    return std::move(decoder.DecodeMeshFromBuffer(&buffer)).value();
  }

  static Gltf_scene::Compression compression(const draco::PointAttribute& attribute)
  {
    const draco::AttributeTransformData* const data = attribute.GetAttributeTransformData();
    if (!data)
      return {};
    if (data->transform_type() == draco::ATTRIBUTE_OCTAHEDRON_TRANSFORM) {
      draco::AttributeOctahedronTransform transform;
      transform.InitFromAttribute(attribute);
      return {{{transform.quantization_bits(), {}, 0}}};
    }
    draco::AttributeQuantizationTransform transform;
    if (data->transform_type() != draco::ATTRIBUTE_QUANTIZATION_TRANSFORM ||
        !transform.InitFromAttribute(attribute))
      return {};
    return {{{transform.quantization_bits(), transform.min_values(), transform.range()}}};
  }

  // Returns an accessor, and adds the bytes that it stands for.
  const tinygltf::Accessor& accessor(int number, const std::string& place, std::size_t& size) const
  {
    if (number < 0 || std::size_t(number) >= m_document.model.accessors.size())
      m_document.fail(place + " names accessor " + std::to_string(number) +
                      ", which is not there; export the file again");
    const tinygltf::Accessor& result = m_document.model.accessors[std::size_t(number)];
    require_rows(result.count, place);
    size += result.count * s_most_bytes_of_a_row;
    return result;
  }

  void require_rows(std::uint64_t count, const std::string& place) const
  {
    if (count > SIZE_MAX >> 16)
      m_document.fail(place + " is said to hold too much; export the file again");
  }

  std::vector<unsigned char> indices_of(const draco::Mesh& mesh, int component_type) const
  {
    std::string rows;
    Cancellation_poll poll;
    for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
      poll();
      for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(i)))
        switch (component_type) {
        case type_uint8:
          append_little_endian(rows, std::uint8_t(corner.value()));
          break;
        case type_uint16:
          append_little_endian(rows, std::uint16_t(corner.value()));
          break;
        default:
          append_little_endian(rows, std::uint32_t(corner.value()));
        }
    }
    return {rows.begin(), rows.end()};
  }

  // Gives an accessor its rows, once. Their number is that of the compressed data: some exporters leave the
  // one that the accessor had before, although Draco splits and joins vertices. Blender lets meshes whose
  // numbers were equal before they were compressed, each by itself, share an accessor: the second one gets
  // its own.
  void put(int& number, const Source& source, Rows rows)
  {
    const auto [known, is_new] = m_sources.emplace(number, source);
    if (!is_new && known->second == source)
      return;
    if (!is_new) {
      const std::pair<int, Source> shared(number, source);
      const auto own = m_own.find(shared);
      if (own != m_own.end()) {
        number = own->second;
        return;
      }
      m_document.model.accessors.push_back(
          tinygltf::Accessor(m_document.model.accessors[std::size_t(number)]));
      m_document.json["accessors"].push_back(Json(m_document.json["accessors"][std::size_t(number)]));
      number = int(m_document.model.accessors.size() - 1);
      m_own.emplace(shared, number);
      m_sources.emplace(number, source);
    }
    const Json view = {{"buffer", 0}, {"byteLength", rows.bytes.size()}};
    m_document.model.bufferViews.push_back(view_of(m_document, std::move(rows.bytes)));
    m_document.json["bufferViews"].push_back(view);
    tinygltf::Accessor& accessor = m_document.model.accessors[std::size_t(number)];
    accessor.bufferView = int(m_document.model.bufferViews.size() - 1);
    accessor.byteOffset = 0;
    accessor.count = rows.count;
    Json& json = m_document.json["accessors"][std::size_t(number)];
    json["bufferView"] = accessor.bufferView;
    json["count"] = rows.count;
    json.erase("byteOffset");
  }

  Gltf_document& m_document;
  std::map<int, Source> m_sources;             // what each accessor has its rows from
  std::map<std::pair<int, Source>, int> m_own; // the accessor that stands for a shared one, for other data
};
#endif

} // namespace

std::string missing_decoder(const std::string& extension)
{
#ifndef SELVEDGE_HAS_MESHOPTIMIZER
  if (extension == meshopt_extension)
    return "meshoptimizer";
#endif
#ifndef SELVEDGE_HAS_DRACO
  if (extension == draco_extension)
    return "Draco";
#endif
  static_cast<void>(extension);
  return {};
}

void prepare_for_decoding(const Json& document, Json& reduced)
{
  const Json& buffers = member(document, "buffers");
  const Json& used = member(document, "extensionsUsed");
  const bool is_compressed = std::find(used.begin(), used.end(), meshopt_extension) != used.end();
  // A buffer without an address is that of a GLB, which is the first, or stands for what is decoded.
  for (std::size_t i = 0; i < buffers.size() && buffers.is_array() && is_compressed; ++i)
    if (const Json* const extension = extension_of(buffers[i], meshopt_extension);
        buffers[i].is_object() && !buffers[i].contains("uri") &&
        (i > 0 || (extension && extension->value("fallback", false))))
      reduced["buffers"][i] = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
  const Json& accessors = member(document, "accessors");
  for (const Json& mesh : member(document, "meshes"))
    for (const Json& primitive : mesh.is_object() ? member(mesh, "primitives") : Json::array())
      if (const Json* const extension = extension_of(primitive, draco_extension);
          extension && primitive.contains("indices") && primitive["indices"].is_number_unsigned()) {
        const std::size_t number = primitive["indices"];
        if (accessors.is_array() && number < accessors.size() && accessors[number].is_object() &&
            !accessors[number].contains("bufferView") && extension->contains("bufferView"))
          reduced["accessors"][number]["bufferView"] = (*extension)["bufferView"];
      }
}

#if defined SELVEDGE_HAS_MESHOPTIMIZER || defined SELVEDGE_HAS_DRACO
// Whether readers may do without an extension: the file then has the same data uncompressed, too.
bool is_optional(const Gltf_document& document, const char* extension)
{
  const Json& required = member(document.json, "extensionsRequired");
  return std::find(required.begin(), required.end(), extension) == required.end();
}

constexpr const char* requires_it = ", and requires it: the uncompressed data beside it is not carried";
#endif

void decode_views(Gltf_document& document)
{
#ifdef SELVEDGE_HAS_MESHOPTIMIZER
  for (std::size_t i = 0; i < document.model.bufferViews.size(); ++i) {
    Json& json = document.json["bufferViews"][i];
    const Json* const extension = extension_of(json, meshopt_extension);
    if (!extension)
      continue;
    Cancellation_scope::check();
    const std::string place = "buffer view " + std::to_string(i);
    std::vector<unsigned char> bytes = decoded_view(document, *extension, place);
    tinygltf::BufferView& view = document.model.bufferViews[i];
    if (view.byteLength != bytes.size())
      document.fail(place + " has another length than its compressed data; export the file again");
    const std::size_t stride = view.byteStride;
    const tinygltf::BufferView whole = view_of(document, std::move(bytes));
    view.buffer = whole.buffer;
    view.byteOffset = 0;
    view.byteStride = stride;
    document.meshopt_views[Index(i)] = {*extension, std::string(bytes_in_buffer(document, *extension))};
    remove_extension_of(json, meshopt_extension);
  }
  if (document.meshopt_views.empty())
    return;
  for (Json& buffer : document.json["buffers"])
    remove_extension_of(buffer, meshopt_extension);
  const std::string end = is_optional(document, meshopt_extension) ? requires_it : "";
  remove_extension(document.json, meshopt_extension);
  document.remarks["buffer views decoded from EXT_meshopt_compression; glTF output has it, too" + end] +=
      document.meshopt_views.size();
  document.compact["buffer views in EXT_meshopt_compression, which takes more bytes for a vertex the less "
                   "regular a mesh is"] = document.meshopt_views.size();
#else
  static_cast<void>(document);
#endif
}

void decode_primitives(Gltf_document& document)
{
#ifdef SELVEDGE_HAS_DRACO
  std::size_t decoded = 0;
  Draco_decoding decoding(document);
  for (std::size_t m = 0; m < document.model.meshes.size(); ++m)
    for (std::size_t p = 0; p < document.model.meshes[m].primitives.size(); ++p) {
      Json& json = document.json["meshes"][m]["primitives"][p];
      if (!extension_of(json, draco_extension))
        continue;
      decoding.decode(document.model.meshes[m].primitives[p], json,
                      "mesh " + std::to_string(m) + ", primitive " + std::to_string(p));
      remove_extension_of(json, draco_extension);
      ++decoded;
    }
  if (decoded == 0)
    return;
  const std::string end = is_optional(document, draco_extension) ? requires_it : "";
  remove_extension(document.json, draco_extension);
  document.remarks
      ["primitives decoded from KHR_draco_mesh_compression; glTF output has it where it loses nothing" +
       end] += decoded;
  document.compact["primitives in Draco, which takes more bytes for a vertex the less regular a mesh is"] =
      decoded;
#else
  static_cast<void>(document);
#endif
}

const Json* find_extension(const Json& part, const char* name)
{
  const Json& extensions = part.is_object() ? member(part, "extensions") : part;
  const auto found = extensions.is_object() ? extensions.find(name) : extensions.end();
  return found == extensions.end() ? nullptr : &*found;
}

void remove_extension_of(Json& part, const char* name)
{
  if (!part.is_object() || !member(part, "extensions").is_object())
    return;
  part["extensions"].erase(name);
  if (part["extensions"].empty())
    part.erase("extensions");
}

void add_extension(Json& document, const std::string& name, bool is_required)
{
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
    Json& list = document[key];
    if (std::find(list.begin(), list.end(), name) == list.end())
      list.push_back(name);
    if (!is_required)
      return;
  }
}

void remove_extension(Json& document, const std::string& name)
{
  for (const char* key : {"extensionsRequired", "extensionsUsed"}) {
    const auto list = document.find(key);
    if (list == document.end() || !list->is_array())
      continue;
    Json left = Json::array();
    for (const Json& extension : *list)
      if (extension != name)
        left.push_back(extension);
    if (left.empty())
      document.erase(key);
    else
      *list = std::move(left);
  }
}

} // namespace selvedge::files
