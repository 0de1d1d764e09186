#!/usr/bin/env python3
"""Runs kds_bench, divides the times of kds by those of its peers, and checks the goals of goals.csv.

    experiments/bench/compare.py build/release/bin/kds_bench [SUBJECT]... [--only REGEX] [--rounds N]
    experiments/bench/compare.py PROGRAM SUBJECT... --machine NAME --load "what else the machine was doing"
    experiments/bench/compare.py PROGRAM [SUBJECT]... --base PROGRAM

With --machine, replaces the rows of the subjects in docs/measurements/NAME.csv. A missed goal is not an error.

With --base, compares the program with another build of it, without peers, and prints the benchmarks whose times differ. If both
are equally fast, a comparison prints any benchmark with a probability of at most 5%. The exit code is 1 if one became slower.

A benchmark is named SUBJECT/INPUT/N/MEASURE. One named "MEASURE beside PEER" is the peer of that measure, or of all measures of
that input whose names start with MEASURE and which have no peer of their own. The rounds of all benchmarks of an input
alternate at random. Figures are medians of processor time.
"""
import argparse
import csv
import itertools
import json
import math
import os
import random
import re
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
COLUMNS = "name input n value unit peer peer_value ratio goal holds value_least value_most".split()
ORIGIN = "subject command version date load".split()
ALARM = 0.05  # the probability that a comparison of equal programs finds a difference


def matching(text):
    """Returns an extended regular expression of POSIX that matches the text."""
    return re.sub(r"([.()\[+*?{|^$\\])", r"\\\1", text)  # `\]` and `\}` are not escapes


