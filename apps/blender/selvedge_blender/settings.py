# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user chooses: the preferences of the add-on, and the settings of a scene, which its file keeps."""

import shlex
import shutil

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from .program import ReductionError


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: StringProperty(
        name="Program", subtype="FILE_PATH", default="selvedge",
        description="The program selvedge: a path, or a name that is looked for in PATH")

    def draw(self, context):
        self.layout.prop(self, "program")


def program_path(context):
    """Returns the path of the program; throws ReductionError where there is none."""
    named = context.preferences.addons[__package__].preferences.program
    found = shutil.which(bpy.path.abspath(named))
    if found is None:
        raise ReductionError(f"The program '{named}' is not found. Install Selvedge, or set its path in Edit > Preferences > "
                             "Add-ons > Selvedge")
    return found


class Settings(bpy.types.PropertyGroup):
    target: EnumProperty(
        name="Target", default="RATIO", description="When the reduction is done",
        items=(("RATIO", "Ratio", "Keep a share of the triangles"),
               ("FACES", "Triangles", "Keep a number of triangles, in all selected objects together"),
               ("ERROR", "Deviation", "Go as far as the largest deviation allows")))
    ratio: FloatProperty(
        name="Ratio", default=0.3, min=0, max=1, subtype="FACTOR",
        description="Share of the triangles to keep, of those that can be reduced, in all selected objects together")
    faces: IntProperty(
        name="Triangles", default=10000, min=1, description="Number of triangles to keep, in all selected objects together")
    has_limit: BoolProperty(
        name="Limit Deviation", default=True,
        description="Stop where the surface would come too far from where it was")
    deviation: FloatProperty(
        name="Deviation", default=1, min=0, max=100, precision=3, subtype="PERCENTAGE",
        description="Largest distance between the surfaces before and after, as a share of the diagonal of the box around all "
                    "selected objects")
    obstacle: PointerProperty(
        name="Obstacle", type=bpy.types.Object, poll=lambda self, candidate: candidate.type == "MESH",
        description="Object that no layer may touch or pass through, such as a body. It is not changed")
    obstacles: PointerProperty(
        name="Obstacles", type=bpy.types.Collection,
        description="Collection of objects that no layer may touch or pass through. They are not changed")
    uses_shape_keys: BoolProperty(
        name="Shape Keys", default=True,
        description="No layer pierces another in any of the shape keys at value 1, either. Keys of the same name in several "
                    "objects count as one. Time and memory grow with the number of keys")
    uses_frames: BoolProperty(
        name="Frames", default=False,
        description="No layer pierces another in frames of the animation, either. Modifiers may move vertices, but not add or "
                    "remove any. Time and memory grow with the number of frames")
    frame_step: IntProperty(
        name="Every Nth", default=10, min=1, description="Use each frame of this distance, from the start frame to the end frame")
    options: StringProperty(
        name="Options",
        description="Further options for the program, as in a command line: --normal-change 30 --aspect-ratio 0.2")

    def arguments(self):
        """Returns the options for the program that need no files."""
        chosen = {"RATIO": ["--ratio", repr(self.ratio)], "FACES": ["--faces", str(self.faces)], "ERROR": []}[self.target]
        has_limit = self.has_limit or self.target == "ERROR"
        chosen += ["--error", repr(self.deviation / 100) if has_limit else "none"]
        try:
            return chosen + shlex.split(self.options)
        except ValueError as error:
            raise ReductionError(f"The options '{self.options}' cannot be read: {error}") from None
