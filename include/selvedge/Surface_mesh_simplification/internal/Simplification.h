// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SIMPLIFICATION_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SIMPLIFICATION_H

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Simplify_options.h>
#include <selvedge/Simplify_report.h>
#include <selvedge/Surface_mesh_simplification/Halfedge_placement.h>
#include <selvedge/Surface_mesh_simplification/Optimal_placement.h>
#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/Surface_mesh_simplification/edge_collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Cgal_pass.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse_cost.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse_record.h>
#include <selvedge/Surface_mesh_simplification/internal/Filter_chain.h>
#include <selvedge/Surface_mesh_simplification/internal/Hindrance_search.h>
#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>
#include <selvedge/Surface_mesh_simplification/internal/Motion_filter.h>
#include <selvedge/Surface_mesh_simplification/internal/No_visitor.h>
#include <selvedge/Surface_mesh_simplification/internal/Reduction_setup.h>
#include <selvedge/Surface_mesh_simplification/internal/perform_collapse.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>
#include <selvedge/internal/Stopwatch.h>

#include <CGAL/Kernel_traits.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Carries out one reduction of a mesh: makes the filters, the cost and the placement from the options and
/// constraints, and gives them to the loop.
///
/// It exists to keep all of these, and the observer, in step: every collapse, of either loop, is announced to
/// them in `before_collapse` and `after_collapse`. It also counts what happens, for the report.
template <class TriangleMesh, class Observer,
          class VertexPointMap = typename boost::property_map<TriangleMesh, CGAL::vertex_point_t>::type>
class Simplification
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Edge = typename Graph_traits::edge_descriptor;
  using Face = typename Graph_traits::face_descriptor;
  using Point = typename boost::property_traits<VertexPointMap>::value_type;
  using Geom_traits = typename CGAL::Kernel_traits<Point>::Kernel;
  using Profile = Lazy_edge_profile<TriangleMesh, VertexPointMap, Geom_traits>;
  using Setup = Reduction_setup<TriangleMesh>;
  using Filters = Filter_chain<TriangleMesh, VertexPointMap, Observer>;
  using Motions = Motion_filter<TriangleMesh, VertexPointMap, Observer>;
  using Cost = Collapse_cost<TriangleMesh, VertexPointMap, Observer>;
  using Rule = typename Filters::Rule;
  using Targets = typename Filters::Targets;

public:
  Simplification(TriangleMesh& mesh, const Simplify_options& options,
                 const Simplify_constraints<TriangleMesh>& constraints, Observer& observer)
      : Simplification(mesh, options, constraints, observer, get(CGAL::vertex_point, mesh))
  {
  }

  /// The same with a vertex point map that is not the mesh's own.
  Simplification(TriangleMesh& mesh, const Simplify_options& options,
                 const Simplify_constraints<TriangleMesh>& constraints, Observer& observer,
                 const VertexPointMap& points)
      : Simplification(Setup(mesh, options, constraints, points), observer, points)
  {
  }

  /// Computes what is asked of the original. `run` does it, if nobody has; others may read the mesh
  /// meanwhile.
  void begin()
  {
    if (std::exchange(m_has_begun, true))
      return;
    m_filters.track_points();
    m_quadrics.initialize(m_mesh, m_points, m_traits);
  }

  /// Moves the source of `moving` onto its target, or both to `place`, without asking any filter, since the
  /// caller knows that this is allowed: it repeats collapses that were found in cells at `cost`. Call it
  /// between `begin` and `run`.
  void collapse(Halfedge moving, const std::optional<Point>& place, bool is_mover_first, double cost)
  {
    m_cost = cost;
    m_are_quadrics_old = true;
    const Profile profile(moving, m_mesh, m_points, m_traits);
    ++m_accepted;
    m_is_mover_first = is_mover_first;
    m_is_motion_due = true;
    Visitor visitor(*this);
    perform_collapse(m_mesh, m_points, No_constrained_edges(),
                     place ? Collapse<Profile>(profile, *place) : Collapse<Profile>::along(profile, moving),
                     visitor, Accumulation{m_quadrics});
  }

  /// Takes note that no more such collapses come: `refresh_quadrics` computes what there is around each
  /// vertex now, and `build_index` where each face is. `run` does it, if nobody has. Both may be called at
  /// once.
  void refresh_quadrics()
  {
    if (std::exchange(m_are_quadrics_old, false))
      m_quadrics.recompute(m_mesh, m_points);
  }
  void build_index()
  {
    if (std::exchange(m_has_index, true))
      return;
    const Stopwatch stopwatch;
    Cancellation_scope::check();
    m_filters.build_index();
    Cancellation_scope::check();
    m_report.seconds_index = stopwatch.seconds();
  }

  double diagonal() const { return m_diagonal; }
  const Rule& rule() const { return m_filters.border_rule(); }
  const Targets& targets() const { return m_filters.targets(); }

  /// Returns the cost of the edge that the loop considers now.
  double cost() const { return m_cost; }

  /// Returns what was refused until now. Within a collapse, `by_loop` counts this collapse, too.
  Refusals refusals() const
  {
    Refusals result = m_motions.refusals();
    // What the last filter accepted and the loop did not collapse. A stop comes before the filters.
    result.by_loop = m_accepted - m_report.collapses;
    return result;
  }

  /// Ends where the target is reached or nothing more is possible. `are_hindrances_counted` says whether a
  /// reduction that ends short of its target looks once more at all edges, to say why.
  Simplify_report run(bool are_hindrances_counted = true)
  {
    m_are_hindrances_counted = are_hindrances_counted;
    return run({}, [](const Simplify_report&) {});
  }

  /// Calls `on_level(report)` for each of `ratios`, which must descend, in the state in which a run to that
  /// ratio alone would end if its target did not decide on the order, and then goes on to the target.
  template <class On_level>
  Simplify_report run(const std::vector<double>& ratios, const On_level& on_level)
  {
    for (const double ratio : ratios)
      m_levels.push_back(targets().share(0).at_ratio(ratio));
    m_on_level = on_level;
    if (m_options.repeated)
      repeat(*m_options.repeated);
    else
      run_loop();
    while (m_next_level < m_levels.size())
      pass_level();
    return report();
  }

