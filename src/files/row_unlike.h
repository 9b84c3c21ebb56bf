// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_ROW_UNLIKE_H
#define SELVEDGE_SRC_FILES_ROW_UNLIKE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace selvedge::files {

/// Returns a row of numbers that is none of these: the first of (0, 0, …), (−1, 0, …), (−2, 0, …) that is
/// free. Readers use it as the value of corners that have none. Linear in the number of rows.
template <std::size_t dimension>
std::array<double, dimension> row_unlike(const std::vector<std::array<double, dimension>>& rows)
{
  std::vector<char> is_taken(rows.size() + 1, false);
  for (const std::array<double, dimension>& row : rows) {
    const double place = -row[0];
    if (place >= 0 && place < double(is_taken.size()) && place == std::floor(place) &&
        std::all_of(row.begin() + 1, row.end(), [](double number) { return number == 0; }))
      is_taken[std::size_t(place)] = true;
  }
  std::array<double, dimension> result = {};
  result[0] = -double(std::find(is_taken.begin(), is_taken.end(), false) - is_taken.begin());
  return result;
}

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_ROW_UNLIKE_H
