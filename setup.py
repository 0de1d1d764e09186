"""Builds the Python module with CMake, for `pip install .`. The version is that of CMakeLists.txt.

KDS_BUILD names a build folder that is configured with -DKDS_PYTHON_MODULE=ON (default: build/pip). What the folder has built
already is used again. If the folder is not configured, CMake is called with the options in CMAKE_ARGS, separated by blanks.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        target = Path(self.get_ext_fullpath(extension.name)).resolve()
        build = Path(os.environ.get("KDS_BUILD", ROOT / "build" / "pip")).resolve()
        if not (build / "CMakeCache.txt").exists():
            subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DKDS_PYTHON_MODULE=ON", f"-DPython_EXECUTABLE={sys.executable}",
                            *os.environ.get("CMAKE_ARGS", "").split()], check=True)
        subprocess.run(["cmake", "--build", str(build), "--target", "kds_python"], check=True)
        built = build / "python" / "kds" / target.name
        if not built.exists():
            sys.exit(f"{built}: CMake has not built it; expected the module of {sys.executable}")
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(built, target)


version = re.search(r"project\(kds VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
setup(version=version, packages=["kds"], package_dir={"": "python"}, package_data={"kds": ["py.typed", "*.pyi"]},
      ext_modules=[Extension("kds._kds", sources=[])], cmdclass={"build_ext": BuildByCMake})
