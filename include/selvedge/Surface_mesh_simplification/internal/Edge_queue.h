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
#include <type_traits>
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

/// A cost as it is kept beside a small number: a number of the machine in parts of 16 bits, so that no room
/// is lost between them.
template <class FT, bool is_of_machine = std::is_arithmetic_v<FT>>
class Compact_cost
{
public:
  Compact_cost() = default;
  Compact_cost(const FT& cost) : m_cost(cost) {}
  const FT& get() const { return m_cost; }

private:
  FT m_cost;
};
template <class FT>
class Compact_cost<FT, true>
{
public:
  Compact_cost() = default;
  Compact_cost(FT cost) { std::memcpy(m_parts.data(), &cost, sizeof cost); }
  FT get() const
  {
    FT cost;
    std::memcpy(&cost, m_parts.data(), sizeof cost);
    return cost;
  }

private:
  std::array<std::uint16_t, sizeof(FT) / sizeof(std::uint16_t)> m_parts;
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
/// first edge is the winner of a tournament. An edge takes 12 bytes, with a cost of 8.
///
/// **Complexity** O(log n) for each change, O(n) for `sort`.
template <class FT>
class Edge_queue
{
public:
  using Id = std::uint32_t;

  /// Makes an empty queue for edges numbered 0 … edges−1, of which there are less than 2^31.
  explicit Edge_queue(std::size_t edges, bool is_relaxed = false)
      : m_is_relaxed(is_relaxed), m_entries(edges), m_places(edges, s_nowhere),
        m_sizes((edges >> s_tile_bits) + 1, 0)
  {
    while (m_leaves < m_sizes.size())
      m_leaves *= 2;
    m_keys.resize(2 * m_leaves);
  }

  bool is_empty() const { return m_keys[1].tile == s_no_tile; }

  /// Puts an edge that is not in the queue behind all others of its tile. Once edges were appended, `sort`
  /// must be called before any other function.
  void append(Id edge, const FT& cost)
  {
    Heap heap = heap_of(edge);
    heap.put(heap.size++, {cost, local(edge)});
  }
  void sort()
  {
    for (std::size_t tile = 0; tile < m_sizes.size(); ++tile) {
      Heap heap = heap_at(tile);
      for (Local i = parent(heap.size) + 1; i-- > 0 && heap.size > 0;)
        heap.sink(i, Entry(heap.entries[i]));
      update_key(tile);
    }
  }

  /// Inserts an edge, or changes the cost of one that is in the queue.
  void set(Id edge, const FT& cost)
  {
    Heap heap = heap_of(edge);
    const Local place_before = m_places[edge];
    if (place_before != s_nowhere)
      heap.replace(place_before, {cost, local(edge)});
    else
      heap.rise(heap.size++, {cost, local(edge)});
    if (place_before == 0 || m_places[edge] == 0)
      update_key(edge >> s_tile_bits);
  }

  /// Removes an edge if it is in the queue.
  void erase(Id edge)
  {
    const Local place = m_places[edge];
    if (place == s_nowhere)
      return;
    heap_of(edge).erase_at(place);
    if (place == 0)
      update_key(edge >> s_tile_bits);
  }

  /// Returns the cost of an edge that is in the queue.
  FT cost(Id edge) const
  {
    return m_entries[(edge >> s_tile_bits << s_tile_bits) + m_places[edge]].cost.get();
  }

  /// Whether no edge is left of the classes that have been merged.
  bool are_merged_classes_gone() const { return is_empty() || m_keys[1].rank > FT(int(m_merged_class)); }

