"""The program's commands besides ``kds run``, as functions."""

import csv
import json
import os

import numpy as np

from . import _kds, _lifetimes, _plots
from ._inputs import Input, open_input
from ._intervals import Intervals
from ._options import INPUT, InputError, arguments, call, check_names, cutoff_text, flag, number, takes, warn
from ._tables import Result, table, table_of_rows


def _analyse(command, source, options, verbose, unit="step", more=()):
    """Runs a command of the program, also with the arguments `more`. `command` is the function of the package, whose
    signature the options must fit."""
    check_names(command, options)
    of_input = {name: value for name, value in options.items() if name in INPUT}
    given = arguments({name: value for name, value in options.items() if name not in INPUT})
    opened = open_input(source, **of_input, options=options)
    return find(getattr(_kds, command.__name__), opened, [*given, *more], verbose=verbose, unit=unit)


def find(function, opened, given, known=(), verbose=False, unit="step"):
    """Returns what an analysis of an input finds, and issues its warnings except the known ones."""
    found = call(function, opened.arguments + given, verbose=verbose, unit=unit)
    warn([line for line in found["warnings"] if line not in known])
    return found


def replay(log, *, verbose=False):
    """Repeats the run of an event log, with its edits, and compares every event. The file is written by
    ``kds.KineticRun(..., log=path)`` or ``kds run --log``.

    Returns a dictionary: ``log``, ``events`` (their number), ``logged_fingerprint``, ``same``, and ``difference`` (None if
    there is none). Raises InputError if a line of the log was not written by a run, or if an edit cannot be made.
    """
    return json.loads(find(_kds.replay, Input([os.fspath(log)]), [], verbose=verbose)["json"])["replay"]


class Contacts(Result, Intervals):
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
        self.all, self.unit = self.json["all"], self.json["unit"]
        self.survival = table_of_rows(self.json["survival"])
        self.frames = table_of_rows(self.json["frames"])
        arrays = {name: found[name] for name in ("first", "second", "begin_frame", "end_frame")}
        if self.unit == "ps":
            arrays.update({name: found[name] for name in ("begin_time", "end_time")})
        arrays["length"] = found["length"]
        arrays.update({name: found[name].astype(bool) for name in ("open_at_start", "open_at_end")})
        arrays.update({name: found[name] for name in ("begin_step", "end_step", "frame_numbers") if name in found})
        start = self.json["course"][0]["picoseconds" if self.unit == "ps" else "frame"]
        self._set_intervals(arrays, found["names"], self.unit, start, self.json["run_length"])

    def correlation(self, lags):
        """Returns the correlation functions of contacts at these lags, a table. They are exact for the paths between frames.

        ``intermittent`` is C(t): of the pairs that are in contact at a random time, the share that is in contact a lag later.
        ``continuous`` is S(t): the share that is in contact all the while. Contacts open at an end of the run count too.
        The 95% intervals, such as ``intermittent_lower``, are for another run of the same pairs, as in :meth:`over_time`. Lags
        above half of the run have none.
        """
        return _lifetimes.correlation(lags, [_lifetimes.Timeline(self)], in_order=True)

    def over_time(self):
        """Returns occupancy, residence and both rates with 95% intervals for another run of the same pairs, a dictionary.

        The intervals come from the spread over 16 stretches of the run. They allow for dependence between pairs if the run is
        many times as long as its slowest motion. Intervals of ``all`` are for other pairs and take pairs as independent. Use
        this method for the pairs of one molecule.
        """
        line = _lifetimes.Timeline(self)
        return _lifetimes.figures([line.counts(*one) for one in _lifetimes.stretches(line.length)], in_order=True)

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


