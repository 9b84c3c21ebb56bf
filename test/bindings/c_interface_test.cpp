// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The C interface keeps the contract of meshoptimizer, and what it promises beyond it. The judge is that of
// the library, linked a second time.

#include <selvedge_c.h>

#include "apps/report_json.h"
#include "bindings/run/Reduction_request.h"
#include "support/Temporary_folder.h"
#include "support/meshes.h"
#include "support/soups.h"

#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>
#include <selvedge/rounding.h>
#include <selvedge/verify.h>

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#ifdef SELVEDGE_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif
#ifdef SELVEDGE_APP
#include "cli/App_run.h"
#endif

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

TEST(Bindings_report, HasTheSecondsOfAllReductions)
{
  Prepared_soup prepared;
  prepared.seconds_positions = 1;
  Simplified_soup first, second;
  first.seconds_sew = second.report.seconds_index = 2;
  first.report.seconds_reduce = 3;
  second.report.seconds_reduce = 4; // of both, where they are levels of one reduction
  app::Phase_seconds seconds;
  seconds.add(prepared, {&first, &second});
  seconds.add(prepared, {&first});
  EXPECT_EQ(seconds.json({"weld", "index", "reduce", "write"}).dump(),
            R"({"weld":3.0,"index":2.0,"reduce":7.0,"write":0.0})");
}

using Simplify = decltype(&selvedge_simplify);

/// A soup as a renderer has it: four floats for each vertex, the last of which is no coordinate.
class Buffers
{
public:
  explicit Buffers(Triangle_soup soup) : m_soup(std::move(soup))
  {
    round_to_float32(m_soup);
    for (const Point_3& p : m_soup.points)
      for (const double x : {p.x(), p.y(), p.z(), std::nan("")})
        vertices.push_back(float(x));
    for (const Index_triple& triangle : m_soup.triangles)
      indices.insert(indices.end(), triangle.begin(), triangle.end());
  }

  std::size_t vertex_count() const { return m_soup.points.size(); }

  std::vector<unsigned int> simplified(Simplify simplify, double ratio, float error = 0.05f,
                                       unsigned options = 0, float* result_error = nullptr) const
  {
    std::vector<unsigned int> result(indices.size());
    result.resize(simplify(result.data(), indices.data(), indices.size(), vertices.data(), vertex_count(),
                           4 * sizeof(float), 3 * std::size_t(ratio * double(indices.size() / 3)), error,
                           options, result_error));
    return result;
  }

  std::vector<unsigned int> simplified(const std::vector<unsigned char>& lock, unsigned options = 0) const
  {
    std::vector<unsigned int> result(indices.size());
    const float weight = 1; // of the fourth number
    result.resize(selvedge_simplifyWithAttributes(result.data(), indices.data(), indices.size(),
                                                  vertices.data(), vertex_count(), 4 * sizeof(float),
                                                  vertices.data() + 3, 4 * sizeof(float), &weight, 1,
                                                  lock.data(), indices.size() / 10, 1, options, nullptr));
    return result;
  }

  Triangle_soup soup(const std::vector<unsigned int>& of_indices) const
  {
    Triangle_soup result;
    result.points = m_soup.points;
    for (std::size_t i = 0; i < of_indices.size(); i += 3)
      result.triangles.push_back({of_indices[i], of_indices[i + 1], of_indices[i + 2]});
    return result;
  }

  std::vector<float> vertices;
  std::vector<unsigned int> indices;

private:
  Triangle_soup m_soup;
};

std::set<unsigned int> set_of(const std::vector<unsigned int>& indices)
{
  return {indices.begin(), indices.end()};
}

TEST(C_interface, IsCalledThroughOnePointerWithMeshoptimizer)
{
  const Buffers layers(sheets(6000, 5, 1e-3));
  ASSERT_TRUE(is_embedded(layers.soup(layers.indices)));
  const std::vector<unsigned int> ours = layers.simplified(selvedge_simplify, 0.1);
  EXPECT_EQ(selvedge_last_error(), nullptr);
  ASSERT_GT(ours.size(), 0u);
  EXPECT_LE(ours.size(), layers.indices.size() / 10);
  EXPECT_TRUE(verify(layers.soup(ours), layers.soup(layers.indices)).accepted());
  EXPECT_TRUE(is_embedded(layers.soup(ours)));
#ifdef SELVEDGE_HAS_MESHOPTIMIZER
  const std::vector<unsigned int> theirs = layers.simplified(meshopt_simplify, 0.1);
  EXPECT_GT(offending_pairs(layers.soup(theirs)).size(), 0u); // the control
#endif
}

