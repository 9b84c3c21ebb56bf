// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "material_textures.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

namespace selvedge {
namespace {

using Json = Gltf_scene::Json;
using Flags = std::vector<char>;

/// Calls a function for each reference to a texture within materials, and removes those for which it returns
/// true.
template <class Function>
void erase_texture_references(Json& json, const Function& is_erased)
{
  if (!json.is_structured())
    return;
  for (auto entry = json.begin(); entry != json.end();) {
    const std::string key = json.is_object() ? entry.key() : "";
    const bool is_reference = key.size() >= 7 && key.compare(key.size() - 7, 7, "Texture") == 0 &&
                              entry->is_object() && entry->contains("index");
    if (is_reference && is_erased(*entry)) {
      entry = json.erase(entry);
      continue;
    }
    erase_texture_references(*entry, is_erased);
    ++entry;
  }
}

/// Adds the numbers of all materials that are named anywhere in meshes: by primitives, and by their variants.
void find_materials(const Json& json, std::set<Index>& materials)
{
  if (!json.is_structured())
    return;
  for (const auto& [key, value] : json.items())
    if (key == "material" && value.is_number_unsigned())
      materials.insert(value.get<Index>());
    else
      find_materials(value, materials);
}

Json set_of(const Json& reference)
{
  const Json::json_pointer moved("/extensions/KHR_texture_transform/texCoord");
  return reference.contains(moved) ? reference[moved] : reference.value("texCoord", Json(0));
}

// Whether all references to textures are in materials, and all those to images and samplers in textures.
bool are_all_references_known(const Json& document)
{
  constexpr std::array<std::string_view, 5> prefixes{"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                                     "MSFT_texture_", "KHR_lights_"};
  constexpr std::array<std::string_view, 6> names{"KHR_mesh_quantization",
                                                  "KHR_draco_mesh_compression",
                                                  "EXT_meshopt_compression",
                                                  "EXT_mesh_gpu_instancing",
                                                  "MSFT_lod",
                                                  "MSFT_screencoverage"};
  const auto is_known = [&](const Json& extension) {
    const std::string name = extension.is_string() ? extension.get<std::string>() : "";
    return std::find(names.begin(), names.end(), name) != names.end() ||
           std::any_of(prefixes.begin(), prefixes.end(),
                       [&](std::string_view prefix) { return name.compare(0, prefix.size(), prefix) == 0; });
  };
  const Json used = document.value("extensionsUsed", Json::array());
  return std::all_of(used.begin(), used.end(), is_known);
}

/// A list of the document, such as `images`, and which of its elements go.
class Shortened_list
{
public:
  Shortened_list(Json& document, const char* name)
      : m_document(document), m_name(name),
        m_is_dropped(document.contains(name) && document[name].is_array() ? document[name].size() : 0, false)
  {
  }

  std::size_t size() const { return m_is_dropped.size(); }
  Json& operator[](std::size_t number) { return m_document[m_name][number]; }
  bool is_dropped(std::size_t number) const { return m_is_dropped[number]; }

  /// Drops the elements that have the one flag, and not the other.
  void drop(const Flags& is_of_dropped, const Flags& is_kept)
  {
    for (std::size_t i = 0; i < size(); ++i)
      m_is_dropped[i] = is_of_dropped[i] && !is_kept[i];
  }

  /// Returns the element to which a member of `from` refers; none where there is no such.
  std::optional<std::size_t> target(const Json& from, const char* key) const
  {
    if (!from.is_object() || !from.contains(key) || !from[key].is_number_integer() ||
        from[key].get<std::int64_t>() < 0 || from[key].get<std::size_t>() >= size())
      return std::nullopt;
    return from[key].get<std::size_t>();
  }

  /// Gives a reference the number that its element has after `shorten`.
  void renumber(Json& from, const char* key) const
  {
    if (const std::optional<std::size_t> number = target(from, key))
      from[key] = std::count(m_is_dropped.begin(), m_is_dropped.begin() + std::ptrdiff_t(*number), false);
  }

  /// Removes the elements that go, and the list when it is empty then.
  void shorten()
  {
    for (std::size_t i = size(); i-- > 0;)
      if (m_is_dropped[i])
        m_document[m_name].erase(i);
    if (size() > 0 && m_document[m_name].empty())
      m_document.erase(m_name);
  }

private:
  Json& m_document;
  const char* m_name;
  Flags m_is_dropped;
};

/// Calls a function for each object that names a source of a texture: itself, and its extensions, such as
/// KHR_texture_basisu.
template <class Function>
void for_each_source(Json& texture, const Function& function)
{
  function(texture);
  if (texture.is_object() && texture.contains("extensions") && texture["extensions"].is_object())
    for (Json& extension : texture["extensions"])
      function(extension);
}

/// The textures of a document in which references to some have been removed from materials.
class Unused_textures
{
public:
  explicit Unused_textures(Gltf_scene& scene)
      : m_scene(scene), m_textures(scene.document, "textures"), m_images(scene.document, "images"),
        m_samplers(scene.document, "samplers")
  {
  }

  void drop(const std::vector<Json>& references_removed)
  {
    Flags is_of_removed(m_textures.size(), false), is_kept(m_textures.size(), false);
    for (const Json& reference : references_removed)
      mark(m_textures.target(reference, "index"), is_of_removed);
    for_each_reference([&](Json& reference) { mark(m_textures.target(reference, "index"), is_kept); });
    m_textures.drop(is_of_removed, is_kept);
    drop_images_and_samplers();
    free_views();
    renumber();
    m_textures.shorten();
    m_images.shorten();
    m_samplers.shorten();
    std::vector<std::string>& names = m_scene.only_in_gltf;
    for (const char* list : {"textures", "images"})
      if (!m_scene.document.contains(list))
        names.erase(std::remove(names.begin(), names.end(), list), names.end());
  }

private:
  static void mark(const std::optional<std::size_t>& number, Flags& flags)
  {
    if (number)
      flags[*number] = true;
  }

  template <class Function>
  void for_each_reference(const Function& function)
  {
    if (m_scene.document.contains("materials"))
      erase_texture_references(m_scene.document["materials"], [&](Json& reference) {
        function(reference);
        return false;
      });
  }

  void drop_images_and_samplers()
  {
    Flags images[2], samplers[2]; // of textures that stay, and of those that go
    for (const bool is_dropped : {false, true}) {
      images[is_dropped].assign(m_images.size(), false);
      samplers[is_dropped].assign(m_samplers.size(), false);
    }
    for (std::size_t t = 0; t < m_textures.size(); ++t) {
      const bool is_dropped = m_textures.is_dropped(t);
      mark(m_samplers.target(m_textures[t], "sampler"), samplers[is_dropped]);
      for_each_source(m_textures[t], [&](const Json& source) {
        mark(m_images.target(source, "source"), images[is_dropped]);
      });
    }
    m_images.drop(images[true], images[false]);
    m_samplers.drop(samplers[true], samplers[false]);
  }

  // Frees the buffer views of images that go, but for those that something else has as well.
  void free_views()
  {
    Flags is_freed(m_scene.views.size(), false);
    const auto set = [&](const Json& element, bool is_free) {
      if (element.is_object() && element.contains("bufferView") && element["bufferView"].is_number_unsigned())
        if (const std::size_t view = element["bufferView"]; view < is_freed.size())
          is_freed[view] = is_free;
    };
    for (const bool is_dropped : {true, false})
      for (std::size_t i = 0; i < m_images.size(); ++i)
        if (m_images.is_dropped(i) == is_dropped)
          set(m_images[i], is_dropped);
    for (const Json& accessor : m_scene.document.value("accessors", Json::array()))
      set(accessor, false);
    for (Index view = 0; view < is_freed.size(); ++view)
      if (is_freed[view]) {
        std::vector<Index>& free = m_scene.free_views;
        free.insert(std::lower_bound(free.begin(), free.end(), view), view);
        m_scene.views[view].clear();
      }
  }

  void renumber()
  {
    for_each_reference([&](Json& reference) { m_textures.renumber(reference, "index"); });
    for (std::size_t t = 0; t < m_textures.size(); ++t) {
      m_samplers.renumber(m_textures[t], "sampler");
      for_each_source(m_textures[t], [&](Json& source) { m_images.renumber(source, "source"); });
    }
  }

  Gltf_scene& m_scene;
  Shortened_list m_textures, m_images, m_samplers;
};

} // namespace

std::vector<Index> materials_of(const Gltf_scene& scene, const std::vector<char>& is_dropped)
{
  const Json& document = scene.document;
  if (!document.contains("materials") || !document.contains("meshes") || !are_all_references_known(document))
    return {};
  Json others = document["meshes"];
  std::set<Index> dropped, kept;
  for (std::size_t part = 0; part < is_dropped.size(); ++part)
    if (is_dropped[part]) {
      Json& primitive = others[scene.parts[part].mesh]["primitives"][scene.parts[part].primitive];
      find_materials(primitive, dropped);
      primitive = nullptr;
    }
  find_materials(others, kept);
  const Json::json_pointer levels("/extensions/MSFT_lod/ids");
  for (const Json& material : document["materials"])
    if (material.contains(levels))
      for (const Json& id : material[levels])
        if (id.is_number_unsigned())
          kept.insert(id.get<Index>());
  std::vector<Index> result;
  std::set_difference(dropped.begin(), dropped.end(), kept.begin(), kept.end(), std::back_inserter(result));
  return result;
}

void drop_textures_of(Gltf_scene& scene, const std::vector<Index>& materials)
{
  std::vector<Json> removed;
  for (const Index material : materials)
    if (material < scene.document["materials"].size())
      erase_texture_references(scene.document["materials"][material], [&](const Json& reference) {
        removed.push_back(reference);
        return true;
      });
  if (!removed.empty())
    Unused_textures(scene).drop(removed);
}

void drop_textures(Gltf_scene& scene, const std::function<bool(const std::string& set)>& is_dropped)
{
  if (!scene.document.contains("materials"))
    return;
  std::vector<Json> removed;
  erase_texture_references(scene.document["materials"], [&](const Json& reference) {
    if (!is_dropped("TEXCOORD_" + set_of(reference).dump()))
      return false;
    removed.push_back(reference);
    return true;
  });
  if (!removed.empty() && are_all_references_known(scene.document))
    Unused_textures(scene).drop(removed);
}

} // namespace selvedge
