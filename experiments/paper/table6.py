"""Table 6: changes over several frames.

The random protein from frame 900 on, counted as in table 5, over so many frames.
"""

import kds.reading
import numpy as np
from common import span
from paper_table import PaperTable
from updates import RATIOS, TIMES, cells_changed, updated

table = PaperTable(6, __doc__, times=TIMES, ratios=RATIOS, counts=["bases_changed", "cells_changed", "cascade_tests_per_naive"])
protein = kds.reading.positions(table.data / "paper" / "random100_400K_900to932.dcd",
                                table.data / "trajectories" / "random100_400K.pdb")
apart = np.array([int(row["at"].split()[0]) for row in table.rows])
for row, frames in zip(table.rows, apart):
    step = protein[[0, frames]]
    table.measured(row, **updated(step[0], step[1], table.rounds), cells_changed=cells_changed(step))
table.print_rows()

cells, bases = table["cells_changed"], table["bases_changed"][apart >= 2]
share = np.corrcoef(np.log2(apart), cells)[0, 1]**2
table.claim("bases-flat", "Basis changes are flat from 2 frames on, within a factor of 1.5", bases.max() <= 1.5 * bases.min(),
            span(bases))
table.claim("diagram-grows", "Changes of the diagram grow", (np.diff(cells) >= 0).all() and cells[0] < cells[-1],
            f"from {cells[0]:,.0f} to {cells[-1]:,.0f}")
table.claim("diagram-grows-as-log", "They grow as the logarithm of the number of frames, which explains 95% of their variance or "
            "more", share >= 0.95, f"{100 * share:.1f}%")
table.finish()
