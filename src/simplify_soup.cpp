// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reduce_in_cells.h"

#include <selvedge/Surface_mesh_simplification/internal/Simplification.h>

#include <selvedge/simplify_soup.h>

#include <selvedge/Error.h>
#include <selvedge/mesh/Parts.h>
#include <selvedge/mesh/Working_mesh.h>
#include <selvedge/mesh/mesh_files.h>
#include <selvedge/mesh/selection.h>
#include <selvedge/mesh/texture.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace selvedge {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool has_two_corners_at_one_position(const Index_triple& triangle, const std::vector<Index>& positions)
{
  const Index a = positions[triangle[0]], b = positions[triangle[1]], c = positions[triangle[2]];
  return a == b || b == c || c == a;
}

std::string describe(const Offending_pair& pair)
{
  if (pair.offence == Offence::degenerate)
    return "triangle " + std::to_string(pair.first + 1) + " is degenerate";
  return "triangles " + std::to_string(pair.first + 1) + " and " + std::to_string(pair.second + 1) +
         (pair.offence == Offence::duplicate ? " have the same three corners" : " intersect");
}

void refuse_unless_embedded(const Triangle_soup& soup)
{
  const std::vector<Offending_pair> pairs = offending_pairs(soup);
  if (!pairs.empty())
    throw Input_error(
        "the mesh is not embedded: " + describe(pairs.front()) +
        (pairs.size() == 1 ? "" : ", and " + std::to_string(pairs.size() - 1) + " more such pairs") +
        "; repair it, or leave out the strict option to keep these triangles as they are");
}

// Puts points and triangles of an obstacle behind those of a soup, and takes them away again.
void append(Triangle_soup& soup, const Triangle_soup& obstacle)
{
  const Index offset = Index(soup.points.size());
  soup.points.insert(soup.points.end(), obstacle.points.begin(), obstacle.points.end());
  for (const auto& [a, b, c] : obstacle.triangles)
    soup.triangles.push_back({a + offset, b + offset, c + offset});
}
void take_away(Triangle_soup& soup, const Triangle_soup& obstacle)
{
  soup.points.erase(soup.points.end() - obstacle.points.size(), soup.points.end());
  soup.triangles.resize(soup.triangles.size() - obstacle.triangles.size());
}

// Positions of a soup and its obstacle; those of the obstacle follow.
std::vector<Index> number_positions_of_both(const Triangle_soup& soup, const Triangle_soup& obstacle)
{
  std::vector<Point_3> points = soup.points;
  points.insert(points.end(), obstacle.points.begin(), obstacle.points.end());
  return number_positions(points);
}

// Vertices that rounding has taken from one position no longer share it: where some have moved and others, of
// an obstacle, have not. `after` numbers the positions as they are now.
void take_apart(std::vector<Index>& positions, const std::vector<Index>& after)
{
  std::vector<Index> first_left(positions.size(), std::numeric_limits<Index>::max()); // by position before
  for (Index v = 0; v < positions.size(); ++v)
    if (after[v] != after[positions[v]])
      positions[v] = first_left[positions[v]] = std::min(first_left[positions[v]], v);
}

Triangle_soup geometry_of_both(const Triangle_soup& soup, const Triangle_soup& obstacle)
{
  Triangle_soup both;
  both.points = soup.points;
  both.triangles = soup.triangles;
  append(both, obstacle);
  return both;
}

template <class Number>
double number_at(const unsigned char* bytes)
{
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return double(number);
}

double first_component(const Attribute& attribute, std::size_t row)
{
  const unsigned char* const bytes = attribute.rows.data() + row * row_size(attribute);
  switch (attribute.type) {
  case Attribute::Type::int8:
    return number_at<std::int8_t>(bytes);
  case Attribute::Type::uint8:
    return number_at<std::uint8_t>(bytes);
  case Attribute::Type::int16:
    return number_at<std::int16_t>(bytes);
  case Attribute::Type::uint16:
    return number_at<std::uint16_t>(bytes);
  case Attribute::Type::int32:
    return number_at<std::int32_t>(bytes);
  case Attribute::Type::uint32:
    return number_at<std::uint32_t>(bytes);
  case Attribute::Type::float32:
    return number_at<float>(bytes);
  default:
    return number_at<double>(bytes);
  }
}

