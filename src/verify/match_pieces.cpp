// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Piece_mesh.h"
#include "Shape.h"
#include "match_names.h"
#include "one_to_one.h"
#include "part_names.h"
#include "positions.h"
#include "rounded.h"
#include "soup/Disjoint_sets.h"

#include <selvedge/Cancellation_scope.h>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

// Finds which piece of a result came from which piece of its original, a part of the verdict of `verify`. The
// steps 1 to 4 are those that verify.h states.

namespace selvedge {

using namespace internal;

namespace {

// The largest root mean square distance of matching pieces, as a share of the diagonal of the original's.
constexpr double most_distance = 0.25;
// A piece that has a vertex of its original may be this far off, as a share of the diagonal of the whole
// mesh: small parts are no larger, and a reduction may leave little of them.
constexpr double most_distance_of_own = 0.01;
// How many times as far as the nearest piece a matching piece may be.
constexpr double most_excess = 2;
// A piece counts as turned inside out when at least this share of its area is. Half is not enough: thin cloth
// that is reduced far has half of its area nearest to its other side.
constexpr double least_turned = 0.9;

/// Numbers the positions of two soups; those of the second follow those of the first. When only the first has
/// been rounded to 32-bit floats, the second is rounded for this too.
std::vector<Index> common_positions(const Triangle_soup& result, const Triangle_soup& original,
                                    bool may_be_rounded)
{
  return may_be_rounded && is_only_first_rounded(result, original)
             ? position_numbers(result, rounded(original))
             : position_numbers(result, original);
}

/// The names (groups, objects, materials) of the pieces of two meshes.
class Piece_names
{
public:
  Piece_names(const Piece_mesh& result, const Piece_mesh& original)
  {
    std::vector<Pair> now, before; // a piece and a name; names of different kinds have different numbers
    Index beyond = 0;
    const auto list = [&](std::vector<Pair>& pairs, const Piece_mesh& mesh, const auto& name_of) {
      for (Index t = 0; t < mesh.soup.triangles.size(); ++t)
        if (const Pair pair(mesh.piece(t), beyond + name_of(t));
            mesh.piece(t) != no_piece && (pairs.empty() || pairs.back() != pair))
          pairs.push_back(pair);
    };
    const auto add = [&](const Triangle_labels& labels_now, const Triangle_labels& labels_before) {
      if (labels_now.empty() || labels_before.empty())
        return;
      const Common_names names(result.soup, labels_now, original.soup, labels_before);
      list(now, result, [&](Index t) { return names.now(t); });
      list(before, original, [&](Index t) { return names.before(t); });
      beyond += Index(names.size());
    };
    add(result.soup.groups, original.soup.groups);
    add(result.soup.objects, original.soup.objects);
    add(result.soup.materials, original.soup.materials);
    m_of_result = Lists(result.pieces().size(), std::move(now));
    m_of_original = Lists(original.pieces().size(), std::move(before));
  }

  /// Returns how many names only one of two pieces has. Kinds of names that only one mesh has do not count.
  std::size_t differing(Index of_result, Index of_original) const
  {
    const Lists::Range now = m_of_result[of_result], before = m_of_original[of_original];
    std::vector<Index> different;
    std::set_symmetric_difference(now.begin(), now.end(), before.begin(), before.end(),
                                  std::back_inserter(different));
    return different.size();
  }

private:
  Lists m_of_result, m_of_original;
};

/// The triangles of a mesh by their three positions, each with its piece.
class Triangles_by_position
{
public:
  using Entry = std::pair<Index_triple, Index>; ///< positions in ascending order, and the piece

  class Range
  {
  public:
    using Iterator = std::vector<Entry>::const_iterator;
    Range(std::pair<Iterator, Iterator> entries) : m_entries(entries) {}
    Iterator begin() const { return m_entries.first; }
    Iterator end() const { return m_entries.second; }
    std::size_t size() const { return std::size_t(end() - begin()); }

  private:
    std::pair<Iterator, Iterator> m_entries;
  };

  explicit Triangles_by_position(const Piece_mesh& mesh)
  {
    for (Index t = 0; t < mesh.soup.triangles.size(); ++t)
      if (mesh.piece(t) != no_piece)
        m_entries.emplace_back(corners(mesh, t), mesh.piece(t));
    Cancellation_scope::check();
    std::sort(m_entries.begin(), m_entries.end());
    Cancellation_scope::check();
  }