TEST(C_interface, ReducesInPlaceAndKeepsTheOrderOfTriangles)
{
  Buffers layers(sheets(1000, 2, 1e-3));
  const std::vector<unsigned int> apart = layers.simplified(selvedge_simplify, 0.5);
  const std::size_t count = selvedge_simplify(
      layers.indices.data(), layers.indices.data(), layers.indices.size(), layers.vertices.data(),
      layers.vertex_count(), 16, layers.indices.size() / 2, 0.05f, 0, nullptr);
  layers.indices.resize(count);
  EXPECT_EQ(layers.indices, apart);
}

TEST(C_interface, KeepsToTheErrorInEitherUnit)
{
  const Buffers layers(mapped(sheets(2000, 1, 1e-3),
                              [](const Point_3& p) { return Point_3(10 * p.x(), 10 * p.y(), 10 * p.z()); }));
  float shares = -1, distances = -1, unlimited = -1;
  const std::vector<unsigned int> relative = layers.simplified(selvedge_simplify, 0, 0.002f, 0, &shares);
  EXPECT_LE(shares, 0.002f);
  EXPECT_GT(shares, 0.0005f);
  // The extent is 10, within a few percent.
  layers.simplified(selvedge_simplify, 0, 0.02f, selvedge_SimplifyErrorAbsolute, &distances);
  EXPECT_LE(distances, 0.02f);
  EXPECT_GT(distances, 0.005f);
  EXPECT_LT(layers.simplified(selvedge_simplify, 0, std::numeric_limits<float>::max(), 0, &unlimited).size(),
            relative.size());
  EXPECT_GT(unlimited, 0.002f);
}

TEST(C_interface, LocksBordersAndVertices)
{
  const Buffers layers(sheets(2000, 2, 1e-3));
  std::set<unsigned int> border;
  std::set<std::pair<unsigned, unsigned>> edges;
  for (std::size_t i = 0; i < layers.indices.size(); ++i)
    edges.emplace(layers.indices[i], layers.indices[i % 3 == 2 ? i - 2 : i + 1]);
  for (const auto& [from, to] : edges)
    if (edges.count({to, from}) == 0)
      border.insert(from);
  const auto has_border = [&](const std::vector<unsigned int>& result) {
    const std::set<unsigned int> used = set_of(result);
    return std::includes(used.begin(), used.end(), border.begin(), border.end());
  };
  EXPECT_TRUE(has_border(layers.simplified(selvedge_simplify, 0.3, 1, selvedge_SimplifyLockBorder)));
  EXPECT_FALSE(has_border(layers.simplified(selvedge_simplify, 0.3, 1, 0)));

  std::vector<unsigned char> lock(layers.vertex_count());
  for (std::size_t v = 0; v < lock.size(); v += 7)
    lock[v] = selvedge_SimplifyVertex_Lock;
  const auto kept = [&](const std::vector<unsigned int>& result) {
    const std::set<unsigned int> used = set_of(result);
    std::size_t count = 0;
    for (std::size_t v = 0; v < lock.size(); v += 7)
      count += used.count(static_cast<unsigned int>(v));
    return count;
  };
  const std::size_t all = (lock.size() + 6) / 7;
  EXPECT_EQ(kept(layers.simplified(lock)), all);
  std::fill(lock.begin(), lock.end(), 0);
  const std::size_t plain = kept(layers.simplified(lock));
  EXPECT_LT(plain, all / 2);
  for (std::size_t v = 0; v < lock.size(); v += 7)
    lock[v] = selvedge_SimplifyVertex_Priority;
  EXPECT_GT(kept(layers.simplified(lock)), plain);
}

