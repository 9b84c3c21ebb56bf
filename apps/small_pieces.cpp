// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "small_pieces.h"

#include "text.h"

#include <selvedge/Surface_mesh_simplification/internal/mesh_diagonal.h>
#include <selvedge/drop_parts.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace selvedge::app {
std::optional<Small_pieces> small_pieces(const Triangle_soup& soup)
{
  constexpr std::size_t least_count = 8;
  constexpr double least_step = 1.5, largest_share = 0.05, least_spread = 0.5;
  const std::vector<Sized_piece> pieces = sized_pieces(soup);
  CGAL::Bbox_3 whole, so_far;
  for (const Sized_piece& piece : pieces)
    whole += piece.box;
  std::size_t count = 0, triangles = 0, triangles_so_far = 0;
  double largest_step = least_step;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    triangles_so_far += pieces[i - 1].triangles;
    so_far += pieces[i - 1].box;
    const double size = pieces[i - 1].size;
    if (i < std::max(least_count, (pieces.size() + 1) / 2) || !(size > 0))
      continue;
    if (size > largest_share * pieces.back().size)
      break;
    if (const double step = pieces[i].size / size;
        step >= largest_step &&
        internal::diagonal_of(so_far) >= least_spread * internal::diagonal_of(whole)) {
      largest_step = step;
      count = i;
      triangles = triangles_so_far;
    }
  }
  if (count == 0)
    return std::nullopt;
  // Nearly as large as the largest of them, rounded up to three digits: less than the next.
  return Small_pieces{with_digits_up(1.01 * pieces[count - 1].size), count, triangles};
}

} // namespace selvedge::app
