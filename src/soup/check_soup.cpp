// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "soup/check_soup.h"

#include "soup/with_number.h"

#include <selvedge/Error.h>

#include <cmath>
#include <cstddef>

namespace selvedge {
namespace {

class Soup_check
{
public:
  Soup_check(const Triangle_soup& soup, const std::string& what) : m_soup(soup), m_what(what) {}

  void check_geometry() const
  {
    for (std::size_t v = 0; v < m_soup.points.size(); ++v)
      for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(m_soup.points[v][axis]))
          refuse("vertex", v, "has a coordinate that is not finite");
    for (const Pose& pose : m_soup.poses) {
      check_size(pose.points.size(), m_soup.points.size(), "points of the pose '" + pose.name + "'");
      for (std::size_t v = 0; v < pose.points.size(); ++v)
        for (int axis = 0; axis < 3; ++axis)
          if (!std::isfinite(pose.points[v][axis]))
            refuse("vertex", v, "has a coordinate that is not finite in the pose '" + pose.name + "'");
    }
    check_corners(m_soup.triangles, m_soup.points.size(), "points");
  }

  void check_arrays() const
  {
    check_geometry();
    for (std::size_t i = 0; i < m_soup.uvs.values.size(); ++i)
      if (i != m_soup.uvs.missing)
        for (const double coordinate : m_soup.uvs.values[i])
          if (!std::isfinite(coordinate))
            refuse("texture coordinate", i, "is not finite");
    check_values(m_soup.uvs, "uvs");
    check_values(m_soup.normals, "normals");
    check_labels(m_soup.groups, "groups");
    check_labels(m_soup.objects, "objects");
    check_labels(m_soup.materials, "materials");
    check_labels(m_soup.smoothing_groups, "smoothing_groups");
    check_attributes(m_soup.vertex_attributes, m_soup.points.size());
    check_attributes(m_soup.triangle_attributes, m_soup.triangles.size());
    if (m_soup.scene)
      check_size(m_soup.scene_vertices.size(), m_soup.points.size(), "scene_vertices");
  }

  void check_all() const
  {
    check_arrays();
    check_polygons();
  }

private:
  [[noreturn]] void refuse(const char* element, std::size_t number, const std::string& problem) const
  {
    throw Argument_error(m_what + ": " + element + ' ' + std::to_string(number) + " (counted from 0) " +
                         problem);
  }

  void check_size(std::size_t size, std::size_t due, const std::string& name) const
  {
    if (size != due)
      throw Argument_error(m_what + ": the array " + name + " has " + std::to_string(size) +
                           " entries, and should have " + std::to_string(due));
  }

  void check_corners(const std::vector<Index_triple>& corners, std::size_t values,
                     const std::string& name) const
  {
    for (std::size_t t = 0; t < corners.size(); ++t)
      for (const Index value : corners[t])
        if (value >= values)
          refuse("triangle", t,
                 "refers to number " + std::to_string(value) + " of the " + std::to_string(values) + ' ' +
                     name);
  }

  template <std::size_t dimension>
  void check_values(const Corner_values<dimension>& values, const std::string& name) const
  {
    if (values.empty())
      return;
    check_size(values.of_triangle.size(), m_soup.triangles.size(), name + ".of_triangle");
    check_corners(values.of_triangle, values.values.size(), name);
  }

  void check_polygons() const
  {
    std::size_t free = 0; // the first triangle that is of no polygon before
    for (std::size_t i = 0; i < m_soup.polygons.size(); ++i) {
      const Cut_polygon& polygon = m_soup.polygons[i];
      if (polygon.corners < 4)
        refuse("polygon", i,
               "has " + std::to_string(polygon.corners) + " corners, and should have at least 4");
      const std::size_t triangles = polygon.corners - 2;
      if (polygon.first_triangle < free || polygon.first_triangle + triangles > m_soup.triangles.size())
        refuse("polygon", i,
               "has triangles of another one, or some that do not exist: " + std::to_string(triangles) +
                   " from triangle " + std::to_string(polygon.first_triangle) + " on");
      if (polygon.start >= 3 * triangles)
        refuse("polygon", i, "starts at corner " + std::to_string(polygon.start) + ", beyond its triangles");
      free = polygon.first_triangle + triangles;
    }
  }

  void check_labels(const Triangle_labels& labels, const std::string& name) const
  {
    if (labels.empty())
      return;
    check_size(labels.of_triangle.size(), m_soup.triangles.size(), name + ".of_triangle");
    for (std::size_t t = 0; t < labels.of_triangle.size(); ++t)
      if (labels.of_triangle[t] >= labels.names.size())
        refuse("triangle", t, "has no name among the " + name);
  }

  void check_attributes(const std::vector<Attribute>& attributes, std::size_t rows) const
  {
    for (const Attribute& attribute : attributes) {
      const std::size_t bytes =
          with_number(attribute.type, [](auto number) { return sizeof number; }) * attribute.components;
      check_size(attribute.rows.size(), rows * bytes, "rows of attribute '" + attribute.name + "'");
    }
  }

  const Triangle_soup& m_soup;
  const std::string& m_what;
};

} // namespace

void check_soup(const Triangle_soup& soup, const std::string& what)
{
  Soup_check(soup, what).check_all();
}

void check_arrays(const Triangle_soup& soup, const std::string& what)
{
  Soup_check(soup, what).check_arrays();
}

void check_geometry(const Triangle_soup& soup, const std::string& what)
{
  Soup_check(soup, what).check_geometry();
}

} // namespace selvedge