TEST(C_interface, RefusesWithAWordAndLeavesTheDestination)
{
  const Buffers layers(sheets(200, 1, 1e-3));
  const std::vector<unsigned int> before(layers.indices.size(), 17);
  struct Call
  {
    const char* word;
    std::vector<unsigned int> indices = {0, 1, 2};
    float error = 0.1f;
    unsigned int options = 0;
    std::size_t stride = 16;
    const float* vertices = nullptr;
  };
  const float flat[12] = {}, infinite[12] = {0, 0, 0, 0, 1, 0, 0, 0, 0, INFINITY, 0, 0};
  for (const Call& bad : {Call{"out of range", {0, 1, 4000000}}, Call{"no multiple of three", {0, 1}},
                          Call{"target_error", {0, 1, 2}, -1}, Call{"target_error", {0, 1, 2}, NAN},
                          Call{"Prune", {0, 1, 2}, 1, 1 << 3}, Call{"unknown", {0, 1, 2}, 1, 1u << 30},
                          Call{"stride", {0, 1, 2}, 1, 0, 8}, Call{"triangle", {0, 1, 2}, 1, 0, 16, flat},
                          Call{"vertex 2", {0, 1, 2}, 1, 0, 16, infinite}}) {
    std::vector<unsigned int> destination = before;
    const std::size_t count = bad.vertices ? 3 : layers.vertex_count();
    float error = 5;
    EXPECT_EQ(selvedge_simplify(destination.data(), bad.indices.data(), bad.indices.size(),
                                bad.vertices ? bad.vertices : layers.vertices.data(), count, bad.stride, 0,
                                bad.error, bad.options, &error),
              0u);
    ASSERT_NE(selvedge_last_error(), nullptr) << bad.word;
    if (std::string(bad.word) != "out of range") {
      EXPECT_NE(std::string(selvedge_last_error()).find(bad.word), std::string::npos)
          << selvedge_last_error();
    }
    EXPECT_EQ(destination, before);
    EXPECT_EQ(error, 5);
  }
  EXPECT_EQ(
      selvedge_simplify(nullptr, layers.indices.data(), 3, layers.vertices.data(), 3, 16, 0, 1, 0, nullptr),
      0u);
  EXPECT_NE(selvedge_last_error(), nullptr);
  EXPECT_EQ(selvedge_simplify(nullptr, nullptr, 0, nullptr, 0, 12, 0, 0, 0, nullptr), 0u);
  EXPECT_EQ(selvedge_last_error(), nullptr);
}

// A program that checks only its last call learns what failed first.
TEST(C_interface, SaysWithANullPointerWhatFailedBefore)
{
  selvedge_mesh* mesh = selvedge_mesh_read("absent.obj");
  EXPECT_EQ(mesh, nullptr);
  selvedge_options* options = selvedge_options_new();
  EXPECT_EQ(selvedge_last_error(), nullptr);
  EXPECT_EQ(selvedge_reduce(mesh, options), nullptr);
  ASSERT_NE(selvedge_last_error(), nullptr);
  EXPECT_NE(std::string(selvedge_last_error())
                .find("mesh is a null pointer; the error before this one: absent.obj"),
            std::string::npos)
      << selvedge_last_error();
  const std::string first = selvedge_last_error();
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(selvedge_reduce(mesh, options), nullptr);
  EXPECT_EQ(selvedge_last_error(), first) << "the text grows with every call";
  selvedge_options_free(options);
}

