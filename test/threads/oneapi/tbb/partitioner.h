// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_THREADS_PARTITIONER_H
#define SELVEDGE_TEST_THREADS_PARTITIONER_H

namespace tbb {

struct simple_partitioner
{
};

} // namespace tbb

#endif // SELVEDGE_TEST_THREADS_PARTITIONER_H
