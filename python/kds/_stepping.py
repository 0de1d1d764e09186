"""Runs that the user drives: step by step, event by event, frame by frame."""

import os

import numpy as np

from . import _kds
from ._inputs import check_unit_name, frame_of, is_frames, refuse_others
from ._options import OF_THE_INPUT, InputError, check_names, number, numbers, plain, takes, warn, whole, wholes
from ._run import more_options, open_run, run_arguments
from ._structure import Clock, Structure


def _warn_of_threads(options):
    if (options.get("threads") or 1) != 1:
        warn([f"threads {options['threads']}: the run takes one thread, because it is driven from outside"])


def _cell(name, cell):
    """Returns the six numbers of a cell, or none."""
    if cell is None:
        return []
    found = np.ravel(numbers(name, cell)).astype(float)
    if found.shape != (6,) or not np.all(np.isfinite(found)):
        raise InputError(f"{name}: expected three lengths in angstrom and three angles in degrees, found shape "
                         f"{np.shape(cell)}")
    return found.tolist()


_NOT_PUSHED = [name for name in OF_THE_INPUT if name not in ("radius", "necklaces")]


class KineticRun:
    """A run that you drive through time.

    ``KineticRun(source, **options)`` takes everything that :func:`kds.run` takes. The run stands at its first frame.
    Frames are numbers of frames in the trajectory; 2.25 lies a quarter of the way from frame 2 to the next frame.
    Functions that let time pass return the events of that time, a structured array as ``Run.events``.

    >>> import kds
    >>> run = kds.KineticRun(kds.generate("spiral", beads=30, frames=5), radius=1, structures=["contacts"])
    >>> first = run.next_event()
    >>> bool(run.frame <= first["frame"][0] + 1e-9)
    True
    >>> later = run.go_to(4)
    >>> run.frame
    4.0
    """

    @takes("run")
    def __init__(self, source, *, log=None, **options):
        """``log`` is the path of an event log with the edits, which :meth:`finish` writes (default: none). The source must
        then be a path. Such a run cannot go back."""
        check_names(KineticRun.__init__, options)
        self._open(source, options)
        if log is not None:
            self._core.write_log(os.fspath(log))

    def _open(self, source, options):
        _warn_of_threads(options)
        self._core, self._source, _, _ = open_run(source, **options)
        frames = None if self._core.is_live else self._core.frame_count
        self._clock = Clock(self._core.stamp(0)[0], self._core.stamp(1)[0], frames)

    @classmethod
    @takes("run", without=_NOT_PUSHED)
    def pushed(cls, beads, radius=None, *, dimension=3, necklaces=None, cell=None, cutoff=None, surface=False, only=None,
               **options):
        """Returns a run over frames that are pushed one by one. Only the frames of one step are kept.

        ``beads`` is their number, ``radius`` a number in angstrom or one for each bead (default: points without radii),
        ``dimension`` 1 to 3, ``necklaces`` the number of beads of each necklace. Name the ``structures``.

        ``cell`` is the periodic cell, three lengths and three angles as ``dimensions`` of MDAnalysis. Contacts and the
        closest pair are then those of nearest images, and each bead moves to the image nearest to its place in the
        frame before.
        """
        self = cls.__new__(cls)
        check_names(KineticRun.pushed, options)
        for name in _NOT_PUSHED:
            given = options.pop(name, None)
            if given is not None and given is not False:
                raise InputError(f"{name}: is for inputs that have their frames; frames are pushed as they are")
        beads = whole("beads", beads, 1)
        radii = [] if radius is None else np.ravel(numbers("radius", radius)).tolist()
        counts = [beads] if necklaces is None else wholes("necklaces", necklaces, 1)
        if sum(counts) != beads:
            raise InputError(f"necklaces: have {sum(counts)} beads; expected {beads}")
        _warn_of_threads(options)
        self._core = _kds.Run(run_arguments(cutoff, surface, options), more_options(only),
                              whole("dimension", dimension, 1), counts, radii, _cell("cell", cell))
        warn(self._core.warnings())
        self._source = None
        self._clock = Clock(0, 1)
        self._pushed = 0
        self._time = None
        return self

    def push(self, positions, time=None, cell=None):
        """Adds the next frame, an array (beads, dimension) in angstrom, and runs all steps that are then known.

        ``time`` is in picoseconds. ``cell`` is the new cell, if it changes; the run must have one. Returns the events of these steps. A wrong frame raises InputError and changes
        nothing.
        """
        if self._source is not None:
            raise InputError("push: the run has frames of its own; expected KineticRun.pushed(beads)")
        positions = plain(f"frame {self._pushed}", positions)
        if time is not None:
            time = number(f"frame {self._pushed}: time", time, "picoseconds")
        shape = (self._core.bead_count, self._core.dimension)
        if positions.shape != shape:
            raise InputError(f"frame {self._pushed}: has the shape {positions.shape}; expected {shape}")
        self._core.push(positions, time, _cell(f"frame {self._pushed}: cell", cell))
        if self._pushed == 0 and shape[1] == 3 and (doubt := _kds.nanometres_doubt(positions)):
            warn([f"frame 0: {doubt}"])
        if None not in (time, self._time) and time <= self._time:
            warn([f"frame {self._pushed}: has the time {time:g} ps, which is not later than the {self._time:g} ps of the "
                  "frame before"])
        self._time = time
        self._pushed += 1
        return self._core.take_events()

    @property
    def frame(self):
        """The frame at which the run stands, with a fraction within a step. Rounded at the time of an event."""
        return float(self._clock.frame(self._core.time()))

    @property
    def fingerprint(self):
        """16 hex digits, the hash of all events so far in their order."""
        return f"{self._core.fingerprint():016x}"

    @property
    def structures(self):
        """The names of the structures."""
        return [name for name, _ in self._core.structures()]

    @property
    def bead_count(self):
        """The number of beads."""
        return self._core.bead_count

    def step(self):
        """Runs to the next frame. Returns the events on the way, or None after the last frame."""
        return self._core.take_events() if self._core.step() else None

    def next_event(self):
        """Runs to the next time of events. Returns the events of that time, or None if no event follows."""
        return self._core.take_events() if self._core.next_event() else None

    def go_to(self, frame):
        """Runs to a frame, which may lie within a step: forward, or back by repeating the run from its start.

        Edits up to that frame are repeated, later ones are forgotten. Returns the events on the way forward.
        """
        number("frame", frame)  # None is no frame here
        self._core.go_to(self._clock.time(frame))
        return self._core.take_events()

    def finish(self):
        """Runs all steps that are left, ends the run and writes its ``log``. Returns the events."""
        self._core.finish()
        return self._core.take_events()

    def audit(self):
        """Compares all structures with static ones where the run stands. Raises kds.AuditError if one is wrong."""
        self._core.audit()

    def insert(self, structure, bead):
        """Adds a bead to a structure from the present time on, within a step. Returns the events that the edit causes."""
        return self._edit(self._core.insert, self._place(structure), whole("bead", bead, 0))

    def erase(self, structure, bead):
        """Removes a bead from a structure from the present time on, within a step. Returns the events that the edit causes."""
        return self._edit(self._core.erase, self._place(structure), whole("bead", bead, 0))

    def control_points(self):
        """Returns the Bezier control points of the present step, an array (beads, degree + 1, dimension)."""
        return self._core.control_points()

    def bend(self, beads, points):
        """Gives beads other curves from the present time on, within a step. Returns the events that the edit causes.

        ``points`` has the shape (beads, degree + 1, dimension): control points for the whole step, including the part
        before the present time. At the end of the step each bead must be where the next frame has it.
        """
        return self._edit(self._core.bend, wholes("beads", beads), numbers("points", points))

    def _edit(self, function, *given):
        function(*given)
        return self._core.take_events()

    def _place(self, structure):
        names = self.structures
        if str(structure) not in names:
            raise InputError(f"structure: the run has no {structure}; it has {', '.join(names)}")
        return names.index(str(structure))

    def __getattr__(self, name):
        if name.startswith("_") or name not in self.structures:
            raise AttributeError(name)
        return _Standing(self, name)

    def __dir__(self):
        return [*super().__dir__(), *self.structures]

    def __repr__(self):
        return f"<kds.KineticRun of {', '.join(self.structures)}, {self.bead_count} beads, at frame {self.frame:g}>"


