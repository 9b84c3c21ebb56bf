# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reduces triangle meshes so that no layer ever pierces another, decided exactly.

Meshes are NumPy arrays: points of shape (n, 3), and triangles of shape (m, 3) with vertex numbers from 0. Points are
taken as doubles (a 32-bit float is also a double, so that nothing is rounded). Arrays of float64 and uint32 in C order
are read in place; others are converted. docs/python.md has examples.
"""

import json as _json
import math as _math
import os as _os
from operator import index as _index

import numpy as _np

from . import _selvedge
from ._selvedge import ArgumentError, Error, InputError

__version__ = _selvedge.version
__all__ = ["ArgumentError", "Error", "InputError", "Mesh", "Result", "Verdict", "generate", "key_poses", "option_names",
           "replay", "simplify", "verify"]


class Mesh:
    """Points and triangles; unpacks as `points, triangles = mesh`. `uvs` and `groups` are None, or what `simplify` takes."""

    uvs = groups = None

    def __init__(self, points, triangles):
        self.points = points
        self.triangles = triangles

    def __iter__(self):
        return iter((self.points, self.triangles))

    def __repr__(self):
        return f"<{type(self).__name__}: {len(self.points)} points, {len(self.triangles)} triangles>"


class Result(Mesh):
    """A reduced mesh.

    `vertices[i]` is the vertex of the input that vertex i is (with placement="optimal", one of those that were merged
    there), `birth[i]` the triangle of the input that triangle i was. `accepted` says whether the exact judge accepts
    the mesh, `reached` whether the target was reached, `stopped` whether the progress function ended the reduction.
    `log` and `collapses` (rows: removed, kept) are empty unless log=True was given. `uvs` are texture coordinates in the
    form in which they were given, `normal_vectors` those of corners, of shape (triangles, 3, 3); None where there are none.
    `attributes` are those of its vertices, by name.
    """

    def __init__(self, run, index_type, form_of_uvs="corner"):
        points, triangles = run.mesh()
        super().__init__(points, _as(triangles, index_type))
        self.uvs = _in_form(form_of_uvs, run.uvs(), len(points), triangles)
        self.normal_vectors = _in_form("corner", run.normals(), len(points), triangles)
        self.attributes = run.attributes()
        self._run = run
        self._report = None
        self.vertices = run.vertices()
        self.birth = run.triangles()
        self.accepted = run.is_accepted()
        self.reached = run.is_reached()
        self.stopped = run.is_stopped()
        self.log = run.log()
        self.collapses = run.collapses()

    def __repr__(self):
        words = ["accepted" if self.accepted else "NOT accepted", "target reached" if self.reached else "target not reached"]
        return f"{super().__repr__()[:-1]}, {', '.join(words)}>"

    @property
    def report(self):
        """The report of the run, as `selvedge simplify --report` writes it, without what is about files (docs/report.md)."""
        return _json.loads(self._report_text())

    def __getstate__(self):
        return {**self.__dict__, "_report": self._report_text(), "_run": None}

    def _report_text(self):
        if self._report is None:
            self._report = self._run.report()
        return self._report


class Verdict:
    """What a judge says. True where the mesh, or every step of the log, is accepted."""

    def __init__(self, accepted, report, **others):
        self.accepted = accepted
        self.report = _json.loads(report)
        self.__dict__.update(others)

    def __bool__(self):
        return self.accepted

    def __repr__(self):
        return f"<Verdict: {'accepted' if self.accepted else 'NOT accepted'}>"


def option_names():
    """Returns the names of the options of `simplify`, which are those in the reports of the program."""
    return _selvedge.option_names()


def simplify(points, triangles, *, uvs=None, normal_vectors=None, groups=None, attributes=None, poses=None, obstacle=None,
             weights=None, lock_vertices=None, log=False, progress=None, **options):
    """Reduces a mesh, and has the result judged. Returns a `Result`; with `lods`, a list of them.

    options: those of `selvedge simplify` by their names in its reports (`option_names`), such as ratio=0.3, faces=2000,
    error=0.001 (None: no limit), placement="optimal", lock=["collar"], part_ratios={"collar": 0.5}, threads=1.
    By default, placement is "vertices": every vertex of the result is one of the input. "optimal" comes nearer.
    lods, an option: ratios of levels of detail, such as [0.5, 0.25, 0.1], in place of ratio or faces. The list has a `Result`
    for each, in their order, the same as `--lods` makes in one run. Each is judged, and has its own report and log.
    uvs: texture coordinates, of shape (vertices, 2), or (triangles, 3, 2) for corners, or a pair (values, triangles) as in
    OBJ files and libigl: each triangle has the numbers of three rows of values. Seams stay seams, and no triangle of the
    texture turns over.
    normal_vectors: the same with three numbers each. `normals`, an option, says what becomes of them.
    groups: one name for each triangle, such as its material; borders between groups are kept as seams are. `lock`, `keep`,
    `drop_part`, `part_ratios` and `may_intersect` ("A:B") refer to the names.
    attributes: what else vertices have, such as colours: a dictionary of arrays with a row for each. `Result.attributes` has
    them of the result, interpolated and fitted where placement="optimal" has put a vertex to a new place.
    poses: further places of the points, an array of shape (poses, points, 3), such as frames of an animation: the result is
    legal in each. Those of the result are poses[:, result.vertices]. With key_poses="auto", for many poses, collapses are
    judged in a few that differ most, and in those in which the result would have new pairs; the result is judged in all.
    obstacle: a `Mesh` or (points, triangles) that no face may touch or pass through.
    weights: one number for each vertex, at least 0: how costly it is to remove, relative to the largest.
    lock_vertices: vertices that do not move: their numbers, from 0, or an array of booleans with one for each vertex.
    progress: called as progress(faces_input, faces_target, faces) now and then; when it returns true, the reduction ends
    with what it has reached. What it throws ends the call, and so does Ctrl-C.

    Triangles of the result have the type of those given, if that is an integer type of 32 or 64 bits. Throws TypeError for
    an unknown option, ArgumentError (a ValueError) and InputError (a mesh that is not acceptable). The work is done without
    the GIL.
    """
    names = _selvedge.option_names()
    for name in options:
        if name not in names:
            raise TypeError(f"simplify() has no option '{name}'; the nearest is '{_selvedge.nearest(name, names)}'")
    points, triangle_array = _points(points), _array("triangles", triangles)
    labels, form_of_uvs, form_of_normals = _labels(len(points), triangle_array, uvs, normal_vectors, groups)
    if form_of_uvs == "vertex" and options.get("sewn"):
        raise ArgumentError("uvs: sewn makes one vertex of several, which differ in their texture coordinates along seams; give "
                            "those of corners: uvs[triangles]")
    given = [pair for name, value in options.items() for pair in _texts(name, value)] + [("log", _text(bool(log)))]
    runs = _selvedge.reduce(points, _triangles(triangle_array), given, labels, form_of_normals == "vertex",
                            [(str(name), _array(f"the attribute '{name}'", values)) for name, values in (attributes or {}).items()],
                            [] if lock_vertices is None else _vertex_numbers(lock_vertices, len(points)),
                            None if weights is None else _weights(weights, len(points)),
                            None if obstacle is None else _mesh(obstacle, "obstacle"),
                            [] if poses is None else _poses(poses),
                            None if progress is None else lambda *counts: bool(progress(*counts)))
    results = [Result(run, triangle_array.dtype, form_of_uvs) for run in runs]
    for name, values in (attributes or {}).items():
        for result in results:
            if _np.ndim(values) == 1:
                result.attributes[str(name)] = result.attributes[str(name)][:, 0]
    return results[0] if options.get("lods") is None else results


def key_poses(points, poses, count):
    """Returns the numbers of `count` poses, in ascending order, that differ most from `points` and from each other (all,
    when there are no more): those in which simplify(..., key_poses="auto") begins, when `count` is their square root."""
    return _selvedge.key_poses(_points(points), _poses(poses), _whole("count", count))


def verify(points, triangles, original=None, *, obstacle=None, poses=None, original_poses=None, groups=None,
           original_groups=None, uvs=None, original_uvs=None, normal_vectors=None, original_normal_vectors=None,
           clearance=None, weld=0, may_intersect=(), drop_part=(), drop_smaller=0, threads=None):
    """Judges a mesh exactly: by itself, or as a result of reducing `original`, a `Mesh` or (points, triangles).

    Returns a `Verdict`, which is true when `selvedge verify` would exit with 0 for a file of this mesh: there are no new pairs
    (without `original`: no pairs), every piece has become one, and no layers have changed places. It has `pairs` and
    `new_pairs`, arrays of shape (k, 2): triangles that intersect or coincide (a degenerate one is a pair with itself), and
    those of them that the original does not have; `swaps`, an array of shape (k, 4): two triangles of the original, and the
    two of the mesh that have taken their places in the other order; and `report`, with the keys of `selvedge verify --report`
    that are not about files, such as report["layers"] (docs/report.md). All of it is numbered from 0 but for the report.

    obstacle: a `Mesh` or (points, triangles) that the mesh may not touch or pass through.
    poses, original_poses: further places of the points of each, in all of which the mesh is judged. For a result of
    `simplify`: poses[:, result.vertices] and poses.
    groups, original_groups: one name for each triangle, which stay where they were. For a result of `simplify`:
    [groups[triangle] for triangle in result.birth] and groups. `may_intersect` ("A:B", or several) refers to `groups`.
    uvs, original_uvs, normal_vectors, original_normal_vectors: those of a result of `simplify`, and what it was given. The
    report says where seams and values differ; the verdict does not depend on them.
    clearance: a distance that pieces keep from each other, or as far as they are in the original.
    weld: within what length borders of the original may have been joined, where the mesh does not keep pieces apart.
    drop_part, drop_smaller: what `simplify` was given: this is left out of the original.
    """
    of_original = (original_poses, original_groups, original_uvs, original_normal_vectors)
    if original is None and any(value is not None for value in of_original):
        raise ArgumentError("something is given of the original, but no original")
    before = None if original is None else _judged("original", original, *of_original)
    accepted, pairs, new_pairs, swaps, report = _selvedge.judge(
        _judged("mesh", (points, triangles), poses, groups, uvs, normal_vectors), before, None if obstacle is None else _mesh(obstacle, "obstacle"),
        _number("weld", weld), None if clearance is None else _number("clearance", clearance),
        _names(may_intersect), None if threads is None else _whole("threads", threads, least=1), _names(drop_part),
        _number("drop_smaller", drop_smaller))
    return Verdict(accepted, report, pairs=pairs, new_pairs=new_pairs, swaps=swaps)


def replay(points, triangles, log, *, uvs=None, normal_vectors=None, groups=None, obstacle=None, all=False):
    """Repeats a log on the mesh that it was made of, and judges every step; with `all`, beyond the first bad one.

    uvs, normal_vectors, groups: those of the reduction, if it had some: they make the lines that its limits are about.
    obstacle: a `Mesh` or (points, triangles) that the steps must keep clear of, too; that of the reduction, if it had one.

    Returns a `Verdict` with `mesh`, to which the steps lead. Throws InputError when the log cannot be read. The limits are
    those that the log declares; there are none of the judge, and further poses of the log are not judged.
    """
    beside = None if obstacle is None else _mesh(obstacle, "obstacle")
    points, triangles = _points(points), _triangles(triangles)
    labels, *_ = _labels(len(points), triangles, uvs, normal_vectors, groups)
    accepted, mesh, report = _selvedge.replay(points, triangles, log, labels, beside, all)
    return Verdict(accepted, report, mesh=Mesh(*mesh))


def generate(name, *, faces=100_000, layers=3, thickness=5e-4, gap=1e-3, fold_depth=0.02, folds=14, seed=1):
    """Makes a scene of `selvedge generate`, free of intersections by construction. Returns a `Mesh` with `groups`, one
    name for each triangle, and with `uvs` of shape (triangles, 3, 2). Lengths are in metres. Throws ArgumentError when a
    number is out of range."""
    arrays, groups, names, uvs = _selvedge.generate(
        str(name), _whole("faces", faces, 2**64 - 1), _whole("layers", layers), _number("thickness", thickness),
        _number("gap", gap), _number("fold_depth", fold_depth), _whole("folds", folds), _whole("seed", seed, 2**32 - 1))
    mesh = Mesh(*arrays)
    mesh.groups = [names[group] for group in groups]
    mesh.uvs = _in_form("corner", uvs) if len(uvs[1]) else None
    return mesh


def _whole(name, value, largest=2**31 - 1, least=0):
    try:
        number = _index(value)
    except TypeError:
        number = -1
    if not least <= number <= largest:
        raise ArgumentError(f"{name} is {value!r}, and not a whole number from {least} to {largest}")
    return number


def _number(name, value):
    try:
        return float(value)
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} is {value!r}, and not a number") from None


def _mesh(mesh, name):
    try:
        points, triangles = mesh
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} is neither a Mesh nor a pair (points, triangles)") from None
    return _points(points, "points" if name == "mesh" else f"points of the {name}"), _triangles(triangles)


def _judged(name, mesh, poses, groups, uvs, normal_vectors):
    points, triangles = _mesh(mesh, name)
    labels, *_ = _labels(len(points), triangles, uvs, normal_vectors, groups)
    return points, triangles, [] if poses is None else _poses(poses), labels


def _array(name, values):
    """Returns values as an array, and refuses what NumPy takes for one, or takes without a word of what is lost."""
    if isinstance(values, (str, bytes, _os.PathLike)):
        raise ArgumentError(f"{name}: {values!r} is no array; read the file first, by a package such as meshio or trimesh")
    if isinstance(values, _np.ma.MaskedArray):
        raise ArgumentError(f"{name}: the array has a mask, and what it masks would be taken as well; give an array without one")
    try:
        array = _np.asarray(values)
    except (TypeError, ValueError) as error:
        raise ArgumentError(f"{name}: this is no array of numbers: {error}") from None
    if array.dtype.kind == "c":
        raise ArgumentError(f"{name}: the numbers are complex; give their real parts alone, if these are meant")
    if array.ndim == 0:
        raise ArgumentError(f"{name}: {values!r} is no array")
    return array


def _points(points, name="points"):
    array = _array(name, points)
    try:
        return _np.ascontiguousarray(array, dtype=_np.float64)
    except (TypeError, ValueError) as error:
        raise ArgumentError(f"{name}: this is no array of numbers: {error}") from None


def _poses(poses):
    if isinstance(poses, (str, _os.PathLike, _np.ma.MaskedArray)):
        _array("poses", poses)
    poses = [_points(pose, "poses") for pose in poses]
    if any(pose.ndim != 2 for pose in poses):
        raise ArgumentError("poses is not an array of shape (poses, n, 3); for one pose, give [pose]")
    return poses


def _triangles(triangles):
    triangles = _array("triangles", triangles)
    if triangles.size and triangles.dtype.kind not in "iu":
        raise ArgumentError("triangles are not whole numbers")
    if triangles.size and (triangles.min() < 0 or triangles.max() >= 2**32):
        raise ArgumentError("a triangle has a vertex number that is negative or too large")
    return _np.ascontiguousarray(triangles, dtype=_np.uint32)


def _as(triangles, index_type):
    if index_type == _np.int32:
        return triangles.view(_np.int32)
    return triangles.astype(index_type) if index_type in (_np.int64, _np.uint64) else triangles


def _vertex_numbers(vertices, count):
    if isinstance(vertices, _np.ma.MaskedArray):
        _array("lock_vertices", vertices)
    try:
        listed = [] if isinstance(vertices, _np.ndarray) else list(vertices)
        array = vertices if isinstance(vertices, _np.ndarray) else _np.array(listed)
    except (TypeError, ValueError):
        raise ArgumentError("lock_vertices is not a list of vertex numbers") from None
    if array.dtype.kind != "b" and any(isinstance(vertex, (bool, _np.bool_)) for vertex in listed):
        raise ArgumentError("lock_vertices has both numbers and booleans; give the numbers of vertices, or a boolean for each")
    if array.ndim != 1:
        raise ArgumentError(f"lock_vertices has {array.ndim} dimensions; it is a list of vertex numbers, which has one")
    if array.dtype.kind == "b":
        if len(array) != count:
            raise ArgumentError(f"there are {count} points, but {len(array)} booleans in lock_vertices")
        array = _np.flatnonzero(array)
    if array.size and array.dtype.kind not in "iu" and not all(isinstance(v, int) for v in array):
        raise ArgumentError("lock_vertices has numbers that are not whole, or no numbers")
    if array.size and (array.min() < 0 or array.max() >= count):
        number = array.min() if array.min() < 0 else array.max()
        raise ArgumentError(f"lock_vertices has the number {number}, but the {count} vertices are numbered from 0")
    return array.tolist()


def _weights(weights, count):
    if isinstance(weights, _np.ma.MaskedArray):
        _array("weights", weights)
    weights = [float(weight) for weight in weights]
    if len(weights) != count:
        raise ArgumentError(f"there are {count} points, but {len(weights)} weights")
    for vertex, weight in enumerate(weights):
        if not 0 <= weight < _math.inf:
            raise ArgumentError(f"the weight of vertex {vertex}, counted from 0, is {weight}: no finite number of at least 0")
    return weights


def _labels(vertices, triangles, uvs, normal_vectors, groups):
    """Returns what corners and triangles have, and in which form uvs and normal_vectors are."""
    uv_arrays, form_of_uvs = _corner_values("uvs", uvs, 2, vertices, triangles)
    normal_arrays, form_of_normals = _corner_values("normal_vectors", normal_vectors, 3, vertices, triangles)
    return _selvedge.Labels(uv_arrays, normal_arrays, *_groups(groups, len(triangles))), form_of_uvs, form_of_normals


def _corner_values(name, given, columns, vertices, triangles):
    """Returns values, each triangle's numbers of three of them, and the form in which they are given."""
    if given is None:
        return None, "corner"
    if isinstance(given, tuple) and len(given) == 2:
        return (_points(given[0], name), _triangles(given[1])), "pair"
    array = _points(given, name)
    if array.shape == (vertices, columns):
        return (array, _triangles(triangles)), "vertex"
    if array.shape == (len(triangles), 3, columns):
        rows = _np.ascontiguousarray(array.reshape(-1, columns) + 0.0)  # -0 is 0
        _, first, numbers = _np.unique(rows.view(f"V{8 * columns}").reshape(-1), return_index=True, return_inverse=True)
        return (rows[first], _triangles(numbers.reshape(-1, 3))), "corner"
    raise ArgumentError(f"{name} has the shape {array.shape}, and not ({vertices}, {columns}), one for each vertex, nor "
                        f"({len(triangles)}, 3, {columns}), one for each corner; or give a pair (values, triangles)")


