"""Installs the module with pip into a virtual environment without a network, and uses it there.

KDS_BUILD names a build folder with the module, so that nothing is compiled. Exit code 77 (skipped) if pip lacks a package
that it needs.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
USES = 'import kds; print(kds.run(kds.generate("spiral", beads=30, frames=5), radius=1).fingerprint, kds.__file__)'


def main():
    try:
        import setuptools  # noqa: F401
        import venv
        import wheel  # noqa: F401
    except ImportError as error:
        print(f"skipped: {error}")
        return 77
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    expected, _ = subprocess.run([sys.executable, "-c", USES], capture_output=True, text=True, check=True).stdout.split()
    with tempfile.TemporaryDirectory() as folder:
        try:
            venv.create(folder, system_site_packages=True, with_pip=True)
        except subprocess.CalledProcessError as error:
            print(f"skipped: no virtual environment with pip ({error})")
            return 77
        python = str(Path(folder) / "bin" / "python")
        source = Path(folder) / "source"  # pip writes into the folder that it installs
        source.mkdir()
        for name in ("pyproject.toml", "setup.py", "CMakeLists.txt", "README.md", "LICENSE"):
            shutil.copy(ROOT / name, source)
        shutil.copytree(ROOT / "python", source / "python")
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-index", "--no-build-isolation", "--no-deps",
                        str(source)], check=True, env=environment)
        found, path = subprocess.run([python, "-c", USES], capture_output=True, text=True, check=True, env=environment,
                                     cwd=folder).stdout.split()
        assert path.startswith(folder), path
    assert found == expected, (found, expected)
    print(f"installed, and gives the fingerprint {found}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
