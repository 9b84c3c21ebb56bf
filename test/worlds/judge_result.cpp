// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "judge_result.h"

#include "same_bits.h"

#include "soup/Gltf_scene.h"
#include "soup/selection.h"
#include <selvedge/Parts.h>
#include <selvedge/rounding.h>
#include <selvedge/verify.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {

bool has_same_label(const Triangle_labels& result, Index triangle, const Triangle_labels& original,
                    Index from)
{
  if (result.empty() || original.empty())
    return result.empty() == original.empty();
  return result.names[result.of_triangle[triangle]] == original.names[original.of_triangle[from]];
}

namespace {

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

// Returns the cosine of the angle between a normal and a triangle's normal, rounded from the exact number;
// NaN for a needle, whose normal is not known in double.
double cosine(const std::array<double, 3>& normal, const Triangle_soup& soup, Index triangle)
{
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  const auto point = [&](std::size_t k) {
    const Point_3& p = soup.points[soup.triangles[triangle][k]];
    return Exact::Point_3(p.x(), p.y(), p.z());
  };
  const Exact::Vector_3 u = point(1) - point(0), v = point(2) - point(0), n(normal[0], normal[1], normal[2]);
  const Exact::Vector_3 front = CGAL::cross_product(u, v);
  if (n == CGAL::NULL_VECTOR || front.squared_length() <= 1e-18 * u.squared_length() * v.squared_length())
    return NAN;
  const Exact::FT height = front * n;
  return int(CGAL::sign(height)) *
         std::sqrt(CGAL::to_double(height * height / (front.squared_length() * n.squared_length())));
}

using Normal = std::array<double, 3>;

constexpr double s_cosine_of_border = 0.9409; // of 19.8°: 20°, and normals up to 0.1° apart may be one

// Returns the cosine of the angle between two normals; NaN for one of length zero.
double cosine(const Normal& a, const Normal& b)
{
  const auto dot = [](const Normal& u, const Normal& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
  return dot(a, b) / std::sqrt(dot(a, a)) / std::sqrt(dot(b, b));
}

Normal normal_of(const Corner_values<3>& normals, Index triangle, std::size_t place)
{
  return normals.values[normals.of_triangle[triangle][place]];
}

// Whether a normal may belong to another side than some triangle at a position of the result.
bool may_be_wrong(const Triangle_soup& result, const Point_3& here, const Normal& normal, int side)
{
  constexpr double margin = 1e-6; // NaN is beyond no limit
  for (Index j = 0; j < result.triangles.size(); ++j)
    for (const Index v : result.triangles[j])
      if (result.points[v] == here && !(side * cosine(normal, result, j) > 0.5 + margin))
        return true;
  return false;
}

// Returns why a corner of a result must not have its normal, or null. It has one of `old`, those of the
// original at its vertex, unless these are farther from the normal of the triangle than 60° and than all
// three of the original were, or from that of another triangle there.
const char* wrong_in_mended_normal(const Triangle_soup& result, Index i, std::size_t k,
                                   const Triangle_soup& original, const Corner_values<3>& normals, Index t,
                                   const std::vector<Normal>& old)
{
  constexpr double margin = 1e-6; // NaN is beyond no limit
  const Normal now = normal_of(result.normals, i, k);
  std::array<double, 3> before;
  for (std::size_t j = 0; j < 3; ++j)
    before[j] = cosine(normal_of(normals, t, j), original, t);
  const double sum = before[0] + before[1] + before[2];
  if (std::find(old.begin(), old.end(), now) != old.end()) {
    const double side = sum < 0 ? -1 : 1;
    const double limit = std::min({0.5, side * before[0], side * before[1], side * before[2]});
    return std::abs(sum) > margin && side * cosine(now, result, i) < limit - margin
               ? "a normal of another side"
               : nullptr;
  }
  const Point_3& here = result.points[result.triangles[i][k]];
  for (const int side : {1, -1}) {
    // Another triangle at this place may have taken this one along.
    const auto may_be_replaced = [&](const Normal& normal) {
      return may_be_wrong(result, here, normal, side);
    };
    if (!(side * sum < -margin) && std::any_of(old.begin(), old.end(), may_be_replaced) &&
        !(side * cosine(now, result, i) < 0.5 - margin) && is_unit(result.normals, i, k))
      return nullptr;
  }
  return "a new normal in place of one that is near, or one that is not";
}

using Position = std::array<double, 3>;

Position position(const Triangle_soup& soup, Index vertex)
{
  const Point_3& p = soup.points[vertex];
  return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}; // no −0
}

// Returns the positions at the ends of edges that one triangle has.
std::set<Position> positions_on_borders(const Triangle_soup& soup)
{
  std::map<std::set<Position>, std::size_t> counts; // by edge
  for (const Index_triple& triangle : soup.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      ++counts[{position(soup, triangle[k]), position(soup, triangle[(k + 1) % 3])}];
  std::set<Position> result;
  for (const auto& [edge, count] : counts)
    if (count == 1)
      result.insert(edge.begin(), edge.end());
  return result;
}

// Returns whether a triangle of the result is one of the original, with the same corners at the same places.
bool is_as_it_was(const World_run& run, Index i)
{
  const Triangle_soup &result = run.result.soup, &original = run.prepared.soup;
  const Index t = run.result.triangles[i];
  bool is_same = run.result.corners[i] == Index_triple{3 * t, 3 * t + 1, 3 * t + 2};
  for (std::size_t k = 0; k < 3; ++k)
    is_same = is_same && result.points[result.triangles[i][k]] == original.points[original.triangles[t][k]];
  return is_same;
}

// Returns the positions in a result at which a triangle has changed.
std::set<Position> positions_of_changes(const World_run& run)
{
  std::set<Position> result;
  for (Index i = 0; i < run.result.soup.triangles.size(); ++i)
    if (!is_as_it_was(run, i))
      for (const Index v : run.result.soup.triangles[i])
        result.insert(position(run.result.soup, v));
  return result;
}

// Returns which triangles of the original are frozen, or of parts that are locked or kept.
std::vector<char> triangles_that_stay(const World& world, const World_run& run)
{
  std::vector<char> result = run.prepared.is_frozen;
  for (const auto* names : {&world.intent.locked, &world.intent.kept})
    for (const std::string& name : *names) {
      const std::vector<char> is_named = triangles_named(run.prepared.soup, name);
      for (Index t = 0; t < is_named.size(); ++t)
        result[t] |= is_named[t];
    }
  return result;
}

// A vertex, and what its corners of one fan have in the prepared original, if that has normals.
using Fan = std::pair<Index, Index>;

Fan fan_of(const Triangle_soup& original, Index corner)
{
  return {original.triangles[corner / 3][corner % 3],
          original.normals.empty() ? 0 : original.normals.of_triangle[corner / 3][corner % 3]};
}

// Returns the normals of the original in each fan.
std::map<Fan, std::vector<Normal>> normals_of_fans(const Triangle_soup& original,
                                                   const Corner_values<3>& normals)
{
  std::map<Fan, std::vector<Normal>> result;
  for (Index t = 0; t < original.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3 && normals.of_triangle[t][0] != normals.missing; ++k)
      result[fan_of(original, Index(3 * t + k))].push_back(normal_of(normals, t, k));
  return result;
}

// Judges the normals of a result that are fitted, after some were picked or not: those of triangles that
// stay, or around which nothing has changed, are what they were, those on borders are so too, picked or
// mended, or differ by more than 20°, and no other one is farther from that of its triangle than was
// promised.
Verdict judge_fitted_normals(const World& world, const World_run& run, const std::set<std::size_t>& placed)
{
  constexpr double margin = 1e-6, limit = 0.2; // NaN is beyond no limit
  const Triangle_soup &result = run.result.soup, &original = run.prepared.soup;
  const bool is_picked = are_picked(run.prepared.normals);
  const bool may_be_placed = run.prepared.normals != Normals_treatment::picked;
  if (!is_picked && run.prepared.normals != Normals_treatment::fitted)
    return std::nullopt;
  const Corner_values<3>& normals = is_picked ? run.prepared.taken_normals : original.normals;
  std::map<Fan, std::vector<Normal>> of_fans;
  if (is_picked)
    of_fans = normals_of_fans(original, normals);
  if (result.normals.of_triangle.size() != result.triangles.size())
    return Broken_promise{Promise::attributes, "the result has no normals"};
  const std::set<Position> on_borders = positions_on_borders(result), changes = positions_of_changes(run);
  const std::vector<char> stays = triangles_that_stay(world, run);
  for (Index i = 0; i < result.triangles.size(); ++i) {
    const Index t = run.result.triangles[i];
    const bool is_missing = result.normals.of_triangle[i][0] == result.normals.missing;
    const auto broken = [&](const char* what) {
      return Broken_promise{Promise::attributes, "triangle " + std::to_string(i) + " of the result: " + what};
    };
    if (is_missing != (normals.of_triangle[t][0] == normals.missing))
      return broken("it has lost or got normals");
    if (is_missing)
      continue;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += cosine(normal_of(normals, t, k), original, t);
    const double side = sum < 0 ? -1 : 1;
    const bool is_left = run.result.corners[i] == Index_triple{3 * t, 3 * t + 1, 3 * t + 2};
    for (std::size_t k = 0; k < 3; ++k) {
      const Index corner = run.result.corners[i][k];
      const Position here = position(result, result.triangles[i][k]);
      const Normal now = normal_of(result.normals, i, k);
      const Index vertex = original.triangles[corner / 3][corner % 3];
      std::vector<Normal> old = {normal_of(normals, corner / 3, corner % 3)};
      if (is_picked && !is_left) {
        old = of_fans[fan_of(original, corner)];
        if (old.empty())
          old.push_back(normal_of(normals, t, k));
      }
      if (std::find(old.begin(), old.end(), now) != old.end() || (may_be_placed && placed.count(vertex) > 0))
        continue;
      if (is_as_it_was(run, i) && (stays[t] != 0 || changes.count(here) == 0))
        return broken("another normal, and nothing has changed");
      if (!is_unit(result.normals, i, k))
        return broken("a new normal of another length");
      double nearest = -1;
      for (const Normal& normal : old)
        nearest = std::max(nearest, side * cosine(normal, result, i));
      // On a border, it is far from the old one, or from one that was mended. If that was picked, it was the
      // nearest to that of the triangle, or one that is nearly like it.
      const auto may_give_way = [&](const Normal& normal) {
        const bool may_be_picked =
            !is_picked || is_left || !(side * cosine(normal, result, i) < nearest - 0.01);
        return may_be_picked && !(cosine(now, normal) >= s_cosine_of_border + margin);
      };
      const auto may_be_mended = [&](const Normal& normal) {
        const Point_3& point = result.points[result.triangles[i][k]];
        return (!(sum < -margin) && may_be_wrong(result, point, normal, 1)) ||
               (!(sum > margin) && may_be_wrong(result, point, normal, -1));
      };
      if (on_borders.count(here) > 0 && std::none_of(old.begin(), old.end(), may_give_way) &&
          (std::none_of(old.begin(), old.end(), may_be_mended) ||
           (std::abs(sum) > margin && side * cosine(now, result, i) < limit - margin)))
        return broken("on a border, a new normal that is near the old one");
      if (std::abs(sum) > margin && side * cosine(now, result, i) < std::min(limit, nearest) - margin)
        return broken("a new normal of another side");
    }
  }
  return std::nullopt;
}

// Judges the normals of a result that are kept, but for those that are mended.
Verdict judge_mended_normals(const World_run& run, const std::set<std::size_t>& placed)
{
  const Triangle_soup &result = run.result.soup, &original = run.prepared.soup;
  const Corner_values<3>& normals = original.normals;
  if (run.prepared.normals != Normals_treatment::mended)
    return std::nullopt;
  if (result.normals.of_triangle.size() != result.triangles.size())
    return Broken_promise{Promise::attributes, "the result has no normals"};
  for (Index i = 0; i < result.triangles.size(); ++i) {
    const Index t = run.result.triangles[i];
    const bool is_missing = result.normals.of_triangle[i][0] == result.normals.missing;
    if (is_missing != (normals.of_triangle[t][0] == normals.missing))
      return Broken_promise{Promise::attributes, "a triangle has lost or got normals"};
    for (std::size_t k = 0; k < 3 && !is_missing; ++k) {
      const Index corner = run.result.corners[i][k];
      const Normal old = normal_of(normals, corner / 3, corner % 3);
      if (placed.count(original.triangles[corner / 3][corner % 3]) == 0)
        if (const char* const what = wrong_in_mended_normal(result, i, k, original, normals, t, {old}))
          return Broken_promise{Promise::attributes,
                                "triangle " + std::to_string(i) + " of the result: " + what};
    }
  }
  return std::nullopt;
}

// The worlds have attributes of one component, in floating point, or integers that are not mixed; and
// tangents, whose sides are not mixed either.
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
    if (before.name == "TANGENT" && side_of_tangent(now, row) != side_of_tangent(before, from))
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

} // namespace

Verdict judge_attributes(const World& world, const World_run& run, const Judged_complex& complex,
                         const std::vector<Index>& regions, const std::vector<char>& is_held)
{
  const Triangle_soup &result = run.result.soup, &original = run.prepared.soup;
  if (result.triangles.size() != complex.own_faces_alive() ||
      run.result.triangles.size() != result.triangles.size() ||
      run.result.corners.size() != result.triangles.size())
    return Broken_promise{Promise::attributes, "the result has not the triangles that the collapses leave"};
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
        if (!is_value_between(result.uvs, i, original.uvs, k) || !is_unit(result.normals, i, k) ||
            !are_rows_between(result.vertex_attributes, v, original.vertex_attributes, from))
          return broken("a value at a new place that is no mixture of the input's");
      } else if (!has_same_value(result.uvs, i, original.uvs, corner, k) ||
                 (run.are_normals_kept() &&
                  !has_same_value(result.normals, i, original.normals, corner, k)) ||
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
  if (auto broken = judge_mended_normals(run, placed))
    return broken;
  if (auto broken = judge_fitted_normals(world, run, placed))
    return broken;
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

} // namespace selvedge::test
