// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/replay.h>

#include "Judged_mesh.h"
#include "Motion_judge.h"
#include "Start.h"
#include "inputs.h"
#include "limits.h"
#include "link.h"
#include "snap.h"
#include "soup/number_positions.h"
#include "soup/regions.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/Sha256.h>
#include <selvedge/internal/Stopwatch.h>
#include <selvedge/internal/exact_predicates.h>

#include <algorithm>
#include <optional>
#include <utility>

// Repeats a log on the original and judges every step, exactly and apart from the reduction that wrote it.
// replay.h states what an accepted log guarantees.

namespace selvedge {

const char* name(Violation_kind kind)
{
  if (const Limit_description* limit = reference::limit_of(kind))
    return limit->key;
  switch (kind) {
  case Violation_kind::no_edge:
    return "no_edge";
  case Violation_kind::locked:
    return "locked";
  case Violation_kind::partner:
    return "partner";
  case Violation_kind::link:
    return "link";
  case Violation_kind::degenerate:
    return "degenerate";
  case Violation_kind::intersection:
    return "intersection";
  case Violation_kind::tunnelling:
    return "tunnelling";
  case Violation_kind::line:
    return "line";
  default:
    return "result";
  }
}

const char* name(Limits_source source)
{
  return source == Limits_source::none ? "none" : source == Limits_source::log ? "log" : "judge";
}

namespace reference {
namespace {

/// Takes the steps of a log one after the other and judges each before it changes the mesh.
class Replay
{
public:
  Replay(const Triangle_soup& original, bool is_stl, Log_reader& log, const Replay_options& options)
      : m_numbering(original, is_stl), m_log(log), m_options(options),
        m_start(start_of(original, options.obstacle.value_or(Triangle_soup()), log.header(), options.pose)),
        m_mesh(m_start), m_limits(judged_limits(log.header(), options)),
        m_motions(m_start, m_mesh, log.header().triangles, judged_limits(log.header(), options).clearance)
  {
    const Log_header& header = log.header();
    m_verdict.header = header;
    m_verdict.is_in_first_pose = !options.pose;
    m_verdict.is_obstacle_judged = options.obstacle.has_value();
    m_verdict.is_input_stated = !header.sha256.empty() && header.sha256 == options.sha256_of_original;
    m_verdict.offending_pairs = m_start.offending_pairs;
    m_verdict.limits = judged_limits(header, options);
    m_verdict.limits_source = !options.are_limits_judged ? Limits_source::none
                              : options.limits           ? Limits_source::judge
                                                         : Limits_source::log;
  }

  Replay_verdict run()
  {
    const internal::Stopwatch stopwatch;
    Log_step step;
    while (m_log.read(step)) {
      if (step.kind == Log_step::Kind::weld) {
        check_weld(step);
        continue;
      }
      if (step.kind == Log_step::Kind::turn) {
        turn(step);
        continue;
      }
      ++m_verdict.steps;
      take(step);
      if ((!m_verdict.violations.empty() && !m_options.is_all_wanted))
        break;
      m_verdict.is_stopped =
          m_options.should_stop && m_verdict.steps % 16 == 0 && m_options.should_stop(m_verdict.steps);
      if (m_verdict.is_stopped)
        break;
    }
    if (!m_verdict.is_stopped && (m_verdict.violations.empty() || m_options.is_all_wanted))
      judge_result();
    measure_snaps();
    m_verdict.soup = m_complex.result();
    m_verdict.seconds_steps = stopwatch.seconds();
    m_verdict.pairs_judged = m_mesh.statistics().pairs;
    m_verdict.pairs_judged_in_rationals = m_mesh.statistics().exact;
    return std::move(m_verdict);
  }

private:
  static Reduction_limits judged_limits(const Log_header& header, const Replay_options& options)
  {
    const Reduction_limits limits = options.limits.value_or(header.limits);
    if (options.are_limits_judged)
      return limits;
    Reduction_limits needed; // without the weld distance a snap could go anywhere
    needed.weld_distance = limits.weld_distance;
    return needed;
  }

  void check_weld(const Log_step& step) const
  {
    for (const Index number : step.group)
      if (position(number) != position(step.group.front()))
        throw Input_error("line " + std::to_string(step.line) + " of the log: vertices " +
                          std::to_string(step.group.front()) + " and " + std::to_string(number) +
                          " are welded there, but they are not at one position");
  }

