// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What the guard says of every collapse in small scenes, against the three conditions asked of everything:
// both must give the same answer, while the mesh changes.

#include "support/mesh_of.h"
#include "support/reduction.h"

#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/geometry/star.h>
#include <selvedge/geometry/sweep.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

using Vertex = Mesh::Vertex_index;
using Halfedge = Mesh::Halfedge_index;
using Random = std::mt19937_64;
using Profile = internal::Lazy_edge_profile<Mesh, Mesh::Property_map<Vertex, Point_3>, Kernel>;

int below(Random& random, int n)
{
  return std::uniform_int_distribution<int>(0, n - 1)(random);
}

/// The conditions as they are written down, over all faces.
class Reference
{
public:
  explicit Reference(const Mesh& mesh) : m_mesh(mesh), m_soup(soup_of(mesh)) {}

  bool is_clear(Vertex v0, Vertex v1, const Point_3& place) const
  {
    if (place == point(v0))
      return is_motion_clear(v1, v0, place);
    if (place == point(v1))
      return is_motion_clear(v0, v1, place);
    const auto are_both_clear = [&](Vertex first, Vertex second) {
      if (!is_motion_clear(first, std::nullopt, place))
        return false;
      Reference between = *this;
      between.m_soup.points[first] = place;
      return between.is_motion_clear(second, first, place);
    };
    return !has_twin(v0) && !has_twin(v1) && (are_both_clear(v1, v0) || are_both_clear(v0, v1));
  }

private:
  const Point_3& point(Index v) const { return m_soup.points[v]; }

  bool has_twin(Index m) const
  {
    return any_face([&](const Index_triple& face) {
      return std::any_of(face.begin(), face.end(), [&](Index v) { return v != m && point(v) == point(m); });
    });
  }

  template <class Predicate>
  bool any_face(const Predicate& predicate) const
  {
    return std::any_of(m_soup.triangles.begin(), m_soup.triangles.end(), predicate);
  }

  bool is_motion_clear(Vertex m, std::optional<Vertex> t, const Point_3& place) const
  {
    Vertex_motion<Point_3> motion{point(m), place, {}, {}};
    std::vector<Index_triple> others;
    std::vector<Index> apexes;
    for (Index_triple face : m_soup.triangles) {
      const auto at_m = std::find(face.begin(), face.end(), Index(m));
      if (at_m == face.end()) {
        others.push_back(face);
        continue;
      }
      std::rotate(face.begin(), at_m, face.end());
      const auto& [from, a, b] = face;
      const bool is_contracted = t && (a == *t || b == *t);
      if (is_contracted)
        apexes.push_back(a == *t ? b : a);
      else if (point(a) == place || point(b) == place)
        return false;
      (is_contracted ? motion.contracted : motion.moving).push_back({point(a), point(b)});
    }
    const auto has_point = [&](const Index_triple& face, const Point_3& p) {
      return point(face[0]) == p || point(face[1]) == p || point(face[2]) == p;
    };
    if (has_twin(m) || (t && !is_link_condition_met(m, *t, apexes)) ||
        (!t && any_face([&](const Index_triple& face) { return has_point(face, place); })) ||
        !is_star_motion_clear<Kernel>(motion))
      return false;
    for (const auto& [a, b] : motion.moving) {
      const Sweep_test<Kernel> sweep(motion.from, motion.to, a, b);
      for (const Index_triple& face : others)
        if (!sweep.is_clear(point(face[0]), point(face[1]), point(face[2])))
          return false;
    }
    return true;
  }

  std::set<Point_3> neighbours(const Point_3& p) const
  {
    std::set<Point_3> result;
    for (const Index_triple& face : m_soup.triangles)
      if (std::any_of(face.begin(), face.end(), [&](Index v) { return point(v) == p; }))
        for (const Index v : face)
          result.insert(point(v));
    result.erase(p);
    return result;
  }

