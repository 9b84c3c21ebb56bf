// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Wedges are the corners at a vertex that no line separates; the texture's displacement is known for each.

#include "soup/Sewn_mesh.h"
#include "soup/Value_wedges.h"
#include "soup/number_wedges.h"
#include "support/meshes.h"
#include "support/soups.h"

#include <selvedge/prepare.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

using Mesh = Corner_mesh::Mesh;

struct Sewn_soup
{
  explicit Sewn_soup(const Triangle_soup& soup)
      : prepared(prepare(soup)), mesh(prepared.soup, prepared.positions, prepared.is_frozen,
                                      prepared.obstacle, prepared.scale, prepared.is_turned, prepared.fronts)
  {
  }

  Prepared_soup prepared;
  Sewn_mesh mesh;
};

/// For every corner of a face, 3 × face + place, one that is the same for all that no line separates.
std::vector<Index> brute_force_wedges(const Sewn_mesh& sewn)
{
  const Mesh& mesh = sewn.mesh();
  std::vector<Index> wedges(3 * sewn.own_face_count());
  std::iota(wedges.begin(), wedges.end(), Index(0));
  const auto corner = [&](Mesh::Halfedge_index h) { return 3 * Index(mesh.face(h)) + sewn.place(h); };
  std::set<Mesh::Halfedge_index> lines(sewn.constraints().spokes.begin(), sewn.constraints().spokes.end());
  for (const auto e : sewn.constraints().line_edges)
    lines.insert({mesh.halfedge(e), mesh.opposite(mesh.halfedge(e))});
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (const auto h : mesh.halfedges()) {
      const auto other = mesh.opposite(h);
      if (mesh.is_border(h) || mesh.is_border(other) || lines.count(h) > 0)
        continue;
      Index &a = wedges[corner(h)], &b = wedges[corner(mesh.prev(other))];
      is_changed |= a != b;
      a = b = (std::min)(a, b);
    }
  }
  return wedges;
}

TEST(NumberWedges, AreTheCornersThatNoLineSeparates)
{
  std::size_t at_lines = 0;
  for (const Triangle_soup& soup : {skirt(4000), garment("jacket", 6000), sewn_pieces(800), moebius_band(),
                                    finned_sheet(8, 3), with_own_uvs_at(sheet(6, 6), 24)}) {
    const Sewn_soup sewn(soup);
    const std::vector<Index> expected = brute_force_wedges(sewn.mesh);
    const Wedge_numbers found = number_wedges(sewn.mesh, sewn.mesh.constraints());
    std::set<std::pair<Index, Index>> pairs;
    std::set<Index> wedges;
    for (const auto h : sewn.mesh.mesh().halfedges())
      if (!sewn.mesh.mesh().is_border(h)) {
        const auto face = sewn.mesh.mesh().face(h);
        const Index number = found.of_face[face][sewn.mesh.place(h)];
        pairs.emplace(number, expected[3 * Index(face) + sewn.mesh.place(h)]);
        wedges.insert(number);
        ASSERT_EQ(found.vertices.at(number), sewn.mesh.mesh().target(h));
      }
    EXPECT_EQ(pairs.size(), wedges.size());
    EXPECT_EQ(wedges.size(), found.vertices.size());
    std::set<Index> wanted;
    for (const auto& pair : pairs)
      wanted.insert(pair.second);
    EXPECT_EQ(wanted.size(), wedges.size());
    at_lines += wedges.size() - sewn.mesh.mesh().number_of_vertices();
  }
  EXPECT_GT(at_lines, 100U);
}

/// The soup with a texture that is bent, and more so beyond its first vertices.
Triangle_soup textured(Triangle_soup soup, Index first_vertices)
{
  for (Index v = 0; v < soup.points.size(); ++v) {
    const Point_3& p = soup.points[v];
    soup.uvs.values.push_back({p.x() + (v < first_vertices ? 0.5 : 2) * p.y() * p.y(), p.y()});
  }
  soup.uvs.of_triangle = soup.triangles;
  return soup;
}

/// The cost of the motion from one vertex of a flat sheet to another.
double cost_of_motion(const Triangle_soup& soup, const Point_3& from, const Point_3& to)
{
  const Sewn_soup sewn(soup);
  const Texture_wedges wedges(sewn.mesh, sewn.prepared.scale, sewn.mesh.constraints(), 1);
  const Mesh& mesh = sewn.mesh.mesh();
  for (const auto h : mesh.halfedges())
    if (sewn.prepared.scale.undone(mesh.point(mesh.source(h))) == from &&
        sewn.prepared.scale.undone(mesh.point(mesh.target(h))) == to)
      return wedges.cost(h);
  return -1;
}

TEST(TextureWedges, AMotionAlongASeamCostsWhatItCostsOnBothSides)
{
  const Triangle_soup sheet_left = sheet(2, 4), sheet_right = moved(sheet_left, 2, 0, 0);
  const Index count = Index(sheet_left.points.size());
  const Triangle_soup left = textured(sheet_left, count), right = textured(sheet_right, 0),
                      both = textured(joined(sheet_left, sheet_right), count);
  const Point_3 from(2, 2, 0), to(2, 3, 0);
  const double on_left = cost_of_motion(left, from, to), on_right = cost_of_motion(right, from, to);
  EXPECT_GT(on_left, 0);
  EXPECT_GT(on_right, 2 * on_left);
  EXPECT_DOUBLE_EQ(cost_of_motion(both, from, to), on_left + on_right);
}

TEST(TextureWedges, AMotionAwayFromASeamCostsWhatItCostsOnItsSide)
{
  const Triangle_soup sheet_left = sheet(2, 4), sheet_right = moved(sheet_left, 2, 0, 0);
  const Index count = Index(sheet_left.points.size());
  const Point_3 from(2, 2, 0), to(3, 3, 0);
  const double on_right = cost_of_motion(textured(sheet_right, 0), from, to);
  EXPECT_GT(on_right, 0);
  EXPECT_EQ(cost_of_motion(textured(joined(sheet_left, sheet_right), count), from, to), on_right);
}

} // namespace
} // namespace selvedge::test
