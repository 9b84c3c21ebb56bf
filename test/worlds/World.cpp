// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "World.h"

#include "soup/Gltf_scene.h"

#include <selvedge/poses.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace selvedge::test {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* s_extensions[] = {"obj", "off", "ply", "stl", "glb", "gltf"}; // by Mesh_format

std::string extension(Mesh_format format)
{
  return s_extensions[std::size_t(format)];
}

std::string text_of(double number)
{
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

template <class Value>
Json optional_json(const std::optional<Value>& value)
{
  return value ? Json(*value) : Json(nullptr);
}

template <class Value>
void read_optional(const Json& json, std::optional<Value>& value)
{
  if (!json.is_null())
    value = json.get<Value>();
}

// Returns whether Draco holds some column of the vertices on the steps of a quantisation.
bool is_quantised(const Gltf_scene& scene)
{
  for (const Gltf_scene::Block& block : scene.blocks)
    for (const Gltf_scene::Column& column : block.attributes)
      if (column.compression && column.compression->quantisation)
        return true;
  return false;
}

Mesh_format format_of(const Json& json)
{
  return mesh_format("mesh." + json.get<std::string>());
}

} // namespace

Prepare_options World::prepare_options() const
{
  Prepare_options prepare;
  prepare.round_to_float32 = needs_float32(soup, output_format);
  prepare.defects = defects;
  prepare.weld_distance = weld_distance;
  prepare.open_seams = open_seams;
  prepare.normals = normals;
  prepare.orient = are_faces_oriented;
  prepare.may_intersect = may_intersect;
  keep_from_snapping(prepare, intent);
  return prepare;
}

void write_world(const World& world, const std::filesystem::path& folder)
{
  std::filesystem::create_directories(folder);
  write_mesh(folder / ("mesh." + extension(world.input_format)), world.soup);
  if (!world.obstacle.triangles.empty())
    write_mesh(folder / "obstacle.obj", world.obstacle);
  for (const auto& [soup, name] :
       {std::make_pair(&world.soup, ""), std::make_pair(&world.obstacle, "obstacle_")})
    for (std::size_t pose = 0; pose < soup->poses.size(); ++pose)
      write_mesh(folder / (name + soup->poses[pose].name + ".obj"), in_pose(*soup, pose));
  Json poses = Json::array();
  for (const Pose& pose : world.soup.poses)
    poses.push_back(pose.name);
  const Simplify_options& options = world.options;
  Json ratios = Json::array();
  for (const Simplify_intent::Part_ratio& part : world.intent.ratios)
    ratios.push_back({{"name", part.name}, {"ratio", part.ratio}});
  const Json json = {{"seed", world.seed},
                     {"scene", world.scene},
                     {"command", command_line(world)},
                     {"input", extension(world.input_format)},
                     {"has_obstacle", !world.obstacle.triangles.empty()},
                     {"poses", poses},
                     {"does_obstacle_move", !world.obstacle.poses.empty()},
                     {"output", extension(world.output_format)},
                     {"sewn", world.is_sewn},
                     {"defects", name_of(world.defects)},
                     {"weld", world.weld_distance},
                     {"open_seams", world.open_seams},
                     {"dropped_parts", world.dropped_parts.names},
                     {"dropped_smaller", world.dropped_parts.smaller_than},
                     {"dropped", world.dropped},
                     {"normals", name_of(world.normals)},
                     {"orient", world.are_faces_oriented},
                     {"may_intersect", world.may_intersect},
                     {"ratio", optional_json(options.ratio)},
                     {"faces", optional_json(options.faces)},
                     {"least_faces", options.least_faces},
                     {"guarded_poses", optional_json(options.guarded_poses)},
                     {"error", optional_json(options.max_error)},
                     {"normal_change", options.max_normal_change},
                     {"aspect_ratio", options.min_aspect_ratio},
                     {"border_turn", options.max_border_turn},
                     {"corner_height", options.max_corner_height},
                     {"seam_turn", options.max_seam_turn},
                     {"border_drift", options.max_border_drift},
                     {"check_intersections", options.check_intersections},
                     {"clearance", optional_json(options.clearance)},
                     {"check_uv_orientation", options.check_uv_orientation},
                     {"uv_weight", options.uv_weight},
                     {"normal_weight", options.normal_weight},
                     {"is_placement_optimal", options.placement == Placement::optimal},
                     {"is_loop_own", options.loop == Collapse_loop::own},
                     {"instances", options.instances == Instances::shared},
                     {"is_index_packed", options.index == Face_index::packed},
                     {"faces_per_cluster", options.faces_per_cluster},
                     {"faces_per_cell", options.faces_per_cell},
                     {"border_weight", options.cost.border_weight},
                     {"stabiliser", options.cost.stabiliser},
                     {"memory", options.cost.memory},
                     {"locked", world.intent.locked},
                     {"locked_vertices", world.intent.locked_vertices},
                     {"kept", world.intent.kept},
                     {"ratios", ratios},
                     {"weights", world.intent.weights},
                     {"lods", world.lods},
                     {"questions", optional_json(world.questions)}};
  write_file(folder / "world.json", json.dump(1) + '\n');
}