// The first components of an attribute's rows, as shares of the largest; 1 where there is no number.
std::vector<double> vertex_weights(const Triangle_soup& soup, const std::string& name)
{
  const auto found = std::find_if(soup.vertex_attributes.begin(), soup.vertex_attributes.end(),
                                  [&](const Attribute& attribute) { return attribute.name == name; });
  if (found == soup.vertex_attributes.end()) {
    std::string known;
    for (const Attribute& attribute : soup.vertex_attributes)
      known += (known.empty() ? "" : ", ") + attribute.name;
    throw Argument_error("no attribute of vertices is called '" + name + "'; " +
                         (known.empty() ? "the mesh has none" : "there are " + known));
  }
  std::vector<double> weights;
  double largest = 0;
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    weights.push_back(first_component(*found, v));
    if (weights.back() < 0 || std::isinf(weights.back()))
      throw Argument_error("the weight '" + name + "' of vertex " + std::to_string(v + 1) +
                           " is not a finite number of at least 0; correct it");
    largest = std::max(largest, weights.back()); // NaN is never larger
  }
  for (double& weight : weights)
    weight = std::isnan(weight) || largest == 0 ? 1 : weight / largest;
  return weights;
}

/// One reduction of a soup, with what is to be known of it on the way.
class Soup_reduction
{
public:
  Soup_reduction(const Prepared_soup& prepared, const Simplify_options& options,
                 const Simplify_intent& intent)
      : m_options(options), m_prepared(prepared), m_start(Clock::now()),
        m_working(prepared.soup, prepared.positions, frozen(prepared, intent), prepared.obstacle,
                  prepared.scale),
        m_seconds_weld(seconds_since(m_start)),
        m_simplification(m_working.mesh(), m_options, constraints(prepared.soup, intent), m_working)
  {
  }

  Simplified_soup run()
  {
    if (m_options.faces_per_cell > 0)
      run_in_cells();
    return state(m_simplification.run());
  }

  /// The states in which runs to some ratios, in descending order, would end.
  std::vector<Simplified_soup> run(const std::vector<double>& ratios)
  {
    std::vector<Simplified_soup> levels;
    m_simplification.run(ratios, [&](const Simplify_report& report) { levels.push_back(state(report)); });
    return levels;
  }

private:
  static std::vector<char> frozen(const Prepared_soup& prepared, const Simplify_intent& intent)
  {
    std::vector<char> is_frozen = prepared.is_frozen;
    for (const auto* names : {&intent.locked, &intent.kept})
      for (const std::string& name : *names) {
        const std::vector<char> is_named = triangles_named(prepared.soup, name);
        std::transform(is_named.begin(), is_named.end(), is_frozen.begin(), is_frozen.begin(),
                       std::logical_or<char>());
      }
    return is_frozen;
  }

  const Simplify_constraints<Working_mesh::Mesh>& constraints(const Triangle_soup& soup,
                                                              const Simplify_intent& intent)
  {
    auto& constraints = m_working.constraints();
    const auto add_share = [&](const std::string& name, double ratio) {
      const std::vector<char> is_named = triangles_named(soup, name);
      constraints.shares.push_back({{}, ratio});
      for (Index t = 0; t < is_named.size(); ++t)
        if (is_named[t])
          constraints.shares.back().faces.emplace_back(t);
    };
    for (const Simplify_intent::Part_ratio& part : intent.ratios)
      add_share(part.name, part.ratio);
    for (const std::string& name : intent.kept)
      add_share(name, 1);
    if (!intent.weights.empty())
      m_working.weigh(vertex_weights(soup, intent.weights));
    if (m_options.uv_weight > 0)
      m_working.measure_uvs(uv_unit(soup, m_prepared.scale));
    m_working.count_refusals(part_kinds(soup));
    m_working.tell(m_options.on_collapse);
    return constraints;
  }

