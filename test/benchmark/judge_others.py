#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the table of docs/validate_your_simplifier.md: what `selvedge replay --all` finds in the logs of other programs.

    judge_others.py BUILD MESH... [--ratio 0.3]

BUILD is the folder that `cmake --preset benchmark` builds in. A program that was not built has no rows.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

PROGRAMS = {
    "cgal": "CGAL `edge_collapse`",
    "openmesh": "OpenMesh `DecimaterT`",
    "libigl": "libigl `decimate`, blocking intersections",
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("meshes", type=pathlib.Path, nargs="+")
    parser.add_argument("--ratio", default="0.3")
    arguments = parser.parse_args()
    app = arguments.build / "apps" / "selvedge"

    def judged(mesh, log):
        run = subprocess.run([app, "replay", mesh, log, "--no-limits", "--all", "--json"], capture_output=True, text=True)
        if run.returncode not in (0, 1):
            sys.exit(f"judge_others.py: {log}: {run.stderr.strip()}")
        return json.loads(run.stdout)

    print("| mesh | program | collapses | intersections | tunnellings | other |\n| --- | --- | --: | --: | --: | --: |")
    with tempfile.TemporaryDirectory() as folder:
        for mesh in arguments.meshes:
            logs = {}
            for program, name in PROGRAMS.items():
                executable, log = arguments.build / "test" / "benchmark" / f"log_{program}", f"{folder}/{program}.log"
                if executable.exists():
                    subprocess.run([executable, mesh, log, "--ratio", arguments.ratio], check=True)
                    logs[name] = log
            ours = f"{folder}/selvedge.log"
            subprocess.run([app, "simplify", mesh, "-o", f"{folder}/out.obj", "--ratio", arguments.ratio, "--log", ours, "--quiet"],
                           check=True)
            logs["Selvedge"] = ours
            title = mesh.stem
            for name, log in logs.items():
                verdict = judged(mesh, log)
                totals = {kind["kind"]: kind["count"] for kind in verdict["violations"]["kinds"]}
                intersections, tunnellings = totals.pop("intersection", 0), totals.pop("tunnelling", 0)
                print(f"| {title} | {name} | {verdict['steps']['collapses']:,} | {intersections:,} | {tunnellings:,} "
                      f"| {sum(totals.values()):,} |", flush=True)
                title = ""


main()
