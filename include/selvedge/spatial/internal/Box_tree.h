// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_INTERNAL_BOX_TREE_H
#define SELVEDGE_SPATIAL_INTERNAL_BOX_TREE_H

#include <selvedge/spatial/internal/Monotone_box.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// The box and the place of each number in a `Box_tree`. The owner of the trees holds it, one table for many
/// trees.
struct Box_table
{
  enum class Place : unsigned char { nowhere, in_tree, in_overflow };

  std::vector<Monotone_box> boxes;
  std::vector<Place> places;

  void resize(std::size_t size)
  {
    boxes.resize(size, Monotone_box::empty());
    places.resize(size, Place::nowhere);
  }
};

/// A primitive that consists of a number only. Its box is in the table.
class Box_primitive
{
public:
  using Id = std::uint32_t;
  using Datum = Monotone_box;
  using Datum_reference = const Monotone_box&;
  using Point = CGAL::Simple_cartesian<double>::Point_3;

  explicit Box_primitive(std::vector<Id>::const_iterator it) : m_id(*it) {}
  Id id() const { return m_id; }

private:
  Id m_id;
};

/// Traits of `AABB_tree` for boxes in a table: as much of the concept `AABBTraits` as building and traversing
/// a tree takes. The base classes are what `AABB_tree` names for a search tree, which is never made here: a
/// kernel up to CGAL 5.6, search traits from 6.0. No predicate is asked, so the kernel is the one that takes
/// the least time to parse.
class Box_tree_traits : public CGAL::Simple_cartesian<double>,
                        public CGAL::Search_traits_3<CGAL::Simple_cartesian<double>>
{
public:
  using FT = CGAL::Simple_cartesian<double>::FT; // which both bases name
  using Primitive = Box_primitive;
  using Bounding_box = Monotone_box;
  using size_type = std::size_t;
  using Object_and_primitive_id = std::pair<int, Primitive::Id>; // named by AABB_tree, never made
  using Point_3 = Primitive::Point;                              // named by AABB_tree of CGAL 5
  using Point = Point_3;                                         // named by AABB_tree of CGAL 6
  using Point_and_primitive_id = std::pair<Point, Primitive::Id>;

  explicit Box_tree_traits(const Box_table* table = nullptr) : m_table(table) {}

  struct Compute_bbox
  {
    const Box_table* table;
    template <class PrimitiveIterator>
    Bounding_box operator()(PrimitiveIterator first, PrimitiveIterator beyond) const
    {
      Bounding_box box = Bounding_box::empty();
      for (; first != beyond; ++first)
        box += table->boxes[first->id()];
      return box;
    }
  };

  struct Split_primitives
  {
    const Box_table* table;
    template <class PrimitiveIterator>
    void operator()(PrimitiveIterator first, PrimitiveIterator beyond, const Bounding_box& box) const
    {
      const std::size_t axis = box.longest_axis();
      // Equal centres are ordered by number, so that the tree is the same on every platform.
      std::nth_element(first, first + (beyond - first) / 2, beyond, [&](const auto& a, const auto& b) {
        return std::make_pair(table->boxes[a.id()].centre(axis), a.id()) <
               std::make_pair(table->boxes[b.id()].centre(axis), b.id());
      });
    }
  };

  Compute_bbox compute_bbox_object() const { return {m_table}; }
  Split_primitives split_primitives_object() const { return {m_table}; }
  void set_shared_data() {}

private:
  const Box_table* m_table;
};

/// A set of numbered boxes that may change, in a `CGAL::AABB_tree`. The tree can neither remove nor refit. So
/// a box that outgrows the one with which it was put in moves to a list that queries scan linearly, and a
/// removed one is skipped. When the list is long, or many are removed, the tree is made anew.
class Box_tree
{
public:
  using Id = Box_primitive::Id;

  explicit Box_tree(const Box_table* table) : m_tree(Box_tree_traits(table)) {}

