// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Tangents in glTF go with the normals: they keep no vertices apart, and stay perpendicular to new normals.

#include "support/Gltf_document.h"
#include "support/Temporary_folder.h"
#include "support/logged_reduction.h"
#include "support/reduction.h"
#include "support/vertices_used.h"

#include "files/Local_normals.h"
#include "soup/flat_shading.h"
#include "soup/gltf_transforms.h"
#include <selvedge/compare.h>
#include <selvedge/inspect.h>
#include <selvedge/normals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

constexpr std::size_t places = 21 * 21, along_middle = 21; // vertices of a sheet of 20 × 20 squares

/// 20 × 20 squares, plane or with hills.
Triangle_soup squares(double height, Normals_treatment shading)
{
  constexpr Index size = 20;
  Triangle_soup soup;
  for (Index y = 0; y <= size; ++y)
    for (Index x = 0; x <= size; ++x) {
      soup.points.emplace_back(x, y, float(height * (std::sin(x / 4.) + std::cos(y / 5.))));
      const Index v = y * (size + 1) + x;
      if (x < size && y < size) {
        soup.triangles.push_back({v, v + 1, v + size + 1});
        soup.triangles.push_back({v + 1, v + size + 2, v + size + 1});
      }
    }
  soup.normals.of_triangle = soup.triangles;
  soup.normals.values.resize(soup.points.size());
  restore_normals(soup, shading);
  return soup;
}

Triangle_soup hills(Normals_treatment shading)
{
  return squares(1, shading);
}

bool is_before_middle(const Triangle_soup& soup, std::size_t triangle)
{
  const auto& [a, b, c] = soup.triangles[triangle];
  return soup.points[a].x() + soup.points[b].x() + soup.points[c].x() < 30;
}

/// Returns the tangent at a corner: the direction in which the texture runs there, and on which side it is.
std::array<double, 4> tangent_at(const Triangle_soup& soup, std::size_t corner, bool is_mirrored)
{
  const std::array<double, 3>& n = soup.normals.values[soup.normals.of_triangle[corner / 3][corner % 3]];
  const double sign = is_mirrored && is_before_middle(soup, corner / 3) ? -1 : 1;
  const double length = std::sqrt(1 - n[0] * n[0]);
  return {sign * (1 - n[0] * n[0]) / length, -sign * n[0] * n[1] / length, -sign * n[0] * n[2] / length,
          sign};
}

