// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ORIGINAL_SURFACE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ORIGINAL_SURFACE_H

#include <selvedge/internal/Packed_numbers.h>
#include <selvedge/internal/nearest_on_triangle.h>
#include <selvedge/spatial/Packed_R_tree.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace selvedge {
namespace internal {

/// The triangles of a mesh as it was, of which one can ask for a point near another.
///
/// The neighbours of triangles are found when there have been some questions, and an index is made when there
/// have been more, since most reductions of dense meshes ask few. It has several boxes for a sliver askew to
/// the axes, one for each part of its length: one box around all of it would say little about it.
///
/// **Exactness** Floating point. **Complexity** O(n) for the first questions about n triangles, and about
/// O(log n) for others. Copies share nothing.
class Original_surface
{
  using Kernel = CGAL::Simple_cartesian<double>;

public:
  /// `points` outlives this object.
  explicit Original_surface(const std::vector<Kernel::Point_3>& points) : m_points(points) {}

  using Number = std::uint32_t;
  using Point = Kernel::Point_3;

  /// Makes room for triangles to come, whose corners are among the first `points` points. Call it before any
  /// is added.
  void reserve(std::size_t triangles, std::size_t points)
  {
    m_corners = Packed_numbers(points);
    m_corners.reserve(3 * triangles);
  }

  /// Adds a triangle, whose corners are among the points with these numbers. Call it before any question.
  void add(const std::array<Number, 3>& triangle)
  {
    for (const Number corner : triangle)
      m_corners.push_back(corner);
  }

  std::size_t number_of_triangles() const { return m_corners.size() / 3; }
  std::array<Number, 3> triangle(std::size_t number) const
  {
    return {m_corners[3 * number], m_corners[3 * number + 1], m_corners[3 * number + 2]};
  }

  /// Whether the index has been made, which answers sooner than several triangles.
  bool has_index() const { return m_index.has_value(); }

  /// Returns the point of this triangle that is nearest to `point`, unless it is farther away than the root
  /// of `squared_distance`.
  std::optional<Point> near_point(const Point& point, double squared_distance, Number triangle) const
  {
    return point_within(squared_distance, nearest(point, triangle));
  }

  /// Lets the next question begin at a triangle, as if it had been asked last.
  void start_at(Number triangle) const { m_last = triangle; }

  /// Returns such a point of the triangle that was asked last; or, once neighbours are known, of the one
  /// beyond the side on which the nearest point of that is, and so on for a few steps. None says nothing of
  /// other triangles.
  std::optional<Point> near_point_beside(const Point& point, double squared_distance) const
  {
    Number triangle = m_last, before = s_none;
    for (int step = 0; step < s_most_steps && triangle != s_none; ++step) {
      const Nearest_on_triangle here = nearest(point, triangle);
      if (const auto found = point_within(squared_distance, here); found || m_neighbours.empty())
        return found;
      Number beyond = s_none;
      for (std::size_t i = 0; i < 3 && beyond == s_none; ++i)
        if (here.weights[i] == 0 && m_neighbours[triangle][i] != before)
          beyond = m_neighbours[triangle][i];
      before = triangle;
      triangle = beyond;
    }
    return {};
  }

  /// Returns such a point of any triangle. It is fast when one has a number near that of the triangle that
  /// was asked last, as neighbours have in most meshes.
  std::optional<Point> near_point(const Point& point, double squared_distance) const
  {
    if (m_neighbours.empty() && m_compared > s_boxes_per_side * number_of_triangles())
      find_neighbours();
    const double radius = (1 + 1e-9) * std::sqrt(squared_distance);
    if (!m_index) {
      if (m_compared < s_boxes_per_index * number_of_triangles())
        return found_by_scan(point, squared_distance, radius);
      make_index();
    }
    std::optional<Point> found;
    const auto find_within = [&](double distance) {
      return m_index->has_overlapping(box_around(point, distance), [&](Number of_index) {
        found = near_point(point, squared_distance, triangle_of(of_index));
        return found.has_value();
      });
    };
    // Most points that are near are far nearer, and few boxes meet a small one.
    if (!find_within(radius / 8))
      find_within(radius);
    return found;
  }

private:
  // To ask one triangle takes about as long as to compare so many boxes, and to make the index as long as to
  // compare so many for each triangle. To find neighbours takes less.
  static constexpr std::size_t s_boxes_per_triangle = 8, s_boxes_per_side = 8, s_boxes_per_index = 32;

