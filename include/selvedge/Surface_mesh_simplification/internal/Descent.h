// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_DESCENT_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_DESCENT_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Remembers which faces offended at the start, from which of them every face descends, and which pairs
/// offend now. It tells the guard which pairs are *exempt*: they descend from two faces that offended
/// together (docs/guarantees.md, "Meshes that intersect already").
///
/// A collapse gives all faces that it changes, and does not remove, the ancestors of all faces that it
/// changes or removes. So these faces are exempt or not in the same way, and the questions about one collapse
/// concern one set of ancestors: that of `consider`.
///
/// **Complexity** Nothing is stored and nothing asked where no face has an ancestor. A set of ancestors is
/// stored once for all faces that have it.
class Descent
{
public:
  using Id = std::uint32_t;
  using Pair = std::pair<Id, Id>; ///< two faces, or one that is degenerate, twice

  /// Makes a face count several times: its pairs are as many. Call it after `begin`.
  void count_times(Id face, unsigned times)
  {
    m_times.resize(m_set_of_face.size(), 1);
    if (face < m_times.size())
      m_times[face] = times;
  }

  /// Returns how many pairs the pair of two faces stands for.
  std::size_t times(Id f, Id g) const { return m_times.empty() ? 1 : std::size_t(m_times[f]) * m_times[g]; }

  /// Names the pairs that offend at the start, of faces with numbers less than `faces`.
  void begin(const std::vector<Pair>& pairs, std::size_t faces)
  {
    if (pairs.empty())
      return;
    m_set_of_face.assign(faces, s_none);
    m_considered_at.assign(faces, 0);
    m_sets.resize(1);
    for (const auto& [f, g] : pairs) {
      add_ancestor(f);
      add_ancestor(g);
      add_pair({f, g});
      if (f == g)
        continue; // it exempts nothing: no face that changes is degenerate
      m_partners[ancestor(f)].push_back(ancestor(g));
      m_partners[ancestor(g)].push_back(ancestor(f));
    }
    m_marked_at.assign(m_partners.size(), 0);
  }

  /// Returns whether some face has ancestors, so that questions make sense.
  bool is_needed() const { return !m_partners.empty(); }

  /// Names the faces that a collapse would change or remove. The questions below are about this collapse,
  /// after it. Returns whether these faces have ancestors; if not, no pair with one of them is exempt, and
  /// none offends.
  bool consider(const std::vector<Id>& faces)
  {
    m_considered = faces;
    ++m_now;
    m_union.clear();
    for (const Id face : faces)
      m_considered_at[face] = m_now;
    for (const Id face : faces) {
      Set& set = m_sets[m_set_of_face[face]];
      if (set.ancestors.empty() || std::exchange(set.asked_at, m_now) == m_now)
        continue;
      m_buffer.clear();
      std::set_union(m_union.begin(), m_union.end(), set.ancestors.begin(), set.ancestors.end(),
                     std::back_inserter(m_buffer));
      m_union.swap(m_buffer);
    }
    for (const Id a : m_union)
      for (const Id b : m_partners[a])
        m_marked_at[b] = m_now;
    m_is_exempt_inside = is_any_marked(m_union);
    return !m_union.empty();
  }

  /// Returns whether pairs of two considered faces are exempt.
  bool is_exempt_inside() const { return m_is_exempt_inside; }

  /// Returns whether the pairs of a face with the considered ones are exempt.
  bool is_exempt(Id face)
  {
    if (m_considered_at[face] == m_now)
      return m_is_exempt_inside;
    Set& set = m_sets[m_set_of_face[face]];
    if (set.ancestors.empty())
      return false;
    if (std::exchange(set.compared_at, m_now) != m_now)
      set.is_exempt = is_any_marked(set.ancestors);
    return set.is_exempt;
  }

  /// Returns whether a face is degenerate.
  bool is_degenerate(Id face) const { return has_pair({face, face}); }

  /// Returns how many pairs of two faces, with a considered one, offend now.
  std::size_t pairs_now() const
  {
    std::size_t twice = 0;
    for (const Id face : m_considered)
      if (const auto found = m_pairs.find(face); found != m_pairs.end())
        for (const Id other : found->second)
          twice += (other == face ? 0 : m_considered_at[other] == m_now ? 1 : 2) * times(face, other);
    return twice / 2;
  }

