"""Contacts at frames, native contacts, joined contacts, graphs and files."""

import csv
import itertools
import json
import os
import tempfile
import unittest
from pathlib import Path

import numpy as np

import kds
from data import DATA, coil

TRP_CAGE = os.path.join(DATA, "proteins", "1l2y.pdb")


def integers(frames=30, beads=9, seed=4):
    """Returns whole positions, among which many distances equal a whole cutoff."""
    return np.random.default_rng(seed).integers(-3, 4, size=(frames, beads, 3)).astype(float)


def squares(positions, pairs):
    return ((positions[:, pairs[:, 0]] - positions[:, pairs[:, 1]]) ** 2).sum(axis=-1)


class AtFrames(unittest.TestCase):
    positions, options = integers(), {"cutoff": 5, "by": "bead", "apart": 1}

    def setUp(self):
        try:
            import scipy.sparse  # noqa: F401
        except ImportError as error:
            self.skipTest(str(error))

    def test_pairs_are_those_of_distances(self):
        came = ties = 0
        for start, stop, step in ((None, None, None), (3, 28, 5), (0, 25, 1)):
            found = kds.contacts(self.positions, start=start, stop=stop, step=step, **self.options)
            matrix, pairs = found.at_frames()
            read = np.arange(30)[start:stop:step]
            self.assertEqual(found.frame_numbers.tolist(), read.tolist())
            every = np.array(list(itertools.combinations(range(9), 2)))
            distances = squares(self.positions[read], every)
            expected = distances <= 25
            last = self.positions[read[-2:]][:, every[:, 0]] - self.positions[read[-2:]][:, every[:, 1]]
            comes = (distances[-1] == 25) & ((last[1] * (last[1] - last[0])).sum(axis=-1) <= 0)
            came += comes.sum()
            expected[-1] &= ~comes  # a pair that comes to the cutoff exactly at the last frame is not in contact
            at = [every.tolist().index(pair) for pair in pairs.tolist()]
            np.testing.assert_array_equal(matrix.toarray(), expected[:, at])
            self.assertFalse(np.delete(expected, at, axis=1).any())
            ties += (distances == 25).sum()
        self.assertTrue(came > 0 and ties > 10, (came, ties))

    def test_times_next_to_a_frame_are_not_of_the_frame(self):
        """A contact begins 2^-52 of a step after frame 300, or ends as little before it."""
        for before, at, after in ((9, 5 + 2**-40, -4091), (-4091, 5 + 2**-40, 9)):
            x = np.full(303, 9.0)
            x[299:302] = before, at, after
            found = kds.contacts(np.stack([np.zeros((303, 3)), x[:, None] * [1, 0, 0]], axis=1), **self.options)
            inside = found.at_frames()[0].toarray()[:, 0]
            self.assertEqual(np.flatnonzero(inside).tolist(), np.flatnonzero(np.abs(x) <= 5).tolist())

    def test_wrong_references_are_refused(self):
        found = kds.contacts(self.positions, **self.options)
        for pairs in ([[0, 9]], [[3, 3]], [[-1, 2]]):
            with self.assertRaisesRegex(kds.InputError, "^reference: expected pairs of two different elements from 0 to 8$"):
                found.native(pairs)
        with self.assertRaisesRegex(kds.InputError, "^labels: is 'element'; expected 'residue', a function or a list$"):
            found.joined("element")

    def test_native_contacts(self):
        found = kds.contacts(self.positions, **self.options)
        for reference in (None, 7):
            frame = reference or 0
            every = np.array(list(itertools.combinations(range(9), 2)))
            native = every[squares(self.positions[[frame]], every)[0] <= 25]
            steps, at_frames = found.native(reference), found.native(reference, at_frames=True)
            self.assertEqual(float(at_frames["fraction"][frame]), 1)
            np.testing.assert_array_equal(at_frames["fraction"], found.native(native[:, ::-1], at_frames=True)["fraction"])
            times = np.asarray(steps["frame"])
            self.assertTrue((np.diff(times) > 0).all() and times[0] == 0 and times[-1] == 29)
            for time, fraction in zip((times[:-1] + times[1:]) / 2, np.asarray(steps["fraction"])):
                step = int(time)
                placed = self.positions[step] + (time - step) * (self.positions[step + 1] - self.positions[step])
                if np.abs(squares(placed[None], native) - 25).min() > 1e-9:
                    self.assertEqual(fraction, np.mean(squares(placed[None], native) <= 25))
        with self.assertRaisesRegex(kds.InputError, "^reference: 30 is no frame that was read; expected one from 0 to 29$"):
            found.native(30)
        with self.assertRaisesRegex(kds.InputError, "^reference: expected the number"):
            found.native([[1, 2, 3]])
        with self.assertRaisesRegex(kds.InputError, "^reference: has no pair"):
            found.native(np.empty((0, 2), int))


