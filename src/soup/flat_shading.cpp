// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "flat_shading.h"

#include "Gltf_scene.h"
#include "near_normals.h"
#include "poles.h"
#include "selection.h"
#include <selvedge/Cancellation_scope.h>
#include <selvedge/normals.h>
#include <selvedge/suited_normals.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>

// Joins the vertices of files that shade flat, for readers, and splits them again, for writers.

namespace selvedge {
namespace {

constexpr Index s_no_number = std::numeric_limits<Index>::max();

// Returns the number of each vertex at all of its corners, or the first of those that are alike,
// `s_no_number` for unused vertices; nothing when there are no numbers, or a vertex has several.
template <class Are_alike>
std::vector<Index> numbers_of_vertices(const Triangle_soup& soup,
                                       const std::vector<Index_triple>& of_triangle,
                                       const Are_alike& are_alike)
{
  if (of_triangle.empty())
    return {};
  std::vector<Index> numbers(soup.points.size(), s_no_number);
  for (std::size_t t = 0; t < of_triangle.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      Index& number = numbers[soup.triangles[t][k]];
      if (number == s_no_number)
        number = of_triangle[t][k];
      else if (!are_alike(number, of_triangle[t][k]))
        return {};
    }
  return numbers;
}

// Returns the number of the first of the normals of each vertex, if they are nearly alike: several are left
// at vertices that `share_split_vertices` has joined.
std::vector<Index> normals_of_vertices(const Triangle_soup& soup)
{
  return numbers_of_vertices(soup, soup.normals.of_triangle, [&](Index a, Index b) {
    return a == b || are_near_normals(soup.normals.values[a], soup.normals.values[b]);
  });
}

// Which of the vertices that differ in nothing but what goes with their normals become one.
enum class Sharing {
  flat,           // all, unless morph targets tell those with one normal apart
  near,           // those whose normals are nearly alike, unless tangents tell those with one normal apart
  loose,          // all
  without_normals // all, whatever the sides of their tangents
};

// What a vertex has, as bytes.
struct Vertex_bytes
{
  std::string normal, tangent, targets; // as in `Row_bytes`; the tangent with its side if that may differ
  std::string others;                   // must be alike

  bool is_same(const Vertex_bytes& other) const
  {
    return normal == other.normal && tangent == other.tangent && targets == other.targets;
  }
};

class Vertex_reader
{
public:
  Vertex_reader(const Triangle_soup& soup, const std::vector<Index>& normals, const std::vector<Index>& uvs,
                Sharing sharing)
      : m_soup(soup), m_normals(normals), m_uvs(uvs), m_sharing(sharing)
  {
  }

