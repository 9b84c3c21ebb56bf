#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the picture of docs/html.md: a page of --html, coloured by what holds each face back.

    docs/picture/page.py build/release/apps/selvedge chromium multilayer_skirt.obj docs/picture/html.png
"""
import pathlib
import subprocess
import sys
import tempfile

CLICK = """<script>addEventListener('load', () => setTimeout(() => {
  for (const button of document.querySelectorAll('button'))
    if (button.textContent === 'Held back by') button.click();
}, 2000));</script>"""


def main(program, browser, mesh, picture):
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "page.html"
        subprocess.run([program, "simplify", mesh, "-o", page.with_suffix(".obj"), "--ratio", "0.01", "--html", page,
                        "--quiet"], check=True)
        page.write_text(page.read_text() + CLICK)
        subprocess.run([browser, "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                        "--enable-unsafe-swiftshader", "--window-size=1100,720",
                        f"--user-data-dir={folder}/profile", "--virtual-time-budget=20000",
                        f"--screenshot={pathlib.Path(picture).resolve()}", page.as_uri()],
                       check=True, stderr=subprocess.DEVNULL)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
