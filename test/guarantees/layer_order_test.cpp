// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What `compare` says of the order of layers: all is well after reductions with the filter, and not without.

#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"
#include "support/tunnel_scene.h"

#include <selvedge/compare.h>
#include <selvedge/generate.h>
#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace selvedge::test {
namespace {

Layer_order order_after(const Triangle_soup& soup, const Simplify_options& options)
{
  return compare(reduce(soup, options).simplified.soup, soup).layers;
}

// Embedded before and after: the judge of the result alone sees nothing.
TEST(Layers, ThatTunnelledAreFound)
{
  const Tunnel_scene scene = tunnel_scene();
  const Reduction unguarded = reduce(scene.soup, without_check(to_ratio(0.0)));
  EXPECT_TRUE(unguarded.verification.accepted());
  const Layer_order found = compare(unguarded.simplified.soup, scene.soup).layers;
  EXPECT_GT(found.compared, 100u);
  EXPECT_EQ(found.swaps.size(), found.compared);

  const Layer_order guarded = order_after(scene.soup, to_ratio(0.0));
  EXPECT_TRUE(guarded.swaps.empty());
}

// The line of a swap crosses what it names, which are the patch and the bump.
TEST(Layers, ThatTunnelledAreNamed)
{
  const Tunnel_scene scene = tunnel_scene();
  const Triangle_soup result = reduce(scene.soup, without_check(to_ratio(0.0))).simplified.soup;
  const auto is_patch = [&](const Triangle_soup& soup, Index triangle) {
    return soup.points[soup.triangles[triangle][0]].z() == 0.125;
  };
  for (const Layer_swap& swap : compare(result, scene.soup).layers.swaps) {
    EXPECT_NE(is_patch(scene.soup, swap.of_original[0]), is_patch(scene.soup, swap.of_original[1]));
    EXPECT_EQ(is_patch(scene.soup, swap.of_original[0]), is_patch(result, swap.of_result[0]));
    EXPECT_EQ(is_patch(scene.soup, swap.of_original[1]), is_patch(result, swap.of_result[1]));
  }
}

TEST(Layers, KeepTheirOrderInGuardedReductions)
{
#ifdef NDEBUG
  constexpr std::size_t faces = 5000;
#else
  constexpr std::size_t faces = 2000;
#endif
  const struct
  {
    const char* name;
    Triangle_soup soup;
  } scenes[] = {{"skirt", skirt(faces)}, {"folded", folded_cloth(5000, 5, 1e-4)}};
  for (const auto& [name, soup] : scenes) {
    SCOPED_TRACE(name);
    for (const double ratio : {0.3, 0.1}) {
      SCOPED_TRACE(ratio);
      const Layer_order guarded = order_after(soup, to_ratio(ratio));
      EXPECT_TRUE(guarded.swaps.empty());
      // At 30 %, the folded cloth is nearer to its original than its layers are to each other.
      const bool are_layers_near = 2 * guarded.crossing > guarded.lines;
      EXPECT_EQ(are_layers_near, name == std::string("skirt") || ratio < 0.3);
      EXPECT_GE(2 * guarded.compared, are_layers_near ? guarded.pairs : 0) << "it can hardly tell";
    }
    Simplify_options control = without_check(to_ratio(0.1));
    control.min_aspect_ratio = 0.2; // rounder triangles fit folds less well
    EXPECT_FALSE(order_after(soup, control).swaps.empty()) << "the control";
  }
}

TEST(Layers, DoNotDependOnNumbersOfVertices)
{
  const Tunnel_scene scene = tunnel_scene();
  const Triangle_soup result = reduce(scene.soup, without_check(to_ratio(0.0))).simplified.soup;
  const std::size_t swaps = compare(result, scene.soup).layers.swaps.size();
  EXPECT_EQ(compare(unshared(result), scene.soup).layers.swaps.size(), swaps);
  EXPECT_EQ(compare(result, unshared(scene.soup)).layers.swaps.size(), swaps);
}

// Two sheets, of which one dips through the other at a corner; and the same with vertices of its own for each
// face, as files have them at seams.
TEST(Layers, ThatIntersectNearbyInTheOriginalHaveNoOrder)
{
  Triangle_soup whole = joined(sheet(10, 10), sheet(10, 10, 0.25));
  whole.points.back() = Point_3(10, 10, -0.25);
  for (const Triangle_soup& original : {whole, unshared(whole)}) {
    const std::vector<Offending_pair> pairs = offending_pairs(original);
    ASSERT_FALSE(pairs.empty());
    Layer_order layers;
    layers.reach = 1;
    layers.swaps = {{Point_3(9, 9, 0), {197, 397}, {197, 397}}, {Point_3(3, 3, 0), {66, 266}, {66, 266}}};
    leave_out_without_order(layers, original, original, pairs);
    EXPECT_EQ(layers.without_order, 1u);
    ASSERT_EQ(layers.swaps.size(), 1u);
    EXPECT_EQ(layers.swaps[0].point, Point_3(3, 3, 0));
    // One surface, which does not intersect itself.
    layers.swaps = {{Point_3(9, 9, 0), {199, 198}, {199, 198}}};
    leave_out_without_order(layers, original, original, pairs);
    EXPECT_EQ(layers.swaps.size(), 1u);
  }
}

// Nothing lies close enough to have changed places.
TEST(Layers, FarApartAreNotCompared)
{
  const Triangle_soup original = joined(sheet(4, 4), sheet(4, 4, 3));
  const Triangle_soup result = joined(sheet(4, 4, 0.01), sheet(4, 4, 3));
  const Layer_order found = compare(result, original).layers;
  EXPECT_GT(found.lines, 10'000u);
  EXPECT_EQ(found.crossing, 0u);
}

#ifdef NDEBUG
TEST(Layers, OfARealGarmentKeepTheirOrder)
{
  const std::filesystem::path path =
      std::filesystem::path(SELVEDGE_SHARED_DATA) / "garments/multilayer_skirt.obj";
  if (!std::filesystem::exists(path))
    GTEST_SKIP() << "no " << path;
  const Triangle_soup soup = read_mesh(path).soup;
  const Layer_order guarded = order_after(soup, to_ratio(0.1));
  EXPECT_TRUE(guarded.swaps.empty());
  EXPECT_GT(guarded.compared, 50'000u);
  EXPECT_GT(order_after(soup, without_check(to_ratio(0.1))).swaps.size(), 1000u) << "the control";
}
#endif

} // namespace
} // namespace selvedge::test
