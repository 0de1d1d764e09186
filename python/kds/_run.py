"""Runs of kinetic structures over a whole input."""

import json
import os

import numpy as np

from . import _kds, _plots
from ._inputs import open_input
from ._options import OF_FILES, OF_THE_INPUT, InputError, arguments, call, check_names, cutoff_text, flag, takes, warn, wholes
from ._structure import Clock, Structure
from ._tables import events_table, indented
from ._view import RecordedPage, view_of_new_run


def more_options(only):
    """Returns the options that have no text in the program."""
    more = _kds.MoreOptions()
    if only is not None:
        if not isinstance(only, dict):
            raise InputError("only: is no dictionary; expected beads by structures, as in {'contacts': [3, 4, 5]}")
        more.only = {str(name): wholes(f"only: {name}", beads) for name, beads in only.items()}
    return more


def run_arguments(cutoff, surface, options):
    """Returns the arguments of the program for the options of a run."""
    cutoff = None if cutoff is None else cutoff_text(cutoff)
    return arguments({"cutoff": cutoff, "surface": flag("surface", surface), **options})


def open_run(source, *, start=None, stop=None, step=None, units=None, necklaces=None, times=None, velocities=None,
             groups=None, radius=None, cutoff=None, surface=False, only=None, view=None, pull=False, **options):
    """Opens an input and the run over it, and issues the warnings about the input. `view` is the path of a page.

    Returns the run, the input, a function that opens the run over the same input again, with another page, and the
    warnings."""
    given = run_arguments(cutoff, surface, options)
    opened = open_input(source, start=start, stop=stop, step=step, units=units, necklaces=necklaces, times=times,
                        velocities=velocities, groups=groups, radius=radius, pull=pull, options=options)
    more = more_options(only)

    def open_core(page):
        shown = [] if page is None else ["--view", os.fspath(page)]
        return _kds.Run(opened.arguments + given + shown, more, opened.memory)

    core = open_core(view)
    warned = core.warnings()
    warn(warned)
    return core, opened, open_core, warned


class Run:
    """What a run found. Made by :func:`kds.run`.

    ``events``
        structured array with a row for each event: ``frame`` (in frames of the trajectory, with a fraction), ``time``
        (picoseconds, NaN without times), ``lower`` and ``upper`` (canonical bracket of the time in its step),
        ``step``, ``structure``, ``kind`` and ``beads`` (ids, then -1).
    ``fingerprint``
        16 hex digits, a hash of all events in their order. Equal runs have equal fingerprints on every machine.
    ``power``, ``wrapped``, ``contacts``, ...
        the structures of the run, see :class:`kds.Structure`.
    ``radii``, ``names``
        the radius in angstrom and the name of each bead.

    ``print(run)`` shows the program's table. The table compares with static structures, which are then built at every
    frame once.
    """

    @takes("run")
    def __init__(self, source, *, verbose=False, view=None, **options):
        check_names(Run.__init__, options)
        self._core, opened, self._open_again, self._warned = open_run(source, view=view, **options)
        self._options = options
        self._source = opened
        call(self._core.execute, verbose=verbose)
        later = self._core.warnings()
        warn(later)
        self._warned += later
        self._stamps = self._core.stamps()
        self._clock = Clock(self._stamps[0][0], self._stamps[1][0], len(self._stamps))
        self.events = self._core.take_events()
        self._core.keep_events(False)
        self.fingerprint = f"{self._core.fingerprint():016x}"
        self._table = None
        self._page = None
        if view is not None:
            self._core.write_view()
            self._page = RecordedPage(view)

    def events_frame(self):
        """Returns the events as a table with the columns of ``events``, and ``bead_0``, ``bead_1``, ... for its ids."""
        return events_table(self.events)

    @property
    def structures(self):
        """The names of the structures, in the order of the table."""
        return [name for name, _ in self._core.structures()]

    @property
    def kinds(self):
        """The kinds of events of each structure, by its name."""
        return dict(self._core.structures())

    @property
    def radii(self):
        """The radius of each bead, in angstrom."""
        return np.array(self._core.radii)

    @property
    def names(self):
        """The name of each bead, such as "CA of ALA 12 in chain A"; empty if the input has no names."""
        return self._core.bead_names()

    @property
    def bead_count(self):
        """The number of beads."""
        return self._core.bead_count

    @property
    def frame_count(self):
        """The number of frames."""
        return self._core.frame_count

    @property
    def frames(self):
        """The numbers of the frames in the trajectory."""
        return np.array([number for number, _ in self._stamps])

    @property
    def times(self):
        """The times of the frames in picoseconds; NaN for a frame without a time."""
        return np.array([np.nan if time is None else time for _, time in self._stamps])

    @property
    def summary(self):
        """The dictionary that ``kds run --json`` writes."""
        return json.loads(self._core.json())

    @property
    def results(self):
        """``events``, ``fingerprint``, ``frames`` and ``summary`` in one object, as analyses of MDAnalysis have it."""
        try:
            from MDAnalysis.analysis.base import Results
        except ImportError:
            from types import SimpleNamespace as Results
        return Results(events=self.events, fingerprint=self.fingerprint, frames=self.frames, summary=self.summary)

    def plot(self, ax=None):
        """Draws the number of events in each step, for each structure. Returns the axes of matplotlib."""
        return _plots.events(self, ax)

    def view(self, path=None, verbose=False):
        """Returns a page that shows the run, a :class:`kds.View`. Notebooks embed it.

        ``path`` is the file that the page is written to (default: no file). ``kds.run(..., view=path)`` writes the page
        while it runs; otherwise this function runs the structures again, on one thread. Raises InputError if the input
        has changed.
        """
        if self._page is not None and self._page.is_at(path):
            return self._page.view()

        def write(page):
            core = self._open_again(page)
            core.keep_events(False)
            call(core.execute, verbose=verbose)
            if f"{core.fingerprint():016x}" != self.fingerprint:
                raise InputError("view: the input has changed since the run; expected the frames of the run")
            core.write_view()

        return view_of_new_run(write, path)

    def _contacts(self, **options):
        from ._analyses import Contacts, find

        if self._core.is_live:
            raise InputError("lifetimes: a running simulation gives each frame once; expected kds.contacts(source, cutoff=...)")
        options = {name: value for name, value in options.items() if value is not None}
        for name in OF_THE_INPUT:
            if name in options:
                raise InputError(f"{name}: is that of the run; expected kds.contacts(source, {name}=...)")
        for name in ("only", "tolerance"):
            if self._options.get(name) is not None:
                raise InputError(f"{name}: lifetimes are of all beads on the paths of the input; expected a run without "
                                 f"{name}")
        if "surface" in options:
            options["surface"] = flag("surface", options["surface"])
        if "cutoff" in options:
            options["cutoff"] = cutoff_text(options["cutoff"], 2)
        else:
            length, between_surfaces = self._core.contact_distance
            options["cutoff"] = cutoff_text(length)
            options.setdefault("surface", between_surfaces)
        if options.get("by") != "chain":
            options.setdefault("apart", self._core.apart)
        own = arguments({**{name: self._options.get(name) for name in ("motion", "threads", *OF_FILES)}, **options})
        return Contacts(find(_kds.contacts, self._source, own, known=self._warned))

    def __getattr__(self, name):
        if name.startswith("_") or name not in dict(self._core.structures()):
            raise AttributeError(f"the run has no {name}; its structures are {', '.join(self.structures)}"
                                 if not name.startswith("_") else name)
        return Structure(self, name)

    def __dir__(self):
        return [*super().__dir__(), *self.structures]

    def __len__(self):
        return len(self.events)

    def __str__(self):
        if self._table is None:
            self._table = call(self._core.table, unit="frame")
        return self._table.rstrip("\n")

    def __repr__(self):
        return (f"<kds.Run: {self.bead_count} beads, {self.frame_count} frames, {len(self.events)} events of "
                f"{', '.join(self.structures)}, fingerprint {self.fingerprint}>")

    def _repr_html_(self):
        return indented(str(self))