  /// Returns all with the positions of this triangle of one of the two meshes.
  Range with_corners_of(const Piece_mesh& mesh, Index triangle) const
  {
    return std::equal_range(m_entries.begin(), m_entries.end(), Entry(corners(mesh, triangle), 0),
                            [](const Entry& a, const Entry& b) { return a.first < b.first; });
  }

private:
  static Index_triple corners(const Piece_mesh& mesh, Index triangle)
  {
    Index_triple triple{mesh.position(triangle, 0), mesh.position(triangle, 1), mesh.position(triangle, 2)};
    std::sort(triple.begin(), triple.end());
    return triple;
  }

  std::vector<Entry> m_entries;
};

/// How far a piece of the result is from one of the original, and how much of it is turned inside out.
struct Likeness
{
  Likeness(const Shape& now, const Shape& before)
      : distance(std::max(before.root_mean_square_distance(now), now.root_mean_square_distance(before)) /
                 before.diagonal()),
        turned(now.turned_against(before))
  {
  }
  bool is_wrong() const { return distance > most_distance || turned >= least_turned; }

  double distance, turned; // as in `Piece_match`
};

/// Runs the steps of `match_pieces` one after the other on the pieces that are left.
class Matching
{
public:
  Matching(const Triangle_soup& result, const Triangle_soup& original, const Verify_options& options)
      : m_options(options), m_positions(common_positions(result, original, options.may_be_rounded)),
        m_position_count(m_positions.empty() ? 0
                                             : 1 + *std::max_element(m_positions.begin(), m_positions.end())),
        m_result(result, m_positions.data()), m_original(original, m_positions.data() + result.points.size()),
        m_exponent(common_exponent(result, original)), m_original_at(m_original.pieces_at(m_position_count)),
        m_match_of_result(m_result.pieces().size(), no_piece),
        m_match_of_original(m_original.pieces().size(), no_piece), m_is_hidden(m_original.pieces().size())
  {
  }

  Piece_matching run()
  {
    match_by_vertices();
    Cancellation_scope::check();
    match_by_triangles();
    match_within_reach();
    match_joined(false);
    Cancellation_scope::check();
    match_by_distance();
    Cancellation_scope::check();
    match_joined(true);
    Cancellation_scope::check();
    tell_what_is_left();
    m_matching.matches.erase(
        std::remove_if(m_matching.matches.begin(), m_matching.matches.end(),
                       [](const Piece_match& match) { return match.of_original.empty(); }),
        m_matching.matches.end());
    match_names(m_matching, m_result, m_original, m_position_count, m_exponent);
    if (m_options.are_shapes_judged)
      judge_shapes();
    m_matching.pieces_of_original = m_original.pieces();
    return std::move(m_matching);
  }

private:
  bool is_left_of_result(Index piece) const { return m_match_of_result[piece] == no_piece; }
  bool is_left_of_original(Index piece) const { return m_match_of_original[piece] == no_piece; }
  std::vector<Index> left_of_result() const
  {
    std::vector<Index> left;
    for (Index r = 0; r < m_match_of_result.size(); ++r)
      if (is_left_of_result(r))
        left.push_back(r);
    return left;
  }
  std::vector<Index> left_of_original() const
  {
    std::vector<Index> left;
    for (Index o = 0; o < m_match_of_original.size(); ++o)
      if (is_left_of_original(o))
        left.push_back(o);
    return left;
  }
  bool is_complete() const { return left_of_result().empty() && left_of_original().empty(); }
  bool is_one_empty() const
  {
    const auto is_none = [](Index piece) { return piece == no_piece; };
    const std::vector<Index>&now = m_result.numbered.of_triangle, &before = m_original.numbered.of_triangle;
    return std::all_of(now.begin(), now.end(), is_none) || std::all_of(before.begin(), before.end(), is_none);
  }

  // Matches pieces; earlier matches of any of them are dissolved.
  void match(std::vector<Index> of_original, std::vector<Index> of_result, Matched_by by)
  {
    const Index number = Index(m_matching.matches.size());
    const auto enter = [&](std::vector<Index>& matches, const std::vector<Index>& pieces) {
      for (const Index piece : pieces) {
        if (matches[piece] != no_piece)
          m_matching.matches[matches[piece]] = {};
        matches[piece] = number;
      }
    };
    enter(m_match_of_original, of_original);
    enter(m_match_of_result, of_result);
    m_matching.matches.push_back({std::move(of_original), std::move(of_result), by});
  }

  // ---- 1: by vertices

