"""Results of runs, compared with static structures, with NumPy and with the program."""

import base64
import csv
import gc
import gzip
import html
import itertools
import json
import os
import re
import shutil
import tempfile
import unittest
import warnings
import zlib
from pathlib import Path

import numpy as np

import kds
from data import DATA, DCD, PDB, RESIDUES, coil, program, program_warnings, universe


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096


def pairs_within(positions, distance, apart):
    """Returns the pairs of centres at most this far apart, by looking at all pairs."""
    return [[i, j] for i, j in itertools.combinations(range(len(positions)), 2)
            if j - i >= apart and np.linalg.norm(positions[i] - positions[j]) <= distance]


def delaunay_edges(points):
    """Returns the edges of all triangles whose circumcircle contains no other point, by looking at all triangles."""
    edges = set()
    for corners in itertools.combinations(range(len(points)), 3):
        a, b, c = points[list(corners)]
        center = a + np.linalg.solve([b - a, c - a], [(b - a) @ (b - a) / 2, (c - a) @ (c - a) / 2])
        others = np.delete(points, corners, axis=0)
        if (np.linalg.norm(others - center, axis=1) > np.linalg.norm(a - center)).all():
            edges |= set(itertools.combinations(corners, 2))
    return [list(edge) for edge in sorted(edges)]


def assert_same(array, expected):
    """Compares arrays bit by bit, so that NaN equals NaN."""
    np.testing.assert_array_equal(array.dtype, expected.dtype)
    if array.tobytes() != expected.tobytes():
        raise AssertionError(f"arrays differ:\n{array}\n{expected}")


class States(unittest.TestCase):
    positions = coil(frames=5, beads=40)

    def setUp(self):
        self.run_ = kds.run(self.positions, radius=1.1, structures=["sorted", "wrapped", "power", "contacts", "closest"])

    def test_at_frames_in_any_order(self):
        for frame in (4, 0, 2, 1, 3):
            expected, hidden = kds.power_diagram(self.positions[frame], 1.1)
            np.testing.assert_array_equal(self.run_.power.edges(frame=frame), expected)
            self.assertEqual(len(hidden), 0)
            self.assertEqual(self.run_.contacts.pairs(frame=frame).tolist(),
                             pairs_within(self.positions[frame], 2.2, apart=2))
            order = self.run_.sorted.elements(frame)[:, 1]
            np.testing.assert_array_equal(order, np.argsort(self.positions[frame][:, 0], kind="stable"))

    def test_between_frames(self):
        for time in (0.5, 2.25):
            k, u = int(time), time % 1
            at = (1 - u) * self.positions[k] + u * self.positions[k + 1]
            self.assertEqual(self.run_.contacts.pairs(frame=time).tolist(), pairs_within(at, 2.2, apart=2))
            np.testing.assert_array_equal(self.run_.power.edges(frame=time), kds.power_diagram(at, 1.1)[0])
            nodes, spheres = self.run_.wrapped.nodes(frame=time), self.run_.wrapped.spheres(frame=time)
            expected_nodes, expected = kds.wrapped_hierarchy(at, 1.1)
            np.testing.assert_array_equal(nodes, expected_nodes)
            np.testing.assert_allclose(spheres, expected, atol=1e-9)

    def test_spheres_enclose_their_balls(self):
        for (first, last), sphere in zip(self.run_.wrapped.nodes(frame=3), self.run_.wrapped.spheres(frame=3)):
            reach = np.linalg.norm(self.positions[3][first:last + 1] - sphere[:3], axis=1) + 1.1
            self.assertLessEqual(reach.max(), sphere[3] * (1 + 1e-12))

    def test_looking_adds_no_events(self):
        events = self.run_.events.copy()
        fingerprint = self.run_.fingerprint
        self.run_.power.edges(frame=1)
        assert_same(self.run_.events, events)
        self.assertEqual(self.run_.fingerprint, fingerprint)
        self.assertEqual(kds.run(self.positions, radius=1.1, structures=self.run_.structures).fingerprint, fingerprint)

    def test_events_turn_one_frame_into_the_next(self):
        pairs = {tuple(pair) for pair in self.run_.contacts.pairs(frame=0)}
        for event in self.run_.contacts.events:
            pair = tuple(event["beads"][:2])
            pairs = pairs | {pair} if event["kind"] == "begin" else pairs - {pair} if event["kind"] == "end" else pairs
        self.assertEqual(sorted(pairs), [tuple(pair) for pair in self.run_.contacts.pairs(frame=4)])

    def test_shown_as_the_table_of_the_program(self):
        self.assertIn(self.run_.fingerprint, str(self.run_))
        self.assertIn("certificates created", self.run_._repr_html_())
        self.assertNotIn("--", str(self.run_).replace("---", ""))
        self.assertIn("kds.Run: 40 beads", repr(self.run_))
        self.assertEqual(self.run_.summary["fingerprint"], self.run_.fingerprint)


