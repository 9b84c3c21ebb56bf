// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/simplify.h>

#include "guarded_poses.h"
#include "reduce_in_cells.h"
#include "soup/Fitted_surface.h"
#include "soup/Vertex_values.h"
#include "soup/Working_mesh.h"
#include "soup/fit_attributes.h"
#include "soup/fit_normals.h"
#include "soup/fit_texture.h"
#include "soup/obstacle.h"
#include "soup/texture.h"
#include "soup/vertex_normals.h"
#include "soup/vertex_weights.h"
#include "verify/Diagonal.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/Surface_mesh_simplification/internal/Simplification.h>
#include <selvedge/internal/Stopwatch.h>

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace selvedge {
namespace {

// Returns, for each triangle of the original, whether it stays.
std::vector<char> frozen(const Prepared_soup& prepared, const Simplify_intent& intent)
{
  std::vector<char> is_frozen = prepared.is_frozen;
  for (const auto* names : {&intent.locked, &intent.kept})
    for (const std::string& name : *names) {
      const std::vector<char> is_named = triangles_named(prepared.soup, name);
      std::transform(
          is_named.begin(), is_named.end(), is_frozen.begin(), is_frozen.begin(),
          [](char named, char frozen) { return frozen || !named ? frozen : Working_mesh::by_wish; });
    }
  if (prepared.doubles() == 0 || intent.ratios.empty())
    return is_frozen;
  // A face counts for one target. Where its doubles belong to parts with other targets, it stays.
  std::vector<std::size_t> share_of(prepared.soup.triangles.size(), 0);
  for (std::size_t i = 0; i < intent.ratios.size(); ++i) {
    const std::vector<char> is_named = triangles_named(prepared.soup, intent.ratios[i].name);
    for (Index t = 0; t < is_named.size(); ++t)
      if (is_named[t])
        share_of[t] = i + 1;
  }
  for (Index t = 0; t < prepared.fronts.size(); ++t)
    if (const Index front = prepared.fronts[t]; share_of[t] != share_of[front] && is_frozen[front] == 0)
      is_frozen[front] = true;
  return is_frozen;
}

// Returns the normals of the original that those of a result come from.
const Corner_values<3>& normals_of(const Prepared_soup& prepared)
{
  return are_picked(prepared.normals) ? prepared.taken_normals : prepared.soup.normals;
}

// Finds the texture coordinates of vertices at new places, where they become others.
std::vector<std::optional<Vertex_values::Stored_uv>> fitted_uvs(const Fitted_surface& surface,
                                                                const Vertex_values& values,
                                                                const std::vector<Index_triple>& corners,
                                                                const std::vector<char>& is_placed)
{
  using Coordinates = std::array<double, 2>;
  const Triangle_soup& result = surface.result();
  std::vector<char> is_free(result.points.size(), false);
  std::vector<Index> corner_of(result.points.size()); // of the original, by free vertex
  std::vector<Coordinates> before(result.points.size());
  for (Index i = 0; i < result.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (const Index v = result.triangles[i][k]; is_placed[v] && result.uvs.has(i)) {
        is_free[v] = true;
        corner_of[v] = corners[i][k];
        before[v] = result.uvs.values[result.uvs.of_triangle[i][k]];
      }
  std::vector<std::optional<Vertex_values::Stored_uv>> last(result.points.size());
  const std::vector<Coordinates> fitted =
      fitted_texture(surface, is_free, [&](Index v, const Coordinates& uv) {
        last[v] = values.stored_uv(corner_of[v], uv);
        return last[v]->uv;
      });
  for (Index v = 0; v < fitted.size(); ++v)
    if (!is_free[v] || fitted[v] == before[v])
      last[v].reset();
  return last;
}

// Fits what vertices at new places have, but for normals.
void fit_new_places(const Fitted_surface& surface, Simplified_soup& result)
{
  const Vertex_values values(surface.original());
  Vertex_values::Fitted fitted;
  if (!result.soup.uvs.empty())
    fitted.uvs = fitted_uvs(surface, values, result.corners, result.is_placed);
  fitted.values = fitted_attributes(surface, values, result.is_placed);
  result.fitted_texture = std::size_t(
      std::count_if(fitted.uvs.begin(), fitted.uvs.end(), [](const auto& uv) { return uv.has_value(); }));
  for (std::size_t v = 0; v < result.soup.points.size(); ++v)
    result.fitted_attributes += std::any_of(fitted.values.begin(), fitted.values.end(),
                                            [&](const auto& of_vertex) { return !std::isnan(of_vertex[v]); });
  if (result.fitted_texture + result.fitted_attributes > 0)
    values.put(fitted, result.soup);
}

/// One reduction of a soup, which can be looked at on its way.
class Soup_reduction
{
public:
  Soup_reduction(const Prepared_soup& prepared, const Simplify_options& options,
                 const Simplify_intent& intent)
      : m_options(scaled(options, prepared.scale)), m_clearance(options.clearance), m_prepared(prepared),
        m_intent(intent), m_working(prepared.soup, prepared.positions, frozen(prepared, intent),
                                    prepared.obstacle, prepared.scale, prepared.is_turned, prepared.fronts),
        m_seconds_sew(m_stopwatch.seconds()),
        m_simplification(std::in_place, m_working.mesh(), m_options, set_up(intent), m_working)
  {
  }

  Simplified_soup run()
  {
    if (m_options.faces_per_cell > 0)
      run_in_cells();
    else
      begin();
    const Simplify_report report = m_simplification->run();
    // The result needs only a part of what the reduction has needed, and is made in the room that this
    // leaves.
    m_simplification.reset();
    m_working.forget_wedges();
    return state(report);
  }

  /// Returns the states in which runs to some ratios would end. `ratios` are in descending order.
  std::vector<Simplified_soup> run(const std::vector<double>& ratios)
  {
    std::vector<Simplified_soup> levels;
    begin();
    m_simplification->run(ratios, [&](const Simplify_report& report) { levels.push_back(state(report)); });
    return levels;
  }

private:
  static Simplify_options scaled(Simplify_options options, const Scale& scale)
  {
    if (!options.clearance || !std::isfinite(*options.clearance))
      return options; // refused where it is taken
    const double clearance = *options.clearance;
    options.clearance = scale(clearance);
    if (scale.undone(*options.clearance) != clearance)
      throw Argument_error(
          "the clearance is so small beside the coordinates that it is no number at their scale; "
          "leave it out, since nothing touches anyway");
    return options;
  }

  // Tells the working mesh what to hold, to measure and to record, and returns its constraints.
  const Simplify_constraints<Working_mesh::Mesh>& set_up(const Simplify_intent& intent)
  {
    const Triangle_soup& soup = m_prepared.soup;
    auto& constraints = m_working.constraints();
    m_working.lock_by_wish(intent.locked_vertices, m_prepared.positions);
    const auto faces_named = [&](const std::string& name) {
      const std::vector<char> is_named = triangles_named(soup, name);
      std::vector<Working_mesh::Face> faces;
      for (const Working_mesh::Face face : m_working.mesh().faces())
        if (m_working.is_own(face) && is_named[m_working.front(face)])
          faces.push_back(face);
      return faces;
    };
    const auto add_share = [&](const std::string& name, double ratio) {
      constraints.shares.push_back({faces_named(name), ratio});
    };
    for (const Simplify_intent::Part_ratio& part : intent.ratios)
      add_share(part.name, part.ratio);
    for (const std::string& name : intent.kept)
      add_share(name, 1);
    if (m_prepared.defects == Defects::descend)
      constraints.offending_pairs = pairs_of_faces(m_prepared.offending_pairs);
    for (const auto& [a, b] : m_prepared.may_intersect)
      constraints.may_intersect.emplace_back(faces_named(a), faces_named(b));
    if (m_options.loop == Collapse_loop::own)
      hold_gaps(constraints);
    pose(constraints);
    if (m_options.instances == Instances::shared && m_options.loop == Collapse_loop::own) {
      if (soup.poses.empty())
        share();
      else // in which the places of a mesh may move in other ways
        m_apart_meshes =
            shared_meshes(soup, std::vector<Apart>(soup.triangles.size(), Apart::no)).meshes.size();
    }
    if (!intent.weights.empty())
      m_working.weigh(vertex_weights(soup, intent.weights));
    if (m_options.placement == Placement::optimal)
      m_working.allow_new_places(m_prepared.is_float32);
    if (m_options.uv_weight > 0)
      m_working.measure_uvs(uv_unit(soup, m_prepared.scale));
    if (m_options.normal_weight > 0)
      measure_normals();
    m_working.count_refusals();
    if (m_options.is_progression_recorded)
      m_working.record_progression(m_progression);
    const bool may_pairs_descend = m_prepared.may_pairs_descend();
    if (!may_pairs_descend && !m_options.is_history_kept)
      m_working.on_collapse(m_options.on_collapse);
    else
      m_working.on_collapse([this, may_pairs_descend](const Soup_collapse& collapse) {
        if (may_pairs_descend)
          m_collapses.push_back(collapse);
        if (m_options.is_history_kept)
          add_to_history();
        if (m_options.on_collapse)
          m_options.on_collapse(collapse);
      });
    return constraints;
  }

  void measure_normals()
  {
    const Triangle_soup& soup = m_prepared.soup;
    if (are_kept(m_prepared.normals) && !soup.normals.empty() && !soup.normals.missing) {
      m_working.measure_normals(normal_unit(soup, m_prepared.scale));
    } else if (m_prepared.normals != Normals_treatment::flat &&
               soup.triangles.size() <= Simplify_options::most_faces_shaded) {
      const auto normals = std::make_shared<const Vertex_normals>(
          vertex_normals(soup, m_prepared.positions, m_prepared.is_turned, m_prepared.fronts));
      constexpr double widest =
          0.03; // Of the diagonal. The shading of a smooth shape follows from its places.
      m_working.measure_normals(std::min(normal_unit(soup, m_prepared.scale, normals.get()),
                                         widest * m_prepared.scale(internal::Diagonal(soup).length())),
                                normals);
    }
  }

  // Returns the pairs of faces in the working mesh, which has none for doubles.
  std::vector<std::pair<Working_mesh::Face, Working_mesh::Face>>
  pairs_of_faces(const std::vector<Offending_pair>& pairs) const
  {
    std::vector<std::pair<Working_mesh::Face, Working_mesh::Face>> result;
    if (pairs.empty())
      return result;
    const std::vector<Working_mesh::Face> face_of = m_working.faces_of_triangles();
    for (const Offending_pair& pair : pairs) {
      const auto a = face_of[pair.first], b = face_of[pair.second];
      if (a != Working_mesh::Mesh::null_face() && b != Working_mesh::Mesh::null_face())
        result.emplace_back(a, b);
    }
    return result;
  }

  void add_to_history()
  {
    Refusals refused = m_simplification->refusals();
    refused.by_loop = 0; // it counts this collapse
    m_history.add(m_simplification->cost() / (m_simplification->diagonal() * m_simplification->diagonal()),
                  refused);
  }

  // Where a mesh has doubles in one place, and not in all, or shares them with something else, it is reduced
  // apart, too.
  void set_apart_by_doubles(const std::vector<Shared_mesh>& meshes, Apart how,
                            std::vector<Apart>& apart) const
  {
    constexpr Index s_no_mesh = Index(-1);
    struct Row
    {
      Index mesh = s_no_mesh, place = 0, row = 0;
    };
    std::vector<Row> rows(m_prepared.fronts.size()); // by triangle
    for (Index m = 0; m < meshes.size(); ++m)
      for (Index p = 0; p < meshes[m].places.size(); ++p)
        for (Index row = 0; row < meshes[m].places[p].triangles.size(); ++row)
          rows[meshes[m].places[p].triangles[row]] = {m, p, row};
    const auto is_alike_in_first_place = [&](const Row& here, const Row& front) {
      return here.mesh == s_no_mesh ||
             rows[m_prepared.fronts[meshes[here.mesh].places.front().triangles[here.row]]].row == front.row;
    };
    std::vector<char> is_mesh_apart(meshes.size(), false);
    for (Index t = 0; t < rows.size(); ++t) {
      const Row &here = rows[t], &front = rows[m_prepared.fronts[t]];
      if (here.mesh == front.mesh && here.place == front.place && is_alike_in_first_place(here, front))
        continue;
      for (const Index mesh : {here.mesh, front.mesh})
        if (mesh != s_no_mesh)
          is_mesh_apart[mesh] = true;
    }
    for (Index t = 0; t < rows.size(); ++t)
      if (rows[t].mesh != s_no_mesh && is_mesh_apart[rows[t].mesh])
        apart[t] = how;
  }

  void share()
  {
    // Where gaps are closed, those that stay open may differ between the places of a mesh. Gaps that are only
    // held do not set places apart, and are not held in shared meshes.
    std::vector<char> is_tied(m_prepared.soup.points.size(), false); // by position
    if (m_prepared.snapping.distance > 0)
      for (const auto& [a, b] : m_prepared.tied)
        is_tied[a] = is_tied[b] = true;
    std::vector<Apart> apart;
    for (const Index_triple& triangle : m_prepared.soup.triangles)
      apart.push_back(std::any_of(triangle.begin(), triangle.end(),
                                  [&](Index v) { return is_tied[m_prepared.positions[v]] != 0; })
                          ? Apart::from_all
                          : Apart::no);
    Shared_meshes shared = shared_meshes(m_prepared.soup, apart);
    if (m_prepared.doubles() > 0)
      for (const Apart how : {Apart::from_other_meshes, Apart::from_all}) {
        set_apart_by_doubles(shared.meshes, how, apart);
        shared = shared_meshes(m_prepared.soup, apart);
      }
    m_shared_meshes = shared.meshes.size();
    m_apart_meshes = shared.apart;
    for (const Shared_mesh& mesh : shared.meshes)
      m_shared_places += mesh.places.size();
    m_working.share(std::move(shared.meshes), m_options.clearance.value_or(0));

    const auto is_shared = [&](Working_mesh::Mesh::Vertex_index v) {
      const auto faces = m_working.mesh().faces_around_target(m_working.mesh().halfedge(v));
      return std::any_of(faces.begin(), faces.end(), [&](auto f) {
        return f != Working_mesh::Mesh::null_face() && m_working.is_shared(f);
      });
    };
    auto& partners = m_working.constraints().partners;
    const std::size_t tied = partners.size();
    partners.erase(
        std::remove_if(partners.begin(), partners.end(),
                       [&](const auto& pair) { return is_shared(pair.first) || is_shared(pair.second); }),
        partners.end());
    m_untied_pairs = tied - partners.size();
  }

  void hold_gaps(Simplify_constraints<Working_mesh::Mesh>& constraints)
  {
    if (m_prepared.tied.empty() && m_prepared.facing.empty())
      return;
    const std::vector<Index> of_soup = m_working.vertices_of_soup(m_prepared.obstacle);
    std::vector<Working_mesh::Mesh::Vertex_index> vertices(m_prepared.positions.size()); // by position
    for (const auto v : m_working.mesh().vertices())
      if (of_soup[v] < m_prepared.soup.points.size()) // an obstacle may have a vertex there, too
        vertices[m_prepared.positions[of_soup[v]]] = v;
    for (const auto& [a, b] : m_prepared.tied)
      constraints.partners.emplace_back(vertices[a], vertices[b]);
    for (const Index position : m_prepared.facing)
      constraints.facing_vertices.push_back(vertices[position]);
  }

  // Puts the mesh into the further poses of the soup that are guarded.
  void pose(Simplify_constraints<Working_mesh::Mesh>& constraints)
  {
    const Triangle_soup& soup = m_prepared.soup;
    if (soup.poses.empty())
      return;
    const std::vector<Index> of_soup = m_working.vertices_of_soup(m_prepared.obstacle);
    auto& mesh = m_working.mesh();
    const std::size_t own_vertices = soup.points.size();
    for (const std::size_t i : guarded_poses(soup, m_options)) {
      auto& pose = constraints.poses.emplace_back();
      pose.points = get(CGAL::dynamic_vertex_property_t<Point_3>(), mesh);
      const std::vector<Point_3>& beside = points_in_pose(m_prepared.obstacle, i);
      for (const auto v : mesh.vertices())
        put(pose.points, v,
            m_prepared.scale(of_soup[v] < own_vertices ? soup.poses[i].points[of_soup[v]]
                                                       : beside[of_soup[v] - own_vertices]));
      if (m_prepared.defects == Defects::descend)
        pose.offending_pairs = pairs_of_faces(m_prepared.offending_pairs_in_poses[i]);
    }
  }

  // Does at once what only reads the mesh. What is repeated needs nothing of it.
  void begin()
  {
    if (m_options.repeated)
      return;
    tbb::parallel_invoke(Cancellation_scope::inherited([this] { m_simplification->build_index(); }),
                         Cancellation_scope::inherited([this] { m_simplification->begin(); }),
                         Cancellation_scope::inherited([this] { m_working.find_wedges(); }));
  }

  // Finds collapses in cells, and does them to the whole mesh, which then knows as much of them as of its own
  // collapses. The reduction that follows also collapses where cells meet, and evens out differences between
  // them.
  void run_in_cells()
  {
    const internal::Stopwatch stopwatch;
    const auto total = m_simplification->targets().total();
    const std::size_t movable =
        m_working.mesh().number_of_vertices() - m_working.constraints().locked_vertices.size();
    if (movable == 0)
      return;
    const double faces_per_collapse = 2.0 * double(total.faces) / double(m_working.face_count());
    const double share = double(total.excess) / (faces_per_collapse * double(movable));
    Cell_collapses found;
    tbb::parallel_invoke(Cancellation_scope::inherited([&] {
                           found = reduce_in_cells({m_prepared,
                                                    m_working,
                                                    m_simplification->rule(),
                                                    m_options,
                                                    m_simplification->diagonal(),
                                                    {total.faces, total.target, total.faces},
                                                    share});
                         }),
                         Cancellation_scope::inherited([this] { m_simplification->begin(); }),
                         Cancellation_scope::inherited([this] { m_working.find_wedges(); }));
    m_cells = found.cells;
    m_is_stopped_in_cells = found.is_stopped;
    std::size_t collapses = 0;
    for (const std::vector<Cell_collapse>& of_cell : found.collapses)
      collapses += of_cell.size();
    const std::size_t faces_left =
        total.faces - std::min(total.faces, std::size_t(faces_per_collapse * double(collapses)));
    // What one cell does is near in memory, so they are done one after the other.
    for (const std::vector<Cell_collapse>& of_cell : found.collapses)
      for (const auto& [collapse, cost] : of_cell) {
        // Small cells may together go too far, each by its last face.
        if (m_simplification->targets().is_reached())
          break;
        // When somebody wants to stop, all that the cells have reached is done without another question, so
        // that the result is even.
        constexpr std::size_t collapses_between_questions = 4096;
        if (m_collapses_in_cells % collapses_between_questions == 0) {
          if (!m_options.should_stop)
            Cancellation_scope::check();
          else if (!m_is_stopped_in_cells)
            m_is_stopped_in_cells = m_options.should_stop({total.faces, total.target, faces_left});
        }
        m_simplification->collapse(m_working.halfedge(collapse.moving), collapse.place,
                                   collapse.is_mover_first, cost);
        ++m_collapses_in_cells;
      }
    if (m_is_stopped_in_cells)
      m_options.should_stop = [](const Simplify_progress&) { return true; };
    m_seconds_cells = stopwatch.seconds();
    tbb::parallel_invoke(Cancellation_scope::inherited([this] { m_simplification->build_index(); }),
                         Cancellation_scope::inherited([this] { m_simplification->refresh_quadrics(); }));
  }

  Simplified_soup state(const Simplify_report& report) const
  {
    const internal::Stopwatch stopwatch;
    Simplified_soup result;
    Working_mesh::Result left = m_working.result();
    result.soup = std::move(left.soup);
    result.triangles = std::move(left.triangles);
    restore_normals(result.soup, m_prepared.normals);
    const Triangle_soup& original = m_prepared.soup;
    const Corner_values<3>& taken = m_prepared.taken_normals;
    if (m_prepared.normals == Normals_treatment::flat && !taken.empty())
      keep_flat_normals(result.soup, result.triangles, original, taken);
    const Corner_values<3>& normals = normals_of(m_prepared);
    if (are_picked(m_prepared.normals))
      pick_normals(result.soup, result.triangles, left.corners, original, normals);
    if (m_prepared.normals == Normals_treatment::mended || are_fitted(m_prepared.normals))
      result.mended_normals = mend_normals(result.soup, result.triangles, original, normals);
    result.corners = std::move(left.corners);
    result.is_placed = std::move(left.is_placed);
    result.placed_vertices = std::size_t(std::count(result.is_placed.begin(), result.is_placed.end(), true));
    if (m_options.are_values_fitted)
      fit_values(result, m_prepared, m_intent);
    if (report.hindrances.total() > 0)
      result.held_by = std::move(left.held_by);
    result.collapses = m_collapses;
    result.progression = m_progression;
    result.history = m_history;
    result.history.finish(report.refused);
    result.clearance = m_clearance;
    result.shared_meshes = m_shared_meshes;
    result.shared_places = m_shared_places;
    result.apart_meshes = m_apart_meshes;
    result.untied_pairs = m_untied_pairs;
    result.sewing = m_working.notes();
    result.report = report;
    // When the cells have reached the target, nothing was left for the run to be stopped in.
    result.report.is_stopped = report.is_stopped || m_is_stopped_in_cells;
    result.report.cells = m_cells;
    result.report.collapses_in_cells = m_collapses_in_cells;
    result.report.seconds_cells = m_seconds_cells;
    result.refused_by_part = m_working.refused_by_part();
    result.seconds_sew = m_seconds_sew + stopwatch.seconds();
    return result;
  }

  Simplify_options m_options;
  std::optional<double> m_clearance; // in the unit of the soup
  const Prepared_soup& m_prepared;
  const Simplify_intent& m_intent;
  internal::Stopwatch m_stopwatch;
  Working_mesh m_working;
  double m_seconds_sew;
  std::size_t m_shared_meshes = 0, m_shared_places = 0, m_apart_meshes = 0, m_untied_pairs = 0;
  std::vector<Soup_collapse> m_collapses; // if they are needed to judge the result
  Progression m_progression;              // if it is recorded
  Reduction_history m_history;
  std::optional<internal::Simplification<Working_mesh::Mesh, Working_mesh>> m_simplification; // until it ends
  bool m_is_stopped_in_cells = false;
  std::size_t m_cells = 0;
  std::size_t m_collapses_in_cells = 0;
  double m_seconds_cells = 0;
};

void check(const Prepared_soup& prepared, const Simplify_options& options, const Simplify_intent& intent)
{
  if (options.faces_per_cell > 0 && !intent.ratios.empty())
    throw Argument_error("in cells no part can have a ratio of its own; leave out one of the two options");
  if (options.is_progression_recorded && options.placement == Placement::optimal)
    throw Argument_error(
        "a collapse to a new place makes a new vertex, and a progression has none; let vertices "
        "go to others, or record no progression");
  if (options.faces_per_cell > 0 && !prepared.soup.poses.empty())
    throw Argument_error("a mesh in several poses is not reduced in cells; leave out one of the two options");
  if (options.guarded_poses)
    for (const std::size_t pose : *options.guarded_poses)
      if (pose >= prepared.soup.poses.size())
        throw Argument_error("the mesh has no further pose " + std::to_string(pose) +
                             " that could be guarded; it has " + std::to_string(prepared.soup.poses.size()));
  if (options.clearance && options.faces_per_cell > 0)
    throw Argument_error("in cells no clearance is kept between pieces; leave out one of the two options");
  if (options.clearance && !prepared.may_intersect.empty())
    throw Argument_error("parts that may intersect have no clearance; leave out one of the two options");
  if (options.faces_per_cell > 0 && !prepared.may_intersect.empty())
    throw Argument_error("in cells no parts may intersect each other; leave out one of the two options");
}

} // namespace

void keep_from_snapping(Prepare_options& options, const Simplify_intent& intent)
{
  for (const auto* names : {&intent.locked, &intent.kept})
    options.parts_that_stay.insert(options.parts_that_stay.end(), names->begin(), names->end());
  options.vertices_that_stay.insert(options.vertices_that_stay.end(), intent.locked_vertices.begin(),
                                    intent.locked_vertices.end());
}

Simplified_soup simplify_soup(const Prepared_soup& prepared, const Simplify_options& options,
                              const Simplify_intent& intent)
{
  check(prepared, options, intent);
  return Soup_reduction(prepared, options, intent).run();
}

void fit_values(Simplified_soup& result, const Prepared_soup& prepared, const Simplify_intent& intent)
{
  const bool has_new_places = !result.is_placed.empty();
  if (!has_new_places && !are_fitted(prepared.normals))
    return;
  const Fitted_surface surface(result.soup, result.triangles, result.corners, prepared.soup,
                               prepared.positions);
  if (has_new_places)
    fit_new_places(surface, result);
  if (are_fitted(prepared.normals))
    result.fitted_normals =
        fit_normals(surface, normals_of(prepared), frozen(prepared, intent), result.soup.normals);
}

namespace {

// Whether levels of detail are states of one reduction, so that each does not need its own.
bool are_of_one_reduction(const Simplify_options& options, const Simplify_intent& intent)
{
  return intent.ratios.empty() && options.faces_per_cell == 0;
}

} // namespace

std::vector<Simplified_soup> simplify_lods(const Prepared_soup& prepared, const Simplify_options& options,
                                           const std::vector<double>& ratios, const Simplify_intent& intent)
{
  if (options.faces)
    throw Argument_error("levels of detail are ratios; leave out the number of faces");
  check(prepared, options, intent);
  std::vector<Simplified_soup> levels(ratios.size());
  Simplify_options to_level = options;
  if (!are_of_one_reduction(options, intent)) {
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      to_level.ratio = ratios[i];
      levels[i] = simplify_soup(prepared, to_level, intent);
      if (levels[i].report.is_stopped) {
        std::fill(levels.begin() + std::ptrdiff_t(i) + 1, levels.end(), levels[i]);
        break;
      }
    }
    return levels;
  }
  std::vector<std::size_t> order(ratios.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return ratios[i] > ratios[j]; });
  std::vector<double> descending;
  for (const std::size_t i : order)
    descending.push_back(ratios[i]);
  if (descending.empty())
    return levels;
  to_level.ratio = descending.back();
  std::vector<Simplified_soup> states = Soup_reduction(prepared, to_level, intent).run(descending);
  for (std::size_t i = 0; i < order.size(); ++i)
    levels[order[i]] = std::move(states[i]);
  return levels;
}

