"""Salt bridges and hydrogen bonds."""

import itertools
import os
import unittest
from fractions import Fraction

import numpy as np

import kds
from data import DATA, coil
from test_intervals import TRP_CAGE, squares

WATER = os.path.join(DATA, "trajectories", "enkephalin_water.xtc")
IN_A_CELL = {"topology": WATER.replace(".xtc", ".gro")}


class SaltBridges(unittest.TestCase):
    def test_they_are_contacts_of_charged_atoms(self):
        found, positions, names = kds.salt_bridges(TRP_CAGE), *atoms_of(TRP_CAGE)
        pairs = {"LYS 8": [], "ARG 16": []}
        for i, j in itertools.product(range(len(names)), repeat=2):
            atom, partner = names[i].split()[0], names[j].removesuffix(" in chain A").split(" of ")
            if atom in ("OD1", "OD2") and " ASP 9 " in names[i] and partner[0] in ("NZ", "NE", "NH1", "NH2"):
                pairs[partner[1]].append((i, j))
        self.assertEqual([len(of_one) for of_one in pairs.values()], [2, 6])
        for name, of_one in pairs.items():
            bridged = (squares(positions, np.array(of_one)) <= 16).any(axis=1)
            self.assertTrue(0 < bridged.sum() < 38)
            both = [[found.names.index("ASP 9"), found.names.index(name)]]
            np.testing.assert_array_equal(found.native(both, at_frames=True)["fraction"], bridged)
        self.assertEqual(len(found.rows), 2)


def atoms_of(path):
    """Returns the positions of all atoms of a file, an array (frames, atoms, 3), and their names."""
    run = kds.KineticRun(path, select="//*", structures="box")
    frames = [run.control_points()]
    while run.step() is not None and run.frame < run._core.frame_count - 1:
        frames.append(run.control_points())
    return np.stack([frame[:, 0] for frame in frames] + [frames[-1][:, 1]]), run._core.bead_names()


def are_bonded(positions, atoms, time, distance, cosine):
    """Returns whether a donor, a hydrogen and an acceptor make a bond at a time, a Fraction. The arithmetic is rational."""
    def dot(a, b):
        return sum(x * y for x, y in zip(a, b))

    step = min(int(time), len(positions) - 2)
    ends = [[[Fraction(float(x)) for x in positions[step + k, atom]] for atom in atoms] for k in (0, 1)]
    donor, hydrogen, acceptor = ([x + (time - step) * (y - x) for x, y in zip(*both)] for both in zip(*ends))
    apart = [a - d for a, d in zip(acceptor, donor)]
    u, v = ([x - h for x, h in zip(one, hydrogen)] for one in (donor, acceptor))
    return (dot(apart, apart) <= Fraction(distance) ** 2 and dot(u, v) <= 0
            and dot(u, v) ** 2 >= Fraction(cosine) ** 2 * dot(u, u) * dot(v, v))


