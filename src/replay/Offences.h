// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REPLAY_OFFENCES_H
#define SELVEDGE_REPLAY_OFFENCES_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace selvedge {
namespace reference {

/// The pairs of faces that offend at present, and as pairs of f and f the faces without an area.
class Offences
{
public:
  void add(Index f, Index g)
  {
    if (m_partners[f].insert(g).second && f != g)
      m_count += times(f) * times(g);
    m_partners[g].insert(f);
  }
  /// Lets every face count as often as `times` says. Call it before the first pair is added.
  void count_times(std::vector<Index> times) { m_times = std::move(times); }
  /// Returns the number of pairs of two faces.
  std::size_t count() const { return m_count; }
  bool has(Index f, Index g) const
  {
    const auto found = m_partners.find(f);
    return found != m_partners.end() && found->second.count(g) > 0;
  }
  bool has(Index f) const { return m_partners.count(f) > 0; }
  void remove(Index f)
  {
    const auto found = m_partners.find(f);
    if (found == m_partners.end())
      return;
    for (const Index g : found->second)
      if (g != f) {
        m_count -= times(f) * times(g);
        const auto other = m_partners.find(g);
        other->second.erase(f);
        if (other->second.empty())
          m_partners.erase(other);
      }
    m_partners.erase(found);
  }

private:
  std::size_t times(Index f) const { return m_times.empty() ? 1 : m_times[f]; }

  std::vector<Index> m_times; // by face, or empty
  std::unordered_map<Index, std::set<Index>> m_partners;
  std::size_t m_count = 0;
};

} // namespace reference
} // namespace selvedge

#endif // SELVEDGE_REPLAY_OFFENCES_H
