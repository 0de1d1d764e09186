"""Wrong input gives one clear error and leaves nothing behind."""

import signal
import subprocess
import sys
import threading
import time
import unittest
import warnings

import numpy as np

import kds
from data import DCD, PDB, coil


class Errors(unittest.TestCase):
    def refused(self, pattern, call, *given, error=kds.InputError, **options):
        with self.assertRaisesRegex(error, pattern) as caught:
            call(*given, **options)
        self.assertNotIn("\n", str(caught.exception))
        self.assertNotIn("--", str(caught.exception))

    def test_arrays(self):
        run = kds.run
        bad = coil()
        bad[3, 4, 1] = np.nan
        self.refused(r"^array: frame 3: bead 4 has y = nan, expected a finite coordinate$", run, bad, radius=1)
        self.refused(r"no frames; expected two or more", run, np.zeros((0, 5, 3)))
        self.refused(r"no beads; expected two or more", run, np.zeros((5, 0, 3)))
        self.refused(r"frame", run, coil()[:1], radius=1)
        self.refused(r"shape \(30, 3\); expected \(frames, beads, 3\)", run, coil()[0])
        self.refused(r"shape \(6, 30, 2\); expected \(frames, beads, 3\)", run, np.zeros((6, 30, 2)))
        self.refused(r"is masked", run, np.ma.masked_less(coil(), -1))
        self.refused(r"times; expected 6", run, coil(), times=[1.0, 2.0], radius=1)
        self.refused(r"necklaces have 29 beads; expected 30", run, coil(), necklaces=[10, 19])
        self.refused(r"radii; expected 30", run, coil(), radius=[1.0, 2.0])
        self.refused(r"expected finite numbers from 0", run, coil(), radius=[-1.0] * 30)

        self.refused(r"in a plane have 0", run, np.zeros((6, 30, 2)))
        for dtype, pattern in ((bool, "dtype bool"), (complex, "dtype complex128"), (object, "dtype object"),
                               ("U8", "dtype <U8"), (np.longdouble, "which float64 would round; expected float32")):
            self.refused(f"^array: has the {pattern}" if "dtype" in pattern else f"^array: .*{pattern}", run,
                         coil().astype(dtype), radius=1)
        self.refused(r"^array: has whole numbers above 2\^53", run, np.full((6, 30, 3), 2**53 + 1), radius=1)
        self.refused(r"^array: has whole numbers above 2\^53", run, np.full((6, 30, 3), np.iinfo(np.int64).min), radius=1)
        self.refused(r"^radius: is empty", run, coil(), radius=[])
        self.refused(r"^radius: has the dtype <U1", run, coil(), radius=["a"] * 30)
        self.refused(r"^frame 0: has the dtype object", run, [None, None])
        self.refused(r"^frame 0: has rows of different lengths", run, iter([[[1, 2, 3], [1, 2]]] * 2))
        self.refused(r"^frame 1: time: is 'late'", run, iter([(coil()[0], 0.0), (coil()[1], "late")]))
        self.refused(r"^dict: is no input", run, {"positions": coil()})

    def test_numbers_are_not_rounded_or_guessed(self):
        dates = np.array(["2026-11-26"] * 6, dtype="M8[ns]")
        self.refused(r"^start: is 1.5; expected a whole number", kds.run, coil(), start=1.5)
        self.refused(r"^start: is 1.5; expected a whole number", kds.run, DCD, topology=PDB, start=1.5)
        self.refused(r"^stop: is 3; expected a number above start", kds.run, DCD, topology=PDB, start=5, stop=3)
        self.refused(r"^necklaces: is 15.5", kds.run, coil(), necklaces=[15.5, 15.5])
        self.refused(r"^necklaces: is -1", kds.run, coil(), necklaces=[-1, 31])
        self.refused(r"^times: has the dtype datetime64", kds.run, coil(), times=dates)
        self.refused(r"^times: is nan", kds.run, coil(), times=[np.nan] * 6)
        self.refused(r"^times: has 0 times; expected 6", kds.run, coil(), times=[])
        self.refused(r"^only: contacts: is 1.5", kds.run, coil(), structures=["contacts"], only={"contacts": [1.5]})
        self.refused(r"^groups: a mask has the shape \(29,\)", kds.run, coil(), structures=["contacts"],
                     groups=(np.ones(30, bool), np.ones(29, bool)))
        self.refused(r"has a step", kds.run, coil(), structures=["wrapped"], levels=slice(0, 3, 2))
        self.refused(r"^cutoff: is True", kds.run, coil(), cutoff=True)
        self.refused(r"^cutoff: is None", kds.contacts, coil(), cutoff=None)
        self.refused(r"^cutoff: '1e\+300' is not a number from 0", kds.run, coil(), cutoff=1e300, structures=["contacts"])
        self.refused(r"^surface: is 'no'", kds.run, coil(), cutoff=3, structures=["contacts"], surface="no")
        self.refused(r"expected a list$", kds.contacts, coil(), cutoff=3, strides={1, 2})
        self.refused(r"^surface: is 'no'", kds.contacts, coil(), cutoff=3, surface="no")
        self.refused(r"^certify: is 'yes'; expected True or False", kds.contacts, coil(), cutoff=3, certify="yes")
        self.refused(r"^until_damage: is .*; expected True or False", kds.run, PDB, until_damage=PDB)
        self.refused(r"^apart: is True", kds.run, coil(), radius=1, structures="contacts", apart=True)
        self.refused(r"^groups: are not two", kds.run, PDB, structures="contacts", groups=["a"])
        self.refused(r"^levels: is \(0, 2\); expected slice", kds.run, coil(), radius=1, levels=(0, 2))
        self.refused(r"^select: 'CB' is not one of", kds.run, PDB, select="CB")
        self.refused(r"^gap: is array", kds.contacts, coil(), cutoff=3, gap=np.ones(2))
        self.refused(r"expected by bead, or an AtomGroup or mdtraj", kds.contacts, coil(), cutoff=3, by="residue")
        self.refused(r"^centers: is masked", kds.power_diagram, np.ma.masked_less(coil()[0], 0), 1)
        self.refused(r"^centers: has the dtype complex128", kds.enclosing_sphere, coil()[0] * 1j, 1)
        self.refused(r"^apart: is 1.5", kds.colliding_pairs, coil()[0], 1, apart=1.5)

    def test_a_path_is_no_option(self):
        self.refused(r"-radius.xtc: cannot open this file", kds.run, "-radius.xtc")
        self.refused(r"no path in UTF-8", kds.run, "a\0b.xtc")
        self.refused(r"no path in UTF-8", kds.run, "\udcff.xtc")
        self.refused(r"is no argument", kds.run, coil(), **{"radius ": 1}, error=TypeError)

    def test_pushed_and_driven_runs(self):
        pushed = kds.KineticRun.pushed
        self.refused(r"^beads: is -1", pushed, -1, 1)
        self.refused(r"^cutoff: '-3' is not a number from 0", pushed, 30, 1, cutoff=-3, structures=["contacts"])
        self.refused(r"^dt: is for inputs that have their frames", pushed, 30, 1, dt=2)
        self.refused(r"^cell: expected three lengths", pushed, 30, 1, cell=(9, 9), structures=["contacts"])
        self.refused(r"^frame 0: cell: expected three lengths",
                     lambda: pushed(30, 1, structures=["contacts"]).push(coil()[0], cell=(9, 9, 9)))
        self.refused(r"^frame 0: expected a cell that is periodic along the same vectors",
                     lambda: pushed(30, 1, structures=["contacts"]).push(coil()[0], cell=(9, 9, 9, 90, 90, 90)))
        self.refused(r"^frame 0: time: is 'x'", pushed(30, 1, structures=["power"]).push, coil()[0], "x")
        self.refused(r"^frame 0: has the dtype complex128", pushed(30, 1, structures=["power"]).push, coil()[0] * 1j)
        run = kds.KineticRun(coil(), radius=1, structures=["contacts", "power"])
        run.go_to(2.5)
        self.refused(r"there is no bead 99", run.erase, "contacts", 99)
        self.refused(r"^bead: is 1.5", run.erase, "contacts", 1.5)
        self.refused(r"not a finite number", run.bend, [3], run.control_points()[[3]] * np.nan)
        self.refused(r"^frame: is '3'", run.go_to, "3")
        self.refused(r"contacts has no spheres", run.contacts.spheres, error=AttributeError)
        self.refused(r"^start: is -1", lambda: list(kds.stream(iter(coil()), radius=1, start=-1)))
        self.refused(r"^int: is no input", lambda: list(kds.stream(17, radius=1)))

    def test_lifetimes_keep_the_input_of_their_run(self):
        run = kds.run(coil(), radius=1, structures=["contacts"], cutoff=3, apart=3)
        self.refused(r"^radius: is that of the run", run.contacts.lifetimes, radius=2)
        both = kds.contacts(coil(), cutoff=(2.5, 3.5), surface=True).json["rows"]
        self.assertEqual(run.contacts.analysis(cutoff=(2.5, 3.5)).json["rows"],
                         kds.contacts(coil(), cutoff=(2.5, 3.5)).json["rows"])
        self.assertEqual(kds.run(coil(), radius="auto", structures=["contacts"], apart=3).contacts.analysis(
            cutoff=(2.5, 3.5), surface=True).json["rows"], both)

    def test_warnings_of_lifetimes_and_their_place(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            run = kds.run(coil(), cutoff=0.01, structures=["contacts"])
            run.contacts.lifetimes()
            run.contacts.lifetimes(cutoff=0.02)
        self.assertTrue(any("contacts within cutoff 0.02" in str(warning.message) for warning in caught))
        self.assertEqual({warning.filename for warning in caught}, {__file__})

    def test_a_comparison_names_its_input_in_memory(self):
        found = kds.compare(coil(), radius=1, rounds=1, structures=["power"])
        self.assertEqual(list(found.rows["input"]), ["array"])
        self.assertTrue(str(found).startswith("array, linear motion"))

    def test_one_bead(self):
        self.refused(r"bead", kds.run, coil(beads=1))

    def test_units(self):
        self.refused(r"units: is 'pm'; expected angstrom or nm", kds.run, coil(), units="pm")

    def test_options_have_no_dashes(self):
        self.refused(r"^radius: .*", kds.run, coil(), radius=-1)
        self.refused(r"^structures: .*vorono.*", kds.run, coil(), structures=["vorono"])
        self.refused(r"^kernel: .*", kds.run, coil(), kernel="quick")
        self.refused(r"apart: applies only to contacts", kds.run, coil(), apart=3, structures=["power"])
        self.refused(r"^model: 'spirl' .* did you mean spiral\?", kds.generate, "spirl", beads=30)
        self.refused(r"frame: 9 is outside the run, which goes from frame 1 to 5",
                     kds.run(coil(), radius=1, start=1, step=2, structures=["power"]).power.edges, 9)
        self.refused(r"frame: 1 is outside the run, which goes from frame 2 to 4",
                     kds.KineticRun(coil(), radius=1, start=2, stop=5).go_to, 1)
        self.refused(r"topology: is for files", kds.run, coil(), topology=PDB)
        self.refused(r"expected start, stop, step", kds.run, coil(), frames="1:2", error=TypeError)
        self.refused(r"results are attributes", kds.run, coil(), out="folder", error=TypeError)
        self.refused(r"^cutoff: '-1' is not a number from 0", kds.run, coil(), cutoff=-1)
        self.refused(r"cutoff: is \(4, 6\); expected one length", kds.run, coil(), cutoff=(4, 6))
        self.refused(r"^surface: .*expected cutoff", kds.run, coil(), surface=True)
        self.refused(r"certify: .* expected step above 1, or tolerance", kds.run, coil(), radius=1, certify=True)
        self.refused(r"is no input; expected a path", kds.run, 17)
        self.refused(r"step: is 0; expected a whole number from 1", kds.run, coil(), step=0)
        self.refused(r"no frame of array is chosen, which has 6", kds.run, coil(), start=10)
        self.refused(r"stop: is -1; expected a number from 0 for a file", kds.run, DCD, stop=-1)
        self.refused(r"missing\.xyz", kds.run, "missing.xyz")
        self.refused(r"start, stop, step: ", kds.run, DCD, topology=PDB, stop=10 ** 9)
        self.refused(r"the run has no hull; it has power", kds.run(coil(), radius=1, structures=["power"])._core.elements,
                     "hull", 0)
        self.refused(r"beads: give the number of beads", kds.generate, "spiral")
        self.refused(r"frames: ", kds.generate, "spiral", beads=30, frames=0)

    def test_unknown_arguments_are_type_errors(self):
        driven, group = kds.KineticRun, kds.run(coil(), cutoff=3, structures=["contacts"]).contacts
        for call, name, pattern in (
                (kds.run, "until_damages", r"of kds.run, did you mean until_damage\? \(see help\(kds.run\)\)$"),
                (kds.run, "cutof", r"did you mean cutoff\?"),
                (kds.run, "pull", r"of kds.run \(see help"),
                (kds.run, "rounds", r"kds.compare takes it$"),
                (kds.run, "help", r"explains all arguments$"),
                (kds.Run, "structure", r"of kds.Run, did you mean structures\?"),
                (driven, "view", r"of kds.KineticRun; results are attributes"),
                (driven, "kernal", r"did you mean kernel\?"),
                (driven.pushed, "aparts", r"of kds.KineticRun.pushed, did you mean apart\?"),
                (kds.stream, "radus", r"did you mean radius\?"),
                (lambda source, **options: kds.contacts(source, cutoff=3, **options), "intermitency", r"mean intermittency\?"),
                (lambda source, **options: kds.contacts(source, cutoff=3, **options), "events", r"results are attributes"),
                (kds.compare, "groups", r"of kds.compare"),
                (kds.update, "technique", r"did you mean techniques\?"),
                (kds.collide, "methods", r"did you mean method\?"),
                (kds.trade, "wants", r"did you mean want\?"),
                (kds.conditions, "roh", r"did you mean rho\?"),
                (lambda source, **options: kds.generate("spiral", beads=9, **options), "frame", r"mean frames\?"),
                (lambda source, **options: group.lifetimes(**options), "stride", r"did you mean strides\?"),
                (lambda source, **options: group.analysis(**options), "gaps", r"did you mean gap\?")):
            self.refused(f"^{name}: is no argument .*{pattern}", call, coil(), error=TypeError, **{name: 1})

    def test_iterators(self):
        def failing():
            yield coil()[0]
            raise ZeroDivisionError("the simulation broke")

        self.refused("the simulation broke", kds.run, failing(), error=ZeroDivisionError)
        self.refused("the simulation broke", lambda: list(kds.stream(failing(), radius=1)), error=ZeroDivisionError)
        self.refused(r"shapes .*expected one shape", kds.run, iter([coil()[0], coil()[0][:5]]))
        self.refused(r"frame 1: has the shape \(5, 3\); expected \(30, 3\)",
                     lambda: list(kds.stream(iter([coil()[0], coil()[0][:5]]), radius=1)))
        self.refused(r"there are none", lambda: list(kds.stream(iter([]), radius=1)))
        self.refused(r"radius: frames that come one by one", lambda: list(kds.stream(iter(coil()))))

    def test_a_wrong_frame_changes_nothing(self):
        run = kds.KineticRun.pushed(30, 1, structures=["power"])
        run.push(coil()[0])
        with self.assertRaises(kds.InputError):
            run.push(np.full((30, 3), np.inf))
        run.push(coil()[1])
        run.finish()
        self.assertEqual(run.fingerprint, kds.run(coil()[:2], radius=1, structures=["power"]).fingerprint)

    def test_failures_leak_nothing(self):
        from test_runs import resident_bytes

        bad = np.random.default_rng(5).normal(size=(40, 2000, 3))
        bad[39, 7, 0] = np.inf

        def fail():
            try:
                kds.run(bad, radius=1)
            except kds.InputError:
                return
            self.fail("not refused")

        for _ in range(10):
            fail()
        before = resident_bytes()
        for _ in range(50):
            fail()
        self.assertLess(resident_bytes() - before, 3e6)


class Interrupts(unittest.TestCase):
    positions = np.random.default_rng(6).normal(size=(2000, 300, 3)).cumsum(axis=1)
    balls = np.random.default_rng(7).normal(size=(400000, 3))

    def interrupted(self, call):
        """Interrupts a call that takes seconds."""
        raised = []

        def interrupt():
            raised.append(time.process_time())
            signal.raise_signal(signal.SIGINT)

        timer = threading.Timer(0.15, interrupt)
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                call()
            # Processor time does not depend on other work. Without such work, the elapsed time is about 0.1 s.
            self.assertLess(time.process_time() - raised[0], 1.0)
        finally:
            timer.cancel()
            timer.join()

    def test_ctrl_c_ends_every_analysis(self):
        of_runs = {"radius": 1, "structures": ["power", "contacts"]}
        calls = {
            "contacts": lambda threads: kds.contacts(self.positions, cutoff=6, by="bead", threads=threads),
            "compare": lambda threads: kds.compare(self.positions, **of_runs, threads=threads),
            "run": lambda threads: kds.run(self.positions, **of_runs, threads=threads),
        }
        for name, call in calls.items():
            for threads in (1, 2):
                with self.subTest(name, threads=threads):
                    self.interrupted(lambda: call(threads))
        calls = {
            "trade": lambda: kds.trade(self.positions, radius=1),
            "update": lambda: kds.update(self.positions, radius=1),
            "collide": lambda: kds.collide(self.positions, radius=1, method="all"),
            "surface": lambda: kds.surface(self.positions, radius=1),
            "voids": lambda: kds.voids(self.positions, radius=1),
            "conditions": lambda: kds.conditions(self.positions, radius=1),
            "generate": lambda: kds.generate("random-chain", beads=20000, frames=2000),
            "exact": lambda: kds.run(self.positions, radius=1, structures=["power"], kernel="exact", threads=1),
            "stepping": lambda: kds.KineticRun(self.positions, **of_runs).go_to(1999),
            "stream": lambda: list(kds.stream(iter(self.positions), **of_runs)),
        }
        for name, call in calls.items():
            with self.subTest(name):
                self.interrupted(call)

    def test_ctrl_c_ends_static_structures(self):
        calls = {
            "diagram": lambda: kds.power_diagram(self.balls, 0.001),
            "pairs": lambda: kds.colliding_pairs(self.balls[:60000], 1),
            "first step": lambda: kds.run(self.balls[:200000].reshape(2, -1, 3), radius=0.01, structures=["power"]),
        }
        for name, call in calls.items():
            with self.subTest(name):
                self.interrupted(call)

    def test_progress_may_raise(self):
        run = kds.KineticRun(coil(frames=200, beads=200), radius=1, structures=["power"])

        def stop(done, within, total):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            run._core.execute(stop)


class Exits(unittest.TestCase):
    def test_runs_may_outlive_the_interpreter(self):
        code = """
import kds, sys
class Kept:
    pass
kept = Kept()
kept.itself = kept
kept.run = kds.run(kds.generate("spiral", beads=30, frames=5), radius=1)
sys.modules["builtins"].kept = kept
"""
        self.assertEqual(subprocess.run([sys.executable, "-c", code], check=False).returncode, 0)


class Threads(unittest.TestCase):
    def test_a_run_is_read_by_one_thread(self):
        run, refused = kds.KineticRun(coil(frames=60, beads=120), radius=1, structures=["power"]), []

        def look(done, within, total):
            for read in (run._core.take_events, run._core.control_points, lambda: run.frame, lambda: run.fingerprint):
                try:
                    read()
                except RuntimeError as error:
                    refused.append(str(error))

        run._core.execute(look)
        self.assertGreaterEqual(len(refused), 4)
        self.assertIn("this run is in use", refused[0])

    def test_two_threads_find_what_one_finds(self):
        positions = coil(frames=40, beads=120)
        expected = kds.run(positions, radius=1).fingerprint
        found = []
        threads = [threading.Thread(target=lambda: found.append(kds.run(positions, radius=1).fingerprint))
                   for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [expected, expected])


if __name__ == "__main__":
    unittest.main()
