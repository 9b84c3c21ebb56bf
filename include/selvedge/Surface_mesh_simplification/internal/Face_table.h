// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FACE_TABLE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FACE_TABLE_H

#include <selvedge/Surface_mesh_simplification/internal/Element_numbers.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>
#include <selvedge/geometry/internal/Star_pack_filter.h>
#include <selvedge/internal/Vector_of_doubles.h>
#include <selvedge/internal/instructions.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Dynamic_property_map.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Whether an index wants to know the corners of faces, and not their boxes alone.
template <class FaceIndex, class = void>
struct Wants_corners : std::false_type
{
};
template <class FaceIndex>
struct Wants_corners<FaceIndex, std::void_t<typename FaceIndex::Corners>> : std::true_type
{
};

/// Numbers the faces of a mesh, and keeps the corners of each and an index of their boxes.
///
/// It answers which faces the guard must compare with a moving star, and what their corners are, without
/// asking the mesh. The guard calls it at every collapse to keep it up to date.
template <class TriangleMesh, class VertexTable, class FaceIndex>
class Face_table
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Number = typename VertexTable::Number;
  using Point = typename VertexTable::Point;
  // In other kernels, coordinates may be exact numbers that no double represents.
  static constexpr bool s_are_coordinates_doubles =
      std::is_same_v<typename CGAL::Kernel_traits<Point>::Kernel::FT, double>;
  static constexpr bool s_are_corners_wanted = Wants_corners<FaceIndex>::value && s_are_coordinates_doubles;

public:
  using Face = typename Graph_traits::face_descriptor;
  using Id = typename FaceIndex::Id;
  using Corners = std::array<Number, 3>;

  Face_table(const TriangleMesh& mesh, const VertexTable& vertices, FaceIndex&& empty_index)
      : m_mesh(mesh), m_vertices(vertices), m_index(std::move(empty_index)), m_numbers(mesh, faces(mesh)),
        m_size(m_numbers.size())
  {
    m_corners.reserve(m_size);
    for (const Face face : faces(mesh))
      m_corners.push_back(find_corners(halfedge(face, mesh)));
    std::vector<Id> ids(m_size);
    std::iota(ids.begin(), ids.end(), Id(0));
    const auto box_of = [this](Id id) { return box(id); };
    if constexpr (s_are_corners_wanted)
      m_index.build(ids, box_of, coordinates());
    else
      m_index.build(ids, box_of);
  }

  Face descriptor(Id id) const { return m_numbers.element(id); }
  Id id(Face face) const { return m_numbers.number(face); }
  const Corners& corners(Id id) const { return m_corners[id]; }
  /// Returns whether no collapse has removed the face.
  bool is_left(Id id) const { return m_corners[id][0] != s_no_corner; }
  bool is_at(Id id, Number vertex) const
  {
    const auto& [a, b, c] = corners(id);
    return a == vertex || b == vertex || c == vertex;
  }

  /// Finds the faces whose boxes meet a box, except those at the vertex `mover`. The corners of all of them
  /// are prefetched before any is looked at.
  void find_near(const CGAL::Bbox_3& box, Number mover, std::vector<Id>& near)
  {
    near.clear();
    m_index.visit_overlapping(box, collect(near));
    remove_at(mover, near);
  }

  /// Likewise, for the hull of some points in the box. It may leave out faces that do not meet this.
  template <class Points>
  void find_near(const CGAL::Bbox_3& box, const Points& points, Number mover, std::vector<Id>& near)
  {
    if constexpr (s_are_corners_wanted) {
      near.clear();
      m_index.visit_overlapping(box, points, collect(near));
      remove_at(mover, near);
    } else {
      find_near(box, mover, near);
    }
  }

  /// Adds all faces at `vertex` except those at `mover` to a list that has none of them: for a vertex that is
  /// judged as if it stood elsewhere than in the index.
  void add_all_at(Vertex vertex, Number mover, std::vector<Id>& near) const
  {
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(vertex, m_mesh), m_mesh))
      if (!CGAL::is_border(h, m_mesh))
        if (const Id of_h = id(face(h, m_mesh)); !is_at(of_h, mover))
          near.push_back(of_h);
  }

  /// The sweeps of a star, one bit for each, that are not known to be clear of a face.
  using Sweeps = Star_pack_filter::Mask;

  /// Removes the faces that a filter proves clear of its star from a list of faces, none of which is at the
  /// mover, and finds for each of the others the sweeps that are not proved clear of it.
  void remove_clear(Star_pack_filter& filter, std::vector<Id>& near, std::vector<Sweeps>& unclear)
  {
    unclear.clear();
    if constexpr (s_are_coordinates_doubles)
      if (filter.is_usable())
        remove_clear_in_packs(filter, near, unclear);
    unclear.resize(near.size(), ~Sweeps(0));
  }

  /// Removes the faces at a vertex from a list of faces.
  void remove_at(Number vertex, std::vector<Id>& near) const
  {
    near.erase(std::remove_if(near.begin(), near.end(), [&](Id id) { return is_at(id, vertex); }),
               near.end());
  }

  /// Called before a collapse removes the face of `h`, a halfedge of its edge; a border halfedge has none.
  void on_removing(Halfedge h)
  {
    if (CGAL::is_border(h, m_mesh))
      return;
    const Id removed = id(face(h, m_mesh));
    m_index.remove(removed);
    m_corners[removed].fill(s_no_corner);
    --m_size;
  }

  /// Called after a collapse, when the mesh and the vertex table have the merged vertex.
  void on_collapsed(Vertex kept)
  {
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(kept, m_mesh), m_mesh))
      if (!CGAL::is_border(h, m_mesh)) {
        const Id id = m_numbers.number(face(h, m_mesh));
        m_corners[id] = find_corners(h);
        if constexpr (s_are_corners_wanted)
          m_index.set(id, box(id), coordinates());
        else
          m_index.set(id, box(id));
      }
    m_is_number_current = m_is_number_current || std::size_t(num_faces(m_mesh)) == m_size;
  }

  const FaceIndex& index() const { return m_index; }

  /// Returns whether all faces of the mesh have the corners that they have here.
  bool are_in_place() const
  {
    const auto all = faces(m_mesh);
    return std::all_of(all.begin(), all.end(), [this](Face face) {
      const Id of_face = id(face);
      if (of_face >= m_corners.size())
        return false;
      Corners before = corners(of_face), now = find_corners(halfedge(face, m_mesh));
      std::rotate(before.begin(), std::min_element(before.begin(), before.end()), before.end());
      std::rotate(now.begin(), std::min_element(now.begin(), now.end()), now.end());
      return before == now;
    });
  }

  /// Returns the number of faces that have not been removed.
  std::size_t size() const { return m_size; }

  /// Returns whether the mesh has as many faces as have not been removed here.
  ///
  /// num_faces() of some meshes counts removed faces as well. It does not where it has once gone down with
  /// the number here; until then, all faces are counted, which takes long.
  bool are_all_in_mesh() const
  {
    return (m_is_number_current ? std::size_t(num_faces(m_mesh)) : current_faces(m_mesh)) == m_size;
  }

