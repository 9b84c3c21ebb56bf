// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_WORLD_RUN_H
#define SELVEDGE_TEST_WORLDS_WORLD_RUN_H

#include "World.h"

#include <optional>
#include <string>
#include <vector>

namespace selvedge::test {

/// What came of a world, to be judged; a test may change it before that.
struct World_run
{
  /// Why the input was not accepted; nothing else is set then.
  std::optional<std::string> refusal;

  Prepared_soup unsnapped; ///< as it would be with no weld distance
  Prepared_soup prepared;
  std::vector<Soup_collapse> collapses;
  bool is_told_to_stop = false;
  Simplified_soup result;
  Verification verification;
  std::string log;
  Triangle_soup read_back; ///< from the file written

  /// From a progressive file, if the output is glTF and one can hold the steps.
  std::optional<Triangle_soup> last_level;

  /// Whether all normals of the result are those that corners of the input have.
  bool are_normals_kept() const
  {
    return prepared.normals == Normals_treatment::kept ||
           (are_joined(prepared.normals) && result.mended_normals == 0 && result.fitted_normals == 0);
  }
};

/// Returns the mesh of a world as the app prepares it: with the vertices joined, if asked, that differ in
/// dropped normals alone.
Triangle_soup input_of(const World& world, bool are_vertices_joined = true);

/// Does what a world asks for, up to the file; without levels of detail. Throws what the library throws,
/// except for `Input_error` from `prepare`.
World_run run(const World& world);

/// The same without a log, a verdict and a file: only `refusal`, `prepared`, `collapses`, `is_told_to_stop`
/// and `result` are set.
World_run run_without_output(const World& world);

/// Once more from the same `Prepared_soup`, with other options; only `collapses` and `result` are set.
World_run run_again(const World& world, const Prepared_soup& prepared);

/// Judges the result of a run, in its own pose and in those that were guarded.
Verification verify_guarded(const World& world, const Simplified_soup& result, const Prepared_soup& prepared);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_WORLD_RUN_H
