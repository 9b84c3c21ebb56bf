// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Outcome.h"
#include "Progress_bar.h"
#include "interruption.h"
#include "output_files.h"
#include "report_json.h"
#include "subcommands.h"
#include "text.h"
#include "threads.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/Reduction_log.h>
#include <selvedge/Sha256.h>
#include <selvedge/collapse_log.h>
#include <selvedge/merge.h>
#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>
#include <selvedge/verify.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace selvedge::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Request
{
  std::string input;
  std::string output;
  std::string report;
  std::string log;
  std::vector<std::string> ratios; // "R" or "PART=R"
  std::vector<double> lods;
  std::string obstacle;
  Simplify_options options;
  Simplify_intent intent;
  bool is_unguarded = false;
  bool is_in_cells = false;
  double weld_distance = 0;
  bool is_sewn = false;
  bool is_strict = false;
  bool is_target_required = false;
  bool is_quiet = false;
  bool is_ascii = false;
  std::optional<std::size_t> threads;
};

// Large enough that few vertices lie on cell walls, small enough that a cell stays in a processor's cache.
constexpr std::size_t faces_per_cell = 50'000;

constexpr std::string_view level_mark = "{lod}";

/// Returns the output file of each level: the name with the level's number, from 1, in place of the mark.
/// Without levels it is the name as given.
std::vector<std::string> outputs(const Request& request)
{
  if (request.lods.empty())
    return {request.output};
  const std::size_t place = request.output.find(level_mark);
  if (place == std::string::npos)
    throw Argument_error(
        "--lods: the name of the output must contain {lod}, which stands for the number of the level: -o "
        "'jacket_{lod}.obj'");
  std::vector<std::string> names;
  for (std::size_t level = 1; level <= request.lods.size(); ++level)
    names.push_back(std::string(request.output).replace(place, level_mark.size(), std::to_string(level)));
  return names;
}

double ratio_in(const std::string& text)
{
  double ratio = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ratio);
  if (error != std::errc() || end != text.data() + text.size() || !(ratio >= 0 && ratio <= 1))
    throw Argument_error("--ratio: '" + text + "' is not a number from 0 to 1");
  return ratio;
}

void read_ratios(Request& request)
{
  for (const std::string& text : request.ratios)
    if (const std::size_t equals = text.rfind('='); equals != std::string::npos)
      request.intent.ratios.push_back({text.substr(0, equals), ratio_in(text.substr(equals + 1))});
    else if (request.options.ratio)
      throw Argument_error("--ratio: '" + text +
                           "' is a second ratio for the whole mesh; name a part, as in PART=" + text);
    else
      request.options.ratio = ratio_in(text);
}

Json options_json(const Request& request)
{
  const Simplify_options& options = request.options;
  Json part_ratios = Json::array();
  for (const Simplify_intent::Part_ratio& part : request.intent.ratios)
    part_ratios.push_back({{"part", part.name}, {"ratio", part.ratio}});
  const auto optional = [](const auto& value) { return value ? Json(*value) : Json(nullptr); };
  return {{"ratio", optional(options.ratio)},
          {"faces", optional(options.faces)},
          {"error", optional(options.max_error)},
          {"normal_change", options.max_normal_change},
          {"aspect_ratio", options.min_aspect_ratio},
          {"border_turn", options.max_border_turn},
          {"seam_turn", options.max_seam_turn},
          {"border_drift", options.max_border_drift},
          {"loop", options.loop == Collapse_loop::own ? "own" : "cgal"},
          {"index", options.index == Face_index::packed ? "packed" : "clusters"},
          {"cluster_size", options.faces_per_cluster},
          {"intersection_check", options.check_intersections},
          {"stabiliser", options.cost.stabiliser},
          {"border_weight", options.cost.border_weight},
          {"uv_weight", options.uv_weight},
          {"part_ratios", part_ratios},
          {"lods", request.lods},
          {"lock", request.intent.locked},
          {"keep", request.intent.kept},
          {"weights", request.intent.weights.empty() ? Json(nullptr) : Json(request.intent.weights)},
          {"obstacle", request.obstacle.empty() ? Json(nullptr) : Json(request.obstacle)},
          {"weld", request.weld_distance},
          {"sewn", request.is_sewn},
          {"threads", optional(request.threads)},
          {"cells", request.is_in_cells},
          {"strict", request.is_strict}};
}