  void match_by_vertices()
  {
    const Lists result_at = m_result.pieces_at(m_position_count);
    std::vector<std::size_t> sizes(m_result.pieces().size());
    std::vector<Pair> hits;
    Cancellation_poll poll;
    for (std::size_t position = 0; position < m_position_count; ++position) {
      poll();
      if (result_at[position].size() > most_at_a_position ||
          m_original_at[position].size() > most_at_a_position)
        continue;
      for (const Index r : result_at[position]) {
        ++sizes[r];
        for (const Index o : m_original_at[position])
          hits.emplace_back(r, o);
      }
    }
    std::sort(hits.begin(), hits.end());
    const Piece_names names(m_result, m_original);
    std::vector<Possible_match> possible;
    for (auto first = hits.begin(), last = first; first != hits.end(); first = last) {
      last = std::find_if(first, hits.end(), [&](const Pair& pair) { return pair != *first; });
      const auto [r, o] = *first;
      const std::size_t count = std::size_t(last - first);
      if (2 * count < sizes[r])
        continue;
      const double missing = 1 - double(count) / double(sizes[r]);
      m_near.push_back({missing, names.differing(r, o), r, o});
      if (kind(m_result.pieces()[r]) == kind(m_original.pieces()[o]))
        possible.push_back(m_near.back());
    }
    if (m_options.are_shapes_judged)
      compare_shapes_of_equals(possible);
    for (const auto& [r, o] :
         one_to_one(std::move(possible), m_result.pieces().size(), m_original.pieces().size()))
      match({o}, {r}, Matched_by::vertices);
  }

  // Several pieces may have all vertices of one: a tube has those of its caps, and a doubled sheet lies in
  // one place twice. Where neither vertices nor names tell pieces apart, those of different shapes come last.
  void compare_shapes_of_equals(std::vector<Possible_match>& possible) const
  {
    using Rank = std::tuple<Index, double, std::size_t>;
    const auto rank_of_result = [](const Possible_match& pair) {
      return Rank(pair.of_result, pair.distance, pair.names_differing);
    };
    const auto rank_of_original = [](const Possible_match& pair) {
      return Rank(pair.of_original, pair.distance, pair.names_differing);
    };
    std::map<Rank, std::size_t> results, originals;
    for (const Possible_match& pair : possible) {
      ++results[rank_of_result(pair)];
      ++originals[rank_of_original(pair)];
    }
    Shapes now(m_result.soup, m_result.triangles, m_exponent);
    Shapes before(m_original.soup, m_original.triangles, m_exponent);
    Cancellation_poll poll;
    for (Possible_match& pair : possible) {
      poll();
      if (results[rank_of_result(pair)] > 1 || originals[rank_of_original(pair)] > 1)
        pair.is_wrong = Likeness(now[pair.of_result], before[pair.of_original]).is_wrong();
    }
  }

  // What the caller says is checked as far as pieces go: one piece comes from one piece, and has its kind.
  void match_by_triangles()
  {
    const std::vector<Index>& origins = m_options.triangles_of_original;
    if (origins.size() != m_result.soup.triangles.size())
      return;
    std::set<Pair> pairs;
    for (Index t = 0; t < origins.size(); ++t)
      if (m_result.piece(t) != no_piece)
        pairs.emplace(m_result.piece(t), m_original.piece(origins[t]));
    std::vector<Index> origins_of(m_result.pieces().size()), results_of(m_original.pieces().size());
    for (const auto& [r, o] : pairs) {
      ++origins_of[r];
      if (o != no_piece)
        ++results_of[o];
    }
    for (const auto& [r, o] : pairs)
      if (o != no_piece && origins_of[r] == 1 && results_of[o] == 1 && is_left_of_result(r) &&
          is_left_of_original(o) && kind(m_result.pieces()[r]) == kind(m_original.pieces()[o]))
        match({o}, {r}, Matched_by::triangles);
  }

