// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The log of libigl's decimation that blocks intersections.

#include "Libigl_decimater.h"
#include "Peer_log.h"

#include <algorithm>
#include <cstddef>

int main(int argc, char** argv)
{
  using namespace selvedge;
  using namespace selvedge::benchmark;
  return write_peer_log(
      argc, argv,
      "The log of a reduction by libigl's decimation that blocks intersections, for `selvedge replay`.",
      [](const Triangle_soup& soup, std::size_t faces, Peer_log& log) {
        Libigl_decimater libigl(soup);
        libigl.reduce_to(faces, [&](std::size_t removed, std::size_t kept) {
          log.add(removed, kept, std::min(removed, kept));
        });
        return libigl.triangles();
      });
}
