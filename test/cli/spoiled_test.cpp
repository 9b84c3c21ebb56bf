// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"

#include "soup/selection.h"
#include <selvedge/generate.h>
#include <selvedge/mesh_files.h>
#include <selvedge/rounding.h>

#include <nlohmann/json.hpp>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <utility>

// Every way to spoil a result that we could think of, with what `verify --against` has to say: what it
// refuses, or the line of "what this cannot see" that covers it. docs/report.md has the same table.
namespace selvedge::test {
namespace {

/// The reduced skirt: what is to be spoiled.
struct Result
{
  Triangle_soup soup;

  std::string name(Index triangle) const { return soup.groups.names[soup.groups.of_triangle[triangle]]; }

  /// The triangles of the groups whose names begin so.
  std::vector<Index> triangles(const std::string& prefix) const
  {
    std::vector<Index> found;
    for (Index t = 0; t < soup.triangles.size(); ++t)
      if (name(t).rfind(prefix, 0) == 0)
        found.push_back(t);
    EXPECT_FALSE(found.empty()) << prefix;
    return found;
  }

  std::set<Index> vertices(const std::vector<Index>& some) const
  {
    std::set<Index> found;
    for (const Index t : some)
      found.insert(soup.triangles[t].begin(), soup.triangles[t].end());
    return found;
  }

  void remove(const std::vector<Index>& some)
  {
    std::vector<Index> kept;
    for (Index t = 0; t < soup.triangles.size(); ++t)
      if (!std::binary_search(some.begin(), some.end(), t))
        kept.push_back(t);
    keep_triangles(soup, kept);
  }

  /// A triangle with the attributes of another.
  void add(const Index_triple& corners, Index like)
  {
    soup.triangles.push_back(corners);
    soup.uvs.of_triangle.push_back(soup.uvs.of_triangle[like]);
    soup.groups.of_triangle.push_back(soup.groups.of_triangle[like]);
    soup.materials.of_triangle.push_back(soup.materials.of_triangle[like]);
  }

  Index new_vertex(const Point_3& point)
  {
    soup.points.push_back(point);
    return Index(soup.points.size() - 1);
  }

  /// Gives triangles vertices of their own.
  std::vector<Index> copy(const std::vector<Index>& some)
  {
    std::map<Index, Index> copies;
    for (const Index vertex : vertices(some))
      copies[vertex] = new_vertex(soup.points[vertex]);
    const Index first = Index(soup.triangles.size());
    for (const Index t : some) {
      Index_triple corners = soup.triangles[t];
      for (Index& vertex : corners)
        vertex = copies[vertex];
      add(corners, t);
    }
    std::vector<Index> added(some.size());
    std::iota(added.begin(), added.end(), first);
    return added;
  }

  template <class Function>
  void move(const std::vector<Index>& some, const Function& function)
  {
    for (const Index vertex : vertices(some))
      soup.points[vertex] = function(soup.points[vertex]);
  }

