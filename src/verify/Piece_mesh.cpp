// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Piece_mesh.h"

#include "part_names.h"

#include <selvedge/Cancellation_scope.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cstdio>

// Prepares a result, or its original, for `match_pieces`, and describes its pieces in messages of the judge.

namespace selvedge::internal {

Piece_mesh::Piece_mesh(const Triangle_soup& mesh, const Index* positions_of_vertices)
    : soup(mesh), positions(positions_of_vertices), numbered(numbered_pieces(soup, positions_of_vertices))
{
  std::vector<Pair> pairs;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    if (piece(t) != no_piece)
      pairs.emplace_back(piece(t), t);
  triangles = Lists(numbered.pieces.size(), pairs);
}

Lists Piece_mesh::pieces_at(std::size_t positions_in_all, const Index* other_positions) const
{
  std::vector<Pair> pairs;
  std::vector<bool> is_done(soup.points.size());
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (int place = 0; piece(t) != no_piece && place < 3; ++place) {
      const Index vertex = soup.triangles[t][place];
      if (!is_done[vertex])
        pairs.emplace_back(other_positions[vertex], piece(t));
      is_done[vertex] = true;
    }
  return Lists(positions_in_all, pairs);
}

std::vector<Index> Piece_mesh::triangles_of(const std::vector<Index>& some_pieces) const
{
  std::vector<Index> result;
  for (const Index piece : some_pieces)
    result.insert(result.end(), triangles[piece].begin(), triangles[piece].end());
  return result;
}

std::vector<Kind> Piece_mesh::kinds_by_position(const std::vector<Index>& some_triangles,
                                                const Index* other_positions) const
{
  std::vector<Index_triple> by_position;
  std::vector<Index> numbers;
  for (const Index t : some_triangles) {
    const auto& [a, b, c] = soup.triangles[t];
    by_position.push_back({other_positions[a], other_positions[b], other_positions[c]});
  }
  for (const Index_triple& triple : by_position)
    numbers.insert(numbers.end(), triple.begin(), triple.end());
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  Cancellation_scope::check();
  for (Index_triple& triple : by_position)
    for (Index& number : triple)
      number = Index(std::lower_bound(numbers.begin(), numbers.end(), number) - numbers.begin());
  std::vector<Kind> kinds;
  for (const Piece& piece : numbered_pieces(by_position, numbers.size()).pieces)
    kinds.push_back(kind(piece));
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

std::string counted(std::size_t count, const char* noun)
{
  return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

std::string describe(const Kind& kind)
{
  const auto [loops, euler_characteristic, is_non_manifold] = kind;
  return counted(loops, "boundary loop") + (is_non_manifold ? ", edges of more than two faces" : "") +
         " and Euler characteristic " + std::to_string(euler_characteristic);
}

std::string describe(const Piece_mesh& mesh, Index piece)
{
  const Lists::Range triangles = mesh.triangles[piece];
  CGAL::Bbox_3 box;
  for (const Index t : triangles)
    for (const Index vertex : mesh.soup.triangles[t])
      box += mesh.soup.points[vertex].bbox();
  char place[96];
  std::snprintf(place, sizeof place, "(%.4g, %.4g, %.4g)", box.xmin() / 2 + box.xmax() / 2,
                box.ymin() / 2 + box.ymax() / 2, box.zmin() / 2 + box.zmax() / 2);
  const std::string name = Part_names(mesh.soup).of(*triangles.begin());
  return "piece " + std::to_string(piece + 1) + " (" + (name.empty() ? "" : "'" + name + "', ") +
         counted(triangles.size(), "face") + " around " + place + ")";
}

std::string describe(const Piece_mesh& mesh, const std::vector<Index>& pieces)
{
  constexpr std::size_t most = 3;
  std::string text = describe(mesh, pieces.front());
  for (std::size_t i = 1; i < std::min(pieces.size(), most); ++i)
    text += ", " + describe(mesh, pieces[i]);
  if (pieces.size() > most)
    text += " and " + std::to_string(pieces.size() - most) + " more";
  return text;
}

} // namespace selvedge::internal
