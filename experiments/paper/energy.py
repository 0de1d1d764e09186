"""How does the number of changes grow with the deformation energy? An open question of the paper.

The energy of a step is half the sum of the squared changes, in radians, of all bending angles and of all torsion angles of the
chain between two frames: springs of stiffness 1. Basis changes are events of the wrapped hierarchy, flips those of the power
diagram, under linear motion, all exact. Trajectories are measured over strides, and their steps in eight groups of like
energy; their intervals leave out one of 8 blocks of neighbouring frames at a time. In a step of a random chain all angles of one
kind, or of both, change by normal random amounts; self-avoiding chains are grown bead by bead at both ends of a step; their
intervals leave out one of 16 equal shares of the conformations.
"""

from math import cos, log, pi, sqrt

import fits
import kds
import numpy as np
from chains import BOND, proteins, random_numbers
from common import Report

STRIDES = (1, 2, 4, 8, 16, 32)
BLOCKS, SHARES, GROUPS = 8, 16, 8
BEADS, AMPLITUDES, SEEDS = 128, 11, (1,)  # amplitudes 2^-10 ... 1 radian
LEAST_BENDING = 0.05 * pi  # from 0 and pi, where torsion angles would jump
KINDS = ("bending", "torsion", "both", "self-avoiding")


def angles_of(chains):
    """Returns all bending and torsion angles of conformations (frames, beads, 3). NaN: not defined."""
    bonds = np.diff(chains, axis=1)
    back, on = -bonds[:, :-1], bonds[:, 1:]
    normals = np.cross(bonds[:, :-1], bonds[:, 1:])
    bending = np.arctan2(np.linalg.norm(normals, axis=2), (back * on).sum(axis=2))
    middle = np.linalg.norm(bonds[:, 1:-1], axis=2)
    torsion = np.arctan2(middle * (bonds[:, :-2] * normals[:, 1:]).sum(axis=2), (normals[:, :-1] * normals[:, 1:]).sum(axis=2))
    is_flat = (normals == 0).all(axis=2)
    lengths = (bonds == 0).all(axis=2)
    bending[lengths[:, :-1] | lengths[:, 1:]] = np.nan
    torsion[is_flat[:, :-1] | is_flat[:, 1:]] = np.nan
    return bending, torsion


def steps_of(frames, radius):
    """Returns a row for each step: bending energy, torsion energy, basis changes and flips."""
    changes = [np.remainder(np.diff(angles, axis=0) + pi, 2 * pi) - pi for angles in angles_of(frames)]  # the short way round
    energies = [np.nansum(change**2, axis=1) / 2 for change in changes]
    run = kds.run(frames, radius=radius, structures=["wrapped", "power"])
    steps = np.arange(len(frames) - 1)
    events = [np.bincount(run.events["step"][run.events["structure"] == name], minlength=len(steps))
              for name in ("wrapped", "power")]
    return np.stack([*energies, *events], axis=1)


def points_of(steps):
    """Returns the point (energy, changes) of the means of steps, for basis changes and for flips."""
    bending, torsion, bases, flips = steps.mean(axis=0)
    return (bending + torsion, bases), (bending + torsion, flips)


def without_share(groups, share):
    """Leaves a share out of groups (steps, share of each step). A share without steps changes nothing."""
    return [steps[of != share] if (of != share).any() else steps for steps, of in groups]


