// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SIMPLIFY_H
#define SELVEDGE_SIMPLIFY_H

#include <selvedge/Simplify_options.h>
#include <selvedge/Simplify_report.h>
#include <selvedge/Surface_mesh_simplification/Aspect_ratio_filter.h>
#include <selvedge/Surface_mesh_simplification/Border_filter.h>
#include <selvedge/Surface_mesh_simplification/Error_filter.h>
#include <selvedge/Surface_mesh_simplification/Halfedge_placement.h>
#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Normal_change_filter.h>
#include <selvedge/Surface_mesh_simplification/Quadric_cost.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>

#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

namespace selvedge {

/// Watches nothing. A model of what `simplify` accepts as an observer.
struct No_observer
{
  /// Before the source of `moving` goes to its target and merges with it.
  template <class Halfedge>
  void before_collapse(const Halfedge& /*moving*/)
  {}
};

/// What of a mesh `simplify` must leave as it is.
template <class TriangleMesh>
struct Simplify_constraints
{
  /// Vertices that do not move. Others may move onto them.
  std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor> locked_vertices;

  /// Edges inside the mesh that are to be kept as borders are: seams.
  std::vector<typename boost::graph_traits<TriangleMesh>::edge_descriptor> line_edges;
};

namespace internal {

/// Everything that one reduction is made of: the rule for borders, the cost, the chain of filters, and a visitor that
/// tells them of each collapse.
template <class TriangleMesh, class Observer>
class Simplification
{
  using Rule = Border_rule<TriangleMesh>;
  using Cost = Quadric_cost<TriangleMesh, Rule>;
  using Border = Border_filter<Rule>;
  using Error = Error_filter<Cost, Border>;
  using Aspect_ratio = Aspect_ratio_filter<Error>;
  using Normal_change = Normal_change_filter<Aspect_ratio>;
  using Intersection = Intersection_filter<TriangleMesh, Normal_change>;

public:
  Simplification(TriangleMesh& mesh, const Simplify_options& options, const Simplify_constraints<TriangleMesh>& constraints,
                 Observer& observer)
    : m_mesh(mesh), m_options(options), m_observer(observer), m_diagonal(diagonal(mesh)), m_rule(make_rule(constraints)),
      m_cost(mesh, options.cost, m_rule), m_border(m_rule), m_error(max_error(), m_cost, m_border),
      m_aspect_ratio(options.min_aspect_ratio, m_error), m_normal_change(options.max_normal_change, m_aspect_ratio)
  {
    m_report.faces_input = face_count(mesh);
    m_report.faces_target = face_target();
    const Clock::time_point start = Clock::now();
    if (options.check_intersections)
      m_intersection.emplace(mesh, m_normal_change, Clustered_AABB_tree(options.faces_per_cluster));
    m_report.seconds_index = seconds_since(start);
  }

  Simplify_report run()
  {
    const Clock::time_point start = Clock::now();
    const auto filter = [this](const auto& profile, const auto& placement) {
      const auto accepted =
        m_intersection ? (*m_intersection)(profile, placement) : m_normal_change(profile, placement);
      m_accepted += bool(accepted);
      return accepted;
    };
    const Halfedge_placement<TriangleMesh, Cost, Rule> directions(m_cost, m_rule);
    const Filtered_halfedge_placement placement(m_mesh, directions, filter);
    // CGAL's loop forgets an edge that was refused until its neighbourhood changes, though the layer that blocked it may have
    // moved away, and though its second direction may do. A new pass asks again: at the end, and sooner when so many are
    // forgotten that the loop is about to pay much more elsewhere.
    std::size_t forgotten_before = 0;
    double dearest = 0;
    const auto forgotten = [&] { return refusals().intersection - forgotten_before; };
    const Pass_stop is_pass_over([&](double cost) {
      if (cost < dearest || forgotten() * s_forgotten_share < face_count(m_mesh))
        return false;
      dearest = s_dearer * (std::max)(cost, (std::numeric_limits<double>::min)());
      return true;
    });
    const Any_stop stop(Face_count_stop(m_report.faces_target), Hook_stop([this](std::size_t faces) {
                          m_report.is_stopped = m_options.should_stop &&
                                                m_options.should_stop({m_report.faces_input, m_report.faces_target, faces});
                          return m_report.is_stopped;
                        }),
                        is_pass_over);
    while (face_count(m_mesh) > m_report.faces_target && !m_report.is_stopped) {
      const std::size_t collapses_before = m_report.collapses;
      const Refusals refused_before = refusals();
      const double dearest_before = dearest;
      const std::size_t turned_before = placement.turned();
      forgotten_before += forgotten();
      CGAL::Surface_mesh_simplification::edge_collapse(
        m_mesh, stop,
        CGAL::parameters::get_cost(m_cost).get_placement(placement).visitor(Visitor<decltype(placement)>(*this, placement)));
      ++m_report.passes;
      m_report.refused_in_last_pass = difference(refusals(), refused_before);
      if (m_report.collapses == collapses_before && dearest == dearest_before &&
          placement.turned() == turned_before)
        break;
    }
    m_report.faces_output = face_count(m_mesh);
    m_report.refused = refusals();
    m_report.seconds_reduce = m_report.seconds_index + seconds_since(start);
    report_intersections();
    return m_report;
  }

private:
  using Clock = std::chrono::steady_clock;

