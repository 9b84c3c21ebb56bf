// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "random_changes.h"
#include "soup/Gltf_scene.h"
#include "soup/gltf_transforms.h"
#include "soup/selection.h"
#include "support/soups.h"

#include <selvedge/normals.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace selvedge::test {

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
    constexpr double turn = 6.283185307179586;
    const double angle = random.share() * turn, c = std::cos(angle), s = std::sin(angle);
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

// Makes normals flat, or smooth everywhere, or leaves them as they are.
void shade(Triangle_soup& soup, Random& random)
{
  const auto kind = random.below(3);
  if (kind == 0)
    restore_normals(soup, Normals_treatment::flat);
  if (kind == 1) {
    for (Index_triple& corners : soup.normals.of_triangle)
      corners = {0, 0, 0}; // no edge is hard
    restore_normals(soup, Normals_treatment::smooth);
  }
}

// Quantises a column as Draco does.
void put_on_steps(Gltf_scene::Column& column, Index rows, int bits)
{
  Gltf_scene::Compression::Quantisation quantisation;
  quantisation.bits = bits;
  for (std::size_t k = 0; k < column.components; ++k) {
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (Index row = 0; row < rows; ++row) {
      low = std::min(low, float(component(column, row, k)));
      high = std::max(high, float(component(column, row, k)));
    }
    quantisation.origin.push_back(low);
    quantisation.range = std::max(quantisation.range, high - low);
  }
  column.compression->quantisation = quantisation;
  std::string bytes;
  for (Index row = 0; row < rows; ++row)
    for (std::size_t k = 0; k < column.components; ++k)
      append_little_endian(bytes, float(column.nearest_quantised(component(column, row, k), k)));
  column.rows = bytes;
}

} // namespace

void quantise(Triangle_soup& soup, Random& random)
{
  const auto scene = std::make_shared<Gltf_scene>(*soup.scene);
  for (Gltf_scene::Block& block : scene->blocks)
    for (Gltf_scene::Column& column : block.attributes) {
      column.compression.emplace();
      if (column.name == "POSITION" || column.name == "TEXCOORD_0")
        put_on_steps(column, block.size, random.one_of({5, 9, 14}));
    }
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const Gltf_scene::Instance& instance = scene->instances[scene->instance_of(soup.scene_vertices[v])];
    soup.points[v] = world_position(instance.to_world, scene->blocks[instance.block].attributes.front(),
                                    soup.scene_vertices[v] - instance.first);
  }
  Index number = 0; // of a texture coordinate
  for (const Gltf_scene::Instance& instance : scene->instances)
    for (const Gltf_scene::Column& column : scene->blocks[instance.block].attributes)
      for (Index row = 0; column.name == "TEXCOORD_0" && row < scene->blocks[instance.block].size; ++row)
        soup.uvs.values[number++] = {component(column, row, 0), 1 - component(column, row, 1)};
  soup.scene = scene;
}

void add_tangents_as_colours(Triangle_soup& soup, Random& random)
{
  if (soup.normals.empty()) {
    soup.normals = random_normals(soup, random);
    shade(soup, random);
  }
  const Triangle_labels sides = random_labels(soup, random, {"front", "back"});
  for (const char* const name : {"red", "green", "blue", "alpha"}) {
    Attribute& numbers = soup.vertex_attributes.emplace_back();
    numbers.name = name;
    numbers.type = Attribute::Type::float32;
  }
  std::map<std::pair<Index, Index>, Index> numbers; // by vertex and side
  std::vector<Point_3> points;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (Index& v : soup.triangles[t]) {
      const Index side = sides.of_triangle[t];
      const auto [place, is_new] = numbers.try_emplace({v, side}, Index(points.size()));
      if (is_new) {
        points.push_back(soup.points[v]);
        const std::size_t axis = random.one_in(8) ? random.below(3) : 0;
        for (std::size_t i = 0; i < 4; ++i) {
          const float number = i == axis || (i == 3 && side == 0) ? 1 : 0;
          const auto* const bytes = reinterpret_cast<const unsigned char*>(&number);
          soup.vertex_attributes[i].rows.insert(soup.vertex_attributes[i].rows.end(), bytes,
                                                bytes + sizeof number);
        }
      }
      v = place->second;
    }
  soup.points = std::move(points);
}

