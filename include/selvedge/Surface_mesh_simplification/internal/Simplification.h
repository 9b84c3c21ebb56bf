// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SIMPLIFICATION_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SIMPLIFICATION_H

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Simplify_options.h>
#include <selvedge/Simplify_report.h>
#include <selvedge/Surface_mesh_simplification/Aspect_ratio_filter.h>
#include <selvedge/Surface_mesh_simplification/Border_filter.h>
#include <selvedge/Surface_mesh_simplification/Error_filter.h>
#include <selvedge/Surface_mesh_simplification/Halfedge_placement.h>
#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Normal_change_filter.h>
#include <selvedge/Surface_mesh_simplification/Optimal_placement.h>
#include <selvedge/Surface_mesh_simplification/Quadric_cost.h>
#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/Surface_mesh_simplification/edge_collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Border_partners.h>
#include <selvedge/Surface_mesh_simplification/internal/Cgal_pass.h>
#include <selvedge/Surface_mesh_simplification/internal/Face_targets.h>
#include <selvedge/Surface_mesh_simplification/internal/Further_poses.h>
#include <selvedge/Surface_mesh_simplification/internal/Halfedge_filter.h>
#include <selvedge/Surface_mesh_simplification/internal/Joint_motions.h>
#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>
#include <selvedge/Surface_mesh_simplification/internal/Topology_test.h>
#include <selvedge/Surface_mesh_simplification/internal/Tracked_points.h>
#include <selvedge/Surface_mesh_simplification/internal/perform_collapse.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>
#include <selvedge/spatial/internal/Selectable_index.h>

#include <CGAL/Kernel_traits.h>

