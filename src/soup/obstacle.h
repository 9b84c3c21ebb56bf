// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_OBSTACLE_H
#define SELVEDGE_SOUP_OBSTACLE_H

#include <selvedge/Triangle_soup.h>

namespace selvedge {

/// Appends the points and triangles of an obstacle to those of a soup.
void append_obstacle(Triangle_soup& soup, const Triangle_soup& obstacle);

/// Removes what `append_obstacle` has appended.
void remove_obstacle(Triangle_soup& soup, const Triangle_soup& obstacle);

/// Returns the points and triangles, and nothing else, of a soup, followed by those of an obstacle.
Triangle_soup geometry_with_obstacle(const Triangle_soup& soup, const Triangle_soup& obstacle);

} // namespace selvedge

#endif // SELVEDGE_SOUP_OBSTACLE_H
