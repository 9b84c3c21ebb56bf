// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Judged_complex.h"
#include "Random.h"
#include "judge_files.h"
#include "judge_world.h"
#include "same_bits.h"

#include "soup/selection.h"
#include "support/Temporary_folder.h"
#include <selvedge/Error.h>
#include <selvedge/Error_search.h>
#include <selvedge/Missed_target.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse_record.h>
#include <selvedge/cells.h>
#include <selvedge/compare.h>
#include <selvedge/mesh_files.h>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

// The places of the twin are those of the run, multiplied by 2^exponent.
Verdict compare(World_run twin, const World_run& run, const std::string& what, int exponent = 0)
{
  const auto broken = [&](const char* how) { return Broken_promise{Promise::determinism, what + how}; };
  if (twin.refusal.has_value() != run.refusal.has_value())
    return broken(": one of them is refused");
  for (Soup_collapse& collapse : twin.collapses)
    if (collapse.place)
      for (double& coordinate : *collapse.place)
        coordinate = std::ldexp(coordinate, -exponent);
  if (twin.collapses != run.collapses) {
    const auto differ = std::mismatch(twin.collapses.begin(), twin.collapses.end(), run.collapses.begin(),
                                      run.collapses.end());
    return Broken_promise{Promise::determinism,
                          what + ": other collapses from number " +
                              std::to_string(differ.first - twin.collapses.begin() + 1)};
  }
  if (twin.result.triangles != run.result.triangles || twin.result.corners != run.result.corners ||
      twin.result.soup.triangles != run.result.soup.triangles)
    return broken(": another result");
  return std::nullopt;
}

Verdict compare_bits(const World_run& twin, const World_run& run, const std::string& what)
{
  if (auto broken = compare(twin, run, what))
    return broken;
  const auto &a = twin.result.soup.points, &b = run.result.soup.points;
  if (a.size() != b.size() || !std::equal(a.begin(), a.end(), b.begin(), has_same_bits))
    return Broken_promise{Promise::determinism, what + ": other points"};
  return std::nullopt;
}

// Of runs that were told to stop at a question, one may have got farther than the other: the loop asks at
// every 256th edge that it considers, and a refused edge is considered again when the face in its way moves.
// Of several such faces, each index names another.
Verdict compare_beginnings(const World_run& twin, const World_run& run, const std::string& what)
{
  const bool is_twin_shorter = twin.collapses.size() < run.collapses.size();
  const World_run &shorter = is_twin_shorter ? twin : run, &longer = is_twin_shorter ? run : twin;
  if (shorter.collapses.size() == longer.collapses.size() || !shorter.result.report.is_stopped)
    return compare_bits(twin, run, what);
  if (!std::equal(shorter.collapses.begin(), shorter.collapses.end(), longer.collapses.begin()))
    return Broken_promise{Promise::determinism, what + ": other collapses before the first stop"};
  return std::nullopt;
}

template <class Function>
World with_points(const World& world, Function function)
{
  World twin = world;
  const auto change = [&](std::vector<Point_3>& points) {
    for (Point_3& p : points)
      p = Point_3(function(p.x()), function(p.y()), function(p.z()));
  };
  for (Triangle_soup* soup : {&twin.soup, &twin.obstacle}) {
    change(soup->points);
    for (Pose& pose : soup->poses)
      change(pose.points);
  }
  return twin;
}

/// A power of two by which all coordinates can be multiplied without loss; none when there is none but 1.
std::optional<int> random_exponent(const World& world, Random& random)
{
  int low = 2000, high = -2000;
  const auto add = [&](double x) {
    if (x != 0) {
      low = std::min(low, std::ilogb(x));
      high = std::max(high, std::ilogb(x));
    }
  };
  const auto add_all = [&](const std::vector<Point_3>& points) {
    for (const Point_3& p : points)
      for (int i = 0; i < 3; ++i)
        add(p[i]);
  };
  for (const Triangle_soup* soup : {&world.soup, &world.obstacle}) {
    add_all(soup->points);
    for (const Pose& pose : soup->poses)
      add_all(pose.points);
  }
  add(world.weld_distance);
  add(world.dropped_parts.smaller_than);
  add(world.options.clearance.value_or(0));
  const bool is_rounded = world.prepare_options().round_to_float32;
  const int least = is_rounded ? -100 : -960, most = is_rounded ? 120 : 960;
  if (low > high || low < least || high > most)
    return std::nullopt;
  return random.between(least - low, most - high);
}

