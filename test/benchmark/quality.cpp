// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// How good results look: ours, by distance alone, and at vertices; those of CGAL's two costs, OpenMesh and
// meshoptimizer; each reduced to the number of faces that ours reaches, and measured in the same ways.

#include "Cgal_policies.h"
#include "Mesh.h"
#include "Peers.h"
#include "Table.h"

#include "soup/Disjoint_sets.h"
#include "soup/number_positions.h"
#include "verify/Surface_tree.h"
#include "verify/face_samples.h"

#include <selvedge/compare.h>
#include <selvedge/mesh_files.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace selvedge;
using namespace selvedge::benchmark;

/// Points all over a surface, each as a triangle, so that `distances` measures from them: as many on equal
/// areas.
Triangle_soup points_on(const Triangle_soup& soup, std::size_t count)
{
  const internal::Surface surface(soup, 0);
  double area = 0;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    area += std::sqrt(surface.normal(t).squared_length());
  internal::Face_samples samples(surface);
  Triangle_soup points;
  double due = 0;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (due += std::sqrt(surface.normal(t).squared_length()) / area * static_cast<double>(count); due >= 1;
         --due) {
      const Index number = static_cast<Index>(points.points.size());
      points.points.push_back(samples.next(t));
      points.triangles.push_back({number, number, number});
    }
  return points;
}

/// Returns the share of the area of a result whose texture coordinates are more than a hundredth of the
/// texture's size away from those of the original at the nearest point that faces the same way; NaN without
/// texture coordinates.
double share_of_moved_texture(const Triangle_soup& result, const Triangle_soup& original, double limit)
{
  if (result.uvs.empty() || original.uvs.empty() || result.uvs.missing || original.uvs.missing)
    return std::nan("");
  const internal::Surface from(result, 0), to(original, 0);
  const internal::Surface_tree tree(to);
  std::vector<internal::Vector_3> normals;
  for (Index t = 0; t < original.triangles.size(); ++t)
    normals.push_back(to.normal(t));
  CGAL::Bbox_2 box;
  for (const auto& [u, v] : original.uvs.values)
    box += CGAL::Bbox_2(u, v, u, v);
  const double near = 0.01 * std::hypot(box.x_span(), box.y_span());
  const auto uv_at = [](const internal::Surface& surface, const Triangle_soup& soup, Index t,
                        const Point_3& p) {
    const internal::Vector_3 normal = surface.normal(t);
    std::array<double, 2> uv{0, 0};
    for (int k = 0; k < 3; ++k) {
      const double weight =
          CGAL::cross_product(surface.corner(t, (k + 1) % 3) - p, surface.corner(t, (k + 2) % 3) - p) *
          normal / normal.squared_length();
      for (int i = 0; i < 2; ++i)
        uv[i] += weight * soup.uvs.values[soup.uvs.of_triangle[t][k]][i];
    }
    return uv;
  };
  internal::Face_samples samples(from);
  double area = 0, moved = 0;
  for (Index t = 0; t < result.triangles.size(); ++t) {
    if (from.is_degenerate(t))
      continue;
    constexpr int per_face = 4;
    const double share = std::sqrt(from.normal(t).squared_length()) / per_face;
    for (int i = 0; i < per_face; ++i) {
      const Point_3 p = samples.next(t);
      const auto nearest = tree.nearest_facing(p, normals, from.normal(t), limit);
      area += share;
      if (!nearest || to.is_degenerate(nearest->triangle))
        continue;
      const auto a = uv_at(from, result, t, p), b = uv_at(to, original, nearest->triangle, nearest->point);
      if (std::hypot(a[0] - b[0], a[1] - b[1]) > near)
        moved += share;
    }
  }
  return area > 0 ? moved / area : 0;
}

