// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Disjoint_sets.h"
#include "Lists.h"
#include "Shape.h"
#include "one_to_one.h"
#include "part_names.h"
#include "pieces.h"
#include "positions.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace selvedge {

using namespace internal;

namespace {

// Where more pieces than this meet in a position, it tells nothing; so no list of pairs is longer than
// linear.
constexpr std::size_t most_at_a_position = 64;

// How far a piece may be from the original's, as a share of its size.
constexpr double most_distance = 0.25;
// How much farther than the nearest a piece may be and still be meant.
constexpr double most_excess = 2;
// The share of its area that a piece turns over at least when it is turned inside out: thin cloth that is
// reduced far has half of it nearest to its other side.
constexpr double least_turned = 0.9;

using Kind = std::pair<std::size_t, long>;

Kind kind(const Piece& piece)
{
  return {piece.boundary_loops, piece.euler_characteristic};
}

/// One of the two meshes: its triangles of three distinct positions, and their pieces.
struct Mesh
{
  Mesh(const Triangle_soup& mesh, const Index* positions_of_vertices)
      : soup(mesh), positions(positions_of_vertices),
        numbered(numbered_pieces(soup.triangles, soup.points.size()))
  {
    std::vector<Pair> pairs;
    for (Index t = 0; t < soup.triangles.size(); ++t) {
      const Index a = position(t, 0), b = position(t, 1), c = position(t, 2);
      if (a == b || b == c || c == a)
        numbered.of_triangle[t] = no_piece;
      else
        pairs.emplace_back(numbered.of_triangle[t], t);
    }
    triangles = Lists(numbered.pieces.size(), std::move(pairs));
  }

  Index position(Index triangle, int place) const { return positions[soup.triangles[triangle][place]]; }
  Index piece(Index triangle) const { return numbered.of_triangle[triangle]; }
  const std::vector<Piece>& pieces() const { return numbered.pieces; }

  /// Which pieces there are at each position.
  Lists pieces_at(std::size_t positions_in_all) const
  {
    std::vector<Pair> pairs;
    std::vector<bool> is_done(soup.points.size());
    for (Index t = 0; t < soup.triangles.size(); ++t)
      for (int place = 0; piece(t) != no_piece && place < 3; ++place) {
        const Index vertex = soup.triangles[t][place];
        if (!is_done[vertex])
          pairs.emplace_back(positions[vertex], piece(t));
        is_done[vertex] = true;
      }
    return Lists(positions_in_all, std::move(pairs));
  }

  std::vector<Index> triangles_of(const std::vector<Index>& some_pieces) const
  {
    std::vector<Index> result;
    for (const Index piece : some_pieces)
      result.insert(result.end(), triangles[piece].begin(), triangles[piece].end());
    return result;
  }

  /// The kinds of what some triangles are when they are joined where their positions coincide, in order.
  std::vector<Kind> kinds_by_position(const std::vector<Index>& some_triangles) const
  {
    std::vector<Index_triple> by_position;
    std::vector<Index> numbers;
    for (const Index t : some_triangles)
      by_position.push_back({position(t, 0), position(t, 1), position(t, 2)});
    for (const Index_triple& triple : by_position)
      numbers.insert(numbers.end(), triple.begin(), triple.end());
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    for (Index_triple& triple : by_position)
      for (Index& number : triple)
        number = Index(std::lower_bound(numbers.begin(), numbers.end(), number) - numbers.begin());
    std::vector<Kind> kinds;
    for (const Piece& piece : numbered_pieces(by_position, numbers.size()).pieces)
      kinds.push_back(kind(piece));
    std::sort(kinds.begin(), kinds.end());
    return kinds;
  }