template <class Value>
std::vector<Value> reordered(const std::vector<Value>& values, const std::vector<Index>& order)
{
  std::vector<Value> result;
  for (std::size_t i = 0; i < std::min(order.size(), values.size()); ++i)
    result.push_back(values[order[i]]);
  return result;
}

void reorder(std::vector<Attribute>& attributes, const std::vector<Index>& order)
{
  for (Attribute& attribute : attributes) {
    const std::size_t size = row_size(attribute);
    std::vector<unsigned char> rows;
    for (const Index i : order)
      rows.insert(rows.end(), attribute.rows.begin() + i * size, attribute.rows.begin() + (i + 1) * size);
    attribute.rows = std::move(rows);
  }
}

std::vector<Index> random_order(std::size_t size, Random& random)
{
  std::vector<Index> order(size);
  std::iota(order.begin(), order.end(), Index(0));
  for (std::size_t i = size; i > 1; --i)
    std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

Triangle_soup permuted(Triangle_soup soup, Random& random)
{
  const std::vector<Index> vertices = random_order(soup.points.size(), random),
                           triangles = random_order(soup.triangles.size(), random);
  std::vector<Index> number(vertices.size());
  for (Index i = 0; i < vertices.size(); ++i)
    number[vertices[i]] = i;
  soup.points = reordered(soup.points, vertices);
  for (Pose& pose : soup.poses)
    pose.points = reordered(pose.points, vertices);
  reorder(soup.vertex_attributes, vertices);
  soup.triangles = reordered(soup.triangles, triangles);
  soup.polygons.clear();
  soup.uvs.of_triangle = reordered(soup.uvs.of_triangle, triangles);
  soup.normals.of_triangle = reordered(soup.normals.of_triangle, triangles);
  reorder(soup.triangle_attributes, triangles);
  for (auto* labels : {&soup.groups, &soup.objects, &soup.materials, &soup.smoothing_groups})
    labels->of_triangle = reordered(labels->of_triangle, triangles);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (Index& v : soup.triangles[t])
      v = number[v];
    const std::size_t first = random.below(3);
    for (auto* triple : {&soup.triangles, &soup.uvs.of_triangle, &soup.normals.of_triangle})
      if (!triple->empty())
        std::rotate((*triple)[t].begin(), (*triple)[t].begin() + first, (*triple)[t].end());
  }
  return soup;
}

Verdict judge_levels(const World& world, const World_run& run)
{
  const std::vector<Simplified_soup> levels =
      simplify_lods(run.prepared, world.options, world.lods, world.intent);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    World alone = world;
    alone.options.ratio = world.lods[i];
    alone.questions.reset(); // levels come from one run
    World_run level;
    level.result = levels[i];
    World_run run_alone = run_again(alone, run.prepared);
    run_alone.collapses.clear(); // levels of one run have no log
    if (auto broken =
            compare_bits(level, run_alone, "level " + std::to_string(i + 1) + " and a run to it alone"))
      return broken;
    if (levels[i].report.outcome() != run_alone.result.report.outcome())
      return Broken_promise{Promise::stop,
                            "level " + std::to_string(i + 1) + " has another outcome than a run to it alone"};
    if (!verify_guarded(world, levels[i], run.prepared).accepted())
      return Broken_promise{Promise::verdict, "level " + std::to_string(i + 1)};
  }
  return judge_file_of_levels(world, levels);
}