  // Turning moves nothing: it says along which edges two faces are one surface.
  void turn(const Log_step& step)
  {
    for (const Index face : step.group) {
      if (face >= m_complex.size())
        throw Input_error("line " + std::to_string(step.line) + " of the log: triangle " +
                          std::to_string(face) + " is turned there, but only " +
                          std::to_string(m_complex.size()) + " triangles have corners at three positions");
      m_complex.turn(face);
    }
  }

  Index position(Index number) const { return m_complex.position(m_numbering.vertex(number)); }

  void take(const Log_step& step)
  {
    m_step = &step;
    m_is_bad = false;
    const bool is_snap = step.kind == Log_step::Kind::snap;
    if (!is_snap)
      begin_collapses();
    ++(is_snap ? m_verdict.snaps : m_verdict.collapses);
    Index removed = position(step.removed), kept = position(step.kept);
    if (!is_possible(is_snap, removed, kept))
      return;
    if (is_snap) {
      m_mesh.begin_snap(removed);
      judge_lock(removed);
      judge_lock(kept);
      judge_partners(removed, kept);
      judge({removed, m_complex.place(kept)});
      if (is_to_be_done())
        m_mesh.snap(removed, kept, m_is_bad);
      return;
    }
    const std::array<Coordinates, 2> before{m_complex.point(removed), m_complex.point(kept)};
    m_verdict.places += step.place.has_value();
    const std::optional<Coordinates> place = place_of(step, kept);
    std::vector<Index> changing;
    for (const Index end : {removed, kept})
      if (m_complex.point(end) != place.value_or(before[1]))
        changing.insert(changing.end(), m_complex.faces_at(end).begin(), m_complex.faces_at(end).end());
    m_mesh.begin_collapse(std::move(changing));
    if (!place) {
      judge_lock(removed, kept);
      judge_link(removed, kept);
      judge_with_clearance({removed, m_complex.place(kept)});
      judge_limits(removed, kept, m_complex.point(kept), true);
    } else {
      judge_lock(removed);
      judge_lock(kept);
      judge_link(removed, kept);
      judge_limits_before_motion(removed, kept, *place);
      // The first to move already stands at the place when the other comes.
      const bool is_at_removed = *place == m_complex.point(removed);
      const Index first = step.is_removed_first ? removed : kept,
                  second = step.is_removed_first ? kept : removed;
      if (is_at_removed) {
        judge_with_clearance({kept, m_complex.place(removed)});
      } else {
        judge_with_clearance({first, {no_position(), *place}});
        m_mesh.move(first, *place);
        judge_with_clearance({second, m_complex.place(first)});
      }
      m_mesh.move(kept, *place);
      report_pending_limit(removed);
    }
    const std::size_t pairs_before = m_mesh.offending_pairs();
    if (is_to_be_done())
      m_mesh.collapse(removed, kept, before, m_is_bad);
    // The pairs with an obstacle that is not given, which may have become fewer instead, are not known.
    if (!is_obstacle_missing() && m_mesh.offending_pairs() > pairs_before)
      report(Violation_kind::intersection,
             "more pairs of triangles intersect afterwards than before, though all descend from pairs of the "
             "original",
             m_complex.faces_at(kept));
  }

  bool is_to_be_done() const { return !m_is_bad || m_options.is_all_wanted; }

  bool is_obstacle_missing() const { return m_verdict.header.obstacle && !m_options.obstacle; }

  static constexpr Index no_position() { return Index(-1); }

  /// Returns the place that a step names; none when `kept` is there already, so that only `removed` moves.
  std::optional<Coordinates> place_of(const Log_step& step, Index kept) const
  {
    if (!step.place || *step.place == m_complex.point(kept))
      return std::nullopt;
    return step.place;
  }

