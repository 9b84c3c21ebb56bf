// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_VERIFY_KEPT_ATTRIBUTES_H
#define SELVEDGE_VERIFY_KEPT_ATTRIBUTES_H

#include <selvedge/compare.h>

namespace selvedge::internal {

/// Compares vertices and attributes, a step of `compare`: sets `vertices`, `original_vertices`, `attributes`
/// and `lost_attributes` of `comparison`.
void compare_values(Comparison& comparison, const Triangle_soup& result, const Triangle_soup& original);

} // namespace selvedge::internal

#endif // SELVEDGE_VERIFY_KEPT_ATTRIBUTES_H
