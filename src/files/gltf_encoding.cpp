// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/gltf_encoding.h"

#include <selvedge/Cancellation_scope.h>

#ifdef SELVEDGE_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif
#ifdef SELVEDGE_HAS_DRACO
#include <draco/compression/attributes/normal_compression_utils.h>
#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace selvedge::files {

#ifdef SELVEDGE_HAS_DRACO
namespace {

using Column = Gltf_scene::Column;

/// Draco quantises normals as directions, others in a box. Whole numbers it takes for such directions
/// already.
draco::GeometryAttribute::Type draco_type(const Column& column, bool is_of_steps)
{
  const auto is_of = [&](const char* name) { return column.name.compare(0, std::strlen(name), name) == 0; };
  const bool is_direction = is_of("NORMAL") && column.component_type == type_float32 && !is_of_steps;
  return is_of("POSITION")   ? draco::GeometryAttribute::POSITION
         : is_direction      ? draco::GeometryAttribute::NORMAL
         : is_of("TEXCOORD") ? draco::GeometryAttribute::TEX_COORD
         : is_of("COLOR")    ? draco::GeometryAttribute::COLOR
                             : draco::GeometryAttribute::GENERIC;
}

draco::DataType draco_type(int component_type)
{
  switch (component_type) {
  case type_int8:
    return draco::DT_INT8;
  case type_uint8:
    return draco::DT_UINT8;
  case type_int16:
    return draco::DT_INT16;
  case type_uint16:
    return draco::DT_UINT16;
  case type_uint32:
    return draco::DT_UINT32;
  default:
    return draco::DT_FLOAT32;
  }
}

/// Stands for the lowest corner of a quantised column until it is put into the bytes. Draco's own option
/// keeps six decimals of it.
float placeholder(std::size_t column)
{
  return -1000 - float(column);
}

/// Whether whole numbers of so many bits are exact as 32-bit floats, placeholder included.
bool is_exact_in_float(int bits)
{
  return bits <= 22;
}

/// Returns the numbers of a column in steps of its quantisation, from the placeholder on. What has no step,
/// as in a box of size 0, gets the first one.
std::vector<float> steps_of(const Column& column, const Gltf_scene::Compression::Quantisation& quantisation,
                            float origin)
{
  const float most = float((1u << quantisation.bits) - 1);
  std::vector<float> steps(column.rows.size() / sizeof(float));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::size_t place = i % column.components;
    const double from_corner = component(column, i / column.components, place) - quantisation.origin[place];
    const double step = std::round(from_corner / quantisation.range * most);
    // NaN, at which Draco crashes, is not greater than 0.
    steps[i] = origin + (step > 0 ? float((std::min)(step, double(most))) : 0);
  }
  return steps;
}

/// One column among those of a primitive, and whether Draco quantises it.
struct Packed_column
{
  const Column* column;
  std::optional<Gltf_scene::Compression::Quantisation> quantisation;
  bool is_of_steps() const { return quantisation && !quantisation->origin.empty(); }
};

/// Returns for every row how many before it are the same in all columns.
std::vector<std::uint32_t> earlier_copies(const std::vector<Packed_column>& columns, std::uint32_t rows)
{
  std::unordered_map<std::string, std::uint32_t> copies;
  std::vector<std::uint32_t> result;
  for (std::uint32_t row = 0; row < rows; ++row) {
    std::string whole;
    for (const Packed_column& column : columns)
      whole += column.column->row(row);
    result.push_back(copies[whole]++);
  }
  return result;
}

