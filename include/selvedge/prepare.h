// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_PREPARE_H
#define SELVEDGE_PREPARE_H

#include <selvedge/Border_gaps.h>
#include <selvedge/Snapping_notes.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/internal/Scale.h>
#include <selvedge/normals.h>
#include <selvedge/rounding.h>
#include <selvedge/verify.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace selvedge {

/// What becomes of the offending pairs of an input that is not embedded.
enum class Defects {
  descend, ///< they are exempt, and so are pairs that descend from them, of which there are never more
  freeze,  ///< they stay as they are: the vertices of their faces do not move
  refuse   ///< the input is refused (`Input_error`)
};

/// Returns "descend", "freeze" or "refuse".
const char* name_of(Defects defects);

/// What becomes of the gaps of open seams where they have a clear length (`Border_gaps`). Each does what
/// those before it do, but that gaps that are held are not welded.
enum class Open_seams {
  ignore,  ///< nothing; the two sides of a gap are reduced as separate borders
  measure, ///< they are measured alone: `Prepared_soup::border_gaps`
  hold,    ///< they stay where they are, and are kept from getting wider: `Prepared_soup::tied`, `facing`
  weld     ///< they are closed: the clear length takes the place of `Prepare_options::weld_distance`
};

/// The options of `prepare`.
struct Prepare_options
{
  /// Whether coordinates are first rounded to 32-bit floats, for an output format that stores no more.
  bool round_to_float32 = false;

  /// What becomes of offending pairs. Pairs that offend only after rounding are never refused; with
  /// `Defects::refuse` they are frozen.
  Defects defects = Defects::descend;

  /// What a reduction does with the normals of corners.
  Normals_choice normals = Normals_choice::keep;

  /// The distance within which border vertices *snap* together, in the unit of the coordinates: finite, at
  /// least 0, otherwise `Argument_error` is thrown. At 0, the default, nothing snaps.
  ///
  /// Snapping closes seams whose two sides lie near each other but do not coincide. A reduction sews only
  /// borders that coincide; the two sides of a gap, however narrow, are reduced as separate borders. Choose a
  /// distance a little larger than the widest gap that is to be closed: all borders that run along each other
  /// within it are closed, unless something lies between them.
  ///
  /// **What moves** One of two *partners* goes straight to the position of the other, and takes its
  /// coordinates bit for bit; no new position is made. Vertices that are coincident with it go along. Vertex
  /// numbers and all other attributes, such as texture coordinates, stay as they are.
  ///
  /// **Partners** Two border vertices are partners when
  /// - they lie within this distance of each other, and belong to no common face,
  /// - two border edges beside them can become one: the vertex after one of them and the vertex before the
  ///   other lie within this distance of each other, too, or are the same (borders run with the surface on
  ///   the left),
  /// - no stretch of border of at most twice this distance joins them.
  ///
  /// Partners may belong to one piece, as at a dart.
  ///
  /// **Order** Vertices are joined in rounds, until a round changes nothing. In each, every border vertex
  /// chooses its nearest partner that is not frozen, and vertices that have chosen each other are joined, the
  /// nearest first. The vertex with fewer faces moves; when its motion is refused, the other moves. So where
  /// several pieces meet in a corner, all of them come to one position, one after another. A vertex may snap
  /// more than once, and then go farther than this distance altogether.
  ///
  /// **Guarantees**
  /// 1. *Embedded, motion*: every snap is decided exactly, like a collapse. On the way nothing is met or
  ///    passed through, and no face degenerates. The offending pairs afterwards are those before.
  /// 2. *Frozen*: vertices of frozen or offending faces, of faces that stay (`parts_that_stay`) and of the
  ///    obstacle do not move, and nothing moves onto them.
  /// 3. *Manifold*: two border edges that run in opposite directions become one edge; no other edges do.
  /// 4. *Deterministic*: the same input gives the same snaps.
  ///
  /// Vertices under different transforms of a glTF scene are not joined. A vertex whose snap is refused stays
  /// where it is; `Prepared_soup::snapping` counts such vertices by reason.
  ///
  /// **What stays open** Gaps that are left are held: `Prepared_soup::tied`, `facing`.
  ///
  /// **Exactness** Distances, which choose what is tried, are rounded to double. **Complexity** O(n log n)
  /// for n triangles; in every round, as many steps as there are pairs of border vertices within this
  /// distance.
  double weld_distance = 0;