private:
  static constexpr Number s_no_corner = Number(-1);

  void remove_clear_in_packs(Star_pack_filter& filter, std::vector<Id>& near, std::vector<Sweeps>& unclear)
  {
    constexpr std::size_t width = Star_pack_filter::width;
    // All packs are filled before the first is asked, which would wait for what has just been stored.
    m_packs.resize(near.size() / width + 1);
    for (std::size_t i = 0; i < near.size(); ++i)
      m_packs[i / width].set(i % width, corners(near[i]), coordinates_from(filter.origin(), near[i]));
    const auto for_each_pack = [&](const auto& function) {
      const std::size_t size = near.size();
      for (std::size_t first = 0; first < size; first += width)
        function(m_packs[first / width], first, (std::min)(width, size - first));
    };
    std::size_t left = 0;
    for_each_pack([&](const auto& pack, std::size_t first, std::size_t count) {
      for (auto rest = filter.unclear(pack, count); rest != 0; rest &= rest - 1) {
        const std::size_t i = lowest_bit(rest);
        m_packs[left / width].set(left % width, pack, i);
        near[left++] = near[first + i];
      }
    });
    near.resize(std::exchange(left, 0));
    for_each_pack([&](const auto& pack, std::size_t first, std::size_t count) {
      Star_pack_filter::Sweeps of_pack;
      filter.find_unclear(pack, of_pack);
      for (std::size_t i = 0; i < count; ++i)
        if (of_pack[i] != 0) {
          near[left++] = near[first + i];
          unclear.push_back(of_pack[i]);
        }
    });
    near.resize(left);
  }

  Corners find_corners(Halfedge h) const
  {
    return {m_vertices.number(source(h, m_mesh)), m_vertices.number(target(h, m_mesh)),
            m_vertices.number(target(next(h, m_mesh), m_mesh))};
  }

  auto collect(std::vector<Id>& near) const
  {
    return [&near, this](Id id) {
      prefetch(m_corners[id]);
      near.push_back(id);
    };
  }

  std::array<Vector_of_doubles, 3> coordinates_from(const Vector_of_doubles& origin, Id id) const
  {
    std::array<Vector_of_doubles, 3> result;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& p = m_vertices.point(corners(id)[i]);
      result[i] = {p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
    }
    return result;
  }
  auto coordinates() const
  {
    return [this](Id id) { return coordinates_from({0, 0, 0}, id); };
  }

  CGAL::Bbox_3 box(Id id) const
  {
    const Point &a = m_vertices.point(corners(id)[0]), &b = m_vertices.point(corners(id)[1]),
                &c = m_vertices.point(corners(id)[2]);
    if constexpr (s_are_coordinates_doubles) { // the same in a third of the instructions
      const auto least = [&](int axis) { return (std::min)((std::min)(a[axis], b[axis]), c[axis]); };
      const auto most = [&](int axis) { return (std::max)((std::max)(a[axis], b[axis]), c[axis]); };
      return {least(0), least(1), least(2), most(0), most(1), most(2)};
    } else {
      return a.bbox() + b.bbox() + c.bbox();
    }
  }

  const TriangleMesh& m_mesh;
  const VertexTable& m_vertices;
  FaceIndex m_index;
  Element_numbers<TriangleMesh, Face, CGAL::dynamic_face_property_t> m_numbers;
  std::size_t m_size;
  bool m_is_number_current = false; // whether num_faces() counts no removed faces, as far as is known
  std::vector<Corners> m_corners;   // by number: in the mesh, they are five look-ups away
  std::vector<Star_pack_filter::Pack> m_packs; // a buffer
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FACE_TABLE_H
