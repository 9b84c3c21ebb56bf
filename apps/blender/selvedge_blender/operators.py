# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator, and its panel in the sidebar of the 3D view."""

import time

import bpy

from .program import ReductionError
from .reduction import reduce_selected

_SECONDS = 0.05  # between two looks at the program


class Reduce(bpy.types.Operator):
    """Reduce all selected mesh objects together, so that no layer of one pierces another layer of any of them"""

    bl_idname = "selvedge.reduce"
    bl_label = "Reduce Selected"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT" and any(one.type == "MESH" for one in context.selected_objects)

    def execute(self, context):
        """Reduces, and returns when it is done: for scripts."""
        self._steps = reduce_selected(context)
        while (result := self._step(context)) == {"RUNNING_MODAL"}:
            time.sleep(_SECONDS)
        return result

    def invoke(self, context, event):
        """Begins to reduce. Until the end, Blender shows the progress, and takes no input but Escape."""
        self._steps = reduce_selected(context)
        manager = context.window_manager
        self._timer = manager.event_timer_add(_SECONDS, window=context.window)
        manager.progress_begin(0, 100)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type not in {"ESC", "TIMER"}:
            return {"RUNNING_MODAL"}
        result = {"CANCELLED"}
        try:
            if event.type == "TIMER":
                result = self._step(context)
            else:
                self._steps.close()
                self.report({"INFO"}, "Selvedge: cancelled; nothing is changed")
        finally:
            if result != {"RUNNING_MODAL"}:
                self._end(context)
        return result

    def cancel(self, context):
        self._steps.close()
        self._end(context)

    def _step(self, context):
        try:
            text, percentage = next(self._steps)
        except StopIteration as end:
            text, is_warning = end.value
            self.report({"WARNING" if is_warning else "INFO"}, "Selvedge: " + text)
            return {"FINISHED"}
        except ReductionError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if context.workspace:
            context.workspace.status_text_set(f"Selvedge: {text} (Esc cancels)")
            context.window_manager.progress_update(percentage or 0)
        return {"RUNNING_MODAL"}

    def _end(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)


class Panel(bpy.types.Panel):
    bl_idname = "VIEW3D_PT_selvedge"
    bl_label = "Selvedge"
    bl_category = "Selvedge"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"

    def draw(self, context):
        settings, layout = context.scene.selvedge, self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column()
        column.prop(settings, "target")
        if settings.target == "ERROR":
            column.prop(settings, "deviation")
        else:
            column.prop(settings, "ratio" if settings.target == "RATIO" else "faces")
            row = column.row(heading="Deviation")
            row.prop(settings, "has_limit", text="")
            limit = row.row()
            limit.active = settings.has_limit
            limit.prop(settings, "deviation", text="")
        column = layout.column()
        column.prop(settings, "obstacle")
        column.prop(settings, "obstacles", text="Collection")
        column = layout.column(heading="Also In")
        column.prop(settings, "uses_shape_keys")
        column.prop(settings, "uses_frames")
        step = column.column()
        step.active = settings.uses_frames
        step.prop(settings, "frame_step")
        layout.prop(settings, "options")
        layout.operator(Reduce.bl_idname, icon="MOD_DECIM")
