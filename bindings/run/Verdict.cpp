// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Verdict.h"

#include "apps/Thread_limit.h"
#include "apps/blind_spots.h"
#include "apps/report_json.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>

namespace selvedge::bindings {
namespace {

Judgement judgement_of(const Triangle_soup& mesh, const Triangle_soup* original,
                       const Triangle_soup& obstacle, const Verdict_request& request)
{
  if (!original && request.weld_distance > 0)
    throw Argument_error("weld: there is no original; give one, or leave it out");
  if (!original && !request.dropped_parts.empty())
    throw Argument_error("drop_part, drop_smaller: there is no original; give one, or leave them out");
  const app::Thread_limit limit(request.threads);
  Verify_options options;
  options.weld_distance = request.weld_distance;
  options.clearance = request.clearance;
  options.triangles_in_file = request.triangles_in_file;
  options.may_intersect = parts_in_pairs(mesh, request.may_intersect, "may_intersect");
  if (!original)
    return {verify(mesh, options, obstacle), {}};
  if (request.dropped_parts.empty())
    return judge(mesh, *original, options, obstacle);
  Triangle_soup left = *original;
  drop_parts(left, request.dropped_parts);
  return judge(mesh, left, options, obstacle);
}

} // namespace

Verdict::Verdict(const Triangle_soup& mesh, const Triangle_soup* original, const Triangle_soup& obstacle,
                 const Verdict_request& request)
    : m_judgement(judgement_of(mesh, original, obstacle, request)),
      m_is_gltf(mesh.scene || (original && original->scene))
{
}

const std::vector<Layer_swap>& Verdict::swaps() const
{
  static const std::vector<Layer_swap> none;
  return m_judgement.comparison ? m_judgement.comparison->layers.swaps : none;
}

std::string Verdict::report() const
{
  const auto& [verification, comparison] = m_judgement;
  app::Json report = app::new_report("verify");
  app::add_verification(report, verification, comparison.has_value());
  if (comparison) {
    report["original"]["rounded"] = verification.is_original_rounded;
    app::add_comparison(report, verification, *comparison);
    report["cannot_see"] = app::blind_spots(verification, *comparison, m_is_gltf);
  }
  return app::to_text(report);
}

} // namespace selvedge::bindings
