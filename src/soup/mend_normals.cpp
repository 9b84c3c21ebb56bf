// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/normals.h>

#include "Disjoint_sets.h"
#include "inner_edges.h"
#include "number_positions.h"
#include "selection.h"
#include "triangle_normals.h"

#include <selvedge/internal/Vector_of_doubles.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace selvedge {
namespace {

using internal::dot;
using internal::Edge_side;
using shading::normal_at;
using shading::s_cosine_of_shading;
using shading::Vector;

class Normal_mending
{
public:
  explicit Normal_mending(Triangle_soup& result)
      : m_result(result), m_fronts(result.triangles.size()), m_is_wrong(3 * result.triangles.size(), false),
        m_is_free(m_is_wrong)
  {
  }

  std::size_t run(const std::vector<Index>& triangles, const Triangle_soup& original,
                  const Corner_values<3>& normals)
  {
    for (Index t = 0; t < m_result.triangles.size(); ++t)
      if (m_result.normals.has(t))
        judge(t, triangles[t], original, normals);
    if (std::find(m_is_wrong.begin(), m_is_wrong.end(), true) == m_is_wrong.end())
      return 0;
    return renew(fans());
  }

private:
  // Finds out which corners of a triangle need a new normal, and which may get one along with others.
  void judge(Index t, Index before, const Triangle_soup& original, const Corner_values<3>& normals)
  {
    const Vector front = shading::unit_normal(m_result, t);
    const std::array<double, 3> cosines = shading::cosines(front, m_result.normals, t);
    const std::array<double, 3> cosines_before =
        shading::cosines(shading::unit_normal(original, before), normals, before);
    const int side = shading::side_of(cosines_before);
    double limit = s_cosine_of_shading;
    for (const double cosine : cosines_before)
      limit = std::min(limit, side * cosine);
    shading::add(m_fronts[t], front, side);
    bool is_changed = false;
    for (std::size_t k = 0; k < 3; ++k)
      is_changed |=
          m_result.points[m_result.triangles[t][k]] != original.points[original.triangles[before][k]];
    for (std::size_t k = 0; k < 3; ++k) {
      m_is_wrong[3 * t + k] = side != 0 && side * cosines[k] < limit;
      m_is_free[3 * t + k] = m_is_wrong[3 * t + k] || is_changed;
    }
  }

  // Unites corners that get one normal. Seams of the texture are no hard edges: triangles meet where they
  // have positions in common.
  internal::Disjoint_sets fans() const
  {
    internal::Disjoint_sets result(m_is_wrong.size());
    const std::vector<Index_triple> triples =
        in_positions(m_result.triangles, number_positions(m_result.points));
    internal::for_each_inner_edge(triples, [&](const Edge_side& a, const Edge_side& b) {
      if (dot(m_fronts[a.at_low / 3], m_fronts[b.at_low / 3]) < s_cosine_of_shading)
        return;
      for (const auto& [of_a, of_b] : {std::pair(a.at_low, b.at_low), std::pair(a.at_high, b.at_high)})
        if (m_is_free[of_a] && m_is_free[of_b] &&
            ((m_is_wrong[of_a] && m_is_wrong[of_b]) ||
             shading::is_within(normal_at(m_result.normals, of_a / 3, of_a % 3),
                                normal_at(m_result.normals, of_b / 3, of_b % 3), shading::s_cosine_smooth)))
          result.unite(of_a, of_b);
    });
    return result;
  }

  // Gives the corners of every fan in which one is wrong their mean normal, or that of their triangle where
  // the mean is too far from it. Returns their number.
  std::size_t renew(internal::Disjoint_sets fans)
  {
    const Index corner_count = Index(m_is_wrong.size());
    std::vector<char> is_renewed(corner_count, false); // by fan
    for (Index corner = 0; corner < corner_count; ++corner)
      if (m_is_wrong[corner])
        is_renewed[fans.find(corner)] = true;
    std::vector<Vector> sums(corner_count); // by fan
    std::size_t mended = 0;
    for (Index corner = 0; corner < corner_count; ++corner)
      if (const std::size_t fan = fans.find(corner); is_renewed[fan]) {
        shading::add(sums[fan], m_fronts[corner / 3], shading::angle_at(m_result, corner));
        ++mended;
      }
    constexpr Index none = std::numeric_limits<Index>::max();
    std::vector<Index> numbers(corner_count, none); // of the means, by fan
    for (Index corner = 0; corner < corner_count; ++corner) {
      const std::size_t fan = fans.find(corner);
      if (!is_renewed[fan])
        continue;
      Index& number = m_result.normals.of_triangle[corner / 3][corner % 3];
      const Vector &front = m_fronts[corner / 3], mean = shading::stored(shading::unit(sums[fan]));
      if (dot(mean, front) < s_cosine_of_shading) {
        number = added(shading::stored(front));
        continue;
      }
      if (numbers[fan] == none)
        numbers[fan] = added(mean);
      number = numbers[fan];
    }
    Corner_values<3>& normals = m_result.normals;
    normals = with_used(normals.values, std::move(normals.of_triangle), normals.missing);
    return mended;
  }

  Index added(const Vector& normal)
  {
    m_result.normals.values.push_back(normal);
    return Index(m_result.normals.values.size() - 1);
  }

  Triangle_soup& m_result;
  std::vector<Vector> m_fronts; // by triangle: of length 1, on the side where the normals point to
  std::vector<char> m_is_wrong; // by corner: needs a new normal
  std::vector<char> m_is_free;  // by corner: may get one
};

} // namespace

std::size_t mend_normals(Triangle_soup& result, const std::vector<Index>& triangles,
                         const Triangle_soup& original, const Corner_values<3>& normals)
{
  return result.normals.empty() ? 0 : Normal_mending(result).run(triangles, original, normals);
}

} // namespace selvedge
