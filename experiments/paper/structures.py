"""Structures for collision detection of one chain, counted alike.

All hierarchies have the same balanced tree over the chain and the same search (volumes.py): pairs of beads at least 2 apart,
the two halves of each node first, and then the larger volume is split. Diagrams are searched along their edges. Columns:

  events        changes of a kinetic structure a picosecond, exact on straight paths between frames. Those of the dual complex
                include the flips of its power diagram, and those of the spanner the changes of levels within it. Layered
                spheres and oriented boxes have no events: all nodes are computed anew at each frame, and these refits are
                counted instead.
  certificates  at once at most in the first two steps, without those that slack leaves out (kernel exact)
  family        pairs of disjoint volumes that a search finds, mean over five frames
  pairs         pairs of nodes or beads that a search compares, mean over five frames

Events, family and pairs of structures that depend on the axes are means over ten random rotations, with Student's 95% interval
(fits.py). For the others the counts in all rotations must be equal: events of the first four steps at the largest radius, and
pairs in the first frame at all radii. The default form takes three minutes on 2 cores.
"""

import functools

import kds
import kds.reading
import numpy as np
from common import Report, save, subplots
from fits import mean_interval
from scipy.spatial.transform import Rotation
from subjects import half_longest_bond
from volumes import OrientedBoxes, Slabs, Spheres, Tree, layered_states, search, search_along, search_spanner

INPUTS = {"villin": ("villin_hp36_300K.dcd", "villin_hp36_300K.pdb", 0.02),
          "random100": ("random100_400K_first200.dcd", "random100_400K.pdb", 0.02),
          "dhodh": ("dhodh363_1000K_first20.dcd", "dhodh363_1000K.pdb", 0.1),
          "ubiquitin": ("ubiquitin_pull_first30.pdb", None, 0.5)}
RADII = 1.3, 1.9, 3.0  # after the radius at which consecutive beads touch
SLABS = {"boxes": 3, "14-DOPs": 7, "26-DOPs": 13}
STYLES = {"wrapped": ("#2f6ea5", "o"), "layered": ("#8fb8de", "o"), "boxes": ("#b3462f", "s"), "14-DOPs": ("#c98a1b", "p"),
          "26-DOPs": ("#7a5c1e", "h"), "oriented boxes": ("#9aa5b1", "D"), "tight oriented boxes": ("#52606d", "D"),
          "power": ("#3b8a5a", "^"), "dual": ("#1f2933", "v"), "spanner": ("#a23b72", "P")}
REFITTED = "layered", "oriented boxes", "tight oriented boxes"
CLAIMS = {"same_pairs": "All searches find the pairs that kds.colliding_pairs finds",
          "same_turned": "Counts of all but boxes and k-DOPs are equal in all rotations (events: at the largest radius)",
          "same_events": "Events of wrapped and power do not depend on the radius"}


def slab_counts(frames, measure="events", **options):
    """Returns the events or certificates of boxes and k-DOPs."""
    return {name: counts(kds.run(frames, structures="boxes", directions=k, **options), measure)["boxes"]
            for name, k in SLABS.items()}


def counts(run, measure="events"):
    """Returns the number of all events, internal ones too, or the most certificates at once, of each structure of a run."""
    found = {name: sum(one["events"].values()) - one["events"]["total"] if measure == "events" else one["certificates"]["peak"]
             for name, one in run.summary["structures"].items()}
    if "dual" in found:
        found["dual"] += found["power"]
    return found


def other_counts(frames, measure="events", **options):
    """Returns the events or certificates of kinetic structures that do not depend on the axes."""
    spanner = kds.run(frames, structures="spanner", **options)
    return counts(kds.run(frames, structures=["wrapped", "power", "dual"], **options), measure) | counts(spanner, measure)


@functools.cache
def spanner_elements(positions, beads):
    """Returns the edges and centres of the spanner at one frame, whose positions are given as bytes. Radii do not enter."""
    frame = np.frombuffer(positions).reshape(1, beads, 3)
    return kds.run(frame.repeat(2, axis=0), radius=1, structures="spanner").spanner.elements(0)


