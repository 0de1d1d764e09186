"""Correlation functions of contacts, and intervals from stretches of a run and from replicas."""

import itertools
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np

import kds
from data import DCD, PDB, coil, program
from kds._lifetimes import Timeline, pooled_survival, ratio, student_95, survival_at

sys.path.append(str(Path(__file__).resolve().parents[2] / "experiments" / "paper"))


def wandering(frames=40, beads=8, seed=1):
    return np.random.default_rng(seed).normal(size=(frames, beads, 3)).cumsum(axis=0)


def states(positions, cutoff, samples):
    """Returns whether each pair is in contact at `samples` times in each step, (times, pairs)."""
    shares = np.arange(samples)[:, None, None] / samples
    paths = np.concatenate([before + shares * (after - before) for before, after in zip(positions, positions[1:])])
    pairs = itertools.combinations(range(positions.shape[1]), 2)
    return np.stack([np.linalg.norm(paths[:, i] - paths[:, j], axis=1) <= cutoff for i, j in pairs], axis=1)


class Correlation(unittest.TestCase):
    def test_it_is_that_of_samples(self):
        positions, samples = wandering(), 256
        found = kds.contacts(positions, cutoff=5, by="bead", apart=1)
        now = states(positions, 5, samples)
        table = found.correlation([0, 0.25, 1, 2.5, 10])
        for k, lag in enumerate(table["lag"]):
            ahead = int(lag * samples)
            earlier, later = (now, now) if ahead == 0 else (now[:-ahead], now[ahead:])
            self.assertAlmostEqual(table["intermittent"][k], (earlier & later).sum() / earlier.sum(), delta=0.01)
            changes = np.concatenate([np.zeros((1, now.shape[1]), int), np.cumsum(now[1:] != now[:-1], axis=0)])
            throughout = earlier & (changes[ahead:] == changes[:len(changes) - ahead])
            self.assertAlmostEqual(table["continuous"][k], throughout.sum() / earlier.sum(), delta=0.01)
        self.assertAlmostEqual(table["intermittent"][0], 1)
        self.assertTrue(np.isnan(table["intermittent_lower"][0]))
        upper = found.correlation([10, 19.4, 19.6, 30])["intermittent_upper"]
        self.assertEqual(np.isfinite(upper).tolist(), [True, True, False, False])

    def test_times_and_frames_agree(self):
        options = {"topology": PDB, "select": "ca", "cutoff": 8, "start": 30, "stop": 150, "step": 3}
        in_frames, in_ps = kds.contacts(DCD, **options), kds.contacts(DCD, dt=0.02, **options)
        one, other = in_frames.correlation([3, 30]), in_ps.correlation([0.06, 0.6])
        for name in ("intermittent", "intermittent_lower", "continuous", "continuous_upper"):
            np.testing.assert_allclose(one[name], other[name], rtol=1e-6)

    def test_figures_over_time_are_those_of_all_pairs(self):
        found = kds.contacts(wandering(), cutoff=5, by="bead", apart=1)
        over_time = found.over_time()
        for name in ("occupancy", "residence", "begin_rate", "end_rate"):
            self.assertAlmostEqual(over_time[name], found.all[name])
            self.assertLess(over_time[f"{name}_lower"], over_time[name])
            self.assertLess(over_time[name], over_time[f"{name}_upper"])

    def test_without_contacts_there_is_no_figure(self):
        found = kds.contacts(coil(), cutoff=0.01, by="bead")
        self.assertTrue(np.isnan(found.correlation([1])["intermittent"][0]))
        self.assertEqual(found.over_time()["occupancy"], 0)
        self.assertTrue(np.isnan(found.over_time()["occupancy_upper"]))
        replicas = kds.contacts_of_replicas([coil()] * 3, cutoff=0.01, by="bead")
        self.assertTrue(np.isnan([replicas.survival([1])[name][0] for name in ("survival", "lower", "upper")]).all())

    def test_lags_beyond_the_run_are_refused(self):
        found = kds.contacts(wandering(), cutoff=5, by="bead", apart=1)
        for lags in (39, [-1], [[1]], [np.nan], []):
            with self.assertRaisesRegex(kds.InputError, "^lags: expected times from 0 to less than .* 39$"):
                found.correlation(lags)


