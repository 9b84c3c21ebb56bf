// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Real meshes and the nasty files that lie beside the checkout, where they do.

#include "support/Temporary_folder.h"

#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>
#include <selvedge/normals.h>

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace selvedge;

namespace {

namespace fs = std::filesystem;

struct Counts
{
  std::size_t faces, vertices;
  bool uvs;
};

const std::map<std::string, Counts> meshes = {
    {"garments/dress_14_pieces_uv.obj", {29456, 15656, true}},
    {"garments/multilayer_skirt.obj", {58687, 30464, false}},
    {"garments/multilayer_skirt_as_found.obj", {84159, 43275, false}},
    {"garments/avatar_in_suit_uv.obj", {40999, 20982, true}},
    {"scans/stanford_bunny.obj", {69451, 35947, false}},
    {"scans/spot.obj", {23062, 11533, false}}};

// The triangles, and the points of their vertices, numbered in the order in which triangles first use them.
std::pair<std::vector<Index_triple>, std::vector<Point_3>> in_order_of_use(const Triangle_soup& soup)
{
  std::map<Index, Index> numbers;
  std::pair<std::vector<Index_triple>, std::vector<Point_3>> result;
  for (Index_triple triangle : soup.triangles) {
    for (Index& v : triangle) {
      const auto [found, is_new] = numbers.emplace(v, Index(numbers.size()));
      if (is_new)
        result.second.push_back(soup.points[v]);
      v = found->second;
    }
    result.first.push_back(triangle);
  }
  return result;
}

TEST(SharedMeshes, HaveTheirCountsAndGoThroughEveryFormat)
{
  for (const auto& [name, counts] : meshes) {
    SCOPED_TRACE(name);
    const fs::path path = fs::path(SELVEDGE_SHARED_DATA) / name;
    if (!fs::exists(path))
      GTEST_SKIP() << "the real meshes are not here: " << path;
    const Triangle_soup soup = read_mesh(path).soup;
    EXPECT_EQ(soup.triangles.size(), counts.faces);
    EXPECT_EQ(soup.points.size(), counts.vertices);
    EXPECT_EQ(soup.uvs.of_triangle.size(), counts.uvs ? counts.faces : 0u);
    const test::Temporary_folder folder;
    for (const char* copy : {"m.obj", "m.off", "m.ply"}) {
      write_mesh(folder / copy, soup);
      const Triangle_soup found = read_mesh(folder / copy).soup;
      const auto [triangles, points] = in_order_of_use(found);
      const auto [expected_triangles, expected_points] = in_order_of_use(soup);
      EXPECT_EQ(triangles, expected_triangles) << copy;
      EXPECT_TRUE(points == expected_points) << copy;
      const bool is_split = copy == std::string("m.ply") && has_flat_normals(soup);
      EXPECT_EQ(found.points == soup.points, !is_split) << copy;
    }
  }
}

/// Faces read, or the line at which the file is refused, 0 for the whole file.
struct Outcome
{
  std::size_t triangles;
  int line = -1;
};

const std::map<std::string, Outcome> nasty = {{"all_same_point.obj", {1}},
                                              {"bowtie_vertex.obj", {2}},
                                              {"coincident_layers_unmerged.obj", {2}},
                                              {"collinear_face.obj", {3}},
                                              {"coplanar_overlap.obj", {2}},
                                              {"crlf_and_continuation.obj", {1}},
                                              {"crossing_triangles.obj", {2}},
                                              {"denormal_coords.obj", {2}},
                                              {"duplicate_face.obj", {3}},
                                              {"edge_touching_edge.obj", {2}},
                                              {"far_from_origin.obj", {2}},
                                              {"folded_over_180.obj", {2}},
                                              {"huge_coords.obj", {2}},
                                              {"inconsistent_orientation.obj", {2}},
                                              {"index_out_of_range.obj", {0, 4}},
                                              {"index_zero.obj", {0, 4}},
                                              {"inf_vertex.obj", {0, 4}},
                                              {"moebius.obj", {80}},
                                              {"nan_unreferenced.obj", {0, 4}},
                                              {"nan_vertex.obj", {0, 4}},
                                              {"negative_index.obj", {1}},
                                              {"nonmanifold_edge_fan3.obj", {3}},
                                              {"only_comment.obj", {0, 0}},
                                              {"only_vertices.obj", {0, 0}},
                                              {"opposite_duplicate_face.obj", {2}},
                                              {"quads_polygon.obj", {5}},
                                              {"repeated_index_face.obj", {2}},
                                              {"single_triangle.obj", {1}},
                                              {"t_junction.obj", {3}},
                                              {"two_vertex_face.obj", {1}},
                                              {"uv_seam_flip.obj", {2}},
                                              {"vertex_touching_face.obj", {2}},
                                              {"zero_bytes.obj", {0, 0}},
                                              {"zero_length_edge.obj", {2}}};

TEST(SharedNastyFiles, ComeOutAsListed)
{
  const fs::path folder = fs::path(SELVEDGE_SHARED_DATA) / "nasty";
  if (!fs::exists(folder))
    GTEST_SKIP() << "the nasty files are not here: " << folder;
  std::size_t seen = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    const auto listed = nasty.find(name);
    if (listed == nasty.end()) {
      ADD_FAILURE() << "is not listed";
      continue;
    }
    ++seen;
    try {
      EXPECT_EQ(read_mesh(entry.path()).soup.triangles.size(), listed->second.triangles);
    } catch (const Input_error& error) {
      const int line = listed->second.line;
      EXPECT_GE(line, 0) << error.what();
      const std::string start =
          entry.path().string() + ":" + (line > 0 ? std::to_string(line) + ":" : "") + " ";
      EXPECT_EQ(std::string(error.what()).rfind(start, 0), 0u) << error.what();
    }
  }
  EXPECT_EQ(seen, nasty.size());
}

} // namespace
