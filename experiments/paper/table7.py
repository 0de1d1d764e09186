"""Table 7: collision between two rolling spirals.

Two equal chains of 1000 beads lie in parallel planes, one above the other, and roll up in 1000 steps to spirals of 18 turns. Each
time is that of bringing the hierarchy from the step before and searching it: layered builds all cages anew, full verifies all
nodes by the cascade (the mean of the step and of the step back), and lazy computes only the cages that the search visits.
"""

import kds.timing
from common import span
from paper_table import PaperTable
from subjects import two_spirals

table = PaperTable(7, __doc__, times=["layered_ms", "lazy_ms", "full_ms"],
                   ratios={"lazy_per_full": ("lazy_ms", "full_ms"), "layered_per_full": ("layered_ms", "full_ms"),
                           "layered_per_lazy": ("layered_ms", "lazy_ms")},
                   counts=["layered_pairs", "wrapped_pairs", "frontier"])
for row in table.rows:
    step = int(row["at"].split()[1])
    found = kds.timing.updates_between(two_spirals(step - 1), two_spirals(step), 1000, rounds=table.rounds)
    table.measured(row, layered_ms=found["layered"], lazy_ms=found["lazy"], full_ms=found["full"],
                   layered_pairs=found["layered_pairs"], wrapped_pairs=found["wrapped_pairs"], frontier=found["frontier"])
table.print_rows()

far = table["layered_per_lazy"][table["wrapped_pairs"] < 10]
near, full = table["layered_per_lazy"][-1], table["layered_per_full"]
fewer = table["wrapped_pairs"] <= table["layered_pairs"]
table.claim("lazy-far", "Where curves are far apart, lazy updates are up to 200 times as fast as the layered hierarchy, say 100 "
            "times or more", far.max() >= 100, f"{span(far)} times")
table.claim("lazy-near", "Where curves almost touch, the advantage is gone, within a factor of two", near <= 2,
            f"{near:.3g} times as fast")
table.claim("wrapped-sets-smaller", "Wrapped sets are no larger than layered ones", fewer.all(),
            f"{fewer.sum()} of {len(fewer)} rows")
table.claim("layered-anew", "Building the layered hierarchy anew is faster than updating the whole wrapped one", full.max() < 1,
            f"{span(full)} times the time")
table.claim("frontier", "The average frontier is below 10", table["frontier"].max() < 10, span(table["frontier"]))
table.finish()
