// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "open_seams.h"

#include "soup/Disjoint_sets.h"
#include <selvedge/Cancellation_scope.h>
#include <selvedge/spatial/Packed_R_tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace selvedge {
namespace {

constexpr int s_halvings = 12; // a seam is usually far narrower than what it is looked for in

/// Looks for what is open between borders, and closes nothing.
class Seam_search : internal::Border_sites
{
public:
  explicit Seam_search(Border_sites&& borders) : Border_sites(std::move(borders)) {}

  /// Returns what is open within the distance.
  Gaps_left left()
  {
    Gaps_left left;
    std::vector<double> reach(m_sites.size(), m_distance); // within which a site faces a border
    const std::vector<Pair> pairs = mutual_partners<Packed_R_tree>(true);
    const Pieces& pieces = found_pieces();
    for (const Pair& pair : pairs) {
      const Index low = m_sites[pair.low].position, high = m_sites[pair.high].position;
      if (pieces.are_cards(low, high))
        continue;
      left.tied.emplace_back(low, high);
      reach[pair.low] = reach[pair.high] = pair.distance / 2;
    }
    const Packed_R_tree& sides = index_of_sides();
    std::vector<char> is_facing(m_sites.size(), false);
    Cancellation_poll poll;
    for (Index i = 0; i < m_sites.size(); ++i)
      if (!m_sites[i].next.empty())
        sides.visit_overlapping(box_around(point(m_sites[i]), reach[i]), [&](Index side) {
          poll();
          is_facing[i] = is_facing[i] || (distance_to_side(i, side) <= reach[i] &&
                                          !pieces.are_cards(m_sites[i].position, m_sides[side][0]) &&
                                          is_facing_side(i, side, m_distance));
        });
    if (m_distance_to_edges > m_distance)
      add_seams_by_edges(left, reach, is_facing);
    for (Index i = 0; i < m_sites.size(); ++i)
      if (is_facing[i])
        left.facing.push_back(m_sites[i].position);
    return left;
  }

  /// Looks for partners without snapping any. The clear length, or 0, becomes the distance.
  Border_gaps gaps()
  {
    Border_gaps result;
    result.border_vertices = m_sites.size();
    result.limit = median_border_edge();
    std::vector<Index> on_border;
    const Packed_R_tree index = index_borders<Packed_R_tree>(on_border);
    std::vector<Gap> found;
    Cancellation_poll poll;
    for (const Index i : on_border)
      search_outward(result.limit, [&](double within) {
        Gap least{std::numeric_limits<double>::infinity(), false};
        visit_near(index, i, within, [&](Index j) {
          poll();
          const double length = gap(i, j);
          if (length > least.length || m_sites[i].transform != m_sites[j].transform ||
              !are_partners_within(length, i, j))
            return;
          // Of several at one distance, none comes first, so that no numbering matters.
          least.is_continued = (length == least.length && least.is_continued) || is_continued(i, j);
          least.length = length;
        });
        const bool is_found = least.length <= within;
        if (is_found)
          found.push_back(least);
        return is_found;
      });
    std::sort(found.begin(), found.end());
    for (const Gap& gap : found)
      result.lengths.push_back(gap.length);
    const Clear_length clear = clear_length(found, result.limit);
    result.clear_length = clear.length;
    result.within_clear_length = clear.within;
    m_distance = clear.length.value_or(0);
    measure_gaps_to_edges(result);
    return result;
  }

private:
  struct Gap
  {
    double length;
    bool is_continued; // by the surface at the partner

    bool operator<(const Gap& other) const { return length < other.length; }
  };

  struct Clear_length
  {
    std::optional<double> length;
    std::size_t within = 0;
  };

  // The nearest side along which another border, or another part of the same, runs the opposite way.
  struct Opposite_side
  {
    Index side = s_no_place;
    double length = std::numeric_limits<double>::infinity();
    bool is_of_seam = false; // the site is in a row of such sites
  };

