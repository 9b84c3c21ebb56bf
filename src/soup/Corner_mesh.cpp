// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Corner_mesh.h"

#include "Sewing.h"
#include "number_positions.h"
#include "regions.h"
#include "selection.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string_view>

namespace selvedge {

Corner_mesh::Corner_mesh(const Triangle_soup& soup, const std::vector<Index>& positions,
                         const std::vector<char>& is_turned, const std::vector<Index>& fronts,
                         const std::vector<Index>& triangles)
    : m_soup(soup), m_triangles(triangles)
{
  m_corners.reserve(triangles.size());
  for (const Index t : triangles) {
    if (t >= soup.triangles.size())
      break; // those of the obstacle come last
    m_corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    if (is_turned.empty())
      continue;
    m_is_turned.push_back(is_turned[t]);
    if (is_turned[t])
      turn(m_corners.back());
  }
  find_plies(fronts, positions);
}

Corner_mesh::Corner_mesh(const Corner_mesh& whole, const std::vector<Index>& faces)
    : m_soup(whole.m_soup), m_regions(whole.m_regions)
{
  if (!whole.m_first_ply.empty())
    m_first_ply.assign(1, 0);
  std::vector<Index> triangles;
  for (const Index number : faces) {
    const Face face(number);
    triangles.push_back(whole.m_triangles[face]);
    if (!whole.is_own(face))
      continue;
    m_corners.push_back(whole.m_corners[face]);
    if (whole.m_first_ply.empty())
      continue;
    m_plies.insert(m_plies.end(), whole.m_plies.begin() + whole.m_first_ply[face],
                   whole.m_plies.begin() + whole.m_first_ply[face + 1]);
    m_first_ply.push_back(Index(m_plies.size()));
  }
  m_triangles = internal::Packed_numbers(triangles);
}

std::vector<Corner_mesh::Face> Corner_mesh::faces_of_triangles() const
{
  std::vector<Face> result(m_soup.triangles.size() + m_triangles.size() - own_face_count());
  for (Index face = 0; face < m_triangles.size(); ++face)
    result[m_triangles[face]] = Face(face);
  return result;
}

// Finds the triangles for which each front stands. Those that run as the face does come first, so that
// their order is the same in all faces of one surface, in whatever order the soup has them.
void Corner_mesh::find_plies(const std::vector<Index>& fronts, const std::vector<Index>& positions)
{
  if (fronts.empty())
    return;
  const auto position_of = [&](Corner corner) { return positions[vertex_of(corner)]; };
  const std::vector<Face> face_of = faces_of_triangles();
  m_first_ply.assign(own_face_count() + 1, 0);
  for (Index t = 0; t < fronts.size(); ++t)
    if (fronts[t] != t) {
      Index& count = m_first_ply[face_of[fronts[t]] + 1];
      count += count == 0 ? 2 : 1;
    }
  std::partial_sum(m_first_ply.begin(), m_first_ply.end(), m_first_ply.begin());
  m_plies.resize(m_first_ply.back());
  std::vector<Index> next = m_first_ply;
  for (Index t = 0; t < fronts.size(); ++t) {
    const Face face = face_of[fronts[t]];
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
  for (Index face = 0; face < own_face_count(); ++face)
    if (has_doubles(Face(face))) {
      const auto first = m_plies.begin() + m_first_ply[face];
      std::stable_partition(first, m_plies.begin() + m_first_ply[face + 1],
                            [](const Ply& ply) { return !ply.is_against_face(); });
      m_corners[face] = first->corners;
    }
}

// `Surface_mesh::add_face` would make the same, but has to search for what is known here.
std::vector<Corner_mesh::Halfedge> Corner_mesh::build(const Sewing& sewing,
                                                      const std::function<Point_3(Index)>& point_of)
{
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
  for (Index side = 0; side < side_count; ++side) {
    if (side % 3 == 0)
      m_mesh.set_halfedge(m_mesh.add_face(), halfedges[Sewing::previous(side)]);
    m_mesh.set_face(halfedges[side], Face(side / 3));
    m_mesh.set_next(halfedges[side], halfedges[Sewing::next(side)]);
    if (sewing.mate(side) == Sewing::none)
      border_from[vertex(Sewing::next(side))] = m_mesh.opposite(halfedges[side]);
  }
  for (Index side = 0; side < side_count; ++side) {
    if (sewing.mate(side) != Sewing::none)
      continue;
    const Halfedge border = m_mesh.opposite(halfedges[side]);
    m_mesh.set_halfedge(vertex(side), border); // by this, CGAL sees at once that the vertex is on a border
    m_mesh.set_next(border, border_from[vertex(side)]);
  }
  m_places.resize(m_mesh.number_of_halfedges());
  for (Index side = 0; side < side_count; ++side)
    m_places[halfedges[side]] = Sewing::next(side) % 3;
  return halfedges;
}

void Corner_mesh::find_regions()
{
  if (m_soup.triangle_attributes.empty())
    return;
  std::vector<Index> regions;
  for (const Attribute* attribute : attributes_of_regions(m_soup, number_positions(m_soup.points))) {
    regions.resize(m_soup.triangles.size(), 0);
    std::map<std::pair<Index, std::string_view>, Index> numbers;
    for (Index t = 0; t < regions.size(); ++t)
      regions[t] = numbers.emplace(std::make_pair(regions[t], row_of(*attribute, t)), Index(numbers.size()))
                       .first->second;
  }
  if (!regions.empty())
    m_regions = std::make_shared<const std::vector<Index>>(std::move(regions));
}

Index_triple Corner_mesh::corners_in_soup(Face face, Index i) const
{
  Index_triple result = corners(face, i);
  if (has_doubles(face))
    for (std::size_t k = 0; k < 3; ++k)
      result[ply(face, i).places[k]] = corners(face, i)[k];
  else if (is_turned(face))
    turn(result);
  return result;
}

std::pair<Index, Index> Corner_mesh::ends_in_soup(Halfedge moving) const
{
  const auto [to_mover, to_goal] = halfedges_to_ends(moving, with_face(moving));
  return {vertex_of(corner_at(to_mover)), vertex_of(corner_at(to_goal))};
}

Corner_mesh::Side Corner_mesh::side(Halfedge h) const
{
  const Halfedge own = with_face(h);
  return {m_mesh.face(own), m_places[m_mesh.prev(own)], own != h};
}

Corner_mesh::Halfedge Corner_mesh::halfedge(const Side& side) const
{
  const Face face(side.face);
  if (!has_face(face))
    throw std::logic_error("a side of a face that is gone");
  Halfedge h = m_mesh.halfedge(face);
  for (int i = 0; i < 3; ++i, h = m_mesh.next(h))
    if (m_places[m_mesh.prev(h)] == side.place)
      return side.is_beyond ? m_mesh.opposite(h) : h;
  throw std::logic_error("a side that its face does not have");
}

namespace {

// Compares values where their numbers differ, since a file may write a value twice.
template <class Values>
bool differ(const Values& corners, Index a, Index b)
{
  if (corners.empty())
    return false;
  const Index of_a = corners.of_triangle[a / 3][a % 3], of_b = corners.of_triangle[b / 3][b % 3];
  return of_a != of_b && corners.values[of_a] != corners.values[of_b];
}

} // namespace

Corner_mesh::Differences Corner_mesh::differences(Corner a, Corner b) const
{
  const auto differ_in_label = [&](const Triangle_labels& labels) {
    return !labels.empty() && labels.of_triangle[a / 3] != labels.of_triangle[b / 3];
  };
  return {vertex_of(a) != vertex_of(b), differ(m_soup.uvs, a, b), differ(m_soup.normals, a, b),
          differ_in_label(m_soup.groups) || differ_in_label(m_soup.objects) ||
              differ_in_label(m_soup.materials),
          m_regions && (*m_regions)[a / 3] != (*m_regions)[b / 3]};
}

Corner_mesh::Differences& Corner_mesh::Differences::operator|=(const Differences& other)
{
  in_vertex |= other.in_vertex;
  in_uv |= other.in_uv;
  in_normal |= other.in_normal;
  in_label |= other.in_label;
  in_region |= other.in_region;
  in_doubles |= other.in_doubles;
  return *this;
}

Corner_mesh::Differences Corner_mesh::differences(Mesh::Edge_index e) const
{
  const Halfedge h = m_mesh.halfedge(e), other = m_mesh.opposite(h);
  const Face face = m_mesh.face(h), beyond = m_mesh.face(other);
  const Index plies = ply_count(face), plies_beyond = ply_count(beyond);
  Differences result = differences_at_target(h);
  result |= differences_at_target(other);
  result.in_doubles = plies != plies_beyond;
  for (Index i = 0; i < plies && plies > 1 && plies == plies_beyond; ++i)
    result.in_doubles |= ply(face, i).is_against_face() != ply(beyond, i).is_against_face();
  return result;
}

Corner_mesh::Differences Corner_mesh::differences_at_target(Halfedge h) const
{
  const Halfedge beyond = m_mesh.prev(m_mesh.opposite(h));
  const Index plies = (std::min)(ply_count(m_mesh.face(h)), ply_count(m_mesh.face(beyond)));
  Differences result;
  for (Index i = 0; i < plies; ++i)
    result |= differences(corner_at(h, i), corner_at(beyond, i));
  return result;
}

void Corner_mesh::carry(Halfedge h, Halfedge from)
{
  const Face face = m_mesh.face(h);
  m_corners[face][m_places[h]] = corner_at(from);
  for (Index i = 1; i < ply_count(face); ++i)
    m_plies[m_first_ply[face] + i].corners[m_places[h]] = corner_at(from, i);
}

void Corner_mesh::carry_places(Halfedge moving)
{
  ++m_collapse_count;
  // Each contracted face takes the edge before h with it. The edge after h takes the place of that edge in
  // the face beyond it.
  for (const Halfedge h : {moving, m_mesh.opposite(moving)})
    if (!m_mesh.is_border(h))
      m_places[m_mesh.next(h)] = m_places[m_mesh.opposite(m_mesh.prev(h))];
}

} // namespace selvedge
