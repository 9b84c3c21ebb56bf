// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "random_scene.h"
#include "support/soups.h"

#include "soup/selection.h"
#include <selvedge/normals.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace selvedge::test {
namespace {

constexpr double s_turn = 6.283185307179586;

// Shapes
// ----------------------------------------------------------------------------------------------------------

/// A sheet of width × depth squares whose diagonals run either way, at heights that are asked for.
Triangle_soup grid(Random& random, Index width, Index depth, const std::function<double(int, int)>& height)
{
  Triangle_soup soup;
  for (Index y = 0; y <= depth; ++y)
    for (Index x = 0; x <= width; ++x)
      soup.points.emplace_back(x, y, height(int(x), int(y)));
  for (Index y = 0; y < depth; ++y)
    for (Index x = 0; x < width; ++x) {
      const Index a = y * (width + 1) + x, b = a + 1, c = b + width + 1, d = c - 1;
      if (random.one_in(2)) {
        soup.triangles.push_back({a, b, c});
        soup.triangles.push_back({a, c, d});
      } else {
        soup.triangles.push_back({a, b, d});
        soup.triangles.push_back({b, c, d});
      }
    }
  return soup;
}

Index random_size(Random& random)
{
  return Index(random.one_in(4) ? random.between(6, 9) : random.between(2, 5));
}

/// Sheets with bumps that touch, cross and overlap.
Triangle_soup grid_layers(Random& random)
{
  Triangle_soup soup;
  const int layers = random.between(1, 4);
  const Index size = random_size(random);
  const bool is_flat = random.one_in(4);
  const int distance = random.between(0, 3);
  for (int layer = 0; layer < layers; ++layer)
    soup = joined(std::move(soup), grid(random, size, size, [&](int, int) {
                    return distance * layer + (is_flat ? 0 : random.between(0, 2));
                  }));
  return soup;
}

/// One shape above the other, at a distance that halves its way down to nothing; the layers never meet.
Triangle_soup close_layers(Random& random)
{
  Triangle_soup soup;
  const int layers = random.between(2, 5), roughness = random.between(0, 3);
  const Index width = random_size(random), depth = random_size(random);
  const double gap = std::ldexp(1, -random.between(0, 40));
  const Triangle_soup layer =
      grid(random, width, depth, [&](int, int) { return random.between(0, roughness); });
  for (int i = 0; i < layers; ++i)
    soup = joined(std::move(soup),
                  mapped(layer, [&](const Point_3& p) { return Point_3(p.x(), p.y(), p.z() + i * gap); }));
  return soup;
}

/// A hub with up to two hundred spokes; rims that wind once or twice or are open, and lids.
Triangle_soup wheel(Random& random)
{
  const int spokes = random.one_in(3) ? random.between(40, 200) : random.between(3, 24);
  const double radius = random.one_of({3., 10., 100., 1000.});
  const int turns = random.one_in(6) ? 2 : 1;
  const bool is_closed = !random.one_in(4);
  const int lids = random.between(1, spokes > 60 ? 2 : 3);
  const double gap = random.one_of({1., 0.25, 0x1p-20});
  Triangle_soup soup;
  for (int lid = 0; lid < lids; ++lid) {
    const Index hub = Index(soup.points.size());
    soup.points.emplace_back(random.between(-1, 1), random.between(-1, 1), random.between(0, 4) + lid * gap);
    std::vector<Index> rim;
    for (int i = 0; i < spokes; ++i) {
      const double angle = s_turn * turns * i / spokes;
      const Point_3 p(std::round(radius * std::cos(angle)), std::round(radius * std::sin(angle)),
                      lid * gap + (turns == 2         ? std::ldexp(i, -4)
                                   : random.one_in(8) ? 0.5 * gap
                                                      : 0));
      if (rim.empty() || soup.points[rim.back()] != p) {
        rim.push_back(Index(soup.points.size()));
        soup.points.push_back(p);
      }
    }
    const bool has_ring = random.one_in(3) && spokes < 80;
    const Index outer = Index(soup.points.size());
    for (std::size_t i = 0; has_ring && i < rim.size(); ++i) {
      const Point_3 p = soup.points[rim[i]];
      soup.points.emplace_back(2 * p.x(), 2 * p.y(), p.z());
    }
    for (std::size_t i = 0; i + (is_closed ? 0 : 1) < rim.size(); ++i) {
      const std::size_t j = (i + 1) % rim.size();
      soup.triangles.push_back({hub, rim[i], rim[j]});
      if (has_ring) {
        soup.triangles.push_back({rim[i], Index(outer + i), Index(outer + j)});
        soup.triangles.push_back({rim[i], Index(outer + j), rim[j]});
      }
    }
  }
  return soup;
}

/// A sheet on whose edges and vertices further triangles stand.
Triangle_soup fins(Random& random)
{
  const Index size = random_size(random);
  Triangle_soup soup = grid(random, size, size, [&](int, int) { return random.one_in(4) ? 0.25 : 0; });
  const std::size_t own = soup.triangles.size();
  const int count = random.between(1, int(size * size) / 2 + 1);
  for (int i = 0; i < count; ++i) {
    const Index_triple face = soup.triangles[random.below(own)];
    const std::size_t k = random.below(3);
    Index a = face[k], b = face[(k + 1) % 3];
    const Point_3 middle = CGAL::midpoint(soup.points[a], soup.points[b]);
    const auto add = [&soup](const Point_3& p) {
      soup.points.push_back(p);
      return Index(soup.points.size() - 1);
    };
    if (random.one_in(4)) // with vertices of its own
      a = add(soup.points[a]);
    if (random.one_in(4))
      b = add(soup.points[b]);
    if (random.one_in(6)) // at one vertex alone
      b = add({soup.points[a].x(), soup.points[a].y() + 0.5, 1});
    const Index top = add({middle.x(), middle.y(), random.one_of({1., -1., 0.5})});
    soup.triangles.push_back(random.one_in(2) ? Index_triple{a, b, top} : Index_triple{b, a, top});
  }
  return soup;
}

/// Pages of several squares on one spine.
Triangle_soup book(Random& random)
{
  Triangle_soup soup;
  const int pages = random.between(2, 6), height = random.between(1, 6), width = random.between(1, 4);
  const bool is_bound = random.one_in(2); // by vertex numbers
  for (int i = 0; i < pages; ++i) {
    const double angle = s_turn * i / pages, x = std::round(4 * std::cos(angle)),
                 y = std::round(4 * std::sin(angle));
    const Triangle_soup page = mapped(grid(random, Index(width), Index(height), [](int, int) { return 0; }),
                                      [&](const Point_3& p) { return Point_3(p.x() * x, p.x() * y, p.y()); });
    soup = joined(std::move(soup), page);
  }
  if (is_bound) {
    std::map<double, Index> spine;
    for (Index_triple& triangle : soup.triangles)
      for (Index& v : triangle)
        if (const Point_3& p = soup.points[v]; p.x() == 0 && p.y() == 0)
          v = spine.emplace(p.z(), v).first->second;
  }
  return soup;
}

/// Sheets that have one corner in common, or rings that touch in a point.
Triangle_soup bowties(Random& random)
{
  Triangle_soup soup;
  const int sheets = random.between(2, 5);
  const Index size = Index(random.between(1, 4));
  for (int i = 0; i < sheets; ++i) {
    const double turn = s_turn * i / sheets, x = std::round(8 * std::cos(turn)),
                 y = std::round(8 * std::sin(turn));
    const double u = std::round(8 * std::cos(turn + 0.6)), v = std::round(8 * std::sin(turn + 0.6));
    const double lift = random.between(0, 1);
    soup = joined(
        std::move(soup),
        mapped(grid(random, size, size, [&](int a, int b) { return a + b > 0 ? random.between(0, 1) : 0; }),
               [&](const Point_3& p) {
                 return Point_3(p.x() * x + p.y() * u, p.x() * y + p.y() * v, p.z() + lift * (p.x() + p.y()));
               }));
  }
  if (random.one_in(2)) {
    Index centre = 0;
    for (Index_triple& triangle : soup.triangles)
      for (Index& v : triangle)
        if (soup.points[v] == CGAL::ORIGIN)
          v = centre = centre == 0 ? v : centre;
  }
  return soup;
}

/// Sheets in one plane, side by side or upon each other.
Triangle_soup planar_stack(Random& random)
{
  Triangle_soup soup;
  const int sheets = random.between(1, 4);
  for (int i = 0; i < sheets; ++i) {
    const double x = random.between(0, 6), y = random.between(0, 6), z = random.one_in(2) ? 0 : i,
                 scale = random.between(1, 2);
    soup = joined(std::move(soup),
                  mapped(grid(random, random_size(random), random_size(random), [](int, int) { return 0; }),
                         [&](const Point_3& p) { return Point_3(scale * p.x() + x, scale * p.y() + y, z); }));
  }
  return soup;
}

/// Boxes around one another, divided into squares.
Triangle_soup nested_boxes(Random& random)
{
  Triangle_soup soup;
  const int boxes = random.between(1, 3), size = random.between(1, boxes == 1 ? 4 : 3);
  const double gap = random.one_of({1., 0.25, 0x1p-30});
  for (int box = 0; box < boxes; ++box) {
    std::map<std::array<int, 3>, Index> vertices;
    const auto vertex = [&](std::array<int, 3> at) {
      const auto [entry, is_new] = vertices.emplace(at, Index(soup.points.size()));
      if (is_new) {
        const auto coordinate = [&](int i) {
          return double(at[i]) + (at[i] == 0 ? -box * gap : at[i] == size ? box * gap : 0);
        };
        soup.points.emplace_back(coordinate(0), coordinate(1), coordinate(2));
      }
      return entry->second;
    };
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, size})
        for (int u = 0; u < size; ++u)
          for (int v = 0; v < size; ++v) {
            const auto at = [&](int i, int j) {
              std::array<int, 3> place{};
              place[axis] = side;
              place[(axis + 1) % 3] = u + i;
              place[(axis + 2) % 3] = v + j;
              return vertex(place);
            };
            const Index a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
            const bool is_turned = (side == 0);
            const auto add = [&](Index i, Index j, Index k) {
              soup.triangles.push_back(is_turned ? Index_triple{i, k, j} : Index_triple{i, j, k});
            };
            if (random.one_in(2)) {
              add(a, b, c);
              add(a, c, d);
            } else {
              add(a, b, d);
              add(b, c, d);
            }
          }
  }
  return soup;
}

