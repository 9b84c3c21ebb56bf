// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "selvedge_c.h"

#include "apps/text.h"
#include "bindings/run/Reduction.h"
#include "bindings/run/Verdict.h"
#include "bindings/run/soup_of.h"
#include "meshopt_call.h"

#include <selvedge/Error.h>
#include <selvedge/generate.h>
#include <selvedge/mesh_files.h>
#include <selvedge/normals.h>
#include <selvedge/references.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

using namespace selvedge;

struct selvedge_mesh
{
  Triangle_soup soup;
  bool has_normals_of_vertices = false; // as the file has them that it was read from
  std::filesystem::path folder = {};    // of this file; empty where there is none
};

struct selvedge_options
{
  bindings::Reduction_request request;
};

struct selvedge_result
{
  std::shared_ptr<const bindings::Reduction> reduction; // which all of its levels share
  std::size_t level;
  selvedge_mesh mesh;
  std::vector<Index> vertices;
  std::optional<std::string> report;
};

struct selvedge_verdict
{
  bindings::Verdict verdict;
  std::string report;
};

namespace {

static_assert(std::is_same_v<Index, unsigned int>);
static_assert(sizeof(Point_3) == 3 * sizeof(double), "points are read as three doubles each");

thread_local std::optional<std::string> last_error;
thread_local std::string error_before; // the last one of an earlier call

/// Returns what `function` returns; when it throws, remembers why and returns `failed`.
template <class Result, class Function>
Result guarded(Result failed, Function function) noexcept
{
  try {
    if (last_error)
      error_before = *std::exchange(last_error, std::nullopt);
    try {
      return function();
    } catch (const std::bad_alloc&) {
      last_error = "out of memory";
    } catch (const Error& error) {
      last_error = error.what();
    } catch (const std::exception& error) {
      last_error = std::string("this should not happen: ") + error.what();
    } catch (...) {
      last_error = "this should not happen";
    }
  } catch (...) { // no memory for the message
  }
  return failed;
}

/// Whoever passes a null pointer mostly got it from a call that failed.
template <class Object>
Object& required(Object* object, const char* name)
{
  if (object)
    return *object;
  const std::string before = "; the error before this one: ";
  // After several null pointers in a row, the first error is the cause of all.
  const std::size_t last = error_before.rfind(before);
  throw Argument_error(std::string(name) + " is a null pointer" +
                       (error_before.empty()        ? ""
                        : last != std::string::npos ? error_before.substr(last)
                                                    : before + error_before));
}

using Results = std::vector<std::unique_ptr<selvedge_result>>;

/// Returns a result for each level of detail; one, if none are asked for.
Results results_of(const selvedge_mesh& mesh, const bindings::Reduction_request& request)
{
  const auto reduction =
      std::make_shared<const bindings::Reduction>(mesh.soup, request, mesh.has_normals_of_vertices);
  Results results;
  for (std::size_t level = 0; level < reduction->level_count(); ++level)
    results.emplace_back(
        new selvedge_result{reduction,
                            level,
                            {reduction->soup(level), mesh.has_normals_of_vertices, mesh.folder},
                            reduction->vertices(level),
                            {}});
  return results;
}

/// Judges as `selvedge verify` judges files: vertices that a file has for its normals alone make no pieces.
bindings::Verdict judge_mesh(const selvedge_mesh& mesh, const selvedge_mesh* original,
                             const bindings::Reduction_request& request)
{
  bindings::Verdict_request asked;
  asked.weld_distance = original ? request.prepare.weld_distance : 0;
  asked.clearance = request.options.clearance;
  asked.may_intersect = request.may_intersect;
  asked.threads = request.threads;
  if (original)
    asked.dropped_parts = request.dropped_parts;
  if (!original || !(mesh.has_normals_of_vertices || original->has_normals_of_vertices))
    return {mesh.soup, original ? &original->soup : nullptr, request.obstacle, asked};
  Triangle_soup after = mesh.soup, before = original->soup;
  asked.triangles_in_file = after.triangles;
  share_vertices_without_normals(after);
  share_vertices_without_normals(before);
  return {after, &before, request.obstacle, asked};
}

} // namespace

const char* selvedge_version(void)
{
  return SELVEDGE_VERSION;
}

const char* selvedge_last_error(void)
{
  return last_error ? last_error->c_str() : nullptr;
}

size_t selvedge_simplify(unsigned int* destination, const unsigned int* indices, size_t index_count,
                         const float* vertex_positions, size_t vertex_count, size_t vertex_positions_stride,
                         size_t target_index_count, float target_error, unsigned int options,
                         float* result_error)
{
  return selvedge_simplifyWithAttributes(destination, indices, index_count, vertex_positions, vertex_count,
                                         vertex_positions_stride, nullptr, 0, nullptr, 0, nullptr,
                                         target_index_count, target_error, options, result_error);
}

