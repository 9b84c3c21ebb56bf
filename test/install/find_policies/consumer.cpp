// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/spatial/Clustered_AABB_tree.h>

// Little is compiled here: the policies themselves are in the program beside this one, in add_subdirectory.
int main()
{
  selvedge::Clustered_AABB_tree index;
  index.build({0}, [](selvedge::Clustered_AABB_tree::Id) { return CGAL::Bbox_3(0, 0, 0, 1, 1, 1); });
  int found = 0;
  index.visit_overlapping(CGAL::Bbox_3(1, 1, 1, 2, 2, 2),
                          [&](selvedge::Clustered_AABB_tree::Id) { ++found; });
  return found == 1 ? 0 : 1;
}
