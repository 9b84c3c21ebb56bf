// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Motion_judge.h"

#include "clearance.h"
#include "limits.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace selvedge::reference {
namespace {

// Returns an OBJ file of what meets, and where the vertex goes.
std::string scene(const Place& from, const Place& to, const std::array<Place, 3>& after,
                  const std::array<Place, 3>* other)
{
  std::string text =
      "# The moving triangle before and after, the triangle that it meets, and the way of the vertex.\n";
  std::size_t vertices = 0;
  const auto add = [&](const char* object, const char* element, const std::vector<Place>& places) {
    text += std::string("o ") + object + '\n';
    std::string numbers;
    for (const Place& place : places) {
      text += 'v';
      for (const double coordinate : place.at) {
        char digits[32];
        text += ' ' + std::string(digits, std::to_chars(digits, digits + sizeof digits, coordinate).ptr);
      }
      text += '\n';
      numbers += ' ' + std::to_string(++vertices);
    }
    text += element + numbers + '\n';
  };
  add("before", "f", {from, after[1], after[2]});
  add("after", "f", {after[0], after[1], after[2]});
  if (other)
    add("other", "f", {(*other)[0], (*other)[1], (*other)[2]});
  add("way", "l", {from, to});
  return text;
}

} // namespace

struct Motion_judge::Moving_face
{
  Index face;
  Sweep sweep;
  Box box; // of all that it sweeps over
  std::array<Place, 3> after;
};

/// The faces at the mover, without those that are contracted within the segment that they are.
struct Motion_judge::Star
{
  std::vector<Moving_face> moving;               // those that are not contracted
  std::vector<std::pair<Index, Standing>> sides; // of all, the sides opposite the mover
  std::vector<Index> standing;                   // other faces near
};

void Motion_judge::find_pieces()
{
  if (m_clearance)
    m_pieces = pieces_of(complex());
}

std::optional<Objection> Motion_judge::meeting(const Motion& motion)
{
  Star star;
  if (auto objection = gather(motion, star))
    return objection;
  for (const Moving_face& face : star.moving)
    if (face.sweep.degenerates())
      return Objection{Violation_kind::degenerate,
                       "a triangle has no area at some time on the way",
                       {face.face},
                       {},
                       scene(complex().place(motion.mover), motion.target, face.after, nullptr)};
  // The end comes before the way, since what is wrong there is easier to see.
  if (auto objection = meeting_at_end(motion, star))
    return objection;
  return meeting_on_way(motion, star);
}

// Returns an objection when a contracted face turns over within the segment that it is.
std::optional<Objection> Motion_judge::gather(const Motion& motion, Star& star)
{
  const Place m = complex().place(motion.mover);
  Box box;
  box.add(m.at);
  box.add(motion.target.at);
  for (const Index f : complex().faces_at(motion.mover)) {
    const auto [p, q] = complex().opposite_side(f, motion.mover);
    const Place a = complex().place(p), b = complex().place(q);
    const bool is_contracted = p == motion.target.id || q == motion.target.id;
    if (is_contracted && is_degenerate({m, a, b})) {
      // It stays within the segment that it is, and meets no more than before, unless it turns over.
      if (is_between(m, p == motion.target.id ? b : a, motion.target))
        return Objection{Violation_kind::degenerate,
                         "a triangle without an area turns over: its corner passes over another",
                         {f}};
      continue;
    }
    star.sides.push_back({f, {{a, b, b}, 2}});
    if (is_contracted)
      continue;
    Box around = box_of({m, a, b});
    around.add(motion.target.at);
    star.moving.push_back(
        {f, Sweep(m, motion.target, a, b, m_mesh.statistics()), around, {motion.target, a, b}});
    box.add(around);
  }
  star.standing = m_mesh.faces_near(box, [&](Index f) { return !complex().has(f, motion.mover); });
  return std::nullopt;
}

