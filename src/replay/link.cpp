// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "link.h"

#include <algorithm>
#include <set>
#include <vector>

namespace selvedge::reference {

const char* link_objection(const Complex& complex, Index removed, Index kept)
{
  const std::vector<Complex::Edge> at_removed = complex.edges_at(removed), at_kept = complex.edges_at(kept);
  const auto edge_to = [](const std::vector<Complex::Edge>& edges, Index neighbour) {
    const auto found = std::find_if(edges.begin(), edges.end(),
                                    [&](const Complex::Edge& edge) { return edge.neighbour == neighbour; });
    return found == edges.end() ? nullptr : &*found;
  };
  std::set<Index> apexes;
  for (const Index f : complex.faces_at(removed))
    if (complex.has(f, kept))
      for (const Index p : complex.face(f).positions)
        if (p != removed && p != kept)
          apexes.insert(p);
  for (const Complex::Edge& edge : at_removed) {
    const Complex::Edge* const other = edge_to(at_kept, edge.neighbour);
    if (!other)
      continue;
    if (apexes.count(edge.neighbour) == 0)
      return "both vertices have an edge to a third one, but no triangle joins the three";
    if (edge.is_border() && other->is_border())
      return "a triangle with two border edges would vanish";
  }
  const auto is_on_border = [](const std::vector<Complex::Edge>& edges) {
    return std::any_of(edges.begin(), edges.end(),
                       [](const Complex::Edge& edge) { return edge.is_border(); });
  };
  if (is_on_border(at_removed) && is_on_border(at_kept) && !edge_to(at_removed, kept)->is_border())
    return "both vertices are on a border, but their edge is not";
  return nullptr;
}

} // namespace selvedge::reference
