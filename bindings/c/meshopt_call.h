// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BINDINGS_C_MESHOPT_CALL_H
#define SELVEDGE_BINDINGS_C_MESHOPT_CALL_H

#include <cstddef>

namespace selvedge::bindings {

/// The arguments of `selvedge_simplifyWithAttributes`, in their order.
struct Meshopt_call
{
  unsigned int* destination;
  const unsigned int* indices;
  std::size_t index_count;
  const float* positions;
  std::size_t vertex_count;
  std::size_t positions_stride;
  const float* attributes;
  std::size_t attributes_stride;
  const float* attribute_weights;
  std::size_t attribute_count;
  const unsigned char* vertex_lock;
  std::size_t target_index_count;
  float target_error;
  unsigned int options;
  float* result_error;
};

/// Does what selvedge_c.h says. Throws where that says that it fails.
std::size_t simplify(const Meshopt_call& call);

} // namespace selvedge::bindings

#endif // SELVEDGE_BINDINGS_C_MESHOPT_CALL_H
