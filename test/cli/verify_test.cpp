// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"

#include "soup/selection.h"
#include "support/doubles.h"
#include <selvedge/mesh_files.h>
#include <selvedge/verify.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace selvedge::test {
namespace {

const char* const crossing = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 1\nv 9 9 0\nf 1 2 3\nf 4 5 6\n";
const char* const apart = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 1\nv 1 1 3\nv 9 9 2\nf 1 2 3\nf 4 5 6\n";

TEST(App_verify, EmbeddedIsGood)
{
  const Workspace folder;
  const App_result result = run_app({"verify", folder.generate("skirt", "in.obj", 1000)});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("embedded: no triangles touch or cross, and none is degenerate"),
            std::string::npos)
      << result.out;
}

TEST(App_verify, NamesWhatOffends)
{
  const Workspace folder;
  write_text(folder / "in.obj", crossing);
  const App_result result = run_app({"verify", folder / "in.obj"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("triangles 1 and 2 intersect"), std::string::npos) << result.out;
}

TEST(App_verify, AgainstTheOriginalOnlyNewPairsCount)
{
  const Workspace folder;
  write_text(folder / "crossing.obj", crossing);
  write_text(folder / "apart.obj", apart);
  EXPECT_EQ(run_app({"verify", folder / "crossing.obj", "--against", folder / "crossing.obj"}).code, 0);
  EXPECT_EQ(run_app({"verify", folder / "crossing.obj", "--against", folder / "apart.obj"}).code, 1);
  EXPECT_EQ(run_app({"verify", folder / "apart.obj", "--against", folder / "crossing.obj"}).code, 0);
}

TEST(App_verify, ComparesARoundedResultWithTheRoundedOriginal)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 2000), out = folder / "out.glb";
  ASSERT_EQ(run_app({"simplify", in, "-o", out, "--ratio", "0.5", "--quiet"}).code, 0);
  const App_result result = run_app({"verify", out, "--against", in});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out.find(": 0 of"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(" are the original's, bit for bit"), std::string::npos) << result.out;
}

// The transforms of nodes bring vertices to places that are no 32-bit floats.
TEST(App_verify, ComparesARoundedResultWithARoundedScene)
{
  const Workspace folder;
  const std::string in = folder.generate("nested", "in.gltf", 400);
  nlohmann::json document = nlohmann::json::parse(contents_of(in));
  for (nlohmann::json& node : document.at("nodes"))
    node["scale"] = {1.1, 1.1, 1.1};
  write_text(in, document.dump());
  for (const char* name : {"out.stl", "out.ply", "out.obj"}) {
    const std::string out = folder / name;
    ASSERT_EQ(run_app({"simplify", in, "-o", folder / "small.stl", "--ratio", "0.8", "--quiet"}).code, 0);
    ASSERT_EQ(run_app({"simplify", folder / "small.stl", "-o", out, "--ratio", "1", "--quiet"}).code, 0);
    const App_result result = run_app({"verify", out, "--against", in});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("the original was rounded"), std::string::npos) << result.out;
  }
}

TEST(App_verify, PartsThatMayIntersectNeedNames)
{
  const Workspace folder;
  const std::string named = std::string(crossing).insert(std::string(crossing).find("f 4"), "g b\n");
  write_text(folder / "in.obj", std::string(named).insert(named.find("f 1"), "g a\n"));
  write_text(folder / "out.off", "OFF\n6 2 0\n0 0 0\n4 0 0\n0 4 0\n1 1 -1\n1 1 1\n9 9 0\n3 0 1 2\n3 3 4 5\n");
  EXPECT_EQ(run_app({"verify", folder / "in.obj", "--may-intersect", "a:b"}).code, 0);
  expect_refused({"verify", folder / "out.off", "--against", folder / "in.obj", "--may-intersect", "a:b"}, 2,
                 "out.off holds no names of parts");
  expect_refused({"verify", folder / "in.obj", "--may-intersect", "a:c"}, 2, "'c'");
}