/// A tube, a torus, or a band with half a twist, and another in or around it.
Triangle_soup tubes(Random& random)
{
  Triangle_soup soup;
  const int around = random.between(3, 12), along = random.between(1, 8), kind = random.between(0, 2);
  const int tubes = random.between(1, 3);
  const double gap = random.one_of({1., 0.125, 0x1p-24});
  for (int tube = 0; tube < tubes; ++tube) {
    const Index first = Index(soup.points.size());
    const int rows = kind == 1 ? std::max(3, along) : along + 1;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < around; ++i) {
        const double angle = s_turn * i / around, radius = 4 + tube * gap;
        if (kind == 1) {
          const double turn = s_turn * j / rows, reach = 12 + radius * std::cos(angle);
          soup.points.emplace_back(reach * std::cos(turn), reach * std::sin(turn), radius * std::sin(angle));
        } else {
          soup.points.emplace_back(std::round(16 * radius * std::cos(angle)) / 16,
                                   std::round(16 * radius * std::sin(angle)) / 16, j);
        }
      }
    for (int j = 0; j + (kind == 1 ? 0 : 1) < rows; ++j)
      for (int i = 0; i < around; ++i) {
        if (kind == 2 && i + 1 == around) // slit
          continue;
        const int k = (i + 1) % around, l = (j + 1) % rows;
        const Index a = first + Index(j * around + i), b = first + Index(j * around + k);
        const Index c = first + Index(l * around + k), d = first + Index(l * around + i);
        soup.triangles.push_back({a, b, c});
        soup.triangles.push_back({a, c, d});
      }
  }
  return soup;
}

