// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/mesh/Working_mesh.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <unordered_set>

namespace selvedge {
namespace {

constexpr Index s_none = std::numeric_limits<Index>::max();

/// Which sides of triangles are sewn together, and which corners so become one vertex. Side 3i+k runs from corner
/// 3i+k to the next corner of triangle i.
class Sewing
{
public:
  Sewing(const std::vector<Index_triple>& triangles, Welding_notes& notes)
    : m_triangles(triangles), m_mates(3 * triangles.size(), s_none)
  {
    sew(notes);
    number_vertices();
    while (tear_parallel_edges())
      number_vertices();
  }

  /// The side on the other face of the same edge; none on a border.
  Index mate(Index side) const { return m_mates[side]; }
  Index vertex(Index corner) const { return m_vertices[corner]; }
  Index vertex_count() const { return m_vertex_count; }

  static Index next(Index side) { return side % 3 == 2 ? side - 2 : side + 1; }
  static Index previous(Index side) { return side % 3 == 0 ? side + 2 : side - 1; }

private:
  Index position(Index corner) const { return m_triangles[corner / 3][corner % 3]; }

  // Two sides make an edge when they are all that lies there, run opposite ways, and belong to different triangles
  // of positions.
  void sew(Welding_notes& notes)
  {
    struct Side
    {
      Index low, high, side;
    };
    std::vector<Side> sides;
    sides.reserve(m_mates.size());
    for (Index side = 0; side < m_mates.size(); ++side) {
      const auto [low, high] = std::minmax({position(side), position(next(side))});
      sides.push_back({low, high, side});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::tie(a.low, a.high, a.side) < std::tie(b.low, b.high, b.side);
    });
    for (std::size_t first = 0, beyond; first < sides.size(); first = beyond) {
      for (beyond = first + 1; beyond < sides.size(); ++beyond)
        if (sides[beyond].low != sides[first].low || sides[beyond].high != sides[first].high)
          break;
      if (beyond - first == 1)
        continue;
      const Index a = sides[first].side, b = sides[first + 1].side;
      const bool is_opposite = position(a) != position(b);
      notes.non_manifold_edges += beyond - first > 2;
      notes.misoriented_edges += beyond - first == 2 && !is_opposite;
      if (beyond - first == 2 && is_opposite && position(previous(a)) != position(previous(b))) {
        m_mates[a] = b;
        m_mates[b] = a;
        continue;
      }
      m_unsewn.emplace_back();
      for (std::size_t i = first; i < beyond; ++i)
        m_unsewn.back().push_back(sides[i].side);
    }
  }

  // Corners that follow each other around a position across sewn sides are one vertex.
  void number_vertices()
  {
    m_vertices.assign(m_mates.size(), s_none);
    m_vertex_count = 0;
    for (Index first = 0; first < m_vertices.size(); ++first) {
      if (m_vertices[first] != s_none)
        continue;
      const Index vertex = m_vertex_count++;
      Index corner = first;
      do {
        m_vertices[corner] = vertex;
        const Index across = m_mates[corner];
        corner = across == s_none ? s_none : next(across);
      } while (corner != s_none && corner != first);
      for (Index across = m_mates[previous(first)]; corner == s_none && across != s_none;
           across = m_mates[previous(across)])
        m_vertices[across] = vertex;
    }
  }

  // A halfedge mesh cannot hold two edges between the same two vertices, which unsewn sides of one place may ask for.
  // Tearing all that is sewn at their ends gives them ends of their own.
  bool tear_parallel_edges()
  {
    std::unordered_set<Index> torn;
    for (const std::vector<Index>& sides : m_unsewn) {
      std::vector<std::pair<Index, Index>> ends;
      for (const Index side : sides)
        ends.push_back(std::minmax({m_vertices[side], m_vertices[next(side)]}));
      std::sort(ends.begin(), ends.end());
      for (auto it = std::adjacent_find(ends.begin(), ends.end()); it != ends.end();
           it = std::adjacent_find(it + 1, ends.end()))
        torn.insert({it->first, it->second});
    }
    bool is_torn = false;
    for (Index side = 0; side < m_mates.size() && !torn.empty(); ++side) {
      if (m_mates[side] == s_none || !(torn.count(m_vertices[side]) || torn.count(m_vertices[next(side)])))
        continue;
      m_unsewn.push_back({side, m_mates[side]});
      m_mates[m_mates[side]] = s_none;
      m_mates[side] = s_none;
      is_torn = true;
    }
    return is_torn;
  }

  const std::vector<Index_triple>& m_triangles; // of positions
  std::vector<Index> m_mates;
  std::vector<Index> m_vertices;
  Index m_vertex_count = 0;
  std::vector<std::vector<Index>> m_unsewn; // sides that lie at one place and are not sewn, by place
};

} // namespace

std::vector<Index> number_positions(const std::vector<Point_3>& points)
{
  std::vector<Index> sorted(points.size());
  std::iota(sorted.begin(), sorted.end(), Index(0));
  const auto coordinates = [&](Index v) { return std::make_tuple(points[v].x(), points[v].y(), points[v].z()); };
  std::sort(sorted.begin(), sorted.end(), [&](Index a, Index b) {
    return std::make_pair(coordinates(a), a) < std::make_pair(coordinates(b), b);
  });
  std::vector<Index> numbers(points.size());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    numbers[sorted[i]] = i > 0 && coordinates(sorted[i]) == coordinates(sorted[i - 1]) ? numbers[sorted[i - 1]] : sorted[i];
  return numbers;
}

