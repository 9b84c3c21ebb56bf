// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G7: stop. The target is reached, or the report says that it was not, and why.

#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Reduction_limits.h>

#include <gtest/gtest.h>

#include <cstddef>

namespace selvedge::test {
namespace {

TEST(Stop, TargetIsReachedOrTheReportSaysWhatHeldItBack)
{
  const Reduction reached = reduce(nested_spheres(4000, 2, 1e-2), to_ratio(0.3));
  EXPECT_TRUE(reached.simplified.report.is_reached());
  EXPECT_EQ(reached.simplified.report.outcome(), "reached");
  EXPECT_GE(reached.simplified.soup.triangles.size() + 2, reached.simplified.report.faces_target);

  const Reduction stuck = reduce(sheet(8, 8), to_ratio(0));
  EXPECT_FALSE(stuck.simplified.report.is_reached());
  EXPECT_EQ(stuck.simplified.report.outcome(), "border");
  EXPECT_GT(stuck.simplified.report.hindrances.total(), 0u);
}

// Bumps are removed by collapses that turn their sides into the sheet.
TEST(Stop, SmallSteepBumpsAreLetGoByDefault)
{
  const Triangle_soup bumpy = mapped(sheet(12, 12), [](const Point_3& p) {
    const bool is_bump = int(p.x()) % 3 == 1 && int(p.y()) % 3 == 1;
    return Point_3(p.x(), p.y(), is_bump ? 1.5 : 0);
  });
  Simplify_options options = to_ratio(0.05);
  options.normal_weight = 0; // otherwise, the order is another one, and less is in the way
  EXPECT_TRUE(reduce(bumpy, options).simplified.report.is_reached());
  options.max_normal_change = limits_of_seed().normal_change.value();
  EXPECT_EQ(reduce(bumpy, options).simplified.report.outcome(), "normal_change");
}

TEST(Stop, TheLargerOfTwoTargetsCounts)
{
  Simplify_options options = to_ratio(0.5);
  options.faces = 10;
  EXPECT_EQ(reduce(sheet(10, 10), options).simplified.report.faces_target, 100u);
  options.faces = 150;
  EXPECT_EQ(reduce(sheet(10, 10), options).simplified.report.faces_target, 150u);
}

TEST(Stop, AnErrorBoundEndsTheReduction)
{
  const Triangle_soup sphere = nested_spheres(4000, 1, 1e-2);
  Simplify_options options;
  std::size_t faces_before = sphere.triangles.size();
  for (const double error : {1e-4, 1e-3, 1e-2}) {
    options.max_error = error;
    const Reduction reduction = reduce(sphere, options);
    EXPECT_LT(reduction.simplified.soup.triangles.size(), faces_before);
    EXPECT_LE(reduction.verification.distances->original_to_result.maximum, error * (1 + 1e-9));
    EXPECT_GT(reduction.simplified.report.refused.error, 0u);
    faces_before = reduction.simplified.soup.triangles.size();
  }
}

TEST(Stop, NoVertexIsFartherAwayThanTheErrorAllows)
{
  for (const char* name : {"skirt", "folded"})
    for (const double error : {0., 0.002}) {
      const Triangle_soup original = garment(name, 1500, 2);
      Simplify_options options = without_limits(to_ratio(0.02));
      const double unlimited = reduce(original, options).verification.distances->original_to_result.maximum;
      EXPECT_GT(unlimited, error) << name; // the control
      options.max_error = error;
      Simplify_options by_cgal = options, in_cells = options;
      by_cgal.loop = Collapse_loop::cgal;
      in_cells.faces_per_cell = 300;
      for (const Simplify_options& each : {options, by_cgal, in_cells}) {
        const Reduction reduction = reduce(original, each);
        EXPECT_LE(reduction.verification.distances->original_to_result.maximum, error * (1 + 1e-9) + 1e-12)
            << name;
      }
    }
}

TEST(Stop, TheHookStopsAtAConsistentState)
{
  Simplify_options options = to_ratio(0.1);
  std::size_t calls = 0;
  options.should_stop = [&](const Simplify_progress& progress) {
    EXPECT_EQ(progress.faces_target, progress.faces_input / 10);
    EXPECT_GE(progress.faces, progress.faces_target);
    return ++calls == 3;
  };
  const Reduction reduction = reduce(nested_spheres(8000, 2, 1e-2), options);
  EXPECT_TRUE(reduction.simplified.report.is_stopped);
  EXPECT_EQ(reduction.simplified.report.outcome(), "stopped");
  EXPECT_TRUE(reduction.verification.accepted());
  EXPECT_GT(reduction.simplified.report.faces_output, 1000u);
}

TEST(Stop, RefusedEdgesAreTriedAgainOnceTheyHaveBecomePossible)
{
  Simplify_options options = to_ratio(0.0);
  options.loop = Collapse_loop::cgal;
  EXPECT_GT(reduce(sheets(6000, 6, 1e-5), options).simplified.report.passes, 2u);
  // The own loop does so at once, and leaves nothing to a second pass.
  options.loop = Collapse_loop::own;
  EXPECT_EQ(reduce(sheets(6000, 6, 1e-5), options).simplified.report.passes, 1u);
}

} // namespace
} // namespace selvedge::test