  // A pass ends early when one edge is forgotten for so many faces, and costs have grown by such a factor since the last
  // time.
  static constexpr std::size_t s_forgotten_share = 4;
  static constexpr double s_dearer = 4;

  template <class Function>
  class Pass_stop
  {
  public:
    explicit Pass_stop(const Function& is_over) : m_is_over(is_over) {}

    template <class FT, class Profile>
    bool operator()(const FT& cost, const Profile&, std::size_t, std::size_t) const
    {
      return m_is_over(cost);
    }

  private:
    Function m_is_over;
  };

  template <class Placement>
  class Visitor : public CGAL::Surface_mesh_simplification::Edge_collapse_visitor_base<TriangleMesh>
  {
  public:
    Visitor(Simplification& simplification, const Placement& placement)
      : m_simplification(&simplification), m_placement(placement)
    {}

    void OnStarted(TriangleMesh&) { m_placement.on_started(); }
    template <class Profile, class OptionalCost, class Size>
    void OnSelected(const Profile&, const OptionalCost&, Size, Size)
    {
      m_placement.on_selected();
    }
    template <class Profile, class OptionalPoint>
    void OnCollapsing(const Profile& profile, const OptionalPoint& placement)
    {
      m_simplification->before_collapse(profile, *placement);
    }
    template <class Profile, class Vertex>
    void OnCollapsed(const Profile&, const Vertex& kept)
    {
      m_simplification->after_collapse(kept);
      m_placement.on_collapsed(kept);
    }

  private:
    Simplification* m_simplification;
    Placement m_placement;
  };

  template <class Profile, class Point>
  void before_collapse(const Profile& profile, const Point& placement)
  {
    m_observer.before_collapse(is_v0_moved(profile, placement) ? profile.v0_v1() : profile.v1_v0());
    m_rule.before_collapse(profile, placement);
    if (m_intersection)
      m_intersection->visitor().OnCollapsing(profile, Optional<Point>(placement));
  }

  template <class Vertex>
  void after_collapse(const Vertex& kept)
  {
    ++m_report.collapses;
    m_rule.after_collapse(kept);
    if (m_intersection)
      m_intersection->visitor().OnCollapsed(0, kept);
  }

  Rule make_rule(const Simplify_constraints<TriangleMesh>& constraints) const
  {
    Border_rule_options options;
    options.max_border_turn = m_options.max_border_turn;
    options.max_seam_turn = m_options.max_seam_turn;
    options.max_drift = m_options.max_border_drift * m_diagonal;
    Rule rule(m_mesh, options);
    for (const auto e : constraints.line_edges)
      rule.mark(e);
    for (const auto v : constraints.locked_vertices)
      rule.lock(v);
    return rule;
  }

  double max_error() const
  {
    if (!m_options.max_error)
      return std::numeric_limits<double>::infinity();
    if (!(*m_options.max_error >= 0))
      throw Argument_error("the error allowed is a share of the diagonal, at least 0");
    return *m_options.max_error * m_diagonal;
  }

  std::size_t face_target() const
  {
    std::size_t target = m_options.faces.value_or(0);
    if (m_options.ratio)
      target = (std::max)(target, Face_ratio_stop(*m_options.ratio, m_mesh).target());
    return target;
  }

