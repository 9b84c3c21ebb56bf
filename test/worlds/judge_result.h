// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_JUDGE_RESULT_H
#define SELVEDGE_TEST_WORLDS_JUDGE_RESULT_H

#include "Broken_promise.h"
#include "Judged_complex.h"
#include "World_run.h"

#include <cstddef>
#include <cstring>
#include <vector>

namespace selvedge::test {

/// Whether a corner of a triangle of the result has the value of a corner, 3 × triangle + place, of the
/// original.
template <class Values>
bool has_same_value(const Values& result, Index triangle, const Values& original, Index corner, std::size_t k)
{
  if (result.empty() || original.empty())
    return result.empty() == original.empty();
  return std::memcmp(&result.values[result.of_triangle[triangle][k]],
                     &original.values[original.of_triangle[corner / 3][corner % 3]],
                     sizeof original.values[0]) == 0;
}

/// Whether a triangle of the result has the label of one of the original.
bool has_same_label(const Triangle_labels& result, Index triangle, const Triangle_labels& original,
                    Index from);

/// Returns the fourth number of a tangent: on which side of a mirrored texture it is.
inline float side_of_tangent(const Attribute& tangents, Index vertex)
{
  float side;
  std::memcpy(&side, tangents.rows.data() + (4 * vertex + 3) * sizeof side, sizeof side);
  return side;
}

/// Whether every triangle that is left has what corners of the input have at its positions, on its side of
/// the lines. `regions` has for every triangle the number of its side.
Verdict judge_attributes(const World& world, const World_run& run, const Judged_complex& complex,
                         const std::vector<Index>& regions, const std::vector<char>& is_held);

/// Whether every piece keeps its boundary loops and its Euler number.
Verdict judge_pieces(const World_run& run);

/// Whether borders that face others across a gap drift by no more than a tenth of what borders may, by the
/// list of collapses.
Verdict judge_drift(const World& world, const World_run& run);

/// Whether shared meshes have the same triangles of the same rows in all places.
Verdict judge_sharing(const World_run& run);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_JUDGE_RESULT_H
