// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/poses.h>

#include <selvedge/Error.h>

#include <glob.h>

#include <algorithm>
#include <cstring>
#include <memory>

namespace selvedge {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& difference)
{
  throw Input_error(path.string() + ": is no pose of the mesh: " + difference +
                    "; export all poses from one mesh, without changing it in between");
}

std::string text_of(const Index_triple& triangle)
{
  return std::to_string(triangle[0] + 1) + ' ' + std::to_string(triangle[1] + 1) + ' ' +
         std::to_string(triangle[2] + 1);
}

// Whether two triangles have the same corners, or corners at the same positions of a soup.
bool do_coincide(const Index_triple& a, const Index_triple& b, const Triangle_soup& soup)
{
  return std::equal(a.begin(), a.end(), b.begin(),
                    [&](Index v, Index w) { return v == w || soup.points[v] == soup.points[w]; });
}

// Returns the polygon from which a triangle was cut, if both meshes have it.
const Cut_polygon* common_polygon(Index triangle, const Triangle_soup& a, const Triangle_soup& b)
{
  const auto find = [triangle](const Triangle_soup& soup) -> const Cut_polygon* {
    const auto beyond = std::upper_bound(soup.polygons.begin(), soup.polygons.end(), triangle,
                                         [](Index t, const Cut_polygon& p) { return t < p.first_triangle; });
    if (beyond == soup.polygons.begin())
      return nullptr;
    const Cut_polygon& polygon = *(beyond - 1);
    return triangle < polygon.first_triangle + polygon.corners - 2 ? &polygon : nullptr;
  };
  const Cut_polygon *of_a = find(a), *of_b = find(b);
  return of_a && of_b && of_a->first_triangle == of_b->first_triangle && of_a->corners == of_b->corners
             ? of_a
             : nullptr;
}

std::vector<Index> corners_of(const Cut_polygon& polygon, const Triangle_soup& soup)
{
  std::vector<Index> corners;
  for (Index t = polygon.first_triangle; t < polygon.first_triangle + polygon.corners - 2; ++t)
    corners.insert(corners.end(), soup.triangles[t].begin(), soup.triangles[t].end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::vector<Point_3> points_by_corner(const std::filesystem::path& path, const Triangle_soup& pose,
                                      const Triangle_soup& mesh)
{
  std::vector<Point_3> points = mesh.points;
  std::vector<char> is_known(points.size(), false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = mesh.triangles[t][k];
      const Point_3& point = pose.points[pose.triangles[t][k]];
      if (is_known[v] && points[v] != point)
        refuse(path, "face " + std::to_string(t + 1) +
                         " has a corner apart from that of another face, with "
                         "which it coincides in the mesh, and STL has no vertices that tell the two apart");
      points[v] = point;
      is_known[v] = true;
    }
  return points;
}

} // namespace

Pose read_pose(const std::filesystem::path& path, const Triangle_soup& mesh)
{
  Mesh_file file = read_mesh(path);
  const Triangle_soup& pose = file.soup;
  const std::string name = (is_gzip(path) ? path.stem() : path).stem().string();
  const auto differ = [&](const char* what, std::size_t here, std::size_t there) {
    refuse(path,
           "it has " + std::to_string(here) + ' ' + what + ", and the mesh has " + std::to_string(there));
  };
  if (pose.triangles.size() != mesh.triangles.size())
    differ("triangles", pose.triangles.size(), mesh.triangles.size());
  if (file.format == Mesh_format::stl)
    return {name, points_by_corner(path, pose, mesh)};
  if (pose.points.size() != mesh.points.size())
    differ("vertices", pose.points.size(), mesh.points.size());
  for (Index t = 0; t < pose.triangles.size(); ++t) {
    // A reader makes vertices one that coincide. Those of the mesh must coincide in the pose as well.
    if (do_coincide(pose.triangles[t], mesh.triangles[t], pose))
      continue;
    const Cut_polygon* const polygon = common_polygon(t, pose, mesh);
    if (!polygon && do_coincide(pose.triangles[t], mesh.triangles[t], mesh))
      refuse(path, "triangle " + std::to_string(t + 1) +
                       " has a corner apart from that of another, with which it coincides in the mesh; where "
                       "faces have no vertices in common, those that coincide become one");
    if (!polygon || corners_of(*polygon, pose) != corners_of(*polygon, mesh))
      refuse(path, "triangle " + std::to_string(t + 1) + " has the vertices " + text_of(pose.triangles[t]) +
                       ", and in the mesh " + text_of(mesh.triangles[t]));
    t = polygon->first_triangle + polygon->corners - 3; // goes on after it
  }
  return {name, std::move(file.soup.points)};
}

std::vector<std::filesystem::path> files_named(const std::string& name, const std::filesystem::path& mesh)
{
  std::error_code error;
  if (std::filesystem::exists(name, error) || name.find_first_of("*?[") == std::string::npos)
    return {name};
  glob_t found{};
  const std::unique_ptr<glob_t, void (*)(glob_t*)> owner(&found, globfree);
  std::vector<std::string> names;
  if (glob(name.c_str(), GLOB_TILDE, nullptr, &found) == 0)
    names.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    const int order = strverscmp(a.c_str(), b.c_str());
    return order != 0 ? order < 0 : a < b;
  });
  std::vector<std::filesystem::path> files;
  for (const std::string& file : names)
    if (!std::filesystem::equivalent(file, mesh, error))
      files.emplace_back(file);
  if (files.empty())
    throw Input_error(name + ": no file " + (names.empty() ? "" : "but the mesh itself ") +
                      "has such a name");
  return files;
}

Triangle_soup in_pose(const Triangle_soup& mesh, std::size_t pose)
{
  Triangle_soup result = mesh;
  result.points = mesh.poses[pose].points;
  result.poses.clear();
  result.scene = nullptr;
  result.scene_vertices.clear();
  return result;
}

} // namespace selvedge
