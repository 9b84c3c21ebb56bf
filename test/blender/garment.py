# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A garment of several objects with everything that the add-on keeps, and what a test asks of it.

The environment says where things are: SELVEDGE (the program), FOLDER (with skirt.obj and its poses), ADD_ON.
"""

import json
import os
import subprocess
import sys

import addon_utils
import bpy
import numpy

FOLDER = os.environ["FOLDER"]
SELVEDGE = os.environ["SELVEDGE"]
SHAPES = ("pose_1", "pose_2")


def enable():
    sys.path.insert(0, os.environ["ADD_ON"])
    addon_utils.enable("selvedge_blender", default_set=True)
    preferences().program = SELVEDGE


def preferences():
    return bpy.context.preferences.addons["selvedge_blender"].preferences


def make():
    """Makes the only objects of the scene, one for each group of the skirt, selects them, and returns them."""
    for one in list(bpy.data.objects):
        bpy.data.objects.remove(one)
    groups = {}
    for line in open(os.path.join(FOLDER, "skirt.obj")):
        words = line.split()
        if words[:1] == ["g"]:
            faces = groups.setdefault(words[1], [])
        elif words[:1] == ["f"]:
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    points = _points("skirt")
    shapes = {name: _points(name) for name in SHAPES}
    made = [_make(name, number, faces, points, shapes) for number, (name, faces) in enumerate(groups.items())]
    bpy.context.view_layer.objects.active = made[0]
    bpy.context.view_layer.update()
    return made


def _points(name):
    lines = open(os.path.join(FOLDER, name + ".obj"))
    points = numpy.array([line.split()[1:4] for line in lines if line.startswith("v ")], dtype=float)
    return numpy.round(points * 2**20) / 2**20  # so that a transform by powers of two rounds nothing


def _make(name, number, faces, points, shapes):
    used, corners = numpy.unique(faces, return_inverse=True)
    # Each object has another transform, which leaves it where it is; some are mirrored.
    location, scale = (number % 4, 0.5, -1), (1, 2, 0.5 if number % 2 else -0.5)
    local = lambda places: ((places[used] - location) / scale).astype(numpy.float32)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(local(points).tolist(), [], corners.reshape(-1, 3).tolist())
    made = bpy.data.objects.new(name, mesh)
    made.location, made.scale = location, scale
    bpy.context.scene.collection.objects.link(made)
    made.select_set(True)

    places, of_faces = points[used], points[numpy.array(faces)].mean(axis=1)
    is_right, is_front = of_faces[:, 0] > 0, of_faces[:, 1] > 0
    angle = numpy.arctan2(places[:, 1], places[:, 0])
    for map_name, factor in (("UVMap", 1), ("second", 3)):
        uv_map = mesh.uv_layers.new(name=map_name)
        uvs = numpy.stack([factor * angle, places[:, 2]], axis=1)[corners]
        if map_name == "second":  # has a seam of its own
            uvs[numpy.repeat(is_front, 3)] += 1
        uv_map.data.foreach_set("uv", uvs.astype(numpy.float32).ravel())
    group = made.vertex_groups.new(name="weights")
    for vertex, height in enumerate(places[:, 2]):
        group.add([vertex], min(abs(height), 1), "REPLACE")
    colours = mesh.color_attributes.new("of_points", "FLOAT_COLOR", "POINT")
    colours.data.foreach_set("color", numpy.c_[places, numpy.ones(len(used))].astype(numpy.float32).ravel())
    colours = mesh.color_attributes.new("of_corners", "BYTE_COLOR", "CORNER")
    colours.data.foreach_set("color", numpy.c_[numpy.abs(places) % 1, numpy.ones(len(used))][corners].astype(numpy.float32).ravel())
    for material in ("left", "right"):
        mesh.materials.append(bpy.data.materials.get(material) or bpy.data.materials.new(material))
    mesh.polygons.foreach_set("material_index", is_right.astype(numpy.int32))
    mesh.polygons.foreach_set("use_smooth", numpy.ones(len(faces), bool))
    mesh.attributes.new("of_faces", "INT", "FACE").data.foreach_set("value", 2 * is_front + is_right)
    _mark_material_border(mesh)
    made.shape_key_add(name="Basis")
    for shape, shape_points in shapes.items():
        made.shape_key_add(name=shape).data.foreach_set("co", local(shape_points).ravel())
    made.active_shape_key_index = number % 3
    if number == 1:  # Blender shows the basis, wherever vertices of the mesh itself are
        mesh.vertices.foreach_set("co", local(points + 5).ravel())
    made.modifiers.new("Smooth", "SMOOTH").factor = 0
    return made


def _mark_material_border(mesh):
    """Makes the edges between the materials sharp."""
    materials = {}
    for polygon in mesh.polygons:
        for key in polygon.edge_keys:
            materials.setdefault(key, set()).add(polygon.material_index)
    for edge in mesh.edges:
        edge.use_edge_sharp = len(materials[edge.key]) > 1


def settings(**values):
    """Sets the settings of the scene; what is not named gets its default."""
    chosen = bpy.context.scene.selvedge
    for name in chosen.bl_rna.properties.keys():
        if name not in ("name", "rna_type"):
            chosen.property_unset(name)
    for name, value in values.items():
        setattr(chosen, name, value)


def values(items, name, size=1):
    read = [getattr(item, name) for item in items]
    return [tuple(value) if size > 1 else value for value in read]


def coordinates(made, shape="Basis"):
    keys = made.data.shape_keys
    return values(keys.key_blocks[shape].data if keys else made.data.vertices, "co", 3)


def vertices_of(made):
    """Returns everything that vertices have, by their coordinates, which are different for all."""
    mesh = made.data
    keys = [values(key.data, "co", 3) for key in mesh.shape_keys.key_blocks]
    rows = zip([tuple((group.group, group.weight) for group in vertex.groups) for vertex in mesh.vertices],
               values(mesh.attributes["of_points"].data, "color", 4), zip(*keys))
    return dict(zip(coordinates(made), rows))


def corners_of(made):
    """Returns for every corner its vertex with everything that it and its face have."""
    mesh, places = made.data, coordinates(made)
    uvs = [values(uv_map.data, "uv", 2) for uv_map in mesh.uv_layers]
    of_loops = list(zip(*uvs, values(mesh.attributes["of_corners"].data, "color", 4)))
    of_faces = values(mesh.attributes["of_faces"].data, "value")
    return {(places[mesh.loops[loop].vertex_index], of_loops[loop], face.material_index, face.use_smooth,
             of_faces[face.index]) for face in mesh.polygons for loop in face.loop_indices}


def everything(objects):
    """Returns all that a reduction may change, for comparison."""
    return [(one.name, one.data.name, one.matrix_world.copy().freeze(), [modifier.name for modifier in one.modifiers],
             list(one.data.materials), sorted(vertices_of(one).items()), sorted(corners_of(one)), sorted(one.data.edge_keys))
            for one in objects]


def triangles(objects):
    return sum(len(one.data.loop_triangles) for one in objects if one.data.calc_loop_triangles() is None)


def write(objects, name, shape="Basis"):
    """Writes the objects in a shape to an OBJ file in world space with all digits; returns its path."""
    path, count = os.path.join(FOLDER, f"written_{name}.obj"), 1
    with open(path, "w") as file:
        for one in objects:
            matrix = numpy.array(one.matrix_world)
            for place in numpy.array(coordinates(one, shape)) @ matrix[:3, :3].T + matrix[:3, 3]:
                file.write("v {!r} {!r} {!r}\n".format(*map(float, place)))
            one.data.calc_loop_triangles()
            for triangle in one.data.loop_triangles:
                file.write("f {} {} {}\n".format(*(count + vertex for vertex in triangle.vertices)))
            count += len(one.data.vertices)
    return path


def pairs(path):
    """Returns how many pairs of triangles intersect, by the judge."""
    judged = subprocess.run([SELVEDGE, "verify", path, "--json"], capture_output=True)
    return json.loads(judged.stdout)["verified"]["pairs"]


def check(what, holds):
    if not holds:
        raise AssertionError(what)
    print("ok:", what, flush=True)
