// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "random_world.h"
#include "random_changes.h"
#include "random_scene.h"
#include "soup/flat_shading.h"
#include "soup/selection.h"
#include "support/Temporary_folder.h"
#include "support/soups.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/drop_parts.h>
#include <selvedge/mesh_files.h>
#include <selvedge/normals.h>
#include <selvedge/rounding.h>
#include <selvedge/suited_normals.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

using Json = nlohmann::ordered_json;

bool fits_float32(const Triangle_soup& soup)
{
  return std::all_of(soup.points.begin(), soup.points.end(), [](const Point_3& p) {
    return std::max({std::fabs(p.x()), std::fabs(p.y()), std::fabs(p.z())}) <=
           double(std::numeric_limits<float>::max());
  });
}

bool are_finite(const std::vector<Point_3>& points)
{
  return std::all_of(points.begin(), points.end(), [](const Point_3& p) {
    return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
  });
}

Triangle_soup through_file(const Triangle_soup& soup, const char* name)
{
  const Temporary_folder folder;
  write_mesh(folder / name, soup);
  return read_mesh(folder / name).soup;
}

void append(std::string& bytes, float number)
{
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// Puts every mesh of a scene to one or two further places, in nodes or as instances: near the first, on its
/// other side, or away from it.
void put_elsewhere(Json& json, Random& random, const std::filesystem::path& folder)
{
  json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"}; // before references are taken
  Json& nodes = json["nodes"];
  const std::size_t originals = nodes.size();
  const auto moved = [&](Json place) {
    const double step = random.one_of({1e-3, 0.25, 1., 2.});
    place["translation"] = {step * random.between(-4, 4), step * random.between(-4, 4),
                            step * random.between(-1, 1)};
    place["scale"] = {random.one_of({1., 1., -1., 0.75}), 1, 1};
    place["rotation"] = random.one_in(2) ? Json({0., 0., 0., 1.}) : Json({0., 0., 0.6, 0.8});
    return place;
  };
  if (random.one_in(3)) { // as instances of the first node
    std::string bytes;
    Json& views = json["bufferViews"];
    Json attributes;
    constexpr std::size_t count = 3;
    std::vector<Json> places;
    for (std::size_t i = 0; i < count; ++i)
      places.push_back(moved(Json::object()));
    for (const auto& [name, member, components] :
         {std::make_tuple("TRANSLATION", "translation", 3), std::make_tuple("ROTATION", "rotation", 4),
          std::make_tuple("SCALE", "scale", 3)}) {
      attributes[name] = json["accessors"].size();
      json["accessors"].push_back({{"bufferView", views.size()},
                                   {"componentType", 5126},
                                   {"count", count},
                                   {"type", components == 3 ? "VEC3" : "VEC4"}});
      views.push_back({{"buffer", 1}, {"byteOffset", bytes.size()}, {"byteLength", count * 4 * components}});
      for (const Json& place : places)
        for (const Json& number : place[member])
          append(bytes, number.get<float>());
    }
    nodes[0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
    json["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", "places.bin"}});
    write_file(folder / "places.bin", bytes);
  }
  for (std::size_t n = 0; n < originals; ++n)
    for (int i = random.between(1, 2); i > 0; --i) {
      Json place = Json::object();
      place["mesh"] = nodes[n]["mesh"];
      if (random.one_in(4)) { // as a mesh of its own, with the same accessors
        Json alike = json["meshes"][place["mesh"].get<std::size_t>()];
        place["mesh"] = json["meshes"].size();
        json["meshes"].push_back(std::move(alike));
      }
      nodes.push_back(moved(std::move(place)));
      json["scenes"][0]["nodes"].push_back(nodes.size() - 1);
    }
}