/// A strip that is folded to and fro, or winds upwards.
Triangle_soup folded_strip(Random& random)
{
  const int folds = random.between(2, 6), length = random.between(1, 6);
  const Index width = Index(random.between(1, 4));
  const double gap = random.one_of({1., 0.5, 0x1p-20, 0x1p-45});
  const bool is_zigzag = random.one_in(2);
  const int columns = folds * length;
  Triangle_soup soup = grid(random, Index(columns), width, [](int, int) { return 0; });
  return mapped(std::move(soup), [&](const Point_3& p) {
    const int column = int(p.x()), fold = std::min(column / length, folds - 1), rest = column - fold * length;
    const int x = fold % 2 == 0 ? rest : length - rest;
    return Point_3(x, p.y(), is_zigzag ? gap * column : gap * (fold + double(rest) / (2 * length)));
  });
}

/// Some triangles anywhere.
Triangle_soup random_triangles(Random& random)
{
  Triangle_soup soup;
  const int points = random.between(4, 24), triangles = random.between(1, 20), size = random.between(2, 6);
  for (int i = 0; i < points; ++i)
    soup.points.emplace_back(random.between(0, size), random.between(0, size), random.between(0, size));
  for (int i = 0; i < triangles; ++i)
    soup.triangles.push_back(
        {Index(random.below(points)), Index(random.below(points)), Index(random.below(points))});
  return soup;
}