/// Refuses what can be refused before any work is done.
void check(const Request& request)
{
  if (!request.options.ratio && !request.options.faces && !request.options.max_error &&
      request.intent.ratios.empty() && request.lods.empty())
    throw Argument_error("say how far to reduce the mesh: give --ratio, --faces, --error or --lods");
  if (!request.lods.empty() && (request.options.ratio || request.options.faces))
    throw Argument_error("--lods already says how far to reduce the mesh; leave out --ratio R and --faces");
  if (request.is_in_cells && !request.intent.ratios.empty())
    throw Argument_error(
        "--cells: parts cannot have ratios of their own; leave out --cells or --ratio PART=R");
  for (const std::string& output : outputs(request)) {
    output_format(output);
    if (!request.report.empty() &&
        (is_same_file(request.report, output) || is_same_file(request.report, request.input)))
      throw Argument_error("--report: this file is also a mesh of this run; name another one: " +
                           request.report);
    require_writable(output);
  }
  if (!request.report.empty())
    require_writable(request.report);
  if (request.log.empty())
    return;
  if (!request.lods.empty())
    throw Argument_error(
        "--log: a log holds one reduction, but --lods asks for several; leave out one of the two");
  for (const std::string& other : {request.output, request.input, request.report})
    if (!other.empty() && is_same_file(request.log, other))
      throw Argument_error("--log: this file has another purpose in this run; name another one: " +
                           request.log);
  require_writable(request.log);
}

/// Says in a clause why a reduction ended before its target.
std::string why_missed(const Simplify_report& report)
{
  const std::string outcome = report.outcome();
  for (const Refusals::Rule& rule : Refusals::rules())
    if (outcome == rule.key)
      return std::string("the rule '") + rule.name + "' refuses most of the collapses left";
  return report.is_stopped ? "it was interrupted" : "every collapse left would change the topology";
}

/// One level of detail: its result, its output file, and the verdict of the judge.
struct Level
{
  std::string output;
  Simplified_soup result;
  Verification verification;
};

/// Reduces one file to one output, or to one for each level of detail.
class Reduction
{
public:
  explicit Reduction(const Request& request) : m_request(request), m_bar(!request.is_quiet) {}

  Exit_code run()
  {
    const Cancellation_scope scope([this] { return is_interrupted() && !m_is_kept; });
    try {
      m_report["input"] = nullptr;
      const Prepared_soup prepared = read_and_prepare();
      std::vector<Level> levels = reduce(prepared);
      judge(levels, prepared);
      write(levels);
      report(prepared, levels);
      return m_outcome.exit_code();
    } catch (const Interrupted&) {
      m_bar.clear();
      if (m_files_written == 0)
        throw;
      complain("interrupted; " + counted(m_files_written, "output file") +
               (m_files_written == 1 ? " was" : " were") + " written before");
      return exit_interrupted;
    }
  }

private:
  Prepared_soup read_and_prepare()
  {
    m_bar.begin("reading");
    const Clock::time_point start = Clock::now();
    Mesh_file file = read_mesh(m_request.input);
    m_seconds["read"] = seconds_since(start);
    m_report["input"] = input_json(m_request.input, file);
    if (!m_request.log.empty()) {
      m_numbering.emplace(file.soup, file.format == Mesh_format::stl);
      m_log_header.vertices = m_numbering->size();
      m_log_header.triangles = file.soup.triangles.size();
      m_log_header.sha256 = sha256_of_file(m_request.input);
      m_log_header.is_rounded_to_float32 = needs_float32(file.soup, mesh_format(m_request.output));
    }
    const Triangle_soup obstacle =
        m_request.obstacle.empty() ? Triangle_soup() : read_mesh(m_request.obstacle).soup;
    if (!m_request.obstacle.empty())
      m_log_header.obstacle = {obstacle.points.size(), obstacle.triangles.size(),
                               sha256_of_file(m_request.obstacle)};

    m_bar.begin("judging the input");
    Prepare_options options;
    options.round_to_float32 = needs_float32(file.soup, mesh_format(m_request.output));
    options.is_strict = m_request.is_strict;
    options.weld_distance = m_request.weld_distance;
    try {
      return prepare(std::move(file.soup), options, obstacle);
    } catch (const Input_error& error) {
      throw Input_error(m_request.input + ": " + error.what());
    }
  }