#include <boost/unordered_set.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Carries out one reduction of a mesh: makes the border rule, the cost, the face targets and the chain of
/// filters from the options, and gives them to the loop.
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
  using Point = typename boost::property_traits<VertexPointMap>::value_type;
  using Geom_traits = typename CGAL::Kernel_traits<Point>::Kernel;
  using Rule = Border_rule<TriangleMesh, VertexPointMap>;
  using Targets = Face_targets<TriangleMesh>;
  using Quadrics = Quadric_cost<TriangleMesh, Rule>;
  using Lazy_profile = Lazy_edge_profile<TriangleMesh, VertexPointMap, Geom_traits>;
  using Joint = Joint_motions<TriangleMesh, VertexPointMap>;

  /// Whether a face lies in a strip between two lines, such as the edge of thick cloth: its corners are on
  /// lines after the collapse, and at most one of its edges is a line. However long it is, the strip is no
  /// wider.
  struct Is_of_strip
  {
    const TriangleMesh* mesh;
    Rule rule;

    template <class Profile>
    bool operator()(const Collapse<Profile>& collapse, const Halfedge& h) const
    {
      const Halfedge sides[] = {h, next(h, *mesh), prev(h, *mesh)};
      const auto is_line = [this](const Halfedge& side) { return rule.is_line(edge(side, *mesh)); };
      return rule.may_bound_strip(source(h, *mesh)) && rule.may_bound_strip(target(sides[1], *mesh)) &&
             (rule.may_bound_strip(collapse.mover()) || rule.may_bound_strip(collapse.goal())) &&
             std::count_if(std::begin(sides), std::end(sides), is_line) <= 1;
    }
  };

  using Poses = Further_poses<TriangleMesh, Is_of_strip>;
  using Clock = std::chrono::steady_clock;

  /// Adds the costs of texture and normals to that of the quadrics, takes the mean over all poses, and for
  /// vertices that move together the costs of all. An edge has no cost if none of its faces counts.
  class Cost
  {
  public:
    using Update_tag = CGAL::Tag_true;

    Cost(TriangleMesh& mesh, const Quadrics& quadrics, const Targets& targets, const Joint& joint,
         const Poses& poses, const Observer& observer, double uv_weight, double normal_weight)
        : m_mesh(&mesh), m_quadrics(quadrics), m_targets(targets), m_joint(&joint), m_poses(&poses),
          m_observer(&observer), m_uv_weight(uv_weight), m_normal_weight(normal_weight)
    {
    }

    void initialize(const TriangleMesh& mesh, const VertexPointMap& points, const Geom_traits& traits) const
    {
      m_quadrics.initialize(mesh, points, traits);
      m_poses->initialise_costs();
    }

    template <class Profile, class Point>
    Optional<typename Profile::FT> operator()(const Profile& profile, const Optional<Point>& placement) const
    {
      Optional<double> cost;
      if (placement) {
        const Collapse<Profile> collapse(profile, *placement);
        cost =
            collapse.are_both_moved() ? cost_at(profile, *placement) : cost_along(profile, collapse.moving());
      }
      return cost ? typename Profile::FT(*cost) : Optional<typename Profile::FT>();
    }

    template <class Profile>
    Optional<double> cost_along(const Profile& profile, Halfedge moving) const
    {
      if (!m_targets.is_counted(moving) || m_observer->is_led(moving))
        return {};
      double cost = cost_alone(profile, moving);
      if (m_joint->is_joint(source(moving, *m_mesh))) {
        const Geom_traits traits;
        if (const auto others = m_joint->others(moving))
          for (const Halfedge h : *others)
            cost += cost_alone(Lazy_profile(h, *m_mesh, profile.vertex_point_map(), traits), h);
      }
      return cost;
    }

    template <class Profile, class Point>
    Optional<double> cost_at(const Profile& profile, const Point& place) const
    {
      if (!m_targets.is_counted(profile.v0_v1()))
        return {};
      double cost = m_quadrics.cost_at(profile, place);
      if (m_uv_weight > 0)
        cost += m_uv_weight * m_observer->uv_cost_at(profile.v0_v1(), place);
      if (m_normal_weight > 0)
        cost += m_normal_weight * m_observer->normal_cost_at(profile.v0_v1(), place);
      return cost;
    }

    template <class Profile>
    auto least_place(const Profile& profile, double reach) const
    {
      return m_quadrics.least_place(profile, reach);
    }

    bool reaches_neighbours(Vertex kept) const { return m_quadrics.reaches_neighbours(kept); }
    bool reaches(Vertex kept, Edge edge) const { return m_quadrics.reaches(kept, edge); }
    bool can_wait(Vertex kept, Edge edge) const { return m_quadrics.can_wait(kept, edge); }

    template <class Profile, class Vertex>
    void update_after_collapse(const Profile& profile, const Vertex& kept) const
    {
      m_quadrics.update_after_collapse(profile, kept);
      m_poses->update_costs(profile.v0(), profile.v1(), kept);
    }

  private:
    template <class Profile>
    double cost_alone(const Profile& profile, Halfedge moving) const
    {
      double cost = *m_quadrics.cost_along(profile, moving);
      if (!m_poses->empty())
        cost = m_poses->mean_cost(cost, Collapse<Profile>::along(profile, moving));
      if (m_uv_weight > 0)
        cost += m_uv_weight * m_observer->uv_cost(moving);
      if (m_normal_weight > 0)
        cost += m_normal_weight * m_observer->normal_cost(moving);
      return cost;
    }

    TriangleMesh* m_mesh;
    Quadrics m_quadrics;
    Targets m_targets;
    const Joint* m_joint;
    const Poses* m_poses;
    const Observer* m_observer;
    double m_uv_weight, m_normal_weight;
  };

  struct Is_uv_orientation_kept
  {
    const Observer* observer; // null: every motion is accepted
    Rule rule;

    template <class Profile>
    bool operator()(const Collapse<Profile>& collapse) const
    {
      if (!observer)
        return true;
      return collapse.are_both_moved()
                 ? observer->keeps_uv_orientation_at(collapse.moving(), collapse.place())
                 : observer->keeps_uv_orientation(collapse.moving(), rule);
    }
  };

  struct Are_pieces_kept
  {
    const Observer* observer;
    Rule rule;

    bool operator()(const Halfedge& moving) const { return observer->keeps_pieces(moving, rule); }
  };

  struct Are_partners_kept
  {
    const Border_partners<TriangleMesh>* partners;

    bool operator()(const Halfedge& moving) const { return partners->allows(moving); }
  };

  using Line = Border_filter<Rule>;
  using Pieces = Halfedge_filter<Are_pieces_kept, Line>;
  using Border = Halfedge_filter<Are_partners_kept, Pieces>;
  using Target = Halfedge_filter<Targets, Border>;
  using Aspect_ratio = Aspect_ratio_filter<Target, Is_of_strip>;
  using Normal_change = Normal_change_filter<Aspect_ratio>;
  using Uv = Halfedge_filter<Is_uv_orientation_kept, Normal_change>;
  using Error = Error_filter<Tracked_points<TriangleMesh>, Uv>;
  using Intersection =
      Intersection_filter<TriangleMesh, Error, Selectable_index, VertexPointMap, Geom_traits>;

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
      : m_start(Clock::now()), m_mesh(mesh), m_points(points), m_options(options), m_observer(observer),
        m_diagonal(in_range(constraints.diagonal ? *constraints.diagonal : diagonal_of_box())),
        m_joint(mesh, points, joint_vertices(constraints)), m_rule(make_rule(constraints, points)),
        m_targets(make_targets(constraints)), m_quadrics(mesh, options.cost, m_rule),
        m_partners(mesh, constraints.partners), m_line(m_rule), m_pieces({&observer, m_rule}, m_line),
        m_border({&m_partners}, m_pieces), m_target(m_targets, m_border),
        m_aspect_ratio(options.min_aspect_ratio, m_target, {&mesh, m_rule}),
        m_normal_change(options.max_normal_change, m_aspect_ratio),
        m_uv({options.check_uv_orientation ? &observer : nullptr, m_rule}, m_normal_change), m_tracked(mesh),
        m_error(max_error(), m_tracked, m_uv),
        m_poses(mesh, options, constraints, m_diagonal, max_error(), {&mesh, m_rule},
                [&](const auto& of_pose) { return make_rule(constraints, of_pose); }),
        m_offending_pairs(constraints.offending_pairs), m_multiplicities(constraints.multiplicities),
        m_may_intersect(constraints.may_intersect), m_obstacle(constraints.uncounted_faces)
  {
    if (!m_poses.empty() && options.placement == Placement::optimal)
      throw Argument_error("a new place of a vertex is a place in one pose; with several poses, vertices go "
                           "to others");
    if (options.clearance && !options.check_intersections)
      throw Argument_error(
          "a clearance is kept where intersections are checked; leave one of the two options");
    if (!(options.uv_weight >= 0 && std::isfinite(options.uv_weight)))
      throw Argument_error("the weight of the texture is at least 0, and finite");
    if (!(options.normal_weight >= 0 && std::isfinite(options.normal_weight)))
      throw Argument_error("the weight of normals is at least 0, and finite");
    m_quadrics.weigh(mesh, constraints.vertex_weights);
    m_quadrics.measure_by(m_diagonal);
    m_report.faces_input = m_targets.total().faces;
    m_report.faces_fixed = m_targets.total().fixed;
  }

  /// Computes what is asked of the original. `run` does it, if nobody has; others may read the mesh
  /// meanwhile.
  void begin()
  {
    if (std::exchange(m_has_begun, true))
      return;
    if (m_options.max_error)
      m_tracked.begin(m_points, m_diagonal, max_error());
    m_quadrics.initialize(m_mesh, m_points, m_traits);
  }

  /// Moves the source of `moving` onto its target, or both to `place`, without asking any filter, since the
  /// caller knows that this is allowed: it repeats collapses that were found in cells at `cost`. Call it
  /// between `begin` and `run`.
  void collapse(Halfedge moving, const std::optional<Point>& place, bool is_mover_first, double cost)
  {
    m_cost = cost;
    m_are_quadrics_old = true;
    const Geom_traits traits;
    const Lazy_edge_profile<TriangleMesh, VertexPointMap, Geom_traits> profile(moving, m_mesh, m_points,
                                                                               traits);
    ++m_accepted;
    m_is_mover_first = is_mover_first;
    Visitor visitor(*this);
    using Collapse_of_edge = Collapse<decltype(profile)>;
    perform_collapse(m_mesh, m_points, No_constrained_edges(),
                     place ? Collapse_of_edge(profile, *place) : Collapse_of_edge::along(profile, moving),
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
    const Clock::time_point start = Clock::now();
    Cancellation_scope::check();
    if (m_options.check_intersections) {
      m_intersection.emplace(m_mesh, m_error, empty_index(), m_points);
      m_intersection->exempt(m_offending_pairs, m_multiplicities);
      m_intersection->let_intersect(m_may_intersect);
      if (m_options.clearance)
        m_intersection->keep_clearance(*m_options.clearance, m_obstacle);
      m_poses.build_index([this] { return empty_index(); }, m_multiplicities, m_may_intersect,
                          m_options.clearance, m_obstacle);
    }
    Cancellation_scope::check();
    m_report.seconds_index = seconds_since(start);
  }

  double diagonal() const { return m_diagonal; }
  const Rule& rule() const { return m_rule; }
  const Targets& targets() const { return m_targets; }

  /// Returns the cost of the edge that the loop considers now.
  double cost() const { return m_cost; }

  /// Returns what was refused until now. Within a collapse, `by_loop` counts this collapse, too.
  Refusals refusals() const
  {
    Refusals result;
    result.border = m_line.refusals() + m_pieces.refusals() + m_border.refusals();
    result.target = m_target.refusals();
    result.error = m_error.refusals();
    result.aspect_ratio = m_aspect_ratio.refusals();
    result.normal_change = m_normal_change.refusals();
    result.uv = m_uv.refusals();
    result.intersection = (m_intersection ? m_intersection->refusals() : 0) + m_refused_in_first_pose;
    m_poses.add_refusals(result);
    result.intersection -= m_refused_by_clearance;
    result.clearance = m_refused_by_clearance;
    // What the last filter accepted and the loop did not collapse. A stop comes before the filters.
    result.companions = m_companions_too_near;
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
      m_levels.push_back(m_targets.share(0).at_ratio(ratio));
    m_on_level = on_level;
    begin();
    build_index();
    refresh_quadrics();
    pass_levels();

    // The observer's weights of faces are relative to the area 1, those of the quadrics to that of the
    // diagonal.
    const double unit = relative_face_weight(1 / (m_diagonal * m_diagonal));
    const Cost costs(m_mesh, m_quadrics, m_targets, m_joint, m_poses, m_observer, m_options.uv_weight * unit,
                     m_options.normal_weight * unit);
    if (m_options.placement == Placement::optimal)
      run_passes(costs, Optimal_places(costs, m_rule, {&m_observer}));
    else
      run_passes(costs, Ends(costs, m_rule));
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

  template <class Places>
  void run_passes(const Cost& costs, const Places& places)
  {
    const auto run_passes = [&](auto run_pass) {
      bool is_promising = true;
      while (is_promising && !m_targets.is_reached() && !m_report.is_stopped) {
        Cancellation_scope::check();
        ++m_report.passes;
        is_promising = run_pass();
      }
    };
    // Of a smaller mesh, most lies in the cache in any order.
    const bool is_order_relaxed = num_edges(m_mesh) > std::size_t(1) << 17;
    if (m_options.loop == Collapse_loop::own) {
      run_passes([&] {
        const std::size_t collapses_before = m_report.collapses;
        selvedge::edge_collapse(m_mesh, is_over(),
                                parameters::expected_collapses(
                                    is_target_known() ? m_targets.total_excess() / 2 : 0,
                                    parameters::geometric_test(false, CGAL::parameters::get_cost(costs)
                                                                          .get_placement(places)
                                                                          .vertex_point_map(m_points)
                                                                          .use_relaxed_order(is_order_relaxed)
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
  // Without a target, the limits say where the reduction ends.
  bool is_target_known() const
  {
    return (m_options.ratio || m_options.faces) && m_levels.empty() && !m_options.is_progression_recorded &&
           !m_targets.has_several_shares();
  }

  // Says of every edge what holds it back, unless the reduction has reached its target or was stopped.
  template <class Places>
  void count_hindrances(const Places& places)
  {
    m_report.hindrances = {};
    if (!m_are_hindrances_counted || m_targets.is_reached() || m_report.is_stopped)
      return;
    Hindrances hindrances;
    const Geom_traits traits;
    if (m_intersection)
      m_intersection->visitor().OnStarted(m_mesh); // who asks the filter outside of a loop has to say so
    m_poses.on_started();
    auto should_stop = is_interrupted();
    Topology_test<TriangleMesh> topology;
    for (const Edge e : edges(m_mesh)) {
      const Halfedge h = halfedge(e, m_mesh);
      if (!m_targets.is_changeable(h))
        continue;
      const Lazy_edge_profile<TriangleMesh, VertexPointMap, Geom_traits> profile(h, m_mesh, m_points, traits);
      if (should_stop(0, profile, 0, 0))
        return;
      const Hindrance reason = hindrance(profile, places, topology.is_kept(profile, No_constrained_edges()));
      ++hindrances[reason];
      m_observer.on_hindered(e, reason);
    }
    m_report.hindrances = hindrances;
  }

  template <class Profile, class Places>
  Hindrance hindrance(const Profile& profile, const Places& places, bool is_topology_kept)
  {
    Hindrance weakest = Hindrance::frozen;
    for (const Halfedge moving : {profile.v0_v1(), profile.v1_v0()}) {
      const Line_refusal refusal = m_rule.refusal(moving);
      const Hindrance reason = refusal != Line_refusal::none ? hindrance_of_lines(moving, refusal)
                               : !is_topology_kept           ? Hindrance::topology
                               : m_joint.is_joint(source(moving, m_mesh))
                                   ? hindrance_of_joint(profile, moving)
                                   : hindrance_with_partner(profile, moving);
      weakest = (std::max)(weakest, reason);
    }
    if constexpr (std::is_same_v<Places, Optimal_places>)
      for (unsigned rank = 0; const auto choice = places.choice(profile, rank); ++rank)
        if (choice->at == Merged_at::between && is_topology_kept)
          weakest = (std::max)(weakest, hindrance(*places.collapse(profile, choice->at)));
    return weakest;
  }

  // A vertex that could go is held back by what holds its partner back.
  template <class Profile>
  Hindrance hindrance_with_partner(const Profile& profile, const Halfedge& moving)
  {
    const Hindrance reason = hindrance(Collapse<Profile>::along(profile, moving));
    if (reason != Hindrance::by_loop)
      return reason;
    if (m_observer.is_led(moving)) // before its companions are listed: each edge has one in every other place
      return Hindrance::companions;
    const std::vector<Halfedge> companions = m_observer.companions(moving);
    const bool can_go_elsewhere =
        companions.empty() ||
        (m_observer.are_companions_apart(moving, companions) &&
         all_of_companions(companions, [this](const auto& of_companion) {
           return m_rule.allows(of_companion) && hindrance(of_companion) == Hindrance::by_loop;
         }));
    if (!can_go_elsewhere)
      return Hindrance::companions;
    const auto motion = m_partners.partner_motion(moving);
    if (!motion)
      return reason;
    const Lazy_profile of_partner(*motion, m_mesh, m_points, m_traits);
    if (const Line_refusal refusal = m_rule.refusal(*motion); refusal != Line_refusal::none)
      return hindrance_of_lines(*motion, refusal);
    return m_topology.is_kept(of_partner, No_constrained_edges())
               ? hindrance(Collapse<Lazy_profile>::along(of_partner, *motion))
               : Hindrance::topology;
  }

  // Vertices that move together are held back by what holds one of them back, and then by contacts of all.
  template <class Profile>
  Hindrance hindrance_of_joint(const Profile& profile, const Halfedge& moving)
  {
    auto others = m_joint.others(moving);
    if (!others || !m_observer.keeps_joints(moving, *others))
      return Hindrance::non_manifold;
    m_others = *std::move(others);
    for (const Halfedge h : m_others) {
      if (const Line_refusal refusal = m_rule.refusal(h); refusal != Line_refusal::none)
        return hindrance_of_lines(h, refusal);
      const Lazy_profile of_other(h, m_mesh, m_points, m_traits);
      if (!m_topology.is_kept(of_other, No_constrained_edges()))
        return Hindrance::topology;
      const auto of_h = Collapse<Lazy_profile>::along(of_other, h);
      if (const Hindrance reason = hindrance_but_contacts(of_h); reason != Hindrance::by_loop)
        return reason;
    }
    return hindrance(Collapse<Profile>::along(profile, moving).with_others(m_others));
  }

  // Asks the filters in the order of their chain.
  template <class Profile>
  Hindrance hindrance_but_contacts(const Collapse<Profile>& collapse) const
  {
    if (!m_pieces.accepts(collapse))
      return Hindrance::topology;
    if (!m_border.accepts(collapse))
      return Hindrance::line_end;
    if (!m_target.accepts(collapse))
      return Hindrance::target;
    if (!m_aspect_ratio.accepts(collapse))
      return Hindrance::aspect_ratio;
    if (!m_normal_change.accepts(collapse))
      return Hindrance::normal_change;
    if (!m_uv.accepts(collapse))
      return Hindrance::uv;
    if (!m_error.accepts(collapse))
      return Hindrance::error;
    return Hindrance::by_loop;
  }
  template <class Profile>
  Hindrance hindrance(const Collapse<Profile>& collapse)
  {
    const Hindrance reason = hindrance_but_contacts(collapse);
    if (reason != Hindrance::by_loop)
      return reason;
    if (const auto in_pose =
            m_poses.hindrance(collapse, line_reason(edge(collapse.moving(), m_mesh)) == Hindrance::border))
      return *in_pose;
    if (!m_intersection)
      return reason;
    const auto refused_by_contact = [this] {
      const Intersection_statistics& statistics = m_intersection->statistics();
      return statistics.refused_by_star + statistics.refused_by_sweep + statistics.refused_by_descent;
    };
    const std::size_t before = refused_by_contact();
    if (m_intersection->accepts(collapse))
      return Hindrance::by_loop;
    if (m_intersection->is_clearance_lacking())
      return Hindrance::clearance;
    return refused_by_contact() > before ? Hindrance::intersection : Hindrance::topology;
  }

  // The lines that stay when those of some reasons are taken away.
  struct Stronger_lines
  {
    const Simplification* simplification;
    Hindrance weakest_gone;

    bool has(const Edge& e) const
    {
      return simplification->m_rule.is_line(e) && simplification->line_reason(e) < weakest_gone;
    }
    friend bool get(const Stronger_lines& lines, const Edge& e) { return lines.has(e); }
  };

  Hindrance line_reason(const Edge& e) const
  {
    const Halfedge h = halfedge(e, m_mesh);
    return CGAL::is_border(h, m_mesh) || CGAL::is_border(opposite(h, m_mesh), m_mesh)
               ? Hindrance::border
               : m_observer.line_reason(e);
  }

  // Of the kinds of lines, names the weakest without which, and without all weaker ones, the vertex could go.
  Hindrance hindrance_of_lines(const Halfedge& moving, Line_refusal refusal) const
  {
    switch (refusal) {
    case Line_refusal::locked:
      return m_observer.lock_reason(source(moving, m_mesh));
    case Line_refusal::turn:
      return line_reason(edge(moving, m_mesh)) == Hindrance::border ? Hindrance::border_turn
                                                                    : Hindrance::seam_turn;
    case Line_refusal::drift:
      return Hindrance::drift;
    default:
      break;
    }
    Hindrance reason = Hindrance::border;
    for (const Hindrance gone : {Hindrance::normals, Hindrance::texture, Hindrance::group, Hindrance::seam})
      if (m_rule.may_move_along(moving, Stronger_lines{this, gone})) {
        reason = gone;
        break;
      }
    return refusal == Line_refusal::off_line || reason == Hindrance::normals ? reason : Hindrance::line_end;
  }

  Selectable_index empty_index() const
  {
    Clustered_AABB_tree clustered(m_options.faces_per_cluster); // made in any case, so that 0 is refused
    return m_options.index == Face_index::packed ? Selectable_index(Packed_R_tree())
                                                 : Selectable_index(std::move(clustered));
  }

  struct Filter
  {
    Simplification* simplification;

    template <class Profile>
    bool allows(const Collapse<Profile>& collapse) const
    {
      return simplification->allows(collapse);
    }

    const std::vector<typename Intersection::Face>& blockers() const
    {
      static const std::vector<typename Intersection::Face> none;
      return simplification->m_blockers ? *simplification->m_blockers : none;
    }
  };

  // The stop predicate of either loop: the target is reached, or the caller wants to end.
  auto is_over()
  {
    return Any_stop(Function_stop([this](double cost) {
                      m_cost = cost;
                      return m_targets.is_reached();
                    }),
                    is_interrupted());
  }

  Hook_stop is_interrupted()
  {
    return Hook_stop([this](std::size_t) {
      const auto total = m_targets.total();
      if (m_options.should_stop)
        m_report.is_stopped = m_options.should_stop({m_report.faces_input, total.target, total.faces});
      else
        Cancellation_scope::check();
      return m_report.is_stopped;
    });
  }

  // Takes the place of the quadrics during collapses between which nobody asks for a cost.
  struct Accumulation
  {
    using Update_tag = CGAL::Tag_true;

    template <class Profile, class Vertex>
    void update_after_collapse(const Profile& profile, const Vertex& kept) const
    {
      quadrics.accumulate(profile, kept);
    }

    const Quadrics& quadrics;
  };

  struct Visitor : No_visitor
  {
    explicit Visitor(Simplification& simplification_) : simplification(&simplification_) {}

    void OnStarted(TriangleMesh& mesh)
    {
      if (simplification->m_intersection)
        simplification->m_intersection->visitor().OnStarted(mesh);
      simplification->m_poses.on_started();
    }
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
    template <class Profile, class Vertex>
    void OnCollapsed(const Profile&, const Vertex& kept)
    {
      simplification->after_collapse(kept);
    }

    // The loop does these motions next, without asking: they have been asked for together.
    std::vector<Halfedge> companions() const { return std::exchange(simplification->m_companions, {}); }

    // The loop tries this motion next, before the cheapest edge.
    std::optional<Halfedge> follow_up() const
    {
      return simplification->m_targets.is_reached() ? std::nullopt : simplification->m_partners.follow_up();
    }

    Simplification* simplification;
  };

  // Whether the partner of the vertex that moves, if it has one, may move along, as far as the mesh tells
  // before either does. Once one has moved, its partner is asked again, and may then be refused.
  template <class Profile>
  bool allows_partner(const Collapse<Profile>& collapse)
  {
    if (collapse.are_both_moved())
      return true;
    const auto motion = m_partners.partner_motion(collapse.moving());
    if (!motion)
      return true;
    const Lazy_profile profile(*motion, m_mesh, m_points, m_traits);
    if (!m_topology.is_kept(profile, No_constrained_edges()))
      return false;
    const auto of_partner = Collapse<Lazy_profile>::along(profile, *motion);
    return filters_allow(of_partner);
  }

  // Whether `is_allowed(collapse)` is true for all companions of a motion. Each is asked for in the mesh as
  // it is before any of them: as their stars lie in boxes without a common point, none changes what is asked
  // of another.
  template <class Predicate>
  bool all_of_companions(const std::vector<Halfedge>& companions, const Predicate& is_allowed)
  {
    return std::all_of(companions.begin(), companions.end(), [&](const Halfedge& moving) {
      const Lazy_profile profile(moving, m_mesh, m_points, m_traits);
      return m_topology.is_kept(profile, No_constrained_edges()) &&
             is_allowed(Collapse<Lazy_profile>::along(profile, moving));
    });
  }

  template <class Profile>
  bool allows_companions(const Collapse<Profile>& collapse)
  {
    if (!collapse.are_both_moved())
      m_companions = m_observer.companions(collapse.moving());
    if (m_companions.empty())
      return true;
    const bool are_apart = m_observer.are_companions_apart(collapse.moving(), m_companions);
    m_companions_too_near += !are_apart;
    if (are_apart && all_of_companions(m_companions, [this](const auto& of_companion) {
          return this->filters_allow(of_companion);
        }))
      return true;
    ++m_report.refused_elsewhere;
    m_companions.clear();
    return false;
  }

  // The cheap limits of all poses come before the exact test in any of them.
  template <class Profile>
  bool filters_allow(const Collapse<Profile>& collapse)
  {
    m_blockers = nullptr;
    if (!m_intersection)
      return m_error.allows(collapse) && m_poses.allows_shape(collapse);
    if (m_poses.empty()) {
      m_blockers = &m_intersection->blockers();
      const bool is_allowed = m_intersection->allows(collapse);
      m_refused_by_clearance += m_intersection->is_clearance_lacking();
      return is_allowed;
    }
    if (!m_error.allows(collapse) || !m_poses.allows_shape(collapse))
      return false;
    if (!m_intersection->accepts(collapse)) {
      ++m_refused_in_first_pose;
      m_refused_by_clearance += m_intersection->is_clearance_lacking();
      m_blockers = &m_intersection->blockers();
      return false;
    }
    if (m_poses.is_clear(collapse))
      return true;
    m_blockers = &m_poses.blockers();
    m_refused_by_clearance += m_poses.is_clearance_lacking();
    return false;
  }

  // Whether all rules but the exact test allow the collapses of the vertices that move together with the
  // mover, which it finds. The exact test is asked about all at once.
  template <class Profile>
  bool allows_others(const Collapse<Profile>& collapse)
  {
    m_others.clear();
    if (collapse.are_both_moved() || !m_joint.is_joint(collapse.mover()))
      return true;
    auto others = m_joint.others(collapse.moving());
    if (!others || !m_observer.keeps_joints(collapse.moving(), *others))
      return false;
    m_others = *std::move(others);
    for (const Halfedge h : m_others) {
      const Lazy_profile profile(h, m_mesh, m_points, m_traits);
      if (!m_topology.is_kept(profile, No_constrained_edges()) ||
          !m_error.allows(Collapse<Lazy_profile>::along(profile, h)))
        return false;
    }
    return true;
  }

  template <class Profile>
  bool allows(const Collapse<Profile>& collapse)
  {
    // The filters remember what they found of the last collapse of both ends that they accepted: so it is
    // asked after its partner. A collapse with companions moves one end.
    if (!allows_partner(collapse) || !allows_others(collapse) ||
        !filters_allow(collapse.with_others(m_others)) || !allows_companions(collapse)) {
      report_refusal(collapse.moving());
      return false;
    }
    m_is_mover_first = m_intersection && m_intersection->is_mover_first();
    m_motions_left = 1 + m_companions.size() + m_others.size();
    m_accepted += 1 + m_companions.size();
    return true;
  }

  template <class Profile>
  void before_collapse(const Collapse<Profile>& collapse)
  {
    if (collapse.are_both_moved()) {
      ++m_report.placed;
      ++m_report.collapses;
      m_observer.before_placement(collapse.moving(), collapse.place(), m_is_mover_first);
    } else if (m_others_left > 0) {
      m_observer.before_joint_collapse(collapse.moving(), m_rule);
      --m_others_left;
    } else {
      m_observer.before_collapse(collapse.moving(), m_rule);
      ++m_report.collapses;
      m_others_left = m_others.size();
    }
    m_joint.before_collapse(collapse.moving());
    m_targets.before_collapse(collapse.moving());
    m_partners.before_collapse(collapse.moving());
    m_tracked.before_collapse(collapse);
    m_rule.before_collapse(collapse);
    m_poses.before_collapse(collapse);
    if (m_intersection)
      m_intersection->visitor().before_collapse(collapse.with_others(m_others));
    if (!m_others.empty())
      m_companions = std::exchange(m_others, {});
  }

  template <class Vertex>
  void after_collapse(const Vertex& kept)
  {
    m_joint.after_collapse(kept);
    m_partners.after_collapse(kept);
    m_rule.after_collapse(kept);
    m_poses.after_collapse(kept);
    if (m_intersection)
      m_intersection->visitor().after_collapse(kept);
    if (m_motions_left > 0)
      --m_motions_left;
    if (m_motions_left == 0) { // no motion of several vertices is half done
      m_observer.after_step();
      pass_levels();
    }
  }

  // Reports the levels that have been reached. Each is a snapshot on which nothing that follows depends.
  void pass_levels()
  {
    while (m_next_level < m_levels.size() && m_targets.share(0).faces <= m_levels[m_next_level])
      pass_level();
  }
  void pass_level()
  {
    const std::size_t target = m_targets.share(0).target;
    m_targets.set_target(0, m_levels[m_next_level++]);
    m_on_level(report());
    m_targets.set_target(0, target);
  }

  template <class Halfedge>
  void report_refusal(const Halfedge& moving)
  {
    Refusals now = refusals();
    now.by_loop = 0; // it counts motions accepted before this one
    m_observer.on_refused(moving, now - m_refused_until_now);
    m_refused_until_now = now;
  }

  // The groups of vertices that may move together. CGAL's loop does one collapse at a time. A vertex with a
  // partner could not follow both. In several poses, no group is known to stay one in each.
  typename Joint::Groups joint_vertices(const Simplify_constraints<TriangleMesh>& constraints) const
  {
    if (m_options.loop != Collapse_loop::own || !m_options.check_intersections || !constraints.poses.empty())
      return {};
    boost::unordered_set<Vertex> has_partner;
    for (const auto& [a, b] : constraints.partners)
      has_partner.insert({a, b});
    typename Joint::Groups groups;
    for (const auto& group : constraints.joint_vertices)
      if (std::none_of(group.begin(), group.end(), [&](Vertex v) { return has_partner.count(v) > 0; }))
        groups.push_back(group);
    return groups;
  }

  std::vector<Vertex> locked_vertices(const Simplify_constraints<TriangleMesh>& constraints) const
  {
    std::vector<Vertex> locked = constraints.locked_vertices;
    for (const auto& group : constraints.joint_vertices)
      std::copy_if(group.begin(), group.end(), std::back_inserter(locked),
                   [this](Vertex v) { return !m_joint.is_joint(v); });
    return locked;
  }

  template <class Points>
  Border_rule<TriangleMesh, Points> make_rule(const Simplify_constraints<TriangleMesh>& constraints,
                                              const Points& points) const
  {
    Border_rule_options options;
    options.max_border_turn = m_options.max_border_turn;
    options.max_seam_turn = m_options.max_seam_turn;
    options.max_drift = m_options.max_border_drift * m_diagonal;
    Border_rule<TriangleMesh, Points> rule(m_mesh, points, options);
    for (const auto e : constraints.line_edges)
      rule.mark(e);
    for (const auto v : constraints.no_strip_vertices)
      rule.bound_no_strip(v);
    for (const auto v : locked_vertices(constraints))
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

  Targets make_targets(const Simplify_constraints<TriangleMesh>& constraints) const
  {
    Targets targets(m_mesh);
    for (const auto& [face, times] : constraints.multiplicities)
      targets.count_times(face, times);
    for (const auto& share : constraints.shares) {
      const std::size_t number = targets.add_share();
      for (const auto face : share.faces)
        targets.assign(face, number);
    }
    for (const auto face : constraints.uncounted_faces)
      targets.leave_out(face);
    targets.fix(locked_vertices(constraints));
    for (std::size_t i = 0; i < constraints.shares.size(); ++i)
      targets.set_target(i + 1, targets.share(i + 1).at_ratio(constraints.shares[i].ratio));
    const std::size_t by_ratio = m_options.ratio ? targets.share(0).at_ratio(*m_options.ratio) : 0;
    targets.set_target(0, (std::max)(m_options.faces.value_or(0), by_ratio));
    return targets;
  }

  CGAL::Bbox_3 bounding_box() const
  {
    CGAL::Bbox_3 box;
    for (const auto v : vertices(m_mesh)) {
      const CGAL::Bbox_3 of_point = get(m_points, v).bbox();
      for (int i = 0; i < 3; ++i)
        if (!std::isfinite(of_point.max(i)))
          throw Argument_error("a vertex of the mesh has a coordinate that is not finite");
      box += of_point;
    }
    return box;
  }

  double diagonal_of_box() const
  {
    const CGAL::Bbox_3 box = bounding_box();
    return box.xmin() <= box.xmax()
               ? std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin())
               : 0;
  }

  // Everything computed about quality is a sum of fewer than 2^40 products of at most four lengths, none
  // longer than the diagonal D = 2^d, and of factors that make less than 2^10, weights aside. The sum is less
  // than 2^(4d + 50) and does not overflow for d up to 200. For comparisons, the length of the normal of a
  // triangle, which is twice its area A, is squared; the square keeps all digits where 2A > 2^-500. With d at
  // least -200, that holds for all triangles with an area of more than 2^-100 D².
  double in_range(double diagonal) const
  {
    if (diagonal == 0 || (diagonal >= 0x1p-200 && diagonal <= 0x1p200))
      return diagonal;
    const CGAL::Bbox_3 box = bounding_box();
    std::ostringstream text;
    text
        << "the bounding box of the mesh, " << box << ", is too " << (diagonal < 1 ? "small" : "large")
        << ": its diagonal is to be from 2^-200 to 2^200, so that squares of areas are numbers; multiply all "
           "coordinates by a power of two, which loses no digit, and those of the result by its inverse";
    throw Argument_error(text.str());
  }

  Simplify_report report() const
  {
    Simplify_report report = m_report;
    const auto total = m_targets.total();
    report.faces_output = total.faces;
    report.faces_target = total.target;
    report.faces_to_go = m_targets.total_excess();
    report.refused = refusals();
    report.left_alone = m_partners.alone();
    for (std::size_t i = 0; i < m_poses.size(); ++i)
      report.refused_in_poses.push_back(m_poses.refused_in(i));
    report.seconds_reduce = seconds_since(m_start);
    if (m_intersection) {
      report.intersections = m_intersection->statistics();
      report.index = m_intersection->index().statistics();
    }
    return report;
  }

  static double seconds_since(Clock::time_point start)
  {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  Clock::time_point m_start;
  TriangleMesh& m_mesh;
  VertexPointMap m_points;
  const Simplify_options& m_options;
  Observer& m_observer;
  Geom_traits m_traits;
  Topology_test<TriangleMesh> m_topology;
  double m_diagonal;
  Joint m_joint;
  Rule m_rule;
  Targets m_targets;
  Quadrics m_quadrics;
  Border_partners<TriangleMesh> m_partners;
  Line m_line;
  Pieces m_pieces;
  Border m_border;
  Target m_target;
  Aspect_ratio m_aspect_ratio;
  Normal_change m_normal_change;
  Uv m_uv;
  Tracked_points<TriangleMesh> m_tracked;
  Error m_error;
  Poses m_poses;
  std::vector<std::pair<typename Intersection::Face, typename Intersection::Face>> m_offending_pairs;
  decltype(Simplify_constraints<TriangleMesh>::multiplicities) m_multiplicities;
  decltype(Simplify_constraints<TriangleMesh>::may_intersect) m_may_intersect;
  decltype(Simplify_constraints<TriangleMesh>::uncounted_faces) m_obstacle;
  std::optional<Intersection> m_intersection;
  Simplify_report m_report;
  std::size_t m_accepted = 0;
  std::vector<Halfedge> m_companions; // of the last collapse accepted, until the loop does them
  std::size_t m_motions_left = 0;     // it and they
  std::size_t m_companions_too_near = 0;
  std::vector<Halfedge> m_others; // of vertices that move together, those besides the one last asked about
  std::size_t m_others_left = 0;  // of the motion that has begun
  bool m_is_mover_first = false;  // of the last collapse accepted
  const std::vector<typename Intersection::Face>* m_blockers = nullptr; // of the last collapse refused
  std::size_t m_refused_in_first_pose = 0;
  std::size_t m_refused_by_clearance = 0; // in any pose
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
