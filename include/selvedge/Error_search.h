// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_ERROR_SEARCH_H
#define SELVEDGE_ERROR_SEARCH_H

#include <selvedge/compare.h>
#include <selvedge/key_poses.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// Finds an error for `Simplify_options::max_error` with which the result keeps another one everywhere.
///
/// `max_error` limits distances at vertices and at points between them; elsewhere they may be larger. A
/// caller who needs the limit at every point reduces with `max_error()`, asks `distances_anywhere` for a
/// bound of the distances, and tells it to `advance`, until this returns false. The last reduction is then
/// the one to keep. Two to seven reductions do.
///
/// The error is lowered until the limit is kept. Where it is kept by far, up to two larger ones are tried; if
/// the last of them is too large, the best one is due again.
///
/// **Complexity** At most ten reductions. Where nothing helps, the eighth is the last, with an error of 0,
/// with which what is covered stays covered, and nothing else is.
class Error_search
{
public:
  /// `wanted` is the distance that no point may exceed, at least 0, in any unit.
  explicit Error_search(double wanted) : m_wanted(wanted), m_max_error(wanted) {}

  /// The error to reduce with, in the same unit.
  double max_error() const { return m_max_error; }

  /// How many reductions there have been, the one that comes next included.
  std::size_t reductions() const { return m_reductions; }

  /// Called after a reduction, with an upper bound of the distance of any point. Returns whether another
  /// reduction is due, with another `max_error()`.
  bool advance(double upper)
  {
    const Trial last{m_max_error, upper};
    if (upper <= m_wanted) {
      m_kept = last;
    } else {
      m_too_large = last;
      if (m_kept.error >= m_max_error) // the caller has changed other options
        m_kept = {};
    }
    if (m_max_error <= 0)
      return false;
    if (!m_kept.is_made()) {
      lower();
    } else if (m_too_large.is_made() && m_raises_left > 0 && m_kept.upper < s_enough * m_wanted) {
      --m_raises_left;
      raise();
    } else if (m_max_error != m_kept.error) {
      m_raises_left = 0;
      m_max_error = m_kept.error;
    } else {
      return false;
    }
    ++m_reductions;
    return true;
  }

  /// Called after a reduction, or several, one for each level of detail, with the largest distances of their
  /// results. Returns whether another one is due. Where the distances are too large in a further pose that is
  /// not guarded, adds this to the numbers of those that are, and leaves the error as it is.
  bool advance(const std::vector<Bounds_over_poses>& levels, std::vector<std::size_t>& guarded_poses)
  {
    Bounds_over_poses largest;
    for (const Bounds_over_poses& level : levels)
      if (level.upper >= largest.upper)
        largest = level;
    if (largest.upper > m_wanted && largest.pose && add_pose(guarded_poses, *largest.pose))
      return true;
    return advance(largest.upper);
  }

private:
  // A reduction with an error, and the bound that it had.
  struct Trial
  {
    double error = -1, upper = 0;

    bool is_made() const { return error >= 0; }
  };

  static constexpr double s_enough = 0.93; // of the limit: an error that comes so near is not raised

  // A smaller error changes which edges collapse, and may help less than it should: then the next helps more.
  void lower()
  {
    const double next = m_max_error * (m_wanted / m_too_large.upper) * (1 - m_reserve);
    m_max_error = next > 0 ? next : 0;
    m_reserve *= 3;
  }

  // Between the two, where their bounds let expect the limit.
  void raise()
  {
    const double expected = (m_wanted - m_kept.upper) / (m_too_large.upper - m_kept.upper);
    const double share = expected > 0.8 ? 0.8 : expected > 0.2 ? expected : 0.2;
    m_max_error = m_kept.error + share * (m_too_large.error - m_kept.error);
  }

  double m_wanted, m_max_error, m_reserve = 0.004;
  Trial m_kept, m_too_large; // the last of either kind
  std::size_t m_reductions = 1, m_raises_left = 2;
};

} // namespace selvedge

#endif // SELVEDGE_ERROR_SEARCH_H
