# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One reduction: from the selected objects to files, through the program, and back."""

import contextlib
import json
import os
import re
import tempfile

import bpy
import numpy

from . import ply
from .corners import Corners, column, world_places
from .program import Program, ReductionError
from .rebuild import Rebuilt
from .settings import program_path

_OUTPUT, _REPORT = "reduced.ply", "report.json"


def reduce_selected(context):
    """Reduces the selected mesh objects as the settings of the scene say.

    This is a generator: it yields what it does at present, as a text and, where it is known, a percentage. It returns what to
    tell the user, a sentence and whether it is a warning. Nothing is changed before its end. Closing it ends everything. It
    throws ReductionError.
    """
    settings = context.scene.selvedge
    program = program_path(context)
    obstacles = _obstacles(settings)
    inputs = [_Input(selected) for selected in _selection(context, obstacles)]
    with tempfile.TemporaryDirectory(prefix="selvedge_", dir=bpy.app.tempdir) as folder:
        yield "writing the selected objects", None
        files = _Files(folder, inputs)
        places = numpy.concatenate([item.places_of(item.basis) for item in inputs])
        command = [program, "simplify", files.write("selected_objects", places), "-o", _OUTPUT, "--report", _REPORT]
        command += settings.arguments()
        if "--placement" not in command:
            command += ["--placement", "vertices"]
        obstacle = _Obstacle(folder, obstacles, context.evaluated_depsgraph_get()) if obstacles else None
        if obstacle:
            command += ["--obstacle", obstacle.write("obstacle", context.evaluated_depsgraph_get())]

        for key in _names_of_shape_keys(inputs) if settings.uses_shape_keys else []:
            yield f"writing the shape key {key}", None
            name = files.new_name("shape_key_" + key)
            places_of_key = numpy.concatenate([item.places_of(item.shape(key)) for item in inputs])
            command += ["--pose", files.write(name, places_of_key)]
            if obstacle:
                with obstacle.in_shape(key):
                    command += ["--obstacle-pose", obstacle.write("obstacle_" + name, context.evaluated_depsgraph_get())]
        for frame, depsgraph in _frames(context, settings.frame_step) if settings.uses_frames else []:
            yield f"writing frame {frame}", None
            name = files.new_name(f"frame_{frame}")
            places_in_frame = numpy.concatenate([item.places_in_frame(depsgraph, frame) for item in inputs])
            command += ["--pose", files.write(name, places_in_frame)]
            if obstacle:
                command += ["--obstacle-pose", obstacle.write("obstacle_" + name, depsgraph)]

        summary = yield from _run(command, folder)
        yield "making the reduced meshes", None
        _store(inputs, *files.result(places))
        with open(os.path.join(folder, _REPORT)) as report:
            return _message(json.load(report), summary, len(inputs))


class _Input:
    """A selected object: its triangles and wedges, and where they are. Coordinates have the shape (vertices, 3)."""

    def __init__(self, selected):
        self.object = selected
        self.corners = Corners(selected.data)
        keys = selected.data.shape_keys
        reference = keys.reference_key.data if keys else selected.data.vertices
        self.basis = column(reference, "co", numpy.float32, 3)

    def places_of(self, coordinates, matrix=None):
        """Returns the places of all wedges in world space."""
        return world_places(coordinates, matrix or self.object.matrix_world)[self.corners.vertices]

    def names_of_shapes(self):
        keys = self.object.data.shape_keys
        return [key.name for key in keys.key_blocks if key != keys.reference_key] if keys else []

    def shape(self, name):
        """Returns the coordinates in which the shape key of this name has the value 1, and all others 0."""
        if name not in self.names_of_shapes():
            return self.basis
        keys = self.object.data.shape_keys
        key = keys.key_blocks[name]
        coordinates = column(key.data, "co", numpy.float32, 3)
        if not keys.use_relative or key.relative_key == keys.reference_key:
            return coordinates
        return self.basis.astype(float) + coordinates - column(key.relative_key.data, "co", numpy.float32, 3)

    def places_in_frame(self, depsgraph, frame):
        evaluated = self.object.evaluated_get(depsgraph)
        mesh = evaluated.to_mesh()
        try:
            if len(mesh.vertices) != len(self.basis) or not numpy.array_equal(
                    column(mesh.loops, "vertex_index", numpy.int32), self.corners.loop_vertices):
                raise ReductionError(f"A modifier of '{self.object.name}' adds or removes vertices or faces in frame {frame}. Hide "
                                     "it in the viewport while the object is reduced, or use no frames")
            return self.places_of(column(mesh.vertices, "co", numpy.float32, 3), evaluated.matrix_world)
        finally:
            evaluated.to_mesh_clear()