class Joined(unittest.TestCase):
    def test_by_residue_they_are_those_of_the_program(self):
        options = {"select": "//*/*/[!H]", "cutoff": 4.5, "apart": 1}
        atoms = kds.contacts(TRP_CAGE, by="bead", **options)
        found, expected = atoms.joined(), kds.contacts(TRP_CAGE, by="residue", **options)
        mine = {(row["i"], row["j"]): row for row in found.json["rows"] if row["i"] != row["j"]}
        self.assertEqual([name.removesuffix(" in chain A") for name in found.names], expected.names)
        self.assertEqual(sorted(mine), sorted(zip(expected.rows["i"], expected.rows["j"])))
        for row in expected.json["rows"]:
            for name in ("contacts", "total", "longest", "residence"):
                self.assertAlmostEqual(mine[row["i"], row["j"]][name] or 0, row[name] or 0, places=9)
        self.assertGreater(len(mine), 50)
        total = sum(np.asarray(found.rows["mean_pairs"])) * 37
        self.assertAlmostEqual(total, sum(atoms.rows["total"]), places=6)
        self.assertEqual(sum(found.rows["pairs"]), len(atoms.rows))

    def test_by_element(self):
        found = kds.contacts(coil(), cutoff=2.5, by="bead")
        labels = ["C" if k % 3 else "N" for k in range(30)]
        kinds = {(row["first"], row["second"]) for row in found.joined(labels).json["rows"]}
        self.assertEqual(kinds, {tuple(sorted((labels[i], labels[j]), key="NC".index))
                                 for i, j in zip(found.rows["i"], found.rows["j"])})
        self.assertEqual(len(found.joined(lambda name: "all").rows), 1)
        with self.assertRaisesRegex(kds.InputError, "^labels: are 2; expected 30, one for each name$"):
            found.joined(["C", "N"])


class Files(unittest.TestCase):
    found = kds.contacts(coil(), cutoff=2.5, by="bead")

    def test_each_format_has_the_numbers(self):
        with tempfile.TemporaryDirectory() as folder:
            for result in (self.found, self.found.joined(lambda name: name[-1])):
                for what in ("rows", "intervals"):
                    table, paths = getattr(result, what), [Path(folder) / f"a.{ending}" for ending in ("csv", "npz")]
                    for path in paths:
                        result.save(path, what)
                    rows = list(csv.DictReader(paths[0].open(newline="")))
                    arrays = np.load(paths[1])
                    for name in arrays:
                        np.testing.assert_array_equal(arrays[name], np.asarray(table[name]).astype(arrays[name].dtype))
                    for name in ("i", "j", "contacts" if what == "rows" else "end_frame"):
                        self.assertEqual([float(row[name]) for row in rows], [float(value) for value in table[name]])
                result.save(Path(folder) / "a.json")
                self.assertEqual(json.loads((Path(folder) / "a.json").read_text()), result.json)
            kds.conditions(coil()).save(Path(folder) / "b.csv")
            self.assertEqual(sorted(os.listdir(folder)), ["a.csv", "a.json", "a.npz", "b.csv"])

    def test_wrong_paths_leave_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, message in (("a.xls", "cannot tell the format from the ending; expected .csv, .npz, .json, .graphml$"),
                                  ("none/a.csv", "cannot be written: No such file")):
                with self.assertRaisesRegex(kds.InputError, message):
                    self.found.save(os.path.join(folder, name))
            with self.assertRaisesRegex(kds.InputError, "^what: is 'all'; expected rows, survival, frames, intervals$"):
                self.found.save(os.path.join(folder, "a.csv"), "all")
            os.mkdir(os.path.join(folder, "b.csv"))
            with self.assertRaisesRegex(kds.InputError, "b.csv: cannot be written: Is a directory"):
                self.found.save(os.path.join(folder, "b.csv"))
            self.assertEqual(os.listdir(folder), ["b.csv"])

    def test_graphs(self):
        try:
            import networkx
        except ImportError as error:
            self.skipTest(str(error))
        graph = self.found.to_networkx()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.graphml")
            self.found.save(path)
            read = networkx.read_graphml(path, node_type=int)
        for one in (graph, read):
            self.assertEqual([name for _, name in one.nodes(data="name")], self.found.names)
            for row in self.found.json["rows"]:
                edge = dict(one.edges[row["i"], row["j"]])
                edge.pop("id", None)
                self.assertEqual(edge, {name: row[name] for name in ("occupancy", "contacts", "residence")
                                        if row[name] is not None})
            self.assertEqual(len(one.edges), len(self.found.rows))


if __name__ == "__main__":
    unittest.main()
