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
        self.refused(r"dtype int64; expected float32 or float64", run, np.zeros((6, 30, 3), dtype=int))
        self.refused(r"C order; expected numpy.ascontiguousarray\(positions\)", run, np.asfortranarray(coil()))
        self.refused(r"C order", run, coil()[:, ::2])
        self.refused(r"is masked", run, np.ma.masked_less(coil(), -1))
        self.refused(r"times; expected 6", run, coil(), times=[1.0, 2.0], radius=1)
        self.refused(r"necklaces have 29 beads; expected 30", run, coil(), necklaces=[10, 19])
        self.refused(r"radii; expected 30", run, coil(), radius=[1.0, 2.0])
        self.refused(r"expected finite numbers from 0", run, coil(), radius=[-1.0] * 30)

    def test_one_bead(self):
        self.refused(r"bead", kds.run, coil(beads=1))

    def test_units(self):
        with self.assertWarnsRegex(kds.InputWarning, r"median bond is 0\.\d+ angstrom.*expected units='nm'"):
            warnings.simplefilter("always")
            kds.run(coil() / 10, radius=1, structures=["sorted"])
        self.refused(r"units: is 'pm'; expected angstrom or nm", kds.run, coil(), units="pm")

    def test_options_have_no_dashes(self):
        self.refused(r"^radius: .*", kds.run, coil(), radius=-1)
        self.refused(r"^structures: .*vorono.*", kds.run, coil(), structures=["vorono"])
        self.refused(r"^kernel: .*", kds.run, coil(), kernel="quick")
        self.refused(r"apart: applies only to contacts", kds.run, coil(), apart=3, structures=["power"])
        self.refused(r"did you mean until_damage\? \(see help\(kds.run\)\)", kds.run, coil(), until_damages=True)
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
        self.refused(r"is no input; expected a path", kds.run, 17)
        self.refused(r"step: is 0; expected a number from 1", kds.run, coil(), step=0)
        self.refused(r"no frame of array is chosen, which has 6", kds.run, coil(), start=10)
        self.refused(r"stop: is -1; expected a number from 0 for a file", kds.run, DCD, stop=-1)
        self.refused(r"missing\.xyz", kds.run, "missing.xyz")
        self.refused(r"start, stop, step: ", kds.run, DCD, topology=PDB, stop=10 ** 9)
        self.refused(r"the run has no hull; it has power", kds.run(coil(), radius=1, structures=["power"])._core.elements,
                     "hull", 0)
        self.refused(r"beads: give the number of beads", kds.generate, "spiral")
        self.refused(r"frames: ", kds.generate, "spiral", beads=30, frames=0)

    def test_help_is_no_option(self):
        self.refused(r"help", kds.run, coil(), help=True, error=(kds.InputError, TypeError))

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

    def interrupted(self, run):
        raised = []

        def interrupt():
            raised.append(time.monotonic())
            signal.raise_signal(signal.SIGINT)

        timer = threading.Timer(0.4, interrupt)
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            run()
        self.assertLess(time.monotonic() - raised[0], 1.0)  # 0.1 s on a machine without other work
        timer.join()

    def test_ctrl_c_ends_a_run(self):
        for threads in (1, 2):
            self.interrupted(lambda: kds.run(self.positions, radius=1, structures=["power", "contacts"], threads=threads))

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
