// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"

#include <selvedge/mesh/mesh_files.h>
#include <selvedge/verify.h>

namespace selvedge::test {
namespace {

// Large enough not to be done before the signal comes.
constexpr std::size_t many = 100'000;

TEST(App_terminal, ShowsProgressUnlessQuiet)
{
  const Workspace folder;
  const std::string in = folder.generate("sheets", "in.ply", 40'000);
  for (const bool is_quiet : {false, true}) {
    std::vector<std::string> command{"simplify", in, "-o", folder / "out.ply", "--ratio", "0.05"};
    if (is_quiet)
      command.push_back("--quiet");
    App_process process(command, true);
    EXPECT_EQ(process.wait(), 0) << process.err();
    EXPECT_EQ(process.err().find("removed/s") != std::string::npos, !is_quiet) << process.err();
    EXPECT_EQ(process.err().empty(), is_quiet);
  }
}

TEST(App_interruption, WritesAndVerifiesWhatWasReached)
{
  const Workspace folder;
  const std::string in = folder.generate("sheets", "in.ply", many);
  for (const int signal : {SIGINT, SIGTERM}) {
    App_process process({"simplify", in, "-o", folder / "out.ply", "--ratio", "0.001"}, true);
    ASSERT_TRUE(process.shows("removed/s")) << process.err();
    process.send(signal);
    EXPECT_EQ(process.wait(), 5) << process.err();
    EXPECT_NE(process.err().find("selvedge: interrupted at"), std::string::npos) << process.err();
    const Triangle_soup before = read_mesh(in).soup, after = read_mesh(folder / "out.ply").soup;
    EXPECT_LT(after.triangles.size(), before.triangles.size());
    EXPECT_GT(after.triangles.size(), before.triangles.size() / 1000);
    EXPECT_TRUE(verify(after, before).accepted());
  }
}

TEST(App_interruption, BeforeTheReductionWritesNothing)
{
  const Workspace folder;
  const std::string in = folder.generate("sheets", "in.ply", many);
  App_process process({"simplify", in, "-o", folder / "out.ply", "--ratio", "0.001"}, true);
  ASSERT_TRUE(process.shows("judging the input")) << process.err();
  process.send(SIGINT);
  EXPECT_EQ(process.wait(), 5) << process.err();
  EXPECT_NE(process.err().find("nothing was written"), std::string::npos) << process.err();
  EXPECT_EQ(folder.files(), 1u);
}

TEST(App_interruption, TheSecondKills)
{
  const Workspace folder;
  const std::string in = folder.generate("sheets", "in.ply", many);
  write_text(folder / "out.ply", "precious");
  App_process process({"simplify", in, "-o", folder / "out.ply", "--ratio", "0.001"}, true);
  ASSERT_TRUE(process.shows("removed/s")) << process.err();
  process.send(SIGINT);
  ASSERT_TRUE(process.shows("judging the result")) << process.err();
  process.send(SIGINT);
  EXPECT_EQ(process.wait(), -SIGINT) << process.err();
  EXPECT_EQ(contents_of(folder / "out.ply"), "precious");
}

} // namespace
} // namespace selvedge::test