@takes("run")
def run(source, *, verbose=False, view=None, **options):
    """Runs kinetic structures over moving beads and returns every event, exactly and in order.

    Parameters
    ----------
    source : path, list of paths, array, AtomGroup, mdtraj Trajectory or iterable
        Positions of the beads in every frame. An array has the shape (frames, beads, 3). It is not copied if it is
        float32 or float64 in C order, and must then not change while the run is used. A path is any file that
        ``kds run`` reads. Frames of an AtomGroup are copied, and its trajectory then stands at the frame where it stood.
        An iterable gives arrays (beads, 3), pairs of an array and a time in picoseconds, or objects with ``positions``.
    verbose : bool
        Shows a progress bar of tqdm.
    view : path
        Writes a page that shows the run in a browser to this file, as ``run.view`` does (default: none). The run then
        takes one thread.
    start, stop, step : int
        Frames of the trajectory, as a slice has them.
    radius : str, float or array
        ``auto`` (half the longest bond, the default), a number in angstrom, ``element``, ``element:fit``, or one number
        for each bead.
    units : str
        ``angstrom`` (default) or ``nm``, for arrays and iterables. LAMMPS dumps take those of the program.
    necklaces : list of int
        The number of beads of each necklace, one after the other, for positions in memory (default: one, or the chains).
    times : array
        The time of each frame in picoseconds, for arrays.
    velocities : str or array
        The velocities of Hermite motion: ``file`` (those of the frames), ``differences`` (of positions), or an array of the
        shape of the positions, in their length per picosecond (default: ``file`` if all frames have velocities and times, and
        these help).
    groups : pair of AtomGroups, of arrays of beads, or of selections
        ``contacts``: one bead of a pair must be in each group. A selection is a text of MDAnalysis, of mdtraj or, for
        paths, of ``--select``.
    only : dict
        For structures that contain only some beads: the beads, by the structure's name.
    **options
        The options of ``kds run``, dashes as underscores. They are listed below, with the help of the program.

    Returns
    -------
    Run

    Raises
    ------
    InputError
        One sentence that names the frame, bead or argument at fault and says what was expected.
    TypeError
        An argument has no such name.

    Examples
    --------
    >>> import kds
    >>> spiral = kds.generate("spiral", beads=30, frames=10)
    >>> run = kds.run(spiral, radius=1, structures=["power", "contacts"])
    >>> run.fingerprint == kds.run(spiral, radius=1, structures=["power", "contacts"]).fingerprint
    True
    >>> run.power.edges(frame=4).shape[1]
    2
    """
    check_names(run, options)
    return Run(source, verbose=verbose, view=view, **options)


def structure_names():
    """Returns the names of all structures, built-in and your own.

    >>> import kds
    >>> "contacts" in kds.structure_names()
    True
    """
    return _kds.structure_names()
