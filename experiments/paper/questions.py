"""Measured answers to open questions of the paper: bounds on motion, trusted bases, diagram and hierarchy together.

  bounds       how many searches for near pairs a bound on speed or displacement saves
  trust        time saved by not checking spheres for some frames, and how far beads then stick out
  combination  whether diagram and hierarchy together examine fewer pairs than the better of the two alone

energy.py has the fourth question, and no theorem is claimed here: figures hold for these chains.
"""

import kds
import kds.reading
import numpy as np
from chains import model, proteins
from common import Report, span
from subjects import half_longest_bond

SKINS = (0.5, 1, 2, 4)  # in radii
FRAMES_TRUSTED = (1, 2, 4, 8, 16, 32)
BLOCKS = (4, 8, 16, 32, 64)


def moves(start, end, without_drift=False):
    """Returns how far each bead has moved, ascending. Without drift, the mean displacement of all beads is subtracted."""
    by = end - start
    return np.sort(np.linalg.norm(by - by.mean(axis=0) if without_drift else by, axis=1))


def speed(frames):
    """Returns the largest displacement of a bead between consecutive frames."""
    return max(moves(*pair)[-1] for pair in zip(frames, frames[1:]))


def searches(count, skin, nearer):
    """Returns how often near pairs are found again after the first frame: when two beads may have come nearer by the skin."""
    repeated = at = 0
    for now in range(1, count):
        if nearer(at, now) > skin:
            repeated, at = repeated + 1, now
    return repeated


def ask_about_bounds(subjects):
    """Which bounds on motion make searches rarer?"""
    for name, frames, radius in subjects:
        fastest = speed(frames)
        bounds = {"speed": lambda at, now, f=fastest: 2 * f * (now - at),
                  "displacement": lambda at, now, x=frames: 2 * moves(x[at], x[now])[-1],
                  "two_largest": lambda at, now, x=frames: sum(moves(x[at], x[now])[-2:]),
                  "without_drift": lambda at, now, x=frames: sum(moves(x[at], x[now], True)[-2:])}
        for skin in SKINS:
            yield {"row": f"bounds, {name}, skin {skin}", "skin": skin, "frames": len(frames),
                   **{bound: searches(len(frames), skin * radius, nearer) for bound, nearer in bounds.items()}}


def beads_out_of_spheres(nodes, spheres, centers, radius):
    """Returns how far beads stick out of the spheres of their nodes, as shares of the spheres' radii."""
    out = [max(0, (np.linalg.norm(centers[first:last + 1] - sphere[:3], axis=1) + radius - sphere[3]).max())
           for (first, last), sphere in zip(nodes, spheres)]
    return out / spheres[:, 3]


def ask_about_trust(subjects, rounds):
    """How much time is saved if bases are trusted for some frames? Bounds on the distance that beads have moved bound how far
    they stick out. Rows have means over all nodes and frames, as shares of the radii."""
    for name, frames, radius in subjects:
        fastest = speed(frames)
        for trusted in FRAMES_TRUSTED:
            rows = []
            for first in range(0, len(frames) - trusted, trusted):
                before, after = frames[first], frames[first + trusted]
                nodes, then = kds.wrapped_hierarchy(before, radius)
                _, now, _ = kds.trusted_hierarchy(before, after, radius)
                # |p - z| - R <= |p - p'| + |p' - z'| + |z' - z| - R <= moved + R' + |z' - z| - R
                excess = (1 + 2**-27) * then[:, 3] + np.linalg.norm(then[:, :3] - now[:, :3], axis=1) - now[:, 3]
                bounds = [np.maximum(0, moved + excess) / now[:, 3] for moved in (fastest * trusted, moves(before, after)[-1])]
                rows.append([np.mean(share) for share in (*bounds, beads_out_of_spheres(nodes, now, after, radius))])
            _, _, times = kds.trusted_hierarchy(frames[0], frames[trusted], radius, rounds=rounds)
            ratios = times[:, 0] / times[:, 1]
            yield {"row": f"trust, {name}, {trusted} frames", "frames_trusted": trusted, "trust_per_verify": np.median(ratios),
                   "least": ratios.min(), "most": ratios.max(),
                   **dict(zip(("by_speed", "by_displacement", "really"), np.mean(rows, axis=0)))}


