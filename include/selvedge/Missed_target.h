// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MISSED_TARGET_H
#define SELVEDGE_MISSED_TARGET_H

#include <selvedge/Surface_mesh_simplification/internal/Collapse_record.h>
#include <selvedge/compare.h>
#include <selvedge/simplify.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace selvedge {

/// Reduces again, to more faces, where a target was missed and the surface was flattened for it.
///
/// A reduction that cannot reach its target ends where rules hold every edge that is left. By then, all that
/// nothing holds is flattened as far as `Simplify_options::max_error` allows, for few faces: of six garments
/// and figures that got stuck above 10 %, the RMS distance at a tenth more faces was 0.44, 0.60, 0.66, 0.75,
/// 0.75 and 0.90 of that at the end. Where a reduction is not stuck, it is about 0.9.
///
/// What holds the others is often the course of borders, as in strips of hair, whose outlines keep every
/// corner while the head below loses its shape. So in the second reduction borders turn by any angle: the
/// cost, which counts what a border loses as it counts what a surface does, says where faces go. Seams turn
/// no more, because there the texture would show what lies beside its charts; nor do borders where gaps are
/// held (`Prepared_soup::tied`, `facing`), because there they would leave each other.
///
/// Where the second reduction only ends before the first one did, it repeats the collapses of that, which
/// takes a small part of the time.
///
/// A caller reduces with the options of `options()`, judges, hands the results to `advance`, and reduces
/// again if this returns true. Then `complete` makes the second results those of the targets that were asked
/// for. There is one result, or one for each level of detail. Parts with a ratio of their own have a target
/// each (`Simplify_report::shares`).
class Missed_target
{
public:
  /// A result, its distances at the vertices of the original, and the original. A result that spans what was
  /// open, as between thin rods, is far from the original between its own vertices alone.
  struct Judged
  {
    const Simplified_soup& result;
    const Distance& original_to_result;
    const Prepared_soup& original;
  };

  /// `asked` are the options that the caller wants. Their limit of the turn of borders stays if it is set, as
  /// is any that is not the default.
  explicit Missed_target(Simplify_options asked, bool is_border_turn_set = false)
      : m_options(std::move(asked)),
        m_is_border_turn_set(is_border_turn_set ||
                             m_options.max_border_turn != Simplify_options().max_border_turn)
  {
    if (m_options.ratio || m_options.faces)
      m_options.record = std::make_shared<internal::Collapse_record>();
  }

  /// Returns whether a result has used a quarter of the error that is allowed, if there is a limit above 0.
  static bool is_flattened(const Simplify_options& options, const Distance& original_to_result)
  {
    const double error = options.max_error.value_or(0);
    return error > 0 && original_to_result.maximum >= s_much * error;
  }

  /// The options to reduce with.
  const Simplify_options& options() const { return m_options; }

  /// Called after a reduction. Returns whether another one is due: when this was the first, nothing has
  /// stopped it, and a result ended above a target that is not 0, has used a quarter of the error that is
  /// allowed, at the vertices of the original or anywhere on its own faces, and a tenth of its faces is at
  /// most half of what went. Faces that cannot change do not count.
  ///
  /// In the next one, no level has more faces than one that has reached its target now. Borders turn by any
  /// angle where limits of borders and seams hold a fiftieth of the edges or more, unless their turn is set,
  /// gaps are held, or some level or part that can change is not to have more faces: it would be reduced
  /// further.
  bool advance(const std::vector<Judged>& levels)
  {
    const auto is_stopped = [](const Judged& level) { return level.result.report.is_stopped; };
    if (!m_first.empty() || std::any_of(levels.begin(), levels.end(), is_stopped))
      return is_not_due();
    std::vector<std::size_t> least;
    bool may_borders_turn = !m_is_border_turn_set;
    for (const Judged& level : levels) {
      const bool is_due = is_flattened(level);
      if (is_due)
        lower_to_missed(level.result.report.shares, least);
      may_borders_turn &= is_due && is_held_by_lines(level.result.report) && !has_gaps_held(level.original);
    }
    for (const Judged& level : levels)
      lower_to_reached(level.result.report.shares, least);
    std::replace(least.begin(), least.end(), s_none, std::size_t(0));
    if (std::all_of(least.begin(), least.end(), [](std::size_t faces) { return faces == 0; }))
      return is_not_due();
    m_options.least_faces = std::move(least);
    if (may_borders_turn)
      m_options.max_border_turn = s_any_angle;
    m_is_border_turn_eased = may_borders_turn;
    if (std::all_of(levels.begin(), levels.end(),
                    [this](const Judged& level) { return can_be_repeated(level); }))
      m_options.repeated = m_options.record;
    m_options.record.reset();
    for (const Judged& level : levels)
      m_first.emplace_back(level.result);
    return true;
  }

  /// Has the report of each second result name the targets that were asked for, how far they are within
  /// reach, and what holds the result back there. Triangles that could go are held by `Hindrance::target`.
  /// Does nothing to first results.
  void complete(std::vector<Simplified_soup>& levels) const
  {
    for (std::size_t i = 0; i < m_first.size(); ++i) {
      m_first[i].complete(levels[i]);
      if (m_options.repeated)
        m_first[i].complete_repeated(levels[i]);
      if (m_is_border_turn_eased)
        levels[i].report.eased_border_turn = m_options.max_border_turn;
    }
  }

private:
  using Shares = std::vector<Simplify_report::Share>;