size_t selvedge_simplifyWithAttributes(unsigned int* destination, const unsigned int* indices,
                                       size_t index_count, const float* vertex_positions, size_t vertex_count,
                                       size_t vertex_positions_stride, const float* vertex_attributes,
                                       size_t vertex_attributes_stride, const float* attribute_weights,
                                       size_t attribute_count, const unsigned char* vertex_lock,
                                       size_t target_index_count, float target_error, unsigned int options,
                                       float* result_error)
{
  return guarded(size_t(0), [&] {
    return bindings::simplify({destination, indices, index_count, vertex_positions, vertex_count,
                               vertex_positions_stride, vertex_attributes, vertex_attributes_stride,
                               attribute_weights, attribute_count, vertex_lock, target_index_count,
                               target_error, options, result_error});
  });
}

selvedge_mesh* selvedge_mesh_new(const double* positions, size_t vertex_count, const unsigned int* indices,
                                 size_t index_count)
{
  return guarded(static_cast<selvedge_mesh*>(nullptr), [&] {
    auto mesh = std::make_unique<selvedge_mesh>();
    bindings::check_arrays(positions, vertex_count, indices, index_count);
    mesh->soup = bindings::soup_of(
        vertex_count, indices, index_count,
        [&](std::size_t v) { return Point_3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]); },
        [](std::size_t v) { return v; });
    return mesh.release();
  });
}

selvedge_mesh* selvedge_mesh_read(const char* path)
{
  return guarded(static_cast<selvedge_mesh*>(nullptr), [&] {
    Mesh_file file = read_mesh(&required(path, "path"));
    return new selvedge_mesh{std::move(file.soup), has_normals_of_vertices(file.format),
                             std::filesystem::absolute(path).parent_path()};
  });
}

selvedge_mesh* selvedge_mesh_generate(const char* name, size_t triangles, int layers)
{
  return guarded(static_cast<selvedge_mesh*>(nullptr), [&] {
    Generate_options options;
    options.faces = triangles;
    options.layers = layers;
    return new selvedge_mesh{generate(&required(name, "name"), options)};
  });
}

int selvedge_mesh_write(const selvedge_mesh* mesh, const char* path)
{
  return guarded(-1, [&] {
    const std::filesystem::path file = &required(path, "path");
    const selvedge_mesh& written = required(mesh, "mesh");
    if (written.folder.empty()) {
      write_mesh(file, written.soup);
    } else {
      Triangle_soup soup = written.soup;
      relocate_references(soup, mesh_format(file), written.folder, file.parent_path());
      write_mesh(file, soup);
    }
    return 0;
  });
}

void selvedge_mesh_free(selvedge_mesh* mesh)
{
  delete mesh;
}

size_t selvedge_mesh_vertex_count(const selvedge_mesh* mesh)
{
  return mesh ? mesh->soup.points.size() : 0;
}

size_t selvedge_mesh_index_count(const selvedge_mesh* mesh)
{
  return mesh ? 3 * mesh->soup.triangles.size() : 0;
}

const double* selvedge_mesh_positions(const selvedge_mesh* mesh)
{
  return mesh ? reinterpret_cast<const double*>(mesh->soup.points.data()) : nullptr;
}

const unsigned int* selvedge_mesh_indices(const selvedge_mesh* mesh)
{
  return mesh ? reinterpret_cast<const unsigned int*>(mesh->soup.triangles.data()) : nullptr;
}

int selvedge_mesh_set_uvs(selvedge_mesh* mesh, const double* uvs)
{
  return guarded(-1, [&] {
    const std::size_t corners = selvedge_mesh_index_count(&required(mesh, "mesh"));
    Corner_values<2> result;
    std::map<std::array<double, 2>, Index> numbers;
    result.of_triangle.resize(uvs ? corners / 3 : 0);
    for (std::size_t i = 0; uvs && i < corners; ++i) {
      const std::array<double, 2> uv{uvs[2 * i], uvs[2 * i + 1]};
      if (!std::isfinite(uv[0]) || !std::isfinite(uv[1]))
        throw Argument_error("index " + std::to_string(i) + " has a texture coordinate that is not finite");
      const auto [number, is_new] = numbers.emplace(uv, Index(result.values.size()));
      if (is_new)
        result.values.push_back(uv);
      result.of_triangle[i / 3][i % 3] = number->second;
    }
    mesh->soup.uvs = std::move(result);
    return 0;
  });
}

int selvedge_mesh_get_uvs(const selvedge_mesh* mesh, double* uvs)
{
  return guarded(-1, [&] {
    const Corner_values<2>& of_corners = required(mesh, "mesh").soup.uvs;
    if (of_corners.empty())
      return 0;
    required(uvs, "uvs");
    for (const Index_triple& triangle : of_corners.of_triangle)
      for (const Index number : triangle) {
        const auto uv = number == of_corners.missing ? std::array<double, 2>{} : of_corners.values[number];
        uvs = std::copy(uv.begin(), uv.end(), uvs);
      }
    return 1;
  });
}

selvedge_options* selvedge_options_new(void)
{
  return guarded(static_cast<selvedge_options*>(nullptr), [] { return new selvedge_options(); });
}

void selvedge_options_free(selvedge_options* options)
{
  delete options;
}

