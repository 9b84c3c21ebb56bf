// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_VERTEX_VALUES_H
#define SELVEDGE_SOUP_VERTEX_VALUES_H

#include <selvedge/Triangle_soup.h>

#include <array>
#include <cstddef>
#include <vector>

namespace selvedge {

/// Says which attributes of a soup's vertices can be mixed, reads them as numbers, and writes mixed ones.
///
/// Texture coordinates, normals, and attributes of vertices in floating point or in normalized integers are
/// mixed. All other integers (such as indices of joints) are not, and neither are the weights of joints
/// (`WEIGHTS_...`), which belong to these: a vertex that is mixed keeps its own.
///
/// **Preconditions** The soup outlives the object.
class Vertex_values
{
public:
  explicit Vertex_values(const Triangle_soup& soup);

  /// How many numbers there are at a corner.
  std::size_t size() const { return m_size; }

  /// Adds `weight` times the numbers at a corner of the soup, 3 × triangle + place in it, to a sum.
  void add(Index corner, double weight, std::vector<double>& sum) const;

  /// Makes a sum, whose weights add up to 1, what the soup can store: normals get the length 1; texture
  /// coordinates and normals become 32-bit floats where those of the soup are. A number that is not finite is
  /// replaced by that of `nearest`.
  void finish(std::vector<double>& sum, const std::vector<double>& nearest) const;

  /// Returns the texture coordinates among such numbers. The soup must have some.
  std::array<double, 2> uv(const std::vector<double>& numbers) const { return {numbers[0], numbers[1]}; }

  /// Numbers for a vertex of a result: `of_vertex[v]` is null for a vertex that keeps its values.
  using Of_vertices = std::vector<const std::vector<double>*>;

  /// Writes numbers into a soup that was selected from this one. Corners of other vertices keep their values.
  void put(const Of_vertices& of_vertex, Triangle_soup& result) const;

private:
  template <std::size_t dimension>
  static void put(const Of_vertices& of_vertex, std::size_t first, const Triangle_soup& result,
                  Corner_values<dimension>& values);

  // An attribute that is mixed, and the place of its first component among the numbers.
  struct Column
  {
    std::size_t attribute;
    std::size_t first;
  };

  const Triangle_soup& m_soup;
  std::size_t m_size = 0;
  std::size_t m_first_of_normal = 0;
  bool m_are_uvs_float32 = false, m_are_normals_float32 = false;
  std::vector<Column> m_columns;
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_VERTEX_VALUES_H
