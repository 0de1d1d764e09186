"""Salt bridges and hydrogen bonds, from contacts of chosen atoms."""

import re

import numpy as np
from numpy.polynomial import Polynomial

from ._analyses import contacts
from ._inputs import is_frames, is_path, is_paths
from ._intervals import Intervals, union
from ._options import INPUT, OF_FILES, InputError, check_names, number, takes
from ._stepping import KineticRun

_OF_BASES, _OF_ACIDS = ("NZ", "NE", "NH1", "NH2", "ND1", "NE2"), ("OD1", "OD2", "OE1", "OE2")
_OPTIONS = [name for name in (*INPUT, *OF_FILES) if name not in ("velocities", "groups", "obstacle")]


def _all_atoms(source, options):
    """Returns the options, with all atoms of files unless `select` chooses others, and whether the source is files."""
    is_files = is_path(source) or is_paths(source)
    return {**({"select": "//*"} if is_files else {}), "apart": 1, **options}, is_files


@takes("contacts", without=("groups", "velocities"))
def salt_bridges(source, *, cutoff=4.0, bases=("LYS", "ARG"), acids=("ASP", "GLU"), verbose=False, **options):
    """Measures how long salt bridges last: contacts of a charged nitrogen of a basic residue with an oxygen of an acid.

    The input names atoms and residues: files, an AtomGroup or an mdtraj Trajectory. ``bases`` and ``acids`` are names of
    residues; add charged histidine as the force field names it, such as "HSP" or "HIP". Nitrogens are NZ, NE, NH1, NH2, ND1 and
    NE2, oxygens OD1, OD2, OE1 and OE2. Returns :class:`kds.Contacts`, by residue unless ``by`` says otherwise: two residues are
    bridged while any two such atoms are within the ``cutoff``, also neighbours (``apart`` is 1). Times are exact, as in :func:`kds.contacts`, whose options hold.
    """
    check_names(salt_bridges, options)
    for name, residues in (("bases", bases), ("acids", acids)):
        if not isinstance(residues, (list, tuple)) or not residues or not all(isinstance(one, str) for one in residues):
            raise InputError(f"{name}: is {residues!r}; expected names of residues, such as ('LYS', 'ARG')")
    options, is_files = _all_atoms(source, {"by": "residue", **options})
    form = "//*/({})/{}" if is_files else "resname {} and name {}"
    comma = "," if is_files else " "
    groups = [form.format(comma.join(residues), comma.join(atoms))
              for residues, atoms in ((bases, _OF_BASES), (acids, _OF_ACIDS))]
    return _of_groups("bases, acids", source, cutoff=cutoff, groups=groups, verbose=verbose, **options)


def _of_groups(names, source, **options):
    """Finds contacts of groups. An error about groups names the arguments that they come from."""
    try:
        return contacts(source, **options)
    except InputError as error:
        raise InputError(re.sub("^(groups|group [01])", names, str(error))) from None


class HydrogenBonds(Intervals):
    """Hydrogen bonds over time. Made by :func:`kds.hydrogen_bonds`.

    ``rows``
        one row for each hydrogen ``i`` with an acceptor ``j`` that it is ever bonded to, with their names and that of the
        ``donor``: ``contacts`` (number of bonds), ``occupancy``, ``residence``, ``total`` and ``longest`` as in
        :class:`kds.Contacts`.
    ``intervals``
        one row for each bond, with its beginning and end.
    """

    def __init__(self, found, names, unit, start, length, donor_of):
        self._set_intervals(found, names, unit, start, length)
        self._set_rows(donor=np.array([names[donor_of[i]] for i in self._pairs()[0][:, 0].tolist()], dtype=str))


