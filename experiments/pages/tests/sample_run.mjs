// A made-up run: chains that wind and meet. Its contacts are true; edges are the pairs nearer than a cutoff; bases of
// cages are the true ones at sampled times.

export function random(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 4294967296;
  };
}

const linear = (name, count, of = "beads") => ({ name, count, of });

// Returns the times in 0..1 at which two points that move linearly pass the distance `limit`.
function crossings(a0, a1, b0, b1, limit) {
  const from = a0.map((v, k) => v - b0[k]);
  const way = a1.map((v, k) => v - b1[k] - from[k]);
  const dot = (x, y) => x.reduce((sum, v, k) => sum + v * y[k], 0);
  const [a, b, c] = [dot(way, way), dot(from, way), dot(from, from) - limit * limit];
  if (a === 0 || b * b < a * c) return [];
  const root = Math.sqrt(b * b - a * c);
  return [(-b - root) / a, (-b + root) / a].filter((u) => u > 0 && u < 1);
}

const far = (a, b) => Math.hypot(...a.map((v, k) => v - b[k]));

// Returns the events of a layer of pairs that are nearer than `limit`.
function pairStructure(name, layer, kinds, frames, limit, takes) {
  const beads = frames[0].length;
  const initial = [];
  const events = [];
  for (let i = 0; i < beads; ++i) {
    for (let j = i + 1; j < beads; ++j) {
      if (!takes(i, j)) continue;
      let near = far(frames[0][i], frames[0][j]) <= limit;
      if (near) initial.push([i, j]);
      for (let s = 0; s + 1 < frames.length; ++s) {
        for (const u of crossings(frames[s][i], frames[s + 1][i], frames[s][j], frames[s + 1][j], limit)) {
          near = !near;
          events.push({
            step: s, lower: u - 1e-15, upper: u + 1e-15, kind: near ? 0 : 1, stage: 0, ids: [i, j],
            changes: [{ layer, removed: near ? [] : [[i, j]], added: near ? [[i, j]] : [] }],
          });
        }
      }
    }
  }
  return {
    name, stages: ["filter", "exact"], events, layers: [{ name: layer, arity: 2, initial }],
    kinds: kinds.map((kind) => ({
      name: kind, external: true, roles: layer === "edges" ? [linear("edge", 2)] : [linear("first", 1), linear("second", 1)],
    })),
  };
}

// Returns the smallest ball around some points of equal radii, as [basis, radius], by trying all bases.
function basisOf(points, beads, ballOf) {
  let best = null;
  const tryBasis = (basis) => {
    const ball = ballOf(basis.map((b) => points[b]));
    if (!ball || (best && ball.radius >= best.radius - 1e-12)) return;
    if (beads.every((b) => far(points[b], ball.centre) <= ball.radius + 1e-9)) best = { basis, radius: ball.radius };
  };
  for (let i = 0; i < beads.length; ++i)
    for (let j = i + 1; j < beads.length; ++j) {
      tryBasis([beads[i], beads[j]]);
      for (let k = j + 1; k < beads.length; ++k) tryBasis([beads[i], beads[j], beads[k]]);
    }
  return best?.basis ?? [beads[0], beads.at(-1)];
}

function circle(points) {
  if (points.length === 2) {
    const centre = points[0].map((v, k) => (v + points[1][k]) / 2);
    return { centre, radius: far(points[0], centre) };
  }
  // Barycentric weights of the circumcentre from the squared sides.
  const [a, b, c] = [far(points[1], points[2]) ** 2, far(points[0], points[2]) ** 2, far(points[0], points[1]) ** 2];
  const w = [a * (b + c - a), b * (c + a - b), c * (a + b - c)];
  const sum = w[0] + w[1] + w[2];
  if (Math.abs(sum) < 1e-12 || w.some((v) => v <= 0)) return null;
  const centre = points[0].map((_, k) => (w[0] * points[0][k] + w[1] * points[1][k] + w[2] * points[2][k]) / sum);
  return { centre, radius: far(points[0], centre) };
}

// Cages of a balanced tree, whose bases change at sampled times.
function cageStructure(frames) {
  const beads = frames[0].length;
  const nodes = [];
  const add = (first, last, level, parent) => {
    if (last - first < 2) return;
    const node = nodes.length;
    nodes.push([first, last, level, parent]);
    const middle = first + Math.ceil((last - first) / 2);
    add(first, middle, level + 1, node);
    add(middle, last, level + 1, node);
  };
  add(0, beads, 0, 0xffffffff);
  const at = (s, u) => (u === 0 ? frames[s] : frames[s].map((p, b) => p.map((v, k) => v + u * (frames[s + 1][b][k] - v))));
  const events = [];
  const initial = [];
  nodes.forEach(([first, last], node) => {
    const list = Array.from({ length: last - first }, (_, k) => first + k);
    let basis = basisOf(frames[0], list, circle);
    initial.push([node, ...basis]);
    for (let s = 0; s + 1 < frames.length; ++s) {
      for (const u of [0.13, 0.37, 0.62, 0.88]) {
        const next = basisOf(at(s, u), list, circle);
        if (String(next) === String(basis)) continue;
        const kind = next.length > basis.length ? 0 : next.length < basis.length ? 1 : 2;
        const time = u + 1e-4 * node;
        events.push({
          step: s, lower: time, upper: time, kind, stage: 1, ids: [first, last - 1, ...next],
          changes: [{ layer: "cages", removed: [[node, ...basis]], added: [[node, ...next]] }],
        });
        basis = next;
      }
    }
  });
  return {
    name: "wrapped", stages: ["filter", "exact"], events, nodes, layers: [{ name: "cages", arity: 5, initial }],
    kinds: ["enter", "leave", "pivot"].map((kind) => ({
      name: kind, external: true, roles: [linear("node", 2, "node"), linear("basis", 0)],
    })),
  };
}

