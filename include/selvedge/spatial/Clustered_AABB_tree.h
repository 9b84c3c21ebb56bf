// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_CLUSTERED_AABB_TREE_H
#define SELVEDGE_SPATIAL_CLUSTERED_AABB_TREE_H

#include <selvedge/Error.h>
#include <selvedge/spatial/Index_statistics.h>
#include <selvedge/spatial/internal/Box_tree.h>

#include <boost/container_hash/hash.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace selvedge {

/// Finds the faces whose bounding boxes overlap a box, while faces are added, changed and removed.
///
/// Faces are put into the cells of a uniform grid by the centres of their boxes. A hash map holds the
/// non-empty cells. Each of them is a *cluster* with a `CGAL::AABB_tree` of its own, and the boxes of the
/// clusters are in a further tree. A face that grows stays in its cluster, and the box of the cluster grows
/// with it. So a change touches one small tree and, now and then, the small tree over the clusters.
///
/// **Guarantees**
/// 1. A query visits every face whose box overlaps the query box, each exactly once. It may visit others.
/// 2. The order of visits depends on the sequence of calls alone, not on addresses or on the platform.
///
/// **Preconditions** Boxes are finite and not empty. The caller numbers the faces 0 … n−1. The index knows
/// nothing of a face but its number and its box. It stores boxes and never computes one again, so a face that
/// is gone from the mesh is not read.
///
/// **Exactness** Boxes are stored as floats, through a monotone map that can only add overlaps.
///
/// **Complexity** Building is O(n log c) with c faces per cluster. A query is logarithmic in the number of
/// clusters and in the number of faces of each cluster that it meets. A change is amortised O(log c). The
/// index takes about 75 bytes per face.
///
/// **Reference** Derichs, Misiak, Fuhrmann: Intersection-free mesh decimation for high resolution cloth
/// models, section 4.2 and figure 9, where 100 faces per cluster were best.
class Clustered_AABB_tree
{
public:
  using Id = std::uint32_t;

  /// Makes an empty index whose cell size will aim at `faces_per_cluster` ≥ 1. Throws `Argument_error` when
  /// that is 0.
  explicit Clustered_AABB_tree(std::size_t faces_per_cluster = 100)
      : m_faces_per_cluster(faces_per_cluster), m_cluster_table(std::make_unique<internal::Box_table>()),
        m_face_table(std::make_unique<internal::Box_table>()), m_top(m_cluster_table.get())
  {
    if (faces_per_cluster == 0)
      throw Argument_error("a cluster needs at least one face; give a cluster size of 1 or more");
  }

  /// Replaces the content by `faces`. The box of face `faces[i]` is `box_of(faces[i])`, a `CGAL::Bbox_3`.
  template <class BoxOf>
  void build(const std::vector<Id>& faces, const BoxOf& box_of)
  {
    m_clusters.clear();
    m_cluster_of_cell.clear();
    m_cluster_of_face.clear();
    *m_face_table = {};
    *m_cluster_table = {};

    CGAL::Bbox_3 domain;
    for (const Id face : faces)
      domain += box_of(face);
    m_map = internal::Monotone_box_map(domain);
    for (const Id face : faces) {
      reserve(face);
      m_face_table->boxes[face] = m_map(box_of(face));
    }
    m_cell_size = cell_size(faces);

    std::vector<std::vector<Id>> members;
    for (const Id face : faces) {
      const Id cluster = m_cluster_of_face[face] = cluster_at(m_face_table->boxes[face]);
      if (cluster == members.size())
        members.emplace_back();
      members[cluster].push_back(face);
    }
    std::vector<Id> clusters(m_clusters.size());
    for (Id cluster = 0; cluster < m_clusters.size(); ++cluster) {
      m_clusters[cluster].build(members[cluster], *m_face_table);
      members[cluster] = {};
      m_cluster_table->boxes[cluster] = m_clusters[cluster].box();
      clusters[cluster] = cluster;
    }
    m_top.build(clusters, *m_cluster_table);
    m_statistics.clusters = m_clusters.size();
  }

