// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_PRICE_OF_TARGET_H
#define SELVEDGE_APPS_PRICE_OF_TARGET_H

#include "Simplify_request.h"

#include <selvedge/simplify.h>
#include <selvedge/verify.h>

#include <string>

// What the summary says of the price at which a target was reached or nearly reached, and which options help.
// Each begins with a line break, or is empty where there is nothing to say.

namespace selvedge::app {

/// Says, where a target is missed, which faces were kept for the shape; or that it was flattened, and what
/// helps: many of the last faces are given for little. `distance` is that from the original.
std::string what_shape_takes(const Simplify_request& request, const Simplify_report& report,
                             const Distance& distance);

/// Says how few faces a missed target leaves for each piece, if that is hardly enough for a shape, or else
/// that small pieces have most of the faces. Islands of an atlas are pieces, and so are stitches, and none of
/// them vanishes.
std::string what_is_left_for_pieces(const Prepared_soup& prepared, const Simplify_report& report);

/// Says, where a target is reached, that most vertices left in `soup` lie on seams of the texture, and what
/// helps: there the surface has given its vertices for the seams.
std::string what_texture_takes(const Simplify_request& request, const Triangle_soup& soup);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_PRICE_OF_TARGET_H
