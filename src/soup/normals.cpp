// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/normals.h>

#include "Disjoint_sets.h"
#include "inner_edges.h"
#include "near_normals.h"
#include "number_positions.h"
#include "selection.h"
#include "triangle_normals.h"

#include <selvedge/internal/Vector_of_doubles.h>
#include <selvedge/suited_normals.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

// Recognises how the normals of corners were made, and makes those of a result.

namespace selvedge {
namespace {

using internal::cross;
using internal::dot;
using internal::Edge_side;
using internal::for_each_inner_edge;
using shading::add;
using shading::angle_at;
using shading::cosines;
using shading::difference;
using shading::is_within;
using shading::normal_at;
using shading::s_cosine_of_shading;
using shading::s_cosine_smooth;
using shading::side_of;
using shading::stored;
using shading::unit;
using shading::unit_normal;
using shading::Vector;

// Cosines of 0.1°, 15° and 60°.
constexpr double s_cosine_flat = 0.9999984769;
constexpr double s_cosine_of_face = 0.9659258263;
constexpr double s_cosine_of_polygon = 0.5;

constexpr Index s_no_normal = std::numeric_limits<Index>::max();

// Returns that of a face of several triangles: the direction of its area.
Vector unit_normal(const Triangle_soup& soup, const std::vector<Index>& triangles)
{
  double largest = 0; // so that squares neither overflow nor underflow
  const auto side = [&](Index triangle, int k) {
    const Index_triple& corners = soup.triangles[triangle];
    return difference(soup.points[corners[k]], soup.points[corners[0]]);
  };
  for (const Index t : triangles)
    for (const int k : {1, 2})
      for (const double x : side(t, k))
        largest = std::max(largest, std::abs(x));
  if (!(largest > 0 && std::isfinite(largest)))
    return {};
  const int exponent = -std::ilogb(largest);
  Vector sum = {};
  for (const Index t : triangles) {
    Vector u = side(t, 1), v = side(t, 2);
    for (int i = 0; i < 3; ++i) {
      u[i] = std::scalbn(u[i], exponent);
      v[i] = std::scalbn(v[i], exponent);
    }
    const Vector area = cross(u, v);
    for (int i = 0; i < 3; ++i)
      sum[i] += area[i];
  }
  return unit(sum);
}

// Gives all corners of a face one new normal.
void set_normal(Triangle_soup& soup, const std::vector<Index>& face, const Vector& normal)
{
  const Index number = Index(soup.normals.values.size());
  soup.normals.values.push_back(stored(normal));
  for (const Index t : face)
    soup.normals.of_triangle[t] = {number, number, number};
}

// Calls function(triangles) for each face, in the order of their first triangles: those of a polygon, or one
// alone.
template <class Function>
void for_each_face(const Triangle_soup& soup, const Function& function)
{
  std::vector<Index> face;
  auto polygon = soup.polygons.begin();
  for (Index t = 0; t < soup.triangles.size();) {
    const bool is_polygon = polygon != soup.polygons.end() && polygon->first_triangle == t;
    const Index end = t + (is_polygon ? polygon++->corners - 2 : 1);
    face.clear();
    while (t < end)
      face.push_back(t++);
    function(face);
  }
}

void restore_flat(Triangle_soup& soup)
{
  soup.normals = {{}, std::vector<Index_triple>(soup.triangles.size())};
  for_each_face(soup, [&](const std::vector<Index>& face) {
    set_normal(soup, face, face.size() == 1 ? unit_normal(soup, face[0]) : unit_normal(soup, face));
  });
}

void restore_smooth(Triangle_soup& soup)
{
  Corner_values<3>& normals = soup.normals;
  std::map<std::pair<Index, Index>, Index> numbers; // by vertex and old value
  std::vector<Vector> sums;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    if (!normals.has(t))
      continue;
    const Vector normal = unit_normal(soup, t);
    for (int k = 0; k < 3; ++k) {
      Index& value = normals.of_triangle[t][k];
      const auto [place, is_new] =
          numbers.emplace(std::make_pair(soup.triangles[t][k], value), Index(sums.size()));
      if (is_new)
        sums.push_back({});
      value = place->second;
      add(sums[value], normal, angle_at(soup, 3 * t + k));
    }
  }
  const Index count = Index(sums.size());
  if (normals.missing) {
    sums.push_back({0, 0, 0}); // unlike every normal
    for (Index_triple& triple : normals.of_triangle)
      if (triple[0] == normals.missing)
        triple = {count, count, count};
    normals.missing = count;
  }
  for (Index i = 0; i < count; ++i)
    sums[i] = stored(unit(sums[i]));
  normals.values = std::move(sums);
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    if (!normals.has(t))
      continue;
    const Vector normal = unit_normal(soup, t);
    Index number = s_no_normal;
    for (std::size_t k = 0; k < 3; ++k) {
      if (dot(normal_at(normals, t, k), normal) >= 0)
        continue;
      if (number == s_no_normal) {
        number = Index(normals.values.size());
        normals.values.push_back(stored(normal));
      }
      normals.of_triangle[t][k] = number;
    }
  }
}

} // namespace

