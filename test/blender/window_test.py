# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a person does in the window: reduce, undo, redo, cancel; see run.sh."""

import os
import sys
import traceback

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy

import garment
from garment import check


def view():
    """Returns the 3D view, for operators."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return bpy.context.temp_override(window=window, area=area, region=region)


def show_panel():
    """Puts the panel on the tab of the sidebar that is open; returns a list that gets an entry whenever it is drawn."""
    from selvedge_blender.operators import Panel

    drawn, draw = [], Panel.draw
    bpy.utils.unregister_class(Panel)
    Panel.bl_category, Panel.draw = "Item", lambda self, context: drawn.append(draw(self, context))
    bpy.utils.register_class(Panel)
    with view():
        bpy.context.space_data.show_region_ui = True
    return drawn


def press(key):
    window = bpy.context.window_manager.windows[0]
    window.event_simulate(type=key, value="PRESS", x=window.width // 2, y=window.height // 2)
    window.event_simulate(type=key, value="RELEASE", x=window.width // 2, y=window.height // 2)


def objects():
    """Returns the garment, which undo makes anew."""
    return sorted(bpy.data.objects, key=lambda one: one.name)


def is_running():
    """Whether there are files of a reduction."""
    return any(name.startswith("selvedge_") for name in os.listdir(bpy.app.tempdir))


def begin():
    with view():
        result = bpy.ops.selvedge.reduce("INVOKE_DEFAULT")
    check("the operator lets the window live", result == {"RUNNING_MODAL"})


def steps():
    """The test; at each yield, the window lives for a moment."""
    garment.enable()
    garment.make()
    with view():
        bpy.ops.ed.undo_push(message="the garment")
    then = garment.everything(objects())
    garment.settings(ratio=0.3)
    drawn = show_panel()
    for _ in range(10):
        yield
    check("the panel is drawn", drawn)

    begin()
    while not is_running():
        yield
    while is_running():
        yield
    reduced = garment.everything(objects())
    check("the garment is reduced", reduced != then)
    with view():
        bpy.ops.ed.undo()
    yield
    check("undo restores everything", garment.everything(objects()) == then)
    with view():
        bpy.ops.ed.redo()
    yield
    check("redo reduces again", garment.everything(objects()) == reduced)
    with view():
        bpy.ops.ed.undo()
    yield

    # A program that would take long, and says that it was there.
    slow = os.path.join(garment.FOLDER, "slow")
    with open(slow, "w") as script:
        script.write(f"#!/bin/sh\necho $$ >{slow}.id\nprintf '\\r\\033[Kreducing [====   ] 42 %%, 7 faces' >&2\nexec sleep 1000\n")
    os.chmod(slow, 0o755)
    garment.preferences().program = slow
    begin()
    while not os.path.exists(slow + ".id") or not open(slow + ".id").read().strip():
        yield
    number = int(open(slow + ".id").read())
    for _ in range(20):
        yield
    check("control: it runs until it is cancelled", is_running() and os.path.exists(f"/proc/{number}"))
    press("ESC")
    for _ in range(10):
        yield
    check("Escape ends the program and leaves no files", not os.path.exists(f"/proc/{number}") and not is_running())
    check("nothing is changed", garment.everything(objects()) == then)


def go_on(test=steps()):
    try:
        next(test)
        return 0.1
    except StopIteration:
        print("all is well", flush=True)
    except BaseException:
        traceback.print_exc()
    sys.stdout.flush()
    os._exit(0)  # Blender would ask whether to save


bpy.app.timers.register(go_on, first_interval=1)