/// A sheet cut into pieces with vertices of their own, which lie together or gape.
Triangle_soup patchwork(Random& random)
{
  const Index width = random_size(random), depth = random_size(random);
  const Triangle_soup whole =
      grid(random, width, depth, [&](int, int) { return random.one_in(3) ? 0.5 : 0; });
  const int columns = random.between(1, 3), rows = random.between(1, 2);
  const double gap = random.one_of({0., 0., 0.01, 0x1p-10, 0x1p-30});
  const bool is_ragged = random.one_in(4);
  Triangle_soup soup;
  std::map<std::pair<int, Index>, Index> vertices;
  for (Index_triple triangle : whole.triangles) {
    const Point_3& p = whole.points[triangle[0]];
    int piece = int(p.x()) * columns / int(width + 1) + columns * (int(p.y()) * rows / int(depth + 1));
    if (is_ragged && random.one_in(6))
      piece = int(random.below(std::size_t(columns * rows)));
    for (Index& v : triangle) {
      const auto [entry, is_new] = vertices.emplace(std::pair(piece, v), Index(soup.points.size()));
      if (is_new) {
        const Point_3& q = whole.points[v];
        soup.points.emplace_back(q.x() + gap * piece * random.share(), q.y() + gap * piece,
                                 q.z() + gap * random.share());
      }
      v = entry->second;
    }
    if (piece == 1 && columns == 3) // turned over
      std::swap(triangle[1], triangle[2]);
    soup.triangles.push_back(triangle);
  }
  return soup;
}

/// Needles from one vertex, some of them nearly on one line.
Triangle_soup needles(Random& random)
{
  Triangle_soup soup;
  soup.points.emplace_back(0, 0, 0);
  const int count = random.between(3, 40);
  const double width = std::ldexp(1, -random.between(0, 50));
  for (int i = 0; i < count; ++i)
    soup.points.emplace_back(64 + random.between(0, 2), width * i, random.one_in(4) ? width : 0);
  for (Index i = 1; i + 1 < soup.points.size(); ++i)
    soup.triangles.push_back({0, i, i + 1});
  if (random.one_in(2)) {
    const Index far = Index(soup.points.size());
    soup.points.emplace_back(128, 0, random.between(0, 1));
    for (Index i = 1; i + 1 < far; ++i)
      soup.triangles.push_back({far, i + 1, i});
  }
  return soup;
}

/// A disc of random points in convex position around inner ones, cut from a sphere or a plane: valences of
/// all kinds.
Triangle_soup random_disc(Random& random)
{
  const int size = random.between(3, 12);
  Triangle_soup soup = grid(random, Index(size), Index(size), [](int, int) { return 0; });
  // Edges are turned while that keeps all triangles proper in the plane.
  for (int i = 0; i < 6 * size * size; ++i) {
    const std::size_t f = random.below(soup.triangles.size());
    const std::size_t k = random.below(3);
    const Index a = soup.triangles[f][k], b = soup.triangles[f][(k + 1) % 3],
                c = soup.triangles[f][(k + 2) % 3];
    for (std::size_t g = 0; g < soup.triangles.size(); ++g)
      for (std::size_t l = 0; l < 3; ++l) {
        if (soup.triangles[g][l] != b || soup.triangles[g][(l + 1) % 3] != a)
          continue;
        const Index d = soup.triangles[g][(l + 2) % 3];
        const auto turn = [&](Index p, Index q, Index r) {
          const Point_3 &u = soup.points[p], &v = soup.points[q], &w = soup.points[r];
          return (v.x() - u.x()) * (w.y() - u.y()) - (v.y() - u.y()) * (w.x() - u.x()) > 0;
        };
        if (turn(c, a, d) && turn(d, b, c)) {
          soup.triangles[f] = {c, a, d};
          soup.triangles[g] = {d, b, c};
        }
        l = 3;
        g = soup.triangles.size() - 1;
      }
  }
  const int bend = random.between(0, 2);
  return mapped(std::move(soup), [&](const Point_3& p) {
    const double z = bend == 0 ? 0 : bend == 1 ? (p.x() * p.x() + p.y() * p.y()) / 8 : random.between(0, 2);
    return Point_3(p.x(), p.y(), z);
  });
}