class Plots(unittest.TestCase):
    def test_they_show_the_numbers(self):
        try:
            import matplotlib
        except ImportError as error:
            self.skipTest(str(error))
        matplotlib.use("Agg")
        run = kds.run(coil(), radius=1, cutoff=3, structures=["contacts", "power"])
        axes = run.plot()
        drawn = {patch.get_label(): patch.get_data().values for patch in axes.patches}
        for name in ("contacts", "power"):
            np.testing.assert_array_equal(drawn[name], np.bincount(getattr(run, name).events["step"], minlength=5))
        found = run.contacts.analysis(by="bead")
        np.testing.assert_array_equal(found.plot_map().images[0].get_array(), found.map())
        self.assertEqual(found.plot().get_xlabel(), "length of a contact (frames)")


class Threads(unittest.TestCase):
    positions = (np.linspace(1, 1.1, 101)[:, None, None] * coil(frames=1, beads=400)
                 + np.random.default_rng(2).normal(scale=0.005, size=(101, 400, 3)))
    options = {"radius": 1.25, "structures": ["wrapped", "contacts", "closest"]}

    def test_they_do_not_change_the_run(self):
        one = kds.run(self.positions, threads=1, **self.options)
        two = kds.run(self.positions, threads=2, **self.options)
        self.assertEqual((one.summary["engine"]["threads"], two.summary["engine"]["threads"]), (1, 2))
        self.assertGreater(two.summary["engine"]["parts"], 1)
        self.assertEqual(two.fingerprint, one.fingerprint)
        assert_same(two.events, one.events)
        self.assertEqual(two.summary["closest_approach"]["beads"], one.summary["closest_approach"]["beads"])
        np.testing.assert_array_equal(two.frames, one.frames)
        for run in (one, two):  # where the run stands: at its end
            self.assertEqual(run.contacts.pairs().tolist(), one.contacts.pairs(frame=100).tolist())
            self.assertEqual(run.contacts.pairs(frame=3).tolist(), pairs_within(self.positions[3], 2.5, apart=2))
        self.assertIn("threads 2", str(two))

    def test_a_run_that_takes_one_says_so(self):
        positions = coil(beads=40)
        asked = {"radius": 1.1, "structures": ["contacts"], "threads": 2}
        for pattern, call in ((r"^threads 2: .*only", lambda: kds.run(positions, only={"contacts": range(9)}, **asked)),
                              (r"^threads 2: .*limit of exact work", lambda: kds.run(positions, work=10**12, **asked)),
                              (r"^threads 2: .*driven", lambda: kds.KineticRun(positions, **asked))):
            with self.assertWarnsRegex(kds.InputWarning, pattern):
                warnings.simplefilter("always")
                call()

    def test_analyses_take_them(self):
        spiral = kds.generate("spiral", beads=30, frames=9)
        rows = [kds.contacts(spiral, cutoff=4, by="bead", threads=threads).json["rows"] for threads in (1, 2)]
        self.assertEqual(*rows)
        events = [list(kds.compare(spiral, radius=1, strides=[1, 2], rounds=1, threads=threads).rows["events"])
                  for threads in (1, 2)]
        self.assertEqual(*events)


def page_of(text):
    """Returns what a page says about its run, and a function that returns the bytes of a block."""
    head = json.loads(re.search(r'<script type="application/json" id="kds-replay">(.*?)</script>', text, re.S)[1])
    blocks = dict(re.findall(r'<script type="text/plain" class="kds-block" id="kds-block-([^"]*)">(.*?)</script>', text, re.S))
    return head, lambda name: zlib.decompress(base64.b64decode(blocks[name]))


class Columns:
    """Reads the columns of a block of events, as docs/formats.md describes them."""

    def __init__(self, data):
        self._bytes = iter(data)

    def small(self, count):
        return [next(self._bytes) for _ in range(count)]

    def varints(self, count):
        return [self._varint() for _ in range(count)]

    def differences(self, count):
        return list(itertools.accumulate(self.varints(count), lambda sum, next: (sum + next) % 2**32))

    def _varint(self):
        value, shift = 0, 0
        for byte in self._bytes:
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                break
        return value >> 1 ^ -(value & 1)


def events_of_page(head, block):
    """Returns the events of a page in their order, as tuples of step, structure, kind, ids and bracket of u."""
    found = []
    for s, structure in enumerate(head["structures"]):
        count, columns = structure["events"], Columns(block(f"events-{s}"))
        orders, steps, times = columns.differences(count), columns.differences(count), columns.varints(count)
        reaches, kinds, _, sizes = (columns.small(count) for _ in range(4))
        ids = [[] for _ in range(count)]
        for place in range(max(sizes, default=0)):
            for own, size in zip(ids, sizes):
                if size > place:
                    own.append((columns.varints(1)[0] + (own[-1] if own else 0)) % 2**32)
        middle = 0
        for k, own in enumerate(ids):
            middle = times[k] + (middle if k > 0 and steps[k] == steps[k - 1] else 0)
            reach = 2**(reaches[k] - 1) if reaches[k] > 0 else 0
            found.append((orders[k], steps[k], structure["name"], structure["kinds"][kinds[k]]["name"],
                          np.array(own, dtype=np.uint32).astype(np.int32).tolist(),
                          ((middle - reach) / 2**32, (middle + reach) / 2**32)))
    return [event[1:] for event in sorted(found)]


