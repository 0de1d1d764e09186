"""Inputs that are named once and used by several functions."""

from . import _analyses, _stepping
from ._options import OF_THE_INPUT, check_names, takes
from ._run import Run


class Opened:
    """An input with its options. Made by :func:`kds.open`. Options of a method override those of the input."""

    def __init__(self, source, options):
        self.source = source
        self.options = options

    def run(self, **options):
        """Returns what :func:`kds.run` finds."""
        return Run(self.source, **{**self.options, **options})

    def contacts(self, **options):
        """Returns what :func:`kds.contacts` finds."""
        return _analyses.contacts(self.source, **{**self.options, **options})

    def compare(self, **options):
        """Returns what :func:`kds.compare` finds."""
        return _analyses.compare(self.source, **{**self.options, **options})

    def stream(self, **options):
        """Yields the frames of :func:`kds.stream`."""
        return _stepping.stream(self.source, **{**self.options, **options})

    def __repr__(self):
        return f"<kds input {self.source}>"


@takes("run", only=OF_THE_INPUT)
def open(source, **options):
    """Names an input and its options, such as ``topology``, ``select``, ``dt`` and ``radius``, for several functions.

    The input is any that :func:`kds.run` takes, or the address of a running simulation (``docs/live.md``):

    >>> import kds
    >>> simulation = kds.open("imd://localhost:8888", topology="imdgroup.gro", select="ca", radius=1.9)
    >>> contacts = simulation.contacts(cutoff=8, until=20)  # doctest: +SKIP

    Nothing is read before a method is called. Each method opens a running simulation anew.
    """
    check_names(open, options)
    return Opened(source, options)
