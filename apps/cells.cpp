// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Thread_limit.h"
#include "output_files.h"
#include "report_json.h"
#include "standard_streams.h"
#include "subcommands.h"
#include "text.h"
#include "threads_option.h"

#include <selvedge/Error.h>
#include <selvedge/Sha256.h>
#include <selvedge/cells.h>
#include <selvedge/mesh_files.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace selvedge::app {
namespace {

namespace fs = std::filesystem;

enum class Cells_action { cut, join };

struct Cells_request
{
  Cells_action action = Cells_action::cut;
  std::string input; ///< the mesh, or the plan
  std::string results;
  std::string output;
  std::optional<std::size_t> cells, faces_per_cell;
  double shift = 0;
  std::string plan;
  bool is_verified = false;
  bool is_quiet = false;
  std::optional<std::size_t> threads;
};

constexpr std::string_view plan_kind = "selvedge cells";

std::string with_cell(const std::string& pattern, const std::string& cell)
{
  return with_mark_replaced(pattern, cell_mark, cell);
}

void require_mark(const std::string& option, const std::string& pattern)
{
  if (pattern.find(cell_mark) == std::string::npos)
    throw Argument_error(option +
                         ": the name must contain {cell}, which stands for the number of the cell: '" +
                         "cell_{cell}.ply'");
}

// JSON has no infinite numbers: null stands for a side that a cell does not have.
Json sides_json(const std::array<double, 3>& sides)
{
  Json json = Json::array();
  for (const double side : sides)
    json.push_back(std::isfinite(side) ? Json(side) : Json(nullptr));
  return json;
}

std::array<double, 3> sides_of(const Json& json, double unbounded)
{
  std::array<double, 3> sides;
  for (std::size_t i = 0; i < 3; ++i)
    sides[i] = json.at(i).is_null() ? unbounded : json.at(i).get<double>();
  return sides;
}

std::string plan_name(const Cells_request& request)
{
  if (!request.plan.empty())
    return request.plan;
  fs::path name = with_cell(request.output, "plan");
  if (is_gzip(name))
    name.replace_extension();
  return name.replace_extension(".json").string();
}

Exit_code cut(const Cells_request& request)
{
  if (!request.results.empty())
    throw Argument_error("cut takes one mesh, but a second name is given: " + request.results);
  if (request.is_verified)
    throw Argument_error("--verify is for cells join; leave it out");
  require_mark("--output", request.output);
  if (output_format(request.output) != Mesh_format::ply)
    throw Argument_error("--output: pieces are PLY files, which hold what marks their fixed faces; choose a "
                         "name that ends in .ply: " +
                         request.output);
  if (request.cells.has_value() == request.faces_per_cell.has_value())
    throw Argument_error("say how many pieces to make: give --cells N or --faces-per-cell N, one of the two");
  const std::string plan_path = plan_name(request);
  require_distinct({{"--plan", plan_path}}, {{"IN", request.input}});
  const auto require_other_name = [&](std::size_t cell) {
    require_distinct({{"--output", with_cell(request.output, std::to_string(cell))}},
                     {{"IN", request.input}, {"--plan", plan_path}});
  };
  constexpr std::size_t many = 10'000; // of more, the last are looked at when they are written
  for (std::size_t i = 1; i <= std::min(request.cells.value_or(1), many); ++i)
    require_other_name(i);
  require_writable(with_cell(request.output, "1"));
  require_writable(plan_path);
  Cut_options options;
  options.cells = request.cells;
  options.faces_per_cell = request.faces_per_cell;
  options.shift = request.shift;
  const Cut_mesh mesh = cut_into_cells(request.input, options, [&](std::size_t i) {
    require_other_name(i);
    return fs::path(with_cell(request.output, std::to_string(i)));
  });

  Json plan = {{"kind", plan_kind},
               {"schema", 1},
               {"version", SELVEDGE_VERSION},
               {"whole", {{"file", request.input}, {"vertices", mesh.vertices}, {"faces", mesh.faces}}},
               {"shift", request.shift},
               {"cells", Json::array()}};
  std::size_t largest = 0, free_faces = 0;
  const fs::path folder = fs::absolute(plan_path).parent_path();
  for (const Cell_piece& piece : mesh.pieces) {
    plan["cells"].push_back({{"file", fs::absolute(piece.file).lexically_proximate(folder).string()},
                             {"low", sides_json(piece.cell.low)},
                             {"high", sides_json(piece.cell.high)},
                             {"vertices", piece.vertices},
                             {"faces", piece.faces},
                             {"fixed_faces", piece.fixed_faces},
                             {"sha256", sha256_of_file(piece.file)}});
    largest = std::max(largest, piece.faces);
    free_faces += piece.faces - piece.fixed_faces;
  }
  write_file(plan_path, to_text(plan));
  if (request.is_quiet)
    return exit_done;
  std::cout << input_name(request.input) << ": " << counted(mesh.faces, "face") << " cut into "
            << counted(mesh.pieces.size(), "piece") << " of at most " << counted(largest, "face") << "; "
            << with_commas(mesh.faces - free_faces) << " ("
            << percent(double(mesh.faces - free_faces) / double(mesh.faces)) << ") at the walls stay\n";
  for (const std::string& what : mesh.ignored)
    std::cout << "  not carried: " << what << '\n';
  std::cout
      << "plan: " << plan_path << "\nReduce every piece, for example by\n  selvedge simplify "
      << with_cell(request.output, "1")
      << " -o small_1.ply --ratio 0.1 --keep fixed --defects freeze\nand join them by\n  selvedge cells "
         "join "
      << plan_path << " 'small_{cell}.ply' -o OUT" << std::endl;
  return exit_done;
}

std::vector<Cell_piece> pieces_of_plan(const std::string& name, std::vector<std::string>& digests)
{
  const std::string text = read_file(name);
  std::vector<Cell_piece> pieces;
  try {
    const Json plan = Json::parse(text);
    if (plan.at("kind") != plan_kind || plan.at("schema") != 1)
      throw Input_error("");
    for (const Json& cell : plan.at("cells")) {
      Cell_piece& piece = pieces.emplace_back();
      piece.cell.low = sides_of(cell.at("low"), -Cell::infinity);
      piece.cell.high = sides_of(cell.at("high"), Cell::infinity);
      piece.file = fs::path(name).parent_path() / cell.at("file").get<std::string>();
      digests.push_back(cell.at("sha256").get<std::string>());
    }
  } catch (const std::exception&) {
    pieces.clear();
  }
  if (pieces.empty())
    throw Input_error(name +
                      ": is no plan of this version of selvedge cells cut; name the .json file that it "
                      "wrote");
  return pieces;
}

Exit_code join(const Cells_request& request)
{
  if (request.cells || request.faces_per_cell || request.shift != 0 || !request.plan.empty())
    throw Argument_error("--cells, --faces-per-cell, --shift and --plan are for cells cut; leave them out");
  if (request.results.empty())
    throw Argument_error("say which files to join: selvedge cells join PLAN 'small_{cell}.ply' -o OUT");
  require_mark("RESULTS", request.results);
  const Mesh_format format = output_format(request.output);
  if (stores_float32(format))
    throw Argument_error("--output: the format stores 32-bit floats, to which a joined mesh is not rounded; "
                         "choose .ply, .obj or .off: " +
                         request.output);
  require_writable(request.output);
  std::vector<std::string> digests;
  const std::vector<Cell_piece> pieces = pieces_of_plan(request.input, digests);
  std::vector<Named_file> read{{"PLAN", request.input}};
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    cells.push_back(pieces[i].cell);
    read.insert(read.end(), {{"PLAN's pieces", pieces[i].file},
                             {"RESULTS", with_cell(request.results, std::to_string(i + 1))}});
  }
  require_distinct({{"--output", request.output}}, read);

