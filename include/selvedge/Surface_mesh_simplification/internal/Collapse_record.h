// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_COLLAPSE_RECORD_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_COLLAPSE_RECORD_H

#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Element_numbers.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace selvedge {
namespace internal {

/// Records the collapses of one reduction, so that another one can repeat the first of them.
///
/// It exists because a reduction that misses its target is followed by one to more faces (`Missed_target`).
/// The collapses of that are the first ones of the reduction before, and to ask again whether each is allowed
/// would take as long as the first time.
///
/// It holds the collapses for which the loop decided. What goes along with them, as the companions in other
/// places of a shared mesh, follows from the mesh.
///
/// **Complexity** O(1) for each collapse, which takes 8 bytes, and 24 more where both ends move.
class Collapse_record
{
public:
  /// The meshes whose collapses can be recorded: those whose halfedges are numbers.
  template <class Halfedge>
  using Is_possible = Are_numbers<Halfedge>;

  void clear()
  {
    m_steps.clear();
    m_places.clear();
  }

  /// Called before a collapse is done. `is_mover_first` is of those in which both ends move.
  template <class Profile>
  void add(const Collapse<Profile>& collapse, bool is_mover_first)
  {
    m_steps.push_back({std::uint32_t(collapse.profile().v0_v1()), collapse.merged_at(), is_mover_first});
    if (collapse.are_both_moved())
      m_places.push_back({CGAL::to_double(collapse.place()[0]), CGAL::to_double(collapse.place()[1]),
                          CGAL::to_double(collapse.place()[2])});
  }

  /// Calls `repeat(v0_v1, merged_at, place, is_mover_first)` for each collapse, in their order, until a call
  /// returns false. The place has three coordinates, and is used where the vertex merges at neither end.
  template <class Function>
  void for_each(const Function& repeat) const
  {
    std::size_t places = 0;
    for (const Step& step : m_steps) {
      const bool is_placed = step.at == Merged_at::between;
      if (!repeat(step.v0_v1, step.at, is_placed ? m_places[places] : std::array<double, 3>{},
                  step.is_mover_first))
        return;
      places += is_placed;
    }
  }

private:
  struct Step
  {
    std::uint32_t v0_v1; // the halfedge from which the profile of the edge is made
    Merged_at at;
    bool is_mover_first;
  };

  // In pieces, since a copy of all would be made to enlarge a vector.
  std::deque<Step> m_steps;
  std::deque<std::array<double, 3>> m_places;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_COLLAPSE_RECORD_H
