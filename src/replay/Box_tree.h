// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_REPLAY_BOX_TREE_H
#define SELVEDGE_SRC_REPLAY_BOX_TREE_H

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Triangle_soup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace selvedge::reference {

/// An axis-parallel box; empty until something is added.
struct Box
{
  std::array<double, 3> low{s_infinity, s_infinity, s_infinity};
  std::array<double, 3> high{-s_infinity, -s_infinity, -s_infinity};

  void add(const std::array<double, 3>& point)
  {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], point[k]);
      high[k] = std::max(high[k], point[k]);
    }
  }
  void add(const Box& other)
  {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
  bool overlaps(const Box& other) const
  {
    for (int k = 0; k < 3; ++k)
      if (low[k] > other.high[k] || high[k] < other.low[k])
        return false;
    return true;
  }
  bool is_empty() const { return low[0] > high[0]; }
  bool operator==(const Box& other) const { return low == other.low && high == other.high; }

private:
  static constexpr double s_infinity = std::numeric_limits<double>::infinity();
};

/// The boxes of faces in a balanced binary tree, in which `replay` finds the faces near a motion. `set` keeps
/// all boxes exact. The owner builds the tree anew when half of the faces are gone.
class Box_tree
{
public:
  void build(const std::vector<Index>& faces, const std::vector<Box>& boxes)
  {
    m_leaves = 1;
    while (m_leaves < faces.size())
      m_leaves *= 2;
    m_boxes.assign(2 * m_leaves, Box());
    m_faces.assign(m_leaves, 0);
    m_leaf_of.assign(boxes.size(), 0);
    std::vector<Index> order = faces;
    place(order, boxes, 0, order.size(), 1);
    for (std::size_t node = m_leaves; --node > 0;)
      join(node);
  }

  void set(Index face, const Box& box)
  {
    std::size_t node = m_leaves + m_leaf_of[face];
    m_boxes[node] = box;
    while ((node /= 2) > 0) {
      const Box before = m_boxes[node];
      join(node);
      if (m_boxes[node] == before)
        return;
    }
  }

  template <class Visitor>
  void visit(const Box& box, Visitor&& visitor, std::size_t node = 1) const
  {
    if (!m_boxes[node].overlaps(box))
      return;
    if (node >= m_leaves) {
      visitor(m_faces[node - m_leaves]);
      return;
    }
    visit(box, visitor, 2 * node);
    visit(box, visitor, 2 * node + 1);
  }

private:
  void join(std::size_t node)
  {
    m_boxes[node] = m_boxes[2 * node];
    m_boxes[node].add(m_boxes[2 * node + 1]);
  }

  // Halves the faces along the widest axis of their boxes, down to one face for each leaf.
  void place(std::vector<Index>& order, const std::vector<Box>& boxes, std::size_t first, std::size_t beyond,
             std::size_t node)
  {
    if (first == beyond)
      return;
    m_poll();
    if (node >= m_leaves) {
      m_faces[node - m_leaves] = order[first];
      m_leaf_of[order[first]] = node - m_leaves;
      m_boxes[node] = boxes[order[first]];
      return;
    }
    Box all;
    for (std::size_t i = first; i < beyond; ++i)
      all.add(boxes[order[i]]);
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (all.high[k] - all.low[k] > all.high[axis] - all.low[axis])
        axis = k;
    const std::size_t middle = first + (beyond - first + 1) / 2;
    const auto centre = [&](Index face) { return boxes[face].low[axis] / 2 + boxes[face].high[axis] / 2; };
    std::nth_element(
        order.begin() + std::ptrdiff_t(first), order.begin() + std::ptrdiff_t(middle) - (middle == beyond),
        order.begin() + std::ptrdiff_t(beyond), [&](Index a, Index b) { return centre(a) < centre(b); });
    place(order, boxes, first, middle, 2 * node);
    place(order, boxes, middle, beyond, 2 * node + 1);
  }

  Cancellation_poll m_poll;
  std::size_t m_leaves = 0;
  std::vector<Box> m_boxes; // node k has the children 2k and 2k + 1
  std::vector<Index> m_faces;
  std::vector<std::size_t> m_leaf_of;
};

} // namespace selvedge::reference

#endif // SELVEDGE_SRC_REPLAY_BOX_TREE_H