  static constexpr double s_much = 0.25; // of the error allowed
  static constexpr double s_any_angle = 180;
  static constexpr std::size_t s_none = std::numeric_limits<std::size_t>::max();

  bool is_flattened(const Judged& level) const
  {
    if (is_flattened(m_options, level.original_to_result))
      return true;
    const double error = m_options.max_error.value_or(0);
    const Shares& shares = level.result.report.shares;
    if (error == 0 || std::none_of(shares.begin(), shares.end(), is_missed)) // looking farther takes time
      return false;
    return is_farther(level.result.soup, level.original.soup, s_much * error);
  }

  // Whether the next reduction begins as this one did, and ends before it. (Poses that this one did not guard
  // may turn out to be pierced before its end.)
  bool can_be_repeated(const Judged& level) const
  {
    return !m_is_border_turn_eased && m_options.faces_per_cell == 0 &&
           level.result.report.shares.size() == 1 && level.original.soup.poses.empty();
  }

  bool is_not_due()
  {
    m_options.record.reset(); // which takes memory
    m_options.repeated.reset();
    return false;
  }

  // Whether limits of lines hold a fiftieth of the edges or more, and all parts that can change are to have
  // more faces.
  static bool is_held_by_lines(const Simplify_report& report)
  {
    const Hindrances& held = report.hindrances;
    const std::size_t by_lines = held[Hindrance::border_turn] + held[Hindrance::drift];
    if (by_lines == 0 || 50 * by_lines < held.total() - held[Hindrance::target])
      return false;
    return std::all_of(report.shares.begin(), report.shares.end(), [](const Simplify_report::Share& share) {
      return share.input == share.fixed || is_missed(share);
    });
  }

  static bool has_gaps_held(const Prepared_soup& original)
  {
    return !original.tied.empty() || !original.facing.empty();
  }

  static std::size_t a_tenth(std::size_t faces) { return (faces + 9) / 10; }

  static bool is_missed(const Simplify_report::Share& share)
  {
    const bool is_asked_for = share.target > 0 && share.target != share.fixed; // which a ratio of 0 gives
    if (!is_asked_for || share.output <= (std::max)(share.target, share.fixed))
      return false;
    return a_tenth(share.output - share.fixed) <= (share.input - share.output) / 2;
  }

  static void lower_to_missed(const Shares& shares, std::vector<std::size_t>& least)
  {
    least.resize(shares.size(), s_none);
    for (std::size_t i = 0; i < shares.size(); ++i)
      if (is_missed(shares[i]))
        least[i] = std::min(least[i], shares[i].output + a_tenth(shares[i].output - shares[i].fixed));
  }

  static void lower_to_reached(const Shares& shares, std::vector<std::size_t>& least)
  {
    for (std::size_t i = 0; i < least.size(); ++i)
      if (least[i] != s_none && shares[i].excess() == 0)
        least[i] = std::min(least[i], shares[i].output);
  }

  // What the first reduction said of a level: its report, and what held each of its triangles.
  class First
  {
  public:
    explicit First(const Simplified_soup& result)
        : m_report(result.report), m_history(result.history), m_refused_by_part(result.refused_by_part)
    {
      for (std::size_t t = 0; t < result.held_by.size(); ++t)
        m_held_by.emplace(result.triangles[t], result.held_by[t]);
    }

    void complete(Simplified_soup& result) const
    {
      Simplify_report& report = result.report;
      report.faces_target = m_report.faces_target;
      report.faces_to_go = 0;
      for (std::size_t i = 0; i < report.shares.size(); ++i) {
        Simplify_report::Share& share = report.shares[i];
        const Simplify_report::Share& first = m_report.shares[i];
        share.target = first.target;
        report.faces_to_go += share.excess();
        if (first.excess() > 0 && share.output > first.output) {
          share.within_reach = first.output;
          report.faces_within_reach = m_report.faces_output;
        }
      }
      if (m_report.is_reached())
        return;
      report.hindrances = m_report.hindrances;
      result.held_by.clear();
      for (const Index triangle : result.triangles) {
        const auto held = m_held_by.find(triangle);
        result.held_by.push_back(held == m_held_by.end() ? Hindrance::target : held->second);
      }
    }

    // What was asked for in the first reduction, of which the second has repeated the collapses.
    void complete_repeated(Simplified_soup& result) const
    {
      Simplify_report& report = result.report;
      report.passes = m_report.passes;
      report.refused = m_report.refused;
      report.refused_elsewhere = m_report.refused_elsewhere;
      report.intersections = m_report.intersections;
      report.index = m_report.index;
      result.refused_by_part = m_refused_by_part;
      result.history = m_history.until(report.collapses);
    }

  private:
    Simplify_report m_report;
    Reduction_history m_history;
    std::vector<std::vector<Refusals>> m_refused_by_part;
    std::unordered_map<Index, Hindrance> m_held_by;
  };

  Simplify_options m_options;
  bool m_is_border_turn_set, m_is_border_turn_eased = false;
  std::vector<First> m_first; // of all levels, once they are to be reduced again
};

} // namespace selvedge

#endif // SELVEDGE_MISSED_TARGET_H
