// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>
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

/// The axis along which all of some places have one and the same coordinate, or 3.
template <class Places>
int common_axis(const Places& places)
{
  int axis = 0;
  while (axis < 3 && !std::all_of(places.begin(), places.end(), [&](const Place& place) {
           return place.at[axis] == places.begin()->at[axis];
         }))
    ++axis;
  return axis;
}

int exact_orientation(const Place& p, const Place& q, const Place& r, const Place& s)
{
  if (common_axis(std::array{p, q, r, s}) < 3)
    return 0;
  const Vector origin = exact(p);
  const Number volume = dot(normal(origin, exact(q), exact(r)), difference(exact(s), origin));
  return volume > 0 ? 1 : volume < 0 ? -1 : 0;
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

/// Divides numbers by a power of two, where the largest is far from 1, so that it no longer is. The sign of a
/// determinant of them stays. False when one is not finite.
template <std::size_t N>
bool bring_near_one(std::array<double, N>& numbers)
{
  double largest = 0;
  for (const double number : numbers)
    largest = std::max(largest, std::fabs(number));
  if (!std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); }))
    return false;
  if (largest > 1e-30 && largest < 1e30)
    return true;
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (double& number : numbers)
    number = std::ldexp(number, -exponent);
  return true;
}

/// The sign of orientation(p, q, r, s), or 0 where doubles do not tell.
///
/// The bound is that of stage A in J. R. Shewchuk, Adaptive precision floating-point arithmetic, 1997: (7 +
/// 56ε)ε of the permanent, with ε = 2^-53. What he leaves to the reader, underflow, is the addend: every
/// difference is below 1e30 in size, so what differences, brought near 1, and six products lose below the
/// smallest double stays below 1e-220 in the end.
int certain_orientation(const Coordinates& p, const Coordinates& q, const Coordinates& r,
                        const Coordinates& s)
{
  std::array<double, 9> differences{p[0] - s[0], p[1] - s[1], p[2] - s[2], q[0] - s[0], q[1] - s[1],
                                    q[2] - s[2], r[0] - s[0], r[1] - s[1], r[2] - s[2]};
  if (!bring_near_one(differences))
    return 0;
  const auto& [ax, ay, az, bx, by, bz, cx, cy, cz] = differences;
  const double bxcy = bx * cy, cxby = cx * by, cxay = cx * ay, axcy = ax * cy, axby = ax * by, bxay = bx * ay;
  // So that a positive sign means that s is on the side of the plane pqr from which they turn
  // counter-clockwise.
  const double determinant = -(az * (bxcy - cxby) + bz * (cxay - axcy) + cz * (axby - bxay));
  const double permanent = (std::fabs(bxcy) + std::fabs(cxby)) * std::fabs(az) +
                           (std::fabs(cxay) + std::fabs(axcy)) * std::fabs(bz) +
                           (std::fabs(axby) + std::fabs(bxay)) * std::fabs(cz);
  const double bound = 7.7715611723761027e-16 * permanent + 1e-220;
  if (!(std::fabs(determinant) > bound))
    return 0;
  return determinant > 0 ? 1 : -1;
}

int certain_orientation(const Place& p, const Place& q, const Place& r, const Place& s)
{
  return certain_orientation(p.at, q.at, r.at, s.at);
}

/// The sign of the turn p, q, r, seen along an axis; always exact.
int planar_turn(const Place& p, const Place& q, const Place& r, int axis)
{
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto sign = [](double x) { return (x > 0) - (x < 0); };
  // Whether a difference is zero, and its sign, are exact.
  std::array<double, 4> differences{p.at[u] - r.at[u], p.at[v] - r.at[v], q.at[u] - r.at[u],
                                    q.at[v] - r.at[v]};
  auto& [ax, ay, bx, by] = differences;
  const int left = sign(ax) * sign(by), right = sign(ay) * sign(bx);
  if (left != right)
    return left > right ? 1 : -1;
  if (left == 0)
    return 0;
  // Stage A of Shewchuk's orient2d, with room for underflow.
  if (bring_near_one(differences)) {
    const double determinant = ax * by - ay * bx;
    const double bound = 3.3306690738754716e-16 * std::fabs(ax * by + ay * bx) + 1e-280;
    if (std::fabs(determinant) > bound)
      return sign(determinant);
  }
  const auto difference_of = [](double x, double y) { return Number(Number(x) - Number(y)); };
  const Number exact_determinant = difference_of(p.at[u], r.at[u]) * difference_of(q.at[v], r.at[v]) -
                                   difference_of(p.at[v], r.at[v]) * difference_of(q.at[u], r.at[u]);
  return exact_determinant > 0 ? 1 : exact_determinant < 0 ? -1 : 0;
}

bool is_one_of(const Place& place, const Place* first, std::size_t count)
{
  return std::any_of(first, first + count, [&](const Place& other) { return other.id == place.id; });
}

