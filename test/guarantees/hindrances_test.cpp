// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G7: stop. A reduction that ends short of its target says of every edge that is left what holds it back.
// Each scene has edges with one reason that its name says, and the control takes the reason away.

#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"
#include "support/threads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

/// Everything that is not refused goes: no limit, and no face is to be left.
Simplify_options to_nothing()
{
  return without_limits(to_ratio(0));
}

Hindrances hindrances_of(const Triangle_soup& soup, const Simplify_options& options,
                         const Simplify_intent& intent = {}, Normals_choice normals = Normals_choice::keep)
{
  Prepare_options how = with(Defects::freeze);
  how.normals = normals;
  how.orient = false;
  return simplify_soup(prepare(soup, how), options, intent).report.hindrances;
}

std::size_t edges_of(const Triangle_soup& soup)
{
  std::set<std::pair<Point_3, Point_3>> edges;
  for (const Index_triple& t : soup.triangles)
    for (int k = 0; k < 3; ++k)
      edges.insert(std::minmax(soup.points[t[k]], soup.points[t[(k + 1) % 3]]));
  return edges.size();
}

/// A crooked sheet, so that nothing but its borders holds it together and none of its faces are coplanar.
Triangle_soup crooked(Index size)
{
  return mapped(sheet(size, size), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), 0.3 * std::sin(2.1 * p.x() + 1.3 * p.y()));
  });
}

TEST(Hindrances, CountEveryEdgeThatIsLeftOnce)
{
  for (const Collapse_loop loop : {Collapse_loop::own, Collapse_loop::cgal})
    for (const Placement placement : {Placement::vertices, Placement::optimal}) {
      Simplify_options options = to_ratio(0);
      options.loop = loop;
      options.placement = placement;
      options.max_error = 0.01;
      const Reduction reduction = reduce(sheets(1000, 3, 1e-3), options);
      const Hindrances& hindrances = reduction.simplified.report.hindrances;
      EXPECT_EQ(hindrances.total(), edges_of(reduction.simplified.soup));
      EXPECT_EQ(hindrances[Hindrance::by_loop], 0u);
    }
}

TEST(Hindrances, AreNotCountedWhenTheTargetIsReachedOrSomebodyStops)
{
  EXPECT_EQ(hindrances_of(crooked(10), to_ratio(0.5)).total(), 0u);
  Simplify_options stopped = to_ratio(0);
  stopped.should_stop = [](const Simplify_progress& progress) { return progress.faces < 150; };
  EXPECT_EQ(hindrances_of(crooked(10), stopped).total(), 0u);
  EXPECT_GT(hindrances_of(crooked(10), to_ratio(0)).total(), 0u); // the control
}

TEST(Hindrances, OfASheetAreItsCorners)
{
  const Hindrances hindrances = hindrances_of(sheet(8, 8), to_ratio(0));
  EXPECT_EQ(hindrances[Hindrance::border_turn], 4u);
  EXPECT_EQ(hindrances[Hindrance::border], 1u); // the diagonal, from border to border
  EXPECT_EQ(hindrances.total(), 5u);
  EXPECT_EQ(hindrances.most(), Hindrance::border_turn);
}

// The faces of a strip are as thin as it is. Those at its ends, with two edges on the border, need not be.
TEST(Hindrances, OfAStripAreNotTheShapeOfItsFaces)
{
  Simplify_options options = to_ratio(0); // with its corners, so that it is not consumed from its ends
  options.min_aspect_ratio = 0.2;         // of a face 1 wide and 6 long
  const Simplified_soup result = simplify_soup(prepare(sheet(60, 1)), options);
  EXPECT_LE(result.soup.triangles.size(), 12u);
  const Simplified_soup wider = simplify_soup(prepare(sheet(60, 2)), options);
  EXPECT_GT(wider.report.refused.aspect_ratio, 0u);
}