class HydrogenBonds(unittest.TestCase):
    def assert_exact(self, found, positions, donors, acceptors, samples, distance=3.0, angle=150.0):
        """Compares bonds with samples of each step, and each beginning and end with the times 1e-11 of a step around it."""
        rule, near, bonds = (distance, float(np.cos(np.radians(angle)))), Fraction(1, 10**11), {}
        for row in found.json["intervals"]:
            bonds.setdefault((row["i"], row["j"]), []).append([Fraction(row["begin_frame"]), Fraction(row["end_frame"])])
            atoms, ends = (donors[row["i"]], row["i"], row["j"]), bonds[row["i"], row["j"]][-1]
            for end, sign, is_open in zip(ends, (1, -1), (row["open_at_start"], row["open_at_end"])):
                if not is_open:
                    self.assertFalse(are_bonded(positions, atoms, end - sign * near, *rule), row)
                self.assertTrue(are_bonded(positions, atoms, end + sign * near, *rule) or ends[1] - ends[0] < 2 * near, row)
        bonded = 0
        for (hydrogen, donor), acceptor in itertools.product(donors.items(), acceptors):
            for time in (Fraction(k, samples) for k in range((len(positions) - 1) * samples + 1) if donor != acceptor):
                own = bonds.get((hydrogen, acceptor), ())
                if all(abs(time - end) > near for one in own for end in one):
                    expected = are_bonded(positions, (donor, hydrogen, acceptor), time, *rule)
                    self.assertEqual(any(first < time < last for first, last in own), expected, (hydrogen, acceptor, time))
                    bonded += expected
        self.assertGreater(bonded, 20)

    def test_they_are_those_of_samples(self):
        random = np.random.default_rng(3)
        for angle, distance in ((150.0, 3.0), (120.0, 3.5), (90.0, 2.5)):
            heavy = random.uniform(-2.5, 2.5, size=(5, 6, 3))
            heavy[0] = np.array(list(itertools.product((-1.2, 1.2), (-1.2, 1.2), (-1.2, 1.2))))[:6]
            tilt = random.normal(size=(5, 3, 3))
            light = heavy[:, :3] + tilt / np.linalg.norm(tilt, axis=-1, keepdims=True)
            positions = np.concatenate([heavy, light], axis=1)
            found = kds.hydrogen_bonds(positions, distance=distance, angle=angle, hydrogens=[6, 7, 8], heavy=range(6),
                                       bond=1.001)
            self.assertEqual(found.frame_numbers.tolist(), list(range(5)))
            self.assert_exact(found, positions, {6: 0, 7: 1, 8: 2}, range(6), 40, distance, angle)

    def test_slow_motions_do_not_overflow(self):
        for size in (1, 1e-80, 1e-160):
            positions = np.array([[[0, 1, 0], [0, 0, 0], [0, -1.5, 0.2]]] * 2) + np.array([0, size])[:, None, None]
            positions[1, 1, 0] -= 2 * size
            found = kds.hydrogen_bonds(positions, hydrogens=[1], heavy=[0, 2])
            self.assertEqual(len(found.intervals), 1)

    def test_those_of_a_protein(self):
        positions, names = atoms_of(TRP_CAGE)
        found = kds.hydrogen_bonds(TRP_CAGE, stop=8)
        donor = {row["i"]: names.index(row["donor"]) for row in found.json["rows"]}
        rows = found.json["rows"]
        self.assertIn(("H of LEU 7 in chain A", "O of TYR 3 in chain A"), {(row["first"], row["second"]) for row in rows})
        acceptors = {row["j"] for row in rows}
        self.assert_exact(found, positions[:8], donor, acceptors, 3)

    def test_at_frames_they_are_those_of_mdanalysis(self):
        try:
            import MDAnalysis
            import scipy.sparse  # noqa: F401
            from MDAnalysis.analysis.hydrogenbonds import HydrogenBondAnalysis
        except Exception as error:
            self.skipTest(str(error))
        for path, options, distance, angle, count in ((TRP_CAGE, {}, 3.0, 150.0, 226), (WATER, IN_A_CELL, 3.5, 130.0, 1150)):
            atoms = MDAnalysis.Universe(options.get("topology", path), path).atoms
            atoms.universe.add_TopologyAttr("elements", [name[0] for name in atoms.names])
            theirs = HydrogenBondAnalysis(atoms.universe, "element N O", "element H", "element N O", d_a_cutoff=distance,
                                          d_h_a_angle_cutoff=angle, update_selections=False).run().results.hbonds
            expected = sorted(theirs[:, [0, 2, 3]].astype(int).tolist())
            self.assertEqual(len(expected), count)
            for source, given in ((path, options), (atoms, {}))[:1 if options else 2]:  # water takes long
                matrix, pairs = kds.hydrogen_bonds(source, distance=distance, angle=angle, **given).at_frames()
                frame, column = matrix.nonzero()
                self.assertEqual(np.column_stack([frame, pairs[column]]).tolist(), expected)
        bridges = kds.salt_bridges(MDAnalysis.Universe(TRP_CAGE).atoms).rows["total"]
        np.testing.assert_allclose(bridges, kds.salt_bridges(TRP_CAGE).rows["total"], rtol=1e-6)

    def test_wrong_input(self):
        for given, message in (({"angle": 80}, "^angle: is 80; expected degrees from 90 to less than 180$"),
                               ({"hydrogens": [90]}, "^hydrogens, heavy: expected indices"),
                               ({"distance": 2}, "^distance: is 2; expected at least twice bond, 2.4$"),
                               ({"bond": 0.1}, "^bond: no hydrogen has a heavy atom within 0.1 in the first frame; expected"),
                               ({"bond": 3, "distance": 6}, "^bond: bead 1 has two donors within 3 in the first frame")):
            with self.assertRaisesRegex(kds.InputError, message):
                kds.hydrogen_bonds(coil(), **{"hydrogens": [1], "heavy": [0, 2], **given})
        for wrong in ({"bases": "LYS"}, {"acids": ()}):
            with self.assertRaisesRegex(kds.InputError, "^(bases|acids): is .*; expected names of residues, such as"):
                kds.salt_bridges(TRP_CAGE, **wrong)
        with self.assertRaisesRegex(kds.InputError, "^hydrogens, heavy: '//.*' chooses none"):
            kds.hydrogen_bonds(TRP_CAGE, hydrogens="//*/*/[XE]")
        with self.assertRaisesRegex(kds.InputError, "^distance: with bond it is 14.2; expected less than half the width"):
            kds.hydrogen_bonds(WATER, distance=13, stop=2, **IN_A_CELL)
        for source in (iter(coil()), "imd://localhost:9"):
            with self.assertRaisesRegex(kds.InputError, "^hydrogen_bonds: reads the frames three times"):
                kds.hydrogen_bonds(source)


if __name__ == "__main__":
    unittest.main()
