"""Makes the replicas of spacing.py: molecular dynamics at 2 fs, each step written with velocities as TRR.

  peptide  met-enkephalin in 640 waters, by LAMMPS from its example `peptide` (Debian: lammps, lammps-examples). Keeps the
           backbone with its oxygens, and the waters that come within 4 angstrom of such an oxygen. About 3 minutes a replica
  villin   villin headpiece HP36 (PDB entry 1VII) in about 2,100 waters, by GROMACS with amber99sb-ildn and TIP3P. Keeps the
           backbone. About 4 minutes a replica

Both have constant energy after an equilibration of 4 or 5 ps, and bonds to hydrogens of constant length. Replicas differ in the
velocities at the start of the equilibration. GROMACS runs md-vv, because its leapfrog writes velocities of half a step earlier.
"""

import argparse
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
NEAR = 0.4  # nm
PER_PS = 100  # of LAMMPS's unit angstrom/fs in nm/ps
GRIDS = 2.0**20, 2.0**11  # positions are rounded to 1e-6 nm and velocities to 5e-4 nm/ps, so that files compress
MDP = """cutoff-scheme=Verlet
coulombtype=PME
rcoulomb=0.9
rvdw=0.9
fourierspacing=0.12
constraints=h-bonds
"""


def run(*command, folder=None, words=""):
    if not shutil.which(command[0]):
        raise SystemExit(f"{command[0]} is not installed")
    environment = dict(os.environ, OMP_NUM_THREADS="1", GMX_MAXBACKUP="-1")
    done = subprocess.run(command, cwd=folder, input=words, env=environment, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}:\n{(done.stdout + done.stderr)[-2000:]}")


def read_dump(path):
    """Returns the side of the cell and an array (frames, atoms, columns) of a binary dump of LAMMPS, revision 2."""
    with open(path, "rb") as file:
        head = file.read(400)
    at = 8 - int.from_bytes(head[:8], "little", signed=True) + 8  # after the magic word, the byte order and the revision
    atoms, bounds = int.from_bytes(head[at + 8:at + 16], "little"), np.frombuffer(head, "<f8", 6, at + 44)
    at += 44 + 48
    columns, at = int.from_bytes(head[at:at + 4], "little"), at + 8  # units are not named
    at += 1 + 8 * head[at]  # the time, if there is one
    at += 4 + int.from_bytes(head[at:at + 4], "little") + 8  # names of columns, number of processes, numbers of one process
    frames = np.memmap(path, np.dtype([("head", f"V{at}"), ("atoms", "<f8", (atoms, columns))]), "r")
    return bounds[1] - bounds[0], frames["atoms"]


def write_trr(path, positions, velocities, sides, spacing=0.002):
    """Writes floats. Positions (frames, atoms, 3) are in nm, velocities in nm/ps; `sides` are those of a rectangular cell."""
    frames, atoms, _ = positions.shape
    of_part = atoms * 12
    word = np.frombuffer(b"GMX_trn_file", ">i4")
    head = np.array([1993, 13, 12, *word, 0, 0, 36, 0, 0, 0, 0, of_part, of_part, 0, atoms], ">i4")
    kind = np.dtype([("head", ">i4", len(head)), ("step", ">i4", 2), ("time", ">f4", 2), ("box", ">f4", (3, 3)),
                     ("positions", ">f4", (atoms, 3)), ("velocities", ">f4", (atoms, 3))])
    content = np.zeros(frames, kind)
    content["head"], content["step"][:, 0], content["time"][:, 0] = head, np.arange(frames), np.arange(frames) * spacing
    content["box"], content["positions"], content["velocities"] = np.diag(sides), positions, velocities
    path.write_bytes(content.tobytes())


def of_peptide(names, dump, path):
    """Writes the backbone and near waters of a dump as PATH.trr and PATH.gro. `names` are the atoms' lines of a GRO file."""
    side, table = read_dump(dump)
    side /= 10
    backbone = [k for k, line in enumerate(names) if line[10:15].strip() in ("N", "CA", "C", "O", "CH3")]
    oxygens = [k for k in backbone if names[k][10:15].strip() == "O"]
    waters = np.array([k for k, line in enumerate(names) if line[10:15].strip() == "OW"])
    least = np.full(len(waters), np.inf)
    for frame in table:
        apart = (frame[waters, None, 2:5] - frame[None, oxygens, 2:5]) / 10
        apart -= side * np.round(apart / side)
        least = np.minimum(least, np.sqrt((apart**2).sum(2)).min(1))
    kept = [*backbone, *waters[least < NEAR]]
    positions = np.round(table[:, kept, 2:5] / 10 * GRIDS[0]) / GRIDS[0]
    velocities = np.round(table[:, kept, 5:8] * PER_PS * GRIDS[1]) / GRIDS[1]
    write_trr(path.with_suffix(".trr"), positions, velocities, [side] * 3)
    lines = [f"{names[k][:15]}{n + 1:5d}{''.join(f'{x:8.3f}' for x in positions[0, n])}" for n, k in enumerate(kept)]
    heads = ["Met-enkephalin, capped: backbone, and waters that come near its oxygens", str(len(kept))]
    path.with_suffix(".gro").write_text("\n".join([*heads, *lines, f"{side:10.5f}" * 3]) + "\n")


