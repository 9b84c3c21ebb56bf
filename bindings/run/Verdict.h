// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BINDINGS_RUN_VERDICT_H
#define SELVEDGE_BINDINGS_RUN_VERDICT_H

#include <selvedge/compare.h>
#include <selvedge/drop_parts.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::bindings {

/// What a caller in another language asks of the judge.
struct Verdict_request
{
  double weld_distance = 0; ///< as `Verify_options` has them
  std::optional<double> clearance;
  std::vector<std::string> may_intersect; ///< "PART:PART", with names of parts of the mesh
  std::optional<std::size_t> threads;
  Parts_to_drop dropped_parts = {}; ///< of the original
  std::vector<Index_triple> triangles_in_file = {};
};

/// What the judge says of a mesh in memory, as `selvedge verify` says it of a file.
class Verdict
{
public:
  /// Judges a mesh by itself or, where `original` is not null, as a result of reducing that. Throws what
  /// `verify` and `judge` throw.
  Verdict(const Triangle_soup& mesh, const Triangle_soup* original, const Triangle_soup& obstacle,
          const Verdict_request& request);

  bool is_accepted() const { return m_judgement.is_accepted(); }
  const Verification& verification() const { return m_judgement.verification; }

  /// The layers that have changed places; none without an original.
  const std::vector<Layer_swap>& swaps() const;

  /// Returns a report in JSON: what the program's reports say of a mesh, apart from files (docs/report.md).
  std::string report() const;

private:
  Judgement m_judgement;
  bool m_is_gltf;
};

} // namespace selvedge::bindings

#endif // SELVEDGE_BINDINGS_RUN_VERDICT_H
