// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fuzz/judge.h"

#include "support/round_trip.h"

#include "progressive/lists.h"

#include <sanitizer/allocator_interface.h>

#include <selvedge/Error.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace selvedge::test {
namespace {

/// Bytes on the heap, as the allocator of the sanitizer tells them.
class Heap
{
public:
  static bool install() { return __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free) != 0; }

  /// The most that a function takes at a time.
  template <class Function>
  static std::size_t peak_of(const Function& function)
  {
    const std::ptrdiff_t before = s_peak = s_now;
    function();
    return std::size_t(s_peak - before);
  }

private:
  static void on_malloc(const volatile void*, std::size_t size)
  {
    s_now += std::ptrdiff_t(size);
    s_peak = (std::max)(s_peak, s_now);
  }
  static void on_free(const volatile void* pointer)
  {
    if (pointer)
      s_now -= std::ptrdiff_t(__sanitizer_get_allocated_size(const_cast<const void*>(pointer)));
  }

  static inline std::ptrdiff_t s_now = 0, s_peak = 0;
};

void read(std::string_view kind, std::string_view contents)
{
  try {
    if (kind == "log") {
      std::istringstream stream{std::string(contents)};
      Log_reader reader(stream, "log");
      for (Log_step step; reader.read(step);)
        ;
    } else if (kind == "progressive") {
      read_progressive(contents, Mesh_format::gltf, "input");
    } else {
      read_mesh(contents, mesh_format("m." + std::string(kind)), "input");
    }
  } catch (const Input_error&) {
  }
}

/// The most that reading may take. A glTF file may show every part of it in each of its nodes, so there it is
/// the square of the size that counts.
std::size_t most_bytes(std::string_view kind, std::size_t size)
{
  const bool is_gltf = kind == "glb" || kind == "gltf" || kind == "progressive";
  return (256 << 10) + 256 * size * (is_gltf ? 1 + size / 256 : 1);
}

} // namespace

void judge(std::string_view kind, std::string_view contents)
{
  static const bool is_counted = Heap::install();
  try {
    promise(is_counted, "memory is not counted");
    const std::size_t bytes = Heap::peak_of([&] { read(kind, contents); });
    promise(bytes <= most_bytes(kind, contents.size()),
            "reading " + std::to_string(contents.size()) + " bytes takes " + std::to_string(bytes));
    if (kind == "log")
      judge_log(contents);
    else if (kind == "progressive")
      judge_progressive(contents);
    else
      judge_mesh(contents, mesh_format("m." + std::string(kind)));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "==ERROR: %s\n", error.what());
    std::abort();
  }
}

} // namespace selvedge::test
