// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GENERATE_SOUP_BUILDER_H
#define SELVEDGE_GENERATE_SOUP_BUILDER_H

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Triangle_soup.h>

#include <cmath>
#include <string>
#include <utility>

namespace selvedge::internal {

using Vector = Kernel::Vector_3;

/// Collects the soup of a generated mesh piece by piece; each piece has a group and a square tile of the
/// texture.
class Soup_builder
{
public:
  /// Lays out at least `pieces` tiles, and reserves memory for about `faces` triangles.
  Soup_builder(std::size_t pieces, std::size_t faces)
      : m_tiles(static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(pieces)))))
  {
    m_soup.triangles.reserve(faces + faces / 50);
    m_soup.uvs.of_triangle.reserve(faces + faces / 50);
    m_soup.groups.of_triangle.reserve(faces + faces / 50);
    m_soup.points.reserve(faces / 2 + faces / 20);
    m_soup.uvs.values.reserve(faces / 2 + faces / 20);
  }

  void begin_piece(std::string name)
  {
    m_soup.groups.names.push_back(std::move(name));
    m_tile = m_soup.groups.names.size() - 1;
  }

  Index add_point(const Vector& p)
  {
    m_poll();
    m_soup.points.emplace_back(p.x(), p.y(), p.z());
    return static_cast<Index>(m_soup.points.size() - 1);
  }

  /// Adds a texture coordinate. (u, v) lies in [0,1]², which is mapped to the tile of the present piece.
  Index add_uv(double u, double v)
  {
    const double size = 1 / static_cast<double>(m_tiles);
    const double margin = 0.01;
    m_soup.uvs.values.push_back(
        {(static_cast<double>(m_tile % m_tiles) + margin + (1 - 2 * margin) * u) * size,
         (static_cast<double>(m_tile / m_tiles) + margin + (1 - 2 * margin) * v) * size});
    return static_cast<Index>(m_soup.uvs.values.size() - 1);
  }

  void add_triangle(const Index_triple& triangle, const Index_triple& uv_triangle)
  {
    m_poll();
    m_soup.triangles.push_back(triangle);
    m_soup.uvs.of_triangle.push_back(uv_triangle);
    m_soup.groups.of_triangle.push_back(static_cast<Index>(m_tile));
  }

  Triangle_soup take() { return std::move(m_soup); }

private:
  Triangle_soup m_soup;
  Cancellation_poll m_poll;
  std::size_t m_tiles;
  std::size_t m_tile = 0;
};

} // namespace selvedge::internal

#endif // SELVEDGE_GENERATE_SOUP_BUILDER_H
