"""Lets kds follow LAMMPS, GROMACS or a server while they run, on the loopback address, and compares with the frames they write.

Usage: peers.py lammps|gromacs|server KDS PRINT_FRAMES DATA FOLDER. Exit code 77 (skipped) if the simulator is not installed.
IMD sends float32 in angstrom. The frames of the simulator's own file, rounded to float32, must be the beads of kds bit for bit,
and `run` and `contacts` over the same numbers from a file must find the same events and intervals.
"""

import contextlib
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

PEER, KDS, PRINT_FRAMES = sys.argv[1:4]
DATA, FOLDER = (Path(path).resolve() for path in sys.argv[4:6])
if not shutil.which({"lammps": "lmp", "gromacs": "gmx", "server": sys.executable}[PEER]):
    print(f"skipped: the program of {PEER} is not installed")
    sys.exit(77)
try:
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)
PAPER = Path(__file__).resolve().parents[2] / "experiments/paper"
sys.path.insert(0, str(PAPER))
import imd_server  # noqa: E402
from simulate import MDP, read_dump, run  # noqa: E402

EXAMPLE = Path("/usr/share/lammps/examples/peptide/data.peptide")
RESULTS = {"run": ("summary.json", "events.csv"), "contacts": ("contacts.json", "intervals.csv")}
FOLLOWED = ["--structures", "wrapped,contacts"]
SHAKE = "fix 2 all shake 0.000001 50 0 b 4 6 8 10 12 14 18 a 31\n"
FILES = {"chain": "frames.bin", "cage": "md.trr"}
FAILURES = []


def check(holds, message):
    print("ok:" if holds else "FAILED:", message)
    if not holds:
        FAILURES.append(message)


class Chain:
    """Sixty beads that FENE springs join, in LAMMPS."""

    name, steps, inputs = "chain", 2000, ["--dt", "0.005"]
    choices = {"run": [*FOLLOWED, "--radius", "0.5", "--cutoff", "1.3"], "contacts": ["--cutoff", "3"]}

    def prepare(self):
        atoms = "".join(f"{k} 1 1 {(k - 31) * 0.97} {0.3 * (k % 2)} 0\n" for k in range(1, 61))
        bonds = "".join(f"{k} 1 {k} {k + 1}\n" for k in range(1, 60))
        sides = "".join(f"-40 40 {axis}lo {axis}hi\n" for axis in "xyz")
        (FOLDER / "chain.data").write_text(f"chain\n\n60 atoms\n59 bonds\n1 atom types\n1 bond types\n\n{sides}\nMasses\n\n"
                                           f"1 1.0\n\nAtoms # bond\n\n{atoms}\nBonds\n\n{bonds}")
        return ("units lj\natom_style bond\nread_data chain.data\nbond_style fene\nbond_coeff 1 30.0 1.5 1.0 1.0\n"
                "special_bonds fene\npair_style lj/cut 1.122462\npair_coeff 1 1 1.0 1.0 1.122462\ngroup written id >= 1\n"
                "velocity all create 1.0 12345\nfix 1 all nve\nfix 2 all langevin 1.0 1.0 1.0 904297\ntimestep 0.005\n")

    def command(self, port, steps, stays):
        """Returns the command of a run that sends `steps` frames. If it `stays`, it goes on without a client."""
        (FOLDER / "in.now").write_text(f"{self.prepare()}fix 3 written imd {port} unwrap on nowait {'on' if stays else 'off'}\n"
                                       "dump 1 written custom 1 frames.bin id type xu yu zu\ndump_modify 1 sort id\n"
                                       f"run {steps}\n")
        return "lmp", "-in", "in.now", "-log", "none"

    def written(self):
        """Returns the frames that the simulator wrote and sent, in float32 and angstrom. LAMMPS does not send step 0."""
        return read_dump(FOLDER / "frames.bin")[1][1:, :, 2:].astype("f4")


