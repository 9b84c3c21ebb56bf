// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Pieces_in_file.h"

#include "one_to_one.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

// Finds pieces that a file numbers apart from those that they lie on, for `match_pieces`.

namespace selvedge::internal {
namespace {

Triangle_soup with_triangles(const Triangle_soup& soup, const std::vector<Index_triple>& triangles)
{
  Triangle_soup result;
  result.points = soup.points;
  result.triangles = triangles;
  result.groups = soup.groups;
  result.objects = soup.objects;
  result.materials = soup.materials;
  result.scene = soup.scene;
  return result;
}

std::vector<Index> without(const std::vector<Index>& all, const std::vector<Index>& some)
{
  std::vector<Index> others;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(others));
  return others;
}

// The positions of some triangles, each in ascending order, sorted.
std::vector<Index_triple> corners(const Piece_mesh& mesh, const std::vector<Index>& triangles)
{
  std::vector<Index_triple> result;
  for (const Index t : triangles) {
    result.push_back({mesh.position(t, 0), mesh.position(t, 1), mesh.position(t, 2)});
    std::sort(result.back().begin(), result.back().end());
  }
  std::sort(result.begin(), result.end());
  return result;
}

// The positions of the ends of edges that only one of some triangles has, sorted. Edges go by positions, or
// by vertex numbers, by which each piece has borders of its own.
std::vector<Index> border_positions(const Piece_mesh& mesh, const std::vector<Index>& triangles,
                                    bool is_by_position)
{
  using Edge = std::array<Index, 4>; // two numbers and their positions
  std::vector<Edge> edges;
  for (const Index t : triangles)
    for (int place = 0; place < 3; ++place) {
      const auto end = [&](int i) {
        const Index position = mesh.position(t, i % 3);
        return std::make_pair(is_by_position ? position : mesh.soup.triangles[t][i % 3], position);
      };
      const auto [low, high] = std::minmax({end(place), end(place + 1)});
      edges.push_back({low.first, high.first, low.second, high.second});
    }
  std::sort(edges.begin(), edges.end());
  std::vector<Index> positions;
  for (auto first = edges.begin(), last = first; first != edges.end(); first = last) {
    last = std::find_if(first, edges.end(), [&](const Edge& edge) { return edge != *first; });
    if (last - first == 1)
      positions.insert(positions.end(), {(*first)[2], (*first)[3]});
  }
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

} // namespace

Pieces_in_file::Pieces_in_file(const Piece_mesh& result, const std::vector<Index_triple>& triangles_in_file,
                               const Piece_mesh& original)
    : m_result(result), m_original(original), m_soup(with_triangles(result.soup, triangles_in_file)),
      m_mesh(m_soup, result.positions), m_names(m_mesh, original)
{
}

bool Pieces_in_file::have(const std::vector<Index>& hidden, const std::vector<Index>& of_original,
                          const std::vector<Index>& of_result, const Lists& original_at) const
{
  const std::vector<Index> triangles_now = m_result.triangles_of(of_result);
  std::vector<Index> in_file;
  for (const Index t : triangles_now)
    if (m_mesh.piece(t) != no_piece)
      in_file.push_back(m_mesh.piece(t));
  std::sort(in_file.begin(), in_file.end());
  in_file.erase(std::unique(in_file.begin(), in_file.end()), in_file.end());

  const auto is_hidden = [&](Index o) { return std::binary_search(hidden.begin(), hidden.end(), o); };
  std::vector<Possible_match> of_all, of_others; // by places in `in_file` and `of_original`
  for (Index i = 0; i < in_file.size(); ++i)
    for (const Index o : origins(in_file[i], of_original, original_at)) {
      const Index place =
          Index(std::lower_bound(of_original.begin(), of_original.end(), o) - of_original.begin());
      of_all.push_back({is_hidden(o) ? 1.0 : 0.0, 0, i, place});
      if (!is_hidden(o))
        of_others.push_back(of_all.back());
    }
  const auto matched = [&](std::vector<Possible_match> possible) {
    return one_to_one(std::move(possible), in_file.size(), of_original.size());
  };
  const std::vector<Pair> pairs = matched(std::move(of_all));
  if (pairs.size() != matched(std::move(of_others)).size() + hidden.size())
    return false;

  // A file cuts pieces at hard edges, too. Where a cut-off part of another piece was taken for one of these,
  // that piece lacks it now: it has a hole, a border where it had none, or one of its triangles is gone.
  std::vector<Index> taken;
  for (const auto& [i, place] : pairs)
    if (is_hidden(of_original[place]))
      taken.push_back(in_file[i]);
  std::sort(taken.begin(), taken.end());
  std::vector<Index> left;
  const std::vector<Index> others = m_original.triangles_of(without(of_original, hidden));
  const std::vector<Index_triple> corners_of_others = corners(m_original, others);
  for (const Index t : triangles_now)
    if (!std::binary_search(taken.begin(), taken.end(), m_mesh.piece(t)))
      left.push_back(t);
    else if (const std::vector<Index_triple> of_this = corners(m_result, {t});
             std::binary_search(corners_of_others.begin(), corners_of_others.end(), of_this.front()))
      return false;
  const std::vector<Index> borders_of_others = border_positions(m_original, others, false);
  for (const Index position : border_positions(m_result, left, true))
    if (original_at[position].size() > 0 &&
        !std::binary_search(borders_of_others.begin(), borders_of_others.end(), position))
      return false;
  return m_result.kinds_by_position(left) == m_original.kinds_by_position(others);
}

// The pieces of the original that a piece of the file may be.
std::vector<Index> Pieces_in_file::origins(Index piece, const std::vector<Index>& of_original,
                                           const Lists& original_at) const
{
  std::vector<Index> result = of_original, both;
  for (const Index t : m_mesh.triangles[piece])
    for (int place = 0; place < 3; ++place) {
      const Lists::Range here = original_at[m_mesh.position(t, place)];
      both.clear();
      if (here.size() <= most_at_a_position)
        std::set_intersection(result.begin(), result.end(), here.begin(), here.end(),
                              std::back_inserter(both));
      result.swap(both);
      if (result.empty())
        return result;
    }
  result.erase(std::remove_if(result.begin(), result.end(),
                              [&](Index o) {
                                return kind(m_mesh.pieces()[piece]) != kind(m_original.pieces()[o]) ||
                                       m_names.differing(piece, o) > 0;
                              }),
               result.end());
  return result;
}

} // namespace selvedge::internal
