// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"
#include "support/soups.h"

#include <selvedge/mesh_files.h>
#include <selvedge/verify.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

namespace selvedge::test {
namespace {

using Position = std::array<double, 3>;

std::set<Position> positions(const Triangle_soup& soup)
{
  std::set<Position> result;
  for (const Point_3& p : soup.points)
    result.insert({p.x(), p.y(), p.z()});
  return result;
}

TEST(App_simplify, ReducesVerifiesAndSaysSo)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 3000);
  const App_result result =
      run_app({"simplify", in, "-o", folder / "out.obj", "--ratio", "0.6", "--placement", "vertices"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* word :
       {"reduced to", "target 1,800 reached\njudged: embedded (no triangles touch or cross), topology kept\n",
        "written: "})
    EXPECT_NE(result.out.find(word), std::string::npos) << result.out;
  const Triangle_soup before = read_mesh(in).soup, after = read_mesh(folder / "out.obj").soup;
  EXPECT_LE(after.triangles.size(), before.triangles.size() * 6 / 10 + 1);
  EXPECT_TRUE(verify(after, before).accepted());
  EXPECT_EQ(folder.files(), 2u);
}

TEST(App_simplify, PutsVerticesToNewPlacesUnlessThoseOfTheInputAreNeeded)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.ply", 1000),
                    scene = folder.generate("skirt", "in.glb", 1000);
  const auto placement = [&](std::vector<std::string> arguments) {
    const std::string report = folder / "report.json";
    arguments.insert(arguments.begin(), "simplify");
    arguments.insert(arguments.end(), {"--report", report, "--quiet"});
    const App_result result = run_app(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    const nlohmann::json json = nlohmann::json::parse(contents_of(report));
    EXPECT_EQ(json["options"]["placement"], "auto");
    EXPECT_EQ(json["vertices"]["placed"] > 0, json["output"]["placement"] == "optimal");
    return json["output"]["placement"].get<std::string>();
  };
  const std::string out = folder / "out.ply", levels = folder / "levels.glb";
  EXPECT_EQ(placement({in, "-o", out, "--ratio", "0.5"}), "optimal");
  EXPECT_EQ(placement({in, "-o", out, "--ratio", "0.5", "--cells"}), "optimal");
  EXPECT_EQ(placement({scene, "-o", folder / "{lod}.glb", "--lods", "0.8,0.5"}), "optimal");
  EXPECT_EQ(placement({scene, "-o", levels, "--lods", "0.8,0.5"}), "vertices");
  EXPECT_EQ(placement({in, "-o", out, "--ratio", "0.5", "--pose", in}), "vertices");
  EXPECT_EQ(placement({in, "-o", out, "--ratio", "0.5", "--progressive", levels}), "vertices");
  EXPECT_EQ(run_app({"cells", "cut", in, "-o", folder / "cell_{cell}.ply", "--cells", "2"}).code, 0);
  EXPECT_EQ(placement({folder / "cell_1.ply", "-o", out, "--ratio", "0.5", "--keep", "fixed"}), "vertices");
}

// A mesh of more faces than are reduced for their looks.
TEST(App_simplify, PutsVerticesOfLargeMeshesToThoseOfTheInput)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.ply", 500'002), report = folder / "report.json";
  const App_result result =
      run_app({"simplify", in, "-o", folder / "out.ply", "--ratio", "0.99", "--quiet", "--report", report});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(contents_of(report))["output"]["placement"], "vertices");
}