class Views(unittest.TestCase):
    positions = coil(frames=8, beads=60)
    options = {"radius": 1.1, "structures": ["wrapped", "power", "contacts"]}

    def assert_shows(self, view, run):
        head, block = page_of(view.page)
        found = events_of_page(head, block)
        self.assertEqual(len(found), len(run.events))
        for (step, structure, kind, ids, bracket), event in zip(found, run.events):
            self.assertEqual((step, structure, kind), (event["step"], event["structure"], event["kind"]))
            self.assertEqual(ids, event["beads"][:len(ids)].tolist())
            self.assertTrue(bracket[0] <= event["lower"] <= event["upper"] <= bracket[1], (bracket, event))
        first = np.frombuffer(block("initial-2-0"), "<u4").reshape(-1, 2)
        self.assertEqual(sorted(first.tolist()), run.contacts.pairs(frame=0).tolist())

    def test_the_page_has_the_events_of_the_run(self):
        run = kds.run(self.positions, **self.options)
        events = run.events.copy()
        view = run.view()
        self.assertIsNone(view.path)
        self.assert_shows(view, run)
        assert_same(run.events, events)
        shown = html.unescape(re.search(r'<iframe srcdoc="([^"]*)"', view._repr_html_())[1])
        self.assertEqual(shown, view.page)

    def test_a_page_is_written_while_the_run_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "replay.html")
            run = kds.run(self.positions, view=path, **self.options)
            self.assertEqual(run.fingerprint, kds.run(self.positions, **self.options).fingerprint)
            written = os.stat(path).st_mtime_ns
            view = run.view()
            self.assertEqual((view.path, os.stat(path).st_mtime_ns), (path, written))
            self.assert_shows(view, run)
            np.testing.assert_array_equal(run.power.edges(frame=2), kds.power_diagram(self.positions[2], 1.1)[0])
            os.remove(path)
            other = os.path.join(folder, "other.html")
            self.assert_shows(run.view(other), run)
            self.assertEqual(os.listdir(folder), ["other.html"])

    def test_what_cannot_be_written_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            run = kds.run(self.positions.copy(), **self.options)
            for view in (os.path.join(folder, "none", "replay.html"), folder):
                with self.assertRaisesRegex(kds.InputError, "^view"):
                    kds.run(self.positions, view=view, **self.options)
                with self.assertRaisesRegex(kds.InputError, "^view"):
                    run.view(view)
            copy = os.path.join(folder, "md.pdb")
            shutil.copy(RESIDUES, copy)
            with self.assertRaisesRegex(kds.InputError, "md.pdb"):
                kds.run(copy, view=copy)
            with open(copy, "rb") as kept, open(RESIDUES, "rb") as original:
                self.assertEqual(kept.read(), original.read())

    def test_an_input_that_changed_is_not_shown(self):
        positions = self.positions.copy()
        run = kds.run(positions, **self.options)
        positions[3] += np.random.default_rng(1).normal(size=(60, 3))
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(kds.InputError, "the input has changed"):
                run.view(os.path.join(folder, "replay.html"))
            self.assertEqual(os.listdir(folder), [])

    def test_one_thread_writes_it(self):
        with tempfile.TemporaryDirectory() as folder, self.assertWarnsRegex(kds.InputWarning, "^threads 2: .*view"):
            warnings.simplefilter("always")
            kds.run(self.positions, view=os.path.join(folder, "replay.html"), threads=2, **self.options)


class StaticStructures(unittest.TestCase):
    def test_against_all_pairs(self):
        points = coil(frames=1, beads=50)[0]
        self.assertEqual(kds.colliding_pairs(points, 1).tolist(), pairs_within(points, 2, apart=2))
        self.assertEqual(kds.colliding_pairs(points, 1, within=0.5, apart=3).tolist(), pairs_within(points, 2.5, apart=3))
        first, second, distance = kds.closest_pair(points, 0.1, apart=2)
        lengths = {(i, j): np.linalg.norm(points[i] - points[j]) - 0.2
                   for i, j in itertools.combinations(range(50), 2) if j - i >= 2}
        self.assertEqual((first, second), min(lengths, key=lengths.get))
        self.assertAlmostEqual(distance, min(lengths.values()))

    def test_enclosing_sphere(self):
        points = np.random.default_rng(3).normal(size=(30, 3))
        center, radius, basis = kds.enclosing_sphere(points, 0.5)
        reach = np.linalg.norm(points - center, axis=1) + 0.5
        self.assertAlmostEqual(reach.max(), radius)
        np.testing.assert_allclose(reach[basis], radius)

    def test_in_the_plane(self):
        points = np.random.default_rng(4).normal(size=(20, 2))
        edges, hidden = kds.power_diagram(points, 0)
        self.assertEqual(edges.tolist(), delaunay_edges(points))
        self.assertEqual(len(hidden), 0)


