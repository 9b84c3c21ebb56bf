// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_COST_OF_POSES_H
#define SELVEDGE_APPS_COST_OF_POSES_H

#include "text.h"

#include <cmath>
#include <cstddef>
#include <string>

namespace selvedge::app {

/// Says of a mesh of many further poses what they will cost, before any of them is judged, and which option
/// helps; empty where they cost little. `guarded` is how many are guarded at first; `every` is the option of
/// keyframes, or 0 where the poses are not keyframes.
///
/// A guarded pose takes 0.3 to 0.5 KB and 10 to 30 µs for each face (docs/poses.md).
inline std::string cost_of_poses(std::size_t poses, std::size_t faces, std::size_t guarded, std::size_t every)
{
  constexpr double many = 1e7, kilobytes = 0.4, microseconds = 20;
  const double work = double(poses) * double(faces);
  if (work < many)
    return "";
  const auto amount = [](double value, const char* unit) {
    return with_commas(std::size_t(std::ceil(value))) + ' ' + unit;
  };
  std::string text = counted(poses, "further pose") + " of " + counted(faces, "face") +
                     ": all guarded, they take about " + amount(1e-6 * kilobytes * work, "GB") + " and " +
                     amount(1e-6 * microseconds * work / 60, "minutes");
  if (guarded < poses)
    text += "; " + with_commas(guarded) + " are at first, then those in which the judge finds new pairs";
  const std::size_t factor = std::size_t(std::ceil(work / many));
  if (every > 0 && factor > 1)
    return text + "; --every " + std::to_string(factor * every) + " takes " +
           with_commas((poses + factor - 1) / factor) + " of them";
  return text + (guarded < poses ? "" : "; --key-poses auto guards few at first");
}

} // namespace selvedge::app

#endif // SELVEDGE_APPS_COST_OF_POSES_H
