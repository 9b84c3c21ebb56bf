// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_MESHES_H
#define SELVEDGE_TEST_SUPPORT_MESHES_H

#include <selvedge/generate.h>

#include <cmath>
#include <cstddef>
#include <string_view>

namespace selvedge::test {

/// A garment ("skirt", "jacket", "shorts") of `layers` layers of double-sided cloth with all that belongs to
/// it.
inline Triangle_soup garment(std::string_view name, std::size_t faces, int layers = 3, unsigned seed = 1)
{
  Generate_options options;
  options.faces = faces;
  options.layers = layers;
  options.seed = seed;
  return generate(name, options);
}

inline Triangle_soup skirt(std::size_t faces, int layers = 3, unsigned seed = 1)
{
  return garment("skirt", faces, layers, seed);
}

/// Wavy sheets above one another.
inline Triangle_soup sheets(std::size_t faces, int layers, double gap)
{
  Generate_options options;
  options.faces = faces;
  options.layers = layers;
  options.gap = gap;
  return generate("sheets", options);
}

/// Closed spheres inside one another.
inline Triangle_soup nested_spheres(std::size_t faces, int layers, double gap)
{
  Generate_options options;
  options.faces = faces;
  options.layers = layers;
  options.gap = gap;
  return generate("nested", options);
}

/// One cloth, folded back and forth.
inline Triangle_soup folded_cloth(std::size_t faces, int folds, double gap)
{
  Generate_options options;
  options.faces = faces;
  options.layers = folds;
  options.gap = gap;
  return generate("folded", options);
}

/// A flat regular grid.
inline Triangle_soup flat_grid(std::size_t faces)
{
  Generate_options options;
  options.faces = faces;
  return generate("grid", options);
}

/// Pieces with coincident borders: a T-junction, three sheets on one edge, one piece turned over.
inline Triangle_soup sewn_pieces(std::size_t faces)
{
  Generate_options options;
  options.faces = faces;
  return generate("seams", options);
}

/// A closed band of `quads` quadrilaterals with half a twist; no orientation fits all its triangles.
inline Triangle_soup moebius_band(Index quads = 12)
{
  Triangle_soup soup;
  for (Index k = 0; k < quads; ++k) {
    const double angle = 6.283185307179586 * k / quads;
    for (const double side : {-0.25, 0.25}) {
      const double radius = 1 + side * std::cos(angle / 2);
      soup.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                               side * std::sin(angle / 2));
    }
  }
  for (Index k = 0; k < quads; ++k) {
    const bool last = k + 1 == quads;
    const Index a = 2 * k, b = 2 * k + 1;
    const Index c = last ? 1 : 2 * k + 2, d = last ? 0 : 2 * k + 3;
    soup.triangles.push_back({a, c, b});
    soup.triangles.push_back({b, c, d});
  }
  return soup;
}

/// Three triangles on one edge, with the same vertex numbers.
inline Triangle_soup fan_of_three()
{
  Triangle_soup soup;
  soup.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  soup.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  return soup;
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_MESHES_H
