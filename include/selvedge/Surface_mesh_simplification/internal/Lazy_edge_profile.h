// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_LAZY_EDGE_PROFILE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_LAZY_EDGE_PROFILE_H

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_profile.h>
#include <CGAL/boost/graph/helpers.h>

#include <optional>

namespace selvedge {
namespace internal {

/// Describes an edge from v0 to v1 and what lies around it, for policies. A model of CGAL's concept
/// `EdgeProfile`.
///
/// It exists because CGAL's own profile collects triangles, link and border edges when it is made, and so
/// allocates memory for every cost that is computed. This profile knows the ends and the faces at the edge
/// without allocating. It makes CGAL's profile when `triangles`, `link` or `border_edges` is first asked for,
/// which must be before the collapse.
template <class TriangleMesh, class VertexPointMap_, class GeomTraits>
class Lazy_edge_profile
{
  using Full_profile =
      CGAL::Surface_mesh_simplification::Edge_profile<TriangleMesh, VertexPointMap_, GeomTraits>;

public:
  using TM = TriangleMesh;
  using Triangle_mesh = TriangleMesh;
  using VertexPointMap = VertexPointMap_; // CGAL's policies use this name and TM
  using Vertex_point_map = VertexPointMap;
  using Geom_traits = GeomTraits;
  using FT = typename GeomTraits::FT;
  using Point = typename boost::property_traits<VertexPointMap>::value_type;
  using Point_reference = typename boost::property_traits<VertexPointMap>::reference;
  using vertex_descriptor = typename boost::graph_traits<TriangleMesh>::vertex_descriptor;
  using halfedge_descriptor = typename boost::graph_traits<TriangleMesh>::halfedge_descriptor;
  using edge_descriptor = typename boost::graph_traits<TriangleMesh>::edge_descriptor;
  using face_descriptor = typename boost::graph_traits<TriangleMesh>::face_descriptor;
  using GraphTraits = boost::graph_traits<TriangleMesh>;
  using edges_size_type = typename GraphTraits::edges_size_type;
  using Triangle = typename Full_profile::Triangle;
  using Triangle_vector = typename Full_profile::Triangle_vector;
  using vertex_descriptor_vector = typename Full_profile::vertex_descriptor_vector;
  using halfedge_descriptor_vector = typename Full_profile::halfedge_descriptor_vector;

  Lazy_edge_profile(halfedge_descriptor v0_v1, TriangleMesh& mesh, const VertexPointMap& points,
                    const GeomTraits& traits)
      : m_mesh(mesh), m_points(points), m_traits(traits), m_v0_v1(v0_v1), m_v1_v0(opposite(v0_v1, mesh)),
        m_v0(target(m_v1_v0, mesh)), m_v1(target(v0_v1, mesh)), m_p0(get(points, m_v0)),
        m_p1(get(points, m_v1))
  {
  }

  halfedge_descriptor v0_v1() const { return m_v0_v1; }
  halfedge_descriptor v1_v0() const { return m_v1_v0; }
  vertex_descriptor v0() const { return m_v0; }
  vertex_descriptor v1() const { return m_v1; }
  const Point& p0() const { return m_p0; }
  const Point& p1() const { return m_p1; }

  vertex_descriptor vL() const { return sides().vL; }
  halfedge_descriptor v1_vL() const { return sides().v1_vL; }
  halfedge_descriptor vL_v0() const { return sides().vL_v0; }
  vertex_descriptor vR() const { return sides().vR; }
  halfedge_descriptor v0_vR() const { return sides().v0_vR; }
  halfedge_descriptor vR_v1() const { return sides().vR_v1; }

  bool is_v0_v1_a_border() const { return sides().is_v0_v1_border; }
  bool is_v1_v0_a_border() const { return sides().is_v1_v0_border; }
  bool left_face_exists() const { return !is_v0_v1_a_border(); }
  bool right_face_exists() const { return !is_v1_v0_a_border(); }

  const TriangleMesh& surface() const { return m_mesh; }
  const TriangleMesh& surface_mesh() const { return m_mesh; }
  VertexPointMap vertex_point_map() const { return m_points; }
  const GeomTraits& geom_traits() const { return m_traits; }

  /// Converts to CGAL's own profile, for visitors whose functions name that type.
  operator const Full_profile&() const { return full(); }

  const Triangle_vector& triangles() const { return full().triangles(); }
  const vertex_descriptor_vector& link() const { return full().link(); }
  const halfedge_descriptor_vector& border_edges() const { return full().border_edges(); }

  const Full_profile& full() const
  {
    // CGAL's profile takes index maps but does not read them.
    if (!m_full)
      m_full.emplace(m_v0_v1, m_mesh, m_traits, 0, m_points, 0, true);
    return *m_full;
  }

private:
  struct Sides
  {
    bool is_v0_v1_border, is_v1_v0_border;
    vertex_descriptor vL{}, vR{};
    halfedge_descriptor v1_vL{}, vL_v0{}, v0_vR{}, vR_v1{};
  };

  // Found at the first question, which comes before the collapse: costs ask none.
  const Sides& sides() const
  {
    if (!m_sides) {
      m_sides = Sides{CGAL::is_border(m_v0_v1, m_mesh), CGAL::is_border(m_v1_v0, m_mesh)};
      if (!m_sides->is_v0_v1_border) {
        m_sides->v1_vL = next(m_v0_v1, m_mesh);
        m_sides->vL_v0 = next(m_sides->v1_vL, m_mesh);
        m_sides->vL = target(m_sides->v1_vL, m_mesh);
      }
      if (!m_sides->is_v1_v0_border) {
        m_sides->v0_vR = next(m_v1_v0, m_mesh);
        m_sides->vR_v1 = next(m_sides->v0_vR, m_mesh);
        m_sides->vR = target(m_sides->v0_vR, m_mesh);
      }
    }
    return *m_sides;
  }

  TriangleMesh& m_mesh;
  const VertexPointMap& m_points;
  const GeomTraits& m_traits;
  halfedge_descriptor m_v0_v1, m_v1_v0;
  vertex_descriptor m_v0, m_v1;
  Point m_p0, m_p1;
  mutable std::optional<Sides> m_sides;
  mutable std::optional<Full_profile> m_full;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_LAZY_EDGE_PROFILE_H
