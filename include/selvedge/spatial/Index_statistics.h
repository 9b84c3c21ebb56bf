// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_INDEX_STATISTICS_H
#define SELVEDGE_SPATIAL_INDEX_STATISTICS_H

#include <cstddef>

namespace selvedge {

/// Counts what an index of faces has done.
struct Index_statistics
{
  std::size_t clusters = 0; ///< of the packed index: leaves
  std::size_t queries = 0;
  std::size_t visits = 0; ///< faces visited by all queries
  std::size_t cluster_rebuilds = 0;
  std::size_t top_rebuilds = 0; ///< of the tree over the clusters; of the packed index: of all of it
};

} // namespace selvedge

#endif // SELVEDGE_SPATIAL_INDEX_STATISTICS_H