TEST(App_verify, PiecesNearerThanAClearanceAreNotVerified)
{
  const Workspace folder;
  write_text(folder / "apart.obj", apart);
  write_text(folder / "nearer.obj",
             "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 0.5\nv 1 1 3\nv 9 9 2\nf 1 2 3\nf 4 5 6\n");
  EXPECT_EQ(run_app({"verify", folder / "apart.obj", "--clearance", "1"}).code, 0);
  const App_result result = run_app({"verify", folder / "apart.obj", "--clearance", "1.5"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("1 pair of pieces nearer than 1.5; the least distance is 1\n"), std::string::npos)
      << result.out;
  const auto against = [&](const char* mesh) {
    return run_app({"verify", folder / mesh, "--against", folder / "apart.obj", "--clearance", "1.5"}).code;
  };
  EXPECT_EQ(against("apart.obj"), 0);
  EXPECT_EQ(against("nearer.obj"), 1);
}

TEST(App_verify, AsksWhetherTheObstacleIsInAnotherUnitOrPlace)
{
  const Workspace folder;
  const auto triangle = [](const std::string& size, const std::string& z) {
    return "v 0 0 " + z + "\nv " + size + " 0 " + z + "\nv 0 " + size + ' ' + z + "\nf 1 2 3\n";
  };
  write_text(folder / "cloth.obj", triangle("1", "1"));
  const auto asks = [&](const std::string& body, const std::string& question) {
    write_text(folder / "body.obj", body);
    const std::string verify =
                          run_app({"verify", folder / "cloth.obj", "--obstacle", folder / "body.obj"}).out,
                      simplify = run_app({"simplify", folder / "cloth.obj", "-o", folder / "out.obj",
                                          "--ratio", "1", "--obstacle", folder / "body.obj"})
                                     .out;
    const bool in_verify = verify.find(question) != std::string::npos;
    EXPECT_EQ(in_verify, simplify.find(question) != std::string::npos) << verify << simplify;
    return in_verify;
  };
  EXPECT_TRUE(
      asks(triangle("100", "1.5"), "100 times as large as the mesh; is one of the two in another unit?"));
  EXPECT_TRUE(
      asks(triangle("0.01", "1"), "100 times smaller than the mesh; is one of the two in another unit?"));
  EXPECT_TRUE(asks(triangle("2", "1.5"), "away from the mesh (their boxes are apart)"));
  EXPECT_FALSE(asks(triangle("2", "1"), "another unit"));
  write_text(folder / "pose.obj", triangle("100", "1"));
  const std::string of_pose = run_app({"simplify", folder / "cloth.obj", "-o", folder / "out.obj", "--ratio",
                                       "1", "--pose", folder / "pose.obj"})
                                  .out;
  EXPECT_NE(of_pose.find("pose 'pose' is 100 times as large as the mesh; is one"), std::string::npos)
      << of_pose;
}

TEST(App_verify, WhatTouchesAnObstacleIsNotVerified)
{
  const Workspace folder;
  write_text(folder / "cloth.obj", "v 0 0 1\nv 4 0 1\nv 0 4 1\nf 1 2 3\n");
  write_text(folder / "torn.obj", "v 0 0 0.4\nv 4 0 1\nv 0 4 1\nf 1 2 3\n");
  // Two triangles that cross each other, below the first mesh and through the second.
  write_text(folder / "body.obj",
             "v 0 0 0.5\nv 9 0 0.5\nv 0 9 0.5\nv 3 3 0\nv 3 3 0.9\nv 9 9 0\nf 1 2 3\nf 4 5 6\n");
  const App_result clear = run_app({"verify", folder / "cloth.obj", "--obstacle", folder / "body.obj"});
  EXPECT_EQ(clear.code, 0) << clear.out;
  EXPECT_NE(clear.out.find("embedded: no triangles touch or cross each other or the obstacle"),
            std::string::npos)
      << clear.out;
  const App_result torn = run_app({"verify", folder / "torn.obj", "--obstacle", folder / "body.obj"});
  EXPECT_EQ(torn.code, 1);
  const std::string pair = "triangle 1 and triangle 1 of the obstacle intersect";
  EXPECT_NE(torn.out.find(pair), std::string::npos) << torn.out;
  run_app({"simplify", folder / "torn.obj", "-o", folder / "out.obj", "--ratio", "1", "--obstacle",
           folder / "body.obj", "--html", folder / "page.html"});
  EXPECT_NE(contents_of(folder / "page.html").find(pair), std::string::npos);
  const auto against = [&](const char* original) {
    return run_app(
        {"verify", folder / "torn.obj", "--against", folder / original, "--obstacle", folder / "body.obj"});
  };
  EXPECT_EQ(against("cloth.obj").code, 1);
  EXPECT_NE(against("cloth.obj").out.find("1 offending pair, 1 of them not in the original"),
            std::string::npos);
  EXPECT_EQ(against("torn.obj").code, 0);
  EXPECT_EQ(run_app({"verify", folder / "torn.obj", "--obstacle", folder / "none.obj"}).code, 3);
}

TEST(App_verify, AgainstTheOriginalTopologyCounts)
{
  const Workspace folder;
  write_text(folder / "one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_text(folder / "apart.obj", apart);
  const App_result result = run_app({"verify", folder / "one.obj", "--against", folder / "apart.obj"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("topology CHANGED"), std::string::npos) << result.out;
  // What is wrong is not the topology: the vertices of an edge come twice, and all faces are turned.
  write_text(folder / "square.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  write_text(folder / "turned.obj",
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 2 1 3\nf 4 5 6\n");
  const App_result turned = run_app({"verify", folder / "turned.obj", "--against", folder / "square.obj"});
  EXPECT_EQ(turned.code, 1);
  EXPECT_NE(turned.out.find("outsides on different sides\ntopology: the files number vertices differently"),
            std::string::npos)
      << turned.out;
}

TEST(App_verify, SaysTheSameInJson)
{
  const Workspace folder;
  write_text(folder / "in.obj", crossing);
  const App_result printed = run_app({"verify", folder / "in.obj", "--against", folder / "in.obj", "--json"});
  EXPECT_EQ(printed.code, 0);
  const nlohmann::json report = nlohmann::json::parse(printed.out);
  EXPECT_EQ(report["verified"]["pairs"], 1);
  EXPECT_EQ(report["verified"]["new_pairs"], 0);
  EXPECT_EQ(report["topology"]["same"], true);
  EXPECT_EQ(report["distance"]["original_to_result"]["max"], 0);
  EXPECT_EQ(run_app({"verify", folder / "in.obj", "--report", folder / "r.json"}).code, 1);
  EXPECT_EQ(
      nlohmann::json::parse(contents_of(folder / "r.json"))["verified"]["first_new_pairs"][0]["offence"],
      "intersection");
}

// Two bumps, each pulled through the patch under it: embedded, and with the same topology.
TEST(App_verify, LayersThatChangedPlacesAreNotVerified)
{
  const Workspace folder;
  const std::string in = folder.generate("tunnel", "in.obj", 100);
  const std::string out = folder / "out.obj";
  run_app(
      {"simplify", in, "-o", out, "--ratio", "0", "--error", "none", "--no-intersection-check", "--quiet"});
  EXPECT_EQ(run_app({"verify", out}).code, 0);
  const App_result result = run_app({"verify", out, "--against", in});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("layers CHANGED PLACES: "), std::string::npos) << result.out;
  const nlohmann::json report =
      nlohmann::json::parse(run_app({"verify", out, "--against", in, "--json"}).out);
  EXPECT_EQ(report["exit_code"], 1);
  EXPECT_EQ(report["verified"]["embedded"], true);
  EXPECT_EQ(report["topology"]["same"], true);
  EXPECT_GT(report["layers"]["swaps"], 0);
  EXPECT_EQ(report["layers"]["first_swaps"].size(), std::min<std::size_t>(100, report["layers"]["swaps"]));

  // What intersects elsewhere in the original takes no order away.
  const std::string cross =
      "v 0 0 30\nv 1 0 30\nv 0 1 30\nv .1 .1 29\nv .1 .1 31\nv .2 .1 30\nf -6 -5 -4\nf -3 -2 -1\n";
  for (const std::string& mesh : {in, out})
    write_text(mesh, contents_of(mesh) + cross);
  const App_result crossed = run_app({"verify", out, "--against", in});
  EXPECT_NE(crossed.out.find("layers CHANGED PLACES: "), std::string::npos) << crossed.out;
  EXPECT_EQ(crossed.out.find("intersect nearby in the original"), std::string::npos) << crossed.out;
}

/// Without the triangles of one piece.
Triangle_soup without_piece(Triangle_soup soup, Index number)
{
  const Piece gone = pieces(soup).at(number);
  std::vector<Index> kept;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    if (t < gone.first_triangle || t >= gone.first_triangle + gone.faces)
      kept.push_back(t);
  keep_triangles(soup, kept);
  return soup;
}

TEST(App_verify, ALayerThatIsMissingOrReplacedIsNotVerified)
{
  const Workspace folder;
  const std::string in = folder.generate("sheets", "in.obj", 1000, 3), small = folder / "small.obj";
  ASSERT_EQ(run_app({"simplify", in, "-o", small, "--ratio", "0.3", "--quiet"}).code, 0);
  Triangle_soup soup = without_piece(read_mesh(small).soup, 1);
  const std::string wrong = folder / "wrong.off";
  write_mesh(wrong, soup);
  const App_result missing = run_app({"verify", wrong, "--against", in});
  EXPECT_EQ(missing.code, 1);
  EXPECT_NE(missing.out.find("  piece 2 ("), std::string::npos) << missing.out;
  EXPECT_NE(missing.out.find(") of the original is not in the result"), std::string::npos) << missing.out;

  // A triangle elsewhere has the kind of the layer that is gone.
  const Index first = Index(soup.points.size());
  for (const Point_3& corner : {Point_3(50, 50, 50), Point_3(51, 50, 50), Point_3(50, 51, 50)})
    soup.points.push_back(corner);
  Triangle_soup replaced;
  replaced.points = soup.points;
  replaced.triangles = soup.triangles;
  replaced.triangles.push_back({first, first + 1, first + 2});
  write_mesh(wrong, replaced);
  const App_result elsewhere = run_app({"verify", wrong, "--against", in});
  EXPECT_EQ(elsewhere.code, 1);
  EXPECT_NE(elsewhere.out.find("topology: as in the original"), std::string::npos) << "the control";
  EXPECT_NE(elsewhere.out.find("pieces WRONG"), std::string::npos) << elsewhere.out;
  EXPECT_NE(elsewhere.out.find("(1 face around (50.5, 50.5, 50)) of the result is no piece of the original"),
            std::string::npos)
      << elsewhere.out;
  const nlohmann::json report =
      nlohmann::json::parse(run_app({"verify", wrong, "--against", in, "--json"}).out);
  EXPECT_EQ(report["matching"]["complete"], false);
  EXPECT_EQ(report["matching"]["mismatches"], 2);
  EXPECT_EQ(report["matching"]["first_mismatches"][0]["what"], "missing");
  EXPECT_EQ(report["matching"]["first_mismatches"][0]["of_original"], nlohmann::json::array({2}));
  EXPECT_EQ(report["matching"]["first_mismatches"][1]["what"], "added");
}

TEST(App_verify, ExchangedNamesAreNotVerified)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 3000, 3), small = folder / "small.obj";
  ASSERT_EQ(run_app({"simplify", in, "-o", small, "--ratio", "0.3", "--quiet"}).code, 0);
  Triangle_soup soup = read_mesh(small).soup;
  std::vector<std::string>& names = soup.groups.names;
  const auto lining = std::find(names.begin(), names.end(), "lining_front"),
             shell = std::find(names.begin(), names.end(), "shell_front");
  ASSERT_TRUE(lining != names.end() && shell != names.end());
  std::swap(*lining, *shell);
  write_mesh(folder / "wrong.obj", soup);
  const App_result result = run_app({"verify", folder / "wrong.obj", "--against", in});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("of the result is 'lining_front', where the original has 'shell_front'"),
            std::string::npos)
      << result.out;
}

