// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_HINDRANCES_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_HINDRANCES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

namespace selvedge {

/// Why an edge cannot collapse, from the strongest reason to the weakest.
enum class Hindrance : unsigned char {
  frozen,       ///< the vertex belongs to a face of an offending pair
  locked,       ///< the caller has locked the vertex
  non_manifold, ///< faces at the vertex cannot be joined to one fan, for instance at an edge of three faces
  misoriented,  ///< the vertex is at an edge whose two faces face opposite ways
  border,       ///< the vertex would leave a border
  seam,         ///< the vertex would leave a line across which vertex numbers differ, or a line of the caller
  group,        ///< the vertex would leave a line between groups, objects, materials, or values of faces
  texture,      ///< the vertex would leave a line across which texture coordinates differ
  normals,      ///< the vertex could go if no edge were a line because of its normals alone
  line_end,     ///< the vertex is an end, a junction or a corner face of borders and seams
  border_turn,  ///< a border turns too much at the vertex
  seam_turn,    ///< a seam turns too much at the vertex
  drift,        ///< a border or seam would come too far from where it was
  topology,     ///< a piece would lose a hole or vanish, or the surface would touch itself
  gap,          ///< the vertex has a partner across a gap that has no way to go along
  target,       ///< a part that has reached its own ratio would lose a face
  aspect_ratio, ///< a face would become too thin
  normal_change, ///< the normal of a face would turn too much
  uv,            ///< a triangle of the texture would turn over
  error,         ///< the surface would be too far from the original
  intersection,  ///< faces would touch or pass through each other
  clearance,     ///< faces would come nearer to another piece than the clearance allows
  companions,    ///< the vertex could go here, but not in every other place where its mesh stands
  by_loop        ///< every rule accepts, but a geometric test of CGAL's loop does not
};

/// What holds back the edges that are left when a reduction ends short of its target: a count of edges for
/// each reason.
///
/// **Guarantees** Every edge of the mesh counts once, except those whose faces are all fixed (none of their
/// corners could ever move) or not counted (those of an obstacle). Each direction in which the edge could
/// collapse, and with `Placement::optimal` also the place that is neither end, has one reason: the first in
/// the order of `Hindrance` that refuses it. The edge counts for the weakest of these reasons, which is the
/// one that would have to give way first. All of this is so at the end, in the mesh that is left; it does not
/// depend on how often an edge was tried, nor on threads.
///
/// `topology` also stands for what the exact filter refuses by its link condition alone, after all others.
class Hindrances
{
public:
  struct Description
  {
    Hindrance reason;
    const char* key;  ///< names the reason in reports
    const char* name; ///< names it after "held back by"
    const char* rule; ///< the key of the rule in `Refusals` that asks for it, or "topology"
  };

  static constexpr std::size_t count = std::size_t(Hindrance::by_loop) + 1;

  /// Returns all reasons, in order.
  static constexpr std::array<Description, count> descriptions()
  {
    return {{{Hindrance::frozen, "frozen", "frozen faces", "border"},
             {Hindrance::locked, "locked", "locked parts", "border"},
             {Hindrance::non_manifold, "non_manifold", "non-manifold places", "border"},
             {Hindrance::misoriented, "misoriented", "faces that disagree in orientation", "border"},
             {Hindrance::border, "border", "borders", "border"},
             {Hindrance::seam, "seam", "seams", "border"},
             {Hindrance::group, "group", "borders of groups, materials and regions", "border"},
             {Hindrance::texture, "texture", "seams of the texture", "border"},
             {Hindrance::normals, "normals", "normals that differ across edges", "border"},
             {Hindrance::line_end, "line_end", "ends and corners of seams and borders", "border"},
             {Hindrance::border_turn, "border_turn", "the turn of borders", "border"},
             {Hindrance::seam_turn, "seam_turn", "the turn of seams", "border"},
             {Hindrance::drift, "drift", "the drift of borders and seams", "border"},
             {Hindrance::topology, "topology", "topology", "topology"},
             {Hindrance::gap, "gap", "gaps that would get wider", "border"},
             {Hindrance::target, "target", "parts at their target", "target"},
             {Hindrance::aspect_ratio, "aspect_ratio", "the shape of faces", "aspect_ratio"},
             {Hindrance::normal_change, "normal_change", "the turn of normals", "normal_change"},
             {Hindrance::uv, "uv", "texture that would turn over", "uv"},
             {Hindrance::error, "error", "the error bound", "error"},
             {Hindrance::intersection, "intersection", "layers in the way", "intersection"},
             {Hindrance::clearance, "clearance", "layers that would come too near", "clearance"},
             {Hindrance::companions, "companions", "other places of shared meshes", "companions"},
             {Hindrance::by_loop, "by_loop", "CGAL's loop", "by_loop"}}};
  }

  std::size_t& operator[](Hindrance reason) { return m_edges[std::size_t(reason)]; }
  std::size_t operator[](Hindrance reason) const { return m_edges[std::size_t(reason)]; }

  std::size_t total() const { return std::accumulate(m_edges.begin(), m_edges.end(), std::size_t(0)); }

  /// Returns the reason of most edges; of several, the strongest.
  Hindrance most() const
  {
    return Hindrance(std::max_element(m_edges.begin(), m_edges.end()) - m_edges.begin());
  }

private:
  std::array<std::size_t, count> m_edges{};
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_HINDRANCES_H
