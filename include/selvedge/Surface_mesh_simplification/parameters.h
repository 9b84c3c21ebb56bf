// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_PARAMETERS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_PARAMETERS_H

#include <CGAL/Named_function_parameters.h>

#include <type_traits>

namespace selvedge {

namespace internal {

struct Geometric_test_t
{
};

// Whether all tags of a list of named parameters are among `Tags`.
template <class NamedParameters, class... Tags>
struct Are_tags_among : std::true_type
{
};
template <class T, class Tag, class Base, class... Tags>
struct Are_tags_among<CGAL::Named_function_parameters<T, Tag, Base>, Tags...>
    : std::bool_constant<(std::is_same_v<Tag, Tags> || ...) && Are_tags_among<Base, Tags...>::value>
{
};

} // namespace internal

/// Named parameters beyond CGAL's. They take those of CGAL as their last argument:
///
/// ```
/// selvedge::edge_collapse(mesh, stop,
///                         selvedge::parameters::geometric_test(false, CGAL::parameters::filter(filter)));
/// ```
namespace parameters {

/// Says whether `selvedge::edge_collapse` makes CGAL's geometric test of every placement before it asks the
/// filter, see `Dihedral_angle_filter`. The default is true. Without the test the loop is faster, and only
/// the filter limits which collapses are made.
template <class NamedParameters = CGAL::parameters::Default_named_parameters>
auto geometric_test(bool is_made, const NamedParameters& parameters = CGAL::parameters::default_values())
{
  return CGAL::Named_function_parameters<bool, internal::Geometric_test_t, NamedParameters>(is_made,
                                                                                            parameters);
}

} // namespace parameters

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_PARAMETERS_H
