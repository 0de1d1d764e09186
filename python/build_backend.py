"""Builds wheels and source archives of the Python module (PEP 517). pip calls this file, which needs only Python and CMake.

KDS_BUILD names a build folder that is configured with -DKDS_PYTHON_MODULE=ON (default: build/pip- and the version of Python).
CMake uses what the folder has built already. If the folder is not configured, CMake is called with the options in
CMAKE_ARGS, quoted as in a shell. At most two compilers run at a time, unless CMAKE_BUILD_PARALLEL_LEVEL says otherwise.
"""

import base64
import hashlib
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from pathlib import Path

try:
    import tomllib
except ModuleNotFoundError:  # Python 3.9 and 3.10
    import tomli as tomllib

ROOT = Path(__file__).resolve().parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
VERSION = re.search(r"project\(kds VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def metadata():
    lines = ["Metadata-Version: 2.4", f"Name: {PROJECT['name']}", f"Version: {VERSION}", f"Summary: {PROJECT['description']}",
             f"License-Expression: {PROJECT['license']}", f"Requires-Python: {PROJECT['requires-python']}",
             f"Keywords: {','.join(PROJECT['keywords'])}"]
    lines += [f"License-File: {file}" for file in PROJECT["license-files"]]
    lines += [f"Author: {author['name']}" for author in PROJECT["authors"]]
    lines += [f"Classifier: {classifier}" for classifier in PROJECT["classifiers"]]
    lines += [f"Project-URL: {name}, {url}" for name, url in PROJECT["urls"].items()]
    lines += [f"Requires-Dist: {package}" for package in PROJECT["dependencies"]]
    for extra, packages in PROJECT["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f'Requires-Dist: {package}; extra == "{extra}"' for package in packages)]
    return "\n".join([*lines, "Description-Content-Type: text/markdown", "", (ROOT / PROJECT["readme"]).read_text()])


def build_module():
    """Returns the path of the built extension module."""
    build = Path(os.environ.get("KDS_BUILD", ROOT / "build" / f"pip-{sys.implementation.cache_tag}")).resolve()
    if not (build / "CMakeCache.txt").exists():
        options = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DKDS_PYTHON_MODULE=ON",
                   f"-DPython_EXECUTABLE={sys.executable}"]
        try:
            import pybind11  # the package of PyPI; others are found by CMake

            options.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
        except ModuleNotFoundError:
            pass
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), *options, *shlex.split(os.environ.get("CMAKE_ARGS", ""))],
                       check=True)
    compilers = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", "2")
    subprocess.run(["cmake", "--build", str(build), "--target", "kds_python", "--parallel", compilers], check=True)
    module = build / "python" / "kds" / f"_kds{sysconfig.get_config_var('EXT_SUFFIX')}"
    if not module.exists():
        sys.exit(f"{module}: CMake has not built it; expected the module of {sys.executable}")
    return module


def get_requires_for_build_wheel(config_settings=None):
    return [package for program, package in (("cmake", "cmake>=3.25"), ("ninja", "ninja")) if not shutil.which(program)]


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    module = build_module()
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    tag = f"{python}-{python}{sys.abiflags}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    info = f"{PROJECT['name']}-{VERSION}.dist-info"
    sources = [file for pattern in ("*.py", "*.pyi", "py.typed") for file in sorted((ROOT / "python" / "kds").glob(pattern))]
    content = {f"kds/{file.name}": file.read_bytes() for file in [*sources, module]}
    content |= {f"{info}/licenses/{file}": (ROOT / file).read_bytes() for file in PROJECT["license-files"]}
    content[f"{info}/METADATA"] = metadata().encode()
    content[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: kds {VERSION}\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = ""
    for name, data in content.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(data)}\n"
    content[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    wheel = f"{PROJECT['name']}-{VERSION}-{tag}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in content.items():
            archive.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED)  # without the time of day
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    """Packs the files that Git tracks, without data, pictures and tests, which the build does not need."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\0")
    name = f"{PROJECT['name']}-{VERSION}"
    with tarfile.open(Path(sdist_directory) / f"{name}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for file in listed:
            if file and not file.startswith(("data/", "docs/pictures/", "tests/")):
                archive.add(ROOT / file, f"{name}/{file}")
        text = metadata().encode()
        header = tarfile.TarInfo(f"{name}/PKG-INFO")
        header.size = len(text)
        archive.addfile(header, io.BytesIO(text))
    return f"{name}.tar.gz"
