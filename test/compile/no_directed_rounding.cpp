// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Asks for default arithmetic where CGAL cannot set the direction of rounding, as under Valgrind.

#if defined(__x86_64__) && defined(__GNUC__)
#include <xmmintrin.h>
#undef _MM_SET_ROUNDING_MODE
#define _MM_SET_ROUNDING_MODE(mode) static_cast<void>(mode)
#endif

#include <selvedge/internal/exact_predicates.h>

#include <iostream>

int main()
{
  try {
    selvedge::internal::require_default_arithmetic();
  } catch (const selvedge::Argument_error& error) {
    std::cout << error.what() << '\n';
    return 0;
  }
  return 1;
}
