"""Compares the frame-based figures of `kds contacts` with MDAnalysis and mdtraj on the same frames.

Usage: compare_contacts.py KDS DATA. Exit code 77 (skipped) if a package is not installed.
- mdtraj's compute_contacts finds which residues are in contact at each frame: number, length and occupancy.
- MDAnalysis' correct_intermittency bridges absences, and its autocorrelation is the survival probability.
"""
import json
import os
import subprocess
import sys
import warnings

try:
    warnings.simplefilter("ignore")
    import mdtraj
    import numpy
    from MDAnalysis.lib.correlations import autocorrelation, correct_intermittency
except Exception as error:  # a package may be installed and broken
    print(f"skipped: a package that contacts are compared with cannot be imported ({error})")
    sys.exit(77)

KDS, DATA = sys.argv[1:3]
CUTOFF, BRIDGE, STRIDES = 8.0, 2, (1, 2, 4, 8)
FAILURES = []


def check(condition, message):
    if not condition:
        FAILURES.append(message)
        print("FAILED:", message)


def runs_of(sets):
    """Returns the number of runs of consecutive frames, and the number of frames in contact."""
    runs = sum(len(now - before) for before, now in zip([set()] + sets, sets))
    return runs, sum(len(s) for s in sets)


def compare(name, row, kind, sets, pairs, frame, tolerance):
    runs, frames = runs_of(sets)
    own = {key: row[f"{kind}_{key}"] for key in ("contacts", "length", "occupancy")}
    check(abs(own["contacts"] - runs) <= tolerance, f"{name}: {own['contacts']} contacts, expected {runs}")
    occupancy = frames / len(sets) / pairs
    check(abs(own["occupancy"] - occupancy) <= 1e-9 + tolerance / len(sets) / pairs,
          f"{name}: occupancy {own['occupancy']}, expected {occupancy}")
    length = frames / runs * row["spacing"] * frame
    check(tolerance > 0 or abs(own["length"] - length) <= 1e-9 * length, f"{name}: length {own['length']}, expected {length}")
    return runs, frames


def compare_file(dcd, pdb, frames):
    dcd, pdb = (os.path.join(DATA, "trajectories", file) for file in (dcd, pdb))
    run = subprocess.run([KDS, "contacts", dcd, "--topology", pdb, "--select", "ca", "--frames", f":{frames}",
                          "--cutoff", str(CUTOFF), "--apart", "3", "--intermittency", str(BRIDGE),
                          "--strides", ",".join(map(str, STRIDES)), "--json", "-"], capture_output=True, text=True)
    if run.returncode != 0:
        return check(False, f"{dcd}: {run.stderr}")
    result = json.loads(run.stdout)
    pairs, frame = result["all"]["pairs_asked"], result["run_length"] / (result["input"]["frames"] - 1)
    trajectory = mdtraj.load(dcd, top=pdb)[:frames]
    distances, numbers = mdtraj.compute_contacts(trajectory, contacts="all", scheme="ca", periodic=False)
    ties = int((abs(distances - CUTOFF / 10) < 2e-7).sum())  # mdtraj computes in single precision
    inside = distances <= CUTOFF / 10
    print(f"{os.path.basename(dcd)}: {inside.sum()} contacts at frames, {ties} too near the cutoff to compare exactly")
    rows = {row["spacing"]: row for row in result["frames"] if row["spacing"] is not None}
    for stride in STRIDES:
        name = f"{os.path.basename(dcd)}, every {stride}. frame"
        sets = [set(numpy.flatnonzero(now)) for now in inside[::stride]]
        runs, in_contact = compare(name, rows[stride], "plain", sets, pairs, frame, ties)
        # The survival probability after one frame looked at: those still in contact, of those before.
        _, _, by_frame = autocorrelation(sets, 1, 1)
        still = sum(share * len(s) for share, s in zip(by_frame[0], [s for s in sets[:-1] if s]))
        samples = rows[stride]["plain_occupancy"] * rows[stride]["samples"] * pairs
        survival, expected = (samples - rows[stride]["plain_contacts"]) / (samples - len(sets[-1])), still / (in_contact - len(sets[-1]))
        check(abs(survival - expected) <= 1e-9 + 2 * ties / in_contact, f"{name}: survival {survival}, expected {expected}")
        bridged = correct_intermittency([set(s) for s in sets], BRIDGE)
        compare(name + ", MDAnalysis bridges", rows[stride], "bridged", bridged, pairs, frame, ties)
    print("ok:" if not FAILURES else "--:", os.path.basename(dcd), f"{pairs} pairs")


compare_file("villin_hp36_300K.dcd", "villin_hp36_300K.pdb", 400)
compare_file("random100_400K_first200.dcd", "random100_400K.pdb", 200)
sys.exit(1 if FAILURES else 0)
