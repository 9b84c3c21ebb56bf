// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/poses.h>

#include "files/Binary_reader.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/rounding.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

// MDD: the numbers of frames and of points (32-bit integers), the time of each frame, and the places of all
// points in each, as 32-bit floats; big-endian. PC2: "POINTCACHE2" and a zero byte, the version, the number
// of points, the first time and the time between frames, the number of frames, and the places; little-endian.

namespace selvedge {
namespace {

constexpr std::string_view s_pc2_mark("POINTCACHE2\0", 12);
constexpr std::size_t s_number = 4; // bytes

bool has_ending(const std::filesystem::path& path, std::string_view wanted)
{
  const std::string ending = path.extension().string();
  return std::equal(ending.begin(), ending.end(), wanted.begin(), wanted.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

bool is_mdd(const std::filesystem::path& path)
{
  return has_ending(path, ".mdd");
}

class Cache_reader
{
public:
  Cache_reader(const std::filesystem::path& path, const std::string& contents, const Triangle_soup& mesh)
      : m_name(path.string()), m_bytes(contents, is_mdd(path)), m_mesh(mesh)
  {
  }

  std::vector<Pose> read_mdd()
  {
    require(2 * s_number);
    const std::size_t frames = count("frames");
    check_points();
    require_rest(frames, s_number);
    std::vector<float> times;
    for (std::size_t frame = 0; frame < frames; ++frame)
      times.push_back(m_bytes.take<float>());
    return poses(times);
  }

  std::vector<Pose> read_pc2(std::string_view contents)
  {
    constexpr std::size_t header = s_pc2_mark.size() + 5 * s_number;
    require(header);
    if (contents.substr(0, s_pc2_mark.size()) != s_pc2_mark)
      refuse("does not begin with POINTCACHE2; it is no PC2 file");
    m_bytes.skip(s_pc2_mark.size());
    if (const auto version = m_bytes.take<std::int32_t>(); version != 1)
      refuse("has version " + std::to_string(version) + "; only version 1 is known");
    check_points();
    const float start = m_bytes.take<float>(), step = m_bytes.take<float>();
    const std::size_t frames = count("frames");
    require_rest(frames, 0);
    std::vector<float> times;
    for (std::size_t frame = 0; frame < frames; ++frame)
      times.push_back(start + float(frame) * step);
    return poses(times);
  }

private:
  [[noreturn]] void refuse(const std::string& problem) const { throw Input_error(m_name + ": " + problem); }

  void require(std::size_t bytes) const
  {
    if (m_bytes.remaining() < bytes)
      refuse("is too short for a point cache; export it again");
  }

  std::size_t count(const char* what)
  {
    const auto number = m_bytes.take<std::int32_t>();
    if (number < 1)
      refuse("says that it has " + std::to_string(number) + ' ' + what + "; export it again");
    return std::size_t(number);
  }

  void check_points()
  {
    if (const std::size_t points = count("points"); points != m_mesh.points.size())
      refuse("is no cache of the mesh: it has " + std::to_string(points) + " points, and the mesh has " +
             std::to_string(m_mesh.points.size()) +
             " vertices; export both from one mesh, without changing it in between");
  }

  void require_rest(std::size_t frames, std::size_t bytes_more) const
  {
    const std::size_t bytes = bytes_more + 3 * s_number * m_mesh.points.size(); // of a frame
    if (m_bytes.remaining() % bytes != 0 || m_bytes.remaining() / bytes != frames)
      refuse("has " + std::to_string(m_bytes.remaining()) + " bytes after its header, and is to have " +
             std::to_string(frames) + " frames of " + std::to_string(bytes) +
             " bytes; it is truncated or damaged, export it again");
  }

  std::vector<Pose> poses(const std::vector<float>& times)
  {
    std::vector<Pose> result;
    Cancellation_poll poll;
    for (const float time : times) {
      Pose& pose = result.emplace_back();
      pose.name = "frame_" + std::to_string(result.size());
      pose.time = time;
      pose.points.reserve(m_mesh.points.size());
      for (std::size_t v = 0; v < m_mesh.points.size(); ++v) {
        poll();
        const double x = m_bytes.take<float>(), y = m_bytes.take<float>(), z = m_bytes.take<float>();
        if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
          refuse("point " + std::to_string(v + 1) + " of frame " + std::to_string(result.size()) +
                 " has a coordinate that is not finite");
        pose.points.emplace_back(x, y, z);
      }
    }
    return result;
  }

  std::string m_name;
  files::Binary_reader m_bytes;
  const Triangle_soup& m_mesh;
};

void append(std::string& bytes, std::uint32_t number, bool is_big_endian)
{
  for (std::size_t i = 0; i < s_number; ++i)
    bytes += char(number >> 8 * (is_big_endian ? s_number - 1 - i : i) & 0xff);
}

void append(std::string& bytes, float number, bool is_big_endian)
{
  std::uint32_t bits;
  std::memcpy(&bits, &number, sizeof bits);
  append(bytes, bits, is_big_endian);
}

} // namespace

bool is_point_cache(const std::filesystem::path& path)
{
  return is_mdd(path) || has_ending(path, ".pc2");
}

std::vector<Pose> read_point_cache(const std::filesystem::path& path, const Triangle_soup& mesh)
{
  const std::string contents = read_file(path);
  Cache_reader reader(path, contents, mesh);
  return is_mdd(path) ? reader.read_mdd() : reader.read_pc2(contents);
}

void write_point_cache(const std::filesystem::path& path, const Triangle_soup& mesh)
{
  const std::vector<Pose>& poses = mesh.poses;
  if (poses.empty())
    throw Argument_error(path.string() + ": a mesh without further poses has no point cache");
  const bool is_big_endian = is_mdd(path);
  std::string bytes;
  const auto put = [&](auto number) { append(bytes, number, is_big_endian); };
  if (is_mdd(path)) {
    put(std::uint32_t(poses.size()));
    put(std::uint32_t(mesh.points.size()));
    for (const Pose& pose : poses)
      put(pose.time);
  } else {
    bytes = s_pc2_mark;
    put(std::uint32_t(1));
    put(std::uint32_t(mesh.points.size()));
    put(poses.front().time);
    put(poses.size() > 1 ? poses[1].time - poses[0].time : 1.0f);
    put(std::uint32_t(poses.size()));
  }
  for (const Pose& pose : poses) {
    if (!has_float32_points(pose.points))
      throw Argument_error(
          path.string() + ": the pose '" + pose.name +
          "' has a coordinate that is no 32-bit float, and point caches hold only such; round "
          "the mesh first");
    for (const Point_3& point : pose.points)
      for (int axis = 0; axis < 3; ++axis)
        put(float(point[axis]));
  }
  write_file(path, bytes);
}

} // namespace selvedge
