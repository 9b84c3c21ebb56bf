// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The log of CGAL's edge_collapse with CGAL's own policies: the cost of Lindstrom and Turk, the filter
// against normals that turn over, and their placement, moved to the nearer end of the edge so that it is one
// of the two.

#include "Peer_log.h"

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

namespace {

using namespace selvedge;
using namespace selvedge::benchmark;
namespace SMS = CGAL::Surface_mesh_simplification;

using Mesh = CGAL::Surface_mesh<Point_3>;

class Nearer_end
{
public:
  using TM = Mesh;

  template <class Profile>
  auto operator()(const Profile& profile) const
  {
    auto place = m_placement(profile);
    if (place)
      place = CGAL::compare_distance_to_point(*place, profile.p0(), profile.p1()) == CGAL::SMALLER
                  ? profile.p0()
                  : profile.p1();
    return place;
  }

private:
  SMS::LindstromTurk_placement<Mesh> m_placement;
};

class Logging_visitor : public SMS::Edge_collapse_visitor_base<Mesh>
{
public:
  explicit Logging_visitor(Peer_log& log) : m_log(&log) {}

  template <class Profile, class Place>
  void OnCollapsing(const Profile& profile, const Place& place)
  {
    const bool is_v0_kept = place && *place == profile.p0();
    m_kept = is_v0_kept ? profile.v0() : profile.v1();
    m_removed = is_v0_kept ? profile.v1() : profile.v0();
  }

  template <class Profile>
  void OnCollapsed(const Profile&, const Mesh::Vertex_index survivor)
  {
    m_log->add(m_removed, m_kept, survivor);
  }

private:
  Peer_log* m_log;
  Mesh::Vertex_index m_removed, m_kept;
};

std::vector<Index_triple> reduce(const Triangle_soup& soup, std::size_t faces, Peer_log& log)
{
  Mesh mesh;
  for (const Point_3& p : soup.points)
    mesh.add_vertex(p);
  for (const auto& [a, b, c] : soup.triangles)
    if (mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c)) ==
        Mesh::null_face())
      throw Input_error("the mesh is no oriented manifold, and CGAL's cannot hold it");
  SMS::edge_collapse(mesh, Face_count_stop(faces),
                     CGAL::parameters::get_cost(SMS::LindstromTurk_cost<Mesh>())
                         .get_placement(Nearer_end())
                         .filter(SMS::Bounded_normal_change_filter<>())
                         .visitor(Logging_visitor(log)));
  std::vector<Index_triple> triangles;
  for (const Mesh::Face_index face : mesh.faces()) {
    const auto h = mesh.halfedge(face);
    triangles.push_back({mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))});
  }
  return triangles;
}

} // namespace

int main(int argc, char** argv)
{
  return write_peer_log(argc, argv, "The log of a reduction by CGAL's edge_collapse, for `selvedge replay`.",
                        reduce);
}