  // Calls search(distance) for larger and larger distances up to a limit, until it returns true.
  template <class Search>
  static void search_outward(double limit, const Search& search)
  {
    // A limit so small that its share is rounded to zero still has distances below it.
    const double least =
        (std::max)(std::ldexp(limit, -s_halvings), std::numeric_limits<double>::denorm_min());
    for (double within = (std::min)(limit, least); !search(within) && within < limit;)
      within = (std::min)(limit, 16 * within);
  }

  Kernel::Segment_3 segment(Index side) const
  {
    return {m_points[m_sides[side][0]], m_points[m_sides[side][1]]};
  }

  double distance_to_side(Index i, Index side) const
  {
    return std::sqrt(CGAL::squared_distance(point(m_sites[i]), segment(side)));
  }

  std::array<Index, 2> ends_of(Index side) const
  {
    return {m_site_at[m_sides[side][0]], m_site_at[m_sides[side][1]]};
  }

  // Built when it is asked for first, as are the pieces.
  const Packed_R_tree& index_of_sides()
  {
    if (!m_index_of_sides) {
      std::vector<Index> numbers(m_sides.size());
      std::iota(numbers.begin(), numbers.end(), Index(0));
      m_index_of_sides.emplace().build(numbers, [&](Index side) { return segment(side).bbox(); });
    }
    return *m_index_of_sides;
  }

  // Whether the surface continues at a side to which no short stretch of border leads from a site.
  bool is_facing_side(Index i, Index side, double distance_of_partners) const
  {
    const std::array<Index, 2> ends = ends_of(side);
    const auto is_apart = [&](Index j) {
      return j != i && m_sites[j].transform == m_sites[i].transform &&
             !have_common_face(m_sites[i], m_sites[j]) && !is_shortly_followed(i, j, distance_of_partners) &&
             !is_shortly_followed(j, i, distance_of_partners);
    };
    return is_apart(ends[0]) && is_apart(ends[1]) && (is_continued(i, ends[0]) || is_continued(i, ends[1]));
  }

  // Whether the border at a site, without a branch there, and a side run opposite ways, give or take 60°.
  bool runs_opposite(Index i, Index side) const
  {
    const Site& site = m_sites[i];
    if (site.next.size() != 1 || site.previous.size() != 1)
      return false;
    const Kernel::Vector_3 here = point(m_sites[site.next[0]]) - point(m_sites[site.previous[0]]);
    const Kernel::Vector_3 there = segment(side).to_vector();
    return here * there <= -0.5 * std::sqrt(here.squared_length()) * std::sqrt(there.squared_length());
  }

  // Looks for the seams of which `Border_gaps::clear_length_to_edges` tells.
  void measure_gaps_to_edges(Border_gaps& result)
  {
    const double least = std::ldexp(result.limit, -s_halvings); // borders may touch, or all but touch
    find_opposite_sides(result.limit);
    std::vector<Gap> found;
    for (const Opposite_side& opposite : m_opposite)
      if (opposite.is_of_seam && opposite.length > m_distance)
        found.push_back({(std::max)(opposite.length, least), true});
    std::sort(found.begin(), found.end());
    const Clear_length clear = clear_length(found, result.limit);
    result.clear_length_to_edges = clear.length;
    result.within_clear_length_to_edges = clear.within;
    m_distance_to_edges = clear.length.value_or(0);
  }

  // Pieces are connected by positions. A strip has more than half of its positions on borders.
  struct Pieces
  {
    std::vector<Index> number;                // by position
    std::vector<std::array<Index, 2>> counts; // by number: positions inside, and on borders

    bool is_strip(Index position) const
    {
      const auto& [inside, on_borders] = counts[number[position]];
      return inside < on_borders;
    }
    // Whether two positions are of different pieces that have nothing inside.
    bool are_cards(Index a, Index b) const
    {
      return number[a] != number[b] && counts[number[a]][0] == 0 && counts[number[b]][0] == 0;
    }
    bool are_all_strips() const
    {
      return std::all_of(counts.begin(), counts.end(), [](const std::array<Index, 2>& count) {
        return count[1] == 0 || count[0] < count[1];
      });
    }
  };