  /// Measures the snaps, finds the seams and sets the size of the mesh, which all depend on the last snap.
  /// Called before every collapse; only the first call does anything.
  void begin_collapses()
  {
    if (m_complex.has_seams())
      return;
    measure_snaps();
    Box box;
    for (Index f = 0; f < m_complex.size(); ++f)
      box.add(m_mesh.box(f));
    m_limits.set_size(box.low, box.high);
    if (m_options.pose) {
      Box of_first;
      for (const Index_triple& triangle : m_start.soup.triangles)
        for (const Index v : triangle) {
          const Point_3& point = m_start.points_of_first_pose[v];
          of_first.add(Coordinates{point.x(), point.y(), point.z()});
        }
      m_limits.set_diagonal(of_first.low, of_first.high);
    }
    m_mesh.set_doubles_aside();
    m_complex.find_seams(attributes_of_regions(m_start.soup, positions_in_first_pose()));
    m_motions.find_pieces();
  }

  // By vertex, after all snaps.
  std::vector<Index> positions_in_first_pose() const
  {
    if (m_options.pose)
      return number_positions(m_start.points_of_first_pose);
    std::vector<Index> result(m_start.soup.points.size());
    for (Index v = 0; v < result.size(); ++v)
      result[v] = m_complex.position(v);
    return result;
  }

  // ---- Locks, snaps and links

  // Counts the first objection to a step alone.
  void report(const std::optional<Objection>& objection)
  {
    if (!objection || std::exchange(m_is_bad, true))
      return;
    Violation violation;
    violation.kind = objection->kind;
    violation.step = m_verdict.steps;
    violation.line = m_step->line;
    violation.removed = m_step->removed;
    violation.kept = m_step->kept;
    for (const Index f : objection->faces)
      violation.triangles.push_back(m_start.numbers[f]);
    violation.message = objection->message;
    violation.point = objection->point;
    violation.scene = objection->scene;
    m_verdict.violations.push_back(std::move(violation));
  }
  void report(Violation_kind kind, const std::string& message, const std::vector<Index>& faces = {})
  {
    report(Objection{kind, message, faces});
  }

  bool is_possible(bool is_snap, Index removed, Index kept)
  {
    if (m_complex.faces_at(removed).empty() || m_complex.faces_at(kept).empty()) {
      const Index gone = m_complex.faces_at(removed).empty() ? m_step->removed : m_step->kept;
      report(Violation_kind::no_edge,
             "vertex " + std::to_string(gone) + " no longer belongs to any triangle");
      return false;
    }
    if (removed == kept) {
      report(Violation_kind::no_edge, "both vertices are at one position");
      return false;
    }
    const auto& faces = m_complex.faces_at(removed);
    const bool is_edge =
        std::any_of(faces.begin(), faces.end(), [&](Index f) { return m_complex.has(f, kept); });
    if (is_edge == is_snap) {
      report(Violation_kind::no_edge,
             is_snap ? "an edge joins the two vertices" : "no edge joins the two vertices");
      return false;
    }
    return true;
  }

  // `goal` is where the position goes along a line, if it may hold several sheets together that all go there.
  void judge_lock(Index position, std::optional<Index> goal = {})
  {
    if (m_start.is_locked[position])
      report(
          Violation_kind::locked,
          m_step->kind == Log_step::Kind::snap
              ? "one of the two vertices belongs to an offending triangle of the original, or is at a "
                "vertex of the obstacle"
              : "the vertex that moves belongs to an offending triangle of the original, or is at a vertex "
                "of the obstacle",
          m_complex.faces_at(position));
    else if (m_step->kind == Log_step::Kind::collapse && !m_complex.is_one_fan(position) &&
             !(goal && m_complex.is_inside_line(position, *goal)))
      report(Violation_kind::locked, "the vertex that moves holds several sheets together",
             m_complex.faces_at(position));
  }

  void judge_partners(Index moved, Index kept)
  {
    if (const auto objection = judge_snap(m_complex, moved, kept, m_verdict.limits.weld_distance))
      report(objection->kind, objection->message, m_complex.faces_at(moved));
    m_verdict.largest_snap =
        std::max(m_verdict.largest_snap, distance(m_complex.point(moved), m_complex.point(kept)));
  }

  // Measures how far the snaps took the vertices. Called before the first collapse, since collapses move
  // vertices too.
  void measure_snaps()
  {
    if (m_verdict.snaps == 0 || std::exchange(m_are_snaps_measured, true))
      return;
    const std::vector<Point_3>& points = m_start.soup.points;
    for (Index v = 0; v < points.size(); ++v)
      m_verdict.largest_way_of_snaps =
          std::max(m_verdict.largest_way_of_snaps, distance({points[v].x(), points[v].y(), points[v].z()},
                                                            m_complex.point(m_complex.position(v))));
  }