class Analyses(unittest.TestCase):
    def test_contacts_are_those_of_the_program(self):
        expected = program("contacts", DCD, "--topology", PDB, "--frames", "0:60", "--cutoff", "8", "--select", "ca",
                           "--gap", "2")
        found = kds.contacts(DCD, topology=PDB, stop=60, cutoff=8, select="ca", gap=2)
        for name in ("rows", "all", "frames", "survival", "course"):
            self.assertEqual(found.json[name], expected[name])
        self.assertEqual(len(found.intervals), found.all["contacts"])
        self.assertAlmostEqual(float(np.sum(found.intervals["length"])), found.all["total"])
        self.assertEqual(found.map().shape, (len(found.names),) * 2)
        run = kds.run(DCD, topology=PDB, stop=60, select="ca", structures=["contacts"], cutoff=8, apart=3)
        self.assertEqual(run.contacts.analysis(gap=2).json["rows"], expected["rows"])
        self.assertEqual(len(run.contacts.lifetimes(by="bead", gap=2)), len(expected["rows"]))

    def test_lifetimes_are_of_the_pairs_of_the_run(self):
        for options in ({}, {"apart": 1}, {"apart": 5}, {"radius": 1.2}, {"groups": (range(10), range(8, 30))}, {"motion": "hermite"}):
            run = kds.run(coil(), structures=["contacts"], **{"cutoff": None if "radius" in options else 3, **options})
            intervals = run.contacts.analysis().intervals
            self.assertGreater(len(intervals), 20)
            for frame in (0, 2, 3.25, 4.5, 5):
                open_ = intervals[(intervals["begin_frame"] <= frame) & (intervals["end_frame"] >= frame)]
                with self.subTest(options=str(options), frame=frame):
                    self.assertEqual(sorted(zip(open_["i"], open_["j"])), sorted(map(tuple, run.contacts.pairs(frame))))
        group = universe().select_atoms("name CA")
        run = kds.run(group, structures=["contacts"], cutoff=8, stop=5)
        rows = run.contacts.lifetimes()  # by residue, each of one bead
        pairs = {tuple(pair) for frame in range(5) for pair in run.contacts.pairs(frame)}
        self.assertLessEqual(pairs, set(zip(rows["i"], rows["j"])))
        self.assertEqual((rows["j"] - rows["i"]).min(), 2)
        self.assertEqual((run.contacts.lifetimes(apart=4)["j"] - run.contacts.lifetimes(apart=4)["i"]).min(), 4)
        two = kds.run(np.stack([coil()[:, :, :], coil() + 3], axis=1).reshape(6, 60, 3), necklaces=[30, 30], cutoff=3,
                      structures=["contacts"], apart=4)
        self.assertEqual(len(two.contacts.lifetimes(by="chain")), 1)

    def test_lifetimes_of_other_paths_are_refused(self):
        for name, value in (("only", {"contacts": range(9)}), ("tolerance", 0.1)):
            run = kds.run(coil(), cutoff=3, structures=["contacts"], **{name: value})
            with self.assertRaisesRegex(kds.InputError, f"^{name}: lifetimes are of all beads .* without {name}$"):
                run.contacts.lifetimes()

    def test_warnings_of_a_run_are_not_repeated_by_its_lifetimes(self):
        broken = coil()
        broken[:, 15:] += 50
        run = kds.run(broken, cutoff=3, structures=["contacts"])
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            kds.run(broken, cutoff=3, structures=["contacts"])
            self.assertIn("chain break", str(caught[0].message))
            run.contacts.lifetimes()
        self.assertEqual(len(caught), 1, [str(warning.message) for warning in caught])

    def test_events_as_a_table(self):
        run = kds.run(coil(), radius=1, structures=["contacts", "power", "sorted"], times=np.arange(6) * 2.0)
        pandas = __import__("pandas")
        for events, frame in ((run.events, run.events_frame()), (run.contacts.events, run.contacts.events_frame()),
                              (run.events[:0], kds.run(coil()[[0, 0]], radius=1, structures=["contacts"]).events_frame())):
            self.assertIsInstance(frame, pandas.DataFrame)
            self.assertEqual(len(frame), len(events))
            self.assertEqual(list(frame.columns[:7]), ["frame", "time", "lower", "upper", "step", "structure", "kind"])
            for name in frame.columns[:7]:
                np.testing.assert_array_equal(frame[name].to_numpy(), events[name])
            ids = frame[[name for name in frame.columns if name.startswith("bead_")]].to_numpy()
            np.testing.assert_array_equal(ids, events["beads"][:, :ids.shape[1]])
            self.assertTrue((events["beads"][:, ids.shape[1]:] == -1).all())
        self.assertEqual(list(run.contacts.events_frame().columns[7:]), ["bead_0", "bead_1"])
        counted = run.events_frame().groupby(["structure", "kind"]).size()
        self.assertEqual(counted["contacts", "begin"], (run.contacts.events["kind"] == "begin").sum())

    def test_no_contacts_leave_an_empty_table(self):
        found = kds.contacts(coil(), cutoff=0.001)
        self.assertEqual(len(found.rows), 0)
        self.assertIn("contacts", list(found.rows.columns) if hasattr(found.rows, "columns") else found.rows.dtype.names)

    def test_certified_contacts_are_those_of_the_program(self):
        expected = program("contacts", DCD, "--topology", PDB, "--frames", "0:60:4", "--cutoff", "8", "--select", "ca",
                           "--certify")
        found = kds.contacts(DCD, topology=PDB, stop=60, step=4, cutoff=8, select="ca", certify=True)
        self.assertIn("sure", found.json["rows"][0])
        for name in ("rows", "all", "stride"):
            self.assertEqual(found.json[name], expected[name])

    def test_hints_are_those_of_the_program(self):
        given, options = [DCD, "--topology", PDB, "--frames", "0:3", "--select", "ca"], {"topology": PDB, "stop": 3, "select": "ca"}
        run = {"structures": ["contacts"]}
        for command, arguments, call in (
                ("run", ["--structures", "contacts", "--cutoff", "1"], lambda: kds.run(DCD, cutoff=1, **run, **options)),
                ("run", ["--structures", "contacts"], lambda: kds.run(DCD, **run, **options)),
                ("contacts", ["--cutoff", "1"], lambda: kds.contacts(DCD, cutoff=1, **options)),
                ("contacts", ["--cutoff", "8", "--apart", "99"],
                 lambda: kds.contacts(DCD, cutoff=8, apart=99, **options)),
                ("trade", ["--want", "contacts", "--rounds", "1", "--times", "2", "--without-exact"],
                 lambda: kds.trade(DCD, want=["contacts"], rounds=1, times_examined=2, without_exact=True, **options))):
            with self.subTest(command, arguments=arguments), warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                call()
                expected = program_warnings(command, *given, *arguments)
                self.assertGreater(len(expected), 0)
                self.assertEqual([str(warning.message) for warning in caught], expected)

    def test_approach_in_all_frames_is_that_of_the_program(self):
        expected = program("run", DCD, "--topology", PDB, "--frames", "0:31:3", "--structures", "closest", "--certify")
        found = kds.run(DCD, topology=PDB, stop=31, step=3, structures=["closest"], certify=True).summary
        self.assertIsNotNone(expected["closest_approach"])
        self.assertEqual(found["closest_approach"], expected["closest_approach"])

    def test_compare_update_collide_conditions(self):
        given = [DCD, "--topology", PDB, "--frames", "0:20"]
        options = {"topology": PDB, "stop": 20}
        for expected, found in (
                (program("compare", *given, "--rounds", "1", "--strides", "1,2"),
                 kds.compare(DCD, rounds=1, strides=[1, 2], **options)),
                (program("update", *given, "--rounds", "1"), kds.update(DCD, rounds=1, **options)),
                (program("collide", *given, "--method", "auto"), kds.collide(DCD, **options)),
                (program("info", *given), kds.conditions(DCD, **options))):
            with self.subTest(found=repr(found)):
                self.assertEqual(len(found.rows), len(expected["rows"]))
                names = {"structure", "events", "technique", "activated", "pairs", "colliding_frames", "violations"}
                for row, other in zip(found.json["rows"], expected["rows"]):
                    self.assertTrue(names & set(row))
                    self.assertEqual({name: row[name] for name in names & set(row)},
                                     {name: other[name] for name in names & set(other)})
        found = kds.collide(DCD, radius=3, **options)
        self.assertEqual(len(found.pairs), found.json["rows"][0]["pairs"])

    def test_generated_models(self):
        self.assertEqual(len(kds.generate("two-spirals", beads=40, frames=3)), 2)
        self.assertEqual(kds.generate("random-chain", beads=40, frames=3, seed=2).shape, (3, 40, 3))

    def test_levers(self):
        exact = kds.run(DCD, topology=PDB, stop=32, structures=["wrapped"])
        for options in ({"tolerance": 0.2}, {"between": "chord"}, {"levels": slice(0, 3)},
                        {"nodes": slice(10, 50)}):
            self.assertLess(len(kds.run(DCD, topology=PDB, stop=32, structures=["wrapped"], **options).events),
                            len(exact.events))
        certified = kds.run(DCD, topology=PDB, stop=31, step=3, structures=["contacts"], certify=True)
        self.assertEqual(certified.summary["stride"]["skipped"], 20)
        self.assertEqual(kds.run(DCD, topology=PDB, stop=8, kernel="exact").fingerprint,
                         kds.run(DCD, topology=PDB, stop=8, kernel="filtered", audit="frames").fingerprint)


