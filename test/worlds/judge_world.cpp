// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "judge_world.h"
#include "Judged_complex.h"
#include "Random.h"
#include "random_world.h"

#include "soup/Gltf_scene.h"
#include "soup/flat_shading.h"
#include "soup/selection.h"
#include "support/Temporary_folder.h"
#include "support/soups.h"
#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/cells.h>
#include <selvedge/collapse_log.h>
#include <selvedge/merge.h>
#include <selvedge/mesh_files.h>
#include <selvedge/replay.h>
#include <selvedge/rounding.h>
#include <selvedge/verify.h>

#include <CGAL/Kernel/global_functions.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace selvedge::test {

const char* name(Promise promise)
{
  static constexpr const char* s_names[] = {"preparation", "embedded",    "motion",     "topology",
                                            "seams",       "clearance",   "attributes", "frozen",
                                            "stop",        "verdict",     "log replay", "progression",
                                            "written",     "determinism", "refusal"};
  return s_names[std::size_t(promise)];
}

Judgement_counts& Judgement_counts::operator+=(const Judgement_counts& other)
{
  worlds += other.worlds;
  refused_worlds += other.refused_worlds;
  collapses += other.collapses;
  placed += other.placed;
  snaps += other.snaps;
  turned += other.turned;
  twins += other.twins;
  option_sets += other.option_sets;
  for (const auto& [option, count] : other.options)
    options[option] += count;
  return *this;
}

