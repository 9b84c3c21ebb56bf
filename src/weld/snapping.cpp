// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "snapping.h"

#include "Border_sites.h"
#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/geometry/Vertex_motion.h>
#include <selvedge/geometry/star.h>
#include <selvedge/geometry/sweep.h>
#include <selvedge/spatial/Brute_force_index.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace selvedge {
namespace {

/// One run of `snap_borders`.
template <class FaceIndex>
class Border_snapping : internal::Border_sites
{
public:
  explicit Border_snapping(Border_sites&& borders)
      : Border_sites(std::move(borders)), m_moved_to(m_points.size(), s_no_place)
  {
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
      for (const Pair& pair : mutual_partners<FaceIndex>()) {
        Cancellation_scope::check();
        is_changed |= join(pair);
      }
      drop_sewn_sides();
    }
    count();
    return std::move(m_notes);
  }

  /// Hands out the borders as they are now. Afterwards, `place_of` alone may be called.
  Border_sites release() { return std::move(*this); }

  /// Returns the position at which the vertices of a position are now.
  Index place_of(Index position) const
  {
    while (m_moved_to[position] != s_no_place)
      position = m_moved_to[position];
    return position;
  }

private:
  void drop_sewn_sides()
  {
    const std::size_t before = m_sides.size();
    for (Side& side : m_sides)
      side = {place_of(side[0]), place_of(side[1])};
    drop_shared(m_sides);
    m_notes.seam_edges += (before - m_sides.size()) / 2;
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

  CGAL::Bbox_3 face_box(Index face) const
  {
    const auto& [a, b, c] = m_triangles[face];
    return m_points[a].bbox() + m_points[b].bbox() + m_points[c].bbox();
  }

  std::vector<Index> m_moved_to; // by position
  FaceIndex m_index;
  Snapping_notes m_notes;
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
  using internal::Border_sites;
  Border_snapping<FaceIndex> snapping(
      Border_sites(soup, positions, is_frozen, scale(distance), transforms, obstacle_triangles, scale));
  Snapped_borders result;
  result.notes = snapping.run();
  result.notes.distance = distance;
  result.notes.largest_distance = scale.undone(result.notes.largest_distance);
  result.left = gaps_left(snapping.release());

  const std::vector<Point_3> points = soup.points;
  std::vector<Index> first_at(points.size(), Border_sites::s_no_place);
  for (Index v = 0; v < points.size(); ++v) {
    const Index place = snapping.place_of(positions[v]);
    if (place != positions[v])
      soup.points[v] = points[place];
    if (first_at[place] == Border_sites::s_no_place)
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

template Snapped_borders snap_borders<Packed_R_tree>(Triangle_soup&, std::vector<Index>&,
                                                     const std::vector<char>&, double,
                                                     const std::vector<Index>&, std::size_t, const Scale&);
template Snapped_borders snap_borders<Brute_force_index>(Triangle_soup&, std::vector<Index>&,
                                                         const std::vector<char>&, double,
                                                         const std::vector<Index>&, std::size_t,
                                                         const Scale&);

} // namespace selvedge
