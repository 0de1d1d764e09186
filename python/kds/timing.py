"""Times of static works on one or two frames of beads, and of steps from frame to frame, in seconds of processor time, with the
counts of these works.

Arrays of centres have the shape (beads, 3) or (beads, 2). Works that are compared run in turn, ``rounds`` times. Each function
returns a dictionary: for each work an array of its seconds by round, and counts. Work that takes more than a second runs once.
The scripts of experiments/paper measure with these functions.
"""

from . import _kds
from ._options import number, plain, whole
from ._static import _balls


def builds(centers, *, rounds=5):
    """Times the build of each structure of points from nothing.

    The works are ``wrapped`` and ``layered`` (the two hierarchies by kds), ``wrapped_by_cgal`` (CGAL's smallest sphere of each
    node) and ``power`` (CGAL's triangulation). ``rho_avg`` and ``rho_min`` are the mean and the least ratio of a node's wrapped
    radius to its layered radius.

    >>> import kds.timing
    >>> found = kds.timing.builds([[0, 0, 0], [2, 0, 0], [4, 0, 0], [6, 1, 0]], rounds=3)
    >>> len(found["wrapped"]), 0.5 < found["rho_min"] <= found["rho_avg"] <= 1
    (3, True)
    """
    return _kds.time_builds(plain("centers", centers), whole("rounds", rounds, 0))


def surfaces(centers, radius, *, rounds=5):
    """Times the measures of a union of balls: areas, volumes and contact areas.

    ``complex`` builds the dual complex from nothing and ``measures`` measures it. ``triangulation`` is CGAL's triangulation
    alone.

    >>> import kds.timing
    >>> found = kds.timing.surfaces([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2]], 1.5, rounds=3)
    >>> sorted(found), len(found["measures"])
    (['complex', 'measures', 'triangulation'], 3)
    """
    return _kds.time_surfaces(*_balls(centers, radius), whole("rounds", rounds, 0))


def searches(centers, radius=0, *, apart=2, rounds=5):
    """Times the detection of self-collision of one necklace.

    ``quadratic`` tests all pairs but neighbours until one collides. ``wrapped`` and ``layered`` search a hierarchy that is built
    beforehand, for all pairs that are ``apart`` or more along the necklace. ``wrapped_pairs`` and ``layered_pairs`` are the sizes
    of their separating families, and ``collisions`` is the number of colliding pairs.

    >>> import kds.timing
    >>> found = kds.timing.searches([[0, 0, 0], [2, 0, 0], [4, 0, 0], [6, 0, 0]], apart=1, rounds=1)
    >>> found["wrapped_pairs"], found["collisions"]
    (3, 0)
    """
    return _kds.time_searches(plain("centers", centers), number("radius", radius, "a length from 0"),
                              whole("apart", apart, 1), whole("rounds", rounds, 0))


def updates(before, after, *, rounds=5):
    """Times updates of the wrapped hierarchy of points from ``before`` to ``after``.

    ``lazy`` computes the spheres of the old bases. ``cascade`` and ``naive`` verify the bases of ``after`` at ``after``, by cages
    first and bead by bead. ``cascade_tests`` and ``naive_tests`` count tests of beads and cages on the way, ``bases_changed``
    nodes with another basis. ``frontier`` is the mean size of the frontiers where the cascade ends.

    >>> import kds.timing
    >>> chain = kds.generate("random-chain", beads=50, frames=2)
    >>> found = kds.timing.updates(chain[0], chain[1], rounds=1)
    >>> found["cascade_tests"] < found["naive_tests"]
    True
    """
    return _kds.time_updates(plain("before", before), plain("after", after), whole("rounds", rounds, 0))


def updates_between(before, after, first, *, rounds=5):
    """Times the update of a hierarchy and its search for collisions between two necklaces of points.

    The first necklace has the beads before ``first``. ``layered`` builds the layered hierarchy anew, ``lazy`` computes only the
    wrapped spheres that the search visits, and ``full`` verifies all bases (the mean of the step and of the step back).
    ``layered_pairs`` and ``wrapped_pairs`` are the sizes of the separating families; ``frontier`` is as in :func:`updates`.

    >>> import kds.timing
    >>> line = [[0, 0, 0], [2, 0, 0], [0, 9, 0], [2, 9, 0]]
    >>> kds.timing.updates_between(line, line, 2, rounds=1)["wrapped_pairs"]
    1
    """
    return _kds.time_updates_between(plain("before", before), plain("after", after), whole("first", first, 2),
                                     whole("rounds", rounds, 0))


def hierarchy_steps(frames, radius, *, rounds=5):
    """Times bounding hierarchies of a chain of balls that moves on straight paths from frame to frame.

    A time is that of all steps. The works ``events``, ``chords``, ``tight_chords`` (within 1%), ``layered_chords`` and
    ``box_events`` hold all beads at all times. ``updated``, ``rebuilt`` (wrapped), ``layered`` and ``boxes`` (refitted) hold
    them at each frame.

    >>> import kds.timing
    >>> found = kds.timing.hierarchy_steps(kds.generate("random-chain", beads=20, frames=3), 1, rounds=2)
    >>> len(found), len(found["boxes"])
    (9, 2)
    """
    return _kds.time_hierarchy_steps(list(plain("frames", frames)), number("radius", radius, "a length from 0"),
                                     whole("rounds", rounds, 0))


def contact_steps(frames, radius, *, apart=2, strides=(1,), rounds=5):
    """Times searches for contacts in a chain of balls that moves on straight paths from frame to frame.

    A time is that of all steps. The works ``events`` (the kinetic structure), ``paths`` (a cell list, then a quadratic for each
    near pair) and ``block_paths`` find when each contact begins and ends. ``METHOD_STRIDE``, such as ``cells_8``, finds the
    pairs at each stride-th frame: ``cells`` (cell list), ``verlet`` (Verlet list with a skin of one radius), ``blocks`` (the
    tree of the detector ``auto``, rebuilt), ``wrapped`` and ``layered`` (rebuilt), and ``boxes`` (refitted). The counts are the
    ``pairs`` of all frames, and the ``begins`` and ``ends`` of contacts after the first frame.

    >>> import kds.timing
    >>> found = kds.timing.contact_steps([[[0, 0, 0], [9, 0, 1]], [[0, 0, 0], [1, 0, 0]]], 1, apart=1, rounds=1)
    >>> found["pairs"], found["begins"], found["ends"], len(found["cells_1"])
    (1, 1, 0, 1)
    """
    return _kds.time_contact_steps(list(plain("frames", frames)), number("radius", radius, "a length from 0"),
                                   whole("apart", apart, 1), [whole("strides", stride, 1) for stride in strides],
                                   whole("rounds", rounds, 0))
