// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_QUEUE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_QUEUE_H

#include <CGAL/number_type_basic.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Returns the class of a cost that is not NaN. There are eight classes from each power of two to the next;
/// costs that are not positive are one class. It is the first bits of the representation of the number: its
/// exponent, and three bits of the mantissa.
inline std::uint32_t class_of_cost(double cost)
{
  std::uint64_t bits = 0;
  if (cost > 0)
    std::memcpy(&bits, &cost, sizeof bits);
  return std::uint32_t(bits >> 49);
}

/// A cost as it is kept beside the number of an edge: a `double` in two halves, so that both take 12 bytes
/// and not 16.
template <class FT>
class Compact_cost
{
public:
  Compact_cost() = default;
  Compact_cost(const FT& cost) : m_cost(cost) {}
  const FT& get() const { return m_cost; }

private:
  FT m_cost;
};
template <>
class Compact_cost<double>
{
public:
  Compact_cost() = default;
  Compact_cost(double cost) { std::memcpy(m_halves.data(), &cost, sizeof cost); }
  double get() const
  {
    double cost;
    std::memcpy(&cost, m_halves.data(), sizeof cost);
    return cost;
  }

private:
  std::array<std::uint32_t, 2> m_halves;
};

/// A priority queue of numbered edges by (cost, number): the cheapest edge comes first, and of equally cheap
/// ones that with the lowest number, so that the order depends on the costs alone.
///
/// In relaxed order, edges come by (class, tile, cost, number), with the classes of `class_of_cost`. A tile
/// is 8,192 edges with consecutive numbers. Where neighbours have near numbers, edges that come one after
/// another are then near each other, also in memory. `merge_classes` makes one class of the cheapest edges,
/// so that more of a tile come one after another.
///
/// It exists because costs change while edges are in the queue: each edge knows its place in the heap of its
/// tile. Every node of a heap has four children and holds its cost, so that a comparison reads no other
/// memory. A change reads and writes one heap, which is as near in memory as its edges are. The tile of the
/// first edge is the winner of a tournament. Without relaxed order, all edges are one tile.
///
/// **Complexity** O(log n) for each change, O(n) for `sort`.
template <class FT>
class Edge_queue
{
public:
  using Id = std::uint32_t;

  /// Makes an empty queue for edges numbered 0 … edges−1, of which there are less than 2^31.
  explicit Edge_queue(std::size_t edges, bool is_relaxed = false)
      : m_tile_bits(is_relaxed ? s_tile_bits : 31), m_entries(edges), m_places(edges, s_nowhere),
        m_sizes((edges >> m_tile_bits) + 1, 0)
  {
    while (m_leaves < m_sizes.size())
      m_leaves *= 2;
    m_keys.assign(2 * m_leaves, s_nowhere);
  }

  bool is_empty() const { return m_keys[1] == s_nowhere; }

  /// Puts an edge that is not in the queue behind all others of its tile. Once edges were appended, `sort`
  /// must be called before any other function.
  void append(Id edge, const FT& cost)
  {
    Heap heap = heap_of(edge);
    heap.put(heap.size++, {cost, edge});
  }
  void sort()
  {
    for (std::size_t tile = 0; tile < m_sizes.size(); ++tile) {
      Heap heap = heap_at(tile);
      for (Id i = parent(heap.size) + 1; i-- > 0 && heap.size > 0;)
        heap.sink(i, Entry(heap.entries[i]));
      update_key(tile);
    }
  }

  /// Inserts an edge, or changes the cost of one that is in the queue.
  void set(Id edge, const FT& cost)
  {
    Heap heap = heap_of(edge);
    const Id place_before = m_places[edge];
    if (place_before != s_nowhere)
      heap.replace(place_before, {cost, edge});
    else
      heap.rise(heap.size++, {cost, edge});
    if (place_before == 0 || m_places[edge] == 0)
      update_key(edge >> m_tile_bits);
  }

  /// Removes an edge if it is in the queue.
  void erase(Id edge)
  {
    const Id place = m_places[edge];
    if (place == s_nowhere)
      return;
    heap_of(edge).erase_at(place);
    if (place == 0)
      update_key(edge >> m_tile_bits);
  }

  /// Whether no edge is left of the classes that have been merged.
  bool are_merged_classes_gone() const { return m_keys[1] >> s_bits_of_tiles > m_merged_class; }

  /// Makes one class of the classes of about the `count` cheapest edges, as a sample of the queue tells.
  /// Returns false, and does nothing, where these are less than 16 for each tile, or where there is one tile
  /// only. Call it when the merged classes are gone, and the queue is not empty.
  bool merge_classes(std::size_t count)
  {
    constexpr std::size_t least_per_tile = 16;
    if (m_sizes.size() == 1 || count < least_per_tile * m_sizes.size())
      return false;
    constexpr Id sampled = 8; // one entry of so many
    std::size_t edges = 0;
    std::vector<Id> classes;
    for (std::size_t tile = 0; tile < m_sizes.size(); ++tile) {
      const Heap heap = heap_at(tile);
      edges += heap.size;
      for (Id i = 0; i < heap.size; i += sampled)
        classes.push_back(class_of(heap.entries[i]));
    }
    const std::size_t rank =
        (std::min)(classes.size() - 1, std::size_t(double(count) * double(classes.size()) / double(edges)));
    const auto last = classes.begin() + std::ptrdiff_t(rank);
    std::nth_element(classes.begin(), last, classes.end());
    m_merged_class = *last;
    for (std::size_t tile = 0; tile < m_sizes.size(); ++tile)
      update_key(tile);
    return true;
  }

