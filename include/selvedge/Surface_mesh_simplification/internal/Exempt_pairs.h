// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EXEMPT_PAIRS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EXEMPT_PAIRS_H

#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Descent.h>
#include <selvedge/Surface_mesh_simplification/internal/Permitted_pairs.h>
#include <selvedge/geometry/face_pair.h>
#include <selvedge/geometry/internal/piercing_depth.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Answers, for the guard, what a collapse does to pairs of faces that offend already: which pairs are exempt
/// from its questions, whether the degenerate faces may go, whether no more pairs offend afterwards, and
/// whether shallow ones stay so.
///
/// It finds the faces and the pairs; `Descent`, which knows them by numbers alone, remembers which descend
/// from which. Nothing is computed where the mesh had no offending faces.
template <class TriangleMesh, class Vertices, class Faces, class GeomTraits>
class Exempt_pairs
{
  using Vertex = typename Vertices::Vertex;
  using Halfedge = typename boost::graph_traits<TriangleMesh>::halfedge_descriptor;
  using Face = typename Faces::Face;
  using Id = typename Faces::Id;
  using Triangle = std::array<typename Vertices::Point, 3>;

public:
  Exempt_pairs(const TriangleMesh& mesh, const Vertices& vertices, Faces& faces, const GeomTraits& traits,
               const Permitted_pairs<Id>& permitted)
      : m_mesh(mesh), m_vertices(vertices), m_faces(faces), m_traits(traits), m_permitted(permitted)
  {
  }

  /// Exempts all pairs that descend from these, which offend at the start. A face of several triangles makes
  /// as many pairs. For `shallow` see `Intersection_filter::exempt`. Call it before the first question.
  void begin(const std::vector<std::pair<Face, Face>>& offending,
             const std::vector<std::pair<Face, unsigned>>& multiplicities, double shallow)
  {
    m_shallow = shallow;
    std::vector<Descent::Pair> pairs;
    for (const auto& [f, g] : offending)
      pairs.push_back({m_faces.id(f), m_faces.id(g)});
    m_descent.begin(pairs, m_faces.size());
    for (const auto& [face, times] : multiplicities)
      m_descent.count_times(m_faces.id(face), times);
  }

  /// Names the collapse that the questions below are about.
  template <class Profile>
  void consider(const Collapse<Profile>& collapse)
  {
    if (m_known && m_known == key(collapse))
      return;
    m_known.reset();
    m_is_concerned = m_descent.is_needed() && find_changes(collapse);
  }

  /// Says that a collapse is part of one that has been done, with all changes of descent.
  void consider_done() { m_is_concerned = false; }

  /// Returns whether a face that the collapse changes or removes descends from an offending one. If not, no
  /// pair with it is exempt, and none offends.
  bool is_concerned() const { return m_is_concerned; }

  /// Returns whether the pairs of a face with those that change are exempt.
  bool is_exempt(Id face) { return m_is_concerned && m_descent.is_exempt(face); }

  /// Returns whether the pairs of two faces that change are exempt.
  bool is_exempt_inside() const { return m_is_concerned && m_descent.is_exempt_inside(); }

  /// Returns whether all degenerate faces at what moves are contracted, each within the segment that it is:
  /// the mover does not pass over the third corner.
  template <class Profile>
  bool may_degenerate_faces_go(const Collapse<Profile>& collapse)
  {
    m_has_degenerate = false;
    if (!m_is_concerned)
      return true;
    for (const Id id : m_considered) {
      if (!m_descent.is_degenerate(id))
        continue;
      m_has_degenerate = true;
      if (collapse.are_both_moved() ||
          std::find(m_changed_ids.begin(), m_changed_ids.end(), id) != m_changed_ids.end() ||
          is_third_corner_passed(id, collapse))
        return false;
    }
    return true;
  }

  /// Returns whether the last question found a degenerate face.
  bool has_degenerate() const { return m_has_degenerate; }

