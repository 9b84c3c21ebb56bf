// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "random_scene.h"
#include "support/soups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace selvedge::test {
namespace {

constexpr double s_turn = 6.283185307179586;

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

Triangle_soup uneven_seam(Random& random)
{
  const double length = random.between(6, 9), gap = random.one_of({0.25, 0x1p-4, 0x1p-10, 0x1p-30}),
               height = random.one_of({0., 1 / 32., 0.25, 1.}), sway = random.one_of({0., 1 / 16., 0.25});
  Triangle_soup soup;
  for (const int side : {0, 1}) {
    const Index width = Index(random.between(4, 6)),
                rows = Index(length) + Index(side * random.between(1, 5));
    const double rough = random.one_of({0., 0., gap / 8});
    soup = joined(std::move(soup), mapped(sheet(width, rows), [&](const Point_3& p) {
                    const double y = p.y() * length / rows;
                    const double x = side == 0 ? p.x() - width - gap / 2 : p.x() + gap / 2;
                    return Point_3(x + sway * std::sin(y), y + rough * random.share(),
                                   height * std::sin(0.8 * y) + rough * random.share() + x * x / 64);
                  }));
  }
  return soup;
}

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

} // namespace selvedge::test