def slab_searches(tree, positions, radius):
    """Returns family, compared pairs and pairs that meet of boxes and k-DOPs."""
    return {name: search(tree, Slabs(tree, positions, radius, k), positions, radius) for name, k in SLABS.items()}


def other_searches(tree, positions, radius):
    """Returns the same of structures that do not depend on the axes; diagrams and the spanner have no family."""
    trees = {"wrapped": Spheres(kds.wrapped_hierarchy, positions, radius),
             "layered": Spheres(kds.layered_hierarchy, positions, radius),
             "oriented boxes": OrientedBoxes(tree, positions, radius),
             "tight oriented boxes": OrientedBoxes(tree, positions, radius, tight=True)}
    found = {name: search(tree, volumes, positions, radius) for name, volumes in trees.items()}
    simplices = kds.run(positions[None].repeat(2, axis=0), radius=radius, structures="dual").dual.elements(0)
    edges = {"power": kds.power_diagram(positions, radius)[0],
             "dual": simplices[(simplices[:, 1] >= 0) & (simplices[:, 2] < 0), :2]}
    spanner = search_spanner(spanner_elements(positions.tobytes(), len(positions)), positions, radius)
    return found | {name: (None, *search_along(pairs, positions, radius)) for name, pairs in edges.items()} | {
        "spanner": (None, *spanner)}


def count_all(frames, spacing, radii, turns, at):
    """Counts all structures on one trajectory. `turns` are rotations, and `at` the frames of searches. Returns its rows, the
    verdict on each claim, and how often a node of the layered hierarchy changes which child holds the other at a frame."""
    frames, tree = np.ascontiguousarray(frames), Tree(frames.shape[1])
    turned = [np.ascontiguousarray(frames @ turn.T) for turn in turns]
    beads, steps, time = tree.beads, len(frames) - 1, spacing * (len(frames) - 1)
    rows, holds = [], dict.fromkeys(CLAIMS, True)

    def searches(frames, radius, kinds):
        """Returns family and compared pairs of each structure, means over frames. Checks that the pairs that meet are right."""
        found = []
        for positions in frames:
            one = {name: result for kind in kinds for name, result in kind(tree, positions, radius).items()}
            meeting = kds.colliding_pairs(positions, radius)
            holds["same_pairs"] &= all(np.array_equal(pairs, meeting) for _, _, pairs in one.values())
            found.append({name: (family, compared) for name, (family, compared, _) in one.items()})
        return {name: [None if values[0] is None else float(np.mean(values)) for values in zip(*(one[name] for one in found))]
                for name in found[0]}

    slab_events = [slab_counts(one, radius=1) for one in turned]
    slab_certificates = slab_counts(frames[:3], "certificates", radius=1, kernel="exact")
    events = slab_counts(frames, radius=1) | other_counts(frames, radius=radii[0])
    for radius in radii:
        if radius != radii[0]:
            again = counts(kds.run(frames, radius=radius, structures=["wrapped", "power", "dual"]))
            holds["same_events"] &= all(again[name] == events[name] for name in ("wrapped", "power"))
            events |= again
        certificates = slab_certificates | other_counts(frames[:3], "certificates", radius=radius, kernel="exact")
        first = searches(frames[:1], radius, (other_searches,))
        holds["same_turned"] &= all(searches(one[:1], radius, (other_searches,)) == first for one in turned)
        slabs = [searches(one[at], radius, (slab_searches,)) for one in turned]
        for name, (family, compared) in searches(frames[at], radius, (slab_searches, other_searches)).items():
            total = (beads - 1) * steps if name in REFITTED else events[name]
            row = {"structure": name, "beads": beads, "radius": radius, "events": total, "events_per_ps": total / time,
                   "certificates": certificates.get(name), "family": family, "pairs": compared}
            if name in SLABS:
                for column, values in (("events_per_ps", [one[name] / time for one in slab_events]),
                                       ("family", [one[name][0] for one in slabs]),
                                       ("pairs", [one[name][1] for one in slabs])):
                    row[column + "_turned"], row[column + "_lower"], row[column + "_upper"] = mean_interval(values)
            rows.append(row)
    few = other_counts(frames[:5], radius=radii[-1])
    holds["same_turned"] &= all(other_counts(one[:5], radius=radii[-1]) == few for one in turned)
    states = np.array([layered_states(tree, positions) for positions in frames])
    return rows, holds, int((states[1:] != states[:-1]).sum())


