// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"

#include <selvedge/mesh_files.h>
#include <selvedge/verify.h>

#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

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
    EXPECT_TRUE(process.shows("selvedge: stopping: what was reached is judged")) << process.err();
    EXPECT_EQ(process.wait(), 5) << process.err();
    EXPECT_NE(process.err().find("selvedge: interrupted at"), std::string::npos) << process.err();
    const Triangle_soup before = read_mesh(in).soup, after = read_mesh(folder / "out.ply").soup;
    EXPECT_LT(after.triangles.size(), before.triangles.size());
    EXPECT_GT(after.triangles.size(), before.triangles.size() / 1000);
    EXPECT_TRUE(verify(after, before).accepted());
  }
}

// Where the target was missed, a second reduction ends before the last faces, which cost shape.
TEST(App_interruption, OfASecondReductionWritesTheFirst)
{
  const Workspace folder;
  const std::string in = folder.generate("nested", "in.obj", 20'000), out = folder / "out.obj",
                    log = folder / "out.log", report = folder / "report.json";
  const std::vector<std::string> command{"simplify", in,      "-o", out,        "--ratio",
                                         "0.001",    "--log", log,  "--report", report};
  const auto json = [&] { return nlohmann::json::parse(contents_of(report)); };
  EXPECT_EQ(run_app(command).code, 0);
  const std::size_t within_reach = json().at("target").at("within_reach");
  EXPECT_GT(json().at("faces").at("output"), within_reach);
  for (const std::string phase : {"sewing and indexing", "removed/s"}) {
    App_process process(command, true);
    ASSERT_TRUE(process.shows("judging the result")) << process.err();
    ASSERT_TRUE(process.shows(phase)) << process.err();
    process.send(SIGINT);
    EXPECT_TRUE(process.shows("selvedge: interrupted in a second reduction")) << process.err();
    EXPECT_TRUE(process.shows("fitting attributes")) << process.err(); // of what is kept
    EXPECT_EQ(process.wait(), 5) << process.err();
    EXPECT_GT(json().at("seconds").at("fit"), 0);
    EXPECT_EQ(json().at("faces").at("output"), within_reach);
    EXPECT_EQ(json().at("target").at("within_reach"), nullptr);
    EXPECT_GT(json().at("vertices").at("fitted_texture"), 0);
    EXPECT_EQ(read_mesh(out).soup.triangles.size(), within_reach);
    EXPECT_EQ(run_app({"replay", in, log}).code, 0);
  }
}

TEST(App_interruption, IsNotALimit)
{
  const Workspace folder;
  const std::string in = folder.generate("sheets", "in.ply", many);
  App_process process({"simplify", in, "-o", folder / "out.ply", "--error", "0.05"}, true);
  ASSERT_TRUE(process.shows("removed/s")) << process.err();
  process.send(SIGINT);
  EXPECT_EQ(process.wait(), 5) << process.err();
  EXPECT_NE(process.out().find(" s: interrupted\n"), std::string::npos) << process.out();
  EXPECT_EQ(process.out().find("as far as"), std::string::npos) << process.out();
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

// A pipe with nobody at its other end holds a command up for as long as the test wants, at a place that is
// known: when it has been opened from this side as well, the command waits in it.
class Pipe
{
public:
  Pipe(const std::string& path, int mode) : m_path(path), m_mode(mode) { ::mkfifo(path.c_str(), 0600); }
  ~Pipe() { ::close(m_descriptor); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  void wait_for_other_end() { m_descriptor = ::open(m_path.c_str(), m_mode); }

private:
  std::string m_path;
  int m_mode;
  int m_descriptor = -1;
};

TEST(App_interruption, OfEveryCommandWritesNothing)
{
  const Workspace folder;
  const std::string in = folder.generate("sheets", "in.ply", 20'000);
  write_text(folder / "steps.log", "selvedge-log 1\ninput 10404 20000 -\nrounding none\n");
  const std::string source = folder / "source.ply", target = folder / "target.ply";
  const std::vector<std::vector<std::string>> reading = {
      {"simplify", source, "-o", folder / "out.ply", "--ratio", "0.5", "--quiet"},
      {"simplify", in, "-o", folder / "out.ply", "--ratio", "0.5", "--obstacle", source, "--quiet"},
      {"verify", source},
      {"verify", in, "--against", source, "--report", folder / "report.json"},
      {"replay", source, folder / "steps.log", "-o", folder / "out.ply"}};
  const std::vector<std::vector<std::string>> writing = {
      {"simplify", in, "-o", target, "--ratio", "0.9", "--quiet"},
      {"generate", "skirt", "-o", target, "--quiet"}};
  for (const auto& [commands, path, mode] :
       {std::tuple(reading, source, O_WRONLY), std::tuple(writing, target, O_RDONLY)})
    for (const std::vector<std::string>& command : commands)
      for (const int signal : {SIGINT, SIGTERM}) {
        Pipe pipe(path, mode);
        const std::size_t files = folder.files();
        App_process process(command);
        pipe.wait_for_other_end();
        process.send(signal);
        EXPECT_EQ(process.wait(), 5) << command[0];
        EXPECT_EQ(process.err(), "selvedge: interrupted; nothing was written\n");
        EXPECT_EQ(process.out(), "");
        EXPECT_EQ(folder.files(), files);
        std::filesystem::remove(path);
      }
}

} // namespace
} // namespace selvedge::test