  Cell_join joined(cells);
  std::size_t faces_before = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string name = pieces[i].file.string();
    if (sha256_of_file(name) != digests[i])
      throw Input_error(name + ": is not the piece that was cut, or has been changed; cut the mesh again");
    const Triangle_soup piece = read_mesh(pieces[i].file).soup;
    const std::string result = with_cell(request.results, std::to_string(i + 1));
    joined.add(i, piece, read_mesh(result).soup, name, result);
    faces_before += piece.triangles.size();
  }
  const Triangle_soup whole = joined.take();
  // There are no more than in the pieces, unless their judge or this program errs.
  if (request.is_verified && offending_pairs(whole).size() > joined.pairs())
    throw Error(request.output + ": not written, because faces intersect that do not in the pieces; please "
                                 "report this");
  write_output(request.output, whole, format, false);
  if (request.is_quiet)
    return exit_done;
  std::cout << request.output << ": " << counted(whole.triangles.size(), "face") << " joined from "
            << counted(pieces.size(), "piece") << " of " << with_commas(faces_before)
            << " faces; every piece is judged: walls kept, "
            << (joined.pairs() == 0 ? "embedded" : "no new pair of faces intersects")
            << (request.is_verified ? ", and so is the joined mesh\n" : "\n");
  for (const std::string& attribute : joined.lost_attributes())
    std::cout << "  not carried, because some results do not have it: " << attribute << '\n';
  std::cout << std::flush;
  return exit_done;
}

} // namespace