  const Triangle_soup& soup;
  const Index* positions; ///< of the vertices, with common numbers
  Numbered_pieces numbered;
  Lists triangles; ///< of each piece
};

bool is_float(const Point_3& p)
{
  return p.x() == float(p.x()) && p.y() == float(p.y()) && p.z() == float(p.z());
}

bool has_floats_alone(const Triangle_soup& soup)
{
  for (const Index vertex : used_vertices(soup))
    if (!is_float(soup.points[vertex]))
      return false;
  return true;
}

/// The positions of two soups, those of the second following those of the first. When only those of the first
/// have been rounded to 32-bit floats, the others count as if they had been, too.
std::vector<Index> common_positions(const Triangle_soup& result, const Triangle_soup& original)
{
  std::vector<Point_3> points = result.points;
  points.insert(points.end(), original.points.begin(), original.points.end());
  if (has_floats_alone(result) && !has_floats_alone(original))
    for (std::size_t i = result.points.size(); i < points.size(); ++i)
      points[i] = Point_3(float(points[i].x()), float(points[i].y()), float(points[i].z()));
  return position_numbers(points);
}

class Matching
{
public:
  Matching(const Triangle_soup& result, const Triangle_soup& original, const Verify_options& options)
      : m_options(options), m_positions(common_positions(result, original)),
        m_position_count(m_positions.empty() ? 0
                                             : 1 + *std::max_element(m_positions.begin(), m_positions.end())),
        m_result(result, m_positions.data()), m_original(original, m_positions.data() + result.points.size()),
        m_exponent(common_exponent(result, original)), m_original_at(m_original.pieces_at(m_position_count)),
        m_match_of_result(m_result.pieces().size(), no_piece),
        m_match_of_original(m_original.pieces().size(), no_piece)
  {
  }

  Piece_matching run()
  {
    match_by_vertices();
    match_joined(false);
    match_by_distance();
    match_joined(true);
    tell_what_is_left();
    m_matching.matches.erase(
        std::remove_if(m_matching.matches.begin(), m_matching.matches.end(),
                       [](const Piece_match& match) { return match.of_original.empty(); }),
        m_matching.matches.end());
    judge_names();
    if (m_options.are_shapes_judged)
      judge_shapes();
    m_matching.pieces_of_original = m_original.pieces();
    return std::move(m_matching);
  }

private:
  bool is_left_of_result(Index piece) const
  {
    return m_match_of_result[piece] == no_piece && m_result.triangles[piece].size() > 0;
  }
  bool is_left_of_original(Index piece) const
  {
    return m_match_of_original[piece] == no_piece && m_original.triangles[piece].size() > 0;
  }
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

  // Takes the place of the matches that the pieces have.
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
    for (std::size_t position = 0; position < m_position_count; ++position) {
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
    const Part_names result_names(m_result.soup), original_names(m_original.soup);
    std::vector<Possible_match> possible;
    for (auto first = hits.begin(), last = first; first != hits.end(); first = last) {
      last = std::find_if(first, hits.end(), [&](const Pair& pair) { return pair != *first; });
      const auto [r, o] = *first;
      const std::size_t count = std::size_t(last - first);
      if (2 * count < sizes[r])
        continue;
      const double missing = 1 - double(count) / double(sizes[r]);
      const bool differ = result_names.of(*m_result.triangles[r].begin()) !=
                          original_names.of(*m_original.triangles[o].begin());
      m_near.push_back({missing, differ, r, o});
      if (kind(m_result.pieces()[r]) == kind(m_original.pieces()[o]))
        possible.push_back(m_near.back());
    }
    for (const auto& [r, o] :
         one_to_one(std::move(possible), m_result.pieces().size(), m_original.pieces().size()))
      match({o}, {r}, Matched_by::vertices);
  }

  // ---- 2 and 4: joined where positions coincide

  // For every position the pieces of the original there, and, for positions of the result, those with a
  // border vertex within the weld distance.
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

