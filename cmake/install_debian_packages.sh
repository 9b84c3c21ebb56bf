#!/usr/bin/env bash
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what Selvedge is built from, on Debian 12 or later; does nothing where all of it is there already.
# With the argument "fuzz" also clang and its run-time libraries, of which libFuzzer is one, with "manual" Doxygen, with "python"
# what the Python package and its tests need, with "html" Chromium, in which the pages of --html are tested. The argument
# "benchmark" asks for the peers that the benchmark programs measure, which are among the packages of every build.
set -euo pipefail

packages=(
  g++ cmake ninja-build
  libcgal-dev           # the geometry
  libcli11-dev          # options of the app
  libssl-dev            # SHA-256, for logs of collapses
  libtbb-dev            # threads
  zlib1g-dev            # files in .gz
  libmeshoptimizer-dev  # compressed glTF files; may be left out
  libdraco-dev          # compressed glTF files; may be left out
  libtinygltf-dev       # glTF documents
  nlohmann-json3-dev    # glTF documents, reports of the app
  esbuild libjs-three   # the page of --html; may be left out
  libgtest-dev          # tests
  python3               # tests: whether includes go one way
  libopenmesh-dev       # tests: a mesh of floats, through CGAL's adaptor
  libeigen3-dev         # tests: the Garland-Heckbert policies of CGAL, beside which ours must work
)
if [[ "${1:-}" == fuzz ]]; then
  packages+=(clang libclang-rt-dev)
elif [[ "${1:-}" == python ]]; then
  packages+=(python3-dev pybind11-dev python3-numpy)
elif [[ "${1:-}" == html ]]; then
  packages+=(chromium)
elif [[ "${1:-}" == manual ]]; then
  packages+=(doxygen)
fi

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
