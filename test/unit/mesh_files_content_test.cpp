// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What the readers make of what stands in a file.

#include "support/Temporary_folder.h"

#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <random>
#include <set>
#include <string>

using namespace selvedge;
using Triangles = std::vector<Index_triple>;

namespace {

Mesh_file read_obj(const std::string& contents)
{
  return read_mesh(contents, Mesh_format::obj, "text");
}

// Numbers

TEST(ObjNumbers, AreTheNearestDoubles)
{
  const auto first =
      read_obj("v 0.1 9007199254740993 -0\n" // the second lies between two doubles
               "v 2.4703282292062327208e-324 2.4703282292062328e-324 -1e-400\n" // about half of the least
               "v 179769313486231580793e288 1e23 .5\n"
               "f 1 2 3\n")
          .soup.points;
  EXPECT_EQ(first[0], Point_3(0.1, 9007199254740992.0, 0));
  EXPECT_TRUE(std::signbit(first[0].z()));
  EXPECT_EQ(first[1].x(), 0);
  EXPECT_EQ(first[1].y(), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(first[1].z(), 0);
  EXPECT_TRUE(std::signbit(first[1].z()));
  EXPECT_EQ(first[2], Point_3(std::numeric_limits<double>::max(), 1e23, 0.5));
}

// Attributes

TEST(ObjTextureCoordinates, FollowTheCorners)
{
  const Mesh_file file = read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                  "vt 0.25\nvt 0.5 1\nvt 1 1 0\nvt 0 0.5\nvn 0 0 1\n"
                                  "f 1/4/1 2/3/1 3/2/1 4/1/1\nf 1/-1 2/-2 3/-4\n");
  EXPECT_EQ(file.soup.uvs.values,
            (std::vector<std::array<double, 2>>{{0.25, 0}, {0.5, 1}, {1, 1}, {0, 0.5}}));
  EXPECT_EQ(file.soup.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
  EXPECT_EQ(file.soup.uvs.of_triangle, (Triangles{{3, 2, 1}, {3, 1, 0}, {3, 2, 0}}));
}

TEST(ObjTextureCoordinates, AreMissingWhereAFaceHasNotAll)
{
  const Mesh_file file = read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1 2 3\nf 1/1 2/1 3/1\nf 1/1 2 3/1\n");
  EXPECT_EQ(file.soup.uvs.of_triangle, (Triangles{{1, 1, 1}, {0, 0, 0}, {1, 1, 1}}));
  EXPECT_EQ(file.soup.uvs.missing, Index(1));
  ASSERT_EQ(file.soup.uvs.values.size(), 2u);
  EXPECT_NE(file.soup.uvs.values[0], file.soup.uvs.values[1]);
  EXPECT_EQ(file.notes.ignored.size(), 1u);
}

TEST(ObjTextureCoordinates, OfNoFaceAreLikeNoOthers)
{
  std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  const int taken = 300000;
  for (int i = taken; i > 0; --i) // all that would be tried before the one that is free
    text += "vt " + std::to_string(-i % taken) + " -0\n";
  const Corner_values<2> uvs = read_obj(text + "vt 0.5 0\nvt 0 1\nf 1 2 3\nf 1/1 2/2 3/3\n").soup.uvs;
  ASSERT_TRUE(uvs.missing);
  EXPECT_EQ(uvs.of_triangle[0], (Index_triple{*uvs.missing, *uvs.missing, *uvs.missing}));
  EXPECT_EQ(std::count(uvs.values.begin(), uvs.values.end(), uvs.values[*uvs.missing]), 1);
}

// One number behind a position is a weight, so that no part of a colour may stand there alone.
TEST(ObjColours, AreWrittenWhereAVertexHasAllOfThem)
{
  const std::string text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                           "property float z\nproperty float red\nproperty float green\nproperty float blue\n"
                           "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const test::Temporary_folder folder;
  const std::filesystem::path path = folder.path() / "mesh.obj";
  const auto with_colours = [&](const std::string& second) {
    return read_mesh(text + "0 0 0 0.25 0.5 1\n1 0 0 " + second + "\n0 1 0 nan nan nan\n3 0 1 2\n",
                     Mesh_format::ply, "text")
        .soup;
  };
  for (const char* const second : {"0.5 0.75 nan", "0.5 nan nan", "0.5 nan 1", "nan 0.5 1"}) {
    const Triangle_soup soup = with_colours(second);
    EXPECT_FALSE(not_carried(soup, Mesh_format::obj).empty()) << second;
    write_mesh(path, soup);
    const Triangle_soup again = read_mesh(path).soup;
    EXPECT_EQ(again.vertex_attributes.size(), 3u) << second;
    EXPECT_TRUE(not_carried(again, Mesh_format::obj).empty()) << second;
  }
}

TEST(ObjNormals, FollowTheCorners)
{
  const Mesh_file file = read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvn 0 0.1 1\nf 1//1 2//-1 3//-2\n");
  EXPECT_EQ(file.soup.normals.values, (std::vector<std::array<double, 3>>{{0, 0, 1}, {0, 0.1, 1}}));
  EXPECT_EQ(file.soup.normals.of_triangle, (Triangles{{0, 1, 0}}));
  EXPECT_FALSE(file.soup.normals.missing);
}

TEST(ObjLabels, AreNamesAsTheyStandInTheFile)
{
  const Triangle_soup soup =
      read_obj("mtllib my wool.mtl\r\nmtllib a.mtl b.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"
               "o  body  left\nusemtl wool (2) #3\ns 1\nf 1 2 3\ns off\ng a \\\n b\nf 1 2 3\ng\nf 1 2 3\n")
          .soup;
  EXPECT_EQ(soup.material_libraries, (std::vector<std::string>{"my wool.mtl", "a.mtl b.mtl"}));
  const auto expect = [](const Triangle_labels& labels, const std::vector<std::string>& of_triangle) {
    std::vector<std::string> found;
    for (const Index label : labels.of_triangle)
      found.push_back(labels.names.at(label));
    EXPECT_EQ(found, of_triangle);
  };
  expect(soup.objects, {"", "body  left", "body  left", "body  left"});
  expect(soup.materials, {"", "wool (2) #3", "wool (2) #3", "wool (2) #3"});
  expect(soup.smoothing_groups, {"", "1", "off", "off"});
  expect(soup.groups, {"", "", "a   b", ""});
}

TEST(ObjGroups, AreTheLatestGroupAboveTheFace)
{
  const Mesh_file file =
      read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
               "f 1 2 3\no coat\nf 1 2 3 4\ng  left sleeve \nf 1 2 3\ng\nf 1 3 4\ng left sleeve\nf 1 2 4\n");
  EXPECT_EQ(file.soup.groups.names, (std::vector<std::string>{"", "left sleeve"}));
  EXPECT_EQ(file.soup.groups.of_triangle, (std::vector<Index>{0, 0, 0, 1, 0, 1}));
  EXPECT_EQ(file.soup.objects.names, (std::vector<std::string>{"", "coat"}));
  EXPECT_EQ(file.soup.objects.of_triangle, (std::vector<Index>{0, 1, 1, 1, 1, 1}));
  EXPECT_TRUE(read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").soup.groups.of_triangle.empty());
}

// Polygons

std::string polygon_obj(const std::vector<std::array<double, 2>>& corners, int view)
{
  std::string text, face = "f";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::array<double, 3> p = {};
    p[(view + 1) % 3] = corners[i][0];
    p[(view + 2) % 3] = corners[i][1];
    p[view] = 1;
    text += "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
    face += " " + std::to_string(i + 1);
  }
  return text + face + "\n";
}

/// Checks that the triangles of a simple counter-clockwise polygon all turn its way and fill its area
/// exactly, which leaves them no room for an overlap; and that those of its mirror image are the same.
void expect_exact_cut(const std::vector<std::array<double, 2>>& corners, int view)
{
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  const Triangle_soup soup = read_obj(polygon_obj(corners, view)).soup;
  ASSERT_EQ(soup.triangles.size(), corners.size() - 2);
  const auto at = [&](Index i) { return Exact::Point_2(corners[i][0], corners[i][1]); };
  Exact::FT twice_area = 0, sum = 0;
  for (Index i = 1; i + 1 < corners.size(); ++i)
    twice_area += CGAL::determinant(at(i) - at(0), at(i + 1) - at(0));
  for (const auto& [a, b, c] : soup.triangles) {
    EXPECT_EQ(CGAL::orientation(at(a), at(b), at(c)), CGAL::LEFT_TURN);
    sum += CGAL::determinant(at(b) - at(a), at(c) - at(a));
  }
  EXPECT_TRUE(twice_area == sum);
  std::vector<std::array<double, 2>> mirrored;
  for (const auto& [x, y] : corners)
    mirrored.push_back({-x, y});
  EXPECT_EQ(read_obj(polygon_obj(mirrored, view)).soup.triangles, soup.triangles);
}

TEST(Polygons, ConvexOneIsTheFanOfItsFirstCorner)
{
  const std::vector<std::array<double, 2>> hexagon = {{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}, {-1, 1}};
  for (int view = 0; view < 3; ++view)
    EXPECT_EQ(read_obj(polygon_obj(hexagon, view)).soup.triangles,
              (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}));
}

