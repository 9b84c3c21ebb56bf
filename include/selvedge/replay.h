// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REPLAY_H
#define SELVEDGE_REPLAY_H

#include <selvedge/Reduction_limits.h>
#include <selvedge/collapse_log.h>
#include <selvedge/mesh/Triangle_soup.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace selvedge {

/// What is wrong with a step of a log, in the order in which it is looked for; the first found is told.
enum class Violation_kind {
  no_edge, ///< nothing to collapse: one end is gone, both are one position, or no edge joins them (or,
           ///< in a snap, one does)
  locked,  ///< what moves belongs to a face that offended in the input, or holds several sheets together
  weld_distance, ///< a snap is longer than the limit, or there is no such limit
  partner,       ///< a snap is not from a border vertex to a partner on a border
  link,          ///< the link condition: the step would join what is not joined, or close a border
  degenerate,    ///< a face has no area at some time on the way
  intersection,  ///< afterwards two faces meet beyond the positions that they share
  tunnelling,    ///< afterwards they do not, but on the way they did
  line,          ///< what moves is on a border or seam, and leaves it, or is a corner or an end of it
  border_turn,   ///< the last five: a limit of `Reduction_limits`
  seam_turn,
  border_drift,
  normal_change,
  aspect_ratio,
  result ///< the end: not so many collapses or triangles as the log says, or not those triangles
};

/// "no_edge", "locked", ... as above.
const char* name(Violation_kind kind);

/// A step that is not what it should be, and what it takes to see that.
struct Violation
{
  Violation_kind kind = Violation_kind::result;
  std::size_t step = 0; ///< counted from 1 over snaps and collapses; 0 for the result
  std::size_t line = 0; ///< of the log, counted from 1; 0 for the result
  Index removed = 0;    ///< as the log has them
  Index kept = 0;

  /// Numbers of triangles in the original, 0-based: what moves, and, where two faces meet, what it meets.
  std::vector<Index> triangles;

  std::string message; ///< one line for a person

  /// A point in which the two meet, as three rational numbers; empty where they do not.
  std::string point;

  /// An OBJ file of what matters: the faces, before and after, and the way; empty for the result.
  std::string scene;
};

struct Replay_options
{
  /// When not, links, locks and geometry are judged alone, and of the limits the weld distance, without
  /// which a snap could be anything.
  bool are_limits_judged = true;

  /// Judged in place of those that the log declares, all of which are then set aside. Without a weld
  /// distance among them nothing may snap.
  std::optional<Reduction_limits> limits;

  /// The SHA-256 of the file that the original was read from, as `sha256_of_file` gives it; empty when
  /// unknown. Where the log names one, too, `replay` throws `Input_error` unless both are the same.
  std::string sha256_of_original;

  bool is_all_wanted = false; ///< go on after a bad step, as if it were good

  /// Asked now and then with the number of steps done; when it returns true, the replay ends there. It may
  /// be empty.
  std::function<bool(std::size_t)> should_stop;
};

/// Whose limits were judged.
enum class Limits_source {
  none, ///< nobody's: `are_limits_judged` was not set
  log,  ///< those that the log declares
  judge ///< those of `Replay_options::limits`
};

/// "none", "log", "judge".
const char* name(Limits_source source);

/// The verdict, its terms, and what the steps lead to.
struct Replay_verdict
{
  /// One, or with `is_all_wanted` one for every bad step, in order; then that of the result, if there is
  /// one.
  std::vector<Violation> violations;

  Log_header header;
  std::size_t steps = 0; ///< taken
  std::size_t snaps = 0; ///< of the steps
  std::size_t collapses = 0;
  bool is_stopped = false;

  /// Those that were judged, with their values. The weld distance is one of them also where none were to be.
  Reduction_limits limits;
  Limits_source limits_source = Limits_source::log;
  bool is_input_stated = false;    ///< the log names the SHA-256 of its input, and the original's is that
  bool is_result_stated = false;   ///< the log names a digest of its result, and that of `soup` is the same
  std::size_t offending_pairs = 0; ///< of the original; their triangles do not move

  double largest_snap = 0;         ///< the longest snap, in the unit of the coordinates
  double largest_way_of_snaps = 0; ///< how far the snaps took a vertex altogether: several snaps may move one

  /// After the last step taken, as `simplify_soup` gives it.
  Triangle_soup soup;

  std::size_t pairs_judged = 0;
  std::size_t pairs_judged_in_rationals = 0;
  double seconds_prepare = 0; ///< judging the original
  double seconds_steps = 0;

  bool is_accepted() const { return violations.empty() && !is_stopped; }
};

/// Something that a verdict says nothing about.
struct Not_judged
{
  /// The key of a limit, or "lines", "limits_of_snaps", "obstacle", "input", "result" or "attributes".
  std::string key;

  std::string sentence; ///< what it is, and why it was not judged, for a person
};

/// Returns all that a verdict says nothing about, as far as that is known.
std::vector<Not_judged> not_judged(const Replay_verdict& verdict);

/// Does to a mesh what a log says, and judges every step.
///
/// **Guarantees**, when the verdict is "accepted":
/// 1. *Embedded*: after every step, every two faces meet exactly in what they share, except pairs that did
///    not already in the original; and these have stayed as they were.
/// 2. *Motion*: no two faces met on the way of any step beyond what they share.
/// 3. *Topology*: every collapse meets the link condition over positions, so that pieces stay the manifolds
///    they were.
/// 4. *Snaps*: every snap took a border vertex to one of its partners, as snapping.h defines them and at
///    that moment, no further than `limits.weld_distance`; neither belonged to a face that offended. What it
///    made one are pairs of border edges that run in opposite ways, and no other edges. 1 and 2 hold for
///    snaps as for collapses.
/// 5. *Limits*: every collapse kept every limit that has a value in `limits`.
/// 6. *Result*: `soup` is what the log says it is, as far as it does; `is_result_stated` says whether to the
///    last triangle.
///
/// **Not promised** Whatever `not_judged` returns. Of a log with snaps: that the partners were the nearest,
/// or the order a good one, or all gaps were closed; that angles and shapes of faces kept the limits in a
/// snap, since its distance is the only limit of a snap; that a vertex that snapped several times is within
/// the weld distance of where it was (`largest_way_of_snaps` says how far it went); and borders drift from
/// where the snaps have put them, not from where they were in the original.
///
/// And when it is not: the first violation is of the first bad step. With `is_all_wanted` that step is taken
/// all the same, where it can be, and a later one counts when it is bad in another way, or brings together
/// two faces that did not meet before it.
///
/// **Independence** No code is shared with the policies, the index, the working mesh or the loop: the mesh
/// here is a list of triangles over positions, the index a tree of boxes, and contacts are asked for by
/// time. What is shared: the reader of meshes, rounding, and the judge of the original (`verify.h`), which
/// are no part of a reduction.
///
/// **Preconditions** The soup is what `read_mesh` gives for the file that the log names. Checked
/// (`Input_error`): the counts in the log's `input` line; whatever the log says that is no log.
///
/// **Exactness** Everything about contacts, and every sign it takes: doubles with a proved bound, else
/// rational numbers. Limits are compared in floating point, with 1e-9 of tolerance for programs that round
/// otherwise; no statement about intersections rests on them.
///
/// **Complexity** O((n + k) log n) for n triangles and k steps as a rule.
Replay_verdict replay(const Triangle_soup& original, bool is_stl, Log_reader& log,
                      const Replay_options& options = {});

} // namespace selvedge

#endif // SELVEDGE_REPLAY_H
