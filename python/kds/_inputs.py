"""Inputs: paths, arrays, AtomGroups of MDAnalysis, trajectories of mdtraj and iterables of frames."""

import os

import numpy as np

from . import _kds
from ._options import InputError, _text, number, numbers, plain, warn, whole, wholes

_UNITS = ("angstrom", "nm")


class Input:
    """The arguments that name an input, and the frames in memory behind them, if any."""

    def __init__(self, arguments, memory=None):
        self.arguments = arguments
        self.memory = memory


def is_path(source):
    return isinstance(source, (str, os.PathLike))


def is_atom_group(source):
    return hasattr(source, "universe") and hasattr(source, "positions") and hasattr(source, "ix")


def is_mdtraj(source):
    return hasattr(source, "xyz") and hasattr(source, "topology") and hasattr(source, "unitcell_lengths")


def is_paths(source):
    return isinstance(source, (list, tuple)) and bool(source) and all(is_path(item) for item in source)


def is_frames(source):
    """Whether the frames of the source can be read more than once."""
    return (is_path(source) or is_paths(source) or is_atom_group(source) or is_mdtraj(source)
            or hasattr(source, "__array__"))


def refuse_others(source):
    """Refuses objects that are no input."""
    if hasattr(source, "select_atoms") and hasattr(source, "trajectory"):
        raise InputError("Universe: all its atoms are seldom one necklace; expected an AtomGroup, such as "
                         "u.select_atoms('name CA')")
    if isinstance(source, (list, tuple)) and any(is_atom_group(item) for item in source):
        raise InputError("list of AtomGroups: is no input; expected one AtomGroup, such as first + second")
    if not hasattr(source, "__iter__") or isinstance(source, (bytes, dict, set)):
        raise InputError(f"{type(source).__name__}: is no input; expected a path, an array (frames, beads, 3), an "
                         "AtomGroup, an mdtraj Trajectory or an iterable of frames")


def _range_text(start, stop, step):
    for name, value in (("start", start), ("stop", stop)):
        if value is not None and whole(name, value) < 0:
            raise InputError(f"{name}: is {value}; expected a number from 0 for a file, whose length is not known")
    if step is not None:
        whole("step", step, 1)
    if stop is not None and stop <= (start or 0):
        raise InputError(f"stop: is {stop}; expected a number above start, which is {start or 0}")
    return ":".join("" if part is None else str(int(part)) for part in (start, stop, step))


def _indices(start, stop, step, frames, label):
    """Returns range(first, end, step) of the frames asked for."""
    for name, value, least in (("start", start, None), ("stop", stop, None), ("step", step, 1)):
        if value is not None:
            whole(name, value, least)
    chosen = range(*slice(start, stop, step).indices(frames))
    if frames > 0 and len(chosen) == 0:
        raise InputError(f"start, stop, step: no frame of {label} is chosen, which has {frames}")
    return chosen


def frame_of(item, label):
    """Returns the positions and the time of a frame that an iterable gives. The time is None if it is not known."""
    time = None
    if isinstance(item, tuple) and len(item) == 2:
        item, time = item
        time = None if time is None else number(f"{label}: time", time, "picoseconds, as in (positions, 2.0)")
    elif hasattr(item, "positions"):
        item, time = item.positions, getattr(item, "time", None)
    if is_mdtraj(item):
        raise InputError(f"{label}: is an mdtraj Trajectory; expected arrays (beads, 3), such as (frame for part in parts "
                         "for frame in part.xyz) with units='nm'")
    positions = numbers(label, item)
    if positions.ndim != 2:
        raise InputError(f"{label}: has the shape {positions.shape}; expected (beads, 3)")
    return positions, time


def check_unit_name(units):
    if units is not None and units not in _UNITS:
        raise InputError(f"units: is '{units}'; expected angstrom or nm")


def _check_two(groups):
    if not isinstance(groups, (list, tuple)) or len(groups) != 2:
        raise InputError("groups: are not two; expected a pair, such as (first, second)")