TEST(Polygons, ConcaveOneIsCutWithoutOverlap)
{
  std::vector<std::array<double, 2>> arrow = {{0, 0}, {4, 0}, {1, 1}, {0, 4}};
  std::vector<std::array<double, 2>> comb = {{0, 0}, {7, 0}, {7, 3}, {6, 3}, {6, 1}, {5, 1},
                                             {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 3}, {0, 3}};
  std::vector<std::array<double, 2>> straight = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {2, 3}, {0, 3}};
  for (auto* corners : {&arrow, &comb, &straight})
    for (std::size_t turn = 0; turn < corners->size(); ++turn) {
      SCOPED_TRACE(turn);
      for (int view = 0; view < 3; ++view)
        expect_exact_cut(*corners, view);
      std::rotate(corners->begin(), corners->begin() + 1, corners->end());
    }
}

TEST(Polygons, RandomStarsAreCutWithoutOverlap)
{
  constexpr unsigned seed = 11;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> radius(1, 9), corners(4, 40), many_corners(200, 400);
  for (int round = 0; round < 300; ++round) {
    std::vector<std::array<double, 2>> star;
    const int size = round % 10 == 0 ? many_corners(random) : corners(random);
    for (int i = 0; i < size; ++i) {
      const double angle = 2 * CGAL_PI * i / size;
      const int r = radius(random);
      // Rounded to what polygon_obj writes.
      star.push_back({std::round(1000 * r * std::cos(angle)), std::round(1000 * r * std::sin(angle))});
    }
    expect_exact_cut(star, round % 3);
  }
}