TEST(C_interface, ReducesByOptionsWithLogReportAndVerdict)
{
  selvedge_mesh* const mesh = selvedge_mesh_generate("sheets", 2000, 3);
  ASSERT_NE(mesh, nullptr) << selvedge_last_error();
  selvedge_options* const options = selvedge_options_new();
  EXPECT_EQ(selvedge_reduce(mesh, options), nullptr);
  EXPECT_NE(std::string(selvedge_last_error()).find("how far"), std::string::npos);
  EXPECT_EQ(selvedge_options_set(options, "ratoi", "0.2"), -1);
  EXPECT_NE(std::string(selvedge_last_error()).find("'ratio'"), std::string::npos) << selvedge_last_error();
  EXPECT_EQ(selvedge_options_set(options, "ratio", "2"), -1);
  EXPECT_EQ(selvedge_options_set(options, "ratio", "0.5"), 0);
  EXPECT_EQ(selvedge_options_set(options, "log", "true"), 0);
  std::size_t calls = 0;
  const auto count = [](void* user, std::size_t, std::size_t, std::size_t) {
    ++*static_cast<std::size_t*>(user);
    return 0;
  };
  EXPECT_EQ(selvedge_options_set_progress(options, count, &calls), 0);
  selvedge_result* const result = selvedge_reduce(mesh, options);
  ASSERT_NE(result, nullptr) << selvedge_last_error();
  EXPECT_GT(calls, 0u);
  EXPECT_EQ(selvedge_result_is_accepted(result), 1);
  EXPECT_EQ(selvedge_result_is_reached(result), 1);
  const selvedge_mesh* const reduced = selvedge_result_mesh(result);
  for (std::size_t v = 0; v < 3 * selvedge_mesh_vertex_count(reduced); ++v)
    EXPECT_EQ(selvedge_mesh_positions(reduced)[v],
              selvedge_mesh_positions(mesh)[3 * selvedge_result_vertices(result)[v / 3] + v % 3]);
  std::size_t pairs = 1, new_pairs = 1;
  EXPECT_EQ(selvedge_verify(reduced, mesh, &pairs, &new_pairs), 1);
  EXPECT_EQ(pairs + new_pairs, 0u);
  const std::string log = selvedge_result_log(result);
  EXPECT_EQ(selvedge_replay(mesh, log.c_str()), 1) << selvedge_last_error();
  const std::string header = log.substr(0, log.find("\nc ") + 1);
  EXPECT_EQ(selvedge_replay(mesh, (header + "result 1 1 -\n").c_str()), 0);
  EXPECT_STREQ(selvedge_last_error(), "the result: result: the log has 0 collapses, and says 1");
  const std::string last = std::to_string(selvedge_mesh_vertex_count(mesh) - 1); // in another layer
  EXPECT_EQ(selvedge_replay(mesh, (header + "c 0 " + last + "\nresult 1 1 -\n").c_str()), 0);
  EXPECT_EQ(selvedge_last_error(), "step 1 (line " +
                                       std::to_string(std::count(header.begin(), header.end(), '\n') + 1) +
                                       ", 0 to " + last + "): no_edge: no edge joins the two vertices");
  EXPECT_EQ(selvedge_replay(mesh, "no log"), -1);
  EXPECT_EQ(selvedge_mesh_write(reduced, (Temporary_folder() / "reduced.stl").string().c_str()), -1);
  const std::string error = selvedge_last_error();
  EXPECT_NE(error.find("no 32-bit float, and the format stores no others; write OBJ"), std::string::npos)
      << error;
  const nlohmann::json report = nlohmann::json::parse(selvedge_result_report(result));
  EXPECT_EQ(report["faces"]["output"], selvedge_mesh_index_count(reduced) / 3);
  EXPECT_EQ(report["verified"]["new_pairs"], 0);
  selvedge_result_free(result);
  selvedge_options_free(options);
  selvedge_mesh_free(mesh);
}

TEST(C_interface, JoinsVerticesThatDifferInNormalsThatAreDropped)
{
  // A strip with a fold at every row, where a file with one normal for each vertex has each vertex twice.
  constexpr int side = 12;
  std::ostringstream vertices, faces;
  for (int row = 0; row < side; ++row) {
    for (const int y : {row, row + 1})
      for (int x = 0; x <= side; ++x)
        vertices << x << ' ' << y << ' ' << 0.1 * (y % 2) << ' ' << 0.03 * (x - side / 2) << ' '
                 << (row % 2 == 0 ? -0.1 : 0.1) << " 0.99\n";
    for (int x = 0; x < side; ++x) {
      const int a = 2 * row * (side + 1) + x;
      faces << "4 " << a << ' ' << a + 1 << ' ' << a + side + 2 << ' ' << a + side + 1 << '\n';
    }
  }
  const Temporary_folder folder;
  std::ofstream(folder / "folds.ply")
      << "ply\nformat ascii 1.0\nelement vertex " << 2 * side * (side + 1)
      << "\nproperty float x\nproperty float y\nproperty float z\nproperty "
         "float nx\nproperty float ny\nproperty float nz\nelement face "
      << side * side << "\nproperty list uchar int vertex_indices\nend_header\n"
      << vertices.str() << faces.str();
  selvedge_mesh* const mesh = selvedge_mesh_read((folder / "folds.ply").string().c_str());
  ASSERT_NE(mesh, nullptr) << selvedge_last_error();
  for (const bool are_dropped : {false, true}) {
    selvedge_options* const options = selvedge_options_new();
    EXPECT_EQ(selvedge_options_set(options, "ratio", "0.3"), 0);
    EXPECT_EQ(selvedge_options_set(options, "log", "true"), 0);
    EXPECT_EQ(selvedge_options_set(options, "normals", are_dropped ? "drop" : "keep"), 0);
    selvedge_result* const result = selvedge_reduce(mesh, options);
    ASSERT_NE(result, nullptr) << selvedge_last_error();
    const selvedge_mesh* const reduced = selvedge_result_mesh(result);
    // One surface has fewer vertices than faces; strips that are apart have one for each side and more.
    if (are_dropped)
      EXPECT_LT(selvedge_mesh_vertex_count(reduced), selvedge_mesh_index_count(reduced) / 3);
    else
      EXPECT_GT(selvedge_mesh_vertex_count(reduced), selvedge_mesh_index_count(reduced) / 3);
    EXPECT_EQ(selvedge_replay(mesh, selvedge_result_log(result)), 1) << selvedge_last_error();
    selvedge_result_free(result);
    selvedge_options_free(options);
  }
  selvedge_mesh_free(mesh);
}

