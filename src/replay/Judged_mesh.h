// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REPLAY_JUDGED_MESH_H
#define SELVEDGE_REPLAY_JUDGED_MESH_H

#include "Box_tree.h"
#include "Complex.h"
#include "Start.h"
#include "contact.h"

#include <array>
#include <cstddef>
#include <vector>

namespace selvedge::reference {

/// Returns the box of a triangle.
Box box_of(const std::array<Place, 3>& triangle);

/// The mesh as the steps of a log so far have left it, the boxes of its faces in a tree, and the pairs of
/// faces that offend or may.
class Judged_mesh
{
public:
  /// Takes the obstacle out of `start`, which the mesh goes on to use.
  explicit Judged_mesh(Start& start);

  Complex& complex() { return m_complex; }
  const Complex& complex() const { return m_complex; }
  const Box& box(Index face) const { return m_boxes[face]; }

  /// Returns the faces with boxes that meet `box` and for which `is_wanted(face)` holds. The reference is
  /// good until the next call.
  template <class Predicate>
  const std::vector<Index>& faces_near(const Box& box, const Predicate& is_wanted)
  {
    m_near.clear();
    m_tree.visit(box, [&](Index f) {
      if (is_wanted(f))
        m_near.push_back(f);
    });
    return m_near;
  }

  std::size_t offending_pairs() const { return m_start.offences.count(); }
  Contact_statistics& statistics() { return m_statistics; }

  /// Sets aside the faces that go with others. Called after the last snap.
  void set_doubles_aside();

  /// Takes note of the faces that the next step changes or removes. A face may come twice.
  void begin_snap(Index moved);
  void begin_collapse(std::vector<Index> changing);

  /// Returns whether a pair of a face that the step changes and another need not be apart after it: it
  /// offends already, which is no fault of this step, or it descends from an offending pair of the original,
  /// or the parts of the two may intersect.
  bool is_exempt(Index changing, Index other) const;

  /// Moves the corners at a position.
  void move(Index position, const Coordinates& place);

  /// Carries out the step, as `Complex` does. After a step that was rejected, its faces may offend with any.
  void snap(Index moved, Index kept, bool is_rejected);
  void collapse(Index removed, Index kept, const std::array<Coordinates, 2>& before, bool is_rejected);

private:
  void build_tree();
  void refit(const std::vector<Index>& faces);
  void end_step(Index kept, bool is_rejected);
  void find_offences(const std::vector<Index>& faces);

  Start& m_start;
  Complex m_complex;
  std::vector<Box> m_boxes; // by face
  Box_tree m_tree;
  std::size_t m_faces_in_tree = 0;
  Contact_statistics m_statistics;
  std::vector<Index> m_near; // a buffer

  // Of a step: the faces that it changes or removes, their ancestors, and what offended with these.
  std::vector<Index> m_changing;
  Lineage::Faces m_heritage, m_rivals;
};

} // namespace selvedge::reference

#endif // SELVEDGE_REPLAY_JUDGED_MESH_H
