"""Below which spacing of frames do counts stop changing?

Reads runs of molecular dynamics that were written at every step of 2 fs, and then every 2nd, 4th, 8th frame and so on. Counts
contacts, basis changes and flips on paths between these frames: straight ones (linear), and Hermite cubics with velocities from
differences of frames (differences) or with those of the simulation (velocities). Each value is divided by that of cubics from
differences at 2 fs in the same run. Means over runs have Student's 95% interval. `least runs` says how many runs have a value.
`missed` is the share of contacts that contain no frame, of those of straight paths at 2 fs. Exponents say how fast a number
falls with the spacing: it is a power law if they are equal in all ranges.

By default reads the run in data/trajectories, 3 ps of a peptide in water; a single run has no interval. simulate.py makes more
and longer runs; --runs takes them in a minute each.
"""

import csv
import gzip
import tempfile
import warnings
from pathlib import Path

import fits
import kds
import numpy as np
from common import HERE, Report, save, subplots

STRIDES = [2**k for k in range(10)]
RANGES = (8, 32), (32, 128), (128, 512)  # strides between which exponents are measured
MOTIONS = {"linear": {"motion": "linear"}, "differences": {"motion": "hermite", "velocities": "differences"},
           "velocities": {"motion": "hermite", "velocities": "file"}}
WATER = {"select": "//*", "groups": ("//*/(SOL)/OW", "//*//O"), "by": "bead", "apart": 1}
BACKBONE = {"backbone, 4.5": {"cutoff": 4.5, "by": "bead", "apart": 4}}
CONTACTS = {"peptide": {"water, 3.5": {"cutoff": 3.5, **WATER}, "water, 3.5:4.5": {"cutoff": (3.5, 4.5), **WATER}, **BACKBONE},
            "villin": {"C-alpha, 8": {"cutoff": 8, "select": "ca"}, **BACKBONE}}
STRUCTURES = {"wrapped": "basis changes", "power": "flips"}
LINES = {"linear": ("-", "straight paths"), "differences": ("--", "cubics, velocities from differences"),
         "velocities": (":", "cubics, velocities of the simulation")}
COLORS = {"water, 3.5": "#2f6ea5", "water, 3.5:4.5": "#8fb8de", "C-alpha, 8": "#1f2933", "backbone, 4.5": "#c98a1b",
          "basis changes": "#b3462f", "flips": "#3b8a5a"}


def missed(intervals, stride):
    """Returns the share of the intervals in frames that contain no multiple of the stride."""
    return float(np.mean(np.ceil(intervals["begin_frame"] / stride) * stride > intervals["end_frame"]))


