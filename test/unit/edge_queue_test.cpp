// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The two orders of the queue of edges.

#include <selvedge/Surface_mesh_simplification/internal/Edge_queue.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <tuple>
#include <vector>

namespace selvedge::test {
namespace {

using Queue = internal::Edge_queue<double>;

std::vector<std::uint32_t> popped(Queue& queue)
{
  std::vector<std::uint32_t> edges;
  while (!queue.is_empty())
    edges.push_back(queue.pop().second);
  return edges;
}

// The number of the eighth of a power of two in which a cost lies.
double class_of(double cost)
{
  if (!(cost > 0))
    return -std::numeric_limits<double>::infinity();
  int exponent = 0;
  const double mantissa = std::frexp(cost, &exponent); // from 1/2 to 1
  return 8 * exponent + std::floor(16 * mantissa);
}

TEST(Edge_queue, TakesEdgesInEitherOrder)
{
  constexpr std::uint32_t edges = 60000; // eight tiles
  for (const bool is_relaxed : {false, true}) {
    SCOPED_TRACE(is_relaxed);
    std::mt19937 random(7);
    const auto cost = [&]() -> double {
      const std::uint32_t kind = random() % 16;
      return kind == 0 ? 0 : kind == 1 ? -double(random() % 9) : std::ldexp(1 + random() % 99, int(kind) - 8);
    };
    Queue queue(edges, is_relaxed);
    std::map<std::uint32_t, double> costs;
    for (std::uint32_t edge = 0; edge < edges / 2; ++edge)
      queue.append(edge, costs[edge] = cost());
    queue.sort();
    for (std::uint32_t i = 0; i < edges; ++i) { // changed, added, removed
      const std::uint32_t edge = random() % edges;
      if (random() % 4 == 0) {
        queue.erase(edge);
        costs.erase(edge);
      } else {
        queue.set(edge, costs[edge] = cost());
      }
    }
    std::vector<std::tuple<double, std::uint32_t, double, std::uint32_t>> keys;
    for (const auto& [edge, c] : costs)
      keys.emplace_back(is_relaxed ? class_of(c) : 0, is_relaxed ? edge / 8192 : 0, c, edge);
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> expected;
    for (const auto& key : keys)
      expected.push_back(std::get<3>(key));
    EXPECT_EQ(popped(queue), expected);
  }
}

TEST(Edge_queue, KnowsTheFirstTileWhenTheFirstEdgeOfOneChanges)
{
  const auto first_after = [](const auto& change) {
    Queue queue(20000, true);
    queue.append(0, 1);
    queue.append(1, 8);
    queue.append(10000, 4); // in another tile
    queue.sort();
    change(queue);
    return queue.pop().second;
  };
  EXPECT_EQ(first_after([](Queue& queue) { queue.set(0, 16); }), 10000u);
  EXPECT_EQ(first_after([](Queue& queue) { queue.erase(0); }), 10000u);
  EXPECT_EQ(first_after([](Queue& queue) {
              queue.pop();
              queue.set(1, 2);
            }),
            1u);
}

TEST(Edge_queue, TakesTheCheapestEdgesTileByTileWhenTheirClassesAreMerged)
{
  constexpr std::uint32_t edges = 60000; // eight tiles
  std::mt19937 random(11);
  std::vector<double> costs(edges);
  Queue queue(edges, true);
  for (std::uint32_t edge = 0; edge < edges; ++edge)
    queue.append(edge, costs[edge] = std::ldexp(1 + random() % 99, -int(random() % 16)));
  queue.sort();

  double highest = 0; // of the classes merged before
  for (const std::size_t count : {20000, 10000, 5000}) {
    SCOPED_TRACE(count);
    ASSERT_TRUE(queue.are_merged_classes_gone());
    ASSERT_TRUE(queue.merge_classes(count));
    std::vector<std::uint32_t> merged;
    while (!queue.are_merged_classes_gone())
      merged.push_back(queue.pop().second);
    EXPECT_GT(merged.size(), count * 9 / 10);
    EXPECT_LT(merged.size(), count * 11 / 10 + edges / 50) << "the last class is merged as a whole";
    EXPECT_TRUE(std::is_sorted(merged.begin(), merged.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::tuple(a / 8192, costs[a], a) < std::tuple(b / 8192, costs[b], b);
    }));
    const auto [least, most] = std::minmax_element(
        merged.begin(), merged.end(), [&](std::uint32_t a, std::uint32_t b) { return costs[a] < costs[b]; });
    EXPECT_GT(costs[*least], highest);
    highest = costs[*most];
  }

  // An edge that has become as cheap comes first, and alone.
  const std::uint32_t again = queue.pop().second;
  queue.set(again, 0);
  EXPECT_FALSE(queue.are_merged_classes_gone());
  EXPECT_EQ(queue.pop().second, again);
  EXPECT_TRUE(queue.are_merged_classes_gone());

  EXPECT_FALSE(queue.merge_classes(16 * 8 - 1)) << "less than 16 edges in a tile";
  const std::vector<std::uint32_t> rest = popped(queue);
  EXPECT_TRUE(std::is_sorted(rest.begin(), rest.end(), [&](std::uint32_t a, std::uint32_t b) {
    return class_of(costs[a]) < class_of(costs[b]);
  }));
}

TEST(Edge_queue, KnowsWhichEdgeWouldBeItsFirst)
{
  constexpr std::uint32_t edges = 60000; // eight tiles
  for (const bool is_relaxed : {false, true}) {
    SCOPED_TRACE(is_relaxed);
    std::mt19937 random(13);
    const auto cost = [&] { return std::ldexp(1 + random() % 9, -int(random() % 4)); };
    Queue queue(edges, is_relaxed);
    for (std::uint32_t edge = 0; edge < edges; ++edge)
      queue.append(edge, cost());
    queue.sort();
    queue.merge_classes(edges / 2);
    std::size_t first = 0;
    for (std::size_t i = 0; i < edges / 4; ++i) {
      const auto [least, edge] = queue.pop();
      const double changed = random() % 2 == 0 ? least : cost();
      const bool is_first = queue.would_be_first(edge, changed);
      queue.set(edge, changed);
      EXPECT_EQ(queue.pop().second == edge, is_first);
      first += is_first;
    }
    EXPECT_GT(first, edges / 16);
    while (!queue.is_empty())
      queue.pop();
    EXPECT_TRUE(queue.would_be_first(0, 1));
  }
}

TEST(Edge_queue, MergesNothingInStrictOrder)
{
  Queue queue(100, false);
  for (std::uint32_t edge = 0; edge < 100; ++edge)
    queue.append(edge, 100 - edge);
  queue.sort();
  EXPECT_FALSE(queue.merge_classes(50));
  EXPECT_EQ(queue.pop().second, 99u);
}

} // namespace
} // namespace selvedge::test
