// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Tracked_points: what it skips changes no distance, and what it compares between vertices.

#include "support/mesh_of.h"
#include "support/soups.h"

#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>
#include <selvedge/Surface_mesh_simplification/internal/Tracked_points.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <set>
#include <type_traits>
#include <vector>

namespace selvedge::test {
namespace {

using Face = Mesh::Face_index;

// Asks every triangle that the collapse of an edge to a place changes about every vertex that the star of the
// edge carries, in a mesh in which nothing was collapsed.
double error_by_brute_force(const Mesh& mesh, Mesh::Halfedge_index h, const Point_3& place)
{
  std::set<Face> star, removed;
  for (const Mesh::Halfedge_index end : {h, mesh.opposite(h)})
    for (const Mesh::Halfedge_index g : mesh.halfedges_around_target(end))
      if (!mesh.is_border(g))
        star.insert(mesh.face(g));
  for (const Mesh::Halfedge_index g : {h, mesh.opposite(h)})
    if (!mesh.is_border(g))
      removed.insert(mesh.face(g));
  double largest = 0;
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    Face carrier = Mesh::null_face();
    for (const Face f : mesh.faces_around_target(mesh.halfedge(v)))
      if (f != Mesh::null_face())
        carrier = (std::min)(carrier, f); // the null face is the largest
    if (star.count(carrier) == 0)
      continue;
    double least = std::numeric_limits<double>::infinity();
    for (const Face f : star) {
      if (removed.count(f) > 0)
        continue;
      std::vector<Point_3> corners;
      for (const Mesh::Vertex_index w : mesh.vertices_around_face(mesh.halfedge(f)))
        corners.push_back(w == mesh.source(h) || w == mesh.target(h) ? place : mesh.point(w));
      const auto point = [](const Point_3& p) {
        return CGAL::Simple_cartesian<double>::Point_3(p.x(), p.y(), p.z());
      };
      least = std::min(least,
                       CGAL::squared_distance(point(mesh.point(v)),
                                              CGAL::Simple_cartesian<double>::Triangle_3(
                                                  point(corners[0]), point(corners[1]), point(corners[2]))));
    }
    largest = std::max(largest, least);
  }
  return std::sqrt(largest);
}

TEST(Tracked_points, ErrorIsThatOfTheNearestTriangles)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-0.3, 0.3);
  for (const double width : {1., 1e-3, 1e-7}) { // the last two have needles
    Mesh mesh = mesh_of(mapped(sheet(9, 9), [&](const Point_3& p) {
      return Point_3(p.x() + number(random), width * (p.y() + number(random)), width * number(random));
    }));
    internal::Tracked_points<Mesh> tracked(mesh);
    const auto points = get(CGAL::vertex_point, mesh);
    tracked.begin(points, 1);
    std::size_t asked = 0;
    for (const Mesh::Edge_index e : mesh.edges()) {
      const Mesh::Halfedge_index h = mesh.halfedge(e);
      const Kernel traits;
      const internal::Lazy_edge_profile<Mesh, std::decay_t<decltype(points)>, Kernel> profile(h, mesh, points,
                                                                                              traits);
      const Point_3 middle = CGAL::midpoint(profile.p0(), profile.p1());
      const Point_3 place(middle.x() + 0.1 * number(random), middle.y(),
                          middle.z() + 0.1 * width * number(random));
      const double expected = error_by_brute_force(mesh, h, place);
      EXPECT_NEAR(tracked.error_at(profile, place), expected, 1e-6 * expected + 1e-8) << e;
      asked += expected > 0;
    }
    EXPECT_GT(asked, 200u);
  }
}

// Grids by their own formula: the points with barycentric coordinates in n-ths, n parts of the longest side.
std::vector<Point_3> grid_of(const std::array<Point_3, 3>& corners, double max_error)
{
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max(longest, std::sqrt(CGAL::squared_distance(corners[i], corners[(i + 1) % 3])));
  const int parts = int(std::min(8., std::max(1., std::ceil(longest / max_error))));
  std::vector<Point_3> points;
  for (int a = 0; a <= parts; ++a)
    for (int b = 0; a + b <= parts; ++b)
      if (const int c = parts - a - b; a < parts && b < parts && c < parts)
        points.push_back(CGAL::barycenter(corners[0], double(a) / parts, corners[1], double(b) / parts,
                                          corners[2], double(c) / parts));
  return points;
}

