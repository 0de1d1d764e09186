"""Recomputes counts of `kds collide` and of tests/paper with numpy. No code is shared with kds.

Usage: paper_counts.py KDS DATA FOLDER. Exit code 77 (skipped) if numpy is not installed. Without scipy, which
computes Delaunay triangulations and solves linear programs, counts of cells and edges and bounds of families are
left out.

Smallest spheres are found by pivoting: the farthest bead joins the basis, and a trial of all subsets gives the
next basis. Families are checked by their definition, by a matrix over all pairs of beads.
"""
import itertools
import json
import math
import os
import subprocess
import sys
from pathlib import Path

try:
    import numpy
except Exception as error:  # a package may be installed and broken
    print(f"skipped: numpy cannot be imported ({error})")
    sys.exit(77)
try:
    from scipy.optimize import linprog
    from scipy.sparse import csc_matrix
    from scipy.spatial import Delaunay, cKDTree
except Exception as error:
    Delaunay = cKDTree = linprog = None
    print(f"left out: cells, edges, pairs at frames and bounds of families, because scipy cannot be imported ({error})")

KDS, DATA, FOLDER = sys.argv[1:4]
os.makedirs(FOLDER, exist_ok=True)
FAILURES = []
CHECKS = 0


def check(name, found, expected):
    """`found` is by kds, `expected` by this script."""
    global CHECKS
    CHECKS += 1
    if found != expected:
        FAILURES.append(name)
        print(f"FAILED: {name}: {found} by kds, {expected} here")


def kds(*arguments):
    run = subprocess.run([KDS, *arguments], capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"kds {' '.join(arguments)}: {run.stderr}")
    return run.stdout


# --- files ---


def read_frames(path):
    """Returns the frames of an XYZ file, an array (frames, beads, 3)."""
    lines = open(path).read().splitlines()
    size = int(lines[0]) + 2
    return numpy.array([[line.split()[1:4] for line in lines[at + 2 : at + size]] for at in range(0, len(lines), size)], float)


def read_xyz(path):
    return read_frames(path)[0]


def read_backbone(path):
    """Returns N, CA and C of the first chain of the first model."""
    places, chain = [], None
    for line in open(path):
        if line.startswith("ENDMDL"):
            break
        if not line.startswith("ATOM") or line[12:16].strip() not in ("N", "CA", "C") or line[16] not in " A":
            continue
        chain = chain or line[21]
        if line[21] == chain:
            places.append([float(line[at : at + 8]) for at in (30, 38, 46)])
    return numpy.array(places)


def read_dcd(path):
    """Returns positions (frames, beads, 3). Records are framed by their length in bytes."""
    content, at, records = open(path, "rb").read(), 0, []
    while at < len(content):
        size = int.from_bytes(content[at : at + 4], "little")
        records.append(content[at + 4 : at + 4 + size])
        at += size + 8
    beads = int.from_bytes(records[2], "little")
    axes = [numpy.frombuffer(record, "<f4") for record in records[3:] if len(record) == 4 * beads]
    return numpy.array(axes, dtype=float).reshape(-1, 3, beads).transpose(0, 2, 1)


# --- spheres and hierarchies ---


def sphere_through(points):
    """Returns the smallest sphere with all points on its surface, or none if they are dependent."""
    edges = points[1:] - points[0]
    try:
        weights = numpy.linalg.solve(2 * edges @ edges.T, (edges**2).sum(1))
    except numpy.linalg.LinAlgError:
        return None
    offset = edges.T @ weights
    return points[0] + offset, numpy.sqrt(offset @ offset)


def smallest_sphere(points):
    """Returns centre, radius and basis. The basis is the smallest subset with the same sphere."""
    basis, center, radius = (0,), points[0], 0.0
    while True:
        squared = ((points - center) ** 2).sum(1)
        farthest = int(squared.argmax())
        if numpy.sqrt(squared[farthest]) <= radius * (1 + 1e-10) + 1e-13:
            return center, radius, frozenset(basis)
        beads = basis + (farthest,)
        radius = numpy.inf
        for size in range(2, min(4, len(beads)) + 1):
            for subset in itertools.combinations(beads, size):
                sphere = sphere_through(points[list(subset)])
                if sphere is None or not sphere[1] < radius * (1 - 1e-9):
                    continue
                reach = numpy.sqrt(((points[list(beads)] - sphere[0]) ** 2).sum(1).max())
                if reach <= sphere[1] * (1 + 1e-10):
                    (center, radius), basis = sphere, subset


