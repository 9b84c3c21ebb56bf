// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Cancellation_scope.h>
#include <selvedge/key_poses.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace selvedge {

std::vector<std::size_t> key_poses(const Triangle_soup& mesh, std::size_t count)
{
  std::vector<std::size_t> chosen;
  if (count >= mesh.poses.size()) { // nothing is to be chosen
    chosen.resize(mesh.poses.size());
    std::iota(chosen.begin(), chosen.end(), std::size_t(0));
    return chosen;
  }
  std::vector<double> nearest(mesh.poses.size(), std::numeric_limits<double>::infinity());
  const auto come_near = [&](const std::vector<Point_3>& points) {
    for (std::size_t pose = 0; pose < nearest.size(); ++pose) {
      Cancellation_scope::check();
      double sum = 0;
      for (std::size_t v = 0; v < points.size(); ++v)
        sum += CGAL::squared_distance(points[v], mesh.poses[pose].points[v]);
      nearest[pose] = std::min(nearest[pose], sum);
    }
  };
  come_near(mesh.points);
  while (chosen.size() < count) {
    const auto farthest = std::max_element(nearest.begin(), nearest.end());
    chosen.push_back(std::size_t(farthest - nearest.begin()));
    come_near(mesh.poses[chosen.back()].points);
    *farthest = -1; // chosen
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::size_t number_of_key_poses(std::size_t poses)
{
  return std::size_t(std::ceil(std::sqrt(double(poses))));
}

bool add_pose(std::vector<std::size_t>& guarded, std::size_t pose)
{
  const auto place = std::lower_bound(guarded.begin(), guarded.end(), pose);
  if (place != guarded.end() && *place == pose)
    return false;
  guarded.insert(place, pose);
  return true;
}

bool add_refused_poses(std::vector<std::size_t>& guarded, const Verification& verification)
{
  bool is_any_added = false;
  for (std::size_t number = 0; number < verification.poses.size(); ++number) {
    const Verification::In_pose& pose = verification.poses[number];
    if (!pose.new_pairs.empty() || (pose.clearance && pose.clearance->too_near() > 0))
      is_any_added |= add_pose(guarded, number);
  }
  return is_any_added;
}

} // namespace selvedge
