// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_REPLAY_LIMITS_H
#define SELVEDGE_SRC_REPLAY_LIMITS_H

#include "Complex.h"

#include <selvedge/Reduction_limits.h>
#include <selvedge/replay.h>

#include <optional>
#include <string>

namespace selvedge::reference {

/// The share of what is compared by which a limit may be missed: programs that add in another order do not
/// differ about a limit.
inline constexpr double limit_tolerance = 1e-9;

double distance(const Coordinates& a, const Coordinates& b);

/// Returns the limit that a violation is of; null where it is of none.
const Limit_description* limit_of(Violation_kind kind);

/// Returns a sentence for a step that breaks a limit.
std::string message_of_limit(Violation_kind kind, double limit);

/// Judges collapses by limits of quality, in floating point.
class Limits
{
public:
  explicit Limits(const Reduction_limits& limits) : m_limits(limits) {}

  /// The bounding box that the drift is a share of, and by the largest coordinate of which all coordinates
  /// are brought to one size: areas and their squares then neither overflow nor vanish.
  void set_size(const Coordinates& low, const Coordinates& high);

  /// The first limit that is not kept when `removed` and `kept` merge at `place`.
  std::optional<Violation_kind> judge(const Complex& complex, Index removed, Index kept,
                                      const Coordinates& place, bool is_kept_still) const;

  /// Returns a sentence for a collapse that `judge` has refused.
  std::string message(Violation_kind kind) const;

private:
  std::optional<Violation_kind> judge_line(const Complex& complex, Index mover, Index other,
                                           const Coordinates& place) const;
  std::optional<Violation_kind> judge_shapes(const Complex& complex, Index removed, Index kept,
                                             const Coordinates& place, bool is_kept_still) const;

  Reduction_limits m_limits;
  Coordinates scaled(const Coordinates& point) const;

  int m_exponent = 0;
  double m_diagonal = 0;
};

} // namespace selvedge::reference

#endif // SELVEDGE_SRC_REPLAY_LIMITS_H
