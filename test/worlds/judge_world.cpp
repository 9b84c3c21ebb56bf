// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "judge_world.h"

#include "Judged_complex.h"
#include "judge_files.h"
#include "judge_result.h"
#include "judge_start.h"
#include "judge_stop.h"
#include "random_world.h"
#include "same_bits.h"

#include <algorithm>
#include <exception>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace selvedge::test {

const char* name(Promise promise)
{
  static constexpr const char* s_names[] = {"preparation", "embedded",    "motion",     "topology",
                                            "seams",       "clearance",   "attributes", "frozen",
                                            "stop",        "verdict",     "log replay", "progression",
                                            "written",     "determinism", "refusal"};
  return s_names[std::size_t(promise)];
}

Judgement_counts& Judgement_counts::operator+=(const Judgement_counts& other)
{
  worlds += other.worlds;
  refused_worlds += other.refused_worlds;
  collapses += other.collapses;
  placed += other.placed;
  snaps += other.snaps;
  turned += other.turned;
  twins += other.twins;
  option_sets += other.option_sets;
  for (const auto& [option, count] : other.options)
    options[option] += count;
  return *this;
}

namespace {

// Whether the triangles after so many steps of the progression are those that are alive, with their corners
// where they are now.
bool is_state(const World_run& run, std::size_t steps, const Judged_complex& complex)
{
  const Progression& progression = run.result.progression;
  std::map<Index, Index> position_of_wedge; // from where it starts
  for (std::size_t t = 0; t < progression.wedges.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index position = complex.position(run.prepared.soup.triangles[t][k]);
      if (position_of_wedge.emplace(progression.wedges[t][k], position).first->second != position)
        return false;
    }
  std::size_t alive = 0;
  for (const auto& [triangle, wedges] : triangles_after(progression, steps)) {
    Index_triple found, positions = complex.positions_of(triangle);
    for (std::size_t k = 0; k < 3; ++k)
      found[k] = position_of_wedge.at(wedges[k]);
    if (run.prepared.turned_faces() > 0) { // they run otherwise meanwhile, and doubles with them
      std::sort(found.begin(), found.end());
      std::sort(positions.begin(), positions.end());
    }
    if (found != positions)
      return false;
    alive += complex.is_alive(triangle);
  }
  return alive == complex.own_faces_alive();
}

// In places of a shared mesh, several collapses are one step.
Verdict judge_collapses(const World_run& run, Judged_complex& complex, Judgement_counts& counts)
{
  const Progression& progression = run.result.progression;
  std::size_t steps = 0;
  for (std::size_t i = 0; i < run.collapses.size(); ++i) {
    const auto& [removed, kept, at, is_removed_first] = run.collapses[i];
    ++counts.collapses;
    counts.placed += at.has_value();
    const Index from = complex.position(Index(removed)), to = complex.position(Index(kept));
    if (auto broken = at ? complex.collapse(from, to, {(*at)[0], (*at)[1], (*at)[2]}, is_removed_first)
                         : complex.collapse(from, to)) {
      broken->message += " in collapse " + std::to_string(i + 1) + ", " + std::to_string(removed) + " to " +
                         std::to_string(kept) + (at ? " at a new place" : "");
      return broken;
    }
    if (steps < progression.steps.size() && is_state(run, steps + 1, complex))
      ++steps;
  }
  if (steps != progression.steps.size() || (!progression.empty() && !is_state(run, steps, complex)))
    return Broken_promise{Promise::progression,
                          "step " + std::to_string(steps + 1) + " is none that the reduction took"};
  return std::nullopt;
}

/// Vertices on the two sides of a gap go together: the report counts those whose partners went without them.
Verdict judge_ties(const World& world, const World_run& run)
{
  if (world.options.loop != Collapse_loop::own || run.result.shared_meshes > 0)
    return std::nullopt;
  std::set<Index> gone; // positions
  for (const Soup_collapse& collapse : run.collapses)
    gone.insert(run.prepared.positions[collapse.removed]);
  const auto alone =
      std::size_t(std::count_if(run.prepared.tied.begin(), run.prepared.tied.end(), [&](const auto& pair) {
        return gone.count(pair.first) != gone.count(pair.second);
      }));
  if (alone != run.result.report.left_alone)
    return Broken_promise{Promise::seams, std::to_string(alone) +
                                              " vertices are left whose partners across a gap are gone, " +
                                              std::to_string(run.result.report.left_alone) + " are reported"};
  return std::nullopt;
}

/// Judged alone beside the obstacle, the result has the same offending pairs.
Verdict judge_beside_obstacle(const World& world, const World_run& run)
{
  if (run.prepared.obstacle.triangles.empty())
    return std::nullopt;
  Verify_options options;
  options.may_intersect = world.may_intersect;
  const auto pairs_of = [&](const std::vector<Offending_pair>& pairs) {
    std::set<std::pair<Index, Index>> own;
    for (const Offending_pair& pair : pairs)
      if (std::min(pair.first, pair.second) < run.result.soup.triangles.size())
        own.insert(std::minmax(Index(pair.first), Index(pair.second)));
    return own;
  };
  const std::vector<Offending_pair> alone = verify(run.result.soup, options, run.prepared.obstacle).pairs;
  if (pairs_of(alone) == pairs_of(run.verification.pairs) && pairs_of(alone).size() == alone.size())
    return std::nullopt;
  return Broken_promise{Promise::verdict, "judged alone, the result has " + std::to_string(alone.size()) +
                                              " offending pairs with the obstacle"};
}

/// One reduction of what is prepared; the complex is as it was before it.
Verdict judge_reduction(const World& world, const World_run& run, Judged_complex complex,
                        Judgement_counts& counts)
{
  for (const std::string& option : options_used(world))
    ++counts.options[option];
  const std::vector<char> is_held = held(world, run.prepared.soup, true);
  for (Index t = 0; t < is_held.size(); ++t)
    if (is_held[t])
      for (const Index v : run.prepared.soup.triangles[t])
        complex.freeze_position(complex.position(v));
  // A locked vertex that no triangle has holds those alone that are at its position in all poses.
  std::set<Index> locked;
  for (const Index v : world.intent.locked_vertices)
    locked.insert(run.prepared.positions[v]);
  for (const Index_triple& triangle : run.prepared.soup.triangles)
    for (const Index v : triangle)
      if (locked.count(run.prepared.positions[v]) > 0)
        complex.freeze_position(complex.position(v));
  const auto turn_faces = [&] {
    for (Index t = 0; t < run.prepared.is_turned.size(); ++t)
      if (run.prepared.is_turned[t])
        complex.turn(t);
  };
  counts.turned += run.prepared.turned_faces();
  turn_faces();
  complex.find_seams(run.prepared.soup);
  if (world.options.clearance)
    complex.keep_clearance(*world.options.clearance);
  const std::vector<Index> regions = complex.regions();
  if (auto broken = judge_collapses(run, complex, counts))
    return broken;
  turn_faces(); // the result has the winding of the input
  if (auto broken = judge_attributes(world, run, complex, regions, is_held))
    return broken;
  if (auto broken = judge_ties(world, run))
    return broken;
  if (auto broken = judge_drift(world, run))
    return broken;
  if (auto broken = judge_pieces(run))
    return broken;
  if (auto broken = judge_sharing(run))
    return broken;
  if (run.result.shared_meshes > 0 && !run.collapses.empty())
    ++counts.options["shared_meshes"];
  if (run.result.mended_normals > 0)
    ++counts.options["mended_normals"];
  if (run.result.fitted_normals > 0)
    ++counts.options["fitted_normals"];
  if (run.result.fitted_attributes > 0)
    ++counts.options["fitted_attributes"];
  if (run.prepared.normals == Normals_treatment::picked && !run.collapses.empty())
    ++counts.options["picked_normals"];
  if (run.prepared.normals == Normals_treatment::softened && !run.collapses.empty())
    ++counts.options["softened_normals"];
  if (!run.prepared.tied.empty() && !run.collapses.empty())
    ++counts.options["ties"];
  if (!run.prepared.facing.empty() && !run.collapses.empty())
    ++counts.options["facing"];
  if (run.prepared.doubles() > 0 && !run.collapses.empty())
    ++counts.options["doubles"];
  if (auto broken = judge_stop(world, run))
    return broken;
  if (!run.verification.accepted()) {
    const auto& mismatches = run.verification.matching.mismatches;
    return Broken_promise{Promise::verdict,
                          std::to_string(run.verification.new_pairs.size()) + " new pairs, topology " +
                              (run.verification.same_topology() ? "kept" : "changed") +
                              (mismatches.empty() ? "" : ", " + mismatches.front().message)};
  }
  return judge_beside_obstacle(world, run);
}

/// The same collapses in each further pose.
Verdict judge_poses(const World& world, const World_run& run)
{
  const Prepared_soup& prepared = run.prepared;
  for (std::size_t pose = 0; pose < prepared.soup.poses.size(); ++pose) {
    const World posed = in_pose(world, pose);
    const auto broken = [&](Promise promise, const std::string& what) {
      return Broken_promise{promise, what + " in the pose " + prepared.soup.poses[pose].name};
    };
    const Expected_start expected(posed);
    const std::vector<Point_3>& points = prepared.soup.poses[pose].points;
    if (expected.soup.triangles != prepared.soup.triangles || points.size() != expected.soup.points.size() ||
        !std::equal(points.begin(), points.end(), expected.soup.points.begin(), has_same_bits))
      return broken(Promise::preparation, "other triangles or points");
    Judged_complex complex(expected.soup, expected.obstacle);
    complex.permit(expected.part_of);
    const auto pairs = complex.offending_pairs();
    std::set<std::pair<Index, Index>> found;
    for (const Offending_pair& pair : prepared.offending_pairs_in_poses[pose])
      found.insert({pair.first, pair.second});
    if (found != pairs)
      return broken(Promise::preparation, std::to_string(found.size()) + " offending pairs found, of " +
                                              std::to_string(pairs.size()));
    if (world.defects == Defects::descend)
      complex.exempt(pairs);
    for (Index f = 0; f < expected.soup.triangles.size() + expected.obstacle.triangles.size(); ++f) {
      bool is_frozen = f >= expected.soup.triangles.size();
      if (!is_frozen)
        for (const Index v : expected.soup.triangles[f])
          is_frozen = is_frozen || expected.is_merged[v];
      if (world.defects != Defects::descend)
        for (const auto& [a, b] : pairs)
          is_frozen = is_frozen || a == f || b == f;
      if (is_frozen && !prepared.is_frozen[f])
        return broken(Promise::frozen, "triangle " + std::to_string(f) + " should be frozen, and is not");
      if (is_frozen)
        complex.freeze(f);
    }
    for (Index t = 0; t < prepared.is_turned.size(); ++t)
      if (prepared.is_turned[t])
        complex.turn(t);
    complex.find_seams(prepared.soup);
    if (world.options.clearance && world.is_guarded(pose))
      complex.keep_clearance(*world.options.clearance);
    for (const Soup_collapse& collapse : run.collapses)
      if (prepared.is_held[collapse.removed])
        return broken(Promise::frozen, "vertex " + std::to_string(collapse.removed) +
                                           " is coincident with others in some poses alone, and has moved");
    Judgement_counts uncounted;
    if (world.is_guarded(pose))
      if (auto verdict = judge_collapses(run, complex, uncounted))
        return broken(verdict->promise, verdict->message);
    const Triangle_soup& result = run.result.soup;
    for (Index i = 0; i < result.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const Index corner = run.result.corners[i][k];
        if (!has_same_bits(result.poses[pose].points[result.triangles[i][k]],
                           points[prepared.soup.triangles[corner / 3][corner % 3]]))
          return broken(Promise::attributes, "a point of another vertex");
      }
  }
  return std::nullopt;
}

Verdict judge_other_options(const World& world, const World_run& run, const Judged_complex& complex,
                            Judgement_counts& counts, std::size_t option_sets)
{
  for (std::size_t number = 1; number <= option_sets; ++number) {
    ++counts.option_sets;
    const World other = with_other_options(world, number);
    World_run again = run_again(other, run.prepared);
    again.prepared = run.prepared;
    again.verification = verify_guarded(other, again.result, again.prepared);
    if (auto broken = judge_reduction(other, again, complex, counts))
      return broken;
    if (auto broken = judge_poses(other, again))
      return broken;
  }
  return std::nullopt;
}

} // namespace