  static double diagonal(const TriangleMesh& mesh)
  {
    CGAL::Bbox_3 box;
    for (const auto v : vertices(mesh))
      box += get(get(CGAL::vertex_point, mesh), v).bbox();
    return box.xmin() <= box.xmax() ? std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin())
                                    : 0;
  }

  Refusals refusals() const
  {
    Refusals result;
    result.border = m_border.refusals();
    result.error = m_error.refusals();
    result.aspect_ratio = m_aspect_ratio.refusals();
    result.normal_change = m_normal_change.refusals();
    result.intersection = m_intersection ? m_intersection->refusals() : 0;
    // What passed the last filter and was not collapsed; a stop comes before the filters.
    result.by_loop = m_accepted - m_report.collapses;
    return result;
  }

  static Refusals difference(const Refusals& a, const Refusals& b)
  {
    return {a.border - b.border,
            a.error - b.error,
            a.aspect_ratio - b.aspect_ratio,
            a.normal_change - b.normal_change,
            a.intersection - b.intersection,
            a.by_loop - b.by_loop};
  }

  void report_intersections()
  {
    if (!m_intersection)
      return;
    const auto& guard = m_intersection->statistics();
    const auto& index = m_intersection->index().statistics();
    m_report.intersections = {guard.motions_judged,   guard.stars_clear_by_view, guard.sweeps_tested,
                              guard.refused_by_link,  guard.refused_by_star,     guard.refused_by_sweep,
                              index.clusters,         index.queries,             index.visits,
                              index.cluster_rebuilds, index.top_rebuilds};
  }

  static double seconds_since(Clock::time_point start)
  {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  TriangleMesh& m_mesh;
  const Simplify_options& m_options;
  Observer& m_observer;
  double m_diagonal;
  Rule m_rule;
  Cost m_cost;
  Border m_border;
  Error m_error;
  Aspect_ratio m_aspect_ratio;
  Normal_change m_normal_change;
  std::optional<Intersection> m_intersection;
  Simplify_report m_report;
  std::size_t m_accepted = 0;
};

} // namespace internal

/// Reduces a triangle mesh by halfedge collapses until a target is reached or no collapse is allowed any more,
/// without letting anything touch or pass through anything.
///
/// **Guarantees** for an embedded mesh (every face a proper triangle, no two with the same three positions, any two
/// meeting exactly in the positions that they share, and the edge between two of them):
/// 1. *Embedded*: it is embedded after every collapse, so also at the end, however that came.
/// 2. *Motion*: on the way nothing passes through anything; the order of layers is kept.
/// 3. *Topology*: components, boundary loops and Euler characteristic are kept.
/// 4. *Seams*: borders and line edges change only along themselves, within the turn and the drift allowed.
/// 5. *Stop*: the target is reached, or the report says what refused how often.
/// 6. *Determinism*: the same mesh and options give the same result.
///
/// For a mesh that is not embedded, lock the vertices of every face of an offending pair: then the offending pairs
/// of the result are those of the input, and between all other faces the guarantees hold. (The function for soups below
/// does that.)
///
/// **Preconditions** the caller must ensure: the faces are triangles; `TriangleMesh` is a mutable face graph whose points
/// are of a kernel with exact predicates. Checked at run time: options in range, no edge of length zero
/// (`Argument_error`).
///
/// **Exactness** Everything about intersections, by exact predicates alone; everything about quality, in floating
/// point.
///
/// **Complexity** O(n log n) for n faces as a rule; with layers very close, more.
///
/// For `CGAL::Surface_mesh` the removed elements stay as garbage: `mesh.collect_garbage()` removes them.
///
/// **Reference** Derichs, Misiak, Fuhrmann: Intersection-free mesh decimation for high resolution cloth models.
template <class TriangleMesh, class Observer = No_observer>
Simplify_report simplify(TriangleMesh& mesh, const Simplify_options& options,
                         const Simplify_constraints<TriangleMesh>& constraints = {}, Observer&& observer = Observer())
{
  return internal::Simplification<TriangleMesh, std::remove_reference_t<Observer>>(mesh, options, constraints, observer)
    .run();
}

} // namespace selvedge

#endif // SELVEDGE_SIMPLIFY_H
