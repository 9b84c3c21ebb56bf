// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Complex.h"

#include "soup/selection.h"
#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>

// The mesh of `replay`: what snaps and collapses do to faces, seams and corners, computed apart from the
// reduction.

namespace selvedge::reference {
namespace {

std::size_t next(std::size_t k)
{
  return (k + 1) % 3;
}

} // namespace

std::vector<Index> first_at_position(const std::vector<Point_3>& points)
{
  std::map<Coordinates, Index> first; // compares doubles, so that −0 is 0
  std::vector<Index> result;
  result.reserve(points.size());
  Cancellation_poll poll;
  for (Index v = 0; v < points.size(); ++v) {
    poll();
    result.push_back(
        first.emplace(Coordinates{points[v].x(), points[v].y(), points[v].z()}, v).first->second);
  }
  return result;
}

Complex::Complex(const Triangle_soup& soup, std::vector<std::array<Place, 3>> obstacle)
    : m_soup(soup), m_obstacle(std::move(obstacle)), m_position_of_vertex(first_at_position(soup.points)),
      m_snapped_to(soup.points.size()), m_faces_at(soup.points.size()), m_alive(soup.triangles.size())
{
  std::iota(m_snapped_to.begin(), m_snapped_to.end(), Index(0));
  for (const Point_3& p : soup.points)
    m_points.push_back({p.x(), p.y(), p.z()});
  Cancellation_poll poll;
  for (Index f = 0; f < soup.triangles.size(); ++f) {
    poll();
    Face face;
    for (Index k = 0; k < 3; ++k) {
      face.positions[k] = m_position_of_vertex[soup.triangles[f][k]];
      face.corners[k] = 3 * f + k;
      m_faces_at[face.positions[k]].push_back(f);
    }
    m_faces.push_back(face);
  }
}

std::array<Place, 3> Complex::triangle(Index face) const
{
  if (is_of_obstacle(face)) {
    std::array<Place, 3> corners = m_obstacle[face - m_faces.size()];
    // After a bad step, what shared a position with the obstacle may have moved away.
    for (Place& corner : corners)
      if (corner.id < m_points.size() && m_points[corner.id] != corner.at)
        corner.id = Index(-2) - Index(&corner - corners.data());
    return corners;
  }
  const Index_triple& p = m_faces[face].positions;
  return {place(p[0]), place(p[1]), place(p[2])};
}

std::size_t Complex::slot(Index face, Index position) const
{
  const Index_triple& p = m_faces[face].positions;
  return std::size_t(std::find(p.begin(), p.end(), position) - p.begin());
}

bool Complex::has(Index face, Index position) const
{
  if (!is_of_obstacle(face))
    return slot(face, position) < 3;
  const std::array<Place, 3> corners = triangle(face);
  return std::any_of(corners.begin(), corners.end(),
                     [&](const Place& corner) { return corner.id == position; });
}

std::array<Index, 2> Complex::opposite_side(Index face, Index position) const
{
  const Index_triple& p = m_faces[face].positions;
  const std::size_t k = slot(face, position);
  return {p[next(k)], p[next(next(k))]};
}

std::vector<Complex::Edge> Complex::edges_at(Index position) const
{
  constexpr std::size_t many = 64; // edges among which a search one by one takes longer than a table
  std::vector<Edge> edges;
  std::unordered_map<Index, std::size_t> places; // of the edges, if they are many
  const auto entry_of = [&](Index neighbour) -> Edge& {
    if (edges.size() < many) {
      for (Edge& edge : edges)
        if (edge.neighbour == neighbour)
          return edge;
    } else {
      if (places.empty())
        for (std::size_t i = 0; i < edges.size(); ++i)
          places.emplace(edges[i].neighbour, i);
      if (const auto [found, is_new] = places.emplace(neighbour, edges.size()); !is_new)
        return edges[found->second];
    }
    edges.push_back({neighbour});
    return edges.back();
  };
  for (const Index f : m_faces_at[position]) {
    const std::size_t k = slot(f, position), before = next(next(k));
    Edge& out = entry_of(m_faces[f].positions[next(k)]);
    ++out.outgoing;
    out.is_seam = out.is_seam || m_faces[f].is_seam[k][0];
    out.is_seam_beyond = out.is_seam_beyond || m_faces[f].is_seam[k][1];
    Edge& in = entry_of(m_faces[f].positions[before]);
    ++in.incoming;
    in.is_seam = in.is_seam || m_faces[f].is_seam[before][1];
    in.is_seam_beyond = in.is_seam_beyond || m_faces[f].is_seam[before][0];
  }
  return edges;
}

const Complex::Edge& Complex::edge_to(const std::vector<Edge>& edges, Index neighbour)
{
  return *std::find_if(edges.begin(), edges.end(),
                       [&](const Edge& edge) { return edge.neighbour == neighbour; });
}

// The faces at a position, in sets that are connected across edges that are no borders.
std::vector<std::vector<Index>> Complex::fans_at(Index position) const
{
  const std::vector<Edge> edges = edges_at(position);
  std::vector<std::vector<Index>> fans;
  for (std::vector<Index> waiting = m_faces_at[position]; !waiting.empty();) {
    std::vector<Index> reached{waiting.front()};
    waiting.erase(waiting.begin());
    for (std::size_t i = 0; i < reached.size(); ++i)
      for (const Index neighbour : opposite_side(reached[i], position)) {
        if (edge_to(edges, neighbour).is_border())
          continue;
        const auto beyond = std::stable_partition(waiting.begin(), waiting.end(),
                                                  [&](Index f) { return !has(f, neighbour); });
        reached.insert(reached.end(), beyond, waiting.end());
        waiting.erase(beyond, waiting.end());
      }
    fans.push_back(std::move(reached));
  }
  return fans;
}

bool Complex::is_inside_line(Index position, Index end) const
{
  const std::vector<Edge> edges = edges_at(position);
  if (std::count_if(edges.begin(), edges.end(), [](const Edge& edge) { return edge.is_border(); }) != 2 ||
      !edge_to(edges, end).is_border())
    return false;
  // Each fan is a path of faces: it has one face at each of the two border edges, and thus two ends there.
  const auto faces_at_end = [&](const std::vector<Index>& fan, bool is_this_end) {
    return std::count_if(fan.begin(), fan.end(), [&](Index f) {
      const auto sides = opposite_side(f, position);
      return std::any_of(sides.begin(), sides.end(), [&](Index neighbour) {
        return edge_to(edges, neighbour).is_border() && (neighbour == end) == is_this_end;
      });
    });
  };
  const std::vector<std::vector<Index>> fans = fans_at(position);
  return std::all_of(fans.begin(), fans.end(), [&](const std::vector<Index>& fan) {
    return faces_at_end(fan, true) == 1 && faces_at_end(fan, false) == 1;
  });
}

bool Complex::have_other_values(Index a, Index b) const
{
  // Compares values, since some files give one value several numbers.
  const auto differ = [&](const auto& values) {
    return !values.empty() &&
           values.values[values.of_triangle[a / 3][a % 3]] != values.values[values.of_triangle[b / 3][b % 3]];
  };
  const auto differ_in = [&](const Triangle_labels& labels) {
    return !labels.empty() && labels.of_triangle[a / 3] != labels.of_triangle[b / 3];
  };
  return differ(m_soup.uvs) || differ(m_soup.normals) || differ_in(m_soup.groups) ||
         differ_in(m_soup.objects) || differ_in(m_soup.materials);
}

void Complex::turn(Index face)
{
  Face& turned = m_faces[face];
  std::swap(turned.positions[1], turned.positions[2]);
  std::swap(turned.corners[1], turned.corners[2]);
  turned.is_turned = !turned.is_turned;
}

Index_triple Complex::in_order_of_soup(Index face, Index_triple of_face) const
{
  if (m_faces[face].is_turned)
    std::swap(of_face[1], of_face[2]);
  return of_face;
}

void Complex::set_aside(const std::vector<Index>& fronts)
{
  m_fronts = fronts;
  for (Index f = 0; f < m_faces.size(); ++f)
    if (front(f) != f)
      m_plies[front(f)];
  for (Index f = 0; f < m_faces.size(); ++f) {
    const auto found = m_plies.find(front(f));
    if (found == m_plies.end())
      continue;
    Ply ply{f, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      const Index corner = m_faces[f].corners[slot(f, m_faces[front(f)].positions[k])];
      ply.corners[k] = corner;
      ply.places[k] = corner % 3;
    }
    found->second.push_back(ply);
    if (front(f) == f)
      continue;
    m_faces[f].is_alive = false;
    for (const Index p : m_faces[f].positions) {
      std::vector<Index>& faces = m_faces_at[p];
      faces.erase(std::find(faces.begin(), faces.end(), f));
    }
  }
  for (auto& [face, plies] : m_plies) {
    std::stable_partition(plies.begin(), plies.end(),
                          [](const Ply& ply) { return ply.places[1] == next(ply.places[0]); });
    m_faces[face].corners = plies.front().corners;
  }
}

Index_triple Complex::positions_left(Index face) const
{
  const Index_triple& positions = m_faces[front(face)].positions;
  for (const Ply& ply : plies(front(face)))
    if (ply.face == face) {
      Index_triple result;
      for (std::size_t k = 0; k < 3; ++k)
        result[ply.places[k]] = positions[k];
      return result;
    }
  return in_order_of_soup(face, positions);
}

// Whether the faces for which f and g stand differ at each end of their common edge, one by one. Both ends
// count where these are not as many or run other ways.
std::array<bool, 2> Complex::differs_at_ends(Index f, Index g, Index from, Index to) const
{
  const std::vector<Ply>&of_f = plies(f), &of_g = plies(g);
  if (of_f.size() != of_g.size())
    return {true, true};
  const auto runs_along = [](const Ply& ply) { return ply.places[1] == next(ply.places[0]); };
  std::array<bool, 2> result{};
  for (std::size_t i = 0; i < std::max(std::size_t(1), of_f.size()); ++i) {
    if (!of_f.empty() && runs_along(of_f[i]) != runs_along(of_g[i]))
      return {true, true};
    for (const std::size_t end : {0, 1}) {
      const Index position = end == 0 ? from : to;
      const Index a = (i == 0 ? m_faces[f].corners : of_f[i].corners)[slot(f, position)];
      const Index b = (i == 0 ? m_faces[g].corners : of_g[i].corners)[slot(g, position)];
      result[end] = result[end] || vertex_of(a) != vertex_of(b) || have_other_values(a, b);
    }
  }
  return result;
}

void Complex::find_seams(const std::vector<const Attribute*>& of_regions)
{
  m_has_seams = true;
  std::vector<Side> inner; // sides of two faces
  Cancellation_poll poll;
  for (Index f = 0; f < m_faces.size(); ++f)
    for (std::size_t k = 0; k < 3 && m_faces[f].is_alive; ++k) {
      poll();
      const Index from = m_faces[f].positions[k], to = m_faces[f].positions[next(k)];
      std::size_t count = 0;
      Index other = f;
      for (const Index g : m_faces_at[from])
        if (g != f && has(g, to)) {
          ++count;
          other = g;
        }
      // An edge is a border unless exactly two faces meet at it and run along it in opposite directions.
      if (count == 1 && m_faces[other].positions[next(slot(other, to))] == from) {
        m_faces[f].is_seam[k] = differs_at_ends(f, other, from, to);
        inner.push_back({f, other, k});
      }
    }
  mark_regions(inner, of_regions);
}

// Marks the edges across which one of these attributes of triangles changes.
void Complex::mark_regions(const std::vector<Side>& inner, const std::vector<const Attribute*>& attributes)
{
  const auto ply_count = [&](Index f) { return std::max(std::size_t(1), plies(f).size()); };
  const auto ply = [&](Index f, std::size_t i) { return plies(f).empty() ? f : plies(f)[i].face; };
  for (const Attribute* attribute : attributes)
    for (const Side& side : inner)
      for (std::size_t i = 0; i < std::min(ply_count(side.face), ply_count(side.other)); ++i)
        if (row_of(*attribute, ply(side.face, i)) != row_of(*attribute, ply(side.other, i)))
          m_faces[side.face].is_seam[side.place] = {true, true};
}

void Complex::snap(Index moved, Index kept)
{
  for (const Index f : m_faces_at[moved]) {
    m_faces[f].positions[slot(f, moved)] = kept;
    m_faces_at[kept].push_back(f);
  }
  m_faces_at[moved].clear();
  m_snapped_to[moved] = kept;
}

std::vector<Index> Complex::collapse(Index removed, Index kept, const std::array<Coordinates, 2>& before)
{
  std::vector<Index> contracted, moving;
  for (const Index f : m_faces_at[removed])
    (has(f, kept) ? contracted : moving).push_back(f);
  carry_corners(contracted, moving, removed, kept);
  carry_passed(removed, kept, before);
  carry_seams(removed, kept);
  for (const Index f : contracted) {
    for (const Index p : m_faces[f].positions) {
      std::vector<Index>& faces = m_faces_at[p];
      faces.erase(std::find(faces.begin(), faces.end(), f));
    }
    m_faces[f].is_alive = false;
    m_alive -= std::max(std::size_t(1), plies(f).size());
  }
  for (const Index f : moving) {
    m_faces[f].positions[slot(f, removed)] = kept;
    m_faces_at[kept].push_back(f);
  }
  m_faces_at[removed].clear();
  return contracted;
}

// Gives the moving faces the corner that a contracted face has at `kept`, in place of theirs at `removed`. It
// is handed on from face to face across edges at `removed` that are no lines. Where both contracted faces
// would serve, the one that runs from `removed` to `kept` does.
void Complex::carry_corners(const std::vector<Index>& contracted, std::vector<Index> moving, Index removed,
                            Index kept)
{
  std::vector<Index> sources = contracted;
  std::stable_partition(sources.begin(), sources.end(),
                        [&](Index f) { return m_faces[f].positions[next(slot(f, removed))] == kept; });
  const std::vector<Edge> edges = edges_at(removed);
  std::vector<std::pair<Index, Index>> carried; // faces, and those of which they get the corner at `kept`
  for (const Index source : sources) {
    std::vector<Index> reached{source};
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const Index f = reached[i];
      const auto sides = opposite_side(f, removed);
      const std::size_t at = slot(f, removed);
      const auto is_next = [&](Index g) {
        // Neighbours run along their common edge in opposite directions.
        const auto others = opposite_side(g, removed);
        return (others[1] == sides[0] && !m_faces[f].is_seam[at][0] &&
                !edge_to(edges, sides[0]).is_border()) ||
               (others[0] == sides[1] && !m_faces[f].is_seam[next(next(at))][1] &&
                !edge_to(edges, sides[1]).is_border());
      };
      const auto beyond =
          std::stable_partition(moving.begin(), moving.end(), [&](Index g) { return !is_next(g); });
      for (auto it = beyond; it != moving.end(); ++it) {
        carried.emplace_back(*it, source);
        reached.push_back(*it);
      }
      moving.erase(beyond, moving.end());
    }
  }
  for (const auto& [f, source] : carried) {
    const std::size_t to = slot(f, removed), from = slot(source, kept);
    m_faces[f].corners[to] = m_faces[source].corners[from];
    for (std::size_t i = 1; i < plies(f).size(); ++i)
      m_plies[f][i].corners[to] = m_plies[source][i].corners[from];
  }
}

