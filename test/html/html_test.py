#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens pages of --html in headless Chromium, clicks, and looks at the pixels.

    html_test.py SELVEDGE CHROMIUM

A script in the page does the steps of a person and writes what it finds into the page, which Chromium prints.
"""

import base64
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

EVIL = "</script><b id=evil>\"'&amp;<!--"

# Runs first of all, to see every error.
WATCH = """<script>window.problems = [];
onerror = message => void problems.push(String(message));
onunhandledrejection = event => problems.push(String(event.reason));
for (const kind of ['error', 'warn']) console[kind] = (...words) => problems.push(words.join(' '));</script>"""

# Numbers of a half of the canvas: the share of pixels that are no background, and a sum that tells pictures apart.
PROBE = """<script>
function half(side) {
  viewer.draw();
  const gl = viewer.renderer.getContext(), width = gl.drawingBufferWidth >> 1, height = gl.drawingBufferHeight;
  const bytes = new Uint8Array(4 * width * height);
  gl.readPixels(side * width, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  let drawn = 0, sum = 0;
  for (let i = 0; i < bytes.length; i += 4) {
    drawn += bytes[i] !== bytes[0] || bytes[i + 1] !== bytes[1];
    sum = (Math.imul(sum, 31) + (bytes[i] << 16 | bytes[i + 1] << 8 | bytes[i + 2])) | 0;
  }
  return {drawn: 4 * drawn / bytes.length, sum};
}
const halves = () => viewer.models.map((model, side) => half(side));
const q = selector => document.querySelector(selector), all = selector => [...document.querySelectorAll(selector)];
async function probe() {
  while (!window.viewer && problems.length === 0) await new Promise(done => setTimeout(done, 20));
  const found = {first: halves(), modes: {}, levels: [], parts: all('#parts .name').map(name => name.textContent)};
  for (const button of all('#modes button')) {
    button.click();
    found.modes[button.id] = halves();
  }
  q('#mode-part').click();
  for (const level of viewer.data.levels) {
    if (level.button.isConnected) level.button.click();
    const after = viewer.models[1], corners = after.mesh.corners, left = [];
    for (let t = 0; 3 * t < corners.length; ++t) {
      const [a, b, c] = [0, 1, 2].map(k => after.into[corners[3 * t + k]]);
      if (a !== b && b !== c && c !== a) left.push(t);
    }
    const found_level = {faces: level.faces, shown: after.left, same: !level.triangles || left.join() === level.triangles.join()};
    if (level.steps) {
      const slider = q('#slider');
      const seek = step => { slider.value = step; slider.oninput(); return halves(); };
      const end = halves();
      found_level.start = seek(0);
      found_level.at_start = after.left;
      found_level.middle = seek(level.steps >> 1);
      found_level.returns = seek(level.steps)[1].sum === end[1].sum;
    }
    found.levels.push(found_level);
  }
  q('#edges').click();
  found.without_edges = halves();
  q('#edges').click();
  found.y_up = halves();
  q('#z_up').click();
  found.z_up = halves();
  q('#z_up').click();
  found.y_up_again = halves();
  if (viewer.obstacle) {
    q('#obstacle input').click();
    found.without_obstacle = halves();
    q('#obstacle input').click();
  }
  found.whole = halves();
  q('#parts input').click();
  found.without_part = halves();
  q('#none').click();
  found.none = halves();
  q('#all').click();
  found.all = halves();
  if (viewer.level && q('#replay').classList.contains('plotted')) {
    const box = q('#plots').getBoundingClientRect(), counts = () => all('#refused .count').map(count => count.textContent);
    found.plot = {at_end: counts(), shapes: all('#plots svg *').length};
    q('#plots').dispatchEvent(new PointerEvent('pointerdown', {clientX: box.left + box.width / 4, clientY: box.top + 5}));
    found.plot.share = viewer.models[1].step / viewer.level.steps;
    found.plot.slider = Number(q('#slider').value) === viewer.models[1].step;
    found.plot.marker = (q('#marker').getBoundingClientRect().left + 1 - box.left) / box.width;
    found.plot.clicked = halves();
    found.plot.counts = counts();
    viewer.go_to_step(viewer.level.steps);
  }
  found.poses = all('#poses .place').map(button => {
    button.click();
    return {name: button.querySelector('.name').textContent, refused: button.querySelector('.count').textContent, halves: halves()};
  });
  if (found.poses.length) {
    all('#poses .place')[0].click();
    found.poses_return = halves();
  }
  found.places = all('#faults .place, #places .place').length;
  found.faults = all('#faults .place').map(button => {
    button.click();
    return {text: button.textContent, step: viewer.level ? viewer.models[1].step : 0, lines: viewer.outline.children[0].geometry.attributes.position.count};
  });
  if (found.places) {
    const button = all('#faults .place, #places .place')[0];
    button.click();
    await new Promise(done => setTimeout(done, 1500));
    found.flown = halves();
    found.rings = all('.ring').filter(ring => !ring.hidden).length;
  }
  found.verdict = q('#verdict').textContent;
  found.evil = !!q('#evil');
  return found;
}
</script>"""
END = """<script>probe().catch(error => void problems.push(error.stack)).then(found => {
  const element = document.createElement('pre');
  element.id = 'found';
  element.textContent = btoa(unescape(encodeURIComponent(JSON.stringify({found, problems}))));
  document.body.append(element);
});</script>"""


def layers(path, size=18, gap=0.15):
    """Writes two wavy sheets, one above the other, with texture and names; a fold of one crosses nothing."""
    lines, vertex = [], 0
    for layer, name in enumerate(["lining", EVIL]):
        lines += [f"g {name}"]
        for i in range(size):
            for j in range(size):
                height = gap * layer + 0.2 * ((i * 7 + j * 3) % 5) / 5 * gap
                lines += [f"v {i / size} {j / size} {height}", f"vt {i / size} {j / size}"]
        for i in range(size - 1):
            for j in range(size - 1):
                a = vertex + i * size + j + 1
                b, c, d = a + size, a + size + 1, a + 1
                lines += [f"f {a}/{a} {b}/{b} {c}/{c}", f"f {a}/{a} {c}/{c} {d}/{d}"]
        vertex += size * size
    path.write_text("\n".join(lines) + "\n")


class Pages:
    def __init__(self, selvedge, chromium, folder):
        self.selvedge, self.chromium, self.folder = selvedge, chromium, folder

    def run(self, *arguments, code=0):
        done = subprocess.run([self.selvedge, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        assert done.returncode == code, (arguments, done.returncode, done.stderr)

    def look(self, page):
        text = (self.folder / page).read_text()
        assert text.count("</script>") == 4, "a name has ended a script"
        assert not re.search(r"(src|href)=|@import|https?://(?!threejs\.org|www\.w3\.org)", text.split("<script>")[0])
        text = text.replace("<head>", "<head>" + WATCH, 1).replace("</body>", PROBE + END + "</body>")
        (self.folder / "probed.html").write_text(text)
        out = subprocess.run(
            [self.chromium, "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--window-size=800,600", f"--user-data-dir={self.folder / 'profile'}",
             "--virtual-time-budget=20000", "--dump-dom", (self.folder / "probed.html").as_uri()],
            capture_output=True, text=True, timeout=300)
        match = re.search(r'<pre id="found">([^<]*)', out.stdout)
        assert match, out.stdout[-500:] + out.stderr[-2000:]
        found = json.loads(base64.b64decode(match[1]))
        assert found["problems"] == [], (page, found["problems"])
        self.judge(page, found["found"])
        return found["found"]

    @staticmethod
    def judge(page, found):
        """What holds of every page."""
        sums = lambda halves: [half["sum"] for half in halves]
        for half in found["first"] + found["whole"] + found["all"]:
            assert half["drawn"] > 0.02, (page, "blank", found["first"])
        pictures = [tuple(sums(halves)) for halves in found["modes"].values()]
        assert len(pictures) > 1 and len({picture[0] for picture in pictures}) > 1, (page, "modes change nothing", pictures)
        for level in found["levels"]:
            assert level["same"] and level["shown"] == level["faces"], (page, level)
            if "start" in level:
                assert level["returns"] and level["middle"][1]["sum"] != level["start"][1]["sum"], (page, level)
        assert sums(found["without_edges"]) != sums(found["whole"])
        assert sums(found["z_up"]) != sums(found["y_up"]) and found["y_up_again"] == found["y_up"], page
        assert sums(found["without_part"])[0] != sums(found["whole"])[0]
        assert found["all"] == found["whole"]
        assert not found["evil"]
        if "plot" in found:
            plot = found["plot"]
            assert abs(plot["share"] - 0.25) < 0.01 and abs(plot["marker"] - 0.25) < 0.01 and plot["slider"], (page, plot)
            assert plot["clicked"][1] != found["all"][1] and plot["shapes"] == 1 + len(plot["counts"]), (page, plot)
        if found["places"]:
            assert found["rings"] > 0 and sums(found["flown"]) != sums(found["whole"]), page


def main():
    selvedge, chromium = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        pages = Pages(str(pathlib.Path(selvedge).resolve()), chromium, folder)
        layers(folder / "in.obj")
        (folder / "body.obj").write_text("v 0 0 -1\nv 1 0 -1\nv 0 1 -1\nf 1 2 3\n")

        pages.run("simplify", "in.obj", "-o", "out.obj", "--ratio", "0.3", "--error", "none", "--html", "a.html")
        found = pages.look("a.html")
        assert EVIL in found["parts"], found["parts"]
        modes = [tuple(half["sum"] for half in halves) for halves in found["modes"].values()]
        assert found["modes"].keys() == {"mode-part", "mode-plain", "mode-distance", "mode-still", "mode-checker"}
        assert len(set(modes)) >= 4, modes # nothing is frozen: that is plain
        level = found["levels"][0]
        assert level["start"][0] == level["start"][1], "before the first collapse, both sides are alike"
        assert level["at_start"] == 2 * 2 * 17 * 17 and level["middle"][1] != level["start"][1]
        assert [half["drawn"] for half in found["none"]] == [0, 0]

        # What may break the order of collapses: places, cells, levels by themselves, an obstacle, reasons.
        for options in (["--placement", "optimal", "--lods", "0.5,0.2"], ["--cells", "--lods", "0.5,0.2", "--obstacle", "body.obj"],
                        ["--lods", "0.6,0.3", "--ratio", "lining=0.9"]):
            pages.run("simplify", "in.obj", "-o", "{lod}.obj", "--html", "lods.html", *options)
            found = pages.look("lods.html")
            assert len(found["levels"]) == 2
            assert ("without_obstacle" in found) == ("--obstacle" in options)
        pages.run("simplify", "in.obj", "-o", "out.glb", "--ratio", "0", "--keep", "lining", "--error", "1e-9", "--html", "held.html")
        assert "mode-reason" in pages.look("held.html")["modes"]

        # A tall pose, and one in which the layers are bent and near each other.
        points = [line.split() for line in (folder / "in.obj").read_text().splitlines()]
        for name, of in (("tall", lambda x, y, z: (x, 3 * y, z)), ("near", lambda x, y, z: (x, y, z - 0.145 * (z > 0.1) + 0.5 * math.sin(6 * x)))):
            (folder / f"{name}.obj").write_text("\n".join(
                " ".join(["v", *map(str, of(*map(float, words[1:])))]) if words[0] == "v" else " ".join(words) for words in points) + "\n")
        poses = ["--pose", "tall.obj", "--pose", "near.obj"]
        pages.run("simplify", "in.obj", "-o", "posed.obj", "--ratio", "0.1", "--error", "none", "--html", "poses.html", "--log", "posed.log",
                  "--report", "poses.json", *poses)
        found, report = pages.look("poses.html"), json.loads((folder / "poses.json").read_text())
        assert [pose["name"] for pose in found["poses"]] == ["as in the file", "tall", "near"]
        assert len({pose["halves"][side]["sum"] for pose in found["poses"] for side in (0, 1)}) == 6, found["poses"]
        assert found["poses_return"] == found["whole"]
        refused = [int(pose["refused"].replace(",", "")) for pose in found["poses"]]
        assert sum(refused) == report["refused"]["intersection"] > 0, (refused, report["refused"])
        at_end = sorted(int(count.replace(",", "")) for count in found["plot"]["at_end"])
        assert at_end == sorted(count for count in report["refused"].values() if count > 0), found["plot"]

        # A replay: as it was; and of a reduction in which nothing kept the layers apart, with a step that joins no neighbours.
        pages.run("replay", "in.obj", "posed.log", "--html", "replayed.html", *poses)
        found = pages.look("replayed.html")
        assert found["verdict"] == "Every step is accepted" and found["places"] == 0, found
        assert found["levels"][0]["shown"] == report["faces"]["output"]
        pages.run("generate", "skirt", "-o", "skirt.obj", "--faces", "1000", "--layers", "3", "--quiet")
        pages.run("simplify", "skirt.obj", "-o", "unkept.obj", "--ratio", "0.1", "--no-intersection-check", "--log", "unkept.log", code=1)
        lines = (folder / "unkept.log").read_text().splitlines()
        lines.insert(next(i for i, line in enumerate(lines) if line.startswith("c ")) + 4, "c 0 323")
        (folder / "bad.log").write_text("\n".join(lines) + "\n")
        pages.run("replay", "skirt.obj", "bad.log", "--all", "--no-limits", "--html", "bad.html", code=1)
        faults = pages.look("bad.html")["faults"]
        assert any(fault["text"].startswith("step 5: no edge joins") and fault["step"] == 4 for fault in faults), faults
        crossing = [fault for fault in faults if "intersect" in fault["text"]]
        assert crossing, faults
        for fault in crossing: # the step is the next one, and its faces are outlined as they will be
            assert fault["text"].startswith(f"step {fault['step'] + 1:,}:") and fault["lines"] >= 12, fault

        pages.run("verify", "out.obj", "--against", "in.obj", "--html", "verify.html")
        assert len(pages.look("verify.html")["first"]) == 2
        (folder / "cross.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv .2 .2 -1\nv .2 .2 1\nv .9 .9 1\nf 1 2 3\nf 4 5 6\n")
        pages.run("verify", "cross.obj", "--html", "one.html", code=1)
        found = pages.look("one.html")
        assert len(found["first"]) == 1 and found["places"] == 1
    print("all pages are as they should be")


if __name__ == "__main__":
    main()
