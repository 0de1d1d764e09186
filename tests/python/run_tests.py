"""Runs the tests of the Python module. Usage: run_tests.py [NAME...], such as test_inputs.

KDS_PROGRAM and KDS_DATA name the program and the folder data; PYTHONPATH has the package kds. Exit code 77 (skipped) if
NumPy is not installed.
"""

import sys
import unittest
import warnings
from pathlib import Path

try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)

if __name__ == "__main__":
    here = Path(__file__).resolve().parent
    sys.path.insert(0, str(here))
    warnings.simplefilter("ignore")
    names = sys.argv[1:] or sorted(path.stem for path in here.glob("test_*.py"))
    suite = unittest.defaultTestLoader.loadTestsFromNames(names)
    result = unittest.TextTestRunner(verbosity=1, warnings="ignore").run(suite)
    sys.exit(0 if result.wasSuccessful() else 1)
