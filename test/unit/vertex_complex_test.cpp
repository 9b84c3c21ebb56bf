// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The link conditions by which doubles are judged keep the topology of any complex.

#include "soup/Vertex_complex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

using namespace selvedge;

namespace {

using Faces = std::set<Index_triple>; // each in ascending order
using Edge = std::pair<Index, Index>;

constexpr Index s_vertices = 7;

std::map<Edge, std::size_t> edges_of(const Faces& faces)
{
  std::map<Edge, std::size_t> counts; // of faces
  for (const auto& [a, b, c] : faces)
    for (const Edge& edge : {Edge(a, b), Edge(a, c), Edge(b, c)})
      ++counts[edge];
  return counts;
}

// Returns the number of connected parts, and of vertices less edges.
std::pair<std::ptrdiff_t, std::ptrdiff_t> shape_of_graph(const std::vector<Edge>& edges)
{
  std::array<Index, s_vertices> part;
  std::iota(part.begin(), part.end(), Index(0));
  std::set<Index> vertices, parts;
  for (const auto& [a, b] : edges) {
    vertices.insert({a, b});
    std::replace(part.begin(), part.end(), Index(part[a]), Index(part[b]));
  }
  for (const Index v : vertices)
    parts.insert(part[v]);
  return {parts.size(), std::ptrdiff_t(vertices.size()) - std::ptrdiff_t(edges.size())};
}

// What no homeomorphism changes: the parts and the Euler characteristic of the complex, and for each number
// of faces but two, those of the edges that have so many.
std::vector<std::ptrdiff_t> topology_of(const Faces& faces)
{
  std::vector<Edge> all;
  std::map<std::size_t, std::vector<Edge>> lines;
  for (const auto& [edge, count] : edges_of(faces)) {
    all.push_back(edge);
    if (count != 2)
      lines[count].push_back(edge);
  }
  const auto [parts, euler] = shape_of_graph(all);
  std::vector<std::ptrdiff_t> result{parts, euler + std::ptrdiff_t(faces.size())};
  for (const auto& [count, edges] : lines) {
    const auto [parts_of_lines, euler_of_lines] = shape_of_graph(edges);
    result.insert(result.end(), {std::ptrdiff_t(count), parts_of_lines, euler_of_lines});
  }
  return result;
}

Faces contracted(const Faces& faces, Index v, Index goal)
{
  Faces result;
  for (Index_triple face : faces) {
    std::replace(face.begin(), face.end(), v, goal);
    std::sort(face.begin(), face.end());
    if (std::adjacent_find(face.begin(), face.end()) == face.end())
      result.insert(face);
  }
  return result;
}

} // namespace

TEST(Vertex_complex, KeepsTheTopologyWhereItContracts)
{
  std::mt19937 random(1);
  const auto below = [&](Index n) { return Index(random() % n); };
  std::size_t kept = 0, refused = 0, refused_with_reason = 0;
  for (int world = 0; world < 20000; ++world) {
    Faces faces;
    for (Index i = 0, count = 2 + below(9); i < count; ++i) {
      Index_triple face{below(s_vertices), below(s_vertices), below(s_vertices)};
      std::sort(face.begin(), face.end());
      if (std::adjacent_find(face.begin(), face.end()) == face.end())
        faces.insert(face);
    }
    for (const auto& [edge, count] : edges_of(faces)) {
      Vertex_complex complex;
      for (const auto& [a, b, c] : faces)
        complex.add(a, b, c);
      const bool is_topology_kept =
          topology_of(contracted(faces, edge.first, edge.second)) == topology_of(faces);
      if (complex.contract(edge.first, edge.second)) {
        ++kept;
        ASSERT_TRUE(is_topology_kept) << "world " << world << ", " << edge.first << " to " << edge.second;
      } else {
        ++refused;
        refused_with_reason += !is_topology_kept;
      }
    }
  }
  EXPECT_GT(kept, 1000u);
  EXPECT_GT(double(refused_with_reason), 0.5 * double(refused));
}

TEST(Vertex_complex, TellsInnerVerticesFromThoseOnLinesAndSingularOnes)
{
  Vertex_complex complex;
  EXPECT_EQ(complex.kind(0), Vertex_complex::Kind::singular);
  complex.add(0, 1, 2);
  complex.add(0, 2, 3);
  EXPECT_EQ(complex.kind(0), Vertex_complex::Kind::on_line);
  complex.add(0, 1, 3);
  EXPECT_EQ(complex.kind(0), Vertex_complex::Kind::inner);
  complex.add(0, 1, 4);
  EXPECT_EQ(complex.kind(0), Vertex_complex::Kind::singular); // a fin that ends there
  complex.add(0, 4, 2);
  EXPECT_EQ(complex.kind(0), Vertex_complex::Kind::on_line); // three half-discs
  complex.add(0, 5, 6);
  EXPECT_EQ(complex.kind(0), Vertex_complex::Kind::singular);
}

TEST(Vertex_complex, TakesAGoalWithOtherFacesForSingular)
{
  // Vertex 1 goes to 2 along the border of two faces, of which one goes. It may have a face beyond, too.
  const auto is_contracted = [](const std::vector<Index>& parts, bool is_singular) {
    Vertex_complex complex;
    complex.add(0, 1, 2);
    complex.add(0, 2, 3);
    if (is_singular)
      complex.add(1, 4, 5);
    for (const Index v : parts)
      complex.mark_as_part(v);
    return complex.contract(1, 2);
  };
  EXPECT_TRUE(is_contracted({}, false));
  EXPECT_TRUE(is_contracted({2}, false));
  EXPECT_FALSE(is_contracted({0, 2}, false)); // their edge may be on a line, as that from 0 to 1 is
  EXPECT_TRUE(is_contracted({}, true));
  EXPECT_FALSE(is_contracted({2}, true));
}
