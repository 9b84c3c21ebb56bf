// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_REPORT_JSON_H
#define SELVEDGE_APPS_REPORT_JSON_H

#include <selvedge/Error_search.h>
#include <selvedge/compare.h>
#include <selvedge/mesh_files.h>
#include <selvedge/replay.h>
#include <selvedge/simplify.h>
#include <selvedge/verify.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::app {

/// A JSON value whose keys keep the order in which they are set.
using Json = nlohmann::ordered_json;

/// Returns a value, or null where there is none.
template <class Value>
Json or_null(const std::optional<Value>& value)
{
  return value ? Json(*value) : Json(nullptr);
}

/// Returns a text, or null where it is empty.
inline Json or_null(const std::string& text)
{
  return text.empty() ? Json(nullptr) : Json(text);
}

/// Returns the first keys of every report: `schema`, `version` and `command`.
Json new_report(const std::string& command);

/// Returns what a report says of a file that was read.
Json input_json(const std::filesystem::path& path, const Mesh_file& file);

/// Returns what a report says of the gaps between borders.
Json border_gaps_json(const Border_gaps& gaps);

/// Says what was prepared and how the reduction went: sets the keys from `faces` to `rounding`
/// (docs/report.md).
void add_reduction(Json& report, const Prepared_soup& prepared, const Simplified_soup& result);

/// Says of each of the further poses, after `add_verification`, whether it was guarded, and how many
/// collapses were refused in it. `guarded` are the numbers of those that were, in ascending order.
void add_guarded_poses(Json& report, const std::vector<std::size_t>& guarded, const Simplified_soup& result);

/// Sets `verified`, `pieces`, and `topology`, `matching` and `distance` where there is an original.
void add_verification(Json& report, const Verification& verification, bool has_original);

/// Adds to the distances of a verification how large they are anywhere in any pose, as far as that was
/// measured.
void add_distances(Json& report, const Verification& verification,
                   const std::optional<Distances_anywhere>& distances);

/// Sets `error_search`.
void add_error_search(Json& report, const std::optional<Error_search>& search);

/// The seconds of the phases of a reduction, by the keys of reports. Where it is done again, those of
/// reducing and judging are sums.
class Phase_seconds
{
public:
  double& operator[](const std::string& phase) { return m_seconds[phase]; }

  /// Sets the seconds of preparing and sewing, and adds those of one reduction. `results` are its levels.
  void add(const Prepared_soup& prepared, const std::vector<const Simplified_soup*>& results);

  /// Returns the value of `seconds`, with these keys; 0 for a phase that has not been.
  Json json(const std::vector<std::string>& phases) const;

private:
  std::map<std::string, double> m_seconds;
};

/// Sets `borders`, `seams`, `gaps`, `vertices`, `attributes`, `normals` and `layers`, and adds to `distance`.
void add_comparison(Json& report, const Verification& verification, const Comparison& comparison);

/// Sets `parts` and `uv`.
void add_parts(Json& report, const Prepared_soup& prepared, const Simplified_soup& result);

/// Counts violations by the names of their kinds.
std::map<std::string, std::size_t> count_by_kind(const std::vector<Violation>& violations);

/// Sets `verdict`, `terms`, `steps`, `faces`, `frozen`, `snap`, `violations`, `pairs` and `seconds`.
void add_replay(Json& report, const Replay_verdict& verdict);

/// Returns the largest amount of memory that this process has had in use.
std::size_t peak_memory_bytes();

/// Returns the report as text that ends in a line break. It replaces bytes that are not UTF-8, and infinite
/// numbers by null.
std::string to_text(const Json& report);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_REPORT_JSON_H
