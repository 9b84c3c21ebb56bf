// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CALL_WITH_PROFILE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CALL_WITH_PROFILE_H

#include <type_traits>

namespace selvedge {
namespace internal {

/// Calls a function with a profile or, where the function does not take it, with CGAL's own profile of the
/// same edge: policies may deduce the arguments of `Edge_profile<TM, VPM, GT>`.
template <class Function, class Profile>
decltype(auto) call_with_profile(Function&& function, const Profile& profile)
{
  if constexpr (std::is_invocable_v<Function&, const Profile&>)
    return function(profile);
  else
    return function(profile.full());
}

/// The same for a policy that is called with the profile and further arguments.
template <class Policy, class Profile, class... Arguments>
decltype(auto) ask_policy(const Policy& policy, const Profile& profile, const Arguments&... arguments)
{
  if constexpr (std::is_invocable_v<const Policy&, const Profile&, const Arguments&...>)
    return policy(profile, arguments...);
  else
    return policy(profile.full(), arguments...);
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CALL_WITH_PROFILE_H