  /// Names of parts whose faces do not change, such as those that `Simplify_intent` keeps or locks: their
  /// vertices do not snap. `Argument_error` is thrown for a name that the soup does not have.
  std::vector<std::string> parts_that_stay;

  /// Vertices that do not snap, nor others of their faces, such as those that `Simplify_intent` locks.
  std::vector<Index> vertices_that_stay;

  /// What becomes of open seams. `Argument_error` is thrown when they are to be held or welded and the weld
  /// distance is not 0.
  Open_seams open_seams = Open_seams::ignore;

  /// Whether a reduction turns faces that run against the others of their surface, so that the surface is
  /// connected there, too, and turns what is left of them back in its result. Otherwise no vertex moves where
  /// two faces disagree.
  bool orient = true;

  /// Pairs of parts, by the names of groups, objects or materials (`triangles_named`), that may come to
  /// intersect each other, at most 32. The pairs of triangles between them that intersect already are no
  /// offending pairs: they are neither refused nor frozen, and anything may become of them. Snaps are judged
  /// against all parts all the same.
  ///
  /// The two parts must not be joined, before or after snapping: no triangle of one has a corner where a
  /// triangle of the other has one. Otherwise `Argument_error` is thrown, and also when a name is unknown.
  std::vector<std::pair<std::string, std::string>> may_intersect;
};

/// A soup that has been rounded, judged and snapped. `simplify_soup` reduces it, and the result is judged
/// against it.
struct Prepared_soup
{
  /// The input, rounded and snapped if that was asked for, without the triangles that have two corners at one
  /// position, and without the normals that `simplify_soup` makes anew.
  Triangle_soup soup;

  /// What was done with the normals, and is to be done with those of the result.
  Normals_treatment normals = Normals_treatment::none;

  /// The normals that `take_normals` has taken from the triangles of `soup`, for `keep_flat_normals` or
  /// `pick_normals`.
  Corner_values<3> taken_normals;

  /// The points and triangles of the obstacle, without the triangles that have two corners at one position.
  /// In the members below, vertices and triangles of the obstacle are numbered after those of `soup`.
  Triangle_soup obstacle;

  /// For every vertex, the first vertex that is coincident with it in every pose. Vertices count as
  /// coincident when they are so both before and after rounding: neither when only rounding has made them
  /// equal, nor when rounding has moved a vertex of the soup away from one of the obstacle. A vertex that has
  /// snapped is coincident with its partner.
  std::vector<Index> positions;

  /// The power of two by which a reduction divides the points. The points of `soup` and `obstacle` are not
  /// divided.
  Scale scale;

  /// The offending pairs of `soup` and `obstacle` together, found exactly.
  std::vector<Offending_pair> offending_pairs;

  /// `Prepare_options::may_intersect`, and how many pairs between the two parts of each intersect.
  /// `offending_pairs` has none of them. One that several of them name counts for the first.
  std::vector<std::pair<std::string, std::string>> may_intersect;
  std::vector<std::size_t> permitted_pairs;

  /// For each further pose of `soup`, the offending pairs in it, together with the obstacle in its pose.
  std::vector<std::vector<Offending_pair>> offending_pairs_in_poses;

  /// For every vertex, whether it is coincident with another in some poses and not in all: then its triangles
  /// are frozen. Empty when there is one pose. `first_held` says of the first which it is, and in which pose.
  std::vector<char> is_held;
  std::string first_held;

  /// How many of the offending pairs only rounding has made.
  std::size_t pairs_by_rounding = 0;

  /// What becomes of these pairs: `descend` or `freeze`.
  Defects defects = Defects::freeze;

  /// Returns whether there are such pairs, in any pose, and they may descend.
  bool may_pairs_descend() const;

  /// For every triangle, whether it is frozen: its vertices do not move. Frozen are triangles with a corner
  /// where only rounding has made positions equal, or that is coincident with others in some poses alone, and
  /// all triangles of the obstacle; unless pairs may descend, also the triangles of all offending pairs, so
  /// that these stay as they are.
  std::vector<char> is_frozen;
  std::size_t frozen_faces = 0; ///< of `soup`

