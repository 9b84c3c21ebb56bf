// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "clearance.h"

#include "pieces.h"
#include "positions.h"
#include "triangle_distance.h"

#include "soup/Disjoint_sets.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

// Finds how near the pieces of a mesh are to each other, and decides for `verify` whether that is too near.

namespace selvedge::internal {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

struct Piece_box
{
  Corner low{endless, endless, endless}, high{-endless, -endless, -endless};

  void add(const Corner& p)
  {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = (std::min)(low[axis], p[axis]);
      high[axis] = (std::max)(high[axis], p[axis]);
    }
  }
  void add(const Piece_box& box)
  {
    add(box.low);
    add(box.high);
  }
  double extent(int axis) const { return high[axis] - low[axis]; }
  double size() const { return (std::max)({extent(0), extent(1), extent(2)}); }
};

/// Returns a lower bound of the squared distance of what two boxes hold. Each of its few operations rounds by
/// a factor of at most 1 + 2^-53, or to a subnormal number.
double least_squared_distance(const Piece_box& a, const Piece_box& b)
{
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double gap = (std::max)({a.low[axis] - b.high[axis], 0.0, b.low[axis] - a.high[axis]});
    squared += gap * gap;
  }
  return (std::max)(0.0, squared * (1 - 0x1p-48) - std::numeric_limits<double>::min());
}

/// One piece: its triangles in a tree of boxes, of which node k has the children 2k + 1 and 2k + 2.
class Piece_tree
{
public:
  Piece_tree(const Triangle_soup& mesh, std::vector<Index> triangles) : m_triangles(std::move(triangles))
  {
    m_corners.reserve(m_triangles.size());
    first_triangle = *std::min_element(m_triangles.begin(), m_triangles.end());
    for (const Index t : m_triangles) {
      Corners corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const Point_3& p = mesh.points[mesh.triangles[t][k]];
        corners[k] = {p.x(), p.y(), p.z()};
      }
      m_corners.push_back(corners);
    }
    build(0, 0, m_triangles.size());
  }

  struct Node
  {
    Piece_box box;
    std::size_t first = 0, beyond = 0; // of its triangles
    bool is_leaf = false;
  };
  const Node& node(std::size_t number) const { return m_nodes[number]; }
  const Piece_box& box() const { return m_nodes[0].box; }
  const Corners& corners(std::size_t place) const { return m_corners[place]; }

  Index first_triangle;

private:
  void build(std::size_t number, std::size_t first, std::size_t beyond)
  {
    constexpr std::size_t leaf_size = 2;
    m_poll();
    if (m_nodes.size() <= number)
      m_nodes.resize(number + 1);
    Node node;
    node.first = first;
    node.beyond = beyond;
    for (std::size_t i = first; i < beyond; ++i)
      for (const Corner& p : m_corners[i])
        node.box.add(p);
    node.is_leaf = beyond - first <= leaf_size;
    if (!node.is_leaf) {
      int axis = 0;
      for (const int other : {1, 2})
        if (node.box.extent(other) > node.box.extent(axis))
          axis = other;
      const auto centre = [axis](const Corners& c) {
        return (std::min)({c[0][axis], c[1][axis], c[2][axis]}) / 2 +
               (std::max)({c[0][axis], c[1][axis], c[2][axis]}) / 2;
      };
      const std::size_t middle = first + (beyond - first) / 2;
      std::nth_element(m_corners.begin() + std::ptrdiff_t(first), m_corners.begin() + std::ptrdiff_t(middle),
                       m_corners.begin() + std::ptrdiff_t(beyond),
                       [&](const Corners& a, const Corners& b) { return centre(a) < centre(b); });
      build(2 * number + 1, first, middle);
      build(2 * number + 2, middle, beyond);
    }
    m_nodes[number] = node;
  }

  Cancellation_poll m_poll;
  std::vector<Index> m_triangles;
  std::vector<Corners> m_corners; // in the order of the leaves
  std::vector<Node> m_nodes;
};

/// The least distance of two pieces: bounds of its square, and those pairs of triangles of which one has it.
class Least_distance
{
public:
  /// Looks for what is at most `squared_limit`; where nothing is, the bounds are beyond the limit.
  Least_distance(const Piece_tree& a, const Piece_tree& b, double squared_limit)
      : m_a(a), m_b(b), m_bounds{endless, endless}, m_limit(squared_limit)
  {
    visit(0, 0);
    m_pairs.erase(std::remove_if(m_pairs.begin(), m_pairs.end(),
                                 [&](const Pair& pair) { return pair.lower > m_bounds.upper; }),
                  m_pairs.end());
  }

  /// Bounds of the squared distance. Beyond the limit, they say nothing more than that.
  const Bounds& squared() const { return m_bounds; }

