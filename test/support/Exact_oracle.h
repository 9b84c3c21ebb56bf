// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_EXACT_ORACLE_H
#define SELVEDGE_TEST_SUPPORT_EXACT_ORACLE_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

/// Answers the questions of the exact geometry by linear programming over exact numbers. Shares nothing with
/// the procedures that it judges: no orientation sign, no case distinction by shared positions, no sweep.
///
/// `Number` is an integer type without overflow on the given input, or a field; comparisons and + - * / must
/// be exact (/ is only used where it leaves no remainder).
namespace selvedge::oracle {

template <class Number>
using Point = std::array<Number, 3>;

/// Whether {x ≥ 0 : A x = b} has a point with x[j] > 0 for some j in `positive`; or any point at all when
/// `positive` is empty. Simplex method in two phases with Bland's rule; integer pivoting, so that integers
/// stay integers.
template <class Number>
bool is_feasible(std::vector<std::vector<Number>> a, std::vector<Number> b, const std::vector<bool>& positive)
{
  const std::size_t rows = a.size(), columns = a[0].size(), width = columns + 1;
  // The last two rows are the objectives of the two phases, to be maximised; the last column is the
  // right-hand side. An artificial variable that leaves the basis never comes back: it needs no column.
  std::vector<std::vector<Number>> table(rows + 2, std::vector<Number>(width, Number(0)));
  std::vector<std::size_t> basis(rows); // numbers from `columns` on are those of artificial variables
  for (std::size_t i = 0; i < rows; ++i) {
    const bool is_negative = b[i] < Number(0);
    for (std::size_t j = 0; j < columns; ++j)
      table[i][j] = is_negative ? -a[i][j] : a[i][j];
    table[i][width - 1] = is_negative ? -b[i] : b[i];
    basis[i] = columns + i;
    for (std::size_t j = 0; j < columns; ++j)
      table[rows][j] = table[rows][j] + table[i][j];
    table[rows][width - 1] = table[rows][width - 1] + table[i][width - 1];
  }
  bool is_any_positive = false;
  for (std::size_t j = 0; j < columns; ++j) {
    if (positive[j]) {
      table[rows + 1][j] = Number(1);
      is_any_positive = true;
    }
  }

  Number denominator(1);
  const auto pivot = [&](std::size_t row, std::size_t column) {
    const Number p = table[row][column];
    for (std::size_t i = 0; i < table.size(); ++i) {
      const Number factor = table[i][column];
      if (i == row || (factor == Number(0) && p == denominator))
        continue;
      for (std::size_t j = 0; j < width; ++j)
        table[i][j] = (table[i][j] * p - factor * table[row][j]) / denominator;
    }
    denominator = p;
    basis[row] = column;
    if (p < Number(0)) {
      // Keep the common denominator positive, so that signs in the table are signs of the numbers.
      denominator = -p;
      for (std::size_t i = 0; i < table.size(); ++i) {
        for (std::size_t j = 0; j < width; ++j)
          table[i][j] = -table[i][j];
      }
    }
  };
  // Pivots until the objective is at its maximum or, in the second phase, known to be positive.
  const auto maximise = [&](std::size_t objective, std::size_t candidates) {
    for (;;) {
      std::size_t column = 0;
      while (column < candidates && !(table[objective][column] > Number(0)))
        ++column;
      if (column == candidates)
        return;
      std::size_t row = rows;
      for (std::size_t i = 0; i < rows; ++i) {
        if (!(table[i][column] > Number(0)))
          continue;
        if (row == rows) {
          row = i;
          continue;
        }
        const Number left = table[i][width - 1] * table[row][column],
                     right = table[row][width - 1] * table[i][column];
        if (left < right || (left == right && basis[i] < basis[row]))
          row = i;
      }
      // Every polytope here is bounded.
      if (row == rows)
        return;
      pivot(row, column);
      if (objective == rows + 1 && table[objective][width - 1] < Number(0))
        return;
    }
  };

  maximise(rows, columns);
  if (table[rows][width - 1] != Number(0))
    return false;
  if (!is_any_positive)
    return true;
  // Artificial variables that are still in the basis are zero: drive them out, or drop their redundant row.
  for (std::size_t i = 0; i < rows; ++i) {
    if (basis[i] < columns)
      continue;
    for (std::size_t j = 0; j < columns; ++j) {
      if (table[i][j] != Number(0)) {
        pivot(i, j);
        break;
      }
    }
  }
  if (table[rows + 1][width - 1] < Number(0))
    return true;
  maximise(rows + 1, columns);
  return table[rows + 1][width - 1] < Number(0);
}

/// Whether conv(a) ∩ conv(b) has a point in which a vertex of b that is not marked in `shared` has a positive
/// weight. The vertices of b are affinely independent, so with `shared` marking those that are in conv(a)
/// too, this means: a point outside the simplex of the shared ones.
template <class Number>
bool meets_beyond(const std::vector<Point<Number>>& a, const std::vector<Point<Number>>& b,
                  const std::vector<bool>& shared)
{
  const std::size_t columns = a.size() + b.size();
  std::vector<std::vector<Number>> matrix(5, std::vector<Number>(columns, Number(0)));
  for (std::size_t j = 0; j < columns; ++j) {
    const bool is_a = j < a.size();
    for (std::size_t i = 0; i < 3; ++i)
      matrix[i][j] = is_a ? a[j][i] : -b[j - a.size()][i];
    matrix[3][j] = Number(is_a ? 1 : 0);
    matrix[4][j] = Number(is_a ? 0 : 1);
  }
  std::vector<bool> positive(columns, false);
  bool is_any_shared = false;
  for (std::size_t j = 0; j < b.size(); ++j) {
    positive[a.size() + j] = !shared[j];
    is_any_shared = is_any_shared || shared[j];
  }
  if (!is_any_shared)
    positive.assign(columns, false);
  else if (std::find(positive.begin(), positive.end(), true) == positive.end())
    return false;
  return is_feasible<Number>(matrix, {Number(0), Number(0), Number(0), Number(1), Number(1)}, positive);
}

template <class Number>
Point<Number> difference(const Point<Number>& p, const Point<Number>& q)
{
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

template <class Number>
Point<Number> cross(const Point<Number>& u, const Point<Number>& v)
{
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

template <class Number>
Number dot(const Point<Number>& u, const Point<Number>& v)
{
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

template <class Number>
bool are_collinear(const Point<Number>& p, const Point<Number>& q, const Point<Number>& r)
{
  return cross(difference(q, p), difference(r, p)) == Point<Number>{Number(0), Number(0), Number(0)};
}

/// Whether the face f keeps clear of the sweep conv(m, t, a, b): the definition, literally.
template <class Number>
bool is_sweep_clear(const Point<Number>& m, const Point<Number>& t, const Point<Number>& a,
                    const Point<Number>& b, const std::array<Point<Number>, 3>& f)
{
  std::vector<bool> shared(3);
  for (std::size_t j = 0; j < 3; ++j)
    shared[j] = f[j] == t || f[j] == a || f[j] == b;
  if (shared[0] && shared[1] && shared[2])
    return false;
  const std::vector<Point<Number>> sweep{m, t, a, b};
  if (!are_collinear(f[0], f[1], f[2]))
    return !meets_beyond<Number>(sweep, {f[0], f[1], f[2]}, shared);

  // A collinear face is the union of two segments that meet at its middle; look for a point of each outside
  // the hull of what is shared.
  std::size_t middle = 0;
  while (dot(difference(f[(middle + 1) % 3], f[middle]), difference(f[(middle + 2) % 3], f[middle])) >
         Number(0))
    ++middle;
  const std::size_t ends[2] = {(middle + 1) % 3, (middle + 2) % 3};
  const bool is_middle_shared = shared[middle] || (shared[ends[0]] && shared[ends[1]]);
  for (const std::size_t end : ends) {
    if (meets_beyond<Number>(sweep, {f[middle], f[end]}, {is_middle_shared, shared[end]}))
      return false;
  }
  return true;
}

/// A star in motion, as selvedge::Vertex_motion, in exact numbers.
template <class Number>
struct Star
{
  Point<Number> from, to;
  std::vector<std::array<Point<Number>, 2>> moving, contracted;
};

/// Whether the faces of the star at the point `apex` pairwise meet only in what they share, and none is
/// degenerate.
template <class Number>
bool is_star_embedded(const Point<Number>& apex, const std::vector<std::array<Point<Number>, 2>>& link)
{
  for (std::size_t i = 0; i < link.size(); ++i) {
    if (are_collinear(apex, link[i][0], link[i][1]))
      return false;
    for (std::size_t j = 0; j < i; ++j) {
      std::vector<bool> shared{true, false, false};
      for (std::size_t k = 0; k < 2; ++k)
        shared[k + 1] = link[j][k] == link[i][0] || link[j][k] == link[i][1];
      if ((shared[1] && shared[2]) ||
          meets_beyond<Number>({apex, link[i][0], link[i][1]}, {apex, link[j][0], link[j][1]}, shared))
        return false;
    }
  }
  return true;
}

/// Whether the faces of the star keep clear of each other at every time in (0, 1]: asked at every time at
/// which anything can change (all points collinear in some projection, or coplanar), and at one time between
/// any two of these. All coordinates are multiplied by the denominator of the time, so integers suffice.
template <class Number>
bool is_motion_clear_at_all_times(const Star<Number>& star)
{
  std::vector<Point<Number>> link;
  for (const auto* edges : {&star.moving, &star.contracted}) {
    for (const auto& edge : *edges) {
      for (const auto& p : edge) {
        if (std::find(link.begin(), link.end(), p) == link.end())
          link.push_back(p);
      }
    }
  }

  // Times are fractions with a positive denominator. Each function that matters is linear, with these values
  // at 0 and 1.
  using Time = std::pair<Number, Number>;
  std::vector<Time> times;
  const auto add_root = [&](const Number& start, const Number& end) {
    Number numerator = start, denominator = start - end;
    if (denominator < Number(0)) {
      numerator = -numerator;
      denominator = -denominator;
    }
    if (numerator > Number(0) && numerator < denominator)
      times.emplace_back(numerator, denominator);
  };
  for (std::size_t i = 0; i < link.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Point<Number> start = cross(difference(link[i], star.from), difference(link[j], star.from));
      const Point<Number> end = cross(difference(link[i], star.to), difference(link[j], star.to));
      for (std::size_t k = 0; k < 3; ++k)
        add_root(start[k], end[k]);
      for (std::size_t k = 0; k < j; ++k)
        add_root(dot(start, difference(link[k], star.from)), dot(end, difference(link[k], star.to)));
    }
  }
  times.emplace_back(Number(1), Number(1));
  const auto is_earlier = [](const Time& s, const Time& u) {
    return s.first * u.second < u.first * s.second;
  };
  std::sort(times.begin(), times.end(), is_earlier);

  std::vector<Time> samples;
  Time last(Number(0), Number(1));
  for (const Time& time : times) {
    if (!is_earlier(last, time))
      continue;
    // The mediant lies strictly between, and keeps the denominators small.
    samples.emplace_back(last.first + time.first, last.second + time.second);
    samples.push_back(time);
    last = time;
  }

  for (const Time& time : samples) {
    const auto scaled = [&](const Point<Number>& p) -> Point<Number> {
      return {p[0] * time.second, p[1] * time.second, p[2] * time.second};
    };
    const bool is_end = time.first == time.second;
    Point<Number> apex = scaled(star.from);
    for (std::size_t k = 0; k < 3; ++k)
      apex[k] = apex[k] + (star.to[k] - star.from[k]) * time.first;
    std::vector<std::array<Point<Number>, 2>> faces;
    for (const auto& edge : star.moving)
      faces.push_back({scaled(edge[0]), scaled(edge[1])});
    if (!is_end) {
      for (const auto& edge : star.contracted)
        faces.push_back({scaled(edge[0]), scaled(edge[1])});
    }
    if (!is_star_embedded(apex, faces))
      return false;
    // A contracted face is at the end the edge that it has become.
    for (std::size_t i = 0; is_end && i < star.contracted.size(); ++i) {
      for (const auto& edge : star.moving) {
        std::vector<bool> shared(2);
        for (std::size_t k = 0; k < 2; ++k)
          shared[k] = star.contracted[i][k] == star.to || star.contracted[i][k] == edge[0] ||
                      star.contracted[i][k] == edge[1];
        if (meets_beyond<Number>({star.to, edge[0], edge[1]}, {star.contracted[i][0], star.contracted[i][1]},
                                 shared))
          return false;
      }
    }
  }
  return true;
}

/// Whether the star keeps clear of itself at every time in (0, 1]: one face and two faces at a time, so that
/// few times matter to each question.
template <class Number>
bool is_star_motion_clear(const Star<Number>& star)
{
  const std::size_t moving = star.moving.size(), all = moving + star.contracted.size();
  for (std::size_t i = 0; i < all; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      Star<Number> part{star.from, star.to, {}, {}};
      for (const std::size_t k : i == j ? std::vector<std::size_t>{i} : std::vector<std::size_t>{i, j}) {
        if (k < moving)
          part.moving.push_back(star.moving[k]);
        else
          part.contracted.push_back(star.contracted[k - moving]);
      }
      if (!is_motion_clear_at_all_times(part))
        return false;
    }
  }
  return true;
}

} // namespace selvedge::oracle

#endif // SELVEDGE_TEST_SUPPORT_EXACT_ORACLE_H
