// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_SURFACE_FIT_H
#define SELVEDGE_SRC_SOUP_SURFACE_FIT_H

#include "Triangle_finder.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/internal/Vector_of_doubles.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

// Finds values for the corners of triangles that, interpolated over these, are nearest to samples, in the
// sense of least squares.

namespace selvedge::surface_fit {

/// The weight of texture coordinates and attributes at new places as they are, relative to that of the
/// samples around. It decides where there are few samples.
constexpr double inertia_at_new_places = 0.02;

using Vector = internal::Vector_of_doubles;
using Corners = Triangle_finder::Corners;

inline double area(const Corners& corners)
{
  const Vector doubled = internal::cross(internal::difference(corners[1], corners[0]),
                                         internal::difference(corners[2], corners[0]));
  return std::sqrt(internal::dot(doubled, doubled)) / 2;
}

/// Returns the value at a point of a triangle, from those of its corners.
template <std::size_t dimension>
std::array<double, dimension> interpolated(const std::array<std::array<double, dimension>, 3>& values,
                                           const std::array<double, 3>& weights)
{
  std::array<double, dimension> result{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < dimension; ++axis)
      result[axis] += weights[k] * values[k][axis];
  return result;
}

/// A value of the original, and what it stands for in the result: nothing if there is no nearest triangle.
template <std::size_t dimension>
struct Sample
{
  std::optional<Triangle_finder::Nearest> nearest;
  std::array<double, dimension> value{};
  double weight = 0;
};

/// What the samples on a triangle come to.
template <std::size_t dimension>
struct Moments
{
  /// The sums of the products of the weights of its corners, and of values by these weights.
  std::array<std::array<double, 3>, 3> products{};
  std::array<std::array<double, dimension>, 3> values{};

  void add(const Sample<dimension>& sample) { add(sample.nearest->weights, sample.value, sample.weight); }

  /// Adds a value at the point of the triangle that has these weights of its corners.
  void add(const std::array<double, 3>& weights, const std::array<double, dimension>& value, double weight)
  {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t l = 0; l < 3; ++l)
        products[k][l] += weight * weights[k] * weights[l];
      for (std::size_t axis = 0; axis < dimension; ++axis)
        values[k][axis] += weight * weights[k] * value[axis];
    }
  }
};

/// The least squares for values that corners of triangles have in common. Corners with the same number have
/// one value.
template <std::size_t dimension>
class Least_squares
{
public:
  using Value = std::array<double, dimension>;

  /// `numbers` are those of the corners, by triangle, as are `moments`. A value that is fixed stays. One that
  /// is not has the weight `inertia` as it is, which decides where there are few samples.
  ///
  /// **Preconditions** The arguments outlive the object.
  Least_squares(const std::vector<Moments<dimension>>& moments, const std::vector<Index_triple>& numbers,
                const std::vector<char>& is_fixed, const std::vector<double>& inertia)
      : m_moments(moments), m_numbers(numbers), m_is_fixed(is_fixed), m_inertia(inertia)
  {
  }

  /// Returns the solution, by conjugate gradients from these values.
  std::vector<Value> solution(const std::vector<Value>& values) const
  {
    const std::size_t count = values.size();
    std::vector<double> diagonal = m_inertia;
    for (std::size_t i = 0; i < m_moments.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        diagonal[m_numbers[i][k]] += m_moments[i].products[k][k];
    std::vector<Value> result = values;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      std::vector<double> x(count), right(count);
      for (std::size_t n = 0; n < count; ++n) {
        x[n] = values[n][axis];
        right[n] = m_inertia[n] * x[n];
      }
      for (std::size_t i = 0; i < m_moments.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
          right[m_numbers[i][k]] += m_moments[i].values[k][axis];
      improve(x, right, diagonal);
      for (std::size_t n = 0; n < count; ++n)
        result[n][axis] = x[n];
    }
    return result;
  }

private:
  // Returns the product of the matrix with a vector, in its free rows.
  std::vector<double> times(const std::vector<double>& x) const
  {
    std::vector<double> result(x.size());
    for (std::size_t n = 0; n < x.size(); ++n)
      result[n] = m_inertia[n] * x[n];
    for (std::size_t i = 0; i < m_moments.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l)
          result[m_numbers[i][k]] += m_moments[i].products[k][l] * x[m_numbers[i][l]];
    for (std::size_t n = 0; n < x.size(); ++n)
      if (m_is_fixed[n])
        result[n] = 0;
    return result;
  }

  void improve(std::vector<double>& x, const std::vector<double>& right,
               const std::vector<double>& diagonal) const
  {
    constexpr int most_steps = 100;
    constexpr double share_left = 1e-8; // of the squared residual
    const std::size_t count = x.size();
    std::vector<double> residual = times(x), direction(count), towards(count);
    for (std::size_t n = 0; n < count; ++n)
      residual[n] = m_is_fixed[n] ? 0 : right[n] - residual[n];
    const auto precondition = [&] {
      double sum = 0;
      for (std::size_t n = 0; n < count; ++n) {
        towards[n] = diagonal[n] > 0 ? residual[n] / diagonal[n] : 0;
        sum += towards[n] * residual[n];
      }
      return sum;
    };
    double left = precondition();
    const double enough = share_left * left;
    direction = towards;
    for (int step = 0; step < most_steps && left > enough; ++step) {
      Cancellation_scope::check();
      const std::vector<double> product = times(direction);
      const double curvature = std::inner_product(direction.begin(), direction.end(), product.begin(), 0.0);
      if (!(curvature > 0))
        return;
      const double length = left / curvature;
      for (std::size_t n = 0; n < count; ++n) {
        x[n] += length * direction[n];
        residual[n] -= length * product[n];
      }
      const double before = std::exchange(left, precondition());
      for (std::size_t n = 0; n < count; ++n)
        direction[n] = towards[n] + left / before * direction[n];
    }
  }

  const std::vector<Moments<dimension>>& m_moments;
  const std::vector<Index_triple>& m_numbers;
  const std::vector<char>& m_is_fixed;
  const std::vector<double>& m_inertia;
};

} // namespace selvedge::surface_fit

#endif // SELVEDGE_SRC_SOUP_SURFACE_FIT_H
