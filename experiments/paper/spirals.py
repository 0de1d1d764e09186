"""What does the gap between two rolling spirals do to the figures of table 7?

Two equal spirals of 1000 beads are extended, half rolled or rolled up to 18 turns (steps 1, 500 and 1000 of table 7). The second one
is moved until its beads are nowhere nearer than a gap, given in radii of a bead from surface to surface. Poses are beside each
other in one plane, stacked (in parallel planes, one above the other), and ten random ones: a uniform rotation of the second spiral
and a uniform direction from the first to the second. Sets are the pairs of spheres that separate the centres of the two. Time is
that of table 7: the layered hierarchy anew, or lazy updates of the wrapped one, each with its search. Clocks read batches of calls.
"""

import itertools

import kds.timing
import numpy as np
from chains import random_numbers
from common import HERE, Report, read_csv
from scipy.spatial.transform import Rotation
from subjects import two_spirals

STAGES = {"extended": 1, "half rolled": 500, "rolled": 1000}
SEEDS = range(1, 11)  # of random poses
PAPER = {"extended": (0, 1, 2), "rolled": (3, 4)}  # rows of table 7 by the stage that they are compared with
COLORS = {"in one plane": "#2f6ea5", "stacked": "#b3462f", "random": "#3b8a5a"}


def random_pose(seed):
    """Returns a rotation, uniform over all rotations, and a direction, uniform on the sphere."""
    part, first, second, height, turn = itertools.islice(random_numbers(seed), 5)
    angles, height = 2 * np.pi * np.array([first, second, turn]), 2 * height - 1
    quaternion = *(np.sqrt(1 - part) * f(angles[0]) for f in (np.sin, np.cos)), *(np.sqrt(part) * f(angles[1]) for f in (np.sin, np.cos))
    return Rotation.from_quat(quaternion).as_matrix(), np.array([*(np.sqrt(1 - height**2) * f(angles[2]) for f in (np.cos, np.sin)), height])


def shifts(still, moved, way, gaps):
    """Returns for each gap the last shift along `way` at which two beads of radius 1 are that far apart."""
    between = still[:, None] - moved[None]
    along = between @ way
    across = (between**2).sum(axis=2) - along**2
    return [(along + np.sqrt(np.maximum((2 + gap)**2 - across, 0)))[across <= (2 + gap)**2].max() for gap in gaps]


def measured(beads, gaps, seeds, rounds):
    """Returns a row for each stage, pose and gap."""
    poses = [("in one plane", "", np.eye(3), np.array([0, 1, 0])), ("stacked", "", np.eye(3), np.array([0, 0, 1]))]
    poses += [("random", f" {seed}", *random_pose(seed)) for seed in seeds]
    for (stage, step), (pose, seed, rotation, way) in itertools.product(STAGES.items(), poses):
        first = [two_spirals(at, beads)[:beads] for at in (step - 1, step)]
        first = [points - points.mean(axis=0) for points in first]
        second = [points @ rotation.T for points in first]
        for gap, shift in zip(gaps, shifts(first[1], second[1], way, gaps)):
            before, after = (np.concatenate([one, other + shift * way]) for one, other in zip(first, second))
            found = kds.timing.updates_between(before, after, beads, rounds=rounds)
            yield {"row": f"{stage}, {pose}{seed}, gap {gap:.3g}", "stage": stage, "pose": pose, "seed": seed.strip(),
                   "gap": float(gap), "layered_pairs": found["layered_pairs"], "wrapped_pairs": found["wrapped_pairs"],
                   "frontier": found["frontier"], "layered_per_lazy": float(np.median(found["layered"] / found["lazy"]))}


if __name__ == "__main__":
    pass
