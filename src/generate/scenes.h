// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GENERATE_SCENES_H
#define SELVEDGE_GENERATE_SCENES_H

#include <selvedge/generate.h>

// One function for each scene that `generate` knows.

namespace selvedge::internal {

// Garments.
Triangle_soup skirt(const Generate_options& options);
Triangle_soup jacket(const Generate_options& options);
Triangle_soup shorts(const Generate_options& options);

// Scenes that are hard to reduce without intersections.
Triangle_soup sheets(const Generate_options& options);
Triangle_soup needles(const Generate_options& options);
Triangle_soup grid(const Generate_options& options);
Triangle_soup folded(const Generate_options& options);
Triangle_soup nested(const Generate_options& options);
Triangle_soup seams(const Generate_options& options);
Triangle_soup tunnels(const Generate_options& options);

} // namespace selvedge::internal

#endif // SELVEDGE_GENERATE_SCENES_H
