"""Compares the readers of kds with MDAnalysis and mdtraj: coordinates must be equal bit for bit, times to 1e-6.

Usage: compare_readers.py PRINT_FRAMES KDS DATA FOLDER. Exit code 77 (skipped) if a package is not installed.
The packages write one trajectory in many formats; each file is read by the package and by kds.
"""
import json
import os
import subprocess
import sys
import warnings

try:
    warnings.simplefilter("ignore")
    import MDAnalysis
    import mdtraj
    import netCDF4  # MDAnalysis writes NetCDF with it
    import numpy
except Exception as error:  # a package may be installed and broken
    print(f"skipped: a package that the readers are compared with cannot be imported ({error})")
    sys.exit(77)

PRINT_FRAMES, KDS, DATA, FOLDER = sys.argv[1:5]
os.makedirs(FOLDER, exist_ok=True)
FAILURES = []


def check(condition, message):
    if not condition:
        FAILURES.append(message)
        print("FAILED:", message)


def read_by_kds(path, beads):
    """Returns times and positions (frames, beads, 3) in angstrom, as doubles."""
    run = subprocess.run([PRINT_FRAMES, path], capture_output=True)
    if run.returncode != 0:
        check(False, f"{path}: {run.stderr.decode()}")
        return numpy.zeros(0), numpy.zeros((0, beads, 3))
    rows = numpy.frombuffer(run.stdout).reshape(-1, 1 + 3 * beads)
    return rows[:, 0], rows[:, 1:].reshape(-1, beads, 3)


def compare(path, positions, times, reader):
    """`positions` are single-precision numbers in angstrom, which kds must reproduce bit for bit."""
    own_times, own = read_by_kds(path, positions.shape[1])
    name = f"{os.path.basename(path)} as {reader} reads it"
    if own.shape != positions.shape:
        check(False, f"{name}: {positions.shape}, by kds {own.shape}")
        return
    same = numpy.array_equal(own, positions.astype(numpy.float64))
    check(same, f"{name}: positions differ by up to {abs(own - positions).max()}")
    if times is not None:
        check(numpy.allclose(own_times, times, rtol=1e-6, atol=1e-6), f"{name}: times {own_times[:3]}, expected {times[:3]}")
    print(f"{'ok' if same else '--'}: {name}, {positions.shape[0]} frames of {positions.shape[1]} atoms")


def by_mdanalysis(path, atoms):
    universe = MDAnalysis.Universe.empty(atoms, trajectory=False)
    universe.load_new(path)
    frames = [(ts.time, ts.positions.copy()) for ts in universe.trajectory]
    return numpy.array([f[0] for f in frames]), numpy.array([f[1] for f in frames], dtype=numpy.float32)


def read_both(path, atoms, with_times=True, by=("MDAnalysis", "mdtraj")):
    if "MDAnalysis" in by:
        times, positions = by_mdanalysis(path, atoms)
        compare(path, positions, times if with_times else None, "MDAnalysis")
    if "mdtraj" in by:
        formats = mdtraj.formats.registry
        with formats.FormatRegistry.fileobjects[os.path.splitext(path)[1]](path) as file:
            read = file.read()
        nanometres = read[0] if isinstance(read, tuple) else read
        if os.path.splitext(path)[1] in (".nc", ".ncdf"):
            compare(path, nanometres, read[1] if with_times else None, "mdtraj")  # its NetCDF file is in angstrom
        else:
            compare(path, numpy.float32(10) * nanometres, read[1] if with_times else None, "mdtraj")


def write_all(stem, positions, dt, box):
    """Writes the frames in each format that MDAnalysis writes, and reads them back."""
    frames, atoms = positions.shape[:2]
    universe = MDAnalysis.Universe.empty(atoms, n_residues=atoms, atom_resindex=range(atoms), trajectory=True)
    universe.add_TopologyAttr("names", ["CA"] * atoms)
    universe.add_TopologyAttr("resnames", ["ALA"] * atoms)
    universe.add_TopologyAttr("resids", range(1, atoms + 1))
    universe.add_TopologyAttr("masses", [12.0] * atoms)
    universe.add_TopologyAttr("types", ["C"] * atoms)
    universe.load_new(positions, dt=dt)
    for ending in ("xtc", "trr", "nc", "dcd"):
        path = os.path.join(FOLDER, f"{stem}.{ending}")
        with MDAnalysis.Writer(path, n_atoms=atoms, dt=dt) as writer:
            for ts in universe.trajectory:
                ts.dimensions = box
                writer.write(universe.atoms)
        read_both(path, atoms, with_times=ending != "dcd", by=("MDAnalysis",) if ending == "dcd" else ("MDAnalysis", "mdtraj"))