class Peptide(Chain):
    """Met-enkephalin in water, at constant energy, in LAMMPS: the atoms of the peptide and the oxygens of the water."""

    name, steps = "peptide", 150
    inputs = ["--topology", str(DATA / "trajectories/enkephalin_water.gro"), "--select", "//*", "--dt", "0.002"]
    choices = {"run": [*FOLLOWED, "--radius", "1", "--cutoff", "4"], "contacts": ["--cutoff", "5"]}

    def prepare(self):
        head = (PAPER / "peptide_2fs.in").read_text().split("velocity")[0].replace("${data}", str(EXAMPLE))
        return f"{head}velocity all create 275.0 1237\nfix 1 all nve\n{SHAKE}"


class Cage:
    """The protein trp-cage (PDB entry 1L2Y) in vacuum, in GROMACS."""

    name, steps = "cage", 1000
    inputs = ["--topology", str(FOLDER / "box.gro"), "--dt", "0.002"]
    choices = {"run": [*FOLLOWED, "--radius", "0.7", "--cutoff", "8"], "contacts": ["--cutoff", "8"]}

    def __init__(self):
        def gmx(*words):
            run("gmx", "-quiet", *words, folder=FOLDER)

        gmx("pdb2gmx", "-f", DATA / "proteins/1l2y.pdb", "-o", "p.gro", "-p", "t.top", "-ff", "amber99sb-ildn", "-water",
            "none", "-ignh")
        gmx("editconf", "-f", "p.gro", "-o", "box.gro", "-box", "8", "-c")
        (FOLDER / "md.mdp").write_text(MDP.replace("PME", "cut-off") + "integrator=md\ndt=0.002\nnsteps=1000\nnstxout=1\n"
                                       "gen_vel=yes\ngen_temp=300\ngen_seed=7\nIMD-group=System\nIMD-nst=1\n")
        gmx("grompp", "-f", "md.mdp", "-c", "box.gro", "-p", "t.top", "-o", "md.tpr", "-maxwarn", "3")

    def command(self, port, steps, stays):
        return ("gmx", "-quiet", "-nobackup", "mdrun", "-nt", "1", "-reprod", "-deffnm", "md", "-nsteps", str(steps),
                "-imdport", str(port), "-imdterm" if stays else "-imdwait")

    def written(self):
        content, at, frames = (FOLDER / "md.trr").read_bytes(), 0, []
        while at < len(content):  # of single precision: a head of 84 bytes with the sizes of the parts, the cell, positions
            sizes = np.frombuffer(content, ">i4", 10, at + 24)
            frames.append(np.frombuffer(content, ">f4", sizes[7] // 4, at + 84 + sizes[2]).reshape(-1, 3))
            at += 84 + sizes.sum()
        return np.array(frames, "f4") * np.float32(10)


class Server:
    """A generated chain, which imd_server.py sends in version 3 and big-endian byte order."""

    name, steps, inputs = "server", 300, ["--dt", "0.002"]
    choices = {"run": [*FOLLOWED, "--radius", "1", "--cutoff", "5"], "contacts": ["--cutoff", "5"]}

    def command(self, port, steps, stays):
        return (sys.executable, imd_server.__file__, "--port", port, "--version", "3", "--big-endian", "--frames", steps)

    def written(self):
        return np.array([frame[0] for _, frame in zip(range(self.steps), imd_server.chain(100))], "f4")


@contextlib.contextmanager
def started(system, steps=None, stays=False):
    """Runs a simulation during a block, which gets its process and its address."""
    port = imd_server.free_port()
    command, environment = system.command(port, steps or system.steps, stays), dict(os.environ, OMP_NUM_THREADS="1")
    with open(FOLDER / "peer.out", "w") as out:
        with imd_server.running(*command, cwd=FOLDER, stdout=out, stderr=out, env=environment) as process:
            yield process, f"imd://127.0.0.1:{port}"


def kds(command, source, system, out, *more):
    """Returns a process of kds that writes its results to the folder `out`."""
    shutil.rmtree(FOLDER / out, ignore_errors=True)
    words = [KDS, command, source, *system.inputs, *system.choices[command], *more, "--out", FOLDER / out, "--quiet"]
    return subprocess.Popen([str(word) for word in words], stderr=subprocess.PIPE, text=True)


def ended(process, command, out):
    """Returns the exit code of kds, its last words, the number of frames, and its table and fingerprint."""
    words = process.communicate(timeout=300)[1].strip().replace("\n", "; ")
    summary, table = RESULTS[command]
    if not (FOLDER / out / summary).exists():
        sys.exit(f"FAILED: kds {command} wrote nothing: {words}")
    found = json.loads((FOLDER / out / summary).read_text())
    rows = (FOLDER / out / table).read_text() + found.get("fingerprint", "")
    return process.returncode, words, found["input"]["frames"], rows


def compare(system):
    with started(system) as (process, address):
        done = subprocess.run([PRINT_FRAMES, address], capture_output=True, timeout=300, check=False)
        check(done.returncode == 0 and process.wait(60) == 0, f"{system.name}: frames are read to the end")
    beads = system.written()
    got = np.frombuffer(done.stdout).reshape(-1, 1 + beads[0].size)[:, 1:].reshape(-1, *beads[0].shape)
    check(got.shape == beads.shape and (got == beads).all(), f"{system.name}: {len(beads)} frames, beads bit for bit")
    for command in RESULTS:
        with started(system) as (process, address):
            code, words, frames, live = ended(kds(command, address, system, "live"), command, "live")
            check(code == 0 and process.wait(60) == 0, f"{system.name}: {command} ends with the simulation ({words})")
        beads = system.written()
        with open(FOLDER / "frames.xyz", "w") as file:  # enough digits to read back the same doubles
            for frame in beads.astype(float).tolist():
                file.write(f"{len(frame)}\n\n" + "".join(f"X {x!r} {y!r} {z!r}\n" for x, y, z in frame))
        code, words, count, same = ended(kds(command, FOLDER / "frames.xyz", system, "file"), command, "file")
        check(code == 0 and frames == count == len(beads), f"{system.name}: {command} takes all {frames} frames")
        check(live == same and same.count("\n") > 10, f"{system.name}: {command} finds the same {same.count(chr(10)) - 1} rows")


def leave(system):
    """kds leaves, and the simulation goes on. The simulation is killed, and kds keeps the results of the frames before."""
    written = FOLDER / FILES[system.name]

    def grows(size):
        for _ in range(600):
            if written.exists() and written.stat().st_size > size:
                return True
            time.sleep(0.1)
        return False

    with started(system, 10**6, stays=True) as (process, address):
        code, words, frames, _ = ended(kds("run", address, system, "left", "--until", "0.2"), "run", "left")
        check(code == 0 and grows(written.stat().st_size), f"{system.name}: goes on after {frames} frames ({words})")
    written.unlink()
    with started(system, 10**6) as (process, address):
        follower = kds("contacts", address, system, "killed")
        check(grows(10**5), f"{system.name}: begins when kds comes")
        process.kill()
        code, words, frames, _ = ended(follower, "contacts", "killed")
        broken = "inside a packet" in words or "the connection" in words
        check(code == broken and frames > 1, f"{system.name}: is killed after {frames} frames ({words})")


signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # ends the simulation too
FOLDER.mkdir(parents=True, exist_ok=True)
if PEER == "lammps" and not EXAMPLE.exists():
    print(f"left out: the peptide, because {EXAMPLE} is not installed")
PEERS = {"lammps": [Chain] + [Peptide] * EXAMPLE.exists(), "gromacs": [Cage], "server": [Server]}
for system in [peer() for peer in PEERS[PEER]]:
    compare(system)
    if system.name in FILES:
        leave(system)
sys.exit(1 if FAILURES else 0)
