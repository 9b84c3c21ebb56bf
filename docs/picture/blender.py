# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the picture of docs/blender.md: a generated skirt in Blender's window, as it is, reduced to 10 % by the Decimate
modifier, and by the add-on.

    cmake/install_debian_packages.sh blender
    LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1600x860x24" blender --factory-startup --enable-event-simulate --window-geometry 0 0 1600 860 \
      --python docs/picture/blender.py -- build/release/apps/selvedge docs/picture/blender.jpg
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import traceback

import addon_utils
import bpy
import mathutils

SELVEDGE, PICTURE = map(os.path.abspath, sys.argv[sys.argv.index("--") + 1:])
COLOURS = {"lining": (0.85, 0.18, 0.20), "interlining": (0.98, 0.76, 0.20), "body": (0.88, 0.78, 0.70)}
OUTSIDE = (0.22, 0.40, 0.62)


def make(folder):
    path = os.path.join(folder, "skirt.obj")
    subprocess.run([SELVEDGE, "generate", "skirt", "-o", path, "--faces", "60000", "--thickness", "0", "--gap", "0.0003",
                    "--fold-depth", "0.03", "--quiet"], check=True)
    for one in list(bpy.data.objects):
        bpy.data.objects.remove(one)
    for place in (-0.75, 0, 0.75):
        bpy.ops.import_scene.obj(filepath=path, use_split_objects=False, use_split_groups=True, axis_forward="-Z", axis_up="Y")
        for one in bpy.context.selected_objects:
            one.location.y, one.rotation_euler.z = place, 0.4
            one.color = (*COLOURS.get(re.split(r"[_.]", one.name)[0], OUTSIDE), 1)
            if place == 0:
                one.modifiers.new("Decimate", "DECIMATE").ratio = 0.1
    return bpy.context.selected_objects


def pairs(place, folder):
    """Returns how many pairs of triangles intersect in the skirt at a place, as Blender exports it."""
    for one in bpy.data.objects:
        one.select_set(one.location.y == place)
    path = os.path.join(folder, "shown.obj")
    bpy.ops.wm.obj_export(filepath=path, export_selected_objects=True, export_triangulated_mesh=True, export_materials=False)
    judged = subprocess.run([SELVEDGE, "verify", path, "--json"], capture_output=True)
    return json.loads(judged.stdout)["verified"]["pairs"]


def write(text, place):
    curve = bpy.data.curves.new(text, "FONT")
    curve.body, curve.size, curve.align_x = text, 0.07, "CENTER"
    label = bpy.data.objects.new(text, curve)
    label.location, label.rotation_euler, label.color = (0.5, place, 0.29), (1.5708, 0, 1.5708), (1, 1, 1, 1)
    bpy.context.scene.collection.objects.link(label)


def look(space):
    space.show_region_ui, space.show_region_toolbar, space.show_gizmo = True, False, False
    space.shading.type, space.shading.color_type, space.shading.light = "SOLID", "OBJECT", "STUDIO"
    overlay = space.overlay
    overlay.show_wireframes, overlay.wireframe_threshold, overlay.wireframe_opacity = True, 1, 0.35
    overlay.show_floor = overlay.show_axis_x = overlay.show_axis_y = overlay.show_cursor = overlay.show_text = False
    overlay.show_object_origins = overlay.show_outline_selected = overlay.show_relationship_lines = False
    camera = space.region_3d
    camera.view_perspective = "ORTHO"
    camera.view_rotation = mathutils.Euler((1.35, 0, 1.5708)).to_quaternion()
    camera.view_location, camera.view_distance = (0, 0.2, 0.7), 2.1


def click(window, x, y):
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        window.event_simulate(type=kind, value=value, x=x, y=y)


def steps():
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "apps", "blender"))
    addon_utils.enable("selvedge_blender", default_set=True)
    bpy.context.preferences.addons["selvedge_blender"].preferences.program = SELVEDGE
    with tempfile.TemporaryDirectory() as folder:
        make(folder)
        decimated = pairs(0, folder)
        assert pairs(0.75, folder) == 0  # which also selects it
        bpy.context.view_layer.objects.active = bpy.context.selected_objects[0]
        bpy.context.scene.selvedge.ratio = 0.1
        bpy.ops.selvedge.reduce()
        assert pairs(0.75, folder) == 0
        left = sum(len(one.data.polygons) for one in bpy.context.selected_objects)
    colours = bpy.context.preferences.themes[0].view_3d
    colours.object_selected = colours.object_active = colours.wire
    for text, place in (("60,000 triangles", -0.75), (f"Decimate: 6,000,\n{decimated:,} pairs intersect", 0),
                        (f"Selvedge: {left:,},\nnone intersect", 0.75)):
        write(text, place)
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    look(area.spaces.active)
    click(window, window.width // 2, 5)  # away with the splash screen
    yield
    yield
    click(window, area.x + area.width - 12, area.y + area.height - 225)  # the tab of the add-on
    for _ in range(10):
        yield
    with bpy.context.temp_override(window=window, area=area):
        bpy.ops.screen.screenshot_area(filepath=PICTURE + ".png")
    picture = bpy.data.images.load(PICTURE + ".png")
    bpy.context.scene.render.image_settings.file_format = "JPEG"
    bpy.context.scene.render.image_settings.quality = 88
    bpy.context.scene.view_settings.view_transform = "Standard"
    picture.save_render(PICTURE)
    os.remove(PICTURE + ".png")


def go_on(picture=steps()):
    try:
        next(picture)
        return 0.2
    except StopIteration:
        pass
    except BaseException:
        traceback.print_exc()
    sys.stdout.flush()
    os._exit(0)


bpy.app.timers.register(go_on, first_interval=1)
