// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The compiled part of the Python package: arrays in, arrays out. What a user calls is in
// selvedge/__init__.py.

#include "bindings/run/Reduction.h"
#include "bindings/run/Verdict.h"
#include "bindings/run/soup_of.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/generate.h>
#include <selvedge/key_poses.h>

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace py = pybind11;
using namespace selvedge;

namespace {

using Points = py::array_t<double, py::array::c_style>;
using Triangles = py::array_t<Index, py::array::c_style>;
using Mesh_arrays = std::pair<Points, Triangles>;
// Values of corners, and for each triangle the numbers of three.
using Corner_arrays = std::optional<std::pair<Points, Triangles>>;
using Options = std::vector<std::pair<std::string, std::string>>;
using Progress = std::function<bool(std::size_t, std::size_t, std::size_t)>;

static_assert(sizeof(Point_3) == 3 * sizeof(double), "points are shown as rows of three doubles");

/// Work without the GIL. From time to time the calling thread looks for signals, and for what a callback of
/// Python has thrown; either ends the work.
class Work
{
public:
  /// Returns what `function` returns. An exception of Python passes through, KeyboardInterrupt among them.
  template <class Function>
  auto run(const Function& function)
  {
    try {
      auto result = [&] {
        const py::gil_scoped_release release;
        const Cancellation_scope scope([this] { return is_ended(); });
        return function();
      }();
      if (m_error) // too late to end anything
        throw Interrupted("interrupted");
      return result;
    } catch (const Interrupted&) {
      if (m_error)
        throw std::move(*m_error);
      throw;
    }
  }

