// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_REPLAY_LIMITS_H
#define SELVEDGE_SRC_REPLAY_LIMITS_H

#include "Complex.h"

#include <selvedge/collapse_log.h>
#include <selvedge/replay.h>

#include <optional>

namespace selvedge::reference {

/// The limits that a log declares, in floating point.
class Limits
{
public:
  explicit Limits(const Log_header& header) : m_header(header) {}

  /// The bounding box that the drift is a share of.
  void set_size(const Coordinates& low, const Coordinates& high);

  /// The first limit that is not kept when `removed` and `kept` merge at `place`.
  std::optional<Violation_kind> judge(const Complex& complex, Index removed, Index kept,
                                      const Coordinates& place, bool is_kept_still) const;

  static const char* message(Violation_kind kind);

private:
  std::optional<Violation_kind> judge_line(const Complex& complex, Index mover, Index other,
                                           const Coordinates& place) const;
  std::optional<Violation_kind> judge_shapes(const Complex& complex, Index removed, Index kept,
                                             const Coordinates& place, bool is_kept_still) const;

  Log_header m_header;
  double m_diagonal = 0;
};

} // namespace selvedge::reference

#endif // SELVEDGE_SRC_REPLAY_LIMITS_H
