#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the results that `quality --write FOLDER` has written, side by side: a row for each ratio, the original
first, then every program.

    apt-get install python3-vtk9 xvfb xauth
    xvfb-run -a /usr/bin/python3 test/benchmark/quality_sheet.py FOLDER MESH SHEET.png [RATIO...]

MESH is the name in the first column of the table. Faces are shaded flat, as they are. The camera looks along
the axis along which the mesh is thinnest, so that its largest side is seen.
"""
import sys
from pathlib import Path

from vtkmodules.all import (vtkActor, vtkOBJReader, vtkPNGWriter, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                            vtkTextActor, vtkWindowToImageFilter)

PROGRAMS = ["selvedge", "selvedge distance alone", "selvedge at vertices", "CGAL plane", "CGAL LindstromTurk", "OpenMesh",
            "meshoptimizer"]
PANEL = (420, 520)


def surface(path):
    reader = vtkOBJReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def panel(path, caption, viewport):
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetViewport(*viewport)
    data = surface(path)
    data.GetPointData().SetNormals(None)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(0.55, 0.62, 0.72)
    look.SetInterpolationToFlat()
    look.SetAmbient(0.15)
    look.SetDiffuse(0.9)
    renderer.AddActor(actor)
    text = vtkTextActor()
    text.SetInput(f"{caption}\n{data.GetNumberOfPolys():,} faces")
    text.SetPosition(8, 8)
    text.GetTextProperty().SetFontSize(16)
    text.GetTextProperty().SetColor(0.1, 0.1, 0.1)
    renderer.AddActor2D(text)
    bounds = data.GetBounds()
    sizes = [bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3)]
    middle = [(bounds[2 * axis + 1] + bounds[2 * axis]) / 2 for axis in range(3)]
    along, up = sizes.index(min(sizes)), sizes.index(max(sizes))
    if along == up:
        along, up = 1, 2
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(*middle)
    place = list(middle)
    place[along] += 1
    camera.SetPosition(*place)
    camera.SetViewUp(*[1.0 if axis == up else 0.0 for axis in range(3)])
    renderer.ResetCamera()
    camera.Zoom(1.05)
    return renderer


def main(folder, mesh, sheet, *ratios):
    folder = Path(folder)
    ratios = ratios or sorted({path.name[len(mesh) + 1:].rsplit("-", 1)[0]
                               for path in folder.glob(f"{mesh}-*-0.obj")}, key=float, reverse=True)
    if not ratios:
        sys.exit(f"{folder} has no results of {mesh}")
    columns = 1 + len(PROGRAMS)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(columns * PANEL[0], len(ratios) * PANEL[1])
    for row, ratio in enumerate(ratios):
        paths = [folder / f"{mesh}-original.obj"]
        paths += [folder / f"{mesh}-{ratio}-{number}.obj" for number in range(len(PROGRAMS))]
        for column, (path, caption) in enumerate(zip(paths, [f"{mesh}, original"] + PROGRAMS)):
            viewport = (column / columns, 1 - (row + 1) / len(ratios), (column + 1) / columns, 1 - row / len(ratios))
            window.AddRenderer(panel(path, caption, viewport))
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(sheet)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