  /// Calls back with the GIL; true when the work is to end with what it has reached. At most 20 times a
  /// second.
  bool report(const Progress& progress, const Simplify_progress& now)
  {
    const auto time = Clock::now();
    if (!progress || (m_last_report && time - *m_last_report < s_pause))
      return false;
    m_last_report = time;
    const py::gil_scoped_acquire acquire;
    try {
      return progress(now.faces_input, now.faces_target, now.faces);
    } catch (py::error_already_set& error) {
      end(std::move(error));
      return false;
    }
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds s_pause{50};

  bool is_ended()
  {
    if (m_is_ended || std::this_thread::get_id() != m_thread) // signals are for the main thread
      return m_is_ended;
    if (const auto time = Clock::now(); time - m_last_look >= s_pause) {
      m_last_look = time;
      const py::gil_scoped_acquire acquire;
      if (PyErr_CheckSignals() != 0)
        end(py::error_already_set());
    }
    return m_is_ended;
  }

  void end(py::error_already_set error)
  {
    m_error = std::make_unique<py::error_already_set>(std::move(error));
    m_is_ended = true;
  }

  const std::thread::id m_thread = std::this_thread::get_id();
  Clock::time_point m_last_look = Clock::now();
  std::optional<Clock::time_point> m_last_report;
  std::unique_ptr<py::error_already_set> m_error;
  std::atomic<bool> m_is_ended = false;
};

template <class Array>
auto rows(const Array& array, const char* name)
{
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw Argument_error(std::string(name) + " is not an array of shape (n, 3)");
  return array.template unchecked<2>();
}

Point_3 point_at(const Points& points, std::size_t v)
{
  const double* const point = points.data(py::ssize_t(v), 0);
  return {point[0], point[1], point[2]};
}

std::vector<Point_3> points_of(const Points& points)
{
  std::vector<Point_3> result;
  const auto count = std::size_t(rows(points, "points").shape(0));
  result.reserve(count);
  for (std::size_t v = 0; v < count; ++v)
    result.push_back(point_at(points, v));
  return result;
}

Triangle_soup soup_of(const Points& points, const Triangles& triangles)
{
  rows(points, "points");
  rows(triangles, "triangles");
  return bindings::soup_of(
      std::size_t(points.shape(0)), triangles.data(), std::size_t(triangles.size()),
      [&](std::size_t v) { return point_at(points, v); }, [](std::size_t v) { return v; });
}

/// Returns values of corners: rows of `dimension` numbers, and for each triangle the numbers of three rows.
/// None are given without arrays. `name` is for messages.
template <std::size_t dimension>
Corner_values<dimension> corner_values_of(const Corner_arrays& arrays, std::size_t triangles,
                                          const std::string& name)
{
  Corner_values<dimension> result;
  if (!arrays)
    return result;
  const auto& [values, numbers] = *arrays;
  if (values.ndim() != 2 || values.shape(1) != py::ssize_t(dimension))
    throw Argument_error(name + ": the values are not an array of shape (k, " + std::to_string(dimension) +
                         ")");
  if (numbers.ndim() != 2 || numbers.shape(1) != 3 || std::size_t(numbers.shape(0)) != triangles)
    throw Argument_error(name + ": the numbers of values are not an array of shape (" +
                         std::to_string(triangles) + ", 3), with a row for each triangle");
  result.values.resize(std::size_t(values.shape(0)));
  for (std::size_t i = 0; i < result.values.size(); ++i)
    for (std::size_t k = 0; k < dimension; ++k) {
      result.values[i][k] = values.at(py::ssize_t(i), py::ssize_t(k));
      if (!std::isfinite(result.values[i][k]))
        throw Argument_error(name + ": the value " + std::to_string(i) + ", counted from 0, is not finite");
    }
  result.of_triangle.resize(triangles);
  for (std::size_t t = 0; t < triangles; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index value = result.of_triangle[t][k] = numbers.at(py::ssize_t(t), py::ssize_t(k));
      if (value >= result.values.size())
        throw Argument_error(name + ": triangle " + std::to_string(t) + ", counted from 0, has the value " +
                             std::to_string(value) + ", but there are " +
                             std::to_string(result.values.size()));
    }
  return result;
}

/// What the corners of a mesh and its triangles have.
struct Labels
{
  Corner_arrays uvs, normals;
  std::vector<Index> groups; // by triangle
  std::vector<std::string> group_names;
};

void add_poses(Triangle_soup& soup, const std::vector<Points>& poses)
{
  for (const Points& pose : poses)
    soup.poses.push_back({"pose_" + std::to_string(soup.poses.size() + 1), points_of(pose)});
}

/// An array of `columns` columns that owns `values` without copying them.
template <class Number, class Value>
py::array_t<Number> array_of(std::vector<Value> values, py::ssize_t columns = 1)
{
  auto* const owned = new std::vector<Value>(std::move(values));
  const py::capsule owner(owned, [](void* pointer) { delete static_cast<std::vector<Value>*>(pointer); });
  std::vector<py::ssize_t> shape{py::ssize_t(owned->size())};
  if (columns > 1)
    shape.push_back(columns);
  return py::array_t<Number>(shape, reinterpret_cast<const Number*>(owned->data()), owner);
}

py::tuple arrays_of(Triangle_soup soup)
{
  return py::make_tuple(array_of<double>(std::move(soup.points), 3),
                        array_of<Index>(std::move(soup.triangles), 3));
}

Triangle_labels labels_of(const std::vector<Index>& of_triangle, const std::vector<std::string>& names)
{
  for (const Index name : of_triangle)
    if (name >= names.size())
      throw Argument_error("groups: a triangle has no name");
  return {of_triangle, names};
}

/// A type of numbers that attributes have, as NumPy has it.
struct Number_type
{
  Attribute::Type type;
  py::dtype dtype;
};

const std::vector<Number_type>& number_types()
{
  using Type = Attribute::Type;
  // They are never destroyed, since Python may be gone by then.
  static const auto* const s_types = new std::vector<Number_type>{
      {Type::int8, py::dtype::of<std::int8_t>()},   {Type::uint8, py::dtype::of<std::uint8_t>()},
      {Type::int16, py::dtype::of<std::int16_t>()}, {Type::uint16, py::dtype::of<std::uint16_t>()},
      {Type::int32, py::dtype::of<std::int32_t>()}, {Type::uint32, py::dtype::of<std::uint32_t>()},
      {Type::float32, py::dtype::of<float>()},      {Type::float64, py::dtype::of<double>()}};
  return *s_types;
}

/// Returns the values of vertices in an array with a row for each. Throws `Argument_error`.
Attribute attribute_of(const std::string& name, const py::array& given, std::size_t vertices)
{
  const py::array values = py::array::ensure(given, py::array::c_style);
  const auto fail = [&](const std::string& why) {
    throw Argument_error("attributes: '" + name + "' " + why);
  };
  if ((values.ndim() != 1 && values.ndim() != 2) || std::size_t(values.shape(0)) != vertices)
    fail("has no row for each of the " + std::to_string(vertices) + " vertices");
  const auto type =
      std::find_if(number_types().begin(), number_types().end(),
                   [&](const Number_type& number) { return number.dtype.equal(values.dtype()); });
  if (type == number_types().end())
    fail("has the type " + std::string(py::str(values.dtype())) +
         ", and not one of floats of 32 or 64 bits or of whole numbers of 8, 16 or 32 bits");
  Attribute attribute;
  attribute.name = name;
  attribute.type = type->type;
  attribute.components = values.ndim() == 1 ? 1 : std::uint32_t(values.shape(1));
  const auto* const bytes = static_cast<const unsigned char*>(values.data());
  attribute.rows.assign(bytes, bytes + values.nbytes());
  return attribute;
}

py::array array_of(const Attribute& attribute)
{
  const auto type = std::find_if(number_types().begin(), number_types().end(),
                                 [&](const Number_type& number) { return number.type == attribute.type; });
  const py::ssize_t row = type->dtype.itemsize() * py::ssize_t(attribute.components);
  return py::array(type->dtype, {py::ssize_t(attribute.rows.size()) / row, py::ssize_t(attribute.components)},
                   attribute.rows.data());
}

void add_labels(Triangle_soup& soup, const Labels& labels)
{
  soup.uvs = corner_values_of<2>(labels.uvs, soup.triangles.size(), "uvs");
  soup.normals = corner_values_of<3>(labels.normals, soup.triangles.size(), "normals");
  if (!labels.groups.empty())
    soup.groups = labels_of(labels.groups, labels.group_names);
}

constexpr const char* s_weights = "weights"; // the attribute that holds the costs of vertices

/// One level of a reduction.
class Result
{
public:
  Result(std::shared_ptr<const bindings::Reduction> reduction, std::size_t level)
      : m_reduction(std::move(reduction)), m_level(level)
  {
  }

