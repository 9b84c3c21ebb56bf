// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/row_unlike.h"
#include "soup/selection.h"

#include <selvedge/Error.h>
#include <selvedge/cells.h>
#include <selvedge/verify.h>

#include <boost/functional/hash.hpp>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <map>
#include <optional>

namespace selvedge {
namespace {

constexpr Index no_number = std::numeric_limits<Index>::max();

/// The positions of a triangle, the least one first, in the order around it.
using Corner_positions = std::array<std::array<double, 3>, 3>;

/// Returns these positions, and sets `first` to the corner that comes first.
Corner_positions corner_positions(const Triangle_soup& soup, Index triangle, int& first)
{
  Corner_positions corners;
  for (int i = 0; i < 3; ++i) {
    const Point_3& p = soup.points[soup.triangles[triangle][i]];
    corners[i] = {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}; // −0 becomes 0
  }
  first = int(std::min_element(corners.begin(), corners.end()) - corners.begin());
  std::rotate(corners.begin(), corners.begin() + first, corners.end());
  return corners;
}

bool is_free(const Triangle_soup& soup, Index triangle, const Cell& cell)
{
  const Index_triple& corners = soup.triangles[triangle];
  return std::all_of(corners.begin(), corners.end(), [&](Index v) { return cell.contains(soup.points[v]); });
}

CGAL::Bbox_3 box_of(const Triangle_soup& soup, Index triangle)
{
  CGAL::Bbox_3 box;
  for (const Index v : soup.triangles[triangle])
    box += soup.points[v].bbox();
  return box;
}

/// The fixed faces of a piece, to be taken out one by one.
class Fixed_faces
{
public:
  Fixed_faces(const Triangle_soup& piece, const Cell& cell)
  {
    int first = 0;
    for (Index t = Index(piece.triangles.size()); t-- > 0;)
      if (!is_free(piece, t, cell))
        m_faces[corner_positions(piece, t, first)].push_back(t);
  }

  /// Takes out the first face at these positions; none when there is none left.
  std::optional<Index> take(const Corner_positions& positions)
  {
    const auto found = m_faces.find(positions);
    if (found == m_faces.end() || found->second.empty())
      return std::nullopt;
    const Index face = found->second.back();
    found->second.pop_back();
    return face;
  }

