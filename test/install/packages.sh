#!/usr/bin/env bash
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Tests the packages of Debian as a person gets them: makes them, installs each with apt in a clean Debian 12 that has nothing
# else, and uses it there. On demand; as root, since the clean system is a chroot.
#
#   test/install/packages.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake/install_debian_packages.sh clean
./packages
build=$PWD/build/packages

root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
chmod 755 "$root"
mmdebstrap --mode=root --variant=apt --quiet bookworm "$root"
in_root() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }
install_package() {
  cp "$build/$1"_*.deb "$root/tmp/"
  in_root sh -c "apt-get update -qq && apt-get install -y -qq --no-install-recommends /tmp/$1_*.deb >/tmp/log 2>&1 || { cat /tmp/log; exit 1; }"
}

echo "--- the program"
install_package selvedge
in_root sh -ec '
  cd /tmp
  selvedge generate skirt -o skirt.obj --faces 20000 --layers 3
  selvedge simplify skirt.obj -o small.obj --ratio 0.2 --report small.json
  selvedge verify small.obj --against skirt.obj
  selvedge-cgalsimp2 missing.off 0.1 missing_out.off && exit 1
  selvedge generate nested -o nested.off --faces 4000 && selvedge-cgalsimp2 nested.off 0.3 less.off
  test -s /usr/share/man/man1/selvedge.1
  test -s /usr/share/selvedge/blender/selvedge_blender/__init__.py
  bash -c "source /usr/share/bash-completion/completions/selvedge && complete -p selvedge"'

echo "--- Python"
install_package python3-selvedge
in_root python3 -c '
import selvedge
points, triangles = selvedge.generate("sheets", faces=2000, layers=3)
result = selvedge.simplify(points, triangles, ratio=0.3)
assert result.accepted and selvedge.verify(*result, original=(points, triangles))
print(len(triangles), "to", len(result.triangles), "faces by", selvedge.__file__)'

echo "--- C++: a program of other people"
install_package libselvedge-dev
in_root sh -c "apt-get install -y -qq --no-install-recommends g++ cmake ninja-build >/tmp/log 2>&1 || { cat /tmp/log; exit 1; }"
cp -r test/install/find_package "$root/tmp/"
in_root sh -ec '
  cd /tmp/find_package && cmake -G Ninja -B build -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-O0 >/dev/null
  cmake --build build && ./build/consumer'
echo "The packages work in a clean Debian."
