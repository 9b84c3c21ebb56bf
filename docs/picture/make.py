#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the picture of the README: a generated skirt of three layers, the same skirt reduced to 10 % without
the exact filter, and with it. The figures in the captions are read from the reports of these runs.

    apt-get install python3-vtk9 xvfb xauth
    xvfb-run -a /usr/bin/python3 docs/picture/make.py build/release/apps/selvedge docs/picture/layers.png
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from vtkmodules.all import (vtkActor, vtkCellArray, vtkPNGWriter, vtkPoints, vtkPolyData, vtkPolyDataMapper,
                            vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)

GENERATE = ["generate", "skirt", "--faces", "60000", "--layers", "3", "--thickness", "0", "--fold-depth", "0.03", "--gap", "0.0005"]
RATIO = "0.1"
COLOURS = {"lining": (0.85, 0.18, 0.20), "interlining": (0.98, 0.76, 0.20), "shell": (0.22, 0.40, 0.62),
           "pocket": (0.22, 0.40, 0.62), "waistband": (0.15, 0.28, 0.46), "loop": (0.15, 0.28, 0.46),
           "button": (0.15, 0.28, 0.46), "body": (0.88, 0.78, 0.70)}
PANEL = (400, 330)
AZIMUTH = 0.4
TOWARDS = (math.cos(AZIMUTH), math.sin(AZIMUTH))
# Where the camera stands, where it looks, its angle of view in degrees. The garment stands along y.
WHOLE = ((3 * TOWARDS[0], 1.0, -3 * TOWARDS[1]), (0, 0.9, 0), 24)
CLOSE_UP = ((3 * TOWARDS[0], 1.20, -3 * TOWARDS[1]), (0.2 * TOWARDS[0], 0.93, -0.2 * TOWARDS[1]), 5)


def run(program, *arguments):
    # 1 is the documented exit code of a run without the exact filter, whose result is written all the same.
    status = subprocess.run([program, *map(str, arguments), "--quiet"], stderr=subprocess.DEVNULL).returncode
    if status != (1 if "--no-intersection-check" in arguments else 0):
        sys.exit(f"{program} {arguments[0]} ended with exit code {status}")


def layers(path):
    """Reads the groups of an OBJ file, one set of triangles for each colour."""
    points, cells_by_colour, cells = vtkPoints(), {}, None
    for line in open(path):
        words = line.split()
        if words[:1] == ["v"]:
            points.InsertNextPoint(*map(float, words[1:4]))
        elif words[:1] == ["g"]:
            cells = cells_by_colour.setdefault(words[1].split("_")[0], vtkCellArray())
        elif words[:1] == ["f"]:
            cells.InsertNextCell(3, [int(word.split("/")[0]) - 1 for word in words[1:4]])
    return points, cells_by_colour


def panel(path, viewport, camera, shows_edges, caption):
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetViewport(*viewport)
    points, cells_by_colour = layers(path)
    for name, cells in cells_by_colour.items():
        surface = vtkPolyData()
        surface.SetPoints(points)
        surface.SetPolys(cells)
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(surface)
        actor = vtkActor()
        actor.SetMapper(mapper)
        look = actor.GetProperty()
        look.SetColor(*COLOURS[name])
        look.SetInterpolationToFlat()
        look.SetAmbient(0.25)
        look.SetDiffuse(0.8)
        if shows_edges:
            look.EdgeVisibilityOn()
            look.SetEdgeColor(*[0.55 * part for part in COLOURS[name]])
        renderer.AddActor(actor)
    text = vtkTextActor()
    text.SetInput(caption)
    text.SetPosition(10, 8 if camera is CLOSE_UP else PANEL[1] - 8)
    look = text.GetTextProperty()
    if camera is WHOLE:
        look.SetVerticalJustificationToTop()
    look.SetFontSize(17)
    look.SetColor(0.1, 0.1, 0.1)
    look.SetBackgroundColor(1, 1, 1)
    look.SetBackgroundOpacity(0.85)
    renderer.AddActor2D(text)
    view = renderer.GetActiveCamera()
    position, focus, angle = camera
    view.SetPosition(*position)
    view.SetFocalPoint(*focus)
    view.SetViewUp(0, 1, 0)
    view.SetViewAngle(angle)
    renderer.ResetCameraClippingRange()
    return renderer


def main(program, picture):
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / name for name in ("original.obj", "unguarded.obj", "guarded.obj")]
        run(program, *GENERATE, "-o", files[0])
        captions, close_ups = [], ["Close-up: the blue outer layer\nhides a yellow and a red one"]
        for file, title, seen, options in (
                (files[1], "unguarded", "Yellow: the layer beneath\npokes through",
                 ["--no-intersection-check"]),
                (files[2], "by Selvedge", "Nothing pokes through", [])):
            report = file.with_suffix(".json")
            run(program, "simplify", files[0], "-o", file, "--ratio", RATIO, "--report", report, *options)
            figures = json.loads(report.read_text())
            captions.append(f"Reduced to 10 %,\n{title}:\n"
                            f"{figures['verified']['new_pairs']:,} pairs of\ntriangles intersect")
            close_ups.append(seen)
        captions.insert(0, f"Input: a skirt in\nthree layers,\n{figures['faces']['input']:,} triangles")

        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(8)
        window.SetSize(3 * PANEL[0], 2 * PANEL[1])
        between_panels = vtkRenderer()
        between_panels.SetBackground(1, 1, 1)
        window.AddRenderer(between_panels)
        for column, file in enumerate(files):
            left, right = column / 3 + 0.003, (column + 1) / 3 - 0.003
            window.AddRenderer(panel(file, (left, 0.5, right, 1), WHOLE, False, captions[column]))
            window.AddRenderer(panel(file, (left, 0, right, 0.5), CLOSE_UP, column > 0, close_ups[column]))
        window.Render()
        image = vtkWindowToImageFilter()
        image.SetInput(window)
        image.ReadFrontBufferOff()
        writer = vtkPNGWriter()
        writer.SetCompressionLevel(9)
        writer.SetFileName(picture)
        writer.SetInputConnection(image.GetOutputPort())
        writer.Write()


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
