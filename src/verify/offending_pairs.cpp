// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "soup/check_soup.h"
#include "verify/Triangle_tree.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/internal/exact_predicates.h>
#include <selvedge/verify.h>

#include <CGAL/intersections.h>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

// Finds the pairs of triangles because of which a mesh is not embedded. `prepare` freezes their faces in an
// input, and `verify` looks for new ones in a result.

namespace selvedge {
namespace {

using Segment_3 = Kernel::Segment_3;
using Triangle_3 = Kernel::Triangle_3;

/// A triangle by its distinct positions, of which a degenerate one may have fewer than three.
struct Face
{
  std::array<const Point_3*, 3> corners;
  int size = 3;
  bool degenerate = false;

  const Point_3& operator[](int i) const { return *corners[i]; }
};

/// Moves the positions that two faces share to the front of both, in one order, and returns their number.
int align(Face& s, Face& t)
{
  int shared = 0;
  for (int i = 0; i < s.size; ++i)
    for (int j = shared; j < t.size; ++j)
      if (s.corners[i] == t.corners[j] || s[i] == t[j]) {
        std::swap(s.corners[i], s.corners[shared]);
        std::swap(t.corners[j], t.corners[shared]);
        ++shared;
        break;
      }
  return shared;
}

bool strictly_on_one_side(CGAL::Orientation a, CGAL::Orientation b)
{
  return a == b && a != CGAL::COPLANAR;
}

/// Whether triangles without a common position meet.
bool meet_unshared(const Face& s, const Face& t)
{
  // CGAL's test begins with the same signs, but in interval arithmetic; static filters settle them faster.
  for (const auto& [plane, other] : {std::tie(s, t), std::tie(t, s)}) {
    const CGAL::Orientation side = CGAL::orientation(plane[0], plane[1], plane[2], other[0]);
    if (strictly_on_one_side(side, CGAL::orientation(plane[0], plane[1], plane[2], other[1])) &&
        strictly_on_one_side(side, CGAL::orientation(plane[0], plane[1], plane[2], other[2])))
      return false;
  }
  return CGAL::do_intersect(Triangle_3(s[0], s[1], s[2]), Triangle_3(t[0], t[1], t[2]));
}

/// Whether two triangles that share corner 0 meet beyond it. If they do, some ray from that corner lies in
/// both; where it first leaves one of them, it crosses the opposite edge of that one, within the other.
bool meet_beyond_corner(const Face& s, const Face& t)
{
  for (const auto& [plane, other] : {std::tie(s, t), std::tie(t, s)})
    if (strictly_on_one_side(CGAL::orientation(plane[0], plane[1], plane[2], other[1]),
                             CGAL::orientation(plane[0], plane[1], plane[2], other[2])))
      return false;
  return CGAL::do_intersect(Triangle_3(s[0], s[1], s[2]), Segment_3(t[1], t[2])) ||
         CGAL::do_intersect(Triangle_3(t[0], t[1], t[2]), Segment_3(s[1], s[2]));
}

/// Whether two triangles that share the edge of corners 0 and 1 meet beyond it.
bool meet_beyond_edge(const Face& s, const Face& t)
{
  return CGAL::orientation(s[0], s[1], s[2], t[2]) == CGAL::COPLANAR &&
         CGAL::coplanar_orientation(s[0], s[1], s[2], t[2]) == CGAL::POSITIVE;
}

// A degenerate face is the union of the segments from corner 0 to its other corners, or corner 0 alone.

bool contains(const Face& face, const Point_3& point)
{
  if (!face.degenerate)
    return Triangle_3(face[0], face[1], face[2]).has_on(point);
  for (int i = 1; i < face.size; ++i)
    if (CGAL::are_ordered_along_line(face[0], point, face[i]))
      return true;
  return false;
}

bool crosses(const Face& face, const Segment_3& segment)
{
  if (!face.degenerate)
    return CGAL::do_intersect(Triangle_3(face[0], face[1], face[2]), segment);
  if (segment.has_on(face[0]))
    return true;
  for (int i = 1; i < face.size; ++i)
    if (CGAL::do_intersect(Segment_3(face[0], face[i]), segment))
      return true;
  return false;
}

/// Whether the segment from corner 0 of a face to another point meets the face beyond that corner.
bool runs_within(const Face& face, const Point_3& end)
{
  if (!face.degenerate)
    return contains(face, end) || CGAL::do_intersect(Segment_3(face[1], face[2]), Segment_3(face[0], end));
  for (int i = 1; i < face.size; ++i)
    if (CGAL::collinear(face[0], face[i], end) &&
        !CGAL::collinear_are_ordered_along_line(face[i], face[0], end))
      return true;
  return false;
}

/// Whether a degenerate face, aligned with another, meets it beyond the positions that they share.
bool degenerate_meets(const Face& s, const Face& t, int shared)
{
  switch (shared) {
  case 0:
    if (contains(t, s[0]))
      return true;
    for (int i = 1; i < s.size; ++i)
      if (crosses(t, Segment_3(s[0], s[i])))
        return true;
    return false;
  case 1:
    for (int i = 1; i < s.size; ++i)
      if (runs_within(t, s[i]))
        return true;
    return false;
  default:
    // The line through two corners of a triangle meets it only in their edge. Two degenerate faces meet when
    // both continue beyond the same shared end.
    return s.size == 3 && t.size == 3 && t.degenerate &&
           ((CGAL::collinear_are_ordered_along_line(s[0], s[1], s[2]) &&
             CGAL::collinear_are_ordered_along_line(t[0], t[1], t[2])) ||
            (CGAL::collinear_are_ordered_along_line(s[1], s[0], s[2]) &&
             CGAL::collinear_are_ordered_along_line(t[1], t[0], t[2])));
  }
}

/// Decides for all pairs of triangles whose boxes meet whether they offend.
class Judge
{
public:
  explicit Judge(const Triangle_soup& soup) : m_soup(soup), m_degenerate(soup.triangles.size())
  {
    internal::require_default_arithmetic();
    Cancellation_scope::check();
    const tbb::blocked_range<std::size_t> all(0, soup.triangles.size(), 4096);
    tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const auto& [a, b, c] = soup.triangles[i];
        m_degenerate[i] = CGAL::collinear(soup.points[a], soup.points[b], soup.points[c]);
      }
    });
  }

  /// Calls `report(pair)` for every offending pair, in no particular order and concurrently.
  template <class Report>
  void judge(const Report& report) const
  {
    for (Index i = 0; i < m_soup.triangles.size(); ++i)
      if (m_degenerate[i])
        report(Offending_pair{i, i, Offence::degenerate});
    Triangle_tree(m_soup.points, m_soup.triangles, Triangle_tree::Search::pairs)
        .for_each_pair([&](Index a, Index b) {
          static thread_local Cancellation_poll poll;
          poll();
          if (const std::optional<Offence> offence = judge(a, b))
            report(Offending_pair{std::min(a, b), std::max(a, b), *offence});
        });
  }

