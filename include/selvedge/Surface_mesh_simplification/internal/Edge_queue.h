// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_QUEUE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_QUEUE_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace selvedge {
namespace internal {

/// A priority queue of numbered edges by (cost, number): the cheapest edge comes first, and of equally cheap
/// ones that with the lowest number, so that the order depends on the costs alone.
///
/// It exists because costs change while edges are in the queue: each edge knows its place in the heap. Every
/// node of the heap has four children and holds its cost, so that a comparison reads no other memory.
///
/// **Complexity** O(log n) for each change, O(n) for `push_all`.
template <class FT>
class Edge_queue
{
public:
  using Id = std::uint32_t;

  struct Entry
  {
    FT cost;
    Id edge;

    friend bool operator<(const Entry& a, const Entry& b)
    {
      return a.cost < b.cost || (a.cost == b.cost && a.edge < b.edge);
    }
  };

  /// Makes an empty queue for edges numbered 0 … edges−1.
  explicit Edge_queue(std::size_t edges) : m_places(edges, s_nowhere) {}

  bool is_empty() const { return m_heap.empty(); }
  bool contains(Id edge) const { return m_places[edge] != s_nowhere; }

  /// Inserts many edges that are not in the queue.
  void push_all(std::vector<Entry> entries)
  {
    entries.insert(entries.end(), m_heap.begin(), m_heap.end());
    m_heap.swap(entries);
    for (std::size_t i = 0; i < m_heap.size(); ++i)
      m_places[m_heap[i].edge] = Id(i);
    for (std::size_t i = parent(m_heap.size()) + 1; i-- > 0 && !m_heap.empty();)
      sink(i, Entry(m_heap[i]));
  }

  /// Inserts an edge, or changes the cost of one that is in the queue.
  void set(Id edge, const FT& cost)
  {
    if (!contains(edge)) {
      m_heap.push_back({cost, edge});
      rise(m_heap.size() - 1, {cost, edge});
    } else {
      replace(m_places[edge], {cost, edge});
    }
  }

  /// Removes an edge if it is in the queue.
  void erase(Id edge)
  {
    if (contains(edge))
      erase_at(m_places[edge]);
  }

  /// Removes the first edge and returns it. The queue must not be empty.
  Entry pop()
  {
    const Entry first = m_heap.front();
    erase_at(0);
    return first;
  }

private:
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
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_QUEUE_H
