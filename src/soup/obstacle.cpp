// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "obstacle.h"

#include <selvedge/Error.h>

#include <string>

namespace selvedge {

void append_obstacle(Triangle_soup& soup, const Triangle_soup& obstacle)
{
  const Index offset = Index(soup.points.size());
  soup.points.insert(soup.points.end(), obstacle.points.begin(), obstacle.points.end());
  for (const auto& [a, b, c] : obstacle.triangles)
    soup.triangles.push_back({a + offset, b + offset, c + offset});
  for (std::size_t pose = 0; pose < soup.poses.size(); ++pose) {
    std::vector<Point_3>& points = soup.poses[pose].points;
    const std::vector<Point_3>& beside = points_in_pose(obstacle, pose);
    points.insert(points.end(), beside.begin(), beside.end());
  }
}

void require_fitting_poses(const Triangle_soup& obstacle, const Triangle_soup& soup)
{
  if (!obstacle.poses.empty() && obstacle.poses.size() != soup.poses.size())
    throw Argument_error("the obstacle has " + std::to_string(obstacle.poses.size()) +
                         " further poses and the mesh " + std::to_string(soup.poses.size()) +
                         "; give it as many, or none if it stands still");
}

void remove_obstacle(Triangle_soup& soup, const Triangle_soup& obstacle)
{
  soup.points.erase(soup.points.end() - obstacle.points.size(), soup.points.end());
  soup.triangles.resize(soup.triangles.size() - obstacle.triangles.size());
  for (Pose& pose : soup.poses)
    pose.points.resize(soup.points.size());
}

Triangle_soup geometry_with_obstacle(const Triangle_soup& soup, const Triangle_soup& obstacle)
{
  Triangle_soup both;
  both.points = soup.points;
  both.triangles = soup.triangles;
  append_obstacle(both, obstacle);
  return both;
}

const std::vector<Point_3>& points_in_pose(const Triangle_soup& soup, std::size_t pose)
{
  return soup.poses.empty() ? soup.points : soup.poses[pose].points;
}

Triangle_soup geometry_in_pose(const Triangle_soup& soup, const Triangle_soup& obstacle, std::size_t pose)
{
  Triangle_soup both, beside;
  both.points = points_in_pose(soup, pose);
  both.triangles = soup.triangles;
  beside.points = points_in_pose(obstacle, pose);
  beside.triangles = obstacle.triangles;
  append_obstacle(both, beside);
  return both;
}

} // namespace selvedge