  // A piece whose vertices were all snapped onto those of a piece that lies on it, or beside it, has none of
  // its own left to be known by. Such pieces are matched here if they go up one to one: otherwise pieces may
  // have been joined.
  void match_within_reach()
  {
    if (m_options.weld_distance <= 0 || is_complete() || is_one_empty())
      return;
    const Lists& reach = reached();
    const std::size_t results = m_result.pieces().size(), originals = m_original.pieces().size();
    Disjoint_sets sets(results + originals);
    std::vector<std::vector<Index>> in_reach(results); // of every vertex of the piece
    std::vector<bool> is_begun(results);
    std::vector<Index> left, both;
    Cancellation_poll poll;
    for (Index t = 0; t < m_result.soup.triangles.size(); ++t) {
      poll();
      const Index r = m_result.piece(t);
      if (r == no_piece || !is_left_of_result(r))
        continue;
      for (int place = 0; place < 3; ++place) {
        const Lists::Range here = reach[m_result.position(t, place)];
        left.clear();
        if (here.size() <= most_at_a_position)
          std::copy_if(here.begin(), here.end(), std::back_inserter(left),
                       [&](Index o) { return is_left_of_original(o); });
        for (const Index o : left)
          sets.unite(r, results + o);
        both.clear();
        std::set_intersection(in_reach[r].begin(), in_reach[r].end(), left.begin(), left.end(),
                              std::back_inserter(both));
        in_reach[r] = is_begun[r] ? both : left;
        is_begun[r] = true;
      }
    }
    const Piece_names names(m_result, m_original);
    std::vector<Possible_match> possible;
    for (Index r = 0; r < results; ++r)
      for (const Index o : in_reach[r])
        if (kind(m_result.pieces()[r]) == kind(m_original.pieces()[o]))
          possible.push_back({0, names.differing(r, o), r, o});
    const std::vector<Pair> pairs = one_to_one(std::move(possible), results, originals);
    std::vector<std::size_t> unmatched(results + originals); // of each set
    for (const Index r : left_of_result())
      ++unmatched[sets.find(r)];
    for (const Index o : left_of_original())
      ++unmatched[sets.find(results + o)];
    for (const auto& [r, o] : pairs)
      unmatched[sets.find(r)] -= 2;
    for (const auto& [r, o] : pairs)
      if (unmatched[sets.find(r)] == 0)
        match({o}, {r}, Matched_by::borders);
  }

  // ---- 2 and 4: joined where positions coincide

  // Lists the pieces of the original at every position. A position that both meshes have also gets the pieces
  // with a border vertex within the weld distance, be it of this position or of a border vertex that was
  // reached so.
  Lists within_reach() const
  {
    std::vector<Pair> pairs;
    for (Index position = 0; position < m_position_count; ++position)
      for (const Index o : m_original_at[position])
        pairs.emplace_back(position, o);
    if (m_options.weld_distance > 0)
      add_near_borders(pairs);
    return Lists(m_position_count, std::move(pairs));
  }

  const Lists& reached()
  {
    if (!m_reach)
      m_reach = within_reach();
    return *m_reach;
  }

  void add_near_borders(std::vector<Pair>& pairs) const
  {
    const Triangle_soup& original = m_original.soup;
    std::vector<Index_triple> borders; // border vertices, each as a triangle (v, v, v)
    std::vector<Index> pieces;
    {
      std::map<Pair, std::pair<int, Index>> sides;
      for (Index t = 0; t < original.triangles.size(); ++t)
        for (int place = 0; m_original.piece(t) != no_piece && place < 3; ++place) {
          auto side = std::minmax(original.triangles[t][place], original.triangles[t][(place + 1) % 3]);
          auto& [count, triangle] = sides[side];
          ++count;
          triangle = t;
        }
      for (const auto& [side, faces] : sides)
        for (const Index vertex : {side.first, side.second})
          if (faces.first == 1) {
            borders.push_back({vertex, vertex, vertex});
            pieces.push_back(m_original.piece(faces.second));
          }
    }
    const Triangle_tree tree(original.points, borders);
    const bool is_rounded = has_float32_alone(m_result.soup);
    Cancellation_poll poll;
    const auto visit_near = [&](const Point_3& p, const auto& visit) {
      const double largest = std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
      const double reach = m_options.weld_distance * (1 + 1e-9) + (is_rounded ? largest * 0x1p-22 : 0);
      const CGAL::Bbox_3 box(p.x() - reach, p.y() - reach, p.z() - reach, p.x() + reach, p.y() + reach,
                             p.z() + reach);
      tree.visit([&](const CGAL::Bbox_3& other) { return CGAL::do_overlap(box, other); },
                 [&](Index border) {
                   poll();
                   const Point_3& q = original.points[borders[border][0]];
                   if (std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z()) <= reach)
                     visit(q, pieces[border]);
                 });
    };
    std::vector<bool> is_done(m_position_count);
    for (const Index vertex : used_vertices(m_result.soup)) {
      const Index position = m_result.positions[vertex];
      poll();
      if (is_done[position] || m_original_at[position].size() == 0)
        continue;
      is_done[position] = true;
      // Where several pieces meet, a border that was joined to a second one may have moved on with it to a
      // third. So the search continues from every border vertex that is reached.
      const Lists::Range here = m_original_at[position];
      std::set<Index> reached(here.begin(), here.end());
      std::set<Point_3> at{m_result.soup.points[vertex]}, next; // each once, however many ways lead to it
      for (; !at.empty() && reached.size() <= most_at_a_position; at.swap(next)) {
        const std::set<Index> before = reached;
        next.clear();
        for (const Point_3& p : at)
          visit_near(p, [&](const Point_3& q, Index piece) {
            if (before.count(piece) > 0)
              return;
            reached.insert(piece);
            next.insert(q);
          });
      }
      for (const Index piece : reached)
        if (!std::binary_search(here.begin(), here.end(), piece))
          pairs.emplace_back(position, piece);
    }
  }

