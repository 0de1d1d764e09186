"""The program's commands besides ``kds run``, as functions."""

import re

import numpy as np

from . import _kds, _plots
from ._inputs import open_input
from ._options import InputError, arguments, call, flag, number, warn
from ._tables import Result, table, table_of_rows


def _analyse(function, source, verbose, unit, start, stop, step, units, necklaces, times, groups, radius, options):
    given = arguments(options)
    opened = open_input(source, start=start, stop=stop, step=step, units=units, necklaces=necklaces, times=times,
                        groups=groups, radius=radius, options=options)
    return find(function, opened, given, verbose=verbose, unit=unit)


def find(function, opened, given, known=(), verbose=False, unit="step"):
    """Returns what an analysis of an input finds, and issues its warnings except the known ones."""
    try:
        found = call(function, opened.arguments + given, verbose=verbose, unit=unit)
    except InputError as error:
        if opened.memory is None or "or topology FILE" not in str(error):
            raise
        sentence = str(error).replace("or topology FILE", "or an AtomGroup or mdtraj Trajectory, which name residues")
        raise InputError(sentence) from None
    if opened.memory is not None:
        path = opened.memory.path  # memory/NUMBER/LABEL
        for text in ("json", "table"):
            found[text] = found[text].replace(path, path.split("/", 2)[2])
    warn([line for line in map(_kds.in_python, found["warnings"]) if line not in known])
    return found


class Contacts(Result):
    """How long contacts last. Made by :func:`kds.contacts`.

    ``rows``
        one row for each pair that is ever in contact: the elements ``i``, ``j`` with their names, the number of contacts,
        ``occupancy`` (share of time in contact, from 0 to 1), ``residence`` (time in contact divided by the number of ends,
        NaN without an end), ``begin_rate`` (beginnings per time without contact), ``end_rate`` (ends per time in contact),
        each with the ends of its 95% interval such as ``residence_lower``, total and longest time in contact.
    ``intervals``
        one row for each contact, with its beginning and end.
    ``survival``
        the survival function of Kaplan and Meier with its 95% band, of the contacts that begin in the run.
    ``frames``
        the same figures as frames alone show them, by the spacing of frames.
    ``all``
        the figures of all pairs that were asked for, a dictionary. It also has the median life of a contact.
    ``unit``
        ``ps`` or ``frames``, the unit of all lengths of time.
    """

    def __init__(self, found):
        super().__init__(found)
        self.table = re.sub(r"; --out DIR writes all of them", "; rows has all of them", self.table)
        self.names = found["names"]
        self.all = self.json["all"]
        self.unit = self.json["unit"]
        self.survival = table_of_rows(self.json["survival"])
        self.frames = table_of_rows(self.json["frames"])
        names = np.array(self.names)
        columns = {"i": found["first"], "j": found["second"], "first": names[found["first"]],
                   "second": names[found["second"]]}
        columns.update({name: found[name] for name in ("begin_frame", "end_frame")})
        if self.unit == "ps":
            columns.update({name: found[name] for name in ("begin_time", "end_time")})
        columns["length"] = found["length"]
        columns.update({name: found[name].astype(bool) for name in ("open_at_start", "open_at_end")})
        self.intervals = table(columns)

    def map(self):
        """Returns the share of time in contact of each pair, a symmetric array (elements, elements)."""
        occupancy = np.zeros((len(self.names), len(self.names)))
        for row in self.json["rows"]:
            occupancy[row["i"], row["j"]] = occupancy[row["j"], row["i"]] = row["occupancy"]
        return occupancy

    def plot_map(self, ax=None):
        """Draws ``map()``. Returns the axes of matplotlib."""
        return _plots.contact_map(self, ax)

    def plot(self, ax=None):
        """Draws the survival function with its band. Returns the axes of matplotlib."""
        return _plots.survival(self, ax)


def cutoff_text(cutoff):
    """Returns one or two lengths as the program takes them."""
    lengths = cutoff if np.ndim(cutoff) > 0 else [cutoff]
    return ":".join(repr(number("cutoff", length, "a length in angstrom, or a pair of lengths")) for length in lengths)