TEST(Hindrances, OfAFaceIsTheWeakestOfItsEdges)
{
  const auto held_by = [](const Triangle_soup& soup, const Simplify_options& options,
                          const Simplify_intent& intent = {}) {
    return simplify_soup(prepare(soup), options, intent).held_by;
  };
  // Of both faces, two edges are borders, and the third goes from border to border.
  EXPECT_EQ(held_by(sheet(8, 8), to_ratio(0)), std::vector<Hindrance>(2, Hindrance::border_turn));
  EXPECT_TRUE(held_by(sheet(8, 8), to_ratio(0.5)).empty());

  Triangle_soup named = crooked(9);
  named.groups = {std::vector<Index>(named.triangles.size(), 0), {"cloth", "logo"}};
  for (Index t = 0; t < 20; ++t)
    named.groups.of_triangle[t] = 1;
  Simplify_options refused = to_nothing(); // all that is not locked
  refused.min_aspect_ratio = 1;
  const Simplified_soup kept = simplify_soup(prepare(named), refused, {{}, {}, {"logo"}, {}, {}});
  ASSERT_EQ(kept.held_by.size(), kept.soup.triangles.size());
  for (Index t = 0; t < kept.held_by.size(); ++t)
    if (kept.soup.groups.of_triangle[t] == 1) {
      EXPECT_LE(kept.held_by[t], Hindrance::locked);
    }
  EXPECT_GT(*std::max_element(kept.held_by.begin(), kept.held_by.end()), Hindrance::locked);
}

TEST(Hindrances, TellFrozenFromLocked)
{
  // A triangle stands in the sheet, and freezes the face that it pierces.
  const Triangle_soup pierced =
      joined(crooked(9), soup({{4.4, 4.3, -2}, {4.5, 4.3, 2}, {4.4, 4.4, 2}}, {{0, 1, 2}}));
  const Hindrances frozen = hindrances_of(pierced, to_nothing());
  EXPECT_GT(frozen[Hindrance::frozen], 0u);
  EXPECT_EQ(frozen[Hindrance::locked], 0u);

  Triangle_soup named = crooked(9);
  named.groups = {std::vector<Index>(named.triangles.size(), 0), {"cloth", "logo"}};
  named.groups.of_triangle[80] = named.groups.of_triangle[81] = 1;
  Simplify_intent intent;
  intent.locked = {"logo"};
  const Hindrances locked = hindrances_of(named, to_nothing(), intent);
  EXPECT_EQ(locked[Hindrance::frozen], 0u);
  EXPECT_GT(locked[Hindrance::locked], 0u);
  EXPECT_EQ(hindrances_of(named, to_nothing())[Hindrance::locked], 0u);

  // An edge with one locked end counts for what refuses the other end.
  Simplify_options refused = to_nothing();
  refused.min_aspect_ratio = 1;
  const Hindrances by_aspect = hindrances_of(named, refused, intent);
  EXPECT_LE(by_aspect[Hindrance::locked], 5u); // within the two faces
  EXPECT_GT(by_aspect[Hindrance::aspect_ratio], 100u);
}

TEST(Hindrances, LeaveOutWhatIsFixedFromTheStart)
{
  // Three crossing triangles are all frozen; of the sheet beside them, corners remain.
  const Hindrances alone = hindrances_of(sheet(4, 4), to_ratio(0));
  const Hindrances beside = hindrances_of(
      joined(sheet(4, 4),
             mapped(crossing(), [](const Point_3& p) { return p + Kernel::Vector_3(0, 0, 50); })),
      to_ratio(0));
  EXPECT_EQ(beside.total(), alone.total());
  EXPECT_EQ(beside[Hindrance::frozen], 0u);
}

TEST(Hindrances, NameFacesThatDisagreeInOrientation)
{
  Triangle_soup turned = crooked(8);
  for (std::size_t t = 0; t < turned.triangles.size(); t += 4)
    std::swap(turned.triangles[t][1], turned.triangles[t][2]);
  const Hindrances hindrances = hindrances_of(turned, to_nothing());
  EXPECT_GT(hindrances[Hindrance::misoriented], 0u);
  EXPECT_EQ(hindrances_of(crooked(8), to_nothing())[Hindrance::misoriented], 0u);
}

TEST(Hindrances, NameNonManifoldPlaces)
{
  const Hindrances hindrances = hindrances_of(finned_sheet(10, 1), to_nothing());
  EXPECT_GT(hindrances[Hindrance::non_manifold], 0u);
  EXPECT_EQ(hindrances[Hindrance::misoriented], 0u);
  EXPECT_EQ(hindrances_of(crooked(10), to_nothing())[Hindrance::non_manifold], 0u);
}