private:
  struct Rounding
  {
    const Observer* observer;

    Optional<Point> operator()(const Halfedge& edge, const Point& place) const
    {
      return observer->rounded_place(edge, place);
    }
  };
  using Ends = Halfedge_placement<TriangleMesh, Cost, Rule>;
  using Optimal_places = Optimal_placement<TriangleMesh, Cost, Rule, Rounding>;

  Simplification(const Setup& setup, Observer& observer, const VertexPointMap& points)
      : m_mesh(setup.mesh), m_points(points), m_options(setup.options), m_observer(observer),
        m_diagonal(setup.diagonal), m_filters(setup, points, observer),
        m_motions(setup, points, m_filters, observer), m_quadrics(m_mesh, m_options.cost, rule())
  {
    if (m_options.record)
      m_options.record->clear();
    m_quadrics.weigh(m_mesh, setup.constraints.vertex_weights);
    m_quadrics.measure_by(m_diagonal);
    m_report.faces_input = targets().total().faces;
    m_report.faces_fixed = targets().total().fixed;
    for (const auto& share : targets().shares())
      m_report.shares.push_back({share.faces, share.fixed});
  }

  // Does what an earlier reduction has done, until the target is reached. Since nothing is asked, nobody need
  // know costs, distances, and where faces are.
  void repeat(const Collapse_record& record)
  {
    pass_levels();
    if constexpr (Collapse_record::Is_possible<Halfedge>::value) {
      struct No_cost
      {
      };
      Visitor visitor(*this);
      auto should_stop = is_interrupted();
      record.for_each([&](std::uint32_t v0_v1, Merged_at at, const std::array<double, 3>& place,
                          bool is_mover_first) {
        const Profile profile(Halfedge(v0_v1), m_mesh, m_points, m_traits);
        if (targets().is_reached() || should_stop(0, profile, 0, 0))
          return false;
        const auto collapse =
            at == Merged_at::between
                ? Collapse<Profile>(profile, Point(place[0], place[1], place[2]))
                : Collapse<Profile>::along(profile, at == Merged_at::v0 ? profile.v1_v0() : profile.v0_v1());
        m_motions.expect(collapse);
        m_accepted += 1 + m_motions.companions().size();
        m_is_mover_first = is_mover_first;
        perform_collapse(m_mesh, m_points, No_constrained_edges(), collapse, visitor, No_cost());
        for (const Halfedge companion : m_motions.take_rest()) {
          const Profile of_companion(halfedge(edge(companion, m_mesh), m_mesh), m_mesh, m_points, m_traits);
          perform_collapse(m_mesh, m_points, No_constrained_edges(),
                           Collapse<Profile>::along(of_companion, companion), visitor, No_cost());
        }
        return true;
      });
    }
  }

  void run_loop()
  {
    begin();
    build_index();
    refresh_quadrics();
    pass_levels();
    const Cost costs(m_mesh, m_quadrics, m_filters, m_motions.joint(), m_observer, m_options, m_diagonal);
    if (m_options.placement == Placement::optimal)
      run_passes(costs, Optimal_places(costs, rule(), {&m_observer}));
    else
      run_passes(costs, Ends(costs, rule()));
  }

  template <class Places>
  void run_passes(const Cost& costs, const Places& places)
  {
    const auto run_passes = [&](auto run_pass) {
      bool is_promising = true;
      while (is_promising && !targets().is_reached() && !m_report.is_stopped) {
        Cancellation_scope::check();
        ++m_report.passes;
        is_promising = run_pass();
      }
    };
    if (m_options.loop == Collapse_loop::own) {
      run_passes([&] {
        const std::size_t collapses_before = m_report.collapses;
        selvedge::edge_collapse(
            m_mesh, is_over(),
            parameters::expected_collapses(is_target_known() ? targets().total().excess_asked / 2 : 0,
                                           parameters::geometric_test(false, CGAL::parameters::get_cost(costs)
                                                                                 .get_placement(places)
                                                                                 .vertex_point_map(m_points)
                                                                                 .use_relaxed_order(true)
                                                                                 .filter(Filter{this})
                                                                                 .visitor(Visitor(*this)))));
        // The loop leaves no collapse undone that a change nearby or of a blocker has made possible. Should a
        // rule look farther, as from one place of a shared mesh to another, another pass finds what it
        // allows.
        count_hindrances(places);
        return m_report.hindrances[Hindrance::by_loop] > 0 && m_report.collapses > collapses_before;
      });
    } else {
      Cgal_pass pass(
          m_mesh, m_points, costs, places, Filter{this}, Visitor(*this), [this] { return is_over(); },
          [this] { return refusals().intersection + refusals().clearance; });
      run_passes([&] {
        const std::size_t collapses_before = m_report.collapses;
        return pass() || m_report.collapses > collapses_before;
      });
      count_hindrances(places);
    }
  }

  // Whether the number of collapses to come may decide on their order. Levels on the way are to be those of a
  // reduction that ends there. A share with few collapses to come would make them all in its first tiles.
  // Companions are not in the queue: where most collapses are theirs, more would be expected than the queue
  // has edges, and costs would not count at all. Without a target, the limits say where the reduction ends.
  bool is_target_known() const
  {
    return (m_options.ratio || m_options.faces) && m_levels.empty() && !m_options.is_progression_recorded &&
           !targets().has_several_shares() && !has_companions();
  }

  bool has_companions() const
  {
    const auto all = edges(m_mesh);
    return std::any_of(all.begin(), all.end(),
                       [this](const auto& edge) { return m_observer.is_led(halfedge(edge, m_mesh)); });
  }

  // The stop predicate of either loop: the target is reached, or the caller wants to end.
  auto is_over()
  {
    return Any_stop(Function_stop([this](double cost) {
                      m_cost = cost;
                      return targets().is_reached();
                    }),
                    is_interrupted());
  }

  Hook_stop is_interrupted()
  {
    return Hook_stop([this](std::size_t) {
      const auto total = targets().total();
      if (m_options.should_stop)
        m_report.is_stopped = m_options.should_stop({m_report.faces_input, total.target, total.faces});
      if (!m_report.is_stopped)
        Cancellation_scope::check();
      return m_report.is_stopped;
    });
  }

  // Says of every edge what holds it back, unless the reduction has reached its target or was stopped.
  template <class Places>
  void count_hindrances(const Places& places)
  {
    m_report.hindrances = {};
    if (!m_are_hindrances_counted || targets().is_reached() || m_report.is_stopped)
      return;
    Hindrances hindrances;
    m_filters.on_started(); // who asks the exact test outside of a loop has to say so
    Hindrance_search search(m_mesh, m_points, m_filters, m_motions, m_observer);
    auto should_stop = is_interrupted();
    for (const Edge e : edges(m_mesh)) {
      const Halfedge h = halfedge(e, m_mesh);
      if (!targets().is_changeable(h))
        continue;
      const Profile profile(h, m_mesh, m_points, m_traits);
      if (should_stop(0, profile, 0, 0))
        return;
      const Hindrance reason = search.of_edge(profile, places);
      ++hindrances[reason];
      m_observer.on_hindered(e, reason);
    }
    m_report.hindrances = hindrances;
  }

  // What the loop asks.
  struct Filter
  {
    using Judging_filter = Filter;

    Simplification* simplification;

    template <class Profile>
    bool allows(const Collapse<Profile>& collapse) const
    {
      return simplification->allows(collapse);
    }

    const std::vector<Face>& blockers() const { return simplification->m_filters.blockers(); }
  };

  // What the loop tells.
  struct Visitor : No_visitor
  {
    explicit Visitor(Simplification& simplification_) : simplification(&simplification_) {}

    void OnStarted(TriangleMesh&) { simplification->m_filters.on_started(); }
    template <class Profile>
    void before_collapse(const Collapse<Profile>& collapse)
    {
      simplification->before_collapse(collapse);
    }
    template <class Profile, class OptionalPoint>
    void OnCollapsing(const Profile& profile, const OptionalPoint& placement)
    {
      before_collapse(Collapse<Profile>(profile, *placement));
    }
    template <class Profile>
    void OnCollapsed(const Profile&, const Vertex& kept)
    {
      simplification->after_collapse(kept);
    }

    // The loop does these motions next, without asking: they have been asked for together.
    std::vector<Halfedge> companions() const { return simplification->m_motions.take_rest(); }

    // The loop tries this motion next, before the cheapest edge.
    std::optional<Halfedge> follow_up() const
    {
      return simplification->targets().is_reached() ? std::nullopt
                                                    : simplification->m_filters.partners().follow_up();
    }

    Simplification* simplification;
  };

  // Takes the place of the quadrics during collapses between which nobody asks for a cost.
  struct Accumulation
  {
    using Update_tag = CGAL::Tag_true;

    template <class Profile>
    void update_after_collapse(const Profile& profile, const Vertex& kept) const
    {
      quadrics.accumulate(profile, kept);
    }

    const typename Cost::Quadrics& quadrics;
  };

  template <class Profile>
  bool allows(const Collapse<Profile>& collapse)
  {
    if (!m_motions.allows(collapse)) {
      report_refusal(collapse.moving());
      return false;
    }
    m_is_mover_first = m_filters.is_mover_first();
    m_accepted += 1 + m_motions.companions().size();
    m_is_motion_due = true;
    return true;
  }

  void report_refusal(Halfedge moving)
  {
    Refusals now = refusals();
    now.by_loop = 0; // it counts motions accepted before this one
    m_observer.on_refused(moving, now - m_refused_until_now);
    m_refused_until_now = now;
  }

  template <class Profile>
  void before_collapse(const Collapse<Profile>& collapse)
  {
    if constexpr (Collapse_record::Is_possible<Halfedge>::value)
      if (std::exchange(m_is_motion_due, false) && m_options.record)
        m_options.record->add(collapse, m_is_mover_first);
    if (collapse.are_both_moved()) {
      ++m_report.placed;
      ++m_report.collapses;
      m_observer.before_placement(collapse.moving(), collapse.place(), m_is_mover_first);
    } else if (m_motions.is_other_next()) {
      m_observer.before_joint_collapse(collapse.moving(), rule());
    } else {
      m_observer.before_collapse(collapse.moving(), rule());
      ++m_report.collapses;
    }
    m_motions.before_collapse(collapse);
  }

  void after_collapse(Vertex kept)
  {
    m_motions.after_collapse(kept);
    if (m_motions.is_whole()) {
      m_observer.after_step();
      pass_levels();
    }
  }

  // Reports the levels that have been reached. Each is a snapshot on which nothing that follows depends.
  void pass_levels()
  {
    while (m_next_level < m_levels.size() && targets().share(0).faces <= m_levels[m_next_level])
      pass_level();
  }
  void pass_level()
  {
    const std::size_t target = targets().share(0).asked;
    m_filters.set_target(m_levels[m_next_level++]);
    m_on_level(report());
    m_filters.set_target(target);
  }

  Simplify_report report() const
  {
    Simplify_report report = m_report;
    const auto total = targets().total();
    report.faces_output = total.faces;
    report.faces_target = total.target;
    report.faces_to_go = total.excess;
    for (std::size_t i = 0; i < report.shares.size(); ++i) {
      report.shares[i].target = targets().share(i).target();
      report.shares[i].output = targets().share(i).faces;
    }
    report.refused = refusals();
    report.refused_elsewhere = m_motions.refused_elsewhere();
    report.left_alone = m_filters.partners().alone();
    m_filters.add_statistics(report);
    report.seconds_reduce = m_stopwatch.seconds();
    return report;
  }

  Stopwatch m_stopwatch;
  TriangleMesh& m_mesh;
  VertexPointMap m_points;
  const Simplify_options& m_options;
  Observer& m_observer;
  Geom_traits m_traits;
  double m_diagonal;
  Filters m_filters;
  Motions m_motions;
  typename Cost::Quadrics m_quadrics;
  Simplify_report m_report;
  std::size_t m_accepted = 0;
  bool m_is_mover_first = false; // of the last collapse accepted
  bool m_is_motion_due = false;  // whether it has not begun
  double m_cost = 0;
  bool m_has_begun = false, m_has_index = false;
  bool m_are_quadrics_old = false; // for collapses that were found in cells
  bool m_are_hindrances_counted = true;
  Refusals m_refused_until_now;
  std::vector<std::size_t> m_levels; // face counts of share 0
  std::size_t m_next_level = 0;
  std::function<void(const Simplify_report&)> m_on_level;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SIMPLIFICATION_H