def _in_form(form, arrays, vertices=0, triangles=None):
    """Returns the values of corners as a pair, by corner or by vertex."""
    if arrays is None or form == "pair":
        return arrays
    of_corners = arrays[0][arrays[1]]
    if form == "corner":
        return of_corners
    of_vertices = _np.zeros((vertices, of_corners.shape[-1]))
    of_vertices[triangles] = of_corners
    return of_vertices


def _groups(groups, count):
    if groups is None:
        return [], []
    if len(groups) != count:
        raise ArgumentError(f"there are {count} triangles, but {len(groups)} names of groups")
    numbers = {}
    return [numbers.setdefault(str(group), len(numbers)) for group in groups], list(numbers)


def _text(value):
    if isinstance(value, (bool, _np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (float, _np.floating)):
        return repr(float(value))
    return str(value)


def _names(value):
    return [str(name) for name in ([value] if isinstance(value, str) else value or ())]


def _texts(name, value):
    if value is None:
        return [(name, "none")] if name == "error" else []
    if isinstance(value, dict):
        return [(name, f"{part}={_text(ratio)}") for part, ratio in value.items()]
    if isinstance(value, (list, tuple, set, frozenset)) or getattr(value, "ndim", 0) > 0:
        if name not in ("lock", "keep", "drop_part", "may_intersect", "part_ratios", "lods"):
            raise ArgumentError(f"{name} takes one value, and not several")
        if name == "lods" and (len(value) == 0 or isinstance(value, (set, frozenset))):
            raise ArgumentError(f"lods is {value!r}, and not a list of ratios, with a level for each")
        return [(name, _text(part)) for part in value]
    return [(name, _text(value))]
