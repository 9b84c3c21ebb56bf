// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Judged_complex.h"

#include "verify/triangle_distance.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

std::string faces_named(Index f, Index g)
{
  return "faces " + std::to_string(f) + " and " + std::to_string(g);
}

template <class Box>
bool do_overlap(const Box& a, const Box& b)
{
  return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] && b.low[1] <= a.high[1] &&
         a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

std::array<double, 3> coordinates_of(const Point_3& p)
{
  return {p.x(), p.y(), p.z()};
}

template <class Box>
void add(Box& box, const Point_3& p)
{
  for (int i = 0; i < 3; ++i) {
    box.low[i] = std::min(box.low[i], p[i]);
    box.high[i] = std::max(box.high[i], p[i]);
  }
}

// Whether an attribute of one byte differs across at most one edge in sixteen of two faces, in the soup's own
// pose. Triangles with the same positions are one face, which has the values of all.
bool tells_regions_apart(const Triangle_soup& soup, const Attribute& attribute)
{
  using Face = std::set<std::array<double, 3>>;
  std::map<Face, std::multiset<int>> values;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    Face face;
    for (const Index v : soup.triangles[t])
      face.insert(coordinates_of(soup.points[v]));
    values[face].insert(int(attribute.rows[t]));
  }
  std::map<Face, std::vector<Face>> faces_at; // by edge
  for (const auto& [face, of_triangles] : values)
    for (const auto& corner : face) {
      Face edge = face;
      edge.erase(corner);
      faces_at[edge].push_back(face);
    }
  std::size_t edges = 0, differing = 0;
  for (const auto& [edge, faces] : faces_at)
    if (faces.size() == 2) {
      ++edges;
      differing += values[faces[0]] != values[faces[1]];
    }
  return 16 * differing <= edges;
}

} // namespace

Judged_complex::Judged_complex(const Triangle_soup& own, const Triangle_soup& obstacle)
    : m_own_alive(own.triangles.size())
{
  std::map<std::array<double, 3>, Index> positions; // compares doubles, so that the zeros are one
  for (const auto* soup : {&own, &obstacle})
    for (const Point_3& p : soup->points) {
      const auto [entry, is_new] = positions.emplace(std::array{p.x(), p.y(), p.z()}, Index(m_points.size()));
      if (is_new)
        m_points.push_back(p);
      m_position_of_vertex.push_back(entry->second);
    }
  m_faces_at.resize(m_points.size());
  m_is_frozen.assign(m_points.size(), false);
  for (const auto* soup : {&own, &obstacle}) {
    const Index first_vertex = soup == &own ? 0 : Index(own.points.size());
    for (const Index_triple& v : soup->triangles) {
      Face face;
      for (std::size_t k = 0; k < 3; ++k) {
        face.positions[k] = m_position_of_vertex[first_vertex + v[k]];
        m_faces_at[face.positions[k]].push_back(Index(m_faces.size()));
      }
      face.box = box_of(face.positions);
      face.is_own = soup == &own;
      face.is_alive = true;
      m_faces.push_back(face);
    }
  }
  for (Index f = Index(own.triangles.size()); f < m_faces.size(); ++f)
    freeze(f);
}

void Judged_complex::freeze(Index face)
{
  m_frozen_faces.insert(face);
  for (const Index p : m_faces[face].positions)
    m_is_frozen[p] = true;
}

void Judged_complex::exempt(const std::set<std::pair<Index, Index>>& pairs)
{
  m_ancestors.resize(m_faces.size());
  for (const auto& [f, g] : pairs) {
    if (f != g)
      m_pairs_at_start.insert({f, g});
    for (const Index face : {f, g}) {
      m_ancestors[face].insert(face);
      for (const Index p : m_faces[face].positions)
        m_offending.insert(p);
    }
  }
}

// Gives all faces at the movers the ancestors of all: what a collapse asks is asked of pairs as they are
// after it.
void Judged_complex::begin_collapse(const std::vector<Index>& movers)
{
  m_changing.clear();
  if (m_ancestors.empty())
    return;
  for (const Index p : movers)
    m_changing.insert(m_faces_at[p].begin(), m_faces_at[p].end());
  m_pairs_before = pairs_changing();
  std::set<Index> all;
  for (const Index f : m_changing)
    all.insert(m_ancestors[f].begin(), m_ancestors[f].end());
  for (const Index f : m_changing)
    m_ancestors[f] = all;
}

