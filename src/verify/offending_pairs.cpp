// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/verify.h>

#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace selvedge {
namespace {

using Segment_3 = Kernel::Segment_3;
using Triangle_3 = Kernel::Triangle_3;

/// Where the vertices lie, by rank: along each axis, and as whole positions.
///
/// Boxes of ranks are as exact as boxes of doubles, at every scale, and take half the space.
struct Vertex_ranks
{
  explicit Vertex_ranks(const std::vector<Point_3>& points) : position(points.size())
  {
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), Index(0));
    // Stable, and x last: the order ends up lexicographic, with the vertices of one position side by side.
    for (const int axis : {2, 1, 0}) {
      std::stable_sort(order.begin(), order.end(),
                       [&](Index v, Index w) { return points[v][axis] < points[w][axis]; });
      along[axis].resize(points.size());
      distinct[axis] =
          rank(order, along[axis], [&](Index v, Index w) { return points[v][axis] == points[w][axis]; });
    }
    rank(order, position, [&](Index v, Index w) { return points[v] == points[w]; });
  }

  std::array<std::vector<Index>, 3> along;
  std::array<std::size_t, 3> distinct;
  std::vector<Index> position;

private:
  /// Numbers runs of equal elements, and says how many there are.
  template <class Equal>
  static std::size_t rank(const std::vector<Index>& order, std::vector<Index>& ranks, Equal equal)
  {
    for (std::size_t i = 1; i < order.size(); ++i)
      ranks[order[i]] = ranks[order[i - 1]] + !equal(order[i - 1], order[i]);
    return order.empty() ? 0 : std::size_t(ranks[order.back()]) + 1;
  }
};

/// The box of a triangle in ranks, as `CGAL::box_self_intersection_d` wants it.
class Rank_box
{
public:
  using NT = Index;
  using ID = Index;

  Rank_box(const Vertex_ranks& ranks, const Index_triple& corners, Index triangle) : m_triangle(triangle)
  {
    const auto& [a, b, c] = corners;
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<Index>& along = ranks.along[axis];
      std::tie(m_low[axis], m_high[axis]) = std::minmax({along[a], along[b], along[c]});
    }
  }

  static int dimension() { return 3; }
  NT min_coord(int axis) const { return m_low[axis]; }
  NT max_coord(int axis) const { return m_high[axis]; }
  ID id() const { return m_triangle; }

  void reorder_axes(const std::array<int, 3>& axes)
  {
    const std::array<Index, 3> low = m_low, high = m_high;
    m_low = {low[axes[0]], low[axes[1]], low[axes[2]]};
    m_high = {high[axes[0]], high[axes[1]], high[axes[2]]};
  }

private:
  std::array<Index, 3> m_low, m_high;
  Index m_triangle;
};

/// The boxes of all triangles, with their axes in the order that suits CGAL's traversal.
std::vector<Rank_box> rank_boxes(const Triangle_soup& soup, const Vertex_ranks& ranks)
{
  std::vector<Rank_box> boxes;
  boxes.reserve(soup.triangles.size());
  // How much of each axis a box takes up, summed over all.
  std::array<double, 3> extent = {};
  for (Index i = 0; i < soup.triangles.size(); ++i) {
    boxes.emplace_back(ranks, soup.triangles[i], i);
    for (int axis = 0; axis < 3; ++axis)
      extent[axis] += (1.0 + boxes[i].max_coord(axis) - boxes[i].min_coord(axis)) / ranks.distinct[axis];
  }
  // CGAL divides along axis 2 first and scans along axis 0: that is where the boxes should be short. A sheet
  // across either of these two axes costs several times as much.
  std::array<int, 3> axes = {0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&](int a, int b) { return extent[a] < extent[b]; });
  for (Rank_box& box : boxes)
    box.reorder_axes({axes[1], axes[2], axes[0]});
  return boxes;
}

struct Corner
{
  Index position;
  const Point_3* point;
};

/// A triangle by its distinct positions.
struct Face
{
  std::array<Corner, 3> corners;
  int size = 0;
  bool degenerate = false;

  const Point_3& operator[](int i) const { return *corners[i].point; }
};