  std::vector<Level> reduce(const Prepared_soup& prepared)
  {
    m_bar.begin("sewing and indexing");
    Simplify_options options = m_request.options;
    options.should_stop = [this](const Simplify_progress& progress) {
      m_bar.update(progress);
      m_is_kept = true;
      if (!is_interrupted())
        return false;
      if (!std::exchange(m_is_stop_told, true))
        complain("stopping: what was reached is judged and written next; interrupt again to end at once");
      return true;
    };
    std::optional<Reduction_log> log;
    if (!m_request.log.empty()) {
      log.emplace(m_log, m_log_header, *m_numbering, prepared, options);
      options.on_collapse = [&log](std::size_t removed, std::size_t kept) {
        log->add_collapse(removed, kept);
      };
    }
    std::vector<Simplified_soup> results;
    if (m_request.lods.empty())
      results.push_back(simplify_soup(prepared, options, m_request.intent));
    else
      results = simplify_lods(prepared, options, m_request.lods, m_request.intent);
    const auto is_stopped = [](const Simplified_soup& result) { return result.report.is_stopped; };
    const auto is_untouched = [](const Simplified_soup& result) { return result.report.collapses == 0; };
    m_is_kept = std::any_of(results.begin(), results.end(), is_stopped);
    if (m_is_kept && std::all_of(results.begin(), results.end(), is_untouched))
      throw Interrupted("interrupted before the reduction began");
    if (log)
      log->finish(results.back());
    m_seconds["check"] = prepared.seconds_check;
    m_seconds["snap"] = prepared.seconds_snap;
    m_seconds["weld"] = prepared.seconds_positions;
    const std::vector<std::string> names = outputs(m_request);
    std::vector<Level> levels;
    for (std::size_t i = 0; i < results.size(); ++i) {
      // When one run passes through all levels, the last one has the time of all.
      m_seconds["weld"] = std::max(m_seconds["weld"], prepared.seconds_positions + results[i].seconds_sew);
      m_seconds["index"] = std::max(m_seconds["index"], results[i].report.seconds_index);
      m_seconds["cells"] = std::max(m_seconds["cells"], results[i].report.seconds_cells);
      m_seconds["reduce"] = std::max(m_seconds["reduce"], results[i].report.seconds_reduce);
      levels.push_back({names[i], std::move(results[i]), {}});
    }
    return levels;
  }

  void judge(std::vector<Level>& levels, const Prepared_soup& prepared)
  {
    m_bar.begin(levels.size() == 1 ? "judging the result" : "judging the results");
    const Clock::time_point start = Clock::now();
    m_outcome.is_guarded = m_request.options.check_intersections;
    m_outcome.is_target_required = m_request.is_target_required;
    for (Level& level : levels) {
      level.verification = verify(level.result, prepared);
      m_outcome.is_accepted &= level.verification.accepted() && level.verification.same_topology();
      m_outcome.is_interrupted |= level.result.report.is_stopped;
      m_outcome.is_reached &= level.result.report.is_reached();
    }
    m_seconds["verify"] = seconds_since(start);
  }

  void write(const std::vector<Level>& levels)
  {
    const Clock::time_point start = Clock::now();
    if (m_outcome.is_written()) {
      m_bar.begin("writing");
      // Merging changes nothing but vertex numbers: the verdict on positions stands.
      for (const auto& [output, result, verification] : levels) {
        write_output(output, m_request.is_sewn ? merged_at_positions(result.soup) : result.soup,
                     m_request.is_ascii);
        ++m_files_written;
      }
    }
    // The log is written even when the result was refused, because it shows why.
    if (!m_request.log.empty()) {
      write_file(m_request.log, m_log.str());
      ++m_files_written;
    }
    m_seconds["write"] = seconds_since(start);
    m_bar.clear();
    for (const Level& level : levels)
      complain_of(level);
  }

