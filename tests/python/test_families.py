"""What experiments/paper counts of balls at rest, compared with slow twins that follow the definitions."""

import importlib.util
import itertools
import math
import os
import sys
import unittest
from pathlib import Path

import kds
import kds.reading
import kds.timing
import numpy as np

RULES = ("more beads", "larger sphere", "first node")


def chain(beads, seed):
    """Returns a chain whose consecutive beads of radius 1 meet, with bonds of different lengths."""
    frame = kds.generate("random-chain", beads=beads, frames=1, seed=seed)[0]
    return frame + np.random.default_rng(seed).uniform(-1e-4, 1e-4, frame.shape)


class Tree:
    """The spheres of all nodes of a hierarchy by their first and last bead, beads included."""

    def __init__(self, centers, hierarchy="wrapped"):
        build = kds.wrapped_hierarchy if hierarchy == "wrapped" else kds.layered_hierarchy
        nodes, spheres = build(centers, 1)
        self.beads = len(centers)
        self.spheres = {(bead, bead): (*center, 1.0) for bead, center in enumerate(centers)}
        self.spheres.update({tuple(node): tuple(sphere) for node, sphere in zip(nodes.tolist(), spheres)})

    def halves(self, node):
        middle = (node[0] + node[1]) // 2
        return [(node[0], middle), (middle + 1, node[1])] if node[0] < node[1] else [node]

    def distance(self, a, b):
        return math.dist(self.spheres[a][:3], self.spheres[b][:3])

    def are_apart(self, a, b):
        return self.distance(a, b) > self.spheres[a][3] + self.spheres[b][3]

    def searched(self, a, b, rule, leaf):
        """The pairs of disjoint nodes that a search finds from two nodes, or from one."""
        if b[1] - a[0] < 2:
            return []
        size, other = a[1] - a[0] + 1, b[1] - b[0] + 1
        if a != b and self.are_apart(a, b):
            return [(a, b)]
        if size <= leaf and other <= leaf:
            beads = {(i, j) for i in range(a[0], a[1] + 1) for j in range(b[0], b[1] + 1) if j - i >= 2}
            return [((i, i), (j, j)) for i, j in beads if self.are_apart((i, i), (j, j))]
        if a == b:
            one, two = self.halves(a)
            parts = [(one, one), (two, two), (one, two)]
        else:
            first = {"more beads": size >= other, "larger sphere": self.spheres[a][3] >= self.spheres[b][3],
                     "first node": True}[rule]
            first = first and size > leaf or other <= leaf
            parts = [(half, b) for half in self.halves(a)] if first else [(a, half) for half in self.halves(b)]
        return [pair for part in parts for pair in self.searched(*part, rule, leaf)]

    def explicit(self):
        """The pairs of disjoint cages of one depth of which one lies within 8 R of the other."""
        family, nodes = set(), [(0, self.beads - 1)]
        while True:
            reach = 8 * max(last - first + 1 for first, last in nodes)
            for a, b in itertools.combinations(nodes, 2):
                distance, radii = self.distance(a, b), (self.spheres[a][3], self.spheres[b][3])
                if b[1] - a[0] >= 2 and self.are_apart(a, b) and distance + min(radii) <= max(radii) + reach:
                    family.add((a, b))
            if all(first == last for first, last in nodes):
                return family
            nodes = [half for node in nodes for half in self.halves(node)]

    def smallest(self, overlaps=False):
        """The least number of products of disjoint nodes that cover each pair of disjoint beads, by trying all: once, or with
        overlaps at least once."""
        asked = frozenset(pair for pair in itertools.combinations(range(self.beads), 2)
                          if pair[1] - pair[0] >= 2 and self.are_apart(*((bead, bead) for bead in pair)))
        products = [frozenset(itertools.product(range(a[0], a[1] + 1), range(b[0], b[1] + 1)))
                    for a, b in itertools.permutations(self.spheres, 2) if a[1] < b[0] and self.are_apart(a, b)]
        products = [product & asked for product in products if product & asked == {p for p in product if p[1] - p[0] >= 2}]
        best = len(asked)

        def cover(left, used):
            nonlocal best
            if not left:
                best = min(best, used)
            elif used + 1 < best:
                for product in products:
                    if min(left) in product and (overlaps or product <= left):
                        cover(left - product, used + 1)

        cover(asked, 0)
        return best


