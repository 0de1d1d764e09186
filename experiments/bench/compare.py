#!/usr/bin/env python3
"""Runs kds_bench, divides the times of kds by those of its peers, and checks the goals of goals.csv.

    experiments/bench/compare.py build/release/bin/kds_bench [SUBJECT]... [--only REGEX] [--rounds N]
    experiments/bench/compare.py PROGRAM SUBJECT... --machine NAME --load "what else the machine was doing"

With --machine, replaces the rows of the subjects in docs/measurements/NAME.csv. A missed goal is not an error.

A benchmark is named SUBJECT/INPUT/N/MEASURE. One named "MEASURE beside PEER" is the peer of that measure, or of all measures of
that input whose names start with MEASURE and which have no peer of their own. The rounds of all benchmarks of an input alternate
at random. Figures are medians of processor time.
"""
import argparse
import csv
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
COLUMNS = "name input n value unit peer peer_value ratio goal holds value_least value_most".split()
ORIGIN = "subject command version date load".split()


def run(program, group, options):
    """Returns the results of all rounds of a group of benchmarks, and what Google Benchmark says about the run."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "results.json")
        done = subprocess.run([program, "--benchmark_filter=^" + re.sub(r"([.()+])", r"\\\1", group) + "/",
                               "--benchmark_enable_random_interleaving=true", f"--benchmark_repetitions={options.rounds}",
                               f"--benchmark_min_time={options.min_time}", f"--benchmark_out={out}"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            sys.exit(f"compare.py: {group}: {done.stderr.strip()}")
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


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("program")
    parser.add_argument("subjects", nargs="*", help="certificates, engine, hierarchies, power, collision, impacts, readers")
    parser.add_argument("--only", default="", help="regular expression of SUBJECT/INPUT/N")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--min-time", type=float, default=0.1, help="least seconds of a round")
    parser.add_argument("--machine", help="name of the CSV file in docs/measurements")
    parser.add_argument("--load", default="")
    options = parser.parse_args()
    if options.machine and (options.only or not options.load or not options.subjects):
        parser.error("--machine takes subjects and --load, and not --only")
    if not os.access(options.program, os.X_OK):
        parser.error(f"{options.program}: expected the program kds_bench, which -DKDS_BENCHMARKS=ON builds")
    with open(os.path.join(HERE, "goals.csv"), encoding="utf-8") as file:
        goals = list(csv.DictReader(file))
    names = subprocess.run([os.path.abspath(options.program), "--benchmark_list_tests"], check=True, capture_output=True, text=True).stdout
    groups = dict.fromkeys("/".join(name.split("/")[:3]) for name in names.splitlines())
    groups = [g for g in groups if g.split("/")[0] in (options.subjects or g) and re.search(options.only, g)]
    if not groups:
        parser.error("no benchmark of these names")
    lines = []
    print(",".join(COLUMNS))
    writer = csv.DictWriter(sys.stdout, COLUMNS, restval="", lineterminator="\n")
    for group in groups:
        results, context = run(os.path.abspath(options.program), group, options)
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
