// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_PACKED_R_TREE_H
#define SELVEDGE_SPATIAL_PACKED_R_TREE_H

#include <selvedge/internal/Vector_of_doubles.h>
#include <selvedge/internal/instructions.h>
#include <selvedge/spatial/Index_statistics.h>
#include <selvedge/spatial/internal/Box_block.h>
#include <selvedge/spatial/internal/Framed_box_block.h>
#include <selvedge/spatial/internal/Monotone_box.h>
#include <selvedge/spatial/internal/Rod_block.h>
#include <selvedge/spatial/internal/order_along_curve.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace selvedge {

/// Finds the faces whose bounding boxes overlap a box, while faces are added, changed and removed. It is
/// faster and smaller than `Clustered_AABB_tree`.
///
/// Faces are stored in the order of a Hilbert curve through the centres of their boxes. Sixteen consecutive
/// faces make a leaf, sixteen leaves make a node, and so on up to a single node. All boxes of a leaf or node
/// are tested at once, with vector instructions, and its place in memory follows from its number. A face
/// keeps its slot while it changes, and the boxes above grow with it. Faces that are added later go behind
/// all others, into new leaves when the last one is full. New leaves are not in the tree, and a query tests
/// each of them.
///
/// The tree is made anew when more than a third of the slots are empty, and when there are more new leaves
/// than 8 and an eighth of those in the tree. Faces then keep their order, unless there are new leaves: then
/// all are sorted along the curve again.
///
/// A box says little about a sliver askew to the axes: those of all threads of a fringe meet. When the index
/// is told the corners of faces, and many are such slivers, it also encloses each face and node in a *rod*,
/// the points within a radius of a segment. A query that is long and thin itself passes by the rods that are
/// proved apart from it.
///
/// **Guarantees**
/// 1. A query visits every face whose box overlaps the query box, each exactly once. It may visit others. A
///    query for the hull of some points may leave out faces that have no point in common with it.
/// 2. The order of visits depends on the sequence of calls alone, not on addresses or on the platform.
///
/// **Preconditions** Boxes are finite and not empty. The caller numbers the faces 0 … n−1. The index knows
/// nothing of a face but its number and its box. It stores boxes and never computes one again, so a face that
/// is gone from the mesh is not read.
///
/// **Exactness** Boxes are stored as floats, and those of faces as numbers of 16 bits in a frame of their
/// leaf, through monotone maps that can only add overlaps. Rods are floats with bounds on rounding: they
/// leave out only what is proved apart.
///
/// **Complexity** Building is O(n). A query is logarithmic in n for each face that it finds, when boxes
/// overlap as those of faces of a surface do. A change is O(log n), and amortised O(1) as a rule. The index
/// takes about 24 bytes per face, and as many more while it is built; with rods, 64 bytes more.
///
/// **Reference** Kamel, Faloutsos: On packing R-trees.
class Packed_R_tree
{
public:
  using Id = std::uint32_t;
  using Corners = std::array<internal::Vector_of_doubles, 3>;

  /// Replaces the content by `faces`. The box of face `faces[i]` is `box_of(faces[i])`, a `CGAL::Bbox_3`.
  template <class BoxOf>
  void build(const std::vector<Id>& faces, const BoxOf& box_of)
  {
    CGAL::Bbox_3 sample;
    for (std::size_t i = 0; i < faces.size(); i += 1 + faces.size() / 1000)
      sample += box_of(faces[i]);
    m_map = internal::Monotone_box_map(sample);
    m_slots.clear();
    m_rods.clear();
    m_rod_of_face.clear();
    m_sliver_balance = 0;
    m_rod_extent = 0;
    // Boxes are computed again and again, since to keep them all for a moment takes longer than that.
    const auto entry_at = [&](std::size_t i) { return Entry{m_map(box_of(faces[i])), faces[i]}; };
    fill(faces.size(), entry_at);
    if (!are_neighbours_together())
      fill_along_curve(faces.size(), entry_at);
  }

  /// Likewise, and says of any of these faces what its corners are: `corners_of(faces[i])`.
  template <class BoxOf, class Corners_of>
  void build(const std::vector<Id>& faces, const BoxOf& box_of, const Corners_of& corners_of)
  {
    build(faces, box_of);
    for (const Id face : faces)
      count_sliver(corners_of(face));
    if (are_rods_due())
      note_all_rods(corners_of);
  }

