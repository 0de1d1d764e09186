// Made-up results of each command, as small as their pages allow. `node tests/sample_results.mjs FOLDER` writes them.
import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const input = { files: ["data/a.dcd"], beads: 15, frames: 10, dimension: 3, truncated: false, length_unit: "angstrom", first_frame: 0, last_frame: 9, radius_min: 1, radius_max: 1 };
const common = (command, more = {}) => ({ command: `kds ${command} data/a.dcd`, version: "1",
    machine: { cpu: "a", cores: 2, os: "b", compiler: "c" }, settings: { topology: "a.pdb" }, input, warnings: [], ...more });
const bounds = (name, value, lower = null, upper = null) =>
  ({ [name]: value, [`${name}_lower`]: lower, [`${name}_upper`]: upper });

const pair = (i, j, contacts, occupancy, longest) =>
  ({ i, j, first: `LEU ${i + 1}`, second: `<b>&_${j + 1}`, contacts,
    ...bounds("occupancy", occupancy, occupancy - 0.04, Math.min(1, occupancy + 0.03)),
  ...bounds("residence", 80, 60, 90), ...bounds("begin_rate", 0.1, 0.05, 0.2), ...bounds("end_rate", 0.01, 0.005, 0.02),
  total: 500, longest,
  first_begin_frame: 0, last_end_frame: 9, first_begin_picoseconds: 0, last_end_picoseconds: 900, open_at_start: true,
  open_at_end: false, unit: "ps" });
const looked = (spacing, found, length) => ({ spacing, samples: spacing && 100 / spacing, found, plain_contacts: found ?? 92,
    plain_length: length, plain_occupancy: 0.3,
  bridged_contacts: found && found - 5, bridged_length: found && length + 9, bridged_occupancy: found && 0.31 });

const contacts = { ...common("contacts"), settings: { cutoff: "6", intermittency: 1 }, by: "residue", unit: "ps",
  elements: 5, names: ["LEU 1", "LEU 2", "LEU 3", "LEU 4", "<b>&_5"], run_length: 900,
  all: { pairs: 2, pairs_asked: 10, contacts: 92, open_at_start: 1, open_at_end: 0, open_at_both: 0,
    ...bounds("occupancy", 0.3, 0.2, 0.4), ...bounds("residence", 85.2, 74, 97), ...bounds("median", 3, 2, 4) },
  rows: [pair(0, 3, 90, 0.5, 40), pair(1, 4, 2, 0.96, 500)],
  frames: [looked(null, null, 85), looked(1, 90, 90), looked(8, 40, 200)],
  survival: [{ length: 1, at_risk: 91, survival: 0.7, lower: 0.6, upper: 0.8 },
    { length: 500, at_risk: 1, survival: 0, lower: null, upper: null }],
  course: [{ frame: 0, picoseconds: 0, contacts: 1.5 }, { frame: 5, picoseconds: 500, contacts: 1.2 }],
  warnings: ["a warning of <i>kds</i>"] };

const looks = (stride, missed, fraction, lower, upper) =>
  ({ cutoff: 6, stride, frames: 100 / stride, contacts: 100, found: 100 - missed, missed,
    ...bounds("missed_fraction", fraction, lower, upper) });
const missed = { ...common("missed"), rows: [looks(1, 0, 0), looks(2, 20, 0.2, 0.15, 0.25), looks(8, 67, 0.67, 0.61, 0.72)] };
const missed_none = { ...common("missed"), rows: [{ factor: 1, stride: 1, frames: 10, contacts: 0, found: 0, missed: 0,
    ...bounds("missed_fraction", null) }] };

const changed = (structure, file, stride, perStep, lower, upper) =>
  ({ structure, input: `data/${file}`, stride, motion: "linear", beads: 15, steps: 60, events: Math.round(60 * perStep),
    enter: 3, leave: 4, interchange: null, internal: 0, efficiency: 1,
  net_changes: 5, ...bounds("events_per_net_change", 1.2), ...bounds("events_per_step", perStep, lower, upper),
  compactness: 3, locality: 2, seconds: 0.1, seconds_least: 0.1, seconds_most: 0.2 });
const compare = { ...common("compare"), input: undefined,
  inputs: ["a.dcd", "b.dcd"].map((name) => ({ file: `data/${name}`, name: `data/${name}`, beads: 15, frames: 61,
    frame_picoseconds: 2 })), pooled: [],
  rows: [changed("wrapped", "a.dcd", 1, 9, 8, 10), changed("wrapped", "a.dcd", 2, 12, 10, 14),
    changed("wrapped", "b.dcd", 1, 12), changed("contacts", "a.dcd", 1, 0), changed("contacts", "b.dcd", 1, 0)] };