  /// Returns the faces that are left, but for those with two corners at one position, in ascending order.
  std::vector<Index> left() const
  {
    std::vector<Index> left;
    for (const auto& [corners, faces] : m_faces)
      if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
        left.insert(left.end(), faces.begin(), faces.end());
    std::sort(left.begin(), left.end());
    return left;
  }

private:
  /// Of equal ones, the first is at the back.
  std::unordered_map<Corner_positions, std::vector<Index>, boost::hash<Corner_positions>> m_faces;
};

std::string described(const Triangle_soup& soup, Index triangle)
{
  std::string text = "face " + std::to_string(triangle + 1) + " at ";
  const char* separator = "(";
  for (int i = 0; i < 3; ++i, separator = ", ") {
    char number[32];
    std::snprintf(number, sizeof number, "%.6g", soup.points[soup.triangles[triangle][0]][i]);
    text += separator + std::string(number);
  }
  return text + ')';
}

/// Returns the numbers that the vertices of a piece have in the whole.
std::vector<Index> numbers_in_whole(const Triangle_soup& piece, const std::string& name)
{
  for (const Attribute& attribute : piece.vertex_attributes)
    if (attribute.name == vertex_in_whole_property && attribute.components == 1 &&
        attribute.type == Attribute::Type::uint32) {
      std::vector<Index> numbers(piece.points.size());
      std::memcpy(numbers.data(), attribute.rows.data(), attribute.rows.size());
      return numbers;
    }
  throw Input_error(name + ": its vertices have no property '" + std::string(vertex_in_whole_property) +
                    "'; give the piece as it was cut");
}

void remove_named(std::vector<Attribute>& attributes, std::string_view name)
{
  attributes.erase(std::remove_if(attributes.begin(), attributes.end(),
                                  [&](const Attribute& attribute) { return attribute.name == name; }),
                   attributes.end());
}

/// Appends values and their numbers. When only one of the two soups has them, the joined one has none.
/// Returns whether that is so.
template <std::size_t dimension>
bool append(Corner_values<dimension>& to, const Corner_values<dimension>& from, bool is_first)
{
  if (is_first)
    to = from;
  if (is_first || (to.empty() && from.empty()))
    return false;
  if (to.empty() != from.empty()) {
    to = {};
    return true;
  }
  const Index begin = Index(to.values.size());
  to.values.insert(to.values.end(), from.values.begin(), from.values.end());
  if (from.missing && !to.missing)
    to.missing = begin + *from.missing;
  for (const Index_triple& numbers : from.of_triangle) {
    Index_triple& added = to.of_triangle.emplace_back();
    for (int i = 0; i < 3; ++i)
      added[i] = from.missing && numbers[i] == *from.missing ? *to.missing : begin + numbers[i];
  }
  return false;
}

/// Appends names and their numbers. Triangles of a soup that names none get the empty name.
void append(Triangle_labels& to, std::size_t triangles_of_to, const Triangle_labels& from,
            std::size_t triangles_of_from)
{
  if (to.empty() && from.empty())
    return;
  std::map<std::string, Index> numbers;
  for (std::size_t i = 0; i < to.names.size(); ++i)
    numbers.emplace(to.names[i], Index(i));
  const auto number_of = [&](const std::string& name) {
    const auto [it, is_new] = numbers.emplace(name, Index(to.names.size()));
    if (is_new)
      to.names.push_back(name);
    return it->second;
  };
  if (to.empty())
    to.of_triangle.assign(triangles_of_to, triangles_of_to > 0 ? number_of("") : 0);
  if (from.empty()) {
    to.of_triangle.insert(to.of_triangle.end(), triangles_of_from, number_of(""));
    return;
  }
  std::vector<Index> number; // by that in `from`
  for (const std::string& name : from.names)
    number.push_back(number_of(name));
  for (const Index of_triangle : from.of_triangle)
    to.of_triangle.push_back(number[of_triangle]);
}

} // namespace

Cell_join::Cell_join(std::vector<Cell> cells) : m_cells(std::move(cells)) {}

void Cell_join::add(std::size_t number, const Triangle_soup& piece, Triangle_soup result,
                    const std::string& piece_name, const std::string& result_name)
{
  const Cell& cell = m_cells.at(number);
  const auto refuse = [&](const std::string& message) { throw Input_error(result_name + ": " + message); };

  CGAL::Bbox_3 box_of_piece;
  for (Index t = 0; t < piece.triangles.size(); ++t)
    box_of_piece += box_of(piece, t);
  // A face that several pieces have is taken from that of the first cell that it touches. (A triangle of a
  // polygon need not touch every cell whose piece has the polygon.)
  std::vector<Cell> earlier;
  std::copy_if(m_cells.begin(), m_cells.begin() + std::ptrdiff_t(number), std::back_inserter(earlier),
               [&](const Cell& c) { return c.touches(box_of_piece); });
  const auto is_taken_here = [&](const CGAL::Bbox_3& box) {
    return cell.touches(box) &&
           std::none_of(earlier.begin(), earlier.end(), [&](const Cell& c) { return c.touches(box); });
  };
  Fixed_faces fixed(piece, cell);
  const std::vector<Index> numbers_of_piece = numbers_in_whole(piece, piece_name);
  std::vector<Index> numbers(result.points.size(), no_number), taken;
  std::vector<Index_triple> corners;
  for (Index t = 0; t < result.triangles.size(); ++t) {
    bool is_taken = true;
    if (!is_free(result, t, cell)) {
      int first = 0, first_of_piece = 0;
      const std::optional<Index> same = fixed.take(corner_positions(result, t, first));
      if (!same)
        refuse(described(result, t) + " reaches out of its cell, and is no fixed face of " + piece_name +
               "; keep faces with a corner on or beyond a wall as they are, and all others inside, in the "
               "precision of that file");
      corner_positions(piece, *same, first_of_piece);
      for (int i = 0; i < 3; ++i)
        numbers[result.triangles[t][(first + i) % 3]] =
            numbers_of_piece[piece.triangles[*same][(first_of_piece + i) % 3]];
      is_taken = is_taken_here(box_of(result, t));
    }
    if (is_taken) {
      taken.push_back(t);
      corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
  }
  if (const std::vector<Index> missing = fixed.left(); !missing.empty())
    refuse("of the fixed faces of " + piece_name + ", " + std::to_string(missing.size()) +
           " are missing, the first of them " + described(piece, missing.front()) +
           "; keep faces with a corner on or beyond a wall as they are");
  if (const std::vector<Offending_pair> pairs = offending_pairs(result); !pairs.empty()) {
    const std::vector<Offending_pair> added = new_pairs(result, pairs, piece, offending_pairs(piece));
    if (!added.empty())
      refuse(std::to_string(added.size()) + " pairs of faces offend that did not in " + piece_name +
             ", the first of them faces " + std::to_string(added.front().first + 1) + " and " +
             std::to_string(added.front().second + 1) +
             "; reduce the piece without making faces touch (selvedge simplify --defects freeze)");
    m_pairs += pairs.size();
  }
  Verify_options options;
  options.are_shapes_judged = false;
  options.may_be_rounded = false;
  if (const Piece_matching matching = match_pieces(result, piece, options); !matching.is_complete())
    refuse("its connected pieces are not those of " + piece_name + ": " +
           matching.mismatches.front().message);

  remove_named(result.vertex_attributes, vertex_in_whole_property);
  remove_named(result.triangle_attributes, fixed_property);
  Attribute column{std::string(vertex_in_whole_property), Attribute::Type::uint32, 1, false, {}};
  column.rows.resize(numbers.size() * sizeof(Index));
  std::memcpy(column.rows.data(), numbers.data(), column.rows.size());
  result.vertex_attributes.push_back(std::move(column)); // so that `selected` takes the numbers along
  append(selected(result, taken, corners));
}

void Cell_join::keep_common_attributes(std::vector<Attribute>& of_whole, std::vector<Attribute>& of_part)
{
  const auto is_in = [](const std::vector<Attribute>& attributes, const Attribute& a) {
    return std::any_of(attributes.begin(), attributes.end(), [&](const Attribute& b) {
      return a.name == b.name && a.type == b.type && a.components == b.components &&
             a.is_normalized == b.is_normalized;
    });
  };
  for (auto [kept, other] : {std::make_pair(&of_whole, &of_part), std::make_pair(&of_part, &of_whole)})
    kept->erase(std::remove_if(kept->begin(), kept->end(),
                               [&, &others = *other](const Attribute& attribute) {
                                 const bool is_lost = !is_in(others, attribute);
                                 if (is_lost)
                                   m_lost.insert(attribute.name);
                                 return is_lost;
                               }),
                kept->end());
}

void Cell_join::append(Triangle_soup part)
{
  if (part.triangles.empty())
    return;
  const std::vector<Index> numbers = numbers_in_whole(part, "");
  remove_named(part.vertex_attributes, vertex_in_whole_property);
  const bool is_first = m_whole.points.empty();
  const std::size_t triangles = m_whole.triangles.size();
  if (is_first) {
    for (const auto& [to, from] : {std::make_pair(&m_whole.vertex_attributes, &part.vertex_attributes),
                                   std::make_pair(&m_whole.triangle_attributes, &part.triangle_attributes)})
      for (const Attribute& a : *from)
        to->push_back({a.name, a.type, a.components, a.is_normalized, {}});
    m_whole.material_libraries = part.material_libraries;
    m_whole.header_comments = part.header_comments;
  } else {
    keep_common_attributes(m_whole.vertex_attributes, part.vertex_attributes);
    keep_common_attributes(m_whole.triangle_attributes, part.triangle_attributes);
  }
  const auto attribute_of_part = [](const std::vector<Attribute>& attributes, const std::string& name) {
    return std::find_if(attributes.begin(), attributes.end(),
                        [&](const Attribute& a) { return a.name == name; });
  };

  std::vector<Index> vertices; // by their numbers in the part
  std::vector<Index> added;
  for (Index v = 0; v < part.points.size(); ++v) {
    const Index next = Index(m_whole.points.size());
    const Index vertex = numbers[v] == no_number ? next : m_vertices.emplace(numbers[v], next).first->second;
    vertices.push_back(vertex);
    if (vertex == next) {
      m_whole.points.push_back(part.points[v]);
      added.push_back(v);
    }
  }
  for (Attribute& attribute : m_whole.vertex_attributes) {
    const auto from = attribute_of_part(part.vertex_attributes, attribute.name);
    for (const Index v : added)
      append_row(attribute.rows, *from, v);
  }
  for (Attribute& attribute : m_whole.triangle_attributes) {
    const auto from = attribute_of_part(part.triangle_attributes, attribute.name);
    attribute.rows.insert(attribute.rows.end(), from->rows.begin(), from->rows.end());
  }
  for (const auto& [a, b, c] : part.triangles)
    m_whole.triangles.push_back({vertices[a], vertices[b], vertices[c]});
  if (selvedge::append(m_whole.uvs, part.uvs, is_first))
    m_lost.insert("texture coordinates");
  if (selvedge::append(m_whole.normals, part.normals, is_first))
    m_lost.insert("normals");
  for (Triangle_labels Triangle_soup::*labels : {&Triangle_soup::groups, &Triangle_soup::objects,
                                                 &Triangle_soup::materials, &Triangle_soup::smoothing_groups})
    selvedge::append(m_whole.*labels, triangles, part.*labels, part.triangles.size());
  for (const Cut_polygon& polygon : part.polygons)
    m_whole.polygons.push_back({Index(triangles + polygon.first_triangle), polygon.corners, polygon.start});
}

Triangle_soup Cell_join::take()
{
  // The value of corners that have none must be unlike all others.
  if (m_whole.uvs.missing)
    m_whole.uvs.values[*m_whole.uvs.missing] = files::row_unlike(m_whole.uvs.values);
  if (m_whole.normals.missing)
    m_whole.normals.values[*m_whole.normals.missing] = files::row_unlike(m_whole.normals.values);
  return std::move(m_whole);
}

} // namespace selvedge