// A cone of many faces, whose apex is vertex 0.
Mesh cone(int sides, double height)
{
  Mesh mesh;
  const auto apex = mesh.add_vertex(Point_3(0, 0, height));
  for (int i = 0; i < sides; ++i)
    mesh.add_vertex(
        Point_3(std::cos(6.28318530717958648 * i / sides), std::sin(6.28318530717958648 * i / sides), 0));
  for (int i = 0; i < sides; ++i)
    mesh.add_face(apex, Mesh::Vertex_index(1 + i), Mesh::Vertex_index(1 + (i + 1) % sides));
  return mesh;
}

double squared_distance(const Point_3& p, const std::array<Point_3, 3>& t)
{
  return CGAL::squared_distance(p, Kernel::Triangle_3(t[0], t[1], t[2]));
}

using Tracked = internal::Tracked_points<Mesh>;
using Profile = internal::Lazy_edge_profile<Mesh, Mesh::Property_map<Mesh::Vertex_index, Point_3>, Kernel>;
using Triangles = std::vector<std::array<Point_3, 3>>;

std::array<Point_3, 3> corners_after(const Mesh& mesh, Face f, const std::vector<Mesh::Vertex_index>& movers,
                                     const Point_3& place)
{
  std::array<Point_3, 3> corners;
  auto next = corners.begin();
  for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
    *next++ = std::find(movers.begin(), movers.end(), v) != movers.end() ? place : mesh.point(v);
  return corners;
}

// The largest distance from the grids of the faces that a collapse changes, and from its place, to the
// nearest of all triangles.
double farthest_from(const Triangles& original, const Mesh& mesh, Mesh::Halfedge_index h,
                     const Point_3& place, double max_error)
{
  std::vector<Mesh::Vertex_index> movers;
  for (const Mesh::Vertex_index v : {mesh.source(h), mesh.target(h)})
    if (mesh.point(v) != place)
      movers.push_back(v);
  double farthest = 0;
  for (const Mesh::Vertex_index v : movers)
    for (const Face f : mesh.faces_around_target(mesh.halfedge(v))) {
      if (f == Mesh::null_face() || f == mesh.face(h) || f == mesh.face(mesh.opposite(h)))
        continue;
      std::vector<Point_3> asked = grid_of(corners_after(mesh, f, movers, place), max_error);
      if (movers.size() == 2)
        asked.push_back(place);
      for (const Point_3& p : asked) {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& triangle : original)
          least = std::min(least, squared_distance(p, triangle));
        farthest = std::max(farthest, std::sqrt(least));
      }
    }
  return farthest;
}

class Tracked_sheet : public testing::Test
{
protected:
  Tracked_sheet()
  {
    std::uniform_real_distribution<double> number(-0.3, 0.3);
    m_mesh = mesh_of(mapped(sheet(9, 9), [&](const Point_3& p) {
      return Point_3(p.x() + number(m_random), p.y() + number(m_random), 2 * number(m_random));
    }));
    m_original = originals_of(m_mesh);
  }

  // Compares what is said of a collapse with what all grids say. Counts whether it leads too far.
  void ask(Mesh& mesh, const Tracked& tracked, Mesh::Halfedge_index h, const Point_3& place, double max_error)
  {
    const Profile profile = profile_of(mesh, h);
    const double error = tracked.error_at(profile, place);
    if (error > max_error && std::isfinite(error))
      return; // refused because of the original's points, before the grids of the changed faces are asked
    const double farthest = farthest_from(m_original, mesh, h, place, max_error);
    ASSERT_GT(std::fabs(farthest - max_error), 1e-9) << "the test cannot tell";
    EXPECT_EQ(std::isfinite(error), farthest <= max_error) << h;
    ++(farthest <= max_error ? m_near : m_too_far);
  }

  static Triangles originals_of(const Mesh& mesh)
  {
    Triangles triangles;
    for (const Face f : mesh.faces())
      triangles.push_back(corners_after(mesh, f, {}, {}));
    return triangles;
  }

  static Profile profile_of(Mesh& mesh, Mesh::Halfedge_index h)
  {
    static const Kernel traits;
    static Mesh::Property_map<Mesh::Vertex_index, Point_3> points;
    points = mesh.points();
    return Profile(h, mesh, points, traits);
  }

  std::mt19937 m_random{12};
  Mesh m_mesh;
  Triangles m_original;
  std::size_t m_near = 0, m_too_far = 0;
};

