// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "limits.h"

#include <algorithm>
#include <charconv>
#include <cmath>

// Computes angles, shapes and drift anew for `replay`, and compares them with the limits that a log declares.

namespace selvedge::reference {
namespace {

constexpr double s_degree = 3.14159265358979323846 / 180;
// More than rounding adds to the distance from a point to a segment, as a share of the diagonal.
constexpr double s_rounded_distance = 0x1p-46;

Coordinates difference(const Coordinates& u, const Coordinates& v)
{
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
double dot(const Coordinates& u, const Coordinates& v)
{
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
double length(const Coordinates& v)
{
  return std::sqrt(dot(v, v));
}
Coordinates cross(const Coordinates& u, const Coordinates& v)
{
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

bool is_angle_within(const Coordinates& u, const Coordinates& v, double degrees)
{
  return degrees >= 180 ||
         dot(u, v) >= (std::cos(degrees * s_degree) - limit_tolerance) * length(u) * length(v);
}

double distance_to_segment(const Coordinates& p, const Coordinates& a, const Coordinates& b)
{
  const Coordinates along = difference(b, a), to_p = difference(p, a);
  const double square = dot(along, along);
  const double share = square > 0 ? std::clamp(dot(to_p, along) / square, 0.0, 1.0) : 0;
  return length({to_p[0] - share * along[0], to_p[1] - share * along[1], to_p[2] - share * along[2]});
}

std::string with_unit(double limit, const Limit_description& description)
{
  char number[32];
  return std::string(number, std::to_chars(number, number + sizeof number, limit).ptr) + description.unit;
}

double aspect_ratio(const Coordinates& a, const Coordinates& b, const Coordinates& c)
{
  const double longest =
      std::max({length(difference(a, b)), length(difference(b, c)), length(difference(c, a))});
  return longest > 0
             ? 2 / std::sqrt(3.0) * length(cross(difference(b, a), difference(c, a))) / (longest * longest)
             : 0;
}

} // namespace

double distance(const Coordinates& a, const Coordinates& b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

const Limit_description* limit_of(Violation_kind kind)
{
  switch (kind) {
  case Violation_kind::normal_change:
    return &describe(&Reduction_limits::normal_change);
  case Violation_kind::aspect_ratio:
    return &describe(&Reduction_limits::aspect_ratio);
  case Violation_kind::border_turn:
    return &describe(&Reduction_limits::border_turn);
  case Violation_kind::seam_turn:
    return &describe(&Reduction_limits::seam_turn);
  case Violation_kind::border_drift:
    return &describe(&Reduction_limits::border_drift);
  case Violation_kind::weld_distance:
    return &describe(&Reduction_limits::weld_distance);
  case Violation_kind::clearance:
    return &describe(&Reduction_limits::clearance);
  default:
    return nullptr;
  }
}

std::string message_of_limit(Violation_kind kind, double limit)
{
  const Limit_description& description = *limit_of(kind);
  return std::string(description.broken) + ' ' + with_unit(limit, description);
}

void Limits::set_size(const Coordinates& low, const Coordinates& high)
{
  double largest = 0;
  for (const Coordinates& corner : {low, high})
    for (const double coordinate : corner)
      largest = std::max(largest, std::abs(coordinate));
  std::frexp(largest, &m_exponent);
  set_diagonal(low, high);
}

void Limits::set_diagonal(const Coordinates& low, const Coordinates& high)
{
  m_diagonal = length(difference(scaled(high), scaled(low)));
}

double Limits::highest(double limit) const
{
  return (limit * (1 + limit_tolerance) + s_rounded_distance) * m_diagonal;
}

Coordinates Limits::scaled(const Coordinates& point) const
{
  return {std::ldexp(point[0], -m_exponent), std::ldexp(point[1], -m_exponent),
          std::ldexp(point[2], -m_exponent)};
}

std::optional<Violation_kind> Limits::judge(const Complex& complex, Index removed, Index kept,
                                            const Coordinates& place, bool is_kept_still) const
{
  if (m_limits.border_turn || m_limits.seam_turn || m_limits.border_drift) {
    if (takes_needed_line(complex, removed, kept))
      return Violation_kind::line;
    if (const auto kind = judge_line(complex, removed, kept, place))
      return kind;
    if (!is_kept_still)
      if (const auto kind = judge_line(complex, kept, removed, place))
        return kind;
  }
  return judge_shapes(complex, removed, kept, place, is_kept_still);
}

std::optional<Violation_kind> Limits::judge_line(const Complex& complex, Index mover, Index other,
                                                 const Coordinates& place) const
{
  if (place == complex.point(mover))
    return std::nullopt;
  std::vector<Complex::Edge> lines = complex.edges_at(mover);
  const bool ends_at_other = std::any_of(lines.begin(), lines.end(), [&](const Complex::Edge& edge) {
    return edge.neighbour == other && !edge.is_line() && edge.is_line_beyond();
  });
  const auto is_far = [&](const Coordinates& q, double limit, const Coordinates& u) {
    return distance_to_segment(scaled(q), u, scaled(place)) > highest(limit);
  };
  const auto drifts_within = [&](double limit, Index neighbour, const Coordinates& u) {
    const auto* passed = complex.passed(mover, neighbour);
    return !passed || std::none_of(passed->begin(), passed->end(),
                                   [&](const Coordinates& q) { return is_far(q, limit, u); });
  };
  const auto others = std::stable_partition(lines.begin(), lines.end(),
                                            [](const Complex::Edge& edge) { return edge.is_line(); });
  if (others == lines.begin()) {
    if (ends_at_other)
      return Violation_kind::line;
    const bool does_drift = std::any_of(lines.begin(), lines.end(), [&](const Complex::Edge& edge) {
      return m_limits.border_drift && edge.is_line_beyond() &&
             !drifts_within(*m_limits.border_drift, edge.neighbour, scaled(complex.point(edge.neighbour)));
    });
    return does_drift ? std::optional(Violation_kind::border_drift) : std::nullopt;
  }
  lines.erase(others, lines.end());
  const auto ahead = std::find_if(lines.begin(), lines.end(),
                                  [&](const Complex::Edge& edge) { return edge.neighbour == other; });
  if (ahead == lines.end() || lines.size() != 2)
    return Violation_kind::line;
  const Complex::Edge& behind = lines[ahead == lines.begin() ? 1 : 0];
  if (behind.is_border() != ahead->is_border())
    return Violation_kind::line;
  const Coordinates m = scaled(complex.point(mover)), u = scaled(complex.point(behind.neighbour)),
                    p = scaled(place);
  const auto& turn = ahead->is_border() ? m_limits.border_turn : m_limits.seam_turn;
  const auto line_drifts_within = [&](double limit) {
    return !is_far(complex.point(mover), limit, u) && drifts_within(limit, behind.neighbour, u) &&
           drifts_within(limit, other, u);
  };
  if (turn && !is_angle_within(difference(m, u), difference(p, m), *turn)) {
    if (!ahead->is_border())
      return Violation_kind::seam_turn;
    if (!has_low_corners() || !line_drifts_within(*m_limits.corner_height))
      return Violation_kind::border_turn;
  }
  if (m_limits.border_drift && !line_drifts_within(*m_limits.border_drift))
    return Violation_kind::border_drift;
  return std::nullopt;
}

// Whether two lines become one at a position beside the edge, where at most two end.
bool Limits::takes_needed_line(const Complex& complex, Index removed, Index kept)
{
  for (const Index f : complex.faces_at(removed)) {
    if (!complex.has(f, kept))
      continue;
    const auto [p, q] = complex.opposite_side(f, removed);
    std::vector<Complex::Edge> edges = complex.edges_at(p == kept ? q : p);
    edges.erase(
        std::remove_if(edges.begin(), edges.end(), [](const Complex::Edge& edge) { return !edge.is_line(); }),
        edges.end());
    const auto merging = std::count_if(edges.begin(), edges.end(), [&](const Complex::Edge& edge) {
      return edge.neighbour == removed || edge.neighbour == kept;
    });
    if (merging == 2 && edges.size() == 2)
      return true;
  }
  return false;
}

// Whether a face lies in a strip between two lines: its corners are on lines when its corner `mover` has
// merged with `other`, and at most one of its edges is a line. The limit of the aspect ratio leaves it out.
bool Limits::is_of_strip(const Complex& complex, Index face, Index mover, Index other) const
{
  const auto [p, q] = complex.opposite_side(face, mover);
  const auto is_on_line = [&](Index position) {
    const auto edges = complex.edges_at(position);
    return std::any_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.is_line(); });
  };
  const auto is_line = [&](Index from, Index to) {
    const auto edges = complex.edges_at(from);
    return std::any_of(edges.begin(), edges.end(), [&](const auto& edge) {
      return edge.neighbour == to && edge.is_line() && edge.is_line_beyond();
    });
  };
  return is_on_line(p) && is_on_line(q) && (is_on_line(mover) || is_on_line(other)) &&
         int(is_line(mover, p)) + int(is_line(p, q)) + int(is_line(q, mover)) <= 1;
}

std::optional<Violation_kind> Limits::judge_shapes(const Complex& complex, Index removed, Index kept,
                                                   const Coordinates& place, bool is_kept_still) const
{
  double least_before = 1, least_after = 1;
  bool is_turned = false;
  const auto add = [&](Index mover, Index other) {
    for (const Index f : complex.faces_at(mover)) {
      if (complex.has(f, other))
        continue;
      const auto [p, q] = complex.opposite_side(f, mover);
      const Coordinates m = scaled(complex.point(mover)), a = scaled(complex.point(p)),
                        b = scaled(complex.point(q)), goal = scaled(place);
      least_before = std::min(least_before, aspect_ratio(m, a, b));
      if (const double ratio = aspect_ratio(goal, a, b); m_limits.aspect_ratio && ratio < least_after &&
                                                         ratio < *m_limits.aspect_ratio &&
                                                         !is_of_strip(complex, f, mover, other))
        least_after = ratio;
      const Coordinates before = cross(difference(a, m), difference(b, m));
      const Coordinates after = cross(difference(a, goal), difference(b, goal));
      const bool is_low =
          has_low_corners() && std::max(length(before), length(after)) <=
                                   highest(*m_limits.corner_height) * length(difference(b, a));
      if (m_limits.normal_change && length(before) > 0)
        is_turned = is_turned || !(length(after) > 0) ||
                    (!is_low && !is_angle_within(before, after, *m_limits.normal_change));
    }
  };
  add(removed, kept);
  if (!is_kept_still)
    add(kept, removed);
  if (is_turned)
    return Violation_kind::normal_change;
  if (m_limits.aspect_ratio && least_after < *m_limits.aspect_ratio * (1 - limit_tolerance) &&
      least_after <= least_before * (1 - limit_tolerance))
    return Violation_kind::aspect_ratio;
  return std::nullopt;
}

std::string Limits::message(Violation_kind kind) const
{
  if (kind == Violation_kind::line)
    return "the vertex that moves leaves its border or seam, or is a corner or an end of it, or a seam "
           "beside it would end";
  std::string message = message_of_limit(kind, *(m_limits.*limit_of(kind)->value));
  if ((kind == Violation_kind::normal_change || kind == Violation_kind::border_turn) && has_low_corners())
    message += ", at a corner higher than " +
               with_unit(*m_limits.corner_height, describe(&Reduction_limits::corner_height));
  if (kind == Violation_kind::normal_change)
    message += ", or has none afterwards";
  return message;
}

} // namespace selvedge::reference