Working_mesh::Working_mesh(const Triangle_soup& soup, const std::vector<Index>& positions,
                           const std::vector<char>& is_frozen)
  : m_soup(soup)
{
  const Index corner_count = Index(3 * soup.triangles.size());
  std::vector<Index_triple> triangles; // of positions
  std::vector<char> is_used(soup.points.size(), false);
  triangles.reserve(soup.triangles.size());
  m_corners.reserve(soup.triangles.size());
  for (const Index_triple& v : soup.triangles) {
    const Corner first = Corner(3 * triangles.size());
    m_corners.push_back({first, first + 1, first + 2});
    triangles.push_back({positions[v[0]], positions[v[1]], positions[v[2]]});
    for (const Index i : v)
      is_used[i] = true;
  }
  for (Index v = 0; v < is_used.size(); ++v) {
    m_notes.unused_vertices += !is_used[v];
    m_notes.welded_vertices += is_used[v] && positions[v] != v && is_used[positions[v]];
  }

  const Sewing sewing(triangles, m_notes);
  const auto vertex = [&](Corner corner) { return Mesh::Vertex_index(sewing.vertex(corner)); };
  m_mesh.reserve(sewing.vertex_count(), corner_count / 2 + 1, Index(triangles.size()));
  std::vector<Index> position_of_vertex;
  std::vector<Index> vertices_at(soup.points.size(), 0); // how many, by position
  for (Corner corner = 0; corner < corner_count; ++corner) {
    if (sewing.vertex(corner) != m_mesh.number_of_vertices())
      continue; // vertices are numbered by their first corners
    const Index position = triangles[corner / 3][corner % 3];
    m_mesh.add_vertex(soup.points[position]);
    position_of_vertex.push_back(position);
    ++vertices_at[position];
  }
  m_notes.unwelded_positions =
    std::count_if(vertices_at.begin(), vertices_at.end(), [](Index count) { return count > 1; });

  std::vector<char> is_locked(m_mesh.number_of_vertices(), false);
  for (Index v = 0; v < is_locked.size(); ++v)
    is_locked[v] = vertices_at[position_of_vertex[v]] > 1;
  for (Corner corner = 0; corner < corner_count; corner += 3) {
    if (m_mesh.add_face(vertex(corner), vertex(corner + 1), vertex(corner + 2)) == Mesh::null_face())
      throw std::logic_error("a triangle does not fit into the welded mesh");
    for (Index k = 0; k < 3; ++k)
      is_locked[sewing.vertex(corner + k)] |= is_frozen[corner / 3];
  }
  for (Index v = 0; v < is_locked.size(); ++v)
    if (is_locked[v])
      m_constraints.locked_vertices.push_back(Mesh::Vertex_index(v));

  for (Index side = 0; side < corner_count; ++side) {
    const Index mate = sewing.mate(side), end = Sewing::next(side);
    if (mate != s_none && side < mate && (is_line(side, Sewing::next(mate)) || is_line(end, mate)))
      m_constraints.line_edges.push_back(m_mesh.edge(m_mesh.halfedge(vertex(side), vertex(end))));
  }
  m_notes.seam_edges = m_constraints.line_edges.size();
}

bool Working_mesh::is_line(Corner a, Corner b) const
{
  // By value, for files that write a number twice.
  const auto differ = [&](const auto& corners) {
    return !corners.empty() && corners.values[corners.of_triangle[a / 3][a % 3]] != corners.values[corners.of_triangle[b / 3][b % 3]];
  };
  const auto differ_in_label = [&](const Triangle_labels& labels) {
    return !labels.empty() && labels.of_triangle[a / 3] != labels.of_triangle[b / 3];
  };
  return vertex_of(a) != vertex_of(b) || differ(m_soup.uvs) || differ(m_soup.normals) || differ_in_label(m_soup.groups) ||
         differ_in_label(m_soup.objects) || differ_in_label(m_soup.materials);
}

Working_mesh::Corner* Working_mesh::find_corner(Mesh::Face_index face, Mesh::Vertex_index vertex)
{
  // By position, which no two corners of a face share, and which a corner has in the soup as in the mesh.
  for (Corner& corner : m_corners[face])
    if (m_soup.points[vertex_of(corner)] == m_mesh.point(vertex))
      return &corner;
  return nullptr;
}

void Working_mesh::before_collapse(Mesh::Halfedge_index moving)
{
  const Mesh::Vertex_index mover = m_mesh.source(moving), target = m_mesh.target(moving);
  const Mesh::Halfedge_index back = m_mesh.opposite(moving);
  // From a contracted face, away from the other, up to the next line. Where there is no line, the first walk goes all the
  // way round, and the second ends at once: the corners that it finds are those of the target already.
  const auto carry = [&](Mesh::Halfedge_index from, Mesh::Halfedge_index other, auto&& across) {
    if (m_mesh.is_border(from))
      return;
    const Corner carried = *find_corner(m_mesh.face(from), target);
    Corner previous = *find_corner(m_mesh.face(from), mover);
    for (Mesh::Halfedge_index h = across(from); m_mesh.face(h) != m_mesh.face(other); h = across(h)) {
      Corner* const corner = m_mesh.is_border(h) ? nullptr : find_corner(m_mesh.face(h), mover);
      if (!corner || is_line(previous, *corner))
        return;
      previous = *corner;
      *corner = carried;
    }
  };
  carry(moving, back, [this](Mesh::Halfedge_index h) { return m_mesh.opposite(m_mesh.prev(h)); });
  carry(back, moving, [this](Mesh::Halfedge_index h) { return m_mesh.opposite(m_mesh.next(h)); });
}

Working_mesh::Result Working_mesh::result() const
{
  Result result;
  for (const Mesh::Face_index face : m_mesh.faces()) {
    result.triangles.push_back(face);
    result.corners.push_back(m_corners[face]);
  }
  result.soup = selected(m_soup, result.triangles, result.corners);
  return result;
}

} // namespace selvedge