// Structures of all other kinds, as they are at the first frame, and a root's sphere that grows from frame to frame.
function stillStructures(frames) {
  const [first] = frames;
  const beads = first.map((_, b) => b);
  const ends = (list) =>
    first[0].flatMap((_, axis) => {
      const sorted = [...list].sort((a, b) => first[a][axis] - first[b][axis]);
      return [sorted[0], sorted.at(-1)];
    });
  const half = beads.length / 2;
  const nodes = [[0, beads.length, 0, 0xffffffff], [0, half, 1, 0], [half, beads.length, 1, 0]];
  const supports = nodes.flatMap(([from, to], node) => ends(beads.slice(from, to)).map((bead, side) => [node, side, bead]));
  const pairs = beads.flatMap((i) => beads.slice(i + 1).map((j) => [i, j]));
  const closest = pairs.sort((a, b) => far(first[a[0]], first[a[1]]) - far(first[b[0]], first[b[1]]))[0];
  const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const hull = beads.flatMap((i) => beads.filter((j) => j !== i
      && beads.every((k) => turn(first[i], first[j], first[k]) >= 0)).map((j) => [i, j]));
  const order = [...beads].sort((a, b) => first[a][0] - first[b][0]).map((bead, rank) => [rank, bead]);
  const near = (...list) => list.every((a) => list.every((b) => far(first[a], first[b]) <= 3));
  const cliques = [beads.map((bead) => [bead])];
  for (let k = 1; k <= first[0].length; ++k)
    cliques.push(cliques[k - 1].flatMap((list) =>
      beads.filter((b) => b > list.at(-1) && near(...list, b)).map((b) => [...list, b])));
  const layers = ["balls", "links", "triangles", "tetrahedra"].slice(0, cliques.length)
    .map((name, k) => ({ name, arity: k + 1, initial: cliques[k] }));
  const voids = { name: "voids", arity: cliques.length, initial: cliques.at(-1).filter((_, k) => k % 3 === 0) };
  const still = (name, layer, initial, more = {}) =>
    ({ name, kinds: [], stages: [], events: [], layers: layer ? [{ name: layer, arity: initial[0].length, initial }] : [],
        ...more });
  return [
    still("sorted", "order", order),
    still("box", "ends", ends(beads).map((bead, end) => [end, bead])),
    still("hull", "hull", hull),
    still("closest", "closest", [closest]),
    still("boxes", "supports", supports, { nodes }),
    still("dual", null, [], { layers: [...layers, voids] }),
    still("layered", null, [], { nodes, spheres: { nodes: [0], frames: frames.map((_, f) => [[5, 1, 0.5, 6 + f]]) } }),
  ];
}

// Returns a run of structures without events, among them all that sampleRun lacks.
export function stillRun(settings) {
  const run = sampleRun(settings);
  return { ...run, structures: stillStructures(run.frames) };
}

// Returns a run for encodeReplay.
export function sampleRun({ beads = 24, frames = 10, dimension = 3, seed = 1, title = "Winding chains", cages = true } = {}) {
  const next = random(seed);
  const phases = Array.from({ length: 6 }, () => 2 * Math.PI * next());
  const half = Math.ceil(beads / 2);
  const place = (b, f) => {
    const side = b < half ? 1 : -1;
    const t = (b % half) / half;
    const s = (2 * Math.PI * f) / Math.max(1, frames - 1);
    const bend = Math.sin(3 * t + s + phases[side + 1]);
    const point = [half * 0.9 * t, side * (1.4 + 1.6 * Math.cos(s + 2 * t)) + 0.8 * bend, 1.5 * Math.sin(4 * t + s + phases[3])];
    return point.slice(0, dimension);
  };
  const positions = Array.from({ length: frames }, (_, f) => Array.from({ length: beads }, (__, b) => place(b, f)));
  const structures = [
    ...(cages ? [cageStructure(positions)] : []),
    pairStructure("power", "edges", ["2-3", "3-2"], positions, 2.6, () => true),
    pairStructure("contacts", "contacts", ["begin", "end"], positions, 1, (i, j) => j > i + 1),
  ];
  structures.at(-2).layers.push({ name: "hidden", arity: 1, initial: [] });
  const all = structures.flatMap(({ events }) => events);
  all.sort((a, b) => a.step - b.step || a.lower - b.lower);
  all.forEach((event, order) => (event.order = order));
  for (const { events } of structures) events.sort((a, b) => a.order - b.order);
  const names = Array.from({ length: beads }, (_, b) =>
    `${b < half ? "A" : "B"}/ALA${1 + Math.floor((b % half) / 3)}/${["N", "CA", "C"][b % 3]}`);
  return {
    title, dimension, frames: positions, radius: 0.5, names, necklaces: [half, beads - half], structures,
    times: positions.map((_, f) => 2 * f), frame_numbers: positions.map((_, f) => 100 + 5 * f), quantum: 0.001,
  };
}
