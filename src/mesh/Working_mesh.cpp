// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/mesh/Working_mesh.h>

#include <CGAL/Kernel/global_functions.h>

#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace selvedge {
namespace {

constexpr Index s_none = std::numeric_limits<Index>::max();

/// Which sides of triangles are sewn together, and which corners so become one vertex. Side 3i+k runs from
/// corner 3i+k to the next corner of triangle i. The first sides are the soup's own, the others an
/// obstacle's; these are never sewn to those, so that the soup has the borders that it has without an
/// obstacle.
class Sewing
{
public:
  Sewing(const std::vector<Index_triple>& triangles, Index own_sides, Index position_count,
         Welding_notes& notes)
      : m_triangles(triangles), m_own_sides(own_sides), m_position_count(position_count),
        m_mates(3 * triangles.size(), s_none)
  {
    sew(notes);
    number_vertices();
    while (tear_parallel_edges())
      number_vertices();
  }

  /// The side on the other face of the same edge; none on a border.
  Index mate(Index side) const { return m_mates[side]; }
  Index side_count() const { return Index(m_mates.size()); }
  Index vertex(Index corner) const { return m_vertices[corner]; }
  Index vertex_count() const { return m_vertex_count; }

  static Index next(Index side) { return side % 3 == 2 ? side - 2 : side + 1; }
  static Index previous(Index side) { return side % 3 == 0 ? side + 2 : side - 1; }

private:
  Index position(Index corner) const { return m_triangles[corner / 3][corner % 3]; }

  bool is_own(Index side) const { return side < m_own_sides; }

  // Two sides make an edge when they are all that lies there, run opposite ways, and belong to different
  // triangles of positions. What lies there of an obstacle counts apart.
  void sew(Welding_notes& notes)
  {
    struct Side
    {
      Index high, side;
    };
    const auto ends = [this](Index side) { return std::minmax({position(side), position(next(side))}); };
    // Sides are sorted by their lower ends in linear time, and the few of one lower end by the other.
    std::vector<Index> places(std::size_t(m_position_count) + 1, 0);
    for (Index side = 0; side < m_mates.size(); ++side)
      ++places[ends(side).first + 1];
    std::partial_sum(places.begin(), places.end(), places.begin());
    std::vector<Side> sides(m_mates.size());
    for (Index side = 0; side < m_mates.size(); ++side) {
      const auto [low, high] = ends(side);
      sides[places[low]++] = {high, side};
    }
    for (Index low = 0, first = 0; low < m_position_count; first = places[low++]) {
      const auto begin = sides.begin() + first, end = sides.begin() + places[low];
      std::sort(begin, end, [](const Side& a, const Side& b) {
        return std::tie(a.high, a.side) < std::tie(b.high, b.side);
      });
      for (auto it = begin, beyond = begin; it != end; it = beyond) {
        beyond = std::find_if(it, end, [&](const Side& side) {
          return side.high != it->high || is_own(side.side) != is_own(it->side);
        });
        sew(it, beyond, notes);
      }
    }
  }

