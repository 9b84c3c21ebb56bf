// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The clustered index against the brute-force one, in the middle of real reductions.

#include "support/meshes.h"
#include "support/reduction.h"

#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>
#include <selvedge/spatial/Brute_force_index.h>

#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <gtest/gtest.h>

#include <set>

namespace selvedge::test {
namespace {

namespace SMS = CGAL::Surface_mesh_simplification;

// Both indices, asked the same; every answer is compared before it is given.
class Compared_index
{
public:
  using Id = Clustered_AABB_tree::Id;
  struct Statistics
  {
    std::size_t queries = 0;
    std::size_t changes = 0;
    std::size_t missed = 0;
    std::size_t twice = 0;
  };

  explicit Compared_index(std::size_t faces_per_cluster = 100) : m_index(faces_per_cluster) {}

  template <class BoxOf>
  void build(const std::vector<Id>& faces, const BoxOf& box_of)
  {
    m_index.build(faces, box_of);
    m_judge.build(faces, box_of);
  }
  void set(Id face, const CGAL::Bbox_3& box)
  {
    ++m_statistics.changes;
    m_index.set(face, box);
    m_judge.set(face, box);
  }
  void remove(Id face)
  {
    ++m_statistics.changes;
    m_index.remove(face);
    m_judge.remove(face);
  }
  template <class Visitor>
  void visit_overlapping(const CGAL::Bbox_3& box, Visitor&& visit) const
  {
    ++m_statistics.queries;
    std::set<Id> found;
    m_index.visit_overlapping(box, [&](Id face) {
      m_statistics.twice += !found.insert(face).second;
      visit(face);
    });
    m_judge.visit_overlapping(box, [&](Id face) { m_statistics.missed += found.count(face) == 0; });
  }
  const Statistics& statistics() const { return m_statistics; }

private:
  Clustered_AABB_tree m_index;
  Brute_force_index m_judge;
  mutable Statistics m_statistics;
};

class Index_in_use : public testing::TestWithParam<std::size_t>
{
};

INSTANTIATE_TEST_SUITE_P(Index, Index_in_use, testing::Values(1, 20, 100, 100000));

TEST_P(Index_in_use, NeverMissesAFaceThroughoutThousandsOfCollapses)
{
  const Prepared_soup prepared = prepare(skirt(6000, 2));
  Working_mesh working(prepared.soup, prepared.positions, prepared.is_frozen);
  Mesh& mesh = working.mesh();
  const Intersection_filter<Mesh, No_filter, Compared_index> filter(mesh, {}, Compared_index(GetParam()));
  const int removed = SMS::edge_collapse(mesh, Face_ratio_stop(0.1, mesh),
                                         CGAL::parameters::filter(filter).visitor(filter.visitor()));
  EXPECT_GT(removed, 3000);
  EXPECT_GT(filter.index().statistics().queries, 2000u);
  EXPECT_GT(filter.index().statistics().changes, 10000u);
  EXPECT_EQ(filter.index().statistics().missed, 0u);
  EXPECT_EQ(filter.index().statistics().twice, 0u);
}

TEST(Index, WhichOneIsUsedDoesNotChangeTheResult)
{
  const auto reduced = [](auto index) {
    const Prepared_soup prepared = prepare(sheets(3000, 4, 1e-5));
    Working_mesh working(prepared.soup, prepared.positions, prepared.is_frozen);
    const Intersection_filter<Mesh, No_filter, decltype(index)> filter(working.mesh(), {}, std::move(index));
    SMS::edge_collapse(working.mesh(), Face_ratio_stop(0.2, working.mesh()),
                       CGAL::parameters::filter(filter).visitor(filter.visitor()));
    EXPECT_GT(filter.refusals(), 10u);
    return soup_of(working.mesh());
  };
  const Triangle_soup with_tree = reduced(Clustered_AABB_tree()), by_force = reduced(Brute_force_index());
  EXPECT_EQ(with_tree.triangles, by_force.triangles);
  EXPECT_EQ(with_tree.points, by_force.points);
}

} // namespace
} // namespace selvedge::test
