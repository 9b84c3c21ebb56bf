// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file
/// Asks Linux for large pages wherever the program allocates much memory at once.
///
/// The arrays of a mesh of a million faces take hundreds of megabytes, and a collapse reads a few bytes at
/// places far apart in each. With pages of 2 MB in place of 4 KB, the processor finds most of their addresses
/// in its cache of addresses, and the system hands out a five-hundredth of the pages.

#ifdef __linux__

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace {

void* allocate(std::size_t size)
{
  constexpr std::uintptr_t large_page = 1 << 21;
  void* const memory = std::malloc(size ? size : 1);
  if (memory && size >= large_page) {
    // All large pages that lie in the memory as a whole. It is a wish: if it is not granted, all works as
    // before.
    const auto begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t first = (begin + large_page - 1) / large_page * large_page;
    const std::uintptr_t beyond = (begin + size) / large_page * large_page;
    if (first < beyond)
      madvise(reinterpret_cast<void*>(first), beyond - first, MADV_HUGEPAGE);
  }
  return memory;
}

} // namespace

void* operator new(std::size_t size)
{
  for (;;) {
    if (void* const memory = allocate(size))
      return memory;
    const std::new_handler handler = std::get_new_handler();
    if (!handler)
      throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* memory) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}

#endif
