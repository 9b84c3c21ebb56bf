// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_SAME_BITS_H
#define SELVEDGE_TEST_WORLDS_SAME_BITS_H

#include <selvedge/Triangle_soup.h>

#include <array>
#include <cstring>

namespace selvedge::test {

using Coordinates = std::array<double, 3>;

inline Coordinates coordinates(const Point_3& p)
{
  return {p.x(), p.y(), p.z()};
}

inline bool has_same_bits(const Point_3& p, const Point_3& q)
{
  const Coordinates a = coordinates(p), b = coordinates(q);
  return std::memcmp(&a, &b, sizeof a) == 0;
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_SAME_BITS_H
