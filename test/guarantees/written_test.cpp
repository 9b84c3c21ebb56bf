// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G3: what was judged is what stands in the file, bit for bit.

#include "support/Temporary_folder.h"

#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>
#include <selvedge/rounding.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>

using namespace selvedge;
using selvedge::test::Temporary_folder;

namespace {

constexpr std::uint64_t s_seed = 20260117;

std::uint64_t bits_of(double value)
{
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

double double_of(std::uint64_t bits)
{
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

float float_of(std::uint32_t bits)
{
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// A soup with these coordinates, three to a vertex, and triangles that name all of its vertices, some of
/// them twice.
Triangle_soup soup_of(std::vector<double> coordinates)
{
  Triangle_soup soup;
  while (coordinates.size() % 9 != 0)
    coordinates.push_back(0.1);
  for (std::size_t i = 0; i < coordinates.size(); i += 3)
    soup.points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  const Index size = static_cast<Index>(soup.points.size());
  for (Index i = 0; i < size; ++i)
    soup.triangles.push_back({i, (i * 7 + 1) % size, (i + 2) % size});
  return soup;
}

/// Doubles that text and binary formats get wrong first, and a few thousand random bit patterns.
std::vector<double> hard_doubles()
{
  std::vector<double> values = {0.0,
                                -0.0,
                                0.1,
                                -0.1,
                                1.0 / 3,
                                1e300,
                                -1e300,
                                1e-300,
                                5e-324,
                                1e-310,
                                1e22,
                                1e23,
                                1e21,
                                123456,
                                0.30000000000000004,
                                2.5,
                                1e15,
                                1e16,
                                1e17,
                                1e-5,
                                1e-4,
                                9007199254740993.0,
                                8.41e21,
                                9.5367431640625e-07,
                                2.2250738585072011e-308};
  using limits = std::numeric_limits<double>;
  for (const double value :
       {limits::max(), limits::lowest(), limits::min(), limits::denorm_min(), limits::epsilon()})
    values.push_back(value);
  const std::size_t plain = values.size();
  for (std::size_t i = 0; i < plain; ++i)
    for (const double way : {-1.0, 1.0}) {
      const double neighbour = std::nextafter(values[i], way * limits::max());
      if (std::isfinite(neighbour))
        values.push_back(neighbour);
    }
  std::mt19937_64 random(s_seed);
  while (values.size() < 9000) {
    const double value = double_of(random());
    if (std::isfinite(value))
      values.push_back(value);
  }
  return values;
}

std::vector<double> hard_floats()
{
  using limits = std::numeric_limits<float>;
  std::vector<double> values = {
      0.0f, 0.1f, 1.0f / 3, limits::max(), limits::lowest(), limits::min(), limits::denorm_min()};
  std::mt19937_64 random(s_seed);
  while (values.size() < 9000) {
    const float value = float_of(static_cast<std::uint32_t>(random()));
    if (std::isfinite(value))
      values.push_back(value);
  }
  return values;
}

void expect_same_bits(const Triangle_soup& found, const Triangle_soup& expected)
{
  ASSERT_EQ(found.points.size(), expected.points.size());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < found.points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      moved += bits_of(found.points[i][axis]) != bits_of(expected.points[i][axis]);
  EXPECT_EQ(moved, 0u);
  EXPECT_EQ(found.triangles, expected.triangles);
}

struct Form
{
  const char* name;
  const char* file;
  Encoding encoding;
};

void PrintTo(const Form& form, std::ostream* stream)
{
  *stream << form.name;
}

const Form all_forms[] = {
    {"Obj", "m.obj", Encoding::binary},       {"Off", "m.off", Encoding::binary},
    {"PlyBinary", "m.ply", Encoding::binary}, {"PlyBigEndian", "m.ply", Encoding::binary_big_endian},
    {"PlyAscii", "m.ply", Encoding::ascii},   {"StlBinary", "m.stl", Encoding::binary},
    {"StlAscii", "m.stl", Encoding::ascii}};

Triangle_soup write_and_read(const Triangle_soup& soup, const Form& form)
{
  const Temporary_folder folder;
  Write_options options;
  options.encoding = form.encoding;
  options.comments = {"made by a test", "of two lines"};
  write_mesh(folder / form.file, soup, options);
  return read_mesh(folder / form.file).soup;
}

class Written : public testing::TestWithParam<Form>
{
};

TEST_P(Written, ReadsBackBitIdentical)
{
  SCOPED_TRACE("seed " + std::to_string(s_seed));
  const Triangle_soup soup = soup_of(hard_doubles());
  expect_same_bits(write_and_read(soup, GetParam()), soup);
}

INSTANTIATE_TEST_SUITE_P(Form, Written, testing::ValuesIn(all_forms, all_forms + 5),
                         [](const auto& form) { return std::string(form.param.name); });

/// The same for what is in floats already, which STL holds too.
class Written_floats : public Written
{
};

TEST_P(Written_floats, ReadBackBitIdentical)
{
  SCOPED_TRACE("seed " + std::to_string(s_seed));
  const Triangle_soup soup = soup_of(hard_floats());
  const Triangle_soup found = write_and_read(soup, GetParam());
  if (mesh_format(GetParam().file) != Mesh_format::stl)
    return expect_same_bits(found, soup);
  // Without vertex numbers, the corners of each triangle are what must be the same.
  ASSERT_EQ(found.triangles.size(), soup.triangles.size());
  for (std::size_t i = 0; i < soup.triangles.size(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_EQ(bits_of(found.points[found.triangles[i][corner]][axis]),
                  bits_of(soup.points[soup.triangles[i][corner]][axis]))
            << "triangle " << i;
}

TEST_P(Written_floats, TwiceAreTheSameBytes)
{
  const Temporary_folder folder;
  const Triangle_soup soup = soup_of(hard_floats());
  std::string contents[2];
  for (std::string& content : contents) {
    Write_options options;
    options.encoding = GetParam().encoding;
    write_mesh(folder / GetParam().file, soup, options);
    std::ifstream stream(folder / GetParam().file, std::ios::binary);
    content.assign(std::istreambuf_iterator<char>(stream), {});
  }
  EXPECT_FALSE(contents[0].empty());
  EXPECT_EQ(contents[0], contents[1]);
}

INSTANTIATE_TEST_SUITE_P(Form, Written_floats, testing::ValuesIn(all_forms),
                         [](const auto& form) { return std::string(form.param.name); });

TEST(WrittenControl, DefaultPrecisionMovesVertices)
{
  const Triangle_soup soup = soup_of(hard_doubles());
  std::ostringstream text;
  for (const Point_3& p : soup.points)
    if (std::abs(p.x()) < 1e300 && std::abs(p.y()) < 1e300 &&
        std::abs(p.z()) < 1e300) // six digits may overflow
      text << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  text << "f 1 2 3\n";
  const Mesh_file file = read_mesh(text.str(), Mesh_format::obj, "six digits");
  std::size_t same = 0, compared = 0;
  for (const Point_3& p : soup.points)
    if (std::abs(p.x()) < 1e300 && std::abs(p.y()) < 1e300 && std::abs(p.z()) < 1e300)
      same += file.soup.points[compared++] == p;
  EXPECT_GT(compared, 1000u);
  EXPECT_LT(same, compared / 10);
}

TEST(WrittenFloats, StlRefusesWhatItWouldRound)
{
  const Temporary_folder folder;
  const Triangle_soup soup = soup_of({0.1, 0, 0, 1, 0, 0, 0, 1, 0});
  EXPECT_THROW(write_mesh(folder / "m.stl", soup), Argument_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "m.stl"));
}

TEST(WrittenFloats, RoundedSoupGoesThroughStlUnchanged)
{
  std::mt19937_64 random(s_seed);
  std::uniform_real_distribution<double> coordinate(-3, 3);
  std::vector<double> coordinates(900);
  for (double& value : coordinates)
    value = coordinate(random);
  Triangle_soup soup = soup_of(coordinates);
  const Rounding_notes notes = round_to_float32(soup);
  EXPECT_EQ(notes.vertices, 300u);
  EXPECT_GT(notes.coordinates, 890u);
  const Triangle_soup found = write_and_read(soup, all_forms[5]);
  for (std::size_t i = 0; i < soup.triangles.size(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      ASSERT_EQ(found.points[found.triangles[i][corner]], soup.points[soup.triangles[i][corner]]);
  EXPECT_EQ(round_to_float32(soup).coordinates, 0u);
}

TEST(WrittenFloats, PlyHoldsFloatsOnlyWhenThatLosesNothing)
{
  const Temporary_folder folder;
  const auto header_of = [&](const Triangle_soup& soup) {
    write_mesh(folder / "m.ply", soup);
    std::ifstream stream(folder / "m.ply", std::ios::binary);
    const std::string contents((std::istreambuf_iterator<char>(stream)), {});
    return contents.substr(0, contents.find("end_header"));
  };
  EXPECT_NE(header_of(soup_of({0.5, 0, 0, 1, 0, 0, 0, 1, 0})).find("property float x"), std::string::npos);
  EXPECT_NE(header_of(soup_of({0.5, 0, 0, 1, 0.1, 0, 0, 1, 0})).find("property double x"), std::string::npos);
  EXPECT_NE(header_of(soup_of({0.5, 0, 0, 1e39, 0, 0, 0, 1, 0})).find("property double x"),
            std::string::npos);
}

TEST(Rounding, IsToNearestTiesToEven)
{
  const double one_and_half_unit = 1 + std::ldexp(1, -24), above_it = std::nextafter(one_and_half_unit, 2);
  const double three_halves = 1 + 3 * std::ldexp(1, -24);
  Triangle_soup soup = soup_of({one_and_half_unit, above_it, three_halves, -0.0, 1e-60, 0.5, 1, 2, 3});
  const Rounding_notes notes = round_to_float32(soup);
  EXPECT_EQ(notes.coordinates, 4u);
  EXPECT_EQ(notes.vertices, 2u);
  EXPECT_EQ(soup.points[0], Point_3(1, 1 + std::ldexp(1, -23), 1 + std::ldexp(1, -22)));
  EXPECT_TRUE(std::signbit(soup.points[1].x()));
  EXPECT_EQ(soup.points[1], Point_3(0, 0, 0.5));
}

TEST(Rounding, OverflowIsRefusedAndChangesNothing)
{
  Triangle_soup soup = soup_of({0.1, 0, 0, 1, -1e39, 0, 0, 1, 0});
  const Triangle_soup before = soup;
  try {
    round_to_float32(soup);
    FAIL() << "no refusal";
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find("vertex 1 "), std::string::npos) << error.what();
  }
  expect_same_bits(soup, before);
  const double largest = std::numeric_limits<float>::max();
  Triangle_soup just = soup_of({std::nextafter(largest, 1e39), 0, 0, 1, 0, 0, 0, 1, 0});
  round_to_float32(just);
  EXPECT_EQ(just.points[0].x(), largest);
}

TEST(WrittenAttributes, ObjCarriesTextureCoordinatesAndGroups)
{
  const Temporary_folder folder;
  Triangle_soup soup = soup_of(hard_doubles());
  for (const Point_3& p : soup.points)
    soup.uvs.values.push_back({p.y(), p.x()});
  for (const auto& [a, b, c] : soup.triangles)
    soup.uvs.of_triangle.push_back({c, a, b});
  soup.groups.names = {"left sleeve", "collar #2", "default"};
  for (std::size_t i = 0; i < soup.triangles.size(); ++i)
    soup.groups.of_triangle.push_back(i == 0 ? 0 : static_cast<Index>(i / 5 % 3));
  write_mesh(folder / "m.obj", soup);
  const Mesh_file file = read_mesh(folder / "m.obj");
  expect_same_bits(file.soup, soup);
  ASSERT_EQ(file.soup.uvs.values.size(), soup.uvs.values.size());
  for (std::size_t i = 0; i < soup.uvs.values.size(); ++i)
    for (int axis = 0; axis < 2; ++axis)
      ASSERT_EQ(bits_of(file.soup.uvs.values[i][axis]), bits_of(soup.uvs.values[i][axis]));
  EXPECT_EQ(file.soup.uvs.of_triangle, soup.uvs.of_triangle);
  EXPECT_EQ(file.soup.groups.of_triangle, soup.groups.of_triangle);
  EXPECT_EQ(file.soup.groups.names, soup.groups.names);
  EXPECT_TRUE(not_carried(soup, Mesh_format::obj).empty());
  EXPECT_EQ(not_carried(soup, Mesh_format::ply), (std::vector<std::string>{"groups"}));
}

} // namespace
