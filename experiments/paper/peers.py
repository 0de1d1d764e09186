"""What a step costs and what it gives, beside the methods that others use: hierarchies, and contacts.

A hierarchy is judged by its excess volume at random times within the steps: the mean over nodes of the volume by that of the
smallest sphere (or axis-aligned box) around the same beads, less 1. Box events keep the smallest boxes. Boxes that are refitted
at frames are blended: on straight paths the box between two frames, corner by corner, holds all beads. Other hierarchies that
are made at frames do not hold their beads between them. Their nodes are inflated by the largest displacement of their beads.
Random times are 20 (18 on dhodh, 2 for 10,000 beads and more).

A contact search is judged by the share of contacts that it misses: those of straight paths during which no examined frame lies.
Radii of contacts are 2.5 times those of the necklace, and pairs are at least 5 apart along the chain.

Times are processor times of all steps together, for inputs that are in memory. Methods take turns, but for the k-d tree of
scipy, which follows. A ratio is the median of the rounds, with the least and the most in parentheses. Work of more than a
second is done once. The default form takes two minutes; --short leaves out chains of 1,000 beads and more. draw() makes the
figure of the results, which needs matplotlib (scripts/pictures).
"""

import time

import kds
import kds.reading
import kds.timing
import numpy as np
from common import Report, save, subplots
from scipy.spatial import cKDTree
from subjects import half_longest_bond

FACTOR, APART, STRIDES = 2.5, 5, (1, 2, 4, 8)
FILES = {"villin": ("villin_hp36_300K.dcd", "villin_hp36_300K.pdb", 992),
         "random100": ("random100_400K_first200.dcd", "random100_400K.pdb", 192),
         "dhodh": ("dhodh363_1000K_first20.dcd", "dhodh363_1000K.pdb", 16),
         "ubiquitin": ("ubiquitin_pull_first30.pdb", None, 24)}
CHAINS = {100: 512, 1000: 64, 10_000: 16, 100_000: 8}  # steps by the number of beads
HIERARCHIES = {"events": "spheres, events", "chords": "spheres, chords", "tight_chords": "spheres, chords within 1%",
               "layered_chords": "layered spheres, blended", "box_events": "boxes, events", "boxes": "boxes, refitted",
               "updated": "spheres, updated", "rebuilt": "spheres, rebuilt", "layered": "layered spheres, rebuilt"}
RUNS = {"events": {"structures": ["wrapped"]}, "chords": {"structures": ["wrapped"], "between": "chord"},
        "tight_chords": {"structures": ["wrapped"], "between": "chord", "tightness": 0.01},
        "layered_chords": {"structures": ["layered"]}}
CONTACTS = {"events": "events", "paths": "cell list and paths", "block_paths": "block tree and paths", "cells": "cell list",
            "verlet": "Verlet list", "blocks": "block tree, rebuilt", "wrapped": "spheres, rebuilt",
            "layered": "layered spheres, rebuilt", "boxes": "boxes, refitted", "kd_tree": "k-d tree of scipy"}


def inputs(data, short):
    """Yields the name, the frames and the radius of each input."""
    for name, (file, topology, steps) in FILES.items():
        frames = kds.reading.positions(data / "trajectories" / file, *([data / "trajectories" / topology] if topology else []))
        yield name, frames[:(16 if short else steps) + 1].astype(float), half_longest_bond(frames)
    for beads, steps in CHAINS.items():
        if beads < 1000 or not short:
            yield f"chain {beads}", kds.generate("random-chain", beads=beads, frames=steps + 1, step=0.1), 1.0


class Nodes:
    """Volumes of a hierarchy's nodes, which are ranges of beads."""

    def __init__(self, nodes):
        self.first, end = nodes[:, 0], nodes[:, 1] + 1
        self.ends = np.stack([self.first, end], axis=1).ravel()
        self.sizes = end - self.first
        self.starts = np.cumsum(self.sizes) - self.sizes
        self.beads = np.arange(self.sizes.sum()) - np.repeat(self.starts - self.first, self.sizes)

    def boxes(self, positions, radius):
        """Returns the low and the high corners of the smallest boxes, an array (2, nodes, 3)."""
        padded = np.concatenate([positions, positions[-1:]])  # reduceat takes no end beyond the array
        low, high = (reduce.reduceat(padded, self.ends)[::2] for reduce in (np.minimum, np.maximum))
        return np.stack([low - radius, high + radius])

    def most(self, values):
        """Returns the largest value of each node. There is one value for each bead of each node."""
        return np.maximum.reduceat(values, self.starts)

    def reach(self, positions, spheres, radius):
        """Returns the distance from a node's centre to the farthest point of its balls."""
        apart = positions[self.beads] - np.repeat(spheres[:, :3], self.sizes, axis=0)
        return np.sqrt(self.most((apart**2).sum(1))) + radius


