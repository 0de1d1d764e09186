"""How sure are lifetimes of contacts, and which definition of a contact survives fewer frames?

Coverage: contacts of known rates are made as trajectories, measured by kds.contacts, and compared with the truth. A bead is in
or out at random. Two beads are in contact while both are in, so pairs that share a bead depend on each other. Definitions:
contacts with one cutoff, with one cutoff and a gap, and with two cutoffs, each on every s-th frame of the trajectories of the
folder data. Correlation: C(t), S(t) and the survival of contacts that begin. The default form takes three minutes on two cores.
"""

import itertools
import warnings
from concurrent.futures import ProcessPoolExecutor
from functools import cache

import kds
import numpy as np
from common import Report, save, span, subplots

RUNS, CUTOFF, STRIDES = 200, 8, (1, 2, 4, 8, 16)
WATER = {"select": "//*", "by": "bead", "groups": ("//*/(SOL)/OW", "//*//O"), "apart": 1}
IONS, LIPIDS = ({"select": "//*", "by": "residue", "groups": (f"//*/({first})", f"//*/({second})"), "apart": 1}
                for first, second in (("NA", "ASP"), ("LIP", "ALA")))
# File, topology, cutoffs, gap of about five frames, lag of C(t), and options. Times are in frames if the file has none.
INPUTS = {
    "villin, C-alpha": ("villin_hp36_300K.dcd", "villin_hp36_300K.pdb", (8, 10), 5, 50, {"select": "ca"}),
    "villin, backbone": ("villin_hp36_300K.dcd", "villin_hp36_300K.pdb", (4.5, 6), 5, 50, {}),
    "random100, C-alpha": ("random100_400K_first200.dcd", "random100_400K.pdb", (8, 10), 5, 50, {"select": "ca"}),
    "ubiquitin, C-alpha": ("ubiquitin_pull_first30.pdb", None, (8, 10), 5, 8, {"select": "ca"}),
    "dhodh, C-alpha": ("dhodh363_1000K_first20.dcd", "dhodh363_1000K.pdb", (8, 10), 5, 8, {"select": "ca"}),
    "water at a peptide": ("enkephalin_water.xtc", "enkephalin_water.gro", (3.5, 4.5), 0.5, 2, WATER),
    "ions at a chain": ("ions_chain.xtc", "ions_chain.gro", (6, 8), 1, 4, IONS),
    "lipids at a rod": ("lipids_rod.xtc", "lipids_rod.gro", (6, 9), 10, 40, LIPIDS)}
OTHERS = {  # other cutoffs without a gap, and the cutoff of INPUTS with a gap of 20 frames
    **{f"{name}, C-alpha": ((6, 0), (7, 0), (10, 0), (12, 0)) for name in ("ubiquitin", "dhodh")},
    **{f"{name}, C-alpha": ((6, 0), (7, 0), (10, 0), (12, 0), (8, 20)) for name in ("villin", "random100")},
    "villin, backbone": ((4, 0), (6, 0), (4.5, 20)), "water at a peptide": ((3, 0), (4, 0), (4.5, 0), (6, 0), (3.5, 2)),
    "ions at a chain": ((6, 4),), "lipids at a rod": ((5, 0), (8, 0), (10, 0), (12, 0), (6, 40))}
LEAST = 100  # contacts, for claims


def switches(random, begin, end, length):
    """Returns whether a bead is in at first, and when it goes in or out."""
    is_in = random.random() < begin / (begin + end)
    times, rates = [], (end, begin) if is_in else (begin, end)
    while not times or times[-1] < length:
        times.append((times[-1] if times else 0) + random.exponential(1 / rates[len(times) % 2]))
    return is_in, times[:-1]


