"""What tables 2, 5 and 6 share: updates of the wrapped hierarchy."""

import kds.timing
from subjects import planar

TIMES = ["lazy_ms", "cascade_ms", "naive_ms"]
RATIOS = {"lazy_per_naive": ("lazy_ms", "naive_ms"), "cascade_per_naive": ("cascade_ms", "naive_ms")}


def updated(before, after, rounds):
    """Returns the figures of an update of the wrapped hierarchy from one frame to another."""
    found = kds.timing.updates(planar(before), planar(after), rounds=rounds)
    return {"lazy_ms": found["lazy"], "cascade_ms": found["cascade"], "naive_ms": found["naive"], "frontier": found["frontier"],
            "bases_changed": found["bases_changed"], "cascade_tests_per_naive": found["cascade_tests"] / found["naive_tests"]}


def cells_changed(step):
    """Returns how many cells of the later of two diagrams are not in the earlier one."""
    power = kds.run(step, radius=1, structures=["power"]).power
    earlier, later = ({tuple(cell) for cell in power.elements(frame)} for frame in (0, 1))
    return len(later - earlier)


def most_cheaper(table):
    """Returns the largest ratio of verifying time, naive or by the cascade, to lazy time."""
    return max(max(naive, cascade) / lazy for lazy, cascade, naive in zip(*(table[name] for name in TIMES)))
