// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/prepare.h>

#include "soup/Gltf_scene.h"
#include "soup/Sewing.h"
#include "soup/check_soup.h"
#include "soup/number_positions.h"
#include "soup/obstacle.h"
#include "soup/selection.h"
#include "soup/transforms_of_vertices.h"
#include "verify/Diagonal.h"
#include "verify/for_each_pose.h"
#include "weld/snapping.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/Surface_mesh_simplification/internal/mesh_diagonal.h>
#include <selvedge/internal/Stopwatch.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace selvedge {
namespace {

bool has_two_corners_at_one_position(const Index_triple& triangle, const std::vector<Index>& positions)
{
  const Index a = positions[triangle[0]], b = positions[triangle[1]], c = positions[triangle[2]];
  return a == b || b == c || c == a;
}

void refuse_if_any(const std::vector<Offending_pair>& pairs, std::size_t own_triangles,
                   const std::string& where = "")
{
  if (pairs.empty())
    return;
  throw Input_error(
      "the mesh is not embedded" + where + ": " + describe(pairs.front(), own_triangles) +
      (pairs.size() == 1 ? "" : ", and " + std::to_string(pairs.size() - 1) + " more such pairs") +
      "; repair it, or do not ask to refuse such a mesh");
}

// Returns the first of the vertices that have the same position in two numberings, for every vertex.
std::vector<Index> refined(const std::vector<Index>& a, const std::vector<Index>& b)
{
  std::vector<Index> order(a.size()), result(a.size());
  std::iota(order.begin(), order.end(), Index(0));
  const auto key = [&](Index v) { return std::make_pair(a[v], b[v]); };
  std::sort(order.begin(), order.end(),
            [&](Index v, Index w) { return std::make_pair(key(v), v) < std::make_pair(key(w), w); });
  for (std::size_t i = 0; i < order.size(); ++i)
    result[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? result[order[i - 1]] : order[i];
  return result;
}

// Gives different positions to vertices that rounding has separated: where a vertex of the soup has moved and
// a vertex of the obstacle at the same position has not. `after` numbers the positions as they are now.
void take_apart(std::vector<Index>& positions, const std::vector<Index>& after)
{
  std::vector<Index> first_left(positions.size(), std::numeric_limits<Index>::max()); // by position before
  for (Index v = 0; v < positions.size(); ++v)
    if (after[v] != after[positions[v]])
      positions[v] = first_left[positions[v]] = std::min(first_left[positions[v]], v);
}

/// The steps of `prepare`, in their order. Each judgement is made once.
class Preparation
{
public:
  Preparation(Triangle_soup input, const Prepare_options& options, const Triangle_soup& obstacle)
      : m_options(options)
  {
    m_prepared.soup = std::move(input);
    m_prepared.may_intersect = options.may_intersect;
    m_prepared.permitted_pairs.resize(options.may_intersect.size());
    m_prepared.obstacle.points = obstacle.points;
    m_prepared.obstacle.poses = obstacle.poses;
    m_prepared.obstacle.triangles = obstacle.triangles;
  }

  Prepared_soup run()
  {
    m_prepared.normals = take_normals(soup(), m_options.normals, &m_prepared.taken_normals);
    m_prepared.is_float32 = m_options.round_to_float32;
    leave_out_degenerate();
    const bool was_empty = soup().triangles.empty();
    if (m_options.round_to_float32 && !has_float32_points(soup()))
      round();
    if (soup().triangles.empty())
      throw Input_error(
          was_empty
              ? "every triangle of the mesh has two corners at one position; there is nothing to reduce"
              : "in 32-bit floats, which glTF and STL store, every triangle of the mesh has two corners at "
                "one position; move the mesh to the origin, or write OBJ, OFF or PLY");
    find_held_vertices();
    m_prepared.scale = Scale(soup(), obstacle());
    require_size();
    require_apart("");
    m_prepared.seconds_positions += m_stopwatch.restart();

    const std::size_t own_triangles = soup().triangles.size();
    append_obstacle(soup(), obstacle());
    judge(own_triangles);
    m_prepared.defects = m_options.defects == Defects::descend ? Defects::descend : Defects::freeze;
    freeze(own_triangles);
    find_doubles(own_triangles);
    m_prepared.seconds_check += m_stopwatch.restart();
    snap();
    m_prepared.seconds_snap = m_stopwatch.restart();
    remove_obstacle(soup(), obstacle());
    if (!m_prepared.snapping.snaps.empty())
      require_apart(" once borders have snapped together");
    if (m_options.orient)
      orient();
    return std::move(m_prepared);
  }

private:
  static constexpr Index s_none = std::numeric_limits<Index>::max();

  Triangle_soup& soup() { return m_prepared.soup; }
  const Triangle_soup& soup() const { return m_prepared.soup; }
  Triangle_soup& obstacle() { return m_prepared.obstacle; }
  const Triangle_soup& obstacle() const { return m_prepared.obstacle; }
  bool is_strict() const { return m_options.defects == Defects::refuse; }

  // The positions of the obstacle follow those of the soup. Vertices have one position when they are
  // coincident in all poses.
  std::vector<Index> number_positions_of_both() const
  {
    std::vector<Index> positions = number_positions_of_both(soup().points, obstacle().points);
    for (std::size_t pose = 0; pose < soup().poses.size(); ++pose)
      positions = refined(positions, number_positions_in(pose));
    return positions;
  }
  std::vector<Index> number_positions_in(std::size_t pose) const
  {
    return number_positions_of_both(soup().poses[pose].points, points_in_pose(obstacle(), pose));
  }
  static std::vector<Index> number_positions_of_both(std::vector<Point_3> points,
                                                     const std::vector<Point_3>& beside)
  {
    points.insert(points.end(), beside.begin(), beside.end());
    return number_positions(points);
  }

  // Finds the vertices that are coincident with others in some poses and not in all.
  void find_held_vertices()
  {
    if (soup().poses.empty())
      return;
    const std::vector<Index> in_all = number_positions_of_both();
    m_prepared.is_held.assign(in_all.size(), false);
    const auto hold = [&](const std::vector<Index>& here, const std::string& where, const char* mend) {
      std::vector<Index> first(here.size(), s_none); // by position here, of those in all poses
      std::vector<char> is_several(here.size(), false);
      const auto refuse_if_degenerate = [&](const std::vector<Index_triple>& triangles, Index first_vertex,
                                            const std::string& whose) {
        for (const Index_triple& triangle : triangles) {
          const auto& [a, b, c] = triangle;
          if (has_two_corners_at_one_position({a + first_vertex, b + first_vertex, c + first_vertex}, here))
            throw Input_error("triangle " + std::to_string(&triangle - triangles.data() + 1) + whose +
                              " has two corners at one position in " + where + ", and not in all poses; " +
                              mend);
        }
      };
      refuse_if_degenerate(soup().triangles, 0, "");
      refuse_if_degenerate(obstacle().triangles, Index(soup().points.size()), " of the obstacle");
      for (const Index_triple& triangle : soup().triangles) {
        for (const Index v : triangle) {
          Index& of_position = first[here[v]];
          is_several[here[v]] |= of_position != s_none && of_position != in_all[v];
          of_position = in_all[v];
        }
      }
      for (const Index_triple& triangle : soup().triangles)
        for (const Index v : triangle) {
          if (is_several[here[v]] && !m_prepared.is_held[v] && m_prepared.first_held.empty())
            m_prepared.first_held = "vertex " + std::to_string(v + 1) + " in " + where;
          m_prepared.is_held[v] |= is_several[here[v]];
        }
    };
    hold(number_positions_of_both(soup().points, obstacle().points),
         "the first pose, which is the mesh's own",
         "part the corners, remove the triangle, or give no poses");
    for (std::size_t pose = 0; pose < soup().poses.size(); ++pose)
      hold(number_positions_in(pose), "the pose '" + soup().poses[pose].name + "'",
           "leave out this pose (--without-pose), or part the corners");
  }

  // Takes out the pairs between parts that may intersect, and returns how many there were for each. The
  // obstacle belongs to no part.
  std::vector<std::size_t> permit(std::vector<Offending_pair>& pairs)
  {
    std::vector<std::size_t> counts;
    for (const auto& [a, b] : m_options.may_intersect)
      counts.push_back(take_out_pairs_between(triangles_named(soup(), a), triangles_named(soup(), b), pairs));
    return counts;
  }

  std::string in_pose(std::size_t pose) const { return " in the pose '" + soup().poses[pose].name + "'"; }

  void refuse_if_any_offend()
  {
    std::vector<Offending_pair> pairs = offending_pairs(geometry_with_obstacle(soup(), obstacle()));
    permit(pairs);
    refuse_if_any(pairs, soup().triangles.size());
    for (std::size_t pose = 0; pose < soup().poses.size(); ++pose) {
      pairs = offending_pairs(geometry_in_pose(soup(), obstacle(), pose));
      permit(pairs);
      refuse_if_any(pairs, soup().triangles.size(), in_pose(pose));
    }
  }

  // Refuses what `mesh_diagonal` would refuse later, at the scale.
  void require_size()
  {
    const double diagonal = m_prepared.scale(internal::Diagonal(soup()).length());
    if (diagonal > 0 && diagonal < internal::least_diagonal)
      throw Input_error(
          "the mesh is 2^200 times as far from the origin as it is large, so that squares of its "
          "areas are no numbers; move it to the origin");
  }

  // Parts that may intersect have no position in common, not even one that only rounding has made one. So no
  // star of a vertex ever has triangles of both.
  void require_apart(const std::string& when)
  {
    if (m_options.may_intersect.empty())
      return;
    require_apart(number_positions(soup().points), when);
    for (const Pose& pose : soup().poses)
      require_apart(number_positions(pose.points), when + " in the pose '" + pose.name + "'");
  }
  void require_apart(const std::vector<Index>& positions, const std::string& when)
  {
    for (const auto& [a, b] : m_options.may_intersect) {
      const std::vector<char> is_of_a = triangles_named(soup(), a), is_of_b = triangles_named(soup(), b);
      std::vector<char> has_a(positions.size(), false);
      for (Index t = 0; t < soup().triangles.size(); ++t)
        if (is_of_a[t] && is_of_b[t])
          throw Argument_error("triangle " + std::to_string(t + 1) + " belongs to both '" + a + "' and '" +
                               b + "'; no part may intersect itself");
      for (Index t = 0; t < soup().triangles.size(); ++t)
        for (const Index v : soup().triangles[t])
          has_a[positions[v]] |= is_of_a[t];
      for (Index t = 0; t < soup().triangles.size(); ++t)
        for (const Index v : soup().triangles[t])
          if (is_of_b[t] && has_a[positions[v]])
            throw Argument_error("the parts '" + a + "' and '" + b + "' share the vertex " +
                                 std::to_string(v + 1) + when +
                                 "; only parts that are not joined may intersect");
    }
  }

  std::size_t leave_out(const std::vector<Index>& positions)
  {
    std::vector<Index> kept;
    for (Index t = 0; t < soup().triangles.size(); ++t)
      if (!has_two_corners_at_one_position(soup().triangles[t], positions))
        kept.push_back(t);
    const std::size_t left_out = soup().triangles.size() - kept.size();
    if (left_out > 0) {
      keep_triangles(soup(), kept);
      if (std::vector<Index_triple>& normals = m_prepared.taken_normals.of_triangle; !normals.empty()) {
        for (std::size_t i = 0; i < kept.size(); ++i)
          normals[i] = normals[kept[i]];
        normals.resize(kept.size());
      }
    }
    return left_out;
  }

  void leave_out_degenerate()
  {
    m_prepared.positions = number_positions_of_both();
    const std::vector<Index> of_obstacle(m_prepared.positions.begin() + soup().points.size(),
                                         m_prepared.positions.end());
    const auto is_degenerate = [](const std::vector<Index>& positions) {
      return [&positions](const Index_triple& v) { return has_two_corners_at_one_position(v, positions); };
    };
    const auto& own = soup().triangles;
    auto& others = obstacle().triangles;
    if (is_strict() && (std::any_of(own.begin(), own.end(), is_degenerate(m_prepared.positions)) ||
                        std::any_of(others.begin(), others.end(), is_degenerate(of_obstacle))))
      refuse_if_any_offend();
    others.erase(std::remove_if(others.begin(), others.end(), is_degenerate(of_obstacle)), others.end());
    m_prepared.left_out_faces_that_open =
        std::size_t(std::count_if(own.begin(), own.end(), [&](const Index_triple& v) {
          const auto part = [&](Index a, Index b) {
            return m_prepared.positions[a] == m_prepared.positions[b] && may_part(soup(), a, b);
          };
          return part(v[0], v[1]) || part(v[1], v[2]) || part(v[2], v[0]);
        }));
    m_prepared.left_out_faces = leave_out(m_prepared.positions);
  }

  // Also finds which pairs offended before rounding, and the positions after it.
  void round()
  {
    Triangle_soup unrounded;
    unrounded.points = soup().points;
    if (is_strict()) { // judges before rounding, since triangles may have other numbers afterwards
      m_prepared.seconds_positions += m_stopwatch.restart();
      refuse_if_any_offend();
      m_prepared.seconds_check += m_stopwatch.restart();
    }
    std::vector<std::vector<Index>> before; // by pose
    for (std::size_t pose = 0; pose < soup().poses.size(); ++pose)
      before.push_back(number_positions_in(pose));
    if (!before.empty())
      before.push_back(number_positions_of_both(soup().points, obstacle().points));
    m_prepared.rounding = round_to_float32(soup());
    m_positions_rounded = number_positions_of_both();
    note_merged_in_poses(before);
    m_prepared.left_out_by_rounding = leave_out(m_positions_rounded);
    take_apart(m_prepared.positions, m_positions_rounded);
    m_prepared.seconds_positions += m_stopwatch.restart();
    if (!is_strict()) {
      unrounded.triangles = soup().triangles;
      append_obstacle(unrounded, obstacle());
      m_pairs_before_rounding = offending_pairs(unrounded);
      m_prepared.seconds_check += m_stopwatch.restart();
    }
  }

  // Notes the vertices that rounding has brought to one position with others, in some pose. `before` numbers
  // the positions in each pose before rounding, the first pose last.
  void note_merged_in_poses(const std::vector<std::vector<Index>>& before)
  {
    for (std::size_t i = 0; i < before.size(); ++i) {
      const std::vector<Index> after = i + 1 < before.size()
                                           ? number_positions_in(i)
                                           : number_positions_of_both(soup().points, obstacle().points);
      std::vector<char> is_merged(after.size(), false); // by position
      for (Index v = 0; v < after.size(); ++v)
        is_merged[after[v]] |= before[i][v] != before[i][after[v]];
      m_is_merged_in_a_pose.resize(after.size());
      for (Index v = 0; v < after.size(); ++v)
        m_is_merged_in_a_pose[v] |= is_merged[after[v]];
    }
  }

  void judge(std::size_t own_triangles)
  {
    m_all_pairs = offending_pairs(soup());
    m_prepared.offending_pairs = m_all_pairs;
    m_prepared.permitted_pairs = permit(m_prepared.offending_pairs);
    m_prepared.offending_pairs_in_poses.resize(soup().poses.size());
    internal::for_each_pose(soup().poses.size(), [&](std::size_t pose) {
      m_prepared.offending_pairs_in_poses[pose] = offending_pairs(geometry_in_pose(soup(), {}, pose));
    });
    for (std::vector<Offending_pair>& pairs : m_prepared.offending_pairs_in_poses)
      permit(pairs);
    if (is_strict() && m_positions_rounded.empty()) { // `round` refuses before rounding
      refuse_if_any(m_prepared.offending_pairs, own_triangles);
      for (std::size_t pose = 0; pose < soup().poses.size(); ++pose)
        refuse_if_any(m_prepared.offending_pairs_in_poses[pose], own_triangles, in_pose(pose));
    }
    if (m_prepared.rounding.coordinates == 0)
      return;
    const auto comes_before = [](const Offending_pair& a, const Offending_pair& b) {
      return std::make_pair(a.first, a.second) < std::make_pair(b.first, b.second);
    };
    m_prepared.pairs_by_rounding =
        std::count_if(m_prepared.offending_pairs.begin(), m_prepared.offending_pairs.end(),
                      [&](const Offending_pair& pair) {
                        return !std::binary_search(m_pairs_before_rounding.begin(),
                                                   m_pairs_before_rounding.end(), pair, comes_before);
                      });
  }

  void freeze_held()
  {
    for (Index t = 0; t < m_prepared.soup.triangles.size() && !m_prepared.is_held.empty(); ++t)
      for (const Index v : m_prepared.soup.triangles[t])
        m_prepared.is_frozen[t] |= m_prepared.is_held[v];
  }

  void freeze(std::size_t own_triangles)
  {
    std::vector<char>& is_frozen = m_prepared.is_frozen;
    is_frozen.assign(soup().triangles.size(), false);
    const auto freeze_faces_of = [&](const std::vector<Offending_pair>& pairs) {
      for (const Offending_pair& pair : pairs)
        is_frozen[pair.first] = is_frozen[pair.second] = true;
    };
    if (m_prepared.defects == Defects::freeze) {
      freeze_faces_of(m_prepared.offending_pairs);
      std::for_each(m_prepared.offending_pairs_in_poses.begin(), m_prepared.offending_pairs_in_poses.end(),
                    freeze_faces_of);
    }
    if (!m_positions_rounded.empty()) {
      std::vector<char> is_merged(soup().points.size(), false); // by position after rounding: it was several
      for (Index v = 0; v < m_positions_rounded.size(); ++v)
        is_merged[m_positions_rounded[v]] |=
            m_prepared.positions[v] != m_prepared.positions[m_positions_rounded[v]];
      for (Index t = 0; t < own_triangles; ++t)
        for (const Index v : soup().triangles[t])
          is_frozen[t] |= is_merged[m_positions_rounded[v]] ||
                          (!m_is_merged_in_a_pose.empty() && m_is_merged_in_a_pose[v]);
    }
    freeze_held();
    m_prepared.frozen_faces = std::count(is_frozen.begin(), is_frozen.begin() + own_triangles, true);
    std::fill(is_frozen.begin() + own_triangles, is_frozen.end(), true);
  }

  void find_doubles(std::size_t own_triangles)
  {
    if (m_prepared.defects != Defects::descend)
      return;
    std::vector<char> stays = m_prepared.is_frozen;
    const auto leave_degenerate = [&](const std::vector<Offending_pair>& pairs) {
      for (const Offending_pair& pair : pairs)
        if (pair.offence == Offence::degenerate)
          stays[pair.first] = true;
    };
    leave_degenerate(m_prepared.offending_pairs);
    std::for_each(m_prepared.offending_pairs_in_poses.begin(), m_prepared.offending_pairs_in_poses.end(),
                  leave_degenerate);
    std::vector<std::vector<char>> parts; // of which one of a pair may be guarded where the other is not
    for (const auto& [a, b] : m_options.may_intersect)
      for (const std::string* name : {&a, &b})
        parts.push_back(triangles_named(soup(), *name));
    const auto positions_of = [&](Index t) {
      Index_triple triangle = soup().triangles[t];
      for (Index& v : triangle)
        v = m_prepared.positions[v];
      std::sort(triangle.begin(), triangle.end());
      return triangle;
    };
    const auto belong_to_same_parts = [&](Index a, Index b) {
      return std::all_of(parts.begin(), parts.end(),
                         [&](const std::vector<char>& part) { return part[a] == part[b]; });
    };
    std::vector<Index>& fronts = m_prepared.fronts;
    for (const Offending_pair& pair : m_prepared.offending_pairs) {
      if (pair.offence != Offence::duplicate || pair.second >= own_triangles || stays[pair.first] ||
          stays[pair.second] || positions_of(pair.first) != positions_of(pair.second) || // in all poses
          !belong_to_same_parts(pair.first, pair.second))
        continue;
      if (fronts.empty()) {
        fronts.resize(own_triangles);
        std::iota(fronts.begin(), fronts.end(), Index(0));
      }
      fronts[pair.second] = std::min(fronts[pair.second], pair.first);
    }
  }

  void snap()
  {
    std::vector<Index> transforms = transforms_of_vertices(soup());
    if (!transforms.empty()) // no node of the scene transforms the vertices of the obstacle
      transforms.resize(soup().points.size(), std::numeric_limits<Index>::max());
    std::vector<char> stays = m_prepared.is_frozen;
    for (const Offending_pair& pair : m_all_pairs)
      stays[pair.first] = stays[pair.second] = true;
    mark_what_stays(stays);
    const std::vector<Point_3> points_before = soup().points;
    const std::size_t obstacle_triangles = obstacle().triangles.size();
    double distance = m_options.weld_distance;
    if (m_options.open_seams != Open_seams::ignore) {
      Open_borders open = find_open_seams(soup(), m_prepared.positions, transforms, obstacle_triangles,
                                          m_prepared.scale, m_options.open_seams == Open_seams::hold);
      m_prepared.border_gaps = std::move(open.gaps);
      hold(std::move(open.left));
      if (m_options.open_seams == Open_seams::weld)
        distance = m_prepared.border_gaps.clear_length.value_or(0);
    }
    if (distance != 0) {
      Snapped_borders snapped = snap_borders(soup(), m_prepared.positions, stays, distance, transforms,
                                             obstacle_triangles, m_prepared.scale);
      m_prepared.snapping = std::move(snapped.notes);
      hold(std::move(snapped.left));
    }
    forget_moved_polygons(soup(), points_before);
  }

  void mark_what_stays(std::vector<char>& stays) const
  {
    for (const std::string& name : m_options.parts_that_stay) {
      const std::vector<char> is_named = triangles_named(soup(), name);
      for (std::size_t t = 0; t < is_named.size(); ++t)
        stays[t] |= is_named[t];
    }
    std::vector<char> is_still(m_prepared.positions.size(), false); // by position
    for (const Index v : m_options.vertices_that_stay) {
      if (v >= is_still.size())
        throw Argument_error("there is no vertex " + std::to_string(v) + " (counted from 0) that could stay");
      is_still[m_prepared.positions[v]] = true;
    }
    for (std::size_t t = 0; t < soup().triangles.size(); ++t)
      for (const Index v : soup().triangles[t])
        stays[t] |= is_still[m_prepared.positions[v]];
  }

  void hold(Gaps_left left)
  {
    m_prepared.tied = std::move(left.tied);
    m_prepared.facing = std::move(left.facing);
  }

  // Nothing is sewn to the obstacle, so its triangles need not be asked.
  void orient()
  {
    const auto [numbers, triangles] =
        fronts_in_positions(soup().triangles, m_prepared.positions, m_prepared.fronts);
    const std::vector<char> is_turned =
        turned_triangles(triangles, Index(3 * triangles.size()), Index(m_prepared.positions.size()));
    m_prepared.is_turned.assign(is_turned.empty() ? 0 : soup().triangles.size(), false);
    for (std::size_t i = 0; i < is_turned.size(); ++i)
      m_prepared.is_turned[numbers[i]] = is_turned[i];
  }

  Prepare_options m_options;
  Prepared_soup m_prepared;
  std::vector<Index> m_positions_rounded;              // by vertex; empty when nothing was rounded
  std::vector<char> m_is_merged_in_a_pose;             // by vertex; empty when there is one pose
  std::vector<Offending_pair> m_all_pairs;             // those between parts that may intersect, too
  std::vector<Offending_pair> m_pairs_before_rounding; // with triangle numbers after it
  internal::Stopwatch m_stopwatch;
};

} // namespace

bool Prepared_soup::may_pairs_descend() const
{
  const auto has_some = [](const std::vector<Offending_pair>& pairs) { return !pairs.empty(); };
  return defects == Defects::descend &&
         (has_some(offending_pairs) ||
          std::any_of(offending_pairs_in_poses.begin(), offending_pairs_in_poses.end(), has_some));
}

std::size_t Prepared_soup::turned_faces() const
{
  return std::size_t(std::count(is_turned.begin(), is_turned.end(), char(true)));
}

std::size_t Prepared_soup::doubles() const
{
  std::size_t count = 0;
  for (Index t = 0; t < fronts.size(); ++t)
    count += fronts[t] != t;
  return count;
}

const char* name_of(Defects defects)
{
  static constexpr const char* s_names[] = {"descend", "freeze", "refuse"};
  return s_names[std::size_t(defects)];
}

Prepared_soup prepare(Triangle_soup input, const Prepare_options& options, const Triangle_soup& obstacle)
{
  if (input.triangles.empty())
    throw Input_error("the mesh has no triangles");
  const bool are_gaps_welded = options.open_seams == Open_seams::weld || options.weld_distance != 0;
  if (options.open_seams >= Open_seams::hold && options.weld_distance != 0)
    throw Argument_error("the length of gaps that are held or welded is either found or given, not both");
  check_soup(input, "the mesh");
  check_soup(obstacle, "the obstacle");
  if (!input.poses.empty() && are_gaps_welded)
    throw Argument_error(
        "gaps are not welded in several poses; weld the mesh in its own pose first, or leave "
        "out one of the two options");
  require_fitting_poses(obstacle, input);
  return Preparation(std::move(input), options, obstacle).run();
}

} // namespace selvedge