/// Returns a primitive as Draco has it. Its attributes are the columns, in their order; those that were
/// quantised in a box count its steps. Vertices that differ in nothing, the later ones being `copies`, are
/// told apart by the column `apart`.
std::unique_ptr<draco::Mesh> draco_mesh(const std::vector<Packed_column>& columns,
                                        const std::vector<Index>& corners,
                                        const std::vector<std::uint32_t>& copies, std::size_t apart)
{
  const auto rows = std::uint32_t(copies.size());
  auto mesh = std::make_unique<draco::Mesh>();
  mesh->set_num_points(rows);
  mesh->SetNumFaces(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); i += 3)
    mesh->SetFace(draco::FaceIndex(std::uint32_t(i / 3)),
                  {{draco::PointIndex(corners[i]), draco::PointIndex(corners[i + 1]),
                    draco::PointIndex(corners[i + 2])}});
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Column& column = *columns[i].column;
    draco::GeometryAttribute attribute;
    attribute.Init(draco_type(column, columns[i].is_of_steps()), nullptr, std::uint8_t(column.components),
                   draco_type(column.component_type), column.is_normalized(), std::int64_t(column.row_size),
                   0);
    const std::vector<float> steps = columns[i].is_of_steps()
                                         ? steps_of(column, *columns[i].quantisation, placeholder(i))
                                         : std::vector<float>();
    const auto value = [&](std::uint32_t row) {
      return steps.empty() ? column.row(row)
                           : std::string_view(reinterpret_cast<const char*>(&steps[row * column.components]),
                                              column.row_size);
    };
    // Vertices that differ in other columns alone have one value, by which Draco sees that they are
    // neighbours. Those that differ in nothing have several in a column, or it would make them one.
    std::map<std::pair<std::uint32_t, std::string_view>, std::uint32_t> numbers;
    std::vector<std::uint32_t> firsts;
    std::vector<draco::AttributeValueIndex> of_row;
    for (std::uint32_t row = 0; row < rows; ++row) {
      const auto [number, is_new] = numbers.emplace(std::make_pair(i == apart ? copies[row] : 0, value(row)),
                                                    std::uint32_t(firsts.size()));
      if (is_new)
        firsts.push_back(row);
      of_row.emplace_back(number->second);
    }
    draco::PointAttribute* const added =
        mesh->attribute(mesh->AddAttribute(attribute, false, std::uint32_t(firsts.size())));
    for (std::uint32_t number = 0; number < firsts.size(); ++number)
      added->SetAttributeValue(draco::AttributeValueIndex(number), value(firsts[number]).data());
    for (std::uint32_t row = 0; row < rows; ++row)
      added->SetPointMapEntry(draco::PointIndex(row), of_row[row]);
  }
  return mesh;
}

/// Compresses a mesh; `speed` is Draco's for encoding and decoding. Empty if Draco cannot.
std::string encoded(const draco::Mesh& mesh, const std::vector<Packed_column>& columns,
                    draco::MeshEncoderMethod method, int speed)
{
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(method);
  encoder.SetSpeedOptions(speed, speed);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!columns[i].quantisation)
      continue;
    const int bits = columns[i].quantisation->bits;
    if (columns[i].is_of_steps())
      encoder.SetAttributeExplicitQuantization(
          int(i), bits, int(columns[i].column->components),
          std::vector<float>(columns[i].column->components, placeholder(i)).data(), float((1u << bits) - 1));
    else
      encoder.SetAttributeQuantization(int(i), bits);
  }
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok())
    return {};
  std::string bytes(buffer.data(), buffer.size());
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].is_of_steps()) {
      const auto box = [](const std::vector<float>& origin, float range) {
        std::string result;
        for (const float coordinate : origin)
          append_little_endian(result, coordinate);
        append_little_endian(result, range);
        return result;
      };
      const auto& [bits, origin, range] = *columns[i].quantisation;
      const std::string steps =
          box(std::vector<float>(origin.size(), placeholder(i)), float((1u << bits) - 1));
      const std::size_t place = bytes.find(steps);
      if (place == std::string::npos)
        return {};
      bytes.replace(place, steps.size(), box(origin, range));
    }
  return bytes;
}

