// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What the C interface says of a mesh, or of a result and its original: what the program says.

#include <selvedge_c.h>

#include "support/Temporary_folder.h"
#include "support/doubles.h"

#include <selvedge/mesh_files.h>

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#ifdef SELVEDGE_APP
#include "cli/App_run.h"
#endif

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

// A layer that passed through another and is embedded again: no pair, no piece shows it.
TEST(C_interface, RefusesLayersThatHaveChangedPlaces)
{
  selvedge_mesh* const mesh = selvedge_mesh_generate("tunnel", 1000, 1);
  for (const char* is_checked : {"true", "false"}) {
    selvedge_options* const options = selvedge_options_new();
    selvedge_options_set(options, "ratio", "0");
    selvedge_options_set(options, "intersection_check", is_checked);
    selvedge_result* const result = selvedge_reduce(mesh, options);
    ASSERT_NE(result, nullptr) << selvedge_last_error();
    std::size_t pairs = 1, new_pairs = 1;
    EXPECT_EQ(selvedge_verify(selvedge_result_mesh(result), nullptr, &pairs, nullptr), 1);
    EXPECT_EQ(selvedge_verify(selvedge_result_mesh(result), mesh, &pairs, &new_pairs),
              int(is_checked == std::string("true")));
    EXPECT_EQ(pairs + new_pairs, 0u);
    selvedge_result_free(result);
    selvedge_options_free(options);
  }
  selvedge_mesh_free(mesh);
}

TEST(C_interface, VerdictOnNullIsNone)
{
  EXPECT_EQ(selvedge_verdict_new(nullptr, nullptr, nullptr), nullptr);
  EXPECT_EQ(selvedge_verdict_is_accepted(nullptr), -1);
  EXPECT_EQ(selvedge_verdict_report(nullptr), nullptr);
  selvedge_verdict_free(nullptr);
}

#ifdef SELVEDGE_APP
// Judges the file `mesh` by the program and in C, which say the same; returns the exit code.
int verdict_of_both(const Workspace& folder, const std::string& mesh, const std::string& original,
                    const std::vector<std::pair<std::string, std::string>>& choices,
                    const std::string& obstacle = {})
{
  const std::string path = folder / "verdict.json";
  std::vector<std::string> words{"verify", mesh, "--report", path};
  selvedge_options* const options = selvedge_options_new();
  for (const auto& [name, value] : choices) {
    EXPECT_EQ(selvedge_options_set(options, name.c_str(), value.c_str()), 0) << selvedge_last_error();
    std::string word = "--" + name;
    std::replace(word.begin(), word.end(), '_', '-');
    words.insert(words.end(), {word, value});
  }
  selvedge_mesh *const after = selvedge_mesh_read(mesh.c_str()), *before = nullptr, *beside = nullptr;
  if (!original.empty()) {
    words.insert(words.end(), {"--against", original});
    before = selvedge_mesh_read(original.c_str());
  }
  if (!obstacle.empty()) {
    words.insert(words.end(), {"--obstacle", obstacle});
    beside = selvedge_mesh_read(obstacle.c_str());
    selvedge_options_set_obstacle(options, beside);
  }
  const int code = run_app(words).code;
  nlohmann::json expected = nlohmann::json::parse(contents_of(path));
  for (const char* of_files : {"input", "obstacle", "memory", "exit_code"})
    expected.erase(of_files);
  if (!original.empty())
    expected["original"] = {{"rounded", expected["original"]["rounded"]}};
  selvedge_verdict* const verdict = selvedge_verdict_new(after, before, options);
  EXPECT_NE(verdict, nullptr) << selvedge_last_error();
  EXPECT_EQ(nlohmann::json::parse(selvedge_verdict_report(verdict)), expected);
  EXPECT_EQ(selvedge_verdict_is_accepted(verdict), int(code == 0));
  selvedge_verdict_free(verdict);
  selvedge_options_free(options);
  for (selvedge_mesh* const read : {after, before, beside})
    selvedge_mesh_free(read);
  return code;
}

TEST(Bindings, JudgeAsTheProgramDoes)
{
  const Workspace folder;
  const std::string skirt = folder.generate("skirt", "skirt.obj", 2000),
                    tunnel = folder.generate("tunnel", "tunnel.obj", 1000);
  const auto reduced = [&](const std::string& input, const char* name, std::vector<std::string> more) {
    std::vector<std::string> words{"simplify", input, "-o", folder / name, "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    run_app(words);
    return folder / name;
  };
  const std::string small = reduced(skirt, "small.obj", {"--ratio", "0.3"}),
                    pierced = reduced(skirt, "pierced.obj", {"--ratio", "0.1", "--no-intersection-check"}),
                    swapped = reduced(tunnel, "swapped.obj", {"--ratio", "0", "--no-intersection-check"});
  EXPECT_EQ(verdict_of_both(folder, skirt, "", {}), 0);
  EXPECT_EQ(verdict_of_both(folder, small, skirt, {}), 0);
  EXPECT_EQ(verdict_of_both(folder, pierced, skirt, {}), 1);
  EXPECT_EQ(verdict_of_both(folder, swapped, "", {}), 0);
  EXPECT_EQ(verdict_of_both(folder, swapped, tunnel, {}), 1);
  // Of the skirt alone, pieces are nearer than a metre. Of both, they are as near as they were, or nearer.
  EXPECT_EQ(verdict_of_both(folder, small, "", {{"clearance", "1"}}), 1);
  verdict_of_both(folder, small, skirt, {{"clearance", "1"}});
  EXPECT_EQ(verdict_of_both(folder, small, skirt, {{"weld", "0.001"}}), 0);
  const std::string part = "waistband",
                    without = reduced(skirt, "without.obj", {"--ratio", "0.3", "--drop-part", part});
  EXPECT_EQ(verdict_of_both(folder, without, skirt, {}), 1);
  EXPECT_EQ(verdict_of_both(folder, without, skirt, {{"drop_part", part}}), 0);
  EXPECT_EQ(verdict_of_both(folder, small, "", {}, skirt), 1);
  EXPECT_EQ(verdict_of_both(folder, small, skirt, {}, skirt), 1);
}

// A file with a normal for each vertex has one vertex for each face around it.
TEST(Bindings, JudgeFlatShadedFilesAsTheProgramDoes)
{
  const Workspace folder;
  const std::string spheres = folder.generate("nested", "spheres.glb", 500);
  ASSERT_EQ(run_app({"simplify", spheres, "-o", folder / "flat.glb", "--ratio", "0.5", "--normals", "smooth",
                     "--quiet"})
                .code,
            0);
  EXPECT_EQ(verdict_of_both(folder, folder / "flat.glb", spheres, {}), 0);
  write_mesh(folder / "original.ply", original_with_double());
  write_mesh(folder / "result.ply", reduced_double());
  verdict_of_both(folder, folder / "result.ply", folder / "original.ply", {});
}
#endif

} // namespace
} // namespace selvedge::test
