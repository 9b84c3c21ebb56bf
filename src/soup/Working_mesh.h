// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_WORKING_MESH_H
#define SELVEDGE_SOUP_WORKING_MESH_H

#include "Place_rounding.h"
#include "Placed_vertices.h"
#include "Progression_recorder.h"
#include "Sewn_mesh.h"
#include "Shared_places.h"
#include "Value_wedges.h"
#include "keeps_pieces.h"
#include "keeps_uv_orientation.h"
#include "vertex_normals.h"

#include <selvedge/Parts.h>
#include <selvedge/Simplify_options.h>
#include <selvedge/Surface_mesh_simplification/No_observer.h>
#include <selvedge/internal/Packed_numbers.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge {

/// A sewn mesh and all that hangs on it, on its way through a reduction, of which it is the observer.
/// `result` makes a soup of it again.
class Working_mesh : public Sewn_mesh, public No_observer
{
public:
  /// Sews a soup: the arguments are those of `Sewn_mesh`.
  Working_mesh(const Triangle_soup& soup, const std::vector<Index>& positions,
               const std::vector<char>& is_frozen, const Triangle_soup& obstacle = {},
               const Scale& scale = Scale(), const std::vector<char>& is_turned = {},
               const std::vector<Index>& fronts = {});

  /// Makes a mesh of some faces of another, as `Sewn_mesh` does. Texture and allowance for new places are
  /// those of the whole. `result`, and counts by the parts of the soup, are asked of the whole only.
  Working_mesh(const Working_mesh& whole, const Border_rule<Mesh>& rule, const std::vector<Index>& faces);

  /// Makes the places of shared meshes one for the reduction: what holds a vertex in one place does so in
  /// all, and motions have companions, as `Shared_places` says.
  ///
  /// **Preconditions** Nothing has been collapsed.
  void share(std::vector<Shared_mesh> meshes, double clearance = 0);
  bool is_shared(Face face) const { return m_shared && m_shared->is_shared(face); }

  /// Makes `uv_cost` say how far the texture is displaced, once `find_wedges` has been called. Before, and
  /// where there is no texture, it is 0. `unit` is the `uv_unit` of the soup at the scale.
  void measure_uvs(double unit);

  /// Makes `normal_cost` say how far normals turn, likewise. `unit` is the `normal_unit` of the soup at the
  /// scale. The normals are those of the corners of the soup, or others, by vertex of the soup.
  void measure_normals(double unit, std::shared_ptr<const Vertex_normals> normals = nullptr);

  /// Finds the values around each vertex that are to be measured. Others may read the mesh meanwhile.
  ///
  /// **Preconditions** Weights are set, and nothing has been collapsed.
  void find_wedges();

  /// Forgets these values, when nothing more is collapsed.
  void forget_wedges()
  {
    m_texture.reset();
    m_shading.reset();
  }

  /// Makes `rounded_place` return places from now on, as `Place_rounding` does; before, it returns none.
  void allow_new_places(bool is_float32);

  /// Restricts these places to those for which `is_allowed` returns true.
  void restrict_new_places(std::function<bool(const Point_3&)> is_allowed)
  {
    if (m_rounding)
      m_rounding->restrict(std::move(is_allowed));
  }

  /// Starts to count refusals by the parts of the soup to which the moving vertex belongs.
  void count_refusals();

  /// The refusals so far, for each of the `part_kinds` of the soup and each of its parts.
  const std::vector<std::vector<Refusals>>& refused_by_part() const { return m_refused; }

  /// Sets a function that is called before each collapse, as `Simplify_options::on_collapse` is.
  void on_collapse(std::function<void(const Soup_collapse&)> listener) { m_listener = std::move(listener); }

  /// A collapse such that it can be repeated in another mesh of the same triangles.
  struct Collapse
  {
    Side moving;
    std::optional<Point_3> place; ///< where both ends go, if that is not an end
    bool is_mover_first = false;
  };

  /// Sets a function that is called before each collapse.
  void record(std::function<void(const Collapse&)> recorder) { m_recorder = std::move(recorder); }

  /// Makes `progression` hold the wedges of the soup, and records every step in it from now on.
  ///
  /// **Preconditions** Nothing has been collapsed, and no vertex goes to a new place. `progression` outlives
  /// the mesh.
  void record_progression(Progression& progression)
  {
    m_progression.emplace(*this, constraints(), progression);
  }

