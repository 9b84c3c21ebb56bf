// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SIMPLIFY_SOUP_H
#define SELVEDGE_SIMPLIFY_SOUP_H

#include <selvedge/Simplify_options.h>
#include <selvedge/Simplify_report.h>
#include <selvedge/mesh/Scale.h>
#include <selvedge/mesh/Triangle_soup.h>
#include <selvedge/mesh/Welding_notes.h>
#include <selvedge/mesh/rounding.h>
#include <selvedge/mesh/snapping.h>
#include <selvedge/verify.h>

#include <cstddef>
#include <string>
#include <vector>

namespace selvedge {

/// How an input is taken that is not what it should be.
struct Prepare_options
{
  /// Round coordinates to 32-bit floats first, as a format that stores no more will.
  bool round_to_float32 = false;

  /// Refuse an input that is not embedded (`Input_error`), instead of freezing what offends.
  bool is_strict = false;

  /// Close seams whose two sides lie within this distance, in the unit of the coordinates: finite, at least
  /// 0. Vertices then have the coordinates of their partners, bit for bit; see snapping.h.
  double weld_distance = 0;
};

/// A soup that has been rounded and judged: what `simplify_soup` reduces, and what its result is to be judged
/// against.
struct Prepared_soup
{
  /// The input, rounded and snapped where that was asked for, without the triangles that have two corners at
  /// one position.
  Triangle_soup soup;

  /// What lies beside it and stays as it is: points and triangles, without those that have two corners at one
  /// position. Where vertices and triangles are numbered below, its own follow those of `soup`.
  Triangle_soup obstacle;

  /// For every vertex the first vertex at its position. Those count as at one position that are at one before
  /// rounding and after it: not those that only rounding has made equal, nor those that it has taken apart, a
  /// vertex of the soup from one of the obstacle.
  std::vector<Index> positions;

  /// By what the reduction divides the points of both. All points here are as they came.
  Scale scale;

  /// What keeps `soup` and `obstacle` together from being embedded; found exactly.
  std::vector<Offending_pair> offending_pairs;

  /// Those among them that rounding has made; a number apart from the input's own defects.
  std::size_t pairs_by_rounding = 0;

  /// For every triangle: does it belong to an offending pair, or have a corner where only rounding has made
  /// positions equal? Its vertices will not move, so that every offending pair stays as it is and none is
  /// added. So do all triangles of the obstacle.
  std::vector<char> is_frozen;
  std::size_t frozen_faces = 0; ///< of `soup`

  /// Triangles left out because two corners are at one position: of the input's own, and by rounding.
  std::size_t left_out_faces = 0;
  std::size_t left_out_by_rounding = 0;

  Rounding_notes rounding;
  Snapping_notes snapping;
  double seconds_weld = 0;  ///< rounding, and finding what coincides
  double seconds_check = 0; ///< judging
  double seconds_snap = 0;  ///< closing seams
};

/// Rounds, finds what coincides, judges, freezes, and snaps, in this order.
///
/// Throws `Input_error` when the input has no triangle, when a coordinate overflows in rounding, and, if
/// strict, when it is not embedded: the message says how many pairs offend and names the first, by triangle
/// numbers of the input; and when coordinates are too far apart for one `Scale`.
///
/// An `obstacle`, a body under the clothes, say, is seen by everything and never changed, not even rounded.
/// Pairs that offend between it and the input are frozen like others, and so are faces of the input that only
/// rounding has brought to a vertex of it. The input is not sewn to it: along it, it keeps its own borders.
///
/// **Threads** The judge takes what oneTBB grants; see verify.h.
Prepared_soup prepare(Triangle_soup input, const Prepare_options& options = {},
                      const Triangle_soup& obstacle = {});

/// What the user wants of single parts of a soup. Names are those of groups, objects and materials; one that
/// the soup does not have throws `Argument_error`, and the message lists those that it has.
struct Simplify_intent
{
  /// Parts whose vertices do not move. Their faces count for the target like all others, which so must give
  /// way the more.
  std::vector<std::string> locked;

  /// Parts no face of which changes, and which have no part in the target: it is for the others. Everything
  /// sees them.
  std::vector<std::string> kept;

  /// Parts with a ratio of their own, in [0, 1], of their own faces. Once such a part has reached it, no
  /// further face of it goes, and others go on; the target of the options is for all faces of no such part. A
  /// triangle of several is of the one named last.
  struct Part_ratio
  {
    std::string name;
    double ratio;
  };
  std::vector<Part_ratio> ratios;

  /// The vertex attribute whose first component says how dear each vertex is, as a share of the largest:
  /// numbers of at least 0, or `Argument_error` is thrown. Empty: all are alike.
  std::string weights;
};

/// A reduced soup, and what was done to get it.
struct Simplified_soup
{
  Triangle_soup soup;

  /// Which triangle of the original each one was, and which corner of the original each corner now is, as
  /// 3 × triangle + place in it.
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;

  Welding_notes welding;
  Simplify_report report;

  /// What was refused to the vertices of each part: for each of `part_kinds` of the original, for each part.
  std::vector<std::vector<Refusals>> refused_by_part;

  double seconds_weld = 0; ///< sewing, and taking apart again
};

/// Reduces a soup as `simplify` of simplify.h does a mesh, with all its guarantees, and:
/// 1. *Embedded*: the offending pairs of the result are among those of the input, so there are none when the
/// input has
///    none.
/// 2. *Attributes*: every corner of the result has the vertex number, texture coordinate and group that some
/// corner
///    of the input has at the same position on the same side; coordinates are the same bits.
/// 3. *Seams*: coincident borders of pieces are sewn before and separate after the reduction, and coincide at
/// every
///    vertex; texture seams and borders between groups are kept like them.
/// 4. *Texture*: no triangle of the texture turns over.
/// 5. The triangles left are in the order of the input, each with its first corner first.
/// 6. *Scale*: a soup multiplied by any power of two, with its obstacle and its weld distance, as long as
/// that
///    loses no digit, takes the same steps, and its result is multiplied by the same.
///
/// In cells (`Simplify_options::faces_per_cell`) no part can have a ratio of its own (`Argument_error`).
Simplified_soup simplify_soup(const Prepared_soup& prepared, const Simplify_options& options,
                              const Simplify_intent& intent = {});

/// Levels of detail: for each of `ratios`, which take the place of the option, exactly what `simplify_soup`
/// gives for it alone, but for the seconds.
///
/// They come from one reduction, which is looked at on its way. Where parts have ratios of their own, what is
/// reduced depends on how far all others have come, and each level is a reduction of its own; in cells, too.
///
/// Throws `Argument_error` when the options name a number of faces as well.
std::vector<Simplified_soup> simplify_lods(const Prepared_soup& prepared, const Simplify_options& options,
                                           const std::vector<double>& ratios,
                                           const Simplify_intent& intent = {});

/// The judge's verdict on a result, in which the obstacle, unchanged, has its part: pairs are of both, their
/// triangles numbered on; pieces, topology and distances are those of the result alone.
Verification verify(const Simplified_soup& result, const Prepared_soup& original);

} // namespace selvedge

#endif // SELVEDGE_SIMPLIFY_SOUP_H
