import assert from "node:assert/strict";
import test from "node:test";
import { ElementSet } from "../src/replay/element_set.js";
import { Layer } from "../src/replay/layer.js";
import { random } from "./sample_run.mjs";

const keys = (set) => set.elements().map(String).sort();

test("a set of elements agrees with a set of texts", () => {
  for (const arity of [1, 2, 5]) {
    const next = random(arity);
    const set = new ElementSet(arity);
    const twin = new Map();
    for (let round = 0; round < 20000; ++round) {
      const element = Uint32Array.from({ length: arity }, () => (next() < 0.1 ? 0xffffffff : Math.floor(12 * next())));
      const key = String(element);
      if (twin.has(key)) {
        set.remove(element, 0);
        twin.delete(key);
      } else {
        set.add(element, 0);
        twin.set(key, element);
      }
      if (round % 997 === 0) assert.deepEqual(keys(set), [...twin.keys()].sort());
    }
    assert.deepEqual(keys(set), [...twin.keys()].sort());
  }
});

test("adding twice and removing what is absent is refused", () => {
  const set = new ElementSet(2);
  set.add(Uint32Array.of(1, 2), 0);
  assert.throws(() => set.add(Uint32Array.of(1, 2), 0), /adds an element that is there/);
  assert.throws(() => set.remove(Uint32Array.of(2, 1), 0), /removes an element that is not there/);
});

// A layer with random changes, and the elements after each of them.
function randomLayer(seed, arity, spacing) {
  const next = random(seed);
  const element = () => Array.from({ length: arity }, () => Math.floor(6 * next()));
  const state = new Map();
  for (let k = 0; k < 10; ++k) {
    const first = element();
    state.set(String(first), first);
  }
  const initial = Uint32Array.from([...state.values()].flat());
  const words = [];
  const after = [[...state.keys()].sort()];
  let count = 0;
  for (let event = 0; event < 3000; ++event) {
    if (next() < 0.7) {
      const removed = [...state.values()].filter(() => next() < 0.1);
      const added = [...Array(3)].map(element)
        .filter((e, k, all) => !state.has(String(e)) && all.findIndex((f) => String(f) === String(e)) === k);
      removed.forEach((e) => state.delete(String(e)));
      added.forEach((e) => state.set(String(e), e));
      words.push(event, removed.length, added.length, ...removed.flat(), ...added.flat());
      ++count;
    }
    after.push([...state.keys()].sort());
  }
  return { after, layer: new Layer({ name: "test", arity, changes: count }, initial, Uint32Array.from(words), spacing) };
}

test("going forward, backward and far gives the same elements", () => {
  for (const [arity, spacing] of [[2, 1 << 20], [2, 200], [3, 50]]) {
    const { after, layer } = randomLayer(arity + spacing, arity, spacing);
    const check = (events) => {
      layer.seek(events);
      assert.deepEqual(keys(layer.set), after[events], `after ${events} events`);
    };
    const next = random(9);
    for (let round = 0; round < 150; ++round) check(Math.floor(3001 * next()));
    for (let events = 1000; events < 1060; ++events) check(events);
    for (let events = 1060; events >= 1000; --events) check(events);
    check(3000);
    check(0);
    if (spacing < 1000) assert.ok(layer.snapshots.length > 5);
  }
});

test("snapshots made in the background leave the elements alone", () => {
  const { after, layer } = randomLayer(4, 2, 100);
  layer.seek(17);
  while (layer.makeSomeSnapshots());
  assert.deepEqual(keys(layer.set), after[17]);
  layer.seek(2500);
  assert.deepEqual(keys(layer.set), after[2500]);
});

test("changes of another length are refused", () => {
  assert.throws(
    () => new Layer({ name: "edges", arity: 2, changes: 1 }, new Uint32Array(0), Uint32Array.of(0, 0, 1, 5)),
    /layer 'edges' has 4 words of changes, expected 5/,
  );
});
