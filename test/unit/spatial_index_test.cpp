// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Error.h>
#include <selvedge/spatial/Brute_force_index.h>
#include <selvedge/spatial/Clustered_AABB_tree.h>
#include <selvedge/spatial/Packed_R_tree.h>
#include <selvedge/spatial/internal/Box_block.h>
#include <selvedge/spatial/internal/Framed_box_block.h>
#include <selvedge/spatial/internal/Monotone_box.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <set>
#include <tuple>
#include <vector>

namespace {

using selvedge::Brute_force_index;
using selvedge::Clustered_AABB_tree;
using selvedge::Packed_R_tree;
using Id = Packed_R_tree::Id;

class Random_boxes
{
public:
  Random_boxes(unsigned seed, double origin, double extent)
      : m_random(seed), m_origin(origin), m_extent(extent)
  {
  }

  // From 0 to 1.
  double number() { return double(m_random()) / double(std::mt19937::max()); }
  Id index(std::size_t size) { return Id(m_random() % size); }

  // Sizes over many orders of magnitude, points among them.
  CGAL::Bbox_3 box()
  {
    double lower[3], upper[3];
    const double size = m_random() % 8 == 0 ? 0 : std::pow(10, -6 * number());
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = m_origin + m_extent * number();
      upper[axis] = lower[axis] + m_extent * size * number();
    }
    return {lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]};
  }

private:
  std::mt19937 m_random;
  double m_origin, m_extent;
};

template <class Index, class Query>
std::multiset<Id> overlapping(const Index& index, const Query& box)
{
  std::multiset<Id> result;
  index.visit_overlapping(box, [&](Id id) { result.insert(id); });
  return result;
}

// What every query must satisfy: all that overlap, each once, and nothing that is not in.
template <class Index>
void expect_same_but_for_rounding(const Index& index, const Brute_force_index& judge,
                                  const std::vector<bool>& is_in, const CGAL::Bbox_3& query)
{
  const std::multiset<Id> found = overlapping(index, query);
  for (const Id id : overlapping(judge, query))
    ASSERT_EQ(found.count(id), 1u) << "face " << id << " was missed or visited twice";
  for (const Id id : found) {
    ASSERT_EQ(found.count(id), 1u);
    ASSERT_TRUE(is_in[id]) << "face " << id << " is gone, and was visited";
  }
}

template <class Index>
std::size_t rebuilds(const Index& index)
{
  return index.statistics().cluster_rebuilds + index.statistics().top_rebuilds;
}

template <class MakeIndex>
void expect_never_to_miss_a_box(const MakeIndex& make_index, double origin, double extent)
{
  for (unsigned seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random_boxes random(seed, origin, extent);
    std::vector<Id> faces;
    std::vector<CGAL::Bbox_3> boxes;
    for (Id face = 0; face < 700; ++face) {
      boxes.push_back(random.box());
      if (face % 7 < 2) // most come later, so that trees are made anew wherever they are
        faces.push_back(face);
    }
    std::vector<bool> is_in(boxes.size(), false);
    for (const Id face : faces)
      is_in[face] = true;
    auto index = make_index();
    Brute_force_index judge;
    index.build(faces, [&](Id face) { return boxes[face]; });
    judge.build(faces, [&](Id face) { return boxes[face]; });

    for (int step = 0; step < 1500; ++step) {
      const Id face = random.index(boxes.size());
      if (is_in[face] && random.number() < (step < 1000 ? 0.4 : 1)) { // at the end most are gone
        index.remove(face);
        judge.remove(face);
        is_in[face] = false;
      } else if (step < 1000) {
        const CGAL::Bbox_3 box = random.box();
        index.set(face, box);
        judge.set(face, box);
        is_in[face] = true;
      }
      expect_same_but_for_rounding(index, judge, is_in, random.box());
      if (testing::Test::HasFatalFailure())
        return;
    }
    EXPECT_GT(rebuilds(index), 0u);
  }
}

// Far from the origin and huge, where float has next to no digits left, tiny, and about as large as floats
// are.
const auto origins = testing::Values(0.0, 1e7, -1e30);
const auto extents = testing::Values(1.0, 1e-9, 6e38, 1e300);

class Clustered_index : public testing::TestWithParam<std::tuple<int, double, double>>
{
};

