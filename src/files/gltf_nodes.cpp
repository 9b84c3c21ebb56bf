// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/gltf_nodes.h"

#include "files/gltf_decoding.h"
#include "files/gltf_document.h"
#include "files/gltf_levels.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;

// Return what a channel of an animation moves; nobody has checked channels before.
const Json& node_of(const Json& channel)
{
  return member(member(channel, "target"), "node");
}

const Json::json_pointer s_pointer("/target/extensions/KHR_animation_pointer/pointer");

// Returns the pointer to what a channel animates; empty when it has none.
std::string pointer_of(const Json& channel)
{
  return channel.contains(s_pointer) && channel[s_pointer].is_string() ? channel[s_pointer].get<std::string>()
                                                                       : "";
}

bool is_of_weights(const Json& channel)
{
  return member(member(channel, "target"), "path") == "weights";
}

/// Gives nodes their meshes.
class Node_writer
{
public:
  Node_writer(Json& document, const Gltf_scene& scene, std::vector<Gltf_level> levels)
      : m_document(document), m_levels(std::move(levels))
  {
    for (const Gltf_scene::Part& part : scene.parts)
      m_copies[part.mesh_of_file].insert(part.mesh);
    share_between_levels();
    number_meshes();
    for (const Json& animation : member(document, "animations"))
      for (const Json& channel : member(animation, "channels"))
        if (!is_of_weights(channel))
          m_needed_nodes.insert(node_of(channel));
    for (const Json& skin : member(document, "skins")) {
      for (const Json& joint : member(skin, "joints"))
        m_needed_nodes.insert(joint);
      m_needed_nodes.insert(member(skin, "skeleton"));
    }
  }

  void put(const std::vector<Gltf_scene::Instanced_node>& instanced_nodes)
  {
    std::set<std::size_t> instanced;
    for (const Gltf_scene::Instanced_node& node : instanced_nodes)
      instanced.insert(node.node);
    std::vector<Place> places;
    for (std::size_t n = 0; n < nodes().size(); ++n)
      if (nodes()[n].contains("mesh") && instanced.count(n) == 0)
        places.push_back({n, nodes()[n]["mesh"]});
    for (const Gltf_scene::Instanced_node& node : instanced_nodes)
      put_instances(node, places);
    for (const auto& [node, mesh] : places)
      put_levels(node, mesh);
    forget_weights_of_lost_meshes();
    if (!instanced_nodes.empty() && std::all_of(nodes().begin(), nodes().end(), [](const Json& node) {
          return instance_attributes(node).empty();
        }))
      remove_extension(m_document, instancing_extension);
    if (m_has_levels)
      add_extension(m_document, levels_extension, false);
  }

private:
  struct Place
  {
    std::size_t node, mesh; // of the scene
  };

  Json& nodes() { return m_document["nodes"]; }

  // A mesh that is the same in all levels stands in the file once, unless none differs. Levels of a node that
  // differ in others have meshes of their own: Babylon.js lets two nodes of one mesh go together, and it lets
  // each level go when it has the next.
  void share_between_levels()
  {
    const Json& meshes = m_document["meshes"];
    std::vector<std::size_t> alike;
    for (std::size_t m = 0; m < m_levels.front().meshes.size(); ++m)
      if (const std::optional<Index>& finest = m_levels.front().meshes[m];
          finest && std::all_of(m_levels.begin(), m_levels.end(), [&](const Gltf_level& level) {
            return level.meshes[m] && meshes[*level.meshes[m]] == meshes[*finest];
          }))
        alike.push_back(m);
    const auto& finest = m_levels.front().meshes;
    const auto all =
        std::count_if(finest.begin(), finest.end(), [](const auto& mesh) { return mesh.has_value(); });
    if (alike.size() < std::size_t(all))
      for (const std::size_t m : alike)
        for (Gltf_level& level : m_levels)
          level.meshes[m] = m_levels.front().meshes[m];
  }

