#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the figures of the manual: `figures.py README.md FOLDER`.

tunnelling.svg shows, in cross-section, a collapse that moves a layer through a small piece. running_times.svg shows the table
"Measured" of the README.
"""
import pathlib
import re
import sys

BLUE, PALE, RED, GREY = "#38669e", "#dbe4ef", "#c8373c", "#8a8a8a"


def svg(width, height, elements):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'font-family="sans-serif" font-size="13">\n' + "\n".join(elements) + "\n</svg>\n")


def text(x, y, words, anchor="start", colour="black"):
    return f'<text x="{x:g}" y="{y:g}" text-anchor="{anchor}" fill="{colour}">{words}</text>'


def line(points, colour, style=""):
    path = " L ".join(f"{x:g} {y:g}" for x, y in points)
    return f'<path d="M {path}" fill="none" stroke="{colour}" stroke-width="2.5" {style}/>'


def tunnelling():
    """A layer whose vertex m moves to its neighbour t, and a small piece in what the layer sweeps over."""
    first, mover, target, last = (15, 120), (75, 30), (150, 120), (195, 110)
    piece = [(70, 85), (92, 75)]

    def panel(left, caption, at, is_sweep_shown):
        def shift(points):
            return [(x + left, y) for x, y in points]

        place = tuple(m + at * (t - m) for m, t in zip(mover, target))
        if is_sweep_shown:
            corners = " ".join(f"{x:g},{y:g}" for x, y in shift([first, mover, target]))
            yield f'<polygon points="{corners}" fill="{PALE}"/>'
            yield line(shift([mover, target]), GREY, 'stroke-dasharray="4 4"')
        yield line(shift([first, place, target, last]), BLUE)
        yield line(shift(piece), RED)
        (x, y), (u, v) = shift([place, target])
        if at < 1:
            yield text(x, y - 8, "m", "middle", BLUE)
        yield text(u, v + 18, "t", "middle", BLUE)
        yield text(left + 105, 165, caption, "middle")

    elements = [*panel(0, "before: embedded", 0, False), *panel(220, "on the way", 0.45, True),
                *panel(440, "after: embedded", 1, False)]
    return svg(650, 180, elements)


def running_times(readme):
    """The columns `time` and `time unguarded` of the table, as bars; CGAL's loop without the filter is 1."""
    measured = readme.split("<!-- [measured] -->")[1]
    rows = re.findall(r"^\| ([^|]+) \| ([\d,]+) \| ([\d.]+) \| ([\d.]+) \|", measured, re.MULTILINE)
    if not rows:
        sys.exit("figures.py: README.md has no table between the marks [measured]")
    left, unit, step = 230, 340, 46
    elements = []
    for i, (mesh, faces, guarded, unguarded) in enumerate(rows):
        y = 12 + i * step
        elements.append(text(left - 8, y + 14, mesh.strip().replace("`", ""), "end"))
        elements.append(text(left - 8, y + 29, f"{faces} faces", "end", GREY))
        for offset, share, colour in ((0, float(guarded), BLUE), (16, float(unguarded), GREY)):
            elements.append(f'<rect x="{left}" y="{y + offset}" width="{share * unit:g}" height="14" fill="{colour}"/>')
            elements.append(text(left + share * unit + 6, y + offset + 12, f"{share:.2f}"))
    bottom = 12 + len(rows) * step
    elements.append(line([(left + unit, 4), (left + unit, bottom)], RED))
    elements.append(text(left + unit, bottom + 16, "1 = CGAL's loop, without the filter", "middle", RED))
    elements.append(text(left, bottom + 36, "Selvedge with the filter", "start", BLUE))
    elements.append(text(left + 180, bottom + 36, "Selvedge without it", "start", GREY))
    return svg(760, bottom + 46, elements)


def main():
    readme, folder = map(pathlib.Path, sys.argv[1:])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "tunnelling.svg").write_text(tunnelling())
    (folder / "running_times.svg").write_text(running_times(readme.read_text(encoding="utf-8")))


if __name__ == "__main__":
    main()