std::optional<Broken_promise> Judged_complex::end_collapse()
{
  if (pairs_changing() > m_pairs_before)
    return Broken_promise{Promise::embedded, "more pairs offend than before"};
  for (const Index f : m_changing)
    for (Index g = 0; g < m_faces.size(); ++g)
      if (g != f && m_faces[f].is_alive && m_faces[g].is_alive && has(g, m_faces[f].positions[0]) &&
          has(g, m_faces[f].positions[1]) && has(g, m_faces[f].positions[2]))
        return Broken_promise{Promise::embedded, faces_named(f, g) + " come to have the same corners"};
  return std::nullopt;
}

bool Judged_complex::is_permitted(Index f, Index g) const
{
  return f < m_part_of_face.size() && g < m_part_of_face.size() && m_part_of_face[f] > 0 &&
         m_part_of_face[g] > 0 && m_part_of_face[f] != m_part_of_face[g];
}

bool Judged_complex::is_exempt(Index changing, Index other) const
{
  if (is_permitted(changing, other))
    return true;
  if (m_ancestors.empty())
    return false;
  for (const Index f : m_ancestors[changing])
    for (const Index g : m_ancestors[other])
      if (m_pairs_at_start.count(std::minmax(f, g)) > 0)
        return true;
  return false;
}

// How many pairs of two faces offend now that have a changing face.
std::size_t Judged_complex::pairs_changing() const
{
  std::size_t count = 0;
  for (const Index f : m_changing) {
    if (!m_faces[f].is_alive)
      continue;
    for (Index g = 0; g < m_faces.size(); ++g)
      if (m_faces[g].is_alive && g != f && !(g < f && m_changing.count(g) > 0) && !is_permitted(f, g) &&
          do_overlap(m_faces[f].box, m_faces[g].box) && do_meet_beyond_shared(f, g))
        count += plies(f).size() * plies(g).size();
  }
  return count;
}

Judged_complex::Box Judged_complex::box_of(const Index_triple& positions) const
{
  Box box;
  for (int i = 0; i < 3; ++i) {
    const double a = m_points[positions[0]][i], b = m_points[positions[1]][i], c = m_points[positions[2]][i];
    box.low[i] = std::min({a, b, c});
    box.high[i] = std::max({a, b, c});
  }
  return box;
}

Standing_face Judged_complex::places(Index face) const
{
  const Index_triple& p = m_faces[face].positions;
  return {place(p[0]), place(p[1]), place(p[2])};
}

bool Judged_complex::do_meet_beyond_shared(Index f, Index g) const
{
  if (!has_area(f))
    std::swap(f, g);
  if (!has_area(f))
    return do_segments_meet_beyond_shared(places(f), places(g));
  const auto [a, b, c] = places(f);
  return Hull(a, b, c).meets_beyond_shared(places(g));
}

bool Judged_complex::has_area(Index face) const
{
  const auto [a, b, c] = places(face);
  return !CGAL::collinear(a.at, b.at, c.at);
}

std::size_t Judged_complex::needles() const
{
  std::size_t count = 0;
  for (Index f = 0; f < m_faces.size(); ++f)
    count += m_faces[f].is_alive && !has_area(f);
  return count;
}

bool Judged_complex::has(Index face, Index position) const
{
  const Index_triple& p = m_faces[face].positions;
  return p[0] == position || p[1] == position || p[2] == position;
}

// In their order, which begins after `position`.
std::array<Index, 2> Judged_complex::others(Index face, Index position) const
{
  const Index_triple& p = m_faces[face].positions;
  if (p[0] == position)
    return {p[1], p[2]};
  return p[1] == position ? std::array{p[2], p[0]} : std::array{p[0], p[1]};
}

std::set<std::pair<Index, Index>> Judged_complex::offending_pairs() const
{
  std::set<std::pair<Index, Index>> pairs;
  for (Index f = 0; f < m_faces.size(); ++f) {
    if (!has_area(f))
      pairs.insert({f, f});
    for (Index g = 0; g < f; ++g)
      if (do_overlap(m_faces[f].box, m_faces[g].box) && !is_permitted(f, g) && do_meet_beyond_shared(f, g))
        pairs.insert({g, f});
  }
  return pairs;
}