  bool is_link_condition_met(Vertex m, Vertex t, const std::vector<Index>& apexes) const
  {
    const auto is_border_edge = [this](Vertex v, Vertex w) {
      return m_mesh.is_border(m_mesh.edge(m_mesh.halfedge(v, w)));
    };
    std::set<Point_3> allowed;
    for (const Index apex : apexes) {
      if (is_border_edge(m, Vertex(apex)) && is_border_edge(t, Vertex(apex)))
        return false;
      allowed.insert(point(apex));
    }
    const std::set<Point_3> of_m = neighbours(point(m));
    for (const Point_3& p : neighbours(point(t)))
      if (of_m.count(p) > 0 && allowed.count(p) == 0)
        return false;
    const auto vertices = m_mesh.vertices();
    const bool is_t_on_border = std::any_of(vertices.begin(), vertices.end(), [&](Vertex v) {
      return point(v) == point(t) && m_mesh.is_border(v);
    });
    return !m_mesh.is_border(m) || !is_t_on_border || is_border_edge(m, t);
  }

  const Mesh& m_mesh;
  Triangle_soup m_soup;
};

/// The points of a scene.
using Draw = std::function<Point_3()>;

/// A star of distinct directions around the first vertex, or nothing.
Mesh star(const Point_3& centre, const Draw& draw, int size, bool is_closed)
{
  const auto angle = [&](const Point_3& p) { return std::atan2(p.y() - centre.y(), p.x() - centre.x()); };
  const auto is_less = [&](const Point_3& p, const Point_3& q) { return angle(p) < angle(q); };
  std::set<Point_3, decltype(is_less)> link(is_less);
  for (int i = 0; i < size; ++i)
    link.insert(draw());
  Mesh mesh;
  const Vertex from = mesh.add_vertex(centre);
  std::vector<Vertex> ring;
  for (const Point_3& p : link)
    if (p.x() != centre.x() || p.y() != centre.y())
      ring.push_back(mesh.add_vertex(p));
  if (ring.size() > 2)
    for (std::size_t i = 0; i + (is_closed ? 0 : 1) < ring.size(); ++i)
      mesh.add_face(from, ring[i], ring[(i + 1) % ring.size()]);
  return mesh;
}

/// Two fans around the first vertex, joined where they begin and end: in one position, at two vertices. Seen
/// from above, the link winds twice. The wide fan is above the other only as long as the first vertex is
/// high.
Mesh double_fan(Random& random)
{
  Mesh mesh;
  const Vertex from = mesh.add_vertex({0, 0, double(3 + below(random, 6))});
  std::vector<Vertex> ring;
  for (const int size : {1, 4}) {
    ring.push_back(mesh.add_vertex({5, 0, 0}));
    for (const int y : {size, -size})
      ring.push_back(mesh.add_vertex({double(-size), double(y), double(below(random, 3))}));
  }
  for (std::size_t i = 0; i < ring.size(); ++i)
    mesh.add_face(from, ring[i], ring[(i + 1) % ring.size()]);
  return mesh;
}

/// Sheets of 2 × 2 squares with bumps, above one another.
Mesh layers(Random& random)
{
  Mesh mesh;
  for (int layer = 0; layer < 3; ++layer) {
    std::array<std::array<Vertex, 3>, 3> v;
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x)
        v[y][x] = mesh.add_vertex({double(x), double(y), double(2 * layer + below(random, 2))});
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x) {
        mesh.add_face(v[y][x], v[y][x + 1], v[y + 1][x + 1]);
        mesh.add_face(v[y][x], v[y + 1][x + 1], v[y + 1][x]);
      }
  }
  return mesh;
}

/// Adds faces, at borders or apart, some of whose corners are where others already are.
void add_faces(Mesh& mesh, const Draw& draw, Random& random)
{
  for (int i = 0; i < 12; ++i) {
    Mesh larger = mesh;
    const auto new_vertex = [&] {
      const Point_3 p =
          below(random, 4) == 0 ? mesh.point(Vertex(below(random, mesh.num_vertices()))) : draw();
      return larger.add_vertex(p);
    };
    const Halfedge h(below(random, mesh.num_halfedges()));
    const std::array<Vertex, 3> corners = mesh.is_border(h)
                                              ? std::array{mesh.source(h), mesh.target(h), new_vertex()}
                                              : std::array{new_vertex(), new_vertex(), new_vertex()};
    if (larger.add_face(corners[0], corners[1], corners[2]) != Mesh::null_face() &&
        is_embedded(soup_of(larger)))
      mesh = larger;
  }
}

struct Counts
{
  std::size_t accepted = 0, refused = 0, differ = 0;
  std::array<std::size_t, 7> stages{}; // how much each of them decided
};