def contacts(source, *, cutoff, by=None, gap=0, surface=False, start=None, stop=None, step=None, radius=None, units=None,
             necklaces=None, times=None, groups=None, verbose=False, **options):
    """Measures how long contacts last, exactly for the paths between frames, and as frames alone show them.

    ``source``, ``start``, ``stop``, ``step``, ``radius``, ``units``, ``necklaces``, ``times`` and ``groups`` are those of
    :func:`kds.run`. ``cutoff`` is the distance in angstrom within which centres are in contact (surfaces if
    ``surface``); a pair of lengths are two cutoffs: a contact begins within the first and ends outside the second.
    ``by`` is ``residue``, ``bead`` or ``chain`` (default: residue if the input names residues, otherwise bead). Two
    residues are in contact while any two of their beads are, so a selection of heavy atoms suits a ``cutoff`` of 4.5 and
    one of C-alpha atoms a ``cutoff`` of 8. Two elements of one chain count only if they are at least ``apart`` apart along it (default: 3).
    An absence shorter than ``gap`` (picoseconds if the frames have times, otherwise frames) does not end a contact.
    Further options: ``strides``, ``intermittency``, ``motion``, ``topology``, ``select``, ``chain``, ``obstacle``,
    ``dt``, ``certify``, ``threads`` (default: all cores). Returns :class:`kds.Contacts`, whose help explains the rows.

    >>> import kds
    >>> found = kds.contacts(kds.generate("spiral", beads=30, frames=10), cutoff=2.5, by="bead")
    >>> found.unit, len(found.rows) == found.all["contacts"] - sum(found.rows["contacts"] - 1)
    ('frames', True)
    """
    if gap is not None:
        gap = number("gap", gap, "a length of time from 0") or None
    options = dict(options, cutoff=cutoff_text(cutoff), by=by, gap=gap, surface=flag("surface", surface))
    return Contacts(_analyse(_kds.contacts, source, verbose, "step", start, stop, step, units, necklaces, times, groups,
                             radius, options))


class Comparison(Result):
    """How often structures change. Made by :func:`kds.compare`. ``pooled`` has means over several inputs."""

    def __init__(self, found):
        super().__init__(found)
        self.pooled = table_of_rows(self.json["pooled"])


def compare(source, *, start=None, stop=None, step=None, radius=None, units=None, necklaces=None, times=None, verbose=False,
            **options):
    """Compares how often structures change, by stride and motion.

    The input is that of :func:`kds.run`; each path of a list is a run of its own. Options: ``structures``, ``strides``
    (such as [1, 2, 4]), ``motions`` (such as ["linear", "hermite"]), ``rounds``, ``apart``, ``directions``, ``threads``
    (default: all cores). Returns :class:`kds.Comparison`, whose ``rows`` have a row for each structure, stride and motion.

    >>> import kds
    >>> found = kds.compare(kds.generate("spiral", beads=30, frames=9), radius=1, strides=[1, 2], rounds=1)
    >>> len(found.rows)
    4
    """
    return Comparison(_analyse(_kds.compare, source, verbose, "step", start, stop, step, units, necklaces, times,
                                   None, radius, options))


class Updates(Result):
    """The work of each technique. Made by :func:`kds.update`."""


def update(source, *, start=None, stop=None, step=None, radius=None, units=None, necklaces=None, times=None, verbose=False,
           **options):
    """Compares techniques that update the power diagram from frame to frame.

    The input is that of :func:`kds.run`. Options: ``techniques`` (of rebuild, reinsert, greedy, kinetic, hermite, lifted,
    activate, auto), ``strides``, ``rounds``, ``audit``. Returns :class:`kds.Updates`, whose ``rows`` have a row for each
    technique and stride.

    >>> import kds
    >>> found = kds.update(kds.generate("spiral", beads=30, frames=5), radius=1, techniques=["kinetic"], rounds=1)
    >>> list(found.rows["technique"])
    ['rebuild', 'kinetic']
    """
    return Updates(_analyse(_kds.update, source, verbose, "round", start, stop, step, units, necklaces, times,
                                None, radius, options))


class Collisions(Result):
    """The colliding pairs of each frame. Made by :func:`kds.collide`.

    ``pairs`` is an array (m, 2) of beads, and ``pair_frames`` has the number of the frame of each. ``frames`` is a table
    with a row for each frame: how many pairs collide, and which pair is the closest at what distance.
    """

    def __init__(self, found):
        super().__init__(found)
        self.pairs = found["pairs"]
        self.pair_frames = found["frames"]
        self.frames = table_of_rows(self.json["frames"])


