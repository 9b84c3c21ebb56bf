// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_FIT_NORMALS_H
#define SELVEDGE_SRC_SOUP_FIT_NORMALS_H

#include "Fitted_surface.h"

#include <selvedge/Triangle_soup.h>
#include <selvedge/normals.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// Fits the normals of a result, `fitted`, as the function of this name in normals.h does.
std::size_t fit_normals(const Fitted_surface& surface, const Corner_values<3>& normals,
                        const std::vector<char>& stays, Corner_values<3>& fitted);

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_FIT_NORMALS_H
