// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_RANDOM_SCENE_H
#define SELVEDGE_TEST_WORLDS_RANDOM_SCENE_H

#include "Random.h"

#include <selvedge/Triangle_soup.h>

#include <string>

namespace selvedge::test {

/// A shape of at most some hundred faces, with small integer coordinates as a rule, and what it is called:
/// layers, wheels, fins, closed surfaces, patchwork and others, or two of them in one place.
struct Scene
{
  std::string name;
  Triangle_soup soup;
};

Scene random_scene(Random& random);

/// Two curved sheets with a narrow gap, along which they have different numbers of vertices.
Triangle_soup uneven_seam(Random& random);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_RANDOM_SCENE_H
