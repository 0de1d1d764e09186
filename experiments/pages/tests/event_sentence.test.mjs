import assert from "node:assert/strict";
import test from "node:test";
import { colourOfKind } from "../src/replay/colours.js";
import { EventFilter } from "../src/replay/event_filter.js";
import { noBead } from "../src/replay/events.js";
import { beadText, eventSentence, rangeText, sideText, textOf } from "../src/replay/event_sentence.js";
import { explainKind } from "../src/replay/explain.js";
import { RunState } from "../src/replay/run_state.js";
import { boxesOf } from "../src/replay/boxes.js";
import { loadRun } from "./load_run.mjs";
import { sampleRun } from "./sample_run.mjs";

const run = sampleRun({ beads: 24, frames: 8 });
const { state } = await loadRun(run);
const { names } = run;

const sentence = (structure, kind, ids, changes = []) => {
  const roles = Object.entries(ids).map(([name, list]) => ({ name, ids: list }));
  return eventSentence({ structure, kind, roles, changes, names, dimension: 3, several: false });
};

test("the sentence of a sphere names the bead that enters or leaves and the residues of the node", () => {
  const s = state.structures.findIndex(({ name }) => name === "wrapped");
  const { events } = state.structures[s];
  let pivots = 0;
  run.structures[s].events.forEach(({ changes, ids }, e) => {
    const [old, now] = [changes[0].removed[0].slice(1), changes[0].added[0].slice(1)];
    const [comes, goes] = [now.filter((b) => !old.includes(b)), old.filter((b) => !now.includes(b))];
    const said = eventSentence({
      structure: "wrapped", kind: events.kindOf(e).name, roles: events.rolesOf(e), changes: state.changesOf(s, e), names,
      dimension: 3, several: true,
    });
    assert.deepEqual([said.enters, said.leaves].map((list) => [...list].sort()), [comes, goes].map((list) => list.sort()));
    const text = textOf(said.parts, names, true);
    for (const bead of [...comes, ...goes]) assert.ok(text.includes(beadText(bead, names, true)), `${text} lacks bead ${bead}`);
    assert.ok(text.endsWith(`${rangeText(ids[0], ids[1], names, true)}.`), text);
    pivots += comes.length && goes.length ? 1 : 0;
  });
  assert.ok(pivots > 0);
});

test("names of beads and nodes are those of a molecule", () => {
  const made = ["A/LEU42/CA", "A/2MG7A/P", "B/GLY46/CA"];
  assert.equal(beadText(0, made, false), "LEU 42 CA");
  assert.equal(beadText(1, made, true), "2MG 7A P of A");
  assert.equal(beadText(7, null, false), "bead 7");
  assert.equal(rangeText(0, 1, made, false), "residues 42 to 7A");
  assert.equal(rangeText(0, 2, made, true), "beads 0 to 2");
  assert.equal(rangeText(3, 9, null, false), "beads 3 to 9");
  const said = sentence("wrapped", "enter", { node: [0, 8], basis: [1, 2, 4] },
    [{ name: "cages", removed: [0, 1, 2], added: [0, 1, 2, 4] }]);
  assert.equal(textOf(said.parts, names, false), "ALA 2 CA enters the sphere around residues 1 to 3.");
});

test("each structure has sentences that mark what comes and goes", () => {
  const cases = [
    ["boxes", "support", { node: [0, 5], side: [3], was: [1], is: [2] }, [2], [1]],
    ["power", "2-3", { triangle: [0, 1, 2], edge: [3, 4] }, [3, 4], []],
    ["power", "3-2", { triangle: [0, 1, 2], edge: [3, noBead] }, [], [3]],
    ["power", "2-2", { gone: [0, 1], new: [2, 3] }, [2, 3], [0, 1]],
    ["power", "4-1", { cell: [0, 1, 2, 3], bead: [4] }, [], [4]],
    ["power", "1-3", { cell: [0, 1, 2], bead: [4] }, [4], []],
    ["power", "wander", { bead: [4], cell: [0, 1, 2] }, [], []],
    ["dual", "vertex_end", { simplex: [3] }, [], [3]],
    ["dual", "edge_begin", { simplex: [3, 5] }, [3, 5], []],
    ["dual", "tetrahedron_end", { simplex: [1, 2, 3, 5] }, [], [1, 2, 3, 5]],
    ["voids", "component_end", { component: [4], simplex: [3] }, [], [3]],
    ["voids", "component_merge", { components: [0, 4], simplex: [3, 5] }, [3, 5], []],
    ["voids", "component_split", { components: [0, 4] }, [], []],
    ["voids", "void_begin", { void: [12], simplex: [1, 2, 3, 5] }, [], []],
    ["voids", "void_split", { voids: [2, 12], simplex: [1, 2, 3] }, [], []],
    ["voids", "tunnel_begin", { simplex: [3, 5] }, [3, 5], []],
    ["voids", "tunnel_begin", { simplex: [1, 2, 3] }, [], [1, 2, 3]],
    ["voids", "tunnel_end", { simplex: [3, 5] }, [], [3, 5]],
    ["contacts", "begin", { first: [1], second: [5] }, [1, 5], []],
    ["contacts", "end", { first: [1], second: [5] }, [], [1, 5]],
    ["crossings", "cross_plus", { first: [1, 2], second: [5, 6] }, [], []],
    ["sorted", "interchange", { first: [1], second: [5] }, [5], [1]],
    ["hull", "enter", { corner: [1], before: [2], after: [3] }, [1], []],
    ["hull", "leave", { corner: [1], before: [1], after: [1] }, [], [1]],
    ["closest", "replace", { was: [1, 2], is: [3, 4] }, [3, 4], [1, 2]],
    ["box", "max-y", { was: [1], is: [2] }, [2], [1]],
    ["box", "overtake", { was: [1], is: [2] }, [], []],
    ["power", "rebuild", { time: [1, 1] }, [], []],
    ["mine", "turn", { beads: [1] }, [], []],
  ];
  for (const [structure, kind, ids, enters, leaves] of cases) {
    const said = sentence(structure, kind, ids);
    assert.deepEqual([said.enters, said.leaves], [enters, leaves], `${structure} ${kind}`);
    const text = textOf(said.parts, names, false);
    assert.ok(/^[A-Z0-9m].*\.$/.test(text) && !text.includes("undefined"), text);
    for (const bead of [...enters, ...leaves]) assert.ok(text.includes(beadText(bead, names, false)), text);
  }
  assert.equal(sideText(3, 3), "high y");
  assert.equal(sideText(6, 3), "low oblique (direction 4)");
});