@takes("contacts")
def contacts(source, *, cutoff, verbose=False, **options):
    """Measures how long contacts last, exactly for the paths between frames, and as frames alone show them.

    The input is that of :func:`kds.run`. ``cutoff`` is the distance in angstrom within which centres are in contact
    (surfaces if ``surface``); a pair of lengths are two cutoffs: a contact begins when the least distance of two beads of the
    pair falls to the first, and ends when it exceeds the second. Two residues are in contact while any two of their beads are, so a selection of heavy atoms suits a ``cutoff``
    of 4.5 and one of C-alpha atoms a ``cutoff`` of 8. Returns :class:`kds.Contacts`, whose help explains the rows.

    >>> import kds
    >>> found = kds.contacts(kds.generate("spiral", beads=30, frames=10), cutoff=2.5, by="bead")
    >>> found.unit, len(found.rows) == found.all["contacts"] - sum(found.rows["contacts"] - 1)
    ('frames', True)
    """
    if options.get("gap") is not None:
        options["gap"] = number("gap", options["gap"], "a length of time from 0")
    options["surface"] = flag("surface", options.get("surface", False))
    return Contacts(_analyse(contacts, source, {"cutoff": cutoff_text(cutoff, 2), **options}, verbose))


class Replicas:
    """Contacts of several runs of one system. Made by :func:`kds.contacts_of_replicas`.

    ``runs``
        :class:`kds.Contacts` of each replica.
    ``all``
        occupancy, residence and rates over all replicas, a dictionary. The 95% intervals come from the spread between replicas;
        they need three of them. An end that does not follow from the data is NaN.
    ``unit``
        ``ps`` or ``frames``, the unit of all lengths of time.
    """

    def __init__(self, runs):
        if len({(run.unit, run.all["pairs_asked"], *run.names) for run in runs}) != 1:
            raise InputError("replicas: differ in their elements or in the unit of time; expected several runs of one system")
        self.runs, self.unit = runs, runs[0].unit
        self._lines = [_lifetimes.Timeline(run) for run in runs]
        self.all = _lifetimes.figures([line.counts(0, line.length) for line in self._lines], in_order=False)

    def __repr__(self):
        def text(name):
            least, most = self.all[f"{name}_lower"], self.all[f"{name}_upper"]
            return f"{name} {self.all[name]:.4g}" + (f" (95%: {least:.4g} to {most:.4g})" if least == least else "")

        return f"<kds contacts of {len(self.runs)} runs: {text('occupancy')}, {text('residence')} {self.unit}>"

    def correlation(self, lags):
        """Returns the table of :meth:`kds.Contacts.correlation` over all replicas, with intervals from their spread."""
        return _lifetimes.correlation(lags, self._lines, in_order=False)

    def survival(self, times):
        """Returns the share of the contacts that begin which last longer than these times, a table. Intervals come from the
        spread between replicas."""
        return _lifetimes.pooled_survival(times, self._lines)


@takes("contacts")
def contacts_of_replicas(replicas, *, cutoff, verbose=False, **options):
    """Measures how long contacts last in several runs of one system, with intervals from the spread between runs.

    ``replicas`` is a list of inputs of :func:`kds.contacts`, such as paths, and each is a run of its own. The options hold for
    all of them. Returns :class:`kds.Replicas`. Intervals hold whether or not pairs depend on each other, and also if replicas
    differ more than one run shows.

    >>> import kds
    >>> chains = [kds.generate("random-chain", beads=30, frames=20, seed=seed) for seed in (1, 2, 3)]
    >>> found = kds.contacts_of_replicas(chains, cutoff=2.5, by="bead")
    >>> found.all["residence_lower"] < found.all["residence"] < found.all["residence_upper"]
    True
    """
    if not isinstance(replicas, (list, tuple)) or len(replicas) == 0:
        raise InputError("replicas: expected a list with an input for each replica, such as ['a.dcd', 'b.dcd', 'c.dcd']")
    return Replicas([contacts(one, cutoff=cutoff, verbose=verbose, **options) for one in replicas])


