// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What the summary of `simplify` says held a reduction back, or cost it its shape, and which option it names.

#include "App_run.h"
#include "support/soups.h"

#include <selvedge/Parts.h>
#include <selvedge/generate.h>
#include <selvedge/mesh_files.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

TEST(App_simplify, WritesWhenTheTargetIsOutOfReach)
{
  const Workspace folder;
  const std::string in = folder.generate("sheets", "in.obj", 1000);
  const std::string out = folder / "out.obj";
  const App_result lenient = run_app({"simplify", in, "-o", out, "--faces", "1", "--error", "none"});
  EXPECT_EQ(lenient.code, 0);
  EXPECT_EQ(lenient.err, "");
  EXPECT_NE(lenient.out.find("target 1 not reached\nheld back: of "), std::string::npos) << lenient.out;
  const std::string pieces = std::to_string(part_kinds(read_mesh(in).soup).front().count);
  EXPECT_NE(lenient.out.find(" faces for each of the " + pieces + ", and none of them vanishes\n"),
            std::string::npos)
      << lenient.out;
  const App_result without_target = run_app({"simplify", in, "-o", folder / "far.obj", "--error", "0.01"});
  EXPECT_EQ(without_target.out.find("\npieces: "), std::string::npos);
  const std::string written = contents_of(out);
  std::filesystem::remove(out);
  expect_refused(
      {"simplify", in, "-o", out, "--faces", "1", "--error", "none", "--require-target", "--quiet"}, 1,
      "was missed: ");
  EXPECT_EQ(contents_of(out), written);
}

TEST(App_simplify, NamesTheAttributeThatMakesSeams)
{
  const Workspace folder;
  Triangle_soup soup; // every triangle has vertices, and a heat, of its own
  Attribute heat{"heat", Attribute::Type::uint16, 1, false, {}};
  const Triangle_soup grid = sheet(20, 20);
  for (const Index_triple& triangle : grid.triangles) {
    const Index v = Index(soup.points.size()), t = v / 3;
    soup.triangles.push_back({v, v + 1, v + 2});
    for (const Index corner : triangle) {
      soup.points.push_back(grid.points[corner]);
      heat.rows.insert(heat.rows.end(), {static_cast<unsigned char>(t), static_cast<unsigned char>(t >> 8)});
    }
  }
  write_mesh(folder / "cool.ply", soup);
  soup.vertex_attributes.push_back(heat);
  write_mesh(folder / "heat.ply", soup);
  const auto says = [&](const std::string& in, const char* what) {
    return run_app({"simplify", in, "-o", folder / "out.ply", "--faces", "1"}).out.find(what) !=
           std::string::npos;
  };
  const char* const what = "; 1,160 edges of the input are seams because of heat and nothing else: ";
  EXPECT_TRUE(says(folder / "heat.ply", what));
  EXPECT_TRUE(says(folder / "heat.ply", "--drop-attribute heat lets them go (to about "));
  EXPECT_NE(run_app({"info", folder / "heat.ply"}).out.find("it is for heat (1,160)"), std::string::npos);
  EXPECT_FALSE(says(folder / "cool.ply", "seams because of"));
}

