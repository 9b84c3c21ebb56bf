// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_PARAMETERS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_PARAMETERS_H

#include <CGAL/Named_function_parameters.h>

#include <tuple>
#include <type_traits>

namespace selvedge {

namespace internal {

struct Geometric_test_t
{
};
struct Expected_collapses_t
{
};
struct Face_index_t
{
};

// Makes an index, which cannot be copied, from arguments that can.
template <class FaceIndex, class... Arguments>
struct Index_maker
{
  std::tuple<Arguments...> arguments;

  FaceIndex operator()() const { return std::make_from_tuple<FaceIndex>(arguments); }
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

/// Named parameters beyond CGAL's. Those of CGAL can follow them, or be their last argument (not of
/// `face_index`, whose further arguments are those of the index):
///
/// ```
/// selvedge::edge_collapse(mesh, stop, selvedge::parameters::geometric_test(false).filter(filter));
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

/// Tells `selvedge::edge_collapse` about how many collapses it will make until its stop predicate ends it.
/// With `use_relaxed_order(true)`, this relaxes the order further; without it, it has no effect. If there are
/// fewer in the end, some tiles of the mesh may be coarser than others.
template <class NamedParameters = CGAL::parameters::Default_named_parameters>
auto expected_collapses(std::size_t count,
                        const NamedParameters& parameters = CGAL::parameters::default_values())
{
  return CGAL::Named_function_parameters<std::size_t, internal::Expected_collapses_t, NamedParameters>(
      count, parameters);
}

/// Gives `intersection_filter` the type of its index, and the arguments with which an empty one is made:
/// `face_index<Clustered_AABB_tree>(50)`. The default is `Packed_R_tree`.
template <class FaceIndex, class... Arguments>
auto face_index(const Arguments&... arguments)
{
  using Maker = internal::Index_maker<FaceIndex, Arguments...>;
  return CGAL::Named_function_parameters<Maker, internal::Face_index_t>(Maker{{arguments...}});
}

} // namespace parameters

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_PARAMETERS_H
