// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/references.h>

#include "soup/Gltf_scene.h"

#include <cctype>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <system_error>

namespace selvedge {
namespace {

namespace fs = std::filesystem;

// An empty path names the current folder.
fs::path folder(const fs::path& path)
{
  return fs::weakly_canonical(fs::absolute(path.empty() ? fs::path(".") : path));
}

std::string decoded(const std::string& address)
{
  std::string text;
  for (std::size_t i = 0; i < address.size(); ++i)
    if (address[i] == '%' && i + 2 < address.size() && std::isxdigit((unsigned char)(address[i + 1])) &&
        std::isxdigit((unsigned char)(address[i + 2]))) {
      text += char(std::strtol(address.substr(i + 1, 2).c_str(), nullptr, 16));
      i += 2;
    } else {
      text += address[i];
    }
  return text;
}

std::string encoded(const std::string& text)
{
  static const char digits[] = "0123456789ABCDEF";
  std::string address;
  for (const char c : text) {
    const unsigned char byte = (unsigned char)(c);
    if (std::isalnum(byte) || std::string("/._-~").find(c) != std::string::npos)
      address += c;
    else
      ((address += '%') += digits[byte / 16]) += digits[byte % 16];
  }
  return address;
}

/// Moves names from one folder to another, and lists what they have become.
class Relocation
{
public:
  Relocation(const fs::path& from, const fs::path& to) : m_from(folder(from)), m_to(folder(to)) {}

  bool is_needed() const { return m_from != m_to; }

  std::string relocated(const std::string& name)
  {
    if (name.empty() || fs::path(name).is_absolute())
      return name;
    m_names.push_back(fs::relative(m_from / name, m_to).generic_string());
    return m_names.back();
  }

  std::string relocated_statement(const std::string& statement)
  {
    std::error_code ignored;
    if (statement.find(' ') == std::string::npos || fs::exists(m_from / statement, ignored))
      return relocated(statement);
    std::istringstream words(statement);
    std::string result;
    for (std::string word; words >> word;)
      result += (result.empty() ? "" : " ") + relocated(word);
    return result;
  }

  std::string relocated_address(const std::string& address)
  {
    const std::size_t colon = address.find(':'); // ends a scheme, unless a folder comes before it
    return colon != std::string::npos && colon < address.find('/') ? address
                                                                   : encoded(relocated(decoded(address)));
  }

  std::vector<std::string> take_names() { return std::move(m_names); }

private:
  fs::path m_from, m_to;
  std::vector<std::string> m_names;
};

} // namespace

std::vector<std::string> relocate_references(Triangle_soup& soup, Mesh_format format, const fs::path& from,
                                             const fs::path& to)
{
  Relocation relocation(from, to);
  if (!relocation.is_needed())
    return {};
  if (format == Mesh_format::obj)
    for (std::string& statement : soup.material_libraries)
      statement = relocation.relocated_statement(statement);
  const bool is_gltf = format == Mesh_format::glb || format == Mesh_format::gltf;
  if (is_gltf && soup.scene && soup.scene->document.contains("images")) {
    const auto scene = std::make_shared<Gltf_scene>(*soup.scene);
    for (auto& image : scene->document["images"])
      if (image.is_object() && image.contains("uri") && image["uri"].is_string())
        image["uri"] = relocation.relocated_address(image["uri"].get<std::string>());
    soup.scene = scene;
  }
  return relocation.take_names();
}

} // namespace selvedge
