// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/inspect.h>

#include "soup/Gltf_scene.h"
#include "soup/Sewn_mesh.h"
#include "soup/flat_shading.h"
#include "soup/number_positions.h"
#include "soup/selection.h"
#include "surface_distances.h"
#include "verify/Diagonal.h"
#include "verify/pieces.h"

#include <selvedge/prepare.h>
#include <selvedge/suited_normals.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace selvedge {
namespace {

std::vector<std::string> names_in_use(const Triangle_labels& labels)
{
  std::vector<char> is_used(labels.names.size(), false);
  for (const Index label : labels.of_triangle)
    is_used[label] = true;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < is_used.size(); ++i)
    if (is_used[i] && !labels.names[i].empty())
      names.push_back(labels.names[i]);
  return names;
}

Normals_of_file normals_of(const Triangle_soup& soup)
{
  if (soup.normals.empty())
    return Normals_of_file::none;
  if (has_flat_normals(soup))
    return Normals_of_file::per_face;
  constexpr Index none = std::numeric_limits<Index>::max();
  std::vector<Index> normal_of(soup.points.size(), none);
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      Index& known = normal_of[soup.triangles[t][k]];
      const Index normal = soup.normals.of_triangle[t][k];
      if (known != none && soup.normals.values[known] != soup.normals.values[normal])
        return Normals_of_file::per_corner;
      known = normal;
    }
  return Normals_of_file::per_vertex;
}

// An image has a name, or else a file beside the mesh, or else it is in the file.
std::vector<std::string> images_of(const Triangle_soup& soup)
{
  std::vector<std::string> names;
  if (!soup.scene || !soup.scene->document.contains("images"))
    return names;
  for (const auto& image : soup.scene->document["images"]) {
    const auto text = [&](const char* key) {
      return image.is_object() && image.contains(key) && image[key].is_string()
                 ? image[key].get<std::string>()
                 : std::string();
    };
    const std::string uri = text("uri");
    const bool is_inside = uri.rfind("data:", 0) == 0;
    names.push_back(!text("name").empty()        ? text("name")
                    : !uri.empty() && !is_inside ? uri
                                                 : "image " + std::to_string(names.size()));
  }
  return names;
}

// Adds the names of attributes of a scene that are no columns of the soup.
void add_attributes_of_scene_only(Contents& contents, const Gltf_scene& scene)
{
  std::map<std::string, std::size_t> instances_with;
  for (const Gltf_scene::Instance& instance : scene.instances)
    for (const Gltf_scene::Column& column : scene.blocks[instance.block].attributes)
      ++instances_with[column.name];
  std::set<std::string> of_soup(contents.attributes.begin(), contents.attributes.end());
  of_soup.insert({"POSITION", "NORMAL", "TEXCOORD_0"});
  if (of_soup.count("red") != 0)
    of_soup.insert("COLOR_0");
  for (const auto& [name, count] : instances_with)
    if (of_soup.count(name) == 0)
      (count < scene.instances.size() ? contents.attributes_of_some_primitives
                                      : contents.attributes_of_different_types)
          .push_back(name);
}

/// One call of `inspect`.
class Inspector
{
public:
  explicit Inspector(const Prepared_soup& prepared)
      : m_prepared(prepared), m_soup(prepared.soup),
        m_working(prepared.soup, prepared.positions, prepared.is_frozen, {}, prepared.scale,
                  prepared.is_turned, prepared.fronts),
        m_rule(m_working.mesh())
  {
    for (const auto e : m_working.constraints().line_edges)
      m_rule.mark(e);
    for (const auto h : m_working.constraints().spokes)
      m_rule.mark_at_target(h);
    for (const auto v : m_working.constraints().locked_vertices)
      m_rule.lock(v);
  }

  Inspection run()
  {
    const Sewing_notes& notes = m_working.notes();
    m_result.vertices = m_soup.points.size();
    m_result.unused_vertices = notes.unused_vertices;
    m_result.coincident_vertices = notes.coincident_vertices;
    m_result.faces = m_soup.triangles.size();
    m_result.left_out_faces = m_prepared.left_out_faces;
    m_result.normals = m_prepared.normals;
    m_result.pairs = m_prepared.offending_pairs;
    m_result.diagonal = internal::Diagonal(m_soup).length();
    find_pieces_and_surfaces();
    count_vertices();
    count_seams();
    m_result.border_gaps = m_prepared.border_gaps;
    return std::move(m_result);
  }

private:
  void find_pieces_and_surfaces()
  {
    const auto by_vertices = internal::numbered_pieces(m_soup.triangles, m_soup.points.size());
    m_result.pieces = by_vertices.pieces;
    const std::vector<Index_triple> triangles = in_positions(m_soup.triangles, m_prepared.positions);
    const auto by_positions = internal::numbered_pieces(triangles, m_soup.points.size());
    for (const Piece& shape : by_positions.pieces) {
      m_result.surfaces.push_back({shape, 0, {}, 0});
      m_result.border_edges += shape.border_edges;
    }

    std::set<Index> turned, misoriented;
    for (Index t = 0; t < m_prepared.is_turned.size(); ++t)
      if (m_prepared.is_turned[t])
        turned.insert(by_vertices.of_triangle[t]);
    m_result.turned_faces = m_prepared.turned_faces();
    m_result.turned_pieces.assign(turned.begin(), turned.end());
    for (const Index side : m_working.misoriented_sides()) { // both sides of each edge are listed
      misoriented.insert(by_vertices.of_triangle[side / 3]);
      ++m_result.surfaces[by_positions.of_triangle[side / 3]].misoriented_edges;
    }
    for (Connected_surface& surface : m_result.surfaces)
      surface.misoriented_edges /= 2;
    m_result.misoriented_edges = m_working.notes().misoriented_edges;
    m_result.misoriented_pieces.assign(misoriented.begin(), misoriented.end());

    std::vector<Point_3> points;
    for (const Point_3& point : m_soup.points)
      points.push_back(m_prepared.scale(point));
    const auto distances = internal::surface_distances(points, triangles, by_positions.of_triangle,
                                                       m_result.surfaces.size(), m_result.pairs);
    for (std::size_t s = 0; s < distances.size() && distances.size() > 1; ++s) {
      m_result.surfaces[s].nearest = distances[s].nearest;
      m_result.surfaces[s].distance = m_prepared.scale.undone(distances[s].distance);
    }
  }