const char* name_of(Normals_choice choice)
{
  switch (choice) {
  case Normals_choice::automatic:
    return "auto";
  case Normals_choice::keep:
    return "keep";
  case Normals_choice::mend:
    return "mend";
  case Normals_choice::loose:
    return "loose";
  case Normals_choice::soft:
    return "soft";
  case Normals_choice::recompute:
    return "recompute";
  case Normals_choice::smooth:
    return "smooth";
  default:
    return "drop";
  }
}

const char* name_of(Normals_treatment treatment)
{
  switch (treatment) {
  case Normals_treatment::kept:
    return "kept";
  case Normals_treatment::mended:
    return "mended";
  case Normals_treatment::picked:
    return "picked";
  case Normals_treatment::softened:
    return "softened";
  case Normals_treatment::fitted:
    return "fitted";
  case Normals_treatment::smoothed:
    return "smoothed";
  case Normals_treatment::flat:
    return "flat";
  case Normals_treatment::smooth:
    return "smooth";
  case Normals_treatment::dropped:
    return "dropped";
  default:
    return "none";
  }
}

bool has_flat_normals(const Triangle_soup& soup)
{
  if (soup.normals.empty() || soup.normals.missing)
    return false;
  std::size_t judged = 0, others = 0;
  for (Index t = 0; t < soup.triangles.size() && 100 * others <= 3 * soup.triangles.size(); ++t) {
    const Vector normal = unit_normal(soup, t);
    if (normal == Vector{})
      continue;
    const auto value = [&](int k) { return soup.normals.values[soup.normals.of_triangle[t][k]]; };
    const bool is_of_polygon = is_within(value(0), value(1), s_cosine_flat) &&
                               is_within(value(0), value(2), s_cosine_flat) &&
                               is_within(value(0), normal, s_cosine_of_polygon);
    for (int k = 0; k < 3; ++k) {
      ++judged;
      others += !is_of_polygon && !is_within(value(k), normal, s_cosine_flat);
    }
  }
  return judged > 0 && 100 * others <= judged;
}

Normals_treatment take_normals(Triangle_soup& soup, Normals_choice choice, Corner_values<3>* taken)
{
  if (choice == Normals_choice::smooth) {
    smooth_normals(soup);
    return Normals_treatment::smoothed;
  }
  if (soup.normals.empty())
    return Normals_treatment::none;
  if (choice == Normals_choice::keep)
    return Normals_treatment::kept;
  const bool is_flat = choice != Normals_choice::drop && has_flat_normals(soup);
  if (choice == Normals_choice::soft && !is_flat) {
    if (taken)
      *taken = soup.normals;
    loosen_soft_lines(soup);
    return Normals_treatment::softened;
  }
  if ((choice == Normals_choice::automatic || choice == Normals_choice::mend) && !is_flat) {
    join_near_normals(soup);
    return choice == Normals_choice::mend ? Normals_treatment::mended : Normals_treatment::fitted;
  }
  if (choice == Normals_choice::recompute && !is_flat) {
    join_normals_between_hard_edges(soup);
    return Normals_treatment::smooth;
  }
  Corner_values<3> normals = std::exchange(soup.normals, {});
  if (choice == Normals_choice::drop)
    return Normals_treatment::dropped;
  if (taken && choice != Normals_choice::recompute)
    *taken = std::move(normals);
  return is_flat ? Normals_treatment::flat : Normals_treatment::picked;
}

bool joins_vertices(Normals_choice choice)
{
  return choice == Normals_choice::drop || choice == Normals_choice::loose ||
         choice == Normals_choice::soft || choice == Normals_choice::smooth;
}

