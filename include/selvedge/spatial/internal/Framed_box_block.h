// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_INTERNAL_FRAMED_BOX_BLOCK_H
#define SELVEDGE_SPATIAL_INTERNAL_FRAMED_BOX_BLOCK_H

#include <selvedge/internal/instructions.h>
#include <selvedge/spatial/internal/Box_block.h>
#include <selvedge/spatial/internal/Monotone_box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace selvedge {
namespace internal {

/// Sixteen boxes in about half the room of a `Box_block`: their bounds are whole numbers in a *frame*, which
/// is a cube around all of them that leaves them room to grow.
///
/// The bounds of boxes and of a query become numbers through one map x ↦ ⌊x × scale − origin⌋ per axis, which
/// ends at the sides of the frame. As in a `Monotone_box`, this can add overlaps, but never lose one.
class Framed_box_block
{
public:
  static constexpr std::size_t width = Box_block::width;
  using Mask = Box_block::Mask;
  using Boxes = std::array<Monotone_box, width>;

  /// Makes all boxes empty, so that no query overlaps them.
  Framed_box_block()
  {
    for (std::size_t i = 0; i < width; ++i)
      set_empty(i);
  }

  /// Makes a frame for these boxes, some of which may be empty.
  explicit Framed_box_block(const Boxes& boxes)
  {
    if (const Monotone_box all = bounding_box(boxes); !all.is_empty())
      make_frame(all);
    for (std::size_t i = 0; i < width; ++i)
      put(i, boxes[i]);
  }

  void set_empty(std::size_t i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      m_bounds[axis][i] = s_last;
      m_bounds[3 + axis][i] = -1;
    }
  }

  /// Gives a box that is not empty to one of the sixteen. When it comes to a side of the frame, this is made
  /// anew.
  void set(std::size_t i, const Monotone_box& box)
  {
    if (put(i, box))
      return;
    Boxes boxes;
    for (std::size_t k = 0; k < width; ++k)
      boxes[k] = (*this)[k];
    boxes[i] = box;
    *this = Framed_box_block(boxes);
  }

  /// Returns a box that contains the one that was set, and is hardly larger.
  Monotone_box operator[](std::size_t i) const
  {
    if (m_bounds[3][i] < 0)
      return Monotone_box::empty();
    // A number is rounded by little more than one, and a place here by no more than that.
    const double step = 1 / double(m_scale);
    const auto place = [&](std::size_t axis, int number) {
      constexpr double largest = s_largest;
      return float((std::min)((std::max)((double(m_origin[axis]) + number) * step, -largest), largest));
    };
    Monotone_box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Number lower = m_bounds[axis][i], upper = m_bounds[3 + axis][i];
      box.lower[axis] = lower == 0 ? -s_largest : place(axis, lower - 2);
      box.upper[axis] = upper == s_last ? s_largest : place(axis, upper + 3);
    }
    return box;
  }

  Mask overlapping(const Monotone_box& box) const
  {
    const Bounds query = numbers(box);
    const auto& [x0, y0, z0, x1, y1, z1] = m_bounds;
    Row answers;
    for (std::size_t i = 0; i < width; ++i)
      answers[i] = yes(x0[i] <= query[3]) & yes(y0[i] <= query[4]) & yes(z0[i] <= query[5]) &
                   yes(x1[i] >= query[0]) & yes(y1[i] >= query[1]) & yes(z1[i] >= query[2]);
    return negative(answers);
  }

private:
  using Number = std::int16_t;
  using Row = std::array<Number, width>;
  using Bounds = std::array<Number, 8>; // lower x, y, z, upper x, y, z: eight fill vector instructions

  static constexpr Number s_last = (std::numeric_limits<Number>::max)(); // the first number is 0
  static constexpr float s_largest = (std::numeric_limits<float>::max)();

  static Number yes(bool answer) { return answer ? -1 : 0; }

  // The boxes take an eighth of the frame, in its middle, or less. The scale is a power of two, and one step
  // no smaller than what floats there are rounded by.
  void make_frame(const Monotone_box& all)
  {
    double extent = 0x1p-100;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double lower = all.lower[axis], upper = all.upper[axis];
      extent = (std::max)({extent, upper - lower, 0x1p-10 * std::fabs(lower), 0x1p-10 * std::fabs(upper)});
    }
    const double scale = std::ldexp(1, 11 - std::ilogb(extent));
    m_scale = float(scale);
    for (std::size_t axis = 0; axis < 3; ++axis)
      m_origin[axis] = m_origin[3 + axis] = float((all.lower[axis] - 3.5 * extent) * scale);
  }

  // Places times the scale are exact, so that only places beyond the frame become infinite. What is no
  // number, as 0 × ∞, becomes 0.
  Bounds numbers(const Monotone_box& box) const
  {
    const std::array<float, 8> places{
        box.lower[0], box.lower[1], box.lower[2], box.upper[0], box.upper[1], box.upper[2], 0, 0};
    Bounds result;
    for (std::size_t i = 0; i < result.size(); ++i) {
      const float scaled = places[i] * m_scale - m_origin[i];
      const float positive = scaled > 0 ? scaled : 0;
      result[i] = Number(int(positive < s_last ? positive : s_last));
    }
    return result;
  }

  // Stores a box, and returns whether it does not come to a side of the frame.
  bool put(std::size_t i, const Monotone_box& box)
  {
    if (box.is_empty()) {
      set_empty(i);
      return true;
    }
    const Bounds bounds = numbers(box);
    for (std::size_t k = 0; k < m_bounds.size(); ++k)
      m_bounds[k][i] = bounds[k];
    return (std::min)({bounds[0], bounds[1], bounds[2]}) > 0 &&
           (std::max)({bounds[3], bounds[4], bounds[5]}) < s_last;
  }

  std::array<Row, 6> m_bounds;     // lower x, y, z, upper x, y, z
  std::array<float, 8> m_origin{}; // of these bounds, in steps
  float m_scale = 0;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SPATIAL_INTERNAL_FRAMED_BOX_BLOCK_H
