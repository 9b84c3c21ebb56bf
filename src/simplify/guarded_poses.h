// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SIMPLIFY_GUARDED_POSES_H
#define SELVEDGE_SRC_SIMPLIFY_GUARDED_POSES_H

#include <selvedge/Simplify_options.h>
#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <numeric>
#include <vector>

namespace selvedge {

/// Returns the numbers of the further poses of a mesh in which collapses are judged.
inline std::vector<std::size_t> guarded_poses(const Triangle_soup& mesh, const Simplify_options& options)
{
  if (options.guarded_poses)
    return *options.guarded_poses;
  std::vector<std::size_t> all(mesh.poses.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  return all;
}

} // namespace selvedge

#endif // SELVEDGE_SRC_SIMPLIFY_GUARDED_POSES_H
