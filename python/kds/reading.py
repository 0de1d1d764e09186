"""Positions of beads in files, for your own calculations. Functions such as :func:`kds.run` read files themselves."""

import os

from . import _kds


def positions(path, topology=None):
    """Returns the backbone of the first chain of a file, an array (frames, beads, 3) in angstrom.

    ``topology`` is a file that names the atoms, if the file itself does not. Chains are made whole across a periodic cell.

    >>> import kds, kds.reading, os
    >>> data = os.environ.get("KDS_DATA") or kds._kds.data_folder()
    >>> kds.reading.positions(os.path.join(data, "proteins", "1l2y.pdb")).shape[1:]
    (60, 3)
    """
    return _kds.read_positions(os.fspath(path), None if topology is None else os.fspath(topology))
