// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Error.h>
#include <selvedge/generate.h>

#include "generate/scenes.h"

#include <sstream>

// Makes a mesh by the name of its scene. Generated meshes take the place of a file that is read.

namespace selvedge {

namespace {

struct Scene
{
  Scene_description description;
  double smallest_gap;
  Triangle_soup (*make)(const Generate_options&);
};

const std::vector<Scene>& known_scenes()
{
  static const std::vector<Scene> known{
      {{"skirt", "a pleated skirt on a dress form: layers of cloth, pockets, waistband and button"},
       1e-9,
       internal::skirt},
      {{"jacket",
        "an open jacket with sleeves on a body: layers of cloth, collar, pockets, cuffs and buttons"},
       1e-9,
       internal::jacket},
      {{"shorts",
        "shorts with two legs that share a crotch seam: layers of cloth, pockets, cuffs and waistband"},
       1e-9,
       internal::shorts},
      {{"sheets", "wavy sheets above one another, as close as doubles allow"}, 1e-15, internal::sheets},
      {{"folded", "one cloth that is folded over itself many times"}, 1e-15, internal::folded},
      {{"nested", "closed spheres inside one another"}, 1e-12, internal::nested},
      {{"seams", "flat pieces that meet: at a T-junction, three at one edge, and one turned over"},
       0,
       internal::seams},
      {{"tunnel",
        "shallow bumps over small patches; one collapse of each bump passes through its patch unseen"},
       0,
       internal::tunnels},
      {{"grid", "a flat regular grid, where every quadric error is zero"}, 0, internal::grid},
      {{"needles", "sheets of triangles that are a million times as long as wide"}, 1e-15, internal::needles},
  };
  return known;
}

/// Throws `Argument_error` when a value is out of its range; NaN is out of every range.
void require_range(const char* option, double value, double least, double most)
{
  if (value >= least && value <= most)
    return;
  std::ostringstream message;
  message.precision(10);
  message << option << ": " << value << " is out of range; give a number from " << least << " to " << most;
  throw Argument_error(message.str());
}

} // namespace

const std::vector<Scene_description>& scenes()
{
  static const std::vector<Scene_description> descriptions = [] {
    std::vector<Scene_description> all;
    for (const Scene& scene : known_scenes())
      all.push_back(scene.description);
    return all;
  }();
  return descriptions;
}

Triangle_soup generate(std::string_view name, const Generate_options& options)
{
  for (const Scene& scene : known_scenes()) {
    if (scene.description.name != name)
      continue;
    require_range("faces", static_cast<double>(options.faces), 100, 20e6);
    require_range("layers", options.layers, 1, 100);
    if (options.thickness != 0)
      require_range("thickness", options.thickness, 1e-9, 0.01);
    require_range("gap", options.gap, scene.smallest_gap, 0.01);
    require_range("fold depth", options.fold_depth, 0, 0.03);
    require_range("folds", options.folds, 0, 200);
    if (options.faces < 20 * static_cast<std::size_t>(options.layers))
      throw Argument_error(std::to_string(options.layers) + " layers need more than " +
                           std::to_string(options.faces) + " faces; ask for more faces or fewer layers");
    return scene.make(options);
  }
  std::string message = "there is no scene called '" + std::string(name) + "'; there are";
  const char* separator = " ";
  for (const Scene_description& scene : scenes()) {
    message += separator + std::string(scene.name);
    separator = ", ";
  }
  throw Argument_error(message);
}

} // namespace selvedge
