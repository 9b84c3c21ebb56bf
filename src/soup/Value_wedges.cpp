// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Value_wedges.h"

#include "Sewing.h"
#include "number_wedges.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace selvedge {

template <std::size_t dimension>
Value_wedges<dimension>::Value_wedges(const Corner_mesh& corners, const Scale& scale,
                                      const Simplify_constraints<Mesh>& constraints, double unit,
                                      const std::vector<Value>* of_vertices)
    : Value_wedges(corners, number_wedges(corners, constraints), scale, constraints, unit, of_vertices)
{
}

template <std::size_t dimension>
Value_wedges<dimension>::Value_wedges(const Corner_mesh& corners, const Wedge_numbers& numbers,
                                      const Scale& scale, const Simplify_constraints<Mesh>& constraints,
                                      double unit, const std::vector<Value>* of_vertices)
    : m_corners(corners), m_unit(unit), m_values(of_vertices ? *of_vertices : of_corners().values),
      m_table(corners, numbers), m_wedges(numbers.vertices.size())
{
  Cancellation_poll poll;
  for (const Corner_mesh::Face face : mesh().faces()) {
    poll();
    if (!corners.is_own(face))
      break; // the faces of the obstacle come last
    std::array<Vector, 3> points;
    Index_triple value_numbers;
    std::array<Value, 3> values;
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner_mesh::Corner corner = corners.corners(face)[k];
      const Point_3 p = scale(corners.soup().points[corners.vertex_of(corner)]);
      points[k] = {p.x(), p.y(), p.z()};
      value_numbers[k] =
          of_vertices ? corners.vertex_of(corner) : of_corners().of_triangle[corner / 3][corner % 3];
      values[k] = value(value_numbers[k]);
    }
    const Quadric of_face(points, values, 1);
    for (std::size_t k = 0; k < 3; ++k) {
      const Index number = numbers.of_face[face][k];
      m_wedges[number].value = value_numbers[k];
      m_wedges[number].quadric +=
          constraints.vertex_weights.empty()
              ? of_face
              : Quadric(points, values, constraints.vertex_weights[numbers.vertices[number]]);
    }
  }
}

// Calls function(from, to) with the wedges at both ends of a motion, once for each side of a line along it.
template <std::size_t dimension>
template <class Function>
void Value_wedges<dimension>::for_each_moved_wedge(Halfedge moving, const Function& function) const
{
  Index done = Sewing::none;
  for (const Halfedge h : {moving, mesh().opposite(moving)}) {
    if (mesh().is_border(h))
      continue;
    const auto [from, to] = m_corners.halfedges_to_ends(moving, h);
    const Index wedge = m_table.wedge(from);
    if (wedge != done)
      function(wedge, m_table.wedge(to));
    if (m_table.is_alone(mesh().source(moving)))
      return;
    done = wedge;
  }
}

// Returns how a vertex moves when it goes to a place.
template <std::size_t dimension>
typename Value_wedges<dimension>::Vector Value_wedges<dimension>::motion(Mesh::Vertex_index v,
                                                                         const Point_3& place) const
{
  const Point_3& p = mesh().point(v);
  return {place.x() - p.x(), place.y() - p.y(), place.z() - p.z()};
}

template <std::size_t dimension>
typename Value_wedges<dimension>::Vector Value_wedges<dimension>::along(Halfedge h) const
{
  return motion(mesh().source(h), mesh().point(mesh().target(h)));
}

template <std::size_t dimension>
double Value_wedges<dimension>::cost(Halfedge moving) const
{
  double cost = 0;
  for_each_moved_wedge(moving, [&](Index from, Index to) {
    const Wedge& wedge = m_wedges[from];
    cost += wedge.quadric(along(moving), value_motion(wedge, m_wedges[to]));
  });
  return std::max(0.0, cost); // rounding may leave a sum slightly below zero
}

template <std::size_t dimension>
double Value_wedges<dimension>::cost_at(Halfedge edge, const Point_3& place) const
{
  double cost = 0;
  for_each_moved_wedge(edge, [&](Index from, Index to) {
    const Wedge &first = m_wedges[from], &second = m_wedges[to];
    const Value of_value = value_motion(first, second);
    Quadric sum = first.quadric.moved_by(along(edge), of_value);
    sum += second.quadric;
    cost += first.quadric(along(edge), of_value) + sum.least(motion(mesh().target(edge), place));
  });
  return std::max(0.0, cost);
}

template <std::size_t dimension>
void Value_wedges<dimension>::merge(Halfedge moving)
{
  for_each_moved_wedge(moving, [&](Index from, Index to) {
    const Wedge& gone = m_wedges[from];
    Wedge& merged = m_wedges[to];
    merged.quadric += gone.quadric.moved_by(along(moving), value_motion(gone, merged));
  });
  m_table.on_merging(mesh().source(moving), mesh().target(moving));
}

template <std::size_t dimension>
void Value_wedges<dimension>::merge_at(Halfedge moving, const Point_3& place,
                                       const std::optional<Value>& of_soup)
{
  for_each_moved_wedge(moving, [&](Index from, Index to) {
    // No line meets a vertex at a new place, so that there is one wedge at either end.
    const Wedge& gone = m_wedges[from];
    Wedge& merged = m_wedges[to];
    const Value before = value(merged.value);
    Value now = of_soup ? at_unit(*of_soup) : before;
    merged.quadric =
        merged.quadric.moved_by(motion(mesh().target(moving), place), motion_between(before, now));
    merged.quadric +=
        gone.quadric.moved_by(motion(mesh().source(moving), place), motion_between(value(gone.value), now));
    if (!of_soup) {
      const Value best = merged.quadric.best_value_motion();
      merged.quadric = merged.quadric.moved_by({0, 0, 0}, best);
      for (std::size_t k = 0; k < dimension; ++k)
        now[k] += best[k];
    }
    // A new value takes the room of that which one of both had.
    merged.value = std::max(merged.value, gone.value);
    if (merged.value < m_values.size()) {
      merged.value = Index(m_values.size() + m_new_values.size());
      m_new_values.emplace_back();
    }
    m_new_values[merged.value - m_values.size()] = now;
  });
  m_table.on_merging(mesh().source(moving), mesh().target(moving));
}

template class Value_wedges<2>;
template class Value_wedges<3>;

} // namespace selvedge