/// Cuts the world into pieces, reduces each by itself, and joins them: no pair of faces offends that did not,
/// and pieces that are not reduced are the world again.
Verdict judge_in_pieces(const World& world, Random& random)
{
  Triangle_soup whole;
  whole.points = world.soup.points;
  whole.triangles = world.soup.triangles;
  const Temporary_folder folder;
  write_mesh(folder / "whole.ply", whole);
  Cut_options cut_options;
  cut_options.cells = std::size_t(random.between(1, 5));
  cut_options.shift = random.one_in(2) ? 0.5 : 0;
  const Cut_mesh cut = cut_into_cells(folder / "whole.ply", cut_options,
                                      [&](std::size_t i) { return folder / (std::to_string(i) + ".ply"); });
  std::vector<Cell> cells;
  for (const Cell_piece& piece : cut.pieces)
    cells.push_back(piece.cell);
  Simplify_options options = world.options;
  options.ratio = 0;
  options.faces.reset();
  options.faces_per_cell = 0;
  options.guarded_poses.reset();
  options.placement = Placement::vertices;
  options.check_intersections = true;
  Simplify_intent intent;
  intent.kept = {std::string(fixed_property)};
  Prepare_options prepare_options;
  prepare_options.defects = Defects::freeze;
  prepare_options.orient = world.are_faces_oriented;

  Cell_join unchanged(cells), reduced(cells);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Triangle_soup piece = read_mesh(cut.pieces[i].file).soup;
    const std::string name = std::to_string(i + 1) + ".ply";
    unchanged.add(i, piece, piece, name, name);
    Triangle_soup result = piece;
    try {
      result = simplify_soup(prepare(piece, prepare_options), options, intent).soup;
    } catch (const Input_error&) { // no face has an area
    }
    reduced.add(i, piece, std::move(result), name, "reduced " + name);
  }
  const auto positions_of = [](const Triangle_soup& soup, Index triangle) {
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point_3& p = soup.points[soup.triangles[triangle][i]];
      corners[i] = {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
    }
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  const auto faces_of = [&](const Triangle_soup& soup) {
    std::multiset<std::array<std::array<double, 3>, 3>> faces;
    for (Index t = 0; t < soup.triangles.size(); ++t)
      faces.insert(positions_of(soup, t));
    return faces;
  };
  const auto pairs_of = [&](const Triangle_soup& soup) {
    std::set<std::set<std::array<std::array<double, 3>, 3>>> pairs;
    for (const auto& [a, b] : Judged_complex(soup, {}).offending_pairs())
      pairs.insert({positions_of(soup, a), positions_of(soup, b)});
    return pairs;
  };
  if (faces_of(unchanged.take()) != faces_of(whole))
    return Broken_promise{Promise::embedded, "pieces that are not reduced are not the whole"};
  const auto before = pairs_of(whole), after = pairs_of(reduced.take());
  if (!std::includes(before.begin(), before.end(), after.begin(), after.end()))
    return Broken_promise{Promise::embedded, "pieces that were reduced and joined have new offending pairs"};
  return std::nullopt;
}

// Returns by how much `distances_anywhere` may be off where nothing is: a millionth of the longest side of
// the bounding box, in any pose, as a share of the diagonal.
double measuring_error(const Triangle_soup& soup)
{
  const auto box_of = [&](const std::vector<Point_3>& points) {
    CGAL::Bbox_3 box;
    for (const Index_triple& triangle : soup.triangles)
      for (const Index v : triangle)
        box += points[v].bbox();
    return box;
  };
  const CGAL::Bbox_3 first = box_of(soup.points);
  double longest = 0;
  const auto see = [&](const CGAL::Bbox_3& box) {
    longest = std::max({longest, box.x_span(), box.y_span(), box.z_span()});
  };
  see(first);
  for (const Pose& pose : soup.poses)
    see(box_of(pose.points));
  const double diagonal = std::hypot(first.x_span(), first.y_span(), first.z_span());
  return 1e-6 * longest / (diagonal > 0 ? diagonal : 1);
}

// Reduces until the error is kept at every point.
Verdict judge_error_everywhere(const World& world, const World_run& run, Judgement_counts& counts,
                               const Judgement_extent& extent)
{
  const double wanted = *world.options.max_error;
  Error_search search(wanted);
  World twin = world;
  World_run again;
  double upper = 0;
  do {
    twin.options.max_error = search.max_error();
    again = run_again(twin, run.prepared);
    if (again.result.report.is_stopped)
      return std::nullopt;
    upper = distances_anywhere(again.result.soup, run.prepared.soup).larger().upper;
  } while (search.advance(upper));
  if (upper > wanted + measuring_error(run.prepared.soup))
    return Broken_promise{Promise::stop, "an error cannot be kept everywhere"};
  auto broken = judge(twin, test::run(twin), counts, {extent.is_replay_asked, 0});
  if (broken)
    broken->message += ", with an error that is kept everywhere";
  return broken;
}

