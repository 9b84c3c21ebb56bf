// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reduce_in_cells.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <mutex>
#include <numeric>
#include <utility>

namespace selvedge {
namespace {

constexpr double s_infinity = std::numeric_limits<double>::infinity();

/// An open box, not bounded everywhere.
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

/// A box, and all triangles whose own boxes meet its closure. Those of the obstacle follow those of the soup.
struct Cell
{
  Box box;
  std::vector<Index> triangles;
};

/// Divides space at medians of vertices.
class Division
{
public:
  Division(const Triangle_soup& soup, const Triangle_soup& obstacle, const std::vector<Index>& positions,
           std::size_t faces_per_cell)
      : m_soup(soup), m_obstacle(obstacle), m_vertices_per_cell((faces_per_cell + 1) / 2)
  {
    std::vector<Index> vertices;
    for (Index v = 0; v < soup.points.size(); ++v)
      if (positions[v] == v)
        vertices.push_back(v);
    std::vector<Index> triangles(soup.triangles.size() + obstacle.triangles.size());
    std::iota(triangles.begin(), triangles.end(), Index(0));
    divide({}, vertices.begin(), vertices.end(), std::move(triangles));
  }

  std::vector<Cell> take() { return std::move(m_cells); }

private:
  using Iterator = std::vector<Index>::iterator;

  void divide(const Box& box, Iterator first, Iterator beyond, std::vector<Index> triangles)
  {
    const std::size_t count = beyond - first;
    if (count <= m_vertices_per_cell) {
      if (count > 0)
        m_cells.push_back({box, std::move(triangles)});
      return;
    }
    const int axis = longest_axis(first, beyond);
    const auto coordinate = [&](Index v) { return m_soup.points[v][axis]; };
    const Iterator middle = first + count / 2;
    std::nth_element(first, middle, beyond, [&](Index a, Index b) { return coordinate(a) < coordinate(b); });
    const double plane = coordinate(*middle);
    // What lies in the plane is in no cell.
    const Iterator first_part = std::partition(first, middle, [&](Index v) { return coordinate(v) < plane; });
    const Iterator second_part =
        std::partition(middle, beyond, [&](Index v) { return !(coordinate(v) > plane); });

    Box below = box, above = box;
    below.high[axis] = above.low[axis] = plane;
    std::vector<Index> triangles_below, triangles_above;
    for (const Index t : triangles) {
      const auto [low, high] = extent(t, axis);
      if (low <= plane)
        triangles_below.push_back(t);
      if (high >= plane)
        triangles_above.push_back(t);
    }
    triangles = {};
    divide(below, first, first_part, std::move(triangles_below));
    divide(above, second_part, beyond, std::move(triangles_above));
  }

  int longest_axis(Iterator first, Iterator beyond) const
  {
    CGAL::Bbox_3 box;
    for (Iterator v = first; v != beyond; ++v)
      box += m_soup.points[*v].bbox();
    int longest = 0;
    for (int i = 1; i < 3; ++i)
      if (box.max(i) - box.min(i) > box.max(longest) - box.min(longest))
        longest = i;
    return longest;
  }

  std::pair<double, double> extent(Index t, int axis) const
  {
    const bool is_own = t < m_soup.triangles.size();
    const Triangle_soup& soup = is_own ? m_soup : m_obstacle;
    const auto& [a, b, c] = soup.triangles[is_own ? t : t - m_soup.triangles.size()];
    return std::minmax({soup.points[a][axis], soup.points[b][axis], soup.points[c][axis]});
  }