  // Called by the reduction, see `No_observer`.
  using Sewn_mesh::line_reason;
  using Sewn_mesh::lock_reason;
  void before_collapse(Halfedge moving, const Border_rule<Mesh>& rule);
  void before_joint_collapse(Halfedge moving, const Border_rule<Mesh>& rule) { carry_all(moving, rule); }
  void before_placement(Halfedge moving, const Point_3& place, bool is_mover_first);
  void after_step()
  {
    if (m_progression)
      m_progression->end_step();
  }
  internal::Optional<Point_3> rounded_place(Halfedge edge, const Point_3& place) const;
  void on_refused(Halfedge moving, const Refusals& refusals);
  void on_hindered(Mesh::Edge_index e, Hindrance reason);
  bool keeps_pieces(Halfedge moving, const Border_rule<Mesh>& rule) const
  {
    return selvedge::keeps_pieces(*this, moving, rule);
  }
  bool keeps_joints(Halfedge moving, const std::vector<Halfedge>& others) const
  {
    return selvedge::keeps_joints(*this, moving, others);
  }
  bool keeps_uv_orientation(Halfedge moving, const Border_rule<Mesh>& rule) const
  {
    return selvedge::keeps_uv_orientation(*this, m_placed, moving, rule);
  }
  bool keeps_uv_orientation_at(Halfedge moving, const Point_3& place) const
  {
    return selvedge::keeps_uv_orientation_at(*this, m_placed, moving, place);
  }
  std::vector<Halfedge> companions(Halfedge moving) const
  {
    return m_shared ? m_shared->companions(moving) : std::vector<Halfedge>();
  }
  bool are_companions_apart(Halfedge moving, const std::vector<Halfedge>& companions) const
  {
    return m_shared->are_apart(moving, companions);
  }
  bool is_led(Halfedge edge) const { return m_shared && m_shared->is_led(edge); }
  bool adds_to_costs() const { return m_texture || m_shading; }
  double uv_cost(Halfedge moving) const { return m_texture ? m_texture->cost(moving) : 0; }
  double uv_cost_at(Halfedge edge, const Point_3& place) const
  {
    return m_texture ? m_texture->cost_at(edge, place) : 0;
  }
  double normal_cost(Halfedge moving) const { return m_shading ? m_shading->cost(moving) : 0; }
  double normal_cost_at(Halfedge edge, const Point_3& place) const
  {
    return m_shading ? m_shading->cost_at(edge, place) : 0;
  }

  /// What is left of the soup.
  struct Result
  {
    Triangle_soup soup;
    std::vector<Index> triangles;      ///< of the input, in its order
    std::vector<Index_triple> corners; ///< of the input, now of each triangle: 3 × triangle + place in it
    std::vector<char> is_placed;       ///< by vertex, as in `Simplified_soup`
    std::vector<Hindrance> held_by;    ///< as in `Simplified_soup`
  };
  Result result() const;

private:
  // Calls function(wedges) with those of the texture and of normals that are measured.
  template <class Function>
  void for_each_measure(const Function& function)
  {
    if (m_texture)
      function(*m_texture);
    if (m_shading)
      function(*m_shading);
  }

  void carry_all(Halfedge moving, const Border_rule<Mesh>& rule);
  Hindrance hindrance_of(Face face) const;

  Scale m_scale;
  Placed_vertices m_placed;
  std::optional<Place_rounding> m_rounding;               // none until new places are allowed
  double m_uv_unit = 0, m_normal_unit = 0;                // 0 where they are not measured
  std::optional<Texture_wedges> m_texture;                // none until wedges are found, or if not measured
  std::optional<Shading_wedges> m_shading;                // the same
  std::shared_ptr<const Vertex_normals> m_vertex_normals; // null where it is that of normals of the soup
  std::optional<Shared_places> m_shared;                  // none until meshes are shared
  std::optional<Progression_recorder> m_progression;
  std::function<void(const Soup_collapse&)> m_listener;
  std::function<void(const Collapse&)> m_recorder;

  // What holds back the three edges of each face; empty until the reduction says so.
  std::vector<std::array<std::optional<Hindrance>, 3>> m_hindrances;

  internal::Packed_numbers m_piece_of_vertex; // by vertex of the soup; empty until refusals are counted
  std::vector<std::vector<Refusals>> m_refused;
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_WORKING_MESH_H
