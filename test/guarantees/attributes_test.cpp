// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G6: what hangs on corners, triangles and vertices goes through files and reductions unchanged.

#include "support/Temporary_folder.h"
#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include "soup/selection.h"
#include <selvedge/Error.h>
#include <selvedge/inspect.h>
#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <set>
#include <sstream>
#include <tuple>

using namespace selvedge;
using selvedge::test::contents_of;
using selvedge::test::Temporary_folder;
using Names = std::vector<std::string>;
using Type = Attribute::Type;

namespace {

constexpr unsigned seed = 20261121;

std::string written(const Triangle_soup& soup, const std::string& file, Encoding encoding = Encoding::ascii)
{
  const Temporary_folder folder;
  Write_options options;
  options.encoding = encoding;
  write_mesh(folder / file, soup, options);
  return contents_of(folder / file);
}

Triangle_soup read(const std::string& text, Mesh_format format)
{
  return read_mesh(text, format, "text").soup;
}

Triangle_soup through(const Triangle_soup& soup, const std::string& file,
                      Encoding encoding = Encoding::binary)
{
  return read(written(soup, file, encoding), mesh_format(file));
}

/// By their bits: −0 is not 0.
template <class Rows>
bool same_bits(const Rows& a, const Rows& b)
{
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

template <std::size_t dimension>
void expect_same(const Corner_values<dimension>& found, const Corner_values<dimension>& expected)
{
  EXPECT_TRUE(same_bits(found.values, expected.values));
  EXPECT_EQ(found.of_triangle, expected.of_triangle);
  EXPECT_EQ(found.missing, expected.missing);
}

void expect_same(const Triangle_labels& found, const Triangle_labels& expected)
{
  EXPECT_EQ(found.of_triangle, expected.of_triangle);
  EXPECT_EQ(found.names, expected.names);
}

void expect_same(const std::vector<Attribute>& found, const std::vector<Attribute>& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE(expected[i].name);
    EXPECT_EQ(found[i].name, expected[i].name);
    EXPECT_EQ(found[i].type, expected[i].type);
    EXPECT_EQ(found[i].components, expected[i].components);
    EXPECT_EQ(found[i].is_normalized, expected[i].is_normalized);
    EXPECT_TRUE(found[i].rows == expected[i].rows);
  }
}

void expect_same(const Triangle_soup& found, const Triangle_soup& expected)
{
  EXPECT_TRUE(same_bits(found.points, expected.points));
  EXPECT_EQ(found.triangles, expected.triangles);
  expect_same(found.uvs, expected.uvs);
  expect_same(found.normals, expected.normals);
  expect_same(found.groups, expected.groups);
  expect_same(found.objects, expected.objects);
  expect_same(found.materials, expected.materials);
  expect_same(found.smoothing_groups, expected.smoothing_groups);
  expect_same(found.vertex_attributes, expected.vertex_attributes);
  expect_same(found.triangle_attributes, expected.triangle_attributes);
  EXPECT_EQ(found.material_libraries, expected.material_libraries);
  EXPECT_EQ(found.header_comments, expected.header_comments);
}

// Files

const std::string rich_obj = "mtllib my wool.mtl\n"
                             "mtllib a.mtl ../b.mtl\n"
                             "v 0 0 -0 1 0.1 0.25\n"
                             "v 0.1 0 0 0 0.3333333333333333 1 0.5\n"
                             "v 1 1 1e-300\n"
                             "v 0 1 0 0.5\n"
                             "v 5 5 5\n" // used by none
                             "vt 0.1 -0\n"
                             "vt 1 0.7\n"
                             "vt 0.30000000000000004 2.5\n"
                             "vn 0 0 1\n"
                             "vn 0.6 0 -0.8\n"
                             "f 1 2 3\n"
                             "o body\n"
                             "g left  sleeve #2\n"
                             "usemtl wool (red)\n"
                             "s 1\n"
                             "f 1/1/1 3/2/2 4/3/1\n"
                             "g right\n"
                             "f 1/3 2/2 4/1\n"
                             "usemtl silk\n"
                             "s off\n"
                             "f 1//1 2//2 4//1\n"
                             "o trim\n"
                             "g right\n" // repeated, as some readers forget it at an object
                             "usemtl silk\n"
                             "s off\n"
                             "f 2/1/1 3/1/1 4/1/1\n";

TEST(AttributesObj, EveryStatementComesBack)
{
  const Triangle_soup soup = read(rich_obj, Mesh_format::obj);
  EXPECT_EQ(written(soup, "m.obj"), rich_obj);
  EXPECT_EQ(not_carried(soup, Mesh_format::obj), Names());
  const Names colours = {"w", "red", "green", "blue", "alpha"};
  ASSERT_EQ(soup.vertex_attributes.size(), colours.size());
  for (std::size_t i = 0; i < colours.size(); ++i)
    EXPECT_EQ(soup.vertex_attributes[i].name, colours[i]);
}

TEST(AttributesObj, WindowsTextRelativeIndicesAndContinuationsSayTheSame)
{
  std::string text;
  std::istringstream lines(rich_obj);
  for (std::string line;
       std::getline(lines, line);) // names run to the end of the line, and would hold comments
    text += line + (line[0] == 'v' || line[0] == 'f' ? " # x\\\r\n# y\r\n" : " \t\r\n");
  const auto replace = [&text](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
  };
  replace("f 1/1/1 3/2/2 4/3/1", "f -5/-3/-2 \\\r\n 3/2/2\\\r\n\t-2/-1/1");
  replace("v 0.1 0 0", "v\t+1e-1 \\\n 0. 0e9");
  EXPECT_EQ(written(read(text, Mesh_format::obj), "m.obj"), rich_obj);
}

TEST(AttributesObj, NamesThatCannotStandThereAreRefused)
{
  Triangle_soup soup = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", Mesh_format::obj);
  for (const char* name : {" a", "a ", "a\t", "a\\", "a\nf 1 2 3"})
    for (Triangle_labels Triangle_soup::*labels :
         {&Triangle_soup::groups, &Triangle_soup::objects, &Triangle_soup::materials,
          &Triangle_soup::smoothing_groups}) {
      Triangle_soup labelled = soup;
      labelled.*labels = {{0}, {name}};
      EXPECT_THROW(written(labelled, "m.obj"), Argument_error) << name;
    }
  soup.material_libraries = {"a\nv 1 2 3"};
  EXPECT_THROW(written(soup, "m.obj"), Argument_error);
}

TEST(AttributesObj, MissingMaterialLibrariesAreNamed)
{
  const Temporary_folder folder;
  Triangle_soup soup;
  soup.material_libraries = {"my wool.mtl", "a.mtl b.mtl"};
  write_file(folder / "my wool.mtl", "newmtl wool\n");
  write_file(folder / "b.mtl", "newmtl silk\n");
  EXPECT_EQ(missing_material_libraries(folder / "m.obj", soup), Names{"a.mtl"});
  write_file(folder / "a.mtl", "newmtl silk\n");
  EXPECT_EQ(missing_material_libraries(folder / "m.obj", soup), Names());
}

const std::string rich_ply =
    "ply\nformat ascii 1.0\ncomment TextureFile wool red.png\nobj_info made by hand\n"
    "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
    "property double nx\nproperty double ny\nproperty double nz\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
    "property float quality\nproperty short bone\n"
    "element face 2\nproperty list uchar int vertex_indices\n"
    "property list uchar double texcoord\nproperty int flags\nproperty double weight\n"
    "end_header\n"
    "0 0 -0 0 0 1 1 2 3 255 0.1 -32768\n"
    "0.1 0 0 0 0.6 0.8 255 0 0 0 -0 32767\n"
    "1 1 0 1 0 0 9 9 9 9 1e-45 5\n"
    "0 1 0 0 0 -1 0 0 0 1 3.4028235e+38 6\n"
    "3 0 1 2 6 0 0 0.1 0 1 1 -7 0.1\n"
    "3 2 3 0 0 2147483647 -0\n";

TEST(AttributesPly, EveryPropertyComesBack)
{
  const Triangle_soup soup = read(rich_ply, Mesh_format::ply);
  EXPECT_EQ(written(soup, "m.ply"), rich_ply);
  EXPECT_EQ(not_carried(soup, Mesh_format::ply), Names());
  EXPECT_EQ(soup.uvs.of_triangle, (std::vector<Index_triple>{{0, 1, 2}, {3, 3, 3}}));
  EXPECT_EQ(soup.uvs.missing, Index(3));
  for (const Encoding encoding : {Encoding::binary, Encoding::binary_big_endian})
    EXPECT_EQ(written(through(soup, "m.ply", encoding), "m.ply"), rich_ply);
}

TEST(AttributesPly, TextureCoordinatesAtVerticesStayThere)
{
  for (const auto& [u, v] : {std::pair("s", "t"), std::pair("u", "v"), std::pair("texture_u", "texture_v")}) {
    const std::string begin =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    const auto properties = [](const std::string& first, const std::string& second) {
      return "property double " + first + "\nproperty double " + second + "\n";
    };
    const std::string end = "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                            "0 0 0 0.1 0.2\n1 0 0 1 0\n0 1 0 0 1\n3 2 0 1\n";
    const Triangle_soup soup = read(begin + properties(u, v) + end, Mesh_format::ply);
    EXPECT_EQ(soup.uvs.of_triangle, soup.triangles);
    EXPECT_TRUE(soup.vertex_attributes.empty());
    EXPECT_EQ(written(soup, "m.ply"), begin + properties("s", "t") + end);
  }
}

Attribute random_attribute(const std::string& name, Type type, std::size_t rows, std::mt19937& random)
{
  Attribute attribute{name, type, 1, false, {}};
  attribute.rows.resize(rows * row_size(attribute));
  for (unsigned char& byte : attribute.rows)
    byte = static_cast<unsigned char>(random());
  // A text has only one NaN.
  const std::size_t size = row_size(attribute);
  for (std::size_t last = size - 1; last < attribute.rows.size() && type >= Type::float32; last += size)
    attribute.rows[last] &= 0xbf;
  return attribute;
}

TEST(AttributesPly, RandomBitsOfEveryTypeComeBackInEveryEncoding)
{
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  Triangle_soup soup = test::flat_grid(200);
  soup.uvs = {};
  soup.groups = {};
  for (int type = 0; type < 8; ++type) {
    const std::string name = "p" + std::to_string(type);
    soup.vertex_attributes.push_back(random_attribute(name, Type(type), soup.points.size(), random));
    soup.triangle_attributes.push_back(random_attribute(name, Type(type), soup.triangles.size(), random));
  }
  for (const Encoding encoding : {Encoding::binary, Encoding::binary_big_endian, Encoding::ascii})
    expect_same(through(soup, "m.ply", encoding), soup);
}

TEST(AttributesPly, TrianglesOfAPolygonHaveItsAttributes)
{
  const Triangle_soup soup =
      read("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 4\nproperty short flags\nproperty list uchar int vertex_indices\nproperty uchar "
           "red\nend_header\n"
           "0 0 0\n1 0 0\n1 1 0\n0 1 0\n258 3 0 1 2 1\n7 2 0 1 2\n-2 4 0 1 2 3 3\n9 3 0 2 3 4\n",
           Mesh_format::ply);
  ASSERT_EQ(soup.triangle_attributes.size(), 2u);
  std::vector<std::int16_t> flags(soup.triangles.size());
  ASSERT_EQ(soup.triangle_attributes[0].rows.size(), 2 * flags.size());
  std::memcpy(flags.data(), soup.triangle_attributes[0].rows.data(), 2 * flags.size());
  EXPECT_EQ(flags, (std::vector<std::int16_t>{258, -2, -2, 9}));
  EXPECT_EQ(soup.triangle_attributes[1].rows, (std::vector<unsigned char>{1, 3, 3, 4}));
}

TEST(AttributesPly, NamesThatStandTwiceAreRefusedOrIgnored)
{
  Triangle_soup soup = test::one_triangle();
  soup.triangle_attributes = {{"row", Type::uint8, 1, false, {7}}, {"row", Type::uint8, 1, false, {8}}};
  EXPECT_THROW(written(soup, "m.ply"), Argument_error);
  soup.triangle_attributes.clear();
  soup.vertex_attributes = {{"x", Type::uint8, 1, false, {7, 7, 7}}};
  EXPECT_THROW(written(soup, "m.ply"), Argument_error);
  const Mesh_file mesh = read_mesh(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float x\nelement face 1\nproperty list uchar int vertex_indices\nproperty uchar row\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty uchar row\nend_header\n"
      "0 0 0 9\n1 0 0 9\n0 1 0 9\n3 0 1 2 7 0 0 1 8\n",
      Mesh_format::ply, "text");
  EXPECT_EQ(mesh.soup.points[1].x(), 1);
  ASSERT_EQ(mesh.soup.triangle_attributes.size(), 1u);
  EXPECT_EQ(mesh.soup.triangle_attributes[0].rows, std::vector<unsigned char>{7});
  EXPECT_TRUE(mesh.soup.vertex_attributes.empty());
  EXPECT_EQ(mesh.notes.ignored.size(), 3u);
}

// Regions

/// A flat sheet of 20 × 20 squares with a number for each face: 1 to the left of a line that runs across it,
/// else 0.
Triangle_soup painted_sheet()
{
  Triangle_soup soup = test::sheet(20, 20);
  soup.triangle_attributes.push_back({"number", Type::uint8, 1, false, {}});
  for (const Index_triple& triangle : soup.triangles)
    soup.triangle_attributes[0].rows.push_back(
        std::all_of(triangle.begin(), triangle.end(), [&](Index v) { return soup.points[v].x() <= 8; }));
  return soup;
}

double painted_area(const Triangle_soup& soup)
{
  double area = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    const auto cross = CGAL::cross_product(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a]);
    area += soup.triangle_attributes[0].rows[t] == 1 ? std::sqrt(cross.squared_length()) / 2 : 0;
  }
  return area;
}

