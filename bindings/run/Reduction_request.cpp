// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Reduction_request.h"

#include <selvedge/Error.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <limits>
#include <numeric>
#include <sstream>
#include <system_error>
#include <utility>

namespace selvedge::bindings {
namespace {

using Json = nlohmann::ordered_json;
using Request = Reduction_request;

// As in the program.
constexpr double default_error = 0.01;

[[noreturn]] void refuse(const std::string& value, const std::string& expected)
{
  throw Argument_error("'" + value + "' is not " + expected);
}

std::optional<double> number_in(const std::string& value, double largest = std::numeric_limits<double>::max())
{
  double result = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), result);
  if (error != std::errc() || end != value.data() + value.size() || !(result >= 0 && result <= largest))
    return std::nullopt;
  return result;
}

double number(const std::string& value, double largest = std::numeric_limits<double>::max())
{
  const std::optional<double> result = number_in(value, largest);
  if (!result)
    refuse(value, largest == std::numeric_limits<double>::max()
                      ? "a number of at least 0"
                      : "a number from 0 to " + std::to_string(int(largest)));
  return *result;
}

// The number that takes the place of a word.
double number_or(const std::string& words, const std::string& value)
{
  const std::optional<double> result = number_in(value);
  if (!result)
    throw Argument_error("'" + value + "' is neither a number of at least 0 nor " + words);
  return *result;
}

std::size_t count(const std::string& value, std::size_t least = 0)
{
  std::size_t result = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), result);
  if (error != std::errc() || end != value.data() + value.size() || result < least)
    refuse(value, "a whole number of at least " + std::to_string(least));
  return result;
}

template <class Value>
using Words = std::vector<std::pair<const char*, Value>>;

template <class Value>
Value value_of(const Words<Value>& words, const std::string& text)
{
  std::string known;
  for (const auto& [word, value] : words) {
    if (text == word)
      return value;
    known += (known.empty() ? "" : ", ") + std::string(word);
  }
  refuse(text, "one of " + known);
}

template <class Value>
const char* word_of(const Words<Value>& words, Value value)
{
  return std::find_if(words.begin(), words.end(), [&](const auto& word) { return word.second == value; })
      ->first;
}

const Words<bool> truth{{"true", true}, {"false", false}};
const Words<bool> key_poses_words{{"all", false}, {"auto", true}};
const Words<bool> orient{{"auto", true}, {"keep", false}};
const Words<Placement> placements{{"vertices", Placement::vertices}, {"optimal", Placement::optimal}};
const Words<Collapse_loop> loops{{"own", Collapse_loop::own}, {"cgal", Collapse_loop::cgal}};
const Words<Instances> instances{{"shared", Instances::shared}, {"apart", Instances::apart}};
const Words<Face_index> indices{{"packed", Face_index::packed}, {"clusters", Face_index::clusters}};
const Words<Normals_choice> normals{{"auto", Normals_choice::automatic},
                                    {"keep", Normals_choice::keep},
                                    {"mend", Normals_choice::mend},
                                    {"loose", Normals_choice::loose},
                                    {"recompute", Normals_choice::recompute},
                                    {"smooth", Normals_choice::smooth},
                                    {"drop", Normals_choice::drop}};
const Words<Open_seams> seams{
    {"hold", Open_seams::hold}, {"auto", Open_seams::weld}, {"none", Open_seams::measure}};
const Words<Defects> defects{
    {"descend", Defects::descend}, {"freeze", Defects::freeze}, {"refuse", Defects::refuse}};

template <class Value>
Json optional_json(const std::optional<Value>& value)
{
  return value ? Json(*value) : Json(nullptr);
}

struct Option
{
  const char* name;
  void (*set)(Request&, const std::string&);
  Json (*json)(const Request&);
};

template <double Simplify_options::*member, int largest = 0>
Option number_option(const char* name)
{
  return {name,
          [](Request& request, const std::string& value) {
            request.options.*member = largest > 0 ? number(value, largest) : number(value);
          },
          [](const Request& request) { return Json(request.options.*member); }};
}

template <double Quadric_cost_options::*member, int largest = 0>
Option cost_option(const char* name)
{
  return {name,
          [](Request& request, const std::string& value) {
            request.options.cost.*member = largest > 0 ? number(value, largest) : number(value);
          },
          [](const Request& request) { return Json(request.options.cost.*member); }};
}

void set_error(Request& request, const std::string& value)
{
  request.is_error_given = value != "none";
  request.options.max_error =
      request.is_error_given ? std::optional<double>(number_or("none", value)) : std::nullopt;
}

void add_part_ratio(Request& request, const std::string& value)
{
  const std::size_t equals = value.rfind('=');
  if (equals == std::string::npos)
    refuse(value, "a part and its ratio, as in collar=0.5");
  request.intent.ratios.push_back({value.substr(0, equals), number(value.substr(equals + 1), 1)});
}

void add_lods(Request& request, const std::string& value)
{
  std::istringstream list(value + ',');
  std::vector<double> ratios;
  for (std::string ratio; std::getline(list, ratio, ',');)
    ratios.push_back(number(ratio, 1));
  request.lods.insert(request.lods.end(), ratios.begin(), ratios.end());
}

