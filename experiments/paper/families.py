"""How small can a separating family be?

A family covers each pair of disjoint beads by two disjoint spheres, one over each bead. The search finds one family, and
dynamic programming finds the smallest one without overlaps, which covers no pair of beads twice. This script bounds all
families from below by linear programming. The dual program gives a weight to each pair of beads. If two disjoint spheres cover
pairs of beads with weights of at most m in all, a family has at least (sum of weights) / m pairs. Weights are rounded to
integers and then summed, so the bound is proved and does not rest on the solver. The primal solution is a family, perhaps with
overlaps. If it is as small as the bound, no family is smaller. A second bound, of small necklaces only, holds if a sphere also
covers beads of other nodes that lie in it.

Each node has its own program, for the pairs of spheres of which one is under its first half and one under its second half.
Pairs of spheres that a pair further up covers are left out, and pairs of beads that have the same covers share a row.
"""

import itertools
from pathlib import Path

import kds
import kds.reading
import numpy as np
from chains import beads_of_grid, model
from common import HERE, Report, save, subplots
from scipy.optimize import linprog
from scipy.sparse import csr_matrix
from subjects import SCALING_TURNS, SPIRAL_TURNS, half_longest_bond

GAP = 0.05  # between the rows of grids, in diameters
UNIT = 2**32  # of rounded weights
FEW = 110  # beads of the largest necklaces of the short form
FEW_BY_PLACE = 140  # beads of the largest necklaces of bound_by_place
COLORS = ("#2f6ea5", "#1f2933", "#3b8a5a", "#c98a1b", "#b3462f", "#8b6fb3")  # of kinds of necklaces


def spheres_of(centers, radius, hierarchy):
    """Returns first and last bead and sphere of all nodes, beads included, in preorder."""
    nodes, spheres = getattr(kds, f"{hierarchy}_hierarchy")(centers, radius)
    beads = np.arange(len(centers))
    flat = np.pad(centers, ((0, 0), (0, 3 - centers.shape[1])))
    nodes = np.concatenate([nodes, np.stack([beads, beads], 1)])
    order = np.lexsort((-nodes[:, 1], nodes[:, 0]))
    return nodes[order], np.concatenate([spheres, np.insert(flat, 3, radius, 1)])[order]


