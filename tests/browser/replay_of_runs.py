"""Compares the replay page with the runs that it shows. Usage: replay_of_runs.py KDS DATA_FOLDER PLACE

The twin repeats the event log on the cells of the dump's first frame: it knows cells, bases and pairs, and neither
the layers nor the changes of the page.
"""
import csv
import itertools
import json
import os
import random
import subprocess
import sys

from chromium import Browser

OUTSIDE = 4294967295

STATES = """
  const states = [];
  for (const [name, ...place] of args[0]) {
    await kds[name](...place);
    const {step, u, edges, contacts, hidden, cages, positions} = kds.state();
    states.push({step, u, edges, contacts, hidden, cages, positions: args[1] ? [...positions] : []});
  }
  return states;
"""


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def rows(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))[1:]


class Twin:
    """The state of a run, from the dump of frame 0 and the lines of its log."""

    def __init__(self, dump):
        cells = [frozenset(map(int, row)) for row in rows(os.path.join(dump, "frame-0.power.csv"))]
        facets = [cell - {bead} for cell in cells for bead in cell]
        self.cells = set(cells) | {facet | {OUTSIDE} for facet in facets if facets.count(facet) == 1}
        self.hidden = {int(row[0]) for row in rows(os.path.join(dump, "frame-0.hidden.csv"))}
        wrapped = rows(os.path.join(dump, "frame-0.wrapped.csv"))
        self.bases = {(int(row[0]), int(row[1])): tuple(map(int, row[2].split())) for row in wrapped}
        self.nodes = {node: index for index, node in enumerate(self.bases)}
        start = [row for row in rows(os.path.join(dump, "contacts.csv")) if row[:3] == ["0", "0", "0"]]
        self.contacts = {(int(row[3]), int(row[4])) for row in start if row[5] == "begin"}

    def exchange(self, old, new):
        old, new = {frozenset(cell) for cell in old}, {frozenset(cell) for cell in new}
        check(old <= self.cells and not new & self.cells, f"the log exchanges cells that are not there: {old}")
        self.cells = self.cells - old | new

    def apply(self, structure, kind, ids):
        if structure == "wrapped":
            self.bases[ids[0], ids[1]] = tuple(ids[2:])
        elif structure == "contacts":
            if kind == "begin":
                self.contacts.add(tuple(ids))
            elif kind == "end":
                self.contacts.remove(tuple(ids))
        elif kind in ("2-3", "3-2"):
            triangle, edge = ids[:3], ids[3:]
            two = [(*triangle, bead) for bead in edge]
            three = [(*pair, *edge) for pair in itertools.combinations(triangle, 2)]
            self.exchange(*((two, three) if kind == "2-3" else (three, two)))
        elif kind in ("4-1", "1-4"):
            cell, bead = ids[:4], ids[4]
            four = [(*facet, bead) for facet in itertools.combinations(cell, 3)]
            self.exchange(*((four, [cell]) if kind == "4-1" else ([cell], four)))
            self.hidden ^= {bead}
        else:
            check(kind == "wander", f"an event that the twin does not know: {structure} {kind}")

    def state(self):
        edges = {pair for cell in self.cells for pair in itertools.combinations(sorted(cell), 2) if OUTSIDE not in pair}
        cages = {(self.nodes[node], *basis) for node, basis in self.bases.items()}
        return {"edges": edges, "hidden": set(self.hidden), "contacts": set(self.contacts), "cages": cages}


def elements(state):
    """Returns a state of the page as sets."""
    pairs = {name: {tuple(element) for element in state[name]} for name in ("edges", "contacts")}
    cages = {tuple(id for id in cage if id != OUTSIDE) for cage in state["cages"]}
    return {**pairs, "hidden": set(state["hidden"]), "cages": cages}


def expect(state, twin, where):
    for name, expected in twin.items():
        found = elements(state)[name]
        check(found == expected, f"{name} {where}: the page lacks {expected - found} and has {found - expected} more")