def run(program, chosen, rounds, min_time):
    """Returns the results of all rounds of the benchmarks whose names match, and what Google Benchmark says about the run."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "results.json")
        done = subprocess.run([program, f"--benchmark_filter=^{chosen}",
                               "--benchmark_enable_random_interleaving=true", f"--benchmark_repetitions={rounds}",
                               f"--benchmark_min_time={min_time}", f"--benchmark_out={out}"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            print(f"compare.py: {chosen}: {done.stderr.strip()}", file=sys.stderr)
            sys.exit(2)
        with open(out, encoding="utf-8") as file:
            result = json.load(file)
    return [b for b in result["benchmarks"] if b["run_type"] == "iteration"], result["context"]


class Measure:
    """All rounds of one benchmark: nanoseconds of a call, and how many items a call processes."""

    def __init__(self, rounds):
        manual = rounds[0]["name"].endswith("/manual_time")
        self.calls = [one["real_time" if manual else "cpu_time"] for one in rounds]
        speed = rounds[0].get("items_per_second")
        self.items = round(speed * self.calls[0] / 1e9) if speed else None
        self.unit = rounds[0]["label"]
        self.ratios = {key: value for key, value in rounds[0].items() if key.startswith(("wrapped events", "false "))}

    def time(self, choose=statistics.median, items=True):
        return choose(self.calls) / (self.items if items and self.items else 1)


def row(name, measure, peer, other, items=True):
    ours = measure.time(items=items)
    theirs = other.time(items=items) if other else ""
    return {"name": name, "value": ours, "unit": measure.unit, "peer": peer, "peer_value": theirs,
            "ratio": ours / theirs if other else "", "value_least": measure.time(min, items),
            "value_most": measure.time(max, items)}


def rows_of(measures):
    """Returns the rows of one input."""
    peers = [(*name.rsplit("beside ", 1), m) for name, m in measures.items() if "beside " in name]
    ours = {name: m for name, m in measures.items() if "beside " not in name}
    rows = []
    for name, measure in ours.items():
        own = [(peer, m) for start, peer, m in peers if start.strip() == name]
        beside = own or [(peer, m) for start, peer, m in peers if name.startswith(start.strip())]
        if beside and measure.items and beside[0][1].items is None:  # a run of events, beside one static build
            rows.append(row(name + ", an event", measure, "", None))
            rows.append(row(name + ", a run", measure, *beside[0], items=False))
        else:
            rows += [row(name, measure, *one) for one in beside] or [row(name, measure, "", None)]
        for one in (measure, *(other for _, other in beside)):
            rows += [{"name": key, "value": value, "ratio": value} for key, value in one.ratios.items()]
        if name == "auto to rebuild":
            best = min([*[(other, m) for other, m in ours.items() if other != name], *beside],
                       key=lambda one: one[1].time())
            rows.append(row("auto to best", measure, *best))
    return rows


def check(subject, one, goals):
    text = f"{one['name']} on {one['input']} ({one['n']}) beside {one.get('peer', '')}"
    for goal in goals:
        if goal["subject"] == subject and re.search(goal["row"], text):
            measured = one["value"] if goal["of"] == "time" else one.get("ratio")
            if measured not in (None, ""):
                return goal["largest"], "true" if measured <= float(goal["largest"]) else "false"
    return "", ""


def sign_test(slower, faster):
    """Returns the two-sided p-value of the sign test for the numbers of rounds in which the other program is slower and faster.
    The value is exact if each program is equally likely to be slower in a round, whatever the noise."""
    rounds = slower + faster
    return min(1, 2 * sum(math.comb(rounds, i) for i in range(min(slower, faster) + 1)) / 2**rounds)


def find_differences(pairs, alarm=ALARM):
    """Takes pairs of times of each benchmark, and returns the p-values of those that differ. If none differs, the result is
    empty with probability 1 - alarm at least (Holm's correction)."""
    values = sorted((sign_test(sum(base < other for base, other in times), sum(base > other for base, other in times)), name)
                    for name, times in pairs.items())
    differing = {}
    for before, (value, name) in enumerate(values):
        if value > alarm / (len(values) - before):
            break
        differing[name] = value
    return differing


def needed_rounds(benchmarks, exceptions):
    """Returns how many rounds find one slower benchmark among so many, if it is faster in some exceptional rounds."""
    return next(n for n in itertools.count(2 * exceptions + 1) if sign_test(n - exceptions, exceptions) <= ALARM / benchmarks)


def measure_pairs(programs, groups, rounds, min_time):
    """Returns the times of both programs in each round, and the unit of each benchmark. The order of the
    programs is random in each round, so both signs of a difference are equally likely for equal programs, even if the machine
    becomes slower meanwhile."""
    pairs = {name: [] for names in groups.values() for name in names}
    units = {}
    for _ in range(rounds):
        for names in random.sample(list(groups.values()), len(groups)):
            chosen = "(" + "|".join(map(matching, names)) + ")$"
            times = {}
            for which in random.sample((0, 1), 2):
                for one in run(programs[which], chosen, 1, min_time)[0]:
                    measure = Measure([one])
                    times[which, one["name"]] = measure.time()
                    units[one["name"]] = measure.unit
            for name in names:
                pairs[name].append((times[0, name], times[1, name]))
    return pairs, units


def print_differences(pairs, units, rounds):
    """Prints the benchmarks that differ, slowest first, and returns whether one became slower."""
    differing = find_differences(pairs)
    rows = [(statistics.median(other / base for base, other in pairs[name]), name) for name in differing]
    print(f"{'ratio':>6} {'base':>10} {'other':>10} {'unit':12} {'p':8} benchmark")
    for ratio, name in sorted(rows, reverse=True):
        base, other = map(statistics.median, zip(*pairs[name]))
        print(f"{ratio:6.3f} {base:10.4g} {other:10.4g} {units[name]:12} {differing[name]:<8.1g} {name}")
    print(f"{len(differing)} of {len(pairs)} benchmarks differ in {rounds} rounds; false alarms in {ALARM:.0%} of runs at most")
    return any(ratio > 1 for ratio, _ in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("program")
    parser.add_argument("subjects", nargs="*", help="certificates, engine, hierarchies, power, collision, impacts, readers")
    parser.add_argument("--only", default="", help="regular expression of SUBJECT/INPUT/N")
    parser.add_argument("--rounds", type=int, help="default: 5; with --base as many as the number of benchmarks needs")
    parser.add_argument("--min-time", type=float, default=0.1, help="least seconds of a round")
    parser.add_argument("--base", metavar="PROGRAM", help="another build, which the program is compared with")
    parser.add_argument("--machine", help="name of the CSV file in docs/measurements")
    parser.add_argument("--load", default="")
    options = parser.parse_intermixed_args()
    if options.machine and (options.only or not options.load or not options.subjects):
        parser.error("--machine takes subjects and --load, and not --only")
    if options.machine and options.base:
        parser.error("--machine does not go with --base")
    programs = [os.path.abspath(program) for program in (options.base, options.program) if program]
    for program in programs:
        if not os.access(program, os.X_OK) or os.path.isdir(program):
            parser.error(f"{program}: expected the program kds_bench, which -DKDS_BENCHMARKS=ON builds")
    with open(os.path.join(HERE, "goals.csv"), encoding="utf-8") as file:
        goals = list(csv.DictReader(file))
    listed = []
    for program in programs:
        done = subprocess.run([program, "--benchmark_list_tests"], capture_output=True, text=True)
        if done.returncode != 0 or not done.stdout:
            parser.error(f"{program}: lists no benchmarks; expected the program kds_bench")
        names = done.stdout
        listed.append([name for name in names.splitlines() if name.split("/")[0] in (options.subjects or name)
                       and re.search(options.only, "/".join(name.split("/")[:3])) and not (options.base and "beside " in name)])
    groups = {}
    for name in filter(set(listed[0]).__contains__, listed[-1]):
        groups.setdefault("/".join(name.split("/")[:3]), []).append(name)
    if not groups:
        parser.error("no benchmark of these names")
    if options.base:
        alone = set(listed[0]) ^ set(listed[1])
        if alone:
            print(f"compare.py: only one program has these benchmarks: {', '.join(sorted(alone))}", file=sys.stderr)
        count = sum(map(len, groups.values()))
        rounds = options.rounds or needed_rounds(count, exceptions=2)
        if rounds < needed_rounds(count, 0):
            parser.error(f"--rounds: {count} benchmarks need at least {needed_rounds(count, 0)} rounds")
        sys.exit(int(print_differences(*measure_pairs(programs, groups, rounds, options.min_time), rounds)))
    lines = []
    print(",".join(COLUMNS))
    writer = csv.DictWriter(sys.stdout, COLUMNS, restval="", lineterminator="\n")
    for group in groups:
        results, context = run(programs[-1], matching(group) + "/", options.rounds or 5, options.min_time)
        rounds = {}
        for one in results:
            rounds.setdefault(one["name"].removesuffix("/manual_time").split("/", 3)[3], []).append(one)
        subject, points, n = group.split("/")
        for one in rows_of({name: Measure(of_name) for name, of_name in rounds.items()}):
            one.update(input=points, n=n)
            one["goal"], one["holds"] = check(subject, one, goals)
            writer.writerow(one)
            lines.append({"subject": subject, "command": "kds_bench", "version": context["version"],
                          "date": context["date"][:10], "load": options.load, **one})
    if options.machine:
        path = os.path.join(HERE, "../../docs/measurements", options.machine + ".csv")
        kept = []
        if os.path.exists(path):
            with open(path, encoding="utf-8", newline="") as file:
                kept = [line for line in csv.DictReader(file) if line["subject"] not in options.subjects]
        with open(path, "w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, ORIGIN + COLUMNS, restval="", lineterminator="\n")
            writer.writeheader()
            writer.writerows(kept + lines)


if __name__ == "__main__":
    main()
