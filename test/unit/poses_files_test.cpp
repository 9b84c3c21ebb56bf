// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Files that hold poses of a mesh: mesh files, patterns of such, and point caches.

#include "support/Temporary_folder.h"
#include "support/soups.h"

#include <selvedge/Error.h>
#include <selvedge/poses.h>

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

std::string refusal_of_pose(const std::filesystem::path& path, const Triangle_soup& mesh)
{
  try {
    if (is_point_cache(path))
      read_point_cache(path, mesh);
    else
      read_pose(path, mesh);
  } catch (const Input_error& error) {
    return error.what();
  }
  return "";
}

Triangle_soup posed_sheet()
{
  Triangle_soup mesh = sheet(2, 1);
  mesh.poses.push_back({"a", moved(mesh, 0, 0, 1).points, 0.5f});
  mesh.poses.push_back({"b", moved(mesh, 0.25, 0, 2).points, 0.75f});
  mesh.poses.push_back({"c", moved(mesh, -8, 0, 2).points, 1});
  return mesh;
}

TEST(Pose_files, HaveTheVerticesAndFacesOfTheMesh)
{
  const Temporary_folder folder;
  const Triangle_soup mesh = sheet(2, 2);
  for (const char* name : {"p.obj", "p.ply", "p.off", "p.obj.gz"}) {
    write_mesh(folder / name, moved(mesh, 0, 0, 1));
    const Pose pose = read_pose(folder / name, mesh);
    EXPECT_EQ(pose.name, "p");
    EXPECT_EQ(pose.points, moved(mesh, 0, 0, 1).points);
  }
  write_mesh(folder / "other.obj", sheet(2, 1));
  EXPECT_NE(refusal_of_pose(folder / "other.obj", mesh).find("4 triangles"), std::string::npos);
  Triangle_soup turned = mesh;
  std::swap(turned.triangles[3][1], turned.triangles[3][2]);
  write_mesh(folder / "turned.obj", turned);
  EXPECT_NE(refusal_of_pose(folder / "turned.obj", mesh).find("triangle 4 has the vertices"),
            std::string::npos);
  EXPECT_NE(refusal_of_pose(folder / "none.obj", mesh), "");
}

TEST(Pose_files, InStlGoByCorners)
{
  const Temporary_folder folder;
  const Triangle_soup mesh = sheet(2, 1);
  write_mesh(folder / "p.stl", moved(mesh, 0, 0, 1));
  EXPECT_EQ(read_pose(folder / "p.stl", mesh).points, moved(mesh, 0, 0, 1).points);
  Triangle_soup torn = unshared(mesh);
  torn.points[0] = Point_3(0, 0, 9);
  write_mesh(folder / "torn.stl", torn);
  EXPECT_NE(refusal_of_pose(folder / "torn.stl", mesh).find("STL has no vertices"), std::string::npos);
}

TEST(Pose_files, AreRefusedWhereVerticesPartThatTheMeshHasMadeOne)
{
  const Temporary_folder folder;
  const Triangle_soup apart = unshared(sheet(8, 8)); // each face has vertices of its own
  write_mesh(folder / "mesh.obj", apart);
  const Triangle_soup mesh = read_mesh(folder / "mesh.obj").soup;
  ASSERT_NE(mesh.triangles, apart.triangles);
  write_mesh(folder / "moved.obj", moved(apart, 0, 0, 1));
  EXPECT_EQ(read_pose(folder / "moved.obj", mesh).points, moved(apart, 0, 0, 1).points);
  Triangle_soup torn = apart;
  for (std::size_t t = 0; t < torn.triangles.size(); ++t)
    for (const Index v : torn.triangles[t])
      torn.points[v] = Point_3(apart.points[v].x(), apart.points[v].y(), double(t));
  write_mesh(folder / "torn.obj", torn);
  EXPECT_NE(refusal_of_pose(folder / "torn.obj", mesh).find("has a corner apart from that of another"),
            std::string::npos);
}