def _set_groups(beads, groups, count, members):
    if groups is None:
        return []
    _check_two(groups)
    bits = np.zeros(count, dtype=np.uint8)
    for k, group in enumerate(groups):
        bits[members(group)] |= 1 << k
        if not (bits >> k & 1).any():
            raise InputError(f"groups: group {k} has no bead of the input")
    beads.groups = bits.tolist()
    return ["--groups", "all", "all"]


def _members_of(count, select=None):
    """Returns a function that returns the beads of a group: indices, a mask or, with `select`, a selection."""

    def members(group):
        if isinstance(group, str) and select:
            try:
                group = select(group)
            except Exception as error:  # MDAnalysis and mdtraj raise classes of their own, some with several lines
                raise InputError(f"groups: cannot select '{group}': {str(error).splitlines()[0]}") from None
        index = np.asarray(group)
        if index.dtype == bool:
            if index.shape != (count,):
                raise InputError(f"groups: a mask has the shape {index.shape}; expected ({count},)")
            index = np.flatnonzero(index)
        if index.size and (index.dtype.kind not in "iu" or index.min() < 0 or index.max() >= count):
            raise InputError(f"groups: expected indices of beads from 0 to {count - 1}")
        return index.astype(int)

    return members


def _add_chains(beads, necklaces, keys, names):
    """Adds the chains that the user gives, otherwise a chain for each run of equal keys."""
    if necklaces is not None:
        for k, count in enumerate(wholes("necklaces", necklaces, 1)):
            beads.add_chain(chr(65 + k) if k < 26 else str(k), count)
        return
    if keys is None or len(keys) == 0:
        return
    starts = [0] + [i for i in range(1, len(keys)) if keys[i] != keys[i - 1]] + [len(keys)]
    for first, end in zip(starts, starts[1:]):
        beads.add_chain(names[first], end - first)


def _atom_names(atoms, residues, numbers, chains, places):
    """Returns the name of each bead. Places tell residues apart: a residue that has the name, number and chain of an
    earlier one gets its place behind a #."""
    first, names, last, left = {}, [], None, set()
    for atom, residue, number, chain, place in zip(atoms, residues, numbers, chains, places):
        if place != last:
            if place in left and None not in left:
                warn([f"atoms of residue {residue} {number} are not neighbours in the input, so each part of it counts as a "
                      "residue; atoms.select_atoms('all') has the order of residues"])
                left.add(None)
            if last is not None:
                left.add(last)
            last = place
        if first.setdefault((residue, number, chain), place) != place:
            number = f"{number}#{place}"
        names.append(_kds.bead_name(str(atom), str(residue), str(number), chain))
    return names


def _chains_of(group):
    for attribute in ("chainIDs", "segids"):
        ids = getattr(group, attribute, None)
        if ids is not None and any(str(one).strip() for one in ids):
            return ["" if str(one) == "SYSTEM" else str(one) for one in ids]
    return [""] * len(group)


def _beads_of_group(group, label, wants_elements, necklaces, groups):
    """Returns the beads of an AtomGroup, and the arguments for its groups."""
    beads = _kds.Beads(label)
    chains = _chains_of(group)
    if hasattr(group, "names") and hasattr(group, "resnames") and hasattr(group, "resids"):
        icodes = getattr(group, "icodes", [""] * len(group))
        numbers = [f"{number}{str(code).strip()}" for number, code in zip(group.resids, icodes)]
        beads.names = _atom_names(group.names, group.resnames, numbers, chains, group.resindices)
    _add_chains(beads, necklaces, chains, chains)
    if wants_elements:
        elements = getattr(group, "elements", None)
        if elements is None or not all(elements):
            if not hasattr(group, "names"):
                raise InputError("radius: the AtomGroup has no elements and no names; expected auto or a number")
            from MDAnalysis.topology.guessers import guess_atom_element

            elements = [guess_atom_element(name) for name in group.names]
        beads.elements = [str(element) for element in elements]

    def beads_of(chosen):
        if chosen.universe is not group.universe:
            raise InputError("groups: an AtomGroup is of another Universe than the input; expected one of the same")
        return np.flatnonzero(np.isin(group.ix, chosen.ix))

    members = _members_of(len(group), lambda text: beads_of(group.select_atoms(text)))
    return beads, _set_groups(beads, groups, len(group),
                              lambda chosen: beads_of(chosen) if is_atom_group(chosen) else members(chosen))


