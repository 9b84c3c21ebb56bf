// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_SLAB_BOX_H
#define SELVEDGE_SPATIAL_SLAB_BOX_H

#include <CGAL/Bbox_3.h>

#include <array>
#include <limits>

namespace selvedge {

/// A box cut by a slab, the space between two parallel planes: the query of an index of faces for something
/// flat that lies askew to the axes.
///
/// What is sought lies in `box`, and for all its points x, in real arithmetic,
/// `lower` ≤ `normal` · (x − `origin`) ≤ `upper`. The normal has any length; without one, as by default,
/// there is no slab. An index may leave out a face whose box lies wholly outside the slab, and may as well
/// ignore the slab: this is a box wherever one is expected.
struct Slab_box
{
  CGAL::Bbox_3 box;
  std::array<double, 3> origin{0, 0, 0};
  std::array<double, 3> normal{0, 0, 0};
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();

  operator const CGAL::Bbox_3&() const { return box; }
};

} // namespace selvedge

#endif // SELVEDGE_SPATIAL_SLAB_BOX_H
