// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_QUEUE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_QUEUE_H

#include <CGAL/number_type_basic.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// A priority queue of numbered edges by (cost, number): the cheapest edge comes first, and of equally cheap
/// ones that with the lowest number, so that the order depends on the costs alone.
///
/// In relaxed order, edges come by (class, tile, cost, number). There are sixteen classes of costs from each
/// power of two to the next; costs that are not positive are one class. A tile is 16,384 edges with
/// consecutive numbers. Where neighbours have near numbers, edges that come one after another are then near
/// each other, also in memory.
///
/// It exists because costs change while edges are in the queue: each edge knows its place in the heap. Every
/// node of the heap has four children and holds its cost, so that a comparison reads no other memory.
///
/// **Complexity** O(log n) for each change, O(n) for `sort`.
template <class FT>
class Edge_queue
{
public:
  using Id = std::uint32_t;

  /// Makes an empty queue for edges numbered 0 … edges−1, of which there are less than 2^31.
  explicit Edge_queue(std::size_t edges, bool is_relaxed = false)
      : m_places(edges, s_nowhere), m_is_relaxed(is_relaxed)
  {
  }

  bool is_empty() const { return m_heap.empty(); }
  bool contains(Id edge) const { return m_places[edge] != s_nowhere; }

  /// Puts an edge that is not in the queue behind all others. Once edges were appended, `sort` must be called
  /// before any other function.
  void append(Id edge, const FT& cost) { m_heap.push_back(entry(edge, cost)); }
  void reserve(std::size_t edges) { m_heap.reserve(edges); }
  void sort()
  {
    for (std::size_t i = 0; i < m_heap.size(); ++i)
      m_places[m_heap[i].edge] = Id(i);
    for (std::size_t i = parent(m_heap.size()) + 1; i-- > 0 && !m_heap.empty();)
      sink(i, Entry(m_heap[i]));
  }

  /// Inserts an edge, or changes the cost of one that is in the queue.
  void set(Id edge, const FT& cost)
  {
    const Entry changed = entry(edge, cost);
    if (!contains(edge)) {
      m_heap.push_back(changed);
      rise(m_heap.size() - 1, changed);
    } else {
      replace(m_places[edge], changed);
    }
  }

  /// Removes an edge if it is in the queue.
  void erase(Id edge)
  {
    if (contains(edge))
      erase_at(m_places[edge]);
  }

  /// Removes the first edge and returns it with its cost. The queue must not be empty.
  std::pair<FT, Id> pop()
  {
    const Entry first = m_heap.front();
    erase_at(0);
    return {first.cost, first.edge};
  }

private:
  struct Entry
  {
    FT cost;
    Id edge;
    Id key; // class and tile, or 0

    friend bool operator<(const Entry& a, const Entry& b)
    {
      if (a.key != b.key)
        return a.key < b.key;
      return a.cost < b.cost || (a.cost == b.cost && a.edge < b.edge);
    }
  };

  Entry entry(Id edge, const FT& cost) const
  {
    constexpr int tile_bits = 17; // 2^31 edges in tiles of 2^14
    const Id key = m_is_relaxed ? class_of(CGAL::to_double(cost)) << tile_bits | edge >> 14 : 0;
    return {cost, edge, key};
  }

  // Returns the first bits of the representation of a number: its exponent, and four bits of the mantissa.
  static Id class_of(double cost)
  {
    std::uint64_t bits = 0;
    if (cost > 0)
      std::memcpy(&bits, &cost, sizeof bits);
    return Id(bits >> 48);
  }

  static constexpr Id s_nowhere = (std::numeric_limits<Id>::max)();
  static constexpr std::size_t s_children = 4;

  static std::size_t parent(std::size_t i) { return i == 0 ? 0 : (i - 1) / s_children; }

  void put(std::size_t i, const Entry& entry)
  {
    m_heap[i] = entry;
    m_places[entry.edge] = Id(i);
  }

  void erase_at(std::size_t i)
  {
    m_places[m_heap[i].edge] = s_nowhere;
    const Entry last = m_heap.back();
    m_heap.pop_back();
    if (i < m_heap.size())
      replace(i, last);
  }

  void replace(std::size_t i, const Entry& entry)
  {
    if (i > 0 && entry < m_heap[parent(i)])
      rise(i, entry);
    else
      sink(i, entry);
  }

  void rise(std::size_t i, const Entry& entry)
  {
    for (; i > 0 && entry < m_heap[parent(i)]; i = parent(i))
      put(i, m_heap[parent(i)]);
    put(i, entry);
  }

  void sink(std::size_t i, const Entry& entry)
  {
    for (;;) {
      const std::size_t first = s_children * i + 1;
      if (first >= m_heap.size())
        break;
      const std::size_t beyond = (std::min)(first + s_children, m_heap.size());
      std::size_t least = first;
      for (std::size_t child = first + 1; child < beyond; ++child)
        if (m_heap[child] < m_heap[least])
          least = child;
      if (!(m_heap[least] < entry))
        break;
      put(i, m_heap[least]);
      i = least;
    }
    put(i, entry);
  }

  std::vector<Entry> m_heap;
  std::vector<Id> m_places; // by edge
  bool m_is_relaxed;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_QUEUE_H
