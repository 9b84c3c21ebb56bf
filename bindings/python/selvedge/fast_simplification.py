# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The signatures of fast_simplification 0.2: `from selvedge import fast_simplification` in place of its import."""

import numpy as np

from . import simplify as _simplify


def simplify(points, triangles, target_reduction=None, target_count=None, agg=7.0, verbose=False, return_collapses=False,
             lossless=False, preserve_border=False):
    """Returns (points, triangles), with triangles as int32, and with `return_collapses` also the collapses: rows (kept, removed) of
    vertex numbers of the input.

    target_reduction is the share of the triangles to remove, target_count the number to keep. `agg` has no effect, and nothing is
    printed. With `lossless`, vertices go only where the surface stays where it is, within 1e-9 of its size. With `preserve_border`,
    no vertex on a border moves.
    """
    triangles = np.asarray(triangles)
    if target_reduction and target_count:
        raise ValueError("You may specify ``target_reduction`` or ``target_count``, but not both")
    options = {"error": 1e-9} if lossless else {"error": None, "faces": _target(target_reduction, target_count, len(triangles))}
    result = _simplify(points, triangles.astype(np.int32), log=return_collapses,
                       lock_vertices=border_vertices(triangles) if preserve_border else None, **options)
    mesh = (result.points, result.triangles)
    return mesh + (result.collapses[:, ::-1].astype(np.int32),) if return_collapses else mesh


def replay_simplification(points, triangles, collapses):
    """Repeats collapses that `simplify` has returned. Returns (points, triangles, mapping): `mapping[i]` is the vertex of the result
    that vertex i has become, or -1 where it is in no triangle. Nothing is judged; `selvedge.replay` does that."""
    points, triangles = np.asarray(points, dtype=np.float64), np.asarray(triangles, dtype=np.int64)
    target = _first_at_position(points)
    for kept, removed in np.asarray(collapses).reshape(-1, 2):
        target[target[removed]] = target[kept]
    while not np.array_equal(target, target[target]):
        target = target[target]
    moved = target[triangles]
    is_left = (moved[:, 0] != moved[:, 1]) & (moved[:, 1] != moved[:, 2]) & (moved[:, 2] != moved[:, 0])
    used, numbers = np.unique(moved[is_left], return_inverse=True)
    mapping = np.full(len(points), -1)
    mapping[used] = np.arange(len(used))
    return points[used], numbers.reshape(-1, 3).astype(np.int32), mapping[target]


def _target(reduction, count, faces):
    if reduction is None and count is None:
        raise ValueError("You must specify ``target_reduction`` or ``target_count``")
    if reduction is not None:
        if not 0 <= reduction <= 1:
            raise ValueError("``target_reduction`` must be between 0 and 1")
        count = (1 - reduction) * faces
    if not 0 <= count <= faces:
        raise ValueError(f"``target_count`` must be between 0 and the number of faces {faces}")
    return int(count)


def border_vertices(triangles):
    """Returns the numbers of the vertices on edges of one triangle."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    unique, counts = np.unique(edges, axis=0, return_counts=True)
    return np.unique(unique[counts == 1])


def _first_at_position(points):
    _, first, inverse = np.unique(points + 0.0, axis=0, return_index=True, return_inverse=True)
    return first[inverse.reshape(-1)]
