// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_PROGRESSIVE_LISTS_H
#define SELVEDGE_SRC_PROGRESSIVE_LISTS_H

#include <selvedge/progressive.h>

#include <string>
#include <string_view>
#include <vector>

namespace selvedge::progressive {

inline constexpr int version = 1;

/// Returns the SHA-256 of a mesh with its steps: of the vertices and triangles of each primitive in the order
/// of the file, in world space, and of all lists.
std::string digest_of(const Progressive_mesh& mesh);

/// Returns for every vertex the one at which it is after some steps.
std::vector<Index> vertices_after(const Progressive_mesh& mesh, std::size_t steps);

/// Reads a progressive file from memory, whatever its digest is if `is_digest_judged` is false: then it is
/// what a fuzzer has made of one.
Progressive_mesh read(std::string_view contents, Mesh_format format, const std::string& name,
                      bool is_digest_judged);

} // namespace selvedge::progressive

#endif // SELVEDGE_SRC_PROGRESSIVE_LISTS_H
