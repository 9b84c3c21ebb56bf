// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Lists the pairs of triangles that touch or cross where they should not, decided exactly, and the pieces of
// the mesh. Triangles are counted from 0.
//   judge_a_mesh MESH
#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>
#include <selvedge/verify.h>

#include <iostream>

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::cerr << "usage: judge_a_mesh MESH\n";
    return 2;
  }
  try {
    //! [judge]
    // A soup is two arrays: points of doubles, and triples of indices. You may fill one from your own mesh.
    const selvedge::Triangle_soup soup = selvedge::read_mesh(argv[1]).soup;
    for (const selvedge::Offending_pair& pair : selvedge::offending_pairs(soup))
      std::cout << "triangles " << pair.first << " and " << pair.second << '\n';
    for (const selvedge::Piece& piece : selvedge::pieces(soup))
      std::cout << "a piece of " << piece.faces << " faces with " << piece.boundary_loops
                << " boundary loops\n";
    //! [judge]
    return selvedge::is_embedded(soup) ? 0 : 1;
  } catch (const selvedge::Error& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
