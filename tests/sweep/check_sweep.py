#!/usr/bin/env python3
"""Checks kds sweep from outside: a sweep that is interrupted, killed, poisoned or run by another engine collects the
results of one undisturbed process.

usage: check_sweep.py PROGRAM DATA FOLDER CHECK
CHECK is kills, signals, faults, twice, parallel, snakemake, slurm or many. Exit code 77: an engine is not installed.
Environment variables set
  KDS_SWEEP_KILLS   the number of kills
  KDS_SWEEP_SEED    the seed of the moments of kills
  KDS_SWEEP_TASKS   the number of trivial tasks of `many`
  KDS_SWEEP_BUDGET  the seconds after which batches of Slurm stop and are requeued
"""

import collections
import csv
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

PROGRAM, DATA = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
FOLDER = pathlib.Path(sys.argv[3]).resolve() / sys.argv[4]
STABLE = ["results.csv", "results.json", "pooled.csv", "failed.csv", "warnings.csv"]
DEADLINE = 300  # seconds after which a step has failed


def fail(message):
    sys.exit(f"check_sweep.py {sys.argv[4]}: {message}")


def expect(condition, message):
    if not condition:
        fail(message)


def kds(*arguments, code=0, timeout=DEADLINE, **more):
    run = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=timeout, **more)
    expect(code is None or run.returncode == code,
           f"{arguments} gave {run.returncode}, expected {code}\n{run.stdout}{run.stderr}")
    return run


def start(*arguments):
    return subprocess.Popen([PROGRAM, "sweep", *map(str, arguments), "--quiet"], stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL)


def start_shards(sweep, folder):
    return [start(sweep, "-o", folder, "--jobs", 2, "--shard", f"{shard}/2") for shard in (1, 2)]


def write_sweep(name="sweep.json", strides=(1, 2, 3), radii=(1, 1.5), more=()):
    """Writes a sweep of short tasks over two small chains, and returns its path."""
    for seed in (1, 2):
        chain = FOLDER / f"chain{seed}.xyz"
        if not chain.exists():
            kds("generate", "random-chain", "--beads", 60, "--frames", 13, "--seed", seed, "-o", chain)
    sweep = {"inputs": ["chain*.xyz"],
             "commands": [{"command": "run",
                           "options": {"structures": ["wrapped", "power", "contacts"], "stride": list(strides),
                                       "motion": ["linear", "lifted"], "radius": list(radii)}},
                          {"command": "contacts", "options": {"cutoff": [4, 6, 8]}}, *more],
             "exclude": [{"structures": "[!p]*", "motion": "lifted"}]}
    (FOLDER / name).write_text(json.dumps(sweep))
    return FOLDER / name


def collected(folder, code=0):
    kds("sweep", "collect", folder, code=code)
    return {name: (folder / name).read_bytes() for name in STABLE}


def reference(sweep):
    folder = FOLDER / "reference"
    kds("sweep", sweep, "-o", folder, "--jobs", 1)
    return collected(folder)


def expect_equal(folder, expected):
    found = collected(folder)
    for name in STABLE:
        expect(found[name] == expected[name], f"{folder / name} differs from that of one process")


def records(folder):
    """Returns how often each task has a record of each kind."""
    counts = collections.defaultdict(collections.Counter)
    for journal in (folder / "results").iterdir():
        for line in journal.read_text(errors="replace").splitlines():
            words = line.split(" ", 3)
            if len(words) == 4:
                counts[words[1]][words[2]] += 1
    return counts


