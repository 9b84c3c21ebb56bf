// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G8: determinism. The same input and options give the same result.

#include "support/meshes.h"
#include "support/reduction.h"

#include <gtest/gtest.h>

namespace selvedge::test {
namespace {

TEST(Determinism, SameInputAndOptionsGiveTheSameBytes)
{
  const Triangle_soup garment = skirt(6000);
  const Triangle_soup first = reduce(garment, to_ratio(0.2)).simplified.soup;
  const Triangle_soup second = reduce(garment, to_ratio(0.2)).simplified.soup;
  EXPECT_EQ(first.triangles, second.triangles);
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(first.uvs.values, second.uvs.values);
}

TEST(Determinism, TheIndexDoesNotChangeTheResult)
{
  const Triangle_soup garment = skirt(6000);
  Simplify_options options = to_ratio(0.2);
  const Triangle_soup reference = reduce(garment, options).simplified.soup;
  options.index = Face_index::clusters;
  for (const std::size_t size : {1, 10, 100, 100000}) {
    options.faces_per_cluster = size;
    EXPECT_EQ(reduce(garment, options).simplified.soup.triangles, reference.triangles);
  }
}

// A control: the comparison above can tell results apart.
TEST(Determinism, OtherOptionsGiveAnotherResult)
{
  const Triangle_soup garment = skirt(6000);
  Simplify_options options = to_ratio(0.2);
  const Triangle_soup reference = reduce(garment, options).simplified.soup;
  options.max_normal_change /= 2;
  EXPECT_NE(reduce(garment, options).simplified.soup.triangles, reference.triangles);
}

} // namespace
} // namespace selvedge::test