  // Requires that sites know those before and behind them.
  const Pieces& found_pieces()
  {
    if (!m_pieces)
      m_pieces = find_pieces();
    return *m_pieces;
  }

  Pieces find_pieces() const
  {
    Pieces pieces{std::vector<Index>(m_points.size()), std::vector<std::array<Index, 2>>(m_points.size())};
    internal::Disjoint_sets connected(m_points.size());
    Cancellation_poll poll;
    for (std::size_t face = 0; face < m_own_triangles; ++face)
      for (const std::size_t k : {1, 2}) {
        poll();
        connected.unite(m_triangles[face][0], m_triangles[face][k]);
      }
    for (Index position = 0; position < m_points.size(); ++position) {
      pieces.number[position] = Index(connected.find(position));
      const Index site = m_site_at[position];
      ++pieces.counts[pieces.number[position]][site != s_no_place && !m_sites[site].next.empty()];
    }
    return pieces;
  }

  // Requires that sites know those before and behind them.
  void find_opposite_sides(double limit)
  {
    m_opposite.assign(m_sites.size(), {});
    const Pieces& pieces = found_pieces();
    if (pieces.are_all_strips())
      return;
    const Packed_R_tree& sides = index_of_sides();
    Cancellation_poll poll;
    for (Index i = 0; i < m_sites.size(); ++i) {
      if (m_sites[i].next.empty())
        continue;
      const bool is_of_strip = pieces.is_strip(m_sites[i].position);
      Opposite_side& opposite = m_opposite[i];
      search_outward(limit, [&](double within) {
        sides.visit_overlapping(box_around(point(m_sites[i]), within), [&](Index side) {
          poll();
          if (is_of_strip && pieces.is_strip(m_sides[side][0]))
            return;
          const double length = distance_to_side(i, side);
          if (length <= within && length < opposite.length && runs_opposite(i, side) &&
              is_facing_side(i, side, length))
            opposite = {side, length};
        });
        return opposite.side != s_no_place;
      });
    }
    find_rows(pieces);
  }

  // Finds the sites in rows of at least four that face the border of one piece.
  void find_rows(const Pieces& pieces)
  {
    const auto piece_beyond = [&](Index i) {
      return m_opposite[i].side == s_no_place ? s_no_place : pieces.number[m_sides[m_opposite[i].side][0]];
    };
    std::vector<char> is_seen(m_sites.size(), false);
    for (const bool is_closed : {false, true}) // what is left after rows with a beginning goes around
      for (Index first = 0; first < m_sites.size(); ++first) {
        const Index beyond = piece_beyond(first);
        if (beyond == s_no_place || is_seen[first] ||
            (!is_closed && piece_beyond(m_sites[first].previous[0]) == beyond))
          continue;
        std::vector<Index> row;
        for (Index i = first; piece_beyond(i) == beyond && !is_seen[i]; i = m_sites[i].next[0]) {
          is_seen[i] = true;
          row.push_back(i);
        }
        constexpr std::size_t least_row = 4;
        for (const Index i : row)
          m_opposite[i].is_of_seam = row.size() >= least_row;
      }
  }

  // Adds what is open between the clear length and that to edges: pairs of sites of seams, and sites that
  // face a side.
  void add_seams_by_edges(Gaps_left& left, std::vector<double>& reach, std::vector<char>& is_facing)
  {
    std::vector<char> is_tied(m_sites.size(), false);
    for (const auto& [a, b] : left.tied)
      is_tied[m_site_at[a]] = is_tied[m_site_at[b]] = true;
    m_distance = m_distance_to_edges;
    for (const Pair& pair : mutual_partners<Packed_R_tree>(true)) {
      if (is_tied[pair.low] || is_tied[pair.high] || !is_of_seam(pair.low) || !is_of_seam(pair.high))
        continue;
      left.tied.emplace_back(m_sites[pair.low].position, m_sites[pair.high].position);
      reach[pair.low] = reach[pair.high] = pair.distance / 2;
      is_tied[pair.low] = is_tied[pair.high] = true;
    }
    for (Index i = 0; i < m_sites.size(); ++i)
      if (const Index side = m_opposite[i].side; side != s_no_place) {
        const auto [a, b] = ends_of(side);
        is_facing[i] |= (is_of_seam(i) || is_of_seam(a) || is_of_seam(b)) &&
                        m_opposite[i].length <= (is_tied[i] ? reach[i] : m_distance) &&
                        is_facing_side(i, side, m_distance);
      }
  }