void pick_normals(Triangle_soup& result, const std::vector<Index>& triangles,
                  const std::vector<Index_triple>& corners, const Triangle_soup& original,
                  const Corner_values<3>& normals)
{
  const auto vertex_of = [&](Index corner) { return original.triangles[corner / 3][corner % 3]; };
  const auto number_at = [&](Index corner) { return normals.of_triangle[corner / 3][corner % 3]; };
  const Index corner_count = Index(3 * original.triangles.size());
  std::vector<Index> firsts(original.points.size() + 1, 0); // in the next list, by vertex
  for (Index corner = 0; corner < corner_count; ++corner)
    ++firsts[vertex_of(corner)];
  std::partial_sum(firsts.begin(), firsts.end(), firsts.begin());
  std::vector<Index> by_vertex(corner_count); // corners
  for (Index corner = corner_count; corner-- > 0;)
    by_vertex[--firsts[vertex_of(corner)]] = corner;

  const Corner_values<3>& fans = original.normals;
  const auto fan_of = [&](Index corner) {
    return fans.empty() ? 0 : fans.of_triangle[corner / 3][corner % 3];
  };
  std::vector<Vector> values = normals.values;
  values.insert(values.end(), result.normals.values.begin(), result.normals.values.end());
  std::vector<Index_triple> picked;
  for (Index i = 0; i < result.triangles.size(); ++i) {
    const Index t = triangles[i];
    Index_triple& numbers = picked.emplace_back(normals.of_triangle[t]);
    if (numbers[0] == normals.missing || corners[i] == Index_triple{3 * t, 3 * t + 1, 3 * t + 2})
      continue;
    const Vector front = unit_normal(result, i);
    const double side = side_of(cosines(unit_normal(original, t), normals, t)) < 0 ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = vertex_of(corners[i][k]);
      const Index fan = fan_of(corners[i][k]);
      const auto is_of_fan = [&](Index corner) { return fan_of(corner) == fan; };
      const auto is_like_fan = [&](Index corner) {
        return !is_of_fan(corner) || are_near_normals(normals.values[number_at(corner)], fans.values[fan]);
      };
      const auto first = by_vertex.begin() + firsts[v], last = by_vertex.begin() + firsts[v + 1];
      if (!fans.empty() && std::all_of(first, last, is_like_fan)) {
        const Index kept = result.normals.of_triangle[i][k];
        numbers[k] = result.normals.values[kept] == fans.values[fan]
                         ? number_at(*std::find_if(first, last, is_of_fan))
                         : Index(normals.values.size()) + kept; // at a new place
        continue;
      }
      double highest = -std::numeric_limits<double>::infinity();
      for (Index j = firsts[v]; j < firsts[v + 1]; ++j) {
        const Index number = number_at(by_vertex[j]);
        if (number == normals.missing || fan_of(by_vertex[j]) != fan)
          continue;
        const double cosine = side * dot(front, unit(normals.values[number]));
        if (cosine > highest) {
          highest = cosine;
          numbers[k] = number;
        }
      }
    }
  }
  result.normals = with_used(values, std::move(picked), normals.missing);
}

bool are_near_normals(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
  return is_within(a, b, s_cosine_flat);
}

void join_near_normals(Triangle_soup& soup)
{
  struct Entry
  {
    Index normal;
    Index next; // of the same vertex
  };
  Corner_values<3>& normals = soup.normals;
  std::vector<Entry> entries;
  std::vector<Index> first(soup.points.size(), s_no_normal), last(soup.points.size(), s_no_normal);
  for (std::size_t t = 0; t < normals.of_triangle.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      Index& normal = normals.of_triangle[t][k];
      const Index v = soup.triangles[t][k];
      if (normal == normals.missing)
        continue;
      Index found = first[v];
      while (found != s_no_normal && entries[found].normal != normal &&
             !are_near_normals(normals.values[entries[found].normal], normals.values[normal]))
        found = entries[found].next;
      if (found == s_no_normal) {
        found = Index(entries.size());
        (first[v] == s_no_normal ? first[v] : entries[last[v]].next) = found;
        last[v] = found;
        entries.push_back({normal, s_no_normal});
      }
      normal = entries[found].normal;
    }
}

