// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vertex_weights.h"

#include "Gltf_scene.h"
#include "selection.h"
#include "with_number.h"

#include <selvedge/Error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace selvedge {
namespace {

double first_component(const Attribute& attribute, std::size_t row)
{
  return with_number(attribute.type, [&](auto number) {
    std::memcpy(&number, attribute.rows.data() + row * row_size(attribute), sizeof number);
    return double(number);
  });
}

} // namespace

std::vector<double> vertex_weights(const Triangle_soup& soup, const std::string& name)
{
  const auto found = std::find_if(soup.vertex_attributes.begin(), soup.vertex_attributes.end(),
                                  [&](const Attribute& attribute) { return attribute.name == name; });
  if (found == soup.vertex_attributes.end()) {
    const bool is_colour = name == "red" || name == "green" || name == "blue" || name == "alpha";
    for (const std::string& lost : soup.scene ? soup.scene->only_in_gltf : std::vector<std::string>())
      if (begins_with(lost, ((is_colour ? "COLOR_0" : name) + ", which ").c_str()))
        throw Argument_error("attribute " + lost + ", cannot weigh vertices");
    std::string known;
    for (const Attribute& attribute : soup.vertex_attributes)
      known += (known.empty() ? "" : ", ") + attribute.name;
    throw Argument_error("no attribute of vertices is called '" + name + "'; " +
                         (known.empty() ? "the mesh has none" : "there are " + known));
  }
  std::vector<double> weights;
  double largest = 0;
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    weights.push_back(first_component(*found, v));
    if (weights.back() < 0 || std::isinf(weights.back()))
      throw Argument_error("the weight '" + name + "' of vertex " + std::to_string(v + 1) +
                           " is not a finite number of at least 0; correct it");
    largest = std::max(largest, weights.back()); // NaN is never larger
  }
  for (double& weight : weights)
    weight = std::isnan(weight) || largest == 0 ? 1 : weight / largest;
  return weights;
}

} // namespace selvedge