  Point_3 middle(const std::vector<Index>& some) const
  {
    CGAL::Bbox_3 box;
    for (const Index vertex : vertices(some))
      box += soup.points[vertex].bbox();
    return Point_3((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2,
                   (box.zmin() + box.zmax()) / 2);
  }

  /// Moves the highest vertex of a piece up, by a share of the size of the garment, which is one metre.
  void raise_top(const std::string& piece, double by)
  {
    const std::set<Index> found = vertices(triangles(piece));
    Point_3& top = soup.points[*std::max_element(found.begin(), found.end(), [&](Index a, Index b) {
      return soup.points[a].y() < soup.points[b].y();
    })];
    top = Point_3(top.x(), top.y() + by, top.z());
  }

  /// The triangles at every edge.
  std::map<std::pair<Index, Index>, std::vector<Index>> edges(const std::vector<Index>& some) const
  {
    std::map<std::pair<Index, Index>, std::vector<Index>> found;
    for (const Index t : some)
      for (int i = 0; i < 3; ++i)
        found[std::minmax(soup.triangles[t][i], soup.triangles[t][(i + 1) % 3])].push_back(t);
    return found;
  }

  std::set<Index> border(const std::vector<Index>& some) const
  {
    std::set<Index> found;
    for (const auto& [edge, sides] : edges(some))
      if (sides.size() == 1)
        found.insert({edge.first, edge.second});
    return found;
  }

  /// A vertex of a piece that is not on its border.
  Index inner_vertex(const std::vector<Index>& some) const
  {
    const std::set<Index> on_border = border(some);
    for (const Index vertex : vertices(some))
      if (on_border.count(vertex) == 0)
        return vertex;
    ADD_FAILURE() << "all vertices are on the border";
    return 0;
  }

  std::vector<Index> all() const
  {
    std::vector<Index> numbers(soup.triangles.size());
    std::iota(numbers.begin(), numbers.end(), Index(0));
    return numbers;
  }

  Index group(const std::string& wanted) const
  {
    const auto& names = soup.groups.names;
    const auto found = std::find(names.begin(), names.end(), wanted);
    EXPECT_NE(found, names.end()) << wanted;
    return Index(found - names.begin());
  }

  void swap_names(const std::string& first, const std::string& second)
  {
    std::swap(soup.groups.names[group(first)], soup.groups.names[group(second)]);
  }
};

Point_3 moved(const Point_3& p, double x, double y, double z)
{
  return Point_3(p.x() + x, p.y() + y, p.z() + z);
}

/// From the axis of the garment, which is y.
Point_3 widened(const Point_3& p, double factor)
{
  return Point_3(factor * p.x(), p.y(), factor * p.z());
}

struct Spoiled
{
  const char* name;
  /// A kind of mismatch, "pairs" or "layers"; or, where it passes, a part of the line that says so.
  const char* told;
  bool is_seen;
  std::function<void(Result&)> spoil;
};

void PrintTo(const Spoiled& spoiled, std::ostream* stream)
{
  *stream << spoiled.name;
}

const char* const parts = "what a piece has lost or gained at its borders";
const char* const turned = "faces that turned over, unless they make up nine tenths";
const char* const joins = "cuts and joins between vertices at one position";
const char* const values = "values of attributes, such as texture coordinates, that are missing";
const char* const rounding = "what rounding did to the original";

const std::vector<Spoiled> ways = {
    {"Nothing", "what happened on the way", false, [](Result&) {}},

    // ---- Pieces
    {"APieceIsGone", "missing", true, [](Result& r) { r.remove(r.triangles("pocket_left")); }},
    {"ALayerIsGone", "missing", true, [](Result& r) { r.remove(r.triangles("lining")); }},
    {"OnlyTheBodyIsLeft", "missing", true,
     [](Result& r) {
       std::vector<Index> gone = r.all();
       for (const Index t : r.triangles("body"))
         gone.erase(std::find(gone.begin(), gone.end(), t));
       r.remove(gone);
     }},
    {"APieceIsATriangleFarAway", "missing", true,
     [](Result& r) {
       const Index first = r.new_vertex({9, 9, 9});
       r.new_vertex({9, 9, 10});
       r.new_vertex({9, 10, 9});
       const std::vector<Index> gone = r.triangles("pocket_left");
       r.add({first, first + 1, first + 2}, gone.front());
       r.remove(gone);
     }},
    {"APieceIsOneOfItsTriangles", "far", true,
     [](Result& r) {
       std::vector<Index> gone = r.triangles("lining_front");
       gone.erase(gone.begin());
       r.remove(gone);
     }},
    {"APieceIsACopyOfAnother", "missing", true,
     [](Result& r) {
       const std::vector<Index> added = r.copy(r.triangles("pocket_right"));
       r.move(added, [](const Point_3& p) { return widened(p, 1.0001); });
       r.remove(r.triangles("pocket_left"));
     }},
    {"APieceIsThereTwice", "pairs", true, [](Result& r) { r.copy(r.triangles("shell_front")); }},
    {"APieceIsThereTwiceSideBySide", "added", true,
     [](Result& r) {
       r.move(r.copy(r.triangles("pocket_left")), [](const Point_3& p) { return widened(p, 1.001); });
     }},
    {"APieceHasMovedByItsSize", "missing", true,
     [](Result& r) {
       r.move(r.triangles("pocket_left"), [](const Point_3& p) { return moved(p, 0, 0, 1); });
     }},
    {"TwoPiecesHaveExchangedPlaces", "name", true,
     [](Result& r) {
       const std::vector<Index> left = r.triangles("pocket_left"), right = r.triangles("pocket_right");
       const Point_3 a = r.middle(left), b = r.middle(right);
       r.move(left, [&](const Point_3& p) { return p + (b - a); });
       r.move(right, [&](const Point_3& p) { return p + (a - b); });
     }},
    {"APieceHasShrunkToAPoint", "missing", true,
     [](Result& r) {
       const std::vector<Index> piece = r.triangles("pocket_left");
       const Point_3 middle = r.middle(piece);
       r.move(piece, [&](const Point_3& p) { return middle + 1e-6 * (p - middle); });
     }},
    {"APieceHasShrunkToHalf", parts, false,
     [](Result& r) {
       const std::vector<Index> piece = r.triangles("pocket_left");
       const Point_3 middle = r.middle(piece);
       r.move(piece, [&](const Point_3& p) { return middle + 0.5 * (p - middle); });
     }},
    {"APieceHasGrownThreefold", "missing", true,
     [](Result& r) {
       const std::vector<Index> piece = r.triangles("button");
       const Point_3 middle = r.middle(piece);
       r.move(piece, [&](const Point_3& p) { return middle + 3 * (p - middle); });
     }},
    {"APieceIsTurnedInsideOut", "turned", true,
     [](Result& r) {
       for (const Index t : r.triangles("shell_front"))
         std::swap(r.soup.triangles[t][0], r.soup.triangles[t][1]);
     }},
    {"APieceIsTurnedUpsideDown", "pairs", true,
     [](Result& r) {
       const std::vector<Index> piece = r.triangles("shell_front");
       const Point_3 middle = r.middle(piece);
       r.move(piece, [&](const Point_3& p) { return Point_3(p.x(), 2 * middle.y() - p.y(), p.z()); });
     }},
    {"APieceHasItsPositionsShuffled", "pairs", true,
     [](Result& r) {
       const std::set<Index> piece = r.vertices(r.triangles("shell_front"));
       std::vector<Index> vertices(piece.begin(), piece.end());
       std::shuffle(vertices.begin(), vertices.end(), std::mt19937(1));
       for (std::size_t i = 1; i < vertices.size(); ++i)
         std::swap(r.soup.points[vertices[i]], r.soup.points[vertices[i - 1]]);
     }},

    // ---- The whole
    {"AllIsMirrored", "turned", true,
     [](Result& r) { r.move(r.all(), [](const Point_3& p) { return Point_3(-p.x(), p.y(), p.z()); }); }},
    {"AllIsTwiceAsLarge", "missing", true,
     [](Result& r) {
       r.move(r.all(), [](const Point_3& p) { return Point_3(2 * p.x(), 2 * p.y(), 2 * p.z()); });
     }},
    {"AllIsAHundredthLarger", "name", true,
     [](Result& r) {
       r.move(r.all(), [](const Point_3& p) { return Point_3(1.01 * p.x(), 1.01 * p.y(), 1.01 * p.z()); });
     }},
    {"AllIsSomewhereElse", "missing", true,
     [](Result& r) { r.move(r.all(), [](const Point_3& p) { return moved(p, 3, 0, 0); }); }},
    {"AllHasMovedByTwoMillimetres", "missing", true,
     [](Result& r) { r.move(r.all(), [](const Point_3& p) { return moved(p, 0.002, 0, 0); }); }},
    // No farther than the reduction itself moves the surface.
    {"AllHasMovedByAMillimetre", parts, false,
     [](Result& r) { r.move(r.all(), [](const Point_3& p) { return moved(p, 0.001, 0, 0); }); }},
    {"AllIsRoundedToCentimetres", "pairs", true,
     [](Result& r) {
       const auto rounded = [](double x) { return std::round(100 * x) / 100; };
       r.move(r.all(),
              [&](const Point_3& p) { return Point_3(rounded(p.x()), rounded(p.y()), rounded(p.z())); });
     }},
    {"AllIsRoundedToFloats", rounding, false, [](Result& r) { round_to_float32(r.soup); }},

    // ---- Layers
    {"ALayerHasGoneThroughTheNext", "pairs", true,
     [](Result& r) {
       r.move(r.triangles("lining_front"), [](const Point_3& p) { return widened(p, 1.03); });
     }},
    {"TwoLayersHaveExchangedPlaces", "name", true,
     [](Result& r) {
       for (const char* const piece : {"front", "back", "yoke_left", "yoke_right"})
         r.swap_names(std::string("lining_") + piece, std::string("shell_") + piece);
     }},
    {"ALayerTouchesTheNext", "pairs", true,
     [](Result& r) {
       const Index lining = r.inner_vertex(r.triangles("lining_front"));
       const Index_triple& next = r.soup.triangles[r.triangles("interlining_1_front").front()];
       Point_3 &a = r.soup.points[next[0]], &b = r.soup.points[next[1]];
       for (Point_3* const end : {&a, &b})
         *end = {nearest_float32(end->x()), nearest_float32(end->y()), nearest_float32(end->z())};
       r.soup.points[lining] = CGAL::midpoint(a, b); // on the edge, exactly: it has enough digits
     }},

    // ---- Vertices
    {"AVertexHasMovedUpByATenth", parts, false, [](Result& r) { r.raise_top("body", 0.1); }},
    {"AVertexHasMovedUpByHalf", parts, false, [](Result& r) { r.raise_top("body", 0.5); }},
    {"AVertexHasMovedInByATenth", "pairs", true,
     [](Result& r) {
       Point_3& point = r.soup.points[r.inner_vertex(r.triangles("shell_front"))];
       point = widened(point, 0.7);
     }},
    {"TwoVerticesAreOne", "topology", true,
     [](Result& r) {
       const std::vector<Index> piece = r.triangles("shell_front");
       const std::set<Index> border = r.border(piece);
       std::replace(r.soup.triangles[piece.back()].begin(), r.soup.triangles[piece.back()].end(),
                    r.soup.triangles[piece.back()][0], *border.begin());
     }},

    // ---- Faces
    {"AnInnerFaceIsGone", "topology", true,
     [](Result& r) {
       const std::vector<Index> piece = r.triangles("body");
       r.remove({piece.front()});
     }},
    {"AFaceAtTheBorderIsGone", parts, false,
     [](Result& r) {
       const std::vector<Index> piece = r.triangles("shell_front");
       const std::set<Index> border = r.border(piece);
       for (const Index t : piece)
         if (std::count_if(r.soup.triangles[t].begin(), r.soup.triangles[t].end(),
                           [&](Index v) { return border.count(v) > 0; }) == 2)
           return r.remove({t});
       ADD_FAILURE();
     }},
    {"AFaceHasTurnedOver", turned, false,
     [](Result& r) {
       auto& triangle = r.soup.triangles[r.triangles("shell_front").front()];
       std::swap(triangle[0], triangle[1]);
     }},
    {"AFaceIsThereTwice", "pairs", true,
     [](Result& r) {
       const Index t = r.triangles("shell_front").front();
       r.add(r.soup.triangles[t], t);
     }},
    {"AFaceIsALine", "pairs", true,
     [](Result& r) {
       const std::vector<Index> piece = r.triangles("shell_front");
       const auto [a, b, c] = r.soup.triangles[piece.front()];
       const Point_3 from = r.soup.points[a];
       const Index first = r.new_vertex(moved(from, 0, 0, 1));
       r.new_vertex(moved(from, 0, 0, 2));
       r.new_vertex(moved(from, 0, 0, 3));
       r.add({first, first + 1, first + 2}, piece.front());
     }},
    {"AFinStandsOnAnEdge", "topology", true,
     [](Result& r) {
       const std::vector<Index> piece = r.triangles("pocket_left");
       for (const auto& [edge, sides] : r.edges(piece))
         if (sides.size() == 2) {
           const Point_3 top = widened(r.soup.points[edge.first], 1.2);
           return r.add({edge.first, edge.second, r.new_vertex(top)}, piece.front());
         }
       ADD_FAILURE();
     }},
    {"AFaceIsAddedAtTheBorder", parts, false,
     [](Result& r) {
       const std::vector<Index> piece = r.triangles("pocket_left");
       for (const auto& [edge, sides] : r.edges(piece))
         if (sides.size() == 1) {
           const Point_3 top = widened(r.soup.points[edge.first], 1.2);
           return r.add({edge.first, edge.second, r.new_vertex(top)}, piece.front());
         }
       ADD_FAILURE();
     }},
    {"AFaceBridgesTwoPieces", "topology", true,
     [](Result& r) {
       const std::vector<Index> left = r.triangles("pocket_left"), right = r.triangles("pocket_right");
       const Index_triple& from = r.soup.triangles[left.front()];
       r.add({from[0], from[1], r.soup.triangles[right.front()][0]}, left.front());
     }},

    // ---- Borders and seams
    {"ASeamIsGlued", joins, false,
     [](Result& r) {
       std::map<Point_3, Index> at;
       for (const Index vertex : r.vertices(r.triangles("shell_front")))
         at.emplace(r.soup.points[vertex], vertex);
       for (const Index t : r.triangles("shell_back"))
         for (Index& vertex : r.soup.triangles[t])
           if (const auto found = at.find(r.soup.points[vertex]); found != at.end())
             vertex = found->second;
     }},
    {"TwoPiecesAreGluedWhereTheyAreApart", "topology", true,
     [](Result& r) {
       const Index from = *r.border(r.triangles("pocket_left")).begin(),
                   to = *r.border(r.triangles("pocket_right")).begin();
       for (Index_triple& triangle : r.soup.triangles)
         std::replace(triangle.begin(), triangle.end(), from, to);
     }},
    {"APieceIsCutWhereItStands", joins, false,
     [](Result& r) {
       const std::vector<Index> piece = r.triangles("shell_front");
       const double height = r.middle(piece).y();
       std::vector<Index> upper;
       for (const Index t : piece)
         if (r.middle({t}).y() > height)
           upper.push_back(t);
       r.copy(upper);
       r.remove(upper);
     }},
    {"APieceIsCutInTwo", "added", true,
     [](Result& r) {
       const std::vector<Index> piece = r.triangles("shell_back");
       const double height = r.middle(piece).y();
       std::vector<Index> upper;
       for (const Index t : piece)
         if (r.middle({t}).y() > height)
           upper.push_back(t);
       r.move(r.copy(upper), [](const Point_3& p) { return moved(p, 0, 0.0001, 0); });
       r.remove(upper);
     }},
    {"ASeamHasOpened", parts, false,
     [](Result& r) {
       r.move(r.triangles("waistband"), [](const Point_3& p) { return moved(p, 0, 0.002, 0); });
     }},

    // ---- Names and attributes
    {"TwoNamesAreExchanged", "name", true, [](Result& r) { r.swap_names("pocket_left", "pocket_right"); }},
    {"ANameIsAnother", "name", true,
     [](Result& r) {
       for (const Index t : r.triangles("pocket_left"))
         r.soup.groups.of_triangle[t] = r.group("waistband");
     }},
    {"ANameIsNew", "name", true, [](Result& r) { r.soup.groups.names[r.group("pocket_left")] = "pouch"; }},
    {"AllNamesAreNew", "exchanged names of group", false,
     [](Result& r) {
       for (std::string& name : r.soup.groups.names)
         name = "new_" + name;
     }},
    {"AllNamesAreGone", "exchanged names of group", false, [](Result& r) { r.soup.groups = {}; }},
    {"TwoMaterialsAreExchanged", "name", true,
     [](Result& r) { std::swap(r.soup.materials.names[0], r.soup.materials.names[1]); }},
    {"ThereIsOneMaterial", "name", true,
     [](Result& r) {
       std::fill(r.soup.materials.of_triangle.begin(), r.soup.materials.of_triangle.end(), 0);
     }},
    {"ATextureCoordinateIsAnother", values, false, [](Result& r) { r.soup.uvs.values[0][0] += 0.5; }},
    {"TextureCoordinatesAreShuffled", values, false,
     [](Result& r) { std::shuffle(r.soup.uvs.values.begin(), r.soup.uvs.values.end(), std::mt19937(1)); }},
    {"TextureCoordinatesAreGone", values, false, [](Result& r) { r.soup.uvs = {}; }},
};

class Spoiled_result : public testing::TestWithParam<Spoiled>
{
protected:
  Spoiled_result()
  {
    Generate_options options;
    options.faces = 800;
    options.thickness = 0;
    Triangle_soup original = generate("skirt", options);
    original.materials.names = {"wool", "silk"};
    for (const Index group : original.groups.of_triangle)
      original.materials.of_triangle.push_back(original.groups.names[group].rfind("lining", 0) == 0);
    write_mesh(m_in, original);
    EXPECT_EQ(run_app({"simplify", m_in, "-o", m_out, "--ratio", "0.4", "--quiet"}).code, 0);
    m_result.soup = read_mesh(m_out).soup;
  }

