// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Vertex_complex.h"

#include <cstddef>
#include <utility>

namespace selvedge {
namespace {

using Kind = Vertex_complex::Kind;

// The edges opposite a vertex, each with its ends in ascending order.
using Link_edge = std::pair<Index, Index>;
using Link = std::vector<Link_edge>;

bool has_end(const Link_edge& edge, Index node)
{
  return edge.first == node || edge.second == node;
}

bool has_edge(const Link& link, Index a, Index b)
{
  return std::find(link.begin(), link.end(), Link_edge(std::minmax(a, b))) != link.end();
}

std::ptrdiff_t degree(const Link& link, Index node)
{
  return std::count_if(link.begin(), link.end(), [&](const Link_edge& edge) { return has_end(edge, node); });
}

std::vector<Index> nodes(const Link& link)
{
  std::vector<Index> result;
  for (const auto& [a, b] : link)
    result.insert(result.end(), {a, b});
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

Link link_of(const std::vector<Index_triple>& faces, Index v)
{
  Link result;
  for (const auto& [a, b, c] : faces)
    if (a == v || b == v || c == v)
      result.push_back(a == v ? Link_edge(b, c) : b == v ? Link_edge(a, c) : Link_edge(a, b));
  return result;
}

// Follows the paths from one end of the link, or from any node where it has none, to the other end.
Kind kind_in(const Link& link)
{
  std::vector<Index> ends;
  for (const Index node : nodes(link))
    if (degree(link, node) != 2)
      ends.push_back(node);
  if (link.empty() || (!ends.empty() && ends.size() != 2))
    return Kind::singular;
  const Index first = ends.empty() ? link.front().first : ends[0];
  const Index last = ends.empty() ? first : ends[1];
  std::size_t passed = 0;
  for (auto edge = link.begin(); edge != link.end(); ++edge) {
    if (!has_end(*edge, first))
      continue;
    auto on_path = edge;
    Index at = first;
    do {
      if (at != first)
        on_path = std::find_if(link.begin(), link.end(), [&](const Link_edge& other) {
          return other != *on_path && has_end(other, at);
        });
      at = on_path->first == at ? on_path->second : on_path->first;
      ++passed;
    } while (at != first && at != last);
    if (at != last)
      return Kind::singular;
    if (ends.empty())
      break;
  }
  return passed != link.size() ? Kind::singular : ends.empty() ? Kind::inner : Kind::on_line;
}

} // namespace

void Vertex_complex::add(Index a, Index b, Index c)
{
  Index_triple face{a, b, c};
  std::sort(face.begin(), face.end());
  if (std::find(m_faces.begin(), m_faces.end(), face) == m_faces.end())
    m_faces.push_back(face);
}

Vertex_complex::Kind Vertex_complex::kind(Index v) const
{
  return kind_in(link_of(m_faces, v));
}

bool Vertex_complex::contract(Index v, Index goal)
{
  const Link of_v = link_of(m_faces, v), of_goal = link_of(m_faces, goal);
  for (const auto& [a, b] : of_v)
    if (has_edge(of_goal, a, b))
      return false;
  const auto is_on_line = [&](Index end, const Link& of_end, Index x) {
    return degree(of_end, x) != 2 || (is_part(end) && is_part(x));
  };
  for (const Index x : nodes(of_v))
    if (x != goal && degree(of_goal, x) > 0 &&
        (!has_edge(of_v, goal, x) || (is_on_line(v, of_v, x) && is_on_line(goal, of_goal, x))))
      return false;
  const Kind kind_of_v = kind_in(of_v), kind_of_goal = is_part(goal) ? Kind::singular : kind_in(of_goal);
  if (kind_of_v != Kind::inner && kind_of_goal != Kind::inner && degree(of_v, goal) == 2)
    return false;
  if (kind_of_v == Kind::singular && kind_of_goal == Kind::singular)
    return false;
  const std::vector<Index_triple> faces = std::exchange(m_faces, {});
  for (Index_triple face : faces) {
    std::replace(face.begin(), face.end(), v, goal);
    if (std::count(face.begin(), face.end(), goal) < 2)
      add(face[0], face[1], face[2]);
  }
  return true;
}

} // namespace selvedge
