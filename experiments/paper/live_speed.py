"""How fast can kds follow a simulation, and how much does it slow the simulation?

The simulation is met-enkephalin in water at 2 fs by LAMMPS, on one thread: its steps per second without a client, with a client
that only reads, and with kds, which maintains wrapped,contacts of the peptide and the oxygens of the water (724 atoms). Rounds
alternate. Then a server sends frames as fast as it can: frames per second that a client reads, and that kds follows.
"""

import re
import shutil
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import kds
import numpy as np
from common import HERE, Report
from subjects import trajectory

sys.path.insert(0, str(HERE.parents[1] / "tests/live"))
import imd_server  # noqa: E402

EXAMPLE = Path("/usr/share/lammps/examples/peptide/data.peptide")
MOVES = "velocity all create 275.0 1237\nfix 1 all nve\nfix 2 all shake 0.000001 50 0 b 4 6 8 10 12 14 18 a 31\n"


def read_all(port):
    """Returns all bytes that a server sends before it closes the connection. Waits a minute for the server."""
    for _ in range(6000):
        try:
            with socket.create_connection(("127.0.0.1", port)) as server, server.makefile("rb") as file:
                server.sendall(imd_server.packet(imd_server.GO, 0))
                return file.read()
        except ConnectionRefusedError:
            time.sleep(0.01)
    raise SystemExit(f"nothing listens at port {port}")


def follow(**options):
    """Returns a client that returns the number of frames that kds receives, and of events that it finds."""

    def run(port):
        found = kds.run(f"imd://127.0.0.1:{port}", structures=["wrapped", "contacts"], **options)
        return found.frame_count, len(found.events)

    return run


def simulate(steps, client, folder, group="written"):
    """Returns the steps per second of LAMMPS, and what the client returned."""
    port, head = imd_server.free_port(), (HERE / "peptide_2fs.in").read_text().split("velocity")[0]
    fix = f"fix 3 {group} imd {port} unwrap on\n" if client else ""
    Path(folder, "in.peptide").write_text(f"{head}{MOVES}{fix}run {steps}\n")
    with imd_server.running("lmp", "-in", "in.peptide", "-var", "data", EXAMPLE, "-log", "none", cwd=folder,
                            stdout=subprocess.PIPE, text=True) as process:
        found = client(port) if client else None
        loop = re.search(r"Loop time of (\S+) on 1 procs for (\d+) steps", process.communicate(timeout=600)[0])
        return int(loop[2]) / float(loop[1]), found


def replay(frames, client):
    """Returns how many frames per second the client takes, and what it returned."""
    content = b"".join(imd_server.packed(step, frame, version=2, order="<", dt=0) for step, frame in enumerate(frames))
    with imd_server.listen() as listener:
        server = threading.Thread(target=imd_server.serve, args=([content], listener), daemon=True)
        server.start()
        start = time.perf_counter()
        found = client(listener.getsockname()[1])
        return len(frames) / (time.perf_counter() - start), found


def main():
    report = Report(__doc__)
    rounds, steps, length = (1, 50, 20) if report.short else (3, 500, 200)
    villin = trajectory("villin", report.data)
    villin = np.concatenate([villin, villin[::-1]] * (1 if report.short else 5))  # to and fro
    received = []  # frames that kds receives, and all
    inputs = {"villin, backbone, 20 fs": (villin, {"cutoff": 4.5, "radius": 0.75})}
    with tempfile.TemporaryDirectory() as folder:
        if shutil.which("lmp") and EXAMPLE.exists():
            topology = report.data / "trajectories/enkephalin_water.gro"
            clients = {"no client": None, "a client that reads": read_all,
                       "kds": follow(topology=topology, select="//*", cutoff=4, radius=1)}
            speeds = {name: [] for name in clients}
            for _ in range(rounds):
                for name, client in clients.items():
                    speed, found = simulate(steps, client, folder)
                    speeds[name].append(speed)
                    if name == "kds":
                        received.append((found[0], steps))
            alone = statistics.median(speeds["no client"])
            rows = [{"row": f"LAMMPS, {name}", "steps_per_second": statistics.median(of), "least": min(of), "most": max(of),
                     "share": statistics.median(of) / alone} for name, of in speeds.items()]
            report.show(["peptide, LAMMPS", "steps a second", "least", "most", "share"], [list(row.values()) for row in rows])
            report.results["simulation"] = rows
            content = simulate(length, read_all, folder, "all")[1]
            kind = np.dtype([("head", "V8"), ("positions", "<f4", (int.from_bytes(content[12:16], "big"), 3))])
            recorded = np.frombuffer(content[8:], kind)["positions"]
            inputs["peptide and water, all atoms, 2 fs"] = recorded, {"cutoff": 3, "radius": 0.5}
        else:
            report.say("  left out: LAMMPS and its example peptide are not installed (Debian: lammps, lammps-examples)")
        chain = imd_server.chain(5000)
        inputs["random chain"] = np.array([next(chain)[0] for _ in range(length)]), {"cutoff": 4.5, "radius": 1.9}
        rows = []
        for name, (frames, options) in inputs.items():
            reads = statistics.median(replay(frames, read_all)[0] for _ in range(rounds))
            found = [replay(frames, follow(**options)) for _ in range(rounds)]
            follows, events = statistics.median(speed for speed, _ in found), found[0][1][1]
            received += [(of_run[0], len(frames)) for _, of_run in found]
            rows.append({"row": name, "beads": frames.shape[1], "read": reads, "followed": follows,
                         "events_per_frame": events / (len(frames) - 1)})
        report.show(["frames a second", "beads", "read", "followed", "events a frame"], [list(row.values()) for row in rows])
        report.results["rows"] += rows
    report.claim("all", "kds receives every frame", all(one == every for one, every in received), f"{len(received)} runs")
    report.finish()


if __name__ == "__main__":
    main()
