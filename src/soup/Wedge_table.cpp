// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Wedge_table.h"

namespace selvedge {

Wedge_table::Wedge_table(const Corner_mesh& corners, const Wedge_numbers& numbers)
    : m_corners(corners), m_of_vertex(corners.mesh().number_of_vertices(), s_several)
{
  std::vector<char> is_met(m_of_vertex.size(), false);
  for (Index wedge = 0; wedge < numbers.vertices.size(); ++wedge) {
    const Mesh::Vertex_index v = numbers.vertices[wedge];
    m_of_vertex[v] = is_met[v] ? s_several : wedge;
    is_met[v] = true;
  }

  const auto for_each_numbered_corner = [&](const auto& function) {
    for (Index face = 0; face < numbers.of_face.size(); ++face)
      for (std::size_t place = 0; place < 3; ++place)
        if (const Index wedge = numbers.of_face[face][place]; !is_alone(numbers.vertices[wedge]))
          function(corners.corners(Corner_mesh::Face(face))[place], wedge);
  };
  m_blocks.resize(3 * corners.soup().triangles.size() / 64 + 1);
  for_each_numbered_corner([&](Corner_mesh::Corner corner, Index) {
    m_blocks[corner / 64].bits |= std::uint64_t(1) << corner % 64;
  });
  Index count = 0;
  for (Block& block : m_blocks) {
    block.before = count;
    count += Index(std::bitset<64>(block.bits).count());
  }
  m_of_corner.resize(count);
  for_each_numbered_corner(
      [&](Corner_mesh::Corner corner, Index wedge) { m_of_corner[rank(corner)] = wedge; });
}

} // namespace selvedge
