// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_JUDGED_COMPLEX_H
#define SELVEDGE_TEST_WORLDS_JUDGED_COMPLEX_H

#include "Broken_promise.h"
#include "Hull.h"

#include <selvedge/Triangle_soup.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace selvedge::test {

/// Triangles over positions, own ones and those of an obstacle, that judge every motion by brute force before
/// they do it: whatever does not change is compared with nothing again, all that changes with every face
/// there is.
///
/// No triangle has two corners at one position. Own triangles come first.
class Judged_complex
{
public:
  Judged_complex(const Triangle_soup& own, const Triangle_soup& obstacle);

  /// Pairs of faces that meet beyond what they share, and faces without an area as pairs with themselves.
  std::set<std::pair<Index, Index>> offending_pairs() const;

  /// Nothing at the corners of this face moves from now on, and it is neither a double nor the front of one.
  void freeze(Index face);
  void freeze_position(Index position) { m_is_frozen[position] = true; }

  /// These pairs, which offend, and all that descend from them need not be apart, but a collapse must not
  /// make more of them offend. No snap moves their faces, or something to them.
  void exempt(const std::set<std::pair<Index, Index>>& pairs);

  /// Parts that may intersect: faces of part 1 need not be apart from those of part 2. Call it before any
  /// question.
  void permit(std::vector<char> part_of_face) { m_part_of_face = std::move(part_of_face); }

  /// From now on, pieces keep this distance from each other, or what they have now.
  void keep_clearance(double distance);

  /// Of a vertex; those of the obstacle follow those of the soup.
  Index position(Index vertex) const { return m_position_of_vertex[vertex]; }
  bool is_alive(Index face) const { return m_faces[front(face)].is_alive; }

  /// In the order of the soup. Asked about a double, it takes its front to run as in the soup.
  Index_triple positions_of(Index face) const;
  const Point_3& point(Index position) const { return m_points[position]; }
  std::size_t own_faces_alive() const { return m_own_alive; }
  std::size_t needles() const; ///< faces that have no area

  /// Lets a face run the other way from now on.
  void turn(Index face);

  /// Lines of the soup: edges across which a number, label or value changes. Those where only corners change,
  /// and at one end, are lines there alone. To be called after snaps.
  /// Where pairs may descend, faces with the same three positions go with the first of them from now on.
  void find_seams(const Triangle_soup& own);

  /// Everything at one position goes to another. What is wrong with that is told, and then it is not done.
  std::optional<Broken_promise> snap(Index moved, Index kept);
  std::optional<Broken_promise> collapse(Index removed, Index kept);

  /// Both go to a place that is neither position, `removed` first or last, and merge there.
  std::optional<Broken_promise> collapse(Index removed, Index kept, const Point_3& at, bool is_removed_first);

  /// Numbers of regions: faces that hang together across edges that are no lines.
  std::vector<Index> regions() const;

private:
  struct Box
  {
    std::array<double, 3> low, high;
  };
  struct Face
  {
    Index_triple positions;
    Box box;
    bool is_own, is_alive;
  };
  struct Edge
  {
    Index neighbour;
    int outgoing = 0, incoming = 0; // own faces; nothing is sewn to an obstacle

    bool is_border() const { return outgoing != 1 || incoming != 1; }
  };

  Place place(Index position) const { return {position, m_points[position]}; }
  Standing_face places(Index face) const;
  bool has_area(Index face) const;
  bool do_meet_beyond_shared(Index f, Index g) const;
  bool has(Index face, Index position) const;
  std::array<Index, 2> others(Index face, Index position) const;
  Box box_of(const Index_triple& positions) const;
  std::vector<Edge> edges_at(Index position) const;
  void set_doubles_aside(const Triangle_soup& own);
  Index front(Index face) const { return m_fronts.empty() ? face : m_fronts[face]; }
  std::vector<Index> plies(Index front) const;
  bool is_seam_at(Index p, Index q) const { return m_seams.count({p, q}) > 0; } // at p
  bool is_seam(Index p, Index q) const { return is_seam_at(p, q) && is_seam_at(q, p); }
  void add_seam(Index p, Index q) { m_seams.insert({{p, q}, {q, p}}); }
  std::vector<std::vector<Index>> fans_at(Index position) const;
  bool is_one_fan(Index position) const { return fans_at(position).size() == 1; }
  bool is_inside_line(Index position, Index end) const;
  std::optional<Broken_promise> judge_link(Index removed, Index kept) const;
  std::optional<Broken_promise> judge_line(Index removed, Index kept) const;
  bool takes_needed_line(Index removed, Index kept) const;
  std::optional<Broken_promise> judge_motion(Index moved, const Place& target) const;
  std::optional<Broken_promise> judge_clearance(Index moved, const Place& target) const;
  bool is_near(const Box& a, const Box& b) const;
  Index node(const Face& face, Index position) const;
  Index piece_of(const Face& face) const;
  void begin_collapse(const std::vector<Index>& movers);
  std::optional<Broken_promise> end_collapse();
  bool is_permitted(Index f, Index g) const;
  bool is_exempt(Index changing, Index other) const;
  std::size_t pairs_changing() const;
  void place_at(Index position, const Point_3& at);
  void merge(Index removed, Index kept);
  void move(Index moved, Index kept);

  std::vector<Point_3> m_points; // by position
  std::vector<Index> m_position_of_vertex;
  std::vector<Face> m_faces;
  std::vector<std::vector<Index>> m_faces_at;
  std::vector<char> m_is_frozen; // by position
  std::set<Index> m_frozen_faces;
  std::set<Index> m_offending;                   // positions
  std::vector<std::set<Index>> m_ancestors;      // by face
  std::vector<Index> m_fronts;                   // by face; empty before `find_seams`
  std::map<Index, std::vector<Index>> m_doubles; // by front: it, and those that go with it
  std::vector<Index_triple> m_slots; // by face: at which corner of its front each of its own is, in the soup
  std::set<std::pair<Index, Index>> m_pairs_at_start;
  std::vector<char> m_part_of_face; // of own faces; empty when no parts may intersect

  // What two pieces, by the numbers that positions have in common, must keep from each other: the square.
  std::optional<double> m_clearance;
  std::vector<Index> m_piece; // by position, first of own faces, then of those of the obstacle
  std::map<std::pair<Index, Index>, double> m_least;

  // Of the present collapse.
  std::set<Index> m_changing;
  std::size_t m_pairs_before = 0;
  std::set<std::pair<Index, Index>> m_seams; // the edge from the first to the second is a line at the first
  std::size_t m_own_alive = 0;
};

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_JUDGED_COMPLEX_H
