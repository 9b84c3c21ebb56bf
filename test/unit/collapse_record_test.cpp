// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Surface_mesh_simplification/internal/Collapse_record.h>
#include <selvedge/generate.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace selvedge::test {
namespace {

Prepared_soup folded()
{
  Generate_options scene;
  scene.faces = 12000; // in whose order tiles matter
  return prepare(generate("folded", scene), {});
}

// A reduction to as few faces as possible, with a record, or one to more faces.
Simplify_options to_few_faces()
{
  Simplify_options options;
  options.ratio = 0;
  options.max_error = 0.01;
  options.record = std::make_shared<internal::Collapse_record>();
  return options;
}

Simplify_options to_a_tenth_more(Simplify_options options, const Simplified_soup& first)
{
  options.record.reset();
  options.least_faces = {first.report.faces_output + first.report.faces_output / 10};
  return options;
}

struct Watched_run
{
  Simplified_soup result;
  std::vector<Soup_collapse> collapses;
};
Watched_run run(const Prepared_soup& prepared, Simplify_options options)
{
  Watched_run run;
  options.on_collapse = [&](const Soup_collapse& collapse) { run.collapses.push_back(collapse); };
  run.result = simplify_soup(prepared, options);
  return run;
}

void expect_same(const Watched_run& a, const Watched_run& b)
{
  EXPECT_EQ(a.result.soup.points, b.result.soup.points);
  EXPECT_EQ(a.result.soup.triangles, b.result.soup.triangles);
  EXPECT_TRUE(a.collapses == b.collapses);
  EXPECT_EQ(a.result.report.faces_output, b.result.report.faces_output);
  EXPECT_EQ(a.result.report.collapses, b.result.report.collapses);
  EXPECT_EQ(a.result.report.placed, b.result.report.placed);
}

TEST(Collapse_record, GivesTheReductionToMoreFacesWithoutAQuestion)
{
  const Prepared_soup prepared = folded();
  for (const Placement placement : {Placement::vertices, Placement::optimal}) {
    Simplify_options options = to_few_faces();
    options.placement = placement;
    const Simplified_soup first = simplify_soup(prepared, options);
    Simplify_options further = to_a_tenth_more(options, first);
    const Watched_run asked = run(prepared, further);
    further.repeated = options.record;
    const Watched_run repeated = run(prepared, further);
    expect_same(repeated, asked);
    EXPECT_GT(asked.result.report.faces_output, first.report.faces_output);
    EXPECT_GT(asked.result.report.intersections.motions_judged, 0u);
    EXPECT_EQ(repeated.result.report.intersections.motions_judged, 0u);
    EXPECT_EQ(repeated.result.report.placed > 0, placement == Placement::optimal);
    EXPECT_TRUE(repeated.result.report.is_reached());
  }
}

TEST(Collapse_record, BeginsAnewWithEachReduction)
{
  const Prepared_soup prepared = folded();
  const Simplify_options options = to_few_faces();
  simplify_soup(prepared, options);
  const Simplified_soup first = simplify_soup(prepared, options);
  Simplify_options further = to_a_tenth_more(options, first);
  const Watched_run asked = run(prepared, further);
  further.repeated = options.record;
  expect_same(run(prepared, further), asked);
}

TEST(Collapse_record, IsRepeatedForLevelsOfDetail)
{
  const Prepared_soup prepared = folded();
  Simplify_options options = to_few_faces();
  const std::vector<double> ratios{0.5, 0.2, 0};
  options.ratio.reset();
  const std::vector<Simplified_soup> first = simplify_lods(prepared, options, ratios);
  Simplify_options further = to_a_tenth_more(options, first.back());
  const std::vector<Simplified_soup> asked = simplify_lods(prepared, further, ratios);
  further.repeated = options.record;
  const std::vector<Simplified_soup> repeated = simplify_lods(prepared, further, ratios);
  ASSERT_EQ(repeated.size(), asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) {
    EXPECT_EQ(repeated[i].soup.points, asked[i].soup.points);
    EXPECT_EQ(repeated[i].soup.triangles, asked[i].soup.triangles);
    EXPECT_EQ(repeated[i].report.faces_target, asked[i].report.faces_target);
  }
}

TEST(Collapse_record, CanBeStoppedWhileItIsRepeated)
{
  const Prepared_soup prepared = folded();
  const Simplify_options options = to_few_faces();
  const Simplified_soup first = simplify_soup(prepared, options);
  Simplify_options further = to_a_tenth_more(options, first);
  further.repeated = options.record;
  std::size_t questions = 0;
  further.should_stop = [&](const Simplify_progress&) { return ++questions == 3; };
  const Simplified_soup stopped = simplify_soup(prepared, further);
  EXPECT_TRUE(stopped.report.is_stopped);
  EXPECT_GT(stopped.report.collapses, 0u);
  EXPECT_GT(stopped.report.faces_output, further.least_faces[0]);
}

} // namespace
} // namespace selvedge::test