Action add_cells(CLI::App& command)
{
  const auto request = std::make_shared<Cells_request>();
  command.add_option("ACTION", request->action, "cut a mesh into pieces, or join pieces.")
      ->transform(one_of<Cells_action>({{"cut", Cells_action::cut}, {"join", Cells_action::join}}))
      ->required()
      ->type_name("");
  command
      .add_option("IN", request->input,
                  std::string("Mesh to cut: ") + mesh_endings +
                      "; or the plan that cut has written. A binary PLY file is cut without being read into "
                      "memory.")
      ->required()
      ->type_name("");
  command
      .add_option("RESULTS", request->results,
                  "Reduced pieces to join, in any format: {cell} stands for the number of the cell.")
      ->type_name("");
  command
      .add_option("-o,--output", request->output,
                  "Files for the pieces, 'cell_{cell}.ply', where {cell} stands for the number of the cell; "
                  "or file for the joined mesh.")
      ->required()
      ->type_name("FILE");
  command.add_option("--cells", request->cells, "Number of pieces to make.")
      ->transform(whole_number())
      ->check(in_range(1))
      ->type_name("N");
  command
      .add_option("--faces-per-cell", request->faces_per_cell,
                  "About how many faces a piece is to have, in place of --cells.")
      ->transform(whole_number())
      ->check(in_range(1))
      ->type_name("N");
  command
      .add_option(
          "--shift", request->shift,
          "Move the walls by this share of a cell, so that what a first cut has kept at its walls can "
          "be reduced after a second one.")
      ->check(in_range(0, 0.99))
      ->type_name("S")
      ->capture_default_str();
  command
      .add_option("--plan", request->plan,
                  "File for the plan, which join needs. Without this option, it has the name of a piece with "
                  "'plan' for the number, and ends in .json.")
      ->type_name("FILE");
  command.add_flag("--verify", request->is_verified,
                   "Judge the joined mesh as a whole as well, which needs memory for all of it.");
  command.add_flag("--quiet", request->is_quiet, "Print no summary.");
  add_threads_option(command, request->threads);
  command.footer(
      "Examples:\n"
      "  selvedge cells cut city.ply -o 'cell_{cell}.ply' --faces-per-cell 1e6\n"
      "  selvedge simplify cell_1.ply -o small_1.ply --ratio 0.1 --keep fixed --defects freeze\n"
      "  selvedge cells join cell_plan.json 'small_{cell}.ply' -o small.ply\n\n"
      "A piece has all faces that a box of space meets. Those with a corner on or beyond a wall of the box\n"
      "have the property 'fixed', and must stay as they are; all others may change inside the box, on any\n"
      "machine and by any program. join judges every piece by exact tests, and refuses one that breaks "
      "this,\n"
      "or in which faces intersect that did not before: then the joined mesh has no such faces either.");
  return [request] {
    const Thread_limit limit(request->threads);
    return request->action == Cells_action::cut ? cut(*request) : join(*request);
  };
}

} // namespace selvedge::app
