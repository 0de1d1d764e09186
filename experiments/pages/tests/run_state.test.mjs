import assert from "node:assert/strict";
import test from "node:test";
import { EventFilter } from "../src/replay/event_filter.js";
import { contactIntervals } from "../src/replay/contact_intervals.js";
import { loadRun } from "./load_run.mjs";
import { random, sampleRun } from "./sample_run.mjs";
import { elementsAfter } from "./slow_twin.mjs";

const run = sampleRun({ beads: 24, frames: 8 });
const { state } = await loadRun(run);
const all = new EventFilter(state.structures).stops;

// The elements after `applied` events of each structure, by the twin.
function check(applied) {
  for (const [s, structure] of run.structures.entries()) {
    for (const layer of structure.layers) {
      const expected = [...elementsAfter(structure, layer.name, applied[s])].sort();
      assert.deepEqual(state.elements(layer.name).map(String).sort(), expected);
    }
  }
}

test("the state at a time has the events before it", () => {
  const next = random(3);
  for (let round = 0; round < 60; ++round) {
    const [step, u] = [Math.floor(7 * next()), next()];
    state.seek(step, u);
    check(run.structures.map(({ events }) => events
        .filter((e) => e.step < step || (e.step === step && (e.lower + e.upper) / 2 <= u)).length));
  }
  state.seek(99, 0);
  assert.equal(state.time, 7);
  check(run.structures.map(({ events }) => events.length));
});

test("n visits every event in the run's order, p goes back", () => {
  const order = run.structures.flatMap(({ events }) => events.map((e) => e.order)).sort((a, b) => a - b);
  assert.ok(order.length > 50);
  state.seek(0, 0);
  const seen = [];
  for (let event = state.next(all); event; event = state.next(all)) {
    state.seekEvent(...event);
    seen.push(run.structures[event[0]].events[event[1]].order);
  }
  assert.deepEqual(seen, order);
  check(run.structures.map(({ events }) => events.length));
  const back = [seen.at(-1)];
  for (let event = state.previous(all); event; event = state.previous(all)) {
    state.seekEvent(...event);
    back.push(run.structures[event[0]].events[event[1]].order);
  }
  assert.deepEqual(back.reverse(), order);
});

test("n and p keep to the structures and events asked for", () => {
  state.seek(3, 0.5);
  const only = state.structures.findIndex(({ name }) => name === "contacts");
  const filter = new EventFilter(state.structures);
  state.structures.forEach((_, k) => k !== only && filter.muted.add(k));
  const [s, e] = state.next(filter.stops);
  assert.equal(s, only);
  assert.equal(e, state.applied[only]);
  const within = state.structures.map((_, k) => (k === only ? [0, 2] : []));
  state.seekEvent(only, 0);
  assert.deepEqual(state.next(within), [only, 2]);
  state.seekEvent(only, 2);
  assert.deepEqual(state.previous(within), [only, 0]);
  state.seekEvent(only, 0);
  assert.equal(state.previous(within), null);
});

test("an event names its beads and its changes", () => {
  const wrapped = state.structures.findIndex(({ name }) => name === "wrapped");
  const { events } = state.structures[wrapped];
  const source = run.structures[wrapped].events[0];
  assert.deepEqual(events.beadsOf(0).sort(), source.ids.slice(2).sort());
  assert.deepEqual(events.rolesOf(0)[0], { name: "node", of: "node", ids: source.ids.slice(0, 2) });
  const [change] = state.changesOf(wrapped, 0);
  assert.equal(change.name, "cages");
  assert.deepEqual([...change.added].slice(1, 1 + source.ids.length - 2), source.ids.slice(2));
  const bead = source.ids[2];
  const expected = run.structures[wrapped].events.flatMap((e, k) => (e.ids.slice(2).includes(bead) ? [k] : []));
  assert.deepEqual(events.withBead(bead), expected);
});

test("a shown bracket holds the bracket of the run, and is hardly wider", () => {
  for (const [s, structure] of run.structures.entries()) {
    structure.events.forEach((event, e) => {
      const [lower, upper] = state.structures[s].events.bracketOf(e);
      assert.ok(lower <= event.lower && event.upper <= upper, `${lower} ${event.lower} ${event.upper} ${upper}`);
      assert.ok(upper - lower <= 4 * (event.upper - event.lower) + 2 ** -30);
      assert.ok(lower < upper || (lower === event.lower && upper === event.upper));
    });
  }
});

test("contact intervals cover a time exactly if the pair is in contact", () => {
  const s = state.structures.findIndex(({ name }) => name === "contacts");
  const rows = contactIntervals(state.structures[s].layers[0], state.structures[s].events, 7);
  assert.ok(rows.length > 5);
  const next = random(8);
  for (let round = 0; round < 40; ++round) {
    const time = 7 * next();
    state.seek(Math.floor(time), time - Math.floor(time));
    const covering = rows.filter(({ spans }) => spans.some(({ from, to }) => from <= time && time < to));
    assert.deepEqual(covering.map(({ pair }) => String(pair)).sort(), state.elements("contacts").map(String).sort());
  }
  for (let k = 1; k < rows.length; ++k) assert.ok(rows[k - 1].total >= rows[k].total);
});

test("partners of a bead are those of its pairs", () => {
  state.seek(4, 0.5);
  for (const name of ["edges", "contacts"]) {
    for (let bead = 0; bead < 24; ++bead) {
      const expected = state.elements(name).flatMap(([i, j]) => (i === bead ? [j] : j === bead ? [i] : []));
      assert.deepEqual(state.partnersOf(name, bead), expected.sort((a, b) => a - b));
    }
  }
});
