// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Valid files of every format with bytes flipped, lost, doubled or cut off: each is read or refused, nothing
// else.

#include "support/Temporary_folder.h"

#include "soup/selection.h"
#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <ostream>
#include <random>
#include <string>

using namespace selvedge;

namespace {

constexpr unsigned seed = 4711;
constexpr int rounds = 4000;

struct Form
{
  const char* name;
  Mesh_format format;
  Encoding encoding;
};

void PrintTo(const Form& form, std::ostream* stream)
{
  *stream << form.name;
}

const Form forms[] = {{"Obj", Mesh_format::obj, Encoding::binary},
                      {"Off", Mesh_format::off, Encoding::binary},
                      {"PlyBinary", Mesh_format::ply, Encoding::binary},
                      {"PlyBigEndian", Mesh_format::ply, Encoding::binary_big_endian},
                      {"PlyAscii", Mesh_format::ply, Encoding::ascii},
                      {"StlBinary", Mesh_format::stl, Encoding::binary},
                      {"StlAscii", Mesh_format::stl, Encoding::ascii}};

std::string valid_file(const Form& form)
{
  Triangle_soup soup;
  for (int i = 0; i < 8; ++i)
    soup.points.emplace_back(i % 2 - 0.5, i / 2 % 2 * 1024.0, i / 4 * 0.125);
  for (Index i = 0; i + 2 < 8; ++i)
    soup.triangles.push_back({i, i + 1, i + 2});
  for (const Point_3& p : soup.points)
    soup.uvs.values.push_back({p.x(), p.y()});
  soup.uvs.of_triangle = soup.triangles;
  soup.groups.of_triangle = {0, 0, 1, 1, 0, 0};
  soup.groups.names = {"front", "back"};
  soup.materials = {{1, 1, 0, 0, 0, 1}, {"wool", "", "silk (2)"}};
  soup.normals.values = {{0, 0, 1}, {0.6, 0, 0.8}};
  soup.normals.of_triangle = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  soup.vertex_attributes = {{"red", Attribute::Type::uint8, 1, true, {7, 8, 9, 255, 0, 1, 2, 3}}};
  soup.vertex_attributes.push_back(
      {"quality", Attribute::Type::float32, 1, false, std::vector<unsigned char>(32, 0x3e)});
  soup.triangle_attributes = {{"flags", Attribute::Type::int8, 1, false, std::vector<unsigned char>(6, 7)}};
  soup.header_comments = {"comment TextureFile wool.png", "obj_info by hand"};
  const char* const extensions[] = {"m.obj", "m.off", "m.ply", "m.stl"};
  const test::Temporary_folder folder;
  const auto path = folder / extensions[static_cast<int>(form.format)];
  Write_options options;
  options.encoding = form.encoding;
  write_mesh(path, soup, options);
  std::ifstream stream(path, std::ios::binary);
  std::string contents(std::istreambuf_iterator<char>(stream), {});
  if (form.format == Mesh_format::obj)
    contents +=
        "f 1/1 2/2 4/4 3/3\nf 1//1 2 \\\n 3 4 5\nl 1 2\nmtllib a b.mtl\nv 1 2 3 0.5\nv 1 2 3 1 0 0.5 1\n";
  return contents;
}

template <class Random>
void mutate(std::string& contents, Random& random)
{
  static const char likely[] = "0123456789-+.eE/ \n\r\\#nif\xff\x7f";
  const auto below = [&](std::size_t size) { return size == 0 ? 0 : random() % size; };
  for (std::size_t change = 1 + below(4); change != 0; --change) {
    const std::size_t place = below(contents.size());
    switch (below(6)) {
    case 0:
      if (!contents.empty())
        contents[place] = static_cast<char>(contents[place] ^ (1 << below(8)));
      break;
    case 1:
      if (!contents.empty())
        contents[place] = likely[below(sizeof likely)];
      break;
    case 2:
      contents.erase(place, below(9));
      break;
    case 3:
      contents.insert(place, contents.substr(below(contents.size()), below(20)));
      break;
    case 4:
      contents.insert(contents.begin() + static_cast<std::ptrdiff_t>(place), likely[below(sizeof likely)]);
      break;
    default:
      if (below(4) == 0)
        contents.resize(place);
    }
  }
}

/// What the preconditions of a soup demand.
void expect_sound(const Triangle_soup& soup)
{
  EXPECT_FALSE(soup.triangles.empty());
  for (const Point_3& p : soup.points)
    ASSERT_TRUE(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()));
  for (const Index_triple& triangle : soup.triangles)
    for (const Index vertex : triangle)
      ASSERT_LT(vertex, soup.points.size());
  const auto expect_sound_values = [&](const auto& values) {
    ASSERT_TRUE(values.empty() || values.of_triangle.size() == soup.triangles.size());
    for (const Index_triple& triangle : values.of_triangle)
      for (const Index number : triangle)
        ASSERT_LT(number, values.values.size());
    ASSERT_TRUE(!values.missing || *values.missing < values.values.size());
  };
  expect_sound_values(soup.uvs);
  expect_sound_values(soup.normals);
  for (const auto& uv : soup.uvs.values)
    ASSERT_TRUE(std::isfinite(uv[0]) && std::isfinite(uv[1]));
  for (const Triangle_labels* labels :
       {&soup.groups, &soup.objects, &soup.materials, &soup.smoothing_groups}) {
    ASSERT_TRUE(labels->empty() || labels->of_triangle.size() == soup.triangles.size());
    for (const Index label : labels->of_triangle)
      ASSERT_LT(label, labels->names.size());
  }
  for (const Attribute& attribute : soup.vertex_attributes)
    ASSERT_EQ(attribute.rows.size(), soup.points.size() * row_size(attribute));
  for (const Attribute& attribute : soup.triangle_attributes)
    ASSERT_EQ(attribute.rows.size(), soup.triangles.size() * row_size(attribute));
}