TEST(C_interface, WritesFilesThatReferToTheSameMaterials)
{
  const Temporary_folder folder;
  std::filesystem::create_directory(folder / "small");
  std::ofstream(folder / "in.mtl") << "newmtl red\n";
  Triangle_soup soup = sheet(8, 8);
  soup.material_libraries = {"in.mtl"};
  write_mesh(folder / "in.obj", soup);
  selvedge_mesh* const mesh = selvedge_mesh_read((folder / "in.obj").string().c_str());
  selvedge_options* const options = selvedge_options_new();
  selvedge_options_set(options, "ratio", "0.5");
  selvedge_result* const result = selvedge_reduce(mesh, options);
  ASSERT_NE(result, nullptr) << selvedge_last_error();
  for (const auto& [name, library] :
       {std::pair("out.obj", "in.mtl"), std::pair("small/out.obj", "../in.mtl")})
    for (const selvedge_mesh* written :
         {static_cast<const selvedge_mesh*>(mesh), selvedge_result_mesh(result)}) {
      ASSERT_EQ(selvedge_mesh_write(written, (folder / name).string().c_str()), 0) << selvedge_last_error();
      EXPECT_EQ(read_mesh(folder / name).soup.material_libraries, std::vector<std::string>{library});
    }
  selvedge_result_free(result);
  selvedge_options_free(options);
  selvedge_mesh_free(mesh);
}

TEST(C_interface, StaysClearOfAnObstacle)
{
  selvedge_mesh* const scene = selvedge_mesh_generate("sheets", 2000, 2);
  const std::size_t half = selvedge_mesh_index_count(scene) / 6 * 3;
  const auto part = [&](std::size_t first, std::size_t count) {
    return selvedge_mesh_new(selvedge_mesh_positions(scene), selvedge_mesh_vertex_count(scene),
                             selvedge_mesh_indices(scene) + first, count);
  };
  selvedge_mesh *const mesh = part(0, half), *const body = part(half, half);
  const auto pairs_with_body = [&](bool is_obstacle) {
    selvedge_options* const options = selvedge_options_new();
    selvedge_options_set(options, "ratio", "0.1");
    EXPECT_EQ(selvedge_options_set_obstacle(options, is_obstacle ? body : nullptr), 0);
    selvedge_result* const result = selvedge_reduce(mesh, options);
    const selvedge_mesh* const reduced = selvedge_result_mesh(result);
    Triangle_soup both;
    for (const selvedge_mesh* m : {reduced, static_cast<const selvedge_mesh*>(body)}) {
      Triangle_soup one;
      for (std::size_t v = 0; v < selvedge_mesh_vertex_count(m); ++v)
        one.points.emplace_back(selvedge_mesh_positions(m)[3 * v], selvedge_mesh_positions(m)[3 * v + 1],
                                selvedge_mesh_positions(m)[3 * v + 2]);
      for (std::size_t i = 0; i < selvedge_mesh_index_count(m); i += 3)
        one.triangles.push_back(
            {selvedge_mesh_indices(m)[i], selvedge_mesh_indices(m)[i + 1], selvedge_mesh_indices(m)[i + 2]});
      both = joined(both, one);
    }
    selvedge_result_free(result);
    selvedge_options_free(options);
    return offending_pairs(both).size();
  };
  EXPECT_EQ(pairs_with_body(true), 0u);
  EXPECT_GT(pairs_with_body(false), 0u);
  for (selvedge_mesh* m : {scene, mesh, body})
    selvedge_mesh_free(m);
}

