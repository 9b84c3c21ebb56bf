// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REPLAY_H
#define SELVEDGE_REPLAY_H

#include <selvedge/Reduction_limits.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/collapse_log.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace selvedge {

/// What is wrong with a step of a log. Kinds are in the order in which they are looked for, and the first
/// that is found is reported.
enum class Violation_kind {
  no_edge, ///< nothing to collapse: one end is gone, both are at one position, or no edge joins them (or,
           ///< in a snap, one does)
  locked,  ///< what moves belongs to a frozen face (see prepare.h), or holds several sheets together
           ///< and is no inner point of a line where they meet
  weld_distance, ///< a snap is longer than the limit, or there is no such limit
  partner,       ///< a snap is not from a border vertex to a partner on a border
  link,          ///< the link condition fails: the step would connect what is separate, or close a border
  degenerate,    ///< a face has no area at some time on the way
  intersection,  ///< afterwards two faces meet beyond the positions that they share
  tunnelling,    ///< afterwards two faces do not meet, but on the way they did
  clearance,     ///< a face comes nearer to another piece than the limit, and than the star was
  line,          ///< a vertex of a border or seam leaves its line, or is a corner or an end of it
  border_turn,   ///< this and the next four: another limit of `Reduction_limits` is broken
  seam_turn,
  border_drift,
  normal_change,
  aspect_ratio,
  result ///< at the end: the collapses or triangles are not those that the log states
};

/// Returns "no_edge", "locked", ... as above.
const char* name(Violation_kind kind);

/// A bad step, with everything that is needed to see what is wrong with it.
struct Violation
{
  Violation_kind kind = Violation_kind::result;
  std::size_t step = 0; ///< counted from 1 over snaps and collapses; 0 for the result
  std::size_t line = 0; ///< of the log, counted from 1; 0 for the result
  Index removed = 0;    ///< as in the log
  Index kept = 0;       ///< as in the log

  /// The triangles concerned, by their 0-based numbers in the original: those that move, or, when two meet,
  /// the moving one and the one that it meets. The triangles of an obstacle are numbered after those of the
  /// original.
  std::vector<Index> triangles;

  std::string message; ///< one line for a person

  /// A point in which two triangles meet, as three rational numbers; empty when none do.
  std::string point;

  /// An OBJ file that shows the moving face before and after, the face that it meets, and the way of the
  /// vertex. Empty unless a face degenerates or meets another.
  std::string scene;
};

/// The options of `replay`.
struct Replay_options
{
  /// Whether limits are judged. If not, only links, locks and geometry are, and the weld distance, without
  /// which any motion could pass as a snap.
  bool are_limits_judged = true;

  /// The limits to be judged in place of those that the log declares, which are then all ignored. When they
  /// have no weld distance, nothing may snap.
  std::optional<Reduction_limits> limits;

  /// The SHA-256 of the file that the original was read from, as `sha256_of_file` returns it; empty when
  /// unknown. When the log names one, too, `replay` throws `Input_error` unless both are the same.
  std::string sha256_of_original;

  /// The mesh that the steps must keep clear of, as `read_mesh` returns it: every motion is judged against
  /// it, too. It has as many poses as the original, or none if it stands still (`Argument_error` otherwise).
  /// The log need not name it. When the log does, `replay` throws `Input_error` if this mesh has other counts
  /// or, where both are known, another SHA-256 of the file, or if it stands elsewhere in the pose that is
  /// judged.
  std::optional<Triangle_soup> obstacle;
  std::string sha256_of_obstacle; ///< of its file; empty when unknown

  /// The further pose of the original in which the steps are judged, by its number in
  /// `Triangle_soup::poses`; the first one, `Triangle_soup::points`, when there is none. `replay` throws
  /// `Input_error` when the log does not name this pose (`stated_pose`). The unit of the drift is the
  /// diagonal of the first pose; the digest of the result is not compared.
  std::optional<std::size_t> pose;

  bool is_all_wanted = false; ///< whether to go on after a bad step as if it were good

  /// Called from time to time with the number of steps done; when it returns true, the replay ends there. It
  /// may be empty.
  std::function<bool(std::size_t)> should_stop;
};

/// Whose limits were judged.
enum class Limits_source {
  none, ///< nobody's: `are_limits_judged` was false
  log,  ///< those that the log declares
  judge ///< those of `Replay_options::limits`
};

/// Returns "none", "log" or "judge".
const char* name(Limits_source source);

/// The verdict on a log, what was judged, and the mesh to which the steps lead.
struct Replay_verdict
{
  /// Empty when nothing is wrong. Otherwise the violation of the first bad step, or, with `is_all_wanted`, of
  /// every bad step, in order. A violation of the result comes last.
  std::vector<Violation> violations;

  Log_header header;
  bool is_in_first_pose = true;
  std::size_t steps = 0;     ///< steps taken
  std::size_t snaps = 0;     ///< how many of them are snaps
  std::size_t collapses = 0; ///< how many of them are collapses
  std::size_t places = 0;    ///< how many of the collapses go to a place that the log names (X Y Z)
  bool is_stopped = false;   ///< by `Replay_options::should_stop`

  /// The limits that were judged. The weld distance is among them even when limits were not to be judged.
  Reduction_limits limits;
  Limits_source limits_source = Limits_source::log;
  bool is_obstacle_judged = false; ///< there was one (`Replay_options::obstacle`)
  bool is_obstacle_stated = false; ///< the log names its SHA-256 and, in a further pose, that of its places
  bool is_input_stated = false;    ///< the log names the SHA-256 of its input, and it is the original's
  bool is_result_stated = false;   ///< the log names a digest of its result, and it is that of `soup`
  bool is_result_another = false;  ///< the log names a digest of its result, and it is not that of `soup`
  std::size_t offending_pairs = 0; ///< of the original, together with the obstacle

