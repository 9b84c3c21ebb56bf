// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "progressive/lists.h"

#include "files/formats.h"
#include "files/gltf_column_reader.h"

#include <selvedge/Error.h>

#include <algorithm>
#include <utility>

namespace selvedge {
namespace {

using Json = Gltf_scene::Json;
using Column = Gltf_scene::Column;

class Progressive_reader
{
public:
  Progressive_reader(std::string_view contents, Mesh_format format, const std::string& name)
      : m_document(files::read_gltf_document(contents, format, name, nullptr, 0)),
        m_lists(lists_of(m_document.json)),
        m_columns(m_document, "a list of " + std::string(progressive_extras))
  {
    if (m_lists.is_null())
      m_document.fail("this is no progressive file; make one by selvedge simplify --progressive");
    if (const auto version = m_lists.at("version").get<int>(); version != progressive::version)
      m_document.fail("its list of collapses has version " + std::to_string(version) +
                      ", and this program reads version " + std::to_string(progressive::version) +
                      "; use the program that wrote it");
    m_mesh.soup = files::read_gltf(contents, format, name, nullptr, 0).soup;
  }

  Progressive_mesh read(bool is_digest_judged)
  {
    const auto steps = m_lists.at("steps").get<std::uint32_t>();
    m_mesh.faces = numbers(m_lists.at("faces"), std::size_t(steps) + 1);
    m_mesh.fixed_faces = m_lists.at("fixed_faces").get<std::uint32_t>();
    for (const Json& pose : m_lists.at("poses")) {
      m_mesh.soup.poses.push_back({pose.at("name").get<std::string>(), {}});
      m_mesh.is_pose_guarded.push_back(pose.at("judged").get<bool>());
    }
    const std::size_t size = m_mesh.soup.points.size();
    m_mesh.merges_into.assign(size, Progressive_mesh::never);
    m_mesh.steps.assign(size, Progressive_mesh::never);
    for (Pose& pose : m_mesh.soup.poses)
      pose.points.assign(size, Point_3(0, 0, 0));
    for (const Gltf_scene::Part& part : scene().parts)
      if (const Gltf_scene::Instance& instance = scene().instances[part.instance];
          scene().blocks[instance.block].size > 0 &&
          m_mesh.merges_into[instance.first] == Progressive_mesh::never)
        read_buffer(part, instance.first, scene().blocks[instance.block].size);
    check(is_digest_judged);
    return std::move(m_mesh);
  }

private:
  const Gltf_scene& scene() const { return *m_mesh.soup.scene; }

  // Returns the lists in the extras of an element; null when there are none.
  static Json lists_of(const Json& element)
  {
    const auto extras = element.find("extras");
    return extras != element.end() && extras->is_object() ? extras->value(progressive_extras, Json())
                                                          : Json();
  }

  std::vector<Index> numbers(const Json& accessor, std::size_t count) const
  {
    const auto number = accessor.get<std::uint32_t>();
    if (number >= m_document.model.accessors.size() || m_document.model.accessors[number].bufferView < 0)
      m_document.fail("a list of collapses is nowhere in the file; make the file again");
    const Column column = m_columns.read(int(number), "a list", count);
    if (column.component_type != type_uint32 || column.components != 1)
      m_document.fail("a list of collapses is not of 32-bit whole numbers; make the file again");
    std::vector<Index> result(count);
    for (std::size_t i = 0; i < count; ++i)
      result[i] = Index(component(column, i, 0));
    return result;
  }

  void read_buffer(const Gltf_scene::Part& part, Index first, Index size)
  {
    const Json lists = lists_of(m_document.json["meshes"][part.mesh_of_file]["primitives"][part.primitive]);
    if (lists.is_null())
      m_document.fail("mesh " + std::to_string(part.mesh_of_file) + ", primitive " +
                      std::to_string(part.primitive) + ": it has no list of collapses; make the file again");
    const std::vector<Index> merges = numbers(lists.at("merges_into"), size);
    const std::vector<Index> steps = numbers(lists.at("steps"), size);
    for (Index v = 0; v < size; ++v) {
      const bool ends = steps[v] != Progressive_mesh::never;
      if (merges[v] > v || (merges[v] != v && !ends) ||
          (ends && (steps[v] == 0 || steps[v] >= m_mesh.faces.size())) || (v > 0 && steps[v] > steps[v - 1]))
        m_document.fail("mesh " + std::to_string(part.mesh_of_file) + ", vertex " + std::to_string(v) +
                        ": it goes where or when it cannot; make the file again");
      m_mesh.merges_into[first + v] = first + merges[v];
      m_mesh.steps[first + v] = steps[v];
    }
    for (std::size_t i = 0; i < m_mesh.soup.poses.size(); ++i) {
      const Column column = m_columns.read(lists.at("poses").at(i).get<int>(), "a pose", size);
      if (column.component_type != type_float32 || column.components != 3)
        m_document.fail("a pose is not of three 32-bit floats for each vertex; make the file again");
      for (Index v = 0; v < size; ++v)
        m_mesh.soup.poses[i].points[first + v] =
            Point_3(component(column, v, 0), component(column, v, 1), component(column, v, 2));
    }
  }

  void check(bool is_digest_judged) const
  {
    const std::vector<Index>& faces = m_mesh.faces;
    if (faces.front() != m_mesh.soup.triangles.size() || !std::is_sorted(faces.rbegin(), faces.rend()) ||
        m_mesh.fixed_faces > faces.front())
      m_document.fail("its numbers of faces do not fit its triangles; make the file again");
    if (is_digest_judged && progressive::digest_of(m_mesh) != m_lists.at("sha256").get<std::string>())
      m_document.fail(
          "its triangles or its list of collapses are not those that were judged: the file is damaged, "
          "or another program has written it anew; make it again");
  }

  files::Gltf_document m_document;
  Json m_lists;
  files::Gltf_column_reader m_columns;
  Progressive_mesh m_mesh;
};

} // namespace

Progressive_mesh progressive::read(std::string_view contents, Mesh_format format, const std::string& name,
                                   bool is_digest_judged)
{
  if (format != Mesh_format::glb && format != Mesh_format::gltf)
    throw Input_error(name +
                      ": a progressive file is a glTF file; make one by selvedge simplify --progressive "
                      "FILE.glb");
  try {
    return Progressive_reader(contents, format, name).read(is_digest_judged);
  } catch (const Json::exception& error) {
    throw Input_error(name + ": not a valid progressive file (" + error.what() + "); make it again");
  }
}

Progressive_mesh read_progressive(std::string_view contents, Mesh_format format, const std::string& name)
{
  return progressive::read(contents, format, name, true);
}

Progressive_mesh read_progressive(const std::filesystem::path& path)
{
  return read_progressive(read_file(path), mesh_format(path), path.string());
}

} // namespace selvedge