class Node:
    """`beads` is first and last; `children` is empty for a bead."""

    def __init__(self, points, first, last, radius, layered):
        self.first, self.last, self.children, self.basis = first, last, (), frozenset((first,))
        self.center, self.radius = points[first], radius
        if first == last:
            return
        middle = first + (last - first) // 2
        self.children = (Node(points, first, middle, radius, layered), Node(points, middle + 1, last, radius, layered))
        if layered:
            self.center, self.radius = around(*self.children)
        else:
            self.center, inner, basis = smallest_sphere(points[first : last + 1])
            self.radius, self.basis = inner + radius, frozenset(first + bead for bead in basis)

    def nodes(self):
        if self.children:
            yield self
            for child in self.children:
                yield from child.nodes()


    def size(self):
        return self.radius

    def is_apart(self, other):
        return bool(numpy.linalg.norm(self.center - other.center) > self.radius + other.radius)


class Box(Node):
    """A node with the smallest axis-aligned box around its balls."""

    def __init__(self, points, first, last, radius):
        self.first, self.last, self.children = first, last, ()
        if first != last:
            middle = first + (last - first) // 2
            self.children = (Box(points, first, middle, radius), Box(points, middle + 1, last, radius))
        beads = points[first : last + 1]
        self.low, self.high = beads.min(0) - radius, beads.max(0) + radius

    def size(self):
        return (self.high - self.low).prod()

    def is_apart(self, other):
        return bool((self.low > other.high).any() or (other.low > self.high).any())


def around(a, b):
    """Returns the smallest sphere around two spheres."""
    apart = numpy.linalg.norm(b.center - a.center)
    if a.radius >= apart + b.radius:
        return a.center, a.radius
    if b.radius >= apart + a.radius:
        return b.center, b.radius
    radius = (apart + a.radius + b.radius) / 2
    return a.center + (b.center - a.center) * ((radius - a.radius) / apart), radius


def tree_over(points, radius, layered=False):
    return Node(points, 0, len(points) - 1, radius, layered)


def separating_pairs(root, apart=None, other=None):
    """Splits the node with more beads, and the first of two equal ones. Leaves out pairs of one necklace that are nearer than
    `apart`. `other` is the root of a second necklace: then only pairs between the two are asked about, and all of these."""
    pairs, waiting = [], [(root, other or root)]
    while waiting:
        u, v = waiting.pop()
        if u is v:
            if u.children:
                left, right = u.children
                waiting += [(left, left), (right, right), (left, right)]
        elif other is None and v.last - u.first < apart:
            continue
        elif ((u.center - v.center) ** 2).sum() > (u.radius + v.radius) ** 2:
            pairs.append((u, v))
        elif u.children and u.last - u.first >= v.last - v.first:
            waiting += [(child, v) for child in u.children]
        elif v.children:
            waiting += [(u, child) for child in v.children]
    return pairs


def larger_first(root, points, radius):
    """Splits the larger node, and the first of two equal ones. Beads are compared as balls. Returns the number of
    disjoint pairs, and of pairs that are compared."""
    disjoint, compared, waiting = 0, 0, [node.children for node in root.nodes()]
    while waiting:
        u, v = waiting.pop()
        if v.last - u.first < 2:
            continue
        compared += 1
        if not u.children and not v.children:
            disjoint += bool(numpy.linalg.norm(points[u.first] - points[v.first]) > 2 * radius)
        elif u.is_apart(v):
            disjoint += 1
        elif not v.children or (u.children and u.size() >= v.size()):
            waiting += [(child, v) for child in u.children]
        else:
            waiting += [(u, child) for child in v.children]
    return disjoint, compared


def compared_along(edges, points, radius):
    """Returns the number of pairs, at least 2 apart, of a bead and a neighbour of a bead that it meets, or of itself."""
    beads = len(points)
    joined = numpy.zeros((beads, beads), dtype=bool)
    joined[tuple(edges.T)] = joined[tuple(edges.T[::-1])] = True
    meets = ((points[:, None] - points[None, :]) ** 2).sum(2) <= (2 * radius) ** 2
    compared = meets.astype(int) @ joined > 0
    return int((compared | compared.T)[numpy.triu_indices(beads, 2)].sum())


