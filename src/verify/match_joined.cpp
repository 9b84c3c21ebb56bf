// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Likeness.h"
#include "match_steps.h"
#include "soup/Disjoint_sets.h"

#include <selvedge/Cancellation_scope.h>

#include <CGAL/Iterator_range.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

// Matches pieces that are joined where positions coincide, for `match_pieces`.

namespace selvedge::internal {
namespace {

/// The triangles of a mesh by the places of their corners, each with its piece.
class Triangles_by_place
{
public:
  using Entry = std::pair<Index_triple, Index>; ///< places in ascending order, and the piece
  using Range = CGAL::Iterator_range<std::vector<Entry>::const_iterator>;

  Triangles_by_place(const Piece_mesh& mesh, const Index* places)
  {
    for (Index t = 0; t < mesh.soup.triangles.size(); ++t)
      if (mesh.piece(t) != no_piece)
        m_entries.emplace_back(corners(mesh, t, places), mesh.piece(t));
    Cancellation_scope::check();
    std::sort(m_entries.begin(), m_entries.end());
    Cancellation_scope::check();
  }

  /// Returns all with the places of this triangle of one of the two meshes.
  Range with_corners_of(const Piece_mesh& mesh, Index triangle, const Index* places) const
  {
    return Range(std::equal_range(m_entries.begin(), m_entries.end(),
                                  Entry(corners(mesh, triangle, places), 0),
                                  [](const Entry& a, const Entry& b) { return a.first < b.first; }));
  }

private:
  static Index_triple corners(const Piece_mesh& mesh, Index triangle, const Index* places)
  {
    const auto& [a, b, c] = mesh.soup.triangles[triangle];
    Index_triple triple{places[a], places[b], places[c]};
    std::sort(triple.begin(), triple.end());
    return triple;
  }

  std::vector<Entry> m_entries;
};

// The numbers of the places of all vertices of a mesh.
std::vector<Index> places_of_vertices(const Piece_mesh& mesh, const std::vector<Index>& places_of_positions)
{
  std::vector<Index> places(mesh.soup.points.size());
  for (Index v = 0; v < places.size(); ++v)
    places[v] = places_of_positions[mesh.positions[v]];
  return places;
}

/// Both meshes with their borders joined within the weld distance.
class Joined_borders
{
public:
  explicit Joined_borders(const Matching& matching) : Joined_borders(matching, joined_positions(matching)) {}

  /// Returns whether pieces of the original show that no triangle of the result has corners of alone: each
  /// has a triangle that the result has, too, as often as the original; or what it is joined to would be of
  /// another kind without it.
  bool show(const std::vector<Index>& unseen, const std::vector<Index>& of_original,
            const std::vector<Index>& triangles_now) const
  {
    std::vector<Index> shown, left;
    for (const Index t : triangles_now) {
      const auto same = m_before.with_corners_of(m_matching.result, t, m_now_at.data());
      const auto& [a, b, c] = m_matching.result.soup.triangles[t];
      const bool is_face =
          m_now_at[a] != m_now_at[b] && m_now_at[b] != m_now_at[c] && m_now_at[c] != m_now_at[a];
      if (is_face && same.size() > 0 &&
          m_now.with_corners_of(m_matching.result, t, m_now_at.data()).size() >= same.size())
        for (const auto& [corners, o] : same)
          shown.push_back(o);
    }
    std::sort(shown.begin(), shown.end());
    std::set_difference(unseen.begin(), unseen.end(), shown.begin(), shown.end(), std::back_inserter(left));
    return left.empty() ||
           (left.size() < of_original.size() &&
            m_matching.original.kinds_by_position(m_matching.original.triangles_of(of_original),
                                                  m_before_at.data()) ==
                m_matching.result.kinds_by_position(triangles_now, m_now_at.data()) &&
            perhaps_missing(m_matching, left, of_original, {m_before_at.data(), m_pieces_at}).empty());
  }

private:
  Joined_borders(const Matching& matching, const std::vector<Index>& places)
      : m_matching(matching), m_now_at(places_of_vertices(matching.result, places)),
        m_before_at(places_of_vertices(matching.original, places)),
        m_pieces_at(matching.original.pieces_at(matching.position_count, m_before_at.data())),
        m_before(matching.original, m_before_at.data()), m_now(matching.result, m_now_at.data())
  {
  }