def _has_times(trajectory):
    """Whether the times of a trajectory are known. Many writers of DCD leave the time step at 1 in CHARMM's unit, which
    MDAnalysis reads as 0.0489 ps. The program takes such times as unknown."""
    return trajectory.format != "DCD" or abs(trajectory.dt - 0.04888821) > 1e-6


def _positions_of_group(group, atoms, frame):
    if not np.array_equal(group.ix, atoms):
        raise InputError(f"AtomGroup: has other atoms in frame {frame}; expected those of the first frame, as in "
                         "u.atoms[group.ix]")
    return group.positions


class _Kept:
    """Returns a trajectory to the frame where it stood. Silences NumPy meanwhile, because MDAnalysis divides by zero at
    each frame of a file with empty cells."""

    def __init__(self, trajectory):
        self.trajectory = trajectory
        self.frame = trajectory.frame
        self.quiet = np.errstate(divide="ignore", invalid="ignore")

    def __enter__(self):
        self.quiet.__enter__()
        return self.trajectory

    def __exit__(self, *raised):
        try:
            self.trajectory[self.frame]
        finally:
            self.quiet.__exit__(*raised)


def _collect_group(group, beads, chosen, wants_velocities):
    """Copies the frames of an AtomGroup, and their velocities if all chosen frames have them. If there is a cell, the frames
    between those asked for are copied too, because the library follows the images of chains from frame to frame; their
    velocities are not read."""
    atoms = np.array(group.ix)
    with _Kept(group.universe.trajectory) as trajectory:
        trajectory[chosen.start]
        has_cell = trajectory.ts.dimensions is not None
        read = range(chosen.start, chosen[-1] + 1) if has_cell else chosen
        positions = np.empty((len(read), len(atoms), 3), dtype=np.float32)
        velocities = np.zeros_like(positions) if wants_velocities else None
        times, cells, without = [], [], []  # without: chosen frames that have no velocities
        for k, ts in enumerate(trajectory[read.start:read.stop:read.step]):
            positions[k] = _positions_of_group(group, atoms, ts.frame)
            if wants_velocities and ts.frame in chosen:
                if ts.has_velocities:
                    velocities[k] = group.velocities
                else:
                    without.append(ts.frame)
            if _has_times(trajectory):
                times.append(ts.time)
            if has_cell:
                cells.extend(np.zeros(6) if ts.dimensions is None else np.asarray(ts.dimensions, dtype=float))
    if without:
        velocities = None
    if 0 < len(without) < len(chosen):
        warn([f"AtomGroup: velocities are differences of frames, because frame {without[0]} has no velocities"])
    beads.times, beads.cells = times, cells
    beads.first_frame, beads.frame_step = read.start, read.step
    return positions, chosen.step // read.step, velocities


def _pull_group(group, wants_velocities):
    """Returns a function that reads one frame of an AtomGroup."""
    atoms = np.array(group.ix)

    def read(frame):
        with _Kept(group.universe.trajectory) as trajectory:
            ts = trajectory[frame]
            positions = plain(f"frame {frame}", _positions_of_group(group, atoms, frame))
            cell = None if ts.dimensions is None else [float(length) for length in ts.dimensions]
            velocities = plain("velocities", group.velocities) if wants_velocities and ts.has_velocities else None
            return positions, float(ts.time) if _has_times(trajectory) else None, cell, velocities

    return read


