// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cells/Ply_rows.h"
#include "files/Byte_writer.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/cells.h>
#include <selvedge/mesh_files.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include <stdlib.h>
#include <unistd.h>

namespace selvedge {
namespace {

using cells::Ply_rows;

/// A file that is removed when it is no longer needed.
struct Removed_file
{
  std::filesystem::path path;

  explicit Removed_file(std::filesystem::path p) : path(std::move(p)) {}
  ~Removed_file()
  {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  Removed_file(const Removed_file&) = delete;
  Removed_file& operator=(const Removed_file&) = delete;
};

/// Divides space at medians of vertices, and finds the cells that a box meets.
class Cell_tree
{
public:
  /// `points` are some of the vertices, or all. `sizes` says how much of them each cell is to have.
  Cell_tree(std::vector<Point_3> points, const std::vector<double>& sizes)
  {
    divide({}, points.begin(), points.end(), sizes.begin(), sizes.end());
  }

  const std::vector<Cell>& cells() const { return m_cells; }

  /// Calls `function(number of the cell)` for each cell whose closure meets a closed box.
  template <class Function>
  void for_each_touched(const CGAL::Bbox_3& box, const Function& function, std::size_t node = 0) const
  {
    const Node& at = m_nodes[node];
    if (at.is_cell)
      return function(at.first);
    if (box.min(at.axis) <= at.plane)
      for_each_touched(box, function, at.first);
    if (box.max(at.axis) >= at.plane)
      for_each_touched(box, function, at.second);
  }

private:
  struct Node
  {
    bool is_cell = true;
    std::size_t first = 0, second = 0; ///< the number of the cell, or the nodes below and above the plane
    int axis = 0;
    double plane = 0;
  };
  using Point_iterator = std::vector<Point_3>::iterator;
  using Size_iterator = std::vector<double>::const_iterator;

  std::size_t divide(const Cell& box, Point_iterator first, Point_iterator beyond, Size_iterator first_size,
                     Size_iterator beyond_size)
  {
    Cancellation_scope::check();
    const std::size_t node = m_nodes.size();
    m_nodes.emplace_back();
    const Size_iterator middle_size = first_size + (beyond_size - first_size + 1) / 2;
    CGAL::Bbox_3 extent;
    for (Point_iterator p = first; p != beyond; ++p)
      extent += p->bbox();
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (extent.max(i) - extent.min(i) > extent.max(axis) - extent.min(axis))
        axis = i;
    if (middle_size == beyond_size || first == beyond || !(extent.min(axis) < extent.max(axis))) {
      m_nodes[node].first = m_cells.size();
      m_cells.push_back(box);
      return node;
    }
    double below = 0, all = 0;
    for (Size_iterator size = first_size; size != beyond_size; ++size) {
      all += *size;
      if (size < middle_size)
        below += *size;
    }
    const std::ptrdiff_t count = beyond - first;
    const Point_iterator middle = first + std::min(count - 1, std::ptrdiff_t(below / all * double(count)));
    std::nth_element(first, middle, beyond,
                     [axis](const Point_3& a, const Point_3& b) { return a[axis] < b[axis]; });
    const double plane = (*middle)[axis];
    // Vertices in the plane are in no cell.
    const Point_iterator end_below =
        std::partition(first, beyond, [&](const Point_3& p) { return p[axis] < plane; });
    const Point_iterator begin_above =
        std::partition(end_below, beyond, [&](const Point_3& p) { return !(p[axis] > plane); });
    Cell lower = box, upper = box;
    lower.high[axis] = upper.low[axis] = plane;
    const std::size_t node_below = divide(lower, first, end_below, first_size, middle_size);
    const std::size_t node_above = divide(upper, begin_above, beyond, middle_size, beyond_size);
    m_nodes[node] = {false, node_below, node_above, axis, plane};
    return node;
  }

  std::vector<Node> m_nodes;
  std::vector<Cell> m_cells;
};

/// Bytes in several lists, in one temporary file, which nobody else sees. Appends to any of the lists are
/// gathered in blocks.
class Byte_lists
{
public:
  Byte_lists(std::size_t lists, const std::filesystem::path& folder)
      : m_lists(lists), m_name((folder / "selvedge.XXXXXX").string())
  {
    const int descriptor = ::mkstemp(m_name.data());
    m_file.reset(descriptor < 0 ? nullptr : ::fdopen(descriptor, "w+b"));
    if (!m_file)
      fail();
    std::remove(m_name.c_str());
  }

