"""Analyses of MDAnalysis: runs of structures, and contacts."""

import numpy as np
from MDAnalysis.analysis.base import AnalysisBase

from ._analyses import contacts
from ._inputs import is_atom_group
from ._options import InputError, check_names, takes
from ._run import Run

_OF_RUN = ("start", "stop", "step")


class _Analysis(AnalysisBase):
    """An analysis whose frames are given to kds at the end. kds reads them itself, because it follows images of chains through
    the frames between those chosen."""

    def __init__(self, atomgroup, verbose, options):
        for name in _OF_RUN:
            if name in options:
                raise TypeError(f"{name}: is no argument of kds.{type(self).__name__}; its run takes it")
        if not is_atom_group(atomgroup):
            raise InputError(f"{type(atomgroup).__name__}: is no AtomGroup; expected one, such as u.select_atoms('name CA')")
        super().__init__(atomgroup.universe.trajectory, verbose=verbose)
        self.atomgroup = atomgroup
        self._options = options
        self.kds = None

    def _single_frame(self):
        """Does nothing: AnalysisBase stores the number and the time of the frame."""

    def _run(self, function):
        """Returns what a function of kds finds in the frames."""
        steps = np.unique(np.diff(self.frames))
        if len(steps) != 1 or steps[0] < 1:
            raise InputError("frames: expected two or more at equal distances, as [0, 2, 4]")
        return function(self.atomgroup, verbose=self._verbose, start=self.frames[0], stop=self.frames[-1] + 1, step=steps[0],
                        **self._options)


class KineticAnalysis(_Analysis):
    """Runs kinetic structures over an AtomGroup, as an analysis of MDAnalysis.

    ``KineticAnalysis(group, **options)`` takes the options of :func:`kds.run`. After ``run(start, stop, step, frames)``,
    ``results`` has ``events``, ``fingerprint``, ``frames`` and ``summary``, and ``kds`` is the :class:`kds.Run`.
    """

    @takes("run", without=_OF_RUN)
    def __init__(self, atomgroup, verbose=False, *, view=None, **options):
        check_names(KineticAnalysis.__init__, options)
        super().__init__(atomgroup, verbose, {"view": view, **options})

    def _conclude(self):
        self.kds = self._run(Run)
        self.results.update(self.kds.results)


class ContactAnalysis(_Analysis):
    """Measures how long contacts last, as an analysis of MDAnalysis.

    ``ContactAnalysis(group, cutoff=8, **options)`` takes the options of :func:`kds.contacts`. After
    ``run(start, stop, step, frames)``, ``kds`` is the :class:`kds.Contacts`, and ``results`` has these members:

    ``times``
        the times of the frames in picoseconds, as MDAnalysis has them.
    ``timeseries``
        one row for each frame: its number, and the number of pairs in contact.
    ``contacts``
        one row for each contact, with its exact beginning and end (``intervals`` of :class:`kds.Contacts`).
    ``lifetimes``
        one row for each pair: occupancy, residence and rates (``rows`` of :class:`kds.Contacts`).
    """

    @takes("contacts", without=_OF_RUN)
    def __init__(self, atomgroup, verbose=False, *, cutoff, **options):
        check_names(ContactAnalysis.__init__, options)
        super().__init__(atomgroup, verbose, {"cutoff": cutoff, **options})

    def _conclude(self):
        self.kds = self._run(contacts)
        count = np.asarray(self.kds.at_frames()[0].sum(axis=1)).ravel()
        self.results.update(times=self.times, timeseries=np.stack([self.frames, count], axis=1), contacts=self.kds.intervals,
                            lifetimes=self.kds.rows)
