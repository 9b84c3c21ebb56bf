#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reduces one mesh of a folder to several levels, and writes down how that ended.

    simplify_one.py MESHES/NAME OUT [--meshes MESHES] [--ratios 0.5,0.25,0.1] [--options "--weld auto"] [--selvedge PROGRAM]

It makes the folder OUT/NAME with the levels, the report report.json, and last of all outcome.json: the exit code, the reason if
it is not 0, and the time. The exit code is that of selvedge. A run that was interrupted leaves no outcome.json.
"""
import argparse
import json
import os
from pathlib import Path
import shlex
import signal
import subprocess
import sys
import time

INTERRUPTED = 5


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--meshes", type=Path, help="folder that NAME is relative to; without it, that of the mesh")
    parser.add_argument("--ratios", default="0.5,0.25,0.1")
    parser.add_argument("--options", default="", help="further options of selvedge simplify")
    parser.add_argument("--selvedge", default="selvedge")
    arguments = parser.parse_args()

    if not arguments.mesh.is_file():
        parser.error(f"{arguments.mesh}: there is no such file")
    try:
        name = arguments.mesh.relative_to(arguments.meshes or arguments.mesh.parent)
    except ValueError:
        parser.error(f"{arguments.mesh}: is not in {arguments.meshes}; give --meshes as the mesh begins")
    folder = arguments.out / name
    if folder.is_file():
        parser.error(f"{folder}: is a file, in place of which a folder would be made; choose another OUT")
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.iterdir():  # of an earlier run, which perhaps got further
        if old.is_file():
            old.unlink()
    stem, *endings = name.name.split(".")
    levels = folder / ".".join([stem + "_{lod}", *endings])
    command = [arguments.selvedge, "simplify", str(arguments.mesh), "-o", str(levels), "--lods", arguments.ratios,
               "--report", str(folder / "report.json"), "--quiet", *shlex.split(arguments.options)]

    # A signal to all processes of the group reaches selvedge by itself; this one waits for its exit code.
    signal.signal(signal.SIGINT, lambda *_: None)
    begin = time.monotonic()
    try:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace")
    except OSError as error:
        sys.exit(f"{arguments.selvedge}: {error.strerror}")
    signal.signal(signal.SIGTERM, lambda *_: process.terminate())
    errors = process.communicate()[1]
    sys.stderr.write(errors)
    code = process.returncode
    if code == INTERRUPTED:
        return code
    lines = errors.strip().splitlines()
    reason = "" if code == 0 else f"ended by signal {-code}" if code < 0 else lines[-1] if lines else "no reason given"
    outcome = {"mesh": str(name), "exit_code": code if code >= 0 else 128 - code, "reason": reason.removeprefix("selvedge: "),
               "seconds": round(time.monotonic() - begin, 3), "command": shlex.join(command)}
    unfinished = folder / "outcome.json.part"
    unfinished.write_text(json.dumps(outcome, indent=2) + "\n")
    os.replace(unfinished, folder / "outcome.json")
    return outcome["exit_code"]


if __name__ == "__main__":
    sys.exit(main())
