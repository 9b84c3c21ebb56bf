// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fit_normals.h"

#include "Disjoint_sets.h"
#include "Triangle_finder.h"
#include "inner_edges.h"
#include "near_normals.h"
#include "number_positions.h"
#include "selection.h"
#include "surface_fit.h"
#include "surfaces_of.h"
#include "triangle_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

// Finds the normals with which a result shades most like its original.

namespace selvedge {
namespace {

using internal::dot;
using shading::cosines;
using shading::normal_at;
using shading::side_of;
using shading::stored;
using shading::unit;
using shading::unit_normal;
using shading::Vector;

// The weight of the normals as they are, relative to that of the samples around. It decides where there are
// few samples.
constexpr double s_inertia = 0.05;

// Of some 78°: a sample that is turned farther than that from the nearest triangle belongs to the other side
// of the cloth, say.
constexpr double s_cosine_of_sample = 0.2;

// Of 40°: a triangle that is turned farther than that from the normal at its corner, or from its neighbour,
// may have another normal.
constexpr double s_cosine_of_split = 0.766;

// How much of the squared error around a wedge may be left if it is split though one normal would suit all
// triangles there. What is smooth is to stay so.
constexpr double s_share_left_of_split = 0.5;

// Of 20°, from which on one sees a turn (`suited_to`): a normal on a border that is as far from the fitted
// one shades faces as nothing did in the original.
constexpr double s_cosine_of_border = 0.9397;

// The weights of the corners at three points of a triangle, the mean of which integrates quadratic functions
// exactly.
constexpr std::array<std::array<double, 3>, 3> s_sample_weights = {
    {{1. / 6, 1. / 6, 2. / 3}, {1. / 6, 2. / 3, 1. / 6}, {2. / 3, 1. / 6, 1. / 6}}};

class Normal_fit
{
public:
  Normal_fit(const Fitted_surface& surface, const Corner_values<3>& normals, const std::vector<char>& stays,
             Corner_values<3>& fitted)
      : m_surface(surface), m_result(surface.result()), m_original(surface.original()), m_normals(normals),
        m_fitted(fitted), m_positions(number_positions(m_result.points)),
        m_is_left(m_original.triangles.size(), false)
  {
    for (Index i = 0; i < surface.size(); ++i) {
      const Index t = surface.of_original(i);
      m_sides.push_back(fitted.has(i) ? side_of(cosines(unit_normal(m_original, t), normals, t)) : 0);
    }
    number_wedges();
    fix_what_is_left(stays);
  }

  std::size_t run()
  {
    if (std::all_of(m_is_fixed.begin(), m_is_fixed.end(), [](char is_fixed) { return is_fixed != 0; }))
      return 0;
    take_samples();
    std::vector<Vector> fitted = solution_beside_borders();
    if (split_wedges(fitted))
      fitted = solution_beside_borders();
    return assign(suited(std::move(fitted)));
  }

private:
  using Sample = surface_fit::Sample<3>;

  // Returns a normal, or none where it is not finite.
  static Vector finite(const Vector& normal)
  {
    return std::all_of(normal.begin(), normal.end(), [](double x) { return std::isfinite(x); }) ? normal
                                                                                                : Vector{};
  }

