// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Progress_bar.h"
#include "html_report.h"
#include "interruption.h"
#include "output_files.h"
#include "poses_option.h"
#include "report_json.h"
#include "report_output.h"
#include "standard_streams.h"
#include "subcommands.h"
#include "text.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/Simplify_options.h>
#include <selvedge/mesh_files.h>
#include <selvedge/replay.h>
#include <selvedge/rounding.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::app {
namespace {

struct Replay_request
{
  std::string original;
  std::string log;
  std::string obstacle;
  Pose_sources poses, obstacle_poses;
  std::string output;
  std::string scene;
  std::string limits;
  std::string report;
  std::string html;
  std::optional<Mesh_format> format;
  bool is_free_of_limits = false;
  bool is_all_wanted = false;
  bool is_ascii = false;
  bool are_polygons_split = false;
  bool is_json = false;
};

/// Returns the limits that the judge imposes, if any. 'seed' and 'default' are never names of files.
std::optional<Reduction_limits> imposed_limits(const std::string& what)
{
  if (what.empty())
    return std::nullopt;
  if (what == "seed")
    return limits_of_seed();
  if (what == "default")
    return limits_of(Simplify_options());
  std::ifstream stream(what, std::ios::binary);
  if (!stream)
    throw Input_error(what + ": cannot be opened; --limits takes a file, or the word 'seed' or 'default'");
  return read_limits(stream, what);
}

void print_at_length(const Violation& violation)
{
  std::cout << app::describe(violation) << '\n';
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

std::string describe(const Reduction_limits& limits)
{
  std::string text;
  for (const Limit_description& limit : limit_descriptions)
    if (const std::optional<double>& value = limits.*limit.value)
      text += (text.empty() ? "" : ", ") + std::string(limit.key) + ' ' + with_digits(*value, "%.12g") +
              limit.unit;
  return text.empty() ? "none" : text;
}

void print_terms(const Replay_verdict& verdict)
{
  const auto bound = [](bool is_bound) {
    return is_bound ? "bound (the log has its SHA-256)" : "NOT BOUND (no SHA-256 was compared)";
  };
  std::cout << "limits judged: " << describe(verdict.limits) << '\n';
  if (verdict.limits_source != Limits_source::log)
    std::cout << "limits declared by the log, but not judged: " << describe(verdict.header.limits) << '\n';
  std::cout << "input: " << bound(verdict.is_input_stated)
            << (verdict.header.is_rounded_to_float32 ? "; rounded to 32-bit floats" : "");
  if (verdict.offending_pairs > 0)
    std::cout << "; " << counted(verdict.offending_pairs, "offending pair")
              << (verdict.header.may_pairs_descend ? ", from which others may descend"
                                                   : " that must stay as they are");
  if (verdict.is_obstacle_judged)
    std::cout << "\nobstacle: " << bound(verdict.is_obstacle_stated);
  std::cout << "\nresult: "
            << (verdict.is_result_another ? "NOT BOUND (the log has another SHA-256)"
                                          : bound(verdict.is_result_stated))
            << '\n';
  if (verdict.snaps > 0)
    std::cout << "snaps: at most " << with_digits(verdict.largest_snap)
              << " long; together they moved a vertex by at most "
              << with_digits(verdict.largest_way_of_snaps) << '\n';
  for (const Not_judged& open : not_judged(verdict))
    std::cout << "not judged: " << open.key << ": " << open.sentence << '\n';
}

std::string summary_of_terms(const Replay_verdict& verdict)
{
  const bool has_limits =
      verdict.limits_source != Limits_source::none && describe(verdict.limits) != describe({});
  std::string permitted;
  for (const auto& [a, b] : verdict.header.may_intersect)
    permitted += ", '" + a + "' and '" + b + "' MAY INTERSECT";
  return std::string(has_limits ? "limits of the " : "no limits") +
         (has_limits ? name(verdict.limits_source) : "") +
         (verdict.is_input_stated ? ", input bound" : ", input NOT BOUND") +
         (verdict.is_result_stated ? ", result bound" : ", result NOT BOUND") +
         (verdict.is_obstacle_stated   ? ", obstacle bound"
          : verdict.is_obstacle_judged ? ", obstacle NOT BOUND"
          : verdict.header.obstacle    ? ", obstacle NOT JUDGED"
                                       : "") +
         permitted;
}

void print(const Replay_request& request, const Replay_verdict& verdict)
{
  std::cout << input_name(request.log) << ": " << counted(verdict.snaps, "snap") << ", "
            << counted(verdict.collapses, "collapse") << "; "
            << counted(verdict.soup.triangles.size(), "triangle") << " left\n"
            << "judged: " << with_commas(verdict.pairs_judged) << " pairs of triangles, "
            << with_commas(verdict.pairs_judged_in_rationals) << " of them in rational numbers; "
            << with_digits(verdict.seconds_prepare) << " s for the original, "
            << with_digits(verdict.seconds_steps) << " s for the steps";
  if (verdict.steps > 0)
    std::cout << ", " << with_digits(1e6 * verdict.seconds_steps / double(verdict.steps), "%.1f")
              << " us each";
  std::cout << '\n';
  print_terms(verdict);
  if (verdict.is_accepted()) {
    std::cout << "ACCEPTED: " << summary_of_terms(verdict) << std::endl;
    return;
  }
  if (verdict.violations.empty()) {
    std::cout << "interrupted: no violation was found until then" << std::endl;
    return;
  }
  std::cout << "REFUSED; the first violation:\n";
  print_at_length(verdict.violations.front());
  if (request.is_all_wanted) {
    std::cout << "all " << with_commas(verdict.violations.size()) << ":\n";
    for (const Violation& violation : verdict.violations)
      std::cout << app::describe(violation) << '\n';
    for (const auto& [kind, count] : count_by_kind(verdict.violations))
      std::cout << "total " << kind << ": " << with_commas(count) << '\n';
  }
  std::cout << std::flush;
}

void print(const std::string& pose, const Replay_verdict& verdict)
{
  std::cout << "pose '" << pose << "': "
            << (verdict.is_accepted()        ? "ACCEPTED"
                : verdict.violations.empty() ? "interrupted"
                                             : "REFUSED; the first violation:")
            << '\n';
  if (!verdict.violations.empty())
    print_at_length(verdict.violations.front());
  std::cout << std::flush;
}

void write_scene(const std::string& file, const Replay_verdict& verdict,
                 const std::vector<Replay_verdict>& in_poses)
{
  const auto pose =
      std::find_if(in_poses.begin(), in_poses.end(), [](const auto& v) { return !v.violations.empty(); });
  if (verdict.violations.empty() && pose == in_poses.end())
    return;
  const Violation& first = (verdict.violations.empty() ? *pose : verdict).violations.front();
  if (first.scene.empty())
    std::cerr << "selvedge: --scene: no file is written: in the first violation (" << name(first.kind)
              << ") no triangles meet or lose their area" << std::endl;
  else
    write_file(output_path(file), first.scene);
}

// Returns the steps that were taken, as collapses of vertices of the original. One that joins no two vertices
// moves nothing.
std::vector<Soup_collapse> steps_taken(Log_reader& log, const Log_numbering& numbering,
                                       const Replay_verdict& verdict)
{
  std::vector<Soup_collapse> steps;
  auto violation = verdict.violations.begin();
  Log_step step;
  while (steps.size() < verdict.steps && log.read(step)) {
    if (step.kind != Log_step::Kind::snap && step.kind != Log_step::Kind::collapse)
      continue;
    steps.push_back(
        {numbering.vertex(step.removed), numbering.vertex(step.kept), step.place, step.is_removed_first});
    if (violation == verdict.violations.end() || violation->step != steps.size())
      continue;
    if (violation->kind == Violation_kind::no_edge)
      steps.back() = {steps.back().kept, steps.back().kept};
    ++violation;
  }
  return steps;
}

// Returns the numbers of those poses of the mesh that the log names. Throws when it has others as well, or
// none at all.
std::vector<std::size_t> poses_of_log(const Replay_request& request, const Triangle_soup& original,
                                      const Log_header& header, const std::optional<Triangle_soup>& obstacle)
{
  const auto fail = [&](const std::string& message) {
    throw Input_error(input_name(request.original) + " with " + input_name(request.log) + ": " + message);
  };
  if (header.poses.empty())
    fail("the log names no further pose; leave out " + std::string(options_of_poses));
  std::vector<std::size_t> numbers;
  std::vector<const Log_header::Posed*> found;
  for (std::size_t pose = 0; pose < original.poses.size(); ++pose)
    if (const auto place = stated_pose(header, original, pose, obstacle ? &*obstacle : nullptr)) {
      numbers.push_back(pose);
      found.push_back(&header.poses[*place]);
    }
  for (const Log_header::Posed& pose : header.poses) {
    // Two poses may have the same places.
    const auto is_it = [&](const Log_header::Posed* other) {
      return other == &pose || (!pose.sha256.empty() && other->sha256 == pose.sha256 &&
                                (!obstacle || other->sha256_of_obstacle == pose.sha256_of_obstacle));
    };
    if (std::none_of(found.begin(), found.end(), is_it))
      fail("none of the poses given is the pose '" + pose.name + "' that the log names" +
           (pose.sha256.empty() ? "" : ", by the SHA-256 of its places") +
           "; give all poses that the log was made with");
  }
  return numbers;
}

void print_other_poses(const std::vector<Pose>& poses, const std::vector<std::size_t>& judged)
{
  std::vector<std::string> others;
  for (std::size_t pose = 0; pose < poses.size(); ++pose)
    if (std::find(judged.begin(), judged.end(), pose) == judged.end())
      others.push_back(poses[pose].name);
  if (others.empty())
    return;
  constexpr std::size_t most_named = 10;
  std::cout << counted(others.size(), "further pose") << " not judged: the log does not name ";
  for (std::size_t i = 0; i < (std::min)(others.size(), most_named); ++i)
    std::cout << (i == 0 ? "'" : ", '") << others[i] << '\'';
  if (others.size() > most_named)
    std::cout << " and " << with_commas(others.size() - most_named) << " others";
  std::cout << '\n';
}

std::unique_ptr<std::istream> in_memory(std::istream& stream)
{
  std::ostringstream text;
  text << stream.rdbuf();
  return std::make_unique<std::istringstream>(text.str());
}

void rewind(std::istream& stream)
{
  stream.clear();
  stream.seekg(0);
}

// Refuses what can be refused before any work is done.
void check(const Replay_request& request)
{
  require_html(request.html);
  const std::vector<Named_file> written{{"--output", request.output},
                                        {"--scene", request.scene},
                                        {"--report", request.report},
                                        {"--html", request.html}};
  std::vector<Named_file> put_out = written;
  if (request.is_json)
    put_out.push_back({"--json", "-"});
  check_streams({{"ORIGINAL", request.original}, {"LOG", request.log}, {"--obstacle", request.obstacle}},
                put_out, request.format);
  require_use_of_ascii(request.is_ascii, {request.output}, request.format);
  if (!request.output.empty())
    format_of(request.output, request.format);
  check_obstacle_poses(request.obstacle_poses, request.obstacle, request.poses);
  std::vector<Named_file> read{
      {"ORIGINAL", request.original}, {"LOG", request.log}, {"--obstacle", request.obstacle}};
  append_pose_files(read, "--pose", request.poses.files, request.original);
  append_pose_files(read, "--obstacle-pose", request.obstacle_poses.files, request.obstacle);
  require_distinct(written, read);
  require_writable(written);
}

Json report_json(const Replay_request& request, const Mesh_file& original, const Replay_verdict& verdict,
                 const std::vector<Replay_verdict>& in_poses, const std::vector<std::size_t>& numbers,
                 Exit_code code)
{
  Json report = new_report("replay");
  report["input"] = input_json(request.original, original);
  report["log"] = {{"path", request.log}};
  report["obstacle"] = request.obstacle.empty() ? Json(nullptr) : Json{{"path", request.obstacle}};
  add_replay(report, verdict);
  Json poses = Json::array();
  for (std::size_t i = 0; i < in_poses.size(); ++i) {
    Json& pose = poses.emplace_back(Json{{"name", original.soup.poses[numbers[i]].name}});
    add_replay(pose, in_poses[i]);
  }
  report["poses"] = std::move(poses);
  report["memory"] = {{"peak_bytes", peak_memory_bytes()}};
  report["exit_code"] = int(code);
  return report;
}

// Returns the page that shows the steps of a log, in the mesh as the log rounds it.
std::string page(const Replay_request& request, Mesh_file original, const Triangle_soup& obstacle,
                 std::istream& text, const Replay_verdict& verdict,
                 const std::vector<Replay_verdict>& in_poses, const std::vector<std::size_t>& numbers,
                 const Json& report)
{
  const Log_numbering numbering(original.soup, original.format == Mesh_format::stl);
  if (verdict.header.is_rounded_to_float32)
    round_to_float32(original.soup);
  Html_report html(original.soup, obstacle);
  rewind(text);
  Log_reader log(text, input_name(request.log));
  html.add_replay(request.log, verdict, html.add_collapses(steps_taken(log, numbering, verdict)));
  html.add_violations(verdict.violations, 0);
  for (std::size_t i = 0; i < in_poses.size(); ++i)
    html.add_violations(in_poses[i].violations, numbers[i] + 1);
  return html.page(report);
}

Exit_code run(const Replay_request& request)
{
  check(request);
  Replay_options options;
  options.limits = imposed_limits(request.limits);
  std::unique_ptr<std::istream> stream = open_text(request.log);
  if (!request.poses.empty() || !request.html.empty()) // is read again for each pose, and for the page
    stream = in_memory(*stream);
  Mesh_input input(request.original, request.format);
  Mesh_file original = input.read();
  if (request.are_polygons_split)
    original.soup.polygons.clear();
  read_poses(request.poses, request.original, original.soup);
  if (!request.obstacle.empty()) {
    Mesh_input obstacle_input(request.obstacle, request.format);
    options.obstacle = obstacle_input.read().soup;
    read_obstacle_poses(request.obstacle_poses, request.obstacle, request.poses, *options.obstacle);
    options.sha256_of_obstacle = obstacle_input.sha256();
  }

  // A signal during the steps keeps the verdict until then. At any other time it ends the run without one.
  std::atomic<bool> is_kept = false;
  const Cancellation_scope scope([&] { return is_interrupted() && !is_kept; });
  options.are_limits_judged = !request.is_free_of_limits;
  options.sha256_of_original = input.sha256();
  options.is_all_wanted = request.is_all_wanted;
  options.should_stop = [&](std::size_t) { return is_kept = is_interrupted(); };
  const auto replay_once = [&] {
    try {
      if (options.pose)
        rewind(*stream);
      Log_reader log(*stream, input_name(request.log));
      return replay(original.soup, original.format == Mesh_format::stl, log, options);
    } catch (const Input_error& error) {
      throw Input_error(input_name(request.original) + " with " + input_name(request.log) + ": " +
                        error.what());
    }
  };
  Replay_verdict verdict = replay_once();
  std::vector<Replay_verdict> in_poses;
  std::vector<std::size_t> numbers;
  if (!original.soup.poses.empty() && !verdict.is_stopped)
    numbers = poses_of_log(request, original.soup, verdict.header, options.obstacle);
  for (const std::size_t pose : numbers) {
    options.pose = pose;
    in_poses.push_back(replay_once());
    in_poses.back().soup = {};
  }
  const auto is_any = [&](const auto& is_so) {
    return is_so(verdict) || std::any_of(in_poses.begin(), in_poses.end(), is_so);
  };
  const Exit_code code = is_any([](const Replay_verdict& v) { return !v.violations.empty(); })
                             ? exit_not_verified
                         : is_any([](const Replay_verdict& v) { return v.is_stopped; }) ? exit_interrupted
                                                                                        : exit_done;
  const Json report = report_json(request, original, verdict, in_poses, numbers, code);
  {
    const Text_to_standard_error elsewhere(is_standard_output(request.output) ||
                                           is_standard_output(request.scene) ||
                                           is_standard_output(request.html));
    put_report(request, report, [&] {
      print(request, verdict);
      for (std::size_t i = 0; i < in_poses.size(); ++i)
        print(original.soup.poses[numbers[i]].name, in_poses[i]);
      if (!verdict.is_stopped)
        print_other_poses(original.soup.poses, numbers);
    });
  }
  if (!request.scene.empty())
    write_scene(request.scene, verdict, in_poses);
  if (!request.output.empty() && !verdict.is_stopped) {
    const Mesh_format format = format_of(request.output, request.format);
    relocate(verdict.soup, format, request.original, request.output);
    write_output(request.output, verdict.soup, format, request.is_ascii);
  }
  if (!request.html.empty())
    write_file(output_path(request.html),
               page(request, std::move(original), options.obstacle.value_or(Triangle_soup()), *stream,
                    verdict, in_poses, numbers, report));
  return code;
}

} // namespace

Action add_replay(CLI::App& command)
{
  const auto request = std::make_shared<Replay_request>();
  command.add_option("ORIGINAL", request->original, "Mesh that was reduced.")->required()->type_name("");
  command.add_option("LOG", request->log, "Log of the collapses that reduced it.")->required()->type_name("");
  const char* const poses = "Poses (those of the log)";
  add_pose_options(
      command, request->poses, "ORIGINAL",
      "The further poses of the log, in each of which every step is judged, too: a mesh file, or a pattern "
      "in quotes. May be given several times. The log tells by their places which pose is which.",
      poses);
  command
      .add_option(
          "--obstacle", request->obstacle,
          "Mesh that the steps must keep clear of, too: the obstacle that the log names, or any other if "
          "it names none.")
      ->type_name("FILE");
  add_obstacle_pose_options(command, request->obstacle_poses, "ORIGINAL", poses);
  command
      .add_option(
          "-o,--output", request->output,
          "File for the mesh to which the steps lead, as `simplify` writes it. What a log does not hold is "
          "not done: pieces stay separate (--sewn), normals are not made anew (--normals), and "
          "attributes are not interpolated (--placement optimal). With these, positions and faces are "
          "the same, but not the files.")
      ->type_name("FILE");
  CLI::Option* const limits =
      command
          .add_option(
              "--limits", request->limits,
              "Limits to judge in place of those that the log declares: a file with lines 'limit NAME "
              "NUMBER', those of the paper (seed), or the defaults of `simplify` (default).")
          ->type_name("FILE|seed|default");
  command
      .add_flag("--no-limits", request->is_free_of_limits,
                "Judge topology and intersections alone, not angles, shapes and drift. The length of snaps "
                "is judged "
                "all the same.")
      ->excludes(limits);
  command.add_flag("--all", request->is_all_wanted, "Continue after a bad step, and list all bad steps.");
  command
      .add_option(
          "--scene", request->scene,
          "Write the triangles of the first violation to an OBJ file, if some meet or lose their area.")
      ->type_name("FILE");
  add_format_option(command, request->format);
  add_report_options(command, *request);
  add_html_option(command, request->html);
  add_polygons_option(command, request->are_polygons_split);
  add_ascii_option(command, request->is_ascii);
  command.footer(
      "Examples:\n"
      "  selvedge simplify jacket.obj -o small.obj --ratio 0.3 --log jacket.log --placement vertices\n"
      "  selvedge replay jacket.obj jacket.log -o again.obj && cmp small.obj again.obj\n"
      "  selvedge replay jacket.obj jacket.log --obstacle body.obj    # does it keep clear of the body, "
      "too?\n"
      "  selvedge replay jacket.obj jacket.log --limits seed    # the paper's limits, not the log's\n"
      "  selvedge replay jacket.obj of_my_own_program.log --no-limits --all\n"
      "  selvedge replay jacket.obj jacket.log --all --html jacket.html    # look at every step\n"
      "  selvedge replay jacket.obj jacket.log --json | jq .terms\n\n"
      "The exit code is 0 when every step is accepted and the result is what the log says. A verdict covers "
      "only\n"
      "what it says was judged: it names the limits with their values, says whether the log holds the "
      "SHA-256 of\n"
      "ORIGINAL and of the result, and lists what was not judged. docs/validate_your_simplifier.md explains "
      "how to\n"
      "write a log, collapse_log.h defines its format, and docs/report.md the JSON report.");
  return [request] { return run(*request); };
}

} // namespace selvedge::app
