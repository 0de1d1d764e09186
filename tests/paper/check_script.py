"""Runs a script of experiments/paper in its short form. Usage: check_script.py NAME, such as table1.

The counts of its rows must be those in NAME.json of this folder, if there is such a file. A row is named by its member "row".
The claims that NAME.json lists under "claims" must hold. Other claims, such as those on times, may fail.
Exit code 77 (skipped) if numpy or scipy is not installed.
"""

import json
import math
import os
import subprocess
import sys
from pathlib import Path

try:
    import numpy  # noqa: F401
    import scipy  # noqa: F401
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

HERE = Path(__file__).resolve().parent
name = sys.argv[1]
script = HERE.parents[1] / "experiments" / "paper" / f"{name}.py"
run = subprocess.run([sys.executable, str(script), "--short", "--json", "-", "--data", os.environ["KDS_DATA"]],
                     stdout=subprocess.PIPE, text=True, check=False)
if run.returncode != 0:
    sys.exit(f"{name}: the script failed with exit code {run.returncode}")
results = json.loads(run.stdout)
failures = [] if results["rows"] or results["claims"] else ["no rows and no claims"]
expected_file = HERE / f"{name}.json"
if expected_file.exists():
    expected = json.loads(expected_file.read_text())
    holds = {claim["claim"]: claim["holds"] for claim in results["claims"]}
    failures += [f"claim {claim!r} does not hold" for claim in expected.pop("claims", []) if not holds.get(claim)]
    found = {row["row"]: row for row in results["rows"]}
    failures += [f"{row}: is not expected" for row in found if row not in expected]
    if len(found) < len(expected) / 2:
        failures.append(f"{len(found)} of {len(expected)} rows")
    for row in filter(found.get, expected):
        for column, value in expected[row].items():
            if not math.isclose(found[row][column], value, rel_tol=0 if isinstance(value, int) else 1e-9):
                failures.append(f"{row}: {column} is {found[row][column]}, expected {value}")
print("\n".join(failures) or f"{name}: as expected")
sys.exit(1 if failures else 0)
