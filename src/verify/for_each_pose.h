// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_FOR_EACH_POSE_H
#define SELVEDGE_SRC_VERIFY_FOR_EACH_POSE_H

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/Triangle_soup.h>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>
#include <string>

namespace selvedge::internal {

inline void require_same_number_of_poses(const Triangle_soup& result, const Triangle_soup& original)
{
  if (result.poses.size() != original.poses.size())
    throw Argument_error("the result has " + std::to_string(result.poses.size()) +
                         " further poses and its original " + std::to_string(original.poses.size()));
}

/// Calls `judge(pose)` for every number of a pose, on all threads. A thread that waits for parts of one pose
/// begins no other, so that there is never more in memory than one pose for each thread.
template <class Judge>
void for_each_pose(std::size_t poses, const Judge& judge)
{
  tbb::parallel_for(std::size_t(0), poses, Cancellation_scope::inherited([&](std::size_t pose) {
                      tbb::this_task_arena::isolate([&] { judge(pose); });
                    }),
                    tbb::simple_partitioner());
}

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_FOR_EACH_POSE_H