def search(nodes, spheres, centers, radius, block):
    """The search of the paper's figure 6 for contacts of a chain with itself. Two blocks of at most `block` beads whose spheres
    meet are left to another method if they are farther apart along the chain than a block is long. Returns the number of pairs
    of spheres, and which beads are left."""
    spheres_of = {tuple(beads): sphere for beads, sphere in zip(nodes.tolist(), spheres.tolist())}
    spheres_of.update({(bead, bead): [*center, radius] for bead, center in enumerate(centers.tolist())})
    left, pairs = np.zeros(len(centers), bool), 0

    def halves(node):
        middle = (node[0] + node[1]) // 2
        return (node[0], middle), (middle + 1, node[1])

    waiting = [((0, len(centers) - 1), None)]
    while waiting:
        a, b = waiting.pop()
        if b is None:  # a node with itself
            if a[0] < a[1]:
                one, other = halves(a)
                waiting += [(one, None), (other, None), (one, other)]
            continue
        if b[1] - a[0] < 2:  # neighbours
            continue
        (x, y, z, r), (u, v, w, s) = spheres_of[a], spheres_of[b]
        size, other_size = a[1] - a[0] + 1, b[1] - b[0] + 1
        if (x - u)**2 + (y - v)**2 + (z - w)**2 > (r + s)**2 or size == other_size == 1:
            pairs += 1
        elif max(size, other_size) <= block < b[0] - a[1]:
            left[a[0]:a[1] + 1] = left[b[0]:b[1] + 1] = True
        elif size >= other_size:
            waiting += [(half, b) for half in halves(a)]
        else:
            waiting += [(a, half) for half in halves(b)]
    return pairs, left


def named_by_diagram(centers, radius, left):
    """Returns the numbers of pairs that decide whether these beads collide: edges of their diagram, and pairs with a common
    neighbour. Consecutive beads that are left are neighbours only if they are neighbours in the chain."""
    beads = np.flatnonzero(left)
    if len(beads) < 2:
        return 0, 0
    pieces = [len(piece) for piece in np.split(beads, np.flatnonzero(np.diff(beads) > 1) + 1)]
    _, examined, _ = kds.closest_by_diagram(centers[beads], radius, necklaces=pieces)
    return examined["edges"], examined["common_neighbors"] + examined["centers"] + examined["near"]


def chains_at_rest(data):
    """Returns name, centres and radius of the chains at rest."""
    beads, protein = 1024, kds.reading.positions(data / "paper/1a4y_AB.pdb")
    return [("helix", model("helix", beads, motion="rest"), 1), ("scaling helix", model("scaling-helix", beads, motion="rest"), 1),
            ("random chain, fill 0.02", model("random-chain", beads, fill=0.02, motion="rest"), 1),
            ("random chain, fill 0.2", model("random-chain", beads, fill=0.2, motion="rest"), 1),
            *((name, frames[0], radius) for name, frames, radius in proteins(data)), ("1a4y", protein[0], half_longest_bond(protein))]


def ask_about_combination(chains):
    """Are diagram and hierarchy together better than each alone? The hierarchy is searched down to blocks, and a diagram of the
    beads in blocks that still meet settles the rest."""
    for name, centers, radius in chains:
        nodes, spheres = kds.wrapped_hierarchy(centers, radius)
        hierarchy, _ = search(nodes, spheres, centers, radius, 0)
        diagram = sum(named_by_diagram(centers, radius, np.ones(len(centers), bool)))
        for block in BLOCKS:
            pairs, left = search(nodes, spheres, centers, radius, block)
            edges, others = named_by_diagram(centers, radius, left)
            together = pairs + edges + others
            yield {"row": f"combination, {name}, blocks of {block}", "subject": name, "block": block, "left": 100 * left.mean(), "pairs": pairs,
                   "edges": edges, "others": others, "together": together, "hierarchy": hierarchy, "diagram": diagram,
                   "gain": min(hierarchy, diagram) / together}


def main():
    report = Report(__doc__)
    wandering = kds.generate("random-chain", beads=640, frames=200, seed=1, motion="wander", step=0.01)
    subjects = [*proteins(report.data), ("wandering chain", wandering, 1)]
    for ask in (ask_about_bounds, lambda given: ask_about_trust(given, report.rounds),
                lambda _: ask_about_combination(chains_at_rest(report.data))):
        rows = list(ask(subjects))
        report.show(list(rows[0]), [list(row.values()) for row in rows])
        report.results["rows"] += rows
    answers = report.results["rows"]
    at_one = [row["speed"] / row["without_drift"] for row in answers if row.get("skin") == 1 and row["without_drift"]]
    report.say(f"  Measured displacements repeat searches {span(at_one)} times more rarely than a bound on speed, at a skin of one "
               "radius (chains on which they repeat any).")
    faster = [1 / row["trust_per_verify"] for row in answers if row.get("frames_trusted") == 1]
    report.say(f"  Spheres of trusted bases are {span(faster)} times as fast as verified ones.")
    combined = [row for row in answers if "gain" in row]
    best = [1 / max(row["gain"] for row in combined if row["subject"] == name) for name in {row["subject"] for row in combined}]
    report.say(f"  Together they examine {span(best)} times the pairs of the better of both alone.")
    report.finish()


if __name__ == "__main__":
    main()
