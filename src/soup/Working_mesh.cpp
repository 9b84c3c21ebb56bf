// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Working_mesh.h"

#include "Gltf_scene.h"
#include "Sewing.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/internal/inflated.h>
#include <selvedge/rounding.h>

#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace selvedge {
namespace {

constexpr Index s_none = Sewing::none;
constexpr double s_place_unit = 0x1p-45, s_place_beyond = 0x1p6; // of coordinates of new places

/// The point of a triangle that is nearest to another point.
struct Nearest_point
{
  std::array<double, 3> weights; ///< of the corners
  double squared_distance;
};

// Computed in floating point, in the order of the corners given (Ericson: Real-Time Collision Detection,
// section 5.1.5).
Nearest_point nearest_point(const std::array<internal::Vector_of_doubles, 3>& corners,
                            const internal::Vector_of_doubles& p)
{
  using internal::difference;
  using internal::dot;
  const auto& [a, b, c] = corners;
  const auto ab = difference(b, a), ac = difference(c, a), ap = difference(p, a), bp = difference(p, b),
             cp = difference(p, c);
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  const double of_c = d1 * d4 - d3 * d2, of_b = d5 * d2 - d1 * d6, of_a = d3 * d6 - d5 * d4;
  std::array<double, 3> weights{};
  if (d1 <= 0 && d2 <= 0)
    weights = {1, 0, 0};
  else if (d3 >= 0 && d4 <= d3)
    weights = {0, 1, 0};
  else if (d6 >= 0 && d5 <= d6)
    weights = {0, 0, 1};
  else if (of_c <= 0 && d1 >= 0 && d3 <= 0)
    weights = {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  else if (of_b <= 0 && d2 >= 0 && d6 <= 0)
    weights = {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  else if (of_a <= 0 && d4 >= d3 && d5 >= d6)
    weights = {0, 1 - (d4 - d3) / (d4 - d3 + d5 - d6), (d4 - d3) / (d4 - d3 + d5 - d6)};
  else {
    const double sum = of_a + of_b + of_c;
    weights = {1 - of_b / sum - of_c / sum, of_b / sum, of_c / sum};
  }
  internal::Vector_of_doubles off;
  for (std::size_t i = 0; i < 3; ++i)
    off[i] = p[i] - (weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i]);
  return {weights, dot(off, off)};
}

} // namespace

Working_mesh::Working_mesh(const Triangle_soup& soup, const std::vector<Index>& positions,
                           const std::vector<char>& is_frozen, const Triangle_soup& obstacle,
                           const Scale& scale, const std::vector<char>& is_turned,
                           const std::vector<Index>& fronts)
    : m_soup(soup), m_scale(scale), m_is_turned(is_turned)
{
  const Index own_vertices = Index(soup.points.size());
  std::vector<Index_triple> triangles; // of positions
  std::vector<Index> faces;            // their numbers in the mesh
  std::vector<char> is_used(soup.points.size(), false);
  triangles.reserve(soup.triangles.size() + obstacle.triangles.size());
  m_corners.reserve(soup.triangles.size());
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    const Index_triple& v = soup.triangles[t];
    m_corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    for (const Index i : v)
      is_used[i] = true;
    if (!fronts.empty() && fronts[t] != t)
      continue;
    faces.push_back(t);
    triangles.push_back({positions[v[0]], positions[v[1]], positions[v[2]]});
    if (!is_turned.empty() && is_turned[t]) {
      turn(m_corners.back());
      turn(triangles.back());
    }
  }
  const Index own_corners = Index(3 * triangles.size()); // of faces
  m_is_frozen.assign(is_frozen.begin(), is_frozen.begin() + std::ptrdiff_t(soup.triangles.size()));
  find_plies(fronts, positions);
  for (Index v = 0; v < is_used.size(); ++v) {
    m_notes.unused_vertices += !is_used[v];
    m_notes.coincident_vertices += is_used[v] && positions[v] != v && is_used[positions[v]];
  }
  for (const auto& [a, b, c] : obstacle.triangles) {
    faces.push_back(Index(soup.triangles.size() + triangles.size()) - own_corners / 3);
    m_constraints.uncounted_faces.emplace_back(faces.back());
    triangles.push_back(
        {positions[own_vertices + a], positions[own_vertices + b], positions[own_vertices + c]});
  }

  const Index corner_count = Index(3 * triangles.size());

  const auto own_corner = [&](Index corner) { return m_corners[faces[corner / 3]][corner % 3]; };
  const Sewing sewing(triangles, own_corners, Index(positions.size()), m_notes);
  Cancellation_scope::check();
  std::vector<Corner> corner_of(sewing.vertex_count()); // the first corner of each vertex
  for (Corner corner = corner_count; corner-- > 0;)
    corner_of[sewing.vertex(corner)] = corner;
  const std::vector<Mesh::Halfedge_index> halfedges = make_mesh(sewing, faces, [&](Index vertex) {
    const Corner corner = corner_of[vertex];
    if (corner < own_corners)
      return scale(soup.points[vertex_of(own_corner(corner))]);
    const Corner beside = corner - own_corners;
    return scale(obstacle.points[obstacle.triangles[beside / 3][beside % 3]]);
  });

  std::vector<Index> vertices_at(positions.size(), 0); // the number of vertices, by position
  const auto position_of = [&](Index vertex) {
    return triangles[corner_of[vertex] / 3][corner_of[vertex] % 3];
  };
  const auto count_vertices = [&](Index vertex, Corner beyond) {
    for (; vertex < corner_of.size() && corner_of[vertex] < beyond; ++vertex)
      ++vertices_at[position_of(vertex)];
    return vertex;
  };
  const Index first_of_obstacle = count_vertices(0, own_corners);
  m_notes.unsewn_positions =
      std::count_if(vertices_at.begin(), vertices_at.end(), [](Index count) { return count > 1; });
  count_vertices(first_of_obstacle, corner_count);
  std::vector<char> is_locked(corner_of.size(), false);
  for (Index v = 0; v < is_locked.size(); ++v)
    is_locked[v] = vertices_at[position_of(v)] > 1;
  std::vector<char> is_in_frozen_face(corner_of.size(), false), moves_alone(corner_of.size(), false);
  for (Corner corner = 0; corner < corner_count; ++corner) {
    const Mesh::Face_index face(faces[corner / 3]);
    is_in_frozen_face[sewing.vertex(corner)] |= is_own(face) ? m_is_frozen[face] : is_frozen[face];
    moves_alone[sewing.vertex(corner)] |= is_in_frozen_face[sewing.vertex(corner)] || has_doubles(face);
  }
  find_joint_vertices(is_locked, moves_alone, vertices_at, position_of);
  for (Index v = 0; v < is_locked.size(); ++v)
    is_locked[v] |= is_in_frozen_face[v];
  lock(is_locked);
  m_is_misoriented.assign(soup.points.size(), false);
  for (const Index side : sewing.misoriented_sides()) {
    if (side >= own_corners)
      continue;
    m_misoriented_sides.push_back(3 * faces[side / 3] + side % 3);
    for (const Corner end : {side, Sewing::next(side)})
      m_is_misoriented[vertex_of(own_corner(end))] = true;
  }
  if (!m_misoriented_sides.empty()) {
    const std::vector<Index> piece_of = part_kinds(soup).front().of_triangle;
    std::set<Index> pieces;
    for (const Index side : m_misoriented_sides)
      pieces.insert(piece_of[side / 3]);
    m_notes.misoriented_pieces = pieces.size();
  }

  Cancellation_scope::check();
  for (Index side = 0; side < own_corners; ++side) {
    const Index mate = sewing.mate(side);
    if (mate != s_none && side < mate && differences(m_mesh.edge(halfedges[side])).any())
      m_constraints.line_edges.push_back(m_mesh.edge(halfedges[side]));
  }
  m_notes.seam_edges = m_constraints.line_edges.size();
  find_no_strip_vertices(position_of);