def covers_once(points, radius, pairs, apart):
    """Checks (S1), and (S2) with each pair of beads that does not collide covered once, by brute force."""
    count = len(points)
    times = numpy.zeros((count, count), dtype=int)
    for u, v in pairs:
        if not (numpy.linalg.norm(u.center - v.center) > u.radius + v.radius):
            return False
        times[u.first : u.last + 1, v.first : v.last + 1] += 1
    squared = ((points[:, None] - points[None, :]) ** 2).sum(2)
    first, second = numpy.triu_indices(count, apart)
    disjoint = squared[first, second] > (2 * radius) ** 2
    return bool((times[first, second] == disjoint).all())


def delaunay_cells(points):
    flat = (points[:, 2] == 0).all()
    return Delaunay(points[:, :2] if flat else points)


def edge_count(points):
    """Returns the number of edges, including one to the infinite vertex from each bead on the hull."""
    cells = delaunay_cells(points)
    corners = numpy.sort(cells.simplices, 1).astype(numpy.int64)
    ends = itertools.combinations(range(corners.shape[1]), 2)
    edges = numpy.unique(numpy.concatenate([corners[:, a] * len(points) + corners[:, b] for a, b in ends]))
    return len(edges) + len(numpy.unique(cells.convex_hull))


# --- the counts ---


def half_longest_bond(frames):
    return numpy.sqrt((numpy.diff(frames, axis=-2) ** 2).sum(-1).max()) / 2


def compare_families():
    """Families of touching beads, as `kds collide` counts them."""
    chain = os.path.join(FOLDER, "chain.xyz")
    kds("generate", "random-chain", "--beads", "1500", "--frames", "1", "-o", chain, "--quiet")
    protein = os.path.join(DATA, "paper/1a4y_AB.pdb")
    backbone = read_backbone(protein)
    cases = [("chain", chain, read_xyz(chain), 1.0), ("1a4y", protein, backbone, half_longest_bond(backbone))]
    for name, path, points, radius in cases:
        rows = json.loads(kds("collide", path, "--method", "wrapped,layered", "--radius", repr(float(radius)), "--json", "-"))
        for row in rows["rows"]:
            root = tree_over(points, radius, row["method"] == "layered")
            pairs = separating_pairs(root, 2)
            check(f"family of {name}, {row['method']}", row["family"], len(pairs))
            check(f"family of {name}, {row['method']}, covers each pair once", True, covers_once(points, radius, pairs, 2))


def spiral(beads, turns, rolled, bond=1.998):
    """A logarithmic spiral: curvature k / s at arc length s, from a quarter of its length on."""
    length = bond * (beads - 1)
    arc = length / 4 + bond * numpy.arange(beads)
    k = 2 * numpy.pi * turns * rolled / numpy.log(5)
    plane = arc * numpy.exp(1j * k * numpy.log(arc)) / (1 + 1j * k)
    return numpy.stack([plane.real, plane.imag, numpy.zeros(beads)], 1)


def compare_tables():
    """Sets, edges, changed bases and changed cells, which the scripts of the paper must find."""
    counts = Path(__file__).resolve().parents[1] / "paper"
    table4, table6 = (json.loads((counts / f"table{table}.json").read_text()) for table in (4, 6))
    villin = read_dcd(os.path.join(DATA, "trajectories/villin_hp36_300K.dcd"))
    random = read_dcd(os.path.join(DATA, "trajectories/random100_400K_first200.dcd"))
    extended = read_backbone(os.path.join(DATA, "paper/villin_hp36_collapse.pdb"))[None]
    conformations = [(spiral(1000, 16, 0.001 + 0.999 * frame / 49), None) for frame in (0, 25, 49)]
    for frames, at in ((extended, 0), (villin, 0), (villin, 999), (random, 0), (random, 100), (random, 199)):
        conformations.append((frames[at], half_longest_bond(frames)))
    for (name, row), (points, radius) in zip(table4.items(), conformations):
        name = f"table 4, {name}"
        for kind in ("wrapped", "layered"):
            pairs = separating_pairs(tree_over(points, 0.0, kind == "layered"), 1)
            check(f"{name}, {kind} set", row[f"{kind}_pairs"], len(pairs))
            if radius is not None:
                pairs = separating_pairs(tree_over(points, radius, kind == "layered"), 2)
                check(f"{name}, {kind} family", row[f"{kind}_family"], len(pairs))
        if Delaunay:
            check(f"{name}, edges", row["edges"], edge_count(points))

    later = read_dcd(os.path.join(DATA, "paper/random100_400K_900to932.dcd"))
    trees = {}
    for name, row in table6.items():
        name, frame = f"table 6, {name}", int(name.split(", ")[-1].split()[0])
        for at in (0, frame):
            trees[at] = trees.get(at) or [node.basis for node in tree_over(later[at], 0.0).nodes()]
        changed = sum(one != other for one, other in zip(trees[0], trees[frame]))
        check(f"{name}, bases changed", row["bases_changed"], changed)
        if Delaunay:
            cells = [set(map(frozenset, delaunay_cells(later[at]).simplices.tolist())) for at in (0, frame)]
            check(f"{name}, cells changed", row["cells_changed"], len(cells[1] - cells[0]))