/// Returns what bytes stand for; null if they have another number of faces than `mesh`, or other attributes.
std::unique_ptr<draco::Mesh> decoded(const std::string& bytes, const draco::Mesh& mesh)
{
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  auto result = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  if (bytes.empty() || !result.ok() || result.value()->num_faces() != mesh.num_faces())
    return nullptr;
  for (int i = 0; i < mesh.num_attributes(); ++i) {
    const draco::PointAttribute* const attribute =
        result.value()->GetAttributeByUniqueId(mesh.attribute(i)->unique_id());
    if (!attribute || attribute->byte_stride() != mesh.attribute(i)->byte_stride())
      return nullptr;
  }
  return std::move(result).value();
}

/// Returns the bytes that an attribute has for a vertex.
std::string_view row_of(const draco::Mesh& mesh, std::uint32_t id, std::uint32_t row)
{
  const draco::PointAttribute& attribute = *mesh.GetAttributeByUniqueId(id);
  return {reinterpret_cast<const char*>(attribute.GetAddressOfMappedIndex(draco::PointIndex(row))),
          std::size_t(attribute.byte_stride())};
}

/// What a mesh holds, whatever the order of its vertices and triangles: their bytes, in ascending order.
/// Those of a triangle are from its least corner on.
struct Contents
{
  std::vector<std::string> vertices, triangles;
};

template <class Row_of>
Contents contents_of(const draco::Mesh& mesh, std::size_t columns, const Row_of& row)
{
  Contents result;
  for (std::uint32_t vertex = 0; vertex < mesh.num_points(); ++vertex) {
    std::string& bytes = result.vertices.emplace_back();
    for (std::size_t column = 0; column < columns; ++column)
      bytes += row(column, vertex);
  }
  for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i) {
    std::array<std::string_view, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = result.vertices[mesh.face(i)[k].value()];
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.triangles.push_back(std::string(corners[0]).append(corners[1]).append(corners[2]));
  }
  std::sort(result.vertices.begin(), result.vertices.end());
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

/// Whether the triangles are the same, and no vertices have become one.
bool is_same_but_split(const Contents& contents, const Contents& again)
{
  return again.triangles == contents.triangles &&
         std::includes(again.vertices.begin(), again.vertices.end(), contents.vertices.begin(),
                       contents.vertices.end());
}

/// A primitive in Draco's bytes.
struct Encoded
{
  std::string bytes;
  std::size_t vertices = 0;
};

/// Returns a primitive with its vertices and triangles in their order; none if Draco does not give them back.
/// What quantisation does not give back as it was is kept without it, and `columns` say so then.
std::optional<Encoded> encoded_in_order(std::vector<Packed_column>& columns,
                                        const std::vector<Index>& corners,
                                        const std::vector<std::uint32_t>& copies)
{
  const auto rows = std::uint32_t(copies.size());
  for (;;) {
    Cancellation_scope::check();
    const std::unique_ptr<draco::Mesh> mesh = draco_mesh(columns, corners, copies, 0);
    std::string bytes = encoded(*mesh, columns, draco::MESH_SEQUENTIAL_ENCODING, 0);
    const std::unique_ptr<draco::Mesh> again = decoded(bytes, *mesh);
    if (!again || again->num_points() != rows)
      return std::nullopt;
    for (draco::FaceIndex i(0); i < mesh->num_faces(); ++i)
      if (again->face(i) != mesh->face(i))
        return std::nullopt;
    bool is_same = true;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      std::uint32_t row = 0;
      while (row < rows &&
             row_of(*again, mesh->attribute(int(i))->unique_id(), row) == columns[i].column->row(row))
        ++row;
      if (row == rows)
        continue;
      if (!columns[i].quantisation)
        return std::nullopt;
      columns[i].quantisation.reset();
      is_same = false;
    }
    if (is_same)
      return Encoded{std::move(bytes), rows};
  }
}

