// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report_json.h"

#include "text.h"

#include <selvedge/part_report.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <sys/resource.h>

namespace selvedge::app {
namespace {

constexpr std::size_t most_named = 100;

Json to_json(const Distance& distance)
{
  return {{"rms", distance.root_mean_square}, {"max", distance.maximum}};
}

Json to_json(const Refusals& refused)
{
  Json json;
  for (const Refusals::Rule& rule : Refusals::rules())
    json[rule.key] = refused.*rule.count;
  return json;
}

Json to_json(const std::optional<Uv_deviation>& deviation)
{
  return deviation ? Json{{"mean", deviation->mean}, {"max", deviation->maximum}} : Json(nullptr);
}

Json to_json(const Line_distance& distance)
{
  return {{"rms", distance.of_ends.root_mean_square},
          {"max", distance.of_ends.maximum},
          {"max_lower", distance.maximum.lower},
          {"max_upper", distance.maximum.upper}};
}

Json to_json(const Line_comparison& lines)
{
  return {{"edges_of_original", lines.edges_of_original},
          {"edges_of_result", lines.edges_of_result},
          {"original_to_result", to_json(lines.original_to_result)},
          {"result_to_original", to_json(lines.result_to_original)}};
}

Json first_of(const std::vector<Offending_pair>& pairs)
{
  Json list = Json::array();
  for (std::size_t i = 0; i < (std::min)(pairs.size(), most_named); ++i)
    list.push_back({{"first", pairs[i].first + 1},
                    {"second", pairs[i].second + 1},
                    {"offence", name(pairs[i].offence)}});
  return list;
}

Json to_json(const Reduction_limits& limits)
{
  Json object = Json::object();
  for (const Limit_description& limit : limit_descriptions)
    object[limit.key] = or_null(limits.*limit.value);
  return object;
}

Json to_json(const Violation& violation)
{
  Json triangles = Json::array();
  for (const Index triangle : violation.triangles)
    triangles.push_back(triangle + 1);
  return {{"kind", name(violation.kind)}, {"step", violation.step},
          {"line", violation.line},       {"removed", violation.removed},
          {"kept", violation.kept},       {"triangles", std::move(triangles)},
          {"message", violation.message}, {"point", or_null(violation.point)}};
}

Json to_json(const Bounds& bounds)
{
  return {{"lower", bounds.lower}, {"upper", bounds.upper}};
}

Json to_json(const std::optional<Clearance_verdict>& verdict)
{
  if (!verdict)
    return nullptr;
  const bool has_original = verdict->least_of_original.has_value();
  Json nearest = Json::array();
  for (std::size_t i = 0; i < (std::min)(verdict->near.size(), most_named); ++i) {
    const Near_pieces& pair = verdict->near[i];
    nearest.push_back({{"first", pair.first + 1},
                       {"second", pair.second + 1},
                       {"now", to_json(pair.now)},
                       {"before", has_original ? to_json(pair.before) : Json(nullptr)},
                       {"too_near", pair.is_too_near}});
  }
  return {{"distance", verdict->clearance},
          {"near", verdict->near.size()},
          {"too_near", verdict->too_near()},
          {"least", to_json(verdict->least)},
          {"least_of_original", has_original ? to_json(*verdict->least_of_original) : Json(nullptr)},
          {"nearest", std::move(nearest)}};
}

Json counted_from_1(const std::vector<Index>& numbers)
{
  Json list = Json::array();
  for (const Index number : numbers)
    list.push_back(number + 1);
  return list;
}

// Soups may have as many pieces as triangles; kinds are few.
Json kinds_of(const std::vector<Piece>& pieces)
{
  struct Kind
  {
    std::size_t pieces = 0;
    std::size_t faces = 0;
  };
  std::map<std::pair<std::size_t, long>, Kind> kinds;
  for (const Piece& piece : pieces) {
    Kind& kind = kinds[{piece.boundary_loops, piece.euler_characteristic}];
    ++kind.pieces;
    kind.faces += piece.faces;
  }
  Json list = Json::array();
  for (const auto& [key, kind] : kinds)
    list.push_back({{"boundary_loops", key.first},
                    {"euler_characteristic", key.second},
                    {"pieces", kind.pieces},
                    {"faces", kind.faces}});
  return list;
}

} // namespace

Json new_report(const std::string& command)
{
  return {{"schema", 1}, {"version", SELVEDGE_VERSION}, {"command", command}};
}

Json input_json(const std::filesystem::path& path, const Mesh_file& file)
{
  return {{"path", path.string()},
          {"vertices", file.soup.points.size()},
          {"triangles", file.soup.triangles.size()},
          {"notes", describe(file.notes)}};
}

Json border_gaps_json(const Border_gaps& gaps)
{
  const std::vector<double>& lengths = gaps.lengths;
  const auto within = [&](double share) {
    return lengths.empty() ? Json(nullptr) : Json(lengths[std::size_t(share * double(lengths.size() - 1))]);
  };
  return {{"border_vertices", gaps.border_vertices},
          {"limit", gaps.limit},
          {"partnered", lengths.size()},
          {"half_within", within(0.5)},
          {"most_within", within(0.9)},
          {"all_within", within(1)},
          {"clear_length", or_null(gaps.clear_length)},
          {"within_clear_length", gaps.within_clear_length},
          {"clear_length_to_edges", or_null(gaps.clear_length_to_edges)},
          {"within_clear_length_to_edges", gaps.within_clear_length_to_edges}};
}

void add_reduction(Json& report, const Prepared_soup& prepared, const Simplified_soup& result)
{
  const Simplify_report& done = result.report;
  report["faces"] = {{"input", prepared.soup.triangles.size()},
                     {"output", result.soup.triangles.size()},
                     {"fixed", done.faces_fixed},
                     {"target", done.faces_target}};
  report["target"] = {
      {"reached", done.is_reached()},
      {"outcome", done.outcome()},
      {"within_reach", done.faces_within_reach == 0 ? Json(nullptr) : Json(done.faces_within_reach)},
      {"eased_border_turn", done.eased_border_turn ? Json(*done.eased_border_turn) : Json(nullptr)}};
  Json hindrances;
  for (const Hindrances::Description& description : Hindrances::descriptions())
    hindrances[description.key] = done.hindrances[description.reason];
  report["hindrances"] = std::move(hindrances);
  report["vertices"] = {{"kept", result.soup.points.size() - result.placed_vertices},
                        {"placed", result.placed_vertices},
                        {"fitted_texture", result.fitted_texture},
                        {"fitted_attributes", result.fitted_attributes}};
  report["corners"] = {{"mended_normals", result.mended_normals}, {"fitted_normals", result.fitted_normals}};
  report["collapses"] = done.collapses;
  report["passes"] = done.passes;
  report["instances"] = {{"meshes", result.shared_meshes},
                         {"places", result.shared_places},
                         {"apart", result.apart_meshes},
                         {"refused_elsewhere", done.refused_elsewhere}};
  report["cells"] = {{"count", done.cells}, {"collapses", done.collapses_in_cells}};
  report["refused"] = to_json(done.refused);
  report["frozen"] = {{"faces", prepared.frozen_faces},
                      {"pairs", prepared.offending_pairs.size()},
                      {"doubles", prepared.doubles()}};
  const Index_statistics& index = done.index;
  const Intersection_statistics& guard = done.intersections;
  report["index"] = {{"clusters", index.clusters},
                     {"queries", index.queries},
                     {"faces_visited", index.visits},
                     {"cluster_rebuilds", index.cluster_rebuilds},
                     {"top_rebuilds", index.top_rebuilds},
                     {"motions_judged", guard.motions_judged},
                     {"stars_clear_by_view", guard.stars_clear_by_view},
                     {"faces_near", guard.faces_near},
                     {"faces_clear_in_packs", guard.faces_clear_in_packs},
                     {"faces_clear_by_box", guard.faces_clear_by_box},
                     {"faces_clear_by_view", guard.faces_clear_by_view},
                     {"pairs_clear_by_view", guard.pairs_clear_by_view},
                     {"sweeps_tested", guard.sweeps_tested},
                     {"refused_by_link", guard.refused_by_link},
                     {"refused_by_star", guard.refused_by_star},
                     {"refused_by_sweep", guard.refused_by_sweep},
                     {"refused_by_clearance", guard.refused_by_clearance},
                     {"refused_by_descent", guard.refused_by_descent}};
  const Sewing_notes& welding = result.sewing;
  report["welding"] = {{"unused_vertices", welding.unused_vertices},
                       {"welded_vertices", welding.coincident_vertices},
                       {"seam_edges", welding.seam_edges},
                       {"non_manifold_edges", welding.non_manifold_edges},
                       {"turned_faces", prepared.turned_faces()},
                       {"misoriented_edges", welding.misoriented_edges},
                       {"misoriented_pieces", welding.misoriented_pieces},
                       {"unwelded_positions", welding.unsewn_positions},
                       {"left_out_faces", prepared.left_out_faces},
                       {"left_out_faces_that_open", prepared.left_out_faces_that_open}};
  const Snapping_notes& snap = prepared.snapping;
  report["border_gaps"] = border_gaps_json(prepared.border_gaps);
  report["snap"] = {{"distance", snap.distance},
                    {"border_vertices", snap.border_vertices},
                    {"partnered", snap.partnered},
                    {"sewn", snap.snapped},
                    {"left_ambiguous", snap.left_ambiguous},
                    {"left_frozen", snap.left_frozen},
                    {"left_unmanifold", snap.left_unmanifold},
                    {"left_folding", snap.left_folding},
                    {"left_blocked", snap.left_blocked},
                    {"near_without_edge", snap.near_without_edge},
                    {"motions", snap.snaps.size()},
                    {"seam_edges", snap.seam_edges},
                    {"largest_distance", snap.largest_distance},
                    {"tied", prepared.tied.size()},
                    {"untied", result.untied_pairs},
                    {"facing", prepared.facing.size()},
                    {"left_alone", done.left_alone}};
  report["rounding"] = {{"coordinates", prepared.rounding.coordinates},
                        {"vertices", prepared.rounding.vertices},
                        {"pairs", prepared.pairs_by_rounding},
                        {"left_out_faces", prepared.left_out_by_rounding}};
}

void add_guarded_poses(Json& report, const std::vector<std::size_t>& guarded, const Simplified_soup& result)
{
  Json& poses = report["verified"]["poses"];
  for (Json& pose : poses) {
    pose["guarded"] = false;
    pose["refused"] = 0;
  }
  for (std::size_t i = 0; i < guarded.size(); ++i) {
    poses[guarded[i]]["guarded"] = true;
    poses[guarded[i]]["refused"] = result.report.refused_in_poses[i];
  }
}

void add_verification(Json& report, const Verification& verification, bool has_original)
{
  report["verified"] = {{"embedded", verification.embedded()},
                        {"pairs", verification.pairs.size()},
                        {"new_pairs", verification.new_pairs.size()},
                        {"first_new_pairs", first_of(verification.new_pairs)}};
  Json permitted = Json::array();
  for (const Verification::Permitted& parts : verification.permitted) {
    permitted.push_back({{"first", parts.first}, {"second", parts.second}, {"pairs", parts.pairs}});
    if (has_original)
      permitted.back()["pairs_of_original"] = parts.pairs_of_original;
  }
  report["verified"]["permitted"] = std::move(permitted);
  report["verified"]["clearance"] = to_json(verification.clearance);
  if (has_original)
    report["verified"]["pairs_of_original"] = verification.pairs_of_original;
  Json poses = Json::array();
  for (const Verification::In_pose& pose : verification.poses) {
    poses.push_back(
        {{"name", pose.name}, {"pairs", pose.pairs.size()}, {"new_pairs", pose.new_pairs.size()}});
    if (has_original)
      poses.back()["pairs_of_original"] = pose.pairs_of_original;
    poses.back()["clearance"] = to_json(pose.clearance);
  }
  report["verified"]["poses"] = std::move(poses);
  report["pieces"] = {{"count", verification.pieces.size()}, {"kinds", kinds_of(verification.pieces)}};
  if (!has_original)
    return;
  Json differences = Json::array();
  for (const Topology_difference& difference : verification.topology_differences)
    differences.push_back({{"boundary_loops", difference.boundary_loops},
                           {"euler_characteristic", difference.euler_characteristic},
                           {"pieces_of_original", difference.pieces_of_original},
                           {"pieces_of_result", difference.pieces_of_result}});
  report["topology"] = {{"same", verification.same_topology()}, {"differences", std::move(differences)}};
  const Piece_matching& matching = verification.matching;
  Json pieces = Json::object(), mismatches = Json::array();
  for (const Matched_by by : {Matched_by::vertices, Matched_by::positions, Matched_by::borders,
                              Matched_by::distance, Matched_by::triangles})
    pieces[name(by)] = 0;
  for (const Piece_match& match : matching.matches)
    pieces[name(match.by)] = pieces[name(match.by)].get<std::size_t>() + match.of_original.size();
  for (std::size_t i = 0; i < (std::min)(matching.mismatches.size(), most_named); ++i) {
    const Piece_mismatch& mismatch = matching.mismatches[i];
    mismatches.push_back({{"what", name(mismatch.what)},
                          {"of_original", counted_from_1(mismatch.of_original)},
                          {"of_result", counted_from_1(mismatch.of_result)},
                          {"message", mismatch.message}});
  }
  report["matching"] = {{"complete", matching.is_complete()},
                        {"pieces_of_original", matching.pieces_of_original.size()},
                        {"by", std::move(pieces)},
                        {"mismatches", matching.mismatches.size()},
                        {"first_mismatches", std::move(mismatches)},
                        {"names_compared", matching.names_compared}};
  if (verification.distances)
    report["distance"] = {{"original_to_result", to_json(verification.distances->original_to_result)},
                          {"result_to_original", to_json(verification.distances->result_to_original)},
                          {"diagonal", verification.distances->diagonal}};
}

void add_distances(Json& report, const Verification& verification,
                   const std::optional<Distances_anywhere>& distances)
{
  const auto add_bounds = [&](const char* way, Bounds_over_poses Distances_anywhere::*of_way) {
    Json& distance = report["distance"][way];
    for (const char* key : {"max_lower", "max_upper", "max_pose"})
      distance[key] = nullptr;
    if (!distances)
      return;
    const Bounds_over_poses& bounds = (*distances).*of_way;
    distance["max_lower"] = bounds.lower;
    distance["max_upper"] = bounds.upper;
    if (bounds.pose)
      distance["max_pose"] = verification.poses[*bounds.pose].name;
  };
  add_bounds("original_to_result", &Distances_anywhere::original_to_result);
  add_bounds("result_to_original", &Distances_anywhere::result_to_original);
}

void add_error_search(Json& report, const std::optional<Error_search>& search)
{
  report["error_search"] = nullptr;
  if (search)
    report["error_search"] = {{"reductions", search->reductions()}, {"error", search->max_error()}};
}

void Phase_seconds::add(const Prepared_soup& prepared, const std::vector<const Simplified_soup*>& results)
{
  // When one run passes through all levels, the last one has the time of all.
  const auto longest = [&](const auto& seconds_of) {
    double most = 0;
    for (const Simplified_soup* result : results)
      most = std::max(most, seconds_of(*result));
    return most;
  };
  m_seconds["check"] = prepared.seconds_check;
  m_seconds["snap"] = prepared.seconds_snap;
  m_seconds["weld"] =
      prepared.seconds_positions + longest([](const Simplified_soup& result) { return result.seconds_sew; });
  m_seconds["index"] += longest([](const Simplified_soup& result) { return result.report.seconds_index; });
  m_seconds["cells"] += longest([](const Simplified_soup& result) { return result.report.seconds_cells; });
  m_seconds["reduce"] += longest([](const Simplified_soup& result) { return result.report.seconds_reduce; });
}

Json Phase_seconds::json(const std::vector<std::string>& phases) const
{
  Json json = Json::object();
  for (const std::string& phase : phases) {
    const auto found = m_seconds.find(phase);
    json[phase] = found == m_seconds.end() ? 0.0 : found->second;
  }
  return json;
}

void add_comparison(Json& report, const Verification& verification, const Comparison& comparison)
{
  add_distances(report, verification, comparison.distances);
  report["borders"] = to_json(comparison.borders);
  report["seams"] = to_json(comparison.seams);
  report["gaps"] = {{"open_edges", comparison.gaps.open_edges},
                    {"length", comparison.gaps.length},
                    {"width", comparison.gaps.width}};
  report["vertices"] = {{"count", comparison.vertices},
                        {"original", comparison.original_vertices},
                        {"share", comparison.share_of_original_vertices()}};
  Json kept = Json::array();
  for (const Kept_attribute& attribute : comparison.attributes)
    kept.push_back({{"name", attribute.name},
                    {"combinations", attribute.combinations},
                    {"at_new_places", attribute.at_new_places},
                    {"original", attribute.original}});
  report["attributes"] = {{"kept", std::move(kept)}, {"lost", comparison.lost_attributes}};
  const Normal_deviation& normals = comparison.normals;
  report["normals"] = {{"samples", normals.samples},
                       {"mean", normals.mean},
                       {"rms", normals.root_mean_square},
                       {"max", normals.maximum},
                       {"turned", normals.turned}};
  const Layer_order& layers = comparison.layers;
  Json swaps = Json::array();
  for (std::size_t i = 0; i < (std::min)(layers.swaps.size(), most_named); ++i) {
    const Layer_swap& swap = layers.swaps[i];
    swaps.push_back({{"point", {swap.point.x(), swap.point.y(), swap.point.z()}},
                     {"of_original", {swap.of_original[0] + 1, swap.of_original[1] + 1}},
                     {"of_result", {swap.of_result[0] + 1, swap.of_result[1] + 1}}});
  }
  report["layers"] = {{"lines", layers.lines},
                      {"crossing", layers.crossing},
                      {"pairs", layers.pairs},
                      {"compared", layers.compared},
                      {"lines_compared", layers.lines_compared},
                      {"swaps", layers.swaps.size()},
                      {"without_order", layers.without_order},
                      {"first_swaps", std::move(swaps)}};
}

void add_parts(Json& report, const Prepared_soup& prepared, const Simplified_soup& result)
{
  Json list = Json::array();
  const Part_reports reports = part_reports(result, prepared);
  for (const Part_report& part : reports.parts) {
    Json refused = to_json(part.refused);
    refused.erase("by_loop"); // known of all together only
    list.push_back({{"kind", name(part.kind)},
                    {"name", part.name},
                    {"first_triangle", part.first_triangle + 1},
                    {"faces", {{"input", part.faces_input}, {"output", part.faces_output}}},
                    {"refused", std::move(refused)},
                    {"distance", to_json(part.distance)},
                    {"uv", to_json(part.uv_deviation)}});
  }
  report["parts"] = std::move(list);
  report["uv"] = to_json(reports.uv_deviation);
}

std::map<std::string, std::size_t> count_by_kind(const std::vector<Violation>& violations)
{
  std::map<std::string, std::size_t> counts;
  for (const Violation& violation : violations)
    ++counts[name(violation.kind)];
  return counts;
}

void add_replay(Json& report, const Replay_verdict& verdict)
{
  report["verdict"] = verdict.is_accepted()        ? "accepted"
                      : verdict.violations.empty() ? "interrupted"
                                                   : "refused";
  Json open = Json::array();
  for (const Not_judged& part : not_judged(verdict))
    open.push_back({{"key", part.key}, {"sentence", part.sentence}});
  Json may_intersect = Json::array();
  for (const auto& [a, b] : verdict.header.may_intersect)
    may_intersect.push_back(Json::array({a, b}));
  report["terms"] = {{"limits_of", name(verdict.limits_source)},
                     {"limits", to_json(verdict.limits)},
                     {"declared", to_json(verdict.header.limits)},
                     {"input_bound", verdict.is_input_stated},
                     {"result_bound", verdict.is_result_stated},
                     {"obstacle_judged", verdict.is_obstacle_judged},
                     {"obstacle_bound", verdict.is_obstacle_stated},
                     {"rounding", verdict.header.is_rounded_to_float32 ? "float32" : "none"},
                     {"may_intersect", std::move(may_intersect)},
                     {"not_judged", std::move(open)}};
  report["steps"] = {{"taken", verdict.steps}, {"snaps", verdict.snaps}, {"collapses", verdict.collapses}};
  report["faces"] = {{"output", verdict.soup.triangles.size()}};
  report["frozen"] = {{"pairs", verdict.offending_pairs}, {"may_descend", verdict.header.may_pairs_descend}};
  report["snap"] = {{"largest_distance", verdict.largest_snap},
                    {"largest_way", verdict.largest_way_of_snaps}};
  Json kinds = Json::array(), first = Json::array();
  for (const auto& [kind, count] : count_by_kind(verdict.violations))
    kinds.push_back({{"kind", kind}, {"count", count}});
  for (std::size_t i = 0; i < (std::min)(verdict.violations.size(), most_named); ++i)
    first.push_back(to_json(verdict.violations[i]));
  report["violations"] = {
      {"count", verdict.violations.size()}, {"kinds", std::move(kinds)}, {"first", std::move(first)}};
  report["pairs"] = {{"judged", verdict.pairs_judged}, {"in_rationals", verdict.pairs_judged_in_rationals}};
  report["seconds"] = {{"check", verdict.seconds_prepare}, {"steps", verdict.seconds_steps}};
}

std::size_t peak_memory_bytes()
{
  rusage usage = {};
  ::getrusage(RUSAGE_SELF, &usage);
  return std::size_t(usage.ru_maxrss) * 1024;
}

std::string to_text(const Json& report)
{
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace selvedge::app