  if (!obstacle.triangles.empty()) { // the limits are shares of the diagonal of the soup alone
    CGAL::Bbox_3 box;
    for (const Index_triple& triangle : soup.triangles)
      for (const Index i : triangle)
        box += scale(soup.points[i]).bbox();
    m_constraints.diagonal =
        std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  }
}

Working_mesh::Working_mesh(const Working_mesh& whole, const Border_rule<Mesh>& rule,
                           const std::vector<Index>& faces)
    : m_soup(whole.m_soup), m_scale(whole.m_scale), m_values(whole.m_values),
      m_have_places_float32_digits(whole.m_have_places_float32_digits),
      m_is_scale_lossless(whole.m_is_scale_lossless), m_are_places_in_scene(whole.m_are_places_in_scene)
{
  const Mesh& mesh = whole.m_mesh;
  std::vector<Mesh::Halfedge_index> originals; // by side
  std::vector<Index> mates;
  std::vector<Index> cut; // sides whose mates are not in the part
  for (const Index face : faces) {
    if (whole.is_own(Mesh::Face_index(face)))
      m_corners.push_back(whole.m_corners[face]);
    else
      m_constraints.uncounted_faces.push_back(Mesh::Face_index(Index(originals.size() / 3)));
    for (unsigned char place = 0; place < 3; ++place) {
      originals.push_back(whole.halfedge({face, place, false}));
      mates.push_back(s_none);
      const Mesh::Halfedge_index opposite = mesh.opposite(originals.back());
      if (mesh.is_border(opposite))
        continue;
      const Side beyond = whole.side(opposite);
      const auto found = std::lower_bound(faces.begin(), faces.end(), beyond.triangle);
      if (found != faces.end() && *found == beyond.triangle)
        mates.back() = Index(3 * (found - faces.begin())) + beyond.place;
      else
        cut.push_back(Index(mates.size() - 1));
    }
  }

  if (!whole.m_first_ply.empty()) {
    m_first_ply.assign(1, 0);
    for (Index i = 0; i < m_corners.size(); ++i) {
      const Mesh::Face_index face(faces[i]);
      if (whole.has_doubles(face))
        for (Index k = 0; k < whole.ply_count(face); ++k)
          m_plies.push_back(whole.ply(face, k));
      m_first_ply.push_back(Index(m_plies.size()));
    }
  }

  const Sewing sewing(std::move(mates));
  std::vector<Index> numbers(faces.size());
  std::iota(numbers.begin(), numbers.end(), Index(0));
  std::vector<Mesh::Vertex_index> vertices(sewing.vertex_count()); // of the whole
  for (Index side = 0; side < originals.size(); ++side)
    vertices[sewing.vertex(side)] = mesh.source(originals[side]);
  const std::vector<Mesh::Halfedge_index> halfedges =
      make_mesh(sewing, numbers, [&](Index vertex) { return mesh.point(vertices[vertex]); });

  std::vector<char> is_locked(vertices.size(), false);
  for (Index v = 0; v < vertices.size(); ++v)
    is_locked[v] = rule.is_locked(vertices[v]);
  for (Index v = 0; v < vertices.size(); ++v)
    if (rule.bounds_no_strip(vertices[v]))
      m_constraints.no_strip_vertices.emplace_back(v);
  for (const Index side : cut)
    is_locked[sewing.vertex(side)] = is_locked[sewing.vertex(Sewing::next(side))] = true;
  lock(is_locked);
  for (Index side = 0; side < originals.size(); ++side)
    if (sewing.mate(side) != s_none && side < sewing.mate(side) && rule.is_line(mesh.edge(originals[side])))
      m_constraints.line_edges.push_back(m_mesh.edge(halfedges[side]));
  if (!whole.m_constraints.vertex_weights.empty())
    for (const Mesh::Vertex_index v : vertices)
      m_constraints.vertex_weights.push_back(whole.m_constraints.vertex_weights[v]);
  measure_uvs(whole.m_uv_unit);
}

void Working_mesh::lock(const std::vector<char>& is_locked)
{
  for (Index v = 0; v < is_locked.size(); ++v)
    if (is_locked[v])
      m_constraints.locked_vertices.push_back(Mesh::Vertex_index(v));
}