  // Finds collapses in cells, and does them to the whole, which so knows of them all that it knows of its
  // own. Cells go a little less far than a reduction of the whole alone would: it comes to where they meet,
  // too, and settles what they did not agree on.
  void run_in_cells()
  {
    constexpr double caution = 0.97;
    const Clock::time_point start = Clock::now();
    const auto total = m_simplification.targets().total();
    const std::size_t movable =
        m_working.mesh().number_of_vertices() - m_working.constraints().locked_vertices.size();
    if (movable == 0)
      return;
    const double share =
        caution * double(m_simplification.targets().total_excess()) / (2.0 * double(movable));
    const Cell_collapses found = reduce_in_cells({m_prepared,
                                                  m_working,
                                                  m_simplification.rule(),
                                                  m_options,
                                                  m_simplification.diagonal(),
                                                  {total.faces, total.target, total.faces},
                                                  share});
    m_cells = found.cells;
    const std::size_t faces_left = total.faces - std::min(total.faces, 2 * found.collapses.size());
    const Simplify_progress progress{total.faces, total.target, faces_left};
    bool is_stopped = found.is_stopped;
    for (const Working_mesh::Side& moving : found.collapses) {
      // Small cells may go too far together, by the last face of each.
      if (m_simplification.targets().is_reached())
        break;
      // Who has stopped the cells wants what they have reached.
      constexpr std::size_t collapses_between_questions = 4096;
      if (!is_stopped && m_options.should_stop && m_collapses_in_cells % collapses_between_questions == 0 &&
          m_options.should_stop(progress)) {
        is_stopped = true;
        break;
      }
      m_simplification.collapse(m_working.halfedge(moving));
      ++m_collapses_in_cells;
    }
    if (is_stopped)
      m_options.should_stop = [](const Simplify_progress&) { return true; };
    m_seconds_cells = seconds_since(start);
  }

  Simplified_soup state(const Simplify_report& report) const
  {
    const Clock::time_point start = Clock::now();
    Simplified_soup result;
    Working_mesh::Result left = m_working.result();
    result.soup = std::move(left.soup);
    result.triangles = std::move(left.triangles);
    result.corners = std::move(left.corners);
    result.welding = m_working.notes();
    result.report = report;
    result.report.cells = m_cells;
    result.report.collapses_in_cells = m_collapses_in_cells;
    result.report.seconds_cells = m_seconds_cells;
    result.refused_by_part = m_working.refused_by_part();
    result.seconds_weld = m_seconds_weld + seconds_since(start);
    return result;
  }

  Simplify_options m_options;
  const Prepared_soup& m_prepared;
  Clock::time_point m_start;
  Working_mesh m_working;
  double m_seconds_weld;
  internal::Simplification<Working_mesh::Mesh, Working_mesh> m_simplification;
  std::size_t m_cells = 0;
  std::size_t m_collapses_in_cells = 0;
  double m_seconds_cells = 0;
};

} // namespace

