// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Every phase asks the hook of a `Cancellation_scope`, ends at whichever question is answered with yes, and
// leaves nothing half done. Nothing here depends on time: questions are counted.

#include "support/Temporary_folder.h"
#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include "weld/snapping.h"
#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/Sha256.h>
#include <selvedge/compare.h>
#include <selvedge/generate.h>
#include <selvedge/merge.h>
#include <selvedge/mesh_files.h>
#include <selvedge/part_report.h>

#include <gtest/gtest.h>

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace selvedge {
namespace {

using namespace test;

constexpr std::size_t never = -1;

/// How a call ended that was told to stop at some question.
struct Ending
{
  bool is_interrupted;
  std::size_t questions;
};

Ending run_until(std::size_t question, const std::function<void()>& call)
{
  std::atomic<std::size_t> questions{0};
  const Cancellation_scope scope([&] { return ++questions >= question; });
  try {
    call();
  } catch (const Interrupted&) {
    return {true, questions};
  }
  return {false, questions};
}

/// One thing that takes long, and how many triangles it has to do with.
struct Phase
{
  std::string name;
  std::size_t triangles;
  std::function<void()> call;
};

class Scene
{
public:
  Scene() { write_mesh(m_folder / "other.stl", m_prepared.soup); }

  std::vector<Phase> phases()
  {
    std::vector<Phase> result;
    const auto add = [&](const std::string& name, std::function<void()> call) {
      result.push_back({name, m_soup.triangles.size(), std::move(call)});
    };
    for (const char* const extension : {".obj", ".off", ".ply", ".stl", ".glb", ".gltf"}) {
      const std::filesystem::path path = m_folder / (std::string("mesh") + extension);
      const bool is_rounded = stores_float32(mesh_format(path));
      const Triangle_soup& soup = is_rounded ? m_prepared.soup : m_soup;
      write_mesh(path, soup);
      add("reading " + path.extension().string(), [path] { read_mesh(path); });
      add("writing " + path.extension().string(), [path, &soup] { write_mesh(path, soup); });
    }
    Write_options ascii;
    ascii.encoding = Encoding::ascii;
    for (const char* const name : {"ascii.ply", "ascii.stl"}) {
      const std::filesystem::path path = m_folder / name;
      write_mesh(path, m_prepared.soup, ascii);
      add(std::string("reading ") + name, [path] { read_mesh(path); });
      add(std::string("writing ") + name, [this, path, ascii] { write_mesh(path, m_prepared.soup, ascii); });
    }
    add("a digest", [path = m_folder / "mesh.obj"] { sha256_of_file(path); });

    add("preparing", [this] { prepare(m_soup); });
    add("rounding and welding", [this] {
      Prepare_options options;
      options.round_to_float32 = true;
      options.weld_distance = 1e-5;
      prepare(m_soup, options);
    });
    const auto add_reduction = [&](const std::string& name, const Simplify_options& wanted) {
      add("reducing, " + name, [this, wanted] { simplify_soup(m_prepared, wanted); });
    };
    Simplify_options options = to_ratio(0.5);
    add_reduction("the own loop", options);
    options.loop = Collapse_loop::cgal;
    add_reduction("CGAL's loop", options);
    options = to_ratio(0.5);
    options.index = Face_index::clusters;
    add_reduction("in clusters", options);
    options = to_ratio(0.5);
    options.faces_per_cell = 4000;
    add_reduction("in cells", options);
    add("levels of detail", [this] { simplify_lods(m_prepared, {}, {0.7, 0.5}); });
    add("joining", [this] { merged_at_positions(m_soup); });

    add("judging pairs", [this] { offending_pairs(m_soup); });
    add("whether it is embedded", [this] { is_embedded(m_soup); });
    add("pieces", [this] { pieces(m_soup); });
    add("matching", [this] { match_pieces(m_result.soup, m_soup); });
    add("matching what was moved", [this] { match_pieces(m_moved, m_soup); });
    add("distances", [this] { distances(m_result.soup, m_soup); });
    add("verifying", [this] { verify(m_result.soup, m_soup); });
    add("comparing", [this] { compare(m_result.soup, m_soup); });
    add("parts", [this] { part_reports(m_result, m_prepared); });
    add("texture", [this] { uv_deviation(m_result, m_prepared); });

    add("logging", [this] { reduce_and_log(m_soup, to_ratio(0.98)); });
    add("replaying", [this] { replay_text(m_logged.original, m_logged.log); });
    for (const Scene_description& scene : scenes())
      add("generating " + std::string(scene.name), [name = std::string(scene.name)] {
        Generate_options generated;
        generated.faces = 9000;
        generate(name, generated);
      });
    return result;
  }

  std::size_t files() const
  {
    return std::size_t(std::distance(std::filesystem::directory_iterator(m_folder.path()), {}));
  }

  const Temporary_folder& folder() const { return m_folder; }

private:
  static Prepared_soup rounded(const Triangle_soup& soup)
  {
    Prepare_options options;
    options.round_to_float32 = true;
    return prepare(soup, options);
  }

  Temporary_folder m_folder;
  Triangle_soup m_soup = skirt(9000);
  Prepared_soup m_prepared = rounded(m_soup);
  Simplified_soup m_result = simplify_soup(m_prepared, to_ratio(0.5));
  Triangle_soup m_moved =
      mapped(m_result.soup, [](const Point_3& p) { return Point_3(p.x() + 1e-5, p.y(), p.z()); });
  Logged_reduction m_logged = reduce_and_log(m_soup, to_ratio(0.95));
};

TEST(Cancellation, EndsEveryPhaseAtAnyQuestion)
{
  // Alone, so that the same questions come again.
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  Scene scene;
  for (const Phase& phase : scene.phases()) {
    SCOPED_TRACE(phase.name);
    const std::size_t files = scene.files();
    const Ending whole = run_until(never, phase.call);
    EXPECT_FALSE(whole.is_interrupted);
    EXPECT_GE(whole.questions, 1 + phase.triangles / 8192) << "it asks too seldom";
    // All but the last few, which may be asked one sooner or later: counters of threads live on.
    std::vector<std::size_t> stops{1, 2};
    for (std::size_t i = 1; i < 4; ++i)
      stops.push_back(whole.questions * i / 4);
    for (const std::size_t stop : stops) {
      if (stop == 0 || stop + 4 > whole.questions)
        continue;
      const Ending ending = run_until(stop, phase.call);
      EXPECT_TRUE(ending.is_interrupted) << "at question " << stop << " of " << whole.questions;
      EXPECT_EQ(ending.questions, stop) << "it went on";
      EXPECT_EQ(scene.files(), files) << "something was left behind";
    }
    EXPECT_TRUE(run_until(1, phase.call).is_interrupted);
    EXPECT_FALSE(run_until(never, phase.call).is_interrupted) << "what was cancelled did harm";
  }
}

TEST(Cancellation, EndsWhatOtherThreadsDo)
{
  const tbb::global_control several(tbb::global_control::max_allowed_parallelism, 4);
  Scene scene;
  for (const Phase& phase : scene.phases()) {
    const std::vector<std::string> with_threads{"judging pairs", "verifying", "comparing",
                                                "parts",         "preparing", "reducing, in cells"};
    if (std::find(with_threads.begin(), with_threads.end(), phase.name) == with_threads.end())
      continue;
    SCOPED_TRACE(phase.name);
    const std::size_t all = run_until(never, phase.call).questions;
    ASSERT_GT(all, 4u);
    for (const std::size_t stop : {std::size_t(1), all / 2}) {
      const Ending ending = run_until(stop, phase.call);
      EXPECT_TRUE(ending.is_interrupted);
      EXPECT_LE(ending.questions, stop + 8) << "each thread may ask once more";
    }
  }
}

TEST(Cancellation, LeavesFilesAsTheyWere)
{
  const Temporary_folder folder;
  const std::filesystem::path path = folder / "mesh.obj";
  std::ofstream(path) << "precious";
  const Triangle_soup soup = skirt(9000);
  const std::size_t questions = run_until(never, [&] { write_mesh(folder / "other.obj", soup); }).questions;
  std::filesystem::remove(folder / "other.obj");
  ASSERT_GT(questions, 2u);
  for (std::size_t stop = 1; stop <= questions; ++stop) {
    EXPECT_TRUE(run_until(stop, [&] { write_mesh(path, soup); }).is_interrupted);
    EXPECT_EQ(contents_of(path), "precious");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  }
}

// A hook for progress alone does not keep the scope from being asked.
TEST(Cancellation, EndsAReductionWhoseProgressIsReported)
{
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Prepared_soup prepared = prepare(skirt(9000));
  Simplify_options options = to_ratio(0.1);
  std::size_t calls = 0, last = 0;
  options.should_stop = [&](const Simplify_progress& now) {
    last = now.faces;
    return ++calls == 0;
  };
  const Cancellation_scope scope([&] { return calls > 2; });
  EXPECT_THROW(simplify_soup(prepared, options), Interrupted);
  EXPECT_GT(last, prepared.soup.triangles.size() / 2);
}

// With `should_stop` a reduction ends where it is, whichever question it is.
TEST(Cancellation, KeepsWhatAReductionHasReachedWhereThatIsWanted)
{
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Prepared_soup prepared = prepare(skirt(9000));
  for (const std::size_t faces_per_cell : {0, 2000}) {
    Simplify_options options = to_ratio(0.3);
    options.faces_per_cell = faces_per_cell;
    const auto run = [&](std::size_t stop, std::size_t& questions) {
      options.should_stop = [&](const Simplify_progress&) { return ++questions >= stop; };
      return simplify_soup(prepared, options);
    };
    std::size_t all = 0;
    EXPECT_FALSE(run(never, all).report.is_stopped);
    ASSERT_GT(all, 8u);
    std::size_t faces = prepared.soup.triangles.size();
    for (std::size_t stop = 1; stop < all; stop += all / 6) {
      SCOPED_TRACE(stop);
      std::size_t questions = 0;
      const Simplified_soup result = run(stop, questions);
      EXPECT_TRUE(result.report.is_stopped);
      EXPECT_TRUE(verify(result, prepared).accepted());
      if (faces_per_cell == 0) {
        EXPECT_LE(result.soup.triangles.size(), faces) << "less than what was reached sooner";
      }
      faces = result.soup.triangles.size();
    }
    EXPECT_LT(faces, prepared.soup.triangles.size());
  }
}

TEST(Cancellation, OfALevelGivesWhatWasReachedToTheOthers)
{
  const Prepared_soup prepared = prepare(skirt(4000));
  Simplify_options options;
  options.faces_per_cell = 1000; // so that each level is a reduction of its own
  std::size_t questions = 0;
  options.should_stop = [&](const Simplify_progress& progress) {
    ++questions;
    return progress.faces < progress.faces_input * 7 / 10;
  };
  const std::vector<Simplified_soup> levels = simplify_lods(prepared, options, {0.9, 0.5, 0.2});
  EXPECT_FALSE(levels[0].report.is_stopped);
  EXPECT_TRUE(levels[1].report.is_stopped);
  EXPECT_TRUE(levels[2].report.is_stopped);
  EXPECT_EQ(levels[2].soup.triangles, levels[1].soup.triangles);
}

TEST(Cancellation, IsOfTheInnermostScopeAndOfOneThread)
{
  const Cancellation_scope outer([] { return true; });
  EXPECT_THROW(Cancellation_scope::check(), Interrupted);
  {
    const Cancellation_scope inner([] { return false; });
    EXPECT_NO_THROW(Cancellation_scope::check());
  }
  EXPECT_THROW(Cancellation_scope::check(), Interrupted);
  {
    const Cancellation_scope none({});
    EXPECT_NO_THROW(Cancellation_scope::check());
  }
  bool is_other_interrupted = true, is_inherited_interrupted = false;
  const auto inherited = Cancellation_scope::inherited([] { Cancellation_scope::check(); });
  std::thread([&] {
    try {
      Cancellation_scope::check();
      is_other_interrupted = false;
      inherited();
    } catch (const Interrupted&) {
      is_inherited_interrupted = true;
    }
    Cancellation_scope::check(); // no longer inherited
  }).join();
  EXPECT_FALSE(is_other_interrupted);
  EXPECT_TRUE(is_inherited_interrupted);
}

// The same bytes without a scope, in one, and after a run that was cancelled.
TEST(Cancellation, ChangesNoByteOfWhatIsNotCancelled)
{
  const Temporary_folder folder;
  const Triangle_soup soup = skirt(4000);
  const auto bytes = [&] {
    const Logged_reduction reduction = reduce_and_log(soup, to_ratio(0.5));
    write_mesh(folder / "out.obj", reduction.simplified.soup);
    return contents_of(folder / "out.obj") + reduction.log;
  };
  const std::string expected = bytes();
  std::string found;
  const Ending whole = run_until(never, [&] { found = bytes(); });
  EXPECT_EQ(found, expected);
  for (const std::size_t part : {1, 2, 3})
    EXPECT_TRUE(run_until(whole.questions * part / 4, [&] { bytes(); }).is_interrupted);
  EXPECT_EQ(bytes(), expected);
}

TEST(Cancellation, IsNotAskedForWithoutAScope)
{
  EXPECT_NO_THROW(Cancellation_scope::check());
  EXPECT_NO_THROW(offending_pairs(skirt(4000)));
}

} // namespace
} // namespace selvedge
