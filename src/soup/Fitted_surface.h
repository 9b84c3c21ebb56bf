// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_FITTED_SURFACE_H
#define SELVEDGE_SRC_SOUP_FITTED_SURFACE_H

#include "Disjoint_sets.h"
#include "Triangle_finder.h"
#include "inner_edges.h"
#include "number_positions.h"
#include "surface_fit.h"
#include "triangle_normals.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/internal/Vector_of_doubles.h>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge {

/// The surface of a result, beside that of its original, the values of which are fitted to it.
class Fitted_surface
{
public:
  using Vector = internal::Vector_of_doubles;
  using Corners = Triangle_finder::Corners;

  /// Triangle i of the result is what is left of triangle `triangles[i]` of the original, and has its corners
  /// from the corners `corners[i]`, numbered as 3 × triangle + place. `positions` are those of the vertices
  /// of the original, by which its surfaces are connected (`Prepared_soup::positions`).
  ///
  /// **Preconditions** The arguments outlive the object, and points and triangles stay as they are.
  Fitted_surface(const Triangle_soup& result, const std::vector<Index>& triangles,
                 const std::vector<Index_triple>& corners, const Triangle_soup& original,
                 const std::vector<Index>& positions);

  const Triangle_soup& result() const { return m_result; }
  const Triangle_soup& original() const { return m_original; }
  std::size_t size() const { return m_triangles.size(); } ///< triangles of the result
  Index of_original(Index i) const { return m_triangles[i]; }
  const std::vector<Index>& positions_of_original() const { return m_positions; }

  /// The normal of a triangle of the result, of length 1, or 0 if it has none.
  const Vector& normal(Index i) const { return m_normals[i]; }

  /// The corners and the area of a triangle at a size at which fourth powers of coordinates are numbers.
  Corners corners(const Triangle_soup& soup, Index triangle) const;
  double area(Index i) const { return surface_fit::area(corners(m_result, i)); } ///< of the result

  /// Whether a triangle of the result has other corners, or a corner elsewhere, than in the original.
  bool is_changed(Index i) const;

  /// Calls `samples_of(t, finder)` for every triangle t of the original, many at once, then, in their order,
  /// `add(sample, i)` with the samples that it returns, for the triangle i of the result that each has found.
  /// `finder` has the triangles for which `is_searched(i)` is true, on the surfaces that `surfaces` has for
  /// those of the original.
  template <class Is_searched, class Samples_of, class Add>
  void sample(const std::vector<std::size_t>& surfaces, const Is_searched& is_searched,
              const Samples_of& samples_of, const Add& add) const
  {
    std::vector<Corners> searched;
    std::vector<std::size_t> of_searched;
    std::vector<Index> numbers;
    for (Index i = 0; i < size(); ++i)
      if (normal(i) != Vector{} && is_searched(i)) {
        searched.push_back(corners(m_result, i));
        of_searched.push_back(surfaces[of_original(i)]);
        numbers.push_back(i);
      }
    const Triangle_finder finder(std::move(searched), of_searched);
    constexpr std::size_t at_once = 16384;
    const std::size_t triangles = m_original.triangles.size();
    std::vector<decltype(samples_of(Index(), finder))> found(std::min(at_once, triangles));
    for (std::size_t first = 0; first < triangles; first += at_once) {
      const std::size_t count = std::min(at_once, triangles - first);
      tbb::parallel_for(std::size_t(0), count, Cancellation_scope::inherited([&](std::size_t j) {
                          found[j] = samples_of(Index(first + j), finder);
                        }));
      Cancellation_scope::check();
      for (std::size_t j = 0; j < count; ++j)
        for (const auto& sample : found[j])
          if (sample.nearest)
            add(sample, numbers[sample.nearest->triangle]);
    }
  }

  /// Returns, for each triangle of the original, the number of its chart: of what is connected by edges at
  /// whose ends the corners of both sides have the same values, as `is_same(corner, corner)` says.
  template <class Is_same>
  std::vector<std::size_t> charts(const Is_same& is_same) const
  {
    const std::vector<Index_triple> triples = in_positions(m_original.triangles, m_positions);
    internal::Disjoint_sets sets(triples.size());
    internal::for_each_inner_edge(triples, [&](const internal::Edge_side& a, const internal::Edge_side& b) {
      if (is_same(a.at_low, b.at_low) && is_same(a.at_high, b.at_high))
        sets.unite(a.at_low / 3, b.at_low / 3);
    });
    std::vector<std::size_t> result(triples.size());
    for (std::size_t t = 0; t < result.size(); ++t)
      result[t] = sets.find(t);
    return result;
  }

  /// A sample in the middle of a triangle of the original: one is enough where triangles of the result are
  /// larger.
  struct Middle
  {
    static constexpr std::array<double, 3> weights_of_corners = {1. / 3, 1. / 3, 1. / 3};
    std::optional<Triangle_finder::Nearest> nearest;
    Index triangle = 0; ///< of the original
    double weight = 0;  ///< its area
  };

  /// Calls `add(middle, i)` as `sample` does, with samples where they can count: not of charts in which no
  /// triangle of the result `is_free`, nor of triangles that are in the result as they were. The sample of
  /// such a one is on itself, where it moves nothing. `has(t)` says whether a triangle of the original has
  /// values.
  template <class Is_searched, class Is_free, class Has, class Add>
  void sample_middles(const std::vector<std::size_t>& charts, const Is_searched& is_searched,
                      const Is_free& is_free, const Has& has, const Add& add) const
  {
    std::vector<char> is_asked(m_original.triangles.size(), false), // by chart
        is_left(m_original.triangles.size(), false);
    for (Index i = 0; i < size(); ++i)
      if (is_searched(i)) {
        is_asked[charts[of_original(i)]] |= is_free(i);
        is_left[of_original(i)] = !is_free(i) && !is_changed(i);
      }
    sample(
        charts, is_searched,
        [&](Index t, const Triangle_finder& finder) {
          const bool is_taken = is_asked[charts[t]] && !is_left[t] && has(t);
          return std::array<Middle, 1>{is_taken ? middle(t, finder, charts[t]) : Middle()};
        },
        add);
  }

private:
  Middle middle(Index t, const Triangle_finder& finder, std::size_t chart) const
  {
    const Corners at = corners(m_original, t);
    const double weight = surface_fit::area(at);
    if (!(weight > 0))
      return {};
    return {finder.nearest(surface_fit::interpolated(at, Middle::weights_of_corners), chart,
                           shading::unit_normal(m_original, t)),
            t, weight};
  }

  const Triangle_soup& m_result;
  const std::vector<Index>& m_triangles;
  const std::vector<Index_triple>& m_corners;
  const Triangle_soup& m_original;
  const std::vector<Index>& m_positions;
  int m_exponent; // of the power of two by which coordinates are multiplied
  std::vector<Vector> m_normals;
};

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_FITTED_SURFACE_H
