"""Installs the module with pip into a plain virtual environment, without a network and without setuptools, and uses it there.

KDS_BUILD names a build folder with the module, so that nothing is compiled. Exit code 77 (skipped) if there is no pip.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

import numpy

ROOT = Path(__file__).resolve().parents[2]
USES = 'import kds; print(kds.run(kds.generate("spiral", beads=30, frames=5), radius=1).fingerprint, kds.__file__)'


def main():
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    expected, _ = subprocess.run([sys.executable, "-c", USES], capture_output=True, text=True, check=True).stdout.split()
    with tempfile.TemporaryDirectory() as folder:
        try:
            venv.create(folder, with_pip=True)
        except subprocess.CalledProcessError as error:
            print(f"skipped: no virtual environment with pip ({error})")
            return 77
        python = str(Path(folder) / "bin" / "python")
        source = Path(folder) / "source"
        source.mkdir()
        for name in ("pyproject.toml", "CMakeLists.txt", "README.md", "LICENSE"):
            shutil.copy(ROOT / name, source)
        shutil.copytree(ROOT / "python", source / "python")
        pip = [python, "-m", "pip"]
        subprocess.run([*pip, "install", "--quiet", "--no-index", "--no-deps", str(source)], check=True, env=environment)
        environment["PYTHONPATH"] = str(Path(numpy.__file__).parents[1])  # the environment itself has no NumPy
        found, path = subprocess.run([python, "-c", USES], capture_output=True, text=True, check=True, env=environment,
                                     cwd=folder).stdout.split()
        assert path.startswith(folder), path
        shown = subprocess.run([*pip, "show", "kds"], capture_output=True, text=True, check=True, env=environment).stdout
        assert "\nRequires: numpy\n" in shown, shown
        subprocess.run([*pip, "uninstall", "--quiet", "--yes", "kds"], check=True, env=environment)
        assert not Path(path).exists(), f"pip leaves {path}"
    assert found == expected, (found, expected)
    print(f"installed, and gives the fingerprint {found}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
