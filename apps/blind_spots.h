// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_BLIND_SPOTS_H
#define SELVEDGE_APPS_BLIND_SPOTS_H

#include <selvedge/compare.h>
#include <selvedge/verify.h>

#include <string>
#include <vector>

namespace selvedge::app {

/// Lists what the judge cannot see of a result and its original, one line each: the gaps that every
/// comparison has, and those of these two meshes. `is_gltf` tells whether one of them is a glTF scene.
std::vector<std::string> blind_spots(const Verification& verification, const Comparison& comparison,
                                     bool is_gltf);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_BLIND_SPOTS_H