TEST_F(Tracked_sheet, ChangedFacesKeepToTheOriginalBetweenTheirCorners)
{
  std::size_t too_far_between_corners = 0;
  for (const double max_error : {0.1, 0.2, 0.3, 0.5}) {
    Tracked tracked(m_mesh), tracked_vertices(m_mesh);
    tracked.begin(m_mesh.points(), 1, max_error);
    tracked_vertices.begin(m_mesh.points(), 1);
    for (const Mesh::Edge_index e : m_mesh.edges()) {
      const Mesh::Halfedge_index h = m_mesh.halfedge(e);
      const Point_3 start = m_mesh.point(m_mesh.source(h)), end = m_mesh.point(m_mesh.target(h));
      for (const Point_3& place : {CGAL::midpoint(start, end), start, end}) {
        const double error_of_vertices = tracked_vertices.error_at(profile_of(m_mesh, h), place);
        const double error = tracked.error_at(profile_of(m_mesh, h), place);
        EXPECT_GE(error, std::min(error_of_vertices, max_error));
        EXPECT_TRUE(error > max_error || error_of_vertices <= max_error);
        const std::size_t before = m_too_far;
        ask(m_mesh, tracked, h, place, max_error);
        too_far_between_corners += m_too_far > before && error_of_vertices <= max_error;
      }
    }
  }
  EXPECT_GT(m_near, 300u);
  EXPECT_GT(m_too_far, 30u);
  EXPECT_GT(too_far_between_corners, 30u) << "which vertices alone would not tell";
}

// The points that a collapse hands on, against the faces that can take them, in a mesh as it was.
double farthest_point(const Mesh& mesh, Mesh::Halfedge_index h, const Point_3& place, double max_error)
{
  std::vector<Point_3> points;
  Triangles faces;
  for (const Face f : mesh.faces_around_target(mesh.opposite(h)))
    if (f != Mesh::null_face()) {
      const auto corners = corners_after(mesh, f, {}, {});
      const std::vector<Point_3> grid = grid_of(corners, max_error);
      points.insert(points.end(), grid.begin(), grid.end());
      points.push_back(mesh.point(mesh.source(h)));
      if (f != mesh.face(h) && f != mesh.face(mesh.opposite(h)))
        faces.push_back(corners_after(mesh, f, {mesh.source(h)}, place));
    }
  double farthest = 0;
  for (const Point_3& p : points) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& face : faces)
      least = std::min(least, squared_distance(p, face));
    farthest = std::max(farthest, least);
  }
  return std::sqrt(farthest);
}

// Points on sides too, of which one of the two triangles beside them has to take care.
TEST_F(Tracked_sheet, EveryPointOfTheGridsAroundAVertexCounts)
{
  std::size_t near = 0, far = 0;
  for (const double max_error : {0.2, 0.3, 0.4, 0.5}) {
    Tracked tracked(m_mesh);
    tracked.begin(m_mesh.points(), 1, max_error);
    for (const Mesh::Halfedge_index h : m_mesh.halfedges()) {
      if (m_mesh.is_border(m_mesh.source(h)))
        continue;
      const Point_3 place = m_mesh.point(m_mesh.target(h));
      const double farthest = farthest_point(m_mesh, h, place, max_error);
      ASSERT_GT(std::fabs(farthest - max_error), 1e-9) << "the test cannot tell";
      const bool is_near =
          farthest <= max_error && farthest_from(m_original, m_mesh, h, place, max_error) <= max_error;
      EXPECT_EQ(tracked.error_at(profile_of(m_mesh, h), place) <= max_error, is_near) << h;
      ++(is_near ? near : far);
    }
  }
  EXPECT_GT(near, 100u);
  EXPECT_GT(far, 100u);
}

TEST_F(Tracked_sheet, AtAVertexOfManyFacesTheAnswerIsTheSame)
{
  std::size_t near = 0, far = 0;
  for (const double height : {0.05, 0.5}) {
    Mesh mesh = cone(40, height);
    for (const double max_error : {0.03, 0.11, 0.3, 0.6}) {
      Tracked tracked(mesh);
      tracked.begin(mesh.points(), 1, max_error);
      for (const Mesh::Halfedge_index h :
           mesh.halfedges_around_target(mesh.halfedge(Mesh::Vertex_index(0)))) {
        const Mesh::Halfedge_index out = mesh.opposite(h);
        const Point_3 place = mesh.point(mesh.target(out));
        const double farthest = farthest_point(mesh, out, place, max_error);
        ASSERT_GT(std::fabs(farthest - max_error), 1e-9) << "the test cannot tell";
        const bool is_near = farthest <= max_error &&
                             farthest_from(originals_of(mesh), mesh, out, place, max_error) <= max_error;
        EXPECT_EQ(tracked.error_at(profile_of(mesh, out), place) <= max_error, is_near);
        ++(is_near ? near : far);
      }
    }
  }
  EXPECT_GT(near, 50u);
  EXPECT_GT(far, 50u);
}

