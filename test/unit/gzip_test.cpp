// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Files in .gz: read and written as those without, and refused when they are damaged.

#include "support/Temporary_folder.h"

#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace selvedge::test {
namespace {

namespace fs = std::filesystem;

/// A strip of triangles in a few thousand bytes.
Triangle_soup strip_of_gzip_test(Index vertices)
{
  Triangle_soup soup;
  for (Index i = 0; i < vertices; ++i)
    soup.points.emplace_back(i * 0.25, i % 2, i % 7);
  for (Index i = 0; i + 2 < vertices; ++i)
    soup.triangles.push_back({i, i + 1, i + 2});
  return soup;
}

std::string bytes(const fs::path& path)
{
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Writes bytes as they are, whatever the name ends in.
void put_bytes(const fs::path& path, const std::string& contents)
{
  std::ofstream(path, std::ios::binary) << contents;
}

bool run_gzip(const std::string& arguments)
{
  return std::system(("gzip " + arguments).c_str()) == 0;
}

TEST(Gzip, NamesAFormatAsTheNameWithoutItDoes)
{
  EXPECT_EQ(mesh_format("a.obj/x.Off.GZ"), Mesh_format::off);
  EXPECT_EQ(mesh_format("x.y.ply.gz"), Mesh_format::ply);
  EXPECT_EQ(mesh_format("x.vrm.gz"), Mesh_format::glb);
  for (const char* path : {"x.gz", ".obj.gz", "x.obj.gz.gz", "x.obj.zip", "gz", "x.objgz"})
    EXPECT_THROW(mesh_format(path), Input_error) << path;
}

TEST(Gzip, ReadsBackWhatWasWritten)
{
  const Temporary_folder folder;
  const Triangle_soup soup = strip_of_gzip_test(20'000);
  for (const std::string name : {"m.obj", "m.off", "m.ply", "m.stl", "m.glb", "m.gltf"}) {
    SCOPED_TRACE(name);
    write_mesh(folder / name, soup);
    write_mesh(folder / (name + ".gz"), soup);
    EXPECT_LT(fs::file_size(folder / (name + ".gz")), fs::file_size(folder / name));
    EXPECT_EQ(read_file(folder / (name + ".gz")), bytes(folder / name));
    EXPECT_EQ(read_mesh(folder / (name + ".gz")).soup.triangles, read_mesh(folder / name).soup.triangles);
    EXPECT_EQ(read_mesh(folder / (name + ".gz")).soup.points, read_mesh(folder / name).soup.points);
    // The tool of this name agrees.
    EXPECT_TRUE(run_gzip("-t " + (folder / (name + ".gz")).string()));
    // Nothing but the mesh is in the file.
    const std::string first = bytes(folder / (name + ".gz"));
    write_mesh(folder / ("again_" + name + ".gz"), soup);
    EXPECT_EQ(bytes(folder / ("again_" + name + ".gz")), first);
  }
}

TEST(Gzip, ReadsWhatGzipPacksAndFilesOfSeveralParts)
{
  const Temporary_folder folder;
  write_mesh(folder / "m.obj", strip_of_gzip_test(5000));
  const std::string contents = bytes(folder / "m.obj");
  put_bytes(folder / "a", contents.substr(0, contents.size() / 2));
  put_bytes(folder / "b", contents.substr(contents.size() / 2));
  for (const std::string name : {"a", "b"})
    ASSERT_TRUE(run_gzip((name == "a" ? "-1 " : "-9 ") + (folder / name).string()));
  put_bytes(folder / "parts.obj.gz",
            bytes(folder / "a.gz") + bytes(folder / "b.gz") + std::string(1000, '\0'));
  EXPECT_EQ(read_file(folder / "parts.obj.gz"), contents);
  EXPECT_EQ(read_mesh(folder / "parts.obj.gz").soup.triangles.size(), 4998u);
}

TEST(Gzip, RefusesDamageAtAnyPlace)
{
  const Temporary_folder folder;
  const fs::path path = folder / "m.obj.gz";
  write_mesh(path, strip_of_gzip_test(12));
  const std::string packed = bytes(path), contents = read_file(path);
  const auto expect_refused = [&](const std::string& what) {
    try {
      EXPECT_EQ(read_file(path), contents) << what; // the head has bytes that mean nothing
      return 0;
    } catch (const Input_error& error) {
      EXPECT_EQ(std::string(error.what()).rfind(path.string() + ": ", 0), 0u) << error.what();
      return 1;
    }
  };
  for (std::size_t size = 1; size < packed.size(); ++size) {
    put_bytes(path, packed.substr(0, size));
    EXPECT_EQ(expect_refused("cut to " + std::to_string(size)), 1) << size;
  }
  std::size_t refused = 0;
  for (std::size_t bit = 0; bit < 8 * packed.size(); ++bit) {
    std::string damaged = packed;
    damaged[bit / 8] = char(damaged[bit / 8] ^ (1 << bit % 8));
    put_bytes(path, damaged);
    refused += std::size_t(expect_refused("bit " + std::to_string(bit)));
  }
  EXPECT_GT(refused, 8 * packed.size() - 100);
  put_bytes(path, packed + "more");
  EXPECT_EQ(expect_refused("bytes behind the end"), 1);
}

TEST(Gzip, SaysWhatIsWrongWithAFile)
{
  const Temporary_folder folder;
  write_mesh(folder / "m.obj", strip_of_gzip_test(600));
  const std::string plain = bytes(folder / "m.obj");
  write_mesh(folder / "m.obj.gz", strip_of_gzip_test(600));
  const std::string packed = bytes(folder / "m.obj.gz");
  std::string damaged = packed;
  damaged[damaged.size() - 6] ^= 1; // in the check sum
  const std::pair<std::string, const char*> files[] = {{plain, "is not packed by gzip"},
                                                       {packed.substr(0, packed.size() / 2), "is truncated"},
                                                       {packed.substr(0, packed.size() - 4), "is truncated"},
                                                       {damaged, "is damaged"},
                                                       {"", "is empty"}};
  for (const auto& [contents, what] : files)
    try {
      put_bytes(folder / "m.obj.gz", contents);
      read_mesh(folder / "m.obj.gz");
      ADD_FAILURE() << what;
    } catch (const Input_error& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
}

TEST(Gzip, RefusesAFileThatIsFarTooLargeUnpacked)
{
  const Temporary_folder folder;
  put_bytes(folder / "bomb.obj", std::string(8 << 20, '\n'));
  ASSERT_TRUE(run_gzip((folder / "bomb.obj").string()));
  const std::size_t packed = fs::file_size(folder / "bomb.obj.gz");
  ASSERT_GT((8u << 20) / packed, 900u);
  try {
    read_file(folder / "bomb.obj.gz");
    ADD_FAILURE() << "it was unpacked";
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find("more than 100 times as large"), std::string::npos)
        << error.what();
  }
  // Parts count together.
  const std::string bomb = bytes(folder / "bomb.obj.gz");
  put_bytes(folder / "parts.obj.gz", bomb + bomb);
  EXPECT_THROW(read_file(folder / "parts.obj.gz"), Input_error);
  // Control: blanks in the measure of a small file do no harm.
  put_bytes(folder / "small.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" + std::string(60'000, '\n'));
  ASSERT_TRUE(run_gzip((folder / "small.obj").string()));
  EXPECT_EQ(read_mesh(folder / "small.obj.gz").soup.triangles.size(), 1u);
}

} // namespace
} // namespace selvedge::test
