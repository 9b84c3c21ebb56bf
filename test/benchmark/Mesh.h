// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BENCHMARK_MESH_H
#define SELVEDGE_BENCHMARK_MESH_H

#include <selvedge/generate.h>
#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>

namespace selvedge::benchmark {

struct Mesh
{
  std::string name; // nothing in it that CSV, markdown or SVG would have to escape
  Prepared_soup prepared;
};

/// A file, or what `generate` makes: SCENE:FACES. By default faces that intersect already do not move, which
/// any program can be asked for.
inline Mesh mesh(const std::string& argument, Defects defects = Defects::freeze)
{
  Prepare_options of_soup;
  of_soup.defects = defects;
  of_soup.normals = Normals_choice::automatic;
  of_soup.open_seams = Open_seams::hold;
  std::string name = std::filesystem::path(argument).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != ':'; },
      '_');
  const std::size_t colon = argument.rfind(':');
  if (colon == std::string::npos || std::filesystem::exists(argument))
    return {name, prepare(read_mesh(argument).soup, of_soup)};
  Generate_options options;
  const char* const end = argument.data() + argument.size();
  if (const auto [stop, error] = std::from_chars(argument.data() + colon + 1, end, options.faces);
      error != std::errc() || stop != end)
    throw CLI::ValidationError(argument + " is neither a file nor SCENE:FACES");
  return {name, prepare(generate(argument.substr(0, colon), options), of_soup)};
}

} // namespace selvedge::benchmark

#endif // SELVEDGE_BENCHMARK_MESH_H
