"""Bounding volumes of one necklace over the balanced tree that all hierarchies of kds share, and one search for all of them.

Beads have the numbers 0 to n - 1, and nodes come after them in preorder, as kds returns them. All balls have one radius. All
volumes of a kind are arrays over beads, then nodes. Each kind has `size`, by which the search decides what to split, and
`apart(u, v)`, which returns for arrays of numbers whether volumes u and v are surely disjoint.
"""

import kds
import numpy as np
from oriented_boxes import oriented_boxes, separated

# The slabs of boxes and k-DOPs: the axes, then the diagonals through corners of a cube, then those through its edges.
DIRECTIONS = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1], [1, 1, -1], [1, -1, 1], [-1, 1, 1], [1, 1, 0], [1, 0, 1],
                       [0, 1, 1], [1, -1, 0], [1, 0, -1], [0, 1, -1]], float)
SPANNER_REACH = 12  # of the spanner's default stretch: centres of a level are joined up to 12 times its scale


class Tree:
    """The balanced tree over the beads of a necklace. `levels` has the nodes of each depth, the deepest first."""

    def __init__(self, beads):
        first, last, children, depths = list(range(beads)), list(range(beads)), [], []

        def add(one, end, depth):
            if one == end:
                return one
            node, middle = len(first), one + (end - one) // 2
            first.append(one), last.append(end), children.append(None), depths.append(depth)
            children[node - beads] = add(one, middle, depth + 1), add(middle + 1, end, depth + 1)
            return node

        self.beads = beads
        add(0, beads - 1, 0)
        self.first, self.last, self.children = np.array(first), np.array(last), np.array(children)
        self.levels = [beads + np.flatnonzero(np.array(depths) == depth) for depth in range(max(depths), -1, -1)]

    def halves(self, nodes):
        """Returns the children of nodes, (2, nodes)."""
        return self.children[nodes - self.beads].T


class Spheres:
    """The wrapped or the layered hierarchy of kds."""

    def __init__(self, build, positions, radius):
        balls = np.column_stack([positions, np.full(len(positions), radius)])
        self.spheres = np.concatenate([balls, build(positions, radius)[1]])
        self.size = self.spheres[:, 3]

    def apart(self, u, v):
        one, other = self.spheres[u], self.spheres[v]
        return np.linalg.norm(one[:, :3] - other[:, :3], axis=1) > one[:, 3] + other[:, 3]


class Slabs:
    """Axis-aligned boxes (3 directions), 14-DOPs (7) or 26-DOPs (13). Their sizes are the volumes of their boxes."""

    def __init__(self, tree, positions, radius, directions):
        normals = DIRECTIONS[:directions]
        ends = np.empty((2, len(tree.first), directions))
        reach = radius * np.linalg.norm(normals, axis=1)
        ends[:, : tree.beads] = positions @ normals.T + np.stack([-reach, reach])[:, None]
        for nodes in tree.levels:
            left, right = tree.halves(nodes)
            ends[0, nodes] = np.minimum(ends[0, left], ends[0, right])
            ends[1, nodes] = np.maximum(ends[1, left], ends[1, right])
        self.low, self.high = ends
        self.size = (self.high - self.low)[:, :3].prod(axis=1)

    def apart(self, u, v):
        return ((self.low[u] > self.high[v]) | (self.low[v] > self.high[u])).any(axis=1)


class OrientedBoxes:
    """The chain tree of oriented_boxes.py."""

    def __init__(self, tree, positions, radius, tight=False):
        self.boxes = [part[0] for part in oriented_boxes(tree, positions[None], radius, tight)]
        self.size = self.boxes[2].prod(axis=1)

    def apart(self, u, v):
        return separated(*(part[u] for part in self.boxes), *(part[v] for part in self.boxes))


def search(tree, volumes, positions, radius):
    """Finds the pairs of beads that meet and are at least 2 apart along the chain.

    Begins with the two halves of each node. If the volumes of a pair are not apart, the larger one is split, the first one of
    equal ones. Two beads are compared by their balls. Returns the number of disjoint pairs, which is the size of the separating
    family, the number of pairs that were compared, and the pairs that meet.
    """
    u, v = tree.children.T
    family = compared = 0
    meeting = []
    while len(u):
        asked = tree.last[v] - tree.first[u] >= 2
        u, v = u[asked], v[asked]
        compared += len(u)
        beads = (u < tree.beads) & (v < tree.beads)
        apart = np.empty(len(u), bool)
        apart[~beads] = volumes.apart(u[~beads], v[~beads])
        distance = np.linalg.norm(positions[u[beads]] - positions[v[beads]], axis=1)
        apart[beads] = distance > 2 * radius
        family += int(apart.sum())
        meeting.append(np.stack([u, v], axis=1)[beads & ~apart])
        u, v = u[~beads & ~apart], v[~beads & ~apart]
        first = (v < tree.beads) | ((u >= tree.beads) & (volumes.size[u] >= volumes.size[v]))
        (left, right), (low, high) = tree.halves(u[first]), tree.halves(v[~first])
        u, v = np.concatenate([left, right, u[~first], u[~first]]), np.concatenate([v[first], v[first], low, high])
    pairs = np.concatenate(meeting)
    return family, compared, pairs[np.lexsort(pairs.T[::-1])]