  /// Whether the distance is less than that of which this is the square, or less than another.
  bool is_less(double distance) const
  {
    const Bounds square = square_bounds(distance);
    if (m_bounds.upper < square.lower || m_bounds.lower >= square.upper)
      return m_bounds.upper < square.lower;
    return exact() < exact_square(distance);
  }
  bool is_less(const Least_distance& other) const
  {
    if (m_bounds.upper < other.m_bounds.lower || m_bounds.lower >= other.m_bounds.upper)
      return m_bounds.upper < other.m_bounds.lower;
    // Where the nearest triangles have not moved, they are the same ones.
    return exact() < other.exact();
  }

private:
  struct Pair
  {
    const Corners *a, *b;
    double lower;
  };

  void visit(std::size_t i, std::size_t j)
  {
    const auto &a = m_a.node(i), &b = m_b.node(j);
    if (least_squared_distance(a.box, b.box) > (std::min)(m_limit, m_bounds.upper))
      return;
    m_poll();
    if (a.is_leaf && b.is_leaf) {
      for (std::size_t s = a.first; s < a.beyond; ++s)
        for (std::size_t t = b.first; t < b.beyond; ++t)
          consider(m_a.corners(s), m_b.corners(t));
      return;
    }
    // The larger box is divided, and the nearer half comes first.
    const bool is_a_divided = b.is_leaf || (!a.is_leaf && a.box.size() >= b.box.size());
    const std::size_t half = 2 * (is_a_divided ? i : j) + 1;
    const auto distance_of = [&](std::size_t child) {
      return is_a_divided ? least_squared_distance(m_a.node(child).box, b.box)
                          : least_squared_distance(a.box, m_b.node(child).box);
    };
    const std::size_t is_second_nearer = distance_of(half + 1) < distance_of(half);
    for (const std::size_t child : {half + is_second_nearer, half + 1 - is_second_nearer})
      is_a_divided ? visit(child, j) : visit(i, child);
  }

  void consider(const Corners& a, const Corners& b)
  {
    const Bounds bounds = squared_distance_bounds(a, b);
    if (bounds.lower > (std::min)(m_limit, m_bounds.upper))
      return;
    m_bounds.lower = (std::min)(m_bounds.lower, bounds.lower);
    m_bounds.upper = (std::min)(m_bounds.upper, bounds.upper);
    m_pairs.push_back({&a, &b, bounds.lower});
  }

  const Exact_square& exact() const
  {
    if (!m_exact)
      for (const Pair& pair : m_pairs) {
        Cancellation_scope::check();
        const Exact_square squared = exact_squared_distance(*pair.a, *pair.b);
        if (!m_exact || squared < *m_exact)
          m_exact = squared;
        if (*m_exact == 0)
          break;
      }
    return *m_exact;
  }

  const Piece_tree &m_a, &m_b;
  Bounds m_bounds;
  double m_limit;
  std::vector<Pair> m_pairs;
  Cancellation_poll m_poll;
  mutable std::optional<Exact_square> m_exact;
};

using Trees = std::map<Index, Piece_tree>; // by piece

Trees trees_of(const Triangle_soup& mesh, const std::vector<Index>& pieces)
{
  std::map<Index, std::vector<Index>> triangles;
  for (Index t = 0; t < pieces.size(); ++t)
    if (pieces[t] != no_piece)
      triangles[pieces[t]].push_back(t);
  Trees trees;
  for (auto& [piece, of_piece] : triangles)
    trees.emplace(piece, Piece_tree(mesh, std::move(of_piece)));
  return trees;
}

/// Calls `function(a, b)` for all pairs of pieces that may be nearer to each other than the root of a limit,
/// which the function may lower.
template <class Function>
void for_each_near_pair(const Trees& trees, const double& squared_limit, const Function& function)
{
  std::vector<Trees::const_iterator> order;
  for (auto at = trees.begin(); at != trees.end(); ++at)
    order.push_back(at);
  std::sort(order.begin(), order.end(),
            [](auto a, auto b) { return a->second.box().low[0] < b->second.box().low[0]; });
  for (auto a = order.begin(); a != order.end(); ++a)
    for (auto b = a + 1; b != order.end(); ++b) {
      const Piece_box &of_a = (*a)->second.box(), &of_b = (*b)->second.box();
      const double gap = of_b.low[0] - of_a.high[0];
      if (gap > 0 && gap * gap * (1 - 0x1p-48) > squared_limit)
        break;
      if (least_squared_distance(of_a, of_b) <= squared_limit)
        function(*(*a), *(*b));
    }
}

Bounds least_of_any(const Trees& trees)
{
  Bounds least{endless, endless};
  for_each_near_pair(trees, least.upper, [&](const auto& a, const auto& b) {
    const Bounds bounds = Least_distance(a.second, b.second, least.upper).squared();
    least = {(std::min)(least.lower, bounds.lower), (std::min)(least.upper, bounds.upper)};
  });
  return least.lower == endless ? least : root_bounds(least);
}