// Files that number vertices in other ways, hold floats, or know no names.
TEST(App_verify, AcceptsWhatSimplifyMakesInEveryFormat)
{
  const Workspace folder;
  for (const char* const scene : {"skirt", "nested"}) {
    const std::string in = folder.generate(scene, std::string(scene) + ".obj", 700, 3);
    for (const char* const format : {"obj", "stl", "glb"}) {
      const std::string out = folder / (std::string("out.") + format);
      for (const bool is_sewn : {false, true}) {
        if (is_sewn && format == std::string("stl"))
          continue; // refused
        std::vector<std::string> command{"simplify", in, "-o", out, "--ratio", "0.3", "--quiet"};
        if (is_sewn)
          command.push_back("--sewn");
        ASSERT_EQ(run_app(command).code, 0);
        const App_result result = run_app({"verify", out, "--against", in});
        EXPECT_EQ(result.code, 0) << scene << ' ' << format << ' ' << is_sewn << '\n' << result.out;
      }
    }
  }
}

TEST(App_verify, CountsDoublesThatTheFileNumbersApart)
{
  const Workspace folder;
  write_mesh(folder / "original.ply", original_with_double());
  write_mesh(folder / "result.ply", reduced_double());
  write_mesh(folder / "spoiled.ply", with_double({}, 0));
  const App_result right = run_app({"verify", folder / "result.ply", "--against", folder / "original.ply"});
  EXPECT_NE(right.out.find("pieces: all match those of the original; matched 2 by positions"),
            std::string::npos)
      << right.out;
  const App_result wrong = run_app({"verify", folder / "spoiled.ply", "--against", folder / "original.ply"});
  EXPECT_NE(wrong.out.find("pieces WRONG"), std::string::npos) << wrong.out;
  EXPECT_EQ(wrong.code, 1);
}