std::vector<Judged_complex::Edge> Judged_complex::edges_at(Index position) const
{
  std::vector<Edge> edges;
  const auto edge_to = [&](Index neighbour) -> Edge& {
    for (Edge& edge : edges)
      if (edge.neighbour == neighbour)
        return edge;
    return edges.emplace_back(Edge{neighbour});
  };
  for (const Index f : m_faces_at[position]) {
    const auto [ahead, behind] = others(f, position);
    edge_to(ahead).outgoing += m_faces[f].is_own;
    edge_to(behind).incoming += m_faces[f].is_own;
  }
  return edges;
}

void Judged_complex::turn(Index face)
{
  std::swap(m_faces[face].positions[1], m_faces[face].positions[2]);
}

Index_triple Judged_complex::positions_of(Index face) const
{
  const Index_triple& of_front = m_faces[front(face)].positions;
  if (front(face) == face)
    return of_front;
  const Index_triple& slots = m_slots[face];
  return {of_front[slots[0]], of_front[slots[1]], of_front[slots[2]]};
}

void Judged_complex::set_doubles_aside(const Triangle_soup& own)
{
  std::map<std::vector<Index>, Index> first;
  m_slots.resize(m_faces.size());
  for (Index f = 0; f < m_faces.size(); ++f) {
    m_fronts.push_back(f);
    if (!m_faces[f].is_own || m_ancestors.empty() || !has_area(f) || m_frozen_faces.count(f) > 0)
      continue;
    std::vector<Index> key(m_faces[f].positions.begin(), m_faces[f].positions.end());
    std::sort(key.begin(), key.end());
    key.push_back(f < m_part_of_face.size() ? Index(m_part_of_face[f]) : 0);
    const Index front = m_fronts[f] = first.emplace(key, f).first->second;
    if (front == f)
      continue;
    m_faces[f].is_alive = false;
    for (const Index p : m_faces[f].positions)
      m_faces_at[p].erase(std::find(m_faces_at[p].begin(), m_faces_at[p].end(), f));
    for (std::size_t k = 0; k < 3; ++k)
      for (Index slot = 0; slot < 3; ++slot)
        if (m_position_of_vertex[own.triangles[f][k]] == m_position_of_vertex[own.triangles[front][slot]])
          m_slots[f][k] = slot;
    if (m_doubles[front].empty())
      m_doubles[front].push_back(front);
    m_doubles[front].push_back(f);
  }
  // Those come first that run as the front does now, which may have been turned.
  for (auto& [front, all] : m_doubles) {
    const Index ahead = others(front, m_faces[front].positions[0])[0];
    std::stable_partition(all.begin(), all.end(), [&, front = front](Index f) {
      const Index_triple& v = own.triangles[f];
      for (std::size_t k = 0; k < 3; ++k)
        if (m_position_of_vertex[v[k]] == m_faces[front].positions[0])
          return m_position_of_vertex[v[(k + 1) % 3]] == ahead;
      return false;
    });
  }
}

// All faces for which one stands, itself among them.
std::vector<Index> Judged_complex::plies(Index front) const
{
  const auto found = m_doubles.find(front);
  return found == m_doubles.end() ? std::vector<Index>{front} : found->second;
}