// With what was left out, the reduction is logged, replayed, and compared with the original.
TEST(App_simplify, LeavesOutATextureOfWhichEveryFaceHasItsOwnPiece)
{
  const Workspace folder;
  Triangle_soup soup = sheet(20, 20);
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (Index k = 0; k < 3; ++k) {
      soup.uvs.values.push_back({t / 800., k / 4.});
      if (k == 0)
        soup.uvs.of_triangle.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
  for (const char* ending : {"obj", "ply", "glb"}) {
    const std::string in = folder / ("in." + std::string(ending)),
                      out = folder / ("out." + std::string(ending)), log = folder / "steps.log";
    write_mesh(in, soup);
    const App_result held = run_app({"simplify", in, "-o", out, "--ratio", "0.1"});
    EXPECT_NE(held.out.find("because of texture and nothing else: --drop-attribute texture lets them go"),
              std::string::npos)
        << held.out;
    const App_result reduced =
        run_app({"simplify", in, "-o", out, "--ratio", "0.1", "--drop-attribute", "texture", "--log", log});
    EXPECT_NE(reduced.out.find("target 80 reached"), std::string::npos) << reduced.out;
    EXPECT_TRUE(read_mesh(out).soup.uvs.empty());
    const App_result replayed = run_app({"replay", in, log});
    EXPECT_EQ(replayed.code, 0) << replayed.err;
    EXPECT_NE(replayed.out.find("not judged: dropped: "), std::string::npos) << replayed.out;
    EXPECT_EQ(run_app({"verify", out, "--against", in, "--drop-attribute", "texture"}).code, 0);
  }
  expect_refused(
      {"simplify", folder / "in.ply", "-o", folder / "out.ply", "--ratio", "0.1", "--drop-attribute", "heat"},
      3, "--drop-attribute: the mesh has no attribute 'heat' to leave out; it has texture");
}

TEST(App_simplify, SaysWhyNoOptionHelps)
{
  const Workspace folder;
  const std::string in = folder / "in.obj"; // a tetrahedron
  write_text(in, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const App_result held = run_app({"simplify", in, "-o", folder / "out.obj", "--ratio", "0.1"});
  EXPECT_NE(
      held.out.find("held back: of 6 edges left, all by topology; no option helps much: every piece keeps "
                    "its holes and handles\n"),
      std::string::npos)
      << held.out;
}

// As of voxels and of spheres whose faces are pasted: normals are no edges once texture is none.
TEST(App_simplify, NamesTextureWhereNormalsThatNobodySeesGoWithIt)
{
  const Workspace folder;
  const auto held_by = [&](double turn) {
    Triangle_soup soup = sheet(20, 20);
    for (Index t = 0; t < soup.triangles.size(); ++t) {
      for (Index k = 0; k < 3; ++k) {
        soup.uvs.values.push_back({t / 800., k / 4.});
        soup.normals.values.push_back({turn * (double(t % 7) - 3), turn * (double(k) - 1), 1});
      }
      soup.uvs.of_triangle.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    soup.normals.of_triangle = soup.uvs.of_triangle;
    write_mesh(folder / "in.glb", soup);
    return run_app({"simplify", folder / "in.glb", "-o", folder / "out.glb", "--ratio", "0.1"}).out;
  };
  const std::string soft = held_by(0.02), hard = held_by(9);
  EXPECT_NE(soft.find("; 1,160 edges of the input are seams because of texture and of normals too near to be "
                      "seen as edges: --drop-attribute texture lets them go (to about "),
            std::string::npos)
      << soft;
  EXPECT_EQ(soft.find("no option helps"), std::string::npos) << soft;
  EXPECT_EQ(hard.find("--drop-attribute texture lets them go"), std::string::npos) << hard;
  EXPECT_NE(run_app({"simplify", folder / "in.glb", "-o", folder / "out.glb", "--ratio", "0.1",
                     "--drop-attribute", "texture"})
                .out.find("not reached"),
            std::string::npos);
  held_by(0.02);
  EXPECT_NE(run_app({"simplify", folder / "in.glb", "-o", folder / "out.glb", "--ratio", "0.1",
                     "--drop-attribute", "texture"})
                .out.find("target 80 reached"),
            std::string::npos);
}

// At 45°, the turn of normals holds more edges than the error, but letting it go gains hardly a face.
TEST(App_simplify, NamesFirstWhatGainsMost)
{
  const Workspace folder;
  const std::string in = folder / "in.obj", out = folder / "out.obj";
  ASSERT_EQ(run_app({"generate", "skirt", "-o", in, "--faces", "14000", "--quiet"}).code, 0);
  const App_result held = run_app({"simplify", in, "-o", out, "--ratio", "0.1", "--normal-change", "45"});
  ASSERT_NE(held.out.find("target 1,400 not reached"), std::string::npos) << held.out;
  EXPECT_NE(held.out.find("; try --error 0.05 against the error bound, which costs shape (to about "),
            std::string::npos)
      << held.out;
  const App_result helped = run_app({"simplify", in, "-o", out, "--ratio", "0.1", "--error", "0.05"});
  EXPECT_NE(helped.out.find("target 1,400 reached"), std::string::npos) << helped.out;
}

// With the options named, about as many faces are left as it says.
TEST(App_simplify, EstimatesHowFarOptionsGo)
{
  const Workspace folder;
  const std::string in = folder / "in.obj", out = folder / "out.obj", report = folder / "report.json";
  const auto run = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"simplify", in, "-o", out, "--report", report});
    return run_app(options).out;
  };
  for (const auto& [scene, given, option, value] :
       {std::tuple("skirt", std::vector<std::string>{"--ratio", "0.05", "--normal-change", "10"},
                   "--normal-change", "75"),
        std::tuple("folded", std::vector<std::string>{"--ratio", "0.05", "--border-drift", "0.0002"},
                   "--border-drift", "0.001"),
        std::tuple("nested", std::vector<std::string>{"--ratio", "0.01", "--placement", "vertices"},
                   "--error", "0.05")}) {
    ASSERT_EQ(run_app({"generate", scene, "-o", in, "--faces", "3000", "--quiet"}).code, 0);
    const std::string held = run(given), about = " (to about ";
    const std::size_t named = held.find(std::string("; try ") + option + ' ' + value),
                      place = held.find(about, named);
    ASSERT_NE(named, std::string::npos) << held;
    ASSERT_NE(place, std::string::npos) << held;
    std::string faces = held.substr(place + about.size(), held.find(" faces)", place) - place - about.size());
    faces.erase(std::remove(faces.begin(), faces.end(), ','), faces.end());
    std::vector<std::string> options = given;
    if (const auto same = std::find(options.begin(), options.end(), option); same != options.end())
      options.erase(same, same + 2);
    options.insert(options.end(), {option, value});
    run(options);
    const nlohmann::json json = nlohmann::json::parse(contents_of(report));
    const auto& within = json["target"]["within_reach"];
    const double left = (within.is_null() ? json["faces"]["output"] : within).get<double>();
    EXPECT_LT(left, 1.5 * std::stod(faces)) << held;
    EXPECT_GT(1.5 * left, std::stod(faces)) << held;
  }
  const std::string without_target = run({"--error", "0.001"});
  EXPECT_NE(without_target.find("; try --error 0.005, which costs shape\n"), std::string::npos)
      << without_target;
}

// An error five times as large needs a fifth of the faces, and half of those whose normals turn too far go
// with it, of all that were left where the target was missed. The next option is named where it lets at least
// half as many edges go.
TEST(App_simplify, NamesTwoOptionsThatGainAboutAsMuch)
{
  const Workspace folder;
  const std::string in = folder.generate("sheets", "in.obj", 1500), report = folder / "report.json";
  const auto run = [&](const std::string& option, const std::string& limit) {
    return run_app({"simplify", in, "-o", folder / "out.obj", "--ratio", "0.05", option, limit, "--report",
                    report})
        .out;
  };
  const std::string two = run("--normal-change", "20"),
                    error = "; try --error 0.05 against the error bound, which costs shape (to about ";
  const nlohmann::json json = nlohmann::json::parse(contents_of(report)), held = json.at("hindrances");
  const std::size_t place = two.find(error);
  ASSERT_NE(place, std::string::npos) << two;
  EXPECT_NE(two.find(" faces) and --normal-change 75 against the turn of normals (both to about "),
            std::string::npos)
      << two;
  double edges = 0;
  for (const auto& [reason, count] : held.items())
    if (count.is_number())
      edges += count.get<double>();
  const double gone = 0.8 * (held.at("error").get<double>() + held.at("normal_change").get<double>() / 2),
               left = json.at("target").at("within_reach").get<double>() * (1 - gone / edges);
  EXPECT_NEAR(std::stod(two.substr(place + error.size())), left, 0.05 * left) << two;

  const std::string one = run("--aspect-ratio", "0.3");
  EXPECT_NE(one.find("; try --aspect-ratio 0 (to about "), std::string::npos) << one;
  EXPECT_EQ(one.find(" and --error"), std::string::npos) << one;
}

