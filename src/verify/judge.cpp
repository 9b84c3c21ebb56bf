// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Parts.h>
#include <selvedge/compare.h>
#include <selvedge/rounding.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace selvedge {
namespace {

/// Leaves out the layers that changed places because they may intersect each other.
void leave_out_permitted(std::vector<Layer_swap>& swaps, const Triangle_soup& result,
                         const Verify_options& options)
{
  for (const auto& parts : options.may_intersect) {
    const std::vector<char> is_of_first = triangles_named(result, parts.first),
                            is_of_second = triangles_named(result, parts.second);
    swaps.erase(std::remove_if(swaps.begin(), swaps.end(),
                               [&](const Layer_swap& swap) {
                                 return are_between(is_of_first, is_of_second, swap.of_result[0],
                                                    swap.of_result[1]);
                               }),
                swaps.end());
  }
}

} // namespace

Judgement judge(const Triangle_soup& result, const Triangle_soup& original, const Verify_options& options,
                const Triangle_soup& obstacle)
{
  Judgement judgement{verify(result, original, options, obstacle), {}};
  const Verification& verification = judgement.verification;
  std::optional<Triangle_soup> rounded;
  if (verification.is_original_rounded)
    round_to_float32(rounded.emplace(original));
  const Triangle_soup& compared = rounded ? *rounded : original;
  Layer_order& layers = judgement.comparison.emplace(compare(result, compared)).layers;
  leave_out_permitted(layers.swaps, result, options);
  if (!layers.swaps.empty() && verification.pairs_of_original > 0)
    leave_out_without_order(layers, result, compared, offending_pairs(compared));
  return judgement;
}

} // namespace selvedge
