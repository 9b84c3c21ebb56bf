// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Judged_mesh.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <utility>

namespace selvedge::reference {

Box box_of(const std::array<Place, 3>& triangle)
{
  Box box;
  for (const Place& corner : triangle)
    box.add(corner.at);
  return box;
}

Judged_mesh::Judged_mesh(Start& start) : m_start(start), m_complex(start.soup, std::move(start.obstacle))
{
  m_boxes.resize(m_complex.size_with_obstacle());
  Cancellation_poll poll;
  for (Index f = 0; f < m_boxes.size(); ++f) {
    poll();
    m_boxes[f] = box_of(m_complex.triangle(f));
  }
  build_tree();
}

void Judged_mesh::build_tree()
{
  std::vector<Index> faces;
  for (Index f = 0; f < m_complex.size(); ++f)
    if (m_complex.face(f).is_alive)
      faces.push_back(f);
  m_faces_in_tree = faces.size();
  for (Index f = Index(m_complex.size()); f < m_complex.size_with_obstacle(); ++f)
    faces.push_back(f);
  m_tree.build(faces, m_boxes);
}

void Judged_mesh::set_doubles_aside()
{
  m_complex.set_aside(m_start.fronts);
  for (Index f = 0; f < m_complex.size(); ++f)
    if (!m_complex.face(f).is_alive) {
      m_start.offences.remove(f);
      m_boxes[f] = Box();
    }
  build_tree();
}

void Judged_mesh::begin_snap(Index moved)
{
  m_changing = m_complex.faces_at(moved);
  m_heritage.clear();
}

void Judged_mesh::begin_collapse(std::vector<Index> changing)
{
  m_changing = std::move(changing);
  m_heritage = m_start.lineage.united(m_changing);
  m_rivals = m_start.lineage.rivals(m_heritage);
}

bool Judged_mesh::is_exempt(Index changing, Index other) const
{
  if (m_start.is_permitted(changing, other) || m_start.offences.has(changing, other))
    return true;
  if (m_heritage.empty())
    return false;
  return std::find(m_changing.begin(), m_changing.end(), other) != m_changing.end()
             ? Lineage::have_common(m_heritage, m_rivals)
             : m_start.lineage.descends_from_one(other, m_rivals);
}

void Judged_mesh::move(Index position, const Coordinates& place)
{
  m_complex.move(position, place);
  refit(m_complex.faces_at(position));
}

void Judged_mesh::refit(const std::vector<Index>& faces)
{
  for (const Index f : faces) {
    m_boxes[f] = box_of(m_complex.triangle(f));
    m_tree.set(f, m_boxes[f]);
  }
}

void Judged_mesh::snap(Index moved, Index kept, bool is_rejected)
{
  m_complex.snap(moved, kept);
  end_step(kept, is_rejected);
}

void Judged_mesh::collapse(Index removed, Index kept, const std::array<Coordinates, 2>& before,
                           bool is_rejected)
{
  for (const Index f : m_complex.collapse(removed, kept, before)) {
    m_start.offences.remove(f);
    m_start.lineage.remove(f);
    m_boxes[f] = Box();
    m_tree.set(f, Box());
  }
  end_step(kept, is_rejected);
}

void Judged_mesh::end_step(Index kept, bool is_rejected)
{
  refit(m_complex.faces_at(kept));
  // Faces with both ends were listed twice where both have moved.
  std::sort(m_changing.begin(), m_changing.end());
  m_changing.erase(std::unique(m_changing.begin(), m_changing.end()), m_changing.end());
  m_changing.erase(std::remove_if(m_changing.begin(), m_changing.end(),
                                  [&](Index f) { return !m_complex.face(f).is_alive; }),
                   m_changing.end());
  if (!m_heritage.empty())
    m_start.lineage.set(m_changing, m_heritage);
  if (is_rejected || !m_heritage.empty() ||
      std::any_of(m_changing.begin(), m_changing.end(), [&](Index f) { return m_start.offences.has(f); }))
    find_offences(m_changing);
  if (2 * m_complex.face_count() < m_faces_in_tree)
    build_tree();
}

void Judged_mesh::find_offences(const std::vector<Index>& faces)
{
  Offences& offences = m_start.offences;
  for (const Index f : faces)
    offences.remove(f);
  for (const Index f : faces) {
    if (is_degenerate(m_complex.triangle(f)))
      offences.add(f, f);
    m_tree.visit(m_boxes[f], [&](Index g) {
      if (g != f && !m_start.is_permitted(f, g) &&
          do_meet(m_complex.triangle(f), m_complex.triangle(g), m_statistics))
        offences.add(f, g);
    });
  }
}

} // namespace selvedge::reference