private:
  Face face(Index triangle) const
  {
    const auto& [a, b, c] = m_soup.triangles[triangle];
    Face face{{&m_soup.points[a], &m_soup.points[b], &m_soup.points[c]}};
    face.degenerate = m_degenerate[triangle];
    if (face.degenerate) {
      const auto have_one_position = [](const Point_3* p, const Point_3* q) { return *p == *q; };
      const auto begin = face.corners.begin();
      if (have_one_position(begin[0], begin[2]))
        --face.size;
      face.size = int(std::unique(begin, begin + face.size, have_one_position) - begin);
    }
    return face;
  }

  std::optional<Offence> judge(Index first, Index second) const
  {
    Face s = face(first), t = face(second);
    const int shared = align(s, t);
    if (shared == s.size && shared == t.size)
      return Offence::duplicate;
    const bool meet = s.degenerate   ? degenerate_meets(s, t, shared)
                      : t.degenerate ? degenerate_meets(t, s, shared)
                      : shared == 0  ? meet_unshared(s, t)
                      : shared == 1  ? meet_beyond_corner(s, t)
                                     : meet_beyond_edge(s, t);
    return meet ? std::optional(Offence::intersection) : std::nullopt;
  }

  const Triangle_soup& m_soup;
  std::vector<char> m_degenerate;
};

} // namespace

std::string describe(const Offending_pair& pair, std::size_t triangles)
{
  const auto number = [&](std::size_t t) {
    return std::to_string(t < triangles ? t + 1 : t - triangles + 1);
  };
  const std::string second = number(pair.second) + (pair.second < triangles ? "" : " of the obstacle");
  if (pair.offence == Offence::degenerate)
    return "triangle " + second + " is degenerate";
  const bool is_of_both = pair.first < triangles && pair.second >= triangles;
  return (is_of_both ? "triangle " : "triangles ") + number(pair.first) + " and " +
         (is_of_both ? "triangle " : "") + second +
         (pair.offence == Offence::duplicate ? " have the same three corners" : " intersect");
}

std::vector<Offending_pair> offending_pairs(const Triangle_soup& soup)
{
  check_geometry(soup, "the mesh");
  tbb::enumerable_thread_specific<std::vector<Offending_pair>> found;
  Judge(soup).judge([&](const Offending_pair& pair) { found.local().push_back(pair); });
  std::vector<Offending_pair> pairs;
  for (const std::vector<Offending_pair>& some : found)
    pairs.insert(pairs.end(), some.begin(), some.end());
  Cancellation_poll poll;
  std::sort(pairs.begin(), pairs.end(), [&](const Offending_pair& a, const Offending_pair& b) {
    poll();
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  });
  return pairs;
}

bool is_embedded(const Triangle_soup& soup)
{
  check_geometry(soup, "the mesh");
  // Thrown to end the search, by whichever thread finds the first pair.
  struct Found
  {
  };
  try {
    Judge(soup).judge([](const Offending_pair&) { throw Found(); });
  } catch (const Found&) {
    return false;
  }
  return true;
}

} // namespace selvedge
