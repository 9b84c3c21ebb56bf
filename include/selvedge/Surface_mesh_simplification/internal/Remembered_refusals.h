// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_REMEMBERED_REFUSALS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_REMEMBERED_REFUSALS_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Remembers what the exact test refused in a reduction, so that another one that begins like it need not ask
/// again.
///
/// It exists because a reduction that misses its target is done again to more faces (`Missed_target`). Its
/// collapses are then the first ones of the reduction before, and most of the time of that has gone into
/// motions that were refused.
///
/// It holds the questions of one reduction, with the answers, and its collapses, in their order. Another
/// reduction *follows* it as long as it asks the same questions and does the same collapses, so that its mesh
/// is the same. From the first difference on, it records its own.
///
/// **Guarantees** Only refusals are taken from it. A collapse that was accepted is asked about again, so that
/// nothing is done because of this memory.
///
/// **Complexity** O(1) for each question, blocker and collapse. Takes 8 bytes for each question and each
/// collapse, except that a question whose collapse is done next takes none, and 4 for each blocker.
class Remembered_refusals
{
public:
  using Number = std::uint32_t;

  struct Refusal
  {
    bool is_clearance_lacking = false; ///< whether nothing else was in the way
    std::vector<Number> blockers;      ///< the numbers of the faces in the way
  };

  /// Begins a reduction of a mesh of so many faces. It follows none of a mesh of another number.
  void begin(std::size_t faces)
  {
    if (faces != m_faces)
      m_words.clear();
    m_faces = faces;
    m_place = 0;
    m_is_following = true;
    m_accepted.reset();
  }

  /// Returns the answer to the question that comes next, if it was refused. If not, the exact test must be
  /// asked, and the answer given to `add_accepted` or `add_refused`. A question has the number of a collapse.
  std::optional<Refusal> refusal(Number question)
  {
    add_last_accepted();
    m_is_following = is_next(question);
    if (!m_is_following || m_words[m_place + 1] <= s_done)
      return {};
    const Number answer = m_words[m_place + 1];
    const auto first = m_words.begin() + std::ptrdiff_t(m_place) + 2;
    Refusal refusal{(answer & 1) != 0, {first, first + std::ptrdiff_t(answer / 2 - 1)}};
    m_place += 2 + refusal.blockers.size();
    return refusal;
  }

  void add_accepted(Number question) { m_accepted = question; }
  void add_refused(Number question, const Refusal& refusal)
  {
    add(question, Number(2 * (refusal.blockers.size() + 1) + refusal.is_clearance_lacking), refusal.blockers);
  }

  /// Called before each collapse that is done.
  void add_done(Number collapse)
  {
    if (m_accepted == collapse)
      m_accepted.reset();
    else
      add_last_accepted();
    add(collapse, s_done, {});
  }

private:
  static constexpr Number s_accepted = 0, s_done = 1;

  bool is_next(Number number) const
  {
    return m_is_following && m_place < m_words.size() && m_words[m_place] == number;
  }

  // Called when something else has come after an accepted question than its collapse.
  void add_last_accepted()
  {
    if (const std::optional<Number> question = std::exchange(m_accepted, std::nullopt))
      add(*question, s_accepted, {});
  }

  void add(Number number, Number kind, const std::vector<Number>& blockers)
  {
    m_is_following = kind <= s_done && is_next(number) && m_words[m_place + 1] == kind;
    if (m_is_following) {
      m_place += 2;
      return;
    }
    m_words.resize(m_place);
    m_words.insert(m_words.end(), {number, kind});
    m_words.insert(m_words.end(), blockers.begin(), blockers.end());
    m_place = m_words.size();
  }

  // For each question and each collapse its number, and what it is: accepted, done, or refused, which is
  // 2 (blockers + 1), and 1 more if only clearance was lacking. The blockers come after it. Accepted
  // questions are left out where their collapse comes next.
  std::deque<Number> m_words; // in pieces, since a copy of all would be made to enlarge it
  std::size_t m_faces = 0;
  std::size_t m_place = 0; // of what comes next
  bool m_is_following = false;
  std::optional<Number> m_accepted; // the last question, until it is known what comes after it
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_REMEMBERED_REFUSALS_H
