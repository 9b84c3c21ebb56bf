// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GENERATE_H
#define SELVEDGE_GENERATE_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace selvedge {

/// The options of `generate`. Lengths are in metres; garments are about one metre tall, scenes about one
/// metre wide. Numbers out of range are refused (`Argument_error`), and so are numbers that do not fit
/// together: more layers than the faces can make, or a stack of layers too thick for the body that it
/// surrounds.
struct Generate_options
{
  /// The number of triangles, in [100, 20,000,000]; the mesh has it within 2 %.
  std::size_t faces = 100'000;

  /// Layers of cloth, sheets, spheres or folds on top of one another, in [1, 100].
  int layers = 3;

  /// Thickness of the cloth of a garment, 0 or in [1e-9, 0.01]. Cloth with a thickness has an outer and an
  /// inner side, and is closed at its hems; at 0 each cloth is one sheet. Only garments have it.
  double thickness = 5e-4;

  /// Smallest distance of two layers in the direction in which they are stacked. At most 0.01; at least 1e-9
  /// for garments, 1e-12 for nested spheres, 1e-15 for sheets and folded cloth. In garments it is up to twice
  /// as large in places.
  double gap = 1e-3;

  /// Amplitude of folds and waves, in [0, 0.03].
  double fold_depth = 0.02;

  /// Folds around a garment, waves along a sheet, in [0, 200].
  int folds = 14;

  /// Seed of the random numbers that place vertices irregularly and shape the folds.
  unsigned seed = 1;
};

struct Scene_description
{
  std::string_view name;
  std::string_view description;
};

/// Returns every name that `generate` knows, garments first, with a description of one line.
const std::vector<Scene_description>& scenes();

/// Makes a garment of several layers, or a scene that is hard to reduce without intersections. A garment
/// has y up and its front at z, as in glTF.
///
/// **Guarantees**
/// 1. *Embedded*: any two triangles meet exactly in the positions that they share, and none is degenerate.
///    This holds for the coordinates as they stand, rounded to doubles, and by construction: nothing is
///    searched or repaired.
/// 2. *Pieces*: every pattern piece has vertices of its own. Where two pieces are sewn together, their
///    vertices have bit-identical positions. Every piece has a group name and its own place in texture space.
/// 3. *Texture*: every triangle is positively oriented in texture space, inside [0,1]²; pieces do not overlap
///    there.
/// 4. *Deterministic*: the same name and options give the same bytes in any build, because only operations
///    are used that IEEE 754 defines to the last bit.
///
/// **Complexity** Linear time in the number of faces. Memory, beside the soup itself, is at most two thirds
/// of the soup's; for thick cloth in several layers it is a fifth.
///
/// Throws `Argument_error` when the name is unknown (the message lists the known ones) or an option is out of
/// range.
Triangle_soup generate(std::string_view name, const Generate_options& options = {});

/// Returns poses of a mesh that moves, `count` of them, from slight to strong: it is twisted around the y
/// axis, to one side and the other in turn, by up to 62° over a height as large as its largest side, sways,
/// and breathes. They are named "1", "2" and so on.
///
/// Each pose is a one-to-one smooth map of space. It keeps surfaces apart; faces, whose corners alone it
/// moves, are flat again afterwards, so that coarse meshes may come to touch: `verify` tells. The same bytes
/// in any build, as `generate`. Linear.
std::vector<Pose> moving_poses(const Triangle_soup& soup, std::size_t count);

} // namespace selvedge

#endif // SELVEDGE_GENERATE_H
