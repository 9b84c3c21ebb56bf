// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_CHECK_SOUP_H
#define SELVEDGE_SOUP_CHECK_SOUP_H

#include <selvedge/Triangle_soup.h>

#include <string>

namespace selvedge {

/// Throws `Argument_error` when a soup breaks a precondition of `Triangle_soup`; the message begins with
/// `what` and names the array and the element. O(n).
void check_soup(const Triangle_soup& soup, const std::string& what);

/// Checks all but the polygons of a soup, as `check_soup` does.
void check_arrays(const Triangle_soup& soup, const std::string& what);

/// Checks points, poses and triangles of a soup alone, as `check_soup` does.
void check_geometry(const Triangle_soup& soup, const std::string& what);

} // namespace selvedge

#endif // SELVEDGE_SOUP_CHECK_SOUP_H