  void add_near_borders(std::vector<Pair>& pairs) const
  {
    const Triangle_soup& original = m_original.soup;
    std::vector<Index_triple> borders; // their vertices, as triangles that are points
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
    std::vector<bool> is_done(m_position_count);
    for (const Index vertex : used_vertices(m_result.soup)) {
      const Index position = m_result.positions[vertex];
      if (is_done[position] || m_original_at[position].size() == 0)
        continue;
      is_done[position] = true;
      const Point_3& p = m_result.soup.points[vertex];
      const double largest = std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
      // Two borders may have gone to one that lies between them, and have been rounded to 32-bit floats.
      const double reach = 2 * m_options.weld_distance * (1 + 1e-9) + largest * 0x1p-22;
      const CGAL::Bbox_3 box(p.x() - reach, p.y() - reach, p.z() - reach, p.x() + reach, p.y() + reach,
                             p.z() + reach);
      const std::size_t first = pairs.size();
      tree.visit([&](const CGAL::Bbox_3& other) { return CGAL::do_overlap(box, other); },
                 [&](Index border) {
                   const Point_3& q = original.points[borders[border][0]];
                   if (std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z()) <= reach)
                     pairs.emplace_back(position, pieces[border]);
                 });
      std::sort(pairs.begin() + std::ptrdiff_t(first), pairs.end());
      pairs.erase(std::unique(pairs.begin() + std::ptrdiff_t(first), pairs.end()), pairs.end());
    }
  }

  // Who can own a triangle of the result: pieces of the original that are within reach of all its corners.
  struct Owners
  {
    bool is_known = false; ///< some corner tells
    bool is_one = false;
    Index piece = no_piece;
    bool is_broken() const { return is_known && piece == no_piece; }
  };

  Owners owners(const Lists& reach, Index triangle) const
  {
    Owners result;
    std::vector<Index> all, both;
    for (int place = 0; place < 3; ++place) {
      const auto here = reach[m_result.position(triangle, place)];
      if (here.size() == 0 || here.size() > most_at_a_position)
        continue;
      if (!result.is_known) {
        all.assign(here.begin(), here.end());
      } else {
        both.clear();
        std::set_intersection(all.begin(), all.end(), here.begin(), here.end(), std::back_inserter(both));
        all.swap(both);
      }
      result.is_known = true;
    }
    result.is_one = all.size() == 1;
    result.piece = all.empty() ? no_piece : all.front();
    return result;
  }

  void match_joined(bool is_by_distance)
  {
    if (is_complete() || is_one_empty())
      return;
    const Lists reach = within_reach();
    const std::size_t results = m_result.pieces().size(), originals = m_original.pieces().size();
    Disjoint_sets sets(results + originals);
    const auto unite = [&](Index r, Index o) { sets.unite(r, results + o); };
    for (const Piece_match& match : m_matching.matches)
      for (const Index r : match.of_result)
        for (const Index o : match.of_original)
          unite(r, o);

    std::vector<bool> is_broken(results), is_owner(originals), owns_nothing(results, true);
    std::vector<Pair> owned;
    std::optional<Nearest_pieces> nearest;
    for (Index t = 0; t < m_result.soup.triangles.size(); ++t) {
      const Index r = m_result.piece(t);
      if (r == no_piece)
        continue;
      Owners found = owners(reach, t);
      if (is_by_distance && !found.is_known) {
        if (!nearest)
          nearest.emplace(m_original.soup, m_original.numbered.of_triangle, m_exponent);
        found = {true, true, nearest->piece_near(centre(t))};
      }
      is_broken[r] = is_broken[r] || found.is_broken();
      if (found.is_one) {
        owned.emplace_back(r, found.piece);
        is_owner[found.piece] = true;
        owns_nothing[r] = false;
      }
    }
    std::sort(owned.begin(), owned.end());
    owned.erase(std::unique(owned.begin(), owned.end()), owned.end());
    for (const auto& [r, o] : owned)
      if (is_left_of_result(r) || is_left_of_original(o))
        unite(r, o);
    for (const Possible_match& possible : m_near)
      if (is_left_of_result(possible.of_result) && owns_nothing[possible.of_result]) {
        unite(possible.of_result, possible.of_original);
        is_owner[possible.of_original] = true;
      }

    std::map<std::size_t, std::pair<std::vector<Index>, std::vector<Index>>> groups; // of original, of result
    for (Index o = 0; o < originals; ++o)
      if (m_original.triangles[o].size() > 0)
        groups[sets.find(results + o)].first.push_back(o);
    for (Index r = 0; r < results; ++r)
      if (m_result.triangles[r].size() > 0)
        groups[sets.find(r)].second.push_back(r);
    for (auto& [set, group] : groups) {
      auto& [of_original, of_result] = group;
      const auto is_left = [&](Index o) { return is_left_of_original(o); };
      const auto is_left_now = [&](Index r) { return is_left_of_result(r); };
      if (of_original.empty() || of_result.empty() ||
          (std::none_of(of_original.begin(), of_original.end(), is_left) &&
           std::none_of(of_result.begin(), of_result.end(), is_left_now)))
        continue;
      const bool is_whole = std::all_of(of_original.begin(), of_original.end(),
                                        [&](Index o) { return is_owner[o] || !is_left(o); });
      const bool has_broken =
          std::any_of(of_result.begin(), of_result.end(), [&](Index r) { return is_broken[r]; });
      const std::vector<Index> before = m_original.triangles_of(of_original),
                               now = m_result.triangles_of(of_result);
      const bool is_told =
          !is_by_distance && (std::any_of(of_original.begin(), of_original.end(),
                                          [&](Index o) { return is_owner[o] && is_left(o); }) ||
                              std::count_if(of_result.begin(), of_result.end(), is_left_now) > 1);
      if (is_whole && m_original.kinds_by_position(before) == m_result.kinds_by_position(now) &&
          (!is_by_distance || are_near(of_original, now)))
        match(std::move(of_original), std::move(of_result), Matched_by::positions);
      else if (is_whole && !has_broken && m_options.weld_distance > 0 && !is_by_distance)
        match(std::move(of_original), std::move(of_result), Matched_by::borders);
      else if (is_told)
        m_groups.push_back({std::move(of_original), std::move(of_result), has_broken});
    }
  }