class _Standing(Structure):
    """A structure of a run that the user drives, where the run stands."""

    @property
    def events(self):
        raise AttributeError("events: are returned by the functions that let time pass")

    def analysis(self, by=None, **options):
        raise AttributeError("analysis: is of kds.run and kds.contacts")


class StreamFrame:
    """A frame of :func:`kds.stream`: ``frame`` (its number), ``time`` (picoseconds or None) and ``events``, those since the
    frame before. Its structures can be read until the stream goes on to the next frame."""

    def __init__(self, frame, time, events, run, place):
        self.frame = frame
        self.time = time
        self.events = events
        self._run = run
        self._place = place

    def __getattr__(self, name):
        if name.startswith("_") or name not in self._run.structures:
            raise AttributeError(name)
        if self._run._core.time() != self._place:
            raise InputError(f"frame {self.frame}: the stream has gone on, and {name} is no longer at this frame; expected "
                             "its use before the next frame")
        return _Standing(self._run, name)

    def __repr__(self):
        return f"<kds frame {self.frame}: {len(self.events)} events>"


@takes("run")
def stream(source, **options):
    """Runs structures over frames that are read one at a time. Stores no frames and no events.

    Takes what :func:`kds.run` takes and yields a :class:`kds.StreamFrame` for each frame: ``frame.frame``, ``frame.time``,
    ``frame.events`` (those since the frame before) and the structures, as in ``frame.power.edges()``. Frames of an
    AtomGroup or of files are read twice if ``radius`` is ``auto``.

    An iterable gives its frames only once. ``radius`` must then be a number or one for each bead, unless ``cutoff`` is
    given. In Hermite motion a frame of an iterable is yielded when the frame after it is known. Structures at its first
    frame are not known.

    >>> import kds
    >>> spiral = kds.generate("spiral", beads=30, frames=5)
    >>> [frame.frame for frame in kds.stream(spiral, radius=1)]
    [0, 1, 2, 3, 4]
    """
    check_names(stream, options)
    return _stream_frames(source, options) if is_frames(source) else _stream_pushed(source, **options)


