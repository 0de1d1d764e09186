"""Table 5: changes from frame to frame, and updating the wrapped hierarchy.

Each row is the step between two consecutive frames. Cells changed are those of the later diagram that the earlier one does not
have, and bases changed are nodes with another basis. The paper does not say which frames its rows are. The cascade and naive
verification are timed at the later frame with its own bases, so that nothing is repaired. Reinsert and greedy are the two ways of
section 3.2 to update the diagram by removing beads; rebuild builds it anew.
"""

import kds
import numpy as np
from common import span
from paper_table import PaperTable, is_in_dynamics
from subjects import trajectory
from updates import RATIOS, TIMES, cells_changed, most_cheaper, updated

table = PaperTable(5, __doc__, times=TIMES, ratios=RATIOS,
                   counts=["reinsert_per_rebuild", "greedy_per_rebuild", "cells_changed", "bases_changed",
                           "cascade_tests_per_naive"])
frames = {model: trajectory(model, table.data) for model in {row["model"] for row in table.rows}}
for row in table.rows:
    at = int(row["at"].split()[1])
    step = frames[row["model"]][at:at + 2]
    techniques = kds.update(step, radius=1, techniques=["reinsert", "greedy"], rounds=table.rounds).json["rows"]
    _, reinsert, greedy = techniques  # the first is rebuild
    note = "removal gives up and rebuilds, since it would take out more than a tenth of the beads"
    table.measured(row, **updated(step[0], step[1], table.rounds), cells_changed=cells_changed(step),
                   reinsert_per_rebuild=reinsert["ratio"], greedy_per_rebuild=greedy["ratio"],
                   note=note if reinsert["rebuilds"] + greedy["rebuilds"] else None)
table.print_rows()

cells, bases, tests = table["cells_changed"], table["bases_changed"], table["cascade_tests_per_naive"]
dynamics = table.where(is_in_dynamics)
removals = np.minimum(table["reinsert_per_rebuild"], table["greedy_per_rebuild"])[dynamics]
cascade, cheaper = table["cascade_per_naive"], most_cheaper(table)
table.claim("more-stable", "The wrapped hierarchy is more stable than the diagram",
            ((bases < cells) | (cells == 0)).all() and bases.sum() < cells.sum(),
            f"{bases.sum():,.0f} bases and {cells.sum():,.0f} cells change in all rows together")
table.claim("hundred-cells", "In molecular dynamics more than 100 cells change at each step", cells[dynamics].min() > 100,
            span(cells[dynamics]))
table.claim("cascade-tests", "The cascade does fewer tests than naive verification", tests.max() < 1,
            f"{span(tests)} times as many")
table.claim("cascade-no-slower", "The cascade is no slower than naive verification", cascade.max() <= 1, f"{span(cascade)} times")
table.claim("lazy-ten", "Between frames, lazy updates can be ten times cheaper than verifying", cheaper >= 10,
            f"up to {cheaper:.3g} times; the paper's own table shows 3.2 at most")
table.claim("removal-fast", "In molecular dynamics, removing beads is faster than rebuilding the diagram", removals.max() < 1,
            f"the better of two removals takes {span(removals)} times as long")
table.finish()