class Replicas(unittest.TestCase):
    options = {"cutoff": 5, "by": "bead", "apart": 1}

    def test_they_are_pooled(self):
        sources = [wandering(seed=seed, frames=30 + seed) for seed in range(4)]
        found, runs = kds.contacts_of_replicas(sources, **self.options), [kds.contacts(one, **self.options) for one in sources]
        time = sum(run.all["total"] for run in runs)
        ends = sum(run.all["contacts"] - run.all["open_at_end"] for run in runs)
        self.assertAlmostEqual(found.all["residence"], time / ends)
        self.assertAlmostEqual(found.all["occupancy"], time / sum(28 * run.json["run_length"] for run in runs))
        self.assertLess(found.all["occupancy_lower"], found.all["occupancy"])
        now = [states(one, 5, 64) for one in sources]
        again = sum((one[:-640] & one[640:]).sum() for one in now) / sum(one[:-640].sum() for one in now)
        self.assertAlmostEqual(found.correlation([10])["intermittent"][0], again, delta=0.03 * again)

    def test_survival_is_that_of_the_program(self):
        run = kds.contacts(wandering(), **self.options)
        steps = run.json["survival"]
        shares = survival_at([step["length"] + 1e-9 for step in steps], [Timeline(run)])
        np.testing.assert_allclose(shares, [step["survival"] for step in steps], atol=1e-9)

    def test_intervals_of_survival(self):
        """Without censored contacts, the share is the mean over replicas, and the jackknife gives its standard error."""
        runs = [SimpleNamespace(begin=np.zeros(1000), end=np.where(np.arange(1000) < lasting, 2.0, 1.0), length=9,
                                begun=np.ones(1000, bool), ended=np.ones(1000, bool)) for lasting in (500, 520, 540)]
        found, factor = pooled_survival([1.5], runs), np.exp(4.30265 * 0.02 / np.sqrt(3) / 0.52)
        np.testing.assert_allclose([found[name][0] for name in ("survival", "lower", "upper")],
                                   [0.52, 0.52 / factor, 0.52 * factor], rtol=1e-3)

    def test_contacts_are_censored_after_those_that_end(self):
        run = SimpleNamespace(begin=np.zeros(2), end=np.full(2, 5.0), begun=np.ones(2, bool), ended=np.array([False, True]))
        self.assertEqual(survival_at([4, 6], [run]).tolist(), [1, 0.5])

    def test_two_have_no_interval(self):
        found = kds.contacts_of_replicas([wandering(seed=1), wandering(seed=2)], **self.options)
        self.assertTrue(np.isnan(found.all["residence_lower"]))
        self.assertTrue(np.isnan(found.survival([1])["upper"][0]))

    def test_one_has_no_interval(self):
        """A list of one run has the figures of the run, and no interval from stretches of it."""
        run = kds.contacts(wandering(), **self.options)
        one, found = kds.contacts_of_replicas([wandering()], **self.options).correlation([2]), run.correlation([2])
        for name in ("intermittent", "continuous"):
            self.assertAlmostEqual(one[name][0], found[name][0])
            self.assertTrue(np.isnan([one[f"{name}_lower"][0], one[f"{name}_upper"][0]]).all())
            self.assertTrue(np.isfinite(found[f"{name}_lower"][0]))

    def test_what_is_no_list_of_one_system_is_refused(self):
        for replicas in ("a.dcd", [], wandering()):
            with self.assertRaisesRegex(kds.InputError, "^replicas: expected a list"):
                kds.contacts_of_replicas(replicas, **self.options)
        with self.assertRaisesRegex(kds.InputError, "^replicas: differ in their elements"):
            kds.contacts_of_replicas([wandering(beads=8), wandering(beads=9)], **self.options)


