"""Inputs of the tests, and the program to compare with.

KDS_PROGRAM is the path of the program and KDS_DATA that of the folder data. PYTHONPATH has the package kds.
"""

import csv
import json
import os
import re
import subprocess
import tempfile

import numpy as np

PROGRAM = os.environ["KDS_PROGRAM"]
DATA = os.environ["KDS_DATA"]
DCD = os.path.join(DATA, "trajectories", "villin_hp36_300K.dcd")
PDB = os.path.join(DATA, "trajectories", "villin_hp36_300K.pdb")
RESIDUES = os.path.join(DATA, "trajectories", "ubiquitin_pull_first30.pdb")
BACKBONE = "backbone and not name O"


def program(*arguments):
    """Returns the JSON that a command of the program writes."""
    run = subprocess.run([PROGRAM, *arguments, "--json", "-"], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise RuntimeError(run.stderr)
    return json.loads(run.stdout)


def program_warnings(*arguments):
    """Returns the warnings that a command of the program prints, with the names of Python's arguments."""
    run = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=True)
    start = "kds: warning: "
    def name(match):
        return "start, stop, step" if match[1] == "frames" else match[1].replace("-", "_")

    return [re.sub(r"--([a-z-]+)", name, line[len(start):]) for line in run.stderr.splitlines() if line.startswith(start)]


def program_events(*arguments):
    """Returns the events that `kds run --events` writes, a dictionary for each line of the CSV."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "events.csv")
        program("run", *arguments, "--events", path)
        with open(path, newline="") as file:
            return list(csv.DictReader(file))


def universe(path=DCD):
    import MDAnalysis

    return MDAnalysis.Universe(PDB, path)


def coil(frames=6, beads=30):
    """Returns positions of a coil that winds up, an array (frames, beads, 3)."""
    bead, frame = np.arange(beads)[None, :], np.arange(frames)[:, None]
    angle = 0.6 * bead * (1 + 0.15 * frame)
    radius = 2 + 0.3 * np.sin(1.7 * bead + frame)
    height = 0.45 * bead * (1 - 0.08 * frame)
    return np.stack([angle * 0 + np.cos(angle) * radius, np.sin(angle) * radius, height], axis=-1)
