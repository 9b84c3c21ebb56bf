// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_VERIFY_LAYER_ORDER_H
#define SELVEDGE_VERIFY_LAYER_ORDER_H

#include <selvedge/compare.h>

namespace selvedge::internal {

/// Compares the order of layers along lines through the original's faces, a step of `compare`. The lines
/// reach `reach`, in the unit of the coordinates, to both sides of a face.
Layer_order layer_order(const Triangle_soup& result, const Triangle_soup& original, double reach);

} // namespace selvedge::internal

#endif // SELVEDGE_VERIFY_LAYER_ORDER_H
