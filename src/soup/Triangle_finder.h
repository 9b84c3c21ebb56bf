// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_TRIANGLE_FINDER_H
#define SELVEDGE_SRC_SOUP_TRIANGLE_FINDER_H

#include <selvedge/Triangle_soup.h>
#include <selvedge/internal/Vector_of_doubles.h>

#include <array>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

namespace selvedge {

/// Finds the triangle of a surface that is nearest to a point, where a mesh has several surfaces: boxes in a
/// binary tree for each of them.
///
/// **Exactness** Floating point.
///
/// **Complexity** O(n log n) to build for n triangles; as a rule O(log n) to ask.
class Triangle_finder
{
public:
  using Vector = internal::Vector_of_doubles;
  using Corners = std::array<Vector, 3>;

  struct Nearest
  {
    Index triangle;
    std::array<double, 3> weights; ///< of the corners of the triangle, for the point on it that is nearest
  };

  /// `surfaces` are numbers of the surfaces of triangles. Coordinates are at most 2.
  Triangle_finder(std::vector<Corners> triangles, const std::vector<std::size_t>& surfaces);

  /// Returns the triangle of a surface that is nearest, of those of which the normal vector has a positive
  /// product with `direction` and that are at most four times as far as any other; nothing when there is
  /// none.
  std::optional<Nearest> nearest(const Vector& query, std::size_t surface, const Vector& direction) const;

private:
  struct Box
  {
    Vector low, high;
  };

  struct Node
  {
    Box box;
    std::size_t first, beyond; // in `m_order`
    std::size_t left;          // its number; the right one is the next. 0 in a leaf.
  };

  struct Search
  {
    Vector query;
    std::optional<Vector> direction;
    double squared; // the distance beyond which nothing is of interest
    std::optional<Nearest> found;
  };

  void divide(std::size_t node);
  Box box_around(std::size_t first, std::size_t beyond) const;
  void visit(std::size_t node, Search& search) const;
  bool is_towards(Index triangle, const Vector& direction) const;

  static double squared_distance(const Vector& query, const Box& box);

  std::vector<Corners> m_triangles;
  std::vector<Index> m_order; // triangles
  std::vector<Node> m_nodes;
  std::unordered_map<std::size_t, std::size_t> m_roots; // by surface
};

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_TRIANGLE_FINDER_H
