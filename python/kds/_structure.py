"""A structure of a run, and its clock."""

from ._options import OF_THE_INPUT, InputError, check_names, number, takes
from ._tables import events_table


class Clock:
    """Converts numbers of frames in the trajectory to times of the run, which count its steps."""

    def __init__(self, first, second, frames=None):
        self.first = first
        self.stride = second - first
        self.steps = None if frames is None else frames - 1  # None: frames may still come

    def time(self, frame):
        if frame is None:
            return None
        time = (number("frame", frame) - self.first) / self.stride
        if self.steps is not None and not 0 <= time <= self.steps:
            raise InputError(f"frame: {frame} is outside the run, which goes from frame {self.first} to "
                             f"{self.first + self.steps * self.stride}")
        return time

    def frame(self, time):
        return self.first + time * self.stride


class Structure:
    """A structure of a run. ``frame`` is the number of a frame in the trajectory; None means where the run stands.

    Calls with frames in ascending order cost no more than one run in total. Asking for an earlier frame than the last
    call repeats the run from its start.
    """

    def __init__(self, run, name):
        self._run = run
        self.name = name

    def __repr__(self):
        return f"<kds structure {self.name} of {self._run!r}>"

    def __str__(self):
        return self.name

    @property
    def events(self):
        """The events of this structure, a structured array as ``Run.events``."""
        events = self._run.events
        return events[events["structure"] == self.name]

    def events_frame(self):
        """Returns the events of this structure as a table, as ``Run.events_frame``."""
        return events_table(self.events)

    def elements(self, frame):
        """Returns the structure's state at a frame as a set of elements, an array (elements, 6) of ids.

        ``frame`` is a whole number. Unused ids are -1. Elements are bases of nodes (``wrapped``),
        supports of nodes (``boxes``), cells (``power``), simplices (``dual``), pairs (``contacts``,
        ``closest``), ranks (``sorted``), ends (``box``), corners (``hull``) or edges and centres (``spanner``);
        docs/python.md lists their ids.
        """
        number("frame", frame)  # None is no frame here
        time = self._run._clock.time(frame)
        if time != int(time):
            raise InputError(f"frame: {frame} is no frame of the run")
        return self._ask(self._run._core.elements, self.name, int(time))[0]

    def edges(self, frame=None):
        """Returns the edges of ``power`` (pairs of beads whose cells share a facet) or ``spanner``, an array (m, 2), ascending.

        The frame of a spanner is a whole number.
        """
        if self.name == "spanner":
            rows = self.elements(frame)
            return rows[rows[:, 1] >= 0, :2]
        self._only("power", "edges")
        return self._ask(self._run._core.edges, self._run._clock.time(frame))

    def pairs(self, frame=None):
        """Returns the pairs of beads in contact, an array (m, 2), ascending."""
        self._only("contacts", "pairs")
        return self._ask(self._run._core.contacts, self._run._clock.time(frame))

    def spheres(self, frame=None):
        """Returns the spheres of a hierarchy's nodes, an array (nodes, 4): x, y, z and radius in angstrom."""
        return self._spheres(frame)[1]

    def nodes(self, frame=None):
        """Returns the first and the last bead of each node of ``spheres``, an array (nodes, 2)."""
        return self._spheres(frame)[0]

    @takes("contacts", without=OF_THE_INPUT)
    def lifetimes(self, by=None, **options):
        """Returns a table of how long contacts last, one row for each pair that is ever in contact.

        ``by`` is ``residue``, ``bead`` or ``chain`` (default: residue if the input names residues, otherwise bead). Lengths
        of time are in picoseconds if the frames have times, otherwise in frames. Runs the contacts again over all frames.
        ``cutoff``, ``surface``, ``motion`` and ``apart`` are by default those of the run. ``apart`` counts what ``by`` says:
        by bead the pairs are those of ``pairs``, by residue the residues must be as far apart as the beads of the run.
        """
        check_names(Structure.lifetimes, options)
        return self.analysis(by=by, **options).rows

    @takes("contacts", without=OF_THE_INPUT)
    def analysis(self, by=None, **options):
        """Returns the result of :func:`kds.contacts` over the frames of the run, with the defaults of ``lifetimes``."""
        check_names(Structure.analysis, options)
        self._only("contacts", "analysis")
        return self._run._contacts(by=by, **options)

    def _ask(self, function, *given):
        """Calls a function of the run. A run whose input has changed stands at no state, so it answers no more."""
        if getattr(self._run, "_changed", None):
            raise InputError(self._run._changed)
        try:
            return function(*given)
        except InputError as error:
            if "the input has changed" in str(error):
                self._run._changed = str(error)
            raise

    def _spheres(self, frame):
        nodes, spheres = self._ask(self._run._core.spheres, self.name, self._run._clock.time(frame))
        if len(nodes) == 0:
            raise AttributeError(f"{self.name} has no spheres; hierarchies such as wrapped have")
        return nodes, spheres

    def _only(self, name, function):
        if self.name != name:
            raise AttributeError(f"{self.name} has no {function}; {name} has")
