// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Piece_names.h"
#include "match_steps.h"
#include "rounded.h"
#include "soup/Disjoint_sets.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

// Matches pieces whose borders were joined within the weld distance, for `match_pieces`.

namespace selvedge::internal {
namespace {

struct Border_vertices
{
  std::vector<Index_triple> vertices; // each as a triangle (v, v, v)
  std::vector<Index> pieces;
};

Border_vertices border_vertices(const Piece_mesh& mesh)
{
  std::map<Pair, std::pair<int, Index>> sides;
  for (Index t = 0; t < mesh.soup.triangles.size(); ++t)
    for (int place = 0; mesh.piece(t) != no_piece && place < 3; ++place) {
      auto side = std::minmax(mesh.soup.triangles[t][place], mesh.soup.triangles[t][(place + 1) % 3]);
      auto& [count, triangle] = sides[side];
      ++count;
      triangle = t;
    }
  Border_vertices borders;
  for (const auto& [side, faces] : sides)
    for (const Index vertex : {side.first, side.second})
      if (faces.first == 1) {
        borders.vertices.push_back({vertex, vertex, vertex});
        borders.pieces.push_back(mesh.piece(faces.second));
      }
  return borders;
}

/// The border vertices of the original, by where they are.
class Borders
{
public:
  explicit Borders(const Matching& matching)
      : m_original(matching.original.soup), m_weld_distance(matching.options.weld_distance),
        m_is_rounded(has_float32_alone(matching.result.soup)), m_borders(border_vertices(matching.original)),
        m_tree(m_original.points, m_borders.vertices)
  {
  }

  /// Calls a function with each border vertex within the weld distance of a point, and with its piece; more
  /// than once, perhaps.
  template <class Visit>
  void visit_near(const Point_3& p, const Visit& visit) const
  {
    const double largest = std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
    const double reach = m_weld_distance * (1 + 1e-9) + (m_is_rounded ? largest * 0x1p-22 : 0);
    const CGAL::Bbox_3 box(p.x() - reach, p.y() - reach, p.z() - reach, p.x() + reach, p.y() + reach,
                           p.z() + reach);
    m_tree.visit([&](const CGAL::Bbox_3& other) { return CGAL::do_overlap(box, other); },
                 [&](Index border) {
                   m_poll();
                   const Index vertex = m_borders.vertices[border][0];
                   const Point_3& q = m_original.points[vertex];
                   if (std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z()) <= reach)
                     visit(vertex, m_borders.pieces[border]);
                 });
  }

  const std::vector<Index_triple>& vertices() const { return m_borders.vertices; }

private:
  const Triangle_soup& m_original;
  double m_weld_distance;
  bool m_is_rounded;
  Border_vertices m_borders;
  Triangle_tree m_tree;
  mutable Cancellation_poll m_poll;
};

void add_near_borders(const Matching& matching, std::vector<Pair>& pairs)
{
  const Borders borders(matching);
  Cancellation_poll poll;
  std::vector<bool> is_done(matching.position_count);
  for (const Index vertex : used_vertices(matching.result.soup)) {
    const Index position = matching.result.positions[vertex];
    poll();
    if (is_done[position] || matching.original_at[position].size() == 0)
      continue;
    is_done[position] = true;
    // Where several pieces meet, a border that was joined to a second one may have moved on with it to a
    // third. So the search continues from every border vertex that is reached.
    const Lists::Range here = matching.original_at[position];
    std::set<Index> reached(here.begin(), here.end());
    std::set<Point_3> at{matching.result.soup.points[vertex]},
        next; // each once, however many ways lead to it
    for (; !at.empty() && reached.size() <= most_at_a_position; at.swap(next)) {
      const std::set<Index> before = reached;
      next.clear();
      for (const Point_3& p : at)
        borders.visit_near(p, [&](Index border, Index piece) {
          if (before.count(piece) > 0)
            return;
          reached.insert(piece);
          next.insert(matching.original.soup.points[border]);
        });
    }
    for (const Index piece : reached)
      if (!std::binary_search(here.begin(), here.end(), piece))
        pairs.emplace_back(position, piece);
  }
}

} // namespace

Lists within_reach(const Matching& matching)
{
  std::vector<Pair> pairs;
  for (Index position = 0; position < matching.position_count; ++position)
    for (const Index o : matching.original_at[position])
      pairs.emplace_back(position, o);
  if (matching.options.weld_distance > 0)
    add_near_borders(matching, pairs);
  return Lists(matching.position_count, pairs);
}

std::vector<Index> joined_positions(const Matching& matching)
{
  Disjoint_sets sets(matching.position_count);
  const Borders borders(matching);
  const auto position = [&](Index vertex) { return matching.original.positions[vertex]; };
  for (const Index_triple& border : borders.vertices())
    borders.visit_near(matching.original.soup.points[border[0]],
                       [&](Index other, Index) { sets.unite(position(border[0]), position(other)); });
  std::vector<Index> joined(matching.position_count);
  for (Index i = 0; i < joined.size(); ++i)
    joined[i] = Index(sets.find(i));
  return joined;
}

// A piece whose vertices were all snapped onto those of a piece that lies on it, or beside it, has none of
// its own left to be known by. Such pieces are matched here if they go up one to one: otherwise pieces may
// have been joined.
void match_within_reach(Matching& matching)
{
  if (matching.options.weld_distance <= 0 || matching.is_complete() || matching.is_one_empty())
    return;
  const Lists& reach = matching.reach();
  const std::size_t results = matching.result.pieces().size(), originals = matching.original.pieces().size();
  Disjoint_sets sets(results + originals);
  std::vector<std::vector<Index>> in_reach(results); // of every vertex of the piece
  std::vector<bool> is_begun(results);
  std::vector<Index> left, both;
  Cancellation_poll poll;
  for (Index t = 0; t < matching.result.soup.triangles.size(); ++t) {
    poll();
    const Index r = matching.result.piece(t);
    if (r == no_piece || !matching.is_left_of_result(r))
      continue;
    for (int place = 0; place < 3; ++place) {
      const Lists::Range here = reach[matching.result.position(t, place)];
      left.clear();
      if (here.size() <= most_at_a_position)
        std::copy_if(here.begin(), here.end(), std::back_inserter(left),
                     [&](Index o) { return matching.is_left_of_original(o); });
      for (const Index o : left)
        sets.unite(r, results + o);
      both.clear();
      std::set_intersection(in_reach[r].begin(), in_reach[r].end(), left.begin(), left.end(),
                            std::back_inserter(both));
      in_reach[r] = is_begun[r] ? both : left;
      is_begun[r] = true;
    }
  }
  const Piece_names names(matching.result, matching.original);
  std::vector<Possible_match> possible;
  for (Index r = 0; r < results; ++r)
    for (const Index o : in_reach[r])
      if (matching.are_of_one_kind(r, o))
        possible.push_back({0, names.differing(r, o), r, o});
  const std::vector<Pair> pairs = one_to_one(std::move(possible), results, originals);
  std::vector<std::size_t> unmatched(results + originals); // of each set
  for (const Index r : matching.left_of_result())
    ++unmatched[sets.find(r)];
  for (const Index o : matching.left_of_original())
    ++unmatched[sets.find(results + o)];
  for (const auto& [r, o] : pairs)
    unmatched[sets.find(r)] -= 2;
  for (const auto& [r, o] : pairs)
    if (unmatched[sets.find(r)] == 0)
      matching.match({o}, {r}, Matched_by::borders);
}

} // namespace selvedge::internal
