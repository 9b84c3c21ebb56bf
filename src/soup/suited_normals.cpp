// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/suited_normals.h>

#include "Disjoint_sets.h"
#include "inner_edges.h"
#include "near_normals.h"
#include "number_positions.h"
#include "triangle_normals.h"

#include <selvedge/Cancellation_scope.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

// Decides which of the lines that normals make are worth their faces.

namespace selvedge {
namespace {

using internal::dot;
using internal::Edge_side;
using shading::add;
using shading::angle_at;
using shading::difference;
using shading::stored;
using shading::unit;
using shading::Vector;

// The squares of twice the sines of 10° and of 22.5°: of the chords between normals 20° and 45° apart.
constexpr double s_squared_chord_of_soft = 0.12061, s_squared_chord_of_tangle = 0.58579;

// Fewer edges than this that hang together are no line.
constexpr std::size_t s_fewest_edges = 3;

// The share of the vertices of a line at which it goes on in one way. With less, it is a tangle.
constexpr double s_share_of_tangle = 0.7;

// The share of the length of all lines that may be hard.
constexpr double s_share_of_hard = 0.1;

// Lines that hang together.
struct Network
{
  double length = 0, squared_chords = 0; // the latter by length
  std::size_t edges = 0, vertices = 0, inner_vertices = 0;

  bool is_hard() const
  {
    if (edges < s_fewest_edges || squared_chords < s_squared_chord_of_soft * length)
      return false;
    return double(inner_vertices) >= s_share_of_tangle * double(vertices) ||
           squared_chords >= s_squared_chord_of_tangle * length;
  }
};

class Line_networks
{
public:
  // Leaves out triangles with two corners at one position: they fill the gap of a line, and hide it.
  explicit Line_networks(const Triangle_soup& soup)
      : m_soup(soup), m_positions(number_positions(soup.points)), m_sets(soup.points.size()),
        m_edges_at(soup.points.size(), 0), m_networks(soup.points.size())
  {
    std::vector<Index_triple> triples;
    triples.reserve(soup.triangles.size());
    for (const auto& [u, v, w] : soup.triangles) {
      const Index a = m_positions[u], b = m_positions[v], c = m_positions[w];
      triples.push_back(a == b || b == c || c == a ? Index_triple{a, a, a} : Index_triple{a, b, c});
    }
    internal::for_each_inner_edge(triples, [&](const Edge_side& a, const Edge_side& b) {
      if (!is_line(a, b))
        return;
      m_lines.push_back(line_of(a, b));
      m_sets.unite(a.low, a.high);
      ++m_edges_at[a.low];
      ++m_edges_at[a.high];
    });
    for (const Line& line : m_lines) {
      Network& network = m_networks[m_sets.find(line.vertex)];
      network.length += line.length;
      network.squared_chords += line.length * line.squared_chord;
      ++network.edges;
    }
    for (std::size_t v = 0; v < m_edges_at.size(); ++v)
      if (m_edges_at[v] > 0) {
        Network& network = m_networks[m_sets.find(v)];
        ++network.vertices;
        network.inner_vertices += m_edges_at[v] == 2;
      }
  }

  // Whether each vertex of the soup is on a soft line; empty if none is.
  std::vector<char> are_on_soft_lines()
  {
    std::vector<char> result;
    for (std::size_t v = 0; v < m_positions.size(); ++v)
      if (const Index p = m_positions[v]; m_edges_at[p] > 0 && !m_networks[m_sets.find(p)].is_hard()) {
        result.resize(m_positions.size(), false);
        result[v] = true;
      }
    return result;
  }

  // Whether there are lines, and hardly any is hard.
  bool are_soft() const
  {
    if (m_lines.empty())
      return false;
    double length = 0, hard = 0;
    for (const Network& network : m_networks) {
      length += network.length;
      if (network.is_hard())
        hard += network.length;
    }
    return hard <= s_share_of_hard * length;
  }

private:
  // An edge of a line, at one of its vertices.
  struct Line
  {
    Index vertex;
    double length, squared_chord;
  };

  template <class Values>
  static auto value_at(const Values& values, Index corner)
  {
    return values.values[values.of_triangle[corner / 3][corner % 3]];
  }