def run_program(kds, *arguments):
    subprocess.run([kds, *arguments, "--quiet"], check=True)


def states_are_those_of_the_run(browser, kds, data, place):
    replay, dump, log = (os.path.join(place, name) for name in ("replay.html", "dump", "run.kdslog"))
    villin = os.path.join(data, "trajectories", "villin_hp36_300K")
    frames = 80
    run_program(kds, "run", villin + ".dcd", "--topology", villin + ".pdb", "--frames", f":{frames}", "--structures",
                "wrapped,power,contacts", "--radius", "2.3", "--view", replay, "--dump", dump, "--log", log, "--replace")
    twin = Twin(dump)
    structures, counts, events, frames_seen = ["wrapped", "power", "contacts"], [0, 0, 0], [], [twin.state()]
    chosen = set()
    with open(log) as file:
        lines = [line.split() for line in file.readlines()[2:]]
    lines = [line for line in lines if line[0] not in ("step", "end")]
    chosen = set(random.Random(1).sample(range(len(lines)), 200))
    for order, (step, structure, kind, lower, upper, *ids) in enumerate(lines):
        while len(frames_seen) <= int(step):
            frames_seen.append(twin.state())
        twin.apply(structure, kind, list(map(int, ids)))
        s = structures.index(structure)
        if order in chosen:
            events.append((s, counts[s], int(step), (float(lower) + float(upper)) / 2, twin.state()))
        counts[s] += 1
    while len(frames_seen) < frames:
        frames_seen.append(twin.state())
    check(min(counts) > 20, f"too few events: {counts}")

    browser.open(replay)
    random.Random(2).shuffle(events)
    for begin in range(0, len(events), 50):
        batch = events[begin:begin + 50]
        states = browser.wait(STATES, [["seekEvent", s, event] for s, event, *_ in batch], False)
        for (s, event, step, u, state), shown in zip(batch, states):
            where = f"at event {event} of {structures[s]}"
            check(shown["step"] == step and abs(shown["u"] - u) < 1e-9, f"{where}: the page stands at another time")
            expect(shown, state, where)
    at = random.Random(3).sample(range(1, frames), 30)
    for frame, shown in zip(at, browser.wait(STATES, [["seek", frame - 1, 1] for frame in at], False)):
        expect(shown, frames_seen[frame], f"at frame {frame}")
        cells = [sorted(map(int, row)) for row in rows(os.path.join(dump, f"frame-{frame}.power.csv"))]
        check(elements(shown)["edges"] == {pair for cell in cells for pair in itertools.combinations(cell, 2)},
              f"edges at frame {frame} are not those of the dump")
        bases = [tuple(map(int, row[2].split())) for row in rows(os.path.join(dump, f"frame-{frame}.wrapped.csv"))]
        check(elements(shown)["cages"] == {(node, *basis) for node, basis in enumerate(bases)},
              f"bases at frame {frame} are not those of the dump")


def positions_are_on_the_curves(browser, kds, place):
    """Beads of a Hermite motion stand where the cubic curve through the frames has them."""
    rng = random.Random(4)
    beads, frames = 9, 7
    points = [[[rng.uniform(-9, 9) for _ in range(3)] for _ in range(beads)] for _ in range(frames)]
    trajectory, replay = os.path.join(place, "made.xyz"), os.path.join(place, "made.html")
    with open(trajectory, "w") as file:
        for frame in points:
            file.write(f"{beads}\nframe\n" + "".join(f"C {x!r} {y!r} {z!r}\n" for x, y, z in frame))
    run_program(kds, "view", trajectory, "--radius", "1", "--motion", "hermite", "--structures", "contacts", "-o", replay)
    browser.open(replay)
    times = [(rng.randrange(frames - 1), rng.random()) for _ in range(40)] + [(0, 0), (frames - 2, 1)]
    for (step, u), state in zip(times, browser.wait(STATES, [["seek", *time] for time in times], True)):
        for bead in range(beads):
            for axis in range(3):
                p = [points[frame][bead][axis] for frame in range(frames)]
                slope = [(p[min(k + 1, frames - 1)] - p[max(k - 1, 0)]) / (min(k + 1, frames - 1) - max(k - 1, 0))
                         for k in (step, step + 1)]
                a, b = p[step], p[step + 1]
                place_of = (2 * u**3 - 3 * u**2 + 1) * a + (u**3 - 2 * u**2 + u) * slope[0] \
                    + (3 * u**2 - 2 * u**3) * b + (u**3 - u**2) * slope[1]
                shown = state["positions"][3 * bead + axis]
                check(abs(shown - place_of) < 0.011, f"bead {bead} at {step}, {u}: {shown}, expected {place_of}")


