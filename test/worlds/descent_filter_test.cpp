// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What the intersection filter says of collapses in meshes that intersect already, against a judge that knows
// nothing but a list of faces: both must give the same answer, while the mesh changes.

#include "Judged_complex.h"
#include "Random.h"
#include "support/meshes.h"
#include "support/soups.h"

#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>
#include <selvedge/Surface_mesh_simplification/internal/Topology_test.h>
#include <selvedge/Surface_mesh_simplification/internal/perform_collapse.h>
#include <selvedge/geometry/internal/piercing_depth.h>
#include <selvedge/spatial/Brute_force_index.h>

#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

using Mesh = CGAL::Surface_mesh<Point_3>;
using Vertex = Mesh::Vertex_index;
using Halfedge = Mesh::Halfedge_index;
using Points = Mesh::Property_map<Vertex, Point_3>;
using Profile = internal::Lazy_edge_profile<Mesh, Points, Kernel>;
using Collapse_of_edge = internal::Collapse<Profile>;
using Faces = std::set<std::pair<Index, Index>>;

/// Sheets of squares that cross each other and themselves, on coordinates so coarse that they also touch.
/// Some have triangles without an area.
Triangle_soup crossing_sheets(Random& random)
{
  Triangle_soup soup;
  const int sheets = random.between(1, 3), size = random.between(3, 5), fold = random.between(0, 2);
  for (int k = 0; k < sheets; ++k) {
    const Index first = Index(soup.points.size());
    for (int j = 0; j <= size; ++j)
      for (int i = 0; i <= size; ++i)
        // No two sheets have a position in common.
        soup.points.push_back({i + 0.125 * k + 0.75 * fold * random.between(-1, 1), double(j),
                               0.5 * random.between(0, 3) + 0.03125 * (i * i + j)});
    const auto vertex = [&](int i, int j) { return first + Index(j * (size + 1) + i); };
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) {
        soup.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
        soup.triangles.push_back({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
  }
  for (int i = random.one_in(2) ? random.between(8, 24) : 0; i > 0; --i) {
    Triangle_soup divided = soup;
    add_needle(divided, random.below(soup.triangles.size()), random.below(3));
    if (std::count(divided.points.begin(), divided.points.end(), divided.points.back()) == 1)
      soup = std::move(divided);
  }
  return soup;
}

Mesh mesh_of_sheets(const Triangle_soup& soup)
{
  Mesh mesh;
  for (const Point_3& p : soup.points)
    mesh.add_vertex(p);
  for (const auto& [a, b, c] : soup.triangles)
    mesh.add_face(Vertex(a), Vertex(b), Vertex(c));
  return mesh;
}

template <class FaceIndex>
class Compared_scene
{
public:
  Compared_scene(const Triangle_soup& soup, double shallow, std::map<std::string, std::size_t>& answers)
      : m_mesh(mesh_of_sheets(soup)), m_filter(m_mesh), m_complex(soup, {}), m_shallow(shallow),
        m_answers(answers)
  {
    const Faces pairs = m_complex.offending_pairs();
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> of_mesh;
    for (const auto& [f, g] : pairs)
      of_mesh.emplace_back(f, g);
    m_filter.exempt(of_mesh, {}, shallow);
    m_complex.exempt(pairs);
    m_filter.visitor().OnStarted(m_mesh);
    for (const Vertex v : m_mesh.vertices())
      m_positions.push_back(v);
  }

  /// Asks both about a collapse, and does it if both agree that it is allowed.
  void compare(Random& random)
  {
    const Halfedge h(Mesh::size_type(random.below(m_mesh.number_of_halfedges())));
    if (m_mesh.is_removed(h))
      return;
    const Points points = m_mesh.points();
    const Kernel kernel;
    const Profile profile(h, m_mesh, points, kernel);
    const bool is_along = random.one_in(2);
    const auto coordinate = [&](int i) {
      return 0.5 * (profile.p0()[i] + profile.p1()[i]) + 0.25 * random.between(-1, 1);
    };
    const Point_3 between(coordinate(0), coordinate(1), coordinate(2));
    const auto collapse =
        is_along || between == profile.p0() || between == profile.p1() || is_position(between)
            ? Collapse_of_edge::along(profile, h)
            : Collapse_of_edge(profile, between);
    // The judge has rules for borders, the filter has none.
    if (m_mesh.is_border(collapse.mover()) ||
        (collapse.are_both_moved() && m_mesh.is_border(collapse.goal())))
      return;
    const bool is_allowed = m_filter.accepts(collapse);
    Judged_complex after = m_complex;
    std::optional<Broken_promise> broken = judged(collapse, after, false);
    if (broken && collapse.are_both_moved()) {
      after = m_complex;
      broken = judged(collapse, after, true);
    }
    const bool is_made_deep = !broken && m_shallow < std::numeric_limits<double>::infinity() &&
                              is_deep(after, movers(collapse)) && !is_deep(m_complex, movers(collapse));
    ASSERT_EQ(is_allowed, !broken && !is_made_deep) << (broken ? broken->message : "");
    ++m_answers[is_made_deep                                                            ? "made deep"
                : !broken                                                               ? "allowed"
                : broken->message == "more pairs offend than before"                    ? "more pairs"
                : broken->message.find("has no area, and changes") != std::string::npos ? "needle"
                                                                                        : "refused"];
    if (!broken && m_complex.needles() > after.needles())
      ++m_answers["needle contracted"];
    internal::Topology_test<Mesh> topology;
    if (broken || is_made_deep || !topology.is_kept(profile, internal::No_constrained_edges()))
      return;
    m_complex = after;
    const Index position = m_positions[collapse.goal()];
    auto visitor = m_filter.visitor();
    m_positions[internal::perform_collapse(m_mesh, points, internal::No_constrained_edges(), collapse,
                                           visitor, 0)] = position;
  }

private:
  bool is_position(const Point_3& point) const
  {
    for (const Vertex v : m_mesh.vertices())
      if (m_mesh.point(v) == point)
        return true;
    return false;
  }

  static std::vector<Vertex> movers(const Collapse_of_edge& collapse)
  {
    return collapse.are_both_moved() ? std::vector<Vertex>{collapse.mover(), collapse.goal()}
                                     : std::vector<Vertex>{collapse.mover()};
  }

  // Whether two faces pierce each other deeper than what is shallow, one of them now at one of the vertices.
  bool is_deep(const Judged_complex& complex, const std::vector<Vertex>& at) const
  {
    const Faces pairs = complex.offending_pairs();
    const auto has_corner_there = [&](Index face) {
      const Index_triple corners = m_complex.positions_of(face);
      return std::any_of(at.begin(), at.end(), [&](Vertex v) {
        return std::count(corners.begin(), corners.end(), m_positions[v]) > 0;
      });
    };
    const auto triangle = [&](Index face) {
      const auto [a, b, c] = complex.positions_of(face);
      return std::array<Point_3, 3>{complex.point(a), complex.point(b), complex.point(c)};
    };
    return std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
      const auto [f, g] = pair;
      return f != g && complex.is_alive(f) && complex.is_alive(g) &&
             (has_corner_there(f) || has_corner_there(g)) &&
             internal::piercing_depth(triangle(f), triangle(g)) > m_shallow;
    });
  }

  std::optional<Broken_promise> judged(const Collapse_of_edge& collapse, Judged_complex& complex,
                                       bool is_mover_first) const
  {
    const Index removed = m_positions[collapse.mover()], kept = m_positions[collapse.goal()];
    return collapse.are_both_moved() ? complex.collapse(removed, kept, collapse.place(), is_mover_first)
                                     : complex.collapse(removed, kept);
  }

  Mesh m_mesh;
  Intersection_filter<Mesh, No_filter, FaceIndex> m_filter;
  Judged_complex m_complex;
  double m_shallow;
  std::vector<Index> m_positions; // by vertex of the mesh
  std::map<std::string, std::size_t>& m_answers;
};