TEST(App_simplify, PutsVerticesToNewPlacesWhenAsked)
{
  const Workspace folder;
  const std::string in = folder.generate("nested", "in.obj", 3000);
  const auto simplify = [&](const std::string& input, const std::string& output) {
    return std::vector<std::string>{"simplify", input,         "-o",      output,  "--ratio",
                                    "0.3",      "--placement", "optimal", "--log", folder / "steps.log"};
  };
  std::vector<std::string> options = simplify(in, folder / "out.obj");
  options.insert(options.end(), {"--report", folder / "report.json"});
  const App_result result = run_app(options);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("at new places with interpolated attributes, the texture fitted to that of the "
                            "input\n"),
            std::string::npos)
      << result.out;
  const nlohmann::json report = nlohmann::json::parse(contents_of(folder / "report.json"));
  EXPECT_GT(report["vertices"]["fitted_texture"], 0);
  EXPECT_LE(report["vertices"]["fitted_texture"], report["vertices"]["placed"]);
  EXPECT_EQ(report["options"]["placement"], "optimal");
  const Triangle_soup before = read_mesh(in).soup, after = read_mesh(folder / "out.obj").soup;
  const std::set<Position> known = positions(before);
  const auto placed = std::count_if(after.points.begin(), after.points.end(), [&](const Point_3& p) {
    return known.count({p.x(), p.y(), p.z()}) == 0;
  });
  EXPECT_GT(placed, 100);
  EXPECT_EQ(report["vertices"]["placed"], placed);
  EXPECT_EQ(report["vertices"]["kept"], std::ptrdiff_t(after.points.size()) - placed);
  EXPECT_TRUE(verify(after, before).accepted());
  EXPECT_EQ(run_app({"replay", in, folder / "steps.log"}).code, 0);

  ASSERT_EQ(run_app({"simplify", in, "-o", folder / "in.glb", "--ratio", "1"}).code, 0);
  for (const char* output : {"out.glb", "out.stl"}) {
    EXPECT_EQ(run_app(simplify(folder / "in.glb", folder / output)).code, 0);
    EXPECT_EQ(
        run_app({"replay", folder / "in.glb", folder / "steps.log", "-o", folder / "replayed.glb"}).code, 0);
    const std::set<Position> written = positions(read_mesh(folder / output).soup);
    EXPECT_EQ(written, positions(read_mesh(folder / "replayed.glb").soup)) << output;
    EXPECT_GT(written.size(), 100u);
  }
}

// Two squares of eight triangles side by side, with a gap of 0.001.
std::string two_squares()
{
  std::string text;
  for (const double left : {0.0, 2.001}) {
    for (int y = 0; y <= 2; ++y)
      for (int x = 0; x <= 2; ++x)
        text += "v " + std::to_string(left + x) + ' ' + std::to_string(y) + " 0\n";
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x) {
        const int a = (left > 0 ? 10 : 1) + 3 * y + x;
        text += "f " + std::to_string(a) + ' ' + std::to_string(a + 1) + ' ' + std::to_string(a + 4) + ' ' +
                std::to_string(a + 3) + '\n';
      }
  }
  return text;
}

TEST(App_simplify, ClosesSeamsAndLeavesThemSewnWhenAsked)
{
  const Workspace folder;
  write_text(folder / "in.obj", two_squares());
  const auto pieces_left = [&](std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"simplify", folder / "in.obj", "-o", folder / "out.obj", "--ratio", "1"});
    const App_result result = run_app(options);
    EXPECT_EQ(result.code, 0) << result.err;
    const bool is_closed = result.out.find("seams closed: 6 of 6") != std::string::npos;
    EXPECT_EQ(is_closed, options.size() > 6 && options[6] == "--weld") << result.out;
    EXPECT_NE(result.out.find("6 of 16 border vertices have a partner within"),
              is_closed ? 0 : std::string::npos);
    const Triangle_soup soup = read_mesh(folder / "out.obj").soup;
    EXPECT_EQ(positions(soup).size(), is_closed ? 15u : 18u);
    return pieces(soup).size();
  };
  EXPECT_EQ(pieces_left({}), 2u);
  EXPECT_EQ(pieces_left({"--weld", "0.01"}), 2u) << "separate again, as they came";
  EXPECT_EQ(pieces_left({"--weld", "0.01", "--sewn"}), 1u);
  EXPECT_EQ(pieces_left({"--weld", "auto", "--sewn"}), 1u);
  EXPECT_EQ(pieces_left({"--sewn"}), 2u) << "they do not meet";
  expect_refused({"simplify", folder / "in.obj", "-o", folder / "o.obj", "--ratio", "1", "--weld", "-1"}, 2,
                 "at least 0");
}

TEST(App_simplify, TellsGapsFromRounding)
{
  const Workspace folder;
  const auto says = [&](const std::string& right, const char* what) {
    std::string text = two_squares();
    for (std::size_t at; (at = text.find("v 2.001000 ")) != std::string::npos;)
      text.replace(at, 10, "v " + right);
    write_text(folder / "in.obj", text);
    const std::string out = run_app({"info", folder / "in.obj"}).out;
    EXPECT_NE(out.find(what), std::string::npos) << out;
  };
  says("2.001", " % of the size); --weld auto closes them");
  says("2.000000000001", " (no more than rounding); --weld auto closes them");
}

