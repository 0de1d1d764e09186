"""The necklaces that the paper measures: its own models, and proteins of the folder data.

The paper gives neither formulas nor parameters of its models. Parameters that its figures determine are fitted to them. Splines,
grills and spirals are planar, because the paper counts 3n - 3 edges in their diagrams. Beads of models have radius 1.
"""

import kds
import kds.reading
import numpy as np

# Turns of the static helix, for any number of beads, and of the scaling helix, divided by the root of its number of beads. Fit:
# the least root of the mean squared logarithm of measured / printed over the sets of centres and the edges at 10 and 640 beads
# (table 3), among multiples of 0.1 from 3 to 12, and of 0.01 from 0.2 to 0.4. The deviations are at most 15% and 21%.
STATIC_TURNS = 6.3
SCALING_TURNS = 0.29
SPIRAL_TURNS = 16  # caption of table 5
PAIRED_TURNS = 18  # text of section 4: sets of 18 turns fit table 7 better than those of 16
BOND = 2 * 0.999  # distance of consecutive centres in models of kds
# How far the chain is rolled up in the first frame. A straight chain has n - 1 edges, but the paper counts 3000.
FIRST_ROLLED = 0.001


def half_longest_bond(frames):
    """Returns the radius at which consecutive beads touch or overlap in all frames."""
    return np.linalg.norm(np.diff(frames, axis=1), axis=2).max() / 2 * (1 + 1e-12)


def planar(points):
    """Returns points without their third coordinate if it is 0 everywhere."""
    return points if points[..., 2].any() else np.ascontiguousarray(points[..., :2])


def rolling_spiral(beads=1000, frames=50):
    """Returns stages of a chain that rolls up in the plane, an array (frames, beads, 3)."""
    return kds.generate("spiral", beads=beads, frames=frames, turns=SPIRAL_TURNS, rolled=f"{FIRST_ROLLED!r}:1")


def two_spirals(step, beads=1000, steps=1000):
    """Returns a stage of two equal chains in parallel planes, which roll up in `steps` steps, an array (2 beads, 3).

    The distance of the planes shrinks from 0.4 chain lengths to 30 radii. The paper says neither how its spirals lie nor which
    steps it shows; these are chosen to fit its sets.
    """
    part = step / steps
    rolled, length = FIRST_ROLLED + (1 - FIRST_ROLLED) * part, BOND * (beads - 1)
    lower = kds.generate("spiral", beads=beads, frames=1, turns=PAIRED_TURNS, rolled=f"{rolled!r}:{rolled!r}")[0]
    return np.concatenate([lower, lower + [0, 0, (1 - part) * 0.4 * length + part * 30]])


def trajectory(model, data):
    """Returns all frames of a model that moves, an array (frames, beads, 3)."""
    if model == "spiral":
        return rolling_spiral()
    name = "villin_hp36_300K" if model == "villin" else "random100_400K"
    files = data / "trajectories"
    return kds.reading.positions(files / f"{name}{'' if model == 'villin' else '_first200'}.dcd", files / f"{name}.pdb")


def subject(row, data):
    """Returns the points of a row of tables 1 to 4, and the radius of its beads."""
    model, beads, at = row["model"], row["beads"], row["at"] or ""
    if model in ("grill", "spline"):
        dimension = {"dimension": 2} if model == "spline" else {}
        return kds.generate(model, beads=beads, frames=1, **dimension)[0], 1
    if model.endswith("helix"):
        turns = STATIC_TURNS if model == "static helix" else SCALING_TURNS * np.sqrt(beads)
        return kds.generate("helix", beads=beads, frames=1, turns=float(turns))[0], 1
    if model == "spiral":
        return rolling_spiral()[{"straight": 0, "half rolled": 25, "rolled": 49}[at]], 1
    if "frame" in at:
        frames = trajectory(model, data)
        return frames[int(at.split()[-1])], half_longest_bond(frames)
    files = {"1a4yA0": "1a4y_AB", "1cem00 (5h73)": "5h73", "villin": "villin_hp36_collapse"}
    frames = kds.reading.positions(data / "paper" / f"{files[model]}.pdb")
    return frames[0], half_longest_bond(frames)
