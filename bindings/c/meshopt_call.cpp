// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "meshopt_call.h"

#include "bindings/run/soup_of.h"
#include "selvedge_c.h"

#include <selvedge/simplify.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::bindings {
namespace {

constexpr unsigned int known_options = selvedge_SimplifyLockBorder | selvedge_SimplifySparse |
                                       selvedge_SimplifyErrorAbsolute | selvedge_SimplifyRegularize |
                                       selvedge_SimplifyPermissive | selvedge_SimplifyRegularizeLight;
constexpr unsigned int prune = 1 << 3;
constexpr std::size_t most_attributes = 32;
constexpr Index none = Index(-1);
constexpr const char* priority = "priority";

void check(const Meshopt_call& call)
{
  if (!call.destination && call.index_count > 0)
    throw Argument_error("destination is a null pointer");
  check_arrays(call.positions, call.vertex_count, call.indices, call.index_count);
  if (call.positions_stride < 3 * sizeof(float))
    throw Argument_error("the stride of positions, " + std::to_string(call.positions_stride) +
                         " bytes, is less than three floats");
  if (!(call.target_error >= 0))
    throw Argument_error("target_error is not a number of at least 0");
  if (call.options & prune)
    throw Argument_error("the option Prune is refused: no piece is ever removed");
  if (call.options & ~known_options)
    throw Argument_error("the options have a bit that is unknown: " + std::to_string(call.options));
  if (call.attribute_count > most_attributes)
    throw Argument_error("attribute_count is more than " + std::to_string(most_attributes));
  if (call.attribute_count == 0)
    return;
  if (!call.attributes || !call.attribute_weights)
    throw Argument_error("attributes or their weights are a null pointer");
  if (call.attributes_stride < call.attribute_count * sizeof(float))
    throw Argument_error("the stride of attributes is less than their number of floats");
  for (std::size_t i = 0; i < call.attribute_count; ++i)
    if (!(call.attribute_weights[i] >= 0) || std::isinf(call.attribute_weights[i]))
      throw Argument_error("the weight of attribute " + std::to_string(i) +
                           " is not a finite number of at least 0");
}

std::array<float, 3> position(const Meshopt_call& call, std::size_t vertex)
{
  std::array<float, 3> result;
  std::memcpy(result.data(), reinterpret_cast<const char*>(call.positions) + vertex * call.positions_stride,
              sizeof result);
  return result;
}

/// The vertices that triangles use, in the order of their numbers: of the others nothing is known, not even
/// that they are finite.
std::vector<unsigned int> used_vertices(const Meshopt_call& call)
{
  std::vector<char> is_used(call.vertex_count, false);
  for (std::size_t i = 0; i < call.index_count; ++i) {
    check_index(call.indices, i, call.vertex_count);
    is_used[call.indices[i]] = true;
  }
  std::vector<unsigned int> used;
  for (std::size_t v = 0; v < call.vertex_count; ++v)
    if (is_used[v])
      used.push_back(static_cast<unsigned int>(v));
  return used;
}

/// The sides of a bounding box.
class Box
{
public:
  template <class Point>
  void add(const Point& point)
  {
    for (std::size_t i = 0; i < 3; ++i) {
      m_least[i] = std::min(m_least[i], double(point[i]));
      m_largest[i] = std::max(m_largest[i], double(point[i]));
    }
  }
  double longest() const { return std::max({side(0), side(1), side(2)}); }
  double diagonal() const { return std::hypot(side(0), side(1), side(2)); }

private:
  double side(std::size_t i) const { return std::max(0., m_largest[i] - m_least[i]); }

  std::array<double, 3> m_least{HUGE_VAL, HUGE_VAL, HUGE_VAL}, m_largest{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
};

/// The vertices on edges whose two positions no other triangle has the other way round.
std::vector<Index> border_vertices(const Prepared_soup& prepared)
{
  const auto& triangles = prepared.soup.triangles;
  const auto edge = [&](std::size_t t, std::size_t k) {
    return std::pair(prepared.positions[triangles[t][k]], prepared.positions[triangles[t][(k + 1) % 3]]);
  };
  std::vector<std::pair<Index, Index>> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back(edge(t, k));
  std::sort(edges.begin(), edges.end());
  std::vector<Index> result;
  for (const auto& [from, to] : edges)
    if (!std::binary_search(edges.begin(), edges.end(), std::pair(to, from)))
      result.insert(result.end(), {from, to});
  return result;
}

/// One call of `simplify`.
class Index_reduction
{
public:
  explicit Index_reduction(const Meshopt_call& call) : m_call(call), m_used(used_vertices(call))
  {
    for (const unsigned int vertex : m_used)
      m_box.add(position(call, vertex));
    Box extent;
    if (!(call.options & selvedge_SimplifySparse))
      for (std::size_t v = 0; v < call.vertex_count; ++v)
        if (const auto point = position(call, v); // of those that no face uses, nothing is known
            std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]))
          extent.add(point);
    m_unit = call.options & selvedge_SimplifyErrorAbsolute ? 1
             : call.options & selvedge_SimplifySparse      ? m_box.longest()
                                                           : extent.longest();
  }

