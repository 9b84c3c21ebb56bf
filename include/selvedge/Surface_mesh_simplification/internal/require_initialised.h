// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_REQUIRE_INITIALISED_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_REQUIRE_INITIALISED_H

namespace selvedge {
namespace internal {

template <class Policy>
auto require_initialised(const Policy& policy, int) -> decltype(policy.require_initialised())
{
  policy.require_initialised();
}
template <class Policy>
void require_initialised(const Policy&, long)
{
}

/// Throws `Argument_error` if the policy, or one that it uses, is a `Quadric_cost` that no loop has
/// initialised, because the loop has another cost.
template <class Policy>
void require_initialised(const Policy& policy)
{
  require_initialised(policy, 0);
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_REQUIRE_INITIALISED_H
