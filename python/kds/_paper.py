"""Quantities of balls at rest that experiments/paper counts and times. Times are processor times in seconds."""

from . import _kds
from ._options import flag, plain, whole, wholes
from ._static import _balls


def separating_family(centers, radius, *, hierarchy="wrapped", rule="more beads", leaf=1, apart=2, necklaces=(), between=False,
                      rounds=0):
    """Counts the pairs of disjoint spheres of a hierarchy that together prove which beads are disjoint.

    ``hierarchy`` is ``wrapped`` or ``layered``. A search that splits the node with ``more beads``, the one with the ``larger
    sphere`` or the ``first node`` finds a family; it does not split nodes of at most ``leaf`` beads. The ``explicit`` family is
    that of the proof of Theorem 3.1, and the ``smallest`` one covers each pair of beads once with fewest pairs. Beads of one
    necklace are asked about if they are ``apart`` or more along it, with ``between`` only beads of different necklaces.

    Returns the number of pairs, the number of pairs of nodes that were compared (None for ``explicit``), and the time of the
    search in each of ``rounds`` repetitions (in one if it takes more than a second).

    >>> import kds
    >>> chain = kds.generate("random-chain", beads=100, frames=1)[0]
    >>> found, smallest = (kds.separating_family(chain, 1, rule=rule)[0] for rule in ("more beads", "smallest"))
    >>> found > smallest > 100
    True
    """
    return _kds.separating_family(*_balls(centers, radius), wholes("necklaces", necklaces, 1), str(hierarchy), str(rule),
                                  whole("leaf", leaf, 1), whole("apart", apart, 1), flag("between", between),
                                  whole("rounds", rounds, 0))


def closest_by_diagram(centers, radius, *, necklaces=(), rounds=0):
    """Finds the closest pair of beads that are no neighbours, by the power diagram (Theorem 3.5).

    Returns the pair as :func:`kds.closest_pair` does, the numbers of pairs that were examined by the rule that names them, a
    dictionary, and the time in each of ``rounds`` repetitions (in one if it takes more than a second).

    >>> import kds
    >>> pair, examined, times = kds.closest_by_diagram([[0, 0, 0], [2, 0, 0], [3, 2, 0], [1.5, 3.5, 0]], 1)
    >>> pair[:2], sum(examined.values()) > 2
    ((1, 3), True)
    """
    return _kds.closest_by_diagram(*_balls(centers, radius), wholes("necklaces", necklaces, 1), whole("rounds", rounds, 0))


def trusted_hierarchy(before, after, radius, *, rounds=0):
    """Computes the spheres of one necklace at ``after`` from the bases of ``before``, without checking that beads are inside.

    Returns the bases of the nodes of :func:`kds.wrapped_hierarchy`, an array (nodes, 4) in which -1 is no bead; their spheres at
    ``after``, an array (nodes, 4); and the times of ``rounds`` repetitions, an array (rounds, 2): of computing these spheres,
    and of an update that verifies all bases.

    >>> import kds
    >>> bases, spheres, times = kds.trusted_hierarchy([[0, 0, 0], [4, 0, 0], [2, 1, 0]], [[0, 0, 0], [4, 0, 0], [2, 9, 0]], 1)
    >>> bases[0].tolist(), spheres[0].tolist()
    ([0, 1, -1, -1], [2.0, 0.0, 0.0, 3.0])
    """
    return _kds.trusted_hierarchy(plain("before", before), plain("after", after), _balls(before, radius)[1],
                                  whole("rounds", rounds, 0))