TEST(App_simplify, HoldsOpenSeamsUnlessToldOtherwise)
{
  const Workspace folder;
  write_text(folder / "in.obj", two_squares());
  const auto tied = [&](std::vector<std::string> options, const std::string& says) {
    options.insert(options.begin(), {"simplify", folder / "in.obj", "-o", folder / "out.obj", "--ratio",
                                     "0.5", "--report", folder / "r.json"});
    const App_result result = run_app(options);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find(says), std::string::npos) << result.out;
    return nlohmann::json::parse(contents_of(folder / "r.json"))["snap"]["tied"].get<int>();
  };
  const std::string holds = "; they get no wider; --weld auto closes them\n";
  EXPECT_EQ(tied({}, holds), 3);
  EXPECT_EQ(tied({"--weld", "hold"}, holds), 3);
  EXPECT_EQ(tied({"--weld", "none"}, "; --weld auto closes them\n"), 0);
  EXPECT_EQ(tied({"--loop", "cgal"}, "; --weld auto closes them\n"), 0);
  EXPECT_EQ(tied({"--quiet"}, ""), 3) << "the result does not depend on what is printed";
  expect_refused({"simplify", folder / "in.obj", "-o", folder / "o.obj", "--ratio", "1", "--weld", "hold",
                  "--loop", "cgal"},
                 2, "--weld hold");
}

TEST(App_simplify, SaysWhereOpenSeamsAreFoundByTheirEdges)
{
  const Workspace folder;
  const auto narrower = [](const Point_3& p) { return Point_3(8.125 + p.x(), 0.75 * p.y(), 0); };
  write_mesh(folder / "in.obj", joined(sheet(8, 24), mapped(sheet(8, 32), narrower)));
  const std::string found = "  open seams: 58 of 144 border vertices are within 0.125 (";
  const auto says = [&](std::vector<std::string> arguments, const std::string& end) {
    const std::string out = run_app(arguments).out;
    const std::size_t from = out.find(found.substr(arguments[0] == "info" ? 2 : 0));
    ASSERT_NE(from, std::string::npos) << out;
    const std::string line = out.substr(from, out.find('\n', from) - from);
    EXPECT_EQ(line.substr(line.find(" of an edge")), " of an edge of another border" + end);
  };
  const std::vector<std::string> simplify{"simplify",         folder / "in.obj", "-o",
                                          folder / "out.obj", "--ratio",         "0.5",
                                          "--report",         folder / "r.json"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), simplify.begin(), simplify.end());
    return more;
  };
  says(simplify, "; they get hardly wider");
  const auto report = nlohmann::json::parse(contents_of(folder / "r.json"));
  EXPECT_EQ(report["border_gaps"]["clear_length_to_edges"], 0.125);
  EXPECT_EQ(report["border_gaps"]["within_clear_length_to_edges"], 58);
  EXPECT_EQ(report["snap"]["facing"], 58);
  says(with({"--weld", "none"}), "; --weld hold keeps them from getting wider");
  says(with({"--loop", "cgal"}), "");
  says({"info", folder / "in.obj"}, "; --weld hold keeps them from getting wider");
}

TEST(App_simplify, SaysWhereOpenSeamsAreNotHeld)
{
  const Workspace folder;
  write_mesh(folder / "cards.obj", joined(sheet(1, 8), moved(sheet(1, 8), 1.125, 0, 0)));
  const App_result cards =
      run_app({"simplify", folder / "cards.obj", "-o", folder / "out.obj", "--ratio", "0.5"});
  EXPECT_NE(cards.out.find("; not held, as no piece there has a vertex inside; --weld auto closes them\n"),
            std::string::npos)
      << cards.out;

  write_mesh(folder / "in.gltf", joined(sheet(8, 8), moved(sheet(8, 8), 8.0625, 0, 0)));
  auto scene = nlohmann::json::parse(contents_of(folder / "in.gltf"));
  scene["nodes"].push_back({{"mesh", 0}, {"translation", {100, 0, 0}}});
  scene["scenes"][0]["nodes"].push_back(scene["nodes"].size() - 1);
  write_text(folder / "in.gltf", scene.dump());
  for (const std::string instances : {"shared", "apart"}) {
    const App_result result = run_app({"simplify", folder / "in.gltf", "-o", folder / "out.gltf", "--ratio",
                                       "0.5", "--instances", instances, "--report", folder / "r.json"});
    EXPECT_EQ(result.out.find("\nopen seams: 18 pairs of border vertices not held, because their meshes were "
                              "reduced once for several places; --instances apart holds them\n") !=
                  std::string::npos,
              instances == "shared")
        << result.out;
    const auto snap = nlohmann::json::parse(contents_of(folder / "r.json"))["snap"];
    EXPECT_EQ(snap["tied"], 18);
    EXPECT_EQ(snap["untied"], instances == "shared" ? 18 : 0);
  }
}

