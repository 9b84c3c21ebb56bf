// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_GLTF_OUTPUT_H
#define SELVEDGE_SRC_FILES_GLTF_OUTPUT_H

#include "files/Byte_writer.h"
#include "soup/Gltf_scene.h"

#include <selvedge/mesh_files.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace selvedge::files {

/// A glTF document that is being made, with the bytes of its buffer views. New accessors and views first take
/// the numbers that are free in the scene, so that all others stay.
class Gltf_output
{
public:
  using Json = Gltf_scene::Json;
  using Column = Gltf_scene::Column;

  enum class Target { none = 0, vertices = 34962, indices = 34963 }; ///< of a buffer view

  /// `may_rotate` says whether the corners of triangles may be rotated where that compresses better, and
  /// `may_share_rows` whether columns that are the first rows of others are to be sought. Then none are
  /// interleaved.
  Gltf_output(const Gltf_scene& scene, bool may_rotate, bool may_share_rows);

  Json document; ///< references into it end when it gets a new key

  /// Puts a column of so many rows, and returns the number of its accessor. Accessors that say the same of
  /// the same bytes become one, as in files that share them. Columns that shared a buffer view in the file
  /// share one again: one behind the other or, of the same `block` of vertices, interleaved if they were.
  /// A column of vertices that is the first rows of an earlier one gets its buffer view.
  std::size_t put_accessor(const Column& column, std::size_t count, Target target, std::size_t block = 0);

  /// Puts an accessor whose bytes are compressed.
  std::size_t put_decoded_accessor(const Column& column, std::size_t count);

  /// Puts bytes, and returns the number of their buffer view.
  std::size_t put_bytes(std::string bytes);

  /// Returns what primitives that Draco compresses to these bytes have in the document; null until it is set.
  Json& compressed_primitive(const std::string& bytes) { return m_compressed_primitives[bytes]; }

  /// Completes the document and writes it. To be called once.
  void write(Byte_writer& out, Mesh_format format);

private:
  struct Written
  {
    Json rest; // of an accessor
    Target target;
    bool is_sparse;
    std::string sparse_rows; // in full
    std::size_t rows, accessor;
  };

  /// Rows of vertices or indices, which get a buffer view at the end.
  struct Rows
  {
    std::string bytes;
    std::size_t stride;
    bool has_gaps;
    Target target;
    std::optional<Gltf_scene::Place_in_view> place;
    std::size_t block;
    std::vector<std::pair<std::size_t, std::size_t>> accessors; // numbers and offsets
  };

  std::size_t add_accessor(Json accessor);
  bool put_sparse(Json& accessor, const Column& column, std::size_t count);
  std::size_t put_rows(const Column& column, std::string bytes, Target target, std::size_t block);
  void interleave();
  void put_views();
  std::size_t put_view(std::string bytes, Json view = Json::object());
  void embed_images();
  void fill_free();
  std::string put_buffer();
  std::optional<Gltf_scene::Meshopt_view> compressed_view(std::size_t view) const;

  bool m_is_compressed, m_may_rotate, m_may_share_rows;
  std::vector<std::string> m_views;
  std::map<Index, Gltf_scene::Meshopt_view> m_kept_views;    // as the file had them
  std::vector<Index> m_free_accessors, m_free_views;         // the first at the back
  std::map<Index, std::pair<std::size_t, bool>> m_row_sizes; // of new views of attributes and of triangles
  std::unordered_multimap<std::size_t, Written> m_written;   // by the hash of the bytes
  std::vector<Rows> m_rows;
  std::multimap<std::string, std::size_t> m_rows_by_first;
  std::map<std::string, Json> m_compressed_primitives;
};

/// Appends an index of the column's size to its rows.
void append_index(Gltf_scene::Column& column, Index index);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_GLTF_OUTPUT_H