/// Asks for all directed edges and does one of the accepted collapses, again and again: until no more is
/// accepted, or an answer is wrong.
void compare(Mesh mesh, Random& random, Counts& counts)
{
  const Intersection_filter<Mesh> filter(mesh);
  auto visitor = filter.visitor();
  visitor.OnStarted(mesh);
  const auto points = mesh.points();
  const Kernel kernel;
  const std::size_t differ = counts.differ;
  for (bool goes_on = true; goes_on;) {
    const Reference reference(mesh);
    std::vector<std::pair<Halfedge, Point_3>> accepted;
    for (const Halfedge h : mesh.halfedges()) {
      const Profile profile(h, mesh, points, kernel);
      std::vector<Point_3> places{profile.p1()};
      if (below(random, 4) == 0)
        places.push_back(CGAL::midpoint(profile.p0(), profile.p1()));
      if (below(random, 8) == 0)
        places.push_back(mesh.point(*(mesh.vertices_begin() + below(random, mesh.number_of_vertices()))));
      for (const Point_3& place : places) {
        const bool is_clear = bool(filter(profile, internal::Optional<Point_3>(place)));
        counts.differ += is_clear != reference.is_clear(profile.v0(), profile.v1(), place);
        ++(is_clear ? counts.accepted : counts.refused);
        if (is_clear)
          accepted.emplace_back(h, place);
      }
    }
    goes_on = !accepted.empty() && counts.differ == differ;
    if (goes_on) {
      const auto [h, place] = accepted[below(random, accepted.size())];
      const Profile profile(h, mesh, points, kernel);
      visitor.OnCollapsing(profile, internal::Optional<Point_3>(place));
      const Vertex kept = CGAL::Euler::collapse_edge(mesh.edge(h), mesh);
      mesh.point(kept) = place;
      visitor.OnCollapsed(profile, kept);
    }
  }
  const auto& s = filter.statistics();
  const std::array<std::size_t, 7> stages{
      s.stars_clear_by_view, s.faces_clear_in_packs, s.faces_clear_by_view, s.pairs_clear_by_view,
      s.refused_by_link,     s.refused_by_star,      s.refused_by_sweep};
  std::transform(stages.begin(), stages.end(), counts.stages.begin(), counts.stages.begin(), std::plus<>());
}

/// `make` a scene many times.
void compare(const std::function<Mesh(Random&)>& make, int scenes)
{
  Counts counts;
  for (int seed = 1; seed <= scenes; ++seed) {
    Random random(seed);
    const Mesh mesh = make(random);
    if (mesh.number_of_faces() == 0 || !is_embedded(soup_of(mesh)))
      continue;
    const std::size_t differ = counts.differ;
    compare(mesh, random, counts);
    EXPECT_EQ(counts.differ, differ) << "seed " << seed;
  }
  EXPECT_GT(counts.accepted, 1000u);
  EXPECT_GT(counts.refused, 1000u);
  for (std::size_t i = 0; i < counts.stages.size(); ++i)
    EXPECT_GT(counts.stages[i], 0u) << "stage " << i << " decided nothing";
}

Draw in_grid(Random& random, int size, double height)
{
  return [&random, size, height] {
    const int x = below(random, size), y = below(random, size);
    return Point_3(x, y, height * below(random, 4));
  };
}

/// Nearly, and not far above each other.
Draw on_circle(Random& random, double radius)
{
  return [&random, radius] {
    const double angle = 0.001 * below(random, 6283);
    const double x = std::round(radius * std::cos(angle)), y = std::round(radius * std::sin(angle));
    return Point_3(x, y, below(random, 4));
  };
}

TEST(Guard, IsRightAboutStars)
{
  compare(
      [](Random& random) {
        const Draw draw = in_grid(random, 5, std::ldexp(1, -below(random, 50)));
        Mesh mesh = star(draw(), draw, 10, below(random, 4) != 0);
        if (mesh.number_of_faces() > 0)
          add_faces(mesh, draw, random);
        return mesh;
      },
      2000);
}

