// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G1: an embedded input gives an embedded mesh after every single collapse.

#include "support/mesh_of.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace selvedge::test {
namespace {

// Judges the whole mesh before every collapse, which is after the one before it.
struct Judging_observer : No_observer
{
  explicit Judging_observer(const Mesh* mesh_) : mesh(mesh_) {}

  const Mesh* mesh;
  std::size_t judged = 0;
  std::size_t violations = 0;

  void before_collapse(Mesh::Halfedge_index, const Border_rule<Mesh>&)
  {
    ++judged;
    violations += !is_embedded(soup_of(*mesh));
  }
};

struct Case
{
  const char* name;
  Triangle_soup soup;
};

// Small, and as close together as the generator makes them: the judge looks at all of it after each collapse.
std::vector<Case> small_scenes()
{
  std::vector<Case> cases;
  cases.push_back({"sheets", sheets(700, 4, 1e-6)});
  cases.push_back({"nested spheres", nested_spheres(700, 3, 1e-4)});
  cases.push_back({"folded cloth", folded_cloth(600, 5, 1e-9)});
  cases.push_back({"sewn pieces", sewn_pieces(500)});
  cases.push_back({"flat grid", flat_grid(400)});
  cases.push_back({"needles", generate("needles", [] {
                     Generate_options options;
                     options.faces = 400;
                     return options;
                   }())});
  cases.push_back({"skirt", skirt(1500, 2)});
  cases.push_back({"fan of three", fan_of_three()});
  cases.push_back({"t-junction", t_junction()});
  return cases;
}

TEST(Embedded, StaysSoAfterEveryCollapse)
{
  for (const Case& scene : small_scenes()) {
    for (const bool has_limits : {true, false}) {
      SCOPED_TRACE(testing::Message() << scene.name << (has_limits ? "" : " without limits of quality"));
      const Prepared_soup prepared = prepare(scene.soup, with(Defects::freeze));
      ASSERT_TRUE(prepared.offending_pairs.empty() || scene.name == std::string("t-junction"));
      Working_mesh working(prepared.soup, prepared.positions, prepared.is_frozen);
      Judging_observer observer{&working.mesh()};
      const Simplify_options options = has_limits ? to_ratio(0.05) : without_limits(to_ratio(0.05));
      const Simplify_report report = simplify_mesh(working.mesh(), options, working.constraints(), observer);
      if (prepared.offending_pairs.empty()) {
        EXPECT_EQ(observer.violations, 0u) << "of " << observer.judged;
        EXPECT_TRUE(is_embedded(soup_of(working.mesh())));
      }
      EXPECT_EQ(observer.judged, report.collapses);
    }
  }
}

TEST(Simplify_mesh, RefusesOptionsForSoupsAndWeightsOfAnotherNumber)
{
  const Mesh original = mesh_of(sheet(3, 3));
  const auto expect_refused = [&](auto&& change) {
    Simplify_options options = to_ratio(0.5);
    Simplify_constraints<Mesh> constraints;
    change(options, constraints);
    Mesh mesh = original;
    EXPECT_THROW(simplify_mesh(mesh, options, constraints), Argument_error);
    EXPECT_EQ(mesh.number_of_faces(), original.number_of_faces());
  };
  expect_refused([](auto& options, auto&) { options.faces_per_cell = 100; });
  expect_refused([](auto& options, auto&) { options.on_collapse = [](const Soup_collapse&) {}; });
  expect_refused([](auto&, auto& constraints) { constraints.vertex_weights = {1, 1}; });
  expect_refused([&](auto&, auto& constraints) {
    constraints.vertex_weights.assign(original.number_of_vertices(), -1);
  });
  Mesh mesh = original;
  Simplify_constraints<Mesh> constraints;
  constraints.vertex_weights.assign(original.number_of_vertices(), 0.5);
  EXPECT_GT(simplify_mesh(mesh, to_ratio(0.5), constraints).collapses, 0u);
}

class Close_layers : public testing::TestWithParam<const char*>
{
protected:
  static Triangle_soup scene()
  {
    const std::string name = GetParam();
    if (name == "sheets")
      return sheets(6000, 5, 1e-5);
    if (name == "folded")
      return folded_cloth(6000, 6, 1e-6);
    return skirt(12000, 3);
  }
};

INSTANTIATE_TEST_SUITE_P(Embedded, Close_layers, testing::Values("sheets", "folded", "skirt"));

TEST_P(Close_layers, StaySoOnTheWayToATenth)
{
  for (const Collapse_loop loop : {Collapse_loop::own, Collapse_loop::cgal}) {
    Simplify_options options = to_ratio(0.1);
    options.loop = loop;
    const Reduction reduction = reduce(scene(), options);
    EXPECT_TRUE(reduction.prepared.offending_pairs.empty());
    EXPECT_TRUE(reduction.verification.embedded()) << reduction.verification.pairs.size() << " pairs";
    EXPECT_GT(reduction.simplified.report.collapses, 1000u);
  }
}

// The negative control: it is the filter that keeps them apart. With CGAL's loop, for the own one reduces
// equal sheets alike.
TEST_P(Close_layers, PierceEachOtherWithoutTheFilter)
{
  Simplify_options options = without_check(to_ratio(0.1));
  options.loop = Collapse_loop::cgal;
  EXPECT_FALSE(reduce(scene(), options).verification.embedded());
}

TEST(Embedded, FrozenPairsStayAsTheyAreAndNoneIsAdded)
{
  // Two wavy sheets, one moved into the other.
  Triangle_soup upper = sheets(3000, 1, 1e-3), lower = upper;
  upper =
      mapped(upper, [](const Point_3& p) { return Point_3(p.x() + 0.013, p.y() + 0.007, p.z() + 0.002); });
  Triangle_soup both;
  both.points = lower.points;
  both.triangles = lower.triangles;
  both = joined(both, upper);
  const Reduction reduction = reduce(both, to_ratio(0.3), with(Defects::freeze));
  const std::size_t before = reduction.prepared.offending_pairs.size();
  EXPECT_GT(before, 100u);
  EXPECT_GT(reduction.prepared.frozen_faces, 100u);
  EXPECT_GT(reduction.simplified.report.collapses, 50u);
  EXPECT_EQ(reduction.verification.pairs.size(), before);
  EXPECT_TRUE(reduction.verification.new_pairs.empty());
}

TEST(Embedded, StrictRefusesWhatIsNotAndNamesTheFirstPair)
{
  Prepare_options options;
  options.defects = Defects::refuse;
  EXPECT_NO_THROW(prepare(sheet(2, 2), options));
  try {
    prepare(crossing(), options);
    FAIL() << "accepted";
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find("triangles 1 and 2 intersect"), std::string::npos)
        << error.what();
  }
  EXPECT_THROW(prepare(duplicate(), options), Input_error);
  EXPECT_THROW(prepare(collinear_triangle(), options), Input_error);
}