void add_part_pair(Request& request, const std::string& value)
{
  if (value.find(':') == std::string::npos)
    refuse(value, "two parts with a colon between them, as in skin:dress");
  request.may_intersect.push_back(value);
}

Json part_ratios_json(const Request& request)
{
  Json list = Json::array();
  for (const Simplify_intent::Part_ratio& part : request.intent.ratios)
    list.push_back({{"part", part.name}, {"ratio", part.ratio}});
  return list;
}

void set_weld(Request& request, const std::string& value)
{
  request.is_weld_given = true;
  const auto word = std::find_if(seams.begin(), seams.end(), [&](const auto& s) { return s.first == value; });
  request.prepare.open_seams = word == seams.end() ? Open_seams::ignore : word->second;
  request.prepare.weld_distance = word == seams.end() ? number_or("hold, auto or none", value) : 0;
}

const std::vector<Option>& table()
{
  static const std::vector<Option> options{
      {"ratio", [](Request& r, const std::string& value) { r.options.ratio = number(value, 1); },
       [](const Request& r) { return optional_json(r.options.ratio); }},
      {"faces", [](Request& r, const std::string& value) { r.options.faces = count(value); },
       [](const Request& r) { return optional_json(r.options.faces); }},
      {"error", set_error, [](const Request& r) { return optional_json(r.options.max_error); }},
      {"error_everywhere",
       [](Request& r, const std::string& value) { r.is_error_everywhere = value_of(truth, value); },
       [](const Request& r) { return Json(r.is_error_everywhere); }},
      number_option<&Simplify_options::max_normal_change, 180>("normal_change"),
      number_option<&Simplify_options::min_aspect_ratio, 1>("aspect_ratio"),
      number_option<&Simplify_options::max_border_turn, 180>("border_turn"),
      number_option<&Simplify_options::max_corner_height>("corner_height"),
      number_option<&Simplify_options::max_seam_turn, 180>("seam_turn"),
      number_option<&Simplify_options::max_border_drift>("border_drift"),
      {"placement",
       [](Request& r, const std::string& value) { r.options.placement = value_of(placements, value); },
       [](const Request& r) { return Json(word_of(placements, r.options.placement)); }},
      {"loop", [](Request& r, const std::string& value) { r.options.loop = value_of(loops, value); },
       [](const Request& r) { return Json(word_of(loops, r.options.loop)); }},
      {"index", [](Request& r, const std::string& value) { r.options.index = value_of(indices, value); },
       [](const Request& r) { return Json(word_of(indices, r.options.index)); }},
      {"cluster_size",
       [](Request& r, const std::string& value) { r.options.faces_per_cluster = count(value, 1); },
       [](const Request& r) { return Json(r.options.faces_per_cluster); }},
      {"intersection_check",
       [](Request& r, const std::string& value) { r.options.check_intersections = value_of(truth, value); },
       [](const Request& r) { return Json(r.options.check_intersections); }},
      {"clearance", [](Request& r, const std::string& value) { r.options.clearance = number(value); },
       [](const Request& r) { return optional_json(r.options.clearance); }},
      cost_option<&Quadric_cost_options::stabiliser>("stabiliser"),
      cost_option<&Quadric_cost_options::memory, 1>("memory"),
      cost_option<&Quadric_cost_options::border_weight>("border_weight"),
      number_option<&Simplify_options::uv_weight>("uv_weight"),
      number_option<&Simplify_options::normal_weight>("normal_weight"),
      {"part_ratios", add_part_ratio, part_ratios_json},
      {"lods", add_lods, [](const Request& r) { return Json(r.lods); }},
      {"lock", [](Request& r, const std::string& value) { r.intent.locked.push_back(value); },
       [](const Request& r) { return Json(r.intent.locked); }},
      {"keep", [](Request& r, const std::string& value) { r.intent.kept.push_back(value); },
       [](const Request& r) { return Json(r.intent.kept); }},
      {"may_intersect", add_part_pair, [](const Request& r) { return Json(r.may_intersect); }},
      {"weights", [](Request& r, const std::string& value) { r.intent.weights = value; },
       [](const Request& r) { return r.intent.weights.empty() ? Json(nullptr) : Json(r.intent.weights); }},
      {"drop_part", [](Request& r, const std::string& value) { r.dropped_parts.names.push_back(value); },
       [](const Request& r) { return Json(r.dropped_parts.names); }},
      {"drop_smaller",
       [](Request& r, const std::string& value) { r.dropped_parts.smaller_than = number(value); },
       [](const Request& r) { return Json(r.dropped_parts.smaller_than); }},
      {"key_poses",
       [](Request& r, const std::string& value) {
         r.are_key_poses_chosen = value_of(key_poses_words, value);
       },
       [](const Request& r) { return Json(word_of(key_poses_words, r.are_key_poses_chosen)); }},
      {"weld", set_weld,
       [](const Request& r) {
         const Prepare_options prepare = r.complete_prepare_options();
         return prepare.open_seams == Open_seams::ignore ? Json(prepare.weld_distance)
                                                         : Json(word_of(seams, prepare.open_seams));
       }},
      {"sewn", [](Request& r, const std::string& value) { r.is_sewn = value_of(truth, value); },
       [](const Request& r) { return Json(r.is_sewn); }},
      {"normals", [](Request& r, const std::string& value) { r.prepare.normals = value_of(normals, value); },
       [](const Request& r) { return Json(word_of(normals, r.prepare.normals)); }},
      {"orient", [](Request& r, const std::string& value) { r.prepare.orient = value_of(orient, value); },
       [](const Request& r) { return Json(word_of(orient, r.prepare.orient)); }},
      {"instances",
       [](Request& r, const std::string& value) { r.options.instances = value_of(instances, value); },
       [](const Request& r) { return Json(word_of(instances, r.options.instances)); }},
      {"threads", [](Request& r, const std::string& value) { r.threads = count(value, 1); },
       [](const Request& r) { return optional_json(r.threads); }},
      {"cells",
       [](Request& r, const std::string& value) {
         r.options.faces_per_cell = value_of(truth, value) ? Simplify_options::default_faces_per_cell : 0;
       },
       [](const Request& r) { return Json(r.options.faces_per_cell > 0); }},
      {"defects", [](Request& r, const std::string& value) { r.prepare.defects = value_of(defects, value); },
       [](const Request& r) { return Json(word_of(defects, r.prepare.defects)); }}};
  return options;
}

