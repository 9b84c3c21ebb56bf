#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the table of docs/poses.md on the number of poses: which pairs of faces intersect in them, and what it costs to have none.

    poses.py SELVEDGE MESH... [--poses 1 2 5 10] [--ratio 0.1]

MESH is an OBJ file of triangles, which is twisted and bent; or `skirt:N`, a generated skirt of N faces with its own poses; or a folder
of OBJ files, the frames of a simulation in natural order, of which the first is the mesh, and poses are taken evenly from all. Each is
reduced in its own pose alone by meshoptimizer (libmeshoptimizer.so) and by Selvedge, and by Selvedge in all poses. Pairs are those
in the further poses together, as `selvedge verify --pose` counts them. Seconds are the CPU time of the whole program.
"""
import argparse
import array
import ctypes
import ctypes.util
import json
import math
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile


def read_obj(path):
    points, faces = [], []
    for line in open(path, encoding="utf-8"):
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            if len(words) != 4:
                sys.exit(f"poses.py: {path}: a face has {len(words) - 1} corners; cut it into triangles")
            faces.append(tuple(int(word.split("/")[0]) - 1 for word in words[1:]))
    return points, faces


def write_ply(path, points, faces):
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty double x\nproperty double y\n"
              f"property double z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_bytes(header.encode() + array.array("d", (c for p in points for c in p)).tobytes() +
                     b"".join(struct.pack("<Biii", 3, *face) for face in faces))


def bent_and_twisted(points, number, count):
    """A pose between the mesh's own and one that is twisted about its longest side by 1.5 radians, or bent by 1.2."""
    low, high = ([f(p[i] for p in points) for i in range(3)] for f in (min, max))
    up = max(range(3), key=lambda i: high[i] - low[i])
    a, b = (up + 1) % 3, (up + 2) % 3
    centre = [(l + h) / 2 for l, h in zip(low, high)]
    height, share = high[up] - low[up], (number + 1) / count * (-1 if number // 2 % 2 else 1)
    result = []
    for p in points:
        q = [x - c for x, c in zip(p, centre)]
        if number % 2 == 0:
            angle = 1.5 * share * q[up] / height
            q[a], q[b] = math.cos(angle) * q[a] - math.sin(angle) * q[b], math.sin(angle) * q[a] + math.cos(angle) * q[b]
        else:
            radius = height / (1.2 * share)
            angle = q[up] / radius
            q[a], q[up] = radius - (radius - q[a]) * math.cos(angle), (radius - q[a]) * math.sin(angle)
        result.append(tuple(q))
    return result


def run(*command):
    """Runs a program; returns its output and its CPU seconds."""
    with tempfile.TemporaryFile() as out:
        # The shell in between is small: a child's peak begins with what its parent has.
        process = subprocess.Popen(["sh", "-c", '"$@"; exit $?', "sh", *command], stdout=out)
        _, status, usage = os.wait4(process.pid, 0)
        out.seek(0)
        if os.waitstatus_to_exitcode(status) not in (0, 1):
            sys.exit("poses.py: failed: " + " ".join(map(str, command)))
        return out.read(), usage.ru_utime + usage.ru_stime


def meshoptimizer(points, faces, target):
    library = ctypes.CDLL(ctypes.util.find_library("meshoptimizer") or "libmeshoptimizer.so")
    library.meshopt_simplify.restype = ctypes.c_size_t
    library.meshopt_simplify.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p, ctypes.c_size_t,
                                         ctypes.c_size_t, ctypes.c_size_t, ctypes.c_float, ctypes.c_uint, ctypes.c_void_p]
    numbers = (ctypes.c_uint * (3 * len(faces)))(*(v for face in faces for v in face))
    left = (ctypes.c_uint * (3 * len(faces)))()
    coordinates = (ctypes.c_float * (3 * len(points)))(*(c for p in points for c in p))
    size = library.meshopt_simplify(left, numbers, 3 * len(faces), coordinates, len(points), 12, 3 * target, 1.0, 0, None)
    return [tuple(left[i:i + 3]) for i in range(0, size, 3)]


