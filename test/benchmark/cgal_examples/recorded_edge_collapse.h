// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_BENCHMARK_CGAL_EXAMPLES_RECORDED_EDGE_COLLAPSE_H
#define SELVEDGE_TEST_BENCHMARK_CGAL_EXAMPLES_RECORDED_EDGE_COLLAPSE_H

#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Visitor_chain.h>
#include <selvedge/Surface_mesh_simplification/edge_collapse.h>

#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <string>

namespace selvedge::recorded {

/// Writes a mesh to a text file, exactly.
template <class TriangleMesh>
void write_off(const std::string& file, const TriangleMesh& mesh)
{
  const auto points = get(CGAL::vertex_point, mesh);
  std::map<typename boost::graph_traits<TriangleMesh>::vertex_descriptor, std::size_t> numbers;
  std::ofstream out(file);
  out.precision(std::numeric_limits<double>::max_digits10);
  std::size_t vertex_count = 0, face_count = 0;
  for ([[maybe_unused]] const auto v : vertices(mesh))
    ++vertex_count;
  for ([[maybe_unused]] const auto face : faces(mesh))
    ++face_count;
  out << "OFF\n" << vertex_count << ' ' << face_count << " 0\n";
  for (const auto v : vertices(mesh)) {
    numbers.emplace(v, numbers.size());
    const auto& p = get(points, v);
    out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
  for (const auto face : faces(mesh)) {
    out << 3;
    for (const auto v : CGAL::vertices_around_face(halfedge(face, mesh), mesh))
      out << ' ' << numbers.at(v);
    out << '\n';
  }
}

/// Runs the loop of CGAL or that of Selvedge, as the environment says, or that of Selvedge with an
/// `Intersection_filter` upon the filter of the example, in the copies that `cgal_examples.py` makes for it.
template <class TriangleMesh, class Stop, class Parameters>
int collapse(TriangleMesh& mesh, const Stop& stop, const Parameters& parameters)
{
  namespace np = CGAL::internal_np;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
#ifndef RECORDED_WITH_FILTER
  // Here the environment says which loop runs, so that one program serves for both. Each collapse is
  // recorded. The copies that `cgal_examples.py` makes include run_loop.h before this header.
  return run_loop(mesh, stop, parameters);
#else
  const auto base = choose_parameter<No_filter>(get_parameter(parameters, np::filter));
  const auto visitor = choose_parameter<internal::No_visitor>(get_parameter(parameters, np::visitor));
  const auto filter = intersection_filter(mesh, CGAL::parameters::filter(base));
  return selvedge::edge_collapse(mesh, stop,
                                 parameters.filter(filter).visitor(Visitor_chain(filter.visitor(), visitor)));
#endif
}

/// Returns the number of a run of the program, from 1 on.
inline int next_run()
{
  static int s_runs = 0;
  return ++s_runs;
}

/// Collapses edges as an example of CGAL asks for, and records the run: the mesh before and after it in the
/// files before_N.off and after_N.off, and the number of edges removed in the N-th line of removed.txt.
template <class TriangleMesh, class Stop, class Parameters = CGAL::parameters::Default_named_parameters>
int edge_collapse(TriangleMesh& mesh, const Stop& stop,
                  const Parameters& parameters = CGAL::parameters::default_values())
{
  const std::string number = std::to_string(next_run());
  write_off("before_" + number + ".off", mesh);
  try {
    const int removed = collapse(mesh, stop, parameters);
    write_off("after_" + number + ".off", mesh);
    std::ofstream("removed.txt", std::ios::app) << removed << '\n';
    return removed;
  } catch (const std::exception& error) {
    std::cerr << '\n' << error.what() << '\n';
    std::exit(3);
  }
}

} // namespace selvedge::recorded

#endif // SELVEDGE_TEST_BENCHMARK_CGAL_EXAMPLES_RECORDED_EDGE_COLLAPSE_H