/// A document in which every corner of the soup is a vertex of its own. Its texture runs along x, or away
/// from the middle at x = 10 to both sides.
Document document_of_corners(const Triangle_soup& soup, bool is_mirrored)
{
  Document document;
  document.json = {
      {"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0}}}}}, {"nodes", {{{"mesh", 0}}}}};
  const std::size_t count = 3 * soup.triangles.size();
  const auto point = [&](std::size_t i) -> const Point_3& {
    return soup.points[soup.triangles[i / 3][i % 3]];
  };
  const auto position = [&](std::size_t i, std::size_t k) { return float(point(i)[int(k)]); };
  Json attributes;
  attributes["POSITION"] = add_rows<float>(document, count, 3, 5126, position);
  set_bounds(document, attributes["POSITION"], count, position);
  attributes["NORMAL"] = add_rows<float>(document, count, 3, 5126, [&](std::size_t i, std::size_t k) {
    return soup.normals.values[soup.normals.of_triangle[i / 3][i % 3]][k];
  });
  attributes["TANGENT"] = add_rows<float>(document, count, 4, 5126, [&](std::size_t i, std::size_t k) {
    return tangent_at(soup, i, is_mirrored)[k];
  });
  attributes["TEXCOORD_0"] = add_rows<float>(document, count, 2, 5126, [&](std::size_t i, std::size_t k) {
    return (k == 1 ? point(i).y() : is_mirrored ? std::abs(point(i).x() - 10) : point(i).x()) / 20;
  });
  document.json["meshes"] = {{{"primitives", {{{"attributes", attributes}}}}}};
  return document;
}

/// Adds a morph target with these rows of NORMAL and TANGENT.
template <class Normal, class Tangent>
void add_target(Document& document, const Normal& normal, const Tangent& tangent)
{
  Json& primitive = document.json["meshes"][0]["primitives"][0];
  const std::size_t count =
      document.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"];
  primitive["targets"].push_back({{"POSITION", primitive["attributes"]["POSITION"]},
                                  {"NORMAL", add_rows<float>(document, count, 3, 5126, normal)},
                                  {"TANGENT", add_rows<float>(document, count, 3, 5126, tangent)}});
}

template <class Value>
void add_target(Document& document, const Value& value)
{
  add_target(document, value, value);
}

Document document_of_result(const Triangle_soup& soup)
{
  const Temporary_folder folder;
  write_mesh(folder / "m.glb", soup);
  return from_glb(contents(folder / "m.glb"));
}

/// The rows of an attribute at all corners, in the order of the triangles.
std::vector<std::string> rows_at_corners(const Document& document, const Json& attributes, const char* name)
{
  const Json& primitive = document.json["meshes"][0]["primitives"][0];
  const std::vector<std::string> rows = rows_of(document, attributes[name]);
  if (!primitive.contains("indices"))
    return rows;
  std::vector<std::string> result;
  for (const std::string& index : rows_of(document, primitive["indices"]))
    result.push_back(rows[index.size() == 2 ? get<std::uint16_t>(index, 0) : get<std::uint32_t>(index, 0)]);
  return result;
}

/// Expects tangents that are perpendicular to the normals, on the right side, and about where the texture
/// runs.
void expect_tangents(const Triangle_soup& soup, bool is_mirrored)
{
  const Document document = document_of_result(soup);
  const Json& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
  const std::vector<std::string> normals = rows_at_corners(document, attributes, "NORMAL"),
                                 tangents = rows_at_corners(document, attributes, "TANGENT");
  ASSERT_EQ(tangents.size(), 3 * soup.triangles.size());
  double least = 1;
  for (std::size_t corner = 0; corner < tangents.size(); ++corner) {
    double square = 0, product = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double t = get<float>(tangents[corner], 4 * k);
      square += t * t;
      product += t * get<float>(normals[corner], 4 * k);
    }
    EXPECT_NEAR(square, 1, 1e-6);
    EXPECT_NEAR(product, 0, 1e-6) << "at corner " << corner;
    const float side = is_mirrored && is_before_middle(soup, corner / 3) ? -1 : 1;
    EXPECT_EQ(get<float>(tangents[corner], 12), side) << "at corner " << corner;
    least = std::min(least, double(side * get<float>(tangents[corner], 0)));
  }
  EXPECT_GT(least, 0.8);
}

Prepare_options with_normals(Normals_choice choice)
{
  Prepare_options options;
  options.normals = choice;
  return options;
}

TEST(Gltf_tangents, KeepNoVerticesApartWhereNormalsAreFlat)
{
  for (const bool is_mirrored : {false, true}) {
    Document document = document_of_corners(hills(Normals_treatment::flat), is_mirrored);
    const Triangle_soup file = read_glb(document).soup;
    ASSERT_TRUE(has_flat_normals(file));
    EXPECT_EQ(vertices_used(file), places + (is_mirrored ? along_middle : 0));
    for (const Placement placement : {Placement::vertices, Placement::optimal}) {
      Simplify_options options = to_ratio(0.3);
      options.placement = placement;
      const Reduction result = reduce(file, options, with_normals(Normals_choice::automatic));
      EXPECT_TRUE(result.verification.accepted());
      EXPECT_LE(result.simplified.soup.triangles.size(), file.triangles.size() * 3 / 10);
      expect_tangents(result.simplified.soup, is_mirrored);
    }
    // The control: an attribute that does not go with the normals.
    Json& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["_DIRECTION"] = attributes["TANGENT"];
    attributes.erase("TANGENT");
    EXPECT_GT(vertices_used(read_glb(document).soup), 2 * places);
  }
}

TEST(Gltf_tangents, ArePerpendicularToNormalsThatAreMadeAnew)
{
  for (const bool is_mirrored : {false, true}) {
    const Triangle_soup read =
        read_glb(document_of_corners(hills(Normals_treatment::smooth), is_mirrored)).soup;
    for (const Normals_choice choice :
         {Normals_choice::automatic, Normals_choice::loose, Normals_choice::recompute}) {
      Triangle_soup file = read;
      if (joins_vertices(choice))
        share_vertices_without_normals(file, choice);
      const Reduction result = reduce(std::move(file), to_ratio(0.1), with_normals(choice));
      EXPECT_TRUE(choice != Normals_choice::automatic || result.simplified.fitted_normals > 20);
      expect_tangents(result.simplified.soup, is_mirrored);
    }
    Simplify_options optimal = to_ratio(0.1);
    optimal.placement = Placement::optimal;
    expect_tangents(reduce(read, optimal, with_normals(Normals_choice::automatic)).simplified.soup,
                    is_mirrored);
  }
}

using Directions = std::vector<std::array<double, 3>>;

Directions directions_at_corners(const Document& document, const Json& attributes, const char* name)
{
  Directions result;
  for (const std::string& row : rows_at_corners(document, attributes, name))
    result.push_back({get<float>(row, 0), get<float>(row, 4), get<float>(row, 8)});
  return result;
}

double length(const std::array<double, 3>& v)
{
  return std::hypot(v[0], v[1], v[2]);
}

// A viewer adds what the targets hold to normals and tangents: where these are new, it must fit the new ones.
TEST(Gltf_tangents, OfMorphTargetsTurnWithNormalsThatAreMadeAnew)
{
  const Triangle_soup soup = hills(Normals_treatment::smooth);
  Document document = document_of_corners(soup, false);
  const double c = std::sqrt(3) / 2, s = 0.5; // the first target turns every frame by 30° beyond the middle
  const auto normal = [&](std::size_t i, std::size_t k) {
    return soup.normals.values[soup.normals.of_triangle[i / 3][i % 3]][k];
  };
  const auto tangent = [&](std::size_t i, std::size_t k) { return tangent_at(soup, i, false)[k]; };
  const auto share = [&](std::size_t i) {
    return soup.points[soup.triangles[i / 3][i % 3]].x() > 10 ? 1 : 0;
  };
  add_target(
      document, [&](auto i, auto k) { return share(i) * ((c - 1) * normal(i, k) + s * tangent(i, k)); },
      [&](auto i, auto k) { return share(i) * ((c - 1) * tangent(i, k) - s * normal(i, k)); });
  add_target( // the second one makes them shorter
      document, [&](auto i, auto k) { return -0.5 * normal(i, k); },
      [&](auto i, auto k) { return -0.5 * tangent(i, k); });
  const Triangle_soup read = read_glb(document).soup;
  for (const Placement placement : {Placement::vertices, Placement::optimal})
    for (const Normals_choice choice :
         {Normals_choice::keep, Normals_choice::automatic, Normals_choice::recompute}) {
      Simplify_options options = to_ratio(0.1);
      options.placement = placement;
      const Document after = document_of_result(reduce(read, options, with_normals(choice)).simplified.soup);
      const Json& primitive = after.json["meshes"][0]["primitives"][0];
      const auto at_corners = [&](const Json& attributes, const char* name) {
        return directions_at_corners(after, attributes, name);
      };
      const Json &base = primitive["attributes"], &targets = primitive["targets"];
      const Directions points = at_corners(base, "POSITION"), normals = at_corners(base, "NORMAL"),
                       tangents = at_corners(base, "TANGENT"), turns = at_corners(targets[0], "NORMAL"),
                       tangent_turns = at_corners(targets[0], "TANGENT"),
                       half = at_corners(targets[1], "NORMAL"),
                       tangent_half = at_corners(targets[1], "TANGENT");
      for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_NEAR(half[i][k], -0.5 * normals[i][k], 1e-6);
          if (placement == Placement::vertices) {
            ASSERT_NEAR(tangent_half[i][k], -0.5 * tangents[i][k], 1e-6);
          }
        }
        if (placement == Placement::optimal)
          continue;
        if (points[i][0] <= 10) {
          ASSERT_EQ(turns[i], (std::array<double, 3>{}));
          ASSERT_EQ(tangent_turns[i], (std::array<double, 3>{}));
          continue;
        }
        std::array<double, 3> turned;
        for (std::size_t k = 0; k < 3; ++k) {
          turned[k] = normals[i][k] + turns[i][k];
          ASSERT_NEAR(tangents[i][k] + tangent_turns[i][k], c * tangents[i][k] - s * normals[i][k], 1e-6);
        }
        ASSERT_NEAR(length(turned), 1, 1e-6);
        ASSERT_NEAR(turned[0] * normals[i][0] + turned[1] * normals[i][1] + turned[2] * normals[i][2], c,
                    1e-6);
      }
    }
}