def contact_intervals(frames, cutoff, apart):
    """Returns for each pair the times in contact on straight paths between frames, an array of beginnings and ends."""
    found = []
    for i, j in itertools.combinations(range(frames.shape[1]), 2):
        if j - i < apart:
            continue
        between = frames[:, i] - frames[:, j]
        start, change = between[:-1], numpy.diff(between, axis=0)
        a = numpy.maximum((change**2).sum(1), 1e-30)  # beads that do not move keep their distance
        b, c = (start * change).sum(1), (start**2).sum(1) - cutoff**2
        roots = numpy.sqrt(numpy.maximum(b**2 - a * c, 0))
        first, last = numpy.maximum((-b - roots) / a, 0), numpy.minimum((-b + roots) / a, 1)
        merged = []
        for step in numpy.flatnonzero((b**2 > a * c) & (first < last)):
            if merged and first[step] == 0 and merged[-1][1] == step:
                merged[-1][1] = step + last[step]
            else:
                merged.append([step + first[step], step + last[step]])
        found.append(merged)
    return found


def compare_lifetimes():
    """Contacts of C-alpha atoms by three definitions, and their correlation functions from all pairs of intervals."""
    counts = json.loads((Path(__file__).resolve().parents[1] / "paper" / "lifetimes.json").read_text())
    calpha = read_dcd(os.path.join(DATA, "trajectories/villin_hp36_300K.dcd"))[:, 1::3]
    for stride in (1, 4):
        frames = calpha[::stride]
        length, lag = stride * (len(frames) - 1), 50
        inner, outer = ([[(stride * begin, stride * end) for begin, end in pair]
                         for pair in contact_intervals(frames, cutoff, 3)] for cutoff in (8, 10))
        bridged = [[] for _ in inner]
        for all_of_pair, pair in zip(bridged, inner):
            for begin, end in pair:
                if all_of_pair and begin - all_of_pair[-1][1] < 5:
                    begin = all_of_pair.pop()[0]
                all_of_pair.append((begin, end))
        dual = [[(min(within), end) for begin, end in wide if (within := [at for at, _ in near if begin <= at <= end])]
                for near, wide in zip(inner, outer)]
        for way, pairs in (("one cutoff", inner), ("gap", bridged), ("two cutoffs", dual)):
            name = f"villin, C-alpha, {way}, stride {stride}"
            row, every = counts[name], [contact for pair in pairs for contact in pair]
            time = sum(end - begin for begin, end in every)
            seen = sum(max(min(end, length - lag) - begin, 0) for begin, end in every)
            still = sum(max(end - begin - lag, 0) for begin, end in every)
            again = sum(max(min(end, last) - max(begin, first), 0) for pair in pairs for first, last in pair
                        for begin, end in ((begin + lag, end + lag) for begin, end in pair))
            check(f"{name}, contacts", row["contacts"], len(every))
            ends = sum(end < length for _, end in every)
            for figure, value in (("residence", time / ends), ("S", still / seen), ("C", again / seen)):
                check(f"{name}, {figure} is {value}", True, bool(abs(row[figure] / value - 1) < 1e-7))


# --- steps of experiments/paper/peers.py ---