Verdict judge(const World& world, const World_run& run, Judgement_counts& counts,
              const Judgement_extent& extent)
{
  if (run.refusal)
    return judge_refusal(world, *run.refusal);
  const Expected_start expected(world);
  Judged_complex complex(expected.soup, expected.obstacle);
  complex.permit(expected.part_of);
  if (auto broken = judge_preparation(world, run, expected, complex))
    return broken;
  if (auto broken = judge_snaps(world, run, complex, counts.snaps))
    return broken;
  if (auto broken = judge_reduction(world, run, complex, counts))
    return broken;
  if (auto broken = judge_poses(world, run))
    return broken;
  if (extent.is_replay_asked)
    if (auto broken = judge_replay(world, run))
      return broken;
  if (auto broken = judge_file(world, run))
    return broken;
  if (auto broken = judge_progressive_file(run))
    return broken;
  return judge_other_options(world, run, complex, counts, extent.option_sets);
}

Verdict judge(const World& world, Judgement_counts& counts, const Judgement_extent& extent)
{
  try {
    const World_run run = test::run(world);
    ++(run.refusal ? counts.refused_worlds : counts.worlds);
    if (auto broken = judge(world, run, counts, extent))
      return broken;
    return judge_twins(world, run, counts, extent);
  } catch (const std::exception& error) {
    return Broken_promise{Promise::refusal, error.what()};
  }
}

} // namespace selvedge::test
