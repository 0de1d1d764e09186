"""Figures of the paper that show hierarchies, from data of kds.

  2  wrapped and layered hierarchy of one necklace in the plane
  3  two conformations of a necklace, found by search, between which only the basis of the root changes
  5  the points of Lemma 2.5 and their layered hierarchy

For figure 3, random curvatures are drawn for both conformations, and the chain moves from one to the other. A candidate counts if
the necklace is proper in all frames and if a kinetic run over them has no event but at the root. The one whose distances of
beads change most is drawn. draw_all() writes figure-N.svg, which needs matplotlib (scripts/pictures).
"""

import kds
import numpy as np
from chains import BOND, layered_and_wrapped, model, random_numbers, tightness_points
from common import Report, save, subplots

COLORS = ("#1f2933", "#b3462f", "#c98a1b", "#3b8a5a", "#8fb8de")  # of the levels of a hierarchy; deeper ones have the last
COSINES, STEPS = 4, 20


def levels(nodes):
    """Returns the number of proper ancestors of each node."""
    return [sum(first <= one and last <= end for first, end in nodes) - 1 for one, last in nodes]


def nodes_out_of_parents(nodes, spheres):
    """Counts the nodes whose circle is not inside that of their parent, the smallest node around them."""
    count = 0
    for (first, last), inner in list(zip(nodes, spheres))[1:]:
        around = [(end - start, k) for k, (start, end) in enumerate(nodes)
                  if start <= first and last <= end and end - start > last - first]
        outer = spheres[min(around)[1]]
        count += bool(np.linalg.norm(inner[:3] - outer[:3]) + inner[3] > outer[3] * (1 + 1e-9))
    return count


def panel(figure, name, centers, radius, spheres, note, last_level=9, dark=(), more=()):
    """One panel in numbers, and what is drawn of it: beads, those of them that are dark, and circles with their levels."""
    nodes = kds.wrapped_hierarchy(centers, radius)[0].tolist()
    shown = [(sphere, level) for sphere, level in zip(spheres, levels(nodes)) if level <= last_level]
    row = {"row": f"figure {figure}, {name}", "beads": len(centers), "root_radius": float(spheres[0, 3]),
           "sticking_out": nodes_out_of_parents(nodes, spheres), "note": note}
    return row, (name, centers, radius, set(dark), [*shown, *more])


def bases(centers, radius=1):
    """Returns the bases of all nodes of the wrapped hierarchy as tuples."""
    return [tuple(bead for bead in basis if bead >= 0) for basis in kds.trusted_hierarchy(centers, centers, radius)[0].tolist()]


def beads_of_bases(found, nodes, last_level):
    """Returns the beads in the bases of all nodes down to a level. `found` has the bases of all nodes."""
    return [bead for basis, level in zip(found, levels(nodes.tolist())) if level <= last_level for bead in basis]


def hierarchies():
    """Figure 2."""
    centers = model("spiral", 16, turns=1.25, rolled="1:1")[:, :2]
    nodes, wrapped = kds.wrapped_hierarchy(centers, 1)
    layered, found = kds.layered_hierarchy(centers, 1)[1], bases(centers)
    dark = beads_of_bases(found, nodes, 1)
    of_three = sum(len(basis) == 3 for basis in found)
    return [panel("2", "wrapped", centers, 1, wrapped, f"{of_three} of {len(found)} bases have three beads, the others two", 3, dark),
            panel("2", "layered", centers, 1, layered, f"the root is {layered[0, 3] / wrapped[0, 3]:.3f} times the wrapped one", 3)]


def bent_chain(amplitudes, beads):
    """Returns a chain in the plane whose curvature is a sum of cosines. Amplitudes are in turns of the whole chain."""
    bonds = beads - 1
    b = np.arange(1, beads)
    turns = sum(a / bonds * np.cos(np.pi * k * b / bonds) for k, a in enumerate(amplitudes))
    heading = 2 * np.pi * np.concatenate([[0], np.cumsum(turns)[:-1]])
    steps = BOND * np.stack([np.cos(heading), np.sin(heading)], axis=1)
    return np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])