  /// Whether an edge that is not in the queue would be its first with this cost.
  bool would_be_first(Id edge, const FT& cost) const
  {
    const Id tile = edge >> m_tile_bits;
    const Entry entry{cost, edge};
    const Id key = key_of(entry, tile);
    return key == m_keys[1] ? entry < m_entries[tile << m_tile_bits] : key < m_keys[1];
  }

  /// Removes the first edge and returns it with its cost. The queue must not be empty.
  std::pair<FT, Id> pop()
  {
    const std::size_t tile = m_keys[1] & ((Id(1) << s_bits_of_tiles) - 1);
    Heap heap = heap_at(tile);
    const Entry first = heap.entries[0];
    heap.erase_at(0);
    update_key(tile);
    return {first.cost.get(), first.edge};
  }

private:
  struct Entry
  {
    Compact_cost<FT> cost;
    Id edge;

    friend bool operator<(const Entry& a, const Entry& b)
    {
      const FT &of_a = a.cost.get(), &of_b = b.cost.get();
      return of_a < of_b || (of_a == of_b && a.edge < b.edge);
    }
  };

  static constexpr Id s_nowhere = (std::numeric_limits<Id>::max)();
  static constexpr Id s_children = 4;
  static constexpr int s_tile_bits = 13;
  static constexpr int s_bits_of_tiles = 31 - s_tile_bits;

  static Id class_of(const Entry& entry) { return class_of_cost(CGAL::to_double(entry.cost.get())); }

  static Id parent(Id i) { return i == 0 ? 0 : (i - 1) / s_children; }

  // The edges of a tile that are in the queue.
  struct Heap
  {
    Entry* entries;
    Id& size;
    std::vector<Id>& places;

    void put(Id i, const Entry& entry)
    {
      entries[i] = entry;
      places[entry.edge] = i;
    }

    void erase_at(Id i)
    {
      places[entries[i].edge] = s_nowhere;
      const Entry last = entries[--size];
      if (i < size)
        replace(i, last);
    }

    void replace(Id i, const Entry& entry)
    {
      if (i > 0 && entry < entries[parent(i)])
        rise(i, entry);
      else
        sink(i, entry);
    }

    void rise(Id i, const Entry& entry)
    {
      for (; i > 0 && entry < entries[parent(i)]; i = parent(i))
        put(i, entries[parent(i)]);
      put(i, entry);
    }

    void sink(Id i, const Entry& entry)
    {
      for (;;) {
        const Id first = s_children * i + 1;
        if (first >= size)
          break;
        const Id beyond = (std::min)(first + s_children, size);
        Id least = first;
        for (Id child = first + 1; child < beyond; ++child)
          if (entries[child] < entries[least])
            least = child;
        if (!(entries[least] < entry))
          break;
        put(i, entries[least]);
        i = least;
      }
      put(i, entry);
    }
  };

  Heap heap_at(std::size_t tile)
  {
    return {m_entries.data() + (tile << m_tile_bits), m_sizes[tile], m_places};
  }
  Heap heap_of(Id edge) { return heap_at(edge >> m_tile_bits); }

  // Returns the class of an edge, or the merged one, and the tile: the order in which tiles come.
  Id key_of(const Entry& first, Id tile) const
  {
    return (std::max)(m_merged_class, class_of(first)) << s_bits_of_tiles | tile;
  }

  // Tells the tournament which class the first edge of a tile has now.
  void update_key(std::size_t tile)
  {
    Id key = m_sizes[tile] > 0 ? key_of(m_entries[tile << m_tile_bits], Id(tile)) : s_nowhere;
    std::size_t node = m_leaves + tile;
    while (m_keys[node] != key) {
      m_keys[node] = key;
      if (node == 1)
        break;
      node /= 2;
      key = (std::min)(m_keys[2 * node], m_keys[2 * node + 1]);
    }
  }

  int m_tile_bits;
  Id m_merged_class = 0;        // the classes up to this one are one
  std::vector<Entry> m_entries; // the heap of each tile at the number of its first edge
  std::vector<Id> m_places;     // in the heap, by edge
  std::vector<Id> m_sizes;      // of the heaps, by tile
  // The tournament: the class of the first edge of a tile, and the tile. The tiles follow each other from
  // `m_leaves` on, which is a power of two; the winner of nodes 2i and 2i + 1 is at i.
  std::vector<Id> m_keys;
  std::size_t m_leaves = 1;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_QUEUE_H