def read_frames(path, longest):
    """Returns the bytes of each frame of a TRR file, up to the last multiple of `longest`. All frames must have equal size."""
    with (gzip.open if path.suffix == ".gz" else open)(path, "rb") as file:
        content = file.read()
    frames = np.frombuffer(content, np.uint8).reshape(-1, content.find(content[:24], 24))  # a frame starts with a magic word
    return frames[:(len(frames) - 1) // longest * longest + 1]


def measure(frames, topology, system, strides, folder):
    """Yields measure, motion, stride and value of one run, over the same time at all strides. Writes to `folder`."""
    for stride in strides:
        frames[::stride].tofile(file := Path(folder, "part.trr"))
        for motion, options in MOTIONS.items():
            given = {"topology": topology, **options}
            for name, contacts in CONTACTS[system].items():
                found = kds.contacts(file, strides=[1], **given, **contacts)
                yield name, motion, stride, found.all["contacts"] - found.all["open_at_start"]
                yield f"{name}: mean life", motion, stride, found.all["residence"]
                yield f"{name}: median life", motion, stride, found.all["median"]
                if motion == "linear" and stride == 1:
                    for step in strides:
                        yield f"{name}: missed", "frames", step, missed(found.intervals, step)
            run = kds.run(file, structures=list(STRUCTURES), **given)
            for structure, name in STRUCTURES.items():
                yield name, motion, stride, len(getattr(run, structure).events)


def exponents(values):
    """Returns the slopes of minus the logarithms of values at STRIDES over RANGES; None where a value is 0."""
    at = dict(zip(STRIDES, values))
    return [float(np.log(at[first] / at[last]) / np.log(last / first)) if at[first] and at[last] else None
            for first, last in RANGES]


def coverage(rounds, runs=5, frames=9729):
    """Returns the shares of samples in which the interval of a ratio (at each stride) or exponent (in each range) contains the
    true one, of those with an interval. A sample has the upcrossings of 0 by Gaussian processes, whose expected number at each
    stride is known (Rice): slow motion and a vibration of 50 fs."""
    random, size = np.random.default_rng(1), 16384
    lags = np.minimum(np.arange(size), size - np.arange(size)) * 0.002  # ps
    correlation = 0.9 * np.exp(-(lags / 0.3)**2 / 2) + 0.1 * np.exp(-(lags / 0.1)**2) * np.cos(2 * np.pi * lags / 0.05)
    shape = np.sqrt(np.maximum(np.fft.rfft(correlation).real, 0) * size)
    expected = np.array([np.arccos(correlation[stride]) / stride for stride in STRIDES])
    truth, hits = [*expected[1:] / expected[0], *exponents(expected)], []
    for _ in range(rounds):
        noise = random.normal(size=(2, runs, len(shape))) / np.sqrt(2)
        above = np.fft.irfft((noise[0] + 1j * noise[1]) * shape, size)[:, :frames] > 0
        counts = np.array([(~above[:, :-1:stride] & above[:, stride::stride]).sum(1) for stride in STRIDES])
        found = [*counts[1:] / counts[0], *zip(*(exponents(run) for run in counts.T))]
        intervals = map(fits.mean_interval, found)
        hits.append([np.nan if low is None else low <= true <= high for true, (_, low, high) in zip(truth, intervals)])
    return np.nanmean(hits, axis=0)


def draw(table, picture):
    """Draws the numbers in a CSV file of --csv, one panel for each system."""
    with open(table, newline="", encoding="utf-8") as file:
        lines = {}
        for row in csv.DictReader(file):
            if row["motion"] in LINES and "life" not in row["measure"]:
                lines.setdefault(row["system"], {}).setdefault(row["measure"], {}).setdefault(row["motion"], []).append(row)
    size = {"figsize": (5 * len(lines), 4.2), "layout": "constrained"}
    figure, panels = subplots(1, len(lines), squeeze=False, sharey=True, **size)
    for axes, (system, measures) in zip(panels[0], lines.items()):
        for name, motions in measures.items():
            for motion, rows in motions.items():
                x, y, low, high = ([float(row[key] or row["mean"]) for row in rows] for key in ("fs", "mean", "from", "to"))
                axes.plot(x, y, LINES[motion][0], color=COLORS[name], linewidth=1.2, label=name if motion == "linear" else None)
                axes.fill_between(x, low, high, color=COLORS[name], alpha=0.15, linewidth=0)
        axes.set(xscale="log", xticks=x, xticklabels=[f"{one:.0f}" for one in x], ylim=(0, 1.37), title=system,
                 xlabel="frames apart (fs)")
        axes.minorticks_off()
        axes.legend(frameon=False, loc="lower left")
    motions = [axes.plot([], [], line, color="#9aa5b1", label=words)[0] for line, words in LINES.values()]
    axes.add_artist(axes.get_legend())  # the last panel has two
    axes.legend(handles=motions, frameon=False, loc="upper right")
    panels[0][0].set_ylabel("number / number of cubics at 2 fs")
    save(figure, picture)


def draw_all(folder):
    draw(HERE / "spacing.csv", f"{folder}/spacing.svg")


def mean_of(values):
    """Returns how many runs have a value, and their mean with its interval."""
    known = [value for value in values if value is not None]
    return len(known), *(fits.mean_interval(known) if known else (None,) * 3)


def main():
    warnings.simplefilter("ignore", kds.InputWarning)  # waters are not bonded to beads, caps have no C-alpha
    report = Report(__doc__, runs={"metavar": "DIR", "type": Path, "help": "folder of runs (default: the run in data)"},
                    fs={"metavar": "FS", "type": float, "default": 2.0, "help": "spacing of frames of the runs (default: 2)"},
                    csv={"metavar": "FILE", "help": "write the means over runs to FILE"})
    fs = int(report.given.fs) if report.given.fs.is_integer() else report.given.fs
    folder = report.given.runs or report.data / "trajectories"
    paths = sorted(path for system in CONTACTS for path in folder.glob(f"{system}[-_]*.trr*"))
    if not paths:
        raise SystemExit(f"--runs: {folder} has no runs, which simulate.py makes")
    strides, found, rates = STRIDES[::3] if report.short else STRIDES, {}, {}
    spacings = [fs * stride for stride in strides]
    for path in paths:
        system, values = next(system for system in CONTACTS if path.name.startswith(system)), {}
        frames, name = read_frames(path, strides[-1]), path.name.split(".")[0]
        time = (len(frames) - 1) * fs / 1000  # ps
        with tempfile.TemporaryDirectory() as part:
            for *key, stride, value in measure(frames, path.with_name(name + ".gro"), system, strides, part):
                values.setdefault(tuple(key), {})[f"fs_{fs * stride}"] = value
        for (measured, motion), row in values.items():
            report.results["rows"].append({"row": f"{name}, {measured}, {motion}", **row})
            scale = 1 if motion == "frames" else values[measured, "differences"][f"fs_{fs}"]
            found.setdefault((system, measured, motion), []).append(
                [value / scale if value is not None and scale else None for value in row.values()])
            if ": " not in measured:
                rates.setdefault((system, measured, motion), []).append([value / time for value in row.values()])
    report.results["means"] = means = []
    for key, runs in found.items():
        for k, spacing in enumerate(spacings):
            rate = float(np.mean([run[k] for run in rates[key]])) if key in rates else None
            means.append((*key, spacing, rate, *mean_of([run[k] for run in runs])))
    report.show((f"by cubics at {fs} fs", "per ps", "least runs", *(f"{spacing} fs" for spacing in spacings)), [
        (", ".join(key), rows[0][4], min(row[5] for row in rows), *(row[6] for row in rows))
        for key in found if (rows := [row for row in means if row[:3] == key])])
    if not report.short:
        report.results["exponents"] = rows = [
            (*key, *(fs * stride for stride in ends), *mean_of(values)) for key, runs in found.items() if key in rates
            for ends, values in zip(RANGES, zip(*map(exponents, runs)))]
        report.show(("number falls", "from fs", "to fs", "runs", "exponent", "95% from", "to"),
                    [(", ".join(row[:3]), *row[3:]) for row in rows])
    if report.given.csv:
        with open(report.given.csv, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(("system", "measure", "motion", "fs", "number_per_ps", "runs", "mean", "from", "to"))
            writer.writerows([*row[:4], *("" if value is None else f"{value:.5g}" for value in row[4:])] for row in means)
    shares = coverage(rounds := 200 if report.short else 400)
    report.claim("intervals", "intervals of 5 runs contain the true ratio or exponent in 90 to 99% of generated samples",
                 min(shares) >= 0.9 and max(shares) <= 0.99, f"{min(shares):.1%} to {max(shares):.1%} of {rounds}")
    report.finish()


if __name__ == "__main__":
    main()
