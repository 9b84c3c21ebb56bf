// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_THREADS_PARALLEL_SORT_H
#define SELVEDGE_TEST_THREADS_PARALLEL_SORT_H

#include "parallel_invoke.h"

#include <algorithm>

namespace tbb {

template <class Iterator, class Less>
void parallel_sort(Iterator first, Iterator beyond, const Less& is_less)
{
  if (beyond - first < 512)
    return std::sort(first, beyond, is_less);
  const Iterator middle = first + (beyond - first) / 2;
  parallel_invoke([&] { parallel_sort(first, middle, is_less); },
                  [&] { parallel_sort(middle, beyond, is_less); });
  std::inplace_merge(first, middle, beyond, is_less);
}

} // namespace tbb

#endif // SELVEDGE_TEST_THREADS_PARALLEL_SORT_H
