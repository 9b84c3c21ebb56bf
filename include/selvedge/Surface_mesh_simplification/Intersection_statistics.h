// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERSECTION_STATISTICS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERSECTION_STATISTICS_H

#include <cstddef>

namespace selvedge {

/// What an `Intersection_filter` did, in counts.
struct Intersection_statistics
{
  std::size_t motions_judged = 0;
  std::size_t stars_clear_by_view = 0; ///< motions whose star one view settled
  std::size_t faces_near = 0;          ///< stationary faces whose box meets that of a star
  std::size_t faces_clear_by_box = 0;  ///< of these, clear of the whole star by boxes in the star's view
  std::size_t faces_clear_by_view = 0; ///< of the others, clear of the whole star in its view
  std::size_t pairs_clear_by_view = 0; ///< of what remains, pairs of a sweep and a face clear by one plane
  std::size_t sweeps_tested = 0;       ///< pairs of a sweep and a face that took the exact test
  std::size_t refused_by_link = 0;     ///< motions that would join what is not joined
  std::size_t refused_by_star = 0;     ///< motions in which the star would meet itself
  std::size_t refused_by_sweep = 0;    ///< motions in which a face would meet one that stands still
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERSECTION_STATISTICS_H