  const Matching& m_matching;
  std::vector<Index> m_now_at, m_before_at; // the places of all vertices
  Lists m_pieces_at;                        // of the original, by place
  Triangles_by_place m_before, m_now;
};

// The pieces of the original that a triangle of the result may come from: those within reach of all
// corners.
struct Owners
{
  bool is_known = false; ///< some corner lies where 1 to 64 pieces are in reach
  std::vector<Index> pieces;
  bool is_one() const { return pieces.size() == 1; }
  bool is_broken() const { return is_known && pieces.empty(); }
};

Owners owners(const Lists& reach, const Index_triple& positions_of_corners)
{
  Owners result;
  std::vector<Index> both;
  for (const Index position : positions_of_corners) {
    const auto here = reach[position];
    if (here.size() == 0 || here.size() > most_at_a_position)
      continue;
    if (!result.is_known) {
      result.pieces.assign(here.begin(), here.end());
    } else {
      both.clear();
      std::set_intersection(result.pieces.begin(), result.pieces.end(), here.begin(), here.end(),
                            std::back_inserter(both));
      result.pieces.swap(both);
    }
    result.is_known = true;
  }
  return result;
}

// Whether some triangles of the result and some pieces of the original are no farther apart than a quarter
// of the size of these pieces.
bool are_near(const Matching& matching, const std::vector<Index>& of_original,
              const std::vector<Index>& triangles)
{
  const Shape after(matching.result.soup, triangles, matching.exponent);
  const Shape before(matching.original.soup, matching.original.triangles_of(of_original), matching.exponent);
  if (after.root_mean_square_distance(before) > most_distance * before.diagonal())
    return false;
  for (const Index o : of_original) {
    const Shape piece(matching.original.soup, matching.original.triangles_of({o}), matching.exponent);
    if (piece.root_mean_square_distance(after) > most_distance * piece.diagonal())
      return false;
  }
  return true;
}

// What the triangles of the result tell of the pieces of the original that they come from.
struct Ownership
{
  Ownership(std::size_t results, std::size_t originals)
      : is_broken(results), owns_nothing(results, true), is_owner(originals), is_touched(originals)
  {
  }

