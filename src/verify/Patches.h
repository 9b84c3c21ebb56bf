// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_PATCHES_H
#define SELVEDGE_SRC_VERIFY_PATCHES_H

#include "Shape.h"

#include <CGAL/Bbox_3.h>

#include <memory>
#include <vector>

namespace selvedge::internal {

/// A set of triangles with one name that are connected by vertex numbers.
struct Patch
{
  Index name;
  std::vector<Index> triangles;
};

/// Returns the patches of some triangles, in the order of their first ones. `names` holds the number of the
/// name of each of these triangles.
std::vector<Patch> patches(const Triangle_soup& soup, const std::vector<Index>& triangles,
                           const std::vector<Index>& names);

/// Compares patches of a result with those of its original by their shapes.
class Patch_shapes
{
public:
  /// Takes the patches of the original; `soup` must outlive this object. All points are divided by
  /// 2^`exponent`.
  Patch_shapes(const Triangle_soup& soup, std::vector<Patch> patches, int exponent);

  /// Returns whether, of all patches of the original, one with the name of this patch of `result` is the most
  /// like it: no other has a lower root mean square distance between its vertices and the surface of this
  /// patch, in the direction in which it is larger.
  bool is_likest_of_its_name(const Triangle_soup& result, const Patch& patch);

private:
  double distance(const Shape& to, std::size_t patch);

  const Triangle_soup& m_soup;
  std::vector<Patch> m_patches;
  int m_exponent;
  std::vector<CGAL::Bbox_3> m_boxes;
  std::vector<std::unique_ptr<Shape>> m_shapes; // each made when it is first asked for
};

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_PATCHES_H