  bool have_one_uv(Index a, Index b) const
  {
    const Corner_values<2>& uvs = m_soup.uvs;
    if (uvs.empty())
      return true;
    const Index of_a = uvs.of_triangle[a / 3][a % 3], of_b = uvs.of_triangle[b / 3][b % 3];
    return of_a == of_b ||
           (of_a != uvs.missing && of_b != uvs.missing && uvs.values[of_a] == uvs.values[of_b]);
  }

  bool have_near_normals(Index a, Index b) const
  {
    return are_near_normals(value_at(m_soup.normals, a), value_at(m_soup.normals, b));
  }

  bool have_one_label(Index a, Index b) const
  {
    const auto is_one = [&](const Triangle_labels& labels) {
      return labels.empty() || labels.of_triangle[a / 3] == labels.of_triangle[b / 3];
    };
    return is_one(m_soup.groups) && is_one(m_soup.objects) && is_one(m_soup.materials);
  }

  // Whether normals alone differ across an edge.
  bool is_line(const Edge_side& a, const Edge_side& b) const
  {
    return a.low != a.high && have_one_label(a.at_low, b.at_low) && have_one_uv(a.at_low, b.at_low) &&
           have_one_uv(a.at_high, b.at_high) &&
           !(have_near_normals(a.at_low, b.at_low) && have_near_normals(a.at_high, b.at_high));
  }

  Line line_of(const Edge_side& a, const Edge_side& b) const
  {
    const Vector along = difference(m_soup.points[a.low], m_soup.points[a.high]);
    return {a.low, std::hypot(along[0], along[1], along[2]),
            (squared_chord(a.at_low, b.at_low) + squared_chord(a.at_high, b.at_high)) / 2};
  }

  double squared_chord(Index a, Index b) const
  {
    const Vector u = unit(value_at(m_soup.normals, a)), v = unit(value_at(m_soup.normals, b));
    const Vector chord{u[0] - v[0], u[1] - v[1], u[2] - v[2]};
    return dot(chord, chord);
  }

  const Triangle_soup& m_soup;
  std::vector<Index> m_positions;
  internal::Disjoint_sets m_sets;      // of positions
  std::vector<std::size_t> m_edges_at; // by position
  std::vector<Network> m_networks;     // by set
  std::vector<Line> m_lines;
};

// Whether normals can make lines: every corner has one, and they are not those of the faces.
bool may_have_lines(const Triangle_soup& soup)
{
  if (soup.normals.empty() || soup.normals.missing || has_flat_normals(soup))
    return false;
  Cancellation_scope::check();
  return true;
}

} // namespace

Normals_choice suited_to(const Triangle_soup& soup, Normals_choice choice)
{
  if (choice != Normals_choice::automatic || !may_have_lines(soup))
    return choice;
  Line_networks networks(soup);
  if (networks.are_soft())
    return Normals_choice::loose;
  return networks.are_on_soft_lines().empty() ? choice : Normals_choice::soft;
}

Suited_normals suit_normals(Triangle_soup& soup, Normals_choice choice, bool has_normals_of_vertices)
{
  const Normals_choice suited = suited_to(soup, choice);
  const bool is_joined = has_normals_of_vertices && joins_vertices(suited);
  return {suited, is_joined ? share_vertices_without_normals(soup, suited) : 0};
}

std::vector<char> are_on_soft_lines(const Triangle_soup& soup)
{
  return may_have_lines(soup) ? Line_networks(soup).are_on_soft_lines() : std::vector<char>();
}

void loosen_soft_lines(Triangle_soup& soup)
{
  const std::vector<char> is_soft = are_on_soft_lines(soup);
  join_near_normals(soup);
  if (is_soft.empty())
    return;
  constexpr Index none = std::numeric_limits<Index>::max();
  Corner_values<3>& normals = soup.normals;
  const std::size_t first = normals.values.size();
  std::vector<Index> numbers(soup.points.size(), none); // of the means, by vertex
  for (Index corner = 0; corner < 3 * soup.triangles.size(); ++corner) {
    const Index v = soup.triangles[corner / 3][corner % 3];
    if (!is_soft[v])
      continue;
    if (numbers[v] == none) {
      numbers[v] = Index(normals.values.size());
      normals.values.push_back({});
    }
    Index& number = normals.of_triangle[corner / 3][corner % 3];
    add(normals.values[numbers[v]], unit(normals.values[number]), angle_at(soup, corner));
    number = numbers[v];
  }
  for (std::size_t i = first; i < normals.values.size(); ++i)
    normals.values[i] = stored(unit(normals.values[i]));
}

} // namespace selvedge
