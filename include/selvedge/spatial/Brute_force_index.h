// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_BRUTE_FORCE_INDEX_H
#define SELVEDGE_SPATIAL_BRUTE_FORCE_INDEX_H

#include <selvedge/spatial/Index_statistics.h>

#include <CGAL/Bbox_3.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace selvedge {

/// Finds the faces whose bounding boxes overlap a box by looking at all faces: the reference for tests of
/// `Packed_R_tree` and `Clustered_AABB_tree`, with the same interface.
///
/// **Guarantees** A query visits exactly the faces whose box overlaps the query box, in ascending order.
///
/// **Complexity** Every query is linear in the largest face number.
class Brute_force_index
{
public:
  using Id = std::uint32_t;

  template <class BoxOf>
  void build(const std::vector<Id>& faces, const BoxOf& box_of)
  {
    m_boxes.clear();
    for (const Id face : faces)
      set(face, box_of(face));
  }

  void set(Id face, const CGAL::Bbox_3& box)
  {
    if (face >= m_boxes.size())
      m_boxes.resize(face + std::size_t(1));
    m_boxes[face] = box;
  }

  void remove(Id face) { m_boxes[face].reset(); }

  template <class Visitor>
  void visit_overlapping(const CGAL::Bbox_3& box, Visitor&& visit) const
  {
    ++m_statistics.queries;
    for (Id face = 0; face < m_boxes.size(); ++face)
      if (m_boxes[face] && CGAL::do_overlap(*m_boxes[face], box)) {
        ++m_statistics.visits;
        visit(face);
      }
  }

  const Index_statistics& statistics() const { return m_statistics; }

private:
  std::vector<std::optional<CGAL::Bbox_3>> m_boxes;
  mutable Index_statistics m_statistics;
};

} // namespace selvedge

#endif // SELVEDGE_SPATIAL_BRUTE_FORCE_INDEX_H
