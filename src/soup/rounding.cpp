// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Error.h>
#include <selvedge/rounding.h>

#include <algorithm>
#include <cmath>

namespace selvedge {
double nearest_float32(double value)
{
  // The float goes through memory, because GCC 12 removes a conversion to float and straight back.
  const volatile float nearest = static_cast<float>(value);
  return nearest;
}

bool is_float32(double value)
{
  return nearest_float32(value) == value;
}

bool has_float32_points(const std::vector<Point_3>& points)
{
  return std::all_of(points.begin(), points.end(), [](const Point_3& point) {
    return is_float32(point.x()) && is_float32(point.y()) && is_float32(point.z());
  });
}

bool has_float32_points(const Triangle_soup& soup)
{
  return has_float32_points(soup.points) &&
         std::all_of(soup.poses.begin(), soup.poses.end(),
                     [](const Pose& pose) { return has_float32_points(pose.points); });
}

bool has_float32_digits(const Triangle_soup& soup)
{
  const auto has_few = [](double value) {
    int exponent;
    return is_float32(std::frexp(value, &exponent));
  };
  return std::all_of(soup.points.begin(), soup.points.end(), [&](const Point_3& point) {
    return has_few(point.x()) && has_few(point.y()) && has_few(point.z());
  });
}

namespace {

bool is_too_large(const Point_3& point)
{
  return !std::isfinite(nearest_float32(point.x())) || !std::isfinite(nearest_float32(point.y())) ||
         !std::isfinite(nearest_float32(point.z()));
}

void refuse_too_large(const Triangle_soup& soup, const std::vector<Point_3>& points, const std::string& where)
{
  for (const Index_triple& triangle : soup.triangles)
    for (const Index v : triangle)
      if (is_too_large(points[v]))
        throw Input_error("vertex " + std::to_string(v) + " (counted from 0) has " + where +
                          "a coordinate too large for a 32-bit float; scale the mesh down or write a format "
                          "that stores doubles");
}

// What is too large, as a vertex of no face may be, stays.
Rounding_notes round(std::vector<Point_3>& points)
{
  Rounding_notes notes;
  for (Point_3& point : points) {
    if (is_too_large(point))
      continue;
    std::size_t moved = 0;
    for (int axis = 0; axis < 3; ++axis)
      moved += is_float32(point[axis]) ? 0 : 1;
    if (moved == 0)
      continue;
    point = Point_3(nearest_float32(point.x()), nearest_float32(point.y()), nearest_float32(point.z()));
    notes.coordinates += moved;
    ++notes.vertices;
  }
  return notes;
}

} // namespace

Rounding_notes round_to_float32(Triangle_soup& soup)
{
  refuse_too_large(soup, soup.points, "");
  for (const Pose& pose : soup.poses)
    refuse_too_large(soup, pose.points, "in the pose '" + pose.name + "' ");
  Rounding_notes notes = round(soup.points);
  for (Pose& pose : soup.poses) {
    const Rounding_notes in_pose = round(pose.points);
    notes.coordinates += in_pose.coordinates;
    notes.vertices += in_pose.vertices;
  }
  return notes;
}

} // namespace selvedge