TEST(AttributesOfFaces, RegionsKeepTheirShape)
{
  for (const bool is_doubled : {false, true}) {
    Triangle_soup soup = painted_sheet();
    if (is_doubled) { // the back of the cloth is painted elsewhere
      const std::size_t count = soup.triangles.size();
      for (std::size_t t = 0; t < count; ++t) {
        const auto [a, b, c] = soup.triangles[t];
        soup.triangles.push_back({a, c, b});
        soup.triangle_attributes[0].rows.push_back(0);
      }
    }
    const double area = painted_area(soup);
    EXPECT_DOUBLE_EQ(area, 160);
    const Triangle_soup result = test::reduce(soup, test::to_ratio(0.05)).simplified.soup;
    EXPECT_LE(result.triangles.size(), soup.triangles.size() / 20 + 1);
    EXPECT_NEAR(painted_area(result), area, 1e-9) << is_doubled;
  }
}

TEST(AttributesOfFaces, RegionsAreThoseThatTheReplayFinds)
{
  // Of 79 edges between two faces, 5 lie between the regions, which is more than a sixteenth. Two triangles
  // beside them, which rounding alone brings together, have the edge that is missing.
  Triangle_soup soup = test::sheet(6, 5);
  const Index first = Index(soup.points.size());
  constexpr double a_bit = 1e-9;
  for (const Point_3& p : {Point_3(50, 0, 0), Point_3(51, 0, 0), Point_3(50, 1, 0), Point_3(51 + a_bit, 0, 0),
                           Point_3(50 + a_bit, 0, 0), Point_3(50, -1, 0)})
    soup.points.push_back(p);
  soup.triangles.push_back({first, first + 1, first + 2});
  soup.triangles.push_back({first + 3, first + 4, first + 5});
  soup.triangle_attributes.push_back({"number", Type::uint8, 1, false, {}});
  for (const Index_triple& triangle : soup.triangles)
    soup.triangle_attributes[0].rows.push_back(
        std::all_of(triangle.begin(), triangle.end(), [&](Index v) { return soup.points[v].x() <= 2; }));
  for (const bool is_rounded : {false, true}) {
    Prepare_options options;
    options.round_to_float32 = is_rounded;
    const test::Logged_reduction reduction = test::reduce_and_log(soup, test::to_ratio(0.1), options);
    EXPECT_GT(reduction.simplified.report.collapses, 0u);
    EXPECT_TRUE(test::replay_text(soup, reduction.log).is_accepted()) << is_rounded;
    EXPECT_EQ(std::abs(painted_area(reduction.simplified.soup) - 10) < 1e-6, is_rounded);
  }
  // Of several poses, the first one decides.
  std::vector<Point_3> together = soup.points;
  together[first + 3] = together[first + 1];
  together[first + 4] = together[first];
  for (const bool are_first_together : {false, true}) {
    Triangle_soup posed = soup;
    posed.points = are_first_together ? together : soup.points;
    posed.poses = {{"pose", are_first_together ? soup.points : together}};
    const test::Logged_reduction reduction = test::reduce_and_log(posed, test::to_ratio(0.1));
    EXPECT_GT(reduction.simplified.report.collapses, 0u);
    EXPECT_EQ(std::abs(painted_area(reduction.simplified.soup) - 10) < 1e-6, are_first_together);
    Replay_options in_pose;
    in_pose.pose = 0;
    for (const Replay_options& options : {Replay_options(), in_pose})
      EXPECT_TRUE(test::replay_text(posed, reduction.log, options).is_accepted()) << are_first_together;
  }
}

