// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G1, G4 and G5 on small random soups that have everything wrong with them that a soup can have.

#include "support/reduction.h"

#include <gtest/gtest.h>

#include <random>

namespace selvedge::test {
namespace {

// Layers on an integer grid: they touch, fold, overlap; triangles are missing, doubled, turned over; vertices
// are shared or not, so that pieces hang together by edges, by single vertices, or only by position.
Triangle_soup random_soup(std::mt19937& random)
{
  Triangle_soup soup;
  const auto one_in = [&](unsigned n) { return random() % n == 0; };
  const Index layers = 1 + random() % 4, size = 2 + random() % 5;
  const bool is_flat = one_in(4), is_turned = one_in(4), is_sheared = one_in(4);
  for (Index layer = 0; layer < layers; ++layer) {
    const Index first = Index(soup.points.size());
    for (Index y = 0; y <= size; ++y)
      for (Index x = 0; x <= size; ++x) {
        const double height = is_flat ? 0 : random() % 3, shear = is_sheared ? 0.25 * (random() % 3) : 0;
        soup.points.emplace_back(x + shear, y + shear, 2 * layer + height);
      }
    for (Index y = 0; y < size; ++y)
      for (Index x = 0; x < size; ++x) {
        if (one_in(12))
          continue;
        const Index a = first + y * (size + 1) + x, b = a + 1, c = b + size + 1, d = c - 1;
        const bool turns_over = is_turned && one_in(10);
        const auto add = [&](Index i, Index j, Index k) {
          soup.triangles.push_back(turns_over ? Index_triple{i, k, j} : Index_triple{i, j, k});
          if (one_in(60))
            soup.triangles.push_back({i, k, j});
        };
        if (one_in(2)) {
          add(a, b, c);
          add(a, c, d);
        } else {
          add(a, b, d);
          add(b, c, d);
        }
      }
  }
  if (one_in(3))
    for (Index_triple& triangle : soup.triangles)
      for (Index& vertex : triangle)
        if (one_in(10)) {
          soup.points.push_back(soup.points[vertex]);
          vertex = Index(soup.points.size() - 1);
        }
  return soup;
}

TEST(RandomSoups, KeepTheirPairsTheirPiecesAndTheirCorners)
{
  std::size_t collapses = 0, with_pairs = 0, with_seams = 0;
  for (unsigned seed = 1; seed <= 1500; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const Triangle_soup soup = random_soup(random);
    if (soup.triangles.empty())
      continue;
    const Simplify_options limited = to_ratio(0);
    const Defects defects = seed % 4 < 2 ? Defects::freeze : Defects::descend;
    const Reduction reduction = reduce(soup, seed % 2 ? limited : without_limits(limited), with(defects));
    ASSERT_TRUE(reduction.verification.new_pairs.empty());
    ASSERT_TRUE(reduction.verification.same_topology());
    const std::size_t pairs = reduction.verification.pairs.size(),
                      before = reduction.prepared.offending_pairs.size();
    ASSERT_TRUE(defects == Defects::freeze ? pairs == before : pairs <= before);
    collapses += reduction.simplified.report.collapses;
    with_pairs += !reduction.prepared.offending_pairs.empty();
    with_seams += reduction.simplified.sewing.seam_edges > 0;
  }
  EXPECT_GT(collapses, 30000u);
  EXPECT_GT(with_pairs, 500u);
  EXPECT_GT(with_seams, 300u);
}

// The control.
TEST(RandomSoups, GetNewPairsWithoutTheFilter)
{
  std::size_t spoiled = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    std::mt19937 random(seed);
    const Triangle_soup soup = random_soup(random);
    if (!soup.triangles.empty())
      spoiled += !reduce(soup, without_check(without_limits(to_ratio(0))), with(Defects::freeze))
                      .verification.new_pairs.empty();
  }
  EXPECT_GT(spoiled, 20u);
}

} // namespace
} // namespace selvedge::test