// The result is that of the file, whose seams stay; without them, others edges go.
TEST(C_interface, KeepsTextureCoordinatesOfArrays)
{
  selvedge_mesh* const file = selvedge_mesh_generate("skirt", 6000, 2);
  const auto copy_of = [](const selvedge_mesh* mesh) {
    return selvedge_mesh_new(selvedge_mesh_positions(mesh), selvedge_mesh_vertex_count(mesh),
                             selvedge_mesh_indices(mesh), selvedge_mesh_index_count(mesh));
  };
  const auto uvs_of = [](const selvedge_mesh* mesh) {
    std::vector<double> uvs(2 * selvedge_mesh_index_count(mesh), -1);
    if (selvedge_mesh_get_uvs(mesh, uvs.data()) != 1)
      uvs.clear();
    return uvs;
  };
  const auto reduced = [&](const selvedge_mesh* mesh) {
    selvedge_options* const options = selvedge_options_new();
    selvedge_options_set(options, "ratio", "0.3");
    selvedge_result* const result = selvedge_reduce(mesh, options);
    selvedge_options_free(options);
    const selvedge_mesh* const small = selvedge_result_mesh(result);
    const std::vector<unsigned int> indices(selvedge_mesh_indices(small),
                                            selvedge_mesh_indices(small) + selvedge_mesh_index_count(small));
    std::vector<double> uvs = uvs_of(small);
    selvedge_result_free(result);
    return std::make_pair(indices, uvs);
  };
  selvedge_mesh* const mesh = copy_of(file);
  EXPECT_EQ(selvedge_mesh_get_uvs(mesh, nullptr), 0);
  const auto bare = reduced(mesh);
  EXPECT_TRUE(bare.second.empty());

  std::vector<double> uvs = uvs_of(file);
  ASSERT_EQ(selvedge_mesh_set_uvs(mesh, uvs.data()), 0);
  EXPECT_EQ(uvs_of(mesh), uvs);
  const auto result = reduced(mesh);
  EXPECT_EQ(result.second.size(), 2 * result.first.size());
  EXPECT_NE(result.first, bare.first);
  selvedge_mesh* const again = copy_of(file);
  ASSERT_EQ(selvedge_mesh_set_uvs(again, uvs.data()), 0);
  EXPECT_EQ(reduced(again), result);

  EXPECT_EQ(selvedge_mesh_set_uvs(mesh, nullptr), 0);
  EXPECT_EQ(reduced(mesh), bare);
  uvs[7] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(selvedge_mesh_set_uvs(mesh, uvs.data()), -1);
  EXPECT_NE(std::string(selvedge_last_error()).find("index 3 "), std::string::npos);
  EXPECT_EQ(selvedge_mesh_get_uvs(mesh, nullptr), 0);
  EXPECT_EQ(selvedge_mesh_get_uvs(file, nullptr), -1);
  EXPECT_EQ(selvedge_mesh_set_uvs(nullptr, uvs.data()), -1);
  EXPECT_EQ(selvedge_mesh_get_uvs(nullptr, uvs.data()), -1);
  for (selvedge_mesh* m : {file, mesh, again})
    selvedge_mesh_free(m);
}