void join_normals_between_hard_edges(Triangle_soup& soup)
{
  Corner_values<3>& normals = soup.normals;
  const auto value = [&](Index corner) { return normals.of_triangle[corner / 3][corner % 3]; };
  const auto is_smooth_between = [&](Index a, Index b) {
    return value(a) == value(b) ||
           (value(a) != normals.missing && value(b) != normals.missing &&
            is_within(normals.values[value(a)], normals.values[value(b)], s_cosine_smooth));
  };
  internal::Disjoint_sets fans(3 * soup.triangles.size()); // of corners
  for_each_inner_edge(soup.triangles, [&](const Edge_side& a, const Edge_side& b) {
    if (is_smooth_between(a.at_low, b.at_low) && is_smooth_between(a.at_high, b.at_high)) {
      fans.unite(a.at_low, b.at_low);
      fans.unite(a.at_high, b.at_high);
    }
  });
  std::vector<Index_triple> joined = normals.of_triangle;
  for (Index corner = 0; corner < 3 * joined.size(); ++corner)
    joined[corner / 3][corner % 3] = value(Index(fans.find(corner)));
  normals.of_triangle = std::move(joined);
}

void keep_flat_normals(Triangle_soup& result, const std::vector<Index>& triangles,
                       const Triangle_soup& original, const Corner_values<3>& normals)
{
  const auto old = [&](Index corner) {
    return normals.values[normals.of_triangle[triangles[corner / 3]][corner % 3]];
  };
  const auto made = [&](Index t) { return result.normals.values[result.normals.of_triangle[t][0]]; };
  const auto is_made_within = [&](Index t, double cosine) {
    const Vector normal = made(t);
    return is_within(old(3 * t), normal, cosine) && is_within(old(3 * t + 1), normal, cosine) &&
           is_within(old(3 * t + 2), normal, cosine);
  };
  const auto is_in_its_place = [&](Index t) {
    for (std::size_t k = 0; k < 3; ++k)
      if (result.points[result.triangles[t][k]] != original.points[original.triangles[triangles[t]][k]])
        return false;
    return true;
  };
  const std::size_t count = result.triangles.size();
  internal::Disjoint_sets sets(count); // of triangles
  for_each_face(result, [&](const std::vector<Index>& polygon) {
    for (const Index t : polygon)
      sets.unite(polygon[0], t);
  });
  for_each_inner_edge(result.triangles, [&](const Edge_side& a, const Edge_side& b) {
    const Index t = a.at_low / 3, u = b.at_low / 3;
    if (old(a.at_low) == old(b.at_low) && old(a.at_high) == old(b.at_high) &&
        is_made_within(t, s_cosine_of_face) && is_made_within(u, s_cosine_of_face))
      sets.unite(t, u);
  });
  std::vector<Index> ends(count + 1, 0), by_set(count); // triangles, those of a set after each other
  for (Index t = 0; t < count; ++t)
    ++ends[sets.find(t) + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  for (Index t = 0; t < count; ++t)
    by_set[ends[sets.find(t)]++] = t; // so that the end of a set is where the next one began
  std::vector<Index_triple> kept(count, {s_no_normal, s_no_normal, s_no_normal});
  std::vector<Index> face;
  for (std::size_t set = 0, first = 0; set < count; first = ends[set++]) {
    face.assign(by_set.begin() + std::ptrdiff_t(first), by_set.begin() + std::ptrdiff_t(ends[set]));
    const bool is_of_several =
        std::any_of(face.begin(), face.end(), [&](Index t) { return made(t) != made(face[0]); });
    if (is_of_several)
      set_normal(result, face, unit_normal(result, face));
    const bool keeps = std::all_of(face.begin(), face.end(), [&](Index t) {
      return is_in_its_place(t) || is_made_within(t, s_cosine_flat);
    });
    for (const Index t : face)
      if (keeps)
        kept[t] = normals.of_triangle[triangles[t]];
  }
  for (std::size_t t = 0; t < count; ++t)
    if (kept[t][0] == s_no_normal)
      for (std::size_t k = 0; k < 3; ++k)
        kept[t][k] = Index(normals.values.size()) + result.normals.of_triangle[t][k];
  std::vector<Vector> values = normals.values;
  values.insert(values.end(), result.normals.values.begin(), result.normals.values.end());
  result.normals = with_used(values, std::move(kept), std::nullopt);
}

void restore_normals(Triangle_soup& soup, Normals_treatment treatment)
{
  if (treatment == Normals_treatment::flat)
    restore_flat(soup);
  else if (treatment == Normals_treatment::smooth)
    restore_smooth(soup);
}

} // namespace selvedge
