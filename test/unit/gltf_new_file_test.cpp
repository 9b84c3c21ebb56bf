// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// glTF files of meshes from other formats, and the other way round.

#include "support/Gltf_document.h"
#include "support/Temporary_folder.h"

#include "soup/selection.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/mesh_files.h>
#include <selvedge/rounding.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

TEST(Gltf, NewFileFromAnotherFormat)
{
  const Temporary_folder folder;
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\nvt 0 0\nvt 1 0\nvt 0.25 1\nvt 0.5 0.75\nvn 0 0 1\n"
      "g body\nusemtl denim\nf 1/1/1 2/2/1 3/3/1\nusemtl silk\nf 3/4/1 2/2/1 4/1/1\n"
      "g sleeve\nf 1 4 2\n";
  const Mesh_file file = read_mesh(obj, Mesh_format::obj, "test");
  EXPECT_TRUE(needs_float32(file.soup, Mesh_format::glb));
  write_mesh(folder / "a.glb", file.soup);
  const Mesh_file again = read_mesh(folder / "a.glb");
  ASSERT_EQ(again.soup.triangles.size(), 3u);
  EXPECT_EQ(again.soup.groups.names, (std::vector<std::string>{"body/0", "body/1", "sleeve"}));
  EXPECT_EQ(again.soup.materials.names, (std::vector<std::string>{"denim", "silk"}));
  for (std::size_t t = 0; t < 3; ++t) {
    EXPECT_EQ(again.soup.materials.names[again.soup.materials.of_triangle[t]],
              file.soup.materials.names[file.soup.materials.of_triangle[t]]);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(again.soup.points[again.soup.triangles[t][k]], file.soup.points[file.soup.triangles[t][k]]);
      if (t < 2) {
        EXPECT_EQ(again.soup.uvs.values[again.soup.uvs.of_triangle[t][k]],
                  file.soup.uvs.values[file.soup.uvs.of_triangle[t][k]]);
        EXPECT_EQ(again.soup.normals.values[again.soup.normals.of_triangle[t][k]],
                  (std::array<double, 3>{0, 0, 1}));
      } else {
        EXPECT_EQ(again.soup.uvs.of_triangle[t][k], again.soup.uvs.missing);
      }
    }
  }
  Triangle_soup fine = file.soup;
  fine.points[0] = Point_3(0.1, 0, 0);
  EXPECT_THROW(write_mesh(folder / "b.glb", fine), Argument_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "b.glb"));
}

Triangle_soup square()
{
  Triangle_soup soup;
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
    soup.points.emplace_back(x, y, 0);
  soup.triangles = {{0, 1, 2}, {0, 2, 3}};
  return soup;
}

TEST(Gltf, NewFileHasANodeForEachObjectWhereThereAreNoGroups)
{
  const Temporary_folder folder;
  Triangle_soup soup = square();
  soup.objects.names = {"left", "right"};
  soup.objects.of_triangle = {0, 1};
  EXPECT_TRUE(not_carried(soup, Mesh_format::glb).empty());
  write_mesh(folder / "a.glb", soup);
  EXPECT_EQ(triangles_named(read_mesh(folder / "a.glb").soup, "right"), (std::vector<char>{0, 1}));
  soup.groups.names = {"all"};
  soup.groups.of_triangle = {0, 0};
  EXPECT_EQ(not_carried(soup, Mesh_format::glb), std::vector<std::string>{"objects"});
}

TEST(Gltf, NewFileMendsNamesThatAreNoUtf8)
{
  const Temporary_folder folder;
  Triangle_soup soup = square();
  soup.groups.names = {"\xc4rmel"};
  soup.groups.of_triangle = {0, 0};
  for (const char* const name : {"a.glb", "a.gltf"}) {
    write_mesh(folder / name, soup);
    EXPECT_EQ(triangles_named(read_mesh(folder / name).soup, "\xef\xbf\xbdrmel"), std::vector<char>(2, 1));
  }
}

TEST(Gltf, VerticesOfNoFaceMayBeTooLargeForFloats)
{
  const Temporary_folder folder;
  Triangle_soup soup = square();
  soup.points.emplace_back(1e300, 0.1, 0);
  round_to_float32(soup);
  write_mesh(folder / "a.stl", selected(soup, {0}, {{0, 1, 2}}));
  EXPECT_EQ(read_mesh(folder / "a.stl").soup.triangles.size(), 1u);
  soup.triangles.push_back({0, 1, 4});
  EXPECT_THROW(round_to_float32(soup), Input_error);
}

