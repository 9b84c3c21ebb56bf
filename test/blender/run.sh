#!/usr/bin/env bash
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Tests the add-on for Blender: in the background what it makes, and in a window (on a display that is not shown) undo, progress and
# cancel. On demand; needs what `cmake/install_debian_packages.sh blender` installs.
#
#   test/blender/run.sh [SELVEDGE]      the program, build/release/apps/selvedge unless given
set -euo pipefail
tree=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
selvedge=$(realpath "${1:-$tree/build/release/apps/selvedge}")
need() { command -v "$1" >/dev/null || { echo "$1 is missing: install the Debian package $2, or run cmake/install_debian_packages.sh blender" >&2; exit 1; }; }
need blender blender
need xvfb-run xvfb
need xauth xauth
[[ -x "$selvedge" ]] || { echo "$selvedge is missing: build it, or name another" >&2; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$selvedge" generate skirt -o "$folder/skirt.obj" --faces 12000 --poses 2 --poses-out "$folder/pose_{pose}.obj" --quiet
# Nothing of the person who runs this is read or written.
export HOME="$folder" SELVEDGE="$selvedge" FOLDER="$folder" ADD_ON="$tree/apps/blender" LIBGL_ALWAYS_SOFTWARE=1
export TMPDIR="$folder" PYTHONDONTWRITEBYTECODE=1
run() { # Blender ends with 0 when a script fails
  timeout 600 "$@" >"$folder/log" 2>&1 && grep -q "^all is well" "$folder/log" ||
    { cat "$folder/log" >&2; exit 1; }
  grep "^ok: " "$folder/log"
}
cd "$tree/test/blender"
run blender --background --factory-startup --python background_test.py
run xvfb-run -a -s "-screen 0 1280x800x24" blender --factory-startup --enable-event-simulate --no-window-focus --python window_test.py
