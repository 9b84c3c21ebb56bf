// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ORIGINAL_SURFACE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ORIGINAL_SURFACE_H

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace selvedge {
namespace internal {

/// The triangles of a mesh as it was, of which one can ask whether a point is near.
///
/// The tree that answers is built at the first question, since most reductions of dense meshes ask none.
///
/// **Exactness** Floating point. **Complexity** O(n log n) for the first question about n triangles, and
/// about O(log n) for others. Copies share nothing.
class Original_surface
{
  using Kernel = CGAL::Simple_cartesian<double>;

public:
  /// `points` outlives this object.
  explicit Original_surface(const std::vector<Kernel::Point_3>& points) : m_points(points) {}

  using Number = std::uint32_t;
  using Point = Kernel::Point_3;

  /// Adds a triangle, whose corners are among the points with these numbers. Call it before `is_near`.
  void add(const std::array<Number, 3>& triangle) { m_triangles.push_back(triangle); }

  std::size_t number_of_triangles() const { return m_triangles.size(); }
  const std::array<Number, 3>& triangle(std::size_t number) const { return m_triangles[number]; }

  /// Returns whether a triangle is at most a squared distance away from a point.
  bool is_near(const Point& point, double squared_distance) const
  {
    if (!m_tree) {
      Traits traits;
      traits.set_shared_data(this);
      m_tree = std::make_unique<Tree>(traits);
      for (std::size_t i = 0; i < m_triangles.size(); ++i)
        m_tree->insert(Primitive(i));
      m_tree->build();
    }
    return m_tree->do_intersect(Kernel::Sphere_3(point, squared_distance));
  }

private:
  // A triangle by its number, as CGAL's tree asks for it.
  struct Primitive
  {
    using Id = std::size_t;
    using Point = Original_surface::Point;
    using Datum = Kernel::Triangle_3;
    using Datum_reference = Datum;
    using Point_reference = Point;
    using Shared_data = const Original_surface*;

    explicit Primitive(Id number) : m_number(number) {}
    Id id() const { return m_number; }
    Datum datum(Shared_data surface) const
    {
      const auto& [a, b, c] = surface->m_triangles[m_number];
      return Datum(surface->m_points[a], surface->m_points[b], surface->m_points[c]);
    }
    Point reference_point(Shared_data surface) const
    {
      return surface->m_points[surface->m_triangles[m_number][0]];
    }
    static Shared_data construct_shared_data(Shared_data surface) { return surface; }

  private:
    Id m_number;
  };
  using Traits = CGAL::AABB_traits<Kernel, Primitive>;
  using Tree = CGAL::AABB_tree<Traits>;

  const std::vector<Point>& m_points;
  std::vector<std::array<Number, 3>> m_triangles;
  mutable std::unique_ptr<Tree> m_tree;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ORIGINAL_SURFACE_H