def volume(boxes):
    return np.prod(boxes[1] - boxes[0], axis=1)


def bounds(frames, radius, count, seed):
    """Returns the mean excess volume of each method; for methods at frames also the share of nodes that a bead has left since
    the frame, and the excess of inflated nodes. box_per_sphere is the volume of the smallest box by that of the sphere."""
    random = np.random.default_rng(seed)
    times = np.sort(random.integers(len(frames) - 1, size=count) + random.integers(1, 1024, size=count) / 1024)
    runs = {name: getattr(kds.run(frames, radius=radius, **options), *options["structures"]) for name, options in RUNS.items()}
    found = {}

    def add(method, column, values):
        found.setdefault(method, {}).setdefault(column, []).append(float(np.mean(values)))

    for at in times:
        step, u = int(at), at % 1
        before, after = frames[step], frames[step + 1]
        here, moved = (1 - u) * before + u * after, np.linalg.norm(after - before, axis=1)
        ranges, smallest = kds.wrapped_hierarchy(here, radius)
        nodes = Nodes(ranges)
        moved = nodes.most(moved[nodes.beads])
        for name, run in runs.items():
            add(name, "excess", (run.spheres(at)[:, 3] / smallest[:, 3])**3 - 1)
        wrapped, layered = kds.wrapped_hierarchy(before, radius)[1], kds.layered_hierarchy(before, radius)[1]
        for names, spheres in ((("updated", "rebuilt"), wrapped), (("layered",), layered)):
            for name in names:
                add(name, "outside", nodes.reach(here, spheres, radius) > spheres[:, 3] * (1 + 1e-9))
                add(name, "inflated", ((spheres[:, 3] + moved) / smallest[:, 3])**3 - 1)
        exact, first, last = (nodes.boxes(positions, radius) for positions in (here, before, after))
        grow = np.array([-moved, moved])[:, :, None]
        add("boxes", "excess", volume((1 - u) * first + u * last) / volume(exact) - 1)
        add("boxes", "outside", ((exact[0] < first[0] - 1e-9) | (exact[1] > first[1] + 1e-9)).any(1))
        add("boxes", "inflated", volume(first + grow) / volume(exact) - 1)
        add("boxes", "box_per_sphere", volume(exact) / (4 / 3 * np.pi * smallest[:, 3]**3))
    return {name: {column: round(float(np.mean(values)), 6) for column, values in columns.items()}
            for name, columns in found.items()}


def missed(begin, end, stride):
    """Returns the share of contacts during which no stride-th frame lies."""
    return float(np.mean(np.ceil(begin / stride) * stride > end)) if len(begin) else None


def seconds_of_scipy(frames, reach, rounds):
    """Returns the seconds that scipy takes to find the pairs of all frames but the first, by round."""
    seconds = []
    while len(seconds) < (rounds if not seconds or seconds[0] < 1 else 1):
        start = time.process_time()
        for frame in frames[1:]:
            cKDTree(frame).query_pairs(reach, output_type="ndarray")
        seconds.append(time.process_time() - start)
    return np.array(seconds)


def timed(name, frames, seconds, methods, at=""):
    """Returns a row for each method: microseconds a step, and the ratio to events. A work's name may have `at` at its end."""
    events, rows = seconds["events"], []
    for work, method in methods.items():
        own = seconds[work + at if work + at in seconds else work]
        ratio = own / (events if len(own) == len(events) else np.median(events))
        rows.append({"row": f"{name}, {work}", "input": name, "beads": frames.shape[1], "method": method,
                     "us": 1e6 * float(np.median(own)) / (len(frames) - 1),
                     "ratio": float(np.median(ratio)), "least": float(ratio.min()), "most": float(ratio.max())})
    return rows


def hierarchies(name, frames, radius, rounds, count, seed=1):
    """Returns the bounds of the hierarchies of one input by their names, and the rows of their times."""
    found, of = kds.timing.hierarchy_steps(frames, radius, rounds=rounds), bounds(frames, radius, count, seed)
    rows = timed(name, frames, found, HIERARCHIES)
    named = {f"{work}_{column}": value for work, columns in of.items() for column, value in columns.items()}
    return named, [{**row, **of.get(work, {})} for work, row in zip(HIERARCHIES, rows)]