  // The pieces of the original that a triangle of the result may come from: those within reach of all
  // corners.
  struct Owners
  {
    bool is_known = false; ///< some corner lies where 1 to 64 pieces are in reach
    std::vector<Index> pieces;
    bool is_one() const { return pieces.size() == 1; }
    bool is_broken() const { return is_known && pieces.empty(); }
  };

  Owners owners(const Lists& reach, Index triangle) const
  {
    Owners result;
    std::vector<Index> both;
    for (int place = 0; place < 3; ++place) {
      const auto here = reach[m_result.position(triangle, place)];
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

  void match_joined(bool is_by_distance)
  {
    if (is_complete() || is_one_empty())
      return;
    const Lists& reach = reached();
    const std::size_t results = m_result.pieces().size(), originals = m_original.pieces().size();
    Disjoint_sets sets(results + originals);
    const auto unite = [&](Index r, Index o) { sets.unite(r, results + o); };
    for (const Piece_match& match : m_matching.matches)
      for (const Index r : match.of_result)
        for (const Index o : match.of_original)
          unite(r, o);

    std::vector<bool> is_broken(results), is_owner(originals), is_touched(originals),
        owns_nothing(results, true);
    std::vector<Pair> owned, perhaps_owned;
    std::optional<Nearest_pieces> nearest;
    const Triangles_by_position before(m_original), now(m_result);
    Cancellation_poll poll;
    for (Index t = 0; t < m_result.soup.triangles.size(); ++t) {
      poll();
      const Index r = m_result.piece(t);
      if (r == no_piece)
        continue;
      Owners found = owners(reach, t);
      if (is_by_distance && !found.is_known) {
        if (!nearest)
          nearest.emplace(m_original.soup, m_original.numbered.of_triangle, m_exponent);
        found = {true, {nearest->piece_near(centre(m_result.soup, t, m_exponent))}};
      }
      if (found.is_broken()) {
        is_broken[r] = true;
        for (int place = 0; place < 3; ++place)
          if (const auto here = reach[m_result.position(t, place)]; here.size() == 1) {
            owned.emplace_back(r, *here.begin());
            is_touched[*here.begin()] = true;
          }
      }
      const auto own = [&](Index o) {
        owned.emplace_back(r, o);
        is_owner[o] = true;
        owns_nothing[r] = false;
      };
      if (found.is_one()) {
        own(found.pieces.front());
        continue;
      }
      // All of its corners are corners of several pieces. When the result has this very triangle as often as
      // the original, those that have it there have it here.
      const Triangles_by_position::Range same = before.with_corners_of(m_result, t);
      const bool is_kept = same.size() > 0 && now.with_corners_of(m_result, t).size() >= same.size();
      for (const auto& [corners, o] : same)
        if (is_kept && is_left_of_original(o))
          own(o);
      for (const Index o : found.pieces)
        if (is_left_of_original(o))
          perhaps_owned.emplace_back(r, o);
    }
    const auto sort = [](std::vector<Pair>& pairs) {
      std::sort(pairs.begin(), pairs.end());
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    };
    sort(owned);
    for (const auto& [r, o] : owned)
      if (is_left_of_result(r) || is_left_of_original(o))
        unite(r, o);
    for (const Possible_match& possible : m_near)
      if (is_left_of_result(possible.of_result) && owns_nothing[possible.of_result]) {
        unite(possible.of_result, possible.of_original);
        is_owner[possible.of_original] = true;
      }
    sort(perhaps_owned);
    for (const auto& [r, o] : perhaps_owned)
      if (!is_owner[o] && sets.find(r) != sets.find(results + o))
        unite(r, o);

    std::map<std::size_t, std::pair<std::vector<Index>, std::vector<Index>>> groups; // of original, of result
    for (Index o = 0; o < originals; ++o)
      groups[sets.find(results + o)].first.push_back(o);
    for (Index r = 0; r < results; ++r)
      groups[sets.find(r)].second.push_back(r);
    for (auto& [set, group] : groups) {
      auto& [of_original, of_result] = group;
      const auto is_left = [&](Index o) { return is_left_of_original(o); };
      const auto is_left_now = [&](Index r) { return is_left_of_result(r); };
      if (of_original.empty() || of_result.empty() ||
          (std::none_of(of_original.begin(), of_original.end(), is_left) &&
           std::none_of(of_result.begin(), of_result.end(), is_left_now)))
        continue;
      std::vector<Index> unseen;
      std::copy_if(of_original.begin(), of_original.end(), std::back_inserter(unseen),
                   [&](Index o) { return !is_owner[o] && is_left(o); });
      const bool has_broken =
          std::any_of(of_result.begin(), of_result.end(), [&](Index r) { return is_broken[r]; });
      const std::vector<Index> triangles_before = m_original.triangles_of(of_original),
                               triangles_now = m_result.triangles_of(of_result);
      const bool is_told =
          !is_by_distance &&
          (std::any_of(of_original.begin(), of_original.end(),
                       [&](Index o) { return (is_owner[o] || is_touched[o]) && is_left(o); }) ||
           std::count_if(of_result.begin(), of_result.end(), is_left_now) > 1);
      if (m_original.kinds_by_position(triangles_before) == m_result.kinds_by_position(triangles_now) &&
          (!is_by_distance || are_near(of_original, triangles_now)) && unseen.size() < of_original.size()) {
        const std::vector<Index> hidden = perhaps_missing(unseen, of_original);
        std::vector<Index> seen;
        std::set_difference(of_original.begin(), of_original.end(), hidden.begin(), hidden.end(),
                            std::back_inserter(seen));
        for (const Index o : hidden)
          m_is_hidden[o] = true;
        match(std::move(seen), std::move(of_result), Matched_by::positions);
      } else if (unseen.empty() && !has_broken && m_options.weld_distance > 0 && !is_by_distance)
        match(std::move(of_original), std::move(of_result), Matched_by::borders);
      else if (is_told)
        m_groups.push_back({std::move(of_original), std::move(of_result), has_broken});
    }
  }

  // Of pieces that have no triangle of the result for themselves, returns those that may be missing: without
  // them, what they are joined to would be of the same kind. A patch that others surround would leave a hole;
  // a notch that it fills could stay open unnoticed.
  std::vector<Index> perhaps_missing(const std::vector<Index>& unseen,
                                     const std::vector<Index>& of_original) const
  {
    if (unseen.empty())
      return {};
    const auto kinds_without = [&](const std::vector<Index>& left_out, const std::vector<Index>& all) {
      std::vector<Index> others;
      std::set_difference(all.begin(), all.end(), left_out.begin(), left_out.end(),
                          std::back_inserter(others));
      return m_original.kinds_by_position(m_original.triangles_of(others));
    };
    const std::vector<Kind> whole = kinds_without({}, of_original);
    if (kinds_without(unseen, of_original) == whole)
      return unseen;
    constexpr int most = 100; // so many times, all is looked at
    int looks = 0;
    const auto would_be_missed = [&](Index o) {
      Cancellation_scope::check();
      // What the Euler characteristic of the whole loses is what that of the pieces around this one loses.
      const std::vector<Index> around = pieces_around(o, of_original);
      return characteristic(kinds_without({o}, around)) != characteristic(kinds_without({}, around)) ||
             (looks++ < most && kinds_without({o}, of_original) != whole);
    };
    std::vector<Index> result;
    std::remove_copy_if(unseen.begin(), unseen.end(), std::back_inserter(result), would_be_missed);
    return result;
  }

  static long characteristic(const std::vector<Kind>& kinds)
  {
    return std::accumulate(kinds.begin(), kinds.end(), 0L,
                           [](long sum, const Kind& kind) { return sum + std::get<long>(kind); });
  }

  // A piece of the original, and those of some others that have a position in common with it.
  std::vector<Index> pieces_around(Index piece, const std::vector<Index>& others) const
  {
    std::vector<Index> around{piece}, result;
    for (const Index t : m_original.triangles[piece])
      for (int place = 0; place < 3; ++place) {
        const Lists::Range here = m_original_at[m_original.position(t, place)];
        around.insert(around.end(), here.begin(), here.end());
      }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    std::set_intersection(around.begin(), around.end(), others.begin(), others.end(),
                          std::back_inserter(result));
    return result;
  }

  // Whether some triangles of the result and some pieces of the original are no farther apart than a quarter
  // of the size of these pieces.
  bool are_near(const std::vector<Index>& of_original, const std::vector<Index>& triangles) const
  {
    const Shape after(m_result.soup, triangles, m_exponent);
    const Shape before(m_original.soup, m_original.triangles_of(of_original), m_exponent);
    if (after.root_mean_square_distance(before) > most_distance * before.diagonal())
      return false;
    for (const Index o : of_original) {
      const Shape piece(m_original.soup, m_original.triangles_of({o}), m_exponent);
      if (piece.root_mean_square_distance(after) > most_distance * piece.diagonal())
        return false;
    }
    return true;
  }

  // ---- 3: by distance

  void match_by_distance()
  {
    const std::vector<Index> left_now = left_of_result(), left_before = left_of_original();
    if (left_now.empty() || left_before.empty())
      return;
    Shapes now(m_result.soup, m_result.triangles, m_exponent);
    Shapes before(m_original.soup, m_original.triangles, m_exponent);
    struct Distances_of_pair
    {
      double to_original, to_result;
    };
    std::map<Pair, Distances_of_pair> distances; // of a piece of the result and one of the original
    const auto add = [&](Index r, Index o) {
      if (distances.count({r, o}) == 0)
        distances[{r, o}] = {now[r].root_mean_square_distance(before[o]),
                             before[o].root_mean_square_distance(now[r])};
    };
    {
      const Nearest_pieces in_original(m_original.soup, m_original.numbered.of_triangle, m_exponent);
      for (const Index r : left_now)
        for (const Index o : in_original.pieces_near(now[r]))
          add(r, o);
      const Nearest_pieces in_result(m_result.soup, m_result.numbered.of_triangle, m_exponent);
      for (const Index o : left_before)
        for (const Index r : in_result.pieces_near(before[o]))
          add(r, o);
    }
    std::map<Index, double> least_to_original, least_to_result;
    for (const auto& [pair, distance] : distances) {
      const auto lower = [](std::map<Index, double>& least, Index piece, double value) {
        double& entry = least.emplace(piece, value).first->second;
        entry = std::min(entry, value);
      };
      lower(least_to_original, pair.first, distance.to_original);
      lower(least_to_result, pair.second, distance.to_result);
    }
    std::vector<Possible_match> possible;
    for (const auto& [pair, distance] : distances) {
      const auto [r, o] = pair;
      if (is_left_of_result(r) && is_left_of_original(o) &&
          kind(m_result.pieces()[r]) == kind(m_original.pieces()[o]) &&
          distance.to_original <= most_excess * least_to_original[r] &&
          distance.to_result <= most_excess * least_to_result[o] &&
          std::max(distance.to_original, distance.to_result) <= most_distance * before[o].diagonal())
        possible.push_back({distance.to_original, 0, r, o});
    }
    for (const auto& [r, o] :
         one_to_one(std::move(possible), m_result.pieces().size(), m_original.pieces().size()))
      match({o}, {r}, Matched_by::distance);
  }

  // ---- Mismatches

  void add_mismatch(Mismatch what, std::vector<Index> of_original, std::vector<Index> of_result,
                    std::string message)
  {
    m_matching.mismatches.push_back({what, std::move(of_original), std::move(of_result), std::move(message)});
  }

  bool is_in_group_of_several(Index r) const
  {
    return std::any_of(m_groups.begin(), m_groups.end(), [&](const Joined& group) {
      return group.of_original.size() + group.of_result.size() > 2 &&
             std::binary_search(group.of_result.begin(), group.of_result.end(), r);
    });
  }

  void tell_what_is_left()
  {
    std::vector<bool> is_told_of_result(m_result.pieces().size()),
        is_told_of_original(m_original.pieces().size());
    std::stable_sort(m_near.begin(), m_near.end());
    for (const Possible_match& near : m_near) {
      const Index r = near.of_result, o = near.of_original;
      if (!is_left_of_result(r) || !is_left_of_original(o) || is_told_of_result[r] ||
          is_told_of_original[o] || is_in_group_of_several(r))
        continue;
      is_told_of_result[r] = is_told_of_original[o] = true;
      add_mismatch(Mismatch::topology, {o}, {r},
                   describe(m_original, o) + " of the original is " + describe(m_result, r) +
                       " of the result, which has " + describe(kind(m_result.pieces()[r])) + " instead of " +
                       describe(kind(m_original.pieces()[o])));
    }
    for (const Joined& group : m_groups) {
      bool is_any_new = false;
      const auto tell = [&](Index piece, std::vector<bool>& is_told, bool is_left) {
        is_any_new = is_any_new || (is_left && !is_told[piece]);
        is_told[piece] = true;
      };
      for (const Index o : group.of_original)
        tell(o, is_told_of_original, is_left_of_original(o));
      for (const Index r : group.of_result)
        tell(r, is_told_of_result, is_left_of_result(r));
      if (!is_any_new)
        continue;
      std::string message = describe(m_original, group.of_original) + " of the original and " +
                            describe(m_result, group.of_result) +
                            " of the result lie at the same place, but do not hang together alike";
      if (group.is_broken && m_options.weld_distance == 0)
        message += "; if borders were joined on purpose, give the weld distance";
      add_mismatch(Mismatch::topology, group.of_original, group.of_result, std::move(message));
      // Pieces of this group that did match have done so by chance.
      for (const Index o : group.of_original)
        if (const Index match = std::exchange(m_match_of_original[o], no_piece); match != no_piece)
          m_matching.matches[match] = {};
      for (const Index r : group.of_result)
        m_match_of_result[r] = no_piece;
    }
    for (const Index o : left_of_original())
      if (!is_told_of_original[o])
        add_mismatch(Mismatch::missing, {o}, {},
                     describe(m_original, o) + " of the original is not in the result" +
                         (m_is_hidden[o] ? ", or nothing shows that it is: all of its vertices are of other "
                                           "pieces, too, and the result does not number them apart"
                                         : ""));
    for (const Index r : left_of_result())
      if (!is_told_of_result[r])
        add_mismatch(Mismatch::added, {}, {r},
                     describe(m_result, r) + " of the result is no piece of the original");
  }

  // ---- Shapes

  double diagonal_of_original() const
  {
    CGAL::Bbox_3 box;
    for (const Index vertex : used_vertices(m_original.soup))
      box += scaled(m_original.soup.points[vertex], -m_exponent).bbox();
    return std::hypot(box.x_span(), box.y_span(), box.z_span());
  }

  bool has_vertex_of_original(const Piece_match& match) const
  {
    const auto is_of_original = [&](Index position) {
      const Lists::Range here = m_original_at[position];
      return std::any_of(match.of_original.begin(), match.of_original.end(),
                         [&](Index o) { return std::binary_search(here.begin(), here.end(), o); });
    };
    const std::vector<Index> triangles = m_result.triangles_of(match.of_result);
    return std::any_of(triangles.begin(), triangles.end(), [&](Index t) {
      return is_of_original(m_result.position(t, 0)) || is_of_original(m_result.position(t, 1)) ||
             is_of_original(m_result.position(t, 2));
    });
  }

  void judge_shapes()
  {
    std::vector<double> diagonals(m_matching.matches.size()); // of the pieces of the original
    const auto judge = [&](std::size_t i) {
      Piece_match& match = m_matching.matches[i];
      const Shape before(m_original.soup, m_original.triangles_of(match.of_original), m_exponent);
      const Shape now(m_result.soup, m_result.triangles_of(match.of_result), m_exponent);
      const Likeness likeness(now, before);
      match.distance = likeness.distance;
      diagonals[i] = before.diagonal();
      match.turned = likeness.turned;
    };
    tbb::parallel_for(std::size_t(0), m_matching.matches.size(), Cancellation_scope::inherited(judge));
    const double allowed = most_distance_of_own * diagonal_of_original();
    for (std::size_t i = 0; i < m_matching.matches.size(); ++i) {
      const Piece_match& match = m_matching.matches[i];
      const auto what = [&] {
        return describe(m_original, match.of_original) + " of the original and " +
               describe(m_result, match.of_result) + " of the result";
      };
      if (match.distance > most_distance &&
          !(match.distance * diagonals[i] <= allowed && has_vertex_of_original(match))) {
        char percents[32];
        std::snprintf(percents, sizeof percents, "%.0f %%", 100 * match.distance);
        add_mismatch(Mismatch::far, match.of_original, match.of_result,
                     what() + " are " + percents + " of their size apart in the mean");
      }
      if (match.turned >= least_turned)
        add_mismatch(Mismatch::turned, match.of_original, match.of_result,
                     what() + " have their outsides on different sides");
    }
  }

  struct Joined
  {
    std::vector<Index> of_original, of_result;
    bool is_broken; ///< a triangle of the result has corners of different pieces
  };

  Verify_options m_options;
  std::vector<Index> m_positions;
  std::size_t m_position_count;
  Piece_mesh m_result, m_original;
  int m_exponent;
  Lists m_original_at; ///< the pieces of the original at each position
  std::optional<Lists> m_reach;
  std::vector<Index> m_match_of_result, m_match_of_original;
  std::vector<bool> m_is_hidden;      ///< of pieces of the original, as `perhaps_missing` says
  std::vector<Possible_match> m_near; ///< pairs by vertices, whatever their kinds
  std::vector<Joined> m_groups;       ///< groups by positions that did not match
  Piece_matching m_matching;
};

} // namespace

Piece_matching match_pieces(const Triangle_soup& result, const Triangle_soup& original,
                            const Verify_options& options)
{
  return Matching(result, original, options).run();
}

} // namespace selvedge
