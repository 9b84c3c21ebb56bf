// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_KEY_POSES_H
#define SELVEDGE_KEY_POSES_H

#include <selvedge/Triangle_soup.h>
#include <selvedge/verify.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// Returns the numbers of `count` further poses of a mesh (all, when it has no more), in ascending order.
/// They are chosen one after the other, each the farthest from the mesh's own pose and those chosen before;
/// the distance of two poses is the root mean square of the distances of their vertices.
///
/// With `Simplify_options::guarded_poses`, a mesh of many poses is reduced in these alone, and `verify` then
/// judges all: poses in which it finds something are guarded as well in the next run.
///
/// **Complexity** O(count × poses × vertices); O(poses) when there are no more than `count`.
std::vector<std::size_t> key_poses(const Triangle_soup& mesh, std::size_t count);

/// Returns how many of so many further poses are guarded at first where it is left to the program: their
/// square root, rounded up.
std::size_t number_of_key_poses(std::size_t poses);

/// Adds a pose to the numbers of others, which are in ascending order, unless it is among them. Returns
/// whether it has added it.
bool add_pose(std::vector<std::size_t>& guarded, std::size_t pose);

/// Adds to the numbers of poses, which are in ascending order, those in which a judge has found new pairs, or
/// pieces too near to each other. Returns whether it has added any, so that the reduction is to be done
/// again.
bool add_refused_poses(std::vector<std::size_t>& guarded, const Verification& verification);

} // namespace selvedge

#endif // SELVEDGE_KEY_POSES_H