struct Named_shape
{
  const char* name;
  Triangle_soup (*make)(Random&);
};

constexpr Named_shape s_shapes[] = {{"grid layers", grid_layers},
                                    {"close layers", close_layers},
                                    {"wheel", wheel},
                                    {"fins", fins},
                                    {"book", book},
                                    {"bowties", bowties},
                                    {"planar stack", planar_stack},
                                    {"nested boxes", nested_boxes},
                                    {"tubes", tubes},
                                    {"folded strip", folded_strip},
                                    {"triangles", random_triangles},
                                    {"patchwork", patchwork},
                                    {"needles", needles},
                                    {"disc", random_disc},
                                    {"close layers", close_layers},
                                    {"disc", random_disc}};

} // namespace

Scene random_scene(Random& random)
{
  Scene scene;
  const int shapes = random.one_in(5) ? 2 : 1;
  for (int i = 0; i < shapes; ++i) {
    const Named_shape& shape = s_shapes[random.below(std::size(s_shapes))];
    scene.name += (i > 0 ? " and " : "") + std::string(shape.name);
    const double x = i * random.between(-2, 6), y = i * random.between(-2, 6), z = i * random.between(-2, 2);
    scene.soup = joined(std::move(scene.soup), mapped(shape.make(random), [&](const Point_3& p) {
                          return Point_3(p.x() + x, p.y() + y, p.z() + z);
                        }));
  }
  constexpr std::size_t most = 300;
  if (scene.soup.triangles.size() > most)
    scene.soup.triangles.resize(most);
  return scene;
}

// Spoiling
// ----------------------------------------------------------------------------------------------------------

void spoil(Triangle_soup& soup, Random& random)
{
  std::vector<Index_triple> triangles;
  const std::size_t drop = random.one_of({4, 12, 60, 1000}), twice = random.one_of({60, 1000}),
                    turn = random.one_of({10, 1000, 1000}), split = random.one_of({10, 30, 1000, 1000}),
                    join = random.one_of({100, 1000, 1000}), move = random.one_of({60, 1000, 1000});
  const auto any_vertex = [&] { return Index(random.below(soup.points.size())); };
  for (Index_triple triangle : soup.triangles) {
    if (random.one_in(drop))
      continue;
    for (Index& v : triangle)
      if (random.one_in(split)) {
        soup.points.push_back(Point_3(soup.points[v]));
        v = Index(soup.points.size() - 1);
      } else if (random.one_in(join)) {
        v = any_vertex();
      } else if (random.one_in(move)) {
        soup.points[v] = Point_3(soup.points[any_vertex()]);
      }
    if (random.one_in(turn))
      std::swap(triangle[1], triangle[2]);
    triangles.push_back(triangle);
    if (random.one_in(twice))
      triangles.push_back({triangle[0], triangle[2], triangle[1]});
  }
  if (random.one_in(8)) { // no area
    const Index v = any_vertex(), w = any_vertex();
    const Point_3 middle = CGAL::midpoint(soup.points[v], soup.points[w]);
    soup.points.push_back(middle);
    triangles.push_back({v, Index(soup.points.size() - 1), w});
    triangles.push_back({v, v, w});
  }
  if (random.one_in(4))
    soup.points.emplace_back(random.between(-9, 9), random.between(-9, 9), random.between(-9, 9));
  soup.triangles = std::move(triangles);
}

void add_needles(Triangle_soup& soup, Random& random)
{
  for (int i = random.between(1, 8); i > 0; --i)
    add_needle(soup, random.below(soup.triangles.size()), random.below(3));
}

