// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_MATCHED_PIECES_H
#define SELVEDGE_TEST_SUPPORT_MATCHED_PIECES_H

#include "soups.h"

#include <selvedge/verify.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

// Layers whose pieces `match_pieces` matches, and what it finds in a word.

namespace selvedge::test {

inline Triangle_soup stretched(const Triangle_soup& soup, double factor)
{
  return mapped(soup,
                [&](const Point_3& p) { return Point_3(factor * p.x(), factor * p.y(), factor * p.z()); });
}

/// A square of side 8 at height z, as a sheet of `squares` × `squares`.
inline Triangle_soup layer(Index squares, double z)
{
  return moved(stretched(sheet(squares, squares), 8.0 / squares), 0, 0, z);
}

/// Three layers and a box beside them, in fine and in coarse: as a reduction would leave them.
inline Triangle_soup layers(Index squares)
{
  const Triangle_soup box = moved(tetrahedron(), 20, 0, 0);
  return joined(joined(joined(layer(squares, 0), layer(squares, 1)), layer(squares, 2)), box);
}

inline Triangle_soup fine()
{
  return layers(8);
}
inline Triangle_soup coarse()
{
  return layers(4);
}

/// Takes away the triangles of one piece, by its number.
inline Triangle_soup without_piece(Triangle_soup soup, Index number)
{
  const std::vector<Piece> all = pieces(soup);
  const auto begin = soup.triangles.begin() + all[number].first_triangle;
  soup.triangles.erase(begin, begin + std::ptrdiff_t(all[number].faces));
  return soup;
}

/// Gives each piece, in which all triangles follow each other, a group of this name.
inline Triangle_soup named(Triangle_soup soup, const std::vector<std::string>& names)
{
  soup.groups.names = names;
  soup.groups.of_triangle.clear();
  const std::vector<Piece> all = pieces(soup);
  for (Index i = 0; i < all.size(); ++i)
    soup.groups.of_triangle.insert(soup.groups.of_triangle.end(), all[i].faces, i);
  return soup;
}

inline std::vector<Mismatch> mismatches(const Piece_matching& matching)
{
  std::vector<Mismatch> result;
  for (const Piece_mismatch& mismatch : matching.mismatches)
    result.push_back(mismatch.what);
  std::sort(result.begin(), result.end());
  return result;
}

inline std::vector<Mismatch> mismatches(const Triangle_soup& result, const Triangle_soup& original)
{
  return mismatches(match_pieces(result, original));
}

using Mismatches = std::vector<Mismatch>;

/// How all pieces were matched, if all were, and in the same way.
inline std::optional<Matched_by> way(const Piece_matching& matching)
{
  if (!matching.is_complete() || matching.matches.empty())
    return std::nullopt;
  for (const Piece_match& match : matching.matches)
    if (match.by != matching.matches.front().by)
      return std::nullopt;
  return matching.matches.front().by;
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_MATCHED_PIECES_H
