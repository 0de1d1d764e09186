"""Structures of balls at rest, exact."""

import numpy as np

from . import _kds
from ._options import number, plain, whole, wholes


def _balls(centers, radius):
    """Returns both as arrays of numbers."""
    return plain("centers", centers), np.ravel(plain("radius", radius))


def power_diagram(centers, radius):
    """Returns the edges of the power diagram, an array (m, 2), and the hidden beads.

    ``centers`` is an array (beads, 3) or (beads, 2), ``radius`` a number or one for each bead. An edge joins two beads
    whose power cells share a facet.

    >>> import kds
    >>> edges, hidden = kds.power_diagram([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2]], 1)
    >>> len(edges), len(hidden)
    (6, 0)
    """
    return _kds.power_diagram(*_balls(centers, radius))


def enclosing_sphere(centers, radius):
    """Returns the smallest sphere around all balls: its centre, its radius, and the beads of its basis.

    >>> import kds
    >>> center, radius, basis = kds.enclosing_sphere([[0, 0, 0], [4, 0, 0], [2, 1, 0]], 1)
    >>> float(radius), basis.tolist()
    (3.0, [0, 1])
    """
    return _kds.enclosing_sphere(*_balls(centers, radius))


def wrapped_hierarchy(centers, radius, necklaces=()):
    """Returns the nodes of the wrapped hierarchy: first and last bead (nodes, 2), and spheres (nodes, 4).

    >>> import kds
    >>> nodes, spheres = kds.wrapped_hierarchy([[0, 0, 0], [2, 0, 0], [4, 0, 0]], 1)
    >>> nodes[0].tolist(), spheres[0].tolist()
    ([0, 2], [2.0, 0.0, 0.0, 3.0])
    """
    return _kds.wrapped_hierarchy(*_balls(centers, radius), wholes("necklaces", necklaces, 1))


def layered_hierarchy(centers, radius, necklaces=()):
    """Returns the nodes of the layered hierarchy in the form of :func:`kds.wrapped_hierarchy`.

    The sphere of a node is the smallest one around the spheres of its two children.

    >>> import kds
    >>> nodes, spheres = kds.layered_hierarchy([[0, 0, 0], [2, 0, 0], [4, 0, 0]], 1)
    >>> spheres[0].round(9).tolist()
    [2.0, 0.0, 0.0, 3.0]
    """
    return _kds.layered_hierarchy(*_balls(centers, radius), wholes("necklaces", necklaces, 1))


def colliding_pairs(centers, radius, *, within=0, apart=2, necklaces=()):
    """Returns the pairs of balls whose surfaces are at most ``within`` apart, an array (m, 2), ascending.

    Beads of one necklace must be at least ``apart`` apart along it.

    >>> import kds
    >>> kds.colliding_pairs([[0, 0, 0], [2, 0, 0], [1, 1, 0]], 1).tolist()
    [[0, 2]]
    """
    return _kds.colliding_pairs(*_balls(centers, radius), wholes("necklaces", necklaces, 1), whole("apart", apart, 1),
                                number("within", within, "a length from 0"))


def closest_pair(centers, radius, *, apart=2, necklaces=()):
    """Returns the closest pair of balls and the distance of their surfaces, or None if no pair is at least ``apart`` apart.

    >>> import kds
    >>> kds.closest_pair([[0, 0, 0], [2, 0, 0], [9, 0, 0]], 1)
    (0, 2, 7.0)
    """
    return _kds.closest_pair(*_balls(centers, radius), wholes("necklaces", necklaces, 1), whole("apart", apart, 1))