def second_half(node):
    """Returns the place of a node's second half after the node; the first half is the next node."""
    return 2 * ((node[1] - node[0]) // 2 + 1)


def over(found, nodes):
    """Returns for each node whether `found`, an array with a row for each node, is true for a node above it."""
    above = np.zeros_like(found)
    for k, node in enumerate(nodes):
        for half in (1, second_half(node)) if node[0] < node[1] else ():
            above[k + half] = above[k] | found[k]
    return above


def rows_of_sets(sets, count):
    """Returns a sparse matrix with a row for each set of numbers below `count`, with ones in the columns of the set."""
    ends = np.cumsum([0, *map(len, sets)])
    return csr_matrix((np.ones(ends[-1]), np.concatenate(sets), ends), shape=(len(sets), count))


def bound_between(left, right):
    """Returns the bound for pairs of a node of one half and one of the other, the size of a family of such pairs, and how near
    two spheres are to touching, relative to their radii. A half is nodes and spheres."""
    (nodes, spheres), (others, beyond) = left, right
    distance = np.linalg.norm(spheres[:, None, :3] - beyond[None, :, :3], axis=2)
    reach, starts = spheres[:, None, 3] + beyond[None, :, 3], (nodes[0, 0], others[0, 0])
    nodes, others = nodes - starts[0], others - starts[1]
    asked = nodes[:, None, 0] + starts[0] + 2 <= others[None, :, 1] + starts[1]
    disjoint = (distance > reach) & asked
    margin = np.abs(distance / reach - 1)[asked].min(initial=np.inf)
    outdone = over(disjoint, nodes)
    pairs = np.argwhere(disjoint & ~outdone & ~over((disjoint | outdone).T, others).T)
    rectangles = [(slice(a, b + 1), slice(c, d + 1)) for (a, b), (c, d) in zip(nodes[pairs[:, 0]], others[pairs[:, 1]])]
    codes = np.zeros((nodes[0, 1] + 1, others[0, 1] + 1), np.uint64)  # equal where the same rectangles cover pairs of beads
    for rectangle, code in zip(rectangles, np.random.default_rng(1).integers(2**63, size=len(pairs), dtype=np.uint64)):
        codes[rectangle] += code
    codes[-1, 0] = 0  # these two beads are neighbours, which a family need not cover
    if not len(pairs):
        return 0, 0, margin
    kinds, places, rows = np.unique(codes, return_index=True, return_inverse=True)
    rows = rows.reshape(codes.shape)
    covered = [np.unique(rows[rectangle]) for rectangle in rectangles]
    matrix = rows_of_sets(covered, len(places))
    used = np.flatnonzero(kinds)
    solved = linprog(-np.ones(len(used)), matrix[:, used], np.ones(len(pairs)), method="highs")
    weights = np.zeros(codes.size, np.int64)
    weights[places[used]] = np.rint(np.maximum(solved.x, 0) * UNIT)
    sums = np.pad(weights.reshape(codes.shape).cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    rows_of = sums[nodes[:, 1] + 1] - sums[nodes[:, 0]]
    most = (rows_of[:, others[:, 1] + 1] - rows_of[:, others[:, 0]])[disjoint].max()
    taken, reached = np.flatnonzero(-solved.ineqlin.marginals > 1e-6), np.zeros(codes.shape, bool)
    for k in taken:
        reached[rectangles[k]] = True
    if not reached[codes > 0].all():
        raise ArithmeticError("the solution of the linear program is no family")
    return -(-int(weights.sum()) // int(most)), len(taken), margin


def bound_by_place(centers, radius=1, hierarchy="wrapped"):
    """Returns the bound for families in which a sphere also covers beads of other nodes that lie in it."""
    nodes, spheres = spheres_of(centers, radius, hierarchy)
    points = spheres[nodes[:, 0] == nodes[:, 1], :3]
    inside = np.linalg.norm(spheres[:, None, :3] - points, axis=2) + radius <= spheres[:, 3:] * (1 + 1e-12)
    disjoint = np.linalg.norm(spheres[:, None, :3] - spheres[:, :3], axis=2) > spheres[:, 3:] + spheres[:, 3]
    asked = np.triu(np.linalg.norm(points[:, None] - points, axis=2) > 2 * radius, 2)
    number = np.cumsum(asked).reshape(asked.shape) - 1
    covers = {}  # without repetitions
    for one, other in np.argwhere(np.triu(disjoint)):
        held = np.outer(inside[one], inside[other])
        covered = number[(held | held.T) & asked]
        covers[covered.tobytes()] = covered
    matrix = rows_of_sets(list(covers.values()), asked.sum())
    weights = np.rint(np.maximum(linprog(-np.ones(asked.sum()), matrix, np.ones(len(covers)), method="highs").x, 0) * UNIT)
    return -(-int(weights.astype(np.int64).sum()) // int((matrix.astype(np.int64) @ weights.astype(np.int64)).max()))


def bounds(centers, radius=1, hierarchy="wrapped"):
    """Returns a lower bound for the sizes of all families, the size of a family, and how near two spheres are to touching."""
    nodes, spheres = spheres_of(centers, radius, hierarchy)
    found = []
    for k, node in enumerate(nodes):
        if node[0] < node[1]:
            middle, end = k + second_half(node), k + 2 * (node[1] - node[0]) + 1
            found.append(bound_between(*((nodes[part], spheres[part]) for part in (slice(k + 1, middle), slice(middle, end)))))
    return sum(one[0] for one in found), sum(one[1] for one in found), min(one[2] for one in found)


def subjects(data, short):
    """Yields kind, name, centres and radius of each necklace. A short form has those of few beads."""
    necklaces = []
    for dimension, where, sides in ((2, "the plane", (7, 11, 15, 21, 31)), (3, "space", (5, 7, 9))):
        necklaces += [(f"grid in {where}", f"side {side}", "grid", beads_of_grid(dimension, side),
                       {"dimension": dimension, "gap": GAP, "motion": "rest"}) for side in sides]
    necklaces += [("random chain", f"seed {seed}", "random-chain", beads, {"seed": seed, "motion": "rest"})
                  for beads in (64, 128, 256, 512, 1024) for seed in (1, 2)]
    necklaces += [("scaling helix", "", "helix", beads, {"turns": float(SCALING_TURNS * np.sqrt(beads)), "motion": "rest"})
                  for beads in (40, 80, 160, 320, 640)]
    necklaces += [("rolled spiral", "", "spiral", beads, {"turns": SPIRAL_TURNS, "rolled": "1:1"})
                  for beads in (125, 250, 500, 1000)]
    for kind, name, made, beads, options in necklaces:
        if beads <= FEW or not short:
            yield kind, name, model(made, beads, **options), 1
    for file in ("proteins/1l2y", "proteins/2f4k", "paper/villin_hp36_collapse", "proteins/1ejg", "trajectories/random100_400K",
                 "paper/5h73"):
        centers = kds.reading.positions(data / f"{file}.pdb")[0]
        if len(centers) <= FEW or not short:
            yield "protein", Path(file).name, centers, half_longest_bond(centers[None])


def measured(data, short=False):
    """Returns a row for each necklace and hierarchy."""
    rows = []
    for (kind, name, centers, radius), hierarchy in itertools.product(subjects(data, short), ("wrapped", "layered")):
        found, without = (kds.separating_family(centers, radius, hierarchy=hierarchy, rule=rule)[0]
                          for rule in ("more beads", "smallest"))
        bound, attained, margin = bounds(centers, radius, hierarchy)
        row = ", ".join(part for part in (kind, name, f"{len(centers):,} beads", hierarchy) if part)
        rows.append({"row": row, "kind": kind, "beads": len(centers), "hierarchy": hierarchy, "found": found,
                     "without_overlaps": without, "bound": bound, "attained": attained, "margin": float(margin),
                     "bound_by_place": bound_by_place(centers, radius, hierarchy) if len(centers) <= FEW_BY_PLACE else None})
    return rows


def draw(rows, path):
    """Draws family sizes over the number of beads, and what overlaps save."""
    figure, (sizes, savings) = subplots(1, 2, figsize=(10, 4.4))
    for kind, color in zip(dict.fromkeys(row["kind"] for row in rows), COLORS):
        for hierarchy, face in (("wrapped", color), ("layered", "white")):
            of_kind = [row for row in rows if (row["kind"], row["hierarchy"]) == (kind, hierarchy)]
            beads, bound, found, without = (np.array([row[name] for row in of_kind], float)
                                            for name in ("beads", "bound", "found", "without_overlaps"))
            savings.plot(beads, 100 * (without / bound - 1), "o", color=color, markerfacecolor=face, markersize=5)
            if hierarchy == "wrapped":
                sizes.plot(beads, bound, "o", color=color, markersize=5, label=kind)
                sizes.plot(beads, found, "^", color=color, markersize=5, markerfacecolor="white")
    sizes.set(xscale="log", yscale="log", xlabel="beads", ylabel="pairs of spheres, wrapped hierarchy",
              title="smallest of all (dots), found by the search (triangles)")
    savings.set(xscale="log", xlabel="beads", ylabel="excess over the smallest of all (%)",
                title="smallest without overlaps: wrapped (full), layered (open)")
    for axes in (sizes, savings):
        axes.xaxis.set_major_formatter("{x:g}")
        axes.spines[["top", "right"]].set_visible(False)
        axes.title.set_fontsize(10)
    sizes.yaxis.set_major_formatter("{x:g}")
    sizes.legend(frameon=False, fontsize=9)
    figure.tight_layout()
    save(figure, path)


def draw_all(folder):
    draw(measured(HERE.parents[1] / "data"), f"{folder}/families.svg")


def main():
    report = Report(__doc__)
    rows = report.results["rows"] = measured(report.data, report.short)
    report.show(("necklace", "found", "without overlaps", "bound", "family", "found / bound", "without overlaps / bound",
                 "bound by place"), [
        [row["row"], *(row[name] for name in ("found", "without_overlaps", "bound", "attained")), row["found"] / row["bound"],
         f"{row['without_overlaps'] / row['bound']:.4f}", row["bound_by_place"]] for row in rows])
    ordered = [row["bound"] <= row["attained"] and row["bound"] <= row["without_overlaps"] <= row["found"] for row in rows]
    exact = [row["bound"] == row["attained"] for row in rows]
    report.claim("bound", "No family is smaller than the bound", all(ordered), f"{sum(ordered)} of {len(rows)} rows")
    report.claim("exact", "The bound is the size of a family, so it is the smallest size", all(exact),
                 f"{sum(exact)} of {len(rows)} rows")
    report.claim("margin", "No two spheres are within 1e-9 of touching, so rounding decides nothing",
                 min(row["margin"] for row in rows) > 1e-9, f"{min(row['margin'] for row in rows):.1e} at least")
    report.finish()


if __name__ == "__main__":
    main()