class Scene:
    """Beads that go in and out, and which pairs of them are asked for: those of bead 0 (`site`, which stays in, and `hub`), or
    all (`molecule`). Logarithms of rates differ by `spread` between beads, and by `between` between replicas."""

    def __init__(self, kind, beads, length, rate=0.1, spread=0.0, anew=False, between=0.0):
        self.kind, self.beads, self.length, self.rate = kind, beads, length, rate
        self.spread, self.anew, self.between = spread, anew, between
        self.fixed = self.rates(np.random.default_rng(beads))

    def is_long(self):
        """Returns whether the pairs are the same in each run, and a bead is in or out 20 times or more on average."""
        return not self.anew and self.rate * self.length >= 20

    def rates(self, random):
        """Returns rates of going in and out, (2, beads)."""
        noise = self.spread * random.normal(size=(2, self.beads)) + self.between * random.normal(size=(2, 1))
        rates = self.rate * np.exp(noise)
        if self.kind == "site":
            rates[:, 0] = 1, 0
        return rates

    def trajectory(self, random):
        """Returns positions and times of frames. Two frames lie close around each change, so that paths make it exact."""
        rates = self.rates(random) if self.anew or self.between else self.fixed
        states, changes = zip(*(switches(random, *pair, self.length) if pair[1] else (True, []) for pair in rates.T))
        times = np.concatenate(changes)
        order = np.argsort(times)
        times, bead = times[order], np.repeat(np.arange(self.beads), [len(one) for one in changes])[order]
        gaps = np.diff(times, prepend=0, append=self.length)
        half = np.minimum(np.minimum(gaps[:-1], gaps[1:]) / 4, 1e-5 / self.rate)
        flips = np.zeros((len(times) + 1, self.beads), bool)
        flips[0] = states
        flips[np.arange(1, len(flips)), bead] = True
        is_in = np.repeat(np.logical_xor.accumulate(flips), 2, axis=0)[:, :, None]
        angle = 2 * np.pi * np.arange(self.beads) / self.beads
        circle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
        around = np.stack([times - half, times + half], axis=1).ravel()
        return np.where(is_in, 2 * circle, 8 * self.beads * circle), np.concatenate([[0], around, [self.length]])

    def measure(self, source):
        positions, times = source
        first = range(self.beads) if self.kind == "molecule" else [0]
        groups = first, range(0 if self.kind == "molecule" else 1, self.beads)
        return kds.contacts(positions, times=times, cutoff=CUTOFF, by="bead", apart=1, groups=groups, strides=[1], threads=1)

    def truth(self):
        """Returns the share of time in contact, the rate of end and the function C of each pair."""
        if self.anew or self.between:  # the mean over many draws
            draws = [self.rates(np.random.default_rng(seed)) for seed in range(4000 // self.beads)]
        else:
            draws = [self.fixed]
        share, end, relaxing = [], [], []
        for rates in draws:
            first, second = np.triu_indices(self.beads, 1)
            some = first >= 0 if self.kind == "molecule" else first == 0
            beads = first[some], second[some]
            of_bead = rates[0] / rates.sum(axis=0)
            share.append(of_bead[beads[0]] * of_bead[beads[1]])
            end.append(rates[1][beads[0]] + rates[1][beads[1]])
            relaxing.append([(of_bead[k], rates.sum(axis=0)[k]) for k in beads])
        share, end, relaxing = np.concatenate(share), np.concatenate(end), np.concatenate(relaxing, axis=2)

        def correlation(lag):
            return np.prod([p + (1 - p) * np.exp(-rate * lag) for p, rate in relaxing], axis=0)

        return share, end, correlation

    def true_figures(self, lags):
        share, end, correlation = self.truth()
        flux = share * end
        found = {"occupancy": share.mean(), "begin_rate": flux.sum() / (1 - share).sum(), "end_rate": flux.sum() / share.sum()}
        for name, lag in lags.items():
            found[f"C({name})"] = (share * correlation(lag)).sum() / share.sum()
            found[f"S({name})"] = (share * np.exp(-end * lag)).sum() / share.sum()
            found[f"survival({name})"] = (flux * np.exp(-end * lag)).sum() / flux.sum()
        low, high = 0.0, 100 / end.min()
        while high - low > 1e-9 * high:
            middle = (low + high) / 2
            low, high = (middle, high) if (flux * np.exp(-end * middle)).sum() > flux.sum() / 2 else (low, middle)
        return {**found, "median": low}


SCENES = {
    "20 pairs with a site": Scene("site", 21, 200),
    "20 pairs with a site, rates differ by factors of 2.7, pairs anew": Scene("site", 21, 200, spread=1.0, anew=True),
    "the same 20 pairs in each run": Scene("site", 21, 200, spread=1.0),
    "66 pairs of 12 beads": Scene("molecule", 12, 200),
    "66 pairs of 12 beads, long run": Scene("molecule", 12, 800),
    "66 pairs of 12 beads that relax in half of the run": Scene("molecule", 12, 220, rate=0.005),
    "66 pairs of 12 beads, rates differ by factors of 2.7": Scene("molecule", 12, 200, spread=1.0),
    "276 pairs of 24 beads": Scene("molecule", 24, 200),
    "12 pairs that share a bead": Scene("hub", 13, 400)}
REPLICAS = {
    "3 replicas of 66 pairs": (3, Scene("molecule", 12, 100)),
    "8 replicas of 66 pairs": (8, Scene("molecule", 12, 100)),
    "3 replicas whose rates differ by factors of 1.3": (3, Scene("molecule", 12, 100, between=0.3)),
    "8 replicas whose rates differ by factors of 1.3": (8, Scene("molecule", 12, 100, between=0.3))}
FIGURES = ("occupancy", "begin_rate", "end_rate")


def intervals_of_run(scene, lags, seed):
    """Yields name and ends of each interval of a run."""
    found = scene.measure(scene.trajectory(np.random.default_rng(seed)))
    for name in (*FIGURES, "median"):
        yield f"{name} by pair", name, found.all[f"{name}_lower"], found.all[f"{name}_upper"]
    for name, lag in lags.items():
        steps = found.json["survival"]
        before = [step for step in steps if step["length"] <= lag]
        if before:
            yield f"survival({name}) by pair", f"survival({name})", before[-1]["lower"], before[-1]["upper"]
    over_time, curves = found.over_time(), found.correlation(list(lags.values()))
    for name in FIGURES:
        yield f"{name} over time", name, over_time[f"{name}_lower"], over_time[f"{name}_upper"]
    yield from intervals_of_curves(curves, lags)


def intervals_of_curves(curves, lags):
    for k, name in enumerate(lags):
        for of, column in (("C", "intermittent"), ("S", "continuous")):
            yield f"{of}({name})", f"{of}({name})", curves[f"{column}_lower"][k], curves[f"{column}_upper"][k]


def intervals_of_replicas(scene, count, lags, seed):
    random = np.random.default_rng(seed)
    found = kds.Replicas([scene.measure(scene.trajectory(random)) for _ in range(count)])
    for name in FIGURES:
        yield name, name, found.all[f"{name}_lower"], found.all[f"{name}_upper"]
    shares = found.survival(list(lags.values()))
    for k, name in enumerate(lags):
        yield f"survival({name})", f"survival({name})", shares["lower"][k], shares["upper"][k]
    yield from intervals_of_curves(found.correlation(list(lags.values())), lags)


@cache
def truth_of(scene):
    """Returns lags of half, one and two mean lives, and the true figures."""
    share, end, _ = scene.truth()
    life = share.sum() / (share * end).sum()
    lags = {"1/2": life / 2, "1": life, "2": 2 * life}
    return lags, scene.true_figures(lags)


def of_seed(task):
    """Returns for each interval of a run whether it contains the truth. NaN: it has no ends."""
    name, seed = task
    warnings.simplefilter("ignore")
    count, scene = REPLICAS.get(name, (None, SCENES.get(name)))
    lags, truth = truth_of(scene)
    given = intervals_of_run(scene, lags, seed) if count is None else intervals_of_replicas(scene, count, lags, seed)
    return {key: float(lower <= truth[of] <= upper) if np.isfinite(np.array([lower, upper], float)).all() else np.nan
            for key, of, lower, upper in given}


def coverage(report, names, runs):
    """Adds a row for each scene with the shares of intervals that contain the truth, in percent, and how many have no ends."""
    rows = []
    with ProcessPoolExecutor(2) as pool:
        for name in names:
            found = list(pool.map(of_seed, [(name, seed) for seed in range(runs)]))
            every = {key: [one.get(key, np.nan) for one in found] for key in dict.fromkeys(key for one in found for key in one)}
            without = {key: count for key, values in every.items() if (count := int(np.isnan(values).sum()))}
            shares = {key: 100 * float(np.nanmean(values)) for key, values in every.items() if without.get(key) != runs}
            report.results["rows"].append({"row": f"coverage, {name}", "runs": runs, **shares, "without": without})
            rows.append((name, shares, without))
    keys = list(dict.fromkeys(key for _, shares, _ in rows for key in shares))
    report.show(["coverage in % (runs without interval)", *keys], [
        [name, *(f"{shares[key]:.1f}{f' ({without[key]})' if key in without else ''}" if key in shares else "" for key in keys)]
        for name, shares, without in rows])
    report.say(f"The standard error of {runs} runs is {100 * np.sqrt(0.95 * 0.05 / runs):.1f} points at a coverage of 95% and "
               f"{50 / np.sqrt(runs):.1f} at 50%.\n")
    return {name: shares for name, shares, _ in rows}


def measured(name, data, way, stride, **rule):
    """Returns the figures of an input for a definition of a contact and a stride."""
    file, topology, _, _, lag, options = INPUTS[name]
    topology = {"topology": data / topology} if topology else {}
    found = kds.contacts(data / file, step=stride, strides=[1], **options, **topology, **rule)
    curves = found.correlation([lag])
    return {"row": f"{name}, {way}, stride {stride}", "contacts": found.all["contacts"], "residence": found.all["residence"],
            "median": found.all["median"], "C": float(curves["intermittent"][0]), "S": float(curves["continuous"][0])}


def definitions(name, data, strides):
    """Yields the figures of an input for each definition of a contact and stride."""
    _, _, (inner, outer), gap, *_ = INPUTS[name]
    ways = {"one cutoff": {"cutoff": inner}, "gap": {"cutoff": inner, "gap": gap}, "two cutoffs": {"cutoff": (inner, outer)}}
    for way, rule in ways.items():
        for stride in strides:
            yield measured(name, data, way, stride, **rule)


def others(data):
    """Yields the figures of further cutoffs and gaps at strides 1 and 8."""
    for name, rules in OTHERS.items():
        for (cutoff, gap), stride in itertools.product(rules, (1, 8)):
            way = f"cutoff {cutoff}, gap {gap}" if gap else f"one cutoff of {cutoff}"
            yield measured(name, data, way, stride, cutoff=cutoff, gap=gap)


def curves(data, name="water at a peptide", lags=(0.05, 0.1, 0.2, 0.5, 1, 2, 3, 4, 5, 7, 10), cutoffs=1):
    """Returns the contacts of an input, its correlation functions, and its survival function at the lags."""
    file, topology, cutoff, _, _, options = INPUTS[name]
    found = kds.contacts(data / file, topology=data / topology, cutoff=cutoff[0] if cutoffs == 1 else cutoff, **options)
    steps = found.json["survival"]
    at = np.searchsorted([step["length"] for step in steps], lags, side="right")
    return found, found.correlation(lags), np.append(1, [step["survival"] for step in steps])[at]


def renewal(found, lags):
    """Returns S(t) as it follows from the survival function if the run is stationary: 1 - integral of survival / mean life."""
    steps = found.json["survival"]
    ends, shares = np.append(0, [step["length"] for step in steps]), np.append(1, [step["survival"] for step in steps])
    area = np.append(0, np.cumsum(np.diff(ends) * shares[:-1]))
    return 1 - np.interp(lags, ends, area) / found.all["residence"]


def draw(data, path):
    """Draws the three curves of water, and the number of contacts by stride for three definitions."""
    figure, (left, right) = subplots(1, 2, figsize=(9, 3.8))
    lags = np.linspace(0, 8, 81)
    found, table, _ = curves(data, lags=lags)
    for column, label, color in (("intermittent", "C(t): in contact again or still", "#2f6ea5"),
                                 ("continuous", "S(t): still, from a random time", "#3b8a5a")):
        left.plot(lags, table[column], color=color, label=label)
        left.fill_between(lags, table[f"{column}_lower"], table[f"{column}_upper"], color=color, alpha=0.15, linewidth=0)
    steps = found.json["survival"]
    left.step([0, *(step["length"] for step in steps)], [1, *(step["survival"] for step in steps)], where="post",
              color="#b3462f", label="survival: still, from the beginning")
    left.set(xlabel="time t (ps)", ylabel="share of contacts", xlim=(0, 8), ylim=(0, 1),
             title="water within 3.5 angstrom of a peptide's O")
    left.legend(frameon=False, fontsize=9)
    for name, style in (("villin, C-alpha", "-"), ("water at a peptide", "--")):
        rows = {row["row"]: row["contacts"] for row in definitions(name, data, STRIDES)}
        for way, color in (("one cutoff", "#b3462f"), ("gap", "#c98a1b"), ("two cutoffs", "#1f2933")):
            numbers = [rows[f"{name}, {way}, stride {stride}"] for stride in STRIDES]
            right.plot(STRIDES, numbers, style, marker="o", markersize=4, color=color,
                       label=f"{name.split(',')[0].split(' ')[0]}, {way}")
    right.set(xscale="log", yscale="log", xlabel="stride (frames)", ylabel="number of contacts", xticks=STRIDES,
              title="number of contacts by definition", ylim=(25, 1200))
    right.set_xticks(STRIDES, [str(stride) for stride in STRIDES])
    right.minorticks_off()
    right.set_yticks([50, 100, 200, 500, 1000], ["50", "100", "200", "500", "1000"])
    right.legend(frameon=False, fontsize=8, ncols=2, loc="lower left", handlelength=3)
    figure.tight_layout()
    save(figure, path)


def main():
    warnings.simplefilter("ignore", kds.InputWarning)
    report = Report(__doc__)
    data, rows = report.data / "trajectories", report.results["rows"]
    covered = coverage(report, list(SCENES)[3:4] if report.short else SCENES, 20 if report.short else RUNS)
    over_time = [np.mean([shares[f"{name} over time"] for name in FIGURES])
                 for scene, shares in covered.items() if SCENES[scene].is_long()]
    report.claim("over time", "Intervals over time hold in 88% or more of the runs that have 20 mean lives and the same pairs",
                 min(over_time) >= 88, f"{span(over_time)}%")
    coverage(report, list(REPLICAS)[2:3] if report.short else REPLICAS, 20 if report.short else RUNS)
    inputs = ("villin, C-alpha", "water at a peptide") if report.short else INPUTS
    found = [row for name in inputs for row in definitions(name, data, STRIDES[:3:2] if report.short else STRIDES)]
    rows += found
    report.show(list(found[0]), [list(row.values()) for row in found])
    if not report.short:
        more = list(others(data))
        rows += more
        report.show(list(more[0]), [list(row.values()) for row in more])
        found += more
    stride = 4 if report.short else 8
    at_first = {row["row"].removesuffix(", stride 1"): row["C"] for row in found}
    off = [abs(row["C"] / at_first[row["row"].removesuffix(f", stride {stride}")] - 1) for row in found
           if "one cutoff" in row["row"] and row["row"].endswith(f" {stride}") and row["contacts"] >= LEAST]
    report.claim("C", f"C(t) of one cutoff changes by at most 17% to stride {stride} where {LEAST} contacts are left",
                 max(off) <= 0.17, f"{100 * max(off):.1f}% at most")
    lags = (0.2, 0.5, 1, 2, 5)
    for cutoffs in (1, 2):
        contacts, table, survival = curves(data, lags=lags, cutoffs=cutoffs)
        by_renewal = renewal(contacts, lags)
        found = [{"row": f"water, {cutoffs} cutoffs, lag {lag}", "survival": float(survival[k]),
                  "S": float(table["continuous"][k]), "S_by_survival": float(by_renewal[k]),
                  "C": float(table["intermittent"][k])} for k, lag in enumerate(lags)]
        rows += found
        report.show(list(found[0]), [list(row.values()) for row in found])
    report.finish()


if __name__ == "__main__":
    main()