def collide(source, *, start=None, stop=None, step=None, radius=None, units=None, necklaces=None, times=None, groups=None,
            verbose=False, **options):
    """Finds exactly which beads collide in each frame. Balls that just touch collide.

    The input is that of :func:`kds.run`. Options: ``method`` (default: auto; ``all`` compares all detectors), ``pairs``
    (within, between or all), ``apart``, ``within`` (angstrom between surfaces), ``rounds``. Returns
    :class:`kds.Collisions`.

    >>> import kds
    >>> found = kds.collide(kds.generate("spiral", beads=30, frames=5), radius=1.2)
    >>> found.pairs.shape[1], len(found.frames)
    (2, 5)
    """
    options.setdefault("method", "auto")
    return Collisions(_analyse(_kds.collide, source, verbose, "frame", start, stop, step, units, necklaces, times,
                                   groups, radius, options))


class Trade(Result):
    """The cost and the errors of each setting. Made by :func:`kds.trade`. ``recommendation`` says in words which to take."""

    def __init__(self, found):
        super().__init__(found)
        self.recommendation = self.json["recommendation"]


def trade(source, *, start=None, stop=None, step=None, radius=None, units=None, necklaces=None, times=None, groups=None,
          verbose=False, **options):
    """Measures the speed and the errors of each lever of accuracy on an input: strides, tolerances, relaxed spheres, ...

    The input is that of :func:`kds.run`. Options: ``want`` (a list of contacts, cages, diagram, events, scenes), ``apart``,
    ``rounds``, ``times_examined`` as ``times`` of the program, ``seed``, ``cutoff``, ``without_exact`` and
    ``threads``. Returns :class:`kds.Trade`, whose ``rows`` have a row for each setting. Takes several times as long as a run.

    >>> import kds
    >>> spiral = kds.generate("spiral", beads=30, frames=9)
    >>> found = kds.trade(spiral, radius=1.1, want=["cages"], rounds=1, times_examined=4, without_exact=True)
    >>> bool(found.rows["want"][0] == "cages")
    True
    """
    if "times_examined" in options:
        options["times"] = options.pop("times_examined")
    return Trade(_analyse(_kds.trade, source, verbose, "run", start, stop, step, units, necklaces, times, groups, radius,
                          options))


class Conditions(Result):
    """The conditions of a proper necklace. Made by :func:`kds.conditions`. ``proper`` says whether all hold."""

    def __init__(self, found):
        super().__init__(found)
        self.proper = self.json["proper"]


def conditions(source, *, start=None, stop=None, step=None, radius=None, units=None, necklaces=None, times=None,
               verbose=False, **options):
    """Checks the conditions of a proper necklace in each frame: consecutive beads touch, all others are disjoint, ...

    The input is that of :func:`kds.run`. Option: ``rho``, the largest ratio of radii and of bonds that counts as uniform.
    Returns :class:`kds.Conditions`.

    >>> import kds
    >>> kds.conditions(kds.generate("spiral", beads=30, frames=3), radius=1).proper
    True
    """
    return Conditions(_analyse(_kds.conditions, source, verbose, "frame", start, stop, step, units, necklaces, times, None,
                               radius, options))


def generate(model, **options):
    """Generates a moving model necklace with beads of radius 1.

    Returns an array (frames, beads, 3), or a list of two for ``two-spirals``. ``model`` and the options ``beads``,
    ``frames``, ``seed``, ``motion``, ``step``, ``turns``, ... are those of ``kds generate``.

    >>> import kds
    >>> kds.generate("spiral", beads=30, frames=10).shape
    (10, 30, 3)
    """
    if str(model).startswith("-"):
        raise InputError(f"model: '{model}' is no model; help(kds.generate) has examples")
    try:
        necklaces = _kds.generate([str(model), *arguments(options, own=["frames"]), "-o", "necklace.xyz"])
    except InputError as error:
        sentence = str(error).replace("start, stop, step:", "frames:", 1).replace("MODEL:", "model:", 1)
        raise InputError(sentence) from None
    return necklaces[0] if len(necklaces) == 1 else necklaces