  void count_vertices()
  {
    const Sewn_mesh::Mesh& mesh = m_working.mesh();
    Inspection::Vertices& count = m_result.movable;
    for (const auto v : mesh.vertices()) {
      if (m_rule.is_free(v))
        ++count.free;
      else if (!m_rule.is_locked(v))
        ++(is_end(v) ? count.ends : count.on_lines);
      else
        ++(m_working.lock_reason(v) == Hindrance::misoriented ? count.misoriented : count.non_manifold);
    }
    const std::vector<Sewn_mesh::Mesh::Face_index> face_of = m_working.faces_of_triangles();
    for (Index t = 0; t < m_soup.triangles.size(); ++t) {
      const auto face = face_of[m_prepared.fronts.empty() ? t : m_prepared.fronts[t]];
      const auto corners = mesh.vertices_around_face(mesh.halfedge(face));
      m_result.fixed_faces +=
          std::all_of(corners.begin(), corners.end(), [this](auto v) { return m_rule.is_locked(v); });
    }
  }

  // Whether a vertex on a line cannot move along it, apart from limits of turn and drift.
  bool is_end(Sewn_mesh::Mesh::Vertex_index v) const
  {
    const Sewn_mesh::Mesh& mesh = m_working.mesh();
    const auto around = mesh.halfedges_around_target(mesh.halfedge(v));
    return std::none_of(around.begin(), around.end(),
                        [&](auto h) { return m_rule.may_move_along(mesh.opposite(h), m_rule); });
  }

  void count_seams()
  {
    Inspection::Seams& seams = m_result.seams;
    const auto add = [&](Sewn_mesh::Mesh::Edge_index e) {
      const Sewn_mesh::Differences differences = m_working.differences(e);
      ++seams.edges;
      seams.by_vertices += differences.in_vertex;
      seams.by_texture += differences.in_uv;
      seams.by_normals += differences.in_normal;
      seams.by_labels += differences.in_label;
      seams.by_regions += differences.in_region;
      seams.by_doubles += differences.in_doubles;
    };
    for (const auto e : m_working.constraints().line_edges)
      add(e);
    for (const auto h : m_working.constraints().spokes)
      add(m_working.mesh().edge(h));
    seams.by_attributes = seams_of_attributes(m_prepared);
    seams.by_attributes.erase("texture"); // which `by_texture` counts
  }

  const Prepared_soup& m_prepared;
  const Triangle_soup& m_soup;
  Sewn_mesh m_working;
  Border_rule<Sewn_mesh::Mesh> m_rule;
  Inspection m_result;
};

} // namespace

std::optional<std::size_t> Connected_surface::genus() const
{
  if (!is_closed() || misoriented_edges > 0 || shape.euler_characteristic > 2 ||
      shape.euler_characteristic % 2 != 0)
    return std::nullopt;
  return std::size_t((2 - shape.euler_characteristic) / 2);
}

Contents contents_of(const Mesh_file& file)
{
  const Triangle_soup& soup = file.soup;
  Contents contents;
  contents.format = file.format;
  contents.vertices = soup.points.size();
  contents.faces = soup.triangles.size();
  contents.groups = names_in_use(soup.groups);
  contents.objects = names_in_use(soup.objects);
  contents.materials = names_in_use(soup.materials);
  contents.images = images_of(soup);
  contents.material_libraries = soup.material_libraries;
  contents.texture_coordinates = soup.uvs.empty() ? 0 : soup.uvs.values.size();
  contents.normals = normals_of(soup);
  for (const auto* attributes : {&soup.vertex_attributes, &soup.triangle_attributes})
    for (const Attribute& attribute : *attributes)
      contents.attributes.push_back(attribute.name);
  if (has_tangents_in_scene_only(soup))
    contents.attributes.push_back("TANGENT");
  if (soup.scene)
    add_attributes_of_scene_only(contents, *soup.scene);
  return contents;
}

Inspection inspect(Triangle_soup soup, bool has_normals_of_vertices)
{
  Prepare_options options;
  const std::size_t used = count_of_used_vertices(soup);
  const Suited_normals normals = suit_normals(soup, Normals_choice::automatic, has_normals_of_vertices);
  const std::size_t joined_vertices = used - count_of_used_vertices(soup);
  options.normals = normals.choice;
  options.open_seams = Open_seams::measure;
  const Prepared_soup prepared = prepare(std::move(soup), options);
  Inspection result = Inspector(prepared).run();
  result.unused_vertices -= joined_vertices;
  result.joined_corners = normals.joined_corners;
  return result;
}

} // namespace selvedge
