#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tells whether the documentation names things that exist: `documentation_names.py TREE`.

It looks in README.md, CONTRIBUTING.md, CHANGELOG.md and docs/*.md for links to files and headings of the tree, and for
names of files and tests in code marks: `geometry/star.h`, `Motion.OrderOfLayersIsKept`, `Replay.Accepts*`. Exit status 1
when one of them does not exist.
"""
import fnmatch
import pathlib
import re
import sys

FOLDERS = ("apps", "bindings", "cmake", "docs", "examples", "include", "src", "test")
FILE = re.compile(r"[\w./-]*\w\.(?:h|cpp|py|sh|md)")
TEST = re.compile(r"(?:\w+/)?[A-Z]\w+\.[A-Z][\w*]*|[A-Z]\w+\.\*")
# In code marks, these are examples of names and not names of files.
EXAMPLES = {"TOPIC_test.cpp"}


def anchor(heading):
    """Returns the anchor that GitHub gives a heading."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def without_code(text):
    return re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)


def anchors(page):
    return {anchor(h) for h in re.findall(r"^#+ (.*)$", without_code(page.read_text(encoding="utf-8")), re.MULTILINE)}


def main():
    tree = pathlib.Path(sys.argv[1])
    pages = [tree / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md") if (tree / name).exists()]
    pages += sorted((tree / "docs").glob("*.md"))
    files = [f"/{f.relative_to(tree)}" for folder in FOLDERS for f in (tree / folder).rglob("*") if f.is_file()]
    tests = set()
    for source in (tree / "test").rglob("*.cpp"):
        text = source.read_text(encoding="utf-8")
        tests.update(f"{suite}.{name}" for suite, name in re.findall(r"^TEST(?:_[FP])?\((\w+), (\w+)\)", text, re.MULTILINE))
    errors, names = [], 0
    for page in pages:
        text = without_code(page.read_text(encoding="utf-8"))

        def require(is_there, name):
            nonlocal names
            names += 1
            if not is_there:
                errors.append(f"{page.relative_to(tree)}: {name} does not exist")

        for link in re.findall(r"\]\(([^)\s]+)\)", text):
            if "://" in link:
                continue
            target, _, heading = link.partition("#")
            file = page.parent / target if target else page
            require(file.exists(), link)
            if heading and file.exists():
                require(heading in anchors(file), link)
        for code in re.findall(r"`([^`\s]+)`", text):
            if FILE.fullmatch(code) and code not in EXAMPLES:
                require(any(file.endswith("/" + code) for file in files) or (tree / code).exists(), code)
            elif TEST.fullmatch(code):
                require(fnmatch.filter(tests, code.rpartition("/")[2]), code)
    print("\n".join(errors) if errors else f"{len(pages)} pages: all {names} names exist")
    return 1 if errors or not names else 0


if __name__ == "__main__":
    sys.exit(main())