void Judged_complex::find_seams(const Triangle_soup& own)
{
  set_doubles_aside(own);
  const auto differ = [](const auto& values, Index corner_a, Index corner_b) {
    return !values.empty() && values.values[values.of_triangle[corner_a / 3][corner_a % 3]] !=
                                  values.values[values.of_triangle[corner_b / 3][corner_b % 3]];
  };
  const auto differ_in_label = [](const Triangle_labels& labels, Index f, Index g) {
    return !labels.empty() && labels.of_triangle[f] != labels.of_triangle[g];
  };
  const auto corner_at = [&](Index f, Index position) {
    const Index_triple& v = own.triangles[f];
    return Index(3 * f + (m_position_of_vertex[v[0]] == position   ? 0
                          : m_position_of_vertex[v[1]] == position ? 1
                                                                   : 2));
  };
  struct Inner_edge
  {
    std::pair<Index, Index> ends;
    std::vector<Index> here, beyond; // the plies of both faces
  };
  std::vector<Inner_edge> edges;
  for (Index p = 0; p < m_points.size(); ++p)
    for (const Edge& edge : edges_at(p)) {
      if (edge.neighbour < p || edge.is_border())
        continue;
      std::vector<Index> pair;
      for (const Index f : m_faces_at[p])
        if (m_faces[f].is_own && has(f, edge.neighbour))
          pair.push_back(f);
      edges.push_back({{p, edge.neighbour}, plies(pair[0]), plies(pair[1])});
    }
  for (const Inner_edge& edge : edges) {
    bool is_line = edge.here.size() != edge.beyond.size();
    std::set<Index> different_at;
    for (std::size_t i = 0; i < edge.here.size() && !is_line; ++i) {
      const Index f = edge.here[i], g = edge.beyond[i];
      is_line = differ_in_label(own.groups, f, g) || differ_in_label(own.objects, f, g) ||
                differ_in_label(own.materials, f, g);
      for (const Index end : {edge.ends.first, edge.ends.second}) {
        const Index a = corner_at(f, end), b = corner_at(g, end);
        if (own.triangles[a / 3][a % 3] != own.triangles[b / 3][b % 3] || differ(own.uvs, a, b) ||
            differ(own.normals, a, b))
          different_at.insert(end);
      }
    }
    const auto runs_on = [&](Index f) { // along the edge
      return (corner_at(f, edge.ends.first) + 1) % 3 == corner_at(f, edge.ends.second) % 3;
    };
    for (std::size_t i = 0; i < edge.here.size() && !is_line; ++i)
      is_line = (runs_on(edge.here[i]) == runs_on(edge.here[0])) !=
                (runs_on(edge.beyond[i]) == runs_on(edge.beyond[0]));
    if (is_line || different_at.size() == 2)
      add_seam(edge.ends.first, edge.ends.second);
    else if (!different_at.empty()) {
      const Index at = *different_at.begin();
      m_seams.insert({at, at == edge.ends.first ? edge.ends.second : edge.ends.first});
    }
  }
  for (const Attribute& attribute : own.triangle_attributes)
    if (tells_regions_apart(own, attribute))
      for (const Inner_edge& edge : edges)
        for (std::size_t i = 0; i < std::min(edge.here.size(), edge.beyond.size()); ++i)
          if (attribute.rows[edge.here[i]] != attribute.rows[edge.beyond[i]]) // which are of one byte
            add_seam(edge.ends.first, edge.ends.second);
}

std::vector<std::vector<Index>> Judged_complex::fans_at(Index position) const
{
  const std::vector<Edge> edges = edges_at(position);
  std::vector<std::vector<Index>> fans;
  std::vector<Index> waiting = m_faces_at[position];
  while (!waiting.empty()) {
    std::vector<Index>& reached = fans.emplace_back();
    reached.push_back(waiting.back());
    waiting.pop_back();
    for (std::size_t i = 0; i < reached.size(); ++i)
      for (const Index neighbour : others(reached[i], position)) {
        const auto edge =
            std::find_if(edges.begin(), edges.end(), [&](const Edge& e) { return e.neighbour == neighbour; });
        if (edge->is_border())
          continue;
        const auto beyond =
            std::partition(waiting.begin(), waiting.end(), [&](Index f) { return !has(f, neighbour); });
        reached.insert(reached.end(), beyond, waiting.end());
        waiting.erase(beyond, waiting.end());
      }
  }
  return fans;
}

// Whether the position lies on one line, whose next position is `end`, as an inner point of it: the sides
// opposite to it make paths that all lead from `end` to one and the same other position.
bool Judged_complex::is_inside_line(Index position, Index end) const
{
  std::vector<Index> ends;
  for (const Edge& edge : edges_at(position))
    if (edge.is_border())
      ends.push_back(edge.neighbour);
  if (ends.size() != 2 || (ends[0] != end && ends[1] != end))
    return false;
  for (const std::vector<Index>& fan : fans_at(position)) {
    std::map<Index, int> sides_at; // the number of sides at each position of the path
    for (const Index f : fan)
      for (const Index neighbour : others(f, position))
        ++sides_at[neighbour];
    for (const auto& [neighbour, count] : sides_at)
      if (count != (neighbour == ends[0] || neighbour == ends[1] ? 1 : 2))
        return false;
    if (sides_at.count(ends[0]) == 0 || sides_at.count(ends[1]) == 0)
      return false;
  }
  return true;
}

