"""The cascade verification of a wrapped hierarchy, with and without path cages (remark in section 2.3 of the paper).

The beads of a node lie in each cage on the path from the node up to the verified node. So a cage that is not inside a sphere is
settled nevertheless if its intersection with a cage above it is inside. This cascade counts tests and repairs nothing.
"""

from math import dist, hypot, sqrt

import kds

TOLERANCE = 1e-9


def farthest(cage, point):
    """Returns the greatest distance from `point` to a point of the ball."""
    return dist(cage[:3], point) + cage[3]


def holds_farthest(other, cage, point):
    """Returns whether the point of `cage` that is farthest from `point` lies in `other`."""
    distance = dist(cage[:3], point)
    if distance == 0:
        return dist(cage[:3], other[:3]) + cage[3] <= other[3]
    reach = cage[3] / distance
    return dist([c + reach * (c - p) for c, p in zip(cage[:3], point)], other[:3]) <= other[3]


def farthest_in_both(cage, other, point):
    """Returns the greatest distance from `point` to a point of two balls that meet. It is at the farthest point of one of them
    if that lies in the other, otherwise on the circle where the spheres meet."""
    if holds_farthest(other, cage, point):
        return farthest(cage, point)
    if holds_farthest(cage, other, point):
        return farthest(other, point)
    distance = dist(cage[:3], other[:3])
    if distance == 0:
        return min(farthest(cage, point), farthest(other, point))
    axis = [(o - c) / distance for c, o in zip(cage[:3], other[:3])]
    along = (distance**2 + cage[3]**2 - other[3]**2) / (2 * distance)  # the circle's plane, from the centre of `cage`
    radius = sqrt(max(0.0, cage[3]**2 - along**2))
    offset = [p - c for c, p in zip(cage[:3], point)]
    height = sum(o * a for o, a in zip(offset, axis))
    aside = hypot(*(o - height * a for o, a in zip(offset, axis)))
    return hypot(along - height, aside + radius)


def cascade(before, after, with_paths):
    """Verifies at `after` the bases of all nodes at `before`, from the bottom up. Returns the number of cages, beads and
    intersections that were compared with a sphere, and the nodes with a bead outside."""
    nodes, now = (array.tolist() for array in kds.wrapped_hierarchy(after, 1))
    bases, old, _ = (array.tolist() for array in kds.trusted_hierarchy(before, after, 1))
    beads = [[*point, 0.0][:3] + [1.0] for point in after.tolist()]
    tests, escaped = 0, []

    def is_inside(node, first, last, path):
        nonlocal tests
        if first == last and first in basis:
            return True
        tests += 1
        cage = beads[first] if first == last else now[node]
        if farthest(cage, center) <= within:
            return True
        if first == last:
            return False
        if with_paths:
            for above in reversed(path):
                tests += 1
                if farthest_in_both(cage, above, center) <= within:
                    return True
        return children_are_inside(node, [*path, cage])

    def children_are_inside(node, path):
        first, last = nodes[node]
        middle = (first + last) // 2  # nodes are in preorder
        return (is_inside(node + 1, first, middle, path)
                and is_inside(node + 1 + middle - first, middle + 1, last, path))

    for node in reversed(range(len(nodes))):
        basis, center, within = bases[node], old[node][:3], old[node][3] * (1 + TOLERANCE)
        if not children_are_inside(node, []):
            escaped.append(node)
    return tests, escaped
