// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "html_report.h"

#include "html/page.h"
#include "text.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/internal/base64.h>

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace selvedge::app {
namespace {

constexpr std::size_t most_places = 100; // of each kind in the list
constexpr Index none = Index(-1);

// Flags of a face.
constexpr std::uint32_t is_frozen = 1, is_locked = 2, is_offending = 4;

std::string deflated(const std::string& bytes)
{
  uLongf size = ::compressBound(bytes.size());
  std::string packed(size, '\0');
  // It can fail for want of memory alone.
  if (::compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6) != Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  return packed;
}

// Neither `</script>` nor `<!--` can be in it: in JSON, < stands in strings alone.
std::string without_tags(const std::string& json)
{
  std::string text;
  text.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

const std::vector<Point_3>& points_in(const Triangle_soup& soup, std::size_t pose)
{
  return pose == 0 || soup.poses.empty() ? soup.points : soup.poses[pose - 1].points;
}

// Returns for every vertex one of those that are where it is, in all poses.
std::vector<Index> representatives(const Triangle_soup& soup)
{
  const auto is_before = [&](Index a, Index b) {
    if (soup.points[a] != soup.points[b])
      return soup.points[a] < soup.points[b];
    for (const Pose& pose : soup.poses)
      if (pose.points[a] != pose.points[b])
        return pose.points[a] < pose.points[b];
    return false;
  };
  std::vector<Index> order(soup.points.size()), result(soup.points.size());
  std::iota(order.begin(), order.end(), Index(0));
  std::sort(order.begin(), order.end(), is_before);
  for (std::size_t i = 0; i < order.size(); ++i)
    result[order[i]] = i > 0 && !is_before(order[i - 1], order[i]) ? result[order[i - 1]] : order[i];
  return result;
}

Json history_json(const Reduction_history& history)
{
  Json collapses = Json::array(), least = Json::array(), largest = Json::array(), refused = Json::array();
  for (const Reduction_history::Sample& sample : history.samples()) {
    collapses.push_back(sample.collapses);
    least.push_back(float(sample.least_cost));
    largest.push_back(float(sample.largest_cost));
  }
  for (const Refusals::Rule& rule : Refusals::rules()) {
    Json counts = Json::array();
    for (const Reduction_history::Sample& sample : history.samples())
      counts.push_back(sample.refused.*rule.count);
    if (!counts.empty() && counts.back() > 0)
      refused.push_back({{"rule", rule.name}, {"counts", std::move(counts)}});
  }
  return {{"collapses", std::move(collapses)},
          {"least", std::move(least)},
          {"largest", std::move(largest)},
          {"refused", std::move(refused)}};
}

// Points at infinity are as far as the farthest other ones.
double finite(double number)
{
  return std::isfinite(number) ? number : 0;
}

} // namespace

CLI::Option* add_html_option(CLI::App& command, std::string& file)
{
  return command
      .add_option(
          "--html", file,
          "Write a page that shows the mesh before and after, for a browser: one file, which needs no "
          "network.")
      ->type_name("FILE");
}

void require_html(const std::string& file)
{
  if (!file.empty() && html_page().empty())
    throw Argument_error("--html: this program was built without it; install what it needs (Debian's "
                         "libjs-three and esbuild) and build it again, or leave the option out");
}

Html_report::Html_report(const Triangle_soup& before, const Triangle_soup& beside)
    : m_before(before), m_beside(beside)
{
  for (const Triangle_soup* soup : {&before, &beside})
    for (std::size_t pose = 0; pose <= soup->poses.size(); ++pose)
      for (const Index_triple& triangle : soup->triangles)
        for (const Index v : triangle)
          m_box += points_in(*soup, pose)[v].bbox();
  Json extents = Json::array();
  // Halves, because the difference of two large coordinates may overflow.
  const auto half_span = [this](int axis) { return m_box.max(axis) / 2 - m_box.min(axis) / 2; };
  const double largest = std::max({half_span(0), half_span(1), half_span(2)});
  for (int axis = 0; axis < 3; ++axis)
    extents.push_back(largest > 0 ? half_span(axis) / largest : 0);
  m_scene = {{"extents", extents},         {"meshes", Json::array()}, {"levels", Json::array()},
             {"collapses", Json::array()}, {"places", Json::array()}, {"obstacle", nullptr},
             {"poses", Json::array()}};
  for (const Pose& pose : before.poses)
    m_scene["poses"].push_back(pose.name);
  for (const Hindrances::Description& description : Hindrances::descriptions())
    m_scene["reasons"].push_back(description.name);
  m_nodes = nodes_of(before);
  m_scene["meshes"].push_back(mesh_json(before, m_nodes));
  if (beside.triangles.empty())
    return;
  m_nodes_beside = nodes_of(beside);
  m_scene["meshes"].push_back(mesh_json(beside, m_nodes_beside));
}

std::uint32_t Html_report::quantised(double coordinate, int axis) const
{
  const double half_span = m_box.max(axis) / 2 - m_box.min(axis) / 2;
  const double share = half_span > 0 ? (coordinate / 2 - m_box.min(axis) / 2) / half_span : 0;
  return std::uint32_t(std::lround(65535 * std::clamp(share, 0.0, 1.0)));
}

// Differences of neighbours, so that small numbers are many, and their bytes by place: zlib packs such bytes
// to a third of what it makes of the numbers.
Json Html_report::section(const Numbers& numbers)
{
  const std::size_t begin = m_block.size(), count = numbers.size();
  m_block.resize(begin + 4 * count);
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t difference = numbers[i] - std::exchange(before, numbers[i]);
    const std::uint32_t folded = difference << 1 ^ (difference >> 31 ? 0xffffffffU : 0);
    for (std::size_t k = 0; k < 4; ++k)
      m_block[begin + k * count + i] = char(folded >> 8 * k & 255);
  }
  return {begin, count};
}

Html_report::Nodes Html_report::nodes_of(const Triangle_soup& soup) const
{
  const std::vector<Index> representative = representatives(soup);
  Nodes nodes;
  nodes.of_vertex.assign(soup.points.size(), none);
  for (const Index_triple& triangle : soup.triangles)
    for (const Index v : triangle) {
      Index& node = nodes.of_vertex[representative[v]];
      if (node != none)
        continue;
      node = Index(nodes.size());
      for (int axis = 0; axis < 3; ++axis)
        nodes.coordinates.push_back(quantised(soup.points[v][axis], axis));
    }
  for (Index v = 0; v < representative.size(); ++v)
    nodes.of_vertex[v] = nodes.of_vertex[representative[v]];
  return nodes;
}

Json Html_report::poses_json(const Triangle_soup& soup, const Nodes& nodes)
{
  Json poses = Json::array();
  for (const Pose& pose : soup.poses) {
    Numbers coordinates(3 * nodes.size());
    for (Index v = 0; v < pose.points.size(); ++v)
      for (int axis = 0; axis < 3 && nodes.of_vertex[v] != none; ++axis)
        coordinates[3 * nodes.of_vertex[v] + Index(axis)] = quantised(pose.points[v][axis], axis);
    poses.push_back(section(coordinates));
  }
  return poses;
}

Json Html_report::uv_json(const Triangle_soup& soup)
{
  if (soup.uvs.empty())
    return nullptr;
  // In 1/65536 of a tile, with two's complement for those below 0.
  Numbers values, corners;
  for (const auto& value : soup.uvs.values)
    for (const double number : value)
      values.push_back(std::uint32_t(std::int64_t(std::clamp(number, -30000.0, 30000.0) * 65536)));
  for (const Index_triple& triangle : soup.uvs.of_triangle)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  return {{"values", section(values)}, {"corners", section(corners)}};
}

Json Html_report::mesh_json(const Triangle_soup& soup, const Nodes& nodes)
{
  Numbers corners;
  corners.reserve(3 * soup.triangles.size());
  for (const Index_triple& triangle : soup.triangles)
    for (const Index v : triangle)
      corners.push_back(nodes.of_vertex[v]);
  Json kinds = Json::array();
  for (const Part_kind& kind : part_kinds(soup))
    kinds.push_back({{"kind", name(kind.name)},
                     {"names", kind.names},
                     {"count", kind.count},
                     {"of_triangle", section(kind.of_triangle)}});
  return {{"points", section(nodes.coordinates)},
          {"corners", section(corners)},
          {"poses", poses_json(soup, nodes)},
          {"kinds", std::move(kinds)},
          {"uv", uv_json(soup)},
          {"flags", nullptr}};
}

void Html_report::add_input(const Prepared_soup& prepared, const std::vector<std::string>& locked_parts)
{
  if (!m_beside.triangles.empty())
    m_scene["obstacle"] = 1;
  Numbers flags(m_before.triangles.size());
  for (std::size_t t = 0; t < flags.size(); ++t)
    flags[t] = prepared.is_frozen[t] ? is_frozen : 0;
  for (const std::string& part : locked_parts) {
    const std::vector<char> is_named = triangles_named(m_before, part);
    for (std::size_t t = 0; t < flags.size(); ++t)
      flags[t] |= is_named[t] ? is_locked : 0;
  }
  for (const Offending_pair& pair : prepared.offending_pairs)
    for (const Index t : {pair.first, pair.second})
      if (t < flags.size())
        flags[t] |= is_offending;
  m_scene["meshes"][0]["flags"] = section(flags);
  add_pairs("Offending pairs of the input", false, prepared.offending_pairs, m_before, 0);
  for (std::size_t i = 0; i < prepared.offending_pairs_in_poses.size(); ++i)
    add_pairs("Offending pairs of the input", false, prepared.offending_pairs_in_poses[i], m_before, i + 1);
}

std::size_t Html_report::add_collapses(const std::vector<Soup_collapse>& collapses)
{
  // By which node the vertices at a position are known after what has moved there.
  std::vector<Index> into(m_nodes.size());
  std::iota(into.begin(), into.end(), Index(0));
  const auto node_now = [&](std::size_t vertex) {
    Index node = m_nodes.of_vertex[vertex];
    if (node == none) // no triangle moves with it
      return Index(0);
    while (into[node] != node)
      node = into[node] = into[into[node]];
    return node;
  };
  Numbers removed, kept, placed, places;
  for (std::size_t i = 0; i < collapses.size(); ++i) {
    const Index from = node_now(collapses[i].removed), to = node_now(collapses[i].kept);
    if (!into.empty())
      into[from] = to;
    removed.push_back(from);
    kept.push_back(to);
    if (!collapses[i].place)
      continue;
    placed.push_back(std::uint32_t(i));
    for (int axis = 0; axis < 3; ++axis)
      places.push_back(quantised((*collapses[i].place)[std::size_t(axis)], axis));
  }
  m_scene["collapses"].push_back({{"removed", section(removed)},
                                  {"kept", section(kept)},
                                  {"placed", section(placed)},
                                  {"places", section(places)}});
  return m_scene["collapses"].size() - 1;
}

Json Html_report::distances_json(const std::vector<double>& distances, const Nodes& nodes, double largest)
{
  Numbers shares(nodes.size());
  for (std::size_t v = 0; v < distances.size(); ++v)
    if (nodes.of_vertex[v] != none && largest > 0)
      shares[nodes.of_vertex[v]] = std::uint32_t(std::lround(65535 * finite(distances[v] / largest)));
  return section(shares);
}

void Html_report::add_level(const std::string& name, const Simplified_soup& result,
                            const Verification& verification, std::size_t collapses, std::size_t steps)
{
  const std::vector<double> distances = vertex_distances(m_before, result.soup);
  const double largest =
      distances.empty() ? 0 : finite(*std::max_element(distances.begin(), distances.end()));
  Numbers held_by;
  for (const Hindrance reason : result.held_by)
    held_by.push_back(std::uint32_t(reason));
  m_scene["levels"].push_back({{"name", name},
                               {"mesh", 0},
                               {"collapses", collapses},
                               {"steps", steps},
                               {"faces", result.soup.triangles.size()},
                               {"triangles", section(result.triangles)},
                               {"held_by", section(held_by)},
                               {"uv", uv_json(result.soup)},
                               {"largest", largest},
                               {"distances", distances_json(distances, m_nodes, largest)},
                               {"history", history_json(result.history)}});
  add_new_pairs(verification, result.soup);
  add_deviations("Farthest from the result", m_before, distances);
}

void Html_report::add_replay(const std::string& name, const Replay_verdict& verdict, std::size_t collapses)
{
  const std::vector<double> distances = vertex_distances(m_before, verdict.soup);
  const double largest =
      distances.empty() ? 0 : finite(*std::max_element(distances.begin(), distances.end()));
  m_scene["levels"].push_back({{"name", name},
                               {"mesh", 0},
                               {"collapses", collapses},
                               {"steps", verdict.steps},
                               {"faces", verdict.soup.triangles.size()},
                               {"largest", largest},
                               {"distances", distances_json(distances, m_nodes, largest)}});
}

void Html_report::add_violations(const std::vector<Violation>& violations, std::size_t pose)
{
  Json list = Json::array();
  for (std::size_t i = 0; i < (std::min)(violations.size(), most_places); ++i) {
    const Violation& violation = violations[i];
    const std::string where =
        violation.step > 0 ? "step " + with_commas(violation.step) + ": " : std::string("the result: ");
    list.push_back(
        {{"text", where + violation.message}, {"step", violation.step}, {"triangles", violation.triangles}});
  }
  add_places("Refused steps", true, violations.size(), std::move(list), pose);
}

void Html_report::add_result(const std::string& name, const Verification& verification)
{
  if (m_beside.triangles.empty()) {
    add_pairs("Offending pairs", true, verification.pairs, m_before, 0);
    for (std::size_t i = 0; i < verification.poses.size(); ++i)
      add_pairs("Offending pairs", true, verification.poses[i].pairs, m_before, i + 1);
    return;
  }
  const std::vector<double> before = vertex_distances(m_before, m_beside),
                            after = vertex_distances(m_beside, m_before);
  double largest = 0;
  for (const auto* distances : {&before, &after})
    for (const double distance : *distances)
      largest = (std::max)(largest, finite(distance));
  m_scene["levels"].push_back({{"name", name},
                               {"mesh", 1},
                               {"faces", m_beside.triangles.size()},
                               {"largest", largest},
                               {"distances", distances_json(before, m_nodes, largest)},
                               {"distances_after", distances_json(after, m_nodes_beside, largest)}});
  add_new_pairs(verification, m_beside);
  add_deviations("Farthest from the result", m_before, before);
  add_deviations("Farthest from the original", m_beside, after);
}

Json Html_report::place_json(const std::vector<Point_3>& corners, const std::string& text) const
{
  Json place = {{"text", text}};
  for (const Point_3& point : corners) {
    Json& corner = place["corners"].emplace_back(Json::array());
    for (int axis = 0; axis < 3; ++axis)
      corner.push_back(quantised(point[axis], axis));
  }
  return place;
}

// Places belong to the level that was added last; without one, they are those of the mesh before.
void Html_report::add_places(const std::string& heading, bool is_fault, std::size_t count, Json list,
                             std::size_t pose)
{
  if (list.empty())
    return;
  const std::size_t levels = m_scene["levels"].size();
  m_scene["places"].push_back({{"heading", heading},
                               {"is_fault", is_fault},
                               {"count", count},
                               {"pose", pose},
                               {"level", levels > 0 ? Json(levels - 1) : Json(nullptr)},
                               {"list", std::move(list)}});
}

void Html_report::add_new_pairs(const Verification& verification, const Triangle_soup& result)
{
  const char* const heading = "Pairs that offend only in the result";
  add_pairs(heading, true, verification.new_pairs, result, 0);
  for (std::size_t i = 0; i < verification.poses.size(); ++i)
    add_pairs(heading, true, verification.poses[i].new_pairs, result, i + 1);
}

void Html_report::add_pairs(const std::string& heading, bool is_fault,
                            const std::vector<Offending_pair>& pairs, const Triangle_soup& soup,
                            std::size_t pose)
{
  Json list = Json::array();
  for (std::size_t i = 0; i < (std::min)(pairs.size(), most_places); ++i) {
    std::vector<Point_3> corners;
    for (const std::size_t t : {pairs[i].first, pairs[i].second}) {
      // Triangles of an obstacle come after those of the soup.
      const bool is_own = t < soup.triangles.size();
      const Triangle_soup& owner = is_own ? soup : m_beside;
      for (const Index v : owner.triangles[is_own ? t : t - soup.triangles.size()])
        corners.push_back(points_in(owner, pose)[v]);
    }
    list.push_back(place_json(corners, describe(pairs[i], soup.triangles.size())));
  }
  add_places(heading, is_fault, pairs.size(), std::move(list), pose);
}

void Html_report::add_deviations(const std::string& heading, const Triangle_soup& soup,
                                 const std::vector<double>& distances)
{
  constexpr std::size_t most_deviations = 12;
  std::vector<Index> order(distances.size());
  std::iota(order.begin(), order.end(), Index(0));
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return distances[a] > distances[b]; });
  // Places of their own, rather than the neighbours of the worst.
  const double apart = 65535 * 0.04;
  std::vector<std::array<double, 3>> taken;
  Json list = Json::array();
  for (const Index v : order) {
    if (!(distances[v] > 0) || taken.size() == most_deviations)
      break;
    std::array<double, 3> at;
    for (int axis = 0; axis < 3; ++axis)
      at[std::size_t(axis)] = quantised(soup.points[v][axis], axis);
    if (std::any_of(taken.begin(), taken.end(), [&](const auto& other) {
          return std::hypot(at[0] - other[0], at[1] - other[1], at[2] - other[2]) < apart;
        }))
      continue;
    taken.push_back(at);
    list.push_back(place_json({soup.points[v]}, "vertex " + std::to_string(v + 1) + ": " +
                                                    with_digits(distances[v]) + " away"));
  }
  const std::size_t count = list.size();
  add_places(heading, false, count, std::move(list), 0);
}

std::string Html_report::page(const Json& report) const
{
  std::string text(html_page());
  const auto put = [&](const std::string& mark, const std::string& contents) {
    text.replace(text.find(mark), mark.size(), contents);
  };
  put("[[report]]", without_tags(to_text(report)));
  put("[[scene]]", without_tags(to_text(m_scene)));
  put("[[block]]", internal::base64(deflated(m_block)));
  return text;
}

} // namespace selvedge::app