def kills():
    count = int(os.environ.get("KDS_SWEEP_KILLS", "4"))
    seed = int(os.environ.get("KDS_SWEEP_SEED", time.time()))
    print(f"{count} kills, KDS_SWEEP_SEED={seed}")
    chance = random.Random(seed)
    sweep = write_sweep(strides=(1, 2, 3, 4), radii=[1 + k / 1000 for k in range(2 + 4 * count)])
    expected = reference(sweep)
    folder = FOLDER / "killed"
    workers = start_shards(sweep, folder)
    killed = 0
    while killed < count and any(worker.poll() is None for worker in workers):
        time.sleep(chance.uniform(0.02, 0.2))
        victim = chance.randrange(2)
        if workers[victim].poll() is not None:
            continue
        workers[victim].kill()
        workers[victim].wait()
        killed += 1
        workers[victim] = start(sweep, "-o", folder, "--jobs", 2, "--shard", f"{victim + 1}/2")
    for worker in workers:
        worker.wait(DEADLINE)
    expect(killed >= max(2, count // 2), f"only {killed} of {count} kills met a running worker")
    print(f"{killed} workers were killed")
    # A task that ran during two kills counts as crashed.
    kds("sweep", sweep, "-o", folder, "--retry")
    expect_equal(folder, expected)


def signals():
    sweep = write_sweep(more=[{"command": "compare", "options": {"rounds": 1000}}])  # two endless tasks
    stops = (signal.SIGTERM, signal.SIGUSR1)
    workers = {number: start(sweep, "-o", FOLDER / f"stopped{number}", "--jobs", 2) for number in stops}
    while not all((FOLDER / f"stopped{number}" / "plan.json").exists() for number in stops):
        expect(all(worker.poll() is None for worker in workers.values()), "a worker ended before its signal")
        time.sleep(0.1)
    time.sleep(1)
    begin = time.time()
    workers[signal.SIGTERM].send_signal(signal.SIGTERM)
    while workers[signal.SIGUSR1].poll() is None and time.time() - begin < DEADLINE:
        workers[signal.SIGUSR1].send_signal(signal.SIGUSR1)  # again and again, until it has ended
        time.sleep(0.001)
    for number, worker in workers.items():
        code = worker.wait(DEADLINE)
        expect(code == 75, f"signal {number}: exit code {code}, expected 75")
        expect(time.time() - begin < 10, f"signal {number}: ended after {time.time() - begin:.1f} s, expected 10 at most")
    folder = FOLDER / f"stopped{signal.SIGTERM}"
    plain = write_sweep("plain.json")
    expected = reference(plain)
    kds("sweep", plain, "-o", folder)  # the folder of the stopped sweep continues without the endless tasks
    expect_equal(folder, expected)
    begin = time.time()
    kds("sweep", sweep, "-o", FOLDER / "budget", "--jobs", 2, "--time-budget", 4, code=75)
    seconds = time.time() - begin
    expect(seconds < 4 + 10, f"ended {seconds:.1f} s after a time budget of 4 s, expected 10 more at most")


def children_of(process):
    try:
        return pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()
    except OSError:
        return []


def faults():
    sweep = write_sweep(more=[{"command": "compare", "inputs": ["chain1.xyz"], "options": {"rounds": 1000}},
                              {"command": "run", "inputs": ["none.xyz"]}])
    expected = reference(write_sweep("plain.json"))
    folder = FOLDER / "faults"

    # Poison: a signal ends the one long task, whenever it runs.
    worker = start(sweep, "-o", folder, "--jobs", 2)
    since, shot, begin = {}, 0, time.time()
    while worker.poll() is None and time.time() - begin < DEADLINE:
        for child in children_of(worker.pid):
            if time.time() - since.setdefault(child, time.time()) > 2.5:
                os.kill(int(child), signal.SIGSEGV)
                since[child] = time.time() + DEADLINE
                shot += 1
        time.sleep(0.05)
    expect(worker.returncode == 1 and shot == 2, f"exit code {worker.returncode} after {shot} crashes, expected 1 after 2")
    with open(folder / "failed.csv") as table:
        rows = {row["command"]: row for row in csv.DictReader(table)}
    expect(rows["compare"]["status"] == "crashed" and "signal 11" in rows["compare"]["error"], rows)
    expect(rows["run"]["error"].endswith("none.xyz: no such file") and rows["run"]["code"] == "2", rows)
    again = subprocess.run(rows["run"]["repeat"].replace("kds", PROGRAM, 1), shell=True, capture_output=True, text=True)
    expect(again.returncode == 2 and "no such file" in again.stderr, "failed.csv does not repeat the failure")
    expect(len(rows) == 2, f"{len(rows)} failed tasks, expected 2")

    # Endless: the long task fails by --task-seconds.
    kds("sweep", sweep, "-o", folder, "--retry", "--task-seconds", 1, code=1)
    with open(folder / "failed.csv") as table:
        rows = {row["command"]: row for row in csv.DictReader(table)}
    expect("takes more than" in rows["compare"]["error"], rows)
    run = kds("sweep", write_sweep("plain.json"), "-o", folder)
    expect("differs from the sweep that this folder had" in run.stderr, run.stderr)
    expect_equal(folder, expected)

    # A full disk: nothing that was recorded is lost, and the same command continues.
    full = FOLDER / "full"

    def small_files():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (400_000, resource.RLIM_INFINITY))

    run = kds("sweep", FOLDER / "plain.json", "-o", full, code=None, preexec_fn=small_files)
    expect(run.returncode == 1 and "the disk is full" in run.stderr, f"{run.returncode} {run.stderr}")
    before = records(full)["done"]
    expect(0 < len(before) < 60, f"{len(before)} results on the full disk")
    kds("sweep", FOLDER / "plain.json", "-o", full)
    expect(all(records(full)["done"][task] == 1 for task in before), "a recorded result was computed again")
    expect_equal(full, expected)


def twice():
    sweep = write_sweep(strides=(1, 2, 3, 4, 6))
    expected = reference(sweep)
    folder = FOLDER / "shared"
    workers = start_shards(sweep, folder)
    refused = 0
    while any(worker.poll() is None for worker in workers):  # the second process of a shard is refused while the first runs
        other = kds("sweep", sweep, "-o", folder, "--shard", "1/2", code=None)
        refused += other.returncode == 75 and other.stderr.count("\n") == 1 and "runs in this folder already" in other.stderr
        expect(other.returncode in (0, 75), f"{other.returncode} {other.stderr}")
        time.sleep(0.05)
    for worker in workers:
        code = worker.wait(DEADLINE)
        refused += code == 75  # one of the others was first
        expect(code in (0, 75), "a shard beside another failed")
    expect(refused > 0, "no process was refused")
    kds("sweep", sweep, "-o", folder)
    done = records(folder)["done"]
    repeated = sum(count - 1 for count in done.values())
    print(f"{repeated} of {len(done)} tasks done twice, {refused} processes refused")
    expect(repeated == 0, f"{repeated} of {len(done)} tasks were done twice")
    expect_equal(folder, expected)


def write_script(engine, radii=(1, 1.5), more=()):
    sweep = write_sweep(radii=radii)
    expected = reference(sweep)
    folder = FOLDER / f"{engine}'s $HOME #x"  # names that shells and engines must not interpret
    run = kds("sweep", sweep, "-o", folder, "--write", engine, "--batches", 3, *more)
    return folder, expected, run.stdout.splitlines()[-1]


def parallel():
    if shutil.which("parallel") is None:
        sys.exit(77)
    folder, expected, command = write_script("parallel")
    subprocess.run(command, shell=True, check=True, timeout=DEADLINE, stdout=subprocess.DEVNULL)
    expect_equal(folder, expected)


def snakemake():
    if shutil.which("snakemake") is None:
        sys.exit(77)
    folder, expected, command = write_script("snakemake", more=["--task-memory", "128M"])
    subprocess.run(command, shell=True, check=True, timeout=DEADLINE, capture_output=True)
    expect_equal(folder, expected)


def slurm():
    if any(shutil.which(tool) is None and not pathlib.Path("/usr/sbin", tool).exists()
           for tool in ("slurmctld", "slurmd", "sbatch", "munged")) or os.geteuid() != 0:
        sys.exit(77)
    budget = os.environ.get("KDS_SWEEP_BUDGET")
    folder, expected, command = write_script("slurm", [1 + k / 10 for k in range(12 if budget else 2)],
                                            ["--task-memory", "128M", *(["--time-budget", budget] if budget else [])])
    cluster = pathlib.Path(__file__).parent / "local_slurm.sh"
    place = FOLDER / "cluster"
    environment = dict(os.environ, SLURM_CONF=str(place / "slurm.conf"))
    up = subprocess.run([cluster, "up", place], timeout=60, capture_output=True, text=True)
    if up.returncode != 0:
        print(f"skipped: Slurm does not start on this machine: {up.stderr.strip()}")
        sys.exit(77)
    try:
        subprocess.run(command, shell=True, check=True, timeout=60, env=environment, stdout=subprocess.DEVNULL)
        begin = time.time()
        while subprocess.run(["squeue", "-h"], capture_output=True, text=True, env=environment).stdout.strip():
            expect(time.time() - begin < DEADLINE, "the queue is not empty")
            time.sleep(0.2)
        log = folder / "slurm-collect.out"
        expect(log.exists() and "tasks have results" in log.read_text(), "the dependent job did not collect")
        expect(all((folder / name).read_bytes() == expected[name] for name in STABLE),
               "what the dependent job collected differs from that of one process")
        shares = [text for text in (path.read_text() for path in folder.glob("slurm-*_*.out")) if "of the shard" in text]
        print(f"{sum(text.count('stopped before the end') for text in shares)} batches were requeued")
        expect(len(shares) == 3, f"{len(shares)} batches reported, expected 3")
        jobs = subprocess.run(["scontrol", "show", "job", "-o"], capture_output=True, text=True, env=environment).stdout
        memory = re.findall("MinMemoryNode=([^ ]*)", jobs)
        expect(memory == ["257M"] * 4, f"jobs were given the memory {memory}, expected 128 + 128 + 1 MiB each")
    finally:
        subprocess.run([cluster, "down", place], check=True, timeout=60)
    expect_equal(folder, expected)


def many():
    """Prints the processor time and the elapsed time of trivial tasks."""
    count = int(os.environ.get("KDS_SWEEP_TASKS", "200"))
    radii = [f"{1 + k / count}" for k in range(count)]
    (FOLDER / "many.json").write_text(json.dumps(
        {"inputs": ["none.xyz"], "commands": [{"command": "info", "options": {"radius": radii}}]}))
    begin = time.time()
    kds("sweep", FOLDER / "many.json", "-o", FOLDER / "many", code=1, timeout=DEADLINE + count / 50)
    seconds = time.time() - begin
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = used.ru_utime + used.ru_stime
    print(f"{count} tasks: {1000 * seconds / count:.2f} ms each, {1000 * processor / count:.2f} ms of processor time")
    with open(FOLDER / "many" / "failed.csv") as table:
        expect(sum(1 for _ in csv.DictReader(table)) == count, "failed.csv misses tasks")


shutil.rmtree(FOLDER, ignore_errors=True)
FOLDER.mkdir(parents=True)
globals()[sys.argv[4]]()
shutil.rmtree(FOLDER, ignore_errors=True)
