import assert from "node:assert/strict";
import test from "node:test";
import { Window, axisTicks, binWidth, eventNear, layoutEvents, layoutSpans, moved,
  zoomed } from "../src/replay/timeline_layout.js";
import { loadRun } from "./load_run.mjs";
import { random, sampleRun } from "./sample_run.mjs";

const { state } = await loadRun(sampleRun({ beads: 24, frames: 8 }));
const { events } = state.structures.find(({ name }) => name === "power");
const times = [...events.time];
const all = Uint32Array.from(times.keys());

test("bars hold all events of the window, by kind", () => {
  const next = random(1);
  let bars = 0;
  for (let round = 0; round < 100; ++round) {
    const from = 6 * next();
    const window = new Window(from, from + 0.2 + (7 - from - 0.2) * next(), 100 + 900 * next());
    const inside = times.flatMap((t, e) => (t >= window.from && t <= window.to ? [e] : []));
    const layout = layoutEvents(events, all, window);
    if (layout.single) {
      assert.deepEqual(layout.marks.map(({ event }) => event), inside);
      for (const { x, event } of layout.marks) assert.ok(Math.abs(window.time(x) - times[event]) < 1e-9);
      continue;
    }
    ++bars;
    for (const kind of [0, 1]) {
      const sum = layout.bins.reduce((total, { counts }) => total + counts[kind], 0);
      assert.equal(sum, inside.filter((e) => events.kind[e] === kind).length);
    }
    for (const { x, first, last } of layout.bins)
      for (let e = first; e < last; ++e) assert.ok(window.x(times[e]) >= x - 1e-6 && window.x(times[e]) <= x + binWidth + 1e-6);
    assert.equal(layout.most, Math.max(...layout.bins.map(({ first, last }) => last - first)));
  }
  assert.ok(bars > 10);
});

test("the event near a click is the nearest, within reach", () => {
  const next = random(2);
  const window = new Window(0, 7, 600);
  for (let round = 0; round < 300; ++round) {
    const x = 600 * next();
    const gaps = times.map((t) => Math.abs(window.x(t) - x));
    const least = Math.min(...gaps);
    const found = eventNear(events, all, window, x, 5);
    if (least > 5) assert.equal(found, -1);
    else assert.ok(Math.abs(gaps[found] - least) < 1e-9);
  }
});

test("zooming keeps the fixed time in place and stays within the run", () => {
  let range = [0, 100];
  for (let k = 0; k < 20; ++k) {
    const before = new Window(...range, 500).x(33.3);
    range = zoomed(range, 0.5, 33.3, 100);
    assert.ok(Math.abs(new Window(...range, 500).x(33.3) - before) < 1e-3);
  }
  assert.ok(range[1] - range[0] < 2e-4);
  for (let k = 0; k < 40; ++k) range = zoomed(range, 2, 33.3, 100);
  assert.deepEqual(range, [0, 100]);
  assert.deepEqual(moved([-5, 5], 10, 100), [0, 10]);
  assert.deepEqual(moved([95, 105], 10, 100), [90, 100]);
});

test("ticks are round numbers with as many digits as they need", () => {
  const labels = (from, to) => axisTicks(new Window(from, to, 500)).map(({ label }) => label);
  assert.deepEqual(labels(0, 10), ["0", "2", "4", "6", "8", "10"]);
  assert.deepEqual(labels(0.5, 0.6), ["0.50", "0.52", "0.54", "0.56", "0.58", "0.60"]);
  assert.equal(new Set(labels(33.3, 33.3000001)).size, labels(33.3, 33.3000001).length);
});

test("spans are cut at the window", () => {
  const row = { spans: [{ from: 0, to: 1 }, { from: 2, to: 5 }, { from: 8, to: 9 }] };
  assert.deepEqual(
    layoutSpans(row, new Window(3, 7, 400)).map(({ x, width }) => [x, width]),
    [[0, 200]],
  );
});