class Mesh_files_mutation : public testing::TestWithParam<Form>
{
};

TEST_P(Mesh_files_mutation, IsReadOrRefused)
{
  const std::string valid = valid_file(GetParam());
  expect_sound(read_mesh(valid, GetParam().format, "valid").soup);
  std::mt19937 random(seed);
  const test::Temporary_folder folder;
  int read = 0, refused = 0;
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round));
    // An exact copy, so that a sanitizer sees the first byte read beyond its end.
    std::string mutated = valid;
    mutate(mutated, random);
    const std::vector<char> bytes(mutated.begin(), mutated.end());
    try {
      const Triangle_soup soup =
          read_mesh(std::string_view(bytes.data(), bytes.size()), GetParam().format, "mutated").soup;
      expect_sound(soup);
      ++read;
      // What was read can be written; that takes the time of a disk.
      if (round % 16 == 0 && (GetParam().format == Mesh_format::obj || GetParam().format == Mesh_format::ply))
        write_mesh(folder / (GetParam().format == Mesh_format::obj ? "m.obj" : "m.ply"), soup);
    } catch (const Input_error& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
    if (HasFatalFailure())
      return;
  }
  EXPECT_GT(read, rounds / 50);
  EXPECT_GT(refused, rounds / 50);
}

TEST_P(Mesh_files_mutation, EveryTruncationIsReadOrRefused)
{
  const std::string valid = valid_file(GetParam());
  for (std::size_t size = 0; size < valid.size(); ++size) {
    SCOPED_TRACE("cut after " + std::to_string(size));
    const std::vector<char> bytes(valid.begin(), valid.begin() + static_cast<std::ptrdiff_t>(size));
    try {
      expect_sound(read_mesh(std::string_view(bytes.data(), bytes.size()), GetParam().format, "cut").soup);
      const bool only_last_line_end = size + 1 == valid.size() && valid.back() == '\n';
      EXPECT_TRUE(GetParam().format == Mesh_format::obj || only_last_line_end)
          << "a part was taken for the whole";
    } catch (const Input_error&) {
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Form, Mesh_files_mutation, testing::ValuesIn(forms),
                         [](const auto& form) { return std::string(form.param.name); });

} // namespace