void add_doubles(Triangle_soup& soup, Random& random)
{
  constexpr std::size_t most = 120;
  if (soup.triangles.size() > most)
    soup.triangles.resize(most);
  const std::vector<Index_triple> before = soup.triangles;
  const std::size_t single = random.one_of({2, 5, 1000}), own = random.one_of({1, 1000, 4, 20}),
                    straight = random.one_of({2, 1, 1000, 1000}), place = random.below(4);
  const auto is_double = [&, half = random.one_in(3)](std::size_t t) {
    return half ? t < before.size() / 2 : !random.one_in(single);
  };
  for (int times = random.one_in(4) ? 2 : 1; times > 0; --times) {
    std::map<Index, Index> copies; // of vertices
    for (std::size_t t = 0; t < before.size(); ++t) {
      if (!is_double(t))
        continue;
      Index_triple triangle = before[t];
      for (Index& v : triangle) {
        if (copies.count(v) == 0) {
          copies[v] = v;
          if (random.one_in(own)) {
            copies[v] = Index(soup.points.size());
            soup.points.push_back(Point_3(soup.points[v]));
          }
        }
        v = copies[v];
      }
      std::rotate(triangle.begin(), triangle.begin() + random.below(3), triangle.end());
      if (!random.one_in(straight))
        std::swap(triangle[1], triangle[2]);
      const bool is_anywhere = place == 3 && random.one_in(2); // mostly behind all of the others
      soup.triangles.insert(is_anywhere ? soup.triangles.begin() : soup.triangles.end(), triangle);
    }
  }
}

// Where it lies
// ----------------------------------------------------------------------------------------------------------

std::string displace(Triangle_soup& soup, Random& random)
{
  std::string done;
  const auto map = [&](const char* what, const std::function<Point_3(const Point_3&)>& function) {
    done += std::string(done.empty() ? "" : ", ") + what;
    soup = mapped(std::move(soup), function);
  };
  if (random.one_in(3)) { // signed permutations of the axes
    std::array<int, 3> axes{0, 1, 2};
    for (int i = 2; i > 0; --i)
      std::swap(axes[i], axes[random.below(std::size_t(i + 1))]);
    const std::array<double, 3> signs{random.one_of({1., -1.}), random.one_of({1., -1.}),
                                      random.one_of({1., -1.})};
    map("turned", [&](const Point_3& p) {
      return Point_3(signs[0] * p[axes[0]], signs[1] * p[axes[1]], signs[2] * p[axes[2]]);
    });
  }
  if (random.one_in(5))
    map("sheared",
        [&](const Point_3& p) { return Point_3(p.x() + 0.5 * p.z(), p.y() - 0.25 * p.z(), p.z() + p.x()); });
  switch (random.below(12)) {
  case 0: {
    const double unit = random.one_of({0x1p-52, 0x1p-51, 0x1p-40});
    map("at units in the last place",
        [&](const Point_3& p) { return Point_3(1 + unit * p.x(), 1 + unit * p.y(), 1 + unit * p.z()); });
    break;
  }
  case 1:
    map("flattened to units in the last place",
        [&](const Point_3& p) { return Point_3(p.x(), p.y(), 1 + 0x1p-52 * std::round(p.z())); });
    break;
  case 2: {
    const double unit = random.one_of({0x1p-24, 0x1p-25, 0x1p-23});
    map("between 32-bit floats", [&](const Point_3& p) {
      return Point_3(1 + unit * p.x(), 1 + unit * p.y(), random.one_in(2) ? p.z() : 1 + unit * p.z());
    });
    break;
  }
  case 3: {
    const double size = random.one_of({0.3, 1e-3, 1e-9, 1e-17});
    map("jittered", [&](const Point_3& p) {
      return Point_3(p.x() + size * random.share(), p.y() + size * random.share(),
                     p.z() + size * random.share());
    });
    break;
  }
  case 4: {
    const double angle = random.share() * s_turn, c = std::cos(angle), s = std::sin(angle);
    map("rotated", [&](const Point_3& p) {
      return Point_3(c * p.x() - s * p.y(), s * p.x() + c * p.y(), c * p.z() + 0.1 * s * p.x());
    });
    break;
  }
  case 5: {
    const double far = random.one_of({0x1p20, 0x1p40, 0x1p51});
    map("far away", [&](const Point_3& p) { return Point_3(p.x() + far, p.y() - far, p.z() + far); });
    break;
  }
  case 6: {
    const double third = 1. / 3;
    map("in thirds", [&](const Point_3& p) { return Point_3(third * p.x(), third * p.y(), third * p.z()); });
    break;
  }
  default:
    break;
  }
  if (random.one_in(4)) {
    const int exponent = random.one_in(3) ? random.between(-960, 960) : random.between(-120, 120);
    map(("times 2^" + std::to_string(exponent)).c_str(), [&](const Point_3& p) {
      return Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
    });
  }
  if (random.one_in(4)) {
    const auto zero = [&](double x) { return x == 0 && random.one_in(2) ? -x : x; };
    map("zeros of either sign",
        [&](const Point_3& p) { return Point_3(zero(p.x()), zero(p.y()), zero(p.z())); });
  }
  return done;
}