// The levels after one that was stopped are the same as that.
std::vector<Collapses_of_level> collapses_of_levels(const std::vector<const Simplified_soup*>& levels,
                                                    const Simplify_options& options,
                                                    const Simplify_intent& intent)
{
  std::size_t most = 0;
  for (const Simplified_soup* level : levels)
    most = std::max(most, level->report.collapses);
  const bool is_one = are_of_one_reduction(options, intent);
  std::vector<Collapses_of_level> result;
  std::size_t reduction = 0, first = 0;
  for (const Simplified_soup* level : levels) {
    const std::size_t count = level->report.collapses;
    result.push_back({reduction, first, count, is_one ? most : count});
    if (!is_one && !level->report.is_stopped) {
      ++reduction;
      first += count;
    }
  }
  return result;
}

Verification verify(const Simplified_soup& result, const Prepared_soup& original)
{
  Verify_options options;
  options.are_shapes_judged = false; // limits take care of shapes, or the user wants none
  options.may_be_rounded = false;    // `prepare` has rounded the original where that was asked for
  options.triangles_of_original = result.triangles;
  if (original.defects == Defects::descend)
    options.collapses = &result.collapses;
  options.may_intersect = original.may_intersect;
  options.clearance = result.clearance;
  options.pairs_in_poses_of_original = &original.offending_pairs_in_poses;
  Verification verification =
      verify(result.soup, original.soup, original.offending_pairs, options, original.obstacle);
  for (std::size_t k = 0; k < verification.permitted.size(); ++k)
    verification.permitted[k].pairs_of_original = original.permitted_pairs[k];
  return verification;
}

} // namespace selvedge
