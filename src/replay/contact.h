// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_REPLAY_CONTACT_H
#define SELVEDGE_SRC_REPLAY_CONTACT_H

#include <selvedge/Triangle_soup.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

/// Contacts of a moving triangle, asked by time: what can touch first, and where. Shares no code with the
/// filter that judges collapses, nor its case distinctions.
///
/// Two ways to every answer. The fast one takes signs alone, from CGAL's exact predicates. It looks for a
/// plane that parts the two but for what they share; then for the first contact of two things that were clear
/// of each other, which is one of a vertex with a face or of an edge with an edge. Where neither tells, and
/// for every contact that is reported, the slow one cuts the standing triangle by the swept tetrahedron in
/// rational numbers and looks at what is left.
namespace selvedge::reference {

using Coordinates = std::array<double, 3>;

/// A point that knows which position of the mesh it is: points are shared when their numbers are equal.
struct Place
{
  Index id;
  Coordinates at;
};

/// What stands still: a triangle, or an edge (`size` 2).
struct Standing
{
  std::array<Place, 3> corners;
  std::size_t size;
};

/// How many pairs were asked about, and how many of them took the slow way.
struct Contact_statistics
{
  std::size_t pairs = 0;
  std::size_t exact = 0;
};

/// A triangle (v, a, b) whose corner v goes from m to t along a line.
class Sweep
{
public:
  Sweep(const Place& m, const Place& t, const Place& a, const Place& b, Contact_statistics& statistics);

  /// Whether the triangle has no area at some time in [0, 1].
  bool degenerates() const;

  /// Whether at some time the triangle and `standing` meet beyond the positions that they share, t among
  /// them.
  ///
  /// **Precondition** At time 0 they do not; `standing` does not have m.
  bool touches(const Standing& standing) const;

  /// The same by the slow way, without the precondition on time 0: a point of contact as rational numbers;
  /// none when there is no contact.
  std::optional<std::string> contact(const Standing& standing) const;

private:
  enum class Answer { clear, touching, unsure };
  Answer fast_answer(const Standing& standing) const;

  std::array<Place, 4> m_corners; // m, t, a, b
  int m_volume;                   // exact sign of orientation(m, t, a, b)
  Contact_statistics& m_statistics;
};

/// Whether a triangle has no area.
bool is_degenerate(const std::array<Place, 3>& triangle);

/// Whether x lies between two other places, strictly. All three are on one line.
bool is_between(const Place& p, const Place& x, const Place& q);

/// Whether two triangles at rest meet beyond the positions that they share, or share all three.
bool do_meet(const std::array<Place, 3>& a, const std::array<Place, 3>& b, Contact_statistics& statistics);

/// A point in which they meet beyond what they share, as rational numbers.
std::optional<std::string> meeting_point(const std::array<Place, 3>& a, const std::array<Place, 3>& b);

} // namespace selvedge::reference

#endif // SELVEDGE_SRC_REPLAY_CONTACT_H
