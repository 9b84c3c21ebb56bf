// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Cancellation_scope.h>
#include <selvedge/verify.h>

#include "rounded.h"
#include "soup/obstacle.h"

#include <oneapi/tbb/parallel_invoke.h>

// The judge, which decides whether a result may be written. It puts together what `offending_pairs`,
// `pieces`, `match_pieces` and `distances` say of a result and its original, and knows nothing of the
// reduction.

namespace selvedge {

Verification verify(const Triangle_soup& mesh)
{
  Verification verification;
  tbb::parallel_invoke(Cancellation_scope::inherited(
                           [&] { verification.pairs = verification.new_pairs = offending_pairs(mesh); }),
                       Cancellation_scope::inherited([&] { verification.pieces = pieces(mesh); }));
  return verification;
}

Verification verify(const Triangle_soup& result, const Triangle_soup& original, const Verify_options& options)
{
  if (!options.may_be_rounded || !internal::is_only_first_rounded(result, original))
    return verify(result, original, offending_pairs(original), options);
  const Triangle_soup rounded = internal::rounded(original);
  Verification verification = verify(result, rounded, offending_pairs(rounded), options);
  verification.is_original_rounded = true;
  return verification;
}

Verification verify(const Triangle_soup& result, const Triangle_soup& original,
                    const std::vector<Offending_pair>& pairs_of_original, const Verify_options& options,
                    const Triangle_soup& obstacle)
{
  const auto find_new_pairs = [&](Verification& verification, const Triangle_soup& after,
                                  const Triangle_soup& before) {
    verification.pairs = offending_pairs(after);
    if (!options.collapses) {
      verification.new_pairs = new_pairs(after, verification.pairs, before, pairs_of_original);
      return;
    }
    std::vector<Index> triangles = options.triangles_of_original;
    for (std::size_t t = original.triangles.size(); t < before.triangles.size(); ++t)
      triangles.push_back(Index(t)); // of the obstacle
    verification.new_pairs = pairs_without_descent(after, verification.pairs, before, pairs_of_original,
                                                   *options.collapses, triangles);
  };
  Verification verification;
  verification.pairs_of_original = pairs_of_original.size();
  tbb::parallel_invoke(Cancellation_scope::inherited([&] {
                         if (obstacle.triangles.empty())
                           find_new_pairs(verification, result, original);
                         else
                           find_new_pairs(verification, geometry_with_obstacle(result, obstacle),
                                          geometry_with_obstacle(original, obstacle));
                       }),
                       Cancellation_scope::inherited([&] { verification.pieces = pieces(result); }),
                       Cancellation_scope::inherited(
                           [&] { verification.matching = match_pieces(result, original, options); }));
  verification.topology_differences =
      topology_differences(verification.pieces, verification.matching.pieces_of_original);
  verification.distances = distances(result, original);
  return verification;
}

} // namespace selvedge
