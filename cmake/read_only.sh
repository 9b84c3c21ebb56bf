#!/bin/sh
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Runs a compiler that reads a source, with all its templates and warnings, but generates no code, and leaves an empty object.
# A launcher of compilers, for objects that nobody links: half the time of a compilation without optimisation.
"$@" -fsyntax-only || exit
while [ $# -gt 1 ]; do
  if [ "$1" = -o ]; then
    : >"$2"
  fi
  shift
done