TEST(App_simplify, GoesThroughEveryFormat)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 2000);
  const std::set<Position> original = positions(read_mesh(in).soup);
  for (const std::string name : {"a.obj", "a.off", "a.ply", "a.stl"})
    for (const bool is_ascii : {false, true}) {
      if (is_ascii && (name == "a.obj" || name == "a.off")) // which are text in any case
        continue;
      SCOPED_TRACE(name + (is_ascii ? " ascii" : ""));
      const std::string out = folder / name, again = folder / "again.obj";
      std::vector<std::string> command{"simplify", in,        "-o",          out,       "--ratio",
                                       "0.6",      "--quiet", "--placement", "vertices"};
      if (is_ascii)
        command.push_back("--ascii");
      const App_result result = run_app(command);
      EXPECT_EQ(result.code, 0);
      EXPECT_EQ(result.out + result.err, "");
      const Triangle_soup reduced = read_mesh(out).soup;
      EXPECT_TRUE(is_embedded(reduced));
      EXPECT_LT(reduced.triangles.size(), 1300u);
      for (const Position& p : positions(reduced))
        if (stores_float32(mesh_format(out)))
          EXPECT_EQ(double(float(p[0])), p[0]);
        else
          EXPECT_EQ(original.count(p), 1u);
      // And from that format on: nothing is left to do, and nothing changes.
      EXPECT_EQ(run_app({"simplify", out, "-o", again, "--ratio", "1", "--quiet"}).code, 0);
      EXPECT_EQ(positions(read_mesh(again).soup), positions(reduced));
    }
}

TEST(App_simplify, PutsAllLevelsIntoOneFileAndReadsEach)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.ply", 2000), out = folder / "levels.glb",
                    report = folder / "report.json";
  const App_result result = run_app({"simplify", in, "-o", out, "--lods", "0.4,1,0.7", "--report", report});
  EXPECT_EQ(result.code, 0) << result.err;
  const nlohmann::json levels = nlohmann::json::parse(contents_of(report))["lods"];
  ASSERT_EQ(levels.size(), 3u);
  std::size_t finer = 0;
  for (std::size_t level = 1; level <= 3; ++level) {
    const std::string number = std::to_string(level);
    EXPECT_NE(result.out.find("written: " + out + " (level " + number + ")\n"), std::string::npos)
        << result.out;
    EXPECT_EQ(levels[level - 1]["output"]["level"], level);
    const App_result judged = run_app({"verify", out, "--lod", number, "--against", in, "--json"});
    EXPECT_EQ(judged.code, 0) << judged.err;
    const std::size_t faces = nlohmann::json::parse(judged.out)["input"]["triangles"];
    EXPECT_EQ(levels[level - 1]["faces"]["output"], faces);
    EXPECT_TRUE(finer == 0 || faces < finer);
    finer = faces;
    EXPECT_NE(run_app({"info", out, "--lod", number}).out.find("this is number " + number),
              std::string::npos);
  }
  const App_result absent = run_app({"verify", out, "--lod", "4"});
  EXPECT_EQ(absent.code, 3);
  EXPECT_NE(absent.err.find("the file has only levels 1 to 3"), std::string::npos) << absent.err;
  EXPECT_EQ(folder.files(), 3u);
  // A reduction of such a file is one of its finest level.
  EXPECT_EQ(run_app({"simplify", out, "-o", folder / "one.glb", "--ratio", "0.5"}).code, 0);
  const App_result refused = run_app(
      {"simplify", folder / "one.glb", "-o", folder / "no.glb", "--lods", "1,0.5", "--placement", "optimal"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("cannot share the scene"), std::string::npos) << refused.err;
  EXPECT_EQ(run_app({"info", folder / "one.glb", "--lod", "2"}).code, 3);
}

TEST(App_simplify, GivesTheSameBytesEachTime)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 2000);
  for (const char* name : {"a.ply", "b.ply"})
    EXPECT_EQ(run_app({"simplify", in, "-o", folder / name, "--ratio", "0.5", "--quiet"}).code, 0);
  EXPECT_EQ(contents_of(folder / "a.ply"), contents_of(folder / "b.ply"));
}

