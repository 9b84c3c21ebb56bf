// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "snap.h"

#include "limits.h"

#include <algorithm>
#include <vector>

// Judges the snaps of a log: whether each took a border vertex to a partner, no farther than the weld
// distance.

namespace selvedge::reference {
namespace {

/// The neighbours of a position along the borders through it, in the direction in which the faces run.
struct Border
{
  std::vector<Index> next, previous;

  Border(const Complex& complex, Index position)
  {
    for (const Complex::Edge& edge : complex.edges_at(position))
      if (edge.outgoing + edge.incoming == 1)
        (edge.outgoing == 1 ? next : previous).push_back(edge.neighbour);
  }
  bool is_empty() const { return next.empty() && previous.empty(); }
};

/// Tells whether positions are partners, as snapping.h defines them, in the present state of the mesh.
class Partners
{
public:
  Partners(const Complex& complex, double weld_distance) : m_complex(complex), m_distance(weld_distance) {}

  bool are_near(Index a, Index b) const { return distance(a, b) <= m_distance * (1 + limit_tolerance); }

  // Whether a border edge that starts at `a` and one that ends at `b` have other ends that are near or the
  // same.
  bool is_edge_sewable(const Border& a, const Border& b) const
  {
    return std::any_of(a.next.begin(), a.next.end(), [&](Index p) {
      return std::any_of(b.previous.begin(), b.previous.end(),
                         [&](Index q) { return p == q || are_near(p, q); });
    });
  }

  // Whether the border leads from `a` to `b` without a branch, within twice the weld distance.
  bool is_shortly_followed(Index a, Index b) const
  {
    double length = 0;
    for (Index at = a;;) {
      const Border border(m_complex, at);
      // Without branches the walk returns to its start, if nothing ends it before.
      if (border.next.size() != 1 || (at != a && border.previous.size() != 1))
        return false;
      const Index next = border.next.front();
      length += distance(at, next);
      if (length > 2 * m_distance * (1 - limit_tolerance) || next == a)
        return false;
      if (next == b)
        return true;
      at = next;
    }
  }

private:
  double distance(Index a, Index b) const
  {
    return reference::distance(m_complex.point(a), m_complex.point(b));
  }

  const Complex& m_complex;
  const double m_distance;
};

// Whether the edges from both to any third position can become one: each has one face, and these faces run
// along them in opposite directions.
bool is_link_condition_met(const Complex& complex, Index moved, Index kept)
{
  const std::vector<Complex::Edge> at_kept = complex.edges_at(kept);
  for (const Complex::Edge& edge : complex.edges_at(moved))
    for (const Complex::Edge& other : at_kept)
      if (edge.neighbour == other.neighbour &&
          (edge.outgoing + edge.incoming != 1 || other.outgoing + other.incoming != 1 ||
           edge.outgoing != other.incoming))
        return false;
  return true;
}

} // namespace

std::optional<Objection> judge_snap(const Complex& complex, Index moved, Index kept,
                                    const std::optional<double>& weld_distance)
{
  if (!weld_distance)
    return Objection{Violation_kind::weld_distance,
                     "no snap is allowed without a limit weld_distance: the log must declare one, or the "
                     "judge impose one"};
  const Partners partners(complex, *weld_distance);
  if (!partners.are_near(moved, kept))
    return Objection{Violation_kind::weld_distance,
                     message_of_limit(Violation_kind::weld_distance, *weld_distance)};

  const auto are_no_partners = [](const char* why) { return Objection{Violation_kind::partner, why}; };
  const Border of_moved(complex, moved), of_kept(complex, kept);
  if (of_moved.is_empty())
    return are_no_partners("the vertex that snaps is not on a border");
  if (of_kept.is_empty())
    return are_no_partners("the vertex that it snaps to is not on a border");
  if (!partners.is_edge_sewable(of_moved, of_kept) && !partners.is_edge_sewable(of_kept, of_moved))
    return are_no_partners(
        "no border edges beside the two vertices could be sewn: none run in opposite directions "
        "with their other ends within the weld distance");
  if (partners.is_shortly_followed(moved, kept) || partners.is_shortly_followed(kept, moved))
    return are_no_partners("a stretch of border of at most twice the weld distance joins the two vertices");

  if (!is_link_condition_met(complex, moved, kept))
    return Objection{Violation_kind::link,
                     "an edge would get a third triangle, or two triangles that face opposite ways"};
  return std::nullopt;
}

} // namespace selvedge::reference
