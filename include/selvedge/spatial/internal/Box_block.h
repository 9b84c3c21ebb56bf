// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_INTERNAL_BOX_BLOCK_H
#define SELVEDGE_SPATIAL_INTERNAL_BOX_BLOCK_H

#include <selvedge/internal/instructions.h>
#include <selvedge/spatial/internal/Monotone_box.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace selvedge {
namespace internal {

/// Sixteen boxes, stored bound by bound, so that a query is tested against all of them at once. The loops
/// below are written such that compilers make vector instructions of them.
class alignas(64) Box_block
{
public:
  static constexpr std::size_t width = 16;

  /// A set of these boxes: bit k stands for box k.
  using Mask = std::uint32_t;

  /// Makes all boxes empty, so that no query overlaps them.
  Box_block()
  {
    for (std::size_t i = 0; i < width; ++i)
      set(i, Monotone_box::empty());
  }

  void set(std::size_t i, const Monotone_box& box)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      m_bounds[axis][i] = box.lower[axis];
      m_bounds[3 + axis][i] = box.upper[axis];
    }
  }

  Monotone_box operator[](std::size_t i) const
  {
    return {{m_bounds[0][i], m_bounds[1][i], m_bounds[2][i]},
            {m_bounds[3][i], m_bounds[4][i], m_bounds[5][i]}};
  }

  Mask overlapping(const Monotone_box& box) const
  {
    const auto& [x0, y0, z0, x1, y1, z1] = m_bounds;
    Answers answers;
    for (std::size_t i = 0; i < width; ++i)
      answers[i] = yes(x0[i] <= box.upper[0]) & yes(y0[i] <= box.upper[1]) & yes(z0[i] <= box.upper[2]) &
                   yes(x1[i] >= box.lower[0]) & yes(y1[i] >= box.lower[1]) & yes(z1[i] >= box.lower[2]);
    return negative(answers);
  }

  /// Returns the first box of a mask. **Precondition** The mask is not 0.
  static std::size_t first(Mask mask) { return lowest_bit(mask); }

private:
  using Row = std::array<float, width>;
  using Answers = std::array<std::int32_t, width>; // 0 or −1, as vector instructions give them

  static std::int32_t yes(bool answer) { return answer ? -1 : 0; }

  std::array<Row, 6> m_bounds; // lower x, y, z, upper x, y, z
};

/// Returns a box around the sixteen of a block or an array.
template <class Boxes>
Monotone_box bounding_box(const Boxes& boxes)
{
  Monotone_box box = Monotone_box::empty();
  for (std::size_t i = 0; i < Box_block::width; ++i)
    box += boxes[i];
  return box;
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SPATIAL_INTERNAL_BOX_BLOCK_H
