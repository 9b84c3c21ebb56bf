// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "poles.h"

#include "Disjoint_sets.h"
#include "Gltf_scene.h"
#include "flat_shading.h"
#include "gltf_transforms.h"
#include "number_positions.h"
#include "selection.h"
#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace selvedge {
namespace {

using Column = Gltf_scene::Column;

// A vertex of a scene: a row of a block.
struct Row
{
  std::size_t instance;
  const Gltf_scene::Block* block;
  Index number;
};

Row row_of(const Gltf_scene& scene, Index scene_vertex)
{
  const std::size_t instance = scene.instance_of(scene_vertex);
  return {instance, &scene.blocks[scene.instances[instance].block],
          scene_vertex - scene.instances[instance].first};
}

const Column* uvs_of(const Gltf_scene::Block& block)
{
  for (const Column& column : block.attributes)
    if (column.name == "TEXCOORD_0" && column.components == 2)
      return &column;
  return nullptr;
}

// What must be alike at a pole, as bytes.
std::string bytes_apart_from_uvs(const Row& row)
{
  std::string result;
  const auto append = [&](const std::vector<Column>& columns) {
    for (const Column& column : columns)
      if (column.name != "TEXCOORD_0" && column.name != "NORMAL" && column.name != "TANGENT")
        result += column.row(row.number);
  };
  append(row.block->attributes);
  std::for_each(row.block->targets.begin(), row.block->targets.end(), append);
  return result;
}

using Place = std::pair<std::size_t, std::string_view>; // of all rows at one position in one instance

Place place_of(const Row& row)
{
  return {row.instance, row.block->attributes.front().row(row.number)};
}

// Calls a function with each row of the scene that is at one of these places, and its place in the map.
template <class Value, class Function>
void for_each_row_at(std::map<Place, Value>& places, const Gltf_scene& scene, const Function& function)
{
  for (std::size_t i = 0; i < scene.instances.size() && !places.empty(); ++i) {
    const Gltf_scene::Block& block = scene.blocks[scene.instances[i].block];
    for (Index number = 0; number < block.size; ++number) {
      const Row row{i, &block, number};
      if (const auto found = places.find(place_of(row)); found != places.end())
        function(row, found->second);
    }
  }
}

std::optional<std::array<double, 2>> uv_of(const Row& row)
{
  const Column* const column = uvs_of(*row.block);
  return column ? std::optional(texture_coordinates(*column, row.number)) : std::nullopt;
}

/// Finds the poles of a soup, and joins their vertices.
class Poles
{
public:
  explicit Poles(Triangle_soup& soup) : m_soup(soup) { find_positions(); }

  std::size_t join()
  {
    const std::vector<Spoke> spokes = with_known_rows(find_spokes());
    std::vector<Index> counts(m_positions.size(), 0);
    for (const Spoke& spoke : spokes)
      ++counts[spoke.position];
    internal::Disjoint_sets sets(m_soup.points.size());
    for (const Spoke& spoke : spokes)
      if (counts[spoke.position] >= s_least_spokes)
        sets.unite(spoke.vertices[0], spoke.vertices[1]);
    std::size_t joined = 0;
    bool do_tangents_differ = false;
    for (Index_triple& triangle : m_soup.triangles)
      for (Index& v : triangle)
        if (const Index first = Index(sets.find(v)); first != v) {
          do_tangents_differ |= tangent(v) != tangent(first);
          v = first;
          ++joined;
        }
    if (do_tangents_differ)
      leave_tangents_to_scene(m_soup);
    return joined;
  }

private:
  // At a pole, as a reduction wants them. It may leave two; but where there are two, they may as well be what
  // is left of a cut into the texture, which is a border of the piece.
  static constexpr Index s_least_spokes = 3;

  // An edge across which texture coordinates differ at one end.
  struct Spoke
  {
    Index position;                // of this end
    std::array<Index, 2> vertices; // at it, of the two faces
  };

  // One of the two sides of an edge, seen from an end at a position where texture coordinates differ.
  struct Side
  {
    Index other_end, position;
    bool is_out; // whether the side runs to the other end
    Index triangle;
    unsigned char corner; // of the triangle, at the position

    std::size_t other_corner() const { return (corner + (is_out ? 1u : 2u)) % 3; }
    bool is_same_edge(const Side& other) const
    {
      return other_end == other.other_end && position == other.position;
    }
    bool operator<(const Side& other) const
    {
      const auto key = [](const Side& s) {
        return std::make_tuple(s.other_end, s.position, s.is_out, s.triangle);
      };
      return key(*this) < key(other);
    }
  };