  py::tuple mesh() const
  {
    return py::make_tuple(array_of<double>(std::vector<Point_3>(soup().points), 3),
                          array_of<Index>(std::vector<Index_triple>(soup().triangles), 3));
  }
  py::object uvs() const { return values_of(soup().uvs); }
  py::object normals() const { return values_of(soup().normals); }
  py::dict attributes() const
  {
    py::dict result;
    for (const Attribute& attribute : soup().vertex_attributes)
      if (attribute.name != s_weights)
        result[py::str(attribute.name)] = array_of(attribute);
    return result;
  }
  py::array_t<Index> vertices() const { return array_of<Index>(m_reduction->vertices(m_level)); }
  py::array_t<Index> triangles() const { return array_of<Index>(m_reduction->triangles(m_level)); }
  py::array_t<Index> collapses() const
  {
    std::vector<Index_triple::value_type> pairs;
    for (const Soup_collapse& collapse : m_reduction->collapses(m_level))
      pairs.insert(pairs.end(), {Index(collapse.removed), Index(collapse.kept)});
    return array_of<Index>(std::move(pairs)).reshape({-1, 2});
  }
  std::string log() const { return m_reduction->log(m_level); }
  std::string report() const
  {
    return Work().run([this] { return m_reduction->report(m_level); });
  }
  bool is_accepted() const { return m_reduction->is_accepted(m_level); }
  bool is_reached() const { return m_reduction->is_reached(m_level); }
  bool is_stopped() const { return m_reduction->is_stopped(m_level); }

private:
  const Triangle_soup& soup() const { return m_reduction->soup(m_level); }

