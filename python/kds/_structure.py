"""A structure of a run, and its clock."""

from ._options import InputError, number


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

    Calls with frames in ascending order cost no more than one run in total. A call with a frame before that of the last
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

    def elements(self, frame):
        """Returns the structure's state at a frame as a set of elements, an array (elements, 6) of ids.

        ``frame`` is a whole number. Unused ids are -1. Elements are bases of nodes (``wrapped``),
        supports of nodes (``boxes``), cells (``power``), pairs (``contacts``, ``closest``), ranks (``sorted``), ends
        (``box``) or corners (``hull``); docs/python.md lists their ids.
        """
        number("frame", frame)  # None is no frame here
        time = self._run._clock.time(frame)
        if time != int(time):
            raise InputError(f"frame: {frame} is no frame of the run")
        return self._run._core.elements(self.name, int(time))[0]

    def edges(self, frame=None):
        """Returns the pairs of beads whose power cells share a facet, an array (m, 2), ascending."""
        self._only("power", "edges")
        return self._run._core.edges(self._run._clock.time(frame))

    def pairs(self, frame=None):
        """Returns the pairs of beads in contact, an array (m, 2), ascending."""
        self._only("contacts", "pairs")
        return self._run._core.contacts(self._run._clock.time(frame))

    def spheres(self, frame=None):
        """Returns the spheres of a hierarchy's nodes, an array (nodes, 4): x, y, z and radius in angstrom."""
        return self._spheres(frame)[1]

    def nodes(self, frame=None):
        """Returns the first and the last bead of each node of ``spheres``, an array (nodes, 2)."""
        return self._spheres(frame)[0]

    def lifetimes(self, by=None, **options):
        """Returns a table of how long contacts last, one row for each pair that is ever in contact.

        ``by`` is ``residue``, ``bead`` or ``chain`` (default: residue if the input names residues, otherwise bead). The
        other options are those of :func:`kds.contacts`. Lengths of time are in picoseconds if the frames have times,
        otherwise in frames. Runs the contacts again over all frames, at the cutoff of the run.
        """
        return self.analysis(by=by, **options).rows

    def analysis(self, by=None, **options):
        """Returns the result of :func:`kds.contacts` over the frames of the run, at the cutoff of the run."""
        self._only("contacts", "analysis")
        return self._run._contacts(by=by, **options)

    def _spheres(self, frame):
        nodes, spheres = self._run._core.spheres(self.name, self._run._clock.time(frame))
        if len(nodes) == 0:
            raise AttributeError(f"{self.name} has no spheres; hierarchies such as wrapped have")
        return nodes, spheres

    def _only(self, name, function):
        if self.name != name:
            raise AttributeError(f"{self.name} has no {function}; {name} has")