def _open_group(group, chosen_of, pull, wants_elements, wants_velocities, necklaces, groups):
    trajectory = group.universe.trajectory
    filename = getattr(trajectory, "filename", None)
    label = os.path.basename(str(filename)) if filename else "AtomGroup"
    if len(group) == 0:
        raise InputError("AtomGroup: has no atoms; expected two or more")
    beads, more = _beads_of_group(group, label, wants_elements, necklaces, groups)
    chosen = chosen_of(len(trajectory), label)
    if pull:
        more += ["--frames", f"{chosen.start}:{chosen[-1] + 1}:{chosen.step}"]
        return beads, more, (_pull_group(group, wants_velocities), len(trajectory), len(group))
    positions, stride, velocities = _collect_group(group, beads, chosen, wants_velocities)
    return beads, more + (["--frames", f"::{stride}"] if stride > 1 else []), (positions, velocities)


def _open_mdtraj(trajectory, chosen_of, wants_elements, necklaces, groups, dt):
    beads = _kds.Beads("mdtraj trajectory")
    beads.nanometres = True
    atoms = list(trajectory.topology.atoms)
    chains = [chr(65 + atom.residue.chain.index % 26) for atom in atoms]
    beads.names = _atom_names([atom.name for atom in atoms], [atom.residue.name for atom in atoms],
                              [atom.residue.resSeq for atom in atoms], chains,
                              [atom.residue.index for atom in atoms])
    _add_chains(beads, necklaces, [atom.residue.chain.index for atom in atoms], chains)
    if wants_elements:
        beads.elements = [atom.element.symbol for atom in atoms]
    times = np.asarray(trajectory.time, dtype=float)
    # mdtraj numbers the frames of files without times
    are_numbers = len(times) > 1 and np.array_equal(times, times[0] + np.arange(len(times)))
    if are_numbers and dt is None:
        warn(["mdtraj trajectory: its times are 0, 1, 2 ..., as of files without times; they are taken for picoseconds; "
              "dt gives the true spacing"])
    if not are_numbers or dt is None:
        beads.times = times.tolist()
    if trajectory.unitcell_lengths is not None:
        lengths = np.float32(10) * np.asarray(trajectory.unitcell_lengths, dtype=np.float32)
        cells = np.hstack([lengths, np.asarray(trajectory.unitcell_angles, dtype=np.float32)])
        beads.cells = cells.astype(float).ravel().tolist()
    more = _set_groups(beads, groups, len(atoms), _members_of(len(atoms), trajectory.topology.select))
    return _open_positions(trajectory.xyz, beads, chosen_of, more)


def _open_array(source, chosen_of, units, necklaces, times, groups):
    beads = _kds.Beads("array")
    beads.nanometres = units == "nm"
    if hasattr(source, "__array__"):
        positions = numbers(beads.label, source)
    else:
        # A trajectory reuses one buffer for all frames, so each frame is copied.
        frames = []
        for k, item in enumerate(source):
            positions, time = frame_of(item, f"frame {k}")
            frames.append((positions.copy(), time))
        shapes = {np.shape(frame) for frame, _ in frames}
        if len(shapes) > 1:
            raise InputError(f"frames: have the shapes {sorted(shapes)}; expected one shape (beads, 3)")
        positions = np.stack([frame for frame, _ in frames]) if frames else np.empty((0, 0, 3))
        if times is None and frames and all(time is not None for _, time in frames):
            times = [time for _, time in frames]
    if times is not None:
        times = numbers("times", times)
        if times.ndim != 1 or positions.ndim == 3 and len(times) != len(positions):
            raise InputError(f"times: has {times.size} times; expected {len(positions)}, one for each frame")
        beads.times = [number("times", time, "finite picoseconds") for time in times]
    _add_chains(beads, necklaces, None, None)
    more = []
    if groups is not None and positions.ndim == 3:
        more = _set_groups(beads, groups, positions.shape[1], _members_of(positions.shape[1]))
    return _open_positions(positions, beads, chosen_of, more)


def _open_positions(positions, beads, chosen_of, more):
    if positions.ndim == 3 and len(positions):
        chosen = chosen_of(len(positions), beads.label)
        if chosen != range(len(positions)):
            more = more + ["--frames", f"{chosen.start}:{chosen[-1] + 1}:{chosen.step}"]
    return beads, more, (plain(beads.label, positions), None)


