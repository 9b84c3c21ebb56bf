// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "snapping.h"

#include "soup/selection.h"
#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/geometry/Vertex_motion.h>
#include <selvedge/geometry/star.h>
#include <selvedge/geometry/sweep.h>
#include <selvedge/spatial/Brute_force_index.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace selvedge {
namespace {

constexpr Index s_no_place = std::numeric_limits<Index>::max();
constexpr int s_halvings = 12; // a seam is usually far narrower than what it is looked for in

/// Why two partners are not snapped together.
enum class Obstacle { rival, frozen, foreign, unmanifold, folding, blocked };

/// One run of `snap_borders`. A *site* is a position on a border; sites are numbered as their positions are.
template <class FaceIndex>
class Border_snapping
{
public:
  Border_snapping(const Triangle_soup& soup, const std::vector<Index>& positions,
                  const std::vector<char>& is_frozen, double distance, const std::vector<Index>& transforms,
                  std::size_t obstacle_triangles, const Scale& scale)
      : m_distance(distance), m_own_triangles(soup.triangles.size() - obstacle_triangles),
        m_moved_to(soup.points.size(), s_no_place)
  {
    m_points.reserve(soup.points.size());
    for (const Point_3& point : soup.points)
      m_points.push_back(scale(point));
    m_triangles.reserve(soup.triangles.size());
    for (const Index_triple& v : soup.triangles)
      m_triangles.push_back({positions[v[0]], positions[v[1]], positions[v[2]]});
    find_borders();
    gather_faces(is_frozen);
    if (!transforms.empty())
      gather_transforms(soup, transforms);
  }

  Snapping_notes run()
  {
    m_notes.border_vertices = m_sites.size();
    if (m_sites.empty())
      return m_notes;
    std::vector<Index> faces(m_triangles.size());
    for (Index face = 0; face < faces.size(); ++face)
      faces[face] = face;
    m_index.build(faces, [this](Index face) { return face_box(face); });

    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      for (const Pair& pair : mutual_partners()) {
        Cancellation_scope::check();
        is_changed |= join(pair);
      }
      drop_sewn_sides();
    }
    count();
    return std::move(m_notes);
  }

