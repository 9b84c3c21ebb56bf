// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/mesh_of.h"

#include <selvedge/Surface_mesh_simplification/No_observer.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse_record.h>
#include <selvedge/Surface_mesh_simplification/simplify_mesh.h>
#include <selvedge/generate.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <tuple>
#include <vector>

namespace selvedge::test {
namespace {

Triangle_soup skirt_to_record()
{
  Generate_options scene;
  scene.faces = 12000; // in whose order tiles matter
  return generate("skirt", scene);
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

Simplify_options to_a_tenth_more(Simplify_options options, const Simplify_report& first)
{
  options.record.reset();
  options.least_faces = {first.faces_output + first.faces_output / 10};
  return options;
}

struct Watched_run
{
  using Placed = std::tuple<Mesh::Halfedge_index, Point_3, bool>;

  Triangle_soup soup;
  std::vector<Placed> placed;
  Simplify_report report;
};

Watched_run watched_run(Mesh mesh, const Simplify_options& options)
{
  struct Observer : No_observer
  {
    std::vector<Watched_run::Placed> placed;

    void before_placement(Mesh::Halfedge_index moving, const Point_3& place, bool is_mover_first)
    {
      placed.emplace_back(moving, place, is_mover_first);
    }
  } observer;
  Watched_run result;
  result.report = simplify_mesh(mesh, options, {}, observer);
  result.soup = soup_of(mesh);
  result.placed = observer.placed;
  return result;
}

void expect_same_runs(const Watched_run& a, const Watched_run& b)
{
  EXPECT_EQ(a.soup.points, b.soup.points);
  EXPECT_EQ(a.soup.triangles, b.soup.triangles);
  EXPECT_TRUE(a.placed == b.placed);
  EXPECT_EQ(a.report.faces_output, b.report.faces_output);
  EXPECT_EQ(a.report.collapses, b.report.collapses);
  EXPECT_EQ(a.report.placed, b.report.placed);
}

TEST(Collapse_record, GivesTheReductionToMoreFacesWithoutAQuestion)
{
  const Mesh mesh = mesh_of(skirt_to_record());
  for (const Placement placement : {Placement::vertices, Placement::optimal}) {
    Simplify_options options = to_few_faces();
    options.placement = placement;
    const Simplify_report first = watched_run(mesh, options).report;
    Simplify_options further = to_a_tenth_more(options, first);
    const Watched_run asked = watched_run(mesh, further);
    further.repeated = options.record;
    const Watched_run repeated = watched_run(mesh, further);
    expect_same_runs(repeated, asked);
    EXPECT_GT(asked.report.faces_output, first.faces_output);
    EXPECT_GT(asked.report.intersections.motions_judged, 0u);
    EXPECT_EQ(repeated.report.intersections.motions_judged, 0u);
    EXPECT_EQ(repeated.report.placed > 0, placement == Placement::optimal);
    EXPECT_TRUE(repeated.report.is_reached());
    const auto is_mover_first = [](const Watched_run::Placed& placed) { return std::get<2>(placed); };
    EXPECT_EQ(std::any_of(asked.placed.begin(), asked.placed.end(), is_mover_first),
              placement == Placement::optimal)
        << "otherwise it says little";
  }
}

TEST(Collapse_record, BeginsAnewWithEachReduction)
{
  const Mesh mesh = mesh_of(skirt_to_record());
  const Simplify_options options = to_few_faces();
  Simplify_options other = options;
  other.cost.memory = 1;
  watched_run(mesh, other);
  Simplify_options further = to_a_tenth_more(options, watched_run(mesh, options).report);
  const Watched_run asked = watched_run(mesh, further);
  further.repeated = options.record;
  expect_same_runs(watched_run(mesh, further), asked);
}

TEST(Collapse_record, IsRepeatedForLevelsOfDetail)
{
  const Prepared_soup prepared = prepare(skirt_to_record());
  Simplify_options options = to_few_faces();
  const std::vector<double> ratios{0.5, 0.2, 0};
  options.ratio.reset();
  const std::vector<Simplified_soup> first = simplify_lods(prepared, options, ratios);
  Simplify_options further = to_a_tenth_more(options, first.back().report);
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
  const Mesh mesh = mesh_of(skirt_to_record());
  const Simplify_options options = to_few_faces();
  Simplify_options further = to_a_tenth_more(options, watched_run(mesh, options).report);
  further.repeated = options.record;
  std::size_t questions = 0;
  further.should_stop = [&](const Simplify_progress&) { return ++questions == 3; };
  const Simplify_report stopped = watched_run(mesh, further).report;
  EXPECT_TRUE(stopped.is_stopped);
  EXPECT_GT(stopped.collapses, 0u);
  EXPECT_GT(stopped.faces_output, further.least_faces[0]);
}

} // namespace
} // namespace selvedge::test