World read_world(const std::filesystem::path& folder)
{
  std::ifstream stream(folder / "world.json");
  if (!stream)
    throw std::runtime_error((folder / "world.json").string() + " cannot be read");
  const Json json = Json::parse(stream);
  World world;
  world.seed = json["seed"];
  world.scene = json["scene"];
  world.input_format = format_of(json["input"]);
  world.soup = read_mesh(folder / ("mesh." + extension(world.input_format))).soup;
  if (json["has_obstacle"])
    world.obstacle = read_mesh(folder / "obstacle.obj").soup;
  for (const std::string& pose : json.value("poses", std::vector<std::string>())) {
    world.soup.poses.push_back(read_pose(folder / (pose + ".obj"), world.soup));
    if (json["does_obstacle_move"])
      world.obstacle.poses.push_back(
          {pose, read_pose(folder / ("obstacle_" + pose + ".obj"), world.obstacle).points});
  }
  world.output_format = format_of(json["output"]);
  world.is_sewn = json["sewn"];
  // Worlds of earlier versions say whether they are strict.
  const std::string defects = json.value("defects", json.value("strict", false) ? "refuse" : "freeze");
  for (const Defects choice : {Defects::descend, Defects::freeze, Defects::refuse})
    if (defects == name_of(choice))
      world.defects = choice;
  world.weld_distance = json["weld"];
  // Worlds of earlier versions say only whether they are welded.
  world.open_seams =
      json.value("open_seams", json.value("weld_auto", false) ? Open_seams::weld : Open_seams::ignore);
  world.dropped_parts.names = json.value("dropped_parts", world.dropped_parts.names);
  world.dropped_parts.smaller_than = json.value("dropped_smaller", 0.);
  world.dropped = json.value("dropped", world.dropped);
  const std::string normals = json.value("normals", "keep"); // worlds of earlier versions have none
  for (const Normals_choice choice :
       {Normals_choice::automatic, Normals_choice::keep, Normals_choice::mend, Normals_choice::loose,
        Normals_choice::soft, Normals_choice::recompute, Normals_choice::smooth, Normals_choice::drop})
    if (normals == name_of(choice))
      world.normals = choice;
  world.are_faces_oriented = json.value("orient", false);
  world.may_intersect = json.value("may_intersect", world.may_intersect);
  Simplify_options& options = world.options;
  read_optional(json["ratio"], options.ratio);
  read_optional(json["faces"], options.faces);
  if (json.contains("guarded_poses")) // worlds of earlier versions have none
    read_optional(json["guarded_poses"], options.guarded_poses);
  options.least_faces = json.value("least_faces", options.least_faces); // likewise
  read_optional(json["error"], options.max_error);
  if (json.contains("clearance")) // likewise
    read_optional(json["clearance"], options.clearance);
  options.max_normal_change = json["normal_change"];
  options.min_aspect_ratio = json["aspect_ratio"];
  options.max_border_turn = json["border_turn"];
  options.max_corner_height = json.value("corner_height", 0.0); // likewise
  options.max_seam_turn = json["seam_turn"];
  options.max_border_drift = json["border_drift"];
  options.check_intersections = json["check_intersections"];
  options.instances = json.value("instances", false) ? Instances::shared : Instances::apart;
  options.check_uv_orientation = json["check_uv_orientation"];
  options.uv_weight = json["uv_weight"];
  options.normal_weight = json.value("normal_weight", 0.0); // worlds of earlier versions have none
  options.placement = json.value("is_placement_optimal", false) ? Placement::optimal : Placement::vertices;
  options.loop = json["is_loop_own"] ? Collapse_loop::own : Collapse_loop::cgal;
  options.index = json["is_index_packed"] ? Face_index::packed : Face_index::clusters;
  options.faces_per_cluster = json["faces_per_cluster"];
  options.faces_per_cell = json["faces_per_cell"];
  options.cost.border_weight = json["border_weight"];
  options.cost.stabiliser = json["stabiliser"];
  options.cost.memory = json["memory"];
  world.intent.locked = json["locked"].get<std::vector<std::string>>();
  if (json.contains("locked_vertices")) // worlds written before there were such have none
    world.intent.locked_vertices = json["locked_vertices"].get<std::vector<Index>>();
  world.intent.kept = json["kept"].get<std::vector<std::string>>();
  for (const Json& part : json["ratios"])
    world.intent.ratios.push_back({part["name"], part["ratio"]});
  world.intent.weights = json["weights"];
  world.lods = json["lods"].get<std::vector<double>>();
  read_optional(json["questions"], world.questions);
  return world;
}

