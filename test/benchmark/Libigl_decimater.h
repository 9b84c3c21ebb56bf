// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BENCHMARK_LIBIGL_DECIMATER_H
#define SELVEDGE_BENCHMARK_LIBIGL_DECIMATER_H

#include <selvedge/Error.h>
#include <selvedge/Triangle_soup.h>

#include <igl/AABB.h>
#include <igl/connect_boundary_to_infinity.h>
#include <igl/decimate.h>
#include <igl/edge_flaps.h>
#include <igl/intersection_blocking_collapse_edge_callbacks.h>
#include <igl/is_edge_manifold.h>
#include <igl/max_faces_stopping_condition.h>
#include <igl/per_vertex_point_to_plane_quadrics.h>
#include <igl/qslim_optimal_collapse_edge_callbacks.h>
#include <igl/quadric_binary_plus_operator.h>

#include <cstddef>
#include <limits>
#include <tuple>
#include <vector>

namespace selvedge::benchmark {

/// libigl's decimation of a soup with its callbacks that block intersections, as qslim takes them: its
/// quadrics, asked at both ends of an edge, of which the cheaper is where the merged vertex goes.
class Libigl_decimater
{
public:
  explicit Libigl_decimater(const Triangle_soup& soup)
      : m_points(row(soup.points.size()), 3), m_triangles(row(soup.triangles.size()), 3)
  {
    for (std::size_t v = 0; v < soup.points.size(); ++v)
      m_points.row(row(v)) << soup.points[v].x(), soup.points[v].y(), soup.points[v].z();
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        m_triangles(row(t), k) = static_cast<int>(soup.triangles[t][static_cast<std::size_t>(k)]);
  }

  /// Calls `on_collapse(removed, kept)` with libigl's numbers of both vertices, at first those of the soup;
  /// the lower of the two is the number of what they have become. Throws `Input_error` if the soup is no
  /// manifold.
  template <class On_collapse>
  void reduce_to(std::size_t faces, const On_collapse& on_collapse)
  {
    // As igl::qslim does it.
    Eigen::MatrixXd all_points;
    Eigen::MatrixXi all_triangles;
    auto* tree = new igl::AABB<Eigen::MatrixXd, 3>();
    tree->init(m_points, m_triangles);
    igl::connect_boundary_to_infinity(m_points, m_triangles, all_points, all_triangles);
    if (!igl::is_edge_manifold(all_triangles))
      throw Input_error("the mesh is no manifold, and libigl cannot reduce it");
    Eigen::VectorXi edge_map;
    Eigen::MatrixXi edges, edge_faces, edge_corners;
    igl::edge_flaps(all_triangles, edges, edge_map, edge_faces, edge_corners);
    std::vector<Quadric> quadrics;
    igl::per_vertex_point_to_plane_quadrics(all_points, all_triangles, edge_map, edge_faces, edge_corners,
                                            quadrics);
    int v1 = -1, v2 = -1;
    igl::decimate_cost_and_placement_callback optimal;
    igl::decimate_pre_collapse_callback pre_collapse;
    igl::decimate_post_collapse_callback post_collapse;
    igl::qslim_optimal_collapse_edge_callbacks(edges, quadrics, v1, v2, optimal, pre_collapse, post_collapse);
    igl::intersection_blocking_collapse_edge_callbacks(pre_collapse, post_collapse, tree, pre_collapse,
                                                       post_collapse);

    const igl::decimate_cost_and_placement_callback at_cheaper_end = [&](int e, const auto& V, const auto&,
                                                                         const auto& E, const auto&,
                                                                         const auto&, const auto&,
                                                                         double& cost,
                                                                         Eigen::RowVectorXd& place) {
      const Quadric quadric = igl::operator+(quadrics[static_cast<std::size_t>(E(e, 0))],
                                             quadrics[static_cast<std::size_t>(E(e, 1))]);
      cost = std::numeric_limits<double>::infinity();
      place = V.row(E(e, 0));
      for (int end = 0; end < 2; ++end)
        if (const double c = cost_at(quadric, V.row(E(e, end))); c < cost) { // false for what is not a number
          cost = c;
          place = V.row(E(e, end));
        }
    };

    std::size_t removed = 0, kept = 0;
    const igl::decimate_pre_collapse_callback noting =
        [&](const auto& V, const auto& F, const auto& E, const auto& EMAP, const auto& EF, const auto& EI,
            const auto& Q, const auto& EQ, const auto& C, int e) {
          const bool is_first_kept = C.row(e) == V.row(E(e, 0));
          kept = static_cast<std::size_t>(E(e, is_first_kept ? 0 : 1));
          removed = static_cast<std::size_t>(E(e, is_first_kept ? 1 : 0));
          return pre_collapse(V, F, E, EMAP, EF, EI, Q, EQ, C, e);
        };
    const igl::decimate_post_collapse_callback logging =
        [&](const auto& V, const auto& F, const auto& E, const auto& EMAP, const auto& EF, const auto& EI,
            const auto& Q, const auto& EQ, const auto& C, int e, int e1, int e2, int f1, int f2,
            bool is_collapsed) {
          if (is_collapsed)
            on_collapse(removed, kept);
          post_collapse(V, F, E, EMAP, EF, EI, Q, EQ, C, e, e1, e2, f1, f2, is_collapsed);
        };

    int face_count = static_cast<int>(m_triangles.rows());
    igl::decimate(all_points, all_triangles, at_cheaper_end,
                  igl::max_faces_stopping_condition(face_count, face_count, static_cast<int>(faces)), noting,
                  logging, m_points_left, m_triangles_left, m_born_triangles, m_born_vertices);
    delete tree;
  }

