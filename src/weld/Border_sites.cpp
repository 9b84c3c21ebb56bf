// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Border_sites.h"

#include "soup/sorted_by.h"

#include <algorithm>

namespace selvedge {
namespace internal {

Border_sites::Border_sites(const Triangle_soup& soup, const std::vector<Index>& positions,
                           const std::vector<char>& is_frozen, double distance,
                           const std::vector<Index>& transforms, std::size_t obstacle_triangles,
                           const Scale& scale)
    : m_distance(distance), m_own_triangles(soup.triangles.size() - obstacle_triangles)
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

void Border_sites::drop_shared(std::vector<Side>& sides) const
{
  const auto ends = [](const Side& side) { return std::minmax(side[0], side[1]); };
  sides = sorted_by(sides, m_points.size(), [&](const Side& side) { return ends(side).second; });
  sides = sorted_by(sides, m_points.size(), [&](const Side& side) { return ends(side).first; });
  auto kept = sides.begin();
  for (auto first = sides.begin(), beyond = first; first != sides.end(); first = beyond) {
    while (beyond != sides.end() && ends(*beyond) == ends(*first))
      ++beyond;
    if (beyond - first == 1)
      *kept++ = *first;
  }
  sides.erase(kept, sides.end());
}

void Border_sites::find_borders()
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

void Border_sites::gather_faces(const std::vector<char>& is_frozen)
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

void Border_sites::gather_transforms(const Triangle_soup& soup, const std::vector<Index>& transforms)
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

bool Border_sites::have_common_face(const Site& a, const Site& b) const
{
  return std::any_of(a.faces.begin(), a.faces.end(), [&](Index face) {
    const Index_triple& triangle = m_triangles[face];
    return std::find(triangle.begin(), triangle.end(), b.position) != triangle.end();
  });
}

double Border_sites::gap(Index i, Index j) const
{
  const Site &a = m_sites[i], &b = m_sites[j];
  return (std::max)(distance(a, b), (std::min)(gap_beyond(a, b), gap_beyond(b, a)));
}

// The same for the border edges that start at a and those that end at b.
double Border_sites::gap_beyond(const Site& a, const Site& b) const
{
  double least = std::numeric_limits<double>::infinity();
  for (const Index p : a.next)
    for (const Index q : b.previous)
      least = (std::min)(least, p == q ? 0 : distance(m_sites[p], m_sites[q]));
  return least;
}

bool Border_sites::is_shortly_followed(Index i, Index j, double distance_of_partners) const
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

std::array<Index, 2> Border_sites::link_edge(Index face, Index position) const
{
  const Index_triple& triangle = m_triangles[face];
  const std::size_t k = std::find(triangle.begin(), triangle.end(), position) - triangle.begin();
  return {triangle[(k + 1) % 3], triangle[(k + 2) % 3]};
}

} // namespace internal
} // namespace selvedge