def _stream_frames(source, options):
    run = KineticRun.__new__(KineticRun)
    run._open(source, {**options, "pull": True})
    try:
        run._core.build()
        yield StreamFrame(*run._core.stamp(0), run._core.take_events(), run, 0)
        k = 0
        while (events := run.step()) is not None:
            k += 1
            yield StreamFrame(*run._core.stamp(k), events, run, k)
        run.finish()
        warn(run._core.live_warnings())
    finally:
        run._core.leave()


def _stream_pushed(source, start=None, stop=None, step=None, radius=None, necklaces=None, units=None, **options):
    import itertools

    check_unit_name(units)
    if isinstance(radius, str) or (radius is None and options.get("cutoff") is None):
        raise InputError("radius: frames that come one by one have no longest bond; expected a number, one for each bead, "
                         "or a cutoff")
    refuse_others(source)
    for name, value in (("start", start), ("stop", stop), ("step", step)):
        if value is not None:
            whole(name, value, 1 if name == "step" else 0)
    places = itertools.count(start or 0, step or 1)
    run = None
    waiting = []  # frames that are pushed and not yet reached: Hermite motion needs the frame after a step
    reached = 0
    for item in itertools.islice(source, start, stop, step):
        label = f"frame {0 if run is None else run._pushed}"
        positions, time = frame_of(item, label)
        positions = plain(label, positions)
        if units == "nm":
            positions = 10 * positions if positions.dtype == float else np.float32(10) * positions.astype(np.float32)
        if run is None:
            if positions.ndim != 2 or positions.shape[1] not in (1, 2, 3) or len(positions) == 0:
                raise InputError(f"frame 0: has the shape {positions.shape}; expected (beads, 3)")
            radius = 1.0 if radius is None else radius
            run = KineticRun.pushed(len(positions), radius, dimension=positions.shape[1], necklaces=necklaces, **options)
        events = run.push(positions, time)
        waiting.append((next(places), time))
        if run._core.time() >= reached:
            yield StreamFrame(*waiting.pop(0), events, run, reached)
            reached += 1
    if run is None:
        raise InputError("frames: there are none; expected two or more")
    if run._pushed < 2:
        raise InputError("frames: there is one; expected two or more")
    events = run.finish()
    for frame in waiting:
        yield StreamFrame(*frame, events, run, reached)
