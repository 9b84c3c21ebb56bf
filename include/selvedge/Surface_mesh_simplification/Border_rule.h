// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_BORDER_RULE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_BORDER_RULE_H

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>

#include <CGAL/Dynamic_property_map.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_type_basic.h>
#include <CGAL/squared_distance_3.h>

#include <boost/unordered_map.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace selvedge {

/// Limits on the change of *lines*: of borders, and of the inner edges that are marked as lines.
struct Border_rule_options
{
  /// The largest angle, in degrees from 0 to 180, by which a border may turn at a vertex that leaves it.
  double max_border_turn = 8;

  /// The largest angle by which a line of marked edges may turn, likewise. It can be larger: there is surface
  /// on both sides, and no outline to fray.
  double max_seam_turn = 60;

  /// The largest height, in units of the mesh and at least 0, of a *low corner*: a border may turn by any
  /// angle where no original vertex of it is farther than this from the segment that replaces it. 0 lets no
  /// corner pass for low.
  double max_corner_height = 0;

  /// The largest distance, in units of the mesh and at least 0, from an original vertex of a line to the
  /// segment that replaced it. Infinity sets no limit.
  double max_drift = std::numeric_limits<double>::infinity();
};

/// Why a `Border_rule` does not let a vertex move along an edge.
enum class Line_refusal : unsigned char {
  none,     ///< the vertex may move
  locked,   ///< the vertex is locked
  off_line, ///< the vertex is on a line, and the edge is not
  line_end, ///< the vertex ends a line or joins several, or a face beside the edge has line edges only, or
            ///< the vertex would come along a spoke, or leave a pole with one line alone
  turn,     ///< the line turns too much at the vertex
  drift     ///< the line would come too far from an original vertex of it
};

/// Knows the *lines* of a mesh, which are its borders and the inner edges marked as lines (seams), and
/// decides which motions of vertices respect them.
///
/// `Border_filter` and `Halfedge_placement` ask the rule; `Border_visitor` updates it after every collapse.
/// Copies share one state.
///
/// A *spoke* is an inner edge that is a line at one end only, its pole. So is the last edge of a cut into a
/// texture, and so are the edges at the pole of a sphere, where each face has a texture coordinate of its own
/// at the pole and shares those on the ring. The pole is on them; the vertices at their other ends are not,
/// and may move around it.
///
/// **Guarantees** for a mesh reduced by collapses that `allows` accepts:
/// 1. A locked vertex stays where it is.
/// 2. A vertex on a line moves only along the line, to the next vertex of the same line, and only where the
///    line turns by at most `max_border_turn` or `max_seam_turn`, or where the corner of a border is low
///    (`max_corner_height`). Ends of edges that are lines at both ends, vertices with more than two line
///    edges, and vertices where a border becomes a marked line never move.
/// 3. No collapse removes a face whose three edges are all lines, or two of them lines and the third a spoke.
///    One may remove a face between two spokes, if a third line ends at the same pole. No vertex moves along
///    a spoke to its pole.
/// 4. Every original vertex of a line lies within `max_drift`, or within its own limit of drift, of the
///    segment that replaced it.
///
/// **Preconditions** The mesh outlives the rule. Edges are marked and vertices are locked before the first
/// collapse.
///
/// **Exactness** Which vertex may move along which edge is decided combinatorially. Angles and drift are
/// compared in floating point: they limit quality, and no statement about intersections depends on them.
///
/// **Reference** Derichs, Misiak, Fuhrmann, section 3.1 and figure 2 (with a limit of 8° at borders).
template <class TriangleMesh,
          class VertexPointMap = typename boost::property_map<TriangleMesh, CGAL::vertex_point_t>::const_type>
class Border_rule
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Point = typename boost::property_traits<VertexPointMap>::value_type;
  using Geom_traits = typename CGAL::Kernel_traits<Point>::Kernel;
  using Vector = typename Geom_traits::Vector_3;