TEST(Gltf_tangents, OfMorphTargetsTurnByTheShortestRotation)
{
  const auto expect_near = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(a[k], b[k], 1e-12);
  };
  expect_near(turned({1, 2, 3}, {2, 0, 0}, {0, 4, 0}), {-4, 2, 6}); // and twice as long
  expect_near(turned({1, 2, 3}, {0, 0, 1}, {0, 0, 1}), {1, 2, 3});
  const double third = 1 / std::sqrt(3);
  expect_near(turned({1, 2, 3}, {third, third, third}, {-third, -third, -third}), {-1, -2, -3});
  expect_near(turned({1, 2, 3}, {0, 0, 0}, {0, 0, 1}), {1, 2, 3});
  expect_near(turned({1, 2, 3}, {0, 0, 1}, {0, 0, 0}), {1, 2, 3});
}

TEST(Gltf_tangents, KeepTheirBytesWithTheNormalsOfTheirFaces)
{
  Document document = document_of_corners(hills(Normals_treatment::flat), true);
  add_target(document, [](std::size_t i, std::size_t k) { return 0.001 * double(i / 6) + double(k); });
  const Triangle_soup file = read_glb(document).soup;
  EXPECT_EQ(vertices_used(file), places + along_middle);
  const Document after =
      document_of_result(reduce(file, to_ratio(1), with_normals(Normals_choice::automatic)).simplified.soup);
  const Json &primitive = document.json["meshes"][0]["primitives"][0],
             &written = after.json["meshes"][0]["primitives"][0];
  EXPECT_EQ(rows_at_corners(after, written["attributes"], "TANGENT"),
            rows_at_corners(document, primitive["attributes"], "TANGENT"));
  for (const char* name : {"NORMAL", "TANGENT"})
    EXPECT_EQ(rows_at_corners(after, written["targets"][0], name),
              rows_at_corners(document, primitive["targets"][0], name));
}

