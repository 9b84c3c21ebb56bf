// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "regions.h"

#include "inner_edges.h"
#include "number_positions.h"
#include "selection.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

// Decides which attributes of triangles tell regions apart.

namespace selvedge {
namespace {

constexpr std::size_t s_edges_for_one_that_differs = 16;

// The faces of a soup: triangles with the same three positions are one.
struct Faces
{
  explicit Faces(const std::vector<Index_triple>& triangles) // of positions
  {
    std::vector<std::pair<Index_triple, Index>> sorted;
    sorted.reserve(triangles.size());
    for (Index t = 0; t < triangles.size(); ++t) {
      sorted.emplace_back(triangles[t], t);
      std::sort(sorted.back().first.begin(), sorted.back().first.end());
    }
    std::sort(sorted.begin(), sorted.end());
    for (const auto& [corners, t] : sorted) {
      if (positions.empty() || positions.back() != corners) {
        positions.push_back(corners);
        firsts.push_back(Index(members.size()));
      }
      members.push_back(t);
    }
    firsts.push_back(Index(members.size()));
  }

  bool is_of_one(Index face) const { return firsts[face + 1] - firsts[face] == 1; }

  std::vector<Index_triple> positions;
  std::vector<Index> firsts;  // by face, and one more: of its triangles in `members`
  std::vector<Index> members; // triangles
};

} // namespace

std::vector<const Attribute*> attributes_of_regions(const Triangle_soup& soup,
                                                    const std::vector<Index>& positions)
{
  std::vector<const Attribute*> result;
  if (soup.triangle_attributes.empty())
    return result;
  const Faces faces(in_positions(soup.triangles, positions));
  std::vector<std::pair<Index, Index>> neighbours;
  internal::for_each_inner_edge(faces.positions,
                                [&](const internal::Edge_side& a, const internal::Edge_side& b) {
                                  neighbours.emplace_back(a.at_low / 3, b.at_low / 3);
                                });
  for (const Attribute& attribute : soup.triangle_attributes) {
    const auto rows_of = [&](Index face) {
      std::vector<std::string_view> rows;
      for (Index i = faces.firsts[face]; i < faces.firsts[face + 1]; ++i)
        rows.push_back(row_of(attribute, faces.members[i]));
      std::sort(rows.begin(), rows.end());
      return rows;
    };
    const auto do_differ = [&](const std::pair<Index, Index>& pair) {
      const auto [f, g] = pair;
      if (faces.is_of_one(f) && faces.is_of_one(g)) // as nearly all are
        return row_of(attribute, faces.members[faces.firsts[f]]) !=
               row_of(attribute, faces.members[faces.firsts[g]]);
      return rows_of(f) != rows_of(g);
    };
    const auto differing = std::size_t(std::count_if(neighbours.begin(), neighbours.end(), do_differ));
    if (differing > 0 && s_edges_for_one_that_differs * differing <= neighbours.size())
      result.push_back(&attribute);
  }
  return result;
}

} // namespace selvedge