class Families(unittest.TestCase):
    def test_searches_by_other_rules_follow_them(self):
        for seed, hierarchy, rule, leaf in itertools.product((1, 2), ("wrapped", "layered"), RULES, (1, 2, 5)):
            centers = chain(70, seed)
            tree = Tree(centers, hierarchy)
            expected = tree.searched((0, 69), (0, 69), rule, leaf)
            pairs, tests, _ = kds.separating_family(centers, 1, hierarchy=hierarchy, rule=rule, leaf=leaf)
            self.assertEqual(pairs, len(expected), (seed, hierarchy, rule, leaf))
            self.assertGreater(tests, pairs)

    def test_the_explicit_family_is_the_one_defined(self):
        straight = np.array([[1.999 * k, 0, 0] for k in range(128)])  # longer than 8 R at the lowest depths
        for centers in (chain(90, 3), chain(117, 4), straight):
            for hierarchy in ("wrapped", "layered"):
                self.assertEqual(kds.separating_family(centers, 1, hierarchy=hierarchy, rule="explicit")[0],
                                 len(Tree(centers, hierarchy).explicit()))

    def test_no_family_is_smaller_than_the_smallest(self):
        below_the_search = 0
        for beads, seed in itertools.product((5, 6, 7, 8), range(12)):
            centers = chain(beads, seed)
            found, smallest = (kds.separating_family(centers, 1, rule=rule)[0] for rule in ("more beads", "smallest"))
            self.assertEqual(smallest, Tree(centers).smallest(), (beads, seed))
            below_the_search += smallest < found
        self.assertGreater(below_the_search, 2)

    @unittest.skipUnless(importlib.util.find_spec("scipy"), "scipy is not installed")
    def test_the_linear_program_bounds_all_families(self):
        sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "experiments" / "paper"))
        import families

        saved_by_overlaps = 0
        for beads, seed, stretched in itertools.product((6, 7), range(10, 35), (1, 1.2)):
            centers = stretched * chain(beads, seed)  # neighbours meet, or do not
            least, without = (Tree(centers).smallest(overlaps) for overlaps in (True, False))
            bound, attained, _ = families.bounds(centers)
            self.assertEqual((bound, attained), (least, least), (beads, seed, stretched))
            self.assertLessEqual(families.bound_by_place(centers), bound)
            saved_by_overlaps += least < without
        self.assertGreater(saved_by_overlaps, 2)

    def test_refuses_what_the_theorem_does_not_cover(self):
        gap = np.array([[0, 0, 0], [2, 0, 0], [5, 0, 0], [7, 0, 0]])
        for how, message in (({"rule": "explicit"}, "beads 1 and 2 do not meet"), ({"rule": "least"}, "'least' is not one of"),
                             ({"hierarchy": "boxes"}, "'boxes' is not one of wrapped, layered"), ({"leaf": 9}, "leaf: 9")):
            with self.assertRaisesRegex(kds.InputError, message):
                kds.separating_family(gap, 1, **how)

    def test_between_asks_about_two_necklaces_only(self):
        centers = np.concatenate([chain(40, 1), chain(40, 2) + [60, 0, 0]])
        self.assertEqual(kds.separating_family(centers, 1, necklaces=[40, 40], between=True)[0], 1)
        self.assertGreater(kds.separating_family(centers, 1, necklaces=[40, 40])[0], 41)


