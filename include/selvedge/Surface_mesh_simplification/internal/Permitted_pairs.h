// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_PERMITTED_PAIRS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_PERMITTED_PAIRS_H

#include <selvedge/Error.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Knows which pairs of faces may intersect because they belong to two parts that may, and answers it for a
/// moving star and a stationary face.
///
/// A face has a mask: for the k-th pair of parts, bit 2k is for the first, and bit 2k + 1 for the second. Its
/// *rivals* are the bits of the faces with which it may intersect. A face keeps its parts for good.
///
/// **Complexity** 8 bytes for each face, and none when no parts are given.
template <class Id>
class Permitted_pairs
{
  using Mask = std::uint64_t;
  static constexpr std::size_t s_most = 32;

public:
  template <class Face, class Face_table>
  void begin(const std::vector<std::pair<std::vector<Face>, std::vector<Face>>>& parts,
             const Face_table& faces)
  {
    if (parts.size() > s_most)
      throw Argument_error("at most 32 pairs of parts may intersect, and there are " +
                           std::to_string(parts.size()));
    m_masks.assign(parts.empty() ? 0 : faces.size(), 0);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Mask first = Mask(1) << (2 * k), second = first << 1;
      std::unordered_set<std::size_t> positions;
      for (const Face face : parts[k].first) {
        const Id id = faces.id(face);
        m_masks[id] |= first;
        for (const auto corner : faces.corners(id))
          positions.insert(corner);
      }
      for (const Face face : parts[k].second) {
        const Id id = faces.id(face);
        m_masks[id] |= second;
        for (const auto corner : faces.corners(id))
          if (positions.count(corner) > 0)
            throw Argument_error("two parts that are joined may not intersect each other");
      }
    }
  }

  bool is_any() const { return !m_masks.empty(); }

  bool has(Id a, Id b) const { return is_any() && (rivals(m_masks[a]) & m_masks[b]) != 0; }

  /// Called for every star before the questions below. The star has kept its faces.
  template <class Star, class Face_table>
  void begin_star(const Star& star, const Face_table& faces)
  {
    m_rivals.clear();
    m_of_some = 0;
    m_of_all = ~Mask(0);
    for (std::size_t j = 0; j < star.link().size(); ++j) {
      m_rivals.push_back(rivals(m_masks[faces.id(star.link_faces()[j])]));
      m_of_some |= m_rivals[j];
      if (!star.is_contracted(j))
        m_of_all &= m_rivals[j];
    }
  }

  /// Returns whether a stationary face may intersect some face of the star, the one at the j-th edge of its
  /// link, or all that are not contracted; the last may be false where it is so.
  bool has_some(Id stationary) const { return (m_of_some & m_masks[stationary]) != 0; }
  bool has_at(std::size_t j, Id stationary) const
  {
    return is_any() && (m_rivals[j] & m_masks[stationary]) != 0;
  }
  bool has_all(Id stationary) const { return (m_of_all & m_masks[stationary]) != 0; }

private:
  static Mask rivals(Mask mask)
  {
    constexpr Mask firsts = 0x5555555555555555;
    return (mask & firsts) << 1 | (mask >> 1 & firsts);
  }

  std::vector<Mask> m_masks;               // by face; empty when no pair is permitted
  std::vector<Mask> m_rivals;              // by edge of the link
  Mask m_of_some = 0, m_of_all = ~Mask(0); // of all faces of the star; of those that are not contracted
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_PERMITTED_PAIRS_H