  void complain_of(const Level& level)
  {
    const auto& [output, result, verification] = level;
    const std::string where = m_request.lods.empty() ? "" : output + ": ";
    if (!m_outcome.is_written()) {
      if (!verification.accepted() || !verification.same_topology())
        complain(
            where + "THE RESULT IS WRONG and was not written: " +
            counted(verification.new_pairs.size(), "new offending pair") +
            (verification.same_topology() ? "" : ", topology changed") +
            (verification.matching.is_complete() ? "" : ", " + verification.matching.mismatches[0].message) +
            "; this is a bug in selvedge: please report it with the input and the options");
    } else if (!m_outcome.is_guarded) {
      complain(where + "written but not verified, because of --no-intersection-check: " +
               counted(verification.new_pairs.size(), "new offending pair"));
    } else if (result.report.is_stopped) {
      complain(where + "interrupted at " + counted(result.soup.triangles.size(), "face") +
               "; this result is verified and written");
    } else if (m_request.is_target_required && !result.report.is_reached()) {
      complain(where + "the target of " + counted(result.report.faces_target, "face") +
               " was missed: " + with_commas(result.soup.triangles.size()) + " are left, because " +
               why_missed(result.report) + "; the result is written");
    }
  }

  void report(const Prepared_soup& prepared, const std::vector<Level>& levels)
  {
    const Mesh_format format = mesh_format(m_request.output);
    const std::vector<std::string> dropped = not_carried(prepared.soup, format);
    if (!m_request.is_quiet) {
      print_input(prepared, dropped);
      for (const Level& level : levels)
        print_summary(prepared, level);
    }
    if (m_request.report.empty())
      return;
    double seconds_parts = 0;
    const auto add_level = [&](Json& json, const Level& level) {
      json["output"] = {
          {"path", level.output}, {"written", m_outcome.is_written()}, {"not_carried", dropped}};
      if (&json == &m_report)
        json["options"] = options_json(m_request);
      add_reduction(json, prepared, level.result);
      add_verification(json, level.verification, true);
      const Clock::time_point start = Clock::now();
      add_parts(json, prepared, level.result);
      seconds_parts += seconds_since(start);
    };
    add_level(m_report, levels.back());
    for (const Level& level : levels)
      if (!m_request.lods.empty())
        add_level(m_report["lods"].emplace_back(Json::object()), level);
    m_seconds["parts"] = seconds_parts;
    m_report["seconds"] = Json::object();
    for (const char* phase :
         {"read", "weld", "check", "snap", "index", "cells", "reduce", "verify", "write", "parts"})
      m_report["seconds"][phase] = m_seconds[phase];
    m_report["memory"] = {{"peak_bytes", peak_memory_bytes()}};
    m_report["exit_code"] = int(m_outcome.exit_code());
    write_file(m_request.report, to_text(m_report));
  }

  void print_input(const Prepared_soup& prepared, const std::vector<std::string>& dropped)
  {
    std::cout << m_request.input << ": " << counted(prepared.soup.triangles.size(), "face");
    if (!prepared.offending_pairs.empty())
      std::cout << ", " << counted(prepared.offending_pairs.size(), "offending pair") << ", "
                << counted(prepared.frozen_faces, "face") << " frozen";
    if (const std::size_t left_out = prepared.left_out_faces + prepared.left_out_by_rounding; left_out > 0)
      std::cout << ", " << counted(left_out, "degenerate face") << " left out";
    std::cout << '\n';
    for (const Json& note : m_report["input"]["notes"])
      std::cout << "  " << note.get<std::string>() << '\n';
    if (prepared.rounding.coordinates > 0)
      std::cout << "  " << counted(prepared.rounding.coordinates, "coordinate")
                << " rounded to 32-bit floats, because the output's format stores nothing more precise\n";
    if (m_request.weld_distance > 0)
      print_snapping(prepared.snapping);
    const char* separator = "  not in the output, because its format cannot hold them: ";
    for (const std::string& what : dropped)
      std::cout << std::exchange(separator, ", ") << what;
    std::cout << (dropped.empty() ? "" : "\n");
  }