class Mesh:
    def __init__(self, selvedge, name, count, folder):
        self.selvedge, self.folder = selvedge, folder
        if name.startswith("skirt:"):
            run(selvedge, "generate", "skirt", "-o", folder / "rest.obj", "--faces", name[6:], "--poses", str(count), "--poses-out",
                folder / "pose_{pose}.obj", "--quiet")
            self.points, self.faces = read_obj(folder / "rest.obj")
            self.poses = [read_obj(folder / f"pose_{i + 1}.obj")[0] for i in range(count)]
        elif pathlib.Path(name).is_dir():
            frames = sorted(pathlib.Path(name).glob("*.obj"), key=lambda f: [int(n) for n in re.findall(r"\d+", f.name)])
            self.points, self.faces = read_obj(frames[0])
            self.poses = [read_obj(frames[(i + 1) * (len(frames) - 1) // count])[0] for i in range(count)]
        else:
            self.points, self.faces = read_obj(name)
            self.poses = [bent_and_twisted(self.points, i, count) for i in range(count)]
        self.row = {p: i for i, p in reversed(list(enumerate(self.points)))}
        self.files = self.write("in", range(len(self.points)), self.faces)

    def write(self, name, rows, faces):
        """Writes these rows of the vertices in every pose; returns the file and the options for the poses."""
        options = []
        for number, pose in enumerate([self.points] + self.poses):
            path = self.folder / f"{name}_{number}.ply"
            write_ply(path, [pose[row] for row in rows], faces)
            options += ["--pose", path] if number > 0 else [path]
        return options

    def pairs(self, files):
        verdict = json.loads(run(self.selvedge, "verify", *files, "--json")[0])
        return sum(pose["pairs"] for pose in verdict["verified"]["poses"])

    def reduced(self, ratio, is_in_all):
        """Returns the faces of the result, its pairs, CPU seconds and megabytes."""
        out, report = self.folder / "out.obj", self.folder / "report.json"
        _, seconds = run(self.selvedge, "simplify", *self.files[:None if is_in_all else 1], "-o", out, "--ratio", str(ratio),
                         "--threads", "1", "--quiet", "--report", report)
        megabytes = json.loads(report.read_bytes())["memory"]["peak_bytes"] / 1e6
        points, faces = read_obj(out)
        return len(faces), self.pairs(self.write("out", [self.row[p] for p in points], faces)), seconds, megabytes


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("selvedge", type=pathlib.Path)
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--poses", type=int, nargs="+", default=[1, 2, 5, 10])
    parser.add_argument("--ratio", type=float, default=0.1)
    arguments = parser.parse_args()
    print("| mesh | faces | further poses | pairs in them: input | meshoptimizer | own pose guarded | all guarded "
          "| seconds, own pose | all | MB, own pose | all | faces left, all |\n|" + " --- |" * 12)
    for name in arguments.meshes:
        for count in arguments.poses:
            with tempfile.TemporaryDirectory() as folder:
                mesh = Mesh(arguments.selvedge.resolve(), name, count, pathlib.Path(folder))
                theirs = meshoptimizer(mesh.points, mesh.faces, int(arguments.ratio * len(mesh.faces)))
                of_theirs = mesh.pairs(mesh.write("theirs", range(len(mesh.points)), theirs))
                _, own, own_seconds, own_megabytes = mesh.reduced(arguments.ratio, False)
                left, everywhere, seconds, megabytes = mesh.reduced(arguments.ratio, True)
                print(f"| {pathlib.Path(name).stem} | {len(mesh.faces):,} | {count} | {mesh.pairs(mesh.files):,} | {of_theirs:,} "
                      f"| {own:,} | {everywhere:,} | {own_seconds:.1f} | {seconds:.1f} | {own_megabytes:.0f} | {megabytes:.0f} "
                      f"| {left:,} |",
                      flush=True)


if __name__ == "__main__":
    main()
