// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BENCHMARK_OPENMESH_DECIMATER_H
#define SELVEDGE_BENCHMARK_OPENMESH_DECIMATER_H

#include <selvedge/Simplify_options.h>
#include <selvedge/Triangle_soup.h>

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModAspectRatioT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <cmath>
#include <cstddef>
#include <vector>

namespace selvedge::benchmark {

/// OpenMesh's decimater of a soup, with quadrics and our limits of normal change and aspect ratio. Vertices
/// are those of the soup.
class Openmesh_decimater
{
public:
  using Mesh = OpenMesh::TriMesh;
  using Decimater = OpenMesh::Decimater::DecimaterT<Mesh>;

  Openmesh_decimater(const Triangle_soup& soup, const Simplify_options& options)
      : m_mesh(mesh_of(soup)), m_decimater(m_mesh)
  {
    OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric;
    OpenMesh::Decimater::ModNormalFlippingT<Mesh>::Handle normal;
    OpenMesh::Decimater::ModAspectRatioT<Mesh>::Handle aspect_ratio;
    m_decimater.add(quadric);
    m_decimater.add(normal);
    m_decimater.add(aspect_ratio);
    m_decimater.module(quadric).unset_max_err();
    m_decimater.module(normal).set_max_normal_deviation(options.max_normal_change);
    // Its equilateral triangle does not have 1.
    m_decimater.module(aspect_ratio)
        .set_aspect_ratio(static_cast<float>(2 / std::sqrt(3.0) / options.min_aspect_ratio));
  }

  const Mesh& mesh() const { return m_mesh; }

  /// For more modules.
  Decimater& decimater() { return m_decimater; }

  /// Returns the number of collapses.
  std::size_t reduce_to(std::size_t faces)
  {
    m_decimater.initialize();
    return m_decimater.decimate_to_faces(0, faces);
  }

  std::vector<Index_triple> triangles() const
  {
    std::vector<Index_triple> triangles;
    for (const auto f : m_mesh.faces()) {
      Index_triple corners;
      std::size_t place = 0;
      for (const auto v : m_mesh.fv_range(f))
        corners[place++] = static_cast<Index>(v.idx());
      triangles.push_back(corners);
    }
    return triangles;
  }

private:
  static Mesh mesh_of(const Triangle_soup& soup)
  {
    Mesh mesh;
    mesh.reserve(soup.points.size(), soup.triangles.size() * 3 / 2, soup.triangles.size());
    for (const Point_3& p : soup.points)
      mesh.add_vertex(Mesh::Point(p.x(), p.y(), p.z()));
    for (const auto& [a, b, c] : soup.triangles)
      mesh.add_face(mesh.vertex_handle(a), mesh.vertex_handle(b), mesh.vertex_handle(c));
    mesh.request_face_normals();
    mesh.update_face_normals();
    return mesh;
  }

  Mesh m_mesh;
  Decimater m_decimater;
};

} // namespace selvedge::benchmark

#endif // SELVEDGE_BENCHMARK_OPENMESH_DECIMATER_H
