// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SIMPLIFY_H
#define SELVEDGE_SIMPLIFY_H

#include <selvedge/Progression.h>
#include <selvedge/Reduction_history.h>
#include <selvedge/Sewing_notes.h>
#include <selvedge/Simplify_options.h>
#include <selvedge/Simplify_report.h>
#include <selvedge/prepare.h>

#include <string>
#include <vector>

namespace selvedge {

/// What the user wants for single parts of a soup. Parts are given by the names of groups, objects and
/// materials, as in `triangles_named`. A name that the soup does not have throws `Argument_error`, with a
/// message that lists the names that it has.
struct Simplify_intent
{
  /// Parts whose vertices do not move. Their faces count for the target like all others, so that more of the
  /// other faces have to go.
  std::vector<std::string> locked;

  /// Vertices that do not move, by their numbers in the soup, each once or more often. All vertices at the
  /// position of such a one, in all poses, stay with it. Faces are treated as with `locked`. A number that
  /// the soup does not have throws `Argument_error`.
  std::vector<Index> locked_vertices;

  /// Parts of which no face changes, and which do not count for the target: it is for the other faces alone.
  /// As everywhere, nothing comes to touch them or passes through them.
  std::vector<std::string> kept;

  /// Parts with a ratio of their own, in [0, 1], of their own faces. A part that has reached its ratio loses
  /// no further face, while the others go on. The target of the options is then for the faces that belong to
  /// no such part. A triangle that belongs to several of these parts counts for the one named last.
  struct Part_ratio
  {
    std::string name;
    double ratio = 1;
  };
  std::vector<Part_ratio> ratios;

  /// The name of the vertex attribute whose first component says how costly it is to collapse each vertex,
  /// relative to the largest of these numbers. They must be finite and at least 0 (`Argument_error`); NaN
  /// counts as the largest. When the name is empty, all vertices are alike.
  std::string weights;
};

/// Makes borders of what an intent locks or keeps stay where they are when others snap
/// (`Prepare_options::weld_distance`). Without it, a reduction would keep them as they have snapped.
void keep_from_snapping(Prepare_options& options, const Simplify_intent& intent);

/// A reduced soup, and how it was made. *The original* is `Prepared_soup::soup`.
struct Simplified_soup
{
  Triangle_soup soup;

  /// For every triangle of `soup`: the triangle of the original that it was, and, for each of its corners,
  /// the corner of the original that it now is, as 3 × triangle + place in it.
  ///
  /// A vertex at a new place (`Placement::optimal`) has the corners of an end of its last collapse, and a
  /// position and values of its own.
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;

  /// For every triangle of `soup`, the weakest of the reasons that hold back its edges, as `Hindrances`
  /// defines them. Empty when `report.hindrances` counts none.
  std::vector<Hindrance> held_by;

  /// The collapses that led to it, in order, when offending pairs of the original were allowed to descend
  /// (`Defects::descend`) and there are any; otherwise empty.
  std::vector<Soup_collapse> collapses;

  /// The steps that led to it, if `Simplify_options::is_progression_recorded`; otherwise empty.
  Progression progression;

  std::optional<double> clearance; ///< that pieces keep from each other; `verify` judges it

  std::size_t placed_vertices = 0;   ///< how many vertices of `soup` are at new places
  std::vector<char> is_placed;       ///< by vertex, which they are; empty if there are none
  std::size_t fitted_texture = 0;    ///< how many of these have fitted texture coordinates
  std::size_t fitted_attributes = 0; ///< how many of these have fitted attributes, such as colours
  std::size_t mended_normals = 0;    ///< how many corners of `soup` have a new normal (`mend_normals`)
  std::size_t fitted_normals = 0;    ///< how many corners of `soup` have another normal (`fit_normals`)

  std::size_t shared_meshes = 0; ///< that were reduced in all of their places alike, and
  std::size_t shared_places = 0; ///< in how many places these stand
  std::size_t apart_meshes = 0;  ///< that stand in several places, in which they were reduced one by one
  std::size_t untied_pairs = 0;  ///< of `Prepared_soup::tied`, not held, since they are of shared meshes

  Sewing_notes sewing;
  Simplify_report report;

  /// What the collapses cost and what was refused between them, with `Simplify_options::is_history_kept`. A
  /// cost is a share of the squared diagonal. What was refused in cells is not counted, and `by_loop` in the
  /// last sample alone.
  Reduction_history history;

  /// Refusals by part: for each of the `part_kinds` of the original, for each part of this kind. A refusal
  /// counts for the parts of one face beside the edge.
  std::vector<std::vector<Refusals>> refused_by_part;