  // Returns values and, for each triangle, the numbers of three of them; None where there are none.
  template <std::size_t dimension>
  static py::object values_of(const Corner_values<dimension>& of_corners)
  {
    if (of_corners.empty())
      return py::none();
    return py::make_tuple(
        array_of<double>(std::vector<std::array<double, dimension>>(of_corners.values), dimension),
        array_of<Index>(std::vector<Index_triple>(of_corners.of_triangle), 3));
  }

  std::shared_ptr<const bindings::Reduction> m_reduction;
  std::size_t m_level;
};

/// Returns a result for each level of detail; one, if none are asked for.
std::vector<Result>
reduce(const Points& points, const Triangles& triangles, const Options& options, const Labels& labels,
       bool has_normals_of_vertices, const std::vector<std::pair<std::string, py::array>>& attributes,
       const std::vector<Index>& locked, const std::optional<std::vector<double>>& weights,
       const std::optional<Mesh_arrays>& obstacle, const std::vector<Points>& poses, const Progress& progress)
{
  Triangle_soup soup = soup_of(points, triangles);
  add_poses(soup, poses);
  bindings::Reduction_request request;
  for (const auto& [name, value] : options)
    request.set(name, value);
  add_labels(soup, labels);
  for (const auto& [name, values] : attributes) {
    if (name == s_weights)
      throw Argument_error("attributes: 'weights' are the costs of vertices; give another name");
    soup.vertex_attributes.push_back(attribute_of(name, values, soup.points.size()));
  }
  if (weights) {
    Attribute attribute;
    attribute.name = request.intent.weights = s_weights;
    const auto* const bytes = reinterpret_cast<const unsigned char*>(weights->data());
    attribute.rows.assign(bytes, bytes + weights->size() * sizeof(double));
    soup.vertex_attributes.push_back(std::move(attribute));
  }
  request.intent.locked_vertices = locked;
  if (obstacle)
    request.obstacle = soup_of(obstacle->first, obstacle->second);
  Work work;
  request.options.should_stop = [&](const Simplify_progress& now) { return work.report(progress, now); };
  const auto reduction = work.run([&] {
    return std::make_shared<const bindings::Reduction>(std::move(soup), request, has_normals_of_vertices);
  });
  std::vector<Result> results;
  for (std::size_t level = 0; level < reduction->level_count(); ++level)
    results.emplace_back(reduction, level);
  return results;
}

py::array_t<std::size_t> choose_poses(const Points& points, const std::vector<Points>& poses,
                                      std::size_t count)
{
  Triangle_soup mesh;
  mesh.points = points_of(points);
  for (const Points& pose : poses) {
    mesh.poses.push_back({"", points_of(pose)});
    if (mesh.poses.back().points.size() != mesh.points.size())
      throw Argument_error("a pose has " + std::to_string(mesh.poses.back().points.size()) +
                           " points, but the mesh has " + std::to_string(mesh.points.size()));
  }
  return array_of<std::size_t>(Work().run([&] { return key_poses(mesh, count); }));
}

/// Points, triangles, further poses and labels.
using Judged_mesh = std::tuple<Points, Triangles, std::vector<Points>, Labels>;

Triangle_soup soup_of(const Judged_mesh& mesh)
{
  const auto& [points, triangles, poses, labels] = mesh;
  Triangle_soup soup = soup_of(points, triangles);
  add_poses(soup, poses);
  add_labels(soup, labels);
  return soup;
}

py::tuple judge_mesh(const Judged_mesh& mesh, const std::optional<Judged_mesh>& original,
                     const std::optional<Mesh_arrays>& obstacle, double weld_distance,
                     std::optional<double> clearance, const std::vector<std::string>& may_intersect,
                     std::optional<std::size_t> threads, const std::vector<std::string>& dropped_parts,
                     double dropped_below)
{
  const Triangle_soup soup = soup_of(mesh);
  const Triangle_soup before = original ? soup_of(*original) : Triangle_soup();
  const Triangle_soup beside = obstacle ? soup_of(obstacle->first, obstacle->second) : Triangle_soup();
  const auto run = [&] {
    return bindings::Verdict(
        soup, original ? &before : nullptr, beside,
        {weld_distance, clearance, may_intersect, threads, {dropped_parts, dropped_below}});
  };
  const bindings::Verdict verdict = Work().run(run);
  const auto pairs = [](const std::vector<Offending_pair>& list) {
    std::vector<Index> numbers;
    for (const Offending_pair& pair : list)
      numbers.insert(numbers.end(), {pair.first, pair.second});
    return array_of<Index>(std::move(numbers)).reshape({-1, 2});
  };
  std::vector<Index> swaps;
  for (const Layer_swap& swap : verdict.swaps())
    swaps.insert(swaps.end(),
                 {swap.of_original[0], swap.of_original[1], swap.of_result[0], swap.of_result[1]});
  return py::make_tuple(verdict.is_accepted(), pairs(verdict.verification().pairs),
                        pairs(verdict.verification().new_pairs),
                        array_of<Index>(std::move(swaps)).reshape({-1, 4}), verdict.report());
}

py::tuple repeat(const Points& points, const Triangles& triangles, const std::string& log,
                 const Labels& labels, const std::optional<Mesh_arrays>& obstacle, bool is_all_wanted)
{
  Triangle_soup soup = soup_of(points, triangles);
  add_labels(soup, labels);
  Replay_options options;
  if (obstacle)
    options.obstacle = soup_of(obstacle->first, obstacle->second);
  options.is_all_wanted = is_all_wanted;
  Replay_verdict verdict = Work().run([&] { return bindings::replay(soup, log, options); });
  const std::string report = bindings::report_of(verdict);
  return py::make_tuple(verdict.is_accepted(), arrays_of(std::move(verdict.soup)), report);
}

py::tuple make(const std::string& name, std::size_t faces, int layers, double thickness, double gap,
               double fold_depth, int folds, unsigned seed)
{
  const Generate_options options{faces, layers, thickness, gap, fold_depth, folds, seed};
  Triangle_soup soup = Work().run([&] { return generate(name, options); });
  const py::array_t<Index> groups = array_of<Index>(std::move(soup.groups.of_triangle));
  const std::vector<std::string> names = std::move(soup.groups.names);
  const py::tuple uvs = py::make_tuple(array_of<double>(std::move(soup.uvs.values), 2),
                                       array_of<Index>(std::move(soup.uvs.of_triangle), 3));
  return py::make_tuple(arrays_of(std::move(soup)), groups, names, uvs);
}

} // namespace

PYBIND11_MODULE(_selvedge, module)
{
  const auto error = py::register_exception<Error>(module, "Error", PyExc_RuntimeError);
  py::register_exception<Input_error>(module, "InputError", error);
  py::register_exception<Argument_error>(module, "ArgumentError",
                                         py::make_tuple(error, py::handle(PyExc_ValueError)));
  module.attr("version") = SELVEDGE_VERSION;
  py::class_<Labels>(module, "Labels")
      .def(py::init([](Corner_arrays uvs, Corner_arrays normals, std::vector<Index> groups,
                       std::vector<std::string> group_names) {
        return Labels{std::move(uvs), std::move(normals), std::move(groups), std::move(group_names)};
      }));
  module.def("option_names", &bindings::option_names);
  module.def("nearest", &bindings::nearest);
  py::class_<Result>(module, "Result")
      .def("mesh", &Result::mesh)
      .def("uvs", &Result::uvs)
      .def("normals", &Result::normals)
      .def("attributes", &Result::attributes)
      .def("vertices", &Result::vertices)
      .def("triangles", &Result::triangles)
      .def("collapses", &Result::collapses)
      .def("log", &Result::log)
      .def("report", &Result::report)
      .def("is_accepted", &Result::is_accepted)
      .def("is_reached", &Result::is_reached)
      .def("is_stopped", &Result::is_stopped);
  module.def("reduce", &reduce);
  module.def("key_poses", &choose_poses);
  module.def("judge", &judge_mesh);
  module.def("replay", &repeat);
  module.def("generate", &make);
}