  /// Returns whether no more pairs offend after the collapse than before, and none is deep unless one was. If
  /// not, adds the faces that do not change and would offend to `blockers`.
  template <class Profile>
  bool are_pairs_kept(const Collapse<Profile>& collapse, std::vector<Face>& blockers)
  {
    if (!m_is_concerned || (find_pairs_after(collapse, m_descent.pairs_now()) && is_depth_kept())) {
      m_known = key(collapse);
      return true;
    }
    for (const auto& [changed, other] : m_pairs_after)
      if (std::find(m_considered.begin(), m_considered.end(), other) == m_considered.end())
        blockers.push_back(m_faces.descriptor(other));
    return false;
  }

  /// Called before and after the collapse is done.
  template <class Profile>
  void before_collapse(const Collapse<Profile>& collapse)
  {
    if (m_is_concerned && !m_known)
      find_pairs_after(collapse);
  }
  void after_collapse()
  {
    m_known.reset();
    if (m_is_concerned)
      m_descent.on_collapsed(m_changed_ids, m_pairs_after);
  }

private:
  // The key of a collapse (`Collapse::key`); none where vertices move together.
  using Key = std::optional<std::tuple<Halfedge, bool, typename Vertices::Point>>;
  template <class Profile>
  static Key key(const Collapse<Profile>& collapse)
  {
    if (!collapse.others().empty())
      return {};
    return collapse.key();
  }

  // Finds the faces that a collapse changes or removes. Returns whether they descend from offending ones.
  template <class Profile>
  bool find_changes(const Collapse<Profile>& collapse)
  {
    m_considered.clear();
    m_changed.clear();
    m_changed_ids.clear();
    const auto add_all_at = [&](Vertex mover, Vertex other) {
      for (const auto h : CGAL::halfedges_around_target(halfedge(mover, m_mesh), m_mesh)) {
        if (CGAL::is_border(h, m_mesh))
          continue;
        const Id id = m_faces.id(face(h, m_mesh));
        const Vertex a = target(next(h, m_mesh), m_mesh), b = source(h, m_mesh);
        if (a != other && b != other) {
          m_changed.push_back({collapse.place(), m_vertices.point(m_vertices.number(a)),
                               m_vertices.point(m_vertices.number(b))});
          m_changed_ids.push_back(id);
        } else if (std::find(m_considered.begin(), m_considered.end(), id) != m_considered.end()) {
          continue; // a contracted face of a collapse in which both ends move
        }
        m_considered.push_back(id);
      }
    };
    add_all_at(collapse.mover(), collapse.goal());
    for (const Halfedge h : collapse.others())
      add_all_at(source(h, m_mesh), target(h, m_mesh));
    if (collapse.are_both_moved())
      add_all_at(collapse.goal(), collapse.mover());
    return m_descent.consider(m_considered);
  }

  template <class Profile>
  bool is_third_corner_passed(Id contracted, const Collapse<Profile>& collapse) const
  {
    const auto &from = m_vertices.point(m_vertices.number(collapse.mover())), &to = collapse.place();
    const auto is_equal = m_traits.equal_3_object();
    const auto& corners = m_faces.corners(contracted);
    return std::any_of(corners.begin(), corners.end(), [&](auto corner) {
      const auto& p = m_vertices.point(corner);
      return !is_equal(p, from) && !is_equal(p, to) &&
             m_traits.collinear_are_ordered_along_line_3_object()(from, p, to);
    });
  }