TEST(App_verify, ComparesColoursInOneScale)
{
  const Workspace folder;
  const auto ply = [](const std::string& type, const std::vector<std::string>& colours) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex 4\n";
    for (const char* const name : {"float x", "float y", "float z"})
      text += "property " + std::string(name) + '\n';
    for (const char* const name : {" red", " green", " blue"})
      text += "property " + type + name + '\n';
    text += "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const char* const places[] = {"0 0 0 ", "1 0 0 ", "0 1 0 ", "1 1 0 "};
    for (std::size_t v = 0; v < 4; ++v)
      text += places[v] + colours[v] + '\n';
    return text + "3 0 1 2\n3 2 1 3\n";
  };
  const std::string bytes = folder / "bytes.ply", obj = folder / "fractions.obj";
  write_text(bytes, ply("uchar", {"10 20 30", "1 255 77", "128 0 9", "200 3 55"}));
  ASSERT_EQ(run_app({"simplify", bytes, "-o", obj, "--ratio", "1", "--quiet"}).code, 0);
  write_text(folder / "rounded.obj", "v 0 0 0 0.0392 0.0784 0.1176\nv 1 0 0 0.0039 1 0.302\n"
                                     "v 0 1 0 0.502 0 0.0353\nv 1 1 0 0.7843 0.0118 0.2157\n"
                                     "f 1 2 3\nf 3 2 4\n");
  write_text(folder / "floats.ply", ply("float", {"0.0392 0.0784 0.1176", "0.0039 1 0.302", "0.502 0 0.0353",
                                                  "0.7843 0.0118 0.2157"}));
  write_text(folder / "shorts.ply",
             ply("ushort", {"2570 5140 7710", "257 65535 19789", "32896 0 2313", "51400 771 14135"}));
  write_text(folder / "changed.obj", "v 0 0 0 0.0392 0.0784 0.1176\nv 1 0 0 0.0039 1 0.302\n"
                                     "v 0 1 0 0.502 0 0.0353\nv 1 1 0 0.7843 0.0118 0.3\n"
                                     "f 1 2 3\nf 3 2 4\n");
  write_text(folder / "up_to_255.obj", "v 0 0 0 10 20 30\nv 1 0 0 1 255 77\nv 0 1 0 128 0 9\n"
                                       "v 1 1 0 200 3 55\nf 1 2 3\nf 3 2 4\n");
  write_text(folder / "ints.ply", ply("int", {"10 20 30", "1 255 77", "128 0 9", "200 3 55"}));
  const std::string glb = folder / "fractions.glb";
  ASSERT_EQ(run_app({"simplify", folder / "up_to_255.obj", "-o", glb, "--ratio", "1", "--quiet"}).code, 0);
  const auto verdict = [&](const std::string& mesh, const std::string& original) {
    const App_result result = run_app({"verify", mesh, "--against", original});
    EXPECT_EQ(result.code, 0) << result.out;
    return result.out;
  };
  const char* const wrong = "values are NOT the original's";
  for (const char* const original : {"up_to_255.obj", "ints.ply"})
    EXPECT_EQ(verdict(glb, folder / original).find(wrong), std::string::npos) << original;
  for (const std::string& other : {obj, folder / "rounded.obj", folder / "floats.ply", folder / "shorts.ply",
                                   folder / "up_to_255.obj", folder / "ints.ply"}) {
    EXPECT_EQ(verdict(other, bytes).find(wrong), std::string::npos) << other;
    EXPECT_EQ(verdict(bytes, other).find(wrong), std::string::npos) << other;
  }
  EXPECT_EQ(verdict(folder / "floats.ply", folder / "rounded.obj").find(wrong), std::string::npos);
  EXPECT_NE(verdict(folder / "changed.obj", bytes).find("blue: 1 of 4 " + std::string(wrong)),
            std::string::npos);
  EXPECT_NE(verdict(folder / "rounded.obj", obj).find(wrong), std::string::npos)
      << "in one type, values are compared bit for bit";
}

