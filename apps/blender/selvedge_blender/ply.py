# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""PLY files as the program reads and writes them: binary, little-endian, triangles alone.

Vertices and faces are structured NumPy arrays whose fields are the properties. Faces have the fields of FACE.
"""

import numpy

FACE = numpy.dtype([("corners", "u1"), ("vertex_indices", "<i4", 3), ("number", "<u4")])

_NAMES = {"u1": "uchar", "u4": "uint", "i4": "int", "f4": "float", "f8": "double"}
_TYPES = {name: numpy.dtype(code).newbyteorder("<") for code, name in _NAMES.items()}


def write(path, vertices, faces):
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}"]
    lines += [f"property {_NAMES[vertices.dtype[name].str[1:]]} {name}" for name in vertices.dtype.names]
    lines += [f"element face {len(faces)}", "property list uchar int vertex_indices", "property uint number", "end_header\n"]
    with open(path, "wb") as file:
        file.write("\n".join(lines).encode())
        vertices.tofile(file)
        faces.tofile(file)


def read(path):
    """Returns vertices and faces of a file that the program has made from one that `write` made."""
    counts, fields = [], []
    with open(path, "rb") as file:
        while (line := file.readline()) != b"end_header\n":
            words = line.decode().split()
            if words[0] == "element":
                counts.append(int(words[2]))
                fields.append([])
            elif words[:2] == ["property", "list"]:
                fields[-1] += [("corners", _TYPES[words[2]]), (words[4], _TYPES[words[3]], 3)]
            elif words[0] == "property":
                fields[-1].append((words[2], _TYPES[words[1]]))
        return tuple(numpy.fromfile(file, numpy.dtype(row), count) for row, count in zip(fields, counts))