class AtRest(unittest.TestCase):
    def test_the_diagram_finds_the_closest_pair(self):
        for seed in range(5):
            centers = chain(200, seed)
            pair, examined, times = kds.closest_by_diagram(centers, 1, rounds=2)
            self.assertEqual(pair[:2], kds.closest_pair(centers, 1)[:2])
            self.assertGreater(sum(examined.values()), 200)
            self.assertEqual(len(times), 2)

    def test_layered_spheres_hold_those_of_their_children(self):
        tree = Tree(chain(100, 1), "layered")
        for node in tree.spheres:
            for half in tree.halves(node):
                self.assertLessEqual(tree.distance(node, half) + tree.spheres[half][3], tree.spheres[node][3] * (1 + 1e-12))

    def test_trusted_spheres_are_those_of_old_bases(self):
        before, after = kds.generate("random-chain", beads=60, frames=2, step=0.5)
        nodes, verified = kds.wrapped_hierarchy(before, 1)
        bases, spheres, times = kds.trusted_hierarchy(before, before, 1, rounds=1)
        np.testing.assert_allclose(spheres, verified)
        self.assertEqual(times.shape, (1, 2))
        _, spheres, _ = kds.trusted_hierarchy(before, after, 1)
        of_two = 0
        for (first, last), basis, sphere in zip(nodes, bases, spheres):
            beads = [bead for bead in basis if bead >= 0]
            self.assertTrue(all(first <= bead <= last for bead in beads))
            if len(beads) == 2:
                np.testing.assert_allclose(sphere[:3], after[beads].mean(axis=0), rtol=0, atol=1e-9)
                self.assertAlmostEqual(sphere[3], math.dist(*after[beads]) / 2 + 1, places=9)
                of_two += 1
        self.assertGreater(of_two, 20)


class Refusals(unittest.TestCase):
    def assert_refused(self, text, function, *arguments, **options):
        with self.assertRaises(kds.InputError) as refused:
            function(*arguments, **options)
        self.assertIn(text, str(refused.exception))
        self.assertNotIn("\n", str(refused.exception))

    def test_points_that_are_none(self):
        line = [[0, 0, 0], [2, 0, 0], [4, 0, 0], [6, 0, 0]]
        for bad in (math.nan, math.inf):
            points = [[0, 0, bad], *line[1:]]
            self.assert_refused("centers: bead 0 has z", kds.timing.builds, points)
            self.assert_refused("centers: bead 0 has z", kds.timing.searches, points)
            self.assert_refused("after: bead 0 has z", kds.timing.updates, line, points)
            self.assert_refused("before: bead 0 has z", kds.timing.updates_between, points, line, 2)
            self.assert_refused("before: bead 0 has z", kds.trusted_hierarchy, points, line, 1)
        self.assert_refused("centers: has 1 bead; expected 2", kds.timing.builds, line[:1])
        self.assert_refused("expected two necklaces", kds.timing.updates_between, line[:3], line[:3], 2)
        self.assert_refused("rounds: is 1000", kds.timing.builds, line, rounds=10**20)
        self.assert_refused("strides: is 0", kds.timing.contact_steps, [line, line], 1, strides=[0])
        for steps in (kds.timing.contact_steps, kds.timing.hierarchy_steps):
            self.assert_refused("frames: has fewer than two frames", steps, [line], 1)
            self.assert_refused("frames: expected the shape", steps, line, 1)
            self.assert_refused("frames: all beads lie in one plane", steps, [line, line], 1)
        self.assert_refused("would round", kds.layered_hierarchy, np.array([[0, 0, 0], [2**62 + 1, 0, 0]]), 1)

    def test_results_that_are_no_doubles(self):
        far = [[-1.7e308, 0, 0], [1.7e308, 1.7e308, 0]]
        self.assert_refused("too large", kds.trusted_hierarchy, far, far, 1)
        self.assert_refused("too large", kds.closest_by_diagram, [*far, [0, -1.7e308, 0]], 0)

    def test_files_that_are_none(self):
        file = os.path.join(os.environ["KDS_DATA"], "proteins", "1l2y.pdb")
        self.assert_refused("no such file", kds.reading.positions, "nowhere.pdb")
        self.assert_refused("'nowhere.pdb': no such file", kds.reading.positions, file, "nowhere.pdb")
        self.assert_refused("null character", kds.reading.positions, file + "\0x")


if __name__ == "__main__":
    unittest.main()
