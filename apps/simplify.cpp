// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Outcome.h"
#include "Progress_bar.h"
#include "Simplify_request.h"
#include "Thread_limit.h"
#include "html_report.h"
#include "interruption.h"
#include "output_files.h"
#include "report_json.h"
#include "simplify_input.h"
#include "simplify_summary.h"
#include "standard_streams.h"
#include "subcommands.h"
#include "text.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/Missed_target.h>
#include <selvedge/Reduction_log.h>
#include <selvedge/collapse_log.h>
#include <selvedge/internal/Stopwatch.h>
#include <selvedge/key_poses.h>
#include <selvedge/merge.h>
#include <selvedge/mesh_files.h>
#include <selvedge/poses.h>
#include <selvedge/progressive.h>

#include <algorithm>
#include <atomic>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::app {
namespace {

/// Reduces one file to one output, or to one for each level of detail.
class Reduction
{
public:
  explicit Reduction(const Simplify_request& request) : m_request(request), m_bar(!request.is_quiet)
  {
    if (is_shape_kept(request))
      m_missed_target.emplace(request.options, request.border_turn.has_value());
  }

  Exit_code run()
  {
    const Cancellation_scope scope([this] { return is_interrupted() && !m_is_kept; });
    try {
      m_input = read_input(m_request, m_bar);
      m_report["input"] = std::move(m_input.report);
      m_seconds["read"] = m_input.seconds;
      if (m_request.is_error_everywhere)
        m_error_search.emplace(*m_request.options.max_error);
      const Triangle_soup& soup = m_input.prepared.soup;
      m_guarded_poses = key_poses(soup, poses_guarded_first(m_request, soup.poses.size()));
      std::vector<Level> levels = judged_levels();
      finish(levels);
      write(levels);
      report(levels);
      return m_outcome.exit_code();
    } catch (const Interrupted&) {
      m_bar.clear();
      if (m_files_written.empty())
        throw;
      m_bar.complain("interrupted; written before: " + files_written());
      return exit_interrupted;
    } catch (const std::exception& error) {
      if (m_files_written.empty())
        throw;
      throw Output_error(error.what() + std::string("; written before: ") + files_written());
    }
  }

private:
  // What a reduction has come to, and was judged.
  struct Attempt
  {
    std::vector<Level> levels;
    Outcome outcome;
    std::string log;
    std::vector<Soup_collapse> collapses;
  };

  // Reduces and judges until no other reduction is due. Where shape was to be kept in a second one, and that
  // is interrupted, the first one is what was reached.
  std::vector<Level> judged_levels()
  {
    std::vector<Level> levels;
    try {
      do {
        levels = reduce();
        if (m_first && m_is_kept)
          throw Interrupted("interrupted in the second reduction");
        judge(levels);
      } while (guard_more_poses(levels) || advance_error_search(levels) || keep_shape(levels));
    } catch (const Interrupted&) {
      if (!m_first)
        throw;
      m_is_kept = true;
      m_bar.complain("interrupted in a second reduction, to keep shape; the result of the first is verified "
                     "and written");
      levels = std::move(m_first->levels);
      m_outcome = m_first->outcome;
      m_outcome.is_interrupted = true;
      m_log.str(m_first->log);
      m_collapses = std::move(m_first->collapses);
    }
    m_first.reset();
    return levels;
  }

  // Adds the poses in which the judge found new pairs or pieces too near to those that are guarded. Returns
  // whether there are any, so that the reduction is to be done again.
  bool guard_more_poses(const std::vector<Level>& levels)
  {
    const std::size_t guarded = m_guarded_poses.size();
    if (m_outcome.is_interrupted || !m_request.options.check_intersections)
      return false;
    for (const Level& level : levels)
      add_refused_poses(m_guarded_poses, level.verification);
    if (m_guarded_poses.size() == guarded)
      return false;
    if (!m_request.is_quiet)
      m_bar.complain("the judge refuses the result in " + counted(m_guarded_poses.size() - guarded, "pose") +
                     " that " + (m_guarded_poses.size() - guarded == 1 ? "was" : "were") +
                     " not guarded: the reduction begins again, with " + with_commas(m_guarded_poses.size()) +
                     " of " + with_commas(levels.front().verification.poses.size()) + " guarded");
    return true;
  }