  static constexpr int s_most_steps = 8; // of a walk
  static constexpr Number s_none = std::numeric_limits<Number>::max();

  Nearest_on_triangle nearest(const Point& point, Number triangle) const
  {
    m_last = triangle;
    m_compared += s_boxes_per_triangle;
    const auto vector = [](const Point& p) { return Vector_of_doubles{p.x(), p.y(), p.z()}; };
    const auto& [a, b, c] = this->triangle(triangle);
    return nearest_on_triangle({vector(m_points[a]), vector(m_points[b]), vector(m_points[c])},
                               vector(point));
  }

  static std::optional<Point> point_within(double squared_distance, const Nearest_on_triangle& nearest)
  {
    if (!(nearest.squared_distance <= squared_distance))
      return {};
    return Point(nearest.point[0], nearest.point[1], nearest.point[2]);
  }

  static CGAL::Bbox_3 box_around(const Point& point, double radius)
  {
    return {point.x() - radius, point.y() - radius, point.z() - radius,
            point.x() + radius, point.y() + radius, point.z() + radius};
  }

  // Asks the triangle that was asked last, those with the numbers beside its, and those beside these.
  std::optional<Point> found_by_scan(const Point& point, double squared_distance, double radius) const
  {
    const CGAL::Bbox_3 box = box_around(point, radius);
    std::optional<Point> found;
    const auto is_found = [&](Number triangle) {
      ++m_compared;
      if (CGAL::do_overlap(box, triangle_at(triangle).bbox()))
        found = near_point(point, squared_distance, triangle);
      return found.has_value();
    };
    const Number start = m_last, size = Number(number_of_triangles());
    for (Number i = 0; i <= start || i < size - start; ++i)
      if ((i <= start && is_found(start - i)) || (i > 0 && i < size - start && is_found(start + i)))
        break;
    return found;
  }

  Kernel::Triangle_3 triangle_at(Number number) const
  {
    const auto& [a, b, c] = triangle(number);
    return {m_points[a], m_points[b], m_points[c]};
  }

  Number triangle_of(Number part) const
  {
    return part < number_of_triangles() ? part : m_triangle_of_part[part - number_of_triangles()];
  }

  void make_index() const
  {
    // Parts are numbered as the triangles are, and those of slivers after them.
    std::vector<Number> parts;
    std::vector<CGAL::Bbox_3> boxes; // of parts of slivers
    const Number triangles = Number(number_of_triangles());
    parts.reserve(triangles);
    for (Number i = 0; i < triangles; ++i) {
      const std::size_t first = boxes.size();
      add_boxes(triangle_at(i), boxes);
      if (boxes.size() == first)
        parts.push_back(i);
      for (std::size_t part = first; part < boxes.size(); ++part) {
        parts.push_back(Number(triangles + part));
        m_triangle_of_part.push_back(i);
      }
    }
    m_index.emplace();
    m_index->build(parts, [&](Number part) {
      return part < triangles ? triangle_at(part).bbox() : boxes[part - triangles];
    });
  }

