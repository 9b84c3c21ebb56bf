// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SIMPLIFY_SOUP_H
#define SELVEDGE_SIMPLIFY_SOUP_H

#include <selvedge/Simplify_options.h>
#include <selvedge/Simplify_report.h>
#include <selvedge/mesh/Triangle_soup.h>
#include <selvedge/mesh/Welding_notes.h>
#include <selvedge/mesh/rounding.h>
#include <selvedge/mesh/snapping.h>
#include <selvedge/verify.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// How an input is taken that is not what it should be.
struct Prepare_options
{
  /// Round coordinates to 32-bit floats first, as a format that stores no more will.
  bool round_to_float32 = false;

  /// Refuse an input that is not embedded (`Input_error`), instead of freezing what offends.
  bool is_strict = false;

  /// Close seams whose two sides lie within this distance, in the unit of the coordinates: finite, at least 0. Vertices
  /// then have the coordinates of their partners, bit for bit; see snapping.h.
  double weld_distance = 0;
};

/// A soup that has been rounded and judged: what `simplify_soup` reduces, and what its result is to be judged against.
struct Prepared_soup
{
  /// The input, rounded and snapped where that was asked for, without the triangles that have two corners at one position.
  Triangle_soup soup;

  /// For every vertex the first vertex at its position. What only rounding has made equal counts as different.
  std::vector<Index> positions;

  /// What keeps `soup` from being embedded; found exactly.
  std::vector<Offending_pair> offending_pairs;

  /// Those among them that rounding has made; a number apart from the input's own defects.
  std::size_t pairs_by_rounding = 0;

  /// For every triangle: does it belong to an offending pair, or touch another only because of rounding? Its vertices
  /// will not move, so that every offending pair stays as it is and none is added.
  std::vector<char> is_frozen;
  std::size_t frozen_faces = 0;

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
/// Throws `Input_error` when the input has no triangle, when a coordinate overflows in rounding, and, if strict, when it
/// is not embedded: the message says how many pairs offend and names the first, by triangle numbers of the input.
Prepared_soup prepare(Triangle_soup input, const Prepare_options& options = {});

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
  double seconds_weld = 0; ///< sewing, and taking apart again
};

/// Reduces a soup as `simplify` of simplify.h does a mesh, with all its guarantees, and:
/// 1. *Embedded*: the offending pairs of the result are among those of the input, so there are none when the input has
///    none.
/// 2. *Attributes*: every corner of the result has the vertex number, texture coordinate and group that some corner
///    of the input has at the same position on the same side; coordinates are the same bits.
/// 3. *Seams*: coincident borders of pieces are sewn before and separate after the reduction, and coincide at every
///    vertex; texture seams and borders between groups are kept like them.
/// 4. The triangles left are in the order of the input, each with its first corner first.
Simplified_soup simplify_soup(const Prepared_soup& prepared, const Simplify_options& options);

} // namespace selvedge

#endif // SELVEDGE_SIMPLIFY_SOUP_H
