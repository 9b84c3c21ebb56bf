// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/gltf_column_reader.h"

#include <selvedge/Cancellation_scope.h>

#include <cmath>

// Copies rows of numbers out of the buffers of a glTF file, and checks that the file has them.

namespace selvedge::files {

Gltf_scene::Column Gltf_column_reader::read(int number, const std::string& name, std::size_t count) const
{
  if (number < 0 || std::size_t(number) >= m_document.model.accessors.size())
    fail(m_place + ": " + name + " names accessor " + std::to_string(number) +
         ", which is not there; export the file again");
  const tinygltf::Accessor& accessor = m_document.model.accessors[number];
  if (accessor.count != count)
    fail(m_place + ": " + name + " has " + std::to_string(accessor.count) + " rows for " +
         std::to_string(count) + " vertices; export the file again");
  Column column;
  column.name = name;
  column.component_type = accessor.componentType;
  const std::size_t size = component_size(accessor.componentType);
  if (size == 0)
    fail(m_place + ": " + name + " is of a type that glTF does not know; export the file again");
  // Columns of matrices begin at multiples of four bytes.
  const auto matrix = [&](std::size_t order) { return order * ((order * size + 3) / 4 * 4); };
  switch (accessor.type) {
  case TINYGLTF_TYPE_MAT2:
    column.components = 4, column.row_size = matrix(2);
    break;
  case TINYGLTF_TYPE_MAT3:
    column.components = 9, column.row_size = matrix(3);
    break;
  case TINYGLTF_TYPE_MAT4:
    column.components = 16, column.row_size = matrix(4);
    break;
  default:
    column.components = accessor.type == TINYGLTF_TYPE_SCALAR ? 1 : std::size_t(accessor.type);
    column.row_size = column.components * size;
  }
  column.accessor = m_document.json["accessors"][number];
  for (const char* key : {"bufferView", "byteOffset", "sparse", "count"})
    column.accessor.erase(key);
  if (accessor.bufferView >= 0) {
    column.rows = rows(accessor.bufferView, accessor.byteOffset, column.row_size, count, true);
    const std::size_t stride = m_document.model.bufferViews[accessor.bufferView].byteStride;
    column.place = {Index(accessor.bufferView), accessor.byteOffset, stride == 0 ? column.row_size : stride};
  } else
    column.rows.assign(count * column.row_size, '\0');
  if (accessor.sparse.isSparse)
    put_sparse_values(accessor, column, count);
  column.is_sparse = accessor.sparse.isSparse && accessor.bufferView < 0;
  Cancellation_poll poll;
  if (column.component_type == type_float32)
    for (std::size_t i = 0; i < count; ++i) {
      poll();
      for (std::size_t k = 0; k < column.components; ++k)
        if (!std::isfinite(component(column, i, k)))
          fail(m_place + ": " + name + " of vertex " + std::to_string(i) +
               " is not finite; remove or repair it");
    }
  return column;
}

std::string_view Gltf_column_reader::view(int number) const
{
  if (number < 0 || std::size_t(number) >= m_document.model.bufferViews.size())
    fail(m_place + ": buffer view " + std::to_string(number) + " is not there; export the file again");
  const tinygltf::BufferView& range = m_document.model.bufferViews[number];
  if (range.buffer < 0 || std::size_t(range.buffer) >= m_document.model.buffers.size())
    fail("buffer view " + std::to_string(number) +
         " names a buffer that is not there; export the file again");
  const std::vector<unsigned char>& bytes = m_document.model.buffers[range.buffer].data;
  if (range.byteOffset > bytes.size() || range.byteLength > bytes.size() - range.byteOffset)
    fail("buffer view " + std::to_string(number) + " ends beyond its buffer; export the file again");
  return {reinterpret_cast<const char*>(bytes.data()) + range.byteOffset, range.byteLength};
}

std::string Gltf_column_reader::rows(int number, std::size_t offset, std::size_t row_size, std::size_t count,
                                     bool may_have_gaps) const
{
  const std::string_view bytes = view(number);
  const std::size_t gap = may_have_gaps ? m_document.model.bufferViews[number].byteStride : 0,
                    stride = gap == 0 ? row_size : gap;
  // No product overflows: the count is at most that of bytes.
  if (count == 0 || count > bytes.size() || offset > bytes.size() || row_size > bytes.size() - offset ||
      (count - 1) * stride > bytes.size() - offset - row_size)
    fail(m_place + ": an accessor has no rows or reaches beyond buffer view " + std::to_string(number) +
         "; export the file again");
  std::string result;
  result.reserve(count * row_size);
  Cancellation_poll poll;
  for (std::size_t i = 0; i < count; ++i) {
    poll();
    result.append(bytes, offset + i * stride, row_size);
  }
  return result;
}

void Gltf_column_reader::put_sparse_values(const tinygltf::Accessor& accessor, Column& column,
                                           std::size_t count) const
{
  const auto& sparse = accessor.sparse;
  Column indices;
  indices.component_type = sparse.indices.componentType;
  indices.row_size = component_size(indices.component_type);
  if (sparse.count < 1 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 ||
      (indices.component_type != type_uint8 && indices.component_type != type_uint16 &&
       indices.component_type != type_uint32))
    fail(m_place + ": the sparse part of " + column.name + " is not valid; export the file again");
  indices.rows = rows(sparse.indices.bufferView, sparse.indices.byteOffset, indices.row_size, sparse.count);
  const std::string values =
      rows(sparse.values.bufferView, sparse.values.byteOffset, column.row_size, sparse.count);
  for (std::size_t i = 0; i < std::size_t(sparse.count); ++i) {
    const double row = component(indices, i, 0);
    if (row >= double(count))
      fail(m_place + ": the sparse part of " + column.name +
           " names a vertex that is not there; export the file again");
    column.rows.replace(std::size_t(row) * column.row_size, column.row_size, values, i * column.row_size,
                        column.row_size);
  }
}

} // namespace selvedge::files