  nlohmann::json report() const
  {
    write_mesh(m_out, m_result.soup);
    const App_result run = run_app({"verify", m_out, "--against", m_in, "--json"});
    const nlohmann::json json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["exit_code"], run.code);
    return json;
  }

  Workspace m_folder;
  std::string m_in = m_folder / "in.obj", m_out = m_folder / "out.obj";
  Result m_result;
};

TEST_P(Spoiled_result, IsRefusedOrListedAsUnseen)
{
  const Spoiled& spoiled = GetParam();
  spoiled.spoil(m_result);
  const nlohmann::json found = report();
  std::set<std::string> told;
  for (const auto& mismatch : found["matching"]["first_mismatches"])
    told.insert(mismatch["what"]);
  if (found["verified"]["new_pairs"] > 0)
    told.insert("pairs");
  if (found["layers"]["swaps"] > 0)
    told.insert("layers");
  EXPECT_EQ(found["exit_code"], spoiled.is_seen ? 1 : 0) << found.dump(1);
  EXPECT_EQ(told.empty(), !spoiled.is_seen);
  if (spoiled.is_seen) {
    EXPECT_EQ(told.count(spoiled.told), 1u) << testing::PrintToString(told);
  } else {
    const auto& lines = found["cannot_see"];
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](const nlohmann::json& line) {
      return line.get<std::string>().find(spoiled.told) != std::string::npos;
    })) << lines.dump(1);
  }
}

INSTANTIATE_TEST_SUITE_P(Verify, Spoiled_result, testing::ValuesIn(ways),
                         [](const auto& spoiled) { return spoiled.param.name; });

} // namespace
} // namespace selvedge::test