  /// Replaces the content by `ids`, all of which become `in_tree`. The table already has their boxes.
  void build(const std::vector<Id>& ids, Box_table& table)
  {
    m_overflow.clear();
    m_size = ids.size();
    m_box = Monotone_box::empty();
    for (const Id id : ids) {
      table.places[id] = Box_table::Place::in_tree;
      m_box += table.boxes[id];
    }
    m_tree.rebuild(ids.begin(), ids.end());
    if (!ids.empty())
      m_tree.build();
  }

  /// Sets the box of a number, which is or becomes a member. Returns whether this made the tree anew.
  bool set(Id id, const Monotone_box& box, Box_table& table)
  {
    Box_table::Place& place = table.places[id];
    // A query that overlaps the new box also overlaps the stored one, which contains it.
    if (place == Box_table::Place::in_tree && table.boxes[id].contains(box))
      return false;
    m_size += place == Box_table::Place::nowhere;
    if (place != Box_table::Place::in_overflow)
      m_overflow.push_back(id);
    place = Box_table::Place::in_overflow;
    table.boxes[id] = box;
    m_box += box;
    return rebuild_if_stale(table);
  }

  /// Removes a member. Returns whether this made the tree anew.
  bool remove(Id id, Box_table& table)
  {
    if (table.places[id] == Box_table::Place::in_overflow) {
      *std::find(m_overflow.begin(), m_overflow.end(), id) = m_overflow.back();
      m_overflow.pop_back();
    }
    table.places[id] = Box_table::Place::nowhere;
    --m_size;
    return rebuild_if_stale(table);
  }

  /// Calls `visit(id)` once for every member whose box overlaps `query`.
  template <class Visitor>
  void visit_overlapping(const Monotone_box& query, const Box_table& table, Visitor&& visit) const
  {
    Traversal<Visitor> traversal{table, visit};
    if (m_tree.size() > 1 && query.overlaps(m_tree.root_node()->bbox()))
      m_tree.root_node()->traversal(query, traversal, m_tree.size());
    else if (m_tree.size() == 1)
      m_tree.traversal(query, traversal);
    for (const Id id : m_overflow)
      if (query.overlaps(table.boxes[id]))
        visit(id);
  }

  /// A box that contains those of all members. It shrinks only when the tree is made anew.
  const Monotone_box& box() const { return m_box; }
  std::size_t size() const { return m_size; }

private:
  using Tree = CGAL::AABB_tree<Box_tree_traits>;

  // A tree is stale when half of its members are in the list, or when half of its leaves are no members.
  bool rebuild_if_stale(Box_table& table)
  {
    constexpr std::size_t least = 16;
    if (m_overflow.size() <= least + m_size / 2 && m_tree.size() <= least + 2 * m_size)
      return false;
    build(members(table), table);
    return true;
  }

  template <class Visitor>
  struct Traversal
  {
    const Box_table& table;
    Visitor& visit;

    bool go_further() const { return true; }
    template <class Node>
    bool do_intersect(const Monotone_box& query, const Node& node) const
    {
      return query.overlaps(node.bbox());
    }
    void intersection(const Monotone_box& query, const Box_primitive& primitive) const
    {
      const Id id = primitive.id();
      if (table.places[id] == Box_table::Place::in_tree && query.overlaps(table.boxes[id]))
        visit(id);
    }
  };

  std::vector<Id> members(const Box_table& table) const
  {
    std::vector<Id> ids = m_overflow;
    const auto collect = [&](Id id) { ids.push_back(id); };
    if (m_tree.size() > 0) {
      Traversal<decltype(collect)> traversal{table, collect};
      m_tree.traversal(everything(), traversal);
    }
    return ids;
  }

  static Monotone_box everything()
  {
    const Monotone_box nothing = Monotone_box::empty();
    return {nothing.upper, nothing.lower};
  }

  Tree m_tree;
  std::vector<Id> m_overflow;
  Monotone_box m_box = Monotone_box::empty();
  std::size_t m_size = 0;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SPATIAL_INTERNAL_BOX_TREE_H