TEST_P(Clustered_index, NeverMissesABoxWhileBoxesComeChangeAndGo)
{
  const auto [faces_per_cluster, origin, extent] = GetParam();
  expect_never_to_miss_a_box([size = faces_per_cluster] { return Clustered_AABB_tree(size); }, origin,
                             extent);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Clustered_index,
                         testing::Combine(testing::Values(1, 10, 100, 100000), origins, extents));

class Packed_index : public testing::TestWithParam<std::tuple<double, double>>
{
};

TEST_P(Packed_index, NeverMissesABoxWhileBoxesComeChangeAndGo)
{
  const auto [origin, extent] = GetParam();
  expect_never_to_miss_a_box([] { return Packed_R_tree(); }, origin, extent);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Packed_index, testing::Combine(origins, extents));

using selvedge::internal::Box_block;
using selvedge::internal::Framed_box_block;
using selvedge::internal::Monotone_box;
using selvedge::internal::Monotone_box_map;

TEST(Box_block, FindsBoxesThatTouch)
{
  Box_block block;
  block.set(3, {{0, 0, 0}, {1, 1, 1}});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Monotone_box beside{{0, 0, 0}, {1, 1, 1}};
    beside.lower[axis] = beside.upper[axis] = 1;
    EXPECT_EQ(block.overlapping(beside), 1u << 3) << axis;
    beside.lower[axis] = beside.upper[axis] = 0;
    EXPECT_EQ(block.overlapping(beside), 1u << 3) << axis;
  }
}

class Framed_boxes : public testing::TestWithParam<std::tuple<double, double>>
{
};

INSTANTIATE_TEST_SUITE_P(Sizes, Framed_boxes, testing::Combine(origins, extents));

TEST_P(Framed_boxes, AreFoundAndReadBackHardlyLarger)
{
  const auto [origin, extent] = GetParam();
  Random_boxes random(5, origin, extent);
  Framed_box_block::Boxes boxes; // as they were set
  Framed_box_block block;
  std::size_t found = 0, overlapping = 0;
  for (int step = 0; step < 4000; ++step) {
    const std::size_t i = random.index(boxes.size());
    if (step % 400 == 0) { // a few boxes in a small frame, from which they come out
      boxes.fill(Monotone_box::empty());
      for (std::size_t k = 0; k < 4; ++k)
        boxes[k] = Monotone_box_map()(Random_boxes(unsigned(step + 1), origin, 1e-3 * extent).box());
      block = Framed_box_block(boxes);
    } else if (step % 5 == 0) {
      boxes[i] = Monotone_box::empty();
      block.set_empty(i);
    } else {
      boxes[i] = Monotone_box_map()(random.box());
      block.set(i, boxes[i]);
    }
    Monotone_box all = Monotone_box::empty();
    for (const Monotone_box& box : boxes)
      all += box;
    const Monotone_box query = Monotone_box_map()(random.box());
    const Framed_box_block::Mask mask = block.overlapping(query);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      ASSERT_EQ(block[k].is_empty(), boxes[k].is_empty());
      if (boxes[k].is_empty()) {
        ASSERT_EQ(mask >> k & 1, 0u);
        continue;
      }
      ASSERT_TRUE(block[k].contains(boxes[k]));
      ASSERT_TRUE(bounding_box(block).contains(boxes[k]));
      for (std::size_t axis = 0; axis < 3 && extent < 1e30; ++axis) {
        // A frame has room for boxes that have left; and floats have an end.
        const double most = std::max(0.01 * extent, 2e-6 * std::abs(double(all.lower[axis])));
        ASSERT_LE(double(boxes[k].lower[axis]) - double(block[k].lower[axis]), most);
        ASSERT_LE(double(block[k].upper[axis]) - double(boxes[k].upper[axis]), most);
      }
      if (boxes[k].overlaps(query)) {
        ASSERT_EQ(mask >> k & 1, 1u);
      }
      found += mask >> k & 1;
      overlapping += boxes[k].overlaps(query);
    }
  }
  if (origin == 0 && extent == 1) {
    EXPECT_LT(found, overlapping + overlapping / 10);
  }
  EXPECT_GT(overlapping, 10u);
}

using Corners = Packed_R_tree::Corners;

CGAL::Bbox_3 box_of(const Corners& corners)
{
  CGAL::Bbox_3 box;
  for (const auto& [x, y, z] : corners)
    box += CGAL::Bbox_3(x, y, z, x, y, z);
  return box;
}

