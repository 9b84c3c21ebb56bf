// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "progressive/lists.h"

#include "soup/flat_shading.h"
#include "soup/poles.h"
#include "soup/selection.h"

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>

#include <algorithm>
#include <functional>

namespace selvedge {

std::size_t steps_to_faces(const Progressive_mesh& mesh, std::size_t faces)
{
  const auto first = std::lower_bound(mesh.faces.begin(), mesh.faces.end(), faces, std::greater<>());
  return std::min(std::size_t(first - mesh.faces.begin()), mesh.step_count());
}

std::size_t faces_at_ratio(const Progressive_mesh& mesh, double ratio)
{
  return mesh.fixed_faces + Face_ratio_stop::face_target(ratio, mesh.faces.front() - mesh.fixed_faces);
}

std::vector<Index> progressive::vertices_after(const Progressive_mesh& mesh, std::size_t steps)
{
  std::vector<Index> now(mesh.steps.size()); // vertices go to others before them, which are known by then
  for (Index v = 0; v < now.size(); ++v)
    now[v] = mesh.steps[v] <= steps && mesh.merges_into[v] != v ? now[mesh.merges_into[v]] : v;
  return now;
}

Triangle_soup level(const Progressive_mesh& mesh, std::size_t steps)
{
  const Triangle_soup& soup = mesh.soup;
  const std::vector<Index> now = progressive::vertices_after(mesh, steps);
  std::vector<Index> corner_of(now.size()); // any that the vertex has in the finest mesh
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (Index k = 0; k < 3; ++k)
      corner_of[soup.triangles[t][k]] = 3 * t + k;
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    const Index_triple moved = {now[a], now[b], now[c]};
    if (moved[0] == moved[1] || moved[1] == moved[2] || moved[2] == moved[0])
      continue;
    triangles.push_back(t);
    corners.push_back({corner_of[moved[0]], corner_of[moved[1]], corner_of[moved[2]]});
  }
  if (triangles.size() != mesh.faces[steps])
    throw Input_error("the level has " + std::to_string(triangles.size()) + " faces, and the list says " +
                      std::to_string(mesh.faces[steps]) + "; make the progressive file again");
  Triangle_soup result = selected(soup, triangles, corners);
  // As `read_mesh` does. In poses, vertices may differ in one of them.
  if (result.poses.empty()) {
    share_split_vertices(result);
    share_poles(result);
  }
  return result;
}

} // namespace selvedge