def instances_are_shown(browser, kds, data, place):
    """Points in the plane on cubic curves, and weighted points of which some are hidden."""
    for name in ("d2_n20_degree3", "w3_n50_linear"):
        replay, dump = os.path.join(place, name + ".html"), os.path.join(place, name)
        source = os.path.join(data, "kinetic", name + ".txt")
        run_program(kds, "run", source, "--structures", "power", "--view", replay, "--dump", dump, "--replace")
        with open(source) as file:
            beads, columns, degree = map(int, file.readline().split())
            numbers = [list(map(float, line.split())) for line in file if line.strip()]
        dimension = min(columns, 3)
        browser.open(replay)
        quantum = browser.run("return JSON.parse(document.getElementById('kds-replay').textContent).quantum")
        times = [0, 0.125, 0.4, 0.77, 1]
        states = browser.wait(STATES, [["seek", 0, u] for u in times], True)
        for u, state in zip(times, states):
            for bead in range(beads):
                for axis in range(dimension):
                    points = numbers[bead][axis * (degree + 1):(axis + 1) * (degree + 1)]
                    while len(points) > 1:  # de Casteljau
                        points = [(1 - u) * a + u * b for a, b in zip(points, points[1:])]
                    shown = state["positions"][3 * bead + axis]
                    check(abs(shown - points[0]) < 0.51 * quantum + 1e-6 * abs(shown), f"{name}: bead {bead} at {u}")
        cells = [sorted(map(int, row)) for row in rows(os.path.join(dump, "frame-1.power.csv"))]
        shown = elements(states[-1])
        check(shown["edges"] == {pair for cell in cells for pair in itertools.combinations(cell, 2)}, f"edges of {name}")
        hidden = {int(row[0]) for row in rows(os.path.join(dump, "frame-1.hidden.csv"))}
        check(shown["hidden"] == hidden and bool(hidden) == (columns == 4), f"hidden beads of {name}: {hidden}")


SHARE_DRAWN = """
  await kds.seek(0, args[0]);
  const scene = document.getElementById('scene');
  const context = new OffscreenCanvas(scene.width, scene.height).getContext('2d');
  context.drawImage(scene, 0, 0);
  const {data} = context.getImageData(0, 0, scene.width, scene.height);
  let drawn = 0;
  for (let k = 0; k < data.length; k += 4) drawn += data[k] !== data[0] || data[k + 1] !== data[1] || data[k + 2] !== data[2];
  return drawn / (data.length / 4);
"""


