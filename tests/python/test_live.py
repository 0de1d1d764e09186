"""Running simulations as inputs: a server on the loopback address sends frames that are known."""

import itertools
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import kds
from data import DCD, PDB, PROGRAM

sys.path.append(str(Path(__file__).resolve().parents[1] / "live"))
from imd_server import listen, packed, serve  # noqa: E402


def wandering(frames=30, beads=12, seed=3):
    """Returns positions that float32 holds."""
    steps = np.random.default_rng(seed).normal(scale=0.4, size=(frames, beads, 3))
    return (3 * np.arange(beads)[:, None] % 7 + steps.cumsum(axis=0)).astype(np.float32)


class Simulation:
    """Sends frames to the next client, on a thread. `pause` seconds pass before each frame; `interrupt` is the number of the
    frame at which this process gets SIGINT."""

    def __init__(self, frames, pause=0, interrupt=None, **options):
        self.listener = listen()
        self.address = f"imd://127.0.0.1:{self.listener.getsockname()[1]}"

        def slowly():
            for k, frame in enumerate(frames):
                time.sleep(pause)
                if k == interrupt:
                    os.kill(os.getpid(), signal.SIGINT)
                yield frame

        def run():
            self.sent, self.messages = serve(slowly(), self.listener, **options)

        self.thread = threading.Thread(target=run, daemon=True)

    def __enter__(self):
        self.thread.start()
        return self.address

    def __exit__(self, *raised):
        self.thread.join(20)
        self.listener.close()