std::string command_line(const World& world)
{
  const Simplify_options &options = world.options, plain;
  std::string command = "selvedge simplify mesh." + extension(world.input_format) + " -o out" +
                        (world.lods.empty() ? "." : "_{lod}.") + extension(world.output_format),
              beyond;
  const auto add = [&](const char* option, const std::string& value) {
    command += std::string(" ") + option + ' ' + value;
  };
  const auto quoted = [](const std::string& text) { return '\'' + text + '\''; };
  const auto add_if_other = [&](const char* option, double value, double default_value) {
    if (value != default_value)
      add(option, text_of(value));
  };
  if (!world.obstacle.triangles.empty())
    add("--obstacle", "obstacle.obj");
  for (const Pose& pose : world.soup.poses)
    add("--pose", pose.name + ".obj");
  for (const Pose& pose : world.obstacle.poses)
    add("--obstacle-pose", "obstacle_" + pose.name + ".obj");
  if (options.ratio)
    add("--ratio", text_of(*options.ratio));
  for (const Simplify_intent::Part_ratio& part : world.intent.ratios)
    add("--ratio", quoted(part.name + '=' + text_of(part.ratio)));
  if (options.faces)
    add("--faces", std::to_string(*options.faces));
  add("--error", options.max_error ? text_of(*options.max_error) : "none");
  std::string lods;
  for (const double lod : world.lods)
    lods += (lods.empty() ? "" : ",") + text_of(lod);
  if (!lods.empty())
    add("--lods", lods);
  if (!options.ratio && !options.faces && !options.max_error && world.intent.ratios.empty() && lods.empty())
    add("--ratio", "0");
  for (const std::string& name : world.intent.locked)
    add("--lock", quoted(name));
  for (const std::string& name : world.intent.kept)
    add("--keep", quoted(name));
  for (const auto& [first, second] : world.may_intersect)
    add("--may-intersect", quoted(first + ':' + second));
  if (!world.intent.weights.empty())
    add("--weights", quoted(world.intent.weights));
  add_if_other("--normal-change", options.max_normal_change, plain.max_normal_change);
  add_if_other("--aspect-ratio", options.min_aspect_ratio, plain.min_aspect_ratio);
  add_if_other("--border-turn", options.max_border_turn, plain.max_border_turn);
  add_if_other("--corner-height", options.max_corner_height, plain.max_corner_height);
  add_if_other("--seam-turn", options.max_seam_turn, plain.max_seam_turn);
  add_if_other("--border-drift", options.max_border_drift, plain.max_border_drift);
  if (options.clearance)
    add("--clearance", text_of(*options.clearance));
  add_if_other("--uv-weight", options.uv_weight, plain.uv_weight);
  add_if_other("--normal-weight", options.normal_weight, plain.normal_weight);
  add_if_other("--border-weight", options.cost.border_weight, plain.cost.border_weight);
  add_if_other("--stabiliser", options.cost.stabiliser, plain.cost.stabiliser);
  add_if_other("--memory", options.cost.memory, plain.cost.memory);
  add_if_other("--weld", world.weld_distance, 0);
  if (world.open_seams == Open_seams::weld)
    add("--weld", "auto");
  if (world.open_seams == Open_seams::ignore && world.weld_distance == 0)
    add("--weld", "none");
  for (const std::string& name : world.dropped_parts.names)
    add("--drop-part", quoted(name));
  add_if_other("--drop-smaller", world.dropped_parts.smaller_than, 0);
  for (const std::string& name : world.dropped)
    add("--drop-attribute", name);
  if (world.normals != Normals_choice::automatic)
    add("--normals", name_of(world.normals));
  if (!world.are_faces_oriented)
    add("--orient", "keep");
  add("--placement", options.placement == Placement::optimal ? "optimal" : "vertices");
  if (options.loop != plain.loop)
    add("--loop", "cgal");
  if (options.instances != plain.instances)
    add("--instances", "apart");
  if (options.index != plain.index)
    add("--index", "clusters --cluster-size " + std::to_string(options.faces_per_cluster));
  if (!options.check_intersections)
    add("--no-intersection-check", "");
  if (world.is_sewn)
    add("--sewn", "");
  add("--defects", name_of(world.defects));
  if (options.faces_per_cell > 0) {
    add("--cells", "");
    beyond += "; cells of " + std::to_string(options.faces_per_cell) + " faces";
  }
  if (!options.check_uv_orientation)
    beyond += "; the texture may turn over";
  if (!world.intent.locked_vertices.empty())
    beyond += "; locked vertices";
  if (world.questions)
    beyond += "; stopped at question " + std::to_string(*world.questions + 1);
  return command + (beyond.empty() ? "" : " #" + beyond.substr(1));
}