  // Numbers the positions of vertices at which something differs: those of several texture coordinates, and
  // those that the faces at them do not go around, so that there may be further ones. These are few, and
  // they are found in less time than positions are numbered. Other vertices get a number of their own.
  void find_positions()
  {
    constexpr Index none = std::numeric_limits<Index>::max();
    std::vector<Index> uv_of(m_soup.points.size(), none); // by vertex, its number
    // Where faces go around a vertex, each neighbour comes once as the next and once as the one before.
    std::vector<std::uint64_t> sums(m_soup.points.size(), 0);
    std::vector<char> is_wanted(m_soup.points.size(), false);
    Cancellation_poll poll;
    for (std::size_t t = 0; t < m_soup.triangles.size(); ++t) {
      poll();
      const Index_triple& triangle = m_soup.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const Index v = triangle[k], number = m_soup.uvs.of_triangle[t][k];
        sums[v] += mixed(triangle[(k + 1) % 3]) - mixed(triangle[(k + 2) % 3]);
        is_wanted[v] |= uv_of[v] != none && uv_of[v] != number;
        uv_of[v] = number;
      }
    }
    std::vector<Index> wanted;
    std::vector<Point_3> points;
    m_positions.resize(m_soup.points.size());
    for (Index v = 0; v < m_positions.size(); ++v) {
      m_positions[v] = v;
      if (!is_wanted[v] && sums[v] == 0)
        continue;
      wanted.push_back(v);
      points.push_back(m_soup.points[v]);
    }
    const std::vector<Index> numbers = number_positions(points);
    for (std::size_t i = 0; i < wanted.size(); ++i)
      m_positions[wanted[i]] = wanted[numbers[i]];
  }

  // Spreads numbers over 64 bits (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014),
  // so that sums of different ones are different.
  static std::uint64_t mixed(std::uint64_t number)
  {
    number = (number + 1) * 0x9e3779b97f4a7c15;
    number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9;
    number = (number ^ (number >> 27)) * 0x94d049bb133111eb;
    return number ^ (number >> 31);
  }

  const std::array<double, 2>& uv(Index triangle, std::size_t corner) const
  {
    return m_soup.uvs.values[m_soup.uvs.of_triangle[triangle][corner]];
  }

  std::vector<Side> sorted_sides() const
  {
    constexpr Index none = std::numeric_limits<Index>::max();
    std::vector<Index> number_at(m_positions.size(), none); // of texture coordinates, by position
    std::vector<char> has_several(m_positions.size(), false);
    for (std::size_t t = 0; t < m_soup.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const Index position = m_positions[m_soup.triangles[t][k]], number = m_soup.uvs.of_triangle[t][k];
        has_several[position] |= number_at[position] != none && number_at[position] != number;
        number_at[position] = number;
      }
    std::vector<Side> sides;
    Cancellation_poll poll;
    for (Index t = 0; t < m_soup.triangles.size(); ++t)
      for (unsigned char k = 0; k < 3; ++k) {
        poll();
        const Index_triple& triangle = m_soup.triangles[t];
        const Index position = m_positions[triangle[k]];
        if (!has_several[position])
          continue;
        sides.push_back({triangle[(k + 1) % 3], position, true, t, k});
        sides.push_back({triangle[(k + 2) % 3], position, false, t, k});
      }
    std::sort(sides.begin(), sides.end());
    return sides;
  }

  std::vector<Spoke> find_spokes() const
  {
    const std::vector<Side> sides = sorted_sides();
    std::vector<Spoke> result;
    for (std::size_t first = 0, beyond; first < sides.size(); first = beyond) {
      beyond = first + 1;
      while (beyond < sides.size() && sides[beyond].is_same_edge(sides[first]))
        ++beyond;
      const Side &in = sides[first], &out = sides[beyond - 1];
      if (beyond - first != 2 || in.is_out || !out.is_out ||
          have_same_bits(uv(in.triangle, in.corner), uv(out.triangle, out.corner)) ||
          !have_same_bits(uv(in.triangle, in.other_corner()), uv(out.triangle, out.other_corner())))
        continue;
      const Index a = m_soup.triangles[in.triangle][in.corner],
                  b = m_soup.triangles[out.triangle][out.corner];
      if (are_alike(a, b))
        result.push_back({in.position, {a, b}});
    }
    return result;
  }