  bool is_of_seam(Index i) const
  {
    return m_opposite[i].is_of_seam && m_opposite[i].length <= m_distance_to_edges;
  }

  double median_border_edge() const
  {
    std::vector<double> lengths;
    lengths.reserve(m_sides.size());
    for (const Side& side : m_sides)
      lengths.push_back(distance(m_sites[m_site_at[side[0]]], m_sites[m_site_at[side[1]]]));
    if (lengths.empty())
      return 0;
    const auto middle = lengths.begin() + std::ptrdiff_t(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
  }

  // Whether the directions into the surface at two sites make an obtuse angle.
  bool is_continued(Index i, Index j) const { return inward(m_sites[i]) * inward(m_sites[j]) < 0; }

  Kernel::Vector_3 inward(const Site& site) const
  {
    Kernel::Vector_3 sum = CGAL::NULL_VECTOR;
    for (const Index face : site.faces) {
      const auto [a, b] = link_edge(face, site.position);
      sum += (m_points[a] - point(site)) + (m_points[b] - point(site));
    }
    return sum;
  }

  // `Border_gaps` says which lengths are clear. The gaps ascend.
  static Clear_length clear_length(const std::vector<Gap>& gaps, double limit)
  {
    const auto number_within = [&](double length) {
      return std::size_t(std::upper_bound(gaps.begin(), gaps.end(), Gap{length, false}) - gaps.begin());
    };
    Clear_length result;
    const std::size_t near = number_within(limit / 2);
    double largest_step = 0;
    std::size_t continued = 0;
    for (std::size_t within = 1; within <= near; ++within) {
      continued += gaps[within - 1].is_continued;
      const double length = gaps[within - 1].length;
      const double infinity = std::numeric_limits<double>::infinity();
      const double step = within == gaps.size() ? infinity
                          : length == 0         ? std::nextafter(1., infinity)
                                                : gaps[within].length / length;
      if (2 * within < near || !(step > (std::max)(1., largest_step)) || 3 * continued < within ||
          20 * (number_within(2 * length) - within) > within)
        continue;
      largest_step = step;
      result = {length, within};
    }
    return result;
  }

  std::optional<Packed_R_tree> m_index_of_sides;
  std::optional<Pieces> m_pieces;
  std::vector<Opposite_side> m_opposite; // by site
  double m_distance_to_edges = 0;        // that is clear
};

} // namespace

Open_borders find_open_seams(const Triangle_soup& soup, const std::vector<Index>& positions,
                             const std::vector<Index>& transforms, std::size_t obstacle_triangles,
                             const Scale& scale, bool is_left_listed)
{
  const std::vector<char> is_frozen(soup.triangles.size(), false);
  Seam_search seams(
      internal::Border_sites(soup, positions, is_frozen, 0, transforms, obstacle_triangles, scale));
  Border_gaps gaps = seams.gaps();
  const bool is_open = gaps.clear_length || gaps.clear_length_to_edges;
  Gaps_left left = is_left_listed && is_open ? seams.left() : Gaps_left();
  for (double& length : gaps.lengths)
    length = scale.undone(length);
  gaps.limit = scale.undone(gaps.limit);
  for (std::optional<double>* length : {&gaps.clear_length, &gaps.clear_length_to_edges})
    if (*length)
      **length = scale.undone(**length);
  return {std::move(gaps), std::move(left)};
}

Gaps_left gaps_left(internal::Border_sites borders)
{
  return Seam_search(std::move(borders)).left();
}

} // namespace selvedge
