// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_HTML_REPORT_H
#define SELVEDGE_APPS_HTML_REPORT_H

#include "report_json.h"

#include <selvedge/Soup_collapse.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace selvedge::app {

/// Adds `--html`.
CLI::Option* add_html_option(CLI::App& command, std::string& file);

/// Throws `Argument_error` when a page is asked for that this program was built without.
void require_html(const std::string& file);

/// The report to look at: one HTML file that shows a mesh before and after, and needs no other file.
///
/// Points, triangles, collapses and what hangs on them are lists of whole numbers, packed into one block;
/// coordinates are rounded to 1/65535 of the box around everything shown, in all poses. The rest is JSON,
/// whose text cannot end the element of the page that holds it, whatever files and parts are called.
/// `html/viewer.js` reads both. Triangles are numbered as in the soups.
class Html_report
{
public:
  /// Shows `before` on the left; `beside` is another mesh that comes into view, or empty. Vertices that are
  /// at one position in all poses are shown as one. Both soups must outlive the report.
  Html_report(const Triangle_soup& before, const Triangle_soup& beside);

  /// Shows which faces do not move, the pairs that offend, and `beside` as an obstacle.
  void add_input(const Prepared_soup& prepared, const std::vector<std::string>& locked_parts);

  /// Adds collapses of the vertices of `before`. One of a vertex onto itself changes nothing. Returns their
  /// number, for `add_level` and `add_replay`.
  std::size_t add_collapses(const std::vector<Soup_collapse>& collapses);

  /// Adds a result, to which the first `steps` of some collapses lead.
  void add_level(const std::string& name, const Simplified_soup& result, const Verification& verification,
                 std::size_t collapses, std::size_t steps);

  /// Adds what a log leads to, by the first steps of some collapses.
  void add_replay(const std::string& name, const Replay_verdict& verdict, std::size_t collapses);

  /// Adds the steps that a replay refused: in the pose of the file, numbered 0, or in a further pose.
  void add_violations(const std::vector<Violation>& violations, std::size_t pose);

  /// Shows `beside` as the result, of which nothing but the mesh is known; or no result if it is empty.
  void add_result(const std::string& name, const Verification& verification);

  /// Returns the page. `report` is what `--report` writes.
  std::string page(const Json& report) const;

private:
  using Numbers = std::vector<std::uint32_t>;

  // The vertices of a mesh as the page numbers them: those that are one have one number. Those that only
  // unused vertices share have none.
  struct Nodes
  {
    std::vector<Index> of_vertex;
    Numbers coordinates;
    std::size_t size() const { return coordinates.size() / 3; }
  };

  Json section(const Numbers& numbers);
  std::uint32_t quantised(double coordinate, int axis) const;
  Nodes nodes_of(const Triangle_soup& soup) const;
  Json poses_json(const Triangle_soup& soup, const Nodes& nodes);
  Json mesh_json(const Triangle_soup& soup, const Nodes& nodes);
  Json uv_json(const Triangle_soup& soup);
  Json distances_json(const std::vector<double>& distances, const Nodes& nodes, double largest);
  Json place_json(const std::vector<Point_3>& corners, const std::string& text) const;
  void add_places(const std::string& heading, bool is_fault, std::size_t count, Json list, std::size_t pose);
  void add_pairs(const std::string& heading, bool is_fault, const std::vector<Offending_pair>& pairs,
                 const Triangle_soup& soup, std::size_t pose);
  void add_new_pairs(const Verification& verification, const Triangle_soup& result);
  void add_deviations(const std::string& heading, const Triangle_soup& soup,
                      const std::vector<double>& distances);

  const Triangle_soup& m_before;
  const Triangle_soup& m_beside;
  CGAL::Bbox_3 m_box;
  Nodes m_nodes, m_nodes_beside;
  Json m_scene;
  std::string m_block;
};

} // namespace selvedge::app

#endif // SELVEDGE_APPS_HTML_REPORT_H
