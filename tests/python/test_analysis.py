"""Analyses of MDAnalysis are the functions of kds, on the frames that MDAnalysis chooses."""

import unittest

import numpy as np

import kds
from data import universe

try:
    import MDAnalysis
    from MDAnalysis.analysis.base import AnalysisBase
    from MDAnalysis.lib.distances import self_distance_array
except ImportError as error:
    raise unittest.SkipTest(f"MDAnalysis cannot be imported ({error})")


class Analyses(unittest.TestCase):
    group = universe().select_atoms("name CA")

    def test_runs(self):
        analysis = kds.KineticAnalysis(self.group, structures=["power"]).run(start=2, stop=12)
        self.assertIsInstance(analysis, AnalysisBase)
        run = kds.run(self.group, structures=["power"], start=2, stop=12)
        self.assertEqual(analysis.results.fingerprint, run.fingerprint)
        self.assertEqual(len(analysis.results.events), len(run.events))
        self.assertEqual(list(analysis.results.frames), list(range(2, 12)))

    def test_frames_are_chosen_as_in_mdanalysis(self):
        chosen = np.zeros(len(self.group.universe.trajectory), bool)
        chosen[10:30:4] = True
        runs = [kds.KineticAnalysis(self.group, structures=["power"]).run(**frames) for frames in (
            {"start": 10, "stop": 30, "step": 4}, {"frames": [10, 14, 18, 22, 26]}, {"frames": chosen},
            {"start": 10 - len(chosen), "stop": 30 - len(chosen), "step": 4})]
        self.assertEqual(len({run.results.fingerprint for run in runs}), 1)
        self.assertEqual(list(runs[0].frames), [10, 14, 18, 22, 26])

    def test_contacts_are_those_of_each_frame(self):
        """Compares the number of pairs with distances of MDAnalysis, frame by frame."""
        analysis = kds.ContactAnalysis(self.group, cutoff=8, by="bead", apart=3).run(stop=200, step=2)
        first, second = np.triu_indices(len(self.group), 1)
        apart = second - first >= 3
        counts = [np.sum(self_distance_array(self.group.positions)[apart] <= 8) for _ in self.group.universe.trajectory[:200:2]]
        np.testing.assert_array_equal(analysis.results.timeseries, np.stack([range(0, 200, 2), counts], axis=1))
        self.assertGreater(len(set(counts)), 5)

    def test_times_next_to_a_frame_are_not_of_the_frame(self):
        x = np.full((1003, 2, 3), [[0, 0, 0], [9, 0, 0]], np.float32)
        x[1000:1002, 1, 0] = 5.0000005, -4091
        pair = MDAnalysis.Universe.empty(2, trajectory=True).load_new(x).atoms
        count = kds.ContactAnalysis(pair, cutoff=5, by="bead", apart=1).run().results.timeseries[:, 1]
        np.testing.assert_array_equal(count, np.abs(x[:, 1, 0]) <= 5)

    def test_results_have_the_names_of_the_field(self):
        analysis = kds.ContactAnalysis(self.group, cutoff=8).run(start=5, stop=40)
        found = kds.contacts(self.group, cutoff=8, start=5, stop=40)
        self.assertEqual(analysis.kds.json, found.json)
        self.assertIs(analysis.results.contacts, analysis.kds.intervals)
        self.assertIs(analysis.results["lifetimes"], analysis.kds.rows)
        np.testing.assert_array_equal(analysis.results.times, [ts.time for ts in self.group.universe.trajectory[5:40]])

    def test_wrong_arguments_are_refused(self):
        for frames in ([3], [1, 2, 4], [4, 3, 2], [1, 1]):
            with self.subTest(frames), self.assertRaisesRegex(kds.InputError, "^frames: expected two or more at equal"):
                kds.ContactAnalysis(self.group, cutoff=8).run(frames=frames)
        with self.assertRaisesRegex(ValueError, "start/stop/step"):
            kds.ContactAnalysis(self.group, cutoff=8).run(start=1, frames=[1, 2])
        with self.assertRaisesRegex(TypeError, "start: is no argument of kds.ContactAnalysis; its run takes it"):
            kds.ContactAnalysis(self.group, cutoff=8, start=1)
        with self.assertRaisesRegex(TypeError, "cutof: is no argument of kds.KineticAnalysis"):
            kds.KineticAnalysis(self.group, cutof=8)
        with self.assertRaisesRegex(kds.InputError, "ndarray: is no AtomGroup"):
            kds.ContactAnalysis(self.group.positions, cutoff=8)
