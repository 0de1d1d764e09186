"""Table 2: verifying the wrapped hierarchy.

Each model is at rest. Lazy computes the spheres of the old bases. Naive also tests each bead of each node, one by one. The
cascade tests cages first and starts from its last frontier. Tests count beads and cages. The frontier of a node holds the cages
and beads that the cascade found inside its sphere; it is averaged over all nodes, beads included.
"""

from common import span
from paper_table import PaperTable
from subjects import subject
from updates import RATIOS, TIMES, most_cheaper, updated

table = PaperTable(2, __doc__, times=TIMES, ratios=RATIOS, counts=["cascade_tests_per_naive", "frontier"])
for row in table.rows:
    points, _ = subject(row, table.data)
    table.measured(row, **updated(points, points, table.rounds))
table.print_rows()

frontier, tests, cascade = table["frontier"], table["cascade_tests_per_naive"], table["cascade_per_naive"]
spline = cascade[table.where(lambda row: row["model"] == "spline" and row["beads"] == 1000)][0]
cheaper = most_cheaper(table)
table.claim("frontier", "The average frontier is below 10", frontier.max() < 10, span(frontier))
table.claim("cascade-tests", "The cascade does fewer tests than naive verification", tests.max() < 1,
            f"{span(tests)} times as many")
table.claim("cascade-as-naive", "Cascade and naive verification take about as long, within a factor of 1.5",
            cascade.min() > 1 / 1.5 and cascade.max() < 1.5, f"{span(cascade)} times")
table.claim("cascade-on-spline", "On the most finely sampled spline the cascade takes at most 0.8 of naive time", spline <= 0.8,
            f"{spline:.3f} times")
table.claim("lazy-cheaper", "Lazy updates are cheaper than verifying", table["lazy_per_naive"].max() < 1,
            f"{span(table['lazy_per_naive'])} times")
table.claim("lazy-ten-at-rest", "At rest, lazy updates can be ten times cheaper than verifying", cheaper >= 10,
            f"up to {cheaper:.3g} times")
table.finish()
