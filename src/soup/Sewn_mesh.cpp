// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Sewn_mesh.h"

#include "Sewing.h"
#include "selection.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/Surface_mesh_simplification/internal/mesh_diagonal.h>
#include <selvedge/spatial/internal/order_along_curve.h>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

namespace selvedge {

namespace {

// Returns the triangles of which there are faces, in an order in which neighbours mostly follow each other:
// first those of the soup, without doubles, then those of the obstacle.
std::vector<Index> triangles_in_space(const Triangle_soup& soup, const std::vector<Index>& fronts,
                                      const Triangle_soup& obstacle, const Scale& scale)
{
  const Index own_count = Index(soup.triangles.size());
  std::vector<Index> triangles, result;
  const auto append_in_space = [&](const Triangle_soup& of, Index first) {
    for (const Index i : internal::order_along_curve(triangles.size(), [&](std::size_t i) {
           return scale(of.points[of.triangles[triangles[i] - first].front()]);
         }))
      result.push_back(triangles[i]);
  };
  for (Index t = 0; t < own_count; ++t)
    if (fronts.empty() || fronts[t] == t)
      triangles.push_back(t);
  result.reserve(triangles.size() + obstacle.triangles.size());
  append_in_space(soup, 0);
  triangles.resize(obstacle.triangles.size());
  std::iota(triangles.begin(), triangles.end(), own_count);
  append_in_space(obstacle, own_count);
  return result;
}

} // namespace

Sewn_mesh::Sewn_mesh(const Triangle_soup& soup, const std::vector<Index>& positions,
                     const std::vector<char>& is_frozen, const Triangle_soup& obstacle, const Scale& scale,
                     const std::vector<char>& is_turned, const std::vector<Index>& fronts)
    : Corner_mesh(soup, positions, is_turned, fronts, triangles_in_space(soup, fronts, obstacle, scale))
{
  const std::vector<Index_triple> triangles = add_faces(positions, is_frozen, obstacle);
  note_vertices(positions);
  const Index own_corners = Index(3 * own_face_count());
  const Sewing sewing(triangles, own_corners, Index(positions.size()), m_notes);
  Cancellation_scope::check();
  std::vector<Corner> corner_of(sewing.vertex_count()); // the first corner of each vertex
  for (Corner corner = Index(3 * triangles.size()); corner-- > 0;)
    corner_of[sewing.vertex(corner)] = corner;
  const std::vector<Halfedge> halfedges = build(sewing, [&](Index vertex) {
    const Face face(corner_of[vertex] / 3);
    const Index place = corner_of[vertex] % 3;
    return scale(is_own(face)
                     ? soup.points[vertex_of(corners(face)[place])]
                     : obstacle.points[obstacle.triangles[triangle(face) - soup.triangles.size()][place]]);
  });

  std::vector<Index> position_of;                      // by vertex
  std::vector<Index> vertices_at(positions.size(), 0); // the number of vertices, by position
  for (const Corner corner : corner_of) {              // vertices of the obstacle come last
    const Index position = triangles[corner / 3][corner % 3];
    position_of.push_back(position);
    m_notes.unsewn_positions += ++vertices_at[position] == 2 && corner < own_corners;
  }
  find_locked(sewing, position_of, vertices_at);
  find_misoriented(sewing);
  Cancellation_scope::check();
  find_lines(sewing, halfedges);
  find_spokes();
  find_no_strip_vertices(position_of);

  if (!obstacle.triangles.empty()) { // the limits are shares of the diagonal of the soup alone
    CGAL::Bbox_3 box;
    for (const Index_triple& triangle : soup.triangles)
      for (const Index i : triangle)
        box += scale(soup.points[i]).bbox();
    m_constraints.diagonal = internal::diagonal_of(box);
  }
}

Sewn_mesh::Sewn_mesh(const Sewn_mesh& whole, const Border_rule<Mesh>& rule, const std::vector<Index>& faces)
    : Corner_mesh(whole, faces)
{
  const Mesh& of_whole = whole.mesh();
  std::vector<Halfedge> originals; // by side
  std::vector<Index> mates(3 * faces.size(), Sewing::none);
  std::vector<Index> cut; // sides whose mates are not in the part
  originals.reserve(mates.size());
  for (const Index face : faces) {
    const auto next_face = faces.begin() + std::ptrdiff_t(originals.size() / 3) + 1;
    if (!whole.is_own(Face(face)))
      m_constraints.uncounted_faces.emplace_back(Index(originals.size() / 3));
    for (unsigned char place = 0; place < 3; ++place) {
      const Index side = Index(originals.size());
      originals.push_back(whole.halfedge({face, place, false}));
      const Halfedge opposite = of_whole.opposite(originals.back());
      if (mates[side] != Sewing::none || of_whole.is_border(opposite)) // found from the other side, or none
        continue;
      const Side beyond = whole.side(opposite);
      const auto found =
          beyond.face < face ? faces.end() : std::lower_bound(next_face, faces.end(), beyond.face);
      if (found != faces.end() && *found == beyond.face) {
        mates[side] = Index(3 * (found - faces.begin())) + beyond.place;
        mates[mates[side]] = side;
      } else
        cut.push_back(side);
    }
  }

  const Sewing sewing(std::move(mates));
  std::vector<Mesh::Vertex_index> vertices(sewing.vertex_count()); // of the whole
  for (Index side = 0; side < originals.size(); ++side)
    vertices[sewing.vertex(side)] = of_whole.source(originals[side]);
  const std::vector<Halfedge> halfedges =
      build(sewing, [&](Index vertex) { return of_whole.point(vertices[vertex]); });

  std::vector<char> is_locked(vertices.size(), false);
  for (Index v = 0; v < vertices.size(); ++v) {
    is_locked[v] = rule.is_locked(vertices[v]);
    if (rule.bounds_no_strip(vertices[v]))
      m_constraints.no_strip_vertices.emplace_back(v);
  }
  for (const Index side : cut)
    is_locked[sewing.vertex(side)] = is_locked[sewing.vertex(Sewing::next(side))] = true;
  lock(is_locked);
  for (Index side = 0; side < originals.size(); ++side) {
    if (sewing.mate(side) == Sewing::none)
      continue;
    if (!rule.is_line(of_whole.edge(originals[side]))) {
      if (rule.is_line_at_target(originals[side]))
        m_constraints.spokes.push_back(halfedges[side]);
    } else if (side < sewing.mate(side))
      m_constraints.line_edges.push_back(mesh().edge(halfedges[side]));
  }
  if (!whole.m_constraints.vertex_weights.empty())
    for (const Mesh::Vertex_index v : vertices)
      m_constraints.vertex_weights.push_back(whole.m_constraints.vertex_weights[v]);
}

// Notes what is said of each face, and returns the positions of its corners.
std::vector<Index_triple> Sewn_mesh::add_faces(const std::vector<Index>& positions,
                                               const std::vector<char>& is_frozen,
                                               const Triangle_soup& obstacle)
{
  const Index own_vertices = Index(soup().points.size()), own_triangles = Index(soup().triangles.size());
  const Index face_count = Index(own_face_count() + obstacle.triangles.size());
  std::vector<Index_triple> triangles;
  triangles.reserve(face_count);
  m_is_frozen.reserve(face_count);
  for (Index number = 0; number < face_count; ++number) {
    const Face face(number);
    m_is_frozen.push_back(is_frozen[triangle(face)]);
    if (is_own(face)) {
      const auto& [a, b, c] = corners(face);
      triangles.push_back({positions[vertex_of(a)], positions[vertex_of(b)], positions[vertex_of(c)]});
      for (Index i = 1; i < ply_count(face) && m_is_frozen[face] == 0; ++i)
        m_is_frozen[face] = is_frozen[triangle(face, i)];
      if (has_doubles(face))
        m_constraints.multiplicities.emplace_back(face, ply_count(face));
    } else {
      const auto& [a, b, c] = obstacle.triangles[triangle(face) - own_triangles];
      triangles.push_back(
          {positions[own_vertices + a], positions[own_vertices + b], positions[own_vertices + c]});
      m_constraints.uncounted_faces.push_back(face);
    }
  }
  if (std::none_of(m_is_frozen.begin(), m_is_frozen.end(),
                   [](char is_frozen_face) { return is_frozen_face; }))
    m_is_frozen = {};
  return triangles;
}

void Sewn_mesh::note_vertices(const std::vector<Index>& positions)
{
  const std::vector<char> is_used = are_used(soup());
  for (Index v = 0; v < is_used.size(); ++v) {
    m_notes.unused_vertices += !is_used[v];
    m_notes.coincident_vertices += is_used[v] && positions[v] != v && is_used[positions[v]];
  }
}

void Sewn_mesh::find_misoriented(const Sewing& sewing)
{
  if (sewing.misoriented_sides().empty())
    return;
  m_is_misoriented.assign(soup().points.size(), false);
  for (const Index side : sewing.misoriented_sides()) {
    if (side / 3 >= own_face_count())
      continue;
    m_misoriented_sides.push_back(3 * triangle(Face(side / 3)) + side % 3);
    for (const Corner end : {side, Sewing::next(side)})
      m_is_misoriented[vertex_of(corners(Face(end / 3))[end % 3])] = true;
  }
  if (!m_misoriented_sides.empty()) {
    const std::vector<Index> piece_of = part_kinds(soup()).front().of_triangle;
    std::set<Index> pieces;
    for (const Index side : m_misoriented_sides)
      pieces.insert(piece_of[side / 3]);
    m_notes.misoriented_pieces = pieces.size();
  }
}

// Makes lines of the edges across which corners differ. `halfedges` are those of the sides.
void Sewn_mesh::find_lines(const Sewing& sewing, const std::vector<Halfedge>& halfedges)
{
  find_regions();
  std::vector<char> is_line(mesh().number_of_edges(), false);
  tbb::parallel_for(Index(0), Index(is_line.size()), [&](Index number) {
    const Mesh::Edge_index e(number);
    is_line[number] = !mesh().is_border(e) && is_own(mesh().face(mesh().halfedge(e))) && differences(e).any();
  });
  for (Index side = 0; side < 3 * own_face_count(); ++side)
    if (const auto e = mesh().edge(halfedges[side]); side < sewing.mate(side) && is_line[e])
      m_constraints.line_edges.push_back(e);
  m_notes.seam_edges = m_constraints.line_edges.size();
}

// Takes the spokes out of the lines, across which corners differ at one end only.
void Sewn_mesh::find_spokes()
{
  for (const Mesh::Edge_index e : std::exchange(m_constraints.line_edges, {})) {
    const Halfedge h = mesh().halfedge(e), other = mesh().opposite(h);
    const bool differ_here = differences_at_target(h).any(),
               differ_there = differences_at_target(other).any();
    if (differ_here == differ_there || differences(e).in_doubles)
      m_constraints.line_edges.push_back(e);
    else
      m_constraints.spokes.push_back(differ_here ? h : other);
  }
}

void Sewn_mesh::lock(const std::vector<char>& is_locked)
{
  for (Index v = 0; v < is_locked.size(); ++v)
    if (is_locked[v])
      m_constraints.locked_vertices.push_back(Mesh::Vertex_index(v));
}

// Locks the vertices of frozen faces, and those that share a position and cannot move together.
void Sewn_mesh::find_locked(const Sewing& sewing, const std::vector<Index>& position_of,
                            const std::vector<Index>& vertices_at)
{
  std::vector<char> is_locked, is_in_frozen_face(position_of.size(), false),
      moves_alone(position_of.size(), false);
  for (const Index position : position_of)
    is_locked.push_back(vertices_at[position] > 1);
  for (Corner corner = 0; corner < sewing.side_count(); ++corner) {
    const Face face(corner / 3);
    const Index v = sewing.vertex(corner);
    is_in_frozen_face[v] |= frozen(face);
    moves_alone[v] |=
        is_in_frozen_face[v] ||
        (has_doubles(face) && !have_plies_one_vertex(face, static_cast<unsigned char>(corner % 3)));
  }
  find_joint_vertices(is_locked, moves_alone, vertices_at, position_of);
  for (Index v = 0; v < is_locked.size(); ++v)
    is_locked[v] |= is_in_frozen_face[v];
  lock(is_locked);
}

// Finds the positions where several sheets meet along a line that comes from one position and goes on to
// another, and unlocks their vertices: one on the border of each sheet, which all move together. A vertex of
// an obstacle is in a frozen face.
void Sewn_mesh::find_joint_vertices(std::vector<char>& is_locked, const std::vector<char>& is_in_frozen_face,
                                    const std::vector<Index>& vertices_at,
                                    const std::vector<Index>& position_of)
{
  struct Place_on_line
  {
    Index first_end, second_end; // the positions between which it lies
    std::vector<Mesh::Vertex_index> vertices;
    bool is_inside = true;
  };
  std::map<Index, Place_on_line> places; // by position
  for (Index v = 0; v < is_locked.size(); ++v) {
    if (vertices_at[position_of[v]] < 2)
      continue;
    const Halfedge border = mesh().halfedge(Mesh::Vertex_index(v)); // or an inner one, if none
    const auto ends =
        std::minmax({position_of[mesh().source(border)], position_of[mesh().target(mesh().next(border))]});
    const auto [place, is_new] =
        places.try_emplace(position_of[v], Place_on_line{ends.first, ends.second, {}});
    place->second.vertices.push_back(Mesh::Vertex_index(v));
    place->second.is_inside = place->second.is_inside && mesh().is_border(border) && !is_in_frozen_face[v] &&
                              ends.first != ends.second && ends.first == place->second.first_end &&
                              ends.second == place->second.second_end;
  }
  for (auto& [position, place] : places)
    if (place.is_inside) {
      for (const Mesh::Vertex_index v : place.vertices)
        is_locked[v] = false;
      m_constraints.joint_vertices.push_back(std::move(place.vertices));
    }
}

// Finds the ends of lines that a reader of the log may not see: those where the mesh is cut for the sake of
// non-manifold places, and those of normals, which may be made anew.
void Sewn_mesh::find_no_strip_vertices(const std::vector<Index>& position_of)
{
  const auto add = [this](Halfedge h) {
    m_constraints.no_strip_vertices.push_back(mesh().source(h));
    m_constraints.no_strip_vertices.push_back(mesh().target(h));
  };
  const auto is_unseen = [this](Halfedge h) {
    const Differences differ = differences(mesh().edge(h));
    return !differ.in_vertex && !differ.in_uv && !differ.in_label && !differ.in_region;
  };
  for (const Mesh::Edge_index e : m_constraints.line_edges)
    if (is_unseen(mesh().halfedge(e)))
      add(mesh().halfedge(e));
  for (const Halfedge h : m_constraints.spokes)
    if (is_unseen(h))
      m_constraints.no_strip_vertices.push_back(mesh().target(h));
  std::vector<std::pair<std::pair<Index, Index>, Halfedge>> borders; // by the ends' positions
  for (const Halfedge h : mesh().halfedges())
    if (mesh().is_border(h))
      borders.push_back({std::minmax({position_of[mesh().source(h)], position_of[mesh().target(h)]}), h});
  std::sort(borders.begin(), borders.end());
  for (std::size_t i = 1; i < borders.size(); ++i)
    if (borders[i - 1].first == borders[i].first) {
      add(borders[i - 1].second);
      add(borders[i].second);
    }
}

void Sewn_mesh::lock_by_wish(const std::vector<Index>& vertices, const std::vector<Index>& positions)
{
  if (vertices.empty())
    return;
  std::vector<char> is_wished(positions.size(), false); // by position
  for (const Index vertex : vertices) {
    if (vertex >= soup().points.size())
      throw Argument_error("vertex " + std::to_string(vertex) + " cannot be locked: the mesh has " +
                           std::to_string(soup().points.size()) + " vertices, counted from 0");
    is_wished[positions[vertex]] = true;
  }
  m_is_wished.assign(mesh().number_of_vertices(), false);
  for (const Face face : mesh().faces())
    if (is_own(face))
      for (const Halfedge h : mesh().halfedges_around_face(mesh().halfedge(face)))
        m_is_wished[mesh().target(h)] |= is_wished[positions[vertex_of(corner_at(h))]];
  std::vector<char> is_new = m_is_wished;
  for (const Mesh::Vertex_index v : m_constraints.locked_vertices)
    is_new[v] = false;
  lock(is_new);
}

void Sewn_mesh::weigh(const std::vector<double>& weights)
{
  m_constraints.vertex_weights.assign(mesh().number_of_vertices(), 0);
  for (const Halfedge h : mesh().halfedges()) {
    if (mesh().is_border(h) || !is_own(mesh().face(h)))
      continue;
    double& weight = m_constraints.vertex_weights[mesh().target(h)];
    for (Index i = 0; i < ply_count(mesh().face(h)); ++i)
      weight = (std::max)(weight, weights[vertex_of(corner_at(h, i))]);
  }
}

std::vector<Index> Sewn_mesh::vertices_of_soup(const Triangle_soup& obstacle) const
{
  std::vector<Index> result(mesh().number_of_vertices());
  for (const Halfedge h : mesh().halfedges()) {
    if (mesh().is_border(h))
      continue;
    const Face face = mesh().face(h);
    result[mesh().target(h)] =
        is_own(face) ? vertex_of(corner_at(h))
                     : Index(soup().points.size()) +
                           obstacle.triangles[triangle(face) - soup().triangles.size()][place(h)];
  }
  return result;
}

// A locked vertex keeps its position and its frozen faces, so that its reason is the same at any time.
Hindrance Sewn_mesh::lock_reason(Mesh::Vertex_index v) const
{
  Hindrance reason = !m_is_wished.empty() && m_is_wished[v] ? Hindrance::locked : Hindrance::non_manifold;
  for (const Halfedge h : mesh().halfedges_around_target(mesh().halfedge(v))) {
    if (mesh().is_border(h) || !is_own(mesh().face(h)))
      continue;
    if (const char how = frozen(mesh().face(h)); how != 0)
      reason = (std::min)(reason, how == by_wish ? Hindrance::locked : Hindrance::frozen);
    else if (reason == Hindrance::non_manifold && !m_is_misoriented.empty() &&
             m_is_misoriented[vertex_of(corner_at(h))])
      reason = Hindrance::misoriented;
    else if (!m_is_held_elsewhere.empty() && m_is_held_elsewhere[vertex_of(corner_at(h))])
      return Hindrance::companions;
  }
  return reason;
}

// Looks at what differs now. Where nothing does any more, the line counts as a seam. Where only normals and
// vertex numbers differ, the numbers are taken to be those of a file that writes a vertex for each normal.
Hindrance Sewn_mesh::line_reason(Mesh::Edge_index e) const
{
  const Differences differ = differences(e);
  const bool is_of_group = differ.in_label || differ.in_region;
  if (differ.in_normal && !is_of_group && !differ.in_uv)
    return Hindrance::normals;
  if (differ.in_vertex || differ.in_doubles || !differ.any())
    return Hindrance::seam;
  return is_of_group ? Hindrance::group : Hindrance::texture;
}

} // namespace selvedge
