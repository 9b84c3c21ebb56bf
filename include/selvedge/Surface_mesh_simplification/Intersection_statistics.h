// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERSECTION_STATISTICS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERSECTION_STATISTICS_H

#include <cstddef>

namespace selvedge {

/// Counts what an `Intersection_filter` did.
struct Intersection_statistics
{
  std::size_t motions_judged = 0;       ///< motions of one vertex; a placement at neither end has several
  std::size_t stars_clear_by_view = 0;  ///< motions in which one view proved the star clear of itself
  std::size_t faces_near = 0;           ///< stationary faces that the index found near a star
  std::size_t faces_clear_in_packs = 0; ///< of these, clear of the whole star in single precision
  std::size_t faces_clear_by_box = 0;   ///< of the others, clear of the whole star by its box in the view
  std::size_t faces_clear_by_view = 0;  ///< of the others, clear of the whole star in the view
  std::size_t pairs_clear_by_view = 0;  ///< pairs of a sweep and a remaining face clear in the view
  std::size_t sweeps_tested = 0;        ///< pairs of a sweep and a face that the exact test decided
  std::size_t refused_by_link = 0;      ///< motions of coincident vertices, or against the link condition
  std::size_t refused_by_star = 0;      ///< motions in which the star would meet itself
  std::size_t refused_by_sweep = 0;     ///< motions in which a face would meet a stationary face
  std::size_t refused_by_clearance = 0; ///< motions in which a face would come too near one of another piece
  std::size_t refused_by_descent = 0;   ///< collapses after which more exempt pairs would offend, or deeper
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERSECTION_STATISTICS_H