TEST(App_simplify, ThreadsDoNotChangeTheResult)
{
  const Workspace folder;
  const std::string in = folder.generate("jacket", "in.obj", 20000), out = folder / "out.obj";
  std::string bytes;
  for (const char* threads : {"1", "2", "7"}) {
    const App_result result = run_app({"simplify", in, "-o", out, "--ratio", "0.5", "--threads", threads});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(bytes.empty() || contents_of(out) == bytes) << threads;
    bytes = contents_of(out);
  }
  EXPECT_NE(bytes, "");
}

TEST(App_simplify, CellsAreReplayedAndDoNotDependOnThreads)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 60000), out = folder / "out.obj";
  std::string bytes;
  for (const char* threads : {"1", "2"}) {
    const App_result result = run_app({"simplify", in, "-o", out, "--ratio", "0.7", "--cells", "--placement",
                                       "vertices", "--log", folder / "log", "--threads", threads});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(bytes.empty() || contents_of(out) == bytes) << threads;
    bytes = contents_of(out);
  }
  EXPECT_EQ(run_app({"replay", in, folder / "log", "-o", folder / "again.obj"}).code, 0);
  EXPECT_TRUE(contents_of(folder / "again.obj") == bytes);
}

TEST(App_simplify, MayReplaceItsInput)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 1000);
  EXPECT_EQ(run_app({"simplify", in, "-o", in, "--faces", "500", "--quiet"}).code, 0);
  EXPECT_LE(read_mesh(in).soup.triangles.size(), 500u);
}

TEST(App_simplify, FitsNormalsToTheShadingOfTheInput)
{
  const Workspace folder;
  Triangle_soup shaded = sheet(12, 12);
  for (const Point_3& point : shaded.points)
    shaded.normals.values.push_back({0.3 * std::sin(0.7 * point.x()), 0.3 * std::sin(0.5 * point.y()), 1});
  shaded.normals.of_triangle = shaded.triangles;
  write_mesh(folder / "in.obj", shaded);
  const std::string report = folder / "report.json";
  const App_result fitted = run_app(
      {"simplify", folder / "in.obj", "-o", folder / "out.obj", "--ratio", "0.2", "--report", report});
  EXPECT_EQ(fitted.code, 0) << fitted.err;
  EXPECT_NE(fitted.out.find("\nnormals: fitted to the shading of the input, other ones at "),
            std::string::npos)
      << fitted.out;
  const auto json = nlohmann::json::parse(contents_of(report));
  EXPECT_EQ(json["output"]["normals"], "fitted");
  EXPECT_GT(json["corners"]["fitted_normals"], 0);
  EXPECT_EQ(run_app({"verify", folder / "out.obj", "--against", folder / "in.obj"}).code, 0);
  const App_result mended = run_app({"simplify", folder / "in.obj", "-o", folder / "out.obj", "--ratio",
                                     "0.2", "--normals", "mend", "--report", report});
  EXPECT_EQ(mended.out.find("\nnormals: fitted"), std::string::npos) << mended.out;
  EXPECT_EQ(nlohmann::json::parse(contents_of(report))["output"]["normals"], "mended");
}

TEST(App_simplify, StopsAtTheErrorAllowed)
{
  const Workspace folder;
  const std::string in = folder.generate("sheets", "in.obj", 2000);
  std::size_t faces_before = 0;
  for (const char* error : {"1e-2", "1e-4", "0"}) {
    EXPECT_EQ(run_app({"simplify", in, "-o", folder / "out.obj", "--error", error, "--quiet"}).code, 0);
    const std::size_t faces = read_mesh(folder / "out.obj").soup.triangles.size();
    EXPECT_GT(faces, faces_before) << error;
    faces_before = faces;
  }
}

TEST(App_simplify, EndsWhereFewerFacesWouldMoveTheSurfaceTooFar)
{
  const Workspace folder;
  const std::string in = folder.generate("nested", "in.obj", 2000), out = folder / "out.obj";
  const App_result bounded =
      run_app({"simplify", in, "-o", out, "--ratio", "0.01", "--placement", "vertices"});
  EXPECT_NE(bounded.out.find(" by the error bound"), std::string::npos) << bounded.out;
  EXPECT_NE(bounded.out.find("; try --error 0.05, which costs shape (to about "), std::string::npos)
      << bounded.out;
  EXPECT_EQ(bounded.out.find("worst deviation"), std::string::npos) << bounded.out;
  // What it says is so: more is allowed, and goes farther, and then says where it is off.
  const App_result free = run_app({"simplify", in, "-o", out, "--ratio", "0.01", "--error", "0.05"});
  EXPECT_NE(free.out.find("\nworst deviation "), std::string::npos) << free.out;
  EXPECT_EQ(run_app({"simplify", in, "-o", out, "--error", "none"}).code, 2);
}