/// Takes Draco's order instead, where that takes less space. How much depends on the column that tells
/// vertices apart, and on how values are predicted: 0 is best for smooth normals, 5 for flat ones.
void reorder(Encoded& least, const std::vector<Packed_column>& columns, const std::vector<Index>& corners,
             const std::vector<std::uint32_t>& copies)
{
  const bool are_all_different =
      std::all_of(copies.begin(), copies.end(), [](std::uint32_t copy) { return copy == 0; });
  std::optional<Contents> contents;
  for (std::size_t apart = 0; apart < (are_all_different ? 1 : columns.size()); ++apart) {
    Cancellation_scope::check();
    const std::unique_ptr<draco::Mesh> mesh = draco_mesh(columns, corners, copies, apart);
    std::string bytes;
    for (const int speed : {0, 5}) {
      std::string tried = encoded(*mesh, columns, draco::MESH_EDGEBREAKER_ENCODING, speed);
      if (bytes.empty() || (!tried.empty() && tried.size() < bytes.size()))
        bytes = std::move(tried);
    }
    if (bytes.size() >= least.bytes.size())
      continue;
    if (!contents)
      contents = contents_of(*mesh, columns.size(),
                             [&](std::size_t i, std::uint32_t row) { return columns[i].column->row(row); });
    // Edgebreaker makes several vertices of one at which fans of faces meet.
    const std::unique_ptr<draco::Mesh> again = decoded(bytes, *mesh);
    if (again && is_same_but_split(*contents,
                                   contents_of(*again, columns.size(), [&](std::size_t i, std::uint32_t row) {
                                     return row_of(*again, mesh->attribute(int(i))->unique_id(), row);
                                   })))
      least = {std::move(bytes), again->num_points()};
  }
}

} // namespace
#endif

std::optional<Draco_primitive> encoded_by_draco(const std::vector<Gltf_scene::Column>& columns,
                                                const std::vector<Index>& corners, bool may_reorder)
{
#ifdef SELVEDGE_HAS_DRACO
  const auto rows = std::uint32_t(columns.front().rows.size() / columns.front().row_size);
  std::size_t size = corners.size() * (rows < 0xffff ? 2 : 4);
  std::vector<Packed_column> packed;
  for (const Column& column : columns) {
    size += column.rows.size();
    packed.push_back({&column, column.compression->quantisation});
    if (packed.back().is_of_steps() &&
        (column.component_type != type_float32 || !is_exact_in_float(column.compression->quantisation->bits)))
      packed.back().quantisation.reset();
  }
  const std::vector<std::uint32_t> copies = earlier_copies(packed, rows);
  std::optional<Encoded> least = encoded_in_order(packed, corners, copies);
  if (least && may_reorder)
    reorder(*least, packed, corners, copies);
  if (!least || least->bytes.size() >= size)
    return std::nullopt;
  Draco_primitive result = {std::move(least->bytes), Gltf_scene::Json::object(), least->vertices, 0};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    result.attributes[columns[i].name] = i; // `draco_mesh` adds them in this order
    result.unquantised += columns[i].compression->quantisation && !packed[i].quantisation;
  }
  return result;
#else
  static_cast<void>(columns);
  static_cast<void>(corners);
  static_cast<void>(may_reorder);
  return std::nullopt;
#endif
}

std::optional<std::array<double, 3>> quantised_direction(const Gltf_scene::Column& column,
                                                         const std::array<double, 3>& direction)
{
  const auto quantised = [&](std::size_t k) { return column.nearest_quantised(direction[k], k); };
  if (column.quantised_accessor && column.quantised_accessor->value("normalized", false))
    return std::array<double, 3>{quantised(0), quantised(1), quantised(2)};
#ifdef SELVEDGE_HAS_DRACO
  if (!column.compression || !column.compression->quantisation)
    return std::nullopt;
  const Gltf_scene::Compression::Quantisation& quantisation = *column.compression->quantisation;
  if (!quantisation.origin.empty()) {    // steps in a box
    constexpr double most_beyond = 0.01; // of its size: a tangent that has turned with a normal, say
    for (std::size_t k = 0; k < 3; ++k) {
      const double from_corner = direction[k] - quantisation.origin[k], range = quantisation.range;
      if (!(std::max(-from_corner, from_corner - range) <= most_beyond * range))
        return std::nullopt;
    }
    return std::array<double, 3>{quantised(0), quantised(1), quantised(2)};
  }
  draco::OctahedronToolBox directions;
  std::int32_t s, t;
  std::array<float, 3> result;
  if (directions.SetQuantizationBits(quantisation.bits)) {
    directions.FloatVectorToQuantizedOctahedralCoords(direction.data(), &s, &t);
    directions.QuantizedOctahedralCoordsToUnitVector(s, t, result.data());
    return std::array<double, 3>{result[0], result[1], result[2]};
  }
#endif
  return std::nullopt;
}

