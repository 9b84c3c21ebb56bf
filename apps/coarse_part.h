// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_COARSE_PART_H
#define SELVEDGE_APPS_COARSE_PART_H

#include "Simplify_request.h"

#include <selvedge/simplify.h>

#include <string>

namespace selvedge::app {

/// Says in a sentence which group, object or material keeps far fewer of its faces than the whole and has
/// lost its shape, such as a face or a hand, for which a deviation is large that is small for a whole
/// character; and which option keeps more of it. Empty when there is none. Of several, it is the one of most
/// faces; those whose ratios the user has given are left out.
///
/// **Complexity** O(n), and the distance of each such part.
std::string coarse_part(const Simplify_request& request, const Prepared_soup& original,
                        const Simplified_soup& result);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_COARSE_PART_H
