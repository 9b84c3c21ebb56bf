// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/normals.h>

#include "Disjoint_sets.h"
#include "Gltf_scene.h"
#include "inner_edges.h"
#include "number_positions.h"
#include "triangle_normals.h"

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace selvedge {
namespace {

constexpr double s_cosine_of_hard_edge = 0.5; // of 60°

// Gives blocks that have no normals a column for those of the result.
void add_normals_to_scene(Triangle_soup& soup)
{
  auto scene = std::make_shared<Gltf_scene>(*soup.scene);
  for (Gltf_scene::Block& block : scene->blocks) {
    if (block.normals())
      continue;
    Gltf_scene::Column normals = empty_column("NORMAL", type_float32, 3);
    normals.rows.resize(block.size * normals.row_size, '\0');
    block.attributes.push_back(std::move(normals));
  }
  soup.scene = std::move(scene);
}

} // namespace

void smooth_normals(Triangle_soup& soup)
{
  using shading::Vector;
  // Seams of the texture are no hard edges: triangles meet where they have positions in common.
  const std::vector<Index_triple> triples = in_positions(soup.triangles, number_positions(soup.points));
  std::vector<Vector> fronts;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    fronts.push_back(shading::unit_normal(soup, t));
  internal::Disjoint_sets fans(3 * triples.size()); // of corners
  internal::for_each_inner_edge(triples, [&](const internal::Edge_side& a, const internal::Edge_side& b) {
    const Vector &front = fronts[a.at_low / 3], &other = fronts[b.at_low / 3];
    if (front == Vector{} || other == Vector{} || internal::dot(front, other) >= s_cosine_of_hard_edge) {
      fans.unite(a.at_low, b.at_low);
      fans.unite(a.at_high, b.at_high);
    }
  });

  constexpr Index no_number = std::numeric_limits<Index>::max();
  std::vector<Index> numbers(3 * triples.size(), no_number); // of normals, by fan
  std::vector<Vector> normals;
  soup.normals = {{}, std::vector<Index_triple>(triples.size())};
  for (Index corner = 0; corner < 3 * triples.size(); ++corner) {
    Index& number = numbers[fans.find(corner)];
    if (number == no_number) {
      number = Index(normals.size());
      normals.push_back({});
    }
    soup.normals.of_triangle[corner / 3][corner % 3] = number;
    const double angle = shading::angle_at(soup, corner);
    for (std::size_t i = 0; i < 3; ++i)
      normals[number][i] += angle * fronts[corner / 3][i];
  }
  for (Vector& normal : normals)
    normal = shading::stored(shading::unit(normal));
  soup.normals.values = std::move(normals);
  if (soup.scene)
    add_normals_to_scene(soup);
}

} // namespace selvedge
