"""Every way to give an input leads to the run of the program."""

import os
import tempfile
import unittest
import warnings

import numpy as np

import kds
from data import BACKBONE, DCD, PDB, RESIDUES, coil, program, program_events, universe

STRUCTURES = ["sorted", "wrapped", "power", "contacts"]
FRAMES = 40


def needs(module):
    try:
        __import__(module)
        return lambda test: test
    except Exception as error:  # a package may be installed and broken
        return unittest.skip(f"{module} cannot be imported ({error})")


def ids(row):
    """Returns the ids of a row of the program's CSV, as events have them."""
    numbers = row["node"].replace("-", " ").split() + row["beads"].split()
    return [-1 if number == "infinity" else int(number) for number in numbers]


def same_events(test, events, expected):
    """Compares events with those of the program's CSV."""
    test.assertEqual(len(events), len(expected))
    test.assertGreater(len(events), 100)
    np.testing.assert_array_equal(events["step"], [int(row["frame"]) for row in expected])
    for name in ("lower", "upper"):
        np.testing.assert_array_equal(events[name], [float(row[name]) for row in expected])
    test.assertEqual(list(events["structure"]), [row["structure"] for row in expected])
    test.assertEqual(list(events["kind"]), [row["kind"] for row in expected])
    for event, row in zip(events, expected):
        test.assertEqual(list(event["beads"][:len(ids(row))]), ids(row))