TEST(App_simplify, SaysHowFarAnyPointIsWhereALimitIsAskedFor)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 8000), out = folder / "out.obj";
  const std::string report = folder / "report.json", judged = folder / "judged.json";
  const auto distances = [](const std::string& file) {
    return nlohmann::json::parse(contents_of(file))["distance"];
  };
  const App_result limited = run_app({"simplify", in, "-o", out, "--error", "0.002", "--report", report});
  EXPECT_NE(limited.out.find("\ndistance of any point: at most "), std::string::npos) << limited.out;
  // Faces are long beside such a limit, and bulge between the points at which it is kept.
  EXPECT_NE(limited.out.find("\nlimit: 0.2 % holds at vertices and at points between them"),
            std::string::npos)
      << limited.out;
  EXPECT_EQ(run_app({"verify", out, "--against", in, "--report", judged}).code, 0);
  for (const char* way : {"original_to_result", "result_to_original"})
    for (const char* bound : {"max_lower", "max_upper"})
      EXPECT_EQ(distances(report)[way][bound], distances(judged)[way][bound]) << way << ' ' << bound;

  const App_result unlimited = run_app({"simplify", in, "-o", out, "--ratio", "0.5", "--report", report});
  EXPECT_EQ(unlimited.out.find("distance of any point"), std::string::npos) << unlimited.out;
  EXPECT_TRUE(distances(report)["original_to_result"]["max_upper"].is_null());
}

TEST(App_simplify, DropsWithTheNormalsTheVerticesThatTheySplit)
{
  const Workspace folder;
  Triangle_soup soup = mapped(joined(sheet(10, 20), moved(sheet(10, 20), 10, 0, 0)), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), std::round(64 * std::sin(p.x() / 4) * std::cos(p.y() / 5)) / 64);
  });
  soup.normals.of_triangle = soup.triangles;
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const double side = v < soup.points.size() / 2 ? 0.6 : -0.6;
    soup.normals.values.push_back(v % 2 == 0 ? std::array{side, 0., 0.8} : std::array{0., side, 0.8});
  }
  const std::string log = folder / "steps.log";
  const auto simplify = [&](const std::string& name) {
    write_mesh(folder / name, soup);
    return run_app({"simplify", folder / name, "-o", folder / ("out_" + name), "--ratio", "0.1", "--normals",
                    "drop", "--log", log});
  };
  for (const char* name : {"in.ply", "in.glb"}) {
    const App_result result = simplify(name);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("corners joined, for their vertices differ in nothing but their normals"),
              std::string::npos)
        << result.out;
    const Triangle_soup out = read_mesh(folder / (std::string("out_") + name)).soup;
    EXPECT_TRUE(out.normals.empty());
    EXPECT_EQ(out.points.size(), positions(out).size());
    EXPECT_EQ(run_app({"verify", folder / (std::string("out_") + name), "--against", folder / name}).code, 0);
    // Vertices leave what was a seam; a log that says nothing of it does not stand.
    EXPECT_EQ(run_app({"replay", folder / name, log}).code, 0);
    std::string text = contents_of(log);
    text.replace(text.find("normals dropped"), 15, "normals ignored");
    write_text(log, text);
    EXPECT_EQ(run_app({"replay", folder / name, log}).code, 1);
  }
  // OBJ has normals apart from vertices, so that these are two pieces.
  EXPECT_EQ(simplify("in.obj").code, 0);
  const Triangle_soup out = read_mesh(folder / "out_in.obj").soup;
  EXPECT_GT(out.points.size(), positions(out).size());
}

TEST(App_simplify, UncheckedIsWrittenAndNotVerified)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 4000);
  const std::string out = folder / "out.obj";
  expect_refused({"simplify", in, "-o", out, "--ratio", "0.4", "--no-intersection-check", "--quiet"}, 1,
                 "written but not verified, because of --no-intersection-check: ");
  EXPECT_FALSE(is_embedded(read_mesh(out).soup)); // the control: without the filter, this scene is pierced
  EXPECT_EQ(run_app({"simplify", in, "-o", out, "--ratio", "0.4", "--quiet"}).code, 0);
  EXPECT_TRUE(is_embedded(read_mesh(out).soup));
}

