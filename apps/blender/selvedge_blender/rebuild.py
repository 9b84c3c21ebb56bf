# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh of Blender from the triangles that the program has left of it.

Vertices, edges and corners are copies of those of the input, made by BMesh, which copies everything that hangs on them: vertex
groups, shape keys, UV maps, colours, and attributes of any type.
"""

import bmesh
import numpy

from .corners import column
from .program import ReductionError

_ORIGIN = "selvedge_origin"  # for a while, an attribute of corners: their numbers in the input


class Rebuilt:
    """What becomes of a mesh, which stays as it is until `store`.

    - triangles: for each triangle that is left, in the order of its corners, the three wedges of `corners`
    - numbers: which triangle of `corners` each was
    """

    def __init__(self, mesh, corners, triangles, numbers):
        self._name = mesh.name
        self._input, self._mesh = bmesh.new(), bmesh.new()
        for made in (self._input, self._mesh):
            made.from_mesh(mesh, use_shape_key=True)  # places are those of the basis, if there is one
        self._normals = None
        if mesh.has_custom_normals:
            self._keep_normals(mesh)

        is_whole = _whole_polygons(corners, triangles, numbers, len(mesh.polygons))
        bmesh.ops.delete(self._mesh, geom=[face for face, whole in zip(self._mesh.faces, is_whole) if not whole],
                         context="FACES_ONLY")
        is_new = ~is_whole[corners.polygons[numbers]]
        self._add_faces(corners, triangles[is_new], numbers[is_new])
        self._remove_unused()

    def store(self, mesh):
        """Writes the result into the mesh."""
        if self._normals is not None:
            origin = self._mesh.loops.layers.int[_ORIGIN]
            origins = [loop[origin] for face in self._mesh.faces for loop in face.loops]
            self._mesh.loops.layers.int.remove(origin)
        self._mesh.to_mesh(mesh)
        if self._normals is not None:
            mesh.normals_split_custom_set(self._normals[origins])
        mesh.update()

    def _keep_normals(self, mesh):
        # They are stored relative to normals that Blender computes, which change: so they are set anew.
        mesh.calc_normals_split()
        self._normals = column(mesh.loops, "normal", numpy.float32, 3)
        for of in (self._input, self._mesh):
            of.loops.layers.int.new(_ORIGIN)
            origin = of.loops.layers.int[_ORIGIN]
            for number, loop in enumerate(loop for face in of.faces for loop in face.loops):
                loop[origin] = number

    def _add_faces(self, corners, triangles, numbers):
        vertices = list(self._mesh.verts)
        edges, faces = list(self._input.edges), list(self._input.faces)
        loops = [loop for face in faces for loop in face.loops]
        rows = (corners.vertices[triangles], corners.loops[triangles], corners.edges[numbers], corners.polygons[numbers])
        new_edges = set()
        for of_vertices, of_loops, of_edges, polygon in zip(*(row.tolist() for row in rows)):
            try:
                face = self._mesh.faces.new([vertices[i] for i in of_vertices])
            except ValueError:
                raise ReductionError(f"'{self._name}' has several faces between the same vertices, as both sides of a leaf: "
                                     "separate them") from None
            face.copy_from(faces[polygon])
            face.smooth = faces[polygon].smooth  # which copy_from leaves out, as it does the marks of edges
            for loop, of_loop, of_edge in zip(face.loops, of_loops, of_edges):
                loop.copy_from(loops[of_loop])
                edge = loop.edge
                if edge.index != -1 or of_edge == -1:
                    continue
                # A new edge is what the edge was of which the program has moved an end. Of two that became one, each
                # mark counts.
                if edge not in new_edges:
                    new_edges.add(edge)
                    edge.copy_from(edges[of_edge])
                edge.seam |= edges[of_edge].seam
                edge.smooth &= edges[of_edge].smooth

    def _remove_unused(self):
        """Removes the edges and vertices that had faces and have none now; others without faces stay."""
        loose_edges = {edge.index for edge in self._input.edges if edge.is_wire}
        for edge in [edge for edge in self._mesh.edges if edge.is_wire and edge.index not in loose_edges]:
            self._mesh.edges.remove(edge)
        loose_vertices = {vertex.index for vertex in self._input.verts if not vertex.link_edges}
        for vertex in [vertex for vertex in self._mesh.verts if not vertex.link_edges and vertex.index not in loose_vertices]:
            self._mesh.verts.remove(vertex)


def _whole_polygons(corners, triangles, numbers, polygons):
    """Returns which polygons have all of their triangles as they were."""
    is_same = (corners.triangles[numbers] == triangles).all(axis=1)
    same = numpy.bincount(corners.polygons[numbers[is_same]], minlength=polygons)
    return same == numpy.bincount(corners.polygons, minlength=polygons)