TEST(Gltf_tangents, AreThoseOfTheFaceWhoseNormalIsNearest)
{
  const Triangle_soup file = read_glb(document_of_corners(hills(Normals_treatment::flat), true)).soup;
  const Gltf_scene::Instance& instance = file.scene->instances.at(0);
  const Gltf_scene::Block& block = file.scene->blocks.at(instance.block);
  files::Local_normals rows(*file.scene);
  std::size_t others = 0;
  for (Index t = 0; t < file.triangles.size(); ++t)
    for (const Index v : file.triangles[t]) { // which may be that of another triangle
      std::array<double, 3> normal = file.normals.values[file.normals.of_triangle[t][0]];
      normal[0] += 1e-9; // is none of the file
      const Index row = rows.row_at(*block.normals(), instance.first + v, normal);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(component(*block.normals(), row, k), normal[k], 1e-6);
      others += row != v;
    }
  EXPECT_GT(others, file.triangles.size());
}

// What is plane in the file may get a ridge by a morph target.
TEST(Gltf_tangents, OfMorphTargetsKeepVerticesOfOneNormalApart)
{
  const Triangle_soup soup = squares(0, Normals_treatment::flat);
  Document document = document_of_corners(soup, false);
  EXPECT_EQ(vertices_used(read_glb(document).soup), places);
  add_target(document,
             [&](std::size_t i, std::size_t) { return is_before_middle(soup, i / 3) ? -0.5 : 0.5; });
  EXPECT_EQ(vertices_used(read_glb(document).soup), places + along_middle);
}