TEST(App_simplify, OffendingInputDescendsOrIsFrozenOrRefused)
{
  const Workspace folder;
  const std::string in = folder / "in.obj";
  write_text(in, "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 1\nv 9 9 0\nf 1 2 3\nf 4 5 6\n");
  expect_refused({"simplify", in, "-o", folder / "out.obj", "--ratio", "0.5", "--strict"}, 3, in);
  EXPECT_EQ(folder.files(), 1u);
  expect_refused({"simplify", in, "-o", folder / "out.obj", "--ratio", "0.5", "--defects", "refuse"}, 3, in);
  expect_refused(
      {"simplify", in, "-o", folder / "out.obj", "--ratio", "0.5", "--strict", "--defects", "freeze"}, 2,
      "--strict");
  const App_result frozen =
      run_app({"simplify", in, "-o", folder / "out.obj", "--ratio", "0.5", "--defects", "freeze"});
  EXPECT_EQ(frozen.code, 0) << frozen.err;
  EXPECT_NE(frozen.out.find("1 offending pair, 2 faces frozen"), std::string::npos) << frozen.out;
  const App_result result = run_app({"simplify", in, "-o", folder / "out.obj", "--ratio", "0.5"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("1 offending pair\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(", all descended from the 1 of the input"), std::string::npos) << result.out;
}

TEST(App_simplify, LetsPartsIntersectWhenAsked)
{
  const Workspace folder;
  const std::string in = folder / "in.obj", out = folder / "out.obj", log = folder / "log";
  Triangle_soup crossed = joined(sheet(12, 12), mapped(sheet(12, 12), [](const Point_3& p) {
                                   return Point_3(p.x() + 0.3, p.y() + 0.3, 0.2 * (p.x() - 6));
                                 }));
  crossed.objects.names = {"skin:bare", "cloth"};
  crossed.objects.of_triangle.assign(288, 0);
  crossed.objects.of_triangle.resize(576, 1);
  write_mesh(in, crossed);
  const std::vector<std::string> strictly{"simplify",
                                          in,
                                          "-o",
                                          out,
                                          "--ratio",
                                          "0.1",
                                          "--strict",
                                          "--log",
                                          log,
                                          "--report",
                                          folder / "report.json"};
  const auto with = [](std::vector<std::string> words, const std::string& parts) {
    words.insert(words.end(), {"--may-intersect", parts});
    return words;
  };
  EXPECT_EQ(run_app(strictly).code, 3) << "the control";
  const App_result result = run_app(with(strictly, "skin:bare:cloth"));
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find(" pairs between 'skin:bare' and 'cloth' before, "), std::string::npos)
      << result.out;
  const auto report = nlohmann::json::parse(contents_of(folder / "report.json"));
  EXPECT_GT(report["verified"]["permitted"][0]["pairs_of_original"], 0);
  EXPECT_EQ(report["verified"]["pairs"], 0);
  const App_result replayed = run_app({"replay", in, log});
  EXPECT_EQ(replayed.code, 0);
  EXPECT_NE(replayed.out.find("'skin:bare' and 'cloth' MAY INTERSECT"), std::string::npos) << replayed.out;
  EXPECT_EQ(run_app({"verify", out}).code, 1);
  EXPECT_EQ(run_app({"verify", out, "--may-intersect", "cloth:skin:bare"}).code, 0);
  EXPECT_EQ(run_app({"verify", out, "--against", in, "--may-intersect", "cloth:skin:bare"}).code, 0);

  for (const char* const parts : {"cloth", "cloth:silk", "cloth:cloth", ":"})
    EXPECT_EQ(run_app(with(strictly, parts)).code, 2) << parts;
  std::vector<std::string> in_cells = with(strictly, "skin:bare:cloth");
  in_cells.push_back("--cells");
  EXPECT_EQ(run_app(in_cells).code, 2);
}

TEST(App_simplify, KeepsWhatStoodThereWhenWritingFails)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 4000);
  const std::string out = folder / "out.obj";
  write_text(out, "precious");
  App_limits full;
  full.file_size = 1000;
  expect_refused({"simplify", in, "-o", out, "--ratio", "0.5", "--quiet"}, 4, out, full);
  EXPECT_EQ(contents_of(out), "precious");
  EXPECT_EQ(folder.files(), 2u);
}

TEST(App_simplify, SaysWhatWasWrittenBeforeAReportFails)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 400);
  const std::string out = folder / "out.obj";
  const App_result result =
      run_app({"simplify", in, "-o", out, "--ratio", "0.5", "--quiet", "--report", "/dev/full"});
  EXPECT_EQ(result.code, 4);
  EXPECT_NE(result.err.find("written before: " + out), std::string::npos) << result.err;
  EXPECT_TRUE(std::filesystem::exists(out));
}