  /// Returns whether all pairs of two faces, with a considered one, that offend now meet a condition.
  template <class Condition>
  bool are_all_pairs_now(const Condition& condition) const
  {
    return std::all_of(m_considered.begin(), m_considered.end(), [&](Id face) {
      const auto found = m_pairs.find(face);
      return found == m_pairs.end() || std::all_of(found->second.begin(), found->second.end(), [&](Id other) {
               return other == face || condition(face, other);
             });
    });
  }

  /// Called when the collapse has been done. `changed` are the considered faces that are left, `pairs` those
  /// with one of them that offend now.
  void on_collapsed(const std::vector<Id>& changed, const std::vector<Pair>& pairs)
  {
    for (const Id face : m_considered)
      remove_pairs(face);
    for (const Pair& pair : pairs)
      add_pair(pair);
    if (m_union.empty())
      return;
    for (const Id face : m_considered)
      leave_set(face);
    // A degenerate face that offended with no other leaves nothing behind.
    m_union.erase(std::remove_if(m_union.begin(), m_union.end(), [&](Id a) { return m_partners[a].empty(); }),
                  m_union.end());
    if (changed.empty() || m_union.empty())
      return;
    const Id set = m_free_sets.empty() ? Id(m_sets.size()) : m_free_sets.back();
    if (m_free_sets.empty())
      m_sets.emplace_back();
    else
      m_free_sets.pop_back();
    for (const Id face : changed)
      m_set_of_face[face] = set;
    m_sets[set].ancestors = m_union;
    m_sets[set].faces = changed.size();
  }

private:
  static constexpr Id s_none = 0; // the empty set

  struct Set
  {
    std::vector<Id> ancestors; // in ascending order
    std::size_t faces = 0;     // how many faces have this set
    std::uint64_t asked_at = 0, compared_at = 0;
    bool is_exempt = false; // if compared now
  };

  // The face is its own ancestor. Ancestors are numbered in the order in which pairs name them.
  void add_ancestor(Id face)
  {
    if (m_set_of_face[face] != s_none)
      return;
    m_set_of_face[face] = Id(m_sets.size());
    m_sets.emplace_back();
    m_sets.back().ancestors = {Id(m_partners.size())};
    m_sets.back().faces = 1;
    m_partners.emplace_back();
  }
  Id ancestor(Id face) const { return m_sets[m_set_of_face[face]].ancestors.front(); }

  bool is_any_marked(const std::vector<Id>& ancestors) const
  {
    return std::any_of(ancestors.begin(), ancestors.end(), [&](Id a) { return m_marked_at[a] == m_now; });
  }

  void leave_set(Id face)
  {
    const Id set = std::exchange(m_set_of_face[face], s_none);
    if (set == s_none || --m_sets[set].faces > 0)
      return;
    m_sets[set] = {};
    m_free_sets.push_back(set);
  }

  bool has_pair(const Pair& pair) const
  {
    const auto found = m_pairs.find(pair.first);
    return found != m_pairs.end() &&
           std::find(found->second.begin(), found->second.end(), pair.second) != found->second.end();
  }
  void add_pair(const Pair& pair)
  {
    m_pairs[pair.first].push_back(pair.second);
    if (pair.first != pair.second)
      m_pairs[pair.second].push_back(pair.first);
  }
  void remove_pairs(Id face)
  {
    const auto found = m_pairs.find(face);
    if (found == m_pairs.end())
      return;
    for (const Id other : found->second)
      if (other != face) {
        const auto at_other = m_pairs.find(other);
        std::vector<Id>& partners = at_other->second;
        partners.erase(std::find(partners.begin(), partners.end(), face));
        if (partners.empty())
          m_pairs.erase(at_other);
      }
    m_pairs.erase(found);
  }

  std::vector<std::vector<Id>> m_partners;         // by ancestor: those with which it offended
  std::vector<Id> m_set_of_face;                   // by face
  std::vector<unsigned> m_times;                   // by face, or empty
  std::vector<Set> m_sets;                         // the first is the empty one
  std::vector<Id> m_free_sets;                     // those that no face has any more
  std::unordered_map<Id, std::vector<Id>> m_pairs; // by face: those with which it offends now

  // About the collapse that is considered.
  std::vector<Id> m_considered, m_union, m_buffer;
  std::vector<std::uint64_t> m_considered_at, m_marked_at; // by face; by ancestor: a partner of the union
  std::uint64_t m_now = 0;
  bool m_is_exempt_inside = false;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_DESCENT_H
