// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_VERTICES_USED_H
#define SELVEDGE_TEST_SUPPORT_VERTICES_USED_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <set>

namespace selvedge::test {

/// Returns how many vertices the triangles of a soup have.
inline std::size_t vertices_used(const Triangle_soup& soup)
{
  std::set<Index> used;
  for (const Index_triple& triangle : soup.triangles)
    used.insert(triangle.begin(), triangle.end());
  return used.size();
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_VERTICES_USED_H
