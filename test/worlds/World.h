// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_WORLD_H
#define SELVEDGE_TEST_WORLDS_WORLD_H

#include <selvedge/drop_parts.h>
#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {

/// A small hard input, an obstacle, and everything that a reduction can be asked for.
struct World
{
  std::uint64_t seed = 0;
  std::string scene; ///< what it is made of, for a person

  Triangle_soup soup;
  Mesh_format input_format = Mesh_format::obj; ///< of a file that reads as the soup
  Triangle_soup obstacle;

  Mesh_format output_format = Mesh_format::obj;
  bool is_sewn = false; ///< the file has one number for what lies at one position
  Defects defects = Defects::freeze;
  double weld_distance = 0;
  Open_seams open_seams = Open_seams::ignore; ///< if the distance is not 0, they are ignored
  Parts_to_drop dropped_parts;
  std::vector<std::string> dropped; ///< attributes
  Normals_choice normals = Normals_choice::automatic;
  bool are_faces_oriented = true;
  std::vector<std::pair<std::string, std::string>> may_intersect; ///< names of objects
  Simplify_options options;                                       ///< without who is to be told or asked
  Simplify_intent intent;
  std::vector<double> lods;

  /// How often the reduction may ask whether it should stop before it is told so.
  std::optional<std::size_t> questions;

  Prepare_options prepare_options() const;

  /// Whether collapses are judged in a further pose.
  bool is_guarded(std::size_t pose) const
  {
    const auto& guarded = options.guarded_poses;
    return !guarded || std::find(guarded->begin(), guarded->end(), pose) != guarded->end();
  }
};

/// Writes the world as files: the mesh, the obstacle if there is one, and `world.json` with all that was
/// asked for.
void write_world(const World& world, const std::filesystem::path& folder);

/// Reads what `write_world` has written.
World read_world(const std::filesystem::path& folder);

/// The run of `selvedge` that does what the world asks for, in the folder of its files. What the program has
/// no option for is named behind `#`.
std::string command_line(const World& world);

/// What of `command_line` is not as it is by default, in words: its options, the kind of the file written.
std::set<std::string> options_used(const World& world);

/// Returns the tangents of the vertices, if there are some.
const Attribute* tangents_of(const Triangle_soup& soup);

/// One line for a person.
std::string describe(const World& world);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_WORLD_H
