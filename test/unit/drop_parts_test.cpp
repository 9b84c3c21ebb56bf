// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Parts that are left out, by name or for their size.

#include "support/Temporary_folder.h"
#include "support/soups.h"

#include <selvedge/Error.h>
#include <selvedge/drop_parts.h>
#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

// A sheet of 18 faces and a size of 5, with the groups "cloth left" and "cloth right"; and two tetrahedra of
// the group "button", the second twice as large. The corners of all faces have texture coordinates of their
// own, and each face has its number as an attribute.
Triangle_soup sheet_with_buttons()
{
  const Triangle_soup button = tetrahedron();
  Triangle_soup soup =
      joined(mapped(sheet(3, 3), [](const Point_3& p) { return Point_3(p.x(), p.y() * 4 / 3, p.z()); }),
             moved(button, 10, 0, 0));
  soup = joined(
      soup, moved(mapped(button, [](const Point_3& p) { return Point_3(2 * p.x(), 2 * p.y(), 2 * p.z()); }),
                  20, 0, 0));
  soup.groups.names = {"cloth left", "cloth right", "button"};
  Attribute number{"number", Attribute::Type::uint8, 1, false, {}};
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    soup.groups.of_triangle.push_back(t < 9 ? 0 : t < 18 ? 1 : 2);
    soup.uvs.of_triangle.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    number.rows.push_back(static_cast<unsigned char>(t));
  }
  soup.uvs.values.resize(3 * soup.triangles.size());
  soup.triangle_attributes.push_back(number);
  soup.polygons = {{0, 4, 0}, {18, 4, 0}, {22, 4, 0}};
  return soup;
}

std::vector<Index> range(Index first, Index beyond)
{
  std::vector<Index> numbers(beyond - first);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

TEST(Drop_parts, SizesArePiecesByPositions)
{
  const Triangle_soup soup = sheet_with_buttons();
  for (const Triangle_soup& other : {soup, unshared(soup)}) { // which has a piece by numbers for each face
    const std::vector<Sized_piece> pieces = sized_pieces(other);
    ASSERT_EQ(pieces.size(), 3u);
    EXPECT_EQ(pieces[1].size, 2 * pieces[0].size);
    EXPECT_EQ(pieces[2].size, 5);
    EXPECT_EQ(pieces[0].triangles, 4u);
    EXPECT_EQ(pieces[1].triangles, 4u);
    EXPECT_EQ(pieces[2].triangles, 18u);
  }
}

TEST(Drop_parts, LeavesOutWhatIsSmaller)
{
  const double size = sized_pieces(sheet_with_buttons())[1].size;
  Triangle_soup soup = sheet_with_buttons();
  const Parts_left left = drop_parts(soup, {{}, size}); // the second is not smaller
  std::vector<Index> kept = range(0, 18);
  for (const Index t : range(22, 26))
    kept.push_back(t);
  EXPECT_EQ(left.triangles, kept);
  EXPECT_EQ(left.small, 4u);
  EXPECT_EQ(left.small_pieces, 1u);
  EXPECT_EQ(left.named, 0u);
  EXPECT_EQ(soup.points, sheet_with_buttons().points);
  EXPECT_EQ(soup.polygons.size(), 2u);
  for (Index t = 0; t < kept.size(); ++t) {
    EXPECT_EQ(soup.triangles[t], sheet_with_buttons().triangles[kept[t]]);
    EXPECT_EQ(soup.uvs.of_triangle[t][0], 3 * kept[t]);
    EXPECT_EQ(soup.triangle_attributes[0].rows[t], kept[t]);
  }

  soup = sheet_with_buttons();
  EXPECT_EQ(drop_parts(soup, {{}, std::nextafter(size, 10.)}).small_pieces, 2u);
  EXPECT_EQ(soup.triangles.size(), 18u);
}

TEST(Drop_parts, LeavesOutPartsByName)
{
  Triangle_soup soup = sheet_with_buttons();
  const Parts_left left = drop_parts(soup, {{"but*", "right"}, 0});
  EXPECT_EQ(left.triangles, range(0, 9));
  EXPECT_EQ(left.named, 17u);
  EXPECT_EQ(left.small, 0u);
}

// What one part leaves of a piece may be small, and stays.
TEST(Drop_parts, MeasuresPiecesAsTheyCome)
{
  Triangle_soup soup = sheet_with_buttons();
  const Parts_left left = drop_parts(soup, {{"right"}, 5});
  EXPECT_EQ(left.triangles, range(0, 9));
  EXPECT_EQ(left.named, 9u);
  EXPECT_EQ(left.small, 8u);
  EXPECT_EQ(left.small_pieces, 2u);
}

TEST(Drop_parts, NothingAskedForLeavesAll)
{
  Triangle_soup soup = sheet_with_buttons();
  EXPECT_TRUE(Parts_to_drop().empty());
  EXPECT_EQ(drop_parts(soup, {}).triangles, range(0, 26));
  EXPECT_EQ(soup.polygons.size(), 3u);
  Triangle_soup nothing;
  EXPECT_TRUE(drop_parts(nothing, {{}, 1}).triangles.empty());
}

TEST(Drop_parts, RefusesWhatMakesNoSense)
{
  for (const double size : {-1., std::numeric_limits<double>::quiet_NaN()}) {
    Triangle_soup soup = sheet_with_buttons();
    EXPECT_THROW(drop_parts(soup, {{}, size}), Argument_error);
  }
  for (const Parts_to_drop& parts : {Parts_to_drop{{}, 6}, Parts_to_drop{{"cloth*", "button"}, 0}}) {
    Triangle_soup soup = sheet_with_buttons();
    EXPECT_THROW(drop_parts(soup, parts), Input_error);
    EXPECT_EQ(soup.triangles.size(), 26u);
  }
  Triangle_soup soup = sheet_with_buttons();
  EXPECT_THROW(drop_parts(soup, {{"zip"}, 0}), Argument_error);
}

// Of the materials cloth, trim, brass and wood, which the parts of the same names have; trim is also what a
// variant of cloth has. All show a texture of their own but for cloth, which shows that of wood.
class Materials_of_parts : public ::testing::Test
{
protected:
  using Json = nlohmann::ordered_json;
  using Names = std::vector<std::string>;

  Materials_of_parts()
  {
    Triangle_soup soup;
    for (Index i = 0; i < 4; ++i) {
      soup = joined(soup, sheet(2, 2, i));
      soup.materials.of_triangle.resize(soup.triangles.size(), i);
    }
    soup.materials.names = {"cloth", "trim", "brass", "wood"};
    for (const Point_3& p : soup.points)
      soup.uvs.values.push_back({p.x() / 2, p.y() / 2});
    soup.uvs.of_triangle = soup.triangles;
    write_mesh(folder / "in.gltf", soup);
    json = Json::parse(std::ifstream(folder / "in.gltf"));
    json["images"] = Json::array();
    for (std::size_t i = 0; i < 3; ++i) {
      json["images"].push_back({{"name", soup.materials.names[i + 1]}, {"uri", std::to_string(i) + ".png"}});
      json["textures"].push_back({{"source", i}});
      material(soup.materials.names[i + 1])["normalTexture"] = {{"index", i}};
    }
    material("cloth")["normalTexture"] = {{"index", 2}};
    json["extensionsUsed"] = {"KHR_materials_variants"};
    json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "plain"}}};
    for (Json& mesh : json["meshes"])
      for (Json& primitive : mesh["primitives"])
        if (primitive["material"] == number_of("cloth"))
          primitive["extensions"]["KHR_materials_variants"]["mappings"] = {
              {{"material", number_of("trim")}, {"variants", {0}}}};
  }

  std::size_t number_of(const std::string& name) const
  {
    for (std::size_t i = 0; i < json["materials"].size(); ++i)
      if (json["materials"][i]["name"] == name)
        return i;
    throw std::logic_error(name);
  }
  Json& material(const std::string& name) { return json["materials"][number_of(name)]; }

  // Returns the names of the images that are left, and keeps the document in `json`.
  Names images_without(const Names& parts)
  {
    std::ofstream(folder / "in.gltf") << json;
    Triangle_soup soup = read_mesh(folder / "in.gltf").soup;
    drop_parts(soup, {parts, 0});
    write_mesh(folder / "out.gltf", soup);
    json = Json::parse(std::ifstream(folder / "out.gltf"));
    Names names;
    for (const Json& image : json.value("images", Json::array()))
      names.push_back(image["name"]);
    return names;
  }

  const Temporary_folder folder;
  Json json;
};