/// Binds some meshes to a joint that stands where their nodes do, and makes them twice as large, as it was
/// bound to them when it was half as large: so nothing moves.
void bind_some(Json& json, Random& random, const std::filesystem::path& folder)
{
  Json &nodes = json["nodes"], skins = Json::array();
  const std::size_t originals = nodes.size();
  for (std::size_t n = 0; n < originals; ++n) {
    if (nodes[n].contains("extensions") || !random.one_in(3))
      continue;
    nodes[n]["skin"] = skins.size();
    nodes[n]["children"].push_back(nodes.size());
    skins.push_back({{"joints", {nodes.size()}}, {"inverseBindMatrices", json["accessors"].size()}});
    nodes.push_back({{"scale", {2, 2, 2}}});
  }
  if (skins.empty())
    return;
  json["skins"] = skins;
  json["accessors"].push_back(
      {{"bufferView", json["bufferViews"].size()}, {"componentType", 5126}, {"count", 1}, {"type", "MAT4"}});
  std::string bytes;
  for (std::size_t i = 0; i < 16; ++i)
    append(bytes, i == 15 ? 1 : i % 5 == 0 ? 0.5f : 0);
  json["bufferViews"].push_back(
      {{"buffer", json["buffers"].size()}, {"byteOffset", 0}, {"byteLength", bytes.size()}});
  json["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", "bind.bin"}});
  write_file(folder / "bind.bin", bytes);
}

/// The soup as a glTF scene whose nodes are scaled, turned, mirrored, moved, and children of one another. It
/// has each mesh several times if `others` are given, which say where.
Triangle_soup as_scene(Triangle_soup soup, Random& random, Random* others, Random* of_tangents)
{
  round_to_float32(soup);
  soup.vertex_attributes.clear();
  if (of_tangents)
    add_tangents_as_colours(soup, *of_tangents);
  const Temporary_folder folder;
  write_mesh(folder / "mesh.gltf", soup);
  Json json;
  {
    std::ifstream stream(folder / "mesh.gltf");
    json = Json::parse(stream);
  }
  if (of_tangents)
    for (Json& mesh : json["meshes"])
      for (Json& primitive : mesh["primitives"]) {
        Json& attributes = primitive["attributes"];
        attributes["TANGENT"] = attributes["COLOR_0"];
        attributes.erase("COLOR_0");
      }
  Json& nodes = json["nodes"];
  for (Json& node : nodes)
    switch (random.below(4)) {
    case 0:
      break;
    case 1:
      node["translation"] = {random.between(-3, 3), random.between(-3, 3),
                             0.1f * float(random.between(0, 3))};
      break;
    case 2:
      node["scale"] = {random.one_of({1., -1., 0.5}), 1, random.one_of({1., 2., 0.3})};
      node["rotation"] = random.one_in(2) ? Json({0, 0, 0.6, 0.8}) : Json({0, 0.70710678, 0, 0.70710678});
      break;
    default:
      node["matrix"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, random.between(-2, 2), 0.5, 0, 1};
    }
  if (nodes.size() > 1 && random.one_in(2)) { // the last is a child of the first
    nodes[0]["children"] = {nodes.size() - 1};
    Json& roots = json["scenes"][0]["nodes"];
    roots.erase(std::remove(roots.begin(), roots.end(), Json(nodes.size() - 1)), roots.end());
  }
  if (others) {
    put_elsewhere(json, *others, folder / "");
    bind_some(json, *others, folder / "");
  }
  write_file(folder / "mesh.gltf", json.dump());
  Triangle_soup result = read_mesh(folder / "mesh.gltf").soup;
  if (of_tangents)
    make_sides_of_alpha(result);
  return result;
}

// Of those without area a reduction does not know.
std::vector<Index> triangles_with_area(const Triangle_soup& soup)
{
  std::vector<Index> result;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    const auto corner = [&](std::size_t k) {
      const Point_3& p = soup.points[soup.triangles[t][k]];
      return std::array{float(p.x()), float(p.y()), float(p.z())};
    };
    if (corner(0) != corner(1) && corner(1) != corner(2) && corner(2) != corner(0))
      result.push_back(t);
  }
  return result;
}

