// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MISSED_TARGET_H
#define SELVEDGE_MISSED_TARGET_H

#include <selvedge/compare.h>
#include <selvedge/simplify.h>

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>

namespace selvedge {

/// Reduces again, to more faces, where a target was missed and the surface was flattened for it.
///
/// A reduction that cannot reach its target ends where rules hold every edge that is left. By then, all that
/// nothing holds is flattened as far as `Simplify_options::max_error` allows, for few faces: of six garments
/// and figures that got stuck above 10 %, the RMS distance at a tenth more faces was 0.44, 0.60, 0.66, 0.75,
/// 0.75 and 0.90 of that at the end. Where a reduction is not stuck, it is about 0.9.
///
/// A caller reduces with the options of `options()`, judges, hands result and distances to `advance`, and
/// reduces again if this returns true. Then `complete` makes the second result one of the target that was
/// asked for.
class Missed_target
{
public:
  /// `asked` are the options that the caller wants.
  explicit Missed_target(Simplify_options asked) : m_options(std::move(asked)) {}

  /// Returns whether a result has used a quarter of the error that is allowed, if there is a limit above 0.
  static bool is_flattened(const Simplify_options& options, const Distance& original_to_result)
  {
    const double error = options.max_error.value_or(0);
    return error > 0 && original_to_result.maximum >= s_much * error;
  }

  /// The options to reduce with.
  const Simplify_options& options() const { return m_options; }

  /// Called after a reduction of all faces to one target, with the distances at the original's vertices.
  /// Returns whether another one is due: when this was the first, ended by itself at more than a tenth above
  /// its target, which is not 0, and has used a quarter of the error that is allowed.
  bool advance(const Simplified_soup& result, const Distance& original_to_result)
  {
    const Simplify_report& report = result.report;
    if (m_first || report.is_reached() || report.is_stopped || report.faces_target == 0 ||
        report.faces_output <= with_a_tenth(report.faces_target) ||
        !is_flattened(m_options, original_to_result))
      return false;
    m_first.emplace(First{report, {}});
    for (std::size_t t = 0; t < result.held_by.size(); ++t)
      m_first->held_by.emplace(result.triangles[t], result.held_by[t]);
    m_options.faces = with_a_tenth(report.faces_output);
    return true;
  }

  /// Has the report of the second result name the target that was asked for, how far it is within reach, and
  /// what holds it back there. Triangles that could go are held by `Hindrance::target`. Does nothing to the
  /// first result.
  void complete(Simplified_soup& result) const
  {
    if (!m_first)
      return;
    const Simplify_report& first = m_first->report;
    Simplify_report& report = result.report;
    report.faces_within_reach = first.faces_output;
    report.faces_target = first.faces_target;
    report.faces_to_go = first.faces_to_go + report.faces_output - first.faces_output;
    report.hindrances = first.hindrances;
    result.held_by.clear();
    for (const Index triangle : result.triangles) {
      const auto held = m_first->held_by.find(triangle);
      result.held_by.push_back(held == m_first->held_by.end() ? Hindrance::target : held->second);
    }
  }

private:
  static constexpr double s_much = 0.25; // of the error allowed

  static std::size_t with_a_tenth(std::size_t faces) { return faces + (faces + 9) / 10; }

  // What the first reduction said: its report, and what held each of its triangles.
  struct First
  {
    Simplify_report report;
    std::unordered_map<Index, Hindrance> held_by;
  };

  Simplify_options m_options;
  std::optional<First> m_first;
};

} // namespace selvedge

#endif // SELVEDGE_MISSED_TARGET_H