TEST_F(Materials_of_parts, TakeTheirTexturesAlong)
{
  EXPECT_EQ(images_without({"brass"}), (Names{"trim", "wood"}));
  EXPECT_FALSE(material("brass").contains("normalTexture"));
  EXPECT_EQ(json["textures"], Json::parse(R"([{"source": 0}, {"source": 1}])"));
  EXPECT_EQ(material("cloth")["normalTexture"]["index"], 1);
}

TEST_F(Materials_of_parts, LeaveWhatIsSeenElsewhere)
{
  EXPECT_EQ(images_without({"wood", "trim"}), (Names{"trim", "brass", "wood"}));
  EXPECT_TRUE(material("trim").contains("normalTexture")) << "which a variant of cloth has";
  EXPECT_FALSE(material("wood").contains("normalTexture"));
}

TEST_F(Materials_of_parts, GoWithTheLastThatNamesThem)
{
  EXPECT_EQ(images_without({"cloth", "trim"}), (Names{"brass", "wood"}));
}

TEST_F(Materials_of_parts, StayWhereACoarserLevelMayShowThem)
{
  material("wood")["extensions"]["MSFT_lod"]["ids"] = {number_of("brass")};
  EXPECT_EQ(images_without({"brass"}), (Names{"trim", "brass", "wood"}));
}

TEST_F(Materials_of_parts, StayWhereAnExtensionThatIsNotKnownMayReferToThem)
{
  json["extensionsUsed"].push_back("ACME_decals");
  EXPECT_EQ(images_without({"brass"}), (Names{"trim", "brass", "wood"}));
  EXPECT_TRUE(material("brass").contains("normalTexture"));
}

} // namespace
} // namespace selvedge::test
