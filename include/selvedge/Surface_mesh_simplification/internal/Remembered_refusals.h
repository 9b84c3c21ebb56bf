// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_REMEMBERED_REFUSALS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_REMEMBERED_REFUSALS_H

#include <cstddef>
#include <cstdint>
#include <optional>
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
/// It holds the questions of one reduction in their order, with the answers. Another reduction *follows* it
/// as long as it asks the same questions. From the first other question on, it records its own.
///
/// **Guarantees** Only refusals are taken from it. A collapse that was accepted is asked about again, so that
/// no result rests on this memory.
///
/// **Complexity** O(1) for each question and each blocker. Takes 8 bytes for each question and 4 for each
/// blocker.
class Remembered_refusals
{
public:
  using Number = std::uint32_t;

  struct Refusal
  {
    bool is_clearance_lacking = false; ///< whether nothing else was in the way
    std::vector<Number> blockers;      ///< the numbers of the faces in the way
  };

  /// Begins with the first question of a reduction.
  void begin()
  {
    m_place = 0;
    m_is_following = true;
  }

  /// Returns the answer to the question that comes next, if it was refused. If not, the exact test must be
  /// asked, and the answer given to `add_accepted` or `add_refused`.
  std::optional<Refusal> refusal(Number question)
  {
    m_is_following = m_is_following && m_place < m_words.size() && m_words[m_place] == question;
    if (!m_is_following || m_words[m_place + 1] == s_accepted)
      return {};
    const Number answer = m_words[m_place + 1];
    const auto first = m_words.begin() + std::ptrdiff_t(m_place) + 2;
    Refusal refusal{(answer & 1) != 0, {first, first + std::ptrdiff_t(answer / 2 - 1)}};
    m_place += 2 + refusal.blockers.size();
    return refusal;
  }

  void add_accepted(Number question) { add(question, s_accepted, {}); }
  void add_refused(Number question, const Refusal& refusal)
  {
    add(question, Number(2 * (refusal.blockers.size() + 1) + refusal.is_clearance_lacking), refusal.blockers);
  }

private:
  static constexpr Number s_accepted = 0;

  void add(Number question, Number answer, const std::vector<Number>& blockers)
  {
    if (m_is_following && answer == s_accepted) {
      m_place += 2;
      return;
    }
    m_is_following = false;
    m_words.resize(m_place);
    m_words.insert(m_words.end(), {question, answer});
    m_words.insert(m_words.end(), blockers.begin(), blockers.end());
    m_place = m_words.size();
  }

  // For each question its number, the answer, and the blockers. The answer to what was refused is twice the
  // number of blockers and one, and one more if only clearance was lacking.
  std::vector<Number> m_words;
  std::size_t m_place = 0; // of the next question
  bool m_is_following = false;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_REMEMBERED_REFUSALS_H