class OtherTwin:
    """The state of the other structures, from the dump of frame 0 and the lines of a log."""

    def __init__(self, dump, frame=0):
        def read(name):
            path = os.path.join(dump, f"frame-{frame}.{name}.csv")
            return rows(path) if os.path.exists(path) else []

        self.order = [int(row[0]) for row in read("sorted")]
        self.ends = [int(bead) for row in read("box") for bead in row[1:3]]
        self.hull = {int(row[0]) for row in read("hull")}
        self.closest = [tuple(map(int, row)) for row in read("closest")]
        boxes = read("boxes")
        self.nodes = {(int(row[0]), int(row[1])): index for index, row in enumerate(boxes)}
        self.supports = {(node, side): int(bead) for row in boxes for node in [self.nodes[int(row[0]), int(row[1])]]
                         for side, bead in enumerate(row[2].split())}

    def apply(self, structure, kind, ids):
        if structure == "sorted":
            at = self.order.index(ids[0])
            check(self.order[at + 1] == ids[1], "the log exchanges beads that are not neighbours")
            self.order[at:at + 2] = [ids[1], ids[0]]
        elif structure == "box" and kind != "overtake":
            self.ends["min-x max-x min-y max-y min-z max-z".split().index(kind)] = ids[1]
        elif structure == "hull" and kind != "interchange":
            self.hull ^= {ids[0]}
        elif structure == "closest" and kind == "replace":
            self.closest = [tuple(ids[2:])]
        elif structure == "boxes":
            self.supports[self.nodes[ids[0], ids[1]], ids[2]] = ids[4]

    def state(self):
        return {"order": set(enumerate(self.order)), "ends": set(enumerate(self.ends)), "hull": set(self.hull),
                "closest": set(self.closest), "supports": {(*place, bead) for place, bead in self.supports.items()}}


def other_elements(state):
    found = {name: {tuple(element) for element in state[name]} for name in ("order", "ends", "closest", "supports")}
    corners = [corner for corner, _ in state["hull"]]
    check(sorted(corners) == sorted(after for _, after in state["hull"]), f"the hull is no circle: {state['hull']}")
    return {**found, "hull": set(corners)}


OTHERS = """
  const states = [];
  for (const [name, ...place] of args[0]) {
    await kds[name](...place);
    const sentence = document.getElementById("event-now").textContent;
    const {positions, ...state} = kds.state();
    const chips = [...document.querySelectorAll(".row")].map((row) => [...row.querySelectorAll(".chip")].map((chip) => [chip.textContent, chip.hidden]));
    states.push({...state, sentence, chips});
  }
  return states;
"""


def other_structures_are_those_of_the_run(browser, kds, data, place):
    """Order, box, hull, closest pair and boxes at random events and at frames; counts of kinds are those of the run."""
    villin = os.path.join(data, "trajectories", "villin_hp36_300K")
    protein = [villin + ".dcd", "--topology", villin + ".pdb", "--radius", "2.3"]
    for name, source, structures, frames in (
            ("line", [os.path.join(data, "kinetic", "d1_n50_degree3.txt")], "sorted,box", 2),
            ("plane", [os.path.join(data, "kinetic", "d2_n50_degree2.txt")], "sorted,box,hull,closest", 2),
            ("boxes", [*protein, "--frames", ":8"], "box,closest,boxes", 8),
            ("dops", [*protein, "--frames", ":4", "--directions", "7"], "boxes", 4)):
        replay, folder, dump, log = (os.path.join(place, name + ending) for ending in (".html", "", "-dump", ".kdslog"))
        run_program(kds, "run", *source, "--structures", structures, "--view", replay, "--dump", dump, "--log", log,
                    "--out", folder, "--replace")
        names, twin, wanted, counts = structures.split(","), OtherTwin(dump), [], {}
        with open(log) as file:
            lines = [line.split() for line in file.readlines()[2:]]
        lines = [line for line in lines if line[0] not in ("step", "end")]
        chosen = set(random.Random(5).sample(range(len(lines)), min(60, len(lines))))
        for order, (step, structure, kind, _, _, *ids) in enumerate(lines):
            ids = list(map(int, ids))
            twin.apply(structure, kind, ids)
            number = counts[structure] = counts.get(structure, -1) + 1
            if order in chosen:
                wanted.append((names.index(structure), number, ids, twin.state()))
        browser.open(replay)
        random.Random(6).shuffle(wanted)
        states = browser.wait(OTHERS, [["seekEvent", s, event] for s, event, *_ in wanted])
        for (s, event, ids, state), shown in zip(wanted, states):
            where = f"{name}, event {event} of {names[s]}"
            for layer, found in other_elements(shown).items():
                check(found == state[layer], f"{layer} at {where}: {found ^ state[layer]}")
            if name in ("line", "plane") and names[s] != "hull":
                check(all(f"ead {bead}" in shown["sentence"] for bead in ids), f"{where}: {shown['sentence']}")
        for frame in range(1, frames):
            shown = browser.wait(OTHERS, [["seek", frame - 1, 1]])[0]
            expected = OtherTwin(dump, frame).state()
            for layer, found in other_elements(shown).items():
                check(found == expected[layer], f"{layer} of {name} at frame {frame}: {found ^ expected[layer]}")
        with open(os.path.join(folder, "summary.json")) as file:
            summary = json.load(file)["structures"]
        for structure, chips in zip(names, shown["chips"]):
            events = dict(summary[structure]["events"])
            total = events.pop("total")
            visible = {text.split()[0]: int(text.split()[1].replace(",", "")) for text, hidden in chips if not hidden}
            check(sum(visible.values()) == total, f"{structure} of {name}: {visible} are not {total} events")
            check(all(events[kind] == number for kind, number in visible.items()), f"{structure}: {visible}, {events}")
        subtitle = browser.run("return document.getElementById('subtitle').textContent")
        total = sum(summary[structure]["events"]["total"] for structure in names)
        check(subtitle.endswith(f" {total:,} events"), f"{name}: {subtitle}, expected {total}")


