"""Recomputes the contacts of peptide_2fs.trr.gz, as experiments/paper/spacing.py counts them on straight paths, with numpy.

Usage: spacing_contacts.py KDS DATA FOLDER. Exit code 77 (skipped) if numpy is not installed. No code is shared with kds.
The squared distance of a water and an oxygen, in the image that is nearest at the start of a step, is a quadratic in that step.
All beginnings and ends of contacts must be those in intervals.csv, within 1e-6 frames.
"""

import csv
import gzip
import subprocess
import sys
from pathlib import Path

try:
    import numpy
except Exception as error:  # a package may be installed and broken
    print(f"skipped: numpy cannot be imported ({error})")
    sys.exit(77)

KDS, DATA, FOLDER = sys.argv[1], Path(sys.argv[2]) / "trajectories", Path(sys.argv[3])


def read_trr(path):
    """Returns the side of the cubic cell and positions (frames, atoms, 3) in angstrom of a file whose frames have equal size."""
    content = gzip.open(path).read()
    atoms, step = int.from_bytes(content[64:68], "big"), 84 + 36 + 24 * int.from_bytes(content[64:68], "big")
    frames = numpy.frombuffer(content, numpy.uint8).reshape(-1, step)
    floats = numpy.ascontiguousarray(frames[:, 84:120 + 12 * atoms]).view(">f4").astype(float)
    angstrom = (10 * floats).astype(numpy.float32).astype(float)  # as kds stores them
    return angstrom[0, 0], angstrom[:, 9:].reshape(len(frames), atoms, 3)


def crossings(apart, side, cutoff):
    """Returns beginnings and ends of contacts of two atoms in frames, and whether the first is open at the start. `apart` is
    their difference (frames, 3)."""
    start, move = apart[:-1], numpy.diff(apart, axis=0)
    start = start - side * numpy.round(start / side)
    a, b, c = (move**2).sum(1), 2 * (start * move).sum(1), (start**2).sum(1) - cutoff**2
    times = []
    for step in numpy.flatnonzero((b * b >= 4 * a * c) & (a > 0)):
        for sign in (-1, 1):
            at = (-b[step] + sign * numpy.sqrt(b[step] ** 2 - 4 * a[step] * c[step])) / (2 * a[step])
            times += [(step + at, sign > 0)] if 0 <= at < 1 else []
    begins, ends = ([at for at, is_end in times if is_end == kind] for kind in (False, True))
    return ([0.0] if c[0] <= 0 else []) + begins, ends + ([float(len(start))] if len(ends) < len(begins) + (c[0] <= 0) else [])


def recompute(stride, cutoff):
    topology = [line[10:15].strip() for line in (DATA / "peptide_2fs.gro").read_text().splitlines()[2:-1]]
    side, positions = read_trr(DATA / "peptide_2fs.trr.gz")
    positions, found = positions[::stride], {}
    for water in (k for k, name in enumerate(topology) if name == "OW"):
        for oxygen in (k for k, name in enumerate(topology) if name == "O"):
            begins, ends = crossings(positions[:, water] - positions[:, oxygen], side, cutoff)
            for begin, end in zip(begins, ends):
                found.setdefault((oxygen, water), []).append((begin, end))
    return found


def by_kds(stride, cutoff):
    folder = FOLDER / f"{stride}-{cutoff}"
    subprocess.run([KDS, "contacts", DATA / "peptide_2fs.trr.gz", "--topology", DATA / "peptide_2fs.gro", "--select", "//*",
                    "--groups", "//*/(SOL)/OW", "//*//O", "--cutoff", str(cutoff), "--by", "bead", "--apart", "1",
                    "--frames", f"::{stride}", "--out", folder, "--replace", "--quiet"], check=True)
    found = {}
    for row in csv.DictReader((folder / "intervals.csv").open()):
        times = tuple(float(row[name]) / stride for name in ("begin_frame", "end_frame"))
        found.setdefault((int(row["i"]), int(row["j"])), []).append(times)
    return found


FOLDER.mkdir(parents=True, exist_ok=True)
failures = count = 0
for stride, cutoff in ((1, 3.5), (1, 4.0), (8, 3.5), (64, 3.5)):
    ours, theirs = recompute(stride, cutoff), by_kds(stride, cutoff)
    for pair in ours.keys() | theirs.keys():
        one, other = numpy.array(ours.get(pair, [])), numpy.array(theirs.get(pair, []))
        count += len(one)
        if one.shape != other.shape or numpy.abs(one - other).max() > 1e-6:
            failures += 1
            print(f"FAILED: stride {stride}, cutoff {cutoff}, atoms {pair}: {other.tolist()} by kds, {one.tolist()} here")
print(f"{count} contacts, {failures} pairs differ")
sys.exit(1 if failures or not count else 0)