// What hangs on it
// ----------------------------------------------------------------------------------------------------------

namespace {

Triangle_labels random_labels(const Triangle_soup& soup, Random& random,
                              const std::vector<std::string>& names)
{
  Triangle_labels labels;
  labels.names = names;
  const int kind = random.between(0, 2);
  const double plane = soup.points.empty() ? 0 : soup.points[random.below(soup.points.size())].x();
  for (const Index_triple& triangle : soup.triangles) {
    std::size_t label = 0;
    if (kind == 0) // anyhow
      label = random.one_in(4) ? random.below(names.size()) : 0;
    else if (kind == 1) // on both sides of a plane
      label = soup.points[triangle[0]].x() + soup.points[triangle[1]].x() > 2 * plane;
    else // in a row
      label = labels.of_triangle.size() * names.size() / soup.triangles.size();
    labels.of_triangle.push_back(Index(label % names.size()));
  }
  return labels;
}

Corner_values<2> random_uvs(const Triangle_soup& soup, Random& random)
{
  Corner_values<2> uvs;
  const int kind = random.between(0, 3);
  double size = 0;
  for (const Point_3& p : soup.points)
    size = std::max({size, std::fabs(p.x()), std::fabs(p.y())});
  const auto planar = [&](const Point_3& p) {
    return std::array{size > 0 ? p.x() / size : 0, size > 0 ? p.y() / size : 0};
  };
  for (const Point_3& p : soup.points)
    uvs.values.push_back(kind == 3 ? std::array{double(random.between(0, 3)), double(random.between(0, 3))}
                                   : planar(p));
  const Index moved = Index(uvs.values.size()); // another chart
  for (const Point_3& p : soup.points)
    uvs.values.push_back({planar(p)[0] + 2, planar(p)[1] * 0.5});
  const double plane = soup.points[random.below(soup.points.size())].y();
  for (const Index_triple& triangle : soup.triangles) {
    const bool is_moved = kind == 1 ? random.one_in(8) : kind == 2 && soup.points[triangle[0]].y() > plane;
    uvs.of_triangle.push_back(triangle);
    for (Index& v : uvs.of_triangle.back())
      v += is_moved ? moved : 0;
  }
  return uvs;
}

Corner_values<3> random_normals(const Triangle_soup& soup, Random& random)
{
  Corner_values<3> normals;
  normals.values = {{0, 0, 1}, {0, 0.6, 0.8}, {1, 0, 0}};
  if (random.one_in(3))
    normals.values[1] = {1e-6, 0, 1}; // as arithmetic may make of the first
  const bool is_smooth = random.one_in(2);
  for (const Index_triple& triangle : soup.triangles) {
    const Index one = Index(random.one_in(6) ? random.below(3) : 0);
    normals.of_triangle.push_back(is_smooth ? Index_triple{triangle[0] % 3, triangle[1] % 3, triangle[2] % 3}
                                            : Index_triple{one, one, one});
  }
  return normals;
}

} // namespace

void decorate(Triangle_soup& soup, Random& random)
{
  if (soup.triangles.empty())
    return;
  if (random.one_in(3))
    soup.groups = random_labels(soup, random, {"left", "right sleeve", "collar"});
  if (random.one_in(8))
    soup.objects = random_labels(soup, random, {"coat", "shirt"});
  if (random.one_in(6))
    soup.materials = random_labels(soup, random, {"wool", "silk"});
  if (random.one_in(12))
    soup.smoothing_groups = random_labels(soup, random, {"1", "off"});
  if (random.one_in(3))
    soup.uvs = random_uvs(soup, random);
  if (random.one_in(8))
    soup.normals = random_normals(soup, random);
  if (!soup.normals.empty()) {
    const auto kind = random.below(3);
    if (kind == 0)
      restore_normals(soup, Normals_treatment::flat);
    if (kind == 1) {
      for (Index_triple& corners : soup.normals.of_triangle)
        corners = {0, 0, 0}; // no edge is hard
      restore_normals(soup, Normals_treatment::smooth);
    }
  }
  if (random.one_in(4)) {
    Attribute weights;
    weights.name = "w";
    for (std::size_t v = 0; v < soup.points.size(); ++v) {
      const double weight = random.one_of({1., 1., 0., 0.5, 1000.});
      unsigned char bytes[sizeof weight];
      std::memcpy(bytes, &weight, sizeof weight);
      weights.rows.insert(weights.rows.end(), bytes, bytes + sizeof weight);
    }
    soup.vertex_attributes.push_back(std::move(weights));
  }
}