@takes("contacts", only=_OPTIONS)
def hydrogen_bonds(source, *, distance=3.0, angle=150.0, hydrogens=None, heavy=None, bond=1.2, **options):
    """Finds hydrogen bonds between frames, by the distance of donor and acceptor and the angle donor-hydrogen-acceptor.

    A bond exists while the distance is at most ``distance`` (angstrom) and the angle at least ``angle`` (degrees, from 90).
    Atoms move on straight lines between frames. Times at which the distance passes its limit are the exact times, rounded to
    doubles. Times at which the angle passes its limit are approximate: they are roots of a polynomial of degree 4, computed with
    doubles. The tests allow 1e-11 of a step; slower angles have larger errors (1e-9 of a step if the vectors change by 1e-6 of
    their length). An angle that only touches its limit may count or not. Returns :class:`kds.HydrogenBonds`.

    ``hydrogens`` and ``heavy`` are as ``groups`` of :func:`kds.contacts`. ``heavy`` are the atoms that may be donors or acceptors
    (default: all nitrogens and oxygens). The donor of a hydrogen is the heavy atom within ``bond`` of it in the first frame. To
    choose acceptors, filter the rows by ``second``. The input is read three times.
    """
    check_names(hydrogen_bonds, options)
    if not is_frames(source) or str(source).startswith("imd:"):
        raise InputError("hydrogen_bonds: reads the frames three times; expected files, an array, an AtomGroup or mdtraj")
    distance, bond = number("distance", distance), number("bond", bond)
    if not distance >= 2 * bond > 0:
        raise InputError(f"distance: is {distance:g}; expected at least twice bond, {2 * bond:g}")
    cosine = np.cos(np.radians(number("angle", angle)))
    if not 90 <= angle < 180:
        raise InputError(f"angle: is {angle}; expected degrees from 90 to less than 180")
    options, is_files = _all_atoms(source, {"radius": 1, **options})  # distances are those of centers
    hydrogens = ("//*/*/[H]" if is_files else "element H") if hydrogens is None else hydrogens
    heavy = ("//*/*/[N,O]" if is_files else "element N O") if heavy is None else heavy
    run = KineticRun(source, structures="box", **{name: value for name, value in options.items() if name != "apart"})
    _in_cell(run, distance + bond)
    bonds = _of_groups("hydrogens, heavy", source, cutoff=bond, groups=(hydrogens, heavy), by="bead", **options).intervals
    if not np.any(bonds["open_at_start"]):
        raise InputError(f"bond: no hydrogen has a heavy atom within {bond:g} in the first frame; expected a longer bond")
    near = _of_groups("heavy", source, cutoff=distance, groups=(heavy, heavy), by="bead", **options)
    of, atoms, donor_of = _triples(bonds, near, bond)
    begin, end = near._arrays["begin_step"][of], near._arrays["end_step"][of]
    found = []  # parts of steps in which a triple is bonded: triple, begin, end
    last = len(near.frame_numbers) - 1
    for step in range(last):
        inside = np.flatnonzero((begin <= step + 1) & (end >= step) & ((begin < step + 1) | (step + 1 == last)))
        if len(inside):
            spans = np.clip([begin[inside] - step, end[inside] - step], 0, 1)
            vectors = _vectors(run, [atom[inside] for atom in atoms], spans.mean(axis=0), distance + bond)
            found += [(int(inside[k]), step + first, step + second)
                      for k in range(len(inside)) for first, second in _wide_parts(vectors[:, k], *spans[:, k], cosine)]
        run.step()
    stamps = [run._core.stamp(frame) for frame in range(last + 1)]
    columns = _columns(found, atoms, near, stamps)
    return HydrogenBonds(columns, near.names, near.unit, near._start, near._length, donor_of)


def _triples(bonds, near, bond):
    """Returns the intervals in which two heavy atoms are near and one of them has a hydrogen: arrays of the index of the interval
    in `near`, and of its donor, hydrogen and acceptor. Returns also the donor of each hydrogen. `bonds` are intervals of
    hydrogens with heavy atoms."""
    first, second = near._arrays["first"].tolist(), near._arrays["second"].tolist()
    heavy, hydrogens_of, donor_of, triples = {*first, *second}, {}, {}, []
    at_start = np.asarray(bonds["open_at_start"])
    for pair in zip(np.asarray(bonds["i"])[at_start].tolist(), np.asarray(bonds["j"])[at_start].tolist()):
        for donor, hydrogen in (pair, pair[::-1]):
            if donor in heavy:
                if hydrogen in donor_of:
                    raise InputError(f"bond: {near.names[hydrogen]} has two donors within {bond:g} in the first frame; expected "
                                     "a shorter bond")
                hydrogens_of.setdefault(donor, []).append(hydrogen)
                donor_of[hydrogen] = donor
    for k, pair in enumerate(zip(first, second)):
        for donor, acceptor in (pair, pair[::-1]):
            triples += [(k, donor, hydrogen, acceptor) for hydrogen in hydrogens_of.get(donor, ())]
    of, *atoms = np.array(triples, np.int64).reshape(-1, 4).T
    return of, atoms, donor_of