def write_seven(nanometres, folder):
    """Writes one trajectory in seven formats and returns their paths. The single-precision numbers of angstrom
    are 10 times those of nanometres, so that DCD, TRR, NetCDF, GRO, XYZ and LAMMPS dumps lose nothing."""
    angstrom = numpy.float32(10) * nanometres
    frames, atoms = angstrom.shape[:2]
    path = lambda ending: os.path.join(folder, "seven." + ending)
    universe = MDAnalysis.Universe.empty(atoms, trajectory=True)
    universe.load_new(angstrom, dt=1.0)
    for ending in ("dcd", "nc"):
        with MDAnalysis.Writer(path(ending), n_atoms=atoms, dt=1.0) as writer:
            for _ in universe.trajectory:
                writer.write(universe.atoms)
    with mdtraj.formats.TRRTrajectoryFile(path("trr"), "w") as file:
        file.write(nanometres, time=numpy.arange(frames, dtype=numpy.float32))
    with mdtraj.formats.XTCTrajectoryFile(path("xtc"), "w") as file:
        file.write(nanometres, time=numpy.arange(frames, dtype=numpy.float32))
    with open(path("gro"), "w") as gro, open(path("xyz"), "w") as xyz, open(path("lammpstrj"), "w") as dump:
        for k in range(frames):
            gro.write(f"t= {k}.0\n{atoms}\n")
            xyz.write(f"{atoms}\n\n")
            dump.write(f"ITEM: TIMESTEP\n{k}\nITEM: NUMBER OF ATOMS\n{atoms}\nITEM: BOX BOUNDS ff ff ff\n")
            dump.write("-500 500\n" * 3 + "ITEM: ATOMS id type x y z\n")
            for i in range(atoms):
                n, a = nanometres[k, i], angstrom[k, i]
                gro.write(f"{i + 1:5d}ALA     CA{i + 1:5d}" + "".join(f"{c:17.12f}" for c in n) + "\n")
                xyz.write("C " + " ".join(f"{c:.17g}" for c in a) + "\n")
                dump.write(f"{i + 1} 1 " + " ".join(f"{c:.17g}" for c in a) + "\n")
            gro.write("   0.00000   0.00000   0.00000\n")
    return [path(ending) for ending in ("dcd", "nc", "trr", "gro", "xyz", "lammpstrj", "xtc")], angstrom


def compare_seven(nanometres):
    paths, angstrom = write_seven(nanometres, FOLDER)
    fingerprints = {}
    for path in paths:
        _, own = read_by_kds(path, angstrom.shape[1])
        lossy = path.endswith(".xtc")
        same = own.shape == angstrom.shape and (abs(own - angstrom).max() <= 0.0051 if lossy else numpy.array_equal(own, angstrom))
        check(same, f"{os.path.basename(path)}: other positions than those written")
        run = subprocess.run([KDS, "run", path, "--radius", "1.9", "--structures", "wrapped", "--select", "all", "--json", "-", "--quiet"],
                             capture_output=True, text=True)
        check(run.returncode == 0, f"{path}: {run.stderr}")
        if not lossy and run.returncode == 0:
            fingerprints[os.path.basename(path)] = json.loads(run.stdout)["fingerprint"]
    check(len(set(fingerprints.values())) == 1, f"fingerprints of lossless formats differ: {fingerprints}")
    print("fingerprints:", fingerprints)


def main():
    # A protein as it is, and a cloud of 100,000 atoms with large and negative coordinates.
    source = os.path.join(DATA, "trajectories", "villin_hp36_300K.dcd")
    size = by_dcd_header(source)
    times, villin = by_mdanalysis(source, size)
    villin = villin[:40]
    box = [80, 80, 80, 90, 90, 90]
    write_all("villin", villin, 2.0, box)
    random = numpy.random.default_rng(7)
    cloud = (random.standard_normal((3, 100000, 3)) * 200 - 50).astype(numpy.float32)
    cloud[1:] = cloud[0] + random.standard_normal((2, 100000, 3)).astype(numpy.float32)
    write_all("cloud", cloud, 0.5, [3000, 3000, 3000, 90, 90, 90])
    write_all("few", villin[:, :4].copy(), 1.0, box)  # XTC stores up to nine atoms without compression
    write_all("triclinic", villin, 1.0, [90, 90, 90, 70, 80, 100])
    compare_seven((villin[:20] / numpy.float32(10)).astype(numpy.float32))
    return 1 if FAILURES else 0


def by_dcd_header(path):
    import struct
    with open(path, "rb") as file:
        data = file.read(4096)
    title = struct.unpack("<i", data[92:96])[0]
    return struct.unpack("<i", data[92 + 8 + title + 4:92 + 8 + title + 8])[0]


sys.exit(main())
