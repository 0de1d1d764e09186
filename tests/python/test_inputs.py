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

    def test_groups_are_selections(self):
        group = universe(self.xtc).select_atoms("name CA")
        options = {"structures": ["contacts"], "cutoff": 8, "stop": 10}
        expected = kds.run(group, groups=(range(10), range(10, 36)), **options).fingerprint
        mask = np.arange(36) < 10
        for groups in (("resid 41-50", "not resid 41-50"), (group[:10], "resid 51:80"), ["resid 41-50", ~mask], (mask, group[10:]),
                       (group.universe.select_atoms("resid 41-50"), range(10, 36))):
            with self.subTest(groups=str(groups)):
                self.assertEqual(kds.run(group, groups=groups, **options).fingerprint, expected)
                events = [frame.events for frame in kds.stream(group, groups=groups, **options)]
                self.assertGreater(len(np.concatenate(events)), 0)
        for groups, pattern in ((("resid 41-50", "name CB"), "^groups: group 1 has no bead"),
                                (("resid 41-50", "nonsense"), "^groups: cannot select 'nonsense': "),
                                (("resid (", "all"), "^groups: cannot select 'resid \\('"),
                                ((universe().select_atoms("name CA"), "all"), "^groups: an AtomGroup is of another Universe")):
            with self.subTest(groups=str(groups)), self.assertRaisesRegex(kds.InputError, pattern):
                kds.run(group, groups=groups, **options)
        with self.assertRaisesRegex(kds.InputError, "^groups: expected indices of beads from 0 to 35"):
            kds.run(group.positions[None].repeat(2, axis=0), groups=("resid 41-50", "all"), structures=["contacts"])

    @needs("mdtraj")
    def test_groups_are_selections_of_mdtraj(self):
        import mdtraj

        trajectory = mdtraj.load(self.xtc, top=PDB)
        calpha = trajectory.atom_slice(trajectory.topology.select("name CA"))
        options = {"structures": ["contacts"], "cutoff": 8, "stop": 10}
        self.assertEqual(kds.run(calpha, groups=("resid 0 to 9", "resid 10 to 35"), **options).fingerprint,
                         kds.run(calpha, groups=(range(10), range(10, 36)), **options).fingerprint)
        with self.assertRaisesRegex(kds.InputError, "^groups: cannot select 'name \\('"):
            kds.run(calpha, groups=("name (", "all"), **options)

    def test_residues_are_told_apart(self):
        import MDAnalysis

        def solvent(resids, segments, atoms=1, names=None):
            """Returns the atoms of residues SOL, each a step of 4 from the one before."""
            residues = len(resids)
            made = MDAnalysis.Universe.empty(residues * atoms, residues, max(segments) + 1, np.repeat(np.arange(residues), atoms),
                                             segments, trajectory=True)
            made.add_TopologyAttr("names", names or [f"A{k}" for k in range(atoms)] * residues)
            made.add_TopologyAttr("resnames", ["SOL"] * residues)
            made.add_TopologyAttr("resids", resids)
            places = np.zeros((2, residues * atoms, 3), dtype=np.float32)
            places[:, :, 0] = 4 * np.repeat(np.arange(residues), atoms) + np.tile(np.arange(atoms), residues)
            made.load_new(places)
            return made.atoms

        for name, group, expected in (
                ("equal numbers", solvent([1, 1, 1], [0, 0, 0]), ["SOL 1", "SOL 1#1", "SOL 1#2"]),
                ("numbers restart", solvent([1, 2, 1, 2], [0, 0, 0, 0]), ["SOL 1", "SOL 2", "SOL 1#2", "SOL 2#3"]),
                ("segments without names", solvent([1, 1], [0, 1]), ["SOL 1", "SOL 1#1"]),
                ("three atoms each", solvent([7, 7], [0, 0], 3), ["SOL 7", "SOL 7#1"]),
                ("atoms of one name", solvent([7, 7], [0, 0], 2, ["W"] * 4), ["SOL 7", "SOL 7#1"]),
                ("numbers differ", solvent([1, 2], [0, 0], 2), ["SOL 1", "SOL 2"])):
            with self.subTest(name):
                found = kds.contacts(group, cutoff=4.5, apart=1)
                self.assertEqual(found.names, expected)
                neighbours = [(k, k + 1) for k in range(len(expected) - 1)]
                self.assertEqual(list(zip(found.rows["i"], found.rows["j"])), neighbours)
        part = solvent([1, 1, 1], [0, 0, 0])[1:]
        self.assertEqual(kds.contacts(part, cutoff=4.5, apart=1).names, ["SOL 1", "SOL 1#2"])
        mixed = solvent([1, 2], [0, 0], 2)[[0, 2, 1, 3]]
        with self.assertWarnsRegex(kds.InputWarning, "atoms of residue SOL 1 are not neighbours"):
            kds.contacts(mixed, cutoff=4.5, apart=1)

    @needs("mdtraj")
    def test_frame_numbers_of_mdtraj_are_doubted(self):
        import mdtraj

        trajectory = mdtraj.load(DCD, top=PDB)[:20]
        with self.assertWarnsRegex(kds.InputWarning, "its times are 0, 1, 2"):
            numbers = kds.contacts(trajectory, cutoff=5)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            times = kds.contacts(trajectory, cutoff=5, dt=0.02)
        self.assertAlmostEqual(times.all["residence"], 0.02 * numbers.all["residence"])

    @needs("mdtraj")
    def test_residues_of_mdtraj_are_told_apart(self):
        import mdtraj

        topology = mdtraj.Topology()
        chain = topology.add_chain()
        for number in (5, 5, 6):
            topology.add_atom("O", mdtraj.element.oxygen, topology.add_residue("HOH", chain, resSeq=number))
        trajectory = mdtraj.Trajectory(0.4 * np.arange(3)[None, :, None].repeat(2, axis=0).repeat(3, axis=2), topology)
        self.assertEqual(kds.contacts(trajectory, cutoff=8, apart=1).names, ["HOH 5", "HOH 5#1", "HOH 6"])


