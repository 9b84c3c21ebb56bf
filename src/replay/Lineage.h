// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REPLAY_LINEAGE_H
#define SELVEDGE_REPLAY_LINEAGE_H

#include <selvedge/Triangle_soup.h>

#include <algorithm>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace selvedge {
namespace reference {

/// From which offending faces of the start every face descends, where pairs may descend; otherwise from none.
class Lineage
{
public:
  using Faces = std::vector<Index>; // in ascending order

  void add_pair(Index f, Index g)
  {
    for (const auto& [first, second] : {std::make_pair(f, g), std::make_pair(g, f)}) {
      m_ancestors[first] = std::make_shared<Faces>(1, first);
      m_rivals[first].push_back(second);
    }
  }

  /// Returns the ancestors of all of some faces.
  Faces united(const std::vector<Index>& faces) const
  {
    Faces result;
    for (const Index f : faces)
      if (const auto found = m_ancestors.find(f); found != m_ancestors.end())
        result.insert(result.end(), found->second->begin(), found->second->end());
    return sorted(std::move(result));
  }

  /// Returns the faces that offended together with one of these at the start.
  Faces rivals(const Faces& ancestors) const
  {
    Faces result;
    for (const Index f : ancestors)
      result.insert(result.end(), m_rivals.at(f).begin(), m_rivals.at(f).end());
    return sorted(std::move(result));
  }

  void set(const std::vector<Index>& faces, const Faces& ancestors)
  {
    const auto shared = std::make_shared<Faces>(ancestors);
    for (const Index f : faces)
      m_ancestors[f] = shared;
  }
  void remove(Index f) { m_ancestors.erase(f); }

  bool descends_from_one(Index f, const Faces& of) const
  {
    const auto found = m_ancestors.find(f);
    return found != m_ancestors.end() && have_common(*found->second, of);
  }

  static bool have_common(const Faces& a, const Faces& b)
  {
    return std::any_of(a.begin(), a.end(),
                       [&](Index f) { return std::binary_search(b.begin(), b.end(), f); });
  }

private:
  static Faces sorted(Faces faces)
  {
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

  std::unordered_map<Index, std::shared_ptr<const Faces>> m_ancestors;
  std::unordered_map<Index, std::vector<Index>> m_rivals;
};

} // namespace reference
} // namespace selvedge

#endif // SELVEDGE_REPLAY_LINEAGE_H
