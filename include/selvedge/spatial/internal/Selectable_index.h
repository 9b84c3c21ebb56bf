// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_INTERNAL_SELECTABLE_INDEX_H
#define SELVEDGE_SPATIAL_INTERNAL_SELECTABLE_INDEX_H

#include <selvedge/spatial/Clustered_AABB_tree.h>
#include <selvedge/spatial/Packed_R_tree.h>

#include <CGAL/Bbox_3.h>

#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

namespace selvedge {
namespace internal {

/// One of the indices of faces, selected at run time.
class Selectable_index
{
public:
  using Id = Packed_R_tree::Id;
  using Corners = Packed_R_tree::Corners;

  explicit Selectable_index(Packed_R_tree index) : m_index(std::move(index)) {}
  explicit Selectable_index(Clustered_AABB_tree index) : m_index(std::move(index)) {}

  template <class BoxOf>
  void build(const std::vector<Id>& faces, const BoxOf& box_of)
  {
    std::visit([&](auto& index) { index.build(faces, box_of); }, m_index);
  }
  template <class BoxOf, class Corners_of>
  void build(const std::vector<Id>& faces, const BoxOf& box_of, const Corners_of& corners_of)
  {
    if (Packed_R_tree* packed = std::get_if<Packed_R_tree>(&m_index))
      packed->build(faces, box_of, corners_of);
    else
      std::get<Clustered_AABB_tree>(m_index).build(faces, box_of);
  }
  void set(Id face, const CGAL::Bbox_3& box)
  {
    std::visit([&](auto& index) { index.set(face, box); }, m_index);
  }
  template <class Corners_of>
  void set(Id face, const CGAL::Bbox_3& box, const Corners_of& corners_of)
  {
    if (Packed_R_tree* packed = std::get_if<Packed_R_tree>(&m_index))
      packed->set(face, box, corners_of);
    else
      std::get<Clustered_AABB_tree>(m_index).set(face, box);
  }
  void remove(Id face)
  {
    std::visit([&](auto& index) { index.remove(face); }, m_index);
  }
  template <class Visitor>
  void visit_overlapping(const CGAL::Bbox_3& box, Visitor&& visit) const
  {
    std::visit([&](const auto& index) { index.visit_overlapping(box, visit); }, m_index);
  }
  template <class Points, class Visitor>
  void visit_overlapping(const CGAL::Bbox_3& box, const Points& points, Visitor&& visit) const
  {
    if (const Packed_R_tree* packed = std::get_if<Packed_R_tree>(&m_index))
      packed->visit_overlapping(box, points, visit);
    else
      std::get<Clustered_AABB_tree>(m_index).visit_overlapping(box, visit);
  }

  const Index_statistics& statistics() const
  {
    return std::visit([](const auto& index) -> const Index_statistics& { return index.statistics(); },
                      m_index);
  }

private:
  std::variant<Packed_R_tree, Clustered_AABB_tree> m_index;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SPATIAL_INTERNAL_SELECTABLE_INDEX_H