namespace {

using Coordinates = std::array<double, 3>;
using Verdict = std::optional<Broken_promise>;

Coordinates coordinates(const Point_3& p)
{
  return {p.x(), p.y(), p.z()};
}

bool has_same_bits(const Point_3& p, const Point_3& q)
{
  const Coordinates a = coordinates(p), b = coordinates(q);
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// For every point the first of those with equal coordinates.
std::vector<Index> first_at_position(const std::vector<Point_3>& points)
{
  std::map<Coordinates, Index> first;
  std::vector<Index> result;
  for (Index v = 0; v < points.size(); ++v)
    result.push_back(first.emplace(coordinates(points[v]), v).first->second);
  return result;
}

bool has_three_positions(const Index_triple& triangle, const std::vector<Index>& positions)
{
  const Index a = positions[triangle[0]], b = positions[triangle[1]], c = positions[triangle[2]];
  return a != b && b != c && c != a;
}

Point_3 rounded(const Point_3& p)
{
  // In memory: GCC 12 takes conversions to float and back that stand side by side for none.
  const volatile float x = float(p.x()), y = float(p.y()), z = float(p.z());
  return {x, y, z};
}

// In which of the two objects that may intersect a triangle is: 1, 2, or 0 for neither.
char part_of_triangle(const World& world, Index triangle)
{
  if (world.may_intersect.empty())
    return 0;
  const auto& [first, second] = world.may_intersect.front();
  const std::string& object = world.soup.objects.names[world.soup.objects.of_triangle[triangle]];
  return object == first ? 1 : object == second ? 2 : 0;
}

// Before the reduction
// ----------------------------------------------------------------------------------------------------------

/// What `prepare` should come to, found by looking at everything.
struct Expected_start
{
  explicit Expected_start(const World& world)
  {
    const bool is_rounded = world.prepare_options().round_to_float32;
    soup.points = world.soup.points;
    const std::vector<Index> first = first_at_position(soup.points);
    std::vector<Point_3> before = soup.points;
    if (is_rounded)
      for (Point_3& p : soup.points)
        p = rounded(p);
    const std::vector<Index> first_after = first_at_position(soup.points);
    for (Index t = 0; t < world.soup.triangles.size(); ++t)
      if (const Index_triple& triangle = world.soup.triangles[t];
          has_three_positions(triangle, first) && has_three_positions(triangle, first_after)) {
        soup.triangles.push_back(triangle);
        part_of.push_back(part_of_triangle(world, t));
      }
    obstacle.points = world.obstacle.points;
    const std::vector<Index> first_of_obstacle = first_at_position(obstacle.points);
    std::copy_if(world.obstacle.triangles.begin(), world.obstacle.triangles.end(),
                 std::back_inserter(obstacle.triangles),
                 [&](const Index_triple& t) { return has_three_positions(t, first_of_obstacle); });

    // Vertices of different positions that rounding has brought to one.
    std::vector<Point_3> after = soup.points;
    for (auto* points : {&before, &after})
      points->insert(points->end(), obstacle.points.begin(), obstacle.points.end());
    std::vector<char> is_used(after.size(), false);
    for (const Index_triple& t : soup.triangles)
      for (const Index v : t)
        is_used[v] = true;
    for (const Index_triple& t : obstacle.triangles)
      for (const Index v : t)
        is_used[soup.points.size() + v] = true;
    std::map<Coordinates, std::set<Coordinates>> merged;
    for (std::size_t v = 0; v < after.size(); ++v)
      if (is_used[v])
        merged[coordinates(after[v])].insert(coordinates(before[v]));
    for (std::size_t v = 0; v < soup.points.size(); ++v)
      is_merged.push_back(is_used[v] && merged[coordinates(after[v])].size() > 1);
  }

  Triangle_soup soup, obstacle; // points and triangles alone
  std::vector<char> is_merged;  // by own vertex
  std::vector<char> part_of;    // by own triangle
};

/// Whether no power of two brings the largest coordinate of the soup between 2^-140 and 2^140 without taking
/// a digit below the smallest double, or a coordinate beyond the largest.
bool is_too_far_apart(const Triangle_soup& soup, const Triangle_soup& obstacle)
{
  const auto is_fine = [&](int exponent) {
    double largest = 0;
    for (const auto* part : {&soup, &obstacle})
      for (const Index_triple& t : part->triangles)
        for (const Index v : t)
          for (const double x : coordinates(part->points[v])) {
            const double scaled = std::ldexp(x, exponent);
            if (!std::isfinite(scaled) || std::ldexp(scaled, -exponent) != x)
              return false;
            if (part == &soup)
              largest = std::max(largest, std::abs(scaled));
          }
    return largest == 0 || (largest >= 0x1p-141 && largest < 0x1p140);
  };
  for (int exponent = -2100; exponent <= 2100; ++exponent)
    if (is_fine(exponent))
      return false;
  return true;
}

World in_pose(const World& world, std::size_t pose)
{
  World posed = world;
  posed.soup.points = world.soup.poses[pose].points;
  if (!world.obstacle.poses.empty())
    posed.obstacle.points = world.obstacle.poses[pose].points;
  posed.soup.poses.clear();
  posed.obstacle.poses.clear();
  return posed;
}

/// Whether some triangle has three positions in one pose and fewer in another.
bool has_side_of_length_zero_in_some_pose(const World& world)
{
  std::set<std::pair<std::vector<Index_triple>, std::vector<Index_triple>>> triangles; // of both
  const auto add = [&](const Expected_start& start) {
    triangles.emplace(start.soup.triangles, start.obstacle.triangles);
  };
  add(Expected_start(world));
  for (std::size_t pose = 0; pose < world.soup.poses.size(); ++pose)
    add(Expected_start(in_pose(world, pose)));
  return triangles.size() > 1;
}

Verdict judge_refusal(const World& world, const std::string& message)
{
  if (has_side_of_length_zero_in_some_pose(world))
    return std::nullopt;
  for (std::size_t pose = 0; pose < world.soup.poses.size(); ++pose)
    if (!judge_refusal(in_pose(world, pose), message))
      return std::nullopt;
  const bool is_rounded = world.prepare_options().round_to_float32;
  if (is_rounded)
    for (const Point_3& p : world.soup.points)
      if (!std::isfinite(rounded(p).x()) || !std::isfinite(rounded(p).y()) || !std::isfinite(rounded(p).z()))
        return std::nullopt;
  if (world.defects == Defects::refuse) {
    const std::vector<Index> first = first_at_position(world.soup.points),
                             first_of_obstacle = first_at_position(world.obstacle.points);
    for (const Index_triple& t : world.soup.triangles)
      if (!has_three_positions(t, first))
        return std::nullopt;
    for (const Index_triple& t : world.obstacle.triangles)
      if (!has_three_positions(t, first_of_obstacle))
        return std::nullopt;
    Judged_complex complex(world.soup, world.obstacle);
    std::vector<char> part_of;
    for (Index t = 0; t < world.soup.triangles.size(); ++t)
      part_of.push_back(part_of_triangle(world, t));
    complex.permit(part_of);
    if (!complex.offending_pairs().empty())
      return std::nullopt;
  }
  const Expected_start expected(world);
  if (expected.soup.triangles.empty() || is_too_far_apart(expected.soup, expected.obstacle))
    return std::nullopt;
  return Broken_promise{Promise::refusal, message};
}

Verdict judge_preparation(const World& world, const World_run& run, const Expected_start& expected,
                          Judged_complex& complex)
{
  const auto broken = [](const std::string& what) { return Broken_promise{Promise::preparation, what}; };
  const Prepared_soup& unsnapped = run.unsnapped;
  if (unsnapped.soup.triangles != expected.soup.triangles ||
      unsnapped.obstacle.triangles != expected.obstacle.triangles)
    return broken("the triangles left are not those with three positions");
  for (const auto& [found, wanted] : {std::pair(&unsnapped.soup.points, &expected.soup.points),
                                      std::pair(&unsnapped.obstacle.points, &expected.obstacle.points)})
    if (found->size() != wanted->size() ||
        !std::equal(found->begin(), found->end(), wanted->begin(), has_same_bits))
      return broken("points are not those of the input, rounded where that was asked for");

  const std::size_t own = expected.soup.triangles.size();
  const auto pairs = complex.offending_pairs();
  std::set<std::pair<Index, Index>> found;
  for (const Offending_pair& pair : unsnapped.offending_pairs)
    found.insert({pair.first, pair.second});
  if (found != pairs)
    return broken(std::to_string(found.size()) + " offending pairs found, and there are " +
                  std::to_string(pairs.size()));
  if (world.defects == Defects::refuse && world.prepare_options().round_to_float32 == false && !pairs.empty())
    return Broken_promise{Promise::refusal, "an input that is not embedded was accepted, though strict"};

  std::vector<char> is_frozen(own + expected.obstacle.triangles.size(), false);
  const bool may_descend = world.defects == Defects::descend;
  for (const auto& [f, g] : pairs)
    if (!may_descend)
      is_frozen[f] = is_frozen[g] = true;
  if (may_descend)
    complex.exempt(pairs);
  for (std::size_t t = 0; t < own; ++t)
    for (const Index v : expected.soup.triangles[t])
      is_frozen[t] |= expected.is_merged[v];
  for (Index f = 0; f < is_frozen.size(); ++f)
    if (is_frozen[f] || f >= own) {
      complex.freeze(f);
      for (const Prepared_soup* prepared : {&unsnapped, &run.prepared})
        if (f >= prepared->is_frozen.size() || !prepared->is_frozen[f])
          return Broken_promise{Promise::frozen,
                                "triangle " + std::to_string(f) + " should be frozen, and is not"};
    }
  return std::nullopt;
}

Verdict judge_snaps(const World& world, const World_run& run, Judged_complex& complex,
                    Judgement_counts& counts)
{
  const double distance = run.prepared.snapping.distance;
  if (distance !=
      (world.are_clear_gaps_welded ? run.prepared.border_gaps.clear_length.value_or(0) : world.weld_distance))
    return Broken_promise{Promise::seams, "the distance of snaps is not the one that was asked for"};
  for (const Snap& snap : run.prepared.snapping.snaps) {
    const Index from = complex.position(snap.from), to = complex.position(snap.to);
    const Point_3 &p = complex.point(from), &q = complex.point(to);
    if (!(std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z()) <= distance * (1 + 1e-12)))
      return Broken_promise{Promise::seams, "a snap goes further than the distance"};
    ++counts.snaps;
    if (auto broken = complex.snap(from, to)) {
      broken->message += " in the snap of " + std::to_string(snap.from) + " to " + std::to_string(snap.to);
      return broken;
    }
  }
  const Triangle_soup& soup = run.prepared.soup;
  if (soup.triangles != run.unsnapped.soup.triangles ||
      soup.points.size() != run.unsnapped.soup.points.size())
    return Broken_promise{Promise::seams, "snapping changes more than coordinates"};
  for (Index v = 0; v < soup.points.size(); ++v)
    if (soup.points[v] != complex.point(complex.position(v)))
      return Broken_promise{Promise::seams, "vertex " + std::to_string(v) + " is not where the snaps lead"};
  return std::nullopt;
}

// The reduction
// ----------------------------------------------------------------------------------------------------------

std::vector<char> held(const World& world, const Triangle_soup& soup, bool with_locked)
{
  std::vector<char> is_held(soup.triangles.size(), false);
  for (const auto* names : {&world.intent.kept, with_locked ? &world.intent.locked : &world.intent.kept})
    for (const std::string& name : *names) {
      const std::vector<char> is_named = triangles_named(soup, name);
      for (std::size_t t = 0; t < is_held.size(); ++t)
        is_held[t] |= is_named[t];
    }
  return is_held;
}

// Whether the triangles after so many steps of the progression are those that are alive, with their corners
// where they are now.
bool is_state(const World_run& run, std::size_t steps, const Judged_complex& complex)
{
  const Progression& progression = run.result.progression;
  std::map<Index, Index> position_of_wedge; // from where it starts
  for (std::size_t t = 0; t < progression.wedges.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index position = complex.position(run.prepared.soup.triangles[t][k]);
      if (position_of_wedge.emplace(progression.wedges[t][k], position).first->second != position)
        return false;
    }
  std::size_t alive = 0;
  for (const auto& [triangle, wedges] : triangles_after(progression, steps)) {
    Index_triple found, positions = complex.positions_of(triangle);
    for (std::size_t k = 0; k < 3; ++k)
      found[k] = position_of_wedge.at(wedges[k]);
    if (run.prepared.turned_faces() > 0) { // they run otherwise meanwhile, and doubles with them
      std::sort(found.begin(), found.end());
      std::sort(positions.begin(), positions.end());
    }
    if (found != positions)
      return false;
    alive += complex.is_alive(triangle);
  }
  return alive == complex.own_faces_alive();
}

// In places of a shared mesh, several collapses are one step.
Verdict judge_collapses(const World_run& run, Judged_complex& complex, Judgement_counts& counts)
{
  const Progression& progression = run.result.progression;
  std::size_t steps = 0;
  for (std::size_t i = 0; i < run.collapses.size(); ++i) {
    const auto& [removed, kept, at, is_removed_first] = run.collapses[i];
    ++counts.collapses;
    counts.placed += at.has_value();
    const Index from = complex.position(Index(removed)), to = complex.position(Index(kept));
    if (auto broken = at ? complex.collapse(from, to, {(*at)[0], (*at)[1], (*at)[2]}, is_removed_first)
                         : complex.collapse(from, to)) {
      broken->message += " in collapse " + std::to_string(i + 1) + ", " + std::to_string(removed) + " to " +
                         std::to_string(kept) + (at ? " at a new place" : "");
      return broken;
    }
    if (steps < progression.steps.size() && is_state(run, steps + 1, complex))
      ++steps;
  }
  if (steps != progression.steps.size() || (!progression.empty() && !is_state(run, steps, complex)))
    return Broken_promise{Promise::progression,
                          "step " + std::to_string(steps + 1) + " is none that the reduction took"};
  return std::nullopt;
}

// The end
// ----------------------------------------------------------------------------------------------------------

template <class Values>
bool has_same_value(const Values& result, Index triangle, const Values& original, Index corner, std::size_t k)
{
  if (result.empty() || original.empty())
    return result.empty() == original.empty();
  return std::memcmp(&result.values[result.of_triangle[triangle][k]],
                     &original.values[original.of_triangle[corner / 3][corner % 3]],
                     sizeof original.values[0]) == 0;
}

bool has_same_label(const Triangle_labels& result, Index triangle, const Triangle_labels& original,
                    Index from)
{
  if (result.empty() || original.empty())
    return result.empty() == original.empty();
  return result.names[result.of_triangle[triangle]] == original.names[original.of_triangle[from]];
}

bool have_same_rows(const std::vector<Attribute>& result, Index row, const std::vector<Attribute>& original,
                    Index from)
{
  if (result.size() != original.size())
    return false;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const std::size_t size = row_size(original[i]);
    if (result[i].name != original[i].name || result[i].rows.size() < (row + 1) * size ||
        std::memcmp(result[i].rows.data() + row * size, original[i].rows.data() + from * size, size) != 0)
      return false;
  }
  return true;
}

