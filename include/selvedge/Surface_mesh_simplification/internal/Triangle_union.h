// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TRIANGLE_UNION_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TRIANGLE_UNION_H

#include <selvedge/internal/Vector_of_doubles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// The union of a few triangles, of which one can ask whether it covers another one.
///
/// **Guarantees** Of a triangle that is covered, every point is at most a distance away from one of the
/// triangles, but for rounding: pieces of it cover it, and the corners of each piece are at most so far away
/// from one triangle, to which the distance is a convex function.
///
/// **Not promised** Some that are covered are not found to be: those over very many triangles, and slivers
/// over several that have no area.
///
/// **Exactness** Floating point; accurate near the origin. **Complexity** At most a thousand cuts.
class Triangle_union
{
public:
  using Point = Vector_of_doubles;
  using Triangle = std::array<Point, 3>;

  explicit Triangle_union(double distance) : m_distance(distance) {}

  void add(const Triangle& triangle) { m_triangles.push_back({triangle, planes_of(triangle)}); }

  bool covers(const Triangle& triangle) const
  {
    std::size_t cuts_left = 1000;
    return covers({triangle.begin(), triangle.end()}, 0, cuts_left);
  }

private:
  using Polygon = std::vector<Point>; // convex

  // Through a point, with a unit normal.
  struct Plane
  {
    Point point, normal;

    double height(const Point& p) const { return dot(normal, difference(p, point)); }
  };

  struct Member
  {
    Triangle corners;
    std::optional<std::array<Plane, 3>> sides; // they point out of it; none if it has no area
  };

  static Point between(const Point& a, const Point& b, double share)
  {
    const Point along = difference(b, a);
    return {a[0] + share * along[0], a[1] + share * along[1], a[2] + share * along[2]};
  }

  static std::optional<std::array<Plane, 3>> planes_of(const Triangle& t)
  {
    const Point normal = cross(difference(t[1], t[0]), difference(t[2], t[0]));
    std::array<Plane, 3> sides;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point outwards = cross(difference(t[(i + 1) % 3], t[i]), normal);
      const double length = std::sqrt(dot(outwards, outwards));
      if (!(length > 0))
        return std::nullopt;
      sides[i] = {t[i], {outwards[0] / length, outwards[1] / length, outwards[2] / length}};
    }
    return sides;
  }

  // The distance to some point of the triangle, as a rule to the nearest: it may be too large, not too small.
  static double squared_distance(const Point& p, const Triangle& t)
  {
    const auto squared = [&](const Point& q) {
      const Point offset = difference(p, q);
      return dot(offset, offset);
    };
    double least = squared(t[0]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Point along = difference(t[(i + 1) % 3], t[i]);
      const double length = dot(along, along);
      const double share = length > 0 ? dot(along, difference(p, t[i])) / length : 0;
      least =
          (std::min)(least, squared(between(t[i], t[(i + 1) % 3], (std::min)((std::max)(share, 0.), 1.))));
    }
    const Point b = difference(t[1], t[0]), c = difference(t[2], t[0]), at = difference(p, t[0]);
    const Point normal = cross(b, c);
    const double area = dot(normal, normal);
    const double along_b = dot(normal, cross(at, c)) / area, along_c = dot(normal, cross(b, at)) / area;
    if (area > 0 && along_b >= 0 && along_c >= 0 && along_b + along_c <= 1)
      least = (std::min)(least, squared({t[0][0] + along_b * b[0] + along_c * c[0],
                                         t[0][1] + along_b * b[1] + along_c * c[1],
                                         t[0][2] + along_b * b[2] + along_c * c[2]}));
    return least;
  }

  bool is_near(const Polygon& piece, const Triangle& t) const
  {
    return std::all_of(piece.begin(), piece.end(),
                       [&](const Point& p) { return squared_distance(p, t) <= m_distance * m_distance; });
  }

  // Cuts off what lies beyond a plane, by more than the distance. Returns it; empty if there is nothing.
  Polygon cut(Polygon& piece, const Plane& plane) const
  {
    Polygon beyond, rest;
    bool is_any_beyond = false;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Point &here = piece[i], &next = piece[(i + 1) % piece.size()];
      const double height = plane.height(here), height_of_next = plane.height(next);
      is_any_beyond |= height > m_distance;
      if (height >= 0)
        beyond.push_back(here);
      if (height <= 0)
        rest.push_back(here);
      if ((height > 0 && height_of_next < 0) || (height < 0 && height_of_next > 0)) {
        rest.push_back(between(here, next, height / (height - height_of_next)));
        beyond.push_back(rest.back());
      }
    }
    if (!is_any_beyond)
      return {};
    piece = rest;
    return beyond;
  }

  // Whether a piece is covered, from which those before the first have been cut.
  bool covers(const Polygon& piece, std::size_t first, std::size_t& cuts_left) const
  {
    if (std::any_of(m_triangles.begin(), m_triangles.end(),
                    [&](const Member& member) { return is_near(piece, member.corners); }))
      return true;
    for (std::size_t i = first; i < m_triangles.size(); ++i) {
      if (!m_triangles[i].sides)
        continue;
      Polygon inside = piece;
      std::vector<Polygon> outside;
      for (const Plane& side : *m_triangles[i].sides) {
        if (cuts_left == 0)
          return false;
        --cuts_left;
        if (Polygon beyond = cut(inside, side); !beyond.empty())
          outside.push_back(std::move(beyond));
        if (inside.empty())
          break;
      }
      if (!inside.empty() && is_near(inside, m_triangles[i].corners))
        return std::all_of(outside.begin(), outside.end(),
                           [&](const Polygon& part) { return covers(part, i + 1, cuts_left); });
    }
    return false;
  }

  double m_distance;
  std::vector<Member> m_triangles;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TRIANGLE_UNION_H
