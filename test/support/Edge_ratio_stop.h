// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_EDGE_RATIO_STOP_H
#define SELVEDGE_TEST_SUPPORT_EDGE_RATIO_STOP_H

namespace selvedge::test {

/// Stops when less than a share of the edges is left, as `Count_ratio_stop_predicate` of CGAL 5 and
/// `Edge_count_ratio_stop_predicate` of CGAL 6 do.
class Edge_ratio_stop
{
public:
  explicit Edge_ratio_stop(double ratio) : m_ratio(ratio) {}

  template <class FT, class Profile, class Size>
  bool operator()(const FT&, const Profile&, Size initial, Size current) const
  {
    return double(current) / double(initial) < m_ratio;
  }

private:
  double m_ratio;
};

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_EDGE_RATIO_STOP_H