  Point_3 centre(Index triangle) const
  {
    const auto& [a, b, c] = m_result.soup.triangles[triangle];
    return CGAL::centroid(scaled(m_result.soup.points[a], -m_exponent),
                          scaled(m_result.soup.points[b], -m_exponent),
                          scaled(m_result.soup.points[c], -m_exponent));
  }

  // Whether some triangles of the result and pieces of the original are within a quarter of these pieces'
  // size.
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
    std::map<Pair, double> distances; // of a piece of the result and one of the original
    const auto add = [&](Index r, Index o) {
      const auto [it, is_new] = distances.emplace(Pair(r, o), 0);
      if (is_new)
        it->second = std::max(now[r].root_mean_square_distance(before[o]),
                              before[o].root_mean_square_distance(now[r]));
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
    std::map<Index, double> least_of_result, least_of_original;
    for (const auto& [pair, distance] : distances) {
      const auto lower = [value = distance](std::map<Index, double>& least, Index piece) {
        double& entry = least.emplace(piece, value).first->second;
        entry = std::min(entry, value);
      };
      lower(least_of_result, pair.first);
      lower(least_of_original, pair.second);
    }
    std::vector<Possible_match> possible;
    for (const auto& [pair, distance] : distances) {
      const auto [r, o] = pair;
      if (is_left_of_result(r) && is_left_of_original(o) &&
          kind(m_result.pieces()[r]) == kind(m_original.pieces()[o]) &&
          distance <= most_excess * least_of_result[r] && distance <= most_excess * least_of_original[o] &&
          distance <= most_distance * before[o].diagonal())
        possible.push_back({distance, false, r, o});
    }
    for (const auto& [r, o] :
         one_to_one(std::move(possible), m_result.pieces().size(), m_original.pieces().size()))
      match({o}, {r}, Matched_by::distance);
  }

  // ---- Telling

  static std::string counted(std::size_t count, const char* noun)
  {
    return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
  }

  static std::string describe(const Kind& kind)
  {
    return counted(kind.first, "boundary loop") + " and Euler characteristic " + std::to_string(kind.second);
  }

