// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "advice.h"

#include "text.h"

#include <selvedge/attributes.h>
#include <selvedge/inspect.h>
#include <selvedge/normals.h>
#include <selvedge/suited_normals.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace selvedge::app {
namespace {

/// Returns the reasons that hold edges back, those of most edges first.
std::vector<Hindrances::Description> reasons(const Hindrances& hindrances)
{
  std::vector<Hindrances::Description> reasons;
  for (const Hindrances::Description& description : Hindrances::descriptions())
    if (hindrances[description.reason] > 0)
      reasons.push_back(description);
  std::stable_sort(reasons.begin(), reasons.end(),
                   [&](const auto& a, const auto& b) { return hindrances[a.reason] > hindrances[b.reason]; });
  return reasons;
}

/// Returns the option that takes a reason away; empty when none does.
std::string remedy(Hindrance reason, const Simplify_request& request)
{
  const Simplify_options& options = request.options;
  switch (reason) {
  case Hindrance::frozen:
    return defects_of(request) == Defects::freeze ? "--defects descend" : "";
  case Hindrance::misoriented:
    return request.are_faces_oriented ? "" : "--orient auto";
  case Hindrance::locked:
    return request.intent.locked.empty() ? "--keep for fewer parts" : "--lock for fewer parts";
  case Hindrance::normals:
    return joins_vertices(request.normals) || !request.progressive.empty() ? "" : "--normals loose";
  case Hindrance::border_turn:
    if (options.max_border_turn == 180)
      return "";
    return request.corner_height && options.max_normal_change == 180
               ? "--border-turn 180 without --corner-height"
               : "--border-turn 180";
  case Hindrance::seam_turn:
    return options.max_seam_turn < 180 ? "--seam-turn 180" : "";
  case Hindrance::drift:
    return "--border-drift " +
           with_digits(options.max_border_drift > 0 ? 5 * options.max_border_drift : 0.01);
  case Hindrance::aspect_ratio:
    return options.min_aspect_ratio > 0 ? "--aspect-ratio 0" : "";
  case Hindrance::normal_change:
    return options.max_normal_change < Simplify_options().max_normal_change
               ? "--normal-change " + with_digits(Simplify_options().max_normal_change)
               : ""; // more lets hardly a face go, as the error holds nearly all that turns more
  case Hindrance::error:
    return "--error " + with_digits(*options.max_error > 0 ? 5 * *options.max_error : 0.01);
  case Hindrance::clearance:
    return "--clearance " + with_digits(*options.clearance / 2);
  case Hindrance::companions:
    return "--instances apart";
  case Hindrance::by_loop:
    return "--loop own";
  default:
    return "";
  }
}

/// Says why no option takes a reason away.
std::string why_it_stays(Hindrance reason)
{
  switch (reason) {
  case Hindrance::frozen:
    return "what only rounding has brought to one place stays as it is";
  case Hindrance::non_manifold:
    return "what meets at edges of three faces or more stays as it is";
  case Hindrance::misoriented:
    return "what cannot be turned to face one way, like a Moebius band, stays as it is there";
  case Hindrance::topology:
    return "every piece keeps its holes and handles";
  case Hindrance::intersection:
    return "no layer passes through another";
  default:
    return "borders, seams and textures are kept";
  }
}

/// Says what `remedy` costs, if that is the shape or the size of the file.
std::string cost_of_remedy(Hindrance reason, const Simplified_soup& reduced)
{
  if (reason == Hindrance::companions)
    return ", which may make " + with_commas(reduced.shared_places) + " meshes of " +
           with_commas(reduced.shared_meshes);
  return reason == Hindrance::error ? ", which costs shape" : "";
}

/// Estimates how many faces go, of parts above their target, when edges that are held no longer are: as large
/// a share as of the edges. Reductions end at their target, so a little more than it takes is enough.
class Estimate
{
public:
  explicit Estimate(const Simplify_report& report)
      : m_edges(double(report.hindrances.total() - report.hindrances[Hindrance::target])),
        m_has_target(report.faces_target > 0)
  {
    for (const Simplify_report::Share& share : report.shares) {
      const std::size_t left = share.within_reach > 0 ? share.within_reach : share.output;
      m_left += left;
      if (left > share.target) {
        m_movable += left - share.fixed;
        m_to_go += left - share.target;
      }
    }
  }

  /// Of the faces to go, the share that does; at most what surely reaches the target.
  double gain(double edges) const
  {
    return (std::min)(s_surely, edges * double(m_movable) / (m_edges * double(m_to_go)));
  }

  static bool reaches(double gain) { return gain >= s_surely; }

  /// Says how far it goes, in brackets; empty where there is no target, as with `--error` alone.
  std::string text(double gain, const std::string& what = "") const
  {
    if (!m_has_target)
      return "";
    if (reaches(gain))
      return " (" + what + "probably to the target)";
    const double left = (std::max)(1., double(m_left) - (std::min)(gain, 1.) * double(m_to_go));
    const double digits = std::floor(std::log10((std::min)(left, double(m_to_go)))) - 1;
    const double unit = std::pow(10, (std::max)(0., digits));
    return " (" + what + "to about " + counted(std::size_t(std::round(left / unit) * unit), "face") + ')';
  }

private:
  static constexpr double s_surely = 1.25;