MARKED = """
  await kds.seekEvent(...args);
  const scene = document.getElementById("scene");
  const context = new OffscreenCanvas(scene.width, scene.height).getContext("2d");
  context.drawImage(scene, 0, 0);
  const kind = document.querySelector("#event h3").textContent.split(/[ _]/).slice(1);
  const beads = [...document.querySelectorAll("#event-now span")].map((span) => parseInt(span.textContent.match(/[0-9]+/)));
  const middle = [0, 1].map((axis) => beads.reduce((sum, bead) => sum + kds.project(bead)[axis] / beads.length, 0));
  const {data} = context.getImageData(...middle.map((place) => Math.floor(place) - 3), 7, 7);  // larger than a gap between dashes
  return [kind, [0, 1].map((colour) => data.filter((_, k) => k % 4 === colour).reduce((sum, value) => sum + value))];
"""


def complexes_are_those_of_the_run(browser, kds, place):
    """Simplices at frames are those of the dump. A simplex that begins is marked green, one that ends red."""
    rng = random.Random(7)
    browser.size(1280, 800)
    for name, depth, shapes in (("discs", 0, 3), ("balls", 6, 4)):
        trajectory, replay, dump = (os.path.join(place, name + ending) for ending in (".xyz", ".html", "-dump"))
        with open(trajectory, "w") as file:
            for _ in range(4):
                points = [[rng.uniform(0, 12), rng.uniform(0, 9), rng.uniform(0, depth)] for _ in range(30)]
                file.write("30\nframe\n" + "".join(f"C {x} {y} {z}\n" for x, y, z in points))
        run_program(kds, "run", trajectory, "--radius", "1.6", "--structures", "dual", "--view", replay, "--dump", dump,
                    "--replace")
        browser.open(replay, "#layers=flashes&size=0.1")
        for frame, state in enumerate(browser.wait(OTHERS, [["seek", frame, 0] for frame in range(4)])):
            found = {tuple(beads) for layer in ("balls", "links", "triangles", "tetrahedra") for beads in state[layer]}
            dumped = {tuple(map(int, row[0].split())) for row in rows(os.path.join(dump, f"frame-{frame}.dual.csv"))}
            check(found == dumped and max(map(len, found)) == shapes, f"{name} at frame {frame}: {found ^ dumped}")
        seen = [tuple(browser.wait(MARKED, 1, event)) for event in range(0, 160, 8)]
        for (shape, way), (red, green) in seen:
            check(green > red if way == "begin" else red > green, f"{name}: {shape} {way} is {red} red and {green} green")
        check(len({tuple(kind) for kind, _ in seen}) >= 2 * (shapes - 1), f"{name}: {seen}")
    browser.size(480, 360)


