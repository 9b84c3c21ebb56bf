// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_FATE_OF_LIMIT_H
#define SELVEDGE_APPS_FATE_OF_LIMIT_H

#include "text.h"

#include <selvedge/Error_search.h>
#include <selvedge/compare.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::app {

/// Says whether a limit of distances holds anywhere, and if not, which option keeps it there; empty where
/// there is nothing to say. `largest` bounds all distances; `search` is that of a limit that was to be kept
/// everywhere; `guarded` are the further poses in which collapses were judged.
inline std::string fate_of_limit(double limit, const Bounds_over_poses& largest,
                                 const std::optional<Error_search>& search,
                                 const std::vector<std::size_t>& guarded)
{
  const std::string holds = "limit: " + percent(limit) + " holds ";
  if (search && largest.upper <= limit)
    return holds + "at every point" +
           (search->reductions() == 1
                ? ""
                : "; found in " + std::to_string(search->reductions()) +
                      " reductions, the last with --error " + with_digits(search->max_error()));
  constexpr double rounding = 1e-12;
  const bool is_none_left = search && search->max_error() <= 0; // of smaller limits
  if (is_none_left && largest.lower <= limit + rounding)
    return "limit: whether " + percent(limit) +
           " holds at every point is not known: distances are measured to about a millionth of the size";
  if (limit <= 0 || largest.upper <= 1.01 * limit)
    return "";
  if (largest.pose && !std::binary_search(guarded.begin(), guarded.end(), *largest.pose))
    return holds + "in the mesh's own pose and in " +
           (guarded.empty() ? "no other" : with_commas(guarded.size()) + " others") +
           ", in which every collapse was judged; --key-poses all keeps it in all";
  return holds + "at vertices and at points between them; " +
         (is_none_left ? "elsewhere it does not, nor with a smaller --error"
          : search     ? "the search for one that keeps it at every point did not end"
                       : "--error-everywhere keeps it at every point");
}

} // namespace selvedge::app

#endif // SELVEDGE_APPS_FATE_OF_LIMIT_H
