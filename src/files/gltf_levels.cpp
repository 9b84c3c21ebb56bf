// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/gltf_levels.h"

#include "files/gltf_decoding.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;
using Numbers = std::set<std::size_t>;

/// Returns the list of levels in a node or a material; null when there is none.
const Json* levels_of(const Json& part)
{
  return find_extension(part, levels_extension);
}

/// Leaves one level of a document.
class Level_choice
{
public:
  explicit Level_choice(Gltf_document& document) : m_document(document), m_json(document.json) {}

  void choose(std::size_t level)
  {
    std::size_t levels = 1;
    Numbers of_levels;
    if (const auto list = m_json.find("nodes"); list != m_json.end() && list->is_array())
      for (std::size_t n = 0; n < nodes().size(); ++n) {
        const std::vector<std::size_t> numbers = numbers_of_levels(n);
        levels = std::max(levels, numbers.size() + 1);
        of_levels.insert(numbers.begin(), numbers.end());
      }
    if (level >= levels)
      m_document.fail("level of detail " + std::to_string(level + 1) + " is asked for, but the file has " +
                      (levels == 1 ? "no levels (MSFT_lod)"
                                   : "only levels 1 to " + std::to_string(levels) + " (MSFT_lod)") +
                      "; ask for one that is there");
    if (of_levels.empty())
      return;
    const Numbers in_scenes = kept_nodes(of_levels);
    Numbers nodes_before = below(of_levels);
    nodes_before.insert(in_scenes.begin(), in_scenes.end());
    Numbers meshes;
    for (const std::size_t n : nodes_before)
      if (member(nodes()[n], "mesh").is_number_unsigned())
        meshes.insert(nodes()[n]["mesh"].get<std::size_t>());
    for (const std::size_t n : in_scenes)
      if (levels_of(nodes()[n]))
        put(level, n);
    for (const std::size_t n : kept_nodes(of_levels))
      nodes_before.erase(n);
    drop_nodes(std::move(nodes_before));
    drop_meshes(std::move(meshes));
    m_document.remarks["levels of detail (MSFT_lod), of which this is number " + std::to_string(level + 1) +
                       "; the others are left out"] = levels - 1;
    const Json& materials = member(m_json, "materials");
    if (std::none_of(materials.begin(), materials.end(), levels_of))
      remove_extension(m_json, levels_extension);
  }

private:
  Json& nodes() { return m_json["nodes"]; }

  // Returns the nodes of the coarser levels of a node.
  std::vector<std::size_t> numbers_of_levels(std::size_t n)
  {
    std::vector<std::size_t> result;
    const Json* const levels = levels_of(nodes()[n]);
    if (!levels)
      return result;
    const Json& numbers = levels->is_object() ? member(*levels, "ids") : *levels;
    const auto is_node = [&](const Json& number) {
      return number.is_number_unsigned() && number.get<std::size_t>() < nodes().size();
    };
    if (!numbers.is_array() || !std::all_of(numbers.begin(), numbers.end(), is_node))
      m_document.fail("node " + std::to_string(n) +
                      " has levels of detail (MSFT_lod) that are no nodes of the file; correct its ids");
    for (const Json& number : numbers)
      result.push_back(number);
    return result;
  }

  // Returns these nodes and all below them.
  Numbers below(const Numbers& roots)
  {
    Numbers result;
    std::vector<std::size_t> stack(roots.begin(), roots.end());
    while (!stack.empty()) {
      const std::size_t n = stack.back();
      stack.pop_back();
      if (n >= nodes().size() || !result.insert(n).second || !nodes()[n].is_object())
        continue;
      for (const Json& child : member(nodes()[n], "children"))
        if (child.is_number_unsigned())
          stack.push_back(child);
    }
    return result;
  }

  // Returns the nodes of all scenes; of a document without scenes, all that are not below a level.
  Numbers kept_nodes(const Numbers& of_levels)
  {
    Numbers roots;
    const Json& scenes = member(m_json, "scenes");
    for (const Json& scene : scenes)
      for (const Json& root : scene.is_object() ? member(scene, "nodes") : scene)
        if (root.is_number_unsigned())
          roots.insert(root.get<std::size_t>());
    if (scenes.empty()) {
      const Numbers levels = below(of_levels);
      for (std::size_t n = 0; n < nodes().size(); ++n)
        if (levels.count(n) == 0)
          roots.insert(n);
    }
    return below(roots);
  }

  // Puts the node of a level in the place of the node that names it.
  void put(std::size_t level, std::size_t n)
  {
    const std::vector<std::size_t> numbers = numbers_of_levels(n);
    Json& node = nodes()[n];
    if (level > 0 && !numbers.empty()) {
      Json coarser = nodes()[numbers[std::min(level, numbers.size()) - 1]];
      if (!coarser.is_object())
        return; // is refused when the document is loaded
      coarser.erase("name");
      if (node.contains("name"))
        coarser["name"] = node["name"];
      node = std::move(coarser);
    }
    remove_extension_of(node, levels_extension);
    if (Json& extras = node["extras"]; extras.is_object())
      extras.erase("MSFT_screencoverage");
    if (node["extras"].empty())
      node.erase("extras");
  }

  void drop_nodes(Numbers dropped)
  {
    for (const std::size_t n : dropped)
      nodes()[n] = Json::object();
    drop_channels(dropped);
    for (const Json& skin : member(m_json, "skins"))
      if (skin.is_object())
        for (const Json& joint : member(skin, "joints"))
          if (joint.is_number_unsigned())
            dropped.erase(joint.get<std::size_t>()); // an empty node may be a joint
    while (!nodes().empty() && dropped.count(nodes().size() - 1) != 0)
      nodes().erase(nodes().size() - 1);
  }

  void drop_channels(const Numbers& nodes)
  {
    files::drop_channels(m_json, [&](const Json& channel) {
      const Json& target = channel.is_object() ? member(channel, "target") : channel;
      const Json& node = target.is_object() ? member(target, "node") : target;
      return node.is_number_unsigned() && nodes.count(node.get<std::size_t>()) != 0;
    });
  }

  // Removes these meshes, but for those that a node still names.
  void drop_meshes(Numbers dropped)
  {
    const auto for_each = [this](const auto& function) {
      for (Json& node : nodes())
        if (node.is_object() && node.contains("mesh") && node["mesh"].is_number_unsigned())
          function(node["mesh"]);
    };
    for_each([&](const Json& mesh) { dropped.erase(mesh.get<std::size_t>()); });
    const Json& meshes = member(m_json, "meshes");
    if (!meshes.is_array() || dropped.empty())
      return;
    std::vector<std::size_t> numbers;
    Json kept = Json::array();
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      numbers.push_back(kept.size());
      if (dropped.count(m) == 0)
        kept.push_back(meshes[m]);
    }
    for_each([&](Json& mesh) {
      if (const std::size_t number = mesh; number < numbers.size())
        mesh = numbers[number];
    });
    m_json["meshes"] = std::move(kept);
  }

  Gltf_document& m_document;
  Json& m_json;
};

} // namespace

void choose_level(Gltf_document& document, std::size_t level)
{
  Level_choice(document).choose(level);
}

} // namespace selvedge::files
