// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_BENCHMARK_CGAL_EXAMPLES_RUN_LOOP_H
#define SELVEDGE_TEST_BENCHMARK_CGAL_EXAMPLES_RUN_LOOP_H

#include <selvedge/Surface_mesh_simplification/Visitor_chain.h>
#include <selvedge/Surface_mesh_simplification/edge_collapse.h>

#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <memory>
#include <string>

namespace selvedge::recorded {

/// Writes a line for each collapse to steps.txt: its cost, and where the two ends of its edge are.
class Step_recorder : public internal::No_visitor
{
public:
  Step_recorder() : m_out(std::make_shared<std::ofstream>("steps.txt", std::ios::app))
  {
    m_out->precision(std::numeric_limits<double>::max_digits10);
  }

  template <class TriangleMesh>
  void OnStarted(TriangleMesh&)
  {
    *m_out << "run\n";
  }
  template <class Profile, class OptionalCost, class Size>
  void OnSelected(const Profile&, const OptionalCost& cost, Size, Size)
  {
    m_cost = cost ? CGAL::to_double(*cost) : -1;
  }
  template <class Profile, class OptionalPoint>
  void OnCollapsing(const Profile& profile, const OptionalPoint&)
  {
    *m_out << m_cost << ' ' << profile.p0() << ' ' << profile.p1() << '\n';
  }

private:
  std::shared_ptr<std::ofstream> m_out; // CGAL's loop copies its visitor
  double m_cost = -1;
};

/// Runs the loop of CGAL or that of Selvedge, as the environment says.
template <class TriangleMesh, class Stop, class Parameters>
int run_loop(TriangleMesh& mesh, const Stop& stop, const Parameters& parameters)
{
  const auto visitor = CGAL::parameters::choose_parameter<internal::No_visitor>(
      CGAL::parameters::get_parameter(parameters, CGAL::internal_np::visitor));
  const auto recording = parameters.visitor(Visitor_chain(Step_recorder(), visitor));
  return std::getenv("RECORDED_LOOP") == std::string("cgal")
             ? CGAL::Surface_mesh_simplification::edge_collapse(mesh, stop, recording)
             : selvedge::edge_collapse(mesh, stop, recording);
}

} // namespace selvedge::recorded

#endif // SELVEDGE_TEST_BENCHMARK_CGAL_EXAMPLES_RUN_LOOP_H
