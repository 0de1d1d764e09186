"""Do the quantities that the paper's theorems bound grow as the theorems say?

Measures them for growing sizes, on necklaces where the bounds are tight and on others, and fits exponents and laws. Exponents
are those of n, for the ratio of the roots those of the height h of the tree. In the plane, families are divided by log2 n. No
measurement proves a theorem.

  paths      tests per node of a cascade verification, without and with path cages (remark in section 2.3)
  2.3        radius of the layered root / radius of the wrapped root: at most sqrt(h + 1)
  groupings  the same with antipodal points paired, and with beads grouped by space (remark after 2.3)
  3.1        pairs in separating families of packed grids: n log n in the plane, n^(4/3) in space
  families   pairs in the family of the proof of 3.1, in the smallest one, and in those of other searches and groupings
  3.2        times of the searches of 3.1, which are no counts
  3.3        pairs in the family between two interleaved grids of n beads each
  3.5        pairs that are examined to find the closest one: edges of the power diagram, common neighbours, ends
"""

import functools

import fits
import kds
import numpy as np
from chains import beads_of_grid, interleaved_grids, layered_and_wrapped, model, order_by_space, sides_of_grids, tightness_points
from common import Report
from path_cages import cascade

MOST, MOST_SHORT = 16_384, 4096  # beads of the largest necklaces
MOST_OF_SMALLEST = 8192  # the memory of the smallest family grows with n^(5/3)
SEEDS = (1,)  # of random chains; several seeds give means with 95% intervals
GAP = 0.05  # between the rows of grids, in diameters
LEMMA = "points of Lemma 2.5"
SPACE = {2: "the plane", 3: "space"}
SAYS = {"paths": "testing intersections of cages on the path to a node costs more than it saves",
        "2.3": "the layered root is at most sqrt(h + 1) times the wrapped one, on some points sqrt(h) times",
        "groupings": "the bound of 2.3 holds for any grouping; with antipodal points paired all layered spheres are equal",
        "3.1": "the separating family has O(n log n) pairs in the plane, O(n^(4/3)) in space; tight on grids",
        "families": "the search finds a family of this size by splitting the node with more beads",
        "3.3": "between two necklaces of n beads the same bounds hold",
        "3.5": "the closest pair is an edge of the power diagram, or has a common neighbour, or a bead beside an end"}
FAMILY_LAW = {2: (1, 1), 3: (4 / 3, 0)}  # the term of Theorem 3.1


def powers_of_two(least, most):
    return [least << k for k in range(32) if least << k <= most]


def grid_sides(dimension, most, largest=MOST):
    """Returns those of the sides up to `largest` beads that have at most `most`, so that a short form has some of all sizes."""
    return [side for side in sides_of_grids(dimension, largest) if beads_of_grid(dimension, side) <= most]


def grid_sizes(dimension, most, largest=MOST):
    return [beads_of_grid(dimension, side) for side in grid_sides(dimension, most, largest)]


@functools.cache
def grid(dimension, beads):
    return model("grid", beads, dimension=dimension, gap=GAP, motion="rest")[:, :dimension]


@functools.cache
def random_chain(beads, seed):
    return model("random-chain", beads, seed, motion="rest")


def height(beads):
    return (beads - 1).bit_length()


def series(theorem, name, dimension, points, hierarchy="", variant="", expected=None, at_most=False):
    """One quantity at all sizes. A point has n, value and what else is known."""
    return {"theorem": theorem, "model": name, "dimension": dimension, "hierarchy": hierarchy, "variant": variant,
            "expected": expected, "at_most": at_most, "points": points}


def over_seeds(measure):
    """Returns the point of the first seed, with the mean of its value over all seeds."""
    points = [measure(seed) for seed in SEEDS]
    mean, lower, upper = fits.mean_interval([point["value"] for point in points])
    held = {"holds": all(point["holds"] for point in points)} if "holds" in points[0] else {}
    return {**points[0], "value": mean, "lower": lower, "upper": upper, **held}


def paths(most):
    """Counts the tests of both cascades over the second of two frames."""
    for name, dimension, made in (
            ("rolling spiral", 2, functools.partial(kds.generate, "spiral", turns=8, rolled="0.5:0.52")),
            ("wandering random chain", 3, functools.partial(kds.generate, "random-chain", motion="wander"))):
        found = {"cascade": [], "path cages": []}
        for beads in powers_of_two(1024, most):
            before, after = made(beads=beads, frames=2, seed=SEEDS[0])[:, :, :dimension]
            _, usual = cascade(before, after, False)
            for variant, points in found.items():
                tests, escaped = cascade(before, after, variant == "path cages")
                points.append({"n": beads, "value": tests / (beads - 1), "tests": tests, "holds": escaped == usual})
        for variant, points in found.items():
            yield series("paths", name, dimension, points, variant=variant)


