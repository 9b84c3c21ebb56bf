// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_TUNNEL_SCENE_H
#define SELVEDGE_TEST_SUPPORT_TUNNEL_SCENE_H

#include "soup/selection.h"
#include <selvedge/generate.h>

#include <vector>

namespace selvedge::test {

/// One of the bumps of the scene "tunnel", over its patch. Moving `moving` along the edge to `target` leaves
/// an embedded mesh, but on the way the faces at `moving` pass through the patch, which lies under the bump
/// before and above the sheet after. No other rule refuses this collapse: `moving` is the only interior
/// vertex, the link condition holds, normals turn by at most 17°, and no triangle gets an aspect ratio below
/// 0.2. Every other vertex is a corner of a border, so that a border rule allows no other collapse.
struct Tunnel_scene
{
  Triangle_soup soup;
  Index moving = 0;
  Index target = 1;
};

inline Tunnel_scene tunnel_scene()
{
  Generate_options options;
  options.faces = 100;
  Tunnel_scene scene{generate("tunnel", options)};
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;
  for (Index t = 0; t < 7; ++t) {
    triangles.push_back(t);
    corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  scene.soup = selected(scene.soup, triangles, corners);
  return scene;
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_TUNNEL_SCENE_H