/// Returns the edges, by position, at which a surface ends, branches, or bends by more than `degrees`, each
/// as a triangle {a, b, b}.
Triangle_soup hard_edges(const Triangle_soup& soup, double degrees)
{
  const internal::Surface surface(soup, 0);
  const std::vector<Index> positions = number_positions(soup.points);
  std::map<std::array<Index, 2>, std::vector<Index>> faces_of_edge;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (int k = 0; k < 3 && !surface.is_degenerate(t); ++k) {
      const Index a = positions[soup.triangles[t][k]], b = positions[soup.triangles[t][(k + 1) % 3]];
      faces_of_edge[{std::min(a, b), std::max(a, b)}].push_back(t);
    }
  Triangle_soup edges;
  edges.points.resize(soup.points.size());
  for (Index v = 0; v < soup.points.size(); ++v)
    edges.points[positions[v]] = soup.points[v];
  for (const auto& [ends, faces] : faces_of_edge)
    if (faces.size() != 2 ||
        CGAL::approximate_angle(surface.normal(faces[0]), surface.normal(faces[1])) > degrees)
      edges.triangles.push_back({ends[0], ends[1], ends[1]});
  return edges;
}

/// Returns how far the hard edges of an original are from those of a result, from their middles and ends:
/// RMS, NaN where there are none.
double distance_of_hard_edges(const Triangle_soup& result, const Triangle_soup& original)
{
  const Triangle_soup to = hard_edges(result, 30);
  Triangle_soup from = hard_edges(original, 40);
  if (from.triangles.empty() || to.triangles.empty())
    return std::nan("");
  for (Index_triple& edge : from.triangles) {
    from.points.push_back(CGAL::midpoint(from.points[edge[0]], from.points[edge[1]]));
    edge[2] = static_cast<Index>(from.points.size() - 1);
  }
  return distance(from, to).root_mean_square;
}

/// Returns the vertices of each piece of at least a dozen faces, as soups of points.
std::vector<Triangle_soup> points_of_pieces(const Triangle_soup& soup)
{
  const std::vector<Index> positions = number_positions(soup.points);
  internal::Disjoint_sets pieces(soup.points.size());
  for (const auto& [a, b, c] : soup.triangles) {
    pieces.unite(positions[a], positions[b]);
    pieces.unite(positions[b], positions[c]);
  }
  std::map<std::size_t, Triangle_soup> of_piece;
  for (const Index_triple& triangle : soup.triangles) {
    Triangle_soup& points = of_piece[pieces.find(positions[triangle[0]])];
    const Index first = static_cast<Index>(points.points.size());
    for (const Index v : triangle)
      points.points.push_back(soup.points[v]);
    points.triangles.push_back({first, first + 1, first + 2});
  }
  std::vector<Triangle_soup> result;
  for (auto& [piece, points] : of_piece)
    if (points.triangles.size() >= 12)
      result.push_back(std::move(points));
  return result;
}

/// Returns how far pieces are from a result, each measured by the diagonal of its own box: RMS over pieces,
/// so that a button counts as much as the coat.
double distance_of_pieces(const Triangle_soup& result, const std::vector<Triangle_soup>& pieces)
{
  double sum = 0;
  for (const Triangle_soup& piece : pieces) {
    const CGAL::Bbox_3 box = CGAL::bbox_3(piece.points.begin(), piece.points.end());
    const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
    sum += diagonal > 0 ? std::pow(distance(piece, result).root_mean_square / diagonal, 2) : 0;
  }
  return std::sqrt(sum / static_cast<double>(pieces.size()));
}

struct Program
{
  std::string name;
  std::function<Triangle_soup(std::size_t faces)> run;
};

const Row header{"mesh",
                 "ratio",
                 "program",
                 "faces",
                 "RMS at vertices",
                 "RMS by area",
                 "RMS of the result",
                 "most (of the size)",
                 "normals (degrees)",
                 "hard edges",
                 "pieces",
                 "moved texture",
                 "pairs (original)"};

struct Request
{
  std::vector<std::string> meshes{"skirt:30000", "shorts:30000", "folded:30000"};
  std::vector<double> ratios{0.5, 0.3, 0.1, 0.05};
  std::string csv, folder;
};

