#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests simplify_one.py and table.py: the table has every level of every mesh, and every mesh that fails, with its reason."""
import csv
from pathlib import Path
import subprocess
import sys
import tempfile
import unittest

WORKFLOW, SELVEDGE = Path(sys.argv.pop(1)), sys.argv.pop(1)


class Steps(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.meshes, self.out = Path(folder.name) / "meshes", Path(folder.name) / "out"
        (self.meshes / "sub").mkdir(parents=True)

    def generate(self, name, scene="grid"):
        subprocess.run([SELVEDGE, "generate", scene, "-o", self.meshes / name, "--faces", "400", "--quiet"], check=True)

    def simplify(self, name, *options, program=SELVEDGE):
        return subprocess.run([sys.executable, WORKFLOW / "simplify_one.py", self.meshes / name, self.out, "--meshes", self.meshes,
                               "--ratios", "0.5,0.2", "--selvedge", program, *options], stderr=subprocess.DEVNULL).returncode

    def table(self):
        subprocess.run([sys.executable, WORKFLOW / "table.py", self.out], check=True, stdout=subprocess.DEVNULL)
        with open(self.out / "table.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_every_level_has_a_row(self):
        self.generate("sub/two words.obj")
        self.assertEqual(self.simplify("sub/two words.obj"), 0)
        rows = self.table()
        self.assertEqual([row["level"] for row in rows], ["1", "2"])
        for row, faces in zip(rows, (200, 80)):
            self.assertLessEqual(int(row["faces"]), faces)
            self.assertEqual((row["mesh"], row["exit code"], row["new pairs"]), ("sub/two words.obj", "0", "0"))
            self.assertTrue((self.out / row["output"]).is_file())

    def test_mesh_that_fails_has_a_row_with_its_reason(self):
        (self.meshes / "bad.obj").write_text("v 0 0 <b>\n")
        self.generate("good.obj")
        self.assertEqual(self.simplify("bad.obj"), 3)
        self.simplify("good.obj")
        bad, *good = self.table()
        self.assertEqual((bad["mesh"], bad["exit code"], bad["faces"]), ("bad.obj", "3", ""))
        self.assertIn("bad.obj:1", bad["reason"])
        self.assertEqual(len(good), 2)
        self.assertIn("2 meshes, 1 of them failed", (self.out / "table.html").read_text())

    def test_what_is_no_mesh_in_the_folder_is_refused_and_nothing_is_lost(self):
        self.out.mkdir()
        (self.out / "mine.txt").write_text("mine")
        self.generate("a.obj")
        for name in (".", "absent.obj"):
            self.assertEqual(self.simplify(name), 2)
        self.assertEqual(self.simplify("a.obj", "--meshes", str(self.out)), 2)
        self.out = self.meshes
        before = (self.meshes / "a.obj").read_bytes()
        self.assertEqual(self.simplify("a.obj"), 2)
        self.assertEqual((self.meshes / "a.obj").read_bytes(), before)
        self.assertEqual((self.out.parent / "out" / "mine.txt").read_text(), "mine")

    def test_mesh_that_misses_a_target_it_needs_keeps_its_figures(self):
        self.generate("tight.obj", "sheets")
        self.assertEqual(self.simplify("tight.obj", "--options=--require-target --error 1e-9"), 1)
        row = self.table()[-1]
        self.assertEqual((row["exit code"], row["reached"]), ("1", "false"))
        self.assertGreater(int(row["faces"]), 80)

    def test_what_never_ran_leaves_no_outcome(self):
        self.generate("good.obj")
        self.simplify("good.obj")
        self.assertNotEqual(self.simplify("good.obj", program="no_such_program"), 0)
        self.assertEqual(list(self.out.rglob("outcome.json")), [])


if __name__ == "__main__":
    unittest.main()