  std::vector<bool> is_broken, owns_nothing; // by piece of the result
  std::vector<bool> is_owner, is_touched;    // by piece of the original
  std::vector<Pair> owned, perhaps_owned;
};

Ownership find_owners(Matching& matching, bool is_by_distance)
{
  const Lists& reach = matching.reach();
  Ownership result(matching.result.pieces().size(), matching.original.pieces().size());
  std::optional<Nearest_pieces> nearest;
  const auto position = [&](Index t, int place) {
    return is_by_distance ? matching.positions_nearby()[matching.result.soup.triangles[t][place]]
                          : matching.result.position(t, place);
  };
  const Index *const before_at = matching.original.positions, *const now_at = matching.result.positions;
  const Triangles_by_place before(matching.original, before_at), now(matching.result, now_at);
  Cancellation_poll poll;
  for (Index t = 0; t < matching.result.soup.triangles.size(); ++t) {
    poll();
    const Index r = matching.result.piece(t);
    if (r == no_piece)
      continue;
    Owners found = owners(reach, {position(t, 0), position(t, 1), position(t, 2)});
    if (is_by_distance && !found.is_known) {
      if (!nearest)
        nearest.emplace(matching.original.soup, matching.original.numbered.of_triangle, matching.exponent);
      found = {true, {nearest->piece_near(centre(matching.result.soup, t, matching.exponent))}};
    }
    if (found.is_broken()) {
      result.is_broken[r] = true;
      for (int place = 0; place < 3; ++place)
        if (const auto here = reach[position(t, place)]; here.size() == 1) {
          result.owned.emplace_back(r, *here.begin());
          result.is_touched[*here.begin()] = true;
        }
    }
    const auto own = [&](Index o) {
      result.owned.emplace_back(r, o);
      result.is_owner[o] = true;
      result.owns_nothing[r] = false;
    };
    if (found.is_one()) {
      own(found.pieces.front());
      continue;
    }
    // All of its corners are corners of several pieces. When the result has this very triangle as often as
    // the original, those that have it there have it here.
    const Triangles_by_place::Range same = before.with_corners_of(matching.result, t, now_at);
    const bool is_kept =
        same.size() > 0 && now.with_corners_of(matching.result, t, now_at).size() >= same.size();
    for (const auto& [corners, o] : same)
      if (is_kept && matching.is_left_of_original(o))
        own(o);
    for (const Index o : found.pieces)
      if (matching.is_left_of_original(o))
        result.perhaps_owned.emplace_back(r, o);
  }
  for (std::vector<Pair>* pairs : {&result.owned, &result.perhaps_owned}) {
    std::sort(pairs->begin(), pairs->end());
    pairs->erase(std::unique(pairs->begin(), pairs->end()), pairs->end());
  }
  return result;
}

// Pieces of both meshes that belong together.
struct Group
{
  std::vector<Index> of_original, of_result;
};

// Returns all pieces in groups. Notes further owners.
std::vector<Group> grouped(const Matching& matching, Ownership& owners)
{
  const std::size_t results = matching.result.pieces().size(), originals = matching.original.pieces().size();
  Disjoint_sets sets(results + originals);
  const auto unite = [&](Index r, Index o) { sets.unite(r, results + o); };
  for (const Piece_match& match : matching.found.matches)
    for (const Index r : match.of_result)
      for (const Index o : match.of_original)
        unite(r, o);
  for (const auto& [r, o] : owners.owned)
    if (matching.is_left_of_result(r) || matching.is_left_of_original(o))
      unite(r, o);
  for (const Possible_match& possible : matching.near)
    if (matching.is_left_of_result(possible.of_result) && owners.owns_nothing[possible.of_result]) {
      unite(possible.of_result, possible.of_original);
      owners.is_owner[possible.of_original] = true;
    }
  for (const auto& [r, o] : owners.perhaps_owned)
    if (!owners.is_owner[o] && sets.find(r) != sets.find(results + o))
      unite(r, o);

  std::map<std::size_t, Group> groups; // by set
  for (Index o = 0; o < originals; ++o)
    groups[sets.find(results + o)].of_original.push_back(o);
  for (Index r = 0; r < results; ++r)
    groups[sets.find(r)].of_result.push_back(r);
  std::vector<Group> result;
  for (auto& [set, group] : groups)
    result.push_back(std::move(group));
  return result;
}

// `joined_borders` is made when it is asked for the first time.
void match_group(Matching& matching, const Ownership& owners, Group group, bool is_by_distance,
                 std::optional<Joined_borders>& joined_borders)
{
  std::vector<Index>&of_original = group.of_original, &of_result = group.of_result;
  const auto is_left = [&](Index o) { return matching.is_left_of_original(o); };
  const auto is_left_now = [&](Index r) { return matching.is_left_of_result(r); };
  if (of_original.empty() || of_result.empty() ||
      (std::none_of(of_original.begin(), of_original.end(), is_left) &&
       std::none_of(of_result.begin(), of_result.end(), is_left_now)))
    return;
  std::vector<Index> unseen;
  std::copy_if(of_original.begin(), of_original.end(), std::back_inserter(unseen),
               [&](Index o) { return !owners.is_owner[o] && is_left(o); });
  const bool has_broken =
      std::any_of(of_result.begin(), of_result.end(), [&](Index r) { return owners.is_broken[r]; });
  const std::vector<Index> triangles_before = matching.original.triangles_of(of_original),
                           triangles_now = matching.result.triangles_of(of_result);
  const bool is_told =
      !is_by_distance &&
      (std::any_of(of_original.begin(), of_original.end(),
                   [&](Index o) { return (owners.is_owner[o] || owners.is_touched[o]) && is_left(o); }) ||
       std::count_if(of_result.begin(), of_result.end(), is_left_now) > 1);
  const auto show_where_borders_are_joined = [&](const std::vector<Index>& some) {
    if (has_broken || is_by_distance || matching.options.weld_distance <= 0)
      return false;
    if (!some.empty() && !joined_borders)
      joined_borders.emplace(matching);
    return some.empty() || joined_borders->show(some, of_original, triangles_now);
  };
  if (matching.original.kinds_by_position(triangles_before) ==
          matching.result.kinds_by_position(triangles_now) &&
      (!is_by_distance || are_near(matching, of_original, triangles_now)) &&
      unseen.size() < of_original.size()) {
    std::vector<Index> hidden =
        perhaps_missing(matching, unseen, of_original, {matching.original.positions, matching.original_at});
    if (const Pieces_in_file* in_file = hidden.empty() ? nullptr : matching.pieces_in_file();
        in_file && in_file->have(hidden, of_original, of_result, matching.original_at))
      hidden.clear();
    if (!hidden.empty() && show_where_borders_are_joined(hidden))
      hidden.clear();
    std::vector<Index> seen;
    std::set_difference(of_original.begin(), of_original.end(), hidden.begin(), hidden.end(),
                        std::back_inserter(seen));
    for (const Index o : hidden)
      matching.is_hidden[o] = true;
    matching.match(std::move(seen), std::move(of_result), Matched_by::positions);
  } else if (show_where_borders_are_joined(unseen))
    matching.match(std::move(of_original), std::move(of_result), Matched_by::borders);
  else if (is_told)
    matching.groups.push_back({std::move(of_original), std::move(of_result), has_broken});
}

} // namespace

void match_joined(Matching& matching, bool is_by_distance)
{
  if (matching.is_complete() || matching.is_one_empty())
    return;
  Ownership owners = find_owners(matching, is_by_distance);
  std::optional<Joined_borders> joined_borders;
  for (Group& group : grouped(matching, owners))
    match_group(matching, owners, std::move(group), is_by_distance, joined_borders);
}

} // namespace selvedge::internal