def _columns(parts, atoms, near, stamps):
    """Returns the arrays of Intervals for parts (triple, begin, end). Parts that meet are one."""
    triple, begin, end = np.array(parts, float).reshape(-1, 3).T
    first, last = union(triple, begin, end)
    columns = dict(zip(("first", "second"), (atom[triple[first].astype(int)] for atom in atoms[1:])))
    ends, clock = (begin[first], end[last]), "time" if near.unit == "ps" else "frame"
    for reading, readings in zip(("frame", "time") if clock == "time" else ("frame",), zip(*stamps)):
        columns.update({f"{side}_{reading}": np.interp(step, np.arange(len(stamps)), readings)
                        for side, step in zip(("begin", "end"), ends)})
    columns.update(length=columns[f"end_{clock}"] - columns[f"begin_{clock}"], open_at_start=ends[0] == 0,
                   open_at_end=ends[1] == len(stamps) - 1, begin_step=ends[0], end_step=ends[1],
                   frame_numbers=near.frame_numbers)
    return columns


def _vectors(run, atoms, middle, reach):
    """Returns the vectors from hydrogens to donors and to acceptors at both ends of the present step, (2, triples, 2, 3). In a
    cell, they are those of images that are nearest at the times `middle`. Longer vectors than `reach` are of no interest."""
    points = run.control_points()
    donor, hydrogen, acceptor = (points[atom] for atom in atoms)
    vectors = np.stack([donor - hydrogen, acceptor - hydrogen])
    cell, across = _in_cell(run, reach)
    if across is None:
        return vectors
    share = middle[None, :, None]
    shifts = np.rint(((1 - share) * vectors[:, :, 0] + share * vectors[:, :, 1]) @ across)
    return vectors - np.einsum("ptk,kec->ptec", shifts, cell)


def _in_cell(run, reach):
    """Returns the control points of the cell's vectors in the present step, and the inverse of their mean, None without a cell.
    Raises InputError if vectors as long as `reach` do not tell which image is nearest."""
    cell = run._core.cell_points()
    if len(cell) == 0:
        return cell, None
    across = np.linalg.pinv(cell.mean(axis=1))
    if 2 * reach * np.linalg.norm(across, axis=0).max() >= 1:
        raise InputError(f"distance: with bond it is {reach:g}; expected less than half the width of the cell")
    return cell, across


def _trimmed(polynomial):
    """Leaves out the highest terms that vanish beside the others from 0 to 1. Their roots would be out of range."""
    return polynomial.trim(1e-100 * np.abs(polynomial.coef).max())


def _wide_parts(vectors, begin, end, cosine):
    """Returns the parts of a step from `begin` to `end` in which the angle of two vectors, linear in time, has at most this
    cosine, which is not positive."""
    vectors = vectors / np.maximum(np.abs(vectors).max(axis=(1, 2), keepdims=True), np.finfo(float).tiny)  # no overflow
    u, v = np.stack([vectors[:, 0], vectors[:, 1] - vectors[:, 0]], axis=1)  # for each its value at 0 and its velocity
    dot, uu, vv = (Polynomial([a[0] @ b[0], a[0] @ b[1] + a[1] @ b[0], a[1] @ b[1]]) for a, b in ((u, v), (u, u), (v, v)))
    excess = dot * dot - cosine * cosine * uu * vv
    cuts = np.real(np.concatenate([_trimmed(excess).roots(), _trimmed(dot).roots()]))
    ends = [begin, *np.sort(cuts[(cuts > begin) & (cuts < end)]), end]
    parts = [(float(first), float(second), (first + second) / 2) for first, second in zip(ends, ends[1:])]
    return [(first, second) for first, second, middle in parts if dot(middle) <= cosine * np.sqrt(uu(middle) * vv(middle))]
