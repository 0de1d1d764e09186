"""What does the gap between two rolling spirals do to the figures of table 7?

Two equal spirals of 1000 beads are extended, half rolled or rolled up to 18 turns (steps 1, 500 and 1000 of table 7). The
second one is moved until its beads are nowhere nearer than a gap. Gaps are from surface to surface, in radii of a bead. The
poses are in one plane (beside each other), stacked (in parallel planes, one above the other), both with the second spiral
turned in its plane by ten random angles, and ten random poses: a uniform rotation of the second spiral and a uniform direction
from the first to the second. Sets are the pairs of spheres that separate the centres of the two. Times are those of table 7,
each with its search: the layered hierarchy anew, and lazy updates of the wrapped one. Clocks read batches of calls, so their
reading takes less than a hundredth of a time.
"""

import itertools

import kds.timing
import numpy as np
from chains import random_numbers
from common import Report, read_csv, save, shown, span, subplots
from scipy.spatial.transform import Rotation
from subjects import two_spirals

STAGES = {"extended": 1, "half rolled": 500, "rolled": 1000}
KINDS = "in one plane", "stacked", "turned in one plane", "turned and stacked", "random"
SEEDS, SEEDS_SHORT = range(1, 11), range(1, 3)  # of random poses
GAPS, GAPS_SHORT = (0, *(2**(k / 3) for k in range(37))), (0, 8, 64, 512)
SHOWN = 0, 8, 32, 128, 512  # gaps of the table
SETS = "layered_pairs", "wrapped_pairs"
FITS = 0.2  # the largest deviation of a set that fits the paper's
COLORS = {"in one plane": "#2f6ea5", "stacked": "#b3462f", "random": "#3b8a5a"}  # of kinds that are drawn


def pose(kind, seed):
    """Returns a rotation of the second spiral and the direction to it from the first one."""
    part, first, second, height, turn = itertools.islice(random_numbers(seed), 5)
    a, b, c = 2 * np.pi * np.array([first, second, turn])
    if kind == "random":
        inner, outer, height = np.sqrt(1 - part), np.sqrt(part), 2 * height - 1
        rotation = Rotation.from_quat([inner * np.sin(a), inner * np.cos(a), outer * np.sin(b), outer * np.cos(b)])
        return rotation.as_matrix(), np.array([*(np.sqrt(1 - height**2) * np.array([np.cos(c), np.sin(c)])), height])
    turned = kind.startswith("turned")
    ways = {"in one plane": (0, 1, 0), "turned in one plane": (np.cos(c), np.sin(c), 0)}
    return Rotation.from_rotvec([0, 0, turned * a]).as_matrix(), np.array(ways.get(kind, (0, 0, 1)))


def shifts(still, moved, way, gaps):
    """Returns for each gap the last shift along `way` at which two beads of radius 1 are that far apart. Some two must be."""
    between = still[:, None] - moved[None]
    along = between @ way
    across = (between**2).sum(axis=2) - along**2
    return [(along + np.sqrt(np.maximum((2 + gap)**2 - across, 0)))[across <= (2 + gap)**2].max() for gap in gaps]


def measured(gaps, seeds, rounds, beads=1000):
    """Returns a row for each stage, pose and gap."""
    poses = [(kind, seed) for kind in KINDS for seed in (seeds if kind not in KINDS[:2] else seeds[:1])]
    rows = []
    for (stage, step), (kind, seed) in itertools.product(STAGES.items(), poses):
        rotation, way = pose(kind, seed)
        first = [points - points.mean(axis=0) for points in (two_spirals(at, beads)[:beads] for at in (step - 1, step))]
        second = [points @ rotation.T for points in first]
        for gap, shift in zip(gaps, shifts(first[1], second[1], way, gaps)):
            before, after = (np.concatenate([one, other + shift * way]) for one, other in zip(first, second))
            found = kds.timing.updates_between(before, after, beads, rounds=rounds)
            ratios = found.pop("layered") / found.pop("lazy")
            name = kind if kind in KINDS[:2] else f"{kind} {seed}"
            rows.append({"row": f"{stage}, {name}, gap {gap:.4g}", "stage": stage, "kind": kind, "pose": name,
                         "gap": float(gap), "layered_per_lazy": float(np.median(ratios)),
                         **{name: found[name] for name in (*SETS, "frontier")}})
    return rows


def off(row, paper):
    """Returns the larger deviation of both sets from the paper's, ours / paper - 1."""
    return max(abs(row[name] / paper[name] - 1) for name in SETS)


def nearest(rows, paper, kind):
    """Returns the row of a kind of pose whose sets are nearest to the paper's."""
    return min((row for row in rows if row["kind"] == kind), key=lambda row: off(row, paper))


def poses_that_fit(rows, papers, kind):
    """Returns for each rolled pose of a kind whether its sets fit all rows of the paper, each at a gap of its own."""
    poses = {}
    for row in rows:
        if row["stage"] == "rolled" and row["kind"] == kind:
            poses.setdefault(row["pose"], []).append(row)
    return [all(min(off(row, paper) for row in of_pose) <= FITS for paper in papers) for of_pose in poses.values()]


def over_poses(rows, stage, kind, gap, name):
    return [row[name] for row in rows if (row["stage"], row["kind"], row["gap"]) == (stage, kind, gap)]


