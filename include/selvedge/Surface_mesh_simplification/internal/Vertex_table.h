// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_VERTEX_TABLE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_VERTEX_TABLE_H

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/internal/Element_numbers.h>

#include <CGAL/Dynamic_property_map.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <vector>

namespace selvedge {
namespace internal {

/// Numbers the vertices of a mesh, and keeps where each is, which of them are coincident, and marks for those
/// that take part in the motion being judged.
///
/// It exists because the guard thinks in positions while the mesh has vertices: a mark goes to all vertices
/// at a position at once. Throws `Argument_error` for a mesh with a face that is no triangle, a coordinate
/// that is not finite, an edge of length zero, or a vertex with several fans of faces.
template <class TriangleMesh, class VertexPointMap>
class Vertex_table
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;

public:
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Point = typename boost::property_traits<VertexPointMap>::value_type;
  using Number = std::uint32_t;
  using Mark = std::uint32_t; ///< less than 2^31

  Vertex_table(const TriangleMesh& mesh, const VertexPointMap& points)
      : m_points(points), m_numbers(mesh, vertices(mesh))
  {
    m_records.reserve(m_numbers.size());
    for (const Vertex v : vertices(mesh)) {
      m_records.push_back({get(m_points, v), 0, 0, false});
      const Point& p = m_records.back().point;
      if (!(CGAL::is_finite(p.x()) && CGAL::is_finite(p.y()) && CGAL::is_finite(p.z())))
        throw Argument_error(
            "a vertex of the mesh has a coordinate that is not finite; nothing can be decided "
            "about its faces");
    }
    refuse_other_faces(mesh);
    refuse_several_fans(mesh);
    find_coincident(mesh);
  }

  /// How many vertices there are, or were before the first collapse.
  std::size_t size() const { return m_records.size(); }

  /// Returns whether no vertex has another place than here.
  bool are_in_place(const TriangleMesh& mesh) const
  {
    const auto all = vertices(mesh);
    return std::all_of(all.begin(), all.end(), [this](Vertex v) {
      return number(v) < size() && get(m_points, v) == point(number(v));
    });
  }

  Number number(Vertex v) const { return m_numbers.number(v); }
  const Point& point(Number v) const { return m_records[v].point; }

  /// Returns whether other vertices are at the same position.
  bool is_coincident(Number v) const { return m_records[v].is_coincident; }

  /// Returns all vertices at the position of `v`, which must be coincident.
  const std::vector<Vertex>& all_at(Number v) const { return m_classes[m_class_of_vertex[v]]; }

  /// Called after a collapse onto `target`, when `kept` is the vertex that is left.
  void on_collapsed(Vertex target, Vertex kept)
  {
    const Number to = number(kept), from = number(target);
    m_records[to].point = get(m_points, kept);
    if (!is_coincident(from) || to == from)
      return;
    m_records[to].is_coincident = true;
    m_class_of_vertex[to] = m_class_of_vertex[from];
    std::vector<Vertex>& all = m_classes[m_class_of_vertex[to]];
    std::replace(all.begin(), all.end(), target, kept);
  }

  /// Removes all marks.
  void unmark()
  {
    if (++m_now == 0) { // after 2^32 motions, old marks would count again
      for (Record& record : m_records)
        record.marked_at = 0;
      m_now = 1;
    }
  }

  /// Marks a vertex and all others at its position.
  void mark(Number v, Mark mark)
  {
    const auto mark_one = [&](Record& record) {
      record.marked_at = m_now;
      record.mark = mark & s_mark_bits;
    };
    if (!is_coincident(v))
      mark_one(m_records[v]);
    else
      for (const Vertex other : all_at(v))
        mark_one(m_records[number(other)]);
  }

  bool is_marked(Number v) const { return m_records[v].marked_at == m_now; }
  Mark mark(Number v) const { return m_records[v].mark; }

private:
  static constexpr Mark s_mark_bits = (Mark(1) << 31) - 1;

  // Everything that is read of a vertex when a face near it is judged, in one cache line.
  struct alignas(32) Record
  {
    Point point;
    std::uint32_t marked_at;
    std::uint32_t mark : 31;
    std::uint32_t is_coincident : 1;
  };

  static void refuse_other_faces(const TriangleMesh& mesh)
  {
    for (const auto face : faces(mesh))
      if (!CGAL::is_triangle(halfedge(face, mesh), mesh))
        throw Argument_error("the mesh has a face that is no triangle; triangulate_faces() of "
                             "CGAL::Polygon_mesh_processing makes triangles of all faces");
  }

  // A vertex with several fans leads to one of them only, or it has several borders.
  void refuse_several_fans(const TriangleMesh& mesh) const
  {
    std::vector<std::uint32_t> degrees(m_records.size());
    for (const auto h : halfedges(mesh))
      ++degrees[number(target(h, mesh))];
    for (const Vertex v : vertices(mesh)) {
      if (halfedge(v, mesh) == Graph_traits::null_halfedge())
        continue;
      std::uint32_t degree = 0, borders = 0;
      for (const auto h : CGAL::halfedges_around_target(halfedge(v, mesh), mesh)) {
        ++degree;
        borders += CGAL::is_border(h, mesh);
      }
      if (degree == degrees[number(v)] && borders <= 1)
        continue;
      const Point& p = point(number(v));
      std::ostringstream text;
      text << "the faces around the vertex at (" << CGAL::to_double(p.x()) << ", " << CGAL::to_double(p.y())
           << ", " << CGAL::to_double(p.z())
           << ") form several fans; separate them first, for example with duplicate_non_manifold_vertices() "
              "of "
              "CGAL::Polygon_mesh_processing";
      throw Argument_error(text.str());
    }
  }

  void find_coincident(const TriangleMesh& mesh)
  {
    std::vector<Vertex> sorted;
    sorted.reserve(num_vertices(mesh));
    for (const Vertex v : vertices(mesh))
      if (halfedge(v, mesh) != Graph_traits::null_halfedge())
        sorted.push_back(v);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [this](Vertex a, Vertex b) { return get(m_points, a) < get(m_points, b); });
    for (std::size_t first = 0, beyond; first < sorted.size(); first = beyond) {
      for (beyond = first + 1; beyond < sorted.size(); ++beyond)
        if (get(m_points, sorted[beyond]) != get(m_points, sorted[first]))
          break;
      if (beyond - first == 1)
        continue;
      m_class_of_vertex.resize(m_records.size());
      for (std::size_t i = first; i < beyond; ++i) {
        m_class_of_vertex[number(sorted[i])] = Number(m_classes.size());
        m_records[number(sorted[i])].is_coincident = true;
      }
      m_classes.emplace_back(sorted.data() + first, sorted.data() + beyond);
    }
    for (const auto edge : edges(mesh)) {
      const auto h = halfedge(edge, mesh);
      if (get(m_points, source(h, mesh)) == get(m_points, target(h, mesh)))
        throw Argument_error("the mesh has an edge of length zero; remove its degenerate faces first");
    }
  }

  VertexPointMap m_points;
  Element_numbers<TriangleMesh, Vertex, CGAL::dynamic_vertex_property_t> m_numbers;
  std::vector<Record> m_records;              // by number
  std::vector<std::vector<Vertex>> m_classes; // the coincident vertices at each position
  std::vector<Number> m_class_of_vertex;      // by number; empty if none are coincident
  std::uint32_t m_now = 0;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_VERTEX_TABLE_H