#ifdef SELVEDGE_HAS_MESHOPTIMIZER
namespace {

template <class Number>
std::optional<std::string> encoded_indices(const std::string& bytes, bool may_rotate)
{
  std::vector<Number> indices(bytes.size() / sizeof(Number));
  std::memcpy(indices.data(), bytes.data(), bytes.size());
  const std::vector<unsigned> plain(indices.begin(), indices.end());
  std::vector<unsigned> again(plain.size());
  const std::size_t vertices = std::size_t(*std::max_element(plain.begin(), plain.end())) + 1;
  std::string result(may_rotate ? meshopt_encodeIndexBufferBound(plain.size(), vertices)
                                : meshopt_encodeIndexSequenceBound(plain.size(), vertices),
                     '\0');
  auto* const data = reinterpret_cast<unsigned char*>(result.data());
  meshopt_encodeIndexVersion(1);
  result.resize(may_rotate ? meshopt_encodeIndexBuffer(data, result.size(), plain.data(), plain.size())
                           : meshopt_encodeIndexSequence(data, result.size(), plain.data(), plain.size()));
  const int status = may_rotate
                         ? meshopt_decodeIndexBuffer(again.data(), again.size(), data, result.size())
                         : meshopt_decodeIndexSequence(again.data(), again.size(), data, result.size());
  if (status != 0)
    return std::nullopt;
  auto of_again = again.begin();
  for (auto corner = plain.begin(); corner != plain.end() && may_rotate; corner += 3, of_again += 3)
    std::rotate(of_again, std::find(of_again, of_again + 3, *corner), of_again + 3);
  return again == plain ? std::optional(result) : std::nullopt;
}

std::string encoded_rows(const std::string& bytes, std::size_t row_size)
{
  const std::size_t rows = bytes.size() / row_size;
  std::string result(meshopt_encodeVertexBufferBound(rows, row_size), '\0');
  auto* const data = reinterpret_cast<unsigned char*>(result.data());
  result.resize(meshopt_encodeVertexBuffer(data, result.size(), bytes.data(), rows, row_size));
  return result;
}

/// Returns numbers that the filter of directions, with so many bits, makes to those of a row. Empty if there
/// are none.
template <class Number>
std::optional<std::array<Number, 4>> filtered(const std::array<Number, 4>& row, int bits)
{
  const double x = row[0], y = row[1], z = row[2], sum = std::abs(x) + std::abs(y) + std::abs(z);
  if (sum == 0)
    return std::nullopt;
  const auto unfolded = [&](double at, double other) {
    return z >= 0 ? at / sum : std::copysign(1 - std::abs(other) / sum, at);
  };
  const int one = (1 << (bits - 1)) - 1;
  constexpr std::array<int, 3> steps = {0, -1, 1}; // rounding may have moved it
  std::array<std::array<Number, 4>, steps.size() * steps.size()> candidates;
  const auto coordinate = [&](double place, int step) {
    return Number(std::clamp(int(std::lround(place * one)) + step, -one, one));
  };
  for (std::size_t i = 0; i < candidates.size(); ++i)
    candidates[i] = {coordinate(unfolded(x, y), steps[i / steps.size()]),
                     coordinate(unfolded(y, x), steps[i % steps.size()]), Number(one), row[3]};
  auto decoded = candidates;
  meshopt_decodeFilterOct(decoded.data(), decoded.size(), sizeof row);
  const auto found = std::find(decoded.begin(), decoded.end(), row);
  return found == decoded.end() ? std::nullopt
                                : std::optional(candidates[std::size_t(found - decoded.begin())]);
}

/// Returns rows from which the filter of directions makes these, with as few bits as possible.
template <class Number>
std::optional<std::string> filtered(const std::string& bytes)
{
  constexpr int most_bits = 8 * sizeof(Number);
  for (int bits = 4; bits <= most_bits; ++bits) {
    Cancellation_scope::check();
    std::string result;
    for (std::size_t at = 0; at < bytes.size(); at += 4 * sizeof(Number)) {
      std::array<Number, 4> row;
      std::memcpy(row.data(), bytes.data() + at, sizeof row);
      const std::optional<std::array<Number, 4>> encoded = filtered(row, bits);
      if (!encoded)
        break;
      result.append(reinterpret_cast<const char*>(encoded->data()), sizeof row);
    }
    if (result.size() == bytes.size())
      return result;
  }
  return std::nullopt;
}

/// Returns what rows decode to; nothing if they do not.
std::optional<std::string> decoded_rows(const std::string& encoded, std::size_t size, std::size_t row_size,
                                        bool is_filtered)
{
  std::string result(size, '\0');
  if (meshopt_decodeVertexBuffer(result.data(), size / row_size, row_size,
                                 reinterpret_cast<const unsigned char*>(encoded.data()), encoded.size()) != 0)
    return std::nullopt;
  if (is_filtered)
    meshopt_decodeFilterOct(result.data(), size / row_size, row_size);
  return result;
}

} // namespace
#endif

