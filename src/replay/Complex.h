// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_REPLAY_COMPLEX_H
#define SELVEDGE_SRC_REPLAY_COMPLEX_H

#include "contact.h"

#include <selvedge/Triangle_soup.h>

#include <array>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace selvedge::reference {

/// The mesh on which `replay` repeats a log: triangles over positions, and the faces at each position. It has
/// no halfedges: borders, fans and seams are counted when they are asked for.
///
/// Faces of an obstacle may stand beside it. They are numbered after the others, and never move. The faces at
/// a position, borders, fans and seams are those of the mesh alone.
class Complex
{
public:
  struct Face
  {
    Index_triple positions;
    Index_triple corners;                         // of the soup, 3 × triangle + place in it
    std::array<std::array<bool, 2>, 3> is_seam{}; // side k runs from corner k to the next: at each of these
    bool is_alive = true, is_turned = false;
  };

  /// One of the faces that a face stands for, itself or one that has been set aside.
  struct Ply
  {
    Index face;
    Index_triple corners;        // at its positions in their order; those of the first ply are in `Face`
    std::array<Index, 3> places; // where these positions are in the triangle of the soup
  };

  /// The edge from a position to a neighbour, as the faces at the position show it.
  struct Edge
  {
    Index neighbour;
    int outgoing = 0, incoming = 0;               // faces that run along it from the position, and to it
    bool is_seam = false, is_seam_beyond = false; // at the position, and at the neighbour

    bool is_border() const { return outgoing != 1 || incoming != 1; }
    bool is_line() const { return is_seam || is_border(); } // at the position
    bool is_line_beyond() const { return is_seam_beyond || is_border(); }
  };

  /// The corners of the obstacle have the numbers of the positions of `soup` where they share them, and
  /// others elsewhere.
  explicit Complex(const Triangle_soup& soup, std::vector<std::array<Place, 3>> obstacle = {});

  /// Returns the position of a vertex of the soup; for one that a collapse has removed, the position that it
  /// had.
  Index position(Index vertex) const
  {
    Index position = m_position_of_vertex[vertex];
    while (m_snapped_to[position] != position)
      position = m_snapped_to[position];
    return position;
  }
  Place place(Index position) const { return {position, m_points[position]}; }
  const Coordinates& point(Index position) const { return m_points[position]; }
  std::array<Place, 3> triangle(Index face) const;

  std::size_t face_count() const { return m_alive; }
  std::size_t size() const { return m_faces.size(); } // without those of the obstacle
  std::size_t size_with_obstacle() const { return m_faces.size() + m_obstacle.size(); }
  bool is_of_obstacle(Index face) const { return face >= m_faces.size(); }

  /// Sets faces aside that go with others from now on, the front of each. They are not alive any more, but
  /// count as faces as long as their fronts do. To be called after turns, and before `find_seams`.
  void set_aside(const std::vector<Index>& fronts);

  /// Returns whether a face, or that with which it goes, is left.
  bool is_left(Index face) const { return m_faces[front(face)].is_alive; }

  /// Returns the positions of a face that is left, in the order that they have in the soup.
  Index_triple positions_left(Index face) const;
  const Face& face(Index f) const { return m_faces[f]; }
  const std::vector<Index>& faces_at(Index position) const { return m_faces_at[position]; }
  bool has(Index face, Index position) const;

  /// Returns the other two corners of a face, in the order of the face, from the one after `position`.
  std::array<Index, 2> opposite_side(Index face, Index position) const;

  std::vector<Edge> edges_at(Index position) const;

  /// Whether the faces at a position form one fan, connected across edges that are no borders.
  bool is_one_fan(Index position) const { return fans_at(position).size() == 1; }

  /// Whether a position lies inside a line along which several sheets meet, and `end` is next to it there:
  /// each of its fans leads from `end` to one and the same other position.
  bool is_inside_line(Index position, Index end) const;

  /// Lets a face run the other way from now on, and back again in `result`. To be called before `find_seams`.
  void turn(Index face);

  /// Returns the positions or corners of a face in the order that they have in the soup.
  Index_triple in_order_of_soup(Index face, Index_triple of_face) const;

  /// Marks the edges across which a vertex number, a label, a value of the soup's corners, or an attribute
  /// `of_regions` changes; where corners change at one end only, this end alone.
  void find_seams(const std::vector<const Attribute*>& of_regions);
  bool has_seams() const { return m_has_seams; }

  void move(Index position, const Coordinates& point) { m_points[position] = point; }

  /// Moves all vertices and faces at one position to the other. No edge may join the two.
  void snap(Index moved, Index kept);

  /// Moves all faces at `removed` to `kept`. The faces that have both are removed and returned. The corners
  /// that move get the values of `kept` on their side of the seams. `before` are the points of both before
  /// the step, which may have moved them already; lines remember those that they have passed.
  std::vector<Index> collapse(Index removed, Index kept, const std::array<Coordinates, 2>& before);

  /// Returns the points of lines that the edge ab has replaced; null when there are none.
  const std::vector<Coordinates>* passed(Index a, Index b) const;

  /// Returns the soup of the faces that are left.
  Triangle_soup result() const;

private:
  Index front(Index face) const { return m_fronts.empty() ? face : m_fronts[face]; }
  const std::vector<Ply>& plies(Index face) const // none where a face stands for itself alone
  {
    static const std::vector<Ply> none;
    const auto found = m_plies.find(face);
    return found == m_plies.end() ? none : found->second;
  }
  static const Edge& edge_to(const std::vector<Edge>& edges, Index neighbour);
  std::vector<std::vector<Index>> fans_at(Index position) const;
  bool have_other_values(Index corner_a, Index corner_b) const; // or labels
  Index vertex_of(Index corner) const { return m_soup.triangles[corner / 3][corner % 3]; }
  std::size_t slot(Index face, Index position) const;
  void carry_corners(const std::vector<Index>& contracted, std::vector<Index> moving, Index removed,
                     Index kept);
  void carry_seams(Index removed, Index kept);
  std::array<bool, 2> differs_at_ends(Index f, Index g, Index from, Index to) const;
  struct Side
  {
    Index face, other; // on this side of an edge, and beyond
    std::size_t place; // of the side in the face
  };
  void mark_regions(const std::vector<Side>& inner, const std::vector<const Attribute*>& attributes);
  void carry_passed(Index removed, Index kept, const std::array<Coordinates, 2>& before);

  const Triangle_soup& m_soup;
  const std::vector<std::array<Place, 3>> m_obstacle;
  std::vector<Index> m_position_of_vertex; // at the start
  std::vector<Index> m_snapped_to;         // by position; itself where it has not snapped
  std::vector<Coordinates> m_points;       // by position
  std::vector<Face> m_faces;
  std::vector<Index> m_fronts;                         // by face, or empty
  std::unordered_map<Index, std::vector<Ply>> m_plies; // by front: those that run as it does come first
  std::vector<std::vector<Index>> m_faces_at;
  std::size_t m_alive = 0;
  bool m_has_seams = false;
  std::map<std::pair<Index, Index>, std::vector<Coordinates>> m_passed;
};

/// Returns, for every vertex, the smallest number of a vertex with equal coordinates (−0 is 0).
std::vector<Index> first_at_position(const std::vector<Point_3>& points);

} // namespace selvedge::reference

#endif // SELVEDGE_SRC_REPLAY_COMPLEX_H
