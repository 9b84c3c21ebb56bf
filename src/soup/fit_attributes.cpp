// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fit_attributes.h"

#include "surface_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace selvedge {
namespace {

class Attribute_fit
{
public:
  Attribute_fit(const Fitted_surface& surface, const Vertex_values& values, const std::vector<char>& is_free)
      : m_surface(surface), m_result(surface.result()), m_original(surface.original()), m_values(values),
        m_is_free(is_free), m_components(values.fitted_components()), m_inertia(m_result.points.size(), 0)
  {
    for (Index i = 0; i < m_result.triangles.size(); ++i)
      for (const Index v : m_result.triangles[i])
        m_inertia[v] += surface_fit::inertia_at_new_places * m_surface.area(i) / 3;
    for (const Vertex_values::Component& component : m_components) {
      std::vector<double>& of_original = m_of_original.emplace_back();
      of_original.reserve(m_original.points.size());
      for (Index v = 0; v < m_original.points.size(); ++v)
        of_original.push_back(m_values.value(component, m_original, v));
    }
  }

  std::vector<std::vector<double>> run()
  {
    std::vector<std::vector<double>> result;
    if (m_components.empty())
      return result;
    take_samples();
    for (std::size_t c = 0; c < m_components.size(); ++c)
      result.push_back(fitted(c));
    return result;
  }

private:
  struct Sample
  {
    Index of_original, of_result; // triangles
    std::array<double, 3> weights;
    double weight;
  };

  static std::array<std::array<double, 1>, 3> at_corners(const std::vector<double>& values,
                                                         const Index_triple& triangle)
  {
    return {{{values[triangle[0]]}, {values[triangle[1]]}, {values[triangle[2]]}}};
  }

  void take_samples()
  {
    const auto vertex = [&](Index corner) { return m_original.triangles[corner / 3][corner % 3]; };
    const auto is_same = [&](Index a, Index b) {
      const Index v = vertex(a), w = vertex(b);
      return v == w || std::all_of(m_of_original.begin(), m_of_original.end(),
                                   [&](const std::vector<double>& values) { return values[v] == values[w]; });
    };
    const auto is_free = [&](Index i) {
      const Index_triple& triangle = m_result.triangles[i];
      return std::any_of(triangle.begin(), triangle.end(), [&](Index v) { return m_is_free[v] != 0; });
    };
    const auto all = [](Index) { return true; };
    m_surface.sample_middles(
        m_surface.charts(is_same), all, is_free, all, [&](const Fitted_surface::Middle& middle, Index i) {
          if (is_free(i))
            m_samples.push_back({middle.triangle, i, middle.nearest->weights, middle.weight});
        });
  }

  // Returns one component as vertices store it, NaN where it stays.
  std::vector<double> fitted(std::size_t c) const
  {
    using Value = std::array<double, 1>;
    const std::size_t count = m_result.points.size();
    std::vector<double> result(count, std::numeric_limits<double>::quiet_NaN());
    std::vector<Value> old(count);
    std::vector<char> is_fixed(count, true), is_finite(count, false);
    for (Index v = 0; v < count; ++v)
      if (const double value = m_values.value(m_components[c], m_result, v); std::isfinite(value)) {
        old[v] = {value};
        is_finite[v] = true;
        is_fixed[v] = !m_is_free[v];
      }
    std::vector<Value> low = old, high = old; // around each vertex, so that no fit goes beyond a jump
    std::vector<surface_fit::Moments<1>> moments(m_result.triangles.size());
    for (const Sample& sample : m_samples) {
      const Index_triple& triangle = m_result.triangles[sample.of_result];
      const auto values = at_corners(m_of_original[c], m_original.triangles[sample.of_original]);
      const Value value = surface_fit::interpolated(values, Fitted_surface::Middle::weights_of_corners);
      if (!std::isfinite(value[0]) ||
          !std::all_of(triangle.begin(), triangle.end(), [&](Index v) { return is_finite[v] != 0; }))
        continue;
      moments[sample.of_result].add(sample.weights, value, sample.weight);
      for (const Index v : triangle) {
        low[v] = std::min({low[v], values[0], values[1], values[2]});
        high[v] = std::max({high[v], values[0], values[1], values[2]});
      }
    }
    if (low == high)
      return result;
    const std::vector<Value> best =
        surface_fit::Least_squares<1>(moments, m_result.triangles, is_fixed, m_inertia).solution(old);
    for (Index v = 0; v < count; ++v) {
      if (is_fixed[v] || !std::isfinite(best[v][0]))
        continue;
      const double value = std::clamp(best[v][0], low[v][0], high[v][0]),
                   stored = m_values.stored_value(m_components[c], m_result, v, value);
      if (stored != old[v][0])
        result[v] = stored;
    }
    return result;
  }

  const Fitted_surface& m_surface;
  const Triangle_soup& m_result;
  const Triangle_soup& m_original;
  const Vertex_values& m_values;
  const std::vector<char>& m_is_free;
  std::vector<Vertex_values::Component> m_components;
  std::vector<std::vector<double>> m_of_original; // by component and vertex
  std::vector<double> m_inertia;                  // by vertex of the result
  std::vector<Sample> m_samples;
};

} // namespace

std::vector<std::vector<double>> fitted_attributes(const Fitted_surface& surface, const Vertex_values& values,
                                                   const std::vector<char>& is_free)
{
  return Attribute_fit(surface, values, is_free).run();
}

} // namespace selvedge
