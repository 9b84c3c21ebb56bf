// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ORIGINAL_SURFACE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ORIGINAL_SURFACE_H

#include <selvedge/spatial/Packed_R_tree.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace selvedge {
namespace internal {

/// The triangles of a mesh as it was, of which one can ask whether a point is near.
///
/// The index that answers is made when there have been some questions, since most reductions of dense meshes
/// ask few. It has several boxes for a sliver askew to the axes, one for each part of its length: one box
/// around all of it would say little about it.
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

  /// Makes room for triangles to come.
  void reserve(std::size_t triangles) { m_triangles.reserve(triangles); }

  /// Adds a triangle, whose corners are among the points with these numbers. Call it before `is_near`.
  void add(const std::array<Number, 3>& triangle) { m_triangles.push_back(triangle); }

  std::size_t number_of_triangles() const { return m_triangles.size(); }
  const std::array<Number, 3>& triangle(std::size_t number) const { return m_triangles[number]; }

  /// Whether the index has been made, which answers sooner than several triangles.
  bool has_index() const { return m_index.has_value(); }

  /// Returns whether this triangle is at most a squared distance away from a point.
  bool is_near(const Point& point, double squared_distance, Number triangle) const
  {
    m_last = triangle;
    m_compared += s_boxes_per_triangle;
    return CGAL::do_intersect(Kernel::Sphere_3(point, squared_distance), triangle_at(triangle));
  }

  /// Returns whether any triangle is. It is fast when one is that has a number near that of the triangle that
  /// was asked last, as neighbours have in most meshes.
  bool is_near(const Point& point, double squared_distance) const
  {
    if (is_near(point, squared_distance, m_last))
      return true;
    const double radius = (1 + 1e-9) * std::sqrt(squared_distance);
    if (!m_index) {
      if (m_compared < s_boxes_per_index * m_triangles.size())
        return is_found_by_scan(point, squared_distance, radius);
      make_index();
    }
    const auto is_found_within = [&](double distance) {
      return m_index->has_overlapping(box_around(point, distance), [&](Number of_index) {
        const Number triangle = triangle_of(of_index);
        return triangle != m_last && is_near(point, squared_distance, triangle);
      });
    };
    // Most points that are near are far nearer, and few boxes meet a small one.
    return is_found_within(radius / 8) || is_found_within(radius);
  }

private:
  // To ask one triangle takes about as long as to compare so many boxes, and to make the index as long as to
  // compare so many for each triangle.
  static constexpr std::size_t s_boxes_per_triangle = 8, s_boxes_per_index = 32;

  static CGAL::Bbox_3 box_around(const Point& point, double radius)
  {
    return {point.x() - radius, point.y() - radius, point.z() - radius,
            point.x() + radius, point.y() + radius, point.z() + radius};
  }

  // Asks the triangles with the numbers beside that of the last one, and those beside these.
  bool is_found_by_scan(const Point& point, double squared_distance, double radius) const
  {
    const CGAL::Bbox_3 box = box_around(point, radius);
    const auto is_found = [&](Number triangle) {
      ++m_compared;
      return CGAL::do_overlap(box, triangle_at(triangle).bbox()) &&
             is_near(point, squared_distance, triangle);
    };
    const Number start = m_last, size = Number(m_triangles.size());
    for (Number i = 1; i <= start || i < size - start; ++i)
      if ((i <= start && is_found(start - i)) || (i < size - start && is_found(start + i)))
        return true;
    return false;
  }

  Kernel::Triangle_3 triangle_at(Number number) const
  {
    const auto& [a, b, c] = m_triangles[number];
    return {m_points[a], m_points[b], m_points[c]};
  }

  Number triangle_of(Number part) const
  {
    return part < m_triangles.size() ? part : m_triangle_of_part[part - m_triangles.size()];
  }

  void make_index() const
  {
    // Parts are numbered as the triangles are, and those of slivers after them.
    std::vector<Number> parts;
    std::vector<CGAL::Bbox_3> boxes; // of parts of slivers
    const Number triangles = Number(m_triangles.size());
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
  std::vector<std::array<Number, 3>> m_triangles;
  mutable std::optional<Packed_R_tree> m_index;   // of parts of triangles
  mutable std::vector<Number> m_triangle_of_part; // those of slivers
  mutable Number m_last = 0;                      // the triangle that was asked last
  mutable std::size_t m_compared = 0;             // how many boxes, to decide when to make the index
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ORIGINAL_SURFACE_H