template <class FaceIndex>
std::map<std::string, std::size_t> compare_scenes(std::uint64_t seed, std::uint64_t scenes = 20,
                                                  double shallow = std::numeric_limits<double>::infinity())
{
  std::map<std::string, std::size_t> answers;
  for (std::uint64_t scene = 0; scene < scenes; ++scene) {
    SCOPED_TRACE("scene " + std::to_string(seed + scene));
    Random random(seed + scene);
    Compared_scene<FaceIndex> compared(crossing_sheets(random), shallow, answers);
    for (int i = 0; i < 400; ++i) {
      compared.compare(random);
      if (testing::Test::HasFatalFailure())
        return answers;
    }
  }
  return answers;
}

void expect_all_answers(const std::map<std::string, std::size_t>& answers)
{
  for (const char* const answer : {"more pairs", "refused", "allowed", "needle", "needle contracted"})
    EXPECT_GT(answers.count(answer) > 0 ? answers.at(answer) : 0, 20u) << answer;
}

TEST(Descent, OfTheFilterIsThatOfTheJudge)
{
  expect_all_answers(compare_scenes<Packed_R_tree>(1000));
}

TEST(Descent, OfTheFilterIsThatOfTheJudgeWithAnyIndex)
{
  expect_all_answers(compare_scenes<Brute_force_index>(2000));
}

TEST(Descent, OfTheFilterKeepsShallowPairsShallow)
{
  for (const double shallow : {0.3371, 0.5313}) // no depths on these coordinates
    EXPECT_GT(compare_scenes<Packed_R_tree>(3000, 6, shallow)["made deep"], 5u) << shallow;
}

} // namespace
} // namespace selvedge::test