TEST(App_verify, AcceptsClosedSeamsThatItIsToldOf)
{
  const Workspace folder;
  // Two squares with a gap of 0.0625 between them.
  write_text(folder / "in.obj",
             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1.0625 0 0\nv 2 0 0\nv 2 1 0\nv 1.0625 1 0\n"
             "f 1 2 3 4\nf 5 6 7 8\n");
  const auto verdict = [&](const std::string& out, bool is_sewn, const std::vector<std::string>& weld) {
    std::vector<std::string> command{"simplify", folder / "in.obj", "-o",    folder / out, "--ratio",
                                     "1",        "--weld",          "0.125", "--quiet"};
    if (is_sewn)
      command.push_back("--sewn");
    EXPECT_EQ(run_app(command).code, 0);
    std::vector<std::string> judged{"verify", folder / out, "--against", folder / "in.obj"};
    judged.insert(judged.end(), weld.begin(), weld.end());
    return run_app(judged);
  };
  EXPECT_EQ(verdict("out.obj", false, {}).code, 0) << "pieces stay apart by vertex numbers";
  for (const char* const out : {"out.stl", "sewn.obj"}) {
    const App_result refused = verdict(out, out[0] == 's', {});
    EXPECT_EQ(refused.code, 1);
    EXPECT_NE(refused.out.find("give the weld distance"), std::string::npos) << refused.out;
    const App_result accepted = verdict(out, out[0] == 's', {"--weld", "0.125"});
    EXPECT_EQ(accepted.code, 0) << accepted.out;
    EXPECT_NE(accepted.out.find("whose borders were joined, and whether these borders should have been"),
              std::string::npos)
        << accepted.out;
    for (const char* const too_near : {"0.01", "0.04", "0.0624"})
      EXPECT_EQ(verdict(out, out[0] == 's', {"--weld", too_near}).code, 1);
  }
}