// What the program refuses, `selvedge_reduce` does not take without a word.
TEST(C_interface, RefusesOptionsThatDoNotGoTogetherAsTheProgramDoes)
{
  selvedge_mesh* const mesh = selvedge_mesh_generate("seams", 1000, 1);
  using Values = std::vector<std::pair<const char*, const char*>>;
  const auto error = [&](const Values& values) -> std::string {
    selvedge_options* const options = selvedge_options_new();
    selvedge_options_set(options, "ratio", "0.5");
    for (const auto& [name, value] : values)
      EXPECT_EQ(selvedge_options_set(options, name, value), 0) << selvedge_last_error();
    selvedge_result* const result = selvedge_reduce(mesh, options);
    const std::string refusal = result ? "" : selvedge_last_error();
    selvedge_result_free(result);
    selvedge_options_free(options);
    return refusal;
  };
  const char* const clearance = "0.001";
  for (const char* const weld : {"0.01", "auto"})
    EXPECT_EQ(error({{"clearance", clearance}, {"weld", weld}}).rfind("clearance: ", 0), 0u) << weld;
  for (const char* const weld : {"0", "hold", "none"})
    EXPECT_EQ(error({{"clearance", clearance}, {"weld", weld}}), "") << weld;
  for (const bool is_loop_first : {false, true}) {
    Values values = {{"loop", "cgal"}, {"weld", "hold"}};
    if (!is_loop_first)
      std::swap(values[0], values[1]);
    EXPECT_EQ(error(values).rfind("weld: ", 0), 0u);
  }
  EXPECT_EQ(error({{"loop", "cgal"}, {"weld", "none"}}), "");
  EXPECT_EQ(error({{"loop", "cgal"}}), "");
  const std::string part = "left";
  EXPECT_EQ(error({{"keep", part.c_str()}, {"part_ratios", (part + "=0.5").c_str()}}).rfind("keep: ", 0), 0u);
  EXPECT_EQ(error({{"keep", part.c_str()}}), "");
  selvedge_mesh_free(mesh);
}

TEST(Bindings, DoNotClaimThatTheLoopOfCgalHoldsGaps)
{
  bindings::Reduction_request request;
  const auto weld = [&] { return nlohmann::json::parse(request.json())["weld"]; };
  EXPECT_EQ(weld(), "hold");
  request.set("loop", "cgal");
  EXPECT_EQ(weld(), "none");
  EXPECT_EQ(request.complete_prepare_options().open_seams, Open_seams::measure);
}

TEST(C_interface, IsDocumentedByTheExampleThatRuns)
{
  const auto text_of = [](const char* name) {
    std::ifstream stream(std::string(SELVEDGE_SOURCES) + name);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  const std::string example = text_of("/examples/simplify_in_c.c");
  EXPECT_NE(text_of("/docs/c.md").find("```c\n" + example.substr(example.find("/* Reduces")) + "```"),
            std::string::npos);
}

#ifdef SELVEDGE_APP
// One list of options: that of the program, with its defaults.
TEST(Bindings, HaveTheOptionsAndDefaultsOfTheProgram)
{
  const Workspace folder;
  const std::string report = folder / "report.json";
  ASSERT_EQ(run_app({"simplify", folder.generate("grid", "in.obj", 200), "-o", folder / "out.obj", "--ratio",
                     "0.5", "--quiet", "--report", report})
                .code,
            0);
  nlohmann::json expected = nlohmann::json::parse(contents_of(report))["options"];
  for (const char* name : {"animation", "drop_attribute", "every", "humanoid_poses", "morphs", "obstacle",
                           "obstacle_animation", "obstacle_humanoid_poses", "obstacle_pose", "polygons",
                           "pose", "poses_out", "progressive", "strict", "without_pose"})
    EXPECT_EQ(expected.erase(name), 1u);
  EXPECT_EQ(expected["placement"], "auto"); // which callers in memory have not, who go by vertex numbers
  expected["placement"] = "vertices";
  bindings::Reduction_request request;
  request.set("ratio", "0.5");
  EXPECT_EQ(nlohmann::json::parse(request.json()), expected);
}

TEST(Bindings, EveryOptionTakesAValueAndRefusesAnother)
{
  for (const std::string& name : bindings::option_names()) {
    bindings::Reduction_request request;
    std::size_t taken = 0;
    for (const char* value : {"0.25", "3", "optimal", "cgal", "clusters", "true", "false", "collar=0.5",
                              "keep", "freeze", "apart", "skin:coat", "auto"}) {
      try {
        const std::string before = request.json();
        request.set(name, value);
        taken += nlohmann::json::parse(request.json()) != nlohmann::json::parse(before);
      } catch (const Argument_error& error) {
        EXPECT_EQ(std::string(error.what()).rfind(name + ": ", 0), 0u) << error.what();
      }
    }
    EXPECT_GT(taken, 0u) << name;
  }
}
#endif

} // namespace
} // namespace selvedge::test
