// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Cancellation_scope.h>
#include <selvedge/verify.h>

#include "rounded.h"

#include <oneapi/tbb/parallel_invoke.h>

#include <utility>

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
  if (!internal::is_only_first_rounded(result, original))
    return verify(result, original, offending_pairs(original), options);
  const Triangle_soup rounded = internal::rounded(original);
  Verification verification = verify(result, rounded, offending_pairs(rounded), options);
  verification.is_original_rounded = true;
  return verification;
}

Verification verify(const Triangle_soup& result, const Triangle_soup& original,
                    const std::vector<Offending_pair>& pairs_of_original, const Verify_options& options)
{
  Verification verification;
  Piece_matching matching;
  tbb::parallel_invoke(
      Cancellation_scope::inherited([&] { verification = verify(result); }),
      Cancellation_scope::inherited([&] { matching = match_pieces(result, original, options); }));
  verification.matching = std::move(matching);
  verification.new_pairs = new_pairs(result, verification.pairs, original, pairs_of_original);
  verification.topology_differences =
      topology_differences(verification.pieces, verification.matching.pieces_of_original);
  verification.distances = distances(result, original);
  return verification;
}

} // namespace selvedge
