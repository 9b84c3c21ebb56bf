// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A motion in one place of a shared mesh has the same motion in every other place as a companion.

#include "soup/Sewn_mesh.h"
#include "soup/Shared_places.h"
#include "support/soups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

/// A sheet in four places: the second 10 to the right, the third mirrored and far above, the fourth further
/// above, and turned in the mesh.
struct Sheet_in_four_places
{
  Sheet_in_four_places()
      : mesh(soup(), std::vector<Index>(positions()), std::vector<char>(4 * s_triangles, false), {}, Scale(),
             is_turned())
  {
  }

  static const Triangle_soup& soup()
  {
    static const Triangle_soup result = [] {
      Triangle_soup mirrored =
          mapped(sheet(s_size, s_size, 100), [](const Point_3& p) { return Point_3(-p.x(), p.y(), p.z()); });
      for (Index_triple& triangle : mirrored.triangles)
        std::swap(triangle[1], triangle[2]);
      return joined(joined(joined(sheet(s_size, s_size), moved(sheet(s_size, s_size), 10, 0, 0)), mirrored),
                    sheet(s_size, s_size, 200));
    }();
    return result;
  }
  static std::vector<Index> positions()
  {
    std::vector<Index> result(4 * s_vertices);
    std::iota(result.begin(), result.end(), Index(0));
    return result;
  }
  static std::vector<char> is_turned()
  {
    std::vector<char> result(4 * s_triangles, false);
    std::fill(result.end() - s_triangles, result.end(), true);
    return result;
  }
  static std::vector<Shared_mesh> meshes()
  {
    Shared_mesh mesh;
    for (Index place = 0; place < 4; ++place) {
      std::vector<Index> triangles(s_triangles);
      std::iota(triangles.begin(), triangles.end(), place * s_triangles);
      mesh.places.push_back({triangles, place == 2});
    }
    return {mesh};
  }

  static constexpr Index s_size = 3, s_triangles = 2 * s_size * s_size,
                         s_vertices = (s_size + 1) * (s_size + 1);
  Sewn_mesh mesh;
};

TEST(SharedPlaces, CompanionsAreTheSameMotionInEveryOtherPlace)
{
  const Sheet_in_four_places scene;
  const Corner_mesh::Mesh& mesh = scene.mesh.mesh();
  const std::vector<Index> of_soup = scene.mesh.vertices_of_soup({});
  const Shared_places places(scene.mesh, scene.meshes(), 0);
  for (const auto h : mesh.halfedges()) {
    const Index mover = of_soup[mesh.source(h)], goal = of_soup[mesh.target(h)];
    std::set<Index> found = {mover / scene.s_vertices};
    EXPECT_EQ(places.is_led(h), mover / scene.s_vertices > 0);
    for (const auto companion : places.companions(h)) {
      const Index its_mover = of_soup[mesh.source(companion)], its_goal = of_soup[mesh.target(companion)];
      EXPECT_EQ(its_mover % scene.s_vertices, mover % scene.s_vertices);
      EXPECT_EQ(its_goal % scene.s_vertices, goal % scene.s_vertices);
      EXPECT_TRUE(found.insert(its_mover / scene.s_vertices).second);
    }
    EXPECT_EQ(found.size(), 4U);
  }
}

// The first two places are 7 apart, and equal stars in them 8 or more: 10 without the width of a star.
TEST(SharedPlaces, AreApartWhereTheirStarsAre)
{
  const Sheet_in_four_places scene;
  const auto are_apart = [&](double clearance) {
    const Shared_places places(scene.mesh, scene.meshes(), clearance);
    std::set<bool> answers;
    for (const auto h : scene.mesh.mesh().halfedges())
      answers.insert(places.are_apart(h, places.companions(h)));
    return answers;
  };
  EXPECT_EQ(are_apart(6.5), std::set<bool>{true});
  EXPECT_EQ(are_apart(7.5), std::set<bool>{true});
  EXPECT_EQ(are_apart(8.5), (std::set<bool>{false, true}));
  EXPECT_EQ(are_apart(9.5), std::set<bool>{false});
}

} // namespace
} // namespace selvedge::test
