// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GENERATE_RANDOM_H
#define SELVEDGE_GENERATE_RANDOM_H

#include <array>
#include <cmath>
#include <random>

namespace selvedge::internal {

/// Random numbers for generated meshes, the same with every standard library: the standard specifies the
/// output of the engine, but not that of its distributions.
class Random
{
public:
  explicit Random(unsigned seed) : m_engine(seed) {}

  /// Uniform in [0,1).
  double unit() { return static_cast<double>(m_engine() >> 11) * 0x1p-53; }

  /// Uniform in [-1,1).
  double symmetric() { return 2 * unit() - 1; }

  bool coin() { return (m_engine() >> 63) != 0; }

private:
  std::mt19937_64 m_engine;
};

/// Returns cosine and sine of an angle in full turns. Those of the mathematics library may differ in the last
/// bit between machines; this uses only operations that are rounded correctly everywhere.
inline std::array<double, 2> cosine_sine(double turns)
{
  const double quarters = std::floor(4 * turns + 0.5);
  const double x = (turns - quarters / 4) * 6.283185307179586;
  const double y = x * x;
  double cosine = 1;
  double sine = 1;
  for (int k = 16; k >= 2; k -= 2) {
    cosine = 1 - y / (k * (k - 1)) * cosine;
    sine = 1 - y / (k * (k + 1)) * sine;
  }
  sine *= x;
  switch (static_cast<long long>(quarters) & 3) {
  case 0:
    return {cosine, sine};
  case 1:
    return {-sine, cosine};
  case 2:
    return {-cosine, -sine};
  default:
    return {sine, -cosine};
  }
}

} // namespace selvedge::internal

#endif // SELVEDGE_GENERATE_RANDOM_H