  void number_meshes()
  {
    Json& meshes = m_document["meshes"];
    std::vector<char> is_kept(meshes.size(), false);
    for (const Gltf_level& level : m_levels)
      for (const std::optional<Index>& mesh : level.meshes)
        if (mesh)
          is_kept[*mesh] = true;
    std::vector<Index> numbers;
    Json kept = Json::array();
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      numbers.push_back(Index(kept.size()));
      if (is_kept[m])
        kept.push_back(std::move(meshes[m]));
    }
    meshes = std::move(kept);
    for (Gltf_level& level : m_levels)
      for (std::optional<Index>& mesh : level.meshes)
        if (mesh)
          mesh = numbers[*mesh];
    number_meshes_of_avatar();
    number_meshes_of_pointers();
  }

  // Returns the meshes that stand for a mesh of the file in the finest levels, so many: several where nodes
  // that shared it have copies that are no longer alike, and none where all its faces are gone.
  std::set<Index> meshes_now(std::size_t mesh_of_file, std::size_t levels) const
  {
    const auto copies = m_copies.find(Index(mesh_of_file));
    std::set<Index> all = {Index(mesh_of_file)}, result;
    if (copies != m_copies.end())
      all.insert(copies->second.begin(), copies->second.end());
    for (std::size_t level = 0; level < levels; ++level)
      for (const Index mesh : all)
        if (const std::optional<Index>& now = m_levels[level].meshes[mesh])
          result.insert(*now);
    return result;
  }

  // VRM 0 names meshes by their numbers, in expressions and for the view through the eyes; VRM 1 names nodes.
  void number_meshes_of_avatar()
  {
    const auto number = [&](Json& entries) {
      if (!entries.is_array())
        return;
      Json left = Json::array();
      for (Json& entry : entries) {
        const Json mesh = member(entry, "mesh");
        if (!mesh.is_number_unsigned() || mesh.get<std::size_t>() >= m_levels.front().meshes.size()) {
          left.push_back(std::move(entry));
          continue;
        }
        for (const Index now : meshes_now(mesh, 1)) {
          entry["mesh"] = now;
          left.push_back(entry);
        }
      }
      entries = std::move(left);
    };
    const Json::json_pointer annotations("/extensions/VRM/firstPerson/meshAnnotations"),
        groups("/extensions/VRM/blendShapeMaster/blendShapeGroups");
    if (m_document.contains(annotations))
      number(m_document[annotations]);
    if (m_document.contains(groups))
      for (Json& group : m_document[groups])
        if (group.contains("binds"))
          number(group["binds"]);
  }

  // Animations by pointers name meshes by their numbers, too: "/meshes/3/weights".
  void number_meshes_of_pointers()
  {
    struct Pointed
    {
      std::set<Index> meshes;
      std::string rest;
    };
    const auto pointed_by = [this](const Json& channel) -> std::optional<Pointed> {
      const std::string start = "/meshes/", text = pointer_of(channel);
      const std::size_t end = text.find_first_not_of("0123456789", start.size());
      constexpr std::size_t most_digits = 9; // those of any number of meshes
      if (text.compare(0, start.size(), start) != 0 || end == start.size() || end == text.npos ||
          end - start.size() > most_digits)
        return std::nullopt;
      const std::size_t mesh = std::stoul(text.substr(start.size(), end - start.size()));
      if (mesh >= m_levels.front().meshes.size())
        return std::nullopt;
      return Pointed{meshes_now(mesh, m_levels.size()), text.substr(end)};
    };
    drop_channels(m_document, [&](const Json& channel) {
      const std::optional<Pointed> pointed = pointed_by(channel);
      return pointed && pointed->meshes.empty();
    });
    for (Json& animation : list("animations")) {
      const Json before = member(animation, "channels");
      if (std::none_of(before.begin(), before.end(), pointed_by))
        continue;
      Json channels = Json::array();
      for (Json channel : before)
        if (const std::optional<Pointed> pointed = pointed_by(channel)) {
          for (const Index mesh : pointed->meshes) {
            channel[s_pointer] = "/meshes/" + std::to_string(mesh) + pointed->rest;
            channels.push_back(channel);
          }
        } else {
          channels.push_back(channel);
        }
      animation["channels"] = std::move(channels);
    }
  }

  static void set_mesh(Json& node, const std::optional<Index>& mesh)
  {
    if (mesh) {
      node["mesh"] = *mesh;
      return;
    }
    for (const char* key : {"mesh", "skin", "weights"})
      node.erase(key);
    remove_extension_of(node, instancing_extension);
  }

  // Instances that do not share one mesh any more, in any level, become nodes.
  void put_instances(const Gltf_scene::Instanced_node& node, std::vector<Place>& places)
  {
    const std::vector<Json>& instances = node.instances;
    const bool are_alike = std::all_of(m_levels.begin(), m_levels.end(), [&](const Gltf_level& level) {
      const auto mesh = [&](const Json& instance) {
        return level.meshes[instance["mesh"].get<std::size_t>()];
      };
      return mesh(instances.front()) && std::all_of(instances.begin(), instances.end(), [&](const Json& i) {
               return mesh(i) == mesh(instances.front());
             });
    });
    if (are_alike)
      return places.push_back({node.node, instances.front()["mesh"]});
    set_mesh(nodes()[node.node], std::nullopt);
    Json numbers = Json::array();
    for (const Json& instance : instances) {
      const std::size_t mesh = instance["mesh"];
      if (!m_levels.front().meshes[mesh])
        continue;
      places.push_back({nodes().size(), mesh});
      numbers.push_back(nodes().size());
      nodes()[node.node]["children"].push_back(nodes().size());
      Json child = instance;
      name_like(node.node, *m_levels.front().meshes[mesh], child);
      nodes().push_back(std::move(child));
    }
    animate_weights(node.node, numbers);
  }

  // Gives a new node that shows a mesh in place of another one a name by which readers call its parts as
  // before: that of the node, of the mesh, or what stands for a node without a name.
  void name_like(std::size_t n, std::size_t mesh, Json& child)
  {
    const auto has_name = [](const Json& element) {
      const Json name = member(element, "name");
      return name.is_string() && name != "";
    };
    if (has_name(nodes()[n]))
      child["name"] = nodes()[n]["name"];
    else if (!has_name(list("meshes")[mesh]))
      child["name"] = "node " + std::to_string(n);
  }

  // No channel may animate the weights of a node without a mesh.
  void forget_weights_of_lost_meshes()
  {
    const auto is_lost = [&](const Json& channel) {
      const Json& node = node_of(channel);
      return is_of_weights(channel) && node.is_number_unsigned() &&
             node.get<std::size_t>() < nodes().size() && !nodes()[node.get<std::size_t>()].contains("mesh");
    };
    drop_channels(m_document, is_lost);
  }

  // Animates the weights of morph targets in some nodes as in the one given.
  void animate_weights(std::size_t node, const Json& numbers)
  {
    for (Json& animation : list("animations")) {
      const Json before = member(animation, "channels");
      for (Json channel : before) {
        if (!before.is_array() || !is_of_weights(channel) || node_of(channel) != node)
          continue;
        for (const Json& number : numbers) {
          channel["target"]["node"] = number;
          animation["channels"].push_back(channel);
        }
      }
    }
  }

  // Puts a mesh of the scene into a node, and its further levels beside it.
  void put_levels(std::size_t node, std::size_t mesh)
  {
    const std::optional<Index> finest = m_levels.front().meshes[mesh];
    set_mesh(nodes()[node], finest);
    if (!finest || std::all_of(m_levels.begin(), m_levels.end(),
                               [&](const Gltf_level& level) { return level.meshes[mesh] == finest; }))
      return;
    m_has_levels = true;
    if (!is_for_its_mesh_alone(node))
      node = with_mesh_in_child(node);
    Json numbers = Json::array(), coverages = Json::array();
    for (std::size_t level = 1; level < m_levels.size(); ++level) {
      numbers.push_back(nodes().size());
      Json coarser = nodes()[node];
      if (member(coarser, "name").is_string())
        coarser["name"] = coarser["name"].get<std::string>() + "_LOD" + std::to_string(level);
      set_mesh(coarser, m_levels[level].meshes[mesh]);
      nodes().push_back(std::move(coarser));
      // As many triangles in a place of the picture as the finest level has where it fills all of it.
      coverages.push_back(double(m_levels[level].triangles) / double(m_levels.front().triangles));
    }
    coverages.push_back(0.0);
    animate_weights(node, numbers);
    Json& extras = nodes()[node]["extras"];
    if (extras.is_null() || extras.is_object())
      extras["MSFT_screencoverage"] = std::move(coverages);
    nodes()[node]["extensions"][levels_extension]["ids"] = std::move(numbers);
  }

  bool is_for_its_mesh_alone(std::size_t n) const
  {
    const Json& node = m_document["nodes"][n];
    const Json& extensions = member(node, "extensions");
    return m_needed_nodes.count(n) == 0 && !node.contains("children") && !node.contains("camera") &&
           (extensions.empty() || (extensions.size() == 1 && extensions.contains(instancing_extension)));
  }

  // Moves what a node shows to a new child of it, and returns the child.
  std::size_t with_mesh_in_child(std::size_t n)
  {
    const std::size_t number = nodes().size();
    Json child = Json::object();
    Json& node = nodes()[n];
    name_like(n, node["mesh"].get<std::size_t>(), child);
    for (const char* key : {"mesh", "skin", "weights"})
      if (node.contains(key))
        child[key] = std::move(node[key]);
    if (!instance_attributes(node).empty())
      child["extensions"][instancing_extension] = node["extensions"][instancing_extension];
    set_mesh(node, std::nullopt);
    node["children"].push_back(number);
    nodes().push_back(std::move(child));
    for (Json& animation : list("animations"))
      for (Json& channel : animation["channels"])
        if (is_of_weights(channel) && node_of(channel) == n)
          channel["target"]["node"] = number;
    follow_mesh(n, number);
    return number;
  }

  // Has VRM 1, and animations by pointers to weights, name another node for a mesh.
  void follow_mesh(std::size_t from, std::size_t to)
  {
    const auto follow = [&](Json& entries) {
      for (Json& entry : entries)
        if (member(entry, "node") == from)
          entry["node"] = to;
    };
    const Json::json_pointer annotations("/extensions/VRMC_vrm/firstPerson/meshAnnotations");
    if (m_document.contains(annotations))
      follow(m_document[annotations]);
    for (const char* kind : {"preset", "custom"}) {
      const Json::json_pointer expressions(std::string("/extensions/VRMC_vrm/expressions/") + kind);
      if (m_document.contains(expressions))
        for (Json& expression : m_document[expressions])
          if (expression.is_object() && expression.contains("morphTargetBinds"))
            follow(expression["morphTargetBinds"]);
    }
    const std::string before = "/nodes/" + std::to_string(from) + "/weights";
    for (Json& animation : list("animations"))
      for (Json& channel : animation["channels"])
        if (const std::string text = pointer_of(channel); text.compare(0, before.size(), before) == 0)
          channel[s_pointer] = "/nodes/" + std::to_string(to) + "/weights" + text.substr(before.size());
  }

  // Returns a list of the document; an empty one when it is not there.
  Json& list(const char* name)
  {
    static Json none;
    none = Json::array();
    const auto found = m_document.find(name);
    return found == m_document.end() ? none : *found;
  }

  Json& m_document;
  std::vector<Gltf_level> m_levels;
  std::map<Index, std::set<Index>> m_copies; // by mesh of the file: those that its places have
  std::set<Json> m_needed_nodes;             // numbers of those that move, or are joints
  bool m_has_levels = false;
};

} // namespace

void put_meshes_in_nodes(Json& document, const Gltf_scene& scene, std::vector<Gltf_level> levels)
{
  Node_writer(document, scene, std::move(levels)).put(scene.instanced_nodes);
}

} // namespace selvedge::files