// Mixtures of values lie between the least and the largest of them, but for rounding.
struct Range
{
  double low = INFINITY, high = -INFINITY;

  void add(double x)
  {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  bool has(double x) const
  {
    const double margin = 1e-6 * std::max(std::abs(low), std::abs(high));
    return low - margin <= x && x <= high + margin;
  }
};

bool is_value_between(const Corner_values<2>& result, Index triangle, const Corner_values<2>& original,
                      std::size_t k)
{
  if (result.empty())
    return original.empty();
  for (std::size_t c = 0; c < 2; ++c) {
    Range range;
    for (const auto& value : original.values)
      range.add(value[c]);
    if (!range.has(result.values[result.of_triangle[triangle][k]][c]))
      return false;
  }
  return true;
}

bool is_unit(const Corner_values<3>& normals, Index triangle, std::size_t k)
{
  if (normals.empty())
    return true;
  const auto& [x, y, z] = normals.values[normals.of_triangle[triangle][k]];
  return std::abs(std::hypot(x, y, z) - 1) < 1e-6 || std::hypot(x, y, z) == 0;
}

// The worlds have attributes of one component: in floating point, or integers that are not mixed.
bool are_rows_between(const std::vector<Attribute>& result, Index row, const std::vector<Attribute>& original,
                      Index from)
{
  if (result.size() != original.size())
    return false;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Attribute &now = result[i], &before = original[i];
    if (before.type != Attribute::Type::float64 && before.type != Attribute::Type::float32 &&
        !before.is_normalized && !have_same_rows({now}, row, {before}, from))
      return false;
    if (before.type != Attribute::Type::float64)
      continue;
    const auto number = [](const Attribute& attribute, std::size_t place) {
      double x;
      std::memcpy(&x, attribute.rows.data() + place * sizeof x, sizeof x);
      return x;
    };
    Range range;
    bool is_nan_somewhere = false;
    for (std::size_t place = 0; place < before.rows.size() / sizeof(double); ++place) {
      range.add(number(before, place));
      is_nan_somewhere = is_nan_somewhere || std::isnan(number(before, place));
    }
    for (std::size_t c = 0; c < now.components; ++c)
      if (const double x = number(now, row * now.components + c);
          !range.has(x) && !(std::isnan(x) && is_nan_somewhere))
        return false;
  }
  return true;
}

CGAL::Orientation uv_orientation(const Corner_values<2>& uvs, Index triangle)
{
  const auto point = [&](std::size_t k) {
    const auto& uv = uvs.values[uvs.of_triangle[triangle][k]];
    return Kernel::Point_2(uv[0], uv[1]);
  };
  return CGAL::orientation(point(0), point(1), point(2));
}

Verdict judge_attributes(const World& world, const World_run& run, const Judged_complex& complex,
                         const std::vector<Index>& regions, const std::vector<char>& is_held)
{
  const Triangle_soup &result = run.result.soup, &original = run.prepared.soup;
  if (result.triangles.size() != complex.own_faces_alive() ||
      run.result.triangles.size() != result.triangles.size() ||
      run.result.corners.size() != result.triangles.size())
    return Broken_promise{Promise::attributes, "the result has not the triangles that the collapses leave"};
  const bool are_normals_kept =
      run.prepared.normals != Normals_treatment::flat && run.prepared.normals != Normals_treatment::smooth;
  std::map<Index, Index> original_vertex, vertex_of_original;
  std::set<std::size_t> placed; // by the numbers of those that were kept; a place may be where another was
  for (const Soup_collapse& collapse : run.collapses) {
    placed.erase(collapse.removed);
    if (collapse.place)
      placed.insert(collapse.kept);
  }
  std::size_t placed_left = 0;
  for (Index i = 0; i < result.triangles.size(); ++i) {
    const Index t = run.result.triangles[i];
    const auto broken = [&](const char* what) {
      return Broken_promise{Promise::attributes, "triangle " + std::to_string(i) + " of the result: " + what};
    };
    if (!complex.is_alive(t) || (i > 0 && run.result.triangles[i - 1] >= t))
      return broken("gone, or out of order");
    if (!has_same_label(result.groups, i, original.groups, t) ||
        !has_same_label(result.objects, i, original.objects, t) ||
        !has_same_label(result.materials, i, original.materials, t) ||
        !has_same_label(result.smoothing_groups, i, original.smoothing_groups, t) ||
        !have_same_rows(result.triangle_attributes, i, original.triangle_attributes, t))
      return broken("labels or attributes of another");
    for (std::size_t k = 0; k < 3; ++k) {
      const Index corner = run.result.corners[i][k], from = original.triangles[corner / 3][corner % 3],
                  v = result.triangles[i][k];
      if (complex.position(from) != complex.positions_of(t)[k])
        return broken("a corner from another position");
      if (regions[corner / 3] != regions[t])
        return broken("a corner from the other side of a line");
      const bool is_placed = placed.count(from) > 0;
      if (is_placed ? result.points[v] != complex.point(complex.position(from))
                    : !has_same_bits(result.points[v], original.points[from]))
        return broken("a point of another vertex");
      placed_left += is_placed && original_vertex.count(v) == 0;
      if (original_vertex.emplace(v, from).first->second != from ||
          vertex_of_original.emplace(from, v).first->second != v)
        return broken("vertices joined or split");
      if (is_placed) {
        if (!is_value_between(result.uvs, i, original.uvs, k) ||
            (are_normals_kept && !is_unit(result.normals, i, k)) ||
            !are_rows_between(result.vertex_attributes, v, original.vertex_attributes, from))
          return broken("a value at a new place that is no mixture of the input's");
      } else if (!has_same_value(result.uvs, i, original.uvs, corner, k) ||
                 (are_normals_kept && !has_same_value(result.normals, i, original.normals, corner, k)) ||
                 !have_same_rows(result.vertex_attributes, v, original.vertex_attributes, from)) {
        return broken("a value that its corner has not");
      }
      if (is_held[t] && corner != 3 * t + k)
        return Broken_promise{Promise::frozen, "triangle " + std::to_string(t) + " has another corner"};
    }
    if (world.options.check_uv_orientation && !original.uvs.empty() &&
        uv_orientation(original.uvs, t) != CGAL::COLLINEAR &&
        uv_orientation(original.uvs, t) != uv_orientation(result.uvs, i))
      return broken("turned over in the texture");
  }
  if (placed_left != run.result.placed_vertices)
    return Broken_promise{Promise::attributes, "the result counts other vertices at new places"};
  if (world.prepare_options().round_to_float32 && !has_float32_points(result))
    return Broken_promise{Promise::written, "a place is no 32-bit float, and the file has only such"};
  return std::nullopt;
}

