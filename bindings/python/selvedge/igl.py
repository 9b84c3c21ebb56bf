# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The signature of libigl's `decimate`: `from selvedge import igl` in place of its import."""

import numpy as np

from . import simplify as _simplify


def decimate(V, F, max_m=0, block_intersections=True):
    """Reduces (V, F) to at most max_m triangles, as far as that goes. Returns (U, G, J, I): points, triangles, and for each of them
    the number of the triangle (J) and of the vertex (I) of the input that it was. J and I are int64, and G as F.

    libigl's own default of block_intersections is False. Here, it is True, and blocks what passes through on the way as well.
    """
    result = _simplify(V, F, faces=max_m, error=None, intersection_check=bool(block_intersections))
    return result.points, result.triangles, result.birth.astype(np.int64), result.vertices.astype(np.int64)
