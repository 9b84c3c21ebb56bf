// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Progress_bar.h"
#include "interruption.h"
#include "output_files.h"
#include "subcommands.h"
#include "text.h"

#include <selvedge/Error.h>
#include <selvedge/mesh/mesh_files.h>
#include <selvedge/replay.h>

#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <string>

namespace selvedge::app {
namespace {

struct Request
{
  std::string original;
  std::string log;
  std::string output;
  std::string scene;
  bool is_free_of_limits = false;
  bool is_all_wanted = false;
  bool is_ascii = false;
};

/// Without an original of the same bytes every number in the log would mean something else.
void require_same_file(const Request& request, const Log_header& header)
{
  if (!header.sha256.empty() && header.sha256 != sha256_of_file(request.original))
    throw Input_error(request.original +
                      ": is not the file that the log was made from; its SHA-256 is another");
}

void print(const Violation& violation)
{
  if (violation.step > 0)
    std::cout << "step " << with_commas(violation.step) << " (line " << with_commas(violation.line) << ", "
              << violation.removed << " to " << violation.kept << "): ";
  else
    std::cout << "the result: ";
  std::cout << name(violation.kind) << ": " << violation.message << '\n';
}

void print_at_length(const Violation& violation)
{
  print(violation);
  if (!violation.triangles.empty()) {
    std::cout << "  triangles of the original, counted from 1:";
    for (const Index triangle : violation.triangles)
      std::cout << ' ' << triangle + 1;
    std::cout << '\n';
  }
  if (!violation.point.empty())
    std::cout << "  they meet in the point " << violation.point << '\n';
  if (!violation.scene.empty())
    std::cout << violation.scene;
}

void print(const Request& request, const Replay_verdict& verdict)
{
  std::cout << request.log << ": " << counted(verdict.steps, "step") << ", " << with_commas(verdict.collapses)
            << " of them collapses; " << counted(verdict.soup.triangles.size(), "triangle") << " left\n"
            << "judged: " << with_commas(verdict.pairs_judged) << " pairs, "
            << with_commas(verdict.pairs_judged_in_rationals) << " of them in rational numbers; "
            << with_digits(verdict.seconds_prepare) << " s for the original, "
            << with_digits(verdict.seconds_steps) << " s for the steps";
  if (verdict.steps > 0)
    std::cout << ", " << with_digits(1e6 * verdict.seconds_steps / double(verdict.steps)) << " us each";
  std::cout << '\n';
  if (verdict.is_accepted()) {
    std::cout << "ACCEPTED" << (request.is_free_of_limits ? ", limits apart" : "")
              << (verdict.is_result_stated ? "" : "; the log does not say what its result is") << std::endl;
    return;
  }
  if (verdict.violations.empty()) {
    std::cout << "interrupted; no violation so far" << std::endl;
    return;
  }
  std::cout << "REFUSED; the first violation:\n";
  print_at_length(verdict.violations.front());
  if (request.is_all_wanted) {
    std::cout << "all " << with_commas(verdict.violations.size()) << ":\n";
    std::map<std::string, std::size_t> kinds;
    for (const Violation& violation : verdict.violations) {
      print(violation);
      ++kinds[name(violation.kind)];
    }
    for (const auto& [kind, count] : kinds)
      std::cout << "total " << kind << ": " << with_commas(count) << '\n';
  }
  std::cout << std::flush;
}

Exit_code run(const Request& request)
{
  if (!request.output.empty()) {
    output_format(request.output);
    require_writable(request.output);
  }
  if (!request.scene.empty())
    require_writable(request.scene);
  std::ifstream stream(request.log, std::ios::binary);
  if (!stream)
    throw Input_error(request.log + ": cannot be opened");
  Log_reader log(stream, request.log);
  require_same_file(request, log.header());
  const Mesh_file original = read_mesh(request.original);

  watch_for_interruption();
  Replay_options options;
  options.are_limits_judged = !request.is_free_of_limits;
  options.is_all_wanted = request.is_all_wanted;
  options.should_stop = [](std::size_t) { return is_interrupted(); };
  const Replay_verdict verdict = replay(original.soup, original.format == Mesh_format::stl, log, options);
  print(request, verdict);
  if (!request.scene.empty() && !verdict.violations.empty())
    write_file(request.scene, verdict.violations.front().scene);
  if (!request.output.empty())
    write_output(request.output, verdict.soup, request.is_ascii);
  if (!verdict.violations.empty())
    return exit_not_verified;
  return verdict.is_stopped ? exit_interrupted : exit_done;
}

} // namespace

Action add_replay(CLI::App& command)
{
  const auto request = std::make_shared<Request>();
  command.add_option("ORIGINAL", request->original, "The mesh that was reduced")->required()->type_name("");
  command.add_option("LOG", request->log, "What was done to it: a log of collapses")
      ->required()
      ->type_name("");
  command.add_option("-o,--output", request->output, "Where the mesh goes that the steps lead to")
      ->type_name("FILE");
  command.add_flag("--no-limits", request->is_free_of_limits,
                   "Judge links and geometry alone, not angles, shapes and lines");
  command.add_flag("--all", request->is_all_wanted, "Go on after a bad step, and list them all");
  command.add_option("--scene", request->scene, "Write the first violation's faces as an OBJ file")
      ->type_name("FILE");
  command.add_flag("--ascii", request->is_ascii, "Write PLY and STL as text");
  command.footer(
      "Examples:\n"
      "  selvedge simplify jacket.obj -o small.obj --ratio 0.3 --log jacket.log\n"
      "  selvedge replay jacket.obj jacket.log -o again.obj && cmp small.obj again.obj\n"
      "  selvedge replay jacket.obj of_my_own_program.log --no-limits --all\n\n"
      "Exit code 0 when every step is accepted and the result is what the log says, 1 when not. The log's "
      "format\n"
      "is documented in collapse_log.h, and how to write one in docs/validate_your_simplifier.md.");
  return [request] { return run(*request); };
}

} // namespace selvedge::app