/// Gives every corner the number that a function says, for a triangle and a place in it.
template <class Function>
std::vector<Index_triple> corners(const Triangle_soup& soup, const Function& number)
{
  std::vector<Index_triple> result;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    result.push_back({number(t, 0), number(t, 1), number(t, 2)});
  return result;
}

TEST(Hindrances, NameNormalsThatDifferAcrossEdges)
{
  // Each corner has one of three directions, so that all edges are lines and no vertex can go.
  Triangle_soup shaded = crooked(8);
  shaded.normals.values = {{0, 0, 1}, {0, 0.6, 0.8}, {0.6, 0, 0.8}};
  shaded.normals.of_triangle = corners(shaded, [](Index t, Index k) { return (t + k) % 3; });
  const Hindrances kept = hindrances_of(shaded, to_nothing());
  EXPECT_EQ(kept.most(), Hindrance::normals);
  EXPECT_GT(2 * kept[Hindrance::normals], kept.total());
  const Hindrances dropped = hindrances_of(shaded, to_nothing(), {}, Normals_choice::drop);
  EXPECT_EQ(dropped[Hindrance::normals], 0u);
  EXPECT_LT(dropped.total(), kept.total());

  // A file that writes a vertex for each normal has the same reason.
  Triangle_soup split = unshared(shaded);
  split.normals = shaded.normals;
  EXPECT_EQ(hindrances_of(split, to_nothing()).most(), Hindrance::normals);
}

// Where `of_face` says other than 0, faces have another texture, another group, or vertices of their own.
template <class Of_face>
std::array<std::pair<Triangle_soup, Hindrance>, 3> with_seams(const Triangle_soup& soup,
                                                              const Of_face& of_face)
{
  const Index points = Index(soup.points.size());
  Triangle_soup textured = soup;
  for (Index i = 0; i < 4; ++i)
    for (const Point_3& p : soup.points)
      textured.uvs.values.push_back({p.x() + 20. * i, p.y()});
  textured.uvs.of_triangle =
      corners(soup, [&](Index t, Index k) { return of_face(t) * points + soup.triangles[t][k]; });
  Triangle_soup grouped = soup;
  grouped.groups.names = {"a", "b", "c", "d"};
  for (Index t = 0; t < soup.triangles.size(); ++t)
    grouped.groups.of_triangle.push_back(of_face(t));
  Triangle_soup cut = soup;
  for (Index i = 1; i < 4; ++i)
    cut.points.insert(cut.points.end(), soup.points.begin(), soup.points.end());
  cut.triangles = corners(soup, [&](Index t, Index k) { return of_face(t) * points + soup.triangles[t][k]; });
  return {std::pair(textured, Hindrance::texture), std::pair(grouped, Hindrance::group),
          std::pair(cut, Hindrance::seam)};
}

TEST(Hindrances, NameSeamsByWhatDiffers)
{
  // An island, from whose shore no vertex can go to the border.
  const auto of_face = [](Index t) {
    const Index x = t / 2 % 8, y = t / 16;
    return Index(x >= 2 && x < 6 && y >= 2 && y < 6);
  };
  for (const auto& [soup, reason] : with_seams(crooked(8), of_face)) {
    const Hindrances hindrances = hindrances_of(soup, to_nothing());
    for (const Hindrance other : {Hindrance::texture, Hindrance::group, Hindrance::seam, Hindrance::normals})
      EXPECT_EQ(hindrances[other] > 0, other == reason) << int(reason) << ' ' << int(other);
  }
}

TEST(Hindrances, NameEndsOfSeams)
{
  const auto column = [](Index t) { return t / 2 % 8 / 2; };
  for (const auto& [soup, reason] : with_seams(crooked(8), column)) // three seams from border to border
    EXPECT_GT(hindrances_of(soup, to_nothing())[Hindrance::line_end],
              hindrances_of(crooked(8), to_nothing())[Hindrance::line_end])
        << int(reason);
}