// By the numbers of vertices; a result's piece is known by the piece of its triangles.
Verdict judge_pieces(const World_run& run)
{
  const std::vector<Part_kind> kinds = part_kinds(run.prepared.soup);
  const std::vector<Index>& piece_of = kinds.front().of_triangle;
  std::map<Index, Piece> before, after;
  for (const Piece& piece : pieces(run.prepared.soup))
    before[piece_of[piece.first_triangle]] = piece;
  for (const Piece& piece : pieces(run.result.soup)) {
    const Index number = piece_of[run.result.triangles[piece.first_triangle]];
    if (!after.emplace(number, piece).second)
      return Broken_promise{Promise::topology, "piece " + std::to_string(number) + " has come apart"};
  }
  for (const auto& [number, piece] : before) {
    const auto found = after.find(number);
    if (found == after.end())
      return Broken_promise{Promise::topology, "piece " + std::to_string(number) + " is gone"};
    if (found->second.boundary_loops != piece.boundary_loops ||
        found->second.euler_characteristic != piece.euler_characteristic)
      return Broken_promise{Promise::topology,
                            "piece " + std::to_string(number) + " has other borders or holes"};
  }
  return std::nullopt;
}

// Shared meshes have the same triangles of the same rows in all places.
Verdict judge_sharing(const World_run& run)
{
  const Triangle_soup& soup = run.result.soup;
  if (run.result.shared_meshes == 0 || run.result.apart_meshes > 0)
    return std::nullopt;
  const Gltf_scene& scene = *soup.scene;
  std::map<Index, std::vector<Index_triple>> rows; // by part
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const Index group = soup.groups.of_triangle[t];
    const Gltf_scene::Instance& instance = scene.instances[scene.parts[group].instance];
    Index_triple triangle = soup.triangles[t];
    for (Index& v : triangle)
      v = soup.scene_vertices[v] - instance.first;
    if (instance.is_mirrored)
      std::swap(triangle[1], triangle[2]);
    rows[group].push_back(triangle);
  }
  std::map<std::pair<Index, Index>, Index> first; // by mesh of the file and primitive
  for (Index group = 0; group < scene.parts.size(); ++group) {
    const Gltf_scene::Part& part = scene.parts[group];
    const Index other = first.emplace(std::make_pair(part.mesh_of_file, part.primitive), group).first->second;
    if (rows[other] != rows[group])
      return Broken_promise{Promise::attributes, "a shared mesh is not the same in all places"};
  }
  return std::nullopt;
}

Verdict judge_stop(const World& world, const World_run& run)
{
  const auto broken = [](const std::string& what) { return Broken_promise{Promise::stop, what}; };
  const Simplify_report& report = run.result.report;
  const Triangle_soup& soup = run.prepared.soup;
  if (report.collapses != run.collapses.size())
    return broken("the report counts other collapses");
  const std::vector<Reduction_history::Sample>& samples = run.result.history.samples();
  if (report.collapses != (samples.empty() ? 0 : samples.back().collapses))
    return broken("the history has other collapses");
  if (report.faces_input != soup.triangles.size() || report.faces_output != run.result.soup.triangles.size())
    return broken("the report counts other faces");
  if (report.is_stopped != run.is_told_to_stop)
    return broken("told to stop, and not so reported, or the other way round");
  if (world.options.max_error && !run.result.soup.triangles.empty() &&
      distances(run.result.soup, soup).original_to_result.maximum >
          *world.options.max_error * (1 + 1e-6) + 1e-9)
    return broken("a vertex of the original is farther away than the error allows");

  const bool is_over = report.is_reached() || report.is_stopped;
  if (is_over && report.hindrances.total() > 0)
    return broken("the report names what holds back a reduction that has not been held back");
  if (world.options.loop == Collapse_loop::own && report.hindrances[Hindrance::by_loop] > 0)
    return broken("every rule accepts a collapse that the loop has not made");

  // A face of several shares is of the last.
  std::vector<std::size_t> share_of(soup.triangles.size(), 0);
  std::vector<double> ratios{world.options.ratio.value_or(0)};
  const auto add = [&](const std::string& part, double ratio) {
    const std::vector<char> is_named = triangles_named(soup, part);
    for (std::size_t t = 0; t < share_of.size(); ++t)
      if (is_named[t])
        share_of[t] = ratios.size();
    ratios.push_back(ratio);
  };
  for (const Simplify_intent::Part_ratio& part : world.intent.ratios)
    add(part.name, part.ratio);
  for (const std::string& part : world.intent.kept)
    add(part, 1);
  for (Index t = 0; t < run.prepared.fronts.size(); ++t) // a double counts where its front does
    share_of[t] = share_of[run.prepared.fronts[t]];
  // What is locked or frozen, by position. Coincident vertices that are not sewn hold further faces: how
  // many, only the report says. The share of each is open then, and with it the target.
  std::vector<char> is_held(soup.points.size() + world.obstacle.points.size(), false);
  const std::vector<char> is_locked = held(world, soup, true);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    if (is_locked[t] || run.prepared.is_frozen[t])
      for (const Index v : soup.triangles[t])
        is_held[run.prepared.positions[v]] = true;
  for (const Index v : world.intent.locked_vertices)
    is_held[run.prepared.positions[v]] = true;
  const auto is_fixed = [&](std::size_t t) {
    return std::all_of(soup.triangles[t].begin(), soup.triangles[t].end(),
                       [&](Index v) { return is_held[run.prepared.positions[v]]; });
  };
  const auto fixed_in = [&](std::size_t share) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < share_of.size(); ++t)
      count += share_of[t] == share && is_fixed(t);
    return count;
  };
  std::size_t fixed_in_all = 0;
  for (std::size_t share = 0; share < ratios.size(); ++share)
    fixed_in_all += fixed_in(share);
  if (report.faces_fixed < fixed_in_all || report.faces_fixed > soup.triangles.size())
    return broken("the report counts other faces that are fixed");
  if (report.faces_fixed != fixed_in_all)
    return std::nullopt;
  std::map<std::pair<Index, Index>, std::size_t> faces_at; // by the positions of an edge
  std::size_t most_at_edge = 2;
  for (const Index_triple& t : soup.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& positions = run.prepared.positions;
      const auto edge = std::minmax(positions[t[k]], positions[t[(k + 1) % 3]]);
      most_at_edge = std::max(most_at_edge, ++faces_at[edge]);
    }
  std::size_t target = 0, to_go = 0;
  for (std::size_t share = 0; share < ratios.size(); ++share) {
    const std::size_t before = std::size_t(std::count(share_of.begin(), share_of.end(), share));
    const std::size_t fixed = fixed_in(share);
    std::size_t aim = fixed + std::size_t(std::llround(ratios[share] * double(before - fixed)));
    if (share == 0)
      aim = std::max(world.options.ratio ? aim : 0, world.options.faces.value_or(0));
    const std::size_t now =
        std::size_t(std::count_if(run.result.triangles.begin(), run.result.triangles.end(),
                                  [&](Index t) { return share_of[t] == share; }));
    target += aim;
    to_go += now - std::min(now, aim);
    // The last collapse may take all faces of an edge where one was to go, in each place of a shared mesh.
    if (now + most_at_edge * std::max<std::size_t>(1, run.result.shared_places) < std::min(aim, before) + 1)
      return broken("a share has " + std::to_string(now) + " faces left, and was to keep " +
                    std::to_string(aim));
  }
  if (report.faces_target != target || report.faces_to_go != to_go || report.is_reached() != (to_go == 0))
    return broken("the report has another target, or distance to it");
  if ((report.outcome() == "reached") != (to_go == 0))
    return broken("the outcome is \"" + report.outcome() + '"');
  return std::nullopt;
}