  // Where the error is to be kept everywhere, chooses that of the next reduction. Returns whether there is to
  // be one.
  bool advance_error_search(const std::vector<Level>& levels)
  {
    if (!m_error_search || !m_outcome.is_accepted || m_outcome.is_interrupted)
      return false;
    std::vector<Bounds_over_poses> largest;
    for (const Level& level : levels)
      largest.push_back(level.distances_anywhere->larger());
    return m_error_search->advance(largest, m_guarded_poses);
  }

  // Where the target was missed and the surface was flattened for it, has the next reduction end before.
  // Returns whether there is to be one.
  bool keep_shape(std::vector<Level>& levels)
  {
    if (!m_missed_target || !m_outcome.is_accepted)
      return false;
    std::vector<Missed_target::Judged> judged;
    for (const Level& level : levels)
      judged.push_back({level.result, level.verification.distances->original_to_result, m_input.prepared});
    if (!m_missed_target->advance(judged))
      return false;
    m_first = {std::move(levels), m_outcome, m_log.str(), std::move(m_collapses)};
    return true;
  }

  // Returns the options of the next reduction, without the functions that it calls for each collapse.
  Simplify_options next_options()
  {
    Simplify_options options = m_missed_target ? m_missed_target->options() : m_request.options;
    options.placement = placement_for(m_request, m_input.prepared.soup);
    if (m_error_search)
      options.max_error = m_error_search->max_error();
    if (m_guarded_poses.size() < m_input.prepared.soup.poses.size())
      options.guarded_poses = m_guarded_poses;
    options.is_progression_recorded = !m_request.progressive.empty();
    if (!is_gltf(output_format(m_request)))
      options.instances = Instances::apart;
    options.is_history_kept = !m_request.html.empty();
    options.are_values_fitted = false; // `finish` does it
    options.should_stop = [this](const Simplify_progress& progress) {
      m_bar.update(progress);
      m_is_kept = true;
      if (!is_interrupted())
        return false;
      if (!std::exchange(m_is_stop_told, true))
        m_bar.complain(
            "stopping: what was reached is judged and written next; interrupt again to end at once");
      return true;
    };
    return options;
  }

  std::vector<Level> reduce()
  {
    m_bar.begin("sewing and indexing");
    Simplify_options options = next_options();
    m_log.str({});
    m_collapses.clear();
    m_progression = {};
    std::optional<Reduction_log> log;
    if (!m_request.log.empty()) {
      Log_header header = m_input.log_header;
      header.poses.clear();
      for (const std::size_t pose : m_guarded_poses)
        header.poses.push_back(m_input.log_header.poses[pose]);
      log.emplace(m_log, header, *m_input.numbering, m_input.prepared, options);
    }
    if (log || !m_request.html.empty())
      options.on_collapse = [&](const Soup_collapse& collapse) {
        if (log)
          log->add_collapse(collapse);
        if (!m_request.html.empty())
          m_collapses.push_back(collapse);
      };
    std::vector<Simplified_soup> results;
    if (m_request.lods.empty())
      results.push_back(simplify_soup(m_input.prepared, options, m_request.intent));
    else
      results = simplify_lods(m_input.prepared, options, m_request.lods, m_request.intent);
    if (m_missed_target)
      m_missed_target->complete(results);
    const auto is_stopped = [](const Simplified_soup& result) { return result.report.is_stopped; };
    const auto is_untouched = [](const Simplified_soup& result) { return result.report.collapses == 0; };
    m_is_kept = std::any_of(results.begin(), results.end(), is_stopped);
    if (m_is_kept && std::all_of(results.begin(), results.end(), is_untouched))
      throw Interrupted("interrupted before the reduction began");
    if (log)
      log->finish(results.back());
    // When one run passes through all levels, the one of the fewest faces has all steps.
    for (Simplified_soup& result : results)
      if (result.progression.steps.size() >= m_progression.steps.size())
        m_progression = std::move(result.progression);
    std::vector<const Simplified_soup*> all;
    for (const Simplified_soup& result : results)
      all.push_back(&result);
    m_seconds.add(m_input.prepared, all);
    return levels_of(std::move(results));
  }