public:
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Edge = typename Graph_traits::edge_descriptor;

  /// Throws `Argument_error` when an option is out of its range.
  explicit Border_rule(const TriangleMesh& mesh, const Border_rule_options& options = {})
      : Border_rule(mesh, get(CGAL::vertex_point, mesh), options)
  {
  }

  Border_rule(const TriangleMesh& mesh, const VertexPointMap& points, const Border_rule_options& options = {})
      : m_state(std::make_shared<State>(mesh, points, options))
  {
  }

  /// Marks an inner edge as a line.
  void mark(Edge e)
  {
    const Halfedge h = halfedge(e, m_state->mesh);
    for (const Halfedge end : {h, opposite(h, m_state->mesh)}) {
      put(m_state->marks, end, true);
      m_state->raise(target(end, m_state->mesh), Freedom::along_line);
    }
  }

  /// Marks an inner edge as a line at the target of `h`: as a spoke, unless it is marked at the other end.
  void mark_at_target(Halfedge h)
  {
    put(m_state->marks, h, true);
    m_state->raise(target(h, m_state->mesh), Freedom::along_line);
    m_state->may_have_spokes = true;
  }

  /// Locks a vertex, so that it never moves. Other vertices may move onto it.
  void lock(Vertex v) { m_state->raise(v, Freedom::none); }

  /// Sets the largest drift for a vertex of a line, in place of `Border_rule_options::max_drift`. The vertex
  /// of a place between two has the lesser of their limits.
  void limit_drift(Vertex v, double max_drift) { m_state->squared_drift_of[v] = max_drift * max_drift; }

  bool is_locked(Vertex v) const { return get(m_state->freedoms, v) == Freedom::none; }

  /// Returns whether a vertex may go anywhere: it is not locked and on no line.
  bool is_free(Vertex v) const { return get(m_state->freedoms, v) == Freedom::free; }

  /// Says that the lines at a vertex, which is on one, do not bound strips.
  void bound_no_strip(Vertex v) { m_state->raise(v, Freedom::along_other_line); }

  /// Returns whether a vertex is on lines that may bound strips, and not locked. What `bound_no_strip` and
  /// `lock` say of a vertex holds for those with which it merges.
  bool may_bound_strip(Vertex v) const { return get(m_state->freedoms, v) == Freedom::along_line; }
  bool bounds_no_strip(Vertex v) const { return get(m_state->freedoms, v) == Freedom::along_other_line; }

  /// Returns whether the edge is a border, or marked at both ends. `get` makes the rule a property map that
  /// says the same.
  bool is_line(Edge e) const
  {
    const Halfedge h = halfedge(e, m_state->mesh);
    return is_line_at_target(h) && is_line_at_target(opposite(h, m_state->mesh));
  }
  friend bool get(const Border_rule& rule, Edge e) { return rule.is_line(e); }

  /// Returns whether the edge of `h` is a border, or marked at the target of `h`.
  bool is_line_at_target(Halfedge h) const { return get(m_state->marks, h) || is_border_edge(h); }

  /// Returns whether the source of `h` may move onto its target.
  bool may_move(Halfedge h) const
  {
    return (is_free(source(h, m_state->mesh)) && !m_state->may_have_spokes) ||
           refusal(h) == Line_refusal::none;
  }

  /// Returns why the source of `h` may not move onto its target: the first reason, in their order.
  Line_refusal refusal(Halfedge h) const
  {
    const State& state = *m_state;
    const Vertex mover = source(h, state.mesh);
    const Freedom freedom = get(state.freedoms, mover);
    if (freedom == Freedom::free) {
      if (!state.may_have_spokes)
        return Line_refusal::none;
      if (is_line_at_target(h) || takes_needed_spoke(h, *this))
        return Line_refusal::line_end;
      return may_take_spokes(mover, get(state.points, target(h, state.mesh))) ? Line_refusal::none
                                                                              : Line_refusal::drift;
    }
    if (freedom == Freedom::none)
      return Line_refusal::locked;
    if (!is_line_at_target(opposite(h, state.mesh)))
      return Line_refusal::off_line;
    const std::optional<Halfedge> behind = line_behind(h, *this);
    if (!behind || is_cut_off(h, *this) || (state.may_have_spokes && takes_needed_spoke(h, *this)))
      return Line_refusal::line_end;
    return straightening(*behind, h, get(state.points, target(h, state.mesh)));
  }

  /// Returns whether the lines would let the source of `h` move onto its target, apart from locks and from
  /// limits of turn and drift, if they were those of which `lines.is_line_at_target(halfedge)` says so.
  template <class Lines>
  bool may_move_along(Halfedge h, const Lines& lines) const
  {
    const TriangleMesh& mesh = m_state->mesh;
    if (takes_needed_spoke(h, lines))
      return false;
    const Halfedge back = opposite(h, mesh);
    const auto around = CGAL::halfedges_around_target(back, mesh);
    if (std::none_of(around.begin(), around.end(), [&](Halfedge in) { return lines.is_line_at_target(in); }))
      return !lines.is_line_at_target(h);
    return lines.is_line_at_target(back) && line_behind(h, lines) && !is_cut_off(h, lines);
  }

  /// Returns whether the collapse that left `kept` may have changed what `may_move` says of edges that do not
  /// end at `kept`; `reaches` says so of one such edge. See `Collapse_locality`.
  bool reaches_neighbours(Vertex kept) const
  {
    if (!is_free(kept) || !m_state->may_have_spokes)
      return !is_free(kept);
    const auto around = CGAL::halfedges_around_target(kept, m_state->mesh);
    return std::any_of(around.begin(), around.end(),
                       [this](Halfedge h) { return is_line_at_target(opposite(h, m_state->mesh)); });
  }
  bool reaches(Vertex kept, Edge e) const
  {
    const Halfedge h = halfedge(e, m_state->mesh);
    return reaches_neighbours(kept) &&
           (is_line_at_target(h) || is_line_at_target(opposite(h, m_state->mesh)));
  }

  /// Returns whether the ends of an edge may merge at the place of the collapse.
  ///
  /// Where this place is one end, the answer is that of `may_move`. Any other place is allowed when neither
  /// end is on a line or locked, and refused when one of them is. When both are, neither may be locked, the
  /// edge must be a line itself with no face beside it whose edges are all lines, and the line must go on at
  /// both ends and change there within the limits for turn and drift. In any case, a pole at which a spoke
  /// goes has three lines.
  template <class Profile>
  bool allows(const internal::Collapse<Profile>& collapse) const
  {
    if (!collapse.are_both_moved())
      return may_move(collapse.moving());
    const State& state = *m_state;
    const Profile& profile = collapse.profile();
    if (state.may_have_spokes && takes_needed_spoke(profile.v0_v1(), *this))
      return false;
    if (is_free(profile.v0()) && is_free(profile.v1()))
      return !state.may_have_spokes || (may_take_spokes(profile.v0(), collapse.place()) &&
                                        may_take_spokes(profile.v1(), collapse.place()));
    if (is_free(profile.v0()) || is_free(profile.v1()) || is_locked(profile.v0()) ||
        is_locked(profile.v1()) || !is_line(edge(profile.v0_v1(), state.mesh)) ||
        is_cut_off(profile.v0_v1(), *this))
      return false;
    const std::optional<Halfedge> behind = line_behind(profile.v0_v1(), *this);
    const std::optional<Halfedge> ahead = line_behind(profile.v1_v0(), *this);
    return behind && ahead && may_straighten(*behind, profile.v0_v1(), collapse.place()) &&
           may_straighten(*ahead, profile.v1_v0(), collapse.place());
  }

  /// Called before and after each collapse, by `Border_visitor` for example. A vertex that is left by a
  /// collapse that was not announced is locked, since nothing is known of the lines that went into it.
  template <class Profile>
  void before_collapse(const internal::Collapse<Profile>& collapse) const
  {
    m_state->pending = pending_collapse(collapse);
  }
  void after_collapse(Vertex kept) const
  {
    State& state = *m_state;
    if (!state.pending)
      return state.raise(kept, Freedom::none);
    put(state.freedoms, kept, state.pending->freedom);
    if (state.pending->freedom != Freedom::free && !state.squared_drift_of.empty())
      state.squared_drift_of[kept] = state.pending->max_squared_drift;
    for (const Pending_line& line : state.pending->lines) {
      const Halfedge h = halfedge(kept, line.far_end, state.mesh).first;
      put(state.marks, h, line.is_marked_far);
      put(state.marks, opposite(h, state.mesh), line.is_marked_near);
      if (!line.passed.empty() && (is_line_at_target(h) || is_line_at_target(opposite(h, state.mesh))))
        state.passed[edge(h, state.mesh)] = line.passed;
    }
    state.pending.reset();
  }