  // Leaves out spokes of vertices whose row could not be told from another one by what corners keep of it:
  // such as one with another tangent, or with another of the numbers that give one texture coordinate.
  std::vector<Spoke> with_known_rows(std::vector<Spoke> spokes) const
  {
    struct Rows_known
    {
      std::map<std::string, std::string> rest; // by what corners keep
      std::set<std::string> unknown;
    };
    std::map<Place, Rows_known> places;
    const auto row = [this](Index vertex) { return row_of(*m_soup.scene, m_soup.scene_vertices[vertex]); };
    for (const Spoke& spoke : spokes)
      places[place_of(row(spoke.vertices[0]))];
    for_each_row_at(places, *m_soup.scene, [](const Row& at, Rows_known& rows) {
      const std::string kept = kept_by_corners(at);
      const auto [found, is_new] = rows.rest.try_emplace(kept, left_to_row(at));
      if (!is_new && found->second != left_to_row(at))
        rows.unknown.insert(kept);
    });
    const auto is_unknown = [&](Index vertex) {
      const Row of_vertex = row(vertex);
      const std::set<std::string>& unknown = places.at(place_of(of_vertex)).unknown;
      return !unknown.empty() && unknown.count(kept_by_corners(of_vertex)) > 0;
    };
    spokes.erase(std::remove_if(spokes.begin(), spokes.end(),
                                [&](const Spoke& spoke) {
                                  return is_unknown(spoke.vertices[0]) || is_unknown(spoke.vertices[1]);
                                }),
                 spokes.end());
    return spokes;
  }

  static std::string kept_by_corners(const Row& row)
  {
    std::string result = bytes_apart_from_uvs(row);
    if (const Column* const normals = row.block->normals())
      result += normals->row(row.number);
    if (const auto uv = uv_of(row))
      result.append(reinterpret_cast<const char*>(uv->data()), sizeof *uv);
    return result;
  }

  static std::string left_to_row(const Row& row)
  {
    std::string result;
    for (const Column* const column : {uvs_of(*row.block), row.block->tangents()})
      if (column)
        result += column->row(row.number);
    for (const std::vector<Column>& target : row.block->targets)
      for (const Column& column : target)
        result += column.row(row.number);
    return result;
  }

  bool are_alike(Index a, Index b) const
  {
    if (a == b)
      return true;
    const Row row = row_of(*m_soup.scene, m_soup.scene_vertices[a]);
    const Row other = row_of(*m_soup.scene, m_soup.scene_vertices[b]);
    return row.instance == other.instance && bytes_apart_from_uvs(row) == bytes_apart_from_uvs(other);
  }

  std::string_view tangent(Index vertex) const
  {
    const Row row = row_of(*m_soup.scene, m_soup.scene_vertices[vertex]);
    const Column* const column = row.block->tangents();
    return column ? column->row(row.number) : std::string_view();
  }

  Triangle_soup& m_soup;
  std::vector<Index> m_positions; // by vertex
};

// The rows of the scene that corners at poles have.
class Pole_rows
{
public:
  explicit Pole_rows(const Triangle_soup& soup) : m_soup(soup), m_scene(*soup.scene)
  {
    find_corners();
    find_rows();
  }

  std::map<Index, Index> scene_vertices() const
  {
    std::map<Index, Index> result;
    for (const Index corner : m_corners)
      if (const std::optional<Index> found = scene_vertex(corner); found && *found != own(corner))
        result.emplace(corner, *found);
    return result;
  }

private:
  Index own(Index corner) const { return m_soup.scene_vertices[m_soup.triangles[corner / 3][corner % 3]]; }
  const std::array<double, 2>& uv(Index corner) const
  {
    return m_soup.uvs.values[m_soup.uvs.of_triangle[corner / 3][corner % 3]];
  }

  // Finds the corners of vertices that have several texture coordinates, or others than their rows.
  void find_corners()
  {
    constexpr Index none = std::numeric_limits<Index>::max();
    std::vector<Index> first(m_soup.points.size(), none); // corner of each vertex
    std::vector<char> is_at_pole(m_soup.points.size(), false);
    Cancellation_poll poll;
    const auto for_each_corner = [&](const auto& function) {
      for (Index t = 0; t < m_soup.triangles.size(); ++t)
        for (Index k = 0; k < 3; ++k) {
          poll();
          if (m_soup.uvs.of_triangle[t][k] != m_soup.uvs.missing)
            function(m_soup.triangles[t][k], 3 * t + k);
        }
    };
    for_each_corner([&](Index v, Index corner) {
      if (first[v] == none) {
        first[v] = corner;
        const auto of_row = uv_of(row_of(m_scene, own(corner)));
        is_at_pole[v] = of_row && !have_same_bits(*of_row, uv(corner));
      } else {
        is_at_pole[v] |= !have_same_bits(uv(first[v]), uv(corner));
      }
    });
    for_each_corner([&](Index v, Index corner) {
      if (is_at_pole[v])
        m_corners.push_back(corner);
    });
  }