  // Returns which positions are on a border: an edge of one triangle ends there.
  std::vector<char> are_on_border() const
  {
    std::vector<std::pair<Index, Index>> edges;
    for (const Index_triple& triangle : m_result.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        edges.push_back(std::minmax({m_positions[triangle[k]], m_positions[triangle[(k + 1) % 3]]}));
    std::sort(edges.begin(), edges.end());
    std::vector<char> result(m_result.points.size(), false);
    for (std::size_t i = 0; i < edges.size(); ++i)
      if ((i == 0 || edges[i - 1] != edges[i]) && (i + 1 == edges.size() || edges[i + 1] != edges[i]))
        result[edges[i].first] = result[edges[i].second] = true;
    return result;
  }

  // Returns the first wedge from `first` on that has such a normal, or a new one.
  Index wedge_from(Index first, const Vector& normal, bool is_on_border)
  {
    Index wedge = first;
    while (wedge < m_old.size() && !are_near_normals(normal, m_old[wedge]))
      ++wedge;
    if (wedge == m_old.size()) {
      m_old.push_back(normal);
      m_is_fixed.push_back(normal == Vector{});
      m_border_normals.push_back(is_on_border ? normal : Vector{});
    }
    return wedge;
  }

  // A wedge is what has one normal at one position, up to 0.1°: seams of the texture are no hard edges.
  void number_wedges()
  {
    using Key = std::tuple<Index, Vector, Index>; // position, normal, corner
    std::vector<Key> keys;
    for (Index i = 0; i < m_result.triangles.size(); ++i)
      if (m_fitted.has(i))
        for (Index k = 0; k < 3; ++k)
          keys.emplace_back(m_positions[m_result.triangles[i][k]], finite(normal_at(m_fitted, i, k)),
                            3 * i + k);
    std::sort(keys.begin(), keys.end());
    const std::vector<char> is_on_border = are_on_border();
    m_wedges.assign(m_result.triangles.size(), {});
    Index first = 0, number = 0; // of the wedges at the position
    for (std::size_t j = 0; j < keys.size(); ++j) {
      const auto& [position, normal, corner] = keys[j];
      const bool is_elsewhere = j == 0 || position != std::get<0>(keys[j - 1]);
      if (is_elsewhere)
        first = Index(m_old.size());
      if (is_elsewhere || normal != std::get<1>(keys[j - 1]))
        number = wedge_from(first, unit(normal), is_on_border[position]);
      m_wedges[corner / 3][corner % 3] = number;
    }
    weigh_wedges();
  }

  // Fixes the wedges around which nothing has changed, and those of triangles that stay. Others also count
  // what they show on triangles that have not changed: such a one may be a sliver of a bevel, beside a large
  // face.
  void fix_what_is_left(const std::vector<char>& stays)
  {
    const std::size_t count = m_result.triangles.size();
    std::vector<char> are_changed(count), is_free(m_old.size(), false);
    for (Index i = 0; i < count; ++i) {
      are_changed[i] = m_surface.is_changed(i);
      if (are_changed[i] && m_fitted.has(i))
        for (const Index wedge : m_wedges[i])
          is_free[wedge] = true;
    }
    for (Index i = 0; i < count && !stays.empty(); ++i)
      if (stays[m_surface.of_original(i)] && m_fitted.has(i))
        for (const Index wedge : m_wedges[i])
          is_free[wedge] = false;
    for (std::size_t w = 0; w < m_old.size(); ++w)
      m_is_fixed[w] |= !is_free[w];
    for (Index i = 0; i < count; ++i)
      m_is_left[m_surface.of_original(i)] = !are_changed[i] && (!m_fitted.has(i) || are_fixed(m_wedges[i]));
  }

  bool are_fixed(const Index_triple& wedges) const
  {
    return std::all_of(wedges.begin(), wedges.end(), [&](Index wedge) { return m_is_fixed[wedge] != 0; });
  }

  void weigh_wedges()
  {
    m_inertia.assign(m_old.size(), 0);
    for (Index i = 0; i < m_result.triangles.size(); ++i)
      if (m_fitted.has(i))
        for (const Index wedge : m_wedges[i])
          m_inertia[wedge] += s_inertia * m_surface.area(i) / 3;
  }

  void take_samples()
  {
    const std::vector<std::size_t> surfaces =
        surfaces_of(m_original.triangles, m_surface.positions_of_original());
    m_moments.resize(m_result.triangles.size());
    m_surface.sample(
        surfaces, [](Index) { return true; },
        [&](Index t, const Triangle_finder& finder) {
          return m_is_left[t] ? std::array<Sample, 3>{} : samples_of(t, finder, surfaces[t]);
        },
        [&](const Sample& sample, Index i) { add(sample, i); });
  }

  // Returns where the front of a triangle with such a normal points to.
  static Vector direction(Vector normal, int side)
  {
    for (double& x : normal)
      x *= side;
    return normal;
  }

  std::array<Sample, 3> samples_of(Index t, const Triangle_finder& finder, std::size_t surface) const
  {
    std::array<Sample, 3> samples;
    if (!m_normals.has(t))
      return samples;
    const Fitted_surface::Corners corners = m_surface.corners(m_original, t);
    const double weight = surface_fit::area(corners) / 3;
    const int side = side_of(cosines(unit_normal(m_original, t), m_normals, t));
    std::array<Vector, 3> normals;
    for (std::size_t k = 0; k < 3; ++k)
      normals[k] = unit(finite(normal_at(m_normals, t, k)));
    for (std::size_t j = 0; j < 3 && weight > 0; ++j) {
      const std::array<double, 3>& weights = s_sample_weights[j];
      const Vector place = surface_fit::interpolated(corners, weights),
                   shown = unit(surface_fit::interpolated(normals, weights));
      samples[j] = {finder.nearest(place, surface, direction(shown, side)), shown, weight};
    }
    return samples;
  }

  void add(const Sample& sample, Index i)
  {
    if (m_sides[i] != 0 && cosine(i, sample.value) >= s_cosine_of_sample)
      m_moments[i].add(sample);
  }

  bool is_near_on_border(std::size_t wedge, const Vector& fitted) const
  {
    return dot(fitted, m_border_normals[wedge]) >= s_cosine_of_border;
  }

  // Fixes the wedges on borders whose old normals are near the fitted ones. Returns whether there are any.
  bool hold_borders(const std::vector<Vector>& fitted)
  {
    bool is_any_held = false;
    for (std::size_t w = 0; w < m_old.size(); ++w)
      if (!m_is_fixed[w] && is_near_on_border(w, fitted[w])) {
        m_is_fixed[w] = true;
        m_old[w] = m_border_normals[w];
        is_any_held = true;
      }
    return is_any_held;
  }

  // Returns a solution that takes into account which borders it holds. What few become near only after the
  // last round, `assign` holds.
  std::vector<Vector> solution_beside_borders()
  {
    constexpr int most_rounds = 3;
    std::vector<Vector> result = unit_solution();
    for (int round = 0; round < most_rounds && hold_borders(result); ++round)
      result = unit_solution();
    return result;
  }

  std::vector<Vector> unit_solution() const
  {
    const surface_fit::Least_squares<3> fit(m_moments, m_wedges, m_is_fixed, m_inertia);
    std::vector<Vector> result = fit.solution(m_old);
    for (Vector& normal : result)
      normal = unit(normal);
    return result;
  }

  // The cosine between a normal and the side of a triangle that it shades.
  double cosine(Index i, const Vector& normal) const { return m_sides[i] * dot(m_surface.normal(i), normal); }

  // By wedge as `whole` numbers them, the squared differences between the samples on the triangles there and
  // what these show with such normals of the wedges `m_wedges`.
  std::vector<double> errors(const std::vector<Index_triple>& whole, const std::vector<Vector>& normals) const
  {
    std::vector<double> result(normals.size(), 0);
    for (Index i = 0; i < m_wedges.size(); ++i) {
      if (m_sides[i] == 0)
        continue;
      const surface_fit::Moments<3>& moments = m_moments[i];
      double error = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector& normal = normals[m_wedges[i][k]];
        error -= 2 * dot(moments.values[k], normal);
        for (std::size_t l = 0; l < 3; ++l) // samples have length 1, and their three weights add up to 1
          error += moments.products[k][l] * (1 + dot(normal, normals[m_wedges[i][l]]));
      }
      for (const Index wedge : whole[i])
        result[wedge] += error;
    }
    return result;
  }

