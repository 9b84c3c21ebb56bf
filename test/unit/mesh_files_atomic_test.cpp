// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G9: no output file is left half written, none is lost.

#include "support/Temporary_folder.h"

#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>

#include <csignal>
#include <iterator>
#include <string>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace selvedge;
using selvedge::test::contents_of;
using selvedge::test::Temporary_folder;

namespace {

namespace fs = std::filesystem;

std::size_t files_in(const fs::path& folder)
{
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// A strip of triangles, in floats, of some hundred kilobytes in any format.
Triangle_soup strip()
{
  Triangle_soup soup;
  for (Index i = 0; i < 20000; ++i)
    soup.points.emplace_back(i, i % 2, 0);
  for (Index i = 0; i + 2 < 20000; ++i)
    soup.triangles.push_back({i, i + 1, i + 2});
  return soup;
}

/// No file of this process may grow beyond so many bytes within the scope: the disk is full, as it were.
class Full_disk
{
public:
  explicit Full_disk(rlim_t bytes)
  {
    m_handler = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &m_limit);
    struct rlimit lower = m_limit;
    lower.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &lower);
  }
  ~Full_disk()
  {
    ::setrlimit(RLIMIT_FSIZE, &m_limit);
    std::signal(SIGXFSZ, m_handler);
  }

private:
  struct rlimit m_limit = {};
  void (*m_handler)(int) = nullptr;
};

const char* const names[] = {"m.obj", "m.off", "m.ply", "m.stl"};

TEST(AtomicFile, FullDiskLeavesTheOldFileAndNothingElse)
{
  const Triangle_soup soup = strip();
  for (const char* name : names) {
    SCOPED_TRACE(name);
    const Temporary_folder folder;
    write_file(folder / name, "what stood here");
    {
      const Full_disk full(100000);
      EXPECT_THROW(write_mesh(folder / name, soup), Output_error);
    }
    EXPECT_EQ(contents_of(folder / name), "what stood here");
    EXPECT_EQ(files_in(folder.path()), 1u);
    // Control: with room it does appear, and is longer than there was room for.
    write_mesh(folder / name, soup);
    EXPECT_GT(fs::file_size(folder / name), 100000u);
    EXPECT_EQ(files_in(folder.path()), 1u);
  }
}

TEST(AtomicFile, IsNotWrittenForASoupWhoseArraysDoNotFit)
{
  const auto expect_refused = [](const char* what, const auto& spoil) {
    SCOPED_TRACE(what);
    Triangle_soup soup = strip();
    const Index count = Index(soup.triangles.size());
    soup.groups = soup.materials = {std::vector<Index>(count, 0), {"a"}};
    soup.uvs = {{{0, 0}}, std::vector<Index_triple>(count, {0, 0, 0})};
    spoil(soup);
    for (const char* name : {"m.obj", "m.off", "m.ply", "m.stl", "m.glb"}) {
      const Temporary_folder folder;
      EXPECT_THROW(write_mesh(folder / name, soup), Argument_error) << name;
      EXPECT_EQ(files_in(folder.path()), 0u);
    }
  };
  expect_refused("labels", [](Triangle_soup& soup) { soup.groups.of_triangle.pop_back(); });
  expect_refused("name", [](Triangle_soup& soup) { soup.materials.of_triangle[7] = 1; });
  expect_refused("uvs", [](Triangle_soup& soup) { soup.uvs.of_triangle.pop_back(); });
  expect_refused("uv", [](Triangle_soup& soup) { soup.uvs.of_triangle[7][1] = 1; });
  expect_refused("not finite", [](Triangle_soup& soup) { soup.uvs.values[0][1] = std::nan(""); });
  expect_refused("corner", [](Triangle_soup& soup) { soup.triangles[7][1] = Index(soup.points.size()); });
  expect_refused("comment", [](Triangle_soup& soup) { soup.header_comments = {"a\nend_header"}; });
}

TEST(AtomicFile, FullDiskLeavesNoNewFile)
{
  const Temporary_folder folder;
  {
    const Full_disk full(1000);
    EXPECT_THROW(write_mesh(folder / "new.obj", strip()), Output_error);
  }
  EXPECT_EQ(files_in(folder.path()), 0u);
}