// What only holds parts that have reached their targets is no reason.
TEST(App_simplify, NamesWhatHoldsPartsAboveTheirTarget)
{
  const Workspace folder;
  Triangle_soup soup = joined(sheet(30, 30), moved(sheet(4, 4), 0, 0, 9));
  soup.groups.names = {"large", "small"};
  soup.groups.of_triangle.assign(soup.triangles.size(), 1);
  std::fill_n(soup.groups.of_triangle.begin(), sheet(30, 30).triangles.size(), Index(0));
  write_mesh(folder / "in.obj", soup);
  const std::string out =
      run_app({"simplify", folder / "in.obj", "-o", folder / "out.obj", "--ratio", "small=0"}).out;
  EXPECT_NE(
      out.find("\nheld back: of 7 edges left in parts above their target, 4 by the turn of borders, 3 by "
               "borders; try --border-turn 180 (to about 1,801 faces)\n"),
      std::string::npos)
      << out;
}

// Where one place holds a shared mesh back, what helps makes more meshes of it.
TEST(App_simplify, SaysWhatReducingPlacesApartCosts)
{
  const Workspace folder;
  const std::string in = folder / "in.gltf", out = folder / "out.gltf";
  write_mesh(in, sheet(20, 20));
  auto scene = nlohmann::json::parse(contents_of(in));
  for (const double height : {0., 0.001, 100.}) // the stars of the first two are too near each other
    scene["nodes"].push_back({{"mesh", 0}, {"rotation", {0, 0.6, 0, 0.8}}, {"translation", {0, 0, height}}});
  scene["nodes"].erase(0);
  scene["scenes"][0]["nodes"] = {0, 1, 2};
  write_text(in, scene.dump());
  const App_result held = run_app({"simplify", in, "-o", out, "--ratio", "0.1"});
  EXPECT_NE(held.out.find("; try --instances apart, which may make 3 meshes of 1 (to about 240 faces)\n"),
            std::string::npos)
      << held.out;
  const App_result helped = run_app({"simplify", in, "-o", out, "--ratio", "0.1", "--instances", "apart"});
  EXPECT_NE(helped.out.find("target 240 reached"), std::string::npos) << helped.out;
}

// Of five lines of normals across a sheet, two are soft: only the other three hold their vertices.
TEST(App_simplify, LeavesSoftEdgesOutOfSeams)
{
  const Workspace folder;
  const Index size = 12;
  Triangle_soup soup = sheet(size, size);
  for (const Index_triple& triangle : soup.triangles) {
    double x = size;
    for (const Index v : triangle)
      x = std::min(x, soup.points[v].x());
    for (const Index v : triangle)
      soup.normals.values.push_back({int(x) % 4 < 2 ? 0. : x < 4 ? 0.1 : 5, 0.01 * soup.points[v].y(), 1});
    const Index first = Index(soup.normals.values.size() - 3);
    soup.normals.of_triangle.push_back({first, first + 1, first + 2});
  }
  for (const std::string kind : {"obj", "ply", "glb"}) {
    const std::string in = folder / ("in." + kind), out = folder / ("out." + kind), log = folder / "log",
                      report = folder / "report.json";
    write_mesh(in, soup);
    const auto faces = [&](const std::string& normals) {
      const App_result result = run_app({"simplify", in, "-o", out, "--faces", "8", "--normals", normals,
                                         "--report", report, "--log", log});
      EXPECT_EQ(result.code, 0) << result.err;
      const bool is_soft = normals == "auto";
      EXPECT_EQ(result.out.find("hard edges: those that are too soft to be seen") != std::string::npos,
                is_soft)
          << result.out;
      const std::string logged = normals == "mend" ? "joined"
                                 : kind != "obj"   ? (is_soft ? "soft_shared" : "loose_shared")
                                                   : (is_soft ? "soft" : "ignored");
      EXPECT_NE(contents_of(log).find("\nnormals " + logged + '\n'), std::string::npos);
      const nlohmann::json json = nlohmann::json::parse(contents_of(report));
      EXPECT_EQ(json["output"]["normals"] == "softened", is_soft);
      if (is_soft) {
        const nlohmann::json info = nlohmann::json::parse(run_app({"info", in, "--json"}).out);
        EXPECT_EQ(info["seams"]["normals"], "softened");
        EXPECT_EQ(info["faces"]["fixed"], json["faces"]["fixed"]);
        EXPECT_EQ(info["vertices"]["unused"], 0);
        EXPECT_EQ(info["input"]["notes"], json["input"]["notes"]);
      }
      EXPECT_EQ(run_app({"verify", out, "--against", in}).code, 0);
      EXPECT_EQ(run_app({"replay", in, log}).code, 0);
      return json["faces"]["output"].get<int>();
    };
    EXPECT_EQ(faces("auto"), 8) << kind;
    EXPECT_GE(faces("mend"), 12) << kind;
    EXPECT_LT(faces("loose"), 9) << kind;
  }
}

