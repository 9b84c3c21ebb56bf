// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output_files.h"
#include "report_json.h"
#include "subcommands.h"
#include "text.h"
#include "threads.h"

#include <selvedge/Error.h>
#include <selvedge/mesh/mesh_files.h>
#include <selvedge/verify.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

namespace selvedge::app {
namespace {

struct Request
{
  std::string mesh;
  std::string original;
  std::string report;
  bool is_json = false;
  std::optional<std::size_t> threads;
};

void print(const Request& request, const Mesh_file& mesh, const Verification& verification)
{
  constexpr std::size_t named = 5;
  const bool has_original = !request.original.empty();
  std::size_t loops = 0;
  long euler = 0;
  for (const Piece& piece : verification.pieces) {
    loops += piece.boundary_loops;
    euler += piece.euler_characteristic;
  }
  std::cout << request.mesh << ": " << counted(mesh.soup.triangles.size(), "face") << ", "
            << counted(verification.pieces.size(), "piece") << ", " << counted(loops, "boundary loop")
            << ", Euler characteristic " << euler << '\n';
  for (const std::string& note : describe(mesh.notes))
    std::cout << "  " << note << '\n';

  if (verification.embedded()) {
    std::cout << "embedded: no two faces touch or cross\n";
  } else {
    std::cout << "NOT embedded: " << counted(verification.pairs.size(), "offending pair");
    if (has_original)
      std::cout << ", " << with_commas(verification.new_pairs.size()) << " of them not in the original";
    std::cout << '\n';
    const auto& pairs =
        has_original && !verification.new_pairs.empty() ? verification.new_pairs : verification.pairs;
    for (std::size_t i = 0; i < (std::min)(pairs.size(), named); ++i)
      std::cout << "  " << describe(pairs[i]) << '\n';
    if (pairs.size() > named)
      std::cout << "  and " << with_commas(pairs.size() - named) << " more\n";
  }
  if (has_original) {
    std::cout << (verification.same_topology() ? "topology: as in the original\n" : "topology CHANGED:\n");
    for (const Topology_difference& difference : verification.topology_differences)
      std::cout << "  pieces with " << counted(difference.boundary_loops, "boundary loop")
                << " and Euler characteristic " << difference.euler_characteristic << ": "
                << difference.pieces_of_original << " before, " << difference.pieces_of_result << " now\n";
    const auto line = [](const char* what, const Distance& distance) {
      std::cout << "distance, " << what << ": " << with_digits(distance.root_mean_square) << " RMS, "
                << with_digits(distance.maximum) << " at most, of the diagonal\n";
    };
    line("original to result", verification.distances->original_to_result);
    line("result to original", verification.distances->result_to_original);
  }
  std::cout << std::flush;
}

Exit_code run(const Request& request)
{
  const bool has_original = !request.original.empty();
  if (!request.report.empty()) {
    if (is_same_file(request.report, request.mesh) ||
        (has_original && is_same_file(request.report, request.original)))
      throw Argument_error("--report names the same file as a mesh: " + request.report);
    require_writable(request.report);
  }
  const Mesh_file mesh = read_mesh(request.mesh);
  Json report = new_report("verify");
  report["input"] = input_json(request.mesh, mesh);
  std::optional<Verification> verification;
  if (has_original) {
    const Mesh_file original = read_mesh(request.original);
    report["original"] = input_json(request.original, original);
    verification = verify(mesh.soup, original.soup);
  } else {
    verification = verify(mesh.soup);
  }
  const bool is_good = has_original ? verification->accepted() : verification->embedded();
  const Exit_code code = is_good ? exit_done : exit_not_verified;
  add_verification(report, *verification, has_original);
  report["memory"] = {{"peak_bytes", peak_memory_bytes()}};
  report["exit_code"] = int(code);
  if (request.is_json)
    std::cout << to_text(report) << std::flush;
  else
    print(request, mesh, *verification);
  if (!request.report.empty())
    write_file(request.report, to_text(report));
  return code;
}

} // namespace

Action add_verify(CLI::App& command)
{
  const auto request = std::make_shared<Request>();
  command.add_option("MESH", request->mesh, "Mesh to judge: .obj, .off, .ply, .stl, .glb or .gltf")
      ->required()
      ->type_name("");
  command.add_option("--against", request->original, "The original that MESH was made from")
      ->type_name("FILE");
  CLI::Option* const report =
      command.add_option("--report", request->report, "Write the verdict as JSON, beside the text")
          ->type_name("FILE");
  command.add_flag("--json", request->is_json, "Print the verdict as JSON instead of text")->excludes(report);
  Thread_limit::add_option(command, request->threads);
  command.footer(
      "Examples:\n"
      "  selvedge verify jacket.obj                          is it embedded?\n"
      "  selvedge verify small.obj --against jacket.obj      is anything wrong that was not wrong before?\n"
      "  selvedge verify small.obj --json | jq .verified.pairs\n\n"
      "Exit code 0 when MESH is embedded; with an original, when no offending pair is new and pieces, "
      "boundary\n"
      "loops and Euler characteristics are the same. A mesh that was rounded (STL) is compared best with an\n"
      "original in the same format. Triangles are counted from 1, after polygons were cut.");
  return [request] {
    const Thread_limit limit(request->threads);
    return run(*request);
  };
}

} // namespace selvedge::app
