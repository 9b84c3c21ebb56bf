// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_INDEX_STATISTICS_H
#define SELVEDGE_SPATIAL_INDEX_STATISTICS_H

#include <cstddef>

namespace selvedge {

/// What an index of faces did, in counts.
struct Index_statistics
{
  std::size_t clusters = 0; ///< or leaves of the packed index
  std::size_t queries = 0;
  std::size_t visits = 0; ///< faces handed out by the queries
  std::size_t cluster_rebuilds = 0;
  std::size_t top_rebuilds = 0; ///< of the tree over the clusters, or of the whole packed index
};

} // namespace selvedge

#endif // SELVEDGE_SPATIAL_INDEX_STATISTICS_H
