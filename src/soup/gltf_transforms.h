// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_GLTF_TRANSFORMS_H
#define SELVEDGE_SRC_SOUP_GLTF_TRANSFORMS_H

#include "Gltf_scene.h"
#include <selvedge/Triangle_soup.h>

#include <array>
#include <cstddef>
#include <optional>

// Positions and directions of a glTF scene between its nodes and world space.

namespace selvedge {

/// Returns the direction of a normal in world space, computed by the matrix of cofactors; the normal itself
/// where the transform neither turns nor scales.
std::array<double, 3> world_normal(const Gltf_scene::Instance& instance, const std::array<double, 3>& normal);

/// Returns the direction in world space of a row of a column of normals.
std::array<double, 3> world_normal(const Gltf_scene::Instance& instance, const Gltf_scene::Column& normals,
                                   std::size_t row);

/// Returns a normal of length 1 whose direction in world space is about this one.
std::array<double, 3> local_normal(const Gltf_scene::Instance& instance, const std::array<double, 3>& normal);

/// Returns the direction of length 1 nearest to a tangent among those that are perpendicular to a normal.
/// Where the tangent has no direction of its own there, it is any of them.
std::array<double, 3> perpendicular(const std::array<double, 3>& tangent,
                                    const std::array<double, 3>& normal);

/// Returns a vector turned by the shortest rotation that takes the direction of `from` to that of `to`, and
/// scaled as their lengths. The vector is negated where these directions are opposite, and stays as it is
/// where one of them has no direction.
std::array<double, 3> turned(const std::array<double, 3>& vector, const std::array<double, 3>& from,
                             const std::array<double, 3>& to);

/// Returns the inverse of a transform; none where its entries would not be finite.
std::optional<Gltf_scene::Matrix> inverse(const Gltf_scene::Matrix& matrix);

/// Returns ((m0 x + m1 y) + m2 z) + m3 in doubles, for each row m of the matrix.
Point_3 world_position(const Gltf_scene::Matrix& to_world, const std::array<double, 3>& local);
Point_3 world_position(const Gltf_scene::Matrix& to_world, const Gltf_scene::Column& positions,
                       std::size_t row);

/// Returns three values of 32-bit floats whose world position is exactly this point; none when no such were
/// found, for instance because the transform flattens.
std::optional<std::array<double, 3>> local_position(const Gltf_scene::Matrix& to_world, const Point_3& point);

/// Returns a point near another that has a `local_position`, as `positions` can hold it; none when none was
/// found.
std::optional<Point_3> nearest_world_position(const Gltf_scene::Matrix& to_world,
                                              const Gltf_scene::Column& positions, const Point_3& point);

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_GLTF_TRANSFORMS_H