class Driving(unittest.TestCase):
    positions = coil(frames=5, beads=25)

    def open(self, **options):
        return kds.KineticRun(self.positions, radius=1, structures=["contacts", "power"], **options)

    def test_pushed_in_a_cell(self):
        run = kds.KineticRun.pushed(2, 1, structures=["contacts"], cell=(10, 10, 10, 90, 90, 90), apart=1)
        run.push([[1, 5, 5], [5, 5, 5]])
        events = run.push([[1, 5, 5], [9, 5, 5]])      # at x = 9 the image at -1 touches the first bead
        self.assertEqual(events.size, 0)
        events = run.push([[1, 5, 5], [1, 5, 5]])      # wrapped: from 9 on to 11
        self.assertEqual(events["kind"].tolist(), ["begin"])
        events = run.push([[1, 5, 5], [1, 5, 5]], cell=(13, 10, 10, 90, 90, 90))  # moves with the cell, to 14
        self.assertEqual(events["kind"].tolist(), [])
        run.finish()

    def test_a_frame_that_a_cell_cannot_hold_changes_nothing(self):
        run = kds.KineticRun.pushed(2, 1, structures=["closest"], cell=(10, 10, 10, 90, 90, 90))
        run.push([[1, 5, 5], [5, 5, 5]])
        with self.assertRaisesRegex(kds.InputError, "^frame 1, bead 0: is more than 100000 times"):
            run.push([[1e7, 5, 5], [5, 5, 5]])
        with self.assertRaisesRegex(kds.InputError, "^frame 1: its cell changes"):
            run.push([[1, 5, 5], [5, 5, 5]], cell=(50, 50, 50, 90, 90, 90))
        run.push([[1, 5, 5], [5, 5, 5]])
        run.finish()
        with self.assertWarnsRegex(kds.InputWarning, "power ignores the images"):
            kds.KineticRun.pushed(4, 1, structures=["power"], cell=(10, 10, 10, 90, 90, 90))

    def test_edits_in_a_cell(self):
        water = os.path.join(DATA, "trajectories", "enkephalin_water")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            run = kds.KineticRun(water + ".xtc", topology=water + ".gro", select="//*", radius=1.7, stop=4,
                                 structures=["closest", "contacts"])
        for bead in (2, 90, 400):
            run.go_to(run.frame + 0.75)
            for name in run.structures:
                run.erase(name, bead)
                run.audit()
                run.insert(name, bead)
                run.audit()
            points = run.control_points()[[bead]]
            points[0, 0] += 0.5
            run.bend([bead], points)
            run.audit()
        run.finish()

    def test_pushed_in_a_planar_cell(self):
        run = kds.KineticRun.pushed(2, 1, structures=["contacts"], dimension=2, apart=1, cell=(10, 10, 9, 90, 90, 90))
        run.push([[1, 5], [5, 5]])
        self.assertEqual(run.push([[1, 5], [9.5, 5]])["kind"].tolist(), ["begin"])
        run.finish()

    def test_steps_events_and_times_are_those_of_a_run(self):
        expected = kds.run(self.positions, radius=1, structures=["contacts", "power"])
        by_steps = self.open()
        parts = []
        while (events := by_steps.step()) is not None:
            parts.append(events)
        by_steps.finish()
        assert_same(np.concatenate(parts), expected.events)
        self.assertEqual(by_steps.fingerprint, expected.fingerprint)
        by_events = self.open()
        parts = []
        while (events := by_events.next_event()) is not None:
            self.assertEqual(len(set(events["lower"])), 1)
            self.assertAlmostEqual(by_events.frame, events["frame"][0], places=9)
            parts.append(events)
        assert_same(np.concatenate(parts), expected.events)
        by_events.audit()

    def test_going_back_repeats_the_events(self):
        run = self.open()
        first = run.go_to(2.5)
        later = run.go_to(4)
        self.assertEqual(len(run.go_to(1)), 0)
        self.assertEqual(run.frame, 1.0)
        again = np.concatenate([run.go_to(2.5), run.go_to(4)])
        assert_same(again, np.concatenate([first, later])[len(first[first["frame"] < 1]):])

    def test_pushed_frames(self):
        expected = kds.run(self.positions, radius=1, structures=["contacts", "power"])
        run = kds.KineticRun.pushed(25, 1, structures=["contacts", "power"])
        parts = [run.push(frame, time=10.0 * k) for k, frame in enumerate(self.positions)]
        parts.append(run.finish())
        events = np.concatenate(parts)
        np.testing.assert_array_equal(events["beads"], expected.events["beads"])
        np.testing.assert_allclose(events["time"], 10 * events["frame"])
        self.assertEqual(run.fingerprint, expected.fingerprint)

    def test_beads_come_go_and_bend(self):
        run = self.open()
        run.go_to(1.5)
        before = run.contacts.pairs()
        bead = int(before[0, 0])
        lost = run.erase("contacts", bead)
        self.assertIn("end", set(lost["kind"]))
        self.assertFalse((run.contacts.pairs() == bead).any())
        run.insert("contacts", bead)
        np.testing.assert_array_equal(run.contacts.pairs(), before)
        points = run.control_points()[[3]]
        run.bend([3], points)  # the same curve
        run.audit()
        with self.assertRaises(kds.InputError):
            run.bend([3], points[:, :1])
        run.erase("power", 3)
        self.assertFalse((run.power.edges() == 3).any())
        run.audit()

    def test_looking_at_the_next_step_changes_nothing(self):
        run = kds.KineticRun(np.random.default_rng(1).normal(size=(6, 8, 3)).cumsum(axis=0), radius=1.5, structures=["wrapped"])
        run.go_to(2)
        spheres = run.wrapped.spheres()
        points = run.control_points()
        self.assertEqual(points.shape, (8, 2, 3))
        np.testing.assert_array_equal(run.wrapped.spheres(), spheres)
        run.audit()
        run.go_to(2.5)
        np.testing.assert_array_equal(run.control_points(), points)
        run.finish()
        with self.assertRaisesRegex(kds.InputError, "^no step follows this frame"):
            run.control_points()

    def test_edits_are_logged_and_replayed(self):
        with tempfile.TemporaryDirectory() as folder:
            log = os.path.join(folder, "edited.kdslog")
            options = {"topology": PDB, "radius": 2, "structures": ["contacts", "power"], "stop": 6}
            run = kds.KineticRun(DCD, log=log, **options)
            run.go_to(1.5)
            run.erase("contacts", 3)
            run.next_event()
            points = run.control_points()[[5]]
            points[0, 0] += 1
            run.bend([5], points)
            run.go_to(3.25)
            run.insert("contacts", 3)
            with self.assertRaisesRegex(kds.InputError, "^frame: a run that writes a log cannot go back"):
                run.go_to(1)
            self.assertFalse(os.path.exists(log))
            run.finish()
            found = kds.replay(log)
            self.assertTrue(found["same"], found["difference"])
            self.assertEqual(found["logged_fingerprint"], run.fingerprint)
            self.assertTrue(program("replay", log)["replay"]["same"])
            kds.KineticRun(DCD, log=log, **options).finish()  # takes the place of the first log
            self.assertTrue(kds.replay(log)["same"])
            run = kds.KineticRun(DCD, log=log, **options)
            run.go_to(1.5)
            run.erase("contacts", 3)
            run.finish()
            text = Path(log).read_text()
            self.assertEqual(text.count("\nedit "), 1)
            Path(log).write_text(text.replace("erase contacts 3", "erase contacts 4"))
            with self.assertRaisesRegex(kds.InputError, r"edited.kdslog:\d+: the lines of step 1 are not those"):
                kds.replay(log)
            for source, more in ((self.positions, {}), (DCD, {"topology": PDB, "only": {"contacts": [1, 2, 3]}})):
                with self.assertRaisesRegex(kds.InputError, "^log: needs a path as input and all beads"):
                    kds.KineticRun(source, radius=2, structures=["contacts"], log=log, **more)

    def test_structures_of_some_beads(self):
        run = kds.KineticRun(self.positions, radius=1, cutoff=4, structures=["contacts"], only={"contacts": range(10)})
        run.finish()
        self.assertEqual(run.contacts.pairs().tolist(), pairs_within(self.positions[4][:10], 4, apart=2))


