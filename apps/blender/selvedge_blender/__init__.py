# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender add-on that reduces all selected objects in one run of selvedge, so that no layer pierces another.

The modules, in the order in which data goes through them: `settings` (what the user chooses), `operators` (the operator and
the panel), `reduction` (one reduction, from the selection back to it), `corners` (a mesh as tables of numbers), `ply` (files
for the program), `program` (the process), and `rebuild` (the mesh from the faces that are left).
"""

bl_info = {
    "name": "Selvedge",
    "description": "Reduces layered meshes, such as garments, so that no layer pierces another",
    "author": "the Selvedge authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Selvedge",
    "category": "Mesh",
}

import bpy

from . import operators, settings

_classes = (settings.Preferences, settings.Settings, operators.Reduce, operators.Panel)


def register():
    for cls in _classes:
        bpy.utils.register_class(cls)
    bpy.types.Scene.selvedge = bpy.props.PointerProperty(type=settings.Settings)


def unregister():
    del bpy.types.Scene.selvedge
    for cls in reversed(_classes):
        bpy.utils.unregister_class(cls)