  /// Returns the triangles that are left, in libigl's numbers.
  std::vector<Index_triple> triangles() const
  {
    return triangles_left([this](int vertex) { return static_cast<Index>(m_born_vertices(vertex)); });
  }

  /// Returns what is left.
  Triangle_soup soup() const
  {
    Triangle_soup result;
    std::vector<Index> number(static_cast<std::size_t>(m_points_left.rows()), Index(-1));
    result.triangles = triangles_left([&](int vertex) {
      Index& known = number[static_cast<std::size_t>(vertex)];
      if (known == Index(-1)) {
        known = static_cast<Index>(result.points.size());
        result.points.emplace_back(m_points_left(vertex, 0), m_points_left(vertex, 1),
                                   m_points_left(vertex, 2));
      }
      return known;
    });
    return result;
  }

private:
  using Quadric = std::tuple<Eigen::MatrixXd, Eigen::RowVectorXd, double>;

  template <class Number_of>
  std::vector<Index_triple> triangles_left(const Number_of& number_of) const
  {
    std::vector<Index_triple> result;
    for (Eigen::Index t = 0; t < m_triangles_left.rows(); ++t)
      if (m_born_triangles(t) < m_triangles.rows()) { // the others go to infinity
        Index_triple& triangle = result.emplace_back();
        for (int k = 0; k < 3; ++k)
          triangle[static_cast<std::size_t>(k)] = number_of(m_triangles_left(t, k));
      }
    return result;
  }

  static Eigen::Index row(std::size_t number) { return static_cast<Eigen::Index>(number); }

  static double cost_at(const Quadric& quadric, const Eigen::RowVectorXd& p)
  {
    const auto& [a, b, c] = quadric;
    return p.dot(p * a) + 2 * p.dot(b) + c;
  }

  Eigen::MatrixXd m_points, m_points_left;
  Eigen::MatrixXi m_triangles, m_triangles_left;
  Eigen::VectorXi m_born_triangles, m_born_vertices;
};

} // namespace selvedge::benchmark

#endif // SELVEDGE_BENCHMARK_LIBIGL_DECIMATER_H