def _contacts_in(folder):
    """Returns the :class:`Contacts` that ``kds contacts --out`` has written to a folder."""
    with open(os.path.join(folder, "intervals.csv"), newline="", encoding="utf-8") as file:
        header, *lines = csv.reader(file)
    columns = dict(zip(header, zip(*lines) if lines else [()] * len(header)))
    found = {"names": None, "first": np.array(columns["i"], int), "second": np.array(columns["j"], int)}
    for name, column in (("begin_frame", "begin_frame"), ("end_frame", "end_frame"), ("begin_time", "begin_picoseconds"),
                         ("end_time", "end_picoseconds"), ("length", "length")):
        found[name] = np.array(columns.get(column, ()), float)
    for name in ("open_at_start", "open_at_end"):
        found[name] = np.array(columns[name]) == "true"
    for name, file_name in (("json", "contacts.json"), ("table", "contacts.csv")):
        with open(os.path.join(folder, file_name), encoding="utf-8") as file:
            found[name] = file.read()
    return Contacts({**found, "columns": found["table"].partition("\n")[0], "names": json.loads(found["json"])["names"]})


def contacts_of_parts(folder):
    """Reads the parts that ``kds contacts --out DIR --continue`` has written, and pools them.

    ``folder`` is DIR. The parts are the results in DIR itself, DIR/part2, DIR/part3 and so on. Returns :class:`kds.Replicas`
    with a run for each part. A contact that a part cuts off is censored there, and is not joined with one of the next part.
    Intervals take parts as independent and of similar length. They hold if each part is many times as long as the slowest
    motion of the system. Otherwise they are too narrow.
    """
    folder = os.fspath(folder) if isinstance(folder, (str, os.PathLike)) else repr(folder)
    numbers = sorted(int(name[4:]) for name in (os.listdir(folder) if os.path.isdir(folder) else ())
                     if name.startswith("part") and name[4:].isdigit())
    parts = [folder, *(os.path.join(folder, f"part{number}") for number in numbers)]
    for part in parts:
        if not os.path.isfile(os.path.join(part, "contacts.json")):
            raise InputError(f"{part}: has no contacts.json; expected a folder that kds contacts --out has written")
    return Replicas([_contacts_in(part) for part in parts])


class Comparison(Result):
    """How often structures change. Made by :func:`kds.compare`. ``pooled`` has means over several inputs."""

    def __init__(self, found):
        super().__init__(found)
        self.pooled = table_of_rows(self.json["pooled"])


@takes("compare")
def compare(source, *, verbose=False, **options):
    """Compares how often structures change, by stride and motion.

    The input is that of :func:`kds.run`; each path of a list is a run of its own. ``strides`` are such as [1, 2, 4], and
    ``motions`` such as ["linear", "hermite"]. Returns :class:`kds.Comparison`, whose ``rows`` have a row for each structure,
    stride and motion.

    >>> import kds
    >>> found = kds.compare(kds.generate("spiral", beads=30, frames=9), radius=1, strides=[1, 2], rounds=1)
    >>> len(found.rows)
    4
    """
    return Comparison(_analyse(compare, source, options, verbose))


class Updates(Result):
    """The work of each technique. Made by :func:`kds.update`."""


@takes("update")
def update(source, *, verbose=False, **options):
    """Compares techniques that update the power diagram from frame to frame.

    The input is that of :func:`kds.run`. Returns :class:`kds.Updates`, whose ``rows`` have a row for each technique and
    stride.

    >>> import kds
    >>> found = kds.update(kds.generate("spiral", beads=30, frames=5), radius=1, techniques=["kinetic"], rounds=1)
    >>> list(found.rows["technique"])
    ['rebuild', 'kinetic']
    """
    return Updates(_analyse(update, source, options, verbose, "round"))


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


@takes("collide")
def collide(source, *, verbose=False, **options):
    """Finds exactly which beads collide in each frame. Balls that just touch collide.

    The input is that of :func:`kds.run`. The default ``method`` is auto. Returns :class:`kds.Collisions`.

    >>> import kds
    >>> found = kds.collide(kds.generate("spiral", beads=30, frames=5), radius=1.2)
    >>> found.pairs.shape[1], len(found.frames)
    (2, 5)
    """
    options.setdefault("method", "auto")
    return Collisions(_analyse(collide, source, options, verbose, "frame"))