  /// Adds a face, or gives another box to a face that is in the index.
  void set(Id face, const CGAL::Bbox_3& box)
  {
    reserve(face);
    const internal::Monotone_box mapped = m_map(box);
    // A face keeps its cluster even when it is removed: the cluster's tree may still hold its number.
    Id& cluster = m_cluster_of_face[face];
    if (cluster == s_none)
      cluster = cluster_at(mapped);
    m_statistics.cluster_rebuilds += m_clusters[cluster].set(face, mapped, *m_face_table);
    m_statistics.top_rebuilds += m_top.set(cluster, m_clusters[cluster].box(), *m_cluster_table);
    m_statistics.clusters = m_clusters.size();
  }

  /// Removes a face. **Precondition** It is in the index.
  void remove(Id face)
  {
    m_statistics.cluster_rebuilds += m_clusters[m_cluster_of_face[face]].remove(face, *m_face_table);
  }

  /// Calls `visit(face)` for every face whose box overlaps `box`, and perhaps for some more.
  template <class Visitor>
  void visit_overlapping(const CGAL::Bbox_3& box, Visitor&& visit) const
  {
    ++m_statistics.queries;
    const internal::Monotone_box query = m_map(box);
    const auto count_and_visit = [&](Id face) {
      ++m_statistics.visits;
      visit(face);
    };
    m_top.visit_overlapping(query, *m_cluster_table, [&](Id cluster) {
      m_clusters[cluster].visit_overlapping(query, *m_face_table, count_and_visit);
    });
  }

  /// Counts since construction, for reports.
  const Index_statistics& statistics() const { return m_statistics; }

private:
  using Cell = std::array<std::int32_t, 3>;
  static constexpr Id s_none = Id(-1);

  void reserve(Id face)
  {
    if (face < m_cluster_of_face.size())
      return;
    m_cluster_of_face.resize(face + std::size_t(1), s_none);
    m_face_table->resize(face + std::size_t(1));
  }

  Cell cell(const internal::Monotone_box& box, float size) const
  {
    constexpr float limit = 1e9f; // cells far away are united, so that nothing overflows
    Cell result;
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[axis] = std::int32_t(std::clamp(std::floor(0.5f * box.centre(axis) / size), -limit, limit));
    return result;
  }

  // Returns a cell size at which non-empty cells hold about as many faces as asked for. Faces lie on
  // surfaces, so their number per cell grows with the square of the size. A few rounds of measuring are
  // enough.
  float cell_size(const std::vector<Id>& faces) const
  {
    internal::Monotone_box domain = internal::Monotone_box::empty();
    for (const Id face : faces)
      domain += m_face_table->boxes[face];
    const std::size_t longest = domain.longest_axis();
    const float extent = domain.upper[longest] - domain.lower[longest];
    if (!(extent > 0))
      return 1;
    float size = extent * std::sqrt(float(m_faces_per_cluster) / float(m_faces_per_cluster + faces.size()));
    for (int round = 0; round < 3; ++round) {
      std::unordered_map<Cell, std::size_t, boost::hash<Cell>> cells;
      for (const Id face : faces)
        ++cells[cell(m_face_table->boxes[face], size)];
      const float faces_per_cell = float(faces.size()) / float(cells.size());
      size =
          std::clamp(size * std::sqrt(float(m_faces_per_cluster) / faces_per_cell), extent * 1e-6f, extent);
    }
    return size;
  }

  Id cluster_at(const internal::Monotone_box& box)
  {
    const auto [it, is_new] = m_cluster_of_cell.try_emplace(cell(box, m_cell_size), Id(m_clusters.size()));
    if (is_new) {
      m_clusters.emplace_back(m_face_table.get());
      m_cluster_table->resize(m_clusters.size());
    }
    return it->second;
  }

  std::size_t m_faces_per_cluster;
  float m_cell_size = 1;
  internal::Monotone_box_map m_map;
  // The tables are on the heap, because every tree points to its table and this object may move.
  std::unique_ptr<internal::Box_table> m_cluster_table;
  std::unique_ptr<internal::Box_table> m_face_table;
  std::vector<Id> m_cluster_of_face;
  std::unordered_map<Cell, Id, boost::hash<Cell>> m_cluster_of_cell;
  std::vector<internal::Box_tree> m_clusters;
  internal::Box_tree m_top;
  mutable Index_statistics m_statistics;
};

} // namespace selvedge

#endif // SELVEDGE_SPATIAL_CLUSTERED_AABB_TREE_H