const structure = (events, seconds) => ({ events, internal: ["wander"],
    certificates: { created: 9, never_failing: 1, cancelled: 1, failed: 5, peak: 2, per_bead_max: 2 },
    stages: { isolation: 4 }, seconds, build_seconds: 0.01, static_seconds: 2, rebuilds: 0, audits: { run: 10, failed: 0 } });
const run = { ...common("run"), structures: { wrapped: structure({ total: 180, enter: 90, leave: 80, pivot: 10 }, 1),
    power: { ...structure({ total: 90, "2-3": 50, "3-2": 40, wander: 3 }, 3),
    over_time: { steps: 3, events: [20, 30, 40], frames: [0, 3, 6] } } }, engine: {}, fingerprint: "0" };

const setting = (name, seconds, ratio, pareto, radius) =>
  ({ want: "cages", setting: name, pareto, cost: { seconds, seconds_least: 0.9 * seconds, seconds_most: 1.1 * seconds, ratio,
    events: 5, certificates: 9, tests: null, memory: 2e6 },
  error: { displacement: 0, radius_mean: radius, radius_max: 3 * radius, beads_outside: 0, events_missed: null } });
const trade = { ...common("trade"), settings: { rounds: 5, times: 200 },
  recommendations: [{ row: 1, sentence: "For cages, `wrapped --between chord` is 4 times as fast as the exact run: radii are 0.02% from the smallest on average." }],
  rows: [setting({ structures: "wrapped" }, 2e-4, 1, true, 0),
    { ...setting({ structures: "wrapped", between: "chord" }, 5e-5, 0.25, true, 2e-4),
      cost: { seconds: 5e-5, seconds_least: 4e-5, seconds_most: 6e-5, ratio: 0.25, memory: 1e6 } },
    setting({ structures: "wrapped", stride: "2" }, 1e-4, 0.5, false, 0.02)] };

const method = (name, seconds) => ({ method: name, pairs: 3, closest: { frame: 1, i: 0, j: 5, distance: -0.3 }, family: null,
    colliding_frames: 1, seconds, seconds_least: seconds, seconds_most: 2 * seconds, closest_seconds: null });
const collide = { ...common("collide"), input: { ...input, frames: 2 }, settings: { apart: 2, within: 0 },
  rows: [method("brute", 2e-5), method("cells", 1e-5)],
  course: [{ frame: 0, collide: false, pairs: 0, closest: { i: 0, j: 5, distance: 0.2 } },
    { frame: 1, collide: true, pairs: 3, closest: { i: 0, j: 5, distance: -0.3 } }],
  map: { beads_in_group: 1, groups: [{ i: 0, j: 5, pairs: 1 }, { i: 2, j: 9, pairs: 2 }] }, names: { 0: "LEU 42 CA" } };

const task = (k, file, cutoff, life, lower, upper) =>
  ({ task: `t${k}`, command: "contacts", input: `data/${file}`, cutoff, pairs: 3, contacts: 9,
    ...bounds("residence", life, lower, upper), unit: "ps", by: "residue" });
const sweep = { kind: "sweep", command: "kds sweep collect s", version: "1", tasks: 5, done: 4, axes: ["cutoff"], pooled: [],
  left_out: { rows: 1 }, means: [], failed: [], warned: [], warnings: [],
  rows: [task(1, "a.dcd", "6", 50, 40, 60), task(2, "a.dcd", "8", 80, 70, 90), task(3, "b.dcd", "6", 20),
    task(4, "b.dcd", "8", 30)] };

const info = { ...common("info"), proper: true, necklaces: [{ file: "a.dcd", first: 0, last: 14 }],
  rows: [{ condition: "connected", violations: 0, frames: 0, first_frame: null, holds: true }] };
const update = { ...common("update"), rows: [{ stride: 1, technique: "rebuild", steps: 9, ratio: 1 },
    { stride: 1, technique: "kinetic", steps: 9, ratio: 0.4 }] };

// A table of many rows.
const contacts_many = { ...contacts, elements: 504, names: Array.from({ length: 504 }, (_, k) => `LEU ${k + 1}`),
  rows: Array.from({ length: 500 }, (_, k) => ({ ...pair(k, k + 4, 2, 0.5 + k / 2000, 9) })) };

export const samples = { contacts, contacts_many, missed, missed_none, compare, run, trade, collide, sweep, info, update };

if (import.meta.url === pathToFileURL(process.argv[1]).href)
  for (const [name, result] of Object.entries(samples)) await writeFile(join(process.argv[2], `${name}.json`),
    JSON.stringify(result));