// Reduces to more faces, which begins with the same collapses, and repeats these once more.
Verdict judge_reduction_to_more_faces(const World& world, const World_run& run, Random& random)
{
  World twin = world;
  const auto record = std::make_shared<internal::Collapse_record>();
  twin.options.record = record;
  if (auto broken = compare_bits(run_again(twin, run.prepared), run, "with a record of the collapses"))
    return broken;
  twin.options.record.reset();
  const Simplify_report& report = run.result.report;
  twin.options.least_faces = {std::size_t(random.between(int(report.faces_output), int(report.faces_input)))};
  const World_run shorter = run_again(twin, run.prepared);
  const bool is_one_share = world.intent.ratios.empty() && world.intent.kept.empty();
  const bool is_any_stopped = run.result.report.is_stopped || shorter.result.report.is_stopped;
  if (!is_one_share || world.options.faces_per_cell > 0 || is_any_stopped)
    return std::nullopt;
  if (shorter.collapses.size() > run.collapses.size() ||
      !std::equal(shorter.collapses.begin(), shorter.collapses.end(), run.collapses.begin()))
    return Broken_promise{Promise::determinism, "a reduction to more faces begins with other collapses"};
  twin.options.repeated = record;
  return compare_bits(run_again(twin, run.prepared), shorter, "repeated collapses");
}

// The report of a second reduction is one of the targets that were asked for.
Verdict judge_missed_report(const Simplify_report& first, const Simplified_soup& second)
{
  const Simplify_report& report = second.report;
  const auto broken = [](const char* what) {
    return Broken_promise{Promise::stop, std::string("a second reduction: ") + what};
  };
  std::size_t to_go = 0;
  for (std::size_t i = 0; i < report.shares.size(); ++i) {
    const Simplify_report::Share &now = report.shares[i], &before = first.shares[i];
    to_go += now.excess();
    if (now.target != before.target)
      return broken("another target");
    if (now.within_reach > 0 && (now.within_reach != before.output || now.output <= before.output))
      return broken("what is within reach");
    if (report.eased_border_turn && now.output < before.output)
      return broken("a part has fewer faces, with the turn of borders eased");
  }
  if (report.faces_target != first.faces_target || report.faces_to_go != to_go)
    return broken("another target, or distance to it");
  if (report.hindrances.total() != first.hindrances.total() || report.outcome() != first.outcome())
    return broken("it is held back by something else");
  if (second.held_by.size() != second.triangles.size())
    return broken("not every triangle is held by something");
  return std::nullopt;
}

// Misses a target, and reduces again as the program does: to more faces, where borders may turn by any angle.
Verdict judge_missed_target(const World& world, const World_run& run, Judgement_counts& counts,
                            const Judgement_extent& extent)
{
  Random random(world.seed + 12);
  World twin = world;
  twin.lods.clear();
  twin.questions.reset();
  Simplify_options& options = twin.options;
  options.ratio.reset();
  options.faces = 1;
  options.max_error = random.one_of({0.001, 0.01, 0.05, 0.2});
  options.max_border_turn = Simplify_options().max_border_turn;
  options.max_corner_height = 0;
  Missed_target missed(options);
  options = missed.options();
  const Simplified_soup first = run_again(twin, run.prepared).result;
  if (first.soup.triangles.empty())
    return std::nullopt;
  Distance flattened; // as if it were, which few worlds are
  flattened.maximum = *options.max_error;
  if (!missed.advance({{first, flattened, run.prepared}}))
    return std::nullopt;
  options = missed.options();
  World_run as_asked = run_again(twin, run.prepared);
  counts.options["repeated"] += bool(options.repeated);
  options.repeated.reset();
  const World_run second = test::run(twin);
  if (auto broken = compare_bits(as_asked, second, "a second reduction that repeats the first"))
    return broken;
  if (auto broken = judge(twin, second, counts, {extent.is_replay_asked, 0})) {
    broken->message += ", in a second reduction";
    return broken;
  }
  std::vector<Simplified_soup> completed{std::move(as_asked.result)};
  missed.complete(completed);
  ++counts.options[completed[0].report.eased_border_turn ? "eased_border_turn" : "second_reduction"];
  return judge_missed_report(first.report, completed[0]);
}

} // namespace