  // Finds the exempt pairs with a changed face that offend after the collapse, in an order that does not
  // depend on the index. When a limit is given, and there are more or two faces come to have the same
  // corners, it stops there and returns false.
  template <class Profile>
  bool find_pairs_after(const Collapse<Profile>& collapse, std::optional<std::size_t> limit = {})
  {
    m_pairs_after.clear();
    std::size_t count = 0;
    const auto is_within_limit = [&](std::size_t i, const Triangle& other, Id id) {
      if (!m_permitted.has(m_changed_ids[i], id) && do_faces_offend(m_changed[i], other, m_traits)) {
        m_pairs_after.push_back({m_changed_ids[i], id});
        count += m_descent.times(m_changed_ids[i], id);
        if (limit && have_same_corners(m_changed[i], other))
          return false;
      }
      return !limit || count <= *limit;
    };
    CGAL::Bbox_3 box;
    for (std::size_t i = 0; i < m_changed.size(); ++i) {
      box += box_of(m_changed[i]);
      if (m_descent.is_exempt_inside())
        for (std::size_t j = 0; j < i; ++j)
          if (!is_within_limit(i, m_changed[j], m_changed_ids[j]))
            return false;
    }
    m_faces.find_near(box, m_vertices.number(collapse.mover()), m_near);
    for (const Halfedge h : collapse.others())
      m_faces.remove_at(m_vertices.number(source(h, m_mesh)), m_near);
    if (collapse.are_both_moved())
      m_faces.remove_at(m_vertices.number(collapse.goal()), m_near);
    m_near.erase(
        std::remove_if(m_near.begin(), m_near.end(), [&](Id id) { return !m_descent.is_exempt(id); }),
        m_near.end());
    std::sort(m_near.begin(), m_near.end());
    for (const Id id : m_near) {
      const Triangle other = triangle(id);
      for (std::size_t i = 0; i < m_changed.size(); ++i)
        if (CGAL::do_overlap(box_of(m_changed[i]), box_of(other)) && !is_within_limit(i, other, id))
          return false;
    }
    return true;
  }

  // Whether no pair found pierces deeper than what is shallow, or one of the pairs now does.
  bool is_depth_kept() const
  {
    return m_shallow == std::numeric_limits<double>::infinity() ||
           std::all_of(m_pairs_after.begin(), m_pairs_after.end(),
                       [&](const Descent::Pair& pair) {
                         return is_shallow(triangle_after(pair.first), triangle_after(pair.second));
                       }) ||
           !m_descent.are_all_pairs_now([&](Id f, Id g) { return is_shallow(triangle(f), triangle(g)); });
  }
  bool is_shallow(const Triangle& f, const Triangle& g) const { return piercing_depth(f, g) <= m_shallow; }

  Triangle triangle(Id id) const
  {
    const auto& [a, b, c] = m_faces.corners(id);
    return {m_vertices.point(a), m_vertices.point(b), m_vertices.point(c)};
  }
  Triangle triangle_after(Id id) const
  {
    const auto found = std::find(m_changed_ids.begin(), m_changed_ids.end(), id);
    return found == m_changed_ids.end() ? triangle(id)
                                        : m_changed[std::size_t(found - m_changed_ids.begin())];
  }

  static bool have_same_corners(const Triangle& f, const Triangle& g)
  {
    return std::is_permutation(f.begin(), f.end(), g.begin());
  }

  static CGAL::Bbox_3 box_of(const Triangle& triangle)
  {
    return triangle[0].bbox() + triangle[1].bbox() + triangle[2].bbox();
  }

  const TriangleMesh& m_mesh;
  const Vertices& m_vertices;
  Faces& m_faces;
  const GeomTraits& m_traits;
  const Permitted_pairs<Id>& m_permitted;
  Descent m_descent;
  double m_shallow = std::numeric_limits<double>::infinity(); // a depth
  bool m_is_concerned = false;
  bool m_has_degenerate = false; // whether a face that the collapse removes is degenerate
  Key m_known;                   // the collapse of which all that is asked here is known

  // Buffers, so that a question allocates nothing.
  std::vector<Id> m_considered, m_changed_ids; // the faces that a collapse changes or removes; changes alone
  std::vector<Triangle> m_changed;             // these after the collapse
  std::vector<Descent::Pair> m_pairs_after;    // exempt pairs with one of them that offend then
  std::vector<Id> m_near;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EXEMPT_PAIRS_H