TEST(AttributesOfFaces, ThatDifferNearlyEverywhereMakeNoLines)
{
  Triangle_soup soup = painted_sheet();
  EXPECT_EQ(inspect(soup).seams.by_regions, 20u);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    soup.triangle_attributes[0].rows[t] = static_cast<unsigned char>(t * 37 % 11);
  EXPECT_EQ(inspect(soup).seams.edges, 0u);
}

// Conversion

/// A garment with all that a soup can hold.
Triangle_soup dressed(Triangle_soup soup)
{
  const auto name = [](const std::string& kind, Index i) { return kind + " " + std::to_string(i); };
  for (const auto& [labels, kind, count] :
       {std::tuple(&soup.objects, "object", Index(2)), std::tuple(&soup.materials, "material", Index(3)),
        std::tuple(&soup.smoothing_groups, "smooth", Index(2))}) {
    for (Index i = 0; i < count; ++i)
      labels->names.push_back(name(kind, i));
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
      labels->of_triangle.push_back(static_cast<Index>(t * count / soup.triangles.size()));
  }
  soup.normals.of_triangle = soup.triangles;
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    soup.normals.values.push_back({0.1 * double(v), 1, -double(v)});
  for (const char* colour : {"red", "green", "blue"}) {
    Attribute& attribute = soup.vertex_attributes.emplace_back();
    attribute.name = colour;
    for (std::size_t v = 0; v < soup.points.size(); ++v) {
      const double value = double(v * colour[0] % 1009) / 1009;
      const auto* const bytes = reinterpret_cast<const unsigned char*>(&value);
      attribute.rows.insert(attribute.rows.end(), bytes, bytes + sizeof value);
    }
  }
  soup.triangle_attributes.push_back({"number", Type::uint32, 1, false, {}});
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
    for (int byte = 0; byte < 4; ++byte)
      soup.triangle_attributes[0].rows.push_back(reinterpret_cast<const unsigned char*>(&t)[byte]);
  return soup;
}

