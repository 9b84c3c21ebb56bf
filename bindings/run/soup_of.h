// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BINDINGS_RUN_SOUP_OF_H
#define SELVEDGE_BINDINGS_RUN_SOUP_OF_H

#include <selvedge/Error.h>
#include <selvedge/Triangle_soup.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace selvedge::bindings {

/// Refuses arrays that cannot be read. Throws `Argument_error`.
inline void check_arrays(const void* positions, std::size_t vertex_count, const unsigned int* indices,
                         std::size_t index_count)
{
  if (index_count % 3 != 0)
    throw Argument_error("the number of indices, " + std::to_string(index_count) +
                         ", is no multiple of three");
  if ((!positions && vertex_count > 0) || (!indices && index_count > 0))
    throw Argument_error("positions or indices are a null pointer");
  constexpr std::size_t most = std::numeric_limits<Index>::max();
  if (vertex_count > most || index_count > most)
    throw Argument_error("the mesh has more vertices or indices than 32 bits can number");
}

inline void check_index(const unsigned int* indices, std::size_t i, std::size_t vertex_count)
{
  if (indices[i] >= vertex_count)
    throw Argument_error("index " + std::to_string(i) + " is " + std::to_string(indices[i]) +
                         ", but there are " + std::to_string(vertex_count) + " vertices");
}

/// Returns a soup of the vertices `point(0)`, ..., `point(vertex_count - 1)`. Throws `Argument_error` when an
/// index is out of range or a coordinate is not finite; `number(v)` is then the number of the vertex v.
template <class Function, class Number>
Triangle_soup soup_of(std::size_t vertex_count, const unsigned int* indices, std::size_t index_count,
                      const Function& point, const Number& number)
{
  Triangle_soup soup;
  soup.points.reserve(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    soup.points.push_back(point(v));
    const Point_3& p = soup.points.back();
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
      throw Argument_error("vertex " + std::to_string(number(v)) + " has a coordinate that is not finite");
  }
  soup.triangles.reserve(index_count / 3);
  for (std::size_t i = 0; i < index_count; i += 3) {
    for (std::size_t k = i; k < i + 3; ++k)
      check_index(indices, k, vertex_count);
    soup.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
  }
  return soup;
}

} // namespace selvedge::bindings

#endif // SELVEDGE_BINDINGS_RUN_SOUP_OF_H
