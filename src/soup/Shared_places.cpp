// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Shared_places.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/internal/inflated.h>

#include <CGAL/Kernel/global_functions.h>

#include <algorithm>

namespace selvedge {

Shared_places::Shared_places(const Corner_mesh& corners, std::vector<Shared_mesh> meshes, double clearance)
    : m_corners(corners), m_meshes(std::move(meshes)), m_clearance(clearance),
      m_copies(corners.own_face_count(), {s_no_mesh, 0, 0})
{
  const std::vector<Face> face_of = corners.faces_of_triangles();
  for (Index m = 0; m < m_meshes.size(); ++m) {
    std::vector<Shared_mesh::Place>& places = m_meshes[m].places;
    std::vector<std::pair<CGAL::Bbox_3, Index>> boxes;
    for (Index p = 0; p < places.size(); ++p) {
      CGAL::Bbox_3 box;
      for (Index row = 0; row < places[p].triangles.size(); ++row) {
        const Face face = face_of[places[p].triangles[row]];
        places[p].triangles[row] = face;
        if (face == Mesh::null_face())
          continue;
        m_copies[face] = {m, p, row};
        for (const Mesh::Vertex_index v : mesh().vertices_around_face(mesh().halfedge(face)))
          box += mesh().point(v).bbox();
      }
      boxes.emplace_back(internal::inflated(box, clearance), p);
    }
    // No vertex leaves the box of its place: all go to others of the same place.
    std::sort(boxes.begin(), boxes.end(),
              [](const auto& a, const auto& b) { return a.first.xmin() < b.first.xmin(); });
    auto& near = m_near_places.emplace_back();
    for (auto a = boxes.begin(); a != boxes.end(); ++a)
      for (auto b = a + 1; b != boxes.end() && b->first.xmin() <= a->first.xmax(); ++b)
        if (CGAL::do_overlap(a->first, b->first))
          near.emplace_back(a->second, b->second);
  }
}

// The same side, of the same triangle, in another place of its mesh. Where one of the two faces is turned
// over, its halfedges run the other way.
Corner_mesh::Side Shared_places::in_place(const Corner_mesh::Side& side, Index place) const
{
  const Copy& copy = m_copies[side.face];
  const Index image = m_meshes[copy.mesh].places[place].triangles[copy.row];
  if (is_flipped(side.face) == is_flipped(image))
    return {image, side.place, side.is_beyond};
  return {image, static_cast<unsigned char>(2 - side.place), !side.is_beyond};
}

bool Shared_places::is_flipped(Index face) const
{
  const Copy& copy = m_copies[face];
  return m_meshes[copy.mesh].places[copy.place].is_mirrored != m_corners.is_turned(Face(face));
}

// Whether the faces on both sides of an edge belong to one place of a mesh.
bool Shared_places::is_sewn_inside(Halfedge h) const
{
  const Face a = mesh().face(h), b = mesh().face(mesh().opposite(h));
  return m_corners.is_own(b) && m_copies[a].mesh == m_copies[b].mesh &&
         m_copies[a].place == m_copies[b].place;
}

// Locks the vertices that would have to move with others at their positions as well as in other places.
void Shared_places::lock_joint_vertices(Simplify_constraints<Mesh>& constraints) const
{
  auto& groups = constraints.joint_vertices;
  const auto is_at_shared_face = [this](Mesh::Vertex_index v) {
    const auto faces = mesh().faces_around_target(mesh().halfedge(v));
    return std::any_of(faces.begin(), faces.end(), [this](Face f) {
      return f != Mesh::null_face() && m_corners.is_own(f) && is_shared(f);
    });
  };
  const auto beyond = std::stable_partition(groups.begin(), groups.end(), [&](const auto& group) {
    return std::none_of(group.begin(), group.end(), is_at_shared_face);
  });
  for (auto group = beyond; group != groups.end(); ++group)
    constraints.locked_vertices.insert(constraints.locked_vertices.end(), group->begin(), group->end());
  groups.erase(beyond, groups.end());
}

std::vector<char> Shared_places::lock_in_all_places(Simplify_constraints<Mesh>& constraints) const
{
  lock_joint_vertices(constraints);
  std::vector<char> is_locked(mesh().number_of_vertices(), false);
  for (const Mesh::Vertex_index v : constraints.locked_vertices)
    is_locked[v] = true;
  std::vector<char> is_held_elsewhere(m_corners.soup().points.size(), false);
  const auto lock_source = [&](Halfedge h) {
    const Mesh::Vertex_index v = mesh().source(h);
    if (std::exchange(is_locked[v], true))
      return;
    constraints.locked_vertices.push_back(v);
    for (const Halfedge in : mesh().halfedges_around_target(mesh().opposite(h)))
      if (!mesh().is_border(in) && m_corners.is_own(mesh().face(in)))
        is_held_elsewhere[m_corners.vertex_of(m_corners.corner_at(in))] = true;
  };
  Cancellation_poll poll;
  for (const Shared_mesh& shared : m_meshes)
    for (const Index face : shared.places.front().triangles)
      for (unsigned char place = 0; place < 3 && m_corners.has_face(Face(face)); ++place) {
        poll();
        const Corner_mesh::Side here = {face, place, false};
        const Halfedge h = m_corners.halfedge(here), beyond = mesh().opposite(h);
        const bool is_border = mesh().is_border(beyond);
        // Nothing that is sewn to other faces in some place can move alike in all.
        bool is_alike = is_border || is_sewn_inside(h), is_held = is_locked[mesh().source(h)];
        std::vector<Halfedge> images = {h};
        for (Index p = 1; p < shared.places.size(); ++p) {
          const Halfedge image = m_corners.halfedge(in_place(here, p));
          images.push_back(image);
          is_held |= is_locked[mesh().source(image)];
          if (is_alike)
            is_alike =
                is_border ? mesh().is_border(mesh().edge(image))
                          : m_corners.halfedge(in_place(m_corners.side(beyond), p)) == mesh().opposite(image);
        }
        for (const Halfedge image : images) {
          if (!is_alike || is_held)
            lock_source(image);
          if (!is_alike)
            lock_source(mesh().opposite(image));
        }
      }
  return is_held_elsewhere;
}

std::vector<Shared_places::Halfedge> Shared_places::companions(Halfedge moving) const
{
  std::vector<Halfedge> result;
  const Corner_mesh::Side here = m_corners.side(moving);
  if (!is_shared(Face(here.face)))
    return result;
  const Copy& copy = m_copies[here.face];
  for (Index p = 0; p < m_meshes[copy.mesh].places.size(); ++p)
    if (p != copy.place)
      result.push_back(m_corners.halfedge(in_place(here, p)));
  return result;
}

bool Shared_places::is_led(Halfedge edge) const
{
  const Corner_mesh::Side here = m_corners.side(edge);
  return is_shared(Face(here.face)) && m_copies[here.face].place > 0;
}

bool Shared_places::are_apart(Halfedge moving, const std::vector<Halfedge>& companions) const
{
  const Copy& copy = m_copies[m_corners.side(moving).face];
  const auto& near = m_near_places[copy.mesh];
  if (near.empty())
    return true;
  std::vector<CGAL::Bbox_3> boxes(companions.size() + 1); // of stars, by place
  const auto set_box = [&](Halfedge h) {
    CGAL::Bbox_3& box = boxes[m_copies[m_corners.side(h).face].place];
    for (const Halfedge in : mesh().halfedges_around_target(mesh().opposite(h)))
      box += mesh().point(mesh().source(in)).bbox();
    box += mesh().point(mesh().source(h)).bbox();
  };
  set_box(moving);
  for (const Halfedge companion : companions)
    set_box(companion);
  return std::none_of(near.begin(), near.end(), [&](const auto& pair) {
    return CGAL::do_overlap(internal::inflated(boxes[pair.first], m_clearance), boxes[pair.second]);
  });
}

} // namespace selvedge
