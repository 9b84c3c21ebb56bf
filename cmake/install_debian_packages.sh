#!/usr/bin/env bash
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what Selvedge is built from, on Debian 12 or later; does nothing where all of it is there already.
# With the argument "demo" also clang, with "fuzz" its run-time libraries, of which libFuzzer is one, with "manual" Doxygen, with "python"
# what the Python package and its tests need, with "html" Chromium, in which the pages of --html are tested, with "many" what
# works through folders of meshes, with "package" what makes packages, with "clean" what their test needs, with "blender" what the
# test of the add-on for Blender needs. The argument "benchmark" asks for the peers that the benchmark programs measure, which are
# among those of the tests. Several arguments may be given.
# With the first argument "build" it leaves out what only tests need: more than half of the packages, because OpenMesh depends on 160.
# With "list" it installs nothing, and prints a table: package, what it is needed for, why, and which version of it is here.
set -euo pipefail

# Every package, the argument with which it is installed, what it is needed for, and why. `policies` and `library` are needed by
# whoever compiles against these, too, so that the package libselvedge-dev depends on them.
table() {
  cat <<'TABLE'
g++                  always  build             compiles
cmake                always  build             configures
ninja-build          always  build             runs the compiler
libcgal-dev          always  policies,library  the geometry
libcli11-dev         always  program           options
libssl-dev           always  library           SHA-256, for logs of collapses
libtbb-dev           always  library           threads
zlib1g-dev           always  library           files in .gz
libmeshoptimizer-dev always  library           compressed glTF files; may be left out
libdraco-dev         always  library           compressed glTF files; may be left out
libtinygltf-dev      always  library           glTF documents
nlohmann-json3-dev   always  library,program   glTF documents, reports
esbuild              always  program           bundles the page of --html; may be left out
libjs-three          always  program           draws the page of --html; may be left out
libgtest-dev         tests   tests             every test
python3              tests   tests             whether includes go one way
libopenmesh-dev      tests   tests             a mesh of floats, through CGAL's adaptor
libeigen3-dev        tests   tests             the Garland-Heckbert policies of CGAL, beside which ours must work
clang                demo    program,tests     the demo, in less time than g++; fuzzing
libclang-rt-dev      fuzz    tests             sanitizers and libFuzzer
python3-dev          python  python            headers of Python
pybind11-dev         python  python            the module
python3-numpy        python  python            arrays
chromium             html    tests             pages of --html
doxygen              manual  manual            manual and reference
snakemake            many    workflow          a folder of meshes
parallel             many    workflow          a folder of meshes, without Snakemake
blender              blender tests             the add-on for Blender
xvfb                 blender tests             a display for Blender's window
xauth                blender tests             a display for Blender's window
libgl1-mesa-dri      blender tests             OpenGL without a graphics card
dpkg-dev             package packages          their dependencies
mmdebstrap           clean   tests             a clean system, in which the packages are tested
TABLE
}

if [[ "${1:-}" == list ]]; then
  printf 'package\tneeded for\twhy\tversion here\thomepage\n'
  while read -r package _ needed_for why; do
    found=$(dpkg-query -W -f '${Version}\t${Homepage}' "$package" 2>/dev/null) || found='none\t'
    printf '%s\t%s\t%s\t%b\n' "$package" "$needed_for" "$why" "$found"
  done < <(table)
  exit
fi
for_tests=tests
if [[ "${1:-}" == build ]]; then
  for_tests=
fi
mapfile -t packages < <(table | awk -v wanted=" always $for_tests $* " 'index(wanted, " " $2 " ") { print $1 }')

is_installed() { [[ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]; }

if ! command -v dpkg-query >/dev/null; then
  echo "No Debian here: install the like of ${packages[*]} yourself." >&2
  exit 0
fi
missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
if [[ ${#missing[@]} == 0 ]]; then
  exit 0
fi

as_root=()
if [[ $EUID != 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "Missing packages, and no sudo to install them: as root, run  apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