  Vertex_bytes operator()(Index vertex) const
  {
    Vertex_bytes result;
    std::string& bytes = result.others;
    const auto append = [](std::string& to, const auto& value) {
      to.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    append(result.normal, m_soup.normals.values[m_normals[vertex]]);
    const auto append_point = [&](const Point_3& point) {
      for (int i = 0; i < 3; ++i)
        append(bytes, m_sharing >= Sharing::loose && point[i] == 0 ? 0.0 : point[i]);
    };
    for (const Pose& pose : m_soup.poses)
      append_point(pose.points[vertex]);
    if (m_soup.scene) {
      const std::size_t number = m_soup.scene->instance_of(m_soup.scene_vertices[vertex]);
      const Gltf_scene::Instance& instance = m_soup.scene->instances[number];
      Row_bytes row =
          bytes_of_row(m_soup.scene->blocks[instance.block], m_soup.scene_vertices[vertex] - instance.first);
      append(bytes, number);
      bytes += row.others;
      (m_sharing == Sharing::without_normals ? row.tangent : bytes) += row.side;
      if (m_sharing == Sharing::near)
        bytes += row.targets;
      result.tangent = std::move(row.tangent);
      result.targets = std::move(row.targets);
      return result;
    }
    append_point(m_soup.points[vertex]);
    if (!m_uvs.empty())
      append(bytes, m_soup.uvs.values[m_uvs[vertex]]);
    for (const Attribute& attribute : m_soup.vertex_attributes) {
      const std::size_t size = row_size(attribute);
      bytes.append(reinterpret_cast<const char*>(attribute.rows.data()) + vertex * size, size);
    }
    return result;
  }

private:
  const Triangle_soup& m_soup;
  const std::vector<Index>& m_normals; // by vertex
  const std::vector<Index>& m_uvs;     // by vertex; empty where corners have them
  Sharing m_sharing;
};

// Makes triangles share vertices, of those that are asked; of all where `is_asked` is empty.
std::size_t share_vertices(Triangle_soup& soup, Sharing sharing, const std::vector<char>& is_asked = {})
{
  const std::equal_to<Index> are_equal;
  const std::vector<Index> normals = sharing == Sharing::flat
                                         ? numbers_of_vertices(soup, soup.normals.of_triangle, are_equal)
                                         : normals_of_vertices(soup);
  if (normals.empty())
    return 0;
  const std::size_t used =
      normals.size() - std::size_t(std::count(normals.begin(), normals.end(), s_no_number));
  const bool have_faces_own = have_faces_own_vertices(soup.triangles.size(), used);
  std::vector<Index> uvs;
  if (soup.scene || are_numbered_like_vertices(soup.uvs, soup))
    uvs = numbers_of_vertices(soup, soup.uvs.of_triangle, are_equal);
  const auto has_uv = [&](Index v) {
    return !uvs.empty() && uvs[v] != s_no_number && uvs[v] != soup.uvs.missing;
  };
  struct Shared_vertex
  {
    Index first;
    std::vector<Vertex_bytes> rows; // of the first vertex and, where there are morph targets, of all
  };
  const auto suits = [&](const Shared_vertex& shared, Index v, const Vertex_bytes& bytes) {
    if (sharing == Sharing::flat)
      return std::none_of(shared.rows.begin(), shared.rows.end(), [&](const Vertex_bytes& row) {
        return row.normal == bytes.normal && row.targets != bytes.targets;
      });
    const Vertex_bytes& first = shared.rows.front();
    return sharing != Sharing::near ||
           (are_near_normals(soup.normals.values[normals[shared.first]], soup.normals.values[normals[v]]) &&
            (first.normal != bytes.normal || first.tangent == bytes.tangent));
  };
  std::unordered_map<std::string, std::vector<Shared_vertex>> vertices; // by all other bytes
  std::vector<Index> first(soup.points.size(), s_no_number);
  std::vector<char> is_shared(soup.points.size(), false); // by first vertex
  bool do_tangents_differ = false;
  const Vertex_reader bytes_of(soup, normals, uvs, sharing);
  Cancellation_poll poll;
  for (Index v = 0; v < normals.size(); ++v) {
    poll();
    if (normals[v] == s_no_number)
      continue;
    if (!is_asked.empty() && !is_asked[v]) {
      first[v] = v;
      continue;
    }
    Vertex_bytes bytes = bytes_of(v);
    std::vector<Shared_vertex>& alike = vertices[std::exchange(bytes.others, {})];
    const auto found = std::find_if(alike.begin(), alike.end(),
                                    [&](const Shared_vertex& shared) { return suits(shared, v, bytes); });
    if (found == alike.end()) {
      first[v] = v;
      is_shared[v] = have_faces_own || has_uv(v);
      alike.push_back({v, {std::move(bytes)}});
      continue;
    }
    first[v] = found->first;
    is_shared[found->first] |= !found->rows.front().is_same(bytes);
    do_tangents_differ |= found->rows.front().tangent != bytes.tangent;
    if (!bytes.targets.empty())
      found->rows.push_back(std::move(bytes));
  }
  if (do_tangents_differ)
    leave_tangents_to_scene(soup);
  std::size_t joined = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      Index& v = soup.triangles[t][k];
      if (first[v] == v || !is_shared[first[v]])
        continue;
      v = first[v];
      if (!uvs.empty())
        soup.uvs.of_triangle[t][k] = uvs[v];
      ++joined;
    }
  return joined;
}

} // namespace

void leave_tangents_to_scene(Triangle_soup& soup)
{
  auto& attributes = soup.vertex_attributes;
  attributes.erase(std::remove_if(attributes.begin(), attributes.end(),
                                  [](const Attribute& attribute) { return attribute.name == "TANGENT"; }),
                   attributes.end());
}

std::size_t corners_changed(const std::vector<Index_triple>& before, const std::vector<Index_triple>& after)
{
  std::size_t result = 0;
  for (std::size_t t = 0; t < after.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      result += before[t][k] != after[t][k];
  return result;
}

bool have_faces_own_vertices(std::size_t triangles, std::size_t vertices)
{
  constexpr std::size_t few = 100;
  return triangles >= few && vertices >= 2 * triangles;
}

std::size_t share_split_vertices(Triangle_soup& soup)
{
  return share_vertices(soup, has_flat_normals(soup) ? Sharing::flat : Sharing::near);
}

std::size_t share_vertices_without_normals(Triangle_soup& soup, Normals_choice choice)
{
  const std::vector<Index_triple> before = soup.triangles;
  separate_poles(soup);
  const bool is_soft = choice == Normals_choice::soft;
  const std::vector<char> is_asked = is_soft ? are_on_soft_lines(soup) : std::vector<char>();
  const Sharing sharing = choice == Normals_choice::drop ? Sharing::without_normals : Sharing::loose;
  if ((is_soft && is_asked.empty()) || share_vertices(soup, sharing, is_asked) == 0) {
    soup.triangles = before;
    return 0;
  }
  share_poles(soup);
  return corners_changed(before, soup.triangles);
}

bool has_tangents_in_scene_only(const Triangle_soup& soup)
{
  const auto is_tangent = [](const auto& values) { return values.name == "TANGENT"; };
  const auto has_tangents = [&](const auto& list) {
    return std::any_of(list.begin(), list.end(), is_tangent);
  };
  return soup.scene && !has_tangents(soup.vertex_attributes) &&
         std::all_of(soup.scene->blocks.begin(), soup.scene->blocks.end(),
                     [&](const Gltf_scene::Block& block) { return has_tangents(block.attributes); });
}

Vertices_by_normal vertices_by_normal(const Triangle_soup& soup, const Corner_values<3>& normals)
{
  struct Entry
  {
    Vertices_by_normal::Vertex vertex;
    Index next; // of the same vertex
  };
  std::vector<Entry> entries;
  std::vector<Index> first(soup.points.size(), s_no_number);
  Vertices_by_normal result;
  result.triangles.resize(soup.triangles.size());
  std::size_t used = 0;
  Cancellation_poll poll;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      poll();
      const Index v = soup.triangles[t][k], normal = normals.empty() ? 0 : normals.of_triangle[t][k];
      used += first[v] == s_no_number;
      Index found = first[v];
      while (found != s_no_number && entries[found].vertex.normal != normal &&
             !have_same_bits(normals.values[entries[found].vertex.normal], normals.values[normal]))
        found = entries[found].next;
      if (found == s_no_number) {
        found = Index(entries.size());
        entries.push_back({{v, normal}, std::exchange(first[v], found)});
      }
      entries[found].vertex.normal = std::min(entries[found].vertex.normal, normal);
      result.triangles[t][k] = found;
    }
  std::vector<Index> order(entries.size()), place(entries.size());
  if (entries.size() == used) {
    auto next = order.begin();
    for (const Index entry : first)
      if (entry != s_no_number)
        *next++ = entry;
  } else {
    for (Index i = 0; i < order.size(); ++i)
      order[i] = i;
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      const auto key = [&](Index i) {
        return std::make_pair(entries[i].vertex.normal, entries[i].vertex.vertex);
      };
      return key(a) < key(b);
    });
  }
  for (Index i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    result.vertices.push_back(entries[order[i]].vertex);
  }
  for (Index_triple& triangle : result.triangles)
    for (Index& v : triangle)
      v = place[v];
  return result;
}

Triangle_soup split_by_normals(const Triangle_soup& soup)
{
  const Vertices_by_normal split = vertices_by_normal(soup, soup.normals);
  const bool are_uvs_split = are_numbered_like_vertices(soup.uvs, soup);
  Triangle_soup result = soup;
  result.points.clear();
  result.normals = {{}, split.triangles};
  if (are_uvs_split)
    result.uvs = {{}, split.triangles};
  for (Attribute& attribute : result.vertex_attributes)
    attribute.rows.clear();
  for (const auto& [vertex, normal] : split.vertices) {
    result.points.push_back(soup.points[vertex]);
    result.normals.values.push_back(soup.normals.values[normal]);
    if (are_uvs_split)
      result.uvs.values.push_back(soup.uvs.values[vertex]);
    for (std::size_t i = 0; i < result.vertex_attributes.size(); ++i)
      append_row(result.vertex_attributes[i].rows, soup.vertex_attributes[i], vertex);
  }
  result.triangles = split.triangles;
  return result;
}

} // namespace selvedge
