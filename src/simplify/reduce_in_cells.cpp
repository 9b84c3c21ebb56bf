// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reduce_in_cells.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Surface_mesh_simplification/internal/Simplification.h>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/partitioner.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <iterator>
#include <limits>
#include <mutex>
#include <numeric>
#include <utility>

namespace selvedge {
namespace {

constexpr double s_infinity = std::numeric_limits<double>::infinity();

/// An open box, which may be unbounded, in coordinates divided by the scale.
struct Box
{
  std::array<double, 3> low{-s_infinity, -s_infinity, -s_infinity};
  std::array<double, 3> high{s_infinity, s_infinity, s_infinity};

  bool contains(const Point_3& p) const
  {
    for (int i = 0; i < 3; ++i)
      if (!(low[i] < p[i] && p[i] < high[i]))
        return false;
    return true;
  }
};

/// Asks `should_stop` of the options on behalf of all cells.
class Shared_stop
{
public:
  explicit Shared_stop(const Cell_context& whole)
      : m_should_stop(whole.options.should_stop), m_progress(whole.progress)
  {
  }

  /// Counts `gone` further faces as collapsed, and returns whether to stop. Once the answer was yes, nobody
  /// is asked again.
  bool ask(std::size_t gone = 0)
  {
    if (!m_should_stop) {
      Cancellation_scope::check();
      return false;
    }
    const std::lock_guard lock(m_mutex);
    m_progress.faces -= std::min(m_progress.faces, gone);
    return m_is_stopped = m_is_stopped || m_should_stop(m_progress);
  }

  bool is_stopped() const { return m_is_stopped; }

  /// Returns the `should_stop` of one cell.
  std::function<bool(const Simplify_progress&)> of_cell()
  {
    return [this, told = std::size_t(0)](const Simplify_progress& of_cell) mutable {
      const std::size_t gone = of_cell.faces_input - of_cell.faces;
      return ask(gone - std::exchange(told, gone));
    };
  }

private:
  const std::function<bool(const Simplify_progress&)>& m_should_stop;
  std::mutex m_mutex;
  Simplify_progress m_progress;
  std::atomic<bool> m_is_stopped = false;
};

/// A box, and all faces whose bounding boxes meet its closure, in ascending order.
struct Cell
{
  Box box;
  std::vector<Index> faces;
};

/// Divides space into cells at medians of vertices, unless it is stopped. Each division at least halves the
/// number of vertices of a box.
class Division
{
public:
  Division(const Cell_context& whole, Shared_stop& stop)
      : m_soup(whole.prepared.soup), m_mesh(whole.working.mesh()), m_scale(whole.prepared.scale),
        m_vertices_per_cell(whole.options.faces_per_cell / 2 + whole.options.faces_per_cell % 2), m_stop(stop)
  {
    std::vector<Index> vertices;
    for (Index v = 0; v < m_soup.points.size(); ++v)
      if (whole.prepared.positions[v] == v)
        vertices.push_back(v);
    std::vector<Index> faces(m_mesh.number_of_faces());
    std::iota(faces.begin(), faces.end(), Index(0));
    m_cells = divide({}, vertices.begin(), vertices.end(), std::move(faces));
  }

  std::vector<Cell> take() { return std::move(m_cells); }

private:
  using Iterator = std::vector<Index>::iterator;

  std::vector<Cell> divide(const Box& box, Iterator first, Iterator beyond, std::vector<Index> faces)
  {
    std::vector<Cell> cells;
    const std::size_t count = beyond - first;
    if (count <= m_vertices_per_cell) {
      if (count > 0)
        cells.push_back({box, std::move(faces)});
      return cells;
    }
    if (m_stop.ask())
      return cells;
    const int axis = longest_axis(first, beyond);
    const auto coordinate = [&](Index v) { return m_scale(m_soup.points[v][axis]); };
    const Iterator middle = first + count / 2;
    std::nth_element(first, middle, beyond, [&](Index a, Index b) { return coordinate(a) < coordinate(b); });
    const double plane = coordinate(*middle);
    // Vertices in the plane are in no cell.
    const Iterator first_part = std::partition(first, middle, [&](Index v) { return coordinate(v) < plane; });
    const Iterator second_part =
        std::partition(middle, beyond, [&](Index v) { return !(coordinate(v) > plane); });

    Box below = box, above = box;
    below.high[axis] = above.low[axis] = plane;
    std::vector<Index> faces_below, faces_above;
    for (const Index face : faces) {
      const auto [low, high] = extent(face, axis);
      if (low <= plane)
        faces_below.push_back(face);
      if (high >= plane)
        faces_above.push_back(face);
    }
    faces = {};
    std::vector<Cell> cells_above;
    tbb::parallel_invoke(Cancellation_scope::inherited(
                             [&] { cells = divide(below, first, first_part, std::move(faces_below)); }),
                         Cancellation_scope::inherited([&] {
                           cells_above = divide(above, second_part, beyond, std::move(faces_above));
                         }));
    std::move(cells_above.begin(), cells_above.end(), std::back_inserter(cells));
    return cells;
  }