  double m_edges;
  bool m_has_target;
  std::size_t m_left = 0, m_movable = 0, m_to_go = 0;
};

/// What is named to a user whose target was missed: options, and what they are expected to gain.
struct Advice
{
  double gain = 0; // as `Estimate::gain`
  std::string text;
};

constexpr double least_gain = 0.1;

/// Returns how many edges an option lets go that takes a reason away: later rules hold half of what those of
/// borders and shape let go, and three quarters of what drifts. An error five times as large needs a fifth of
/// the faces, and half of what turns too far goes with it.
double edges_let_go(Hindrance reason, const Hindrances& hindrances)
{
  const double edges = double(hindrances[reason]);
  switch (reason) {
  case Hindrance::border_turn:
  case Hindrance::seam_turn:
  case Hindrance::gap:
  case Hindrance::aspect_ratio:
  case Hindrance::normal_change:
    return edges / 2;
  case Hindrance::drift:
    return edges / 4;
  case Hindrance::error:
    return 0.8 * (edges + double(hindrances[Hindrance::normal_change]) / 2);
  default:
    return edges;
  }
}

/// Names the option that gains most, and the next if it gains at least half as much and the first is not
/// expected to be enough. Of those that are, the one that costs least is named.
Advice options_against(const std::vector<Hindrances::Description>& reasons, const Simplify_request& request,
                       const Simplified_soup& reduced, const Estimate& estimate)
{
  struct Remedy
  {
    double edges;
    std::string option;
    Hindrances::Description description;
  };
  const Hindrances& hindrances = reduced.report.hindrances;
  std::vector<Remedy> remedies;
  for (const Hindrances::Description& description : reasons) {
    const double edges = edges_let_go(description.reason, hindrances);
    if (const std::string option = remedy(description.reason, request);
        !option.empty() && estimate.gain(edges) >= least_gain)
      remedies.push_back({edges, option, description});
  }
  const auto rank = [&](const Remedy& remedy) {
    const bool costs_shape = remedy.description.reason == Hindrance::error;
    return std::pair(-estimate.gain(remedy.edges), costs_shape);
  };
  std::stable_sort(remedies.begin(), remedies.end(),
                   [&](const Remedy& a, const Remedy& b) { return rank(a) < rank(b); });
  if (remedies.empty())
    return {};
  const auto named = [&](const Remedy& remedy, bool is_clear) {
    return remedy.option + (is_clear ? "" : std::string(" against ") + remedy.description.name) +
           cost_of_remedy(remedy.description.reason, reduced);
  };
  const Remedy& first = remedies[0];
  const double gain = estimate.gain(first.edges);
  const std::string reached = estimate.text(gain);
  const bool is_next_of_use = remedies.size() > 1 && 2 * remedies[1].edges >= first.edges;
  if (!is_next_of_use || estimate.reaches(gain))
    return {gain, "try " + named(first, first.description.reason == reasons[0].reason) + reached};
  return {gain, "try " + named(first, false) + reached + " and " + named(remedies[1], false) +
                    estimate.text(estimate.gain(first.edges + remedies[1].edges), "both ")};
}

/// Edges that are seams because of texture and of normals that differ too little to be seen: without texture,
/// hardly any of those that normals make is hard (`suited_to`). Zero where there are no more than those of
/// texture alone.
std::size_t seams_of_texture_and_soft_normals(const Simplify_request& request, const Prepared_soup& prepared,
                                              std::size_t of_texture)
{
  // Where soft lines have been loosened already, the others are hard without texture, too.
  const bool can_loosen = prepared.normals == Normals_treatment::fitted && request.progressive.empty();
  if (!can_loosen || prepared.soup.uvs.empty())
    return 0;
  Prepared_soup changed = prepared;
  changed.soup.uvs = {};
  if (!joins_vertices(suited_to(changed.soup, Normals_choice::automatic)))
    return 0;
  changed.soup.uvs = prepared.soup.uvs;
  changed.soup.normals = {};
  const std::map<std::string, std::size_t> seams = seams_of_attributes(changed);
  const auto found = seams.find("texture");
  return found != seams.end() && found->second > of_texture ? found->second : 0;
}

/// Names the attribute that makes most of the seams that nothing else makes, if they are many. Without
/// texture, no triangle of it can turn over.
Advice seams_to_leave_out(const Simplify_request& request, const Prepared_soup& prepared,
                          const Hindrances& hindrances, const Estimate& estimate)
{
  const std::size_t by_seams = hindrances[Hindrance::seam] + hindrances[Hindrance::texture] +
                               hindrances[Hindrance::line_end] + hindrances[Hindrance::seam_turn];
  const double turned_over = double(hindrances[Hindrance::uv]);
  Advice result;
  const auto add = [&](double edges, std::size_t count, const std::string& causes, const std::string& name) {
    const double gain = estimate.gain(edges);
    if (gain > result.gain && gain >= least_gain)
      result = {gain, counted(count, "edge") + " of the input " + (count == 1 ? "is a seam" : "are seams") +
                          " because of " + causes + ": " +
                          (name.empty() ? "leave it out of the file"
                                        : "--drop-attribute " + name + " lets them go") +
                          estimate.text(gain) + ", if nobody needs it"};
  };
  std::size_t of_texture = 0;
  for (const auto& [attribute, count] : seams_of_attributes(prepared)) {
    const bool is_texture = attribute == "texture";
    if (is_texture)
      of_texture = count;
    add(double((std::min)(count, by_seams)) + (is_texture ? turned_over : 0), count,
        attribute + " and nothing else", name_to_drop(attribute));
  }
  if (result.gain < least_gain)
    if (const std::size_t count = seams_of_texture_and_soft_normals(request, prepared, of_texture); count > 0)
      add(double((std::min)(count, by_seams)) + turned_over, count,
          "texture and of normals too near to be seen as edges", "texture");
  return result;
}

/// Names what holds open seams: gaps that get no wider, and borders that drift less there.
Advice seams_to_let_gape(const Simplify_request& request, const Prepared_soup& prepared,
                         const Hindrances& hindrances, const Estimate& estimate)
{
  const bool are_seams_held = request.open_seams == Open_seams::hold && !prepared.facing.empty();
  const std::size_t held = hindrances[Hindrance::gap] + hindrances[Hindrance::drift];
  const double gain =
      estimate.gain(edges_let_go(Hindrance::gap, hindrances) + double(hindrances[Hindrance::drift]));
  if (!are_seams_held || gain < least_gain)
    return {};
  return {gain, with_commas(held) +
                    " are held so that seams that stand open get hardly wider: --weld none lets them go" +
                    estimate.text(gain) + ", if they are no seams, as between strips of hair"};
}

/// Returns what helps, first what gains most; the first has no text if nothing helps.
std::vector<Advice> advice_on(const std::vector<Hindrances::Description>& reasons,
                              const Simplify_request& request, const Prepared_soup& prepared,
                              const Simplified_soup& result)
{
  const Hindrances& hindrances = result.report.hindrances;
  const Estimate estimate(result.report);
  std::vector<Advice> advice{seams_to_let_gape(request, prepared, hindrances, estimate),
                             options_against(reasons, request, result, estimate)};
  const auto gains_less = [](const Advice& a, const Advice& b) { return a.gain < b.gain; };
  // Whoever leaves out an attribute loses more than shape, so it has to gain more, and twice that to come
  // first.
  Advice leaving_out = seams_to_leave_out(request, prepared, hindrances, estimate);
  if (gains_less(*std::max_element(advice.begin(), advice.end(), gains_less), leaving_out)) {
    leaving_out.gain /= 2;
    advice.push_back(leaving_out);
  }
  std::stable_sort(advice.begin(), advice.end(),
                   [&](const Advice& a, const Advice& b) { return gains_less(b, a); });
  return advice;
}

/// Names three reasons, or as many as make two thirds of the edges, and counts what others hold.
std::string main_reasons(const std::vector<Hindrances::Description>& reasons, const Hindrances& hindrances)
{
  constexpr std::size_t least_named = 3;
  const std::size_t total = hindrances.total();
  std::size_t others = total;
  std::vector<std::string> named;
  for (std::size_t i = 0; i < reasons.size() && (i < least_named || 3 * others > total); ++i) {
    const std::size_t count = hindrances[reasons[i].reason];
    named.push_back((count == total ? "all" : with_commas(count)) + " by " + reasons[i].name);
    others -= count;
  }
  if (others > 0)
    named.push_back(with_commas(others) + " by other rules");
  return listed(named, named.size());
}

} // namespace