class Surface(Result):
    """Areas and volumes of the union of balls. Made by :func:`kds.surface`.

    ``rows``
        one row for each time: ``frame``, ``area``, ``volume`` and, with several chains, ``between_chains``, the contact area
        of beads of different chains.
    ``frames``
        the number in the file of each time, with a fraction between frames.
    ``areas``, ``volumes``
        arrays (times, beads): the area of the bead's sphere outside all other balls, and the volume of its ball within its
        cell of the power diagram.
    ``contacts``, ``contact_areas``, ``contact_times``
        the contacts of all times: an array (m, 2) of beads, the area in which their cells meet within the balls, and the
        index of the time.
    ``unit``
        the unit of lengths. Empty if they have none.
    """

    def __init__(self, found):
        super().__init__(found)
        self.unit = self.json["unit"]
        for name in ("frames", "areas", "volumes", "contacts", "contact_areas", "contact_times"):
            setattr(self, name, found[name])
        self._names = {of: np.array(found[of]) for of in ("names", "residue_names", "chain_names")}
        self._residue_of, self._chain_of = found["residue_of"], found["chain_of"]

    def _frame(self, names, areas, volumes, **columns):
        times, elements = areas.shape
        return table({"frame": np.repeat(self.frames, elements), **{key: np.tile(column, times)
                      for key, column in columns.items()}, "name": np.tile(names, times), "area": areas.ravel(),
                      "volume": volumes.ravel()})

    def atoms_frame(self):
        """Returns a table with a row for each bead at each time."""
        return self._frame(self._names["names"], self.areas, self.volumes, bead=np.arange(self.areas.shape[1]),
                           chain=self._names["chain_names"][self._chain_of])

    def residues_frame(self):
        """Returns a table with a row for each residue at each time. It has no rows if the input names no residues."""
        names = self._names["residue_names"]
        sums = [np.zeros((len(self.frames), len(names))) for _ in range(2)]
        if len(names) > 0:
            for total, values in zip(sums, (self.areas, self.volumes)):
                np.add.at(total.T, self._residue_of, values.T)
        return self._frame(names, *sums, residue=np.arange(len(names)))

    def contacts_frame(self):
        """Returns a table with a row for each contact of two beads at each time."""
        i, j = self.contacts.T
        return table({"frame": self.frames[self.contact_times], "i": i, "j": j, "area": self.contact_areas})


@takes("surface")
def surface(source, *, verbose=False, **options):
    """Measures the accessible area and the volume of the union of balls, and the contact areas of its beads.

    The input is that of :func:`kds.run`, with all atoms and their van der Waals radii by default. ``at`` lists times in
    frames that are read: 2.5 is halfway from frame 2 to frame 3. Returns :class:`kds.Surface`.

    >>> import kds
    >>> import numpy as np
    >>> two = np.array([[[0, 0, 0], [3, 0, 0]], [[0, 0, 0], [1, 0, 0]]])
    >>> found = kds.surface(two, radius=1, at=[0, 0.5])
    >>> found.areas.round(3)
    array([[12.566, 12.566],
           [12.566, 12.566]])
    """
    if options.get("radius") is None:
        options["radius"] = "element"
    return Surface(_analyse(surface, source, options, verbose, "frame"))


class Voids(Result):
    """The cavities of the union of balls. Made by :func:`kds.voids`.

    ``rows``
        one row for each cavity: when it was first and last closed, for how long in all, its openings, its volume over the
        frames in which it is closed, and its beads.
    ``stretches``
        one row for each stretch of time in which a cavity is closed: how it began and ended, and by which gate.
    ``volumes``
        one row for each cavity at each frame in which it is closed.
    ``frames``
        the Betti numbers ``b0``, ``b1``, ``b2`` (components, tunnels, voids) and the volume of all voids at each frame.
    ``lives``
        how many stretches there are, how many contain no frame, and how long they last, a dictionary.
    ``tunnels``
        how many tunnels began and ended, a dictionary.
    ``lives_of_tunnels``
        with the option ``tunnels``: one row for each tunnel, with the simplices that begin and end it.
    ``unit``
        the unit of lengths. Empty if they have none.
    """

    _ends = ["begin_frame", "begin_picoseconds", "began", "begin_beads", "begin_names", "end_frame", "end_picoseconds",
             "ended", "end_beads", "end_names", "in_a_frame"]
    _columns = {"stretches": ["cavity", "void", *_ends], "lives_of_tunnels": ["tunnel", *_ends],
                "volumes": ["frame", "cavity", "volume", "area"]}

    def __init__(self, found):
        super().__init__({**found, "columns": "cavity,first_closed_frame,last_closed_frame,began,ended,closed,longest,"
                          "openings,frames,volume_median,volume_least,volume_most,atoms,beads,names"})
        for name in ("stretches", "volumes", "frames", "lives_of_tunnels"):
            setattr(self, name, table_of_rows(self.json[name], self._columns.get(name, ())))
        self.lives, self.tunnels = self.json["lives"], self.json["tunnels"]
        self.unit = self.json["unit"]


