// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_WELD_BORDER_SITES_H
#define SELVEDGE_WELD_BORDER_SITES_H

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/internal/Scale.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

namespace selvedge {
namespace internal {

/// The borders of a soup, and which of their vertices are partners, as `snap_borders` says. A *site* is a
/// position on a border; sites are numbered as their positions are. All lengths are divided by the scale.
class Border_sites
{
public:
  static constexpr Index s_no_place = std::numeric_limits<Index>::max();

  /// Parameters are those of `snap_borders`. Partners lie within `distance`, divided by the scale.
  Border_sites(const Triangle_soup& soup, const std::vector<Index>& positions,
               const std::vector<char>& is_frozen, double distance, const std::vector<Index>& transforms,
               std::size_t obstacle_triangles, const Scale& scale);

protected:
  /// Why two partners are not snapped together.
  enum class Obstacle { rival, frozen, foreign, unmanifold, folding, blocked };

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

  using Side = std::array<Index, 2>; // from position to position, as the triangle runs

  // Keeps the sides that are the only ones between their ends. Later calls get the border sides that are
  // left, and find the same borders as among all sides, since `is_manifold` lets only border edges become one
  // edge.
  void drop_shared(std::vector<Side>& sides) const;

  const Point_3& point(const Site& site) const { return m_points[site.position]; }

  double distance(const Site& a, const Site& b) const
  {
    const Point_3 &p = point(a), &q = point(b);
    return std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z());
  }

  // Lists for every site the next and the previous ones along the borders, and returns an index of the sites
  // that are on a border now.
  template <class FaceIndex>
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
  template <class FaceIndex, class Function>
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
  template <class FaceIndex>
  std::vector<Pair> mutual_partners(bool are_frozen_named = false)
  {
    std::vector<Index> on_border;
    const FaceIndex index = index_borders<FaceIndex>(on_border);
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

  bool have_common_face(const Site& a, const Site& b) const;

  bool are_partners(Index i, Index j) const { return are_partners_within(m_distance, i, j); }
  bool are_partners_within(double length, Index i, Index j) const
  {
    return gap(i, j) <= length && !is_shortly_followed(i, j, length) && !is_shortly_followed(j, i, length);
  }

  // Returns the least distance at which two sites could be partners, if no short border joins them: that
  // between them, or that between the next ones along an edge beside each which could be sewn.
  double gap(Index i, Index j) const;

  // Whether the border leads from i to j within twice a distance, without a branch on the way.
  bool is_shortly_followed(Index i, Index j, double distance_of_partners) const;

  // Returns the two other positions of a face, in its order.
  std::array<Index, 2> link_edge(Index face, Index position) const;

  std::vector<Point_3> m_points;
  double m_distance;
  std::size_t m_own_triangles;
  std::vector<Index_triple> m_triangles; // of positions
  std::vector<Side> m_sides;             // of borders
  std::vector<Site> m_sites;
  std::vector<Index> m_site_at; // by position

private:
  void find_borders();
  void gather_faces(const std::vector<char>& is_frozen);
  void gather_transforms(const Triangle_soup& soup, const std::vector<Index>& transforms);
  double gap_beyond(const Site& a, const Site& b) const;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_WELD_BORDER_SITES_H
