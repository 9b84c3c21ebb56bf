// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ELEMENT_NUMBERS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ELEMENT_NUMBERS_H

#include <CGAL/Dynamic_property_map.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <type_traits>
#include <vector>

namespace selvedge {
namespace internal {

/// Whether descriptors are consecutive numbers, as those of `CGAL::Surface_mesh` are.
template <class Descriptor>
struct Are_numbers : std::is_base_of<CGAL::SM_Index<Descriptor>, Descriptor>
{
};

/// Numbers the vertices, or the faces, of a mesh from 0 on, in the order of the mesh. `Tag<T>` is CGAL's tag
/// of dynamic properties of such elements.
///
/// Nothing is stored where the descriptors are these numbers themselves, as in a `CGAL::Surface_mesh` from
/// which nothing has been removed.
///
/// **Complexity** O(n) to make, O(1) for each question.
template <class TriangleMesh, class Descriptor, template <class> class Tag>
class Element_numbers
{
public:
  using Number = std::uint32_t;

  /// `elements` is the range of all of them.
  template <class Range>
  Element_numbers(const TriangleMesh& mesh, const Range& elements)
      : m_size(std::size_t(std::distance(elements.begin(), elements.end())))
  {
    if constexpr (Are_numbers<Descriptor>::value) {
      std::size_t number = 0;
      m_is_stored = !std::all_of(elements.begin(), elements.end(),
                                 [&](Descriptor element) { return std::size_t(element) == number++; });
      if (!m_is_stored)
        return;
    }
    m_numbers = get(Tag<Number>(), mesh);
    m_elements.reserve(m_size);
    for (const Descriptor element : elements) {
      put(*m_numbers, element, Number(m_elements.size()));
      m_elements.push_back(element);
    }
  }

  std::size_t size() const { return m_size; }

  Number number(Descriptor element) const
  {
    if constexpr (Are_numbers<Descriptor>::value)
      if (!m_is_stored)
        return Number(element);
    return get(*m_numbers, element);
  }

  Descriptor element(Number number) const
  {
    if constexpr (Are_numbers<Descriptor>::value)
      if (!m_is_stored)
        return Descriptor(number);
    return m_elements[number];
  }

private:
  std::size_t m_size;
  bool m_is_stored = true;
  std::optional<typename boost::property_map<TriangleMesh, Tag<Number>>::const_type> m_numbers;
  std::vector<Descriptor> m_elements; // by number
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ELEMENT_NUMBERS_H
