// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "gltf_transforms.h"

#include <selvedge/rounding.h>

#include <algorithm>
#include <cmath>

namespace selvedge {
namespace {

using Matrix = Gltf_scene::Matrix;

// Row i of the matrix of cofactors of the linear part.
std::array<double, 3> cofactors(const Matrix& m, std::size_t i)
{
  const auto &a = m[(i + 1) % 3], &b = m[(i + 2) % 3];
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double product(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Returns about the point that the matrix takes to `point`, rounded to 32-bit floats. They need not be
// finite.
std::array<double, 3> inverse(const Matrix& m, const Point_3& point)
{
  const std::array<std::array<double, 3>, 3> rows = {cofactors(m, 0), cofactors(m, 1), cofactors(m, 2)};
  const double determinant = product({m[0][0], m[0][1], m[0][2]}, rows[0]);
  const std::array<double, 3> p = {point.x() - m[0][3], point.y() - m[1][3], point.z() - m[2][3]};
  std::array<double, 3> result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = nearest_float32(product({rows[0][i], rows[1][i], rows[2][i]}, p) / determinant);
  return result;
}

bool is_translation(Matrix m)
{
  for (auto& row : m)
    row[3] = 0;
  return m == identity_matrix;
}

// Returns a vector divided by its length, and turned round when `sign` is -1; zero when it has no length.
std::array<double, 3> unit(std::array<double, 3> vector, int sign)
{
  const double length = std::sqrt(product(vector, vector));
  for (double& coordinate : vector)
    coordinate = length > 0 ? coordinate / (sign * length) : 0;
  return vector;
}

} // namespace

std::array<double, 3> world_normal(const Gltf_scene::Instance& instance, const std::array<double, 3>& normal)
{
  const Matrix& m = instance.to_world;
  if (is_translation(m))
    return normal;
  std::array<double, 3> result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = product(cofactors(m, i), normal);
  return unit(result, instance.is_mirrored ? -1 : 1);
}

std::array<double, 3> world_normal(const Gltf_scene::Instance& instance, const Gltf_scene::Column& normals,
                                   std::size_t row)
{
  return world_normal(instance,
                      {component(normals, row, 0), component(normals, row, 1), component(normals, row, 2)});
}

std::array<double, 3> local_normal(const Gltf_scene::Instance& instance, const std::array<double, 3>& normal)
{
  const Matrix& m = instance.to_world;
  if (is_translation(m))
    return normal;
  // The inverse of the matrix of cofactors is the transposed matrix, up to a factor of the sign of its
  // determinant, which `world_normal` takes out again.
  std::array<double, 3> result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = m[0][i] * normal[0] + m[1][i] * normal[1] + m[2][i] * normal[2];
  return unit(result, 1);
}

std::array<double, 3> perpendicular(const std::array<double, 3>& tangent, const std::array<double, 3>& normal)
{
  const std::array<double, 3> axis = unit(normal, 1);
  const auto beside_axis = [&](std::array<double, 3> vector) {
    const double along = product(vector, axis);
    for (std::size_t i = 0; i < 3; ++i)
      vector[i] -= along * axis[i];
    return vector;
  };
  constexpr double least = 1e-6; // what is less has come from rounding
  const std::array<double, 3> result = beside_axis(unit(tangent, 1));
  if (product(result, result) > least * least)
    return unit(result, 1);
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  std::array<double, 3> other{};
  other[std::size_t(std::min_element(axis.begin(), axis.end(), smaller) - axis.begin())] = 1;
  return unit(beside_axis(other), 1);
}

std::array<double, 3> turned(const std::array<double, 3>& vector, const std::array<double, 3>& from,
                             const std::array<double, 3>& to)
{
  const double scale = std::sqrt(product(to, to) / product(from, from));
  if (!(scale > 0 && std::isfinite(scale)))
    return vector;
  const std::array<double, 3> a = unit(from, 1), b = unit(to, 1);
  const std::array<double, 3> middle = {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
  const double square = product(middle, middle);
  constexpr double least = 1e-6; // what is less has come from rounding
  const bool are_opposite = !(square > least * least);
  // Two reflections: by the plane perpendicular to `middle`, and then by the one perpendicular to `b`.
  std::array<double, 3> result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = scale * (are_opposite ? -vector[i]
                                      : vector[i] - 2 * product(middle, vector) / square * middle[i] +
                                            2 * product(a, vector) * b[i]);
  return result;
}

std::optional<Matrix> inverse(const Matrix& m)
{
  const std::array<std::array<double, 3>, 3> rows = {cofactors(m, 0), cofactors(m, 1), cofactors(m, 2)};
  const double determinant = product({m[0][0], m[0][1], m[0][2]}, rows[0]);
  Matrix result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      result[i][j] = rows[j][i] / determinant;
    result[i][3] = -product({result[i][0], result[i][1], result[i][2]}, {m[0][3], m[1][3], m[2][3]});
    if (!std::all_of(result[i].begin(), result[i].end(), [](double entry) { return std::isfinite(entry); }))
      return std::nullopt;
  }
  return result;
}

Point_3 world_position(const Matrix& to_world, const std::array<double, 3>& local)
{
  const auto coordinate = [&](const std::array<double, 4>& m) {
    return m[0] * local[0] + m[1] * local[1] + m[2] * local[2] + m[3];
  };
  return {coordinate(to_world[0]), coordinate(to_world[1]), coordinate(to_world[2])};
}

Point_3 world_position(const Matrix& to_world, const Gltf_scene::Column& positions, std::size_t row)
{
  return world_position(
      to_world, {component(positions, row, 0), component(positions, row, 1), component(positions, row, 2)});
}

std::optional<std::array<double, 3>> local_position(const Matrix& to_world, const Point_3& point)
{
  const std::array<double, 3> local = inverse(to_world, point);
  const Point_3 found = world_position(to_world, local);
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(local[std::size_t(i)]) || found[i] != point[i])
      return std::nullopt;
  return local;
}

std::optional<Point_3> nearest_world_position(const Matrix& to_world, const Gltf_scene::Column& positions,
                                              const Point_3& point)
{
  std::array<double, 3> local = inverse(to_world, point);
  for (std::size_t k = 0; k < 3; ++k)
    local[k] = positions.nearest_quantised(local[k], k);
  const Point_3 result = world_position(to_world, local);
  return local_position(to_world, result) ? std::optional<Point_3>(result) : std::nullopt;
}

} // namespace selvedge