bool do_meet(const Corners& a, const Corners& b)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto triangle = [](const Corners& c) {
    const auto point = [&](int i) { return Kernel::Point_3(c[i][0], c[i][1], c[i][2]); };
    return Kernel::Triangle_3(point(0), point(1), point(2));
  };
  for (const auto& corner : a)
    if (std::find(b.begin(), b.end(), corner) != b.end())
      return true;
  return !triangle(a).is_degenerate() && !triangle(b).is_degenerate() &&
         CGAL::do_intersect(triangle(a), triangle(b));
}

TEST(Packed_index, LeavesOutNoSliverThatAHullMeets)
{
  std::size_t meeting = 0, left_out = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Random_boxes random(seed, 0, 1);
    const double origin = seed % 4 == 1 ? 1e5 : 0, width = seed % 3 == 0 ? 0 : 0.01; // needles, and slivers
    std::vector<Corners> slivers(400);
    const auto renew = [&](Corners& corners) {
      const double length = random.number(), spread = seed % 2 == 0 ? 1 : 0.02;
      const bool is_joined = random.number() < 0.3;
      const auto start = slivers[random.index(slivers.size())][random.index(3)];
      for (int axis = 0; axis < 3; ++axis) {
        corners[0][axis] = is_joined ? start[axis] : origin + random.number();
        const double along = length * (spread * (random.number() - 0.5) + 0.5);
        corners[1][axis] = corners[0][axis] + along;
        corners[2][axis] = corners[0][axis] + along / 2 + width * random.number();
      }
    };
    std::vector<Id> faces;
    for (Id face = 0; face < slivers.size(); ++face) {
      renew(slivers[face]);
      if (face % 2 == 0) // the others come later
        faces.push_back(face);
    }
    std::vector<bool> is_in(slivers.size(), false);
    for (const Id face : faces)
      is_in[face] = true;
    const auto corners_of = [&](Id face) { return slivers[face]; };
    Packed_R_tree index;
    index.build(
        faces, [&](Id face) { return box_of(slivers[face]); }, corners_of);
    for (int step = 0; step < 1000; ++step) {
      const Id face = random.index(slivers.size());
      if (is_in[face] && random.number() < (step < 700 ? 0.4 : 1)) {
        index.remove(face);
        is_in[face] = false;
      } else if (step < 700) {
        renew(slivers[face]);
        index.set(face, box_of(slivers[face]), corners_of);
        is_in[face] = true;
      }
      Corners query;
      renew(query);
      std::set<Id> found;
      index.visit_overlapping(box_of(query), query, [&](Id id) { ASSERT_TRUE(found.insert(id).second); });
      for (Id id = 0; id < slivers.size(); ++id)
        if (is_in[id] && CGAL::do_overlap(box_of(query), box_of(slivers[id]))) {
          left_out += found.count(id) == 0;
          if (do_meet(query, slivers[id])) {
            ++meeting;
            ASSERT_EQ(found.count(id), 1u) << "face " << id << " was missed in step " << step;
          }
        }
    }
  }
  EXPECT_GT(meeting, 2000u);
  EXPECT_GT(left_out, 20 * meeting);
}

TEST(Packed_index, VisitsFewFacesOfAFringeOfAnySize)
{
  for (const Id count : {1000u, 8000u}) {
    std::vector<Corners> slivers;
    std::vector<Id> faces;
    Random_boxes random(count, 0, 1);
    for (Id face = 0; face < count; ++face) {
      const double x = face % 40, y = face / 40, bend = random.number();
      slivers.push_back(
          {{{x, y, -x - y}, {x + 400, y + 420, 380 - x - y}, {x + 200 + bend, y + 210, 190 - x - y}}});
      faces.push_back(face);
    }
    Packed_R_tree index;
    index.build(
        faces, [&](Id face) { return box_of(slivers[face]); }, [&](Id face) { return slivers[face]; });
    std::size_t visits = 0, visits_of_boxes = 0;
    for (const Corners& corners : slivers) {
      index.visit_overlapping(box_of(corners), corners, [&](Id) { ++visits; });
      index.visit_overlapping(box_of(corners), [&](Id) { ++visits_of_boxes; });
    }
    EXPECT_LT(visits, 20 * count);
    EXPECT_GT(visits_of_boxes, 500 * count);
    // A face whose corners are not told any more is known by its box.
    bool is_found = false;
    index.set(0, box_of(slivers.back()));
    index.visit_overlapping(box_of(slivers.back()), slivers.back(), [&](Id id) { is_found |= id == 0; });
    EXPECT_TRUE(is_found);
  }
}