  int longest_axis(Iterator first, Iterator beyond) const
  {
    CGAL::Bbox_3 box;
    for (Iterator v = first; v != beyond; ++v)
      box += m_scale(m_soup.points[*v]).bbox();
    int longest = 0;
    for (int i = 1; i < 3; ++i)
      if (box.max(i) - box.min(i) > box.max(longest) - box.min(longest))
        longest = i;
    return longest;
  }

  std::pair<double, double> extent(Index face, int axis) const
  {
    const auto h = m_mesh.halfedge(Working_mesh::Face(face));
    const auto coordinate = [&](auto v) { return m_mesh.point(v)[axis]; };
    return std::minmax({coordinate(m_mesh.source(h)), coordinate(m_mesh.target(h)),
                        coordinate(m_mesh.target(m_mesh.next(h)))});
  }

  const Triangle_soup& m_soup;
  const Working_mesh::Mesh& m_mesh;
  const Scale& m_scale;
  std::size_t m_vertices_per_cell;
  Shared_stop& m_stop;
  std::vector<Cell> m_cells;
};

/// Returns which share of its movable vertices a cell collapses: more than of all, since there are to be more
/// collapses where they cost less than elsewhere. A share is above 1 where the target cannot be reached.
double share_of_cell(double share)
{
  return share * (1 + 0.3 * std::max(0.0, 1 - share));
}

/// Returns which share of their movable vertices all cells collapse together. The rest is for the reduction
/// of the whole, which distributes its collapses better.
double share_of_cells(double share)
{
  return 0.95 * share;
}

/// Returns for every face whether its vertices move in no cell, because no cell sees all that it must know.
/// Frozen faces stay anyway.
std::vector<char> faces_that_stay(const Cell_context& whole)
{
  const Prepared_soup& prepared = whole.prepared;
  const Working_mesh::Mesh& mesh = whole.working.mesh();
  std::vector<char> stays(mesh.number_of_faces(), false);
  // Faces that offend with others: only the reduction of the whole makes descendants of them. A double
  // offends with its front alone, wherever the two go, or else its front offends as well.
  for (const auto& [a, b] : whole.working.constraints().offending_pairs)
    stays[a] = stays[b] = true;
  // Vertices that move together: all at a position, of which a cell may have some.
  for (const auto& group : whole.working.constraints().joint_vertices)
    for (const auto v : group)
      for (const auto f : mesh.faces_around_target(mesh.halfedge(v)))
        if (f != Working_mesh::Mesh::null_face())
          stays[f] = true;
  // Partners across a gap, which leave their borders together, and the limits of other vertices at gaps.
  if (!prepared.tied.empty() || !prepared.facing.empty()) {
    std::vector<char> is_at_gap(prepared.soup.points.size(), false); // by position
    for (const auto& [a, b] : prepared.tied)
      is_at_gap[a] = is_at_gap[b] = true;
    for (const Index position : prepared.facing)
      is_at_gap[position] = true;
    for (const auto f : mesh.faces())
      if (whole.working.is_own(f))
        for (const Index v : prepared.soup.triangles[whole.working.triangle(f)])
          stays[f] |= is_at_gap[prepared.positions[v]];
  }
  // The other places of a shared mesh.
  for (const auto f : mesh.faces())
    stays[f] |= whole.working.is_shared(f);
  return stays;
}

struct Cell_run
{
  std::vector<Cell_collapse> collapses;
  std::size_t movable_vertices = 0;
  double last_cost = s_infinity; ///< the highest cost; infinite when the cell did not reach its target
};

// Locks all vertices that are not strictly inside the cell, and their neighbours, and those of faces that
// stay. Returns the number of vertices that are not locked.
std::size_t lock_outside(Working_mesh& working, const Cell& cell, const std::vector<char>& stays)
{
  const Working_mesh::Mesh& mesh = working.mesh();
  auto& locked = working.constraints().locked_vertices;
  std::vector<char> is_locked(mesh.number_of_vertices(), false), is_bound = is_locked;
  for (const auto v : mesh.vertices())
    is_bound[v] = !cell.box.contains(mesh.point(v));
  for (const auto v : locked)
    is_locked[v] = true;
  for (const auto f : mesh.faces())
    if (stays[cell.faces[f]])
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        if (!std::exchange(is_locked[v], true))
          locked.push_back(v);
  for (const auto e : mesh.edges()) {
    const auto a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
    for (const auto v : {a, b})
      if (!is_locked[v] && (is_bound[a] || is_bound[b])) {
        is_locked[v] = true;
        locked.push_back(v);
      }
  }
  return mesh.number_of_vertices() - locked.size();
}

Cell_run run_cell(const Cell_context& whole, const Cell& cell, const std::vector<char>& stays,
                  Shared_stop& stop)
{
  Cell_run run;
  if (stop.ask())
    return run;
  Working_mesh working(whole.working, whole.rule, cell.faces);
  run.movable_vertices = lock_outside(working, cell, stays);
  const std::size_t wanted = std::size_t(share_of_cell(whole.share) * double(run.movable_vertices));
  if (wanted == 0)
    return run;

  working.constraints().diagonal = whole.diagonal;
  Simplify_options options = whole.options;
  options.ratio.reset();
  options.least_faces.clear();
  options.record.reset();
  const std::size_t faces = cell.faces.size() - working.constraints().uncounted_faces.size();
  options.faces = faces - std::min(faces, 2 * wanted);
  options.should_stop = stop.of_cell();
  internal::Simplification<Working_mesh::Mesh, Working_mesh> simplification(working.mesh(), options,
                                                                            working.constraints(), working);
  working.restrict_new_places([&](const Point_3& place) { return cell.box.contains(place); });
  double highest_cost = 0;
  working.record([&](Working_mesh::Collapse collapse) {
    Index& face = collapse.moving.face;
    face = cell.faces[face];
    highest_cost = std::max(highest_cost, simplification.cost());
    run.collapses.push_back({std::move(collapse), simplification.cost()});
  });
  constexpr bool are_hindrances_counted = false; // they are those of the whole, in the end
  if (simplification.run(are_hindrances_counted).is_reached())
    run.last_cost = highest_cost;
  return run;
}

// Returns the cost at which half of the cells, weighted by their movable vertices, have reached their target.
double cost_of_half(const std::vector<Cell_run>& runs)
{
  std::vector<std::pair<double, std::size_t>> costs;
  std::size_t total = 0;
  for (const Cell_run& run : runs) {
    costs.push_back({run.last_cost, run.movable_vertices});
    total += run.movable_vertices;
  }
  std::sort(costs.begin(), costs.end());
  std::size_t passed = 0;
  for (const auto& [cost, vertices] : costs)
    if (2 * (passed += vertices) >= total)
      return cost;
  return s_infinity;
}

// Returns the cost at which the cells have collapsed a share of all movable vertices; infinite when they have
// not.
double cost_of_share(const std::vector<Cell_run>& runs, double share)
{
  std::vector<double> costs; // for each collapse, the highest up to it in its cell
  double movable_vertices = 0;
  for (const Cell_run& run : runs) {
    double highest = 0;
    for (const Cell_collapse& collapse : run.collapses)
      costs.push_back(highest = std::max(highest, collapse.cost));
    movable_vertices += double(run.movable_vertices);
  }
  const std::size_t wanted = std::size_t(share * movable_vertices);
  if (wanted >= costs.size())
    return s_infinity;
  const auto last = costs.begin() + std::ptrdiff_t(wanted);
  std::nth_element(costs.begin(), last, costs.end());
  return *last;
}

// Returns the collapses of each cell until the first that costs more than `limit`.
std::vector<std::vector<Cell_collapse>> collapses_within(std::vector<Cell_run>&& runs, double limit)
{
  std::vector<std::vector<Cell_collapse>> result;
  for (Cell_run& run : runs) {
    run.collapses.erase(std::find_if(run.collapses.begin(), run.collapses.end(),
                                     [&](const Cell_collapse& collapse) { return collapse.cost > limit; }),
                        run.collapses.end());
    result.push_back(std::move(run.collapses));
  }
  return result;
}

} // namespace

Cell_collapses reduce_in_cells(const Cell_context& whole)
{
  Shared_stop stop(whole);
  const std::vector<Cell> cells = Division(whole, stop).take();
  Cell_collapses result;
  result.cells = cells.size();
  result.is_stopped = stop.is_stopped();
  if (cells.size() < 2)
    return result;
  std::vector<Cell_run> runs(cells.size());
  const std::vector<char> stays = faces_that_stay(whole);
  const auto reduce = [&](std::size_t i) { runs[i] = run_cell(whole, cells[i], stays, stop); };
  tbb::parallel_for(std::size_t(0), cells.size(), Cancellation_scope::inherited(reduce),
                    tbb::simple_partitioner());
  result.is_stopped = stop.is_stopped();
  // All stop at one cost, as a reduction of the whole does.
  const double limit = result.is_stopped
                           ? s_infinity
                           : std::min(cost_of_half(runs), cost_of_share(runs, share_of_cells(whole.share)));
  result.collapses = collapses_within(std::move(runs), limit);
  return result;
}

} // namespace selvedge
