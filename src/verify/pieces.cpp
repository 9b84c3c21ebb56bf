// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pieces.h"

#include "sides.h"

#include "soup/Disjoint_sets.h"
#include "soup/check_soup.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

// Finds the pieces of a mesh by vertex numbers and counts their edges, boundary loops and Euler
// characteristics, for `verify`.

namespace selvedge {

using namespace internal;

namespace {

// Takes the corners of triangles that have the same three vertices as an earlier one together, so that they
// are no faces: a complex has one face between three vertices.
std::vector<Index_triple> without_repetitions(std::vector<Index_triple> triangles)
{
  std::vector<std::array<Index, 4>> keys; // the vertices in ascending order, and the triangle
  for (Index t = 0; t < triangles.size(); ++t)
    if (is_face(triangles[t])) {
      Index_triple v = triangles[t];
      std::sort(v.begin(), v.end());
      keys.push_back({v[0], v[1], v[2], t});
    }
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (std::equal(keys[i].begin(), keys[i].begin() + 3, keys[i - 1].begin()))
      triangles[keys[i][3]] = {keys[i][0], keys[i][0], keys[i][0]};
  return triangles;
}

// Takes the corners of triangles with two corners at one position together, so that they are no faces.
template <class Are_at_one_position>
std::vector<Index_triple> with_an_inside(std::vector<Index_triple> triangles, const Are_at_one_position& are)
{
  for (auto& [a, b, c] : triangles)
    if (are(a, b) || are(b, c) || are(c, a))
      b = c = a;
  return triangles;
}

} // namespace

Numbered_pieces internal::numbered_pieces(const std::vector<Index_triple>& triangles, std::size_t vertices)
{
  const std::vector<Index_triple> faces = without_repetitions(triangles);
  Disjoint_sets connected(vertices);
  for (const Index_triple& triangle : triangles)
    if (is_face(triangle)) {
      connected.unite(triangle[0], triangle[1]);
      connected.unite(triangle[0], triangle[2]);
    }

  Numbered_pieces result;
  std::vector<Piece>& pieces = result.pieces;
  result.of_triangle.assign(triangles.size(), no_piece);
  std::vector<Index> piece_of_set(vertices, no_piece);
  const auto piece_of = [&](Index vertex) -> Piece& { return pieces[piece_of_set[connected.find(vertex)]]; };
  std::vector<bool> used(vertices);
  for (Index i = 0; i < triangles.size(); ++i)
    if (is_face(triangles[i])) {
      Index& number = piece_of_set[connected.find(triangles[i][0])];
      if (number == no_piece) {
        number = static_cast<Index>(pieces.size());
        pieces.push_back(Piece{i, 0, 0, 0, 0, 0, 0});
      }
      result.of_triangle[i] = number;
      Piece& piece = pieces[number];
      ++piece.faces;
      piece.euler_characteristic += is_face(faces[i]);
      for (const Index vertex : triangles[i])
        if (!used[vertex]) {
          used[vertex] = true;
          ++piece.vertices;
          ++piece.euler_characteristic;
        }
    }

  // The fans of faces around the vertices, as sets of corners.
  Disjoint_sets fans(3 * triangles.size());
  std::vector<Side> borders;
  const std::vector<Side> sides = sorted_sides(faces, vertices);
  Cancellation_poll poll;
  for (auto first = sides.begin(), last = first; first != sides.end(); first = last) {
    poll();
    for (; last != sides.end() && last->low == first->low && last->high == first->high; ++last) {
      fans.unite(first->corner_at_low, last->corner_at_low);
      fans.unite(first->corner_at_high, last->corner_at_high);
    }
    Piece& piece = piece_of(first->low);
    --piece.euler_characteristic;
    if (last - first == 1) {
      ++piece.border_edges;
      borders.push_back(*first);
    } else if (last - first > 2)
      ++piece.non_manifold_edges;
  }

  // Each border edge connects two fans. A boundary loop is a set of fans that border edges connect.
  Cancellation_scope::check();
  for (const Side& border : borders)
    fans.unite(border.corner_at_low, border.corner_at_high);
  std::vector<bool> counted(3 * triangles.size());
  for (const Side& border : borders) {
    const std::size_t loop = fans.find(border.corner_at_low);
    if (!counted[loop])
      ++piece_of(border.low).boundary_loops;
    counted[loop] = true;
  }
  return result;
}

Numbered_pieces internal::numbered_pieces(const Triangle_soup& soup)
{
  const auto are_at_one_position = [&](Index v, Index w) { return soup.points[v] == soup.points[w]; };
  return numbered_pieces(with_an_inside(soup.triangles, are_at_one_position), soup.points.size());
}

Numbered_pieces internal::numbered_pieces(const Triangle_soup& soup, const Index* positions)
{
  const auto are_at_one_position = [&](Index v, Index w) { return positions[v] == positions[w]; };
  return numbered_pieces(with_an_inside(soup.triangles, are_at_one_position), soup.points.size());
}

std::vector<Piece> pieces(const Triangle_soup& soup)
{
  check_geometry(soup, "the mesh");
  return numbered_pieces(soup).pieces;
}

std::vector<Topology_difference> topology_differences(const std::vector<Piece>& result,
                                                      const std::vector<Piece>& original)
{
  struct Counts
  {
    std::size_t original = 0, result = 0;
  };
  std::map<std::pair<std::size_t, long>, Counts> kinds;
  for (const Piece& piece : original)
    ++kinds[{piece.boundary_loops, piece.euler_characteristic}].original;
  for (const Piece& piece : result)
    ++kinds[{piece.boundary_loops, piece.euler_characteristic}].result;

  std::vector<Topology_difference> differences;
  for (const auto& [kind, counts] : kinds)
    if (counts.original != counts.result)
      differences.push_back({kind.first, kind.second, counts.original, counts.result});
  return differences;
}

} // namespace selvedge