  /// Adds a face, or gives another box to a face that is in the index. No rod leaves it out from now on.
  void set(Id face, const CGAL::Bbox_3& box)
  {
    if (!m_rods.empty())
      note_rod(face, {});
    set_box(face, box);
    if (!m_rods.empty())
      put_rod(face);
  }

  /// Likewise, and says of any face that is then in the index what its corners are: `corners_of(face)`.
  template <class Corners_of>
  void set(Id face, const CGAL::Bbox_3& box, const Corners_of& corners_of)
  {
    const Corners corners = corners_of(face);
    if (!m_rods.empty())
      note_rod(face, rod_around(corners));
    set_box(face, box);
    if (!m_rods.empty()) {
      put_rod(face);
    } else {
      count_sliver(corners);
      if (are_rods_due())
        note_all_rods(corners_of);
    }
  }

  /// Removes a face. **Precondition** It is in the index.
  void remove(Id face)
  {
    const Slot slot = m_slots[face];
    Leaf& leaf = m_leaves[slot / s_width];
    leaf.boxes.set_empty(slot % s_width);
    leaf.faces[slot % s_width] = s_none;
    --m_size;
    if (3 * m_size < 2 * m_slot_count)
      rebuild();
  }

  /// Calls `visit(face)` for every face whose box overlaps `box`, and perhaps for some more.
  template <class Visitor>
  void visit_overlapping(const CGAL::Bbox_3& box, Visitor&& visit) const
  {
    visit_all_near({m_map(box), nullptr}, visit);
  }

  /// Likewise for the hull of some points that lie in the box. It may leave out faces that do not meet it.
  /// Each point has its coordinates at [0], [1] and [2].
  template <class Points, class Visitor>
  void visit_overlapping(const CGAL::Bbox_3& box, const Points& points, Visitor&& visit) const
  {
    if (m_rods.empty())
      return visit_overlapping(box, visit);
    m_query_points.clear();
    for (const auto& point : points)
      m_query_points.push_back(from_origin(point));
    const internal::Beam beam(m_query_points, m_rod_extent);
    visit_all_near({m_map(box), beam.is_usable() ? &beam : nullptr}, visit);
  }

  /// Returns whether `is_wanted(face)` holds for one of the faces whose boxes overlap `box`, and perhaps of
  /// some more. It asks none after the first for which it does.
  template <class Is_wanted>
  bool has_overlapping(const CGAL::Bbox_3& box, const Is_wanted& is_wanted) const
  {
    return visit_near({m_map(box), nullptr}, is_wanted);
  }

  /// Counts since construction, for reports.
  const Index_statistics& statistics() const { return m_statistics; }

private:
  using Slot = std::uint32_t;
  using Box_block = internal::Box_block;
  using Framed_box_block = internal::Framed_box_block;
  using Mask = Box_block::Mask;
  static constexpr std::size_t s_width = Box_block::width;
  static constexpr Id s_none = Id(-1);

  struct Leaf
  {
    Framed_box_block boxes;
    std::array<Id, s_width> faces;

    Leaf() { faces.fill(s_none); }
  };

  struct Entry
  {
    internal::Monotone_box box;
    Id face;
  };

  void rebuild()
  {
    ++m_statistics.top_rebuilds;
    std::fill(m_slots.begin(), m_slots.end(), s_none);
    if (m_leaves.size() == m_leaves_in_tree)
      return compact();
    std::vector<Entry> content;
    content.reserve(m_size);
    for (const Leaf& leaf : m_leaves)
      for (std::size_t i = 0; i < s_width; ++i)
        if (leaf.faces[i] != s_none)
          content.push_back({leaf.boxes[i], leaf.faces[i]});
    fill_along_curve(content.size(), [&](std::size_t i) { return content[i]; });
  }

  // Closes the gaps between entries, which keep their order.
  void compact()
  {
    fill_leaves([&](const auto& add) {
      for (std::size_t number = 0; number < m_leaves.size(); ++number) {
        const Leaf leaf = m_leaves[number]; // its entries may go into the same leaf, or into earlier ones
        for (std::size_t i = 0; i < s_width; ++i)
          if (leaf.faces[i] != s_none)
            add({leaf.boxes[i], leaf.faces[i]});
      }
    });
  }