class Impacts(unittest.TestCase):
    def queries(self, kind):
        """Returns the public queries: points (queries, 2, 4, 3), and which features meet."""
        points, answers = [], []
        for path in sorted((Path(DATA) / "ccd").glob(f"*/{kind}/*")):
            with gzip.open(path, "rt") if path.suffix == ".gz" else open(path) as file:
                for row in csv.reader(file):
                    numbers = [int(number) for number in row]
                    points.append([numbers[k] / numbers[k + 1] for k in (0, 2, 4)])
                    answers.append(numbers[6] == 1)
        return np.reshape(points, (-1, 2, 4, 3)), np.array(answers[::8])

    def test_they_answer_public_queries(self):
        for kind in ("edge-edge", "vertex-face"):
            points, answers = self.queries(kind)
            first = kds.impacts(kind, points[:, 0], points[:, 1])
            self.assertEqual(sorted(first["query"]), np.flatnonzero(answers).tolist())
            every = kds.impacts(kind, points[:, 0], points[:, 1], all=True)
            starts = np.unique(every["query"], return_index=True)[1]
            np.testing.assert_array_equal(every[starts], first)

    def test_curves_pass_twice(self):
        rest = [[-1, 0, 0], [1, 0, 0]]
        falls = [np.array([[*rest, [0, -1, z], [0, 1, z]]], float) for z in (1, -2, 1)]  # a parabola
        times = kds.impacts("edge-edge", *falls, all=True)
        np.testing.assert_allclose(0.5 * (times["lower"] + times["upper"]), [0.5 - 12**-0.5, 0.5 + 12**-0.5])
        self.assertTrue(times["passes"].all())

    def test_other_arrays_are_refused(self):
        good = np.zeros((2, 4, 3))
        for wrong, text in (((good,), "points: found 1"), ((good, good[:1]), "points 1: has the shape"),
                            ((good, good + np.nan), "points 1: has a number that is not finite in query 0"),
                            ((good[0], good[0]), "points 0: has the shape"), ((good,) * 22, "points: found 22"), ((good, "no"), "points 1")):
            with self.assertRaisesRegex(kds.InputError, text):
                kds.impacts("edge-edge", *wrong)
        with self.assertRaisesRegex(kds.InputError, "above 2.53"):
            kds.impacts("edge-edge", good.astype(int) + 2**53 + 1, good)
        with self.assertRaisesRegex(kds.InputError, "kind: is 'edges'"):
            kds.impacts("edges", good, good)
        self.assertEqual(len(kds.impacts("edge-edge", good[:0], good[:0])), 0)