def excesses(frames, radius):
    """Returns mean excess volumes at four random times."""
    random = numpy.random.default_rng(1)
    found = {}

    def add(name, values):
        found.setdefault(name, []).append(numpy.mean(values))

    for time in numpy.sort(random.integers(len(frames) - 1, size=4) + random.integers(1, 1024, size=4) / 1024):
        step, u = int(time), time % 1
        before, after = frames[step], frames[step + 1]
        here = (1 - u) * before + u * after
        smallest = list(tree_over(here, radius).nodes())
        beads = [slice(node.first, node.last + 1) for node in smallest]
        most = [numpy.linalg.norm(after[one] - before[one], axis=1).max() for one in beads]
        for name, at_frames, layered in (("chords", "updated", False), ("layered_chords", "layered", True)):
            first, last = (list(tree_over(frame, radius, layered).nodes()) for frame in (before, after))
            cubes = [one.radius**3 for one in smallest]
            blended = [(1 - u) * a.radius + u * b.radius for a, b in zip(first, last)]
            add(f"{name}_excess", [radius_here**3 / cube - 1 for radius_here, cube in zip(blended, cubes)])
            add(f"{at_frames}_inflated", [(a.radius + moved) ** 3 / cube - 1 for a, moved, cube in zip(first, most, cubes)])
            add(f"{at_frames}_outside", [numpy.linalg.norm(here[one] - a.center, axis=1).max() + radius > a.radius * (1 + 1e-9)
                                         for a, one in zip(first, beads)])
        sides = [numpy.array([numpy.ptp(frame[one], axis=0) + 2 * radius for one in beads]) for frame in (here, before, after)]
        volumes = sides[0].prod(1)
        add("boxes_excess", ((1 - u) * sides[1] + u * sides[2]).prod(1) / volumes - 1)
        add("boxes_inflated", (sides[1] + 2 * numpy.array(most)[:, None]).prod(1) / volumes - 1)
        add("boxes_box_per_sphere", volumes / [4 / 3 * numpy.pi * one.radius**3 for one in smallest])
    return {name: float(numpy.mean(values)) for name, values in found.items()}