  // Unites the corners of a wedge at which triangles meet that turn little from one to the next.
  internal::Disjoint_sets smooth_parts() const
  {
    const std::vector<Index_triple> triples = in_positions(m_result.triangles, m_positions);
    internal::Disjoint_sets parts(3 * triples.size());
    internal::for_each_inner_edge(triples, [&](const internal::Edge_side& a, const internal::Edge_side& b) {
      const Index i = a.at_low / 3, j = b.at_low / 3;
      if (m_sides[i] * cosine(j, m_surface.normal(i)) < s_cosine_of_split)
        return;
      for (const auto& [of_a, of_b] : {std::pair(a.at_low, b.at_low), std::pair(a.at_high, b.at_high)})
        if (m_wedges[i][of_a % 3] == m_wedges[j][of_b % 3])
          parts.unite(of_a, of_b);
    });
    return parts;
  }

  // Makes wedges of the smooth parts of those whose fitted normal is far from that of a triangle there, if
  // most of the error around goes by this, or, where no one normal suits all triangles, any of it. Such are
  // left where a bevel is gone: the triangles on both sides of the edge have the normal that it had. Returns
  // whether there are new wedges.
  bool split_wedges(const std::vector<Vector>& fitted)
  {
    const std::size_t count = m_old.size();
    std::vector<char> is_far(count, false);
    for (Index i = 0; i < m_wedges.size(); ++i)
      for (std::size_t k = 0; k < 3 && m_sides[i] != 0; ++k)
        is_far[m_wedges[i][k]] |= cosine(i, fitted[m_wedges[i][k]]) < s_cosine_of_split;
    if (std::find(is_far.begin(), is_far.end(), true) == is_far.end())
      return false;

    const std::vector<Index_triple> whole = m_wedges;
    const std::vector<Vector> old = m_old;
    const std::vector<char> do_suit = suit(fitted);
    const std::vector<double> errors_before = errors(whole, suited(fitted));
    internal::Disjoint_sets parts = smooth_parts();
    std::map<std::size_t, Index> wedges;                            // of the parts
    std::vector<char> is_taken(count, false), is_cut(count, false); // whether it has parts, and several
    std::vector<Vector> means(count);
    for (Index i = 0; i < whole.size(); ++i)
      for (std::size_t k = 0; k < 3 && m_sides[i] != 0; ++k) {
        const Index w = whole[i][k];
        if (m_is_fixed[w] || !is_far[w])
          continue;
        const auto [found, is_new] = wedges.emplace(parts.find(3 * i + k), w);
        if (is_new && std::exchange(is_taken[w], true)) { // the first part keeps the number
          is_cut[w] = true;
          found->second = Index(means.size());
          means.emplace_back();
          m_is_fixed.push_back(false);
          m_border_normals.push_back(Vector(m_border_normals[w]));
        }
        m_wedges[i][k] = found->second;
        const double weight = m_sides[i] * m_surface.area(i);
        for (std::size_t axis = 0; axis < 3; ++axis)
          means[found->second][axis] += weight * m_surface.normal(i)[axis];
      }
    if (means.size() == count)
      return false;
    m_old.resize(means.size());
    for (std::size_t w = 0; w < means.size(); ++w)
      if (w >= count || is_cut[w])
        m_old[w] = unit(means[w]);
    weigh_wedges();
    const std::vector<double> errors_after = errors(whole, suited(unit_solution()));

    m_is_split.assign(m_old.size(), false);
    bool is_any_split = false;
    for (Index i = 0; i < whole.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const Index w = whole[i][k];
        if (m_sides[i] == 0 || !is_cut[w])
          continue;
        if (errors_after[w] < (do_suit[w] ? s_share_left_of_split : 1) * errors_before[w]) {
          m_is_split[m_wedges[i][k]] = true;
          is_any_split = true;
        } else {
          m_wedges[i][k] = w;
        }
      }
    for (std::size_t w = 0; w < count; ++w)
      if (!m_is_split[w])
        m_old[w] = old[w];
    weigh_wedges();
    return is_any_split;
  }

