"""A run as an analysis of MDAnalysis."""

from MDAnalysis.analysis.base import AnalysisBase

from ._inputs import is_atom_group
from ._options import InputError, check_names, takes
from ._run import Run


class KineticAnalysis(AnalysisBase):
    """Runs kinetic structures over an AtomGroup, as an analysis of MDAnalysis.

    ``KineticAnalysis(group, **options)`` takes the options of :func:`kds.run`. After ``run(start, stop, step, verbose)``,
    ``results`` has ``events``, ``fingerprint``, ``frames`` and ``summary``, and ``kds`` is the :class:`kds.Run`.
    """

    @takes("run", without=("start", "stop", "step"))
    def __init__(self, atomgroup, verbose=False, *, view=None, **options):
        check_names(KineticAnalysis.__init__, options)
        for name in ("start", "stop", "step"):
            if name in options:
                raise TypeError(f"{name}: is no argument of kds.KineticAnalysis; its run takes it")
        if not is_atom_group(atomgroup):
            raise InputError(f"{type(atomgroup).__name__}: is no AtomGroup; expected one, such as u.select_atoms('name CA')")
        super().__init__(atomgroup.universe.trajectory, verbose=verbose)
        self.atomgroup = atomgroup
        self._options = {**options, "view": view}
        self.kds = None

    def run(self, start=None, stop=None, step=None, verbose=None):
        """Runs over the frames. Returns the analysis itself."""
        verbose = self._verbose if verbose is None else verbose
        self.kds = Run(self.atomgroup, verbose=verbose, start=start, stop=stop, step=step, **self._options)
        self.start, self.stop, self.step = start, stop, step
        self.results = self.kds.results
        self.frames = self.kds.frames
        self.n_frames = self.kds.frame_count
        self.times = self.kds.times
        return self
