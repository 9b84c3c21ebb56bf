# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the add-on makes of a garment of several objects; see run.sh."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy
import numpy

import garment
from garment import check


def reduce():
    """Returns the error with which the operator ends, or None."""
    try:
        bpy.ops.selvedge.reduce()
    except RuntimeError as error:
        return str(error)
    return None


def is_kept(before, after):
    """Whether every vertex and every corner that is left is one of the input's, with all that it had there."""
    return all(now.items() <= then.items() and now_corners <= then_corners
               for (then, then_corners), (now, now_corners) in zip(before, after))


def tables(objects):
    return [(garment.vertices_of(one), garment.corners_of(one)) for one in objects]


def decimated(objects, ratio):
    """Writes what Blender's own Decimate modifier makes."""
    for one in objects:
        one.shape_key_clear()
        one.modifiers.new("Decimate", "DECIMATE").ratio = ratio
        with bpy.context.temp_override(object=one, active_object=one):
            bpy.ops.object.modifier_apply(modifier="Decimate")
    return garment.write(objects, "decimated")


def sharp_edges_between_materials(mesh):
    """Returns how many edges are sharp, and how many of these have two materials."""
    materials = {}
    for polygon in mesh.polygons:
        for key in polygon.edge_keys:
            materials.setdefault(key, set()).add(polygon.material_index)
    sharp = [edge.key for edge in mesh.edges if edge.use_edge_sharp]
    between = [key for key, found in materials.items() if len(found) > 1]
    return set(sharp), set(between)


garment.enable()

objects = garment.make()
before, count = tables(objects), garment.triangles(objects)
lasting = [(one.name, one.data, one.data.shape_keys, one.matrix_world.copy(), list(one.data.materials), one.modifiers.keys())
           for one in objects]
garment.settings(ratio=0.3)
check("the garment is reduced", reduce() is None and garment.triangles(objects) <= 0.3 * count + 1)
check("no layer pierces another", garment.pairs(garment.write(objects, "reduced")) == 0)
check("nor in a shape key", all(garment.pairs(garment.write(objects, name, name)) == 0 for name in garment.SHAPES))
after = tables(objects)
check("vertices and corners keep what they had", is_kept(before, after))
check("objects keep meshes, shape keys, transforms, materials and modifiers",
      lasting == [(one.name, one.data, one.data.shape_keys, one.matrix_world, list(one.data.materials), one.modifiers.keys())
                  for one in objects])
sharp, between = zip(*(sharp_edges_between_materials(one.data) for one in objects))
check("sharp edges are still the borders between the materials", sharp == between and any(sharp))
check("the meshes are valid", not any(one.data.validate(verbose=True) for one in objects))

spoiled = objects[0].data
spoiled.uv_layers["second"].data[0].uv.x += 1
check("control: a wrong UV is found", not is_kept(before, tables(objects)))
spoiled.uv_layers["second"].data[0].uv.x -= 1
spoiled.shape_keys.key_blocks[1].data[0].co.x += 1
check("control: a wrong shape key is found", not is_kept(before, tables(objects)))

objects = garment.make()
check("control: Blender's Decimate lets layers pierce each other", garment.pairs(decimated(objects, 0.3)) > 0)

objects = garment.make()
garment.settings(ratio=0.1, uses_shape_keys=False)
check("without shape keys the garment is reduced", reduce() is None)
check("control: it pierces itself in some of them",
      garment.pairs(garment.write(objects, "reduced")) == 0 and
      any(garment.pairs(garment.write(objects, name, name)) > 0 for name in garment.SHAPES))

