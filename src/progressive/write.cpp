// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "progressive/lists.h"

#include "files/Local_normals.h"
#include "files/formats.h"
#include "soup/Gltf_scene.h"
#include "soup/gltf_transforms.h"
#include "soup/poles.h"

#include <selvedge/Error.h>
#include <selvedge/rounding.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace selvedge {
namespace {

using Json = Gltf_scene::Json;

/// What becomes of the wedges of a progression.
struct Fates
{
  std::vector<Index> goals; ///< by wedge: where it goes, or itself
  std::vector<Index> steps; ///< by wedge, as in `Progressive_mesh`
  std::vector<Index> faces; ///< before the first step and after each
};

// Goes through all steps, with the triangles at each wedge.
Fates fates(const Progression& progression)
{
  std::vector<Index_triple> now = progression.wedges; // of triangles; of those that are gone, two are equal
  Index count = 0;
  for (const Index_triple& wedges : now)
    count = std::max({count, wedges[0] + 1, wedges[1] + 1, wedges[2] + 1});
  std::vector<std::vector<Index>> triangles(count); // by wedge, with some that are gone
  std::vector<std::size_t> uses(count, 0);
  for (Index t = 0; t < now.size(); ++t)
    for (const Index wedge : now[t]) {
      triangles[wedge].push_back(t);
      ++uses[wedge];
    }
  const auto is_gone = [&](Index t) {
    return now[t][0] == now[t][1] || now[t][1] == now[t][2] || now[t][2] == now[t][0];
  };
  Fates result = {
      std::vector<Index>(count), std::vector<Index>(count, Progressive_mesh::never), {Index(now.size())}};
  std::iota(result.goals.begin(), result.goals.end(), Index(0));
  std::size_t move = 0;
  Index left = Index(now.size());
  for (std::size_t step = 0; step < progression.steps.size(); ++step) {
    std::vector<Index> perhaps_unused;
    for (; move < progression.steps[step]; ++move) {
      const auto [from, to] = progression.moves[move];
      result.goals[from] = to;
      perhaps_unused.push_back(from);
      uses[from] = 0;
      for (const Index t : std::exchange(triangles[from], {})) {
        if (is_gone(t))
          continue;
        std::replace(now[t].begin(), now[t].end(), from, to);
        if (is_gone(t)) {
          --left;
          const Index third =
              *std::find_if(now[t].begin(), now[t].end(), [to = to](Index wedge) { return wedge != to; });
          for (const Index wedge : {to, third}) {
            --uses[wedge];
            perhaps_unused.push_back(wedge);
          }
        } else {
          ++uses[to];
          triangles[to].push_back(t);
        }
      }
    }
    for (const Index wedge : perhaps_unused)
      if (uses[wedge] == 0)
        result.steps[wedge] = Index(step + 1);
    result.faces.push_back(left);
  }
  return result;
}

// Appends bytes as a buffer view and an accessor that only the lists name. Returns the number of the
// accessor.
std::size_t add_accessor(Gltf_scene& scene, std::string bytes, int component_type, const char* type,
                         std::size_t count)
{
  Json& views = scene.document["bufferViews"];
  views.push_back({{"buffer", 0}, {"byteOffset", 0}, {"byteLength", bytes.size()}});
  const std::size_t view = views.size() - 1;
  scene.views.resize(view);
  scene.views.push_back(std::move(bytes));
  Json& accessors = scene.document["accessors"];
  accessors.push_back(
      {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
  return accessors.size() - 1;
}

std::size_t add_numbers(Gltf_scene& scene, const std::vector<Index>& numbers)
{
  std::string bytes;
  for (const Index number : numbers)
    append_little_endian(bytes, number);
  return add_accessor(scene, std::move(bytes), type_uint32, "SCALAR", numbers.size());
}

/// Makes the soup that is written of one that was reduced: a vertex for each wedge, in the order in which
/// they go.
class Progressive_scene
{
public:
  Progressive_scene(const Triangle_soup& soup, const Progression& progression, const Progressive_notes& notes)
      : m_soup(soup), m_progression(progression), m_notes(notes),
        m_in_scene(soup.scene ? Triangle_soup() : files::with_gltf_scene(soup)), m_fates(fates(progression)),
        m_scene(std::make_shared<Gltf_scene>(*scene_soup().scene))
  {
  }

  Progressive_mesh make()
  {
    order_wedges();
    put_vertices();
    put_blocks();
    put_normals();
    put_poses();
    m_result.faces = m_fates.faces;
    m_result.fixed_faces = m_notes.fixed_faces;
    m_result.soup.scene = m_scene;
    put_lists();
    return std::move(m_result);
  }

private:
  const Triangle_soup& scene_soup() const { return m_soup.scene ? m_soup : m_in_scene; }

  std::size_t instance_of(Index wedge) const
  {
    return m_scene->instance_of(scene_soup().scene_vertices[vertex_in_scene(wedge)]);
  }
  Index vertex_in_scene(Index wedge) const
  {
    return scene_soup().triangles[m_corners[wedge] / 3][m_corners[wedge] % 3];
  }

  // Sorts the wedges by vertex buffer and, in each, from the last that goes to the first. Of those that go in
  // one step, the ones that end without a motion come first: others may go to them.
  void order_wedges()
  {
    m_corners.resize(m_fates.goals.size());
    for (Index t = 0; t < m_progression.wedges.size(); ++t)
      for (Index k = 0; k < 3; ++k)
        m_corners[m_progression.wedges[t][k]] = 3 * t + k;
    std::vector<std::size_t> instances;
    for (Index wedge = 0; wedge < m_corners.size(); ++wedge)
      instances.push_back(instance_of(wedge));
    m_order.resize(m_corners.size());
    std::iota(m_order.begin(), m_order.end(), Index(0));
    const auto key = [&](Index wedge) {
      return std::make_tuple(instances[wedge], ~m_fates.steps[wedge], m_fates.goals[wedge] != wedge,
                             vertex_in_scene(wedge), wedge);
    };
    std::sort(m_order.begin(), m_order.end(), [&](Index a, Index b) { return key(a) < key(b); });
    m_numbers.resize(m_order.size());
    for (Index v = 0; v < m_order.size(); ++v)
      m_numbers[m_order[v]] = v;
  }

  void put_vertices()
  {
    Triangle_soup& soup = m_result.soup;
    for (const Index wedge : m_order) {
      soup.points.push_back(scene_soup().points[vertex_in_scene(wedge)]);
      m_result.merges_into.push_back(m_numbers[m_fates.goals[wedge]]);
      m_result.steps.push_back(m_fates.steps[wedge]);
      if (m_result.merges_into.back() > m_numbers[wedge])
        throw std::logic_error("a wedge goes to one that is gone");
    }
    for (const Index_triple& wedges : m_progression.wedges)
      soup.triangles.push_back({m_numbers[wedges[0]], m_numbers[wedges[1]], m_numbers[wedges[2]]});
    soup.groups = scene_soup().groups;
    soup.scene_vertices.resize(soup.points.size());
    std::iota(soup.scene_vertices.begin(), soup.scene_vertices.end(), Index(0));
  }

  // Returns the normal of a wedge of a scene. It need not be that of its row: vertices that differ in their
  // normals alone have become one.
  std::optional<std::array<double, 3>> normal_at(Index wedge) const
  {
    if (!m_soup.scene || m_soup.normals.empty())
      return std::nullopt;
    const Index number = m_soup.normals.of_triangle[m_corners[wedge] / 3][m_corners[wedge] % 3];
    return number == m_soup.normals.missing ? std::nullopt : std::optional(m_soup.normals.values[number]);
  }

  // Gives every instance a block of its own, with the rows of its wedges. They are written plain, each
  // accessor in a buffer view of its own: compressors may put vertices into another order.
  void put_blocks()
  {
    const Gltf_scene& before = *scene_soup().scene;
    files::Local_normals local_normals(before);
    std::vector<Gltf_scene::Block> blocks;
    Index v = 0;
    for (std::size_t i = 0; i < before.instances.size(); ++i) {
      const Gltf_scene::Instance& instance = before.instances[i];
      std::vector<std::size_t> rows;
      const Index first = v;
      for (; v < m_order.size() && instance_of(m_order[v]) == i; ++v)
        rows.push_back(scene_soup().scene_vertices[vertex_in_scene(m_order[v])] - instance.first);
      Gltf_scene::Block& block = blocks.emplace_back(before.blocks[instance.block]);
      block.size = Index(rows.size());
      const bool has_normals = before.blocks[instance.block].normals();
      const auto select = [&](Gltf_scene::Column& column, bool is_of_target) {
        const bool is_of_normals = has_normals && (column.name == "NORMAL" || column.name == "TANGENT");
        std::string selected;
        for (std::size_t k = 0; k < rows.size(); ++k)
          if (const auto normal = is_of_normals ? normal_at(m_order[first + k]) : std::nullopt)
            selected +=
                local_normals.bytes_of(column, is_of_target, Index(instance.first + rows[k]), *normal);
          else
            selected += column.row(rows[k]);
        column.rows = std::move(selected);
        column.compression.reset();
        column.place.reset();
      };
      for (Gltf_scene::Column& column : block.attributes)
        select(column, false);
      for (std::vector<Gltf_scene::Column>& target : block.targets)
        for (Gltf_scene::Column& column : target)
          select(column, true);
      m_firsts.push_back(first);
    }
    for (std::size_t i = 0; i < m_firsts.size(); ++i) {
      m_scene->instances[i].block = Index(i);
      m_scene->instances[i].first = m_firsts[i];
    }
    m_scene->blocks = std::move(blocks);
    for (Gltf_scene::Part& part : m_scene->parts)
      part.index_place.reset();
    m_scene->meshopt_views.clear();
    for (Gltf_scene::Part& part : m_scene->parts) // there may be more vertices than its indices can count
      part.index_type = 0;
  }

  // Every vertex has the normal of its row, where the soup has one.
  void put_normals()
  {
    Corner_values<3>& normals = m_result.soup.normals;
    constexpr double beyond = std::numeric_limits<double>::max(); // unlike all normals
    bool are_missing = false, are_there = false;
    for (Index v = 0; v < m_order.size(); ++v) {
      std::array<double, 3> normal = {beyond, beyond, beyond};
      const std::size_t instance = m_scene->instance_of(v);
      const Gltf_scene::Column* const column = m_scene->blocks[instance].normals();
      if (column && (!m_soup.scene || normal_at(m_order[v])))
        normal = world_normal(m_scene->instances[instance], *column, v - m_firsts[instance]);
      (normal[0] == beyond ? are_missing : are_there) = true;
      normals.values.push_back(normal);
    }
    if (!are_there) {
      normals = {};
      return;
    }
    normals.of_triangle = m_result.soup.triangles;
    if (!are_missing)
      return;
    // One value stands for none.
    normals.missing = Index(normals.values.size());
    normals.values.push_back({beyond, beyond, beyond});
    for (Index_triple& of_triangle : normals.of_triangle)
      if (normals.values[of_triangle[0]][0] == beyond)
        of_triangle = {*normals.missing, *normals.missing, *normals.missing};
  }

  void put_poses()
  {
    if (!m_notes.are_poses_written || !poses_not_carried(m_soup, m_notes).empty())
      return;
    for (const Pose& pose : m_soup.poses) {
      m_result.soup.poses.push_back({pose.name, {}, pose.time});
      for (const Index wedge : m_order)
        m_result.soup.poses.back().points.push_back(
            pose.points[m_soup.triangles[m_corners[wedge] / 3][m_corners[wedge] % 3]]);
    }
    m_result.is_pose_guarded.assign(m_result.soup.poses.size(), false);
    for (const std::size_t pose : m_notes.guarded_poses)
      if (pose < m_result.is_pose_guarded.size())
        m_result.is_pose_guarded[pose] = true;
  }

  void put_lists()
  {
    Gltf_scene& scene = *m_scene;
    Json poses = Json::array();
    for (std::size_t i = 0; i < m_result.soup.poses.size(); ++i)
      poses.push_back({{"name", m_result.soup.poses[i].name}, {"judged", m_result.is_pose_guarded[i] != 0}});
    Json lists = {{"version", progressive::version},
                  {"steps", m_result.step_count()},
                  {"faces", add_numbers(scene, m_result.faces)},
                  {"fixed_faces", m_result.fixed_faces},
                  {"poses", std::move(poses)},
                  {"levels", Json::array()},
                  {"sha256", progressive::digest_of(m_result)}};
    const auto put = [](Json& element, Json value) {
      Json& extras = element["extras"];
      if (!extras.is_null() && !extras.is_object())
        throw Argument_error(
            "the extras of the glTF document or of one of its primitives are no object, so that "
            "nothing can be added to them; remove them");
      extras[progressive_extras] = std::move(value);
    };
    std::vector<std::vector<Json>> levels; // by level and primitive: the number of an accessor
    for (const std::size_t faces : m_notes.levels) {
      const std::size_t step = steps_to_faces(m_result, faces);
      lists["levels"].push_back({{"step", step}, {"faces", m_result.faces[step]}});
      levels.push_back(add_level(step));
    }
    put(scene.document, std::move(lists));
    std::vector<Json> of_instance(scene.instances.size());
    for (const Gltf_scene::Part& part : scene.parts) {
      const Index size = scene.blocks[part.instance].size;
      if (size == 0)
        continue;
      Json& of_buffer = of_instance[part.instance];
      if (of_buffer.is_null())
        of_buffer = lists_of_buffer(m_firsts[part.instance], size);
      Json of_primitive = of_buffer;
      for (const std::vector<Json>& level : levels)
        of_primitive["levels"].push_back(level[&part - scene.parts.data()]);
      put(scene.document["meshes"][part.mesh]["primitives"][part.primitive], std::move(of_primitive));
    }
  }

  // Adds the triangles after some steps to each primitive; null stands for none.
  std::vector<Json> add_level(std::size_t steps)
  {
    const std::vector<Index> now = progressive::vertices_after(m_result, steps);
    std::vector<std::vector<Index>> corners(m_scene->parts.size());
    for (std::size_t t = 0; t < m_result.soup.triangles.size(); ++t) {
      const Index part = m_result.soup.groups.of_triangle[t];
      const std::size_t instance = m_scene->parts[part].instance;
      auto [a, b, c] = m_result.soup.triangles[t];
      a = now[a], b = now[b], c = now[c];
      if (a == b || b == c || c == a)
        continue;
      if (m_scene->instances[instance].is_mirrored) // as in its node
        std::swap(b, c);
      for (const Index v : {a, b, c})
        corners[part].push_back(v - m_firsts[instance]);
    }
    std::vector<Json> result;
    for (std::size_t part = 0; part < corners.size(); ++part) {
      const bool are_short = m_scene->blocks[m_scene->parts[part].instance].size < 0xffff;
      std::string bytes;
      for (const Index corner : corners[part])
        if (are_short)
          append_little_endian(bytes, std::uint16_t(corner));
        else
          append_little_endian(bytes, corner);
      result.emplace_back();
      if (!bytes.empty())
        result.back() = add_accessor(*m_scene, std::move(bytes), are_short ? type_uint16 : type_uint32,
                                     "SCALAR", corners[part].size());
    }
    return result;
  }

  Json lists_of_buffer(Index first, Index size)
  {
    const auto at = [first](auto& column) { return column.begin() + first; };
    std::vector<Index> merges(at(m_result.merges_into), at(m_result.merges_into) + size);
    for (Index& vertex : merges)
      vertex -= first;
    Json result = {{"merges_into", add_numbers(*m_scene, merges)},
                   {"steps", add_numbers(*m_scene, {at(m_result.steps), at(m_result.steps) + size})}};
    for (const Pose& pose : m_result.soup.poses) {
      std::string bytes;
      for (Index v = first; v < first + size; ++v)
        for (int axis = 0; axis < 3; ++axis)
          append_little_endian(bytes, float(pose.points[v][axis]));
      result["poses"].push_back(add_accessor(*m_scene, std::move(bytes), type_float32, "VEC3", size));
    }
    return result;
  }

  const Triangle_soup& m_soup;
  const Progression& m_progression;
  const Progressive_notes& m_notes;
  Triangle_soup m_in_scene; // the soup with a new scene, if it has none
  Fates m_fates;
  std::shared_ptr<Gltf_scene> m_scene;
  Progressive_mesh m_result;
  std::vector<Index> m_corners; // by wedge: one of its corners
  std::vector<Index> m_order;   // wedges in the order of the vertices
  std::vector<Index> m_numbers; // by wedge: its vertex
  std::vector<Index> m_firsts;  // by instance: its first vertex
};

} // namespace

std::string poses_not_carried(const Triangle_soup& soup, const Progressive_notes& notes)
{
  const bool are_carried = !notes.are_poses_written ||
                           std::all_of(soup.poses.begin(), soup.poses.end(),
                                       [](const Pose& pose) { return has_float32_points(pose.points); });
  return are_carried ? "" : "poses, whose coordinates are no 32-bit floats";
}

void write_progressive(const std::filesystem::path& path, const Triangle_soup& soup,
                       const Progression& progression, const Progressive_notes& notes)
{
  const Mesh_format format = mesh_format(path);
  if (format != Mesh_format::glb && format != Mesh_format::gltf)
    throw Argument_error("a progressive file is a glTF file; choose a name that ends in .glb");
  if (progression.wedges.size() != soup.triangles.size() || soup.triangles.empty())
    throw Argument_error("the progression is not that of the soup");
  if (needs_float32(soup, format) && !has_float32_points(soup))
    throw Argument_error("the soup has coordinates that are no 32-bit floats; call round_to_float32 first");
  const std::optional<Triangle_soup> split = with_split_poles(soup);
  write_mesh(path, Progressive_scene(split ? *split : soup, progression, notes).make().soup);
}

} // namespace selvedge