def spheres_are_those_of_the_run(browser, kds, data, place):
    """Layered spheres and chords, at frames as dumped, and half way between two frames in the middle."""
    villin = os.path.join(data, "trajectories", "villin_hp36_300K")
    for structure, more in (("layered", []), ("wrapped", ["--between", "chord"])):
        replay, dump = os.path.join(place, structure + ".html"), os.path.join(place, structure + "-dump")
        run_program(kds, "run", villin + ".dcd", "--topology", villin + ".pdb", "--radius", "2.3", "--frames", ":5",
                    "--structures", structure, *more, "--view", replay, "--dump", dump, "--replace")
        frames = []
        for frame in range(5):
            table = rows(os.path.join(dump, f"frame-{frame}.{structure}.csv"))
            frames.append([[float(value) for value in row[-4:]] for row in table])
        browser.open(replay)
        for step in range(4):
            start, middle = browser.wait(OTHERS, [["seek", step, 0], ["seek", step, 0.5]])
            for k, (a, b) in enumerate(zip(frames[step], frames[step + 1])):
                for shown, expected in ((start, a), (middle, [(x + y) / 2 for x, y in zip(a, b)])):
                    sphere = shown["spheres"][k]["sphere"]
                    check(max(abs(x - y) for x, y in zip(sphere, expected)) < 0.011, f"{structure}, node {k}: {sphere}, {expected}")
        text = browser.run("return document.body.innerText")
        check("Next event to" not in text and "Press" not in text, "a page without events tells how to go to one")
        drawn = browser.wait(SHARE_DRAWN, 0.5)
        check(drawn > 0.05, f"{structure} covers {drawn} of the picture")


def one_frame_is_shown(browser, kds, data, place):
    villin, replay = os.path.join(data, "trajectories", "villin_hp36_300K"), os.path.join(place, "one.html")
    run_program(kds, "view", villin + ".pdb", "--radius", "2.3", "--structures", "wrapped,power", "-o", replay)
    browser.open(replay)
    check(len(browser.run("return kds.state().cages")) == 107, "one frame has no cages")
    check("One frame" in browser.run("return document.getElementById('event-now').textContent"), "no word of one frame")


def many_edges_are_drawn(browser, kds, place):
    """Above 20,000 edges, the page draws them as thin lines."""
    trajectory, replay = os.path.join(place, "many.xyz"), os.path.join(place, "many.html")
    run_program(kds, "generate", "random-chain", "--beads", "3500", "--frames", "2", "-o", trajectory)
    run_program(kds, "view", trajectory, "--radius", "1", "--structures", "power", "-o", replay)
    browser.open(replay, "#layers=edges")
    edges = len(browser.run("return kds.state().edges"))
    check(edges > 20000, f"there are {edges} edges only")
    drawn = browser.wait(SHARE_DRAWN, 0.5)
    check(0.05 < drawn < 0.9, f"edges cover {drawn} of the picture")
    browser.open(replay, "#layers=flashes")
    drawn = browser.wait(SHARE_DRAWN, 0.5)
    check(drawn < 0.01, f"without edges something covers {drawn} of the picture")


def main(kds, data, place):
    os.makedirs(place, exist_ok=True)
    with Browser(480, 360) as browser:  # drawing takes most of the time
        states_are_those_of_the_run(browser, kds, data, place)
        positions_are_on_the_curves(browser, kds, place)
        instances_are_shown(browser, kds, data, place)
        other_structures_are_those_of_the_run(browser, kds, data, place)
        complexes_are_those_of_the_run(browser, kds, place)
        spheres_are_those_of_the_run(browser, kds, data, place)
        one_frame_is_shown(browser, kds, data, place)
        many_edges_are_drawn(browser, kds, place)
        complaints, requests = browser.complaints(), browser.requests()
        check(not complaints, f"the page complains: {complaints}")
        check(not requests, f"the page asks the network: {requests}")
    print("passed")


if __name__ == "__main__":
    main(*sys.argv[1:])
