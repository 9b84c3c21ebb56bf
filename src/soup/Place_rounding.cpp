// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Place_rounding.h"

#include "Gltf_scene.h"
#include "gltf_transforms.h"

#include <selvedge/rounding.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace selvedge {
namespace {

constexpr double s_place_unit = 0x1p-45, s_place_beyond = 0x1p6; // of coordinates of new places

} // namespace

Place_rounding::Place_rounding(const Triangle_soup& soup, const Scale& scale, bool is_float32)
    : m_soup(soup), m_scale(scale), m_are_places_in_scene(soup.scene && !is_float32),
      m_have_float32_digits(is_float32 || (!m_are_places_in_scene && has_float32_digits(soup)))
{
  // Whether every coordinate that this may choose is a number of its type after all. A multiple of
  // the unit with as many digits as the type has is one also below the normal numbers.
  const double unit = m_scale.undone(s_place_unit), beyond = m_scale.undone(s_place_beyond);
  using Doubles = std::numeric_limits<double>;
  using Floats = std::numeric_limits<float>;
  m_is_scale_lossless = is_float32 ? unit >= Floats::denorm_min() && beyond <= Floats::max()
                                   : unit >= Doubles::denorm_min() && beyond <= Doubles::max();
}

// At the scale, the largest coordinate of the mesh is about 1. Coordinates of places are multiples of a small
// unit, so that a mesh and its multiple have the same places even where digits are lost near 0.
internal::Optional<Point_3> Place_rounding::operator()(const Point_3& place, Index vertex) const
{
  if (!m_is_scale_lossless)
    return {};
  std::array<double, 3> rounded;
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(place[i]) < s_place_beyond))
      return {};
    constexpr double digits = 1.5 * 0x1p52 * s_place_unit; // a sum with it has no digits below the unit
    const double sum = place[i] + digits;
    rounded[i] = sum - digits;
    if (m_have_float32_digits)
      rounded[i] = nearest_float32(rounded[i]); // has as many digits after multiplication by the scale
  }
  Point_3 result(rounded[0], rounded[1], rounded[2]);
  if (m_are_places_in_scene) {
    const Gltf_scene& scene = *m_soup.scene;
    const auto& instance = scene.instances[scene.instance_of(m_soup.scene_vertices[vertex])];
    const auto in_node = nearest_world_position(
        instance.to_world, scene.blocks[instance.block].attributes.front(), m_scale.undone(result));
    if (!in_node)
      return {};
    result = m_scale(*in_node);
    if (m_scale.undone(result) != *in_node)
      return {};
  }
  if (m_is_allowed && !m_is_allowed(result))
    return {};
  return result;
}

} // namespace selvedge
