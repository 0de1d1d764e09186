"""Oriented boxes over a chain, refitted at frames.

Chain trees are by Lotan, Schwarzer, Halperin and Latombe, Algorithm and data structures for efficient energy maintenance
during Monte Carlo simulation of proteins (2004). In their simulations few torsions change per step. Here all beads move,
so each frame refits all nodes: a node's box holds the boxes of its two children, or with `tight` the balls of its beads. Three
sets of axes are tried: those of each child, and the principal axes of its beads and of one more bead at each end. The axes with
the smallest box that holds the children's boxes are taken. So boxes turn with the molecule.

Boxes are centres (..., 3), axes (..., 3, 3) as columns, and halves of the sides (..., 3).
"""

import numpy as np


def principal_axes(tree, frames):
    """Returns the principal axes of all nodes for frames (frames, beads, 3), from sums along the chain."""
    beads = tree.beads
    low, high = np.clip(tree.first - 1, 0, beads - 3), np.clip(tree.last + 1, 2, beads - 1) + 1
    at = frames - frames.mean(axis=1, keepdims=True)
    sums = [np.pad(np.cumsum(one, axis=1), ((0, 0), (1, 0)) + ((0, 0),) * (one.ndim - 2)) for one in
            (at, at[..., None] * at[..., None, :])]
    first, second = (one[:, high] - one[:, low] for one in sums)
    return np.linalg.eigh(second - first[..., None] * first[..., None, :] / (high - low)[:, None, None])[1]


def oriented_boxes(tree, frames, radius, tight=False):
    """Returns the boxes of all beads, then of all nodes, for frames (frames, beads, 3) of at least 3 equal balls."""
    axes = principal_axes(tree, frames)
    centers, halves = np.empty(axes.shape[:-1]), np.empty(axes.shape[:-1])
    centers[:, : tree.beads], halves[:, : tree.beads] = frames, radius
    for nodes in tree.levels:
        below = tree.halves(nodes)
        tried = np.stack([axes[:, nodes], *(axes[:, half] for half in below)])  # (3, frames, nodes, 3, 3)
        turned, ends = np.swapaxes(tried, -1, -2), []
        for half in below:
            middle = np.einsum("tfnij,fnj->tfni", turned, centers[:, half])
            reach = np.einsum("tfnij,fnj->tfni", np.abs(turned @ axes[:, half]), halves[:, half])
            reach[:, :, half < tree.beads] = radius  # a bead is a ball
            ends.append((middle - reach, middle + reach))
        low, high = np.minimum(ends[0][0], ends[1][0]), np.maximum(ends[0][1], ends[1][1])
        best = (high - low).prod(axis=-1).argmin(axis=0)[None, ..., None]
        low, high = (np.take_along_axis(one, best, axis=0)[0] for one in (low, high))
        axes[:, nodes] = np.take_along_axis(tried, best[..., None], axis=0)[0]
        if tight:
            count = tree.last[nodes] - tree.first[nodes] + 1
            starts = np.concatenate([[0], np.cumsum(count)[:-1]])
            beads = np.arange(count.sum()) + np.repeat(tree.first[nodes] - starts, count)
            along = np.einsum("fnji,fnj->fni", np.repeat(axes[:, nodes], count, axis=1), frames[:, beads])
            low, high = np.minimum.reduceat(along, starts, axis=1) - radius, np.maximum.reduceat(along, starts, axis=1) + radius
        centers[:, nodes] = np.einsum("fnij,fnj->fni", axes[:, nodes], (low + high) / 2)
        halves[:, nodes] = (high - low) / 2
    return centers, axes, halves


def separated(centers, axes, halves, other_centers, other_axes, other_halves):
    """Returns whether one of the 15 axes of the separating-axis test divides two boxes, for arrays of boxes (boxes, ...).

    Gottschalk, Lin and Manocha, OBBTree (1996). Rounding can hide that two boxes are disjoint, but not that they meet
    (coordinates below 1e5).
    """
    turn = np.swapaxes(axes, 1, 2) @ other_axes
    apart = np.einsum("nij,ni->nj", axes, other_centers - centers)
    size = np.abs(turn) + 1e-9  # the cross product of parallel edges divides nothing
    found = (np.abs(apart) > halves + np.einsum("nij,nj->ni", size, other_halves)).any(axis=1)
    found |= (np.abs(np.einsum("nij,ni->nj", turn, apart)) > other_halves + np.einsum("nij,ni->nj", size, halves)).any(axis=1)
    for i in range(3):
        i1, i2 = (i + 1) % 3, (i + 2) % 3
        for j in range(3):
            j1, j2 = (j + 1) % 3, (j + 2) % 3
            reach = halves[:, i1] * size[:, i2, j] + halves[:, i2] * size[:, i1, j]
            reach += other_halves[:, j1] * size[:, i, j2] + other_halves[:, j2] * size[:, i, j1]
            found |= np.abs(apart[:, i2] * turn[:, i1, j] - apart[:, i1] * turn[:, i2, j]) > reach
    return found