def ratio_of_roots(centers, radius):
    layered, wrapped = (spheres[0, 3] for spheres in layered_and_wrapped(centers, radius))
    ratio, bound = (layered / wrapped if wrapped > 0 else 1), np.sqrt(height(len(centers)) + 1)
    return {"n": len(centers), "value": float(ratio), "bound": float(bound), "holds": bool(ratio <= bound)}


def roots(most, theorem):
    """The ratio of the roots along the chain (2.3), or for other groupings."""
    sizes = powers_of_two(16, most)

    def grouped(centers):
        return centers[order_by_space(centers)] if theorem == "groupings" else centers

    variant, expected = ("by space", None) if theorem == "groupings" else ("", 0.5)
    if theorem == "groupings":
        pairs = [np.arange(beads).reshape(2, -1).T.ravel() for beads in sizes]  # beads i and i + n/2 are antipodal
        yield series(theorem, LEMMA, 2, [ratio_of_roots(tightness_points(height(beads))[order], 0)
                                         for beads, order in zip(sizes, pairs)], variant="antipodes paired")
    yield series(theorem, LEMMA, 2, [ratio_of_roots(grouped(tightness_points(height(beads))), 0) for beads in sizes],
                 variant=variant, expected=expected)
    for dimension in (2, 3):
        yield series(theorem, "grid", dimension, [ratio_of_roots(grouped(grid(dimension, beads)), 1) for beads in sizes],
                     variant=variant)
    yield series(theorem, "random chain", 3,
                 [over_seeds(lambda seed, n=beads: ratio_of_roots(grouped(random_chain(n, seed)), 1))
                  for beads in sizes], variant=variant)


def family(centers, dimension, **how):
    """Counts a separating family beside the bound of Theorem 3.1."""
    beads = max(how.get("necklaces", [len(centers)]))
    pairs, tests, seconds = kds.separating_family(centers, 1, **how)
    bound = float(beads * np.log2(beads) if dimension == 2 else beads**(4 / 3))
    return {"n": beads, "value": pairs, "bound": bound, "tests": tests, "seconds": float(np.median(seconds)) if len(seconds) else None}


def families(most, rounds):
    """Theorems 3.1 and 3.2: the families that a search finds, and its time."""
    for name, dimension, hierarchy in (("grid", 2, "wrapped"), ("grid", 2, "layered"), ("grid", 3, "wrapped"),
                                       ("grid", 3, "layered"), ("random chain", 3, "wrapped")):
        if name == "grid":
            points = [family(grid(dimension, beads), dimension, hierarchy=hierarchy, rounds=rounds)
                      for beads in grid_sizes(dimension, most)]
        else:
            points = [over_seeds(lambda seed, n=beads: family(random_chain(n, seed), 3, rounds=rounds))
                      for beads in powers_of_two(1024, most)]
        yield series("3.1", name, dimension, points, hierarchy, expected=FAMILY_LAW[dimension][0],
                     at_most=name == "random chain")


COMPARED = [("wrapped", "smallest", {"rule": "smallest"}), ("wrapped", "found by the search", {}),
            ("wrapped", "explicit", {"rule": "explicit"}), ("wrapped", "larger sphere split", {"rule": "larger sphere"}),
            ("wrapped", "first node split", {"rule": "first node"}), ("wrapped", "leaves of 2 beads", {"leaf": 2}),
            ("wrapped", "leaves of 8 beads", {"leaf": 8}), ("wrapped", "grouped by space", {"apart": 1}),
            ("layered", "smallest", {"rule": "smallest"}), ("layered", "found by the search", {}),
            ("layered", "explicit", {"rule": "explicit"})]