TEST(AtomicFile, FullDeviceIsAnOutputError)
{
  if (!fs::exists("/dev/full"))
    GTEST_SKIP() << "there is no /dev/full here";
  const Temporary_folder folder;
  fs::create_symlink("/dev/full", folder / "m.obj");
  EXPECT_THROW(write_mesh(folder / "m.obj", strip()), Output_error);
  EXPECT_TRUE(fs::is_symlink(folder / "m.obj"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(AtomicFile, ReadOnlyFolderIsAnOutputError)
{
  if (::geteuid() == 0)
    GTEST_SKIP() << "permissions do not bind the superuser";
  const Temporary_folder folder;
  write_file(folder / "m.obj", "what stood here");
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(write_mesh(folder / "m.obj", strip()), Output_error);
  fs::permissions(folder.path(), fs::perms::owner_all);
  EXPECT_EQ(contents_of(folder / "m.obj"), "what stood here");
}

TEST(AtomicFile, WriteProtectedFileIsAnOutputError)
{
  if (::geteuid() == 0)
    GTEST_SKIP() << "permissions do not bind the superuser";
  const Temporary_folder folder;
  write_file(folder / "m.obj", "what stood here");
  fs::permissions(folder / "m.obj", fs::perms::owner_read);
  EXPECT_THROW(write_mesh(folder / "m.obj", strip()), Output_error);
  EXPECT_EQ(contents_of(folder / "m.obj"), "what stood here");
}

TEST(AtomicFile, MissingFolderAndFolderAsTargetAreOutputErrors)
{
  const Temporary_folder folder;
  EXPECT_THROW(write_mesh(folder / "nowhere/m.obj", strip()), Output_error);
  fs::create_directory(folder / "folder.obj");
  EXPECT_THROW(write_mesh(folder / "folder.obj", strip()), Output_error);
  EXPECT_TRUE(fs::is_directory(folder / "folder.obj"));
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(AtomicFile, RefusedArgumentsLeaveTheOldFile)
{
  const Temporary_folder folder;
  write_file(folder / "m.stl", "what stood here");
  write_file(folder / "m.obj", "what stood here");
  Write_options big_endian, two_lines;
  big_endian.encoding = Encoding::binary_big_endian;
  two_lines.comments = {"one\nv 1 2 3"};
  EXPECT_THROW(write_mesh(folder / "m.stl", strip(), big_endian), Argument_error);
  EXPECT_THROW(write_mesh(folder / "m.obj", strip(), two_lines), Argument_error);
  Triangle_soup named = strip();
  named.groups.of_triangle.assign(named.triangles.size(), 0);
  for (const char* name : {" ", "a\nb", "a ", " a", "a\\"}) {
    named.groups.names = {name};
    EXPECT_THROW(write_mesh(folder / "m.obj", named), Argument_error) << name;
  }
  EXPECT_EQ(contents_of(folder / "m.stl"), "what stood here");
  EXPECT_EQ(contents_of(folder / "m.obj"), "what stood here");
  EXPECT_EQ(files_in(folder.path()), 2u);
}

TEST(AtomicFile, LinkIsFollowedAndPermissionsAreKept)
{
  const Temporary_folder folder;
  write_file(folder / "real.obj", "what stood here");
  fs::permissions(folder / "real.obj", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("real.obj", folder / "link.obj");
  write_mesh(folder / "link.obj", strip());
  EXPECT_TRUE(fs::is_symlink(folder / "link.obj"));
  EXPECT_EQ(read_mesh(folder / "real.obj").soup.triangles.size(), strip().triangles.size());
  EXPECT_EQ(fs::status(folder / "real.obj").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(AtomicFile, OwnerIsKept)
{
  if (::geteuid() != 0)
    GTEST_SKIP() << "only root may give a file to another owner";
  const Temporary_folder folder;
  const std::string name = (folder / "m.obj").string();
  write_file(name, "what stood here");
  ASSERT_EQ(::chown(name.c_str(), 1234, 1235), 0);
  write_mesh(name, strip());
  struct stat status = {};
  ASSERT_EQ(::stat(name.c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, 1234u);
  EXPECT_EQ(status.st_gid, 1235u);
}

TEST(AtomicFile, BareNameIsWrittenToTheCurrentFolder)
{
  const Temporary_folder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  write_mesh("m.off", strip());
  fs::current_path(before);
  EXPECT_EQ(read_mesh(folder / "m.off").soup.triangles, strip().triangles);
}

} // namespace