std::optional<Broken_promise> Judged_complex::judge_link(Index removed, Index kept) const
{
  if (!is_one_fan(removed) && !is_inside_line(removed, kept))
    return Broken_promise{Promise::topology, "what moves holds several sheets together"};
  const std::vector<Edge> at_removed = edges_at(removed), at_kept = edges_at(kept);
  bool is_joined_at_border = false, is_removed_on_border = false, is_kept_on_border = false;
  for (const Edge& edge : at_kept)
    is_kept_on_border = is_kept_on_border || edge.is_border();
  for (const Edge& edge : at_removed) {
    is_removed_on_border = is_removed_on_border || edge.is_border();
    if (edge.neighbour == kept) {
      is_joined_at_border = edge.is_border();
      continue;
    }
    const auto other = std::find_if(at_kept.begin(), at_kept.end(),
                                    [&](const Edge& e) { return e.neighbour == edge.neighbour; });
    if (other == at_kept.end())
      continue;
    const auto& faces = m_faces_at[removed];
    if (std::none_of(faces.begin(), faces.end(),
                     [&](Index f) { return has(f, kept) && has(f, edge.neighbour); }))
      return Broken_promise{Promise::topology, "both have an edge to a third position, and no face with it"};
    if (edge.is_border() && other->is_border())
      return Broken_promise{Promise::topology, "a face with two other edges on borders would go"};
  }
  if (is_removed_on_border && is_kept_on_border && !is_joined_at_border)
    return Broken_promise{Promise::topology, "both are on a border, and their edge is not"};
  return std::nullopt;
}

std::optional<Broken_promise> Judged_complex::judge_line(Index removed, Index kept) const
{
  std::vector<Edge> lines;
  const Edge* along = nullptr;
  for (const Edge& edge : edges_at(removed)) {
    if (edge.is_border() || is_seam_at(removed, edge.neighbour))
      lines.push_back(edge);
    else if (edge.neighbour == kept && is_seam_at(kept, removed))
      return Broken_promise{Promise::seams, "what moves comes along a line on which it is not"};
  }
  for (const Edge& edge : lines)
    if (edge.neighbour == kept)
      along = &edge;
  if (lines.empty())
    return std::nullopt;
  if (!along || lines.size() != 2)
    return Broken_promise{Promise::seams,
                          "what moves is on a line, and leaves it, or is an end or corner of it"};
  if (lines[0].is_border() != lines[1].is_border())
    return Broken_promise{Promise::seams, "what moves is where a border becomes a seam"};
  return std::nullopt;
}

std::optional<Broken_promise> Judged_complex::judge_motion(Index moved, const Place& t) const
{
  const Place m = place(moved);
  std::vector<Index> moving;
  for (const Index f : m_faces_at[moved])
    if (!has(f, t.position))
      moving.push_back(f);
  for (const Index f : m_faces_at[moved]) {
    if (has_area(f))
      continue;
    if (!has(f, t.position))
      return Broken_promise{Promise::embedded, "face " + std::to_string(f) + " has no area, and changes"};
    const auto [a, b] = others(f, moved);
    if (CGAL::are_strictly_ordered_along_line(m.at, m_points[a == t.position ? b : a], t.at))
      return Broken_promise{Promise::motion, "face " + std::to_string(f) + " has no area, and turns over"};
  }
  for (const Index f : moving) {
    const auto [a, b] = others(f, moved);
    if (degenerates_on_the_way(m.at, t.at, m_points[a], m_points[b]))
      return Broken_promise{CGAL::collinear(t.at, m_points[a], m_points[b]) ? Promise::embedded
                                                                            : Promise::motion,
                            "face " + std::to_string(f) + " has no area at some time"};
  }
  // The end first, which is easier to see.
  std::vector<Hull> ends;
  for (const Index f : moving) {
    const auto [a, b] = others(f, moved);
    ends.emplace_back(t, place(a), place(b));
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const auto [a, b] = others(moving[i], moved);
    Box end_box{coordinates_of(t.at), coordinates_of(t.at)};
    add(end_box, m_points[a]);
    add(end_box, m_points[b]);
    for (Index f = 0; f < m_faces.size(); ++f)
      if (m_faces[f].is_alive && do_overlap(end_box, m_faces[f].box) && !has(f, moved) &&
          !is_exempt(moving[i], f) && ends[i].meets_beyond_shared(places(f)))
        return Broken_promise{Promise::embedded, faces_named(moving[i], f) + " meet afterwards"};
    for (std::size_t j = 0; j < i; ++j) {
      const auto [c, d] = others(moving[j], moved);
      if (!is_exempt(moving[i], moving[j]) &&
          ends[i].meets_beyond_shared(Standing_face{t, place(c), place(d)}))
        return Broken_promise{Promise::embedded, faces_named(moving[i], moving[j]) + " meet afterwards"};
    }
  }
  for (const Index f : moving) {
    const auto [a, b] = others(f, moved);
    Box sweep_box = m_faces[f].box;
    add(sweep_box, t.at);
    const Hull sweep(m, t, place(a), place(b));
    for (Index g = 0; g < m_faces.size(); ++g)
      if (m_faces[g].is_alive && do_overlap(sweep_box, m_faces[g].box) && !has(g, moved) &&
          !is_exempt(f, g) && sweep.meets_beyond_shared(places(g)))
        return Broken_promise{Promise::motion, faces_named(f, g) + " meet on the way"};
    // Two faces with one apex meet beyond what they share where the side of one, opposite to it, meets the
    // other.
    for (const Index g : m_faces_at[moved]) {
      const auto [c, d] = others(g, moved);
      if (f != g && !is_exempt(f, g) && has_area(g) &&
          sweep.meets_beyond_shared(Standing_edge{place(c), place(d)}))
        return Broken_promise{Promise::motion, faces_named(f, g) + " of one star meet on the way"};
    }
  }
  return judge_clearance(moved, t);
}

