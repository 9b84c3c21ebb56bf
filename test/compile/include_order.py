#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tells whether includes go one way: `include_order.py TREE`.

LEVELS is the way of a file through the program, read backwards: a file may include those of its own level and of the
levels before it. JUDGE names what judges results, which shares nothing with the filter that it judges. A public header
includes an internal one only when it uses a name that is declared there. Exit status 1 when an include breaks a rule, or
a file belongs to no level.
"""
import os
import pathlib
import re
import sys

LEVELS = [
    ("basics", ["include/selvedge/Cancellation_scope.h", "include/selvedge/Error.h", "include/selvedge/Soup_collapse.h", "include/selvedge/internal/base64.h", "include/selvedge/internal/inflated.h", "include/selvedge/internal/Stopwatch.h", "include/selvedge/internal/instructions.h",
                "include/selvedge/internal/Vector_of_doubles.h", "include/selvedge/internal/nearest_on_triangle.h", "include/selvedge/internal/saturated_float.h", "include/selvedge/internal/exact_predicates.h", "include/selvedge/internal/Packed_numbers.h"]),
    ("geometry", ["include/selvedge/geometry/", "include/selvedge/spatial/"]),
    ("policies", ["include/selvedge/Surface_mesh_simplification/", "include/selvedge/Simplify_options.h",
                  "include/selvedge/Simplify_report.h"]),
    ("soups", ["include/selvedge/Triangle_soup.h", "include/selvedge/Parts.h", "include/selvedge/Progression.h", "include/selvedge/rounding.h", "include/selvedge/Border_gaps.h", "include/selvedge/merge.h", "include/selvedge/attributes.h", "include/selvedge/drop_parts.h", "include/selvedge/normals.h", "include/selvedge/suited_normals.h",
               "include/selvedge/Sewing_notes.h", "include/selvedge/Snapping_notes.h", "include/selvedge/internal/Scale.h",
               "src/soup/"]),
    ("welding", ["src/weld/"]),
    ("files", ["include/selvedge/gltf_poses.h", "include/selvedge/mesh_files.h", "include/selvedge/poses.h", "include/selvedge/references.h", "src/files/", "include/selvedge/generate.h", "src/generate/"]),
    ("judge", ["include/selvedge/verify.h", "include/selvedge/compare.h", "src/verify/"]),
    ("logs", ["include/selvedge/Reduction_limits.h", "include/selvedge/collapse_log.h", "include/selvedge/Sha256.h", "src/log/"]),
    ("replay", ["include/selvedge/replay.h", "src/replay/"]),
    ("reduction", ["include/selvedge/prepare.h", "include/selvedge/simplify.h", "include/selvedge/Error_search.h", "include/selvedge/Missed_target.h", "include/selvedge/Reduction_history.h", "include/selvedge/Reduction_log.h",
                   "include/selvedge/key_poses.h", "include/selvedge/part_report.h", "src/simplify/"]),
    ("cells", ["include/selvedge/cells.h", "src/cells/"]),
    ("progressive files", ["include/selvedge/progressive.h", "src/progressive/"]),
    ("inspection", ["include/selvedge/inspect.h", "src/inspect/"]),
    ("app", ["apps/"]),
    ("bindings", ["bindings/"]),
]
JUDGE = ["src/verify/", "src/replay/", "include/selvedge/verify.h", "include/selvedge/compare.h", "include/selvedge/replay.h"]
FILTER = ["include/selvedge/geometry/", "include/selvedge/spatial/", "include/selvedge/Surface_mesh_simplification/"]


def is_in(file, places):
    return any(file == place or place.endswith("/") and file.startswith(place) for place in places)


def level(file):
    return next((i for i, (_, places) in enumerate(LEVELS) if is_in(file, places)), None)


def includes(tree, file):
    """Yields the files of the tree that a file includes."""
    for name in re.findall(r'^#include [<"]([^>"]+)[>"]', (tree / file).read_text(encoding="utf-8"), re.MULTILINE):
        for folder in ("include", os.path.dirname(file), "src", "apps", "test", "."):
            candidate = os.path.normpath(os.path.join(folder, name))
            if (tree / candidate).is_file():
                yield candidate
                break


def reached(tree, file, seen):
    for included in includes(tree, file):
        if included not in seen:
            seen.add(included)
            reached(tree, included, seen)
    return seen


def code(tree, file):
    """The text of a file without comments and includes."""
    return re.sub(r"//[^\n]*|^#include[^\n]*", "", (tree / file).read_text(encoding="utf-8"), flags=re.MULTILINE)


def is_needed(tree, file, included):
    """Whether a file uses a name that the included one declares: a type, a macro or a function."""
    declared = set(re.findall(r"\b(?:class|struct|using|#define)\s+(\w+)", code(tree, included)))
    declared |= set(re.findall(r"^(?:\w|[<>:,&* ])*?\b(\w+)\(", code(tree, included), re.MULTILINE))
    return any(re.search(rf"\b{name}\b", code(tree, file)) for name in declared)


def main():
    tree = pathlib.Path(sys.argv[1])
    files = sorted(str(f.relative_to(tree)) for folder in ("include", "src", "apps", "bindings")
                   for ending in ("h", "cpp") for f in (tree / folder).rglob("*." + ending))
    errors = [f"{file}: belongs to no level; add it to LEVELS" for file in files if level(file) is None]
    for file in files:
        for included in includes(tree, file):
            if level(file) is not None and level(included) is not None and level(included) > level(file):
                errors.append(f"{file} ({LEVELS[level(file)][0]}) includes {included} ({LEVELS[level(included)][0]}), "
                              "which comes later on the way")
            if file.startswith("include/") and "/internal/" not in file and "/internal/" in included \
                    and not is_needed(tree, file, included):
                errors.append(f"{file} is public, and includes {included}, of which it uses nothing")
        if is_in(file, JUDGE):
            errors += [f"{file} judges, and includes {included}, which is a part of the filter"
                       for included in sorted(reached(tree, file, set())) if is_in(included, FILTER)]
    print("\n".join(errors) if errors else f"{len(files)} files: all includes go one way")
    return 1 if errors or not files else 0


if __name__ == "__main__":
    sys.exit(main())