// Normals are compared by their values: of two that differ in the sign of a zero, a corner may have either.
bool have_equal_normals(const Triangle_soup& a, const Triangle_soup& b)
{
  if (a.normals.of_triangle.size() != b.normals.of_triangle.size())
    return false;
  for (std::size_t t = 0; t < a.normals.of_triangle.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (a.normals.values[a.normals.of_triangle[t][k]] != b.normals.values[b.normals.of_triangle[t][k]])
        return false;
  return true;
}

Verdict judge_replay(const World& world, const World_run& run)
{
  std::istringstream stream(run.log);
  Log_reader reader(stream, "log");
  Replay_options options;
  if (!world.obstacle.triangles.empty() && world.seed % 4 != 0) // the others say that it was not judged
    options.obstacle = world.obstacle;
  const Replay_verdict verdict = replay(world.soup, world.input_format == Mesh_format::stl, reader, options);
  const auto broken = [](const std::string& what) { return Broken_promise{Promise::log_replay, what}; };
  if (!verdict.violations.empty()) {
    const Violation& first = verdict.violations.front();
    return broken(name(first.kind) + (": " + first.message) + " at step " + std::to_string(first.step));
  }
  if (!verdict.is_accepted() || !verdict.is_result_stated)
    return broken("not accepted, or the result is not stated");
  if (verdict.soup.triangles != run.result.soup.triangles ||
      !std::equal(verdict.soup.points.begin(), verdict.soup.points.end(), run.result.soup.points.begin(),
                  run.result.soup.points.end()) ||
      (run.result.placed_vertices == 0 && (verdict.soup.uvs.of_triangle != run.result.soup.uvs.of_triangle ||
                                           verdict.soup.uvs.values != run.result.soup.uvs.values ||
                                           (run.prepared.normals == Normals_treatment::kept &&
                                            !have_equal_normals(verdict.soup, run.result.soup)))))
    return broken("the log leads to another result");
  for (std::size_t pose = 0; pose < world.soup.poses.size(); ++pose) {
    if (!world.is_guarded(pose))
      continue;
    std::istringstream again(run.log);
    Log_reader reader_again(again, "log");
    options.pose = pose;
    const Replay_verdict in_pose =
        replay(world.soup, world.input_format == Mesh_format::stl, reader_again, options);
    if (!in_pose.violations.empty())
      return broken("in " + world.soup.poses[pose].name + ", " + name(in_pose.violations.front().kind) +
                    ": " + in_pose.violations.front().message + " at step " +
                    std::to_string(in_pose.violations.front().step));
  }
  return std::nullopt;
}

using Corner_points = std::array<Coordinates, 3>;

std::vector<Corner_points> corner_points(const Triangle_soup& soup, bool in_any_order)
{
  std::vector<Corner_points> result;
  for (const auto& [a, b, c] : soup.triangles) {
    result.push_back({coordinates(soup.points[a]), coordinates(soup.points[b]), coordinates(soup.points[c])});
    for (Coordinates& point : result.back())
      for (double& x : point)
        x += 0.; // one zero
    if (in_any_order)
      std::rotate(result.back().begin(), std::min_element(result.back().begin(), result.back().end()),
                  result.back().end());
  }
  if (in_any_order)
    std::sort(result.begin(), result.end());
  return result;
}

Verdict judge_file(const World& world, const World_run& run)
{
  const Triangle_soup &result = run.result.soup, &file = run.read_back;
  const bool is_scene = world.output_format == Mesh_format::glb || world.output_format == Mesh_format::gltf;
  if (corner_points(result, is_scene) != corner_points(file, is_scene))
    return Broken_promise{Promise::written, "the file has other triangles"};
  if (is_scene || world.is_sewn || world.output_format == Mesh_format::stl)
    return std::nullopt;
  // The vertices that the writer splits by flat normals, and those that the reader then joins.
  Triangle_soup expected = result;
  if (world.output_format == Mesh_format::ply && !file.normals.empty()) {
    for (Index i = 0; i < result.triangles.size(); ++i)
      for (Index k = 0; k < 3; ++k)
        if (!has_same_value(file.normals, i, result.normals, 3 * i + k, k))
          return Broken_promise{Promise::written, "the file has other normals"};
    if (has_vertices_of_several_normals(result))
      expected = split_by_normals(result);
    share_flat_vertices(expected);
  }
  if (file.triangles != expected.triangles || file.points.size() != expected.points.size() ||
      !std::equal(file.points.begin(), file.points.end(), expected.points.begin(), has_same_bits))
    return Broken_promise{Promise::written, "the file has other numbers or bits"};
  if (world.output_format != Mesh_format::obj)
    return std::nullopt;
  for (Index i = 0; i < result.triangles.size(); ++i) {
    bool is_same = has_same_label(file.groups, i, result.groups, i) &&
                   has_same_label(file.objects, i, result.objects, i) &&
                   has_same_label(file.materials, i, result.materials, i);
    for (Index k = 0; k < 3; ++k)
      is_same = is_same && has_same_value(file.uvs, i, result.uvs, 3 * i + k, k) &&
                has_same_value(file.normals, i, result.normals, 3 * i + k, k);
    if (!is_same)
      return Broken_promise{Promise::written, "the file has other values or labels"};
  }
  return std::nullopt;
}

// The triangles of a soup with all that their corners have, in an order of their own: instances become nodes
// in a progressive file, so that places of a mesh may follow each other otherwise.
std::vector<std::string> sorted_triangles(const Triangle_soup& soup, bool with_normals)
{
  std::vector<std::string> result;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    std::string& bytes = result.emplace_back();
    const auto add = [&bytes](const void* data, std::size_t size) {
      bytes.append(static_cast<const char*>(data), size);
    };
    const auto add_numbers = [&](const auto& numbers) { // zeros of either sign are one
      for (double number : numbers) {
        number += 0.0;
        add(&number, sizeof number);
      }
    };
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = soup.triangles[t][k];
      for (int axis = 0; axis < 3; ++axis) {
        const double coordinate = soup.points[v][axis];
        add(&coordinate, sizeof coordinate);
      }
      if (!soup.uvs.empty())
        add_numbers(soup.uvs.values[soup.uvs.of_triangle[t][k]]);
      if (with_normals && !soup.normals.empty())
        add_numbers(soup.normals.values[soup.normals.of_triangle[t][k]]);
      for (const Attribute& attribute : soup.vertex_attributes)
        add(attribute.rows.data() + v * row_size(attribute), row_size(attribute));
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

// The last level from the progressive file, against the result in a file of the same format.
Verdict judge_progressive_file(const World_run& run)
{
  const bool with_normals = run.prepared.normals == Normals_treatment::kept;
  if (!run.last_level ||
      sorted_triangles(*run.last_level, with_normals) == sorted_triangles(run.read_back, with_normals))
    return std::nullopt;
  return Broken_promise{Promise::progression, "the last level in a file has not the triangles of the result"};
}

/// One reduction of what is prepared; the complex is as it was before it.
Verdict judge_reduction(const World& world, const World_run& run, Judged_complex complex,
                        Judgement_counts& counts)
{
  for (const std::string& option : options_used(world))
    ++counts.options[option];
  const std::vector<char> is_held = held(world, run.prepared.soup, true);
  for (Index t = 0; t < is_held.size(); ++t)
    if (is_held[t])
      complex.freeze(t);
  for (const Index v : world.intent.locked_vertices)
    complex.freeze_position(complex.position(v));
  const auto turn_faces = [&] {
    for (Index t = 0; t < run.prepared.is_turned.size(); ++t)
      if (run.prepared.is_turned[t])
        complex.turn(t);
  };
  counts.turned += run.prepared.turned_faces();
  turn_faces();
  complex.find_seams(run.prepared.soup);
  if (world.options.clearance)
    complex.keep_clearance(*world.options.clearance);
  const std::vector<Index> regions = complex.regions();
  if (auto broken = judge_collapses(run, complex, counts))
    return broken;
  turn_faces(); // the result has the winding of the input
  if (auto broken = judge_attributes(world, run, complex, regions, is_held))
    return broken;
  if (auto broken = judge_pieces(run))
    return broken;
  if (auto broken = judge_sharing(run))
    return broken;
  if (run.result.shared_meshes > 0 && !run.collapses.empty())
    ++counts.options["shared_meshes"];
  if (run.prepared.doubles() > 0 && !run.collapses.empty())
    ++counts.options["doubles"];
  if (auto broken = judge_stop(world, run))
    return broken;
  if (!run.verification.accepted()) {
    const auto& mismatches = run.verification.matching.mismatches;
    return Broken_promise{Promise::verdict,
                          std::to_string(run.verification.new_pairs.size()) + " new pairs, topology " +
                              (run.verification.same_topology() ? "kept" : "changed") +
                              (mismatches.empty() ? "" : ", " + mismatches.front().message)};
  }
  return std::nullopt;
}

/// The same collapses in each further pose.
Verdict judge_poses(const World& world, const World_run& run)
{
  const Prepared_soup& prepared = run.prepared;
  for (std::size_t pose = 0; pose < prepared.soup.poses.size(); ++pose) {
    const World posed = in_pose(world, pose);
    const auto broken = [&](Promise promise, const std::string& what) {
      return Broken_promise{promise, what + " in the pose " + prepared.soup.poses[pose].name};
    };
    const Expected_start expected(posed);
    const std::vector<Point_3>& points = prepared.soup.poses[pose].points;
    if (expected.soup.triangles != prepared.soup.triangles || points.size() != expected.soup.points.size() ||
        !std::equal(points.begin(), points.end(), expected.soup.points.begin(), has_same_bits))
      return broken(Promise::preparation, "other triangles or points");
    Judged_complex complex(expected.soup, expected.obstacle);
    complex.permit(expected.part_of);
    const auto pairs = complex.offending_pairs();
    std::set<std::pair<Index, Index>> found;
    for (const Offending_pair& pair : prepared.offending_pairs_in_poses[pose])
      found.insert({pair.first, pair.second});
    if (found != pairs)
      return broken(Promise::preparation, std::to_string(found.size()) + " offending pairs found, of " +
                                              std::to_string(pairs.size()));
    if (world.defects == Defects::descend)
      complex.exempt(pairs);
    for (Index f = 0; f < expected.soup.triangles.size() + expected.obstacle.triangles.size(); ++f) {
      bool is_frozen = f >= expected.soup.triangles.size();
      if (!is_frozen)
        for (const Index v : expected.soup.triangles[f])
          is_frozen = is_frozen || expected.is_merged[v];
      if (world.defects != Defects::descend)
        for (const auto& [a, b] : pairs)
          is_frozen = is_frozen || a == f || b == f;
      if (is_frozen && !prepared.is_frozen[f])
        return broken(Promise::frozen, "triangle " + std::to_string(f) + " should be frozen, and is not");
      if (is_frozen)
        complex.freeze(f);
    }
    for (Index t = 0; t < prepared.is_turned.size(); ++t)
      if (prepared.is_turned[t])
        complex.turn(t);
    complex.find_seams(prepared.soup);
    if (world.options.clearance && world.is_guarded(pose))
      complex.keep_clearance(*world.options.clearance);
    for (const Soup_collapse& collapse : run.collapses)
      if (prepared.is_held[collapse.removed])
        return broken(Promise::frozen, "vertex " + std::to_string(collapse.removed) +
                                           " is coincident with others in some poses alone, and has moved");
    Judgement_counts uncounted;
    if (world.is_guarded(pose))
      if (auto verdict = judge_collapses(run, complex, uncounted))
        return broken(verdict->promise, verdict->message);
    const Triangle_soup& result = run.result.soup;
    for (Index i = 0; i < result.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const Index corner = run.result.corners[i][k];
        if (!has_same_bits(result.poses[pose].points[result.triangles[i][k]],
                           points[prepared.soup.triangles[corner / 3][corner % 3]]))
          return broken(Promise::attributes, "a point of another vertex");
      }
  }
  return std::nullopt;
}

Verdict judge_other_options(const World& world, const World_run& run, const Judged_complex& complex,
                            Judgement_counts& counts, std::size_t option_sets)
{
  for (std::size_t number = 1; number <= option_sets; ++number) {
    ++counts.option_sets;
    const World other = with_other_options(world, number);
    World_run again = run_again(other, run.prepared);
    again.prepared = run.prepared;
    again.verification = verify_guarded(other, again.result, again.prepared);
    if (auto broken = judge_reduction(other, again, complex, counts))
      return broken;
    if (auto broken = judge_poses(other, again))
      return broken;
  }
  return std::nullopt;
}

} // namespace

Verdict judge(const World& world, const World_run& run, Judgement_counts& counts,
              const Judgement_extent& extent)
{
  if (run.refusal)
    return judge_refusal(world, *run.refusal);
  const Expected_start expected(world);
  Judged_complex complex(expected.soup, expected.obstacle);
  complex.permit(expected.part_of);
  if (auto broken = judge_preparation(world, run, expected, complex))
    return broken;
  if (auto broken = judge_snaps(world, run, complex, counts))
    return broken;
  if (auto broken = judge_reduction(world, run, complex, counts))
    return broken;
  if (auto broken = judge_poses(world, run))
    return broken;
  if (extent.is_replay_asked)
    if (auto broken = judge_replay(world, run))
      return broken;
  if (auto broken = judge_file(world, run))
    return broken;
  if (auto broken = judge_progressive_file(run))
    return broken;
  return judge_other_options(world, run, complex, counts, extent.option_sets);
}

// Twins
// ----------------------------------------------------------------------------------------------------------

namespace {

// The places of the twin are those of the run, multiplied by 2^exponent.
Verdict compare(World_run twin, const World_run& run, const std::string& what, int exponent = 0)
{
  const auto broken = [&](const char* how) { return Broken_promise{Promise::determinism, what + how}; };
  if (twin.refusal.has_value() != run.refusal.has_value())
    return broken(": one of them is refused");
  for (Soup_collapse& collapse : twin.collapses)
    if (collapse.place)
      for (double& coordinate : *collapse.place)
        coordinate = std::ldexp(coordinate, -exponent);
  if (twin.collapses != run.collapses) {
    const auto differ = std::mismatch(twin.collapses.begin(), twin.collapses.end(), run.collapses.begin(),
                                      run.collapses.end());
    return Broken_promise{Promise::determinism,
                          what + ": other collapses from number " +
                              std::to_string(differ.first - twin.collapses.begin() + 1)};
  }
  if (twin.result.triangles != run.result.triangles || twin.result.corners != run.result.corners ||
      twin.result.soup.triangles != run.result.soup.triangles)
    return broken(": another result");
  return std::nullopt;
}

Verdict compare_bits(const World_run& twin, const World_run& run, const std::string& what)
{
  if (auto broken = compare(twin, run, what))
    return broken;
  const auto &a = twin.result.soup.points, &b = run.result.soup.points;
  if (a.size() != b.size() || !std::equal(a.begin(), a.end(), b.begin(), has_same_bits))
    return Broken_promise{Promise::determinism, what + ": other points"};
  return std::nullopt;
}

// Of runs that were told to stop at a question, one may have got farther than the other: the loop asks at
// every 256th edge that it considers, and a refused edge is considered again when the face in its way moves.
// Of several such faces, each index names another.
Verdict compare_beginnings(const World_run& twin, const World_run& run, const std::string& what)
{
  const bool is_twin_shorter = twin.collapses.size() < run.collapses.size();
  const World_run &shorter = is_twin_shorter ? twin : run, &longer = is_twin_shorter ? run : twin;
  if (shorter.collapses.size() == longer.collapses.size() || !shorter.result.report.is_stopped)
    return compare_bits(twin, run, what);
  if (!std::equal(shorter.collapses.begin(), shorter.collapses.end(), longer.collapses.begin()))
    return Broken_promise{Promise::determinism, what + ": other collapses before the first stop"};
  return std::nullopt;
}

template <class Function>
World with_points(const World& world, Function function)
{
  World twin = world;
  const auto change = [&](std::vector<Point_3>& points) {
    for (Point_3& p : points)
      p = Point_3(function(p.x()), function(p.y()), function(p.z()));
  };
  for (Triangle_soup* soup : {&twin.soup, &twin.obstacle}) {
    change(soup->points);
    for (Pose& pose : soup->poses)
      change(pose.points);
  }
  return twin;
}

/// A power of two by which all coordinates can be multiplied without loss; none when there is none but 1.
std::optional<int> random_exponent(const World& world, Random& random)
{
  int low = 2000, high = -2000;
  const auto add = [&](double x) {
    if (x != 0) {
      low = std::min(low, std::ilogb(x));
      high = std::max(high, std::ilogb(x));
    }
  };
  const auto add_all = [&](const std::vector<Point_3>& points) {
    for (const Point_3& p : points)
      for (int i = 0; i < 3; ++i)
        add(p[i]);
  };
  for (const Triangle_soup* soup : {&world.soup, &world.obstacle}) {
    add_all(soup->points);
    for (const Pose& pose : soup->poses)
      add_all(pose.points);
  }
  add(world.weld_distance);
  add(world.options.clearance.value_or(0));
  const bool is_rounded = world.prepare_options().round_to_float32;
  const int least = is_rounded ? -100 : -960, most = is_rounded ? 120 : 960;
  if (low > high || low < least || high > most)
    return std::nullopt;
  return random.between(least - low, most - high);
}

template <class Value>
std::vector<Value> reordered(const std::vector<Value>& values, const std::vector<Index>& order)
{
  std::vector<Value> result;
  for (std::size_t i = 0; i < std::min(order.size(), values.size()); ++i)
    result.push_back(values[order[i]]);
  return result;
}

void reorder(std::vector<Attribute>& attributes, const std::vector<Index>& order)
{
  for (Attribute& attribute : attributes) {
    const std::size_t size = row_size(attribute);
    std::vector<unsigned char> rows;
    for (const Index i : order)
      rows.insert(rows.end(), attribute.rows.begin() + i * size, attribute.rows.begin() + (i + 1) * size);
    attribute.rows = std::move(rows);
  }
}

std::vector<Index> random_order(std::size_t size, Random& random)
{
  std::vector<Index> order(size);
  std::iota(order.begin(), order.end(), Index(0));
  for (std::size_t i = size; i > 1; --i)
    std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

Triangle_soup permuted(Triangle_soup soup, Random& random)
{
  const std::vector<Index> vertices = random_order(soup.points.size(), random),
                           triangles = random_order(soup.triangles.size(), random);
  std::vector<Index> number(vertices.size());
  for (Index i = 0; i < vertices.size(); ++i)
    number[vertices[i]] = i;
  soup.points = reordered(soup.points, vertices);
  for (Pose& pose : soup.poses)
    pose.points = reordered(pose.points, vertices);
  reorder(soup.vertex_attributes, vertices);
  soup.triangles = reordered(soup.triangles, triangles);
  soup.polygons.clear();
  soup.uvs.of_triangle = reordered(soup.uvs.of_triangle, triangles);
  soup.normals.of_triangle = reordered(soup.normals.of_triangle, triangles);
  reorder(soup.triangle_attributes, triangles);
  for (auto* labels : {&soup.groups, &soup.objects, &soup.materials, &soup.smoothing_groups})
    labels->of_triangle = reordered(labels->of_triangle, triangles);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (Index& v : soup.triangles[t])
      v = number[v];
    const std::size_t first = random.below(3);
    for (auto* triple : {&soup.triangles, &soup.uvs.of_triangle, &soup.normals.of_triangle})
      if (!triple->empty())
        std::rotate((*triple)[t].begin(), (*triple)[t].begin() + first, (*triple)[t].end());
  }
  return soup;
}

/// Levels that one file holds are read as they were judged.
Verdict judge_file_of_levels(const World& world, const std::vector<Simplified_soup>& levels)
{
  std::vector<Triangle_soup> soups;
  for (const Simplified_soup& level : levels)
    soups.push_back(world.is_sewn ? merged_at_positions(level.soup) : level.soup);
  const bool is_gltf = world.output_format == Mesh_format::glb || world.output_format == Mesh_format::gltf;
  if (!is_gltf || std::any_of(soups.begin(), soups.end(), [&](const Triangle_soup& soup) {
        return soup.triangles.empty() ||
               soup.scene != soups.front().scene; // new places are in scenes of their own
      }))
    return std::nullopt;
  std::stable_sort(soups.begin(), soups.end(), [](const Triangle_soup& a, const Triangle_soup& b) {
    return a.triangles.size() > b.triangles.size();
  });
  const Temporary_folder folder;
  write_levels_of_detail(folder / "levels.glb", soups);
  for (std::size_t i = 0; i < soups.size(); ++i) {
    Read_options options;
    options.level_of_detail = i;
    if (corner_points(read_mesh(folder / "levels.glb", options).soup, true) != corner_points(soups[i], true))
      return Broken_promise{Promise::written,
                            "the file of all levels has other triangles in level " + std::to_string(i + 1)};
  }
  return std::nullopt;
}

Verdict judge_levels(const World& world, const World_run& run)
{
  const std::vector<Simplified_soup> levels =
      simplify_lods(run.prepared, world.options, world.lods, world.intent);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    World alone = world;
    alone.options.ratio = world.lods[i];
    alone.questions.reset(); // levels come from one run
    World_run level;
    level.result = levels[i];
    World_run run_alone = run_again(alone, run.prepared);
    run_alone.collapses.clear(); // levels of one run have no log
    if (auto broken =
            compare_bits(level, run_alone, "level " + std::to_string(i + 1) + " and a run to it alone"))
      return broken;
    if (levels[i].report.outcome() != run_alone.result.report.outcome())
      return Broken_promise{Promise::stop,
                            "level " + std::to_string(i + 1) + " has another outcome than a run to it alone"};
    if (!verify_guarded(world, levels[i], run.prepared).accepted())
      return Broken_promise{Promise::verdict, "level " + std::to_string(i + 1)};
  }
  return judge_file_of_levels(world, levels);
}

/// Cuts the world into pieces, reduces each by itself, and joins them: no pair of faces offends that did not,
/// and pieces that are not reduced are the world again.
Verdict judge_in_pieces(const World& world, Random& random)
{
  Triangle_soup whole;
  whole.points = world.soup.points;
  whole.triangles = world.soup.triangles;
  const Temporary_folder folder;
  write_mesh(folder / "whole.ply", whole);
  Cut_options cut_options;
  cut_options.cells = std::size_t(random.between(1, 5));
  cut_options.shift = random.one_in(2) ? 0.5 : 0;
  const Cut_mesh cut = cut_into_cells(folder / "whole.ply", cut_options,
                                      [&](std::size_t i) { return folder / (std::to_string(i) + ".ply"); });
  std::vector<Cell> cells;
  for (const Cell_piece& piece : cut.pieces)
    cells.push_back(piece.cell);
  Simplify_options options = world.options;
  options.ratio = 0;
  options.faces.reset();
  options.faces_per_cell = 0;
  options.guarded_poses.reset();
  options.placement = Placement::vertices;
  options.check_intersections = true;
  Simplify_intent intent;
  intent.kept = {std::string(fixed_property)};
  Prepare_options prepare_options;
  prepare_options.defects = Defects::freeze;
  prepare_options.orient = world.are_faces_oriented;

  Cell_join unchanged(cells), reduced(cells);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Triangle_soup piece = read_mesh(cut.pieces[i].file).soup;
    const std::string name = std::to_string(i + 1) + ".ply";
    unchanged.add(i, piece, piece, name, name);
    Triangle_soup result = piece;
    try {
      result = simplify_soup(prepare(piece, prepare_options), options, intent).soup;
    } catch (const Input_error&) { // no face has an area
    }
    reduced.add(i, piece, std::move(result), name, "reduced " + name);
  }
  const auto positions_of = [](const Triangle_soup& soup, Index triangle) {
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point_3& p = soup.points[soup.triangles[triangle][i]];
      corners[i] = {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
    }
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  const auto faces_of = [&](const Triangle_soup& soup) {
    std::multiset<std::array<std::array<double, 3>, 3>> faces;
    for (Index t = 0; t < soup.triangles.size(); ++t)
      faces.insert(positions_of(soup, t));
    return faces;
  };
  const auto pairs_of = [&](const Triangle_soup& soup) {
    std::set<std::set<std::array<std::array<double, 3>, 3>>> pairs;
    for (const auto& [a, b] : Judged_complex(soup, {}).offending_pairs())
      pairs.insert({positions_of(soup, a), positions_of(soup, b)});
    return pairs;
  };
  if (faces_of(unchanged.take()) != faces_of(whole))
    return Broken_promise{Promise::embedded, "pieces that are not reduced are not the whole"};
  const auto before = pairs_of(whole), after = pairs_of(reduced.take());
  if (!std::includes(before.begin(), before.end(), after.begin(), after.end()))
    return Broken_promise{Promise::embedded, "pieces that were reduced and joined have new offending pairs"};
  return std::nullopt;
}

} // namespace