class Parts(unittest.TestCase):
    def test_they_are_pooled_as_replicas(self):
        sources = [wandering(seed=seed) for seed in range(3)]
        with tempfile.TemporaryDirectory() as scratch:
            out = Path(scratch) / "out"
            for source, part in zip(sources, (out, out / "part2", out / "part3")):
                frames = "".join(f"8\n\n{chr(10).join('C ' + ' '.join(map(str, bead)) for bead in frame)}\n" for frame in source)
                (Path(scratch) / "run.xyz").write_text(frames)
                program("contacts", str(Path(scratch) / "run.xyz"), "--cutoff", "5", "--apart", "1", "--out", str(part))
            found, expected = kds.contacts_of_parts(out), kds.contacts_of_replicas(sources, **Replicas.options)
            self.assertEqual(len(found.runs), 3)
            for name, value in expected.all.items():
                self.assertAlmostEqual(found.all[name], value, places=9)
            for one, other in ((found.survival([1, 2]), expected.survival([1, 2])),
                               (found.correlation([1]), expected.correlation([1]))):
                np.testing.assert_allclose(np.array(one.to_records() if hasattr(one, "to_records") else one).tolist(),
                                           np.array(other.to_records() if hasattr(other, "to_records") else other).tolist())
            (out / "contacts.json").unlink()
            with self.assertRaisesRegex(kds.InputError, "has no contacts.json"):
                kds.contacts_of_parts(out)


class Intervals(unittest.TestCase):
    def test_students_quantiles(self):
        for freedom, expected in ((1, 12.7062), (2, 4.30265), (4, 2.77645), (7, 2.36462)):
            self.assertAlmostEqual(student_95(freedom), expected, places=4)

    def test_replicas_have_students_interval(self):
        value, lower, upper = ratio(np.array([1.0, 2.0, 3.0]), np.ones(3), in_order=False)
        error = 4.30265 * 1 / np.sqrt(3) / 2
        np.testing.assert_allclose([value, lower, upper], [2, 2 * np.exp(-error), 2 * np.exp(error)], rtol=1e-5)
        self.assertTrue(np.isnan(ratio(np.ones(3), np.ones(3), in_order=False)[1]))

    def test_stretches_that_depend_on_each_other(self):
        random = np.random.default_rng(5)
        for correlation, least in ((0, 0.93), (0.5, 0.9), (-0.3, 0.93)):
            rows = [random.normal(size=4000)]
            for _ in range(15):
                rows.append(correlation * rows[-1] + np.sqrt(1 - correlation**2) * random.normal(size=4000))
            _, lower, upper = ratio(10 + np.array(rows), np.ones((16, 4000)), in_order=True)
            held = np.mean((lower <= 10) & (10 <= upper))
            self.assertTrue(least <= held <= 0.985, (correlation, held))

    def test_pairs_that_share_beads(self):
        """Intervals over time hold the truth, and intervals by pair do not."""
        from lifetimes import FIGURES, Scene

        scene, by_pair, over_time = Scene("molecule", 12, 200), 0, 0
        truth = scene.true_figures({})
        for seed in range(40):
            found = scene.measure(scene.trajectory(np.random.default_rng(seed)))
            for name in FIGURES:
                for figures, is_over_time in ((found.all, False), (found.over_time(), True)):
                    held = figures[f"{name}_lower"] <= truth[name] <= figures[f"{name}_upper"]
                    over_time, by_pair = over_time + (held and is_over_time), by_pair + (held and not is_over_time)
        self.assertGreaterEqual(over_time, 0.88 * 120)
        self.assertLessEqual(by_pair, 0.8 * 120)


if __name__ == "__main__":
    unittest.main()