objects = garment.make()
for one in objects:
    key = one.data.shape_keys.key_blocks["pose_1"]
    for frame, value in ((1, 0), (11, 1)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
scene = bpy.context.scene
scene.frame_end = 11
scene.frame_set(3)
garment.settings(ratio=0.1, uses_shape_keys=False, uses_frames=True, frame_step=5)
check("the garment is reduced in frames", reduce() is None and scene.frame_current == 3)
check("it pierces itself in none of them", garment.pairs(garment.write(objects, "reduced", "pose_1")) == 0)
objects[2].modifiers.new("Subdivision", "SUBSURF")
then = garment.everything(objects)
check("a modifier that adds faces is an error", objects[2].name in reduce() and garment.everything(objects) == then)

objects = garment.make()
scene.frame_set(1)
body, clothes = [one for one in objects if one.name.startswith("body")], [one for one in objects if not one.name.startswith("body")]
then, alone = garment.everything(body), garment.triangles(body)
garment.settings(ratio=0.3, obstacle=body[0])
check("an obstacle stays as it is, even when it is selected", reduce() is None and garment.everything(body) == then)
check("layers keep clear of it, and of its shape keys",
      all(garment.pairs(garment.write(objects, "reduced", shape)) == 0 for shape in ("Basis", *garment.SHAPES)))
check("its faces do not count", garment.triangles(clothes) <= 0.3 * (count - alone) + 1)

then = garment.everything(objects)
garment.settings(options="--placement optimal", uses_shape_keys=False)
check("new places are an error", "new places" in reduce() and garment.everything(objects) == then)
garment.settings(options="--no-such-option")
check("an error of the program is shown", "no-such-option" in reduce() and garment.everything(objects) == then)
garment.settings()
garment.preferences().program = "no-such-program"
check("a missing program is one clear error",
      "'no-such-program' is not found" in reduce() and garment.everything(objects) == then)

# Quads, loose parts, custom normals, and a mesh that another object shares.
garment.preferences().program = garment.SELVEDGE
for one in list(bpy.data.objects):
    bpy.data.objects.remove(one)
bpy.ops.mesh.primitive_grid_add(x_subdivisions=20, y_subdivisions=20)
grid = bpy.context.object
grid.data.vertices.add(3)
grid.data.edges.add(1)
grid.data.edges[-1].vertices = len(grid.data.vertices) - 1, len(grid.data.vertices) - 2
for vertex in grid.data.vertices[:-3]:
    vertex.co.z = 0.3 * abs(vertex.co.x) ** 2 if vertex.co.x > 0 else 0
grid.data.update()
grid.data.use_auto_smooth = True
grid.data.normals_split_custom_set([(0, 0.6, 0.8)] * len(grid.data.loops))
other = bpy.data.objects.new("other", grid.data)
shared = grid.data
garment.settings(ratio=0.5)
check("a grid is reduced", reduce() is None)
check("the object that shared its mesh keeps it", other.data == shared and len(shared.polygons) == 400 and grid.data != shared)
sizes = [len(polygon.vertices) for polygon in grid.data.polygons]
check("quads of which nothing has changed stay", 4 in sizes and 3 in sizes)
used = {vertex for polygon in grid.data.polygons for vertex in polygon.vertices}
check("loose vertices and edges stay, others go", len(grid.data.vertices) == len(used) + 3 and
      sum(edge.is_loose for edge in grid.data.edges) == 1)
grid.data.calc_normals_split()
check("custom normals stay", numpy.allclose(garment.values(grid.data.loops, "normal", 3), (0, 0.6, 0.8), atol=0.005))

bpy.ops.mesh.primitive_circle_add(fill_type="NGON")
check("a single polygon is reduced", reduce() is None and len(bpy.context.object.data.polygons) > 1)
bpy.data.objects.remove(bpy.context.object)
grid.select_set(True)

from selvedge_blender.program import Program  # known only now

program = Program(["sh", "-c", r"printf '\r\033[Kreducing [===   ] 42 %%, 7 faces' >&2; exec sleep 1000"], garment.FOLDER)
while program.is_running() and not program.line:
    pass
check("the progress is read", program.percentage == 42 and program.line.endswith("7 faces"))
program.end()

mesh = grid.data = bpy.data.meshes.new("leaf")
points = [(x, y, 0.01 * x * y) for x in range(9) for y in range(9)]
faces = [(i, i + 9, i + 10, i + 1) for i in range(71) if i % 9 != 8]
triangles = [(face[0], *face[i:i + 2]) for face in faces for i in (1, 2)]
mesh.from_pydata(points, [], triangles + [triangle[::-1] for triangle in triangles])
check("both sides of a leaf on the same vertices are an error", "leaf" in reduce() and len(mesh.polygons) == 256)
mesh = grid.data = bpy.data.meshes.new("in disorder")
mesh.from_pydata(points, [], faces)
mesh.polygons[0].loop_start, mesh.polygons[1].loop_start = 4, 0
check("corners in disorder are an error", "in disorder" in reduce())
print("all is well")
