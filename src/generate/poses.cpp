// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/generate.h>

#include <algorithm>
#include <string>

// Moves a generated mesh by smooth maps of space. Only operations are used that IEEE 754 defines to the last
// bit: angles are given by the tangents of their halves.

namespace selvedge {

std::vector<Pose> moving_poses(const Triangle_soup& soup, std::size_t count)
{
  std::vector<Pose> poses;
  CGAL::Bbox_3 box;
  for (const Point_3& p : soup.points)
    box += p.bbox();
  const double low = box.ymin(), height = std::max({box.x_span(), box.y_span(), box.z_span()});
  for (std::size_t i = 1; i <= count; ++i) {
    const double share = double(i) / double(count), side = i % 2 == 0 ? -1 : 1;
    const auto moved = [&](const Point_3& p) {
      const double up = (p.y() - low) / height;
      const double wider = 1 + 0.15 * share * 4 * up * (1 - up); // breathes
      const double t = 0.6 * side * share * up;                  // turns by 2 arctan t
      const double cosine = (1 - t * t) / (1 + t * t), sine = 2 * t / (1 + t * t);
      const double x = wider * p.x(), z = wider * p.z();
      const double sway = 0.3 * share * up * up * height;
      return Point_3(cosine * x + sine * z + sway, p.y(), cosine * z - sine * x + side * sway);
    };
    Pose& pose = poses.emplace_back();
    pose.name = std::to_string(i);
    pose.time = float(i);
    pose.points.reserve(soup.points.size());
    for (const Point_3& p : soup.points)
      pose.points.push_back(moved(p));
  }
  return poses;
}

} // namespace selvedge
