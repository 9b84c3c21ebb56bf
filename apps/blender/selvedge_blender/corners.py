# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh of Blender as tables of numbers, in which nothing is rounded.

The program gets one vertex for each *wedge*: the corners of polygons at a vertex that no line separates. Lines are sharp edges,
seams, borders between materials and between flat and smooth shading, and edges at which UV maps or other values of corners
differ. Wedges of a vertex lie at one position, so that the program moves them together, and along their lines alone. Each
wedge that it leaves then says by its number which values the corner has.
"""

import numpy

from .program import ReductionError

# For the types of attributes that Blender has at corners: the name of the value, and how many numbers it has.
_VALUES = {"FLOAT": ("value", 1), "INT": ("value", 1), "INT8": ("value", 1), "BOOLEAN": ("value", 1), "FLOAT2": ("vector", 2),
           "FLOAT_VECTOR": ("vector", 3), "FLOAT_COLOR": ("color", 4), "BYTE_COLOR": ("color", 4)}


def column(items, name, type, size=1):
    """Returns a property of all items of a collection as an array of shape (items,) or (items, size)."""
    values = numpy.empty(len(items) * size, type)
    items.foreach_get(name, values)
    return values if size == 1 else values.reshape(-1, size)


class Corners:
    """The triangles and wedges of a mesh.

    - triangles: the three wedges of each triangle into which Blender cuts the polygons
    - polygons: the polygon of each triangle
    - edges: the edge on each of its three sides, the first of which begins at the first corner; -1 within a polygon
    - vertices, loops: for each wedge its vertex, and one of its loops, which stands for all
    - uvs: the place of each wedge in the active UV map, or zeros
    """

    def __init__(self, mesh):
        self.loop_vertices = column(mesh.loops, "vertex_index", numpy.int32)
        following = numpy.arange(1, len(mesh.loops) + 1)  # for each loop the next one of its polygon
        starts = column(mesh.polygons, "loop_start", numpy.int32)
        sizes = column(mesh.polygons, "loop_total", numpy.int32)
        if (numpy.cumsum(sizes) - sizes != starts).any():
            raise ReductionError(f"The corners of '{mesh.name}' are not in the order of its faces: enter and leave its edit mode")
        following[starts + sizes - 1] = starts

        edges = column(mesh.loops, "edge_index", numpy.int32)
        wedges = self._number_wedges(mesh, edges, following, numpy.repeat(numpy.arange(len(sizes)), sizes))
        mesh.calc_loop_triangles()
        loops = column(mesh.loop_triangles, "loops", numpy.int32, 3)
        self.triangles = wedges[loops]
        self.polygons = column(mesh.loop_triangles, "polygon_index", numpy.int32)
        self.edges = numpy.where(following[loops] == numpy.roll(loops, -1, axis=1), edges[loops], -1)

    def _number_wedges(self, mesh, edges, following, polygons):
        order = numpy.argsort(edges, kind="stable")
        is_same = edges[order[1:]] == edges[order[:-1]]
        left, right = order[:-1][is_same], order[1:][is_same]  # loops along the same edge
        is_opposite = self.loop_vertices[left] != self.loop_vertices[right]
        begins = left, numpy.where(is_opposite, following[right], right)  # the corners on both sides, at one end of the edge
        ends = following[left], numpy.where(is_opposite, right, following[right])  # and at the other

        is_line = column(mesh.edges, "use_edge_sharp", bool) | column(mesh.edges, "use_seam", bool)
        is_joined = ~is_line[edges[left]]
        for values in (column(mesh.polygons, "material_index", numpy.int32), column(mesh.polygons, "use_smooth", bool)):
            is_joined &= values[polygons[left]] == values[polygons[right]]
        for values in _values_of_corners(mesh):
            for one, other in (begins, ends):
                is_joined &= (values[one] == values[other]).all(axis=tuple(range(1, values.ndim)))

        labels = _components(len(edges), *(numpy.concatenate(pair)[numpy.tile(is_joined, 2)] for pair in zip(begins, ends)))
        self.loops, wedges = numpy.unique(labels, return_inverse=True)
        self.vertices = self.loop_vertices[self.loops]
        uv_map = mesh.uv_layers.active
        self.uvs = column(uv_map.data, "uv", numpy.float32, 2)[self.loops] if uv_map else numpy.zeros((len(self.loops), 2))
        return wedges


def _values_of_corners(mesh):
    for uv_map in mesh.uv_layers:
        yield column(uv_map.data, "uv", numpy.float32, 2)
    for attribute in mesh.attributes:
        # Names with a dot are Blender's own: selections, and numbers of edges and vertices.
        if attribute.domain == "CORNER" and attribute.data_type in _VALUES and not attribute.name.startswith("."):
            name, size = _VALUES[attribute.data_type]
            is_real = attribute.data_type.startswith(("FLOAT", "BYTE"))
            yield column(attribute.data, name, numpy.float32 if is_real else numpy.int32, size)


def _components(count, first, second):
    """Returns for each of `count` items the smallest one to which pairs of items connect it."""
    labels = numpy.arange(count)
    while True:
        least = numpy.minimum(labels[first], labels[second])
        if (labels[first] == least).all() and (labels[second] == least).all():
            return labels
        numpy.minimum.at(labels, first, least)
        numpy.minimum.at(labels, second, least)
        labels = labels[labels]


def world_places(coordinates, matrix):
    """Returns places in world space, as doubles, of coordinates of shape (n, 3).

    Each is computed by the same operations wherever it stands in the array, unlike in a product of matrices: what lies at one
    place in two objects with one transform still does, bit for bit.
    """
    x, y, z = coordinates.astype(float).T
    return numpy.stack([row[0] * x + row[1] * y + row[2] * z + row[3] for row in list(matrix)[:3]], axis=1)
