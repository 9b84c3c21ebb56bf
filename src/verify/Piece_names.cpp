// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Piece_names.h"

#include "part_names.h"

#include <algorithm>
#include <iterator>

// Compares the names of pieces, for `match_pieces`.

namespace selvedge::internal {

Piece_names::Piece_names(const Piece_mesh& result, const Piece_mesh& original)
{
  std::vector<Pair> now, before; // a piece and a name; names of different kinds have different numbers
  Index beyond = 0;
  const auto list = [&](std::vector<Pair>& pairs, const Piece_mesh& mesh, const auto& name_of) {
    for (Index t = 0; t < mesh.soup.triangles.size(); ++t)
      if (const Pair pair(mesh.piece(t), beyond + name_of(t));
          mesh.piece(t) != no_piece && (pairs.empty() || pairs.back() != pair))
        pairs.push_back(pair);
  };
  const auto add = [&](const Triangle_labels& labels_now, const Triangle_labels& labels_before) {
    if (labels_now.empty() || labels_before.empty())
      return;
    const Common_names names(result.soup, labels_now, original.soup, labels_before);
    list(now, result, [&](Index t) { return names.now(t); });
    list(before, original, [&](Index t) { return names.before(t); });
    beyond += Index(names.size());
  };
  add(result.soup.groups, original.soup.groups);
  add(result.soup.objects, original.soup.objects);
  add(result.soup.materials, original.soup.materials);
  m_of_result = Lists(result.pieces().size(), now);
  m_of_original = Lists(original.pieces().size(), before);
}

std::size_t Piece_names::differing(Index of_result, Index of_original) const
{
  const Lists::Range now = m_of_result[of_result], before = m_of_original[of_original];
  std::vector<Index> different;
  std::set_symmetric_difference(now.begin(), now.end(), before.begin(), before.end(),
                                std::back_inserter(different));
  return different.size();
}

} // namespace selvedge::internal
