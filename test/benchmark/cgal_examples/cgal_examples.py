#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds and runs the examples of CGAL's Surface_mesh_simplification with the loop of CGAL, with that of Selvedge in its
place, and with the intersection filter as well, and writes what came out to docs/cgal_examples.md.

    cgal_examples.py CGAL --selvedge build/release/apps/selvedge [--work FOLDER] [--also SOURCE...]

CGAL is the folder of CGAL's sources: a release or a checkout, or where the archives of Debian's package libcgal-demo are
unpacked. SOURCE is another program that calls `SMS::edge_collapse`, such as a test of CGAL's.

The exit code is 1 when a program with Selvedge's loop fails where that of CGAL runs, when the filter lets a new pair through,
or when the loop of Selvedge alone makes more new pairs than that of CGAL. A refusal with an error is no failure.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
LOOPS = ("cgal", "selvedge", "with_filter")
REFUSED = 3  # the exit code by which recorded_edge_collapse.h reports an exception
EXPLANATION = """Both loops collapse the cheapest edge first. They collapse the same edges in the same order until two edges
cost exactly the same: then CGAL's order follows from its heap, and Selvedge's from the numbers of the edges. The runs whose collapses
differ are these; every other run takes the same steps in both loops."""
EXACT_KERNEL = "CGAL::Exact_predicates_inexact_constructions_kernel"


def folder_of(sources, *choices):
    for choice in choices:
        if (sources / choice).is_dir():
            return (sources / choice).resolve()
    sys.exit(f"cgal_examples.py: {sources} has none of {', '.join(choices)}")


def substitute(source, is_filtered):
    """Returns the text of an example with the loop substituted, and with an exact kernel where the filter needs one."""
    text = source.read_text().replace("get_filter(", "filter(")
    text, calls = re.subn(r"\bSMS::edge_collapse\s*\(", "selvedge::recorded::edge_collapse(", text)
    if calls == 0:
        sys.exit(f"cgal_examples.py: {source} does not call SMS::edge_collapse")
    head = '#include "run_loop.h"\n'
    if is_filtered:
        text = text.replace("CGAL::Simple_cartesian<double>", EXACT_KERNEL)
        head = "#define RECORDED_WITH_FILTER\n#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>\n"
    return head + '#include "recorded_edge_collapse.h"\n' + text


def build(examples, folder):
    sources = folder / "sources"
    shutil.rmtree(sources, ignore_errors=True)
    sources.mkdir(parents=True)
    for example in examples:
        (sources / f"{example.stem}.cpp").write_text(substitute(example, False))
        (sources / f"{example.stem}-with_filter.cpp").write_text(substitute(example, True))
    programs = folder / "build"
    # With assertions, which the examples use to check results.
    subprocess.run(["cmake", "-G", "Ninja", "-S", HERE, "-B", programs, f"-DEXAMPLES={sources}", "-DCMAKE_BUILD_TYPE=None",
                    "-DCMAKE_CXX_FLAGS=-O1"], check=True, stdout=subprocess.DEVNULL)
    log = subprocess.run(["ninja", "-C", programs, "-j2", "-k0"], stdout=subprocess.PIPE, text=True).stdout
    (folder / "build.txt").write_text(log)
    with open(programs / "CMakeCache.txt") as cache:
        cgal = next(line.split("=", 1)[1].strip() for line in cache if line.startswith("CGAL_DIR"))
    return programs, version(cgal)


def version(cgal):
    text = (pathlib.Path(cgal) / "CGALConfigVersion.cmake").read_text()
    return re.search(r'CGAL_VERSION_PUBLIC_RELEASE_VERSION "([^"]+)"', text)[1]


def new_pairs(selvedge, before, after):
    run = subprocess.run([selvedge, "verify", after, "--against", before, "--json"], capture_output=True, text=True)
    if run.returncode not in (0, 1):
        sys.exit(f"cgal_examples.py: {after}: {run.stderr.strip()}")
    return json.loads(run.stdout)["verified"]["new_pairs"]


def run(programs, name, loop, folder, data, selvedge):
    """Returns the runs of the loop in a program as pairs (edges removed, new pairs), or a sentence why there are none."""
    program = programs / (f"{name}-with_filter" if loop == "with_filter" else name)
    if not program.exists():
        return "does not compile"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "data").symlink_to(data / "meshes")
    environment = {**os.environ, "CGAL_DATA_DIR": str(data), "RECORDED_LOOP": loop}
    status = subprocess.run([program], cwd=folder, env=environment, capture_output=True, text=True)
    if status.returncode == REFUSED:
        return "refused: " + status.stderr.strip().splitlines()[-1]
    removed = (folder / "removed.txt").read_text().split() if (folder / "removed.txt").exists() else []
    if status.returncode != 0:
        return f"fails with exit code {status.returncode} after {len(removed)} runs of the loop"
    return [(int(edges), new_pairs(selvedge, folder / f"before_{i}.off", folder / f"after_{i}.off"))
            for i, edges in enumerate(removed, 1)]