void make_sides_of_alpha(Triangle_soup& soup)
{
  const auto make_sides = [](auto& rows) {
    float side;
    for (std::size_t place = 3 * sizeof side; place < rows.size(); place += 4 * sizeof side) {
      std::memcpy(&side, rows.data() + place, sizeof side);
      side = side == 0 ? -1 : 1;
      std::memcpy(rows.data() + place, &side, sizeof side);
    }
  };
  for (Attribute& attribute : soup.vertex_attributes)
    if (attribute.name == "TANGENT")
      make_sides(attribute.rows);
  const auto scene = std::make_shared<Gltf_scene>(*soup.scene);
  for (Gltf_scene::Block& block : scene->blocks)
    if (Gltf_scene::Column* const column = block.tangents())
      make_sides(column->rows);
  soup.scene = scene;
}

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
  if (!soup.normals.empty())
    shade(soup, random);
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

void paint(Triangle_soup& soup)
{
  for (const char* const name : {"red", "green", "blue"}) {
    Attribute numbers;
    numbers.name = name;
    for (std::size_t v = 0; v < soup.points.size(); ++v) {
      const double number = double((v + 1) * (7 + soup.vertex_attributes.size()) * 37 % 101) / 100;
      unsigned char bytes[sizeof number];
      std::memcpy(bytes, &number, sizeof number);
      numbers.rows.insert(numbers.rows.end(), bytes, bytes + sizeof number);
    }
    soup.vertex_attributes.push_back(std::move(numbers));
  }
}

void add_poles(Triangle_soup& soup, Random& random)
{
  const auto same_place = [&](Index v, Index w) { return soup.points[v] == soup.points[w]; };
  if (random.one_in(2) && soup.uvs.empty()) {
    for (const Point_3& p : soup.points)
      soup.uvs.values.push_back({p.x(), p.y()});
    soup.uvs.of_triangle = soup.triangles;
  }
  for (int i = random.between(1, 4); i > 0; --i) {
    const Index pole = soup.triangles[random.below(soup.triangles.size())][random.below(3)];
    const bool is_split = random.one_in(2), is_in_uv = random.one_in(2), is_in_normal = random.one_in(4);
    const int variety = random.one_of({2, 4, 100}); // of values
    const auto with_own = [&](auto& values, std::size_t t, std::size_t k) {
      auto value = values.values[values.of_triangle[t][k]];
      value[0] += random.between(0, variety) / 256.;
      values.of_triangle[t][k] = Index(values.values.size());
      values.values.push_back(value);
    };
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        Index& v = soup.triangles[t][k];
        if (!same_place(v, pole) || random.one_in(16))
          continue;
        if (is_in_uv && !soup.uvs.empty())
          with_own(soup.uvs, t, k);
        if (is_in_normal && !soup.normals.empty() && !soup.normals.missing)
          with_own(soup.normals, t, k);
        if (is_split && !random.one_in(variety)) {
          for (Attribute& attribute : soup.vertex_attributes) {
            const std::size_t size = row_size(attribute);
            const std::vector<unsigned char> row(attribute.rows.begin() + std::ptrdiff_t(v * size),
                                                 attribute.rows.begin() + std::ptrdiff_t((v + 1) * size));
            attribute.rows.insert(attribute.rows.end(), row.begin(), row.end());
          }
          soup.points.push_back(Point_3(soup.points[v]));
          v = Index(soup.points.size() - 1);
        }
      }
  }
}

void number_triangles(Triangle_soup& soup, Random& random)
{
  Attribute number{"material_index", Attribute::Type::uint8, 1, false, {}};
  const bool is_noise = random.one_in(4);
  const std::size_t beyond = random.below(soup.triangles.size() + 1);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    number.rows.push_back(static_cast<unsigned char>(is_noise ? random.below(3) : t < beyond));
  soup.triangle_attributes.push_back(std::move(number));
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
