// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SIMPLIFY_REPORT_H
#define SELVEDGE_SIMPLIFY_REPORT_H

#include <selvedge/Surface_mesh_simplification/Intersection_statistics.h>
#include <selvedge/spatial/Index_statistics.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

namespace selvedge {

/// How often which rule refused a direction of an edge that the loop considered. Cheap rules come first, and
/// each counts only what those before it had accepted. An edge counts again when it is considered again.
struct Refusals
{
  std::size_t border = 0; ///< borders, seams, locked vertices
  std::size_t target = 0; ///< a face would go of which enough have gone; see `Simplify_constraints::shares`
  std::size_t error = 0;  ///< `Simplify_options::max_error`
  std::size_t aspect_ratio = 0;
  std::size_t normal_change = 0;
  std::size_t uv = 0; ///< a texture triangle would turn over
  std::size_t intersection = 0;
  std::size_t by_loop = 0; ///< accepted by all rules, refused by a geometric test of CGAL's loop

  Refusals& operator+=(const Refusals& other)
  {
    for (const auto count : counts())
      this->*count += other.*count;
    return *this;
  }
  Refusals& operator-=(const Refusals& other)
  {
    for (const auto count : counts())
      this->*count -= other.*count;
    return *this;
  }
  friend Refusals operator-(Refusals a, const Refusals& b) { return a -= b; }

private:
  static std::array<std::size_t Refusals::*, 8> counts()
  {
    return {&Refusals::border,        &Refusals::target, &Refusals::error,        &Refusals::aspect_ratio,
            &Refusals::normal_change, &Refusals::uv,     &Refusals::intersection, &Refusals::by_loop};
  }
};

/// What a reduction of a mesh did.
struct Simplify_report
{
  std::size_t faces_input = 0;
  std::size_t faces_target = 0;
  std::size_t faces_output = 0;
  std::size_t faces_to_go = 0; ///< by which shares exceed their targets at the end
  std::size_t collapses = 0;
  std::size_t passes = 0;  ///< of CGAL's loop: another begins while refused edges have become possible
  bool is_stopped = false; ///< by `Simplify_options::should_stop`
  Refusals refused; ///< with `Simplify_options::faces_per_cell`: after the cells, as the next two
  Intersection_statistics intersections;
  Index_statistics index;
  std::size_t cells = 0;
  std::size_t collapses_in_cells = 0; ///< of `collapses`
  double seconds_cells = 0;           ///< of `seconds_reduce`: until all cells were done and joined
  double seconds_index = 0;           ///< for building the index
  double seconds_reduce = 0;          ///< in all, the index included

  /// What was refused in the last pass alone, when everything still possible was tried once more.
  Refusals refused_in_last_pass;

  bool is_reached() const { return faces_to_go == 0; }

  /// "reached", "stopped", or the rule that refused most in the last pass.
  std::string outcome() const
  {
    if (is_reached())
      return "reached";
    if (is_stopped)
      return "stopped";
    const Refusals& last = refused_in_last_pass;
    const std::pair<std::size_t, const char*> rules[] = {{last.border, "border"},
                                                         {last.target, "target"},
                                                         {last.error, "error"},
                                                         {last.aspect_ratio, "aspect_ratio"},
                                                         {last.normal_change, "normal_change"},
                                                         {last.uv, "uv"},
                                                         {last.intersection, "intersection"},
                                                         {last.by_loop, "by_loop"}};
    const auto most = std::max_element(std::begin(rules), std::end(rules),
                                       [](const auto& a, const auto& b) { return a.first < b.first; });
    return most->first > 0 ? most->second : "topology";
  }
};

} // namespace selvedge

#endif // SELVEDGE_SIMPLIFY_REPORT_H