  const Triangle_soup& m_soup;
  const Triangle_soup& m_obstacle;
  std::size_t m_vertices_per_cell;
  std::vector<Cell> m_cells;
};

/// Some triangles of a soup and its obstacle, as soups of their own with all that `Working_mesh` looks at.
struct Cut_out
{
  Cut_out(const Whole& whole, const std::vector<Index>& triangles)
  {
    const Triangle_soup& from = whole.prepared.soup;
    const Triangle_soup& from_obstacle = whole.prepared.obstacle;
    const Index own_triangles = Index(from.triangles.size()), own_vertices = Index(from.points.size());

    std::vector<Index_triple> numbered;
    for (const Index t : triangles)
      if (t < own_triangles)
        numbered.push_back(from.triangles[t]);
      else {
        const auto& [a, b, c] = from_obstacle.triangles[t - own_triangles];
        numbered.push_back({own_vertices + a, own_vertices + b, own_vertices + c});
      }
    for (const Index_triple& triangle : numbered)
      vertices.insert(vertices.end(), triangle.begin(), triangle.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());

    for (const Index v : vertices)
      if (v < own_vertices)
        soup.points.push_back(from.points[v]);
      else
        obstacle.points.push_back(from_obstacle.points[v - own_vertices]);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      Index_triple triangle;
      for (int k = 0; k < 3; ++k)
        triangle[k] =
            Index(std::lower_bound(vertices.begin(), vertices.end(), numbered[i][k]) - vertices.begin());
      if (triangles[i] >= own_triangles)
        for (Index& v : triangle)
          v -= Index(soup.points.size());
      (triangles[i] < own_triangles ? soup : obstacle).triangles.push_back(triangle);
      is_frozen.push_back(whole.is_frozen[triangles[i]]);
    }
    number_positions(whole.prepared.positions);

    const std::vector<Index> own(triangles.begin(), triangles.begin() + soup.triangles.size());
    take(soup.uvs, from.uvs, own);
    take(soup.normals, from.normals, own);
    for (const auto labels : {&Triangle_soup::groups, &Triangle_soup::objects, &Triangle_soup::materials})
      if (!(from.*labels).empty())
        for (const Index t : own)
          (soup.*labels).of_triangle.push_back((from.*labels).of_triangle[t]);
  }

  Triangle_soup soup, obstacle;
  std::vector<Index> vertices; // of the whole
  std::vector<Index> positions;
  std::vector<char> is_frozen;

private:
  // By the first vertex here that lies there.
  void number_positions(const std::vector<Index>& positions_of_whole)
  {
    std::vector<std::pair<Index, Index>> order; // position in the whole, vertex here
    for (Index v = 0; v < vertices.size(); ++v)
      order.push_back({positions_of_whole[vertices[v]], v});
    std::sort(order.begin(), order.end());
    positions.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      positions[order[i].second] =
          i > 0 && order[i].first == order[i - 1].first ? positions[order[i - 1].second] : order[i].second;
  }

  // Every corner gets a value of its own: they are compared by value.
  template <std::size_t dimension>
  static void take(Corner_values<dimension>& values, const Corner_values<dimension>& from,
                   const std::vector<Index>& triangles)
  {
    if (from.empty())
      return;
    for (const Index t : triangles) {
      const Index first = Index(values.values.size());
      values.of_triangle.push_back({first, first + 1, first + 2});
      for (const Index i : from.of_triangle[t])
        values.values.push_back(from.values[i]);
    }
  }
};

/// Asks whoever may stop the whole, for all cells.
class Shared_stop
{
public:
  explicit Shared_stop(const Whole& whole)
      : m_should_stop(whole.options.should_stop), m_progress(whole.progress)
  {
  }

  bool is_stopped() const { return m_is_stopped; }

