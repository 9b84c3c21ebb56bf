# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The class of pyfqmr 0.2: `from selvedge import pyfqmr` in place of its import."""

import numpy as np

from . import simplify as _simplify
from .fast_simplification import border_vertices


class Simplify:
    """setMesh, simplify_mesh, getMesh, as pyfqmr has them."""

    def setMesh(self, vertices, faces, face_colors=None):
        """Sets the mesh: vertices of shape (n, 3), faces of shape (m, 3). `face_colors` has no effect."""
        self._mesh = (np.array(vertices, dtype=np.float64), np.array(faces, dtype=np.int32))

    def simplify_mesh(self, target_count=100, update_rate=5, aggressiveness=7.0, max_iterations=100, verbose=True, lossless=False,
                      threshold_lossless=1e-3, alpha=1e-9, K=3, preserve_border=True):
        """Reduces the mesh to target_count faces or, with `lossless`, as far as its surface stays within 1e-9 of its size. With
        `preserve_border`, no vertex on a border moves. `verbose` prints one line; the others have no effect."""
        points, triangles = self._mesh
        options = {"error": 1e-9} if lossless else {"error": None, "faces": target_count}
        result = _simplify(points, triangles, lock_vertices=border_vertices(triangles) if preserve_border else None, **options)
        self._mesh = (result.points, result.triangles)
        if verbose:
            print(f"simplified mesh from {len(triangles)} to {len(result.triangles)} triangles")

    def getMesh(self):
        """Returns (vertices, faces, normals), with a normal of length 1 for each face."""
        points, triangles = self._mesh
        a, b, c = (points[triangles[:, k]] for k in range(3))
        normals = np.cross(b - a, c - a)
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        return points, triangles, np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