TEST(AttributesConverted, GoWhereTheFormatHasAPlaceAndTheRestIsNamed)
{
  const Triangle_soup soup = dressed(test::skirt(1000));
  ASSERT_FALSE(soup.uvs.empty() || soup.groups.empty());
  EXPECT_EQ(not_carried(soup, Mesh_format::obj), Names{"face attribute 'number'"});
  EXPECT_EQ(not_carried(soup, Mesh_format::ply),
            (Names{"groups", "objects", "materials", "smoothing groups"}));
  EXPECT_EQ(not_carried(soup, Mesh_format::off),
            (Names{"texture coordinates", "normals", "groups", "objects", "materials", "smoothing groups",
                   "vertex attribute 'red'", "vertex attribute 'green'", "vertex attribute 'blue'",
                   "face attribute 'number'"}));
  EXPECT_EQ(not_carried(soup, Mesh_format::stl).size(), not_carried(soup, Mesh_format::off).size() + 1);

  Triangle_soup expected = soup;
  expected.triangle_attributes.clear();
  expect_same(through(soup, "m.obj"), expected);

  const Triangle_soup ply = through(soup, "m.ply");
  expect_same(ply.normals, soup.normals);
  expect_same(ply.vertex_attributes, soup.vertex_attributes);
  expect_same(ply.triangle_attributes, soup.triangle_attributes);
  // By value, for PLY numbers texture coordinates anew.
  const Triangle_soup back = through(ply, "m.obj");
  ASSERT_EQ(back.uvs.of_triangle.size(), soup.uvs.of_triangle.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      ASSERT_EQ(back.uvs.values[back.uvs.of_triangle[t][k]], soup.uvs.values[soup.uvs.of_triangle[t][k]]);
  expect_same(back.normals, soup.normals);
  expect_same(back.vertex_attributes, soup.vertex_attributes);
}

TEST(AttributesConverted, PlyHasAVertexForEachNormal)
{
  const char* const square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\n";
  const Triangle_soup soup =
      read(square + std::string("f 1//1 2//1 3//1\nf 1//2 3//2 4//2\n"), Mesh_format::obj);
  EXPECT_EQ(not_carried(soup, Mesh_format::ply), Names{});
  const Triangle_soup ply = through(soup, "m.ply");
  EXPECT_EQ(ply.points.size(), 6u);
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(ply.normals.values[ply.normals.of_triangle[t][k]], soup.normals.values[t]);
      EXPECT_EQ(ply.points[ply.triangles[t][k]], soup.points[soup.triangles[t][k]]);
    }
}

