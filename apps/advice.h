// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_ADVICE_H
#define SELVEDGE_APPS_ADVICE_H

#include "Simplify_request.h"

#include <selvedge/Surface_mesh_simplification/Hindrances.h>
#include <selvedge/simplify.h>

#include <string>

namespace selvedge::app {

/// Says what holds back a reduction that ended by itself, and what helps.
std::string held_back(const Simplify_request& request, const Prepared_soup& prepared,
                      const Simplified_soup& result);

/// Returns the name of the reason that holds most edges, of which there are some.
std::string most_frequent_reason(const Hindrances& hindrances);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_ADVICE_H