class _Obstacle:
    """Objects that are not changed, as their modifiers make them."""

    def __init__(self, folder, objects, depsgraph):
        self._folder = folder
        self._objects = objects
        self._triangles = self._read(depsgraph)[1]

    def write(self, name, depsgraph):
        places, triangles = self._read(depsgraph)
        if not numpy.array_equal(triangles, self._triangles):
            raise ReductionError(f"The faces of the obstacle change in frame {depsgraph.scene.frame_current}. Choose another "
                                 "obstacle, or use no frames")
        return _write(self._folder, name, _vertices(places), _faces(triangles))

    @contextlib.contextmanager
    def in_shape(self, name):
        """For a while, the shape key of this name has the value 1, and all others 0, in every object that has it."""
        before = [(one, one.show_only_shape_key, one.active_shape_key_index) for one in self._objects]
        try:
            for one in self._objects:
                keys = one.data.shape_keys
                if keys and name in keys.key_blocks:
                    one.show_only_shape_key, one.active_shape_key_index = True, keys.key_blocks.find(name)
            yield
        finally:
            for one, shows_one, index in before:
                one.show_only_shape_key, one.active_shape_key_index = shows_one, index

    def _read(self, depsgraph):
        places, triangles, count = [], [], 0
        for item in self._objects:
            evaluated = item.evaluated_get(depsgraph)
            mesh = evaluated.to_mesh()
            mesh.calc_loop_triangles()
            places.append(world_places(column(mesh.vertices, "co", numpy.float32, 3), evaluated.matrix_world))
            triangles.append(column(mesh.loop_triangles, "vertices", numpy.int32, 3) + count)
            count += len(mesh.vertices)
            evaluated.to_mesh_clear()
        return numpy.concatenate(places), numpy.concatenate(triangles)


class _Files:
    """The files of one run. In all of them the wedges and triangles of all objects are numbered one after another."""

    def __init__(self, folder, inputs):
        self._folder = folder
        self._poses = 0
        starts = numpy.cumsum([0] + [len(item.corners.vertices) for item in inputs])
        triangles = numpy.concatenate([item.corners.triangles + start for item, start in zip(inputs, starts)])
        self._uvs = numpy.concatenate([item.corners.uvs for item in inputs])
        self._faces = _faces(triangles)

    def new_name(self, pose):
        """Returns a name for the file of a pose, by which the program names it in messages."""
        self._poses += 1
        return re.sub(r"\W", "_", f"{self._poses}_{pose}")

    def write(self, name, places):
        return _write(self._folder, name, _vertices(places, self._uvs), self._faces)

    def result(self, places):
        """Returns the wedges of the triangles that are left, and which triangles these were."""
        vertices, faces = ply.read(os.path.join(self._folder, _OUTPUT))
        found = numpy.stack([vertices[axis] for axis in "xyz"], axis=1)
        if not numpy.array_equal(found, places[vertices["number"]]):
            raise ReductionError("The options move vertices to new places, where they have no weights and shape keys: leave out "
                                 "--placement and --weld")
        return vertices["number"][faces["vertex_indices"]].astype(numpy.int64), faces["number"].astype(numpy.int64)


def _write(folder, name, vertices, faces):
    """Writes a file and returns its name in the folder."""
    ply.write(os.path.join(folder, name + ".ply"), vertices, faces)
    return name + ".ply"


