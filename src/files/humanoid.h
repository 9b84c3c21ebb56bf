// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_HUMANOID_H
#define SELVEDGE_SRC_FILES_HUMANOID_H

#include "soup/Gltf_scene.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::files {

/// The bones of a human figure, as numbers of nodes of the scene.
struct Humanoid
{
  using Limb = std::array<Index, 3>; ///< upper arm, lower arm and hand, or upper leg, lower leg and foot

  std::array<Limb, 2> arms = {}, legs = {}; ///< left, right; each bone is below the one before it
  std::optional<Index> spine;               ///< the first joint above both arms that is above no leg
  std::vector<std::string> missing;         ///< bones that were not found, by their names in VRM
};

/// Returns the bones that the extension VRMC_vrm or VRM names; in a file without these, the joints of skins
/// whose names are usual for them. Of several such joints, the first in the list of nodes counts. May throw
/// an exception of the JSON library.
Humanoid find_humanoid(const Gltf_scene& scene);

/// A bone that turns about its own place, with all that is below it, until it points to a direction.
struct Bone_turn
{
  Index node = 0;
  std::vector<Index> ends; ///< the bone points to the middle of these nodes
  std::array<double, 3> direction = {};
};

struct Posture
{
  std::string name;
  std::vector<Bone_turn> turns; ///< in this order
};

/// Returns the postures of gltf_poses.h, of a figure all of whose bones were found. `to_world` has the global
/// transforms of all nodes. None when both legs begin at one place, seen from above: then the figure has no
/// left and right.
std::vector<Posture> humanoid_postures(const Humanoid& figure,
                                       const std::vector<Gltf_scene::Matrix>& to_world);

/// Turns a bone, by the smallest turn there is. Returns false, and changes nothing, when the bone has no
/// length. Only + - * / and sqrt are used.
bool turn(const Bone_turn& bone, const std::vector<Gltf_scene::Placed_node>& nodes,
          std::vector<Gltf_scene::Matrix>& to_world);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_HUMANOID_H
