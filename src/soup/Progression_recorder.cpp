// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Progression_recorder.h"

#include "number_wedges.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace selvedge {

// The plies of a face have wedges of their own. Those of one wedge of the mesh follow each other: all its
// faces have as many plies, in one order.
Progression_recorder::Progression_recorder(const Corner_mesh& corners,
                                           const Simplify_constraints<Corner_mesh::Mesh>& constraints,
                                           Progression& progression)
    : m_corners(corners), m_progression(progression)
{
  using Face = Corner_mesh::Face;
  const Wedge_numbers numbers = number_wedges(corners, constraints);
  std::vector<Index> first(numbers.vertices.size() + 1, 0); // by wedge of the mesh
  const auto for_each_corner = [&](const auto& function) {
    for (const Face face : corners.mesh().faces())
      for (std::size_t place = 0; place < 3 && corners.is_own(face); ++place)
        function(face, place, numbers.of_face[face][place]);
  };
  for_each_corner([&](Face face, std::size_t, Index wedge) { first[wedge + 1] = corners.ply_count(face); });
  std::partial_sum(first.begin(), first.end(), first.begin());
  progression = {};
  progression.wedges.resize(corners.soup().triangles.size());
  for_each_corner([&](Face face, std::size_t place, Index wedge) {
    for (Index i = 0; i < corners.ply_count(face); ++i) {
      const Index corner = corners.corners(face, i)[place];
      progression.wedges[corner / 3][corner % 3] = first[wedge] + i;
    }
  });
}

// A contracted face has a corner in each wedge that moves, and one in the wedge to which that goes.
void Progression_recorder::record_moves(Corner_mesh::Halfedge moving)
{
  const Corner_mesh::Mesh& mesh = m_corners.mesh();
  auto& [wedges, moves, steps] = m_progression;
  const auto begin = std::ptrdiff_t(steps.empty() ? 0 : steps.back()); // of the moves of this step
  for (const Corner_mesh::Halfedge side : {moving, mesh.opposite(moving)}) {
    if (mesh.is_border(side) || !m_corners.is_own(mesh.face(side)))
      continue;
    const auto [to_mover, to_goal] = m_corners.halfedges_to_ends(moving, side);
    for (Index i = 0; i < m_corners.ply_count(mesh.face(side)); ++i) {
      const Index from = m_corners.corner_at(to_mover, i), to = m_corners.corner_at(to_goal, i);
      const Progression::Move move = {wedges[from / 3][from % 3], wedges[to / 3][to % 3]};
      if (std::none_of(moves.begin() + begin, moves.end(),
                       [&](const Progression::Move& other) { return other.from == move.from; }))
        moves.push_back(move);
    }
  }
}

} // namespace selvedge