  void judge_link(Index removed, Index kept)
  {
    if (const char* const objection = link_objection(m_complex, removed, kept))
      report(Violation_kind::link, objection);
  }

  // ---- Motions

  void judge(const Motion& motion)
  {
    if (!m_is_bad)
      report(m_motions.meeting(motion));
  }
  void judge_with_clearance(const Motion& motion)
  {
    judge(motion);
    if (!m_is_bad)
      report(m_motions.lack_of_clearance(motion));
  }

  // ---- Limits

  void judge_limits(Index removed, Index kept, const Coordinates& place, bool is_kept_still)
  {
    if (m_is_bad)
      return;
    if (const auto kind = m_limits.judge(m_complex, removed, kept, place, is_kept_still))
      report(*kind, m_limits.message(*kind), m_complex.faces_at(removed));
  }

  // A step of two motions is compared with what was before the first, and reported after both.
  void judge_limits_before_motion(Index removed, Index kept, const Coordinates& place)
  {
    m_pending_limit.reset();
    if (!m_is_bad)
      m_pending_limit = m_limits.judge(m_complex, removed, kept, place, false);
  }
  void report_pending_limit(Index removed)
  {
    if (m_pending_limit)
      report(*m_pending_limit, m_limits.message(*m_pending_limit), m_complex.faces_at(removed));
  }

  // ---- The result

  void judge_result()
  {
    const Log_result& stated = m_log.result();
    const bool has_digest = !stated.sha256.empty() && !m_options.pose; // whose positions are others
    m_verdict.is_result_stated = has_digest && stated.sha256 == digest();
    m_verdict.is_result_another = has_digest && !m_verdict.is_result_stated;
    std::string message;
    if (stated.collapses != m_verdict.collapses)
      message = "the log has " + std::to_string(m_verdict.collapses) + " collapses, and says " +
                std::to_string(stated.collapses);
    else if (stated.triangles != m_complex.face_count())
      message = std::to_string(m_complex.face_count()) + " triangles are left, and the log says " +
                std::to_string(stated.triangles);
    else if (m_verdict.is_result_another)
      message = "the triangles left are not those that the log's digest stands for";
    if (message.empty())
      return;
    Violation violation;
    violation.message = message;
    m_verdict.violations.push_back(std::move(violation));
  }

  std::string digest() const
  {
    std::vector<Index> smallest(m_start.soup.points.size(), Index(-1)); // by position
    Cancellation_poll poll;
    for (Index number = 0; number < m_numbering.size(); ++number) {
      poll();
      Index& first = smallest[position(number)];
      first = std::min(first, number);
    }
    Sha256 sha256;
    for (Index f = 0; f < m_complex.size(); ++f) {
      poll();
      if (!m_complex.is_left(f))
        continue;
      const Index_triple p = m_complex.positions_left(f);
      sha256.add(std::to_string(smallest[p[0]]) + ' ' + std::to_string(smallest[p[1]]) + ' ' +
                 std::to_string(smallest[p[2]]) + '\n');
    }
    return sha256.digest();
  }

  const Log_numbering m_numbering;
  Log_reader& m_log;
  const Replay_options& m_options;
  Start m_start;
  Judged_mesh m_mesh;
  Complex& m_complex = m_mesh.complex();
  Limits m_limits;
  Motion_judge m_motions;
  Replay_verdict m_verdict;

  const Log_step* m_step = nullptr; // the present step, and what is known of it
  bool m_is_bad = false;
  bool m_are_snaps_measured = false;
  std::optional<Violation_kind> m_pending_limit;
};

} // namespace
} // namespace reference

Replay_verdict replay(const Triangle_soup& original, bool is_stl, Log_reader& log,
                      const Replay_options& options)
{
  internal::require_default_arithmetic();
  const bool is_obstacle_stated = reference::check_inputs(original, is_stl, log.header(), options);
  const internal::Stopwatch stopwatch;
  reference::Replay run(original, is_stl, log, options);
  const double seconds_prepare = stopwatch.seconds();
  Replay_verdict verdict = run.run();
  verdict.is_obstacle_stated = is_obstacle_stated;
  verdict.seconds_prepare = seconds_prepare;
  return verdict;
}

} // namespace selvedge