TEST(App_simplify, AReportOnStandardOutputStandsThereAlone)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 400);
  const App_result result =
      run_app({"simplify", in, "-o", folder / "out.obj", "--ratio", "0.5", "--report", "/dev/stdout"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(nlohmann::json::parse(result.out)["command"], "simplify");
  EXPECT_NE(result.err.find("reduced to"), std::string::npos);
}

TEST(App_simplify, SaysThatAFileSeemsToBeTruncated)
{
  const Workspace folder;
  const std::string text = contents_of(folder.generate("grid", "in.obj", 400));
  write_text(folder / "cut.obj", text.substr(0, text.rfind("\nv ") + 3));
  expect_refused({"simplify", folder / "cut.obj", "-o", folder / "out.obj", "--ratio", "0.5"}, 3,
                 "it seems to be truncated");
  const auto summary = [&](std::size_t size) {
    write_text(folder / "cut.obj", text.substr(0, size));
    return run_app({"simplify", folder / "cut.obj", "-o", folder / "out.obj", "--ratio", "0.5"}).out;
  };
  EXPECT_NE(summary(text.rfind("\nf ") + 3).find("truncated"), std::string::npos);
  EXPECT_NE(summary(text.size() - 1).find("truncated"), std::string::npos);
  EXPECT_EQ(summary(text.size()).find("truncated"), std::string::npos);
}

TEST(App_simplify, RefusesUnreadableInput)
{
  const Workspace folder;
  const std::pair<const char*, const char*> inputs[] = {
      {"empty.obj", ""},
      {"comment.obj", "# nothing\n"},
      {"points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
      {"range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"},
      {"zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"},
      {"nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"inf.obj", "v 0 0 1e999\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"word.obj", "v 0 0 zero\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"points.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"},
      {"cut.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"},
      {"cut.stl", "short"},
      {"point.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n"},
      {"none.xyz", "1 2 3\n"}};
  for (const auto& [name, text] : inputs) {
    SCOPED_TRACE(name);
    write_text(folder / name, text);
    expect_refused({"simplify", folder / name, "-o", folder / "out.obj", "--ratio", "0.5"}, 3, name);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.obj"));
  }
  expect_refused({"simplify", folder / "absent.obj", "-o", folder / "out.obj", "--ratio", "0.5"}, 3,
                 "absent.obj");
  // A line break in a name does not make two lines of the message.
  expect_refused({"simplify", folder / "a\nb.obj", "-o", folder / "out.obj", "--ratio", "0.5"}, 3, "a b.obj");
}

TEST(App_simplify, EveryNastyFileEndsDefined)
{
  const std::filesystem::path nasty = std::filesystem::path(SELVEDGE_SHARED_DATA) / "nasty";
  if (!std::filesystem::exists(nasty))
    GTEST_SKIP() << "no shared data at " << nasty;
  const Workspace folder;
  for (const auto& file : std::filesystem::directory_iterator(nasty)) {
    SCOPED_TRACE(file.path().filename().string());
    const std::string out = folder / "out.obj";
    std::filesystem::remove(out);
    const App_result result =
        run_app({"simplify", file.path().string(), "-o", out, "--ratio", "0.5", "--quiet"});
    EXPECT_EQ(result.out, "");
    if (result.code == 0) {
      EXPECT_EQ(result.err, "");
      EXPECT_FALSE(read_mesh(out).soup.triangles.empty());
    } else {
      EXPECT_EQ(result.code, 3);
      EXPECT_TRUE(result.is_one_line()) << result.err;
      EXPECT_FALSE(std::filesystem::exists(out));
    }
  }
}

TEST(App_simplify, RealGarmentKeepsItsLayersApart)
{
  const std::filesystem::path dress =
      std::filesystem::path(SELVEDGE_SHARED_DATA) / "garments/dress_14_pieces_uv.obj";
  if (!std::filesystem::exists(dress))
    GTEST_SKIP() << "no shared data at " << dress;
  const Workspace folder;
  const App_result result = run_app({"simplify", dress.string(), "-o", folder / "out.obj", "--ratio", "0.3"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_LE(read_mesh(folder / "out.obj").soup.triangles.size(), 8925u); // within 1 %
  EXPECT_EQ(run_app({"verify", folder / "out.obj", "--against", dress.string()}).code, 0);
}

} // namespace
} // namespace selvedge::test