TEST(Gltf_tangents, AreApartOnTheTwoSidesOfAMirroredTexture)
{
  for (const bool is_mirrored : {false, true}) {
    const Triangle_soup file =
        read_glb(document_of_corners(hills(Normals_treatment::smooth), is_mirrored)).soup;
    const std::size_t apart = places + (is_mirrored ? along_middle : 0);
    EXPECT_EQ(vertices_used(file), apart);
    for (const Normals_choice choice : {Normals_choice::loose, Normals_choice::smooth}) {
      Triangle_soup shared = file;
      share_vertices_without_normals(shared, choice);
      EXPECT_EQ(vertices_used(shared), apart);
    }
    Triangle_soup dropped = file;
    share_vertices_without_normals(dropped);
    EXPECT_EQ(vertices_used(dropped), places);
    EXPECT_EQ(dropped.vertex_attributes.size(), is_mirrored ? 0u : 1u);
    EXPECT_TRUE(compare(dropped, file).lost_attributes.empty()) << "the scene has the tangents";
    // That is why the middle is a seam.
    const auto seams = inspect(file).seams.by_attributes;
    EXPECT_EQ(seams.size(), is_mirrored ? 1u : 0u);
    if (is_mirrored) {
      EXPECT_EQ(seams.at("TANGENT"), along_middle - 1);
    }
  }
}

// Where a texture is mirrored across the direction of its tangents, only their sides differ.
TEST(Gltf_tangents, AreLeftToTheSceneWhereOnlyTheirSidesDiffer)
{
  const Triangle_soup soup = hills(Normals_treatment::smooth);
  Document document = document_of_corners(soup, false);
  document.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] =
      add_rows<float>(document, 3 * soup.triangles.size(), 4, 5126, [&](std::size_t i, std::size_t k) {
        return k == 3 && is_before_middle(soup, i / 3) ? -1 : tangent_at(soup, i, false)[k];
      });
  Triangle_soup dropped = read_glb(document).soup;
  EXPECT_EQ(vertices_used(dropped), places + along_middle);
  EXPECT_EQ(dropped.vertex_attributes.size(), 1u);
  share_vertices_without_normals(dropped);
  EXPECT_EQ(vertices_used(dropped), places);
  EXPECT_EQ(dropped.vertex_attributes.size(), 0u);
}

// The middle, where the texture is mirrored, is a seam in a replay where it was one for the writer of the
// log.
TEST(Gltf_tangents, HoldTheirSeamInAReplayOfLooseNormals)
{
  Triangle_soup creased = hills(Normals_treatment::smooth); // with a soft line at y = 10
  const std::size_t count = creased.normals.values.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [x, y, z] = creased.normals.values[i];
    const double length = std::sqrt(1.01);
    creased.normals.values.push_back({x, (y + 0.1 * z) / length, (z - 0.1 * y) / length});
  }
  for (std::size_t t = creased.triangles.size() / 2; t < creased.triangles.size(); ++t)
    for (Index& number : creased.normals.of_triangle[t])
      number += Index(count);
  const Triangle_soup file = read_glb(document_of_corners(creased, true)).soup;
  const auto vertex_at = [&](double x, double y) {
    const auto is_there = [&](const Point_3& p) { return p.x() == x && p.y() == y; };
    return std::to_string(std::find_if(file.points.begin(), file.points.end(), is_there) -
                          file.points.begin());
  };
  const auto is_accepted = [&](Normals_choice choice) {
    Triangle_soup shared = file;
    EXPECT_GT(share_vertices_without_normals(shared, choice), 0u);
    Log_header header;
    header.vertices = file.points.size();
    header.triangles = file.triangles.size();
    header.normals = shared_normals(choice);
    header.limits.border_drift = 1e-3;
    std::ostringstream stream;
    Log_writer writer(stream, header);
    stream << "c " << vertex_at(10, 5) << ' ' << vertex_at(11, 5) << "\nresult 1 798 -\n";
    return replay_text(file, stream.str()).is_accepted();
  };
  EXPECT_FALSE(is_accepted(Normals_choice::loose));
  EXPECT_TRUE(is_accepted(Normals_choice::drop)) << "a control: there, nothing is mirrored";
}