def contacts(name, frames, radius, rounds):
    """Returns the counts of one input, and the rows of the methods that find its contacts."""
    radius *= FACTOR
    found = kds.timing.contact_steps(frames, radius, apart=APART, strides=STRIDES, rounds=rounds)
    found["kd_tree_1"] = seconds_of_scipy(frames, 2 * radius, rounds)
    by_events = kds.contacts(frames, cutoff=2 * radius, by="bead", apart=APART, strides=[1]).intervals
    opened, closed = (~by_events[f"open_at_{side}"] for side in ("start", "end"))
    times = by_events["begin_frame"], np.where(closed, by_events["end_frame"], np.inf)
    counts = {"row": name, "pairs": found["pairs"], "begins": found["begins"], "ends": found["ends"],
              "contacts": len(opened), **{f"missed_{stride}": missed(*times, stride) for stride in STRIDES}}
    agree = [found["begins"], found["ends"]] == [int(opened.sum()), int(closed.sum())]
    rows = timed(f"{name}, contacts", frames, found, CONTACTS, "_1")
    for work, row in zip(CONTACTS, rows):
        for stride in STRIDES:
            if f"{work}_{stride}" in found:
                row[f"us_{stride}"] = 1e6 * float(np.median(found[f"{work}_{stride}"])) / (len(frames) - 1)
    return counts, rows, agree


def spread(row):
    return f"{row['ratio']:.3g}" + (f" ({row['least']:.3g} to {row['most']:.3g})" if row["least"] < row["most"] else "")


def percent(value):
    return "" if value is None else f"{100 * value:.3g}%"


def draw(results, path):
    """Draws both fronts for two trajectories, and the times of generated chains against their numbers of beads."""
    figure, every = subplots(2, 3, figsize=(14, 9), width_ratios=(4, 4, 3))
    by_row = {row["row"]: row for row in results["rows"] + results["times"]}
    for line, methods, what, end in zip(every, (HIERARCHIES, CONTACTS), ("hierarchies", "contacts"), ("", ", contacts")):
        for k, (work, method) in enumerate(methods.items()):
            style = {"color": f"C{k}", "marker": "ovs^D<>Pp*"[k], "label": method, "zorder": 10 - k}
            for axes, name in zip(line, ("villin", "dhodh")):
                row, counts = by_row[f"{name}{end}, {work}"], by_row[name]
                at = [stride for stride in STRIDES if f"us_{stride}" in row]
                if at:
                    missing = [100 * counts[f"missed_{stride}"] for stride in at]
                    axes.plot(missing, [row[f"us_{stride}"] for stride in at], **style)
                elif "excess" in row or "inflated" not in row:  # events of boxes and of contacts have no error
                    axes.plot(100 * row.get("excess", 0), row["us"], **style)
                if "inflated" in row:
                    axes.plot(100 * row["inflated"], row["us"], fillstyle="none", **style)
                axes.set(yscale="log", ylabel="microseconds a step", title=f"{what} of {name}, {row['beads']:,} beads",
                         xlabel="contacts missed (%)" if end else "mean excess volume (%); hollow: inflated")
                if not end:
                    axes.set_xscale("symlog", linthresh=0.01)
                    axes.set_xlim(-0.002, 3000)
            chains = [by_row[row] for row in (f"chain {beads}{end}, {work}" for beads in CHAINS) if row in by_row]
            line[2].plot([row["beads"] for row in chains], [1000 * row["us"] / row["beads"] for row in chains], **style)
        line[2].set(xscale="log", yscale="log", xlabel="beads", ylabel="nanoseconds a bead and step", title=f"{what} of chains")
        line[2].legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    figure.tight_layout()
    save(figure, path)


def main():
    report = Report(__doc__)
    of_hierarchies, of_contacts, counts, agree = [], [], [], []
    for name, frames, radius in inputs(report.data, report.short):
        count = 4 if report.short else max(2, min(20, 20_000 // frames.shape[1]))
        bounded, rows = hierarchies(name, frames, radius, report.rounds, count)
        of_hierarchies += rows
        counted, rows, same = contacts(name, frames, radius, report.rounds)
        of_contacts, counts, agree = of_contacts + rows, [*counts, counted], [*agree, same]
        report.results["rows"].append({**counted, **bounded})
    report.show(["hierarchy", "us a step", "by events", "excess", "nodes left", "inflated", "box by sphere"],
                [[f"{row['input']}: {row['method']}", row["us"], spread(row), *(percent(row.get(column))
                  for column in ("excess", "outside", "inflated", "box_per_sphere"))] for row in of_hierarchies])
    report.show(["contacts", "us a step", "by events", *(f"us, every {stride}" for stride in STRIDES[1:])],
                [[f"{row['input']}: {row['method']}", row["us"], spread(row),
                  *(row.get(f"us_{stride}") for stride in STRIDES[1:])] for row in of_contacts])
    report.show(list(counts[0]), [list(row.values()) for row in counts])
    report.results["times"] = of_hierarchies + of_contacts
    report.claim("same contacts", "Events and quadratics find the same numbers of contacts", all(agree),
                 f"{sum(agree)} of {len(agree)} inputs")
    report.finish()


if __name__ == "__main__":
    main()