class PathArrayGroupAndMdtraj(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        try:
            cls.folder = tempfile.TemporaryDirectory()
            cls.xtc = os.path.join(cls.folder.name, "villin.xtc")
            atoms = universe().atoms
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                import MDAnalysis

                with MDAnalysis.Writer(cls.xtc, atoms.n_atoms) as writer:
                    for _ in atoms.universe.trajectory[:FRAMES]:
                        writer.write(atoms)
        except ImportError as error:
            raise unittest.SkipTest(f"MDAnalysis cannot be imported ({error})")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def expected(self, motion):
        arguments = [self.xtc, "--topology", PDB, "--select", "backbone", "--structures", ",".join(STRUCTURES),
                     "--motion", motion]
        return program("run", *arguments)["fingerprint"], program_events(*arguments)

    def check(self, runs, motion):
        fingerprint, events = self.expected(motion)
        for name, run in runs.items():
            with self.subTest(input=name, motion=motion):
                self.assertEqual(run.fingerprint, fingerprint)
                same_events(self, run.events, events)

    def test_linear_and_hermite(self):
        group = universe(self.xtc).select_atoms(BACKBONE)
        positions = np.stack([group.positions for _ in group.universe.trajectory])
        for motion in ("linear", "hermite"):
            options = {"structures": STRUCTURES, "motion": motion}
            runs = {
                "path": kds.run(self.xtc, topology=PDB, select="backbone", **options),
                "float32": kds.run(positions, **options),
                "float64": kds.run(positions.astype(float), **options),
                "AtomGroup": kds.run(group, **options),
                "iterator": kds.run(iter(positions), **options),
            }
            self.check(runs, motion)

    @needs("mdtraj")
    def test_mdtraj(self):
        import mdtraj

        trajectory = mdtraj.load(self.xtc, top=PDB)
        chosen = trajectory.atom_slice(trajectory.topology.select("name N or name CA or name C"))
        for motion in ("linear", "hermite"):
            options = {"structures": STRUCTURES, "motion": motion}
            runs = {"mdtraj": kds.run(chosen, **options), "nm": kds.run(chosen.xyz, units="nm", **options)}
            self.check(runs, motion)

    def test_ranges_are_those_of_the_program(self):
        group = universe(self.xtc).select_atoms(BACKBONE)
        positions = np.stack([group.positions for _ in group.universe.trajectory])
        expected = program("run", self.xtc, "--topology", PDB, "--frames", "3:31:4")["fingerprint"]
        for source in (positions, group):
            run = kds.run(source, start=3, stop=31, step=4)
            self.assertEqual(run.fingerprint, expected)
            self.assertEqual(list(run.frames), list(range(3, 31, 4)))
        self.assertEqual(kds.run(self.xtc, topology=PDB, start=3, stop=31, step=4).fingerprint, expected)
        self.assertEqual(list(kds.run(group, start=-5).frames), list(range(FRAMES - 5, FRAMES)))

    def test_a_trajectory_is_an_iterable(self):
        atoms = universe(self.xtc)
        expected = kds.run(atoms.atoms, radius=1, structures=["sorted"], stop=8, necklaces=[len(atoms.atoms)])
        run = kds.run(atoms.trajectory[:8], radius=1, structures=["sorted"])
        self.assertEqual(run.fingerprint, expected.fingerprint)
        np.testing.assert_array_equal(run.times, expected.times)

    def test_periodic_cells(self):
        import MDAnalysis

        path = os.path.join(self.folder.name, "periodic.xtc")
        atoms = universe(self.xtc).atoms
        with MDAnalysis.Writer(path, atoms.n_atoms) as writer:
            for ts in atoms.universe.trajectory:
                ts.dimensions = [41, 42, 43, 90, 90, 90]
                atoms.positions = np.mod(atoms.positions + ts.frame, ts.dimensions[:3])
                writer.write(atoms)
        for options in ({}, {"start": 3, "step": 5}):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                run = kds.run(path, topology=PDB, select="backbone", **options)
                self.assertTrue(any("made whole" in str(warning.message) for warning in caught))
                group = universe(path).select_atoms(BACKBONE)
                self.assertEqual(kds.run(group, **options).fingerprint, run.fingerprint)
                self.assertEqual([frame.frame for frame in kds.stream(group, **options)], list(run.frames))

    def test_streams(self):
        group = universe(self.xtc).select_atoms(BACKBONE)
        run = kds.run(group, structures=["power"])
        frames = list(kds.stream(group, structures=["power"]))
        self.assertEqual([frame.frame for frame in frames], list(range(FRAMES)))
        np.testing.assert_array_equal(np.concatenate([frame.events for frame in frames])["beads"], run.events["beads"])
        radius = float(run.radii[0])
        pushed = list(kds.stream(iter([group.positions.copy() for _ in group.universe.trajectory]), radius=radius,
                                 structures=["power"]))
        np.testing.assert_array_equal(np.concatenate([frame.events for frame in pushed])["beads"], run.events["beads"])

    def test_a_stream_gives_all_events_at_their_frames(self):
        positions = universe(self.xtc).trajectory.timeseries(order="fac")[:6].copy()
        for motion in ("linear", "hermite"):
            options = {"structures": ["contacts"], "cutoff": 8, "motion": motion}
            run = kds.run(positions, **options)
            for source in (positions, iter(positions)):
                events = []
                for frame in kds.stream(source, **options):
                    events.append(frame.events)
                    if frame.frame > 0:
                        np.testing.assert_array_equal(frame.contacts.pairs(), run.contacts.pairs(frame.frame))
                self.assertEqual(len(events), 6)
                np.testing.assert_array_equal(np.concatenate(events)["beads"], run.events["beads"])

    def test_a_frame_of_a_stream_ends_with_the_next(self):
        frames = list(kds.stream(coil(), radius=1, structures=["contacts"]))
        self.assertEqual(frames[-1].contacts.pairs().shape[1], 2)
        with self.assertRaisesRegex(kds.InputError, "^frame 2: the stream has gone on"):
            frames[2].contacts

    def test_a_dcd_without_a_time_step_has_no_times(self):
        import MDAnalysis

        group = universe().select_atoms(BACKBONE)
        options = {"structures": ["contacts"], "cutoff": 6, "stop": 5}
        self.assertTrue(np.isnan(kds.run(group, **options).times).all())
        self.assertTrue(np.isnan(kds.run(DCD, topology=PDB, **options).times).all())
        self.assertIsNone(next(kds.stream(group, **options)).time)
        told = MDAnalysis.Universe(PDB, DCD, dt=0.02).select_atoms(BACKBONE)
        for run in (kds.run(told, **options), kds.run(group, dt=0.02, **options)):
            np.testing.assert_allclose(run.times, 0.02 * np.arange(5))

    def test_a_group_keeps_its_atoms(self):
        import MDAnalysis

        bare = MDAnalysis.Universe.empty(8, trajectory=True)  # without names and residues
        positions = 4 * np.random.default_rng(3).normal(size=(6, 8, 3)).cumsum(axis=1).astype(np.float32)
        positions[:, :4, 0], positions[:, 4:, 0] = 1, -1
        positions[3, [0, 4], 0] = -1, 1
        bare.load_new(positions)
        options = {"radius": 1, "structures": ["contacts"]}
        self.assertEqual(kds.run(bare.atoms, **options).fingerprint, kds.run(positions, **options).fingerprint)
        with self.assertRaisesRegex(kds.InputError, "^radius: the AtomGroup has no elements"):
            kds.run(bare.atoms, radius="element")
        group = bare.select_atoms("prop x > 0", updating=True)
        for call in (kds.run, lambda *given, **options: list(kds.stream(*given, **options))):
            with self.assertRaisesRegex(kds.InputError, "^AtomGroup: has other atoms in frame 3"):
                call(group, **options)
        kds.run(bare.atoms[group.ix], **options)

    def test_pushed_times_ascend(self):
        frames = zip(coil(), (0, 1, 2, 2, 3, 4))
        with self.assertWarnsRegex(kds.InputWarning, "^frame 3: has the time 2 ps, which is not later than the 2 ps"):
            warnings.simplefilter("always")
            list(kds.stream(frames, radius=1, structures=["contacts"]))

    def test_empty_cells_are_quiet(self):
        group = universe(self.xtc).select_atoms("name CA")  # the writer gave each frame an empty cell
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            kds.run(group, structures=["sorted"], radius=1, stop=5)
            self.assertEqual(len(list(kds.stream(group, structures=["sorted"], radius=1, stop=5))), 5)

    def test_the_trajectory_stays_where_it_was(self):
        group = universe(self.xtc).select_atoms(BACKBONE)
        group.universe.trajectory[7]
        before = group.positions.copy()
        kds.run(group, structures=["sorted"])
        self.assertEqual(group.universe.trajectory.frame, 7)
        for _ in kds.stream(group, structures=["sorted"], radius=1):
            self.assertEqual(group.universe.trajectory.frame, 7)
        np.testing.assert_array_equal(group.positions, before)

    def test_names_times_and_elements_come_along(self):
        group = universe(self.xtc).select_atoms(BACKBONE)
        run = kds.run(group, structures=["contacts"], radius="element")
        path = kds.run(self.xtc, topology=PDB, structures=["contacts"], radius="element")
        self.assertEqual([name.split(" in ")[0] for name in run.names], [name.split(" in ")[0] for name in path.names])
        np.testing.assert_array_equal(run.radii, path.radii)
        np.testing.assert_allclose(run.times, path.times)
        self.assertEqual(run.fingerprint, path.fingerprint)

    def test_groups(self):
        group = universe(self.xtc).select_atoms("name CA")
        first, second = group[:10], group[10:]
        run = kds.run(group, structures=["contacts"], cutoff=8, groups=(first, second))
        self.assertTrue(len(run.events))
        pairs = run.events["beads"][:, :2]
        self.assertTrue((pairs[:, 0] < 10).all() and (pairs[:, 1] >= 10).all())
        array = kds.run(np.stack([group.positions for _ in group.universe.trajectory]), structures=["contacts"], cutoff=8,
                        groups=(range(10), range(10, len(group))))
        self.assertEqual(run.fingerprint, array.fingerprint)

    def test_analysis_of_mdanalysis(self):
        from MDAnalysis.analysis.base import AnalysisBase

        group = universe(self.xtc).select_atoms(BACKBONE)
        analysis = kds.KineticAnalysis(group, structures=["power"]).run(start=2, stop=12)
        self.assertIsInstance(analysis, AnalysisBase)
        self.assertEqual(analysis.results.fingerprint, kds.run(group, structures=["power"], start=2, stop=12).fingerprint)
        self.assertEqual(list(analysis.results.frames), list(range(2, 12)))


class Arrays(unittest.TestCase):
    def test_an_array_is_not_copied(self):
        import resource

        beads = np.random.default_rng(1).normal(size=(1, 1000, 3)).cumsum(axis=1)
        positions = beads + np.linspace(0, 9, 1600)[:, None, None]  # moves rigidly, so there are few events
        kds.run(positions[:2], structures=["box"], radius=1)

        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        kds.run(positions, structures=["box"], radius=1)
        grown = 1024 * (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
        self.assertLess(grown, 0.8 * positions.nbytes)

    def test_radii_of_each_bead(self):
        radii = np.linspace(0.8, 1.2, 30)
        run = kds.run(coil(), radius=radii, structures=["contacts", "power"])
        np.testing.assert_array_equal(run.radii, radii)

    def test_necklaces(self):
        run = kds.run(coil(), radius=1, structures=["wrapped"], necklaces=[10, 20])
        nodes = run.wrapped.nodes(frame=0)
        self.assertFalse(((nodes[:, 0] < 10) & (nodes[:, 1] >= 10)).any())

    def test_times(self):
        run = kds.run(coil(), radius=1, structures=["contacts"], times=np.arange(6) * 20.0)
        np.testing.assert_allclose(run.events["time"], 20 * run.events["frame"])

    def test_periodic_cells_make_chains_whole(self):
        import kds._kds as core

        whole = coil() + 20
        beads = core.Beads("array")
        beads.cells = [12.0, 12.0, 12.0, 90.0, 90.0, 90.0] * 6
        wrapped = np.ascontiguousarray(np.mod(whole, 12.0))
        frames = core.Frames(wrapped, beads)
        run = core.Run([frames.path, "--format", "memory", "--radius", "1", "--structures", "contacts"], core.MoreOptions(),
                       frames)
        run.execute()
        self.assertTrue(any("made whole" in line for line in run.warnings()))
        self.assertEqual(f"{run.fingerprint():016x}", kds.run(whole, radius=1, structures=["contacts"]).fingerprint)

    def test_residues_of_a_path(self):
        run = kds.run(RESIDUES, structures=["contacts"], cutoff=8, select="ca")
        expected = program("contacts", RESIDUES, "--cutoff", "8", "--select", "ca", "--by", "residue")
        rows = run.contacts.analysis(by="residue").json["rows"]
        self.assertEqual(rows, expected["rows"])


if __name__ == "__main__":
    unittest.main()