@unittest.skipUnless("nearest" in kds.structure_names(), "the module is built without tests/python/nearest_structure.cpp")
class OwnStructure(unittest.TestCase):
    def test_it_is_one_of_the_structures(self):
        positions = coil(frames=8, beads=40)
        run = kds.run(positions, structures=["nearest"], radius=1)
        self.assertGreater(len(run.events), 0)
        self.assertEqual(set(run.events["kind"]), {"overtake"})
        for frame in range(1, 8):
            lengths = np.linalg.norm(positions[frame, 1:] - positions[frame, 0], axis=1)
            self.assertEqual(run.nearest.elements(frame)[0, 0], 1 + np.argmin(lengths))


class Memory(unittest.TestCase):
    def test_it_is_flat_over_a_hundred_runs(self):
        positions = coil(frames=6, beads=40)

        def one():
            run = kds.run(positions, radius=1, structures=["power", "contacts"])
            run.power.edges(frame=3)
            return run.events

        for _ in range(20):
            one()
        gc.collect()
        before = resident_bytes()
        for _ in range(100):
            one()
        gc.collect()
        self.assertLess(resident_bytes() - before, 3e6)

    def test_arrays_outlive_their_run(self):
        run = kds.run(coil(), radius=1, structures=["power", "wrapped"])
        edges, spheres, events = run.power.edges(frame=2), run.wrapped.spheres(frame=2), run.events
        kept = edges.copy(), spheres.copy(), events.copy()
        del run
        gc.collect()
        junk = [np.ones(1000) for _ in range(1000)]
        for array, copy in zip((edges, spheres, events), kept):
            assert_same(array, copy)
        del junk

    def test_the_input_lives_as_long_as_its_run(self):
        run = kds.run(coil() + 0.0, radius=1, structures=["power"])
        gc.collect()
        np.testing.assert_array_equal(run.power.edges(frame=2), kds.power_diagram(coil()[2], 1)[0])


