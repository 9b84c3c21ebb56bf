// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_INTERNAL_STOPWATCH_H
#define SELVEDGE_INTERNAL_STOPWATCH_H

#include <chrono>

namespace selvedge {
namespace internal {

/// Measures the time since it was made, or since the last call of `restart`.
class Stopwatch
{
public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - m_start).count(); }

  /// Returns the seconds measured, and starts again from 0.
  double restart()
  {
    const double passed = seconds();
    m_start = Clock::now();
    return passed;
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point m_start = Clock::now();
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_INTERNAL_STOPWATCH_H