  void append(std::size_t list, std::string_view bytes)
  {
    List& to = m_lists[list];
    to.buffer += bytes;
    if (to.buffer.size() >= block_size)
      flush(to);
  }

  /// Returns all bytes of a list. To be called after the last `append`.
  std::string bytes_of(std::size_t list)
  {
    List& from = m_lists[list];
    std::string bytes;
    for (const auto& [place, size] : from.blocks) {
      Cancellation_scope::check();
      const std::size_t before = bytes.size();
      bytes.resize(before + size);
      if (::fseeko(m_file.get(), place, SEEK_SET) != 0 ||
          std::fread(bytes.data() + before, 1, size, m_file.get()) != size)
        fail();
    }
    return bytes += std::exchange(from.buffer, {});
  }

private:
  static constexpr std::size_t block_size = 1 << 16;

  struct List
  {
    std::string buffer;
    std::vector<std::pair<off_t, std::size_t>> blocks; ///< where they are in the file, and their sizes
  };
  struct Close
  {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void flush(List& list)
  {
    if (std::fwrite(list.buffer.data(), 1, list.buffer.size(), m_file.get()) != list.buffer.size())
      fail();
    list.blocks.emplace_back(m_size, list.buffer.size());
    m_size += off_t(list.buffer.size());
    list.buffer.clear();
  }

  [[noreturn]] void fail() const
  {
    throw Output_error(m_name + ": the temporary file of the faces cannot be written or read; make room, or "
                                "choose another folder for the pieces");
  }

