"""What does a simulation show that is followed at every step, beside the same run kept every 20 and 200 fs?

Measures contacts of water and of a peptide, their lives, and basis changes of the backbone, without storing frames. `number` is
that of contacts that begin, or of basis changes; `life` is the mean life (residence). `survival` is the share of contacts that
last 1 ps, and C the share that is there 1 ps later (--short: 0.1 ps). Means over seeds have Student's 95% interval.

By default nothing is simulated: the server of tests/live sends the run in data/trajectories (3 ps), and live figures must be
those of the file. --lammps DIR simulates the peptide in water (2,004 atoms, 20 ps in steps of 2 fs; Debian: lammps,
lammps-examples), which takes 4 to 8 minutes a seed and 90 MB in DIR. All measures follow one simulation at the same time.
"""

import contextlib
import itertools
import multiprocessing
import random
import shutil
import subprocess
import sys
import threading
import warnings
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import fits
import kds
import numpy as np
import spacing
from common import HERE, Report

sys.path.insert(0, str(HERE.parents[1] / "tests/live"))
import imd_server  # noqa: E402

STRIDES, PS, EXAMPLE = (1, 10, 100), 0.002, "/usr/share/lammps/examples/peptide/data.peptide"
WATER = {"select": "//*//O,OW", "groups": ("//*/(SOL)/OW", "//*//O"), "by": "bead", "apart": 1}
HEAVY = {"select": "//*/(!SOL)/[!H]", "by": "bead", "apart": 4}
MEASURES = {"water, 3.5": {"cutoff": 3.5, **WATER}, "water, 3.5:4.5": {"cutoff": (3.5, 4.5), **WATER},
            "heavy atoms, 4.5": {"cutoff": 4.5, **HEAVY}, "heavy atoms, 4.5:5": {"cutoff": (4.5, 5), **HEAVY},
            "basis changes": {"structures": ["wrapped"], "radius": 0.75, "strides": [1]}}
FIGURES = ("number", "life", "median", "survival", "C", "occupancy")
FOLLOWERS, SHORTER = len(MEASURES) + 1, "water, 3.5, a quarter"  # tells how memory grows with the run


def memory():
    """Returns the most memory that this process has used, in MB."""
    return int(Path("/proc/self/status").read_text("ascii").split("VmHWM:")[1].split()[0]) / 1000


def follow(name, source, given):
    """Returns the figures of a measure, a dictionary for each stride. `length` is the time in ps that the run has."""
    warnings.simplefilter("ignore", kds.InputWarning)
    options, before = {**MEASURES[name], **given}, memory()
    if name == "basis changes":
        rows = kds.compare(source, **options).json["rows"]
        return {int(row["stride"]): {"number": int(row["events"]), "length": row["steps"] * row["stride"] * PS} for row in rows}
    found = kds.contacts(source, strides=[1], threads=1, **options)
    lag = 1 if found.json["run_length"] > 1 else 0.1
    still = [step["survival"] for step in found.json["survival"] if step["length"] <= lag]
    ends = {name: value for name, value in found.over_time().items() if "residence_" in name and np.isfinite(value)}
    return {1: {"number": found.all["contacts"] - found.all["open_at_start"], "life": found.all["residence"],
                **ends, "median": found.all["median"], "survival": still[-1] if still else 1.0,
                "C": float(found.correlation([lag])["intermittent"][0]), "occupancy": found.all["occupancy"],
                "length": found.json["run_length"], "memory": memory() - before}}


def follow_all(addresses, given, length):
    """Follows a simulation with each measure, in a process and at an address of its own. Returns their figures."""
    jobs = {name: (name, {"strides": STRIDES} if name == "basis changes" else {}) for name in MEASURES}
    jobs[SHORTER] = ("water, 3.5", {"until": length / 4})
    with ProcessPoolExecutor(len(jobs), multiprocessing.get_context("spawn")) as pool:
        found = [pool.submit(follow, measure, address, {**given, **more})
                 for address, (measure, more) in zip(addresses, jobs.values(), strict=True)]
        return {name: one.result() for name, one in zip(jobs, found)}


def follow_files(sources):
    """Returns the figures of each measure by stride. `sources` has a file and its options for each stride."""
    return {name: {stride: follow(name, file, given)[1] for stride, (file, given) in sources.items()} for name in MEASURES}


def send(frames):
    """Sends frames to all followers. Returns their addresses."""
    listeners = [imd_server.listen() for _ in range(FOLLOWERS)]
    for listener in listeners:
        threading.Thread(target=imd_server.serve, args=(frames, listener, 3), daemon=True).start()
    return [f"imd://127.0.0.1:{listener.getsockname()[1]}" for listener in listeners]


@contextlib.contextmanager
def simulated(folder, seed, steps):
    """Simulates the peptide for all followers. Gives their addresses. Dumps are in the folder afterwards."""
    ports = random.sample(range(20000, 30000), FOLLOWERS)  # below those that the system gives to clients
    start = (HERE / "peptide_2fs.in").read_text("ascii").split("reset_timestep")[0]
    (folder / "live.in").write_text(start + (HERE / "peptide_live.in").read_text("ascii"), "ascii")
    given = {"seed": seed, "data": EXAMPLE, "steps": steps + 1, **{f"port{k}": port for k, port in enumerate(ports, 1)}}
    variables = [word for name, value in given.items() for word in ("-var", name, str(value))]
    process = subprocess.Popen(["lmp", "-in", "live.in", *variables], cwd=folder, stdout=subprocess.DEVNULL)
    try:
        yield [f"imd://127.0.0.1:{port}" for port in ports]
        if process.wait():
            raise SystemExit(f"lmp failed; {folder}/log.lammps says why")
    finally:
        process.kill()