// What stands in its way
// ----------------------------------------------------------------------------------------------------------

Triangle_soup random_obstacle(const Triangle_soup& soup, Random& random)
{
  Triangle_soup obstacle;
  if (soup.points.empty())
    return obstacle;
  const auto any_point = [&] { return Point_3(soup.points[random.below(soup.points.size())]); };
  const Point_3 p = any_point(), q = any_point();
  double size = std::max({std::fabs(p.x() - q.x()), std::fabs(p.y() - q.y()), std::fabs(p.z() - q.z())});
  if (!(size > 0))
    size = 1;
  const auto beside = [&](const Point_3& point, double share) {
    const auto shifted = [&](double x) { return x + share * size * random.between(-4, 4); };
    return Point_3(shifted(point.x()), shifted(point.y()), shifted(point.z()));
  };
  const auto add_triangle = [&](const Point_3& a, const Point_3& b, const Point_3& c) {
    const Index first = Index(obstacle.points.size());
    obstacle.points.insert(obstacle.points.end(), {a, b, c});
    obstacle.triangles.push_back({first, first + 1, first + 2});
  };
  const int kinds = random.between(1, 2);
  for (int i = 0; i < kinds; ++i)
    switch (random.below(6)) {
    case 0: { // the same again, a little off
      const double share = random.one_of({0.25, 0x1p-8, 0x1p-20, 0x1p-50});
      const Point_3 shift = beside(CGAL::ORIGIN, share);
      Triangle_soup copy;
      copy.points = soup.points;
      copy.triangles = soup.triangles;
      obstacle = joined(std::move(obstacle), mapped(std::move(copy), [&](const Point_3& v) {
                          return Point_3(v.x() + shift.x(), v.y() + shift.y(), v.z() + shift.z());
                        }));
      break;
    }
    case 1: // some of the same
      for (const auto& [a, b, c] : soup.triangles)
        if (random.one_in(6))
          add_triangle(soup.points[a], soup.points[c], soup.points[b]);
      break;
    case 2: { // at borders
      std::map<std::pair<Index, Index>, int> count;
      for (const Index_triple& t : soup.triangles)
        for (int k = 0; k < 3; ++k)
          ++count[std::minmax(t[k], t[(k + 1) % 3])];
      for (const Index_triple& t : soup.triangles)
        for (int k = 0; k < 3; ++k)
          if (count[std::minmax(t[k], t[(k + 1) % 3])] == 1 && random.one_in(4)) {
            const Point_3 &a = soup.points[t[k]], &b = soup.points[t[(k + 1) % 3]];
            add_triangle(b, a, beside(CGAL::midpoint(a, b), random.one_of({0.5, 0.125})));
          }
      break;
    }
    case 3: // leaves that hang on one vertex or two
      for (int leaf = random.between(1, 4); leaf > 0; --leaf) {
        const Point_3 a = any_point(), b = random.one_in(2) ? any_point() : beside(a, 0.25);
        add_triangle(a, b, beside(a, 0.25));
      }
      break;
    case 4: // leaves near, each on its own
      for (int leaf = random.between(1, 6); leaf > 0; --leaf) {
        const Point_3 a = beside(any_point(), 0.125);
        add_triangle(a, beside(a, 0.25), beside(a, 0.25));
      }
      break;
    default: // what is almost where a vertex is
      for (int leaf = random.between(1, 4); leaf > 0; --leaf) {
        const Point_3 a = any_point();
        const auto off = [&](double x) {
          return random.one_in(2) ? x : std::nextafter(x, random.one_in(2) ? HUGE_VAL : -HUGE_VAL);
        };
        add_triangle({off(a.x()), off(a.y()), off(a.z())}, beside(a, 0.25), beside(a, 0.25));
      }
    }
  for (const Point_3& v : obstacle.points)
    if (!(std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z())))
      return {};
  return obstacle;
}

} // namespace selvedge::test