std::vector<std::string> part_names(const Triangle_soup& soup)
{
  std::set<std::string> names;
  const std::vector<Index> triangles = triangles_with_area(soup);
  for (const auto* labels : {&soup.groups, &soup.objects, &soup.materials})
    for (std::size_t i = 0; i < triangles.size() && !labels->empty(); ++i)
      if (const std::string& name = labels->names[labels->of_triangle[triangles[i]]]; !name.empty())
        names.insert(name);
  return {names.begin(), names.end()};
}

/// Takes triangles that follow each other for a polygon, wherever they are a fan of their first corner.
std::vector<Cut_polygon> fans(const Triangle_soup& soup)
{
  std::vector<Cut_polygon> polygons;
  for (Index t = 0, end = 0; t < soup.triangles.size(); t = end) {
    for (end = t + 1; end < soup.triangles.size() && soup.triangles[end][0] == soup.triangles[t][0] &&
                      soup.triangles[end][1] == soup.triangles[end - 1][2];)
      ++end;
    if (end - t > 1)
      polygons.push_back({t, end - t + 2, 0});
  }
  return polygons;
}

double diagonal(const Triangle_soup& soup)
{
  CGAL::Bbox_3 box;
  for (const Index_triple& triangle : soup.triangles)
    for (const Index v : triangle)
      box += soup.points[v].bbox();
  return soup.triangles.empty()
             ? 0
             : std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

void choose_limits(Simplify_options& options, Random& random)
{
  if (!random.one_in(3)) { // let through what they would hide
    options.max_normal_change = 180;
    options.min_aspect_ratio = 0;
    options.max_border_turn = 180;
    options.max_seam_turn = 180;
    options.max_border_drift = 10;
  }
  const auto sometimes = [&](double& limit, std::initializer_list<double> values) {
    if (random.one_in(8))
      limit = random.one_of(values);
  };
  sometimes(options.max_normal_change, {0, 1, 30, 45, 90, 120, 180});
  sometimes(options.min_aspect_ratio, {0, 0.01, 0.2, 0.7, 1});
  sometimes(options.max_border_turn, {0, 1, 8, 30, 60, 90, 180});
  if (random.one_in(6)) { // low corners, and others
    options.max_border_turn = random.one_of({0, 8, 30});
    options.max_corner_height = random.one_of({0.0, 1e-9, 0.0005, 0.0025, 0.02, 0.1, 10.0});
  }
  sometimes(options.max_seam_turn, {0, 1, 8, 60, 90, 180});
  sometimes(options.max_border_drift, {0, 1e-9, 0.002, 0.05, 10});
  sometimes(options.uv_weight, {0, 1e-3, 0.1, 10});
  sometimes(options.normal_weight, {0, 1e-3, 0.1, 10});
  sometimes(options.cost.border_weight, {0, 0.1, 1, 100});
  sometimes(options.cost.stabiliser, {0, 1e-5, 0.1, 1});
  sometimes(options.cost.memory, {0, 0.5, 1});
  if (random.one_in(8))
    options.max_error = random.one_of({0., 1e-6, 1e-3, 0.02, 0.5});
  options.check_uv_orientation = !random.one_in(10);
}

void choose_target(World& world, Random& random)
{
  Simplify_options& options = world.options;
  options.ratio = random.one_in(2) ? 0 : random.share();
  if (random.one_in(12))
    options.faces = random.below(world.soup.triangles.size() + 4);
  if (random.one_in(12))
    options.ratio.reset();
  if (random.one_in(30))
    world.questions = random.below(4);
  if (world.seed % 16 == 9) // no random number, so that worlds of earlier versions stay what they were
    options.least_faces = {world.soup.triangles.size() / 3, 2, world.soup.triangles.size() / 8};
}

void choose_means(World& world, Random& random)
{
  Simplify_options& options = world.options;
  if (random.one_in(3))
    options.placement = Placement::optimal;
  if (random.one_in(6))
    options.loop = Collapse_loop::cgal;
  if (random.one_in(4))
    options.index = Face_index::clusters;
  if (random.one_in(3))
    options.faces_per_cluster = std::size_t(random.between(1, 40));
  if (random.one_in(4))
    options.faces_per_cell = std::size_t(random.one_of({1, 4, 8, 16, 32, 64, 128}));
}

void choose_parts(World& world, Random& random)
{
  const std::vector<std::string> names = part_names(world.soup);
  Simplify_intent& intent = world.intent;
  if (!names.empty() && random.one_in(3)) {
    if (random.one_in(2))
      intent.locked.push_back(random.one_of(names));
    if (random.one_in(3))
      intent.kept.push_back(random.one_of(names));
    if (random.one_in(2) && world.options.faces_per_cell == 0)
      for (int i = random.between(1, 2); i > 0; --i)
        intent.ratios.push_back({random.one_of(names), random.one_in(3) ? 0 : random.share()});
  }
  if (!world.soup.points.empty() && random.one_in(8))
    for (int i = random.between(1, 6); i > 0; --i)
      intent.locked_vertices.push_back(Index(random.between(0, int(world.soup.points.size()) - 1)));
  for (const Attribute& attribute : world.soup.vertex_attributes)
    if (attribute.name == "w" && random.one_in(2))
      intent.weights = attribute.name;
}

/// Whether the mesh without the dropped parts still has faces, some in each part that has a name in the
/// world. Faces without area do not count, since a reduction leaves them out.
bool are_parts_left(const World& world)
{
  Triangle_soup soup = world.soup;
  try {
    drop_parts(soup, world.dropped_parts);
    keep_triangles(soup, triangles_with_area(soup));
    std::vector<std::string> names = world.intent.locked;
    names.insert(names.end(), world.intent.kept.begin(), world.intent.kept.end());
    for (const Simplify_intent::Part_ratio& part : world.intent.ratios)
      names.push_back(part.name);
    for (const auto& [a, b] : world.may_intersect)
      names.insert(names.end(), {a, b});
    for (const std::string& name : names)
      triangles_named(soup, name);
  } catch (const Error&) {
    return false;
  }
  return !soup.triangles.empty();
}

/// Leaves out a part, or what is small, where that leaves what else is asked for. Other random numbers, so
/// that worlds of earlier versions stay what they were but for that.
void choose_dropped_parts(World& world)
{
  if (world.seed % 7 != 3)
    return;
  Random random(world.seed + 11);
  const std::vector<std::string> names = part_names(world.soup);
  if (random.one_in(2) && !names.empty())
    world.dropped_parts.names.push_back(random.one_of(names));
  if (const std::vector<Sized_piece> pieces = sized_pieces(world.soup);
      !pieces.empty() && (world.dropped_parts.names.empty() || random.one_in(4)))
    world.dropped_parts.smaller_than =
        std::nextafter(pieces[random.below(pieces.size())].size, random.one_in(2) ? 1e300 : 0);
  if (!are_parts_left(world))
    world.dropped_parts = {};
}

/// Has patterns in place of names of parts. No random number, so that worlds of earlier versions stay what
/// they were but for that.
void name_by_patterns(World& world)
{
  const auto replace_last = [](std::string& name) {
    if (name.size() > 1)
      name.back() = '*';
  };
  Simplify_intent& intent = world.intent;
  for (auto* names : {&intent.locked, &intent.kept})
    std::for_each(names->begin(), names->end(), replace_last);
  for (Simplify_intent::Part_ratio& part : intent.ratios)
    replace_last(part.name);
}

/// Makes objects of some of what hangs together by positions, and lets the first two of them intersect. It
/// does nothing where not enough is apart. Other random numbers, so that worlds of earlier versions stay what
/// they were but for that.
void let_objects_intersect(World& world)
{
  Triangle_soup& soup = world.soup;
  if (!soup.objects.empty())
    return;
  const auto position = [&](Index v) { // rounding may join
    const Point_3& p = soup.points[v];
    return std::array{float(p.x()) + 0.f, float(p.y()) + 0.f, float(p.z()) + 0.f};
  };
  std::map<std::array<float, 3>, Index> numbers;
  std::vector<Index> first;
  for (Index v = 0; v < soup.points.size(); ++v)
    first.push_back(numbers.emplace(position(v), v).first->second);
  const auto root = [&](Index v) {
    for (v = first[v]; first[v] != v;)
      v = first[v];
    return v;
  };
  for (const Pose& pose : soup.poses) {
    std::map<std::array<float, 3>, Index> here;
    for (Index v = 0; v < soup.points.size(); ++v) {
      const Point_3& p = pose.points[v];
      const Index other =
          here.emplace(std::array{float(p.x()) + 0.f, float(p.y()) + 0.f, float(p.z()) + 0.f}, v)
              .first->second;
      if (const Index from = root(other), to = root(v); from != to)
        first[std::max(from, to)] = std::min(from, to);
    }
  }
  for (const auto& [a, b, c] : soup.triangles)
    for (const Index v : {b, c})
      if (const Index from = root(a), to = root(v); from != to)
        first[std::max(from, to)] = std::min(from, to);
  // Only what has a triangle with three positions is certain to be there after the preparation.
  std::vector<Index> pieces, proper; // by their roots; the first such triangle of each
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    if (position(a) != position(b) && position(b) != position(c) && position(c) != position(a) &&
        std::find(pieces.begin(), pieces.end(), root(a)) == pieces.end()) {
      pieces.push_back(root(a));
      proper.push_back(t);
    }
  }
  if (pieces.size() < 2)
    return;
  Random random(world.seed + 3);
  std::map<Index, Index> object_of;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    object_of[pieces[i]] = i < 2 ? Index(i + 1) : Index(random.below(3));
  // Half of the time, what comes later of the first piece is of neither object: then stars have faces of both
  // kinds.
  const Index beyond = random.one_in(2) ? proper[0] + Index(random.below(30)) : Index(soup.triangles.size());
  soup.objects.names = {"rest", "skin", "cloth"};
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    const Index piece = root(soup.triangles[t][0]);
    const auto object = object_of.find(piece);
    const bool is_of_neither = object == object_of.end() || (piece == pieces[0] && t > beyond);
    soup.objects.of_triangle.push_back(is_of_neither ? 0 : object->second);
  }
  world.may_intersect = {random.one_in(2) ? std::pair("skin", "cloth") : std::pair("s?in", "clo*")};
}