def draw(rows, papers, path):
    """Draws the ratio of times and the sets over the gap, extended above and rolled below, with the paper's figures."""
    figure, every = subplots(2, 2, figsize=(11, 8), sharex=True)
    gaps = sorted({row["gap"] for row in rows})
    for (ratio, sets), stage in zip(every, ("extended", "rolled")):
        for kind, color in COLORS.items():
            for axes, name, line in ((ratio, "layered_per_lazy", "-"), (sets, SETS[1], "-"), (sets, SETS[0], "--")):
                found = np.array([over_poses(rows, stage, kind, gap, name) for gap in gaps])
                label = f"{kind} (median and range of ten)" if kind == "random" else kind
                axes.plot(gaps, np.median(found, axis=1), line, color=color, label=label)
                if kind == "random" and line == "-":
                    axes.fill_between(gaps, found.min(axis=1), found.max(axis=1), color=color, alpha=0.15, linewidth=0)
        for paper in (one for one in papers if (one["wrapped_pairs"] > 100) == (stage == "rolled")):
            for kind, color in COLORS.items():
                row = nearest(rows, paper, kind)
                if off(row, paper) > FITS or row["stage"] != stage:
                    continue
                star = {"marker": "*", "color": color, "markersize": 11, "markeredgecolor": "white"}
                ratio.plot(row["gap"], paper["layered_ms"] / paper["lazy_ms"], **star)
                for name in SETS:
                    sets.plot(row["gap"], paper[name], **star)
        ratio.axhline(1, color="#9aa5b1", linewidth=0.8)
        ratio.set(ylabel="time of layered / lazy", title=f"{stage}: ratio of times")
        sets.set(ylabel="pairs of spheres", title=f"{stage}: sets, wrapped (full) and layered (dashed)")
        for axes in (ratio, sets):
            axes.set(xscale="symlog", yscale="log", xlim=(0, max(gaps)))
            axes.xaxis.set_major_formatter("{x:g}")
            axes.yaxis.set_major_formatter("{x:g}")
            axes.spines[["top", "right"]].set_visible(False)
    for axes in every[1]:
        axes.set_xlabel("gap between the spirals (radii of a bead)")
    every[0][0].plot([], [], "*", color="#1f2933", markersize=11, label="the paper, at the gap whose sets are nearest")
    every[0][0].legend(frameon=False, fontsize=9, bbox_to_anchor=(0, 0.86), loc="upper left")
    figure.tight_layout()
    save(figure, path)


def of_paper():
    return [row for row in read_csv("table7.csv") if row["layered_pairs"]]


def draw_all(folder):
    draw(measured(GAPS, SEEDS, 5), of_paper(), f"{folder}/spirals.svg")


def main():
    report = Report(__doc__)
    gaps, seeds = (GAPS_SHORT, SEEDS_SHORT) if report.short else (GAPS, SEEDS)
    rows = report.results["rows"] = measured(gaps, seeds, report.rounds)

    def cell(*place):
        found = over_poses(rows, *place)
        return shown(np.median(found)) + (f" ({span(found)})" if len(found) > 1 else "")

    report.show(("stage and pose", "gap", "layered / lazy", "layered set", "wrapped set"), [
        (f"{stage}, {kind}", gap, *(cell(stage, kind, gap, name) for name in ("layered_per_lazy", *SETS)))
        for stage in STAGES for kind in KINDS for gap in SHOWN if gap in gaps])
    report.say("Rows of table 7, and where they lie: the gap at which the larger deviation of both sets is least")
    fits = [(paper, kind, nearest(rows, paper, kind)) for paper in of_paper() for kind in KINDS]
    report.show(("paper", "layered set", "wrapped set", "layered / lazy", "nearest", "layered set", "wrapped set", "off",
                 "layered / lazy"), [
        (paper["at"], *(paper[name] for name in SETS), paper["layered_ms"] / paper["lazy_ms"], row["row"],
         *(row[name] for name in SETS), f"{100 * off(row, paper):.0f}%", row["layered_per_lazy"]) for paper, _, row in fits])
    report.results["nearest"] = [{"at": paper["at"], "kind": kind, "row": row["row"], "off": off(row, paper)}
                                 for paper, kind, row in fits]
    rolled = [paper for paper in of_paper() if paper["wrapped_pairs"] > 100]
    fitting = {kind: poses_that_fit(rows, rolled, kind) for kind in KINDS}
    report.claim("planes", f"Rolled spirals in one plane do not fit steps 995 and 1000 within {FITS:.0%}",
                 not any(fitting["in one plane"] + fitting["turned in one plane"]),
                 "; ".join(f"{kind}: {sum(fits)} of {len(fits)} poses fit" for kind, fits in fitting.items()))
    near, apart = ([row["layered_per_lazy"] for row in rows if suits(row["wrapped_pairs"])]
                   for suits in (lambda pairs: pairs >= 1000, lambda pairs: pairs == 1))
    report.claim("gain-gone", "Lazy updates are no faster where 1,000 wrapped pairs or more are needed", max(near) <= 1,
                 f"{span(near)} times")
    report.claim("gain", "Lazy updates are 40 times as fast or more where one wrapped pair suffices", min(apart) >= 40,
                 f"{span(apart)} times")
    report.finish()


if __name__ == "__main__":
    main()
