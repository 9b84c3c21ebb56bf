// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Kernel/global_functions.h>
#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <sstream>
#include <vector>

namespace selvedge::reference {
namespace {

// The slow way
// ------------------------------------------------------------------------------------------------------

using Number = CGAL::Exact_rational;
using Vector = std::array<Number, 3>;

Vector exact(const Place& place)
{
  return {Number(place.at[0]), Number(place.at[1]), Number(place.at[2])};
}

Vector difference(const Vector& u, const Vector& v)
{
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}

Number dot(const Vector& u, const Vector& v)
{
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

Vector cross(const Vector& u, const Vector& v)
{
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

bool is_zero(const Vector& v)
{
  return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

Vector normal(const Vector& p, const Vector& q, const Vector& r)
{
  return cross(difference(q, p), difference(r, p));
}

/// Points x with (x − point) · direction ≥ 0.
struct Half_space
{
  Vector point, direction;
};

using Polygon = std::vector<Vector>; // convex; a segment is a polygon of two points

Polygon cut(const Polygon& polygon, const Half_space& half_space)
{
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Number side_p = dot(difference(p, half_space.point), half_space.direction);
    const Number side_q = dot(difference(q, half_space.point), half_space.direction);
    if (side_p >= 0)
      result.push_back(p);
    if ((side_p > 0 && side_q < 0) || (side_p < 0 && side_q > 0)) {
      const Number share = side_p / (side_p - side_q);
      const Vector along = difference(q, p);
      result.push_back({p[0] + share * along[0], p[1] + share * along[1], p[2] + share * along[2]});
    }
  }
  return result;
}

Vector opposite(const Vector& v)
{
  return {-v[0], -v[1], -v[2]};
}

/// The hull of some points as unions of intersections of half-spaces.
std::vector<std::vector<Half_space>> hull(const std::vector<Vector>& points)
{
  const auto facet = [](const Vector& p, const Vector& q, const Vector& r, const Vector& inside) {
    const Vector direction = normal(p, q, r);
    const bool is_inward = dot(difference(inside, p), direction) > 0;
    return Half_space{p, is_inward ? direction : opposite(direction)};
  };
  if (points.size() == 4) {
    const Vector &m = points[0], &t = points[1], &a = points[2], &b = points[3];
    if (dot(normal(m, t, a), difference(b, m)) != 0)
      return {{facet(m, t, a, b), facet(m, t, b, a), facet(m, a, b, t), facet(t, a, b, m)}};
  }
  // All in one plane: the proper triangles of the points cover the hull.
  std::vector<std::vector<Half_space>> parts;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Vector &p = points[i], &q = points[j], &r = points[k];
        const Vector up = normal(p, q, r);
        if (is_zero(up))
          continue;
        parts.push_back({{p, up}, {p, opposite(up)}});
        for (const auto& [x, y] : {std::make_pair(p, q), std::make_pair(q, r), std::make_pair(r, p)})
          parts.back().push_back({x, cross(up, difference(y, x))});
      }
  if (!parts.empty())
    return parts;
  // All on one line: the segments between them do.
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const Vector along = difference(points[j], points[i]);
      parts.push_back({{points[i], along}, {points[j], opposite(along)}});
      for (int axis = 0; axis < 3; ++axis) {
        Vector unit{Number(0), Number(0), Number(0)};
        unit[axis] = 1;
        const Vector across = is_zero(along) ? unit : cross(along, unit);
        parts.back().push_back({points[i], across});
        parts.back().push_back({points[i], opposite(across)});
      }
    }
  return parts;
}

bool is_in_hull_of_shared(const Vector& point, const std::vector<Vector>& shared)
{
  if (shared.empty())
    return false;
  if (shared.size() == 1)
    return point == shared[0];
  const Vector along = difference(shared[1], shared[0]), to_point = difference(point, shared[0]);
  const Number share = dot(to_point, along);
  return is_zero(cross(along, to_point)) && share >= 0 && share <= dot(along, along);
}

std::string text_of(const Vector& point)
{
  std::ostringstream text;
  text << point[0] << ' ' << point[1] << ' ' << point[2];
  return text.str();
}

std::optional<std::string> point_beyond_shared(const std::vector<Vector>& solid, const Polygon& polygon,
                                               const std::vector<Vector>& shared)
{
  if (shared.size() == 3)
    return text_of(shared[0]);
  for (const std::vector<Half_space>& part : hull(solid)) {
    Polygon left = polygon;
    for (const Half_space& half_space : part)
      left = cut(left, half_space);
    for (const Vector& point : left)
      if (!is_in_hull_of_shared(point, shared))
        return text_of(point);
  }
  return std::nullopt;
}

// The fast way
// ------------------------------------------------------------------------------------------------------

/// Few enough for the stack.
using Places = boost::container::static_vector<const Place*, 8>;

template <std::size_t N>
Places all_of(const std::array<Place, N>& array, std::size_t size = N)
{
  Places places;
  for (std::size_t i = 0; i < size; ++i)
    places.push_back(&array[i]);
  return places;
}

Point_3 point(const Place& place)
{
  return {place.at[0], place.at[1], place.at[2]};
}

int orientation(const Place& p, const Place& q, const Place& r, const Place& s)
{
  return CGAL::orientation(point(p), point(q), point(r), point(s));
}

/// The sign of the turn p, q, r, seen along an axis.
int planar_turn(const Place& p, const Place& q, const Place& r, int axis)
{
  const auto seen = [u = (axis + 1) % 3, v = (axis + 2) % 3](const Place& place) {
    return Kernel::Point_2(place.at[u], place.at[v]);
  };
  return CGAL::orientation(seen(p), seen(q), seen(r));
}

/// An axis along which three places are seen as a triangle with an area, or 3 when they are on one line.
int axis_across(const Place& p, const Place& q, const Place& r)
{
  int axis = 0;
  while (axis < 3 && planar_turn(p, q, r, axis) == 0)
    ++axis;
  return axis;
}

bool is_one_of(const Place& place, const Places& places)
{
  return std::any_of(places.begin(), places.end(), [&](const Place* other) { return other->id == place.id; });
}

bool are_all_in(const Places& some, const Places& others)
{
  return std::all_of(some.begin(), some.end(), [&](const Place* place) { return is_one_of(*place, others); });
}

/// Whether the hulls of two sets of places in a plane, which is seen along an axis as more than a line,
/// surely meet in no more than the hull of those that they share.
///
/// A line through two of the places, with one set on this side of it and the other on that, is looked for.
/// Then the hulls meet where each of them meets the line, which is in the segment of its places there. Exact;
/// "not surely" still means that they may be clear.
bool is_clear_in_plane(const Places& first, const Places& second, int axis)
{
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  // Those places of a set that lie on the line, as the segment from the lowest to the highest.
  struct Trace
  {
    int side = 0;
    bool is_one_sided = true;
    bool is_shared = true; // all of it
    const Place *low = nullptr, *high = nullptr;
  };
  const auto separates = [&](const Place& p, const Place& q) {
    const int along = p.at[u] != q.at[u] ? u : v;
    if (p.at[along] == q.at[along])
      return false;
    const auto trace_of = [&](const Places& places, const Places& others) {
      Trace trace;
      for (const Place* place : places) {
        const int side = planar_turn(p, q, *place, axis);
        if (side != 0) {
          trace.is_one_sided = trace.is_one_sided && trace.side != -side;
          trace.side = side;
          continue;
        }
        trace.is_shared = trace.is_shared && is_one_of(*place, others);
        if (!trace.low || place->at[along] < trace.low->at[along])
          trace.low = place;
        if (!trace.high || place->at[along] > trace.high->at[along])
          trace.high = place;
      }
      return trace;
    };
    const Trace one = trace_of(first, second);
    if (!one.is_one_sided)
      return false;
    const Trace other = trace_of(second, first);
    if (!other.is_one_sided || one.side * other.side > 0)
      return false;
    if (!one.low || !other.low || one.is_shared || other.is_shared)
      return true;
    const auto is_behind = [along](const Trace& a, const Trace& b) {
      const double end = a.high->at[along], begin = b.low->at[along];
      return end < begin || (end == begin && a.high->id == b.low->id);
    };
    return is_behind(one, other) || is_behind(other, one);
  };
  Places all = second;
  all.insert(all.end(), first.begin(), first.end());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (separates(*all[i], *all[j]))
        return true;
  return false;
}

/// Whether the plane through three places surely parts the hull of these and of one more place, if there is
/// one, from that of others: those are in the plane or on the side where this is not, so that the hulls meet
/// in the plane alone; and there they meet in no more than the hull of what they share.
bool is_parted_by(const std::array<const Place*, 3>& plane, const Place* beyond, int side_beyond,
                  const Places& others)
{
  const auto& [x, y, z] = plane;
  Places in_plane;
  int side = -side_beyond; // of the others that are not in the plane
  for (const Place* place : others) {
    const bool spans_plane = place->id == x->id || place->id == y->id || place->id == z->id;
    const int here = spans_plane ? 0 : orientation(*x, *y, *z, *place);
    if (here == 0)
      in_plane.push_back(place);
    else if (side == 0)
      side = here;
    else if (side != here)
      return false;
  }
  Places own(plane.begin(), plane.end());
  if (beyond && side_beyond == 0)
    own.push_back(beyond);
  if (are_all_in(in_plane, own))
    return true;
  const int axis = axis_across(*x, *y, *z);
  return axis < 3 && is_clear_in_plane(own, in_plane, axis);
}

enum class Crossing { none, some, unsure };

/// Do an edge and a triangle meet beyond a corner that they share?
Crossing crossing(const Place& p, const Place& q, const Place& x, const Place& y, const Place& z)
{
  const Places triangle{&x, &y, &z};
  const bool is_p_shared = is_one_of(p, triangle), is_q_shared = is_one_of(q, triangle);
  if (is_p_shared && is_q_shared)
    return Crossing::none;
  if (is_p_shared || is_q_shared)
    return orientation(x, y, z, is_p_shared ? q : p) != 0 ? Crossing::none : Crossing::unsure;
  const int side_p = orientation(x, y, z, p), side_q = orientation(x, y, z, q);
  if (side_p * side_q > 0)
    return Crossing::none;
  const int xy = orientation(p, q, x, y), yz = orientation(p, q, y, z), zx = orientation(p, q, z, x);
  // On different sides of two edges: the line of the edge passes by.
  if (xy * yz < 0 || yz * zx < 0 || zx * xy < 0)
    return Crossing::none;
  return side_p * side_q < 0 && xy != 0 && yz != 0 && zx != 0 ? Crossing::some : Crossing::unsure;
}

} // namespace

Sweep::Sweep(const Place& m, const Place& t, const Place& a, const Place& b, Contact_statistics& statistics)
    : m_corners{m, t, a, b}, m_volume(orientation(m, t, a, b)), m_statistics(statistics)
{
}

bool Sweep::degenerates() const
{
  if (m_volume != 0)
    return false;
  const auto& [m, t, a, b] = m_corners;
  const int axis = axis_across(m, a, b);
  // What is seen of the area goes in a straight line from the one to the other.
  return axis == 3 || planar_turn(a, b, m, axis) * planar_turn(a, b, t, axis) <= 0;
}

Sweep::Answer Sweep::fast_answer(const Standing& standing) const
{
  const auto& [m, t, a, b] = m_corners;
  const std::array<Place, 3>& f = standing.corners;
  const std::size_t size = standing.size;
  const Places face = all_of(f, size);
  std::size_t shared_count = 0;
  std::array<bool, 3> is_shared{};
  for (std::size_t i = 0; i < size; ++i)
    shared_count += is_shared[i] = f[i].id == t.id || f[i].id == a.id || f[i].id == b.id;
  if (shared_count == size)
    return size == 3 ? Answer::touching : Answer::clear;

  if (size == 3 && is_parted_by({&f[0], &f[1], &f[2]}, nullptr, 0, all_of(m_corners)))
    return Answer::clear;
  // The faces of the swept tetrahedron, with the corner that each has not; all in one plane if it is flat.
  using Facet = std::array<const Place*, 3>;
  const std::pair<Facet, const Place*> facets[] = {
      {{&m, &t, &a}, &b}, {{&m, &b, &t}, &a}, {{&m, &a, &b}, &t}, {{&t, &b, &a}, &m}};
  for (const auto& [facet, corner] : facets)
    if (is_parted_by(facet, corner, m_volume, face))
      return Answer::clear;

  bool is_unsure = false;
  // A corner that stands still, met by the inside of the moving face.
  for (std::size_t i = 0; i < size; ++i) {
    if (is_shared[i])
      continue;
    bool is_outside = false, is_certain = true;
    for (const auto& [facet, corner] : facets) {
      const int side = orientation(*facet[0], *facet[1], *facet[2], f[i]);
      is_outside = is_outside || (side != 0 && side != m_volume);
      is_certain = is_certain && side != 0;
    }
    if (is_certain && !is_outside)
      return Answer::touching;
    is_unsure = is_unsure || !(is_outside || is_certain);
  }
  const auto add = [&](Crossing answer) {
    is_unsure = is_unsure || answer == Crossing::unsure;
    return answer == Crossing::some;
  };
  // An edge that stands still, met by one of the two edges that move.
  for (std::size_t i = 0; i < (size == 3 ? 3 : 1); ++i)
    for (const Place* end : {&a, &b})
      if (add(crossing(f[i], f[(i + 1) % size], m, t, *end)))
        return Answer::touching;
  if (size == 3) {
    // The moving vertex, meeting the inside of the face that stands still.
    if (add(crossing(m, t, f[0], f[1], f[2])))
      return Answer::touching;
    // What shares an edge can also fold flat onto it: v passes through the plane of the standing face on the
    // side where that is.
    if (is_one_of(a, face) && is_one_of(b, face)) {
      const Place& r = f[is_shared[0] ? is_shared[1] ? 2 : 1 : 0];
      const int at_start = orientation(a, b, r, m), at_end = orientation(a, b, r, t);
      if (at_start * at_end > 0)
        return Answer::clear;
      if (at_start == 0 || at_end == 0 || m_volume == 0)
        return Answer::unsure;
      // At that time o(a,b,v,t) has the sign of o(a,b,m,t), and that of o(a,b,r,t) just when v is on the side
      // of r.
      return m_volume == at_end ? Answer::touching : Answer::clear;
    }
  }
  return is_unsure ? Answer::unsure : Answer::clear;
}

bool Sweep::touches(const Standing& standing) const
{
  ++m_statistics.pairs;
  const Answer answer = fast_answer(standing);
  if (answer != Answer::unsure)
    return answer == Answer::touching;
  ++m_statistics.exact;
  return contact(standing).has_value();
}

std::optional<std::string> Sweep::contact(const Standing& standing) const
{
  std::vector<Vector> shared;
  Polygon polygon;
  for (std::size_t i = 0; i < standing.size; ++i) {
    polygon.push_back(exact(standing.corners[i]));
    if (is_one_of(standing.corners[i], {&m_corners[1], &m_corners[2], &m_corners[3]}))
      shared.push_back(polygon.back());
  }
  return point_beyond_shared(
      {exact(m_corners[0]), exact(m_corners[1]), exact(m_corners[2]), exact(m_corners[3])}, polygon, shared);
}

bool is_degenerate(const std::array<Place, 3>& triangle)
{
  return axis_across(triangle[0], triangle[1], triangle[2]) == 3;
}

bool is_between(const Place& p, const Place& x, const Place& q)
{
  for (std::size_t i = 0; i < 3; ++i)
    if (p.at[i] != q.at[i])
      return std::min(p.at[i], q.at[i]) < x.at[i] && x.at[i] < std::max(p.at[i], q.at[i]);
  return false;
}

bool do_meet(const std::array<Place, 3>& a, const std::array<Place, 3>& b, Contact_statistics& statistics)
{
  ++statistics.pairs;
  if (are_all_in(all_of(a), all_of(b)))
    return true;
  for (const auto& [x, y] : {std::make_pair(&a, &b), std::make_pair(&b, &a)})
    if (is_parted_by({&(*x)[0], &(*x)[1], &(*x)[2]}, nullptr, 0, all_of(*y)))
      return false;
  bool is_unsure = false;
  for (const auto& [x, y] : {std::make_pair(&a, &b), std::make_pair(&b, &a)})
    for (std::size_t i = 0; i < 3; ++i) {
      const Crossing answer = crossing((*x)[i], (*x)[(i + 1) % 3], (*y)[0], (*y)[1], (*y)[2]);
      if (answer == Crossing::some)
        return true;
      is_unsure = is_unsure || answer == Crossing::unsure;
    }
  if (!is_unsure)
    return false;
  ++statistics.exact;
  return meeting_point(a, b).has_value();
}

std::optional<std::string> meeting_point(const std::array<Place, 3>& a, const std::array<Place, 3>& b)
{
  std::vector<Vector> shared;
  Polygon polygon;
  for (const Place& corner : b) {
    polygon.push_back(exact(corner));
    if (is_one_of(corner, all_of(a)))
      shared.push_back(polygon.back());
  }
  return point_beyond_shared({exact(a[0]), exact(a[1]), exact(a[2])}, polygon, shared);
}

} // namespace selvedge::reference