  /// For one cell.
  std::function<bool(const Simplify_progress&)> of_cell()
  {
    if (!m_should_stop)
      return {};
    return [this, told = std::size_t(0)](const Simplify_progress& of_cell) mutable {
      const std::size_t gone = of_cell.faces_input - of_cell.faces;
      const std::lock_guard lock(m_mutex);
      m_progress.faces -= std::min(m_progress.faces, gone - std::exchange(told, gone));
      return m_is_stopped = m_is_stopped || m_should_stop(m_progress);
    };
  }

private:
  const std::function<bool(const Simplify_progress&)>& m_should_stop;
  std::mutex m_mutex;
  Simplify_progress m_progress;
  std::atomic<bool> m_is_stopped = false;
};

/// The collapses of one cell, as if they had to reach the share alone.
struct Cell_run
{
  struct Collapse
  {
    Working_mesh::Side moving;
    double cost;
  };
  std::vector<Collapse> collapses;
  std::size_t movable_vertices = 0;
  double last_cost = s_infinity; ///< the dearest; infinite when it did not get there
};

// Locks what is not strictly inside the cell, and the neighbours of that. Returns the number of all others.
std::size_t lock_outside(Working_mesh& working, const Box& box)
{
  const Working_mesh::Mesh& mesh = working.mesh();
  auto& locked = working.constraints().locked_vertices;
  std::vector<char> is_locked(mesh.number_of_vertices(), false), is_bound = is_locked;
  for (const auto v : mesh.vertices())
    is_bound[v] = !box.contains(mesh.point(v));
  for (const auto v : locked)
    is_locked[v] = true;
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

Cell_run run_cell(const Whole& whole, const Cell& cell, Shared_stop& stop)
{
  const Cut_out cut(whole, cell.triangles);
  Working_mesh working(cut.soup, cut.positions, cut.is_frozen, cut.obstacle);
  Cell_run run;
  run.movable_vertices = lock_outside(working, cell.box);
  const std::size_t wanted = std::size_t(whole.share * double(run.movable_vertices));
  if (wanted == 0)
    return run;

  working.constraints().diagonal = whole.diagonal;
  if (!whole.weights.empty()) {
    std::vector<double> weights;
    for (std::size_t v = 0; v < cut.soup.points.size(); ++v)
      weights.push_back(whole.weights[cut.vertices[v]]);
    working.weigh(weights);
  }
  if (whole.options.uv_weight > 0)
    working.measure_uvs(whole.uv_unit);

  Simplify_options options = whole.options;
  options.ratio.reset();
  options.faces = cut.soup.triangles.size() - std::min(cut.soup.triangles.size(), 2 * wanted);
  options.should_stop = stop.of_cell();
  internal::Simplification<Working_mesh::Mesh, Working_mesh> simplification(working.mesh(), options,
                                                                            working.constraints(), working);
  double dearest = 0;
  working.record([&](const Working_mesh::Side& moving) {
    const Index triangle = cell.triangles[moving.triangle]; // of the soup: nothing moves at an obstacle
    dearest = std::max(dearest, simplification.cost());
    run.collapses.push_back({{triangle, moving.place, moving.is_beyond}, simplification.cost()});
  });
  if (simplification.run().is_reached())
    run.last_cost = dearest;
  return run;
}

// The cost up to which cells go: that which, weighted by what may move, half of them reached. In a reduction
// of the whole all would come to one cost.
double common_cost(const std::vector<Cell_run>& runs)
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

} // namespace

Cell_collapses reduce_in_cells(const Whole& whole)
{
  const std::vector<Cell> cells = Division(whole.prepared.soup, whole.prepared.obstacle,
                                           whole.prepared.positions, whole.options.faces_per_cell)
                                      .take();
  Cell_collapses result;
  result.cells = cells.size();
  if (cells.size() < 2)
    return result;
  Shared_stop stop(whole);
  std::vector<Cell_run> runs(cells.size());
  tbb::parallel_for(
      std::size_t(0), cells.size(), [&](std::size_t i) { runs[i] = run_cell(whole, cells[i], stop); },
      tbb::simple_partitioner());
  result.is_stopped = stop.is_stopped();
  const double limit = result.is_stopped ? s_infinity : common_cost(runs);
  for (const Cell_run& run : runs)
    for (const auto& [moving, cost] : run.collapses) {
      if (cost > limit)
        break;
      result.collapses.push_back(moving);
    }
  return result;
}

} // namespace selvedge
