// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_INTERNAL_EXACT_PREDICATES_H
#define SELVEDGE_INTERNAL_EXACT_PREDICATES_H

#include <selvedge/Error.h>

#include <CGAL/Algebraic_structure_traits.h>
#include <CGAL/Interval_nt.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <type_traits>

// Selvedge and CGAL prove signs by such bounds.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) ||                     \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(_M_FP_FAST)
#error "Fast floating point voids the bounds on rounding errors: compile without -ffast-math and the like"
#endif

namespace selvedge {
namespace internal {

// Whether a kernel says that its predicates are filtered: they compute in floating point, and exactly where
// that does not decide.
template <class Kernel, class = void>
struct Has_filtered_predicates : std::false_type
{
};
template <class Kernel>
struct Has_filtered_predicates<Kernel, std::void_t<typename Kernel::Has_filtered_predicates_tag>>
    : std::bool_constant<Kernel::Has_filtered_predicates_tag::value>
{
};

/// Refuses, at compile time, a kernel whose predicates are not exact. They are when they are filtered, or
/// when the number type is exact.
template <class Kernel>
constexpr void require_exact_predicates()
{
  static_assert(Has_filtered_predicates<Kernel>::value ||
                    CGAL::Algebraic_structure_traits<typename Kernel::FT>::Is_exact::value,
                "the predicates of this kernel are not exact, so the answers would be wrong: use points of "
                "CGAL::Exact_predicates_inexact_constructions_kernel (EPICK), or of another kernel with "
                "filtered predicates or an exact number type");
}

/// Returns whether CGAL's interval arithmetic, by which filtered predicates decide, rounds outwards. It does
/// not where the machine does not round as it is told to (Valgrind, WebAssembly), or where the compiler takes
/// all rounding to be to the nearest. CGAL itself asks this in debug builds alone.
inline bool do_intervals_hold_their_values()
{
#ifdef CGAL_DISABLE_ROUNDING_MATH_CHECK
  return true;
#else
  using Interval = CGAL::Interval_nt<false>;
  const volatile double one = 1, two = 2, ten = 10, least = std::numeric_limits<double>::min();
  const Interval::Protector protector;
  // No double has the value of any of these.
  for (const Interval& value :
       {Interval(one) + Interval(least), Interval(one) - Interval(least), Interval(one) / Interval(ten),
        sqrt(Interval(two)), Interval(std::nextafter(one, two)) * Interval(std::nextafter(one, two))})
    if (!(value.inf() < value.sup()))
      return false;
  return true;
#endif
}

/// Throws `Argument_error` when the calling thread does not compute as IEEE 754 has it by default: when it
/// rounds otherwise than to the nearest, or takes subnormal numbers for 0 (a shared library that was compiled
/// with `-ffast-math` may have set this for the whole program), or does not round otherwise when it is told
/// to, unless `CGAL_DISABLE_ROUNDING_MATH_CHECK` is defined, which is for profiles under Valgrind: their
/// results may be wrong.
inline void require_default_arithmetic()
{
  const volatile double least = std::numeric_limits<double>::min(); // of those that are not subnormal
  const volatile double half = least / 2;
  if (!(half > 0) || std::fegetround() != FE_TONEAREST)
    throw Argument_error(
        "this thread rounds otherwise than to the nearest, or takes subnormal numbers for 0, which voids the "
        "bounds on rounding errors; call std::fesetenv(FE_DFL_ENV) first, and link nothing that was compiled "
        "with -ffast-math");
  if (!do_intervals_hold_their_values())
    throw Argument_error(
        "this machine, emulator or build does not round upwards when told to, so that exact predicates would "
        "answer wrongly; run outside of Valgrind and the like, and compile with -frounding-math");
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_INTERNAL_EXACT_PREDICATES_H
