// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Faces that run against the others of their surface: they are reduced like the others, and keep their
// winding.

#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace selvedge::test {
namespace {

bool is_turned(std::size_t triangle)
{
  return triangle % 5 == 2 || triangle % 7 == 3;
}

Triangle_soup with_some_turned(Triangle_soup soup)
{
  for (auto* corners : {&soup.triangles, &soup.uvs.of_triangle, &soup.normals.of_triangle})
    for (std::size_t t = 0; t < corners->size(); ++t)
      if (is_turned(t))
        std::swap((*corners)[t][1], (*corners)[t][2]);
  return soup;
}

Prepare_options kept()
{
  Prepare_options options;
  options.orient = false;
  return options;
}

TEST(Orientation, FacesAreReducedAsIfTheyAgreedAndKeepTheirWinding)
{
  const Triangle_soup agreeing = skirt(2000);
  const Triangle_soup soup = with_some_turned(agreeing);
  for (const double ratio : {0.2, 0.6}) {
    const Reduction reduction = reduce(soup, to_ratio(ratio)), like = reduce(agreeing, to_ratio(ratio));
    EXPECT_TRUE(reduction.verification.accepted());
    EXPECT_TRUE(reduction.verification.same_topology());
    EXPECT_EQ(reduction.simplified.triangles, like.simplified.triangles);
    EXPECT_EQ(reduction.simplified.soup.points, like.simplified.soup.points);
    Triangle_soup expected = like.simplified.soup;
    for (std::size_t i = 0; i < expected.triangles.size(); ++i)
      if (is_turned(like.simplified.triangles[i]))
        std::swap(expected.triangles[i][1], expected.triangles[i][2]);
    EXPECT_EQ(reduction.simplified.soup.triangles, expected.triangles);
  }
  // A control: without turning, hardly a vertex can move.
  EXPECT_GT(reduce(soup, to_ratio(0.2), kept()).simplified.soup.triangles.size(), soup.triangles.size() / 2);
}

TEST(Orientation, IsInTheLogOnWhichTheReplayRests)
{
  const Triangle_soup soup = with_some_turned(skirt(1000));
  const Logged_reduction reduction = reduce_and_log(soup, to_ratio(0.3));
  const Replay_verdict verdict = replay_text(soup, reduction.log);
  EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
  EXPECT_TRUE(verdict.is_result_stated);
  EXPECT_EQ(verdict.soup.triangles, reduction.simplified.soup.triangles);

  const std::size_t line = reduction.log.find("\nt ");
  ASSERT_NE(line, std::string::npos);
  std::string without = reduction.log;
  without.erase(line, reduction.log.find('\n', line + 1) - line);
  EXPECT_FALSE(replay_text(soup, without).is_accepted());
  EXPECT_EQ(reduce_and_log(skirt(1000), to_ratio(0.3)).log.find("\nt "), std::string::npos);
}

TEST(Orientation, WhatAgreesStillDoes)
{
  const Triangle_soup band = moebius_band();
  const auto notes = [](const Triangle_soup& soup, const Prepare_options& options) {
    return reduce(soup, to_ratio(1), options).simplified.sewing;
  };
  ASSERT_EQ(notes(band, kept()).misoriented_edges, 1u);
  EXPECT_EQ(notes(band, {}).misoriented_edges, 1u) << "no orientation fits";
  EXPECT_GT(notes(with_some_turned(band), kept()).misoriented_edges, 3u);
  EXPECT_EQ(notes(with_some_turned(band), {}).misoriented_edges, 1u);
  EXPECT_EQ(prepare(band).turned_faces(), 0u);
}

TEST(Orientation, PiecesThatFaceOppositeWaysAreSewn)
{
  const Triangle_soup sewn = joined(sheet(4, 4), moved(sheet(3, 4), 4, 0, 0));
  Triangle_soup opposite = sewn;
  for (std::size_t t = sheet(4, 4).triangles.size(); t < opposite.triangles.size(); ++t)
    std::swap(opposite.triangles[t][0], opposite.triangles[t][1]);
  const Prepared_soup prepared = prepare(opposite);
  EXPECT_EQ(prepared.turned_faces(), 24u) << "those of the smaller piece";
  const auto seams = [](const Prepared_soup& soup) {
    return simplify_soup(soup, to_ratio(1)).sewing.seam_edges;
  };
  EXPECT_EQ(seams(prepare(sewn)), 4u);
  EXPECT_EQ(seams(prepared), 4u);
  EXPECT_EQ(seams(prepare(opposite, kept())), 0u);
}

} // namespace
} // namespace selvedge::test