def write_topology(path):
    """Writes the names of all atoms of the simulation: the peptide's of a file in data, and three of each water."""
    head, _, *lines, cell = (HERE.parents[1] / "data/trajectories/enkephalin_water.gro").read_text("ascii").splitlines()
    names = [line[:10] + name for line in lines for name in (("   OW", "  HW1", "  HW2") if "OW" in line else (line[10:15],))]
    atoms = [f"{name}{k:5d}{'   0.000' * 3}" for k, name in enumerate(names, 1)]
    path.write_text("\n".join([head, str(len(atoms)), *atoms, cell, ""]), "ascii")


def of_data(report):
    """Returns figures of the run in data, sent by the server and read from its file."""
    path, stop = report.data / "trajectories/peptide_2fs.trr.gz", 301 if report.short else 1501
    given, length = {"topology": path.with_name("peptide_2fs.gro")}, (stop - 1) * PS
    content = spacing.read_frames(path, 1)[:stop, -(9 + 6 * 76) * 4:]  # cell, positions and velocities of 76 atoms
    numbers = 10 * np.ascontiguousarray(content).view(">f4").reshape(stop, -1, 3)
    live = follow_all(send([(one[3:79], one[79:], one[:3]) for one in numbers]), given, length)
    return live, follow_files({stride: (path, {**given, "stop": stop, "step": stride}) for stride in STRIDES}), length


def of_simulation(folder, seed, steps):
    """Returns figures of a simulation, live and from its dumps."""
    write_topology(folder / "names.gro")
    given, length = {"topology": folder / "names.gro", "no_periodic": True}, steps * PS
    with simulated(folder, seed, steps) as addresses:
        live = follow_all(addresses, {**given, "dt": PS, "patience": 900}, length)
    dumps = {stride: (folder / f"{stride}.lammpstrj", {**given, "dt": PS * stride}) for stride in STRIDES[1:]}
    return live, follow_files(dumps), length


def claims(report, runs):
    """Adds claims that must hold in each run."""
    same = [np.isclose(live[name][stride][figure] or 0, value or 0, rtol=0 if figure == "number" else 1e-5, atol=0)
            for live, kept, _ in runs for name in MEASURES for stride, row in kept[name].items() if stride in live[name]
            for figure, value in row.items() if figure in FIGURES]  # a file may have more digits
    report.claim("kept", "figures of followers are those of kept frames", all(same), f"{sum(same)} of {len(same)}")
    missed = [round((length - live[name][1]["length"]) / PS) for live, _, length in runs for name in MEASURES]
    report.claim("steps", "every follower receives every step", not any(missed), f"{sum(missed)} missed")
    lost = [1 - kept[name][100]["number"] / live[name][1]["number"] for live, kept, _ in runs for name in MEASURES]
    report.claim("lost", "frames 200 fs apart lose a tenth of each number", min(lost) >= 0.1, f"{min(lost):.0%} at least")
    grown = [live["water, 3.5"][1]["memory"] - live[SHORTER][1]["memory"] for live, *_ in runs]
    report.claim("memory", "following four times as long takes at most 10 MB more", max(grown) <= 10, f"{max(grown):.1f} MB")


def main():
    report = Report(__doc__, lammps={"metavar": "DIR", "type": Path, "help": "simulate in this folder"},
                    seeds={"metavar": "N", "type": int, "choices": range(1, 21), "default": 5, "help": "simulations (default: 5)"})
    folder, runs, steps = report.given.lammps, [], 1000 if report.short else 10000
    if folder and not (shutil.which("lmp") and Path(EXAMPLE).exists() and folder.is_dir()):
        raise SystemExit(f"--lammps: needs lmp, {EXAMPLE} and the folder {folder}")
    for seed in range(1, report.given.seeds + 1 if folder else 2):
        runs.append(of_simulation(folder, 1237 * seed, steps) if folder else of_data(report))
        report.results["rows"] += [{"row": f"{seed}, {name}, {way}, {2 * stride} fs", **row}
                                   for way, measures in zip(("live", "kept"), runs[-1])
                                   for name, found in measures.items() for stride, row in found.items()]
    means = report.results["means"] = []
    for name, figure in [pair for pair in itertools.product(MEASURES, FIGURES) if pair[1] in runs[0][0][pair[0]][1]]:
        every = [(live[name][1][figure], kept[name][10][figure], kept[name][100][figure]) for live, kept, _ in runs]
        every = [(one[0], one[1] / one[0], one[2] / one[0]) for one in every if all(one)]  # a run may have no median
        means += [(f"{name}: {figure}", len(every), *sum(map(fits.mean_interval, zip(*every)), ()))] if every else []
    report.show(("mean", "runs", "live", "from", "to", "20 fs / live", "from", "to", "200 fs / live", "from", "to"), means)
    claims(report, runs)
    report.finish()


if __name__ == "__main__":
    main()