  std::vector<List> m_lists;
  std::string m_name;
  std::unique_ptr<std::FILE, Close> m_file;
  off_t m_size = 0;
};

std::vector<Point_3> sample_of(const Ply_rows& rows)
{
  constexpr std::size_t most = 1 << 20; // medians of more would move the walls by less than they matter
  const std::size_t step = (rows.number_of_vertices() + most - 1) / most;
  std::vector<Point_3> sample;
  Cancellation_poll poll;
  for (std::size_t v = 0; v < rows.number_of_vertices(); ++v) {
    poll();
    const Point_3 p = rows.point(v);
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
      throw Input_error(rows.name() + ": vertex " + std::to_string(v) +
                        " has a coordinate that is not finite; remove or repair it");
    if (v % step == 0)
      sample.push_back(p);
  }
  return sample;
}

void check(const Cut_options& options)
{
  if (options.cells.has_value() == options.faces_per_cell.has_value() || options.cells == 0 ||
      options.faces_per_cell == 0)
    throw Argument_error("give the number of cells or that of faces per cell, one of the two, at least 1");
  if (!(options.shift >= 0 && options.shift < 1))
    throw Argument_error("the shift of the walls must be at least 0 and less than 1");
}

/// Returns how large each cell is to be, in proportion.
std::vector<double> sizes_of_cells(const Cut_options& options, std::size_t faces)
{
  const std::size_t cells = options.cells ? *options.cells : (faces - 1) / *options.faces_per_cell + 1;
  std::vector<double> sizes(std::clamp<std::size_t>(cells, 1, faces), 1);
  if (options.shift > 0) {
    sizes.front() = options.shift;
    sizes.push_back(1 - options.shift);
  }
  return sizes;
}

/// Writes the piece of a cell. `faces` are its rows.
Cell_piece write_piece(const Ply_rows& rows, const Cell& cell, std::string_view faces,
                       const std::filesystem::path& path)
{
  Cell_piece piece{cell, path};
  std::vector<Index> vertices; // in ascending order, those that are used
  for (std::string_view left = faces; !left.empty(); ++piece.faces) {
    const Ply_rows::Face face = rows.take_face(left);
    for (std::size_t i = 0; i < face.corners; ++i)
      vertices.push_back(rows.corner(face, i));
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  piece.vertices = vertices.size();

  files::Byte_writer out(path);
  out << "ply\nformat binary_little_endian 1.0\n"
      << rows.comments() << "element vertex " << piece.vertices << '\n'
      << rows.vertex_properties() << "property uint " << vertex_in_whole_property << "\nelement face "
      << piece.faces << '\n'
      << rows.face_properties() << "property uchar " << fixed_property << "\nend_header\n";
  for (const Index v : vertices) {
    out << rows.vertex_row(v);
    out.binary(v);
  }
  std::string row;
  for (std::string_view left = faces; !left.empty();) {
    const Ply_rows::Face face = rows.take_face(left);
    row = face.row;
    bool is_free = true;
    for (std::size_t i = 0; i < face.corners; ++i) {
      const Index v = rows.corner(face, i);
      is_free = is_free && cell.contains(rows.point(v));
      rows.set_corner(row, face, i,
                      Index(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin()));
    }
    piece.fixed_faces += !is_free;
    out << row << char(!is_free);
  }
  out.commit();
  return piece;
}

Cut_mesh cut(const Ply_rows& rows, const Cut_options& options,
             const std::function<std::filesystem::path(std::size_t)>& name_of_piece)
{
  if (rows.number_of_faces() == 0)
    throw Input_error(rows.name() + ": the file has no faces; export the mesh as polygons");
  if (rows.number_of_vertices() >= std::numeric_limits<Index>::max())
    throw Input_error(rows.name() + ": the mesh has more than 4294967294 vertices; split it");
  if (rows.has_vertex_property(vertex_in_whole_property) || rows.has_face_property(fixed_property))
    throw Input_error(rows.name() + ": has the property '" + std::string(vertex_in_whole_property) +
                      "' or '" + std::string(fixed_property) +
                      "', as pieces have; join the pieces before they are cut again, or rename it");
  const Cell_tree tree(sample_of(rows), sizes_of_cells(options, rows.number_of_faces()));
  const std::filesystem::path folder = name_of_piece(1).parent_path();
  Byte_lists faces_of_cells(tree.cells().size(), folder.empty() ? "." : folder);
  std::string_view left = rows.rows_of_faces();
  Cancellation_poll poll;
  for (std::size_t f = 0; f < rows.number_of_faces(); ++f) {
    poll();
    const Ply_rows::Face face = rows.take_face(left);
    CGAL::Bbox_3 box;
    for (std::size_t i = 0; i < face.corners; ++i)
      box += rows.point(rows.corner(face, i)).bbox();
    if (face.corners >= 3)
      tree.for_each_touched(box, [&](std::size_t cell) { faces_of_cells.append(cell, face.row); });
  }

  Cut_mesh result;
  result.vertices = rows.number_of_vertices();
  result.faces = rows.number_of_faces();
  for (std::size_t i = 0; i < tree.cells().size(); ++i)
    if (const std::string faces = faces_of_cells.bytes_of(i); !faces.empty())
      result.pieces.push_back(
          write_piece(rows, tree.cells()[i], faces, name_of_piece(result.pieces.size() + 1)));
  if (result.pieces.empty())
    throw Input_error(rows.name() + ": the file has no faces; export the mesh as polygons");
  for (const std::string& name : rows.other_elements())
    result.ignored.push_back("elements '" + name + "'");
  return result;
}

} // namespace

Cut_mesh cut_into_cells(const std::filesystem::path& mesh, const Cut_options& options,
                        const std::function<std::filesystem::path(std::size_t)>& name_of_piece)
{
  check(options);
  if (mesh_format(mesh) == Mesh_format::ply)
    if (const std::optional<Ply_rows> rows = Ply_rows::open(mesh))
      return cut(*rows, options, name_of_piece);
  const Removed_file plain(name_of_piece(1).string() + ".whole.ply");
  std::vector<std::string> lost;
  {
    const Triangle_soup soup = read_mesh(mesh).soup;
    lost = not_carried(soup, Mesh_format::ply);
    write_mesh(plain.path, soup);
  }
  Cut_mesh result = cut(Ply_rows::open(plain.path).value(), options, name_of_piece);
  result.ignored.insert(result.ignored.end(), lost.begin(), lost.end());
  return result;
}

} // namespace selvedge
