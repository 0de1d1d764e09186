"""Executes docs/python.ipynb. Usage: run_notebook.py [FOLDER], which receives the pictures.

Exit code 77 (skipped) if a package that the notebook needs is not installed.
"""

import base64
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def main():
    try:
        import ipykernel  # noqa: F401
        import matplotlib  # noqa: F401
        import MDAnalysis  # noqa: F401
        import nbformat
        import pandas  # noqa: F401
        from nbconvert.preprocessors import ExecutePreprocessor
    except Exception as error:  # a package may be installed and broken
        print(f"skipped: a package that the notebook needs cannot be imported ({error})")
        return 77
    notebook = nbformat.read(ROOT / "docs" / "python.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "docs/python.ipynb: expected no outputs in the file"
    ExecutePreprocessor(timeout=300).preprocess(notebook, {"metadata": {"path": str(ROOT / "docs")}})
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    pictures = [output["data"]["image/png"] for output in outputs if "image/png" in output.get("data", {})]
    assert len(pictures) == 5, f"{len(pictures)} pictures"
    text = str(outputs)
    for expected in ("fingerprint", "contacts, median life", "occupancy", "kds-replay"):
        assert expected in text, expected
    if len(sys.argv) > 1:
        for number, picture in enumerate(pictures):
            (Path(sys.argv[1]) / f"{number}.png").write_bytes(base64.b64decode(picture))
    print(f"executed, with {len(pictures)} pictures")
    return 0


if __name__ == "__main__":
    sys.exit(main())