  std::vector<Level> levels_of(std::vector<Simplified_soup> results)
  {
    const std::vector<std::string> names = outputs(m_request);
    m_seconds_of_levels.resize(results.size(), 0);
    const bool is_one_file = are_levels_in_one_file(m_request);
    std::vector<Level> levels(results.size());
    for (std::size_t i = 0; i < results.size(); ++i) {
      Level& level = levels[i];
      level.output = names[is_one_file ? 0 : i];
      level.number = is_one_file ? i + 1 : 0;
      level.result = std::move(results[i]);
      level.guarded_poses = m_guarded_poses;
      level.error_search = m_error_search;
      level.seconds = m_seconds_of_levels[i] += level.result.report.seconds_reduce;
    }
    return levels;
  }

  Triangle_soup written(const Simplified_soup& result) const
  {
    return m_request.is_sewn ? merged_at_positions(result.soup) : result.soup;
  }

  void judge(std::vector<Level>& levels)
  {
    m_bar.begin(levels.size() == 1 ? "judging the result" : "judging the results",
                m_input.prepared.soup.poses.size());
    const internal::Stopwatch stopwatch;
    m_outcome = {};
    m_outcome.is_guarded = m_request.options.check_intersections;
    m_outcome.is_target_required = m_request.is_target_required;
    for (Level& level : levels) {
      level.verification = verify(level.result, m_input.prepared);
      if (has_own_error(m_request))
        level.distances_anywhere = distances_anywhere(level.result.soup, m_input.prepared.soup);
      m_outcome.is_accepted &= level.verification.accepted() && level.verification.same_topology();
      m_outcome.is_interrupted |= level.result.report.is_stopped;
      m_outcome.is_reached &= level.result.report.is_reached();
    }
    m_seconds["verify"] += stopwatch.seconds();
  }

  // Does what the results that are kept need, and the judge does not look at.
  void finish(std::vector<Level>& levels)
  {
    m_bar.begin("fitting attributes");
    const internal::Stopwatch stopwatch;
    for (Level& level : levels)
      fit_values(level.result, m_input.prepared, m_request.intent);
    m_seconds["fit"] += stopwatch.seconds();
    if (m_input.polygons > 0) // otherwise the soup need not be merged and copied for it
      for (Level& level : levels)
        level.polygons = {m_input.polygons,
                          written_polygons(written(level.result), output_format(m_request))};
  }

  // Has a mesh refer to the same files from another output. So far it names those to which the first output
  // refers as that one does, and all others as the input.
  void relocate_to(const std::filesystem::path& path, Mesh_format format, Triangle_soup& soup) const
  {
    const bool is_of_same_kind =
        format == output_format(m_request) || (is_gltf(format) && is_gltf(output_format(m_request)));
    const bool is_as_in_output = is_of_same_kind && !is_standard_output(m_request.output);
    relocate(soup, format, is_as_in_output ? m_request.output : m_request.input, path);
  }

  // Writes the prepared input with the steps.
  void write_progression(const std::vector<Level>& levels)
  {
    if (m_request.progressive.empty())
      return;
    const std::filesystem::path path = m_request.progressive;
    Triangle_soup soup = m_input.prepared.soup;
    relocate_to(path, Mesh_format::glb, soup);
    Progressive_notes notes;
    notes.fixed_faces = levels.front().result.report.faces_fixed;
    notes.guarded_poses = m_guarded_poses;
    notes.are_poses_written = !m_request.poses.files.empty();
    for (const Level& level : levels)
      if (!m_request.lods.empty())
        notes.levels.push_back(level.result.soup.triangles.size());
    write_progressive(path, soup, m_progression, notes);
    m_files_written.push_back(m_request.progressive);
    std::vector<std::string> dropped = not_carried(soup, Mesh_format::glb);
    if (const std::string poses = poses_not_carried(soup, notes); !poses.empty())
      dropped.push_back(poses);
    m_report["progressive"] = {
        {"path", m_request.progressive},
        {"steps", m_progression.steps.size()},
        {"faces", m_input.prepared.soup.triangles.size()},
        {"least_faces", triangles_after(m_progression, m_progression.steps.size()).size()},
        {"not_carried", dropped}};
  }