  // Whether no triangle would have a normal, in place of the old one, that is farther from its own than
  // samples may be, and than the old one is.
  std::vector<char> suit(const std::vector<Vector>& normals) const
  {
    std::vector<char> result(normals.size(), true);
    for (Index i = 0; i < m_result.triangles.size(); ++i)
      if (m_fitted.has(i))
        for (std::size_t k = 0; k < 3; ++k) {
          const Index w = m_wedges[i][k];
          const double before = cosine(i, unit(finite(normal_at(m_fitted, i, k))));
          result[w] &= cosine(i, normals[w]) >= std::min(s_cosine_of_sample, before);
        }
    return result;
  }

  // Returns fitted normals of length 1, each as far on the way from the old one as suits all triangles.
  std::vector<Vector> suited(std::vector<Vector> fitted) const
  {
    constexpr int most_halvings = 3;
    for (int halvings = 0; halvings <= most_halvings; ++halvings) {
      const std::vector<char> do_suit = suit(fitted);
      for (std::size_t w = 0; w < fitted.size(); ++w) {
        if (do_suit[w])
          continue;
        for (std::size_t axis = 0; axis < 3; ++axis)
          fitted[w][axis] = halvings < most_halvings ? fitted[w][axis] + m_old[w][axis] : m_old[w][axis];
        fitted[w] = unit(fitted[w]);
      }
    }
    return fitted;
  }