  void print_summary(const Prepared_soup& prepared, const Level& level)
  {
    const auto& [output, result, verification] = level;
    const Simplify_report& done = result.report;
    const std::size_t faces = result.soup.triangles.size();
    std::cout << "reduced to " << counted(faces, "face") << " ("
              << with_digits(100.0 * double(faces) / double(prepared.soup.triangles.size())) << " %) in "
              << with_digits(done.seconds_reduce) << " s: ";
    if (m_request.options.ratio || m_request.options.faces || !m_request.lods.empty() ||
        !m_request.intent.ratios.empty())
      std::cout << "target " << with_commas(done.faces_target)
                << (done.is_reached() ? " reached" : " not reached: " + why_missed(done));
    else
      std::cout << "as far as the limits allow";
    std::cout << "\ncollapses refused, by rule:";
    const char* separator = " ";
    for (const Refusals::Rule& rule : Refusals::rules())
      if (done.refused.*rule.count > 0)
        std::cout << std::exchange(separator, ", ") << rule.name << ' '
                  << with_commas(done.refused.*rule.count);
    std::cout << (*separator == ' ' ? " none" : "") << "\njudged: ";
    if (verification.embedded())
      std::cout << "embedded (no triangles touch or cross)";
    else
      std::cout << counted(verification.pairs.size(), "offending pair")
                << " (triangles that touch or cross, or are degenerate), "
                << with_commas(verification.new_pairs.size()) << " of them new";
    std::cout << ", topology " << (verification.same_topology() ? "kept" : "CHANGED")
              << "\ndistance from the original's vertices: "
              << with_digits(100 * verification.distances->original_to_result.root_mean_square)
              << " % of the diagonal (RMS), at most "
              << with_digits(100 * verification.distances->original_to_result.maximum) << " %\n"
              << (m_outcome.is_written() ? "written: " : "NOT written: ") << output << std::endl;
  }

  static void print_snapping(const Snapping_notes& notes)
  {
    std::cout << "  seams closed: " << with_commas(notes.snapped) << " of " << with_commas(notes.partnered)
              << " border vertices that have a partner, along " << counted(notes.seam_edges, "edge")
              << "; the widest gap was " << with_digits(notes.largest_distance) << '\n';
    const auto print = [](std::size_t count, const char* why) {
      if (count > 0)
        std::cout << "  not closed: " << with_commas(count) << " border "
                  << (count == 1 ? "vertex" : "vertices") << ", because " << why << '\n';
    };
    print(notes.left_blocked, "another part of the mesh lies in the gap");
    print(notes.left_folding, "a face would degenerate or fold over");
    print(notes.left_unmanifold, "more than two faces would meet at an edge");
    print(notes.left_frozen, "a face there is frozen");
    print(notes.left_foreign, "the partner belongs to a node with another transform");
    print(notes.left_ambiguous, "every partner has a nearer one");
    print(notes.near_without_edge, "no edge beside them can be sewn to the border that is near");
  }

  void complain(const std::string& message)
  {
    m_bar.clear();
    std::cerr << "selvedge: " << message << std::endl;
  }

  const Request& m_request;
  Progress_bar m_bar;
  Outcome m_outcome;
  Json m_report = new_report("simplify");
  std::optional<Log_numbering> m_numbering; // these three are used only when a log is written
  Log_header m_log_header;
  std::ostringstream m_log;
  std::map<std::string, double> m_seconds;
  bool m_is_stop_told = false;
  std::atomic<bool> m_is_kept = false; // a signal keeps what the reduction has reached
  std::size_t m_files_written = 0;
};

} // namespace