class LiveRuns(unittest.TestCase):
    def test_events_are_those_of_the_array(self):
        positions = wandering()
        for version in (2, 3):
            for motion in ("linear", "hermite"):
                expected = kds.run(positions, radius=1.2, structures=["power", "contacts"], motion=motion)
                with Simulation(positions, version=version) as address:
                    found = kds.run(address, radius=1.2, structures=["power", "contacts"], motion=motion)
                self.assertEqual(found.fingerprint, expected.fingerprint)
                self.assertEqual(found.frame_count, len(positions))
                np.testing.assert_array_equal(found.events["beads"], expected.events["beads"])
                self.assertEqual(np.isnan(found.times).all(), version == 2)
                self.assertEqual(found.summary["live"]["received"], len(positions))
                self.assertNotIn("static_seconds", found.summary["structures"]["power"])
        with self.assertRaisesRegex(kds.InputError, "lifetimes: a running simulation"):
            found.contacts.lifetimes()

    def test_velocities_and_cells_of_version_3(self):
        positions, box = wandering(), np.diag([30.0, 31.0, 32.0])
        velocities = np.random.default_rng(4).normal(size=positions.shape).astype(np.float32)
        frames = list(zip(positions, velocities, [box] * len(positions)))
        times = 0.5 * np.arange(len(positions))
        expected = kds.run(positions, radius=1.2, structures=["contacts"], motion="hermite", velocities=velocities,
                           times=times)
        with Simulation(frames, version=3, dt=0.5) as address:
            found = kds.run(address, radius=1.2, structures=["contacts"], motion="hermite", velocities="file",
                            no_periodic=True, unwrap="none")
        self.assertEqual(found.fingerprint, expected.fingerprint)
        np.testing.assert_array_equal(found.times, times)

    def test_a_cell_for_simulations_that_send_none(self):
        positions = wandering()
        options = dict(structures=["contacts"])
        pushed = kds.KineticRun.pushed(positions.shape[1], 1.2, cell=[7, 7.5, 8, 80, 90, 90], **options)
        for frame in positions:
            pushed.push(frame)
        pushed.finish()
        with Simulation(positions) as address:
            found = kds.run(address, radius=1.2, cell=[7, 7.5, 8, 80, 90, 90], unwrap="beads", **options)
        self.assertEqual(found.fingerprint, pushed.fingerprint)
        self.assertNotEqual(found.fingerprint, kds.run(positions, radius=1.2, **options).fingerprint)
        for cell, line in (([9, 10], "expected three lengths"), ([9, 10, 11, 90, 90, 200], "cell")):
            with self.assertRaisesRegex(kds.InputError, line):
                kds.run("imd://127.0.0.1:1", radius=1, cell=cell)
        box = np.diag([30.0, 31.0, 32.0])
        with Simulation([(frame, None, box) for frame in positions], version=3) as address:
            with self.assertRaisesRegex(kds.InputError, "sends its cell"):
                kds.run(address, radius=1, cell=[9, 10, 11])

    def test_contacts_streams_and_comparisons(self):
        positions = wandering()
        simulation = Simulation(positions, version=3)
        live = kds.open(simulation.address, radius=1.2)
        with simulation:
            found = live.contacts(cutoff=2.5, by="bead", apart=1)
        expected = kds.contacts(positions, cutoff=2.5, by="bead", apart=1, times=0.002 * np.arange(len(positions)))
        self.assertEqual(len(found.intervals), len(expected.intervals))
        self.assertGreater(len(found.intervals), 10)
        np.testing.assert_allclose(found.intervals["begin_frame"], expected.intervals["begin_frame"])

        with Simulation(positions) as address:
            counts = [len(frame.events) for frame in kds.stream(address, radius=1.2, structures=["power"])]
        run = kds.run(positions, radius=1.2, structures=["power"])
        self.assertEqual(counts, np.bincount(run.events["step"] + 1, minlength=len(positions)).tolist())

        options = dict(radius=1.2, structures=["power", "contacts"], strides=[2, 3], motions=["linear", "hermite"])
        with Simulation(positions) as address:
            found = kds.compare(address, **options)
        expected = kds.compare(positions, rounds=1, **options)
        for name in ("structure", "stride", "motion", "steps", "events", "net_changes", "created_per_event"):
            self.assertEqual(list(found.rows[name]), list(expected.rows[name]))

    def test_it_chooses_atoms_and_frames_as_they_arrive(self):
        expected = kds.run(DCD, topology=PDB, select="ca", radius=2, structures=["contacts"], start=2, stop=40, step=3)
        import MDAnalysis

        universe = MDAnalysis.Universe(PDB, DCD)
        frames = [frame.positions.copy() for frame in universe.trajectory[:50]]
        with Simulation(frames) as address:
            found = kds.run(address, topology=PDB, select="ca", radius=2, structures=["contacts"], start=2, stop=40, step=3)
        self.assertEqual(found.fingerprint, expected.fingerprint)
        np.testing.assert_array_equal(found.frames, expected.frames)

    def test_ctrl_c_ends_the_input_and_keeps_what_was_seen(self):
        positions = np.concatenate([wandering()] * 200)
        with Simulation(positions, pause=0.001, interrupt=100) as address:
            found = kds.run(address, radius=1.2, structures=["contacts"])
        self.assertGreater(found.frame_count, 2)
        self.assertLess(found.frame_count, 1000)

    def test_a_stream_that_is_left_disconnects(self):
        simulation = Simulation(itertools.cycle(wandering()), pause=0.001)
        with simulation as address:
            frames = kds.stream(address, radius=1.2, structures=["contacts"])
            kept = next(frames)
            frames.close()
        self.assertEqual(simulation.messages[-1][0], 0)
        self.assertEqual(kept.frame, 0)

    def test_until_and_what_is_refused(self):
        positions = wandering()
        with Simulation(positions, version=3) as address:
            self.assertEqual(kds.run(address, radius=1, structures=["contacts"], until=0.02).frame_count, 11)
        for options, line in ((dict(), "radius: auto is half"), (dict(radius=1, tolerance=0.1), "tolerance: needs")):
            with self.assertRaisesRegex(kds.InputError, line):
                kds.run("imd://127.0.0.1:1", structures=["contacts"], patience=0.2, **options)
        for options, line in ((dict(select="ca"), "select: imd://127.0.0.1:1 does not name"), (dict(start=0, stop=1), "one frame"),
                              (dict(cell=[9, 9, 9], no_periodic=True), "cell: has no meaning")):
            with self.assertRaisesRegex(kds.InputError, line):
                kds.run("imd://127.0.0.1:1", radius=1, patience=0.2, **options)
        for function in (kds.collide, kds.voids, kds.trade, kds.conditions):
            with self.assertRaisesRegex(kds.InputError, "gives each frame once"):
                function("imd://127.0.0.1:1", radius=1)
        with self.assertRaisesRegex(kds.InputError, "until: is for a running simulation"):
            kds.run(positions, radius=1, until=3)
        with self.assertRaisesRegex(kds.InputError, "imd://127.0.0.1:1"):
            kds.run("imd://127.0.0.1:1", radius=1, patience=0.2)