bool Judged_complex::is_near(const Box& a, const Box& b) const
{
  for (int i = 0; i < 3; ++i)
    if (a.low[i] - b.high[i] > 1.001 * *m_clearance || b.low[i] - a.high[i] > 1.001 * *m_clearance)
      return false;
  return true;
}

// Own faces connect positions, and those of the obstacle connect nodes beside them.
Index Judged_complex::node(const Face& face, Index position) const
{
  return face.is_own ? position : Index(m_points.size()) + position;
}

Index Judged_complex::piece_of(const Face& face) const
{
  return m_piece[node(face, face.positions[0])];
}

void Judged_complex::keep_clearance(double distance)
{
  m_clearance = distance;
  for (Index p = 0; p < 2 * m_points.size(); ++p)
    m_piece.push_back(p);
  const auto root = [&](Index p) {
    while (m_piece[p] != p)
      p = m_piece[p];
    return p;
  };
  for (const Face& face : m_faces)
    for (const Index p : face.positions)
      if (const Index a = root(node(face, face.positions[0])), b = root(node(face, p)); a != b)
        m_piece[std::max(a, b)] = std::min(a, b);
  for (Index& piece : m_piece)
    piece = root(piece);
  const double all = internal::square_bounds(distance).lower;
  const auto corners = [&](const Index_triple& p) {
    return internal::Corners{coordinates_of(m_points[p[0]]), coordinates_of(m_points[p[1]]),
                             coordinates_of(m_points[p[2]])};
  };
  for (Index f = 0; f < m_faces.size(); ++f)
    for (Index g = 0; g < f; ++g) {
      const Index a = piece_of(m_faces[f]), b = piece_of(m_faces[g]);
      if (a == b || !is_near(m_faces[f].box, m_faces[g].box))
        continue;
      double& least = m_least.emplace(std::minmax(a, b), all).first->second;
      least = std::min(least, internal::squared_distance_bounds(corners(m_faces[f].positions),
                                                                corners(m_faces[g].positions))
                                  .lower);
    }
}

