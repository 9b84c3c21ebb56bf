// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/verify.h>

#include <oneapi/tbb/parallel_invoke.h>

namespace selvedge {

Verification verify(const Triangle_soup& mesh)
{
  Verification verification;
  tbb::parallel_invoke([&] { verification.pairs = verification.new_pairs = offending_pairs(mesh); },
                       [&] { verification.pieces = pieces(mesh); });
  return verification;
}

Verification verify(const Triangle_soup& result, const Triangle_soup& original)
{
  return verify(result, original, offending_pairs(original));
}

Verification verify(const Triangle_soup& result, const Triangle_soup& original,
                    const std::vector<Offending_pair>& pairs_of_original)
{
  Verification verification;
  std::vector<Piece> pieces_of_original;
  tbb::parallel_invoke([&] { verification = verify(result); },
                       [&] { pieces_of_original = pieces(original); });
  verification.new_pairs = new_pairs(result, verification.pairs, original, pairs_of_original);
  verification.topology_differences = topology_differences(verification.pieces, pieces_of_original);
  verification.distances = distances(result, original);
  return verification;
}

} // namespace selvedge