std::optional<Objection> Motion_judge::meeting_at_end(const Motion& motion, const Star& star)
{
  for (const Moving_face& face : star.moving) {
    Cancellation_scope::check();
    const Box end = box_of(face.after);
    const auto meets = [&](Index other, const std::array<Place, 3>& triangle) {
      return !m_mesh.is_exempt(face.face, other) && do_meet(face.after, triangle, m_mesh.statistics());
    };
    const auto objection_to = [&](Index other, const std::array<Place, 3>& triangle) {
      return between(Violation_kind::intersection, motion, face, other, triangle,
                     meeting_point(face.after, triangle));
    };
    for (const Index f : star.standing)
      if (end.overlaps(m_mesh.box(f)) && meets(f, complex().triangle(f)))
        return objection_to(f, complex().triangle(f));
    for (const Moving_face& other : star.moving)
      if (other.face < face.face && meets(other.face, other.after))
        return objection_to(other.face, other.after);
  }
  return std::nullopt;
}

std::optional<Objection> Motion_judge::meeting_on_way(const Motion& motion, const Star& star)
{
  for (const Moving_face& face : star.moving) {
    Cancellation_scope::check();
    for (const Index f : star.standing) {
      if (!face.box.overlaps(m_mesh.box(f)) || m_mesh.is_exempt(face.face, f))
        continue;
      const Standing standing{complex().triangle(f), 3};
      if (face.sweep.touches(standing))
        return between(Violation_kind::tunnelling, motion, face, f, standing.corners,
                       face.sweep.contact(standing));
    }
    for (const auto& [f, side] : star.sides)
      if (f != face.face && !m_mesh.is_exempt(face.face, f) && face.sweep.touches(side))
        return between(Violation_kind::tunnelling, motion, face, f, complex().triangle(f),
                       face.sweep.contact(side));
  }
  return std::nullopt;
}

Objection Motion_judge::between(Violation_kind kind, const Motion& motion, const Moving_face& face,
                                Index other, const std::array<Place, 3>& triangle_of_other,
                                const std::optional<std::string>& point) const
{
  return {kind,
          "triangles " + name(face.face) + " and " + name(other) +
              (kind == Violation_kind::intersection ? " intersect afterwards"
                                                    : " are apart afterwards, but meet on the way"),
          {face.face, other},
          point.value_or(""),
          scene(complex().place(motion.mover), motion.target, face.after, &triangle_of_other)};
}

std::string Motion_judge::name(Index face) const
{
  const std::size_t number = m_start.numbers[face] + 1;
  return complex().is_of_obstacle(face)
             ? std::to_string(number - m_triangles_of_original) + " of the obstacle"
             : std::to_string(number);
}

std::optional<Objection> Motion_judge::lack_of_clearance(const Motion& motion)
{
  if (!m_clearance)
    return std::nullopt;
  const Coordinates from = complex().point(motion.mover), to = motion.target.at;
  Clearance_question question{*m_clearance, {}, {}};
  Box box;
  box.add(from);
  box.add(to);
  for (const Index f : complex().faces_at(motion.mover)) {
    const auto [p, q] = complex().opposite_side(f, motion.mover);
    const Coordinates a = complex().point(p), b = complex().point(q);
    question.star.push_back({from, a, b});
    box.add(a);
    box.add(b);
    if (p == motion.target.id || q == motion.target.id)
      continue;
    question.facets.push_back({to, a, b});
    question.facets.push_back({from, to, a});
    question.facets.push_back({from, to, b});
  }
  std::sort(question.facets.begin(), question.facets.end());
  question.facets.erase(std::unique(question.facets.begin(), question.facets.end()), question.facets.end());
  for (int axis = 0; axis < 3; ++axis) {
    // A sum rounds by half of the last digit, and so by less than a step to the next number.
    box.low[axis] = std::nextafter(box.low[axis] - *m_clearance, -HUGE_VAL);
    box.high[axis] = std::nextafter(box.high[axis] + *m_clearance, HUGE_VAL);
  }
  const Index moving = complex().faces_at(motion.mover).front();
  const auto is_of_other_piece = [&](Index f) {
    return complex().is_of_obstacle(f) || m_pieces[complex().face(f).positions[0]] != m_pieces[motion.mover];
  };
  for (const Index f : m_mesh.faces_near(box, is_of_other_piece)) {
    Cancellation_scope::check();
    const std::array<Place, 3> standing = complex().triangle(f);
    if (!m_mesh.is_exempt(moving, f) &&
        !is_clearance_kept(question, {standing[0].at, standing[1].at, standing[2].at}))
      return Objection{
          Violation_kind::clearance, message_of_limit(Violation_kind::clearance, *m_clearance), {moving, f}};
  }
  return std::nullopt;
}

} // namespace selvedge::reference
