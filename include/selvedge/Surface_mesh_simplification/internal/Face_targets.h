// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FACE_TARGETS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FACE_TARGETS_H

#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>

#include <CGAL/Dynamic_property_map.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace selvedge {

/// Counts faces against targets: how many there are and how many are to be left, in each *share* of a mesh.
///
/// Every face belongs to one share, at first to share 0. The target of a share is 0 until it is set. A share
/// that has reached its target loses no further face. Faces can also be left uncounted, or count several
/// times.
///
/// It serves as a predicate for `Halfedge_filter`, as a stop, and as a listener of collapses. Copies share
/// one state.
///
/// **Preconditions** The mesh outlives the targets. `before_collapse` is called before every collapse.
template <class TriangleMesh>
class Face_targets
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;

public:
  using Face = typename Graph_traits::face_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;

  struct Share
  {
    std::size_t faces = 0; ///< that it has now
    std::size_t fixed = 0; ///< of these, those that cannot change, because all their corners are locked
    std::size_t asked = 0; ///< the target as it was set
    std::size_t least = 0; ///< what no target is below

    std::size_t target() const { return (std::max)(least, asked); }

    /// Returns the target for a ratio of the faces that it has now: the ratio is of those that are not fixed.
    std::size_t at_ratio(double ratio) const
    {
      return (std::max)(least, fixed + Face_ratio_stop::face_target(ratio, faces - fixed));
    }

    std::size_t excess() const { return faces - (std::min)(faces, target()); }
  };

  /// Sums over all shares.
  struct Total
  {
    std::size_t faces = 0, fixed = 0, target = 0;
    std::size_t excess = 0;       ///< of faces over targets
    std::size_t excess_asked = 0; ///< the same for the targets as they were set
  };

  explicit Face_targets(const TriangleMesh& mesh) : m_state(std::make_shared<State>(mesh)) {}

  const Share& share(std::size_t number) const { return m_state->shares[number]; }
  const std::vector<Share>& shares() const { return m_state->shares; }
  void set_target(std::size_t number, std::size_t target) { m_state->shares[number].asked = target; }
  void set_least(std::size_t number, std::size_t faces) { m_state->shares[number].least = faces; }

  bool has_several_shares() const { return m_state->shares.size() > 1; }

  /// Makes a new, empty share and returns its number.
  std::size_t add_share()
  {
    m_state->shares.emplace_back();
    return m_state->shares.size() - 1;
  }

  /// Makes a face count several times.
  void count_times(Face face, unsigned times)
  {
    uncount(face);
    change(face, [&](Record& record) { record.further_times = times - 1; });
    share_of(face).faces += times;
  }

  /// `assign` moves a face to a share, `leave_out` takes it out of the count.
  void assign(Face face, std::size_t number)
  {
    uncount(face);
    change(face, [&](Record& record) { record.share = std::uint32_t(number); });
    m_state->shares[number].faces += times(face);
  }
  void leave_out(Face face)
  {
    uncount(face);
    change(face, [&](Record& record) { record.share = s_uncounted; });
    m_state->are_all_counted = false;
  }

  /// Counts the fixed faces of every share. `locked` are the vertices that never move. Call it when all faces
  /// have been assigned or left out.
  template <class Vertices>
  void fix(const Vertices& locked)
  {
    const TriangleMesh& mesh = m_state->mesh;
    const auto is_locked = get(CGAL::dynamic_vertex_property_t<unsigned char>(), mesh);
    for (const auto v : vertices(mesh))
      put(is_locked, v, false);
    for (const auto v : locked)
      put(is_locked, v, true);
    for (const Face face : faces(mesh)) {
      const auto corners = CGAL::vertices_around_face(halfedge(face, mesh), mesh);
      if (is_counted(face) &&
          std::all_of(corners.begin(), corners.end(), [&](auto v) { return get(is_locked, v); })) {
        share_of(face).fixed += times(face);
        change(face, [&](Record& record) { record.is_fixed = true; });
      }
    }
  }

  bool is_counted(Face face) const { return record(face).share != s_uncounted; }

  /// Returns whether a face at the edge of `h` is counted.
  bool is_counted(Halfedge h) const
  {
    return m_state->are_all_counted || any_beside(h, [this](Face face) { return is_counted(face); });
  }

  /// Returns whether a face at the edge of `h` is counted and not fixed.
  bool is_changeable(Halfedge h) const
  {
    return any_beside(h, [this](Face face) { return is_counted(face) && !record(face).is_fixed; });
  }

  /// Returns whether the edge of `h` may collapse: not when one of its faces is of a share at its target.
  bool operator()(Halfedge h) const
  {
    return !any_beside(h, [this](Face face) { return is_counted(face) && share_of(face).excess() == 0; });
  }

  /// Called before the edge of `h` collapses: its faces leave the count.
  void before_collapse(Halfedge h)
  {
    any_beside(h, [this](Face face) {
      uncount(face);
      return false;
    });
  }

  /// Returns whether every share has reached its target.
  bool is_reached() const
  {
    return std::all_of(m_state->shares.begin(), m_state->shares.end(),
                       [](const Share& share) { return share.excess() == 0; });
  }

  Total total() const
  {
    Total total;
    for (const Share& share : m_state->shares) {
      total.faces += share.faces;
      total.fixed += share.fixed;
      total.target += share.target();
      total.excess += share.excess();
      total.excess_asked += share.faces - (std::min)(share.faces, share.asked);
    }
    return total;
  }

private:
  static constexpr std::uint32_t s_uncounted = (std::numeric_limits<std::uint32_t>::max)();

  struct Record
  {
    std::uint32_t share = 0;
    unsigned further_times = 0;
    bool is_fixed = false;
  };
  using Record_map =
      typename boost::property_map<TriangleMesh, CGAL::dynamic_face_property_t<Record>>::const_type;

  struct State
  {
    explicit State(const TriangleMesh& mesh_) : mesh(mesh_), shares(1)
    {
      shares.front().faces = internal::face_count(mesh_);
    }

    const TriangleMesh& mesh;
    std::optional<Record_map> records; // none while all are as they are made: in most meshes, to the end
    std::vector<Share> shares;
    bool are_all_counted = true;
  };

  Record record(Face face) const { return m_state->records ? get(*m_state->records, face) : Record(); }
  template <class Function>
  void change(Face face, const Function& function)
  {
    auto& records = m_state->records;
    if (!records) {
      records = get(CGAL::dynamic_face_property_t<Record>(), m_state->mesh);
      for (const Face any : faces(m_state->mesh))
        put(*records, any, Record());
    }
    Record changed = get(*records, face);
    function(changed);
    put(*records, face, changed);
  }

  unsigned times(Face face) const { return 1 + record(face).further_times; }
  Share& share_of(Face face) const { return m_state->shares[record(face).share]; }

  void uncount(Face face)
  {
    if (is_counted(face))
      share_of(face).faces -= times(face);
  }

  template <class Predicate>
  bool any_beside(Halfedge h, const Predicate& is_so) const
  {
    const TriangleMesh& mesh = m_state->mesh;
    const Halfedge other = opposite(h, mesh);
    const bool is_left = !CGAL::is_border(h, mesh) && is_so(face(h, mesh));
    return is_left || (!CGAL::is_border(other, mesh) && is_so(face(other, mesh)));
  }

  std::shared_ptr<State> m_state;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FACE_TARGETS_H