def compared_families(most):
    """The family of the proof, the smallest one, and those of other rules, leaves and groupings."""
    most = min(most // 2, MOST_OF_SMALLEST)
    for name, dimension in (("grid", 2), ("grid", 3), ("random chain", 3)):
        chains = ([grid(dimension, beads) for beads in grid_sizes(dimension, most, MOST_OF_SMALLEST)] if name == "grid"
                  else [random_chain(beads, SEEDS[0]) for beads in powers_of_two(1024, most)])
        for hierarchy, variant, how in COMPARED:
            by_space = variant == "grouped by space"  # the tree's order is not the chain's, so all pairs are asked about
            points = [family(chain[order_by_space(chain)] if by_space else chain, dimension, hierarchy=hierarchy, **how)
                      for chain in chains]
            if variant == "smallest":
                smallest = points
            for point, least in zip(points, smallest):
                point["holds"] = None if by_space else least["value"] <= point["value"]
            yield series("families", name, dimension, points, hierarchy, variant)


def two_necklaces(most, rounds):
    """Corollary 3.3: the family between two necklaces that are packed into one square or cube."""
    for dimension in (2, 3):
        points = []
        for side in grid_sides(dimension, most):
            chains = interleaved_grids(side, dimension, GAP)
            points.append(family(np.concatenate(chains)[:, :dimension], dimension, necklaces=[len(chain) for chain in chains],
                                 between=True, rounds=rounds))
        yield series("3.3", "two interleaved grids", dimension, points, "wrapped", expected=FAMILY_LAW[dimension][0])


def closest_pair(centers, rounds):
    """Theorem 3.5: examines the pairs that the power diagram and the chain give. Another search must find the same pair."""
    pair, examined, seconds = kds.closest_by_diagram(centers, 1, rounds=rounds)
    return {"n": len(centers), "value": sum(examined.values()), "holds": pair[:2] == kds.closest_pair(centers, 1)[:2],
            "seconds": float(np.median(seconds))}


def closest_pairs(most, rounds):
    overlap = 0.05 * (1 - GAP)  # in a regular grid all adjacent pairs are equally close, so beads are moved a little
    disturbed = {"motion": "rest", "bond": 1 - overlap, "gap": GAP, "jitter": min(0.4 * GAP, 0.9 * overlap)}
    for dimension in (2, 3):
        yield series("3.5", "grid", dimension, [
            over_seeds(lambda seed, n=beads: closest_pair(
                model("grid", n, seed, dimension=dimension, **disturbed)[:, :dimension], rounds))
            for beads in grid_sizes(dimension, most)], expected=1)
    yield series("3.5", "random chain", 3, [
        over_seeds(lambda seed, n=beads: closest_pair(random_chain(n, seed), rounds))
        for beads in powers_of_two(1024, most)], expected=1)
    # With a constant number of turns the diagram of a helix has quadratic size, so it has fewer beads.
    yield series("3.5", "helix", 3, [closest_pair(model("helix", beads, turns=10, motion="rest"), rounds)
                                     for beads in powers_of_two(512, most // 4)])


def growth(one):
    """Fits a series: its exponent beside lower-order terms, and the law of the theorem with or without such terms."""
    theorem, dimension, expected = one["theorem"], one["dimension"], one["expected"]
    is_ratio, is_family = theorem in ("2.3", "groupings"), theorem in ("3.1", "families", "3.3")
    logarithm = int(is_family and dimension == 2)
    lower = [(1, 0), (0, 0)] if is_family else [((dimension - 1) / dimension, 0)] if theorem == "3.5" else [(0, 0)]
    forms = [((expected, logarithm), *lower[:terms]) for terms in range(len(lower) + 1)] if expected else []
    forms += fits.USUAL_FORMS if not expected or one["at_most"] else []
    points = [(height(point["n"]) if is_ratio else point["n"], point["value"]) for point in one["points"]]
    return fits.growth(points, lower, forms, logarithm, "h" if is_ratio else "n")


def show(report, theorem, every):
    """Prints the series of a theorem and their fits, and keeps them for the JSON."""
    report.say(f"{theorem}: {SAYS[theorem]}")
    names = [", ".join(part for part in (f"{one['model']} in {SPACE[one['dimension']]}", one["hierarchy"], one["variant"]) if part)
             for one in every]
    report.show(("necklaces", "n", "value", "value / bound", "pairs compared", "seconds"), [
        (name, point["n"], point["value"], point.get("bound") and point["value"] / point["bound"], point.get("tests"),
         point.get("seconds")) for name, one in zip(names, every) for point in one["points"]])
    laws = [growth(one) for one in every]
    report.show(("growth", "line", "last", "beside lower terms", "theorem", "law", "within", "predicts the last"), [
        (name, law["line"], law["last"], law["exponent"], one["expected"], law["law"], law["residual_most"],
         law["prediction_error"]) for name, one, law in zip(names, every, laws)])
    for name, one, law in zip(names, every, laws):
        report.results["rows"] += [{"row": f"{theorem}, {name}, {point['n']} beads", **point} for point in one["points"]]
        report.results.setdefault("fits", []).append({"row": f"{theorem}, {name}", **law})


def main():
    report = Report(__doc__)
    most, rounds = MOST_SHORT if report.short else MOST, report.rounds
    measured = {"paths": paths(most), "2.3": roots(most, "2.3"), "groupings": roots(most, "groupings"),
                "3.1": families(most, rounds), "families": compared_families(most), "3.3": two_necklaces(most, rounds),
                "3.5": closest_pairs(most, rounds)}
    claims = {"paths": "both cascades find the same nodes to repair", "2.3": "the bound holds", "groupings": "the bound holds",
              "families": "no family over a tree is smaller than the smallest", "3.5": "another search finds the same pair"}
    for theorem, found in measured.items():
        every = list(found)
        show(report, theorem, every)
        held = [point["holds"] for one in every for point in one["points"] if point.get("holds") is not None]
        if held:
            report.claim(theorem, claims[theorem], all(held), f"in {sum(held)} of {len(held)} necklaces")
    report.finish()


if __name__ == "__main__":
    main()