Clearance_verdict judge(double clearance, const Trees& result, const Trees* original)
{
  if (!(clearance > 0 && std::isfinite(clearance)))
    throw Argument_error("a clearance is a positive, finite distance");
  Clearance_verdict verdict;
  verdict.clearance = clearance;
  const double squared_limit = square_bounds(clearance).upper;
  for_each_near_pair(result, squared_limit, [&](const auto& a, const auto& b) {
    const Least_distance now(a.second, b.second, squared_limit);
    if (!now.is_less(clearance))
      return;
    Near_pieces pair{(std::min)(a.second.first_triangle, b.second.first_triangle),
                     (std::max)(a.second.first_triangle, b.second.first_triangle),
                     root_bounds(now.squared())};
    pair.is_too_near = true;
    if (original) {
      const auto first = original->find(a.first), second = original->find(b.first);
      if (first != original->end() && second != original->end()) {
        const Least_distance before(first->second, second->second, endless);
        pair.before = root_bounds(before.squared());
        pair.is_too_near = now.is_less(before);
      }
    }
    verdict.near.push_back(pair);
  });
  std::sort(verdict.near.begin(), verdict.near.end(), [](const Near_pieces& a, const Near_pieces& b) {
    return std::make_tuple(a.now.lower, a.first, a.second) < std::make_tuple(b.now.lower, b.first, b.second);
  });
  verdict.least = least_of_any(result);
  if (original)
    verdict.least_of_original = least_of_any(*original);
  return verdict;
}

// Unites the triangles that have a position in common: those of the mesh that belong to a piece by vertices,
// and those of the obstacle, which come last.
void unite_by_position(const Triangle_soup& mesh, const Numbered_pieces& by_vertices,
                       Disjoint_sets& triangles)
{
  const std::vector<Index> positions = position_numbers(mesh.points);
  const std::size_t own = by_vertices.of_triangle.size();
  std::vector<Index> first_at(mesh.points.size(), no_piece);
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    if (t == own)
      first_at.assign(first_at.size(), no_piece);
    if (t < own && by_vertices.of_triangle[t] == no_piece)
      continue;
    for (const Index v : mesh.triangles[t]) {
      Index& first = first_at[positions[v]];
      if (first == no_piece)
        first = t;
      triangles.unite(first, t);
    }
  }
}

} // namespace

std::vector<Index> pieces_by_position(const Triangle_soup& mesh, const Numbered_pieces& by_vertices)
{
  Disjoint_sets sets(mesh.triangles.size());
  unite_by_position(mesh, by_vertices, sets);
  const std::size_t own = by_vertices.of_triangle.size();
  std::vector<Index> pieces;
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    pieces.push_back(t >= own                                 ? Index(own)
                     : by_vertices.of_triangle[t] == no_piece ? no_piece
                                                              : Index(sets.find(t)));
  return pieces;
}

Matched_pieces matched_pieces(const Triangle_soup& result, const Triangle_soup& original,
                              const Numbered_pieces& pieces_of_result,
                              const Numbered_pieces& pieces_of_original, const Piece_matching& matching,
                              const std::vector<Index>& triangles_of_original)
{
  // The pieces of the result by vertices follow the triangles of the original.
  const Index beyond = Index(original.triangles.size());
  const std::size_t own = pieces_of_result.of_triangle.size();
  Disjoint_sets sets(beyond + pieces_of_result.pieces.size());
  unite_by_position(original, pieces_of_original, sets);
  for (const Piece_match& match : matching.matches) {
    const Index first = matching.pieces_of_original[match.of_original.front()].first_triangle;
    for (const Index piece : match.of_original)
      sets.unite(first, matching.pieces_of_original[piece].first_triangle);
    for (const Index piece : match.of_result)
      sets.unite(first, beyond + piece);
  }
  Matched_pieces pieces;
  for (Index t = 0; t < beyond; ++t) {
    const bool is_in_none =
        t < pieces_of_original.of_triangle.size() && pieces_of_original.of_triangle[t] == no_piece;
    pieces.of_original.push_back(is_in_none ? no_piece : Index(sets.find(t)));
  }
  for (Index t = 0; t < result.triangles.size(); ++t)
    if (t >= own)
      pieces.of_result.push_back(Index(sets.find(beyond - (result.triangles.size() - t))));
    else if (!triangles_of_original.empty())
      pieces.of_result.push_back(pieces.of_original[triangles_of_original[t]]);
    else {
      const Index piece = pieces_of_result.of_triangle[t];
      pieces.of_result.push_back(piece == no_piece ? no_piece : Index(sets.find(beyond + piece)));
    }
  return pieces;
}

Clearance_verdict judge_clearance(double clearance, const Triangle_soup& mesh,
                                  const std::vector<Index>& pieces)
{
  return judge(clearance, trees_of(mesh, pieces), nullptr);
}

Clearance_verdict judge_clearance(double clearance, const Triangle_soup& result,
                                  const Triangle_soup& original, const Matched_pieces& pieces)
{
  const Trees before = trees_of(original, pieces.of_original);
  return judge(clearance, trees_of(result, pieces.of_result), &before);
}

} // namespace selvedge::internal
