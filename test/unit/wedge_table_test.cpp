// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Wedge_table: after any collapses, it names the wedges that the corners have been given one by one.

#include "soup/Wedge_table.h"
#include "soup/Working_mesh.h"
#include "soup/number_wedges.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Surface_mesh_simplification/simplify_mesh.h>
#include <selvedge/prepare.h>

#include <gtest/gtest.h>

#include <cstddef>

namespace selvedge::test {
namespace {

/// A mesh of which every corner has the number of its wedge, beside a table that says the same.
class Numbered_mesh : public Working_mesh
{
public:
  explicit Numbered_mesh(const Prepared_soup& prepared)
      : Working_mesh(prepared.soup, prepared.positions, prepared.is_frozen, prepared.obstacle, prepared.scale,
                     prepared.is_turned, prepared.fronts),
        m_numbers(number_wedges(*this, constraints())), m_table(*this, m_numbers)
  {
  }

  void before_collapse(Halfedge moving, const Border_rule<Mesh>& rule)
  {
    carry_numbers(moving, rule);
    Working_mesh::before_collapse(moving, rule);
  }
  void before_joint_collapse(Halfedge moving, const Border_rule<Mesh>& rule)
  {
    carry_numbers(moving, rule);
    Working_mesh::before_joint_collapse(moving, rule);
  }

  /// Returns how many corners have another wedge than the table says.
  std::size_t differences() const
  {
    std::size_t count = 0;
    for (const Halfedge h : mesh().halfedges())
      count += !mesh().is_border(h) && m_table.wedge(h) != m_numbers.of_face[mesh().face(h)][place(h)];
    return count;
  }

  std::size_t moves_alone = 0, moves_of_several = 0; // of vertices by their wedges

private:
  void carry_numbers(Halfedge moving, const Border_rule<Mesh>& rule)
  {
    ++(m_table.is_alone(mesh().source(moving)) ? moves_alone : moves_of_several);
    for_each_changed_face(moving, rule, [this](Halfedge h, Halfedge from) {
      m_numbers.of_face[mesh().face(h)][place(h)] = m_numbers.of_face[mesh().face(from)][place(from)];
    });
    m_table.on_merging(mesh().source(moving), mesh().target(moving));
  }

  Wedge_numbers m_numbers;
  Wedge_table m_table;
};

TEST(WedgeTable, NamesTheWedgesThatCornersHaveAfterCollapses)
{
  std::size_t alone = 0, several = 0;
  for (const Triangle_soup& soup : {skirt(4000), garment("jacket", 6000), sewn_pieces(800),
                                    finned_sheet(8, 3), with_own_uvs_at(sheet(12, 12), 70)}) {
    const Prepared_soup prepared = prepare(soup);
    Numbered_mesh mesh(prepared);
    EXPECT_EQ(mesh.differences(), 0u);
    simplify_mesh(mesh.mesh(), without_limits(to_ratio(0.1)), mesh.constraints(), mesh);
    EXPECT_EQ(mesh.differences(), 0u);
    alone += mesh.moves_alone;
    several += mesh.moves_of_several;
  }
  EXPECT_GT(alone, 1000u);
  EXPECT_GT(several, 100u);
}

} // namespace
} // namespace selvedge::test