  bool is_split(std::size_t wedge) const { return !m_is_split.empty() && m_is_split[wedge]; }

  // Gives corners their new normals, but for those that would look like the old ones.
  std::size_t assign(const std::vector<Vector>& fitted)
  {
    std::vector<char> is_kept = m_is_fixed;
    for (std::size_t w = 0; w < fitted.size(); ++w)
      is_kept[w] |= fitted[w] == Vector{} || is_near_on_border(w, fitted[w]) ||
                    (!is_split(w) && are_near_normals(fitted[w], m_old[w]));
    std::vector<Index> numbers(fitted.size());
    for (std::size_t w = 0; w < fitted.size(); ++w)
      if (!is_kept[w]) {
        numbers[w] = Index(m_fitted.values.size());
        m_fitted.values.push_back(stored(fitted[w]));
      }
    std::size_t changed = 0;
    for (Index i = 0; i < m_result.triangles.size(); ++i)
      if (m_fitted.has(i))
        for (std::size_t k = 0; k < 3; ++k)
          if (const Index w = m_wedges[i][k]; !is_kept[w]) {
            m_fitted.of_triangle[i][k] = numbers[w];
            ++changed;
          }
    if (changed > 0)
      m_fitted = with_used(m_fitted.values, std::move(m_fitted.of_triangle), m_fitted.missing);
    return changed;
  }

  const Fitted_surface& m_surface;
  const Triangle_soup& m_result;
  const Triangle_soup& m_original;
  const Corner_values<3>& m_normals;  // of the corners of the original
  Corner_values<3>& m_fitted;         // of those of the result
  std::vector<Index> m_positions;     // of the vertices of the result
  std::vector<char> m_is_left;        // by triangle of the original: it is in the result with its normals
  std::vector<int> m_sides;           // by triangle of the result
  std::vector<Index_triple> m_wedges; // likewise
  std::vector<surface_fit::Moments<3>> m_moments; // likewise
  std::vector<Vector> m_old;                      // by wedge, of length 1
  std::vector<char> m_is_fixed;                   // by wedge
  std::vector<Vector> m_border_normals; // by wedge: the old one if on a border, of parts that of the whole
  std::vector<double> m_inertia;        // by wedge: its weight as it is
  std::vector<char> m_is_split;         // by wedge: others were one with it; or empty
};

} // namespace

std::size_t fit_normals(const Fitted_surface& surface, const Corner_values<3>& normals,
                        const std::vector<char>& stays, Corner_values<3>& fitted)
{
  return fitted.empty() ? 0 : Normal_fit(surface, normals, stays, fitted).run();
}

std::size_t fit_normals(Triangle_soup& result, const std::vector<Index>& triangles,
                        const std::vector<Index_triple>& corners, const Triangle_soup& original,
                        const Corner_values<3>& normals, const std::vector<char>& stays)
{
  const std::vector<Index> positions = number_positions(original.points);
  return fit_normals(Fitted_surface(result, triangles, corners, original, positions), normals, stays,
                     result.normals);
}

} // namespace selvedge