def difference(folder):
    """Returns a sentence about where the steps of both loops begin to differ, or none where they do not."""
    cgal, alone = ((folder / loop / "steps.txt").read_text().split("run\n")[1:] for loop in LOOPS[:2])
    for run, (theirs, ours) in enumerate(zip(cgal, alone), 1):
        theirs, ours = theirs.splitlines(), ours.splitlines()
        same = next((i for i, pair in enumerate(zip(theirs, ours)) if pair[0] != pair[1]), min(len(theirs), len(ours)))
        if same == max(len(theirs), len(ours)):
            continue
        costs = [steps[same].split()[0] if same < len(steps) else "none" for steps in (theirs, ours)]
        if costs[0] == costs[1]:
            return (f"run {run} differs from collapse {same + 1:,} on, for which both loops have edges of the cost "
                    f"{float(costs[0]):.6g}")
        return (f"run {run} differs from collapse {same + 1:,} on: CGAL's loop collapses an edge of the cost {costs[0]}, "
                f"that of Selvedge one of {costs[1]}")
    return None


def is_kept(results):
    """Returns whether Selvedge did what it promises in an example."""
    cgal, alone, filtered = (results[loop] for loop in LOOPS)
    if isinstance(cgal, str):
        return True
    if isinstance(alone, str) or any(ours[1] > theirs[1] for ours, theirs in zip(alone, cgal)):
        return False
    if isinstance(filtered, str):
        return filtered.startswith("refused")
    return all(pairs == 0 for _, pairs in filtered)


def page(all_results, differences, cgal_version, command):
    yield f"""# CGAL's examples with the loop of Selvedge

[cgal_examples.py](../test/benchmark/cgal_examples/cgal_examples.py) has made this page. It builds the examples of CGAL's
Surface_mesh_simplification three times and runs them on the meshes that they name: as they are; with
`selvedge::edge_collapse` in place of CGAL's function, in the same call; and with an `Intersection_filter` upon the filter of the
example, its visitor before that of the example, and `{EXACT_KERNEL.removeprefix("CGAL::")}` in
place of `Simple_cartesian<double>`, which the filter refuses. A cell has the number of edges removed and, after the stroke, the
number of new pairs: pairs of triangles that intersect after the run, but did not before, counted by `selvedge verify`. An
example that calls the loop several times has as many rows. CGAL is {cgal_version}.

```
{command}
```

| example | CGAL's loop | Selvedge's loop | with the filter |
| --- | --: | --: | --: |
"""
    notes = []
    for name, results in all_results.items():
        for loop, result in results.items():
            if isinstance(result, str):
                notes.append(f"- {name}, {loop.replace('_', ' ')}: {result}.")
        rows = max(len(result) for result in results.values() if not isinstance(result, str)) if any(
            not isinstance(result, str) for result in results.values()) else 1
        for i in range(rows):
            cells = [f"{result[i][0]:,} / {result[i][1]:,}" if not isinstance(result, str) and i < len(result) else "–"
                     for result in results.values()]
            yield f"| {name if i == 0 else ''} | {' | '.join(cells)} |\n"
    if notes:
        yield "\nA dash stands where there is no figure:\n\n" + "\n".join(notes) + "\n"
    yield f"\n## Where the loops differ\n\n{EXPLANATION}\n\n"
    yield "".join(f"- {name}: {sentence}.\n" for name, sentence in differences.items() if sentence)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cgal", type=pathlib.Path)
    parser.add_argument("--selvedge", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("cgal_examples"))
    parser.add_argument("--also", type=pathlib.Path, nargs="*", default=[])
    parser.add_argument("-o", dest="output", type=pathlib.Path, default=ROOT / "docs" / "cgal_examples.md")
    arguments = parser.parse_args()
    work, selvedge = arguments.work.resolve(), arguments.selvedge.resolve()
    data = folder_of(arguments.cgal, "Data/data", "data")
    examples = folder_of(arguments.cgal, "Surface_mesh_simplification/examples/Surface_mesh_simplification",
                         "examples/Surface_mesh_simplification")
    sources = sorted(examples.glob("*.cpp")) + arguments.also
    programs, cgal_version = build(sources, work)
    results = {source.stem: {loop: run(programs, source.stem, loop, work / "runs" / source.stem / loop, data, selvedge)
                             for loop in LOOPS} for source in sources}
    differences = {name: difference(work / "runs" / name) for name, runs in results.items()
                   if not any(isinstance(runs[loop], str) for loop in LOOPS[:2])}
    also = "".join(f" {source.name}" for source in arguments.also)
    command = "test/benchmark/cgal_examples/cgal_examples.py CGAL --selvedge build/release/apps/selvedge" + (
        f" --also{also}" if also else "")
    arguments.output.write_text("".join(page(results, differences, cgal_version, command)))
    return 0 if all(map(is_kept, results.values())) else 1


if __name__ == "__main__":
    sys.exit(main())