TEST(AttributesConverted, NormalsThatSomeTrianglesLackAreNamedForPly)
{
  const Triangle_soup soup =
      read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\n", Mesh_format::obj);
  EXPECT_EQ(not_carried(soup, Mesh_format::ply), Names{"normals, for not every vertex has one"});
  EXPECT_TRUE(through(soup, "m.ply").normals.empty());
}

TEST(AttributesConverted, ColoursOfIntegersAreFractionsInText)
{
  const std::string obj = written(read(rich_ply, Mesh_format::ply), "m.obj");
  EXPECT_NE(obj.find("v 0.1 0 0 1 0 0 0\n"), std::string::npos) << obj;
  EXPECT_NE(obj.find("v 0 0 -0 0.00392156862745098 "), std::string::npos) << obj;
}

// Reductions

template <std::size_t dimension>
std::string value_at(const Corner_values<dimension>& values, std::size_t triangle, std::size_t k)
{
  if (values.empty())
    return {};
  const auto& value = values.values[values.of_triangle[triangle][k]];
  return {reinterpret_cast<const char*>(value.data()), sizeof value};
}

std::string row_at(const Attribute& attribute, std::size_t row)
{
  const std::size_t size = row_size(attribute);
  return {attribute.rows.begin() + row * size, attribute.rows.begin() + (row + 1) * size};
}

