// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REDUCTION_HISTORY_H
#define SELVEDGE_REDUCTION_HISTORY_H

#include <selvedge/Surface_mesh_simplification/Refusals.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace selvedge {

/// What collapses cost, and what was refused between them, in the course of a reduction. It is kept in at
/// most 256 samples. When these are full, each two become one, so that a sample stands for 1, 2, 4, ...
/// successive collapses, and the last one for what remains.
class Reduction_history
{
public:
  struct Sample
  {
    std::size_t collapses = 0; ///< those of this sample and of all before it
    double least_cost = 0;     ///< of a collapse of this sample
    double largest_cost = 0;
    Refusals refused; ///< until the last collapse of the sample
  };

  const std::vector<Sample>& samples() const { return m_samples; }

  /// Adds a collapse of some cost, before which all of `refused` was refused.
  void add(double cost, const Refusals& refused)
  {
    const std::size_t before = m_samples.empty() ? 0 : m_samples.back().collapses;
    if (before == s_most_samples * m_collapses_per_sample)
      halve();
    if (before % m_collapses_per_sample == 0)
      m_samples.push_back({before, cost, cost, refused});
    Sample& last = m_samples.back();
    ++last.collapses;
    last.least_cost = (std::min)(last.least_cost, cost);
    last.largest_cost = (std::max)(last.largest_cost, cost);
    last.refused = refused;
  }

  /// Adds what was refused after the last collapse to the last sample.
  void finish(const Refusals& refused)
  {
    if (!m_samples.empty())
      m_samples.back().refused = refused;
  }

  /// Returns what this history was after some number of its collapses, at least 1. The costs and refusals of
  /// its last sample may be those of later ones, too.
  Reduction_history until(std::size_t collapses) const
  {
    Reduction_history result = *this;
    std::vector<Sample>& samples = result.m_samples;
    const auto last = std::find_if(samples.begin(), samples.end(),
                                   [&](const Sample& sample) { return sample.collapses >= collapses; });
    if (last != samples.end()) {
      last->collapses = collapses;
      samples.erase(last + 1, samples.end());
    }
    return result;
  }

private:
  static constexpr std::size_t s_most_samples = 256;

  void halve()
  {
    for (std::size_t i = 0; i < m_samples.size() / 2; ++i) {
      const Sample &first = m_samples[2 * i], &second = m_samples[2 * i + 1];
      m_samples[i] = {second.collapses, (std::min)(first.least_cost, second.least_cost),
                      (std::max)(first.largest_cost, second.largest_cost), second.refused};
    }
    m_samples.resize(m_samples.size() / 2);
    m_collapses_per_sample *= 2;
  }

  std::vector<Sample> m_samples;
  std::size_t m_collapses_per_sample = 1;
};

} // namespace selvedge

#endif // SELVEDGE_REDUCTION_HISTORY_H