// Every tiny soup with a defect passes through, with no pair that was not there.
TEST(Embedded, DefectsAreFrozenNotSpread)
{
  for (const Triangle_soup& defective :
       {bowtie(), book(), vertex_touching_face(), edge_touching_edge(), crossing(), coplanar_overlap(),
        coplanar_inside(), duplicate(), opposite_duplicate(), t_junction(), folded_over(),
        collinear_triangle(), moebius_band(), fan_of_three()}) {
    const Reduction reduction =
        reduce(joined(sheet(6, 6, 50), defective), without_limits(to_ratio(0.01)), with(Defects::freeze));
    EXPECT_TRUE(reduction.verification.new_pairs.empty());
    EXPECT_EQ(reduction.verification.pairs.size(), reduction.prepared.offending_pairs.size());
    EXPECT_TRUE(reduction.verification.same_topology());
    EXPECT_GT(reduction.simplified.report.collapses, 20u);
  }
}

class Real_garment : public testing::TestWithParam<const char*>
{
};

INSTANTIATE_TEST_SUITE_P(Embedded, Real_garment,
                         testing::Values("garments/dress_14_pieces_uv.obj", "garments/multilayer_skirt.obj",
                                         "garments/avatar_in_suit_uv.obj",
                                         "garments/multilayer_skirt_as_found.obj"));

TEST_P(Real_garment, GetsNoNewPair)
{
  const std::filesystem::path path = std::filesystem::path(SELVEDGE_SHARED_DATA) / GetParam();
  if (!std::filesystem::exists(path))
    GTEST_SKIP() << path << " is not here; the real meshes lie beside the checkout where there are any";
  const Triangle_soup original = read_mesh(path).soup;
  const std::size_t pairs = offending_pairs(original).size();
  for (const Defects defects : {Defects::freeze, Defects::descend}) {
    const Reduction reduction = reduce(original, to_ratio(0.3), with(defects));
    EXPECT_TRUE(reduction.verification.accepted());
    EXPECT_TRUE(reduction.simplified.report.is_reached());
    if (defects == Defects::freeze || pairs == 0)
      EXPECT_EQ(reduction.verification.pairs.size(), pairs);
    else
      EXPECT_LT(reduction.verification.pairs.size(), pairs);
  }
  EXPECT_FALSE(reduce(original, without_check(to_ratio(0.3))).verification.new_pairs.empty())
      << "the control";
}

} // namespace
} // namespace selvedge::test