TEST(Polygons, WithoutACutTheyAreTheFan)
{
  // A bow tie, a needle and a point have no area to cut; they are kept all the same.
  for (const char* points : {"v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\n", "v 0 0 0\nv 1 1 1\nv 2 2 2\nv 3 3 3\n",
                             "v 1 1 1\nv 1 1 1\nv 1 1 1\nv 1 1 1\n"})
    EXPECT_EQ(read_obj(points + std::string("f 1 2 3 4\n")).soup.triangles,
              (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

// Formats

TEST(Stl, VerticesAreNumberedByTheirFirstCorner)
{
  const Mesh_file file =
      read_mesh("solid\nfacet normal 0 0 0\nouter loop\nvertex 5 0 -0\nvertex 1 0 0\nvertex 0 1 0\n"
                "endloop\nendfacet\nfacet normal 0 0 0\nouter loop\nvertex 0 1 -0\nvertex 7 7 7\n"
                "vertex 5 0 0\nendloop\nendfacet\nendsolid\n",
                Mesh_format::stl, "text");
  EXPECT_EQ(file.soup.points,
            (std::vector<Point_3>{Point_3(5, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(7, 7, 7)}));
  EXPECT_TRUE(std::signbit(file.soup.points[0].z()));
  EXPECT_EQ(file.soup.triangles, (Triangles{{0, 1, 2}, {2, 3, 0}}));
}

// Two sheets of 8 × 8 squares, one above the other, in which every face has vertices of its own.
std::string sheets_of_separate_faces(bool is_of_quads)
{
  std::string vertices, faces;
  int next = 1;
  const auto add = [&](std::initializer_list<std::array<int, 2>> corners, int height) {
    faces += "f";
    for (const auto& [x, y] : corners) {
      vertices += "v " + std::to_string(x) + ' ' + std::to_string(y) + ' ' + std::to_string(height) + '\n';
      faces += ' ' + std::to_string(next++);
    }
    faces += '\n';
  };
  for (int height = 0; height < 2; ++height)
    for (int x = 0; x < 8; ++x)
      for (int y = 0; y < 8; ++y)
        if (is_of_quads) {
          add({{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}, height);
        } else {
          add({{x, y}, {x + 1, y}, {x + 1, y + 1}}, height);
          add({{x, y}, {x + 1, y + 1}, {x, y + 1}}, height);
        }
  return vertices + faces;
}

TEST(Separate_faces, AreConnectedWhereNoTwoShareAVertex)
{
  for (const bool is_of_quads : {false, true}) {
    const Mesh_file file = read_obj(sheets_of_separate_faces(is_of_quads));
    const Triangle_soup& soup = file.soup;
    EXPECT_EQ(soup.points.size(), is_of_quads ? 512u : 768u) << "vertices keep their numbers";
    std::set<Index> used;
    for (const Index_triple& triangle : soup.triangles)
      used.insert(triangle.begin(), triangle.end());
    EXPECT_EQ(used.size(), 2 * 81u);
    EXPECT_EQ(file.notes.remarks.size(), 1u);
  }
}

TEST(Separate_faces, StaySoWhereTheyAreFewOrTwoShareAVertex)
{
  const std::string shared = sheets_of_separate_faces(false) + "f 1 2 5\n";
  EXPECT_EQ(read_obj(shared).soup.triangles[1], (Index_triple{3, 4, 5}));
  EXPECT_TRUE(read_obj(shared).notes.remarks.empty());
  const std::string few = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n";
  EXPECT_EQ(read_obj(few).soup.triangles[1], (Index_triple{3, 4, 5}));
}

TEST(Ply, EveryTypeOfNumberIsRead)
{
  const std::pair<const char*, std::size_t> types[] = {{"char", 1},   {"uint8", 1}, {"short", 2},
                                                       {"ushort", 2}, {"int32", 4}, {"uint", 4}};
  for (const bool big_endian : {false, true})
    for (const auto& [type, size] : types) {
      SCOPED_TRACE(type);
      const auto number = [big_endian, bytes = size](char value) {
        std::string text(bytes, '\0');
        text[big_endian ? bytes - 1 : 0] = value;
        return text;
      };
      const std::string name = type;
      std::string text = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                         "_endian 1.0\nelement vertex 3\nproperty " + name + " x\nproperty " + name +
                         " y\nproperty " + name + " z\nproperty list " + name + " " + name +
                         " skipped\nelement face 1\nproperty list " + name + " " + name +
                         " vertex_index\nend_header\n";
      for (const char value : {5, 0, 0, 1, 99, 0, 100, 0, 0, 0, 0, 100, 2, 98, 97, 3, 2, 0, 1})
        text += number(value);
      const Mesh_file file = read_mesh(text, Mesh_format::ply, "bytes");
      EXPECT_EQ(file.soup.points,
                (std::vector<Point_3>{Point_3(5, 0, 0), Point_3(0, 100, 0), Point_3(0, 0, 100)}));
      EXPECT_EQ(file.soup.triangles, (Triangles{{2, 0, 1}}));
      EXPECT_EQ(file.notes.ignored.size(), 1u);
    }
}

// Two strips, the second of which begins with a corner that is repeated.
TEST(Ply, StripsAreTriangles)
{
  const Mesh_file file = read_mesh(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n10 0 1 2 3 4 -1 4 4 3 2\n",
      Mesh_format::ply, "text");
  EXPECT_EQ(file.soup.triangles, (Triangles{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {3, 4, 2}}));
}

// What follows the announced values on a line is passed where every row has a line of its own, and only
// there.
TEST(Ply, RowsMayBeLongerThanTheHeaderSays)
{
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n";
  const Mesh_file longer = read_mesh(header + "0 1 0 7\n3 0 1 2 9 1 1\n3 0 2 1\n", Mesh_format::ply, "text");
  EXPECT_EQ(longer.soup.triangles, (Triangles{{0, 1, 2}, {0, 2, 1}}));
  EXPECT_EQ(longer.notes.ignored.size(), 1u);
  const Mesh_file on_one_line = read_mesh(header + "0 1 0 3 0 1 2\n3 0 2 1\n", Mesh_format::ply, "text");
  EXPECT_EQ(on_one_line.soup.triangles, longer.soup.triangles);
  EXPECT_TRUE(on_one_line.notes.ignored.empty());
}

TEST(Off, LinesOfFacesMayBeBroken)
{
  const Mesh_file file =
      read_mesh("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 \n1 2\n3\n0 2 3\n", Mesh_format::off, "text");
  EXPECT_EQ(file.soup.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Line_ends, MayBeCarriageReturnsAlone)
{
  const auto write = [](auto... numbers) {
    std::string bytes;
    const auto append = [&](auto number) {
      bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    };
    (append(numbers), ...);
    return bytes;
  };
  const std::string header = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                             "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  // The first coordinate has bytes that are line ends in text.
  const std::uint32_t bits = 0x3f0a0d0a;
  float odd;
  std::memcpy(&odd, &bits, sizeof odd);
  const std::string body = write(odd, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, std::uint8_t(3), 0, 1, 2);
  const std::string rows = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  struct File
  {
    Mesh_format format;
    std::string text, body;
  };
  const std::vector<File> files = {
      {Mesh_format::obj, "# comment\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng left \\\n sleeve\nf 1 2 3\n", ""},
      {Mesh_format::off, "OFF\n# comment\n3 1 0\n" + rows, ""},
      {Mesh_format::ply, "ply\nformat ascii 1.0\n" + header + rows, ""},
      {Mesh_format::ply, "ply\nformat binary_little_endian 1.0\n" + header, body},
      {Mesh_format::stl,
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
       "0\nendloop\nendfacet\n"
       "endsolid a\n",
       ""}};
  for (const File& file : files) {
    std::string old = file.text;
    std::replace(old.begin(), old.end(), '\n', '\r');
    const Triangle_soup expected = read_mesh(file.text + file.body, file.format, "text").soup;
    const Triangle_soup found = read_mesh(old + file.body, file.format, "text").soup;
    EXPECT_EQ(found.points, expected.points) << file.text;
    EXPECT_EQ(found.triangles, expected.triangles) << file.text;
    EXPECT_EQ(found.triangles.size(), 1u);
    EXPECT_EQ(found.groups.names, expected.groups.names);
  }
}

TEST(Line_ends, OfDamagedFilesAreCountedLikeOthers)
{
  try {
    read_obj("v 0 0 0\rv 1 0 0\rv 0 1 zero\r");
    FAIL() << "a word was read as a number";
  } catch (const Input_error& error) {
    EXPECT_STREQ(error.what(), "text:3: 'zero' is not a number");
  }
}

TEST(Ply, ValuesBeyondTheDoublesKeepTheirSign)
{
  const Mesh_file file = read_mesh(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
      "property double heat\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 1e999\n4 0 0 -1e999\n0 4 0 -1e-999\n3 0 1 2\n",
      Mesh_format::ply, "text");
  const std::vector<Attribute>& attributes = file.soup.vertex_attributes;
  ASSERT_EQ(attributes.size(), 1u);
  std::array<double, 3> heat;
  ASSERT_EQ(attributes[0].rows.size(), sizeof heat);
  std::memcpy(heat.data(), attributes[0].rows.data(), sizeof heat);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(heat, (std::array<double, 3>{infinity, -infinity, 0}));
}

TEST(Formats, AreNamedByTheExtensionInAnyCase)
{
  EXPECT_EQ(mesh_format("a/b.c/D.OBJ"), Mesh_format::obj);
  EXPECT_EQ(mesh_format("x.Off"), Mesh_format::off);
  EXPECT_EQ(mesh_format("x.y.ply"), Mesh_format::ply);
  EXPECT_EQ(mesh_format("x.stL"), Mesh_format::stl);
  EXPECT_EQ(mesh_format("x.Vrm"), Mesh_format::glb);
  for (const char* path : {"obj", ".obj", "x.", "x.fbx", "", "x.obj/y", "x.obj "})
    EXPECT_THROW(mesh_format(path), Input_error) << path;
}

// Paths

TEST(Paths, ThatAreNoFilesAreRefused)
{
  const test::Temporary_folder folder;
  std::filesystem::create_directory(folder / "folder.obj");
  std::filesystem::create_symlink("nowhere.obj", folder / "dangling.obj");
  std::filesystem::create_symlink("loop.obj", folder / "loop.obj");
  write_file(folder / "empty.obj", "");
  for (const char* name :
       {"folder.obj", "dangling.obj", "loop.obj", "missing.obj", "empty.obj", "nowhere/x.obj"})
    try {
      read_mesh(folder / name);
      ADD_FAILURE() << name << " was read";
    } catch (const Input_error& error) {
      EXPECT_EQ(std::string(error.what()).rfind((folder / name).string() + ": ", 0), 0u) << error.what();
    }
}

} // namespace
