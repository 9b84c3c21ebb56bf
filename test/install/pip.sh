#!/usr/bin/env bash
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs the Python package by pip into an environment of its own, from a copy of the tree, and runs its tests there. It takes
# the build tools of the system, so that it needs no package index.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

mkdir "$work/selvedge"
tar -C "$root" --exclude ./build --exclude ./out --exclude ./.git -c . | tar -C "$work/selvedge" -x
/usr/bin/python3 -m venv --system-site-packages "$work/environment"
"$work/environment/bin/pip" install --no-build-isolation --no-deps "$work/selvedge/bindings/python"
cd "$root/test/bindings"
SELVEDGE_PYTHON_PAGE="$root/docs/python.md" PYTHONDONTWRITEBYTECODE=1 "$work/environment/bin/python" -m unittest python_test