/// Whether the hulls of two sets of places in a plane across an axis surely meet in no more than the hull of
/// those that they share.
///
/// A line through two of the places, with one set on this side of it and the other on that, is looked for.
/// Then the hulls meet where each of them meets the line, which is in the segment of its places there. Exact;
/// "not surely" still means that they may be clear.
template <class Places, class Other_places>
bool is_clear_in_plane(const Places& first, const Other_places& second, int axis)
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
  const auto trace_of = [&](const auto& places, const auto& others, const Place& p, const Place& q) {
    const int along = p.at[u] != q.at[u] ? u : v;
    Trace trace;
    for (const Place& place : places) {
      const int side = planar_turn(p, q, place, axis);
      if (side != 0) {
        trace.is_one_sided = trace.is_one_sided && trace.side != -side;
        trace.side = side;
        continue;
      }
      trace.is_shared = trace.is_shared && is_one_of(place, others.data(), others.size());
      if (!trace.low || place.at[along] < trace.low->at[along])
        trace.low = &place;
      if (!trace.high || place.at[along] > trace.high->at[along])
        trace.high = &place;
    }
    return std::make_pair(trace, along);
  };
  const auto separates = [&](const Place& p, const Place& q) {
    if (p.at[u] == q.at[u] && p.at[v] == q.at[v])
      return false;
    const auto [one, along] = trace_of(first, second, p, q);
    if (!one.is_one_sided)
      return false;
    const Trace other = trace_of(second, first, p, q).first;
    if (!other.is_one_sided || one.side * other.side > 0 || (one.side == 0 && other.side == 0))
      return false;
    if (!one.low || !other.low || one.is_shared || other.is_shared)
      return true;
    const auto is_behind = [axis_along = along](const Trace& a, const Trace& b) {
      const double end = a.high->at[axis_along], begin = b.low->at[axis_along];
      return end < begin || (end == begin && a.high->id == b.low->id);
    };
    return is_behind(one, other) || is_behind(other, one);
  };
  const auto any_line_of = [&](const auto& places) {
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (separates(places[i], places[j]))
          return true;
    return false;
  };
  return any_line_of(second) || any_line_of(first);
}

enum class Crossing { none, some, unsure };

/// Do an edge and a triangle meet beyond a corner that they share?
Crossing crossing(const Place& p, const Place& q, const Place& x, const Place& y, const Place& z)
{
  const std::array<Place, 3> triangle{x, y, z};
  const bool is_p_shared = is_one_of(p, triangle.data(), 3), is_q_shared = is_one_of(q, triangle.data(), 3);
  if (is_p_shared && is_q_shared)
    return Crossing::none;
  if (is_p_shared || is_q_shared)
    return certain_orientation(x, y, z, is_p_shared ? q : p) != 0 ? Crossing::none : Crossing::unsure;
  const int side_p = certain_orientation(x, y, z, p), side_q = certain_orientation(x, y, z, q);
  if (side_p * side_q > 0)
    return Crossing::none;
  const int xy = certain_orientation(p, q, x, y), yz = certain_orientation(p, q, y, z),
            zx = certain_orientation(p, q, z, x);
  // On different sides of two edges: the line of the edge passes by.
  if (xy * yz < 0 || yz * zx < 0 || zx * xy < 0)
    return Crossing::none;
  return side_p * side_q < 0 && xy != 0 && yz != 0 && zx != 0 ? Crossing::some : Crossing::unsure;
}

} // namespace

Sweep::Sweep(const Place& m, const Place& t, const Place& a, const Place& b, Contact_statistics& statistics)
    : m_corners{m, t, a, b}, m_volume(certain_orientation(m, t, a, b)), m_statistics(statistics)
{
  if (m_volume == 0)
    m_volume = exact_orientation(m, t, a, b);
}

bool Sweep::degenerates() const
{
  if (m_volume != 0)
    return false;
  if (const int axis = common_axis(m_corners); axis < 3)
    return planar_turn(m_corners[2], m_corners[3], m_corners[0], axis) *
               planar_turn(m_corners[2], m_corners[3], m_corners[1], axis) <=
           0;
  const Vector m = exact(m_corners[0]), t = exact(m_corners[1]), a = exact(m_corners[2]),
               b = exact(m_corners[3]);
  // The normal goes in a straight line from the one to the other, and both are parallel.
  return dot(normal(m, a, b), normal(t, a, b)) <= 0;
}