// Where each vertex has one normal, leaving the normals out would join none of them.
TEST(App_simplify, NamesTheOptionThatMakesNoSeamsOfNormals)
{
  const Workspace folder;
  Triangle_soup shaded = unshared(sheet(4, 4));
  for (Index t = 0; t < shaded.triangles.size(); ++t)
    for (Index k = 0; k < 3; ++k)
      shaded.normals.values.push_back({0.1 * k, 0.01 * t, 1});
  shaded.normals.of_triangle = shaded.triangles;
  write_mesh(folder / "in.ply", shaded);
  const App_result apart = run_app(
      {"simplify", folder / "in.ply", "-o", folder / "out.ply", "--ratio", "0.1", "--normals", "mend"});
  EXPECT_NE(apart.out.find("by normals that differ across edges, "), std::string::npos) << apart.out;
  EXPECT_NE(apart.out.find("; try --normals loose (to about 14 faces)\n"), std::string::npos) << apart.out;
  const std::string report = folder / "report.json";
  for (const std::string choice : {"loose", "auto"}) { // they differ too little to be hard edges
    const App_result loose =
        run_app({"simplify", folder / "in.ply", "-o", folder / "out.ply", "--ratio", "0.1", "--normals",
                 choice, "--report", report, "--log", folder / "log"});
    EXPECT_NE(loose.out.find("target 3 reached"), std::string::npos) << loose.out;
    EXPECT_EQ(loose.out.find("hard edges: hardly any") != std::string::npos, choice == "auto") << loose.out;
    EXPECT_EQ(nlohmann::json::parse(contents_of(report))["output"]["normals"], "picked");
    EXPECT_EQ(run_app({"verify", folder / "out.ply", "--against", folder / "in.ply"}).code, 0);
    EXPECT_EQ(run_app({"replay", folder / "in.ply", folder / "log"}).code, 0);
  }
  const std::string info = run_app({"info", folder / "in.ply"}).out;
  EXPECT_NE(info.find("seams: none (normals make none, as hardly any edge is hard)\n"), std::string::npos)
      << info;
  for (const std::string name : {"out.glb", "out.ply"}) {
    const std::string dropped =
        run_app({"simplify", folder / "in.ply", "-o", folder / name, "--ratio", "0.1", "--normals", "drop"})
            .out;
    EXPECT_EQ(dropped.find("shade every face flat") != std::string::npos, name == "out.glb") << dropped;
  }
}

// A texture is named before an option where its seams hold far more edges than that option is against.
TEST(App_simplify, NamesTheTextureThatHoldsMoreThanAnOptionLetsGo)
{
  const Workspace folder;
  const auto summary_of = [&](Index textured, Index shaded) {
    Triangle_soup soup = joined(sheet(textured, textured), moved(sheet(shaded, shaded), 0, 0, 3));
    const std::size_t of_textured = sheet(textured, textured).triangles.size();
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      const bool is_textured = t < of_textured;
      for (std::size_t k = 0; k < 3; ++k) {
        const Point_3& p = soup.points[soup.triangles[t][k]];
        soup.uvs.values.push_back({p.x() / 64, p.y() / 64 + (is_textured ? double(t) : 0)});
        soup.normals.values.push_back(is_textured
                                          ? std::array<double, 3>{p.x() / 10, 0, 1}
                                          : std::array<double, 3>{0.1 * double(k), 0.1 * double(t % 7), 1});
      }
      const Index first = Index(3 * t);
      soup.uvs.of_triangle.push_back({first, first + 1, first + 2});
    }
    soup.normals.of_triangle = soup.uvs.of_triangle;
    write_mesh(folder / "in.obj", soup);
    return run_app(
               {"simplify", folder / "in.obj", "-o", folder / "out.obj", "--faces", "1", "--normals", "mend"})
        .out;
  };
  const std::string of_texture = summary_of(20, 10), of_normals = summary_of(10, 20);
  EXPECT_NE(of_texture.find("; 1,160 edges of the input are seams because of texture and nothing else: "
                            "--drop-attribute texture lets them go (to about 260 faces), if nobody needs it; "
                            "try --normals loose against normals that differ across edges (to about "),
            std::string::npos)
      << of_texture;
  EXPECT_NE(of_normals.find("; try --normals loose (to about 300 faces)\n"), std::string::npos) << of_normals;
}

// A file without names has pieces all the same. The small one costs next to nothing.
TEST(App_simplify, NamesThePieceThatHasLostItsShape)
{
  const Workspace folder;
  const auto waves = [](Index size, double width) {
    Triangle_soup soup = test::sheet(size, size);
    for (Point_3& p : soup.points)
      p = Point_3(width * p.x(), width * p.y(), width * std::sin(p.x()) * std::sin(p.y()));
    return soup;
  };
  Triangle_soup soup = test::joined(test::moved(waves(12, 0.001), 0, 0, 3), waves(40, 1));
  write_mesh(folder / "in.off", soup);
  const auto summary_of = [&](const std::string& in) {
    return run_app({"simplify", folder / in, "-o", folder / ("out_" + in), "--ratio", "0.3"}).out;
  };
  std::string out = summary_of("in.off");
  EXPECT_NE(out.find("parts: the piece around (0.006, 0.006, "), std::string::npos) << out;
  EXPECT_NE(out.find(") keeps "), std::string::npos) << out;
  EXPECT_NE(out.find("in a group of its own, it could keep more by --ratio 'GROUP=R'"), std::string::npos);
  EXPECT_EQ(out.find("\npieces: "), std::string::npos) << out;

  const std::size_t waving = soup.triangles.size();
  soup = test::joined(soup, test::moved(test::sheet(5, 5), 0, 0, 9));
  soup.groups.names = {"waves", "flat"};
  soup.groups.of_triangle.assign(soup.triangles.size(), 1);
  std::fill_n(soup.groups.of_triangle.begin(), waving, Index(0));
  write_mesh(folder / "in.obj", soup);
  out = summary_of("in.obj");
  EXPECT_NE(out.find(") in group 'waves' keeps "), std::string::npos) << out;
}

