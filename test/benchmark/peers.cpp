// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What others take for the same reduction, and what they break: ours with and without the guard, CGAL's loop
// with the same cost, placement and cheap filters, and with CGAL's own policies, OpenMesh, meshoptimizer and,
// where its headers are, libigl, on the same meshes, in turns.

#include "Peers.h"
#include "Cgal_policies.h"
#include "Mesh.h"
#include "Table.h"
#include "interleaved.h"

#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>
#include <selvedge/verify.h>

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstddef>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace selvedge;
using namespace selvedge::benchmark;

struct Program
{
  std::string name;
  std::function<Outcome()> run;
};

/// The number of faces that a ratio asks for.
std::size_t target(const Triangle_soup& soup, double ratio)
{
  return static_cast<std::size_t>(std::ceil(ratio * static_cast<double>(soup.triangles.size())));
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
  std::vector<Program> programs{
      {"CGAL's loop", [&] { return run_ours(prepared, by_cgal); }},
      {"selvedge", [&] { return run_ours(prepared, guarded); }},
      {"selvedge without guard", [&] { return run_ours(prepared, unguarded); }},
      {"CGAL Garland-Heckbert", [&] { return run_garland_heckbert(soup, target(soup, ratio)); }},
      {"CGAL Lindstrom-Turk", [&] { return run_lindstrom_turk(soup, target(soup, ratio)); }},
      {"OpenMesh", [&] { return run_openmesh(soup, guarded, target(soup, ratio)); }},
      {"meshoptimizer", [&] { return run_meshoptimizer(soup, target(soup, ratio)); }}};
#ifdef SELVEDGE_HAS_LIBIGL
  programs.push_back({"libigl, guarded", [&] { return run_libigl(soup, target(soup, ratio)); }});
#endif

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
      << "\n**The ratios count**: each is of two reductions in one run on one machine. Seconds are per 1000\n"
         "collapses, from the first quadric to the last collapse, an index included, conversions not;\n"
         "medians of "
      << request.runs
      << " interleaved.\n"
         "CGAL's loop has our cost, placement and cheap filters, and no guard; the two after it have CGAL's\n"
         "own policies, and no limits; OpenMesh has quadrics and our limits of normal change and aspect\n"
         "ratio; meshoptimizer has no limits; libigl blocks intersections, and is there if\n"
         "SELVEDGE_LIBIGL_INCLUDE says where its headers are. RMS: from the original's vertices to the\n"
         "result, by its diagonal. Pairs are counted by the judge, exactly; new are those that the original\n"
         "does not have. Textures, which ours keeps, are no concern of others here. Memory is no part of\n"
         "this: all share one process.\n";
  if (!request.csv.empty())
    write_file(request.csv, table.csv());
}

} // namespace

int main(int argc, char** argv)
{
  CLI::App app("What selvedge, CGAL's loop and other programs take for one reduction, and break.");
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