Prepared_soup prepare(Triangle_soup input, const Prepare_options& options, const Triangle_soup& obstacle)
{
  if (input.triangles.empty())
    throw Input_error("the mesh has no triangles");
  if (options.is_strict)
    refuse_unless_embedded(obstacle.triangles.empty() ? input : geometry_of_both(input, obstacle));

  Prepared_soup prepared;
  prepared.soup = std::move(input);
  Triangle_soup& soup = prepared.soup;

  Clock::time_point start = Clock::now();
  prepared.obstacle.points = obstacle.points;
  prepared.positions = number_positions_of_both(soup, obstacle);
  {
    const std::vector<Index> positions(prepared.positions.begin() + soup.points.size(),
                                       prepared.positions.end());
    std::copy_if(obstacle.triangles.begin(), obstacle.triangles.end(),
                 std::back_inserter(prepared.obstacle.triangles),
                 [&](const Index_triple& v) { return !has_two_corners_at_one_position(v, positions); });
  }
  const auto leave_out = [&](const std::vector<Index>& positions) {
    std::vector<Index> kept;
    for (Index t = 0; t < soup.triangles.size(); ++t)
      if (!has_two_corners_at_one_position(soup.triangles[t], positions))
        kept.push_back(t);
    const std::size_t left_out = soup.triangles.size() - kept.size();
    if (left_out > 0)
      keep_triangles(soup, kept);
    return left_out;
  };
  prepared.left_out_faces = leave_out(prepared.positions);

  // The defects that the input had before it was rounded, and where vertices are afterwards.
  std::vector<Offending_pair> pairs_before;
  std::vector<Index> positions_after;
  if (options.round_to_float32) {
    Triangle_soup unrounded;
    unrounded.points = soup.points;
    prepared.rounding = round_to_float32(soup);
    if (prepared.rounding.coordinates > 0) {
      positions_after = number_positions_of_both(soup, obstacle);
      prepared.left_out_by_rounding = leave_out(positions_after);
      take_apart(prepared.positions, positions_after);
      unrounded.triangles = soup.triangles;
      append(unrounded, prepared.obstacle);
      prepared.seconds_weld = seconds_since(start);
      start = Clock::now();
      pairs_before = offending_pairs(unrounded);
      prepared.seconds_check = seconds_since(start);
      start = Clock::now();
    }
  }
  prepared.seconds_weld += seconds_since(start);
  if (soup.triangles.empty())
    throw Input_error(
        "every triangle of the mesh has two corners at one position; there is nothing to reduce");

  prepared.scale = Scale(soup, prepared.obstacle);

  start = Clock::now();
  const std::size_t own_triangles = soup.triangles.size();
  append(soup, prepared.obstacle);
  prepared.offending_pairs = offending_pairs(soup);
  prepared.is_frozen.assign(soup.triangles.size(), false);
  for (const Offending_pair& pair : prepared.offending_pairs) {
    prepared.is_frozen[pair.first] = prepared.is_frozen[pair.second] = true;
    if (prepared.rounding.coordinates > 0)
      prepared.pairs_by_rounding += !std::binary_search(
          pairs_before.begin(), pairs_before.end(), pair, [](const auto& a, const auto& b) {
            return std::make_pair(a.first, a.second) < std::make_pair(b.first, b.second);
          });
  }
  if (!positions_after.empty()) {
    std::vector<char> is_merged(soup.points.size(), false); // by position after: it was several
    for (Index v = 0; v < positions_after.size(); ++v)
      is_merged[positions_after[v]] |= prepared.positions[v] != prepared.positions[positions_after[v]];
    for (Index t = 0; t < own_triangles; ++t)
      for (const Index v : soup.triangles[t])
        prepared.is_frozen[t] |= is_merged[positions_after[v]];
  }
  prepared.frozen_faces =
      std::count(prepared.is_frozen.begin(), prepared.is_frozen.begin() + own_triangles, true);
  std::fill(prepared.is_frozen.begin() + own_triangles, prepared.is_frozen.end(), true);
  prepared.seconds_check += seconds_since(start);

  start = Clock::now();
  std::vector<Index> transforms = transforms_of_vertices(soup);
  if (!transforms.empty()) // no node has the positions of an obstacle
    transforms.resize(soup.points.size(), std::numeric_limits<Index>::max());
  prepared.snapping = snap_borders(soup, prepared.positions, prepared.is_frozen, options.weld_distance,
                                   transforms, prepared.obstacle.triangles.size(), prepared.scale);
  prepared.seconds_snap = seconds_since(start);
  take_away(soup, prepared.obstacle);
  return prepared;
}

Simplified_soup simplify_soup(const Prepared_soup& prepared, const Simplify_options& options,
                              const Simplify_intent& intent)
{
  if (options.faces_per_cell > 0 && !intent.ratios.empty())
    throw Argument_error("in cells no part can have a ratio of its own; leave out one of the two options");
  return Soup_reduction(prepared, options, intent).run();
}

std::vector<Simplified_soup> simplify_lods(const Prepared_soup& prepared, const Simplify_options& options,
                                           const std::vector<double>& ratios, const Simplify_intent& intent)
{
  if (options.faces)
    throw Argument_error("levels of detail are ratios; leave out the number of faces");
  std::vector<Simplified_soup> levels(ratios.size());
  Simplify_options to_level = options;
  if (!intent.ratios.empty() || options.faces_per_cell > 0) {
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

Verification verify(const Simplified_soup& result, const Prepared_soup& original)
{
  Verify_options options;
  options.are_shapes_judged = false; // limits see to these, or the user wants none
  if (original.obstacle.triangles.empty())
    return verify(result.soup, original.soup, original.offending_pairs, options);
  const Triangle_soup both = geometry_of_both(result.soup, original.obstacle);
  Verification verification;
  verification.pairs = offending_pairs(both);
  verification.new_pairs = new_pairs(
      both, verification.pairs, geometry_of_both(original.soup, original.obstacle), original.offending_pairs);
  verification.pieces = pieces(result.soup);
  verification.matching = match_pieces(result.soup, original.soup, options);
  verification.topology_differences =
      topology_differences(verification.pieces, verification.matching.pieces_of_original);
  verification.distances = distances(result.soup, original.soup);
  return verification;
}

} // namespace selvedge
