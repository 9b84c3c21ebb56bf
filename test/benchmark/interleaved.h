// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BENCHMARK_INTERLEAVED_H
#define SELVEDGE_BENCHMARK_INTERLEAVED_H

#include "Table.h"

#include <selvedge/simplify.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace selvedge::benchmark {

/// What is measured more than once.
struct Sample
{
  std::vector<double> values;

  double least() const { return *std::min_element(values.begin(), values.end()); }
  double most() const { return *std::max_element(values.begin(), values.end()); }
  double median() const
  {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    return (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2;
  }
  friend Sample operator/(Sample a, const Sample& b)
  {
    std::transform(a.values.begin(), a.values.end(), b.values.begin(), a.values.begin(), std::divides<>());
    return a;
  }
};

inline std::string spread(const Sample& sample)
{
  return text(sample.least()) + " to " + text(sample.most());
}

inline double seconds_per_1000(const Simplify_report& report)
{
  return 1000 * report.seconds_reduce / static_cast<double>(report.collapses);
}

/// `measure(which, run)` of each of so many programs in turn, `runs` times, every other time backwards: what
/// slows the machine down for a while, slows all of them down.
template <class Function>
std::vector<Sample> interleaved(std::size_t count, int runs, const Function& measure)
{
  std::vector<Sample> samples(count);
  for (int run = 0; run < runs; ++run)
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t which = run % 2 == 0 ? i : count - 1 - i;
      samples[which].values.push_back(measure(which, run));
    }
  return samples;
}

/// These reductions so; `on_first` is called with the first result of each.
template <class Function>
std::vector<Sample> interleaved(const Prepared_soup& prepared, const std::vector<Simplify_options>& all,
                                int runs, const Function& on_first)
{
  return interleaved(all.size(), runs, [&](std::size_t which, int run) {
    const Simplified_soup result = simplify_soup(prepared, all[which]);
    if (run == 0)
      on_first(which, result);
    return seconds_per_1000(result.report);
  });
}

} // namespace selvedge::benchmark

#endif // SELVEDGE_BENCHMARK_INTERLEAVED_H
