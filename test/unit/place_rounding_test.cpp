// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Rounded places are those that a file can store, and there are none where it could store only others.

#include "soup/Place_rounding.h"
#include "support/soups.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace selvedge::test {
namespace {

Triangle_soup scaled_triangle(int exponent, bool has_double_digits)
{
  return mapped(one_triangle(), [&](const Point_3& p) {
    const double more = has_double_digits ? 0x1p-40 : 0;
    return Point_3(std::ldexp(p.x() + more, exponent), std::ldexp(p.y(), exponent),
                   std::ldexp(p.z(), exponent));
  });
}

TEST(PlaceRounding, RoundsToPlacesThatItKeepsAndTheScaleKeeps)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (const int exponent : {-90, 0, 7, 100})
    for (const bool has_double_digits : {false, true})
      for (const bool is_float32 : {false, true}) {
        const Triangle_soup soup = scaled_triangle(exponent, has_double_digits);
        const Scale scale(soup);
        const Place_rounding rounding(soup, scale, is_float32);
        const bool are_floats = is_float32 || !has_double_digits;
        for (int i = 0; i < 100; ++i) {
          const Point_3 place(coordinate(random), coordinate(random) * 0x1p-30, coordinate(random));
          const auto rounded = rounding(place, 0);
          ASSERT_TRUE(rounded);
          EXPECT_TRUE(rounding(*rounded, 0) == rounded);
          EXPECT_EQ(scale(scale.undone(*rounded)), *rounded);
          for (int axis = 0; axis < 3; ++axis) {
            const double stored = scale.undone(*rounded)[axis];
            EXPECT_TRUE(!are_floats || double(float(stored)) == stored);
            const double units = std::ldexp((*rounded)[axis], 45);
            EXPECT_EQ(units, std::nearbyint(units)); // as at every other scale
            EXPECT_NEAR((*rounded)[axis], place[axis], are_floats ? 0x1p-25 : 0x1p-46);
          }
        }
      }
}

TEST(PlaceRounding, HasNoPlacesWhereTheTypeOfNumberHasTooFew)
{
  const auto has_places = [](int exponent, bool is_float32) {
    const Triangle_soup soup = scaled_triangle(exponent, false);
    return Place_rounding(soup, Scale(soup), is_float32)(Point_3(0.5, 0.25, 0.125), 0).has_value();
  };
  for (const bool is_float32 : {false, true}) {
    EXPECT_TRUE(has_places(0, is_float32));
    EXPECT_TRUE(has_places(is_float32 ? -100 : -1020, is_float32));
    EXPECT_FALSE(has_places(is_float32 ? -110 : -1035, is_float32));
    EXPECT_TRUE(has_places(is_float32 ? 115 : 1010, is_float32));
    EXPECT_FALSE(has_places(is_float32 ? 125 : 1021, is_float32));
  }
}

} // namespace
} // namespace selvedge::test