// The two other edges of a contracted face become one, which is a seam at the apex if one of them was. What
// was a seam at `removed` is one at `kept` if the edge between both was one there.
void Complex::carry_seams(Index removed, Index kept)
{
  std::map<Index, std::array<bool, 2>> seams; // by neighbour: of the edge that leads to it from `kept` then
  const std::vector<Edge> edges = edges_at(removed);
  const bool is_line_at_kept = std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
    return edge.neighbour == kept && edge.is_line_beyond();
  });
  for (const Edge& edge : edges)
    if (edge.neighbour != kept)
      seams[edge.neighbour] = {edge.is_seam && is_line_at_kept, edge.is_seam_beyond};
  for (const Edge& edge : edges_at(kept))
    if (const auto found = seams.find(edge.neighbour); found != seams.end()) {
      found->second[0] = found->second[0] || edge.is_seam;
      found->second[1] = found->second[1] || edge.is_seam_beyond;
    }
  for (const Index end : {removed, kept})
    for (const Index f : m_faces_at[end]) {
      const auto [ahead, behind] = opposite_side(f, end);
      if (const auto found = seams.find(ahead); found != seams.end())
        m_faces[f].is_seam[slot(f, end)] = found->second;
      if (const auto found = seams.find(behind); found != seams.end())
        m_faces[f].is_seam[slot(f, behind)] = {found->second[1], found->second[0]};
    }
}