std::string held_back(const Simplify_request& request, const Prepared_soup& prepared,
                      const Simplified_soup& result)
{
  const Simplify_report& report = result.report;
  if (report.hindrances.total() == 0)
    return "all faces left are fixed; no option helps";
  Hindrances hindrances = report.hindrances;
  hindrances[Hindrance::target] = 0;
  if (hindrances.total() == 0)
    return "all edges left are held by parts at their target; no option helps";
  const std::vector<Hindrances::Description> all = reasons(hindrances);
  std::string text =
      "of " + counted(hindrances.total(), "edge") + " left" +
      (report.hindrances[Hindrance::target] > 0 ? " in parts above their target" : "") +
      (report.faces_within_reach > 0 ? " at " + counted(report.faces_within_reach, "face") : "") + ", " +
      main_reasons(all, hindrances);
  const std::vector<Advice> advice = advice_on(all, request, prepared, result);
  if (advice[0].text.empty())
    text += "; no option helps much: " + std::string(why_it_stays(all[0].reason));
  for (const Advice& piece : advice)
    text += (piece.text.empty() ? "" : "; ") + piece.text;
  return text;
}

std::string most_frequent_reason(const Hindrances& hindrances)
{
  return reasons(hindrances)[0].name;
}

} // namespace selvedge::app