TEST(Gltf_tangents, AreLeftToTheSceneWhereVerticesHaveSeveral)
{
  for (const Normals_treatment shading : {Normals_treatment::flat, Normals_treatment::smooth}) {
    const bool is_flat = shading == Normals_treatment::flat;
    const Mesh_file file = read_glb(document_of_corners(hills(shading), false));
    const std::vector<std::string> lost = not_carried(file.soup, Mesh_format::ply);
    EXPECT_EQ(std::count(lost.begin(), lost.end(), "tangents"), is_flat ? 1 : 0);
    EXPECT_EQ(file.soup.vertex_attributes.size(), is_flat ? 0u : 1u);
    EXPECT_EQ(contents_of(file).attributes, std::vector<std::string>{"TANGENT"});
  }
}

/// Turns the tangents of every other triangle by about this angle about the normals, and the others the other
/// way, each by one of its own.
Document with_tangents_of_faces(const Triangle_soup& soup, bool is_mirrored, double angle)
{
  Document document = document_of_corners(soup, is_mirrored);
  Json& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["TANGENT"] =
      add_rows<float>(document, 3 * soup.triangles.size(), 4, 5126, [&](std::size_t i, std::size_t k) {
        const std::array<double, 3>& n = soup.normals.values[soup.normals.of_triangle[i / 3][i % 3]];
        const std::array<double, 4> t = tangent_at(soup, i, is_mirrored);
        const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
        const double own = (i / 3 % 2 == 0 ? angle : -angle) * (1 - 1e-4 * double(i / 3));
        return k == 3 ? t[3] : std::cos(own) * t[k] + std::sin(own) * (n[l] * t[m] - n[m] * t[l]);
      });
  return document;
}

TEST(Gltf_tangents, OfFacesBecomeTheirMean)
{
  for (const bool is_mirrored : {false, true}) {
    const Mesh_file file =
        read_glb(with_tangents_of_faces(hills(Normals_treatment::smooth), is_mirrored, 0.4));
    EXPECT_EQ(vertices_used(file.soup), places + (is_mirrored ? along_middle : 0));
    EXPECT_FALSE(has_tangents_in_scene_only(file.soup));
    expect_tangents(file.soup, is_mirrored);
    const Reduction result = reduce(file.soup, to_ratio(0.1), with_normals(Normals_choice::automatic));
    EXPECT_TRUE(result.verification.accepted());
    EXPECT_LE(result.simplified.soup.triangles.size(), file.soup.triangles.size() / 10);
    expect_tangents(result.simplified.soup, is_mirrored);
  }
}

TEST(Gltf_tangents, OfFacesStayWhereTheyRunApart)
{
  const Triangle_soup soup = hills(Normals_treatment::smooth);
  const double right_angle = std::acos(0.);
  EXPECT_EQ(vertices_used(read_glb(with_tangents_of_faces(soup, false, 0.5 * right_angle)).soup), places);
  Document document = with_tangents_of_faces(soup, false, right_angle);
  EXPECT_GT(vertices_used(read_glb(document).soup), 2 * places - 10);
}

TEST(Gltf_tangents, HaveADirectionPerpendicularToAnyNormal)
{
  for (const std::array<double, 3>& normal : {std::array<double, 3>{0, 0, 1}, {1e-3, -2e-3, 5e-4}, {3, 4, 0}})
    for (const std::array<double, 3>& tangent :
         {normal, std::array<double, 3>{1, 0, 0}, {0, 0, 0}, {-7, 1e-9, 2}}) {
      const std::array<double, 3> result = perpendicular(tangent, normal);
      EXPECT_NEAR(std::hypot(result[0], result[1], result[2]), 1, 1e-12);
      const double length = std::hypot(normal[0], normal[1], normal[2]);
      EXPECT_NEAR(result[0] * normal[0] + result[1] * normal[1] + result[2] * normal[2], 0, 1e-12 * length);
    }
}

} // namespace
} // namespace selvedge::test