def _path_text(path):
    """Returns a path as an argument that the program does not take for an option."""
    text = os.fspath(path)
    if "\0" in text or text != text.encode("utf-8", "replace").decode("utf-8"):
        raise InputError(f"{text!r}: is no path in UTF-8; expected one without null characters")
    return os.path.join(".", text) if text.startswith("-") else text


def _open_paths(paths, start, stop, step, units, necklaces, times, velocities, groups, radius):
    if velocities is not None and not isinstance(velocities, str):
        raise InputError("velocities: an array is for positions in memory; expected 'file' or 'differences'")
    for name, value in (("necklaces", necklaces), ("times", times)):
        if value is not None:
            raise InputError(f"{name}: is for positions in memory, not for files; expected chain or dt")
    if radius is not None and np.ndim(radius) > 0:
        raise InputError("radius: an array is for positions in memory; expected file:PATH, with a line a bead")
    more = [] if (start, stop, step) == (None, None, None) else ["--frames", _range_text(start, stop, step)]
    if units is not None:
        more += ["--units", str(units)]
    if groups is not None:
        _check_two(groups)
        more += ["--groups", *(str(group) for group in groups)]
    if radius is not None:
        more += ["--radius", str(radius)]
    if velocities is not None:
        more += ["--velocities", velocities]
    return Input([*(_path_text(path) for path in paths), *more])


def open_input(source, *, start=None, stop=None, step=None, units=None, necklaces=None, times=None, velocities=None,
               groups=None, radius=None, pull=False, options=None):
    """Opens any input. `pull` reads the frames of an AtomGroup one at a time instead of copying them."""
    if is_path(source) or is_paths(source):
        paths = [source] if is_path(source) else source
        return _open_paths(paths, start, stop, step, units, necklaces, times, velocities, groups, radius)

    for name in ("topology", "select", "chain", "format", "until_damage"):
        if (options or {}).get(name):
            raise InputError(f"{name}: is for files; positions in memory are the beads that were chosen")
    check_unit_name(units)
    if (is_atom_group(source) or is_mdtraj(source)) and units is not None:
        raise InputError("units: an AtomGroup and an mdtraj Trajectory have their own; expected no units")
    if (is_atom_group(source) or is_mdtraj(source)) and times is not None:
        raise InputError("times: an AtomGroup and an mdtraj Trajectory have their own; expected no times, or dt")
    if not is_frames(source):
        refuse_others(source)

    def chosen_of(frames, label):
        return _indices(start, stop, step, frames, label)

    wants_elements = isinstance(radius, str) and radius.startswith("element")
    if is_atom_group(source):
        if velocities is not None and not isinstance(velocities, str):
            raise InputError("velocities: an AtomGroup has its own; expected 'file' or 'differences'")
        motions = _text([(options or {}).get(name) for name in ("motion", "motions")]).split(",")
        wants_velocities = velocities != "differences" and "hermite" in motions
        beads, more, frames = _open_group(source, chosen_of, pull, wants_elements, wants_velocities, necklaces, groups)
    elif is_mdtraj(source):
        beads, more, frames = _open_mdtraj(source, chosen_of, wants_elements, necklaces, groups,
                                           (options or {}).get("dt"))
    else:
        beads, more, frames = _open_array(source, chosen_of, units, necklaces, times, groups)
    if radius is not None and np.ndim(radius) > 0:
        beads.radii = numbers("radius", radius).ravel().tolist()
        if not beads.radii:
            raise InputError("radius: is empty; expected one number for each bead")
        more = more + ["--radius", "array"]
    elif radius is not None:
        more = more + ["--radius", str(radius)]
    if isinstance(velocities, str):
        more = more + ["--velocities", velocities]
    elif velocities is not None:
        frames = (frames[0], plain("velocities", velocities))
        more = more + ["--velocities", "file"]
    memory = _kds.Frames(*frames, beads)
    return Input([memory.path, "--format", "memory", *more], memory)