// Every column of squares is an island of the texture.
TEST(App_simplify, SaysThatSeamsOfTheTextureTakeTheVertices)
{
  const Workspace folder;
  Triangle_soup soup = test::sheet(8, 32);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    Index_triple& corners = soup.uvs.of_triangle.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3& point = soup.points[soup.triangles[t][k]];
      corners[k] = Index(soup.uvs.values.size());
      soup.uvs.values.push_back({point.x() / 64 + double(t / 2 % 8) / 8, point.y() / 32});
    }
  }
  write_mesh(folder / "in.obj", soup);
  const auto summary = [&](const std::string& option, const std::string& value) {
    return run_app({"simplify", folder / "in.obj", "-o", folder / "out.obj", "--ratio", "0.5", option, value})
        .out;
  };
  const std::string kept = summary("--seam-turn", "90"), dropped = summary("--drop-attribute", "texture");
  EXPECT_NE(kept.find("left lie on its seams"), std::string::npos) << kept;
  EXPECT_NE(kept.find("--seam-turn 180"), std::string::npos) << kept;
  EXPECT_EQ(dropped.find("left lie on its seams"), std::string::npos) << dropped;
}

TEST(App_simplify, NamesNormalsThatGltfLacks)
{
  const Workspace folder;
  const std::string in = folder / "in.ply";
  const Triangle_soup bare = test::sheet(8, 8);
  write_mesh(in, bare);
  const auto says = [&](const std::string& out, std::vector<std::string> options) {
    options.insert(options.begin(), {"simplify", in, "-o", folder / out, "--ratio", "0.5"});
    return run_app(options).out.find("--normals smooth makes smooth ones") != std::string::npos;
  };
  EXPECT_TRUE(says("out.glb", {}));
  EXPECT_FALSE(says("out.ply", {}));
  EXPECT_FALSE(says("out.glb", {"--normals", "smooth"}));
  EXPECT_FALSE(says("out.glb", {"--progressive", folder / "steps.glb"})); // which refuses the option
}

// Nor does it name as lost what the input does not have.
TEST(App_simplify, NamesWhatTheOutputLosesAlone)
{
  const Workspace folder;
  const std::string obj = folder.generate("grid", "in.obj", 200), stl = folder / "in.stl",
                    out = folder / "out.stl";
  const App_result lost = run_app({"simplify", obj, "-o", stl, "--ratio", "1"});
  EXPECT_NE(lost.out.find("vertex numbers"), std::string::npos) << lost.out;
  const App_result none = run_app({"simplify", stl, "-o", out, "--ratio", "0.5", "--placement", "optimal"});
  EXPECT_EQ(none.out.find("not in the output"), std::string::npos) << none.out;
  EXPECT_EQ(none.out.find("attributes"), std::string::npos) << none.out;
}

// Returns the root mean square distance that a summary has, in per cent; -1 where it has none.
double rms_of(const std::string& summary)
{
  const std::string before = "distance from the original's vertices: ";
  const std::size_t place = summary.find(before);
  return place == std::string::npos ? -1 : std::stod(summary.substr(place + before.size()));
}

TEST(App_simplify, CallsADistanceOfRoundingSo)
{
  const Workspace folder;
  const std::string in = folder / "tilted.obj";
  std::ostringstream text;
  text.precision(17);
  constexpr int columns = 20;
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= columns; ++j)
      text << "v " << 0.1 * i << ' ' << 0.1 * j << ' ' << 0.1 * i / 3 + 0.1 * j / 7 << '\n';
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < columns; ++j) {
      const int a = (columns + 1) * i + j + 1, c = a + columns + 1;
      text << "f " << a << ' ' << c << ' ' << c + 1 << "\nf " << a << ' ' << c + 1 << ' ' << a + 1 << '\n';
    }
  write_text(in, text.str());
  const App_result result = run_app({"simplify", in, "-o", folder / "out.obj", "--ratio", "0.1"});
  EXPECT_NE(result.out.find("\ndistance from the original's vertices: no more than rounding\n"),
            std::string::npos)
      << result.out << result.err;
}

TEST(App_simplify, SaysNothingOfNormalsAndPolygonsThatTheFormatCannotHold)
{
  const Workspace folder;
  const std::string in = folder / "waves.obj";
  std::ostringstream text;
  constexpr int columns = 20;
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= columns; ++j)
      text << "v " << i << ' ' << j << ' ' << std::sin(i) << "\nvn " << -std::cos(i) << " 0 1\n";
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < columns; ++j) {
      text << 'f';
      for (const int corner : {0, columns + 1, columns + 2, 1}) {
        const int vertex = (columns + 1) * i + j + 1 + corner;
        text << ' ' << vertex << "//" << vertex;
      }
      text << '\n';
    }
  write_text(in, text.str());
  for (const auto& [name, has_normals, has_polygons] :
       {std::tuple("out.obj", true, true), std::tuple("out.off", false, true),
        std::tuple("out.glb", true, false), std::tuple("out.stl", false, false)}) {
    const std::string out = run_app({"simplify", in, "-o", folder / name, "--ratio", "0.5"}).out;
    EXPECT_EQ(out.find("\nnormals: fitted") != std::string::npos, has_normals) << out;
    EXPECT_EQ(out.find("\npolygons: ") != std::string::npos, has_polygons) << out;
  }
}

