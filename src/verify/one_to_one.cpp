// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "one_to_one.h"

#include "pieces.h"

#include <algorithm>

namespace selvedge::internal {
namespace {

/// Assigns pieces of the result to pieces of the original: greedily at first, then by augmenting paths.
class Assignment
{
public:
  Assignment(std::vector<Possible_match> possible, std::size_t results, std::size_t originals)
      : m_of_result(results, no_piece), m_of_original(originals, no_piece), m_tried(originals)
  {
    std::sort(possible.begin(), possible.end());
    std::vector<Pair> pairs;
    for (const Possible_match& match : possible) {
      pairs.emplace_back(match.of_result, match.of_original);
      if (m_of_result[match.of_result] == no_piece && m_of_original[match.of_original] == no_piece)
        assign(match.of_result, match.of_original);
    }
    m_originals_of = Lists(results, pairs);
    for (Index r = 0; r < results; ++r)
      if (m_of_result[r] == no_piece && m_originals_of[r].size() > 0) {
        ++m_search;
        m_budget = 1000;
        augment(r);
      }
  }

  std::vector<Pair> pairs() const
  {
    std::vector<Pair> result;
    for (Index r = 0; r < m_of_result.size(); ++r)
      if (m_of_result[r] != no_piece)
        result.emplace_back(r, m_of_result[r]);
    return result;
  }

private:
  void assign(Index r, Index o)
  {
    m_of_result[r] = o;
    m_of_original[o] = r;
  }

  // Finds a partner for a piece of the result. When the partner has one, that one looks for another first.
  bool augment(Index r)
  {
    for (const Index o : m_originals_of[r]) {
      if (m_budget == 0)
        return false;
      if (m_tried[o] == m_search)
        continue;
      m_tried[o] = m_search;
      --m_budget;
      if (m_of_original[o] == no_piece || augment(m_of_original[o])) {
        assign(r, o);
        return true;
      }
    }
    return false;
  }

  std::vector<Index> m_of_result, m_of_original;
  std::vector<Index> m_tried; // by number of the search
  Index m_search = 0;
  std::size_t m_budget = 0;
  Lists m_originals_of;
};

} // namespace

std::vector<Pair> one_to_one(std::vector<Possible_match> possible, std::size_t pieces_of_result,
                             std::size_t pieces_of_original)
{
  return Assignment(std::move(possible), pieces_of_result, pieces_of_original).pairs();
}

} // namespace selvedge::internal
