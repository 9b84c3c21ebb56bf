# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package keeps its promises, judged by the library. Run by ctest, with PYTHONPATH set to the build."""

import copy
import inspect
import json
import os
import pathlib
import pickle
import re
import signal
import subprocess
import tempfile
import threading
import unittest

import numpy as np

import selvedge
from selvedge import fast_simplification, igl, pyfqmr, trimesh


def layers(faces=2000, count=3):
    return selvedge.generate("sheets", faces=faces, layers=count, gap=1e-3)


class Simplify(unittest.TestCase):
    def test_keeps_layers_apart_and_says_which_vertices_are_left(self):
        mesh = layers()
        for index_type in (np.int32, np.int64, np.uint32):
            result = selvedge.simplify(mesh.points, mesh.triangles.astype(index_type), ratio=0.4)
            self.assertEqual(result.triangles.dtype, index_type)
            self.assertTrue(result.accepted and result.reached)
            self.assertTrue(selvedge.verify(*result, original=tuple(mesh)))
            np.testing.assert_array_equal(result.points, mesh.points[result.vertices])
            self.assertEqual(len(result.birth), len(result.triangles))
        control = selvedge.simplify(*mesh, ratio=0.1, intersection_check=False)
        self.assertFalse(control.accepted)
        self.assertGreater(len(selvedge.verify(*control).pairs), 0)

    def test_texture_coordinates_keep_their_seams_in_every_form(self):
        mesh = selvedge.generate("skirt", faces=6000, thickness=0)
        rows, numbers = np.unique(mesh.uvs.reshape(-1, 2), axis=0, return_inverse=True)
        of_corners = numbers.reshape(-1, 3)
        bare = selvedge.simplify(*mesh, ratio=0.3, log=True)
        self.assertIsNone(bare.uvs)
        result = selvedge.simplify(*mesh, uvs=mesh.uvs, ratio=0.3, log=True)
        self.assertTrue(result.accepted and result.reached)
        self.assertFalse(np.array_equal(result.triangles, bare.triangles))

        # Each corner has what a corner of the input has at its vertex.
        known = {(*corner, *uv) for corner, uv in zip(mesh.triangles.reshape(-1, 1).tolist(), mesh.uvs.reshape(-1, 2).tolist())}
        now = zip(result.vertices[result.triangles].reshape(-1, 1).tolist(), result.uvs.reshape(-1, 2).tolist())
        self.assertTrue(all((*corner, *uv) in known for corner, uv in now))

        def areas(uvs):
            a, b, c = np.moveaxis(uvs, 1, 0)
            return np.cross(b - a, c - a)
        np.testing.assert_array_equal(np.sign(areas(result.uvs)), np.sign(areas(mesh.uvs))[result.birth])

        pair = selvedge.simplify(*mesh, uvs=(rows, of_corners), ratio=0.3)
        np.testing.assert_array_equal(pair.triangles, result.triangles)
        np.testing.assert_array_equal(pair.uvs[0][pair.uvs[1]], result.uvs)

        # As other files have it: seams part the vertices.
        both = np.stack([mesh.triangles, of_corners], axis=2).reshape(-1, 2)
        split, parted = np.unique(both, axis=0, return_inverse=True)
        points, triangles = mesh.points[split[:, 0]], parted.reshape(-1, 3)
        for placement in ("vertices", "optimal"):
            by_vertex = selvedge.simplify(points, triangles, uvs=rows[split[:, 1]], ratio=0.3, placement=placement)
            by_corner = selvedge.simplify(points, triangles, uvs=mesh.uvs, ratio=0.3, placement=placement)
            self.assertTrue(by_vertex.accepted and by_vertex.reached)
            self.assertEqual(by_vertex.uvs.shape, (len(by_vertex.points), 2))
            np.testing.assert_array_equal(by_vertex.uvs[by_vertex.triangles], by_corner.uvs)
            if placement == "vertices":
                np.testing.assert_array_equal(by_vertex.uvs, rows[split[:, 1]][by_vertex.vertices])

        self.assertTrue(selvedge.replay(*mesh, result.log, uvs=mesh.uvs))
        self.assertFalse(selvedge.replay(*mesh, bare.log, uvs=mesh.uvs))  # which leaves seams that it does not know
        self.assertIsInstance(pickle.loads(pickle.dumps(result)).uvs, np.ndarray)

    def test_verify_compares_texture_coordinates_and_normals(self):
        mesh = selvedge.generate("skirt", faces=6000, thickness=0)
        upward = np.tile((0.0, 1.0, 0.0), (len(mesh.points), 1))
        result = selvedge.simplify(*mesh, uvs=mesh.uvs, normal_vectors=upward, normals="keep", ratio=0.3)

        def attributes_with(uvs):
            verdict = selvedge.verify(*result, original=mesh, uvs=uvs, original_uvs=mesh.uvs,
                                      normal_vectors=result.normal_vectors, original_normal_vectors=upward)
            self.assertTrue(verdict)
            found = verdict.report["attributes"]
            return {kept["name"]: (kept["combinations"], kept["original"]) for kept in found["kept"]}, found["lost"]
        kept, lost = attributes_with(result.uvs)
        self.assertEqual(lost, [])
        for combinations, original in (kept["uv"], kept["normal"]):
            self.assertTrue(combinations == original > 0)
        self.assertEqual(attributes_with(result.uvs + 0.5)[0]["uv"][1], 0)
        self.assertEqual(attributes_with(None)[1], ["uv"])
        with self.assertRaisesRegex(selvedge.ArgumentError, "no original"):
            selvedge.verify(*result, original_uvs=mesh.uvs)

    def test_normals_keep_their_edges(self):
        points, triangles = selvedge.generate("nested", faces=1000, layers=1)
        smooth = points / np.linalg.norm(points, axis=1)[:, None]
        bare = selvedge.simplify(points, triangles, ratio=0.3)
        self.assertIsNone(bare.normal_vectors)
        kept = selvedge.simplify(points, triangles, normal_vectors=smooth, normals="keep", ratio=0.3, log=True)
        np.testing.assert_array_equal(kept.normal_vectors, smooth[kept.vertices][kept.triangles])
        self.assertTrue(selvedge.replay(points, triangles, kept.log, normal_vectors=smooth))
        corners = smooth[triangles]
        corners[len(corners) // 2:] *= -1  # a hard edge
        hard = selvedge.simplify(points, triangles, normal_vectors=corners, normals="keep", ratio=0.3)
        self.assertTrue(hard.accepted)
        self.assertEqual(hard.normal_vectors.shape, (len(hard.triangles), 3, 3))
        is_turned = hard.birth >= len(triangles) // 2
        outward = (hard.normal_vectors * hard.points[hard.triangles]).sum(axis=2) > 0
        np.testing.assert_array_equal(outward.all(axis=1), ~is_turned)

    def test_attributes_follow_their_vertices(self):
        mesh = layers(1000)
        given = {"height": mesh.points[:, 1].copy(), "place": mesh.points.astype(np.float32),
                 "number": np.arange(len(mesh.points), dtype=np.uint32)[:, None]}
        kept = selvedge.simplify(*mesh, attributes=given, weights=np.ones(len(mesh.points)), ratio=0.3)
        self.assertEqual(set(kept.attributes), set(given))
        for name, values in given.items():
            self.assertEqual(kept.attributes[name].dtype, values.dtype)
            np.testing.assert_array_equal(kept.attributes[name], values[kept.vertices])
        placed = selvedge.simplify(*mesh, attributes=given, ratio=0.3, placement="optimal")
        self.assertGreater((placed.points != mesh.points[placed.vertices]).sum(), 0)
        # On flat sheets a mixture of heights is the height of the mixture, but for places beside the surface.
        self.assertLess(np.abs(placed.attributes["height"] - placed.points[:, 1]).max(), 0.01)
        self.assertGreater((placed.attributes["height"] != mesh.points[placed.vertices, 1]).sum(), 0)
        np.testing.assert_array_equal(placed.attributes["number"][:, 0], placed.vertices)
        self.assertEqual(pickle.loads(pickle.dumps(kept)).attributes["place"].shape, (len(kept.points), 3))
        for name, wrong, message in (("a", np.zeros(3), "row for each"), ("a", np.zeros((len(mesh.points), 2, 2)), "row"),
                                     ("a", np.zeros(len(mesh.points), dtype=np.int64), "int64"),
                                     ("weights", mesh.points, "another name")):
            with self.assertRaisesRegex(selvedge.ArgumentError, message):
                selvedge.simplify(*mesh, attributes={name: wrong}, ratio=0.5)

    def test_names_what_is_wrong_with_values_of_corners(self):
        points, triangles = layers(500)
        uvs = np.zeros((len(points), 2))
        endless, high = np.full_like(uvs, np.nan), np.full_like(triangles, len(points))
        for wrong, message in ((uvs[:-1], "has the shape"), (np.zeros((len(triangles), 3, 3)), "has the shape"),
                               (endless, "is not finite"), ((uvs, triangles[:-1]), "a row for each triangle"),
                               ((uvs, high), "but there are"), ((uvs[:, :1], triangles), "shape \\(k, 2\\)")):
            with self.assertRaisesRegex(selvedge.ArgumentError, "uvs.*" + message):
                selvedge.simplify(points, triangles, uvs=wrong, ratio=0.5)
        with self.assertRaisesRegex(selvedge.ArgumentError, "uvs\\[triangles\\]"):
            selvedge.simplify(points, triangles, uvs=uvs, sewn=True, ratio=0.5)
        sewn = selvedge.simplify(points, triangles, uvs=uvs[triangles], sewn=True, ratio=0.5)
        self.assertEqual(sewn.uvs.shape, (len(sewn.triangles), 3, 2))

    def test_what_numpy_takes_for_numbers_is_refused(self):
        mesh = layers(200)
        points, triangles = mesh
        masked = np.ma.masked_greater(points, 0.4)
        for arguments, options, why in (
                ((points + 0j, triangles), {}, "^points: the numbers are complex"),
                ((masked, triangles), {}, "^points: the array has a mask"), ((points, np.ma.masked_equal(triangles, 0)), {}, "^triangles: .* mask"),
                (("mesh.obj", triangles), {}, "^points: 'mesh.obj' is no array; read the file first"),
                ((pathlib.Path("mesh.obj"), triangles), {}, "^points: .*read the file first"),
                ((points, "mesh.obj"), {}, "^triangles: 'mesh.obj' is no array"), ((3, triangles), {}, "^points: 3 is no array"),
                (([[1, 2, 3], [1, 2]], triangles), {}, "^points: this is no array of numbers"),
                (([["a", "b", "c"]], triangles), {}, "^points: this is no array of numbers"),
                ((points, triangles), {"poses": "poses.npy"}, "^poses: 'poses.npy' is no array"),
                ((points, triangles), {"poses": [masked]}, "^poses: the array has a mask"),
                ((points, triangles), {"obstacle": (points * 1j, triangles)}, "^points of the obstacle: .*complex"),
                ((points, triangles), {"normal_vectors": masked}, "^normal_vectors: .*mask"),
                ((points, triangles), {"attributes": {"heat": masked[:, 0]}}, "^the attribute 'heat': .*mask"),
                ((points, triangles), {"weights": masked[:, 0]}, "^weights: .*mask"),
                ((points, triangles), {"lock_vertices": np.ma.masked_equal([0, 1], 1)}, "^lock_vertices: .*mask")):
            with self.assertRaisesRegex(selvedge.ArgumentError, why):
                selvedge.simplify(*arguments, ratio=0.5, **options)
        for judged in (("mesh.obj", triangles), (masked, triangles)):
            with self.assertRaisesRegex(selvedge.ArgumentError, "^points: "):
                selvedge.verify(*judged)
            with self.assertRaisesRegex(selvedge.ArgumentError, "^points: "):
                selvedge.replay(*judged, "")
            with self.assertRaisesRegex(selvedge.ArgumentError, "^points of the original: "):
                selvedge.verify(*mesh, original=judged)

    def test_options_that_would_do_nothing_are_refused(self):
        with self.assertRaisesRegex(selvedge.ArgumentError, "^cluster_size: the packed index"):
            selvedge.simplify(*layers(200), ratio=0.5, cluster_size=20)
        self.assertTrue(selvedge.simplify(*layers(200), ratio=0.5, cluster_size=20, index="clusters").accepted)
        with self.assertRaisesRegex(selvedge.ArgumentError, "^corner_height: with such a border_turn"):
            selvedge.simplify(*layers(200), ratio=0.5, border_turn=180, normal_change=180,
                              corner_height=0)
        self.assertTrue(selvedge.simplify(*layers(200), ratio=0.5, border_turn=180, corner_height=0).accepted)

    def test_results_print_what_they_are(self):
        mesh = layers()
        result = selvedge.simplify(*mesh, ratio=0.4)
        counts = f"{len(result.points)} points, {len(result.triangles)} triangles"
        self.assertEqual(repr(result), f"<Result: {counts}, accepted, target reached>")
        control = selvedge.simplify(*mesh, ratio=0.1, intersection_check=False)
        self.assertIn("NOT accepted", repr(control))
        self.assertEqual(repr(selvedge.verify(*result)), "<Verdict: accepted>")
        self.assertEqual(repr(selvedge.verify(*control)), "<Verdict: NOT accepted>")

    def test_takes_floats_and_arrays_in_any_order(self):
        mesh = layers()
        floats = mesh.points.astype(np.float32)
        expected = selvedge.simplify(floats, mesh.triangles, ratio=0.5)
        again = selvedge.simplify(np.asfortranarray(floats), mesh.triangles.tolist(), ratio=0.5)
        np.testing.assert_array_equal(expected.triangles, again.triangles)
        self.assertTrue(np.isin(expected.points, floats.astype(np.float64)).all())

    def test_a_missed_target_keeps_faces_for_the_shape(self):
        mesh = selvedge.generate("nested", faces=2000)
        kept = selvedge.simplify(*mesh, ratio=0.01, error=0.01, log=True)
        within_reach = kept.report["target"]["within_reach"]
        self.assertFalse(kept.reached)
        self.assertTrue(1.08 * within_reach < len(kept.triangles) < 1.12 * within_reach)
        self.assertTrue(selvedge.replay(*mesh, kept.log))
        flattened = selvedge.simplify(*mesh, faces=within_reach, error=0.01)
        self.assertIsNone(flattened.report["target"]["within_reach"])
        self.assertLess(kept.report["distance"]["original_to_result"]["rms"],
                        0.95 * flattened.report["distance"]["original_to_result"]["rms"])

    def test_levels_of_detail_are_what_single_runs_give(self):
        mesh = selvedge.generate("skirt", faces=4000, thickness=0)
        given = {"uvs": mesh.uvs, "attributes": {"height": mesh.points[:, 1].copy()}}
        ratios = (0.3, 0.6, 0.25)
        levels = selvedge.simplify(*mesh, lods=ratios, log=True, **given)
        self.assertEqual(len(levels), 3)
        for level, ratio in zip(levels, ratios):
            alone = selvedge.simplify(*mesh, ratio=ratio, log=True, **given)
            self.assertTrue(level.accepted and level.reached)
            self.assertEqual(level.log, alone.log)
            for name in ("points", "triangles", "uvs", "vertices", "birth", "collapses"):
                np.testing.assert_array_equal(getattr(level, name), getattr(alone, name))
            np.testing.assert_array_equal(level.attributes["height"], level.points[:, 1])
            self.assertEqual(level.report["faces"], alone.report["faces"])
            self.assertEqual(level.report["options"]["lods"], list(ratios))
            replayed = selvedge.replay(*mesh, level.log, uvs=mesh.uvs)
            self.assertTrue(replayed)
            np.testing.assert_array_equal(replayed.mesh.triangles, level.triangles)
            self.assertTrue(selvedge.verify(*pickle.loads(pickle.dumps(level)), mesh))
        for one in (0.25, [0.25], np.array([0.25])):
            (only,) = selvedge.simplify(*mesh, lods=one, **given)
            np.testing.assert_array_equal(only.triangles, levels[2].triangles)
        self.assertIsInstance(selvedge.simplify(*mesh, ratio=0.5, lods=None), selvedge.Result)

    def test_levels_of_parts_with_ratios_have_logs_of_their_own(self):
        mesh = layers(2000, 2)
        half = len(mesh.triangles) // 2
        groups = ["low"] * half + ["high"] * (len(mesh.triangles) - half)
        for level in selvedge.simplify(*mesh, groups=groups, part_ratios={"low": 0.8}, lods=[0.2, 0.5], log=True):
            self.assertAlmostEqual((level.birth < half).sum(), 0.8 * half, delta=1)
            replayed = selvedge.replay(*mesh, level.log, groups=groups)
            self.assertTrue(replayed)
            np.testing.assert_array_equal(replayed.mesh.triangles, level.triangles)

    def test_levels_of_a_mesh_with_poses_are_guarded_in_all(self):
        mesh = layers(1000, 2)
        # As below: two that differ most, and tell nothing of the bent ones, which the judge finds pierced.
        far = [mesh.points + np.array([0, 0, height]) for height in (50, -50)]
        bent = [mesh.points + np.array([0, 0, 1]) * (bend * mesh.points[:, :1] ** 2) for bend in (3, 2.9)]
        for level in selvedge.simplify(*mesh, poses=far + bent, lods=[0.5, 0.1], error=None, key_poses="auto"):
            self.assertTrue(level.accepted)
            self.assertEqual(len(selvedge.verify(bent[0][level.vertices], level.triangles).pairs), 0)
            guarded = [pose["guarded"] for pose in level.report["verified"]["poses"]]
            self.assertTrue(guarded[0] and guarded[1] and (guarded[2] or guarded[3]))

    def test_levels_after_a_stop_are_the_mesh_as_it_is_then(self):
        mesh = layers(20000)
        for options in ({}, {"cells": True}):
            levels = selvedge.simplify(*mesh, lods=[0.9, 0.5, 0.1], log=True, progress=lambda *counts: True, **options)
            self.assertTrue(levels[2].stopped and levels[2].accepted and not levels[2].reached)
            np.testing.assert_array_equal(levels[1].triangles, levels[2].triangles)
            for level in levels:
                self.assertTrue(selvedge.replay(*mesh, level.log))

    def test_a_stop_in_the_reduction_of_a_later_level_leaves_those_before(self):
        mesh = layers(20000, 2)
        groups = ["low"] * (len(mesh.triangles) // 2) + ["high"] * (len(mesh.triangles) - len(mesh.triangles) // 2)
        seen = []

        def has_begun_again(faces_input, target, faces):
            seen.append(faces)
            return any(later > earlier for earlier, later in zip(seen, seen[1:]))

        # The first level misses its target, for which all would be made again.
        levels = selvedge.simplify(*mesh, groups=groups, part_ratios={"low": 0.001}, lods=[0.001, 0.1, 0.2], log=True,
                                   progress=has_begun_again)
        self.assertEqual([level.stopped for level in levels], [False, True, True])
        self.assertFalse(levels[0].reached)
        np.testing.assert_array_equal(levels[1].triangles, levels[2].triangles)
        for level in levels:
            replayed = selvedge.replay(*mesh, level.log, groups=groups)
            self.assertTrue(replayed)
            np.testing.assert_array_equal(replayed.mesh.triangles, level.triangles)

    def test_levels_of_detail_are_refused_as_in_the_program(self):
        mesh = layers(500)
        for options, why in (({"lods": [0.5], "ratio": 0.5}, "they already say how far"),
                             ({"lods": [0.5], "faces": 100}, "they already say how far"),
                             ({"lods": [0.5, 1.5]}, "'1.5' is not a number from 0 to 1"), ({"lods": []}, "not a list of ratios"),
                             ({"lods": [], "ratio": 0.5}, "not a list of ratios"), ({"lods": {0.5, 0.2}}, "not a list of ratios"),
                             ({"lods": {"high": 0.5}}, "'high=0.5' is not a number")):
            with self.assertRaisesRegex(selvedge.ArgumentError, "^lods: .*" + why if "not a list" not in why else why):
                selvedge.simplify(*mesh, **options)
        with self.assertRaisesRegex(selvedge.ArgumentError, "in cells no part"):
            selvedge.simplify(*mesh, lods=[0.5], cells=True, part_ratios={"sheet_1": 0.5})

    @unittest.skipUnless("SELVEDGE_APP" in os.environ, "there is no program")
    def test_levels_of_detail_are_those_of_the_program(self):
        mesh = selvedge.generate("skirt", faces=20000)  # so large that a run for one ratio gives others
        rows, numbers = np.unique(mesh.uvs.reshape(-1, 2), axis=0, return_inverse=True)
        numbers = numbers.reshape(-1, 3)
        ratios = [0.5, 0.25, 0.1]
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "in.obj")
            with open(name, "w", encoding="utf-8") as file:
                file.writelines("v %r %r %r\n" % tuple(map(float, point)) for point in mesh.points)
                file.writelines("vt %r %r\n" % tuple(map(float, uv)) for uv in rows)
                for group, triangle, of_texture in zip(mesh.groups, mesh.triangles + 1, numbers + 1):
                    file.write("g %s\nf %d/%d %d/%d %d/%d\n" % (group, *np.stack([triangle, of_texture], axis=1).reshape(-1)))
            subprocess.run([os.environ["SELVEDGE_APP"], "simplify", name, "-o", os.path.join(folder, "out_{lod}.obj"), "--lods",
                            ",".join(map(str, ratios)), "--placement", "vertices", "--quiet"], check=True)
            levels = selvedge.simplify(*mesh, uvs=(rows, numbers), groups=mesh.groups, lods=ratios)
            for number, level in enumerate(levels, 1):
                lines = {"v": [], "vt": [], "f": []}
                with open(os.path.join(folder, f"out_{number}.obj"), encoding="utf-8") as file:
                    for words in map(str.split, file):
                        lines.get(words[0] if words else "", []).append(words[1:])
                corners = np.array([[word.split("/")[:2] for word in face] for face in lines["f"]], dtype=int) - 1
                np.testing.assert_array_equal(np.array(lines["v"], dtype=float), level.points)
                np.testing.assert_array_equal(corners[:, :, 0], level.triangles)
                np.testing.assert_array_equal(np.array(lines["vt"], dtype=float)[corners[:, :, 1]], level.uvs[0][level.uvs[1]])
        alone = selvedge.simplify(*mesh, uvs=(rows, numbers), groups=mesh.groups, ratio=0.5)
        self.assertFalse(np.array_equal(alone.triangles, levels[0].triangles))

    def test_options_are_those_of_the_program(self):
        mesh = layers(500)
        report = selvedge.simplify(*mesh, ratio=0.5, error=None, lock=[], normal_change=30).report
        self.assertEqual(set(report["options"]), set(selvedge.option_names()))
        self.assertEqual((report["options"]["normal_change"], report["options"]["error"]), (30, None))
        self.assertEqual(report["verified"]["new_pairs"], 0)
        with open(os.path.join(os.path.dirname(selvedge.__file__), "__init__.pyi"), encoding="utf-8") as stub:
            typed = set(re.findall(r"^    (\w+): ", stub.read(), re.MULTILINE))
        self.assertLessEqual(set(selvedge.option_names()), typed)
        for function in (selvedge.simplify, selvedge.verify, selvedge.replay):
            self.assertLessEqual(set(inspect.signature(function).parameters) - {"options"}, typed)
        with self.assertRaisesRegex(TypeError, "'placement'"):
            selvedge.simplify(*mesh, placemnt="optimal")
        with self.assertRaisesRegex(ValueError, "ratio"):
            selvedge.simplify(*mesh, ratio=2)
        with self.assertRaises(ValueError):
            selvedge.simplify(mesh.points, mesh.triangles + 100000, ratio=0.5)
        with self.assertRaises(ValueError):
            selvedge.simplify(mesh.points, -mesh.triangles.astype(np.int64), ratio=0.5)
        with self.assertRaises(selvedge.InputError):
            selvedge.simplify(np.zeros((3, 3)), [[0, 1, 2]], ratio=0.5)
        log = selvedge.simplify(*mesh, ratio=0.5, log=True).log
        infinite = mesh.points.copy()
        infinite[0, 0] = np.inf
        for spoiled in ((mesh.points, mesh.triangles + 100000), (mesh.points, [[0, 1, len(mesh.points)]]),
                        (infinite, mesh.triangles)):
            with self.assertRaisesRegex(ValueError, "index 0|index 2|vertex 0"):
                selvedge.verify(*spoiled)
            with self.assertRaises(ValueError):
                selvedge.verify(*mesh, original=spoiled)
            with self.assertRaises(ValueError):
                selvedge.replay(*spoiled, log)
            with self.assertRaises(ValueError):
                selvedge.replay(*mesh, log, obstacle=spoiled)

    def test_parts_weights_locks_and_obstacle(self):
        mesh = layers(2000, 2)
        half = len(mesh.triangles) // 2
        groups = ["low"] * half + ["high"] * (len(mesh.triangles) - half)
        kept = selvedge.simplify(*mesh, groups=groups, keep="low", ratio=0.2)
        self.assertEqual((kept.birth < half).sum(), half)
        locked = np.arange(0, len(mesh.points), 5)
        self.assertTrue(np.isin(locked, selvedge.simplify(*mesh, lock_vertices=locked, ratio=0.2).vertices).all())
        self.assertFalse(np.isin(locked, selvedge.simplify(*mesh, ratio=0.2).vertices).all())
        weights = np.ones(len(mesh.points))
        weights[:len(weights) // 2] = 1000
        heavy = selvedge.simplify(*mesh, weights=weights, ratio=0.2)
        self.assertGreater((heavy.birth < half).sum(), (heavy.birth >= half).sum())

        def pairs_with_body(**options):
            result = selvedge.simplify(mesh.points, mesh.triangles[:half], ratio=0.1, **options)
            both = np.concatenate([result.triangles, mesh.triangles[half:] + len(result.points)])
            return len(selvedge.verify(np.concatenate([result.points, mesh.points]), both).pairs)

        self.assertEqual(pairs_with_body(obstacle=(mesh.points, mesh.triangles[half:])), 0)
        self.assertGreater(pairs_with_body(), 0)

        body, own = (mesh.points, mesh.triangles[half:]), (mesh.points, mesh.triangles[:half])
        clear = selvedge.simplify(*own, ratio=0.1, obstacle=body, log=True).log
        self.assertTrue(selvedge.replay(*own, clear, obstacle=body))
        self.assertIn("obstacle", [part["key"] for part in selvedge.replay(*own, clear).report["terms"]["not_judged"]])
        self.assertFalse(selvedge.replay(*own, selvedge.simplify(*own, ratio=0.1, log=True).log, obstacle=body))

    def test_parts_come_in_any_container_and_other_options_alone(self):
        mesh = layers(500, 2)
        half = len(mesh.triangles) // 2
        groups = ["low"] * half + ["high"] * (len(mesh.triangles) - half)
        for parts in (["low"], ("low",), {"low"}, frozenset({"low"}), np.array(["low"])):
            self.assertEqual(selvedge.simplify(*mesh, groups=groups, keep=parts, ratio=0.5).report["options"]["keep"], ["low"])
        for ratio in ([0.5, 0.3], np.array([0.5])):
            with self.assertRaisesRegex(selvedge.ArgumentError, "ratio takes one value"):
                selvedge.simplify(*mesh, ratio=ratio)
        self.assertEqual(selvedge.simplify(*mesh, ratio=np.array(0.5)).report["options"]["ratio"], 0.5)
        with self.assertRaisesRegex(selvedge.ArgumentError, "poses is not an array of shape"):
            selvedge.simplify(*mesh, ratio=0.5, poses=mesh.points)

    def test_small_and_named_parts_are_left_out(self):
        mesh = layers(500)
        corners = np.array([[0, 0, 9], [1, 0, 9], [0, 1, 9], [0, 0, 10.0]]) / 100
        faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
        points = np.vstack([corners, mesh.points, corners + 1])
        triangles = np.vstack([faces, mesh.triangles + 4, faces + 4 + len(mesh.points)])
        groups = ["stitch"] * 4 + ["cloth"] * len(mesh.triangles) + ["stitch"] * 4
        for options in ({"drop_smaller": 0.05}, {"drop_part": "stitch"}, {"drop_part": ["st*"], "drop_smaller": 1e-6}):
            result = selvedge.simplify(points, triangles, groups=groups, ratio=0.5, log=True, **options)
            self.assertTrue(result.accepted)
            self.assertEqual(len(result.triangles), len(mesh.triangles) // 2)
            self.assertEqual({groups[triangle] for triangle in result.birth}, {"cloth"})
            np.testing.assert_array_equal(points[result.vertices], result.points)
            self.assertTrue(selvedge.replay(points, triangles, result.log, groups=groups))
            left = [groups[triangle] for triangle in result.birth]
            original = (points, triangles)
            self.assertTrue(selvedge.verify(result.points, result.triangles, original, groups=left, original_groups=groups, **options))
            self.assertFalse(selvedge.verify(result.points, result.triangles, original, groups=left, original_groups=groups))
            with self.assertRaisesRegex(selvedge.ArgumentError, "drop_smaller: there is no original"):
                selvedge.verify(result.points, result.triangles, **options)
        with self.assertRaisesRegex(selvedge.ArgumentError, "no group, object or material is called 'zip'"):
            selvedge.simplify(points, triangles, groups=groups, ratio=0.5, drop_part="zip")
        with self.assertRaisesRegex(selvedge.InputError, "no face would be left"):
            selvedge.simplify(points, triangles, ratio=0.5, drop_smaller=100)

    def test_normals_are_treated_as_what_is_left_needs(self):
        def strips(lean, z):  # side by side, with vertices of their own, whose normals lean to one side and the other
            rows = 20
            ends = [[(i + k, y, z) for y in range(rows + 1) for k in (0, 1)] for i in range(10)]
            quads = [2 * y + 2 * (rows + 1) * i for i in range(10) for y in range(rows)]
            points = np.array(ends, float).reshape(-1, 3)
            leans = np.where(np.arange(len(points)) // (2 * rows + 2) % 2, lean, -lean)
            normals = np.stack([leans, points[:, 1] / 100, np.ones(len(points))], 1)
            return points, np.array([(v, v + 1, v + 2) for v in quads] + [(v + 1, v + 3, v + 2) for v in quads]), normals

        (soft, triangles, leaning), (hard, _, leaning_far) = strips(0.05, 0), strips(0.8, 5)
        groups = ["cloth"] * len(triangles) + ["stitch"] * len(triangles)
        whole = np.vstack([soft, hard]), np.vstack([triangles, triangles + len(soft)])
        for options, logged in (({"drop_part": "stitch"}, "loose_shared"), ({}, "soft_shared")):
            normals = np.vstack([leaning, leaning_far])
            result = selvedge.simplify(*whole, groups=groups, normal_vectors=normals, ratio=0.3, log=True, **options)
            self.assertTrue(f"\nnormals {logged}\n" in result.log, result.log[:99])

    def test_locked_vertices_are_numbers_or_a_mask(self):
        mesh = layers(500)
        count = len(mesh.points)
        locked = list(range(20, 40))
        mask = np.zeros(count, bool)
        mask[locked] = True
        expected = selvedge.simplify(*mesh, lock_vertices=locked, ratio=0.2)
        self.assertTrue(np.isin(locked, expected.vertices).all())
        for same in (mask, mask.tolist(), set(locked), range(20, 40), np.array(locked, np.uint8)):
            result = selvedge.simplify(*mesh, lock_vertices=same, ratio=0.2)
            np.testing.assert_array_equal(result.vertices, expected.vertices)
        free = selvedge.simplify(*mesh, ratio=0.2)
        for none in ([], np.zeros(count, bool)):
            np.testing.assert_array_equal(selvedge.simplify(*mesh, lock_vertices=none, ratio=0.2).vertices, free.vertices)
        for bad, why in ((mask[1:], f"there are {count} points, but {count - 1} booleans"), ([1, 20.9], "not whole"),
                         ([20.0], "not whole"), (["20"], "not whole"), ([None], "not whole"), ([3, -1], "the number -1,"),
                         ([count], f"the number {count}, but the {count} vertices"), ([2**70], f"the number {2**70},"),
                         (np.nonzero(mask), "2 dimensions"), (20, "not a list"), ([[1], [2, 3]], "not a list|not whole")):
            with self.assertRaisesRegex(selvedge.ArgumentError, why):
                selvedge.simplify(*mesh, lock_vertices=bad, ratio=0.2)

    def test_locked_vertices_are_not_numbers_and_booleans_at_once(self):
        mesh = layers(500)
        for mixed in ([True, 400], [400, False], (3, np.True_), {5, True}):
            with self.assertRaisesRegex(selvedge.ArgumentError, "lock_vertices has both numbers and booleans"):
                selvedge.simplify(*mesh, lock_vertices=mixed, ratio=0.2)

    def test_parts_that_may_intersect_may_have_colons_in_their_names(self):
        mesh = layers(500, 2)
        half = len(mesh.triangles) // 2

        def simplify(names, pairs):
            groups = [names[0]] * half + [names[1]] * (len(mesh.triangles) - half)
            return selvedge.simplify(*mesh, groups=groups, may_intersect=pairs, ratio=0.5)

        names = ("material:skin", "material:dress")
        result = simplify(names, "material:skin:material:dress")
        self.assertEqual(result.report["options"]["may_intersect"], ["material:skin:material:dress"])
        self.assertEqual(len(simplify(("low", "high"), ["low:high", "l*:high"]).report["options"]["may_intersect"]), 2)
        for bad, why in (("material:skin", "'material:skin': no group, object or material is called"),
                         ("skin", "'skin' is not two parts with a colon between them")):
            with self.assertRaisesRegex(selvedge.ArgumentError, "may_intersect: " + why):
                simplify(names, bad)
        with self.assertRaisesRegex(selvedge.ArgumentError, "this may be '.*', or '.*'; rename a part"):
            simplify(("a:a", "a"), "a:a:a")

    def test_results_and_meshes_are_pickled_and_copied(self):
        mesh = layers(500)
        groups = mesh.groups
        result = selvedge.simplify(*mesh, ratio=0.5, log=True)
        for again in (pickle.loads(pickle.dumps(result)), copy.copy(result), copy.deepcopy(result)):
            self.assertEqual(repr(again), repr(result))
            self.assertEqual(again.report, result.report)
            self.assertEqual((again.log, again.stopped), (result.log, result.stopped))
            for name in ("points", "triangles", "vertices", "birth", "collapses"):
                np.testing.assert_array_equal(getattr(again, name), getattr(result, name))
            self.assertTrue(selvedge.verify(*again, original=mesh))
        copied = pickle.loads(pickle.dumps(mesh))
        self.assertEqual(copied.groups, groups)
        np.testing.assert_array_equal(copied.triangles, mesh.triangles)
        verdict = pickle.loads(pickle.dumps(selvedge.replay(*mesh, result.log)))
        self.assertTrue(verdict)
        np.testing.assert_array_equal(verdict.mesh.triangles, result.triangles)

    def test_empty_values_are_refused_with_what_they_may_be(self):
        mesh = layers(500)
        for option, why in (("weld", "weld: '' is neither a number of at least 0 nor hold, auto or none"),
                            ("error", "error: '' is neither a number of at least 0 nor none"),
                            ("placement", "placement: '' is not one of vertices, optimal"),
                            ("keep", "''")):
            with self.assertRaisesRegex(selvedge.ArgumentError, why):
                selvedge.simplify(*mesh, ratio=0.5, **{option: ""})

    def test_meshes_are_taken_whole(self):
        mesh = layers(500)
        result = selvedge.simplify(*mesh, ratio=0.5, log=True)
        self.assertTrue(selvedge.verify(*selvedge.simplify(*result, ratio=0.5), original=result))
        far = selvedge.Mesh(mesh.points + 5, mesh.triangles)
        kept = selvedge.simplify(*mesh, ratio=0.5, obstacle=far, log=True)
        np.testing.assert_array_equal(kept.vertices, selvedge.simplify(*mesh, ratio=0.5, obstacle=tuple(far)).vertices)
        self.assertTrue(selvedge.replay(*mesh, kept.log, obstacle=far))
        for bad in (far.points[:3], 5, (far.points,)):
            with self.assertRaisesRegex(selvedge.ArgumentError, "original is neither a Mesh nor a pair"):
                selvedge.verify(*mesh, original=bad)

    def test_weights_are_numbers(self):
        mesh = layers(500)
        for bad in (np.nan, np.inf, -1):
            weights = np.ones(len(mesh.points))
            weights[7] = bad
            with self.assertRaisesRegex(selvedge.ArgumentError, "weight of vertex 7, counted from 0, is "):
                selvedge.simplify(*mesh, weights=weights, ratio=0.5)

    def test_poses_are_all_guarded(self):
        mesh = layers(2000, 2)
        bent = mesh.points + np.array([0, 0, 1]) * (3 * mesh.points[:, :1] ** 2)

        def pairs_in_pose(**options):
            result = selvedge.simplify(*mesh, ratio=0.1, error=None, **options)
            return len(selvedge.verify(bent[result.vertices], result.triangles).pairs)

        self.assertEqual(pairs_in_pose(poses=[bent]), 0)
        self.assertGreater(pairs_in_pose(), 0)
        with self.assertRaises(ValueError):
            selvedge.simplify(*mesh, poses=[bent[1:]], ratio=0.5)

    def test_key_poses_are_those_that_differ_most_and_all_are_judged(self):
        mesh = layers(1000, 2)
        bends = (0, 0.01, 0.02, 3, 0.03)
        poses = np.array([mesh.points + np.array([0, 0, 1]) * (bend * mesh.points[:, :1] ** 2) for bend in bends])
        self.assertEqual(selvedge.key_poses(mesh.points, poses, 1).tolist(), [3])
        self.assertEqual(selvedge.key_poses(mesh.points, poses, 2).tolist(), [3, 4])
        self.assertEqual(selvedge.key_poses(mesh.points, poses, 9).tolist(), [0, 1, 2, 3, 4])
        for bad in (-1, 1.5, "2"):
            with self.assertRaisesRegex(selvedge.ArgumentError, "count is "):
                selvedge.key_poses(mesh.points, poses, bad)
        with self.assertRaises(selvedge.ArgumentError):
            selvedge.key_poses(mesh.points, poses[:, 1:], 2)

        def guarded(**options):
            result = selvedge.simplify(*mesh, poses=poses, ratio=0.1, error=None, log=True, **options)
            self.assertTrue(result.accepted)
            for pose in poses:
                self.assertEqual(len(selvedge.verify(pose[result.vertices], result.triangles).pairs), 0)
            self.assertTrue(selvedge.replay(*mesh, result.log))
            return [pose["guarded"] for pose in result.report["verified"]["poses"]]

        self.assertEqual(guarded(), [True] * 5)
        of_auto = guarded(key_poses="auto")
        self.assertTrue(of_auto[3])
        self.assertLess(sum(of_auto), 5)
        with self.assertRaisesRegex(selvedge.ArgumentError, "key_poses: there are no further poses; give poses"):
            selvedge.simplify(*mesh, ratio=0.5, key_poses="auto")

    def test_poses_that_are_pierced_are_guarded_in_the_next_run(self):
        mesh = layers(1000, 2)
        # Two that move both layers far differ most, and tell nothing of the bent ones.
        far = [mesh.points + np.array([0, 0, height]) for height in (50, -50)]
        bent = [mesh.points + np.array([0, 0, 1]) * (bend * mesh.points[:, :1] ** 2) for bend in (3, 2.9)]
        self.assertEqual(selvedge.key_poses(mesh.points, far + bent, 2).tolist(), [0, 1])
        alone = selvedge.simplify(*mesh, poses=far, ratio=0.1, error=None)
        self.assertGreater(len(selvedge.verify(bent[0][alone.vertices], alone.triangles).pairs), 0)
        result = selvedge.simplify(*mesh, poses=far + bent, ratio=0.1, error=None, key_poses="auto")
        self.assertTrue(result.accepted)
        self.assertEqual(len(selvedge.verify(bent[0][result.vertices], result.triangles).pairs), 0)
        guarded = [pose["guarded"] for pose in result.report["verified"]["poses"]]
        self.assertTrue(guarded[0] and guarded[1] and (guarded[2] or guarded[3]))

    def test_log_is_replayed_and_a_wrong_one_is_not(self):
        mesh = layers()
        result = selvedge.simplify(*mesh, ratio=0.3, log=True)
        verdict = selvedge.replay(*mesh, result.log)
        self.assertTrue(verdict)
        np.testing.assert_array_equal(verdict.mesh.triangles, result.triangles)
        bad = selvedge.simplify(*mesh, ratio=0.1, log=True, intersection_check=False)
        self.assertFalse(selvedge.replay(*mesh, bad.log))
        with self.assertRaises(selvedge.InputError):
            selvedge.replay(*mesh, "no log")

    def test_progress_stops_throws_and_other_threads_run(self):
        mesh = layers(20000)
        stopped = selvedge.simplify(*mesh, ratio=0.1, progress=lambda *counts: True)
        self.assertTrue(stopped.stopped and stopped.accepted)
        self.assertGreater(len(stopped.triangles), len(mesh.triangles) // 2)

        def throw(*counts):
            raise KeyError("mine")

        with self.assertRaisesRegex(KeyError, "mine"):
            selvedge.simplify(*mesh, ratio=0.1, progress=throw)

    def test_ctrl_c_ends_the_call(self):
        mesh = layers(200000)
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))  # which needs the GIL to be free
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            selvedge.simplify(*mesh, ratio=0.01)
        timer.join()


class Verify(unittest.TestCase):
    def test_layers_that_have_changed_places_are_refused(self):
        scene = selvedge.generate("tunnel", faces=1000)
        passed = selvedge.simplify(*scene, ratio=0, intersection_check=False)
        self.assertTrue(selvedge.verify(*passed))  # the mesh alone does not show it
        verdict = selvedge.verify(*passed, scene)
        self.assertFalse(verdict)
        self.assertEqual(len(verdict.new_pairs), 0)
        self.assertEqual(verdict.swaps.shape, (verdict.report["layers"]["swaps"], 4))
        self.assertGreater(len(verdict.swaps), 0)
        first = verdict.report["layers"]["first_swaps"][0]
        self.assertEqual((verdict.swaps[0] + 1).tolist(), first["of_original"] + first["of_result"])
        self.assertTrue(selvedge.verify(*selvedge.simplify(*scene, ratio=0), scene))
        mesh = layers()
        kept = selvedge.verify(*selvedge.simplify(*mesh, ratio=0.3), mesh)
        self.assertTrue(kept)
        self.assertEqual(kept.swaps.shape, (0, 4))
        self.assertGreater(kept.report["layers"]["compared"], 0)
        self.assertEqual(selvedge.verify(*scene).swaps.shape, (0, 4))

    @unittest.skipUnless("SELVEDGE_APP" in os.environ, "there is no program")
    def test_says_what_the_program_says(self):
        mesh = layers(1000, 2)
        half = len(mesh.triangles) // 2
        groups = ["low"] * half + ["high"] * half
        bent = mesh.points + np.array([0, 0, 1]) * (3 * mesh.points[:, :1] ** 2)

        def write(name, points, triangles, groups=None):
            with open(name, "w", encoding="utf-8") as file:
                file.writelines("v %r %r %r\n" % tuple(map(float, point)) for point in points)
                for number, triangle in enumerate(triangles):
                    file.write(f"g {groups[number]}\n" if groups else "")
                    file.write("f %d %d %d\n" % tuple(triangle + 1))
            return name

        def judged(result, options, **arguments):
            words = ["verify", write("small.obj", *result, arguments.get("groups")), "--report", "report.json",
                     "--against", write("in.obj", *mesh, arguments.get("original_groups")), *options]
            code = subprocess.run([os.environ["SELVEDGE_APP"], *words], stdout=subprocess.DEVNULL).returncode
            with open("report.json", encoding="utf-8") as file:
                expected = json.load(file)
            verdict = selvedge.verify(*result, mesh, **arguments)
            self.assertEqual(verdict.accepted, code == 0)
            for key in ("verified", "pieces", "distance", "matching", "layers", "borders", "seams", "normals", "cannot_see"):
                self.assertEqual(self.without_names(verdict.report[key]), self.without_names(expected[key]), key)
            return verdict.accepted

        folder = os.getcwd()
        with tempfile.TemporaryDirectory() as temporary:
            os.chdir(temporary)
            try:
                guarded = selvedge.simplify(*mesh, ratio=0.2, error=None, poses=[bent])
                pierced = selvedge.simplify(*mesh, ratio=0.1, error=None)
                for result, are_good in ((guarded, True), (pierced, False)):
                    self.assertTrue(judged(result, []))
                    pose, original_pose = bent[result.vertices], bent
                    options = ["--pose", write("pose.obj", pose, result.triangles),
                               "--against-pose", write("bent.obj", bent, mesh.triangles)]
                    self.assertEqual(judged(result, options, poses=[pose], original_poses=[original_pose]), are_good)
                    names = [groups[triangle] for triangle in result.birth]
                    self.assertTrue(judged(result, [], groups=names, original_groups=groups))
                    other = [groups[-1 - triangle] for triangle in result.birth]
                    self.assertFalse(judged(result, [], groups=other, original_groups=groups))
                    judged(result, ["--clearance", "0.5"], clearance=0.5)
                unchecked = selvedge.simplify(*mesh, ratio=0.1, error=None, intersection_check=False)
                names = [groups[triangle] for triangle in unchecked.birth]
                self.assertFalse(judged(unchecked, [], groups=names, original_groups=groups))
                self.assertTrue(judged(unchecked, ["--may-intersect", "low:high"], groups=names, original_groups=groups,
                                       may_intersect="low:high"))
                self.assertFalse(judged(guarded, ["--obstacle", "in.obj"], obstacle=mesh))
            finally:
                os.chdir(folder)

    @staticmethod
    def without_names(value):
        """Poses have the names of their files in the one, and numbers in the other."""
        if isinstance(value, dict):
            return {key: Verify.without_names(part) for key, part in value.items()
                    if not (key in ("name", "max_pose") and str(part).startswith(("pose", "bent")))}
        return [Verify.without_names(part) for part in value] if isinstance(value, list) else value

    def test_what_cannot_be_is_refused_by_name(self):
        mesh = layers(200)
        for arguments, why in (({"clearance": 0}, "clearance: "), ({"clearance": np.nan}, "clearance: "),
                               ({"clearance": "wide"}, "clearance is 'wide'"), ({"weld": 1}, "weld: there is no original"),
                               ({"weld": -1, "original": mesh}, "joined is a number of at least 0"),
                               ({"original_poses": [mesh.points]}, "but no original"),
                               ({"original_groups": ["a"] * len(mesh.triangles)}, "but no original"),
                               ({"may_intersect": "a:b"}, "may_intersect: "), ({"threads": 0}, "threads is 0, and not a whole"),
                               ({"groups": ["a"]}, "names of groups"), ({"poses": [mesh.points[1:]]}, "pose"),
                               ({"poses": [mesh.points], "original": mesh}, "pose"),
                               ({"obstacle": mesh.points}, "obstacle is neither")):
            with self.assertRaisesRegex(selvedge.ArgumentError, why, msg=str(arguments)):
                selvedge.verify(*mesh, **arguments)


class Generate(unittest.TestCase):
    def test_numbers_that_cannot_be_are_refused_by_name(self):
        for arguments, why in (({"faces": -5}, "faces is -5, and not a whole number from 0 to 18446744073709551615"),
                               ({"faces": 2.5}, "faces is 2.5, and not a whole number"),
                               ({"faces": "many"}, "faces is 'many', and not a whole number"),
                               ({"layers": -1}, "layers is -1, and not"), ({"layers": 2**40}, "layers is 1099511627776, and"),
                               ({"folds": None}, "folds is None, and"), ({"seed": -1}, "seed is -1, and not"),
                               ({"gap": "wide"}, "gap is 'wide', and not a number"),
                               ({"thickness": None}, "thickness is None, and not a number")):
            with self.assertRaisesRegex(selvedge.ArgumentError, "^" + why):
                selvedge.generate("sheets", **arguments)
        with self.assertRaisesRegex(selvedge.ArgumentError, "5"):
            selvedge.generate(5)
        self.assertGreater(len(selvedge.generate("sheets", faces=np.int32(500), gap=np.float32(2**-8)).triangles), 0)


class Compatible(unittest.TestCase):
    def test_fast_simplification(self):
        mesh = layers(2000, 1)
        points, triangles, collapses = fast_simplification.simplify(*mesh, 0.5, return_collapses=True)
        self.assertLessEqual(len(triangles), len(mesh.triangles) // 2)
        self.assertTrue(selvedge.verify(points, triangles, tuple(mesh)))
        again, same, mapping = fast_simplification.replay_simplification(*mesh, collapses)
        np.testing.assert_array_equal(points, again)
        np.testing.assert_array_equal(triangles, same)
        self.assertEqual((mapping.min(), mapping.max()), (0, len(points) - 1))
        for wrong in ({}, {"target_reduction": 2}, {"target_reduction": 0.5, "target_count": 9}):
            with self.assertRaises(ValueError):
                fast_simplification.simplify(*mesh, **wrong)

    def test_pyfqmr(self):
        mesh = layers(2000, 1)
        simplifier = pyfqmr.Simplify()
        simplifier.setMesh(*mesh)
        simplifier.simplify_mesh(target_count=1000, aggressiveness=7, preserve_border=True, verbose=False)
        vertices, faces, normals = simplifier.getMesh()
        self.assertLessEqual(len(faces), 1000)
        self.assertEqual(normals.shape, faces.shape)
        border = fast_simplification.border_vertices(mesh.triangles)
        self.assertEqual(len(border), len(fast_simplification.border_vertices(faces)))

    def test_igl_and_trimesh(self):
        mesh = layers()
        U, G, J, I = igl.decimate(*mesh, 600)
        self.assertLessEqual(len(G), 600)
        self.assertEqual((len(J), len(I)), (len(G), len(U)))
        np.testing.assert_array_equal(U, mesh.points[I])
        self.assertTrue(selvedge.verify(U, G, tuple(mesh)))
        vertices, faces = trimesh.simplify_quadric_decimation(tuple(mesh), percent=0.75)
        self.assertLessEqual(len(faces), len(mesh.triangles) // 4 + 1)
        self.assertTrue(selvedge.verify(vertices, faces))


class Documentation(unittest.TestCase):
    def test_examples_run(self):
        with open(os.environ["SELVEDGE_PYTHON_PAGE"], encoding="utf-8") as page:
            blocks = re.findall(r"^```python\n(.*?)^```", page.read(), re.MULTILINE | re.DOTALL)
        self.assertGreaterEqual(len(blocks), 2)
        for block in blocks:
            exec(block, {})


if __name__ == "__main__":
    unittest.main()