/// Gives the mesh further poses, and perhaps the obstacle: the space is sheared and turned, positions are
/// jittered by distances that the mesh has, vertices of one position part, or what is connected goes
/// elsewhere. Other random numbers, so that worlds of earlier versions stay what they were but for that.
void add_poses(World& world)
{
  Triangle_soup& soup = world.soup;
  for (const Triangle_soup* part : {&soup, &world.obstacle})
    for (const Point_3& p : part->points)
      for (int axis = 0; axis < 3; ++axis)
        if (p[axis] != 0 && !(std::abs(p[axis]) > 1e-9 && std::abs(p[axis]) < 1e9))
          return;
  Random random(world.seed + 6);
  const bool moves_obstacle = !world.obstacle.triangles.empty() && random.one_in(2);
  for (int number = random.between(1, 3); number > 0; --number) {
    std::array<std::array<double, 3>, 3> map{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (random.one_in(2))
      for (auto& row : map)
        for (double& entry : row)
          entry += random.one_of({0., 0., 0., 1., -1., 0.5});
    const auto mapped_point = [&](const Point_3& p) {
      std::array<double, 3> q{};
      for (std::size_t i = 0; i < 3; ++i)
        q[i] = map[i][0] * p.x() + map[i][1] * p.y() + map[i][2] * p.z();
      return Point_3(q[0], q[1], q[2]);
    };
    const auto any_point = [&] { return soup.points[random.below(soup.points.size())]; };
    const Point_3 from = any_point(), to = any_point();
    const auto displaced = [&](const Point_3& p) {
      return p + random.one_of({1., -1., 0.5, 0.125}) * (to - from);
    };
    Pose pose{"pose_" + std::to_string(number), {}};
    for (const Point_3& p : soup.points)
      pose.points.push_back(mapped_point(p));
    const int kind = random.between(0, 3);
    if (kind == 1) { // by positions: seams stay closed
      std::map<std::array<double, 3>, Point_3> places;
      for (Index v = 0; v < soup.points.size(); ++v) {
        const Point_3& p = soup.points[v];
        const auto [place, is_new] = places.try_emplace({p.x() + 0., p.y() + 0., p.z() + 0.}, pose.points[v]);
        if (is_new && random.one_in(6))
          place->second = displaced(pose.points[v]);
        pose.points[v] = place->second;
      }
    } else if (kind == 2) { // by numbers: seams may open
      for (Point_3& p : pose.points)
        if (random.one_in(12))
          p = displaced(p);
    } else if (kind == 3) { // what has later numbers goes elsewhere
      const std::size_t first = random.below(soup.points.size());
      for (std::size_t v = first; v < soup.points.size(); ++v)
        pose.points[v] = pose.points[v] + (to - from);
    }
    soup.poses.push_back(std::move(pose));
    if (moves_obstacle) {
      Pose& beside = world.obstacle.poses.emplace_back(Pose{soup.poses.back().name, {}});
      for (const Point_3& p : world.obstacle.points)
        beside.points.push_back(mapped_point(p));
    }
  }
  world.weld_distance = 0;
  if (world.open_seams == Open_seams::weld)
    world.open_seams = Open_seams::hold;
  world.is_sewn = false;
}

/// Takes back what does not go with several poses.
void fit_options_to_poses(World& world)
{
  if (world.soup.poses.empty())
    return;
  world.options.faces_per_cell = 0;
  world.options.placement = Placement::vertices;
  if (world.seed % 3 == 0) // no random number, so that worlds of earlier versions stay what they were
    for (std::size_t pose = world.seed % 2; pose < world.soup.poses.size(); pose += 2) {
      if (!world.options.guarded_poses)
        world.options.guarded_poses.emplace();
      world.options.guarded_poses->push_back(pose);
    }
}

/// Asks for a distance between pieces: some share of the size, or a distance that coordinates have, as of
/// sheets above each other. Other random numbers, so that worlds of earlier versions stay what they were but
/// for that.
void choose_clearance(World& world, std::uint64_t number)
{
  const std::vector<Point_3>& points = world.soup.points;
  if (world.seed % 3 != 0 || world.options.faces_per_cell > 0 || !world.may_intersect.empty() ||
      world.weld_distance > 0 || world.open_seams == Open_seams::weld || points.empty())
    return;
  Random random(world.seed + 7 + number);
  const double size = diagonal(world.soup);
  const int axis = int(random.below(3));
  const double difference =
      std::abs(points[random.below(points.size())][axis] - points[random.below(points.size())][axis]);
  const double distance = random.one_in(2) ? difference : size * random.one_of({1e-4, 1e-3, 0.01, 0.05, 0.2});
  if (!(size < 1e100 && distance > 1e-12 * size))
    return;
  world.options.clearance = distance;
}

void choose_options(World& world, Random& random)
{
  choose_limits(world.options, random);
  choose_target(world, random);
  choose_means(world, random);
  choose_parts(world, random);
}

} // namespace