Verdict judge_twins(const World& world, const World_run& run, Judgement_counts& counts,
                    const Judgement_extent& extent)
{
  // Cells ask whether to stop at the same time: which of them gets the answer depends on the threads.
  const bool is_repeatable = world.options.faces_per_cell == 0 || !world.questions;
  if (run.refusal || !is_repeatable)
    return std::nullopt;
  Random random(world.seed + 1);
  const bool is_scene = bool(world.soup.scene);
  if (random.one_in(2)) {
    ++counts.twins;
    World twin = world;
    twin.options.index =
        world.options.index == Face_index::packed ? Face_index::clusters : Face_index::packed;
    twin.options.faces_per_cluster = std::size_t(random.between(1, 30));
    if (auto broken = compare_beginnings(run_again(twin, run.prepared), run, "the other index"))
      return broken;
  }
  if (world.options.faces_per_cell > 0 || random.one_in(8)) {
    ++counts.twins;
    World_run twin;
    const int threads = random.between(2, 5);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
    tbb::task_arena(threads).execute([&] { twin = run_again(world, run.prepared); });
    if (auto broken = compare_bits(twin, run, "more threads"))
      return broken;
  }
  if (random.one_in(4) && !is_scene && world.input_format != Mesh_format::stl) {
    ++counts.twins;
    const World twin = with_points(world, [&](double x) { return x == 0 && random.one_in(2) ? -x : x; });
    if (auto broken = compare(run_without_output(twin), run, "zeros of another sign"))
      return broken;
  }
  if (random.one_in(2) && !is_scene)
    if (const std::optional<int> exponent = random_exponent(world, random)) {
      ++counts.twins;
      World twin = with_points(world, [&](double x) { return std::ldexp(x, *exponent); });
      twin.weld_distance = std::ldexp(world.weld_distance, *exponent);
      twin.dropped_parts.smaller_than = std::ldexp(world.dropped_parts.smaller_than, *exponent);
      if (twin.options.clearance)
        twin.options.clearance = std::ldexp(*world.options.clearance, *exponent);
      if (auto broken = compare(run_without_output(twin), run,
                                "2^" + std::to_string(*exponent) + " times as large", *exponent))
        return broken;
    }
  if (random.one_in(4) && !is_scene && world.input_format != Mesh_format::stl) {
    ++counts.twins;
    World twin = world;
    twin.soup = permuted(world.soup, random);
    twin.obstacle = permuted(world.obstacle, random);
    if (auto broken = judge(twin, test::run(twin), counts, {extent.is_replay_asked, 0})) {
      broken->message += ", in another order";
      return broken;
    }
  }
  if (!world.lods.empty()) {
    ++counts.twins;
    if (auto broken = judge_levels(world, run))
      return broken;
  }
  const bool is_limited = world.options.max_error && *world.options.max_error > 0;
  if (is_limited && !world.options.guarded_poses && !run.result.soup.triangles.empty() && random.one_in(4)) {
    ++counts.twins;
    if (auto broken = judge_error_everywhere(world, run, counts, extent))
      return broken;
  }
  if (random.one_in(2)) {
    ++counts.twins;
    if (auto broken = judge_reduction_to_more_faces(world, run, random))
      return broken;
  }
  if (world.seed % 3 == 1) { // no random number, so that twins of earlier versions stay what they were
    ++counts.twins;
    if (auto broken = judge_missed_target(world, run, counts, extent))
      return broken;
  }
  if (random.one_in(8) && !is_scene && world.soup.poses.empty()) {
    ++counts.twins;
    return judge_in_pieces(world, random);
  }
  return std::nullopt;
}

} // namespace selvedge::test