  /// Makes one class of the classes of about the `count` cheapest edges, as a sample of the queue tells.
  /// Returns false, and does nothing, where these are less than 16 for each tile, where there is one tile
  /// only, or where the order is not relaxed. Call it when the merged classes are gone, and the queue is not
  /// empty.
  bool merge_classes(std::size_t count)
  {
    constexpr std::size_t least_per_tile = 16;
    if (!m_is_relaxed || m_sizes.size() == 1 || count < least_per_tile * m_sizes.size())
      return false;
    constexpr Local sampled = 8; // one entry of so many
    std::size_t edges = 0;
    std::vector<std::uint32_t> classes;
    for (std::size_t tile = 0; tile < m_sizes.size(); ++tile) {
      const Heap heap = heap_at(tile);
      edges += heap.size;
      for (Local i = 0; i < heap.size; i += sampled)
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
    const Id tile = edge >> s_tile_bits;
    const Entry entry{cost, local(edge)};
    const Key key = key_of(entry, tile);
    return key == m_keys[1] ? entry < first_of(tile) : key < m_keys[1];
  }

  /// Removes the first edge and returns it with its cost. The queue must not be empty.
  std::pair<FT, Id> pop()
  {
    const Id tile = m_keys[1].tile;
    Heap heap = heap_at(tile);
    const Entry first = heap.entries[0];
    heap.erase_at(0);
    update_key(tile);
    return {first.cost.get(), tile << s_tile_bits | first.edge};
  }

private:
  using Local = std::uint16_t; // the number of an edge in its tile, or of an entry in a heap

  struct Entry
  {
    Compact_cost<FT> cost;
    Local edge;

    friend bool operator<(const Entry& a, const Entry& b)
    {
      const FT &of_a = a.cost.get(), &of_b = b.cost.get();
      return of_a < of_b || (of_a == of_b && a.edge < b.edge);
    }
  };

  static constexpr Id s_no_tile = (std::numeric_limits<Id>::max)();
  static constexpr Local s_nowhere = (std::numeric_limits<Local>::max)();
  static constexpr Local s_children = 4;
  static constexpr int s_tile_bits = 13;

  // The order in which tiles come: by the cost of the first edge or, in relaxed order, by its class. Tiles
  // without edges come last.
  struct Key
  {
    FT rank = 0;
    Id tile = s_no_tile;

    friend bool operator<(const Key& a, const Key& b)
    {
      return b.tile == s_no_tile || a.tile == s_no_tile
                 ? a.tile < b.tile
                 : a.rank < b.rank || (a.rank == b.rank && a.tile < b.tile);
    }
    friend bool operator==(const Key& a, const Key& b) { return a.tile == b.tile && a.rank == b.rank; }
  };

  static std::uint32_t class_of(const Entry& entry)
  {
    return class_of_cost(CGAL::to_double(entry.cost.get()));
  }

  static Local local(Id edge) { return Local(edge & ((Id(1) << s_tile_bits) - 1)); }

  static Local parent(Local i) { return i == 0 ? 0 : Local((i - 1) / s_children); }

  // The edges of a tile that are in the queue.
  struct Heap
  {
    Entry* entries;
    Local& size;
    Local* places;

    void put(Local i, const Entry& entry)
    {
      entries[i] = entry;
      places[entry.edge] = i;
    }

    void erase_at(Local i)
    {
      places[entries[i].edge] = s_nowhere;
      const Entry last = entries[--size];
      if (i < size)
        replace(i, last);
    }

    void replace(Local i, const Entry& entry)
    {
      if (i > 0 && entry < entries[parent(i)])
        rise(i, entry);
      else
        sink(i, entry);
    }

    void rise(Local i, const Entry& entry)
    {
      for (; i > 0 && entry < entries[parent(i)]; i = parent(i))
        put(i, entries[parent(i)]);
      put(i, entry);
    }

    void sink(Local i, const Entry& entry)
    {
      for (;;) {
        const Local first = Local(s_children * i + 1);
        if (first >= size)
          break;
        const Local beyond = (std::min)(Local(first + s_children), size);
        Local least = first;
        for (Local child = Local(first + 1); child < beyond; ++child)
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
    return {m_entries.data() + (tile << s_tile_bits), m_sizes[tile], m_places.data() + (tile << s_tile_bits)};
  }
  Heap heap_of(Id edge) { return heap_at(edge >> s_tile_bits); }
  const Entry& first_of(std::size_t tile) const { return m_entries[tile << s_tile_bits]; }

  Key key_of(const Entry& first, Id tile) const
  {
    return {m_is_relaxed ? FT(int((std::max)(m_merged_class, class_of(first)))) : first.cost.get(), tile};
  }

  // Tells the tournament what the first edge of a tile is now.
  void update_key(std::size_t tile)
  {
    Key key = m_sizes[tile] > 0 ? key_of(first_of(tile), Id(tile)) : Key();
    std::size_t node = m_leaves + tile;
    while (!(m_keys[node] == key)) {
      m_keys[node] = key;
      if (node == 1)
        break;
      node /= 2;
      key = (std::min)(m_keys[2 * node], m_keys[2 * node + 1]);
    }
  }

  bool m_is_relaxed;
  std::uint32_t m_merged_class = 0; // the classes up to this one are one
  std::vector<Entry> m_entries;     // the heap of each tile at the number of its first edge
  std::vector<Local> m_places;      // in the heap, by edge
  std::vector<Local> m_sizes;       // of the heaps, by tile
  // The tournament. The tiles follow each other from `m_leaves` on, which is a power of two; the winner of
  // nodes 2i and 2i + 1 is at i.
  std::vector<Key> m_keys;
  std::size_t m_leaves = 1;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_QUEUE_H