World random_world(std::uint64_t seed)
{
  Random random(seed * 0x9e3779b97f4a7c15 + 1);
  World world;
  world.seed = seed;
  Scene scene = random_scene(random);
  world.scene = scene.name;
  Triangle_soup& soup = world.soup;
  soup = std::move(scene.soup);
  if (world.seed % 16 == 7) {
    Random others(seed + 5); // so that other worlds stay what they were in earlier versions
    const Triangle_soup seam = uneven_seam(others);
    soup = others.one_in(2) ? seam : joined(seam, moved(soup, 40, 0, 0));
    world.scene = "uneven seam beside " + world.scene;
  }
  if (random.one_in(3)) {
    spoil(soup, random);
    world.scene += ", spoiled";
  }
  if (soup.triangles.empty())
    soup.triangles.push_back({0, Index(1 % soup.points.size()), Index(2 % soup.points.size())});
  if (world.seed % 8 == 3) {
    Random others(seed + 3); // so that other worlds stay what they were in earlier versions
    add_needles(soup, others);
    world.scene += ", with needles";
  }
  if (world.seed % 8 == 6 || world.seed % 16 == 13) {
    Random others(seed + 4); // likewise
    add_doubles(soup, others);
    world.scene += ", with doubles";
  }
  if (const std::string done = displace(soup, random); !done.empty())
    world.scene += ", " + done;
  decorate(soup, random);
  if (world.seed % 8 == 1 || world.seed % 16 == 10) {
    Random others(seed + 8); // likewise
    add_poles(soup, others);
    world.scene += ", with poles";
  }
  if (random.one_in(3))
    world.obstacle = random_obstacle(soup, random);

  if (fits_float32(soup) && random.one_in(3)) {
    world.output_format = random.one_of({Mesh_format::stl, Mesh_format::glb, Mesh_format::gltf});
    if (random.one_in(3)) {
      // Another sequence of numbers, so that worlds of earlier versions stay what they were.
      Random others(seed + 2), of_tangents(seed + 9);
      const bool is_shared = soup.triangles.size() < 150 && world.seed % 2 == 0, has_tangents = seed % 5 < 2;
      soup = as_scene(std::move(soup), random, is_shared ? &others : nullptr,
                      has_tangents ? &of_tangents : nullptr);
      if (has_tangents)
        world.scene += ", with tangents";
      if (Random of_steps(seed + 10); of_steps.one_in(3)) {
        Triangle_soup quantised = soup;
        quantise(quantised, of_steps);
        if (are_finite(quantised.points)) { // those about as large as floats are not
          soup = through_file(quantised, "mesh.glb");
          world.scene += ", quantised";
        }
      }
      if (is_shared)
        world.scene += ", meshes in several places";
      world.input_format = Mesh_format::gltf;
      world.scene += ", a scene with transforms";
    } else if (random.one_in(6)) {
      Triangle_soup rounded = soup;
      round_to_float32(rounded);
      soup = through_file(rounded, "mesh.stl");
      world.input_format = Mesh_format::stl;
    }
  } else if (random.one_in(6)) {
    world.output_format = random.one_of({Mesh_format::ply, Mesh_format::off});
    if (random.one_in(2)) {
      soup = through_file(soup, "mesh.ply");
      world.input_format = Mesh_format::ply;
    }
  }
  Random of_numbers(seed + 3); // another sequence, as above
  const bool is_numbered = of_numbers.one_in(6) && !soup.scene && world.input_format != Mesh_format::stl &&
                           !soup.triangles.empty();
  if (is_numbered) {
    number_triangles(soup, of_numbers);
    soup = through_file(soup, "mesh.ply");
    world.input_format = Mesh_format::ply;
    world.scene += ", with numbers of triangles";
  }

  choose_options(world, random);
  if (random.one_in(5))
    world.weld_distance = diagonal(soup) * random.one_of({1e-12, 1e-6, 1e-3, 0.02, 0.1});
  if (!std::isfinite(world.weld_distance))
    world.weld_distance = 0;
  // No random number, so that worlds of earlier versions stay what they were.
  if (world.weld_distance == 0)
    world.open_seams = world.seed % 4 == 1   ? Open_seams::weld
                       : world.seed % 4 == 2 ? Open_seams::ignore
                                             : Open_seams::hold;
  world.are_faces_oriented = world.seed % 8 != 5;
  world.options.instances = world.seed % 16 == 2 ? Instances::apart : Instances::shared;
  if (!world.soup.normals.empty())
    world.normals = random.one_of({Normals_choice::automatic, Normals_choice::keep, Normals_choice::loose,
                                   Normals_choice::recompute, Normals_choice::drop});
  else if (world.seed % 8 == 4 && world.input_format == Mesh_format::obj) { // no random number, as above
    world.soup.normals.values = {{0, 0, 1}};
    world.soup.normals.of_triangle.assign(world.soup.triangles.size(), {0, 0, 0});
    restore_normals(world.soup, Normals_treatment::smooth);
  }
  if (world.normals == Normals_choice::automatic && world.seed % 4 == 3) // no random number, as above
    world.normals = Normals_choice::mend;
  if (world.seed % 8 == 6) // here as well
    world.normals = Normals_choice::smooth;
  world.normals = suited_to(world.soup, world.normals);
  if (world.normals == Normals_choice::loose && world.seed % 4 == 1) // here as well
    world.normals = Normals_choice::soft;
  if (joins_vertices(world.normals) && !world.soup.normals.empty() && world.seed % 4 != 3 &&
      !world.soup.scene) {
    Triangle_soup split = split_by_normals(world.soup);  // as a PLY file has it
    if (split.points.size() >= world.soup.points.size()) // else a vertex that is to be locked may be gone
      world.soup = std::move(split);
  }
  if (random.one_in(12) && !world.options.faces) {
    for (int i = random.between(1, 3); i > 0; --i)
      world.lods.push_back(random.share());
    world.options.ratio.reset();
  }
  world.is_sewn = random.one_in(12) && world.output_format != Mesh_format::stl; // which is refused
  const bool has_polygons =
      world.seed % 2 == 0; // no random number, so that worlds of earlier versions stay what they were
  if (has_polygons)
    world.soup.polygons = fans(world.soup);
  world.defects = random.one_in(25) ? Defects::refuse : random.one_in(4) ? Defects::freeze : Defects::descend;
  if (world.seed % 5 == 4 && (world.input_format == Mesh_format::obj || is_numbered) &&
      !world.soup.points.empty())
    add_poses(world);
  fit_options_to_poses(world);
  // Cells refuse the option, and snaps may join the two parts.
  if (world.seed % 3 != 0 && world.input_format == Mesh_format::obj && world.options.faces_per_cell == 0 &&
      world.weld_distance == 0 && world.open_seams != Open_seams::weld)
    let_objects_intersect(world);
  if (world.seed % 3 == 1)
    name_by_patterns(world);
  choose_clearance(world, 0);
  if (world.seed % 4 == 1 && !world.soup.uvs.empty()) // no random number, as above
    world.dropped.push_back("texture");
  if (world.seed % 4 <= 1 && world.intent.weights.empty() && !world.soup.vertex_attributes.empty() &&
      !world.soup.scene)
    world.dropped.push_back(world.soup.vertex_attributes.back().name);
  if (world.seed % 4 == 2 && world.soup.vertex_attributes.empty() && !world.soup.scene &&
      world.input_format != Mesh_format::stl) // here as well
    paint(world.soup);
  choose_dropped_parts(world);
  return world;
}

World with_other_options(const World& world, std::uint64_t number)
{
  World other = world;
  other.options = Simplify_options();
  other.intent = Simplify_intent();
  other.lods.clear();
  other.questions.reset();
  Random random(world.seed * 0x9e3779b97f4a7c15 + number * 0xd1b54a32d192ed03);
  choose_options(other, random);
  if (!world.may_intersect.empty())
    other.options.faces_per_cell = 0;
  if (std::count(other.dropped.begin(), other.dropped.end(), other.intent.weights) > 0)
    other.intent.weights.clear();
  fit_options_to_poses(other);
  choose_clearance(other, number);
  if (!are_parts_left(other)) { // what is dropped is part of the preparation, which stays
    other.intent.locked.clear();
    other.intent.kept.clear();
    other.intent.ratios.clear();
  }
  return other;
}

} // namespace selvedge::test