/// All that a corner has, bit for bit: of itself and of its vertex, or of its triangle.
Names facts_of_corner(const Triangle_soup& soup, std::size_t triangle, std::size_t k)
{
  const Index vertex = soup.triangles[triangle][k];
  const Point_3& p = soup.points[vertex];
  const double position[] = {p.x(), p.y(), p.z()};
  Names facts = {std::string(reinterpret_cast<const char*>(position), sizeof position),
                 value_at(soup.uvs, triangle, k), value_at(soup.normals, triangle, k)};
  for (const Attribute& attribute : soup.vertex_attributes)
    facts.push_back(attribute.name + row_at(attribute, vertex));
  return facts;
}

Names facts_of_triangle(const Triangle_soup& soup, std::size_t triangle)
{
  Names facts;
  for (const Triangle_labels* labels : {&soup.groups, &soup.objects, &soup.materials, &soup.smoothing_groups})
    facts.push_back(labels->empty() ? "" : labels->names[labels->of_triangle[triangle]]);
  for (const Attribute& attribute : soup.triangle_attributes)
    facts.push_back(attribute.name + row_at(attribute, triangle));
  return facts;
}

/// Corners and triangles of a result that are not what `corners` and `triangles` say of the original.
std::size_t count_changes(const Triangle_soup& found, const Triangle_soup& original,
                          const std::vector<Index>& triangles, const std::vector<Index_triple>& corners)
{
  std::size_t changes = 0;
  for (std::size_t t = 0; t < found.triangles.size(); ++t) {
    changes += facts_of_triangle(found, t) != facts_of_triangle(original, triangles[t]);
    for (std::size_t k = 0; k < 3; ++k)
      changes +=
          facts_of_corner(found, t, k) != facts_of_corner(original, corners[t][k] / 3, corners[t][k] % 3);
  }
  return changes;
}

/// Groups, objects and materials of the triangles that a corner's new triangle and its old one are in: the
/// same side.
void expect_same_side(const Triangle_soup& original, const Simplified_soup& result)
{
  std::size_t changed = 0;
  for (std::size_t t = 0; t < result.triangles.size(); ++t)
    for (const Index corner : result.corners[t])
      for (const Triangle_labels* labels : {&original.groups, &original.objects, &original.materials})
        changed +=
            !labels->empty() && labels->of_triangle[corner / 3] != labels->of_triangle[result.triangles[t]];
  EXPECT_EQ(changed, 0u);
}