TEST(Gltf, AMeshWithoutTrianglesIsRefused)
{
  const Temporary_folder folder;
  EXPECT_THROW(write_mesh(folder / "a.glb", Triangle_soup()), Argument_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
}

TEST(Gltf, NewFileSplitsVerticesOnlyWhereCornersDiffer)
{
  // Some exporters write texture coordinates for every corner, the same ones again and again.
  const Temporary_folder folder;
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\nvt 0 0\nvt 1 0\nvt 0 1\nvt 0 1\nvt 1 0\nvt 1 1\nvt 0.5 0.5\n";
  write_mesh(folder / "a.glb",
             read_mesh(obj + "f 1/1 2/2 3/3\nf 3/4 2/5 4/6\n", Mesh_format::obj, "test").soup);
  EXPECT_EQ(read_mesh(folder / "a.glb").soup.points.size(), 4u);
  write_mesh(folder / "a.glb",
             read_mesh(obj + "f 1/1 2/2 3/3\nf 3/7 2/5 4/6\n", Mesh_format::obj, "test").soup);
  EXPECT_EQ(read_mesh(folder / "a.glb").soup.points.size(), 5u);
}

// Some programs count colours from 0 to 255 in OBJ, and as whole numbers of 32 bits in PLY.
TEST(Gltf, NewFileHasColoursFromZeroToOne)
{
  const Temporary_folder folder;
  const auto written_of = [&](const std::string& text, Mesh_format format) {
    write_mesh(folder / "a.glb", read_mesh(text, format, "test").soup);
    std::vector<float> numbers;
    for (const Attribute& colour : read_mesh(folder / "a.glb").soup.vertex_attributes)
      for (std::size_t v = 0; v < 2; ++v) {
        float number;
        std::memcpy(&number, colour.rows.data() + v * sizeof number, sizeof number);
        numbers.push_back(number);
      }
    return numbers;
  };
  const auto written = [&](const std::string& first, const std::string& second) {
    return written_of("v 0 0 0 " + first + "\nv 1 0 0 " + second + "\nv 0 1 0 0 0 0\nf 1 2 3\n",
                      Mesh_format::obj);
  };
  using Numbers = std::vector<float>; // red of both vertices, then green and blue
  EXPECT_EQ(written("1 0.25 0.5", "0 1 0"), (Numbers{1, 0, 0.25f, 1, 0.5f, 0}));
  EXPECT_EQ(written("51 255 0", "1 2 102"), (Numbers{0.2f, float(1 / 255.), 1, float(2 / 255.), 0, 0.4f}));
  EXPECT_EQ(written("1.25 0.5 -0.5", "0 0 0"), (Numbers{1, 0, 0.5f, 0, 0, 0}));
  EXPECT_EQ(written("500 0.5 0", "0 0 0"), (Numbers{1, 0, 0.5f, 0, 0, 0}));
  EXPECT_EQ(
      written_of(
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
          "property float red\nproperty float green\nproperty float blue\nproperty float alpha\n"
          "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
          "0 0 0 51 0 0 0.5\n1 0 0 255 0 0 1\n0 1 0 0 0 0 1\n3 0 1 2\n",
          Mesh_format::ply),
      (Numbers{0.2f, 1, 0, 0, 0, 0, 0.5f, 1}));
}

TEST(Gltf, OtherFormatsHoldWorldPositions)
{
  const Temporary_folder folder;
  const Mesh_file file = read_glb(everything());
  for (const char* name : {"a.obj", "a.ply"}) {
    write_mesh(folder / name, file.soup);
    const Mesh_file again = read_mesh(folder / name);
    EXPECT_EQ(again.soup.points, file.soup.points) << name;
    EXPECT_EQ(again.soup.triangles, file.soup.triangles) << name;
    EXPECT_FALSE(again.soup.uvs.empty()) << name;
    const std::vector<std::string> lost = not_carried(file.soup, mesh_format(name));
    for (const char* what : {"skins", "morph targets", "animations", "images", "nodes and their transforms"})
      EXPECT_EQ(std::count(lost.begin(), lost.end(), what), 1) << what;
  }
}

} // namespace
} // namespace selvedge::test
