# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Has CMake build the compiled module, for `pip install`. All else is in pyproject.toml."""

import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

try:
    from pybind11 import get_cmake_dir
except ImportError:  # with --no-build-isolation, CMake may find that of the system
    get_cmake_dir = None

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Build(build_ext):
    def run(self):
        folder = pathlib.Path(self.build_temp).resolve()
        found = [f"-Dpybind11_DIR={get_cmake_dir()}"] if get_cmake_dir else []
        subprocess.run(["cmake", "--preset", "packages", "-B", folder, "-DSELVEDGE_BUILD_APP=OFF", "-DSELVEDGE_BUILD_C=OFF",
                        f"-DPython3_EXECUTABLE={sys.executable}", *found], cwd=ROOT, check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "selvedge_python"], check=True)
        module = pathlib.Path(self.get_ext_fullpath("selvedge._selvedge"))
        module.parent.mkdir(parents=True, exist_ok=True)
        [built] = (folder / "bindings" / "python" / "selvedge").glob("_selvedge*")
        shutil.copy(built, module)


version = re.search(r"^project\(selvedge VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.MULTILINE)
setup(version=version[1], ext_modules=[Extension("selvedge._selvedge", sources=[])], cmdclass={"build_ext": Build})