// The distance of Levenshtein.
std::size_t letters_to_change(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j)
      diagonal =
          std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])}));
  }
  return row.back();
}

} // namespace

Reduction_request::Reduction_request()
{
  options.max_error = default_error;
  prepare.normals = Normals_choice::automatic;
  prepare.open_seams = Open_seams::hold;
}

void Reduction_request::set(const std::string& name, const std::string& value)
{
  const auto option =
      std::find_if(table().begin(), table().end(), [&](const Option& row) { return name == row.name; });
  if (option == table().end() && name != "log")
    throw Argument_error("there is no option '" + name + "'; the nearest is '" +
                         nearest(name, option_names()) + "'");
  try {
    if (option == table().end())
      is_log_wanted = value_of(truth, value);
    else
      option->set(*this, value);
    is_border_turn_given |= name == "border_turn";
  } catch (const Argument_error& error) {
    throw Argument_error(name + ": " + error.what());
  }
}

Simplify_options Reduction_request::complete_options() const
{
  Simplify_options result = options;
  if (is_without_target())
    result.ratio = 1;
  return result;
}

Prepare_options Reduction_request::complete_prepare_options() const
{
  Prepare_options result = prepare;
  if (options.loop == Collapse_loop::cgal && !is_weld_given)
    result.open_seams = Open_seams::measure;
  return result;
}

void Reduction_request::check() const
{
  if (is_without_target() && intent.ratios.empty())
    throw Argument_error("say how far to reduce the mesh: give ratio, faces, error, lods or part_ratios");
  if (!lods.empty() && (options.ratio || options.faces))
    throw Argument_error("lods: they already say how far to reduce the mesh; leave out ratio and faces");
  if (is_error_everywhere && !options.max_error)
    throw Argument_error("error_everywhere: there is no limit to keep; give a number as error");
  if (options.clearance && (prepare.open_seams == Open_seams::weld || prepare.weld_distance > 0))
    throw Argument_error("clearance: closing gaps brings pieces nearer to each other; leave it out, or weld");
  if (options.loop == Collapse_loop::cgal && is_weld_given && prepare.open_seams == Open_seams::hold)
    throw Argument_error(
        "weld: CGAL's loop collapses no two edges right after each other, as the two sides of a gap need it "
        "to be held; leave out loop, or give another weld");
  if (options.index == Face_index::packed &&
      options.faces_per_cluster != Simplify_options().faces_per_cluster)
    throw Argument_error(
        "cluster_size: the packed index has no clusters; leave it out, or give clusters as index");
  if (options.max_corner_height != Simplify_options().max_corner_height && options.max_border_turn == 180 &&
      options.max_normal_change == 180)
    throw Argument_error("corner_height: with such a border_turn and normal_change, borders and faces may "
                         "turn as far at any corner as at a low one; leave it out");
  for (const Simplify_intent::Part_ratio& part : intent.ratios)
    if (std::find(intent.kept.begin(), intent.kept.end(), part.name) != intent.kept.end())
      throw Argument_error("keep: no face of '" + part.name +
                           "' may change, so that its ratio in part_ratios can do nothing; leave out one of "
                           "the two");
}

std::string Reduction_request::json() const
{
  Json object;
  for (const Option& option : table())
    object[option.name] = option.json(*this);
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::string> option_names()
{
  std::vector<std::string> names;
  for (const Option& option : table())
    names.push_back(option.name);
  return names;
}

std::string nearest(const std::string& name, const std::vector<std::string>& names)
{
  return *std::min_element(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return letters_to_change(name, a) < letters_to_change(name, b);
  });
}

} // namespace selvedge::bindings