std::optional<Gltf_scene::Meshopt_view> encoded_by_meshopt(const std::string& bytes, std::size_t row_size,
                                                           bool are_triangles, bool may_rotate)
{
#ifdef SELVEDGE_HAS_MESHOPTIMIZER
  const bool is_possible =
      !bytes.empty() && row_size > 0 && bytes.size() % row_size == 0 &&
      (are_triangles ? row_size == 2 || row_size == 4 : row_size % 4 == 0 && row_size <= 256);
  if (!is_possible || (are_triangles && bytes.size() / row_size % 3 != 0))
    return std::nullopt;
  Gltf_scene::Meshopt_view result;
  const char* filter = nullptr;
  if (are_triangles) {
    const std::optional<std::string> encoded = row_size == 2
                                                   ? encoded_indices<std::uint16_t>(bytes, may_rotate)
                                                   : encoded_indices<std::uint32_t>(bytes, may_rotate);
    if (!encoded)
      return std::nullopt;
    result.bytes = *encoded;
  } else {
    result.bytes = encoded_rows(bytes, row_size);
    const std::optional<std::string> rows = row_size == 4   ? filtered<std::int8_t>(bytes)
                                            : row_size == 8 ? filtered<std::int16_t>(bytes)
                                                            : std::nullopt;
    std::string encoded = rows ? encoded_rows(*rows, row_size) : std::string();
    if (rows && encoded.size() < result.bytes.size()) {
      result.bytes = std::move(encoded);
      filter = "OCTAHEDRAL";
    }
    if (decoded_rows(result.bytes, bytes.size(), row_size, filter != nullptr) != bytes)
      return std::nullopt;
  }
  if (result.bytes.size() >= bytes.size())
    return std::nullopt;
  result.extension = {{"byteLength", result.bytes.size()},
                      {"byteStride", row_size},
                      {"count", bytes.size() / row_size},
                      {"mode", !are_triangles ? "ATTRIBUTES"
                               : may_rotate   ? "TRIANGLES"
                                              : "INDICES"}};
  if (filter)
    result.extension["filter"] = filter;
  return result;
#else
  static_cast<void>(bytes);
  static_cast<void>(row_size);
  static_cast<void>(are_triangles);
  static_cast<void>(may_rotate);
  return std::nullopt;
#endif
}

} // namespace selvedge::files
