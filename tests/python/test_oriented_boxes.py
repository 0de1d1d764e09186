"""Oriented boxes and the search over bounding volumes of experiments/paper, compared with brute force and linear programs."""

import sys
import unittest
from pathlib import Path

import kds
import numpy as np

try:
    from scipy.optimize import linprog
    from scipy.spatial.transform import Rotation
except ImportError:
    linprog = None
else:
    sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "experiments" / "paper"))
    from oriented_boxes import oriented_boxes, separated
    from volumes import SPANNER_REACH, OrientedBoxes, Slabs, Spheres, Tree, search, search_along, search_spanner, spanner_unit

RADIUS = 1.4


def chain(beads, seed):
    """Returns a chain whose neighbours overlap, with bonds of different lengths."""
    frame = kds.generate("random-chain", beads=beads, frames=1, seed=seed)[0]
    return frame + np.random.default_rng(seed).uniform(-0.1, 0.1, frame.shape)


def meeting(positions, radius):
    """Returns the pairs of balls that meet and are at least 2 apart along the chain, by brute force."""
    first, second = np.triu_indices(len(positions), 2)
    near = np.linalg.norm(positions[first] - positions[second], axis=1) <= 2 * radius
    return np.stack([first[near], second[near]], axis=1)


def growth_until_meeting(box, other):
    """Returns the factor by which the sides of two boxes must be multiplied so that they just meet: a linear program."""
    rows, bounds = [], []
    for center, axes, halves in (box, other):
        for axis, half in zip(axes.T, halves):
            for side in (-1, 1):
                rows.append([*(side * axis), -half])
                bounds.append(side * axis @ center)
    return linprog([0, 0, 0, 1], rows, bounds, bounds=[(None, None)] * 3 + [(0, None)]).fun


@unittest.skipIf(linprog is None, "scipy is not installed")
class Boxes(unittest.TestCase):
    def test_boxes_hold_what_is_below_them(self):
        positions = np.stack([chain(77, 1), chain(77, 2)])
        tree = Tree(77)
        for tight in (False, True):
            centers, axes, halves = oriented_boxes(tree, positions, RADIUS, tight)
            for frame, node in np.ndindex(2, 76):
                at = 77 + node
                beads = positions[frame, tree.first[at] : tree.last[at] + 1]
                reach = np.abs((beads - centers[frame, at]) @ axes[frame, at]).max(axis=0) + RADIUS
                self.assertTrue((reach <= halves[frame, at] + 1e-9).all())
                if tight:
                    np.testing.assert_allclose(reach, halves[frame, at])
                    continue
                for child in tree.children[node][tree.children[node] >= 77]:
                    ends = np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, 8).T * halves[frame, child]
                    points = centers[frame, child] + ends @ axes[frame, child].T
                    self.assertTrue((np.abs((points - centers[frame, at]) @ axes[frame, at]) <= halves[frame, at] + 1e-9).all())

    def test_boxes_turn_with_the_chain(self):
        positions, tree = chain(50, 3), Tree(50)
        turned = positions @ Rotation.random(random_state=4).as_matrix().T
        np.testing.assert_allclose(*(oriented_boxes(tree, one[None], RADIUS)[2] for one in (positions, turned)))

    def test_boxes_are_separated_if_a_linear_program_says_so(self):
        random, count = np.random.default_rng(5), 600
        axes = Rotation.random(2 * count, random_state=6).as_matrix().reshape(2, count, 3, 3)
        axes[1, ::5] = axes[0, ::5]  # parallel boxes
        halves = np.exp(random.normal(size=(2, count, 3)))
        centers = random.normal(size=(2, count, 3))
        for k in range(count):  # nearly touching
            factor = growth_until_meeting(*((centers[side, k], axes[side, k], halves[side, k]) for side in (0, 1)))
            halves[:, k] *= factor * np.exp(random.choice([-1, 1]) * 10.0**random.uniform(-4, 0))
        found = separated(centers[0], axes[0], halves[0], centers[1], axes[1], halves[1])
        factors = [growth_until_meeting(*((centers[side, k], axes[side, k], halves[side, k]) for side in (0, 1)))
                   for k in range(count)]
        self.assertEqual(found.tolist(), [factor > 1 for factor in factors])
        self.assertTrue(count / 3 < found.sum() < 2 * count / 3)

    def test_searches_find_the_beads_that_meet(self):
        for seed, beads in ((7, 3), (8, 20), (9, 150)):
            positions, tree = chain(beads, seed), Tree(beads)
            expected = meeting(positions, RADIUS)
            volumes = [Spheres(build, positions, RADIUS) for build in (kds.wrapped_hierarchy, kds.layered_hierarchy)]
            volumes += [Slabs(tree, positions, RADIUS, k) for k in (3, 7, 13)]
            volumes += [OrientedBoxes(tree, positions, RADIUS, tight) for tight in (False, True)]
            for one in volumes:
                self.assertEqual(search(tree, one, positions, RADIUS)[2].tolist(), expected.tolist())
            if beads == 3:
                continue
            for radius in (RADIUS, 9):  # the search in the spanner begins at the beads, or at a level above them
                states = kds.run(positions[None].repeat(2, axis=0), radius=radius, structures=["power", "spanner"])
                for _, pairs in (search_along(states.power.edges(0), positions, radius),
                                 search_spanner(states.spanner.elements(0), positions, radius)):
                    self.assertEqual(pairs.tolist(), meeting(positions, radius).tolist())
        self.assertGreater(len(expected), 100)

    def test_counts_of_spheres_are_those_of_kds(self):
        positions, tree = chain(150, 10), Tree(150)
        for hierarchy, build in (("wrapped", kds.wrapped_hierarchy), ("layered", kds.layered_hierarchy)):
            found = search(tree, Spheres(build, positions, RADIUS), positions, RADIUS)
            self.assertEqual(found[:2], kds.separating_family(positions, RADIUS, hierarchy=hierarchy, rule="larger sphere")[:2])

    def test_scales_of_the_spanner_are_those_of_kds(self):
        for seed in (11, 12):
            positions = chain(150, seed)
            elements = kds.run(positions[None].repeat(2, axis=0), radius=1, structures="spanner").spanner.elements(0)
            is_edge = elements[:, 1] >= 0
            tops = elements[~is_edge, 3][np.argsort(elements[~is_edge, 0])]
            first, second = np.triu_indices(150, 1)
            scales = spanner_unit(positions) * 2.0**np.minimum(tops[first], tops[second])
            near = np.linalg.norm(positions[first] - positions[second], axis=1) <= SPANNER_REACH * scales
            self.assertEqual(elements[is_edge, :2].tolist(), np.stack([first[near], second[near]], axis=1).tolist())
            self.assertTrue(0 < near.sum() < len(near))
