// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/replay.h>

#include "Box_tree.h"
#include "Complex.h"
#include "Start.h"
#include "clearance.h"
#include "contact.h"
#include "inputs.h"
#include "limits.h"
#include "link.h"
#include "snap.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/Sha256.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
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

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A motion of the vertices at a position: to another position, with which they merge, or to a place that is
/// no position.
struct Motion
{
  Index mover;
  Place target;
};

/// Takes the steps of a log one after the other and judges each before it changes the mesh.
class Replay
{
public:
  Replay(const Triangle_soup& original, bool is_stl, Log_reader& log, const Replay_options& options)
      : m_numbering(original, is_stl), m_log(log), m_options(options),
        m_start(start_of(original, options.obstacle.value_or(Triangle_soup()), log.header(), options.pose)),
        m_complex(m_start.soup, std::move(m_start.obstacle)), m_limits(judged_limits(log.header(), options))
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
    m_boxes.resize(m_complex.size_with_obstacle());
    Cancellation_poll poll;
    for (Index f = 0; f < m_boxes.size(); ++f) {
      poll();
      m_boxes[f] = box_of(m_complex.triangle(f));
    }
    build_tree();
  }

  Replay_verdict run()
  {
    const Clock::time_point start = Clock::now();
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
    m_verdict.seconds_steps = seconds_since(start);
    m_verdict.pairs_judged = m_statistics.pairs;
    m_verdict.pairs_judged_in_rationals = m_statistics.exact;
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

  static Box box_of(const std::array<Place, 3>& triangle)
  {
    Box box;
    for (const Place& corner : triangle)
      box.add(corner.at);
    return box;
  }

  void build_tree()
  {
    std::vector<Index> faces;
    for (Index f = 0; f < m_complex.size(); ++f)
      if (m_complex.face(f).is_alive)
        faces.push_back(f);
    m_faces_in_tree = faces.size();
    for (Index f = Index(m_complex.size()); f < m_complex.size_with_obstacle(); ++f)
      faces.push_back(f);
    m_tree.build(faces, m_boxes);
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
    m_changing.clear();
    m_heritage.clear();
    if (is_snap) {
      m_changing = m_complex.faces_at(removed);
      judge_lock(removed);
      judge_lock(kept);
      judge_partners(removed, kept);
      judge({removed, m_complex.place(kept)});
      apply(removed, kept, true, {});
      return;
    }
    const std::array<Coordinates, 2> before{m_complex.point(removed), m_complex.point(kept)};
    const std::optional<Coordinates> place = place_of(step, kept);
    for (const Index end : {removed, kept})
      if (m_complex.point(end) != place.value_or(before[1]))
        m_changing.insert(m_changing.end(), m_complex.faces_at(end).begin(), m_complex.faces_at(end).end());
    m_heritage = m_start.lineage.united(m_changing);
    m_rivals = m_start.lineage.rivals(m_heritage);
    if (!place) {
      judge_lock(removed, kept);
      judge_link(removed, kept);
      judge({removed, m_complex.place(kept)});
      judge_clearance({removed, m_complex.place(kept)});
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
        judge({kept, m_complex.place(removed)});
        judge_clearance({kept, m_complex.place(removed)});
      } else {
        judge({first, {no_position(), *place}});
        judge_clearance({first, {no_position(), *place}});
        shift(first, *place);
        judge({second, m_complex.place(first)});
        judge_clearance({second, m_complex.place(first)});
      }
      shift(kept, *place);
      report_pending_limit(removed);
    }
    const std::size_t pairs_before = m_offences.count();
    apply(removed, kept, false, before);
    // The pairs with an obstacle that is not given, which may have become fewer instead, are not known.
    if (!is_obstacle_missing() && m_offences.count() > pairs_before)
      report(Violation_kind::intersection,
             "more pairs of triangles intersect afterwards than before, though all descend from pairs of the "
             "original",
             m_complex.faces_at(kept));
  }

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
      box.add(m_boxes[f]);
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
    m_complex.set_aside(m_start.fronts);
    for (Index f = 0; f < m_complex.size(); ++f)
      if (!m_complex.face(f).is_alive) {
        m_offences.remove(f);
        m_boxes[f] = Box();
      }
    build_tree();
    m_complex.find_seams();
    if (m_verdict.limits.clearance)
      m_pieces = pieces_of(m_complex);
  }

  // ---- Locks, snaps and links

  void report(Violation_kind kind, const std::string& message, const std::vector<Index>& faces = {},
              const std::string& point = {}, const std::string& scene = {})
  {
    if (m_is_bad)
      return;
    m_is_bad = true;
    Violation violation;
    violation.kind = kind;
    violation.step = m_verdict.steps;
    violation.line = m_step->line;
    violation.removed = m_step->removed;
    violation.kept = m_step->kept;
    for (const Index f : faces)
      violation.triangles.push_back(m_start.numbers[f]);
    violation.message = message;
    violation.point = point;
    violation.scene = scene;
    m_verdict.violations.push_back(std::move(violation));
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

  // ---- Contacts

  // Whether a pair of a moving face and another need not be apart after this step: it offends already, which
  // is no fault of this step, or it descends from an offending pair of the original, or the parts of the two
  // may intersect.
  bool is_exempt(Index moving, Index other) const
  {
    if (m_start.is_permitted(moving, other) || m_offences.has(moving, other))
      return true;
    if (m_heritage.empty())
      return false;
    return std::find(m_changing.begin(), m_changing.end(), other) != m_changing.end()
               ? Lineage::have_common(m_heritage, m_rivals)
               : m_start.lineage.descends_from_one(other, m_rivals);
  }

  void judge(const Motion& motion)
  {
    if (m_is_bad)
      return;
    const Place m = m_complex.place(motion.mover);
    struct Moving
    {
      Index face;
      Sweep sweep;
      Box box;
      std::array<Place, 3> after;
    };
    std::vector<Moving> moving;
    std::vector<std::pair<Index, Standing>> sides; // of all faces at m, the sides opposite it
    Box box;
    box.add(m.at);
    box.add(motion.target.at);
    for (const Index f : m_complex.faces_at(motion.mover)) {
      const auto [p, q] = m_complex.opposite_side(f, motion.mover);
      const Place a = m_complex.place(p), b = m_complex.place(q);
      const bool is_contracted = p == motion.target.id || q == motion.target.id;
      if (is_contracted && is_degenerate({m, a, b})) {
        // It stays within the segment that it is, and meets no more than before, unless it turns over.
        if (is_between(m, p == motion.target.id ? b : a, motion.target))
          return report(Violation_kind::degenerate,
                        "a triangle without an area turns over: its corner passes over another", {f});
        continue;
      }
      sides.push_back({f, {{a, b, b}, 2}});
      if (is_contracted)
        continue;
      Box around = box;
      around.low = m.at;
      around.high = m.at;
      around.add(motion.target.at);
      around.add(a.at);
      around.add(b.at);
      moving.push_back({f, Sweep(m, motion.target, a, b, m_statistics), around, {motion.target, a, b}});
    }
    for (const Moving& face : moving)
      box.add(face.box);
    for (const Moving& face : moving)
      if (face.sweep.degenerates())
        return report(Violation_kind::degenerate, "a triangle has no area at some time on the way",
                      {face.face}, {}, scene(m, motion.target, face.after, nullptr));

    m_standing.clear();
    m_tree.visit(box, [&](Index f) {
      if (!m_complex.has(f, motion.mover))
        m_standing.push_back(f);
    });
    // The end comes before the way, since what is wrong there is easier to see.
    for (const Moving& face : moving) {
      Cancellation_scope::check();
      const Box end = box_of(face.after);
      for (const Index f : m_standing)
        if (end.overlaps(m_boxes[f]) && !is_exempt(face.face, f) &&
            do_meet(face.after, m_complex.triangle(f), m_statistics))
          return report_meeting(Violation_kind::intersection, motion, face.face, face.after, f,
                                m_complex.triangle(f), meeting_point(face.after, m_complex.triangle(f)));
      for (const Moving& other : moving)
        if (other.face < face.face && !is_exempt(face.face, other.face) &&
            do_meet(face.after, other.after, m_statistics))
          return report_meeting(Violation_kind::intersection, motion, face.face, face.after, other.face,
                                other.after, meeting_point(face.after, other.after));
    }
    for (const Moving& face : moving) {
      Cancellation_scope::check();
      for (const Index f : m_standing) {
        if (!face.box.overlaps(m_boxes[f]) || is_exempt(face.face, f))
          continue;
        const Standing standing{m_complex.triangle(f), 3};
        if (face.sweep.touches(standing))
          return report_meeting(Violation_kind::tunnelling, motion, face.face, face.after, f,
                                standing.corners, face.sweep.contact(standing));
      }
      for (const auto& [f, side] : sides)
        if (f != face.face && !is_exempt(face.face, f) && face.sweep.touches(side))
          return report_meeting(Violation_kind::tunnelling, motion, face.face, face.after, f,
                                m_complex.triangle(f), face.sweep.contact(side));
    }
  }

  // Whether the motion, which meets nothing, keeps the clearance from other pieces.
  void judge_clearance(const Motion& motion)
  {
    const std::optional<double>& limit = m_verdict.limits.clearance;
    if (m_is_bad || !limit)
      return;
    const Coordinates from = m_complex.point(motion.mover), to = motion.target.at;
    Clearance_question question{*limit, {}, {}};
    Box box;
    box.add(from);
    box.add(to);
    for (const Index f : m_complex.faces_at(motion.mover)) {
      const auto [p, q] = m_complex.opposite_side(f, motion.mover);
      const Coordinates a = m_complex.point(p), b = m_complex.point(q);
      question.star.push_back({from, a, b});
      box.add(a);
      box.add(b);
      if (p == motion.target.id || q == motion.target.id)
        continue;
      question.facets.push_back({to, a, b});
      question.facets.push_back({from, to, a});
      question.facets.push_back({from, to, b});
    }
    std::sort(question.facets.begin(), question.facets.end());
    question.facets.erase(std::unique(question.facets.begin(), question.facets.end()), question.facets.end());
    for (int axis = 0; axis < 3; ++axis) {
      // A sum rounds by half of the last digit, and so by less than a step to the next number.
      box.low[axis] = std::nextafter(box.low[axis] - *limit, -HUGE_VAL);
      box.high[axis] = std::nextafter(box.high[axis] + *limit, HUGE_VAL);
    }
    const Index moving = m_complex.faces_at(motion.mover).front();
    m_standing.clear();
    m_tree.visit(box, [&](Index f) {
      if (m_complex.is_of_obstacle(f) || m_pieces[m_complex.face(f).positions[0]] != m_pieces[motion.mover])
        m_standing.push_back(f);
    });
    for (const Index f : m_standing) {
      Cancellation_scope::check();
      const std::array<Place, 3> standing = m_complex.triangle(f);
      if (!is_exempt(moving, f) &&
          !is_clearance_kept(question, {standing[0].at, standing[1].at, standing[2].at}))
        return report(Violation_kind::clearance, m_limits.message(Violation_kind::clearance), {moving, f});
    }
  }

  void report_meeting(Violation_kind kind, const Motion& motion, Index f, const std::array<Place, 3>& after,
                      Index g, const std::array<Place, 3>& other, const std::optional<std::string>& point)
  {
    const auto name = [&](Index face) {
      const std::size_t number = m_start.numbers[face] + 1;
      return m_complex.is_of_obstacle(face)
                 ? std::to_string(number - m_verdict.header.triangles) + " of the obstacle"
                 : std::to_string(number);
    };
    const std::string both = "triangles " + name(f) + " and " + name(g);
    report(kind,
           both + (kind == Violation_kind::intersection ? " intersect afterwards"
                                                        : " are apart afterwards, but meet on the way"),
           {f, g}, point.value_or(""), scene(m_complex.place(motion.mover), motion.target, after, &other));
  }

  static std::string scene(const Place& m, const Place& t, const std::array<Place, 3>& after,
                           const std::array<Place, 3>* other)
  {
    std::string text =
        "# The moving triangle before and after, the triangle that it meets, and the way of the vertex.\n";
    std::size_t vertices = 0;
    const auto add = [&](const char* object, const char* element, const std::vector<Place>& places) {
      text += std::string("o ") + object + '\n';
      std::string numbers;
      for (const Place& place : places) {
        text += 'v';
        for (const double coordinate : place.at) {
          char digits[32];
          text += ' ' + std::string(digits, std::to_chars(digits, digits + sizeof digits, coordinate).ptr);
        }
        text += '\n';
        numbers += ' ' + std::to_string(++vertices);
      }
      text += element + numbers + '\n';
    };
    add("before", "f", {m, after[1], after[2]});
    add("after", "f", {after[0], after[1], after[2]});
    if (other)
      add("other", "f", {(*other)[0], (*other)[1], (*other)[2]});
    add("way", "l", {m, t});
    return text;
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

  // ---- Changes of the mesh

  void shift(Index position, const Coordinates& place)
  {
    m_complex.move(position, place);
    refit(m_complex.faces_at(position));
  }

  void refit(const std::vector<Index>& faces)
  {
    for (const Index f : faces) {
      m_boxes[f] = box_of(m_complex.triangle(f));
      m_tree.set(f, m_boxes[f]);
    }
  }

  // `before` are the points of both before the collapse.
  void apply(Index removed, Index kept, bool is_snap, const std::array<Coordinates, 2>& before)
  {
    if (m_is_bad && !m_options.is_all_wanted)
      return;
    if (is_snap) {
      m_complex.snap(removed, kept);
    } else {
      for (const Index f : m_complex.collapse(removed, kept, before)) {
        m_offences.remove(f);
        m_start.lineage.remove(f);
        m_boxes[f] = Box();
        m_tree.set(f, Box());
      }
    }
    refit(m_complex.faces_at(kept));
    // Faces with both ends were listed twice where both have moved.
    std::sort(m_changing.begin(), m_changing.end());
    m_changing.erase(std::unique(m_changing.begin(), m_changing.end()), m_changing.end());
    m_changing.erase(std::remove_if(m_changing.begin(), m_changing.end(),
                                    [&](Index f) { return !m_complex.face(f).is_alive; }),
                     m_changing.end());
    if (!m_heritage.empty())
      m_start.lineage.set(m_changing, m_heritage);
    if (m_is_bad || !m_heritage.empty() ||
        std::any_of(m_changing.begin(), m_changing.end(), [&](Index f) { return m_offences.has(f); }))
      find_offences(m_changing);
    if (2 * m_complex.face_count() < m_faces_in_tree)
      build_tree();
  }

  void find_offences(const std::vector<Index>& faces)
  {
    for (const Index f : faces)
      m_offences.remove(f);
    for (const Index f : faces) {
      if (is_degenerate(m_complex.triangle(f)))
        m_offences.add(f, f);
      m_tree.visit(m_boxes[f], [&](Index g) {
        if (g != f && !m_start.is_permitted(f, g) &&
            do_meet(m_complex.triangle(f), m_complex.triangle(g), m_statistics))
          m_offences.add(f, g);
      });
    }
  }

  // ---- The result

  void judge_result()
  {
    const Log_result& stated = m_log.result();
    const bool has_digest = !stated.sha256.empty() && !m_options.pose; // whose positions are others
    m_verdict.is_result_stated = has_digest && stated.sha256 == digest();
    std::string message;
    if (stated.collapses != m_verdict.collapses)
      message = "the log has " + std::to_string(m_verdict.collapses) + " collapses, and says " +
                std::to_string(stated.collapses);
    else if (stated.triangles != m_complex.face_count())
      message = std::to_string(m_complex.face_count()) + " triangles are left, and the log says " +
                std::to_string(stated.triangles);
    else if (has_digest && !m_verdict.is_result_stated)
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
  Offences& m_offences = m_start.offences;
  Complex m_complex;
  Limits m_limits;
  std::vector<Box> m_boxes; // by face
  Box_tree m_tree;
  std::size_t m_faces_in_tree = 0;
  Contact_statistics m_statistics;
  Replay_verdict m_verdict;

  const Log_step* m_step = nullptr; // the present step, and what is known of it
  bool m_is_bad = false;
  bool m_are_snaps_measured = false;
  std::optional<Violation_kind> m_pending_limit;
  std::vector<Index> m_standing;
  std::vector<Index> m_pieces; // by position, if a clearance is to be kept

  // Of a step: the faces that it changes or removes, their ancestors, and what offended with these.
  std::vector<Index> m_changing;
  Lineage::Faces m_heritage, m_rivals;
};

} // namespace
} // namespace reference

Replay_verdict replay(const Triangle_soup& original, bool is_stl, Log_reader& log,
                      const Replay_options& options)
{
  const bool is_obstacle_stated = reference::check_inputs(original, is_stl, log.header(), options);
  const auto start = reference::Clock::now();
  reference::Replay run(original, is_stl, log, options);
  const double seconds_prepare = reference::seconds_since(start);
  Replay_verdict verdict = run.run();
  verdict.is_obstacle_stated = is_obstacle_stated;
  verdict.seconds_prepare = seconds_prepare;
  return verdict;
}

} // namespace selvedge
