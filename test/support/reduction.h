// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_REDUCTION_H
#define SELVEDGE_TEST_SUPPORT_REDUCTION_H

#include <selvedge/simplify.h>
#include <selvedge/verify.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace selvedge::test {

inline Simplify_options to_ratio(double ratio)
{
  Simplify_options options;
  options.ratio = ratio;
  return options;
}

inline Simplify_options without_check(Simplify_options options)
{
  options.check_intersections = false;
  return options;
}

/// What limits of quality would hide from the exact filter is let through.
inline Simplify_options without_limits(Simplify_options options)
{
  options.max_normal_change = 180;
  options.min_aspect_ratio = 0;
  options.max_border_turn = 180;
  options.max_seam_turn = 180;
  options.max_border_drift = 10;
  return options;
}

/// Returns options for every means that gives the same guarantees: another placement, loop and index, and
/// cells of so many faces unless they are 0. The first are `options` themselves.
inline std::vector<Simplify_options> every_means(const Simplify_options& options,
                                                 std::size_t faces_per_cell = 0)
{
  std::vector<Simplify_options> all(faces_per_cell > 0 ? 5 : 4, options);
  all[1].placement = Placement::optimal;
  all[2].loop = Collapse_loop::cgal;
  all[3].index = Face_index::clusters;
  all.back().faces_per_cell = faces_per_cell;
  return all;
}

inline Prepare_options with(Defects defects)
{
  Prepare_options options;
  options.defects = defects;
  return options;
}

/// An original, what became of it, and what the judge says.
struct Reduction
{
  Prepared_soup prepared;
  Simplified_soup simplified;
  Verification verification;
};

inline Reduction reduce(Triangle_soup soup, const Simplify_options& options,
                        const Prepare_options& prepare_options = {})
{
  Reduction reduction;
  reduction.prepared = prepare(std::move(soup), prepare_options);
  reduction.simplified = simplify_soup(reduction.prepared, options);
  reduction.verification = verify(reduction.simplified, reduction.prepared);
  return reduction;
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_REDUCTION_H
