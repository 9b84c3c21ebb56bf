// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_REFUSALS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_REFUSALS_H

#include <array>
#include <cstddef>

namespace selvedge {

/// Refusals per rule: each (edge, direction) that the loop considers is counted by the first rule that
/// refuses it, and again when it is considered again. The rules are listed in the order in which they are
/// asked, the cheap ones first.
struct Refusals
{
  std::size_t border = 0; ///< borders, seams, locked vertices, topology of pieces
  std::size_t target = 0; ///< a share at its target would lose a face; see `Simplify_constraints::shares`
  std::size_t error = 0;  ///< larger than `Simplify_options::max_error`
  std::size_t aspect_ratio = 0;
  std::size_t normal_change = 0;
  std::size_t uv = 0; ///< a texture triangle would turn over
  std::size_t intersection = 0;
  std::size_t clearance = 0;  ///< faces would come too near others; see `Simplify_options::clearance`
  std::size_t companions = 0; ///< places of a shared mesh are so near each other that they cannot move alike
  std::size_t by_loop = 0;    ///< accepted by all rules, but refused by a geometric test of CGAL's loop

  struct Rule
  {
    const char* key;  ///< names the rule in reports and outcomes
    const char* name; ///< names the rule in sentences
    std::size_t Refusals::*count;
  };

  /// Returns all rules, in order.
  static constexpr std::array<Rule, 10> rules();

  friend Refusals& operator+=(Refusals& a, const Refusals& b)
  {
    for (const Rule& rule : rules())
      a.*rule.count += b.*rule.count;
    return a;
  }
  friend Refusals operator-(Refusals a, const Refusals& b)
  {
    for (const Rule& rule : rules())
      a.*rule.count -= b.*rule.count;
    return a;
  }
};

constexpr std::array<Refusals::Rule, 10> Refusals::rules()
{
  return {{{"border", "border", &Refusals::border},
           {"target", "parts at their target", &Refusals::target},
           {"error", "error", &Refusals::error},
           {"aspect_ratio", "aspect ratio", &Refusals::aspect_ratio},
           {"normal_change", "normal change", &Refusals::normal_change},
           {"uv", "texture", &Refusals::uv},
           {"intersection", "intersection", &Refusals::intersection},
           {"clearance", "clearance", &Refusals::clearance},
           {"companions", "other places of shared meshes", &Refusals::companions},
           {"by_loop", "CGAL's loop", &Refusals::by_loop}}};
}

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_REFUSALS_H
