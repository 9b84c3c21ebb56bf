// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Surface_mesh_simplification/internal/Remembered_refusals.h>
#include <selvedge/generate.h>
#include <selvedge/prepare.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace selvedge::test {
namespace {

using internal::Remembered_refusals;
using Refusal = Remembered_refusals::Refusal;

// Asks as a filter does: what is not remembered gets the answer of the exact test, in which 0 blockers stand
// for a collapse that is accepted. Returns whether the test had to be asked.
bool is_asked(Remembered_refusals& memory, Remembered_refusals::Number question,
              const std::vector<Remembered_refusals::Number>& blockers)
{
  if (const auto refusal = memory.refusal(question)) {
    EXPECT_EQ(refusal->blockers, blockers);
    return false;
  }
  if (blockers.empty())
    memory.add_accepted(question);
  else
    memory.add_refused(question, {false, blockers});
  return true;
}

TEST(Remembered_refusals, AreNotAskedAboutAgain)
{
  Remembered_refusals memory;
  for (const bool is_first : {true, false, false}) {
    memory.begin(100);
    EXPECT_TRUE(is_asked(memory, 4, {}));
    EXPECT_EQ(is_asked(memory, 5, {7, 8}), is_first);
    EXPECT_EQ(is_asked(memory, 5, {9}), is_first);
    EXPECT_TRUE(is_asked(memory, 6, {}));
  }
}

TEST(Remembered_refusals, SayWhetherClearanceWasLacking)
{
  Remembered_refusals memory;
  memory.begin(100);
  memory.add_refused(1, {true, {3}});
  memory.add_refused(2, {false, {}});
  memory.begin(100);
  const auto first = memory.refusal(1), second = memory.refusal(2);
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(first->is_clearance_lacking);
  EXPECT_FALSE(second->is_clearance_lacking);
  EXPECT_TRUE(second->blockers.empty());
}

TEST(Remembered_refusals, EndWithTheFirstOtherQuestion)
{
  Remembered_refusals memory;
  memory.begin(100);
  for (const auto question : {1, 2, 3})
    is_asked(memory, question, {9});
  memory.begin(100);
  EXPECT_FALSE(is_asked(memory, 1, {9}));
  EXPECT_TRUE(is_asked(memory, 5, {9}));
  EXPECT_TRUE(is_asked(memory, 3, {9})) << "it came after another question";
  memory.begin(100);
  EXPECT_FALSE(is_asked(memory, 1, {9}));
  EXPECT_FALSE(is_asked(memory, 5, {9}));
  EXPECT_FALSE(is_asked(memory, 3, {9}));
  EXPECT_TRUE(is_asked(memory, 4, {9})) << "the record has ended";
}

TEST(Remembered_refusals, EndWhereAnAcceptedCollapseIsRefused)
{
  Remembered_refusals memory;
  memory.begin(100);
  EXPECT_TRUE(is_asked(memory, 1, {}));
  EXPECT_TRUE(is_asked(memory, 2, {9}));
  memory.begin(100);
  EXPECT_TRUE(is_asked(memory, 1, {8}));
  EXPECT_TRUE(is_asked(memory, 2, {9}));
  memory.begin(100);
  EXPECT_FALSE(is_asked(memory, 1, {8}));
  EXPECT_FALSE(is_asked(memory, 2, {9}));
}

TEST(Remembered_refusals, EndWithTheFirstOtherCollapse)
{
  // Asks two questions, of which the first is accepted, and perhaps refused by another filter.
  const auto run = [](Remembered_refusals& memory, bool is_done) {
    memory.begin(100);
    EXPECT_TRUE(is_asked(memory, 1, {}));
    if (is_done)
      memory.add_done(1);
    return is_asked(memory, 2, {9});
  };
  for (const bool is_first_done : {true, false}) {
    Remembered_refusals memory;
    EXPECT_TRUE(run(memory, is_first_done));
    EXPECT_FALSE(run(memory, is_first_done));
    EXPECT_TRUE(run(memory, !is_first_done)) << "the mesh is another one";
  }
}

TEST(Remembered_refusals, EndWhereACollapseThatWasDoneIsAskedAboutAgain)
{
  Remembered_refusals memory;
  memory.begin(100);
  EXPECT_TRUE(is_asked(memory, 1, {}));
  memory.add_done(1);
  memory.begin(100);
  EXPECT_TRUE(is_asked(memory, 1, {}));
  EXPECT_TRUE(is_asked(memory, 1, {9}));
}

TEST(Remembered_refusals, AreOfOneMesh)
{
  Remembered_refusals memory;
  memory.begin(100);
  EXPECT_TRUE(is_asked(memory, 1, {99}));
  memory.begin(90);
  EXPECT_TRUE(is_asked(memory, 1, {89}));
}

TEST(Remembered_refusals, SaveAllRefusalsOfAReductionToMoreFaces)
{
  Generate_options scene;
  scene.faces = 12000; // in whose order tiles matter
  const Prepared_soup prepared = prepare(generate("folded", scene), {});
  Simplify_options options;
  options.ratio = 0;
  options.max_error = 0.01;
  options.remembered_refusals = std::make_shared<Remembered_refusals>();
  const Simplified_soup first = simplify_soup(prepared, options);
  options.least_faces = {first.report.faces_output + first.report.faces_output / 10};
  const Simplified_soup with_record = simplify_soup(prepared, options);
  options.remembered_refusals.reset();
  const Simplified_soup without = simplify_soup(prepared, options);

  EXPECT_EQ(with_record.soup.points, without.soup.points);
  EXPECT_EQ(with_record.soup.triangles, without.soup.triangles);
  EXPECT_EQ(with_record.report.refused.intersection, without.report.refused.intersection);
  EXPECT_GT(with_record.report.faces_output, first.report.faces_output);
  const auto judged = [](const Simplified_soup& result) {
    return result.report.intersections.motions_judged;
  };
  EXPECT_GT(without.report.refused.intersection, 100u) << "otherwise it says little";
  EXPECT_EQ(judged(with_record), judged(without) - without.report.refused.intersection);
}

} // namespace
} // namespace selvedge::test