  void find_neighbours() const
  {
    m_neighbours.assign(number_of_triangles(), {s_none, s_none, s_none});
    // The sides by their lower corner: the higher one, the triangle, and the corner opposite.
    struct Side
    {
      Number higher, triangle;
      std::uint8_t corner;
    };
    std::vector<Number> first(m_points.size() + 1, 0);
    const auto for_each_side = [&](const auto& function) {
      for (Number number = 0; number < number_of_triangles(); ++number) {
        const std::array<Number, 3> corners = triangle(number);
        for (std::size_t i = 0; i < 3; ++i) {
          const auto [lower, higher] = std::minmax(corners[(i + 1) % 3], corners[(i + 2) % 3]);
          function(lower, Side{higher, number, std::uint8_t(i)});
        }
      }
    };
    for_each_side([&](Number lower, const Side&) { ++first[lower + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Side> sides(first.back());
    std::vector<Number> beyond = first;
    for_each_side([&](Number lower, const Side& side) {
      const auto begin = sides.begin() + std::ptrdiff_t(first[lower]);
      const auto end = sides.begin() + std::ptrdiff_t(beyond[lower]);
      const auto other = std::find_if(begin, end, [&](const Side& s) { return s.higher == side.higher; });
      if (other == end) {
        sides[beyond[lower]++] = side;
        return;
      }
      m_neighbours[side.triangle][side.corner] = other->triangle;
      m_neighbours[other->triangle][other->corner] = side.triangle;
    });
  }

  // Adds boxes that cover a triangle if it is thin, and its box wide in two directions.
  static void add_boxes(const Kernel::Triangle_3& triangle, std::vector<CGAL::Bbox_3>& boxes)
  {
    const CGAL::Bbox_3 box = triangle.bbox();
    std::array<double, 3> widths{box.x_span(), box.y_span(), box.z_span()};
    std::sort(widths.begin(), widths.end());
    std::size_t longest = 0;
    std::array<double, 3> squares;
    for (int i = 0; i < 3; ++i) {
      squares[std::size_t(i)] = CGAL::squared_distance(triangle[i], triangle[i + 1]);
      if (squares[std::size_t(i)] > squares[longest])
        longest = std::size_t(i);
    }
    // The width of the triangle is its double area by its longest side.
    const double width = std::sqrt(4 * triangle.squared_area() / squares[longest]);
    constexpr int most_parts = 8;
    if (!(widths[1] > most_parts * width))
      return;
    // From a to b on the longest side and through c on the others, at equal shares of the way.
    const Point &a = triangle[int(longest)], &b = triangle[int(longest) + 1], &c = triangle[int(longest) + 2];
    const double at_c = (std::min)((std::max)(((c - a) * (b - a)) / squares[longest], 0.), 1.);
    const auto between = [](const Point& p, const Point& q, double share) { return p + share * (q - p); };
    const auto across = [&](double share) {
      const Point beside = share < at_c ? between(a, c, share / at_c)
                                        : between(c, b, at_c < 1 ? (share - at_c) / (1 - at_c) : 1);
      return between(a, b, share).bbox() + beside.bbox();
    };
    // Points between others are rounded by less than this.
    const double margin =
        0x1p-48 * (std::max)({std::fabs(box.xmin()), std::fabs(box.ymin()), std::fabs(box.zmin()),
                              std::fabs(box.xmax()), std::fabs(box.ymax()), std::fabs(box.zmax())});
    for (int i = 0; i < most_parts; ++i) {
      const double from = double(i) / most_parts, to = double(i + 1) / most_parts;
      CGAL::Bbox_3 part = across(from) + across(to);
      if (from <= at_c && at_c <= to)
        part += c.bbox();
      boxes.emplace_back(part.xmin() - margin, part.ymin() - margin, part.zmin() - margin,
                         part.xmax() + margin, part.ymax() + margin, part.zmax() + margin);
    }
  }

  const std::vector<Point>& m_points;
  Packed_numbers m_corners;                       // three of each triangle
  mutable std::optional<Packed_R_tree> m_index;   // of parts of triangles
  mutable std::vector<Number> m_triangle_of_part; // those of slivers
  // Of each triangle, beyond the side opposite to each corner; empty until they are of use.
  mutable std::vector<std::array<Number, 3>> m_neighbours;
  mutable Number m_last = 0;          // the triangle that was asked last
  mutable std::size_t m_compared = 0; // how many boxes, to decide when to make the index
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ORIGINAL_SURFACE_H
