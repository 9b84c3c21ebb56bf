// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_ERROR_SEARCH_H
#define SELVEDGE_ERROR_SEARCH_H

#include <cmath>
#include <cstddef>

namespace selvedge {

/// Finds an error for `Simplify_options::max_error` with which the result keeps another one everywhere.
///
/// `max_error` limits distances at vertices and at points between them; elsewhere they may be larger. A
/// caller who needs the limit at every point reduces with `max_error()`, asks `distances_anywhere` for a
/// bound of the distances, and tells it to `lower`, until this returns false. Two to five reductions do.
///
/// **Complexity** At most eight reductions. The last would be with an error of 0.
class Error_search
{
public:
  /// `wanted` is the distance that no point may exceed, at least 0, in any unit.
  explicit Error_search(double wanted) : m_wanted(wanted), m_max_error(wanted) {}

  /// The error to reduce with, in the same unit.
  double max_error() const { return m_max_error; }

  /// How many reductions there have been, the one that comes next included.
  std::size_t reductions() const { return m_reductions; }

  /// Called after a reduction, with an upper bound of the distance of any point. Returns false when it is
  /// kept, or when nothing less can be asked for; otherwise lowers `max_error()`.
  bool lower(double upper)
  {
    if (upper <= m_wanted || m_max_error <= 0)
      return false;
    // A smaller error changes which edges collapse, and may help less than it should: then the next helps
    // more.
    const double reserve = std::ldexp(0.01, int(m_reductions++));
    const double next = m_max_error * (m_wanted / upper) * (1 - reserve);
    m_max_error = next > 0 ? next : 0;
    return true;
  }

private:
  double m_wanted, m_max_error;
  std::size_t m_reductions = 1;
};

} // namespace selvedge

#endif // SELVEDGE_ERROR_SEARCH_H
