"""How do events, certificates, times and separating families grow with the number of beads?

Measures random chains of several sizes that wander, several seeds of each, and fits the growth of each quantity: the slope of the
line through the logarithms, the slope between the two largest sizes, the exponent beside lower-order terms, and the law with the
least AICc. Quantities of structures are those of kds.compare; those of the first frame are those of theorems.py. No theorem is
claimed: exponents and laws hold for these chains and sizes.
"""

import fits
import kds
from chains import layered_and_wrapped
from common import Report

SIZES = (64, 128, 256, 512, 1024, 2048)
SEEDS, STEPS = (1, 2), 10
OF_STRUCTURES = ("events_per_step", "net_changes_per_step", "events_per_net_change", "efficiency", "compactness", "locality",
                 "created_per_event", "touched_per_event", "touched_most", "responsiveness", "seconds_per_step")
TIMES = ("responsiveness", "seconds_per_step")  # the only quantities that are no counts
FAMILY_TERMS, SURFACE = [(1, 0), (0, 0)], [(2 / 3, 0)]  # lower-order terms; others have a constant
LOWER = {"wrapped_family": FAMILY_TERMS, "layered_family": FAMILY_TERMS, "pairs_looked_at": SURFACE}


def of_first_frame(centers):
    """Yields the quantities of a chain at rest."""
    for hierarchy in ("wrapped", "layered"):
        yield f"{hierarchy}_family", kds.separating_family(centers, 1, hierarchy=hierarchy)[0]
    yield "pairs_looked_at", sum(kds.closest_by_diagram(centers, 1)[1].values())
    layered, wrapped = (spheres[0, 3] for spheres in layered_and_wrapped(centers, 1))
    yield "root_ratio", float(layered / wrapped)


def measure(beads, seed):
    """Yields subject, quantity and value for one chain."""
    frames = kds.generate("random-chain", beads=beads, frames=STEPS + 1, seed=seed)
    for quantity, value in of_first_frame(frames[0]):
        yield "first frame", quantity, value
    for row in kds.compare(frames, radius=1, structures=["wrapped", "power"], rounds=1, threads=1).json["rows"]:
        changes = row["net_changes"]
        row.update(net_changes_per_step=None if changes is None else changes / STEPS, seconds_per_step=row["seconds"] / STEPS)
        for quantity in OF_STRUCTURES:
            if row[quantity] is not None:
                yield row["structure"], quantity, row[quantity]


def main():
    report, found = Report(__doc__), {}
    for beads in SIZES[:4] if report.short else SIZES:
        for seed in SEEDS:
            for subject, quantity, value in measure(beads, seed):
                found.setdefault((subject, quantity), {}).setdefault(beads, []).append(value)
                if quantity not in TIMES:
                    report.results["rows"].append({"row": f"{subject}, {quantity}, {beads} beads, seed {seed}", "value": value})
    report.show(("subject", "mean", "n", "value", "95% from", "to"), [
        (*key, beads, *fits.mean_interval(values)) for key, sizes in found.items() for beads, values in sizes.items()])
    growth = []
    for (subject, quantity), sizes in found.items():
        points = [(beads, value) for beads, values in sizes.items() for value in values]
        law = fits.growth(points, LOWER.get(quantity, [(0, 0)]))
        if law["line"] is not None:
            growth.append({"subject": subject, "measure": quantity, **law})
    report.show(("subject", "growth", "line", "last", "beside lower terms", "law", "within", "predicts the last"),
                [list(row.values()) for row in growth])
    report.results["fits"] = growth
    report.finish()


if __name__ == "__main__":
    main()
