// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_VERTEX_COMPLEX_H
#define SELVEDGE_SOUP_VERTEX_COMPLEX_H

#include <selvedge/Triangle_soup.h>

#include <algorithm>
#include <vector>

namespace selvedge {

/// The simplicial complex that triangles make of vertices of the soup. It has one face between three
/// vertices, however many triangles have these.
///
/// An edge is *on a line* if it has not two faces. A vertex is *inner* if its faces are a disc, *on a line*
/// if they are half-discs with their diameter in common (at a border, one), and *singular* otherwise.
///
/// **Complexity** Quadratic in the number of faces: it is for those at the ends of one edge.
class Vertex_complex
{
public:
  enum class Kind { inner, on_line, singular };

  void add(Index a, Index b, Index c);

  /// Notes that a vertex may have faces that are not added.
  void mark_as_part(Index v) { m_parts.push_back(v); }
  bool is_part(Index v) const { return std::find(m_parts.begin(), m_parts.end(), v) != m_parts.end(); }

  /// Returns what kind of vertex v is by the faces that were added.
  Kind kind(Index v) const;

  /// Contracts the edge from v to `goal` and returns true if these conditions tell that the complex keeps its
  /// topology; else returns false, and does nothing:
  /// 1. v and `goal` have neighbours in common only beside their edge, and no edge lies opposite both.
  /// 2. No face beside their edge has its other two edges on lines.
  /// 3. If neither is inner, their edge is on a line, and one of them is not singular.
  ///
  /// A goal that may have other faces counts as singular, and an edge between two vertices that may as on a
  /// line.
  ///
  /// **Preconditions** All faces of v are there, or all but those that keep it on a line and move with it.
  ///
  /// **Reference** Dey, Edelsbrunner, Guha, Nekhayev: Topology preserving edge contraction, 1999.
  bool contract(Index v, Index goal);

private:
  std::vector<Index_triple> m_faces; // with their vertices in ascending order
  std::vector<Index> m_parts;
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_VERTEX_COMPLEX_H