class Units(unittest.TestCase):
    """Nanometres that are taken for angstrom."""

    def warned(self, call):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            call()
        return [str(warning.message) for warning in caught if "median bond" in str(warning.message)]

    def write_xyz(self, folder, name, frames):
        path = os.path.join(folder, name)
        with open(path, "w") as file:
            for frame in frames:
                file.write(f"{len(frame)}\n\n" + "".join(f"CA {x} {y} {z}\n" for x, y, z in frame))
        return path

    @needs("MDAnalysis")
    def test_a_molecule_in_nanometres_is_noticed_once(self):
        import MDAnalysis

        backbone = universe().trajectory.timeseries(order="fac")[:4] / 10
        calpha = np.ascontiguousarray(backbone[:, 1::3])
        memory = MDAnalysis.Universe.empty(36, trajectory=True)
        memory.load_new(calpha)
        contacts = {"structures": ["contacts"], "cutoff": 8}

        def push(frames):
            run = kds.KineticRun.pushed(36, 1, **contacts)
            for frame in frames:
                run.push(frame)

        with tempfile.TemporaryDirectory() as folder:
            a, b = (self.write_xyz(folder, name, calpha) for name in ("a.xyz", "b.xyz"))
            for name, call, pattern in (
                    ("array", lambda: kds.run(calpha, **contacts), "^array: .* 0.38. angstrom, which fits C-alpha atoms"),
                    ("backbone", lambda: kds.run(backbone, **contacts), "^array: .* 0.1.. angstrom, which fits bonded atoms"),
                    ("said to be angstrom", lambda: kds.run(calpha, units="angstrom", **contacts), "^array"),
                    ("Fortran", lambda: kds.run(np.asfortranarray(calpha, dtype=float), **contacts), "^array"),
                    ("iterable", lambda: kds.run(iter(calpha), **contacts), "^array"),
                    ("AtomGroup", lambda: kds.run(memory.atoms, **contacts), "^AtomGroup"),
                    ("stream", lambda: list(kds.stream(calpha, **contacts)), "^array"),
                    ("stream of an iterable", lambda: list(kds.stream(iter(calpha), **contacts)), "^frame 0"),
                    ("stream of a group", lambda: list(kds.stream(memory.atoms, **contacts)), "^AtomGroup"),
                    ("pushed", lambda: push(calpha), "^frame 0"),
                    ("driven", lambda: kds.KineticRun(calpha, **contacts), "^array"),
                    ("lifetimes", lambda: kds.run(calpha, **contacts).contacts.lifetimes(), "^array"),
                    ("contacts", lambda: kds.contacts(calpha, cutoff=8), "^array"),
                    ("compare", lambda: kds.compare(calpha, rounds=1, strides=[1, 2]), "^array"),
                    ("collide", lambda: kds.collide(calpha, radius=1), "^array"),
                    ("update", lambda: kds.update(calpha, rounds=1, techniques=["kinetic"]), "^array"),
                    ("conditions", lambda: kds.conditions(calpha), "^array"),
                    ("path", lambda: kds.run(a, **contacts), "a.xyz: the median bond"),
                    ("paths", lambda: kds.run([a, b], **contacts), "a.xyz: the median bond")):
                with self.subTest(name):
                    lines = self.warned(call)
                    self.assertEqual(len(lines), 1, lines)
                    self.assertRegex(lines[0], pattern)
                    self.assertRegex(lines[0], "expected units='nm' for an array, or coordinates in angstrom, 10 times as")
        self.assertEqual(self.warned(lambda: kds.run(calpha, units="nm", **contacts)), [])
        np.testing.assert_array_equal(kds.run(calpha, units="nm", **contacts).contacts.pairs(2),
                                      kds.run(np.float32(10) * calpha, **contacts).contacts.pairs(2))

    def test_other_small_scenes_are_not_doubted(self):
        random = np.random.default_rng(4)
        turn = np.linspace(0, 2 * np.pi, 17)[:-1]
        lattice = np.stack(np.meshgrid(*3 * [np.arange(4.0)]), axis=-1).reshape(-1, 3)
        for name, frame in {
                "angstrom": universe().atoms.positions, "coil": coil()[0], "spiral": kds.generate("spiral", beads=30, frames=2)[0] / 10,
                "unit cube": random.random((60, 3)), "cube of 0.3": 0.3 * random.random((60, 3)),
                "diffusion": random.normal(scale=0.1, size=(60, 3)).cumsum(axis=0),
                "slower diffusion": random.normal(scale=0.25, size=(60, 3)).cumsum(axis=0),
                "circle": np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1), "lattice": lattice / 10, "metres": coil()[0] / 1e10,
                "three beads": coil(beads=3)[0] / 10}.items():
            with self.subTest(name):
                self.assertEqual(self.warned(lambda: kds.run(np.stack([frame, frame]), radius=0.01, structures=["box"])), [])


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

    def test_all_layouts_and_dtypes_are_read_as_their_values(self):
        values = np.round(9 * coil())  # whole numbers below 128, which every dtype has
        frames, beads, _ = values.shape
        wide = np.zeros((2 * frames, 3 * beads, 4))
        wide[::2, ::3, 1:] = values
        read_only = values.copy()
        read_only.flags.writeable = False
        bytes_ = b"0" + values.tobytes()
        layouts = {
            "Fortran": np.asfortranarray(values),
            "strided": wide[::2, ::3, 1:],
            "negative strides": np.ascontiguousarray(values[::-1, ::-1, ::-1])[::-1, ::-1, ::-1],
            "axes in another order": np.ascontiguousarray(values.transpose(2, 0, 1)).transpose(1, 2, 0),
            "read-only": read_only,
            "unaligned": np.frombuffer(bytes_, dtype=np.uint8)[1:].view(float).reshape(values.shape),
            "a field": np.rec.fromarrays([values], names="positions").positions,
            "a subclass": values.view(type("Positions", (np.ndarray,), {})),
            "not masked": np.ma.masked_array(values).data,
            "lists": values.tolist(),
            **{dtype: values.astype(dtype) for dtype in (">f8", "<f8", ">f4", "f2", ">f2", "i1", "i8", ">i4", "int64")},
            "u1": (values + 100).astype("u1"),
        }
        run = kds.run(values, cutoff=27, structures=["contacts"])
        self.assertGreater(len(run.events), 50)
        for name, given in layouts.items():
            with self.subTest(name):
                found = kds.run(given, cutoff=27, structures=["contacts"])
                self.assertEqual(found.contacts.pairs(3).tolist(), run.contacts.pairs(3).tolist())
                np.testing.assert_array_equal(found.events["beads"], run.events["beads"])
                events = [frame.events for frame in kds.stream(iter(given), cutoff=27, structures=["contacts"])]
                np.testing.assert_array_equal(np.concatenate(events)["beads"], run.events["beads"])
        still = np.broadcast_to(values[:1], values.shape)  # strides of 0
        self.assertEqual(kds.run(still, cutoff=27, structures=["contacts"]).contacts.pairs(5).tolist(),
                         run.contacts.pairs(0).tolist())

    def test_an_array_that_changes_is_noticed(self):
        structures = ["wrapped", "power", "contacts"]
        calls = {
            "pairs": lambda run: run.contacts.pairs(3),
            "pairs between frames": lambda run: run.contacts.pairs(2.5),
            "edges": lambda run: run.power.edges(3),
            "spheres": lambda run: run.wrapped.spheres(3),
            "nodes": lambda run: run.wrapped.nodes(4),
            "elements": lambda run: run.power.elements(3),
            "lifetimes": lambda run: run.contacts.lifetimes(),
            "analysis": lambda run: run.contacts.analysis(by="bead", gap=1),
            "view": lambda run: run.view(),
            "the table": str,
        }
        for dtype in (np.float32, np.float64):
            positions = coil().astype(dtype)
            run = kds.run(positions, radius=1, structures=structures)
            run.contacts.pairs(0)
            positions[3, 7, 2] = np.nextafter(positions[3, 7, 2], dtype(9))
            for name, call in calls.items():
                with self.subTest(name), self.assertRaisesRegex(kds.InputError, "^array: frame 3: the input has changed"):
                    call(run)

    def test_changes_of_other_inputs(self):
        fresh = coil()
        expected = kds.run(fresh, radius=1, structures=["contacts"]).contacts.pairs(2).tolist()
        for name, given in (("a copy", np.asfortranarray(fresh)), ("converted", fresh.astype(">f8")), ("frames", list(fresh))):
            with self.subTest(name):  # the run has numbers of its own
                run = kds.run(given, radius=1, structures=["contacts"])
                for frame in given:
                    frame[:] = 0
                self.assertEqual(run.contacts.pairs(2).tolist(), expected)
                fresh = coil()
        positions = coil()
        driven = kds.KineticRun(positions, radius=1, structures=["contacts"])
        driven.go_to(4)
        positions[1] += 1
        with self.assertRaisesRegex(kds.InputError, "^array: frame 1: the input has changed"):
            driven.go_to(2)
        positions = coil()
        part = kds.run(positions, radius=1, start=1, stop=6, step=2, structures=["contacts"])
        positions[[0, 2]] = np.nan  # frames that are not of the run
        part.contacts.pairs(1)
        positions[5] += 1
        with self.assertRaisesRegex(kds.InputError, "^array: frame 5: the input has changed"):
            part.contacts.pairs(4.5)

    @needs("mdtraj")
    def test_a_changed_mdtraj_trajectory_is_noticed(self):
        import mdtraj

        trajectory = mdtraj.load(DCD, top=PDB)[:6]
        run = kds.run(trajectory, cutoff=6, structures=["contacts"])
        trajectory.center_coordinates()
        with self.assertRaisesRegex(kds.InputError, "^mdtraj trajectory: frame 0: the input has changed"):
            run.contacts.lifetimes()

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
        frames = core.Frames(wrapped, None, beads)
        run = core.Run([frames.path, "--format", "memory", "--radius", "1", "--structures", "contacts", "--no-periodic"],
                       core.MoreOptions(), frames)
        run.execute()
        self.assertTrue(any("made whole" in line for line in run.warnings()))
        self.assertEqual(f"{run.fingerprint():016x}", kds.run(whole, radius=1, structures=["contacts"]).fingerprint)

    def test_residues_of_a_path(self):
        run = kds.run(RESIDUES, structures=["contacts"], cutoff=8, select="ca", apart=3)
        expected = program("contacts", RESIDUES, "--cutoff", "8", "--select", "ca", "--by", "residue")
        rows = run.contacts.analysis(by="residue").json["rows"]
        self.assertEqual(rows, expected["rows"])