TEST(Pose_files, CutPolygonsAsTheMeshDoes)
{
  const Temporary_folder folder;
  const char* const faces = "f 1 2 3 4\nf 4 3 5\n";
  write_file(folder / "flat.obj", std::string("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 4 0\n") + faces);
  // Here the quadrangle is not convex, and is cut along its other diagonal.
  write_file(folder / "dent.obj", std::string("v 0 0 0\nv 0.5 1.5 0\nv 2 2 0\nv 0 2 0\nv 1 4 0\n") + faces);
  const Triangle_soup mesh = read_mesh(folder / "flat.obj").soup;
  ASSERT_NE(read_mesh(folder / "dent.obj").soup.triangles, mesh.triangles);
  EXPECT_EQ(read_pose(folder / "dent.obj", mesh).points[1], Point_3(0.5, 1.5, 0));
}

TEST(Pose_files, AreFoundByPatternsInNaturalOrder)
{
  const Temporary_folder folder;
  for (const char* name : {"f_10.obj", "f_9.obj", "f_1.obj", "f_rest.obj", "[f].obj"})
    write_mesh(folder / name, sheet(1, 1));
  const auto names = [&](const char* pattern) {
    std::vector<std::string> result;
    for (const auto& file : files_named((folder / pattern).string(), folder / "f_rest.obj"))
      result.push_back(file.filename().string());
    return result;
  };
  EXPECT_EQ(names("f_*.obj"), (std::vector<std::string>{"f_1.obj", "f_9.obj", "f_10.obj"}));
  EXPECT_EQ(names("[f].obj"), std::vector<std::string>{"[f].obj"}) << "the file of this name";
  const auto refusal = [&](const char* pattern) -> std::string {
    try {
      names(pattern);
      return "";
    } catch (const Input_error& error) {
      return error.what();
    }
  };
  EXPECT_NE(refusal("g_*.obj").find("g_*.obj: no file has such a name"), std::string::npos);
  EXPECT_NE(refusal("f_r*.obj").find("f_r*.obj: no file but the mesh itself has such a name"),
            std::string::npos);
}

TEST(Point_caches, AreWrittenAsTheyWereRead)
{
  const Temporary_folder folder;
  const Triangle_soup mesh = posed_sheet();
  for (const char* ending : {"mdd", "pc2"}) {
    const auto first = folder / (std::string("a.") + ending), second = folder / (std::string("b.") + ending);
    write_point_cache(first, mesh);
    Triangle_soup again = mesh;
    again.poses = read_point_cache(first, mesh);
    ASSERT_EQ(again.poses.size(), 3u);
    EXPECT_EQ(again.poses[2].name, "frame_3");
    for (std::size_t pose = 0; pose < 3; ++pose) {
      EXPECT_EQ(again.poses[pose].points, mesh.poses[pose].points);
      EXPECT_EQ(again.poses[pose].time, mesh.poses[pose].time);
    }
    write_point_cache(second, again);
    const std::string bytes = read_file(first);
    EXPECT_EQ(read_file(second), bytes);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      write_file(second, bytes.substr(0, size));
      EXPECT_NE(refusal_of_pose(second, mesh), "") << size;
    }
    write_file(second, bytes + '0');
    EXPECT_NE(refusal_of_pose(second, mesh), "");
    EXPECT_NE(refusal_of_pose(first, sheet(3, 3)).find("16 vertices"), std::string::npos);
  }
  // The first bytes, as other programs write them.
  EXPECT_EQ(read_file(folder / "a.mdd").substr(0, 12), std::string("\0\0\0\3\0\0\0\6\x3f\0\0\0", 12));
  EXPECT_EQ(read_file(folder / "a.pc2").substr(0, 20), std::string("POINTCACHE2\0\1\0\0\0\6\0\0\0", 20));
}

TEST(Point_caches, HoldFloatsAlone)
{
  const Temporary_folder folder;
  Triangle_soup mesh = posed_sheet();
  mesh.poses[1].points[0] = Point_3(0.1, 0, 0);
  EXPECT_THROW(write_point_cache(folder / "a.mdd", mesh), Argument_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.mdd"));
  mesh.poses.clear();
  EXPECT_THROW(write_point_cache(folder / "a.mdd", mesh), Argument_error);
  std::string bytes("\0\0\0\1\0\0\0\6\0\0\0\0", 12);
  bytes += std::string(72, '\xff'); // not a number
  write_file(folder / "nan.mdd", bytes);
  EXPECT_NE(refusal_of_pose(folder / "nan.mdd", mesh).find("not finite"), std::string::npos);
}

} // namespace
} // namespace selvedge::test