def compare_peers():
    """Contacts, those that frames miss, and excess volumes, which peers.py must find."""
    expected = json.loads((Path(__file__).resolve().parents[1] / "paper" / "peers.json").read_text())
    chain = os.path.join(FOLDER, "moving.xyz")
    kds("generate", "random-chain", "--beads", "100", "--frames", "513", "--step", "0.1", "-o", chain, "--quiet")
    files = {"villin": "villin_hp36_300K", "random100": "random100_400K_first200", "dhodh": "dhodh363_1000K_first20"}
    moving = {name: read_dcd(os.path.join(DATA, f"trajectories/{file}.dcd")) for name, file in files.items()}
    cases = [(name, frames[:17], half_longest_bond(frames)) for name, frames in moving.items()]
    for name, frames, own_radius in [*cases, ("chain 100", read_frames(chain), 1.0)]:
        row, radius = expected[name], 2.5 * own_radius
        intervals = [contact for pair in contact_intervals(frames, 2 * radius, 5) for contact in pair]
        begins, ends = sum(begin > 1e-9 for begin, _ in intervals), sum(end < len(frames) - 1 for _, end in intervals)
        for kind, count in (("begins", begins), ("ends", ends), ("contacts", len(intervals))):
            check(f"peers, {name}, {kind}", row[kind], count)
        for stride in (1, 2, 4, 8):
            missed = sum(-(-begin // stride) * stride > end for begin, end in intervals)
            check(f"peers, {name}, missed at stride {stride}", round(row[f"missed_{stride}"] * row["contacts"], 6), missed)
        if cKDTree:
            pairs = [cKDTree(frame).query_pairs(2 * radius, output_type="ndarray") for frame in frames]
            check(f"peers, {name}, pairs", row["pairs"], sum(int((two[:, 1] - two[:, 0] >= 5).sum()) for two in pairs))
        if name in ("villin", "random100"):
            for column, value in excesses(frames, own_radius).items():
                check(f"peers, {name}, {column} is {value}", True, bool(abs(row[column] - value) < 2e-6))


def compare_spirals():
    """Sets between two spirals, the second one shifted across the plane until the nearest beads are a gap apart."""
    counts = json.loads((Path(__file__).resolve().parents[1] / "paper/spirals.json").read_text())
    for stage, step in (("extended", 1), ("half rolled", 500), ("rolled", 1000)):
        points = spiral(1000, 18, 0.001 + 0.999 * step / 1000)
        for gap in (0, 8, 64, 512):
            moved = points + [0, 0, 2 + gap]
            for kind in ("wrapped", "layered"):
                roots = [tree_over(places, 0.0, kind == "layered") for places in (points, moved)]
                row = f"{stage}, stacked, gap {gap}"
                found = len(separating_pairs(roots[0], other=roots[1]))
                check(f"spirals, {row}, {kind} set", counts[row][f"{kind}_pairs"], found)


def smallest_without_overlaps(u, v, known):
    """Returns the least number of pairs of disjoint nodes that cover each pair of beads of two nodes once."""
    if u is v:
        return sum(smallest_without_overlaps(a, b, known) for a, b in itertools.combinations_with_replacement(u.children, 2))
    key = u.first, u.last, v.first, v.last
    if v.last - u.first < 2 or key in known:
        return known.get(key, 0)
    if numpy.linalg.norm(u.center - v.center) > u.radius + v.radius:
        known[key] = 1
    else:
        splits = [[(child, v) for child in u.children], [(u, child) for child in v.children]]
        sizes = [sum(smallest_without_overlaps(*pair, known) for pair in split) for split in splits if split]
        known[key] = min(sizes, default=0)
    return known[key]


def smallest_by_program(root, points, radius, by_place):
    """Returns the least sum of weights of pairs of disjoint nodes. Those over two disjoint beads sum to 1 or more."""
    count = len(points)
    nodes = [*root.nodes(), *(Node(points, bead, bead, radius, False) for bead in range(count))]
    apart = numpy.linalg.norm(points[:, None] - points[None, :], axis=2) > 2 * radius
    asked = numpy.triu(apart, 2).ravel()
    beads = numpy.arange(count)
    held = [numpy.linalg.norm(points - node.center, axis=1) + radius <= node.radius * (1 + 1e-12) if by_place
            else (beads >= node.first) & (beads <= node.last) for node in nodes]
    columns = []
    for (u, in_u), (v, in_v) in itertools.combinations(zip(nodes, held), 2):
        if numpy.linalg.norm(u.center - v.center) > u.radius + v.radius:
            both = numpy.outer(in_u, in_v)
            columns.append(numpy.flatnonzero((both | both.T).ravel()[asked]))
    starts = numpy.cumsum([0, *map(len, columns)])
    matrix = csc_matrix((numpy.ones(starts[-1]), numpy.concatenate(columns), starts), (int(asked.sum()), len(columns)))
    return linprog(numpy.ones(len(columns)), -matrix, -numpy.ones(matrix.shape[0]), method="highs").fun


def compare_bounds():
    """Families of a small protein: found, smallest without overlaps, and bounds by a program of all pairs of nodes."""
    counts = json.loads((Path(__file__).resolve().parents[1] / "paper/families.json").read_text())
    points = read_backbone(os.path.join(DATA, "proteins/1l2y.pdb"))
    radius = half_longest_bond(points) * (1 + 1e-12)
    for kind in ("wrapped", "layered"):
        root = tree_over(points, radius, kind == "layered")
        expected = counts[f"protein, 1l2y, 60 beads, {kind}"]
        check(f"families of 1l2y, {kind}, found", expected["found"], len(separating_pairs(root, 2)))
        check(f"families of 1l2y, {kind}, without overlaps", expected["without_overlaps"],
              smallest_without_overlaps(root, root, {}))
        for name, by_place in (("bound", False), ("bound_by_place", True)) if linprog else ():
            least = smallest_by_program(root, points, radius, by_place)
            check(f"families of 1l2y, {kind}, {name}", expected[name], math.ceil(least - 1e-6))


# --- structures of experiments/paper/structures.py ---


def compare_structures():
    """Family and compared pairs of spheres and boxes, and of the diagram, at the first frame of villin."""
    counts = json.loads((Path(__file__).resolve().parents[1] / "paper/structures.json").read_text())
    villin = read_dcd(os.path.join(DATA, "trajectories/villin_hp36_300K.dcd"))[:20]
    points = villin[0]
    for radius in (half_longest_bond(villin), 1.9):
        roots = {"wrapped": tree_over(points, radius), "layered": tree_over(points, radius, True),
                 "boxes": Box(points, 0, len(points) - 1, radius)}
        for name, root in roots.items():
            row = counts[f"villin, radius {radius:.3g}, {name}"]
            check(f"{name}, radius {radius:.3g}", (row["family"], row["pairs"]), larger_first(root, points, radius))
        if Delaunay:
            corners = Delaunay(points).simplices
            edges = numpy.unique(numpy.concatenate([corners[:, list(ends)] for ends in itertools.permutations(range(4), 2)]), axis=0)
            row = counts[f"villin, radius {radius:.3g}, power"]
            check(f"power, radius {radius:.3g}", row["pairs"], compared_along(edges, points, radius))


compare_families()
compare_tables()
compare_lifetimes()
compare_spirals()
compare_bounds()
compare_peers()
compare_structures()
print(f"{CHECKS - len(FAILURES)} of {CHECKS} counts agree")
sys.exit(1 if FAILURES else 0)