class Velocities(unittest.TestCase):
    OPTIONS = {"motion": "hermite", "radius": 1.2, "structures": ["wrapped", "power"]}

    def setUp(self):
        k, bead = np.arange(6)[:, None, None] / 4, np.arange(30)[None, :, None]
        phase, rate = 0.7 * bead + np.array([0, 1.3, 2.1]), 1 + np.cos(bead)
        self.times = k.ravel()
        self.positions = (1.5 * bead * np.array([1, 0, 0]) + 2 * np.sin(rate * k + phase)).astype(np.float32)
        self.velocities = (2 * rate * np.cos(rate * k + phase)).astype(np.float32)

    def run_of(self, source, **options):
        return kds.run(source, **{**self.OPTIONS, **options})

    def test_arrays(self):
        run = self.run_of(self.positions, velocities=self.velocities, times=self.times)
        self.assertEqual(run.summary["input"]["velocities"], "file")
        differences = self.run_of(self.positions, times=self.times)
        self.assertEqual(differences.summary["input"]["velocities"], "differences")
        self.assertNotEqual(run.fingerprint, differences.fingerprint)
        same = self.run_of(self.positions / 10, velocities=self.velocities.astype(float) / 10, dt=0.25, units="nm")
        self.assertEqual(len(same.events), len(run.events))
        points = kds.KineticRun(self.positions, velocities=self.velocities, times=self.times, **self.OPTIONS).control_points()
        np.testing.assert_allclose(points[:, 1], self.positions[0] + self.velocities[0].astype(float) / 12, rtol=1e-14)
        np.testing.assert_allclose(points[:, 2], self.positions[1] - self.velocities[1].astype(float) / 12, rtol=1e-14)
        for options, message in (({"velocities": self.velocities[:2], "times": self.times}, "velocities: have the shape"),
                                 ({"velocities": self.velocities}, "velocities: file: frame 0 has no time; expected"),
                                 ({"velocities": self.velocities, "motion": "linear"}, "velocities: is of Hermite curves"),
                                 ({"velocities": "guess"}, "velocities: 'guess' is not one of differences, file")):
            with self.assertRaisesRegex(kds.InputError, message):
                self.run_of(self.positions, **options)
        with self.assertRaisesRegex(kds.InputError, "velocities: an array is for positions in memory"):
            self.run_of(DCD, velocities=self.velocities)

    @needs("MDAnalysis")
    def test_files_as_mdanalysis_reads_them(self):
        import MDAnalysis

        def universe_of(*source, **options):
            found = MDAnalysis.Universe.empty(30, trajectory=True, velocities=True)
            found.load_new(*source, **options)
            return found

        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            written = universe_of(self.positions, dt=0.25, velocities=self.velocities)
            for ending in ("trr", "nc"):
                path = os.path.join(folder, "a." + ending)
                with MDAnalysis.Writer(path, n_atoms=30, dt=0.25, velocities=True) as writer:
                    for _ in written.trajectory:
                        writer.write(written.atoms)
                group = universe_of(path).atoms
                expected = self.run_of(group)
                self.assertEqual(expected.summary["input"]["velocities"], "file")
                self.assertEqual(self.run_of(path).fingerprint, expected.fingerprint)
                self.assertEqual(sum(len(frame.events) for frame in kds.stream(group, **self.OPTIONS)), len(expected.events))
                self.assertNotEqual(self.run_of(path, velocities="differences").fingerprint, expected.fingerprint)
                with self.assertRaisesRegex(kds.InputError, "velocities: an AtomGroup has its own"):
                    self.run_of(group, velocities=self.velocities)

    @needs("MDAnalysis")
    def test_frames_without_velocities(self):
        import MDAnalysis

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.trr")
            with MDAnalysis.Writer(path, n_atoms=30) as writer, warnings.catch_warnings():
                warnings.simplefilter("ignore")
                for k in range(6):  # in a cell; frames 1 and 4 have velocities
                    frame = MDAnalysis.Universe.empty(30, trajectory=True, velocities=k % 3 == 1)
                    frame.atoms.positions, frame.trajectory.ts.time = self.positions[k], self.times[k]
                    frame.dimensions = [100, 100, 100, 90, 90, 90]
                    if k % 3 == 1:
                        frame.atoms.velocities = self.velocities[k]
                    writer.write(frame.atoms)
            group = MDAnalysis.Universe.empty(30, trajectory=True)
            group.load_new(path)
            for chosen, velocities, lacks in (({"start": 1, "step": 3}, "file", None), ({}, "differences", 0),
                                              ({"step": 2}, "differences", 0), ({"step": 3}, "differences", None)):
                with warnings.catch_warnings(record=True) as caught:
                    warnings.simplefilter("always")
                    found = self.run_of(group.atoms, **chosen)
                words = [str(one.message) for one in caught if "velocities" in str(one.message)]
                self.assertEqual(words, [] if lacks is None else [
                    f"AtomGroup: velocities are differences of frames, because frame {lacks} has no velocities"])
                self.assertEqual(found.summary["input"]["velocities"], velocities)
                self.assertEqual(found.fingerprint, self.run_of(path, **chosen).fingerprint)


if __name__ == "__main__":
    unittest.main()
