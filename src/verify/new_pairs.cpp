// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Cancellation_scope.h>
#include <selvedge/verify.h>

#include <algorithm>
#include <tuple>
#include <utility>

// Finds the offending pairs of a result that its original does not have; `verify` accepts no result with one.

namespace selvedge {
namespace {

using Triangle_positions = std::array<std::array<double, 3>, 3>;

Triangle_positions sorted_positions(const Triangle_soup& soup, Index triangle)
{
  Triangle_positions positions;
  for (int i = 0; i < 3; ++i) {
    const Point_3& point = soup.points[soup.triangles[triangle][i]];
    positions[i] = {point.x(), point.y(), point.z()};
  }
  std::sort(positions.begin(), positions.end());
  return positions;
}

/// An offending pair, ordered by its offence and positions, with its place in its list.
struct Known_pair
{
  Triangle_positions first, second;
  Offence offence;
  std::size_t number;

  bool operator<(const Known_pair& other) const
  {
    return std::tie(offence, first, second) < std::tie(other.offence, other.first, other.second);
  }
};

std::vector<Known_pair> known(const Triangle_soup& soup, const std::vector<Offending_pair>& pairs)
{
  std::vector<Known_pair> result;
  result.reserve(pairs.size());
  for (const Offending_pair& pair : pairs) {
    auto first = sorted_positions(soup, pair.first), second = sorted_positions(soup, pair.second);
    if (second < first)
      std::swap(first, second);
    result.push_back({first, second, pair.offence, result.size()});
  }
  std::stable_sort(result.begin(), result.end());
  return result;
}

} // namespace

std::vector<Offending_pair> new_pairs(const Triangle_soup& result,
                                      const std::vector<Offending_pair>& pairs_of_result,
                                      const Triangle_soup& original,
                                      const std::vector<Offending_pair>& pairs_of_original)
{
  std::vector<std::size_t> numbers;
  const std::vector<Known_pair> before = known(original, pairs_of_original);
  auto old = before.begin();
  Cancellation_poll poll;
  for (const Known_pair& pair : known(result, pairs_of_result)) {
    poll();
    while (old != before.end() && *old < pair)
      ++old;
    if (old != before.end() && !(pair < *old))
      ++old;
    else
      numbers.push_back(pair.number);
  }
  std::sort(numbers.begin(), numbers.end());

  std::vector<Offending_pair> pairs;
  for (const std::size_t number : numbers)
    pairs.push_back(pairs_of_result[number]);
  return pairs;
}

} // namespace selvedge
