// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Reduction_limits.h>

#include <selvedge/Simplify_options.h>

namespace selvedge {

Reduction_limits limits_of(const Simplify_options& options)
{
  Reduction_limits limits;
  limits.normal_change = options.max_normal_change;
  limits.aspect_ratio = options.min_aspect_ratio;
  limits.border_turn = options.max_border_turn;
  limits.corner_height = options.max_corner_height;
  limits.seam_turn = options.max_seam_turn;
  limits.border_drift = options.max_border_drift;
  limits.clearance = options.clearance;
  return limits;
}

Reduction_limits limits_of_seed()
{
  Reduction_limits limits;
  limits.normal_change = 45;
  limits.aspect_ratio = 0.2;
  limits.border_turn = 8;
  limits.seam_turn = 8;
  return limits;
}

} // namespace selvedge