/// Brings the positions that two faces share to the front of both, in one order, and counts them.
int align(Face& s, Face& t)
{
  int shared = 0;
  for (int i = 0; i < s.size; ++i)
    for (int j = shared; j < t.size; ++j)
      if (s.corners[i].position == t.corners[j].position) {
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
  // CGAL's test begins with the same signs, but in interval arithmetic: these are settled by static filters.
  for (const auto& [plane, other] : {std::tie(s, t), std::tie(t, s)}) {
    const CGAL::Orientation side = CGAL::orientation(plane[0], plane[1], plane[2], other[0]);
    if (strictly_on_one_side(side, CGAL::orientation(plane[0], plane[1], plane[2], other[1])) &&
        strictly_on_one_side(side, CGAL::orientation(plane[0], plane[1], plane[2], other[2])))
      return false;
  }
  return CGAL::do_intersect(Triangle_3(s[0], s[1], s[2]), Triangle_3(t[0], t[1], t[2]));
}

/// Whether triangles that share corner 0 meet beyond it. Then a ray from there runs in both, and where it
/// first leaves one of them, it does so through the opposite edge, and within the other.
bool meet_beyond_corner(const Face& s, const Face& t)
{
  for (const auto& [plane, other] : {std::tie(s, t), std::tie(t, s)})
    if (strictly_on_one_side(CGAL::orientation(plane[0], plane[1], plane[2], other[1]),
                             CGAL::orientation(plane[0], plane[1], plane[2], other[2])))
      return false;
  return CGAL::do_intersect(Triangle_3(s[0], s[1], s[2]), Segment_3(t[1], t[2])) ||
         CGAL::do_intersect(Triangle_3(t[0], t[1], t[2]), Segment_3(s[1], s[2]));
}

/// Whether triangles that share edge 01 meet beyond it.
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
    // The line of two corners of a triangle meets it in their edge only; two segments may go on past the same
    // end.
    return s.size == 3 && t.size == 3 && t.degenerate &&
           ((CGAL::collinear_are_ordered_along_line(s[0], s[1], s[2]) &&
             CGAL::collinear_are_ordered_along_line(t[0], t[1], t[2])) ||
            (CGAL::collinear_are_ordered_along_line(s[1], s[0], s[2]) &&
             CGAL::collinear_are_ordered_along_line(t[1], t[0], t[2])));
  }
}

class Judge
{
public:
  explicit Judge(const Triangle_soup& soup)
      : m_soup(soup), m_ranks(soup.points), m_degenerate(soup.triangles.size())
  {
    for (Index i = 0; i < soup.triangles.size(); ++i) {
      const auto& [a, b, c] = soup.triangles[i];
      m_degenerate[i] = CGAL::collinear(soup.points[a], soup.points[b], soup.points[c]);
    }
  }

  /// Hands every offending pair to `report`, in no particular order.
  template <class Report>
  void judge(Report report) const
  {
    for (Index i = 0; i < m_soup.triangles.size(); ++i)
      if (m_degenerate[i])
        report(Offending_pair{i, i, Offence::degenerate});
    std::vector<Rank_box> boxes = rank_boxes(m_soup, m_ranks);
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Rank_box& a, const Rank_box& b) {
      if (const std::optional<Offence> offence = judge(a.id(), b.id()))
        report(Offending_pair{std::min(a.id(), b.id()), std::max(a.id(), b.id()), *offence});
    });
  }

private:
  Face face(Index triangle) const
  {
    Face face;
    for (const Index vertex : m_soup.triangles[triangle]) {
      const Corner corner = {m_ranks.position[vertex], &m_soup.points[vertex]};
      const auto end = face.corners.begin() + face.size;
      if (std::none_of(face.corners.begin(), end,
                       [&](const Corner& c) { return c.position == corner.position; }))
        face.corners[face.size++] = corner;
    }
    face.degenerate = m_degenerate[triangle];
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
  Vertex_ranks m_ranks;
  std::vector<bool> m_degenerate;
};

} // namespace

std::vector<Offending_pair> offending_pairs(const Triangle_soup& soup)
{
  std::vector<Offending_pair> pairs;
  Judge(soup).judge([&](const Offending_pair& pair) { pairs.push_back(pair); });
  std::sort(pairs.begin(), pairs.end(), [](const Offending_pair& a, const Offending_pair& b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  });
  return pairs;
}

bool is_embedded(const Triangle_soup& soup)
{
  // The one way out of CGAL's traversal.
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