template <class Index>
class Spatial_index : public testing::Test
{
};
using Indices = testing::Types<Clustered_AABB_tree, Packed_R_tree>;
TYPED_TEST_SUITE(Spatial_index, Indices);

TYPED_TEST(Spatial_index, FindsWhatFloatsCannotTellApart)
{
  const auto point = [](double x) { return CGAL::Bbox_3(x, x, x, x, x, x); };
  TypeParam index;
  index.build({0, 1}, [&](Id id) { return point(id == 0 ? 1.0 : std::nextafter(1.0, 2.0)); });
  EXPECT_EQ(overlapping(index, point(1.0)).count(0), 1u);
  EXPECT_EQ(overlapping(index, point(std::nextafter(1.0, 2.0))).count(1), 1u);
}

TYPED_TEST(Spatial_index, WorksFromEmpty)
{
  TypeParam index;
  index.build({}, [](Id) { return CGAL::Bbox_3(); });
  EXPECT_TRUE(overlapping(index, CGAL::Bbox_3(0, 0, 0, 1, 1, 1)).empty());
  index.set(4, CGAL::Bbox_3(0, 0, 0, 1, 1, 1));
  EXPECT_EQ(overlapping(index, CGAL::Bbox_3(1, 1, 1, 2, 2, 2)), (std::multiset<Id>{4}));
  index.remove(4);
  EXPECT_TRUE(overlapping(index, CGAL::Bbox_3(0, 0, 0, 1, 1, 1)).empty());
}

TYPED_TEST(Spatial_index, MovesWithItsContent)
{
  TypeParam first;
  first.build({0}, [](Id) { return CGAL::Bbox_3(0, 0, 0, 1, 1, 1); });
  TypeParam second = std::move(first);
  second.set(1, CGAL::Bbox_3(0, 0, 0, 1, 1, 1));
  EXPECT_EQ(overlapping(second, CGAL::Bbox_3(0, 0, 0, 1, 1, 1)), (std::multiset<Id>{0, 1}));
}

// The boxes of a square of 64 × 64 unit squares, in some order of their numbers.
std::size_t boxes_asked_for(const std::vector<Id>& faces)
{
  Packed_R_tree index;
  std::size_t questions = 0;
  const auto box_of = [](Id face) {
    const double x = face % 64, y = face / 64;
    return CGAL::Bbox_3(x, y, 0, x + 1, y + 1, 0);
  };
  index.build(faces, [&](Id face) {
    ++questions;
    return box_of(face);
  });
  for (const Id face : faces)
    EXPECT_EQ(overlapping(index, box_of(face)).count(face), 1u);
  return questions;
}

TEST(Packed_index, SortsNoFacesOfWhichNeighboursComeTogether)
{
  std::vector<Id> rows(64 * 64), blocks, shuffled;
  std::iota(rows.begin(), rows.end(), Id(0));
  for (const Id place : rows) { // the bits of both coordinates alternate in the place
    Id face = 0;
    for (int bit = 0; bit < 6; ++bit)
      face |= (place >> 2 * bit & 1) << bit | (place >> (2 * bit + 1) & 1) << (6 + bit);
    blocks.push_back(face);
  }
  shuffled = rows;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
  const std::size_t sample = 1024; // at most, which says where the middle is
  EXPECT_LE(boxes_asked_for(blocks), blocks.size() + sample);
  EXPECT_GE(boxes_asked_for(rows), 3 * rows.size()); // blocks of 4 × 4 are smaller than 16 in a row
  EXPECT_GE(boxes_asked_for(shuffled), 3 * shuffled.size());
}

TEST(SpatialIndex, RefusesEmptyClusters)
{
  EXPECT_THROW(Clustered_AABB_tree(0), selvedge::Argument_error);
}

TEST(SpatialIndex, HoldsAboutAsManyFacesPerClusterAsAskedFor)
{
  std::vector<Id> faces(40000);
  for (Id face = 0; face < faces.size(); ++face)
    faces[face] = face;
  const auto box_on_sheet = [](Id face) {
    const double x = face % 200, y = face / 200;
    return CGAL::Bbox_3(x, y, 0, x + 1, y + 1, 0);
  };
  Clustered_AABB_tree index(100);
  index.build(faces, box_on_sheet);
  EXPECT_GT(index.statistics().clusters, 200u);
  EXPECT_LT(index.statistics().clusters, 800u);
}

} // namespace