// Whether it was asked before or not, a collapse hands each point to the same face.
TEST_F(Tracked_sheet, AtAVertexOfManyFacesThePointsGoToTheSame)
{
  constexpr double max_error = 0.1;
  Mesh mesh = cone(60, 0.05);
  Tracked asked(mesh), told(mesh);
  asked.begin(mesh.points(), 1, max_error);
  told.begin(mesh.points(), 1, max_error);
  const Mesh::Halfedge_index out = mesh.opposite(mesh.halfedge(Mesh::Vertex_index(0)));
  const Profile profile = profile_of(mesh, out);
  ASSERT_LE(asked.error_at(profile, mesh.point(mesh.target(out))), max_error);
  const auto collapse = internal::Collapse<Profile>::along(profile, out);
  asked.before_collapse(collapse);
  told.before_collapse(collapse);
  const auto left = CGAL::Euler::collapse_edge(mesh.edge(out), mesh);
  mesh.point(left) = collapse.place();
  std::set<double> errors;
  for (const Mesh::Edge_index e : mesh.edges()) {
    const Mesh::Halfedge_index h = mesh.halfedge(e);
    for (const Mesh::Halfedge_index moving : {h, mesh.opposite(h)}) {
      if (mesh.source(moving) == left) // which has many faces
        continue;
      const double error = asked.error_at(profile_of(mesh, moving), mesh.point(mesh.target(moving)));
      EXPECT_EQ(error, told.error_at(profile_of(mesh, moving), mesh.point(mesh.target(moving))));
      errors.insert(error);
    }
  }
  EXPECT_GT(errors.size(), 50u);
}

// A notch in the border of one sheet lies over two others, which leave a slit between them: to close the
// notch covers a part of the slit that is between all points of grids.
TEST_F(Tracked_sheet, WithoutAnErrorWhatIsCoveredStays)
{
  for (const double depth : {0.3, 0.}) {
    const Triangle_soup sheets = soup({{0, 0, 0},
                                       {0.5, depth, 0},
                                       {1, 0, 0},
                                       {1, 1, 0},
                                       {0, 1, 0},
                                       {-1, -1, 0},
                                       {0.51, -1, 0},
                                       {0.51, 1, 0},
                                       {-1, 1, 0},
                                       {0.515, -1, 0},
                                       {2, -1, 0},
                                       {2, 1, 0},
                                       {0.515, 1, 0}},
                                      {{0, 1, 4},
                                       {1, 3, 4},
                                       {1, 2, 3}, // the one with the notch
                                       {5, 6, 7},
                                       {5, 7, 8},
                                       {9, 10, 11},
                                       {9, 11, 12}});
    Mesh mesh = mesh_of(sheets);
    const Mesh::Halfedge_index out = mesh.halfedge(Mesh::Vertex_index(1), Mesh::Vertex_index(0));
    for (const double max_error : {0., 1e-14, 1e-9}) {
      Tracked tracked(mesh);
      tracked.begin(mesh.points(), 1, max_error);
      EXPECT_EQ(tracked.error_at(profile_of(mesh, out), mesh.point(Mesh::Vertex_index(0))) == 0,
                depth == 0 || max_error > 1e-12);
    }
  }
}

// Rounding does not grow with the distance from the origin.
TEST_F(Tracked_sheet, ErrorsAreTheSameFarFromTheOrigin)
{
  std::uniform_int_distribution<int> shift(-300, 300);
  const Triangle_soup near = mapped(sheet(9, 9), [&](const Point_3& p) {
    const double unit = 1. / 1024; // which the shift does not round
    return Point_3(p.x() + unit * shift(m_random), p.y() + unit * shift(m_random), unit * shift(m_random));
  });
  const Triangle_soup far = mapped(near, [](const Point_3& p) {
    constexpr double away = 1 << 30;
    return Point_3(p.x() + away, p.y() - away, p.z() + away);
  });
  Mesh mesh = mesh_of(near), mesh_far = mesh_of(far);
  Tracked tracked(mesh), tracked_far(mesh_far);
  tracked.begin(mesh.points(), 8);
  tracked_far.begin(mesh_far.points(), 8);
  std::size_t positive = 0;
  for (const Mesh::Halfedge_index h : mesh.halfedges()) {
    const double error = tracked.error_at(profile_of(mesh, h), mesh.point(mesh.target(h)));
    const double error_far =
        tracked_far.error_at(profile_of(mesh_far, h), mesh_far.point(mesh_far.target(h)));
    EXPECT_NEAR(error_far, error, 1e-9 * error);
    positive += error > 0;
  }
  EXPECT_GT(positive, 300u);
}

} // namespace
} // namespace selvedge::test