def peptide(folder, replica, given):
    names = (HERE.parents[1] / "data/trajectories/enkephalin_water.gro").read_text().splitlines()[2:-1]
    dump = folder / f"peptide-{replica}.bin"
    run("lmp", "-in", str(HERE / "peptide_2fs.in"), "-var", "seed", str(1237 * replica), "-var", "data", str(given.example),
        "-var", "steps", str(given.steps), "-var", "out", str(dump), "-log", str(dump.with_suffix(".log")))
    of_peptide(names, dump, folder / f"peptide-{replica}")
    dump.unlink()


def villin(folder, replica, given):
    def gmx(*command, words=""):
        run("gmx", "-quiet", *command, folder=folder, words=words)

    def simulate(name, before, options, *more):
        (folder / f"{name}.mdp").write_text(MDP + options)
        gmx("grompp", "-f", f"{name}.mdp", "-c", f"{before}.gro", "-p", "t.top", "-o", f"{name}.tpr", "-maxwarn", "3", *more)
        if name != "ions":
            gmx("mdrun", "-nt", "1", "-deffnm", name)

    if not (folder / "least.gro").exists():
        gmx("pdb2gmx", "-f", str(given.pdb.resolve()), "-o", "p.gro", "-p", "t.top", "-ff", "amber99sb-ildn", "-water", "tip3p",
            "-ignh")
        gmx("editconf", "-f", "p.gro", "-o", "b.gro", "-bt", "dodecahedron", "-d", "0.7", "-c")
        gmx("solvate", "-cp", "b.gro", "-cs", "spc216.gro", "-o", "s.gro", "-p", "t.top")
        simulate("ions", "s", "integrator=steep\n")
        gmx("genion", "-s", "ions.tpr", "-o", "i.gro", "-p", "t.top", "-neutral", words="SOL")
        simulate("least", "i", "integrator=steep\nemtol=500\nnsteps=400\n")
    simulate("warm", "least", "integrator=md\ndt=0.002\nnsteps=2500\ntcoupl=v-rescale\ntc-grps=System\ntau_t=0.1\nref_t=300\n"
             f"gen_vel=yes\ngen_temp=300\ngen_seed={20040100 + replica}\n")
    simulate("free", "warm", f"integrator=md-vv\ndt={given.fs / 1000}\nnsteps={given.steps}\nnstxout=1\nnstvout=1\n"
             "lincs-iter=2\nlincs-order=6\ncontinuation=yes\n", "-t", "warm.cpt")
    for ending in ("trr", "gro"):
        of = "free.trr" if ending == "trr" else "warm.gro"
        gmx("trjconv", "-f", of, "-s", "free.tpr", "-o", f"villin-{replica}.{ending}", words="Backbone")
    (folder / "free.trr").unlink()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("system", choices=("peptide", "villin"))
    parser.add_argument("folder", type=Path, help="where SYSTEM-REPLICA.trr and .gro are written")
    parser.add_argument("--replicas", type=int, default=5)
    parser.add_argument("--steps", type=int, default=10000)
    parser.add_argument("--fs", type=float, default=2, help="villin: the time step (default: 2)")
    parser.add_argument("--example", default="/usr/share/lammps/examples/peptide/data.peptide", type=Path)
    parser.add_argument("--pdb", type=Path, help="villin: PDB entry 1VII, one model")
    given = parser.parse_args()
    if given.replicas < 1 or given.steps < 1 or not 0 < given.fs < 100:
        parser.error("--replicas, --steps and --fs: expected 1 or more, and a time step above 0")
    if given.system == "villin" and not given.pdb:
        parser.error("villin needs --pdb")
    given.folder.mkdir(parents=True, exist_ok=True)
    for number in range(1, given.replicas + 1):
        (peptide if given.system == "peptide" else villin)(given.folder, number, given)


if __name__ == "__main__":
    main()