def _vertices(places, uvs=None):
    """Returns the rows of a file; with texture coordinates, the vertices are also numbered."""
    vertices = numpy.empty(len(places), [(name, "<f8") for name in "xyz"] +
                           ([("s", "<f4"), ("t", "<f4"), ("number", "<u4")] if uvs is not None else []))
    vertices["x"], vertices["y"], vertices["z"] = places.T
    if uvs is not None:
        vertices["s"], vertices["t"] = uvs.T
        vertices["number"] = numpy.arange(len(places))
    return vertices


def _faces(triangles):
    faces = numpy.empty(len(triangles), ply.FACE)
    faces["corners"] = 3
    faces["vertex_indices"] = triangles
    faces["number"] = numpy.arange(len(triangles))
    return faces


def _selection(context, obstacles):
    selected = [one for one in context.selected_objects if one.type == "MESH" and one.data.polygons and one not in obstacles]
    if not selected:
        raise ReductionError("Select one or more mesh objects with faces, other than the obstacle")
    for one in selected:
        if one.library or one.data.library:
            raise ReductionError(f"'{one.name}' is linked from another file: make it local first")
        if any(modifier.type == "MULTIRES" for modifier in one.modifiers):
            raise ReductionError(f"'{one.name}' has a Multiresolution modifier, whose details would be lost: apply it first")
    return selected


def _obstacles(settings):
    chosen = list(settings.obstacles.all_objects) if settings.obstacles else []
    if settings.obstacle and settings.obstacle not in chosen:
        chosen.append(settings.obstacle)
    meshes = [one for one in chosen if one.type == "MESH"]
    if settings.obstacles and not meshes:
        raise ReductionError(f"The collection '{settings.obstacles.name}' has no mesh objects that could be an obstacle")
    return meshes


def _names_of_shape_keys(inputs):
    return list(dict.fromkeys(name for item in inputs for name in item.names_of_shapes()))


def _frames(context, step):
    """Goes through the timeline and back to where it was; yields each `step`th frame, with the scene in it."""
    scene = context.scene
    before = scene.frame_current, scene.frame_subframe
    try:
        for frame in range(scene.frame_start, scene.frame_end + 1):
            scene.frame_set(frame)  # also those between, because a simulation needs them
            if (frame - scene.frame_start) % step == 0:
                yield frame, context.evaluated_depsgraph_get()
    finally:
        scene.frame_set(before[0], subframe=before[1])


def _run(command, folder):
    program = Program(command, folder)
    try:
        while program.is_running():
            yield program.line or "running the program", program.percentage
        if program.exit_code != 0:
            raise ReductionError(program.line or f"The program ended with exit code {program.exit_code}")
        return program.summary
    finally:
        program.end()


def _store(inputs, triangles, numbers):
    """Gives every object what is left of its triangles."""
    rebuilt = []
    first_wedge = first_triangle = 0
    for item in inputs:
        corners = item.corners
        is_own = (numbers >= first_triangle) & (numbers < first_triangle + len(corners.triangles))
        rebuilt.append(Rebuilt(item.object.data, corners, triangles[is_own] - first_wedge, numbers[is_own] - first_triangle))
        first_wedge += len(corners.vertices)
        first_triangle += len(corners.triangles)
    for item, new in zip(inputs, rebuilt):
        if item.object.data.users > 1:  # other objects, which nobody has judged, keep the mesh as it is
            item.object.data = item.object.data.copy()
        new.store(item.object.data)


def _message(report, summary, objects):
    faces, verified = report["faces"], report["verified"]
    pairs = sum(judged["pairs"] for judged in [verified, *verified.get("poses", [])])
    text = f"{faces['input']:,} triangles of {objects} object{'s' if objects > 1 else ''} reduced to {faces['output']:,}; "
    text += f"{pairs:,} pairs of them intersect, as before" if pairs else "no layer pierces another"
    if report["target"]["reached"]:
        return text, False
    return text + "; target not reached, " + next((line for line in summary if line.startswith("held back")), ""), True
