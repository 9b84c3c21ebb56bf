// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The log of OpenMesh's decimater, whose collapses take a vertex to its neighbour: with quadrics, and our
// default limits of normal change and aspect ratio.

#include "Openmesh_decimater.h"
#include "Peer_log.h"

#include <OpenMesh/Tools/Decimater/ModBaseT.hh>

namespace {

using namespace selvedge;
using namespace selvedge::benchmark;

/// A module that allows everything and logs what is done.
template <class Decimated_mesh>
class Logging_module : public OpenMesh::Decimater::ModBaseT<Decimated_mesh>
{
public:
  DECIMATING_MODULE(Logging_module, Decimated_mesh, Logging)

  explicit Logging_module(Decimated_mesh& mesh) : Base(mesh, true) {}

  void set_log(Peer_log& log) { m_log = &log; }

  void postprocess_collapse(const CollapseInfo& collapse) override
  {
    const auto removed = static_cast<std::size_t>(collapse.v0.idx()),
               kept = static_cast<std::size_t>(collapse.v1.idx());
    m_log->add(removed, kept, kept);
  }

private:
  Peer_log* m_log = nullptr;
};

std::vector<Index_triple> reduce(const Triangle_soup& soup, std::size_t faces, Peer_log& log)
{
  Openmesh_decimater openmesh(soup, {});
  if (openmesh.mesh().n_faces() != soup.triangles.size())
    throw Input_error("the mesh is no oriented manifold, and OpenMesh cannot hold it");
  Logging_module<Openmesh_decimater::Mesh>::Handle logging;
  openmesh.decimater().add(logging);
  openmesh.decimater().module(logging).set_log(log);
  openmesh.reduce_to(faces);
  return openmesh.triangles();
}

} // namespace

int main(int argc, char** argv)
{
  return write_peer_log(argc, argv, "The log of a reduction by OpenMesh's decimater, for `selvedge replay`.",
                        reduce);
}