  // Whether the entries came in an order that is about as good as that along a curve: in which no blocks are
  // much larger than those in them. Along a Hilbert curve, the boxes of blocks of 16 on a surface extend 3 to
  // 5 times as far, as a mean over a level.
  bool are_neighbours_together() const
  {
    if (m_size == 0)
      return true;
    constexpr double most = 5.5;
    double below = 0; // the mean over a level
    for (const Leaf& leaf : m_leaves)
      below += extent_of_members(leaf.boxes);
    below /= double(m_size);
    std::size_t count = m_leaves.size();
    for (const std::vector<Box_block>& level : m_levels) { // which has the boxes of the blocks below it
      double mean = 0;
      for (const Box_block& block : level)
        mean += extent_of_members(block);
      mean /= double(count);
      if (below * most < mean)
        return false;
      below = mean;
      count = level.size();
    }
    return !(below * most < extent(bounding_box(m_levels.back().front())));
  }

  static double extent(const internal::Monotone_box& box)
  {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3 && !box.is_empty(); ++axis)
      sum += double(box.upper[axis]) - double(box.lower[axis]);
    return sum;
  }
  template <class Block>
  static double extent_of_members(const Block& boxes)
  {
    double sum = 0;
    for (std::size_t i = 0; i < s_width; ++i)
      sum += extent(boxes[i]);
    return sum;
  }

  template <class Entry_at>
  void fill_along_curve(std::size_t size, const Entry_at& entry_at)
  {
    const std::vector<std::uint32_t> order = internal::order_along_curve(size, [&](std::size_t i) {
      const internal::Monotone_box box = entry_at(i).box;
      std::array<double, 3> centre;
      for (std::size_t axis = 0; axis < 3; ++axis)
        centre[axis] = 0.5 * box.lower[axis] + 0.5 * box.upper[axis];
      return centre;
    });
    fill(size, [&](std::size_t i) { return entry_at(order[i]); });
  }

  // Puts entries into new leaves, in their order.
  template <class Entry_at>
  void fill(std::size_t size, const Entry_at& entry_at)
  {
    m_leaves.clear();
    m_leaves.reserve((size + s_width - 1) / s_width);
    fill_leaves([&](const auto& add) {
      for (std::size_t i = 0; i < size; ++i)
        add(entry_at(i));
    });
  }

  // Puts entries into the leaves from the first one on, each when it is full, in the order in which
  // `add_all(add)` calls add(entry).
  template <class Add_all>
  void fill_leaves(const Add_all& add_all)
  {
    m_slot_count = 0;
    Leaf leaf;
    Framed_box_block::Boxes boxes;
    boxes.fill(internal::Monotone_box::empty());
    const auto store = [&](std::size_t number) {
      leaf.boxes = Framed_box_block(boxes);
      if (number == m_leaves.size())
        m_leaves.emplace_back();
      m_leaves[number] = leaf;
      leaf = Leaf();
      boxes.fill(internal::Monotone_box::empty());
    };
    add_all([&](const Entry& entry) {
      if (entry.face >= m_slots.size())
        m_slots.resize(entry.face + std::size_t(1), s_none);
      boxes[m_slot_count % s_width] = entry.box;
      leaf.faces[m_slot_count % s_width] = entry.face;
      m_slots[entry.face] = m_slot_count++;
      if (m_slot_count % s_width == 0)
        store(m_slot_count / s_width - 1);
    });
    if (m_slot_count % s_width != 0)
      store(m_slot_count / s_width);
    m_leaves.resize((m_slot_count + s_width - 1) / s_width);
    m_size = m_slot_count;
    make_nodes();
  }

  // Makes the nodes above the leaves.
  void make_nodes()
  {
    m_leaves_in_tree = m_leaves.size();
    const auto bounding_boxes = [](const auto& blocks, const auto& block_of) {
      std::vector<internal::Monotone_box> boxes;
      boxes.reserve(blocks.size());
      for (const auto& block : blocks)
        boxes.push_back(bounding_box(block_of(block)));
      return boxes;
    };
    auto boxes = bounding_boxes(m_leaves, [](const Leaf& leaf) { return leaf.boxes; });
    m_levels.clear();
    do {
      std::vector<Box_block> level((boxes.size() + s_width - 1) / s_width);
      for (std::size_t i = 0; i < boxes.size(); ++i)
        level[i / s_width].set(i % s_width, boxes[i]);
      boxes = bounding_boxes(level, [](const Box_block& block) { return block; });
      m_levels.push_back(std::move(level));
    } while (boxes.size() > 1);
    m_statistics.clusters = m_leaves.size();
    if (!m_rods.empty())
      make_rods();
  }

  void set_box(Id face, const CGAL::Bbox_3& box)
  {
    const internal::Monotone_box mapped = m_map(box);
    if (face >= m_slots.size())
      m_slots.resize(face + std::size_t(1), s_none);
    Slot& slot = m_slots[face];
    const bool is_new = slot == s_none; // not one that was removed: that gets its slot again
    if (is_new)
      slot = new_slot();
    Leaf& leaf = m_leaves[slot / s_width];
    m_size += leaf.faces[slot % s_width] == s_none;
    leaf.faces[slot % s_width] = face;
    leaf.boxes.set(slot % s_width, mapped);
    grow(slot / s_width, mapped);
    constexpr std::size_t least = 8;
    if (is_new && m_leaves.size() - m_leaves_in_tree > least + m_leaves_in_tree / 8)
      rebuild();
  }

  Slot new_slot()
  {
    if (m_slot_count == s_width * m_leaves.size())
      m_leaves.emplace_back();
    return m_slot_count++;
  }

  // Enlarges the boxes above a leaf so that they contain `box`, up to the first that already does.
  void grow(std::size_t leaf, const internal::Monotone_box& box)
  {
    if (leaf >= m_leaves_in_tree)
      return;
    std::size_t child = leaf;
    for (std::vector<Box_block>& level : m_levels) {
      Box_block& node = level[child / s_width];
      internal::Monotone_box bounds = node[child % s_width];
      if (bounds.contains(box))
        return;
      node.set(child % s_width, bounds += box);
      child /= s_width;
    }
  }

  struct Query
  {
    internal::Monotone_box box;
    const internal::Beam* beam; // none, or one around what is asked for
  };

  // The children of a block that the query may meet; on level 0 they are faces.
  template <class Block>
  Mask children_near(const Block& boxes, std::size_t level, std::size_t block, const Query& query) const
  {
    const Mask mask = boxes.overlapping(query.box);
    return query.beam == nullptr || mask == 0 ? mask : mask & m_rods[level][block].near(*query.beam);
  }

  template <class Visitor>
  void visit_all_near(const Query& query, Visitor& visit) const
  {
    const auto visit_and_go_on = [&](Id face) {
      visit(face);
      return false;
    };
    visit_near(query, visit_and_go_on);
  }

  // Calls the visitor for faces that the query may meet, until it returns true. Returns whether it did.
  template <class Visitor>
  bool visit_near(const Query& query, Visitor& visit) const
  {
    std::size_t visits = 0;
    const auto visit_faces = [&](std::size_t leaf) {
      for (Mask mask = children_near(m_leaves[leaf].boxes, 0, leaf, query); mask != 0; mask &= mask - 1) {
        ++visits;
        if (visit(m_leaves[leaf].faces[Box_block::first(mask)]))
          return true;
      }
      return false;
    };
    bool is_stopped = m_leaves_in_tree > 0 && visit_leaves_below(m_levels.size() - 1, 0, query, visit_faces);
    for (std::size_t i = m_leaves_in_tree; i < m_leaves.size() && !is_stopped; ++i)
      is_stopped = visit_faces(i);
    ++m_statistics.queries;
    m_statistics.visits += visits;
    return is_stopped;
  }

  template <class Visitor>
  bool visit_leaves_below(std::size_t level, std::size_t node, const Query& query, Visitor& visit) const
  {
    const Mask found = children_near(m_levels[level][node], level + 1, node, query);
    const auto is_any_child = [&](const auto& function) {
      for (Mask mask = found; mask != 0; mask &= mask - 1)
        if (function(s_width * node + Box_block::first(mask)))
          return true;
      return false;
    };
    const auto prefetch_all = [&](const auto& blocks) {
      for (Mask mask = found; mask != 0; mask &= mask - 1)
        internal::prefetch(blocks[s_width * node + Box_block::first(mask)]);
    };
    if (level > 0) {
      prefetch_all(m_levels[level - 1]);
      return is_any_child(
          [&](std::size_t child) { return visit_leaves_below(level - 1, child, query, visit); });
    }
    prefetch_all(m_leaves);
    return is_any_child(visit);
  }

  template <class Point>
  internal::Vector_of_doubles from_origin(const Point& point) const
  {
    const auto& origin = m_map.origin();
    return {point[0] - origin[0], point[1] - origin[1], point[2] - origin[2]};
  }

  // The balance rises as long as more than an eighth of the faces that come in are slivers.
  void count_sliver(const Corners& corners)
  {
    constexpr std::size_t worth = 7;
    if (internal::is_askew_sliver(corners))
      m_sliver_balance += worth;
    else if (m_sliver_balance > 0)
      --m_sliver_balance;
  }
  bool are_rods_due() const { return m_sliver_balance > m_size / 2; }

  template <class Corners_of>
  void note_all_rods(const Corners_of& corners_of)
  {
    for (const Leaf& leaf : m_leaves)
      for (const Id face : leaf.faces)
        if (face != s_none)
          note_rod(face, rod_around(corners_of(face)));
    make_rods();
  }

  internal::Rod rod_around(const Corners& corners) const
  {
    const auto& [a, b, c] = corners;
    return internal::Rod::around_triangle({from_origin(a), from_origin(b), from_origin(c)});
  }

  void note_rod(Id face, const internal::Rod& rod)
  {
    if (face >= m_rod_of_face.size())
      m_rod_of_face.resize(face + std::size_t(1));
    m_rod_of_face[face] = rod;
    m_rod_extent = (std::max)(m_rod_extent, rod.extent());
  }

  // Makes the rods of all nodes from those of the faces.
  void make_rods()
  {
    m_rods.assign(1 + m_levels.size(), {});
    m_rods[0].resize(m_leaves.size());
    for (std::size_t leaf = 0; leaf < m_leaves.size(); ++leaf)
      for (std::size_t i = 0; i < s_width; ++i)
        if (const Id face = m_leaves[leaf].faces[i]; face != s_none)
          m_rods[0][leaf].set(i, m_rod_of_face[face]);
    std::vector<internal::Rod> below;
    for (std::size_t level = 1; level < m_rods.size(); ++level) {
      m_rods[level].resize(m_levels[level - 1].size());
      const std::size_t children = level == 1 ? m_leaves_in_tree : m_levels[level - 2].size();
      for (std::size_t child = 0; child < children; ++child) {
        const auto is_empty = [&](std::size_t i) {
          return level == 1 ? m_leaves[child].faces[i] == s_none : m_levels[level - 2][child][i].is_empty();
        };
        below.clear();
        for (std::size_t i = 0; i < s_width; ++i)
          if (!is_empty(i))
            below.push_back(m_rods[level - 1][child][i]);
        const internal::Rod rod = internal::Rod::around(below);
        m_rod_extent = std::isinf(rod.radius) ? m_rod_extent : (std::max)(m_rod_extent, rod.extent());
        m_rods[level][child / s_width].set(child % s_width, rod);
      }
    }
  }

  // Stores the rod of a face that has a slot, and enlarges those above so that they enclose it.
  void put_rod(Id face)
  {
    const std::size_t slot = m_slots[face], leaf = slot / s_width;
    m_rods[0].resize(m_leaves.size());
    m_rods[0][leaf].set(slot % s_width, m_rod_of_face[face]);
    if (leaf >= m_leaves_in_tree)
      return;
    internal::Rod rod = m_rod_of_face[face];
    std::size_t child = leaf;
    for (std::size_t level = 1; level < m_rods.size(); ++level) {
      internal::Rod_block& block = m_rods[level][child / s_width];
      internal::Rod parent = block[child % s_width];
      if (!parent.enclose(rod))
        return;
      block.set(child % s_width, parent);
      m_rod_extent = (std::max)(m_rod_extent, parent.extent());
      rod = parent;
      child /= s_width;
    }
  }

  internal::Monotone_box_map m_map;
  std::vector<Leaf> m_leaves;
  std::size_t m_leaves_in_tree = 0;             // the leaves after these are tested one by one
  std::vector<std::vector<Box_block>> m_levels; // the lowest level first
  std::vector<Slot> m_slots;                    // by face
  std::size_t m_size = 0;
  Slot m_slot_count = 0; // slots given to faces since the tree was made
  std::vector<std::vector<internal::Rod_block>>
      m_rods; // of faces by leaf, then of the children in `m_levels`
  std::vector<internal::Rod> m_rod_of_face;
  std::size_t m_sliver_balance = 0;
  double m_rod_extent = 0;                                         // no coordinate of a known rod is larger
  mutable std::vector<internal::Vector_of_doubles> m_query_points; // a buffer
  mutable Index_statistics m_statistics;
};

} // namespace selvedge

#endif // SELVEDGE_SPATIAL_PACKED_R_TREE_H