def deformation(first, last):
    """Returns the root mean square change of the distances of beads by the greatest distance."""
    pairs = np.triu_indices(len(first), 1)
    before, after = (np.linalg.norm(x[pairs[0]] - x[pairs[1]], axis=1) for x in (first, last))
    return float(np.sqrt(np.mean((after - before)**2)) / max(before.max(), after.max()))


def root_changes(frames):
    """Returns how often the root's basis changes over the frames, or None if the candidate does not count."""
    first, last = bases(frames[0]), bases(frames[-1])
    if first[1:] != last[1:] or first[0] == last[0]:
        return None
    in_space = np.pad(frames, ((0, 0), (0, 0), (0, 1)))
    run = kds.run(in_space, radius=1, structures="wrapped")
    only_root = all((beads[:2] == [0, frames.shape[1] - 1]).all() for beads in run.events["beads"])
    return len(run.events) if only_root and kds.conditions(in_space, radius=1).proper else None


def stable_pair(beads, candidates, seed):
    """Returns the frames, the deformation, the number of basis changes and the number of the best candidate, or None."""
    random, best = random_numbers(seed), None
    for k in range(candidates):
        start, end = (np.array([1.5 * (next(random) - 0.5) for _ in range(COSINES)]) for _ in range(2))
        frames = np.array([bent_chain(start + share * (end - start), beads) for share in np.linspace(0, 1, STEPS + 1)])
        change = deformation(frames[0], frames[-1])
        if best and change <= best[1]:
            continue
        changes = root_changes(frames)
        if changes is not None:
            best = frames, change, changes, k
    return best


def stability(beads=32, candidates=2000, seed=1):
    """Figure 3."""
    frames, change, changes, candidate = stable_pair(beads, candidates, seed)
    panels = []
    for name, centers in (("before", frames[0]), ("after", frames[-1])):
        nodes, spheres = kds.wrapped_hierarchy(centers, 1)
        found = bases(centers)
        note = f"the root's basis is {', '.join(map(str, found[0]))}; " + (
            f"candidate {candidate}, distances of beads change by {100 * change:.0f}% of the greatest" if name == "before"
            else f"it changed {changes} times and no other basis did")
        panels.append(panel("3", name, centers, 1, spheres, note, 2, beads_of_bases(found, nodes, 2)))
    return panels


def tightness():
    """Figure 5."""
    points = tightness_points(4)
    layered, wrapped = layered_and_wrapped(points, 0)
    return [panel("5", "layered", points, 0, layered, f"the wrapped root has radius {wrapped[0, 3]:.3f}",
                  more=[(wrapped[0], len(COLORS) - 1)])]


def draw(panels, path):
    """Draws panels side by side, in one scale."""
    from matplotlib.patches import Circle

    half = max(sphere[3] for *_, circles in panels for sphere, _ in circles) * 1.05
    figure, every = subplots(1, len(panels), figsize=(4 * len(panels), 4.2), squeeze=False)
    for axes, (name, centers, radius, dark, circles) in zip(every[0], panels):
        middle = circles[0][0]
        axes.set(title=name, aspect="equal", xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half))
        axes.axis("off")
        if radius > 0:
            axes.plot(*centers.T, color="#9aa5b1", linewidth=0.8)
        for bead, center in enumerate(centers):
            is_dark = bead in dark or radius == 0
            axes.add_patch(Circle(center, radius or 0.02 * half, facecolor="#2f6ea5" if is_dark else "#dbe7f3",
                                  edgecolor="#1d4a73", linewidth=0.6))
        for sphere, level in circles:
            axes.add_patch(Circle(sphere[:2], sphere[3], fill=False, edgecolor=COLORS[min(level, len(COLORS) - 1)]))
    figure.tight_layout()
    save(figure, path)


FIGURES = {"2": hierarchies, "3": stability, "5": tightness}


def draw_all(folder):
    for name, make in FIGURES.items():
        draw([drawn for _, drawn in make()], f"{folder}/figure-{name}.svg")


def main():
    report = Report(__doc__)
    for name, make in FIGURES.items():
        report.results["rows"] += [row for row, _ in make()]
    report.show(list(report.results["rows"][0]), [list(row.values()) for row in report.results["rows"]])
    report.finish()


if __name__ == "__main__":
    main()