  /// Returns what is open within the distance.
  Gaps_left left()
  {
    Gaps_left left;
    std::vector<double> reach(m_sites.size(), m_distance); // within which a site faces a border
    const std::vector<Pair> pairs = mutual_partners(true);
    const Pieces pieces = find_pieces();
    for (const Pair& pair : pairs) {
      const Index low = m_sites[pair.low].position, high = m_sites[pair.high].position;
      if (pieces.are_cards(low, high))
        continue;
      left.tied.emplace_back(low, high);
      reach[pair.low] = reach[pair.high] = pair.distance / 2;
    }
    const FaceIndex sides = index_sides();
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
    const FaceIndex index = index_borders(on_border);
    std::vector<Gap> found;
    Cancellation_poll poll;
    for (const Index i : on_border) {
      for (double within = std::ldexp(result.limit, -s_halvings);;
           within = (std::min)(result.limit, 16 * within)) {
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
        if (least.length <= within)
          found.push_back(least);
        if (least.length <= within || within >= result.limit)
          break;
      }
    }
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

  /// Returns the position at which the vertices of a position are now.
  Index place_of(Index position) const
  {
    while (m_moved_to[position] != s_no_place)
      position = m_moved_to[position];
    return position;
  }

private:
  struct Site
  {
    Index position;
    std::vector<Index> faces;
    std::vector<Index> next; // sites, along the border with the surface on the left
    std::vector<Index> previous;
    std::optional<Index> transform;
    bool is_frozen = false;
    bool is_near = false; // to another border
    bool is_partnered = false;
    bool is_joined = false;
    Obstacle obstacle = Obstacle::frozen; // until a partner is found that is not frozen
  };

  struct Pair
  {
    double distance;
    Index low, high;

    bool operator<(const Pair& other) const
    {
      return std::tie(distance, low, high) < std::tie(other.distance, other.low, other.high);
    }
  };

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

  using Side = std::array<Index, 2>; // from position to position, as the triangle runs

  static std::pair<Index, Index> ends(const Side& side) { return std::minmax(side[0], side[1]); }

  // Keeps the sides that are the only ones between their ends. Later calls get the border sides that are
  // left, and find the same borders as among all sides, since `is_manifold` lets only border edges become one
  // edge.
  static void drop_shared(std::vector<Side>& sides)
  {
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::make_pair(ends(a), a) < std::make_pair(ends(b), b);
    });
    auto kept = sides.begin();
    for (auto first = sides.begin(), beyond = first; first != sides.end(); first = beyond) {
      while (beyond != sides.end() && ends(*beyond) == ends(*first))
        ++beyond;
      if (beyond - first == 1)
        *kept++ = *first;
    }
    sides.erase(kept, sides.end());
  }

  void find_borders()
  {
    m_sides.reserve(3 * m_own_triangles);
    for (std::size_t face = 0; face < m_own_triangles; ++face)
      for (std::size_t k = 0; k < 3; ++k)
        m_sides.push_back({m_triangles[face][k], m_triangles[face][(k + 1) % 3]});
    Cancellation_scope::check();
    drop_shared(m_sides);
    Cancellation_scope::check();
    m_sides.shrink_to_fit();

    m_site_at.assign(m_points.size(), s_no_place);
    for (const Side& side : m_sides)
      m_site_at[side[0]] = m_site_at[side[1]] = 0;
    for (Index position = 0; position < m_site_at.size(); ++position)
      if (m_site_at[position] != s_no_place) {
        m_site_at[position] = Index(m_sites.size());
        m_sites.emplace_back().position = position;
      }
  }

  void gather_faces(const std::vector<char>& is_frozen)
  {
    Cancellation_poll poll;
    for (Index face = 0; face < m_triangles.size(); ++face)
      for (const Index position : m_triangles[face])
        if (poll(); m_site_at[position] != s_no_place) {
          Site& site = m_sites[m_site_at[position]];
          site.faces.push_back(face);
          site.is_frozen |= is_frozen[face] != 0;
        }
  }

  void gather_transforms(const Triangle_soup& soup, const std::vector<Index>& transforms)
  {
    for (Site& site : m_sites)
      for (const Index face : site.faces)
        for (std::size_t k = 0; k < 3; ++k) {
          if (m_triangles[face][k] != site.position)
            continue;
          const Index transform = transforms[soup.triangles[face][k]];
          site.is_frozen |= site.transform.value_or(transform) != transform;
          site.transform = transform;
        }
  }

  void drop_sewn_sides()
  {
    const std::size_t before = m_sides.size();
    for (Side& side : m_sides)
      side = {place_of(side[0]), place_of(side[1])};
    drop_shared(m_sides);
    m_notes.seam_edges += (before - m_sides.size()) / 2;
  }

  const Point_3& point(const Site& site) const { return m_points[site.position]; }

  double distance(const Site& a, const Site& b) const
  {
    const Point_3 &p = point(a), &q = point(b);
    return std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z());
  }

  // Lists for every site the next and the previous ones along the borders, and returns an index of the sites
  // that are on a border now.
  FaceIndex index_borders(std::vector<Index>& on_border)
  {
    for (Site& site : m_sites) {
      site.next.clear();
      site.previous.clear();
    }
    for (const Side& side : m_sides) {
      m_sites[m_site_at[side[0]]].next.push_back(m_site_at[side[1]]);
      m_sites[m_site_at[side[1]]].previous.push_back(m_site_at[side[0]]);
    }
    for (Index i = 0; i < m_sites.size(); ++i)
      if (!m_sites[i].next.empty())
        on_border.push_back(i);
    FaceIndex index;
    index.build(on_border, [this](Index i) { return point(m_sites[i]).bbox(); });
    return index;
  }

  // Returns a box that reaches a little farther than the distance, so that rounding loses nothing.
  static CGAL::Bbox_3 box_around(const Point_3& p, double distance)
  {
    const double reach = 1.001 * distance;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto low = [&](double x) { return std::nextafter(x - reach, -infinity); };
    const auto high = [&](double x) { return std::nextafter(x + reach, infinity); };
    return {low(p.x()), low(p.y()), low(p.z()), high(p.x()), high(p.y()), high(p.z())};
  }

  // Calls function(j) for each other site j on a border within a distance of a site, unless the two have a
  // common face.
  template <class Function>
  void visit_near(const FaceIndex& index, Index i, double within, const Function& function) const
  {
    const Site& site = m_sites[i];
    index.visit_overlapping(box_around(point(site), within), [&](Index j) {
      if (i != j && distance(site, m_sites[j]) <= within && !have_common_face(site, m_sites[j]))
        function(j);
    });
  }

  // Returns the pairs of sites that name each other, in the order in which they are to be snapped together.
  // Frozen sites are neither named nor name others, unless that is asked for, when all is counted.
  std::vector<Pair> mutual_partners(bool are_frozen_named = false)
  {
    std::vector<Index> on_border;
    const FaceIndex index = index_borders(on_border);
    std::vector<Pair> nearest(m_sites.size(), {0, s_no_place, s_no_place});
    Cancellation_poll poll;
    for (const Index i : on_border) {
      Site& site = m_sites[i];
      visit_near(index, i, m_distance, [&](Index j) {
        poll();
        site.is_near = true;
        if (!are_partners(i, j))
          return;
        site.is_partnered = true;
        if ((site.is_frozen || m_sites[j].is_frozen) && !are_frozen_named)
          return;
        if (site.transform != m_sites[j].transform) {
          if (site.obstacle == Obstacle::frozen)
            site.obstacle = Obstacle::foreign;
          return;
        }
        const Pair pair{distance(site, m_sites[j]), (std::min)(i, j), (std::max)(i, j)};
        if (nearest[i].low == s_no_place || pair < nearest[i])
          nearest[i] = pair;
      });
      if (nearest[i].low != s_no_place &&
          (site.obstacle == Obstacle::frozen || site.obstacle == Obstacle::foreign))
        site.obstacle = Obstacle::rival;
    }
    std::vector<Pair> pairs;
    for (const Index i : on_border)
      if (const Pair& pair = nearest[i];
          pair.low == i && nearest[pair.high].low == i && nearest[pair.high].high == pair.high)
        pairs.push_back(pair);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  bool have_common_face(const Site& a, const Site& b) const
  {
    return std::any_of(a.faces.begin(), a.faces.end(), [&](Index face) {
      const Index_triple& triangle = m_triangles[face];
      return std::find(triangle.begin(), triangle.end(), b.position) != triangle.end();
    });
  }

  bool are_partners(Index i, Index j) const { return are_partners_within(m_distance, i, j); }
  bool are_partners_within(double length, Index i, Index j) const
  {
    return gap(i, j) <= length && !is_shortly_followed(i, j, length) && !is_shortly_followed(j, i, length);
  }

  // Returns the least distance at which two sites could be partners, if no short border joins them: that
  // between them, or that between the next ones along an edge beside each which could be sewn.
  double gap(Index i, Index j) const
  {
    const Site &a = m_sites[i], &b = m_sites[j];
    return (std::max)(distance(a, b), (std::min)(gap_beyond(a, b), gap_beyond(b, a)));
  }

  // The same for the border edges that start at a and those that end at b.
  double gap_beyond(const Site& a, const Site& b) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const Index p : a.next)
      for (const Index q : b.previous)
        least = (std::min)(least, p == q ? 0 : distance(m_sites[p], m_sites[q]));
    return least;
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

  FaceIndex index_sides() const
  {
    std::vector<Index> numbers(m_sides.size());
    std::iota(numbers.begin(), numbers.end(), Index(0));
    FaceIndex index;
    index.build(numbers, [&](Index side) { return segment(side).bbox(); });
    return index;
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

  Pieces find_pieces() const
  {
    Pieces pieces{std::vector<Index>(m_points.size()), std::vector<std::array<Index, 2>>(m_points.size())};
    std::vector<Index>& number = pieces.number;
    std::iota(number.begin(), number.end(), Index(0));
    const auto root = [&](Index position) {
      while (number[position] != position)
        position = number[position] = number[number[position]];
      return position;
    };
    Cancellation_poll poll;
    for (std::size_t face = 0; face < m_own_triangles; ++face)
      for (const std::size_t k : {1, 2}) {
        poll();
        const Index a = root(m_triangles[face][0]), b = root(m_triangles[face][k]);
        number[(std::max)(a, b)] = (std::min)(a, b);
      }
    for (Index position = 0; position < number.size(); ++position) {
      number[position] = root(position);
      const Index site = m_site_at[position];
      ++pieces.counts[number[position]][site != s_no_place && !m_sites[site].next.empty()];
    }
    return pieces;
  }

  // Requires that sites know those before and behind them.
  void find_opposite_sides(double limit)
  {
    m_opposite.assign(m_sites.size(), {});
    const Pieces pieces = find_pieces();
    if (pieces.are_all_strips())
      return;
    const FaceIndex sides = index_sides();
    Cancellation_poll poll;
    for (Index i = 0; i < m_sites.size(); ++i) {
      if (m_sites[i].next.empty())
        continue;
      const bool is_of_strip = pieces.is_strip(m_sites[i].position);
      Opposite_side& opposite = m_opposite[i];
      for (double within = std::ldexp(limit, -s_halvings);; within = (std::min)(limit, 16 * within)) {
        sides.visit_overlapping(box_around(point(m_sites[i]), within), [&](Index side) {
          poll();
          if (is_of_strip && pieces.is_strip(m_sides[side][0]))
            return;
          const double length = distance_to_side(i, side);
          if (length <= within && length < opposite.length && runs_opposite(i, side) &&
              is_facing_side(i, side, length))
            opposite = {side, length};
        });
        if (opposite.side != s_no_place || within >= limit)
          break;
      }
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
    for (const Pair& pair : mutual_partners(true)) {
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
      const double step =
          within == gaps.size() ? std::numeric_limits<double>::infinity() : gaps[within].length / length;
      if (2 * within < near || !(step > (std::max)(1., largest_step)) || 3 * continued < within ||
          20 * (number_within(2 * length) - within) > within)
        continue;
      largest_step = step;
      result = {length, within};
    }
    return result;
  }

  // Whether the border leads from i to j within twice a distance, without a branch on the way.
  bool is_shortly_followed(Index i, Index j, double distance_of_partners) const
  {
    double length = 0;
    for (Index at = i; m_sites[at].next.size() == 1 && (at == i || m_sites[at].previous.size() == 1);) {
      const Index next = m_sites[at].next.front();
      length += distance(m_sites[at], m_sites[next]);
      if (length > 2 * distance_of_partners || next == i)
        return false;
      if (next == j)
        return true;
      at = next;
    }
    return false;
  }

  bool join(const Pair& pair)
  {
    // Earlier snaps of this round may have moved the next vertices along the borders.
    if (!are_partners(pair.low, pair.high))
      return false;
    Site *stays = &m_sites[pair.low], *goes = &m_sites[pair.high];
    if (stays->faces.size() < goes->faces.size())
      std::swap(stays, goes);
    std::optional<Obstacle> obstacle = judge(*goes, *stays);
    if (obstacle) {
      std::swap(stays, goes);
      obstacle = judge(*goes, *stays);
    }
    if (!obstacle)
      move(*goes, *stays, pair.distance);
    else
      stays->obstacle = goes->obstacle = *obstacle;
    return !obstacle;
  }

  std::optional<Obstacle> judge(const Site& goes, const Site& stays)
  {
    if (!is_manifold(goes, stays))
      return Obstacle::unmanifold;
    m_star = {point(goes), point(stays), {}, {}};
    for (const Index face : goes.faces) {
      const auto [a, b] = link_edge(face, goes.position);
      m_star.moving.push_back({m_points[a], m_points[b]});
    }
    if (!is_star_motion_clear<Kernel>(m_star))
      return Obstacle::folding;
    if (!are_sweeps_clear(goes))
      return Obstacle::blocked;
    return std::nullopt;
  }

  // Whether the snap makes one edge only of border edges that run opposite ways.
  bool is_manifold(const Site& goes, const Site& stays) const
  {
    struct Uses
    {
      std::array<int, 2> out{0, 0}, in{0, 0}; // sides to and from a neighbour, for the faces of each site
    };
    std::map<Index, Uses> neighbours;
    for (const int which : {0, 1}) {
      const Site& site = which == 0 ? goes : stays;
      for (const Index face : site.faces) {
        const auto [a, b] = link_edge(face, site.position);
        ++neighbours[a].out[which];
        ++neighbours[b].in[which];
      }
    }
    return std::all_of(neighbours.begin(), neighbours.end(), [](const auto& entry) {
      const auto& [out, in] = entry.second;
      const bool is_common = out[0] + in[0] > 0 && out[1] + in[1] > 0;
      return !is_common || (out[0] + in[0] == 1 && out[1] + in[1] == 1 && out[0] == in[1]);
    });
  }

  bool are_sweeps_clear(const Site& goes)
  {
    const CGAL::Bbox_3 path = m_star.from.bbox() + m_star.to.bbox();
    CGAL::Bbox_3 box = path;
    for (const auto& [a, b] : m_star.moving)
      box += a.bbox() + b.bbox();
    m_stationary.clear();
    m_index.visit_overlapping(box, [&](Index face) {
      const Index_triple& triangle = m_triangles[face];
      if (std::find(triangle.begin(), triangle.end(), goes.position) == triangle.end())
        m_stationary.push_back(face);
    });
    for (const auto& [a, b] : m_star.moving) {
      const CGAL::Bbox_3 sweep_box = path + a.bbox() + b.bbox();
      const Sweep_test<Kernel> sweep(m_star.from, m_star.to, a, b);
      for (const Index face : m_stationary) {
        const auto& [p, q, r] = m_triangles[face];
        if (CGAL::do_overlap(sweep_box, face_box(face)) &&
            !sweep.is_clear(m_points[p], m_points[q], m_points[r]))
          return false;
      }
    }
    return true;
  }

  void move(Site& goes, Site& stays, double distance)
  {
    for (const Index face : goes.faces) {
      Index_triple& triangle = m_triangles[face];
      std::replace(triangle.begin(), triangle.end(), goes.position, stays.position);
      m_index.set(face, face_box(face));
    }
    stays.faces.insert(stays.faces.end(), goes.faces.begin(), goes.faces.end());
    goes.faces.clear();
    m_moved_to[goes.position] = stays.position;
    goes.is_joined = stays.is_joined = true;
    join_borders(goes, stays);
    m_notes.snaps.push_back({goes.position, stays.position});
    m_notes.largest_distance = (std::max)(m_notes.largest_distance, distance);
  }

  // Puts `stays` in the place of `goes` on the borders through `goes`. Sides that now lie between the same
  // sites and run opposite ways are borders no more.
  void join_borders(Site& goes, Site& stays)
  {
    const Index from = m_site_at[goes.position], to = m_site_at[stays.position];
    const auto remove = [](std::vector<Index>& sites, Index site) {
      sites.erase(std::find(sites.begin(), sites.end(), site));
    };
    for (const Index next : goes.next)
      std::replace(m_sites[next].previous.begin(), m_sites[next].previous.end(), from, to);
    for (const Index previous : goes.previous)
      std::replace(m_sites[previous].next.begin(), m_sites[previous].next.end(), from, to);
    for (const Index next : std::exchange(goes.next, {}))
      if (const auto it = std::find(stays.previous.begin(), stays.previous.end(), next);
          it != stays.previous.end()) {
        stays.previous.erase(it);
        remove(m_sites[next].next, to);
        remove(m_sites[next].previous, to);
      } else {
        stays.next.push_back(next);
      }
    for (const Index previous : std::exchange(goes.previous, {}))
      if (const auto it = std::find(stays.next.begin(), stays.next.end(), previous); it != stays.next.end()) {
        stays.next.erase(it);
        remove(m_sites[previous].next, to);
        remove(m_sites[previous].previous, to);
      } else {
        stays.previous.push_back(previous);
      }
  }

  void count()
  {
    for (const Site& site : m_sites) {
      m_notes.partnered += site.is_partnered;
      m_notes.near_without_edge += site.is_near && !site.is_partnered;
      if (!site.is_partnered)
        continue;
      ++(site.is_joined                          ? m_notes.snapped
         : site.obstacle == Obstacle::rival      ? m_notes.left_ambiguous
         : site.obstacle == Obstacle::frozen     ? m_notes.left_frozen
         : site.obstacle == Obstacle::foreign    ? m_notes.left_foreign
         : site.obstacle == Obstacle::unmanifold ? m_notes.left_unmanifold
         : site.obstacle == Obstacle::folding    ? m_notes.left_folding
                                                 : m_notes.left_blocked);
    }
  }

  // Returns the two other positions of a face, in its order.
  std::array<Index, 2> link_edge(Index face, Index position) const
  {
    const Index_triple& triangle = m_triangles[face];
    const std::size_t k = std::find(triangle.begin(), triangle.end(), position) - triangle.begin();
    return {triangle[(k + 1) % 3], triangle[(k + 2) % 3]};
  }

  CGAL::Bbox_3 face_box(Index face) const
  {
    const auto& [a, b, c] = m_triangles[face];
    return m_points[a].bbox() + m_points[b].bbox() + m_points[c].bbox();
  }

  std::vector<Point_3> m_points; // divided by the scale, as is the distance
  double m_distance;
  std::size_t m_own_triangles;
  std::vector<Index_triple> m_triangles; // of positions
  std::vector<Side> m_sides;             // of borders
  std::vector<Site> m_sites;
  std::vector<Index> m_site_at;  // by position
  std::vector<Index> m_moved_to; // by position
  FaceIndex m_index;
  Snapping_notes m_notes;
  std::vector<Opposite_side> m_opposite; // by site
  double m_distance_to_edges = 0;        // that is clear

  Vertex_motion<Point_3> m_star;
  std::vector<Index> m_stationary;
};

} // namespace