def by_energy(steps):
    """Returns eight groups of steps of like energy."""
    order = np.argsort(steps[:, 0] + steps[:, 1], kind="stable")
    ends = [g * len(steps) // GROUPS for g in range(GROUPS + 1)]
    return [steps[order[first:end]] for first, end in zip(ends, ends[1:]) if first < end]


class GrowingChain:
    """A chain that grows bead by bead. A bending angle of pi is straight."""

    def __init__(self):
        self.positions = [np.zeros(3), np.array([BOND, 0, 0])]
        self.bonds, self.normals = [np.array([1.0, 0, 0])], [np.array([0, 0, 1.0])]

    def add(self, bending, torsion):
        along, normal = self.bonds[-1], self.normals[-1]
        if len(self.positions) > 2:
            normal = cos(torsion) * normal + np.sin(torsion) * cross(along, normal)
        along = cos(pi - bending) * along + np.sin(pi - bending) * cross(normal, along)
        along = along / sqrt(along @ along)
        normal = normal - (normal @ along) * along
        self.bonds.append(along)
        self.normals.append(normal / sqrt(normal @ normal))
        self.positions.append(self.positions[-1] + BOND * along)

    def remove(self):
        for part in (self.positions, self.bonds, self.normals):
            part.pop()

    def overlaps(self):
        """Whether the last bead, of radius 1, overlaps another one than that before it."""
        return len(self.positions) > 2 and (((np.array(self.positions[:-2]) - self.positions[-1])**2).sum(axis=1) <= 4).any()


def cross(a, b):
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def chain_of(bending, torsion):
    chain = GrowingChain()
    for angles in zip(bending, [0, *torsion]):
        chain.add(*angles)
    return np.array(chain.positions)


def self_avoiding(draw):
    """Grows a chain of which no two beads overlap but consecutive ones. draw(bead) gives the bending angle before it and the
    torsion angle of its bond. Angles are drawn again where beads overlap, and the chain is shortened at dead ends."""
    chain, drawn, dead_ends = GrowingChain(), [], 0
    while len(chain.positions) < BEADS:
        for _ in range(50):
            drawn.append(draw(len(chain.positions)))
            chain.add(*drawn[-1])
            if not chain.overlaps():
                break
            chain.remove()
            drawn.pop()
        else:
            # A dead end may come from far back, so each of six shortens the chain twice as much as the one before.
            dead_ends += 1
            for _ in range(min(8 << dead_ends % 6, len(drawn))):
                chain.remove()
                drawn.pop()
    return drawn, np.array(chain.positions)


def step_of_chain(kind, amplitude, random):
    """Returns a random chain before and after a step."""

    def normal():
        return sqrt(-2 * log(1 - next(random))) * cos(2 * pi * next(random))

    def bending():
        return pi * (0.4 + 0.4 * next(random))

    def changed(angle):
        """Draws again if the chain would fold or straighten."""
        while not LEAST_BENDING < (found := angle + amplitude * normal()) < pi - LEAST_BENDING:
            pass
        return found

    if kind == "self-avoiding":
        angles, before = self_avoiding(lambda bead: (bending(), 2 * pi * next(random)))
        return before, self_avoiding(lambda bead: (
            changed(angles[bead - 2][0]), angles[bead - 2][1] + amplitude * normal() if bead > 2 else 0))[1]
    bends = [bending() for _ in range(BEADS - 2)]
    torsions = [2 * pi * next(random) for _ in range(BEADS - 3)]
    other_bends = [changed(angle) for angle in bends] if kind != "torsion" else bends
    others = [angle + amplitude * normal() for angle in torsions] if kind != "bending" else torsions
    return chain_of(bends, torsions), chain_of(other_bends, others)


def random_steps(kind, amplitudes):
    """Yields amplitude, steps and the share of each step. Small amplitudes have more conformations, as they change less."""
    randoms = [random_numbers(seed * len(KINDS) + KINDS.index(kind)) for seed in SEEDS]
    for a in range(amplitudes):
        amplitude, count = 2.0**(a + 1 - AMPLITUDES), min(128, 16 << (AMPLITUDES - 1 - a))
        pairs = [step_of_chain(kind, amplitude, random) for random in randoms for _ in range(count)]
        yield amplitude, np.concatenate([steps_of(np.array(pair), 1) for pair in pairs]), np.tile(np.arange(count) % SHARES, len(SEEDS))


class Energy(Report):
    """The rows of each subject, and its exponents."""

    def rows(self, subject, found):
        for step, steps, _ in found:
            bending, torsion, bases, flips = steps.mean(axis=0)
            self.results["rows"].append({"row": f"{subject}, step {step:g}",
                                         "steps": len(steps), "bending": bending, "torsion": torsion, "basis_changes": bases, "flips": flips})

    def fit(self, subject, groups, without, parts):
        """Fits a power of the energy to parts of the means of groups. `without` has the groups without one share each."""
        for kind, changes in enumerate(("basis changes", "flips")):
            whole, *others = [[points_of(steps)[kind] for steps in some] for some in (groups, *without)]
            for part, chosen in parts.items():
                fitted = fits.jackknife(whole[chosen], [some[chosen] for some in others])
                energies = [energy for energy, _ in whole[chosen]]
                if fitted:
                    exponent, error = fitted
                    self.results.setdefault("fits", []).append(
                        (subject, changes, part, min(energies), max(energies), exponent, exponent - error, exponent + error))


def main():
    report = Energy(__doc__)
    for name, frames, radius in proteins(report.data):
        found = []
        for stride in STRIDES:
            steps = steps_of(frames[::stride], radius)
            found.append((stride, steps, np.arange(len(steps)) * stride * BLOCKS // len(frames)))
        report.rows(name, found)
        groups = [rest for _, *rest in found]
        report.fit(name, [steps for steps, _ in groups], [without_share(groups, block) for block in range(BLOCKS)],
                   {"strides": slice(None)})
        report.fit(f"{name} by step", by_energy(groups[0][0]),
                   [by_energy(*without_share(groups[:1], block)) for block in range(BLOCKS)], {"steps at stride 1": slice(None)})
    parts = {"the 4 least amplitudes": slice(4), "4 amplitudes below the largest two": slice(-6, -2), "the 3 largest": slice(-3, None)}
    for kind in KINDS:
        subject = "self-avoiding chain, both" if kind == "self-avoiding" else f"random chain, {kind}"
        found = list(random_steps(kind, 1 if report.short else AMPLITUDES))
        report.rows(subject, found)
        groups = [rest for _, *rest in found]
        if len(found) == AMPLITUDES:
            report.fit(subject, [steps for steps, _ in groups], [without_share(groups, share) for share in range(SHARES)], parts)
    report.show(list(report.results["rows"][0]), [list(row.values()) for row in report.results["rows"]])
    report.show(("chain", "changes", "over", "energies from", "to", "exponent", "95% from", "to"), report.results["fits"])
    report.say("  An exponent of 0.5 is growth in proportion to how far angles change, which small steps always show.")
    report.finish()


if __name__ == "__main__":
    main()
