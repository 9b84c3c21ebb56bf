// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_STOP_PREDICATES_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_STOP_PREDICATES_H

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <tuple>
#include <utility>

namespace selvedge {

/// Stops when the mesh has at most a given number of faces.
///
/// A model of CGAL's concept `StopPredicate`. A collapse removes two faces, or one at a border, so the result
/// may have one face fewer than asked for. It does not compile for OpenMesh, whose num_faces() counts removed
/// faces, too: use a stop predicate of CGAL that counts edges.
class Face_count_stop
{
public:
  explicit Face_count_stop(std::size_t faces) : m_faces(faces) {}

  /// Returns the number of faces at which it stops.
  std::size_t target() const { return m_faces; }

  template <class FT, class Profile>
  bool operator()(const FT&, const Profile& profile, std::size_t, std::size_t) const
  {
    return internal::face_count(profile.surface_mesh()) <= m_faces;
  }

private:
  std::size_t m_faces;
};

/// Stops when the mesh has at most a given share of the faces that it had when this object was made.
///
/// A model of CGAL's concept `StopPredicate`.
class Face_ratio_stop : public Face_count_stop
{
public:
  /// `ratio` lies in [0, 1], or `Argument_error` is thrown. The target is ratio × faces, rounded to nearest.
  template <class TriangleMesh>
  Face_ratio_stop(double ratio, const TriangleMesh& mesh)
      : Face_count_stop(face_target(ratio, internal::face_count(mesh)))
  {
  }

  /// Returns the target for a ratio of a number of faces.
  static std::size_t face_target(double ratio, std::size_t faces)
  {
    if (!(ratio >= 0 && ratio <= 1))
      throw Argument_error("a ratio of faces lies between 0 and 1");
    return std::size_t(std::llround(ratio * double(faces)));
  }
};

/// Stops before the first collapse that costs more than a given amount, in units of the cost policy.
///
/// A model of CGAL's concept `StopPredicate`.
class Cost_stop
{
public:
  explicit Cost_stop(double cost) : m_cost(cost) {}

  template <class FT, class Profile>
  bool operator()(const FT& cost, const Profile&, std::size_t, std::size_t) const
  {
    return cost > m_cost;
  }

private:
  double m_cost;
};

/// Stops when a function of the caller returns true, to cancel or to show progress.
///
/// A model of CGAL's concept `StopPredicate`. The function gets the number of faces that the mesh has now. It
/// is called for the first edge that the loop considers and for every 256th after it. (A visitor cannot end
/// the loop, and an exception could leave the mesh in the middle of a collapse.)
class Hook_stop
{
public:
  explicit Hook_stop(std::function<bool(std::size_t faces)> should_stop)
      : m_should_stop(std::move(should_stop))
  {
  }

  template <class FT, class Profile>
  bool operator()(const FT&, const Profile& profile, std::size_t, std::size_t) const
  {
    return m_should_stop && m_calls++ % 256 == 0 &&
           m_should_stop(internal::face_count(profile.surface_mesh()));
  }

private:
  std::function<bool(std::size_t)> m_should_stop;
  mutable std::size_t m_calls = 0;
};

namespace internal {

/// Stops when a function of the cost returns true.
template <class Function>
class Function_stop
{
public:
  explicit Function_stop(const Function& is_over) : m_is_over(is_over) {}

  template <class FT, class Profile>
  bool operator()(const FT& cost, const Profile&, std::size_t, std::size_t) const
  {
    return m_is_over(CGAL::to_double(cost));
  }

private:
  Function m_is_over;
};

} // namespace internal

/// Stops when any of several predicates does. They are asked in order, each time, until one of them does.
///
/// A model of CGAL's concept `StopPredicate` when all of `Stops` are.
template <class... Stops>
class Any_stop
{
public:
  explicit Any_stop(Stops... stops) : m_stops(std::move(stops)...) {}

  template <class FT, class Profile>
  bool operator()(const FT& cost, const Profile& profile, std::size_t initial, std::size_t current) const
  {
    return std::apply([&](const auto&... stop) { return (stop(cost, profile, initial, current) || ...); },
                      m_stops);
  }

private:
  std::tuple<Stops...> m_stops;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_STOP_PREDICATES_H