// Finds the positions where several sheets meet along a line that comes from one position and goes on to
// another, and unlocks their vertices: one on the border of each sheet, which all move together. A vertex of
// an obstacle is in a frozen face.
template <class Function>
void Working_mesh::find_joint_vertices(std::vector<char>& is_locked,
                                       const std::vector<char>& is_in_frozen_face,
                                       const std::vector<Index>& vertices_at, const Function& position_of)
{
  struct Place_on_line
  {
    Index first_end, second_end; // the positions between which it lies
    std::vector<Mesh::Vertex_index> vertices;
    bool is_inside = true;
  };
  std::map<Index, Place_on_line> places; // by position
  for (Index v = 0; v < is_locked.size(); ++v) {
    if (vertices_at[position_of(v)] < 2)
      continue;
    const Mesh::Halfedge_index border = m_mesh.halfedge(Mesh::Vertex_index(v)); // or an inner one, if none
    const auto ends =
        std::minmax({position_of(m_mesh.source(border)), position_of(m_mesh.target(m_mesh.next(border)))});
    const auto [place, is_new] =
        places.try_emplace(position_of(v), Place_on_line{ends.first, ends.second, {}});
    place->second.vertices.push_back(Mesh::Vertex_index(v));
    place->second.is_inside = place->second.is_inside && m_mesh.is_border(border) && !is_in_frozen_face[v] &&
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
template <class Function>
void Working_mesh::find_no_strip_vertices(const Function& position_of)
{
  const auto add = [this](Mesh::Halfedge_index h) {
    m_constraints.no_strip_vertices.push_back(m_mesh.source(h));
    m_constraints.no_strip_vertices.push_back(m_mesh.target(h));
  };
  for (const Mesh::Edge_index e : m_constraints.line_edges)
    if (const Differences differ = differences(e); !differ.in_vertex && !differ.in_uv && !differ.in_label)
      add(m_mesh.halfedge(e));
  std::vector<std::pair<std::pair<Index, Index>, Mesh::Halfedge_index>> borders; // by the ends' positions
  for (const Mesh::Halfedge_index h : m_mesh.halfedges())
    if (m_mesh.is_border(h))
      borders.push_back({std::minmax({position_of(m_mesh.source(h)), position_of(m_mesh.target(h))}), h});
  std::sort(borders.begin(), borders.end());
  for (std::size_t i = 1; i < borders.size(); ++i)
    if (borders[i - 1].first == borders[i].first) {
      add(borders[i - 1].second);
      add(borders[i].second);
    }
}

void Working_mesh::lock_by_wish(const std::vector<Index>& vertices, const std::vector<Index>& positions)
{
  if (vertices.empty())
    return;
  std::vector<char> is_wished(positions.size(), false); // by position
  for (const Index vertex : vertices) {
    if (vertex >= m_soup.points.size())
      throw Argument_error("vertex " + std::to_string(vertex) + " cannot be locked: the mesh has " +
                           std::to_string(m_soup.points.size()) + " vertices, counted from 0");
    is_wished[positions[vertex]] = true;
  }
  m_is_wished.assign(m_mesh.number_of_vertices(), false);
  for (const Mesh::Face_index face : m_mesh.faces())
    if (is_own(face))
      for (const Mesh::Halfedge_index h : m_mesh.halfedges_around_face(m_mesh.halfedge(face)))
        m_is_wished[m_mesh.target(h)] |= is_wished[positions[vertex_of(corner_at(h))]];
  std::vector<char> is_new = m_is_wished;
  for (const Mesh::Vertex_index v : m_constraints.locked_vertices)
    is_new[v] = false;
  lock(is_new);
}

// Makes vertices, edges in the order of the sides, and faces, of the numbers `faces`, which ascend. Returns
// the halfedge of each side. `Surface_mesh::add_face` would make the same, but has to search for what is
// known here.
template <class Function>
std::vector<Working_mesh::Mesh::Halfedge_index>
Working_mesh::make_mesh(const Sewing& sewing, const std::vector<Index>& faces, const Function& point_of)
{
  using Halfedge = Mesh::Halfedge_index;
  const Index side_count = sewing.side_count();
  const auto vertex = [&](Index corner) { return Mesh::Vertex_index(sewing.vertex(corner)); };
  Index edge_count = 0;
  for (Index side = 0; side < side_count; ++side)
    edge_count += side < sewing.mate(side);
  m_mesh.reserve(sewing.vertex_count(), edge_count, side_count / 3);
  for (Index v = 0; v < sewing.vertex_count(); ++v)
    m_mesh.add_vertex(point_of(v));
  std::vector<Halfedge> halfedges(side_count);
  for (Index side = 0; side < side_count; ++side) {
    const Index mate = sewing.mate(side), end = Sewing::next(side);
    halfedges[side] =
        side < mate ? m_mesh.add_edge(vertex(side), vertex(end)) : m_mesh.opposite(halfedges[mate]);
    m_mesh.set_halfedge(vertex(end), halfedges[side]);
  }
  std::vector<Halfedge> border_from(m_mesh.number_of_vertices());
  std::vector<Mesh::Face_index> unused; // a mesh gives removed numbers to the faces that it makes next
  for (Index side = 0; side < side_count; ++side) {
    if (side % 3 == 0) {
      Mesh::Face_index face = m_mesh.add_face();
      for (; face < Mesh::Face_index(faces[side / 3]); face = m_mesh.add_face())
        unused.push_back(face);
      m_mesh.set_halfedge(face, halfedges[Sewing::previous(side)]);
    }
    m_mesh.set_face(halfedges[side], Mesh::Face_index(faces[side / 3]));
    m_mesh.set_next(halfedges[side], halfedges[Sewing::next(side)]);
    if (sewing.mate(side) == s_none)
      border_from[vertex(Sewing::next(side))] = m_mesh.opposite(halfedges[side]);
  }
  for (Index side = 0; side < side_count; ++side) {
    if (sewing.mate(side) != s_none)
      continue;
    const Halfedge border = m_mesh.opposite(halfedges[side]);
    m_mesh.set_halfedge(vertex(side), border); // by this, CGAL sees at once that the vertex is on a border
    m_mesh.set_next(border, border_from[vertex(side)]);
  }
  for (const Mesh::Face_index face : unused)
    m_mesh.remove_face(face);
  m_places.resize(m_mesh.number_of_halfedges());
  for (Index side = 0; side < side_count; ++side)
    m_places[halfedges[side]] = Sewing::next(side) % 3;
  return halfedges;
}

namespace {

// Returns, for each element, the number of the first that is equal.
template <class Element>
std::vector<std::ptrdiff_t> first_equal(const std::vector<Element>& elements)
{
  std::vector<std::ptrdiff_t> first;
  for (const Element& element : elements)
    first.push_back(std::find(elements.begin(), elements.end(), element) - elements.begin());
  return first;
}

// Compares values and not their numbers, since a file may write a value twice.
template <class Values>
bool differ(const Values& corners, Index a, Index b)
{
  return !corners.empty() && corners.values[corners.of_triangle[a / 3][a % 3]] !=
                                 corners.values[corners.of_triangle[b / 3][b % 3]];
}

} // namespace

Working_mesh::Differences Working_mesh::differences(Corner a, Corner b) const
{
  const auto differ_in_label = [&](const Triangle_labels& labels) {
    return !labels.empty() && labels.of_triangle[a / 3] != labels.of_triangle[b / 3];
  };
  return {vertex_of(a) != vertex_of(b), differ(m_soup.uvs, a, b), differ(m_soup.normals, a, b),
          differ_in_label(m_soup.groups) || differ_in_label(m_soup.objects) ||
              differ_in_label(m_soup.materials)};
}

Working_mesh::Differences& Working_mesh::Differences::operator|=(const Differences& other)
{
  in_vertex |= other.in_vertex;
  in_uv |= other.in_uv;
  in_normal |= other.in_normal;
  in_label |= other.in_label;
  in_doubles |= other.in_doubles;
  return *this;
}

Working_mesh::Differences Working_mesh::differences(Mesh::Edge_index e) const
{
  const Mesh::Halfedge_index h = m_mesh.halfedge(e), other = m_mesh.opposite(h);
  const Mesh::Face_index face = m_mesh.face(h), beyond = m_mesh.face(other);
  const Index plies = ply_count(face), plies_beyond = ply_count(beyond);
  Differences result;
  result.in_doubles = plies != plies_beyond;
  for (Index i = 0; i < (std::min)(plies, plies_beyond); ++i) {
    result |= differences(corner_at(h, i), corner_at(m_mesh.prev(other), i));
    result |= differences(corner_at(m_mesh.prev(h), i), corner_at(other, i));
    if (plies > 1 && plies_beyond > 1)
      result.in_doubles |= ply(face, i).is_against_face() != ply(beyond, i).is_against_face();
  }
  return result;
}

// Finds the triangles for which each front stands. Those that run as the face does come first, so that
// their order is the same in all faces of one surface, in whatever order the soup has them.
void Working_mesh::find_plies(const std::vector<Index>& fronts, const std::vector<Index>& positions)
{
  if (fronts.empty())
    return;
  const auto position_of = [&](Corner corner) { return positions[vertex_of(corner)]; };
  m_first_ply.assign(fronts.size() + 1, 0);
  for (Index t = 0; t < fronts.size(); ++t)
    if (fronts[t] != t) {
      m_first_ply[fronts[t] + 1] += m_first_ply[fronts[t] + 1] == 0 ? 2 : 1;
      if (m_is_frozen[fronts[t]] == 0)
        m_is_frozen[fronts[t]] = m_is_frozen[t];
    }
  std::partial_sum(m_first_ply.begin(), m_first_ply.end(), m_first_ply.begin());
  m_plies.resize(m_first_ply.back());
  std::vector<Index> next = m_first_ply;
  for (Index t = 0; t < fronts.size(); ++t) {
    const Mesh::Face_index face(fronts[t]);
    if (!has_doubles(face))
      continue;
    Ply& ply = m_plies[next[face]++];
    ply.triangle = t;
    for (unsigned char k = 0; k < 3; ++k)
      for (unsigned char place = 0; place < 3; ++place)
        if (position_of(3 * t + place) == position_of(m_corners[face][k])) {
          ply.places[k] = place;
          ply.corners[k] = 3 * t + place;
        }
  }
  for (Index t = 0; t < fronts.size(); ++t)
    if (const Mesh::Face_index face(t); has_doubles(face)) {
      const auto first = m_plies.begin() + m_first_ply[t];
      std::stable_partition(first, m_plies.begin() + m_first_ply[t + 1],
                            [](const Ply& ply) { return !ply.is_against_face(); });
      m_corners[t] = first->corners;
      m_constraints.multiplicities.emplace_back(face, ply_count(face));
    }
}

// A locked vertex keeps its position and its frozen faces, so that its reason is the same at any time.
Hindrance Working_mesh::lock_reason(Mesh::Vertex_index v) const
{
  Hindrance reason = !m_is_wished.empty() && m_is_wished[v] ? Hindrance::locked : Hindrance::non_manifold;
  for (const Mesh::Halfedge_index h : m_mesh.halfedges_around_target(m_mesh.halfedge(v))) {
    if (m_mesh.is_border(h) || !is_own(m_mesh.face(h)))
      continue;
    if (const char frozen = m_is_frozen[m_mesh.face(h)]; frozen != 0)
      reason = (std::min)(reason, frozen == by_wish ? Hindrance::locked : Hindrance::frozen);
    else if (reason == Hindrance::non_manifold && m_is_misoriented[vertex_of(corner_at(h))])
      reason = Hindrance::misoriented;
    else if (!m_is_held_elsewhere.empty() && m_is_held_elsewhere[vertex_of(corner_at(h))])
      return Hindrance::companions;
  }
  return reason;
}

void Working_mesh::on_hindered(Mesh::Edge_index e, Hindrance reason)
{
  m_hindrances.resize(m_corners.size());
  for (const Mesh::Halfedge_index h : {m_mesh.halfedge(e), m_mesh.opposite(m_mesh.halfedge(e))})
    if (!m_mesh.is_border(h) && is_own(m_mesh.face(h)))
      m_hindrances[m_mesh.face(h)][m_places[h]] = reason;
}

// A face can go by any of its edges. If all its corners are locked, its edges were not asked for.
Hindrance Working_mesh::hindrance_of(Mesh::Face_index face) const
{
  std::optional<Hindrance> weakest;
  for (const std::optional<Hindrance>& reason : m_hindrances[face])
    weakest = (std::max)(weakest, reason);
  return weakest ? *weakest : lock_reason(m_mesh.target(m_mesh.halfedge(face)));
}

// The same side, of the same triangle, in another place of its mesh. Where one of the two faces is turned
// over, its halfedges run the other way.
Working_mesh::Side Working_mesh::in_place(const Side& side, Index place) const
{
  const Copy& copy = m_copies[side.triangle];
  const Index image = m_shared[copy.mesh].places[place].triangles[copy.row];
  if (is_flipped(side.triangle) == is_flipped(image))
    return {image, side.place, side.is_beyond};
  return {image, static_cast<unsigned char>(2 - side.place), !side.is_beyond};
}

bool Working_mesh::is_flipped(Index face) const
{
  const Copy& copy = m_copies[face];
  return m_shared[copy.mesh].places[copy.place].is_mirrored != (!m_is_turned.empty() && m_is_turned[face]);
}

void Working_mesh::share(std::vector<Shared_mesh> meshes, double clearance)
{
  m_clearance = clearance;
  m_shared = std::move(meshes);
  if (m_shared.empty())
    return;
  m_copies.assign(m_corners.size(), {s_no_mesh, 0, 0});
  for (Index m = 0; m < m_shared.size(); ++m) {
    std::vector<Shared_mesh::Place>& places = m_shared[m].places;
    std::vector<std::pair<CGAL::Bbox_3, Index>> boxes;
    for (Index p = 0; p < places.size(); ++p) {
      CGAL::Bbox_3 box;
      for (Index row = 0; row < places[p].triangles.size(); ++row) {
        const Mesh::Face_index face(places[p].triangles[row]);
        m_copies[face] = {m, p, row};
        if (!has_face(face))
          continue;
        for (const Mesh::Vertex_index v : m_mesh.vertices_around_face(m_mesh.halfedge(face)))
          box += m_mesh.point(v).bbox();
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
  lock_in_all_places();
}

// Whether the faces on both sides of an edge belong to one place of a mesh.
bool Working_mesh::is_sewn_inside(Mesh::Halfedge_index h) const
{
  const Mesh::Face_index a = m_mesh.face(h), b = m_mesh.face(m_mesh.opposite(h));
  return is_own(b) && m_copies[a].mesh == m_copies[b].mesh && m_copies[a].place == m_copies[b].place;
}

// Locks the vertices that would have to move with others at their positions as well as in other places.
void Working_mesh::lock_joint_vertices_of_shared_meshes()
{
  auto& groups = m_constraints.joint_vertices;
  const auto is_at_shared_face = [this](Mesh::Vertex_index v) {
    const auto faces = m_mesh.faces_around_target(m_mesh.halfedge(v));
    return std::any_of(faces.begin(), faces.end(), [this](Mesh::Face_index f) {
      return f != Mesh::null_face() && is_own(f) && is_shared(f);
    });
  };
  const auto beyond = std::stable_partition(groups.begin(), groups.end(), [&](const auto& group) {
    return std::none_of(group.begin(), group.end(), is_at_shared_face);
  });
  for (auto group = beyond; group != groups.end(); ++group)
    m_constraints.locked_vertices.insert(m_constraints.locked_vertices.end(), group->begin(), group->end());
  groups.erase(beyond, groups.end());
}

void Working_mesh::lock_in_all_places()
{
  lock_joint_vertices_of_shared_meshes();
  std::vector<char> is_locked(m_mesh.number_of_vertices(), false);
  for (const Mesh::Vertex_index v : m_constraints.locked_vertices)
    is_locked[v] = true;
  m_is_held_elsewhere.assign(m_soup.points.size(), false);
  const auto lock_source = [&](Mesh::Halfedge_index h) {
    const Mesh::Vertex_index v = m_mesh.source(h);
    if (std::exchange(is_locked[v], true))
      return;
    m_constraints.locked_vertices.push_back(v);
    for (const Mesh::Halfedge_index in : m_mesh.halfedges_around_target(m_mesh.opposite(h)))
      if (!m_mesh.is_border(in) && is_own(m_mesh.face(in)))
        m_is_held_elsewhere[vertex_of(corner_at(in))] = true;
  };
  Cancellation_poll poll;
  for (const Shared_mesh& shared : m_shared)
    for (const Index face : shared.places.front().triangles)
      for (unsigned char place = 0; place < 3 && has_face(Mesh::Face_index(face)); ++place) {
        poll();
        const Side here = {face, place, false};
        const Mesh::Halfedge_index h = halfedge(here), beyond = m_mesh.opposite(h);
        const bool is_border = m_mesh.is_border(beyond);
        // Nothing that is sewn to other faces in some place can move alike in all.
        bool is_alike = is_border || is_sewn_inside(h), is_held = is_locked[m_mesh.source(h)];
        std::vector<Mesh::Halfedge_index> images = {h};
        for (Index p = 1; p < shared.places.size(); ++p) {
          const Mesh::Halfedge_index image = halfedge(in_place(here, p));
          images.push_back(image);
          is_held |= is_locked[m_mesh.source(image)];
          if (is_alike)
            is_alike = is_border ? m_mesh.is_border(m_mesh.edge(image))
                                 : halfedge(in_place(side(beyond), p)) == m_mesh.opposite(image);
        }
        for (const Mesh::Halfedge_index image : images) {
          if (!is_alike || is_held)
            lock_source(image);
          if (!is_alike)
            lock_source(m_mesh.opposite(image));
        }
      }
}

std::vector<Working_mesh::Mesh::Halfedge_index> Working_mesh::companions(Mesh::Halfedge_index moving) const
{
  std::vector<Mesh::Halfedge_index> result;
  if (m_shared.empty())
    return result;
  const Side here = side(moving);
  if (!is_shared(Mesh::Face_index(here.triangle)))
    return result;
  const Copy& copy = m_copies[here.triangle];
  for (Index p = 0; p < m_shared[copy.mesh].places.size(); ++p)
    if (p != copy.place)
      result.push_back(halfedge(in_place(here, p)));
  return result;
}

bool Working_mesh::is_led_from_elsewhere(Mesh::Halfedge_index edge) const
{
  const Side here = side(edge);
  return is_shared(Mesh::Face_index(here.triangle)) && m_copies[here.triangle].place > 0;
}

bool Working_mesh::are_companions_apart(Mesh::Halfedge_index moving,
                                        const std::vector<Mesh::Halfedge_index>& companions) const
{
  const Copy& copy = m_copies[side(moving).triangle];
  const auto& near = m_near_places[copy.mesh];
  if (near.empty())
    return true;
  std::vector<CGAL::Bbox_3> boxes(companions.size() + 1); // of stars, by place
  const auto set_box = [&](Mesh::Halfedge_index h) {
    CGAL::Bbox_3& box = boxes[m_copies[side(h).triangle].place];
    for (const Mesh::Halfedge_index in : m_mesh.halfedges_around_target(m_mesh.opposite(h)))
      box += m_mesh.point(m_mesh.source(in)).bbox();
    box += m_mesh.point(m_mesh.source(h)).bbox();
  };
  set_box(moving);
  for (const Mesh::Halfedge_index companion : companions)
    set_box(companion);
  return std::none_of(near.begin(), near.end(), [&](const auto& pair) {
    return CGAL::do_overlap(internal::inflated(boxes[pair.first], m_clearance), boxes[pair.second]);
  });
}

// Looks at what differs now. Where nothing does any more, the line counts as a seam. Where only normals and
// vertex numbers differ, the numbers are taken to be those of a file that writes a vertex for each normal.
Hindrance Working_mesh::line_reason(Mesh::Edge_index e) const
{
  const Differences differ = differences(e);
  if (differ.in_normal && !differ.in_label && !differ.in_uv)
    return Hindrance::normals;
  if (differ.in_vertex || differ.in_doubles || !differ.any())
    return Hindrance::seam;
  return differ.in_label ? Hindrance::group : Hindrance::texture;
}

// Calls function(h, from) for each face that a motion changes. The corner at the target of h, a halfedge of
// this face, becomes the corner at the target of `from`, a halfedge of a contracted face.
template <class Function>
void Working_mesh::for_each_changed_face(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule,
                                         const Function& function) const
{
  // Walks from a contracted face, away from the other one, up to the next line. Returns whether it comes to
  // the other one without meeting a line. The rule is asked, because it knows more lines than corners show:
  // the corners on both sides of a line may become equal.
  const auto goes_all_the_way = [&](Mesh::Halfedge_index from, Mesh::Halfedge_index other,
                                    const auto& across) {
    if (m_mesh.is_border(from))
      return false;
    const Mesh::Halfedge_index carried = halfedges_to_ends(moving, from).second;
    for (Mesh::Halfedge_index h = across(from); m_mesh.face(h) != m_mesh.face(other); h = across(h)) {
      if (rule.is_line(m_mesh.edge(h)))
        return false;
      function(from == moving ? m_mesh.prev(h) : h, carried);
    }
    return true;
  };
  const Mesh::Halfedge_index back = m_mesh.opposite(moving);
  if (!goes_all_the_way(moving, back,
                        [this](Mesh::Halfedge_index h) { return m_mesh.opposite(m_mesh.prev(h)); }))
    goes_all_the_way(back, moving,
                     [this](Mesh::Halfedge_index h) { return m_mesh.opposite(m_mesh.next(h)); });
}

Working_mesh::Side Working_mesh::side(Mesh::Halfedge_index h) const
{
  const bool is_beyond = m_mesh.is_border(h);
  const Mesh::Halfedge_index own = is_beyond ? m_mesh.opposite(h) : h;
  return {m_mesh.face(own), m_places[m_mesh.prev(own)], is_beyond};
}

Working_mesh::Mesh::Halfedge_index Working_mesh::halfedge(const Side& side) const
{
  const Mesh::Face_index face(side.triangle);
  if (!has_face(face))
    throw std::logic_error("a side of a face that is gone");
  Mesh::Halfedge_index h = m_mesh.halfedge(face);
  for (int i = 0; i < 3; ++i, h = m_mesh.next(h))
    if (m_places[m_mesh.prev(h)] == side.place)
      return side.is_beyond ? m_mesh.opposite(h) : h;
  throw std::logic_error("a side that its face does not have");
}

void Working_mesh::before_collapse(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule)
{
  if (m_recorder)
    m_recorder({side(moving), std::nullopt});
  const auto [removed, kept] = ends_in_soup(moving);
  if (m_listener)
    m_listener({removed, kept, std::nullopt});
  m_placed.erase(removed); // no corner has its number any more
  carry(moving, rule);
}

// Returns the vertices of the soup at both ends of a motion, in one face beside it.
std::pair<Index, Index> Working_mesh::ends_in_soup(Mesh::Halfedge_index moving) const
{
  const auto [to_mover, to_goal] =
      halfedges_to_ends(moving, m_mesh.is_border(moving) ? m_mesh.opposite(moving) : moving);
  return {vertex_of(corner_at(to_mover)), vertex_of(corner_at(to_goal))};
}

// Gives the corners that move the corners of the goal.
void Working_mesh::carry(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule)
{
  record_moves(moving);
  for_each_moved_wedge(moving, [&](Index from, Index to) {
    const Wedge& gone = m_wedges[from];
    Wedge& merged = m_wedges[to];
    merged.quadric += gone.quadric.moved_by(along(moving), gone.uv_motion(merged.uv));
  });
  for_each_changed_face(moving, rule, [this](Mesh::Halfedge_index h, Mesh::Halfedge_index from) {
    const Mesh::Face_index face = m_mesh.face(h);
    m_corners[face][m_places[h]] = corner_at(from);
    for (Index i = 1; i < ply_count(face); ++i)
      m_plies[m_first_ply[face] + i].corners[m_places[h]] = corner_at(from, i);
    if (!m_wedges.empty())
      wedge_at(h) = wedge_at(from);
  });
  carry_places(moving);
}

void Working_mesh::before_placement(Mesh::Halfedge_index moving, const Point_3& place, bool is_mover_first)
{
  const Mesh::Halfedge_index to_mover = m_mesh.prev(moving), to_goal = moving;
  const Corner corner = corner_at(to_goal);
  const Index removed = vertex_of(corner_at(to_mover)), kept = vertex_of(corner);
  const Point_3 point = m_scale.undone(place);
  if (m_recorder)
    m_recorder({side(moving), place, is_mover_first});
  if (m_listener)
    m_listener({removed, kept, std::array{point.x(), point.y(), point.z()}, is_mover_first});
  const Mixture mixture = mixture_at(moving, place);
  Vertex_values::Numbers values = m_values->mixed(mixture.shares, mixture.own);
  for_each_moved_wedge(moving, [&](Index from, Index to) {
    // No line meets a vertex at a new place, so that there is one wedge at either end.
    const Wedge& gone = m_wedges[from];
    Wedge& merged = m_wedges[to];
    const Uv uv = at_unit(m_values->uv(values));
    merged.quadric = merged.quadric.moved_by(motion(m_mesh.target(moving), place), merged.uv_motion(uv));
    merged.quadric += gone.quadric.moved_by(motion(m_mesh.source(moving), place), gone.uv_motion(uv));
    merged.uv = uv;
  });
  for (const Mesh::Halfedge_index h : m_mesh.halfedges_around_target(to_mover)) {
    m_corners[m_mesh.face(h)][m_places[h]] = corner;
    if (!m_wedges.empty())
      wedge_at(h) = wedge_at(to_goal);
  }
  m_placed.erase(removed);
  m_placed[kept] = {point, std::move(values)};
  carry_places(moving);
}

void Working_mesh::allow_new_places(bool is_float32)
{
  m_values = std::make_shared<Vertex_values>(m_soup);
  m_are_places_in_scene = m_soup.scene && !is_float32;
  m_have_places_float32_digits = is_float32 || (!m_are_places_in_scene && has_float32_digits(m_soup));
  // Whether every coordinate that `rounded_place` may choose is a number of its type after all. A multiple of
  // the unit with as many digits as the type has is one also below the normal numbers.
  const double unit = m_scale.undone(s_place_unit), beyond = m_scale.undone(s_place_beyond);
  using Doubles = std::numeric_limits<double>;
  using Floats = std::numeric_limits<float>;
  m_is_scale_lossless = is_float32 ? unit >= Floats::denorm_min() && beyond <= Floats::max()
                                   : unit >= Doubles::denorm_min() && beyond <= Doubles::max();
}

// At the scale, the largest coordinate of the mesh is about 1. Coordinates of places are multiples of a small
// unit, so that a mesh and its multiple have the same places even where digits are lost near 0.
internal::Optional<Point_3> Working_mesh::rounded_place(Mesh::Halfedge_index edge, const Point_3& place) const
{
  const Mesh::Face_index face(side(edge).triangle);
  if (!m_values || !m_is_scale_lossless || is_shared(face) || has_doubles(face))
    return {};
  std::array<double, 3> rounded;
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(place[i]) < s_place_beyond))
      return {};
    constexpr double digits = 1.5 * 0x1p52 * s_place_unit; // a sum with it has no digits below the unit
    const double sum = place[i] + digits;
    rounded[i] = sum - digits;
    if (m_have_places_float32_digits)
      rounded[i] = nearest_float32(rounded[i]); // has as many digits after multiplication by the scale
  }
  Point_3 result(rounded[0], rounded[1], rounded[2]);
  if (m_are_places_in_scene) {
    const Gltf_scene& scene = *m_soup.scene;
    const std::size_t instance = scene.instance_of(m_soup.scene_vertices[vertex_of(corner_at(edge))]);
    const auto in_node = nearest_world_position(scene.instances[instance].to_world, m_scale.undone(result));
    if (!in_node)
      return {};
    result = m_scale(*in_node);
    if (m_scale.undone(result) != *in_node)
      return {};
  }
  if (m_is_place_allowed && !m_is_place_allowed(result))
    return {};
  return result;
}

Vertex_values::Share Working_mesh::share(Corner corner, double weight) const
{
  const auto placed = m_placed.find(vertex_of(corner));
  return {corner, weight, placed == m_placed.end() ? nullptr : &placed->second.values};
}

// Returns the mixture that the faces around both ends of an edge have at the point nearest to a place. The
// result does not depend on the order of halfedges around a vertex, so that it is the same in a cell and in
// the whole.
Working_mesh::Mixture Working_mesh::mixture_at(Mesh::Halfedge_index moving, const Point_3& place) const
{
  const Vertex_values::Share own = share(corner_at(moving), 1);
  if (m_values->is_empty())
    return {{own, share(own.corner, 0), share(own.corner, 0)}, own};
  const auto vector = [](const Point_3& p) { return internal::Vector_of_doubles{p.x(), p.y(), p.z()}; };
  std::optional<Nearest_point> nearest;
  Mesh::Face_index face;
  for (const Mesh::Halfedge_index end : {moving, m_mesh.opposite(moving)})
    for (const Mesh::Halfedge_index h : m_mesh.halfedges_around_target(end)) {
      std::array<internal::Vector_of_doubles, 3> corners;
      for (const Mesh::Halfedge_index g : {h, m_mesh.next(h), m_mesh.prev(h)})
        corners[m_places[g]] = vector(m_mesh.point(m_mesh.target(g)));
      const Nearest_point here = nearest_point(corners, vector(place));
      if (!nearest || std::make_pair(here.squared_distance, m_mesh.face(h)) <
                          std::make_pair(nearest->squared_distance, face)) {
        nearest = here;
        face = m_mesh.face(h);
      }
    }
  const auto share_of = [&](std::size_t k) { return share(m_corners[face][k], nearest->weights[k]); };
  return {{share_of(0), share_of(1), share_of(2)}, own};
}

// Called before a collapse, for what it does to the edges of contracted faces.
void Working_mesh::carry_places(Mesh::Halfedge_index moving)
{
  // Each contracted face takes the edge before h with it. The edge after h takes the place of that edge in
  // the face beyond it.
  for (const Mesh::Halfedge_index h : {moving, m_mesh.opposite(moving)})
    if (!m_mesh.is_border(h))
      m_places[m_mesh.next(h)] = m_places[m_mesh.opposite(m_mesh.prev(h))];
}

void Working_mesh::on_refused(Mesh::Halfedge_index moving, const Refusals& refusals)
{
  const Mesh::Face_index face = m_mesh.face(m_mesh.is_border(moving) ? m_mesh.opposite(moving) : moving);
  if (!is_own(face))
    return;
  for (std::size_t kind = 0; kind < m_kinds.size(); ++kind)
    m_refused[kind][m_kinds[kind].of_triangle[face]] += refusals;
}

void Working_mesh::count_refusals(std::vector<Part_kind> kinds)
{
  m_kinds = std::move(kinds);
  m_refused.clear();
  for (const Part_kind& kind : m_kinds)
    m_refused.emplace_back(kind.count);
}

std::vector<Index> Working_mesh::vertices_of_soup(const Triangle_soup& obstacle) const
{
  std::vector<Index> result(m_mesh.number_of_vertices());
  for (const Mesh::Halfedge_index h : m_mesh.halfedges()) {
    if (m_mesh.is_border(h))
      continue;
    const Mesh::Face_index face = m_mesh.face(h);
    result[m_mesh.target(h)] =
        is_own(face) ? vertex_of(corner_at(h))
                     : Index(m_soup.points.size()) + obstacle.triangles[face - m_corners.size()][m_places[h]];
  }
  return result;
}

void Working_mesh::weigh(const std::vector<double>& weights)
{
  m_constraints.vertex_weights.assign(m_mesh.number_of_vertices(), 0);
  for (const Mesh::Halfedge_index h : m_mesh.halfedges()) {
    if (m_mesh.is_border(h) || !is_own(m_mesh.face(h)))
      continue;
    double& weight = m_constraints.vertex_weights[m_mesh.target(h)];
    for (Index i = 0; i < ply_count(m_mesh.face(h)); ++i)
      weight = (std::max)(weight, weights[vertex_of(corner_at(h, i))]);
  }
}

bool Working_mesh::keeps_pieces(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule) const
{
  // At each end of an edge, a line is open (a border, or vertices of different numbers on the two sides) or
  // closed. Runs of open vertices are boundary loops of pieces, or stretches of such loops. So none may
  // vanish, and no two may meet.
  const auto is_open_at_end = [this](Mesh::Halfedge_index h) {
    const Mesh::Halfedge_index other = m_mesh.opposite(h);
    return m_mesh.is_border(h) || m_mesh.is_border(other) ||
           vertex_of(corner_at(h)) != vertex_of(corner_at(m_mesh.prev(other)));
  };
  const auto is_on_boundary = [&](Mesh::Vertex_index v) {
    const auto around = m_mesh.halfedges_around_target(m_mesh.halfedge(v));
    return std::any_of(around.begin(), around.end(), [&](Mesh::Halfedge_index h) {
      return is_open_at_end(h) || is_open_at_end(m_mesh.opposite(h));
    });
  };
  const Mesh::Halfedge_index back = m_mesh.opposite(moving);
  if (has_doubles(m_mesh.face(moving)) || has_doubles(m_mesh.face(back)))
    return keeps_pieces_of_doubles(moving, rule);
  if (!rule.is_line(m_mesh.edge(moving)))
    return true;
  const bool is_open_ahead = is_open_at_end(moving), is_open = is_open_at_end(back);
  for (const Mesh::Halfedge_index h : m_mesh.halfedges_around_target(back)) {
    if (h == back || !rule.is_line(m_mesh.edge(h)))
      continue;
    const bool is_open_behind = is_open_at_end(m_mesh.opposite(h));
    if (is_open_behind == is_open_ahead)
      return is_open == is_open_ahead;
    // A run ends here. If the moving vertex is its closed end, the next vertex becomes the end instead, and
    // must not be on another run.
    return is_open || !is_on_boundary(is_open_ahead ? m_mesh.source(h) : m_mesh.target(moving));
  }
  return true;
}

// The triangles beside an edge must have vertices in common at the goal just where they have them at the
// mover and, on a line, at the vertex behind it. Those of a contracted face must be one, with all three
// vertices in common, just where those of its neighbours are and, on a line, those beside the edge behind. So
// as many vertices, edges and faces of pieces go as without doubles, and what replaces them has as many
// faces.
bool Working_mesh::keeps_pieces_of_doubles(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule) const
{
  const auto common_vertices = [this](Mesh::Halfedge_index h, bool is_at_target) {
    const Mesh::Halfedge_index other = m_mesh.opposite(h);
    std::vector<Index> vertices;
    for (const Mesh::Halfedge_index corner :
         {is_at_target ? h : m_mesh.prev(h), is_at_target ? m_mesh.prev(other) : other}) {
      vertices.push_back(s_none);
      if (const Mesh::Face_index face = m_mesh.face(corner); !m_mesh.is_border(corner) && is_own(face))
        for (Index i = 0; i < ply_count(face); ++i)
          vertices.push_back(vertex_of(corner_at(corner, i)));
    }
    return first_equal(vertices);
  };
  const auto common_faces = [this](Mesh::Halfedge_index side) {
    std::vector<Index_triple> triangles; // of vertices, in ascending order
    const Mesh::Face_index face = m_mesh.face(side);
    if (m_mesh.is_border(side) || !is_own(face))
      return first_equal(triangles);
    for (Index i = 0; i < ply_count(face); ++i) {
      const auto& [a, b, c] = corners(face, i);
      triangles.push_back({vertex_of(a), vertex_of(b), vertex_of(c)});
      std::sort(triangles.back().begin(), triangles.back().end());
    }
    return first_equal(triangles);
  };
  const auto at_mover = common_vertices(moving, false);
  if (at_mover != common_vertices(moving, true))
    return false;
  for (const Mesh::Halfedge_index side : {moving, m_mesh.opposite(moving)})
    for (const Mesh::Halfedge_index h : {m_mesh.next(side), m_mesh.prev(side)})
      if (!m_mesh.is_border(m_mesh.edge(h)) && !rule.is_line(m_mesh.edge(h)) && !m_mesh.is_border(side) &&
          common_faces(h) != common_faces(m_mesh.opposite(h)))
        return false;
  if (!rule.is_line(m_mesh.edge(moving)))
    return true;
  for (const Mesh::Halfedge_index h : m_mesh.halfedges_around_target(m_mesh.opposite(moving)))
    if (h != m_mesh.opposite(moving) && rule.is_line(m_mesh.edge(h)) &&
        (at_mover != common_vertices(h, false) || common_faces(moving) != common_faces(h) ||
         common_faces(m_mesh.opposite(moving)) != common_faces(m_mesh.opposite(h))))
      return false;
  return true;
}

// Sheets that have one vertex in common where they move must also have one ahead and one behind on their
// line, and only those: where they come apart, the line of a piece ends.
bool Working_mesh::keeps_joints(Mesh::Halfedge_index moving,
                                const std::vector<Mesh::Halfedge_index>& others) const
{
  using Place = std::array<Index, 3>; // vertices of the soup on a line: at the mover, ahead and behind
  std::vector<Place> places;
  const auto add = [&](Mesh::Halfedge_index h) {
    const auto [mover, ahead] = ends_in_soup(h);
    const bool is_border = m_mesh.is_border(h);
    const Mesh::Halfedge_index to_next =
        m_mesh.opposite(is_border ? m_mesh.prev(h) : m_mesh.next(m_mesh.opposite(h)));
    places.push_back({mover, ahead, vertex_of(corner_at(is_border ? to_next : m_mesh.prev(to_next)))});
  };
  add(moving);
  std::for_each(others.begin(), others.end(), add);
  for (const Place& a : places)
    for (const Place& b : places)
      if ((a[0] == b[0]) != (a[1] == b[1]) || (a[0] == b[0]) != (a[2] == b[2]))
        return false;
  return true;
}

Working_mesh::Uv Working_mesh::uv_at(Corner corner) const
{
  if (!m_placed.empty())
    if (const auto placed = m_placed.find(vertex_of(corner)); placed != m_placed.end())
      return m_values->uv(placed->second.values);
  return uv_of(corner);
}

// Returns the orientation that a triangle would have in the texture with other coordinates at one corner.
CGAL::Orientation Working_mesh::uv_orientation(const Index_triple& corners, unsigned char place,
                                               const Uv& uv) const
{
  std::array<Kernel::Point_2, 3> points;
  for (unsigned char k = 0; k < 3; ++k) {
    const Uv here = k == place ? uv : uv_at(corners[k]);
    points[k] = {here[0], here[1]};
  }
  return CGAL::orientation(points[0], points[1], points[2]);
}

bool Working_mesh::keeps_uv_orientation(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule) const
{
  if (m_soup.uvs.empty())
    return true;
  bool is_kept = true;
  for_each_changed_face(moving, rule, [&](Mesh::Halfedge_index h, Mesh::Halfedge_index from) {
    for (Index i = 0; is_kept && i < ply_count(m_mesh.face(h)); ++i)
      is_kept = keeps_uv_orientation_of(h, i, uv_at(corner_at(from, i)));
  });
  return is_kept;
}

bool Working_mesh::keeps_uv_orientation_at(Mesh::Halfedge_index moving, const Point_3& place) const
{
  if (m_soup.uvs.empty())
    return true;
  const Mixture mixture = mixture_at(moving, place);
  const Uv uv = m_values->mixed_uv(mixture.shares, mixture.own);
  const Mesh::Halfedge_index back = m_mesh.opposite(moving);
  for (const Mesh::Halfedge_index end : {moving, back})
    for (const Mesh::Halfedge_index h : m_mesh.halfedges_around_target(end))
      if (m_mesh.face(h) != m_mesh.face(moving) && m_mesh.face(h) != m_mesh.face(back) &&
          !keeps_uv_orientation_of(h, 0, uv))
        return false;
  return true;
}

// Whether a triangle of a face keeps its orientation in the texture when its corner at the target of h gets
// other coordinates.
bool Working_mesh::keeps_uv_orientation_of(Mesh::Halfedge_index h, Index ply, const Uv& uv) const
{
  const Index_triple& all = corners(m_mesh.face(h), ply);
  const CGAL::Orientation before = uv_orientation(all, m_places[h], uv_at(all[m_places[h]]));
  return before == CGAL::COLLINEAR || uv_orientation(all, m_places[h], uv) == before;
}

Uv_quadric::Vector Working_mesh::along(Mesh::Halfedge_index h) const
{
  return motion(m_mesh.source(h), m_mesh.point(m_mesh.target(h)));
}

// Returns how a vertex moves when it goes to a place.
Uv_quadric::Vector Working_mesh::motion(Mesh::Vertex_index v, const Point_3& place) const
{
  const Point_3& p = m_mesh.point(v);
  return {place.x() - p.x(), place.y() - p.y(), place.z() - p.z()};
}

Working_mesh::Uv Working_mesh::at_unit(const Uv& uv) const
{
  return {uv[0] * m_uv_unit, uv[1] * m_uv_unit};
}

void Working_mesh::measure_uvs(double unit)
{
  if (m_soup.uvs.empty() || m_corners.empty() || !(unit > 0))
    return;
  m_uv_unit = unit;

  Wedge_numbers numbers = number_wedges();
  const std::vector<Mesh::Vertex_index>& vertices = numbers.vertices;
  m_wedge_numbers = std::move(numbers.of_face);
  m_wedges.assign(vertices.size(), {});
  std::vector<Index> wedges_at(m_mesh.number_of_vertices(), 0);
  for (const Mesh::Vertex_index v : vertices)
    ++wedges_at[v];
  for (std::size_t i = 0; i < vertices.size(); ++i)
    m_wedges[i].is_alone = wedges_at[vertices[i]] == 1;
  Cancellation_poll poll;
  for (const Mesh::Face_index face : m_mesh.faces()) {
    poll();
    if (!is_own(face))
      break; // the faces of the obstacle come last
    std::array<Uv_quadric::Vector, 3> points;
    std::array<Uv, 3> uvs;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3 p = m_scale(m_soup.points[vertex_of(m_corners[face][k])]);
      points[k] = {p.x(), p.y(), p.z()};
      uvs[k] = at_unit(uv_of(m_corners[face][k]));
    }
    const Uv_quadric of_face(points, uvs, 1);
    for (std::size_t k = 0; k < 3; ++k) {
      const Index number = m_wedge_numbers[face][k];
      m_wedges[number].uv = uvs[k];
      m_wedges[number].quadric +=
          m_constraints.vertex_weights.empty()
              ? of_face
              : Uv_quadric(points, uvs, m_constraints.vertex_weights[vertices[number]]);
    }
  }
}

Working_mesh::Wedge_numbers Working_mesh::number_wedges() const
{
  std::vector<char> is_line(m_mesh.number_of_edges(), false);
  for (const Mesh::Edge_index e : m_constraints.line_edges)
    is_line[e] = true;
  Wedge_numbers result;
  result.of_face.assign(m_corners.size(), {s_none, s_none, s_none});
  const auto number_at = [&](Mesh::Halfedge_index h) -> Index& {
    return result.of_face[m_mesh.face(h)][m_places[h]];
  };
  for (const Mesh::Halfedge_index first : m_mesh.halfedges()) {
    const auto is_numbered = [&](Mesh::Halfedge_index h) {
      return m_mesh.is_border(h) || !is_own(m_mesh.face(h)) || number_at(h) != s_none;
    };
    if (is_numbered(first))
      continue;
    const auto number = [&](Mesh::Halfedge_index h) { number_at(h) = Index(result.vertices.size()); };
    // Walks around the vertex in both directions, until it meets the first face, a line or a border.
    number(first);
    for (Mesh::Halfedge_index h = first; !is_line[m_mesh.edge(m_mesh.next(h))];) {
      h = m_mesh.opposite(m_mesh.next(h));
      if (is_numbered(h))
        break;
      number(h);
    }
    for (Mesh::Halfedge_index h = first; !is_line[m_mesh.edge(h)];) {
      h = m_mesh.prev(m_mesh.opposite(h));
      if (is_numbered(h))
        break;
      number(h);
    }
    result.vertices.push_back(m_mesh.target(first));
  }
  return result;
}

// The plies of a face have wedges of their own. Those of one wedge of the mesh follow each other: all its
// faces have as many plies, in one order.
void Working_mesh::record_progression(Progression& progression)
{
  m_progression = &progression;
  const Wedge_numbers numbers = number_wedges();
  std::vector<Index> first(numbers.vertices.size() + 1, 0); // by wedge of the mesh
  const auto for_each_corner = [&](const auto& function) {
    for (const Mesh::Face_index face : m_mesh.faces())
      for (std::size_t place = 0; place < 3 && is_own(face); ++place)
        function(face, place, numbers.of_face[face][place]);
  };
  for_each_corner(
      [&](Mesh::Face_index face, std::size_t, Index wedge) { first[wedge + 1] = ply_count(face); });
  std::partial_sum(first.begin(), first.end(), first.begin());
  progression = {};
  progression.wedges.resize(m_soup.triangles.size());
  for_each_corner([&](Mesh::Face_index face, std::size_t place, Index wedge) {
    for (Index i = 0; i < ply_count(face); ++i) {
      const Corner corner = corners(face, i)[place];
      progression.wedges[corner / 3][corner % 3] = first[wedge] + i;
    }
  });
}

// A contracted face has a corner in each wedge that moves, and one in the wedge to which that goes.
void Working_mesh::record_moves(Mesh::Halfedge_index moving)
{
  if (!m_progression)
    return;
  auto& [wedges, moves, steps] = *m_progression;
  const auto begin = std::ptrdiff_t(steps.empty() ? 0 : steps.back()); // of the moves of this step
  for (const Mesh::Halfedge_index side : {moving, m_mesh.opposite(moving)}) {
    if (m_mesh.is_border(side) || !is_own(m_mesh.face(side)))
      continue;
    const auto [to_mover, to_goal] = halfedges_to_ends(moving, side);
    for (Index i = 0; i < ply_count(m_mesh.face(side)); ++i) {
      const Corner from = corner_at(to_mover, i), to = corner_at(to_goal, i);
      const Progression::Move move = {wedges[from / 3][from % 3], wedges[to / 3][to % 3]};
      if (std::none_of(moves.begin() + begin, moves.end(),
                       [&](const Progression::Move& other) { return other.from == move.from; }))
        moves.push_back(move);
    }
  }
}

void Working_mesh::after_step()
{
  if (m_progression)
    m_progression->steps.push_back(m_progression->moves.size());
}

// Calls function(from, to) with the wedges at both ends of a motion, once for each side of a line along it.
template <class Function>
void Working_mesh::for_each_moved_wedge(Mesh::Halfedge_index moving, const Function& function) const
{
  if (m_wedges.empty())
    return;
  Index done = s_none;
  for (const Mesh::Halfedge_index h : {moving, m_mesh.opposite(moving)}) {
    if (m_mesh.is_border(h))
      continue;
    const auto [from, to] = halfedges_to_ends(moving, h);
    const Index wedge = wedge_at(from);
    if (wedge != done)
      function(wedge, wedge_at(to));
    if (m_wedges[wedge].is_alone)
      return;
    done = wedge;
  }
}

double Working_mesh::uv_cost(Mesh::Halfedge_index moving) const
{
  double cost = 0;
  for_each_moved_wedge(moving, [&](Index from, Index to) {
    const Wedge& wedge = m_wedges[from];
    cost += wedge.quadric(along(moving), wedge.uv_motion(m_wedges[to].uv));
  });
  return std::max(0.0, cost); // rounding may leave a sum slightly below zero
}

double Working_mesh::uv_cost_at(Mesh::Halfedge_index edge, const Point_3& place) const
{
  double cost = 0;
  for_each_moved_wedge(edge, [&](Index from, Index to) {
    const Wedge &first = m_wedges[from], &second = m_wedges[to];
    const Uv uv_motion = first.uv_motion(second.uv);
    Uv_quadric sum = first.quadric.moved_by(along(edge), uv_motion);
    sum += second.quadric;
    cost += first.quadric(along(edge), uv_motion) + sum.least(motion(m_mesh.target(edge), place));
  });
  return std::max(0.0, cost);
}

Working_mesh::Result Working_mesh::result() const
{
  Result result;
  struct Left
  {
    Index triangle;
    Mesh::Face_index face;
    Index ply;
  };
  std::vector<Left> left;
  for (const Mesh::Face_index face : m_mesh.faces()) {
    if (!is_own(face))
      break; // the faces of the obstacle come last
    for (Index i = 0; i < ply_count(face); ++i)
      left.push_back({has_doubles(face) ? ply(face, i).triangle : Index(face), face, i});
  }
  if (!m_plies.empty())
    std::sort(left.begin(), left.end(), [](const Left& a, const Left& b) { return a.triangle < b.triangle; });
  for (const auto& [triangle, face, i] : left) {
    Index_triple of_triangle = corners(face, i);
    if (has_doubles(face))
      for (std::size_t k = 0; k < 3; ++k)
        of_triangle[ply(face, i).places[k]] = corners(face, i)[k];
    else if (!m_is_turned.empty() && m_is_turned[face])
      turn(of_triangle);
    result.triangles.push_back(triangle);
    result.corners.push_back(of_triangle);
    if (!m_hindrances.empty())
      result.held_by.push_back(hindrance_of(face));
  }
  Cancellation_scope::check();
  result.soup = selected(m_soup, result.triangles, result.corners);
  if (m_placed.empty())
    return result;
  const std::vector<Point_3> points_before = result.soup.points;
  Vertex_values::Of_vertices values(result.soup.points.size(), nullptr);
  for (std::size_t t = 0; t < result.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto placed = m_placed.find(vertex_of(result.corners[t][k])); placed != m_placed.end()) {
        const Index vertex = result.soup.triangles[t][k];
        result.placed_vertices += !values[vertex];
        result.soup.points[vertex] = placed->second.point;
        values[vertex] = &placed->second.values;
      }
  forget_moved_polygons(result.soup, points_before);
  m_values->put(values, result.soup);
  return result;
}

} // namespace selvedge