// Where a target is missed, the last faces cost much: they are kept. What the summary names lets most of them
// go.
TEST(App_simplify, KeepsFacesForTheShapeWhereATargetIsMissed)
{
  const Workspace folder;
  const std::string in = folder.generate("nested", "in.obj", 2000), out = folder / "out.obj",
                    log = folder / "out.log", report = folder / "report.json";
  const App_result kept =
      run_app({"simplify", in, "-o", out, "--ratio", "0.01", "--log", log, "--report", report});
  const std::string text =
      " faces that could go, because all that nothing holds would be flattened for them; --faces ";
  const std::size_t place = kept.out.find(text);
  ASSERT_NE(place, std::string::npos) << kept.out;
  const std::size_t named = std::stoul(kept.out.substr(place + text.size()));
  const auto json = [&] { return nlohmann::json::parse(contents_of(report)); };
  const auto target = json().at("target"), faces = json().at("faces");
  const std::size_t within_reach = target.at("within_reach");
  EXPECT_EQ(named, within_reach + (faces.at("output").get<std::size_t>() - within_reach + 2) / 3);
  EXPECT_EQ(target.at("reached"), false);
  EXPECT_NE(target.at("outcome"), "reached");
  EXPECT_EQ(faces.at("target"), 20);
  EXPECT_GT(faces.at("output"), 1.08 * double(within_reach));
  EXPECT_LT(faces.at("output"), 1.12 * double(within_reach));
  EXPECT_NE(kept.out.find(" edges left at " + std::to_string(within_reach) + " faces, "), std::string::npos);
  char seconds[32]; // of both reductions
  std::snprintf(seconds, sizeof seconds, " in %.3g s: ", json().at("seconds").at("reduce").get<double>());
  EXPECT_NE(kept.out.find(seconds), std::string::npos) << seconds << kept.out;
  EXPECT_EQ(run_app({"replay", in, log}).code, 0);

  const App_result flattened =
      run_app({"simplify", in, "-o", out, "--faces", std::to_string(named), "--report", report});
  EXPECT_EQ(json().at("target").at("reached"), true);
  EXPECT_GT(rms_of(kept.out), 0);
  EXPECT_LT(rms_of(kept.out), 0.95 * rms_of(flattened.out));

  for (const std::vector<std::string>& options : // there is no target or no room, or the target is met
       {std::vector<std::string>{"--error", "0.01"},
        {"--ratio", "0"},
        {"--ratio", "0.01", "--error", "none"},
        {"--ratio", "0.01", "--error", "0"},
        {"--ratio", "0.5"}}) {
    std::vector<std::string> arguments{"simplify", in, "-o", out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(run_app(arguments).out.find("\nkept: "), std::string::npos);
  }
}

// With the target that was possible on the way to another one, this jacket ends two faces above it, and keeps
// a tenth again.
TEST(App_simplify, NamesATargetThatIsReachedInAnotherOrder)
{
  const Workspace folder;
  const std::string in = folder.generate("jacket", "in.obj", 6000, 3), out = folder / "out.obj";
  const App_result kept = run_app({"simplify", in, "-o", out, "--ratio", "0.01"});
  const std::string text = " would be flattened for them; --faces ";
  const std::size_t place = kept.out.find(text);
  ASSERT_NE(place, std::string::npos) << kept.out;
  const std::string named = std::to_string(std::stoul(kept.out.substr(place + text.size())));
  EXPECT_EQ(run_app({"simplify", in, "-o", out, "--faces", named, "--require-target"}).code, 0) << named;
}

// Borders that keep every corner keep faces that a sphere needs more, unless somebody wants them to.
TEST(App_simplify, EasesBordersWhereATargetIsMissed)
{
  const Workspace folder;
  Generate_options of_sphere;
  of_sphere.faces = 2000;
  of_sphere.layers = 1;
  Triangle_soup soup = generate("nested", of_sphere);
  for (Point_3& p : soup.points)
    p = Point_3(2 * p.x(), 2 * p.y(), 2 * p.z());
  soup.uvs = {};
  soup.groups = {};
  constexpr int squares = 80;
  Triangle_soup strip = sheet(squares, 1);
  for (Point_3& p : strip.points)
    p = Point_3(0.05 * p.x() - 2, 0.2 * p.y() + (int(p.x()) % 2 == 0 ? 0.01 : -0.01), 0);
  for (int i = 0; i < 6; ++i)
    soup = joined(soup, moved(strip, 0, 2 + 0.5 * i, 0));
  const std::string in = folder / "in.obj", out = folder / "out.obj", log = folder / "out.log",
                    report = folder / "report.json";
  write_mesh(in, soup);
  const auto json = [&] { return nlohmann::json::parse(contents_of(report)); };
  const auto run = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"simplify", in, "-o", out, "--ratio", "0.05", "--report", report});
    return run_app(options).out;
  };
  const std::string eased = run({"--log", log});
  const double faces = json().at("faces").at("output");
  EXPECT_NE(eased.find("\neased: the turn of borders, whose corners keep faces that the rest needs more; "
                       "--border-turn 30 keeps them\n"),
            std::string::npos)
      << eased;
  EXPECT_EQ(json().at("target").at("eased_border_turn"), 180);
  EXPECT_EQ(run_app({"replay", in, log}).code, 0);

  const std::string strict = run({"--border-turn", "30"});
  EXPECT_NEAR(json().at("faces").at("output"), faces, 0.01 * faces);
  EXPECT_EQ(json().at("target").at("eased_border_turn"), nullptr);
  EXPECT_NE(strict.find("\nkept: "), std::string::npos);
  EXPECT_EQ(strict.find("\neased: "), std::string::npos);
  EXPECT_LT(rms_of(eased), 0.8 * rms_of(strict));
}