test("events of voids name the void and its gate, have colours of their own, and find the cells of the void", () => {
  const text = (kind, ids) => textOf(sentence("voids", kind, ids).parts, null, false);
  assert.equal(text("void_open", { void: [12], simplex: [3, 7, 9] }),
    "Void 12 opens to the outside through the gate of bead 3, bead 7 and bead 9.");
  assert.equal(text("void_merge", { voids: [2, 12] }), "Void 12 joins void 2.");
  assert.equal(text("tunnel_end", { simplex: [3, 7, 9] }), "A tunnel ends as the triangle of bead 3, bead 7 and bead 9 fills it.");
  const kinds = ["void_begin", "void_end", "void_merge", "void_split", "void_open", "void_close", "cell_begin", "cell_end"];
  const colours = new Set(kinds.map((kind, k) => colourOfKind("voids", kind, k)));
  for (const kind of ["tunnel_begin", "tunnel_end", "component_merge", "component_split"])
    assert.ok(explainKind("voids", kind) && !colours.has(colourOfKind("voids", kind, 0)), kind);
  const made = [["void_close", 7, 1, 2, 3], ["cell_end", 0, 1, 2, 3, 4], ["cell_begin", 7, 1, 2, 3, 5],
    ["cell_begin", 8, 1, 2, 3, 6]];
  const events = {
    count: 4, order: [5, 6, 7, 8], kindOf: (e) => ({ name: made[e][0] }), idsOf: (e) => Uint32Array.from(made[e].slice(1)),
  };
  const cells = (change) => RunState.prototype.cellsOfVoid.call({ structures: [{ events }] }, 0, 0, change);
  assert.deepEqual(["cell_begin", "cell_end"].map(cells), [[1, 2, 3, 5], [1, 2, 3, 4]]);
  events.order[2] = 9;  // of another time
  assert.deepEqual(cells("cell_begin"), []);
});

test("switched off and internal events are neither stepped to nor counted", () => {
  for (const { events } of state.structures) events.kinds = events.kinds.map((kind) => ({ ...kind }));
  state.structures[1].events.kinds[0].external = false;
  const filter = new EventFilter(state.structures);
  filter.words = ["0.1", "2"];
  const seen = [];
  state.seek(0, 0);
  for (let event = state.next(filter.stops); event; event = state.next(filter.stops)) {
    state.seekEvent(...event);
    seen.push(event.join("."));
  }
  const expected = run.structures.flatMap(({ events }, s) =>
    events.flatMap(({ kind, order }, e) => (s < 2 && !(s === 0 && kind === 1) && !(s === 1 && kind === 0)
        ? [{ order, name: `${s}.${e}` }] : [])),
  );
  assert.deepEqual(seen, expected.sort((a, b) => a.order - b.order).map(({ name }) => name));
  assert.equal(filter.counted(1), run.structures[1].events.filter(({ kind }) => kind === 1).length);
  assert.deepEqual(filter.words.sort(), ["0.1", "2"]);
  assert.ok(filter.hasInternal);
  filter.internal = true;
  filter.words = [];
  assert.equal(filter.stops[1].length, run.structures[1].events.length);
});

test("boxes reach to the balls that hold their sides", () => {
  const positions = [0, 1, 2, 5, 4, 3];
  const words = [7, 0, 0, 7, 1, 1, 7, 2, 0, 7, 3, 1, 7, 4, 0, 7, 5, 1, 7, 6, 0, 9, 0, 1];
  const [box, ...others] = boxesOf(words, 3, positions, (bead) => 0.5 + bead, (node) => node === 7);
  assert.deepEqual(box, { node: 7, low: [-0.5, 0.5, 1.5], high: [6.5, 5.5, 4.5] });
  assert.equal(others.length, 0);
});
