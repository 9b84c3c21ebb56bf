// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"
#include "support/sanitizers.h"

#include <selvedge/generate.h>
#include <selvedge/mesh_files.h>
#include <selvedge/verify.h>

namespace selvedge::test {
namespace {

TEST(App_generate, MakesEverythingItLists)
{
  const Workspace folder;
  const App_result list = run_app({"generate", "--list"});
  EXPECT_EQ(list.code, 0);
  ASSERT_FALSE(scenes().empty());
  for (const Scene_description& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    EXPECT_NE(list.out.find(scene.name), std::string::npos);
    const std::string path = folder.generate(std::string(scene.name), std::string(scene.name) + ".ply", 4000);
    EXPECT_TRUE(is_embedded(read_mesh(path).soup));
  }
}

TEST(App_generate, OptionsArrive)
{
  const Workspace folder;
  const auto make = [&](const std::vector<std::string>& options) {
    std::vector<std::string> command{"generate", "skirt", "-o", folder / "out.obj", "--faces", "2000"};
    command.insert(command.end(), options.begin(), options.end());
    const App_result result = run_app(command);
    EXPECT_EQ(result.code, 0) << result.err;
    return contents_of(folder / "out.obj");
  };
  const std::string plain = make({});
  EXPECT_EQ(make({}), plain);
  for (const std::vector<std::string>& option : {std::vector<std::string>{"--layers", "2"},
                                                 {"--thickness", "0"},
                                                 {"--gap", "0.002"},
                                                 {"--fold-depth", "0.01"},
                                                 {"--folds", "9"},
                                                 {"--seed", "2"}})
    EXPECT_NE(make(option), plain) << option.front();
}

// In every scene, every option changes the mesh or is refused.
TEST(App_generate, RefusesOptionsThatChangeNothing)
{
  const Workspace folder;
  struct Change
  {
    std::string option, value;
    void (*make)(Generate_options&);
  };
  const Change changes[] = {
      {"--layers", "2", [](Generate_options& options) { options.layers = 2; }},
      {"--thickness", "4e-4", [](Generate_options& options) { options.thickness = 4e-4; }},
      {"--gap", "9e-4", [](Generate_options& options) { options.gap = 9e-4; }},
      {"--fold-depth", "0.01", [](Generate_options& options) { options.fold_depth = 0.01; }},
      {"--folds", "9", [](Generate_options& options) { options.folds = 9; }},
      {"--seed", "2", [](Generate_options& options) { options.seed = 2; }}};
  for (const Scene_description& scene : scenes())
    for (const Change& change : changes) {
      SCOPED_TRACE(std::string(scene.name) + ' ' + change.option);
      Generate_options options;
      options.faces = 4000;
      const std::vector<Point_3> plain = generate(scene.name, options).points;
      change.make(options);
      const std::vector<std::string> command{
          "generate", std::string(scene.name), "-o",        folder / "out.obj", "--faces",
          "4000",     change.option,           change.value};
      if (generate(scene.name, options).points == plain)
        expect_refused(command, 2, change.option + ": changes nothing in the scene");
      else
        EXPECT_EQ(run_app(command).code, 0);
    }
}

TEST(App_generate, StaysEmbeddedInFloatsOrIsRefused)
{
  const Workspace folder;
  EXPECT_TRUE(is_embedded(read_mesh(folder.generate("skirt", "out.stl", 1000)).soup));
  expect_refused({"generate", "sheets", "-o", folder / "close.stl", "--faces", "1000", "--gap", "1e-15"}, 4,
                 "32-bit");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(App_generate, RefusesWhatItCannotMake)
{
  const Workspace folder;
  expect_refused({"generate", "trousers", "-o", folder / "a.obj"}, 2, "trousers");
  expect_refused({"generate", "skirt", "-o", folder / "a.obj", "--faces", "5"}, 2, "faces");
  expect_refused({"generate", "skirt", "-o", folder / "a.obj", "--gap", "nan"}, 2, "gap");
  expect_refused({"generate", "skirt"}, 2, "-o");
  expect_refused({"generate"}, 2, "--list");
  EXPECT_EQ(folder.files(), 0u);
}

#if !defined(SELVEDGE_IS_SANITIZED)
TEST(App_generate, TooLittleMemoryIsSaid)
{
  const Workspace folder;
  App_limits tight;
  tight.memory = 200'000'000;
  expect_refused({"generate", "grid", "-o", folder / "a.ply", "--faces", "10000000"}, 3, "not enough memory",
                 tight);
  EXPECT_EQ(folder.files(), 0u);
}
#endif

} // namespace
} // namespace selvedge::test
