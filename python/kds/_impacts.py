"""Continuous collision of points with triangles and of edges, exact."""

import numpy as np

from . import _kds
from ._options import InputError, flag, plain

KINDS = ("vertex-face", "edge-edge")
MOST_CONTROLS = _kds.highest_degree_of_impacts + 1


def impacts(kind, *points, all=False):
    """Returns the times at which points begin to meet triangles, or edges each other.

    ``kind`` is ``"vertex-face"`` (a point, then the corners of a triangle) or ``"edge-edge"`` (the ends of one edge, then
    those of the other). Each of ``points`` is an array (queries, 4, 3): the positions at time 0 and at time 1 for straight
    paths, or the control points of Bezier curves in their order. With ``all``, all times are returned, otherwise the first
    of each query.

    Returns a structured array, one row for each time: ``query``, ``lower`` and ``upper`` (a bracket of the time; equal if
    it is a double), and ``passes``: whether the features pass through each other. It is False if they only touch, or if
    their points stay coplanar. A query without a row has no impact. Everything is closed and exact: ends of edges,
    corners, and the times 0 and 1 count. Raises InputError if the arrays differ in shape or hold a number that is not finite.

    >>> import kds
    >>> triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    >>> hits = kds.impacts("vertex-face", [[[0.25, 0.25, 1], *triangle]], [[[0.25, 0.25, -1], *triangle]])
    >>> hits["query"].tolist(), hits["upper"].round(12).tolist(), hits["passes"].tolist()
    ([0], [0.5], [True])
    """
    if not isinstance(kind, str) or kind not in KINDS:
        raise InputError(f"kind: is {kind!r}; expected {' or '.join(map(repr, KINDS))}")
    if not 2 <= len(points) <= MOST_CONTROLS:
        raise InputError(f"points: found {len(points)}; expected the positions at time 0 and at time 1, or the control "
                         f"points of curves, at most {MOST_CONTROLS}")
    arrays = [plain(f"points {k}", array) for k, array in enumerate(points)]
    for k, array in enumerate(arrays):
        if array.ndim != 3 or array.shape[1:] != (4, 3) or array.shape != arrays[0].shape:
            raise InputError(f"points {k}: has the shape {array.shape}; expected (queries, 4, 3), the same for all arrays")
        if not np.isfinite(array).all():
            raise InputError(f"points {k}: has a number that is not finite in query {np.argwhere(~np.isfinite(array))[0][0]}")
    query, lower, upper, passes = _kds.impacts(kind, np.stack(arrays, axis=2), flag("all", all))
    rows = np.empty(len(query), dtype=[("query", np.int64), ("lower", float), ("upper", float), ("passes", bool)])
    rows["query"], rows["lower"], rows["upper"], rows["passes"] = query, lower, upper, passes
    return rows
