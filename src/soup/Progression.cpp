// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Progression.h>

#include <algorithm>
#include <numeric>

namespace selvedge {

std::vector<Wedge_triangle> triangles_after(const Progression& progression, std::size_t steps)
{
  const std::size_t moves = steps == 0 ? 0 : progression.steps[steps - 1];
  Index count = 0;
  for (const Index_triple& wedges : progression.wedges)
    count = std::max({count, wedges[0] + 1, wedges[1] + 1, wedges[2] + 1});
  std::vector<Index> now(count); // where each wedge is
  std::iota(now.begin(), now.end(), Index(0));
  // From the last move to the first, so that where a wedge goes is known to be final.
  for (std::size_t i = moves; i-- > 0;)
    now[progression.moves[i].from] = now[progression.moves[i].to];
  std::vector<Wedge_triangle> result;
  for (Index t = 0; t < progression.wedges.size(); ++t) {
    const auto& [a, b, c] = progression.wedges[t];
    const Index_triple moved = {now[a], now[b], now[c]};
    if (moved[0] != moved[1] && moved[1] != moved[2] && moved[2] != moved[0])
      result.push_back({t, moved});
  }
  return result;
}

} // namespace selvedge