  /// Triangles of the input that are left out because two of their corners are at one position.
  std::size_t left_out_faces = 0;       ///< before rounding
  std::size_t left_out_by_rounding = 0; ///< only after rounding

  /// How many of the former have an area once morph targets or bones of a glTF scene move their corners
  /// apart, like a lid that is closed. The result has holes there.
  std::size_t left_out_faces_that_open = 0;

  /// For every triangle of `soup`, its *front*: the first triangle with the same three positions, of which it
  /// is a *double*, or itself. Empty when none is a double. A reduction lets doubles go with their fronts, so
  /// that both sides of a double-sided mesh are reduced alike. There are none unless pairs may descend, and
  /// frozen or degenerate triangles are not among them.
  std::vector<Index> fronts;
  std::size_t doubles() const;

  /// For every triangle of `soup`, whether a reduction turns it; empty when none is turned. Which it turns is
  /// decided after snapping.
  std::vector<char> is_turned;
  std::size_t turned_faces() const;

  Rounding_notes rounding;
  bool is_float32 = false; ///< whether new coordinates must be 32-bit floats, too

  /// The gaps between borders before anything snaps, unless they were to be ignored.
  Border_gaps border_gaps;

  Snapping_notes snapping;

  /// Pairs of positions on the two sides of gaps: partners, each the nearest of the other, frozen or not.
  /// Each position is given by its first vertex. There are some where open seams are held, and where snapping
  /// leaves them. Between two pieces that both have no vertex inside, such as cards of hair, there are none,
  /// and nothing faces the other: they would lose hardly a face.
  ///
  /// A reduction lets a tied vertex leave its border only to a tied vertex, only if its partner could go to
  /// the partner of that, and lets the partner go next. While both do, the two sides are nowhere farther
  /// apart than the pairs of vertices that are left. (The own loop only. A partner that is refused once the
  /// first has gone tries again later; `Simplify_report::left_alone` counts those left in the end.)
  std::vector<std::pair<Index, Index>> tied;

  /// Positions on borders at the same gaps that face an edge of another border, at which the surface
  /// continues, as at a seam whose two sides have other numbers of vertices: those that are tied to none
  /// within a clear length, or the weld distance, of such an edge; and those that are tied to a vertex at
  /// least twice as far away as such an edge. Each is given by its first vertex. There, a reduction lets
  /// borders drift by a tenth of `Simplify_options::max_border_drift`.
  std::vector<Index> facing;

  double seconds_positions = 0; ///< for rounding, and finding coincident vertices
  double seconds_check = 0;     ///< for judging
  double seconds_snap = 0;      ///< for snapping
};

/// Prepares a soup for `simplify_soup`: takes out normals that are to be made anew, rounds it, finds
/// coincident vertices, finds offending pairs, freezes their faces if asked for, and snaps borders, in this
/// order.
///
/// An `obstacle`, such as the body under a garment, takes part in every decision and never changes; it is not
/// even rounded. Faces of the input that offend together with it are treated like others, and faces
/// are frozen that only rounding has brought to one of its vertices. The input is not sewn to the obstacle:
/// along it, the input keeps its own borders.
///
/// Throws `Input_error`
/// - when the input has no triangle, or every triangle has two corners at one position,
/// - when rounding makes a coordinate overflow,
/// - when coordinates are too far apart for one `Scale`,
/// - with `Defects::refuse`, when the input, together with the obstacle, is not embedded. The message says
///   how many pairs offend, and names the first by the numbers of its triangles, counted from 1; those of the
///   obstacle follow those of the input.
///
/// Throws `Argument_error` when the input or the obstacle breaks a precondition of `Triangle_soup`, such as
/// an array of another length than it should have.
///
/// **Threads** The judge uses the threads that oneTBB grants; see verify.h.
Prepared_soup prepare(Triangle_soup input, const Prepare_options& options = {},
                      const Triangle_soup& obstacle = {});

} // namespace selvedge

#endif // SELVEDGE_PREPARE_H