  /// "piece 3 ('lining', 421 faces around (0.1, 0.9, 0))"
  static std::string describe(const Mesh& mesh, Index piece)
  {
    const Lists::Range triangles = mesh.triangles[piece];
    CGAL::Bbox_3 box;
    for (const Index t : triangles)
      for (const Index vertex : mesh.soup.triangles[t])
        box += mesh.soup.points[vertex].bbox();
    char place[96];
    std::snprintf(place, sizeof place, "(%.4g, %.4g, %.4g)", box.xmin() / 2 + box.xmax() / 2,
                  box.ymin() / 2 + box.ymax() / 2, box.zmin() / 2 + box.zmax() / 2);
    const std::string name = Part_names(mesh.soup).of(*triangles.begin());
    return "piece " + std::to_string(piece + 1) + " (" + (name.empty() ? "" : "'" + name + "', ") +
           counted(triangles.size(), "face") + " around " + place + ")";
  }

  static std::string describe(const Mesh& mesh, const std::vector<Index>& pieces)
  {
    constexpr std::size_t most = 3;
    std::string text = describe(mesh, pieces.front());
    for (std::size_t i = 1; i < std::min(pieces.size(), most); ++i)
      text += ", " + describe(mesh, pieces[i]);
    if (pieces.size() > most)
      text += " and " + std::to_string(pieces.size() - most) + " more";
    return text;
  }

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
    }
    for (const Index o : left_of_original())
      if (!is_told_of_original[o])
        add_mismatch(Mismatch::missing, {o}, {},
                     describe(m_original, o) + " of the original is not in the result");
    for (const Index r : left_of_result())
      if (!is_told_of_result[r])
        add_mismatch(Mismatch::added, {}, {r},
                     describe(m_result, r) + " of the result is no piece of the original");
  }

  // ---- Names

  void judge_names()
  {
    const auto judge = [&](const char* what, const Triangle_labels& now, const Triangle_labels& before) {
      if (now.empty() && before.empty())
        return;
      if (now.empty() || before.empty()) {
        m_matching.names_not_compared.push_back(what);
        return;
      }
      const Common_names names(m_result.soup, now, m_original.soup, before);
      if (!names.is_any_common()) {
        m_matching.names_not_compared.push_back(what);
        return;
      }
      m_matching.names_compared.push_back(what);
      judge_names(what, names);
    };
    judge("group", m_result.soup.groups, m_original.soup.groups);
    judge("object", m_result.soup.objects, m_original.soup.objects);
    judge("material", m_result.soup.materials, m_original.soup.materials);
  }

  void judge_names(const char* what, const Common_names& names)
  {
    if (names.is_one())
      return;
    std::vector<Pair> pairs;
    for (Index t = 0; t < m_original.soup.triangles.size(); ++t)
      for (int place = 0; m_original.piece(t) != no_piece && place < 3; ++place) {
        const Pair pair(m_original.position(t, place), names.before(t));
        if (pairs.empty() || pairs.back() != pair)
          pairs.push_back(pair);
      }
    const Lists names_at(m_position_count, std::move(pairs));
    for (const Piece_match& match : m_matching.matches)
      judge_names(what, names, names_at, match);
  }

  void judge_names(const char* what, const Common_names& names, const Lists& names_at,
                   const Piece_match& match)
  {
    const std::vector<Index> now = m_result.triangles_of(match.of_result),
                             before = m_original.triangles_of(match.of_original);
    std::map<Index, Index> is_there; // the names of the original, with a triangle of each
    for (const Index t : before)
      is_there.emplace(names.before(t), t);
    std::map<Index, Index> is_left;
    for (const Index t : now)
      is_left.emplace(names.now(t), t);
    if (is_there.size() == 1 && is_left.size() == 1 && is_there.begin()->first == is_left.begin()->first)
      return;

    std::optional<Shape> shape;
    // The name that the original has where a triangle of the result is, or the triangle's own if that is one
    // of several.
    const auto name_before = [&](Index t) {
      const Index name = names.now(t);
      bool is_known = false, is_here = true;
      for (int place = 0; place < 3; ++place) {
        const Lists::Range here = names_at[m_result.position(t, place)];
        if (here.size() == 0 || here.size() > most_at_a_position)
          continue;
        is_known = true;
        is_here = is_here && (std::binary_search(here.begin(), here.end(), name) ||
                              std::binary_search(here.begin(), here.end(), names.none()));
      }
      if (is_known && is_here)
        return name;
      if (!shape)
        shape.emplace(m_original.soup, before, m_exponent);
      const Index nearest = names.before(before[shape->nearest(centre(t))]);
      return nearest == names.none() ? name : nearest;
    };

    // Patches: triangles of one name with common vertices.
    std::vector<std::tuple<Index, Index, Index>> corners; // vertex, name, number in `now`
    for (Index i = 0; i < now.size(); ++i)
      for (const Index vertex : m_result.soup.triangles[now[i]])
        corners.emplace_back(vertex, names.now(now[i]), i);
    std::sort(corners.begin(), corners.end());
    Disjoint_sets patches(now.size());
    for (std::size_t i = 1; i < corners.size(); ++i)
      if (std::get<0>(corners[i]) == std::get<0>(corners[i - 1]) &&
          std::get<1>(corners[i]) == std::get<1>(corners[i - 1]))
        patches.unite(std::get<2>(corners[i]), std::get<2>(corners[i - 1]));
    struct Patch
    {
      std::size_t faces = 0, right = 0;
      std::map<Index, std::size_t> others;
    };
    std::map<std::size_t, Patch> found;
    for (Index i = 0; i < now.size(); ++i) {
      Patch& patch = found[patches.find(i)];
      ++patch.faces;
      const Index name = name_before(now[i]);
      if (name == names.now(now[i]))
        ++patch.right;
      else
        ++patch.others[name];
    }
    const auto quoted = [&](Index name) {
      return name == names.none() ? "no name" : "'" + names.text(name) + "'";
    };
    bool is_any_wrong = false;
    for (const auto& [first, patch] : found) {
      if (2 * patch.right >= patch.faces)
        continue;
      is_any_wrong = true;
      const auto most = std::max_element(patch.others.begin(), patch.others.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      add_mismatch(Mismatch::name, match.of_original, match.of_result,
                   std::string("the ") + what + " of " + counted(patch.faces, "face") + " of " +
                       describe(m_result, m_result.piece(now[first])) + " of the result is " +
                       quoted(names.now(now[first])) + ", where the original has " + quoted(most->first));
    }
    if (is_any_wrong)
      return;
    for (const auto& [name, triangle] : is_there)
      if (name != names.none() && is_left.count(name) == 0)
        add_mismatch(Mismatch::name, match.of_original, match.of_result,
                     std::string("the ") + what + ' ' + quoted(name) + " of " +
                         describe(m_original, m_original.piece(triangle)) +
                         " of the original has no face left in the result");
  }

  // ---- Shapes

  void judge_shapes()
  {
    tbb::parallel_for(std::size_t(0), m_matching.matches.size(), [&](std::size_t i) {
      Piece_match& match = m_matching.matches[i];
      const Shape before(m_original.soup, m_original.triangles_of(match.of_original), m_exponent);
      const Shape now(m_result.soup, m_result.triangles_of(match.of_result), m_exponent);
      match.distance =
          std::max(before.root_mean_square_distance(now), now.root_mean_square_distance(before)) /
          before.diagonal();
      match.turned = now.turned_against(before);
    });
    for (const Piece_match& match : m_matching.matches) {
      const auto what = [&] {
        return describe(m_original, match.of_original) + " of the original and " +
               describe(m_result, match.of_result) + " of the result";
      };
      if (match.distance > most_distance) {
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
  Mesh m_result, m_original;
  int m_exponent;
  Lists m_original_at; ///< the pieces of the original at each position
  std::vector<Index> m_match_of_result, m_match_of_original;
  std::vector<Possible_match> m_near; ///< by vertices, of whatever kinds
  std::vector<Joined> m_groups;       ///< those that did not match
  Piece_matching m_matching;
};

} // namespace

Piece_matching match_pieces(const Triangle_soup& result, const Triangle_soup& original,
                            const Verify_options& options)
{
  return Matching(result, original, options).run();
}

} // namespace selvedge