// Carries the points that lines have passed from the edges at `removed` to the edges that replace them.
void Complex::carry_passed(Index removed, Index kept, const std::array<Coordinates, 2>& before)
{
  const std::vector<Edge> edges = edges_at(removed);
  const auto take = [&](Index a, Index b, std::vector<Coordinates>& points) {
    const auto found = m_passed.find(std::minmax(a, b));
    if (found == m_passed.end())
      return;
    points.insert(points.end(), found->second.begin(), found->second.end());
    m_passed.erase(found);
  };
  std::vector<Coordinates> along;
  bool is_along_line = false, is_line_at_kept = false;
  for (const Edge& edge : edges)
    if (edge.neighbour == kept && edge.is_line()) {
      is_along_line = true;
      along.push_back(before[0]);
      is_line_at_kept = edge.is_line_beyond();
    }
  take(removed, kept, along);
  if (is_along_line && before[1] != m_points[kept])
    for (const Edge& edge : edges_at(kept))
      if (edge.neighbour != removed && edge.is_line())
        m_passed[std::minmax(kept, edge.neighbour)].push_back(before[1]);
  for (const Edge& edge : edges) {
    if (edge.neighbour == kept || !(edge.is_line() || edge.is_line_beyond()))
      continue;
    std::vector<Coordinates> points;
    take(removed, edge.neighbour, points);
    take(kept, edge.neighbour, points);
    if (is_along_line && edge.is_line())
      points.insert(points.end(), along.begin(), along.end());
    if (!points.empty() &&
        (edge.is_line_beyond() || is_line_at_kept)) // otherwise the line ends at `kept` now
      m_passed[std::minmax(kept, edge.neighbour)] = std::move(points);
  }
}