// Parts that stay have no shape to lose, and no options count the faces of those that are kept.
TEST(App_simplify, KeepsATenthOfTheFacesThatCanChangeForTheShape)
{
  const Workspace folder;
  Generate_options sphere;
  sphere.faces = 1000;
  sphere.layers = 1;
  Triangle_soup soup = generate("nested", sphere);
  soup.uvs = {};
  const std::size_t triangles = soup.triangles.size();
  soup = test::joined(soup, test::moved(soup, 5, 0, 0));
  soup.groups = {std::vector<Index>(2 * triangles, 0), {"left", "right"}};
  std::fill_n(soup.groups.of_triangle.begin(), triangles, Index(1));
  const std::string in = folder / "in.obj", out = folder / "out.obj", report = folder / "report.json";
  write_mesh(in, soup);
  const auto run = [&](const std::string& option, const std::vector<std::string>& target) {
    std::vector<std::string> arguments{"simplify", in, "-o", out, "--report", report, option, "right"};
    arguments.insert(arguments.end(), target.begin(), target.end());
    return run_app(arguments).out;
  };
  const auto json = [&] { return nlohmann::json::parse(contents_of(report)); };
  for (const std::string option : {"--keep", "--lock"}) {
    const std::string summary = run(option, {"--ratio", "0.001"});
    const std::string text = " lets most of them go", before = "--faces ";
    const std::size_t end = summary.find(text);
    ASSERT_NE(end, std::string::npos) << summary;
    const std::size_t begin = summary.rfind(before, end) + before.size();
    const std::size_t within_reach = json().at("target").at("within_reach"),
                      output = json().at("faces").at("output"), fixed = json().at("faces").at("fixed");
    EXPECT_EQ(fixed, triangles);
    const std::size_t left = within_reach - fixed;
    EXPECT_LE(output - fixed, left + (left + 9) / 10);
    EXPECT_GT(output, within_reach);
    const std::string faces = summary.substr(begin, end - begin);
    const std::string reached = run(option, {"--faces", faces});
    const std::string beside = " (--faces " + faces + ", and 1,000 of other parts) reached";
    EXPECT_EQ(reached.find(beside) != std::string::npos, option == "--keep") << reached;
    EXPECT_EQ(json().at("target").at("within_reach"), nullptr);
    const std::size_t asked = std::stoul(faces) + (option == "--keep" ? triangles : 0);
    EXPECT_LE(asked - json().at("faces").at("output").get<std::size_t>(), 1u); // of two faces, both go
    EXPECT_EQ(run(option, {"--error", "0.01"}).find("\nkept: "), std::string::npos) << "there is no target";
  }
}

// So are those of levels, and of parts with ratios of their own.
TEST(App_simplify, KeepsFacesForTheShapeOfLevelsAndParts)
{
  const Workspace folder;
  const std::string in = folder.generate("nested", "in.obj", 2000), report = folder / "report.json";
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"simplify", in, "--report", report});
    return run_app(arguments).out;
  };
  const auto kept_for = [](const std::string& summary, const std::string& option) {
    const std::string text =
        " faces that could go, because all that nothing holds would be flattened for them; " + option;
    const std::size_t place = summary.find(text);
    EXPECT_NE(place, std::string::npos) << summary;
    return place == std::string::npos ? 1 : std::stod(summary.substr(place + text.size()));
  };

  const std::string twice = run({"-o", folder / "twice_{lod}.obj", "--lods", "0.5,0.01,0.001"});
  const std::size_t said = twice.find("; the same mesh as the level before\nwritten: ");
  ASSERT_NE(said, std::string::npos) << twice;
  EXPECT_EQ(twice.find("; the same mesh", said + 1), std::string::npos);
  EXPECT_EQ(twice.find("\nkept: "), twice.rfind("\nkept: "));
  EXPECT_EQ(contents_of(folder / "twice_2.obj"), contents_of(folder / "twice_3.obj"));

  const std::string levels = folder / "{lod}.obj";
  const double level = kept_for(run({"-o", levels, "--lods", "0.5,0.01"}), "--lods ");
  const auto lods = nlohmann::json::parse(contents_of(report)).at("lods");
  EXPECT_EQ(lods[0].at("target").at("reached"), true);
  EXPECT_EQ(lods[0].at("target").at("within_reach"), nullptr);
  EXPECT_EQ(lods[1].at("target").at("reached"), false);
  EXPECT_GT(lods[1].at("faces").at("output"), 1.08 * double(lods[1].at("target").at("within_reach")));
  EXPECT_EQ(run({"-o", levels, "--lods", "0.5," + std::to_string(level)}).find("\nkept: "),
            std::string::npos);

  const std::string out = folder / "out.obj";
  const double ratio =
      kept_for(run({"-o", out, "--ratio", "0.5", "--ratio", "sphere_0=0.01"}), "--ratio 'sphere_0=");
  EXPECT_EQ(
      run({"-o", out, "--ratio", "0.5", "--ratio", "sphere_0=" + std::to_string(ratio)}).find("\nkept: "),
      std::string::npos);
  kept_for(run({"-o", out, "--ratio", "0.01", "--ratio", "sphere_0=0.5"}), "--ratio ");
  kept_for(run({"-o", out, "--faces", "10", "--ratio", "sphere_0=0.5"}), "--faces ");
}

// Where a file has every level on the way, no face is kept, and the summary says what helps.
TEST(App_simplify, SaysThatWhatIsNotHeldHasBeenFlattened)
{
  const Workspace folder;
  const std::string in = folder.generate("nested", "in.obj", 2000), out = folder / "out.obj";
  const std::string text = "\nflattened: all that nothing holds, as far as --error 0.01 allows; a ratio that "
                           "is larger by a tenth keeps more of its shape";
  const App_result result =
      run_app({"simplify", in, "-o", out, "--ratio", "0.01", "--progressive", folder / "all.glb"});
  EXPECT_NE(result.out.find(text), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("\nkept: "), std::string::npos);
}