def mean(row, column):
    """Returns the mean over rotations if the column depends on them."""
    return row.get(column + "_turned", row[column])


def draw(found, path):
    """Draws events against compared pairs, both by bead: a line for each structure with a mark for each radius, ascending."""
    from matplotlib import ticker

    figure, every = subplots(2, 2, figsize=(9, 8), sharex=True)
    for axes, (name, (counted, *_)) in zip(every.flat, found.items()):
        for structure, (color, mark) in STYLES.items():
            rows = [row for row in counted if row["structure"] == structure]
            refits = structure in REFITTED
            axes.plot([mean(row, "pairs") / row["beads"] for row in rows],
                      [mean(row, "events_per_ps") / row["beads"] for row in rows], color=color, marker=mark, markersize=6,
                      fillstyle="none" if refits else "full", linestyle=":" if refits else "-", label=structure)
        axes.set(xscale="log", yscale="log", title=name)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
            axis.set_minor_locator(ticker.NullLocator())
            axis.set_major_formatter("{x:g}")
        axes.grid(color="#e4e7eb", linewidth=0.6)
    for axes in every[:, 0]:
        axes.set_ylabel("events (filled) or refits (hollow) / bead / ps")
    for axes in every[1]:
        axes.set_xlabel("compared pairs / bead")
    figure.legend(*every[0, 0].get_legend_handles_labels(), loc="lower center", ncols=5, frameon=False)
    figure.tight_layout(rect=(0, 0.06, 1, 1))
    save(figure, path)


def measure(data, short):
    """Returns by the name of a trajectory what count_all returns."""
    found, turns = {}, Rotation.random(2 if short else 10, random_state=1).as_matrix()
    for name, (file, topology, spacing) in list(INPUTS.items())[: 1 if short else None]:
        files = data / "trajectories"
        frames = kds.reading.positions(files / file, files / topology if topology else None)[: 20 if short else None]
        radii = [half_longest_bond(frames), *(RADII[1:2] if short else RADII)]
        at = [0] if short else np.linspace(0, len(frames) - 1, 5).astype(int)
        found[name] = count_all(np.array(frames, float), spacing, radii, turns, at)
    return found


def main():
    report = Report(__doc__)
    found = measure(report.data, report.short)
    report.results["rows"] = [{"row": f"{name}, radius {row['radius']:.3g}, {row['structure']}", **row}
                              for name, (rows, *_) in found.items() for row in rows]
    columns = "events_per_ps", "family", "pairs"
    report.show(["radius in angstrom", "events / ps", "family", "pairs", "events / ps bead", "certificates", "pairs / bead"],
                [[row["row"], *(mean(row, column) for column in columns), mean(row, "events_per_ps") / row["beads"],
                  row["certificates"], mean(row, "pairs") / row["beads"]] for row in report.results["rows"]])
    report.show(["in random rotations", *(f"{column} {end}" for column in columns for end in ("from", "to"))],
                [[row["row"], *(row[f"{column}_{end}"] for column in columns for end in ("lower", "upper"))]
                 for row in report.results["rows"] if row["structure"] in SLABS])
    for claim, words in CLAIMS.items():
        report.claim(claim, words, all(holds[claim] for _, holds, _ in found.values()), f"{len(found)} trajectories")
    changes = {name: changed for name, (_, _, changed) in found.items()}
    report.results["rows"] += [{"row": f"{name}, layered nodes", "changes": count} for name, count in changes.items()]
    report.say("  Changes of layered nodes at frames: " + ", ".join(f"{name} {count}" for name, count in changes.items()) + ".")
    report.finish()


if __name__ == "__main__":
    main()