class Surfaces(unittest.TestCase):
    def test_two_balls_have_a_closed_form(self):
        positions = np.array([[[0, 0, 0], [6, 0, 0]], [[0, 0, 0], [2, 0, 0]]], dtype=float)
        found = kds.surface(positions, radius=2, at=[0, 0.75, 1])  # the distances are 6, 3 and 2
        height = np.array([0, 0.5, 1])  # of the cap that each ball loses
        np.testing.assert_allclose(found.areas, np.outer(16 * np.pi - 4 * np.pi * height, [1, 1]), rtol=1e-12)
        np.testing.assert_allclose(found.volumes, np.outer(32 / 3 * np.pi - np.pi / 3 * height**2 * (6 - height), [1, 1]))
        np.testing.assert_allclose(found.frames, [0, 0.75, 1])
        self.assertEqual(found.contacts.tolist(), [[0, 1], [0, 1]])
        np.testing.assert_allclose(found.contact_areas, np.pi * (4 - (2 - height[1:])**2))
        self.assertEqual(found.contact_times.tolist(), [1, 2])

    def test_residues_and_chains_are_sums_of_atoms(self):
        found = kds.surface(os.path.join(DATA, "paper", "1a4y_AB.pdb"), chain="A,B")
        atoms, residues, contacts = found.atoms_frame(), found.residues_frame(), found.contacts_frame()
        chains = np.asarray(atoms["chain"])
        for name in ("area", "volume"):
            self.assertAlmostEqual(np.sum(atoms[name]), found.rows[name][0], places=6)
            self.assertAlmostEqual(np.sum(residues[name]), found.rows[name][0], places=6)
        first = np.asarray(residues["name"]) == np.asarray(residues["name"])[0]
        of_first = [str(name).endswith("of SER 1 in chain A") for name in atoms["name"]]
        self.assertAlmostEqual(np.asarray(residues["area"])[first].sum(), np.asarray(atoms["area"])[of_first].sum(), places=9)
        between = chains[np.asarray(contacts["i"])] != chains[np.asarray(contacts["j"])]
        self.assertAlmostEqual(np.asarray(contacts["area"])[between].sum(), found.rows["between_chains"][0], places=6)
        self.assertGreater(found.rows["between_chains"][0], 1000)

    def test_it_equals_the_program(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = kds.surface(DCD, topology=PDB, stop=4, threads=2)
        rows = program("surface", DCD, "--topology", PDB, "--frames", "0:4", "--threads", "1")["rows"]
        self.assertEqual(found.json["rows"], rows)
        self.assertEqual(found.unit, "angstrom")


class CavitiesOfVoids(unittest.TestCase):
    def test_they_equal_the_program(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = kds.voids(DCD, topology=PDB, stop=60)
        json = program("voids", DCD, "--topology", PDB, "--frames", "0:60")
        for name in ("rows", "stretches", "volumes", "frames", "lives", "tunnels"):
            self.assertEqual(found.json[name], json[name], name)
        self.assertGreater(len(found.rows), 0)
        self.assertEqual(len(found.stretches), found.lives["all"])
        self.assertEqual(found.tunnels, json["tunnels"])

    def test_tables_without_rows_have_columns(self):
        found = kds.voids(np.array([[[0.0, 0, 0], [6, 0, 0], [0, 6, 0], [0, 0, 6]]] * 2), radius=1)
        self.assertEqual(len(found.rows), 0)
        for rows, column in ((found.rows, "volume_most"), (found.stretches, "end_names"), (found.volumes, "area")):
            self.assertEqual(len(rows[column]), 0)


if __name__ == "__main__":
    unittest.main()