template <class FaceIndex>
Snapped_borders snap_borders(Triangle_soup& soup, std::vector<Index>& positions,
                             const std::vector<char>& is_frozen, double distance,
                             const std::vector<Index>& transforms, std::size_t obstacle_triangles,
                             const Scale& scale)
{
  if (!(std::isfinite(distance) && distance >= 0))
    throw Argument_error("the weld distance must be a finite number, 0 or larger");
  if (distance == 0)
    return {};
  Border_snapping<FaceIndex> snapping(soup, positions, is_frozen, scale(distance), transforms,
                                      obstacle_triangles, scale);
  Snapped_borders result;
  result.notes = snapping.run();
  result.notes.distance = distance;
  result.notes.largest_distance = scale.undone(result.notes.largest_distance);
  result.left = snapping.left();

  const std::vector<Point_3> points = soup.points;
  std::vector<Index> first_at(points.size(), s_no_place);
  for (Index v = 0; v < points.size(); ++v) {
    const Index place = snapping.place_of(positions[v]);
    if (place != positions[v])
      soup.points[v] = points[place];
    if (first_at[place] == s_no_place)
      first_at[place] = v;
    positions[v] = first_at[place];
  }
  for (auto& [a, b] : result.left.tied) {
    a = first_at[a];
    b = first_at[b];
  }
  for (Index& position : result.left.facing)
    position = first_at[position];
  return result;
}