void expect_all_carried(const Triangle_soup& input, double ratio)
{
  const Prepared_soup prepared = prepare(input);
  const Simplified_soup result = simplify_soup(prepared, test::to_ratio(ratio));
  ASSERT_LT(result.soup.triangles.size(), input.triangles.size());
  EXPECT_EQ(count_changes(result.soup, prepared.soup, result.triangles, result.corners), 0u);
  expect_same_side(prepared.soup, result);

  // And as it comes back from a file, where all can be written there.
  const Triangle_soup found = through(result.soup, "m.obj");
  Triangle_soup expected = prepared.soup;
  expected.triangle_attributes.clear();
  EXPECT_EQ(count_changes(found, expected, result.triangles, result.corners), 0u);

  // Control: corners of the next triangle are not the same.
  std::vector<Index_triple> wrong = result.corners;
  std::rotate(wrong.begin(), wrong.begin() + 1, wrong.end());
  EXPECT_GT(count_changes(result.soup, prepared.soup, result.triangles, wrong), result.corners.size());
}

TEST(AttributesReduced, EveryCornerOfAGarmentIsOneOfTheInput)
{
  for (const char* name : {"skirt", "jacket", "shorts"}) {
    SCOPED_TRACE(name);
    expect_all_carried(dressed(test::garment(name, 3000)), 0.3);
  }
}

/// The pairs of texts that an OBJ gives for the position and the texture coordinate of its corners.
std::set<std::string> text_pairs(const std::string& obj)
{
  Names points, uvs;
  std::set<std::string> pairs;
  std::istringstream lines(obj);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "v")
      points.push_back(line);
    else if (keyword == "vt")
      uvs.push_back(line);
    else if (keyword == "f")
      for (std::string corner; words >> corner;)
        pairs.insert(points.at(std::stoul(corner) - 1) +
                     uvs.at(std::stoul(corner.substr(corner.find('/') + 1)) - 1));
  }
  return pairs;
}

TEST(AttributesReduced, EveryCornerOfRealMeshesIsOneOfTheInput)
{
  for (const char* name : {"garments/avatar_in_suit_uv.obj", "garments/dress_14_pieces_uv.obj"}) {
    SCOPED_TRACE(name);
    const std::filesystem::path path = std::filesystem::path(SELVEDGE_SHARED_DATA) / name;
    if (!std::filesystem::exists(path))
      GTEST_SKIP() << "the real meshes are not here: " << path;
    const Triangle_soup soup = read_mesh(path).soup;
    expect_all_carried(soup, 0.5);
    const Simplified_soup result = simplify_soup(prepare(soup), test::to_ratio(0.5));
    const std::set<std::string> before = text_pairs(written(soup, "m.obj")),
                                after = text_pairs(written(result.soup, "m.obj"));
    EXPECT_GT(after.size(), 1000u);
    EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()));
  }
}

using Coordinates = std::tuple<double, double, double>;

Coordinates coordinates(const Point_3& p)
{
  return {p.x(), p.y(), p.z()};
}

// What a corner of a soup carries: position, texture coordinate, group.
using Corner = std::tuple<Coordinates, double, double, std::string>;

std::set<Corner> corners(const Triangle_soup& soup)
{
  std::set<Corner> result;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto& uv = soup.uvs.values[soup.uvs.of_triangle[t][k]];
      result.insert({coordinates(soup.points[soup.triangles[t][k]]), uv[0], uv[1],
                     soup.groups.names[soup.groups.of_triangle[t]]});
    }
  return result;
}

TEST(Attributes, EveryCornerIsOneOfTheInput)
{
  for (const char* name : {"skirt", "jacket", "seams"}) {
    Generate_options options;
    options.faces = 6000;
    const Triangle_soup garment = generate(name, options);
    const test::Reduction reduction = test::reduce(garment, test::to_ratio(0.1));
    const std::set<Corner> before = corners(garment), after = corners(reduction.simplified.soup);
    EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end())) << name;
    EXPECT_LT(after.size(), before.size() * 3 / 4);
  }
}

TEST(Attributes, EveryVertexOfTheResultIsOneOfTheInputInItsOrder)
{
  const Triangle_soup garment = test::skirt(4000);
  const Triangle_soup result = test::reduce(garment, test::to_ratio(0.2)).simplified.soup;
  std::size_t next = 0;
  for (const Point_3& p : result.points) {
    while (next < garment.points.size() && garment.points[next] != p)
      ++next;
    ASSERT_LT(next, garment.points.size()) << "not an original vertex, or out of order";
    ++next;
  }
}

} // namespace
