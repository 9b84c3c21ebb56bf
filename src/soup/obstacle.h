// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_OBSTACLE_H
#define SELVEDGE_SOUP_OBSTACLE_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// Appends the points and triangles of an obstacle to those of a soup, in all poses of the soup. An obstacle
/// has as many poses, or none and stands still.
void append_obstacle(Triangle_soup& soup, const Triangle_soup& obstacle);

/// Throws `Argument_error` unless an obstacle has as many poses as the soup, or none.
void require_fitting_poses(const Triangle_soup& obstacle, const Triangle_soup& soup);

/// Removes what `append_obstacle` has appended.
void remove_obstacle(Triangle_soup& soup, const Triangle_soup& obstacle);

/// Returns the points and triangles, and nothing else, of a soup, followed by those of an obstacle.
Triangle_soup geometry_with_obstacle(const Triangle_soup& soup, const Triangle_soup& obstacle);

/// Returns the points of a mesh in one of its further poses; if it has none, where it stands in all.
const std::vector<Point_3>& points_in_pose(const Triangle_soup& soup, std::size_t pose);

/// Returns the points and triangles, and nothing else, of a soup in a further pose, followed by those of an
/// obstacle.
Triangle_soup geometry_in_pose(const Triangle_soup& soup, const Triangle_soup& obstacle, std::size_t pose);

} // namespace selvedge

#endif // SELVEDGE_SOUP_OBSTACLE_H