def search_along(edges, positions, radius):
    """Finds the same pairs along edges of the power diagram, or of the dual complex, of equal balls.

    The segment between the centres of two balls that meet crosses the cells of beads that meet both balls. Two cells that it
    crosses one after the other have a common point within both balls, so an edge of both structures joins them. A search from
    each bead, which goes on from beads that meet it, thus finds all. Returns the number of compared pairs, and those that meet.
    """
    beads = len(positions)
    neighbours = [[] for _ in range(beads)]
    for one, other in edges.tolist():
        neighbours[one].append(other)
        neighbours[other].append(one)
    compared, meeting = set(), []
    for bead in range(beads):
        near = np.linalg.norm(positions - positions[bead], axis=1) <= 2 * radius
        known, waiting = {bead}, [bead]
        while waiting:
            for other in neighbours[waiting.pop()]:
                if other not in known:
                    known.add(other)
                    if near[other]:
                        waiting.append(other)
        compared.update((min(bead, other), max(bead, other)) for other in known if abs(bead - other) >= 2)
        meeting += sorted((bead, other) for other in known if other >= bead + 2 and near[other])
    return len(compared), np.array(meeting, int).reshape(-1, 2)


def spanner_unit(positions):
    """Returns the scale of level 0 of the spanner that kds builds at these positions (spanner.h)."""
    return 2.0**(np.floor(np.log2(np.ptp(positions, axis=0).max())) - 30)


def search_spanner(elements, positions, radius):
    """Finds the same pairs in the spanner that kds has built at these positions. `elements` are its edges and centres.

    All beads below a centre of a level are within twice the scale of the level. So the centres above two beads that meet are
    joined, or equal, at the first level where 2 radii and 4 scales are at most SPANNER_REACH scales. The search begins with all
    pairs there, goes down to their children, and leaves out pairs that are too far apart. Returns as search_along does.
    """
    unit = spanner_unit(positions)
    is_edge = elements[:, 1] >= 0
    beads, _, parents, tops = elements[~is_edge, :4][np.argsort(elements[~is_edge, 0])].T
    level = max(0, int(np.ceil(np.log2(2 * radius / ((SPANNER_REACH - 4) * unit)))))

    def near(u, v, distance):
        kept = np.linalg.norm(positions[u] - positions[v], axis=1) <= distance
        return u[kept], v[kept]

    u, v = elements[is_edge, :2].T
    at_level = (tops[u] >= level) & (tops[v] >= level)
    u, v = near(u[at_level], v[at_level], SPANNER_REACH * unit * 2.0**level)
    compared = [u * len(positions) + v]
    u, v = np.concatenate([u, beads[tops >= level]]), np.concatenate([v, beads[tops >= level]])
    while tops.min() < level:
        u, v = near(u, v, 2 * radius + 4 * unit * 2.0**level)
        level -= 1
        children = beads[tops == level]
        for _ in range(2):  # replaces the first centre by itself and its children, then the second
            below = children[np.argsort(parents[children], kind="stable")]
            starts, ends = (np.searchsorted(parents[below], u, side) for side in ("left", "right"))
            rows = np.repeat(np.arange(len(u)), ends - starts)
            offsets = np.arange(len(rows)) - np.repeat(np.cumsum(ends - starts) - (ends - starts), ends - starts)
            u, v = np.concatenate([v, v[rows]]), np.concatenate([u, below[starts[rows] + offsets]])
        u, v = np.divmod(np.unique(np.minimum(u, v) * len(positions) + np.maximum(u, v)), len(positions))
        compared.append((u * len(positions) + v)[u < v])
    u, v = near(u, v, 2 * radius)
    ones, others = np.divmod(np.unique(np.concatenate(compared)), len(positions))
    pairs = np.stack([u, v], axis=1)[v - u >= 2]
    return int((others - ones >= 2).sum()), pairs[np.lexsort(pairs.T[::-1])]


def layered_states(tree, positions):
    """Returns for each node of the layered hierarchy which child holds the other: 0 neither, 1 the first, 2 the second."""
    spheres = Spheres(kds.layered_hierarchy, positions, 0).spheres
    left, right = (spheres[half] for half in tree.children.T)
    apart = np.linalg.norm(left[:, :3] - right[:, :3], axis=1)
    return np.where(apart + right[:, 3] <= left[:, 3], 1, np.where(apart + left[:, 3] <= right[:, 3], 2, 0))