TEST(App_verify, ListsWhatItCannotSee)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 1000);
  const App_result named = run_app({"verify", in, "--against", in});
  EXPECT_EQ(named.code, 0);
  EXPECT_NE(named.out.find("what this cannot see:\n  - what happened on the way"), std::string::npos)
      << named.out;
  EXPECT_EQ(named.out.find("exchanged names of groups"), std::string::npos) << named.out;
  ASSERT_EQ(run_app({"simplify", in, "-o", folder / "out.off", "--ratio", "1", "--quiet"}).code, 0);
  const nlohmann::json report =
      nlohmann::json::parse(run_app({"verify", folder / "out.off", "--against", in, "--json"}).out);
  const auto& lines = report["cannot_see"];
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const nlohmann::json& line) {
    return line.get<std::string>().find("exchanged names of groups") == 0;
  })) << lines;
  EXPECT_EQ(run_app({"verify", in}).out.find("what this cannot see"), std::string::npos);
}

TEST(App_verify, SaysWhatIsLeftOfTheOriginal)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 2000);
  const std::string out = folder / "out.obj", bare = folder / "out.off";
  ASSERT_EQ(run_app({"simplify", in, "-o", out, "--ratio", "0.5", "--quiet"}).code, 0);
  ASSERT_EQ(run_app({"simplify", in, "-o", bare, "--ratio", "0.5", "--quiet"}).code, 0);
  const App_result kept = run_app({"verify", out, "--against", in});
  EXPECT_EQ(kept.code, 0) << kept.out;
  EXPECT_NE(kept.out.find("are the original's, bit for bit"), std::string::npos) << kept.out;
  EXPECT_NE(kept.out.find("layers: no two changed places (compared along "), std::string::npos) << kept.out;
  EXPECT_EQ(kept.out.find("LOST"), std::string::npos) << kept.out;
  EXPECT_EQ(kept.out.find("GAPS"), std::string::npos) << kept.out;
  const App_result lost = run_app({"verify", bare, "--against", in});
  EXPECT_NE(lost.out.find("attributes LOST: uv, group"), std::string::npos) << lost.out;
}