// In intervals: what breaks the promise by less than their width is left to the replay, which is exact.
std::optional<Broken_promise> Judged_complex::judge_clearance(Index moved, const Place& t) const
{
  if (!m_clearance)
    return std::nullopt;
  const std::array<double, 3> from = coordinates_of(m_points[moved]), to = coordinates_of(t.at);
  for (const Index f : m_faces_at[moved]) {
    if (has(f, t.position))
      continue;
    const auto [p, q] = others(f, moved);
    const std::array<double, 3> a = coordinates_of(m_points[p]), b = coordinates_of(m_points[q]);
    Box box = m_faces[f].box;
    add(box, t.at);
    for (Index g = 0; g < m_faces.size(); ++g) {
      const Face& other = m_faces[g];
      const Index piece = piece_of(other);
      if (!other.is_alive || piece == m_piece[moved] || !is_near(box, other.box))
        continue;
      const auto found = m_least.find(std::minmax(piece, m_piece[moved]));
      const double least =
          found == m_least.end() ? internal::square_bounds(*m_clearance).lower : found->second;
      const internal::Corners still{coordinates_of(m_points[other.positions[0]]),
                                    coordinates_of(m_points[other.positions[1]]),
                                    coordinates_of(m_points[other.positions[2]])};
      for (const internal::Corners& facet :
           {internal::Corners{to, a, b}, internal::Corners{from, to, a}, internal::Corners{from, to, b}})
        if (internal::squared_distance_bounds(facet, still).upper < least)
          return Broken_promise{Promise::clearance, faces_named(f, g) + " come too near to each other"};
    }
  }
  return std::nullopt;
}

std::optional<Broken_promise> Judged_complex::snap(Index moved, Index kept)
{
  if (moved == kept || m_faces_at[moved].empty() || m_faces_at[kept].empty())
    return Broken_promise{Promise::seams, "a snap between positions that are one, or have no face"};
  if (m_is_frozen[moved] || m_is_frozen[kept] || m_offending.count(moved) > 0 || m_offending.count(kept) > 0)
    return Broken_promise{Promise::frozen, "a snap of what is frozen, or to it"};
  for (const Index f : m_faces_at[moved])
    if (has(f, kept))
      return Broken_promise{Promise::seams, "a snap along an edge"};
  const std::vector<Edge> at_moved = edges_at(moved), at_kept = edges_at(kept);
  for (const auto* edges : {&at_moved, &at_kept})
    if (std::none_of(edges->begin(), edges->end(), [](const Edge& edge) { return edge.is_border(); }))
      return Broken_promise{Promise::seams, "a snap of what is on no border, or to it"};
  for (const Edge& edge : at_moved)
    for (const Edge& other : at_kept)
      if (edge.neighbour == other.neighbour &&
          (edge.outgoing + other.outgoing != 1 || edge.incoming + other.incoming != 1))
        return Broken_promise{Promise::seams, "a snap makes one edge of what is not two borders"};
  if (auto broken = judge_motion(moved, place(kept)))
    return broken;
  move(moved, kept);
  for (Index& position : m_position_of_vertex)
    if (position == moved)
      position = kept;
  return std::nullopt;
}

std::optional<Broken_promise> Judged_complex::collapse(Index removed, Index kept)
{
  const auto& faces = m_faces_at[removed];
  if (removed == kept || std::none_of(faces.begin(), faces.end(), [&](Index f) { return has(f, kept); }))
    return Broken_promise{Promise::topology, "no edge joins the two"};
  if (m_is_frozen[removed])
    return Broken_promise{Promise::frozen, "what moves is locked, kept, frozen, or of an obstacle"};
  if (auto broken = judge_link(removed, kept))
    return broken;
  if (takes_needed_line(removed, kept))
    return Broken_promise{Promise::seams, "a position beside the edge would be the end of a line"};
  if (auto broken = judge_line(removed, kept))
    return broken;
  begin_collapse({removed});
  if (auto broken = judge_motion(removed, place(kept)))
    return broken;
  merge(removed, kept);
  return end_collapse();
}

std::optional<Broken_promise> Judged_complex::collapse(Index removed, Index kept, const Point_3& at,
                                                       bool is_removed_first)
{
  const auto& faces = m_faces_at[removed];
  if (removed == kept || std::none_of(faces.begin(), faces.end(), [&](Index f) { return has(f, kept); }))
    return Broken_promise{Promise::topology, "no edge joins the two"};
  if (at == m_points[removed] || at == m_points[kept])
    return Broken_promise{Promise::motion, "the new place is that of one of the two"};
  for (const Index moved : {removed, kept}) {
    if (m_is_frozen[moved])
      return Broken_promise{Promise::frozen,
                            "what goes to a new place is locked, kept, frozen, or of an obstacle"};
    if (!is_one_fan(moved))
      return Broken_promise{Promise::topology, "what goes to a new place holds several sheets together"};
    for (const Edge& edge : edges_at(moved))
      if (edge.is_border() || is_seam_at(moved, edge.neighbour))
        return Broken_promise{Promise::seams, "what goes to a new place is on a line"};
  }
  if (auto broken = judge_link(removed, kept))
    return broken;
  if (takes_needed_line(removed, kept))
    return Broken_promise{Promise::seams, "a position beside the edge would be the end of a line"};
  const Index first = is_removed_first ? removed : kept, second = is_removed_first ? kept : removed;
  begin_collapse({removed, kept});
  if (auto broken = judge_motion(first, {Index(-1), at}))
    return broken;
  place_at(first, at);
  if (auto broken = judge_motion(second, place(first)))
    return broken;
  place_at(second, at);
  merge(removed, kept);
  return end_collapse();
}

