# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""trimesh's `Trimesh.simplify_quadric_decimation` as a function; trimesh itself is not needed."""

from .fast_simplification import simplify as _simplify


def simplify_quadric_decimation(mesh, percent=None, face_count=None, aggression=None):
    """Reduces a mesh by the share `percent` of its triangles (0.9 leaves a tenth), or to `face_count` of them.

    A mesh with `vertices` and `faces`, such as a Trimesh, gives another of its class; a pair (vertices, faces) gives a pair.
    `aggression` has no effect.
    """
    vertices, faces = mesh if isinstance(mesh, (tuple, list)) else (mesh.vertices, mesh.faces)
    result = _simplify(vertices, faces, percent, face_count)
    return result if isinstance(mesh, (tuple, list)) else type(mesh)(vertices=result[0], faces=result[1])