TEST(App_verify, TellsOfGaps)
{
  const Workspace folder;
  // Two squares that share two edges by position; in the other file one of them has moved aside.
  const std::string faces = "f 1 2 3\nf 1 3 4\nf 1 4 5\nf 6 7 8\nf 6 8 9\nf 6 9 10\n";
  const std::string left = "v 0 0 0\nv 1 0 0\nv 1 0.5 0\nv 1 1 0\nv 0 1 0\n";
  write_text(folder / "in.obj", left + "v 2 1 0\nv 1 1 0\nv 1 0.5 0\nv 1 0 0\nv 2 0 0\n" + faces);
  write_text(folder / "out.obj",
             left + "v 2 1 0\nv 1.0625 1 0\nv 1.0625 0.5 0\nv 1.0625 0 0\nv 2 0 0\n" + faces);
  const App_result result = run_app({"verify", folder / "out.obj", "--against", folder / "in.obj"});
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.out.find("GAPS: 4 edges of seams open"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("seams: 2 edges before, none now"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("vertices: 7 of 10 are"), std::string::npos) << result.out;

  // It stays where it is, but has one edge along the seam where the other has two.
  write_text(folder / "out.obj",
             left + "v 2 1 0\nv 1 1 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 3 4\nf 1 4 5\nf 6 7 8\nf 6 8 9\n");
  const App_result touching = run_app({"verify", folder / "out.obj", "--against", folder / "in.obj"});
  EXPECT_NE(touching.out.find("GAPS: 3 edges of seams open"), std::string::npos) << touching.out;
  EXPECT_NE(touching.out.find(" long in all, but not wide: "), std::string::npos) << touching.out;
}

TEST(App_verify, RefusesOptionsOfAnOriginalWithoutOne)
{
  const Workspace folder;
  const std::string mesh = folder.generate("skirt", "in.obj", 600);
  for (const auto& [option, value] :
       {std::pair("--against-pose", folder / "absent.obj"), std::pair("--weld", std::string("0")),
        std::pair("--drop-attribute", std::string("texture")), std::pair("--drop-part", std::string("grid")),
        std::pair("--drop-smaller", std::string("0.1"))})
    expect_refused({"verify", mesh, option, value}, 2,
                   std::string(option) + ": there is no original; give --against FILE");
}

TEST(App_verify, RefusesUnreadableInput)
{
  const Workspace folder;
  expect_refused({"verify", folder / "absent.obj"}, 3, "absent.obj");
  write_text(folder / "in.obj", apart);
  expect_refused({"verify", folder / "in.obj", "--against", folder / "absent.ply"}, 3, "absent.ply");
  expect_refused({"verify", folder / "in.obj", "--report", folder / "in.obj"}, 2, "--report");
  expect_refused({"verify", folder / "in.obj", "--report", folder / "none/r.json"}, 4, "r.json");
}

} // namespace
} // namespace selvedge::test
