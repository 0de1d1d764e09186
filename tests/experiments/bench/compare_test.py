#!/usr/bin/env python3
"""Tests how experiments/bench/compare.py finds benchmarks that became slower, on times whose truth is known.

Usage: compare_test.py FOLDER. The folder is for programs that stand in for kds_bench and make their times up.
"""
import itertools
import math
import random
import subprocess
import sys
import unittest
from pathlib import Path

BENCH = Path(__file__).resolve().parents[3] / "experiments" / "bench"
sys.path.insert(0, str(BENCH))
import compare  # noqa: E402

PROGRAM = """#!{python}
import json, random, re, sys
times = {times}
if "--benchmark_list_tests" in sys.argv:
    sys.exit(print("\\n".join(times)))
options = dict(one.split("=", 1) for one in sys.argv[1:])
if re.search(r"\\\\[]}}]", options["--benchmark_filter"]):
    sys.exit("invalid escape")  # as Google Benchmark says
chosen = [name for name in times if re.search(options["--benchmark_filter"], name)]
results = [dict(name=name, run_type="iteration", label="ns/bead", cpu_time=random.uniform(1, 1.02) * times[name])
           for name in chosen]
with open(options["--benchmark_out"], "w") as file:
    json.dump(dict(benchmarks=results, context={{}}), file)
"""


def noisy_pairs(slower, rounds, generator):
    """Returns pairs of times. `slower` has the true ratio of each benchmark. The noise is that of a shared machine: the speed
    drifts, some rounds take twice as long, and whichever program runs second takes 3% longer."""
    pairs = [[] for _ in slower]
    for t in range(rounds):
        for one, ratio in zip(pairs, slower):
            spike = [2 if generator.random() < 0.05 else 1 for _ in range(2)]
            times = [math.exp(0.3 * math.sin(t) + generator.gauss(0, 0.01)) * one for one in spike]
            times[1] *= 1.03
            generator.shuffle(times)
            one.append((times[0], times[1] * ratio))
    return dict(enumerate(pairs))


class FindDifferences(unittest.TestCase):
    def test_p_values_are_those_of_all_signs(self):
        for n in range(11):
            sums = [sum(signs) for signs in itertools.product([-1, 1], repeat=n)]
            for slower in range(n + 1):
                as_far = sum(abs(one) >= abs(2 * slower - n) for one in sums) / len(sums)
                self.assertAlmostEqual(compare.sign_test(slower, n - slower), as_far)

    def test_equal_programs_seldom_differ(self):
        generator = random.Random(2)
        comparisons = [noisy_pairs([1] * 15, 13, generator) for _ in range(200)]
        self.assertLessEqual(sum(bool(compare.find_differences(one)) for one in comparisons), 19)  # 5% and three standard deviations
        self.assertGreater(sum(bool(compare.find_differences(one, alarm=0.5)) for one in comparisons), 40)  # the noise does matter

    def test_a_slower_benchmark_is_found(self):
        generator = random.Random(3)
        rounds = compare.needed_rounds(15, exceptions=2)
        found = [compare.find_differences(noisy_pairs([1] * 14 + [1.1], rounds, generator)) for _ in range(100)]
        self.assertGreater(sum(14 in one for one in found), 90)
        self.assertLess(sum(set(one) - {14} != set() for one in found), 12)

    def test_rounds_are_as_few_as_can_be(self):
        for benchmarks, exceptions in itertools.product((1, 15, 300), (0, 2)):
            for fewer in (0, 1):
                rounds = compare.needed_rounds(benchmarks, exceptions) - fewer
                pairs = {one: [(1, 1)] * rounds for one in range(benchmarks)}
                pairs[0] = [(1, 1.1)] * (rounds - exceptions) + [(1, 0.9)] * exceptions
                self.assertEqual(list(compare.find_differences(pairs)), [] if fewer else [0])


class Programs(unittest.TestCase):
    BASE = {"engine/a (1 + 2)/3/run": 100, "engine/a (1 + 2)/3/run beside peer": 9,
            "power/[b]/4/run": 50, "power/[b]/4/walk": 7}

    def compare(self, changes, *arguments):
        paths = []
        for name, times in ("base", self.BASE), ("other", {**self.BASE, **changes}):
            paths.append(Path(sys.argv[1]) / name)
            paths[-1].write_text(PROGRAM.format(python=sys.executable, times=times))
            paths[-1].chmod(0o755)
        return subprocess.run([sys.executable, BENCH / "compare.py", paths[1], "--base", paths[0], *arguments],
                              capture_output=True, text=True, check=False)

    def test_a_slower_program_fails(self):
        done = self.compare({"power/[b]/4/run": 55, "engine/a (1 + 2)/3/run beside peer": 200, "power/[b]/4/new": 1})
        self.assertEqual(done.returncode, 1)
        rows = done.stdout.splitlines()
        self.assertRegex(rows[1], r"^ 1\.[01]\d\d +5\d\.\d+ +5\d\.\d+ ns/bead +\S+ +power/\[b\]/4/run$")
        self.assertRegex(rows[-1], "^[1-3] of 3 benchmarks differ in 14 rounds")  # a false alarm is possible
        self.assertEqual(done.stderr, "compare.py: only one program has these benchmarks: power/[b]/4/new\n")

    def test_a_faster_program_does_not(self):
        done = self.compare({"power/[b]/4/run": 40, "power/[b]/4/walk": 5}, "power", "--only", "b")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"\n 0\.[78]\d\d .*/4/run\n 0\.[67]\d\d .*/4/walk\n2 of 2 ")

    def test_too_few_rounds_are_refused(self):
        done = self.compare({}, "--rounds", "6")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--rounds: 3 benchmarks need at least 7 rounds", done.stderr)


if __name__ == "__main__":
    Path(sys.argv[1]).mkdir(parents=True, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