int selvedge_options_set(selvedge_options* options, const char* name, const char* value)
{
  return guarded(-1, [&] {
    bindings::Reduction_request& request = required(options, "options").request;
    request.set(&required(name, "name"), &required(value, "value"));
    return 0;
  });
}

int selvedge_options_set_obstacle(selvedge_options* options, const selvedge_mesh* obstacle)
{
  return guarded(-1, [&] {
    required(options, "options").request.obstacle = obstacle ? obstacle->soup : Triangle_soup();
    return 0;
  });
}

int selvedge_options_set_progress(selvedge_options* options, selvedge_progress progress, void* user)
{
  return guarded(-1, [&] {
    std::function<bool(const Simplify_progress&)> hook;
    if (progress)
      hook = [=](const Simplify_progress& now) {
        return progress(user, now.faces_input, now.faces_target, now.faces) != 0;
      };
    required(options, "options").request.options.should_stop = std::move(hook);
    return 0;
  });
}

selvedge_result* selvedge_reduce(const selvedge_mesh* mesh, const selvedge_options* options)
{
  return guarded(static_cast<selvedge_result*>(nullptr), [&] {
    const selvedge_mesh& input = required(mesh, "mesh");
    const bindings::Reduction_request& request = required(options, "options").request;
    if (!request.lods.empty())
      throw Argument_error("lods: selvedge_reduce makes one result; call selvedge_reduce_lods");
    return results_of(input, request).front().release();
  });
}

int selvedge_reduce_lods(const selvedge_mesh* mesh, const selvedge_options* options,
                         selvedge_result** results, size_t count)
{
  return guarded(-1, [&] {
    const selvedge_mesh& input = required(mesh, "mesh");
    const bindings::Reduction_request& request = required(options, "options").request;
    required(results, "results");
    if (request.lods.empty() || request.lods.size() != count)
      throw Argument_error("lods: the option has " + std::to_string(request.lods.size()) +
                           " ratios, and there is room for " + std::to_string(count) + " results");
    for (auto& result : results_of(input, request))
      *results++ = result.release();
    return 0;
  });
}

void selvedge_result_free(selvedge_result* result)
{
  delete result;
}

int selvedge_result_is_accepted(const selvedge_result* result)
{
  return guarded(-1, [&] {
    const selvedge_result& level = required(result, "result");
    return int(level.reduction->is_accepted(level.level));
  });
}

int selvedge_result_is_reached(const selvedge_result* result)
{
  return guarded(-1, [&] {
    const selvedge_result& level = required(result, "result");
    return int(level.reduction->is_reached(level.level));
  });
}

const selvedge_mesh* selvedge_result_mesh(const selvedge_result* result)
{
  return result ? &result->mesh : nullptr;
}

const unsigned int* selvedge_result_vertices(const selvedge_result* result)
{
  return result ? result->vertices.data() : nullptr;
}

const char* selvedge_result_log(const selvedge_result* result)
{
  return result ? result->reduction->log(result->level).c_str() : nullptr;
}

const char* selvedge_result_report(selvedge_result* result)
{
  return guarded(static_cast<const char*>(nullptr), [&] {
    std::optional<std::string>& report = required(result, "result").report;
    if (!report)
      report = result->reduction->report(result->level);
    return report->c_str();
  });
}

int selvedge_verify(const selvedge_mesh* mesh, const selvedge_mesh* original, size_t* pairs,
                    size_t* new_pairs)
{
  return guarded(-1, [&] {
    const bindings::Verdict verdict = judge_mesh(required(mesh, "mesh"), original, {});
    if (pairs)
      *pairs = verdict.verification().pairs.size();
    if (new_pairs)
      *new_pairs = verdict.verification().new_pairs.size();
    return int(verdict.is_accepted());
  });
}

selvedge_verdict* selvedge_verdict_new(const selvedge_mesh* mesh, const selvedge_mesh* original,
                                       const selvedge_options* options)
{
  return guarded(static_cast<selvedge_verdict*>(nullptr), [&] {
    bindings::Verdict verdict = judge_mesh(required(mesh, "mesh"), original,
                                           options ? options->request : bindings::Reduction_request());
    std::string report = verdict.report();
    return new selvedge_verdict{std::move(verdict), std::move(report)};
  });
}

void selvedge_verdict_free(selvedge_verdict* verdict)
{
  delete verdict;
}

int selvedge_verdict_is_accepted(const selvedge_verdict* verdict)
{
  return guarded(-1, [&] { return int(required(verdict, "verdict").verdict.is_accepted()); });
}

const char* selvedge_verdict_report(const selvedge_verdict* verdict)
{
  return verdict ? verdict->report.c_str() : nullptr;
}

int selvedge_replay(const selvedge_mesh* original, const char* log)
{
  return guarded(-1, [&] {
    const Replay_verdict verdict =
        bindings::replay(required(original, "original").soup, &required(log, "log"), {});
    if (!verdict.violations.empty())
      last_error = app::describe(verdict.violations.front());
    return int(verdict.is_accepted());
  });
}