@takes("voids")
def voids(source, *, verbose=False, **options):
    """Follows the voids of the union of balls: when each cavity opens and closes, by which gate, its atoms and its volume.

    The input is that of :func:`kds.run`, with all atoms and their van der Waals radii by default. Returns
    :class:`kds.Voids`.

    >>> import kds
    >>> import numpy as np
    >>> corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * [1, 1.01, 1.02]
    >>> found = kds.voids(np.stack([corners, 1.2 * corners]), radius=1.5)
    >>> [int(voids) for voids in found.frames["b2"]], str(found.rows["ended"][0])
    ([1, 0], 'opened')
    """
    if options.get("radius") is None:
        options["radius"] = "element"
    return Voids(_analyse(voids, source, options, verbose))


class Trade(Result):
    """The cost and the errors of each setting. Made by :func:`kds.trade`. ``recommendation`` says in words which to take."""

    def __init__(self, found):
        super().__init__(found)
        self.recommendation = self.json["recommendation"]


@takes("trade")
def trade(source, *, times_examined=None, verbose=False, **options):
    """Measures the speed and the errors of each lever of accuracy on an input: strides, tolerances, chord cages, ...

    The input is that of :func:`kds.run`. ``times_examined`` is ``--times`` of the program. Returns :class:`kds.Trade`, whose
    ``rows`` have a row for each setting. Takes several times as long as a run.

    >>> import kds
    >>> spiral = kds.generate("spiral", beads=30, frames=9)
    >>> found = kds.trade(spiral, radius=1.1, want=["cages"], rounds=1, times_examined=4, without_exact=True)
    >>> bool(found.rows["want"][0] == "cages")
    True
    """
    return Trade(_analyse(trade, source, options, verbose, "run", arguments({"times": times_examined})))


class Conditions(Result):
    """The conditions of a proper necklace. Made by :func:`kds.conditions`. ``proper`` says whether all hold."""

    def __init__(self, found):
        super().__init__(found)
        self.proper = self.json["proper"]


@takes("info")
def conditions(source, *, verbose=False, **options):
    """Checks the conditions of a proper necklace in each frame: consecutive beads touch, all others are disjoint, ...

    The input is that of :func:`kds.run`. Returns :class:`kds.Conditions`.

    >>> import kds
    >>> kds.conditions(kds.generate("spiral", beads=30, frames=3), radius=1).proper
    True
    """
    return Conditions(_analyse(conditions, source, options, verbose, "frame"))


@takes("generate")
def generate(model, *, beads=None, frames=None, **options):
    """Generates a moving model necklace with beads of radius 1.

    Returns an array (frames, beads, 3), or a list of two for ``two-spirals``. ``model``, the numbers of ``beads`` and
    ``frames`` and the options are those of ``kds generate``.

    >>> import kds
    >>> kds.generate("spiral", beads=30, frames=10).shape
    (10, 30, 3)
    """
    check_names(generate, options)
    if str(model).startswith("-"):
        raise InputError(f"model: '{model}' is no model; help(kds.generate) has examples")
    given = arguments({"beads": beads, "frames": frames, **options})
    necklaces = _kds.generate([str(model), *given, "-o", "necklace.xyz"])
    return necklaces[0] if len(necklaces) == 1 else necklaces
