"""Table 1: construction, and how tight cages are.

Each structure is built from nothing. The paper built the wrapped hierarchy by CGAL's smallest sphere of each node's beads, as
cgal_ms does. wrapped_ms is kds's own build, which starts a node with the bases of its children. Rho is the radius of a node's
wrapped cage divided by that of its layered cage, over internal nodes.
"""

import kds.timing
import numpy as np
from common import span
from paper_table import PaperTable, is_protein
from subjects import planar, subject

table = PaperTable(1, __doc__, times=["wrapped_ms", "cgal_ms", "layered_ms", "power_ms"],
                   ratios={"layered_per_wrapped": ("layered_ms", "wrapped_ms"), "power_per_cgal": ("power_ms", "cgal_ms")},
                   counts=["rho_avg", "rho_min"])
for row in table.rows:
    points, _ = subject(row, table.data)
    found = kds.timing.builds(planar(points), rounds=table.rounds)
    table.measured(row, wrapped_ms=found["wrapped"], cgal_ms=found["wrapped_by_cgal"], layered_ms=found["layered"],
                   power_ms=found["power"], rho_avg=found["rho_avg"], rho_min=found["rho_min"])
table.print_rows()

rho, layered, dearer = table["rho_avg"], table["layered_per_wrapped"], table["power_ms"] / table["wrapped_ms"]
proteins, beads = table.where(is_protein), np.array([row["beads"] for row in table.rows])
others = ~proteins & (beads >= 50)
table.claim("cages-alike", "Cages of the two hierarchies are alike within 5% on average", rho.mean() >= 0.95,
            f"{rho.mean():.3f} over all rows, {span(rho)} by row; {(rho >= 0.95).sum()} of {len(rho)} rows within 5%")
table.claim("cages-half", "Some wrapped cages are half as large as the layered ones", table["rho_min"].min() < 0.6,
            f"least rho {table['rho_min'].min():.3f}")
table.claim("cages-of-proteins", "Among rows of 50 beads or more, cages differ most in a protein",
            rho[proteins].min() < rho[others].min(),
            f"average rho {rho[proteins].min():.3f} in a protein, at least {rho[others].min():.3f} in others")
table.claim("layered-cheapest", "The layered hierarchy is the cheapest to build", layered.max() < 1,
            f"{span(layered)} times the wrapped one's time")
table.claim("diagram-dearest", "The power diagram is the dearest to build", dearer.min() > 1,
            f"{span(dearer)} times the wrapped hierarchy's time")


def per_n_log_n(name, rows):
    return table[name][rows] / (beads * np.log2(beads))[rows]


if not table.short:
    sampled = table.where(lambda row: row["model"] == "static helix" and row["beads"] >= 640)
    ours, cgal = [times[-1] / times[0] for times in (per_n_log_n("wrapped_ms", sampled), per_n_log_n("cgal_ms", sampled))]
    table.claim("n-log-n", "From 640 to 10,240 beads, the time to build the wrapped hierarchy grows no faster than n log n",
                max(ours, cgal) <= 1.1,
                f"{ours:.2f} times the growth of n log n for kds, {cgal:.2f} for CGAL, 0.77 in the paper")
alike = (beads >= 1000) & (beads <= 1400)
ours, cgal = [np.ptp(np.log(per_n_log_n(name, alike))) for name in ("wrapped_ms", "cgal_ms")]
table.claim("shape", "The time depends very little on the shape: for 1,000 to 1,400 beads, time / (n log n) agrees within a "
            "factor of 1.5", max(ours, cgal) <= np.log(1.5),
            f"it varies {np.exp(ours):.2f} times for kds, {np.exp(cgal):.2f} times for CGAL, 1.36 times in the paper")
table.finish()
