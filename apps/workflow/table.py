#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts what simplify_one.py wrote below a folder into one table: OUT/table.csv and OUT/table.html.

    table.py OUT

There is one row for each level of each mesh, and one for each mesh that failed, with its exit code and the reason.
"""
import csv
from html import escape
import json
from pathlib import Path
import sys
from urllib.parse import quote

# Columns after those of the outcome, by their keys in the report (docs/report.md).
OF_LEVEL = {
    "faces of input": "faces.input", "target": "faces.target", "faces": "faces.output", "reached": "target.reached",
    "held back by": "target.outcome", "pairs of input": "verified.pairs_of_original", "pairs": "verified.pairs",
    "new pairs": "verified.new_pairs", "RMS": "distance.original_to_result.rms", "largest": "distance.original_to_result.max",
    "megabytes": "memory.peak_bytes", "output": "output.path",
}
COLUMNS = ["mesh", "level", "exit code", "reason", "seconds", *OF_LEVEL]

STYLE = """body { font: 14px sans-serif; margin: 2em }
table { border-collapse: collapse } td, th { padding: 2px 8px; border-bottom: 1px solid #ccc; text-align: right }
th { position: sticky; top: 0; background: #fff } .failed { background: #fdd } .missed { background: #ffd }
td:first-child, th:first-child, td:nth-child(4) { text-align: left }"""


def value(report, key):
    for word in key.split("."):
        report = report.get(word) if isinstance(report, dict) else None
    return report


def rows_of(folder, out):
    outcome = json.loads((folder / "outcome.json").read_text())
    first = [outcome["mesh"], "", outcome["exit_code"], outcome["reason"], outcome["seconds"]]
    report_file = folder / "report.json"
    if not report_file.exists():
        return [first + [""] * len(OF_LEVEL)]
    report = json.loads(report_file.read_text())
    rows = []
    for number, level in enumerate(report.get("lods") or [report], 1):
        row = [*first[:1], number, *first[2:]]
        for key in OF_LEVEL.values():
            cell = value(level, key)
            cell = value(report, key) if cell is None else cell
            if key == "memory.peak_bytes" and cell is not None:
                cell = round(cell / 1e6)
            elif key == "output.path":
                cell = str((folder / Path(cell).name).relative_to(out))
                if value(level, "output.written") is False or not (out / cell).exists():
                    cell = ""
            row.append("" if cell is None else str(cell).lower() if isinstance(cell, bool) else cell)
        rows.append(row)
    return rows


def html_row(row):
    of = dict(zip(COLUMNS, row))
    kind = "failed" if of["exit code"] != 0 else "missed" if of["reached"] == "false" else ""
    cells = []
    for column, cell in of.items():
        text = f"{cell:.3g}" if isinstance(cell, float) else f"{cell:,}" if isinstance(cell, int) else escape(str(cell))
        if column == "output" and cell:
            text = f'<a href="{quote(str(cell))}">{text}</a>'
        cells.append(f"<td>{text}</td>")
    return f'<tr class="{kind}">{"".join(cells)}</tr>'


def main(out):
    out = Path(out)
    folders = sorted(path.parent for path in out.rglob("outcome.json"))
    rows = [row for folder in folders for row in rows_of(folder, out)]
    with open(out / "table.csv", "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows])
    failed = len({row[0] for row in rows if row[2] != 0})
    head = "".join(f"<th>{column}</th>" for column in COLUMNS)
    body = "\n".join(map(html_row, rows))
    (out / "table.html").write_text(
        f'<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8"><title>{len(folders)} meshes</title>\n<style>{STYLE}</style>\n'
        f"<p>{len(folders)} meshes, {failed} of them failed.</p>\n<table>\n<tr>{head}</tr>\n{body}\n</table></html>\n")
    print(f"{out / 'table.csv'}, {out / 'table.html'}: {len(folders)} meshes, {failed} of them failed")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    if not Path(sys.argv[1]).is_dir():
        sys.exit(f"{sys.argv[1]}: there is no such folder")
    main(sys.argv[1])