std::set<std::string> options_used(const World& world)
{
  std::set<std::string> options{"to_" + extension(world.output_format)};
  std::istringstream words(command_line(world));
  for (std::string word; words >> word;)
    if (word.compare(0, 2, "--") == 0)
      options.insert(word);
  options.erase("--defects"); // which every world names
  options.insert(std::string("defects_") + name_of(world.defects));
  if (!world.options.check_uv_orientation)
    options.insert("texture_may_turn");
  if (world.questions)
    options.insert("stopped_early");
  if (!world.soup.polygons.empty())
    options.insert("polygons");
  if (tangents_of(world.soup))
    options.insert("tangents");
  if (world.soup.scene && is_quantised(*world.soup.scene))
    options.insert("quantised");
  return options;
}

const Attribute* tangents_of(const Triangle_soup& soup)
{
  const auto& attributes = soup.vertex_attributes;
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [](const Attribute& attribute) { return attribute.name == "TANGENT"; });
  return found == attributes.end() ? nullptr : &*found;
}

std::string describe(const World& world)
{
  return "seed " + std::to_string(world.seed) + ": " + world.scene + ", " +
         std::to_string(world.soup.triangles.size()) + " faces, " +
         std::to_string(world.obstacle.triangles.size()) + " of an obstacle: " + command_line(world);
}

} // namespace selvedge::test
