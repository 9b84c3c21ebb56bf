// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What others take for the same reduction, and what they break: ours with and without the guard, CGAL's loop
// with the same cost, placement and cheap filters, OpenMesh, and meshoptimizer, on the same meshes, in turns.

#include "Mesh.h"
#include "Openmesh_decimater.h"
#include "Table.h"
#include "interleaved.h"

#include "soup/Working_mesh.h"
#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>
#include <selvedge/verify.h>

#include <CLI/CLI.hpp>

#include <meshoptimizer.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace selvedge;
using namespace selvedge::benchmark;

/// What one program made of a mesh.
struct Outcome
{
  Triangle_soup soup;
  double seconds; // of the reduction alone: from the quadrics to the last collapse
  std::size_t collapses;
};

struct Program
{
  std::string name;
  std::function<Outcome()> run;
};

class Stopwatch
{
public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - m_start).count(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point m_start = Clock::now();
};

/// The mesh that ours works on, in which coincident borders are sewn: what the others are given too.
Triangle_soup sewn(const Prepared_soup& prepared)
{
  Working_mesh working(prepared.soup, prepared.positions, prepared.is_frozen);
  const Working_mesh::Mesh& mesh = working.mesh();
  Triangle_soup soup;
  for (const auto v : mesh.vertices())
    soup.points.push_back(mesh.point(v));
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    soup.triangles.push_back({mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))});
  }
  return soup;
}

Outcome run_ours(const Prepared_soup& prepared, const Simplify_options& options)
{
  Simplified_soup result = simplify_soup(prepared, options);
  return {std::move(result.soup), result.report.seconds_reduce, result.report.collapses};
}

Outcome run_openmesh(const Triangle_soup& soup, const Simplify_options& options)
{
  Openmesh_decimater openmesh(soup, options);
  const std::size_t faces =
      static_cast<std::size_t>(std::ceil(*options.ratio * static_cast<double>(soup.triangles.size())));
  const Stopwatch stopwatch;
  const std::size_t collapses = openmesh.reduce_to(faces);
  Outcome outcome{{}, stopwatch.seconds(), collapses};
  outcome.soup.points = soup.points;
  outcome.soup.triangles = openmesh.triangles();
  return outcome;
}

std::size_t vertices_in_use(const Triangle_soup& soup)
{
  std::vector<char> is_used(soup.points.size());
  for (const Index_triple& triangle : soup.triangles)
    for (const Index vertex : triangle)
      is_used[vertex] = true;
  return static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), true));
}

Outcome run_meshoptimizer(const Triangle_soup& soup, const Simplify_options& options)
{
  std::vector<float> coordinates;
  for (const Point_3& p : soup.points)
    for (int axis = 0; axis < 3; ++axis)
      coordinates.push_back(static_cast<float>(p[axis]));
  std::vector<unsigned int> corners;
  for (const Index_triple& triangle : soup.triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  const std::size_t triangles =
      static_cast<std::size_t>(std::ceil(*options.ratio * static_cast<double>(soup.triangles.size())));
  constexpr float any_error = 1;
  std::vector<unsigned int> left(corners.size());
  const Stopwatch stopwatch;
  left.resize(meshopt_simplify(left.data(), corners.data(), corners.size(), coordinates.data(),
                               soup.points.size(), 3 * sizeof(float), 3 * triangles, any_error));
  Outcome outcome{{}, stopwatch.seconds(), 0};
  outcome.soup.points = soup.points; // unrounded
  for (std::size_t i = 0; i < left.size(); i += 3)
    outcome.soup.triangles.push_back({left[i], left[i + 1], left[i + 2]});
  outcome.collapses = vertices_in_use(soup) - vertices_in_use(outcome.soup);
  return outcome;
}

const Row header{"mesh",  "program", "ratio to CGAL's loop", "least to most", "s/1000", "collapses",
                 "faces", "RMS",     "offending pairs",      "new pairs"};

void add_rows(Table& table, const Mesh& mesh, double ratio, int runs)
{
  const Prepared_soup& prepared = mesh.prepared;
  const Triangle_soup soup = sewn(prepared);
  Simplify_options guarded;
  guarded.ratio = ratio;
  Simplify_options unguarded = guarded;
  unguarded.check_intersections = false;
  Simplify_options by_cgal = unguarded;
  by_cgal.loop = Collapse_loop::cgal;
  const std::vector<Program> programs{
      {"CGAL's loop", [&] { return run_ours(prepared, by_cgal); }},
      {"selvedge", [&] { return run_ours(prepared, guarded); }},
      {"selvedge without guard", [&] { return run_ours(prepared, unguarded); }},
      {"OpenMesh", [&] { return run_openmesh(soup, guarded); }},
      {"meshoptimizer", [&] { return run_meshoptimizer(soup, guarded); }}};

  std::vector<Row> tails(programs.size());
  const std::vector<Sample> seconds = interleaved(programs.size(), runs, [&](std::size_t which, int run) {
    const Outcome outcome = programs[which].run();
    if (run == 0) {
      const auto pairs = offending_pairs(outcome.soup);
      tails[which] = {
          std::to_string(outcome.collapses), std::to_string(outcome.soup.triangles.size()),
          text(distances(outcome.soup, prepared.soup).original_to_result.root_mean_square),
          std::to_string(pairs.size()),
          std::to_string(new_pairs(outcome.soup, pairs, prepared.soup, prepared.offending_pairs).size())};
    }
    return 1000 * outcome.seconds / static_cast<double>(outcome.collapses);
  });
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const Sample to_cgal = seconds[i] / seconds[0];
    Row row{mesh.name, programs[i].name, text(to_cgal.median()), spread(to_cgal), text(seconds[i].median())};
    row.insert(row.end(), tails[i].begin(), tails[i].end());
    table.add(row);
  }
}

struct Request
{
  std::vector<std::string> meshes{"skirt:50000", "shorts:50000", "folded:50000"};
  double ratio = 0.3;
  int runs = 3;
  std::string csv;
};

void print_table(const Request& request)
{
  Table table(header);
  for (const std::string& argument : request.meshes)
    add_rows(table, mesh(argument), request.ratio, request.runs);
  std::cout
      << "\n**The ratios count**: each is of two reductions in one run on one machine. Seconds are per 1000 "
         "collapses, from the\nfirst quadric to the last collapse, an index included, conversions not; "
         "medians "
         "of "
      << request.runs
      << " interleaved.\nCGAL's loop has our cost, placement and cheap filters, and no guard; OpenMesh has "
         "quadrics and our limits of normal\nchange and aspect ratio; meshoptimizer has no limits. RMS: from "
         "the original's vertices to the result, by its\ndiagonal. Pairs are counted by the judge, exactly; "
         "new are those that the original does not have. Textures, which\nours keeps, are no concern of "
         "OpenMesh and meshoptimizer here. Memory is no part of this: all share one process.\n";
  if (!request.csv.empty())
    write_file(request.csv, table.csv());
}

} // namespace

int main(int argc, char** argv)
{
  CLI::App app("What selvedge, CGAL's loop, OpenMesh and meshoptimizer take for one reduction, and break.");
  Request request;
  app.add_option("MESH", request.meshes, "Files, or SCENE:FACES for generated ones")->capture_default_str();
  app.add_option("--ratio", request.ratio, "Share of the faces to keep")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--runs", request.runs, "Of which the median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--csv", request.csv, "The table once more")->type_name("FILE");
  try {
    app.parse(argc, argv);
    print_table(request);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::cerr << "peers: " << error.what() << std::endl;
    return 1;
  }
}