TEST(Hindrances, NameTheLimitThatRefuses)
{
  // A border that is round, and surfaces that are curved. Each time, one limit is set and no other.
  const Triangle_soup disc = mapped(sheet(12, 12), [](const Point_3& p) {
    const double x = p.x() / 6 - 1, y = p.y() / 6 - 1, r = std::max(std::abs(x), std::abs(y));
    const double length = std::hypot(x, y);
    return length > 0 ? Point_3(r * x / length, r * y / length, 0) : Point_3(0, 0, 0);
  });
  const Triangle_soup sphere = nested_spheres(800, 1, 1e-2);
  const auto expect = [](const Triangle_soup& soup, Hindrance reason, const auto& set) {
    Simplify_options options = to_nothing();
    const Hindrances before = hindrances_of(soup, options);
    set(options);
    const Hindrances after = hindrances_of(soup, options);
    EXPECT_EQ(after.most(), reason) << Hindrances::descriptions()[std::size_t(after.most())].key;
    EXPECT_EQ(before[reason], 0u) << Hindrances::descriptions()[std::size_t(reason)].key;
  };
  expect(disc, Hindrance::border_turn, [](Simplify_options& options) { options.max_border_turn = 5; });
  expect(disc, Hindrance::drift, [](Simplify_options& options) { options.max_border_drift = 1e-4; });
  expect(sphere, Hindrance::error, [](Simplify_options& options) { options.max_error = 1e-3; });
  expect(sphere, Hindrance::normal_change, [](Simplify_options& options) { options.max_normal_change = 5; });
  expect(sphere, Hindrance::aspect_ratio, [](Simplify_options& options) { options.min_aspect_ratio = 0.95; });
}

TEST(Hindrances, NameLayersInTheWay)
{
  // A sphere, and in it a tetrahedron whose corners come near to it.
  Triangle_soup sphere = nested_spheres(800, 1, 1e-2);
  sphere.uvs = {};
  sphere.groups = {};
  CGAL::Bbox_3 box;
  for (const Point_3& p : sphere.points)
    box += p.bbox();
  const double reach = 0.7 * box.x_span() / 2 / std::sqrt(3);
  const auto corner = [&](double x, double y, double z) {
    return Point_3((box.xmin() + box.xmax()) / 2 + reach * x, (box.ymin() + box.ymax()) / 2 + reach * y,
                   (box.zmin() + box.zmax()) / 2 + reach * z);
  };
  const Triangle_soup both =
      joined(sphere, soup({corner(1, 1, 1), corner(1, -1, -1), corner(-1, 1, -1), corner(-1, -1, 1)},
                          {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}));
  const Hindrances guarded = hindrances_of(both, to_nothing());
  EXPECT_GT(guarded[Hindrance::intersection], 0u);
  const Hindrances unguarded = hindrances_of(both, without_check(to_nothing()));
  EXPECT_EQ(unguarded[Hindrance::intersection], 0u);
}

TEST(Hindrances, NamePartsAtTheirTarget)
{
  Triangle_soup named = crooked(9);
  named.groups = {std::vector<Index>(named.triangles.size(), 0), {"cloth", "logo"}};
  for (std::size_t t = 60; t < 120; ++t)
    named.groups.of_triangle[t] = 1;
  Simplify_intent intent;
  intent.ratios = {{"logo", 1}};
  EXPECT_GT(hindrances_of(named, to_nothing(), intent)[Hindrance::target], 0u);
  EXPECT_EQ(hindrances_of(named, to_nothing())[Hindrance::target], 0u);
}

TEST(Hindrances, AreTheSameInCellsOnAnyNumberOfThreads)
{
  Simplify_options options = to_ratio(0);
  options.max_error = 1e-3;
  options.faces_per_cell = 300;
  const Triangle_soup cloth = skirt(3000);
  const auto with = [&](std::size_t threads) {
    return with_threads(threads, [&] { return hindrances_of(cloth, options); });
  };
  const Hindrances first = with(1);
  EXPECT_GT(first.total(), 0u);
  for (const std::size_t threads : {2, 5}) {
    const Hindrances again = with(threads);
    for (const Hindrances::Description& description : Hindrances::descriptions())
      EXPECT_EQ(first[description.reason], again[description.reason]) << description.key;
  }
}

} // namespace
} // namespace selvedge::test
