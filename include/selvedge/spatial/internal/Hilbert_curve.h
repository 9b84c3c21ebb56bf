// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_INTERNAL_HILBERT_CURVE_H
#define SELVEDGE_SPATIAL_INTERNAL_HILBERT_CURVE_H

#include <array>
#include <cstdint>

namespace selvedge {
namespace internal {

/// The Hilbert curve through all cells of a cube of 2²¹ cells a side. Each step goes to a neighbouring cell.
///
/// **Reference** Hamilton, Rau-Chaplin: Compact Hilbert indices: space-filling curves for domains with
/// unequal side lengths.
class Hilbert_curve
{
public:
  using Cell = std::array<std::uint32_t, 3>;
  static constexpr int bits = 21; ///< of a coordinate; a place on the curve has three times as many

  constexpr Hilbert_curve()
  {
    for (unsigned entry = 0; entry < 8; ++entry)
      for (unsigned direction = 0; direction < 3; ++direction)
        for (unsigned octant = 0; octant < 8; ++octant)
          m_steps[3 * entry + direction][octant] = step(entry, direction, octant);
  }

  /// Returns the place of a cell on the curve, counted from 0.
  std::uint64_t place_of(const Cell& cell) const
  {
    const std::uint64_t octants = spread(cell[0]) | spread(cell[1]) << 1 | spread(cell[2]) << 2;
    std::uint64_t place = 0;
    unsigned state = 0;
    for (int shift = 3 * (bits - 1); shift >= 0; shift -= 3) {
      const Step& step = m_steps[state][octants >> shift & 7];
      place = place << 3 | step.rank;
      state = step.state;
    }
    return place;
  }

private:
  /// What one octant of a cube is for a curve in a given state: its rank along the curve, and the state in
  /// which the curve runs through it.
  struct Step
  {
    std::uint8_t rank = 0;
    std::uint8_t state = 0;
  };

  static constexpr unsigned rotated_right(unsigned octant, unsigned by)
  {
    return (octant >> by % 3 | octant << (3 - by % 3)) & 7;
  }
  static constexpr unsigned gray_code(unsigned rank) { return rank ^ rank >> 1; }
  static constexpr unsigned trailing_ones(unsigned rank)
  {
    return rank % 2 == 0 ? 0 : 1 + trailing_ones(rank / 2);
  }

  // A state consists of the corner at which the curve enters a cube and the axis along which it leaves.
  static constexpr Step step(unsigned entry, unsigned direction, unsigned octant)
  {
    const unsigned code = rotated_right(octant ^ entry, direction + 1);
    const unsigned rank = code ^ code >> 1 ^ code >> 2;
    const unsigned entry_within = rank == 0 ? 0 : gray_code((rank - 1) / 2 * 2);
    const unsigned direction_within = rank == 0 ? 0 : trailing_ones(rank % 2 == 0 ? rank - 1 : rank);
    const unsigned next_entry = entry ^ rotated_right(entry_within, 2 * (direction + 1));
    const unsigned next_direction = (direction + direction_within + 1) % 3;
    return {std::uint8_t(rank), std::uint8_t(3 * next_entry + next_direction)};
  }

  // Moves each bit i to bit 3i.
  static constexpr std::uint64_t spread(std::uint64_t x)
  {
    x = (x | x << 32) & 0x001f00000000ffff;
    x = (x | x << 16) & 0x001f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
  }

  std::array<std::array<Step, 8>, 24> m_steps{};
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SPATIAL_INTERNAL_HILBERT_CURVE_H