Action add_simplify(CLI::App& command)
{
  const auto request = std::make_shared<Request>();
  Simplify_options& options = request->options;
  command.add_option("IN", request->input, "Mesh to reduce: .obj, .off, .ply, .stl, .glb or .gltf.")
      ->required()
      ->type_name("");
  command
      .add_option("-o,--output", request->output,
                  "File to write; its ending chooses the format. It may be IN.")
      ->required()
      ->type_name("FILE");

  const char* const how_far =
      "How far to reduce (with several of these, the reduction stops at the first one that is met)";
  command
      .add_option(
          "--ratio", request->ratios,
          "Share of the faces to keep, from 0 to 1. PART=R is the share of one group, object or material; "
          "R alone is then for all others. May be given several times.")
      ->type_name("[PART=]R")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(how_far);
  command.add_option("--faces", options.faces, "Number of faces to keep.")
      ->check(in_range(0))
      ->type_name("N")
      ->group(how_far);
  command
      .add_option("--error", options.max_error,
                  "Largest error that a collapse may make, as a share of the diagonal of the bounding box.")
      ->check(in_range(0))
      ->type_name("E")
      ->group(how_far);

  command
      .add_option(
          "--lods", request->lods,
          "Ratios of several levels of detail, made in one run. Each is what a run for it alone gives. "
          "In the name of the output, {lod} stands for the number of the level.")
      ->delimiter(',')
      ->check(in_range(0, 1))
      ->type_name("R,R")
      ->group(how_far);

  const char* const parts = "Parts (PART names a group, an object or a material)";
  command
      .add_option("--lock", request->intent.locked,
                  "Parts whose vertices must not move. Their faces count towards the target.")
      ->type_name("PART")
      ->group(parts);
  command
      .add_option("--keep", request->intent.kept,
                  "Parts whose faces must not change. The target is for the other faces.")
      ->type_name("PART")
      ->group(parts);
  command
      .add_option("--weights", request->intent.weights,
                  "Vertex attribute that makes vertices costly to remove, relative to its largest value.")
      ->type_name("NAME")
      ->group(parts);
  command
      .add_option("--obstacle", request->obstacle,
                  "Mesh that no face may touch or pass through, such as a body. It is not changed, counted "
                  "or written.")
      ->type_name("FILE")
      ->group(parts);

  const char* const limits = "Limits of a collapse";
  command
      .add_option("--normal-change", options.max_normal_change,
                  "Largest turn of the normal of a face, in degrees.")
      ->check(in_range(0, 180))
      ->type_name("DEG")
      ->capture_default_str()
      ->group(limits);
  command
      .add_option("--aspect-ratio", options.min_aspect_ratio,
                  "Smallest aspect ratio of a face that becomes thinner, from 0 (a line) to 1 (equilateral). "
                  "0.2 keeps "
                  "faces round enough for a simulation.")
      ->check(in_range(0, 1))
      ->type_name("A")
      ->capture_default_str()
      ->group(limits);
  command
      .add_option("--border-turn", options.max_border_turn,
                  "Largest turn of a border at a vertex that is removed, in degrees.")
      ->check(in_range(0, 180))
      ->type_name("DEG")
      ->capture_default_str()
      ->group(limits);
  command
      .add_option("--seam-turn", options.max_seam_turn,
                  "The same for a seam, which has surface on both sides.")
      ->check(in_range(0, 180))
      ->type_name("DEG")
      ->capture_default_str()
      ->group(limits);
  command
      .add_option("--border-drift", options.max_border_drift,
                  "Largest distance of a border or seam from where it was, as a share of the diagonal.")
      ->check(in_range(0))
      ->type_name("D")
      ->capture_default_str()
      ->group(limits);
  command
      .add_flag("--no-intersection-check", request->is_unguarded,
                "Let layers pierce each other, to see what the check does. The exit code is 1, because the "
                "result is "
                "not verified.")
      ->group(limits);

  const char* const seams = "Seams";
  command
      .add_option("--weld", request->weld_distance,
                  "Close seams that gape: snap a border vertex onto its partner on another border within "
                  "this length, in "
                  "the unit of the file.")
      ->check(in_range(0))
      ->type_name("EPS")
      ->group(seams);
  command
      .add_flag(
          "--sewn", request->is_sewn,
          "Merge the vertices of pieces that meet, where their attributes allow it. Without this option, "
          "pieces that are separate in the input are separate in the output.")
      ->group(seams);

  const char* const tuning = "Tuning";
  command
      .add_option("--index", options.index,
                  "Index that finds the faces nearby: a packed R-tree, or clusters of faces with a CGAL AABB "
                  "tree each. "
                  "The result is the same.")
      ->transform(one_of<Face_index>({{"packed", Face_index::packed}, {"clusters", Face_index::clusters}}))
      ->type_name("packed|clusters")
      ->default_str("packed")
      ->group(tuning);
  command.add_option("--cluster-size", options.faces_per_cluster, "Faces per cluster, for --index clusters.")
      ->check(in_range(1))
      ->type_name("N")
      ->capture_default_str()
      ->group(tuning);
  command
      .add_option("--loop", options.loop,
                  "Loop that collapses edges: Selvedge's own, or CGAL's for comparison.")
      ->transform(one_of<Collapse_loop>({{"own", Collapse_loop::own}, {"cgal", Collapse_loop::cgal}}))
      ->type_name("own|cgal")
      ->default_str("own")
      ->group(tuning);
  command
      .add_option("--stabiliser", options.cost.stabiliser,
                  "Weight of the distance to the original vertices in the cost; it decides where the surface "
                  "is flat.")
      ->check(in_range(0))
      ->type_name("W")
      ->capture_default_str()
      ->group(tuning);
  command
      .add_option("--uv-weight", options.uv_weight,
                  "Weight of the displacement of the texture in the cost, relative to that of the surface; 0 "
                  "ignores it.")
      ->check(in_range(0))
      ->type_name("W")
      ->capture_default_str()
      ->group(tuning);
  command.add_option("--border-weight", options.cost.border_weight, "Weight of borders in the cost.")
      ->check(in_range(0))
      ->type_name("W")
      ->capture_default_str()
      ->group(tuning);

  const char* const conduct = "Conduct";
  command
      .add_flag("--strict", request->is_strict,
                "Refuse an input with intersecting, duplicate or degenerate faces, instead of leaving these "
                "faces as they are.")
      ->group(conduct);
  command
      .add_flag("--require-target", request->is_target_required,
                "End with exit code 1 when the target is missed.")
      ->group(conduct);
  Thread_limit::add_option(command, request->threads)->group(conduct);
  command
      .add_flag("--cells", request->is_in_cells,
                "For large meshes: first reduce boxes of space at once, on all threads, then the whole. This "
                "changes the result, but the number of threads does not.")
      ->group(conduct);
  command.add_option("--report", request->report, "Write a JSON report of the run.")
      ->type_name("FILE")
      ->group(conduct);
  command.add_option("--log", request->log, "Write a log of every collapse, for `selvedge replay`.")
      ->type_name("FILE")
      ->group(conduct);
  command.add_flag("--quiet", request->is_quiet, "Print no summary and no progress bar.")->group(conduct);
  command.add_flag("--ascii", request->is_ascii, "Write PLY and STL as text.")->group(conduct);

  command.footer(
      "Examples:\n"
      "  selvedge simplify jacket.obj -o small.obj --ratio 0.3\n"
      "  selvedge simplify jacket.obj -o small.ply --faces 20000 --report small.json\n"
      "  selvedge simplify jacket.obj -o jacket.obj --error 0.0005    # errors up to 0.05 % of the size\n"
      "  selvedge simplify jacket.obj -o 'jacket_{lod}.obj' --lods 0.5,0.25,0.1\n"
      "  selvedge simplify jacket.obj -o small.obj --ratio 0.2 --ratio collar=0.8 --keep logo --obstacle "
      "body.obj\n"
      "  selvedge simplify jacket.obj -o small.obj --ratio 0.1 --require-target || echo missed\n"
      "  selvedge simplify draped.obj -o small.obj --ratio 0.3 --weld 0.0001    # close narrow gaps\n\n"
      "The result is always judged before it is written. A target that cannot be reached is no error: the\n"
      "result is written, and summary and report say what prevented more. Ctrl-C during the reduction stops "
      "it,\n"
      "and what was reached is judged and written; at any other time nothing is written.");
  return [request] {
    request->options.check_intersections = !request->is_unguarded;
    request->options.faces_per_cell = request->is_in_cells ? faces_per_cell : 0;
    read_ratios(*request);
    check(*request);
    const Thread_limit limit(request->threads);
    return Reduction(*request).run();
  };
}

} // namespace selvedge::app