Open_borders find_open_seams(const Triangle_soup& soup, const std::vector<Index>& positions,
                             const std::vector<Index>& transforms, std::size_t obstacle_triangles,
                             const Scale& scale, bool is_left_listed)
{
  const std::vector<char> is_frozen(soup.triangles.size(), false);
  Border_snapping<Packed_R_tree> snapping(soup, positions, is_frozen, 0, transforms, obstacle_triangles,
                                          scale);
  Border_gaps gaps = snapping.gaps();
  const bool is_open = gaps.clear_length || gaps.clear_length_to_edges;
  Gaps_left left = is_left_listed && is_open ? snapping.left() : Gaps_left();
  for (double& length : gaps.lengths)
    length = scale.undone(length);
  gaps.limit = scale.undone(gaps.limit);
  for (std::optional<double>* length : {&gaps.clear_length, &gaps.clear_length_to_edges})
    if (*length)
      **length = scale.undone(**length);
  return {std::move(gaps), std::move(left)};
}

template Snapped_borders snap_borders<Packed_R_tree>(Triangle_soup&, std::vector<Index>&,
                                                     const std::vector<char>&, double,
                                                     const std::vector<Index>&, std::size_t, const Scale&);
template Snapped_borders snap_borders<Brute_force_index>(Triangle_soup&, std::vector<Index>&,
                                                         const std::vector<char>&, double,
                                                         const std::vector<Index>&, std::size_t,
                                                         const Scale&);

} // namespace selvedge