void Judged_complex::place_at(Index position, const Point_3& at)
{
  m_points[position] = at;
  for (const Index f : m_faces_at[position])
    m_faces[f].box = box_of(m_faces[f].positions);
}

// What differs at `removed` does so at `kept` if the corners on the two sides of their edge differ there.
void Judged_complex::merge(Index removed, Index kept)
{
  const std::vector<Edge> edges = edges_at(removed);
  const bool differs_at_kept = std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
    return edge.neighbour == kept && (edge.is_border() || is_seam_at(kept, removed));
  });
  for (const Edge& edge : edges) {
    if (edge.neighbour == kept)
      continue;
    if (is_seam_at(removed, edge.neighbour) && differs_at_kept)
      m_seams.insert({kept, edge.neighbour});
    if (is_seam_at(edge.neighbour, removed))
      m_seams.insert({edge.neighbour, kept});
  }
  for (const Edge& edge : edges) {
    m_seams.erase({removed, edge.neighbour});
    m_seams.erase({edge.neighbour, removed});
  }
  move(removed, kept);
}

// Whether two lines become one at a position beside the edge, and no two others end there.
bool Judged_complex::takes_needed_line(Index removed, Index kept) const
{
  for (const Index f : m_faces_at[removed]) {
    if (!has(f, kept))
      continue;
    const auto [a, b] = others(f, removed);
    const Index apex = a == kept ? b : a;
    int lines = 0, merging = 0;
    for (const Edge& edge : edges_at(apex))
      if (edge.is_border() || is_seam_at(apex, edge.neighbour)) {
        ++lines;
        merging += edge.neighbour == removed || edge.neighbour == kept;
      }
    if (merging == 2 && lines == 2)
      return true;
  }
  return false;
}

void Judged_complex::move(Index moved, Index kept)
{
  for (const Index f : m_faces_at[moved]) {
    Face& face = m_faces[f];
    if (has(f, kept)) {
      face.is_alive = false;
      m_own_alive -= face.is_own ? plies(f).size() : 0;
      for (const Index p : face.positions)
        if (p != moved)
          m_faces_at[p].erase(std::find(m_faces_at[p].begin(), m_faces_at[p].end(), f));
    } else {
      std::replace(face.positions.begin(), face.positions.end(), moved, kept);
      face.box = box_of(face.positions);
      m_faces_at[kept].push_back(f);
    }
  }
  m_faces_at[moved].clear();
}

std::vector<Index> Judged_complex::regions() const
{
  std::vector<Index> region(m_faces.size());
  std::iota(region.begin(), region.end(), Index(0));
  const auto root = [&](Index f) {
    while (region[f] != f)
      f = region[f] = region[region[f]];
    return f;
  };
  for (Index p = 0; p < m_points.size(); ++p)
    for (const Edge& edge : edges_at(p)) {
      if (edge.neighbour < p || edge.is_border() || is_seam(p, edge.neighbour))
        continue;
      Index first = Index(-1);
      for (const Index f : m_faces_at[p])
        if (m_faces[f].is_own && has(f, edge.neighbour)) {
          if (first == Index(-1))
            first = f;
          region[root(f)] = root(first);
        }
    }
  for (Index f = 0; f < region.size(); ++f)
    region[f] = root(f);
  const std::vector<Index> of_front = region;
  for (const auto& [front, all] : m_doubles) // one for each ply
    for (std::size_t i = 0; i < all.size(); ++i)
      region[all[i]] = plies(of_front[front])[i];
  return region;
}

} // namespace selvedge::test
