"""Chains of beads of radius 1 that the scripts of this folder share, and their random numbers."""

import kds
import numpy as np
from subjects import BOND, half_longest_bond, trajectory


def random_numbers(seed):
    """Yields the random numbers in [0, 1) of the models of kds: those of the engine mt19937_64 of C++."""
    state, words = [seed % 2**64], 312
    for k in range(1, words):
        state.append((6364136223846793005 * (state[-1] ^ state[-1] >> 62) + k) % 2**64)
    x = np.array(state, np.uint64)
    low, one = np.uint64(2**31 - 1), np.uint64(1)

    def twisted(first, second, far):
        y = (first & ~low) | (second & low)
        return far ^ (y >> one) ^ (y & one) * np.uint64(0xB5026F5AA96619E9)

    while True:
        half = twisted(x[:156], x[1:157], x[156:])
        x = np.concatenate([half, twisted(x[156:], np.append(x[157:], half[0]), half)])
        y = x ^ (x >> np.uint64(29)) & np.uint64(0x5555555555555555)
        y ^= (y << np.uint64(17)) & np.uint64(0x71D67FFFEDA60000)
        y ^= (y << np.uint64(37)) & np.uint64(0xFFF7EEE000000000)
        y ^= y >> np.uint64(43)
        yield from ((y >> np.uint64(11)) * 2.0**-53).tolist()


def model(name, beads, seed=1, **options):
    """Returns the first frame of a model of kds."""
    return kds.generate(name, beads=beads, frames=1, seed=seed, **options)[0]


def layered_and_wrapped(centers, radius):
    """Returns the spheres of the layered and of the wrapped hierarchy, each with its root first."""
    return [build(centers, radius)[1] for build in (kds.layered_hierarchy, kds.wrapped_hierarchy)]


def tightness_points(height):
    """Returns the 2^height points of Lemma 2.5 on a circle, whose layered root has the radius sqrt(height)."""
    angles, ray, distance, leg = np.zeros(1, np.longdouble), np.longdouble(0), np.longdouble(1), 1 / np.sqrt(np.longdouble(height))
    for _ in range(height - 1):
        following = np.sqrt(distance**2 - leg**2)
        ray += np.arccos(following / distance)
        distance = following
        angles = np.concatenate([angles, 2 * ray - angles])
    half = np.stack([np.cos(angles), np.sin(angles)], axis=1).astype(float)
    return np.concatenate([half, -half])


def beads_of_grid(dimension, side):
    """Returns the number of beads of a packed grid: its rows, and a bead that joins each row to the next."""
    rows = side**(dimension - 1)
    return rows * side + rows - 1


def sides_of_grids(dimension, most):
    """Returns odd sides of grids of 1,000 to `most` beads. With powers of two, nodes would end where rows end."""
    side = max(side for side in range(3, most, 2) if side == 3 or beads_of_grid(dimension, side) <= most)
    sides, following = [], float(side)
    while beads_of_grid(dimension, side) >= 1000:
        sides.append(side)
        following /= 1.34 if dimension == 2 else 1.22
        side = min(side - 2, 2 * int(following / 2) + 1)
    return sides[::-1]


def _layer(side, gap):
    """Returns one layer of two interleaved grids, and whether it ends at the right. In pair k of rows, the first chain has
    row 2k if k is even, else row 2k + 1."""
    apart, pairs, chains = 2 * (1 + gap), side // 2, ([], [])
    beside = np.sqrt(BOND**2 - apart**2 / 4)
    beyond, across = int(np.ceil((beside + apart) / BOND)), int(np.ceil(3 * apart / BOND))
    for k in range(pairs):
        outward = 1 if k % 2 == 0 else -1
        end = BOND * (side - 1) if outward == 1 else 0
        for chain in (0, 1):
            row = 2 * k + (0 if k % 2 == chain else 1)
            chains[chain].extend((BOND * i, apart * row, 0) for i in range(side)[::outward])
            if k + 1 == pairs:
                continue
            if row % 2 == 1:
                chains[chain].append((end + outward * beside, apart * row + apart / 2, 0))
                continue
            # The other chain goes straight on until that turn is clear, then past three gaps of rows, and back.
            outer = [(out, 0) for out in range(1, beyond)] + [(beyond, up) for up in range(across + 1)]
            outer += [(out, across) for out in range(beyond - 1, 0, -1)]
            chains[chain].extend((end + outward * BOND * out, apart * row + 3 * apart * up / across, 0) for out, up in outer)
    return [np.array(chain, float) for chain in chains], apart, beside, 1 if pairs % 2 else -1


def interleaved_grids(side, dimension, gap):
    """Returns two chains that are packed into one square or cube, row beside row."""
    layer, apart, beside, end = _layer(side, gap)
    if dimension == 2:
        return layer
    chains = ([], [])
    for chain, positions in zip(chains, layer):
        for level in range(side):
            chain.append(positions[::1 if level % 2 == 0 else -1] + [0, 0, apart * level])
            if level + 1 < side:
                out = end if level % 2 == 0 else -1  # every layer begins at the left
                chain.append(chain[-1][-1:] + [out * beside, 0, apart / 2])
    return [np.concatenate(chain) for chain in chains]


def order_by_space(centers):
    """Returns the beads in the order of a k-d tree: each node cuts the longest side of its box at the median bead."""

    def cut(beads):
        if len(beads) < 3:
            return [beads]
        positions = centers[beads]
        axis = int(np.argmax(np.ptp(positions, axis=0)))
        beads = beads[np.lexsort((beads, positions[:, axis]))]
        half = (len(beads) + 1) // 2
        return cut(beads[:half]) + cut(beads[half:])

    return np.concatenate(cut(np.arange(len(centers))))


def proteins(data):
    """Returns name, 200 frames and radius of the two proteins that questions are asked of."""
    found = [(name, trajectory(model, data)) for name, model in (("villin", "villin"), ("random protein", "random100"))]
    return [(name, frames[:200], half_longest_bond(frames)) for name, frames in found]
