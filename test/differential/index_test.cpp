// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The fast indices against the brute-force one, in the middle of real reductions.

#include "support/mesh_of.h"
#include "support/meshes.h"
#include "support/reduction.h"

#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Visitor_chain.h>
#include <selvedge/Surface_mesh_simplification/edge_collapse.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>
#include <selvedge/spatial/Brute_force_index.h>
#include <selvedge/spatial/Clustered_AABB_tree.h>
#include <selvedge/spatial/Packed_R_tree.h>

#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

namespace SMS = CGAL::Surface_mesh_simplification;

// An index and the judge, asked the same; every answer is compared before it is given.
template <class Index>
class Compared_index
{
public:
  using Id = typename Index::Id;
  struct Statistics
  {
    std::size_t queries = 0;
    std::size_t changes = 0;
    std::size_t missed = 0;
    std::size_t twice = 0;
  };

  explicit Compared_index(Index index = Index()) : m_index(std::move(index)) {}

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
  void visit_overlapping(const CGAL::Bbox_3& query, Visitor&& visit) const
  {
    ++m_statistics.queries;
    std::set<Id> found;
    m_index.visit_overlapping(query, [&](Id face) {
      m_statistics.twice += !found.insert(face).second;
      visit(face);
    });
    m_judge.visit_overlapping(query, [&](Id face) { m_statistics.missed += found.count(face) == 0; });
  }
  const Statistics& statistics() const { return m_statistics; }

private:
  Index m_index;
  Brute_force_index m_judge;
  mutable Statistics m_statistics;
};

template <class Index>
void expect_never_to_miss_a_face(Index index)
{
  const Prepared_soup prepared = prepare(skirt(6000, 2));
  Working_mesh working(prepared.soup, prepared.positions, prepared.is_frozen);
  Mesh& mesh = working.mesh();
  const Intersection_filter<Mesh, No_filter, Compared_index<Index>> filter(
      mesh, {}, Compared_index<Index>(std::move(index)));
  const int removed = SMS::edge_collapse(mesh, Face_ratio_stop(0.1, mesh),
                                         CGAL::parameters::filter(filter).visitor(filter.visitor()));
  EXPECT_GT(removed, 3000);
  EXPECT_GT(filter.index().statistics().queries, 2000u);
  EXPECT_GT(filter.index().statistics().changes, 10000u);
  EXPECT_EQ(filter.index().statistics().missed, 0u);
  EXPECT_EQ(filter.index().statistics().twice, 0u);
}

class Clusters_in_use : public testing::TestWithParam<std::size_t>
{
};

INSTANTIATE_TEST_SUITE_P(Index, Clusters_in_use, testing::Values(1, 20, 100, 100000));

TEST_P(Clusters_in_use, NeverMissAFaceThroughoutThousandsOfCollapses)
{
  expect_never_to_miss_a_face(Clustered_AABB_tree(GetParam()));
}

TEST(Index, NeverMissesAFaceThroughoutThousandsOfCollapses)
{
  expect_never_to_miss_a_face(Packed_R_tree());
}

// Visits the same faces in the opposite order.
class Descending_index : public Brute_force_index
{
public:
  template <class Visitor>
  void visit_overlapping(const CGAL::Bbox_3& box, Visitor&& visit) const
  {
    std::vector<Id> found;
    Brute_force_index::visit_overlapping(box, [&](Id face) { found.push_back(face); });
    std::for_each(found.rbegin(), found.rend(), visit);
  }
};

// Asks two filters, and counts the refusals for which they name other faces as blockers.
template <class Filter, class Other>
struct Compared_blockers
{
  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    const auto accepted = (*filter)(profile, placement);
    EXPECT_EQ((*other)(profile, placement).has_value(), accepted.has_value());
    counts->named += !filter->blockers().empty();
    counts->differences += filter->blockers() != other->blockers();
    return accepted;
  }

  struct Counts
  {
    std::size_t named = 0;
    std::size_t differences = 0;
  };
  const Filter* filter;
  const Other* other;
  Counts* counts;
};

template <class Index>
void expect_same_blockers(Index index, double clearance)
{
  const Prepared_soup prepared = prepare(sheets(3000, 4, 1e-5));
  Working_mesh working(prepared.soup, prepared.positions, prepared.is_frozen);
  Mesh& mesh = working.mesh();
  using Filter = Intersection_filter<Mesh, No_filter, Brute_force_index>;
  using Other = Intersection_filter<Mesh, No_filter, Index>;
  const Filter filter(mesh, {}, Brute_force_index());
  const Other other(mesh, {}, std::move(index));
  if (clearance > 0) {
    filter.keep_clearance(clearance);
    other.keep_clearance(clearance);
  }
  typename Compared_blockers<Filter, Other>::Counts counts;
  edge_collapse(mesh, Face_ratio_stop(0.2, mesh),
                CGAL::parameters::filter(Compared_blockers<Filter, Other>{&filter, &other, &counts})
                    .visitor(Visitor_chain(filter.visitor(), other.visitor())));
  EXPECT_GT(counts.named, 100u);
  EXPECT_EQ(counts.differences, 0u);
}

// The loop considers a refused edge again when one of its blockers changes: others would change the result.
TEST(Index, WhichOneIsUsedDoesNotChangeTheBlockers)
{
  for (const double clearance : {0., 1e-4}) {
    SCOPED_TRACE(clearance);
    expect_same_blockers(Descending_index(), clearance);
    expect_same_blockers(Packed_R_tree(), clearance);
    expect_same_blockers(Clustered_AABB_tree(), clearance);
  }
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
  const Triangle_soup by_force = reduced(Brute_force_index());
  const auto expect_same = [&](const Triangle_soup& soup) {
    EXPECT_EQ(soup.triangles, by_force.triangles);
    EXPECT_EQ(soup.points, by_force.points);
  };
  expect_same(reduced(Packed_R_tree()));
  expect_same(reduced(Clustered_AABB_tree()));
}

} // namespace
} // namespace selvedge::test
