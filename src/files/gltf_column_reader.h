// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_GLTF_COLUMN_READER_H
#define SELVEDGE_SRC_FILES_GLTF_COLUMN_READER_H

#include "files/gltf_document.h"

namespace selvedge::files {

/// Reads the accessors and buffer views of a document, for `read_gltf`. Every function throws `Input_error`
/// when one is not there, reaches beyond the bytes that it lies in, or holds what a column cannot.
class Gltf_column_reader
{
public:
  /// Keeps the document by reference. `place` names in messages what refers to the accessors.
  Gltf_column_reader(const Gltf_document& document, std::string place)
      : m_document(document), m_place(std::move(place))
  {
  }

  /// Returns the accessor of this number, which must have `count` rows, as a column of this name.
  Gltf_scene::Column read(int number, const std::string& name, std::size_t count) const;

  /// Returns the bytes of the buffer view of this number.
  std::string_view view(int number) const;

private:
  using Column = Gltf_scene::Column;

  // Returns the rows in a buffer view without the gaps between them.
  std::string rows(int number, std::size_t offset, std::size_t row_size, std::size_t count,
                   bool may_have_gaps = false) const;
  void put_sparse_values(const tinygltf::Accessor& accessor, Column& column, std::size_t count) const;
  [[noreturn]] void fail(const std::string& message) const { m_document.fail(message); }

  const Gltf_document& m_document;
  std::string m_place;
};

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_GLTF_COLUMN_READER_H