  std::size_t run()
  {
    const Prepared_soup prepared = prepare(soup());
    const Simplified_soup result = simplify_soup(prepared, options(), intent(prepared));
    const Verification verification = verify(result, prepared);
    if (!verification.accepted())
      throw Error("the judge refuses the result, with " + std::to_string(verification.new_pairs.size()) +
                  " new intersections: please report this mesh");
    std::size_t written = 0;
    for (const Index_triple& corners : result.corners)
      for (const Index corner : corners)
        m_call.destination[written++] = m_used[prepared.soup.triangles[corner / 3][corner % 3]];
    if (m_call.result_error) {
      const Distances& found = *verification.distances;
      const double distance =
          std::max(found.original_to_result.maximum, found.result_to_original.maximum) * found.diagonal;
      *m_call.result_error = float(m_unit > 0 ? distance / m_unit : 0);
    }
    return written;
  }

private:
  Triangle_soup soup() const
  {
    std::vector<Index> numbers(m_call.vertex_count, none);
    for (Index v = 0; v < m_used.size(); ++v)
      numbers[m_used[v]] = v;
    std::vector<unsigned int> indices;
    indices.reserve(m_call.index_count);
    for (std::size_t i = 0; i < m_call.index_count; ++i)
      indices.push_back(numbers[m_call.indices[i]]);
    const auto point = [&](std::size_t v) {
      const std::array<float, 3> p = position(m_call, m_used[v]);
      return Point_3(p[0], p[1], p[2]);
    };
    Triangle_soup soup = soup_of(m_used.size(), indices.data(), indices.size(), point,
                                 [&](std::size_t v) { return m_used[v]; });
    if (has_flag(selvedge_SimplifyVertex_Priority)) {
      Attribute attribute;
      attribute.name = priority;
      attribute.type = Attribute::Type::uint8;
      for (const unsigned int vertex : m_used)
        attribute.rows.push_back(m_call.vertex_lock[vertex] & selvedge_SimplifyVertex_Priority ? 10 : 1);
      soup.vertex_attributes.push_back(std::move(attribute));
    }
    return soup;
  }

  Simplify_options options() const
  {
    Simplify_options options;
    options.faces = m_call.target_index_count / 3;
    const double share = m_box.diagonal() > 0 ? m_call.target_error * m_unit / m_box.diagonal() : 0;
    if (share < 1) // the limit of an error as large as the mesh would only cost time
      options.max_error = share;
    if (m_call.options & selvedge_SimplifyRegularizeLight)
      options.min_aspect_ratio = 0.1;
    if (m_call.options & selvedge_SimplifyRegularize)
      options.min_aspect_ratio = 0.2;
    return options;
  }

  Simplify_intent intent(const Prepared_soup& prepared) const
  {
    Simplify_intent intent;
    if (m_call.options & selvedge_SimplifyLockBorder)
      intent.locked_vertices = border_vertices(prepared);
    if (m_call.vertex_lock)
      for (Index v = 0; v < m_used.size(); ++v)
        if (m_call.vertex_lock[m_used[v]] & selvedge_SimplifyVertex_Lock)
          intent.locked_vertices.push_back(v);
    if (has_flag(selvedge_SimplifyVertex_Priority))
      intent.weights = priority;
    return intent;
  }

  bool has_flag(unsigned char flag) const
  {
    return m_call.vertex_lock && std::any_of(m_used.begin(), m_used.end(), [&](unsigned int vertex) {
             return (m_call.vertex_lock[vertex] & flag) != 0;
           });
  }

  const Meshopt_call& m_call;
  std::vector<unsigned int> m_used;
  Box m_box;         // of the vertices in use
  double m_unit = 0; // of errors
};

} // namespace

std::size_t simplify(const Meshopt_call& call)
{
  check(call);
  return call.index_count == 0 ? 0 : Index_reduction(call).run();
}

} // namespace selvedge::bindings
