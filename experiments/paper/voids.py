"""How long cavities and tunnels of proteins last, and how many of them frames miss.

Follows all voids of the trajectories of the folder data exactly between frames, with van der Waals radii and a probe of 1.4
angstrom. A stretch of time in which a cavity is closed is missed if no examined frame lies in it. The number of tunnels that
begin or end between two examined frames is at least the change of their number, so the rest of the changes is missed.
"""

import kds
import numpy as np
from common import Report

STRIDES = 1, 8
INPUTS = {"villin": ("villin_hp36_300K.dcd", "villin_hp36_300K.pdb"),
          "random100": ("random100_400K_first200.dcd", "random100_400K.pdb"),
          "dhodh": ("dhodh363_1000K_first20.dcd", "dhodh363_1000K.pdb"),
          "ubiquitin": ("ubiquitin_pull_first30.pdb", None)}


def missed(found, stride):
    """Returns the shares of closed stretches and of changes of the number of tunnels that every stride-th frame misses."""
    begin, end = found.stretches["begin_frame"], found.stretches["end_frame"]
    seen = np.floor(end / stride) * stride >= begin
    changes = sum(found.tunnels.values())
    shown = np.abs(np.diff(found.frames["b1"][::stride].astype(int))).sum()
    return 1 - seen.mean(), 1 - shown / changes


report = Report(__doc__)
rows = []
for name, (file, topology) in INPUTS.items():
    files = report.data / "trajectories"
    options = {"topology": files / topology} if topology else {}
    found = kds.voids(files / file, **options, **({"stop": 100} if report.short else {}))
    complete = (found.stretches["began"] != "start") & (found.stretches["ended"] != "last frame")
    lengths = (found.stretches["end_frame"] - found.stretches["begin_frame"])[complete]
    row = {"trajectory": name, "steps": len(found.frames) - 1, "stretches": len(found.stretches),
           "complete": int(complete.sum()), "median_life": float(np.median(lengths)) if len(lengths) else None,
           "tunnel_changes": sum(found.tunnels.values())}
    for stride in STRIDES:
        row[f"stretches_missed_{stride}"], row[f"tunnels_missed_{stride}"] = map(float, missed(found, stride))
    rows.append(row)
report.results["rows"] = rows
report.show([key.replace("_", " ") for key in rows[0]], [list(row.values()) for row in rows])
report.finish()
