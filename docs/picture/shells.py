#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the picture of docs/nested_surfaces.md: a part of a section through closed shells inside one another, as they are, reduced
to 3 % without the exact filter, and with it.

    docs/picture/shells.py build/release/apps/selvedge docs/picture/shells.svg
"""
from pathlib import Path
import subprocess
import sys
import tempfile

LAYERS, FACES, GAP = 4, 6000, "0.01"
HEIGHT = 0.0123  # of the plane that is cut: no vertex lies in it
X, Y, SIZE, WINDOW, SCALE = 0.37, 0.06, 0.16, 300, 300 / 0.16
COLOURS = ["#1f5fa8", "#e0a100", "#c22f2f", "#2d8a4e"]


def read(path):
    """Returns points and triangles of an OFF file, and for every vertex one of its shell, the same for all of it."""
    words = path.read_text().split()[1:]
    vertices, faces = int(words[0]), int(words[1])
    numbers = words[3:]
    points = [tuple(map(float, numbers[3 * i:3 * i + 3])) for i in range(vertices)]
    start = 3 * vertices
    triangles = [tuple(map(int, numbers[start + 4 * i + 1:start + 4 * i + 4])) for i in range(faces)]
    shell = list(range(vertices))

    def root(i):
        while shell[i] != i:
            shell[i] = shell[shell[i]]
            i = shell[i]
        return i
    for a, b, c in triangles:
        shell[root(a)] = shell[root(b)] = root(c)
    return points, triangles, [root(i) for i in range(vertices)]


def write_shells(program, path):
    """Writes shells with triangles of their own, as those of a segmented scan are: each comes from nested ones of another seed."""
    all_points, all_triangles = [], []
    for layer in range(LAYERS):
        subprocess.run([program, "generate", "nested", "-o", path, "--faces", str(LAYERS * FACES), "--layers", str(LAYERS),
                        "--gap", GAP, "--seed", str(layer + 1), "--quiet"], check=True)
        points, triangles, shell = read(path)
        wanted = sorted(set(shell), key=lambda s: max(points[i][0] for i in range(len(points)) if shell[i] == s))[layer]
        number = {}
        for i, point in enumerate(points):
            if shell[i] == wanted:
                number[i] = len(all_points)
                all_points.append(point)
        all_triangles += [tuple(number[i] for i in triangle) for triangle in triangles if shell[triangle[0]] == wanted]
    path.write_text(f"OFF\n{len(all_points)} {len(all_triangles)} 0\n" + "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in all_points) +
                    "".join(f"3 {a} {b} {c}\n" for a, b, c in all_triangles))
    subprocess.run([program, "verify", path], check=True, stdout=subprocess.DEVNULL)


def sections(path):
    """Returns the segments in which the plane cuts each shell, the innermost first."""
    points, triangles, shell = read(path)
    lines = {}
    for triangle in triangles:
        segment = lines.setdefault(shell[triangle[0]], [])
        for i in range(3):
            p, q = points[triangle[i]], points[triangle[i - 1]]
            if (p[2] < HEIGHT) != (q[2] < HEIGHT):
                t = (HEIGHT - p[2]) / (q[2] - p[2])
                segment.append((p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])))
    return sorted(lines.values(), key=lambda line: max(x for x, y in line))


def panel(number, path, caption):
    parts = [f'<svg x="{number * (WINDOW + 12)}" y="0" width="{WINDOW}" height="{WINDOW}"><rect width="100%" height="100%" fill="#fafafa"/>']
    for colour, line in zip(COLOURS, sections(path)):
        d = "".join(f"{'ML'[i % 2]}{(x - X) * SCALE:.1f} {WINDOW - (y - Y) * SCALE:.1f}" for i, (x, y) in enumerate(line))
        parts.append(f'<path d="{d}" stroke="{colour}"/>')
    parts.append(f'</svg><text x="{number * (WINDOW + 12) + 4}" y="{WINDOW + 18}">{caption}</text>')
    return "".join(parts)


def main(program, picture):
    with tempfile.TemporaryDirectory() as folder:
        original, pierced, apart = (Path(folder) / name for name in ("original.off", "pierced.off", "apart.off"))
        write_shells(program, original)
        reduce = [program, "simplify", original, "--ratio", "0.03", "--error", "none", "--quiet"]
        unguarded = subprocess.run([*reduce, "-o", pierced, "--no-intersection-check"], stderr=subprocess.PIPE, text=True)
        pairs = unguarded.stderr.split("check: ")[1].split(" new")[0]
        subprocess.run([*reduce, "-o", apart], check=True)
        panels = [panel(0, original, "24,000 faces"), panel(1, pierced, f"3 %, unguarded: {pairs} pairs intersect"),
                  panel(2, apart, "3 %, Selvedge: none")]
    Path(picture).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {3 * WINDOW + 24} {WINDOW + 26}" font-family="sans-serif" '
        f'font-size="14" fill="#222"><style>path {{ fill: none; stroke-width: 1.6 }}</style>'
        f'<rect width="100%" height="100%" fill="#fff"/>' + "".join(panels) + "</svg>\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