  void find_rows()
  {
    for (const Index corner : m_corners)
      m_rows[place_of(row_of(m_scene, own(corner)))];
    for_each_row_at(m_rows, m_scene, [](const Row& row, std::vector<Row>& rows) { rows.push_back(row); });
  }

  bool has_normal_of(Index corner, const Row& row) const
  {
    const Column* const normals = row.block->normals();
    return !normals || m_soup.normals.empty() ||
           have_same_bits(world_normal(m_scene.instances[row.instance], *normals, row.number),
                          m_soup.normals.values[m_soup.normals.of_triangle[corner / 3][corner % 3]]);
  }

  // Of the rows that have the texture coordinates of a corner, returns the one that also has its normal, or
  // that of its vertex, or the first.
  std::optional<Index> scene_vertex(Index corner) const
  {
    const Row of_vertex = row_of(m_scene, own(corner));
    const std::string bytes = bytes_apart_from_uvs(of_vertex);
    std::optional<Index> result;
    for (const Row& row : m_rows.at(place_of(of_vertex))) {
      const auto of_row = uv_of(row);
      if (!of_row || !have_same_bits(*of_row, uv(corner)) || bytes_apart_from_uvs(row) != bytes)
        continue;
      const Index scene_vertex = m_scene.instances[row.instance].first + row.number;
      if (has_normal_of(corner, row))
        return scene_vertex;
      if (!result || scene_vertex == own(corner))
        result = scene_vertex;
    }
    return result;
  }

  const Triangle_soup& m_soup;
  const Gltf_scene& m_scene;
  std::vector<Index> m_corners;
  std::map<Place, std::vector<Row>> m_rows;
};

} // namespace

std::size_t share_poles(Triangle_soup& soup)
{
  if (!soup.scene || soup.uvs.empty() || !soup.poses.empty())
    return 0;
  return Poles(soup).join();
}

std::map<Index, Index> scene_vertices_of_corners(const Triangle_soup& soup)
{
  if (!soup.scene || soup.uvs.empty())
    return {};
  return Pole_rows(soup).scene_vertices();
}

void separate_poles(Triangle_soup& soup)
{
  const std::map<Index, Index> scene_vertices = scene_vertices_of_corners(soup);
  if (scene_vertices.empty())
    return;
  std::unordered_map<Index, Index> numbers; // by vertex of the scene, the first vertex of the soup
  for (Index v = 0; v < soup.scene_vertices.size(); ++v)
    numbers.emplace(soup.scene_vertices[v], v);
  for (const auto& [corner, scene_vertex] : scene_vertices)
    if (const auto found = numbers.find(scene_vertex); found != numbers.end())
      soup.triangles[corner / 3][corner % 3] = found->second;
}

std::optional<Triangle_soup> with_split_poles(const Triangle_soup& soup)
{
  const std::map<Index, Index> scene_vertices = scene_vertices_of_corners(soup);
  if (scene_vertices.empty())
    return std::nullopt;
  Triangle_soup result = soup;
  std::map<std::pair<Index, Index>, Index> added; // by vertex, and that of the scene
  for (const auto& [corner, scene_vertex] : scene_vertices) {
    Index& v = result.triangles[corner / 3][corner % 3];
    const auto [number, is_new] = added.try_emplace({v, scene_vertex}, Index(result.points.size()));
    if (is_new) {
      result.points.push_back(soup.points[v]);
      for (std::size_t i = 0; i < soup.poses.size(); ++i)
        result.poses[i].points.push_back(soup.poses[i].points[v]);
      for (std::size_t i = 0; i < soup.vertex_attributes.size(); ++i)
        append_row(result.vertex_attributes[i].rows, soup.vertex_attributes[i], v);
      result.scene_vertices.push_back(scene_vertex);
    }
    v = number->second;
  }
  return result;
}

std::optional<Triangle_soup> with_uvs_of_vertices(const Triangle_soup& soup)
{
  std::optional<Triangle_soup> result = with_split_poles(soup);
  if (!result || soup.uvs.missing)
    return std::nullopt;
  std::vector<char> is_known(result->points.size(), false);
  std::vector<std::array<double, 2>> uvs(result->points.size(), {0, 0}); // of vertices
  for (std::size_t t = 0; t < result->triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = result->triangles[t][k];
      const std::array<double, 2>& uv = soup.uvs.values[soup.uvs.of_triangle[t][k]];
      if (std::exchange(is_known[v], true) && !have_same_bits(uvs[v], uv))
        return std::nullopt;
      uvs[v] = uv;
    }
  result->uvs = {std::move(uvs), result->triangles};
  return result;
}

} // namespace selvedge
