// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/drop_parts.h>

#include "Gltf_scene.h"
#include "material_textures.h"
#include "selection.h"
#include "surfaces_of.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/Surface_mesh_simplification/internal/mesh_diagonal.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace selvedge {
namespace {

struct Pieces
{
  std::vector<std::size_t> of_triangle;
  std::map<std::size_t, Sized_piece> pieces;
};

Pieces pieces_by_positions(const Triangle_soup& soup)
{
  Pieces result{surfaces_of(soup), {}};
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    Sized_piece& piece = result.pieces[result.of_triangle[t]];
    ++piece.triangles;
    for (const Index v : soup.triangles[t])
      piece.box += soup.points[v].bbox();
  }
  for (auto& [number, piece] : result.pieces)
    piece.size = internal::diagonal_of(piece.box);
  return result;
}

/// Removes the textures of a glTF scene that only materials of parts without a triangle show. `had_triangles`
/// says which parts had some.
void drop_textures_of_parts(Triangle_soup& soup, std::vector<char> had_triangles)
{
  for (const Index part : soup.groups.of_triangle)
    had_triangles[part] = false;
  const std::vector<Index> materials = materials_of(*soup.scene, had_triangles);
  if (materials.empty())
    return;
  auto scene = std::make_shared<Gltf_scene>(*soup.scene);
  drop_textures_of(*scene, materials);
  soup.scene = std::move(scene);
}

} // namespace

std::vector<Sized_piece> sized_pieces(const Triangle_soup& soup)
{
  std::vector<Sized_piece> result;
  for (const auto& [number, piece] : pieces_by_positions(soup).pieces)
    result.push_back(piece);
  std::stable_sort(result.begin(), result.end(),
                   [](const Sized_piece& a, const Sized_piece& b) { return a.size < b.size; });
  return result;
}

Parts_left drop_parts(Triangle_soup& soup, const Parts_to_drop& parts)
{
  if (!(parts.smaller_than >= 0))
    throw Argument_error("the size below which pieces are left out must be at least 0");
  std::vector<char> is_named(soup.triangles.size(), false);
  for (const std::string& name : parts.names) {
    const std::vector<char> is_of_part = triangles_named(soup, name);
    for (std::size_t t = 0; t < is_named.size(); ++t)
      is_named[t] |= is_of_part[t];
  }
  const Pieces pieces = parts.smaller_than > 0 ? pieces_by_positions(soup) : Pieces();
  Parts_left left;
  std::set<std::size_t> small_pieces;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    if (is_named[t]) {
      ++left.named;
    } else if (parts.smaller_than > 0 && pieces.pieces.at(pieces.of_triangle[t]).size < parts.smaller_than) {
      ++left.small;
      small_pieces.insert(pieces.of_triangle[t]);
    } else {
      left.triangles.push_back(t);
    }
  }
  left.small_pieces = small_pieces.size();
  if (left.triangles.empty() && !soup.triangles.empty())
    throw Input_error("no face would be left, for all belong to parts that are to be left out");
  if (left.triangles.size() == soup.triangles.size())
    return left;
  std::vector<char> has_triangles(soup.scene ? soup.scene->parts.size() : 0, false);
  for (std::size_t t = 0; t < soup.triangles.size() && soup.scene; ++t)
    has_triangles[soup.groups.of_triangle[t]] = true;
  keep_triangles(soup, left.triangles);
  if (soup.scene)
    drop_textures_of_parts(soup, std::move(has_triangles));
  return left;
}

} // namespace selvedge