Sweep::Answer Sweep::fast_answer(const Standing& standing) const
{
  const auto& [m, t, a, b] = m_corners;
  const Place* const f = standing.corners.data();
  const std::size_t size = standing.size;
  std::size_t shared_count = 0;
  std::array<bool, 3> is_shared{};
  for (std::size_t i = 0; i < size; ++i)
    shared_count += is_shared[i] = is_one_of(f[i], &t, 1) || is_one_of(f[i], &a, 1) || is_one_of(f[i], &b, 1);
  if (shared_count == size)
    return size == 3 ? Answer::touching : Answer::clear;

  if (m_volume == 0) {
    const auto is_clear = [&, &corners = m_corners](const auto& places) {
      const int axis = common_axis(corners);
      return axis < 3 &&
             std::all_of(places.begin(), places.end(),
                         [&](const Place& place) { return place.at[axis] == corners[0].at[axis]; }) &&
             is_clear_in_plane(corners, places, axis);
    };
    if (size == 3 ? is_clear(standing.corners) : is_clear(std::array{f[0], f[1]}))
      return Answer::clear;
  }
  // A plane in which they have in common no more than they share. First that of the standing face, ...
  if (size == 3) {
    int side = 2;
    for (const Place& corner : m_corners) {
      if (is_one_of(corner, f, 3))
        continue;
      const int here = certain_orientation(f[0], f[1], f[2], corner);
      side = side == 2 || side == here ? here : 0;
    }
    if (side == 1 || side == -1)
      return Answer::clear;
  }
  // ... then those of the four faces of the swept tetrahedron; sides[k][i] is that of corner i.
  static constexpr int s_facets[4][4] = {
      {0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}}; // the last is opposite
  int sides[4][3] = {};
  for (int k = 0; k < 4; ++k) {
    const Place &x = m_corners[s_facets[k][0]], &y = m_corners[s_facets[k][1]],
                &z = m_corners[s_facets[k][2]];
    bool is_apart = true;
    for (std::size_t i = 0; i < size; ++i) {
      if (is_shared[i]) {
        is_apart = is_apart && f[i].id != m_corners[s_facets[k][3]].id;
        continue;
      }
      sides[k][i] = certain_orientation(x, y, z, f[i]);
      is_apart = is_apart && sides[k][i] != 0 && sides[k][i] != m_volume;
      for (std::size_t j = 0; j < i; ++j)
        is_apart = is_apart && (is_shared[j] || sides[k][j] == sides[k][i]);
    }
    if (is_apart)
      return Answer::clear;
  }

  bool is_unsure = false;
  // A corner that stands still, met by the inside of the moving face.
  for (std::size_t i = 0; i < size; ++i) {
    if (is_shared[i])
      continue;
    bool is_outside = false, is_certain = m_volume != 0;
    for (int k = 0; k < 4 && is_certain; ++k) {
      is_outside = is_outside || sides[k][i] == -m_volume;
      is_certain = is_outside || sides[k][i] != 0;
    }
    if (is_certain && !is_outside)
      return Answer::touching;
    is_unsure = is_unsure || !is_certain;
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
  // The moving vertex, meeting the inside of the face that stands still.
  if (size == 3 && add(crossing(m, t, f[0], f[1], f[2])))
    return Answer::touching;
  // What shares an edge can also fold flat onto it: v passes through the plane of the standing face on the
  // side where that is.
  if (size == 3 && is_one_of(a, f, 3) && is_one_of(b, f, 3)) {
    const Place& r = f[is_shared[0] ? is_shared[1] ? 2 : 1 : 0];
    const int at_start = certain_orientation(a, b, r, m), at_end = certain_orientation(a, b, r, t);
    if (at_start * at_end > 0)
      return Answer::clear;
    if (at_start == 0 || at_end == 0)
      return Answer::unsure;
    // At that time o(a,b,v,t) has the sign of o(a,b,m,t), and that of o(a,b,r,t) just when v is on the side
    // of r.
    return m_volume == 0 ? Answer::unsure : m_volume == at_end ? Answer::touching : Answer::clear;
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
    if (is_one_of(standing.corners[i], &m_corners[1], 3))
      shared.push_back(polygon.back());
  }
  return point_beyond_shared(
      {exact(m_corners[0]), exact(m_corners[1]), exact(m_corners[2]), exact(m_corners[3])}, polygon, shared);
}

bool is_degenerate(const std::array<Place, 3>& triangle)
{
  return is_zero(normal(exact(triangle[0]), exact(triangle[1]), exact(triangle[2])));
}

bool do_meet(const std::array<Place, 3>& a, const std::array<Place, 3>& b, Contact_statistics& statistics)
{
  ++statistics.pairs;
  const int axis = common_axis(a);
  if (axis < 3 && axis == common_axis(b) && a[0].at[axis] == b[0].at[axis] && is_clear_in_plane(a, b, axis))
    return false;
  // Apart by the plane of one of them?
  for (const auto& [x, y] : {std::make_pair(&a, &b), std::make_pair(&b, &a)}) {
    int side = 2;
    for (const Place& corner : *y) {
      if (is_one_of(corner, x->data(), 3))
        continue;
      const int here = certain_orientation((*x)[0], (*x)[1], (*x)[2], corner);
      side = side == 2 || side == here ? here : 0;
    }
    if (side == 2)
      return true; // all three are shared
    if (side != 0)
      return false;
  }
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
    if (is_one_of(corner, a.data(), 3))
      shared.push_back(polygon.back());
  }
  return point_beyond_shared({exact(a[0]), exact(a[1]), exact(a[2])}, polygon, shared);
}

} // namespace selvedge::reference