void add_rows(Table& table, const std::string& argument, const Request& request)
{
  const Mesh mesh = benchmark::mesh(argument, Defects::descend);
  const Prepared_soup& prepared = mesh.prepared;
  const Triangle_soup soup = sewn(prepared), by_area = points_on(prepared.soup, 100'000);
  const std::vector<Triangle_soup> pieces = points_of_pieces(prepared.soup);
  const auto ours = [&](Placement placement, double normal_weight) {
    return [&prepared, placement, normal_weight](std::size_t faces) {
      Simplify_options options;
      options.faces = faces;
      options.placement = placement;
      options.normal_weight = normal_weight;
      return simplify_soup(prepared, options).soup;
    };
  };
  const Simplify_options limits;
  const std::vector<Program> programs{
      {"selvedge", ours(Placement::optimal, limits.normal_weight)},
      {"selvedge distance alone", ours(Placement::optimal, 0)},
      {"selvedge at vertices", ours(Placement::vertices, 0)},
      {"CGAL GarlandHeckbert plane",
       [&](std::size_t faces) { return run_garland_heckbert(soup, faces).soup; }},
      {"CGAL LindstromTurk", [&](std::size_t faces) { return run_lindstrom_turk(soup, faces).soup; }},
      {"OpenMesh", [&](std::size_t faces) { return run_openmesh(soup, limits, faces).soup; }},
      {"meshoptimizer", [&](std::size_t faces) { return run_meshoptimizer(soup, faces).soup; }}};
  if (!request.folder.empty())
    write_mesh(std::filesystem::path(request.folder) / (mesh.name + "-original.obj"), prepared.soup);
  for (const double ratio : request.ratios) {
    std::size_t faces =
        static_cast<std::size_t>(std::ceil(ratio * static_cast<double>(soup.triangles.size())));
    for (std::size_t i = 0; i < programs.size(); ++i) {
      const Triangle_soup result = programs[i].run(faces);
      if (i == 0) // which may stop sooner; the others have the same number
        faces = result.triangles.size();
      const Distances at_vertices = distances(result, prepared.soup);
      const Comparison comparison = compare(result, prepared.soup);
      table.add({mesh.name, text(ratio), programs[i].name, std::to_string(result.triangles.size()),
                 text(1000 * at_vertices.original_to_result.root_mean_square),
                 text(1000 * distance(by_area, result).root_mean_square / at_vertices.diagonal),
                 text(1000 * at_vertices.result_to_original.root_mean_square),
                 text(1000 * std::max(comparison.distances.original_to_result.lower,
                                      comparison.distances.result_to_original.lower)),
                 text(comparison.normals.root_mean_square),
                 text(1000 * distance_of_hard_edges(result, prepared.soup) / at_vertices.diagonal),
                 text(1000 * distance_of_pieces(result, pieces)),
                 text(share_of_moved_texture(result, prepared.soup, at_vertices.diagonal)),
                 std::to_string(offending_pairs(result).size()) + " (" +
                     std::to_string(prepared.offending_pairs.size()) + ')'});
      if (!request.folder.empty())
        write_mesh(std::filesystem::path(request.folder) /
                       (mesh.name + '-' + text(ratio) + '-' + std::to_string(i) + ".obj"),
                   result);
    }
  }
}

} // namespace

int main(int argc, char** argv)
{
  CLI::App app(
      "How good the results of selvedge, CGAL, OpenMesh and meshoptimizer are at equal numbers of faces.");
  Request request;
  app.add_option("MESH", request.meshes, "Files, or SCENE:FACES for generated ones")->capture_default_str();
  app.add_option("--ratio", request.ratios, "Shares of the faces to keep")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--csv", request.csv, "The table once more")->type_name("FILE");
  app.add_option("--write", request.folder, "Every result as OBJ, for quality_sheet.py")
      ->type_name("FOLDER")
      ->check(CLI::ExistingDirectory);
  try {
    app.parse(argc, argv);
    Table table(header);
    for (const std::string& mesh : request.meshes)
      add_rows(table, mesh, request);
    std::cout << R"(
All have as many faces as 'selvedge' reaches, and no bound of the error. RMS and most are thousandths of the
diagonal of the original: from its vertices to the result, from points evenly spread over it, and from the result's
vertices to it; most is the largest distance that was found in either direction. Normals: RMS of the angle to the
original. Hard edges: RMS from the original's edges that bend by more than 40 degrees, or are a border, to the
result's that bend by more than 30 or are one. Pieces: RMS over connected pieces of how far each is from the result, in
thousandths of its own diagonal. Moved texture: the share of the area whose texture coordinates are off by more than
1 % of the texture; the peers are given positions and faces alone. Pairs: of triangles that meet, decided exactly, and
how many did in the original.
)";
    if (!request.csv.empty())
      write_file(request.csv, table.csv());
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::cerr << "quality: " << error.what() << std::endl;
    return 1;
  }
}