  double largest_snap = 0;         ///< the longest snap, in the unit of the coordinates
  double largest_way_of_snaps = 0; ///< how far a vertex was moved by all of its snaps together, at most

  /// The mesh after the last step taken, in the form in which `simplify_soup` returns it.
  Triangle_soup soup;

  std::size_t pairs_judged = 0;
  std::size_t pairs_judged_in_rationals = 0;
  double seconds_prepare = 0; ///< for judging the original
  double seconds_steps = 0;

  bool is_accepted() const { return violations.empty() && !is_stopped; }
};

/// Something that a verdict says nothing about.
struct Not_judged
{
  /// The key of a limit, or "lines", "limits_of_snaps", "normals", "dropped", "may_intersect", "poses",
  /// "obstacle", "pairs", "input", "result", "places" or "attributes".
  std::string key;

  std::string sentence; ///< what it is, and why it was not judged, for a person
};

/// Returns all that a verdict says nothing about, as far as that is known.
std::vector<Not_judged> not_judged(const Replay_verdict& verdict);

/// Returns which of the further poses that a log names is a pose of the mesh, or nothing when none is. It is
/// one with its digest and, where there are several, with that of the obstacle in this pose, its name or its
/// number. A pose that the log names without a digest is the one of the same name or, when the log has no
/// fewer poses than the mesh, of the same number.
///
/// Throws `Argument_error` when the mesh has no pose of this number. Where an obstacle is given, it has as
/// many poses as the mesh, or none.
std::optional<std::size_t> stated_pose(const Log_header& header, const Triangle_soup& original,
                                       std::size_t pose, const Triangle_soup* obstacle = nullptr);

/// Repeats the steps of a log on a mesh, and judges each of them.
///
/// **Guarantees** when the verdict is "accepted":
/// 1. *Embedded*: after every step, any two faces meet exactly in what they share, except for the offending
///    pairs of the original; these have stayed as they were. Where the log says that pairs may descend,
///    except for pairs that descend from those (`pairs_without_descent` of verify.h), which no step made
///    more. Pairs between two parts that the log lets intersect are not judged, here and in 2.
/// 2. *Motion*: during no step did two faces meet beyond what they share.
/// 3. *Topology*: every collapse met the link condition over positions, so that pieces stay the manifolds
///    that they were.
/// 4. *Snaps*: every snap took a border vertex to one of its partners at that moment
///    (`Prepare_options::weld_distance` defines partners), no farther than `limits.weld_distance`. Neither of
///    the two belonged to a frozen face. The edges that a snap made one are pairs of border edges that run in
///    opposite directions. Guarantees 1 and 2 hold for snaps as for collapses.
/// 5. *Limits*: every collapse kept every limit that has a value in `limits`. The clearance is exact: in the
///    pose that is judged, no two pieces, which positions connect, came nearer to each other than it or,
///    where they were nearer at the first collapse, than they were then.
/// 6. *Result*: `soup` is what the log states as its result. `is_result_stated` tells whether the log states
///    it to the last triangle, or in counts alone.
///
/// Where there is an obstacle, its faces are among those of guarantees 1, 2 and 5, and it has stood still: no
/// vertex at a position of one of its triangles has moved.
///
/// A mesh in several poses is judged in one of them at a time: call it again for each
/// (`Replay_options::pose`). Guarantees 1 to 3 and 5 then hold in that pose.
///
/// When the verdict is not "accepted", the first violation is that of the first bad step. With
/// `is_all_wanted` a bad step is taken all the same, if it can be. A later step then counts as bad when it is
/// bad in another way, or when it brings together two faces that did not meet before it.
///
/// **Not promised** What `not_judged` returns. For a log with snaps, further: that partners were the nearest,
/// that their order was a good one, or that all gaps were closed; that snaps kept the limits of angles and
/// shapes, because distance is the only limit of a snap; that a vertex that snapped several times is within
/// the weld distance of its original place (`largest_way_of_snaps` tells how far such vertices went). Borders
/// drift from where snaps have put them, not from where they were in the original.
///
/// **Independence** The replay shares no code with the policies, the index, the working mesh or the loop. Its
/// mesh is a list of triangles over positions, its index is a tree of boxes, and it decides contacts by the
/// time at which they happen. It shares the reader of meshes, rounding, and the judge of the original
/// (`verify.h`), which are no part of a reduction.
///
/// **Preconditions** The soup is what `read_mesh` returns for the file that the log names; `is_stl` tells
/// whether that is an STL file. Checked (`Input_error`): the SHA-256, where both are known, and the counts in
/// the log's `input` line, and likewise the obstacle; that the log has the format of collapse_log.h; that the
/// vertices of each w-line are at one position; that parts that may intersect are there, and not joined.
///
/// **Exactness** Contacts are decided exactly: by signs of CGAL's exact predicates, else in rational numbers.
/// Limits are compared in floating point, with a tolerance of 1e-9 for programs that round otherwise; no
/// statement about intersections rests on them.
///
/// **Complexity** Usually O((n + k) log n) for n triangles and k steps.
Replay_verdict replay(const Triangle_soup& original, bool is_stl, Log_reader& log,
                      const Replay_options& options = {});

} // namespace selvedge

#endif // SELVEDGE_REPLAY_H