  // All sides of one place. Notes are of the soup's own.
  template <class Iterator>
  void sew(Iterator first, Iterator beyond, Welding_notes& notes)
  {
    if (beyond - first == 1)
      return;
    const Index a = first->side, b = first[1].side;
    const bool is_opposite = position(a) != position(b);
    notes.non_manifold_edges += is_own(a) && beyond - first > 2;
    notes.misoriented_edges += is_own(a) && beyond - first == 2 && !is_opposite;
    if (beyond - first == 2 && is_opposite && position(previous(a)) != position(previous(b))) {
      m_mates[a] = b;
      m_mates[b] = a;
      return;
    }
    m_unsewn.emplace_back();
    for (Iterator it = first; it != beyond; ++it)
      m_unsewn.back().push_back(it->side);
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

  // A halfedge mesh cannot hold two edges between the same two vertices, which unsewn sides of one place may
  // ask for. Tearing all that is sewn at their ends gives them ends of their own.
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
  Index m_own_sides;
  Index m_position_count;
  std::vector<Index> m_mates;
  std::vector<Index> m_vertices;
  Index m_vertex_count = 0;
  std::vector<std::vector<Index>> m_unsewn; // sides that lie at one place and are not sewn, by place
};

// Makes edges and faces between the vertices of a mesh, in the order of the sides, and returns the halfedges
// of these. `Surface_mesh::add_face` would make the same, but has to search for what is known here.
std::vector<Working_mesh::Mesh::Halfedge_index> connect(const Sewing& sewing, Working_mesh::Mesh& mesh)
{
  using Halfedge = Working_mesh::Mesh::Halfedge_index;
  const auto vertex = [&](Index corner) { return Working_mesh::Mesh::Vertex_index(sewing.vertex(corner)); };
  std::vector<Halfedge> halfedges(sewing.side_count());
  for (Index side = 0; side < halfedges.size(); ++side) {
    const Index mate = sewing.mate(side), end = Sewing::next(side);
    halfedges[side] = side < mate ? mesh.add_edge(vertex(side), vertex(end)) : mesh.opposite(halfedges[mate]);
    mesh.set_halfedge(vertex(end), halfedges[side]);
  }
  std::vector<Halfedge> border_from(mesh.number_of_vertices());
  for (Index side = 0; side < halfedges.size(); ++side) {
    if (side % 3 == 0)
      mesh.set_halfedge(mesh.add_face(), halfedges[Sewing::previous(side)]);
    mesh.set_face(halfedges[side], Working_mesh::Mesh::Face_index(side / 3));
    mesh.set_next(halfedges[side], halfedges[Sewing::next(side)]);
    if (sewing.mate(side) == s_none)
      border_from[vertex(Sewing::next(side))] = mesh.opposite(halfedges[side]);
  }
  for (Index side = 0; side < halfedges.size(); ++side) {
    if (sewing.mate(side) != s_none)
      continue;
    const Halfedge border = mesh.opposite(halfedges[side]);
    mesh.set_halfedge(vertex(side), border); // so that CGAL sees at once that the vertex is on a border
    mesh.set_next(border, border_from[vertex(side)]);
  }
  return halfedges;
}

} // namespace

std::vector<Index> number_positions(const std::vector<Point_3>& points)
{
  std::vector<Index> sorted(points.size());
  std::iota(sorted.begin(), sorted.end(), Index(0));
  const auto coordinates = [&](Index v) {
    return std::make_tuple(points[v].x(), points[v].y(), points[v].z());
  };
  tbb::parallel_sort(sorted.begin(), sorted.end(), [&](Index a, Index b) {
    return std::make_pair(coordinates(a), a) < std::make_pair(coordinates(b), b);
  });
  std::vector<Index> numbers(points.size());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    numbers[sorted[i]] =
        i > 0 && coordinates(sorted[i]) == coordinates(sorted[i - 1]) ? numbers[sorted[i - 1]] : sorted[i];
  return numbers;
}

Working_mesh::Working_mesh(const Triangle_soup& soup, const std::vector<Index>& positions,
                           const std::vector<char>& is_frozen, const Triangle_soup& obstacle)
    : m_soup(soup)
{
  const Index own_vertices = Index(soup.points.size());
  const Index own_corners = Index(3 * soup.triangles.size());
  const Index corner_count = own_corners + Index(3 * obstacle.triangles.size());
  std::vector<Index_triple> triangles; // of positions
  std::vector<char> is_used(soup.points.size(), false);
  triangles.reserve(corner_count / 3);
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
  for (const auto& [a, b, c] : obstacle.triangles) {
    m_constraints.uncounted_faces.push_back(Mesh::Face_index(Index(triangles.size())));
    triangles.push_back(
        {positions[own_vertices + a], positions[own_vertices + b], positions[own_vertices + c]});
  }

  const Sewing sewing(triangles, own_corners, Index(positions.size()), m_notes);
  m_mesh.reserve(sewing.vertex_count(), corner_count / 2 + 1, Index(triangles.size()));
  std::vector<Index> position_of_vertex;
  std::vector<Index> vertices_at(positions.size(), 0); // how many, by position
  const auto add_vertices = [&](const Triangle_soup& from, Corner first) {
    for (Corner i = 0; i < 3 * from.triangles.size(); ++i) {
      const Corner corner = first + i;
      if (sewing.vertex(corner) != m_mesh.number_of_vertices())
        continue; // vertices are numbered by their first corners
      m_mesh.add_vertex(from.points[from.triangles[i / 3][i % 3]]);
      position_of_vertex.push_back(triangles[corner / 3][corner % 3]);
      ++vertices_at[position_of_vertex.back()];
    }
  };
  add_vertices(soup, 0);
  m_notes.unwelded_positions =
      std::count_if(vertices_at.begin(), vertices_at.end(), [](Index count) { return count > 1; });
  add_vertices(obstacle, own_corners);

  std::vector<char> is_locked(m_mesh.number_of_vertices(), false);
  for (Index v = 0; v < is_locked.size(); ++v)
    is_locked[v] = vertices_at[position_of_vertex[v]] > 1;
  for (Corner corner = 0; corner < corner_count; ++corner)
    is_locked[sewing.vertex(corner)] |= is_frozen[corner / 3];
  for (Index v = 0; v < is_locked.size(); ++v)
    if (is_locked[v])
      m_constraints.locked_vertices.push_back(Mesh::Vertex_index(v));

  const std::vector<Mesh::Halfedge_index> halfedges = connect(sewing, m_mesh);
  m_places.resize(m_mesh.number_of_halfedges());
  for (Index side = 0; side < corner_count; ++side)
    m_places[halfedges[side]] = Sewing::next(side) % 3;
  for (Index side = 0; side < own_corners; ++side) {
    const Index mate = sewing.mate(side), end = Sewing::next(side);
    if (mate != s_none && side < mate && (is_line(side, Sewing::next(mate)) || is_line(end, mate)))
      m_constraints.line_edges.push_back(m_mesh.edge(halfedges[side]));
  }
  m_notes.seam_edges = m_constraints.line_edges.size();

  if (!obstacle.triangles.empty()) { // the limits are shares of the diagonal of the soup
    CGAL::Bbox_3 box;
    for (const Index_triple& triangle : soup.triangles)
      for (const Index v : triangle)
        box += soup.points[v].bbox();
    m_constraints.diagonal =
        std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  }
}

bool Working_mesh::is_line(Corner a, Corner b) const
{
  // By value, for files that write a number twice.
  const auto differ = [&](const auto& corners) {
    return !corners.empty() && corners.values[corners.of_triangle[a / 3][a % 3]] !=
                                   corners.values[corners.of_triangle[b / 3][b % 3]];
  };
  const auto differ_in_label = [&](const Triangle_labels& labels) {
    return !labels.empty() && labels.of_triangle[a / 3] != labels.of_triangle[b / 3];
  };
  return vertex_of(a) != vertex_of(b) || differ(m_soup.uvs) || differ(m_soup.normals) ||
         differ_in_label(m_soup.groups) || differ_in_label(m_soup.objects) ||
         differ_in_label(m_soup.materials);
}

// Calls function(h, corner) for each face that a motion changes: its corner at the target of its halfedge h
// becomes `corner`.
template <class Function>
void Working_mesh::for_each_changed_face(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule,
                                         const Function& function) const
{
  // From a contracted face, away from the other, up to the next line of the rule, which knows more lines than
  // corners show: sides may become equal. Is there none?
  const auto goes_all_the_way = [&](Mesh::Halfedge_index from, Mesh::Halfedge_index other,
                                    const auto& across) {
    if (m_mesh.is_border(from))
      return false;
    const Corner carried = corners_at_ends(moving, from).second;
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
  if (m_mesh.is_removed(face))
    throw std::logic_error("a collapse of a face that is gone");
  Mesh::Halfedge_index h = m_mesh.halfedge(face);
  while (m_places[m_mesh.prev(h)] != side.place)
    h = m_mesh.next(h);
  return side.is_beyond ? m_mesh.opposite(h) : h;
}

void Working_mesh::before_collapse(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule)
{
  if (m_recorder)
    m_recorder(side(moving));
  if (m_listener) {
    const auto [from, to] =
        corners_at_ends(moving, m_mesh.is_border(moving) ? m_mesh.opposite(moving) : moving);
    m_listener(vertex_of(from), vertex_of(to));
  }
  for_each_moved_wedge(moving, [&](Index from, Index to) {
    Wedge& merged = m_wedges[to];
    merged.quadric += m_wedges[from].quadric;
    merged.own_cost = merged.quadric(relative(m_mesh.point(m_mesh.target(moving))), merged.uv);
  });
  for_each_changed_face(moving, rule, [this](Mesh::Halfedge_index h, Corner corner) {
    m_corners[m_mesh.face(h)][m_places[h]] = corner;
  });
  // Of a contracted face the edge behind goes with it, and the one ahead takes its place.
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

void Working_mesh::weigh(const std::vector<double>& weights)
{
  m_constraints.vertex_weights.assign(m_mesh.number_of_vertices(), 0);
  for (const Mesh::Halfedge_index h : m_mesh.halfedges()) {
    if (m_mesh.is_border(h) || !is_own(m_mesh.face(h)))
      continue;
    double& weight = m_constraints.vertex_weights[m_mesh.target(h)];
    weight = (std::max)(weight, weights[vertex_of(corner_at(h))]);
  }
}

bool Working_mesh::keeps_pieces(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule) const
{
  // By their numbers, the vertices of a line are open (each side has its own) or closed. Runs of open ones
  // are boundary loops of pieces or stretches of them, so none may vanish, and no two may meet.
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
  if (!rule.is_line(m_mesh.edge(moving)))
    return true;
  const bool is_open_ahead = is_open_at_end(moving), is_open = is_open_at_end(back);
  for (const Mesh::Halfedge_index h : m_mesh.halfedges_around_target(back)) {
    if (h == back || !rule.is_line(m_mesh.edge(h)))
      continue;
    const bool is_open_behind = is_open_at_end(m_mesh.opposite(h));
    if (is_open_behind == is_open_ahead)
      return is_open == is_open_ahead;
    // One run ends here. Where the next vertex ends it instead, that is to be on no other.
    return is_open || !is_on_boundary(is_open_ahead ? m_mesh.source(h) : m_mesh.target(moving));
  }
  return true;
}

bool Working_mesh::keeps_uv_orientation(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule) const
{
  if (m_soup.uvs.empty())
    return true;
  const auto orientation = [this](const Index_triple& corners) {
    const auto point = [&](std::size_t k) {
      return Kernel::Point_2(uv_of(corners[k])[0], uv_of(corners[k])[1]);
    };
    return CGAL::orientation(point(0), point(1), point(2));
  };
  bool is_kept = true;
  for_each_changed_face(moving, rule, [&](Mesh::Halfedge_index h, Corner corner) {
    Index_triple corners = m_corners[m_mesh.face(h)];
    const CGAL::Orientation before = orientation(corners);
    corners[m_places[h]] = corner;
    is_kept = is_kept && (before == CGAL::COLLINEAR || orientation(corners) == before);
  });
  return is_kept;
}

Uv_quadric::Vector Working_mesh::relative(const Point_3& point) const
{
  return {point.x() - m_origin[0], point.y() - m_origin[1], point.z() - m_origin[2]};
}

Working_mesh::Uv Working_mesh::relative(const Uv& uv) const
{
  return {(uv[0] - m_uv_origin[0]) * m_uv_unit, (uv[1] - m_uv_origin[1]) * m_uv_unit};
}

void Working_mesh::measure_uvs(double unit)
{
  if (m_soup.uvs.empty() || !(unit > 0))
    return;
  m_uv_unit = unit;
  const Point_3& origin = m_soup.points[m_soup.triangles[0][0]];
  m_origin = {origin.x(), origin.y(), origin.z()};
  m_uv_origin = uv_of(0);

  const std::vector<Mesh::Vertex_index> vertices = number_wedges();
  for (const Mesh::Halfedge_index h : m_mesh.halfedges()) {
    if (m_mesh.is_border(h) || !is_own(m_mesh.face(h)))
      continue;
    const Index t = m_mesh.face(h);
    const auto& [a, b, c] = m_soup.triangles[t];
    const Mesh::Vertex_index v = m_mesh.target(h);
    Wedge& wedge = m_wedges[m_wedge_of[corner_at(h)]];
    wedge.uv = relative(uv_of(corner_at(h)));
    wedge.quadric.add_triangle(
        {relative(m_soup.points[a]), relative(m_soup.points[b]), relative(m_soup.points[c])},
        {relative(uv_of(3 * t)), relative(uv_of(3 * t + 1)), relative(uv_of(3 * t + 2))},
        m_constraints.vertex_weights.empty() ? 1 : m_constraints.vertex_weights[v]);
  }
  for (std::size_t i = 0; i < m_wedges.size(); ++i)
    m_wedges[i].own_cost = m_wedges[i].quadric(relative(m_mesh.point(vertices[i])), m_wedges[i].uv);
}

// Returns the vertex of each.
std::vector<Working_mesh::Mesh::Vertex_index> Working_mesh::number_wedges()
{
  std::vector<char> is_line(m_mesh.number_of_edges(), false);
  for (const Mesh::Edge_index e : m_constraints.line_edges)
    is_line[e] = true;
  m_wedge_of.assign(3 * m_corners.size(), s_none);
  std::vector<Mesh::Vertex_index> vertices;
  for (const Mesh::Halfedge_index first : m_mesh.halfedges()) {
    const auto is_numbered = [this](Mesh::Halfedge_index h) {
      return m_mesh.is_border(h) || !is_own(m_mesh.face(h)) || m_wedge_of[corner_at(h)] != s_none;
    };
    if (is_numbered(first))
      continue;
    const auto number = [&](Mesh::Halfedge_index h) { m_wedge_of[corner_at(h)] = Index(vertices.size()); };
    // From the first face around the vertex either way, until all round or at a line.
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
    vertices.push_back(m_mesh.target(first));
  }
  m_wedges.assign(vertices.size(), {});
  std::vector<Index> wedges_at(m_mesh.number_of_vertices(), 0);
  for (const Mesh::Vertex_index v : vertices)
    ++wedges_at[v];
  for (std::size_t i = 0; i < vertices.size(); ++i)
    m_wedges[i].is_alone = wedges_at[vertices[i]] == 1;
  return vertices;
}

// Calls function(from, to) with the wedges at both ends of a motion, once for each side of the lines.
template <class Function>
void Working_mesh::for_each_moved_wedge(Mesh::Halfedge_index moving, const Function& function) const
{
  if (m_wedges.empty())
    return;
  Index done = s_none;
  for (const Mesh::Halfedge_index h : {moving, m_mesh.opposite(moving)}) {
    if (m_mesh.is_border(h))
      continue;
    const auto [from, to] = corners_at_ends(moving, h);
    const Index wedge = m_wedge_of[from];
    if (wedge != done)
      function(wedge, m_wedge_of[to]);
    if (m_wedges[wedge].is_alone)
      return;
    done = wedge;
  }
}

double Working_mesh::uv_cost(Mesh::Halfedge_index moving) const
{
  double cost = 0;
  for_each_moved_wedge(moving, [&](Index from, Index to) {
    const Wedge& wedge = m_wedges[to];
    cost += m_wedges[from].quadric(relative(m_mesh.point(m_mesh.target(moving))), wedge.uv) + wedge.own_cost;
  });
  return cost;
}

Working_mesh::Result Working_mesh::result() const
{
  Result result;
  for (const Mesh::Face_index face : m_mesh.faces()) {
    if (!is_own(face))
      break; // the obstacle's come last
    result.triangles.push_back(face);
    result.corners.push_back(m_corners[face]);
  }
  result.soup = selected(m_soup, result.triangles, result.corners);
  return result;
}

} // namespace selvedge
