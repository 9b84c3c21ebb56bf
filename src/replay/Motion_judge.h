// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REPLAY_MOTION_JUDGE_H
#define SELVEDGE_REPLAY_MOTION_JUDGE_H

#include "Judged_mesh.h"
#include "Objection.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::reference {

/// A motion of the vertices at a position: to another position, with which they merge, or to a place that is
/// no position.
struct Motion
{
  Index mover;
  Place target;
};

/// Judges, for `replay`, what a motion meets on its way and at its end, and how near it comes to other
/// pieces.
class Motion_judge
{
public:
  /// `triangles_of_original` counts those without an obstacle. `mesh` tells which pairs need not be apart.
  Motion_judge(const Start& start, Judged_mesh& mesh, std::size_t triangles_of_original,
               std::optional<double> clearance)
      : m_start(start), m_mesh(mesh), m_triangles_of_original(triangles_of_original), m_clearance(clearance)
  {
  }

  /// Finds the pieces that must keep a clearance from each other. Called before the first collapse.
  void find_pieces();

  /// Returns the first reason why a motion is not allowed: a face degenerates, two faces meet at the end, or
  /// they meet on the way.
  std::optional<Objection> meeting(const Motion& motion);

  /// Returns whether a motion that meets nothing comes too near to another piece.
  std::optional<Objection> lack_of_clearance(const Motion& motion);

private:
  struct Moving_face;
  struct Star;

  std::optional<Objection> gather(const Motion& motion, Star& star);
  std::optional<Objection> meeting_at_end(const Motion& motion, const Star& star);
  std::optional<Objection> meeting_on_way(const Motion& motion, const Star& star);
  Objection between(Violation_kind kind, const Motion& motion, const Moving_face& face, Index other,
                    const std::array<Place, 3>& triangle_of_other,
                    const std::optional<std::string>& point) const;
  std::string name(Index face) const;

  const Complex& complex() const { return m_mesh.complex(); }

  const Start& m_start;
  Judged_mesh& m_mesh;
  std::size_t m_triangles_of_original;
  std::optional<double> m_clearance;
  std::vector<Index> m_pieces; // by position, if a clearance is to be kept
};

} // namespace selvedge::reference

#endif // SELVEDGE_REPLAY_MOTION_JUDGE_H