  double seconds_sew = 0; ///< for sewing, and for taking the pieces apart again
};

/// Reduces a soup.
///
/// **Guarantees** All of `simplify_mesh` (Surface_mesh_simplification/simplify_mesh.h), and:
/// 1. *Embedded*: the offending pairs of the result are among those of the input or, with `Defects::descend`,
///    descend from those and are no more than them (docs/guarantees.md). There are none when the input has
///    none. Pairs between parts that may intersect (`Prepare_options::may_intersect`) do not count.
/// 2. *Attributes*: every corner of the result has the vertex number, texture coordinate and group that some
///    corner of the input has at the same position on the same side; coordinates are the same bits. With
///    `Placement::optimal` this holds for all vertices but `placed_vertices`. Those have new positions, and
///    their texture coordinates, normals and attributes (floating point, or normalized integers) are those of
///    the surface before each collapse, at its point nearest to the new position, by barycentric coordinates
///    on the same side of all lines, rounded to what a quantised glTF file can hold. Normals get the
///    length 1. In the end, the (first) texture coordinates there are fitted: they become those with which
///    the texture lies most like that of the input, in the sense of least squares (src/soup/fit_texture.h).
///    So are attributes, such as colours (src/soup/fit_attributes.h), each between the least and the largest
///    of what it was and of those of the input around it. Tangents and weights of a skin are not fitted.
///    Other integers and the joints of a skin are those of the end that was nearer; its weights are mixed for
///    these joints, with the sum 1. Groups, objects and materials are kept. Normals are made anew or fitted
///    where `Prepare_options::normals` asks for it.
/// 3. *Seams*: coincident borders of pieces are sewn before the reduction and separate after it, and they
///    coincide at every vertex. Texture seams and borders between groups are kept in the same way.
/// 4. *Texture*: no triangle of the texture turns over.
/// 5. *Order*: the triangles left are in the order of the input, each with its first corner first.
/// 6. *Instances*: a mesh of a glTF scene that stands in several places has the same triangles of the same
///    vertices in all of them, and a file gets it once (`Instances::shared`; docs/guarantees.md). Such meshes
///    are reduced apart, one by one, when rounding or a snap has moved a vertex of theirs in some place or
///    has tied it, when `prepare` has left out a triangle in some places only, and with
///    `Collapse_loop::cgal`. With `Placement::optimal`, their vertices do not go to new places.
/// 7. *Scale*: a soup that is multiplied by a power of two, together with its obstacle and its weld distance,
///    takes the same steps, and its result is multiplied by the same power, as long as the multiplication
///    loses no digit.
///
/// Throws `Argument_error` when an option is out of range, or when a part has a ratio of its own, or may
/// intersect another, in a reduction in cells (`Simplify_options::faces_per_cell`).
Simplified_soup simplify_soup(const Prepared_soup& prepared, const Simplify_options& options,
                              const Simplify_intent& intent = {});

/// Does what `simplify_soup` leaves out without `Simplify_options::are_values_fitted`: fits texture
/// coordinates and attributes of vertices at new places and, where `Prepare_options::normals` asks for it,
/// normals. Points and triangles stay, and with them what `verify` says. `prepared` and `intent` are those of
/// the reduction.
///
/// **Preconditions** The values of this result have not been fitted.
void fit_values(Simplified_soup& result, const Prepared_soup& prepared, const Simplify_intent& intent = {});

/// Makes levels of detail. For each of `ratios`, which replace `Simplify_options::ratio`, the result is
/// exactly what `simplify_soup` returns for this ratio alone, apart from the seconds, if the mesh has at most
/// 8,192 edges. Larger ones are reduced to a single target in an order that depends on it (see
/// `parameters::expected_collapses`), and to several levels in one that does not.
///
/// All levels are states through which one reduction passes. Only in cells, and when parts have ratios of
/// their own, each level is a reduction of its own. When `should_stop` ends a reduction, all levels that it
/// has not reached are the mesh as it is then.
///
/// Throws `Argument_error` when the options name a number of faces as well, and as `simplify_soup` does.
std::vector<Simplified_soup> simplify_lods(const Prepared_soup& prepared, const Simplify_options& options,
                                           const std::vector<double>& ratios,
                                           const Simplify_intent& intent = {});

/// Which collapses led to a result: `count` of those that `Simplify_options::on_collapse` was told, from
/// number `first` on. Results of one reduction have its number and its first collapse.
struct Collapses_of_level
{
  std::size_t reduction = 0, first = 0, count = 0;
  std::size_t of_reduction = 0; ///< how many the reduction made in all
};

/// Shares out the collapses of one call of `simplify_soup` or `simplify_lods` among its results, which are
/// given in their order.
std::vector<Collapses_of_level> collapses_of_levels(const std::vector<const Simplified_soup*>& levels,
                                                    const Simplify_options& options,
                                                    const Simplify_intent& intent = {});

/// Judges a result against its original, as `verify` of verify.h does. Offending pairs are those of the
/// result and the obstacle together, whose triangles are numbered after those of the result. Pieces, topology
/// and distances are those of the result alone. Shapes of pieces are not judged
/// (`Verify_options::are_shapes_judged`).
Verification verify(const Simplified_soup& result, const Prepared_soup& original);

} // namespace selvedge

#endif // SELVEDGE_SIMPLIFY_H
