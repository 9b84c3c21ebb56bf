// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_ROUND_TRIP_H
#define SELVEDGE_TEST_SUPPORT_ROUND_TRIP_H

#include "support/Temporary_folder.h"
#include "support/soups.h"

#include "progressive/lists.h"
#include "soup/selection.h"
#include <selvedge/Error.h>
#include <selvedge/collapse_log.h>
#include <selvedge/mesh_files.h>
#include <selvedge/rounding.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace selvedge::test {

/// Says what a reader or a writer did that it must not do.
struct Broken_promise : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

inline void promise(bool is_kept, const std::string& what)
{
  if (!is_kept)
    throw Broken_promise(what);
}

inline bool are_same_bits(double a, double b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// The sign and the payload of what is no number are not kept in text.
inline bool are_same_number(double a, double b)
{
  return are_same_bits(a, b) || (std::isnan(a) && std::isnan(b));
}

/// What `Triangle_soup` says of every soup, and the readers of those that they make.
inline void expect_sound(const Triangle_soup& soup)
{
  const auto is_finite = [](const auto& numbers) {
    for (const double number : numbers)
      if (!std::isfinite(number))
        return false;
    return true;
  };
  promise(!soup.triangles.empty(), "there are no triangles");
  for (const Point_3& p : soup.points)
    promise(is_finite(std::array{p.x(), p.y(), p.z()}), "a coordinate is not finite");
  for (const Index_triple& triangle : soup.triangles)
    for (const Index v : triangle)
      promise(v < soup.points.size(), "a triangle names a vertex that is not there");
  for (const auto& uv : soup.uvs.values)
    promise(is_finite(uv), "a texture coordinate is not finite");
  const auto expect_values = [&](const auto& values, const std::string& name) {
    promise(values.empty() || values.of_triangle.size() == soup.triangles.size(), name + " do not fit");
    for (const Index_triple& corners : values.of_triangle)
      for (const Index number : corners)
        promise(number < values.values.size(), "a corner names one of the " + name + " that is not there");
    promise(!values.missing || *values.missing < values.values.size(), "no " + name + " stand for none");
  };
  expect_values(soup.uvs, "texture coordinates");
  expect_values(soup.normals, "normals");
  for (const auto* labels : {&soup.groups, &soup.objects, &soup.materials, &soup.smoothing_groups}) {
    promise(labels->empty() || labels->of_triangle.size() == soup.triangles.size(), "labels do not fit");
    for (const Index label : labels->of_triangle)
      promise(label < labels->names.size(), "a triangle has a label that is not there");
  }
  for (const Attribute& attribute : soup.vertex_attributes)
    promise(attribute.rows.size() == soup.points.size() * row_size(attribute),
            "the vertex attribute '" + attribute.name + "' does not fit");
  for (const Attribute& attribute : soup.triangle_attributes)
    promise(attribute.rows.size() == soup.triangles.size() * row_size(attribute),
            "the face attribute '" + attribute.name + "' does not fit");
}

/// Compares two soups, the second of which was read from what was written of the first. Vertices are compared
/// by number, or, where a format keeps none, at the corners of triangles; numbers of labels and values never.
class Soup_comparison
{
public:
  Soup_comparison(const Triangle_soup& first, const Triangle_soup& second, Mesh_format format)
      : m_first(first), m_second(second), m_is_stl(format == Mesh_format::stl),
        m_is_gltf(format == Mesh_format::glb || format == Mesh_format::gltf),
        m_is_numbered(!m_is_stl && !m_is_gltf &&
                      !(format == Mesh_format::ply && has_vertices_of_several_normals(first)))
  {
  }

  void run() const
  {
    promise(m_first.triangles.size() == m_second.triangles.size(), "the number of triangles changes");
    promise(!m_is_numbered ||
                (m_first.triangles == m_second.triangles && m_first.points.size() == m_second.points.size()),
            "numbers of vertices change");
    for_each_pair_of_vertices([this](std::size_t v, std::size_t w) {
      for (int axis = 0; axis < 3; ++axis) {
        const double a = m_first.points[v][axis], b = m_second.points[w][axis];
        promise(are_same_bits(a, b) || (m_is_stl && a == b), "a coordinate changes");
      }
    });
    expect_same_values(m_first.uvs, m_second.uvs, "texture coordinates");
    expect_same_values(m_first.normals, m_second.normals, "normals");
    if (!m_is_gltf) // where they are named by numbers of what is left
      expect_same_labels(m_first.groups, m_second.groups, "groups");
    expect_same_labels(m_first.objects, m_second.objects, "objects");
    expect_same_labels(m_first.materials, m_second.materials, "materials");
    expect_same_labels(m_first.smoothing_groups, m_second.smoothing_groups, "smoothing groups");
    expect_same_attributes(m_first.vertex_attributes, m_second.vertex_attributes,
                           [this](const auto& function) { for_each_pair_of_vertices(function); });
    expect_same_attributes(m_first.triangle_attributes, m_second.triangle_attributes,
                           [this](const auto& function) {
                             for (std::size_t t = 0; t < m_first.triangles.size(); ++t)
                               function(t, t);
                           });
    promise(m_first.material_libraries == m_second.material_libraries, "material libraries change");
    promise(m_first.header_comments == m_second.header_comments, "comments of the header change");
  }

private:
  template <class Function>
  void for_each_pair_of_vertices(const Function& function) const
  {
    if (m_is_numbered)
      for (std::size_t v = 0; v < m_first.points.size(); ++v)
        function(v, v);
    else
      for (std::size_t t = 0; t < m_first.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
          function(m_first.triangles[t][k], m_second.triangles[t][k]);
  }

  template <std::size_t dimension>
  void expect_same_values(const Corner_values<dimension>& first, const Corner_values<dimension>& second,
                          const std::string& name) const
  {
    const auto value = [](const Corner_values<dimension>& values, std::size_t t, std::size_t k) {
      const bool has_one = !values.empty() && values.of_triangle[t][k] != values.missing;
      return has_one ? &values.values[values.of_triangle[t][k]] : nullptr;
    };
    for (std::size_t t = 0; t < m_first.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto *const a = value(first, t, k), *const b = value(second, t, k);
        promise((a == nullptr) == (b == nullptr), name + " come or go");
        for (std::size_t i = 0; a && i < dimension; ++i)
          promise(are_same_number((*a)[i], (*b)[i]), name + " change");
      }
  }

  void expect_same_labels(const Triangle_labels& first, const Triangle_labels& second,
                          const std::string& name) const
  {
    const auto label = [](const Triangle_labels& labels, std::size_t t) {
      return labels.empty() ? std::string() : labels.names[labels.of_triangle[t]];
    };
    for (std::size_t t = 0; t < m_first.triangles.size(); ++t)
      promise(label(first, t) == label(second, t), name + " change");
  }

  template <class For_each_pair_of_rows>
  static void expect_same_attributes(const std::vector<Attribute>& first,
                                     const std::vector<Attribute>& second,
                                     const For_each_pair_of_rows& for_each_pair_of_rows)
  {
    promise(first.size() == second.size(), "attributes come or go");
    for (std::size_t i = 0; i < first.size(); ++i) {
      const Attribute &a = first[i], &b = second[i];
      promise(a.name == b.name && a.type == b.type && a.components == b.components &&
                  a.is_normalized == b.is_normalized,
              "the attribute '" + a.name + "' becomes '" + b.name + "', or of another type");
      for_each_pair_of_rows([&](std::size_t row, std::size_t other) {
        promise(is_same_row(a, row, b, other), "numbers of the attribute '" + a.name + "' change");
      });
    }
  }

  static bool is_same_row(const Attribute& a, std::size_t row, const Attribute& b, std::size_t other)
  {
    const std::size_t size = row_size(a);
    const unsigned char *const p = a.rows.data() + row * size, *const q = b.rows.data() + other * size;
    if (std::memcmp(p, q, size) == 0)
      return true;
    const auto are_same = [&](auto number) {
      for (std::size_t at = 0; at < size; at += sizeof number) {
        auto x = number, y = number;
        std::memcpy(&x, p + at, sizeof x);
        std::memcpy(&y, q + at, sizeof y);
        if (std::memcmp(&x, &y, sizeof x) != 0 && !(std::isnan(x) && std::isnan(y)))
          return false;
      }
      return true;
    };
    return (a.type == Attribute::Type::float32 && are_same(float())) ||
           (a.type == Attribute::Type::float64 && are_same(double()));
  }

  const Triangle_soup &m_first, &m_second;
  bool m_is_stl, m_is_gltf, m_is_numbered;
};

/// Reads what may be a mesh. What is refused is refused in one line; what is read is sound, can be written in
/// its own format, in every encoding, is the same when it is read again, and is then written as the same
/// bytes. Else throws `Broken_promise`. Returns whether it was read.
inline bool judge_mesh(std::string_view contents, Mesh_format format)
{
  static const Temporary_folder folder;
  static const char* const names[] = {"m.obj", "m.off", "m.ply", "m.stl", "m.glb", "m.gltf"};
  const std::filesystem::path path = folder / names[std::size_t(format)];
  Triangle_soup first;
  try {
    first = read_mesh(contents, format, "input").soup;
    expect_sound(first);
    if (needs_float32(first, format))
      round_to_float32(first);
  } catch (const Input_error& error) {
    promise(std::string_view(error.what()).find('\n') == std::string_view::npos,
            "a message is more than one line");
    return false;
  }
  const auto written = [&](const Triangle_soup& soup, const Write_options& options) {
    write_mesh(path, soup, options);
    std::ifstream stream(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  std::vector<Encoding> encodings{Encoding::binary};
  if (format == Mesh_format::ply || format == Mesh_format::stl)
    encodings.push_back(Encoding::ascii);
  if (format == Mesh_format::ply)
    encodings.push_back(Encoding::binary_big_endian);
  for (const Encoding encoding : encodings) {
    Write_options options;
    options.encoding = encoding;
    std::string bytes;
    try {
      // Compressed glTF keeps the order of a mesh that has further poses.
      Triangle_soup in_order = first;
      in_order.poses = {{"the same", first.points, 0}};
      bytes = written(in_order, options);
    } catch (const Argument_error& error) {
      throw Broken_promise(std::string("what was read cannot be written: ") + error.what());
    }
    Triangle_soup second;
    try {
      second = read_mesh(bytes, format, "output").soup;
    } catch (const Input_error& error) {
      throw Broken_promise(std::string("what was written cannot be read: ") + error.what());
    }
    expect_sound(second);
    Soup_comparison(first, second, format).run();
    // A zero in an STL file may lose its sign, and a glTF document may number its accessors anew.
    const bool is_text_kept =
        format == Mesh_format::obj || format == Mesh_format::off || format == Mesh_format::ply;
    promise(!is_text_kept || written(second, options) == bytes, "what is written changes");
  }
  return true;
}

/// Makes levels of a progressive file in glTF, whatever its digest is. Returns false when it is refused.
inline bool judge_progressive(std::string_view contents)
{
  try {
    const Progressive_mesh mesh = progressive::read(contents, Mesh_format::gltf, "input", false);
    expect_sound(mesh.soup);
    for (const std::size_t steps : {std::size_t(0), mesh.step_count() / 2, mesh.step_count()})
      if (const Triangle_soup soup = level(mesh, steps); !soup.triangles.empty())
        expect_sound(soup);
  } catch (const Input_error&) {
    return false;
  }
  return true;
}

/// The same for a log of collapses.
inline bool judge_log(std::string_view contents)
{
  struct Log
  {
    Log_header header;
    std::vector<Log_step> steps;
    Log_result result;
  };
  const auto read = [](const std::string& text) {
    Log log;
    std::istringstream stream(text);
    Log_reader reader(stream, "log");
    log.header = reader.header();
    for (Log_step step; reader.read(step);)
      log.steps.push_back(step);
    log.result = reader.result();
    return log;
  };
  const auto written = [](const Log& log) {
    std::ostringstream stream;
    Log_writer writer(stream, log.header);
    for (const Log_step& step : log.steps)
      writer.write(step);
    writer.write(log.result);
    return stream.str();
  };
  Log first;
  try {
    first = read(std::string(contents));
  } catch (const Input_error& error) {
    promise(std::string_view(error.what()).find('\n') == std::string_view::npos,
            "a message is more than one line");
    return false;
  }
  const std::string text = written(first);
  Log second;
  try {
    second = read(text);
  } catch (const Input_error& error) {
    throw Broken_promise(std::string("what was written cannot be read: ") + error.what());
  }
  promise(first.steps.size() == second.steps.size(), "the number of steps changes");
  for (std::size_t i = 0; i < first.steps.size(); ++i) {
    const Log_step &a = first.steps[i], &b = second.steps[i];
    promise(a.kind == b.kind && a.group == b.group, "a step changes");
    promise(a.kind == Log_step::Kind::weld || a.kind == Log_step::Kind::turn ||
                (a.removed == b.removed && a.kept == b.kept),
            "a step changes");
    promise(a.place.has_value() == b.place.has_value(), "a place comes or goes");
    promise(!a.place || a.is_removed_first == b.is_removed_first, "an order changes");
    for (std::size_t k = 0; a.place && k < 3; ++k)
      promise(are_same_bits((*a.place)[k], (*b.place)[k]), "a place changes");
  }
  promise(written(second) == text, "what is written changes");
  return true;
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_ROUND_TRIP_H