  void write(std::vector<Level>& levels)
  {
    const internal::Stopwatch stopwatch;
    if (m_outcome.is_written()) {
      m_bar.begin("writing");
      const bool is_of_same_format =
          format_of(m_request.input, m_request.format) == output_format(m_request) &&
          is_gzip(m_request.input) == is_gzip(m_request.output);
      // The output may take the place of the input. It has all its bytes in one file.
      std::uintmax_t size_before = is_of_same_format ? size_of_file(m_request.input) : 0;
      if (size_before > 0 && output_format(m_request) == Mesh_format::gltf &&
          has_buffers_beside(m_request.input))
        size_before = 0;
      // Merging changes nothing but vertex numbers: the verdict on positions stands.
      if (are_levels_in_one_file(m_request)) {
        std::vector<Triangle_soup> soups;
        for (const Level& level : levels)
          soups.push_back(written(level.result));
        write_output(m_request.output, soups, output_format(m_request));
        m_files_written.push_back(m_request.output);
      }
      for (Level& level : levels) {
        if (level.number == 0) {
          level.notes =
              write_output(level.output, written(level.result), output_format(m_request), m_request.is_ascii);
          m_files_written.push_back(level.output);
          const std::uintmax_t size = size_of_file(output_path(level.output));
          if (size > size_before && size_before > 0)
            level.bytes_more = size - size_before;
        }
        write_poses(level.result.soup, std::size_t(&level - levels.data()) + 1);
      }
      write_progression(levels);
    }
    // The log is written even when the result was refused, because it shows why.
    if (!m_request.log.empty()) {
      write_file(output_path(m_request.log), m_log.str());
      m_files_written.push_back(m_request.log);
    }
    m_seconds["write"] = stopwatch.seconds();
    m_bar.clear();
    for (const Level& level : levels)
      if (const std::string what = complaint(m_request, level, m_outcome); !what.empty())
        m_bar.complain(what);
  }

  void write_poses(const Triangle_soup& soup, std::size_t level)
  {
    if (is_one_file_of_poses(m_request.poses_output)) {
      const std::string name = pose_output(m_request, level, "");
      write_output_of_poses(name, soup);
      m_files_written.push_back(name);
      return;
    }
    for (std::size_t i = 0; i < soup.poses.size() && !m_request.poses_output.empty(); ++i) {
      const std::string name = pose_output(m_request, level, soup.poses[i].name);
      Triangle_soup posed = in_pose(soup, i);
      relocate_to(name, mesh_format(name), posed);
      write_output(name, posed, mesh_format(name), m_request.is_ascii);
      m_files_written.push_back(name);
    }
  }

  void report(const std::vector<Level>& levels)
  {
    std::vector<std::string> dropped = not_carried(m_input.prepared.soup, output_format(m_request));
    if (format_of(m_request.input, m_request.format) == Mesh_format::stl) // which has none either
      dropped.erase(std::remove(dropped.begin(), dropped.end(), "vertex numbers"), dropped.end());
    if (!m_request.is_quiet) {
      std::ostream& stream = has_standard_output(m_request) ? std::cerr : std::cout;
      print_input(stream, m_request, m_input.prepared, levels.front().verification.distances->diagonal,
                  m_report["input"]["notes"], dropped, m_input.references);
      for (const Level& level : levels)
        print_summary(stream, m_request, m_input.prepared, level, m_outcome,
                      &level == &levels.front() ? nullptr : &level - 1);
      print_progression(stream);
    }
    if (m_request.report.empty() && m_request.html.empty())
      return;
    double seconds_parts = 0;
    const auto add_level = [&](Json& json, const Level& level) {
      json["output"] = {{"path", level.output},
                        {"written", m_outcome.is_written()},
                        {"level", level.number == 0 ? Json(nullptr) : Json(level.number)},
                        {"polygons", level.polygons.output},
                        {"larger", or_null(enlargement(m_request, level))},
                        {"not_carried", dropped},
                        {"references", m_input.references},
                        {"placement", name_of(placement_for(m_request, m_input.prepared.soup))},
                        {"normals", name_of(m_input.prepared.normals)}};
      if (&json == &m_report)
        json["options"] = options_json(m_request);
      add_reduction(json, m_input.prepared, level.result);
      add_verification(json, level.verification, true);
      add_distances(json, level.verification, level.distances_anywhere);
      add_error_search(json, level.error_search);
      add_guarded_poses(json, level.guarded_poses, level.result);
      const internal::Stopwatch stopwatch;
      add_parts(json, m_input.prepared, level.result);
      seconds_parts += stopwatch.seconds();
    };
    add_level(m_report, levels.back());
    for (const Level& level : levels)
      if (!m_request.lods.empty())
        add_level(m_report["lods"].emplace_back(Json::object()), level);
    m_seconds["parts"] = seconds_parts;
    if (!m_report.contains("progressive"))
      m_report["progressive"] = nullptr;
    m_report["seconds"] = m_seconds.json(
        {"read", "weld", "check", "snap", "index", "cells", "reduce", "verify", "fit", "write", "parts"});
    m_report["memory"] = {{"peak_bytes", peak_memory_bytes()}};
    m_report["exit_code"] = int(m_outcome.exit_code());
    if (!m_request.report.empty()) {
      write_file(output_path(m_request.report), to_text(m_report));
      m_files_written.push_back(m_request.report);
    }
    if (!m_request.html.empty())
      write_file(output_path(m_request.html), page(levels));
  }