private:
  enum class Freedom : unsigned char { free, along_line, along_other_line, none };

  // An original vertex of a line that is gone.
  struct Passed
  {
    Point point;
    double max_squared_drift;
  };

  // What an edge at the merged vertex must be after the collapse, if it is a line or a spoke before. Where
  // two edges become one, this holds whichever of them CGAL keeps.
  struct Pending_line
  {
    Vertex far_end;
    bool is_marked_far, is_marked_near; // at the far end, and at the merged vertex
    std::vector<Passed> passed;
  };
  struct Pending_collapse
  {
    Freedom freedom;
    double max_squared_drift = 0; // of the place; whichever vertex CGAL keeps
    std::vector<Pending_line> lines;
  };

  struct State
  {
    State(const TriangleMesh& mesh_, const VertexPointMap& points_, const Border_rule_options& options)
        : mesh(mesh_), points(points_), min_border_cosine(std::cos(options.max_border_turn * CGAL_PI / 180)),
          min_seam_cosine(std::cos(options.max_seam_turn * CGAL_PI / 180)),
          max_squared_height(options.max_corner_height * options.max_corner_height),
          max_squared_drift(options.max_drift * options.max_drift),
          freedoms(get(CGAL::dynamic_vertex_property_t<Freedom>(), mesh_)),
          marks(get(CGAL::dynamic_halfedge_property_t<unsigned char>(), mesh_))
    {
      for (const double turn : {options.max_border_turn, options.max_seam_turn})
        if (!(turn >= 0 && turn <= 180))
          throw Argument_error("the turn allowed at a border or seam is an angle between 0 and 180 degrees");
      if (!(options.max_corner_height >= 0))
        throw Argument_error("the height of a low corner is a length of at least 0");
      if (!(options.max_drift >= 0))
        throw Argument_error("the drift allowed at a border is a length of at least 0");
      for (const Halfedge h : halfedges(mesh))
        if (CGAL::is_border(h, mesh))
          raise(target(h, mesh), Freedom::along_line);
    }

    void raise(Vertex v, Freedom freedom)
    {
      if (get(freedoms, v) < freedom)
        put(freedoms, v, freedom);
    }

    const TriangleMesh& mesh;
    VertexPointMap points;
    double min_border_cosine;
    double min_seam_cosine;
    double max_squared_height;
    double max_squared_drift;
    typename boost::property_map<TriangleMesh, CGAL::dynamic_vertex_property_t<Freedom>>::const_type freedoms;
    typename boost::property_map<TriangleMesh, CGAL::dynamic_halfedge_property_t<unsigned char>>::const_type
        marks; // of an inner edge that is a line, at the target of the halfedge
    bool may_have_spokes = false;
    boost::unordered_map<Vertex, double> squared_drift_of;  // of vertices with a limit of their own
    boost::unordered_map<Edge, std::vector<Passed>> passed; // vertices that an edge has replaced
    std::optional<Pending_collapse> pending;                // announced, and not yet done
  };

  // Returns the other line edge at the source of the line edge `h`, pointing away from it. None when the
  // source is an end of the line, a junction, or a place where a border becomes a marked line.
  template <class Lines>
  std::optional<Halfedge> line_behind(Halfedge h, const Lines& lines) const
  {
    const TriangleMesh& mesh = m_state->mesh;
    std::optional<Halfedge> behind;
    for (const Halfedge out : CGAL::halfedges_around_source(source(h, mesh), mesh)) {
      if (out == h || !lines.is_line_at_target(opposite(out, mesh)))
        continue;
      if (behind)
        return std::nullopt;
      behind = out;
    }
    if (behind && is_border_edge(*behind) != is_border_edge(h))
      return std::nullopt;
    return behind;
  }

  // Whether the other edges of a face beside the line edge `h` are lines, or one of them is and the other is
  // a spoke. The collapse would remove this face, and with it a whole piece or a corner of one.
  template <class Lines>
  bool is_cut_off(Halfedge h, const Lines& lines) const
  {
    const TriangleMesh& mesh = m_state->mesh;
    for (const Halfedge side : {h, opposite(h, mesh)}) {
      if (CGAL::is_border(side, mesh))
        continue;
      const Halfedge to_apex = next(side, mesh), from_apex = prev(side, mesh);
      const bool is_line_at_end = lines.is_line_at_target(opposite(to_apex, mesh)),
                 is_line_at_start = lines.is_line_at_target(from_apex);
      if ((is_line_at_end && (is_line_at_start || lines.is_line_at_target(opposite(from_apex, mesh)))) ||
          (is_line_at_start && lines.is_line_at_target(to_apex)))
        return true;
    }
    return false;
  }

  // Whether the collapse of the edge of `h` makes one line of two at the apex of a face beside it, where no
  // two others end. Then this vertex would be the end of a line beside which nothing differs.
  template <class Lines>
  bool takes_needed_spoke(Halfedge h, const Lines& lines) const
  {
    const TriangleMesh& mesh = m_state->mesh;
    for (const Halfedge side : {h, opposite(h, mesh)}) {
      const Halfedge to_apex = next(side, mesh);
      if (CGAL::is_border(side, mesh) || !lines.is_line_at_target(to_apex) ||
          !lines.is_line_at_target(opposite(prev(side, mesh), mesh)))
        continue;
      const auto around = CGAL::halfedges_around_target(to_apex, mesh);
      if (std::count_if(around.begin(), around.end(),
                        [&](Halfedge in) { return lines.is_line_at_target(in); }) < 3)
        return true;
    }
    return false;
  }

  bool is_border_edge(Halfedge h) const
  {
    return CGAL::is_border(h, m_state->mesh) || CGAL::is_border(opposite(h, m_state->mesh), m_state->mesh);
  }

  // Whether the line u – m – t, with `behind` = m→u and `ahead` = m→t, may become the segment u – p, and
  // which limit says no.
  bool may_straighten(Halfedge behind, Halfedge ahead, const Point& p) const
  {
    return straightening(behind, ahead, p) == Line_refusal::none;
  }
  Line_refusal straightening(Halfedge behind, Halfedge ahead, const Point& p) const
  {
    const State& state = *m_state;
    const Point& m = get(state.points, source(ahead, state.mesh));
    const Point& u = get(state.points, target(behind, state.mesh));
    const typename Geom_traits::Segment_3 segment(u, p);
    const bool is_border = is_border_edge(ahead);
    if (!is_turn_small(m - u, p - m, is_border ? state.min_border_cosine : state.min_seam_cosine) &&
        !(is_border && state.max_squared_height > 0 &&
          are_passed_near(segment, behind, ahead, [&](const Passed&) { return state.max_squared_height; })))
      return Line_refusal::turn;
    if (state.max_squared_drift == std::numeric_limits<double>::infinity() && state.squared_drift_of.empty())
      return Line_refusal::none;
    return are_passed_near(segment, behind, ahead,
                           [](const Passed& passed) { return passed.max_squared_drift; })
               ? Line_refusal::none
               : Line_refusal::drift;
  }

  // Whether each original vertex that `segment` would replace, with `behind` and `ahead` or before them, is
  // within its limit of it.
  template <class MaxSquaredDistance>
  bool are_passed_near(const typename Geom_traits::Segment_3& segment, Halfedge behind, Halfedge ahead,
                       const MaxSquaredDistance& limit) const
  {
    const State& state = *m_state;
    const auto is_near = [&](const Passed& passed) {
      return CGAL::to_double(CGAL::squared_distance(passed.point, segment)) <= limit(passed);
    };
    if (!is_near(passed_at(source(ahead, state.mesh))))
      return false;
    for (const Halfedge h : {behind, ahead}) {
      const auto found = state.passed.find(edge(h, state.mesh));
      if (found != state.passed.end() && !std::all_of(found->second.begin(), found->second.end(), is_near))
        return false;
    }
    return true;
  }

  // Whether each original vertex that a spoke has replaced, whose pole is elsewhere, is within its limit of
  // the spoke when its end `v` goes to `p`.
  bool may_take_spokes(Vertex v, const Point& p) const
  {
    const State& state = *m_state;
    if (state.passed.empty())
      return true;
    for (const Halfedge out : CGAL::halfedges_around_source(v, state.mesh)) {
      const auto found =
          is_line_at_target(out) ? state.passed.find(edge(out, state.mesh)) : state.passed.end();
      if (found == state.passed.end())
        continue;
      const typename Geom_traits::Segment_3 segment(get(state.points, target(out, state.mesh)), p);
      if (!std::all_of(found->second.begin(), found->second.end(), [&](const Passed& passed) {
            return CGAL::to_double(CGAL::squared_distance(passed.point, segment)) <= passed.max_squared_drift;
          }))
        return false;
    }
    return true;
  }

  static bool is_turn_small(const Vector& before, const Vector& after, double min_cosine)
  {
    const double lengths = std::sqrt(CGAL::to_double(before.squared_length())) *
                           std::sqrt(CGAL::to_double(after.squared_length()));
    return CGAL::to_double(before * after) >= min_cosine * lengths;
  }

  template <class Profile>
  Pending_collapse pending_collapse(const internal::Collapse<Profile>& collapse) const
  {
    const Profile& profile = collapse.profile();
    const State& state = *m_state;
    const TriangleMesh& mesh = state.mesh;
    Pending_collapse pending;
    const Freedom freedom_0 = get(state.freedoms, profile.v0());
    const Freedom freedom_1 = get(state.freedoms, profile.v1());
    pending.freedom = (std::max)(freedom_0, freedom_1);
    if (pending.freedom == Freedom::free && !state.may_have_spokes)
      return pending;
    // A line that comes to a free vertex along a spoke ends behind it.
    if (!collapse.are_both_moved() && is_free(collapse.goal()))
      pending.freedom = Freedom::free;
    pending.max_squared_drift = passed_at(collapse.goal()).max_squared_drift;
    if (collapse.are_both_moved())
      pending.max_squared_drift =
          (std::min)(pending.max_squared_drift, passed_at(collapse.mover()).max_squared_drift);

    const Edge merged = edge(profile.v0_v1(), mesh);
    for (const Halfedge at : {collapse.moving(), opposite(collapse.moving(), mesh)}) {
      const Vertex near_end = source(at, mesh);
      const bool moves = at == profile.v0_v1() ? collapse.is_v0_moved() : collapse.is_v1_moved();
      const bool is_along_line = is_line_at_target(opposite(at, mesh));
      for (const Halfedge out : CGAL::halfedges_around_source(near_end, mesh)) {
        const Halfedge in = opposite(out, mesh);
        if (out == at || (!is_line_at_target(out) && !is_line_at_target(in)))
          continue;
        // What differs across a line behind a vertex that moves differs at the goal if it does so ahead.
        Pending_line& line = line_to(target(out, mesh), pending.lines);
        line.is_marked_far |= bool(get(state.marks, out));
        line.is_marked_near |= bool(get(state.marks, in)) && (!moves || is_line_at_target(at));
        take_passed(edge(out, mesh), line.passed);
        if (moves && is_along_line && is_line_at_target(in)) {
          line.passed.push_back(passed_at(near_end));
          take_passed(merged, line.passed);
        }
      }
    }
    m_state->passed.erase(merged);
    return pending;
  }

  static Pending_line& line_to(Vertex far_end, std::vector<Pending_line>& lines)
  {
    const auto found = std::find_if(lines.begin(), lines.end(),
                                    [&](const Pending_line& line) { return line.far_end == far_end; });
    return found != lines.end() ? *found : lines.emplace_back(Pending_line{far_end, false, false, {}});
  }

  Passed passed_at(Vertex v) const
  {
    const State& state = *m_state;
    const auto found = state.squared_drift_of.find(v);
    return {get(state.points, v),
            found == state.squared_drift_of.end() ? state.max_squared_drift : found->second};
  }

  void take_passed(Edge e, std::vector<Passed>& passed) const
  {
    const auto found = m_state->passed.find(e);
    if (found == m_state->passed.end())
      return;
    passed.insert(passed.end(), found->second.begin(), found->second.end());
    m_state->passed.erase(found);
  }

  std::shared_ptr<State> m_state;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_BORDER_RULE_H
