// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fit_texture.h"

#include "surface_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace selvedge {
namespace {

using Uv = std::array<double, 2>;

class Texture_fit
{
public:
  Texture_fit(const Fitted_surface& surface, const std::vector<char>& is_free)
      : m_surface(surface), m_result(surface.result()), m_original(surface.original()),
        m_old(m_result.points.size()), m_numbers(m_result.triangles.size())
  {
    const Triangle_soup& result = m_result;
    m_old.insert(m_old.end(), result.uvs.values.begin(), result.uvs.values.end());
    m_inertia.resize(m_old.size());
    m_is_fixed.resize(m_old.size(), true);
    for (Index i = 0; i < result.triangles.size(); ++i) {
      if (!result.uvs.has(i))
        continue;
      const double inertia = surface_fit::inertia_at_new_places * surface.area(i) / 3;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index v = result.triangles[i][k], uv = result.uvs.of_triangle[i][k];
        m_numbers[i][k] = is_free[v] ? v : Index(result.points.size() + uv);
        m_inertia[m_numbers[i][k]] += inertia;
        if (is_free[v]) {
          m_old[v] = result.uvs.values[uv];
          m_is_fixed[v] = false;
        }
      }
    }
  }

  template <class Stored>
  std::vector<Uv> run(const Stored& stored)
  {
    take_samples();
    const surface_fit::Least_squares<2> fit(m_moments, m_numbers, m_is_fixed, m_inertia);
    return kept_upright(fit.solution(m_old), stored);
  }

private:
  static const Uv& uv_at(const Corner_values<2>& uvs, Index triangle, std::size_t k)
  {
    return uvs.values[uvs.of_triangle[triangle][k]];
  }

  static std::array<Uv, 3> uvs_of(const Triangle_soup& soup, Index triangle)
  {
    return {uv_at(soup.uvs, triangle, 0), uv_at(soup.uvs, triangle, 1), uv_at(soup.uvs, triangle, 2)};
  }

  bool is_free(Index i) const
  {
    return std::any_of(m_numbers[i].begin(), m_numbers[i].end(), [&](Index n) { return !m_is_fixed[n]; });
  }

  void take_samples()
  {
    m_moments.resize(m_surface.size());
    m_size.resize(m_surface.size());
    const auto has = [&](Index i) { return m_result.uvs.has(i); };
    for (Index i = 0; i < m_surface.size(); ++i)
      for (std::size_t k = 0; k < 3 && has(i); ++k) {
        const Uv &p = uv_at(m_result.uvs, i, k), &q = uv_at(m_result.uvs, i, (k + 1) % 3);
        m_size[i] = std::max(m_size[i], std::hypot(p[0] - q[0], p[1] - q[1]));
      }
    const auto uv = [&](Index corner) { return uv_at(m_original.uvs, corner / 3, corner % 3); };
    m_surface.sample_middles(
        m_surface.charts([&](Index a, Index b) { return uv(a) == uv(b); }), has,
        [&](Index i) { return is_free(i); }, [&](Index t) { return m_original.uvs.has(t); },
        [&](const Fitted_surface::Middle& sample, Index i) { add(sample, i); });
  }

  void add(const Fitted_surface::Middle& sample, Index i)
  {
    const Uv there =
                 surface_fit::interpolated(uvs_of(m_original, sample.triangle), sample.weights_of_corners),
             here = surface_fit::interpolated(uvs_of(m_result, i), sample.nearest->weights);
    if (std::hypot(there[0] - here[0], there[1] - here[1]) <= m_size[i])
      m_moments[i].add(sample.nearest->weights, there, sample.weight);
  }

  static CGAL::Orientation orientation(const Uv& a, const Uv& b, const Uv& c)
  {
    return CGAL::orientation(Kernel::Point_2(a[0], a[1]), Kernel::Point_2(b[0], b[1]),
                             Kernel::Point_2(c[0], c[1]));
  }

  // Returns coordinates as they are stored, each as far on the way from the old ones as keeps all triangles.
  template <class Stored>
  std::vector<Uv> kept_upright(const std::vector<Uv>& fitted, const Stored& stored) const
  {
    constexpr int most_halvings = 3;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    Uv low{infinite, infinite}, high{-infinite, -infinite};
    for (const Index_triple& corners : m_original.uvs.of_triangle)
      for (const Index number : corners)
        for (std::size_t axis = 0; axis < 2 && number != m_original.uvs.missing; ++axis) {
          low[axis] = std::min(low[axis], m_original.uvs.values[number][axis]);
          high[axis] = std::max(high[axis], m_original.uvs.values[number][axis]);
        }
    const auto is_within = [&](const Uv& uv) {
      return uv[0] >= low[0] && uv[0] <= high[0] && uv[1] >= low[1] && uv[1] <= high[1];
    };
    std::vector<Uv> result = m_old;
    std::vector<int> halvings(result.size(), 0);
    const auto place = [&](std::size_t v) {
      for (; halvings[v] <= most_halvings; ++halvings[v]) {
        const double share = std::ldexp(1, -halvings[v]);
        const Uv uv = stored(Index(v), {m_old[v][0] + share * (fitted[v][0] - m_old[v][0]),
                                        m_old[v][1] + share * (fitted[v][1] - m_old[v][1])});
        if (is_within(uv)) {
          result[v] = uv;
          return;
        }
      }
      result[v] = m_old[v];
    };
    for (std::size_t v = 0; v < result.size(); ++v)
      if (!m_is_fixed[v])
        place(v);
    // Every round takes some vertex a step back, and all are right where they were. A triangle around which
    // none went back is as it was in the round before.
    std::vector<char> is_moved(result.size(), true);
    for (bool is_any_back = true; is_any_back;) {
      is_any_back = false;
      std::vector<char> is_back(result.size(), false);
      for (Index i = 0; i < m_result.triangles.size(); ++i) {
        const auto& [a, b, c] = m_numbers[i];
        if (!m_result.uvs.has(i) || !(is_moved[a] || is_moved[b] || is_moved[c]))
          continue;
        const CGAL::Orientation turn = orientation(m_old[a], m_old[b], m_old[c]);
        if (turn == CGAL::COLLINEAR || orientation(result[a], result[b], result[c]) == turn)
          continue;
        for (const Index n : m_numbers[i])
          is_back[n] |= !m_is_fixed[n] && halvings[n] <= most_halvings;
      }
      for (std::size_t v = 0; v < result.size(); ++v)
        if (is_back[v]) {
          ++halvings[v];
          place(v);
          is_any_back = true;
        }
      is_moved = std::move(is_back);
    }
    result.resize(m_result.points.size());
    return result;
  }

  const Fitted_surface& m_surface;
  const Triangle_soup& m_result;
  const Triangle_soup& m_original;
  // The numbers of coordinates: those of free vertices, then those of the values of other corners.
  std::vector<Uv> m_old;
  std::vector<char> m_is_fixed;
  std::vector<double> m_inertia;
  std::vector<Index_triple> m_numbers;            // by triangle of the result
  std::vector<surface_fit::Moments<2>> m_moments; // likewise
  std::vector<double> m_size;                     // likewise: the longest side in the texture
};

} // namespace

std::vector<std::array<double, 2>> fitted_texture(const Fitted_surface& surface,
                                                  const std::vector<char>& is_free,
                                                  const std::function<Uv(Index, const Uv&)>& stored)
{
  return Texture_fit(surface, is_free).run(stored);
}

} // namespace selvedge
