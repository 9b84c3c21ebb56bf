// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GLTF_POSES_H
#define SELVEDGE_GLTF_POSES_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace selvedge {

/// \file
/// Poses that a glTF file makes of its own meshes, by morph targets, by animations, and by the skeleton of a
/// human figure.
///
/// Everything is computed in doubles from the numbers of the file, in the space of the scene, as the
/// positions of the mesh are (mesh_files.h, **Scenes**), and is not rounded further. Vertices with the same
/// position, the same displacements, the same transform of their node, and the same joints with the same
/// weights (in any order, of any skin with the same inverse bind matrices) have the same positions in every
/// pose, bit for bit.
///
/// **Preconditions** The mesh was read from glTF; its vertices may have been selected since. `name` stands
/// for the file in messages.
///
/// **Not promised** What a GPU shows: it computes in 32-bit floats, and may round every operation otherwise.
///
/// The functions that return poses throw `Input_error` when the mesh was not read from glTF, the file has
/// none of what is asked for, what it says is not valid, a coordinate is not finite, or the poses would have
/// more than 2^28 vertices in all.

/// Returns whether the mesh was read from glTF and has morph targets.
bool has_morph_targets(const Triangle_soup& mesh);

/// Returns a pose for each name of a morph target: every target of this name has weight 1, on all meshes that
/// have it, and all others have weight 0. Skinned meshes stay in their bind pose, and nodes where they are.
/// The pose is named after the targets (`extras.targetNames` of the mesh), or `target_2` for the third target
/// of a mesh without such names.
///
/// **Complexity** O(n) for each pose, n being the number of vertices and their displacements.
std::vector<Pose> morph_poses(const Triangle_soup& mesh, const std::string& name);

/// Returns a pose for the keyframes of an animation: the first, and every `every`-th after it, of all times
/// at which any of its channels has one. `animation` is the name of an animation, `animation_2` for the third
/// if that has no name, or `all` for each of them, one after another. Pose `walk_7` is the seventh keyframe
/// of `walk`, whether others are left out or not; `Pose::time` is its time in seconds.
///
/// As glTF 2.0 has it (3.7.3, 3.11, appendix C):
/// - Channels are evaluated between their own keyframes: STEP, LINEAR (spherical for rotations, the shorter
///   way), CUBICSPLINE (rotations are normalised afterwards); before the first and after the last they stay.
///   At a channel's own keyframe, its value is that of the file. What no channel moves is as the file has it.
/// - Nodes: global transforms are products as in mesh_files.h.
/// - Morph targets: a position is that of the file, plus each displacement times its weight. Weights come
///   from the animation, else from the node, else from the mesh.
/// - Skins, after morph targets: the position is transformed by the sum of weight × global transform of the
///   joint × its inverse bind matrix, in the order of the joints' nodes. All sets of joints and weights
///   count. Weights are as stored, whatever their sum; integers are fractions. The node of the mesh itself
///   does not count.
///
/// Channels of other extensions are left out. Sine and arc cosine are those of the C library: between
/// keyframes of rotations, the last bits may differ from one system to another.
///
/// Throws `Argument_error` when `every` is 0.
///
/// **Complexity** O(n + m + log k) for each pose, with m nodes of the scene and k keyframes.
std::vector<Pose> animation_poses(const Triangle_soup& mesh, const std::string& animation, std::size_t every,
                                  const std::string& name);

/// Returns whether the mesh was read from glTF and has a skin and all bones that `humanoid_poses` needs.
bool has_humanoid(const Triangle_soup& mesh);

/// Returns poses that clothes meet, of a figure that stands in any pose, such as with its arms out:
/// `arms_down`, `elbows_bent`, `arms_forward`, `arms_up`, `step`, `sit`, `bow`.
///
/// The bones are upper arms, lower arms, hands, upper legs, lower legs and feet: those of the extension
/// VRMC_vrm or VRM, else the joints of skins whose names are usual for them (docs/poses.md). Without a joint
/// above both arms that is above no leg, there is no `bow`.
/// - Left is from the right upper leg to the left one, seen from above; up is the y-axis; forward is
///   left × up.
/// - Each bone of a pose, the upper ones first, turns about its own place by the smallest turn after which it
///   points to a fixed direction of the figure; so the pose that it is turned from does not count. What is
///   below it turns along: T R T⁻¹ × global transform. The lower arm points to the hand, the spine to the
///   middle of both upper arms. Bones that a pose does not name are as in the file.
/// - Morph targets and skins are as in an animation that moves no weights.
///
/// Only + - * / and square roots are used: the last bits are the same on all systems.
///
/// **Not promised** That a figure would be animated so: constraints of nodes, springs, and bones beside
/// these, such as shoulders and twisted ones, stay as they are to the bones above them. If a scene has
/// several figures, one moves.
///
/// **Complexity** O(n + m log m) for each pose, with m nodes of the scene.
std::vector<Pose> humanoid_poses(const Triangle_soup& mesh, const std::string& name);

/// Writes a mesh and its further poses to a glTF file, as a new document in the space of the mesh
/// (`write_mesh` for meshes that were not read from glTF). Each pose is a morph target of its name, with a
/// second one for what the first loses by rounding, if it loses anything. The animation `poses` has a
/// keyframe for each and shows one after another, without what lies between them: at `Pose::time` where these
/// rise from 0 or more, else 24 in a second. `animation_poses` of the file gives the poses bit for bit;
/// `morph_poses` gives them without what is in second targets.
///
/// Throws `Argument_error` when there is no pose, a coordinate of the mesh is not the value of a 32-bit
/// float, a coordinate of a pose is not that of the mesh plus two such, or the name is not that of a glTF
/// file, and `Output_error` when the file cannot be written, which appears whole or not at all.
///
/// **Complexity** O(p n + p² m) for p poses and m nodes.
void write_gltf_poses(const std::filesystem::path& path, const Triangle_soup& mesh);

} // namespace selvedge

#endif // SELVEDGE_GLTF_POSES_H
