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

/// The relative tolerance of comparisons with a limit, so that programs that round differently agree about
/// it.
inline constexpr double limit_tolerance = 1e-9;

double distance(const Coordinates& a, const Coordinates& b);

/// Returns the limit that a violation of this kind breaks; null when it breaks none.
const Limit_description* limit_of(Violation_kind kind);

/// Returns a sentence for a step that breaks a limit.
std::string message_of_limit(Violation_kind kind, double limit);

/// Judges, for `replay`, whether a collapse keeps the limits of quality, in floating point.
class Limits
{
public:
  explicit Limits(const Reduction_limits& limits) : m_limits(limits) {}

  /// Sets the corners of the bounding box. Its diagonal is the unit of the drift. Its largest coordinate
  /// determines the power of two by which all coordinates are divided, so that areas and their squares
  /// neither overflow nor vanish.
  void set_size(const Coordinates& low, const Coordinates& high);

  /// Makes the diagonal of another box the unit of the drift.
  void set_diagonal(const Coordinates& low, const Coordinates& high);

  /// Returns the first limit that is broken when `removed` and `kept` merge at `place`.
  std::optional<Violation_kind> judge(const Complex& complex, Index removed, Index kept,
                                      const Coordinates& place, bool is_kept_still) const;

  /// Returns a sentence for a collapse that `judge` has refused.
  std::string message(Violation_kind kind) const;

private:
  static bool takes_needed_line(const Complex& complex, Index removed, Index kept);
  std::optional<Violation_kind> judge_line(const Complex& complex, Index mover, Index other,
                                           const Coordinates& place) const;
  std::optional<Violation_kind> judge_shapes(const Complex& complex, Index removed, Index kept,
                                             const Coordinates& place, bool is_kept_still) const;

  bool is_of_strip(const Complex& complex, Index face, Index mover, Index other) const;
  Coordinates scaled(const Coordinates& point) const;

  bool has_low_corners() const { return m_limits.corner_height && *m_limits.corner_height > 0; }

  // Returns a length that is a share of the diagonal, with what rounding may add.
  double highest(double limit) const;

  Reduction_limits m_limits;

  int m_exponent = 0;
  double m_diagonal = 0;
};

} // namespace selvedge::reference

#endif // SELVEDGE_SRC_REPLAY_LIMITS_H