const std::vector<Coordinates>* Complex::passed(Index a, Index b) const
{
  const auto found = m_passed.find(std::minmax(a, b));
  return found == m_passed.end() ? nullptr : &found->second;
}

Triangle_soup Complex::result() const
{
  Triangle_soup moved = m_soup;
  for (Index v = 0; v < moved.points.size(); ++v) {
    // A point that has not moved keeps its bits, down to the sign of a zero.
    const Coordinates& now = m_points[position(v)];
    const Point_3 place(now[0], now[1], now[2]);
    if (moved.points[v] != place)
      moved.points[v] = place;
  }
  forget_moved_polygons(moved, m_soup.points);
  std::vector<Index> vertex_at(m_points.size()); // by position, the first vertex there
  for (Index v = Index(moved.points.size()); v-- > 0;)
    vertex_at[position(v)] = v;
  // A corner that no contracted face has reached keeps its values, but is where its face is. It becomes one
  // of a triangle that is added for this alone, and that is not selected.
  const auto corner_at = [&](Index corner, Index place) {
    if (position(vertex_of(corner)) == place)
      return corner;
    const auto repeat = [&](auto& values) {
      if (!values.empty()) {
        const Index value = values.of_triangle[corner / 3][corner % 3];
        values.of_triangle.push_back({value, value, value});
      }
    };
    repeat(moved.uvs);
    repeat(moved.normals);
    moved.triangles.push_back({vertex_at[place], vertex_at[place], vertex_at[place]});
    return Index(3 * (moved.triangles.size() - 1));
  };
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;
  for (Index f = 0; f < m_faces.size(); ++f) {
    if (!is_left(f))
      continue;
    triangles.push_back(f);
    corners.push_back(in_order_of_soup(f, m_faces[f].corners));
    const std::vector<Ply>& all = plies(front(f));
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].face == f)
        for (std::size_t k = 0; k < 3; ++k)
          corners.back()[all[i].places[k]] = i == 0 ? m_faces[front(f)].corners[k] : all[i].corners[k];
    const Index_triple positions = positions_left(f);
    for (std::size_t k = 0; k < 3; ++k)
      corners.back()[k] = corner_at(corners.back()[k], positions[k]);
  }
  return selected(moved, triangles, corners);
}

} // namespace selvedge::reference
