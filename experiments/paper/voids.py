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
    """Returns the shares of closed stretches and of changes of the number of tunnels that every stride-th frame misses, or
    None if there are none."""
    seen = [one["end_frame"] // stride * stride >= one["begin_frame"] for one in found.json["stretches"]]
    changes = sum(found.tunnels.values())
    shown = np.abs(np.diff(np.asarray(found.frames["b1"])[::stride].astype(int))).sum()
    return 1 - sum(seen) / len(seen) if seen else None, 1 - float(shown) / changes if changes else None


report = Report(__doc__)
rows = []
for name, (file, topology) in INPUTS.items():
    files = report.data / "trajectories"
    options = {"topology": files / topology} if topology else {}
    found = kds.voids(files / file, **options, **({"stop": 20} if report.short else {}))
    lengths = [one["end_frame"] - one["begin_frame"] for one in found.json["stretches"]
               if one["began"] != "start" and one["ended"] != "last frame"]
    row = {"trajectory": name, "steps": len(found.frames) - 1, "stretches": len(found.stretches),
           "complete": len(lengths), "median_life": float(np.median(lengths)) if lengths else None,
           "tunnel_changes": sum(found.tunnels.values())}
    for stride in STRIDES:
        row[f"stretches_missed_{stride}"], row[f"tunnels_missed_{stride}"] = missed(found, stride)
    rows.append(row)
report.results["rows"] = rows
report.show([key.replace("_", " ") for key in rows[0]], [list(row.values()) for row in rows])
report.finish()