  void print_progression(std::ostream& stream) const
  {
    const auto written = m_report.find("progressive");
    if (written == m_report.end())
      return;
    stream << "progressive: every level from " << counted(written->at("faces"), "face") << " to "
           << with_commas(written->at("least_faces")) << ", in "
           << counted(m_progression.steps.size(), "step");
    for (const Json& what : written->at("not_carried"))
      stream << "; without " << what.get<std::string>();
    stream << std::endl;
  }

  std::string page(const std::vector<Level>& levels) const
  {
    Html_report html(m_input.prepared.soup, m_input.prepared.obstacle);
    std::vector<std::string> still = m_request.intent.locked;
    still.insert(still.end(), m_request.intent.kept.begin(), m_request.intent.kept.end());
    html.add_input(m_input.prepared, still);
    std::vector<const Simplified_soup*> results;
    for (const Level& level : levels)
      results.push_back(&level.result);
    const std::vector<Collapses_of_level> collapses =
        collapses_of_levels(results, m_request.options, m_request.intent);
    std::size_t number = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      if (i == 0 || collapses[i].reduction != collapses[i - 1].reduction) {
        const auto first = m_collapses.begin() + std::ptrdiff_t(collapses[i].first);
        number = html.add_collapses({first, first + std::ptrdiff_t(collapses[i].of_reduction)});
      }
      html.add_level(name_of(levels[i]), levels[i].result, levels[i].verification, number,
                     collapses[i].count);
    }
    return html.page(m_report);
  }

  std::string files_written() const { return listed(m_files_written, m_files_written.size()); }

  const Simplify_request& m_request;
  Progress_bar m_bar;
  Simplify_input m_input;
  Outcome m_outcome;
  Json m_report = new_report("simplify");
  std::ostringstream m_log; // if it is written
  std::vector<std::size_t> m_guarded_poses;
  std::optional<Missed_target> m_missed_target; // where shape is kept
  std::optional<Attempt> m_first;               // where it is kept in a second one
  std::optional<Error_search> m_error_search;   // where the error is to be kept everywhere
  std::vector<Soup_collapse> m_collapses;       // if a page shows them
  Progression m_progression;                    // if it is written
  Phase_seconds m_seconds;
  std::vector<double> m_seconds_of_levels; // of all reductions so far
  bool m_is_stop_told = false;
  std::atomic<bool> m_is_kept = false; // a signal keeps what the reduction has reached
  std::vector<std::string> m_files_written;
};

} // namespace

Action add_simplify(CLI::App& command)
{
  const auto request = std::make_shared<Simplify_request>();
  add_options(command, *request);
  return [request] {
    complete(*request);
    const Thread_limit limit(request->threads);
    return Reduction(*request).run();
  };
}

} // namespace selvedge::app
