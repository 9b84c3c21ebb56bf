// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_FOR_EACH_CHUNK_H
#define SELVEDGE_SRC_VERIFY_FOR_EACH_CHUNK_H

#include <selvedge/Cancellation_scope.h>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace selvedge::internal {

/// Returns how many chunks of some size, of which the last may be smaller, there are in `count` items.
inline std::size_t chunk_count(std::size_t count, std::size_t size)
{
  return (count + size - 1) / size;
}

/// Divides `count` items into chunks of some size, and calls `function(number, first, beyond)` concurrently
/// for each chunk, with its number and the range of its items. Chunks do not depend on the number of threads.
template <class Function>
void for_each_chunk(std::size_t count, std::size_t size, const Function& function)
{
  const auto call = [&](std::size_t number) {
    Cancellation_scope::check();
    function(number, size * number, (std::min)(size * (number + 1), count));
  };
  tbb::parallel_for(std::size_t(0), chunk_count(count, size), Cancellation_scope::inherited(call));
}

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_FOR_EACH_CHUNK_H