TEST(Guard, IsRightAboutStarsOfMoreEdgesThanAShadowHas)
{
  compare(
      [](Random& random) {
        const Draw draw = on_circle(random, 1000);
        Mesh mesh = star({0, 0, 2}, draw, 55 + below(random, 20), true);
        if (mesh.number_of_faces() > 0)
          add_faces(mesh, on_circle(random, 900), random);
        return mesh;
      },
      4);
}

// A flat disk of 70 faces with one corner of its rim pulled up, and above its middle a small face that only
// what moves with that corner would meet. A mask holds 64 points: for some of the corners it has no bit.
TEST(Guard, IsRightAboutStarsOfMorePointsThanAMaskHas)
{
  constexpr int size = 70;
  for (int high = 0; high < size; ++high) {
    Mesh mesh;
    const Vertex centre = mesh.add_vertex({0, 0, 0});
    std::vector<Vertex> ring;
    for (int i = 0; i < size; ++i) {
      const double angle = 2 * 3.14159 * i / size;
      ring.push_back(
          mesh.add_vertex({100 * std::cos(angle), 100 * std::sin(angle), i == high ? 100.0 : 0.0}));
    }
    for (int i = 0; i < size; ++i)
      mesh.add_face(centre, ring[i], ring[(i + 1) % size]);
    const Vertex target = ring[(high + size / 4) % size];
    const auto is_clear = [&] {
      const Intersection_filter<Mesh> filter(mesh);
      filter.visitor().OnStarted(mesh);
      const Profile profile(mesh.halfedge(centre, target), mesh, mesh.points(), Kernel());
      const bool result = bool(filter(profile, internal::Optional<Point_3>(profile.p1())));
      EXPECT_EQ(result, Reference(mesh).is_clear(profile.v0(), profile.v1(), profile.p1()));
      return result;
    };
    EXPECT_TRUE(is_clear());
    // Half way between the corner, where the disk comes to lie, and the target.
    const Point_3 middle = CGAL::midpoint(mesh.point(ring[high]), mesh.point(target));
    const auto near_middle = [&](double x, double y) {
      return mesh.add_vertex({0.9 * middle.x() + x, 0.9 * middle.y() + y, 0.8 * middle.z()});
    };
    const Vertex a = near_middle(0, 0), b = near_middle(1, 0), c = near_middle(0, 1);
    mesh.add_face(a, b, c);
    ASSERT_TRUE(is_embedded(soup_of(mesh)));
    EXPECT_FALSE(is_clear()) << "the corner is number " << high;
  }
}

TEST(Guard, IsRightAboutStarsThatWindTwice)
{
  compare(
      [](Random& random) {
        Mesh mesh = double_fan(random);
        add_faces(mesh, in_grid(random, 5, 1), random);
        return mesh;
      },
      200);
}

TEST(Guard, IsRightAboutLayers)
{
  compare(
      [](Random& random) {
        Mesh mesh = layers(random);
        add_faces(mesh, in_grid(random, 4, 2), random);
        return mesh;
      },
      20);
}

TEST(Guard, IsRightAtTheEndsOfTheRangeAndFarFromTheOrigin)
{
  compare(
      [](Random& random) {
        const Draw draw = in_grid(random, 5, 1);
        Mesh mesh = star(draw(), draw, 10, true);
        if (mesh.number_of_faces() > 0)
          add_faces(mesh, draw, random);
        const double scale = std::ldexp(1, 100 * (below(random, 19) - 9)), origin = scale * std::ldexp(1, 40);
        for (const Vertex v : mesh.vertices())
          mesh.point(v) = {scale * mesh.point(v).x() + origin, scale * mesh.point(v).y(),
                           scale * mesh.point(v).z() - origin};
        return mesh;
      },
      300);
}

// The index holds boxes in single precision, the largest of which is below 2^128.
TEST(Guard, IsRightWhereFloatsEnd)
{
  compare(
      [](Random& random) {
        Mesh mesh = layers(random);
        add_faces(mesh, in_grid(random, 4, 2), random);
        const bool is_small = below(random, 4) == 0; // at other sizes, nothing is decided in packs
        const double scale = is_small ? 1 : std::ldexp(1, 122 + int(below(random, 8)));
        for (const Vertex v : mesh.vertices())
          mesh.point(v) = CGAL::ORIGIN + scale * (mesh.point(v) - CGAL::ORIGIN);
        return mesh;
      },
      100);
}

} // namespace
} // namespace selvedge::test