Verdict judge_twins(const World& world, const World_run& run, Judgement_counts& counts,
                    const Judgement_extent& extent)
{
  // Cells ask whether to stop at the same time: which of them gets the answer depends on the threads.
  const bool is_repeatable = world.options.faces_per_cell == 0 || !world.questions;
  if (run.refusal || !is_repeatable)
    return std::nullopt;
  Random random(world.seed + 1);
  const bool is_scene = bool(world.soup.scene);
  if (random.one_in(2)) {
    ++counts.twins;
    World twin = world;
    twin.options.index =
        world.options.index == Face_index::packed ? Face_index::clusters : Face_index::packed;
    twin.options.faces_per_cluster = std::size_t(random.between(1, 30));
    if (auto broken = compare_beginnings(run_again(twin, run.prepared), run, "the other index"))
      return broken;
  }
  if (world.options.faces_per_cell > 0 || random.one_in(8)) {
    ++counts.twins;
    World_run twin;
    const int threads = random.between(2, 5);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
    tbb::task_arena(threads).execute([&] { twin = run_again(world, run.prepared); });
    if (auto broken = compare_bits(twin, run, "more threads"))
      return broken;
  }
  if (random.one_in(4) && !is_scene && world.input_format != Mesh_format::stl) {
    ++counts.twins;
    const World twin = with_points(world, [&](double x) { return x == 0 && random.one_in(2) ? -x : x; });
    if (auto broken = compare(run_without_output(twin), run, "zeros of another sign"))
      return broken;
  }
  if (random.one_in(2) && !is_scene)
    if (const std::optional<int> exponent = random_exponent(world, random)) {
      ++counts.twins;
      World twin = with_points(world, [&](double x) { return std::ldexp(x, *exponent); });
      twin.weld_distance = std::ldexp(world.weld_distance, *exponent);
      if (twin.options.clearance)
        twin.options.clearance = std::ldexp(*world.options.clearance, *exponent);
      if (auto broken = compare(run_without_output(twin), run,
                                "2^" + std::to_string(*exponent) + " times as large", *exponent))
        return broken;
    }
  if (random.one_in(4) && !is_scene && world.input_format != Mesh_format::stl) {
    ++counts.twins;
    World twin = world;
    twin.soup = permuted(world.soup, random);
    twin.obstacle = permuted(world.obstacle, random);
    if (auto broken = judge(twin, test::run(twin), counts, {extent.is_replay_asked, 0})) {
      broken->message += ", in another order";
      return broken;
    }
  }
  if (!world.lods.empty()) {
    ++counts.twins;
    if (auto broken = judge_levels(world, run))
      return broken;
  }
  if (random.one_in(8) && !is_scene && world.soup.poses.empty()) {
    ++counts.twins;
    return judge_in_pieces(world, random);
  }
  return std::nullopt;
}

Verdict judge(const World& world, Judgement_counts& counts, const Judgement_extent& extent)
{
  try {
    const World_run run = test::run(world);
    ++(run.refusal ? counts.refused_worlds : counts.worlds);
    if (auto broken = judge(world, run, counts, extent))
      return broken;
    return judge_twins(world, run, counts, extent);
  } catch (const std::exception& error) {
    return Broken_promise{Promise::refusal, error.what()};
  }
}

} // namespace selvedge::test