class ResultsOfTheProgram(unittest.TestCase):
    """`kds contacts --out` of simulations that break off, each a part."""

    def follow(self, out, positions, pause=0, **options):
        frames = [*positions, packed(len(positions), positions[-1], 3, "<", 0.002)[:60]]
        with Simulation(frames, version=3, pause=pause, **options) as address:
            program = subprocess.Popen(
                [PROGRAM, "contacts", address, "--cutoff", "5", "--apart", "1", "--out", str(out), "--every", "0", "--continue"],
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            seen, has_ended = set(), False
            while not has_ended:
                has_ended = program.poll() is not None
                try:
                    seen.add(json.loads((out / "contacts.json").read_text())["complete"])
                except FileNotFoundError:  # before the first result, or between two renames
                    pass
                time.sleep(0.01)
            return program.returncode, program.communicate()[1], seen

    def test_they_are_written_while_it_runs_and_by_parts(self):
        runs = [wandering(seed=seed) for seed in (1, 2)]
        with tempfile.TemporaryDirectory() as scratch:
            out = Path(scratch) / "out"
            code, lines, seen = self.follow(out, runs[0], pause=0.05)
            self.assertEqual((code, seen), (1, {False, True}))
            self.assertRegex(lines, "the connection has ended inside a packet")
            self.assertRegex(lines, r"\nkds: waited [\d.]+ s for the simulation in [\d.]+ s; the simulation may have waited")
            code, lines, _ = self.follow(out, runs[1])
            self.assertEqual(code, 1)
            self.assertRegex(lines, "this is part 2")
            found = kds.contacts_of_parts(out)
            self.assertTrue(all(run.json["complete"] and run.json["input"]["truncated"] for run in found.runs))
            expected = kds.contacts_of_replicas(runs, cutoff=5, apart=1, times=0.002 * np.arange(len(runs[0])))
            self.assertAlmostEqual(found.all["residence"], expected.all["residence"], places=6)
            self.assertEqual([len(run.intervals) for run in found.runs], [len(run.intervals) for run in expected.runs])

    def test_a_part_waits_for_the_part_before_it(self):
        with tempfile.TemporaryDirectory() as scratch, Simulation(wandering(2000), pause=0.005) as address:
            out = Path(scratch) / "out"
            words = [PROGRAM, "contacts", address, "--cutoff", "5", "--out", str(out), "--every", "0", "--continue"]
            with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as program:
                while not (out / "contacts.json").exists() and program.poll() is None:
                    time.sleep(0.01)
                second = subprocess.run(words, capture_output=True, text=True, check=False)
                program.send_signal(signal.SIGINT)
            self.assertEqual(second.returncode, 2)
            self.assertRegex(second.stderr, "another run writes to")
            self.assertEqual(program.returncode, 0)
            self.assertTrue(json.loads((out / "contacts.json").read_text())["complete"])


    def test_comparisons_count_all_frames(self):
        with Simulation(wandering(41), version=3) as address:
            run = subprocess.run([PROGRAM, "compare", address, "--radius", "1", "--structures", "contacts", "--strides", "2,4",
                                  "--json", "-"], capture_output=True, text=True, check=True)
        found = json.loads(run.stdout)
        self.assertEqual(found["inputs"][0]["frames"], 41)
        self.assertAlmostEqual(found["inputs"][0]["frame_picoseconds"], 0.002)
        self.assertEqual(found["live"]["received"], 41)

    def test_signals_end_the_input(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with tempfile.TemporaryDirectory() as scratch, Simulation(wandering(2000), pause=0.005) as address:
                out = Path(scratch) / "out"
                program = subprocess.Popen([PROGRAM, "run", address, "--radius", "1", "--structures", "contacts", "--out", str(out),
                                            "--every", "0"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                while not (out / "summary.json").exists() and program.poll() is None:
                    time.sleep(0.01)
                program.send_signal(number)
                lines = program.communicate()[1]
                self.assertEqual(program.returncode, 0, lines)
                found = json.loads((out / "summary.json").read_text())
                self.assertTrue(found["complete"])
                self.assertLess(found["input"]["frames"], 2000)
                self.assertRegex(lines, "kds disconnected after frame")


if __name__ == "__main__":
    unittest.main()