// Where only a part has a ratio, nothing says how far to reduce the others.
TEST(App_simplify, KeepsAllButThePartsThatHaveARatio)
{
  const Workspace folder;
  const std::string in = folder.generate("nested", "in.obj", 2000), out = folder / "out.obj";
  const Triangle_soup original = read_mesh(in).soup;
  const App_result run = run_app({"simplify", in, "-o", out, "--ratio", "sphere_0=0.5", "--require-target"});
  EXPECT_EQ(run.code, 0) << run.err;
  const Triangle_soup result = read_mesh(out).soup;
  const auto faces_of_part = [](const Triangle_soup& soup) {
    const std::vector<char> is_named = triangles_named(soup, "sphere_0");
    return std::size_t(std::count(is_named.begin(), is_named.end(), char(true)));
  };
  EXPECT_EQ(faces_of_part(result), faces_of_part(original) / 2);
  EXPECT_EQ(result.triangles.size(), original.triangles.size() - faces_of_part(original) / 2);
}

// What it says is so; it is said where few faces are left, and where new places are allowed.
TEST(App_simplify, NamesThePlacementThatComesNearer)
{
  const Workspace folder;
  const std::string in = folder.generate("nested", "in.obj", 20000), out = folder / "out.obj";
  const auto run = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"simplify", in, "-o", out});
    return run_app(options).out;
  };
  const std::string advice = "; --placement optimal comes nearer\n";
  const std::string advised = run({"--ratio", "0.2", "--placement", "vertices"}),
                    followed = run({"--ratio", "0.2", "--placement", "optimal"});
  EXPECT_NE(advised.find(advice), std::string::npos) << advised;
  EXPECT_EQ(followed.find(advice), std::string::npos) << followed;
  EXPECT_LT(rms_of(followed), 0.8 * rms_of(advised));
  EXPECT_GT(rms_of(followed), 0);
  EXPECT_EQ(rms_of(run({"--ratio", "0.2"})), rms_of(followed)); // by default
  EXPECT_EQ(run({"--ratio", "0.3", "--placement", "vertices"}).find(advice), std::string::npos);
  EXPECT_EQ(run({"--ratio", "0.2", "--progressive", folder / "p.glb"}).find(advice), std::string::npos);
  const App_result levels =
      run_app({"simplify", in, "-o", folder / "{lod}.obj", "--lods", "0.2,0.1", "--placement", "vertices"});
  EXPECT_EQ(levels.out.find(advice), std::string::npos) << levels.out;
}

// The limit is small for the whole and large for the part. What the message names keeps more of the part; it
// is said of no part that has a ratio of its own, and of none where all keep the same share.
TEST(App_simplify, NamesThePartThatHasLostItsShape)
{
  const Workspace folder;
  const std::string ball = folder.generate("nested", "ball.obj", 2000, 1), in = folder / "in.obj",
                    out = folder / "out.obj", report = folder / "report.json";
  const Triangle_soup soup = read_mesh(ball).soup;
  const auto write = [&](double size_of_head) {
    std::ofstream stream(in);
    std::size_t first = 1;
    for (const auto& [name, size] : {std::pair("body", 1.0), std::pair("head", size_of_head)}) {
      stream << "g " << name << '\n';
      for (const Point_3& p : soup.points)
        stream << "v " << size * p.x() << ' ' << size * p.y() << ' ' << size * p.z() + 8 * first << '\n';
      for (const auto& [a, b, c] : soup.triangles)
        stream << "f " << first + a << ' ' << first + b << ' ' << first + c << '\n';
      first += soup.points.size();
    }
  };
  const auto run = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"simplify", in, "-o", out, "--ratio", "0.1", "--report", report};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_app(arguments).out;
  };
  const auto faces_of_head = [&] {
    const nlohmann::json written = nlohmann::json::parse(contents_of(report));
    for (const nlohmann::json& part : written["parts"])
      if (part["name"] == "head")
        return part["faces"]["output"].get<std::size_t>();
    return std::size_t(0);
  };
  write(0.05);
  const std::string coarse = run({});
  EXPECT_NE(coarse.find("\nparts: group 'head' keeps "), std::string::npos) << coarse;
  EXPECT_NE(coarse.find("; --ratio 'head=0.2' keeps more of it\n"), std::string::npos) << coarse;
  const std::size_t few = faces_of_head();
  const std::string helped = run({"--ratio", "head=0.2"});
  EXPECT_EQ(helped.find("\nparts: "), std::string::npos) << helped;
  EXPECT_GT(faces_of_head(), 4 * few);
  EXPECT_EQ(run({"--cells"}).find("\nparts: "), std::string::npos);
  write(1);
  EXPECT_EQ(run({}).find("\nparts: "), std::string::npos);
}

// The target of the whole is for what belongs to no part with a ratio of its own.
TEST(App_simplify, BlamesNoPartThatIsAtItsOwnTarget)
{
  const Workspace folder;
  const std::string in = folder / "in.obj", out = folder / "out.obj";
  write_text(in, contents_of(folder.generate("grid", "grid.obj", 200)) +
                     "g rest\nv 9 9 9\nv 8 9 9\nv 9 8 9\nf -3 -2 -1\n");
  const std::string held = run_app({"simplify", in, "-o", out, "--ratio", "0", "--ratio", "grid=0.5"}).out;
  EXPECT_NE(held.find(" left in parts above their target, "), std::string::npos) << held;
  EXPECT_EQ(held.find("; try "), std::string::npos) << held;
}

} // namespace
} // namespace selvedge::test
