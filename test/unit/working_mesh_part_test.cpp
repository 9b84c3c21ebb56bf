// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A part of a working mesh is what its whole is, wherever it has all faces.

#include "support/mesh_of.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <CGAL/boost/graph/helpers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

using Halfedge = Mesh::Halfedge_index;
using Vertex = Mesh::Vertex_index;

/// A soup, the mesh of it, and the rule of that.
struct Whole_mesh
{
  explicit Whole_mesh(Triangle_soup soup)
      : prepared(prepare(std::move(soup))),
        working(prepared.soup, prepared.positions, prepared.is_frozen, prepared.obstacle),
        rule(working.mesh(), Border_rule_options())
  {
    for (const auto edge : working.constraints().line_edges)
      rule.mark(edge);
    for (const auto spoke : working.constraints().spokes)
      rule.mark_at_target(spoke);
    for (const auto vertex : working.constraints().locked_vertices)
      rule.lock(vertex);
  }

  Prepared_soup prepared;
  Working_mesh working;
  Border_rule<Mesh> rule;
};

std::vector<Index> some_faces(std::size_t count, unsigned one_in, std::mt19937& random)
{
  std::vector<Index> faces;
  for (Index face = 0; face < count; ++face)
    if (random() % one_in != 0)
      faces.push_back(face);
  return faces;
}

void expect_is_part(const Whole_mesh& whole, const Working_mesh& part, const std::vector<Index>& faces)
{
  const Mesh& mesh = part.mesh();
  const Mesh& mesh_of_whole = whole.working.mesh();
  ASSERT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
  ASSERT_EQ(mesh.number_of_faces(), faces.size());
  std::vector<char> is_locked(mesh.number_of_vertices(), false), is_line(mesh.number_of_halfedges(), false);
  for (const Vertex v : part.constraints().locked_vertices)
    is_locked[v] = true;
  for (const auto e : part.constraints().line_edges)
    is_line[mesh.halfedge(e)] = is_line[mesh.opposite(mesh.halfedge(e))] = true;
  for (const Halfedge h : part.constraints().spokes)
    is_line[h] = true;
  std::map<Vertex, std::set<Vertex>> parts_of; // vertices here of one in the whole
  for (Index face = 0; face < faces.size(); ++face)
    for (unsigned char place = 0; place < 3; ++place) {
      const Halfedge here = part.halfedge({face, place, false});
      const Halfedge there = whole.working.halfedge({faces[face], place, false});
      ASSERT_EQ(mesh.point(mesh.target(here)), mesh_of_whole.point(mesh_of_whole.target(there)));
      parts_of[mesh_of_whole.target(there)].insert(mesh.target(here));
      const Halfedge across = mesh.opposite(here), across_there = mesh_of_whole.opposite(there);
      const Index beyond = mesh_of_whole.face(across_there);
      const bool is_beyond_here =
          !mesh_of_whole.is_border(across_there) && std::binary_search(faces.begin(), faces.end(), beyond);
      ASSERT_EQ(!mesh.is_border(across), is_beyond_here);
      if (!is_beyond_here)
        continue;
      ASSERT_EQ(faces[part.side(across).face], beyond);
      ASSERT_EQ(part.side(across).place, whole.working.side(across_there).place);
      ASSERT_EQ(bool(is_line[here]), whole.rule.is_line_at_target(there));
    }
  for (const auto& [there, here] : parts_of) {
    const auto around = mesh_of_whole.faces_around_target(mesh_of_whole.halfedge(there));
    const bool is_whole = std::all_of(around.begin(), around.end(), [&](Mesh::Face_index face) {
      return !mesh_of_whole.is_valid(face) || std::binary_search(faces.begin(), faces.end(), Index(face));
    });
    ASSERT_TRUE(here.size() == 1 || !is_whole);
    for (const Vertex v : here)
      ASSERT_EQ(bool(is_locked[v]), !is_whole || whole.rule.is_locked(there));
  }
  std::set<std::pair<Vertex, Vertex>> ends;
  for (const auto e : mesh.edges())
    ASSERT_TRUE(ends.insert(std::minmax(mesh.vertex(e, 0), mesh.vertex(e, 1))).second) << "parallel edges";
}

TEST(WorkingMeshPart, IsWhatTheWholeIsWhereItHasAllFaces)
{
  for (unsigned seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const Whole_mesh whole(seed % 4 == 0 ? with_own_uvs_at(sheet(12, 12), 84) : finned_sheet(12, seed));
    ASSERT_EQ(whole.working.constraints().spokes.empty(), seed % 4 != 0);
    const std::vector<Index> faces = some_faces(whole.prepared.soup.triangles.size(), 2 + seed % 20, random);
    const Working_mesh part(whole.working, whole.rule, faces);
    ASSERT_NO_FATAL_FAILURE(expect_is_part(whole, part, faces));
  }
}

// The control: where the whole is torn, the same triangles sewn by themselves need not be.
TEST(WorkingMeshPart, IsNotWhatItsTrianglesAreAlone)
{
  const Triangle_soup soup = finned_sheet(12, 1);
  const Whole_mesh whole(soup);
  std::size_t different = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    const std::vector<Index> faces = some_faces(soup.triangles.size(), 8, random);
    Triangle_soup alone;
    alone.points = soup.points;
    for (const Index face : faces)
      alone.triangles.push_back(soup.triangles[whole.working.triangle(Mesh::Face_index(face))]);
    const Working_mesh part(whole.working, whole.rule, faces);
    const Whole_mesh of_alone(std::move(alone));
    different += part.mesh().number_of_vertices() != of_alone.working.mesh().number_of_vertices();
  }
  EXPECT_EQ(different, 20u);
}

TEST(WorkingMeshPart, OfAllFacesIsTheWhole)
{
  const Whole_mesh whole(finned_sheet(12, 7));
  std::vector<Index> faces;
  for (Index face = 0; face < whole.prepared.soup.triangles.size(); ++face)
    faces.push_back(face);
  const Working_mesh part(whole.working, whole.rule, faces);
  EXPECT_EQ(part.result().corners, whole.working.result().corners);
  EXPECT_EQ(part.constraints().locked_vertices, whole.working.constraints().locked_vertices);
  EXPECT_EQ(part.constraints().line_edges, whole.working.constraints().line_edges);
}

// Faces are numbered by where they are, and the result has the triangles in the order in which they came.
TEST(WorkingMesh, NumbersFacesAlikeInWhateverOrderTheTrianglesCome)
{
  const Triangle_soup soup = skirt(1500);
  Triangle_soup shuffled = soup;
  std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), std::mt19937(1));
  const Whole_mesh one(soup), other(shuffled);
  const auto first_corner = [](const Whole_mesh& whole, Index face) {
    return whole.prepared.soup
        .points[whole.working.vertex_of(3 * whole.working.triangle(Mesh::Face_index(face)))];
  };
  const Index count = Index(soup.triangles.size());
  Index moved = 0;
  for (Index face = 0; face < count; ++face) {
    ASSERT_EQ(first_corner(one, face), first_corner(other, face));
    moved += one.working.triangle(Mesh::Face_index(face)) != face;
  }
  EXPECT_GT(moved, count / 2) << "the control: the skirt has its triangles in another order";
  EXPECT_EQ(other.working.result().soup.triangles, other.prepared.soup.triangles);
  const std::vector<Mesh::Face_index> face_of = other.working.faces_of_triangles();
  for (Index t = 0; t < count; ++t)
    ASSERT_EQ(other.working.triangle(face_of[t]), t);
}

} // namespace
} // namespace selvedge::test
